// SPDX-License-Identifier: BSD-3-Clause
// The assumptions of the named compositions on a mesh, in six degrees of freedom, and behind a transmission that
// gives, made untrue one at a time.
#include "../contacts/rigid_hand.hpp"
#include "../devices/transmissions.hpp"
#include "assumptions.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/mesh.hpp>
#include <passive_haptics/six_dof.hpp>

#include <memory>
#include <optional>
#include <random>

namespace controllers {

namespace {

using d3 = ph::space<double, 3>;

// ------------------------------------------------------------------------------------------ a mesh

/// A plate under a finger. Each copy that touches nothing gets a plate of its own when one is laid.
struct touched_plate {
  using space_type = d3;
  ph::mesh_touch<d3> port;
  std::shared_ptr<ph::mesh::surface> plate{};

  auto tick(const ph::device_sample<d3>& sample) noexcept {
    if (!sample.valid) return port.tick(sample);
    return port.tick(sample.position, ph::seconds{sample.dt});
  }
};
constexpr auto lay_plate = [](touched_plate& loop, const sim::surface_state<d3>& surface) {
  constexpr double half = 0.05, thickness = 0.01;  // [m]
  const d3::vector n = surface.normal, u = d3::orthogonal(n), w = d3::cross(n, u);
  std::vector<ph::mesh::triple> nodes;
  for (const double z : {0.0, -thickness}) {
    for (const double y : {-half, half}) {
      for (const double x : {-half, half}) {
        const d3::vector p = surface.point + u * x + w * y + n * z;
        nodes.push_back({p(0), p(1), p(2)});
      }
    }
  }
  if (loop.plate) return loop.plate->update(nodes);
  loop.plate = std::make_shared<ph::mesh::surface>(std::vector<ph::mesh::triangle>{{0, 1, 3},
                                                                                   {0, 3, 2},
                                                                                   {4, 7, 5},
                                                                                   {4, 6, 7},
                                                                                   {0, 5, 1},
                                                                                   {0, 4, 5},
                                                                                   {2, 3, 7},
                                                                                   {2, 7, 6},
                                                                                   {0, 2, 6},
                                                                                   {0, 6, 4},
                                                                                   {1, 5, 7},
                                                                                   {1, 7, 3}},
                                                   nodes);
  return loop.port.source().touch(*loop.plate);
};

struct mesh_world : sim::circumstances {
  bool any_motion = false;  ///< whether the hand is a velocity source
};

void add_meshes(std::vector<trial>& all) {
  const ph::exact_device device{.mass = 0.1, .damping = 0.03, .force_limit = 9.0};
  const ph::known_hand hand{.force = 5.0};
  const mesh_world told{{.damping = device.damping,
                         .mass = device.mass,
                         .hand_force = hand.force,
                         .force_limit = device.force_limit,
                         .watchdog = false}};
  const touched_plate loop{ph::make_mesh_touch<d3>(device, hand, {.stiffness = 5000.0})};
  const auto attack = [loop](const mesh_world& world, const effort& how) {
    const std::vector<sim::adversary> limited{
        sim::adversary::tapping, sim::adversary::random_tapping, sim::adversary::trembling};
    return most_drawn(loop, lay_plate, world,
                      world.any_motion ? std::vector{sim::adversary::greedy} : limited, how);
  };
  using world = sim::circumstances;
  const auto add = [&](const statement<mesh_world>& s) {
    all.push_back(trial_of("make_mesh_touch", told, s, attack));
  };
  add(scaled("mass, at least", &world::mass, "%.3g kg", 1.0, told, less));
  add(scaled("damping, at least", &world::damping, "%.3g N·s/m", 1.0, told, less));
  add(scaled("hand's force, at most", &world::hand_force, "%.3g N", 1.0, told, more));
  statement<mesh_world> limited{
      "hand limited in force",
      [](const mesh_world& w) { return std::string(w.any_motion ? "a velocity source" : "yes"); },
      {told}};
  limited.untrue.front().any_motion = true;
  add(limited);
  add(scaled("motors hold, at least", &world::force_limit, "%.3g N", 1.0, told, less));
  add(scaled("longest tick", &world::longest_tick, "%.3g ms", 1e-3, told, {2.0, 3.0, 10.0}));
  add(replaced("ticks of latency", &world::latency, "%g", 1.0, told, {1, 2, 5}));
  add(replaced("positions exact: steps of", &world::quantum, "%g µm", 1e-6, told,
               {10e-6, 100e-6, 1e-3}));
}

// ------------------------------------------------------------------------- six degrees of freedom

/// A handle as it is, and the largest wrenches of its motors and of the hand.
struct tool_world {
  double mass = 0.15;                                // [kg]
  double least = 1e-4, spread = 2e-4, offset = 0.0;  // of the moments [kg·m²]; of the centre [m]
  double linear = 0.03, angular = 1e-4;              // damping [N·s/m], [N·m·s/rad]
  double force = 5.0, torque = 0.2;                  // of the hand [N], [N·m]
  double force_limit = 9.0, torque_limit = 0.5;      // of the motors [N], [N·m]
  double period = 1e-3;                              // [s]
  int latency = 0;                                   // [ticks], 0 or 1
  double quantum = 0.0;  // of positions [m]; of orientations: 30 of it [rad]

