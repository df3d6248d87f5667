// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Identifies one axis of a device, tick by tick; docs/design/identification.md has the method.
//
//     axis_identification of({.force = 3.0, .stroke = 8e-3});
//     while (!of.done()) sample = device.exchange(of.tick(sample.position, ph::seconds{sample.dt}));
//     const auto found = of.result();
//
// It makes three experiments, one after the other, and records the axis meanwhile:
//
//   swing_experiment.hpp        to and fro across the stroke: mass, damping, friction in motion, load, latency
//   break_away_experiment.hpp   a ramp of force until it slips, at several places: break-away force, presliding
//   creep_experiment.hpp        a periodic force below break-away: the axis must not creep under it
//   disturbance_search.hpp      what is wrong, from the ticks of the swing and of a second one at the end
//   axis_record.hpp             position, velocity, ticks, steps and noise, missing samples
//
// This class runs them in order, and ends the identification on too few samples or beyond the workspace.

#include <passive_haptics/base/seconds.hpp>
#include <passive_haptics/identification/axis_found.hpp>
#include <passive_haptics/identification/creep_experiment.hpp>
#include <passive_haptics/identification/disturbance_search.hpp>
#include <passive_haptics/identification/swing_experiment.hpp>

#include <limits>
#include <optional>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

class axis_identification {
 public:
  /// `rounding` is the epsilon of the scalar of the positions.
  /// It allocates the memory of kept ticks; the ticks themselves allocate nothing.
  explicit axis_identification(const identification_parameters& p = {},
                               double rounding = std::numeric_limits<double>::epsilon())
      : p_(p), record_(rounding), swing_(p) {
    if (p.check()) fail("a parameter is out of its range: ask identification_parameters::check()");
  }

  /// Takes the position [m] at the end of a tick of that length [s], and returns the force [N] for the next tick.
  /// The force is 0 once it is done(), and whenever the position is not finite or the length not > 0.
  double tick(double position, seconds<double> length) noexcept {
    const double dt = length.count();
    if (done()) return 0.0;
    if (!kernels::is_finite(position) || !passive_haptics::detail::positive(dt)) return lost();
    record_.book(position, dt, break_away_ && break_away_->at_rest());
    if (kernels::magnitude(record_.x()) > p_.workspace) {
      // Where it has swung within the workspace before, the load is not what it was.
      return fail(break_away_ ? refusal_of(disturbance::drift)
                              : "it left the workspace: nothing may push it, or state a larger "
                                "workspace or a shorter stroke");
    }
    time_ += dt;
    const bool keeps = keeps_tick();
    if (keeps) kept_.sample(record_.x(), dt);
    double force = next();
    if (done()) force = 0.0;
    force = std::clamp(force, -p_.force, p_.force);
    record_.commanded(force);
    if (keeps) kept_.commanded(force, !again_ && swing_.crosses());
    if (!keeps) kept_.leave_out(dt);
    return force;
  }
  /// Deleted: a bare number as the length could as well be a position.
  template <std::convertible_to<double> Number>
  double tick(double /*position*/, const Number& /*length*/) noexcept {
    passive_haptics::detail::refuse_bare_time<Number>();
    return 0.0;
  }
  /// Call it in place of tick() if nothing was read. The force is 0.
  double lost() noexcept {
    if (done()) return 0.0;
    record_.interrupt();
    swing_.interrupt();
    kept_.leave_out(0.0);
    return record_.too_few() ? fail("the device gave too few good samples") : 0.0;
  }
  /// Ends the identification: the force is 0 from now on.
  void stop() noexcept {
    stopped_ = !done();
    if (!done()) fail("it was stopped before the end");
  }

  [[nodiscard]] bool done() const noexcept { return done_; }
  /// A sentence that says why it ended early; null if it did not.
  [[nodiscard]] const char* problem() const noexcept { return problem_; }
  [[nodiscard]] double time() const noexcept { return time_; }  ///< sum of its ticks [s]

