// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An organ: any tetrahedral mesh. A hand strokes it 1-3 mm below its surface while the environment
// answers at 30 Hz. Three runs along the same path:
//
//   reference   the environment solved at 1 kHz
//   bare        30 Hz, normals taken at once, no bound
//   passive     30 Hz, normals turned at a rate, force-rate limit and energy bound

#include "../common/report.hpp"
#include "ball.hpp"
#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <chrono>

namespace experiments {

/// The organ for those who bring none, which tests/data/make_organ.py makes, and its unit [m].
inline constexpr const char* organ = PASSIVE_HAPTICS_TEST_DATA "/organ.msh";
inline constexpr double millimetre = 1e-3;

inline env::tetrahedral_mesh read_mesh(const std::string& file, double unit) {
  return env::scaled(env::read_msh(std::filesystem::path(file)), unit);
}

/// Where the hand goes, and what holds the organ. Up is the axis along which it is thinnest; its
/// lowest 15 % is fixed; the stroke runs over the middle 40 % of its longest axis.
class stroke_scene {
 public:
  explicit stroke_scene(env::tetrahedral_mesh mesh)
      : mesh_(std::move(mesh)), surface_(env::boundary(mesh_)) {
    vector3 low = mesh_.nodes.front(), high = low;
    for (const auto& node : mesh_.nodes) {
      low = low.cwiseMin(node);
      high = high.cwiseMax(node);
    }
    const vector3 size = high - low;
    size.minCoeff(&up_);
    size.maxCoeff(&along_);
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) {
      if (mesh_.nodes[i](up_) < low(up_) + 0.15 * size(up_)) fixed_.push_back(static_cast<int>(i));
    }
    vertex_normals_.assign(mesh_.nodes.size(), vector3::Zero());
    for (const auto& t : surface_) {
      const auto [a, b, c] = env::corners(t, mesh_.nodes);
      const vector3 area = volume::cross(b - a, c - a);
      for (const int node : t.nodes) vertex_normals_[static_cast<std::size_t>(node)] += area;
    }
    const vector3 middle = (low + high) / 2.0;
    constexpr int samples = 2000;
    for (int i = 0; i <= samples; ++i) {
      vector3 foot = middle;
      foot(along_) += (static_cast<double>(i) / samples - 0.5) * 0.4 * size(along_);
      add_surface_point(foot);
    }
    if (path_.size() < samples / 2) {
      throw std::runtime_error("the middle of the mesh has no upper surface to stroke along axis " +
                               std::to_string(along_) + ": turn the mesh so that it lies flat");
    }
  }

  static constexpr double approach = 0.3, stroke = 2.0, leave = 0.3;  ///< [s]
  static constexpr double total = approach + stroke + leave;

  /// Where the hand is at t [s]: 5 mm above the surface, then 1-3 mm below it, then away.
  [[nodiscard]] vector3 position(double t) const {
    const double s = std::clamp((t - approach) / stroke, 0.0, 1.0);
    double depth = 0.002 - 0.001 * std::cos(4.0 * std::acos(-1.0) * s);
    if (t < approach) depth -= 0.006 * smooth(1.0 - t / approach);
    if (t > approach + stroke) depth -= 0.006 * smooth((t - approach - stroke) / leave);
    const double place = s * static_cast<double>(path_.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(place), path_.size() - 2);
    const double w = place - static_cast<double>(i);
    const point_on_surface &a = path_[i], &b = path_[i + 1];
    const vector3 normal = ((1.0 - w) * a.normal + w * b.normal).normalized();
    return (1.0 - w) * a.point + w * b.point - depth * normal;
  }
  [[nodiscard]] static bool stroking(double t) { return t >= approach && t <= approach + stroke; }
  [[nodiscard]] const env::tetrahedral_mesh& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<int>& fixed() const { return fixed_; }

 private:
  struct point_on_surface {
    vector3 point, normal;
  };

