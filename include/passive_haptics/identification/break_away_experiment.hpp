// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Second experiment: a force that grows slowly until the device slips, for break-away [N] and presliding p [m].
//
//     g(t) = R t on friction, R = c/(0.4 s)        x = C g until it slips, p ≤ C × the largest break-away force
//
// with the friction c [N] and the load w [N] of the swing; the command balances w all the time (Canudas de Wit and
// Lischinsky, 1997, for a bristle). friction_ramp.hpp evaluates a ramp. At each of several places:
//
//   kick        a swing, up to a place within ±0.6 of the stroke, another one each time
//   park        parking.hpp brings the device to rest there; then four times, alternating the way:
//   condition   0.2 to 0.3 s of a force against the coming ramp, up to 0.8 of the least break-away and back to zero,
//               which damps what still rings on friction's spring, and lets ramps meet the rest at any phase
//   rest        the position at rest is found
//   push        g, until the device has gone 0.25 mm and two steps
//   release     0 to 11 more ticks of the largest break-away force, so that friction stops it anywhere in a step
//
// A device that does not rest, or is pushed back, is parked anew where it is. The ramps end after `places`, or after
// 0.7 of friction_time, or after five places where more of them would tell nothing: friction is even, and the
// bound of C is near C or near what the steps allow.

#include <passive_haptics/identification/friction_ramp.hpp>
#include <passive_haptics/identification/motion_regression.hpp>
#include <passive_haptics/identification/parameters.hpp>
#include <passive_haptics/identification/parking.hpp>
#include <passive_haptics/identification/relay_motion.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// The lower bound of the friction that the swing has found [N].
[[nodiscard]] inline double kinetic_friction(const motion_found& motion) noexcept {
  return motion.friction.at_least(3.0);
}

class break_away_experiment {
 public:
  /// `relay` swings the device as the swing_experiment has left it, with `force` [N].
  break_away_experiment(const identification_parameters& p, const motion_found& motion,
                        const eased_relay& relay, double force) noexcept
      : p_(p),
        motion_(motion),
        relay_(relay),
        force_(force),
        parking_(motion.mass.value, motion.load.value, p.stroke),
        kicked_from_(relay.sweeps()) {
    const double kinetic = kinetic_friction(motion);
    if (!(kinetic > 0.01) || !(kinetic > 0.3 * motion.friction.value)) {
      give_up("dry friction: not found, it is below what the steps and the swing show");
    }
    ramp_.begin_all(motion.friction.value);
  }

  /// The force of the next tick [N], after a sample that has been recorded; 0 once it is done().
  double tick(const axis_record& seen) noexcept {
    phase_.lasts(seen.dt());
    time_ += seen.dt();
    switch (phase_) {
      case phase::kick:
        return kick(seen);
      case phase::park:
        return park(seen);
      case phase::condition:
        return condition();
      case phase::rest:
        return rest(seen);
      case phase::push:
        return push(seen);
      case phase::release:
        return release(seen);
      case phase::done:
        break;
    }
    return 0.0;
  }

  [[nodiscard]] bool done() const noexcept { return phase_ == phase::done; }
  /// A sentence that says why nothing was found; null if something was, or may be yet.
  [[nodiscard]] const char* problem() const noexcept { return problem_; }
  /// True while the device rests under a constant force.
  [[nodiscard]] bool at_rest() const noexcept {
    return phase_ == phase::rest && phase_.lasted() > 0.1;
  }
  /// The result of the ramps, once it is done(), and the parking of the device.
  [[nodiscard]] const friction_ramp& ramps() const noexcept { return ramp_; }
  [[nodiscard]] const parking& parked() const noexcept { return parking_; }

  /// Writes the bounds into `found`, for positions known to `step` [m].
  void state(axis_found& found, double step) const noexcept {
    for (int forward = 0; forward < 2; ++forward) {
      found.breakaway_least[forward] = ramp_.least(forward);
      found.breakaway_most[forward] = ramp_.most(forward);
    }
    found.uneven = ramp_.unevenness();
    const double soft = ramp_.compliance_at_most(step);
    found.presliding = 1.1 * soft * ramp_.most();
    found.likely_presliding = kernels::larger(ramp_.compliance(), 0.0) * ramp_.most();
  }

 private:
  enum class phase : std::uint8_t { kick, park, condition, rest, push, release, done };

  double give_up(const char* why) noexcept {
    problem_ = why;
    phase_.enter(phase::done);
    return 0.0;
  }
  /// Number n of a sequence in [0, 1) that is evenly spread and never repeats (golden ratio).
  [[nodiscard]] static double golden(int n) noexcept {
    const double x = 0.6180339887498949 * n;
    return x - std::floor(x);
  }

