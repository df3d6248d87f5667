// SPDX-License-Identifier: BSD-3-Clause
// Several surfaces, in slots.
#include "ports.hpp"

namespace c_interface {
namespace {

template <auto Device, auto Hand>
struct contacts {
  static constexpr int plane_slots = PH_PLANES, curved_slots = PH_CURVED;
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    return ph::make_contacts<scene, Loop>(Device(p), Hand(p), friction_of(p),
                                          ph::slots<plane, PH_PLANES>{},
                                          ph::slots<curved, PH_CURVED>{});
  }
  static void adjust(auto& port, const ph_parameters& p) noexcept {
    adjust_slots(port, port.source().parameters().pace, p);
  }
};

}  // namespace

made make_contacts(const ph_parameters& p, facts of) noexcept {
  return make_by_facts<contacts>(p, of);
}

}  // namespace c_interface
