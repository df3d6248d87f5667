// SPDX-License-Identifier: BSD-3-Clause
// Worlds that cannot be: corners without a free point, gaps narrower than nothing, surfaces that are none, ten
// thousand at once. Each is an event, or the nearest sound force; it steps by no more than news may, and rests.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/constraint_geometry/sphere.hpp>
#include <passive_haptics/contact/manifold.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/quiet.hpp>

#include <vector>

namespace sim = ph::simulation;
using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3, mass = 0.1;
constexpr int room = 12;
using plane = ph::half_space<d3>;
using walls = std::vector<plane>;

template <class Observer, class Bound>
auto set_behind(const Observer& ledger, const Bound& bound) {
  return ph::passive_port{
      d3{},
      ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{}, ph::slots<plane, room>{}},
      ledger, bound, ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
}
/// A device that begins between two walls has paid nothing yet: 1 mJ is lent, or the bound withholds the damper, too, and
/// a load of 0.04 N swings for longer than 6 s.
constexpr double loan = 1e-3;  // [J]
auto guarded_set() {
  return set_behind(ph::reduced_energy{.damping = 0.03, .loan = loan},
                    ph::reachable_bound{.mass = mass, .hand_force = 20.0});
}
auto open_set() {
  return set_behind(ph::no_observer{}, ph::no_bound{});
}
void tell(auto& port, const walls& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(port.source().update(static_cast<int>(i), all[i]));
  }
}

/// The wall with that normal, which has the origin `deep` behind it [m].
plane wall(const d3::vector& n, double deep, double K) {
  const d3::vector out = n.normalized();
  return {d3::vector(out * deep), out, K};
}
struct impossible {
  const char* name;
  walls all;
};
/// None of these has a free point near the origin.
std::vector<impossible> scenes(double K) {
  const double s = std::sqrt(3.0) / 2.0;
  std::vector<impossible> all{
      {"two plates that overlap", {wall({0, 0, 1}, 2e-3, K), wall({0, 0, -1}, 2e-3, K)}},
      {"one plane and its back", {wall({0, 0, 1}, 0.0, K), wall({0, 0, -1}, 0.0, K)}},
      {"a triangle without an inside",
       {wall({1, 0, 0}, 1e-3, K), wall({-0.5, s, 0}, 1e-3, K), wall({-0.5, -s, 0}, 1e-3, K)}},
      {"a slit that leans", {wall({0.01, 0, 1}, 1e-3, K), wall({0, 0.01, -1}, 1e-3, 0.1 * K)}}};
  walls box, copies;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      box.push_back(wall(side * d3::vector(d3::vector::Unit(axis)), 2.5e-3, K));
    }
  }
  for (int i = 0; i < room; ++i) copies.push_back(wall({0, 0, i % 2 == 0 ? 1.0 : -1.0}, 1e-3, K));
  all.push_back({"a box of less than no size", box});
  all.push_back({"twelve plates in one place", copies});
  return all;
}

struct hand {
  double stiffness = 0.0, damping = 0.0;
  [[nodiscard]] d3::vector force(double, const d3::vector& x, const d3::vector& v) const noexcept {
    return -stiffness * x - damping * v;
  }
  [[nodiscard]] static double mass() noexcept { return 0.0; }
  [[nodiscard]] static ph::parameter_fault check() noexcept { return {}; }
};
struct rest {
  bool quiet = false;
  double missed_force = 0.0, least_energy = 0.0;
};
/// Six seconds in that hand, pushed by the load: is the last tenth of them quiet?
rest left_alone(const hand& held, const d3::vector& load, const auto& ask, const walls& all) {
  sim::device<d3, hand> device({.mass = mass, .damping = 0.03, .load = load}, held);
  sim::quiet_judge<d3> judge;
  std::vector<d3::vector> pressing;
  auto sample = device.exchange(d3::zero());
  for (int n = 0; n < 6000; ++n) {
    const d3::vector f = ask(sample);
    pressing.clear();
    for (const plane& w : all) {
      if (w.at(device.position()).depth > 0.0) pressing.emplace_back(w.normal);
    }
    judge.add(f, d3::vector(device.velocity()), T, pressing);
    sample = device.exchange(f);
  }
  return {judge.quiet(), judge.figures().force, device.meter().minimum()};
}

}  // namespace

