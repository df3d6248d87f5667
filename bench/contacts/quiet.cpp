// SPDX-License-Identifier: BSD-3-Clause
// Is a point in a hand quiet where it rests, in scenes drawn at random, and in a loop that is late?
#include "quiet.hpp"

#include "../common/shares.hpp"
#include <passive_haptics/compositions.hpp>

#include <Eigen/Eigenvalues>

namespace contacts {

namespace {

constexpr int room = 8;
constexpr double least_share = 0.9;  // of the stiffness that can be shown, the median of a row
constexpr double slowest_of_a_scene = 0.5;  // [s]

struct point_scene {
  std::vector<plane> walls;
  held_point::parameters device;
  double told = 0.1;  ///< mass that the set is told [kg]
};

plane wall(const vector& n, double at, double K) {
  return {vector(n * at), n, K};
}
/// A direction so far above the horizontal [rad].
vector raised(double by, double around) {
  return tilted(90.0 * degree - by, around);
}

/// The walls of one kind; each has its own stiffness in three of five scenes.
using drawn = std::vector<plane> (*)(draws&);
struct kind {
  const char* name;
  drawn walls;
};
template <class Stiffness>
std::vector<plane> ring(int count, double rise, const Stiffness& K) {
  std::vector<plane> all;
  all.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    all.push_back(wall(raised(rise, 360.0 * degree * i / count), 0.0, K()));
  }
  return all;
}
auto stiffness_of(draws& d) {
  return [&d, same = d.chance(0.4), K = d.stiffness()] { return same ? K : d.stiffness(); };
}
vector any_way_up(draws& d) {
  const double rise = std::asin(d.between(0.0, 1.0));  // the order of arguments is no order
  return raised(rise, d.between(0.0, 360.0) * degree);
}

constexpr std::array<kind, 9> kinds{{
    {"plane",
     [](draws& d) {
       return std::vector<plane>{wall({0.0, 0.0, 1.0}, 0.0, d.stiffness())};
     }},
    {"corner of 3 walls",
     [](draws& d) {
       const auto K = stiffness_of(d);
       const vector a = any_way_up(d), b = any_way_up(d), c = any_way_up(d);
       return std::vector<plane>{wall(a, 0.0, K()), wall(b, 0.0, K()), wall(c, 0.0, K())};
     }},
    {"pit of 5-60 deg",
     [](draws& d) { return ring(3, d.between(5.0, 60.0) * degree, stiffness_of(d)); }},
    {"groove",
     [](draws& d) {
       const auto K = stiffness_of(d);
       const double rise = d.between(10.0, 60.0) * degree, slope = d.between(0.0, 30.0) * degree;
       std::vector<plane> all;
       for (const double side : {0.0, 180.0}) {
         vector n = raised(rise, side * degree);
         n = {n.x(), n.y() * std::cos(slope) - n.z() * std::sin(slope),
              n.y() * std::sin(slope) + n.z() * std::cos(slope)};
         all.push_back(wall(n, 0.0, K()));
       }
       if (d.chance(0.7)) all.push_back(wall({0.0, std::cos(slope), std::sin(slope)}, 0.0, K()));
       return all;
     }},
    {"2-6 walls, any angle",
     [](draws& d) {
       const auto K = stiffness_of(d);
       std::vector<plane> all;
       for (int i = d.count(2, 6); i > 0; --i) {
         const vector n = any_way_up(d);
         const double at = d.between(-1e-3, 1e-3);
         all.push_back(wall(n, at, K()));
       }
       return all;
     }},
    {"cone of 8 walls",
     [](draws& d) { return ring(8, d.between(45.0, 89.0) * degree, stiffness_of(d)); }},
    {"squeezed box",
     [](draws& d) {
       const auto K = stiffness_of(d);
       const vector z = d.direction(), x = d3::orthogonal(z), y = d3::cross(z, x);
       std::vector<plane> all;
       for (const vector& n : {x, y, z}) {
         const double gap = d.between(-2e-3, 1e-3);  // between the two
         all.push_back(wall(n, -gap / 2.0, K()));
         all.push_back(wall(-n, -gap / 2.0, K()));
       }
       return all;
     }},
    {"overlapping normals",
     [](draws& d) {
       const auto K = stiffness_of(d);
       const double lean = d.between(0.5, 8.0) * degree;
       std::vector<plane> all;
       for (int i = d.count(2, 6); i > 0; --i) {
         const double by = lean * d.between(0.5, 1.0), around = d.between(0.0, 360.0) * degree;
         const double at = d.between(-1e-4, 1e-4);
         all.push_back(wall(tilted(by, around), at, K()));
       }
       return all;
     }},
    {"walls that look at each other",
     [](draws& d) {
       const auto K = stiffness_of(d);
       std::vector<plane> all;
       const double around = d.between(0.0, 360.0);
       for (const double side : {0.0, 180.0}) {
         const double rise = d.between(1.0, 15.0) * degree;
         const double way = (around + side + d.between(-10.0, 10.0)) * degree;
         const double at = d.between(-1e-3, 1e-3);
         all.push_back(wall(raised(rise, way), at, K()));
       }
       const vector n = any_way_up(d);
       const double at = d.between(-1e-3, 1e-3);
       all.push_back(wall(n, at, K()));
       return all;
     }},
}};

point_scene any_scene(const kind& what, const still_hand& hand, draws& d) {
  point_scene s{.walls = what.walls(d),
                .device = {.hand = hand, .start = {0.0, 0.0, hand.stiffness > 0.0 ? 0.03 : 0.005}}};
  s.device.mass = d.scale(0.05, 1.0);
  s.device.damping = d.scale(0.02, 0.1);
  s.told = s.device.mass * d.told();
  const auto inside = [&s](const plane& w) {  // a device that begins there begins with news
    const vector n = w.normal;
    return (s.device.start - vector(w.point)).dot(n) < 0.0;
  };
  if (std::any_of(s.walls.begin(), s.walls.end(), inside)) s.device.start = 1e-4 * d.direction();
  vector into = 1e-3 * d.direction();  // where the walls hold it, off their axis
  for (const plane& w : s.walls) into -= d.between(0.3, 1.0) * vector(w.normal);
  into.normalize();
  s.device.load = into * d.between(1.0, 3.0);
  s.device.goal = into * d.between(1e-3, 0.01);
  if (hand.stiffness > 0.0) {
    const vector aside = d.direction(), beside = d.direction();
    s.device.load += aside * d.between(0.0, 1.0);
    s.device.goal += beside * d.between(0.0, 3e-3);
  }
  return s;
}

/// How long the softest slope h of what could press takes to lose 63 % of a swing, 2m/(5T h + b + b_h) [s], where the
/// walls damp by their depth over five ticks. A direction without any slope is free, and does not count.
double slowest_mode(const point_scene& s) {
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
  for (plane w : s.walls) {
    static_cast<void>(w.prepare());
    const vector n = w.normal;
    slope += std::min(w.stiffness, 0.1 * s.told / (T * T)) * n * n.transpose();
  }
  const Eigen::Vector3d h = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(slope).eigenvalues();
  int i = 0;
  while (h(i) < 1e-9 * h(2)) ++i;
  return 2.0 * s.device.mass / (5.0 * T * h(i) + s.device.damping + s.device.hand.damping);
}

/// One that has time to settle: with a mode slower than that no law can be quiet in time.
point_scene scene_of(const kind& what, const still_hand& hand, std::uint64_t seed) {
  draws d(seed);
  point_scene s = any_scene(what, hand, d);
  while (slowest_mode(s) > slowest_of_a_scene) s = any_scene(what, hand, d);
  return s;
}

auto port_in(const point_scene& s, const auto& limits, ph::proxy_spring spring = {}) {
  spring.mass = s.told;
  ph::passive_port port{
      d3{}, ph::contact_set{spring, ph::pursuit{}, ph::slots<plane, room>{}},
      ph::reduced_energy{.damping = s.device.damping},
      ph::reachable_bound{.mass = s.told, .hand_force = 1.2 * held_point::most(s.device)}, limits};
  int slot = 0;
  for (const plane& w : s.walls) port.source().update(slot++, w);
  return port;
}

/// Presses a copy of a port 1 µm deeper along its resting force.
template <class Port>
void probe(quiet_run& run, Port port, const point_scene& s, const vector& x) {
  asked_stiffness asked;
  for (int i = 0; i < static_cast<int>(s.walls.size()); ++i) {
    const auto& slot = port.source().slot(i);
    const double most = 0.1 * s.told / (T * T) * (1.0 - ph::proxy_spring{}.softness);
    asked.add(slot.pressed(), slot.target().stiffness, most);
  }
  asked.tell(run);
  run.shown = ex::shown_by(
      [&](const vector& at) -> vector { return port.tick(at, ph::seconds{T}).force; }, x);
}

template <int Late, class Port>
quiet_run run_of(Port port, const point_scene& s) {
  vector end;
  quiet_run run = held_still<Late>(port, static_cast<int>(s.walls.size()), s.device, no_news, &end);
  if (run.counts() && std::isfinite(run.settling)) probe(run, port, s, end);
  return run;
}

quiet_row point_row(const session& s, const kind& what, const still_hand& hand, int cases) {
  const auto seed = static_cast<std::uint64_t>(s.chosen.seed) << 32U;
  const auto part =
      static_cast<std::uint64_t>((&what - kinds.data()) * 3 + (&hand - still_hands.data()));
  return judged({.scene = what.name, .hand = hand.name, .cases = cases}, [&](int i) {
    const auto scene = scene_of(what, hand, seed + (part << 20U) + static_cast<std::uint64_t>(i));
    return run_of<0>(port_in(scene, ph::loop_limits{.longest_tick = T}), scene);
  });
}

/// The same scenes on springs without a damper, as a control.
quiet_row undamped_row(const session& s, const kind& what, const still_hand& hand, int cases) {
  const auto seed = (static_cast<std::uint64_t>(s.chosen.seed) << 32U) + (1U << 29U);
  return judged({.scene = what.name, .hand = hand.name, .cases = cases}, [&](int i) {
    const auto scene = scene_of(what, hand, seed + static_cast<std::uint64_t>(i));
    return run_of<0>(port_in(scene, ph::loop_limits{.longest_tick = T}, {.damping_ratio = 0.0}),
                     scene);
  });
}

template <int Late>
quiet_row late_row(const session& s, const still_hand& hand, int cases) {
  ph::late_loop_limits<Late> limits{};
  limits.longest_tick = T;
  const std::string ticks = std::to_string(Late) + (Late == 1 ? " tick" : " ticks");
  return judged(
      {.scene = "plane of 10 kN/m, " + ticks + " late", .hand = hand.name, .cases = cases},
      [&](int i) {
        const auto seed = (static_cast<std::uint64_t>(s.chosen.seed) << 32U) + (1U << 30U) +
                          static_cast<std::uint64_t>(i);
        auto scene = scene_of(kinds[0], hand, seed);
        scene.walls = {wall({0.0, 0.0, 1.0}, 0.0, 10e3)};
        return run_of<Late>(port_in(scene, limits), scene);
      });
}

/// A touch, asked as a set of one slot is.
template <class Touch>
class one_slot {
 public:
  one_slot(Touch touch, const plane& wall) : touch_(touch), normal_(wall.normal) {
    static_cast<void>(touch_.update(wall));
  }
  auto tick(const vector& x, ph::seconds<double> dt) {
    const auto out = touch_.tick(x, dt);
    pressed_ = vector(out.force).norm();
    return out;
  }
  [[nodiscard]] const one_slot& source() const { return *this; }
  [[nodiscard]] const one_slot& slot(int /*i*/) const { return *this; }
  [[nodiscard]] double pressed() const { return pressed_; }
  [[nodiscard]] vector normal() const { return normal_; }
  [[nodiscard]] double can_be() const { return touch_.explain().shown; }

