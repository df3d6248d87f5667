// SPDX-License-Identifier: BSD-3-Clause
// One surface, a plane.
#include "ports.hpp"

namespace c_interface {
namespace {

/// What both kinds of touch share.
struct one_plane {
  static constexpr int plane_slots = 1, curved_slots = 0;
  template <class Port>
  static void adjust(Port& port, const ph_parameters& p) noexcept {
    (void)port.set(ph::turn_limited{.rate = stated(p.turn_rate, 2.0)});
    (void)port.set(
        ph::freshness{.stale_after = stated(p.stale_after, ph::freshness{}.stale_after)});
    (void)port.set(limits<Port::latency>(p));
  }
};
template <auto Device, auto Hand>
struct touch : one_plane {
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    return ph::make_touch<scene, plane, Loop>(Device(p), Hand(p));
  }
};
struct quantised_touch : one_plane {
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    // By hand: positions in steps, and no friction to pay for them.
    return ph::local_model{
        scene{},
        ph::followed<plane>{},
        ph::turn_limited{},
        ph::eased{ph::damped_spring{.mass = p.mass, .force_limit = p.force_limit}},
        ph::forgiving{ph::quantised_energy{.damping = {p.damping}, .quantum = p.quantum},
                      ph::amends_for(p.force_limit)},
        ph::bound_chain{ph::reachable_bound{.mass = p.mass, .hand_force = p.hand_force},
                        ph::actuator_limit{.most = p.force_limit}},
        Loop{.longest_tick = p.longest_tick},
        ph::mass_observer{.mass = p.mass, .quantum = p.quantum}};
  }
};

}  // namespace

made make_touch(const ph_parameters& p, facts of) noexcept {
  return make_by_facts<touch>(p, of);
}
made make_quantised_touch(const ph_parameters& p, facts /*of*/) noexcept {
  return make<quantised_touch, PH_MOST_STRICT_LATENCY>(p);
}

}  // namespace c_interface
