// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Attacks that try to draw energy out of a port that turns.
//
//   jumping_contact    a point of the handle on a plane that jumps, under any hand: wanted wrenches
//   run_hand           a rigid_hand in it, on a rigid_device                  for bounds that know the hand
//   coning_path        a tick's turn along an arc: the paths of lemma C that lose most
//   run_paths          a velocity source on such arcs, on straight turns and on travels     for any bound
//   press_and_drain    arcs against one torque for a while, and then forces that spend all that the ledger holds
//
// Each run returns the least true energy and the least of the ledger; a bench may ask for more runs.

#include "rigid_hand.hpp"
#include <passive_haptics/base/seconds.hpp>

#include <cmath>
#include <cstdint>

namespace rigid {

/// The result of a run, or of many.
struct rigid_outcome {
  double least_energy = 0.0;    ///< true, at the port [J]
  double least_ledger = 0.0;    ///< [J]
  double worst_residual = 0.0;  ///< of the integration [J]
  long asked = 0, cut = 0;      ///< ticks in which something was asked, and got less

  void add(const rigid_outcome& other) noexcept {
    least_energy = ph::kernels::smaller(least_energy, other.least_energy);
    least_ledger = ph::kernels::smaller(least_ledger, other.least_ledger);
    worst_residual = ph::kernels::larger(worst_residual, other.worst_residual);
    asked += other.asked;
    cut += other.cut;
  }
};

/// A point of the handle on a stiff one-sided plane that jumps and turns, so that it is deep at once.
class jumping_contact {
 public:
  explicit jumping_contact(std::uint64_t seed) noexcept : random_(seed) {
    stiffness_ = 1000.0 * std::pow(10.0, 1.5 * (random_.number<double>() + 1) / 2);
    moment_ = seed % 4 == 3 ? 3.0 : 0.0;
  }
  /// The wrench wanted at a pose.
  [[nodiscard]] body::effort wanted(const body::pose& x) noexcept {
    if (tick_ % 200 == 0) place_anew(x);
    if (tick_ % 37 == 0) offset_ += random_.number<double>() * 1e-3;
    ++tick_;
    const vec3 arm = ph::rotation::rotate(x.orientation, arm_);
    double depth = offset_ - (vec3(x.position) + arm).dot(normal_);
    if (depth > 0.02) {
      offset_ -= depth - 0.001;
      depth = 0.001;
    }
    if (!(depth > 0)) return body::zero();
    const double push = ph::kernels::smaller(stiffness_ * depth, 50.0);
    const vec3 f = normal_ * push;
    return body::join(f, vec3(d3::cross(arm, f) + arm * (moment_ * push)));
  }
  [[nodiscard]] const vec3& normal() const noexcept { return normal_; }

 private:
  void place_anew(const body::pose& x) noexcept {
    normal_ = random_.direction<d3>();
    arm_ = random_.direction<d3>() * 0.06;
    offset_ = (vec3(x.position) + ph::rotation::rotate(x.orientation, arm_)).dot(normal_) +
              random_.number<double>() * 1e-3;
  }