TEST_CASE("a corner without a free point holds a device between its walls, and is quiet",
          "[inconsistent][long]") {
  ph::laws::samples random(11);
  for (const double K : {500.0, 8000.0, 1e12}) {
    for (const impossible& scene : scenes(K)) {
      for (const hand& held : {hand{}, hand{100.0, 1.0}, hand{400.0, 6.0}}) {
        auto port = guarded_set();
        tell(port, scene.all);
        d3::vector load = random.vector<d3>() * 0.5;
        for (int axis = 0; axis < 3; ++axis) {  // where nothing holds it, nothing pushes it
          bool walled = held.stiffness > 0.0;
          for (const plane& w : scene.all)
            walled = walled || std::abs(d3::vector(w.normal)(axis)) > 0.3;
          if (!walled) load(axis) = 0.0;
        }
        CAPTURE(scene.name, K, held.stiffness, load(0), load(1), load(2));
        int events = 0;
        const auto set = [&](const auto& sample) {
          const auto out = port.tick(sample);
          events += out.what == ph::event::nominal ? 0 : 1;
          REQUIRE(d3::is_finite(out.force));
          return d3::vector(out.force);
        };
        const rest found = left_alone(held, load, set, scene.all);
        CHECK(found.quiet);
        CHECK(found.least_energy >= -loan);
        CHECK(events == 0);
      }
    }
  }
}

TEST_CASE("the sum of the springs of such a corner rings, where the set does not",
          "[inconsistent]") {
  int rings = 0;
  for (const impossible& scene : scenes(8000.0)) {  // the control
    const auto sum = [&](const auto& sample) {
      d3::vector f = d3::zero();
      for (const plane& w : scene.all) {
        f += std::max(0.0, w.at(sample.position).depth) * w.stiffness * d3::vector(w.normal);
      }
      return f;
    };
    rings += left_alone({}, {0.01, 0.02, 0.3}, sum, scene.all).quiet ? 0 : 1;
  }
  CHECK(rings >= 5);
}

TEST_CASE("an impossible corner that comes, goes and changes steps a held device by R dt",
          "[inconsistent]") {
  ph::laws::samples random(12);
  const double most = ph::pursuit{}.force_rate * T * (1.0 + 1e-9);
  for (const double K : {500.0, 8000.0, 1e12}) {
    auto port = open_set();
    d3::vector last = d3::zero();
    double step = 0.0, largest = 0.0;
    const auto all = scenes(K);
    for (int n = 0; n < 6000; ++n) {
      if (n % 33 == 0) {
        const impossible& next = all[random.bits() % all.size()];
        for (int i = 0; i < room; ++i) port.source().release(i);
        for (std::size_t i = 0; i < next.all.size(); ++i) {
          plane moved = next.all[i];
          moved.point = d3::vector(d3::vector(moved.point) + 1e-3 * random.vector<d3>());
          CHECK(port.source().update(static_cast<int>(i), moved));
        }
      }
      const d3::vector f = port.tick(d3::zero(), ph::seconds{T}).force;
      step = std::max(step, (f - last).norm());
      largest = std::max(largest, f.norm());
      last = f;
    }
    CAPTURE(K);
    CHECK(step <= most);
    CHECK(largest > 0.2);
  }
}

