// SPDX-License-Identifier: BSD-3-Clause
// What a set of contacts leaves out of its ticks, since it is out of reach: nobody feels that.
#include "support/catch.hpp"
#include "support/contact_sets.hpp"
#include <passive_haptics/base/samples.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace {

constexpr double T = 1e-3;

}  // namespace

TEST_CASE("surfaces out of reach sleep, and nobody feels that they do", "[contact_set]") {
  constexpr int count = 64;
  constexpr double softness = ph::proxy_spring{}.softness;
  ph::laws::samples random(11);
  auto port = open_port<d3>(
      ph::contact_set{ph::proxy_spring{.mass = 0.1, .damping_ratio = 0.0, .softness = softness},
                      ph::pursuit{}, ph::slots<ph::half_space<d3>, count>{}});
  std::array<ph::half_space<d3>, count> walls;
  for (int i = 0; i < count; ++i) {  // a room of 64 walls, 20 to 180 mm away
    const auto n = random.direction<d3>();
    auto& wall = walls[static_cast<std::size_t>(i)];
    wall = {n * (-0.1 + 0.08 * random.number<double>()), n,
            std::pow(10.0, 3.0 + random.number<double>())};
    REQUIRE(wall.prepare());
    REQUIRE(port.source().update(i, wall));
  }
  d3::vector x = d3::zero();
  int slept = 0, pressed = 0;
  double worst = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const double t = n * T;  // up to 0.7 m/s
    x = std::min(0.06, 0.1 * t) *
        d3::vector(std::sin(7 * t), std::sin(5 * t + 1), std::sin(8 * t + 2));
    for (const auto& wall : walls) {  // the finger goes 1 mm deep, no deeper
      const auto here = wall.at(x);
      if (here.depth > 1e-3) x += here.outward() * (here.depth - 1e-3);
    }
    const d3::vector force = port.tick(x, ph::seconds{T}).force;
    ph::proxy_problem<d3::vector, double, count> all;
    for (int i = 0; i < count; ++i) {
      const auto& wall = walls[static_cast<std::size_t>(i)];
      slept += port.source().sleeps(i) ? 1 : 0;
      all.add(wall.at(x).outward(), port.source().slot(i).spring().compliance,
              port.source().slot(i).spring(), wall.at(x).depth, 0.0, 0.0);
    }
    ph::solve(all, [&all](std::size_t i, std::size_t j) {
      return (1.0 - softness) * all.row[i].dot(all.row[j]) *
             std::min(all.compliance[i], all.compliance[j]);
    });
    d3::vector truth = d3::zero();
    for (std::size_t i = 0; i < count; ++i) truth += all.row[i] * all.pressed[i];
    if (truth.norm() > 0.0) ++pressed;
    worst = std::max(worst, (force - truth).norm() / (1.0 + truth.norm()));
  }
  CHECK(pressed > 200);
  CHECK(slept > 2000 * count / 10);
  CHECK(worst < 1e-9);
}

TEST_CASE("what is far from the device and near its proxy presses, however many slots there are",
          "[contact_set]") {
  // Deep in a soft floor, in the wedge that it forms with what is over it.
  const auto wedge = [](auto port, double depth, double gap) {
    const d3::vector leans(-std::sqrt(1.0 - 0.81), 0, -0.9), deep(0, 0, -depth);
    std::vector<d3::vector> forces;
    const auto tick = [&](const d3::vector& x) {
      forces.push_back(port.tick(x, ph::seconds{T}).force);
    };
    REQUIRE(port.source().update(0, ph::half_space<d3>{d3::zero(), {0, 0, 1}, 300.0}));
    tick({0, 0, 1e-3});
    for (int n = 0; n <= 300; ++n) tick(d3::vector(deep * (n / 300.0)));
    REQUIRE(port.source().update(1, ph::half_space<d3>{deep - leans * gap, leans, 300.0}));
    for (int n = 0; n < 100; ++n) tick(deep);
    for (int n = 0; n <= 40; ++n) tick(deep + d3::vector(1e-4 * n, 0, 0));
    return forces;
  };
  const auto alike = [&](double depth, double gap) {
    const auto naps = wedge(planes<d3, 5>(), depth, gap),
               wakes = wedge(planes<d3, 4>(), depth, gap);
    for (std::size_t n = 0; n < naps.size(); ++n) {
      CAPTURE(depth, gap, n);
      REQUIRE((naps[n] - wakes[n]).norm() < 1e-9);
    }
    CHECK(naps.back().x() < -0.1);  // what is over it presses
  };
  alike(0.022, 0.0202);
  alike(0.030, 0.0262);
}

