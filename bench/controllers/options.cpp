// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

namespace controllers {

namespace {

shard part(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos) ex::complain("--shard " + text + ": give I/N, such as 2/8");
  const shard s{ex::whole_number("--shard", text.substr(0, slash), 1),
                ex::whole_number("--shard", text.substr(slash + 1), 1)};
  if (s.part > s.of) ex::complain("--shard " + text + ": there are only " + std::to_string(s.of));
  return s;
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen{{"controllers"}};
  bool sharded = false;
  ex::read_options(
      "controllers",
      ex::section_options(
          sections(), chosen, "small: fewer seeds, runs and grid points",
          {ex::a_number("--seeds", "random schedules per scene (default: 10, quick 3)",
                        chosen.seeds),
           ex::a_seed("of schedules, loads, hands and masses", chosen.seed),
           ex::a_number("--runs", "per adversary and dimension (default: 1000, quick 30)",
                        chosen.runs),
           {"--shard I/N", "only the I-th of N parts of the Z-width sweep",
            [&](const std::string& text) {
              chosen.part = part(text);
              sharded = true;
            }},
           {"--merge FILE...", "joins parts that --shard wrote, and draws them",
            [&](const std::string& file) { chosen.merge.push_back(file); }}}),
      arguments, [&] {
        if (!sharded) return;
        if (!chosen.merge.empty()) ex::complain("--merge joins what --shard wrote: give one");
        if (chosen.only.empty()) chosen.only = {"z_width"};
        if (chosen.only != std::vector<std::string>{"z_width"}) {
          ex::complain("--shard splits z_width alone: leave --only out");
        }
      });
  if (chosen.seeds == 0) chosen.seeds = chosen.quick ? 3 : 10;
  if (chosen.runs == 0) chosen.runs = chosen.quick ? 30 : 1000;
  return chosen;
}

}  // namespace controllers
