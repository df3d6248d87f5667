// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A set of contacts that appear, move, deform, have friction and vanish: a corner, a groove, a tool's tip among
// organs. It is one source, so there is one port, one ledger and one bound on the sum of its forces.
//
//     using scene = ph::space<double, 3>;
//     ph::passive_port corner{scene{},
//                             ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{},
//                                             ph::slots<ph::half_space<scene>, 3>{}},
//                             ph::reduced_energy{.damping = 0.03},
//                             ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
//                             ph::loop_limits{.longest_tick = 0.0011}};
//     corner.source().update(0, floor);                 // from the haptic thread, at every update
//     corner.source().release(0);
//
// Free space is the intersection of the free half-spaces of all slots, such as a corner from inside. A solid that is
// not convex takes a slot for each of its convex pieces; a convex one from outside takes one slot with a shell
// (constraint_geometry/), because between two flat sides the force would jump.
//
// contacts{…} is the sum of a fixed number of local models, or of any other sources, with shapers if desired. This
// one is for surfaces: its stiffness does not grow with their number, and its force does not step.

#include <passive_haptics/contact/contact_engine.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {

/// The frame of a point device: every contact is at the point, and its force is along its own normal.
template <class Space>
struct point_frame {
  using space = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using row = vector;
  struct point {};
  using stored = typename Space::coordinates;
  static constexpr bool naps = true, shares_load = false;

  /// The distance of the device from a former position [m].
  [[nodiscard]] static constexpr scalar apart(const auto& now, const stored& was) noexcept {
    return Space::norm(Space::difference(now.x, vector(was)));
  }
  [[nodiscard]] static constexpr bool is_point(const point& /*p*/) noexcept { return true; }
  [[nodiscard]] static constexpr vector place(const stored& was, const point& /*p*/) noexcept {
    return was;
  }

  template <class Motion>
  struct tick {
    struct spot {
      const vector& position;
    };
    const Motion& motion;
    vector x, travelled;

    [[nodiscard]] constexpr spot at(const point& /*p*/) const noexcept { return {x}; }
    [[nodiscard]] constexpr scalar along(const spot& /*s*/, const vector& n) const noexcept {
      return motion.along(n);
    }
    [[nodiscard]] constexpr vector velocity(const spot& /*s*/) const noexcept {
      return velocity_of<Space>(motion);
    }
    [[nodiscard]] constexpr vector travel(const point& /*p*/, const spot& /*s*/) const noexcept {
      return travelled;
    }
    [[nodiscard]] constexpr row row_of(const spot& /*s*/, const vector& n) const noexcept {
      return n;
    }
    /// The motion in a tick, as the velocity that the damper reads [m/s]; way_of() has the way of it [m].
    [[nodiscard]] constexpr row moved() const noexcept { return velocity_of<Space>(motion); }
    [[nodiscard]] constexpr stored place() const noexcept { return x; }
  };
  template <class Motion>
  [[nodiscard]] static constexpr tick<Motion> now(const Motion& motion, const auto& /*port*/,
                                                  const stored& last) noexcept {
    const vector x = motion.position;
    return {motion, x, vector(x - vector(last))};
  }

  /// A_ij and A_ii of (S1) [m/N].
  struct proxy {
    scalar together;  ///< 1 − ε
    [[nodiscard]] constexpr scalar inner(const row& a, const row& b, scalar least) const noexcept {
      return together * Space::dot(a, b) * least;
    }
    [[nodiscard]] static constexpr scalar own(const row& /*r*/, scalar compliance) noexcept {
      return compliance;
    }
    [[nodiscard]] static constexpr scalar most_yield(const point& /*p*/, scalar /*c*/) noexcept {
      return scalar(1);
    }
  };
  [[nodiscard]] static constexpr proxy coupling(const auto& spring) noexcept {
    return {scalar(1) - spring.softness()};
  }
  [[nodiscard]] static constexpr row way_of(const row& moved, scalar dt) noexcept {
    return moved * dt;
  }
  [[nodiscard]] static constexpr scalar size(const auto& /*spring*/, const row& force) noexcept {
    return kernels::square_root(Space::dot(force, force));
  }
  [[nodiscard]] static constexpr row yields(const auto& /*spring*/, const row& push,
                                            scalar compliance) noexcept {
    return push * compliance;
  }
  [[nodiscard]] static constexpr scalar power(const row& push, const row& way) noexcept {
    return space::dot(push, way);
  }
  [[nodiscard]] static constexpr row pushes(const row& push) noexcept { return push; }
  [[nodiscard]] static constexpr scalar stretch(const auto& /*spring*/, const row& way) noexcept {
    return kernels::square_root(Space::dot(way, way));
  }
};

}  // namespace detail

/// Surfaces in slots, with a spring, the rates at which they follow updates, and friction:
///     ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::stick_slip{}, ph::slots<…>{}}
/// As a member of a class: ph::contact_set<ph::stick_slip, ph::slots<ph::half_space<scene>, 3>>. It works in
/// a space of any dimension; friction needs at least two.
template <class Friction, class... Slots>
struct contact_set : contact_parameters<proxy_spring, Friction, Slots...> {
  using base = contact_parameters<proxy_spring, Friction, Slots...>;

  constexpr contact_set() noexcept = default;
  constexpr contact_set(const base& p) noexcept : base(p) {}  // NOLINT: the same
  using base::base;

  template <port Space>
  class on;
};
template <class... Surfaces, int... Counts>
contact_set(const proxy_spring&, const pursuit&, const slots<Surfaces, Counts>&...)
    -> contact_set<frictionless, slots<Surfaces, Counts>...>;
template <class Friction, class... Surfaces, int... Counts>
requires std::same_as<Friction, stick_slip> || std::same_as<Friction, frictionless> contact_set(
    const proxy_spring&, const pursuit&, const Friction&, const slots<Surfaces, Counts>&...)
->contact_set<Friction, slots<Surfaces, Counts>...>;

template <class Friction, class... Slots>
template <port Space>
class contact_set<Friction, Slots...>::on
    : public detail::contact_engine<Space, detail::point_frame, proxy_spring, Friction, Slots...> {
  using engine =
      detail::contact_engine<Space, detail::point_frame, proxy_spring, Friction, Slots...>;

 public:
  constexpr on() noexcept : on(contact_set{}) {}
  constexpr explicit on(const contact_set& p) noexcept : engine(p) {}

  /// Sets the newest surface of slot i, counted among those of its kind, and returns the stiffness it displays. False:
  /// there is no such slot or the surface is unusable; the last good one stays, the next tick has event::rejected_target.
  template <class Surface = typename engine::first_kind>
  constexpr news_taken<typename engine::scalar> update(int i, const Surface& next) noexcept {
    return this->put(i, {}, next);
  }
};

}  // namespace v0
}  // namespace passive_haptics
