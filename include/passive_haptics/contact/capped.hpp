// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact law that is never stiffer than what the device can pay for (the menu is in spring.hpp).
//
//     constexpr auto budget = design::stiffness_budget(grip);
//     ph::capped law{ph::damped_spring{.mass = grip.mass, .force_limit = 9.0}, budget.stiffness};

#include <passive_haptics/port/composing.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The law, told K = min(K of the constraint, most). A soft wall that stays is better than a stiff one
/// whose ledger runs dry and that lets the hand fall through; how much is too much is what
/// design::stiffness_budget says. Softer than asked for is a fact about the device, so the law tells:
/// model.law().is_capped().
template <class Law>
struct capped {
  Law law{};
  double most{};  ///< [N/m]

  constexpr capped() noexcept = default;
  constexpr capped(const Law& l, double stiffness) noexcept : law(l), most(stiffness) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(most > 0.0))
      return {"most", most, "> 0 N/m; a budget of 0 says that nothing is paid for"};
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
      : law_part(p.law), most_(detail::number<scalar>(p.most)) {}
  /// The new ones count from the next adopt() on.
  constexpr void set(const capped& p) noexcept {
    detail::take<Law, Space>(*this, p.law);
    most_ = detail::number<scalar>(p.most);
  }
  [[nodiscard]] constexpr capped parameters() const noexcept {
    capped p;
    if constexpr (detail::has_parameters<law_part>) p.law = law_part::parameters();
    p.most = static_cast<double>(most_);
    return p;
  }
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    detail::take<Law, Space>(*this, p);
  }

  constexpr void adopt(scalar K, scalar T, int late = 0) noexcept {
    is_capped_ = K > most_;
    detail::tell(static_cast<law_part&>(*this), is_capped_ ? most_ : K, T, late);
  }
  /// Does the constraint ask for more than `most`?
  [[nodiscard]] constexpr bool is_capped() const noexcept { return is_capped_; }

 private:
  scalar most_;
  bool is_capped_ = false;
};

}  // namespace v0
}  // namespace passive_haptics
