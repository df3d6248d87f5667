// SPDX-License-Identifier: BSD-3-Clause
// A finger on the worst meshes that we know of, beside the closest point and a spring, without a port, on the same news:
// does one of them let the finger through, lose it, feed it energy or let it shake?
#include "../common/meshes.hpp"

#include "../common/draws.hpp"
#include "../common/quiet.hpp"
#include "program.hpp"
#include <passive_haptics/environment/surface_search.hpp>
#include <passive_haptics/mesh.hpp>

namespace contacts {

namespace {

namespace env = ph::environment;
using ex::draws;
using ph::mesh::triple;

/// A mesh of which the exact shape is known: by push(x, t) [m] it holds off the middle of a ball, which is at x, less its
/// radius, and a finger goes over it.
struct known_shape {
  meshes::moving mesh;
  bool round = false;  ///< a sphere about the origin, felt smooth, or z = height
  std::function<double(double)> where = {};  ///< its radius, or its height, at a time [m]

  [[nodiscard]] vector push(const vector& x, double t, double radius) const {
    const vector n = round ? vector(x.normalized()) : vector(0.0, 0.0, 1.0);
    return n * std::max(0.0, where(t) + radius - n.dot(x));
  }
};
std::vector<known_shape> known_shapes() {
  const auto swing = [](double by, double frequency) {
    return [=](double t) { return by * std::sin(2.0 * meshes::pi * frequency * t); };
  };
  const auto sphere = [](double t) { return 0.04 + 0.0 * t; };
  const auto breathing = [swing](double t) { return 0.04 * (1.0 + swing(0.05, 1.1)(t)); };
  return {{{"plane at rest", meshes::plate(), meshes::still}, false, swing(0.0, 1.0)},
          {{"plane that heaves by 2 mm", meshes::plate(), meshes::shaken({0, 0, 0.002}, 1.1)},
           false,
           swing(0.002, 1.1)},
          {{"smooth sphere at rest", meshes::sphere(3, 0.04), meshes::still}, true, sphere},
          {{"smooth sphere that breathes by 2 mm", meshes::sphere(3, 0.04),
            meshes::breathing(0.05, 1.1)},
           true,
           breathing}};
}

/// What is drawn: the same for the mesh and for what stands beside it.
struct finger {
  double radius, friction, stiffness, mass;  // [m], [N/m], [kg]
  bool stiff;                                // the hand
  std::uint64_t seed;                        // of its ways
};
finger drawn(draws& d, std::uint64_t seed, bool rubs) {
  finger f{};
  f.radius = d.scale(1e-4, 2e-3);
  f.friction = rubs && d.chance(0.5) ? d.between(0.1, 1.0) : 0.0;
  f.stiffness = d.scale(300.0, 5e3);
  f.mass = d.scale(0.1, 0.4);
  f.stiff = d.chance(0.5);
  f.seed = seed;
  return f;
}

/// Where a hand wants to be: to and fro between places far from the mesh and places near its middle; or, on a known
/// shape, over it, up to 4 mm deep.
class way {
 public:
  way(const finger& f, double speed, const known_shape* over)
      : d_(f.seed), speed_(speed), over_(over), along_(d_.direction()) {
    if (over != nullptr && !over->round) along_(2) = 0.0;
    along_.normalize();
    up_ = over != nullptr && over->round ? d3::orthogonal(along_) : vector(0.0, 0.0, 1.0);
    at_ = goal_ =
        over == nullptr ? vector(far * along_) : vector(up_ * (over->round ? 0.05 : 0.01));
  }
  [[nodiscard]] const vector& at() const { return at_; }
  vector next(double t, double dt) {
    if (over_ != nullptr) {
      const double s = 0.02 * std::sin(speed_ / 0.02 * t), deep = std::max(0.01 - 0.04 * t, -0.01);
      if (!over_->round) return at_ = along_ * s + up_ * deep;
      const double turn = s / 0.04;
      return at_ = (along_ * std::sin(turn) + up_ * std::cos(turn)) * (0.04 + deep);
    }
    if ((goal_ - at_).norm() < speed_ * dt) {
      near_ = !near_;
      goal_ = d_.direction() * (near_ ? d_.between(0.0, 0.01) : far);
    }
    return at_ += (goal_ - at_).normalized() * (speed_ * dt);
  }

