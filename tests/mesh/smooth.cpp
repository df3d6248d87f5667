// SPDX-License-Identifier: BSD-3-Clause
// Facets felt as the surface that their nodes were taken from: no step over smooth edges, creases that stay, what a
// loop gives, and all that is promised of facets.
#include "mesh/shapes.hpp"
#include <passive_haptics/mesh.hpp>

#include <Eigen/Geometry>

using namespace meshes;
using Catch::Matchers::Contains;

namespace {

constexpr double R = 0.05, r = 5e-4, K = 1000.0;
constexpr ph::mesh::smooth rounded{};
enum class feel { facets, shaded, smooth };

body warped(int level, const vector& by) {
  body b = sphere(level, R);
  for (triple& p : b.nodes) p = {p.x * by(0), p.y * by(1), p.z * by(2)};
  return b;
}
ph::mesh::surface surface_of(const body& b, bool smooth) {
  return {b.triangles, b.nodes, {}, smooth ? std::optional(rounded) : std::nullopt};
}
/// The force of a spring K; `shaded` is the usual one: as deep as the facets say, along the normals of a sphere or an
/// ellipsoid interpolated.
vector force_of(const ph::mesh::proxy& ball, const body& b, feel how, const vector& by) {
  const vector push = of(ball.push());
  if (how != feel::shaded || ball.pressed().count == 0) return K * push;
  const auto& h = ball.plane(ball.pressed().of[0]);
  vector n = vector::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const triple& p = b.nodes[std::size_t(b.triangles[std::size_t(h.triangle)][i])];
    const vector own = of(p).cwiseQuotient(by).cwiseQuotient(by).normalized();
    n += own * h.weights[int(i)];
  }
  return K * push.norm() * n.normalized();
}

/// A closed path of 15 mm across, about 1.5 mm deep and 0.8 mm up and down on the way.
struct path {
  vector to, u, v, by;
  double turns, phase, depth;

  [[nodiscard]] vector operator()(double angle) const {
    const vector d = (R * to + 0.0075 * (std::cos(turns * angle) * u + std::sin(turns * angle) * v))
                         .normalized();
    return (R + r - depth + 4e-4 * std::sin(angle + phase)) * d.cwiseProduct(by);
  }
  static constexpr int ticks = int(2 * pi * 0.0075 / 20e-6);  ///< at 20 mm/s
};
std::vector<path> paths(int level, const vector& by, feel how, int count) {
  std::mt19937 random(11);
  std::normal_distribution<> any;
  std::vector<path> all;
  for (int i = 0; i < count; ++i) {
    const vector to = vector(any(random), any(random), any(random)).normalized();
    const vector u = to.unitOrthogonal(), v = to.cross(u);
    // Facets lie deeper than their nodes: by 1.8 mm in the mean of 80 triangles.
    const double down = how == feel::smooth ? 0.0 : 1.8e-3 * std::pow(0.25, level - 1);
    all.push_back({to, u, v, by, i % 2 == 0 ? 1.0 : -1.0, 0.7 * i, 1.5e-3 + down});
  }
  return all;
}

struct loops {
  double gives = -1.0, takes = 1.0;  ///< the most and the least work of a loop [J]
  double step = 0.0;                 ///< the largest in a tick [N]
  double size = 0.0;                 ///< mean force times the length of a loop [J]
  std::size_t most = 0;              ///< the loop that gives most
};
loops measured(int level, const vector& by, feel how, int count) {
  const body b = warped(level, by);
  const auto s = surface_of(b, how == feel::smooth);
  const auto all = paths(level, by, how, count);
  loops seen;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ph::mesh::proxy ball({.radius = r});
    ball.touch(s);
    vector x = all[i](0.0);
    for (int k = 200; k >= 0; --k) ball.step(of(vector(x * (1.0 + 1e-3 * k))), T);
    vector f = force_of(ball, b, how, by);
    double work = 0.0, way = 0.0, sum = 0.0;
    for (int k = 1; k <= 2 * path::ticks; ++k) {
      const vector next = all[i](2 * pi * k / path::ticks);
      ball.step(of(next), T);
      const vector now = force_of(ball, b, how, by);
      seen.step = std::max(seen.step, (now - f).norm());
      if (k > path::ticks) {
        work += 0.5 * (now + f).dot(next - x);
        way += (next - x).norm();
        sum += now.norm() / path::ticks;
      }
      x = next;
      f = now;
    }
    if (work > seen.gives) {
      seen.gives = work;
      seen.most = i;
    }
    seen.takes = std::min(seen.takes, work);
    seen.size += way * sum / count;
    ball.let_go();
  }
  return seen;
}
const vector ball_like(1, 1, 1), egg(1, 0.7, 1.4);

