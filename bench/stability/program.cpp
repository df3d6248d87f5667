// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include "numbers.hpp"
#include "shapes.hpp"
#include "soak.hpp"
#include "sweep.hpp"

#include <charconv>
#include <thread>

namespace stability {

namespace {

[[noreturn]] void complain(const std::string& what) {
  throw std::invalid_argument(
      what +
      "\nusage: stability [--quick] [--out DIR] [--soak TICKS] "
      "[--threads N]\n"
      "  --quick        seconds instead of minutes\n"
      "  --out DIR      where the results go (default: stability)\n"
      "  --soak TICKS   of the long run (default: 10000000, quick 1000000)\n"
      "  --threads N    (default: as many as the machine has)");
}

long long number(const std::string& name, const std::string& text, long long least) {
  long long value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end || value < least) {
    complain(name + " " + text + ": give a whole number of at least " + std::to_string(least));
  }
  return value;
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) complain(name + ": its value is missing");
      return arguments[++i];
    };
    if (name == "--quick") {
      chosen.quick = true;
    } else if (name == "--out") {
      chosen.out = value();
    } else if (name == "--soak") {
      chosen.soak = number(name, value(), 1000);
    } else if (name == "--threads") {
      chosen.threads = static_cast<int>(std::min(number(name, value(), 1), 1024LL));
    } else {
      complain(name + ": no such option");
    }
  }
  if (chosen.threads == 0) {
    chosen.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  return chosen;
}

std::vector<std::string> try_all(ex::report& out, const settings& chosen,
                                 const std::vector<controllers::controller>& judged) {
  const session s{out, chosen, judged};
  std::vector<std::string> found;
  for (auto* part : {run_sweep, run_shapes, run_numbers, run_soak}) {
    for (auto& sentence : part(s)) found.push_back(std::move(sentence));
  }
  std::vector<std::string> quoted;
  for (const auto& sentence : found) {
    std::cerr << "stability: " << sentence << '\n';
    quoted.push_back(ex::json_string(sentence));
  }
  out.member("failures", ex::json_array(quoted));
  return found;
}

int run(const std::vector<std::string>& arguments,
        const std::vector<controllers::controller>& judged) {
  try {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "stability.json", .markdown = "stability.md"});
    const std::vector<std::string> found = try_all(report, chosen, judged);
    if (!report.finish("passive_haptics: stiff and extreme cases")) {
      std::cout << "gnuplot did not draw every plot: is it installed? The rest is complete.\n";
    }
    std::cout << "results: " << report.path("stability.md").string() << ", "
              << report.path("stability.csv").string() << '\n';
    return found.empty() ? 0 : 1;
  } catch (const std::invalid_argument& problem) {
    std::cerr << "stability: " << problem.what() << '\n';
    return 2;
  } catch (const std::exception& problem) {
    std::cerr << "stability: " << problem.what() << '\n';
    return 1;
  }
}

}  // namespace stability
