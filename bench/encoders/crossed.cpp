// SPDX-License-Identifier: BSD-3-Clause
// Steps that are known better where they are crossed: the largest stiffness that lasts being kneaded for 40 s, and what
// a tremor that pushes leaves of the budget, with today's ledger and estimator, the other ledger, and both others; and
// what make_touch makes of them.
#include "program.hpp"
#include <passive_haptics/identification/crossed_budget.hpp>
#include <passive_haptics/identification/crossed_compositions.hpp>

namespace encoders {

namespace {

enum class composed : std::uint8_t {
  dual_and_edge,
  crossed_and_edge,
  crossed_and_middle,
  door,  ///< make_touch, told of known_crossings
};
constexpr std::array all_composed{composed::dual_and_edge, composed::crossed_and_edge,
                                  composed::crossed_and_middle, composed::door};

/// make_touch as it is, told of known_crossings or not; its stiffness [N/m] is `most`.
struct doorway {
  wall model;
  double most = 0.0;
};
doorway through_the_door(const machine& m, bool told, double fixed_cap = 0.0) {
  const ph::encoder_device d = m.stated();
  const ph::known_hand hand{.force = hand_force + m.preset.friction};
  const auto opened = [&](auto touch) -> doorway {
    if (fixed_cap > 0.0) {
      const ph::damped_spring law{.mass = d.mass, .force_limit = d.force_limit};
      if (touch.set(ph::capped{ph::eased{law}, fixed_cap})) std::abort();
    }
    (void)touch.update({0.0, -1.0, 1e9});
    const double most = touch.law().parameters().most;
    return {touch, most};
  };
  if (!told) return opened(ph::make_touch<line>(d, hand));
  return opened(ph::make_touch<line>(d, ph::known_crossings{}, hand));
}

/// A wall with a fixed cap K [N/m].
wall made(const machine& m, composed what, double K) {
  if (what == composed::door) return through_the_door(m, true, K).model;
  const auto d = m.stated();
  const double hand = hand_force + m.preset.friction;
  const auto composed_of = [&](const auto& ledger, const auto& observer) -> wall {
    return ph::local_model{
        line{},
        ph::followed<ph::half_space<line>>{},
        ph::turn_at_once{},
        ph::capped{ph::eased{ph::damped_spring{.mass = d.mass, .force_limit = d.force_limit}}, K},
        ledger,
        ph::bound_chain{ph::reachable_bound{.mass = d.mass, .hand_force = hand},
                        ph::actuator_limit{.most = d.force_limit}},
        ph::loop_limits{.longest_tick = d.longest_tick},
        observer};
  };
  const ph::damping_and_friction damping{d.damping, d.friction, d.presliding};
  const ph::crossed_ledger crossed{
      .damping = damping, .quantum = {.quantum = d.quantum, .mass = d.mass, .hand_force = hand}};
  const double rests = d.friction > m.budget().stiffness * d.presliding ? d.presliding : 0.0;
  const ph::edge_observer edge{.quantum = d.quantum, .presliding = rests};
  if (what == composed::dual_and_edge) {
    return composed_of(ph::dual_ledger{.damping = damping, .quantum = d.quantum}, edge);
  }
  if (what == composed::crossed_and_edge) return composed_of(crossed, edge);
  return composed_of(crossed, ph::middle_observer{.quantum = d.quantum});
}

struct crossed_row {
  machine m{};
  int seconds = 40;
  std::array<double, 4> kneaded{};                   ///< the largest K that lasts, over the budget
  std::array<double, 4> tremor{1.0, 1.0, 1.0, 1.0};  ///< least share of the budget in any second
  std::array<double, 2> most{};  ///< make_touch's own stiffness, without and with them [N/m]
  std::array<double, 2> own_kneaded{1.0, 1.0};  ///< and its least share in any second
  std::array<double, 2> own_tremor{1.0, 1.0};
  int outside = 0;            ///< events that say that the motion refutes what was stated
  double least_energy = 0.0;  ///< [J]
};

ex::record record_of(const crossed_row& r) {
  const auto d = r.m.stated();
  return {{"device", std::string(r.m.preset.name)},
          {"presliding_um", r.m.presliding * 1e6, "%.0f"},
          {"rho", design::crossing_of(d).rho, "%.2f"},
          {"budget", r.m.budget().stiffness, "%.0f"},
          {"crossed_budget", design::crossed_budget(d).stiffness, "%.0f"},
          {"kneaded_dual_edge", r.kneaded[0], "%.2f"},
          {"kneaded_crossed_edge", r.kneaded[1], "%.2f"},
          {"kneaded_crossed_middle", r.kneaded[2], "%.2f"},
          {"tremor_dual_edge", r.tremor[0], "%.2f"},
          {"tremor_crossed_edge", r.tremor[1], "%.2f"},
          {"tremor_crossed_middle", r.tremor[2], "%.2f"},
          {"kneaded_door", r.kneaded[3], "%.2f"},
          {"tremor_door", r.tremor[3], "%.2f"},
          {"touch", r.most[0], "%.0f"},
          {"touch_kneaded", r.own_kneaded[0], "%.2f"},
          {"touch_tremor", r.own_tremor[0], "%.2f"},
          {"touch_crossed", r.most[1], "%.0f"},
          {"touch_crossed_kneaded", r.own_kneaded[1], "%.2f"},
          {"touch_crossed_tremor", r.own_tremor[1], "%.2f"},
          {"false_alarms", r.outside},
          {"least_energy_J", r.least_energy}};
}

crossed_row judge(crossed_row row) {
  const double budget = row.m.budget().stiffness;
  const auto of_all = [&row](const wall& model, doing how, double K, double enough) {
    double share = 1.0;
    for (const auto& fingers : hands) {
      for (const double offset : offsets) {
        const felt run = press(row.m, model, how, K, row.seconds, fingers, offset);
        share = std::min(share, run.least);
        row.least_energy = std::min(row.least_energy, run.least_energy);
        row.outside += run.outside;
        if (share < enough) return share;
      }
    }
    return share;
  };
  const auto least = [&](composed what, doing how, double K) {
    return of_all(made(row.m, what, K), how, K, how == doing::kneading ? 0.8 : 0.0);
  };
  for (std::size_t told = 0; told < 2; ++told) {
    const doorway door = through_the_door(row.m, told == 1);
    row.most[told] = door.most;
    row.own_kneaded[told] = of_all(door.model, doing::kneading, door.most, 0.0);
    row.own_tremor[told] = of_all(door.model, doing::tremor, door.most, 0.0);
  }
  for (std::size_t i = 0; i < all_composed.size(); ++i) {
    row.tremor[i] = least(all_composed[i], doing::tremor, budget);
    for (double over = 0.79; over < 4.2; over *= 1.06) {
      if (least(all_composed[i], doing::kneading, over * budget) < 0.8) break;
      row.kneaded[i] = over;
    }
  }
  return row;
}

std::vector<crossed_row> cells(const session& s) {
  std::vector<crossed_row> all;
  for (const auto& preset : sim::all_presets) {
    if (!(preset.friction > 0.0) || (s.chosen.quick && !is_quick(preset))) continue;
    for (const double presliding : {0.0, 5e-6, 15e-6, 30e-6}) {
      if (presliding > 0.0 && s.chosen.quick) continue;
      all.push_back({{preset, presliding}, s.chosen.quick ? 5 : 40});
    }
  }
  return all;
}

}  // namespace

std::vector<std::string> run_crossed(const session& s) {
  const auto rows = s.rows("crossed.csv", "crossed", cells(s), judge);
  std::vector<std::string> found;
  for (const auto& r : rows) {
    if (r.outside > 0) {
      found.push_back(std::string("crossed steps, ") + r.m.preset.name + ": false alarms");
    }
    if (r.least_energy >= -1e-12) continue;
    found.push_back(std::string("crossed steps, ") + r.m.preset.name +
                    ex::format(", presliding %g µm: ", r.m.presliding * 1e6) +
                    ex::format("lost %.3g J", -r.least_energy));
  }
  s.out.section(
      "Steps that are crossed",
      "The largest stiffness, over the budget, that is felt to 0.8 in every second of 40 "
      "s of kneading, by six runs (three hands, two offsets), in steps of 6 %; and the "
      "least share of the budget's stiffness in any second of a tremor as a force. The "
      "cap is fixed. Then the same through make_touch, told of known_crossings; and, at the "
      "stiffness that make_touch itself chooses, without and with them, the least share "
      "of it under both, its cap following the ledger.");
  s.out.show(ex::table_of(rows, record_of));
  return found;
}

}  // namespace encoders
