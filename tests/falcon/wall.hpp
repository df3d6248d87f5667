// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Models, hands and a loop for the wall experiment through the mock Falcon. The judge is the true
// port energy of the mock's body.
#include "support/catch.hpp"
#include "support/falcon_loop.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <cstdio>

using sim::random_source;

inline constexpr double quantum = falcon_quantum;
inline constexpr double motors = 8.0;  // [N], settings::force_limit

/// Taps through a surface, and every now and then does something else.
struct restless_hand {
  sim::tapping_hand<d3> tap{};
  std::uint64_t seed = 1;
  double part = 0.5;  ///< of the time it taps

  [[nodiscard]] d3::vector force(double t, const d3::vector& x,
                                 const d3::vector& v) const noexcept {
    random_source random(seed * 1000003 + static_cast<std::uint64_t>(t / 0.013));
    if (random.chance(part)) return tap.force(t, x, v);
    const d3::vector home = 400.0 * (d3::vector(tap.surface) - x);
    return sim::clamp_norm<d3>(home + random.direction<d3>() * tap.limit, tap.limit);
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return tap.check(); }
};

/// The loop through the mock: what is commanded is held a tick later.
template <int late = 1>
constexpr ph::late_loop_limits<late> ticks_of(double longest) {
  return {.longest_tick = longest, .top_speed = 100.0};
}
inline constexpr ph::late_loop_limits<1> told = ticks_of(1e-3);
/// The same loop by one who does not know: the control.
inline constexpr ph::loop_limits untold = ticks_of<0>(1e-3);

template <class Law, class Observer, class Bound, class Limits, class Motion = ph::last_difference>
auto composed(const Law& law, const Observer& observer, const Bound& bound, const Limits& limits,
              const Motion& motion = {}) {
  return ph::local_model{
      d3{},  ph::followed<ph::half_space<d3>>{}, ph::turn_at_once{}, law, observer, bound, limits,
      motion};
}

constexpr ph::reduced_energy plain(double b) {
  return {.damping = b};
}
constexpr ph::quantised_energy sure(double b) {
  return {.damping = b, .quantum = quantum};
}

/// damped_spring, mass_observer and quantised_energy, as the README recommends for encoders.
template <class Bound, class Limits>
auto recommended(double b, double mass, const Bound& bound, const Limits& limits) {
  return composed(ph::damped_spring{.mass = mass, .force_limit = motors}, sure(b), bound, limits,
                  ph::mass_observer{.mass = mass, .quantum = quantum});
}

inline falcon::settings<double> eager() {
  return {.ramp = 1e-3};
}
