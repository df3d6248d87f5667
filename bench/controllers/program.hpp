// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program without main(), so that a test can run and stop it; and the declarations that its sections share.

#include "../common/rows.hpp"
#include "../common/sections.hpp"
#include "catalogue.hpp"

namespace controllers {

namespace ex = experiments;

/// The i-th of n parts of a list, counted from 1.
struct shard {
  int part = 1;
  int of = 1;
};

struct settings : ex::section_settings {
  std::vector<std::string> merge{};  ///< parts of z_width to join instead of running
  shard part{};
  int seeds = 0;  ///< schedules per scene; 0: 10, quick 3
  int runs = 0;   ///< per adversary and dimension; 0: 1000, quick 30
  int seed = 1;   ///< of what is drawn; 1: the masses, hands and walls that are stated
  /// The first of the seeds of runs that are counted on from it.
  [[nodiscard]] std::uint64_t first() const noexcept {
    return 1 + 1'000'003 * static_cast<std::uint64_t>(seed - 1);
  }
};

/// How often it is tried, with seeds from the first on.
struct effort {
  int runs = 0;
  std::uint64_t first = 1;
};

struct session : ex::workshop {
  const settings& chosen;
  const std::vector<controller>& judged;
};

/// Every controller combined with every element of a list.
template <class What>
auto with_each(const std::vector<controller>& judged, const std::vector<What>& list) {
  std::vector<std::pair<const controller*, What>> all;
  for (const auto& c : judged) {
    for (const auto& what : list) all.emplace_back(&c, what);
  }
  return all;
}

/// They write their rows as they are finished.
[[nodiscard]] const std::vector<ex::section<session>>& sections();

/// The settings of a command line. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: a cell contradicts a tag, or something could not be written or read.
/// 2: an argument is wrong. 130: stopped; what is on disk has been said.
[[nodiscard]] int run(const std::vector<std::string>& arguments,
                      const std::vector<controller>& judged, const std::atomic<bool>& stop);

}  // namespace controllers
