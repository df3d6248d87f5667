// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the source does not model source_for
//
// What is asked for nothing is no source: the port says so before its tick does.

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
#ifdef POSITIVE_CONTROL
  template <bool Shortcut>
  constexpr request ask(const auto& /*motion*/, const auto& /*port*/,
                        ph::event& /*what*/) noexcept {
    return {1};
  }
#endif
  constexpr result_type answered(const request& /*asked*/, const result_type& port) noexcept {
    return port;
  }
  constexpr result_type refused(const result_type& port, float /*dt*/) noexcept {
    return port;
  }
};

ph::passive_port guard{scene{}, mine{}, ph::reduced_energy{}, ph::strict_bound{},
                       ph::loop_limits{}};
