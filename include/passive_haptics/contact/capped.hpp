// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact law that is never stiffer than what the device can pay for (the menu is in spring.hpp).
//
//     constexpr auto budget = design::stiffness_budget(grip);
//     ph::capped law{ph::damped_spring{.mass = grip.mass, .force_limit = 9.0}, budget.stiffness};
//     ph::capped law{…, budget.stiffness, budget.working_capital};     // and softer where the ledger runs low

#include <passive_haptics/port/composing.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The law, told K = min(K of the constraint, most). A soft wall that stays is better than a stiff one
/// whose ledger runs dry and that lets the hand fall through; how much is too much is what
/// design::stiffness_budget says. Softer than asked for is a fact about the device, so the law tells:
/// model.law().is_capped().
///
/// With a working capital C [J] the law follows the ledger: it is told s K. What the wall's own spring will not give
/// back, E1 − f²/(2 s K), is free, and s goes to s* = free/(C/5) between 0.15 and 1: down by 0.3 a second, up by 0.02 a
/// second and only while free > C/5; where nothing is pressed it is 1. So a force of 1 N changes by 0.3 mN in a tick of
/// 1 ms, and the wall is soft before it is lost. It follows the free energy because E1 itself swings with f²/(2K) in
/// every kneading: then K would rise where that is dear and fall where it brings nothing (docs/design/encoders.md).
template <class Law>
struct capped {
  Law law{};
  double most{};             ///< [N/m]
  double working_capital{};  ///< C [J]; 0: the cap stays where it is

  constexpr capped() noexcept = default;
  constexpr capped(const Law& l, double stiffness, double capital = 0.0) noexcept
      : law(l), most(stiffness), working_capital(capital) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(most > 0.0))
      return {"most", most, "> 0 N/m; a budget of 0 says that nothing is paid for"};
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
  /// The new ones count from the next adopt() on.
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
  /// A tick in which the surface is pressed, or not: the port's state says what is left in its ledger.
  constexpr void follow(bool pressed, const auto& port) noexcept {
    bool moves = share_ < scalar(1);
    if (pressed && !moves) {
      moves = (port.energy - enough_) * scalar(2) * stiffness_ < Space::dot(port.held, port.held);
    }
    if (moves) [[unlikely]]
      near_to(pressed, port);
  }
  /// Does the constraint ask for more than `most`?
  [[nodiscard]] constexpr bool is_capped() const noexcept { return is_capped_; }

 private:
  /// Where the cap stays no ledger is low.
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
