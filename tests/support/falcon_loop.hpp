// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A local model in a loop with the mock Falcon: driver, packets, arms and hand, in virtual time.
#include "support/scenes.hpp"
#include <passive_haptics/falcon/device.hpp>
#include <passive_haptics/falcon/in_memory_transport.hpp>
#include <passive_haptics/falcon/mock.hpp>
#include <passive_haptics/simulation/device.hpp>

namespace falcon = passive_haptics::falcon;
namespace sim = passive_haptics::simulation;

/// The largest motion along one axis [m] for one count of every leg, anywhere in the workspace.
inline constexpr double falcon_quantum = 1.03e-4;

using mock_parameters = falcon::mock_parameters<sim::device_parameters<d3>>;
template <class Hand = sim::no_hand<d3>>
using mock_falcon = falcon::mock<sim::device<d3, Hand>>;
template <class Hand>
using falcon_cable = falcon::in_memory_transport<mock_falcon<Hand>>;
template <class Hand>
using falcon_device = falcon::device<falcon_cable<Hand>, d3>;

/// Opens, starts and homes the device and waits until forces have full strength; returns false if that failed.
template <class Hand>
bool make_ready(falcon_device<Hand>& device) {
  if (!device.open() || !device.start()) return false;
  if (!device.home(std::chrono::seconds(1))) return false;
  for (int n = 0; n < 2000 && device.latest().strength < 1.0; ++n) {
    (void)device.exchange(d3::zero());
  }
  return device.where() == falcon::state::homed && device.latest().strength == 1.0;
}

/// The body of the mock Falcon, with its true position and the work of its motors.
template <class Hand>
const auto& body_of(const falcon_device<Hand>& device) {
  return device.line().peer().mechanism().body();
}
