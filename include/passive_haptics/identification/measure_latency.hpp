// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Measures the latency [ticks] from a command of a loop to its holding, for any haptic device.
//
//     const auto found = ph::measure_latency<scene>(device, {.force = 1.0});
//     if (found.problem) std::puts(found.problem);
//     else std::printf("late_loop_limits<%d>\n", found.ticks);
//
// It shakes one axis for some seconds with a force that changes sign at random, and finds when the motion
// answers. Let go of the device. It commands forces by itself, so do not call it in a tick.

#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <array>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

struct latency_parameters {
  double force = 0.5;  ///< size of the force [N]; joints: [N·m]
  int ticks = 4000;    ///< length of the measurement, 500 to 1000000
  int axis = 0;
  std::uint64_t seed = 1;

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(force)) return {"force", force, "finite and > 0 N"};
    if (ticks < 500 || ticks > 1000000) {
      return {"ticks", static_cast<double>(ticks), "500 to 1000000"};
    }
    if (axis < 0) return {"axis", static_cast<double>(axis), "≥ 0, below the degrees of freedom"};
    return {};
  }
};

struct latency_found {
  int ticks = 0;           ///< from a command to its holding, to the nearest tick
  double exactly = 0.0;    ///< the same with its fraction: 0.5 for a change in mid-tick
  double explained = 0.0;  ///< share of the motion that the force explains, a load aside, in [0, 1]
  int sensor_ticks = 1;    ///< period of the sensor [ticks]: 1 if it is as fast as the loop
  const char* problem = nullptr;  ///< a sentence if the numbers are not reliable, else null
};

namespace detail {

/// For any velocity, a mass m [kg] answers to commands c(n) [N] that are held d ticks late by
///     y(n) = x(n) − 2x(n−W) + x(n−2W) = T²/m Σ w(j) c(n−1−j−d),     w the triangle of base 2W with cut corners
/// A damper adds the same sum over the velocity, dry friction over its sign, and a constant load adds a constant. The pair of d and d + 1 that explains y best by least squares is the latency; the shares of the two
/// give its fraction.
class latency_fit {
 public:
  /// Adds a command [N], and the position [m] at the end of the tick that began with it.
  void book(double command, double place) noexcept {
    shift(commands_, command);
    shift(places_, place);
    const double moved = places_[0] - places_[1];
    shift(moved_, moved);
    shift(turned_, moved > 0.0 ? 1.0 : moved < 0.0 ? -1.0 : 0.0);
    if (++booked_ < span) return;
    const double y = places_[0] - 2.0 * places_[window] + places_[2 * window];
    std::array<double, longest> u{};
    for (std::size_t d = 0; d < u.size(); ++d) u[d] = triangle(commands_, d);
    const double damped = triangle(moved_, 0);
    const double rubbed = triangle(turned_, 0);
    const double load = window * window;  // y under a load of 1 N, in units of T²/m
    yy_ += y * y;
    for (std::size_t d = 0; d + 1 < longest; ++d) {
      const std::array<double, causes> of{u[d], u[d + 1], damped, rubbed, load};
      for (std::size_t i = 0; i < causes; ++i) {
        sums_[d][i][causes] += of[i] * y;
        for (std::size_t j = 0; j < causes; ++j) sums_[d][i][j] += of[i] * of[j];
      }
    }
  }
  /// Adds a missing sample: no y spans it.
  void interrupt() noexcept { booked_ = 0; }

  void conclude(latency_found& found) const noexcept {
    for (std::size_t d = 0; d + 1 < longest; ++d) {
      shares share{};
      const auto& of_load = sums_[d][causes - 1];
      const double by_load = of_load[causes] * of_load[causes] / of_load[causes - 1];
      if (!(yy_ > by_load) || !solve(sums_[d], share)) continue;
      double explained = -by_load;
      for (std::size_t i = 0; i < causes; ++i) explained += share[i] * sums_[d][i][causes];
      explained /= yy_ - by_load;
      if (!(explained > found.explained) || !(share[0] + share[1] > 0.0)) continue;
      found.explained = explained;
      const double fraction = share[1] / (share[0] + share[1]);
      found.exactly = kernels::larger(static_cast<double>(d) + fraction, 0.0);
    }
    found.ticks = static_cast<int>(found.exactly + 0.5);
  }

 private:
  static constexpr std::size_t window = 10;  // W [ticks]
  static constexpr std::size_t longest = 9;  // lags tried: 0 to 8
  static constexpr int span = 2 * window + longest;
  using line = std::array<double, span>;
  static constexpr std::size_t causes = 5;  // two lags, damper, dry friction, load
  using shares = std::array<double, causes>;
  using normal_equations =
      std::array<std::array<double, causes + 1>, causes>;  // and the right side

