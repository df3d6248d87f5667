// SPDX-License-Identifier: BSD-3-Clause
// faults: one bad number, one late tick, one lie, and the wall is back within a second.
//
//     faults --out DIR           writes faults.{json,md}, a plot and index.html
//     faults --quick --out DIR   fewer moments
//
// Fails where a force is no number or over its limit, where a wall is not as before a second after a single
// fault, or where a fault creates more than it did itself and the amends that are stated.

#include "../common/interruptible.hpp"
#include "../common/rows.hpp"
#include "faults.hpp"
#include "rigid_faults.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/contact/contact_set.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <map>
#include <memory>

namespace faults {

namespace ex = experiments;

namespace {

constexpr ph::exact_device told{
    .mass = 0.1, .damping = 0.05, .force_limit = 9.0, .longest_tick = T};
constexpr ph::known_hand person{.force = 6.0};
constexpr ph::encoder_device grip{.mass = 0.1,
                                  .damping = 0.05,
                                  .friction = 0.13,
                                  .presliding = 15e-6,
                                  .quantum = 20e-6,
                                  .force_limit = 9.0,
                                  .continuous_force = 9.0,
                                  .winding_time = 10.0};

/// A port that a surface, or three, has been told to.
template <class Port>
controller loop_of(Port port, double amends, auto tell) {
  if constexpr (requires { port.observer().parameters().amends; }) {
    auto ledger = port.observer().parameters();
    ledger.amends = amends;
    (void)port.set(ledger);
  }
  tell(port, right);
  const auto own = std::make_shared<Port>(port);
  return {[own](const sample& s) {
            const auto out = own->tick(s);
            return answer{out.force, out.what};
          },
          [own, tell](int what) { tell(*own, what); }};
}
constexpr auto floor_of(double K) {
  return [K](auto& port, int what) {
    (void)port.update(told_as(what, plane{{0, 0, 0}, {0, 0, 1}, K}));
  };
}
template <int Latency>
auto touch_of(const auto& limits) {
  using loop = std::remove_cvref_t<decltype(limits)>;
  return ph::touch<d3, plane, loop>{
      d3{},
      ph::followed<plane>{},
      ph::turn_limited{.rate = 2.0},
      ph::eased{ph::damped_spring{.mass = told.mass, .force_limit = told.force_limit}},
      ph::forgiving{ph::reduced_energy{.damping = told.damping}, ph::amends_for(told.force_limit)},
      ph::bound_chain{
          ph::watched{ph::reachable_bound{.mass = told.mass, .hand_force = person.force}},
          ph::actuator_limit{.most = told.force_limit}},
      limits};
}

std::vector<subject> subjects() {
  const sim::device_parameters<d3> free{.mass = told.mass, .damping = 2.0 * told.damping};
  const double A = ph::amends_for(told.force_limit);
  std::vector<subject> all;
  for (const double K : {800.0, 3000.0}) {
    all.push_back({"touch, " + std::to_string(int(K)) + " N/m", free, 9.0, A, [K](double amends) {
                     return loop_of(ph::make_touch<d3>(told, person), amends, floor_of(K));
                   }});
    all.back().stiffness = K;
  }
  all.push_back({"touch that trusts, 800 N/m", free, 9.0, A, [](double amends) {
                   const ph::trusted_hand trusted{person};
                   return loop_of(ph::make_touch<d3>(told, trusted), amends, floor_of(800.0));
                 }});
  auto late = free;
  late.latency = 1;
  all.push_back({"touch, 1 tick late", late, 9.0, A, [](double amends) {
                   return loop_of(touch_of<1>(ph::late_loop_limits<1>{.longest_tick = T}), amends,
                                  floor_of(800.0));
                 }});
  all.push_back({"touch that learns T", free, 9.0, A, [](double amends) {
                   return loop_of(touch_of<0>(ph::learning_loop_limits<>{.longest_tick = T}),
                                  amends, floor_of(800.0));
                 }});
  all.push_back({"corner of three", free, 9.0, A, [](double amends) {
                   return loop_of(ph::make_contacts<d3>(told, person, ph::slots<plane, 3>{}),
                                  amends, [](auto& port, int what) {
                                    const int first = what == other_order ? 1 : 0;
                                    const plane walls[]{{{0, 0, 0}, {0, 0, 1}, 800.0},
                                                        {{0, 0, 0}, {0.8, 0, 0.6}, 800.0},
                                                        {{0, 0, 0}, {-0.8, 0, 0.6}, 800.0}};
                                    for (int i = 0; i < 3; ++i) {
                                      (void)port.source().update((i + first) % 3,
                                                                 told_as(what, walls[i]));
                                    }
                                  });
                 }});
  for (auto& s : all) s.world = true;
  all.push_back(
      {"force guard, 800 N/m", free, 9.0, A, [](double amends) {
         auto port = ph::make_guard<d3>(told, person);
         (void)port.set(ph::forgiving{ph::reduced_energy{.damping = told.damping}, amends});
         return controller([own = std::make_shared<decltype(port)>(port)](const sample& s) {
           const double depth = -vector(s.position).z();
           const vector wanted(0, 0, depth > 0.0 ? 800.0 * depth : 0.0);
           const auto out = own->tick(s, wanted);
           return answer{out.force, out.what};
         });
       }});
  auto stepped = free;
  stepped.quantum = grip.quantum;
  stepped.friction = grip.friction;
  all.push_back({"encoder touch, 800 N/m", stepped, 9.0, A, [](double amends) {
                   return loop_of(ph::make_touch<d3>(grip, person), amends, floor_of(800.0));
                 }});
  all.back().world = true;
  return all;
}

struct row {
  std::string composition, fault;
  harm found;
};
ex::record harm_of(const row& r) {
  return {{"composition", r.composition},
          {"fault", r.fault},
          {"runs", r.found.runs},
          {"created mJ", 1e3 * r.found.created},
          {"of it by the fault mJ", 1e3 * r.found.itself},
          {"largest force N", r.found.largest},
          {"back after s", r.found.back},
          {"lost", r.found.lost},
          {"event", ph::to_string(r.found.worst)}};
}
ex::record record_of(const row& r) {
  return ex::with_floor(harm_of(r), r.found.still);
}

struct rigid_row : row {};
ex::record record_of(const rigid_row& r) {
  ex::record all = harm_of(r);
  all.push_back({"largest torque N m", r.found.torque});
  return all;
}
/// Sound numbers within the limits of the motors, and a wall that is back.
void expect_sound(ex::failures& failed, const std::string& at, const auto& who, const fault& f,
                  const harm& found) {
  ex::expect(failed, found.finite, at + "a force is no number");
  ex::expect(failed, found.largest <= who.limit * (1.0 + 1e-9), at + "over the limit");
  if constexpr (requires { who.torque_limit; }) {
    ex::expect(failed, found.torque <= who.torque_limit * (1.0 + 1e-9), at + "over the limit");
  }
  ex::expect(failed, found.lost == 0 || f.gives_way, at + "not back within a second");
}

/// Outliers that never end, at a rate.
struct repeated_row {
  std::string composition;
  double rate = 0.0, created = 0.0, promised = 0.0, largest = 0.0;
};
ex::record record_of(const repeated_row& r) {
  return {{"composition", r.composition},
          {"outliers Hz", r.rate},
          {"created in 30 s mJ", 1e3 * r.created},
          {"at most, above what they did mJ", 1e3 * r.promised},
          {"largest force N", r.largest}};
}
repeated_row repeated(const subject& who, double rate) {
  auto parameters = who.device;
  parameters.start = vector(0, 0, 4e-3);
  parameters.substeps = 5;
  sim::device<d3, hand> device(parameters, {.stiffness = 300.0, .damping = 2.0, .limit = 5.0});
  const controller loop = who.make(who.amends);
  sample s = device.exchange(vector::Zero());
  repeated_row found{who.name, rate};
  const int every = static_cast<int>(std::lround(1.0 / (rate * T)));
  for (int n = 0; n < 30000; ++n) {
    device.hand().target = vector(0, 0, -3e-3 - 7e-3 * std::cos(6.2832e-3 * n));
    sample shown = s;
    if (n % every == every - 1) {
      shown.position = vector(vector(s.position) - vector(0, 0, 4e-3));  // deeper: a push out
    }
    const answer a = loop(shown);
    found.largest = std::max(found.largest, a.force.norm());
    s = device.exchange(a.force);
    found.created = created(device.meter(), found.created);
  }
  found.promised = who.amends * (8.0 + 30.0 / 2.5);
  return found;
}

struct settings {
  std::string out = "faults";
  bool quick = false;
  int threads = 0;
};

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("faults", [&] {
    settings chosen;
    ex::read_options(
        "faults",
        {ex::a_switch("--quick", "fewer moments", chosen.quick),
         ex::a_text("--out DIR", "where the results go (default: faults)", chosen.out),
         ex::a_number("--threads", "(default: as many as the machine has)", chosen.threads)},
        arguments);
    ex::report report(chosen.out, {.json = "faults.json", .markdown = "faults.md"});
    const ex::workshop work{report, ex::threads_of(chosen.threads), stop};
    const std::vector<int> when =
        chosen.quick ? std::vector<int>{220, 900} : std::vector<int>{60, 150, 220, 450, 900, 1300};
    const auto who = subjects();
    const auto what = single_faults();
    std::vector<std::pair<const subject*, const fault*>> jobs;
    for (const auto& s : who) {
      for (const auto& f : what) jobs.emplace_back(&s, &f);
    }
    const auto rows = work.rows("faults.csv", "faults", jobs, [&when](const auto& job) {
      return row{job.first->name, job.second->name, tried(*job.first, *job.second, when)};
    });

    ex::failures failed;
    std::map<std::string, row> worst;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& [name, fault, found] = rows[i];
      const subject& s = *jobs[i].first;
      const std::string at = name + ", " + fault + ": ";
      expect_sound(failed, at, s, *jobs[i].second, found);
      ex::expect(failed, found.created <= found.itself + s.amends + 1e-12, at + "creates more");
      row& most = worst[name];
      most.composition = name;
      most.fault = "the worst of " + std::to_string(what.size());
      most.found.runs += found.runs;
      most.found.lost += found.lost;
      most.found.created = std::max(most.found.created, found.created);
      most.found.itself = std::max(most.found.itself, found.itself);
      most.found.largest = std::max(most.found.largest, found.largest);
      most.found.back = std::max(most.found.back, found.back);
      most.found.worst = ph::worse(most.found.worst, found.worst);
      most.found.still.add(found.still);
    }
    report.section("One fault",
                   "A hand presses a wall of 10 mm, holds still or taps once a second, "
                   "and once there is a fault. The same device without one is the truth: "
                   "the wall is back when its force is within a tenth and 0.1 N and its "
                   "depth within 0.5 mm of it for good. The columns "
                   "on quiet are of the hand that holds still, until 3 s have passed; the fault is "
                   "the last news." +
                       std::string(ex::quiet_columns) +
                       " Shown is the force over the true depth of the last half second; what the "
                       "corner asks for is that of each of its surfaces. Floor: K q.");
    std::vector<row> summary;
    for (const auto& s : who) summary.push_back(worst[s.name]);
    report.show(ex::table_of(summary));
    report.section("Every fault", "The same, one by one.");
    ex::show_rows(report, "single", rows);

    const auto tools = rigid::rigid_subjects();
    const std::vector<int> moments =
        chosen.quick ? std::vector<int>{220} : std::vector<int>{150, 220, 450, 900};
    const auto worlds = restarts();
    std::vector<rigid_row> turned_anew;
    std::vector<row> anew;
    for (const auto& s : who) {
      if (!s.world) continue;
      for (const auto& f : worlds) {
        anew.push_back({s.name, f.name, tried(s, f, when)});
        const harm& found = anew.back().found;
        const std::string at = s.name + ", " + f.name + ": ";
        expect_sound(failed, at, s, f, found);
        ex::expect(failed, found.created <= 2e-6,
                   at + "creates energy");  // ½ c p, where there is friction
      }
    }
    for (const auto& s : tools) {
      for (const auto& f : worlds) {
        turned_anew.push_back({{s.name, f.name, tried(s, rigid::rigid_fault{f}, moments)}});
        const harm& found = turned_anew.back().found;
        const std::string at = s.name + ", " + f.name + ": ";
        expect_sound(failed, at, s, f, found);
        ex::expect(failed, found.created <= 2e-6, at + "creates energy");
      }
    }
    report.section(
        "A world that starts anew",
        "Its publisher begins again and says for 0.2 s what is not so, then what is. No ledger "
        "is wrong by that, so nothing is created. Where the surface gives way the finger goes "
        "with it, and no passive port brings it back before the hand does.");
    ex::show_rows(report, "restarts", anew);
    report.section("A world that starts anew, in six degrees of freedom", "The same of the tools.");
    ex::show_rows(report, "rigid_restarts", turned_anew);

    const auto poses = rigid::rigid_faults();
    std::vector<std::pair<const rigid::rigid_subject*, const rigid::rigid_fault*>> turns;
    for (const auto& s : tools) {
      for (const auto& f : poses) turns.emplace_back(&s, &f);
    }
    const auto turned = work.rows("rigid.csv", "six degrees", turns, [&moments](const auto& job) {
      return rigid_row{
          {job.first->name, job.second->of.name, tried(*job.first, *job.second, moments)}};
    });
    for (std::size_t i = 0; i < turned.size(); ++i) {
      const rigid::rigid_subject& s = *turns[i].first;
      const harm& found = turned[i].found;
      const std::string at = turned[i].composition + ", " + turned[i].fault + ": ";
      expect_sound(failed, at, s, turns[i].second->of, found);
      ex::expect(failed, found.created <= found.itself + s.amends + 1e-12, at + "creates more");
    }
    report.section("Six degrees of freedom",
                   "A block of 40 mm, its handle on top, on a floor or in a hole 0.5 mm wider. A "
                   "hand holds its place with 300 N/m and its turn with 0.5 N m/rad, and presses "
                   "or taps as above. The wall is back when the turn is within a degree, too.");
    ex::show_rows(report, "rigid", turned);

    // The control: what a ledger to the letter loses, where every sample up to top_speed is believed and where not.
    const auto letter = [&](const char* name) {
      subject never = *std::find_if(who.begin(), who.end(),
                                    [name](const subject& s) { return s.name == name; });
      never.amends = 0.0;
      return never;
    };
    const auto loses = [&](const subject& never) {
      int lost = 0;
      for (const auto& f : what) lost += tried(never, f, {220, 450, 900}).lost > 0;
      return lost;
    };
    const subject trusts = letter("touch that trusts, 800 N/m");
    const int lost = loses(trusts), doubting = loses(letter("touch, 800 N/m"));
    ex::expect(failed, lost > 10,
               "a ledger that forgives nothing loses no wall: the test is blind");
    ex::expect(failed, doubting < lost / 2, "doubt saves no wall");
    report.section("The control",
                   "A ledger that forgives nothing loses the wall of " + std::to_string(lost) +
                       " of " + std::to_string(what.size()) +
                       " faults where samples are believed up to top_speed, and of " +
                       std::to_string(doubting) + " where they are doubted.");

    std::vector<repeated_row> again;
    for (const auto& s : who) {
      for (const double rate : {1.0, 10.0, 100.0}) again.push_back(repeated(s, rate));
    }
    report.section("Faults again and again",
                   "Outliers of 4 mm into the wall, under a hand that taps, for 30 s. Quiet is not "
                   "judged here, because neither the hand nor the faults ever stop.");
    ex::show_rows(report, "repeated", again);
    for (const auto& r : again) {
      ex::expect(failed, r.largest <= 9.0 * (1.0 + 1e-9), r.composition + ": over the limit");
    }

    ex::csv_file csv(report.path("one_outlier.csv"), "time,touch,control,truth");
    const fault outlier{
        "", 1, [](sample& s) { s.position = vector(vector(s.position) - vector(0, 0, 4e-3)); }};
    const course mended = press(who.front(), who.front().amends, false, 900, &outlier);
    const course dead = press(trusts, 0.0, false, 900, &outlier);
    const course right = press(who.front(), 0.0, false, 900, nullptr);
    for (std::size_t n = 800; n < 2500; ++n) {
      csv.line(ex::csv_line({{"t", static_cast<double>(n) * T},
                             {"touch", mended.force[n]},
                             {"control", dead.force[n]},
                             {"truth", right.force[n]}}));
    }
    csv.close();
    report.plot(
        "one_outlier",
        {"One sample that is 4 mm off, at 0.9 s",
         {ex::definition("A hand that holds still."),
          {"make_touch keeps the wall;", "one_outlier.csv",
           [](const ex::recorded& r) {  // from a second after the fault on
             return ex::at_most(
                 ex::rms_between(r.within("touch", 1.9, 2.5), r.within("truth", 1.9, 2.5)),
                 0.05 * ex::most(r.within("truth", 1.9, 2.5)));
           }},
          {"a port that believes the sample and forgives nothing has lost it.", "one_outlier.csv",
           [](const ex::recorded& r) {
             return ex::at_most(ex::most(r.within("control", 1.9, 2.5)),
                                0.5 * ex::least(r.within("truth", 1.9, 2.5)));
           }}},
         {"one_outlier.csv", "truth", "the force without the outlier"}},
        "set xlabel 'time [s]'\nset ylabel 'force [N]'\nset yrange [0:*]\n"
        "plot 'one_outlier.csv' using 1:2 with lines lt 1 title 'touch', "
        "'' using 1:3 with lines lt 2 title 'forgives nothing'");
    return ex::conclude(
        report, "faults", "passive_haptics: faults",
        "One bad number, one late tick, one lie: what does it cost, and when is the "
        "wall back?",
        failed);
  });
}

}  // namespace

}  // namespace faults

int main(int argc, char** argv) {
  return experiments::interruptible(argc, argv, faults::run);
}
