// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A wall on another machine, in virtual time: datagrams as they would cross a network, through a channel
// that delays, loses, doubles and reorders them. A hand touches the wall in three ways:
//
//   surface_at_hand  the surface crosses the network, 59 times a second; the local model is at the device
//   both_ends_count  two_port: position and force cross it, and the energy of each end
//   bare_force       position and force, and nobody counts

#include "../common/quiet.hpp"
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/remote.hpp>
#include <passive_haptics/simulation/channel.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/two_port.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace far_wall {

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace remote = ph::remote;
using scene = ph::space<double, 3>;
using vector = scene::vector;
using plane = ph::half_space<scene>;

constexpr double tick = 1e-3;           // [s]
constexpr double stiffness = 2000.0;    // [N/m]
constexpr double force_limit = 20.0;    // of the motors [N]
constexpr double hand_limit = 12.0;     // [N]
constexpr double device_damping = 1.0;  // [N·s/m]

struct network {
  const char* name;
  sim::channel_parameters way;  ///< each way
};
inline constexpr network networks[] = {
    {"1 ms", {.delay = 0.001, .jitter = 0.0005, .loss = 0.001}},
    {"5 + 10 ms, 2 %", {.delay = 0.005, .jitter = 0.010, .loss = 0.02, .duplication = 0.01}},
    {"25 + 10 ms, 10 %, doubles",
     {.delay = 0.025, .jitter = 0.010, .loss = 0.10, .duplication = 0.02}},
    {"100 ms, 20 %", {.delay = 0.100, .jitter = 0.020, .loss = 0.20}},
};

/// A wall that moves up and down, n = +z, at the height h sin 7t [m].
struct heaving_wall {
  double heave = 0.0;  ///< h [m]
  [[nodiscard]] double height(double t) const { return heave * std::sin(7.0 * t); }
  /// The force on a probe at z [N].
  [[nodiscard]] double force(double t, double z) const {
    return stiffness * std::max(0.0, height(t) - z);
  }
};

inline remote::nanoseconds clock_of(double t) {
  return remote::nanoseconds(static_cast<std::int64_t>(t * 1e9));
}

/// A client, a server, and a channel each way.
struct connection {
  explicit connection(const sim::channel_parameters& way, std::uint64_t seed = 1)
      : to_server(way, seed), to_client(way, seed + 1) {}

  sim::channel<remote::datagram> to_server, to_client;
  remote::client client{{}, 0xC0FFEE};
  remote::server server{{}, session_number};
  std::optional<remote::question> asked;  ///< the newest

  void ask(const remote::probe& probe, double t) {
    to_server.send(client.ask(probe, clock_of(t)), t);
  }
  void answer(const remote::content& what, double t) {
    if (asked) to_client.send(server.answer(what, *asked), t);
  }
  void serve(remote::received_bytes bytes, double t) {
    const auto heard = server.receive(bytes, {}, clock_of(t));
    if (heard.reply) to_client.send(*heard.reply, t);
    if (const auto* newest = server.take()) asked = *newest;
  }
  void carry(double t) {
    while (const auto* bytes = to_server.take(t)) serve(*bytes, t);
    while (const auto* bytes = to_client.take(t)) (void)client.receive(*bytes, clock_of(t));
  }
  void restart_server() {
    server = remote::server({}, session_number);
    asked.reset();
  }

  /// Other ones for each server.
  static std::uint64_t session_number() {
    static std::uint64_t last = 0;
    return ++last;
  }
};

/// The model at the device's end, over the surfaces that it is told.
inline auto passive_touch(double stale_after = 0.5) {
  return ph::local_model{
      scene{},
      ph::followed<plane>{{.stale_after = stale_after}},
      ph::turn_limited{.rate = 2.0},
      ph::shaped{ph::damped_spring{.mass = 0.1}, ph::force_rate_limit{.rate = 100.0}},
      ph::reduced_energy{.damping = 0.5 * device_damping},
      ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = hand_limit},
                      ph::actuator_limit{.most = force_limit}},
      ph::loop_limits{.longest_tick = tick}};
}

/// A hand that rests 5 mm above the wall, and from 0.5 s on presses towards 20 mm inside.
inline auto pressing_device() {
  sim::device_parameters<scene> device;
  device.damping = device_damping;
  device.force_limit = force_limit;
  device.start = {0.0, 0.0, 0.005};
  sim::impedance_hand<scene> hand;
  hand.stiffness = 500.0;
  hand.limit = hand_limit;
  hand.target = device.start;
  return sim::device<scene, sim::impedance_hand<scene>>(device, hand);
}

