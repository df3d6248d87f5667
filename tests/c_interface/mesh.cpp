// SPDX-License-Identifier: BSD-3-Clause
// Meshes through the C interface: bit for bit those of the library, in a port and by a probe, and what is said to wrong
// calls.
#include "direct.hpp"
#include "support/allocations.hpp"
#include <passive_haptics/mesh.hpp>
#include <passive_haptics/mesh/mesh_tool.hpp>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

namespace {

namespace mesh = ph::mesh;

std::vector<std::array<double, 3>> places(const double* numbers, int count) {
  std::vector<std::array<double, 3>> all(static_cast<std::size_t>(count));
  std::memcpy(all.data(), numbers, all.size() * sizeof all[0]);
  return all;
}
std::vector<mesh::triangle> triangles(const std::int32_t* numbers, int count) {
  std::vector<mesh::triangle> all(static_cast<std::size_t>(count));
  std::memcpy(all.data(), numbers, all.size() * sizeof all[0]);
  return all;
}
mesh::material material(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Beside what it touches already.
bool touch_also(auto& finger, const mesh::surface& s) {
  if constexpr (requires { finger.also_touch(s); }) {
    return finger.also_touch(s);
  } else {
    return finger.touch(s);
  }
}

/// The meshes of the C client, without C.
struct direct_meshes {
  explicit direct_meshes(std::uint32_t kind)
      : sheet(triangles(first.of_sheet, sheet_triangles), places(first.sheet, sheet_vertices),
              kind != 1 ? mesh::made_of{}
                        : mesh::made_of{{material(first.materials), material(first.materials + 3)},
                                        {first.material_of, first.material_of + sheet_triangles}},
              kind == 2 ? std::optional(mesh::smooth{.crease = 0.7}) : std::nullopt),
        leaf(triangles(first.of_leaf, leaf_triangles), places(first.leaf, leaf_vertices),
             {{material(first.materials)}, {0, 0}}) {}
  void move(int n, auto& finger) {
    const int news = mesh_news(n);
    const meshes now = meshes_at(n);
    const double *p = now.position, *q = now.orientation;
    if ((news & other_vertices) != 0) sheet.update(places(now.sheet, sheet_vertices));
    if ((news & another_pose) != 0) {
      leaf.update(mesh::pose{{p[0], p[1], p[2]}, q[0], {q[1], q[2], q[3]}});
    }
    if ((news & other_material) != 0) {
      const std::vector<std::uint8_t> of(sheet_triangles, 0);
      CHECK(sheet.update(mesh::made_of{{material(now.materials + 3)}, of}));
    }
    if ((news & no_material) != 0) CHECK(sheet.update(mesh::made_of{}));
    if ((news & leaf_comes) != 0) CHECK(touch_also(finger, leaf));
    if ((news & leaf_goes) != 0) finger.let_go(leaf);
  }

  meshes first = meshes_at(0);
  mesh::surface sheet, leaf;
};

/// The motion of the C client on them, by a port of the library itself.
template <class Port, class Change = decltype(nothing_else)>
std::vector<ph_result> run_meshes(Port port, std::uint32_t kind, Change change = nothing_else) {
  direct_meshes world(kind);
  REQUIRE_FALSE(port.check());
  REQUIRE(port.source().touch(world.sheet));
  std::vector<ph_result> results;
  for (int n = 0; n < ticks; ++n) {
    keep_to_script(port, n, change);
    world.move(n, port.source());
    results.push_back(tick(port, moment_at(n)));
  }
  return results;
}

ph_parameters on_mesh(ph_parameters p) {
  p.stiffness = 1500.0;
  p.viscosity = 0.4;
  p.radius = 4e-4;
  p.static_friction = 0.2;
  return p;
}
ph::mesh_contact shape(double stiffness = 1500.0) {
  return {.stiffness = stiffness, .viscosity = 0.4, .proxy = {.radius = 4e-4, .friction = 0.2}};
}

/// Points of a tool, and a device with them in C, on the mesh of on_mesh.
constexpr std::array<std::array<double, 3>, 3> corners{
    {{-4e-3, 1e-3, 0.0}, {4e-3, 0.0, 0.0}, {0.0, -3e-3, 1e-3}}};
ph_parameters with_points(ph_parameters p, const auto& points) {
  p = on_mesh(p);
  p.point_count = static_cast<std::uint32_t>(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::copy(points[k].begin(), points[k].end(), p.points[k]);
  }
  return p;
}

/// A mesh in C, ended with its test, and what ph_mesh_create says.
class made_mesh {
 public:
  made_mesh(const c_interface& with, const ph_mesh_data& data, int expected = PH_OK) : with_(with) {
    said.resize(PH_TEXT_ROOM, 'x');
    CHECK(with.mesh_create(&data, &mesh, said.data(), said.size()) == expected);
    CHECK((mesh == nullptr) == (expected != PH_OK));
    said = said.c_str();
  }
  made_mesh(const made_mesh&) = delete;
  made_mesh& operator=(const made_mesh&) = delete;
  ~made_mesh() { with_.mesh_destroy(mesh); }

  ph_mesh* mesh = nullptr;
  std::string said;

 private:
  const c_interface& with_;
};

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("a mesh_touch by name is make_mesh_touch, bit for bit, with materials and news",
          "[c_interface]") {
  const auto compare = [](const char* name, auto port, const ph_parameters& p,
                          double ph_parameters::*other) {
    for (const std::uint32_t kind : {0U, 1U, 2U}) {
      agree(name, run_meshes(port, kind), on_mesh(p), {by_meshes, kind, nullptr}, other);
    }
  };
  compare("mesh_touch", ph::make_mesh_touch<d3>(exact, hand, shape()), grip(),
          &ph_parameters::radius);
  compare("encoder_mesh_touch", ph::make_mesh_touch<d3>(stated, hand, shape()), on_encoders(),
          &ph_parameters::friction);
  compare("strict_mesh_touch", ph::make_mesh_touch<d3>(exact, ph::any_hand, shape()), grip(),
          &ph_parameters::damping);
  compare("strict_encoder_mesh_touch", ph::make_mesh_touch<d3>(stated, ph::any_hand, shape()),
          on_encoders(), &ph_parameters::quantum);
  compare("mesh_touch", ph::make_mesh_touch<d3, late<3>>(after(3, exact), hand, shape()), grip(3),
          &ph_parameters::mass);
  for (double ph_parameters::*one :
       {&ph_parameters::stiffness, &ph_parameters::viscosity, &ph_parameters::static_friction}) {
    agree("mesh_touch", run_meshes(ph::make_mesh_touch<d3>(exact, hand, shape()), 0),
          on_mesh(grip()), {by_meshes, 0, nullptr}, one);
  }
}

TEST_CASE("a stiffness that changes in C changes as set() does on a mesh", "[c_interface]") {
  auto later = on_mesh(grip());
  later.stiffness = 700.0;
  later.force_limit = 2.0;
  agree("mesh_touch",
        run_meshes(ph::make_mesh_touch<d3>(exact, hand, shape()), 0,
                   [&](auto& port) {
                     auto other = shape(700.0);
                     other.spring = port.source().parameters().spring;
                     other.spring.force_limit = 2.0;
                     CHECK_FALSE(port.set(other));
                     CHECK_FALSE(port.set(ph::actuator_limit{.most = 2.0}));
                   }),
        on_mesh(grip()), {by_meshes, 0, &later}, &ph_parameters::damping);
}

TEST_CASE("a mesh_tool by name is make_mesh_tool, bit for bit, with one point and with eight",
          "[c_interface]") {
  const auto with = [](auto limits, const auto& points, double K = 1500.0) {
    return ph::make_mesh_tool<ph::rigid_body<double>, decltype(limits)>(
        handle, {.force = 5.0, .torque = 0.1}, points, shape(K));
  };
  constexpr ph::loop_limits on_time{};
  const ph_parameters three = with_points(peg(), corners);
  const auto direct = run_meshes(with(on_time, corners), 0);
  CHECK(std::any_of(direct.begin(), direct.end(), [](auto& r) { return r.torque[0] != 0.0; }));
  for (double ph_parameters::*one :
       {&ph_parameters::least_inertia, &ph_parameters::torque_limit, &ph_parameters::stiffness,
        &ph_parameters::viscosity, &ph_parameters::radius, &ph_parameters::static_friction}) {
    INFO("the control: another one");
    agree("mesh_tool", direct, three, {as_mesh_tool, 0, nullptr}, one);
  }
  agree("mesh_tool", run_meshes(with(on_time, corners), 1), three, {as_mesh_tool, 1, nullptr},
        &ph_parameters::hand_torque);
  auto elsewhere = three;
  elsewhere.points[2][1] *= 1.01;
  CHECK_FALSE(same_bits(direct, run_in_c("mesh_tool", elsewhere, {as_mesh_tool, 0, nullptr})));

  std::array<std::array<double, 3>, 1> tip{{{2e-3, 1e-3, -1e-3}}};
  agree("mesh_tool", run_meshes(with(on_time, tip), 2), with_points(peg(), tip),
        {as_mesh_tool, 2, nullptr}, &ph_parameters::mass);
  std::array<std::array<double, 3>, PH_TOOL_POINTS> all{};
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k] = {2e-3 * static_cast<double>(k % 4) - 3e-3, k < 4 ? -1e-3 : 2e-3, 0.0};
  }
  auto late_one = with_points(peg(), all);
  late_one.latency = 1;
  agree("mesh_tool", run_meshes(with(late<1>{}, all), 0), late_one, {as_mesh_tool, 0, nullptr},
        &ph_parameters::damping);

