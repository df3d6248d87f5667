// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Dampings with a dry (Coulomb) friction that is never below c. The dual_ledger credits its work.
//
//   damping_and_friction                b, c, p           the same in all directions of a space
//   diagonal_damping_and_friction<Dof>  b, c, p per axis  joints, or sliders along the axes
//
// Over its first micrometres, the presliding displacement p, dry friction is a spring and returns the energy that
// it stored, so a motion smaller than p dissipates almost nothing. That is why p must be stated along with c. A
// device is covered if its friction takes at least c joules per metre of slip, and if slip and motion never
// differ by more than p: sliders behind springs (Maxwell, Iwan), elasto-plastic and Stribeck friction qualify,
// Dahl's and LuGre's models do not (docs/design/mathematics.md § 6).
//
// State the least c, of the warm and worn device, and the largest p. Measure p as half the way from sliding in one
// direction to sliding in the other. Where each of n axes has a friction of its own, damping_and_friction
// takes p √n, because n springs give way together. A p of zero claims that the friction is rigid.

#include <passive_haptics/device/damping.hpp>

#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

[[nodiscard]] constexpr parameter_fault friction_fault(double c, double p) noexcept {
  if (!not_negative(c)) return {"friction", c, "finite and ≥ 0 N"};
  if (not_negative(p)) return {};
  return {"presliding", p, "finite and ≥ 0 m, stated: over how far the friction is elastic"};
}
/// The default presliding displacement, NaN, which check() refuses, so that p has to be stated.
inline constexpr double not_stated = std::numeric_limits<double>::quiet_NaN();

}  // namespace detail

/// b·I and a dry friction of at least c in every direction of motion, elastic over at most p. The ledger is also
/// credited with the work c|Δx|, and the strict bound is c + √(4BE) instead of √(4BE), because
///     min over s ≥ 0 of B s² − (F − c) s = −(F − c)₊²/(4B)
/// The idea is that of the enhanced force bounding approach (Baek, Park, Ryu); formula and proof are in
/// docs/design/mathematics.md § 2, Friction credit. A ledger in debt allows no force. § 6 has elastic friction.
struct damping_and_friction {
  double coefficient{};                    ///< b [N·s/m], > 0, a lower bound
  double coulomb{};                        ///< c [N], ≥ 0, a lower bound
  double presliding = detail::not_stated;  ///< p [m], ≥ 0, an upper bound

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(coefficient)) return {"damping", coefficient, "finite and > 0 N·s/m"};
    return detail::friction_fault(coulomb, presliding);
  }

  template <class Space>
  class on : public isotropic_damping::on<Space> {
    using damper = isotropic_damping::on<Space>;

   public:
    using typename damper::effort, typename damper::motion, typename damper::scalar;
    static_assert(detail::has_geometry<Space>,
                  "passive_haptics: damping_and_friction has one number for all directions of a "
                  "space: joints need diagonal_damping_and_friction");

    constexpr explicit on(const damping_and_friction& p) noexcept
        : damper(p.coefficient),
          c_(detail::number<scalar>(p.coulomb)),
          p_(detail::number<scalar>(p.presliding)),
          compliance_(c_ > scalar(0) ? scalar(p_ / (scalar(2) * c_)) : scalar(0)) {}
    [[nodiscard]] constexpr damping_and_friction parameters() const noexcept {
      return {.coefficient = damper::parameters().coefficient,
              .coulomb = static_cast<double>(c_),
              .presliding = static_cast<double>(p_)};
    }

    /// Δxᵀ (b/dt) Δx + c|Δx| [J], the energy taken if the friction is rigid; worst_outflow() is its convex conjugate.
    [[nodiscard]] constexpr scalar dissipated(const motion& dx, scalar dt) const noexcept {
      return viscous(dx, dt) + c_ * Space::norm(dx);
    }
    /// T (|f| − c)₊²/(4b) [J], the most energy that f can give to the hand in a tick of length T [s].
    [[nodiscard]] constexpr scalar worst_outflow(const effort& f, scalar T) const noexcept {
      const scalar beyond = kernels::larger(Space::norm(f) - c_, scalar(0));
      return T * beyond * beyond / (scalar(4) * this->along_axis(0));
    }
    [[nodiscard]] constexpr scalar affordable(const effort& f, scalar E, scalar T) const noexcept {
      if (!(E >= scalar(0))) return scalar(0);
      const scalar asked = Space::norm(f);
      const scalar most = (c_ + kernels::strict_force_bound(E, this->per_tick(f, T))) *
                          (scalar(1) - scalar(4) * kernels::rounding<scalar>());
      return asked <= most ? scalar(1) : most / asked;
    }

    static constexpr bool rubs = true;
    /// Δxᵀ (b/dt) Δx [J], the damper's part alone.
    [[nodiscard]] constexpr scalar viscous(const motion& dx, scalar dt) const noexcept {
      return damper::dissipated(dx, dt);
    }
    /// c [N], the part of a force along any direction that friction pays for.
    [[nodiscard]] constexpr scalar friction(const effort& /*along*/) const noexcept { return c_; }
    /// The friction force u with |u| ≤ c [N] that is nearest to f; f itself if |f| ≤ c.
    [[nodiscard]] constexpr effort friction_near(const effort& f) const noexcept {
      const scalar square = Space::dot(f, f);
      if (square <= c_ * c_ * (scalar(1) - kernels::rounding<scalar>())) return f;
      return f * (sure() / kernels::square_root(square));
    }
    /// c Δx/|Δx| [N], the friction force of a slip along Δx; zero for no motion.
    [[nodiscard]] constexpr effort friction_along(const motion& dx) const noexcept {
      const scalar square = Space::dot(dx, dx);
      if (!(square > kernels::smallest<scalar>() / std::numeric_limits<scalar>::epsilon())) {
        return Space::zero();
      }
      return dx * (sure() / kernels::square_root(square));
    }
    /// c [N], the largest |u|.
    [[nodiscard]] constexpr scalar most_friction() const noexcept { return c_; }
    /// p|Δu| [J], rounded up: the charge for a change Δu of the friction force that a certificate counts on (§ 6).
    [[nodiscard]] constexpr scalar hysteresis(const effort& change) const noexcept {
      return p_ * Space::norm(change) * (scalar(1) + kernels::rounding<scalar>());
    }
    /// |u|² p/(2c) [J], rounded up: the energy stored in the friction's springs at the friction force u.
    [[nodiscard]] constexpr scalar stored(const effort& u) const noexcept {
      return Space::dot(u, u) * compliance_ * (scalar(1) + kernels::rounding<scalar>());
    }
    /// ½ c p [J]: the most that these springs can store.
    [[nodiscard]] constexpr scalar most_stored() const noexcept { return c_ * p_ / scalar(2); }

   private:
    [[nodiscard]] constexpr scalar sure() const noexcept {
      return c_ * (scalar(1) - kernels::rounding<scalar>());
    }
    scalar c_, p_;
    scalar compliance_;  ///< p/(2c) [m/N], 0 without friction
  };
};

