// SPDX-License-Identifier: BSD-3-Clause
#include "compositions.hpp"

namespace encoders {

namespace {

using ph::half_space;

/// A settling wall behind a ledger and a bound that knows the mass.
template <class Ledger, class Motion>
wall settling(const design::stated_device& d, const Ledger& ledger, const Motion& motion) {
  return ph::local_model{
      line{},
      ph::followed<half_space<line>>{},
      ph::turn_at_once{},
      ph::damped_spring{.mass = d.mass, .force_limit = d.force_limit},
      ledger,
      ph::bound_chain{ph::reachable_bound{.mass = d.mass, .hand_force = hand_force},
                      ph::actuator_limit{.most = d.force_limit}},
      ph::loop_limits{.longest_tick = d.longest_tick},
      motion};
}

ph::mass_observer observer(const design::stated_device& d) {
  return {.mass = d.mass, .quantum = d.quantum};
}

wall recommended(const design::stated_device& d, double /*most*/) {
  return settling(d, ph::quantised_energy{.damping = d.damping, .quantum = d.quantum}, observer(d));
}
wall with_rigid_friction(const design::stated_device& d, double /*most*/) {
  return settling(d, ph::dual_ledger{.damping = {d.damping, d.friction, 0.0}, .quantum = d.quantum},
                  observer(d));
}
wall encoder_touch(const design::stated_device& d, double most) {
  auto made = ph::make_touch<line>(d, ph::known_hand{.force = hand_force});
  (void)made.set(
      ph::capped{ph::eased{ph::damped_spring{.mass = d.mass, .force_limit = d.force_limit}}, most});
  return made;
}
wall of_exact_positions(const design::stated_device& d, double /*most*/) {
  return settling(d, ph::reduced_energy{.damping = d.damping}, ph::last_difference{});
}
wall unbounded(const design::stated_device& d, double /*most*/) {
  return ph::local_model{line{},
                         ph::followed<half_space<line>>{},
                         ph::turn_at_once{},
                         ph::damped_spring{.mass = d.mass, .force_limit = d.force_limit},
                         ph::no_observer{},
                         ph::bound_chain{ph::no_bound{}, ph::actuator_limit{.most = d.force_limit}},
                         ph::loop_limits{.longest_tick = d.longest_tick},
                         observer(d)};
}

}  // namespace

const std::vector<composition>& compositions() {
  static const std::vector<composition> all{
      {.name = "dual ledger", .is_capped = true, .make = encoder_touch},
      {.name = "quantised energy", .make = recommended},
      {.name = "dual ledger, rigid friction",
       .takes_friction_as_rigid = true,
       .make = with_rigid_friction},
      {.name = "reduced energy", .takes_positions_as_exact = true, .make = of_exact_positions},
      {.name = "unbounded", .promises = false, .make = unbounded}};
  return all;
}

wall wall_of(const composition& c, const machine& m, double K, double most) {
  wall made = c.make(m.stated(), most);
  (void)made.update({surface_of(m), -1.0, K});
  return made;
}

}  // namespace encoders
