// SPDX-License-Identifier: BSD-3-Clause
// Motion is never limited, only news is: a finger that strokes balls and ridges fast, and one under a plane that turns by
// itself; beside it what limits both, in the same run.
#include "stroke.hpp"

#include "quiet.hpp"
#include <passive_haptics/environment/contact_surface.hpp>

#include <functional>

namespace contacts {

namespace {

using stroking::felt;

/// The same scene with the law as it is, with the bare spring of what was told last, and with what limits motion, too.
struct compared {
  felt law{}, bare{}, before{};
  felt bars{};
};
/// "", or what is missed first.
std::string missed(const felt& f, const felt& bars) {
  if (!(f.off <= bars.off)) return "off";
  if (!(f.largest_step <= bars.largest_step)) return "step";
  if (!(f.leaning <= bars.leaning)) return "leaning";
  if (!(std::abs(f.work) <= bars.work)) return "work";
  return f.rms <= bars.rms ? "" : "rms";
}
felt worst_of(const felt& a, const felt& b) {
  return {std::max(a.off, b.off), std::max(a.largest_step, b.largest_step),
          std::max(a.leaning, b.leaning), std::abs(a.work) > std::abs(b.work) ? a.work : b.work,
          std::max(a.rms, b.rms)};
}

struct motion_row {
  std::string scene;
  int every = 33;  ///< ticks from news to news
  int cases = 1;
  compared worst{};
  int missed = 0, control_missed = 0;
  std::string what{};  ///< is missed
};
ex::record record_of(const motion_row& r) {
  const auto& w = r.worst;
  return {{"scene", r.scene},
          {"told_per_s", 1.0 / (T * r.every), "%.0f"},
          {"cases", r.cases},
          {"off_deg", w.law.off / degree, "%.1f"},
          {"bare", w.bare.off / degree, "%.1f"},
          {"before", w.before.off / degree, "%.1f"},
          {"leaning_s", w.law.leaning, "%.3f"},
          {"leaning_before", w.before.leaning, "%.3f"},
          {"work_mJ", w.law.work * 1e3, "%.2f"},
          {"work_bare", w.bare.work * 1e3, "%.2f"},
          {"work_before", w.before.work * 1e3, "%.2f"},
          {"largest_step_N", w.law.largest_step, "%.4f"},
          {"step_before", w.before.largest_step, "%.4f"},
          {"rms_error_N", w.law.rms, "%.4f"},
          {"rms_bare", w.bare.rms, "%.4f"},
          {"rms_before", w.before.rms, "%.4f"}};
}

struct job {
  motion_row row;
  std::function<compared(draws&, int every)> run;
};
/// `bars`(what the bare spring does) of a scene.
compared compare(const auto& scene, int ticks, int every, const auto& bars) {
  compared all{.law = stroking::stroke({}, scene, ticks, every),
               .bare = stroking::bare(scene, ticks, every),
               .before = stroking::stroke(stroking::limited, scene, ticks, every)};
  all.bars = bars(all.bare);
  return all;
}

/// A ball of 320 triangles, told by the 16 of them that are nearest.
struct round_a_mesh : stroking::round_a_ball {
  std::vector<vector> nodes;
  std::vector<ph::environment::surface_triangle> surface;

