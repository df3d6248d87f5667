// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/manifold.hpp>
#include <passive_haptics/contact/rigid_tool.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3;
using plane = ph::half_space<d3>;
using ball = ph::sphere<d3>;

/// A port that gives what its set asks for.
template <class Space, class Surface, int Count>
auto set_of() {
  return ph::passive_port{
      Space{},
      ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<Surface, Count>{}},
      ph::no_observer{}, ph::no_bound{}, thesis_loop};
}
/// A wall through the origin, its outward normal along that axis.
template <class Space>
ph::half_space<Space> wall_along(int axis, double K = 800.0) {
  using vector = typename Space::vector;
  return {vector(Space::zero()), vector(vector::Unit(axis)),
          static_cast<typename Space::scalar>(K)};
}
plane floor_at(double height, double K = 800.0) {
  return {{0, 0, height}, {0, 0, 1}, K};
}

/// In another order, each time.
template <class Values>
void shuffle(Values& all, ph::laws::samples& draw) {
  for (std::size_t i = all.size(); i > 1; --i) {
    std::swap(all[i - 1], all[draw.bits() % i]);
  }
}
/// How many times the surfaces below have been looked at.
int looks = 0;
struct counted : plane {
  using space_type = d3;
  bool covers = true;
  struct probe : plane::probe {
    bool covers;
    [[nodiscard]] bool covered() const noexcept { return covers; }
  };
  [[nodiscard]] probe at(const d3::vector& x) const noexcept {
    ++looks;
    return {plane::at(x), covers};
  }
};

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEMPLATE_TEST_CASE("surfaces told in any order are felt as in slots of their own", "[manifold]", d2,
                   d3, f3) {
  using scalar = typename TestType::scalar;
  using vector = typename TestType::vector;
  constexpr int dof = TestType::dof;
  using surface = ph::half_space<TestType>;
  auto matched = set_of<TestType, surface, dof>();
  auto numbered = set_of<TestType, surface, dof>();
  auto fixed = set_of<TestType, surface, dof>();
  ph::contact_manifold<surface, dof> seen;
  ph::laws::samples draw{7};
  std::array<surface, static_cast<std::size_t>(dof)> walls, told;
  for (int i = 0; i < dof; ++i) told[static_cast<std::size_t>(i)] = wall_along<TestType>(i);
  walls = told;
  scalar worst(0), control(0);
  for (int k = 0; k < 2000; ++k) {
    vector x = TestType::zero();
    for (int i = 0; i < dof; ++i) x(i) = scalar(std::max(0.01 - 2e-4 * k, -1e-3 * (i + 1)));
    if (k % 33 == 0) {
      for (int i = 0; i < dof; ++i) {
        const auto at = static_cast<std::size_t>(i);
        fixed.source().update(i, walls[at]);
        numbered.source().update(i, told[at]);
      }
      const auto news = seen.show(matched.source(), told, x);
      CHECK(news.matched == (k == 0 ? 0 : dof));
      CHECK(news.added == (k == 0 ? dof : 0));
      shuffle(told, draw);
    }
    const auto dt = ph::seconds{scalar(T)};
    const vector wanted = fixed.tick(x, dt).force;
    worst = std::max(worst, vector(matched.tick(x, dt).force - wanted).norm());
    control = std::max(control, vector(numbered.tick(x, dt).force - wanted).norm());
  }
  CHECK(worst < scalar(1e-4));   // the sum of the walls in another order
  CHECK(control > scalar(0.3));  // [N] of 1.8 to 3.0
}