/// diag(b₁ … b_Dof), and on each axis or joint a dry friction cᵢ that is elastic over pᵢ. The ledger is credited
/// with Σ cᵢ|Δxᵢ|, and worst_outflow is Σ T(|fᵢ| − cᵢ)₊²/(4bᵢ). The share of a force that E covers is
///     s = s₀ + (1 − s₀) √(E/W),    s₀ = the least cᵢ/|fᵢ|, at most 1,    W = worst_outflow of the whole force
/// since W(s f) ≤ ((s − s₀)/(1 − s₀))² W axis by axis (ours).
template <int Dof>
struct diagonal_damping_and_friction {
  using numbers = std::array<double, static_cast<std::size_t>(Dof)>;

  numbers coefficients{};             ///< bᵢ [N·s/m], > 0, lower bounds
  numbers coulomb{};                  ///< cᵢ [N], ≥ 0, lower bounds
  numbers presliding = not_stated();  ///< pᵢ [m], ≥ 0, upper bounds

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      if (!detail::positive(coefficients[i])) {
        return {"damping", coefficients[i], "every axis finite and > 0 N·s/m"};
      }
      if (const auto fault = detail::friction_fault(coulomb[i], presliding[i])) return fault;
    }
    return {};
  }
  template <class Port>
  class on;

 private:
  [[nodiscard]] static constexpr numbers not_stated() noexcept {
    numbers all{};
    all.fill(detail::not_stated);
    return all;
  }
};

template <int Dof>
template <class Port>
class diagonal_damping_and_friction<Dof>::on : public diagonal_damping<Dof>::template on<Port> {
  using dampers = typename diagonal_damping<Dof>::template on<Port>;

 public:
  using typename dampers::effort, typename dampers::motion, typename dampers::scalar;

  constexpr explicit on(const diagonal_damping_and_friction& p) noexcept
      : dampers(diagonal_damping<Dof>{p.coefficients}),
        c_(detail::numbers<scalar>(p.coulomb)),
        p_(detail::numbers<scalar>(p.presliding)) {}
  [[nodiscard]] constexpr diagonal_damping_and_friction parameters() const noexcept {
    return {.coefficients = dampers::parameters().coefficients,
            .coulomb = detail::numbers<double>(c_),
            .presliding = detail::numbers<double>(p_)};
  }