auto port_of(double stiffness, double mass, auto bound) {
  return ph::passive_port{
      scene{}, ph::mesh_contact{.spring = {.mass = mass}, .stiffness = stiffness},
      ph::reduced_energy{.damping = 0.03}, bound, ph::loop_limits{.longest_tick = T}};
}
constexpr ph::reachable_bound reachable(double mass) {
  return {.mass = mass, .hand_force = 10};
}
/// A prism of so many sides between z = ±20 mm, closed by fans.
body drum(int sides) {
  body b;
  for (const double z : {-0.02, 0.02}) {
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * pi * k / sides;
      b.nodes.push_back({0.03 * std::cos(a), 0.03 * std::sin(a), z});
    }
  }
  b.nodes.push_back({0, 0, -0.02});
  b.nodes.push_back({0, 0, 0.02});
  for (int k = 0; k < sides; ++k) {
    const int n = (k + 1) % sides;
    b.triangles.insert(b.triangles.end(), {{k, n, n + sides},
                                           {k, n + sides, k + sides},
                                           {2 * sides, n, k},
                                           {2 * sides + 1, k + sides, n + sides}});
  }
  return b;
}

}  // namespace

TEST_CASE("a coarse smooth sphere gives a loop no work and turns the force without a step",
          "[mesh][long]") {
  for (const int level : {1, 2, 3}) {
    const loops flat = measured(level, ball_like, feel::facets, 8),
                shaded = measured(level, ball_like, feel::shaded, 8),
                smooth = measured(level, ball_like, feel::smooth, 20);
    CAPTURE(level, flat.gives, flat.takes, flat.step, shaded.gives, shaded.takes, shaded.step,
            smooth.gives, smooth.takes, smooth.step, smooth.size);
    CHECK(smooth.gives < 1e-7);
    CHECK(smooth.takes > -1e-7);
    CHECK(smooth.step < 0.002);
    CHECK(flat.gives < 1e-7);  // the controls: facets only take, and step
    CHECK(flat.takes < -5e-5);
    CHECK(flat.step > 50 * smooth.step);
    CHECK(shaded.gives > 1e-6);  // the depth of facets along interpolated normals gives
  }
}

TEST_CASE("a loop on a smooth ellipsoid gives and takes no more than smooth.hpp says",
          "[mesh][long]") {
  const double said[] = {0.02, 0.003, 0.0004};  // of 80, 320 and 1280 triangles
  for (const int level : {1, 2, 3}) {
    const loops flat = measured(level, egg, feel::facets, 8),
                smooth = measured(level, egg, feel::smooth, 40);
    CAPTURE(level, flat.gives, flat.takes, flat.step, smooth.gives, smooth.takes, smooth.step,
            smooth.size);
    const double most = said[level - 1] * smooth.size;
    CHECK(smooth.gives < most);
    CHECK(smooth.takes > -most);
    CHECK(smooth.gives > most / 20);  // it is no gradient, and the measure sees that
    CHECK(smooth.step < 0.003);
    CHECK(flat.gives < 1e-7);
    CHECK(flat.step > 50 * smooth.step);
  }
}

