// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Shapers that begin with a soft spring and stiffen it as far as the ledger has spare energy.
//
//   nonlinear_coupling    K_c grows throughout the contact         stiffens within one press
//   stiffness_increment   K grows once per press and release       stiffens from touch to touch
//   force_augmentation    an offset is added at each turn          large force, soft spring
//
// All three only reduce the desired force, and only strict_bound behind them makes them passive. With U(d) [J] the
// energy that the shaped spring gives back on a release from depth d [m], growth at d may raise U by at most
//     E_free = E1 − max(U(d), ¼ fᵀB⁻¹f)
// so no energy is promised twice. A spring of up to 2b/T on a surface at rest that begins with E1 ≥ U keeps E1 ≥ U
// in every motion, and the strict law never cuts its force. Each is INSPIRED BY the work it names; the published
// control laws are not confirmed. Formulas and proofs: docs/design/mathematics.md § 2(f).

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// True if there is a force to shape in contact, and the motion of the last tick is known.
template <class Scalar, class Contact>
[[nodiscard]] constexpr bool shapes(Scalar asked, const Contact& contact,
                                    bool motion_known) noexcept {
  return asked > Scalar(0) && contact.target_depth > Scalar(0) && motion_known;
}

/// The share, at most 1, that shortens a force of `asked` [N] along the normal to `most` [N].
template <class Scalar>
[[nodiscard]] constexpr Scalar at_most(Scalar asked, Scalar most) noexcept {
  return most < asked ? most / asked : Scalar(1);
}

/// E_free [J], ≥ 0: the credit beyond U = `release` [J] and beyond the worst outflow of the force `left`·f*.
template <class Space>
[[nodiscard]] constexpr typename Space::scalar spare(const typename Space::vector& desired,
                                                     typename Space::scalar left,
                                                     typename Space::scalar release,
                                                     const auto& port) noexcept {
  using scalar = typename Space::scalar;
  const typename Space::vector force =
      left == scalar(1) ? desired : typename Space::vector(desired * left);
  const scalar outflow = port.damping.worst_outflow(force, port.longest_tick);
  return kernels::larger(port.credit() - kernels::larger(release, outflow), scalar(0));
}

/// `wanted`, or as much of it as `spare` [J] pays for at `price` [J] per unit.
template <class Scalar>
[[nodiscard]] constexpr Scalar paid_for(Scalar wanted, Scalar price, Scalar spare) noexcept {
  return wanted * price <= spare ? wanted : spare / price;
}
}  // namespace detail

/// f = min(f*, K_f d), 1/K_f = 1/K_c + 1/K, and K_c grows in contact, each tick of length dt by
///     ΔK_c = min(rate·dt, most − K_c, 2 E_free/d²)       charged: ΔK_f d²/2 ≤ ΔK_c d²/2 [J]
/// K_c is reset to `initial` when the contact, or a sample, is lost. U = K_f d²/2. Inspired by the nonlinear
/// virtual coupling of the thesis (Fig. 1.7), of which only the idea is known. Its cost is that of
/// strict_bound, and each press starts soft.
struct nonlinear_coupling {
  static constexpr bool needs_local_model = false;
  static constexpr bool needs_ledger = true;

