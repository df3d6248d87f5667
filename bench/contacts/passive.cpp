// SPDX-License-Identifier: BSD-3-Clause
// Does a restless world get energy out of a set of contacts? 1 to 16 planes that appear, jump, turn and
// vanish every 30 ticks, smooth and rough, on time and a tick late, against every adversary. And does it out
// of what people would do otherwise: a ledger for each contact, or none?
#include "quiet.hpp"
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>
#include <passive_haptics/simulation/challenge.hpp>

namespace contacts {

namespace {

constexpr ph::proxy_spring press{.mass = 0.1};
constexpr ph::pursuit hasty{.speed = 0.5, .turn_rate = 20.0};

/// Tells the slots of a port, every 30 ticks, of planes round where the device is.
struct restless {
  ph::laws::samples random{1};
  int tick = 0;
  double stiffness = 1e4;

  template <class Update, class Release>
  void tell(const vector& here, int count, const Update& update, const Release& release) {
    if (tick++ % 30 != 0) return;
    for (int i = 1; i < count; ++i) {
      const double what = random.number<double>();
      if (what < -0.5) {
        release(i);
      } else if (what < 0.7) {
        const vector n = random.direction<d3>();
        update(i, plane{vector(here + n * (2e-3 * random.number<double>())), n, stiffness});
      }
    }
  }
};

/// All contacts in one port.
template <class Port, int Count>
struct one_port {
  using space_type = d3;
  static constexpr int count = Count;
  Port port;
  restless world{};

  vector tick(const ph::device_sample<d3>& sample) {
    auto& source = port.source();
    world.tell(
        sample.position, Count, [&](int i, const plane& p) { source.update(i, p); },
        [&](int i) { source.release(i); });
    return port.tick(sample).force;
  }
  bool lay(const plane& first) { return port.source().update(0, first); }
};

/// A port for each, which is what the sets are there to replace: each spends the same damping.
template <class Port, int Count>
struct port_each {
  using space_type = d3;
  std::array<Port, static_cast<std::size_t>(Count)> ports;
  restless world{};

