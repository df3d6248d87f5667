// SPDX-License-Identifier: BSD-3-Clause
// Bodies that give way, solved in the page: the soft ball of the thesis, and a slice of an organ.
// By hand: a menu of all controllers, to be compared.
#include "exports.hpp"
#include "nothing_throws.hpp"
#include <passive_haptics/environment/ball.hpp>
#include <passive_haptics/environment/deformable_body.hpp>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

namespace {

namespace ph = passive_haptics;
namespace env = ph::environment;
using scene = ph::space<double, 3>;
using vector = scene::vector;
using body_touch = page::any_touch<scene, 1>;

#define BODY(name, says, ...) \
  PAGE_CONTROLLER(            \
      body_touch, name, says, \
      ph::local_model{scene{}, ph::followed<ph::half_space<scene>>{}, __VA_ARGS__, LIMITS})

constexpr std::array bodies_menu{
    BODY("none", "A bare spring to the newest plane: each piece of news is a jump.",
         ph::turn_at_once{}, ph::spring{}, ph::no_observer{}, ph::no_bound{}),
    PAGE_CONTROLLER(
        body_touch, "make_touch",
        "What the library recommends: news moves the force smoothly, the normal turns at "
        "2 rad/s.",
        ph::make_touch<scene>(DEVICE, HAND)),
    BODY("damped spring + reachable",
         "Damped, bounded by what can be given back, the normal turned at 2 rad/s.",
         ph::turn_limited{.rate = 2.0}, ph::damped_spring{.mass = mass}, LEDGER, HELD(REACHABLE)),
    BODY("damped spring + reachable, force rate",
         "The same, and no news moves the force by more than 50 N/s: smooth, and behind.",
         ph::turn_limited{.rate = 2.0},
         (ph::shaped{ph::damped_spring{.mass = mass}, ph::force_rate_limit{.rate = 50}}), LEDGER,
         HELD(REACHABLE)),
    BODY("thesis", "The rule of the thesis: stiff, and no promise.", ph::turn_limited{.rate = 2.0},
         (ph::shaped{ph::spring{}, ph::thesis_rule{}}), LEDGER, ph::no_bound{}),
    BODY("strict", "Spends only what the hand has paid, whatever happens.",
         ph::turn_limited{.rate = 2.0}, ph::spring{}, LEDGER, ph::strict_bound{}),
    PAGE_CONTROLLER(body_touch, "contact set, reachable",
                    "News is made up for at a limited speed, so nothing jumps.",
                    ph::passive_port{scene{},
                                     ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{},
                                                     ph::slots<ph::half_space<scene>, 1>{}},
                                     LEDGER, HELD(REACHABLE), LIMITS}),
};

/// What both bodies do: they are solved when the world has news, under the force that was held then.
class pushed_body {
 public:
  using touch = body_touch;

  [[nodiscard]] touch::news publish(double /*time*/, const page::settings& /*set*/, const vector& x,
                                    const vector& held) {
    body_->update(x, held);
    return told();
  }
  [[nodiscard]] touch::news surfaces(double /*time*/, const page::settings& /*set*/) const {
    return told();
  }
  /// The triangles that face the reader, who looks along y.
  int outline(std::span<page::place> corners) const {
    std::size_t n = 0;
    for (const auto& t : body_->surface()) {
      const auto at = [&](std::size_t k) -> const Eigen::Vector3d& {
        return body_->nodes()[static_cast<std::size_t>(t.nodes[k])];
      };
      const Eigen::Vector3d a = at(1) - at(0), b = at(2) - at(0);
      if (a(2) * b(0) - a(0) * b(2) > -1e-9 || n + 3 > corners.size()) continue;
      for (std::size_t k = 0; k < 3; ++k) corners[n++] = {at(k)(0), at(k)(2)};
    }
    return static_cast<int>(n);
  }

 protected:
  void make(const env::tetrahedral_mesh& mesh, double young, std::span<const int> fixed) {
    // Eigen adds up in blocks that fit the caches of the machine; here they are the same everywhere.
    Eigen::setCpuCacheSizes(32 << 10, 256 << 10, 2 << 20);
    body_ = std::make_unique<env::deformable_body>(
        mesh, env::material{.young = young, .poisson = 0.3}, fixed, env::body_options{});
  }

 private:
  [[nodiscard]] touch::news told() const {
    const env::surface_contact& c = body_->contact();
    if (c.triangle < 0) return {{{.point = {0, 0, -1}, .normal = {0, 0, 1}, .stiffness = 1}}};
    return {{{.point = c.point, .normal = c.normal, .stiffness = c.stiffness}}};
  }

  std::unique_ptr<env::deformable_body> body_;
};

struct ball : pushed_body {
  static constexpr auto& menu = bodies_menu;
  static constexpr page::place home{0.004, 0.064};
  static constexpr page::way_point round[]{
      {0.6, {0.004, 0.062}}, {2.4, {0.004, 0.030}}, {4.0, {0.022, 0.026}}, {5, {0.004, 0.062}}};
  static constexpr page::settings begins_with() {
    return {.young = 20000, .rate = 20, .latency = 0.02, .damping = 0.1};
  }
  void restart(const page::settings& set) {
    make(env::ball(0.05), set.young, env::ball_fixed_nodes());
  }
};

struct organ : pushed_body {
  static constexpr auto& menu = bodies_menu;
  static constexpr page::place home{0.0, 0.034};
  static constexpr page::way_point round[]{
      {0.6, {0.0, 0.032}}, {2.4, {0.004, 0.002}}, {4.0, {-0.014, 0.002}}, {5, {0.0, 0.032}}};
  static constexpr page::settings begins_with() {
    return {.young = 20000, .rate = 15, .latency = 0.03, .damping = 0.1};
  }

  /// A slice of 84 mm by 50 mm, 48 mm high in the middle: boxes of six tetrahedra each; held below.
  void restart(const page::settings& set) {
    constexpr int across = 14, high = 6;
    env::tetrahedral_mesh mesh;
    std::vector<int> held;
    const auto number = [](int i, int j, int k) { return (i * (high + 1) + j) * 2 + k; };
    for (int i = 0; i <= across; ++i) {
      const double s = 2.0 * i / across - 1;
      for (int j = 0; j <= high; ++j) {
        for (int k = 0; k < 2; ++k) {
          if (j == 0) held.push_back(static_cast<int>(mesh.nodes.size()));
          mesh.nodes.emplace_back(0.042 * s, 0.05 * k - 0.025,
                                  -0.024 + (0.048 - 0.012 * s * s) * j / high);
        }
      }
    }
    for (int i = 0; i < across; ++i) {
      for (int j = 0; j < high; ++j) {
        std::array<int, 3> way{0, 1, 2};
        do {  // from one corner to the opposite one, along the axes in each order
          std::array<int, 3> at{i, j, 0};
          std::array<int, 4> t{number(at[0], at[1], at[2])};
          for (std::size_t n = 0; n < 3; ++n) {
            ++at[static_cast<std::size_t>(way[n])];
            t[n + 1] = number(at[0], at[1], at[2]);
          }
          if (env::signed_volume(mesh, t) < 0) std::swap(t[2], t[3]);
          mesh.tetrahedra.push_back(t);
        } while (std::next_permutation(way.begin(), way.end()));
      }
    }
    make(mesh, set.young, held);
  }
};

page::stage_of<ball> the_ball;
page::stage_of<organ> the_organ;

}  // namespace

std::span<page::stage* const> page::stages() noexcept {
  static constexpr std::array<page::stage*, 2> all{&the_ball, &the_organ};
  return all;
}