  [[nodiscard]] sim::rigid_device_parameters device() const {
    return {.mass = mass,
            .moments = {least, least + spread, least + spread / 4.0},
            .centre = {offset, 0.0, 0.0},
            .linear_damping = {linear, linear, linear},
            .angular_damping = {angular, angular, angular},
            .period = period,
            .latency = latency};
  }
};

using body = rigid::body;
using rigid::vec3;
using plane = ph::half_space<d3>;

/// A wrench cut to what the motors hold.
body::effort held_by(const tool_world& w, const body::effort& command) {
  return body::join(sim::clamp_norm<d3>(body::linear(command), w.force_limit),
                    sim::clamp_norm<d3>(body::angular(command), w.torque_limit));
}

/// A plane at a point of the tool that jumps and turns, and a hand of one of four habits. The driver does not report
/// the wrench that it held.
template <class Port>
double one_tool(Port port, const tool_world& world, std::uint64_t seed) {
  ph::laws::samples random(seed + 1000);
  const auto share = [&random] { return (random.number<double>() + 1) / 2; };
  const body::pose start{{0, 0, 0}, ph::rotation::exp<double>(vec3(random.direction<d3>() * 2.0))};
  const vec3 spin = random.direction<d3>() * (seed % 3 == 0 ? 20.0 : 0.0);
  sim::rigid_device device(world.device(), start, spin);
  rigid::rigid_hand hand({.habit = static_cast<rigid::rigid_habit>(seed % 4),
                          .force = world.force,
                          .torque = world.torque,
                          .fastest = 30.0},
                         seed + 2000);
  const double K = 1000.0 * std::pow(10.0, 1.5 * share());
  const int every = seed % 2 == 0 ? 30 : 200;
  vec3 normal(0, 0, 1), arm(0, 0, 0);
  double least = 0.0;
  auto at = start;
  for (int n = 0; n < 2000; ++n) {
    if (n % every == 0) {
      normal = random.direction<d3>();
      arm = random.direction<d3>() * (0.06 * share());
      const vec3 tip = vec3(at.position) + ph::rotation::rotate(at.orientation, arm);
      port.source().update(0, arm,
                           plane{tip + normal * (random.number<double>() * 1e-3), normal, K});
    }
    const auto out = port.tick(at, ph::seconds{world.period});
    if (out.what == ph::event::rejected_sample) break;  // faster than stated: a loan follows
    const auto command = out.force;
    device.push(hand.push(device, command, normal));
    at = device.exchange(held_by(world, command)).position;
    if (world.quantum > 0.0) {
      const auto step = [](double x, double q) { return std::floor(x / q) * q; };
      vec3 p = at.position;
      for (int i = 0; i < 3; ++i) p(i) = step(p(i), world.quantum);
      at.position = p;
      auto& q = at.orientation;
      const double turn = 15.0 * world.quantum;  // half of it [rad]
      q = ph::rotation::normalised(ph::quaternion<double>{step(q.w, turn), step(q.x, turn),
                                                          step(q.y, turn), step(q.z, turn)});
    }
    least = std::min(least, device.energy());
  }
  return least;
}

void add_tools(std::vector<trial>& all) {
  const tool_world told;
  const auto port =
      ph::make_tool({.inertia = {told.mass, told.least, told.spread, told.offset},
                     .damping = {told.linear, told.angular},
                     .damping_most = {told.linear, told.angular},
                     .force_limit = told.force_limit,
                     .torque_limit = told.torque_limit},
                    {.force = told.force, .torque = told.torque}, ph::slots<plane, 1>{});
  const auto attack = [port](const tool_world& world, const effort& how) {
    constexpr const char* names[] = {"random wrench", "tapping wrench", "swinging wrench",
                                     "greedy wrench"};
    drawn most;
    for (int i = 0; i < 4 * how.runs * (world.spread > 1e-3 ? 20 : 1); ++i) {
      if (world.spread > 1e-3 && most.joules > 1e-9) break;  // one in some hundred draws anything
      const auto seed = how.first - 1 + static_cast<std::uint64_t>(i);
      most.count(one_tool(port, world, seed), names[seed % 4]);
    }
    return most;
  };
  using world = tool_world;
  const auto add = [&](const statement<world>& s, bool unpaid = false) {
    all.push_back(trial_of("make_tool", told, s, attack));
    all.back().unpaid = unpaid;
  };
  add(scaled("mass, at least", &world::mass, "%.3g kg", 1.0, told, less));
  add(scaled("moments of inertia, at least", &world::least, "%.3g kg·m²", 1.0, told, less));
  add(scaled("spread of the moments, at most", &world::spread, "%.3g kg·m²", 1.0, told, more));
  add(replaced("centre of mass off by, at most", &world::offset, "%g mm", 1e-3, told,
               {0.01, 0.03, 0.1}));
  add(scaled("linear damping, at least", &world::linear, "%.3g N·s/m", 1.0, told, less));
  add(scaled("linear damping, at most", &world::linear, "%.3g N·s/m", 1.0, told, more), true);
  add(scaled("angular damping, at least", &world::angular, "%.3g N·m·s/rad", 1.0, told, less));
  add(scaled("angular damping, at most", &world::angular, "%.3g N·m·s/rad", 1.0, told, more), true);
  add(scaled("hand's force, at most", &world::force, "%.3g N", 1.0, told, more));
  add(scaled("hand's torque, at most", &world::torque, "%.3g N·m", 1.0, told, more));
  add(scaled("motors hold, at least", &world::force_limit, "%.3g N", 1.0, told, less));
  add(scaled("motors' torque, at least", &world::torque_limit, "%.3g N·m", 1.0, told, less));
  add(scaled("longest tick", &world::period, "%.3g ms", 1e-3, told, {2.0, 3.0, 10.0}));
  add(replaced("ticks of latency", &world::latency, "%g", 1.0, told, {1}));
  add(replaced("poses exact: steps of", &world::quantum, "%g µm", 1e-6, told,
               {10e-6, 100e-6, 1e-3}));
}

// ------------------------------------------------------------------- transmissions that give

/// A rotor and a load with a spring and a damper between them, and what pushes on both.
struct chain_world {
  double rotor = 0.03, load = 0.07;                     // [kg]
  double spring = 3e3, loss = 0.5;                      // 60 Hz, ζ = 0.03 [N/m], [N·s/m]
  double damping = 0.1, friction = 0.0;                 // of the rotor [N·s/m], [N]
  double hand = 5.0, motors = 9.0;                      // at most [N]
  double period = 1e-3, shortest = 1.0, quantum = 0.0;  // [s], as a share of it, [m]
  int latency = 0;                                      // [ticks]
  /// What the transmission pulls at the most [N], and how fast that changes [N/s]; a run with more is not counted.
  double pull = std::numeric_limits<double>::infinity(), slew = pull;

