// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Works through a list of jobs on all cores; the results are rows of a CSV file.

#include "failures.hpp"
#include "options.hpp"
#include "record.hpp"
#include "report.hpp"
#include "work.hpp"

#include <type_traits>

namespace experiments {

/// Finishes the report of a program, prints where it is and then what has failed, captions that are not so among
/// it; returns the exit code.
[[nodiscard]] inline int conclude(report& out, const std::string& program, const std::string& title,
                                  const std::string& lead, failures found) {
  found.insert(found.end(), out.untrue().begin(), out.untrue().end());
  out.member("failures", json_of(found));
  if (!out.finish(title, lead)) {
    std::cout << "gnuplot did not draw every plot: is it installed? The rest is complete.\n";
  }
  std::cout << "results: " << out.results() << '\n';
  return ended(program, found);
}

/// Writes rows that have a record_of() as a CSV file.
template <class Row>
void write_csv(const report& out, const std::string& file, const std::vector<Row>& rows,
               const char* pattern = exactly) {
  csv_file csv(out.path(file), csv_heading(record_of(Row{})));
  for (const auto& row : rows) csv.line(csv_line(record_of(row), pattern));
  csv.close();
}

/// Adds rows as a table for people, and under `member` to the JSON file.
template <class Row>
void show_rows(report& out, const std::string& member, const std::vector<Row>& rows) {
  out.show(table_of(rows));
  out.member(member, json_of(rows));
}

/// The same, and as a CSV file of that name.
template <class Row>
void publish(report& out, const std::string& member, const std::vector<Row>& rows) {
  write_csv(out, member + ".csv", rows);
  show_rows(out, member, rows);
}

/// The threads that work, the report that takes the results, and the flag that stops the work.
struct workshop {
  report& out;
  int threads;
  const std::atomic<bool>& stop;

  /// judge(job) gives a row, or several in a vector; record_of(row) is its line, on disk as soon as it
  /// and all before it are finished. Returns all rows, in order; throws `interrupted` if stopped.
  template <class Job, class Judge>
  auto rows(const std::string& file, const std::string& what, const std::vector<Job>& jobs,
            Judge judge, const char* pattern = exactly) const {
    const auto some = [&](int i) {
      auto found = judge(jobs[static_cast<std::size_t>(i)]);
      if constexpr (requires { found.front(); }) {
        return found;
      } else {
        return std::vector<decltype(found)>{std::move(found)};
      }
    };
    using some_rows = decltype(some(0));
    some_rows all;
    const int count = static_cast<int>(jobs.size());
    csv_file csv(out.path(file), csv_heading(record_of(typename some_rows::value_type{})));
    progress bar(what, count);
    const int done = work_through(count, threads, stop, some, [&](int, some_rows found) {
      for (auto& row : found) {
        csv.line(csv_line(record_of(row), pattern));
        all.push_back(std::move(row));
      }
      bar.step();
    });
    csv.close();
    if (done < count) {
      throw interrupted("stopped: " + out.path(file).string() + " has " + std::to_string(done) +
                        " of " + std::to_string(count) + " " + what +
                        " rows, all of them whole; the files of earlier sections are complete, "
                        "there is no report");
    }
    return all;
  }
};

}  // namespace experiments
