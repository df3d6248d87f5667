// SPDX-License-Identifier: BSD-3-Clause
// report: error against run time.
//
//     report --out DIR                    everything: ten million ticks in 113 bits take minutes
//     report --quick --out DIR            the same, shorter, without counts
//     report --stiff --out DIR            stiff and extreme cases in full, not their quick form
//     report --replay NAME --ticks N      one composition alone, for callgrind

#include "../cost/counts.hpp"
#include "../stability/program.hpp"
#include "tables.hpp"

#include <exception>
#include <filesystem>

namespace {

using namespace experiments;
using namespace std::string_literals;

[[noreturn]] void usage(const std::string& complaint) {
  throw std::invalid_argument(
      complaint +
      "\nusage: report [--out DIR] [--quick] [--ticks N] [--no-counts] [--stiff]"
      "\n       report --replay NAME --ticks N");
}

long whole_number(const std::string& name, const char* text) {
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  if (end == text || *end != '\0' || value < 1) {
    usage(name + " " + text + ": give a whole number of at least 1");
  }
  return value;
}

const candidate& named(const std::string& name) {
  for (const auto& c : arithmetic_candidates()) {
    if (c.name == name) return c;
  }
  for (const auto& c : all_compositions()) {
    if (c.cost.name == name) return c.cost;
  }
  static const std::vector<candidate> both = by_hand_candidates();
  for (const auto& c : both) {
    if (c.name == name) return c;
  }
  usage("--replay " + name + ": no such composition");
}

int run(int argc, char** argv) {
  settings chosen;
  std::string replayed;
  bool ticks_given = false, stiff = false;
  chosen.program = std::filesystem::read_symlink("/proc/self/exe").string();
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto value = [&] {
      if (i + 1 == argc) usage(name + ": its value is missing");
      return argv[++i];
    };
    if (name == "--out") {
      chosen.out = value();
    } else if (name == "--quick") {
      chosen.quick = true;
      chosen.counts = false;
    } else if (name == "--no-counts") {
      chosen.counts = false;
    } else if (name == "--stiff") {
      stiff = true;
    } else if (name == "--ticks") {
      chosen.ticks = whole_number(name, value());
      ticks_given = true;
    } else if (name == "--replay") {
      replayed = value();
    } else {
      usage(name + ": no such option");
    }
  }
  if (!replayed.empty()) {
    std::cout << named(replayed).replay(chosen.ticks) << '\n';
    return EXIT_SUCCESS;
  }
  if (chosen.quick && !ticks_given) chosen.ticks = 10'000;
  if (chosen.counts && !cost::valgrind_is_here()) {
    std::cout << "valgrind is not installed: no instruction counts\n";
    chosen.counts = false;
  }
  report out(chosen.out, {"error_vs_runtime.json", "error_vs_runtime.md"});
  figures all(out);
  const bool arithmetic = report_arithmetic(out, chosen, all);
  const bool models = report_models(out, chosen, all);
  all.close();
  report_by_hand(out, chosen);
  const auto lost = stability::try_all(
      out, stability::parse(stiff ? std::vector<std::string>{} : std::vector{"--quick"s}),
      controllers::catalogue());
  if (!out.finish("passive_haptics: error against run time")) {
    std::cout << "gnuplot did not draw every plot: is it installed? The rest is complete.\n";
  }
  std::cout << "results: " << out.path("error_vs_runtime.md").string() << ", "
            << out.path("index.html").string() << '\n';
  return arithmetic && models && lost.empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& problem) {
    std::cerr << "report: " << problem.what() << '\n';
    return EXIT_FAILURE;
  }
}
