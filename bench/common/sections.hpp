// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A program in sections, which `--only LIST` selects by name.

#include "failures.hpp"
#include "options.hpp"

#include <iterator>

namespace experiments {

/// A section of a run. It adds its results to the report and returns a sentence for each broken promise.
template <class Session>
struct section {
  const char* name;
  failures (*run)(const Session&);
};

/// The settings of such a program, to which it may add its own.
struct section_settings {
  std::string out{};                ///< folder of the results
  std::vector<std::string> only{};  ///< sections; empty: all
  bool quick = false;
  int threads = 0;  ///< 0: as many as the machine has
};

/// The options of such a program, followed by `more`; `quick` says what --quick leaves out.
template <class Session>
[[nodiscard]] std::vector<option> section_options(const std::vector<section<Session>>& all,
                                                  section_settings& chosen,
                                                  const std::string& quick,
                                                  std::vector<option> more = {}) {
  const auto only = [&all, &chosen](const std::string& text) {
    std::string known;
    for (const auto& s : all) known += (known.empty() ? "" : ", ") + std::string(s.name);
    for (const auto& name : cells_of(text)) {
      const auto is = [&name](const section<Session>& s) { return name == s.name; };
      if (std::none_of(all.begin(), all.end(), is)) {
        complain("--only " + name + ": there are " + known);
      }
      chosen.only.push_back(name);
    }
    if (chosen.only.empty()) complain("--only: name some of " + known);
  };
  std::vector<option> options{
      a_switch("--quick", quick, chosen.quick),
      a_text("--out DIR", "where the results go (default: " + chosen.out + ")", chosen.out),
      {"--only LIST", "of the sections, with commas between (default: all)", only},
      a_number("--threads", "(default: as many as the machine has)", chosen.threads)};
  std::move(more.begin(), more.end(), std::back_inserter(options));
  return options;
}

/// Runs the selected sections and returns the sentences of all.
template <class Session>
[[nodiscard]] failures run_sections(const std::vector<section<Session>>& all,
                                    const std::vector<std::string>& only, const Session& s) {
  failures found;
  for (const auto& part : all) {
    if (!only.empty() && std::find(only.begin(), only.end(), part.name) == only.end()) continue;
    for (auto& sentence : part.run(s)) found.push_back(std::move(sentence));
  }
  return found;
}

}  // namespace experiments
