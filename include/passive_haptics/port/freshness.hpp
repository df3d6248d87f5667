// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How old news may grow: what to do when whoever publishes a constraint or a force falls silent.

#include <passive_haptics/base/parameter.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// What was said counts in full for `stale_after`, then fades to nothing over `fade`:
///     weight(age) = 1 while age ≤ stale_after, then 1 − (age − stale_after)/fade, then 0
/// For ever by default, because a world may have nothing to say.
struct freshness {
  double stale_after = std::numeric_limits<double>::infinity();  ///< [s]
  double fade = 0.05;                                            ///< [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(stale_after >= 0.0)) return {"stale_after", stale_after, "≥ 0 s"};
    if (!detail::positive(fade)) return {"fade", fade, "finite and > 0 s"};
    return {};
  }
  template <class Port>
  class on;
};

/// The rule, and the age of the newest news.
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
  constexpr void reset() noexcept {
    age_ = scalar(0);
    said_ = word::nothing_yet;
  }

  /// There is news.
  constexpr void hear() noexcept {
    said_ = word::here;
    age_ = scalar(0);
  }
  /// Its end is news, too: it fades from where it is, and nobody will call it stale.
  constexpr void release() noexcept {
    if (said_ != word::here) return;
    age_ = (scalar(1) - weight()) * fade_;
    said_ = word::gone;
  }
  /// Time goes by [s].
  constexpr void grow_older(scalar dt) noexcept { age_ += dt; }

  /// Has there ever been news?
  [[nodiscard]] constexpr bool heard() const noexcept { return said_ != word::nothing_yet; }
  /// It counts in full. Or it has not been renewed for too long, and fades.
  [[nodiscard]] constexpr bool current() const noexcept {
    return said_ == word::here && !(age_ > stale_after_);
  }
  [[nodiscard]] constexpr bool stale() const noexcept {
    return said_ == word::here && age_ > stale_after_;
  }
  /// How far it counts now, in [0, 1]; nothing before the first.
  [[nodiscard]] constexpr scalar weight() const noexcept {
    if (current()) return scalar(1);
    if (said_ == word::nothing_yet) return scalar(0);
    const scalar fading = said_ == word::gone ? age_ : age_ - stale_after_;
    return kernels::larger(scalar(1) - fading / fade_, scalar(0));
  }

 private:
  enum class word : std::uint8_t { nothing_yet, here, gone };

  scalar stale_after_{}, fade_{};
  scalar age_{};  ///< since the last news, or since they were over [s]
  word said_ = word::nothing_yet;
};

}  // namespace v0
}  // namespace passive_haptics