TEST_CASE("faces that come and go beside a finger keep their slots", "[manifold]") {
  // A row of 40 balls and what is near of it, up to 16, in another order each time. It should be as if each
  // ball had a slot of its own, which is told while it is near and released when it is not.
  ph::laws::samples draw{11};
  std::array<ball, 40> heap;
  for (auto& b : heap) {
    b.centre = {0.04 * draw.number<double>(), 0.01 * draw.number<double>(), -0.02};
    b.radius = 0.02 + 0.002 * draw.number<double>();
    b.stiffness = 500;
  }
  auto fixed = set_of<d3, ball, 40>();
  auto matched = set_of<d3, ball, 16>();
  auto by_order = set_of<d3, ball, 16>();
  ph::contact_manifold<ball, 16> seen;
  std::array<bool, 40> there{};
  double worst = 0, control = 0;
  int most = 0, released = 0;
  for (int k = 0; k < 2000; ++k) {
    const d3::vector x(-0.03 + 3e-5 * k, 0.0, std::max(-1e-3, 5e-3 - 1e-4 * k));
    if (k % 33 == 0) {
      std::vector<ball> told;
      for (std::size_t i = 0; i < heap.size(); ++i) {
        const bool near = heap[i].at(x).depth > -1.5e-3 && told.size() < 16;
        if (near) fixed.source().update(static_cast<int>(i), heap[i]);
        if (!near && there[i]) fixed.source().release(static_cast<int>(i));
        there[i] = near;
        if (near) told.push_back(heap[i]);
      }
      shuffle(told, draw);
      most = std::max(most, static_cast<int>(told.size()));
      const auto news = seen.show(matched.source(), told, x);
      released += news.released;
      CHECK(news.taken() == static_cast<int>(told.size()));
      for (int i = 0; i < 16; ++i) {
        if (i < static_cast<int>(told.size())) {
          by_order.source().update(i, told[static_cast<std::size_t>(i)]);
        } else {
          by_order.source().release(i);
        }
      }
    }
    const d3::vector wanted = fixed.tick(x, 1ms).force;
    worst = std::max(worst, d3::vector(matched.tick(x, 1ms).force - wanted).norm());
    control = std::max(control, d3::vector(by_order.tick(x, 1ms).force - wanted).norm());
  }
  CAPTURE(most, released);
  CHECK(most > 4);
  CHECK(released > 4);
  CHECK(worst < 1e-2);
  CHECK(control > 0.1);
}

TEST_CASE("surfaces that differ in stiffness alone are told apart", "[manifold]") {
  auto port = set_of<d3, plane, 2>();
  ph::contact_manifold<plane, 2> seen;
  const d3::vector x(0, 0, -1e-3);
  seen.show(port.source(), std::array{floor_at(0, 800), floor_at(0, 200)}, x);
  seen.show(port.source(), std::array{floor_at(0, 200), floor_at(0, 800)}, x);
  CHECK(port.source().slot(0).target().stiffness == 800.0);
}

TEST_CASE("the order of what is told has no say in who is who", "[manifold]") {
  // Both are nearest to the first slot; the nearer of them is what was in it, and the other goes next door.
  for (const bool swapped : {false, true}) {
    auto port = set_of<d3, plane, 2>();
    ph::contact_manifold<plane, 2> seen;
    seen.show(port.source(), std::array{floor_at(0), floor_at(5e-3)}, d3::zero());
    std::array told{floor_at(-2e-3), floor_at(1e-3)};
    if (swapped) std::swap(told[0], told[1]);
    CHECK(seen.show(port.source(), told, d3::zero()).matched == 2);
    CHECK(port.source().slot(0).target().at(d3::zero()).depth == 1e-3);
    CHECK(port.source().slot(1).target().at(d3::zero()).depth == -2e-3);
  }
}

TEST_CASE("an id wins over place", "[manifold]") {
  using seen_type = ph::contact_manifold<plane, 3>;
  const std::array<seen_type::id_type, 2> ids{4, 9}, swapped{9, 4}, same{0, 0};
  const std::array walls{floor_at(0), floor_at(2e-3)};
  const auto first_is = [&](const auto& before, const auto& after) {
    auto port = set_of<d3, plane, 3>();
    seen_type seen;
    seen.show(port.source(), walls, d3::zero(), before);
    CHECK(seen.show(port.source(), walls, d3::zero(), after).matched == 2);
    return port.source().slot(0).target().at(d3::zero()).depth;
  };
  CHECK(first_is(ids, ids) == 0.0);
  CHECK(first_is(ids, swapped) == 2e-3);
  CHECK(first_is(std::span<const seen_type::id_type>{}, swapped) == 0.0);  // none was known
  CHECK(first_is(same, same) == 0.0);                                      // of one id, the nearest
  const std::array<seen_type::id_type, 2> none{seen_type::no_id, seen_type::no_id};
  CHECK(first_is(ids, none) == 0.0);

  // However far away.
  auto port = set_of<d3, plane, 3>();
  seen_type seen;
  seen.show(port.source(), walls, d3::zero(), ids);
  const auto news =
      seen.show(port.source(), std::array{floor_at(-1.0), floor_at(2e-3)}, d3::zero(), ids);
  CHECK(news.matched == 2);
  const auto without =
      seen.show(port.source(), std::array{floor_at(0.0), floor_at(2e-3)}, d3::zero());
  CHECK(without.matched == 1);
  CHECK(without.added == 1);
  CHECK(without.released == 1);
}

