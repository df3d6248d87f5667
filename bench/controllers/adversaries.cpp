// SPDX-License-Identifier: BSD-3-Clause
#include "adversaries.hpp"

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
attack_row judge_in(const controller& c, const attack& a, int runs) {
  sim::circumstances world = a.world;
  if (c.credits_friction) world.friction = 0.3;
  world.latency = std::max(world.latency, c.covers.latency);
  const premises known{.mass = world.mass,
                       .damping = world.damping,
                       .friction = world.friction,
                       .hand_force = world.hand_force + world.friction,
                       .quantum = world.quantum,
                       .longest_tick = world.longest_tick,
                       .latency = world.latency};
  const auto v = sim::challenge(c.maker<Space>()(known), a.by, world, runs);
  return {c.name,       c.tag,          a.name,          Space::dof,  runs,
          covers(c, a), v.least_energy, v.largest_force, v.worst_seed};
}

std::string cell_text(const attack_row& worst) {
  const std::string energy =
      worst.least_energy < 0.0 ? ex::format("%.0e", worst.least_energy) : "0";
  return worst.covered ? energy : "(" + energy + ")";
}

}  // namespace

std::vector<attack> attacks() {
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
  return list;
}

bool covers(const controller& c, const attack& a) noexcept {
  if (c.tag == ph::guarantee::none) return false;
  if (!c.covers.any_motion && !sim::is_force_limited(a.by)) return false;
  if (!c.covers.any_clock && unsteady(a.by)) return false;
  if (!c.covers.rounding && a.world.quantum > 0.0) return false;
  return a.world.latency <= c.covers.latency && a.world.stiffest <= c.covers.stiffest;
}

attack_row judge_under_attack(const controller& c, const attack& a, int dof, int runs) {
  switch (dof) {
    case 1:
      return judge_in<d1>(c, a, runs);
    case 2:
      return judge_in<d2>(c, a, runs);
    default:
      return judge_in<d3>(c, a, runs);
  }
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

std::vector<std::string> run_adversaries(const session& s) {
  const auto list = attacks();
  struct job {
    const controller* c;
    const attack* a;
    int dof;
  };
  std::vector<job> jobs;
  for (const auto& c : s.judged) {
    for (const auto& a : list) {
      jobs.push_back({&c, &a, 1});
      if (c.in_2) jobs.push_back({&c, &a, 2});
      if (c.in_3) jobs.push_back({&c, &a, 3});
    }
  }
  const auto rows = s.rows(
      "adversaries.csv",
      "controller,tag,attack,dof,runs,covered,least port energy J,largest force N,worst seed",
      "adversaries", static_cast<int>(jobs.size()),
      [&](int i) {
        const job& j = jobs[static_cast<std::size_t>(i)];
        return judge_under_attack(*j.c, *j.a, j.dof, s.chosen.runs);
      },
      [](const attack_row& r) {
        return csv_text(r.controller) + ',' + to_string(r.tag) + ',' + csv_text(r.attack) + ',' +
               std::to_string(r.dof) + ',' + std::to_string(r.runs) + ',' +
               (r.covered ? "yes" : "no") + ',' + csv_number(r.least_energy) + ',' +
               csv_number(r.largest_force) + ',' + std::to_string(r.worst_seed);
      });

  std::vector<std::string> heading{"controller", "tag"};
  for (const auto& a : list) heading.push_back(a.name);
  ex::table shown(heading);
  std::vector<std::string> json;
  std::size_t next = 0;
  for (const auto& c : s.judged) {
    std::vector<std::string> line{c.name, to_string(c.tag)};
    for (const auto& a : list) {
      attack_row worst;
      worst.covered = covers(c, a);
      for (; next < rows.size() && rows[next].controller == c.name && rows[next].attack == a.name;
           ++next) {
        const auto& r = rows[next];
        if (!(r.least_energy >= worst.least_energy)) worst.least_energy = r.least_energy;
        json.push_back(ex::json_object({{"controller", ex::json_string(r.controller)},
                                        {"tag", ex::json_string(to_string(r.tag))},
                                        {"attack", ex::json_string(r.attack)},
                                        {"dof", std::to_string(r.dof)},
                                        {"runs", std::to_string(r.runs)},
                                        {"covered", r.covered ? "true" : "false"},
                                        {"least_port_energy_J", ex::json_number(r.least_energy)},
                                        {"worst_seed", std::to_string(r.worst_seed)}}));
      }
      line.push_back(cell_text(worst));
    }
    shown.add(line);
  }
  s.out.section("Adversaries",
                "Least true port energy [J] of " + std::to_string(s.chosen.runs) +
                    " runs in each of the 1, 2 and 3 dimensions that a controller is offered in; 0 "
                    "means that not one lost anything. In brackets: outside what the tag covers. A "
                    "covered cell below -1e-12 J fails the run; a conditional controller must lose "
                    "in some bracket, and so must one without a guarantee. adversaries.csv has "
                    "every dimension and the seed of each worst run.");
  s.out.show(shown);
  s.out.member("adversaries", ex::json_array(json));
  const auto found = contradictions(rows);
  std::vector<std::string> quoted;
  for (const auto& sentence : found) quoted.push_back(ex::json_string(sentence));
  s.out.member("contradictions", ex::json_array(quoted));
  return found;
}

}  // namespace controllers