  /// The result. It allocates, and takes a second where it searches for what is wrong, half a minute at worst.
  [[nodiscard]] axis_found result() const {
    axis_found found;
    found.problem = problem_ != nullptr ? problem_ : done() ? nullptr : "it is not at its end";
    if (!done() || stopped_ || !(swing_.force() > 0.0)) return found;
    if (found.problem != nullptr && swing_.repeats()) return found;
    disturbance_search search(kept_.ticks(), swing_.found().latency, record_.step(), p_.stroke,
                              swing_.force());
    found.wrong = search.conclude();
    const suspicion& mode = found.wrong.of(disturbance::mode);
    if (mode.found && (found.problem != nullptr || mode.size < lowest_mode)) {
      found.problem =
          "the transmission between motor and handle rings too low: stiffen it, or take the handle "
          "off";
    }
    if (found.problem == nullptr && found.wrong.unexplained > disturbances_found::too_much) {
      found.problem = held_or_gives;
    }
    if (const char* why = found.wrong.refusal()) found.problem = why;
    if (found.problem != nullptr) return found;
    swing_.state(found);
    record_.state(found);
    if (found.wrong.mass > 0.0) {
      found.rotor = kernels::smaller(found.mass, p_.trust.margin * found.wrong.mass) /
                    (1.0 + found.wrong.yields);
    }
    found.remark = break_away_->problem();
    if (creep_) found.remark = creep_->problem();
    if (found.remark != nullptr) return found;
    break_away_->state(found, record_.step());
    creep_->state(found, record_.step());
    // The ramps slip at a few places, and the four at a place meet one level of a ripple longer than a slip; the motion
    // meets all of them.
    const double least = kinetic_friction(swing_.found()) - found.wrong.ripple;
    found.friction = kernels::smaller(found.friction,
                                      found.creep * p_.trust.margin * kernels::larger(least, 0.0));
    if (!(least > 0.0)) found.remark = "dry friction: none to rely on, it varies along the way";
    return found;
  }

 private:
  double fail(const char* why) noexcept {
    problem_ = why;
    done_ = true;
    return 0.0;
  }
  /// True in the ticks that disturbance_search.hpp is to see.
  [[nodiscard]] bool keeps_tick() const noexcept {
    return again_ || (!break_away_ && swing_.settles_shakes_or_crosses());
  }
  /// The force [N] of the present experiment; where that ends, the next one begins.
  double next() noexcept {
    if (again_) return shake_again();
    if (creep_) {
      const double force = creep_->tick(record_);
      if (creep_->done()) begin_again();
      return force;
    }
    if (break_away_) {
      const double force = break_away_->tick(record_);
      if (break_away_->done()) begin_creep();
      return force;
    }
    const double force = swing_.tick(record_);
    if (swing_.problem() != nullptr) return fail(swing_.problem());
    if (swing_.done()) begin_break_away();
    return force;
  }
  void begin_break_away() noexcept {
    friction_since_ = time_;
    break_away_.emplace(p_, swing_.found(), swing_.relay(), swing_.force());
    if (break_away_->done()) begin_again();
  }
  void begin_creep() noexcept {
    if (break_away_->problem() != nullptr) return begin_again();
    creep_.emplace(p_, swing_.found(), break_away_->ramps(), break_away_->parked(), record_.step(),
                   p_.friction_time - (time_ - friction_since_));
    if (creep_->done()) begin_again();
  }
  /// Shakes it once more, to see whether it has changed meanwhile.
  void begin_again() noexcept {
    again_.emplace(swing_.relay());
    again_->restart(record_.x());
    shaking_ = shaken_relay(swing_.force(), p_.force);
    again_since_ = time_;
  }
  double shake_again() noexcept {
    if (time_ - again_since_ >= lasts_again) {
      done_ = true;
      return 0.0;
    }
    return shaking_.tick(record_, *again_, p_.stroke);
  }

  static constexpr double lasts_again = 2.5;  // [s]
  // Half a sweep takes some 25 ms, and of a mode with a longer period it sees a part, which looks like damping [Hz].
  static constexpr double lowest_mode = 40.0;
  identification_parameters p_;
  axis_record record_;
  swing_experiment swing_;
  std::optional<break_away_experiment> break_away_;
  std::optional<creep_experiment> creep_;
  motion_record kept_;
  std::optional<eased_relay> again_;
  shaken_relay shaking_{};
  const char* problem_ = nullptr;
  bool done_ = false, stopped_ = false;
  double time_ = 0.0, friction_since_ = 0.0, again_since_ = 0.0;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
