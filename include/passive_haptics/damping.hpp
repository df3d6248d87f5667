// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The physical damping of the device: what every guarantee is paid with.
//
//   isotropic_damping      one b for all directions                       the usual case
//   diagonal_damping       b per axis, in the frame it was identified in  unequal joints or axes
//   damping_and_friction   b and a dry friction that is always there      credits f_c|Δx| too
//
// Not offered: a full matrix (rotate into its principal axes), a pose-dependent one (use its lower
// bound). All guarantees scale with b, so use a LOWER bound of the identified value, say half.

#include <passive_haptics/event.hpp>
#include <passive_haptics/kernels.hpp>

namespace passive_haptics {
inline namespace v0 {

/// b·I. Converts from the plain number, so `.damping = 0.03` reads as it should.
template <class Space>
struct isotropic_damping {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  scalar coefficient{};  ///< b [N·s/m], > 0

  constexpr isotropic_damping() noexcept = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number with a name
  constexpr isotropic_damping(scalar b) noexcept : coefficient(b) {}

  /// Δxᵀ (b/dt) Δx [J], never more than the damper took in a tick of length dt. (2.4, lemma L1)
  [[nodiscard]] constexpr scalar dissipated(const vector& displacement, scalar dt) const noexcept {
    return coefficient * Space::dot(displacement, displacement) / dt;
  }
  /// ¼ fᵀ (b/T)⁻¹ f [J], the most energy f can hand out in a tick of length T. (2.14, lemma L3)
  [[nodiscard]] constexpr scalar worst_outflow(const vector& force, scalar T) const noexcept {
    return T * Space::dot(force, force) / (scalar(4) * coefficient);
  }
  /// The factor in [0, 1] that brings `force` down to what E [J] covers for T [s]. (2.17)
  [[nodiscard]] constexpr scalar affordable(const vector& force, scalar E,
                                            scalar T) const noexcept {
    return kernels::strict_scale(E, worst_outflow(force, T));
  }
  /// B = b/T [N/m] along a direction, given by any force along it.
  [[nodiscard]] constexpr scalar per_tick(const vector& /*along*/, scalar T) const noexcept {
    return coefficient / T;
  }
  /// b of axis i [N·s/m].
  [[nodiscard]] constexpr scalar along_axis(int /*i*/) const noexcept { return coefficient; }
  /// Dry friction [N]: none is assumed.
  [[nodiscard]] static constexpr scalar friction() noexcept { return scalar(0); }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (coefficient > scalar(0) && kernels::is_finite(coefficient)) return {};
    return {"damping", coefficient, "finite and > 0 N·s/m"};
  }
};

/// diag(b₁ … b_Dof).
template <class Space>
struct diagonal_damping {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  typename Space::coordinates coefficients{};  ///< b per axis [N·s/m], each > 0

  [[nodiscard]] constexpr scalar dissipated(const vector& displacement, scalar dt) const noexcept {
    return Space::weighted_square(coefficients, displacement) / dt;
  }
  [[nodiscard]] constexpr scalar worst_outflow(const vector& force, scalar T) const noexcept {
    return T * Space::inversely_weighted_square(coefficients, force) / scalar(4);
  }
  [[nodiscard]] constexpr scalar affordable(const vector& force, scalar E,
                                            scalar T) const noexcept {
    return kernels::strict_scale(E, worst_outflow(force, T));
  }
  /// 1/(uᵀ(b/T)⁻¹u) for the direction u of `along`.
  [[nodiscard]] constexpr scalar per_tick(const vector& along, scalar T) const noexcept {
    return Space::dot(along, along) / (scalar(4) * worst_outflow(along, T));
  }
  [[nodiscard]] constexpr scalar along_axis(int i) const noexcept {
    return Space::component(coefficients, i);
  }
  [[nodiscard]] static constexpr scalar friction() noexcept { return scalar(0); }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    const scalar least = Space::smallest(coefficients);
    if (least > scalar(0) && Space::is_finite(coefficients)) return {};
    return {"damping", least, "every axis finite and > 0 N·s/m"};
  }
};

/// b·I and dry (Coulomb) friction of at least f_c in every direction of motion: credits the work
/// f_c|Δx| too, and lets out f_c + √(4BE) instead of √(4BE). Idea of the enhanced force bounding
/// approach (Baek, Park, Ryu; docs/design/mathematics.md § 2(a)); formula and proof there:
///     min over s ≥ 0 of B s² − (F − f_c) s = −(F − f_c)₊²/(4B)
/// Friction that is less than stated, when warm or worn, breaks every guarantee: take the least.
template <class Space>
struct damping_and_friction {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  scalar coefficient{};  ///< b [N·s/m], > 0, a lower bound
  scalar coulomb{};      ///< f_c [N], ≥ 0, a lower bound

  [[nodiscard]] constexpr scalar dissipated(const vector& displacement, scalar dt) const noexcept {
    const scalar square = Space::dot(displacement, displacement);
    return coefficient * square / dt + coulomb * kernels::square_root(square);
  }
  [[nodiscard]] constexpr scalar worst_outflow(const vector& force, scalar T) const noexcept {
    const scalar beyond = kernels::larger(Space::norm(force) - coulomb, scalar(0));
    return T * beyond * beyond / (scalar(4) * coefficient);
  }
  [[nodiscard]] constexpr scalar affordable(const vector& force, scalar E,
                                            scalar T) const noexcept {
    if (!(E >= scalar(0))) return scalar(0);
    const scalar asked = Space::norm(force);
    const scalar most = (coulomb + kernels::strict_force_bound(E, coefficient / T)) *
                        (scalar(1) - kernels::rounding<scalar>());
    return asked <= most ? scalar(1) : most / asked;
  }
  [[nodiscard]] constexpr scalar per_tick(const vector& /*along*/, scalar T) const noexcept {
    return coefficient / T;
  }
  [[nodiscard]] constexpr scalar along_axis(int /*i*/) const noexcept { return coefficient; }
  [[nodiscard]] constexpr scalar friction() const noexcept { return coulomb; }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (!(coefficient > scalar(0)) || !kernels::is_finite(coefficient)) {
      return {"damping", coefficient, "finite and > 0 N·s/m"};
    }
    if (!(coulomb >= scalar(0)) || !kernels::is_finite(coulomb)) {
      return {"friction", coulomb, "finite and ≥ 0 N"};
    }
    return {};
  }
};

}  // namespace v0
}  // namespace passive_haptics
