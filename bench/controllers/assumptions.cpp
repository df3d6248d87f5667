// SPDX-License-Identifier: BSD-3-Clause
// Every assumption that a named composition states, made untrue one at a time: what the hands draw out of it
// while the statement holds, and what once it does not.
#include "assumptions.hpp"

#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/knob/detents.hpp>
#include <passive_haptics/simulation/presets.hpp>

#include <initializer_list>

namespace controllers {

namespace {

constexpr double accepted_loss = 1e-12;  // [J], of a statement that holds: rounding
constexpr double shown_loss = 1e-9;      // [J], no rounding any more

// -------------------------------------------------------------------------------- what is attacked

/// A contact whose driver does not say which force it held, as most do not: the port has to take its
/// own command for it.
template <class Model>
struct unreported {
  using space_type = d1;
  Model model;
  auto tick(const ph::device_sample<d1>& sample) noexcept {
    if (!sample.valid) return model.tick(sample);
    return model.tick(sample.position, ph::seconds{sample.dt});
  }
};
constexpr auto lay_on_contact = [](auto& loop, const auto& surface) {
  return loop.model.update({surface.point, surface.normal, surface.stiffness});
};

constexpr auto lay_on_set = [](auto& loop, const auto& surface) {
  return loop.model.source().update(
      0, ph::half_space<d1>{surface.point, surface.normal, surface.stiffness});
};
constexpr auto lay_on_nothing = [](auto& /*loop*/, const auto& /*surface*/) { return true; };

/// The same of a guard, in front of a renderer of spring walls.
template <class Guard>
struct rendered {
  using space_type = d1;
  Guard guard;
  sim::surface_state<d1> wall{};
  auto tick(const ph::device_sample<d1>& sample) noexcept {
    if (!sample.valid) return guard.tick(sample);
    const double deep = std::max(0.0, wall.depth(sample.position));
    return guard.tick(sample.position, ph::seconds{sample.dt},
                      wall.normal * (wall.stiffness * deep));
  }
};
constexpr auto lay_on_guard = [](auto& loop, const auto& surface) {
  loop.wall = surface;
  return true;
};

/// The circumstances, and the hands in them.
struct situation : sim::circumstances {
  std::vector<sim::adversary> hands{};
};

/// A named composition, told of a device, and the hands that its promise covers.
struct subject {
  std::string name;
  std::function<drawn(const situation&, const effort&)> attack;
  std::vector<sim::adversary> covered;
};

const std::vector<sim::adversary> limited_hands{
    sim::adversary::tapping, sim::adversary::random_tapping, sim::adversary::trembling};

/// All but the two that hold a force for longer than the longest tick.
std::vector<sim::adversary> steady_adversaries() {
  std::vector<sim::adversary> all;
  for (const auto by : sim::all_adversaries) {
    if (by != sim::adversary::overruns && by != sim::adversary::kitchen_sink) all.push_back(by);
  }
  return all;
}

/// The same, and those that move less than an encoder step.
std::vector<sim::adversary> strict_hands_on_encoders() {
  auto all = steady_adversaries();
  for (const auto by : sim::encoder_adversaries) {
    if (!sim::is_force_limited(by)) all.push_back(by);
  }
  return all;
}

template <class Loop, class Lay>
subject attacked(const char* name, const Loop& loop, const Lay& lay,
                 const std::vector<sim::adversary>& covered) {
  return {name,
          [loop, lay](const situation& world, const effort& how) {
            return most_drawn(loop, lay, world, world.hands, how);
          },
          covered};
}

// ------------------------------------------------------------------------- what is stated and true

/// The device is what is stated of it, with nothing to spare, and its driver drops no force.
sim::circumstances just_as(const ph::exact_device& d, double hand_force) {
  return {.damping = d.damping,
          .mass = d.mass,
          .hand_force = hand_force,
          .force_limit = d.force_limit,
          .watchdog = false};
}
sim::circumstances just_as(const ph::encoder_device& d, double hand_force) {
  return {.damping = d.damping,
          .mass = d.mass,
          .friction = d.friction,
          .presliding = d.presliding,
          .hand_force = hand_force,
          .quantum = d.quantum,
          .force_limit = d.force_limit,
          .longest_tick = d.longest_tick,
          .watchdog = false};
}

/// A soft wall that moves far gives out more than weak motors have taken in.
sim::circumstances soft_and_restless(sim::circumstances world) {
  world.softest = 200.0;
  world.stiffest = 600.0;
  world.jump = 20e-3;
  world.ticks = 2000;
  return world;
}

statement<situation> mass(const situation& w) {
  return scaled("mass, at least", &sim::circumstances::mass, "%.3g kg", 1.0, w, less);
}
statement<situation> damping(const situation& w) {
  return scaled("damping, at least", &sim::circumstances::damping, "%.3g N·s/m", 1.0, w, less);
}
statement<situation> friction(const situation& w) {
  return scaled("dry friction, at least", &sim::circumstances::friction, "%.3g N", 1.0, w, less);
}
statement<situation> presliding(const situation& w) {
  return scaled("presliding, at most", &sim::circumstances::presliding, "%.3g µm", 1e-6, w, more);
}
statement<situation> hand_force(const situation& w) {
  return scaled("hand's force, at most", &sim::circumstances::hand_force, "%.3g N", 1.0, w, more);
}
statement<situation> encoder_step(const situation& w) {
  return scaled("encoder step, at most", &sim::circumstances::quantum, "%.3g µm", 1e-6, w, more);
}
statement<situation> longest_tick(const situation& w) {
  return scaled("longest tick", &sim::circumstances::longest_tick, "%.3g ms", 1e-3, w,
                {2.0, 3.0, 10.0});
}
statement<situation> motors_limit(const situation& w) {
  return scaled("motors hold, at least", &sim::circumstances::force_limit, "%.3g N", 1.0, w, less);
}
statement<situation> exact_positions(const situation& w) {
  return replaced("positions exact: steps of", &sim::circumstances::quantum, "%g µm", 1e-6, w,
                  {10e-6, 100e-6, 1e-3});
}
statement<situation> latency(const situation& w) {
  return replaced("ticks of latency", &sim::circumstances::latency, "%g", 1.0, w,
                  {w.latency + 1, w.latency + 2, w.latency + 5});
}
/// No limit of the motors is stated, so that they are to have none.
statement<situation> unlimited_motors(const situation& w) {
  auto s = replaced("motors hold what is commanded", &sim::circumstances::force_limit, "%g N", 1.0,
                    w, {3.0, 1.0, 0.3});
  s.show = [shown = s.show](const situation& x) {
    return std::isinf(x.force_limit) ? std::string("all") : shown(x);
  };
  return s;
}
statement<situation> limited_hand(const situation& w) {
  statement<situation> s{"hand limited in force",
                         [](const situation& x) {
                           return std::string(x.hands.size() > 1 ? "yes" : "a velocity source");
                         },
                         {w}};
  s.untrue.front().hands = {sim::adversary::greedy};
  return s;
}

std::vector<trial> trials() {
  std::vector<trial> all;
  const auto add = [&all](const subject& who, const sim::circumstances& stated,
                          std::initializer_list<statement<situation> (*)(const situation&)> list) {
    const situation world{stated, who.covered};
    for (const auto make : list) {
      all.push_back(trial_of(who.name, world, make(world), who.attack));
    }
  };

  const ph::exact_device ideal{.mass = 0.1, .damping = 0.03, .force_limit = 9.0};
  const ph::known_hand person{.force = 5.0};
  const auto world = just_as(ideal, person.force);
  const subject touch =
      attacked("make_touch", unreported<ph::touch<d1>>{ph::make_touch<d1>(ideal, person)},
               lay_on_contact, limited_hands);
  add(touch, world,
      {mass, damping, hand_force, limited_hand, motors_limit, longest_tick, latency,
       exact_positions});
  const subject guard =
      attacked("make_guard", rendered<ph::force_guard<d1>>{ph::make_guard<d1>(ideal, person)},
               lay_on_guard, limited_hands);
  add(guard, world,
      {mass, damping, hand_force, limited_hand, motors_limit, longest_tick, latency,
       exact_positions});

  const auto of_set = [](const char* name, auto port) {
    return attacked(name, unreported<decltype(port)>{port}, lay_on_set, limited_hands);
  };
  const ph::slots<ph::half_space<d1>, 1> one{};
  add(of_set("make_contacts", ph::make_contacts<d1>(ideal, person, one)), world,
      {mass, damping, hand_force, limited_hand, motors_limit, longest_tick, latency,
       exact_positions});
  const auto detents = ph::make_detents<d1>(ideal, person, {.pitch = 5e-3, .stiffness = 2000.0});
  add(attacked("make_detents", unreported<std::remove_const_t<decltype(detents)>>{detents},
               lay_on_nothing, limited_hands),
      world, {mass, damping, hand_force, limited_hand, longest_tick, latency, exact_positions});
  const auto trusted = ph::make_touch<d1>(ideal, ph::trusted_hand{person});
  add(attacked("make_touch, trusted_hand",
               unreported<std::remove_const_t<decltype(trusted)>>{trusted}, lay_on_contact,
               limited_hands),
      world,
      {mass, damping, hand_force, limited_hand, motors_limit, longest_tick, latency,
       exact_positions});
  const auto anybody = ph::make_touch<d1>(ideal, ph::any_hand);
  add(attacked("make_touch, any_hand", unreported<std::remove_const_t<decltype(anybody)>>{anybody},
               lay_on_contact, steady_adversaries()),
      world, {damping, longest_tick, latency, exact_positions});

  auto strict_world = world;
  strict_world.force_limit = sim::circumstances::infinity;
  auto unlimited = ph::make_strict_guard<d1>(ideal.damping, ph::actuator_limit{1e6}, 1e-3);
  const subject strict = attacked("make_strict_guard", rendered<decltype(unlimited)>{unlimited},
                                  lay_on_guard, steady_adversaries());
  add(strict, strict_world, {damping, unlimited_motors, longest_tick, latency, exact_positions});

  const auto on_encoders = [](const char* name, const ph::encoder_device& d, double hand) {
    return attacked(name,
                    unreported<ph::encoder_touch<d1>>{
                        ph::make_touch<d1>(d, ph::known_hand{.force = hand + d.friction})},
                    lay_on_contact, limited_hands);
  };
  const auto& light = sim::touch_like;
  const ph::encoder_device stated{.mass = light.mass,
                                  .damping = light.damping / 2,
                                  .friction = light.friction / 2,
                                  .presliding = 15e-6,
                                  .quantum = light.quantum,
                                  .force_limit = light.force_limit};
  const auto stepped = just_as(stated, 5.0);
  const subject encoders = on_encoders("make_touch, encoders", stated, 5.0);
  add(encoders, stepped,
      {mass, damping, friction, presliding, hand_force, limited_hand, encoder_step, longest_tick,
       latency});
  add(encoders, soft_and_restless(stepped), {motors_limit});
  const ph::known_hand known{.force = 5.0 + stated.friction};
  add(of_set("make_contacts, encoders", ph::make_contacts<d1>(stated, known, one)), stepped,
      {mass, friction, presliding, hand_force, limited_hand, encoder_step, longest_tick, latency});
  const auto guarded = ph::make_guard<d1>(stated, known);
  add(attacked("make_guard, encoders", rendered<std::remove_const_t<decltype(guarded)>>{guarded},
               lay_on_guard, limited_hands),
      stepped,
      {mass, damping, friction, presliding, hand_force, limited_hand, encoder_step, longest_tick,
       latency});
  const auto strictly = ph::make_guard<d1>(stated, ph::any_hand);
  add(attacked("make_guard, encoders, any_hand",
               rendered<std::remove_const_t<decltype(strictly)>>{strictly}, lay_on_guard,
               strict_hands_on_encoders()),
      stepped, {friction, presliding, encoder_step, longest_tick, latency});
  // The same of a device whose damper pays for more than its dry friction.
  const ph::encoder_device damped{.mass = 0.05,
                                  .damping = 4.0,
                                  .friction = 0.05,
                                  .presliding = 1e-6,
                                  .quantum = 10e-6,
                                  .force_limit = 12.0};
  add(on_encoders("make_touch, encoders, much damped", damped, 10.0), just_as(damped, 10.0),
      {damping});
  for (const auto& t : trials_of_companions()) all.push_back(t);
  return all;
}

/// The runs of each hand after which a statement that costs nothing when untrue is no assumption.
constexpr int enough_runs = 100;

/// Looks, the least untrue first, for what draws energy out of a composition that was told an untruth.
void violate(assumption_row& row, const trial& t, const effort& how) {
  row.runs = how.runs;
  for (const auto& untruth : t.untrue) {
    const drawn most = untruth.by(how);
    row.in_truth = untruth.true_value;
    row.violated = most.joules;
    row.by = most.by;
    if (row.violated > shown_loss) return;
  }
  if (!t.unpaid && how.runs < enough_runs) return violate(row, t, {enough_runs, how.first});
  row.by = "none of ours";
}

assumption_row judged(const trial& t, const effort& how) {
  assumption_row row;
  row.composition = t.composition;
  row.assumption = t.assumption;
  row.stated = t.stated;
  row.unpaid = t.unpaid;
  row.kept = t.kept(how).joules;
  violate(row, t, how);
  return row;
}

}  // namespace

static ex::record record_of(const assumption_row& r) {
  return {{"composition", r.composition},
          {"assumption", r.assumption},
          {"stated", r.stated},
          {"true", r.in_truth},
          {"J created with it kept", r.kept, "%.1e"},
          {"J created with it violated", r.violated, "%.1e"},
          {"by", r.by},
          {"runs of each hand", r.runs}};
}

std::vector<std::string> unfounded(const std::vector<assumption_row>& rows) {
  std::vector<std::string> found;
  for (const auto& r : rows) {
    const std::string cell = r.composition + ", " + r.assumption + ": ";
    if (!(r.kept <= accepted_loss)) {
      found.push_back(cell + "created " + ex::format("%.3g", r.kept) + " J while it is kept");
    }
    if (!(r.violated > shown_loss) && !r.unpaid) {
      found.push_back(cell + "nothing is created at " + r.in_truth +
                      "; find the hand, or state the assumption no longer");
    }
    if (r.violated > shown_loss && r.unpaid) {
      found.push_back(cell + ex::format("%.3g", r.violated) + " J are created at " + r.in_truth +
                      ", of which it is said that nothing is");
    }
  }
  return found;
}

std::vector<std::string> run_assumptions(const session& s) {
  const effort how{std::max(30, s.chosen.runs / 10), s.chosen.first()};
  const auto rows = s.rows("assumptions.csv", "assumptions", trials(),
                           [&how](const trial& t) { return judged(t, how); });
  s.out.section("Assumptions",
                "The most that any hand has drawn out of a named composition on a device that is "
                "just as stated and has nothing to spare, and on one of which one statement is "
                "untrue: a little, and if that creates nothing, much. No driver reports the force "
                "it held. The hands of conditional compositions: tapping, random tapping and "
                "trembling, limited in force, a search for the worst push, and one that presses "
                "motors in and gives way; of strict ones: the "
                "ten adversaries that keep to the longest tick, a search for the worst motion, and "
                "one that is pushed out by less than it has pressed against. All in one dimension "
                "but a mesh, in three, and a tool, in six degrees of freedom: four habits of a "
                "hand, and a plane that jumps and turns at a point of it. Behind a transmission "
                "that gives: six hands at the load. A kept cell above 1e-12 J fails the run, and "
                "so does a violated one below 1e-9 J, but where it is said that no hand of ours "
                "draws anything, and there one above does. "
                "Quiet is not judged here, because none of these hands holds still.");
  s.out.show(ex::table_of(rows, [](const assumption_row& r) {
    auto line = record_of(r);
    line.pop_back();
    return line;
  }));
  s.out.member("assumptions", ex::json_of(rows));
  return unfounded(rows);
}

}  // namespace controllers