TEST_CASE("where slots are short an id keeps its own, however far it has gone", "[manifold]") {
  using seen_type = ph::contact_manifold<plane, 2>;
  const std::array<seen_type::id_type, 3> ids{4, 9, 5};
  const auto first_is = [&](const auto& of) {
    auto port = set_of<d3, plane, 2>();
    seen_type seen;
    seen.show(port.source(), std::array{floor_at(-5e-3), floor_at(5e-3)}, d3::zero(),
              std::span(of).first(2));
    // It has come 4.5 mm nearer, and what is new is deeper, but not by a millimetre.
    const std::array told{floor_at(-5e-4), floor_at(5e-3), floor_at(-2e-4)};
    seen.show(port.source(), told, d3::zero(), of);
    return port.source().slot(0).target().at(d3::zero()).depth;
  };
  CHECK(first_is(ids) == -5e-4);
  const std::array<seen_type::id_type, 3> none{seen_type::no_id, seen_type::no_id,
                                               seen_type::no_id};
  CHECK(first_is(none) == -2e-4);  // the control
}

TEST_CASE("a slot that is leaving may be taken back", "[manifold]") {
  auto port = set_of<d3, plane, 3>();
  ph::contact_manifold<plane, 3> seen;
  const std::array walls{floor_at(0)};
  seen.show(port.source(), walls, d3::vector(0, 0, 1e-3));
  const d3::vector x(0, 0, -2e-3);
  (void)port.tick(d3::vector(0, 0, 1e-3), 1ms);
  for (int k = 0; k < 100; ++k) (void)port.tick(x, 1ms);
  CHECK(seen.show(port.source(), {}, x).released == 1);
  CHECK(seen.show(port.source(), {}, x).released == 0);
  for (int k = 0; k < 10; ++k) (void)port.tick(x, 1ms);
  REQUIRE(port.source().slot(0).pressed() > 0.5);
  CHECK(seen.show(port.source(), walls, x).matched == 1);
  for (int k = 0; k < 100; ++k) (void)port.tick(x, 1ms);
  CHECK_THAT(port.tick(x, 1ms).force(2), WithinAbs(1.6, 1e-3));
  CHECK_FALSE(port.source().slot(1).taken());

  // What has left is gone, and its slot is anybody's.
  seen.show(port.source(), {}, x);
  for (int k = 0; k < 200; ++k) (void)port.tick(x, 1ms);
  CHECK(port.source().slot(0).taken() == false);
  CHECK(seen.show(port.source(), walls, x).added == 1);
  port.reset();
  CHECK(seen.show(port.source(), walls, x).added == 1);
  port.reset();
  CHECK(seen.show(port.source(), {}, x).released == 0);  // it is gone already
}

TEST_CASE("what is new takes the slot that presses least", "[manifold]") {
  auto port = set_of<d3, plane, 2>();
  ph::contact_manifold<plane, 2> seen;
  const d3::vector x(1e-3, 0, -2e-3);
  seen.show(port.source(), std::array{floor_at(0), wall_along<d3>(0)}, d3::vector(1e-3, 0, 1e-3));
  (void)port.tick(d3::vector(1e-3, 0, 1e-3), 1ms);
  for (int k = 0; k < 100; ++k) (void)port.tick(x, 1ms);
  REQUIRE(port.source().slot(0).pressed() > 1.0);
  const auto news = seen.show(port.source(), std::array{wall_along<d3>(1)}, x);
  CHECK(news.added == 1);
  CHECK(news.released == 2);
  CHECK(port.source().slot(0).pressed() > 1.0);
  CHECK(port.source().slot(1).target().normal[1] == 1.0);
}

