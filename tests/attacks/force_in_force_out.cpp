// SPDX-License-Identifier: BSD-3-Clause
// Force in, force out: somebody's renderer behind a port, on time and late, and what becomes of those
// who do without one or keep the books by hand.
#include "attacks/challenged.hpp"
#include <passive_haptics/compositions.hpp>

#include <algorithm>
#include <array>
#include <utility>

using namespace simulated;

namespace {

constexpr sim::circumstances stiff{.softest = 1e4, .stiffest = 1e4};

sim::circumstances late(int ticks) {
  sim::circumstances world = stiff;
  world.latency = ticks;
  return world;
}

/// Somebody's renderer: a spring wall of 10 kN/m.
template <class Space>
struct spring_wall {
  sim::surface_state<Space> surface{};

  typename Space::vector force(const typename Space::vector& x) const {
    return surface.normal * (1e4 * std::max(0.0, surface.depth(x)));
  }
};

/// Puts the surface of an adversary into the renderer of any of the loops below.
constexpr auto lay = [](auto& loop, const auto& surface) {
  loop.wall.surface = surface;
  return true;
};

/// The renderer alone. It keeps its force while no sample comes.
template <class Space>
struct bare {
  using space_type = Space;
  spring_wall<Space> wall{};
  typename Space::vector last = Space::zero();

  typename Space::vector tick(const ph::device_sample<Space>& sample) {
    if (sample.valid) last = wall.force(sample.position);
    return last;
  }
};

/// The renderer behind a port, which is told what was held, or is not.
template <class Port>
struct guarded {
  using space_type = typename Port::port_type;
  Port port;
  bool reports_held = true;
  spring_wall<space_type> wall{};

  auto tick(const ph::device_sample<space_type>& sample) {
    if (reports_held) return port.tick(sample, wall.force(sample.position));
    if (!sample.valid) return port.tick(sample);
    return port.tick(sample.position, ph::seconds{sample.dt}, wall.force(sample.position));
  }
};

template <class Space, int k, class Source = ph::given_force>
constexpr auto port_late_by(const Source& source = {}) {
  return ph::passive_port{Space{}, source, thesis_ledger<Space>(), ph::strict_bound{},
                          ph::late_loop_limits<k>{.longest_tick = 1e-3, .watchdog = 1e-3}};
}
constexpr ph::settled_force settling{.mass = 0.1};

template <class Port>
void survives_reported_or_not(const Port& port, int ticks_late, int runs) {
  for (const bool reports : {true, false}) {
    CAPTURE(Port::port_type::dof, ticks_late, reports);
    survives(sim::challenge_all(guarded<Port>{port, reports}, late(ticks_late), runs, 1, lay));
  }
}

/// Passivity by hand, in a dozen lines: E += b Δx²/dt − f·Δx, |f| ≤ √(4 b/T (E − what is on its way)).
/// `pairs` says which command f is: 0 the last one, 1 the one before it, ...; −1 the new one.
struct by_hand {
  using space_type = d1;
  int ticks_late = 0;
  int pairs = 0;
  spring_wall<d1> wall{};
  double energy = 0.0, last = 0.0;
  bool seen = false;
  std::array<double, 6> commands{};

  double tick(const ph::device_sample<d1>& sample) {
    const double x = sample.position, b = 0.03, T = 1e-3;
    const double moved = seen ? x - last : 0.0;
    const double wanted = wall.force(x);
    const double held = pairs < 0 ? wanted : commands[static_cast<std::size_t>(pairs)];
    energy += b * moved * moved / sample.dt - held * moved;
    last = x;
    seen = true;
    double credit = energy;
    for (int j = 0; j < ticks_late; ++j) {
      credit -= commands[static_cast<std::size_t>(j)] * commands[static_cast<std::size_t>(j)] * T /
                (4 * b);
    }
    const double most = ph::kernels::strict_force_bound(credit, b / T);
    std::rotate(commands.begin(), commands.end() - 1, commands.end());
    return commands[0] = std::clamp(wanted, -most, most);
  }
};

/// How much an adversary gets out of it, at worst [J].
double out_of(const by_hand& loop, by adversary) {
  return sim::challenge(loop, adversary, late(loop.ticks_late), 20, 1, lay).least_energy;
}

bool about(double energy, double said) {
  return energy < said / 2.0 && energy > said * 2.0;
}

}  // namespace

