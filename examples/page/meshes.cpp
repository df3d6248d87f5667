// SPDX-License-Identifier: BSD-3-Clause
// A sheet of triangles, 2 mm thin: pushed through where its nearest triangle is told, and not where the mesh is touched.
// By hand: a menu of all controllers, to be compared.
#include "exports.hpp"
#include "nothing_throws.hpp"
#include <passive_haptics/mesh.hpp>

#include <cstdlib>
#include <vector>

namespace {

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
using vector = scene::vector;
using plane = ph::half_space<scene>;
using sheet_touch = page::any_touch<scene, 1, 9984>;

constexpr int across = 30;                   // strips
constexpr double wide = 0.12, thin = 0.002;  // [m]
/// The upper side at node i of `across`: hills of 3 mm.
[[nodiscard]] ph::mesh::triple node(int i) noexcept {
  const double x = wide * i / across - 0.5 * wide;
  return {x, 0, 0.003 * page::wave(x / 0.06 + 4.25)};
}
[[nodiscard]] const ph::mesh::surface& the_sheet() {
  static const ph::mesh::surface mesh = [] {
    std::vector<ph::mesh::triangle> triangles;
    std::vector<ph::mesh::triple> nodes;
    for (int side = 0; side < 2; ++side) {
      const int first = static_cast<int>(nodes.size());
      for (int i = 0; i <= across; ++i) {
        const auto [x, y, z] = node(i);
        for (const double deep : {-0.5 * wide, 0.5 * wide})
          nodes.push_back({x, deep, z - side * thin});
      }
      for (int i = first; i < first + 2 * across; i += 2) {
        triangles.push_back({i, i + 2, i + 3});
        triangles.push_back({i, i + 3, i + 1});
      }
    }
    return ph::mesh::surface(triangles, nodes);
  }();
  return mesh;
}
/// The upper side above or below x.
[[nodiscard]] plane upper(const vector& x, double stiffness) noexcept {
  const double strip = (x(0) + 0.5 * wide) / (wide / across);
  const int i = strip > 0 ? static_cast<int>(strip < across - 1 ? strip : across - 1) : 0;
  const auto a = node(i), b = node(i + 1);
  const double length = std::sqrt((b.x - a.x) * (b.x - a.x) + (b.z - a.z) * (b.z - a.z));
  return {.point = {a.x, 0, a.z},
          .normal = {-(b.z - a.z) / length, 0, (b.x - a.x) / length},
          .stiffness = stiffness};
}

/// A port that touches the mesh; what is told of one plane it has no use for.
template <class Port>
class on_sheet {
 public:
  static constexpr ph::guarantee passivity = Port::passivity;

  explicit on_sheet(const Port& port) noexcept : port_(port) {}
  void update(const plane& /*told*/) noexcept {
    if (!port_.source().ball().touching()) port_.source().touch(the_sheet());
  }
  void let_go() noexcept { port_.source().let_go(); }
  [[nodiscard]] plane local() const noexcept {
    const auto& ball = port_.source().ball();
    return upper(vector(ball.place().x, 0, 0), 1);
  }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return port_.check(); }
  [[nodiscard]] auto tick(const auto& now) noexcept { return port_.tick(now); }

 private:
  Port port_;
};

// What touches the mesh itself: the text is the composition's alone.
#define SHEET(name, says, ...) SHEET_AS_IS(name, says, __VA_ARGS__)
#define SHEET_AS_IS(name, says, ...)                                                              \
  page::line<sheet_touch>(name, says, #__VA_ARGS__, [](const page::premises& told) {              \
    [[maybe_unused]] const auto [mass, damping, friction, quantum, motors, hand_force, roughness, \
                                 mode, tick] = told;                                              \
    return on_sheet(__VA_ARGS__);                                                                 \
  })
#define NEAREST(name, says, ...) \
  PAGE_CONTROLLER(               \
      sheet_touch, name, says,   \
      ph::local_model{scene{}, ph::followed<ph::half_space<scene>>{}, __VA_ARGS__, LIMITS})

struct sheet {
  using touch = sheet_touch;
  static constexpr page::place home{0, 0.016};
  static constexpr page::way_point round[]{
      {0.5, {0, 0.014}}, {2.0, {0, -0.020}}, {3.6, {0.022, -0.020}}, {5, {0, 0.016}}};
  static constexpr page::settings begins_with() {
    return {.stiffness = 2000, .damping = 0.1, .hand_force = 5};
  }
  static constexpr std::array menu{
      NEAREST("none", "A bare spring to the triangle that was nearest when there was news.",
              ph::turn_at_once{}, ph::spring{}, ph::no_observer{}, ph::no_bound{}),
      PAGE_CONTROLLER(sheet_touch, "make_touch",
                      "It follows the triangle that is nearest, and that may be the far side.",
                      ph::make_touch<scene>(DEVICE, HAND)),
      SHEET("make_mesh_touch", "A ball that no triangle lets through is drawn to the device.",
            ph::make_mesh_touch<scene>(DEVICE, HAND, {.stiffness = 2000})),
      NEAREST("damped spring + reachable", "Damped, and bounded by what can be given back.",
              ph::turn_limited{.rate = 2.0}, ph::damped_spring{.mass = mass}, LEDGER,
              HELD(REACHABLE)),
      NEAREST("thesis", "The rule of the thesis: stiff, and no promise.",
              ph::turn_limited{.rate = 2.0}, (ph::shaped{ph::spring{}, ph::thesis_rule{}}), LEDGER,
              ph::no_bound{}),
      NEAREST("strict", "Spends only what the hand has paid, whatever happens.",
              ph::turn_limited{.rate = 2.0}, ph::spring{}, LEDGER, ph::strict_bound{}),
  };

  void restart(const page::settings& /*set*/) noexcept { at_ = scene::zero(); }
  /// What is told: the side that is nearer, where there is news.
  [[nodiscard]] touch::news publish(double /*time*/, const page::settings& set, const vector& x,
                                    const vector& /*held*/) noexcept {
    plane side = upper(x, set.stiffness);
    if (scene::dot(vector(side.normal), vector(x - vector(side.point))) < -0.5 * thin) {
      side.point = vector(side.point) - vector(0, 0, thin);
      side.normal = -vector(side.normal);
    }
    at_ = x;
    return {{side}};
  }
  /// The upper side, which is the true one for whoever came from above.
  [[nodiscard]] touch::news surfaces(double /*time*/, const page::settings& set) const noexcept {
    return {{upper(at_, set.stiffness)}};
  }
  /// The sheet from the side.
  int outline(std::span<page::place> corners) const noexcept {
    std::size_t n = 0;
    for (int i = 0; i < across; ++i) {
      const auto a = node(i), b = node(i + 1);
      for (const page::place at : {page::place{a.x, a.z},
                                   {b.x, b.z},
                                   {b.x, b.z - thin},
                                   {a.x, a.z},
                                   {b.x, b.z - thin},
                                   {a.x, a.z - thin}}) {
        corners[n++] = at;
      }
    }
    return static_cast<int>(n);
  }

 private:
  vector at_ = scene::zero();
};

page::stage_of<sheet> the_stage;

}  // namespace

std::span<page::stage* const> page::stages() noexcept {
  static constexpr std::array<page::stage*, 1> all{&the_stage};
  return all;
}