struct outcome {
  double created = 0.0;       ///< by the port of the hand, at worst; two_port: by both ends [J]
  double least_ledger = 0.0;  ///< [J]
  double force = 0.0;         ///< on the hand, mean of the last second [N]
  double error =
      0.0;  ///< mean |f − f of the wall as it is now, at the true position|, from 2 s on [N]
  double worst = 0.0;            ///< of these [N]
  double age = 0.0;              ///< of a surface when it is told, mean [s]
  std::uint64_t told = 0;        ///< surfaces, or forces
  std::uint64_t dropped = 0;     ///< doubles and overtaken ones, at the client
  experiments::at_rest still{};  ///< of a wall at rest, since the hand has come to press it
};

/// Measures the run at the hand.
class watcher {
 public:
  explicit watcher(const heaving_wall& wall) : wall_(wall) {}

  void see(double t, double z, double force, double both_ports) {
    seen_.created = std::max(seen_.created, -both_ports);
    if (t > 5.0) {
      seen_.force += force, ++late_;
      held_.add(force, wall_.height(t) - z);
    }
    quiet_.add_at(force, z, tick, std::span(normal_).first(z < wall_.height(t) ? 1 : 0));
    if (t <= 2.0) return;
    const double apart = std::abs(force - wall_.force(t, z));
    seen_.error += apart;
    seen_.worst = std::max(seen_.worst, apart);
    ++ticks_;
  }
  /// The hand has a new goal.
  void aimed() { quiet_.news(); }
  void told(double age) {
    seen_.age += age;
    ++seen_.told;
  }
  void ledger(double energy) { seen_.least_ledger = std::min(seen_.least_ledger, energy); }
  [[nodiscard]] outcome result(const remote::tally& counted) const {
    outcome r = seen_;
    r.force /= std::max(late_, 1);
    r.error /= std::max(ticks_, 1);
    r.age /= static_cast<double>(std::max<std::uint64_t>(r.told, 1));
    r.dropped = counted.of(remote::verdict::repeated) + counted.of(remote::verdict::overtaken);
    if (wall_.heave == 0.0) r.still.add(quiet_, {stiffness, held_.shown()});
    return r;
  }

 private:
  heaving_wall wall_;
  static constexpr std::array<double, 1> normal_{1.0};
  outcome seen_;
  sim::quiet_judge<ph::space<double, 1>> quiet_;
  experiments::held_stiffness held_;
  int ticks_ = 0, late_ = 0;
};

constexpr int ticks_of_a_run = 6000;

inline void press(auto& device, watcher& eye, int n) {
  if (n != 500) return;
  device.hand().aim(vector(0.0, 0.0, -0.02), vector::Zero(), device.time());
  eye.aimed();
}

/// The client asks every 10 ms; the wall answers every 17. `meddle(n, line)` comes before each tick.
template <class Meddle, class Touch = decltype(passive_touch())>
outcome surface_at_hand(const sim::channel_parameters& way, const heaving_wall& wall,
                        std::uint64_t seed, Meddle meddle, Touch touch = passive_touch()) {
  connection line(way, seed);
  watcher eye(wall);
  auto device = pressing_device();
  auto sample = device.exchange(scene::zero());
  for (int n = 0; n < ticks_of_a_run; ++n) {
    const double t = n * tick;
    press(device, eye, n);
    meddle(n, line);
    if (n % 10 == 0) line.ask({.position = sample.position, .force = sample.held}, t);
    line.carry(t);
    if (n % 17 == 0) {
      line.answer(remote::content_of(plane{{0.0, 0.0, wall.height(t)}, {0.0, 0.0, 1.0}, stiffness}),
                  t);
    }
    if (const auto* news = line.client.take()) {
      eye.told(news->age(clock_of(t)));
      (void)touch.update(remote::half_space_of<scene>(news->content));
    }
    const auto out = touch.tick(sample);
    eye.ledger(out.energy);
    sample = device.exchange(out.force);
    eye.see(t + tick, device.position()(2), sample.held[2], device.meter().value());
  }
  return eye.result(line.client.counted());
}
inline outcome surface_at_hand(const sim::channel_parameters& way, const heaving_wall& wall,
                               std::uint64_t seed) {
  return surface_at_hand(way, wall, seed, [](int, connection&) {});
}

