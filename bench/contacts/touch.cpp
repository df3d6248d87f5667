// SPDX-License-Identifier: BSD-3-Clause
// Is the asked force continuous where a contact begins? A device enters at a fixed velocity, and where it is in
// that tick is swept by 1 nm.
#include "program.hpp"
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>

namespace contacts {

namespace {

struct touch_row {
  const planes* scene = nullptr;
  double stiffness = 0.0;  ///< [N/m]
  double speed = 0.0;      ///< [m/s]
  double step = 0.0;       ///< the largest of the force over 1 nm [N]
  double damper = 0.0;     ///< B_s v, what a damper alone would jump by [N]
};
ex::record record_of(const touch_row& r) {
  return {{"scene", std::string(r.scene == nullptr ? "" : r.scene->name)},
          {"stiffness", r.stiffness, "%.0f"},
          {"speed_m_per_s", r.speed},
          {"largest_step_N", r.step},
          {"damper_N", r.damper}};
}

touch_row judge(touch_row row) {
  constexpr double mass = 0.1;
  ph::passive_port port{
      d3{}, ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{}, ph::slots<plane, 8>{}},
      ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
  for (std::size_t i = 0; i < row.scene->normals.size(); ++i) {
    port.source().update(static_cast<int>(i),
                         plane{vector(0.0, 0.0, 0.0), row.scene->normals[i], row.stiffness});
  }
  static_cast<void>(
      port.tick(vector(0.0, 0.0, 1.0), ph::seconds{T}));  // they are all met from outside
  ph::proxy_spring::at<double> rule({.mass = mass});
  rule.adopt(T);
  const auto spring = rule.sampled(row.stiffness);
  row.damper = spring.settling * spring.stiffness * row.speed;
  for (const vector& from : {vector(0.0, 0.0, 1.0), vector(0.36, -0.48, 0.8)}) {
    vector last = vector::Zero();
    for (int nm = -2000; nm < 20000; ++nm) {
      auto fresh = port;
      const vector here = vector(1e-6, 2e-6, -1e-9 * nm);
      static_cast<void>(fresh.tick(vector(here + from * (row.speed * T)), ph::seconds{T}));
      const vector force = fresh.tick(here, ph::seconds{T}).force;
      if (nm > -2000) row.step = std::max(row.step, (force - last).norm());
      last = force;
    }
  }
  return row;
}

}  // namespace

std::vector<std::string> run_touch(const session& s) {
  s.out.section("Touch",
                "The largest step of the asked force when a device that enters at a fixed speed is "
                "found 1 nm deeper; beside it what a damper that begins at once would jump by.");
  std::vector<touch_row> jobs;
  for (const auto& scene : all_planes()) {
    for (const double K : {500.0, 10e3}) {
      for (const double v : {0.045, 0.3}) {
        jobs.push_back({.scene = &scene, .stiffness = K, .speed = v});
      }
    }
  }
  const auto rows = s.rows("touch.csv", "touch", jobs, judge);
  ex::show_rows(s.out, "touch", rows);
  std::vector<std::string> found;
  for (const auto& r : rows) {
    expect(found, r.step <= 0.02 * r.damper, std::string(r.scene->name) + ": the touch is a step");
  }
  return found;
}

}  // namespace contacts
