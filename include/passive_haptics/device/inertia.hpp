// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A lower bound M of the device's inertia, which limits how far the device can move within a tick. The norm
// ‖f‖ = √(fᵀM⁻¹f) [√J/s] measures how much an effort f can accelerate the device.
//
//   isotropic_inertia   one mass for all directions
//   diagonal_inertia    one per axis or joint: a diagonal matrix that is nowhere above the device's own

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {

/// m·I: ‖f‖ = |f|/√m.
struct isotropic_inertia {
  double mass{};  ///< m [kg], > 0: the smallest over all directions and poses

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (detail::positive(mass)) return {};
    return {"mass", mass, "finite and > 0 kg"};
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;
    constexpr explicit on(const isotropic_inertia& p) noexcept
        : mass_(detail::number<scalar>(p.mass)) {}
    [[nodiscard]] constexpr isotropic_inertia parameters() const noexcept {
      return {static_cast<double>(mass_)};
    }
    /// √(fᵀM⁻¹f) [√J/s].
    [[nodiscard]] constexpr scalar norm(const typename Space::effort& f) const noexcept {
      return kernels::square_root(scalar(Space::dot(f, f) / mass_));
    }

   private:
    scalar mass_;
  };
};

/// diag(m₁ … m_Dof) with xᵀ diag(m) x ≤ xᵀ M x for every x and in every pose, M the device's inertia. The diagonal
/// of M is too large where axes are coupled. For two axes, mᵢ = Mᵢᵢ − |M₁₂| is small enough.
template <int Dof>
struct diagonal_inertia {
  std::array<double, static_cast<std::size_t>(Dof)> masses{};  ///< [kg]; joints: [kg·m²]; > 0

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (const double m : masses) {
      if (!detail::positive(m)) return {"masses", m, "every axis finite and > 0 kg"};
    }
    return {};
  }

  template <class Port>
  class on {
   public:
    using scalar = typename Port::scalar;
    static_assert(Port::dof == Dof,
                  "passive_haptics: diagonal_inertia needs one number for each axis of the port");

    constexpr explicit on(const diagonal_inertia& p) noexcept
        : m_(detail::numbers<scalar>(p.masses)) {}
    [[nodiscard]] constexpr diagonal_inertia parameters() const noexcept {
      return {detail::numbers<double>(m_)};
    }
    [[nodiscard]] constexpr scalar norm(const typename Port::effort& f) const noexcept {
      scalar sum(0);
      for (int i = 0; i < Dof; ++i) {
        const scalar along = Port::component(f, i);
        sum += along * along / m_[static_cast<std::size_t>(i)];
      }
      return kernels::square_root(sum);
    }

   private:
    std::array<scalar, static_cast<std::size_t>(Dof)> m_;
  };
};

}  // namespace v0
}  // namespace passive_haptics
