// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A set of contacts that come, move, bend, rub and go: a corner, a groove, a tool's tip among organs. One
// source, so one port, one ledger and one bound on the sum of its forces.
//
//     using scene = ph::space<double, 3>;
//     ph::passive_port corner{scene{},
//                             ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{},
//                                             ph::slots<ph::half_space<scene>, 3>{}},
//                             ph::reduced_energy{.damping = 0.03},
//                             ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
//                             ph::loop_limits{.longest_tick = 0.0011}};
//     corner.source().update(0, floor);                 // from the haptic thread, whenever there is news
//     corner.source().release(0);
//
//   surfaces ─▶ PURSUIT ─▶ own depths, ─▶ PROXY ─▶ Σ λ n ─▶ STICK_SLIP ─▶ wanted force ─▶ (the port's bound)
//   (slots)     per slot   own normals    (S1, S2)          per slot
//
// Free space is the intersection of what the slots leave free: a corner from inside. A solid that is not
// convex takes a slot for each of its convex pieces; a convex one from outside takes one slot with
// a shell round it (constraint_geometry/), or a flat side would give way to the next in a jump.
//
// Why not contacts{…}: that is the sum of local models whose number is known; it takes any source, also
// one that shapes its force. This one is for surfaces: no stiffer however many, and no steps.

#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/contact/proxy.hpp>
#include <passive_haptics/contact/pursuit.hpp>
#include <passive_haptics/contact/slot_room.hpp>
#include <passive_haptics/contact/stick_slip.hpp>

#include <array>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// The surfaces, how they press, how fast they follow, and whether they rub:
///     ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::stick_slip{}, ph::slots<…>{}}
/// As a member of a class: ph::contact_set<ph::stick_slip, ph::slots<ph::half_space<scene>, 3>>.
template <class Friction, class... Slots>
struct contact_set {
  static constexpr int capacity = (Slots::count + ... + 0);

  proxy_spring spring{};
  pursuit pace{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS Friction friction{};
  int sweeps = 16;  ///< of Gauss-Seidel at most, where more than three surfaces are there

  constexpr contact_set() noexcept = default;
  constexpr contact_set(const proxy_spring& s, const pursuit& p,
                        const std::type_identity_t<Friction>& f, const Slots&... /*room*/) noexcept
      : spring(s), pace(p), friction(f) {}
  constexpr contact_set(const proxy_spring& s, const pursuit& p, const Slots&... /*room*/) noexcept
      : spring(s), pace(p) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = spring.check()) return fault;
    if (const auto fault = pace.check()) return fault;
    if (const auto fault = friction.check()) return fault;
    if (sweeps < 1) return {"sweeps", static_cast<double>(sweeps), "≥ 1"};
    return {};
  }
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
class contact_set<Friction, Slots...>::on {
  static constexpr bool rubs = !std::same_as<Friction, frictionless> && Space::dof > 1;
  template <class Surface>
  using slot_of = pursued<Surface, Space>;
  using all_slots = detail::slot_room<slot_of, Slots...>;
  using first_kind = typename all_slots::first_kind;
  struct no_friction {
    constexpr explicit no_friction(const Friction& /*f*/) noexcept {}
  };

 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using result_type = tick_result<Space>;
  static constexpr bool asks_for_numbers = true;