  explicit port_each(const Port& one) { ports.fill(one); }
  vector tick(const ph::device_sample<d3>& sample) {
    world.tell(
        sample.position, Count,
        [&](int i, const plane& p) { ports[static_cast<std::size_t>(i)].source().update(0, p); },
        [&](int i) { ports[static_cast<std::size_t>(i)].source().release(0); });
    vector sum = vector::Zero();
    for (auto& port : ports) {  // each is told what it commanded itself
      sum += sample.valid ? vector(port.tick(sample.position, ph::seconds{sample.dt}).force)
                          : vector(port.tick(sample).force);
    }
    return sum;
  }
  bool lay(const plane& first) { return ports[0].source().update(0, first); }
};

constexpr auto lay = [](auto& model, const sim::surface_state<d3>& s) {
  model.world.stiffness = s.stiffness;
  return model.lay(plane{s.point, s.normal, s.stiffness});
};

enum class carried : std::uint8_t { one_ledger, ledger_each, nothing };
const char* to_string(carried c) {
  switch (c) {
    case carried::one_ledger:
      return "one ledger";
    case carried::ledger_each:
      return "a ledger each";
    case carried::nothing:
      return "no bound";
  }
  return "";
}

struct passive_row {
  int contacts = 3;
  bool rough = false;
  bool reachable = false;
  int latency = 0;
  carried by{};
  int runs = 1000;
  double jitter = 0.0;        ///< share of a tick by which one is shorter than another, at most
  double least_energy = 0.0;  ///< [J]
  std::string worst{};
  double largest_force = 0.0;  ///< [N]
  int seed = 1;                ///< of the attacks, and of the hands that hold still
  ex::at_rest still{};         ///< in such a hand, after a world that was restless
};
ex::record record_of(const passive_row& r) {
  return ex::with({{"contacts", r.contacts},
                   {"rough", r.rough},
                   {"bound", r.by == carried::nothing ? "none"
                             : r.reachable            ? "reachable"
                                                      : "strict"},
                   {"late", r.latency},
                   {"carried_by", std::string(to_string(r.by))},
                   {"jitter", r.jitter},
                   {"runs", r.runs},
                   {"least_energy_J", r.least_energy},
                   {"worst", r.worst},
                   {"largest_force_N", r.largest_force, "%.1f"}},
                  r.still);
}

/// The adversaries never hold still. So a relaxed hand presses onto a plane, among others that appear, jump, turn and
/// vanish round the device for 0.6 s and then stay as they are.
template <int Late, class Port, int Count>
void hold_after_news(passive_row& row, const one_port<Port, Count>& model) {
  const auto seed = static_cast<std::uint64_t>(row.seed) << 32U;
  for (std::uint64_t i = 0; i < 12; ++i) {
    draws d(seed + i);
    one_port<Port, Count> pressed = model;
    pressed.world.random = ph::laws::samples(seed + i + 1000);
    pressed.world.stiffness = d.scale(300.0, 20e3);
    pressed.lay(plane{vector(0.0, 0.0, 0.0), vector(0.0, 0.0, 1.0), pressed.world.stiffness});
    held_point::parameters p{.damping = damping, .hand = still_hands[1]};
    p.mass = d.scale(0.1, 0.4);  // the hand alone takes 4 s at most to bring 0.2 m/s to 1 mm/s
    p.goal = 3e-3 * d.direction() - vector(0.0, 0.0, d.between(5e-3, 15e-3));
    p.load = 0.3 * d.direction() - vector(0.0, 0.0, d.between(0.5, 2.0));
    p.start = vector(0.0, 0.0, 2e-3);
    auto& port = pressed.port;
    const auto world = [&](int tick, const vector& here) {
      if (tick >= 600) return false;
      pressed.world.tell(
          here, Count, [&](int at, const plane& to) { port.source().update(at, to); },
          [&](int at) { port.source().release(at); });
      return true;
    };
    vector end;
    const quiet_run run = held_still<Late>(port, Count, p, world, &end, row.jitter);
    if (row.by == carried::one_ledger) {
      row.least_energy = std::min(row.least_energy, run.least_energy);
    }
    if (!run.counts()) continue;
    row.still.add(
        run.settling, run.missed, run.last,
        run.settling <= in_time ? stiffness_at_rest(port, Count, end) : ex::rest_stiffness{});
  }
}

template <class Model>
passive_row challenged(passive_row row, const Model& model) {
  const sim::circumstances world{.latency = row.latency, .watchdog = false, .ticks = 600};
  const auto attack = [&](sim::adversary by, int runs) {
    const auto v =
        sim::challenge(model, by, world, runs, static_cast<std::uint64_t>(row.seed) << 32U, lay);
    row.largest_force = std::max(row.largest_force, v.largest_force);
    if (!(v.least_energy >= row.least_energy)) {
      row.least_energy = v.least_energy;
      row.worst = to_string(by);
    }
  };
  std::vector<sim::adversary> all;
  for (const auto by : sim::all_adversaries) {
    const bool covered = sim::is_force_limited(by);  // what a conditional promise holds for
    const bool late = by == sim::adversary::overruns || by == sim::adversary::kitchen_sink;
    if (!late && (covered || !row.reachable)) all.push_back(by);
  }
  for (const auto by : all) attack(by, std::max(1, row.runs / static_cast<int>(all.size())) + 1);
  return row;
}

template <int Count, class Friction, class Bound, class Limits>
passive_row judge(const passive_row& row, const Friction& friction, const Bound& bound,
                  const Limits& limits) {
  const ph::reduced_energy ledger{.damping = damping};
  if (row.by == carried::one_ledger) {
    ph::passive_port port{d3{}, ph::contact_set{press, hasty, friction, ph::slots<plane, Count>{}},
                          ledger, bound, limits};
    const one_port<decltype(port), Count> all{port};
    passive_row found = challenged(row, all);
    hold_after_news<Limits::latency>(found, all);
    return found;
  }
  if (row.by == carried::nothing) {
    ph::passive_port port{d3{}, ph::contact_set{press, hasty, friction, ph::slots<plane, Count>{}},
                          ph::no_observer{}, ph::no_bound{}, limits};
    const one_port<decltype(port), Count> all{port};
    passive_row found = challenged(row, all);
    hold_after_news<Limits::latency>(found, all);
    return found;
  }
  ph::passive_port port{d3{}, ph::contact_set{press, hasty, friction, ph::slots<plane, 1>{}},
                        ledger, bound, limits};
  return challenged(row, port_each<decltype(port), Count>(port));
}

template <int Count, class Friction>
passive_row judge(const passive_row& row, const Friction& friction) {
  const ph::reachable_bound reachable{.mass = 0.1, .hand_force = hand_force};
  const ph::loop_limits now{.longest_tick = T, .top_speed = 100.0};
  const ph::late_loop_limits<1> late{.longest_tick = T, .top_speed = 100.0};
  if (row.latency > 0) {
    return row.reachable ? judge<Count>(row, friction, reachable, late)
                         : judge<Count>(row, friction, ph::strict_bound{}, late);
  }
  return row.reachable ? judge<Count>(row, friction, reachable, now)
                       : judge<Count>(row, friction, ph::strict_bound{}, now);
}
template <int Count>
passive_row judge(const passive_row& row) {
  return row.rough ? judge<Count>(row, ph::stick_slip{}) : judge<Count>(row, ph::frictionless{});
}

}  // namespace

std::vector<std::string> run_passive(const session& s) {
  s.out.section(
      "Passive",
      "Planes that appear, jump, turn and vanish every 30 ticks, against the adversaries "
      "that the promise of the bound covers. The least true energy at the port; controls: "
      "a ledger for each contact, and none. No adversary holds still, so in 12 more runs, drawn "
      "with --seed " +
          std::to_string(s.chosen.seed) +
          ", a relaxed hand (100 N/m, 1 N·s/m) presses 0.1 to 0.4 kg, of which 0.1 kg are told, "
          "while the world goes on so for 0.6 s and then stays as it is. With jitter, each of "
          "the ticks of these runs is shorter than the longest by up to that share." +
          ex::quiet_columns);
  std::vector<passive_row> jobs;
  const int runs = s.chosen.quick ? 60 : 1200;
  for (const int n : {1, 3, 16}) {
    for (const bool rough : {false, true}) {
      for (const bool reachable : {false, true}) {
        for (const int latency : {0, 1}) {
          jobs.push_back({n, rough, reachable, latency, carried::one_ledger, runs});
        }
      }
    }
  }
  for (const double jitter : {0.05, 0.5}) {
    for (const bool reachable : {false, true}) {
      jobs.push_back({3, false, reachable, 0, carried::one_ledger, runs, jitter});
    }
  }
  for (const bool reachable : {false, true}) {
    jobs.push_back({3, false, reachable, 0, carried::ledger_each, 1200});
  }
  jobs.push_back({3, false, false, 0, carried::nothing, runs});
  jobs.push_back({3, true, false, 0, carried::nothing, runs});
  for (auto& job : jobs) job.seed = s.chosen.seed;
  const auto rows = s.rows("passive.csv", "passive", jobs, [](const passive_row& r) {
    return r.contacts == 1 ? judge<1>(r) : r.contacts == 3 ? judge<3>(r) : judge<16>(r);
  });
  ex::show_rows(s.out, "passive", rows);

  std::vector<std::string> found;
  for (const auto& r : rows) {
    const std::string name =
        std::to_string(r.contacts) + " contacts, " + to_string(r.by) + ", " + r.worst;
    if (r.by == carried::one_ledger) {
      expect(found, r.least_energy >= -1e-12, name + ": loses energy");
      expect(found, r.largest_force > 0.1, name + ": never pushes");
      expect(found, r.still.all_quiet(), name + ": quiet in " + r.still.share());
    } else {
      expect(found, r.least_energy < -1e-4, name + ": the control loses nothing");
    }
  }
  return found;
}

}  // namespace contacts