  [[nodiscard]] static double smooth(double s) {
    const double x = std::clamp(s, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
  }

  /// The highest point of the surface above or below `foot`, with the normal interpolated from its
  /// vertices, so that the path has no kinks of its own.
  void add_surface_point(const vector3& foot) {
    const Eigen::Index u = (up_ + 1) % 3, v = (up_ + 2) % 3;
    double best = -std::numeric_limits<double>::infinity();
    point_on_surface found;
    for (const auto& t : surface_) {
      const auto [a, b, c] = env::corners(t, mesh_.nodes);
      const double area = (b(u) - a(u)) * (c(v) - a(v)) - (b(v) - a(v)) * (c(u) - a(u));
      if (std::abs(area) < 1e-18) continue;
      const double wb =
          ((foot(u) - a(u)) * (c(v) - a(v)) - (foot(v) - a(v)) * (c(u) - a(u))) / area;
      const double wc =
          ((b(u) - a(u)) * (foot(v) - a(v)) - (b(v) - a(v)) * (foot(u) - a(u))) / area;
      if (wb < 0.0 || wc < 0.0 || wb + wc > 1.0) continue;
      const vector3 p = (1.0 - wb - wc) * a + wb * b + wc * c;
      if (p(up_) <= best) continue;
      best = p(up_);
      const vector3 n = (1.0 - wb - wc) * vertex_normals_[static_cast<std::size_t>(t.nodes[0])] +
                        wb * vertex_normals_[static_cast<std::size_t>(t.nodes[1])] +
                        wc * vertex_normals_[static_cast<std::size_t>(t.nodes[2])];
      found = {p, n.normalized()};
    }
    if (std::isfinite(best)) path_.push_back(found);
  }

  env::tetrahedral_mesh mesh_;
  std::vector<env::surface_triangle> surface_;
  std::vector<int> fixed_;
  std::vector<vector3> vertex_normals_;
  std::vector<point_on_surface> path_;
  Eigen::Index up_ = 2, along_ = 0;
};

inline constexpr env::material flesh{.young = 2e4, .poisson = 0.45};

struct stroke_result {
  std::vector<vector3> forces;
  double force_step = 0;          ///< largest in one tick [N]
  int contact_lost = 0;           ///< ticks of the stroke without force
  double port_energy = 0;         ///< least [J]
  std::vector<double> update_ms;  ///< wall-clock time of each environment update
};

template <class Model>
stroke_result follow_stroke(Model model, const stroke_scene& scene, double period, csv_file* csv) {
  env::deformable_body body(scene.mesh(), flesh, scene.fixed());
  sim::prescribed_motion<volume> device({.start = scene.position(0.0)});
  sim::update_schedule schedule(1, period, period);
  stroke_result result;
  vector3 last = vector3::Zero();
  const auto answer = [&](const auto& now) {
    if (!schedule.due(now.time)) return;
    const auto begin = std::chrono::steady_clock::now();
    const auto contact = body.update(now.sample.position, now.sample.held);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    result.update_ms.push_back(took.count());
    model.update(tangent_plane(contact));
  };
  const auto move = [&](const auto& now) {
    const vector3 &x = now.position, &f = now.force;
    result.force_step = std::max(result.force_step, (f - last).norm());
    last = f;
    if (stroke_scene::stroking(now.time) && f.norm() == 0.0) ++result.contact_lost;
    result.forces.push_back(f);
    if (csv != nullptr) {
      csv->row(now.time, x(0), x(1), x(2), f(0), f(1), f(2), f.norm(), now.out.depth,
               now.out.energy, device.meter().value());
    }
    device.move_to(scene.position(now.time + 1e-3));
  };
  const int ticks = static_cast<int>(stroke_scene::total * 1000.0);
  result.port_energy = sim::run(device, model, ticks, answer, move).least_energy;
  return result;
}

/// Root mean square of |f − f_ref| over the stroke [N].
inline double rms_error(const stroke_result& run, const stroke_result& reference) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = 0; n < run.forces.size(); ++n) {
    if (!stroke_scene::stroking(1e-3 * static_cast<double>(n + 1))) continue;
    sum += (run.forces[n] - reference.forces[n]).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline auto bare_model() {
  return ph::local_model{volume{},
                         ph::followed<ph::half_space<volume>>{},
                         ph::turn_at_once{},
                         ph::spring{},
                         ph::no_observer{},
                         ph::no_bound{},
                         ph::loop_limits{.longest_tick = 1e-3}};
}

inline auto passive_model() {
  return ph::local_model{volume{},
                         ph::followed<ph::half_space<volume>>{{.stale_after = 0.2}},
                         ph::turn_limited{.rate = 3.0},
                         ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 3.0}},
                         ph::reduced_energy{.damping = 0.03},
                         ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                                         ph::actuator_limit{.most = 9.0}},
                         ph::loop_limits{.longest_tick = 1e-3}};
}

