// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact law whose force does not step at updates of the surface (the menu is in spring.hpp).
//
//     ph::eased{ph::damped_spring{.mass = 0.1}}

#include <passive_haptics/contact/lag.hpp>
#include <passive_haptics/contact/swing.hpp>
#include <passive_haptics/port/composing.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The law, with a limited rate at which a local_contact follows updates of a pressed surface: a new position, another
/// stiffness, a surface that appears under the device or vanishes (lag.hpp). Otherwise it is the law itself, except
/// that its damper acts on a swinging device and not on a hand's motion (swing.hpp). On a device held still the force
/// steps by at most (K|u| + R_most) dt [N], u [m/s] the surface's velocity. The contact ends at once if the surface
/// ceases to cover the device.
template <class Law>
struct eased {
  Law law{};
  news_pace pace{};

  constexpr eased() noexcept = default;
  constexpr explicit eased(const Law& l, const news_pace& p = {}) noexcept : law(l), pace(p) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    const auto fault = detail::fault_in(law);
    return fault ? fault : pace.check();
  }
  template <class Space>
  class on;
};

template <class Law>
template <class Space>
class eased<Law>::on : public part_at<Law, Space> {
  using law_part = part_at<Law, Space>;

 public:
  using scalar = typename Space::scalar;
  template <class Parameters>
  static constexpr int takers = detail::takers<Parameters, Law, Space> +
                                int(std::same_as<Parameters, news_pace>);

  constexpr explicit on(const eased& p) noexcept : law_part(p.law), pace_(p.pace) {}
  /// New parameters take effect at the next adopt(), the pace at the next update.
  constexpr void set(const eased& p) noexcept {
    detail::take<Law, Space>(*this, p.law);
    pace_ = news_pace::at<scalar>(p.pace);
  }
  [[nodiscard]] constexpr eased parameters() const noexcept {
    eased p;
    if constexpr (detail::has_parameters<law_part>) p.law = law_part::parameters();
    p.pace = pace_.parameters();
    return p;
  }
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    if constexpr (std::same_as<Parameters, news_pace>) {
      pace_ = news_pace::at<scalar>(p);
    } else {
      detail::take<Law, Space>(*this, p);
    }
  }
  /// The rates at which updates are followed.
  [[nodiscard]] constexpr const news_pace::at<scalar>& pace() const noexcept { return pace_; }

  constexpr void adopt(scalar K, scalar T, int late = 0) noexcept {
    detail::tell(static_cast<law_part&>(*this), K, T, late);
    if constexpr (swings) natural_ = law_part::natural();
  }
  /// The part of an outward speed [m/s] that the law damps, which excludes a hand's motion (swing.hpp).
  [[nodiscard]] constexpr scalar swinging(scalar speed, scalar dt) noexcept {
    if constexpr (swings) return swing_.damped(speed, natural_, dt);
    return speed;
  }
  /// Ends the contact.
  constexpr void let_go() noexcept { swing_.stop(); }

 private:
  static constexpr bool swings = requires(law_part l) { l.natural(); };
  news_pace::at<scalar> pace_;
  swing<scalar> swing_;
  scalar natural_{};  ///< √(K/m) [1/s], of a law that swings
};

}  // namespace v0
}  // namespace passive_haptics
