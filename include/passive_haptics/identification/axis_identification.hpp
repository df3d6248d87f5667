// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Identifies one axis of a device, a tick at a time; docs/design/identification.md has the method.
//
//     axis_identification of({.force = 3.0, .stroke = 8e-3});
//     while (!of.done()) sample = device.exchange(of.tick(sample.position, ph::seconds{sample.dt}));
//     const auto found = of.result();
//
//   settle, sweep   to and fro across the stroke: mass, damping, friction in motion, load, latency
//   for each place: kick there, park, balance the load, and four times
//     condition     slip away what still rings on friction's spring
//     rest          where is it?
//     push          until it breaks away: break-away force, presliding
//     release       friction brakes
//   cycle           below break-away, does it come back?

#include <passive_haptics/base/seconds.hpp>
#include <passive_haptics/identification/axis_found.hpp>
#include <passive_haptics/identification/friction_ramp.hpp>
#include <passive_haptics/identification/measure_latency.hpp>
#include <passive_haptics/identification/measure_ticks.hpp>
#include <passive_haptics/identification/motion_regression.hpp>
#include <passive_haptics/identification/parameters.hpp>
#include <passive_haptics/identification/relay_motion.hpp>
#include <passive_haptics/identification/step_finder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class axis_identification {
 public:
  /// `rounding` is that of the scalar in which positions come.
  explicit axis_identification(const identification_parameters& p = {},
                               double rounding = std::numeric_limits<double>::epsilon()) noexcept
      : p_(p), steps_(rounding) {
    if (p.check()) fail("a parameter is out of its range: ask identification_parameters::check()");
  }

  /// Takes the position [m] at the end of a tick of that length [s], and returns the force [N] for the
  /// next one: 0 once it is done(), and whenever a position or a length is no number.
  double tick(double position, seconds<double> length) noexcept {
    const double dt = length.count();
    if (done()) return 0.0;
    if (!kernels::is_finite(position) || !passive_haptics::detail::positive(dt)) return missed();
    missing_ = 0;
    ++samples_;
    if (samples_ == 1) start_ = position;
    last_x_ = x_;
    x_ = position - start_;
    ticks_.book(dt);
    track_velocity(dt);
    regression_.sample(x_, dt);
    clock_.book(samples_, position);
    steps_.book(position, phase_ == phase::rest && in_phase_ > 0.1, unchanged_ > 12);
    if (kernels::magnitude(x_) > p_.workspace) {
      fail(
          "it left the workspace: nothing may push it, or state a larger workspace or a shorter "
          "stroke");
      return 0.0;
    }
    dt_ = dt;
    time_ += dt;
    in_phase_ += dt;
    double force = next();
    if (done()) force = 0.0;
    force = std::clamp(force, -p_.force, p_.force);
    regression_.commanded(force);
    unchanged_ = force == last_force_ ? unchanged_ + 1 : 0;
    last_force_ = force;
    return force;
  }
  /// A number where the length belongs could be a position as well: this does not compile.
  template <std::convertible_to<double> Number>
  double tick(double /*position*/, const Number& /*length*/) noexcept {
    passive_haptics::detail::refuse_bare_time<Number>();
    return 0.0;
  }

  [[nodiscard]] bool done() const noexcept { return phase_ == phase::done; }
  /// A sentence why it ended early; null if it has not.
  [[nodiscard]] const char* problem() const noexcept { return problem_; }
  [[nodiscard]] double time() const noexcept { return time_; }  ///< so far [s]
  /// In place of tick(), when nothing was read: the force is 0.
  double lost() noexcept { return missed(); }
  /// Ends it: the force is zero from now on.
  void stop() noexcept {
    if (!done()) fail("it was stopped before the end");
  }

  [[nodiscard]] axis_found result() const noexcept {
    axis_found found;
    found.problem = problem_ != nullptr ? problem_ : done() ? nullptr : "it is not at its end";
    if (found.problem != nullptr) return found;
    const motion_found& m = motion_;
    found.mass = kernels::larger(margin * m.mass.at_least(3.0), 0.0);
    for (std::size_t i = 0; i < 2; ++i) {
      const estimate& b = m.damping[1 - i];
      found.damping_ways[i] = kernels::larger(margin * b.at_least(3.0), 0.0);
      found.damping_max = kernels::larger(found.damping_max, b.at_most(3.0) / margin);
    }
    found.damping = kernels::smaller(found.damping_ways[0], found.damping_ways[1]);
    found.quantum = steps_.step();
    found.noise = steps_.noise();
    found.latency = m.latency;
    found.longest_tick = ticks_.longest();
    found.likely_mass = m.mass.value;
    found.likely_damping = (m.damping[0].value + m.damping[1].value) / 2.0;
    found.likely_friction = m.friction.value;
    found.load = m.load.value;
    found.explained = m.explained;
    found.remark = friction_problem_;
    if (friction_problem_ == nullptr) state_friction(found);
    return found;
  }

 private:
  enum class phase : std::uint8_t {
    settle,
    sweep,
    kick,
    park,
    balance,
    condition,
    rest,
    push,
    release,
    cycle,
    done
  };
  static constexpr double elastic = 120e-6;  // motion that is no slip [m]
  static constexpr double untold = 0.6;    // share of friction that is taken not to creep, unasked
  static constexpr double margin = 0.95;   // of what no statistics sees
  static constexpr double slowest = 0.03;  // of the windows that count [m/s]

  void fail(const char* why) noexcept {
    problem_ = why;
    phase_ = phase::done;
  }
  void enter(phase next) noexcept {
    phase_ = next;
    in_phase_ = 0.0;
  }
  double missed() noexcept {
    if (done()) return 0.0;
    ++missed_;
    regression_.interrupt();
    steps_.interrupt();
    seen_ = unchanged_ = 0;
    if (++missing_ > 50 || (missed_ > 200 && missed_ * 20 > samples_)) {
      fail("the device gave too few good samples");
    }
    return 0.0;
  }
  void track_velocity(double dt) noexcept {
    const std::size_t i = static_cast<std::size_t>(++seen_) % recent_.size();
    recent_[i] = {x_, dt};
    const int back = (std::min)(seen_ - 1, phase_ == phase::park ? park_window_ : 6);
    double lasted = 0.0;
    for (int j = 0; j < back; ++j) {
      lasted += recent_[static_cast<std::size_t>(seen_ - j) % recent_.size()].length;
    }
    const double before = recent_[static_cast<std::size_t>(seen_ - back) % recent_.size()].position;
    v_ = lasted > 0.0 ? (x_ - before) / lasted : 0.0;
  }

  double next() noexcept {
    switch (phase_) {
      case phase::settle:
        return settle();
      case phase::sweep:
        return sweep();
      case phase::kick:
        return kick();
      case phase::park:
        return park();
      case phase::balance:
        return balance();
      case phase::condition:
        return condition();
      case phase::rest:
        return rest();
      case phase::push:
        return push();
      case phase::release:
        return release();
      case phase::cycle:
        return cycle();
      case phase::done:
        break;
    }
    return 0.0;
  }

  void state_friction(axis_found& found) const noexcept {
    for (int forward = 0; forward < 2; ++forward) {
      found.breakaway_least[forward] = ramp_.least(forward);
      found.breakaway_most[forward] = ramp_.most(forward);
    }
    found.uneven = ramp_.unevenness();
    const double soft = ramp_.compliance_at_most(step());
    found.presliding = 1.1 * soft * ramp_.most();
    found.likely_presliding = kernels::larger(ramp_.compliance(), 0.0) * ramp_.most();
    if (passed_ < 0) {
      found.remark = "dry friction: none to rely on, it creeps under a force that comes and goes";
      return;
    }
    // A device that creeps from 0.6 of its friction on (untold) goes by about 3.2 (s − 0.6)³ p in a cycle
    // up to the share s of it (dupont_friction): was that enough to be seen?
    const double beyond = kernels::larger(cap_ / kinetic_ - untold, 0.0);
    const double surely = found.likely_presliding - 0.2 * step();
    const bool telling = 3.2 * beyond * beyond * beyond * surely * cycles_ > 1.6 * step();
    double share = shares[static_cast<std::size_t>(passed_)];
    if (passed_ > 0) share *= 0.7;
    if (passed_ == 0 && !telling) share = untold;
    found.creep = share;
    found.friction = share * cap_;
  }

  // ------------------------------------------------------------------ fast: to and fro
  double relay(double force, double amplitude) noexcept {
    return relay_.tick(x_, v_, force, amplitude, 1.5 * steps_.so_far() + 20e-6);
  }
  double swing(double wanted, double amplitude) noexcept {
    if (relay_.sweeps() == eased_at_) return relay(swung_, amplitude);
    eased_at_ = relay_.sweeps();
    const double force = kernels::larger(wanted, 0.8 * swung_);  // less by little and little
    if (force != swung_) relay_.change(swung_, force, rubs_, pulls_, p_.stroke);
    swung_ = force;
    return relay(force, amplitude);
  }
  /// Finds out how fast it goes to and fro with all the force there may be.
  double settle() noexcept {
    const double force = relay(p_.force, p_.stroke);
    if (relay_.sweeps() != window_since_) {
      window_since_ = relay_.sweeps();
      window_ = std::clamp(relay_.ticks_of_last() / 2, 8, 64);
    }
    if (samples_ % 2 == 0) {
      regression_.book(window_, relay_.sweeps(), slowest, steps_.so_far(), relay_.turned_at());
    }
    if (in_phase_ > 4.0 && relay_.sweeps() < 4) {
      fail(relay_.reached() < 1e-3
               ? "it hardly moves: let go of the device, or allow more force"
               : "it does not swing: let go of the device, or allow more force");
      return 0.0;
    }
    if (in_phase_ < 1.0 || relay_.sweeps() < 12) return force;
    if (relay_.reached() < 0.5 * p_.stroke) {
      if (in_phase_ > 4.0)
        fail("it does not get across the stroke: let go of the device, or allow more force");
      return force;
    }
    const motion_found first = regression_.conclude();
    swing_ = p_.force;
    if (first.windows > 50 && first.explained > 0.5) {
      const double against =
          3.0 * std::abs(first.load.value) + 2.5 * std::abs(first.friction.value);
      const double calm = 2.0 * first.mass.value * p_.stroke / (0.04 * 0.04);
      swing_ = (std::min)(p_.force, (std::max)({against, calm, 0.2 * p_.force}));
    }
    rubs_ = first.friction.value;
    pulls_ = first.load.value;
    swung_ = p_.force;
    regression_.clear();
    enter(phase::sweep);
    return force;
  }
  double sweep() noexcept {
    const int sweeps = relay_.sweeps();
    const bool hard = (sweeps / 6) % 2 == 1;
    const double force = swing(hard ? (std::min)(p_.force, 1.5 * swing_) : swing_,
                               (sweeps / 12) % 2 == 1 ? 0.6 * p_.stroke : p_.stroke);
    if (relay_.sweeps() != window_since_) {
      window_since_ = relay_.sweeps();
      window_ = std::clamp(relay_.ticks_of_last() / 2, 8, 64);
      if (in_phase_ >= p_.sweep_time) return conclude_motion(force);
    }
    if (in_phase_ > p_.sweep_time + 5.0) {
      fail("it stopped to swing: let go of the device, or allow more force");
      return 0.0;
    }
    if (samples_ % 3 == 0) {
      const int group = static_cast<int>(in_phase_ / p_.sweep_time * motion_regression::groups);
      regression_.book(window_, (std::min)(group, motion_regression::groups - 1), slowest,
                       steps_.so_far(), relay_.turned_at());
    }
    return force;
  }
  double conclude_motion(double force) noexcept {
    motion_ = regression_.conclude();
    if (const char* wrong = motion_problem()) {
      fail(wrong);
      return 0.0;
    }
    kinetic_ = motion_.friction.at_least(3.0);
    park_window_ = std::clamp(static_cast<int>(8.0 * std::sqrt(motion_.mass.value / 0.1)), 6, 24);
    if (!(kinetic_ > 0.01) || !(kinetic_ > 0.3 * motion_.friction.value)) {
      friction_problem_ = "dry friction: not found, it is below what the steps and the swing show";
      enter(phase::done);
      return 0.0;
    }
    ramp_.begin_all(motion_.friction.value);
    enter(phase::kick);
    kicked_from_ = relay_.sweeps();
    return force;
  }
  [[nodiscard]] const char* motion_problem() const noexcept {
    if (clock_.period() > 1) {
      return "the sensor is slower than the loop: tick when it has something new";
    }
    if (motion_.windows < 100) {
      return "it moves too slowly or too little: allow more force, or a longer stroke";
    }
    if (!(motion_.explained > 0.9)) {
      return "the force explains too little of the motion: let go of the device, or allow more "
             "force";
    }
    const double spring = motion_.stiffness.value;
    if (kernels::magnitude(spring) > 4.0 * motion_.stiffness.deviation &&
        kernels::magnitude(spring) * p_.stroke > 0.05 * p_.force) {
      return "something holds it like a spring: let go of the device, and keep off its stops";
    }
    if (kernels::magnitude(motion_.exactly.value - motion_.latency) >
        0.15 + 3.0 * motion_.exactly.deviation) {
      return "the force changes in mid-tick: hold it from sample to sample";
    }
    return nullptr;
  }

  // ------------------------------------------------------------------ slow: friction broken away
  double kick() noexcept {
    const double share = golden(place_ + 1);  // places that no period of gears or cables meets
    const double wanted = (1.2 * share - 0.6) * p_.stroke;
    const bool there = (x_ - wanted) * (last_x_ - wanted) <= 0.0;
    if ((relay_.sweeps() - kicked_from_ >= 2 && there) || in_phase_ > 3.0) {
      target_ = x_;
      enter(phase::park);
      rest_.restart();
    }
    return swing(swing_, 0.8 * p_.stroke);
  }
  [[nodiscard]] double step() const noexcept { return steps_.so_far(); }
  /// The n-th of numbers in [0, 1) that never repeat and never crowd.
  [[nodiscard]] static double golden(int n) noexcept {
    const double x = 0.6180339887498949 * n;
    return x - std::floor(x);
  }
  /// For how long it has been at rest [s], but for what friction's spring rings.
  [[nodiscard]] double resting() noexcept { return rest_.still(x_, dt_, 1.01 * step() + elastic); }
  [[nodiscard]] double balanced(double friction_force) const noexcept {
    return friction_force - motion_.load.value;
  }
  /// A damped spring until nothing moves.
  double park() noexcept {
    const double m = motion_.mass.value;
    const double omega = std::clamp(12.0 / std::sqrt(m), 12.0, 40.0);
    const double force = balanced(-m * omega * omega * (x_ - target_) - 1.6 * m * omega * v_);
    if (resting() > 0.1) {
      parked_force_ = force;
      enter(phase::balance);
      rest_.restart();
    } else if (in_phase_ > 3.0) {
      return give_up("dry friction: not found, it does not hold the device at rest");
    }
    return force;
  }
  /// The spring is let go; friction holds the device, or does not.
  double balance() noexcept {
    const double share = (std::min)(in_phase_ / 0.06, 1.0);
    const double force = balanced((1.0 - share) * (parked_force_ + motion_.load.value));
    if (resting() > 0.2 && in_phase_ > 0.2) {
      if (cycling_) {
        next_level();
      } else {
        after_slip_ = false;
        pushes_left_ = 4;
        way_ = place_ % 2 == 0 ? 1 : -1;
        enter(phase::condition);
      }
    } else if (in_phase_ > 1.0) {
      return park_again();
    }
    return force;
  }
  /// What still rings on friction's spring is slipped away by a force that comes and goes.
  double condition() noexcept {
    constexpr double lasts = 0.4;  // [s]
    const double peak = 0.8 * kernels::smaller(ramp_.least(), kinetic_);
    const double g = peak * kernels::larger(1.0 - std::abs(2.0 * in_phase_ / lasts - 1.0), 0.0);
    if (in_phase_ >= lasts) {
      rest_.restart();
      enter(phase::rest);
    }
    return balanced(-way_ * g);
  }
  double rest() noexcept {
    if (resting() > 0.2) {
      ramp_.begin(way_, rest_.mean());
      enter(phase::push);
    } else if (in_phase_ > 1.0) {
      return park_again();
    }
    return balanced(0.0);
  }
  double park_again() noexcept {
    if (++slipped_ > 8)
      return give_up("dry friction: not found, it does not hold the device at rest");
    target_ = std::clamp(x_, -0.5 * p_.stroke, 0.5 * p_.stroke);
    rest_.restart();
    enter(phase::park);
    return balanced(0.0);
  }
  double push() noexcept {
    const double rate = motion_.friction.value / 0.5;
    const double g = rate * in_phase_;
    const double force = balanced(ramp_.way() * g);
    if (kernels::magnitude(force) >= p_.force) {
      return give_up("dry friction: not found, it does not break away: allow more force");
    }
    const double moved = 0.25e-3 + 2.0 * step();
    const auto state = ramp_.book(g, x_, moved);
    if (state == friction_ramp::state::broken) {
      ramp_.conclude(
          g, moved, after_slip_,
          {.rate = rate,
           .mass = motion_.mass.value,
           .damping = kernels::larger(motion_.damping[0].value, motion_.damping[1].value),
           .step = step()});
      --pushes_left_;
      after_slip_ = true;
      go_on_ =
          static_cast<int>(12.0 * golden(++slips_));  // ticks, so that it stops anywhere in a step
      enter(phase::release);
      rest_.restart();
      return force;
    }
    if (state == friction_ramp::state::backwards) {
      return park_again();
    }
    return force;
  }
  /// After a slip; friction brakes.
  double release() noexcept {
    if (--go_on_ >= 0) return balanced(ramp_.way() * ramp_.most(ramp_.way()));
    const double still = resting();
    const bool away = kernels::magnitude(x_) > 1.5 * p_.stroke;
    if (away || in_phase_ > 1.5) {
      return park_again();
    }
    if (still > 0.1) {
      if (pushes_left_ > 0) {
        way_ = -way_;
        enter(phase::condition);
      } else if (++place_ < p_.places) {
        kicked_from_ = relay_.sweeps();
        relay_.restart(x_);
        enter(phase::kick);
      } else {
        begin_cycles();
      }
    }
    return balanced(0.0);
  }

  // ------------------------------------------------------------------ does it creep?
  void begin_cycles() noexcept {
    cap_ = 0.95 * kinetic_ * kernels::larger(1.0 - 1.25 * ramp_.unevenness(), 0.0);
    cap_ = (std::min)(cap_, ramp_.least());
    level_ = 0;
    if (cap_ > 0.0 && kernels::is_finite(ramp_.compliance_at_most(step()))) {
      next_level();
    } else {
      friction_problem_ =
          "dry friction: not found, it breaks away too differently from place to place";
      enter(phase::done);
    }
  }
  void next_level() noexcept {
    const double softest = ramp_.compliance_at_most(step());  // [m/N]
    const double omega = 1.0 / std::sqrt(motion_.mass.value * softest);
    frequency_ = (std::min)(50.0, omega / (4.0 * 2.0 * pi));
    cycle_ref_ = rest_.mean();
    first_ = last_ = {};
    enter(phase::cycle);
  }
  double cycle() noexcept {
    const double peak = shares[static_cast<std::size_t>(level_)] * cap_;
    const double t = in_phase_;
    const double edge = (std::max)(0.3, std::ceil(0.3 * frequency_) / frequency_);
    const double end = std::clamp(p_.creep_cycles / frequency_, 6.0 * edge, 12.0);
    cycles_ = static_cast<int>((end - 2.0 * edge) * frequency_);
    const double g = peak * (0.5 - 0.5 * std::cos(2.0 * pi * frequency_ * t));
    if (t > edge && t <= 2.0 * edge) first_.book(x_);
    if (t > end - edge) last_.book(x_);
    const bool gone = kernels::magnitude(x_ - cycle_ref_) > 0.3e-3 + 3.0 * step();
    if (gone || t > end) {
      const double crept = kernels::magnitude(last_.mean() - first_.mean());
      const bool creeps = gone || crept > 1.05 * step() + 1e-7;
      if (!creeps) {
        passed_ = level_;
        enter(phase::done);
      } else if (++level_ >= static_cast<int>(shares.size())) {
        enter(phase::done);
      } else if (gone) {
        target_ = std::clamp(x_, -0.5 * p_.stroke, 0.5 * p_.stroke);
        cycling_ = true;
        rest_.restart();
        enter(phase::park);
      } else {
        next_level();
      }
    }
    return balanced(g);
  }

  double give_up(const char* why) noexcept {
    friction_problem_ = why;
    enter(phase::done);
    return 0.0;
  }

  struct mean_of {
    double sum = 0.0;
    int count = 0;
    void book(double x) noexcept {
      sum += x;
      ++count;
    }
    [[nodiscard]] double mean() const noexcept { return count > 0 ? sum / count : 0.0; }
  };
  struct seen {
    double position = 0.0, length = 0.0;
  };

  static constexpr double pi = 3.14159265358979323846;
  static constexpr std::array shares{1.0, 0.85, 0.72, 0.61, 0.52, 0.4, 0.25};

  identification_parameters p_;
  phase phase_ = phase::settle;
  const char* problem_ = nullptr;
  const char* friction_problem_ = nullptr;
  tick_lengths ticks_;
  step_finder steps_;
  passive_haptics::detail::sensor_clock clock_;
  motion_regression regression_;
  relay_motion relay_;
  friction_ramp ramp_;
  rest_watch rest_;
  motion_found motion_{};
  std::array<seen, 32> recent_{};
  int seen_ = 0, samples_ = 0, missed_ = 0, missing_ = 0;
  double start_ = 0.0, x_ = 0.0, last_x_ = 0.0, v_ = 0.0, dt_ = 0.0, time_ = 0.0, in_phase_ = 0.0;
  double last_force_ = 0.0;
  int unchanged_ = 0;  // for so many ticks
  int eased_at_ = 0, window_ = 16, window_since_ = 0, park_window_ = 8;
  double swing_ = 0.0;                             // force of the sweeps [N]
  double swung_ = 0.0, rubs_ = 0.0, pulls_ = 0.0;  // with it, friction and load, roughly [N]
  double kinetic_ = 0.0;                           // friction at speed, from below [N]
  int kicked_from_ = 0, place_ = 0, pushes_left_ = 0, slipped_ = 0;
  double target_ = 0.0, parked_force_ = 0.0;
  double cap_ = 0.0, frequency_ = 0.0, cycle_ref_ = 0.0;
  int level_ = 0, passed_ = -1;
  bool cycling_ = false, after_slip_ = false;
  int way_ = 1, slips_ = 0, go_on_ = 0, cycles_ = 0;
  mean_of first_, last_;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
