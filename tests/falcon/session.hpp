// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session of the Falcon's driver, and its recording.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/falcon/device.hpp>
#include <passive_haptics/falcon/recording.hpp>

#include <vector>

using falcon::code;
using falcon::state;

using cable = falcon::in_memory_transport<scripted_falcon>;
using recorded = falcon::device<falcon::recording_transport<cable>>;

inline constexpr double k = falcon::cautious_gain<double>;

/// A session with a wall at z = 0.136 m, a moving grip and faults; what came of it, in bits.
template <class Device, class Disturb>
std::vector<double> session(Device& device, Disturb disturb) {
  ph::local_model wall{d3{},
                       ph::fixed{ph::half_space<d3>{{0, 0, 0.136}, {0, 0, 1}, 500.0}},
                       ph::turn_at_once{},
                       ph::spring{},
                       ph::reduced_energy{.damping = 1.0, .loan = 0.01},
                       ph::strict_bound{},
                       ph::late_loop_limits<1>{.longest_tick = 1e-3, .top_speed = 100.0}};
  std::vector<double> all;
  d3::vector force = d3::zero();
  for (int n = 0; n < 1000; ++n) {
    disturb(n);
    const auto sample = device.exchange(force);
    const auto out = wall.tick(sample);
    force = out.force;
    for (const double x : {sample.position[0], sample.position[2], sample.held[2], sample.dt,
                           sample.valid ? 1.0 : 0.0, out.force(2), out.energy,
                           static_cast<double>(device.where())}) {
      all.push_back(x);
    }
  }
  return all;
}

inline void disturb(scripted_falcon& box, int n) {
  box.encoder = {static_cast<std::int16_t>(-n % 97), 5, static_cast<std::int16_t>(-n % 11)};
  box.homed = n < 100 || n == 700 ? 3 : 7;
  box.on_reply = nullptr;
  if (n == 500 || n == 501) box.on_reply = [](scripted_falcon&, auto& bytes) { bytes.clear(); };
  if (n == 600) box.on_reply = [](scripted_falcon&, auto& bytes) { bytes.erase(bytes.begin()); };
  if (n == 800) box.on_reply = [](scripted_falcon& self, auto&) { self.emit("<AAA>?"); };
}

struct taken {
  std::vector<double> result;
  std::vector<falcon::wire_row> rows;
};

inline taken record() {
  recorded device{k, {}, std::size_t(8000)};
  device.line().line().peer().now = scripted_falcon::mode::running;
  REQUIRE(device.open());
  REQUIRE(device.start());
  device.line().record(true);
  taken t;
  t.result = session(device, [&](int n) { disturb(device.line().line().peer(), n); });
  REQUIRE(device.line().complete());
  t.rows.assign(device.line().rows().begin(), device.line().rows().end());
  return t;
}