TEST_CASE("what loops on a smooth mesh would give, the bound of the port takes away",
          "[mesh][long]") {
  const body b = warped(1, egg);
  const auto s = surface_of(b, true);
  const loops seen = measured(1, egg, feel::smooth, 40);
  const path around = paths(1, egg, feel::smooth, 40)[seen.most];
  const auto balance = [&](auto port) {  // with what a damping of 0.03 N·s/m takes, at its least
    port.source().touch(s);
    vector x = 1.2 * around(0.0), force = vector::Zero();
    double energy = 0.0, least = 0.0;
    for (int k = -200; k < 20 * path::ticks; ++k) {
      const vector next =
          k < 0 ? vector((1.0 - 1e-3 * k) * around(0.0)) : around(2 * pi * k / path::ticks);
      energy += -force.dot(next - x) + 0.03 * (next - x).squaredNorm() / T;
      least = std::min(least, energy);
      x = next;
      force = port.tick(x, ph::seconds{T}).force;
    }
    port.source().let_go();
    return least;
  };
  CHECK(balance(port_of(K, 0.1, ph::strict_bound{})) >= -1e-12);
  CHECK(balance(port_of(K, 0.1, ph::no_bound{})) < -5e-3);
}

TEST_CASE("a smooth sphere is felt as the sphere, from outside and from within, moved and bent",
          "[mesh]") {
  const body b = sphere(1, R);
  const double seen_from[2] = {1.0, -1.0};
  for (const double side : seen_from) {
    ph::mesh::surface s(b.triangles, b.nodes, {}, rounded), beside(b.triangles, b.nodes);
    REQUIRE(beside.update(ph::mesh::pose{{0, 0, 1}}));
    ph::mesh::proxy ball({.radius = r}), of_two({.radius = r});
    ball.touch(s);
    of_two.touch(s);
    of_two.also_touch(beside);
    double least = 1.0, most = 0.0, across = 0.0, apart = 0.0;
    double grown = 1.0;
    ph::mesh::pose where{{0.01, 0, 0.02}, std::cos(0.4), {0, std::sin(0.4), 0}};
    const auto at = [&](int k) {
      const double a = 0.002 * k;
      const vector d = vector(std::cos(a), std::sin(a), 0.4 * std::sin(3 * a)).normalized();
      return d;
    };
    REQUIRE(s.update(where));
    for (int k = -100; k < 3000; ++k) {
      if (k == 1500) {  // it breathes from now on
        auto nodes = b.nodes;
        grown = 1.1;
        for (triple& p : nodes) p = p * grown;
        REQUIRE(s.update(nodes));
      }
      const double in = k < 0 ? 1.0 - 0.08 * side * k / 10 : 1.0;
      const vector d = at(std::max(k, 0));
      const double depth = k < 0 ? R * (side > 0 ? in : std::max(0.0, 1.0 + 0.008 * k))
                                 : R + side * (r - 1.5e-3) + (side < 0 ? 3e-3 : 0.0);
      const triple own = of(vector(d * depth));
      const triple x = where.out(own) + where.position;
      ball.step(x, T);
      of_two.step(x, T);
      if (k < 100 || (k >= 1500 && k < 1650)) continue;
      const vector push = of(where.in(ball.push()));
      // The lift is one number for all of the mesh.
      const double height = of(where.in(ball.place() - where.position)).norm() / grown;
      if (k < 1500) {
        least = std::min(least, height);
        most = std::max(most, height);
      }
      across = std::max(across, push.cross(d).norm() / push.norm());
      apart = std::max(apart, length(ball.place() - of_two.place()));
    }
    CAPTURE(side, least, most);
    CHECK(most - least < 1e-6);
    CHECK(across < 1e-3);
    CHECK(apart < 1e-9);
    ball.let_go();
    of_two.let_go();
  }
}