  static void shift(line& of, double newest) noexcept {
    for (std::size_t j = of.size() - 1; j > 0; --j) of[j] = of[j - 1];
    of[0] = newest;
  }
  /// Σ w(j) of(n−1−j−d), where of[0] belongs to the tick that ended at n.
  [[nodiscard]] static double triangle(const line& of, std::size_t d) noexcept {
    double sum = 0.0;
    for (std::size_t j = 0; j < 2 * window; ++j) {
      const double w = static_cast<double>(j < window ? j : 2 * window - 1 - j) + 0.5;
      sum += w * of[j + d];
    }
    return sum;
  }
  /// Gaussian elimination; a cause that depends linearly on the others is left out.
  [[nodiscard]] static bool solve(normal_equations a, shares& share) noexcept {
    for (std::size_t i = 0; i < causes; ++i) {
      if (!(a[i][i] > 0.0)) continue;
      for (std::size_t k = i + 1; k < causes; ++k) {
        const double by = a[k][i] / a[i][i];
        const double before = a[k][k];
        for (std::size_t j = i; j < causes + 1; ++j) a[k][j] -= by * a[i][j];
        if (!(a[k][k] > 1e-9 * before)) a[k] = {};
      }
    }
    for (std::size_t i = causes; i-- > 0;) {
      double left = a[i][causes];
      for (std::size_t j = i + 1; j < causes; ++j) left -= a[i][j] * share[j];
      share[i] = a[i][i] > 0.0 ? left / a[i][i] : 0.0;
    }
    return a[0][0] > 0.0 && a[1][1] > 0.0;
  }

  line commands_{}, places_{}, moved_{}, turned_{};
  int booked_ = 0;
  double yy_ = 0.0;
  std::array<normal_equations, longest - 1> sums_{};
};

/// Finds the period of a sensor. A sensor k times slower than the loop shows a new place in every k-th tick only.
/// If a place repeats because the device rests, or moves by less than a step, the repeats have no such period.
class sensor_clock {
 public:
  void book(int tick, double place) noexcept {
    if (place == place_) return;
    if (changed_ >= 0) {
      const int passed = tick - changed_;
      for (std::size_t k = 2; k < divisible_.size(); ++k) {
        divisible_[k] += passed % static_cast<int>(k) == 0 ? 1 : 0;
      }
      ++intervals_;
    }
    const bool is_first = !(place_ == place_);  // its arrival may be earlier
    changed_ = is_first ? -1 : tick;
    place_ = place;
  }
  /// The longest period [ticks] that divides 19 of 20 intervals between two changes.
  [[nodiscard]] int period() const noexcept {
    for (std::size_t k = divisible_.size() - 1; k > 1 && intervals_ >= enough; --k) {
      if (divisible_[k] * 20 >= intervals_ * 19) return static_cast<int>(k);
    }
    return 1;
  }

 private:
  static constexpr int enough = 20;  // the slowest sensor has 30 in the shortest measurement
  std::array<int, 17> divisible_{};  // number of intervals that k divides
  int intervals_ = 0, changed_ = -1;
  double place_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace detail

/// Shakes `device`, and always commands zero force at the end.
template <port P, haptic_device_for<P> Device>
[[nodiscard]] latency_found measure_latency(Device& device,
                                            const latency_parameters& p = {}) noexcept {
  latency_found found;
  if (p.check() || p.axis >= P::dof) {
    found.problem = "a parameter is out of its range: see latency_parameters::check()";
    return found;
  }
  constexpr int chip = 8;  // ticks of one sign, then as many of the other: the axis comes back
  laws::samples random(p.seed);
  detail::latency_fit fit;
  detail::sensor_clock clock;
  double sign = 1.0;
  int refused = 0;
  for (int n = 0; n < p.ticks; ++n) {
    if (n % (2 * chip) == 0) sign = (random.bits() & 1U) != 0 ? 1.0 : -1.0;
    const double command = n % (2 * chip) < chip ? sign * p.force : -sign * p.force;
    typename P::effort f = P::zero();
    P::component(f, p.axis) = static_cast<typename P::scalar>(command);
    const auto sample = device.exchange(f);
    const typename P::pose x = sample.position;
    const auto place = static_cast<double>(P::component(x, p.axis));
    if (!sample.valid || !kernels::is_finite(place)) {
      ++refused;
      fit.interrupt();
      continue;
    }
    fit.book(command, place);
    clock.book(n, place);
  }
  static_cast<void>(device.exchange(typename P::effort(P::zero())));

  fit.conclude(found);
  found.sensor_ticks = clock.period();
  if (refused * 10 > p.ticks) {
    found.problem = "the device gave too few good samples";
  } else if (!(found.explained > 0.5)) {
    found.problem =
        "the force explains too little of the motion: let go of the device, raise `force`";
  } else if (found.sensor_ticks > 1) {
    found.problem = "the sensor is slower than the loop: tick when it has something new";
  } else if (kernels::magnitude(found.exactly - found.ticks) > 0.1) {
    found.problem = "the force changes in mid-tick: hold it from sample to sample";
  }
  return found;
}

}  // namespace v0
}  // namespace passive_haptics
