// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Judges whether a device is quiet. A passive port need not be: a device may ring for ever and draw no energy.
//
//     q1  force    rms of f − y over 100 ms,  ẏ = 2π 10 Hz (f − y)       ≤ 0.02 N      the hand hears it
//     q2  motion   rms of max |n·v| over 100 ms, n of contacts that press  ≤ 1 mm/s    the eye sees it
//     q3  step     largest |f(n) − f(n−1)| in 100 ms                     ≤ 0.02 N      the hand feels it
//
//     sim::quiet_judge<scene> judge;
//     judge.add(force, velocity, 1e-3, pressing);      // in every tick; the unit normals that press
//     judge.add_at(force, position, 1e-3, pressing);   // the same, from positions
//     judge.news();                                    // the hand or the world has changed
//     judge.since();                                   // the time since which it is quiet [s]; NaN: it is not
//
// f is the force commanded. For a rigid_body q1 and q3 take the larger of |f| and |τ|/lever, and a contact that
// presses is a row (n, r × n). Motion along a free direction does not count, because a hand of 100 N/m and
// 1 N·s/m swings 1 kg on a plane without friction for 2 s by itself. NaN and infinity are not quiet. A device that
// hops is quiet while it is in the air, so let a run go on for a second after the time that since() must keep.
// Source: ours, docs/design/settling.md.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/device/space.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// The figures of a window of 100 ms; the defaults are the bars.
struct quiet_figures {
  double force = 0.02;  ///< q1, rms above 10 Hz [N]
  double speed = 1e-3;  ///< q2, rms along the contacts that press [m/s]
  double step = 0.02;   ///< q3, largest in a tick [N]
};

/// The bars for a device in a hand, as in docs/design/settling.md.
struct quiet_bars : quiet_figures {
  double lever = 0.03;  ///< lever of a tool [m]: a torque τ counts as the force τ/lever

  /// The bars on encoders of step q [m] under a stiffness K [N/m] and a mass m [kg]. The force K d of the position
  /// shown steps by K q. Hunting between two values has an rms of K q/2 and moves m at (q/2)√(K/m). No law of a
  /// depth can do better, because nothing is measured inside a step.
  [[nodiscard]] constexpr quiet_bars on_encoders(double q, double K, double m) const noexcept {
    quiet_bars floor = *this;
    floor.force = kernels::larger(force, K * q / 2.0);
    floor.speed = kernels::larger(speed, q / 2.0 * kernels::square_root(K / m));
    floor.step = kernels::larger(step, K * q);
    return floor;
  }
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!passive_haptics::detail::positive(force)) return {"force", force, "finite and > 0 N"};
    if (!passive_haptics::detail::positive(speed)) return {"speed", speed, "finite and > 0 m/s"};
    if (!passive_haptics::detail::positive(step)) return {"step", step, "finite and > 0 N"};
    if (!passive_haptics::detail::positive(lever)) return {"lever", lever, "finite and > 0 m"};
    return {};
  }
};

/// The bar that a window has missed, and of several the one that it missed by most.
enum class quiet_bar : std::uint8_t { none, force, motion, step, number };
[[nodiscard]] constexpr const char* to_string(quiet_bar b) noexcept {
  constexpr const char* names[] = {"none", "q1 force", "q2 motion", "q3 step", "no number"};
  return names[static_cast<int>(b)];
}