TEST_CASE("creases of a smooth mesh stay sharp, and flat faces as they are", "[mesh]") {
  const auto pressed = [](const body& b, std::optional<ph::mesh::smooth> how, auto path) {
    ph::mesh::surface s(b.triangles, b.nodes, {}, how);
    ph::mesh::proxy ball({.radius = r});
    ball.touch(s);
    std::vector<vector> all;
    for (int k = 0; k <= 4000; ++k) {
      ball.step(of(path(k)), T);
      all.push_back(of(ball.push()));
    }
    ball.let_go();
    return all;
  };
  const auto largest = [](const std::vector<vector>& all, std::size_t from, std::size_t to) {
    double step = 0.0;
    for (std::size_t k = from + 1; k < to; ++k) step = std::max(step, (all[k] - all[k - 1]).norm());
    return K * step;
  };
  // A plate, over its rim and down.
  const auto over = [](int k) {
    return vector(1.5e-5 * k, 0.004, k < 200 ? 0.01 - 6e-5 * k : -0.002);
  };
  const auto facets = pressed(plate(), {}, over), same = pressed(plate(), rounded, over);
  int differs = 0;
  for (std::size_t k = 0; k < same.size(); ++k) {
    differs += (same[k] - facets[k]).norm() < 1e-12 ? 0 : 1;
  }
  CHECK(differs < 30);  // it falls off the rim, within that many ticks of each other

  // Round a drum of 16 sides, 22 degrees each, and over its cap.
  const auto about = [](int k) {
    const double a = 0.0006 * std::max(0, k - 400);
    return vector((k < 400 ? 0.04 - 3e-5 * k : 0.028) * vector(std::cos(a), std::sin(a), 0));
  };
  const double sharp = largest(pressed(drum(16), {}, about), 500, 4000);
  CHECK(sharp > 0.2);
  CHECK(largest(pressed(drum(16), rounded, about), 500, 4000) < sharp / 20);
  CHECK(largest(pressed(drum(16), ph::mesh::smooth{.crease = 0.3}, about), 500, 4000) ==
        Approx(sharp).epsilon(1e-6));
  const auto cap = pressed(drum(16), rounded, [](int k) {
    return vector(0.0005 + 7e-6 * std::max(0, k - 400), 0.001, k < 400 ? 0.03 - 3e-5 * k : 0.018);
  });
  for (std::size_t k = 500; k < cap.size(); ++k) {
    CHECK(cap[k].normalized()(2) > 1.0 - 1e-12);  // up to the rim
  }
}

TEST_CASE("what a smooth mesh cannot be made of is refused, and what is odd in it has facets",
          "[mesh]") {
  const body b = sphere(2, R);
  CHECK_THROWS_WITH(ph::mesh::surface(b.triangles, b.nodes, ph::mesh::smooth{.crease = 0.0}),
                    Contains("crease") && Contains("in (0, 1.2] rad"));
  CHECK_THROWS_WITH(
      ph::mesh::surface(b.triangles, b.nodes, {}, ph::mesh::smooth{.crease = std::nan("")}),
      Contains("crease"));
  ph::mesh::surface s(b.triangles, b.nodes, {}, rounded);
  auto nodes = b.nodes;
  nodes[3].y = std::nan("");
  CHECK_FALSE(s.update(nodes));
  CHECK_THAT(s.fault(), Contains("node 3 at (0.0262866, nan, 0) m is not finite"));
  // No area, double triangles, an open border, one inside out, and then all nodes within a nanometre.
  body odd = with_degenerate();
  odd.triangles.resize(odd.triangles.size() - 30);
  std::swap(odd.triangles[7][0], odd.triangles[7][1]);
  ph::mesh::surface strange(odd.triangles, odd.nodes, {}, rounded);
  for (ph::mesh::surface* one : {&s, &strange}) {
    ph::mesh::proxy ball({.radius = r});
    ball.touch(*one);
    for (int k = 0; k < 1500; ++k) {
      if (k == 1000) {
        std::vector<triple> shrunk = b.nodes;
        for (triple& p : shrunk) p = p * 1e-9;
        REQUIRE(one->update(shrunk));
      }
      const double a = 0.004 * k;
      ball.step(of(vector((k < 300 ? 0.08 - 1.2e-4 * k : 0.03) *
                          vector(std::cos(a), std::sin(a), 0.3 * std::sin(2 * a)))),
                T);
      REQUIRE(ph::mesh::is_finite(ball.place()));
    }
    CHECK(ball.clearance() >= 0.25 * r);
    ball.let_go();
  }
}

