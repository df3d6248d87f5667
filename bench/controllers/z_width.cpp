// SPDX-License-Identifier: BSD-3-Clause
#include "z_width.hpp"

#include "z_table.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

namespace controllers {

namespace sim = passive_haptics::simulation;

namespace {

constexpr double hand_force = 5.0;  // [N]

model<d1> wall_of(const controller& c, double damping, double stiffness) {
  auto wall = c.in_1({.hand_force = hand_force, .load = 1.0, .wall_damping = damping});
  wall.retarget({0.0, -1.0, stiffness});
  return wall;
}

/// A velocity source on a wall that stays put.
template <class Motion>
double least_energy(model<d1> wall, Motion motion, double start) {
  sim::prescribed_motion<d1> device({.start = start});
  sim::random_source random(1);
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 400; ++n) {
    const double force = wall.tick(sample).force;
    device.move_to(motion.next(
        {.position = device.position(), .normal = -1.0, .depth = device.position(), .force = force},
        random));
    sample = device.exchange(force);
  }
  return device.meter().minimum();
}

double under_motions(const model<d1>& wall) {
  double least = 0.0;
  for (const double amplitude : {1e-5, 1e-3}) {
    for (const double start : {0.0, 5e-3}) {  // at the surface, and always inside
      least = std::min(least,
                       least_energy(wall, sim::nyquist_motion<d1>{.amplitude = amplitude}, start));
    }
  }
  for (const double speed : {0.02, 0.5}) {
    least = std::min(least, least_energy(wall, sim::random_walk<d1>{.speed = speed}, 0.0));
    least = std::min(least, least_energy(wall, sim::greedy_motion<d1>{.speed = speed}, 0.0));
  }
  return least;
}

double under_hand(model<d1> wall) {
  sim::device<d1, sim::tapping_hand<d1>> device(
      {.start = -1e-3}, {.surface = 0.0, .normal = -1.0, .limit = hand_force});
  auto sample = device.exchange(0.0);
  for (int n = 0; n < 1000; ++n) sample = device.exchange(wall.tick(sample).force);
  return device.meter().minimum();
}

/// The device is released at the surface, at rest, under 1 N. Swings over half a second each.
double growth_of(model<d1> wall) {
  constexpr int ticks = 4000, window = 500;
  sim::device<d1> device({.load = 1.0});
  double first[2] = {0.0, 0.0}, last[2] = {1e9, -1e9};
  auto sample = device.exchange(0.0);
  for (int n = 0; n < ticks; ++n) {
    sample = device.exchange(wall.tick(sample).force);
    double* seen = n < window ? first : last;
    if (n >= window && n < ticks - window) continue;
    seen[0] = std::min(seen[0], device.position());
    seen[1] = std::max(seen[1], device.position());
  }
  return (last[1] - last[0]) / (first[1] - first[0]);
}

double spaced(double from, double decades, int i, int count) noexcept {
  return from * std::pow(10.0, decades * i / (count - 1));
}

}  // namespace

double z_grid::stiffness(int i) const noexcept {
  return spaced(10.0, 4.0, i, stiffnesses);
}
double z_grid::damping(int i) const noexcept {
  return spaced(1e-3, 5.0, i, dampings);
}
z_grid grid_of(bool quick) noexcept {
  return quick ? z_grid{9, 6} : z_grid{33, 26};
}

int passive_for(const z_row& r) noexcept {
  if (!(r.hand_energy >= -1e-12)) return 0;
  return r.motion_energy >= -1e-12 ? 2 : 1;
}
bool stable(const z_row& r) noexcept {
  return r.growth <= 1.0;
}

z_row judge_z(const controller& c, double damping, double stiffness) {
  const auto wall = wall_of(c, damping, stiffness);
  return {c.name, damping, stiffness, under_motions(wall), under_hand(wall), growth_of(wall)};
}

std::vector<std::string> run_z_width(const session& s) {
  const z_grid grid = grid_of(s.chosen.quick);
  const auto all = z_cells(s.judged, grid);
  const auto& part = s.chosen.part;
  std::vector<z_cell> mine;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (part.has(static_cast<int>(i))) mine.push_back(all[i]);
  }
  const bool whole = part.of == 1;
  const std::string file =
      whole ? "z_width.csv"
            : "z_width_" + std::to_string(part.part) + "_of_" + std::to_string(part.of) + ".csv";
  const auto rows = s.rows(
      file, z_heading, "z-width", static_cast<int>(mine.size()),
      [&](int i) {
        const z_cell& cell = mine[static_cast<std::size_t>(i)];
        return judge_z(*cell.c, cell.damping, cell.stiffness);
      },
      z_line);
  if (whole) {
    show_z_width(s, rows);
    return {};
  }
  std::cout << rows.size() << " of " << all.size() << " cells of the Z-width in "
            << s.out.path(file).string() << "; join all " << part.of << " parts with --merge\n";
  return {};
}

}  // namespace controllers
