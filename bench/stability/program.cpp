// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"

namespace stability {

namespace {

const std::vector<ex::section<session>>& sections() {
  static const std::vector<ex::section<session>> all{
      {"sweep", run_sweep}, {"shapes", run_shapes}, {"numbers", run_numbers}, {"soak", run_soak}};
  return all;
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen{{"stability"}};
  ex::read_options(
      "stability",
      ex::section_options(
          sections(), chosen, "seconds instead of minutes",
          {ex::a_number("--soak", "ticks of the long run (default: 10000000, quick 1000000)",
                        chosen.soak, 1000)}),
      arguments);
  return chosen;
}

ex::failures try_all(ex::report& out, const settings& chosen,
                     const std::vector<controllers::controller>& judged) {
  const std::atomic<bool> never = false;
  const session s{{out, ex::threads_of(chosen.threads), never}, chosen, judged};
  return ex::run_sections(sections(), chosen.only, s);
}

int run(const std::vector<std::string>& arguments,
        const std::vector<controllers::controller>& judged) {
  return ex::guarded("stability", [&] {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "stability.json", .markdown = "stability.md"});
    const auto found = try_all(report, chosen, judged);
    return ex::conclude(
        report, "stability", "passive_haptics: stiff and extreme cases",
        "Every controller where it is stiff, slow, far away, tiny, late or no number "
        "at all: what it keeps, what it refuses, and what it says.",
        found);
  });
}

}  // namespace stability
