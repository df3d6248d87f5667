// SPDX-License-Identifier: BSD-3-Clause
// A hand at a device, a wall on another machine, and everything that a network and a server can do in
// between, in virtual time. Judged by the true energy of the hand's port.
#include "../bench/organ/remote_scenes.hpp"
#include "support/catch.hpp"

#include <vector>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace remote = ph::remote;
using namespace far_wall;

namespace {

constexpr double nothing = 1e-12;  // [J], rounding

/// A local model that notes what its ticks tell.
struct noting_touch {
  decltype(passive_touch()) model = passive_touch();
  std::vector<ph::event>* events;
  std::vector<double>* forces;

  bool update(const plane& p) noexcept { return model.update(p); }
  auto tick(const ph::device_sample<scene>& sample) noexcept {
    const auto out = model.tick(sample);
    events->push_back(out.what);
    forces->push_back(out.force(2));
    return out;
  }
};

/// The same without a ledger and a bound: what such a surface does by itself.
auto unbounded_touch() {
  return ph::local_model{scene{},
                         ph::followed<plane>{},
                         ph::turn_at_once{},
                         ph::spring{},
                         ph::no_observer{},
                         ph::no_bound{},
                         ph::loop_limits{.longest_tick = tick}};
}

sim::channel_parameters any_way(sim::random_source& random) {
  return {.delay = random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.2),
          .jitter = random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.1),
          .loss = random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.9),
          .duplication = random.chance(0.5) ? 0.0 : random.uniform(),
          .in_order = random.chance(0.3)};
}

/// What somebody who has the session, the server itself first of all, may tell: walls that jump at the hand,
/// of any stiffness, and turn.
remote::content any_lie(sim::random_source& random) {
  const auto n = random.direction<scene>();
  return remote::content_of(plane{{0.0, 0.0, random.uniform(-0.03, 0.03)},
                                  random.chance(0.5) ? vector(0.0, 0.0, 1.0) : vector(n),
                                  std::pow(10.0, random.uniform(0.0, 7.0))});
}

/// Tells the client so, as the server would.
void tell(connection& line, const remote::content& lie, int n) {
  if (!line.asked) return;
  (void)line.client.receive(line.server.answer(lie, *line.asked), clock_of(n * tick));
}

}  // namespace

TEST_CASE("a wall on another machine is felt as it is over four networks, and creates nothing",
          "[remote][passivity]") {
  double last = 0.0;
  for (const auto& [name, way] : networks) {
    INFO(name);
    const auto still = surface_at_hand(way, {0.0}, 1), heaving = surface_at_hand(way, {3e-3}, 1);
    CHECK(still.created <= nothing);
    CHECK(heaving.created <= nothing);
    CHECK(still.least_ledger >= 0.0);
    CHECK(still.force == Approx(8.0).epsilon(1e-3));  // 2000 z = 500 (20 mm − z)
    CHECK(still.error < 1e-3);
    // The wall is where it was when it was asked for, and 8.5 ms on the mean for the next news: a hand of
    // 500 N/m feels a fifth of K h ω of it, 42 N/s.
    CHECK(heaving.error > last);
    CHECK(heaving.error < 42.0 * (heaving.age + 0.0085));
    last = heaving.error;
    CHECK(bare_force(way, {0.0}, 1).created > 10.0);
  }
}

TEST_CASE(
    "whatever the network does, and however often the server is restarted, nothing is created",
    "[remote][passivity]") {
  int told = 0;
  double bare = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    sim::random_source random(seed);
    const auto way = any_way(random);
    const heaving_wall wall{random.uniform(0.0, 5e-3)};
    const auto restarts = [&random](int, connection& line) {
      if (random.chance(1e-3)) line.restart_server();
    };
    const auto felt = surface_at_hand(way, wall, seed, restarts);
    INFO("seed " << seed);
    CHECK(felt.created <= nothing);
    CHECK(felt.least_ledger >= 0.0);
    told += felt.told > 20;
    bare += bare_force(way, wall, seed).created;
  }
  CHECK(told > 20);     // or nothing was tried
  CHECK(bare > 100.0);  // J, all of them together
}

TEST_CASE("a server that lies makes the wall another, and credits nothing", "[remote][passivity]") {
  double unbounded = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    sim::random_source random(seed);
    const auto lies = [&random](int n, connection& line) {
      if (random.chance(0.02)) tell(line, any_lie(random), n);
    };
    const auto felt = surface_at_hand({.delay = 0.005}, {0.0}, seed, lies);
    INFO("seed " << seed);
    CHECK(felt.created <= nothing);
    CHECK(felt.least_ledger >= 0.0);
    unbounded += surface_at_hand({.delay = 0.005}, {0.0}, seed, lies, unbounded_touch()).created;
  }
  CHECK(unbounded > 40.0);  // a joule each
}

