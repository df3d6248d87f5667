// SPDX-License-Identifier: BSD-3-Clause
// report: error against run time.
//
//     report --out DIR            everything
//     report --long --out DIR     the same with ten times as many ticks, stiff and extreme cases in full
//     report --quick --out DIR    the same, shorter, without counts
//     report --help               all options

#include "../common/options.hpp"
#include "../cost/counts.hpp"
#include "../stability/program.hpp"
#include "tables.hpp"

#include <filesystem>

namespace {

using namespace experiments;
using namespace std::string_literals;

candidate named(const std::string& name) {
  std::vector<candidate> all = by_hand_candidates();
  for (const auto& c : arithmetic_compositions()) {
    all.insert(all.end(), c.timed.begin(), c.timed.end());
  }
  for (const auto& c : all_compositions()) all.push_back(c.cost);
  for (const auto& c : all) {
    if (c.name == name) return c;
  }
  complain("--replay " + name + ": no such composition");
}

int run(const std::vector<std::string>& arguments) {
  settings chosen;
  std::string replayed;
  bool longer = false, uncounted = false;
  int ticks = 0;
  chosen.program = std::filesystem::read_symlink("/proc/self/exe").string();
  read_options(
      "report",
      {a_text("--out DIR", "where the results go (default: " + chosen.out + ")", chosen.out),
       a_switch("--quick", "fewer ticks and rates; no counts", chosen.quick),
       a_switch("--long", "ten million ticks; stiff and extreme cases in full", longer),
       a_number("--ticks", "of the arithmetic (default: 1000000, quick 10000) or a replay", ticks),
       a_switch("--no-counts", "no instructions, which need valgrind", uncounted),
       a_text("--replay NAME", "one composition alone, for callgrind", replayed)},
      arguments, [&] {
        if (longer && chosen.quick) complain("--long is not --quick: give one");
      });
  chosen.ticks = ticks > 0 ? ticks : chosen.quick ? 10'000 : longer ? 10'000'000 : 1'000'000;
  chosen.counts = !chosen.quick && !uncounted;
  if (!replayed.empty()) {
    std::cout << named(replayed).replay(chosen.ticks) << '\n';
    return EXIT_SUCCESS;
  }
  if (chosen.counts && !cost::valgrind_works()) {
    std::cout << "there is no valgrind that works: no instruction counts\n";
    chosen.counts = false;
  }
  report out(chosen.out, {"error_vs_runtime.json", "error_vs_runtime.md"});
  figures all(out);
  failures found = report_arithmetic(out, chosen, all);
  const auto add = [&found](const failures& more) {
    found.insert(found.end(), more.begin(), more.end());
  };
  add(report_models(out, chosen, all));
  all.close();
  report_by_hand(out, chosen);
  add(stability::try_all(
      out, stability::parse(longer ? std::vector<std::string>{} : std::vector{"--quick"s}),
      controllers::catalogue()));
  return conclude(out, "report", "passive_haptics: error against run time",
                  "How exact a scalar and how true a local model is, for what it costs; then the "
                  "stiff and extreme cases.",
                  found);
}

}  // namespace

int main(int argc, char** argv) {
  return guarded("report", [&] { return run({argv + 1, argv + argc}); });
}