 private:
  Touch touch_;
  vector normal_;
  double pressed_ = 0.0;
};

/// make_touch on a plane.
template <int Late>
quiet_row touch_row(const session& s, const still_hand& hand, int cases) {
  const auto seed = (static_cast<std::uint64_t>(s.chosen.seed) << 32U) + (1U << 31U);
  return judged(
      {.scene = std::to_string(Late) + " ticks late", .hand = hand.name, .cases = cases},
      [&](int i) {
        const auto scene = scene_of(kinds[0], hand, seed + static_cast<std::uint64_t>(i));
        const auto& is = scene.device;
        one_slot port(ph::make_touch<d3, plane, ph::late_loop_limits<Late>>(
                          ph::exact_device{.mass = scene.told,
                                           .damping = is.damping,
                                           .force_limit = 20.0,
                                           .longest_tick = T,
                                           .latency = Late},
                          ph::known_hand{.force = 1.2 * held_point::most(is)}),
                      scene.walls[0]);
        vector end;
        quiet_run run = held_still<Late>(port, 1, is, no_news, &end);
        run.asked = scene.walls[0].stiffness;
        run.can_be = port.can_be();
        run.shown = ex::shown_by(
            [&](const vector& at) -> vector { return port.tick(at, ph::seconds{T}).force; }, end);
        return run;
      });
}

/// A figure of the last window of all scenes, a curve for each kind and one for the control.
void plot_at_rest(const session& s, const std::vector<quiet_row>& rows,
                  const std::vector<quiet_row>& undamped, const std::string& name,
                  const std::string& label, double sim::quiet_figures::*figure, double unit) {
  std::vector<ex::figures> lists;
  const auto add = [&](const quiet_row& r, const std::string& list) {
    if (lists.empty() || lists.back().name != list) lists.push_back({list});
    for (const auto& last : r.last) lists.back().of.push_back(last.*figure / unit);
  };
  for (const auto& r : rows) add(r, r.scene);
  for (const auto& r : undamped) add(r, "without a damper");
  const double bar = sim::quiet_figures{}.*figure / unit;
  const std::string file = name + ".csv";
  const auto commands = ex::shares(s.out, file, lists, bar, 1e-16);
  s.out.plot(
      name,
      {"Every scene at rest: the " + label,
       {ex::definition("Of the last window of 100 ms, all hands together; at the left edge: "
                       "that or less."),
        {"Every kind of scene ends left of the dotted bar,", file,
         [=](const ex::recorded& r) {
           double most = 0.0;
           for (const auto& kind : kinds) {
             std::string column = kind.name;
             std::erase(column, ',');
             most = std::max(most, r[column].back());
           }
           return ex::at_most(most, bar);
         }},
        {"and the control without a damper goes on beyond it.", file,
         [=](const ex::recorded& r) { return ex::at_least(r["without a damper"].back(), bar); }}}},
      "set xlabel '" + label + "'\nset logscale x\nset xrange [1e-16:*]\nset format x '10^{%T}'\n" +
          commands);
}

}  // namespace