  ph::laws::samples random_;
  vec3 normal_ = vec3(0, 0, 1), arm_ = vec3(0, 0, 0);
  double stiffness_, moment_, offset_ = 0.0;
  int tick_ = 0;
};

/// A sample in the types of a port whose poses and efforts are those of a rigid_body.
template <class Port>
[[nodiscard]] ph::device_sample<typename Port::port_type> as_told(
    const ph::device_sample<body>& sample) noexcept {
  return {.position = sample.position, .held = sample.held, .dt = sample.dt, .valid = sample.valid};
}

/// An attack of a hand on a device. In every fifth run the handle spins at first, at `spin` [rad/s].
struct rigid_attack {
  sim::rigid_device_parameters device{};
  rigid_hand_parameters hand{};
  int ticks = 4000;
  double spin = 40.0;
};

/// One run. `port` takes wanted wrenches (given_force) of a rigid_body<double> and is told the latency.
template <class Port>
[[nodiscard]] rigid_outcome run_hand(Port port, const rigid_attack& attack, std::uint64_t seed) {
  ph::laws::samples random(seed + 1000);
  const vec3 spin = random.direction<d3>() * (seed % 5 == 0 ? attack.spin : 0.0);
  const body::pose start{{0, 0, 0}, ph::rotation::exp<double>(vec3(random.direction<d3>() * 2.0))};
  sim::rigid_device device(attack.device, start, spin);
  auto habit = attack.hand;
  habit.habit = static_cast<rigid_habit>(seed % 4);
  rigid_hand hand(habit, seed + 2000);
  jumping_contact contact(seed);
  rigid_outcome out;
  body::effort command =
      port.tick(device.at(), ph::seconds{attack.device.period}, body::zero()).force;
  for (int n = 0; n < attack.ticks; ++n) {
    device.push(hand.push(device, command, contact.normal()));
    const auto sample = device.exchange(command);
    const body::effort wanted = contact.wanted(sample.position);
    const auto result = port.tick(as_told<Port>(sample), wanted);
    command = result.force;
    const bool something = !(wanted == body::zero());
    out.asked += something;
    out.cut += something && result.limited;
    out.least_energy = ph::kernels::smaller(out.least_energy, device.energy());
    out.least_ledger = ph::kernels::smaller(out.least_ledger, static_cast<double>(result.energy));
  }
  out.worst_residual = std::fabs(device.residual());
  return out;
}
template <class Port>
[[nodiscard]] rigid_outcome run_hands(const Port& port, const rigid_attack& attack, int runs,
                                      int first = 0) {
  rigid_outcome all;
  for (int i = 0; i < runs; ++i) {
    all.add(run_hand(port, attack, static_cast<std::uint64_t>(first + i)));
  }
  return all;
}

/// A world that knows the port, the device and the hand, and asks each time for the wrench that leaves the least
/// energy: it tries `looks` wrenches on copies of port and device. The hand moves the handle against the plan
/// while nothing is asked for, and along it afterwards.
template <class Port>
[[nodiscard]] rigid_outcome run_schemer(Port port, const rigid_attack& attack, std::uint64_t seed,
                                        int looks = 8) {
  ph::laws::samples random(seed + 5000);
  const auto unit = [&random] { return vec3(random.direction<d3>()); };
  const auto share = [&random] { return (random.number<double>() + 1) / 2; };
  const auto length_one = [&](const vec3& v) {
    const double length = v.norm();
    return length > 1e-9 ? vec3(v / length) : unit();
  };
  sim::rigid_device device(attack.device, {}, vec3(unit() * (seed % 2 == 0 ? attack.spin : 0.0)));
  rigid_outcome out;
  const body::effort nothing = body::zero();
  body::effort command = port.tick(device.at(), ph::seconds{attack.device.period}, nothing).force;
  vec3 plan_f = unit(), plan_t = unit();
  vec3 last_v(0, 0, 0), last_rate = device.rate();
  const double most_force = 50.0 * std::pow(10.0, -2 * share());
  const double most_torque = 0.5 * std::pow(10.0, -1 * share());
  const int rest = static_cast<int>(seed % 3);  // ticks between two wrenches
  int waited = 0;
  for (int n = 0; n < attack.ticks; ++n) {
    if (n % 16 == 0) {
      plan_f = unit();
      plan_t = unit();
    }
    const bool waiting = command == nothing;
    const double way = waiting ? -1.0 : 1.0;
    const vec3 p = device.at().position, rate = device.rate();
    vec3 hand_f = plan_f * (way * attack.hand.force), hand_t = plan_t * (way * attack.hand.torque);
    if (!waiting) {
      hand_f = length_one(body::linear(command)) * attack.hand.force;
      hand_t = length_one(body::angular(command)) * attack.hand.torque;
    }
    if (p.norm() > attack.hand.room) hand_f = p * (-attack.hand.force / p.norm());
    if (rate.norm() > attack.hand.fastest) hand_t = rate * (-attack.hand.torque / rate.norm());
    device.push(body::join(hand_f, hand_t));
    const auto sample = device.exchange(command);

    const vec3 v = device.velocity(), turning = device.rate();
    const vec3 change = v - last_v, turning_change = turning - last_rate;
    last_v = v;
    last_rate = turning;
    body::effort best = nothing;
    double least = ph::kernels::largest<double>();
    const bool asks = waited >= rest;
    for (int i = 0; asks && i < looks; ++i) {
      const auto choose = [&](const vec3& gone, const vec3& changed, const vec3& planned) {
        const double blend = share(), kind = share();
        const vec3 base = kind < 0.3   ? length_one(gone)
                          : kind < 0.6 ? length_one(changed)
                                       : planned;
        const double sign = share() < 0.5 ? -1.0 : 1.0;
        return length_one(base * sign + unit() * (2 * blend));
      };
      const double size = share() < 0.5 ? 1.0 : std::pow(10.0, -2 * share());
      const double force = share() < 0.3 ? 0.0 : size * most_force;
      const vec3 f = choose(v, change, plan_f) * force;
      const vec3 torque = choose(turning, turning_change, plan_t) * (size * most_torque);
      const body::effort wanted = body::join(f, torque);
      auto its_port = port;
      auto its_device = device;
      const body::effort allowed = its_port.tick(as_told<Port>(sample), wanted).force;
      its_device.push(
          body::join(length_one(f) * attack.hand.force, length_one(torque) * attack.hand.torque));
      for (int k = 0; k <= attack.device.latency; ++k) {
        static_cast<void>(its_device.exchange(k == 0 ? allowed : nothing));
      }
      if (its_device.energy() < least) {
        least = its_device.energy();
        best = wanted;
      }
    }
    waited = asks ? 0 : waited + 1;
    const auto result = port.tick(as_told<Port>(sample), best);
    command = result.force;
    out.asked += asks;
    out.cut += asks && result.limited;
    out.least_energy = ph::kernels::smaller(out.least_energy, device.energy());
    out.least_ledger = ph::kernels::smaller(out.least_ledger, static_cast<double>(result.energy));
  }
  out.worst_residual = std::fabs(device.residual());
  return out;
}
template <class Port>
[[nodiscard]] rigid_outcome run_schemers(const Port& port, const rigid_attack& attack, int runs,
                                         int first = 0) {
  rigid_outcome all;
  for (int i = 0; i < runs; ++i) {
    all.add(run_schemer(port, attack, static_cast<std::uint64_t>(first + i)));
  }
  return all;
}

/// The turn of a tick: ω(t) is ω₀ turning about the unit vector `axis` at `spin` [rad/s]; straight if spin is 0.
/// All its quantities are known in closed form.
struct coning_path {
  vec3 start = vec3(0, 0, 0);  ///< ω₀ [rad/s]
  vec3 axis = vec3(0, 0, 1);
  double spin = 0.0;

