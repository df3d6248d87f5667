// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Falcon as a haptic device: it takes a force [N] and returns the position of the grip [m], once per packet.
//
//   force ─▶ finite? ─▶ ‖F‖ ≤ limit ─▶ × ramp ─▶ τ = A⁻ᵀF ─▶ words, |word| ≤ 4095 ─▶ packet ─▶
//                                                                                      Falcon
//   sample ◀─ held force ◀─ position ◀─ forward ◀─ angles ◀─ jump? homed? ◀─ packet ◀─
//
// A [1/m] is that of the last reply. The answer to a packet shows where the grip was when the force of that packet
// BEGAN to be held, so a force computed from it is a tick late: compose with late_loop_limits<1>. `held` in a
// sample is the force of the packet before, computed from the words that were sent.
// If an exchange ends without a usable position, the motors are sent zero at once.

#include <passive_haptics/device/device_sample.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/falcon/settings.hpp>

#include <optional>
#include <type_traits>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// Models haptic_device_for<Space>. One thread owns it. It does not allocate after open().
///     falcon::device<falcon::libusb_transport> grip{falcon::cautious_gain<double>};
///     if (const auto done = grip.open(); !done) return complain(done);
///     if (const auto done = grip.start(); !done) return complain(done);  // or boot(grip, image): boot.hpp
///     if (const auto done = grip.home(std::chrono::minutes(1)); !done) return complain(done);
///     sample = grip.exchange(force);
template <transport Transport, class Space = space<double, 3>>
requires(Space::dof == 3) class device {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using settings_type = settings<scalar>;
  using reading_type = reading<scalar>;

  /// `gain` [DAC counts per N·m] is not published: see docs/falcon.md, and cautious_gain. The other
  /// arguments go to the transport.
  template <class... Arguments>
  explicit device(scalar gain, const settings_type& setup = {}, Arguments&&... arguments)
      : line_(std::forward<Arguments>(arguments)...), gain_(gain), setup_(setup) {}
  device(const device&) = delete;
  device& operator=(const device&) = delete;
  ~device() { (void)close(); }

  /// The first setting that is out of its range, if any. A device with such a setting does not open.
  [[nodiscard]] parameter_fault check() const noexcept {
    if (!(gain_ > scalar(0)) || !kernels::is_finite(gain_)) {
      return {"gain", static_cast<double>(gain_), "finite and > 0 counts per N·m"};
    }
    return setup_.check();
  }

  /// closed → open. The arguments say which device to open: see the transport.
  template <class... Which>
  result open(const Which&... which) noexcept {
    (void)close();
    if (check()) return fail({code::bad_setting});
    const result done = line_.open(which...);
    enter(done ? state::open : state::closed, done ? code::not_open : done.what);
    return done;
  }

  /// open → unhomed if a program runs already; without one the device stays open, and returns no_program.
  result start(const probing& how = {}) noexcept {
    return start([&](Transport& line) noexcept {
      return packet_link(line).find_program(how, [](int) { return result{}; });
    });
  }

  /// open → booting → unhomed, or back to open. `load(line)` starts a program and returns whether it runs, as
  /// boot() of boot.hpp does, which may take seconds.
  template <class Load>
  requires std::is_invocable_r_v<result, Load, Transport&> result start(const Load& load)
  noexcept {
    if (now_.where == state::closed) return {code::not_open};
    (void)silence_motors();
    enter(state::booting, code::not_open);
    const result done = load(line_);
    forget();
    enter(done ? state::unhomed : state::open, done ? code::not_homed : done.what);
    return done;
  }

  /// unhomed → homed: waits, for `most` at most, until the grip was pulled out and pushed in. `progress` is
  /// called with every reading; false cancels.
  template <class Progress>
  result home(nanoseconds most, const Progress& progress) noexcept {
    const nanoseconds deadline = line_.now() + most;
    while (now_.where == state::unhomed) {
      if (line_.now() >= deadline) return {code::homing_timeout};
      (void)exchange(Space::zero());
      if (!progress(now_)) return {code::cancelled};
    }
    if (now_.where == state::homed) return {};
    return {now_.where == state::fault ? now_.what : code::not_open};
  }
  result home(nanoseconds most) noexcept {
    return home(most, [](const reading_type&) { return true; });
  }

  /// Commands a force [N] and returns the Falcon's answer as a sample. A sample that is not valid has no
  /// usable position, and latest().what has the reason.
  device_sample<Space> exchange(const vector& wanted) noexcept {
    if (!talks()) return nothing();
    if (!Space::is_finite(wanted)) (void)fail({code::force_not_finite});
    now_.commanded = {{wanted(0), wanted(1), wanted(2)}};
    const dac_words held = now_.sent.motor;
    now_.sent = {.motor = words_for(now_.commanded), .light = light_.value_or(lamp())};
    const link_answer answer = link_.exchange(now_.sent, setup_.reply);
    const scalar dt = seconds(answer.asked - now_.asked);
    now_.asked = answer.asked;
    now_.stamp = answer.stamp;
    now_.counts = link_.counts();
    now_.lines = line_.lines();
    code why = answer.how ? look(answer.packet) : miss(answer.how);
    if (why == code::ok && !(dt > scalar(0))) why = code::clock_backwards;
    if (now_.where != state::fault) now_.what = why;
    if (why != code::ok) {
      lose_position();
      return {.dt = dt};
    }
    return locate(held, dt);
  }

  /// fault → unhomed, and → homed if the legs are still homed. Forces ramp up again.
  result recover() noexcept {
    if (now_.where != state::fault) return {};
    if (!talks()) return {now_.what};
    link_.forgive();
    enter(state::unhomed, code::not_homed);
    return {};
  }

  /// Any state → closed, motors at zero. If the result is not ok, nothing confirms that the zero arrived.
  result close() noexcept {
    result done{};
    if (now_.where >= state::unhomed) {
      done = talks() ? silence_motors() : result{code::unplugged};
    }
    line_.close();
    forget();
    enter(state::closed, code::not_open);
    return done;
  }

  /// Sets the lamps; nullopt restores the default, which is red without a position and green with one.
  void light(std::optional<lamps> own) noexcept { light_ = own; }

  [[nodiscard]] state where() const noexcept { return now_.where; }
  /// True from an unplug until the device is open again.
  [[nodiscard]] bool unplugged() const noexcept { return now_.what == code::unplugged; }
  [[nodiscard]] const reading_type& latest() const noexcept { return now_; }
  [[nodiscard]] scalar gain() const noexcept { return gain_; }
  [[nodiscard]] const settings_type& setup() const noexcept { return setup_; }
  [[nodiscard]] Transport& line() noexcept { return line_; }
  [[nodiscard]] const Transport& line() const noexcept { return line_; }

 private:
  [[nodiscard]] static constexpr scalar seconds(nanoseconds t) noexcept {
    return std::chrono::duration<scalar>(t).count();
  }

  [[nodiscard]] bool talks() const noexcept {
    return now_.where >= state::unhomed && now_.what != code::unplugged;
  }

  void enter(state next, code why) noexcept {
    now_.where = next;
    now_.what = why;
    now_.strength = scalar(0);
  }

  result fail(const result& why) noexcept {
    enter(now_.where == state::closed ? state::closed : state::fault, why.what);
    return why;
  }

  /// Forgets all readings, as after power-up.
  void forget() noexcept {
    link_.reset();
    now_ = reading_type{.where = now_.where, .asked = line_.now(), .stamp = line_.now()};
    pose_ = {};
    guard_ = {};
  }

  [[nodiscard]] device_sample<Space> nothing() noexcept {
    const nanoseconds then = std::exchange(now_.asked, line_.now());
    now_.stamp = now_.asked;
    return {.dt = seconds(now_.asked - then)};
  }

  [[nodiscard]] lamps lamp() const noexcept {
    return now_.where == state::homed ? lamps::green : lamps::red;
  }

  [[nodiscard]] dac_words words_for(const force<scalar>& f) const noexcept {
    if (now_.where != state::homed || !pose_) return {};
    const auto allowed = now_.strength * limited(f, setup_.force_limit);
    return encode(torques_for(pose_.rates, allowed), gain_);
  }

  /// Sends zero words, up to three times, until an answer confirms them.
  result silence_motors() noexcept {
    if (!talks()) return {};
    result done{};
    for (int tries = 0; tries < 3; ++tries) {
      now_.sent = {.light = lamps::red};
      done = link_.exchange(now_.sent, setup_.reply).how;
      if (done || done.what == code::unplugged) break;
    }
    return done;
  }

  [[nodiscard]] code miss(const result& how) noexcept {
    if (how.what == code::unplugged) {
      (void)fail(how);
    } else if (now_.counts.misses_in_row >= static_cast<std::uint32_t>(setup_.most_misses)) {
      (void)fail({code::too_many_misses});
    }
    return how.what;
  }

  /// Judges a reply and finds the position of the grip; returns ok, or the reason why there is none.
  [[nodiscard]] code look(const from_device& reply) noexcept {
    now_.received = reply;
    if (const code doubt = guard_.judge(reply, now_.stamp, setup_); doubt != code::ok) {
      const bool lost = doubt != code::settling;
      if (lost && now_.where == state::homed) enter(state::unhomed, doubt);
      return doubt;
    }
    if (now_.where == state::unhomed) enter(state::homed, code::ok);
    const leg_words& n = reply.encoder;
    turned_ = to_angles<scalar>({n[0], n[1], n[2]});
    next_ = forward(turned_, last_);
    if (!next_) next_ = forward(turned_);
    return next_ ? code::ok : code::pose_refused;
  }

  void lose_position() noexcept {
    now_.strength = scalar(0);
    now_.held = {};
    pose_ = {};
    if (now_.sent.motor != dac_words{} && talks()) {
      now_.sent.motor = {};
      (void)link_.send(now_.sent, setup_.reply);
    }
  }

  void climb(scalar dt) noexcept {
    const scalar step = kernels::larger(scalar(0), kernels::smaller(dt, setup_.tick)) / setup_.ramp;
    now_.strength = kernels::smaller(scalar(1), now_.strength + step);
  }

  /// The sample of a usable reply; `held` are the words of the packet before.
  [[nodiscard]] device_sample<Space> locate(const dac_words& held, scalar dt) noexcept {
    const auto torque = decode(held, gain_);
    now_.held = force_from(next_.rates, torque);
    if (pose_) {
      now_.held = force_over(now_.held, torque, turned_ - angles_, next_.position - last_);
      if (now_.where == state::homed) climb(dt);
    }
    pose_ = next_;
    last_ = next_.position;
    angles_ = turned_;
    now_.position = last_ - setup_.origin;
    return {.position = {now_.position[0], now_.position[1], now_.position[2]},
            .held = {now_.held[0], now_.held[1], now_.held[2]},
            .dt = dt,
            .valid = true};
  }

  Transport line_;
  packet_link<Transport> link_{line_};
  reply_guard<scalar> guard_{};
  scalar gain_;
  settings_type setup_;
  reading_type now_{};
  pose_result<scalar> next_{};                     ///< pose of this reply
  angles<scalar> turned_{};                        ///< angles of this reply
  pose_result<scalar> pose_{};                     ///< pose of the reply before, if it was usable
  point<scalar> last_ = workspace<scalar>.centre;  ///< last usable position, without `origin` [m]
  angles<scalar> angles_{};                        ///< angles at that position
  std::optional<lamps> light_;
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
