// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The physical damping of the device, which pays for every guarantee, counted in joules.
//
//   isotropic_damping      one b for all directions                       the usual case
//   diagonal_damping       b per axis, in the frame it was identified in  unequal axes, joints
//   damping_and_friction   b and a dry friction that is always there      dry_friction.hpp
//
// Where axes differ, what E1 covers is an ellipsoid, and a bound may take the effort in it that is nearest (covered()).
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

/// A damping with a number for each axis: where E covers a part of f only, each axis gives way by its own share.
template <class D, class P>
concept differs_by_axis = (P::dof > 1) && requires(const D d, const typename P::effort f) {
  { d.yielding(f, typename P::scalar{}) } -> std::same_as<typename P::effort>;
};

/// The λ [N·s/m] of the effort nearest to f that E [J] covers for T [s],
///     |fᵢ| ← cᵢ + (|fᵢ| − cᵢ)₊ bᵢ/(bᵢ + λ)     with    Σ T (|fᵢ| − cᵢ)₊²/(4bᵢ) = E  after it
/// from below: two or three of Newton's steps on 1/√Σ, which is concave, and never more than eight (§ 2, nearest). 0
/// where E covers nothing.
template <class P>
[[nodiscard]] constexpr typename P::scalar yield(const auto& damping, const typename P::effort& f,
                                                 typename P::scalar E,
                                                 typename P::scalar T) noexcept {
  using scalar = typename P::scalar;
  const scalar credit = kernels::spendable(E);
  if (!(credit > scalar(0))) return scalar(0);
  const scalar most = kernels::square_root(scalar(4) * credit / T);
  typename P::effort need = damping.beyond(f);  // |fᵢ|√bᵢ over the root of 4E/T
  for (int i = 0; i < P::dof; ++i) {
    P::component(need, i) *= kernels::square_root(damping.along_axis(i)) / most;
  }
  scalar lambda(0);
  for (int i = 0; i < P::dof;
       ++i) {  // it is no less than what the axes up to the i-th damping need
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
/// The effort nearest to f, in newtons or in newton metres axis by axis, that E [J] covers for T [s].
template <class P>
[[nodiscard]] constexpr typename P::effort nearest_covered(const auto& damping,
                                                           const typename P::effort& f,
                                                           typename P::scalar E,
                                                           typename P::scalar T) noexcept {
  const typename P::scalar share = damping.affordable(f, E, T);
  if (share == typename P::scalar(1)) return f;
  const typename P::effort left = damping.yielding(f, yield<P>(damping, f, E, T));
  return left * damping.affordable(left, E, T);  // what Newton has left, and rounding
}
/// Of the efforts that yield(λ) on the way to the nearest that is covered for any motion, each brought down by what
/// share_of() leaves of it, the one nearest to f: λ by halving, four times. One share for all is λ = 0 of them.
template <class P>
[[nodiscard]] constexpr typename P::effort nearest_of(const auto& damping,
                                                      const typename P::effort& f,
                                                      typename P::scalar most,
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
  if (least == scalar(0) || !(most > scalar(0))) return best;
  look(most);
  for (scalar step = most / scalar(2); step > most / scalar(32); step /= scalar(2)) {
    const scalar middle = at;
    if (middle < most) look(middle + step);
    if (middle > scalar(0)) look(middle - step);
  }
  return best;
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
    /// What of f costs the ledger anything: all of it.
    [[nodiscard]] constexpr const effort& beyond(const effort& f) const noexcept { return f; }
    /// fᵢ bᵢ/(bᵢ + λ), for the nearest effort that is covered.
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
