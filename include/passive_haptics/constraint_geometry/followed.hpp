// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A supply whose constraint the environment moves (the menu is in fixed.hpp).

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/port/freshness.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Keeps two constraints: the newest target of the environment and the present one of the local model.
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
  /// published(): a target has come. changed(), refused(): one has come, or was refused, since the last tick.
  [[nodiscard]] constexpr bool published() const noexcept { return news_.heard(); }
  [[nodiscard]] constexpr bool changed() const noexcept { return changed_; }
  [[nodiscard]] constexpr bool refused() const noexcept { return refused_; }
  /// current(): the newest target counts in full. stale(): no target came for longer than `stale_after`.
  [[nodiscard]] constexpr bool current() const noexcept { return news_.current(); }
  [[nodiscard]] constexpr bool stale() const noexcept { return news_.stale(); }
  /// True if the local model has reached the target.
  [[nodiscard]] constexpr bool together() const noexcept { return together_; }
  /// The factor of the force, in [0, 1], now and in the last tick; 0 before the first target.
  [[nodiscard]] constexpr scalar weight() const noexcept { return news_.weight(); }
  [[nodiscard]] constexpr scalar last_weight() const noexcept { return last_weight_; }

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return news_.parameters().check();
  }
  constexpr void set(const freshness& rule) noexcept { news_.set(rule); }
  /// Returns to the state before any target, also before a first target of the constructor.
  constexpr void reset() noexcept { *this = followed(news_.parameters()); }

  /// Takes a new constraint as the target. If prepare() refuses it, keeps the last good one and returns false.
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
  /// Notes that an unusable target has come.
  constexpr void refuse() noexcept { refused_ = true; }
  /// Removes the surface: the contact fades as with stale data, and ends.
  constexpr void release() noexcept { news_.release(); }
  /// For a tick without contact: the next one treats the newest target as new.
  constexpr void vanish() noexcept {
    changed_ = published();
    last_weight_ = scalar(0);
  }
  /// Adds dt [s] to the time since the last good target.
  constexpr void grow_older(scalar dt) noexcept { news_.grow_older(dt); }

  /// Moves the local model to the target.
  [[gnu::always_inline]] constexpr void sync() noexcept {
    if (together_) return;
    own_ = newest_;
    together_ = true;
  }
  /// Moves the local model towards the target so that x lies d [m] deep under the normal n. Its nodes start from
  /// their own positions if it was in contact (Fig. 2.5), else from those of the target (2.33).
  [[gnu::always_inline]] constexpr void approach(bool from_own, const vector& x, const vector& n,
                                                 scalar d) noexcept {
    own_ = (from_own ? own_ : newest_).toward(newest_, x, n, d);
    together_ = false;
  }
  /// Ends a tick, in which the force had the factor `weight`.
  constexpr void seen(scalar weight) noexcept {
    changed_ = refused_ = false;
    last_weight_ = weight;
  }

 private:
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS part_at<freshness, space_type> news_;
  bool changed_ = false;
  bool refused_ = false;
  bool together_ = true;
  scalar last_weight_{};  // weight() in the last tick
  Constraint newest_{}, own_{};
};

}  // namespace v0
}  // namespace passive_haptics
