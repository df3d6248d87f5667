// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact law with shapers, which change its force before the port's bound.
//
//   ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 100.0}}
//
//   shaper/thesis_rule.hpp                   the rule of the thesis             NOT passive by itself
//   shaper/force_rate_limit.hpp              no jumps at updates
//   contact/settled_force.hpp                any law at rest when the hand is
//   published/stiffness_augmentation.hpp     springs that begin soft and stiffen
//   published/set_position_modulation.hpp    PSPM, which limits the energy of jumps of the surface
//   published/reference_energy.hpp           PO/PC that dissipates during the whole release
//
// A shaper may read the contact and the ledger. It gives no guarantee; the bound does, for any desired force.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/composing.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Applies the law, then the shapers in the given order.
template <class Law, class... Shapers>
struct shaped {
  using sequence_type = detail::sequence<Shapers...>;
  static constexpr bool needs_local_model = (Shapers::needs_local_model || ...);
  static constexpr bool needs_ledger = (Shapers::needs_ledger || ...);
  static constexpr bool needs_velocity =
      (requires { typename std::enable_if_t<Shapers::needs_velocity>; } || ...);

  Law law{};
  sequence_type shapers{};

  constexpr shaped() noexcept = default;
  constexpr explicit shaped(const Law& l, const Shapers&... others) noexcept
      : law(l), shapers(others...) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    const auto fault = detail::fault_in(law);
    return fault ? fault : shapers.check();
  }
  template <class Space>
  class on;
};

template <class Law, class... Shapers>
template <class Space>
class shaped<Law, Shapers...>::on : public part_at<Law, Space> {
  using law_part = part_at<Law, Space>;
  using shaper_part = part_at<sequence_type, Space>;
  static_assert((shaper_for<Shapers, Space> && ...),
                "passive_haptics: the shaper does not model shaper_for: see port/concepts.hpp");

 public:
  template <class Parameters>
  static constexpr int takers =
      detail::takers<Parameters, Law, Space> + detail::takers<Parameters, sequence_type, Space>;

  constexpr explicit on(const shaped& p) noexcept : law_part(p.law), shapers_(p.shapers) {}
  constexpr void set(const shaped& p) noexcept {
    detail::take<Law, Space>(*this, p.law);
    shapers_.set(p.shapers);
  }
  [[nodiscard]] constexpr shaped parameters() const noexcept {
    shaped p;
    if constexpr (detail::has_parameters<law_part>) p.law = law_part::parameters();
    p.shapers = shapers_.parameters();
    return p;
  }
  constexpr void adopt(typename Space::scalar K, typename Space::scalar T, int late = 0) noexcept {
    detail::tell(static_cast<law_part&>(*this), K, T, late);
    detail::tell(shapers_, T, late);
  }
  constexpr void reset() noexcept { shapers_.reset(); }
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    if constexpr (detail::takers < Parameters, Law, Space >> 0) {
      detail::take<Law, Space>(*this, p);
    } else {
      detail::take<sequence_type, Space>(shapers_, p);
    }
  }
  [[nodiscard]] constexpr const shaper_part& shapers() const noexcept { return shapers_; }
  [[nodiscard]] constexpr shaper_part& shapers() noexcept { return shapers_; }

 private:
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS shaper_part shapers_;
};

}  // namespace v0
}  // namespace passive_haptics
