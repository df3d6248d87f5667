// SPDX-License-Identifier: BSD-3-Clause
#include "compose.hpp"
#include "tables.hpp"

#include <optional>

namespace controllers {

namespace {

/// A composition and what of it is new against the line before: the baseline first, the recommended
/// one last.
struct settling_way {
  const char* name = "";
  bool knows_saturation = false;
  bool observes_motion = false;
  bool counts_surely = false;
  bool is_for_encoders = false;  ///< make_touch, where there is friction to credit
};
constexpr std::array ways{settling_way{"damped spring, last difference"},
                          settling_way{"+ secant in saturation", true},
                          settling_way{"+ mass observer", true, true},
                          settling_way{"+ quantised energy (recommended)", true, true, true},
                          settling_way{"encoder touch, where it rubs", true, true, true, true}};

/// A device, 48 cases each, and a wall; both as the scene of the fall.
std::vector<ex::wall_scene> devices() {
  std::vector<ex::wall_scene> all;
  for (const double friction : {0.0, 0.2}) {
    for (const double limit : {std::numeric_limits<double>::infinity(), 9.0}) {
      for (const double quantum : {0.0, 10e-6, 30e-6, 60e-6}) {
        all.push_back({.force_limit = limit, .friction = friction, .quantum = quantum});
      }
    }
  }
  return all;
}
std::vector<ex::wall_scene> cases_of(ex::wall_scene scene, const settings& chosen) {
  std::vector<ex::wall_scene> all;
  for (const bool yields : {false, true}) {
    for (const double mass : {0.05, 0.1, 0.15, 0.5}) {
      for (const double stiffness : {1e2, 1e3, 1e4, 1e5, 1e6, 1e9}) {
        ex::redrawn number(chosen.seed, all.size());
        scene.mass = number(mass, 0.05, 0.5);
        scene.stiffness = number(stiffness, 1e2, 1e9);
        scene.yields = scene.lags = yields;
        all.push_back(scene);
      }
    }
  }
  if (chosen.quick) all = {all[1], all[all.size() / 2], all[all.size() / 2 + 1]};
  return all;
}

struct settling_row {
  settling_way way{};
  ex::wall_scene where{};
  ex::wall_result fell{};
  double stiffness_error = std::nan("");  ///< of the displayed static stiffness; NaN: not measured
  [[nodiscard]] bool settled() const noexcept {
    return fell.last_swing < 0.5e-3 && fell.settle < 3.0;
  }
};

ex::record record_of(const settling_row& r) {
  return {{"composition", std::string(r.way.name)},
          {"step m", r.where.quantum},
          {"friction N", r.where.friction},
          {"force limit N", r.where.force_limit},
          {"mass kg", r.where.mass},
          {"stiffness N/m", r.where.stiffness},
          {"yields", r.where.yields},
          {"swing m", r.fell.last_swing},
          {"settle s", r.fell.settle},
          {"quiet s", r.fell.quiet},
          {"port energy J", r.fell.port_energy},
          {"ledger J", r.fell.ledger},
          {"stiffness error", r.stiffness_error}};
}

/// What is stated of a device to make_touch; nothing without friction, which it asks for.
std::optional<ph::encoder_device> on_encoders(const settling_way& way,
                                              const ex::wall_scene& scene) {
  if (!way.is_for_encoders || !(scene.friction > 0.0)) return {};
  return ph::encoder_device{.mass = scene.mass,
                            .damping = premises{}.damping,
                            .friction = scene.friction / 2.0,
                            .presliding = 0.0,
                            .quantum = scene.quantum,
                            .force_limit = std::min(scene.force_limit, 1e6),
                            .longest_tick = 1e-3};
}

model<d1> composed(const settling_way& way, const ex::wall_scene& scene, double hand_force) {
  const premises p{.mass = scene.mass, .hand_force = hand_force, .quantum = scene.quantum};
  ph::damped_spring law{.mass = p.mass};
  if (way.knows_saturation) law.force_limit = scene.force_limit;
  const ph::reachable_bound bound{.mass = p.mass, .hand_force = p.hand_force};
  const ph::quantised_energy sure{.damping = p.damping, .quantum = p.quantum};
  const ph::mass_observer observer{.mass = p.mass, .quantum = p.quantum};
  if (const auto grip = on_encoders(way, scene)) {
    return ph::make_touch<d1>(*grip, ph::known_hand{.force = hand_force});
  }
  if (way.counts_surely) return touch<d1>(p, parts{law, sure, bound, observer});
  if (way.observes_motion) return touch<d1>(p, parts{law, ledger(p), bound, observer});
  return touch<d1>(p, parts{law, ledger(p), bound});
}

/// Presses `most` more, from second 10 on, within half a second.
struct late_press {
  double most = 0.0;  ///< [N]
  [[nodiscard]] double force(double t, double /*x*/, double /*v*/) const noexcept {
    return most * std::min(1.0, std::max(0.0, (t - 10.0) / 0.5));
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

/// One more press after the fall, 2 mm deep and twenty times the dry friction at least: the slope
/// of the force held over the true depth, both means of a second, against min(K, κ m/T²).
double stiffness_error(const settling_way& way, const ex::wall_scene& scene, std::uint64_t seed) {
  double K = ph::kernels::sampled_stiffness(scene.stiffness, 0.1, scene.mass, 1e-3);
  if (const auto grip = on_encoders(way, scene)) {
    K = std::min(K, ph::design::stiffness_budget(*grip).stiffness);
  }
  const double more = std::max(K * 2e-3, 20.0 * scene.friction);
  model<d1> wall = composed(way, scene, 9.81 * scene.mass + scene.friction + more);
  sim::device<d1, late_press> device(ex::device_of(scene), {more});
  std::array<double, 2> force{}, depth{};  // before, after
  ex::run_on_wall(wall, device, scene, seed, 14000, [&](const auto& now, double surface) {
    const bool before = now.tick >= 9000 && now.tick < 10000;
    if (!before && now.tick < 13000) return;
    force[before ? 0 : 1] -= now.sample.held / 1000.0;
    depth[before ? 0 : 1] += (device.position() - surface) / 1000.0;
  });
  return (force[1] - force[0]) / (depth[1] - depth[0]) / K - 1.0;
}

settling_row judge_settling(const settling_row& job, std::uint64_t seed) {
  settling_row row = job;
  const double hand_force = 9.81 * row.where.mass + row.where.friction + 1.0;
  row.fell = ex::drop(composed(row.way, row.where, hand_force), row.where, seed);
  if (row.way.counts_surely && !std::isfinite(row.where.force_limit)) {
    row.stiffness_error = stiffness_error(row.way, row.where, seed);
  }
  return row;
}

/// What the 48 cases of one device and one composition come to.
struct settling_sum {
  settling_way way{};
  ex::wall_scene device{};
  int cases = 0, unsettled = 0, long_cycles = 0;
  ex::at_rest still{};          ///< of all cases, by the floor of their steps
  std::array<int, 5> missed{};  ///< cases that are not quiet, by bar
  double longest = 0.0;         ///< cycle [m]
  double worst = 0.0;           ///< settle time of those that settle [s]
  double port_energy = 0.0, ledger = std::numeric_limits<double>::infinity();
  double stiffness_error = std::nan("");

  void add(const settling_row& r) {
    ++cases;
    unsettled += r.settled() ? 0 : 1;
    long_cycles += device.quantum > 0.0 && r.fell.last_swing > 10.0 * device.quantum ? 1 : 0;
    longest = std::max(longest, r.fell.last_swing);
    still.add(r.fell.still);
    if (!std::isfinite(r.fell.quiet)) ++missed[static_cast<std::size_t>(r.fell.missed)];
    if (r.settled()) worst = std::max(worst, r.fell.settle);
    port_energy = std::min(port_energy, way.is_for_encoders ? r.fell.rubbed_energy  // is credited
                                                            : r.fell.port_energy);
    ledger = std::min(ledger, r.fell.ledger);
    stiffness_error = std::fmax(stiffness_error, std::abs(r.stiffness_error));
  }
  [[nodiscard]] std::string called() const {
    return ex::format("%g µm", device.quantum * 1e6) + ex::format(", %g N", device.friction) +
           (std::isfinite(device.force_limit) ? ex::format(", %g N", device.force_limit)
                                              : ", none");
  }
  [[nodiscard]] std::string cycle() const {
    return device.quantum > 0.0 ? ex::format("%.1f steps", longest / device.quantum)
                                : ex::format("%.3f mm", longest * 1e3);
  }
};

ex::record record_of(const settling_sum& r) {
  return ex::with_floor({{"composition", std::string(r.way.name)},
                         {"step m", r.device.quantum},
                         {"friction N", r.device.friction},
                         {"force limit N", r.device.force_limit},
                         {"unsettled", r.unsettled},
                         {"longest cycle m", r.longest},
                         {"worst settle s", r.worst},
                         {"miss q1", r.missed[1]},
                         {"miss q2", r.missed[2]},
                         {"miss q3", r.missed[3]},
                         {"min port energy J", r.port_energy},
                         {"ledger J", r.ledger},
                         {"stiffness error", r.stiffness_error}},
                        r.still);
}

/// The recommended compositions, for people.
ex::record recommended(const settling_sum& r) {
  if (!r.way.counts_surely) return {};
  return ex::with_floor(
      {{"composition", std::string(r.way.name)},
       {"step, friction, force limit", r.called()},
       {"not settled", std::to_string(r.unsettled) + " of " + std::to_string(r.cases)},
       {"longest cycle", r.cycle()},
       {"worst settle s", r.worst, "%.2f"},
       {"least port energy J", r.port_energy},
       {"ledger at the end mJ", r.ledger * 1e3, "%.1f"},
       {"stiffness error", r.stiffness_error, "%.3f"}},
      r.still);
}

/// What it failed to do.
std::vector<std::string> failures(const settling_sum& r) {
  std::vector<std::string> found;
  const auto failed = [&](const std::string& what) {
    found.push_back("settling, " + std::string(r.way.name) + ", " + r.called() + ": " + what);
  };
  if (r.unsettled > 0) failed(std::to_string(r.unsettled) + " cases did not settle");
  if (r.long_cycles > 0) failed(std::to_string(r.long_cycles) + " cycles over 10 steps");
  if (!(r.port_energy >= -1e-12)) failed(ex::format("lost %g J", -r.port_energy));
  if (r.stiffness_error > 0.05) failed(ex::format("stiffness off by %.3g", r.stiffness_error));
  return found;
}

}  // namespace

std::vector<std::string> run_settling(const session& s) {
  std::vector<settling_row> jobs;
  std::vector<settling_sum> sums;
  for (const auto& way : ways) {
    for (const auto& device : devices()) {
      sums.push_back({way, device});
      for (const auto& where : cases_of(device, s.chosen)) jobs.push_back({way, where});
    }
  }
  const auto rows = s.rows("settling.csv", "settling", jobs, [&s](const settling_row& job) {
    return judge_settling(job, 6 + s.chosen.first());
  });
  const std::size_t each = rows.size() / sums.size();
  for (std::size_t i = 0; i < rows.size(); ++i) sums[i / each].add(rows[i]);

  std::vector<std::string> heading{"step, friction, force limit"}, found;
  for (const auto& way : ways) heading.emplace_back(way.name);
  ex::table all(heading);
  const std::size_t lines = sums.size() / ways.size();
  for (std::size_t d = 0; d < lines; ++d) {
    std::vector<std::string> cells{sums[d].called()};
    for (std::size_t i = d; i < sums.size(); i += lines) {
      cells.push_back(std::to_string(sums[i].unsettled) + " | " + sums[i].cycle());
    }
    all.add(cells);
    for (std::size_t i = d; i < sums.size(); i += lines) {
      if (!sums[i].way.counts_surely) continue;
      for (auto& sentence : failures(sums[i])) found.push_back(sentence);
    }
  }
  s.out.section("Passive and settled, on encoders with steps",
                "Falls onto walls of 1e2 to 1e9 N/m with 0.05 to 0.5 kg: how many of the cases "
                "did not settle, and the longest cycle of the last 2 s. What is added from column "
                "to column, and what was tried beside it: docs/design/settling.md.");
  s.out.show(all);
  s.out.section(
      "The recommended compositions",
      "Stiffness error: of the force held over the true depth, pressed at least 2 mm deeper, "
      "against min(K, κ m/T², the budget); not measured where the motors saturate." +
          std::string(ex::quiet_columns) + ex::quiet_on_steps + ex::held_last_second);
  s.out.show(ex::table_of(sums, recommended));
  s.out.member("settling", ex::json_of(sums));
  return found;
}

}  // namespace controllers
