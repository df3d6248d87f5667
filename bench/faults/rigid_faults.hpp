// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The same faults in six degrees of freedom, of a tool that a hand presses on a floor or into a hole, and those that a
// turning handle has besides.

#include "faults.hpp"
#include <passive_haptics/simulation/rigid_device.hpp>
#include <passive_haptics/six_dof.hpp>

#include <memory>

namespace faults::rigid {

using body = ph::rigid_body<double>;
using triple = body::triple;
using rigid_sample = ph::device_sample<body>;

/// A fault of the whole pose.
struct rigid_fault {
  fault of;  ///< of the place, the force held and the time
  std::function<void(rigid_sample&)> turn = [](rigid_sample&) {};  ///< and of what only a pose has
};
[[nodiscard]] inline const fault& plain(const rigid_fault& f) {
  return f.of;
}

/// Every fault of the table, on place, force and dt; then those of orientation and torque.
[[nodiscard]] inline std::vector<rigid_fault> rigid_faults() {
  std::vector<rigid_fault> all;
  for (const fault& f : single_faults()) all.push_back({f});
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const auto add = [&all](const std::string& name, int lasts, auto spoil) {
    all.push_back({{name, lasts}, spoil});
  };
  for (const double degrees : {0.1, 1.0, 5.0, 30.0, 179.0}) {
    for (const double sign : {1.0, -1.0}) {
      const std::string size = (sign > 0.0 ? "+" : "-") + std::to_string(degrees).substr(0, 4);
      const auto turned = [by = sign * degrees / 57.29577951](rigid_sample& s) {
        const ph::quaternion<double> extra{std::cos(by / 2), 0.0, std::sin(by / 2), 0.0};
        s.position.orientation = ph::rotation::product(extra, s.position.orientation);
      };
      add("turned by " + size + " deg", 1, turned);
      add("5 ticks turned by " + size + " deg", 5, turned);
    }
  }
  for (const double w : {nan, inf, 0.0, 1e300}) {
    add("orientation " + std::to_string(w).substr(0, 5), 1, [w](rigid_sample& s) {
      s.position.orientation = ph::quaternion<double>{w, 0.0, 0.0, 0.0};
    });
  }
  for (const double torque : {0.1, -0.1, 5.0, -5.0, 1e30, nan}) {
    add("held torque " + std::to_string(torque).substr(0, 5) + " N m", 1,
        [torque](rigid_sample& s) {
          s.held = body::join(triple(body::linear(body::effort(s.held))), triple(0, torque, 0));
        });
  }
  return all;
}

struct rigid_answer {
  body::effort wrench;
  ph::event what;
};
struct rigid_controller {
  std::function<rigid_answer(const rigid_sample&)> tick;
  std::function<void(int)> publish;  ///< what the world says of all surfaces: `world` of a fault
};

/// A tool and what it touches.
struct rigid_subject {
  std::string name;
  double limit = 9.0, torque_limit = 0.5;  ///< [N], [N·m]
  double amends = 0.0;                     ///< A of § 11 [J]
  double start = 4e-3;                     ///< of the handle above where it rests on the floor [m]
  std::function<rigid_controller(double amends)> make;
};

struct rigid_course {
  std::vector<double> force, depth, turn;  ///< upward [N], of the handle below its rest [m], [rad]
  double largest = 0.0, torque = 0.0;      ///< [N], [N·m]
  double created = 0.0;                    ///< [J]
  ph::event worst = ph::event::nominal;
  bool finite = true;
};

[[nodiscard]] inline body::effort held_by_hand(const sim::rigid_device& device, double target) {
  const auto within = [](triple v, double most) {
    const double size = v.norm();
    return size > most ? triple(v * (most / size)) : v;
  };
  const auto at = device.at();
  const triple x = at.position, turned = ph::rotation::log(at.orientation);
  const triple force = (triple(0, 0, target) - x) * 300.0 - device.velocity() * 2.0;
  const triple torque = (triple(0, 0.02, 0) - turned) * 0.5 - device.rate() * 2e-3;
  return body::join(within(force, 5.0), within(torque, 0.1));
}

[[nodiscard]] inline rigid_course press(const rigid_subject& who, double amends, bool taps, int at,
                                        const rigid_fault* f, int ticks = 3000) {
  sim::rigid_device device({.substeps = 4}, {.position = {0, 0, who.start}, .orientation = {}});
  const rigid_controller loop = who.make(amends);
  rigid_course all;
  rigid_sample s = device.exchange(body::zero());
  auto before = s.position;
  for (int n = 0; n < ticks;) {
    rigid_sample shown = s;
    if (f && n >= at && n < at + f->of.lasts) {
      sample flat{.position = s.position.position,
                  .held = triple(body::linear(body::effort(s.held))),
                  .dt = s.dt,
                  .valid = true};
      f->of.spoil(flat);
      shown.position.position = flat.position;
      shown.held =
          body::join(triple(vector(flat.held)), triple(body::angular(body::effort(s.held))));
      shown.dt = flat.dt;
      shown.valid = flat.valid;
      f->turn(shown);
      if (f->of.stuck) shown.position = before;
    } else {
      before = shown.position;
    }
    if (f && f->of.world != right && n == at) loop.publish(f->of.world);
    if (f && f->of.world != right && n == at + f->of.lasts) loop.publish(right);
    const rigid_answer a = loop.tick(shown);
    const triple force = body::linear(a.wrench), torque = body::angular(a.wrench);
    all.finite = all.finite && force.allFinite() && torque.allFinite();
    all.largest = std::max(all.largest, force.norm());
    all.torque = std::max(all.torque, torque.norm());
    if (n >= at) all.worst = ph::worse(all.worst, a.what);
    double dt = 0.0;
    for (int left = f && n == at ? f->of.held : 1; left > 0; --left, ++n) {
      const double in = std::min(n, 250) / 250.0;
      const double tap = taps && n > 400 ? 7e-3 * (1.0 - std::cos(6.2832e-3 * (n - 400))) : 0.0;
      device.push(held_by_hand(device, who.start - (who.start + 10e-3) * in + tap));
      s = device.exchange(a.wrench);
      dt += s.dt;
      all.created = std::max(all.created, -device.energy());
      all.force.push_back(force.z());
      all.depth.push_back(-device.at().position.values[2]);
      all.turn.push_back(ph::rotation::log(device.at().orientation).y());
    }
    s.dt = dt;
  }
  return all;
}

template <class Port>
rigid_controller loop_of(Port port, double amends, auto tell) {
  tell(port, right);
  auto ledger = port.observer().parameters();
  ledger.amends = amends;
  (void)port.set(ledger);
  const auto own = std::make_shared<Port>(port);
  return {[own](const rigid_sample& s) {
            const auto out = own->tick(s);
            return rigid_answer{out.force, out.what};
          },
          [own, tell](int what) { tell(*own, what); }};
}
inline constexpr ph::rigid_device tool{.inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4},
                                       .damping = {.linear = 0.015, .angular = 5e-5},
                                       .damping_most = {.linear = 0.06, .angular = 2e-4},
                                       .force_limit = 9.0,
                                       .torque_limit = 0.5,
                                       .longest_tick = T};

