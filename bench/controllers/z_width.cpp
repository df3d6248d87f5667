// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

namespace controllers {

namespace {

/// A velocity source on a wall that stays put.
template <class Motion>
double least_energy(model<d1> wall, Motion motion, double start, std::uint64_t seed) {
  sim::prescribed_motion<d1> device({.start = start});
  sim::random_source random(seed);
  const auto move = [&](const auto& now) {
    const double x = device.position();
    device.move_to(
        motion.next({.position = x, .normal = -1.0, .depth = x, .force = now.force}, random));
  };
  return sim::run(device, wall, 400, sim::idle, move).least_energy;
}

double under_motions(const model<d1>& wall, std::uint64_t seed) {
  double least = 0.0;
  for (const double amplitude : {1e-5, 1e-3}) {
    for (const double start : {0.0, 5e-3}) {  // at the surface, and always inside
      least = std::min(
          least, least_energy(wall, sim::nyquist_motion<d1>{.amplitude = amplitude}, start, seed));
    }
  }
  for (const double speed : {0.02, 0.5}) {
    least = std::min(least, least_energy(wall, sim::random_walk<d1>{.speed = speed}, 0.0, seed));
    least = std::min(least, least_energy(wall, sim::greedy_motion<d1>{.speed = speed}, 0.0, seed));
  }
  return least;
}

double under_hand(model<d1> wall, double force) {
  sim::device<d1, sim::tapping_hand<d1>> device({.start = -1e-3}, {.normal = -1.0, .limit = force});
  return sim::run(device, wall, 1000).least_energy;
}

/// The device is released at the surface, at rest, under 1 N. Swings over half a second each.
double growth_of(model<d1> wall) {
  constexpr int ticks = 4000, window = 500;
  sim::device<d1> device({.load = 1.0});
  double first[2] = {0.0, 0.0}, last[2] = {1e9, -1e9};
  sim::run(device, wall, ticks, sim::idle, sim::idle, [&](const auto& now) {
    if (now.tick >= window && now.tick < ticks - window) return;
    double* seen = now.tick < window ? first : last;
    seen[0] = std::min(seen[0], device.position());
    seen[1] = std::max(seen[1], device.position());
  });
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

std::vector<z_cell> z_cells(const std::vector<controller>& judged, const z_grid& grid) {
  std::vector<z_cell> cells;
  for (const auto& c : judged) {
    if (!c.wall_damping) continue;
    for (int i = 0; i < grid.dampings; ++i) {
      for (int k = 0; k < grid.stiffnesses; ++k) {
        cells.push_back({&c, grid.damping(i), grid.stiffness(k)});
      }
    }
  }
  return cells;
}

z_row judge_z(const z_cell& cell, std::uint64_t seed) {
  const premises known{.load = 1.0, .wall_damping = cell.damping};
  auto wall = cell.c->in<d1>()(known);
  wall.update({0.0, -1.0, cell.stiffness});
  return {cell.c->name,
          cell.damping,
          cell.stiffness,
          under_motions(wall, seed),
          under_hand(wall, known.hand_force),
          growth_of(wall)};
}

std::vector<std::string> run_z_width(const session& s) {
  const auto all = z_cells(s.judged, grid_of(s.chosen.quick));
  const auto [part, of] = s.chosen.part;
  std::vector<z_cell> mine;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<int>(i) % of == part - 1) mine.push_back(all[i]);
  }
  std::string file = "z_width";
  if (of > 1) file += ex::format("_%g", part) + ex::format("_of_%g", of);
  file += ".csv";
  const auto rows = s.rows(file, "z-width", mine,
                           [&s](const z_cell& cell) { return judge_z(cell, s.chosen.first()); });
  if (of == 1) {
    show_z_width(s, rows);
  } else {
    std::cout << rows.size() << " of " << all.size() << " cells of the Z-width in "
              << s.out.path(file).string() << "; join all " << of << " parts with --merge\n";
  }
  return {};
}

}  // namespace controllers
