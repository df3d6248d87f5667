// SPDX-License-Identifier: BSD-3-Clause
// The yardsticks of bench/cost measure what they say: a tick written by hand returns the same bits
// as the composed one.
#include "../bench/cost/scenes.hpp"
#include "support/catch.hpp"

#include <cstring>
#include <random>

namespace {

namespace ph = passive_haptics;
using random_bits = std::mt19937_64;

double between(random_bits& random, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(random);
}
bool once_in(random_bits& random, int n) {
  return random() % static_cast<unsigned>(n) == 0;
}

/// Ordinary parameters, and now and then an odd one.
cost::settings any_settings(random_bits& random) {
  cost::settings s;
  s.damping = std::exp(between(random, -6, 1));
  s.loan = once_in(random, 3) ? between(random, 0, 0.01) : 0;
  s.longest_tick = once_in(random, 4) ? 0.9e-3 : 1e-3;
  s.top_speed = once_in(random, 4) ? 3 : 100;
  s.stiffness = std::exp(between(random, 0, 14));
  s.mass = std::exp(between(random, -5, 1));
  s.hand_force = between(random, 0, 10);
  s.force_limit = between(random, 0.5, 20);
  s.rate = std::exp(between(random, -2, 4));
  if (once_in(random, 4)) s.cap = between(random, 0, 1e-3);
  if (once_in(random, 4)) s.reset_after = between(random, 0, 0.05);
  if (once_in(random, 3)) s.stale_after = between(random, 0, 0.05);
  if (once_in(random, 40)) s.damping = -s.damping;
  if (once_in(random, 40)) s.longest_tick = std::nan("");
  return s;
}

/// A triangle under the origin, tilted at random; now and then upside down, or none at all.
cost::surface any_surface(random_bits& random) {
  cost::surface s{{-0.02, -0.02, 0}, {0.02, -0.02, 0}, {0, 0.03, 0}, 1};
  s.stiffness = std::exp(between(random, 3, 12));
  for (auto* node : {&s.a, &s.b, &s.c}) {
    for (double& x : *node) x += between(random, -4e-3, 4e-3);
  }
  if (once_in(random, 12)) std::swap(s.a, s.b);
  if (once_in(random, 20)) s.c = s.a;
  if (once_in(random, 20)) s.stiffness = once_in(random, 2) ? -1 : std::nan("");
  return s;
}

/// What one run met, so that the test can tell that it met everything.
struct met {
  long free = 0, contact = 0, limited = 0, debt = 0, late = 0, refused = 0, others = 0;
};

template <class Scalar>
void count(met& m, const cost::outcome<Scalar>& o) {
  ++(o.what == ph::event::late_tick         ? m.late
     : o.what == ph::event::rejected_sample ? m.refused
     : o.what == ph::event::debt            ? m.debt
     : o.what != ph::event::nominal         ? m.others
     : o.limited                            ? m.limited
     : o.depth > Scalar(0)                  ? m.contact
                                            : m.free);
}

template <class Scalar>
bool same_bits(const Scalar& a, const Scalar& b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof(Scalar)) == 0;
}
template <class Scalar>
bool same_bits(const cost::outcome<Scalar>& a, const cost::outcome<Scalar>& b) {
  return same_bits(a.force[0], b.force[0]) && same_bits(a.force[1], b.force[1]) &&
         same_bits(a.force[2], b.force[2]) && same_bits(a.depth, b.depth) &&
         same_bits(a.energy, b.energy) && a.what == b.what && a.limited == b.limited;
}

/// A hand that wanders about the origin, jumps, and a device that now and then reports nonsense.
struct wanderer {
  random_bits& random;
  std::array<double, 3> x{0, 0, 1e-3};
  std::array<double, 3> v{};
  double dt = 1e-3;

  void step() {
    dt = once_in(random, 10) ? between(random, 0.5e-3, 1.3e-3) : 1e-3;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] += between(random, -0.03, 0.03) - 0.02 * v[i] - 3 * x[i];
      x[i] += v[i] * dt;
    }
  }
  [[nodiscard]] std::array<double, 3> shown() {
    auto p = x;
    if (once_in(random, 200)) p[random() % 3] = std::nan("");
    if (once_in(random, 200)) p[random() % 3] = 1e30 * between(random, -1, 1);
    if (once_in(random, 200)) p[random() % 3] += 1;
    return p;
  }
  [[nodiscard]] double measured() {
    if (once_in(random, 300)) return once_in(random, 2) ? -dt : std::nan("");
    if (once_in(random, 300)) return std::numeric_limits<double>::infinity();
    return dt;
  }
};

/// Both sides through the same random runs; returns how many ticks differed.
template <class Scene>
long differences(std::uint64_t seed, met& found) {
  using S = typename Scene::scalar;
  random_bits random(seed);
  const cost::settings parameters = any_settings(random);
  auto composed = Scene::composed(parameters);
  auto by_hand = Scene::by_hand(parameters);
  wanderer hand{random};
  long different = 0;
  for (int n = 0; n < 400; ++n) {
    if (once_in(random, 20)) {
      const auto surface = any_surface(random);
      different += cost::retarget_any(composed, surface) != cost::retarget_any(by_hand, surface);
    }
    hand.step();
    // one axis is enough for the wall, and it is the one that the others press along
    auto x = hand.shown();
    if (Scene::space::dof == 1) x = {x[2], 0, 0};
    const S dt = cost::in<S>(hand.measured());
    const auto a = cost::outcome_of<S>(
        cost::advance(composed, cost::position_for<Scene, decltype(composed)>(x), dt));
    const auto b = cost::outcome_of<S>(
        cost::advance(by_hand, cost::position_for<Scene, decltype(by_hand)>(x), dt));
    different += !same_bits(a, b);
    count(found, a);
  }
  return different;
}

}  // namespace

TEMPLATE_TEST_CASE("a tick written by hand returns the bits of the composed one", "[cost]",
                   cost::wall<float>, cost::wall<double>, cost::half_space<float>,
                   cost::half_space<double>, cost::triangle<float>, cost::triangle<double>) {
  met found;
  long different = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    different += differences<TestType>(seed, found);
  }
  CHECK(different == 0);
  // the control: the runs went everywhere
  INFO("free " << found.free << ", contact " << found.contact << ", limited " << found.limited
               << ", debt " << found.debt << ", late " << found.late << ", refused "
               << found.refused << ", others " << found.others);
  CHECK(found.free > 1000);
  CHECK(found.contact > 1000);
  CHECK(found.limited > 1000);
  CHECK(found.late > 1000);
  CHECK(found.refused > 1000);
  CHECK(found.others > 100);
}
