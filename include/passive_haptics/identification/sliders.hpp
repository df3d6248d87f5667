// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Dry friction that begins to slip part by part: several sliders in parallel, each behind a spring of its own.
//
//     ph::basic_dual_ledger<ph::damping_and_sliders<3>> ledger{
//         .damping = {.coefficient = 0.05, .sliders = {{{0.05, 4e-6}, {0.06, 15e-6}, {0.04, 60e-6}}}},
//         .quantum = 5e-6};
//
// One slider with the mean presliding credits nothing for motions within that; of a list, the stiff sliders slip under
// a tremor, too, and are credited. slider_fit.hpp finds the list from a recording.

#include <passive_haptics/device/dry_friction.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {

/// Dissipates at least c joules for each metre of slip, which is the motion less a deflection of at most p.
struct friction_slider {
  double coulomb{};                        ///< c [N], ≥ 0, a lower bound
  double presliding = detail::not_stated;  ///< p [m], ≥ 0, an upper bound
};

namespace detail {
/// Beside u = 0 the ledger may assume for each slider k a force uₖ [N], |uₖ| ≤ cₖ, that opposes the motion since it
/// turned back by pₖ. It is credited uₖ·Δx̂ [J], and a change of it by d costs pₖ|d| + ½ Σ qᵢ|dᵢ|. As |Σ dₖ| ≤ Σ |dₖ|, the
/// credit of a slider does not depend on the others, so each starts anew from u = 0 when that has the larger lead, and a
/// positive lead is booked. `lead` is A − |uₖ|²pₖ/(2cₖ) less the A of the ledger [J] (docs/design/mathematics.md § 6).
template <class P, std::size_t N>
class slider_credits {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;

  /// Adds a measured motion `shown` [m], for which the ledger has booked `elsewhere` [J]; returns the energy to book [J].
  [[nodiscard]] constexpr scalar slip(scalar elsewhere, const motion& shown, const auto& damping,
                                      const auto& steps) noexcept {
    scalar all(0);
    for (std::size_t k = 0; k < N; ++k) {
      const scalar c = damping.level(k), p = damping.give(k);
      if (!(c > scalar(0))) continue;
      slider& one = sliders_[k];
      const scalar up = scalar(1) + kernels::rounding<scalar>();
      const scalar doubt = c * steps.travel_error() / scalar(2) * up,
                   spring = c * p / scalar(2) * up;
      const scalar anew = -(doubt + scalar(3) * spring);  // lead of a new start from u = 0
      one.lead = kernels::larger(one.lead, anew);

      effort trail = effort(one.trail) + shown;
      const scalar most = kernels::larger(p / scalar(2), steps.travel_error());
      const scalar length = P::norm(trail);
      effort u = one.friction;
      if (length > most) {
        trail = trail * (most / length);
        const effort now = trail * (c / most * (scalar(1) - kernels::rounding<scalar>()));
        const effort way = now - u;
        const scalar cost = (steps.doubt(way) + p * P::norm(way)) * up;
        const bool first = u == P::zero();
        one.lead -= cost + (first ? spring : scalar(0));
        if (one.lead < anew || first) one.lead = anew;
        u = now;
        one.friction = now;
      }
      one.trail = trail;
      const auto work = P::work(u, shown);
      one.lead +=
          work.joules - kernels::rounding<scalar>() * (work.passed + doubt + spring) - elsewhere;
      const scalar spare = one.lead - doubt - spring;
      if (spare > scalar(0) && spare < kernels::largest<scalar>() / scalar(8 * N)) {
        one.lead -= spare;
        all += spare * (scalar(1) - kernels::rounding<scalar>());
      }
    }
    return all;
  }

 private:
  struct slider {
    typename P::stored_effort friction = P::zero();  ///< uₖ [N]
    typename P::stored_effort trail = P::zero();     ///< x less the point that x drags along [m]
    scalar lead{};
  };
  std::array<slider, N> sliders_{};
};
}  // namespace detail

/// b·I and sliders (cₖ, pₖ) in every direction of motion: Prandtl's and Iwan's friction. To a bound it is
/// damping_and_friction with c = Σ cₖ and p = Σ cₖpₖ/c; a ledger credits each of them by itself, too, because the proof
/// is linear in the sliders (docs/design/mathematics.md § 6).
template <int N>
struct damping_and_sliders {
  static constexpr auto count = static_cast<std::size_t>(N);

  double coefficient{};  ///< b [N·s/m], > 0, a lower bound
  std::array<friction_slider, count> sliders{};

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(coefficient)) return {"damping", coefficient, "finite and > 0 N·s/m"};
    for (const friction_slider& s : sliders) {
      if (const auto fault = detail::friction_fault(s.coulomb, s.presliding)) return fault;
    }
    return {};
  }
  template <class Space>
  class on;

 private:
  template <class Space>
  friend class on;
  [[nodiscard]] constexpr damping_and_friction as_one() const noexcept {
    double c = 0.0, give = 0.0;
    for (const friction_slider& s : sliders) {
      c += s.coulomb;
      give += s.coulomb * s.presliding;
    }
    return {coefficient, c, c > 0.0 ? give / c : 0.0};
  }
};

template <int N>
template <class Space>
class damping_and_sliders<N>::on : public damping_and_friction::on<Space> {
  using one = damping_and_friction::on<Space>;

 public:
  using typename one::scalar;
  using credits = detail::slider_credits<Space, count>;  ///< their state in a dual_ledger

  constexpr explicit on(const damping_and_sliders& p) noexcept : one(p.as_one()), stated_(p) {}
  [[nodiscard]] constexpr damping_and_sliders parameters() const noexcept { return stated_; }
  [[nodiscard]] constexpr scalar level(std::size_t k) const noexcept {  ///< cₖ [N]
    return detail::number<scalar>(stated_.sliders[k].coulomb);
  }
  [[nodiscard]] constexpr scalar give(std::size_t k) const noexcept {  ///< pₖ [m]
    return detail::number<scalar>(stated_.sliders[k].presliding);
  }

 private:
  damping_and_sliders stated_;
};

}  // namespace v0
}  // namespace passive_haptics
