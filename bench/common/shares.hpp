// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What share of many scenes has a figure of at most x, as a curve for each list of them, beside a bar.

#include "report.hpp"

namespace experiments {

/// Figures of scenes of one kind, NaN where a scene has none.
struct figures {
  std::string name;  ///< of the curve; without its commas, which end a cell
  std::vector<double> of{};
};

/// Writes quantiles, a column for each list, and returns the commands that draw them: less than `left` is `left`.
[[nodiscard]] inline std::string shares(const report& out, const std::string& file,
                                        std::vector<figures> lists, double bar, double left) {
  std::string heading = "share";
  for (auto& [name, of] : lists) {
    std::erase(name, ',');
    heading += "," + name;
    for (double& x : of) x = std::isnan(x) ? std::numeric_limits<double>::infinity() : x;
    std::sort(of.begin(), of.end());
  }
  csv_file csv(out.path(file), heading);
  for (std::size_t i = 1; i <= 200; ++i) {
    std::string line = format("%g", static_cast<double>(i) / 200.0);
    for (const auto& [name, of] : lists) {
      const std::size_t n = (i * of.size() + 199) / 200;  // so many are at most that
      line += "," + (n > 0 ? format("%.7g", of[n - 1]) : "-");
    }
    csv.line(line);
  }
  csv.close();
  const std::string at = format("%g", bar), least = format("%g", left);
  return "set ylabel 'share of the scenes'\nset yrange [0:1]\nset arrow from " + at +
         ", graph 0 to " + at +
         ", graph 1 nohead dt 3 lw 1.5\nplot for [c=2:" + std::to_string(lists.size() + 1) + "] '" +
         file + "' using (column(c) > " + least + " ? column(c) : " + least +
         "):1 with lines title columnheader(c)";
}

}  // namespace experiments