TEST_CASE("what is no surface is refused with an event, and the last good one stays",
          "[inconsistent]") {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const plane good = wall({0, 0, 1}, 0.0, 1000.0);
  auto port = open_set();
  REQUIRE(port.source().update(0, good));
  (void)port.tick({0, 0, 1e-3}, ph::seconds{T});
  for (int n = 0; n < 50; ++n) (void)port.tick({0, 0, -1e-3}, ph::seconds{T});
  const d3::vector before = port.tick({0, 0, -1e-3}, ph::seconds{T}).force;
  REQUIRE(before(2) > 0.9);
  const auto refused = [&](plane bad) {
    CHECK_FALSE(port.source().update(0, bad));
    const auto out = port.tick({0, 0, -1e-3}, ph::seconds{T});
    CHECK(out.what == ph::event::rejected_target);
    CHECK(out.force == before);
  };
  refused({{0, 0, 0}, {0, 0, 0}, 1000.0});
  refused({{0, 0, 0}, {nan, 0, 1}, 1000.0});
  refused({{0, 0, inf}, {0, 0, 1}, 1000.0});
  for (const double K : {0.0, -1.0, nan, inf}) refused({{0, 0, 0}, {0, 0, 1}, K});
  CHECK(port.tick({0, 0, -1e-3}, ph::seconds{T}).what == ph::event::nominal);  // the control

  CHECK(port.source().update(0, wall({0, 0, 1}, 0.0, 1e12)));  // as stiff as the sampling lets it
  double last = before(2), step = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double f = d3::vector(port.tick({0, 0, -1e-3}, ph::seconds{T}).force)(2);
    step = std::max(step, std::abs(f - last));
    last = f;
  }
  CHECK_THAT(last, WithinRel(0.95 * 0.1 * mass / (T * T) * 1e-3, 1e-6));
  CHECK(step <= ph::pursuit{}.force_rate * T * (1.0 + 1e-9));

  ph::passive_port balls{d3{},
                         ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{},
                                         ph::slots<ph::sphere<d3>, 2>{}},
                         ph::no_observer{}, ph::no_bound{}, thesis_loop};
  for (const double radius : {0.0, -1.0, nan}) {
    CHECK_FALSE(balls.source().update(0, ph::sphere<d3>{{0, 0, 0}, radius, 500.0}));
    CHECK(balls.tick({0, 0, 0}, ph::seconds{T}).what != ph::event::nominal);
  }
  CHECK(balls.source().update(0, ph::sphere<d3>{{0, 0, 0}, 1e-9, 500.0}));
  CHECK(d3::is_finite(balls.tick({0, 0, 0}, ph::seconds{T}).force));  // at its centre
}

TEST_CASE("of ten thousand surfaces in a frame the deepest are felt, without a step, and quiet",
          "[inconsistent]") {
  ph::laws::samples random(13);
  walls crowd;
  for (int i = 0; i < 10000; ++i) {
    crowd.push_back(wall(random.vector<d3>(), 3e-3 * random.number<double>(),
                         std::pow(10.0, 3.0 + random.number<double>())));
  }
  const double most = ph::pursuit{}.force_rate * T * (1.0 + 1e-9);
  auto port = open_set();
  ph::contact_manifold<plane, room> seen;
  d3::vector last = d3::zero();
  double step = 0.0;
  for (int n = 0; n < 400; ++n) {
    if (n % 33 == 0) {
      for (std::size_t i = crowd.size(); i > 1; --i)
        std::swap(crowd[i - 1], crowd[random.bits() % i]);
      (void)seen.show(port.source(), std::span<const plane>(crowd), d3::vector(d3::zero()));
    }
    const d3::vector f = port.tick(d3::zero(), ph::seconds{T}).force;
    REQUIRE(d3::is_finite(f));
    step = std::max(step, (f - last).norm());
    last = f;
  }
  CHECK(step <= most);
  CHECK(last.norm() > 0.0);

  auto guarded = guarded_set();
  ph::contact_manifold<plane, room> looks;
  (void)looks.show(guarded.source(), std::span<const plane>(crowd), d3::vector(d3::zero()));
  const auto set = [&](const auto& sample) { return d3::vector(guarded.tick(sample).force); };
  const rest found = left_alone({100.0, 1.0}, {0.2, -0.3, 0.1}, set, {});
  CHECK(found.quiet);
  CHECK(found.least_energy >= -loan);
}
