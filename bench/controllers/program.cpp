// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include "adversaries.hpp"
#include "settling.hpp"
#include "stiffness.hpp"
#include "wall.hpp"
#include "z_width.hpp"

namespace controllers {

namespace {

ex::table list_of(const std::vector<controller>& judged) {
  ex::table all({"controller", "tag", "dimensions", "composition"});
  for (const auto& c : judged) {
    all.add({c.name, to_string(c.tag), c.in_3 ? "1, 2, 3" : c.in_2 ? "1, 2" : "1", c.composition});
  }
  return all;
}

/// The sections that were asked for; returns what contradicts the tags.
std::vector<std::string> judge(const session& s) {
  s.out.section("Controllers",
                "The tag is the type's own promise: strict for every motion and environment, "
                "conditional under the assumptions named in the header, none. What each header "
                "assumes beside that: a lower bound of the damping, exact positions, the force "
                "held known, no tick longer than the longest.");
  s.out.show(list_of(s.judged));
  std::vector<std::string> found;
  for (const auto& section : sections()) {
    const auto& only = s.chosen.only;
    if (!only.empty() && std::find(only.begin(), only.end(), section.name) == only.end()) continue;
    for (auto& sentence : section.run(s)) found.push_back(std::move(sentence));
  }
  return found;
}

int finish(const session& s, const std::vector<std::string>& found) {
  if (s.chosen.part.of > 1) return 0;  // a part is no report
  if (!s.out.finish("passive_haptics: all controllers side by side")) {
    std::cout << "gnuplot did not draw every plot: is it installed? The rest is complete.\n";
  }
  std::cout << "results: " << s.out.path("controllers.md").string() << ", "
            << s.out.path("controllers.json").string() << '\n';
  for (const auto& sentence : found) std::cerr << "controllers: " << sentence << '\n';
  return found.empty() ? 0 : 1;
}

}  // namespace

const std::vector<section>& sections() {
  static const std::vector<section> all{{"wall", run_wall},
                                        {"adversaries", run_adversaries},
                                        {"stiffness", run_stiffness},
                                        {"settling", run_settling},
                                        {"z_width", run_z_width}};
  return all;
}

int run(const std::vector<std::string>& arguments, const std::vector<controller>& judged,
        const std::atomic<bool>& stop) {
  try {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "controllers.json", .markdown = "controllers.md"});
    const session s{report, chosen, stop, judged};
    if (!chosen.merge.empty()) {
      merge_z_width(s, chosen.merge);
      return finish(s, {});
    }
    return finish(s, judge(s));
  } catch (const std::invalid_argument& problem) {
    std::cerr << "controllers: " << problem.what() << '\n';
    return 2;
  } catch (const interrupted& stopped) {
    std::cerr << "controllers: " << stopped.what()
              << "; the files of earlier sections are complete, there is no report\n";
    return 130;
  } catch (const std::exception& problem) {
    std::cerr << "controllers: " << problem.what() << '\n';
    return 1;
  }
}

}  // namespace controllers
