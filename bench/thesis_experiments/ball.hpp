// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ball of thesis section 3.3: 16 tetrahedra, 11 nodes, soft and held on one side. A hand pushes
// the device along z towards its centre; the environment answers every 0.5 s or at 30 Hz. Each
// answer turns the contact normal by degrees: taken at once (snap) it throws the device sideways.

#include "../common/report.hpp"
#include <passive_haptics/environment/ball.hpp>
#include <passive_haptics/environment/deformable_body.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <deque>

namespace experiments {

namespace ph = passive_haptics;
namespace env = passive_haptics::environment;
namespace sim = passive_haptics::simulation;

using volume = ph::space<double, 3>;
using vector3 = volume::vector;

/// 2 atan2(|a − b|, |a + b|): good at 0 and at π.
inline double angle_between(const vector3& a, const vector3& b) {
  return 2.0 * std::atan2((a - b).norm(), (a + b).norm());
}

/// The plane that the local model gets from a contact.
inline ph::half_space<volume> tangent_plane(const env::surface_contact& contact) {
  return {contact.point, contact.normal, contact.stiffness};
}

/// Largest |x(t+w) − 2x(t) + x(t−w)| at the updates: nothing for a steady motion, the whole jump
/// for one that happens within w of an update.
class jump_meter {
 public:
  static constexpr std::size_t window = 10;  ///< ticks: 10 ms

  void tick(const vector3& x, bool update) {
    path_.push_back({x, update});
    if (path_.size() <= 2 * window) return;
    const auto& middle = path_[window];
    if (middle.update) {
      largest_ = std::max(largest_, (path_.back().x - 2.0 * middle.x + path_.front().x).norm());
    }
    path_.pop_front();
  }
  [[nodiscard]] double largest() const { return largest_; }