  double initial{};                                       ///< K_c at first touch [N/m], ≤ 2b/T
  double rate{};                                          ///< fastest growth of K_c [N/(m·s)]
  double most = std::numeric_limits<double>::infinity();  ///< largest K_c [N/m]; infinite: up to K

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(initial)) return {"initial", initial, "finite and > 0 N/m"};
    if (!detail::not_negative(rate)) return {"rate", rate, "finite and ≥ 0 N/(m·s)"};
    if (!(most >= initial)) return {"most", most, "≥ initial"};
    return {};
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;

    constexpr explicit on(const nonlinear_coupling& p) noexcept { set(p); }
    constexpr void set(const nonlinear_coupling& p) noexcept {
      initial_ = detail::number<scalar>(p.initial);
      rate_ = detail::number<scalar>(p.rate);
      most_ = detail::number<scalar>(p.most);
    }
    [[nodiscard]] constexpr nonlinear_coupling parameters() const noexcept {
      return {.initial = static_cast<double>(initial_),
              .rate = static_cast<double>(rate_),
              .most = static_cast<double>(most_)};
    }
    constexpr void reset() noexcept { coupling_ = scalar(0); }
    [[nodiscard]] constexpr scalar coupling() const noexcept { return coupling_; }  ///< K_c [N/m]

    [[nodiscard]] constexpr share<scalar> shape(const typename Space::vector& desired,
                                                const contact_state<Space>& contact,
                                                const auto& port) noexcept {
      const scalar asked = Space::dot(desired, contact.normal);
      if (!detail::shapes(asked, contact, port.motion_known)) {
        coupling_ = scalar(0);
        return {scalar(1)};
      }
      const scalar d = contact.target_depth;
      const scalar half = d * d / scalar(2);
      coupling_ = kernels::larger(coupling_, initial_);
      const scalar K = felt(contact.stiffness);
      const scalar wanted = kernels::smaller(rate_ * port.dt, most_ - coupling_);
      const scalar free =
          detail::spare<Space>(desired, detail::at_most(asked, K * d), K * half, port);
      coupling_ += detail::paid_for(wanted, half, free);
      return {detail::at_most(asked, felt(contact.stiffness) * d)};
    }

   private:
    [[nodiscard]] constexpr scalar felt(scalar K) const noexcept {
      return K / (scalar(1) + K / coupling_);
    }

    scalar initial_{}, rate_{}, most_{};
    scalar coupling_{};  ///< K_c now [N/m]; 0 outside
  };
};

/// f = min(f*, K_i d), and K_i grows when a press follows a release or a bounce, by
///     ΔK = min(step, K − K_i, 2 E_free/d²)               charged: ΔK d²/2 [J]
/// K_i is reset to `initial` after `reset_after` out of contact, or a lost sample. U = K_i d²/2.
/// Inspired by the successive stiffness increment (SSI) of Singh, Jafari and Ryu. A single tick that moves the
/// other way counts as a turn, so quantised or noisy positions make K_i grow sooner; E_free limits the growth
/// all the same. Its cost is that of strict_bound, and the first presses are soft.
struct stiffness_increment {
  static constexpr bool needs_local_model = false;
  static constexpr bool needs_ledger = true;

  double initial{};          ///< K_0 [N/m], ≤ 2b/T
  double step{};             ///< most ΔK per press and release [N/m]
  double reset_after = 1.0;  ///< time out of contact after which K_i is forgotten [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(initial)) return {"initial", initial, "finite and > 0 N/m"};
    if (!detail::not_negative(step)) return {"step", step, "finite and ≥ 0 N/m"};
    if (!(reset_after >= 0.0)) return {"reset_after", reset_after, "≥ 0 s"};
    return {};
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;

    constexpr explicit on(const stiffness_increment& p) noexcept { set(p); }
    constexpr void set(const stiffness_increment& p) noexcept {
      initial_ = detail::number<scalar>(p.initial);
      step_ = detail::number<scalar>(p.step);
      reset_after_ = detail::number<scalar>(p.reset_after);
    }
    [[nodiscard]] constexpr stiffness_increment parameters() const noexcept {
      return {.initial = static_cast<double>(initial_),
              .step = static_cast<double>(step_),
              .reset_after = static_cast<double>(reset_after_)};
    }
    constexpr void reset() noexcept {
      stiffness_ = away_ = scalar(0);
      released_ = false;
    }
    [[nodiscard]] constexpr scalar stiffness() const noexcept { return stiffness_; }  ///< K_i [N/m]

    [[nodiscard]] constexpr share<scalar> shape(const typename Space::vector& desired,
                                                const contact_state<Space>& contact,
                                                const auto& port) noexcept {
      const scalar asked = Space::dot(desired, contact.normal);
      if (!detail::shapes(asked, contact, port.motion_known)) {
        away_ += port.dt;
        released_ = stiffness_ > scalar(0);
        if (away_ > reset_after_ || !port.motion_known) {
          stiffness_ = scalar(0);
          released_ = false;
        }
        return {scalar(1)};
      }
      away_ = scalar(0);
      const scalar d = contact.target_depth;
      const scalar half = d * d / scalar(2);
      stiffness_ = kernels::clamped(stiffness_, initial_, contact.stiffness);
      const scalar outward = Space::dot(port.travel, contact.normal);
      if (outward > scalar(0)) released_ = true;
      if (outward < scalar(0) && released_) {
        released_ = false;
        const scalar wanted = kernels::smaller(step_, contact.stiffness - stiffness_);
        const scalar free = detail::spare<Space>(desired, detail::at_most(asked, stiffness_ * d),
                                                 stiffness_ * half, port);
        stiffness_ += detail::paid_for(wanted, half, free);
      }
      return {detail::at_most(asked, stiffness_ * d)};
    }