  constexpr on() noexcept : on(contact_set{}) {}
  constexpr explicit on(const contact_set& p) noexcept
      : spring_(p.spring), pace_(p.pace), friction_(p.friction), sweeps_(p.sweeps) {}
  [[nodiscard]] constexpr contact_set parameters() const noexcept {
    contact_set p;
    p.spring = spring_.parameters();
    p.pace = pace_.parameters();
    if constexpr (rubs) p.friction = friction_.parameters();
    p.sweeps = sweeps_;
    return p;
  }
  template <class Parameters>
  static constexpr int takers = std::same_as<Parameters, proxy_spring> +
                                std::same_as<Parameters, pursuit> +
                                (rubs && std::same_as<Parameters, Friction>);
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    if constexpr (std::same_as<Parameters, proxy_spring>) spring_ = decltype(spring_)(p);
    if constexpr (std::same_as<Parameters, pursuit>) pace_ = decltype(pace_)(p);
    if constexpr (std::same_as<Parameters, Friction>) friction_ = decltype(friction_)(p);
  }
  /// The longest tick of the loop [s], on which the stiffness depends.
  constexpr void begin(scalar longest_tick) noexcept {
    longest_tick_ = longest_tick;
    slots_.for_each([&](auto& slot, std::size_t) { slot.begin(spring_, longest_tick); });
  }
  constexpr void reset() noexcept {
    slots_.for_each([](auto& slot, std::size_t) { slot.reset(); });
    static_cast<void>(let_go());
    refused_ = false;
  }

  /// The world's newest surface in slot i, counted among those of its kind. False: there is no such slot or
  /// the surface is unusable; the last good one stays, and the next tick says so too.
  template <class Surface>
  constexpr bool update(int i, const Surface& next) noexcept {
    bool taken = false;
    slots_.template visit<Surface>(
        i, [&](auto& slot) { taken = slot.update(next, here_, spring_, pace_, longest_tick_); });
    refused_ = refused_ || !taken;
    return taken;
  }
  /// Nothing is there any more: the contact recedes until it presses no longer, and ends.
  template <class Surface = first_kind>
  constexpr void release(int i) noexcept {
    slots_.template visit<Surface>(i, [](auto& slot) { slot.release(); });
  }
  /// Slot i of that kind, 0 ≤ i < Count: its newest surface, its lag ℓ and its λ.
  template <class Surface = first_kind>
  [[nodiscard]] constexpr const auto& slot(int i) const noexcept {
    return slots_.template slot<Surface>(i);
  }

  struct request {
    vector wanted;  ///< [N]
    bool nothing;
    scalar depth;  ///< of the deepest [m]
  };
  template <bool Shortcut>
  [[nodiscard]] constexpr request ask(const auto& motion, const auto& port, event& what) noexcept {
    const vector x = motion.position;
    const vector travel = x - vector(here_);
    here_ = x;
    if (std::exchange(refused_, false)) what = worse(what, event::rejected_target);

    gathered now;
    gather(x, motion, port.dt, now, what);
    if (now.empty) what = worse(what, event::no_target);
    const scalar coupling = now.stiffest / (scalar(1) - spring_.softness());
    now.rows.couple(coupling);
    solve(now.rows, vector(Space::zero()), inner, sweeps_);

    vector pressed = Space::zero(), rubbed = Space::zero(), v = Space::zero();
    if constexpr (rubs) v = velocity(motion);
    std::size_t r = 0;
    slots_.for_each([&](auto& slot, std::size_t i) {
      const bool felt = r < now.rows.count && now.slot[r] == i;
      const scalar lambda = felt ? now.rows.pressed[r] : scalar(0);
      slot.press(lambda);
      if constexpr (rubs) {
        const auto& of = slot.spring();
        rubbed = rubbed + bristles_[i].rub(friction_, lambda, now.normal[felt ? r : 0], travel, v,
                                           of.stiffness * share, of.damping * share, port.dt);
      }
      if (felt) {
        pressed = pressed + now.rows.row[r] * lambda;
        ++r;
      }
    });
    const vector wanted = pressed + rubbed;
    coupled_ = coupling > scalar(0) ? vector(pressed / coupling) : vector(Space::zero());
    if (!Space::is_finite(wanted)) [[unlikely]] {
      what = detail::unusable(what);
      return let_go();
    }
    return {wanted, wanted == vector(Space::zero()), now.deepest};
  }
  /// The own surfaces follow the world's, not the force: there is nothing to put back.
  [[nodiscard]] constexpr result_type answered(const request& r,
                                               const port_result<Space>& port) const noexcept {
    return {port.force, r.depth, port.energy, port.what, port.limited};
  }
  constexpr result_type refused(const port_result<Space>& port, scalar dt) noexcept {
    slots_.for_each([&](auto& slot, std::size_t) { slot.grow_older(dt, pace_); });
    return {port.force, scalar(0), port.energy, port.what, false};
  }

 private:
  static constexpr auto cells = static_cast<std::size_t>(capacity);
  /// Of a contact's K and B, what its bristle has: all of them together have no more than one contact.
  static constexpr scalar share = scalar(1) / scalar(capacity);
  struct nothing_kept {};
  template <class T>
  using if_it_rubs = std::conditional_t<rubs, std::array<T, cells>, nothing_kept>;

  /// What all slots have to say in a tick.
  struct gathered {
    proxy_problem<vector, scalar, capacity> rows;
    std::array<std::size_t, cells> slot;  ///< of each row
    PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS if_it_rubs<vector> normal;
    scalar stiffest{}, deepest{};
    bool empty = true;
  };
  constexpr void gather(const vector& x, const auto& motion, scalar dt, gathered& now,
                        event& what) noexcept {
    const vector others = coupled_;
    slots_.for_each([&](auto& slot, std::size_t i) {
      if (!slot.taken()) return;
      now.empty = false;
      slot.grow_older(dt, pace_);
      if (slot.stale()) what = worse(what, event::stale_target);
      felt_surface<Space> own;
      if (!slot.follow(x, motion, dt, others, pace_, own)) return;
      if (!kernels::is_finite(own.depth) || !Space::is_finite(own.push)) [[unlikely]] {
        what = detail::unusable(what);
        return;
      }
      const auto here = spring_.at_depth(slot.spring(), own.depth);
      now.stiffest = kernels::larger(now.stiffest, here.stiffness);
      now.deepest = kernels::larger(now.deepest, own.depth);
      now.slot[now.rows.count] = i;
      if constexpr (rubs) now.normal[now.rows.count] = own.normal;
      now.rows.add(own.push, damped_depth(here, own.depth, motion.along(own.push)), here.stiffness,
                   slot.pressed());
    });
  }
  /// No force, and nothing that was felt is remembered.
  constexpr request let_go() noexcept {
    slots_.for_each([](auto& slot, std::size_t) { slot.press(scalar(0)); });
    if constexpr (rubs) {
      for (auto& bristle : bristles_) bristle.reset();
    }
    coupled_ = Space::zero();
    return {Space::zero(), true, scalar(0)};
  }
  [[nodiscard]] static constexpr vector velocity(const auto& motion) noexcept {
    vector v = Space::zero();
    for (int i = 0; i < Space::dof; ++i) {
      vector axis = Space::zero();
      Space::component(axis, i) = scalar(1);
      Space::component(v, i) = motion.along(axis);
    }
    return v;
  }
  static constexpr auto inner = [](const vector& a, const vector& b) { return Space::dot(a, b); };

  all_slots slots_{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS if_it_rubs<stick_slip::bristle<Space>> bristles_{};
  proxy_spring::at<scalar> spring_;
  pursuit::on<Space> pace_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS std::conditional_t<rubs, stick_slip::on<Space>, no_friction>
      friction_;
  int sweeps_;
  typename Space::coordinates here_{};     ///< where the device was last [m]
  typename Space::coordinates coupled_{};  ///< Σ λ n/K_c of the last tick [m]
  scalar longest_tick_{};
  bool refused_ = false;
};

}  // namespace v0
}  // namespace passive_haptics
