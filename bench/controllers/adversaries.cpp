// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

#include <map>

namespace controllers {

namespace {

constexpr double accepted_loss = 1e-12;  // [J], of a guarantee: rounding
constexpr double shown_loss = 1e-9;      // [J], no rounding any more

/// Does time or the sensor misbehave?
bool unsteady(sim::adversary by) noexcept {
  return by == sim::adversary::jitter || by == sim::adversary::overruns ||
         by == sim::adversary::dropouts || by == sim::adversary::kitchen_sink;
}

template <class Space>
attack_row judge_in(const controller& c, const attack& a, const effort& how) {
  sim::circumstances world = a.world;
  if (c.credits_friction) world.friction = 0.3;
  world.latency = std::max(world.latency, c.latency);
  const premises known{.mass = world.mass,
                       .damping = world.damping,
                       .friction = world.friction,
                       .hand_force = world.hand_force + world.friction,
                       .quantum = world.quantum,
                       .longest_tick = world.longest_tick};
  const auto v = sim::challenge(c.in<Space>()(known), a.by, world, how.runs, how.first);
  return {c.name,       c.tag,          a.name,          Space::dof,  how.runs,
          covers(c, a), v.least_energy, v.largest_force, v.worst_seed};
}

}  // namespace

std::vector<attack> attacks(int seed) {
  std::vector<attack> list;
  for (const auto by : sim::all_adversaries) {
    if (by != sim::adversary::rocking) list.push_back({to_string(by), by, {}});
  }
  const sim::circumstances stepped{.quantum = 60e-6};
  const sim::circumstances light{.mass = 0.02, .hand_force = 20.0};
  const sim::circumstances weak{.force_limit = 2.0};
  const sim::circumstances late{.latency = 2};
  const sim::circumstances soft{.softest = 20.0, .stiffest = 60.0};
  list.push_back({"tapping, 20 g, 20 N", sim::adversary::tapping, light});
  list.push_back({"greedy, motors of 2 N", sim::adversary::greedy, weak});
  list.push_back({"greedy, 2 ticks late", sim::adversary::greedy, late});
  list.push_back({"kitchen sink, 2 ticks late", sim::adversary::kitchen_sink, late});
  list.push_back({"greedy, 60 µm", sim::adversary::greedy, stepped});
  list.push_back({"rocking, 60 µm", sim::adversary::rocking, stepped});
  list.push_back({"tapping, 60 µm", sim::adversary::tapping, stepped});
  list.push_back({"kitchen sink, 60 µm", sim::adversary::kitchen_sink, stepped});
  list.push_back({"greedy, K ≤ 60 N/m", sim::adversary::greedy, soft});
  list.push_back({"jumping surface, K ≤ 60 N/m", sim::adversary::jumping_surface, soft});
  list.push_back({"kitchen sink, K ≤ 60 N/m", sim::adversary::kitchen_sink, soft});
  for (auto& a : list) {
    ex::redrawn number(seed, static_cast<std::uint64_t>(&a - list.data()));
    if (a.world.mass != light.mass) {  // whose name says what it is
      a.world.mass = number(a.world.mass, 0.05, 0.5);
      a.world.hand_force = number(a.world.hand_force, 2.0, 15.0);
    }
    a.world.damping = number(a.world.damping, 0.03, 0.1);  // what is proved up to 2b/T stays so
  }
  return list;
}

bool covers(const controller& c, const attack& a) noexcept {
  if (c.needs_known_hands() && (!sim::is_force_limited(a.by) || unsteady(a.by))) return false;
  if (!c.knows_steps && a.world.quantum > 0.0) return false;
  return a.world.latency <= c.latency && c.covers_stiffness(a.world.stiffest);
}

attack_row judge_under_attack(const controller& c, const attack& a, int dof, const effort& how) {
  return dof == 1   ? judge_in<d1>(c, a, how)
         : dof == 2 ? judge_in<d2>(c, a, how)
                    : judge_in<d3>(c, a, how);
}

std::vector<std::string> contradictions(const std::vector<attack_row>& rows) {
  std::vector<std::string> found;
  std::map<std::string, double> loss;  // of cells that are not covered
  std::map<std::string, ph::guarantee> tags;
  for (const auto& row : rows) {
    const std::string cell = row.controller + ", tagged " + to_string(row.tag) + ", against " +
                             row.attack + " in " + std::to_string(row.dof) + " DOF: ";
    tags[row.controller] = row.tag;
    if (!row.covered) {
      auto& least = loss[row.controller];
      if (!(row.least_energy >= least)) least = row.least_energy;
    } else if (!(row.least_energy >= -accepted_loss)) {
      found.push_back(cell + "lost " + ex::format("%.3g", -row.least_energy) + " J with seed " +
                      std::to_string(row.worst_seed));
    } else if (!(row.largest_force > 0.0)) {
      found.push_back(cell + "never pushed, which proves nothing");
    }
  }
  for (const auto& [name, tag] : tags) {
    if (tag == ph::guarantee::strict || loss[name] < -shown_loss) continue;
    found.push_back(name + ", tagged " + to_string(tag) + ": no attack " +
                    (tag == ph::guarantee::none ? "" : "outside its assumptions ") +
                    "made it lose anything; promise more, or find the attack");
  }
  return found;
}

static ex::record record_of(const attack_row& r) {
  return {{"controller", r.controller},
          {"tag", to_string(r.tag)},
          {"attack", r.attack},
          {"dof", r.dof},
          {"runs", r.runs},
          {"covered", r.covered},
          {"least port energy J", r.least_energy},
          {"largest force N", r.largest_force},
          {"worst seed", r.worst_seed}};
}

/// A line for each controller, a column for each attack: the worst of the dimensions.
static ex::table worst_of(const std::vector<controller>& judged, const std::vector<attack>& list,
                          const std::vector<attack_row>& rows) {
  std::map<std::pair<std::string, std::string>, double> least;
  for (const auto& r : rows) {
    double& worst = least[{r.controller, r.attack}];
    if (!(r.least_energy >= worst)) worst = r.least_energy;
  }
  return ex::table_of(judged, [&](const controller& c) {
    ex::record line{{"controller", c.name}, {"tag", to_string(c.tag)}};
    for (const auto& a : list) {
      const double worst = least[{c.name, a.name}];
      const std::string energy = worst < 0.0 ? ex::format("%.0e", worst) : "0";
      line.emplace_back(a.name, covers(c, a) ? energy : "(" + energy + ")");
    }
    return line;
  });
}

std::vector<std::string> run_adversaries(const session& s) {
  struct job {
    const controller* c;
    attack a;
    int dof;
  };
  const auto list = attacks(s.chosen.seed);
  std::vector<job> jobs;
  for (const auto& [c, a] : with_each(s.judged, list)) {
    jobs.push_back({c, a, 1});
    if (c->in<d2>()) jobs.push_back({c, a, 2});
    if (c->in<d3>()) jobs.push_back({c, a, 3});
  }
  const auto rows = s.rows("adversaries.csv", "adversaries", jobs, [&s](const job& j) {
    return judge_under_attack(*j.c, j.a, j.dof, {s.chosen.runs, s.chosen.first()});
  });
  s.out.section("Adversaries",
                "Least true port energy [J] of " + std::to_string(s.chosen.runs) +
                    " runs in each of the 1, 2 and 3 dimensions that a controller is offered in; 0 "
                    "means that not one lost anything. In brackets: outside what the tag covers. A "
                    "covered cell below -1e-12 J fails the run; a conditional controller must lose "
                    "in some bracket, and so must one without a guarantee. adversaries.csv has "
                    "every dimension and the seed of each worst run. Quiet is not judged here, "
                    "because no adversary holds still: the walls above have it.");
  s.out.show(worst_of(s.judged, list, rows));
  s.out.member("adversaries", ex::json_of(rows));
  const auto found = contradictions(rows);
  s.out.member("contradictions", ex::json_of(found));
  return found;
}

}  // namespace controllers