   private:
    scalar initial_{}, step_{}, reset_after_{};
    scalar stiffness_{};     ///< K_i now [N/m]; 0 before the first touch
    scalar away_{};          ///< time out of contact so far [s]
    bool released_ = false;  ///< the device has moved out, or left, since it last moved in
  };
};

/// f = min(f*, K_L d + F), K_L = min(low, K). Whenever the motion turns, in or out, the offset F [N]
/// moves towards the missing force (K − K_L) d by
///     ΔF = min(step, (K − K_L) d − F, E_free/d)          charged: ΔF d [J]
/// or down by at most `step`. F is zero again when the contact, or a sample, is lost. U = K_L d²/2 + F d,
/// which min(f*, ·) can only lower. Inspired by the successive force augmentation (SFA) of Singh, Jafari and
/// Ryu, of which only the abstract is known, so this update is ours. A turn is defined as in
/// stiffness_increment. Its cost is that of strict_bound, and the force steps by up to `step` at a turn.
struct force_augmentation {
  static constexpr bool needs_local_model = false;
  static constexpr bool needs_ledger = true;

  double low{};   ///< K_L [N/m], ≤ 2b/T
  double step{};  ///< most |ΔF| per turn [N]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(low)) return {"low", low, "finite and > 0 N/m"};
    if (!detail::not_negative(step)) return {"step", step, "finite and ≥ 0 N"};
    return {};
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;

    constexpr explicit on(const force_augmentation& p) noexcept { set(p); }
    constexpr void set(const force_augmentation& p) noexcept {
      low_ = detail::number<scalar>(p.low);
      step_ = detail::number<scalar>(p.step);
    }
    [[nodiscard]] constexpr force_augmentation parameters() const noexcept {
      return {.low = static_cast<double>(low_), .step = static_cast<double>(step_)};
    }
    constexpr void reset() noexcept {
      offset_ = scalar(0);
      leaving_ = false;
    }
    [[nodiscard]] constexpr scalar offset() const noexcept { return offset_; }  ///< F [N]

    [[nodiscard]] constexpr share<scalar> shape(const typename Space::vector& desired,
                                                const contact_state<Space>& contact,
                                                const auto& port) noexcept {
      const scalar asked = Space::dot(desired, contact.normal);
      if (!detail::shapes(asked, contact, port.motion_known)) {
        reset();
        return {scalar(1)};
      }
      const scalar d = contact.target_depth;
      const scalar K = kernels::smaller(low_, contact.stiffness);
      const scalar outward = Space::dot(port.travel, contact.normal);
      const bool turned = leaving_ ? outward < scalar(0) : outward > scalar(0);
      if (turned) {
        leaving_ = !leaving_;
        const scalar release = (K * d / scalar(2) + offset_) * d;
        const scalar missing = (contact.stiffness - K) * d - offset_;
        const scalar wanted = kernels::larger(kernels::smaller(missing, step_), -step_);
        const scalar free =
            detail::spare<Space>(desired, detail::at_most(asked, K * d + offset_), release, port);
        offset_ += detail::paid_for(wanted, d, free);
      }
      return {detail::at_most(asked, K * d + offset_)};
    }

   private:
    scalar low_{}, step_{};
    scalar offset_{};       ///< F now [N]
    bool leaving_ = false;  ///< the last motion in contact was outward
  };
};

static_assert(shaper_for<nonlinear_coupling, space<float, 1>>);
static_assert(shaper_for<stiffness_increment, space<float, 1>>);
static_assert(shaper_for<force_augmentation, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
