// SPDX-License-Identifier: BSD-3-Clause
#include "ball.hpp"

#include "../common/rows.hpp"
#include "tangent_plane.hpp"
#include <passive_haptics/environment/ball.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <set>
#include <vector>

namespace experiments {

namespace {

/// 2 atan2(|a − b|, |a + b|): good at 0 and at π.
double angle_between(const vector3& a, const vector3& b) {
  return 2.0 * std::atan2((a - b).norm(), (a + b).norm());
}

/// Largest |x(t+w) − 2x(t) + x(t−w)|, w = 10 ms, at the ticks `updates`: nothing for a steady motion,
/// the whole jump for one that happens within w of an update.
double largest_jump(const std::vector<vector3>& path, const std::vector<std::size_t>& updates) {
  constexpr std::size_t w = 10;  // ticks
  double largest = 0.0;
  for (const std::size_t n : updates) {
    if (n < w || n + w >= path.size()) continue;
    largest = std::max(largest, (path[n + w] - 2.0 * path[n] + path[n - w]).norm());
  }
  return largest;
}

template <class Normals>
ball_result press_with(const Normals& normals, double period, csv_file& csv) {
  const auto fixed = env::ball_fixed_nodes();
  env::deformable_body body(env::ball(ball_radius), ball_material, fixed);
  ph::local_model model{volume{},
                        ph::followed<ph::half_space<volume>>{},
                        normals,
                        ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 5.0}},
                        ph::reduced_energy{.damping = 0.03},
                        ph::reachable_bound{.mass = 0.1, .hand_force = hand_limit},
                        ph::loop_limits{.longest_tick = 1e-3}};
  // Not quite on the axis: nobody's hand is, and on it four faces would be equally near.
  const vector3 start(0.003, 0.007, ball_radius + 0.010);
  const vector3 end(0.003, 0.007, 0.0);
  sim::impedance_hand<volume> hand{.stiffness = 150.0, .damping = 2.0, .limit = hand_limit};
  hand.aim(start, vector3::Zero(), 0.0);
  sim::device<volume, sim::impedance_hand<volume>> device({.mass = 0.1, .start = start}, hand);
  const sim::stroke<volume> path{.from = start, .to = end, .start = 0.1, .duration = 4.0};
  sim::update_schedule schedule(1, period, period);
  std::vector<vector3> travelled;
  std::vector<std::size_t> updates;  // deep in contact
  ball_result result;
  vector3 last_force = vector3::Zero(), last_normal = vector3::UnitZ();
  int ticks_in_contact = 0;
  bool update = false;
  const auto answer = [&](const auto& now) {
    update = schedule.due(now.time);
    if (update) model.update(tangent_plane(body.update(now.sample.position, now.sample.held)));
  };
  const auto push = [&](const auto& now) {
    const vector3 normal = model.local().normal, wanted = model.target().normal;
    const vector3 &x = now.position, &force = now.force;
    ticks_in_contact = force.norm() > 0.0 ? ticks_in_contact + 1 : 0;
    if (ticks_in_contact > 1) {
      result.normal_step = std::max(result.normal_step, angle_between(normal, last_normal));
      result.force_step = std::max(result.force_step, (force - last_force).norm());
    }
    if (update && ticks_in_contact > 100) updates.push_back(travelled.size());
    travelled.push_back(x);
    csv.row(now.time, x(0), x(1), x(2), normal(0), normal(1), normal(2), wanted(0), wanted(1),
            wanted(2), force.norm(), now.out.depth);
    last_force = force;
    last_normal = normal;
    device.hand().aim(path.position(now.time), path.velocity(now.time), now.time);
  };
  sim::run(device, model, 7000, answer, push);
  result.position_jump = largest_jump(travelled, updates);
  return result;
}

}  // namespace

ball_result press(bool limited, double period, csv_file& csv) {
  return limited ? press_with(ph::turn_limited{.rate = turning_rate}, period, csv)
                 : press_with(ph::turn_at_once{}, period, csv);
}

