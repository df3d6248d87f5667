// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// First experiment: to and fro across the stroke, for the numbers of the device in motion.
// Mass m [kg], damping b± [N·s/m], kinetic friction c [N], load w [N] and latency d [ticks] are those of
//
//     m ẍ = f(t − d) − b± ẋ − c sgn ẋ + w − k (x − x₀)            motion_regression.hpp
//
//   settle   at least 1 s and 12 sweeps with the largest force allowed, until both turns are beyond half the stroke
//   shake    shake_time with the same force and a sequence of blocks on top, for disturbance_search.hpp
//   sweep    sweep_time with a force of at most that, and of the largest of
//                3 |w| + 2.5 c             so that load and friction do not stop it
//                2 m stroke/(40 ms)²       so that it gets across in some tens of milliseconds
//                a fifth of the largest force allowed
//            In every other six sweeps the force is 1.5 times that, and in every other twelve the stroke is 0.6 of the
//            stated one, because a single force or stroke does not separate damping from friction.
//   cross    cross_time at v of 19 to 70 mm/s: a force A sin 2πx/L moves m by A L²/(m (2π v)²), so cogging of half a
//            millimetre shows a hundred times more than in a sweep. Where steps or the mass hide it at the speed
//            that five ticks tell, four of six crossings are as slow as they have to be, or as friction allows.
//
// A relay moves the device (relay_motion.hpp; Åström and Hägglund, 1984). By default a bound is three deviations of
// the jackknife (Miller, 1974) and 5 % away from the estimate (trust.hpp).

