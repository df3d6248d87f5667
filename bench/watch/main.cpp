// SPDX-License-Identifier: BSD-3-Clause
// watch: what the motion refutes of what was stated of a device, how soon, and what it saves.
//
//     watch --out DIR                 writes watch.{json,md} and index.html
//     watch --seed N --devices M      other devices, and so many of each kind
//     watch --sessions M              so many honest ones, of three seconds each
//
// Fails where an honest session is found to be none.

#include "../common/interruptible.hpp"
#include "../common/rows.hpp"
#include "sessions.hpp"

#include <map>

namespace watching {

namespace ex = experiments;

namespace {

struct settings {
  std::string out = "watch";
  int seed = 1, devices = 200, sessions = 3700, threads = 0;
};

/// Ten honest sessions.
struct honest_row {
  int first = 0;
  long ticks = 0, refuted = 0;
  int latched = 0;
};
ex::record record_of(const honest_row& r) {
  return {{"from seed", r.first},
          {"ticks", r.ticks},
          {"ticks refuted", r.refuted},
          {"sessions latched", r.latched}};
}

struct kind {
  const char* name;
  untruth how;
};
const std::vector<kind>& kinds() {
  static const std::vector<kind> all{{"wrong sign", {lie::sign}},
                                     {"wrong sign, reported", {lie::sign, 0.0, 0.5, true}},
                                     {"1 tick sooner", {lie::latency, -1.0}},
                                     {"1 tick sooner, reported", {lie::latency, -1.0, 0.5, true}},
                                     {"1 tick later", {lie::latency, 1.0}},
                                     {"1 tick later, reported", {lie::latency, 1.0, 0.5, true}},
                                     {"2 ticks later", {lie::latency, 2.0}},
                                     {"2 ticks later, reported", {lie::latency, 2.0, 0.5, true}},
                                     {"3 ticks later", {lie::latency, 3.0}},
                                     {"3 ticks later, reported", {lie::latency, 3.0, 0.5, true}},
                                     {"two ports", {lie::two_ports}},
                                     {"a third of the mass", {lie::lighter, 1.0 / 3.0}},
                                     {"1.3 of the hand's force", {lie::stronger_hand, 1.3}},
                                     {"3 times the hand's force", {lie::stronger_hand, 3.0}},
                                     {"gives at 25 Hz", {lie::compliant, 25.0}},
                                     {"gives at 60 Hz", {lie::compliant, 60.0}},
                                     {"gives at 120 Hz", {lie::compliant, 120.0}},
                                     {"gives at 250 Hz", {lie::compliant, 250.0}}};
  return all;
}
/// One kind of untruth, told of many devices.
struct untrue_row {
  std::string name;
  int devices = 0, found = 0, latched = 0, sign = 0, latency = 0;
  double median = 0.0;                                                      ///< [s]
  int lose = 0, lose_watched = 0;                                           ///< over 0.1 mJ
  double mean = 0.0, mean_watched = 0.0, worst = 0.0, worst_watched = 0.0;  ///< [J]
};
ex::record record_of(const untrue_row& r) {
  return {{"untrue", r.name},
          {"devices", r.devices},
          {"found", r.found},
          {"after s", r.median},
          {"latched", r.latched},
          {"as wrong sign", r.sign},
          {"as untold latency", r.latency},
          {"lose", r.lose},
          {"lose, watched", r.lose_watched},
          {"mean mJ", 1e3 * r.mean},
          {"mean mJ, watched", 1e3 * r.mean_watched},
          {"worst mJ", 1e3 * r.worst},
          {"worst mJ, watched", 1e3 * r.worst_watched}};
}
untrue_row tried(const kind& what, int seed, int devices) {
  untrue_row all{what.name, devices};
  std::vector<double> after;
  for (int i = 0; i < devices; ++i) {
    const auto number = static_cast<std::uint64_t>(seed) * 1000003 + static_cast<std::uint64_t>(i);
    truth w = drawn(number);
    untruth how = what.how;
    if (how.kind == lie::latency && how.amount < 0.0 && w.latency == 0) w.latency = 1;
    if (how.kind == lie::compliant) {
      dice g(number + 5);
      how.share = between(g, 0.1, 0.8);
      w.stated_mass = 1.0;
      w.friction = w.quantum = w.on_it.own = 0.0;
    }
    const result off = session<ph::trusted_hand>(w, how, 3.0);
    const result on = session(w, how, 3.0);
    all.lose += off.lost > 1e-4;
    all.lose_watched += on.lost > 1e-4;
    all.mean += off.lost / devices;
    all.mean_watched += on.lost / devices;
    all.worst = std::max(all.worst, off.lost);
    all.worst_watched = std::max(all.worst_watched, on.lost);
    if (on.found >= 0.0) after.push_back(on.found);
    all.latched += on.latched != ph::event::nominal;
    all.sign += on.latched == ph::event::wrong_sign;
    all.latency += on.latched == ph::event::untold_latency;
  }
  std::sort(after.begin(), after.end());
  all.found = static_cast<int>(after.size());
  all.median = after.empty() ? 0.0 : after[after.size() / 2];
  return all;
}

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("watch", [&] {
    settings chosen;
    ex::read_options(
        "watch",
        {ex::a_text("--out DIR", "where the results go (default: watch)", chosen.out),
         ex::a_seed("other devices", chosen.seed),
         ex::a_number("--devices", "of each untruth (default: 200)", chosen.devices),
         ex::a_number("--sessions", "that are honest (default: 3700)", chosen.sessions),
         ex::a_number("--threads", "(default: as many as the machine has)", chosen.threads)},
        arguments);
    ex::report report(chosen.out, {.json = "watch.json", .markdown = "watch.md"});
    const ex::workshop work{report, ex::threads_of(chosen.threads), stop};

    std::vector<int> tens;
    for (int i = 0; i < chosen.sessions; i += 10) tens.push_back(i);
    const auto rows = work.rows("honest.csv", "honest", tens, [&chosen](int first) {
      honest_row all{first};
      for (int i = first; i < first + 10; ++i) {
        const auto number =
            static_cast<std::uint64_t>(chosen.seed) * 1000003 + static_cast<std::uint64_t>(i);
        const truth w = i % 3 == 0 ? drawn(number) : named(number % names, number);
        const result r = session(w, {.reported = i % 2 == 0}, 3.0);
        all.ticks += r.ticks;
        all.refuted += r.refuted;
        all.latched += r.latched != ph::event::nominal;
      }
      return all;
    });
    honest_row sum;
    for (const auto& r : rows) {
      sum.ticks += r.ticks;
      sum.refuted += r.refuted;
      sum.latched += r.latched;
    }
    ex::failures failed;
    ex::expect(failed, sum.refuted == 0, "an honest session is refuted");
    report.section("Honest sessions",
                   "Devices that are drawn, those of the catalogue and the simulated ones, with "
                   "seven kinds of hands within what was stated, steps of the encoders, jitter, "
                   "friction and latency. " +
                       std::to_string(sum.ticks) + " ticks, refuted in " +
                       std::to_string(sum.refuted) + " of them.");

    std::vector<int> which;
    for (std::size_t i = 0; i < kinds().size(); ++i) which.push_back(static_cast<int>(i));
    const auto untrue = work.rows("untrue.csv", "untrue", which, [&chosen](int i) {
      return tried(kinds()[static_cast<std::size_t>(i)], chosen.seed, chosen.devices);
    });
    report.section("One untruth",
                   "Drawn devices that are not as stated in one fact, three seconds each, with and "
                   "without the watch. 'found' are those that were refuted at all, after so long "
                   "in contact in the median; 'latched' until reset(). 'lose' counts "
                   "more than 0.1 mJ.");
    ex::show_rows(report, "untrue", untrue);
    return ex::conclude(report, "watch", "passive_haptics: watch",
                        "What was stated of a device, held against its motion.", failed);
  });
}

}  // namespace

}  // namespace watching

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, watching::run);
}
