// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the tests of the C interface share: the library as it was loaded, a device by both interfaces, and one
// motion run by both.
#include "by_c.h"
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/six_dof.hpp>

#include <cstring>
#include <string>
#include <vector>

constexpr int ticks = 6000;

/// The library, loaded for one test.
class loaded : public c_interface {
 public:
  loaded() : c_interface{} {
    const char* const missing = load(this, PASSIVE_HAPTICS_C_LIBRARY);
    INFO((missing != nullptr ? missing : ""));
    REQUIRE(missing == nullptr);
  }
  loaded(const loaded&) = delete;
  loaded& operator=(const loaded&) = delete;
  ~loaded() { unload(this); }

  /// What ph_create says.
  [[nodiscard]] std::string refusal(const char* composition, const ph_parameters& parameters,
                                    int expected = PH_REFUSED_PARAMETER) const {
    std::string text(PH_TEXT_ROOM, 'x');
    ph_port* port = nullptr;
    const int status = create(composition, &parameters, &port, text.data(), text.size());
    CHECK(status == expected);
    CHECK((port == nullptr) == (status != PH_OK));
    destroy(port);
    return text.c_str();
  }
};

/// A port, ended with its test.
class opened {
 public:
  opened(const c_interface& with, const char* composition, const ph_parameters& parameters)
      : with_(with) {
    REQUIRE(with.create(composition, &parameters, &port, nullptr, 0) == PH_OK);
  }
  opened(const opened&) = delete;
  opened& operator=(const opened&) = delete;
  ~opened() { with_.destroy(port); }

  ph_port* port = nullptr;

 private:
  const c_interface& with_;
};

/// A device like a Touch, its encoder's steps not stated.
inline ph_parameters grip(std::uint32_t latency = 0) {
  ph_parameters p{};
  p.size = sizeof p;
  p.latency = latency;
  p.mass = 0.045;
  p.damping = 0.05;
  p.hand_force = 5.0;
  p.force_limit = 3.3;
  p.longest_tick = 1.1e-3;
  return p;
}
inline ph_parameters on_encoders(std::uint32_t latency = 0) {
  ph_parameters p = grip(latency);
  p.friction = 0.13;
  p.presliding = 15e-6;
  p.quantum = 20e-6;
  p.continuous_force = 0.88;
  p.winding_time = 0.5;
  return p;
}
constexpr ph::encoder_device stated{.mass = 0.045,
                                    .damping = 0.05,
                                    .friction = 0.13,
                                    .presliding = 15e-6,
                                    .quantum = 20e-6,
                                    .force_limit = 3.3,
                                    .longest_tick = 1.1e-3,
                                    .continuous_force = 0.88,
                                    .winding_time = 0.5};
constexpr double T = stated.longest_tick;
constexpr ph::exact_device exact{
    .mass = 0.045, .damping = 0.05, .force_limit = 3.3, .longest_tick = T};
constexpr ph::known_hand hand{.force = 5.0};
constexpr ph::actuator_limit motors{.most = stated.force_limit};

/// A handle that turns, and the same for C.
constexpr ph::rigid_device handle{
    .inertia = {.mass = 0.15, .least = 1e-4, .spread = 2e-4, .offset = 5e-3},
    .damping = {.linear = 0.03, .angular = 1e-4},
    .damping_most = {.linear = 0.06, .angular = 2e-4},
    .force_limit = 1.0,
    .torque_limit = 0.006,
    .lever = 0.02,
    .longest_tick = T};
inline ph_parameters peg() {
  ph_parameters p{};
  p.size = sizeof p;
  p.mass = handle.inertia.mass;
  p.damping = handle.damping.linear;
  p.hand_force = 5.0;
  p.force_limit = handle.force_limit;
  p.longest_tick = T;
  p.least_inertia = handle.inertia.least;
  p.inertia_spread = handle.inertia.spread;
  p.inertia_offset = handle.inertia.offset;
  p.angular_damping = handle.damping.angular;
  p.damping_most = handle.damping_most.linear;
  p.angular_damping_most = handle.damping_most.angular;
  p.hand_torque = 0.1;
  p.torque_limit = handle.torque_limit;
  p.lever = handle.lever;
  return p;
}

