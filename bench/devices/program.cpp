// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

namespace devices {

const std::vector<ex::section<session>>& sections() {
  static const std::vector<ex::section<session>> all{
      {"compliance", run_compliance}, {"chains", run_chains}, {"late", run_late}};
  return all;
}

settings parse(const std::vector<std::string>& arguments) {
  settings chosen{"devices"};
  ex::read_options("devices",
                   ex::section_options(sections(), chosen, "fewer devices, fewer seconds"),
                   arguments);
  return chosen;
}

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("devices", [&] {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "devices.json", .markdown = "devices.md"});
    const session s{{report, ex::threads_of(chosen.threads), stop}, chosen};
    const auto found = ex::run_sections(sections(), chosen.only, s);
    return ex::conclude(
        report, "devices", "passive_haptics: devices as they are",
        "What a promise is worth where a transmission gives, a force comes a fraction of a tick "
        "late, and a recording judges.",
        found);
  });
}

}  // namespace devices
