// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the limits do not model limits_for
//
// A loop of your own says how late its commands are, too.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

struct mine {
#ifdef POSITIVE_CONTROL
  static constexpr int latency = 0;
#endif
  static constexpr ph::loop_traits traits{};
  static constexpr ph::guarantee passivity = ph::guarantee::conditional;
  template <class Port>
  using guard_type = ph::trusting_guard<Port, 0>;
  float longest_tick = 0.001F;
};

ph::passive_port guard{scene{}, ph::given_force{}, ph::reduced_energy{}, ph::strict_bound{},
                       mine{}};
