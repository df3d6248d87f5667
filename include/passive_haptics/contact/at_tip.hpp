// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Contacts of the tip of a stylus whose motors push at the gimbal.
//
//     ph::passive_port touch{ph::stylus<double>{}, ph::at_tip{ph::contact_set{…}, tip}, …};

#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/device/stylus.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A source for the tip: it is given the position and velocity of the tip, and its force f acts at the gimbal. The
/// torque r × f is missing, because no motor gives it, so the tip turns freely about its contact. Energy is f·Δp of
/// the gimbal, so turning the tip into a wall adds none to the ledger: start with a loan, or keep r short
/// (docs/design/six_dof.md).
template <class Source>
struct at_tip {
  Source source{};
  std::array<double, 3> tip{};  ///< r from gimbal to tip, in the frame of the stylus [m]

  constexpr at_tip() noexcept = default;
  constexpr at_tip(const Source& s, const std::array<double, 3>& r) noexcept : source(s), tip(r) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (const double r : tip) {
      if (!kernels::is_finite(r)) return {"tip", r, "finite"};
    }
    return {};
  }
  template <port Stylus>
  class on;
};

template <class Source>
template <port Stylus>
class at_tip<Source>::on {
 public:
  using space = typename Stylus::geometry;
  using scalar = typename Stylus::scalar;
  using vector = typename space::vector;
  using source_type = part_at<Source, space>;
  static_assert(source_for<Source, space>,
                "passive_haptics: the source does not model source_for: see port/concepts.hpp");
  using result_type = typename source_type::result_type;
  static constexpr bool asks_for_numbers = source_type::asks_for_numbers;
  static constexpr bool needs_ledger = detail::spends_ledger<source_type>();

  constexpr explicit on(const at_tip& p) noexcept
      : source_(p.source),
        tip_{detail::number<scalar>(p.tip[0]), detail::number<scalar>(p.tip[1]),
             detail::number<scalar>(p.tip[2])} {}
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (int i = 0; i < 3; ++i) {
      const scalar r = space::component(tip_, i);
      if (!kernels::is_finite(r)) return {"tip", static_cast<double>(r), "finite"};
    }
    return detail::fault_in(source_);
  }
  constexpr void adopt(scalar longest_tick, int late) noexcept {
    detail::tell(source_, longest_tick, late);
  }
  constexpr void reset() noexcept { detail::restart(source_); }
  constexpr void explain(explanation& e, const typename Stylus::pose& device, scalar T,
                         int late) const noexcept {
    detail::explain(source_, e, vector(vector(Stylus::place(device)) + vector(arm_)), T, late);
  }
  template <class Parameters>
  static constexpr int takers = detail::takers<Parameters, Source, space>;
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    detail::take<Source, space>(source_, p);
  }

  /// The source at the tip, to update or to release.
  [[nodiscard]] constexpr source_type& contact() noexcept { return source_; }
  [[nodiscard]] constexpr const source_type& contact() const noexcept { return source_; }

  /// The motion of the tip, which its source is given.
  struct tip_motion {
    vector position, travel;  ///< [m]
    scalar dt;                ///< [s]
    [[nodiscard]] scalar along(const vector& n) const noexcept {
      return space::dot(travel, n) / dt;
    }
  };
  using request = typename source_type::request;
  template <bool Shortcut>
  [[nodiscard]] constexpr request ask(const auto& motion, const auto& port, event& what) noexcept {
    const auto turn = rotation::normalised(motion.position.orientation);
    const vector arm = rotation::rotate<scalar>(turn, tip_);
    vector travel = port.travel;
    if (port.motion_known) travel = travel + (arm - vector(arm_));
    arm_ = arm;
    const tip_motion now{vector(Stylus::place(motion.position)) + arm, travel, port.dt};
    return source_.template ask<Shortcut>(now, port, what);
  }
  [[nodiscard]] constexpr result_type answered(const request& r,
                                               const port_result<Stylus>& port) noexcept {
    return source_.answered(r, {port.force, port.energy, port.what, port.limited});
  }
  constexpr result_type refused(const port_result<Stylus>& port, scalar dt) noexcept {
    return source_.refused({port.force, port.energy, port.what, port.limited}, dt);
  }

 private:
  source_type source_;
  typename space::coordinates tip_;    ///< r, in the frame of the stylus [m]
  typename space::coordinates arm_{};  ///< R r in the last tick [m]
};

}  // namespace v0
}  // namespace passive_haptics
