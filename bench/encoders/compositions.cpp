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
/// `capital` is what make_touch lets the cap follow, or 0 for a cap that stays.
wall touch_of(const design::stated_device& d, double most, double capital) {
  auto made = ph::make_touch<line>(d, ph::known_hand{.force = hand_force});
  (void)made.set(ph::capped{
      ph::eased{ph::damped_spring{.mass = d.mass, .force_limit = d.force_limit}}, most, capital});
  return made;
}
wall encoder_touch(const design::stated_device& d, double most) {
  const bool follows = most < unlimited;  // what is sought is the largest that lasts as it is
  return touch_of(d, most, follows ? design::stiffness_budget(d).working_capital : 0.0);
}
wall with_fixed_cap(const design::stated_device& d, double most) {
  return touch_of(d, most, 0.0);
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
      {.name = "dual ledger", .is_capped = true, .follows = true, .make = encoder_touch},
      {.name = "dual ledger, fixed cap", .is_capped = true, .make = with_fixed_cap},
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