TEST_CASE("an unusable surface is refused and nothing else is lost", "[manifold]") {
  const auto [what, bad] = GENERATE(
      table<const char*, plane>({{"normal of length 0", {{0, 0, 0}, {0, 0, 0}, 800}},
                                 {"point NaN", {{0, 0, nan_value}, {0, 0, 1}, 800}},
                                 {"normal NaN", {{0, 0, 0}, {0, nan_value, 1}, 800}},
                                 {"K 0", {{0, 0, 0}, {0, 0, 1}, 0}},
                                 {"K infinite", {{0, 0, 0}, {0, 0, 1}, HUGE_VAL}},
                                 {"beyond numbers", {{0, 1.7e308, 1.7e308}, {0, 1, 1}, 800}}}));
  CAPTURE(what);
  auto port = set_of<d3, plane, 3>();
  using seen_type = ph::contact_manifold<plane, 3>;
  seen_type seen;
  const d3::vector x(-1e-3, 0, -1e-3);
  const plane side{{0, 0, 0}, {1, 0, 0}, 1e12};
  const std::array<seen_type::id_type, 3> ids{1, 2, 3};
  seen.show(port.source(), std::array{floor_at(0), side}, x, ids);
  CHECK(port.tick(x, 1ms).what == ph::event::nominal);
  const auto news = seen.show(port.source(), std::array{bad, floor_at(0), bad, side}, x);
  CHECK(news.refused == 2);
  CHECK(news.matched == 2);
  CHECK(news.taken() + news.refused == 4);
  CHECK(port.tick(x, 1ms).what == ph::event::rejected_target);
  const auto after = port.tick(x, 1ms);
  CHECK(after.what == ph::event::nominal);
  CHECK(ph::kernels::is_finite(after.force.norm()));

  // Where its id is known the last good one stays, else its slot ends.
  seen.show(port.source(), std::array{floor_at(0), side}, x, ids);
  CHECK(seen.show(port.source(), std::array{bad, side}, x, ids).released == 0);
  const std::array<seen_type::id_type, 2> first{1, seen_type::no_id};
  CHECK(seen.show(port.source(), std::array{bad, floor_at(1e-4)}, x, first).matched == 0);
  CHECK(port.source().slot(0).target().at(d3::zero()).depth == 0.0);
  seen.show(port.source(), std::array{floor_at(0), side}, x, ids);
  CHECK(seen.show(port.source(), std::array{bad, side}, x).released == 1);

  // A device that is nowhere takes nothing, and loses nothing.
  const auto nowhere =
      seen.show(port.source(), std::array{floor_at(0), side}, d3::vector(0, 0, nan_value));
  CHECK(nowhere.refused == 2);
  CHECK(nowhere.released == 0);
  CHECK(port.tick(x, 1ms).what == ph::event::rejected_target);
}

TEST_CASE("of more surfaces than slots the deepest are kept, at the cost of a look each",
          "[manifold]") {
  auto port = set_of<d3, counted, 4>();
  ph::contact_manifold<counted, 4> seen;
  ph::laws::samples draw{3};
  std::vector<counted> many(10000);
  for (std::size_t i = 0; i < many.size(); ++i) {
    static_cast<plane&>(many[i]) =
        floor_at(-1e-4 * static_cast<double>(i), 100.0 + static_cast<double>(i % 7));
  }
  const auto heights = [&] {
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      sum += port.source().template slot<counted>(i).target().at(d3::zero()).depth;
    return sum;
  };
  for (int frame = 0; frame < 3; ++frame) {
    shuffle(many, draw);
    looks = 0;
    const auto news = seen.show(port.source(), many, d3::zero());
    CHECK(looks <= 10000 + 5 * 4);
    CHECK(news.taken() == 4);
    CHECK(news.left_out == 9996);
    CHECK_THAT(heights(), WithinAbs(-6e-4, 1e-12));
  }
  // What has a slot stays until another is deeper by a millimetre.
  for (auto& s : many) s.point.values[2] -= 2e-3;
  std::array<counted, 5> few{};
  for (std::size_t i = 0; i < 4; ++i)
    static_cast<plane&>(few[i]) = floor_at(-1e-4 * static_cast<double>(i));
  static_cast<plane&>(few[4]) = {{0, 0, 5e-4}, {0, 1, 1}, 100};
  CHECK(seen.show(port.source(), few, d3::zero()).matched == 4);
  few[4].point.values[2] = 3e-3;
  const auto deeper = seen.show(port.source(), few, d3::zero());
  CHECK(deeper.matched == 3);
  CHECK(deeper.added == 1);
  CHECK(deeper.released == 1);
  // What does not cover the device goes first, however deep.
  few[4].covers = false;
  CHECK(seen.show(port.source(), few, d3::zero()).released == 1);
  CHECK_THAT(heights(), WithinAbs(-6e-4, 1e-12));
}

