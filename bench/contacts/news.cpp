// SPDX-License-Identifier: BSD-3-Clause
// What a hand that holds still feels of a world that does not: planes that appear, vanish, jump and turn 30
// times a second; and a surface that beats like a heart.
#include "program.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>

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
  double step = 0.0;      ///< the largest of the asked force in a tick [N]
  double of_bound = 0.0;  ///< the largest share of what the bound allows
};
ex::record record_of(const news_row& r) {
  return {
      {"planes", r.planes},   {"stiffness", r.stiffness, "%.0f"}, {"events", to_string(r.events)},
      {"snapped", r.snapped}, {"largest_step_N", r.step, "%.4f"}, {"of_bound", r.of_bound, "%.3f"}};
}

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

/// Calls watch(tick, force) in every tick.
template <int Count, class Watch>
news_row judge(news_row row, const Watch& watch) {
  const ph::pursuit pace =
      row.snapped ? ph::pursuit{.speed = 1e6, .turn_rate = 1e6} : ph::pursuit{};
  auto port = bare_port<Count>(pace);
  samples random(row.seed);
  std::array<bool, Count> there{};
  std::array<double, Count> deep{};  // [m]
  const auto tell = [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    if (!there[at]) {
      deep[at] = 1.5e-3 * (1.0 + random.number<double>());
    } else if (random.number<double>() < -0.5) {
      port.source().release(i);
      there[at] = false;
      return;
    } else {
      deep[at] = std::clamp(deep[at] + 1e-3 * random.number<double>(), 0.0, 3e-3);
    }
    there[at] = port.source().update(i, some_plane(random, i, deep[at], row.stiffness));
  };
  const double eps = ph::proxy_spring{}.softness;
  const double apart = std::sqrt(double(Count)) / (2.0 * std::sqrt(eps * (1.0 - eps)));
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
    double speed = pace.speed, sum = 0.0;  // the bound, from what there is before the tick
    for (int i = 0; i < Count; ++i) {
      const auto& slot = port.source().slot(i);
      speed = std::max(speed, slot.speed());
      sum += slot.pressed();
    }
    const vector force = port.tick(vector::Zero(), ph::seconds{T}).force;
    watch(tick, force);
    for (int i = 0; i < Count; ++i) {  // a surface that has been met in it as well
      speed = std::max(speed, port.source().slot(i).speed());
    }
    const double step = (force - last).norm();
    const double bound =
        (apart * (row.stiffness * speed + pace.turn_rate * last.norm()) + pace.turn_rate * sum) * T;
    row.step = std::max(row.step, step);
    if (!row.snapped) row.of_bound = std::max(row.of_bound, step / bound);
    last = force;
  }
  return row;
}

template <int Count>
news_row judge(const news_row& row) {
  return judge<Count>(row, [](int, const vector&) {});
}

/// A second of it, followed and snapped, as a file and a plot.
void plot_news(const session& s) {
  std::array<std::vector<double>, 2> felt;
  for (const bool snapped : {false, true}) {
    const news_row row{.planes = 3, .events = order::any, .snapped = snapped, .seconds = 1};
    static_cast<void>(judge<3>(
        row, [&](int, const vector& force) { felt[snapped ? 1 : 0].push_back(force.norm()); }));
  }
  ex::csv_file csv(s.out.path("news_force.csv"), "s,followed,snapped");
  for (std::size_t i = 0; i < felt[0].size(); ++i) {
    csv.row(static_cast<double>(i) * T, felt[0][i], felt[1][i]);
  }
  csv.close();
  s.out.plot(
      "news_force",
      {"The force on a device that holds still while three planes change",
       "30 times a second a plane comes, goes or moves. Taken at once it is a step of newtons, "
       "a click in the hand; followed it is a slope."},
      "set xlabel 'time [s]'\nset ylabel 'force [N]'\nset yrange [0:*]\nplot 'news_force.csv' "
      "using 1:3 with lines lt 2 lw 1.2, '' using 1:2 with lines lt 1");
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
  s.out.section("News",
                "A device held still, up to 3 mm behind the planes of a corner that appear, "
                "vanish, move by 1 mm and "
                "turn by 0.3 rad 30 times a second. The largest step of the asked force in a tick, "
                "and the largest share of the proved bound; snapped: without pursuit.");
  std::vector<news_row> jobs;
  for (const double K : {500.0, 1000.0}) {
    for (const int n : {1, 3, 6}) {
      for (const order o : {order::one_a_frame, order::any}) {
        for (const bool snapped : {false, true}) {
          jobs.push_back({.planes = n,
                          .stiffness = K,
                          .events = o,
                          .snapped = snapped,
                          .seconds = s.chosen.quick ? 10 : 120});
        }
      }
    }
  }
  const auto rows = s.rows("news.csv", "news", jobs, [](const news_row& r) {
    return r.planes == 1 ? judge<1>(r) : r.planes == 3 ? judge<3>(r) : judge<6>(r);
  });
  ex::show_rows(s.out, "news", rows);

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
    expect(found, r.of_bound <= 1.0, name + ": a step beyond the bound");
    if (r.planes == 3 && r.stiffness == 500.0 && r.events == order::one_a_frame) {
      expect(found, r.step <= 0.06, name + ": a step of " + std::to_string(r.step) + " N");
    }
  }
  for (const auto& r : hearts) {
    expect(found, r.before_update <= 1e-3, "the heart: the surface lags behind");
  }
  return found;
}

}  // namespace contacts