inline d3::vector in(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// One tick of the C client's motion, by a port of the library itself.
template <class Port>
ph_result tick(Port& port, const moment& now) {
  using space = typename Port::port_type;
  constexpr bool turns = requires(typename space::stored_pose x) {
    x.orientation;
  };
  typename space::stored_pose x;
  typename space::stored_effort held;
  const auto p = in(now.position);
  if constexpr (turns) {
    const double* q = now.orientation;
    x = {p, {q[0], q[1], q[2], q[3]}};
  } else {
    x = p;
  }
  if constexpr (requires { space::join(p, p); }) {
    held = space::join(in(now.held), d3::vector(0.0, 1e-3, 0.0));
  } else {
    held = in(now.held);
  }
  // The device that says nothing is the one that does as it is told.
  const auto out = now.reports_held ? port.tick(ph::device_sample<space>{x, held, now.dt, true})
                                    : port.tick(x, ph::seconds{now.dt});
  ph_result r{};
  r.size = sizeof r;
  r.event = static_cast<int>(out.what);
  for (int i = 0; i < 3; ++i) r.force[i] = out.force(i);
  if constexpr (space::dof == 6) {
    for (int i = 0; i < 3; ++i) r.torque[i] = out.force(i + 3);
  }
  r.energy = out.energy;
  r.limited = out.limited;
  if constexpr (requires { out.depth; }) r.depth = out.depth;
  if constexpr (requires { port.law().is_capped(); }) r.capped = port.law().is_capped();
  return r;
}

/// What no script changes.
constexpr auto nothing_else = [](auto& /*port*/) {};
/// What the C client changes before tick n, if a script changes anything.
template <class Port, class Change>
void keep_to_script(Port& port, int n, const Change& change) {
  if constexpr (!std::same_as<Change, std::remove_const_t<decltype(nothing_else)>>) {
    if (n == change_tick) change(port);
    if (n == off_tick || n == on_tick) port.enable_forces(n == on_tick);
    if (n == reset_tick) port.reset();
  }
}

inline std::vector<ph_result> run_in_c(const char* composition, const ph_parameters& parameters,
                                       script how) {
  const loaded c;
  std::vector<ph_result> results(ticks);
  REQUIRE(run_by_c(&c, composition, &parameters, how, ticks, results.data()) == PH_OK);
  return results;
}
inline bool same_bits(const std::vector<ph_result>& a, const std::vector<ph_result>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

/// In contact and out of it, with a bound that has something to do, and a fault now and then.
inline bool tries_enough(const std::vector<ph_result>& all) {
  int pressed = 0;
  int limited = 0;
  int refused = 0;
  for (const auto& r : all) {
    pressed += r.force[2] != 0.0;
    limited += r.limited != 0;
    refused += r.event == PH_REJECTED_SAMPLE;
  }
  return pressed > 500 && pressed < ticks && limited > 20 && refused > 2;
}

/// The same from C and from C++; and not with a device that is 1 % off.
inline void agree(const char* composition, const std::vector<ph_result>& direct,
                  ph_parameters parameters, script how, double ph_parameters::*other) {
  INFO(composition << " " << parameters.latency << " ticks late, kind " << how.kind);
  CHECK(tries_enough(direct));
  CHECK(same_bits(direct, run_in_c(composition, parameters, how)));
  ph_parameters later = how.later != nullptr ? *how.later : parameters;
  if (how.later != nullptr) {
    const script as_it_was{how.way, how.kind, &parameters};  // the control: nothing changes
    CHECK_FALSE(same_bits(direct, run_in_c(composition, parameters, as_it_was)));
    how.later = &later;
  }
  parameters.*other *= 1.01;
  later.*other *= 1.01;
  CHECK_FALSE(same_bits(direct, run_in_c(composition, parameters, how)));
}
template <int Latency>
using late = ph::late_loop_limits<Latency>;
template <class Device>
Device after(int latency, Device device) {
  device.latency = latency;
  return device;
}
