// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An organ of 864 triangles that breathes by 3 mm for four seconds, a hand that strokes it, and what it would be felt
// as if it were asked in every tick: the truth. Beside it the bare news, a plane and a spring that stand until the next.

#include "judge.hpp"
#include <passive_haptics/environment/surface.hpp>
#include <passive_haptics/environment/surface_graph.hpp>

#include <vector>

namespace env = ph::environment;
using scene = ph::space<double, 3>;
using vector = scene::vector;

/// 120 by 90 mm, 30 mm high, perhaps with a fissure across its middle [m].
class organ {
 public:
  explicit organ(double fissure) : fissure_(fissure), surface_(triangles(), wide * deep) {
    move_to(0);
  }
  /// Its nodes are where they are at t [s]; in your program a simulation has moved them.
  void move_to(double t) {
    time_ = t;
    nodes_.clear();
    for (int i = 0; i < wide * deep; ++i) nodes_.push_back(node(i, t));
  }
  [[nodiscard]] const env::surface_graph& surface() const { return surface_; }
  [[nodiscard]] const std::vector<vector>& nodes() const { return nodes_; }
  [[nodiscard]] env::surface_point under(const vector& x) const {
    return env::closest_point(surface_.triangles(), nodes_, x).value_or(env::surface_point{});
  }
  /// How fast it moves there by itself [m/s].
  [[nodiscard]] vector velocity(const env::surface_point& on) const {
    vector v = vector::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = surface_[std::size_t(on.triangle)].nodes[k];
      v += on.weights(Eigen::Index(k)) * 1e3 * (node(i, time_) - node(i, time_ - 1e-3));
    }
    return v;
  }

 private:
  static constexpr int wide = 25, deep = 19;
  [[nodiscard]] vector node(int i, double t) const {
    const double x = 0.005 * (i % wide - 12), y = 0.005 * (i / wide - 9);
    const double breath = t < 4 ? 1 + 0.1 * std::sin(3.141592653589793 * t) : 1;
    return {
        x, y,
        0.03 * breath * std::cos(20 * x) * std::cos(20 * y) - fissure_ * std::exp(-x * x / 64e-6)};
  }
  [[nodiscard]] static std::vector<env::surface_triangle> triangles() {
    std::vector<env::surface_triangle> all;
    for (int i = 0; i + wide + 1 < wide * deep; ++i) {
      if (i % wide == wide - 1) continue;
      all.push_back({{i, i + 1, i + wide + 1}});
      all.push_back({{i, i + wide + 1, i + wide}});
    }
    return all;
  }

  double fissure_, time_ = 0;
  env::surface_graph surface_;
  std::vector<vector> nodes_;
};

/// The force of a surface of 500 N/m, `above` m higher, as it is [N].
template <class Surface>
vector force_of(Surface surface, const vector& x, double above = 0) {
  if (!surface.prepare()) return vector::Zero();
  const auto at = surface.at(x);
  const double depth = at.depth + above;
  return at.covered() && depth > 0 ? vector(500 * depth * at.outward()) : vector(vector::Zero());
}

/// A hand that strokes the organ to and fro at up to 40 mm/s while it breathes, and rests on it then.
class stroke {
 public:
  explicit stroke(double fissure = 0) : told_(fissure), now_(fissure) {}

  /// What is promised of error and step: shares of bare's, the step beyond the truth's own; `above` is how much higher
  /// than the mesh the surface is felt [m].
  struct bars {
    double error, step, above = 0;
  };
  /// `slow`(organ, its point under the finger) tells of the organ 30 times a second, `fast`(sample) is the controller, and
  /// `truth`(organ, the point, x) the force [N] of the organ as it is. It returns 1 if a bar is missed.
  template <class Slow, class Fast, class Truth>
  [[nodiscard]] int over(const bars& promised, Slow slow, Fast fast, Truth truth) {
    int ms = 0;
    ph::half_space<scene> plane{};
    const auto tick = [&](const auto& sample) {
      const vector& x = sample.position;
      if (ms % 33 == 0) {
        told_.move_to(1e-3 * ms);
        const auto on = told_.under(x);
        slow(told_, on);
        plane = {on.point, on.normal, 500};
      }
      const vector felt = fast(sample);
      now_.move_to(1e-3 * ms);
      const vector right = truth(now_, now_.under(x), x);
      if (ms++ > 500) {
        ours_.add(felt, right);
        bare_.add(force_of(plane, x, promised.above), right);
        truth_.add(right, right);
      }
      return felt;
    };
    for (int i = 0; i < 4000; ++i) {
      finger_.hold({-0.025 * std::cos(1.5707963e-3 * i), 0.004, 0.018}, 1e-3, tick);
    }
    std::printf("rms error %.3f N, bare %.3f N; largest step %.3f N, bare %.3f N, truth %.3f N\n",
                ours_.rms(), bare_.rms(), ours_.step, bare_.step, truth_.step);
    const bool true_enough = ours_.rms() <= promised.error * bare_.rms() &&
                             ours_.step <= truth_.step + promised.step * bare_.step;
    finger_.hold({-0.025, 0.004, 0.018}, 3, tick);
    return true_enough ? 0 : 1;
  }
  [[nodiscard]] int verdict(const ph::explanation& e) const { return finger_.verdict(e); }

 private:
  struct series {
    double squares = 0, step = 0;
    int count = 0;
    vector last = vector::Zero();
    void add(const vector& force, const vector& right) {
      squares += (force - right).squaredNorm();
      if (count++ > 0) step = std::max(step, (force - last).norm());
      last = force;
    }
    [[nodiscard]] double rms() const { return std::sqrt(squares / count); }
  };

  session<scene, sim::coulomb_friction> finger_{
      {.mass = 0.1, .damping = 0.2, .start = {-0.025, 0.004, 0.03}}, 5};
  organ told_, now_;
  series ours_, bare_, truth_;
};
