// SPDX-License-Identifier: BSD-3-Clause
// Does the promise hold on encoders? Every adversary of the challenge, and a search for the worst hand,
// against strict_bound and reachable_bound on dual_ledger, where positions have steps or noise and dry
// friction is elastic. Control: a ledger that is told of exact positions and a rigid friction.
#include "program.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/challenge.hpp>
#include <passive_haptics/simulation/search.hpp>

#include <array>
#include <cmath>
#include <functional>

namespace encoders {

namespace {

constexpr double accepted_loss = 1e-12;  // [J]: rounding

struct guarantee_row {
  int dimensions = 1;
  sim::circumstances world{};
  std::string composition{};
  bool promised = false;  ///< to a hand that does this
  std::string hand{};
  int runs = 0;
  double least_energy = 0.0;   ///< of all runs, what friction took and stores included [J]
  double largest_force = 0.0;  ///< commanded [N]
  ex::at_rest still{};         ///< of the composition in this world, in a hand that holds still
};

ex::record record_of(const guarantee_row& r) {
  return ex::with_floor({{"dimensions", static_cast<double>(r.dimensions), "%.0f"},
                         {"step_um", r.world.quantum * 1e6, "%.0f"},
                         {"noise_um", r.world.noise * 1e6, "%.0f"},
                         {"presliding_um", r.world.presliding * 1e6, "%.0f"},
                         {"latency", static_cast<double>(r.world.latency), "%.0f"},
                         {"composition", r.composition},
                         {"hand", r.hand},
                         {"promised", std::string(r.promised ? "yes" : "no")},
                         {"runs", static_cast<double>(r.runs), "%.0f"},
                         {"least_energy_J", r.least_energy},
                         {"largest_force_N", r.largest_force}},
                        r.still);
}

/// One composition in one world: makes the rows of all hands.
struct cell {
  sim::circumstances world{};
  std::function<std::vector<guarantee_row>(const sim::circumstances&, int runs)> judge{};
};

/// What the ledger is told. A spring on every axis gives way by p each, so by p √n in all.
template <class Space>
ph::dual_ledger told(const sim::circumstances& world) {
  return {.damping = {world.damping, world.friction, world.presliding * std::sqrt(Space::dof)},
          .quantum = world.quantum + world.noise};
}

template <class Space, int Latency>
auto port_of(const auto& ledger, const auto& bound) {
  return ph::local_model{
      Space{},
      ph::followed<ph::half_space<Space>>{},
      ph::turn_at_once{},
      ph::spring{},
      ledger,
      bound,
      ph::late_loop_limits<Latency>{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3}};
}

template <class Space>
guarantee_row row_of(const sim::circumstances& world, const char* composition) {
  return {.dimensions = Space::dof, .world = world, .composition = composition};
}

/// The stiffness [N/m] that the model says it displays of the surface that it was told.
[[nodiscard]] double displayed_by(auto model) {
  using space = typename decltype(model)::space_type;
  (void)model.tick(space::zero(), ph::seconds{1e-3});
  return model.explain().shown;
}

/// No adversary holds still, so each composition is also pressed in its world by a hand that does: 100 N/m and 1 N·s/m,
/// from 2 mm above a wall of 2 or 10 kN/m towards 20 mm inside it, off its axis where there is one.
template <class Space>
guarantee_row held_still(auto model, const sim::circumstances& world) {
  using vector = typename sim::physical<Space>::vector;
  using hand = sim::impedance_hand<Space>;
  constexpr double T = 1e-3;
  guarantee_row all{.dimensions = Space::dof, .world = world, .hand = "that holds still"};
  vector n = sim::physical<Space>::zero(), goal = n;
  for (int i = 0; i < Space::dof; ++i) {
    Space::component(n, i) = i == 0 ? -1.0 : 0.0;
    Space::component(goal, i) = i == 0 ? 20e-3 : 5e-3;
  }
  for (const double K : {2e3, 10e3}) {
    auto pressed = model;
    (void)pressed.update({Space::zero(), n, K});
    auto parameters = world.device_of<Space>();
    Space::component(parameters.start, 0) = -2e-3;
    const hand fingers{
        .stiffness = 100.0, .damping = 1.0, .limit = world.hand_force, .target = goal};
    sim::device<Space, hand, sim::friction_like> device(parameters, fingers,
                                                        world.elastic_friction());
    const double step = std::max(world.quantum, world.noise);
    const double displayed = std::min(K, displayed_by(pressed));
    sim::quiet_judge<Space> judge(sim::quiet_bars{}.on_encoders(step, displayed, world.mass));
    sim::noisy_sensor<Space> noise(world.noise, sim::noise_habit{}, 1);
    ex::held_stiffness held;
    const std::array<typename Space::motion, 1> normal{n};
    auto commanded = typename sim::physical<Space>::coordinates{};
    constexpr int ticks = static_cast<int>(ex::quiet_watched / T);
    const auto spoil = [&](auto& now) {
      if (world.noise > 0.0) sim::detail::spoil<Space>(now.sample, noise, now.position, commanded);
    };
    const auto seen = sim::run(device, pressed, ticks, spoil, sim::idle, [&](const auto& now) {
      commanded = sim::to_physical<Space>(now.force);
      const double depth = Space::component(now.position, 0);
      judge.add(now.force, device.velocity(), T, std::span(normal).first(depth > 0.0 ? 1 : 0));
      if (now.tick >= ticks - 1000) held.add(-Space::component(now.force, 0), depth);
    });
    ++all.runs;
    all.least_energy = std::min(all.least_energy, seen.least_energy);
    all.largest_force = std::max(all.largest_force, seen.largest_force);
    all.still.add(judge, {K, held.shown()});
    all.still.on_floor(displayed * step);
  }
  return all;
}

/// All adversaries in turn, `runs` in all, and as many tries of one that is tuned.
template <class Space, int Latency>
std::vector<guarantee_row> under_attack(const sim::circumstances& world, int runs,
                                        const char* composition, bool limited_hands_only,
                                        bool promises, const auto& model) {
  std::vector<sim::adversary> hands;
  const auto invite = [&](sim::adversary by) {
    if (!limited_hands_only || sim::is_force_limited(by)) hands.push_back(by);
  };
  for (const auto by : sim::all_adversaries) invite(by);
  for (const auto by : sim::encoder_adversaries) invite(by);
  const int each = runs / static_cast<int>(hands.size()) + 1;
  std::vector<guarantee_row> rows;
  for (const auto by : hands) {
    const auto v = sim::challenge(model, by, world, each);
    guarantee_row r = row_of<Space>(world, composition);
    r.promised = promises;
    r.hand = to_string(by);
    r.runs = v.runs;
    r.least_energy = v.least_energy;
    r.largest_force = v.largest_force;
    rows.push_back(r);
  }
  guarantee_row searched = row_of<Space>(world, composition);
  const auto worst = limited_hands_only ? sim::worst_push(model, world, runs)
                                        : sim::worst_motion(model, world, runs);
  searched.promised = promises;
  searched.hand = limited_hands_only ? "worst push" : "worst motion";
  searched.runs = worst.evaluations;
  searched.least_energy = std::min(0.0, worst.energy);
  rows.push_back(searched);
  guarantee_row still = held_still<Space>(model, world);
  still.composition = composition;
  still.promised = promises;
  rows.push_back(still);
  for (auto& row : rows) row.still = still.still;
  return rows;
}

template <int Dof, int Latency>
std::vector<guarantee_row> strict(const sim::circumstances& world, int runs) {
  using Space = ph::space<double, Dof>;
  return under_attack<Space, Latency>(
      world, runs, "dual_ledger, strict_bound", false, true,
      port_of<Space, Latency>(told<Space>(world), ph::strict_bound{}));
}
template <int Dof, int Latency>
std::vector<guarantee_row> reachable(const sim::circumstances& world, int runs) {
  using Space = ph::space<double, Dof>;
  return under_attack<Space, Latency>(
      world, runs, "dual_ledger, reachable_bound", true, true,
      port_of<Space, Latency>(
          told<Space>(world),
          ph::reachable_bound{.mass = world.mass,
                              .hand_force = world.hand_force + world.friction * std::sqrt(Dof)}));
}
/// What an encoder_device and a known_hand make: the law is damped, sees through an edge_observer and keeps to the
/// budget.
constexpr const char* recommended = "make_touch";
template <int Dof, int Latency>
std::vector<guarantee_row> touch(sim::circumstances world, int runs) {
  world.watchdog = false;
  using Space = ph::space<double, Dof>;
  const auto by_ledger = told<Space>(world);
  const ph::encoder_device device{.mass = world.mass,
                                  .damping = by_ledger.damping.coefficient,
                                  .friction = by_ledger.damping.coulomb,
                                  .presliding = by_ledger.damping.presliding,
                                  .quantum = world.quantum + world.noise,
                                  .force_limit = 9.0,
                                  .longest_tick = world.longest_tick,
                                  .latency = Latency,
                                  .top_speed = 100.0};
  const double hand = world.hand_force + world.friction * std::sqrt(Dof);
  return under_attack<Space, Latency>(
      world, runs, recommended, true, true,
      ph::make_touch<Space, ph::half_space<Space>, ph::late_loop_limits<Latency>>(
          device, ph::known_hand{.force = hand}));
}
template <int Dof>
std::vector<guarantee_row> exact(const sim::circumstances& world, int runs) {
  using Space = ph::space<double, Dof>;
  return under_attack<Space, 0>(
      world, runs / 10, "control: told exact and rigid", false, false,
      port_of<Space, 0>(ph::dual_ledger{.damping = {world.damping, world.friction, 0.0}},
                        ph::strict_bound{}));
}

std::vector<cell> cells(bool quick) {
  std::vector<cell> all;
  const auto add = [&all](sim::circumstances world, int latency, auto judge) {
    world.latency = latency;
    all.push_back({world, judge});
  };
  for (const double p : {5e-6, 30e-6}) {
    if (quick && p > 5e-6) continue;
    const sim::circumstances stepped{.friction = 0.2, .presliding = p, .quantum = 60e-6};
    sim::circumstances noisy{.friction = 0.2,
                             .presliding = p,
                             .rubs_like = sim::friction_kind::three_springs,
                             .noise = 60e-6};
    for (const auto& world : {stepped, noisy}) {
      add(world, 0, strict<1, 0>);
      add(world, 0, reachable<1, 0>);
      add(world, 0, touch<1, 0>);
      add(world, 0, exact<1>);
      if (quick) continue;
      add(world, 1, strict<1, 1>);
      add(world, 2, strict<1, 2>);
      add(world, 3, strict<1, 3>);
      add(world, 1, reachable<1, 1>);
      add(world, 3, reachable<1, 3>);
      add(world, 0, strict<2, 0>);
      add(world, 0, strict<3, 0>);
      add(world, 2, strict<3, 2>);
      add(world, 0, reachable<3, 0>);
      add(world, 0, touch<3, 0>);
      add(world, 0, exact<3>);
    }
  }
  return all;
}

/// The worst of all hands in each world, by composition.
std::vector<guarantee_row> worst_of_each(const std::vector<guarantee_row>& rows) {
  std::vector<guarantee_row> worst;
  for (const auto& r : rows) {
    const auto same = [&r](const guarantee_row& w) {
      return w.dimensions == r.dimensions && w.composition == r.composition &&
             w.world.latency == r.world.latency && w.world.presliding == r.world.presliding &&
             w.world.noise == r.world.noise;
    };
    const auto known = std::find_if(worst.begin(), worst.end(), same);
    if (known == worst.end()) {
      worst.push_back(r);
      continue;
    }
    const int runs = known->runs + r.runs;
    const double force = std::max(known->largest_force, r.largest_force);
    if (r.least_energy < known->least_energy) *known = r;
    known->runs = runs;
    known->largest_force = force;
  }
  return worst;
}

}  // namespace

std::vector<std::string> run_guarantee(const session& s) {
  const int runs = s.chosen.quick ? 100 : 1000;
  const auto rows = s.rows("guarantee.csv", "adversaries", cells(s.chosen.quick),
                           [runs](const cell& c) { return c.judge(c.world, runs); });
  std::vector<std::string> found;
  bool control_lost = false;
  for (const auto& r : rows) {
    if (r.composition == recommended && r.world.noise == 0.0 && !r.still.all_quiet()) {
      found.push_back(r.composition + ", " + r.hand + ": quiet in " + r.still.share());
    }
    if (!r.promised) control_lost |= r.least_energy < -1e-6;
    if (!r.promised || r.least_energy >= -accepted_loss) continue;
    found.push_back(r.composition + ex::format(", %g dimensions", r.dimensions) +
                    ex::format(", presliding %g µm, ", r.world.presliding * 1e6) + r.hand +
                    ex::format(": lost %.3g J", -r.least_energy));
  }
  if (!control_lost) found.push_back("the control lost nothing: these adversaries are too weak");
  s.out.section("Guarantee",
                "The least energy at the port, what friction took and stores included, over all "
                "adversaries of a row. Steps and noise of 60 µm, dry friction of 0.2 N on every "
                "axis, elastic: one spring where there are steps, three where there is noise. "
                "reachable_bound: the three hands that are limited to 5 N, for that is what it "
                "promises. No adversary holds still, so beside them stands what the composition "
                "does in its world in a hand of 100 N/m and 1 N·s/m that does, on walls of 2 and "
                "10 kN/m. The law of all but make_touch is a spring without a damper, the worst "
                "that the bounds are asked to hold: on 2 kN/m it rings, because the hold of a tick "
                "feeds it by K T/2, 1 N·s/m, which is all that hand and device damp. make_touch "
                "has to be quiet where positions have steps. Told of noise of 60 µm as if it were "
                "a step, it is quiet where friction gives way by 5 µm, and in one dimension not "
                "where it does by 30." +
                    std::string(ex::quiet_columns) + ex::quiet_on_steps + ex::held_last_second);
  s.out.show(ex::table_of(worst_of_each(rows)));
  s.out.member("guarantee", ex::json_of(rows));
  return found;
}

}  // namespace encoders