  explicit round_a_mesh(const round_a_ball& ball) : round_a_ball(ball) {
    const auto mesh = curved::icosphere(2, ball.radius);
    nodes = mesh.nodes;
    for (const auto& t : mesh.triangles) surface.push_back({t});
  }
  [[nodiscard]] ph::patch<d3, 16> told(int n) const {
    return ph::environment::patch_at<16>(
        surface, nodes, *ph::environment::closest_point(surface, nodes, at(n)), stiffness);
  }
};

constexpr double two_turns = 720.0 * degree;
/// A plane is made up for until the next one comes, so it lags by twice as much as a bare one in the mean; what turns as
/// the ball does is no step of the news.
compared round(const stroking::round_a_ball& ball, int every) {
  const int ticks = static_cast<int>(two_turns * ball.radius / (ball.speed * T));
  return compare(ball, ticks, every, [&](const felt& bare) {
    const double force = ball.stiffness * ball.depth, turn = ball.turned_in(0);
    return felt{.off = bare.off + turn + 0.5 * degree,
                .largest_step = ph::pursuit{}.force_rate * T + force * turn,
                .leaning = HUGE_VAL,
                .work = 2.3 * std::abs(bare.work) + 0.5e-3,
                .rms = 2.0 * bare.rms + 0.01 * force};
  });
}
/// Some 80 edges of up to 18 degrees, each of them as if it were rounded.
compared round(const round_a_mesh& ball, int every) {
  const int ticks = static_cast<int>(two_turns * ball.radius / (ball.speed * T));
  constexpr ph::pursuit pace;
  return compare(ball, ticks, every, [&](const felt& bare) {
    const double force = ball.stiffness * ball.depth, edge = 18.0 * degree;
    return felt{
        .off = bare.off + edge,
        .largest_step = 1.05 * force * (ball.speed * T / pace.edge + edge * T / pace.catch_up),
        .leaning = HUGE_VAL,
        .work = std::abs(bare.work) + 80.0 * force * pace.edge * (1.0 - std::cos(edge)),
        .rms = bare.rms + 0.01 * force};
  });
}
compared over(stroking::over_a_ridge ridge, int every) {
  static_cast<void>(ridge.prepare());
  return compare(ridge, 5 * ridge.loop(), every, [&](const felt& /*bare*/) {
    const ph::pursuit pace{};
    const double P = std::clamp(every * T, pace.catch_up / 8.0, pace.catch_up);
    return ridge.as_rounded(pace.edge, P, 5, ridge.speed * T > 0.05 * pace.edge ? 1.2 : 1.05);
  });
}
/// What comes more often than every 5 ms is made up for within 5 ms.
compared turning(const stroking::turning_plane& p, int every) {
  return compare(p, 3000, every, [&](const felt& bare) {
    const double in_5_ms = p.fastest() * 5e-3;
    return felt{.off = p.fastest() * T * (std::max(every, 5) + 1),
                .largest_step = ph::pursuit{}.force_rate * T,
                .leaning = HUGE_VAL,
                .work = 0.0,
                .rms = 2.0 * bare.rms + std::sqrt(0.5) * in_5_ms * p.stiffness * p.depth};
  });
}

/// Three directions of length one that are orthogonal.
std::array<vector, 3> axes(draws& d) {
  const vector z = d.direction(), x = d3::orthogonal(z);
  const double angle = d.between(0.0, 360.0) * degree;
  const vector y = x * std::cos(angle) + d3::cross(z, x) * std::sin(angle);
  return {y, d3::cross(z, y), z};
}
/// Of at least that radius [m].
stroking::round_a_ball any_ball(draws& d, double least) {
  const auto to = axes(d);
  stroking::round_a_ball ball{.ahead = to[0], .beside = to[1]};
  ball.radius = d.scale(least, 0.08);
  ball.speed = d.between(0.05, 0.2);
  return ball;
}

std::vector<job> all_jobs(int cases) {
  std::vector<job> jobs;
  const auto add = [&](const std::string& name, int every, int count, const auto& run) {
    jobs.push_back({{.scene = name, .every = every, .cases = count}, run});
  };
  for (const double mm : {50.0, 20.0, 12.0}) {
    const std::string name = "ball of " + ex::format("%.0f", mm) + " mm, ";
    const stroking::round_a_ball ball{.radius = mm * 1e-3};
    for (const int every : {33, 1}) {
      add(name + "tangent planes", every, 1,
          [ball](draws&, int ticks) { return round(ball, ticks); });
    }
    add(name + "patches of a mesh", mm < 20.0 ? 10 : 33, 1,
        [ball](draws&, int ticks) { return round(round_a_mesh(ball), ticks); });
  }
  for (const int every : {33, 1}) {
    add("any ball of 12-80 mm, tangent planes", every, cases,
        [](draws& d, int ticks) { return round(any_ball(d, 0.012), ticks); });
  }
  add("any ball of 20-80 mm, patches of a mesh", 33, cases,
      [](draws& d, int ticks) { return round(round_a_mesh(any_ball(d, 0.02)), ticks); });
  add("ridge of 60 deg, 45 mm/s", 33, 1, [](draws&, int ticks) { return over({}, ticks); });
  add("any ridge of 20-60 deg", 33, cases, [](draws& d, int ticks) {
    const auto to = axes(d);
    stroking::over_a_ridge ridge{.across = to[0], .along = to[1], .up = to[2]};
    ridge.slope = d.between(10.0, 30.0) * degree;
    ridge.speed = d.between(0.02, 0.15);
    return over(ridge, ticks);
  });
  for (const int every : {100, 10, 1}) {
    add("a plane turns by 0.5 rad at 0.8 Hz", every, 1,
        [](draws&, int ticks) { return turning({}, ticks); });
    add("any plane that turns by 0.3-0.6 rad", every, cases, [](draws& d, int ticks) {
      const auto to = axes(d);
      stroking::turning_plane p{.up = to[2], .aside = to[0]};
      p.amplitude = d.between(0.3, 0.6);
      p.frequency = d.between(2.3, 3.8) / (360.0 * degree * p.amplitude);  // above 2 rad/s
      p.depth = d.between(1e-3, 4e-3);
      return turning(p, ticks);
    });
  }
  return jobs;
}

}  // namespace

std::vector<std::string> run_stroke(const session& s) {
  s.out.section(
      "Motion is not limited",
      "Twice round balls of 500 N/m, 2 mm deep, at 200 mm/s or, of any ball, at 50 to 200 mm/s; "
      "five times over a ridge and "
      "back; and a finger that holds still under a plane that turns by itself; any one is drawn "
      "with "
      "--seed " +
          std::to_string(s.chosen.seed) +
          ". Off: the direction of the force against that of the surface itself, at most; bare: "
          "the spring of what was told last; leaning: off by more than 5 degrees; work: that the "
          "finger got; before: news and motion limited to 2 rad/s alike. The worst of the cases.");
  const auto jobs = all_jobs(s.chosen.quick ? 3 : 60);
  const auto rows = s.rows("motion.csv", "motion", jobs, [&](const job& j) {
    motion_row row = j.row;
    draws d((static_cast<std::uint64_t>(s.chosen.seed) << 32U) +
            static_cast<std::uint64_t>(&j - jobs.data()));
    for (int i = 0; i < row.cases; ++i) {
      const compared one = j.run(d, row.every);
      row.worst.law = worst_of(row.worst.law, one.law);
      row.worst.bare = worst_of(row.worst.bare, one.bare);
      row.worst.before = worst_of(row.worst.before, one.before);
      const std::string what = missed(one.law, one.bars);
      if (!what.empty()) row.what = what;
      row.missed += what.empty() ? 0 : 1;
      row.control_missed += missed(one.before, one.bars).empty() ? 0 : 1;
    }
    return row;
  });
  ex::show_rows(s.out, "motion", rows);
  std::vector<std::string> found;
  for (const auto& r : rows) {
    const std::string name = r.scene + ", told every " + std::to_string(r.every) + " ms: ";
    expect(found, r.missed == 0,
           name + std::to_string(r.missed) + " of " + std::to_string(r.cases) +
               " miss the bar of " + r.what);
    expect(found, r.control_missed > 0, name + "the control, limited motion, misses nothing");
  }
  return found;
}

}  // namespace contacts