/// Tells a block of 20 mm by 20 mm by 40 mm that hangs from the handle what it may touch: a floor, or a hole that is
/// 0.5 mm wider.
[[nodiscard]] inline auto surroundings(double K, bool hole) {
  return [K, hole](auto& port, int what) {
    constexpr double half = 0.01, length = 0.04, room = half + 0.00025;
    std::vector<std::pair<triple, plane>> all;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {-length, 0.0}) {
          const triple corner(half * x, half * y, z);
          if (hole) all.push_back({corner, plane{{room * x, 0, 0}, {-x, 0, 0}, K}});
          if (hole) all.push_back({corner, plane{{0, room * y, 0}, {0, -y, 0}, K}});
          if (z < 0) all.push_back({corner, plane{{0, 0, -length}, {0, 0, 1}, K}});
        }
      }
    }
    const std::size_t first = what == other_order ? 1 : 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto& [corner, is] = all[(i + first) % all.size()];
      (void)port.source().update(static_cast<int>(i), corner, told_as(what, is));
    }
  };
}
[[nodiscard]] inline std::vector<rigid_subject> rigid_subjects() {
  const double A = ph::amends_for(tool.force_limit);
  constexpr ph::rigid_hand hand{.force = 6.0, .torque = 0.15};
  std::vector<rigid_subject> all;
  for (const double K : {650.0, 2000.0}) {
    const std::string stiff = std::to_string(int(K)) + " N/m";
    all.push_back({"tool on a floor, " + stiff, 9.0, 0.5, A, 4e-3, [=](double amends) {
                     return loop_of(ph::make_tool(tool, hand, ph::slots<plane, 4>{}), amends,
                                    surroundings(K, false));
                   }});
    all.push_back({"peg in a hole, " + stiff, 9.0, 0.5, A, 4e-3, [=](double amends) {
                     return loop_of(ph::make_tool(tool, hand, ph::slots<plane, 20>{}), amends,
                                    surroundings(K, true));
                   }});
  }
  return all;
}

}  // namespace faults::rigid
