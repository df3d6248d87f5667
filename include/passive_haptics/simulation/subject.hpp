// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The type-erased model of challenge.hpp and search.hpp.
// Adversaries are compiled once per Space, and for each model only four short functions.
//
//   lay_constraint<C>   makes a constraint of type C through a point: half_space, segment, triangle
//   under_test          a model, and the copy of it that a run works on
//   subject<Space>      a reference to an under_test of any model
//
// A model is any type with tick(sample), which answers with a force or with a result that has one, and
// with a space_type or port_type. A surface is laid on it by the callable `lay`, which is one of
//     lay_constraint<C>       the default: a constraint for update() of the model or of its source
//     lay(point, normal, K)   the same with a constraint of your own
//     lay(model, surface)     your own function, for several contacts or for a renderer
// A model whose constraint never moves keeps that one.

#include <passive_haptics/constraint_geometry/segment.hpp>
#include <passive_haptics/constraint_geometry/triangle.hpp>
#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/simulation/adversary_worlds.hpp>
#include <passive_haptics/simulation/loop.hpp>

#include <concepts>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// operator()(point [m], unit outward normal, K [N/m]) is the constraint of type C through that point.
/// Specialise it for a constraint of your own.
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

/// The segment is so short that a motion can leave it over its end.
template <class Space>
struct lay_constraint<segment<Space>> {
  using vector = typename Space::vector;
  typename Space::scalar length = typename Space::scalar(0.02);  ///< [m]; the point is its middle

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
  typename Space::scalar side = typename Space::scalar(0.04);  ///< [m]; the point is its centre

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

namespace detail {

template <class Model>
[[nodiscard]] constexpr auto find_space() noexcept {
  if constexpr (requires { typename Model::space_type; }) {
    return typename Model::space_type{};
  } else {
    return typename Model::port_type{};
  }
}

struct say_how {};
template <class Model>
[[nodiscard]] constexpr auto find_lay() noexcept {
  if constexpr (requires { typename Model::constraint_type; }) {
    return lay_constraint<typename Model::constraint_type>{};
  } else if constexpr (requires { typename Model::source_type::constraint_type; }) {
    return lay_constraint<typename Model::source_type::constraint_type>{};
  } else {
    return say_how{};
  }
}

/// The holder of the constraint: the model, or its source.
template <class Model>
[[nodiscard]] constexpr auto& holder_of(Model& model) noexcept {
  if constexpr (requires { model.target(); }) {
    return model;
  } else {
    return model.source();
  }
}

template <class Model, class Lay, class Space>
concept laid_by_caller = requires(Model& m, const Lay& lay, const surface_state<Space>& surface) {
  { lay(m, surface) } -> std::convertible_to<bool>;
};
template <class Model, class Lay, class Space>
concept takes_constraint = requires(Model& m, const Lay& lay, typename Space::vector v,
                                    typename Space::scalar K) {
  m.update(lay(v, v, K));
};
template <class Model, class Lay, class Space>
concept source_takes_constraint = requires(Model& m, const Lay& lay, typename Space::vector v,
                                           typename Space::scalar K) {
  m.source().update(lay(v, v, K));
};
template <class Model, class Lay, class Space>
concept can_be_moved = laid_by_caller<Model, Lay, Space> || takes_constraint<Model, Lay, Space> ||
    source_takes_constraint<Model, Lay, Space>;
template <class Model, class Space>
concept has_its_own = requires(const Model& m, typename Space::vector v) {
  m.target().at(v);
}
|| requires(const Model& m, typename Space::vector v) {
  m.source().target().at(v);
};

}  // namespace detail

template <class Model>
using space_of = decltype(detail::find_space<Model>());

/// The `lay` of a model by default.
template <class Model>
using usual_lay = decltype(detail::find_lay<Model>());

/// True if Lay can lay a surface on the model. A model with several contacts, or none, needs lay(model, surface).
template <class Lay, class Model>
concept lay_for = detail::can_be_moved<Model, Lay, space_of<Model>> ||
    (std::same_as<Lay, usual_lay<Model>>&& detail::has_its_own<Model, space_of<Model>>);

/// The model as it was given, and the copy that a run works on.
template <class Model, class Lay>
struct under_test {
  const Model& original;
  Model now;
  const Lay& lay;
};

template <class Space>
class subject {
 public:
  using vector = typename Space::vector;

  template <class Model, lay_for<Model> Lay>
  explicit subject(under_test<Model, Lay>& tested) noexcept
      : tested_(&tested), verbs_(&verbs_of<Model, Lay>) {}

  /// Sets the copy to the original model.
  void restart() const noexcept { verbs_->restart(tested_); }
  /// One tick of the model; returns the force commanded [N].
  [[nodiscard]] vector tick(const device_sample<Space>& sample) const noexcept {
    return verbs_->tick(tested_, sample);
  }
  /// Lays the surface on the model. Returns false if its constraint never moves or it refuses this one.
  bool update(const surface_state<Space>& next) const noexcept {
    return verbs_->update(tested_, next);
  }
  /// True if the model owns a surface that never moves; `surface` then becomes that one, at its point
  /// nearest the origin.
  bool brings_its_own(surface_state<Space>& surface) const noexcept {
    return verbs_->brings_its_own(tested_, surface);
  }

 private:
  struct verbs {
    void (*restart)(void*);
    vector (*tick)(void*, const device_sample<Space>&);
    bool (*update)(void*, const surface_state<Space>&);
    bool (*brings_its_own)(void*, surface_state<Space>&);
  };

  template <class Model, class Lay>
  static bool lay_on([[maybe_unused]] under_test<Model, Lay>& t,
                     [[maybe_unused]] const surface_state<Space>& next) noexcept {
    if constexpr (detail::laid_by_caller<Model, Lay, Space>) {
      return static_cast<bool>(t.lay(t.now, next));
    } else if constexpr (detail::can_be_moved<Model, Lay, Space>) {
      const auto constraint = t.lay(to_port<Space>(next.point), to_port<Space>(next.normal),
                                    static_cast<typename Space::scalar>(next.stiffness));
      if constexpr (detail::takes_constraint<Model, Lay, Space>) {
        return static_cast<bool>(t.now.update(constraint));
      } else {
        return static_cast<bool>(t.now.source().update(constraint));
      }
    } else {
      return false;
    }
  }

  template <class Model, class Lay>
  static bool take_over([[maybe_unused]] const under_test<Model, Lay>& t,
                        [[maybe_unused]] surface_state<Space>& surface) noexcept {
    if constexpr (detail::can_be_moved<Model, Lay, Space>) {
      return false;
    } else {
      const auto& fixed = detail::holder_of(t.now).target();
      const auto seen = fixed.at(Space::zero());
      surface.normal = to_physical<Space>(vector(seen.outward()));
      surface.point = surface.normal * static_cast<double>(seen.depth);
      surface.stiffness = static_cast<double>(fixed.stiffness);
      return true;
    }
  }

  template <class Model, class Lay>
  static constexpr verbs verbs_of{
      [](void* tested) {
        auto& t = *static_cast<under_test<Model, Lay>*>(tested);
        t.now = t.original;
      },
      [](void* tested, const device_sample<Space>& sample) -> vector {
        return detail::force_of(static_cast<under_test<Model, Lay>*>(tested)->now.tick(sample));
      },
      [](void* tested, const surface_state<Space>& next) {
        return lay_on(*static_cast<under_test<Model, Lay>*>(tested), next);
      },
      [](void* tested, surface_state<Space>& surface) {
        return take_over(*static_cast<under_test<Model, Lay>*>(tested), surface);
      }};

  void* tested_;
  const verbs* verbs_;
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
