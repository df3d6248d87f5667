// SPDX-License-Identifier: BSD-3-Clause
#include "../common/record.hpp"
#include "wall.hpp"

namespace experiments {

void run_sweep(report& out) {
  struct kind {
    std::string name;
    bool yields, lags;
  };
  const std::vector<kind> kinds{{"static wall (S0)", false, false},
                                {"yielding, one update late (S1)", true, true},
                                {"yielding (S1)", true, false}};
  const std::vector<double> masses{0.05, 0.1, 0.15, 0.5};
  const std::vector<double> stiffnesses{1e2, 1e3, 1e4, 1e5, 1e6, 1e9};
  progress bar("sweep", static_cast<int>(kinds.size() * masses.size() * stiffnesses.size()));
  csv_file csv(out.path("sweep.csv"),
               "kind,mass kg,stiffness N/m,last swing mm,settle s,quiet s,min port energy J");
  table rows({"settle s", "K = 1e2", "1e3", "1e4", "1e5", "1e6", "1e9 N/m"});
  int settled = 0, settled_of_48 = 0, cases = 0;
  double worst = 0.0, least = 0.0;
  at_rest still;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    for (const double mass : masses) {
      std::vector<std::string> row{kinds[k].name + ", " + format("%g kg", mass)};
      for (const double stiffness : stiffnesses) {
        const wall_scene scene{.name = "sweep",
                               .mass = mass,
                               .stiffness = stiffness,
                               .yields = kinds[k].yields,
                               .lags = kinds[k].lags};
        const wall_result r = drop(settling_model(mass), scene, 7);
        const bool good = r.last_swing < 0.5e-3 && r.settle < 3.0;
        ++cases;
        settled += good ? 1 : 0;
        settled_of_48 += good && k < 2 ? 1 : 0;
        worst = std::max(worst, good ? r.settle : 10.0);
        least = std::min(least, r.port_energy);
        still.add(r.still);
        row.push_back(good ? format("%.2f", r.settle) : "NOT SETTLED");
        csv.row(static_cast<double>(k), mass, stiffness, r.last_swing * 1e3, r.settle, r.quiet,
                r.port_energy);
        bar.step();
      }
      rows.add(row);
    }
  }
  csv.close();
  out.section("Passive and settled, over decades",
              "Damped spring + reachable bound on an ideal device: no friction, no hand, exact "
              "positions. Settled: the last 2 s calmer than 0.5 mm, before 3 s. Settled " +
                  std::to_string(settled) + " of " + std::to_string(cases) + ", " +
                  std::to_string(settled_of_48) + " of the 48 of § 9; worst " +
                  format("%.2f", worst) + " s; least true port energy " + format("%.3g", least) +
                  " J. In one row below, all of them." + quiet_columns);
  out.show(rows);
  out.show(table_of(std::vector<record>{still.columns()}));
  std::cout << "settled " << settled << " of " << cases << " (" << settled_of_48
            << " of the 48 of section 9), worst " << format("%.2f", worst)
            << " s, least port energy " << format("%.3g", least) << " J\n\n";
  out.member("sweep", json_of(with({{"cases", cases},
                                    {"settled", settled},
                                    {"settled of 48", settled_of_48},
                                    {"worst settle s", worst},
                                    {"min port energy J", least}},
                                   still)));
}

}  // namespace experiments
