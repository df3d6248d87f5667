// SPDX-License-Identifier: BSD-3-Clause
// Detents and end stops of a knob or a slider.
#include "ports.hpp"
#include <passive_haptics/knob/detents.hpp>

namespace c_interface {
namespace {

using line = ph::space<double, 1>;

/// Two stops at one place are none.
[[nodiscard]] ph::detents shape_of(const ph_parameters& p) noexcept {
  ph::detents shape{.pitch = p.pitch, .stiffness = p.detent_stiffness};
  if (p.first_stop != p.last_stop) {
    shape.first = p.first_stop;
    shape.last = p.last_stop;
    shape.stop_stiffness = p.stop_stiffness;
  }
  return shape;
}
template <auto Device, auto Hand>
struct detents {
  static constexpr int plane_slots = 0, curved_slots = 0;
  [[nodiscard]] static auto device(const ph_parameters& p) noexcept {
    auto facts = Device(p);
    facts.rotary = p.rotary != 0;
    return facts;
  }
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    return ph::make_detents<line, Loop>(device(p), Hand(p), shape_of(p));
  }
  /// The top speed, and how far a knob may turn, are said by the facts of the device.
  template <class Port>
  static void adjust(Port& port, const ph_parameters& p) noexcept {
    auto loop = ph::detail::limits_of<ph::late_loop_limits<Port::latency>>(device(p));
    loop.workspace = stated(p.workspace, loop.workspace);
    loop.watchdog = stated(p.watchdog, loop.watchdog);
    (void)port.set(loop);
  }
};

}  // namespace

made make_detents(const ph_parameters& p, facts of) noexcept {
  return make_by_facts<detents>(p, of);
}

}  // namespace c_interface
