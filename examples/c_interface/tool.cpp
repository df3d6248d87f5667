// SPDX-License-Identifier: BSD-3-Clause
// What turns: a stylus, which pushes in three degrees of freedom, and a tool, which does in six.
#include "rigid.hpp"

namespace c_interface {
namespace {

struct stylus {
  static constexpr int plane_slots = PH_PLANES, curved_slots = PH_CURVED;
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    // By hand: there is no make_ for a stylus.
    return ph::passive_port{
        ph::stylus<double>{},
        ph::at_tip{ph::contact_set{ph::proxy_spring{.mass = p.mass, .force_limit = p.force_limit},
                                   ph::pursuit{}, friction_of(p), ph::slots<plane, PH_PLANES>{},
                                   ph::slots<curved, PH_CURVED>{}},
                   {p.tip[0], p.tip[1], p.tip[2]}},
        ph::forgiving{ph::reduced_energy{.damping = p.damping}, ph::amends_for(p.force_limit)},
        ph::bound_chain{ph::reachable_bound{.mass = p.mass, .hand_force = p.hand_force},
                        ph::actuator_limit{.most = p.force_limit}},
        Loop{.longest_tick = p.longest_tick}};
  }
  static void adjust(auto& port, const ph_parameters& p) noexcept {
    adjust_slots(port, port.source().contact().parameters().pace, p);
  }
};

struct tool {
  static constexpr int plane_slots = PH_TOOL_PLANES, curved_slots = PH_TOOL_CURVED;
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    return ph::make_tool<ph::rigid_body<double>, Loop>(
        rigid_device_of(p), rigid_hand_of(p), friction_of(p), ph::slots<plane, PH_TOOL_PLANES>{},
        ph::slots<curved, PH_TOOL_CURVED>{});
  }
  static void adjust(auto& port, const ph_parameters& p) noexcept {
    adjust_slots(port, port.source().parameters().pace, p);
  }
};

}  // namespace

made make_stylus(const ph_parameters& p, facts /*of*/) noexcept {
  return make<stylus>(p);
}
made make_tool(const ph_parameters& p, facts /*of*/) noexcept {
  return make<tool, PH_MOST_TOOL_LATENCY>(p);
}

}  // namespace c_interface
