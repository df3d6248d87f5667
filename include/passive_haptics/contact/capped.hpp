// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact law with a stiffness of at most the device's budget (the menu is in spring.hpp).
//
//     constexpr auto budget = design::stiffness_budget(grip);
//     ph::capped law{ph::damped_spring{.mass = grip.mass, .force_limit = 9.0}, budget.stiffness};
//     ph::capped law{…, budget.stiffness, budget.working_capital};     // and softer where the ledger runs low

#include <passive_haptics/base/explanation.hpp>
#include <passive_haptics/port/composing.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The law with K = min(K of the constraint, most) [N/m]. A soft wall that lasts is better than a stiff one whose
/// ledger is used up, so that the hand falls through; design::stiffness_budget computes `most`.
/// model.law().is_capped() says whether K was lowered.
///
/// With a working capital C [J] the stiffness is s K, and s follows the free energy E1 − f²/(2 s K), which is the
/// ledger less the energy that the wall's own spring will give back (ours). s moves towards free/(C/5), between 0.15
/// and 1: down by 0.3 per second, up by 0.02 per second and only while free > C/5. Without contact it is 1. So a force
/// of 1 N changes by at most 0.3 mN in a tick of 1 ms, and the wall softens before it is lost. s does not follow E1
/// itself, which swings with f²/(2K) in every kneading, so that K would rise when that costs most (encoders.md).
template <class Law>
struct capped {
  Law law{};
  double most{};             ///< largest stiffness [N/m]
  double working_capital{};  ///< C [J]; 0: the cap is constant

  constexpr capped() noexcept = default;
  constexpr capped(const Law& l, double stiffness, double capital = 0.0) noexcept
      : law(l), most(stiffness), working_capital(capital) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(most > 0.0))
      return {"most", most, "> 0 N/m; on encoders dry friction pays, stated as .friction"};
    if (!detail::not_negative(working_capital)) {
      return {"working_capital", working_capital, "finite and ≥ 0 J"};
    }
    return detail::fault_in(law);
  }
  template <class Space>
  class on;
};

template <class Law>
template <class Space>
class capped<Law>::on : public part_at<Law, Space> {
  using law_part = part_at<Law, Space>;

 public:
  using scalar = typename Space::scalar;
  template <class Parameters>
  static constexpr int takers = detail::takers<Parameters, Law, Space>;

  constexpr explicit on(const capped& p) noexcept
      : law_part(p.law),
        most_(detail::number<scalar>(p.most)),
        enough_(fifth_of(p.working_capital)) {}
  /// New parameters take effect at the next adopt().
  constexpr void set(const capped& p) noexcept {
    detail::take<Law, Space>(*this, p.law);
    most_ = detail::number<scalar>(p.most);
    enough_ = fifth_of(p.working_capital);
  }
  [[nodiscard]] constexpr capped parameters() const noexcept {
    capped p;
    if constexpr (detail::has_parameters<law_part>) p.law = law_part::parameters();
    p.most = static_cast<double>(most_);
    p.working_capital = enough_ > scalar(0) ? static_cast<double>(enough_) * 5.0 : 0.0;
    return p;
  }
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    detail::take<Law, Space>(*this, p);
  }

  constexpr void adopt(scalar K, scalar T, int late = 0) noexcept {
    is_capped_ = K > most_;
    stiffness_ = is_capped_ ? most_ : K;
    detail::tell(static_cast<law_part&>(*this), share_ * stiffness_, T, late);
  }
  /// Updates s after a tick with or without contact, from the ledger in the port's state.
  constexpr void follow(bool pressed, const auto& port) noexcept {
    bool moves = share_ < scalar(1);
    if (pressed && !moves) {
      moves = (port.energy - enough_) * scalar(2) * stiffness_ < Space::dot(port.held, port.held);
    }
    if (moves) [[unlikely]]
      near_to(pressed, port);
  }
  /// True if the constraint's K is above `most`.
  [[nodiscard]] constexpr bool is_capped() const noexcept { return is_capped_; }
  /// Why it is no stiffer: s, for the ledger runs low, or the cap; nothing if it is the law itself.
  [[nodiscard]] constexpr softened_by lowers() const noexcept {
    if (!is_capped_ && !(share_ < scalar(1))) return softened_by::nothing;
    const scalar shown = scalar(1) / law_part::depth(scalar(1), scalar(0));
    if (shown < share_ * stiffness_ * scalar(0.99)) return softened_by::nothing;
    return share_ < scalar(1) ? softened_by::ledger : softened_by::encoder_steps;
  }

 private:
  /// C/5 [J]; without a working capital a number below every ledger.
  [[nodiscard]] static constexpr scalar fifth_of(double capital) noexcept {
    return capital > 0.0 ? detail::number<scalar>(capital / 5.0) : -kernels::largest<scalar>();
  }
  [[gnu::cold, gnu::noinline]] constexpr void near_to(bool pressed, const auto& port) noexcept {
    const scalar square = Space::dot(port.held, port.held);
    const scalar free = port.energy - square / (scalar(2) * share_ * stiffness_);
    const scalar want = kernels::clamped(free / enough_, scalar(0.15), scalar(1));
    const scalar lower = share_ - scalar(0.3) * port.dt, higher = share_ + scalar(0.02) * port.dt;
    share_ = pressed ? kernels::clamped(want, lower, free > enough_ ? higher : share_) : scalar(1);
    detail::tell(static_cast<law_part&>(*this), share_ * stiffness_, port.longest_tick,
                 std::remove_cvref_t<decltype(port)>::latency);
  }

  scalar most_, enough_;      ///< [N/m], C/5 [J]
  scalar stiffness_{};        ///< K as capped [N/m]
  scalar share_ = scalar(1);  ///< s
  bool is_capped_ = false;
};

}  // namespace v0
}  // namespace passive_haptics