  [[nodiscard]] sim::compliant_parameters<d1> device() const {
    const double mass = rotor + load, reduced = rotor * load / mass;
    const double omega = std::sqrt(spring / reduced);
    sim::compliant_parameters<d1> p;
    p.mass = mass;
    p.share = rotor / mass;
    p.mode = omega / (2.0 * std::numbers::pi);
    p.loss = loss / (2.0 * omega * reduced);
    p.damping = damping;
    p.friction = friction;
    p.force_limit = motors;
    p.quantum = quantum;
    p.period = period;
    p.substeps = std::max(30, static_cast<int>(std::ceil(3.0 * omega * period)));
    p.latency = latency;
    return p;
  }
};

/// A wall that jumps and changes its stiffness, and a hand as in bench/devices.
template <class Loop>
drawn most_of_chain(const Loop& original, const chain_world& world, const effort& how) {
  constexpr const char* names[] = {"square wave", "sine",     "telegraph",
                                   "pumping",     "kneading", "turning"};
  drawn most;
  for (int i = 0; i < 3 * how.runs; ++i) {
    const unsigned run = static_cast<unsigned>(how.first) - 1U + static_cast<unsigned>(i);
    std::mt19937 from(run * 2654435761u + 17u);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    auto by = devices::draw_hand<d1>(from, world.hand);
    auto p = world.device();
    p.start = 1e-3;
    sim::compliant_device<d1, devices::drawn_hand<d1>> arm(p, by);
    if (arm.check()) ex::complain(std::string("a device is refused: ") + arm.check().parameter);
    Loop loop = original;
    auto sample = arm.exchange(0.0);
    const int every = 20 + static_cast<int>(from() % 400);
    for (int n = 0; n < 1200; ++n) {
      if (n % every == 0) {
        const bool soft = run % 3 == 2, still = n == 0 || run % 2 == 0;
        const double jump = still ? 0.0 : (soft ? 20e-3 : 2e-3) * (2.0 * unit(from) - 1.0);
        const double K = soft ? 200.0 + 400.0 * unit(from) : 500.0 * std::pow(40.0, unit(from));
        loop.model.update({jump, 1.0, K});
      }
      const double f = loop.tick(sample).force;
      if (world.shortest < 1.0) {
        (void)arm.set_period(world.period * (world.shortest + (1.0 - world.shortest) * unit(from)));
      }
      sample = arm.exchange(f);
      if (std::abs(arm.position()) > 1.0) break;
    }
    if (arm.most_pull() > world.pull || arm.most_slew() > world.slew) continue;
    most.count(std::min(0.0, arm.minimum()), names[static_cast<int>(by.does)]);
  }
  return most;
}

template <class Model>
struct without_report {
  Model model;
  auto tick(const ph::device_sample<d1>& s) noexcept {
    return model.tick(s.position, ph::seconds{s.dt});
  }
};

void add_transmissions(std::vector<trial>& all) {
  const chain_world told;
  const ph::exact_device device{.mass = told.rotor + told.load,
                                .damping = told.damping,
                                .force_limit = told.motors,
                                .longest_tick = told.period};
  const ph::known_hand hand{.force = told.hand};
  using world = chain_world;

  const auto try_all = [&](const char* name, const auto& touch, const world& so, const auto& list) {
    const without_report<std::remove_cvref_t<decltype(touch)>> loop{touch};
    if (touch.check()) ex::complain(std::string(name) + " is refused: " + touch.check().parameter);
    list([&](const statement<world>& s, bool unpaid = false) {
      all.push_back(trial_of(name, so, s, [loop](const world& w, const effort& how) {
        return most_of_chain(loop, w, how);
      }));
      all.back().unpaid = unpaid;
    });
  };
  const auto of_any = [&](const auto& add, const world& so) {
    add(scaled("damping, at least", &world::damping, "%.3g N·s/m", 1.0, so, less));
    add(scaled("motors hold, at least", &world::motors, "%.3g N", 1.0, so, less));
    add(replaced("ticks of latency", &world::latency, "%g", 1.0, so, {1, 2, 5}));
    add(replaced("positions exact: steps of", &world::quantum, "%g µm", 1e-6, so,
                 {10e-6, 100e-6, 1e-3}));
  };

  world within = told;
  within.spring = 2e3;  // 49 Hz
  within.pull = 10.0;
  within.slew = 1500.0;
  const ph::observed_transmission observed{.rotor = told.rotor,
                                           .rotor_above = told.rotor,
                                           .slew = within.slew,
                                           .pull = within.pull,
                                           .damping_above = told.damping};
  // Runs in which `most` is passed count, and `other` is larger.
  const auto untold = [&within](const char* what, double world::*most, const char* stated,
                                double world::*other, const char* in_truth,
                                const std::vector<double>& factors) {
    auto s = scaled(what, other, in_truth, 1.0, within, factors);
    for (auto& w : s.untrue) w.*most = std::numeric_limits<double>::infinity();
    s.show = [=, shown = s.show](const world& w) {
      return std::isinf(w.*most) ? shown(w) : ex::format(stated, w.*most);
    };
    return s;
  };
  const auto seen = ph::make_touch<d1>(device, observed, hand);
  try_all("make_touch, observed", seen, within, [&](const auto& add) {
    add(scaled("rotor's mass, at least", &world::rotor, "%.3g kg", 1.0, within, less));
    add(scaled("rotor's mass, at most", &world::rotor, "%.3g kg", 1.0, within, more), true);
    add(untold("slew on it, at most", &world::slew, "%g N/s", &world::spring, "any, spring %g N/m",
               {1.0, 3.0, 10.0, 40.0}),
        true);
    add(untold("pull on it, at most", &world::pull, "%g N", &world::hand, "any, hand of %g N",
               {1.0, 3.0, 10.0}),
        true);
    add(scaled("damping, at most", &world::damping, "%.3g N·s/m", 1.0, within, more), true);
    add(replaced("dry friction, at most", &world::friction, "%g N", 1.0, within, {0.3, 1.0, 3.0}),
        true);
    add(scaled("longest tick", &world::period, "%.3g ms", 1e-3, within, {2.0, 3.0, 10.0}));
    of_any(add, within);
  });

  const ph::chain_transmission<2> chain{devices::chain_of<2>(told.device())};
  const auto known = ph::make_touch<d1>(device, chain, hand);
  try_all("make_touch, chain", known, told, [&](const auto& add) {
    const std::vector<double> other{1.0 / 3.0, 3.0, 0.1, 10.0};
    add(scaled("rotor's mass, within 3 %", &world::rotor, "%.3g kg", 1.0, told, other));
    add(scaled("load's mass, within 3 %", &world::load, "%.3g kg", 1.0, told, other));
    add(scaled("spring, within 3 %", &world::spring, "%.3g kN/m", 1e3, told, other));
    add(scaled("loss, within 30 %", &world::loss, "%.3g N·s/m", 1.0, told, other), true);
    add(scaled("hand's force, at most", &world::hand, "%.3g N", 1.0, told, more));
    add(replaced("dry friction, at most", &world::friction, "%g N", 1.0, told, {0.3, 1.0, 3.0}));
    add(scaled("equal ticks", &world::period, "%.3g ms", 1e-3, told, {2.0, 3.0, 10.0}));
    of_any(add, told);
  });
}

}  // namespace

std::vector<trial> trials_of_companions() {
  std::vector<trial> all;
  add_meshes(all);
  add_tools(all);
  add_transmissions(all);
  return all;
}

}  // namespace controllers
