// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Is a device quiet? Passivity says no word of it: what rings for ever may draw no energy.
//
//     q1  force    rms of f − y over 100 ms,  ẏ = 2π 10 Hz (f − y)       ≤ 0.02 N      what is heard
//     q2  motion   rms of max |n·v| over 100 ms, n of what presses       ≤ 1 mm/s      what is seen
//     q3  step     largest |f(n) − f(n−1)| in 100 ms                     ≤ 0.02 N      what is felt
//
//     sim::quiet_judge<scene> judge;
//     judge.add(force, velocity, 1e-3, pressing);      // in every tick; the unit normals that press
//     judge.add_at(force, position, 1e-3, pressing);   // the same, from positions
//     judge.news();                                    // the hand or the world has changed
//     judge.since();                                   // quiet since then [s]; NaN: it is not
//
// A tick's force is what is commanded. Of a rigid_body q1 and q3 take the larger of |f| and |τ|/lever, and
// what presses are rows (n, r × n). Motion along a free direction is not charged: a hand of 100 N/m and
// 1 N·s/m swings 1 kg on a plane without friction for 2 s by itself. A number that is none is not quiet. What
// hops is quiet while it is in the air: let a run go on for a second after the time that since() must keep.
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

/// What a window of 100 ms comes to, and what it may come to.
struct quiet_figures {
  double force = 0.02;  ///< q1 [N] rms above 10 Hz
  double speed = 1e-3;  ///< q2 [m/s] rms along what presses
  double step = 0.02;   ///< q3 [N] in a tick
};

/// What a device in a hand has to keep; the figures are those of docs/design/settling.md.
struct quiet_bars : quiet_figures {
  double lever = 0.03;  ///< of a tool: a torque counts as the force τ/lever [m]

  /// The same on encoders of step q [m] under a stiffness K [N/m] and a mass m [kg]. K d of what is shown steps by
  /// K q; hunting between two of its values has an rms of K q/2, and moves m at (q/2)√(K/m), because inside a step
  /// nothing is measured: no law of a depth can do better.
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

/// A bar that a window has missed; of several the one that it missed by most.
enum class quiet_bar : std::uint8_t { none, force, motion, step, number };
[[nodiscard]] constexpr const char* to_string(quiet_bar b) noexcept {
  constexpr const char* names[] = {"none", "q1 force", "q2 motion", "q3 step", "no number"};
  return names[static_cast<int>(b)];
}

/// Judges ticks in windows of 100 ms, one after the other. Port is a space or a rigid_body.
template <class Port>
requires(passive_haptics::detail::has_geometry<Port> ||
         passive_haptics::detail::moves_and_turns<Port>) class quiet_judge {
 public:
  using effort = typename Port::effort;
  using motion = typename Port::motion;
  using pose = typename Port::pose;
  static constexpr double window = 0.1;  ///< [s]
  static constexpr double cut = 10.0;    ///< of the low pass [Hz]

  explicit quiet_judge(const quiet_bars& bars = {}) noexcept : bars_(bars) {}

  /// A tick of dt [s]: the effort commanded [N], [N·m], the motion per second, and the directions, or of a
  /// rigid_body the rows, of the contacts that press.
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
  /// The same from where the device is; the first of them has no speed.
  void add_at(const effort& force, const pose& at, double dt,
              std::span<const motion> pressing) noexcept {
    const motion travel = placed_ ? motion(Port::between(at_, at)) : motion(Port::zero());
    at_ = at;
    placed_ = true;
    add(force, motion(travel * (scalar(1) / scalar(dt))), dt, pressing);
  }
  /// The hand or the world has changed: the clock begins anew.
  void news() noexcept {
    news_ = since_ = time_;
    judged_ = false;
    begin();
  }

  /// Is the last window within the bars?
  [[nodiscard]] bool quiet() const noexcept { return judged_; }
  /// Since when it has been so [s], by the sum of the ticks; NaN where it is not.
  [[nodiscard]] double since() const noexcept {
    return judged_ ? since_ : std::numeric_limits<double>::quiet_NaN();
  }
  /// From the last news until it was [s].
  [[nodiscard]] double settling() const noexcept { return since() - news_; }
  [[nodiscard]] double time() const noexcept { return time_; }  ///< of all ticks [s]
  /// Of the last window.
  [[nodiscard]] const quiet_figures& figures() const noexcept { return last_; }
  /// What the last window that was not quiet has missed; none where there has been no such.
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
      if (!(along <= fastest)) fastest = along;  // so written, a NaN stays
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
