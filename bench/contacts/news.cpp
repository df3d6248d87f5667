// SPDX-License-Identifier: BSD-3-Clause
// What a hand that holds still feels of a world that does not: planes that appear, vanish, jump and turn 30
// times a second; and a surface that beats like a heart.
#include "quiet.hpp"
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/constraint_geometry/shell.hpp>
#include <passive_haptics/constraint_geometry/sphere.hpp>
#include <passive_haptics/contact/rigid_tool.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>

#include <Eigen/QR>

namespace contacts {

namespace {

using ph::laws::samples;

enum class order : std::uint8_t { one_a_frame, any };
const char* to_string(order o) {
  return o == order::any ? "any, several at once" : "one a frame";
}

struct news_row {
  int planes = 3;
  double stiffness = 500.0;  ///< [N/m]
  order events{};
  bool snapped = false;
  int seconds = 60;
  std::uint64_t seed = 1;
  double step = 0.0;        ///< the largest of the asked force in a tick [N]
  double shown = HUGE_VAL;  ///< of the stiffness, a second after news that end, at least
  double there = HUGE_VAL;  ///< of the force and stiffness that it comes to, then, at least
};
ex::record record_of(const news_row& r) {
  return {{"planes", r.planes},
          {"stiffness", r.stiffness, "%.0f"},
          {"events", to_string(r.events)},
          {"snapped", r.snapped},
          {"largest_step_N", r.step, "%.4f"},
          {"shown_after_1_s", r.shown, "%.3f"},
          {"of_what_it_comes_to", r.there, "%.4f"}};
}

/// What news may step a device by that holds still, whatever they are: R dt [N], and its rounding.
constexpr double most_step = ph::pursuit{}.force_rate * T * (1.0 + 1e-9);

/// What is shown at least a second after the news: of the stiffness, of which walls at an obtuse angle show less by their
/// softness, snapped or not; and of what it comes to.
constexpr double least_shown = 0.8, least_there = 0.999;

/// A port that gives what is asked for: the ledger has no say in these runs.
template <int Count>
auto bare_port(const ph::pursuit& pace) {
  return ph::passive_port{
      d3{}, ph::contact_set{ph::proxy_spring{.mass = 0.1}, pace, ph::slots<plane, Count>{}},
      ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
}

/// Plane i of a corner, or of two opposite ones, tilted by up to 0.3 rad, so deep in front of the origin [m].
plane some_plane(samples& random, int i, double deep, double K) {
  vector n = vector::Unit(i % 3) + 0.3 * random.direction<d3>();
  n.normalize();
  return {vector(n * deep), n, K};
}

/// What planes of one stiffness push the origin with: as far as the nearest point that is outside of all of them, which
/// lies on some of them and is found by trying each choice [N].
double push_of(const std::vector<plane>& all) {
  double nearest = all.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (std::size_t chosen = 0; chosen < std::size_t{1} << all.size(); ++chosen) {
    Eigen::MatrixXd normals(0, 3);
    Eigen::VectorXd deep(0);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((chosen >> i & 1U) == 0) continue;
      const vector n = all[i].normal, on = all[i].point;
      normals.conservativeResize(normals.rows() + 1, 3);
      deep.conservativeResize(normals.rows());
      normals.bottomRows(1) = n.transpose();
      deep.tail(1)[0] = n.dot(on);
    }
    vector x = vector::Zero();
    if (normals.rows() > 0) x = normals.completeOrthogonalDecomposition().solve(deep);
    const bool outside = std::all_of(all.begin(), all.end(), [&](const plane& p) {
      const vector n = p.normal, on = p.point;
      return n.dot(x - on) > -1e-12;
    });
    if (outside) nearest = std::min(nearest, x.norm());
  }
  return all.empty() ? 0.0 : all.front().stiffness * nearest;
}

/// Looks at a copy of a port that has no more news: the share of its stiffness that it shows after a second, and how much
/// of its force and of the stiffness that it comes to.
void look_after_a_second(news_row& row, auto port) {
  const auto rest = [&](int ticks) -> vector {
    for (; ticks > 1; --ticks) static_cast<void>(port.tick(vector::Zero(), ph::seconds{T}));
    return port.tick(vector::Zero(), ph::seconds{T}).force;
  };
  const auto push = [&](const vector& x) -> vector { return port.tick(x, ph::seconds{T}).force; };
  const vector force = rest(1000);
  if (force.norm() < 0.1) return;
  const double shown = ex::shown_by(push, vector(vector::Zero()));
  const vector in_the_end = rest(3000);
  const double at_last = ex::shown_by(push, vector(vector::Zero()));
  row.shown = std::min(row.shown, shown / row.stiffness);
  row.there =
      std::min({row.there, shown / at_last, 1.0 - (force - in_the_end).norm() / in_the_end.norm()});
}

/// Calls watch(tick, force, the planes that are told) in every tick.
template <int Count, class Watch>
news_row judge(news_row row, const Watch& watch) {
  const ph::pursuit pace =
      row.snapped ? ph::pursuit{.speed = 1e6, .turn_rate = 1e6, .force_rate = 1e9} : ph::pursuit{};
  auto port = bare_port<Count>(pace);
  samples random(row.seed);
  std::array<std::optional<plane>, Count> there{};
  std::array<double, Count> deep{};  // [m]
  const auto tell = [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    if (!there[at]) {  // it comes
      deep[at] = 1.5e-3 * (1.0 + random.number<double>());
    } else if (random.number<double>() < -0.5) {
      port.source().release(i);
      there[at].reset();
      return;
    } else {
      deep[at] = std::clamp(deep[at] + 1e-3 * random.number<double>(), 0.0, 3e-3);
    }
    const plane told = some_plane(random, i, deep[at], row.stiffness);
    there[at] = port.source().update(i, told) ? std::optional(told) : std::nullopt;
  };
  vector last = port.tick(vector::Zero(), ph::seconds{T}).force;
  for (int tick = 0; tick < row.seconds * 1000; ++tick) {
    if (tick % 33 == 0) {
      if (row.events == order::one_a_frame) {
        tell((tick / 33) % Count);
      } else {
        for (int i = 0; i < Count; ++i) {
          if (random.number<double>() > 0.0) tell(i);
        }
      }
    }
    const vector force = port.tick(vector::Zero(), ph::seconds{T}).force;
    watch(tick, force, there);
    row.step = std::max(row.step, (force - last).norm());
    last = force;
    if ((tick + 1) % (row.seconds * 125) == 0) {  // eight times
      look_after_a_second(row, port);
    }
  }
  return row;
}

template <int Count>
news_row judge(const news_row& row) {
  return judge<Count>(row, [](int, const vector&, const auto&) {});
}

/// A second of it, followed and snapped, as a file and a plot.
void plot_news(const session& s) {
  std::array<std::vector<double>, 3> felt;
  for (const bool snapped : {false, true}) {
    const news_row row{.planes = 3, .events = order::any, .snapped = snapped, .seconds = 1};
    static_cast<void>(judge<3>(row, [&](int, const vector& force, const auto& told) {
      felt[snapped ? 1 : 0].push_back(force.norm());
      if (!snapped) return;
      std::vector<plane> there;
      for (const auto& p : told) {
        if (p) there.push_back(*p);
      }
      felt[2].push_back(push_of(there));
    }));
  }
  ex::csv_file csv(s.out.path("news_force.csv"), "s,followed,snapped,the planes");
  for (std::size_t i = 0; i < felt[0].size(); ++i) {
    csv.row(static_cast<double>(i) * T, felt[0][i], felt[1][i], felt[2][i]);
  }
  csv.close();
  s.out.plot(
      "news_force",
      {"The force on a device that holds still while three planes change",
       {{"30 times a second a plane comes, goes or moves.", "news_force.csv",
         [](const ex::recorded& r) {
           const auto& force = r["snapped"];
           for (std::size_t i = 1; i < force.size(); ++i) {
             if (force[i] != force[i - 1] && i % 33 != 0) return false;
           }
           return true;
         }},
        {"Taken at once, which is what the planes say but for a softness of 5 % where they meet,",
         "news_force.csv",
         [](const ex::recorded& r) {
           const auto &force = r["snapped"], &ought = r["the planes"];
           double most = 0.0;
           for (std::size_t i = 0; i < force.size(); ++i) {
             most = std::max(most, std::abs(force[i] - ought[i]));
           }
           return ex::at_most(most / ex::most(ought), ph::proxy_spring{}.softness);
         }},
        {"that is a step of newtons,", "news_force.csv",
         [](const ex::recorded& r) { return ex::at_least(ex::largest_step(r["snapped"]), 1.0); }},
        ex::definition("a click in the hand;"),
        {"followed it is a slope.", "news_force.csv",
         [](const ex::recorded& r) { return ex::at_most(ex::largest_step(r["followed"]), 0.1); }}},
       {"news_force.csv", "the planes",
        "what pushes the device to the nearest place outside of all planes that are told"}},
      "set xlabel 'time [s]'\nset ylabel 'force [N]'\nset yrange [0:*]\nplot 'news_force.csv' "
      "using 1:3 with lines lt 2 lw 1.2, '' using 1:2 with lines lt 1");
}

/// News that are chosen for the step they make: of eight tries 30 times a second the one that steps most, several
/// surfaces at once, of one stiffness or of any, and other parameters.
struct greedy_row {
  std::string surfaces;
  bool any_stiffness = false;
  std::uint64_t seed = 1;
  int ticks = 60000;
  double step =
      0.0;  ///< the largest of the asked force in a tick [N]; of a tool a torque by its lever
};
ex::record record_of(const greedy_row& r) {
  return {{"surfaces", r.surfaces},
          {"stiffness", r.any_stiffness ? "any" : "one"},
          {"largest_step_N", r.step, "%.4f"}};
}

using box = ph::shell<ph::box_core<d3>>;
/// A surface so deep in front of the origin [m], or none, in a direction near an axis.
template <class Surface>
Surface any_surface(draws& d, double K) {
  vector n = vector::Unit(d.count(0, 2));
  if (d.chance(0.3)) n = -n;
  n += 0.3 * d.direction();
  n.normalize();
  const double deep = d.between(-1e-3, 3e-3), r = d.between(0.01, 0.06);
  if constexpr (std::same_as<Surface, plane>) {
    return {vector(n * deep), n, K};
  } else if constexpr (std::same_as<Surface, ph::sphere<d3>>) {
    return {.centre = vector(n * (deep - r)), .radius = r, .stiffness = K};
  } else if constexpr (std::same_as<Surface, box>) {
    return {.core = {.centre = vector(n * (deep - r)), .half = {0.5 * r, 0.4 * r, 0.6 * r}},
            .radius = 0.4 * r,
            .stiffness = K};
  } else {
    const vector t = d3::orthogonal(n);
    return {.point = vector(n * deep + t * d.between(-3e-3, 3e-3)),
            .normal = n,
            .tangent = t,
            .curvature = 1.0 / r,
            .cross_curvature = -0.5 / r,
            .stiffness = K,
            .thickness = 6e-3};
  }
}

/// `change`(port) is one try, `size`(a, b) [N] the step between two efforts.
template <class Port>
greedy_row greedy(greedy_row row, Port port, const auto& pose, draws& d, const auto& change,
                  const auto& size) {
  auto last = port.tick(pose, ph::seconds{T}).force;
  for (int tick = 0; tick < row.ticks; ++tick) {
    const auto before = port;
    double nearest = -1.0;
    auto felt = last;
    for (int candidate = 0; candidate < (tick % 33 == 0 ? 8 : 1); ++candidate) {
      auto next = before;
      if (candidate > 0) change(next);
      const auto force = next.tick(pose, ph::seconds{T}).force;
      const double step = size(force, last);
      row.step = std::max(row.step, step);
      const double wanted = step + (d.chance(0.3) ? 0.01 * force.norm() : 0.0);
      if (wanted <= nearest) continue;
      nearest = wanted;
      felt = force;
      port = next;
    }
    last = felt;
  }
  return row;
}

template <class Surface, int Count>
greedy_row greedy_point(greedy_row row) {
  draws d(row.seed);
  ph::passive_port port{
      d3{},
      ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<Surface, Count>{}},
      ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
  const auto change = [&](auto& p) {
    for (int i = d.count(1, Count); i > 0; --i) {
      const int slot = d.count(0, Count - 1);
      if (d.chance(0.2)) {
        p.source().release(slot);
      } else {
        const double K = row.any_stiffness ? d.scale(100.0, 10e3) : 500.0;
        static_cast<void>(p.source().update(slot, any_surface<Surface>(d, K)));
      }
    }
    if (row.any_stiffness && d.chance(0.2)) {
      static_cast<void>(
          p.set(ph::proxy_spring{.mass = d.scale(0.01, 0.3), .softness = d.between(0.01, 0.5)}));
    }
  };
  return greedy(row, port, vector(vector::Zero()), d, change,
                [](const vector& a, const vector& b) { return (a - b).norm(); });
}

/// A tool whose points move as well.
template <int Count>
greedy_row greedy_tool(greedy_row row) {
  using body = ph::rigid_body<double>;
  constexpr double lever = ph::tool_spring{}.lever;
  draws d(row.seed);
  ph::passive_port port{body{},
                        ph::rigid_tool{ph::tool_spring{.mass = 0.15, .least_inertia = 1e-4},
                                       ph::pursuit{}, ph::slots<plane, Count>{}},
                        ph::no_observer{}, ph::no_bound{},
                        ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
  const auto change = [&](auto& p) {
    for (int i = d.count(1, Count); i > 0; --i) {
      const int slot = d.count(0, Count - 1);
      const double K = row.any_stiffness ? d.scale(100.0, 10e3) : 500.0;
      const vector arm = d.between(0.0, 0.06) * d.direction();
      auto p_of = any_surface<plane>(d, K);
      p_of.point = vector(vector(p_of.point) + arm);
      if (d.chance(0.2)) {
        p.source().release(slot);
      } else {
        static_cast<void>(p.source().update(slot, arm, p_of));
      }
    }
  };
  return greedy(row, port, ph::rigid_pose<double>{}, d, change,
                [](const body::vector& a, const body::vector& b) {
                  const body::vector e = a - b;
                  return std::hypot(body::linear(e).norm(), body::angular(e).norm() / lever);
                });
}

using greedy_jobs = std::vector<std::pair<greedy_row, greedy_row (*)(greedy_row)>>;
void attack(greedy_jobs& jobs, const std::string& name, const session& s,
            greedy_row (*run)(greedy_row)) {
  for (const bool any : {false, true}) {
    jobs.push_back({{.surfaces = name,
                     .any_stiffness = any,
                     .seed = (static_cast<std::uint64_t>(s.chosen.seed) << 32U) + jobs.size(),
                     .ticks = s.chosen.quick ? 3000 : 60000},
                    run});
  }
}
template <class Surface>
void attack(greedy_jobs& jobs, const std::string& name, const session& s) {
  const auto add = [&](int count, greedy_row (*run)(greedy_row)) {
    attack(jobs, std::to_string(count) + " " + name, s, run);
  };
  add(1, greedy_point<Surface, 1>);
  add(3, greedy_point<Surface, 3>);
  add(16, greedy_point<Surface, 16>);
}

/// A surface of 10 mm at 1.2 Hz under a finger, told 30 times a second.
struct heart_row {
  double stiffness = 500.0;    ///< [N/m]
  double before_update = 0.0;  ///< the lag just before an update, at most [m]
  double lag = 0.0;            ///< at most [m]
  double step = 0.0;           ///< of the force in a tick, at most [N]
};
ex::record record_of(const heart_row& r) {
  return {{"stiffness", r.stiffness, "%.0f"},
          {"lag_before_update_mm", r.before_update * 1e3, "%.3f"},
          {"largest_lag_mm", r.lag * 1e3, "%.3f"},
          {"largest_step_N", r.step, "%.4f"}};
}
heart_row beat(heart_row row) {
  auto port = bare_port<1>({});
  vector last = vector::Zero();
  for (int tick = 0; tick < 20000; ++tick) {
    if (tick % 33 == 0) {
      const double z = 0.010 * std::sin(2.0 * 180.0 * degree * 1.2 * tick * T);
      const auto& slot = port.source().slot(0);
      if (slot.pressed() > 0.0)
        row.before_update = std::max(row.before_update, std::abs(slot.lag()));
      port.source().update(0, plane{vector(0.0, 0.0, z), vector(0.0, 0.0, 1.0), row.stiffness});
    }
    const vector force = port.tick(vector::Zero(), ph::seconds{T}).force;
    if (port.source().slot(0).pressed() > 0.0) {
      row.lag = std::max(row.lag, std::abs(port.source().slot(0).lag()));
    }
    row.step = std::max(row.step, (force - last).norm());
    last = force;
  }
  return row;
}

}  // namespace

std::vector<std::string> run_news(const session& s) {
  s.out.section(
      "News",
      "A device held still, up to 3 mm behind the planes of a corner that appear, "
      "vanish, move by 1 mm and "
      "turn by 0.3 rad 30 times a second. The largest step of the asked force in a tick, "
      "against a bar of 50 N/s, with --seed " +
          std::to_string(s.chosen.seed) +
          "; shown: of the stiffness, a second after news that end, and of the stiffness and "
          "force that it comes to 3 s later, the least of eight times; snapped: without pursuit.");
  std::vector<news_row> jobs;
  for (const double K : {500.0, 1000.0}) {
    for (const int n : {1, 3, 6}) {
      for (const order o : {order::one_a_frame, order::any}) {
        for (const bool snapped : {false, true}) {
          jobs.push_back(
              {.planes = n,
               .stiffness = K,
               .events = o,
               .snapped = snapped,
               .seconds = s.chosen.quick ? 10 : 120,
               .seed = (static_cast<std::uint64_t>(s.chosen.seed) << 32U) + jobs.size()});
        }
      }
    }
  }
  const auto rows = s.rows("news.csv", "news", jobs, [](const news_row& r) {
    return r.planes == 1 ? judge<1>(r) : r.planes == 3 ? judge<3>(r) : judge<6>(r);
  });
  ex::show_rows(s.out, "news", rows);

  greedy_jobs jobs_of_greed;
  attack<plane>(jobs_of_greed, "planes", s);
  attack<ph::quadric<d3>>(jobs_of_greed, "quadrics", s);
  attack<box>(jobs_of_greed, "box shells", s);
  attack<ph::sphere<d3>>(jobs_of_greed, "balls", s);
  attack(jobs_of_greed, "tool of 4 points", s, greedy_tool<4>);
  attack(jobs_of_greed, "tool of 16 points", s, greedy_tool<16>);
  const auto greed = s.rows("greedy_news.csv", "greedy news", jobs_of_greed,
                            [](const auto& job) { return job.second(job.first); });
  s.out.section("Greedy news",
                "A device held still while 30 times a second surfaces of 500 N/m, or of any "
                "stiffness from 0.1 to 10 kN/m and with parameters that change, come, go, move and "
                "turn so that the force steps by as much as eight tries find; the points of a "
                "tool move, too, and its torque counts by its lever. The bar is 50 N/s, whatever "
                "the news.");
  ex::show_rows(s.out, "greedy_news", greed);

  plot_news(s);
  s.out.section("A beating surface",
                "10 mm at 1.2 Hz under a finger that holds still, told 30 times a second.");
  const std::vector<heart_row> hearts{beat({500.0}), beat({2000.0})};
  ex::show_rows(s.out, "heart", hearts);

  std::vector<std::string> found;
  for (const auto& r : rows) {
    const std::string name = std::to_string(r.planes) + " planes, " + to_string(r.events);
    if (r.snapped) {
      expect(found, r.step > 0.5, name + ": the control does not step");
      continue;
    }
    expect(found, r.step <= most_step, name + ": a step of " + ex::format("%.4f", r.step) + " N");
    const std::string after = name + ex::format(", %.0f N/m: after a second ", r.stiffness);
    expect(found, r.shown >= least_shown, after + ex::format("%.3f of it is shown", r.shown));
    expect(found, r.there >= least_there, after + ex::format("%.4f of the end", r.there));
  }
  for (const auto& r : greed) {
    expect(found, r.step <= most_step,
           "greedy news, " + r.surfaces + ", " + (r.any_stiffness ? "any" : "one") +
               " stiffness: a step of " + ex::format("%.4f", r.step) + " N");
  }
  for (const auto& r : hearts) {
    expect(found, r.before_update <= 1e-3, "the heart: the surface lags behind");
  }
  return found;
}

}  // namespace contacts