inline void run_mesh(report& out, const stroke_scene& scene, const std::string& name) {
  progress bar("mesh", 3);
  const auto run = [&](const auto& model, double period, const std::string& title) {
    csv_file csv(out.path("mesh_" + title + ".csv"),
                 "time s,x m,y m,z m,fx N,fy N,fz N,force N,depth m,E1 J,port energy J");
    const stroke_result result = follow_stroke(model, scene, period, &csv);
    csv.close();
    bar.step();
    return result;
  };
  const stroke_result reference = run(bare_model(), 1e-3, "reference");
  const stroke_result bare = run(bare_model(), 1.0 / 30.0, "bare");
  const stroke_result passive = run(passive_model(), 1.0 / 30.0, "passive");

  std::vector<record> rows;
  const auto add = [&](const std::string& title, const char* rate, const stroke_result& r) {
    rows.push_back({{"run", title},
                    {"environment", rate},
                    {"largest force step N", r.force_step, "%.4f"},
                    {"contact lost, ticks", r.contact_lost},
                    {"rms force error N", rms_error(r, reference), "%.4f"},
                    {"min port energy J", r.port_energy}});
  };
  add("reference: turn_at_once, no bound", "1 kHz", reference);
  add("bare: turn_at_once, no bound", "30 Hz", bare);
  add("passive: turn_limited, force-rate limit, reachable bound", "30 Hz", passive);
  const double update_ms = median(passive.update_ms);
  out.section("Mesh: " + name,
              std::to_string(scene.mesh().nodes.size()) + " nodes, " +
                  std::to_string(scene.mesh().tetrahedra.size()) + " tetrahedra, " +
                  format("%g", flesh.young / 1e3) +
                  " kPa. A stroke 1-3 mm below the surface, haptic tick 1 kHz. Median "
                  "environment update " +
                  format("%.3f", update_ms) + " ms (wall clock of this machine).");
  out.show(table_of(rows, std::identity{}));
  std::cout << "median environment update " << format("%.3f", update_ms) << " ms\n\n";
  out.member("mesh", json_of(record{{"file", name},
                                    {"nodes", scene.mesh().nodes.size()},
                                    {"tetrahedra", scene.mesh().tetrahedra.size()},
                                    {"median update ms", update_ms}}));
  out.member("strokes", json_of(rows, std::identity{}));
  out.plot(
      "mesh_force", "Force along the stroke: reference at 1 kHz, bare and passive at 30 Hz",
      "set xlabel 'time [s]'\nset ylabel '|f| [N]'\nplot 'mesh_reference.csv' using 1:8 with "
      "lines lc rgb '#777777' title 'reference, 1 kHz', 'mesh_bare.csv' using 1:8 with lines lc "
      "rgb '#cc2222' title 'turn_at_once, no bound', 'mesh_passive.csv' using 1:8 with lines lc "
      "rgb "
      "'#2244aa' title 'passive'");
}

}  // namespace experiments