  /// True if more ramps would tell nothing, for positions known to `step` [m].
  [[nodiscard]] bool suffices(double step) const noexcept {
    const double off = ramp_.compliance_at_most(step) - ramp_.compliance();
    return ramp_.unevenness() < 0.08 &&
           (off < 0.2 * ramp_.compliance() || off * ramp_.most() < 0.2 * step);
  }
  double kick(const axis_record& seen) noexcept {
    const double share = golden(place_ + 1);  // places in phase with no gear or cable
    const double wanted = (1.2 * share - 0.6) * p_.stroke;
    const bool there = (seen.x() - wanted) * (seen.before() - wanted) <= 0.0;
    if ((relay_.sweeps() - kicked_from_ >= 2 && there) || phase_.lasted() > 3.0) {
      parking_.begin(seen.x());
      phase_.enter(phase::park);
    }
    return relay_.tick(seen, 0.8 * p_.stroke, force_);
  }
  /// `force`, or the end of the experiment if the device cannot be parked.
  double or_give_up(double force) noexcept {
    return parking_.problem() != nullptr ? give_up(parking_.problem()) : force;
  }
  double park(const axis_record& seen) noexcept {
    const double force = parking_.tick(seen);
    if (parking_.parked()) {
      after_slip_ = false;
      pushes_left_ = 4;
      way_ = place_ % 2 == 0 ? 1 : -1;
      phase_.enter(phase::condition);
    }
    return or_give_up(force);
  }
  double park_again(const axis_record& seen) noexcept {
    phase_.enter(phase::park);
    return or_give_up(parking_.begin_again(seen));
  }
  double condition() noexcept {
    const double lasts = 0.2 + 0.1 * golden(slips_);  // ramps meet what rings at any phase [s]
    const double peak = 0.8 * kernels::smaller(ramp_.least(), kinetic_friction(motion_));
    const double g =
        peak * kernels::larger(1.0 - std::abs(2.0 * phase_.lasted() / lasts - 1.0), 0.0);
    if (phase_.lasted() >= lasts) {
      parking_.watch_anew();
      phase_.enter(phase::rest);
    }
    return parking_.balanced(-way_ * g);
  }
  double rest(const axis_record& seen) noexcept {
    if (parking_.resting(seen) > 0.2) {
      ramp_.begin(way_, parking_.place());
      phase_.enter(phase::push);
    } else if (phase_.lasted() > 1.0) {
      return park_again(seen);
    }
    return parking_.balanced(0.0);
  }
  double push(const axis_record& seen) noexcept {
    const double rate = motion_.friction.value / 0.4;
    const double force = parking_.balanced(ramp_.way() * rate * phase_.lasted());
    const double late = motion_.latency * seen.dt();  // until it is held
    const double g = rate * kernels::larger(phase_.lasted() - late, 0.0);
    if (kernels::magnitude(force) >= p_.force) {
      return give_up("dry friction: not found, it does not break away: allow more force");
    }
    const double moved = 0.25e-3 + 2.0 * seen.step();
    const auto state = ramp_.book(g, seen.x(), moved);
    if (state == friction_ramp::state::broken) {
      ramp_.conclude(
          g, moved, after_slip_,
          {.rate = rate,
           .mass = motion_.mass.value,
           .damping = kernels::larger(motion_.damping[0].value, motion_.damping[1].value),
           .step = seen.step()});
      --pushes_left_;
      after_slip_ = true;
      go_on_ = static_cast<int>(12.0 * golden(++slips_));
      phase_.enter(phase::release);
      parking_.watch_anew();
      return force;
    }
    if (state == friction_ramp::state::backwards) return park_again(seen);
    return force;
  }
  double release(const axis_record& seen) noexcept {
    if (--go_on_ >= 0) return parking_.balanced(ramp_.way() * ramp_.most(ramp_.way()));
    const double still = parking_.resting(seen);
    const bool away = kernels::magnitude(seen.x()) > 1.5 * p_.stroke;
    if (away || phase_.lasted() > 1.5) return park_again(seen);
    if (still > 0.1) {
      const bool late = time_ > 0.7 * p_.friction_time;
      if (pushes_left_ > 0 && !late) {
        way_ = -way_;
        phase_.enter(phase::condition);
      } else if (++place_ < p_.places && !late && !(place_ >= 5 && suffices(seen.step()))) {
        kicked_from_ = relay_.sweeps();
        relay_.restart(seen.x());
        phase_.enter(phase::kick);
      } else {
        phase_.enter(phase::done);
      }
    }
    return parking_.balanced(0.0);
  }

  identification_parameters p_;
  motion_found motion_;
  eased_relay relay_;
  double force_;  // force of the kicks [N]
  parking parking_;
  friction_ramp ramp_;
  timed_phase<phase> phase_{phase::kick};
  const char* problem_ = nullptr;
  int kicked_from_ = 0, place_ = 0, pushes_left_ = 0;
  int way_ = 1, slips_ = 0, go_on_ = 0;  // go_on_ in ticks
  double time_ = 0.0;
  bool after_slip_ = false;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
