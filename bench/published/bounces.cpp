// SPDX-License-Identifier: BSD-3-Clause
// Hannaford and Ryu, 2002: 90 kN/m on steps of 0.1 mm comes to rest after six bounces.
#include "program.hpp"

namespace papers {

ex::failures run_bounces(const session& s) {
  constexpr double K = 90e3;
  s.out.section(
      "Hannaford and Ryu, T-RA 2002: 90 kN/m",
      "Says (secondary account): on a device of 200 N, 1 kHz and steps of 0.1 mm a wall of 90 "
      "kN/m, met at about 200 mm/s, oscillates for ever, and with a passivity controller comes to "
      "rest after about six bounces. Not given there: mass, damping, friction, and the hand. "
      "Stated: 1 and 3 kg, 5 N·s/m, dry friction of 1 and 5 N, a hand that presses with 10 N, by "
      "a grip of 300 N/m and 3 N·s/m, and no more than 60 N. A wall of 90 kN/m steps by 9 N an "
      "encoder step, so K ≤ 2c/q asks for 4.5 N of dry friction. Their PO/PC: ours of "
      "published/, with 0.5 m/T at most.");
  const press thrown{.push = 10.0, .stiffness = 300.0, .damping = 3.0, .away = 20e-3, .speed = 0.2};
  facts light{.mass = 1.0,
              .damping = 5.0,
              .friction = 1.0,
              .quantum = 0.1e-3,
              .force_limit = 200.0,
              .hand = 60.0};
  facts heavy = light, exact = light;
  heavy.mass = 3.0;
  heavy.friction = 5.0;
  exact.friction = exact.quantum = 0.0;
  ex::failures found;
  const std::string source = "Hannaford, Ryu 2002";
  const auto stepped = all_on(s, source, "1 kg, 1 N of dry friction", light, K, thrown, found);
  const auto rubbing = all_on(s, source, "3 kg, 5 N of dry friction", heavy, K, thrown, found);
  const auto smooth =
      all_on(s, source, "1 kg, exact positions, no dry friction", exact, K, thrown, found);
  auto rows = stepped;
  rows.insert(rows.end(), rubbing.begin(), rubbing.end());
  rows.insert(rows.end(), smooth.begin(), smooth.end());
  s.out.member("bounces", ex::json_of(rows));

  for (const auto& [c, name] :
       {std::pair{bare(), "bare"}, {passivity_controlled(), "popc"}, {contenders()[1], "touch"}}) {
    ex::csv_file csv(s.out.path("bounces_" + std::string(name) + ".csv"),
                     "time s,depth m,force N,port energy J");
    auto shorter = thrown;
    shorter.seconds = 1.5;
    (void)under_a_hand(c, light, K, shorter, K, &csv);
    csv.close();
  }
  const auto swing_late = [](const ex::recorded& r) {
    return ex::swing(r.within("depth m", 1.0, 1.5));
  };
  s.out.plot(
      "bounces",
      {"90 kN/m on steps of 0.1 mm, 1 kg and 1 N of dry friction",
       {ex::definition("Above 0 is inside the wall."),
        {"The bare spring goes on bouncing by more than 1 mm.", "bounces_bare.csv",
         [=](const ex::recorded& r) { return ex::at_least(swing_late(r), 1e-3); }},
        {"Their controller comes to rest.", "bounces_popc.csv",
         [=](const ex::recorded& r) { return ex::at_most(swing_late(r), 1e-4); }},
        {"So does make_touch,", "bounces_touch.csv",
         [=](const ex::recorded& r) { return ex::at_most(swing_late(r), 1e-4); }},
        {"which never leaves the wall again;", "bounces_touch.csv",
         [](const ex::recorded& r) { return ex::least(r.within("depth m", 0.15, 1.5)) > 0.0; }},
        {"it is softer,", "bounces_touch.csv",
         [=](const ex::recorded& r) {  // and rests deeper than 10 N press into 90 kN/m
           return ex::at_least(ex::least(r.within("depth m", 1.0, 1.5)), 1.05 * thrown.push / K);
         }},
        {"and gives nothing away.", "bounces_touch.csv",
         [](const ex::recorded& r) {
           return ex::at_least(ex::least(r["port energy J"]), -accepted_loss);
         }}}},
      "set xlabel 'time [s]'\nset ylabel 'depth [mm]'\n"
      "plot [0:1] 'bounces_bare.csv' using 1:($2*1e3) with lines title 'bare spring', "
      "'bounces_popc.csv' using 1:($2*1e3) with lines title 'PO/PC', "
      "'bounces_touch.csv' using 1:($2*1e3) with lines lw 2 title 'make_touch'");
  const auto verdict = [&](const std::vector<outcome>& all, const facts& f) {
    const auto &best = best_of(all), &theirs = all.back();
    const std::string so = "PO/PC " + std::to_string(theirs.pressed_by.bounces) + " bounces, " +
                           ex::format("%.2g J attacked; ours ", theirs.attacked) +
                           std::to_string(best.pressed_by.bounces) + " and 0; ";
    return so + (best.shown >= 0.95 * K ? "as stiff" : "softer: " + what_binds(f));
  };
  const std::string says = "90 N/mm at rest after six bounces";
  s.figures.push_back(figure_of(source + ", 1 kg, 1 N", says, stepped, verdict(stepped, light)));
  s.figures.push_back(figure_of(source + ", 3 kg, 5 N", says, rubbing, verdict(rubbing, heavy)));
  s.figures.push_back(figure_of(source + ", 1 kg, exact", says, smooth, verdict(smooth, exact)));
  return found;
}

}  // namespace papers