TEST_CASE("a renderer behind a port loses nothing, on time or late, held force reported or not",
          "[adversaries][law]") {
  survives_reported_or_not(port_late_by<d1, 0>(), 0, 10);
  survives_reported_or_not(port_late_by<d1, 1>(), 1, 10);
  survives_reported_or_not(port_late_by<d1, 2>(), 2, 10);
  survives_reported_or_not(port_late_by<d1, 3>(), 3, 10);
  survives_reported_or_not(port_late_by<d3, 2>(), 2, 4);
}

TEST_CASE("a settled_force behind a strict bound loses nothing to any adversary, on time or late",
          "[adversaries][law]") {
  survives_reported_or_not(port_late_by<d1, 0>(settling), 0, 10);
  survives_reported_or_not(port_late_by<d1, 2>(settling), 2, 10);
  survives_reported_or_not(port_late_by<d3, 0>(settling), 0, 4);
  survives_reported_or_not(port_late_by<d3, 1>(settling), 1, 4);
}

TEST_CASE("make_guard loses nothing to the hands that it is told of, and does to stronger ones",
          "[adversaries]") {
  const auto least = [](const auto& guard, int ticks_late, double hand_force, by adversary) {
    sim::circumstances world = late(ticks_late);
    world.watchdog = false;
    world.hand_force = hand_force;
    using port = std::remove_cvref_t<decltype(guard)>;
    const auto v = sim::challenge(guarded<port>{guard}, adversary, world, 40, 1, lay);
    CHECK(v.largest_force > 0.1);
    return v.least_energy;
  };
  // 50 N throw 0.1 kg about at more than 5 m/s; refused as a fault of the sensor, that would be forgiven.
  constexpr ph::exact_device told{
      .mass = 0.1, .damping = 0.03, .force_limit = 50.0, .top_speed = 100.0};
  constexpr ph::exact_device told_late{
      .mass = 0.1, .damping = 0.03, .force_limit = 50.0, .latency = 1, .top_speed = 100.0};
  constexpr ph::known_hand fair{.force = 5.0};
  using late_one = ph::late_loop_limits<1>;
  for (const by hand : {by::tapping, by::random_tapping, by::trembling}) {
    CAPTURE(to_string(hand));
    CHECK(least(ph::make_guard<d1>(told, fair), 0, 5.0, hand) >= -1e-12);
    CHECK(least(ph::make_guard<d1, late_one>(told_late, fair), 1, 5.0, hand) >= -1e-12);
    CHECK(least(ph::make_guard<d3>(told, fair), 0, 5.0, hand) >= -1e-12);
  }
  CHECK(least(ph::make_guard<d1>(told, fair), 0, 40.0, by::tapping) < -1e-4);
  CHECK(least(ph::make_guard<d1>(told, fair), 0, 5.0, by::greedy) < -1e-4);  // is no hand
}

TEST_CASE("the same renderer without a port loses to every adversary", "[adversaries]") {
  for (const int ticks_late : {0, 1, 2, 3}) {
    for (const sim::verdict& v : sim::challenge_all(bare<d1>{}, late(ticks_late), 10, 1, lay)) {
      CAPTURE(ticks_late, to_string(v.by), v.least_energy);
      CHECK(v.least_energy < -1e-3);
    }
  }
}

TEST_CASE("a retrofit by hand loses if it pairs the new force with the motion that is over (L2)",
          "[adversaries]") {
  CHECK(about(out_of({.pairs = -1}, by::nyquist), -2.7));
  CHECK(about(out_of({.pairs = -1}, by::greedy), -0.17));
  CHECK(about(out_of({.pairs = -1}, by::jitter), -0.076));
  CHECK(out_of({.pairs = -1}, by::tapping) < -0.01);
  CHECK(about(out_of({.pairs = 1}, by::greedy), -5.9e-3));  // and the one before the last no less
  for (const by adversary : {by::nyquist, by::greedy, by::random_walk, by::jitter, by::tapping}) {
    CHECK(out_of({.pairs = 0}, adversary) >= -1e-12);  // the control: rightly paired
  }
}

