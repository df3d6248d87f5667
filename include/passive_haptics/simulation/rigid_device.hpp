// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated handle that moves and turns: pose out, wrench in, one tick per exchange.
//
//     m v̇_c = F,   F = f + f_hand − D v               v_c of the centre of mass, v of the handle point
//     I ω̇ + ω × I ω = τ + τ_hand − D_ω ω − c × F      in the frame of the handle, c from its point to the centre
//     E += ∫ (vᵀD v + ωᵀD_ω ω − w·(v, ω)) dt     true energy at the port, > 0: the hand has paid in
//
// Motion and energies are integrated by Runge and Kutta's fourth-order rule in equal steps. residual() is the
// energy error of the integration [J], which shows how accurate E is.

#include <passive_haptics/device/device_sample.hpp>
#include <passive_haptics/device/rigid_body.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// A body, in the frame of its handle. The axes of that frame are its principal axes.
struct rigid_device_parameters {
  double mass = 0.15;                                       ///< [kg]
  std::array<double, 3> moments{1e-4, 3e-4, 1.5e-4};        ///< about the centre of mass [kg·m²]
  std::array<double, 3> centre{};                           ///< of mass, from the handle point [m]
  std::array<double, 3> linear_damping{0.03, 0.03, 0.03};   ///< at the handle point [N·s/m]
  std::array<double, 3> angular_damping{1e-4, 1e-4, 1e-4};  ///< [N·m·s/rad]
  double period = 1e-3;                                     ///< [s]
  int substeps = 8;                                         ///< steps of integration per tick
  int latency = 0;  ///< ticks from command to holding, 0 or 1
};

class rigid_device {
 public:
  using port_type = rigid_body<double>;
  using pose = port_type::pose;
  using effort = port_type::effort;
  using vector = port_type::triple;

  explicit rigid_device(const rigid_device_parameters& parameters = {}, const pose& start = {},
                        const vector& rate = vector(0, 0, 0)) noexcept
      : p_(parameters) {
    const auto q = rotation::normalised(start.orientation);
    const vector turning = rotation::rotate(q, rate);
    const vector arm = rotation::rotate(q, of(p_.centre));
    put<0>(state_, vector(vector(start.position) + arm));
    put<3>(state_, cross(turning, arm));  // the handle point at rest
    put<6>(state_, rate);
    set(state_, q);
    kinetic_at_start_ = kinetic();
  }

  /// Sets the wrench of the hand at the handle point, in the world frame [N], [N·m].
  void push(const effort& hand) noexcept { hand_ = hand; }

  /// Commands a wrench and lets a tick pass; returns the pose at its end and the wrench held during it.
  [[nodiscard]] device_sample<port_type> exchange(const effort& command) noexcept {
    held_ = p_.latency > 0 ? effort(waiting_) : command;
    waiting_ = command;
    const double h = p_.period / p_.substeps;
    for (int i = 0; i < p_.substeps; ++i) step(h);
    return {.position = at(), .held = held_, .dt = p_.period, .valid = true};
  }

  [[nodiscard]] pose at() const noexcept {
    const auto q = turned(state_);
    return {vector(get<0>(state_) - rotation::rotate(q, of(p_.centre))), q};
  }
  /// The velocity of the handle point [m/s] and the rate of the handle [rad/s], in the world frame.
  [[nodiscard]] vector velocity() const noexcept { return handle_velocity(state_, turned(state_)); }
  [[nodiscard]] vector rate() const noexcept {
    return rotation::rotate(turned(state_), get<6>(state_));
  }
  [[nodiscard]] const effort& held() const noexcept { return held_; }

  /// True energy at the port [J].
  [[nodiscard]] double energy() const noexcept { return state_(13); }
  /// ΔE_kin + E − the work of the hand since the start [J]: zero but for errors of the integration.
  [[nodiscard]] double residual() const noexcept {
    return kinetic() - kinetic_at_start_ + energy() - state_(14);
  }

