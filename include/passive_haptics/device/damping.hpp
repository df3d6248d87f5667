// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The device's own viscous damping: the energy that it dissipates in a tick pays for every guarantee.
//
//   isotropic_damping      one b for all directions                       the usual case
//   diagonal_damping       b per axis, in the frame it was identified in  unequal axes, joints
//   damping_and_friction   b and a least dry friction c                   dry_friction.hpp
//
// Where axes differ, the efforts that E1 covers form an ellipsoid, and a bound takes the nearest one in it (§ 2).
//
// There is no full matrix (rotate into its principal axes) and no pose-dependent damping (state its lower
// bound). All guarantees scale with b, so state a LOWER bound of it, say half the identified value.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/device/space.hpp>

#include <array>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// The smallest and the largest b over the axes of a port [N·s/m]; joints: [N·m·s/rad].
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

/// Satisfied by a damping with a b for each axis, under which each axis of an effort is shortened by its own share.
template <class D, class P>
concept differs_by_axis = (P::dof > 1) && requires(const D d, const typename P::effort f) {
  { d.yielding(f, typename P::scalar{}) } -> std::same_as<typename P::effort>;
};

/// A lower bound of λ [N·s/m], the multiplier of the effort nearest to f that E [J] covers for T [s] (§ 2, nearest):
///     |fᵢ| ← cᵢ + (|fᵢ| − cᵢ)₊ bᵢ/(bᵢ + λ),  where the new |fᵢ| have  Σ T (|fᵢ| − cᵢ)₊²/(4bᵢ) = E
/// Newton's steps on the concave 1/√Σ rise towards it, two or three of them, at most eight. λ is 0 if E ≤ 0.
template <class P>
[[nodiscard]] constexpr typename P::scalar yield(const auto& damping, const typename P::effort& f,
                                                 typename P::scalar E,
                                                 typename P::scalar T) noexcept {
  using scalar = typename P::scalar;
  const scalar credit = kernels::spendable(E);
  if (!(credit > scalar(0))) return scalar(0);
  const scalar most = kernels::square_root(scalar(4) * credit / T);
  typename P::effort need = damping.beyond(f);  // becomes nᵢ = (|fᵢ| − cᵢ)₊ √(bᵢT/(4E))
  for (int i = 0; i < P::dof; ++i) {
    P::component(need, i) *= kernels::square_root(damping.along_axis(i)) / most;
  }
  scalar lambda(0);
  for (int i = 0; i < P::dof; ++i) {  // λ ≥ √(Σ nⱼ² over bⱼ ≤ bᵢ) − bᵢ for every i
    scalar square(0);
    for (int j = 0; j < P::dof; ++j) {
      const bool counts = damping.along_axis(j) <= damping.along_axis(i);
      if (counts) square += P::component(need, j) * P::component(need, j);
    }
    if (!(square < kernels::largest<scalar>())) return scalar(0);
    lambda = kernels::larger(lambda, kernels::square_root(square) - damping.along_axis(i));
  }
  for (int step = 0; step < 8; ++step) {
    scalar sum(0), slope(0);
    for (int i = 0; i < P::dof; ++i) {
      const scalar inverse = scalar(1) / (damping.along_axis(i) + lambda);
      const scalar part = P::component(need, i) * inverse;
      sum += part * part;
      slope += part * part * inverse;
    }
    if (!(sum > scalar(1) + scalar(1e-6))) break;
    lambda += sum / slope * (kernels::square_root(sum) - scalar(1));
  }
  return lambda;
}
/// The effort that E [J] covers for T [s] and that is nearest to f in newtons (joints: newton metres).
template <class P>
[[nodiscard]] constexpr typename P::effort nearest_covered(const auto& damping,
                                                           const typename P::effort& f,
                                                           typename P::scalar E,
                                                           typename P::scalar T) noexcept {
  const typename P::scalar share = damping.affordable(f, E, T);
  if (share == typename P::scalar(1)) return f;
  const typename P::effort left = damping.yielding(f, yield<P>(damping, f, E, T));
  return left * damping.affordable(left, E, T);  // for the rest of Newton's error, and rounding
}
/// The effort share_of(g) g nearest to f, where g = yielding(f, λ) and 0 ≤ λ ≤ most_of(). λ is searched by halving, four
/// times, from 0 (one share for all axes) and most_of() (the nearest effort under the strict bound).
template <class P>
[[nodiscard]] constexpr typename P::effort nearest_of(const auto& damping,
                                                      const typename P::effort& f,
                                                      const auto& most_of,
                                                      const auto& share_of) noexcept {
  using scalar = typename P::scalar;
  typename P::effort best = P::zero();
  scalar least = kernels::largest<scalar>(), at(0);
  const auto look = [&](scalar lambda) {
    const typename P::effort left = damping.yielding(f, lambda);
    const typename P::effort now = left * share_of(left);
    scalar square(0);
    for (int i = 0; i < P::dof; ++i) {
      const scalar off = P::component(f, i) - P::component(now, i);
      square += off * off;
    }
    if (!(square < least)) return;
    best = now;
    least = square;
    at = lambda;
  };
  look(scalar(0));
  const scalar most = least > scalar(0) ? most_of() : scalar(0);
  if (!(most > scalar(0))) return best;
  look(most);
  for (scalar step = most / scalar(2); step > most / scalar(32); step /= scalar(2)) {
    const scalar middle = at;
    if (middle < most) look(middle + step);
    if (middle > scalar(0)) look(middle - step);
  }
  return best;
}
}  // namespace detail

/// b·I, one damping for all directions. It converts from a number, as in `.damping = 0.03`.
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

    /// Δxᵀ (b/dt) Δx [J], the least that the damper takes in a tick of length dt [s]. (2.4, lemma L1)
    [[nodiscard]] constexpr scalar dissipated(const motion& dx, scalar dt) const noexcept {
      return b_ * Space::dot(dx, dx) / dt;
    }
    /// ¼ fᵀ (b/T)⁻¹ f [J], the most energy that f can give to the hand in a tick of length T [s]. (2.14, lemma L3)
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

/// diag(b₁ … b_Dof), along the axes of a space or joint by joint.
template <int Dof>
struct diagonal_damping {
  std::array<double, static_cast<std::size_t>(Dof)>
      coefficients{};  ///< bᵢ [N·s/m], > 0; joints: [N·m·s/rad]

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
    /// The part of f that has to be paid for: without dry friction, all of it.
    [[nodiscard]] constexpr const effort& beyond(const effort& f) const noexcept { return f; }
    /// fᵢ bᵢ/(bᵢ + λ), the nearest covered effort for its λ [N·s/m]. (§ 2, nearest)
    [[nodiscard]] constexpr effort yielding(const effort& f, scalar lambda) const noexcept {
      effort left = f;
      for (int i = 0; i < Dof; ++i) {
        Port::component(left, i) *= along_axis(i) / (along_axis(i) + lambda);
      }
      return left;
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