/// Judges ticks in consecutive windows of 100 ms. Port is a space or a rigid_body.
template <class Port>
requires(passive_haptics::detail::has_geometry<Port> ||
         passive_haptics::detail::moves_and_turns<Port>) class quiet_judge {
 public:
  using effort = typename Port::effort;
  using motion = typename Port::motion;
  using pose = typename Port::pose;
  static constexpr double window = 0.1;  ///< [s]
  static constexpr double cut = 10.0;    ///< corner frequency of the low pass [Hz]

  explicit quiet_judge(const quiet_bars& bars = {}) noexcept : bars_(bars) {}

  /// Adds a tick of dt [s]: the effort commanded [N], [N·m], the velocity [m/s], [rad/s], and for each contact
  /// that presses its normal, or for a rigid_body its row.
  void add(const effort& force, const motion& velocity, double dt,
           std::span<const motion> pressing) noexcept {
    const bool sound = passive_haptics::detail::positive(dt) && Port::is_finite(force) &&
                       Port::is_finite(velocity);
    if (passive_haptics::detail::positive(dt)) {
      elapsed_ += dt;
      time_ += dt;
    }
    if (sound) {
      count(force, velocity, dt, pressing);
      if (elapsed_ >= window - dt / 2.0) close();
    } else {
      now_.speed = std::numeric_limits<double>::quiet_NaN();
      started_ = false;
      close();
    }
  }
  /// The same from the pose of the device; the first call counts as no speed.
  void add_at(const effort& force, const pose& at, double dt,
              std::span<const motion> pressing) noexcept {
    const motion travel = placed_ ? motion(Port::between(at_, at)) : motion(Port::zero());
    at_ = at;
    placed_ = true;
    add(force, motion(travel * (scalar(1) / scalar(dt))), dt, pressing);
  }
  /// Sets the bars from the present window on, because on encoders they follow the stiffness that is shown (K q).
  void judge_by(const quiet_bars& bars) noexcept { bars_ = bars; }
  /// Starts the judgement anew, because the hand or the world has changed.
  void news() noexcept {
    news_ = since_ = time_;
    judged_ = false;
    begin();
  }

  /// True if the last window is within the bars.
  [[nodiscard]] bool quiet() const noexcept { return judged_; }
  /// The time since which it is quiet [s], as a sum of the ticks; NaN if it is not quiet.
  [[nodiscard]] double since() const noexcept {
    return judged_ ? since_ : std::numeric_limits<double>::quiet_NaN();
  }
  /// The time from the last news() until it was quiet [s]; NaN if it is not quiet.
  [[nodiscard]] double settling() const noexcept { return since() - news_; }
  [[nodiscard]] double time() const noexcept { return time_; }  ///< sum of all ticks [s]
  /// The bars [N], [m/s], [N], and the figures of the last window.
  [[nodiscard]] const quiet_bars& bars() const noexcept { return bars_; }
  [[nodiscard]] const quiet_figures& figures() const noexcept { return last_; }
  /// The bar that the last window which was not quiet has missed; none if every window was quiet.
  [[nodiscard]] quiet_bar missed() const noexcept { return missed_; }

 private:
  using scalar = typename Port::scalar;

  [[nodiscard]] double size(const effort& e) const noexcept {
    if constexpr (passive_haptics::detail::moves_and_turns<Port>) {
      using triples = typename Port::body_space;
      return kernels::larger(static_cast<double>(triples::norm(Port::linear(e))),
                             static_cast<double>(triples::norm(Port::angular(e))) / bars_.lever);
    } else {
      return static_cast<double>(Port::norm(e));
    }
  }
  void count(const effort& force, const motion& velocity, double dt,
             std::span<const motion> pressing) noexcept {
    const effort before = started_ ? effort(force_) : force;
    effort low = started_ ? effort(low_) : force;
    low = low + (force - low) * scalar(-std::expm1(-6.283185307179586 * cut * dt));
    const double high = size(effort(force - low));
    double fastest = 0.0;
    for (const motion& n : pressing) {
      const double along = kernels::magnitude(static_cast<double>(Port::work(n, velocity).joules));
      if (!(along <= fastest)) fastest = along;  // also if it is NaN
    }
    now_.force += high * high * dt;
    now_.speed += fastest * fastest * dt;
    now_.step = kernels::larger(now_.step, size(effort(force - before)));
    force_ = force;
    low_ = low;
    started_ = true;
  }
  void begin() noexcept {
    now_ = {0.0, 0.0, 0.0};
    elapsed_ = 0.0;
  }
  void close() noexcept {
    last_ = {std::sqrt(now_.force / elapsed_), std::sqrt(now_.speed / elapsed_), now_.step};
    const double q1 = last_.force / bars_.force, q2 = last_.speed / bars_.speed;
    const double q3 = last_.step / bars_.step;
    judged_ = q1 <= 1.0 && q2 <= 1.0 && q3 <= 1.0;
    if (!judged_) {
      since_ = time_;
      missed_ = !(q1 + q2 + q3 >= 0.0) ? quiet_bar::number
                : q1 >= q2 && q1 >= q3 ? quiet_bar::force
                : q2 >= q3             ? quiet_bar::motion
                                       : quiet_bar::step;
    }
    begin();
  }

  quiet_bars bars_;
  quiet_figures now_{0.0, 0.0, 0.0}, last_{0.0, 0.0, 0.0};
  typename Port::stored_effort force_{}, low_{};
  typename Port::stored_pose at_{};
  double elapsed_ = 0.0, time_ = 0.0, since_ = 0.0, news_ = 0.0;  // [s]
  quiet_bar missed_ = quiet_bar::none;
  bool started_ = false, placed_ = false, judged_ = false;
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