  /// ∫ω dt [rad]: a torque τ held in the world frame does the work τ·∫ω dt.
  [[nodiscard]] vec3 integral(double T) const noexcept {
    const double angle = spin * T;
    if (std::fabs(angle) < 1e-9) return start * T;
    const vec3 along = axis * axis.dot(start);
    const vec3 across = start - along;
    return along * T + across * (std::sin(angle) / spin) +
           d3::cross(axis, across) * ((1 - std::cos(angle)) / spin);
  }
  /// The orientation at its end.
  [[nodiscard]] ph::quaternion<double> end(const ph::quaternion<double>& q,
                                           double T) const noexcept {
    const auto inner =
        ph::rotation::product(ph::rotation::exp<double>(vec3((start - axis * spin) * T)), q);
    return ph::rotation::normalised(
        ph::rotation::product(ph::rotation::exp<double>(vec3(axis * (spin * T))), inner));
  }
};

/// The extremals of lemma C (Pontryagin): a part of ω along the torque, the rest turning about it by 2φ.
[[nodiscard]] inline coning_path extremal(const vec3& torque, double b_angular, double T,
                                          double along, double across, const vec3& direction,
                                          double share = 1.0) noexcept {
  const double size = torque.norm();
  const vec3 unit = torque / size;
  vec3 side = direction - unit * unit.dot(direction);
  side = side / side.norm();
  const double phi = share * size * T / (4 * b_angular);
  return {unit * (along / T) + side * (across / T), unit, 2 * phi / T};
}

/// A source of motions on a device with that damping, and its meter.
class path_source {
 public:
  path_source(double b, double b_angular, double loan) noexcept
      : b_(b), b_angular_(b_angular), energy_(loan) {}

  /// A tick of length T in which w was held: a travel and a turn.
  void move(const body::effort& w, const vec3& travel, const coning_path& path, double T) noexcept {
    x_ = {vec3(vec3(x_.position) + travel), path.end(x_.orientation, T)};
    energy_ += b_ * travel.dot(travel) / T + b_angular_ * path.start.dot(path.start) * T -
               body::linear(w).dot(travel) - body::angular(w).dot(path.integral(T));
  }
  [[nodiscard]] const body::pose& at() const noexcept { return x_; }
  [[nodiscard]] double energy() const noexcept { return energy_; }

