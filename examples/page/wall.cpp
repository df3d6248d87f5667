// SPDX-License-Identifier: BSD-3-Clause
// A stiff wall on a device that runs on a rail, under every controller of bench/controllers.
// By hand: a menu of all controllers, to be compared.
#include "exports.hpp"

namespace {

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;
using wall_touch = page::any_touch<scene, 1>;

#define WALL(name, says, ...)                                                             \
  PAGE_CONTROLLER(                                                                        \
      wall_touch, name, says,                                                             \
      ph::local_model{scene{}, ph::followed<ph::half_space<scene>>{}, ph::turn_at_once{}, \
                      __VA_ARGS__, ph::loop_limits{.longest_tick = tick, .top_speed = 100}})
#define WALL_SET(name, says, rubs, bound)                                                         \
  PAGE_CONTROLLER(wall_touch, name, says,                                                         \
                  ph::passive_port{scene{},                                                       \
                                   ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{}, \
                                                   rubs, ph::slots<ph::half_space<scene>, 1>{}},  \
                                   ph::reduced_energy{.damping = damping}, bound,                 \
                                   ph::loop_limits{.longest_tick = tick, .top_speed = 100}})

struct wall {
  using touch = wall_touch;
  static constexpr page::place home{0, 0.012};
  static constexpr page::way_point round[]{{0.5, {0, 0.010}},
                                           {2.6, {0, -0.016}},
                                           {3.2, {0, 0.010}},
                                           {4.4, {0, -0.006}},
                                           {5, {0, 0.010}}};

