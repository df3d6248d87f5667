// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"

namespace stability {

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  ex::read_options(
      "stability",
      {ex::a_switch("--quick", "seconds instead of minutes", chosen.quick),
       ex::a_text("--out DIR", "where the results go (default: stability)", chosen.out),
       ex::a_number("--soak", "ticks of the long run (default: 10000000, quick 1000000)",
                    chosen.soak, 1000),
       ex::a_number("--threads", "(default: as many as the machine has)", chosen.threads)},
      arguments);
  return chosen;
}

ex::failures try_all(ex::report& out, const settings& chosen,
                     const std::vector<controllers::controller>& judged) {
  const std::atomic<bool> never = false;
  const session s{{out, ex::threads_of(chosen.threads), never}, chosen, judged};
  ex::failures found;
  for (auto* part : {run_sweep, run_shapes, run_numbers, run_soak}) {
    for (auto& sentence : part(s)) found.push_back(std::move(sentence));
  }
  return found;
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
