// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The recommended composition for a device whose encoder steps are known better where they are crossed:
//
//   make_touch<Space>(device, known_crossings{}, hand)            as in compositions.hpp, which counts on steps only
//   make_detents<Space>(device, known_crossings{}, hand, {…})     as in knob/detents.hpp
//
//     constexpr ph::encoder_device wheel{.mass = 1.33, .damping = 1.1, .friction = 0.17, .presliding = 5e-6,
//                                        .quantum = 57e-6, .force_limit = 10.0};
//     auto touch = ph::make_touch<scene>(wheel, ph::known_crossings{}, {.force = 5.3});
//     std::puts(touch.explain().crossings);  // "Steps are known well where they are crossed."
//
// It pays for wheels, knobs and heavy devices, up to twice the stiffness when kneaded (docs/design/encoders.md). Where
// design::crossing_of says that it does not, the position or all is that of compositions.hpp, and so is the stiffness.

#include <passive_haptics/compositions.hpp>
#include <passive_haptics/identification/crossed_budget.hpp>
#include <passive_haptics/identification/crossed_step.hpp>
#include <passive_haptics/identification/middle_observer.hpp>
#include <passive_haptics/knob/detents.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Says that mass and hand force may be counted on between samples, too, so that a ledger may know a step better where
/// it is crossed. If the motion refutes them, it is an event::outside_force: all that was credited on them is taken
/// back, the ledger is a dual_ledger until reset(), and for 0.1 s of contact the bound is strict.
struct known_crossings {
  double acceleration = detail::no_limit;  ///< its largest, if known: of a hand that rests [m/s²]
};

/// A watched bound that is strict, too, for 0.1 s of contact from the tick on after the ledger's crossings were refuted.
template <class Bound = reachable_bound>
struct watched_crossings {
  static constexpr guarantee passivity = Bound::passivity;
  static constexpr bound_traits traits = Bound::traits;

  watched<Bound> bound{};
  const char* because = "";  ///< whether crossings pay, and why

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return bound.check(); }
  template <port P>
  class on;
};

template <class Bound>
template <port P>
class watched_crossings<Bound>::on : public part_at<watched<Bound>, P> {
  using kept = part_at<watched<Bound>, P>;

 public:
  using typename kept::effort, typename kept::scalar;
  template <class Parameters>
  static constexpr int takers = detail::takers<Parameters, watched<Bound>, P>;

  constexpr explicit on(const watched_crossings& p) noexcept : kept(p.bound), because_(p.because) {}
  constexpr void set(const watched_crossings& p) noexcept {
    kept::set(p.bound);
    because_ = p.because;
  }
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    detail::take<watched<Bound>, P>(*this, p);
  }
  [[nodiscard]] constexpr watched_crossings parameters() const noexcept {
    return {kept::parameters(), because_};
  }
  constexpr void reset() noexcept { *this = on(parameters()); }

  template <class State>
  [[nodiscard]] constexpr auto limit(const effort& desired, const State& state) const noexcept {
    return strict_for_ > scalar(0) ? strictly_.limit(desired, state) : kept::limit(desired, state);
  }
  constexpr void explain(explanation& e, const auto& damping, scalar T, int k) const noexcept {
    if (strict_for_ > scalar(0)) strictly_.explain(e, damping, T, k);
    e.crossings = refuted_ ? "The motion has refuted mass, hand force or acceleration: nothing is "
                             "known of crossings, until reset()."
                           : because_;
  }

  [[nodiscard]] constexpr on& watching() noexcept { return *this; }
  /// True in every tick of a contact, since the ledger's crossings have no pauses.
  [[nodiscard]] constexpr bool looks() const noexcept { return pressed_ || kept::looks(); }
  template <bool Exact>
  constexpr void look(bool known, const auto& travel, const auto& told, const auto& held, scalar dt,
                      const auto& ledger) noexcept {
    if (kept::looks()) kept::template look<Exact>(known, travel, told, held, dt, ledger);
    const bool was_strict = strict_for_ > scalar(0), refuted = ledger.steps().refuted();
    if (was_strict) strict_for_ -= dt;
    if (refuted && !refuted_) strict_for_ = scalar(0.1);
    refuted_ = refuted;
    relies_again_ = was_strict && !(strict_for_ > scalar(0));
  }
  constexpr void look_on(bool asked) noexcept {
    kept::look_on(asked);
    pressed_ = asked;
  }
  [[nodiscard]] constexpr event seen() const noexcept {
    return strict_for_ > scalar(0) ? worse(event::outside_force, kept::seen()) : kept::seen();
  }
  [[nodiscard]] constexpr bool forgives() const noexcept {
    return relies_again_ ? kept::seen() == event::nominal
                         : !(strict_for_ > scalar(0)) && kept::forgives();
  }

 private:
  const char* because_;
  part_at<strict_bound, P> strictly_{strict_bound{}};
  scalar strict_for_{};  ///< [s]
  bool refuted_ = false, relies_again_ = false, pressed_ = false;
};