 private:
  struct sample {
    vector3 x;
    bool update;
  };
  std::deque<sample> path_;
  double largest_ = 0.0;
};

struct ball_result {
  double normal_step = 0;    ///< [rad] in one tick, in contact
  double force_step = 0;     ///< [N] in one tick, in contact
  double position_jump = 0;  ///< [m]
};

/// The radius and what the ball is made of: soft enough that a few newtons turn its faces by
/// degrees.
inline constexpr double ball_radius = 0.05;
inline constexpr env::material ball_material{.young = 1e4, .poisson = 0.3};
inline constexpr double hand_limit = 10.0;  ///< [N]

template <class Normals>
ball_result press(const Normals& normals, double period, csv_file& csv) {
  const auto fixed = env::ball_fixed_nodes();
  env::deformable_body body(env::ball(ball_radius), ball_material, fixed);
  ph::local_model model{
      volume{},
      ph::following<ph::half_space<volume>>{},
      normals,
      ph::spring<volume>{},
      ph::reduced_energy<volume>{.damping = 0.03},
      ph::bound_chain{ph::force_rate_limit<volume>{.rate = 5.0},
                      ph::reachable_bound<volume>{.mass = 0.1, .hand_force = hand_limit}}};
  // Not quite on the axis: nobody's hand is, and on it four faces would be equally near.
  const vector3 start(0.003, 0.007, ball_radius + 0.010);
  const vector3 end(0.003, 0.007, 0.0);
  sim::impedance_hand<volume> hand{.stiffness = 150.0, .damping = 2.0, .limit = hand_limit};
  hand.aim(start, vector3::Zero(), 0.0);
  sim::device<volume, sim::impedance_hand<volume>> device({.mass = 0.1, .start = start}, hand);
  const sim::stroke<volume> path{.from = start, .to = end, .start = 0.1, .duration = 4.0};
  sim::update_schedule schedule(1, period, period);
  jump_meter jumps;
  ball_result result;
  vector3 last_force = vector3::Zero(), last_normal = vector3::UnitZ();
  int ticks_in_contact = 0;
  auto sample = device.exchange(vector3::Zero());
  for (int n = 0; n < 7000; ++n) {
    const double t = device.time();
    const bool update = schedule.due(t);
    if (update) model.retarget(tangent_plane(body.update(sample.position, sample.held)));
    const auto out = model.tick(sample);
    const vector3 normal = model.local().outward();
    ticks_in_contact = out.force.norm() > 0.0 ? ticks_in_contact + 1 : 0;
    if (ticks_in_contact > 1) {
      result.normal_step = std::max(result.normal_step, angle_between(normal, last_normal));
      result.force_step = std::max(result.force_step, (out.force - last_force).norm());
    }
    jumps.tick(device.position(), update && ticks_in_contact > 100);
    const vector3 wanted = model.target().outward();
    const vector3 x = device.position();
    csv.row(t, x(0), x(1), x(2), normal(0), normal(1), normal(2), wanted(0), wanted(1), wanted(2),
            out.force.norm(), out.depth);
    last_force = out.force;
    last_normal = normal;
    device.hand().aim(path.position(t), path.velocity(t), t);
    sample = device.exchange(out.force);
  }
  result.position_jump = jumps.largest();
  return result;
}

inline constexpr double turning_rate = 0.5;  ///< of the rotate-limited runs [rad/s]

inline void run_ball(report& out) {
  std::vector<std::string> json;
  table rows({"update s", "normals", "largest normal step deg", "largest force step N",
              "largest position jump mm"});
  const double degrees = 180.0 / std::acos(-1.0);
  progress bar("ball", 4);
  for (const double period : {0.5, 1.0 / 30.0}) {
    for (const bool limited : {false, true}) {
      const std::string name = limited ? "rotate_limited" : "snap";
      csv_file csv(out.path("ball_" + format("%.3f", period) + "_" + name + ".csv"),
                   "time s,x m,y m,z m,nx,ny,nz,environment nx,environment ny,environment nz,"
                   "force N,depth m");
      const ball_result r =
          limited ? press(ph::rotate_limited<volume>{.rate = turning_rate}, period, csv)
                  : press(ph::snap<volume>{}, period, csv);
      csv.close();
      bar.step();
      rows.add({format("%.3f", period), name, format("%.4f", r.normal_step * degrees),
                format("%.4f", r.force_step), format("%.4f", r.position_jump * 1e3)});
      json.push_back(json_object({{"update_s", json_number(period)},
                                  {"normals", json_string(name)},
                                  {"max_normal_step_deg", json_number(r.normal_step * degrees)},
                                  {"max_force_step_N", json_number(r.force_step)},
                                  {"max_position_jump_mm", json_number(r.position_jump * 1e3)}}));
    }
  }
  out.section(
      "Ball (thesis section 3.3)",
      "16 tetrahedra, 11 nodes, radius 50 mm, 10 kPa, held at three nodes of its lower side. "
      "A hand of 150 N/m pushes a device of 0.1 kg along z towards the centre. All four runs "
      "have the same force-rate limit and reachable bound. A position jump is "
      "|x(t+10 ms) − 2x(t) + x(t−10 ms)| at an update. Rotate-limited: 0.5 rad/s, 0.0286 "
      "degrees a tick.");
  out.show(rows);
  out.member("ball", json_array(json));
  const auto positions = [&out](const std::string& name, const std::string& caption,
                                const std::string& run) {
    const std::string data = "'ball_" + run + ".csv' using 1:";
    out.plot(name, caption,
             "set xlabel 'time [s]'\nset ylabel 'device position [mm]'\nplot " + data +
                 "($2*1e3) with lines title 'x', " + data + "($3*1e3) with lines title 'y', " +
                 data + "($4*1e3) with lines title 'z'");
  };
  const auto normals = [&out](const std::string& name, const std::string& caption,
                              const std::string& columns, const std::string& run) {
    out.plot(name, caption,
             "set size ratio -1\nset xtics 0.05\nset ytics 0.05\nset xlabel 'n_x'\nset ylabel "
             "'n_y'\nplot 'ball_" +
                 run + ".csv' using " + columns + " with linespoints pt 7 ps 0.4 notitle");
  };
  positions("fig_3_5", "As Fig. 3.5: updates every 0.5 s, normals taken at once: jumps",
            "0.500_snap");
  normals("fig_3_6", "As Fig. 3.6: the normals that the environment sends, x-y view", "8:9",
          "0.500_snap");
  positions("fig_3_7", "As Fig. 3.7: the same with rotate-limited normals: smooth",
            "0.500_rotate_limited");
  normals("fig_3_8a", "As Fig. 3.8a: normals sent by the environment, x-y view", "8:9",
          "0.500_rotate_limited");
  normals("fig_3_8b", "As Fig. 3.8b: the same in the local model", "5:6", "0.500_rotate_limited");
}

}  // namespace experiments