TEST_CASE("equal surfaces share a slot where there is no room for two", "[manifold]") {
  auto port = set_of<d3, plane, 2>();
  ph::contact_manifold<plane, 2> seen;
  const plane side{{0, 0, 0}, {1, 0, 0}, 800};
  CHECK(seen.show(port.source(), std::array{side, side}, d3::zero()).taken() == 2);
  const auto news = seen.show(
      port.source(), std::array{floor_at(1e-3), floor_at(1e-3), floor_at(1e-3), side}, d3::zero());
  CHECK(news.taken() == 2);
  CHECK(news.merged == 2);
  CHECK(news.left_out == 0);
  CHECK(port.source().slot(0).target().normal[0] + port.source().slot(1).target().normal[0] == 1.0);
}

TEST_CASE("of two surfaces in one place the stiffer has the slot, in whatever order",
          "[manifold]") {
  auto port = set_of<d3, plane, 3>();
  ph::contact_manifold<plane, 3> seen;
  ph::laws::samples draw{5};
  const plane side{{2e-3, 0, 0}, {1, 0, 0}, 800}, back{{0, 2e-3, 0}, {0, 1, 0}, 800};
  std::array told{floor_at(1e-3, 8000), floor_at(1e-3, 300), floor_at(1e-3, 2000), side, back};
  for (int frame = 0; frame < 100; ++frame) {
    shuffle(told, draw);
    const auto news = seen.show(port.source(), told, d3::zero());
    CHECK(news.merged == 2);
    CHECK(news.left_out == 0);
    CHECK(news.released == 0);
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += port.source().slot(i).target().stiffness;
    CHECK(sum == 9600.0);
  }
}

TEST_CASE("points of a tool find their walls again", "[manifold]") {
  using tool_body = ph::rigid_body<double>;
  ph::passive_port tool{tool_body{},
                        ph::rigid_tool{ph::tool_spring{.mass = 0.15, .least_inertia = 1e-4},
                                       ph::pursuit{}, ph::slots<plane, 4>{}},
                        ph::no_observer{}, ph::no_bound{}, thesis_loop};
  using point = std::remove_cvref_t<decltype(tool.source())>::point;
  ph::contact_manifold<plane, 4> seen;
  tool_body::pose pose{};
  // Two points on one floor: only the points tell them apart.
  std::vector<point> points{{0.02, 0, 0}, {-0.02, 0, 0}};
  const std::array told{floor_at(0), floor_at(0)};
  CHECK(seen.show(tool.source(), told, points, pose).added == 2);
  std::swap(points[0], points[1]);
  CHECK(seen.show(tool.source(), told, points, pose).matched == 2);
  CHECK(tool.source().slot(0).point[0] == 0.02);
  points.pop_back();
  const auto news = seen.show(tool.source(), told, points, pose);
  CHECK(news.matched == 1);
  CHECK(news.refused == 1);
  CHECK(news.released == 1);
}

