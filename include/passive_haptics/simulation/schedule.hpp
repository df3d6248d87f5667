// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The times at which a slow environment answers, in virtual time, and the source of all randomness.
// The same seed gives the same numbers on every platform, which the distributions of <random> do not.
//
//   random_source     uniform numbers and directions
//   update_schedule   due(time): every 20-50 ms, at random (20-50 Hz), or at a fixed period
//   one_update_late   returns the value that it was given one update ago, as a pipelined environment does

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/simulation/components.hpp>

#include <cstdint>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// The samples of laws::samples, and 53 of their bits as a double. It takes eight bytes and no heap.
class random_source {
 public:
  constexpr explicit random_source(std::uint64_t seed = 1) noexcept : source_(seed) {}

  [[nodiscard]] constexpr std::uint64_t bits() noexcept { return source_.bits(); }
  /// In [0, 1), in steps of 2⁻⁵³.
  [[nodiscard]] constexpr double uniform() noexcept {
    return static_cast<double>(bits() >> 11U) * 0x1p-53;
  }
  [[nodiscard]] constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * uniform();
  }
  /// True with that probability.
  [[nodiscard]] constexpr bool chance(double probability) noexcept {
    return uniform() < probability;
  }
  /// A unit vector of uniform direction (a sign, a point of the circle or of the sphere), by rejection from
  /// the cube: on average 1.9 tries for the sphere. Of libm it uses the square root only.
  template <class Space>
  [[nodiscard]] constexpr typename physical<Space>::vector direction() noexcept {
    static_assert(Space::dof <= 3, "random_source::direction: rejection is for 1 to 3 axes");
    auto v = physical<Space>::zero();
    double square = 0.0;
    while (!(square > 1e-6 && square <= 1.0)) {
      for (int i = 0; i < Space::dof; ++i) component(v, i) = uniform(-1.0, 1.0);
      square = physical<Space>::dot(v, v);
    }
    return v / physical<Space>::norm(v);
  }

 private:
  laws::samples source_;
};

/// The first update is due at once, the next ones after periods drawn uniformly from
/// [shortest, longest) [s]. A period begins when an update was due, not when the caller polled, so late polls
/// do not lengthen it. Equal bounds give a fixed period.
class update_schedule {
 public:
  constexpr explicit update_schedule(std::uint64_t seed = 1, double shortest = 0.020,
                                     double longest = 0.050) noexcept
      : shortest_(shortest), longest_(longest), random_(seed) {}

  /// True if an update is due at the virtual time `time` [s], once per update; a late poll skips the missed ones.
  [[nodiscard]] constexpr bool due(double time) noexcept {
    if (!(time >= next_)) return false;
    next_ += random_.uniform(shortest_, longest_);
    if (next_ <= time) next_ = time + random_.uniform(shortest_, longest_);
    return true;
  }
  [[nodiscard]] constexpr double next() const noexcept { return next_; }  ///< time of the next [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(shortest_ > 0.0)) return {"shortest", shortest_, "> 0 s"};
    if (!(longest_ >= shortest_ && kernels::is_finite(longest_))) {
      return {"longest", longest_, "finite and ≥ shortest"};
    }
    return {};
  }

 private:
  double shortest_, longest_;
  double next_ = 0.0;
  random_source random_;
};

/// Returns the value of the update before, like an environment that needs one update to compute.
template <class T>
class one_update_late {
 public:
  constexpr explicit one_update_late(const T& first = {}) : last_(first) {}
  [[nodiscard]] constexpr T operator()(const T& now) { return std::exchange(last_, now); }

 private:
  T last_;
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
