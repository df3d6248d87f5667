// SPDX-License-Identifier: BSD-3-Clause
// Does a device that is dropped into a corner come to rest? Masses of 0.05 to 0.5 kg, stiffness of 1e2 to
// 1e9 N/m, from 61 mm, ideal positions and encoders of 60 µm.
#include "program.hpp"
#include <passive_haptics/energy_observer/quantised_energy.hpp>
#include <passive_haptics/motion_estimator/mass_observer.hpp>

namespace contacts {

namespace {

constexpr double masses[] = {0.05, 0.1, 0.15, 0.5};
constexpr double stiffnesses[] = {1e2, 1e3, 1e4, 1e5, 1e6, 1e9};
const vector starts[] = {{0.0, 0.0, 0.061}, {0.004, -0.007, 0.066}, {-0.006, 0.003, 0.061}};

enum class surface : std::uint8_t { smooth, rough, steps, steps_and_friction };
const char* to_string(surface s) {
  switch (s) {
    case surface::smooth:
      return "smooth";
    case surface::rough:
      return "rough";
    case surface::steps:
      return "steps of 60 um";
    case surface::steps_and_friction:
      return "steps of 60 um, device friction 0.2 N";
  }
  return "";
}

struct settling_row {
  const planes* scene = nullptr;
  surface on{};
  int starts = 3;
  int cases = 0, unsettled = 0;
  double slowest = 0.0;       ///< of those that settled [s]
  double swing = 0.0;         ///< the widest [m]
  double least_energy = 0.0;  ///< [J]
};

ex::record record_of(const settling_row& r) {
  return {{"scene", std::string(r.scene == nullptr ? "" : r.scene->name)},
          {"surface", std::string(to_string(r.on))},
          {"cases", r.cases},
          {"unsettled", r.unsettled},
          {"slowest_s", r.slowest, "%.2f"},
          {"widest_swing_mm", r.swing * 1e3, "%.4f"},
          {"least_energy_J", r.least_energy}};
}

template <class Port>
void drop(settling_row& row, Port port, double mass, double friction, double quantum,
          const vector& start) {
  sim::device<d3> device({.mass = mass,
                          .damping = damping,
                          .friction = friction,
                          .quantum = quantum,
                          .load = vector(0.0, 0.0, -gravity * mass),
                          .period = T,
                          .start = start});
  const settled s = settle(device, port, 14.0);
  const bool rests = s.swing < 1e-3 && s.seconds < 11.0;
  ++row.cases;
  if (!rests) ++row.unsettled;
  if (rests) row.slowest = std::max(row.slowest, s.seconds);
  row.swing = std::max(row.swing, s.swing);
  row.least_energy = std::min(row.least_energy, s.least_energy);
}

template <int Count>
settling_row judge(settling_row row) {
  constexpr double quantum = 60e-6;
  const double friction = row.on == surface::steps_and_friction ? 0.2 : 0.0;
  for (const double m : masses) {
    for (const double K : stiffnesses) {
      for (int i = 0; i < row.starts; ++i) {
        const planes& p = *row.scene;
        if (row.on == surface::smooth) {
          drop(row, port_of<Count>(p, m, K), m, 0.0, 0.0, starts[i]);
        } else if (row.on == surface::rough) {
          drop(row, port_of<Count>(p, m, K, beside<ph::stick_slip>{}), m, 0.0, 0.0, starts[i]);
        } else {
          const auto port =
              port_of<Count>(p, m, K,
                             beside<ph::frictionless, ph::quantised_energy, ph::mass_observer>{
                                 .observer = {.damping = damping, .quantum = quantum},
                                 .motion = {.mass = m, .quantum = quantum},
                                 .push = hand_force + friction});
          drop(row, port, m, friction, quantum, starts[2 - i]);
        }
      }
    }
  }
  return row;
}

}  // namespace

std::vector<std::string> run_settling(const session& s) {
  s.out.section("Settling",
                "Dropped from 61 mm into planes that meet, 0.05 to 0.5 kg on 1e2 to 1e9 N/m, under "
                "reachable_bound. Unsettled: still swinging by 1 mm after 12 s.");
  std::vector<settling_row> jobs;
  for (const auto& scene : all_planes()) {
    jobs.push_back({.scene = &scene, .on = surface::smooth});
    if (scene.normals.size() == 3) jobs.push_back({.scene = &scene, .on = surface::rough});
  }
  for (const auto on : {surface::steps, surface::steps_and_friction}) {
    for (const std::size_t i : {1U, 2U}) {
      jobs.push_back({.scene = &all_planes()[i], .on = on, .starts = 1});
    }
  }
  if (s.chosen.quick) {
    for (auto& job : jobs) job.starts = 1;
  }
  const auto rows = s.rows("settling.csv", "settling", jobs, [](const settling_row& job) {
    return job.scene->normals.size() > 3 ? judge<8>(job) : judge<3>(job);
  });
  ex::show_rows(s.out, "settling", rows);

  std::vector<std::string> found;
  for (const auto& r : rows) {
    const std::string name = std::string(r.scene->name) + ", " + to_string(r.on);
    const bool cone = name.find("cone") != std::string::npos;
    expect(found, r.unsettled == 0, name + ": " + std::to_string(r.unsettled) + " do not settle");
    expect(found, r.slowest <= (cone ? 9.0 : 1.0), name + ": settles slowly");
    expect(found, r.least_energy >= -1e-12, name + ": loses energy");
  }
  return found;
}

}  // namespace contacts
