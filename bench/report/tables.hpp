// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts of the report, as tables, CSV, JSON and plots.

#include "../common/failures.hpp"
#include "../common/record.hpp"
#include "../common/report.hpp"
#include "arithmetic.hpp"
#include "touch.hpp"

#include <functional>
#include <map>
#include <string>

namespace experiments {

struct settings {
  std::string out = "report";
  std::string program;  ///< this program's own path, to be counted by callgrind
  long ticks = 0;       ///< of the arithmetic comparison
  bool quick = false;   ///< fewer ticks, rates and compositions; no counts
  bool counts = true;   ///< instructions by callgrind
};

/// What one candidate costs, measured now.
struct measured_cost {
  tick_time time;
  double instructions = std::nan("");
};
/// Of all: times one after the other, for each has the machine to itself; then counts on all cores.
std::vector<measured_cost> measure(const std::string& what, const std::vector<candidate>& all,
                                   const settings& chosen);
/// Instructions a tick, on all cores; NaN if they are not asked for.
std::vector<double> instructions_of(const std::string& what, const std::vector<std::string>& names,
                                    const settings& chosen);

/// One point of a work-precision plot.
struct figure {
  std::string part, configuration, variant;
  double error = 0, ns = 0;  ///< ns: of a tick and what comes with it
  measured_cost cost;        ///< of the tick alone
  std::size_t bytes = 0;
};

/// All points: error_vs_runtime.csv, and for each part the front that no point beats.
class figures {
 public:
  explicit figures(const report& out);
  void add(const figure& f);
  void write_front(const report& out, const std::string& part) const;
  /// Run time [ns] and error of a part.
  [[nodiscard]] const std::vector<std::pair<double, double>>& points(
      const std::string& part) const {
    return points_.at(part);
  }
  void close() { csv_.close(); }

 private:
  csv_file csv_;
  std::map<std::string, std::vector<std::pair<double, double>>> points_;
};

/// Each says what is broken: an error far beyond what rounding can do; what is no number.
failures report_arithmetic(report& out, const settings& chosen, figures& all);
failures report_models(report& out, const settings& chosen, figures& figured);
/// The scenes that are also written by hand.
void report_by_hand(report& out, const settings& chosen);
[[nodiscard]] std::vector<candidate> by_hand_candidates();

}  // namespace experiments
