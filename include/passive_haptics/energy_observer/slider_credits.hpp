// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the sliders of a friction earn one by one, for dual_ledger: a tremor that is small for the largest presliding is
// large for the stiff sliders.

#include <passive_haptics/port/concepts.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// A friction that is a list of sliders: device/sliders.hpp.
template <class D>
concept has_sliders = requires(const D d) {
  D::slider_count;
  d.level(std::size_t{});
  d.give(std::size_t{});
};

/// Beside the ledger's own choice u = 0 each slider k may count on a uₖ, |uₖ| ≤ cₖ, that opposes the motion since it
/// turned back by pₖ: it earns uₖ·Δx̂, and a change of it by d costs pₖ|d| and ½ Σ qᵢ|dᵢ|. As |Σ dₖ| ≤ Σ |dₖ|, what one of
/// them earns is sure whatever the others do, so each is dropped by itself when it does not pay, and what it is ahead by
/// when it does is the ledger's. A `lead` is how far A − |uₖ|²pₖ/(2cₖ) is ahead of the ledger's own A [J].
template <class P, std::size_t N>
class slider_credits {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;

  /// The device is seen to have moved, and the ledger has booked `elsewhere` [J] for that. Returns what it may book [J].
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
      const scalar anew = -(doubt + scalar(3) * spring);  // it may begin again from u = 0
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
    typename P::stored_effort trail =
        P::zero();  ///< how far the device is from what it drags along [m]
    scalar lead{};
  };
  std::array<slider, N> sliders_{};
};

template <class D, class P>
struct sliders_of {
  struct type {};
};
template <has_sliders D, class P>
struct sliders_of<D, P> {
  using type = slider_credits<P, D::slider_count>;
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
