// SPDX-License-Identifier: BSD-3-Clause
// Is the asked force continuous where a contact begins? A device enters at a fixed velocity, and where it is in
// that tick is swept by 1 nm. And is it where the world goes on, under a device that holds still?
#include "quiet.hpp"
#include <passive_haptics/compositions.hpp>
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
  std::uint64_t seed = 1;
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
  draws d(row.seed);
  const vector aslant = tilted(d.between(20.0, 60.0) * degree, d.between(0.0, 360.0) * degree);
  for (const vector& from : {vector(0.0, 0.0, 1.0), aslant}) {
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

/// News of a plane that heaves, under a device that holds still in it.
struct heave_row {
  const char* told = "";
  int (*ticks)(draws&) = nullptr;  ///< from news to news
  double most_of_bare = 0.0;       ///< bar of the rms error of a touch over that of bare news
  double most_step = 0.02;         ///< bar of its largest step [N]
  int cases = 0;
  struct felt {
    double step = 0.0;  ///< the largest of the force in a tick [N]
    double rms = 0.0;   ///< of its error, the mean of the cases [N]
  } truth{}, bare{}, before{}, touch{};
};
ex::record record_of(const heave_row& r) {
  return {{"told", r.told},
          {"cases", r.cases},
          {"truth_step_N", r.truth.step, "%.4f"},
          {"bare_step_N", r.bare.step, "%.3f"},
          {"before_step_N", r.before.step, "%.3f"},
          {"touch_step_N", r.touch.step, "%.4f"},
          {"bare_rms_N", r.bare.rms, "%.3f"},
          {"before_rms_N", r.before.rms, "%.3f"},
          {"touch_rms_N", r.touch.rms, "%.3f"}};
}
/// A law by itself: no ledger and no bound, so that every step of what it asks for is felt.
template <class Law>
auto touching(const Law& law) {
  return ph::local_model{d3{},
                         ph::followed<plane>{},
                         ph::turn_limited{.rate = 2.0},
                         law,
                         ph::no_observer{},
                         ph::no_bound{},
                         ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
}
/// Any direction, 0.5 to 4 kN/m and 0.5 to 1.5 Hz, so that the force itself changes by 5 to 14 N/s at most; 8 s, of which
/// the first does not count.
void heave(heave_row& row, draws& d) {
  const double K = d.scale(500.0, 4000.0), turn = 360.0 * degree * d.between(0.5, 1.5);
  const double high = d.between(5.0, 14.0) / (K * turn), deep = high * d.between(1.2, 3.0);
  const vector n = d.direction(), x = n * -deep + d3::orthogonal(n) * d.between(-0.05, 0.05);
  constexpr ph::damped_spring spring{.mass = 0.1};
  auto touch = touching(ph::eased{spring});
  auto before = touching(spring);
  vector bare = vector::Zero();
  struct felt_now {
    heave_row::felt* all;
    vector last;
    double squares;
  };
  std::array<felt_now, 4> felt{
      {{&row.truth, {}, 0.0}, {&row.bare, {}, 0.0}, {&row.before, {}, 0.0}, {&row.touch, {}, 0.0}}};
  constexpr int begin = 1000, end = 8000;
  for (int tick = 0, next = 0; tick < end; ++tick) {
    const double height = high * std::sin(turn * T * tick);
    const vector right = n * (K * (deep + height));
    if (tick >= next) {
      next = tick + row.ticks(d);
      const plane told{vector(n * height), n, K};
      touch.update(told);
      before.update(told);
      bare = right;
    }
    const std::array<vector, 4> force{right, bare, before.tick(x, ph::seconds{T}).force,
                                      touch.tick(x, ph::seconds{T}).force};
    for (std::size_t i = 0; i < felt.size(); ++i) {
      if (tick >= begin) {
        felt[i].all->step = std::max(felt[i].all->step, (force[i] - felt[i].last).norm());
        felt[i].squares += (force[i] - right).squaredNorm() / (end - begin);
      }
      felt[i].last = force[i];
    }
  }
  for (const auto& f : felt) f.all->rms += std::sqrt(f.squares) / row.cases;
}

std::vector<std::string> run_heaving(const session& s) {
  s.out.section(
      "Touch: a surface that heaves",
      "A device that holds still in a plane of any direction, 0.5 to 4 kN/m, that heaves at 0.5 to "
      "1.5 Hz by as much as changes its force by 5 to 14 N/s, drawn with --seed " +
          std::to_string(s.chosen.seed) +
          ", and is told now and then. The largest step of the force in a tick, and the "
          "rms error in the mean; bare: what was told last; before: a damped spring that is not "
          "eased. The bar is 0.02 N, and 0.022 "
          "N where a surface is not heard of for longer.");
  const int cases = s.chosen.quick ? 10 : 300;
  const std::vector<heave_row> jobs{
      {"every 33 ms", [](draws&) { return 33; }, 0.6, 0.02, cases},
      {"every 20-50 ms", [](draws& d) { return d.count(20, 50); }, 0.6, 0.02, cases},
      {"every 33 ms, two of three dropped",
       [](draws& d) {
         int all = 33;
         while (!d.chance(1.0 / 3.0)) all += 33;
         return all;
       },
       1.4, 0.022, cases},
      {"every 100-300 ms", [](draws& d) { return d.count(100, 300); }, 1.4, 0.022, cases},
      {"every 100 ms", [](draws&) { return 100; }, 0.6, 0.02, cases}};
  const auto rows = s.rows("touch_news.csv", "touch news", jobs, [&](heave_row row) {
    draws d(static_cast<std::uint64_t>(s.chosen.seed) << 32U);
    for (int i = 0; i < row.cases; ++i) heave(row, d);
    return row;
  });
  ex::show_rows(s.out, "touch_news", rows);
  std::vector<std::string> found;
  for (const auto& r : rows) {
    const std::string name = std::string("touch, told ") + r.told + ": ";
    expect(found, r.touch.step <= r.most_step,
           name + "a step of " + ex::format("%.4f", r.touch.step) + " N");
    expect(found, r.touch.rms <= r.most_of_bare * r.bare.rms,
           name + "an error of " + ex::format("%.2f", r.touch.rms / r.bare.rms) + " of bare news'");
    expect(found, r.before.step > 0.1, name + "the control does not step");
  }
  return found;
}

}  // namespace

std::vector<std::string> run_touch(const session& s) {
  s.out.section("Touch",
                "The largest step of the asked force when a device that enters at a fixed speed is "
                "found 1 nm deeper, straight and aslant, drawn with --seed " +
                    std::to_string(s.chosen.seed) +
                    "; beside it what a damper that begins at once would jump by.");
  std::vector<touch_row> jobs;
  for (const auto& scene : all_planes()) {
    for (const double K : {500.0, 10e3}) {
      for (const double v : {0.045, 0.3}) {
        jobs.push_back({.scene = &scene, .stiffness = K, .speed = v});
        jobs.back().seed = (static_cast<std::uint64_t>(s.chosen.seed) << 32U) + jobs.size();
      }
    }
  }
  const auto rows = s.rows("touch.csv", "touch", jobs, judge);
  ex::show_rows(s.out, "touch", rows);
  auto found = run_heaving(s);
  for (const auto& r : rows) {
    expect(found, r.step <= 0.02 * r.damper, std::string(r.scene->name) + ": the touch is a step");
  }
  return found;
}

}  // namespace contacts