TEST_CASE("a surface that sleeps is there as soon as it is told to be where the device is",
          "[contact_set]") {
  const auto told = [](auto port) {
    std::vector<d3::vector> forces;
    for (int n = 0; n < 60; ++n) {
      if (n % 30 == 0) {
        const d3::vector at(0, 0, n == 0 ? -0.1 : 1e-3);
        REQUIRE(port.source().update(0, ph::half_space<d3>{at, d3::vector::UnitZ(), 300.0}));
      }
      forces.push_back(port.tick(d3::vector(d3::zero()), ph::seconds{T}).force);
    }
    return forces;
  };
  const auto naps = told(planes<d3, 5>());
  CHECK(naps == told(planes<d3, 4>()));
  CHECK(naps.back().z() > 0.2);
}

TEST_CASE("a set whose surfaces sleep has none once they are released, or all is reset",
          "[contact_set]") {
  for (const bool reset : {false, true}) {
    auto port = planes<d3, 5>();
    const auto what = [&] { return port.tick(d3::vector(d3::zero()), ph::seconds{T}).what; };
    REQUIRE(port.source().update(3, {d3::vector(0, 0, -0.1), d3::vector::UnitZ(), 300.0}));
    for (int n = 0; n < 60; ++n) CHECK(what() == ph::event::nominal);
    REQUIRE(port.source().sleeps(3));
    if (reset) {
      port.reset();
    } else {
      port.source().release(3);
    }
    CHECK_FALSE(port.source().sleeps(3));
    for (int n = 0; n < 60; ++n) CHECK(what() == ph::event::no_target);
  }
}

TEST_CASE("a surface that sleeps is stale when it is old enough, or 0.05 s later, and never before",
          "[contact_set]") {
  const double tick = 0x1p-10;  // 52 of which are more than 0.05 s
  for (const int told : {1, 20, 53, 60}) {
    for (int most = 30; most < 120; ++most) {  // ticks
      auto port = planes<d3, 5>({.stale_after = (most + 0.5) * tick});
      const auto what = [&] { return port.tick(d3::vector(0, 0, 0.1), ph::seconds{tick}).what; };
      const ph::half_space<d3> floor{d3::zero(), d3::vector::UnitZ(), 1000.0};
      REQUIRE(port.source().update(0, floor));
      for (int n = 0; n < told; ++n) (void)what();
      REQUIRE(port.source().update(0, floor));
      int age = 1;
      while (age < 300 && what() != ph::event::stale_target) ++age;
      CAPTURE(told, most, age);
      REQUIRE(age > most);
      REQUIRE(age <= most + 52);
    }
  }
}

namespace {

/// A floor that ends 10 mm from the middle, where it covers nothing.
struct tile : ph::half_space<d3> {
  using space_type = d3;
  struct seen {
    double depth;
    bool covers;
    [[nodiscard]] d3::vector outward() const noexcept { return d3::vector::UnitZ(); }
    [[nodiscard]] bool covered() const noexcept { return covers; }
  };
  [[nodiscard]] seen at(const d3::vector& x) const noexcept {
    return {ph::half_space<d3>::at(x).depth, std::abs(x.x()) < 0.01};
  }
};

}  // namespace

TEST_CASE("a surface that woke up beside its edge is met as soon as it is there", "[contact_set]") {
  const auto crossed = [](auto port) {
    tile floor{{d3::zero(), d3::vector::UnitZ(), 1000.0}};
    std::vector<d3::vector> forces;
    const auto tick = [&](double x, double z) {
      forces.push_back(port.tick(d3::vector(x, 0, z), ph::seconds{T}).force);
    };
    REQUIRE(port.source().update(0, floor));
    for (int n = 0; n < 100; ++n) tick(0.011, 0.05);  // far above, beside its edge
    for (int n = 0; n < 60; ++n) tick(0.0, 0.05);     // and above it, where it sleeps
    tick(0.011, -1e-3);
    for (int n = 0; n < 30; ++n) tick(0.009, -1e-3);
    return forces;
  };
  const auto with = [](auto room) {
    return open_port<d3>(ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, room});
  };
  const auto naps = crossed(with(ph::slots<tile, 5>{}));
  CHECK(naps == crossed(with(ph::slots<tile, 4>{})));
  CHECK(naps.back().z() > 0.9);
}

