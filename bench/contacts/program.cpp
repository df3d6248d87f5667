// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

namespace contacts {

const std::vector<ex::section<session>>& sections() {
  static const std::vector<ex::section<session>> all{
      {"quiet", run_quiet},       {"quiet_tool", run_quiet_tool},
      {"settling", run_settling}, {"touch", run_touch},
      {"news", run_news},         {"stroke", run_stroke},
      {"frames", run_frames},     {"curved", run_curved},
      {"friction", run_friction}, {"static", run_static},
      {"passive", run_passive},   {"rigid", run_rigid},
      {"tool", run_tool},         {"guards", run_guards},
      {"steep", run_steep},       {"meshes", run_meshes}};
  return all;
}

settings parse(const std::vector<std::string>& arguments) {
  settings chosen{{"contacts"}};
  ex::read_options("contacts",
                   ex::section_options(sections(), chosen, "fewer cases and seconds",
                                       {ex::a_seed("of the scenes", chosen.seed)}),
                   arguments);
  return chosen;
}

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("contacts", [&] {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "contacts.json", .markdown = "contacts.md"});
    const session s{{report, ex::threads_of(chosen.threads), stop}, chosen};
    const auto found = ex::run_sections(sections(), chosen.only, s);
    return ex::conclude(report, "contacts", "passive_haptics: every contact",
                        "Corners, rough planes, curved surfaces and rigid tools: do several "
                        "contacts at once settle, step, creep or lose energy?",
                        found);
  });
}

}  // namespace contacts
