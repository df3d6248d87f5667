// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The random numbers of a drawn scene: the same ones from a seed on every machine.

#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/device/eigen_space.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace experiments {

class draws {
 public:
  explicit draws(std::uint64_t seed) noexcept : random_(seed) {}
  [[nodiscard]] double between(double low, double high) noexcept {
    return low + (high - low) * (random_.number<double>() + 1.0) / 2.0;
  }
  /// A number between low and high, uniform in its logarithm.
  [[nodiscard]] double scale(double low, double high) noexcept {
    return low * std::exp(between(0.0, std::log(high / low)));
  }
  [[nodiscard]] bool chance(double p) noexcept { return between(0.0, 1.0) < p; }
  [[nodiscard]] int count(int low, int high) noexcept {
    return std::min(high, static_cast<int>(between(low, high + 1)));
  }
  [[nodiscard]] auto direction() noexcept {
    return random_.direction<passive_haptics::space<double, 3>>();
  }

 private:
  passive_haptics::laws::samples random_;
};

/// What a scene states, with seed 1; with another seed a number of that range in its place.
class redrawn {
 public:
  redrawn(int seed, std::uint64_t part) noexcept
      : stated_(seed == 1), from_((static_cast<std::uint64_t>(seed) << 32U) + part) {}
  [[nodiscard]] double operator()(double stated, double low, double high) noexcept {
    return stated_ ? stated : from_.scale(low, high);
  }

 private:
  bool stated_;
  draws from_;
};

}  // namespace experiments