  static constexpr page::settings begins_with() { return {.damping = 0.3}; }
  static constexpr std::array menu{
      WALL("none", "A bare spring. Nothing counts, nothing limits.", ph::spring{},
           ph::no_observer{}, ph::no_bound{}),
      PAGE_CONTROLLER(wall_touch, "make_touch",
                      "What the library recommends: stiff, at rest at once, for a known mass and "
                      "hand; news moves the force smoothly.",
                      ph::make_touch<scene>(DEVICE, HAND)),
      PAGE_CONTROLLER(
          wall_touch, "make_touch, encoders",
          "The same where encoder steps are felt: no stiffer than dry friction pays for.",
          ph::make_touch<scene>(ph::encoder_device{.mass = mass,
                                                   .damping = damping,
                                                   .friction = friction,
                                                   .presliding = 0,
                                                   .quantum = quantum,
                                                   .force_limit = motors,
                                                   .longest_tick = tick},
                                HAND)),
      PAGE_CONTROLLER(
          wall_touch, "make_touch, 2 ticks late",
          "The same in a loop that is two ticks late: set the lateness to 2, or it is told wrong.",
          ph::make_touch<scene, ph::half_space<scene>, ph::late_loop_limits<2>>(
              ph::exact_device{.mass = mass,
                               .damping = damping,
                               .force_limit = motors,
                               .longest_tick = tick,
                               .latency = 2},
              HAND)),
      PAGE_GUARD(wall_touch, "make_guard",
                 "A bare spring of your own, guarded: force in, force out.",
                 ph::make_guard<scene>(DEVICE, HAND)),
      WALL("damped spring + reachable", "A damped spring, bounded for a known mass and hand.",
           ph::damped_spring{.mass = mass}, LEDGER, REACHABLE),
      WALL("strict FBA",
           "Spends only what the hand has paid, whatever happens. Soft where the ledger is empty.",
           ph::spring{}, LEDGER, ph::strict_bound{}),
      PAGE_CONTROLLER(
          wall_touch, "strict FBA, 2 ticks late",
          "The same for a loop that is two ticks late: set the lateness to 2, or it is told wrong.",
          ph::local_model{scene{}, ph::followed<ph::half_space<scene>>{}, ph::turn_at_once{},
                          ph::spring{}, ph::reduced_energy{.damping = damping}, ph::strict_bound{},
                          ph::late_loop_limits<2>{.longest_tick = tick, .top_speed = 100}}),
      WALL("strict FBA + friction", "Credits dry friction, too, and allows for encoder steps.",
           ph::spring{}, ph::dual_ledger{.damping = {damping, friction, 0.0}, .quantum = quantum},
           ph::strict_bound{}),
      WALL("force rate + strict FBA", "The surface moves at no more than 100 N/s; then strict.",
           ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 100}}, LEDGER, ph::strict_bound{}),
      WALL("memoryless FBA", "Strict from the last tick alone; saves nothing.", ph::spring{},
           LEDGER, ph::memoryless_bound{}),
      WALL("per-axis FBA", "Strict, an account for each axis.", ph::spring{}, LEDGER,
           ph::per_axis_bound{}),
      WALL("EBA", "Energy bounding algorithm, c1 = c2 = b/T.", ph::spring{}, LEDGER,
           ph::energy_bounding{.slope = damping / tick, .storage = damping / tick}),
      WALL("EBA, tight", "Energy bounding with twice the storage.", ph::spring{}, LEDGER,
           ph::tight_energy_bounding{.storage = 2 * damping / tick}),
      WALL("sector", "The force stays within a sector of slope b/T.", ph::spring{}, LEDGER,
           ph::sector_bound{.slope = damping / tick}),
      WALL("thesis", "The rule of the thesis: stiff, and no promise.",
           ph::shaped{ph::spring{}, ph::thesis_rule{}}, LEDGER, ph::no_bound{}),
      WALL("reachable", "Spends what the next tick can give back, for a known mass and hand.",
           ph::spring{}, LEDGER, REACHABLE),
      WALL("thesis safe, holds 2 mg", "The rule of the thesis, its credit capped, reachable.",
           ph::shaped{ph::spring{}, ph::thesis_rule{}},
           ph::capped_energy{.damping = damping,
                             .cap = ph::kernels::bank_for_hold(2 * 9.81 * mass, damping, tick)},
           REACHABLE),
      WALL("thesis safe, holds 1.2 mg", "The same with less credit.",
           ph::shaped{ph::spring{}, ph::thesis_rule{}},
           ph::capped_energy{.damping = damping,
                             .cap = ph::kernels::bank_for_hold(1.2 * 9.81 * mass, damping, tick)},
           REACHABLE),
      WALL("PO/PC", "Time-domain passivity: a damper when the account is overdrawn, a tick later.",
           ph::spring{}, ph::no_observer{},
           ph::series_passivity_controller{.max_damping = 0.5 * mass / tick}),
      WALL("PO/PC + reference energy", "The same towards a reference energy.",
           ph::shaped{ph::spring{},
                      ph::reference_energy_with_damping{{.max_damping = 0.5 * mass / tick}}},
           LEDGER, ph::no_bound{}),
      WALL("energy tank, worst case", "A tank that allows for the worst motion of the next tick.",
           ph::spring{}, LEDGER, ph::energy_tank{.reserve = 1e-6}),
      WALL("energy tank, predicted", "A tank that trusts the motion to go on as it does.",
           ph::spring{}, LEDGER, ph::predicting_tank{.reserve = 1e-6}),
      WALL("tank + level controller", "Two layers: a damper refills the tank.", ph::spring{},
           LEDGER,
           ph::two_layer_tank{.wanted = 0.015, .refill = 3000, .max_damping = 0.5 * mass / tick}),
      WALL("tank + level controller + strict", "Two layers, and strict behind them.", ph::spring{},
           LEDGER,
           ph::bound_chain{ph::two_layer_tank{
                               .wanted = 0.015, .refill = 3000, .max_damping = 0.5 * mass / tick},
                           ph::strict_bound{}}),
      WALL("PSPM as published", "Set-position modulation as it was published.",
           ph::shaped{ph::spring{}, ph::published_set_position_modulation{}}, LEDGER,
           ph::no_bound{}),
      WALL("PSPM", "Set-position modulation that pays for the hold, too.",
           ph::shaped{ph::spring{}, ph::set_position_modulation{}}, LEDGER, ph::no_bound{}),
      WALL("PSPM + strict FBA", "The same, and strict behind it.",
           ph::shaped{ph::spring{}, ph::set_position_modulation{}}, LEDGER, ph::strict_bound{}),
      WALL("virtual coupling", "A spring no stiffer than 2b/T: soft, whatever the wall.",
           ph::virtual_coupling{.stiffness = 2 * damping / tick}, ph::no_observer{},
           ph::no_bound{}),
      WALL("nonlinear coupling", "Grows stiffer while there is spare energy.",
           ph::shaped{ph::spring{},
                      ph::nonlinear_coupling{.initial = 2 * damping / tick, .rate = 10000}},
           LEDGER, ph::strict_bound{}),
      WALL("stiffness increment", "Grows stiffer by 2b/T with each press.",
           ph::shaped{ph::spring{}, ph::stiffness_increment{.initial = 2 * damping / tick,
                                                            .step = 2 * damping / tick}},
           LEDGER, ph::strict_bound{}),
      WALL("force augmentation", "A soft spring, and half a newton more with each press.",
           ph::shaped{ph::spring{}, ph::force_augmentation{.low = 2 * damping / tick, .step = 0.5}},
           LEDGER, ph::strict_bound{}),
      WALL("strict FBA, encoder steps", "Strict, with a ledger that allows for encoder steps.",
           ph::spring{}, ph::quantised_energy{.damping = damping, .quantum = quantum},
           ph::strict_bound{}),
      WALL("reachable, encoder steps", "Reachable, with a ledger that allows for encoder steps.",
           ph::spring{}, ph::quantised_energy{.damping = damping, .quantum = quantum}, REACHABLE),
      PAGE_CONTROLLER(wall_touch, "damped spring + reachable, encoder steps",
                      "What is recommended where encoder steps are felt and friction is unknown.",
                      ph::local_model{scene{}, ph::followed<ph::half_space<scene>>{},
                                      ph::turn_at_once{}, ph::damped_spring{.mass = mass},
                                      ph::quantised_energy{.damping = damping, .quantum = quantum},
                                      REACHABLE,
                                      ph::loop_limits{.longest_tick = tick, .top_speed = 100},
                                      ph::mass_observer{.mass = mass, .quantum = quantum}}),
      WALL_SET("contact set, strict", "One of many contacts, bounded strictly.", ph::frictionless{},
               ph::strict_bound{}),
      WALL_SET("contact set, reachable", "One of many contacts, for a known mass and hand.",
               ph::frictionless{}, REACHABLE),
      WALL_SET("rough contact, strict", "The same where surfaces rub; on a rail nothing does.",
               ph::stick_slip{}, ph::strict_bound{}),
      WALL_SET("rough contact, reachable", "The same where surfaces rub; on a rail nothing does.",
               ph::stick_slip{}, REACHABLE),
  };

  [[nodiscard]] touch::news surfaces(double time, const page::settings& set) const noexcept {
    return {
        {{.point = set.heave * page::wave(1.1 * time), .normal = 1, .stiffness = set.stiffness}}};
  }
};

page::stage_of<wall> the_wall;

}  // namespace

std::span<page::stage* const> page::stages() noexcept {
  static constexpr std::array<page::stage*, 1> all{&the_wall};
  return all;
}
