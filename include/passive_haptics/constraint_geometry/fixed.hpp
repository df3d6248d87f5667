// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Supplies, which own the constraint of a contact.
//
//   fixed      one constraint that is known from the start and never moves
//   followed   the environment publishes targets, and the local model follows as fast as the bound allows

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// The fault for which prepare() refuses a constraint.
template <class Constraint>
[[nodiscard]] constexpr parameter_fault constraint_fault(Constraint c) noexcept {
  if (!(c.stiffness > 0) || !kernels::is_finite(c.stiffness)) {
    return {"stiffness", static_cast<double>(c.stiffness), "finite and > 0 N/m"};
  }
  if (c.prepare()) return {};
  return {"constraint", 0.0, "finite, with a normal or an area > 0"};
}
}  // namespace detail

/// One constraint that never changes: ph::fixed{ph::half_space<scene>{…}}.
template <class Constraint>
class fixed {
 public:
  using constraint_type = Constraint;
  using scalar = typename Constraint::scalar;
  static constexpr bool moves = false;

  constexpr fixed() noexcept = default;
  constexpr explicit fixed(const Constraint& c) noexcept : constraint_(c) {
    static_cast<void>(constraint_.prepare());  // check() reports the fault
  }
  [[nodiscard]] constexpr const Constraint& local() const noexcept { return constraint_; }
  [[nodiscard]] constexpr const Constraint& target() const noexcept { return constraint_; }
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return detail::constraint_fault(constraint_);
  }

 private:
  Constraint constraint_{};
};

}  // namespace v0
}  // namespace passive_haptics