TEST_CASE("the late form cannot be paired wrong, where a retrofit by hand can", "[adversaries]") {
  struct wrong {
    int ticks_late, pairs;
    double loss;
  };
  // By hand: what is on its way is paid for in all of them, and only the pairing is off.
  for (const wrong& said :
       {wrong{1, -1, -0.136}, wrong{1, 0, -5.5e-3}, wrong{1, 2, -5.7e-3}, wrong{2, -1, -0.102},
        wrong{2, 0, -3.3e-3}, wrong{2, 1, -3.0e-3}, wrong{2, 3, -4.4e-3}, wrong{3, -1, -0.109},
        wrong{3, 2, -2.8e-3}, wrong{3, 4, -3.0e-3}}) {
    const double lost = out_of({.ticks_late = said.ticks_late, .pairs = said.pairs}, by::greedy);
    CAPTURE(said.ticks_late, said.pairs, lost);
    CHECK(about(lost, said.loss));
  }
  for (const int k : {1, 2, 3}) {
    for (const by adversary : {by::nyquist, by::greedy, by::random_walk, by::jitter, by::tapping}) {
      CHECK(out_of({.ticks_late = k, .pairs = k}, adversary) >= -1e-12);  // rightly paired
    }
  }
  // The port has no place to get it wrong: it keeps its commands, and takes a reported one as held.
  // It is shown the same adversaries above.
}

namespace {

/// A hand presses with 3 N against 1 N of a renderer that falls silent after half a second and, with
/// `comes_back`, is heard again every 50 ms.
struct silence {
  std::array<double, 1000> force{};
  std::array<ph::event, 1000> what{};
  double least_energy = 0.0;
};
silence fall_silent(const ph::given_force& rule, bool comes_back = false) {
  ph::passive_port port{d1{}, rule, thesis_ledger(), ph::strict_bound{}, thesis_loop};
  sim::device<d1, sim::constant_hand<d1>> device({}, {.push = -3.0});
  silence seen;
  int tick = 0;
  const auto loop = [&](const auto& sample) {
    const bool speaks = tick < 500 || (comes_back && tick % 50 == 0);
    ++tick;
    return speaks ? port.tick(sample, 1.0) : port.tick(sample);
  };
  const auto note = [&](const auto& now) {
    seen.force[static_cast<std::size_t>(now.tick)] = now.force;
    seen.what[static_cast<std::size_t>(now.tick)] = now.out.what;
  };
  seen.least_energy = sim::run(device, loop, 1000, sim::idle, sim::idle, note).least_energy;
  return seen;
}

}  // namespace

TEST_CASE("the force of a renderer that has stopped fades, and the ticks say so", "[adversaries]") {
  const silence usual = fall_silent({});
  CHECK(usual.least_energy >= -1e-12);
  CHECK(usual.force[499] == 1.0);
  CHECK(usual.force[598] == 1.0);  // 99 ms after its last word
  CHECK(usual.what[598] == ph::event::nominal);
  CHECK_THAT(usual.force[624], Catch::Matchers::WithinAbs(0.5, 1e-9));  // 125 ms
  CHECK(usual.what[624] == ph::event::stale_target);
  CHECK(usual.force[650] == 0.0);
  CHECK(usual.force[999] == 0.0);
  CHECK(usual.what[999] == ph::event::stale_target);

  const silence slow = fall_silent({}, true);  // one that is only slow is not cut
  CHECK(slow.force[999] == 1.0);
  CHECK(slow.what[999] == ph::event::nominal);
  const silence trusting = fall_silent({.stale_after = std::numeric_limits<double>::infinity()});
  CHECK(trusting.force[999] == 1.0);  // the control: it would push for ever
  CHECK(trusting.what[999] == ph::event::nominal);
}
