// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Supplies: who owns the constraint and who moves it.
//
//   rigid       one constraint, known from the start, never moving: no second copy, no age
//   following   the environment publishes, the local model follows as fast as the bound allows

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// What prepare() refuses, in words.
template <class Constraint>
[[nodiscard]] constexpr auto constraint_fault(Constraint c) noexcept {
  using scalar = typename Constraint::space_type::scalar;
  if (!(c.stiffness > scalar(0)) || !kernels::is_finite(c.stiffness)) {
    return parameter_fault<scalar>{"stiffness", c.stiffness, "finite and > 0 N/m"};
  }
  if (c.prepare()) return parameter_fault<scalar>{};
  return parameter_fault<scalar>{"constraint", scalar(0), "finite, with a normal or an area > 0"};
}
}  // namespace detail

/// One constraint for good: ph::rigid{ph::half_space<scene>{…}}.
template <class Constraint>
class rigid {
 public:
  using constraint_type = Constraint;
  using space_type = typename Constraint::space_type;
  using scalar = typename space_type::scalar;
  static constexpr bool moves = false;

  constexpr rigid() noexcept = default;
  constexpr explicit rigid(const Constraint& c) noexcept : constraint_(c) {
    static_cast<void>(constraint_.prepare());  // check() says what prepare() refuses
  }
  [[nodiscard]] constexpr const Constraint& local() const noexcept { return constraint_; }
  [[nodiscard]] constexpr const Constraint& target() const noexcept { return constraint_; }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    return detail::constraint_fault(constraint_);
  }

 private:
  Constraint constraint_{};
};

/// What to do when the environment falls silent: hold for `stale_after`, then let the contact fade
/// to nothing over `fade`. Never by default, because a world may have nothing to say.
///     weight(age) = 1 while age ≤ stale_after, then 1 − (age − stale_after)/fade, then 0
template <class Scalar>
struct freshness {
  Scalar stale_after = std::numeric_limits<Scalar>::max();  ///< [s]
  Scalar fade = Scalar(0.05);                               ///< [s]

  [[nodiscard]] constexpr bool stale(Scalar age) const noexcept { return age > stale_after; }
  [[nodiscard]] constexpr Scalar weight(Scalar age) const noexcept {
    if (!stale(age)) return Scalar(1);
    return kernels::larger(Scalar(1) - (age - stale_after) / fade, Scalar(0));
  }
  [[nodiscard]] constexpr parameter_fault<Scalar> check() const noexcept {
    if (!(stale_after >= Scalar(0))) return {"stale_after", stale_after, "≥ 0 s"};
    if (!(fade > Scalar(0)) || !kernels::is_finite(fade)) return {"fade", fade, "finite and > 0 s"};
    return {};
  }
};

/// Two copies: the newest target from the environment (I) and the local model's own (i).
///     ph::following<ph::triangle<scene>>{{.stale_after = 0.2}}
///     ph::following{ph::half_space<scene>{…}}          with a first target to start from
template <class Constraint>
class following {
 public:
  using constraint_type = Constraint;
  using space_type = typename Constraint::space_type;
  using scalar = typename space_type::scalar;
  using vector = typename space_type::vector;
  static constexpr bool moves = true;

  constexpr following() noexcept = default;
  constexpr explicit following(const freshness<scalar>& rule) noexcept : rule_(rule) {}
  constexpr explicit following(const Constraint& first, const freshness<scalar>& rule = {}) noexcept
      : rule_(rule) {
    retarget(first);
  }

  [[nodiscard]] constexpr const Constraint& local() const noexcept { return own_; }
  [[nodiscard]] constexpr const Constraint& target() const noexcept { return newest_; }
  /// Has there ever been a target? Has one come, has one been refused since the last tick?
  [[nodiscard]] constexpr bool published() const noexcept { return published_; }
  [[nodiscard]] constexpr bool changed() const noexcept { return changed_; }
  [[nodiscard]] constexpr bool refused() const noexcept { return refused_; }
  /// Is the local model where the environment wants it?
  [[nodiscard]] constexpr bool together() const noexcept { return together_; }
  [[nodiscard]] constexpr bool stale() const noexcept { return published_ && rule_.stale(age_); }
  /// How far the contact counts now, and did in the last tick; 0 before the first target.
  [[nodiscard]] constexpr scalar weight() const noexcept {
    return published_ ? rule_.weight(age_) : scalar(0);
  }
  [[nodiscard]] constexpr scalar last_weight() const noexcept { return last_weight_; }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return rule_.check(); }

  /// Takes a new constraint, or refuses it and keeps the last good one.
  constexpr bool retarget(Constraint next) noexcept {
    if (!next.prepare()) {
      refused_ = true;
      return false;
    }
    newest_ = next;
    if (!published_) own_ = next;
    together_ = !published_;
    published_ = changed_ = true;
    age_ = scalar(0);
    return true;
  }
  /// Time goes by [s] since the last good target.
  constexpr void grow_older(scalar dt) noexcept { age_ += dt; }

  /// The local model takes the environment's constraint as it is.
  constexpr void sync() noexcept {
    if (together_) return;
    own_ = newest_;
    together_ = true;
  }
  /// The local model goes only so far: x is to lie d deep under the normal n. Its nodes come from
  /// its own if it was in contact (Fig. 2.5), from the environment's if not (2.33).
  constexpr void approach(bool from_own, const vector& x, const vector& n, scalar d) noexcept {
    own_ = (from_own ? own_ : newest_).toward(newest_, x, n, d);
    together_ = false;
  }
  /// The tick has seen what was new, and let the contact count for that weight.
  constexpr void seen(scalar weight) noexcept {
    changed_ = refused_ = false;
    last_weight_ = weight;
  }

 private:
  freshness<scalar> rule_{};
  scalar age_{};          // since the last good target [s]
  scalar last_weight_{};  // of the last tick
  bool published_ = false;
  bool changed_ = false;
  bool refused_ = false;
  bool together_ = true;
  Constraint newest_{}, own_{};
};

}  // namespace v0
}  // namespace passive_haptics