TEST_CASE("a rule that is none names its fault, and matches nothing", "[manifold]") {
  CHECK_FALSE(ph::contact_manifold<plane, 2>{}.check());
  CHECK(ph::contact_manifold<plane, 2>{{.within = 0.02}}.parameters().within == 0.02);
  CHECK(std::string_view(ph::same_surface{.within = nan_value}.check().parameter) == "within");
  CHECK(std::string_view(ph::contact_manifold<plane, 2>{{.within = -1}}.check().parameter) ==
        "within");
  CHECK(std::string_view(ph::same_surface{.lever = 0}.check().parameter) == "lever");
  CHECK(std::string_view(ph::same_surface{.stay = -1}.check().parameter) == "stay");
  CHECK(std::string_view(ph::same_surface{.twin = nan_value}.check().parameter) == "twin");
  auto port = set_of<d3, plane, 2>();
  ph::contact_manifold<plane, 2> seen{ph::same_surface{.within = nan_value}};
  seen.show(port.source(), std::array{floor_at(0)}, d3::zero());
  CHECK(seen.show(port.source(), std::array{floor_at(0)}, d3::zero()).matched == 0);
}

namespace {

/// A surface that is usable as it is made.
struct ready_made : plane {
  using space_type = d3;
  ready_made() : plane(floor_at(0)) {}
};

}  // namespace

TEST_CASE("what is refused takes no slot, whatever a surface is by default", "[manifold]") {
  auto port = set_of<d3, ready_made, 2>();
  ph::contact_manifold<ready_made, 2> seen;
  ready_made bad;
  bad.stiffness = nan_value;
  CHECK(seen.show(port.source(), std::array{bad}, d3::zero()).refused == 1);
  CHECK_FALSE(port.source().template slot<ready_made>(0).taken());
  CHECK(port.tick(d3::zero(), 1ms).what == ph::event::rejected_target);

  using body = ph::rigid_body<double>;
  ph::passive_port tool{body{},
                        ph::rigid_tool{ph::tool_spring{.mass = 0.15, .least_inertia = 1e-4},
                                       ph::pursuit{}, ph::slots<ready_made, 2>{}},
                        ph::no_observer{}, ph::no_bound{}, thesis_loop};
  using point = std::remove_cvref_t<decltype(tool.source())>::point;
  CHECK(seen.show(tool.source(), std::array{bad}, std::array{point{}}, body::pose{}).refused == 1);
  CHECK_FALSE(tool.source().template slot<ready_made>(0).taken());
  CHECK(tool.tick(body::pose{}, 1ms).what == ph::event::rejected_target);
}

namespace {

constexpr std::size_t rows = 4, nobody = 99;
using four = ph::contact_manifold<plane, rows>;
using id_type = four::id_type;

/// A surface of an update, at its place [m], and the slot that it gets.
struct told_plane {
  plane surface{};
  d3::vector place = d3::zero();
  id_type id = four::no_id;
  std::size_t in = nobody;
  bool is_new = true;
};
/// Who takes which slot, from the definition (M1): of all pairs of a surface and a vacant slot the two that are
/// nearest belong together, first among those of one id, then among those within reach; and so on.
struct slow_manifold {
  struct row {
    plane surface{};
    d3::vector place = d3::zero();
    id_type id = four::no_id;
    double pressed = 0.0;
    bool taken = false, told = false, kept = false, used = false;
  };
  std::array<row, rows> slot{};
  ph::same_surface rule{};
  ph::manifold_news news{};

  ph::manifold_news show(std::vector<told_plane>& told, const std::vector<id_type>& unusable) {
    news = {};
    news.refused = static_cast<int>(unusable.size());
    for (auto& s : slot) {
      if (!s.taken) s.told = false, s.id = four::no_id;
      s.used = false;
      s.kept = s.id != four::no_id && std::count(unusable.begin(), unusable.end(), s.id) > 0;
    }
    leave_out(told);
    pair_up(told, true);
    pair_up(told, false);
    for (auto& s : slot) {
      if (s.told && !s.used && !s.kept) ++news.released;
      s.told = s.told && (s.used || s.kept);
    }
    for (auto& one : told) {
      if (one.in == nobody) take_any(one);
    }
    return news;
  }

