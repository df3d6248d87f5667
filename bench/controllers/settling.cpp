// SPDX-License-Identifier: BSD-3-Clause
#include "settling.hpp"

#include <passive_haptics/motion.hpp>

namespace controllers {

namespace {

namespace sim = passive_haptics::simulation;

/// Presses `force` more, from second 10 on, within half a second.
struct late_press {
  double force_limit = 0.0;  ///< [N]
  [[nodiscard]] double force(double t, double /*x*/, double /*v*/) const noexcept {
    return force_limit * std::min(1.0, std::max(0.0, (t - 10.0) / 0.5));
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault<double> check() const noexcept { return {}; }
};

/// The spring that is asked for: min(K, κ m/T²).
double displayed(const settling_case& c) {
  return ph::kernels::sampled_stiffness(c.stiffness, 0.1, c.mass, 1e-3);
}

template <class Observer, class Motion>
model<d1> composed(const settling_way& way, const settling_device& device, const settling_case& c,
                   double hand_force, const Observer& observer, const Motion& motion) {
  ph::damped_spring<d1> contact{.mass = c.mass};
  if (way.knows_saturation && std::isfinite(device.force_limit)) {
    contact.force_limit = device.force_limit;
  }
  return ph::local_model{d1{},
                         ph::following<ph::half_space<d1>>{},
                         ph::snap<d1>{},
                         contact,
                         observer,
                         ph::reachable_bound<d1>{.mass = c.mass, .hand_force = hand_force},
                         ph::loop_limits<d1>{},
                         motion};
}

model<d1> composed(const settling_way& way, const settling_device& device, const settling_case& c,
                   double hand_force) {
  const ph::reduced_energy<d1> plain{.damping = 0.03};
  const ph::quantised_energy<d1> sure{.damping = 0.03, .quantum = device.quantum};
  const ph::mass_observer<d1> observer{.mass = c.mass, .quantum = device.quantum};
  if (way.counts_surely) return composed(way, device, c, hand_force, sure, observer);
  if (way.observes_motion) return composed(way, device, c, hand_force, plain, observer);
  return composed(way, device, c, hand_force, plain, ph::last_difference<d1>{});
}

sim::device_parameters<d1> parameters(const settling_device& d, const settling_case& c) {
  return {.mass = c.mass,
          .damping = 0.03,
          .friction = d.friction,
          .force_limit = d.force_limit,
          .quantum = d.quantum,
          .lower = -0.061,
          .load = 9.81 * c.mass,
          .start = -0.061};
}

/// One more press after the fall, 2 mm deep and twenty times the dry friction at least: the slope
/// of the force held over the true depth, both means of a second.
double stiffness_error(const settling_way& way, const settling_device& d, const settling_case& c) {
  const double more = std::max(displayed(c) * 2e-3, 20.0 * d.friction);
  model<d1> wall = composed(way, d, c, 9.81 * c.mass + d.friction + more);
  const ph::environment::spring_wall springs({2 * c.stiffness, 2 * c.stiffness});
  sim::device<d1, late_press> device(parameters(d, c), {more});
  sim::update_schedule schedule(7);
  sim::one_update_late<double> late(0.0);
  double surface = 0.0;
  std::array<double, 2> force{}, depth{};  // before, after
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 14000; ++n) {
    if (schedule.due(device.time()) && (c.yields || n == 0)) {
      surface = c.yields ? late(springs.surface(std::abs(sample.held))) : 0.0;
      wall.retarget({surface, -1.0, c.stiffness});
    }
    sample = device.exchange(wall.tick(sample).force);
    const bool before = n >= 9000 && n < 10000;
    if (!before && n < 13000) continue;
    force[before ? 0 : 1] -= sample.held / 1000.0;
    depth[before ? 0 : 1] += (device.position() - surface) / 1000.0;
  }
  return (force[1] - force[0]) / (depth[1] - depth[0]) / displayed(c) - 1.0;
}

}  // namespace

std::vector<settling_way> settling_ways() {
  return {{.name = "damped spring, last difference"},
          {.name = "+ secant in saturation", .knows_saturation = true},
          {.name = "+ mass observer", .knows_saturation = true, .observes_motion = true},
          {.name = "+ quantised energy (recommended)",
           .knows_saturation = true,
           .observes_motion = true,
           .counts_surely = true}};
}

std::vector<settling_device> settling_devices() {
  std::vector<settling_device> all;
  for (const double friction : {0.0, 0.2}) {
    for (const double limit : {settling_device::sim_infinity, 9.0}) {
      for (const double quantum : {0.0, 10e-6, 30e-6, 60e-6}) {
        all.push_back({quantum, friction, limit});
      }
    }
  }
  return all;
}

std::vector<settling_case> settling_cases() {
  std::vector<settling_case> all;
  for (const bool yields : {false, true}) {
    for (const double mass : {0.05, 0.1, 0.15, 0.5}) {
      for (const double stiffness : {1e2, 1e3, 1e4, 1e5, 1e6, 1e9}) {
        all.push_back({mass, stiffness, yields});
      }
    }
  }
  return all;
}

settling_result judge_settling(const settling_way& way, const settling_device& device,
                               const settling_case& c) {
  const ex::wall_scene scene{.name = "settling",
                             .mass = c.mass,
                             .stiffness = c.stiffness,
                             .yields = c.yields,
                             .lags = c.yields,
                             .force_limit = device.force_limit,
                             .friction = device.friction,
                             .quantum = device.quantum};
  model<d1> wall = composed(way, device, c, 9.81 * c.mass + device.friction + 1.0);
  const ex::wall_result r = ex::drop(wall, scene, 7);
  settling_result result{r.last_swing, r.settle, r.port_energy, r.ledger};
  if (way.counts_surely && !std::isfinite(device.force_limit)) {
    result.stiffness_error = stiffness_error(way, device, c);
  }
  return result;
}

namespace {

/// What the 48 cases of one device and one composition come to.
struct settling_row {
  int unsettled = 0, long_cycles = 0;
  double longest = 0.0;  ///< cycle [m]
  double worst = 0.0;    ///< settle time of those that settle [s]
  double port_energy = 0.0, ledger = std::numeric_limits<double>::infinity();
  double stiffness_error = std::nan("");

