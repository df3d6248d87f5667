// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A dry friction that gives way little by little: several sliders side by side, each behind a spring of its own.
//
//     ph::basic_dual_ledger<ph::damping_and_sliders<3>> ledger{
//         .damping = {.coefficient = 0.05, .sliders = {{{0.05, 4e-6}, {0.06, 15e-6}, {0.04, 60e-6}}}},
//         .quantum = 5e-6};
//
// One slider with the mean presliding credits nothing of what motions within it lose; the stiff ones of a list are
// crossed by a tremor and pay for it. identification/slider_fit.hpp finds the list from a recording.

#include <passive_haptics/device/dry_friction.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Takes at least c joules a metre of slip, which differs from the motion by a deflection of p at most.
struct friction_slider {
  double coulomb{};                        ///< c [N], ≥ 0, a lower bound
  double presliding = detail::not_stated;  ///< p [m], ≥ 0, an upper bound
};

/// b·I and sliders (cₖ, pₖ) in every direction of motion: Prandtl's and Iwan's friction. To a bound it is
/// damping_and_friction with c = Σ cₖ and p = Σ cₖpₖ/c; a ledger credits each of them by itself, too, because the proof
/// is linear in the sliders (energy_observer/slider_credits.hpp; docs/design/mathematics.md § 6).
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
  static constexpr std::size_t slider_count = count;

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
