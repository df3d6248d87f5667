// SPDX-License-Identifier: BSD-3-Clause
#include "remote.hpp"

#include "remote_scenes.hpp"

namespace organ {

namespace ex = experiments;

namespace {

struct remote_row {
  std::string network{}, crosses{};
  double created = 0.0;  ///< the most of all runs [J]
  double force = 0.0;    ///< on a wall at rest, mean [N]
  double error = 0.0;    ///< on one that heaves, mean [N]
  double worst = 0.0;    ///< [N]
  double age = 0.0;      ///< of what arrives, by the client's clock, mean [ms]
  ex::at_rest still{};   ///< on the wall at rest
};
ex::record record_of(const remote_row& r) {
  return ex::with({{"network", r.network},
                   {"crosses", r.crosses},
                   {"created_J", r.created, "%.2g"},
                   {"force_N", r.force, "%.2f"},
                   {"error_N", r.error, "%.2f"},
                   {"worst_N", r.worst, "%.2f"},
                   {"age_ms", r.age, "%.1f"}},
                  r.still);
}

constexpr int runs = 5;
constexpr double heave = 3e-3;  // [m]

template <class Run>
remote_row judge(const far_wall::network& over, const std::string& crosses, Run run) {
  remote_row row{.network = over.name, .crosses = crosses};
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const far_wall::outcome still = run(over.way, far_wall::heaving_wall{0.0}, seed);
    const far_wall::outcome heaving = run(over.way, far_wall::heaving_wall{heave}, seed);
    row.created = std::max({row.created, still.created, heaving.created});
    row.force += still.force / runs;
    row.error += heaving.error / runs;
    row.worst = std::max(row.worst, heaving.worst);
    row.age += 1e3 * still.age / runs;
    row.still.add(still.still);
  }
  return row;
}

}  // namespace

void add_remote(ex::report& out, std::vector<std::string>& found) {
  std::vector<remote_row> rows;
  const auto expect = [&found](bool holds, const remote_row& r, const std::string& sentence) {
    if (!holds) found.push_back(r.network + ", " + r.crosses + ": " + sentence);
  };
  for (const auto& over : far_wall::networks) {
    rows.push_back(judge(over, "surface", [](const auto& way, const auto& wall, auto seed) {
      return far_wall::surface_at_hand(way, wall, seed);
    }));
    expect(rows.back().created <= 1e-12, rows.back(), "the local model has created energy");
    expect(std::abs(rows.back().force - 8.0) < 0.01, rows.back(), "the wall is not 8 N");
    expect(rows.back().still.all_quiet(), rows.back(), "the wall at rest is not quiet");
    rows.push_back(
        judge(over, "port, both ends count", [](const auto& way, const auto& wall, auto seed) {
          return far_wall::both_ends_count(way, wall, seed);
        }));
    expect(rows.back().created <= 1e-3 + 1e-12, rows.back(), "more is created than was lent");
    rows.push_back(judge(over, "bare force", [](const auto& way, const auto& wall, auto seed) {
      return far_wall::bare_force(way, wall, seed);
    }));
    expect(rows.back().created > 1.0, rows.back(), "the control has created nothing");
  }
  out.section(
      "Another machine",
      "A wall of 2 kN/m across four networks (delay + jitter each way, loss), in virtual time: "
      "hand of "
      "500 N/m and 12 N that aims 20 mm inside, motors of 20 N, " +
          std::to_string(runs) +
          " runs of 6 s. Created: by the hand's port, where both ends count by both, which were "
          "lent 1 mJ. Force: on the wall at rest, 8 N where it is felt as it is. Error: against "
          "the wall as it is now where the hand is now, while it heaves by 3 mm at 7 rad/s." +
          ex::quiet_columns + ex::held_last_second +
          " Of the wall at rest, from when the hand aims at it.");
  ex::publish(out, "remote", rows);
}

}  // namespace organ