namespace {

int looks = 0;        ///< at the planes below
int looks_ahead = 0;  ///< at those that nobody has told yet
struct counted : ph::half_space<d3> {
  using space_type = d3;
  [[nodiscard]] probe at(const d3::vector& x) const noexcept {
    ++looks;
    looks_ahead += stiffness > 0.0 ? 0 : 1;
    return ph::half_space<d3>::at(x);
  }
};

}  // namespace

TEST_CASE("what sleeps is looked at twenty times in a second, whatever else is pressed",
          "[contact_set]") {
  auto port =
      open_port<d3>(ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{},
                                    ph::slots<counted, 7>{}, ph::slots<ph::half_space<d3>, 1>{}});
  const ph::half_space<d3> ground{d3::zero(), {0, 0, 1}, 1000.0};
  for (int i = 0; i < 7; ++i) {
    counted far{ground};
    far.point = {0, 0, -0.1};
    REQUIRE(port.source().update(i, far));
  }
  REQUIRE(port.source().update(0, ground));
  const auto in_a_second = [&](double z) {
    for (int n = 0; n < 100; ++n) (void)port.tick(d3::vector(0, 0, z), ph::seconds{T});
    looks = 0;
    for (int n = 0; n < 1000; ++n) (void)port.tick(d3::vector(0, 0, z), ph::seconds{T});
    return looks / 7;
  };
  CHECK(in_a_second(1e-3) == Approx(20).margin(1));
  CHECK(in_a_second(-1e-3) == Approx(20).margin(1));  // 1 N
  CHECK(in_a_second(-0.095) == 1000);                 // the control: within reach
  CHECK(looks_ahead == 0);
}

TEST_CASE("what sleeps sleeps on while it is told each 33 ms, until it is told to be near",
          "[contact_set]") {
  int in_ticks = 0;
  const auto felt = [&in_ticks](auto port) {
    in_ticks = 0;
    std::vector<d3::vector> forces;
    for (int n = 0; n < 1320; ++n) {
      if (n % 33 == 0) {  // 0.1 m away for a second, and then nearer by 20 mm each time
        const double at = n < 1000 ? -0.1 : std::min(0.0, -0.1 + 0.02 * (n / 33 - 30));
        for (int i = 0; i < 4; ++i) {
          REQUIRE(port.source().update(i, counted{{d3::vector(0, 0, at), {0, 0, 1}, 1000.0}}));
        }
      }
      looks = 0;
      forces.push_back(port.tick(d3::vector(0, 0, -1e-3), ph::seconds{T}).force);
      if (n < 1000) in_ticks += looks;
    }
    return forces;
  };
  const auto with = [](auto room) {
    return open_port<d3>(ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, room});
  };
  const auto wakes = felt(with(ph::slots<counted, 4>{}));
  CHECK(in_ticks == 4000);  // the control: four slots never sleep
  CHECK(felt(with(ph::slots<counted, 5>{})) == wakes);
  CHECK(in_ticks <= 4 * 25);  // twenty times in a second, and as long as they are new
  CHECK(wakes.back().z() > 0.5);
}

TEST_CASE("what has slept for just 0.05 s sleeps on", "[contact_set]") {
  ph::passive_port port{
      d3{}, ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<counted, 7>{}},
      ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = 0.0625}};
  counted far{{d3::zero(), {0, 0, 1}, 1000.0}};
  far.point = {0, 0, -10.0};
  for (int i = 0; i < 7; ++i) REQUIRE(port.source().update(i, far));
  const auto looked_in = [&](double dt) {  // 20 ticks
    for (int n = 0; n < 20; ++n) (void)port.tick(d3::vector(0, 0, 0.0), ph::seconds{dt});
    looks = 0;
    for (int n = 0; n < 20; ++n) (void)port.tick(d3::vector(0, 0, 0.0), ph::seconds{dt});
    return looks / 7;
  };
  CHECK(looked_in(0.05) == 10);
  CHECK(looked_in(0.0500001) == 20);
}