std::vector<std::string> run_quiet(const session& s) {
  s.out.section(
      "Quiet: points",
      "Scenes drawn at random with --seed " + std::to_string(s.chosen.seed) +
          ": walls of 0.3 to 80 kN/m, 0.05 to 1 kg of which 30 to 100 % are told, a load off the "
          "axis, a hand that is off, relaxed (100 N/m, 1 N·s/m) or stiff (400 N/m, 6 N·s/m) and "
          "holds still; 30 mm above the walls, or let go 5 mm above them. The bar: from 5 s on "
          "quiet, that is in windows of 100 ms a force of at "
          "most 0.02 N rms above 10 Hz (q1), a motion along what presses of at most 1 mm/s rms "
          "(q2), and "
          "no step of the force above 0.02 N a tick (q3); no energy lost. Watched for 6 s, or for "
          "30 "
          "if that is not enough: `slides` came to rest between 5 and 30 s, because they swing "
          "along "
          "an edge or in a shallow bowl that nothing damps; one in twenty may where no hand holds, "
          "none in a hand. Left out: what slid away, or presses nothing in the last second. "
          "Stiffness: medians along the resting force, and shown over what the sampling leaves of "
          "the asked one; the bar of its median is 0.9.");
  struct job {
    const kind* what;
    const still_hand* hand;
  };
  std::vector<job> jobs;
  for (const auto& what : kinds) {
    for (const auto& hand : still_hands) jobs.push_back({&what, &hand});
  }
  const int cases = s.chosen.quick ? 8 : 300;
  auto rows = s.rows("quiet.csv", "quiet", jobs,
                     [&](const job& j) { return point_row(s, *j.what, *j.hand, cases); });
  ex::show_rows(s.out, "quiet", rows);

  s.out.section("Quiet: late",
                "The same bar for one plane of 10 kN/m in a loop that is late, and is told so.");
  std::vector<quiet_row> late;
  for (const auto& hand : still_hands) {
    late.push_back(late_row<0>(s, hand, cases / 4));
    late.push_back(late_row<1>(s, hand, cases / 4));
    late.push_back(late_row<2>(s, hand, cases / 4));
    late.push_back(late_row<3>(s, hand, cases / 4));
  }
  ex::publish(s.out, "quiet_late", late);

  s.out.section("Quiet: make_touch",
                "The same bar for one plane behind make_touch, on time and late, drawn as above; "
                "shown over what explain() says.");
  std::vector<quiet_row> touches;
  for (const auto& hand : still_hands) {
    touches.push_back(touch_row<0>(s, hand, cases));
    touches.push_back(touch_row<1>(s, hand, cases / 2));
    touches.push_back(touch_row<2>(s, hand, cases / 2));
  }
  ex::publish(s.out, "quiet_touch", touches);

  s.out.section("Quiet: without a damper",
                "The control: such scenes in a relaxed hand on the same springs, ζ = 0, of which a "
                "quarter must not be quiet within 5 s.");
  std::vector<quiet_row> undamped;
  for (const auto& what : kinds) {
    undamped.push_back(undamped_row(s, what, still_hands[1], std::max(cases / 10, 4)));
  }
  ex::publish(s.out, "quiet_undamped", undamped);
  plot_at_rest(s, rows, undamped, "quiet_step", "largest step of the force [N a tick]",
               &sim::quiet_figures::step, 1.0);
  plot_at_rest(s, rows, undamped, "quiet_speed", "speed along what presses [mm/s]",
               &sim::quiet_figures::speed, 1e-3);

  std::vector<std::string> found;
  int ring = 0, tried = 0;
  for (const auto& r : undamped) {
    ring += r.unsettled + r.slides;
    tried += r.judged;
  }
  expect(found, 4 * ring > tried, "the control is quiet without a damper");
  for (const auto& r : rows) {
    expect_quiet(found, r);
    expect(found, r.share >= least_share,
           r.scene + ", hand " + r.hand + ": is quiet at " + ex::format("%.2f", r.share) +
               " of the stiffness that it could show");
  }
  for (const auto& r : late) expect_quiet(found, r);
  for (const auto& r : touches) {
    expect_quiet(found, r);
    expect(found, r.share >= least_share,
           "make_touch, " + r.scene + ", hand " + r.hand + ": shows " +
               ex::format("%.2f", r.share) + " of what it says");
  }
  return found;
}

}  // namespace contacts
