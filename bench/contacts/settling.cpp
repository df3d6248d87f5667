// SPDX-License-Identifier: BSD-3-Clause
// Is a device quiet after a fall into a corner? Masses of 0.05 to 0.5 kg, stiffness of 1e2 to 1e9 N/m, from
// 61 mm, smooth, rough, and on encoders of 60 µm.
#include "quiet.hpp"
#include <passive_haptics/energy_observer/quantised_energy.hpp>
#include <passive_haptics/motion_estimator/mass_observer.hpp>

namespace contacts {

namespace {

constexpr double masses[] = {0.05, 0.1, 0.15, 0.5};
constexpr double stiffnesses[] = {1e2, 1e3, 1e4, 1e5, 1e6, 1e9};
const vector starts[] = {{0.0, 0.0, 0.061}, {0.004, -0.007, 0.066}, {-0.006, 0.003, 0.061}};

/// Of its encoders, over which a device without any friction hunts.
constexpr double steps_of_a_hunt = 4.0;

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

struct fall {
  const planes* scene = nullptr;
  surface on{};
  int starts = 3;

  [[nodiscard]] double in_time() const {
    const bool cone = std::string(scene->name).find("cone") != std::string::npos;
    return cone && on == surface::smooth ? 9.0 : contacts::in_time;
  }
};

/// How stiff the set shows K with that mass [N/m].
double sampled(double K, double mass) {
  return std::min(K, (1.0 - ph::proxy_spring{}.softness) * 0.1 * mass / (T * T));
}

template <class Port>
quiet_run drop(Port port, const fall& f, const sim::device_parameters<d3>& parameters, double K) {
  sim::device<d3> device(parameters);
  const double K_shown = sampled(K, parameters.mass);
  const double step = parameters.quantum * (parameters.friction > 0.0 ? 1.0 : steps_of_a_hunt);
  sim::quiet_judge<d3> judge(sim::quiet_bars{}.on_encoders(step, K_shown, parameters.mass));
  quiet_run run;
  run.seconds = f.in_time() + watched - in_time;
  std::vector<vector> room;
  run.least_energy = sim::run(device, port, static_cast<int>(run.seconds / T), sim::idle, sim::idle,
                              [&](const auto& now) {
                                const auto normals = ex::pressing(
                                    port.source(), static_cast<int>(f.scene->normals.size()), room);
                                if (!normals.empty()) run.touched = now.time;
                                judge.add(now.force, device.velocity(), T, normals);
                              })
                         .least_energy;
  run.gone = !(device.position().norm() < 1.0);
  run.settling = judge.settling();
  run.missed = judge.missed();
  run.last = judge.figures();
  run.free = device.velocity().norm();
  return run;
}

/// Masses, stiffnesses and starts are drawn by the seed about those above.
template <int Count>
quiet_row judge(const fall& f, int seed) {
  constexpr double quantum = 60e-6;
  const double friction = f.on == surface::steps_and_friction ? 0.2 : 0.0;
  const int each = static_cast<int>(std::size(stiffnesses)) * f.starts;
  const std::string name = std::string(f.scene->name) + ", " + to_string(f.on);
  const int cases = each * static_cast<int>(std::size(masses));
  return judged({.scene = name, .hand = "off", .cases = cases, .in_time = f.in_time()}, [&](int i) {
    draws d((static_cast<std::uint64_t>(seed) << 32U) + static_cast<std::uint64_t>(i));
    const double m = masses[i / each] * d.scale(0.8, 1.25);
    const double K = stiffnesses[i % each / f.starts] / d.scale(1.0, 3.0);
    const vector aside(d.between(-2e-3, 2e-3), d.between(-2e-3, 2e-3), 0.0);
    const planes& p = *f.scene;
    sim::device_parameters<d3> device{.mass = m,
                                      .damping = damping,
                                      .load = vector(0.0, 0.0, -gravity * m),
                                      .period = T,
                                      .start = starts[i % f.starts] + aside};
    if (f.on == surface::smooth) return drop(port_of<Count>(p, m, K), f, device, K);
    if (f.on == surface::rough) {
      return drop(port_of<Count>(p, m, K, beside<ph::stick_slip>{}), f, device, K);
    }
    device.friction = friction;
    device.quantum = quantum;
    device.start = starts[2 - i % f.starts] + aside;
    const auto port =
        port_of<Count>(p, m, K,
                       beside<ph::frictionless, ph::quantised_energy, ph::mass_observer>{
                           .observer = {.damping = damping, .quantum = quantum},
                           .motion = {.mass = m, .quantum = quantum},
                           .push = hand_force + friction});
    return drop(port, f, device, K);
  });
}

}  // namespace

std::vector<std::string> run_settling(const session& s) {
  s.out.section(
      "Quiet: falls",
      "Dropped from 61 mm by their weight into planes that meet, 0.04 to 0.63 kg on 33 to "
      "1e9 N/m, drawn with --seed " +
          std::to_string(s.chosen.seed) +
          ", under reachable_bound; the bar of points, but 9 s in a flat cone without "
          "friction: what falls beside its axis rolls about in it, and an edge between planes "
          "at an angle a leaves it cos a of its speed, whatever the law. On encoders of step q a "
          "force "
          "K d of what they show steps by K q and hunts inside a step, so there the bars of "
          "q1, q2 and q3 are K q/2, q/2 (K/m)^0.5 and K q, where those are higher; of 4 q, where "
          "no "
          "friction of "
          "the device stops the hunt.");
  std::vector<fall> jobs;
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
  const auto rows = s.rows("settling.csv", "settling", jobs, [&s](const fall& job) {
    return job.scene->normals.size() > 3 ? judge<8>(job, s.chosen.seed)
                                         : judge<3>(job, s.chosen.seed);
  });
  ex::show_rows(s.out, "settling", rows);

  std::vector<std::string> found;
  for (const auto& r : rows) expect_quiet(found, r);
  return found;
}

}  // namespace contacts
