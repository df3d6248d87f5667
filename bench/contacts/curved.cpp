// SPDX-License-Identifier: BSD-3-Clause
// A finger that strokes a ball of 50 mm, 1 to 3 mm deep, while what it touches is published 30 times a second;
// and the work that closed loops draw out of a surface.
#include "ball.hpp"
#include "quiet.hpp"
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>

namespace contacts {

namespace {

struct stroke_row {
  std::string surface;
  curved::feel feel{};
  ex::at_rest still{};  ///< in a hand that has stopped
};
ex::record record_of(const stroke_row& r) {
  return ex::with({{"surface", r.surface},
                   {"largest_step_N", r.feel.largest_step, "%.5f"},
                   {"mean_error_N", r.feel.mean_error, "%.5f"}},
                  r.still);
}
struct loop_row {
  std::string surface;
  double work = 0.0;  ///< the largest [J]
};
ex::record record_of(const loop_row& r) {
  return {{"surface", r.surface}, {"work_uJ", r.work * 1e6, "%.5f"}};
}

/// The usual path with seed 1, and one that is drawn with another.
curved::path path_of(int seed) {
  curved::path p;
  if (seed == 1) return p;
  draws d(static_cast<std::uint64_t>(seed));
  p.speed = d.between(0.02, 0.06);
  p.swing = d.between(0.5e-3, 1e-3);
  p.rate = d.between(0.002, 0.004);
  p.height = d.between(-0.5, 0.5);
  const vector start = d.direction(), side = d.direction();
  const vector up = d3::cross(start, side).normalized();
  p.attitude << start, d3::cross(up, start), up;
  return p;
}

/// Stroked through a set of contacts that gives what it asks for, without damping.
template <class Surface>
stroke_row stroke_of(const std::string& name, const curved::path& way, const auto& published,
                     int every, int ticks) {
  ph::passive_port port{d3{},
                        ph::contact_set{ph::proxy_spring{.mass = 0.1, .damping_ratio = 0.0},
                                        ph::pursuit{}, ph::slots<Surface, 1>{}},
                        ph::no_observer{}, ph::no_bound{},
                        ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
  const vector start = way.at(0);
  port.source().update(0, published(start));
  for (int i = 100; i > 0; --i)
    static_cast<void>(port.tick(start * (1.0 + 0.001 * i), ph::seconds{T}));
  vector end = start;
  stroke_row row{name, curved::stroked(
                           [&](int i, const vector& x) -> vector {
                             if (i % every == 0) port.source().update(0, published(x));
                             end = x;
                             return port.tick(x, ph::seconds{T}).force;
                           },
                           ticks, way)};
  held_point::parameters p{.damping = damping, .hand = still_hands[1]};
  p.start = end;
  p.goal = end - 5e-3 * end.normalized();
  add_held(row.still, port, 1, p, [&](int tick, const vector& x) {
    if (tick % every == 0) port.source().update(0, published(x));
    return false;
  });
  return row;
}

/// The plane through the nearest point of a ball cut into triangles.
plane facet(const curved::triangulated& ball, const vector& x) {
  double best = 1e9;
  plane found;
  for (const auto& t : ball.triangles) {
    const auto node = [&](std::size_t k) { return ball.nodes[static_cast<std::size_t>(t[k])]; };
    const vector middle = (node(0) + node(1) + node(2)) / 3.0;
    const double away = (middle - x).squaredNorm();
    if (away >= best) continue;
    best = away;
    found = {middle, d3::cross(node(1) - node(0), node(2) - node(0)), curved::stiffness};
  }
  static_cast<void>(found.prepare());
  return found;
}

/// A second of the usual stroke, of the quadric and of snapped triangles, as a file and a plot.
void plot_stroke(const session& s, const curved::triangulated& mesh) {
  ph::passive_port port{d3{},
                        ph::contact_set{ph::proxy_spring{.mass = 0.1, .damping_ratio = 0.0},
                                        ph::pursuit{}, ph::slots<ph::quadric<d3>, 1>{}},
                        ph::no_observer{}, ph::no_bound{},
                        ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
  port.source().update(0, curved::osculating<d3>(curved::stroke(0)));
  for (int i = 100; i > 0; --i) {  // it is met from outside, at 50 mm/s
    static_cast<void>(port.tick(curved::stroke(0) * (1.0 + 1e-3 * i), ph::seconds{T}));
  }
  ex::csv_file csv(s.out.path("stroke_force.csv"), "s,quadric at 30 Hz,nearest triangle,the ball");
  for (int i = 0; i < 1000; ++i) {
    const vector x = curved::stroke(i);
    if (i % 33 == 0) port.source().update(0, curved::osculating<d3>(x));
    const auto flat = facet(mesh, x);
    csv.row(i * T, port.tick(x, ph::seconds{T}).force.norm(),
            curved::stiffness * std::max(0.0, flat.at(x).depth),
            curved::stiffness * std::max(0.0, curved::radius - x.norm()));
  }
  csv.close();
  s.out.plot(
      "stroke_force",
      {"The force on a finger that strokes a ball",
       {{"The finger goes 1.25 to 3 mm deep and back,", "stroke_force.csv",
         [](const ex::recorded& r) {
           const auto mm = [&](double force) { return 1e3 * force / curved::stiffness; };
           const double shallow = mm(ex::least(r["the ball"])), deep = mm(ex::most(r["the ball"]));
           return ex::finding(std::abs(shallow - 1.25) < 0.05 && std::abs(deep - 3.0) < 0.05,
                              ex::format("%.3g to ", shallow) + ex::format("%.3g mm", deep));
         }},
        ex::definition("and the force should swing as smoothly."),
        {"On the nearest of 320 triangles it steps where it crosses an edge;", "stroke_force.csv",
         [](const ex::recorded& r) {
           return ex::at_least(ex::largest_step(r["nearest triangle"]), 0.05);
         }},
        {"on a quadric, which is published 30 times a second, it has none,", "stroke_force.csv",
         [](const ex::recorded& r) {
           return ex::at_most(ex::largest_step(r["quadric at 30 Hz"]), 0.01);
         }},
        {"and it is the ball's own.", "stroke_force.csv",
         [](const ex::recorded& r) {
           return ex::at_most(ex::rms_between(r["quadric at 30 Hz"], r["the ball"]), 1e-3);
         }}},
       {"stroke_force.csv", "the ball", "what the ball itself pushes with"}},
      "set xlabel 'time [s]'\nset ylabel 'force [N]'\nset yrange [0:*]\nplot 'stroke_force.csv' "
      "using 1:3 with lines lt 2 lw 1.2, '' using 1:2 with lines lt 1");
}

}  // namespace

std::vector<std::string> run_curved(const session& s) {
  const curved::path way = path_of(s.chosen.seed);
  s.out.section(
      "Curved surfaces: stroked",
      ex::format("A finger strokes a ball of 50 mm and 500 N/m at %.3g mm/s, ", 1e3 * way.speed) +
          ex::format("%.3g to ", 2.0 - 1e3 * way.swing) +
          ex::format("%.3g mm deep, ", 2.0 + 1e3 * way.swing) + "drawn with --seed " +
          std::to_string(s.chosen.seed) +
          " (1: the usual path, which the plot shows); what it touches is published every 33 ms. "
          "The largest step of the force in a tick, and the mean error against the ball. Snapped: "
          "the nearest of 320 triangles in every tick, which only the path is played to. Then a "
          "relaxed hand (100 N/m, 1 N·s/m) holds 0.1 kg there while the surface goes on being "
          "published." +
          std::string(ex::quiet_columns));
  const int ticks = s.chosen.quick ? 3000 : 20000;
  const auto tangent = [](const vector& x) {
    return plane{vector(x.normalized() * curved::radius), x, curved::stiffness};
  };
  const auto ball = [](const vector&) {
    return ph::sphere<d3>{
        .centre = {0.0, 0.0, 0.0}, .radius = curved::radius, .stiffness = curved::stiffness};
  };
  const auto mesh = curved::icosphere(2);
  std::vector<stroke_row> strokes{
      stroke_of<ph::sphere<d3>>("sphere", way, ball, 33, ticks),
      stroke_of<ph::quadric<d3>>("quadric of the sphere", way, curved::osculating<d3>, 33, ticks),
      stroke_of<plane>("tangent plane", way, tangent, 33, ticks)};
  strokes.push_back({"nearest triangle, snapped",
                     curved::stroked(
                         [&](int, const vector& x) {
                           const auto flat = facet(mesh, x);
                           const vector n = flat.normal;
                           return vector(n * (curved::stiffness * std::max(0.0, flat.at(x).depth)));
                         },
                         ticks, way),
                     {}});
  ex::show_rows(s.out, "stroke", strokes);

  plot_stroke(s, mesh);
  s.out.section(
      "Curved surfaces: loops",
      "The largest work that a closed loop of 10 by 2 mm, 1 to 3 mm under the surface, draws "
      "out of K d push(), the gradient of the depth; and out of K d along the normal. Quiet is "
      "not judged here, because a loop is a path without a device or a hand that could rest.");
  const auto quadric = [] {
    auto q = curved::osculating<d3>(vector(0.0, 0.0, 1.0));
    static_cast<void>(q.prepare());
    return q;
  }();
  const auto brick = curved::brick<d3>({0.0, 0.0, curved::radius}, 0.012);
  const auto loop_of = [](const auto& surface, bool along_normal) {
    return curved::largest_loop(
        [&](const vector& x) -> vector { return curved::force<d3>(surface, x, along_normal); });
  };
  const std::vector<loop_row> loops{{"quadric, 20/m", loop_of(quadric, false)},
                                    {"quadric, along its normal", loop_of(quadric, true)},
                                    {"brick of 12 mm", loop_of(brick, false)}};
  ex::show_rows(s.out, "loops", loops);

  std::vector<std::string> found;
  expect(found, strokes[1].feel.largest_step <= 0.0035, "the quadric steps");
  expect(found, strokes[1].feel.mean_error <= 0.0005, "the quadric is not the ball");
  expect(found, strokes[3].feel.largest_step > 0.1,
         "the control, snapped triangles, does not step");
  expect(found, loops[0].work <= 1e-8, "a loop draws work out of the quadric");
  expect(found, loops[1].work > 5e-5, "the control, along the normal, gives nothing out");
  return found;
}

}  // namespace contacts
