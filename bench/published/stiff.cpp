// SPDX-License-Identifier: BSD-3-Clause
// Singh, Jafari and Ryu: 10 N/mm on a PHANToM Premium 1.5. What would a guarantee of it take?
#include "program.hpp"

namespace papers {

ex::failures run_stiff(const session& s) {
  constexpr double K = 10e3;
  s.out.section(
      "Singh, Jafari, Ryu: 10 N/mm",
      "Says (abstract of the successive force augmentation, T-IE 2019, which is where the figure "
      "stands, not in the successive stiffness increment): up to 10 N/mm shown on a PHANToM "
      "Premium 1.5. Not given in it: damping, update rate, what a hand can draw, when it rests. "
      "Stated: 75 g, 0.04 N, steps of 30 µm, 8.5 N (not verified), 0.05 N·s/m, 1 kHz. A wall "
      "of 10 N/mm steps by 0.3 N there, and a hand draws (K q − 2c) a metre at an edge, so a "
      "guarantee needs 0.15 N of dry friction (§ 2(g) 3, necessary as measured above). The second "
      "model is what a device needs for it: steps of 3 µm and 2 kHz.");
  const facts premium{
      .mass = 0.075, .damping = 0.05, .friction = 0.04, .quantum = 30e-6, .force_limit = 8.5};
  facts finer = premium;
  finer.quantum = 3e-6;
  finer.period = 0.5e-3;
  ex::failures found;
  const std::string source = "Singh, Jafari, Ryu 2019";
  const auto there = all_on(s, source, "Premium 1.5, 30 µm, 1 kHz", premium, K, {}, found);
  const auto here = all_on(s, source, "the same with 3 µm and 2 kHz", finer, K, {}, found);
  auto rows = there;
  rows.insert(rows.end(), here.begin(), here.end());
  s.out.member("stiff", ex::json_of(rows));
  const double most = 2.0 * premium.friction / premium.quantum;
  s.figures.push_back(figure_of(source, "10 N/mm shown", there,
                                best_of(there).shown < K
                                    ? ex::format("less: 2c/q = %.3g N/mm", most * 1e-3) +
                                          " is the most that lasts at an edge (§ 6), ours: " +
                                          what_binds(premium) + "; at 10 N/mm a hand draws energy"
                                    : "as much"));
  s.figures.push_back(figure_of(source + ", finer", "not given", here,
                                best_of(here).shown >= 0.9 * K
                                    ? "as much, and guaranteed to a hand of 5 N, on finer encoders"
                                    : "less than 10 N/mm even there"));
  if (best_of(there).shown > most * 1.05) {
    found.push_back("ours shows more than 2c/q, which cannot be");
  }
  return found;
}

}  // namespace papers
