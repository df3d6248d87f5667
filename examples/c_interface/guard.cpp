// SPDX-License-Identifier: BSD-3-Clause
// A force that the caller has.
#include "ports.hpp"

namespace c_interface {
namespace {

template <auto Device, auto Hand>
struct guard {
  static constexpr int plane_slots = 0, curved_slots = 0;
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    return ph::make_guard<scene, Loop>(Device(p), Hand(p), p.renderer_period);
  }
  template <class Port>
  static void adjust(Port& port, const ph_parameters& p) noexcept {
    ph::settled_force rule = port.source().parameters();
    rule.stale_after = stated(p.stale_after, rule.stale_after);
    rule.renderer_period = p.renderer_period;
    (void)port.set(rule);
    (void)port.set(limits<Port::latency>(p));
  }
};

}  // namespace

made make_guard(const ph_parameters& p, facts of) noexcept {
  return make_by_facts<guard>(p, of);
}

}  // namespace c_interface
