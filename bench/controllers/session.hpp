// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What every part of a run shares: the choices made on the command line, the report, the stop.

#include "../common/report.hpp"
#include "../common/work.hpp"
#include "catalogue.hpp"

#include <optional>

namespace controllers {

namespace ex = experiments;

/// The i-th of n parts of a list, counted from 1.
struct shard {
  int part = 1;
  int of = 1;
  [[nodiscard]] bool has(int i) const noexcept { return i % of == part - 1; }
};

struct settings {
  std::string out = "controllers";
  std::vector<std::string> only;   ///< sections; empty: all
  std::vector<std::string> merge;  ///< parts of z_width to join instead of running
  shard part{};
  bool quick = false;
  int seeds = 0;    ///< schedules per scene; 0: 10, quick 3
  int runs = 0;     ///< per adversary and dimension; 0: 1000, quick 60
  int threads = 0;  ///< 0: as many as the machine has
};

/// A section was stopped before its end; what() says what is on disk.
struct interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct session {
  ex::report& out;
  const settings& chosen;
  const std::atomic<bool>& stop;
  const std::vector<controller>& judged;

  /// Works through a list whose results are lines of a CSV file, in order, each on disk as soon as it
  /// and all before it are finished. cell(i) gives a row, text(row) its line.
  template <class Cell, class Text>
  auto rows(const std::string& file, const std::string& heading, const std::string& what, int count,
            Cell cell, Text text) const {
    std::vector<decltype(cell(0))> all;
    ex::csv_file csv(out.path(file), heading);
    ex::progress bar(what, count);
    const int done =
        experiments::work_through(count, chosen.threads, stop, cell, [&](int, auto row) {
          csv.line(text(row));
          all.push_back(std::move(row));
          bar.step();
        });
    csv.close();
    if (done < count) {
      throw interrupted("stopped: " + out.path(file).string() + " has " + std::to_string(done) +
                        " of " + std::to_string(count) + " " + what + " rows, all of them whole");
    }
    return all;
  }
};

/// A cell of a CSV file: quoted, because names hold commas.
inline std::string csv_text(const std::string& text) {
  return '"' + text + '"';
}
/// Enough digits to read the number back; empty for none.
inline std::string csv_number(double x) {
  return std::isfinite(x) ? ex::format("%.17g", x) : std::string();
}

}  // namespace controllers
