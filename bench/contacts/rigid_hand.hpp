// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Hands on a rigid_device: a force and a torque within their limits, chosen anew in each tick.
//
//   random    any direction, kept for up to 40 ticks
//   tapping   with the motors' wrench or against it, in turns of up to 6 ticks
//   swinging  two ticks one way, two ticks back, across the contact
//   greedy    with the motors while they move it, else against them
//
// Each hand interrupts its pattern to bring back a handle that is too far away or spins too fast.

#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/simulation/rigid_device.hpp>

#include <cstdint>

namespace rigid {

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using body = ph::rigid_body<double>;
using vec3 = body::triple;
using d3 = ph::space<double, 3>;

enum class rigid_habit : std::uint8_t { random, tapping, swinging, greedy };

struct rigid_hand_parameters {
  rigid_habit habit = rigid_habit::random;
  double force = 5.0;     ///< largest force [N]
  double torque = 0.2;    ///< largest torque [N·m]
  double room = 0.05;     ///< largest distance of the handle from the origin [m]
  double fastest = 60.0;  ///< largest rate of the handle [rad/s]
};

class rigid_hand {
 public:
  rigid_hand(const rigid_hand_parameters& parameters, std::uint64_t seed) noexcept
      : p_(parameters), random_(seed) {}

  /// The wrench of the hand in the coming tick; `across` is a direction of the contact.
  [[nodiscard]] body::effort push(const sim::rigid_device& device, const body::effort& motors,
                                  const vec3& across) noexcept {
    choose(device, motors, across);
    vec3 force = force_, torque = torque_;
    const vec3 p = device.at().position, rate = device.rate();
    if (p.norm() > p_.room) force = p * (-p_.force / p.norm());
    if (rate.norm() > p_.fastest) torque = rate * (-p_.torque / rate.norm());
    return body::join(force, torque);
  }

 private:
  [[nodiscard]] double number() noexcept { return random_.number<double>(); }
  [[nodiscard]] vec3 any() noexcept { return random_.direction<d3>(); }
  /// The unit vector along v, or along any direction if v is zero.
  [[nodiscard]] vec3 along(const vec3& v) noexcept {
    const double length = v.norm();
    return length > 1e-9 ? vec3(v / length) : any();
  }
  [[nodiscard]] int ticks(int most) noexcept {
    return 1 + static_cast<int>(random_.bits() % static_cast<std::uint64_t>(most));
  }
  /// Pushes along unit vectors `force` and `torque`. They are drawn before the call, as arguments have no order.
  void push_along(const vec3& force, const vec3& torque, double share) noexcept {
    force_ = force * (share * p_.force);
    torque_ = torque * (share * p_.torque);
  }
  void choose(const sim::rigid_device& device, const body::effort& motors,
              const vec3& across) noexcept {
    const vec3 f = body::linear(motors), torque = body::angular(motors);
    ++tick_;
    const bool holds = p_.habit == rigid_habit::random || p_.habit == rigid_habit::tapping;
    if (holds && --left_ > 0) return;
    const vec3 force_way = along(f), torque_way = along(torque), other = any(), another = any();
    const double one = number(), two = number();
    switch (p_.habit) {
      case rigid_habit::random:
        left_ = ticks(40);
        return push_along(other, another, one < 0 ? 1.0 : two);
      case rigid_habit::tapping:
        left_ = ticks(6);
        return push_along(force_way, torque_way, one < 0 ? 1.0 : -1.0);
      case rigid_habit::swinging:
        return push_along(across, along(d3::cross(across, other)), tick_ % 4 < 2 ? -1.0 : 1.0);
      case rigid_habit::greedy: {
        const bool out = f.dot(device.velocity()) + torque.dot(device.rate()) > 0;
        return push_along(force_way, torque_way, out || one > 0.6 ? 1.0 : -1.0);
      }
    }
  }

  rigid_hand_parameters p_;
  ph::laws::samples random_;
  vec3 force_ = vec3(0, 0, 0), torque_ = vec3(0, 0, 0);
  int left_ = 0, tick_ = 0;
};

}  // namespace rigid