  auto later = three;
  later.stiffness = 700.0;
  later.force_limit = 0.8;
  agree("mesh_tool",
        run_meshes(with(on_time, corners), 0,
                   [&](auto& port) {
                     auto other = handle;
                     other.force_limit = 0.8;
                     const auto fresh = ph::make_mesh_tool(other, {.force = 5.0, .torque = 0.1},
                                                           corners, shape(700.0));
                     CHECK_FALSE(port.set(fresh.source().parameters()));
                     const auto bounds = fresh.bound().parameters();
                     CHECK_FALSE(port.set(ph::bound_chain{bounds.first, bounds.rest.first}));
                   }),
        three, {as_mesh_tool, 0, &later}, &ph_parameters::damping);
}

TEST_CASE("a mesh_tool refuses points that are none, and takes a place of a mesh for each",
          "[c_interface]") {
  using Catch::Matchers::StartsWith;
  const loaded c;
  const ph_parameters good = with_points(peg(), corners);
  const auto says = [&](auto change) {
    ph_parameters p = good;
    change(p);
    return c.refusal("mesh_tool", p);
  };
  CHECK(c.refusal("mesh_tool", good, PH_OK).empty());  // the control
  CHECK(says([](auto& p) { p.point_count = 0; }) == "point_count = 0 is refused: 1 to 8 points");
  CHECK_THAT(says([](auto& p) { p.point_count = 9; }), StartsWith("point_count = 9 is refused"));
  CHECK_THAT(says([](auto& p) { p.point_count = 0xffffffffU; }),
             StartsWith("point_count = 4.29497e+09 is refused"));
  CHECK_THAT(says([](auto& p) { p.points[2][1] = no_number; }),
             StartsWith("points = nan is refused: finite"));
  CHECK_THAT(says([](auto& p) { p.latency = 2; }), StartsWith("latency = 2 is refused: 0 or 1"));
  CHECK_THAT(says([](auto& p) { p.torque_limit = 0.0; }), StartsWith("torque_limit = 0"));
  CHECK_THAT(says([](auto& p) { p.radius = -1.0; }), StartsWith("radius = -1 is refused"));
  CHECK_THAT(says([](auto& p) { p.size = offsetof(ph_parameters, rotary); }),  // an older header's
             StartsWith("point_count = 0"));
  ph_parameters p = good;
  p.points[3][0] = no_number;  // behind the last one
  CHECK(c.refusal("mesh_tool", p, PH_OK).empty());

  const meshes all = meshes_at(0);
  const opened port(c, "mesh_tool", good), planes(c, "tool", peg());
  CHECK(c.guarantee_of(port.port) == PH_CONDITIONAL);
  const auto other = [&](auto change) {
    p = good;
    change(p);
    std::string why(PH_TEXT_ROOM, 'x');
    const int status = c.set(port.port, &p, why.data(), why.size());
    CHECK((status == PH_OK) == (why[0] == '\0'));
    return std::string(why.c_str());
  };
  CHECK_THAT(other([](auto& q) { q.points[1][0] = 0.5; }), StartsWith("points = 0.5 is refused"));
  CHECK_THAT(other([](auto& q) { q.point_count = 2; }), StartsWith("point_count = 2 is refused"));
  CHECK(other([](auto& q) { q.hand_force = 4.0; }).empty());

  // Poses, wrenches and meshes; no positions, forces or surfaces.
  const double x[3] = {0, 0, 3e-3}, q[4] = {1, 0, 0, 0};
  ph_result r{};
  r.size = sizeof r;
  CHECK(c.tick_pose(port.port, x, q, 1e-3, &r) == PH_OK);
  CHECK(r.event == PH_NO_TARGET);
  CHECK(c.tick(port.port, x, 1e-3, &r) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(r.event == PH_REJECTED_SAMPLE);
  CHECK(c.tick_wanted(port.port, x, 1e-3, x, &r) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.held(port.port, x) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.held_wrench(port.port, x, x) == PH_OK);
  const moment now = moment_at(5);
  const auto plane = plane_at(&now, 0.0);
  CHECK(c.publish(port.port, 0, &plane) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.publish_plane(port.port, x, x, 1000.0) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.publish_nothing(port.port) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.release(port.port, 0, PH_PLANE) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.reset(port.port) == PH_OK);
  {
    const made_mesh sheet(c, sheet_of(&all, 0));
    CHECK(c.mesh_touch(planes.port, sheet.mesh) == PH_NOT_OF_THIS_COMPOSITION);
    std::vector<std::unique_ptr<opened>> others;
    for (int i = 0; i < PH_MOST_FINGERS / 3; ++i) {
      others.push_back(std::make_unique<opened>(c, "mesh_tool", good));
      CHECK(c.mesh_touch(others.back()->port, sheet.mesh) == PH_OK);
    }
    CHECK(c.mesh_touch(port.port, sheet.mesh) == PH_NO_PLACE);  // one of 64 is left
    others.pop_back();                                          // gone while it touches
    CHECK(c.mesh_touch(port.port, sheet.mesh) == PH_OK);
    CHECK(c.mesh_touch(port.port, sheet.mesh) == PH_NO_PLACE);  // twice
    CHECK(c.mesh_let_go(port.port, sheet.mesh) == PH_OK);
    CHECK(c.mesh_touch(port.port, sheet.mesh) == PH_OK);
  }
  double most = 0.0;  // the handle of the mesh is gone, and the mesh is felt
  for (int n = 0; n < 300; ++n) {
    const double there[3] = {1e-4, 2e-4, 5e-3 - 2e-5 * n};
    REQUIRE(c.tick_pose(port.port, there, q, 1e-3, &r) == PH_OK);
    most = std::max(most, r.force[2]);
  }
  CHECK(most > 0.3);
  ph_explanation e{};
  e.size = sizeof e;
  CHECK(c.explain(port.port, &e) == PH_OK);
  CHECK(e.asked == Approx(1500.0));
  CHECK(e.shown > 100.0);
  CHECK(e.depth > 3e-4);
}

TEST_CASE("a probe in C is mesh::proxy, bit for bit", "[c_interface]") {
  const loaded c;
  ph_probe_parameters stated_probe{};
  stated_probe.size = sizeof stated_probe;
  stated_probe.radius = 3e-4;
  stated_probe.friction = 0.2;
  for (const std::uint32_t kind : {0U, 1U, 2U}) {
    std::vector<ph_probe_result> by_c(ticks);
    REQUIRE(probe_by_c(&c, &stated_probe, kind, ticks, by_c.data()) == PH_OK);
    direct_meshes world(kind);
    mesh::proxy ball({.radius = 3e-4, .friction = 0.2});
    REQUIRE(ball.touch(world.sheet));
    int pressed = 0, by_the_leaf = 0, different = 0;
    for (int n = 0; n < ticks; ++n) {
      if (n == reset_tick) ball.reset();
      world.move(n, ball);
      const moment now = moment_at(n);
      ball.step({now.position[0], now.position[1], now.position[2]}, now.dt);
      const ph_probe_result& r = by_c[static_cast<std::size_t>(n)];
      const mesh::triple p = ball.place();
      const auto is = ball.felt({.stiffness = 0.0, .friction = 0.2});
      different += !(r.place[0] == p.x && r.place[1] == p.y && r.place[2] == p.z &&
                     r.depth == mesh::length(ball.pressed().way) && r.placed == ball.placed() &&
                     r.mesh == ball.nearest_mesh() && r.triangle == ball.nearest() &&
                     r.material[0] == is.stiffness && r.material[1] == is.friction &&
                     r.material[2] == is.viscosity);
      const double size = std::hypot(r.normal[0], r.normal[1], r.normal[2]);
      CHECK(size == Approx(r.depth > 0.0 ? 1.0 : 0.0).margin(1e-9));
      pressed += r.depth > 0.0;
      by_the_leaf += r.depth > 0.0 && r.mesh == 1;
    }
    CHECK(different == 0);
    CHECK(pressed > 500);
    CHECK(by_the_leaf > 20);
    ball.let_go();
    // The control: a ball of another radius is elsewhere.
    std::vector<ph_probe_result> larger(ticks);
    stated_probe.radius *= 1.01;
    REQUIRE(probe_by_c(&c, &stated_probe, kind, ticks, larger.data()) == PH_OK);
    stated_probe.radius = 3e-4;
    CHECK(std::memcmp(by_c.data(), larger.data(), ticks * sizeof by_c[0]) != 0);
  }
}

TEST_CASE("what is no mesh is refused from C with a sentence that says what to do",
          "[c_interface]") {
  using Catch::Matchers::StartsWith;
  const loaded c;
  const meshes all = meshes_at(0);
  const ph_mesh_data good = sheet_of(&all, 1);
  CHECK(made_mesh(c, good).said.empty());  // the control
  const auto says = [&](auto change, int expected = PH_REFUSED_MESH) {
    meshes other = all;
    ph_mesh_data data = sheet_of(&other, 1);
    change(data, other);
    return made_mesh(c, data, expected).said;
  };
  CHECK_THAT(says([](auto& d, auto&) { d.triangle_count = 0; }),
             StartsWith("mesh: it has no triangles"));
  CHECK_THAT(says([](auto& d, auto&) { d.triangle_count = 50'000'001; }),
             StartsWith("mesh: 50000001 triangles are more than 50000000; give a coarser one"));
  CHECK_THAT(says([](auto& d, auto&) { d.vertex_count = 0; }),
             StartsWith("mesh: triangle 0 names node 0 of 0"));
  CHECK_THAT(says([](auto&, auto& m) { m.of_sheet[4] = sheet_vertices; }),
             StartsWith("mesh: triangle 1 names node 81 of 81; count nodes from 0"));
  CHECK_THAT(says([](auto&, auto& m) { m.of_sheet[3] = -1; }),
             StartsWith("mesh: triangle 1 names node -1"));
  CHECK_THAT(says([](auto&, auto& m) { m.sheet[7] = no_number; }), StartsWith("mesh: node 2"));
  CHECK_THAT(says([](auto&, auto& m) { m.sheet[0] = std::numeric_limits<double>::infinity(); }),
             StartsWith("mesh: node 0"));
  CHECK_THAT(says([](auto&, auto& m) { std::fill(std::begin(m.sheet), std::end(m.sheet), 1.0); }),
             StartsWith("mesh: none of its 128 triangles has an area"));
  CHECK_THAT(says([](auto&, auto& m) { m.materials[3] = 0.0; }),
             StartsWith("mesh: of material 1 the stiffness is 0"));
  CHECK_THAT(says([](auto&, auto& m) { m.material_of[5] = 2; }),
             StartsWith("mesh: triangle 5 is of material 2 of 2"));
  const std::vector<double> many(3 * 257, 1.0);
  CHECK_THAT(says([&](auto& d, auto&) {
               d.material_count = 4'000'000'000U;
               d.materials = many.data();
             }),
             StartsWith("mesh: 257 materials; give 1 to 256"));
  CHECK(says([](auto& d, auto&) { d.vertices = nullptr; }, PH_NULL_ARGUMENT) ==
        "ph_mesh_create: vertices is NULL");
  CHECK(says([](auto& d, auto&) { d.triangles = nullptr; }, PH_NULL_ARGUMENT) ==
        "ph_mesh_create: triangles is NULL");
  CHECK(says([](auto& d, auto&) { d.materials = nullptr; }, PH_NULL_ARGUMENT) ==
        "ph_mesh_create: materials is NULL");
  CHECK_THAT(says([](auto& d, auto&) { d.crease = 2.0; }), StartsWith("mesh: crease is 2"));
  CHECK_THAT(says([](auto& d, auto&) { d.crease = no_number; }), StartsWith("mesh: crease is"));
  // A struct of the header before creases is as good, and what lies beyond it is not read.
  CHECK(says(
            [](auto& d, auto&) {
              d.size = 48;
              d.crease = no_number;
            },
            PH_OK)
            .empty());
  for (const std::uint32_t size : {0U, 40U, 50U, 64U}) {
    CHECK(says([&](auto& d, auto&) { d.size = size; }, PH_WRONG_SIZE) ==
          "size = " + std::to_string(size) +
              " is refused: sizeof(ph_mesh_data), which is 56 bytes in this library");
  }
  ph_mesh* none = nullptr;
  CHECK(c.mesh_create(nullptr, &none, nullptr, 0) == PH_NULL_ARGUMENT);
  CHECK(c.mesh_create(&good, nullptr, nullptr, 0) == PH_NULL_ARGUMENT);
  c.mesh_destroy(nullptr);
}

TEST_CASE("news that are none are refused from C, and the last good mesh is felt",
          "[c_interface]") {
  using Catch::Matchers::StartsWith;
  const loaded c;
  meshes all = meshes_at(0);
  const made_mesh sheet(c, sheet_of(&all, 0));
  const opened port(c, "mesh_touch", grip());
  CHECK(c.mesh_touch(port.port, sheet.mesh) == PH_OK);
  const auto press = [&] {
    ph_result r{};
    r.size = sizeof r;
    for (int n = 0; n < 400; ++n) {
      const double x[3] = {1e-4, 2e-4, 5e-3 - 1.5e-5 * n};
      REQUIRE(c.tick(port.port, x, 1e-3, &r) == PH_OK);
    }
    for (int n = 0; n < 400; ++n) {  // back, so that the next one comes from above
      const double x[3] = {1e-4, 2e-4, -1e-3 + 1.5e-5 * n};
      ph_result up = r;
      REQUIRE(c.tick(port.port, x, 1e-3, &up) == PH_OK);
    }
    return r.force[2];
  };
  const double before = press();
  CHECK(before > 0.3);
  std::string why(PH_TEXT_ROOM, 'x');
  const auto update = [&](const double* to, std::uint32_t count) {
    const int status = c.mesh_update(sheet.mesh, to, count, why.data(), why.size());
    CHECK((why[0] == '\0') == (status == PH_OK));
    return status;
  };
  meshes other = all;
  other.sheet[8] = no_number;
  CHECK(update(other.sheet, sheet_vertices) == PH_REFUSED_MESH);
  CHECK_THAT(why.c_str(), StartsWith("mesh: node 2"));
  CHECK(update(all.sheet, 80) == PH_REFUSED_MESH);
  CHECK_THAT(why.c_str(), StartsWith("mesh: news of 80 nodes for a mesh of 81"));
  CHECK(update(nullptr, sheet_vertices) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_mesh_update: vertices is NULL");
  CHECK(c.mesh_update(nullptr, all.sheet, sheet_vertices, nullptr, 0) == PH_NULL_ARGUMENT);
  const double q[4] = {1, 0, 0, 0}, no_turn[4] = {}, x[3] = {}, no_place[3] = {0, no_number, 0};
  CHECK(c.mesh_move(sheet.mesh, x, no_turn) == PH_REFUSED_MESH);
  CHECK(c.mesh_move(sheet.mesh, no_place, q) == PH_REFUSED_MESH);
  CHECK(c.mesh_move(sheet.mesh, nullptr, q) == PH_NULL_ARGUMENT);
  CHECK(c.mesh_move(nullptr, x, q) == PH_NULL_ARGUMENT);
  const std::uint8_t wrong[sheet_triangles] = {7};
  CHECK(c.mesh_set_materials(sheet.mesh, all.materials, 2, wrong, why.data(), why.size()) ==
        PH_REFUSED_MESH);
  CHECK_THAT(why.c_str(), StartsWith("mesh: triangle 0 is of material 7 of 2"));
  CHECK(c.mesh_set_materials(sheet.mesh, nullptr, 1, nullptr, why.data(), why.size()) ==
        PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_mesh_set_materials: materials is NULL");
  CHECK(c.mesh_set_materials(nullptr, nullptr, 0, nullptr, nullptr, 0) == PH_NULL_ARGUMENT);
  CHECK(press() == Approx(before).epsilon(1e-6));
  for (double& one : other.sheet) one = 0.0;
  for (int i = 0; i < sheet_vertices; ++i) {
    std::copy_n(all.sheet + 3 * i, 3, other.sheet + 3 * i);
    other.sheet[3 * i + 2] -= 5e-4;
  }
  CHECK(update(other.sheet, sheet_vertices) == PH_OK);  // the control: what is good is felt
  CHECK(press() < 0.8 * before);
  const auto doubt = [&] {
    CHECK(c.mesh_doubt(sheet.mesh, why.data(), why.size()) == PH_OK);
    return std::string(why.c_str());
  };
  CHECK(doubt().empty());
  for (double& one : other.sheet) one *= 1e3;
  CHECK(update(other.sheet, sheet_vertices) == PH_OK);
  CHECK_THAT(doubt(), StartsWith("mesh: it is ") && Catch::Matchers::Contains("give metres"));
  CHECK(c.mesh_doubt(nullptr, why.data(), why.size()) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_mesh_doubt: mesh is NULL");
}

TEST_CASE("a mesh is touched where there is a place for it, and lives as long as it is touched",
          "[c_interface]") {
  const loaded c;
  const meshes all = meshes_at(0);
  const opened port(c, "mesh_touch", grip()), guard(c, "guard", grip()), touch(c, "touch", grip());
  const double x[3] = {0, 0, 3e-3}, up[3] = {0, 0, 1};
  ph_result r{};
  r.size = sizeof r;
  CHECK(c.tick(port.port, x, 1e-3, &r) == PH_OK);
  CHECK(r.event == PH_NO_TARGET);
  {
    std::vector<std::unique_ptr<made_mesh>> sheets;
    for (int i = 0; i <= PH_MESHES; ++i) {
      sheets.push_back(std::make_unique<made_mesh>(c, sheet_of(&all, 0)));
      CHECK(c.mesh_touch(port.port, sheets.back()->mesh) == (i < PH_MESHES ? PH_OK : PH_NO_PLACE));
    }
    CHECK(c.mesh_let_go(port.port, sheets[3]->mesh) == PH_OK);
    CHECK(c.mesh_let_go(port.port, sheets[3]->mesh) == PH_OK);
    CHECK(c.mesh_touch(port.port, sheets[8]->mesh) == PH_OK);
    CHECK(c.mesh_touch(port.port, sheets[8]->mesh) == PH_NO_PLACE);  // twice
    for (auto* other : {guard.port, touch.port}) {
      CHECK(c.mesh_touch(other, sheets[0]->mesh) == PH_NOT_OF_THIS_COMPOSITION);
      CHECK(c.mesh_let_go(other, sheets[0]->mesh) == PH_NOT_OF_THIS_COMPOSITION);
    }
    CHECK(c.mesh_touch(nullptr, sheets[0]->mesh) == PH_NULL_ARGUMENT);
    CHECK(c.mesh_touch(port.port, nullptr) == PH_NULL_ARGUMENT);
    CHECK(c.mesh_let_go(nullptr, sheets[0]->mesh) == PH_NULL_ARGUMENT);
    CHECK(c.mesh_let_go(port.port, nullptr) == PH_NULL_ARGUMENT);

    std::vector<ph_probe*> fingers(PH_MOST_FINGERS);
    ph_probe_parameters p{};
    p.size = sizeof p;
    int held = 0;
    for (ph_probe*& one : fingers) {
      REQUIRE(c.probe_create(&p, &one, nullptr, 0) == PH_OK);
      held += c.probe_touch(one, sheets[0]->mesh) == PH_OK;
    }
    CHECK(held == PH_MOST_FINGERS - 1);  // the port is one
    CHECK(c.probe_touch(fingers.back(), sheets[0]->mesh) == PH_NO_PLACE);
    c.probe_destroy(fingers.front());
    CHECK(c.probe_touch(fingers.back(), sheets[0]->mesh) == PH_OK);
    for (std::size_t i = 1; i < fingers.size(); ++i) c.probe_destroy(fingers[i]);
  }
  double most = 0.0;  // the handles are gone, and the meshes are felt
  for (int n = 0; n < 300; ++n) {
    const double there[3] = {1e-4, 2e-4, 3e-3 - 1.5e-5 * n};
    REQUIRE(c.tick(port.port, there, 1e-3, &r) == PH_OK);
    most = std::max(most, r.force[2]);
  }
  CHECK(most > 0.3);
  // No planes for a mesh, no forces, no poses.
  CHECK(c.publish_plane(port.port, x, up, 1000.0) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.publish_nothing(port.port) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.release(port.port, 0, PH_PLANE) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.tick_wanted(port.port, x, 1e-3, up, &r) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(r.event == PH_REJECTED_SAMPLE);
}

TEST_CASE("parameters of a mesh_touch and of a probe are refused by name, as those of a port",
          "[c_interface]") {
  using Catch::Matchers::StartsWith;
  const loaded c;
  const auto says = [&c](const char* composition, ph_parameters p, double ph_parameters::*which,
                         double value) {
    p.*which = value;
    return c.refusal(composition, p);
  };
  CHECK(c.refusal("mesh_touch", grip(), PH_OK).empty());  // the control
  CHECK_THAT(says("mesh_touch", grip(), &ph_parameters::stiffness, -1.0),
             StartsWith("stiffness = -1 is refused: finite and > 0 N/m"));
  CHECK_THAT(says("mesh_touch", grip(), &ph_parameters::viscosity, no_number),
             StartsWith("viscosity = nan is refused"));
  CHECK_THAT(says("mesh_touch", grip(), &ph_parameters::radius, -1.0),
             StartsWith("radius = -1 is refused: in [1e-6, 1] m"));
  CHECK_THAT(says("mesh_touch", grip(), &ph_parameters::static_friction, no_number),
             StartsWith("static_friction = nan is refused"));
  CHECK_THAT(says("encoder_mesh_touch", on_encoders(), &ph_parameters::friction, 0.0),
             StartsWith("friction = 0 is refused: No dry friction is stated"));
  const auto promise = [&c](const char* name, const ph_parameters& p) {
    return c.guarantee_of(opened(c, name, p).port);
  };
  CHECK(promise("mesh_touch", grip()) == PH_CONDITIONAL);
  CHECK(promise("strict_encoder_mesh_touch", on_encoders()) == PH_STRICT);

  ph_probe_parameters good{};
  good.size = sizeof good;
  std::string why(PH_TEXT_ROOM, 'x');
  ph_probe* probe = nullptr;
  const auto create = [&](const ph_probe_parameters* p) {
    const int status = c.probe_create(p, &probe, why.data(), why.size());
    if (status != PH_OK) CHECK(probe == nullptr);
    return status;
  };
  for (const auto& [member, text] :
       {std::pair{&ph_probe_parameters::radius, "radius = -1 is refused: in [1e-6, 1] m"},
        std::pair{&ph_probe_parameters::friction, "friction = -1 is refused: finite and ≥ 0"},
        std::pair{&ph_probe_parameters::news_speed, "news_speed = -1 is refused: > 0 m/s"},
        std::pair{&ph_probe_parameters::longest_way, "longest_way = -1 is refused: in (0, 1] s"}}) {
    auto bad = good;
    bad.*member = -1.0;
    CHECK(create(&bad) == PH_REFUSED_PARAMETER);
    CHECK(std::string(why.c_str()) == text);
    bad.*member = no_number;
    CHECK(create(&bad) == PH_REFUSED_PARAMETER);
  }
  auto bad = good;
  bad.size = 44;
  CHECK(create(&bad) == PH_WRONG_SIZE);
  CHECK_THAT(why.c_str(), StartsWith("size = 44 is refused: sizeof(ph_probe_parameters)"));
  CHECK(create(nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.probe_create(&good, nullptr, nullptr, 0) == PH_NULL_ARGUMENT);
  REQUIRE(create(&good) == PH_OK);

  const meshes all = meshes_at(0);
  const made_mesh sheet(c, sheet_of(&all, 0));
  REQUIRE(c.probe_touch(probe, sheet.mesh) == PH_OK);
  ph_probe_result r{};
  const double x[3] = {0, 0, 5e-3}, none[3] = {0, no_number, 0};
  CHECK(c.probe_step(probe, x, 1e-3, &r) == PH_WRONG_SIZE);
  r.size = sizeof r;
  CHECK(c.probe_step(probe, x, 1e-3, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.probe_step(nullptr, x, 1e-3, &r) == PH_NULL_ARGUMENT);
  CHECK(c.probe_step(probe, x, 1e-3, &r) == PH_OK);
  CHECK((r.placed == 1 && r.place[2] == 5e-3));
  const double elsewhere[3] = {1e-3, 0, 0};
  for (const double dt : {0.0, -1e-3, no_number, std::numeric_limits<double>::infinity()}) {
    CHECK(c.probe_step(probe, elsewhere, dt, &r) == PH_REFUSED_PARAMETER);
  }
  CHECK(c.probe_step(probe, none, 1e-3, &r) == PH_REFUSED_PARAMETER);
  CHECK(c.probe_step(probe, nullptr, 1e-3, &r) == PH_NULL_ARGUMENT);
  CHECK((r.placed == 1 && r.place[0] == 0.0 && r.place[2] == 5e-3));
  CHECK(c.probe_reset(probe) == PH_OK);
  CHECK(c.probe_let_go(probe, sheet.mesh) == PH_OK);
  CHECK(c.probe_step(probe, x, 1e-3, &r) == PH_OK);
  CHECK((r.placed == 0 && r.triangle == -1));
  CHECK(c.probe_reset(nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.probe_touch(nullptr, sheet.mesh) == PH_NULL_ARGUMENT);
  CHECK(c.probe_touch(probe, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.probe_let_go(probe, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.probe_let_go(nullptr, sheet.mesh) == PH_NULL_ARGUMENT);
  c.probe_destroy(probe);
  c.probe_destroy(nullptr);
}

TEST_CASE("one thread moves a mesh while another ticks, which allocates nothing", "[c_interface]") {
  const loaded c;
  const meshes all = meshes_at(0);
  const auto in_create = allocations();
  const made_mesh sheet(c, sheet_of(&all, 1));
  CHECK(allocations() > in_create);  // the control: what the library asks for is counted
  const opened port(c, "mesh_touch", grip());
  REQUIRE(c.mesh_touch(port.port, sheet.mesh) == PH_OK);
  ph_result r{};
  r.size = sizeof r;
  long in_ticks = 0;
  const auto tick = [&](int n) {
    const int at = n % 400 < 200 ? 100 - n % 200 : n % 200 - 100;
    const double x[3] = {1e-3, 0.0, 2e-5 * at};
    c.tick(port.port, x, 1e-3, &r);
  };
  for (int n = 0; n < ticks; ++n) {  // in one thread, so that what is counted is the tick's
    if ((mesh_news(n) & other_vertices) != 0) {
      c.mesh_update(sheet.mesh, meshes_at(n).sheet, sheet_vertices, nullptr, 0);
    }
    const auto before = allocations();
    tick(n);
    in_ticks += static_cast<long>(allocations() - before);
  }
  CHECK(in_ticks == 0);

  std::atomic<bool> over{false};
  std::thread environment([&] {
    for (int n = 0; !over; ++n) {
      const meshes now = meshes_at(33 * n);
      c.mesh_update(sheet.mesh, now.sheet, sheet_vertices, nullptr, 0);
    }
  });
  bool good = true;
  int contacts = 0;
  constexpr int most = 2'000'000;  // the other thread may take its time to begin
  for (int n = 0; contacts < 10000 && n < most; ++n) {
    tick(n);
    good = good && std::isfinite(r.force[2]) &&
           std::hypot(r.force[0], r.force[1], r.force[2]) <= 3.3 * (1 + 1e-12) &&
           r.event == PH_NOMINAL;
    contacts += r.force[2] > 0.0;
  }
  over = true;
  environment.join();
  CHECK(good);
  CHECK(contacts == 10000);
}
