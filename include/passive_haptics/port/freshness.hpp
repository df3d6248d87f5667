// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The age up to which a published constraint or force is used, and its fading after that.

#include <passive_haptics/base/parameter.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// The weight of a published value, by which its force is multiplied:
///     weight(age) = 1 while age ≤ stale_after, then 1 − (age − stale_after)/fade, then 0
/// By default it is 1 for ever, because a surface at rest need not be published again.
struct freshness {
  double stale_after = std::numeric_limits<double>::infinity();  ///< age of full weight [s]
  double fade = 0.05;                                            ///< time of the fading [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(stale_after >= 0.0)) return {"stale_after", stale_after, "≥ 0 s"};
    if (!detail::positive(fade)) return {"fade", fade, "finite and > 0 s"};
    return {};
  }
  template <class Port>
  class on;
};

/// The rule, and the age of the newest value.
template <class Port>
class freshness::on {
 public:
  using scalar = typename Port::scalar;

  constexpr explicit on(const freshness& p) noexcept { set(p); }
  constexpr void set(const freshness& p) noexcept {
    stale_after_ = detail::number<scalar>(p.stale_after);
    fade_ = detail::number<scalar>(p.fade);
  }
  [[nodiscard]] constexpr freshness parameters() const noexcept {
    return {.stale_after = static_cast<double>(stale_after_), .fade = static_cast<double>(fade_)};
  }
  constexpr void reset() noexcept { said_ = word::nothing_yet; }

  /// Notes that a new value has come.
  constexpr void hear() noexcept {
    said_ = word::here;
    age_ = scalar(0);
  }
  /// Ends the value: it fades from its present weight, and is not stale.
  constexpr void release() noexcept {
    if (said_ != word::here) return;
    age_ = (scalar(1) - weight()) * fade_;
    said_ = word::gone;
  }
  /// Adds dt [s] to the age.
  constexpr void grow_older(scalar dt) noexcept { age_ += dt; }

  /// True if a value has ever come.
  [[nodiscard]] constexpr bool heard() const noexcept { return said_ != word::nothing_yet; }
  /// current(): the weight is 1. stale(): the value is older than stale_after, and fades.
  [[nodiscard]] constexpr bool current() const noexcept {
    return said_ == word::here && !(age_ > stale_after_);
  }
  [[nodiscard]] constexpr bool stale() const noexcept {
    return said_ == word::here && age_ > stale_after_;
  }
  /// The present weight, in [0, 1]; 0 before the first value.
  [[nodiscard]] constexpr scalar weight() const noexcept {
    if (current()) return scalar(1);
    if (said_ == word::nothing_yet) return scalar(0);
    const scalar fading = said_ == word::gone ? age_ : age_ - stale_after_;
    return kernels::larger(scalar(1) - fading / fade_, scalar(0));
  }

 private:
  enum class word : std::uint8_t { nothing_yet, here, gone };

  scalar stale_after_{}, fade_{};
  scalar age_{};  ///< time since the last value, or since release() [s]
  word said_ = word::nothing_yet;
};

}  // namespace v0
}  // namespace passive_haptics
