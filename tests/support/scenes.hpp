// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The spaces of the tests, short ways to compose a model, and the state of a port in one tick, for tests of a
// bound or a shaper alone.
#include <passive_haptics/passive_haptics.hpp>

#include <chrono>
#include <cmath>
#include <limits>

namespace ph = passive_haptics;
using namespace std::chrono_literals;  // a tick of 1ms

using d1 = ph::space<double, 1>;
using d2 = ph::space<double, 2>;
using d3 = ph::space<double, 3>;
using f1 = ph::space<float, 1>;
using f2 = ph::space<float, 2>;
using f3 = ph::space<float, 3>;

/// A device as in the thesis: b = 0.03 N·s/m, T = 1 ms, so B = 30 N/m.
template <class Space = d1>
constexpr ph::reduced_energy thesis_ledger() {
  return {.damping = 0.03};
}
/// The loop of that device, whose driver drops a force after a tick. Its guard refuses no speed and no distance
/// of a test.
inline constexpr ph::loop_limits thesis_loop{.longest_tick = 1e-3,
                                             .top_speed = 100.0,
                                             .workspace = ph::loop_limits::never,
                                             .watchdog = 1e-3};

/// A model of a surface that the environment moves, composed of the given parts.
template <class Space, class Law, class Observer, class Bound, class Limits = ph::loop_limits>
constexpr auto following_half_space(const Law& law, const Observer& observer, const Bound& bound,
                                    const Limits& limits = thesis_loop) {
  return ph::local_model{
      Space{}, ph::followed<ph::half_space<Space>>{}, ph::turn_at_once{}, law, observer, bound,
      limits};
}

/// The wall of the thesis: surface at 0, object at x > 0, n = −1.
template <class Space>
constexpr ph::half_space<Space> wall(typename Space::scalar stiffness) {
  return {typename Space::scalar(0), typename Space::scalar(-1), stiffness};
}

/// The part of a policy that computes at a port.
template <class Port, class Part>
constexpr ph::part_at<Part, Port> at(const Part& part) {
  return ph::part_at<Part, Port>(part);
}

/// A port in one tick, with all that its port_state refers to. By default it is the device of the thesis, at rest
/// and with an empty ledger.
template <class Port, class Damping = ph::isotropic_damping, int Latency = 0, bool Exact = true>
struct situation {
  using damping_type = ph::part_at<Damping, Port>;
  using state_type = ph::port_state<Port, damping_type, Latency, Exact>;
  using scalar = typename Port::scalar;

  damping_type damping{Damping{0.03}};
  scalar energy{};
  scalar dt = scalar(1e-3);
  scalar recent{};  ///< 0: dt
  scalar longest_tick = scalar(1e-3);
  typename Port::stored_effort held = Port::zero();
  typename Port::motion travel = Port::zero();
  scalar travel_error{};
  bool motion_known = true;
  typename state_type::commands commanded{};  ///< newest first

  [[nodiscard]] constexpr state_type port() const noexcept {
    decltype(state_type::recent) ticks{};
    ticks.longest = recent;
    return {.damping = damping,
            .commanded = commanded,
            .energy = energy,
            .dt = dt,
            .longest_tick = longest_tick,
            .recent = ticks,
            .held = held,
            .travel = travel,
            .travel_error = travel_error,
            .motion_known = motion_known,
            .late = ph::is_late(dt, longest_tick)};
  }
};

/// The effort that a bound leaves.
template <class Bound, class Port, class Damping, int Latency, bool Exact>
constexpr typename Port::effort allowed(Bound& bound, const typename Port::effort& desired,
                                        const situation<Port, Damping, Latency, Exact>& now) {
  return ph::detail::applied<Port>(bound, desired, now.port()).force;
}
/// The effort that a shaper makes of a desired one.
template <class Shaper, class Space, class Damping, int Latency, bool Exact>
constexpr typename Space::vector allowed(Shaper& shaper, const typename Space::vector& desired,
                                         const ph::contact_state<Space>& contact,
                                         const situation<Space, Damping, Latency, Exact>& now) {
  return ph::detail::applied<Space>(shaper, desired, contact, now.port()).force;
}
