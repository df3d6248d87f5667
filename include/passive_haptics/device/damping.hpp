// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The physical damping of the device, which pays for every guarantee, counted in joules.
//
//   isotropic_damping      one b for all directions                       the usual case
//   diagonal_damping       b per axis, in the frame it was identified in  unequal axes, joints
//   damping_and_friction   b and a dry friction that is always there      dry_friction.hpp
//
// Not offered: a full matrix (rotate into its principal axes), a pose-dependent one (use its lower
// bound). All guarantees scale with b, so state a LOWER bound of it, say half the identified value.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/device/space.hpp>

#include <array>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// b of the axis of a port that damps least, and of the one that damps most [N·s/m].
template <class P>
[[nodiscard]] constexpr typename P::scalar least_damping(const auto& damping) noexcept {
  typename P::scalar b = damping.along_axis(0);
  for (int i = 1; i < P::dof; ++i) b = kernels::smaller(b, damping.along_axis(i));
  return b;
}
template <class P>
[[nodiscard]] constexpr typename P::scalar most_damping(const auto& damping) noexcept {
  typename P::scalar b = damping.along_axis(0);
  for (int i = 1; i < P::dof; ++i) b = kernels::larger(b, damping.along_axis(i));
  return b;
}
}  // namespace detail

/// b·I. Converts from the plain number, so `.damping = 0.03` reads as it should.
struct isotropic_damping {
  double coefficient{};  ///< b [N·s/m], > 0

  constexpr isotropic_damping() noexcept = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number with a name
  constexpr isotropic_damping(double b) noexcept : coefficient(b) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (detail::positive(coefficient)) return {};
    return {"damping", coefficient, "finite and > 0 N·s/m"};
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;
    using motion = typename Space::motion;
    using effort = typename Space::effort;
    static_assert(
        detail::has_geometry<Space>,
        "passive_haptics: isotropic_damping has one number for all directions of a space: "
        "joints need diagonal_damping");

    constexpr explicit on(const isotropic_damping& p) noexcept
        : b_(detail::number<scalar>(p.coefficient)) {}
    [[nodiscard]] constexpr isotropic_damping parameters() const noexcept {
      return static_cast<double>(b_);
    }

    /// Δxᵀ (b/dt) Δx [J], never more than the damper took in a tick of length dt. (2.4, lemma L1)
    [[nodiscard]] constexpr scalar dissipated(const motion& dx, scalar dt) const noexcept {
      return b_ * Space::dot(dx, dx) / dt;
    }
    /// ¼ fᵀ (b/T)⁻¹ f [J], the most energy f can hand out in a tick of length T. (2.14, lemma L3)
    [[nodiscard]] constexpr scalar worst_outflow(const effort& f, scalar T) const noexcept {
      return T * Space::dot(f, f) / (scalar(4) * b_);
    }
    /// (b/T) Δx [N], the force of the damper against a motion of constant speed.
    [[nodiscard]] constexpr effort force(const motion& dx, scalar T) const noexcept {
      return dx * (b_ / T);
    }
    /// The share of f, in [0, 1], that E [J] covers for T [s]. (2.17)
    [[nodiscard]] constexpr scalar affordable(const effort& f, scalar E, scalar T) const noexcept {
      return kernels::strict_scale(E, worst_outflow(f, T));
    }
    /// B = b/T [N/m] along a direction, given by any force along it.
    [[nodiscard]] constexpr scalar per_tick(const effort& /*along*/, scalar T) const noexcept {
      return b_ / T;
    }
    /// b of axis i [N·s/m].
    [[nodiscard]] constexpr scalar along_axis(int /*i*/) const noexcept { return b_; }
    static constexpr bool rubs = false;  ///< no dry friction is assumed

   private:
    scalar b_;
  };
};

/// diag(b₁ … b_Dof), in the frame of a space or joint by joint.
template <int Dof>
struct diagonal_damping {
  std::array<double, static_cast<std::size_t>(Dof)> coefficients{};  ///< b per axis [N·s/m], > 0

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (const double b : coefficients) {
      if (!detail::positive(b)) return {"damping", b, "every axis finite and > 0 N·s/m"};
    }
    return {};
  }

  template <class Port>
  class on {
   public:
    using scalar = typename Port::scalar;
    using motion = typename Port::motion;
    using effort = typename Port::effort;
    static_assert(Port::dof == Dof,
                  "passive_haptics: diagonal_damping needs one number for each axis of the port");

    constexpr explicit on(const diagonal_damping& p) noexcept
        : b_(detail::numbers<scalar>(p.coefficients)) {}
    [[nodiscard]] constexpr diagonal_damping parameters() const noexcept {
      return {detail::numbers<double>(b_)};
    }

    [[nodiscard]] constexpr scalar dissipated(const motion& dx, scalar dt) const noexcept {
      scalar sum(0);
      for (int i = 0; i < Dof; ++i) {
        const scalar along = Port::component(dx, i);
        sum += along * along * along_axis(i);
      }
      return sum / dt;
    }
    [[nodiscard]] constexpr scalar worst_outflow(const effort& f, scalar T) const noexcept {
      scalar sum(0);
      for (int i = 0; i < Dof; ++i) {
        const scalar along = Port::component(f, i);
        sum += along * along / along_axis(i);
      }
      return T * sum / scalar(4);
    }
    [[nodiscard]] constexpr effort force(const motion& dx, scalar T) const noexcept {
      effort f = dx;
      for (int i = 0; i < Dof; ++i) Port::component(f, i) *= along_axis(i) / T;
      return f;
    }
    [[nodiscard]] constexpr scalar affordable(const effort& f, scalar E, scalar T) const noexcept {
      return kernels::strict_scale(E, worst_outflow(f, T));
    }
    /// 1/(uᵀ(b/T)⁻¹u) for the direction u of `along`.
    [[nodiscard]] constexpr scalar per_tick(const effort& along, scalar T) const noexcept {
      return Port::dot(along, along) / (scalar(4) * worst_outflow(along, T));
    }
    [[nodiscard]] constexpr scalar along_axis(int i) const noexcept {
      return b_[static_cast<std::size_t>(i)];
    }
    static constexpr bool rubs = false;

   private:
    std::array<scalar, static_cast<std::size_t>(Dof)> b_;
  };
};

}  // namespace v0
}  // namespace passive_haptics