void run_ball(report& out) {
  std::vector<record> rows;
  const double degrees = 180.0 / std::acos(-1.0);
  progress bar("ball", 4);
  for (const double period : {0.5, 1.0 / 30.0}) {
    for (const bool limited : {false, true}) {
      const std::string name = limited ? "turn_limited" : "turn_at_once";
      csv_file csv(out.path("ball_" + format("%.3f", period) + "_" + name + ".csv"),
                   "time s,x m,y m,z m,nx,ny,nz,environment nx,environment ny,environment nz,"
                   "force N,depth m");
      const ball_result r = press(limited, period, csv);
      csv.close();
      bar.step();
      rows.push_back({{"update s", period, "%.3f"},
                      {"normals", name},
                      {"largest normal step deg", r.normal_step * degrees, "%.4f"},
                      {"largest force step N", r.force_step, "%.4f"},
                      {"largest position jump mm", r.position_jump * 1e3, "%.4f"}});
    }
  }
  const std::string at_once = "ball_0.500_turn_at_once.csv", slowly = "ball_0.500_turn_limited.csv";
  const auto turned = [degrees](const recorded& r) {
    double most_turned = 0.0;  // the file has seven digits
    for (std::size_t n = 1; n < r["nx"].size(); ++n) {
      most_turned =
          std::max(most_turned, std::hypot(r["nx"][n] - r["nx"][n - 1], r["ny"][n] - r["ny"][n - 1],
                                           r["nz"][n] - r["nz"][n - 1]));
    }
    return between(degrees * most_turned, 0.0285, 0.0287);
  };
  out.section(
      "Ball (thesis section 3.3)",
      {definition(
           "16 tetrahedra, 11 nodes, radius 50 mm, 10 kPa, held at three nodes of its lower "
           "side. A hand of 150 N/m pushes a device of 0.1 kg along z towards the centre. All "
           "four runs have the same force-rate limit and reachable bound. A position jump is "
           "|x(t+10 ms) − 2x(t) + x(t−10 ms)| at an update."),
       {"turn_limited: 0.5 rad/s, 0.0286 degrees a tick.", slowly, turned}});
  show_rows(out, "ball", rows);
  const auto positions = [&out](const std::string& name, const caption& said,
                                const std::string& run) {
    const std::string data = "'ball_" + run + ".csv' every 4 using 1:";
    out.plot(name, said,
             "set xlabel 'time [s]'\nset ylabel 'device position [mm]'\nset xrange [0:7]\nplot " +
                 data + "($2*1e3) with lines title 'x', " + data +
                 "($3*1e3) with lines title 'y', " + data + "($4*1e3) with lines title 'z'");
  };
  const auto normals = [&out](const std::string& name, const caption& said,
                              const std::string& columns, const std::string& run) {
    out.plot(name, said,
             "set xtics 0.05\nset ytics 0.05\nset xlabel 'normal, x'\nset ylabel 'normal, y'\n"
             "plot 'ball_" +
                 run + ".csv' every 20 using " + columns + " with linespoints lt 1 lw 1 notitle");
  };
  // The most that the device is off a straight way over 20 ms about the update of 6 s, as in the table [m].
  const auto jump = [](const recorded& r) {
    const auto &t = r["time s"], &x = r["x m"], &y = r["y m"], &z = r["z m"];
    double largest = 0.0;
    for (std::size_t n = 10; n + 10 < t.size(); ++n) {
      if (t[n] < 5.9 || t[n] > 6.1) continue;
      const auto bend = [n](const std::vector<double>& q) {
        return q[n + 10] - 2 * q[n] + q[n - 10];
      };
      largest = std::max(largest, std::hypot(bend(x), bend(y), bend(z)));
    }
    return largest;
  };
  // The largest way from one plotted normal to the next.
  const auto gap = [](const recorded& r, const std::string& x, const std::string& y) {
    double largest = 0.0;
    for (std::size_t n = 20; n < r[x].size(); n += 20) {
      largest = std::max(largest, std::hypot(r[x][n] - r[x][n - 20], r[y][n] - r[y][n - 20]));
    }
    return largest;
  };
  const auto sent = [gap](const recorded& r) {
    return between(gap(r, "environment nx", "environment ny"), 0.15, 0.25);
  };
  // How far the device has slid in y in the second after the update of 6 s [mm].
  const auto slid = [](const recorded& r) {
    const auto y = r.within("y m", 6.0, 7.0);
    return at_least(1e3 * (y.back() - y.front()), 1.5);
  };
  const auto no_axis = definition("The picture is cut out about the points: no axis begins at 0.");
  positions("fig_3_5",
            {"As Fig. 3.5: an update every 0.5 s, normals taken at once",
             {{"Look at 6 s: an update turns the face under the device,", at_once,
               [](const recorded& r) {
                 return at_least(std::max(swing(r.within("environment nx", 5.98, 6.02)),
                                          swing(r.within("environment ny", 5.98, 6.02))),
                                 0.1);
               }},
              {"which jumps aside by half a millimetre within 20 ms,", at_once,
               [jump](const recorded& r) { return between(1e3 * jump(r), 0.4, 0.7); }},
              {"slides on by 2 mm", at_once, slid},
              {"and rings.", at_once,
               [](const recorded& r) {
                 const auto y = r.within("y m", 6.0, 7.0);
                 return at_least(1e3 * (most(y) - y.back()), 0.1);
               }}}},
            "0.500_turn_at_once");
  normals("fig_3_6",
          {"As Fig. 3.6: the normals that the environment sends, seen from above",
           {definition("Each point is the direction of the surface in one update."),
            {"Two of them lie 0.2 rad apart,", at_once, sent},
            {"and what follows them at once jumps as far.", at_once,
             [gap](const recorded& r) {
               return gap(r, "nx", "ny") == gap(r, "environment nx", "environment ny");
             }},
            no_axis}},
          "8:9", "0.500_turn_at_once");
  positions("fig_3_7",
            {"As Fig. 3.7: the same with normals that turn slowly",
             {{"There is no jump at 6 s:", slowly,
               [jump](const recorded& r) { return at_most(1e3 * jump(r), 0.1); }},
              {"the device slides to where the surface has turned.", slowly, slid}}},
            "0.500_turn_limited");
  normals("fig_3_8a",
          {"As Fig. 3.8a: what the environment sends to the slow normals, seen from above",
           {{"A few points far apart, as before:", slowly, sent},
            {"there are no more than updates, two a second.", slowly,
             [](const recorded& r) {
               std::set<double> all(r["environment nx"].begin(), r["environment nx"].end());
               return between(static_cast<double>(all.size()), 2, 2 * 7 + 1);
             }},
            no_axis}},
          "8:9", "0.500_turn_limited");
  normals("fig_3_8b",
          {"As Fig. 3.8b: what the local model makes of it",
           {{"The same journey without a gap:", slowly,
             [gap](const recorded& r) {
               return at_most(gap(r, "nx", "ny"), 20 * turning_rate * 1e-3 + 1e-9);
             }},
            {"a tick turns the normal by at most 0.0286 degrees,", slowly, turned},
            definition("and every twentieth has a point."),
            no_axis}},
          "5:6", "0.500_turn_limited");
}

}  // namespace experiments