  [[nodiscard]] constexpr scalar dissipated(const motion& dx, scalar dt) const noexcept {
    return viscous(dx, dt) +
           sum([&](int i) { return c(i) * kernels::magnitude(Port::component(dx, i)); });
  }
  [[nodiscard]] constexpr scalar worst_outflow(const effort& f, scalar T) const noexcept {
    return dampers::worst_outflow(beyond(f), T);
  }
  /// (|fᵢ| − cᵢ)₊, the part of f that friction does not pay for [N].
  [[nodiscard]] constexpr effort beyond(const effort& f) const noexcept {
    effort costs = f;
    for (int i = 0; i < Dof; ++i) {
      scalar& along = Port::component(costs, i);
      along = kernels::larger(kernels::magnitude(along) - c(i), scalar(0));
    }
    return costs;
  }
  /// cᵢ + (|fᵢ| − cᵢ) bᵢ/(bᵢ + λ) with the sign of fᵢ where |fᵢ| > cᵢ, else fᵢ. (§ 2, nearest)
  [[nodiscard]] constexpr effort yielding(const effort& f, scalar lambda) const noexcept {
    const effort free = friction_near(f);
    return free + dampers::yielding(effort(f - free), lambda);
  }
  [[nodiscard]] constexpr scalar affordable(const effort& f, scalar E, scalar T) const noexcept {
    if (!(E >= scalar(0))) return scalar(0);
    const scalar margin = scalar(1) - scalar(4) * kernels::rounding<scalar>();
    scalar free(1);
    for (int i = 0; i < Dof; ++i) {
      const scalar along = kernels::magnitude(Port::component(f, i));
      if (along * free > c(i)) free = c(i) / along;
    }
    if (free == scalar(1)) return scalar(1);
    free *= margin;
    return free + (scalar(1) - free) * margin * kernels::strict_scale(E, worst_outflow(f, T));
  }

  static constexpr bool rubs = true;
  [[nodiscard]] constexpr scalar viscous(const motion& dx, scalar dt) const noexcept {
    return dampers::dissipated(dx, dt);
  }
  /// The least Σ cᵢ|Δxᵢ| per metre of motion along f, for any motion across f [N].
  [[nodiscard]] constexpr scalar friction(const effort& along) const noexcept {
    const scalar length = Port::norm(along);
    scalar least = kernels::largest<scalar>();
    for (int i = 0; i < Dof; ++i) {
      const scalar share = kernels::magnitude(Port::component(along, i));
      if (share > scalar(0)) least = kernels::smaller(least, c(i) * (length / share));
    }
    return length > scalar(0) ? least : scalar(0);
  }
  [[nodiscard]] constexpr effort friction_near(const effort& f) const noexcept {
    effort nearest = f;
    for (int i = 0; i < Dof; ++i) {
      scalar& along = Port::component(nearest, i);
      along = kernels::clamped(along, scalar(-c(i)), c(i));
    }
    return nearest;
  }
  [[nodiscard]] constexpr effort friction_along(const motion& dx) const noexcept {
    effort against = dx;
    for (int i = 0; i < Dof; ++i) {
      scalar& along = Port::component(against, i);
      along = along > scalar(0) ? c(i) : along < scalar(0) ? -c(i) : scalar(0);
    }
    return against;
  }
  [[nodiscard]] constexpr scalar most_friction() const noexcept {
    return kernels::square_root(sum([&](int i) { return c(i) * c(i); }));
  }
  [[nodiscard]] constexpr scalar hysteresis(const effort& change) const noexcept {
    return sum([&](int i) { return p(i) * kernels::magnitude(Port::component(change, i)); }) *
           (scalar(1) + kernels::rounding<scalar>());
  }
  [[nodiscard]] constexpr scalar stored(const effort& u) const noexcept {
    const auto of = [&](int i) {
      const scalar along = Port::component(u, i);
      return c(i) > scalar(0) ? along * along * (p(i) / (scalar(2) * c(i))) : scalar(0);
    };
    return sum(of) * (scalar(1) + kernels::rounding<scalar>());
  }
  [[nodiscard]] constexpr scalar most_stored() const noexcept {
    return sum([&](int i) { return c(i) * p(i) / scalar(2); });
  }

 private:
  [[nodiscard]] static constexpr scalar sum(const auto& of) noexcept {
    scalar all(0);
    for (int i = 0; i < Dof; ++i) all += of(i);
    return all;
  }
  [[nodiscard]] constexpr scalar c(int i) const noexcept { return c_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] constexpr scalar p(int i) const noexcept { return p_[static_cast<std::size_t>(i)]; }
  std::array<scalar, static_cast<std::size_t>(Dof)> c_, p_;
};

}  // namespace v0
}  // namespace passive_haptics
