// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Repeatable pseudo-random numbers, from which laws and simulations draw their samples.

#include <passive_haptics/base/kernels.hpp>

#include <cstdint>
#include <type_traits>

namespace passive_haptics {
inline namespace v0 {
namespace laws {

/// A repeatable source of numbers in [−1, 1), also at compile time: SplitMix64 of Steele, Lea and Flood (2014).
/// It is not for cryptography.
class samples {
 public:
  constexpr explicit samples(std::uint64_t seed) noexcept : state_(seed) {}

  [[nodiscard]] constexpr std::uint64_t bits() noexcept {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  template <class Scalar>
  [[nodiscard]] constexpr Scalar number() noexcept {
    return Scalar(static_cast<std::int32_t>(bits() >> 32U)) / Scalar(2147483648.0);
  }
  /// A pose, a motion or an effort of a port, with every component in [−1, 1).
  template <class Port>
  [[nodiscard]] constexpr typename Port::vector vector() noexcept {
    using scalar = typename Port::scalar;
    if constexpr (Port::dof == 1) {
      return number<scalar>();
    } else {
      typename Port::vector v = Port::zero();
      for (int i = 0; i < Port::dof; ++i) Port::component(v, i) = number<scalar>();
      return v;
    }
  }
  /// A unit vector in any direction, uniformly distributed.
  template <class Space>
  [[nodiscard]] constexpr typename Space::vector direction() noexcept {
    using scalar = typename Space::scalar;
    while (true) {
      const typename Space::vector v = vector<Space>();
      const scalar length = Space::norm(v);
      if (length > scalar(0.1) && length <= scalar(1)) return v / length;
    }
  }

 private:
  std::uint64_t state_;
};

/// The number of samples to draw: an eighth in a constant expression, which a compiler evaluates slowly.
[[nodiscard]] constexpr int enough(int samples_at_run_time) noexcept {
  return std::is_constant_evaluated() ? samples_at_run_time / 8 + 1 : samples_at_run_time;
}

/// Converts to true if a policy obeys every law that was tried; otherwise `broken` says which law it broke first.
struct verdict {
  const char* broken = nullptr;
  constexpr explicit operator bool() const noexcept { return broken == nullptr; }
};

}  // namespace laws
}  // namespace v0
}  // namespace passive_haptics
