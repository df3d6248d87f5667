// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A supply whose constraint the environment moves (the menu is in fixed.hpp).
//
//   followed    the environment publishes, the local model follows as fast as the bound allows

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/port/freshness.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Two copies: the newest target from the environment (I) and the local model's own (i).
///     ph::followed<ph::triangle<scene>>{{.stale_after = 0.2}}
///     ph::followed{ph::half_space<scene>{…}}          with a first target to start from
template <class Constraint>
class followed {
 public:
  using constraint_type = Constraint;
  using space_type = typename Constraint::space_type;
  using scalar = typename space_type::scalar;
  using vector = typename space_type::vector;
  static constexpr bool moves = true;

  constexpr followed() noexcept : followed(freshness{}) {}
  constexpr explicit followed(const freshness& rule) noexcept : news_(rule) {}
  constexpr explicit followed(const Constraint& first, const freshness& rule = {}) noexcept
      : news_(rule) {
    update(first);
  }

  [[nodiscard]] constexpr const Constraint& local() const noexcept { return own_; }
  [[nodiscard]] constexpr const Constraint& target() const noexcept { return newest_; }
  /// Has there ever been a target? Has one come, has one been refused since the last tick?
  [[nodiscard]] constexpr bool published() const noexcept { return news_.heard(); }
  [[nodiscard]] constexpr bool changed() const noexcept { return changed_; }
  [[nodiscard]] constexpr bool refused() const noexcept { return refused_; }
  /// Does the newest target count in full, or has it been silent for too long?
  [[nodiscard]] constexpr bool current() const noexcept { return news_.current(); }
  [[nodiscard]] constexpr bool stale() const noexcept { return news_.stale(); }
  /// Is the local model where the environment wants it?
  [[nodiscard]] constexpr bool together() const noexcept { return together_; }
  /// How far the contact counts now, and did in the last tick; 0 before the first target.
  [[nodiscard]] constexpr scalar weight() const noexcept { return news_.weight(); }
  [[nodiscard]] constexpr scalar last_weight() const noexcept { return last_weight_; }

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return news_.parameters().check();
  }
  constexpr void set(const freshness& rule) noexcept { news_.set(rule); }
  /// As if nothing had ever been published.
  constexpr void reset() noexcept { *this = followed(news_.parameters()); }

  /// Takes a new constraint, or refuses it and keeps the last good one.
  constexpr bool update(Constraint next) noexcept {
    if (!next.prepare()) {
      refused_ = true;
      return false;
    }
    newest_ = next;
    if (!published()) own_ = next;
    together_ = !published();
    changed_ = true;
    news_.hear();
    return true;
  }
  /// Nothing is there any more: the contact fades, as it does when data are stale, and ends.
  constexpr void release() noexcept { news_.release(); }
  /// Time goes by [s] since the last good target.
  constexpr void grow_older(scalar dt) noexcept { news_.grow_older(dt); }

  /// The local model takes the environment's constraint as it is.
  [[gnu::always_inline]] constexpr void sync() noexcept {
    if (together_) return;
    own_ = newest_;
    together_ = true;
  }
  /// The local model goes only so far: x is to lie d deep under the normal n. Its nodes come from
  /// its own if it was in contact (Fig. 2.5), from the environment's if not (2.33).
  [[gnu::always_inline]] constexpr void approach(bool from_own, const vector& x, const vector& n,
                                                 scalar d) noexcept {
    own_ = (from_own ? own_ : newest_).toward(newest_, x, n, d);
    together_ = false;
  }
  /// The tick has seen what was new, and let the contact count for that weight.
  constexpr void seen(scalar weight) noexcept {
    changed_ = refused_ = false;
    last_weight_ = weight;
  }

 private:
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS part_at<freshness, space_type> news_;
  bool changed_ = false;
  bool refused_ = false;
  bool together_ = true;
  scalar last_weight_{};  // of the last tick
  Constraint newest_{}, own_{};
};

}  // namespace v0
}  // namespace passive_haptics