 private:
  [[nodiscard]] double cost(const row& a, const told_plane& b) const {
    const auto was = a.surface.at(a.place), is = b.surface.at(b.place);
    const double K = a.surface.stiffness, other = b.surface.stiffness;
    return std::abs(was.depth - is.depth) + (a.place - b.place).norm() +
           rule.lever * (was.outward() - is.outward()).norm() +
           rule.twin * std::abs(K - other) / (K + other);
  }
  [[nodiscard]] static bool same(const row& a, const told_plane& b) {
    return a.id == b.id && a.id != four::no_id;
  }
  /// Of too many those that lead by most stay, where what a slot has leads by `stay`.
  void leave_out(std::vector<told_plane>& told) {
    const auto rank = [this](const told_plane& one) {
      double away = rule.stay;
      for (const auto& s : slot) {
        if (s.taken) away = same(s, one) ? 0.0 : std::min(away, cost(s, one));
      }
      return one.surface.at(one.place).depth - away;
    };
    while (told.size() > rows) {
      ++news.left_out;
      told.erase(std::min_element(told.begin(), told.end(),
                                  [&](const auto& a, const auto& b) { return rank(a) < rank(b); }));
    }
  }
  void pair_up(std::vector<told_plane>& told, bool by_id) {
    while (true) {
      double least = by_id ? HUGE_VAL : rule.within;
      told_plane* who = nullptr;
      row* where = nullptr;
      for (auto& one : told) {
        for (auto& s : slot) {
          if (one.in != nobody || s.used || s.kept || !s.taken || (by_id && !same(s, one)))
            continue;
          const double c = cost(s, one);
          if (c < least) least = c, who = &one, where = &s;
        }
      }
      if (who == nullptr) return;
      ++news.matched;
      who->is_new = false;
      put(*who, *where);
    }
  }
  /// What has no slot takes the free one that presses least, if there is one.
  void take_any(told_plane& one) {
    row* least = nullptr;
    for (auto& s : slot) {
      const bool free = !s.used && !s.kept;
      if (free && (least == nullptr || s.pressed < least->pressed)) least = &s;
    }
    ++(least == nullptr ? news.left_out : news.added);
    if (least != nullptr) put(one, *least);
  }
  void put(told_plane& one, row& s) {
    one.in = static_cast<std::size_t>(&s - slot.data());
    s.used = s.told = true;
    s.id = one.id;
  }
};

/// A set, all of whose surfaces are touched at the device.
struct shown_to_a_set {
  ph::same_surface rule{};
  decltype(set_of<d3, plane, rows>()) port = set_of<d3, plane, rows>();
  using position = d3::vector;
  using point = d3::vector;
  static position anywhere(ph::laws::samples& draw) { return 2e-3 * draw.vector<d3>(); }
  static d3::vector place(const position& x, const point& /*p*/) { return x; }
  static d3::vector place_of(const position& x, const auto& /*slot*/) { return x; }
  ph::manifold_news show(four& seen, std::span<const plane> all, std::span<const point> /*p*/,
                         const position& x, std::span<const id_type> ids) {
    return seen.show(port.source(), all, x, ids);
  }
};
/// A tool, at any point of which a surface is touched.
struct shown_to_a_tool {
  using body = ph::rigid_body<double>;
  ph::same_surface rule{};
  ph::passive_port<body, ph::rigid_tool<ph::frictionless, ph::slots<plane, rows>>, ph::no_observer,
                   ph::no_bound, std::decay_t<decltype(thesis_loop)>>
      port{body{},
           ph::rigid_tool{ph::tool_spring{.mass = 0.15, .least_inertia = 1e-4}, ph::pursuit{},
                          ph::slots<plane, rows>{}},
           ph::no_observer{}, ph::no_bound{}, thesis_loop};
  using source = std::remove_cvref_t<decltype(port.source())>;
  using position = body::pose;
  using point = source::point;
  static position anywhere(ph::laws::samples& draw) {
    position pose{};
    const d3::vector x = 2e-3 * draw.vector<d3>();
    pose.position = {x(0), x(1), x(2)};
    return pose;
  }
  static d3::vector place(const position& pose, const point& p) { return source::place(pose, p); }
  static d3::vector place_of(const position& pose, const auto& slot) {
    return source::place(pose, slot.point);
  }
  ph::manifold_news show(four& seen, std::span<const plane> all, std::span<const point> points,
                         const position& pose, std::span<const id_type> ids) {
    return seen.show(port.source(), all, points, pose, ids);
  }
};

/// Shows many updates, and asks the definition what each of them should come to. Returns the sum of all news.
template <class Shown>
ph::manifold_news as_defined(Shown on, std::uint64_t seed) {
  ph::laws::samples draw{seed};
  four seen{on.rule};
  slow_manifold slow;
  slow.rule = on.rule;
  ph::manifold_news sum;
  const auto one_in = [&draw](unsigned many) { return draw.bits() % many == 0; };
  const auto slot_at = [&on](std::size_t i) -> const auto& {
    return on.port.source().template slot<plane>(static_cast<int>(i));
  };
  double K = 500.0;  // [N/m], which no two surfaces share
  for (int frame = 0; frame < 300; ++frame) {
    for (int n = 0; n < 4; ++n) (void)on.port.tick(on.anywhere(draw), 1ms);
    const auto where = on.anywhere(draw);
    for (std::size_t i = 0; i < rows; ++i) {
      auto& s = slow.slot[i];
      s.taken = slot_at(i).taken();
      s.surface = slot_at(i).target();
      s.pressed = slot_at(i).pressed();
      s.place = on.place_of(where, slot_at(i));
    }
    const bool crowded = one_in(3), named = one_in(2);
    std::vector<told_plane> told;
    std::vector<plane> surfaces;
    std::vector<typename Shown::point> points;
    std::vector<id_type> ids, unusable;
    for (std::size_t k = crowded ? 5 + draw.bits() % 5 : draw.bits() % 5; k > 0; --k) {
      const auto& like = slot_at(draw.bits() % rows);
      const d3::vector off = draw.vector<d3>();
      told_plane one;
      const d3::vector at = 1e-3 * draw.vector<d3>();
      points.push_back({at(0), at(1), at(2)});
      one.place = on.place(where, points.back());
      one.surface = like.taken() && !one_in(4) ? like.target() : floor_at(2e-3 * off(2));
      one.surface.normal.values[0] += 0.05 * off(0);
      one.surface.normal.values[1] += 0.05 * off(1);
      one.surface.point.values[2] += 2e-3 * off(2);
      one.surface.stiffness = K += 0.37;
      REQUIRE(one.surface.prepare());
      if (named && !one_in(3)) one.id = draw.bits() % 6;
      ids.push_back(one.id);
      surfaces.push_back(one.surface);
      if (!crowded && one_in(8)) {
        surfaces.back().stiffness = -1.0;
        unusable.push_back(one.id);
      } else {
        told.push_back(one);
      }
    }
    const auto wanted = slow.show(told, unusable);
    if (!named) ids.clear();
    const auto news = on.show(seen, surfaces, points, where, ids);
    CAPTURE(frame, crowded, named);
    REQUIRE(news.matched == wanted.matched);
    REQUIRE(news.added == wanted.added);
    REQUIRE(news.refused == wanted.refused);
    REQUIRE(news.merged == 0);
    REQUIRE(news.left_out == wanted.left_out);
    REQUIRE(news.released == wanted.released);
    for (const auto& one : told) {
      if (one.in == nobody) continue;
      std::size_t in = one.in;
      for (std::size_t i = 0; i < rows && crowded && one.is_new;
           ++i) {  // in any slot that was free
        if (slot_at(i).target().stiffness == one.surface.stiffness) in = i;
      }
      REQUIRE(slot_at(in).target().stiffness == one.surface.stiffness);
      slow.slot[in].id = one.id;
    }
    sum.matched += news.matched;
    sum.added += news.added;
    sum.refused += news.refused;
    sum.left_out += news.left_out;
    sum.released += news.released;
  }
  return sum;
}

}  // namespace

TEST_CASE("who takes which slot is as (M1) defines it, whatever is told", "[manifold]") {
  const ph::same_surface strict{.within = 3e-3, .lever = 0.01, .stay = 2e-4, .twin = 1e-9};
  for (const auto& rule : {ph::same_surface{}, strict}) {
    for (const auto& sum :
         {as_defined(shown_to_a_set{rule}, 1), as_defined(shown_to_a_tool{rule}, 2)}) {
      CHECK(sum.matched > 100);
      CHECK(sum.added > 100);
      CHECK(sum.refused > 30);
      CHECK(sum.left_out > 200);
      CHECK(sum.released > 50);
    }
  }
}