 private:
  /// Centre of mass (3), its velocity (3), rate in the handle's frame (3), quaternion (4), E, work of the hand.
  using state = Eigen::Matrix<double, 15, 1>;

  template <int First>
  [[nodiscard]] static vector get(const state& s) noexcept {
    return {s(First), s(First + 1), s(First + 2)};
  }
  template <int First>
  static void put(state& s, const vector& v) noexcept {
    for (int i = 0; i < 3; ++i) s(First + i) = v(i);
  }
  [[nodiscard]] static quaternion<double> turned(const state& s) noexcept {
    return {s(9), s(10), s(11), s(12)};
  }
  static void set(state& s, const quaternion<double>& q) noexcept {
    s(9) = q.w;
    s(10) = q.x;
    s(11) = q.y;
    s(12) = q.z;
  }
  [[nodiscard]] static vector of(const std::array<double, 3>& a) noexcept {
    return {a[0], a[1], a[2]};
  }
  [[nodiscard]] static vector cross(const vector& a, const vector& b) noexcept {
    return space<double, 3>::cross(a, b);
  }
  [[nodiscard]] static vector each(const std::array<double, 3>& by, const vector& v) noexcept {
    return {by[0] * v(0), by[1] * v(1), by[2] * v(2)};
  }
  [[nodiscard]] vector handle_velocity(const state& s, const quaternion<double>& q) const noexcept {
    return get<3>(s) - rotation::rotate(q, cross(get<6>(s), of(p_.centre)));
  }
  [[nodiscard]] double kinetic() const noexcept {
    const vector v = get<3>(state_), w = get<6>(state_);
    return (p_.mass * v.dot(v) + each(p_.moments, w).dot(w)) / 2;
  }

  [[nodiscard]] state slope(const state& s) const noexcept {
    const auto q = turned(s);
    const auto back = rotation::conjugate(q);
    const vector rate = get<6>(s);  // all in the handle's frame from here
    const vector v = rotation::rotate(back, get<3>(s)) - cross(rate, of(p_.centre));
    const vector f = rotation::rotate(back, port_type::linear(held_));
    const vector torque = rotation::rotate(back, port_type::angular(held_));
    const vector hand_f = rotation::rotate(back, port_type::linear(hand_));
    const vector hand_torque = rotation::rotate(back, port_type::angular(hand_));
    const vector drag = each(p_.linear_damping, v), turning_drag = each(p_.angular_damping, rate);
    const vector force = f + hand_f - drag;
    const vector about_centre = torque + hand_torque - turning_drag - cross(of(p_.centre), force) -
                                cross(rate, each(p_.moments, rate));
    state d;
    put<0>(d, get<3>(s));
    put<3>(d, rotation::rotate(q, vector(force / p_.mass)));
    put<6>(d, vector(about_centre(0) / p_.moments[0], about_centre(1) / p_.moments[1],
                     about_centre(2) / p_.moments[2]));
    const auto turning =
        rotation::product(q, quaternion<double>{0, rate(0) / 2, rate(1) / 2, rate(2) / 2});
    set(d, turning);
    d(13) = drag.dot(v) + turning_drag.dot(rate) - f.dot(v) - torque.dot(rate);
    d(14) = hand_f.dot(v) + hand_torque.dot(rate);
    return d;
  }
  void step(double h) noexcept {
    const state a = slope(state_);
    const state b = slope(state_ + a * (h / 2));
    const state c = slope(state_ + b * (h / 2));
    const state d = slope(state_ + c * h);
    state_ += (a + (b + c) * 2 + d) * (h / 6);
    set(state_, rotation::normalised(turned(state_)));
  }

  rigid_device_parameters p_;
  state state_ = state::Zero();
  effort hand_ = port_type::zero(), held_ = port_type::zero(), waiting_ = port_type::zero();
  double kinetic_at_start_ = 0.0;
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