namespace detail {

/// What known_crossings are worth on a device in the hand's use, of which they count the stated force.
[[nodiscard]] constexpr design::intended_use use_of(const known_hand& hand) noexcept {
  design::intended_use use = hand.use;
  use.hand_force = hand.force;
  return use;
}
[[nodiscard]] constexpr double crossed_budget_of(encoder_device d, const known_hand& hand,
                                                 int late) noexcept {
  d.latency = d.latency < late ? late : d.latency;
  const auto told = design::crossing_of(d, use_of(hand));
  if (!told.pays) return budget_of(d, hand, late);
  const auto [mass, slow, fast, holding] = design::crossed_budget(d, use_of(hand)).limits;
  return kernels::smaller(holding, kernels::smaller(slow, fast));
}
/// From ρ = 2 on nothing is known of a crossing, so nothing is counted on either: a hand without limits.
[[nodiscard]] constexpr auto crossed_sums(const encoder_device& d, const known_crossings& known,
                                          const known_hand& hand) noexcept {
  const double rho = design::crossing_of(d, use_of(hand)).rho, T = d.longest_tick;
  const bool helps =
      rho > 0.0 && kernels::smaller(rho, known.acceleration * T * T / d.quantum) < 2.0;
  const dual_ledger today = ledger_of(d);
  return forgiving{crossed_ledger{.damping = today.damping,
                                  .quantum = {.quantum = d.quantum,
                                              .mass = d.mass,
                                              .hand_force = helps ? hand.force : 1e30,
                                              .acceleration = known.acceleration}},
                   amends_for(d.force_limit)};
}
[[nodiscard]] constexpr auto crossed_bounds(const encoder_device& d,
                                            const known_hand& hand) noexcept {
  return bound_chain{watched_crossings<reachable_bound>{
                         {reach_of(d, hand)}, design::crossing_of(d, use_of(hand)).because},
                     motors_of(d)};
}
[[nodiscard]] constexpr middle_observer crossed_eyes(const encoder_device& d,
                                                     const known_hand& hand,
                                                     const edge_observer& today) noexcept {
  return {today.quantum, today.presliding, !design::crossing_of(d, use_of(hand)).pays};
}
}  // namespace detail

/// One surface. Its stiffness is limited to design::crossed_budget where crossings pay.
template <class Space, class Constraint = half_space<Space>, class Limits = loop_limits>
[[nodiscard]] constexpr auto make_touch(const encoder_device& device, const known_crossings& known,
                                        const known_hand& hand, double turn_rate = 2.0) noexcept {
  const double most = detail::crossed_budget_of(device, hand, Limits::latency);
  return local_model{Space{},
                     followed<Constraint>{},
                     turn_limited{.rate = turn_rate},
                     detail::law_of(device, hand, most),
                     detail::crossed_sums(device, known, hand),
                     detail::crossed_bounds(device, hand),
                     detail::limits_of<Limits>(device),
                     detail::crossed_eyes(device, hand, detail::eyes_of_touch(device, most))};
}

/// Detents and end stops of a knob or a slider.
template <class Space, class Limits = loop_limits>
[[nodiscard]] constexpr auto make_detents(const encoder_device& device,
                                          const known_crossings& known, const known_hand& hand,
                                          const detents& shape) noexcept {
  const double most = detail::crossed_budget_of(device, hand, Limits::latency);
  return passive_port{Space{},
                      detail::fitted(shape, device, most),
                      detail::crossed_sums(device, known, hand),
                      detail::crossed_bounds(device, hand),
                      detail::limits_of<Limits>(device),
                      detail::crossed_eyes(device, hand, detail::eyes_of(device))};
}

}  // namespace v0
}  // namespace passive_haptics
