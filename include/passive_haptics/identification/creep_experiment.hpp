// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Third experiment: a periodic force below break-away.
// A spring and a slider return to the same place after each cycle. Friction that creeps does not (Dahl's and LuGre's
// drift: Dupont, Hayward, Armstrong, Altpeter, 2002), and no ledger is right for it.
//
//     g(t) = s G (1 − cos 2πνt)/2 on friction,        G = the least of
//         0.95 (1 − 1.25 r √(24/N)) c friction in motion, r being the share by which it varies over N ≤ 24 ramps [N]
//         the least break-away        force of any ramp                                           [N]
//
// with s falling in seven levels from 1 to 0.25, until the mean positions over some cycles at the beginning and over
// each as many later ones agree to within 1.05 steps. ν is a quarter of the frequency 1/(2π √(m C)) of the mass m on a
// spring of friction's compliance C, and at most 50 Hz. A level ends where it has crept, or after 12 s, or with the
// time that is left; a lower one is not begun with less than 6 s.
//
// Dupont's friction creeps above 0.6 of the force at which it slips, by about 3.2 (s − 0.6)³ p [m] in a cycle. If that
// is less than 1.6 steps over all cycles, the encoder cannot show it, and the untested share 0.6 is stated. If the
// first level without creep is lower than s = 1, 0.7 of that level is stated, as a margin.

#include <passive_haptics/identification/break_away_experiment.hpp>

#include <numbers>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class creep_experiment {
 public:
  /// Takes the results of the two other experiments; `step` is the resolution of the positions [m]. It is to be over in
  /// `lasts` [s]: what has not come back by then is taken to creep.
  creep_experiment(const identification_parameters& p, const motion_found& motion,
                   const friction_ramp& ramps, const parking& parked, double step,
                   double lasts) noexcept
      : p_(p),
        left_(lasts),
        mass_(motion.mass.value),
        kinetic_(kinetic_friction(motion)),
        ramp_(ramps),
        parking_(parked) {
    const double few = std::sqrt(24.0 / std::clamp(ramp_.count(), 1, 24));
    cap_ = 0.95 * kinetic_ * kernels::larger(1.0 - 1.25 * few * ramp_.unevenness(), 0.0);
    cap_ = (std::min)(cap_, ramp_.least());
    if (cap_ > 0.0 && kernels::is_finite(ramp_.compliance_at_most(step))) {
      next_level(step);
    } else {
      give_up("dry friction: not found, it breaks away too differently from place to place");
    }
  }

  /// The force of the next tick [N], after a sample that has been recorded; 0 once it is done().
  double tick(const axis_record& seen) noexcept {
    phase_.lasts(seen.dt());
    left_ -= seen.dt();
    if (phase_ == phase::cycle) return cycle(seen);
    if (phase_ == phase::park) return park(seen);
    return 0.0;
  }

  [[nodiscard]] bool done() const noexcept { return phase_ == phase::done; }
  /// A sentence that says why nothing was found; null if something was, or may be yet.
  [[nodiscard]] const char* problem() const noexcept { return problem_; }

  /// Writes the friction, and the share up to which it does not creep, for positions known to `step` [m].
  void state(axis_found& found, double step) const noexcept {
    if (passed_ < 0) {
      found.remark = "dry friction: none to rely on, it creeps under a force that comes and goes";
      return;
    }
    const double beyond = kernels::larger(cap_ / kinetic_ - untold, 0.0);
    const double surely = found.likely_presliding - 0.5 * step;
    const bool telling = 3.2 * beyond * beyond * beyond * surely * cycles_ > 1.6 * step;
    double share = levels[static_cast<std::size_t>(passed_)];
    if (passed_ > 0) share *= 0.7;
    if (passed_ == 0 && !telling) share = untold;
    found.creep = share;
    found.friction = share * cap_;
  }

 private:
  enum class phase : std::uint8_t { cycle, park, done };
  struct mean_of {
    double sum = 0.0, lasted = 0.0;
    int count = 0;
    void book(double x, double dt) noexcept {
      sum += x;
      lasted += dt;
      ++count;
    }
    [[nodiscard]] double mean() const noexcept { return count > 0 ? sum / count : 0.0; }
  };
  static constexpr double least_time = 6.0;  // that a lower level has to come back for [s]
  static constexpr double untold = 0.6;      // share of friction that is stated untested
  static constexpr std::array levels{1.0, 0.85, 0.72, 0.61, 0.52, 0.4, 0.25};

  double give_up(const char* why) noexcept {
    problem_ = why;
    phase_.enter(phase::done);
    return 0.0;
  }
  void next_level(double step) noexcept {
    const double softest = ramp_.compliance_at_most(step);  // [m/N]
    const double omega = 1.0 / std::sqrt(mass_ * softest);
    frequency_ = (std::min)(50.0, omega / (4.0 * 2.0 * std::numbers::pi));
    edge_ = (std::max)(0.3, std::ceil(0.3 * frequency_) / frequency_);
    end_ = (std::max)(
        std::floor((std::min)({p_.creep_cycles / frequency_, 12.0, left_}) / edge_) * edge_,
        4.0 * edge_);
    cycles_ = static_cast<int>((end_ - 2.0 * edge_) * frequency_);
    begun_at_ = parking_.place();
    first_ = last_ = {};
    phase_.enter(phase::cycle);
    const double telling = (std::min)(p_.creep_cycles / frequency_, least_time);
    if (level_ > 0 && left_ < (std::max)(end_, telling)) phase_.enter(phase::done);
  }
  double cycle(const axis_record& seen) noexcept {
    const double peak = levels[static_cast<std::size_t>(level_)] * cap_;
    const double t = phase_.lasted();
    const double g = peak * (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * frequency_ * t));
    if (t > edge_) (t <= 2.0 * edge_ ? first_ : last_).book(seen.x(), seen.dt());
    const bool gone = kernels::magnitude(seen.x() - begun_at_) > 0.3e-3 + 3.0 * seen.step();
    if (gone) {
      lower(seen, true);
    } else if (last_.lasted > edge_ - seen.dt() / 2.0) {
      if (kernels::magnitude(last_.mean() - first_.mean()) > 1.05 * seen.step() + 1e-7) {
        lower(seen, false);
      } else if (t > end_ - edge_ / 2.0) {
        passed_ = level_;
        phase_.enter(phase::done);
      }
      last_ = {};
    }
    return parking_.balanced(g);
  }
  /// Goes on with the next lower level, where the device is, or from rest if it has `gone`.
  void lower(const axis_record& seen, bool gone) noexcept {
    if (++level_ >= static_cast<int>(levels.size())) {
      phase_.enter(phase::done);
    } else if (gone) {
      parking_.begin_here(seen);
      phase_.enter(phase::park);
    } else {
      next_level(seen.step());
    }
  }
  double park(const axis_record& seen) noexcept {
    const double force = parking_.tick(seen);
    if (parking_.problem() != nullptr) return give_up(parking_.problem());
    if (parking_.parked()) next_level(seen.step());
    return force;
  }

  identification_parameters p_;
  double left_;  // of the time for it [s]
  double mass_, kinetic_;
  double cap_ = 0.0;  // G [N]
  friction_ramp ramp_;
  parking parking_;
  timed_phase<phase> phase_{phase::cycle};
  const char* problem_ = nullptr;
  double edge_ = 0.0, end_ = 0.0;  // time of a mean, and of a level [s]
  double frequency_ = 0.0, begun_at_ = 0.0;
  int level_ = 0, passed_ = -1, cycles_ = 0;
  mean_of first_, last_;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