/// The force is computed over there, from where the hand was, and displayed as it comes.
inline outcome bare_force(const sim::channel_parameters& way, const heaving_wall& wall,
                          std::uint64_t seed) {
  connection line(way, seed);
  watcher eye(wall);
  auto device = pressing_device();
  auto sample = device.exchange(scene::zero());
  vector force = scene::zero();
  for (int n = 0; n < ticks_of_a_run; ++n) {
    const double t = n * tick;
    press(device, eye, n);
    line.ask({.position = sample.position}, t);
    line.carry(t);
    if (line.asked) {
      const double push = wall.force(t, line.asked->probe.position[2]);
      line.answer(remote::content_of(remote::probe{.force = {0.0, 0.0, push}}), t);
    }
    if (const auto* news = line.client.take()) {
      eye.told(news->age(clock_of(t)));
      force = remote::probe_of(news->content).force;
    }
    sample = device.exchange(force);
    eye.see(t + tick, device.position()(2), sample.held[2], device.meter().value());
  }
  return eye.result(line.client.counted());
}

/// Both ends count. A new session is a new pair of ledgers: the device lets go for a tick, so that no
/// force is held that nobody books, and both begin with what they were lent. Unless `together`, the device's
/// end goes on as if nothing had been.
template <class Meddle>
outcome both_ends_count(const sim::channel_parameters& way, const heaving_wall& wall,
                        std::uint64_t seed, Meddle meddle, bool together = true) {
  constexpr double lent = 1e-3;
  const auto begin_at = [](const vector& x) {
    return ph::admittance_side<scene>{{.stiffness = stiffness, .drift_rate = 20.0, .loan = lent},
                                      x};
  };
  connection line(way, seed);
  watcher eye(wall);
  auto device = pressing_device();
  ph::impedance_side hand_end{scene{}, ph::two_port_energy{.damping = device_damping, .share = 0.5},
                              ph::strict_bound{}, ph::loop_limits{.longest_tick = tick}};
  std::uint32_t session_of_hand = 0;
  std::uint64_t session_of_tool = 0;
  std::uint64_t number = 0;
  vector tool = device.position();
  auto tool_end = begin_at(tool);
  double at_wall = 0.0;  // the work of the wall on the tool [J]
  auto sample = device.exchange(scene::zero());
  for (int n = 0; n < ticks_of_a_run; ++n) {
    const double t = n * tick, z = wall.height(t);
    press(device, eye, n);
    meddle(n, line);
    const auto mine = hand_end.packet();
    line.ask({.position = mine.payload, .energy = mine.energy}, t);
    line.carry(t);

    if (line.asked) {
      if (std::exchange(session_of_tool, line.asked->session) != line.asked->session) {
        tool_end = begin_at(tool);
      }
      tool_end.receive({line.asked->probe.energy, ++number, line.asked->probe.position});
      const auto stored = [&] { return stiffness * std::pow(std::max(z - tool(2), 0.0), 2) / 2; };
      const auto force = [&] { return vector(0.0, 0.0, wall.force(t, tool(2))); };
      const double before = stored();
      tool += tool_end.step(force(), ph::seconds{tick}).displacement;
      tool_end.settle(before - stored());
      at_wall += before - stored();
      eye.ledger(tool_end.energy());
      const auto theirs = tool_end.packet(force());
      line.answer(remote::content_of(remote::probe{
                      .position = tool, .force = theirs.payload, .energy = theirs.energy}),
                  t);
    }

    // At the welcome, before the first question of the session is sent: what was promised in the last one
    // must not be promised again.
    const bool begins =
        std::exchange(session_of_hand, line.client.sessions()) != line.client.sessions();
    const bool let_go = begins && together;
    if (const auto* news = line.client.take()) {
      eye.told(news->age(clock_of(t)));
      const auto theirs = remote::probe_of(news->content);
      hand_end.receive({theirs.energy, ++number, theirs.force});
    }
    const auto out = hand_end.tick(sample);
    eye.ledger(out.energy);
    sample = device.exchange(let_go ? scene::zero() : out.force);
    if (let_go) hand_end.reset();
    eye.see(t + tick, device.position()(2), sample.held[2], device.meter().value() + at_wall);
  }
  return eye.result(line.client.counted());
}
inline outcome both_ends_count(const sim::channel_parameters& way, const heaving_wall& wall,
                               std::uint64_t seed) {
  return both_ends_count(way, wall, seed, [](int, connection&) {});
}

}  // namespace far_wall
