// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The same hand for every composition and every scalar: a motion written down in float, so that no
// scalar has to round it.
//
//   stroke_at(n)    where the device is at tick n: pressing, sliding, leaving, and coming back
//   surface_at(n)   what the environment publishes then, every 33 ticks: it heaves and tilts
//
// One second repeats with a slow drift, so a long run sees no tick twice. Both stay calls: inlined
// where double takes the numbers, g++ 12 leaves the rounding to float out (docs/portability.md).

#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace experiments {

namespace ph = passive_haptics;

inline constexpr int ticks_per_update = 33;
inline constexpr float tick_length = 0x1p-10F;  ///< [s], near enough to a millisecond and exact

/// Position [m]: 4 mm up and down through z = 0 at 1.3 Hz with a tremor of 0.1 mm, ±10 mm sideways.
[[nodiscard, gnu::noinline]] inline std::array<float, 3> stroke_at(long n) {
  const double t = static_cast<double>(n) * static_cast<double>(tick_length);
  const double z = 4e-3 * std::sin(8.168 * t) + 1e-4 * std::sin(77.0 * t + 0.3);
  return {static_cast<float>(1e-2 * std::sin(2.9 * t)),
          static_cast<float>(1e-2 * std::sin(4.1 * t + 1.0)), static_cast<float>(z)};
}

/// A triangle of 19 cm, which one dimension sees as a wall and a plane has as its tangent. [m], [N/m]
struct surface_sample {
  std::array<std::array<float, 3>, 3> nodes;
  float stiffness;
};
[[nodiscard, gnu::noinline]] inline surface_sample surface_at(long n) {
  const double t = static_cast<double>(n) * static_cast<double>(tick_length);
  const double tilt_x = 0.2 * std::sin(1.7 * t), tilt_y = 0.2 * std::sin(2.3 * t + 0.5);
  const auto node = [&](float x, float y) {
    const double z = 5e-4 * std::sin(5.3 * t) - tilt_x * static_cast<double>(x) -
                     tilt_y * static_cast<double>(y);
    return std::array<float, 3>{x, y, static_cast<float>(z)};
  };
  return {{node(-0.0625F, -0.0625F), node(0.125F, 0.0F), node(-0.0625F, 0.0625F)}, 1000.0F};
}

/// Three numbers as a position in a space of any scalar: the last alone in one dimension.
template <class Space>
[[nodiscard]] typename Space::vector position_in(const auto& p) {
  using scalar = typename Space::scalar;
  if constexpr (Space::dof == 1) {
    return scalar(p[2]);
  } else {
    return {scalar(p[0]), scalar(p[1]), scalar(p[2])};
  }
}

/// The surface as a constraint of any scalar.
template <class Constraint>
[[nodiscard]] Constraint constraint_from(const surface_sample& s) {
  using space = typename Constraint::space_type;
  using vector = typename space::vector;
  using scalar = typename space::scalar;
  const vector a = position_in<space>(s.nodes[0]), b = position_in<space>(s.nodes[1]),
               c = position_in<space>(s.nodes[2]);
  if constexpr (space::dof == 1) {
    return {a, scalar(1), scalar(s.stiffness)};
  } else if constexpr (requires(Constraint t) { t.thickness; }) {
    return {.a = a, .b = b, .c = c, .stiffness = scalar(s.stiffness)};
  } else {
    return {a, space::cross(vector(b - a), vector(c - a)), scalar(s.stiffness)};
  }
}

/// What a replay feeds, converted beforehand: positions, and a constraint where there is a new one.
template <class Model>
class recording {
 public:
  using space = typename Model::port_type;
  using constraint = typename Model::constraint_type;

  explicit recording(long ticks) {
    for (long n = 0; n < ticks; ++n) {
      positions_.push_back(position_in<space>(stroke_at(n)));
      if (n % ticks_per_update == 0) {
        surfaces_.push_back(constraint_from<constraint>(surface_at(n)));
      }
    }
  }
  [[nodiscard]] long size() const { return static_cast<long>(positions_.size()); }

  /// One tick of it.
  auto feed(Model& model, long n) const {
    const auto i = static_cast<std::size_t>(n);
    if (n % ticks_per_update == 0) model.update(surfaces_[i / ticks_per_update]);
    return model.tick(positions_[i], ph::seconds{typename space::scalar(tick_length)});
  }

 private:
  std::vector<typename space::coordinates> positions_;
  std::vector<constraint> surfaces_;
};

}  // namespace experiments