TEST_CASE("no smooth mesh lets the ball through, and no joule comes out of it", "[mesh][long]") {
  double largest = 0.0;
  for (const moving& m : all_worst()) {
    for (const bool strict : {false, true}) {
      const unsigned seed = strict ? 2 : 1;
      ph::mesh::surface s(m.rest.triangles, m.nodes(0.0), {}, rounded);
      const auto run = [&](auto port) {
        port.source().touch(s);
        restless in_hand(seed);
        witness looks;
        int through = 0;
        double winds = -1e9;
        const auto& ball = port.source().ball();
        const auto seen = sim::run(
            in_hand.device, port, 3000,
            [&](auto& now) {
              if (now.tick % 33 == 0) REQUIRE(s.update(m.nodes(now.time)));
              if (!ball.placed() || !m.closed || now.tick % 4 != 0) return;
              const double about = winding(shown(s, ball), ball.place());
              through += winds > -1e8 && std::abs(about - winds) > 0.5 ? 1 : 0;
              winds = about;
            },
            [&](auto& now) { in_hand.move(now); });
        INFO(m.name << ", seed " << seed << ", strict: " << strict);
        CHECK(through == 0);
        port.source().let_go();
        CHECK(seen.least_energy >= -1e-12);
        largest = std::max(largest, seen.largest_force);
      };
      if (strict) run(port_of(2000, 0.1, ph::strict_bound{}));
      if (!strict) run(port_of(2000, 0.1, reachable(0.1)));
    }
  }
  CHECK(largest > 5.0);
}

TEST_CASE("what rests on a smooth mesh, on a crease of it or in its hollow is quiet",
          "[mesh][long]") {
  const auto flat_drum = drum(16);
  struct scene_of {
    const char* name;
    body mesh;
    vector start, to;
  };
  const scene_of scenes[] = {
      {"sphere of 80", sphere(1, 0.04), {0.003, 0.004, 0.06}, {0.002, 0.001, 0.0}},
      {"sphere of 1280", sphere(3, 0.04), {0.003, 0.004, 0.06}, {0.002, 0.001, 0.0}},
      {"within a sphere", sphere(1, 0.04), {0.003, 0.004, 0.0}, {0.005, 0.003, 0.09}},
      {"ellipsoid", warped(1, egg), {0.003, 0.004, 0.09}, {0.002, 0.001, 0.04}},
      {"side of a drum", flat_drum, {0.05, 0.004, 0.003}, {0.0, 0.002, 0.002}},
      {"rim of a drum", flat_drum, {0.05, 0.004, 0.03}, {0.01, 0.002, 0.0}},
      {"star", star(), {0.01, 0.004, 0.09}, {0.002, 0.001, 0.0}},
      {"noise",
       {sphere(2, 0.04).triangles, all_worst()[12].nodes(0.1)},
       {0.003, 0.004, 0.06},
       {0, 0, 0.01}},
  };
  for (const scene_of& here : scenes) {
    for (const double stiffness : {500.0, 2000.0, 20000.0}) {
      for (const double mass : {0.05, 0.3}) {
        ph::mesh::surface s(here.mesh.triangles, here.mesh.nodes, {}, rounded);
        auto port = port_of(stiffness, mass, reachable(mass));
        port.source().touch(s);
        sim::impedance_hand<scene> hand;
        hand.stiffness = 400;
        hand.damping = 6;
        hand.limit = 8;
        hand.target = here.to;
        sim::device<scene, sim::impedance_hand<scene>> dev(
            {.mass = mass, .damping = 0.1, .start = here.start}, hand);
        sim::quiet_judge<scene> judge;
        const auto seen = sim::run(dev, port, 5500, sim::idle, sim::idle,
                                   [&](auto& now) { show(judge, port.source().ball(), now); });
        INFO(here.name << ", " << stiffness << " N/m, " << mass << " kg, " << judge.figures().force
                       << " N, " << judge.figures().speed << " m/s, " << judge.figures().step
                       << " N");
        CHECK(judge.quiet());
        CHECK(judge.since() <= 5.0);
        CHECK(seen.least_energy >= -1e-12);
        CHECK(seen.largest_force > 0.5);
        port.source().let_go();
      }
    }
  }
}

