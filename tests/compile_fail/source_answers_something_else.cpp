// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the source does not model source_for
//
// answered() makes the result of the tick, as refused() does.

#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

struct mine {
  using result_type = ph::port_result<scene>;
  static constexpr bool asks_for_numbers = true;
  struct request {
    float wanted;
    bool nothing = false;
  };
  template <bool Shortcut>
  constexpr request ask(const auto& /*motion*/, const auto& /*port*/,
                        ph::event& /*what*/) noexcept {
    return {1};
  }
#ifdef POSITIVE_CONTROL
  constexpr result_type answered(const request& /*asked*/, const result_type& port) noexcept {
    return port;
  }
#else
  constexpr float answered(const request& /*asked*/, const result_type& port) noexcept {
    return port.force;
  }
#endif
  constexpr result_type refused(const result_type& port, float /*dt*/) noexcept {
    return port;
  }
};

ph::passive_port guard{scene{}, mine{}, ph::reduced_energy{}, ph::strict_bound{},
                       ph::loop_limits{}};
