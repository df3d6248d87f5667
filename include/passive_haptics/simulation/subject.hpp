// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Any composed model as challenge.hpp and search.hpp see it. Adversaries are compiled once per
// Space; per model there are only four short functions.
//
//   lay_constraint<C>   a constraint of type C through a point: half_space, segment, triangle
//   under_test          a model, and the copy of it that a run works on
//   subject<Space>      a reference to it that forgets its type

#include <passive_haptics/concepts.hpp>
#include <passive_haptics/geometry.hpp>
#include <passive_haptics/simulation/adversary_worlds.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// operator()(point [m], unit outward normal, K [N/m]): the constraint of type C through that point.
/// Specialise it for a constraint of your own, or hand challenge() a callable of the same shape.
template <class C>
struct lay_constraint;

template <class Space>
struct lay_constraint<half_space<Space>> {
  using vector = typename Space::vector;
  [[nodiscard]] half_space<Space> operator()(const vector& point, const vector& normal,
                                             typename Space::scalar K) const noexcept {
    return {point, normal, K};
  }
};

/// Small enough for a motion to leave it over an edge.
template <class Space>
struct lay_constraint<segment<Space>> {
  using vector = typename Space::vector;
  typename Space::scalar length = typename Space::scalar(0.02);  ///< [m], the point in the middle

  [[nodiscard]] segment<Space> operator()(const vector& point, const vector& normal,
                                          typename Space::scalar K) const noexcept {
    using scalar = typename Space::scalar;
    const vector along(-normal(1), normal(0));
    const vector half = along * (length / scalar(2));
    return {.a = vector(point - half), .b = vector(point + half), .stiffness = K};
  }
};

template <class Space>
struct lay_constraint<triangle<Space>> {
  using vector = typename Space::vector;
  typename Space::scalar side = typename Space::scalar(0.04);  ///< [m], the point in the centre

  [[nodiscard]] triangle<Space> operator()(const vector& point, const vector& normal,
                                           typename Space::scalar K) const noexcept {
    using scalar = typename Space::scalar;
    const vector u = Space::orthogonal(normal);
    const vector w = Space::cross(normal, u);
    const scalar r = side / kernels::square_root(scalar(3));  // centre to corner
    const vector aside = w * (side / scalar(2));
    const vector back = point - u * (r / scalar(2));
    return {.a = vector(point + u * r),
            .b = vector(back + aside),
            .c = vector(back - aside),
            .stiffness = K};
  }
};

/// Where constraints come from unless the caller says otherwise.
template <class Model>
using usual_constraint = lay_constraint<typename Model::constraint_type>;

/// The model as it was given, and the copy that the next run spoils.
template <class Model, class Make>
struct under_test {
  const Model& original;
  Model now;
  const Make& make;
};

template <class Space>
class subject {
 public:
  using vector = typename Space::vector;

  template <class Model, class Make>
  explicit subject(under_test<Model, Make>& tested) noexcept
      : tested_(&tested), verbs_(&verbs_of<under_test<Model, Make>>) {}

  /// As it was given.
  void restart() const noexcept { verbs_->restart(tested_); }
  /// The force commanded [N].
  [[nodiscard]] vector tick(const device_sample<Space>& sample) const noexcept {
    return verbs_->tick(tested_, sample);
  }
  /// False: its constraint never moves, or it has refused this one.
  bool retarget(const surface_state<Space>& next) const noexcept {
    return verbs_->retarget(tested_, next);
  }
  /// Does it own a surface that never moves? Then `surface` becomes that one, at its point nearest
  /// the origin.
  bool brings_its_own(surface_state<Space>& surface) const noexcept {
    return verbs_->brings_its_own(tested_, surface);
  }

 private:
  struct verbs {
    void (*restart)(void*);
    vector (*tick)(void*, const device_sample<Space>&);
    bool (*retarget)(void*, const surface_state<Space>&);
    bool (*brings_its_own)(void*, surface_state<Space>&);
  };

  template <class Tested>
  static constexpr bool moves = requires(Tested& t, vector v, typename Space::scalar K) {
    t.now.retarget(t.make(v, v, K));
  };

  template <class Tested>
  static constexpr verbs verbs_of{
      [](void* tested) {
        auto& t = *static_cast<Tested*>(tested);
        t.now = t.original;
      },
      [](void* tested, const device_sample<Space>& sample) -> vector {
        return static_cast<Tested*>(tested)->now.tick(sample).force;
      },
      []([[maybe_unused]] void* tested, [[maybe_unused]] const surface_state<Space>& next) {
        if constexpr (moves<Tested>) {
          auto& t = *static_cast<Tested*>(tested);
          return static_cast<bool>(
              t.now.retarget(t.make(to_port<Space>(next.point), to_port<Space>(next.normal),
                                    static_cast<typename Space::scalar>(next.stiffness))));
        } else {
          return false;
        }
      },
      []([[maybe_unused]] void* tested, [[maybe_unused]] surface_state<Space>& surface) {
        if constexpr (moves<Tested>) {
          return false;
        } else {
          const auto& fixed = static_cast<Tested*>(tested)->now.target();
          surface.normal = to_physical<Space>(vector(fixed.outward()));
          surface.point = surface.normal * static_cast<double>(fixed.depth(Space::zero()));
          surface.stiffness = static_cast<double>(fixed.stiffness);
          return true;
        }
      }};

  void* tested_;
  const verbs* verbs_;
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