TEST_CASE("half-spaces that a stopped ball lies beyond and that do not press do not turn its force",
          "[mesh]") {
  // A ball of 10 um in a cleft of a smooth star, whose lift leaves it no room, so that it is stopped where it is.
  const body b = star();
  const std::pair<vector, vector> ways[] = {
      {{0.0723355, 0.0661603, 0.0197581}, {0.0125831, 0.0129292, -0.0160423}},
      {{-0.0284324, 0.0338262, 0.0897072}, {-0.0139003, -0.0149357, -0.0175497}}};
  for (const auto& [start, to] : ways) {
    ph::mesh::surface s(b.triangles, b.nodes, {}, ph::mesh::smooth{});
    auto port = ph::make_mesh_touch<scene>(
        ph::exact_device{.mass = 0.3, .damping = 0.1, .force_limit = 20, .longest_tick = T},
        ph::known_hand{10.0}, {.stiffness = 2700, .proxy = {.radius = 1e-5}});
    REQUIRE(port.source().touch(s));
    sim::device<scene, sim::impedance_hand<scene>> dev(
        {.mass = 0.3, .damping = 0.2, .start = start},
        {.stiffness = 400, .damping = 4, .limit = 10, .target = to});
    sim::quiet_judge<scene> judge;
    const auto seen = sim::run(dev, port, 6500, sim::idle, sim::idle,
                               [&](auto& now) { show(judge, port.source().ball(), now); });
    INFO(judge.figures().force << " N, " << judge.figures().step << " N");
    CHECK(judge.quiet());
    CHECK(judge.since() <= 5.0);
    CHECK(seen.largest_force > 0.5);
    port.source().let_go();
  }
}

TEST_CASE("a ball that is larger than the hollows of a smooth mesh comes to rest in them",
          "[mesh][long]") {
  // Hollows and knobs in turn, 10 mm apart; the tightest radius of a hollow is 2 mm.
  body b;
  constexpr int side = 61;
  for (int i = 0; i < side * side; ++i) {
    const double x = 1e-3 * (i % side - 30), y = 1e-3 * (i / side - 30), k = 2 * pi / 0.01;
    b.nodes.push_back({x, y, 0.00127 * std::cos(k * x) * std::cos(k * y)});
    if (i % side == 0 || i < side) continue;
    b.triangles.push_back({i - side - 1, i - side, i});
    b.triangles.push_back({i - side - 1, i, i - 1});
  }
  ph::mesh::surface s(b.triangles, b.nodes, {}, rounded);
  for (const double radius : {0.0005, 0.0015, 0.003, 0.006}) {
    for (const double stiffness : {500.0, 9000.0}) {
      for (const vector& to : {vector(1e-3, 2e-3, -4e-3), vector(4e-3, -3e-3, -8e-3)}) {
        auto port = ph::make_mesh_touch<scene>(
            ph::exact_device{.mass = 0.2, .damping = 0.2, .force_limit = 20, .longest_tick = T},
            ph::known_hand{10.0}, {.stiffness = stiffness, .proxy = {.radius = radius}});
        REQUIRE(port.source().touch(s));
        sim::device<scene, sim::impedance_hand<scene>> dev(
            {.mass = 0.2, .damping = 0.2, .start = {1e-3, 1e-3, 0.003 + 1.4 * radius}},
            {.stiffness = 400, .damping = 5, .limit = 10, .target = to});
        sim::quiet_judge<scene> judge;
        const auto seen = sim::run(dev, port, 6500, sim::idle, sim::idle,
                                   [&](auto& now) { show(judge, port.source().ball(), now); });
        INFO(radius << " m, " << stiffness << " N/m, to " << to.transpose() << ": "
                    << judge.figures().force << " N, " << judge.figures().step << " N");
        CHECK(judge.quiet());
        CHECK(judge.since() <= 5.0);
        CHECK(seen.least_energy >= -1e-12);
        CHECK(seen.largest_force > 0.5);
        port.source().let_go();
      }
    }
  }
}