 private:
  static constexpr double far = 0.11;  // [m]
  draws d_;
  double speed_;
  const known_shape* over_;
  vector along_, up_, at_, goal_;
  bool near_ = false;
};

/// The closest point of the last news and a spring to its plane: no memory, no port, no bound.
class bare {
 public:
  bare(const meshes::moving& m, const finger& f) : f_(f), search_(faces(m), places(m.nodes(0.0))) {}
  void told(const std::vector<triple>& nodes) {
    nodes_ = places(nodes);
    search_.refit(nodes_);
    fresh_ = true;
  }
  [[nodiscard]] vector closest(const vector& x) const {
    const auto on = search_.closest_point(nodes_, x);
    return on ? vector(on->point) : x;
  }
  vector tick(const vector& x) {
    if (std::exchange(fresh_, false)) on_ = search_.closest_point(nodes_, x);
    if (!on_) return vector::Zero();
    return on_->normal *
           (f_.stiffness * std::max(0.0, f_.radius + on_->normal.dot(on_->point - x)));
  }

 private:
  static std::vector<env::surface_triangle> faces(const meshes::moving& m) {
    std::vector<env::surface_triangle> all;
    for (const auto& t : m.rest.triangles) all.push_back({t});
    return all;
  }
  static std::vector<Eigen::Vector3d> places(const std::vector<triple>& nodes) {
    std::vector<Eigen::Vector3d> all;
    for (const triple& p : nodes) all.push_back(meshes::of(p));
    return all;
  }
  finger f_;
  env::surface_search search_;
  std::vector<Eigen::Vector3d> nodes_;
  std::optional<env::surface_point> on_;
  bool fresh_ = false;
};

struct mesh_row {
  std::string mesh{}, by{};
  double speed = 0.0;  ///< [m/s]
  double rate = 0.0;   ///< of the news [Hz]
  int cases = 0;
  int felt = 0;                       ///< ticks in which the ball was held off
  int through = 0;                    ///< times
  int lost = 0, eased = 0;            ///< ticks
  double least_energy = 0.0;          ///< [J]
  double step = 0.0;                  ///< the largest of the force, before the last news [N]
  double off = std::nan("");          ///< rms of the force against the exact shape [N]
  double off_by = std::nan("");       ///< the same over K [m]
  double least_share = std::nan("");  ///< of the stiffness asked for, shown at rest, not eased
  ex::at_rest still{};