TEST_CASE("datagrams without the session change nothing at all", "[remote]") {
  const sim::channel_parameters way{.delay = 0.025, .jitter = 0.01, .loss = 0.1};
  const auto alone = surface_at_hand(way, {3e-3}, 1);
  std::uint64_t refused = 0;
  const auto disturbed = surface_at_hand(
      way, {3e-3}, 1, [&, random = sim::random_source(9)](int n, connection& line) mutable {
        const auto t = clock_of(n * tick);
        remote::message m{.kind = static_cast<remote::kind>(random.bits() % 6 + 1),
                          .key = random.bits(),
                          .session = random.bits(),
                          .sequence = static_cast<std::uint32_t>(random.bits()),
                          .stamp = t,
                          .content = any_lie(random)};
        auto bytes = remote::encode(m);
        (void)line.client.receive(bytes, t);
        (void)line.client.receive(std::span(bytes).first(random.bits() % 152), t);
        bytes[random.bits() % 152] ^= std::byte{4};
        (void)line.client.receive(bytes, t);
        m.kind = remote::kind::question;
        (void)line.server.receive(remote::encode(m), {}, t);
        refused = line.client.counted().refused();
      });
  CHECK(refused >= 3 * ticks_of_a_run);
  CHECK(disturbed.force == alone.force);  // to the bit
  CHECK(disturbed.error == alone.error);
  CHECK(disturbed.told == alone.told);
  const auto told = surface_at_hand(way, {3e-3}, 1, [](int n, connection& line) {
    if (n == 4000) tell(line, remote::content_of(plane{{0, 0, 9e-3}, {0, 0, 1}, 900.0}), n);
  });
  CHECK(told.error != alone.error);  // the control: of the session
}

TEST_CASE("while a server is away the last good surface stays until it is stale, and comes back",
          "[remote][passivity]") {
  std::vector<ph::event> events;
  std::vector<double> forces;
  std::uint32_t sessions = 0;
  const sim::channel_parameters way{.delay = 0.025}, cut{.loss = 1.0};
  const int end = 5000;
  const auto felt = surface_at_hand(
      way, {0.0}, 1,
      [&](int n, connection& line) {
        if (n == 2000) line.restart_server();                           // at once
        if (n == 3000) line.to_server = decltype(line.to_server)(cut);  // for 2 s
        if (n == end) line.restart_server(), line.to_server = decltype(line.to_server)(way);
        sessions = line.client.sessions();
      },
      noting_touch{.events = &events, .forces = &forces});
  CHECK(felt.created <= nothing);
  CHECK(sessions == 3);
  const auto at = [](int ms) { return static_cast<std::size_t>(ms); };
  // A restart is not felt, nor a second of silence: half of one the server goes on telling of what was asked
  // last, and another one the surface may be stale.
  for (int n = 1900; n < 3950; ++n) {
    INFO(n << " ms");
    CHECK(events[at(n)] == ph::event::nominal);
    CHECK(forces[at(n)] == Approx(8.0).margin(0.01));
  }
  for (int n = 4050; n < end; ++n) {
    INFO(n << " ms");
    CHECK(events[at(n)] == ph::event::stale_target);
    CHECK(forces[at(n)] == 0.0);
  }
  CHECK(events.back() == ph::event::nominal);
  CHECK(forces.back() > 7.0);  // it is pushed out as fast as what it has paid for allows
}

TEST_CASE("where both ends count, what both were lent is all that is created, in each session",
          "[remote][two_port][passivity]") {
  constexpr double lent = 1e-3;
  double alone = 0.0;
  for (const auto& [name, way] : networks) {
    INFO(name);
    const auto once = both_ends_count(way, {0.0}, 1);
    CHECK(once.created <= lent + nothing);
    CHECK(once.least_ledger >= -nothing);
    CHECK(once.force > 0.1);  // something is felt
    std::uint32_t sessions = 0;
    const auto restarts = [&](int n, connection& line) {
      if (n % 1000 == 999) line.restart_server();
      sessions = line.client.sessions();
    };
    const auto often = both_ends_count(way, {0.0}, 1, restarts);
    CHECK(sessions >= 5);
    CHECK(often.created <= sessions * lent + nothing);
    CHECK(often.least_ledger >= -nothing);
    // The control: what the hand has promised is spent again in every session.
    alone += both_ends_count(way, {0.0}, 1, restarts, false).created;
  }
  CHECK(alone > 0.05);
}

TEST_CASE("a two-port believes the energy that it is told, so its network has to be trusted",
          "[remote][two_port][passivity]") {
  // A thousand joules in one datagram, and a force that has the hand swing.
  const auto lies = [](int n, connection& line) {
    if (n < 1000) return;
    const double push = n / 100 % 2 == 0 ? 20.0 : -20.0;
    tell(line, remote::content_of(remote::probe{.force = {0, 0, push}, .energy = 1000.0}), n);
  };
  const auto honest = [](int n, connection& line) {
    if (n < 1000) return;
    const double push = n / 100 % 2 == 0 ? 20.0 : -20.0;
    tell(line, remote::content_of(remote::probe{.force = {0, 0, push}}), n);
  };
  CHECK(both_ends_count({.delay = 0.005}, {0.0}, 1, lies).created > 1.0);
  CHECK(both_ends_count({.delay = 0.005}, {0.0}, 1, honest).created <= 1e-3 + nothing);
}