#include <passive_haptics/identification/disturbance.hpp>
#include <passive_haptics/identification/measure_latency.hpp>
#include <passive_haptics/identification/motion_record.hpp>
#include <passive_haptics/identification/motion_regression.hpp>
#include <passive_haptics/identification/parameters.hpp>
#include <passive_haptics/identification/relay_motion.hpp>
#include <passive_haptics/identification/timed_phase.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class swing_experiment {
 public:
  explicit swing_experiment(const identification_parameters& p) noexcept
      : p_(p), relay_(p.force, p.stroke) {}

  /// The force of the next tick [N], after a sample that has been recorded; 0 once it is done().
  double tick(const axis_record& seen) noexcept {
    if (done()) return 0.0;
    phase_.lasts(seen.dt());
    regression_.sample(seen.x(), seen.dt());
    clock_.book(seen.samples(), seen.position());
    const double force = phase_ == phase::settle  ? settle(seen)
                         : phase_ == phase::shake ? shake(seen)
                         : phase_ == phase::sweep ? sweep(seen)
                                                  : cross(seen);
    regression_.commanded(force);
    return force;
  }
  /// Adds a missing sample.
  void interrupt() noexcept { regression_.interrupt(); }

  [[nodiscard]] bool done() const noexcept { return phase_ == phase::done; }
  /// True in the ticks that disturbance_search.hpp is to see: in all but the sweeps.
  [[nodiscard]] bool settles_shakes_or_crosses() const noexcept {
    return phase_ == phase::settle || phase_ == phase::shake || phase_ == phase::cross;
  }
  /// True in the ticks of the slow crossing.
  [[nodiscard]] bool crosses() const noexcept { return phase_ == phase::cross; }
  /// A sentence that says why nothing was found; null if something was, or may be yet.
  [[nodiscard]] const char* problem() const noexcept { return problem_; }
  /// True if positions repeat: then the motion of the record is not that of the axis.
  [[nodiscard]] bool repeats() const noexcept { return clock_.period() > 1; }
  /// The result, once it is done().
  [[nodiscard]] const motion_found& found() const noexcept { return motion_; }
  /// The relay that swings the device, and the force of the sweeps [N].
  [[nodiscard]] const eased_relay& relay() const noexcept { return relay_; }
  [[nodiscard]] double force() const noexcept { return force_; }

  /// Writes the bounds into `found`.
  void state(axis_found& found) const noexcept {
    const motion_found& m = motion_;
    found.mass = kernels::larger(p_.trust.at_least(m.mass), 0.0);
    for (std::size_t i = 0; i < 2; ++i) {
      const estimate& b = m.damping[1 - i];
      found.damping_ways[i] = kernels::larger(p_.trust.at_least(b), 0.0);
      found.damping_max = kernels::larger(found.damping_max, p_.trust.at_most(b));
    }
    found.damping = kernels::smaller(found.damping_ways[0], found.damping_ways[1]);
    found.latency = m.latency;
    found.likely_mass = m.mass.value;
    found.likely_damping = (m.damping[0].value + m.damping[1].value) / 2.0;
    found.likely_friction = m.friction.value;
    found.load = m.load.value;
    found.explained = m.explained;
  }

 private:
  enum class phase : std::uint8_t { settle, shake, sweep, cross, done };
  static constexpr const char* stopped =
      "it stopped to swing: let go of the device, or allow more force";
  static constexpr double slowest = 0.03;   // least speed of the windows that count [m/s]
  static constexpr double finest = 0.3e-3;  // cogging that is sought [m]

  double fail(const char* why) noexcept {
    problem_ = why;
    phase_.enter(phase::done);
    return 0.0;
  }
  /// True if the axis has turned since the last call; then a window becomes half of the last sweep.
  bool turned() noexcept {
    if (relay_.sweeps() == window_since_) return false;
    window_since_ = relay_.sweeps();
    window_ = std::clamp(relay_.motion().ticks_of_last() / 2, 8, 64);
    return true;
  }
  void book(const axis_record& seen, int group) noexcept {
    regression_.book(window_, group, slowest, seen.step(), relay_.motion().turned_at());
  }

  /// Swings with the largest force, until both turns are beyond half the stroke, and chooses the force of the sweeps.
  double settle(const axis_record& seen) noexcept {
    const double force = relay_.tick(seen, p_.stroke);
    const int sweeps = relay_.sweeps();
    const double reached = relay_.motion().reached();
    turned();
    if (seen.samples() % 2 == 0) book(seen, sweeps);
    if (phase_.lasted() > 4.0 && sweeps < 4) {
      return fail(reached < 1e-3 ? "it hardly moves: let go of the device, or allow more force"
                                 : "it does not swing: let go of the device, or allow more force");
    }
    if (phase_.lasted() < 1.0 || sweeps < 12) return force;
    if (reached < 0.5 * p_.stroke) {
      if (phase_.lasted() > 4.0) {
        return fail("it does not get across the stroke: let go of the device, or allow more force");
      }
      return force;
    }
    const motion_found first = regression_.conclude();
    force_ = p_.force;
    if (first.windows > 50 && first.explained > 0.5) {
      const double against =
          3.0 * std::abs(first.load.value) + 2.5 * std::abs(first.friction.value);
      const double calm = 2.0 * first.mass.value * p_.stroke / (0.04 * 0.04);
      force_ = (std::min)(p_.force, (std::max)({against, calm, 0.2 * p_.force}));
    }
    relay_.expect(first.friction.value, first.load.value);
    regression_.clear();
    shaking_ = shaken_relay(force_, p_.force);
    phase_.enter(phase::shake);
    return force;
  }
  double shake(const axis_record& seen) noexcept {
    if (phase_.lasted() > p_.shake_time + 5.0) return fail(stopped);
    if (turned() && phase_.lasted() >= p_.shake_time) phase_.enter(phase::sweep);
    return shaking_.tick(seen, relay_, p_.stroke);
  }
  double sweep(const axis_record& seen) noexcept {
    const int sweeps = relay_.sweeps();
    const bool hard = (sweeps / 6) % 2 == 1;
    const bool narrow = (sweeps / 12) % 2 == 1;
    const double force = relay_.tick(seen, narrow ? 0.6 * p_.stroke : p_.stroke,
                                     hard ? (std::min)(p_.force, 1.5 * force_) : force_);
    if (turned() && phase_.lasted() >= p_.sweep_time) return conclude(force);
    if (phase_.lasted() > p_.sweep_time + 5.0) return fail(stopped);
    if (seen.samples() % 3 == 0) {
      const int group = static_cast<int>(phase_.lasted() / p_.sweep_time * regression_.groups);
      book(seen, (std::min)(group, regression_.groups - 1));
    }
    return force;
  }
  double conclude(double force) noexcept {
    motion_ = regression_.conclude();
    if (const char* wrong = motion_problem()) return fail(wrong);
    phase_.enter(phase::cross);
    return force;
  }
  /// Goes to and fro little faster than the windows of the search have to be, friction and load taken off the command.
  double cross(const axis_record& seen) noexcept {
    if (phase_.lasted() >= p_.cross_time) {
      relay_.restart(seen.x());
      phase_.enter(phase::done);
      return 0.0;
    }
    if (across_ * seen.x() > 0.8 * p_.stroke) {
      across_ = -across_;
      pushes_ = 0.0;
      ++crossings_;
    }
    const double m = motion_.mass.value;
    const int ticks = std::clamp(static_cast<int>(8.0 * std::sqrt(m / 0.1)), 6, 24);
    const double omega = std::clamp(20.0 / std::sqrt(m), 20.0, 64.0);
    const double along = std::clamp(0.5 + across_ * seen.x() / (1.6 * p_.stroke), 0.0, 1.0);
    const double a_step = kernels::larger(seen.step(), 1e-9) / kernels::larger(seen.dt(), 1e-5);
    const double fast = slowest + a_step / 5.0;
    // A fiftieth of the force every `finest` moves the axis by a twentieth of a step at that speed.
    const double shows = finest / (2.0 * std::numbers::pi) *
                         std::sqrt(0.4 * p_.force / (m * kernels::larger(seen.step(), 1e-9)));
    const double from = std::clamp(shows, 0.016 + a_step / 21.0, fast);
    // The speed grows along the way, so that no speed meets the steps in time with the ticks for long, and is another in
    // each crossing, so that no place does each time: a wave of a fixed phase would come of it.
    const double other = 0.618 * crossings_ - std::floor(0.618 * crossings_);
    const double wanted = (1.2 + 0.1 * other + 0.5 * along) * (crossings_ % 6 < 4 ? from : fast);
    const double slow = wanted - across_ * seen.velocity(ticks);
    pushes_ =
        std::clamp(pushes_ + 0.25 * m * omega * omega * slow * seen.dt(), -p_.force, p_.force);
    const double force =
        across_ * (motion_.friction.value + m * omega * slow + pushes_) - motion_.load.value;
    return std::clamp(force, -p_.force, p_.force);
  }
  [[nodiscard]] const char* motion_problem() const noexcept {
    if (repeats()) {
      return "the sensor is slower than the loop: tick when it has something new";
    }
    if (motion_.windows < 100) {
      return "it moves too slowly or too little: allow more force, or a longer stroke";
    }
    if (!(motion_.explained > 0.9)) return held_or_gives;
    const double spring = motion_.stiffness.value;
    if (kernels::magnitude(spring) > 5.0 * motion_.stiffness.deviation &&
        kernels::magnitude(spring) * p_.stroke > 0.02 * force_) {
      return "something holds it like a spring: let go of the device, and keep off its stops";
    }
    if (kernels::magnitude(motion_.exactly.value - motion_.latency) >
        0.08 + 3.0 * motion_.exactly.deviation) {
      return "the force changes in mid-tick: hold it from sample to sample";
    }
    return nullptr;
  }

  identification_parameters p_;
  eased_relay relay_;
  shaken_relay shaking_{};
  motion_regression regression_;
  passive_haptics::detail::sensor_clock clock_;
  timed_phase<phase> phase_{phase::settle};
  motion_found motion_{};
  const char* problem_ = nullptr;
  double force_ = 0.0;                  // force of the sweeps [N]
  double across_ = 1.0, pushes_ = 0.0;  // way, and force beyond friction and speed [N]
  int window_ = 16, window_since_ = 0, crossings_ = 0;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