  void add(const mesh_row& other) {
    cases += other.cases;
    felt += other.felt;
    through += other.through;
    lost += other.lost;
    eased += other.eased;
    least_energy = std::min(least_energy, other.least_energy);
    step = std::max(step, other.step);
    off = std::fmax(off, other.off);
    off_by = std::fmax(off_by, other.off_by);
    least_share = std::fmin(least_share, other.least_share);
    still.add(other.still);
  }
};
ex::record record_of(const mesh_row& r) {
  return ex::with({{"mesh", r.mesh},
                   {"by", r.by},
                   {"speed_m_per_s", r.speed > 0.0 ? r.speed : std::nan(""), "%g"},
                   {"rate_Hz", r.rate > 0.0 ? r.rate : std::nan(""), "%.0f"},
                   {"cases", r.cases},
                   {"ticks_felt", r.felt},
                   {"through", r.through},
                   {"ticks_lost", r.lost},
                   {"ticks_eased", r.eased},
                   {"least_energy_J", r.least_energy, "%.2g"},
                   {"largest_step_N", r.step, "%.3f"},
                   {"rms_error_N", r.off, "%.3f"},
                   {"rms_error_mm", 1e3 * r.off_by, "%.3f"},
                   {"least_shown_of_asked", r.least_share, "%.3f"}},
                  r.still);
}

struct job {
  const meshes::moving* mesh = nullptr;
  const known_shape* shape = nullptr;  ///< of a mesh whose exact shape is known
  double speed = 0.0;                  ///< [m/s]
  int every = 1;                       ///< ticks between news
  int number = 0;
};

/// A hand of at most 10 N goes to and fro for 2.5 s, then presses by up to 20 mm and holds still, and no news come any
/// more. force(sample) is a tick of what is judged, tell(nodes) gives it news, closest(x) is the point of those, eased() is
/// true where a force of zero is explained, and `ball` is its memory, or the referee's. An open mesh is looked at in
/// ticks so short that the ball's way round a rim is straight enough for a witness.
template <bool Remembers>
mesh_row run_of(mesh_row row, const job& j, const finger& f, double dt, const auto& force,
                const auto& tell, const auto& closest, const auto& eased,
                const ph::mesh::proxy& ball) {
  using hand = sim::impedance_hand<d3>;
  const meshes::moving& m = *j.mesh;
  way goes(f, j.speed, j.shape);
  hand h;
  h.stiffness = f.stiff ? 400.0 : 100.0;
  h.damping = f.stiff ? 6.0 : 1.0;
  h.limit = 10.0;
  h.target = goes.at();
  sim::device<d3, hand> device({.mass = f.mass, .damping = 0.1, .period = dt, .start = goes.at()},
                               h);
  sim::quiet_judge<d3> judge;
  meshes::witness looks;
  const int moves = static_cast<int>(2.5 / dt), per_tick = static_cast<int>(std::lround(T / dt));
  const int all = moves + static_cast<int>(ex::quiet_watched / dt);
  constexpr double settled = 1.0;  // of a finger that goes over a known shape [s]
  double round = std::nan(""), sum = 0.0;
  int counted = 0, pressed = 0;
  bool against = false;
  vector last = vector::Zero(), before = vector::Zero();
  double shown = std::nan("");
  const auto seen = sim::run(
      device, [&](const auto& sample) { return force(sample); }, all,
      [&](auto& now) {
        if (now.tick <= moves && now.tick % (j.every * per_tick) == 0) tell(m.nodes(now.time));
      },
      [&](auto& now) {
        if (now.tick < moves) {
          device.hand().target = goes.next(now.time, dt);
          return;
        }
        if (now.tick > moves || !ball.placed()) return;
        // It presses on through what it is on, or through what is closest to it.
        const vector from = meshes::of(ball.place());
        const vector on = ball.pressed().count > 0 ? vector(now.position) : closest(from);
        const vector in = on - from;
        draws d(f.seed + 1);
        if (in.norm() > 0.0) {
          device.hand().target = vector(on + in.normalized() * d.between(5e-3, 2e-2));
        }
        judge.news();
      },
      [&](auto& now) {
        const vector push = ball.placed() ? meshes::of(ball.push()) : vector(vector::Zero());
        const bool held = push.norm() > 5e-4;
        const bool none = held && !(now.force.norm() > 0.0);
        const bool turned =
            !Remembers && push.dot(now.force) < -0.5 * push.norm() * now.force.norm();
        row.felt += push.norm() > 0.0 ? 1 : 0;
        row.through += held && turned && !against ? 1 : 0;
        against = held && turned;
        bool leaves = false;
        for (int i = 0; held && i < ball.pressed().count; ++i) {
          const vector n = meshes::of(ball.normal(ball.pressed().of[std::size_t(i)]));
          leaves = leaves || std::max(n.dot(before), n.dot(device.velocity())) > 0.0;
        }
        before = device.velocity();
        if (none && !leaves) {
          ++(eased() ? row.eased : row.lost);
        }
        if (Remembers && now.time < 3.0 && ball.placed()) {
          const auto triangles = meshes::shown(m.rest.triangles.size(), ball);
          if (!m.closed) {
            row.through += looks.look(triangles, ball.place());
          } else {
            const double now_round = meshes::winding(triangles, ball.place());
            row.through += std::abs(now_round - round) > 0.5 ? 1 : 0;
            round = now_round;
          }
        }
        if (now.tick >= moves) {
          if (push.norm() > 0.0) {
            pressed = now.tick;
            shown = now.force.norm() / push.norm();
          }
          meshes::show(judge, ball, now, dt);
          return now.position.norm() < 1.0;
        }
        if (j.shape == nullptr || now.time > settled) {
          row.step = std::max(row.step, (now.force - last).norm());
        }
        last = now.force;
        if (j.shape != nullptr && now.time > settled) {
          sum += (f.stiffness * j.shape->push(now.position, now.time, f.radius) - now.force)
                     .squaredNorm();
          ++counted;
        }
        return now.position.norm() < 1.0;
      });
  row.cases = 1;
  row.least_energy = seen.least_energy;
  if (j.shape != nullptr) {
    row.off = std::sqrt(sum / counted);
    row.off_by = row.off / f.stiffness;
  }
  if (pressed >= all - static_cast<int>(1.0 / dt)) {
    row.still.add(judge, {f.stiffness, shown});
    if (!eased()) row.least_share = shown / f.stiffness;
  }
  return row;
}

std::vector<mesh_row> judged(const job& j, int seed) {
  const std::uint64_t first =
      (static_cast<std::uint64_t>(seed) << 32U) + static_cast<std::uint64_t>(j.number) * 16U;
  draws d(first);
  const finger f = drawn(d, first + 1, j.shape == nullptr);
  const meshes::moving& m = *j.mesh;
  const double dt = m.closed ? T : T / 10.0;
  const bool smooth = j.shape != nullptr && j.shape->round;
  mesh_row row{.mesh = m.name, .speed = j.speed, .rate = 1.0 / (j.every * T)};
  std::vector<mesh_row> both;

  const std::optional<ph::mesh::smooth> rounded =
      smooth ? std::optional(ph::mesh::smooth{}) : std::nullopt;
  const ph::mesh::proxy_parameters of_ball{.radius = f.radius, .friction = f.friction};
  bare control(m, f);
  {
    ph::mesh::surface s(m.rest.triangles, m.nodes(0.0), {}, rounded);
    auto port = ph::make_mesh_touch<d3>(
        {.mass = f.mass, .damping = 0.1, .force_limit = 30.0, .longest_tick = T}, {.force = 10.0},
        {.stiffness = f.stiffness, .proxy = of_ball});
    port.source().touch(s);
    row.by = "mesh";
    both.push_back(run_of<true>(
        row, j, f, dt, [&](const auto& sample) { return port.tick(sample); },
        [&](const auto& nodes) {
          static_cast<void>(s.update(nodes));
          control.told(nodes);
        },
        [&](const vector& x) { return control.closest(x); },
        [&] {
          const auto by = port.explain().now;
          return by == ph::softened_by::news || by == ph::softened_by::ledger;
        },
        port.source().ball()));
    port.source().let_go();
  }
  {
    ph::mesh::surface s(m.rest.triangles, m.nodes(0.0), {}, rounded);
    ph::mesh::proxy referee({.radius = f.radius});
    referee.touch(s);
    row.by = "bare";
    both.push_back(run_of<false>(
        row, j, f, dt,
        [&](const auto& sample) {
          const vector x = sample.position;
          referee.step(meshes::of(x), dt);
          return control.tick(x);
        },
        [&](const auto& nodes) {
          static_cast<void>(s.update(nodes));
          control.told(nodes);
        },
        [&](const vector& x) { return control.closest(x); }, [] { return false; }, referee));
    referee.let_go();
  }
  return both;
}

/// The rows merged by what `name_of` makes of each, in the order in which they come; a speed or rate of 0 is any.
std::vector<mesh_row> merged(const std::vector<mesh_row>& all, const auto& name_of) {
  std::vector<mesh_row> sums;
  for (const mesh_row& r : all) {
    const mesh_row name = name_of(r);
    const auto same = std::find_if(sums.begin(), sums.end(), [&](const mesh_row& s) {
      return s.mesh == name.mesh && s.by == name.by && s.speed == name.speed && s.rate == name.rate;
    });
    (same == sums.end() ? sums.emplace_back(name) : *same).add(r);
  }
  return sums;
}

}  // namespace

std::vector<std::string> run_meshes(const session& s) {
  const auto worst = meshes::all_worst();
  const auto known = known_shapes();
  std::vector<job> jobs;
  const auto try_mesh = [&](const meshes::moving& m, const known_shape* shape) {
    for (const double speed : {0.1, 1.0}) {
      for (const int every : {100, 33, 10, 1}) {
        const int number = static_cast<int>(jobs.size());
        jobs.push_back(
            {.mesh = &m, .shape = shape, .speed = speed, .every = every, .number = number});
      }
    }
  };
  for (const auto& m : worst) try_mesh(m, nullptr);
  for (const auto& k : known) try_mesh(k.mesh, &k);
  if (s.chosen.quick) {  // of each mesh a slow way and a fast one
    std::erase_if(jobs, [](const job& j) { return (j.number + j.number / 8) % 4 != 0; });
  }
  const auto rows =
      s.rows("meshes.csv", "meshes", jobs, [&](const job& j) { return judged(j, s.chosen.seed); });

  s.out.section(
      "Meshes",
      "The worst meshes that we know of (bench/common/meshes.hpp), drawn with --seed " +
          std::to_string(s.chosen.seed) +
          ": a ball of 0.1 to 2 mm, one in two with a friction of 0.1 to 1, 0.3 to 5 kN/m, 0.1 to "
          "0.4 kg, in a hand of 100 or 400 N/m and at most 10 N. It wants to go through the mesh "
          "by 0.1 or 1 m/s, news of which come 10, 30, 100 or 1000 times a second; or goes over a "
          "known shape, 10 mm deep, without friction. After 2.5 s it presses by up to 20 mm and "
          "holds still, and no news come. mesh: make_mesh_touch; bare: the closest point of the "
          "same news and a spring to its plane, without a port. Through: the winding number of "
          "the mesh round the ball changes, of an open mesh the side of a triangle; bare: it "
          "pushes against a ball that remembers. Lost: the ball is held off by more than 0.5 mm, "
          "the device leaves nothing that presses, and there is no force; eased: the same, and "
          "explain() says "
          "that news or the ledger soften, because the mesh has been moved onto the hand. Step: "
          "blows by up to 4 m/s are in it; of known shapes after 1 s. Error: rms against the "
          "known shape where it is by then, the largest, and over K; it has the damper in it." +
          std::string(ex::quiet_columns));
  s.out.show(ex::table_of(
      merged(rows, [](const mesh_row& r) { return mesh_row{.mesh = r.mesh, .by = r.by}; })));
  s.out.show(ex::table_of(merged(rows, [](const mesh_row& r) {
    return mesh_row{.mesh = "all", .by = r.by, .speed = r.speed, .rate = r.rate};
  })));
  s.out.member("meshes", ex::json_of(rows));

  std::vector<std::string> found;
  mesh_row ours, control;               // all runs
  std::array<double, 2> off{}, step{};  // of spheres at 0.1 m/s, news of 10 to 100 Hz
  for (const auto& r : rows) {
    const bool kept = r.by == "mesh";
    (kept ? ours : control).add(r);
    if (std::isfinite(r.off) && r.mesh.find("sphere") != std::string::npos && r.speed < 0.5 &&
        r.rate < 500.0) {
      off[kept ? 0 : 1] += r.off_by * r.off_by;
      step[kept ? 0 : 1] = std::max(step[kept ? 0 : 1], r.step);
    }
    if (!kept) continue;
    const std::string name =
        r.mesh + ", " + ex::format("%g m/s", r.speed) + ex::format(", news of %.0f Hz: ", r.rate);
    expect(found, r.through == 0, name + "the finger goes through");
    expect(found, r.lost == 0, name + std::to_string(r.lost) + " ticks of contact are lost");
    expect(found, r.least_energy >= -1e-12,
           name + ex::format("%.2g J are given out", -r.least_energy));
    expect(found, r.still.quiet() == r.still.runs(), name + "is not quiet, " + r.still.share());
  }
  for (const auto& r :
       merged(rows, [](const mesh_row& one) { return mesh_row{.mesh = one.mesh, .by = one.by}; })) {
    expect(found, r.by != "mesh" || r.felt > 0, r.mesh + ": is never touched");
  }
  expect(found, 1000 * ours.eased <= ours.felt,
         "meshes: more than a thousandth of the contact is eased");
  expect(found, 2 * ours.still.runs() > ours.cases, "meshes: most runs do not end on the mesh");
  expect(found, ours.least_share >= 0.95,
         ex::format("meshes: at rest %.3f of the stiffness asked for is shown", ours.least_share));
  if (!s.chosen
           .quick) {  // of the few spheres of a quick run one that is stiff, with its damper, decides
    expect(found, off[0] <= 0.25 * off[1],
           "smooth spheres: off by more than half of what a plane and a spring are off by");
    expect(found, step[0] <= 0.5 * step[1],
           "smooth spheres: step by more than half of what a plane and a spring step by");
  }
  expect(found, control.through > 0, "meshes: what has no memory lets no finger through");
  expect(found, control.lost > 0, "meshes: what has no memory loses no tick of contact");
  expect(found, control.least_energy < -1e-3,
         "meshes: a spring without a port gives out no energy");
  expect(found, control.still.quiet() < control.still.runs(),
         "meshes: a spring without a port is always quiet");
  return found;
}

}  // namespace contacts