  void add(const settling_result& r, const settling_device& d) {
    unsettled += r.settled() ? 0 : 1;
    long_cycles += d.quantum > 0.0 && r.swing > 10.0 * d.quantum ? 1 : 0;
    longest = std::max(longest, r.swing);
    if (r.settled()) worst = std::max(worst, r.settle);
    port_energy = std::min(port_energy, r.port_energy);
    ledger = std::min(ledger, r.ledger);
    stiffness_error = std::fmax(stiffness_error, std::abs(r.stiffness_error));
  }
};

std::string called(const settling_device& d) {
  return ex::format("%g µm", d.quantum * 1e6) + ex::format(", %g N", d.friction) +
         (std::isfinite(d.force_limit) ? ex::format(", %g N", d.force_limit) : ", none");
}

void judge_recommended(const settling_device& d, const settling_row& row,
                       std::vector<std::string>& found) {
  const auto failed = [&](const std::string& what) {
    found.push_back("settling, " + called(d) + ": " + what);
  };
  if (row.unsettled > 0) failed(std::to_string(row.unsettled) + " cases did not settle");
  if (row.long_cycles > 0) failed(std::to_string(row.long_cycles) + " cycles over 10 steps");
  if (!(row.port_energy >= -1e-12)) failed(ex::format("lost %g J", -row.port_energy));
  if (row.stiffness_error > 0.05) failed(ex::format("stiffness off by %.3g", row.stiffness_error));
}

}  // namespace

std::vector<std::string> run_settling(const session& s) {
  const auto ways = settling_ways();
  const auto devices = settling_devices();
  auto cases = settling_cases();
  if (s.chosen.quick) cases.resize(2);
  struct line {
    std::size_t way, device, which;
    settling_result result;
  };
  const auto lines = s.rows(
      "settling.csv",
      "composition,step m,friction N,force limit N,mass kg,stiffness N/m,yields,swing m,settle s,"
      "port energy J,ledger J,stiffness error",
      "settling", static_cast<int>(ways.size() * devices.size() * cases.size()),
      [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        const std::size_t which = at % cases.size(), device = at / cases.size() % devices.size();
        const std::size_t way = at / cases.size() / devices.size();
        return line{way, device, which, judge_settling(ways[way], devices[device], cases[which])};
      },
      [&](const line& l) {
        const auto& d = devices[l.device];
        const auto& c = cases[l.which];
        return csv_text(ways[l.way].name) + ',' + csv_number(d.quantum) + ',' +
               csv_number(d.friction) + ',' + csv_number(d.force_limit) + ',' + csv_number(c.mass) +
               ',' + csv_number(c.stiffness) + (c.yields ? ",yes," : ",no,") +
               csv_number(l.result.swing) + ',' + csv_number(l.result.settle) + ',' +
               csv_number(l.result.port_energy) + ',' + csv_number(l.result.ledger) + ',' +
               csv_number(l.result.stiffness_error);
      });

  std::vector<std::vector<settling_row>> rows(ways.size(),
                                              std::vector<settling_row>(devices.size()));
  for (const auto& l : lines) rows[l.way][l.device].add(l.result, devices[l.device]);

  std::vector<std::string> found, json;
  std::vector<std::string> heading{"step, friction, force limit"};
  for (const auto& way : ways) heading.push_back(way.name);
  ex::table all(heading);
  ex::table best({"step, friction, force limit", "not settled", "longest cycle", "worst settle s",
                  "least port energy J", "ledger at the end mJ", "stiffness error"});
  for (std::size_t d = 0; d < devices.size(); ++d) {
    std::vector<std::string> cells{called(devices[d])};
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const settling_row& row = rows[w][d];
      const double q = devices[d].quantum;
      const std::string cycle = q > 0.0 ? ex::format("%.1f steps", row.longest / q)
                                        : ex::format("%.3f mm", row.longest * 1e3);
      cells.push_back(std::to_string(row.unsettled) + " | " + cycle);
      json.push_back(ex::json_object({{"composition", ex::json_string(ways[w].name)},
                                      {"step_m", ex::json_number(q)},
                                      {"friction_N", ex::json_number(devices[d].friction)},
                                      {"force_limit_N", ex::json_number(devices[d].force_limit)},
                                      {"unsettled", std::to_string(row.unsettled)},
                                      {"longest_cycle_m", ex::json_number(row.longest)},
                                      {"worst_settle_s", ex::json_number(row.worst)},
                                      {"min_port_energy_J", ex::json_number(row.port_energy)},
                                      {"ledger_J", ex::json_number(row.ledger)},
                                      {"stiffness_error", ex::json_number(row.stiffness_error)}}));
      if (w + 1 < ways.size()) continue;
      best.add({called(devices[d]),
                std::to_string(row.unsettled) + " of " + std::to_string(cases.size()), cycle,
                ex::format("%.2f", row.worst), ex::format("%.3g", row.port_energy),
                ex::format("%.1f", row.ledger * 1e3), ex::format("%.3f", row.stiffness_error)});
      judge_recommended(devices[d], row, found);
    }
    all.add(cells);
  }
  s.out.section("Passive and settled, on encoders with steps",
                "Falls onto walls of 1e2 to 1e9 N/m with 0.05 to 0.5 kg: how many of the cases "
                "did not settle, and the longest cycle of the last 2 s. What is added from column "
                "to column, and what was tried beside it: docs/design/settling.md.");
  s.out.show(all);
  s.out.section(
      "The recommended composition",
      "Stiffness error: of the force held over the true depth, pressed at least 2 mm deeper, "
      "against min(K, κ m/T²); not measured where the motors saturate.");
  s.out.show(best);
  s.out.member("settling", ex::json_array(json));
  return found;
}

}  // namespace controllers