 private:
  double b_, b_angular_;
  double energy_;
  body::pose x_{};
};

/// The settings of a velocity source.
struct path_attack {
  double linear = 0.03, angular = 1e-4;  ///< the true damping
  double loan = 0.0;                     ///< [J]
  double period = 1e-3;
  double shortest = 1.0;  ///< the shortest tick as a share of the period: jitter
  int latency = 0;
  int ticks = 2000;
};

/// Random wanted wrenches, and motions that are the worst of lemma L3, arcs about the torque, or random.
template <class Port>
[[nodiscard]] rigid_outcome run_paths(Port port, const path_attack& attack, std::uint64_t seed) {
  ph::laws::samples random(seed + 3000);
  const auto unit = [&random] { return vec3(random.direction<d3>()); };
  const auto share = [&random] { return (random.number<double>() + 1) / 2; };
  const auto at_most = [&](double size) {  // a vector of any direction, no longer than `size`
    const vec3 direction = unit();
    return vec3(direction * (size * share()));
  };
  path_source source(attack.linear, attack.angular, attack.loan);
  rigid_outcome out;
  body::effort held = body::zero();
  body::effort next = port.tick(source.at(), ph::seconds{attack.period}, held).force;
  body::effort later = next;
  for (int n = 0; n < attack.ticks; ++n) {
    held = attack.latency > 0 ? later : next;
    later = next;
    const double T =
        attack.period * (share() < 0.3 ? 1.0 : attack.shortest + (1 - attack.shortest) * share());
    const bool saving = (n / 500) % 2 != 0;  // the other half presses with arcs
    const vec3 f = body::linear(held), torque = body::angular(held);
    vec3 travel = f * (T / (2 * attack.linear)) * (share() < 0.3 ? 1.0 : 1.3 * share());
    if (share() < 0.5) travel += at_most(1e-3);
    coning_path path;
    const double kind = share();
    if (kind < 0.25 || !(torque.norm() > 0)) {
      path.start = at_most(0.2) / T;
    } else if (kind < (saving ? 0.9 : 0.4)) {
      vec3 turn = torque * (T / (2 * attack.angular));
      if (turn.norm() > 1) turn = turn / turn.norm();
      path.start = turn * ((share() < 0.7 ? 1.0 : share()) / T);
    } else {
      const double across = share(), turning = share() < 0.5 ? 1.0 : 2 * share();
      path = extremal(torque, attack.angular, T, 0.0, across, unit(), turning);
    }
    source.move(held, travel, path, T);
    const vec3 wanted_force = at_most(saving ? 20.0 : 0.4), wanted_torque = at_most(1.0);
    const body::effort wanted = body::join(wanted_force, wanted_torque);
    const auto result =
        port.tick({.position = source.at(), .held = held, .dt = T, .valid = true}, wanted);
    next = result.force;
    out.asked += 1;
    out.cut += result.limited;
    out.least_energy = ph::kernels::smaller(out.least_energy, source.energy());
    out.least_ledger = ph::kernels::smaller(out.least_ledger, static_cast<double>(result.energy));
  }
  return out;
}
template <class Port>
[[nodiscard]] rigid_outcome run_all_paths(const Port& port, const path_attack& attack, int runs,
                                          int first = 0) {
  rigid_outcome all;
  for (int i = 0; i < runs; ++i) {
    all.add(run_paths(port, attack, static_cast<std::uint64_t>(first + i)));
  }
  return all;
}

/// `presses` ticks of one and the same arc against the largest torque of which lemma C speaks, then forces
/// and the worst travel against them, until the ledger has nothing left. `along` and `across` are the
/// two parts of the arc [rad]; a margin of 1/40 loses most at −0.75 and 0.78.
template <class Port>
[[nodiscard]] rigid_outcome press_and_drain(Port port, const path_attack& attack, int presses,
                                            double along, double across) {
  const double T = attack.period;
  path_source source(attack.linear, attack.angular, attack.loan);
  rigid_outcome out;
  const body::effort twist = body::join({0, 0, 0}, {0, 0, 4 * attack.angular / T});
  body::effort held = port.tick(source.at(), ph::seconds{T}, twist).force;
  for (int n = 0; n < presses + 100; ++n) {
    const bool pressing = n < presses && body::angular(held).norm() > 0;
    coning_path path;
    vec3 travel(0, 0, 0);
    if (pressing) {
      const double turned = 2.4 * n;  // so that the arcs do not add up to a turn about one axis
      path = extremal(body::angular(held), attack.angular, T, along, across,
                      {std::cos(turned), std::sin(turned), 0});
    } else {
      travel = body::linear(held) * (T / (2 * attack.linear));
    }
    source.move(held, travel, path, T);
    const vec3 force(n % 2 == 0 ? 30.0 : -30.0, 0, 0);
    const body::effort wanted = n + 1 < presses ? twist : body::join(force, {0, 0, 0});
    const auto result = port.tick(source.at(), ph::seconds{T}, wanted);
    held = result.force;
    out.least_energy = ph::kernels::smaller(out.least_energy, source.energy());
    out.least_ledger = ph::kernels::smaller(out.least_ledger, static_cast<double>(result.energy));
  }
  return out;
}

}  // namespace rigid
