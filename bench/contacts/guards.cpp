// SPDX-License-Identifier: BSD-3-Clause
// Somebody else's renderer behind a guard: does the device rest when the hand holds still, how soft does the
// guard make it, what does it add where the hand slides? A given force under a reachable bound, the strict
// guard and make_guard, side by side, on renderers written for this page.
#include "../common/draws.hpp"
#include "../common/shares.hpp"
#include "program.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/energy_observer/quantised_energy.hpp>
#include <passive_haptics/motion_estimator/mass_observer.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

#include <deque>

namespace contacts {

namespace {

constexpr double pi = 180.0 * degree, mass = 0.1, true_damping = 0.1, radius = 0.05;
constexpr double calm_speed = 1e-3, calm_step = 0.02;  // [m/s], [N] a tick
constexpr double longest = 1.1 * T;
constexpr ph::exact_device told{
    .mass = mass, .damping = 0.05, .force_limit = 9.0, .longest_tick = longest};
constexpr ph::known_hand told_hand{.force = 8.0};

// ---------------------------------------------------------------------------------------- renderers

enum class kind : std::uint8_t {
  floor,
  sphere,
  facets,
  corner,
  rough,
  one_late,
  three_late,
  slow,
  detents
};
constexpr kind all_kinds[] = {kind::floor,      kind::sphere, kind::facets,
                              kind::corner,     kind::rough,  kind::one_late,
                              kind::three_late, kind::slow,   kind::detents};
const char* to_string(kind k) {
  switch (k) {
    case kind::floor:
      return "floor";
    case kind::sphere:
      return "implicit sphere";
    case kind::facets:
      return "24 x 12 facets";
    case kind::corner:
      return "corner, doubled faces";
    case kind::rough:
      return "rough floor";
    case kind::one_late:
      return "sphere, 1 ms late";
    case kind::three_late:
      return "sphere, 3 ms late";
    case kind::slow:
      return "sphere, 30 Hz";
    case kind::detents:
      return "detents of 10 mm and 1 N";
  }
  return "";
}
/// How old its force is, on average [ticks].
int lateness(kind k) {
  return k == kind::one_late ? 1 : k == kind::three_late ? 3 : k == kind::slow ? 17 : 0;
}

vector pushed_out(const vector& n, double depth, double K) {
  return depth > 0.0 ? vector(n * (K * depth)) : vector(vector::Zero());
}

/// One that knows the position and nothing else. The top of what it renders is at z = `radius`.
class renderer {
 public:
  renderer(kind k, double K) : kind_(k), K_(K) {}

  vector operator()(const vector& x) {
    const double depth = radius - x.z();
    switch (kind_) {
      case kind::floor:
        return pushed_out(vector::UnitZ(), depth, K_);
      case kind::facets:
        return facet(x);
      case kind::corner:
        return pushed_out(vector::UnitZ(), depth, 2.0 * K_) +
               pushed_out(vector(0.8, 0.0, 0.6),
                          0.6 * radius + 2.7e-3 - (0.8 * x.x() + 0.6 * x.z()), K_);
      case kind::rough:
        return rub(x, depth);
      case kind::detents:
        return pushed_out(vector::UnitZ(), depth, K_) -
               vector::UnitX() * std::sin(2.0 * pi * x.x() / 0.01);
      case kind::slow:
        if (tick_++ % 33 == 0) held_ = ball(x);
        return held_;
      default:
        past_.push_back(ball(x));
        if (past_.size() > static_cast<std::size_t>(lateness(kind_)) + 1) past_.pop_front();
        return past_.front();
    }
  }

 private:
  [[nodiscard]] vector ball(const vector& x) const {
    return pushed_out(x.normalized(), radius - x.norm(), K_);
  }
  [[nodiscard]] vector facet(const vector& x) const {
    static const std::vector<vector> normals = [] {
      std::vector<vector> all;
      for (int i = 0; i < 24; ++i) {
        for (int j = 0; j < 12; ++j) all.push_back(tilted(pi * (j + 0.5) / 12.0, pi * i / 12.0));
      }
      return all;
    }();
    const vector* nearest = &normals.front();
    for (const vector& n : normals) {
      if (n.dot(x) > nearest->dot(x)) nearest = &n;
    }
    return pushed_out(*nearest, radius * std::cos(pi / 24.0) - nearest->dot(x), K_);
  }
  /// A bristle of K/2 that slips at half the pressing force.
  vector rub(const vector& x, double depth) {
    if (!(depth > 0.0)) {
      stuck_ = x;
      return vector::Zero();
    }
    vector pulled = stuck_ - x;
    pulled.z() = 0.0;
    const double most = depth;  // [m], of a bristle as long as the cone is wide
    if (pulled.norm() > most) {
      pulled *= most / pulled.norm();
      stuck_ = x + pulled;
    }
    return {0.5 * K_ * pulled.x(), 0.5 * K_ * pulled.y(), K_ * depth};
  }

  kind kind_;
  double K_;
  int tick_ = 0;
  vector held_ = vector::Zero(), stuck_ = vector::Zero();
  std::deque<vector> past_;
};

// ------------------------------------------------------------------------------------------- guards

enum class guard : std::uint8_t { given, strict, settled, law, shaped };
constexpr guard all_guards[] = {guard::given, guard::strict, guard::settled};
const char* to_string(guard g) {
  switch (g) {
    case guard::given:
      return "given_force, reachable";
    case guard::strict:
      return "given_force, strict";
    case guard::settled:
      return "make_guard";
    case guard::law:
      return "spring";
    case guard::shaped:
      return "shaped by settled_force";
  }
  return "";
}

/// Calls `run` with the guard for a device as it is told.
template <class Run>
auto with(guard g, const ph::exact_device& d, const ph::known_hand& hand, const Run& run) {
  if (g == guard::strict)
    return run(ph::make_strict_guard<d3>({d.damping}, ph::actuator_limit{1e3}, longest));
  if (g == guard::settled) return run(ph::make_guard<d3>(d, hand));
  return run(ph::passive_port{
      d3{}, ph::given_force{}, ph::reduced_energy{.damping = d.damping},
      ph::bound_chain{ph::reachable_bound{.mass = d.mass, .hand_force = hand.force},
                      ph::actuator_limit{.most = d.force_limit}},
      ph::loop_limits{.longest_tick = longest}});
}

/// Says when a tenth of a second was last not calm: speeds above 1 mm/s rms or steps above 0.02 N.
class calm {
 public:
  void see(double time, double speed, double step) {
    squares_ += speed * speed;
    step_ = std::max(step_, step);
    if (++ticks_ < 100) return;
    if (std::sqrt(squares_ / ticks_) > calm_speed || step_ > calm_step) last_ = time;
    squares_ = step_ = 0.0;
    ticks_ = 0;
  }
  [[nodiscard]] double since(double start) const { return std::max(0.0, last_ - start); }

 private:
  int ticks_ = 0;
  double squares_ = 0.0, step_ = 0.0, last_ = 0.0;  ///< [(m/s)²], [N], [s]
};

// -------------------------------------------------------------------------------- pressed, and slid

constexpr double held_from = 1.5;  // [s]

/// Comes down onto the renderer, presses 2 N more within half a second and holds still, or slides to and fro.
struct pressing_hand {
  bool slides = false;

  [[nodiscard]] vector force(double t, const vector& x, const vector& v) const noexcept {
    const double down = std::clamp(t, 0.0, 1.0), more = std::clamp(2.0 * (t - 1.0), 0.0, 1.0);
    vector goal(0.004, 0.003, radius + 0.01 - 0.01 * down);
    if (slides && t > held_from) goal.x() += 0.02 * std::sin(1.6 * pi * (t - held_from));
    return 300.0 * (goal - x) - 0.5 * v - vector::UnitZ() * (2.0 * more);
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

struct guard_row {
  kind renders{};
  double stiffness = 0.0;  ///< [N/m]
  guard by{};
  bool in_reach = false;      ///< is that a stiffness that settled_force answers for?
  double settles = 0.0;       ///< from when the hand holds still [s]
  double depth = 0.0;         ///< at the end [m]
  double kept = 0.0;          ///< of the force asked for, how much is not there at the end [N]
  double drag = 0.0;          ///< mean of what is added along the way of a slide [N]
  double step = 0.0;          ///< the largest of a slide [N a tick]
  double in_air = 0.0;        ///< the largest force before the touch [N]
  double least_energy = 0.0;  ///< [J]
};
ex::record record_of(const guard_row& r) {
  return {{"renderer", std::string(to_string(r.renders))},
          {"K", r.stiffness, "%.0f"},
          {"guard", std::string(to_string(r.by))},
          {"in_reach", r.in_reach ? 1 : 0},
          {"settles_s", r.settles, "%.1f"},
          {"depth_mm", r.depth * 1e3, "%.2f"},
          {"withheld_N", r.kept, "%.3f"},
          {"slide_adds_N", r.drag, "%.3f"},
          {"slide_step_N", r.step, "%.3f"},
          {"in_air_N", r.in_air, "%.3f"},
          {"least_energy_J", r.least_energy}};
}

template <class Port>
void press(guard_row& row, Port port, bool slides, double seconds) {
  renderer wanted_at(row.renders, row.stiffness);
  sim::device<d3, pressing_hand> device({.mass = mass,
                                         .damping = true_damping,
                                         .period = T,
                                         .start = vector(0.004, 0.003, radius + 0.01)},
                                        {slides});
  calm rest;
  vector last = vector::Zero(), wanted = vector::Zero();
  double added = 0.0;
  int ticks = 0;
  auto sample = device.exchange(vector::Zero());
  for (int n = 1; n * T < seconds; ++n) {
    const double t = n * T;
    wanted = wanted_at(sample.position);
    const vector f = port.tick(sample, wanted).force;
    sample = device.exchange(f);
    if (wanted.norm() == 0.0) row.in_air = std::max(row.in_air, f.norm());
    rest.see(t, device.velocity().norm(), (f - last).norm());
    if (slides && t > held_from + 0.1) {
      row.step = std::max(row.step, (f - last).norm());
      added += std::abs(f.x() - wanted.x());
      ++ticks;
    }
    last = f;
  }
  if (slides) {
    row.drag = added / ticks;
  } else {
    row.settles = rest.since(held_from);
    row.depth = radius - (row.renders == kind::floor || row.renders == kind::corner ||
                                  row.renders == kind::rough || row.renders == kind::detents
                              ? device.position().z()
                              : device.position().norm());
    row.kept = (last - wanted).norm();
  }
  row.least_energy = std::min(row.least_energy, device.meter().minimum());
}

guard_row judge(guard_row row, double seconds) {
  const ph::settled_force rule{.mass = told.mass};
  row.in_reach = row.stiffness * (row.renders == kind::corner ? 3.0 : 1.0) <=
                 rule.most_stiffness(longest, lateness(row.renders));
  return with(row.by, told, told_hand, [&](const auto& port) {
    press(row, port, false, seconds);
    press(row, port, true, std::min(seconds, 6.0));
    return row;
  });
}

/// A surface of ours under a law, in place of a renderer.
template <class Model>
struct under_law {
  Model model;
  auto tick(const ph::device_sample<d3>& sample, const vector& /*wanted*/) noexcept {
    return model.tick(sample);
  }
};
/// A floor under a bare spring, or under one that settled_force shapes, under a reachable bound.
guard_row judge_law(guard_row row, double seconds) {
  row.in_reach = row.stiffness <= ph::settled_force{.mass = told.mass}.most_stiffness(longest);
  const auto pressed = [&](const auto& law) {
    ph::local_model model{
        d3{},
        ph::followed<ph::half_space<d3>>{},
        ph::turn_at_once{},
        law,
        ph::reduced_energy{.damping = told.damping},
        ph::bound_chain{ph::reachable_bound{.mass = told.mass, .hand_force = told_hand.force},
                        ph::actuator_limit{.most = told.force_limit}},
        ph::loop_limits{.longest_tick = longest}};
    model.update({vector(0.0, 0.0, radius), vector::UnitZ(), row.stiffness});
    press(row, under_law<decltype(model)>{model}, false, seconds);
    press(row, under_law<decltype(model)>{model}, true, std::min(seconds, 6.0));
  };
  if (row.by == guard::law) {
    pressed(ph::spring{});
  } else {
    pressed(ph::shaped{ph::spring{},
                       ph::settled_force{.mass = told.mass, .force_limit = told.force_limit}});
  }
  return row;
}

/// Do detents keep their force? The largest sideways force of a slow pass, over the largest asked for.
double detents_kept(guard g) {
  return with(g, told, told_hand, [](auto port) {
    renderer wanted_at(kind::detents, 1000.0);
    double asked = 0.0, felt = 0.0;
    for (int n = 0; n < 6000; ++n) {  // 20 mm at 5 mm/s, pressed by 2 N, after a second of pressing
      const vector x(n < 2000 ? 0.0 : 5e-6 * (n - 2000), 0.0,
                     radius - 2e-3 * std::min(1.0, n / 1e3));
      const vector w = wanted_at(x), f = port.tick(x, ph::seconds{T}, w).force;
      asked = std::max(asked, std::abs(w.x()));
      felt = std::max(felt, std::abs(f.x()));
    }
    return felt / asked;
  });
}

// ------------------------------------------------------------------------------- stroked, by any mass

enum class stroked : std::uint8_t { floor, ball, bowl, wind };
struct stroke_row {
  stroked what{};
  double mass = 0.0;     ///< [kg]
  double adds = 0.0;     ///< mean of what is added to the force that is given [N]
  double largest = 0.0;  ///< the most of it [N]
};
ex::record record_of(const stroke_row& r) {
  return {{"stroked", std::string(r.what == stroked::floor  ? "floor"
                                  : r.what == stroked::ball ? "sphere"
                                  : r.what == stroked::bowl ? "bowl"
                                                            : "1 N, constant")},
          {"mass_kg", r.mass, "%.1f"},
          {"adds_N", r.adds, "%.3f"},
          {"largest_N", r.largest, "%.3f"}};
}
/// Behind make_guard, 20 mm to and fro at up to 0.1 m/s, 1 mm deep in 2 kN/m; or along a force that is the same everywhere.
stroke_row stroke(stroke_row row) {
  auto port = ph::make_guard<d3>(
      {.mass = row.mass, .damping = 0.05, .force_limit = 9.0, .longest_tick = longest}, told_hand);
  double added = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double aside = 0.02 * std::sin(1.6 * pi * n * T);
    const double height = std::max(-1e-3, 5e-3 - 6e-3 * n * T);
    const double side = row.what == stroked::bowl ? -1.0 : 1.0;
    const vector up = vector(aside, 0.0, side * radius).normalized();
    vector x(aside, 0.0, height), w(0.0, 0.0, 1.0);
    if (row.what == stroked::wind) {
      x = {0.0, 0.0, aside};
    } else if (row.what == stroked::floor) {
      w = pushed_out(w, -height, 2000.0);
    } else {
      x = up * (radius + side * height);
      w = pushed_out(vector(side * up), -height, 2000.0);
    }
    const double more = (port.tick(x, ph::seconds{T}, w).force - w).norm();
    if (n < 2000) continue;
    added += more;
    row.largest = std::max(row.largest, more);
  }
  row.adds = added / 2000.0;
  return row;
}

// ---------------------------------------------------------------------- random sums, drops, encoders

/// Off, relaxed or stiff, at a goal.
struct resting_hand {
  int grip = 0;

  [[nodiscard]] vector force(double /*t*/, const vector& x, const vector& v) const noexcept {
    const double k = grip == 0 ? 0.0 : grip == 1 ? 100.0 : 400.0;
    const double b = grip == 0 ? 0.0 : grip == 1 ? 1.0 : 6.0;
    return -k * x - b * v;
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

struct wall {
  vector point, normal;
  double stiffness;
};
/// A device of any mass that falls into one to five walls, with a load off axis.
struct scene_of_walls {
  std::vector<wall> walls{};
  double mass = 0.1, known = 1.0,
         damping = 0.03;  ///< `known` is the share of mass and damping told
  int grip = 0, late = 0;
  int every = 1;  ///< ticks until the renderer computes its force anew
  vector load = vector::Zero(), start = vector::Zero();

  [[nodiscard]] vector force(const vector& x) const {
    vector f = vector::Zero();
    for (const wall& w : walls) {
      f += pushed_out(w.normal, (w.point - x).dot(w.normal), w.stiffness);
    }
    return f;
  }
  /// The fastest against any wall that presses.
  [[nodiscard]] double speed(const vector& x, const vector& v) const {
    double most = 0.0;
    for (const wall& w : walls) {
      if ((w.point - x).dot(w.normal) > 0.0) most = std::max(most, std::abs(v.dot(w.normal)));
    }
    return most;
  }
  static constexpr ph::known_hand hand{.force = 12.0};
  [[nodiscard]] ph::exact_device told() const {
    return {.mass = mass * known,
            .damping = damping * known,
            .force_limit = 20.0,
            .longest_tick = longest};
  }
};

scene_of_walls drawn(std::uint64_t seed) {
  ph::laws::samples random(seed);
  const auto between = [&](double a, double b) {
    return a + (b - a) * (0.5 + 0.5 * random.number<double>());
  };
  const auto evenly = [&](double a, double b) { return a * std::pow(b / a, between(0.0, 1.0)); };
  scene_of_walls s;
  const vector up = random.direction<d3>();
  s.mass = evenly(0.05, 1.0);
  s.known = between(0.5, 1.0);
  s.damping = between(0.002, 0.1);
  s.grip = static_cast<int>(between(0.0, 3.0));
  const int latest = static_cast<int>(between(0.0, 6.0));
  s.late = latest > 3 ? 0 : latest;
  const int count = 1 + static_cast<int>(between(0.0, 5.0));
  const double most =
      ph::settled_force{.mass = s.mass * s.known}.most_stiffness(longest, s.late) / count;
  for (int i = 0; i < count; ++i) {
    const vector lean = up + random.direction<d3>() * between(0.1, 1.2);
    s.walls.push_back({vector(random.direction<d3>() * 2e-3), lean.normalized(),
                       std::min(most, evenly(300.0, 6000.0))});
  }
  s.load = random.direction<d3>() * between(0.0, 0.5) - up * between(0.5, 3.0);
  s.start = up * 0.01;
  return s;
}

struct fall {
  bool gone = false;  ///< the walls do not hold it
  double settles = 0.0, least_energy = 0.0;
};
template <class Port>
fall let_fall(Port port, const scene_of_walls& s, double seconds) {
  sim::device<d3, resting_hand> device(
      {.mass = s.mass, .damping = s.damping, .load = s.load, .period = T, .start = s.start},
      {s.grip});
  calm rest;
  vector last = vector::Zero(), computed = last;
  std::deque<vector> rendered(static_cast<std::size_t>(s.late), vector(vector::Zero()));
  auto sample = device.exchange(vector::Zero());
  for (int n = 1; n * T < seconds; ++n) {
    const double t = n * T;
    if ((n - 1) % s.every == 0) computed = s.force(sample.position);
    rendered.push_back(computed);
    const vector f = port.tick(sample, rendered.front()).force;
    rendered.pop_front();
    sample = device.exchange(f);
    rest.see(t, s.speed(device.position(), device.velocity()), (f - last).norm());
    last = f;
    if (device.position().norm() > 0.3) return {true, 0.0, device.meter().minimum()};
  }
  return {false, rest.since(0.0), device.meter().minimum()};
}

struct sum_row {
  guard by{};
  int grip = 0;
  int cases = 0, unsettled = 0;
  double median = 0.0, slow = 0.0, slowest = 0.0;  ///< of those that settle; slow: 95 of 100 [s]
  double least_energy = 0.0;                       ///< [J]
  std::vector<double> times{};                     ///< until it rests; NaN: it does not [s]
};
ex::record record_of(const sum_row& r) {
  return {{"guard", std::string(to_string(r.by))},
          {"hand", std::string(r.grip == 0   ? "off"
                               : r.grip == 1 ? "relaxed"
                                             : "stiff")},
          {"cases", r.cases},
          {"unsettled", r.unsettled},
          {"median_s", r.median, "%.1f"},
          {"95_of_100_s", r.slow, "%.1f"},
          {"slowest_s", r.slowest, "%.1f"},
          {"least_energy_J", r.least_energy}};
}
sum_row fall_often(sum_row row, std::uint64_t seed, int cases) {
  constexpr double seconds = 8.0;
  std::vector<double>& times = row.times;
  for (int i = 0; i < cases; ++i) {
    const scene_of_walls s = drawn(seed * 1000003U + static_cast<std::uint64_t>(i));
    if (s.grip != row.grip) continue;
    const fall f = with(row.by, s.told(), s.hand,
                        [&](const auto& port) { return let_fall(port, s, seconds); });
    row.least_energy = std::min(row.least_energy, f.least_energy);
    if (f.gone) continue;
    ++row.cases;
    if (f.settles > seconds - 1.0) {
      ++row.unsettled;
    } else {
      times.push_back(f.settles);
    }
  }
  std::sort(times.begin(), times.end());
  if (!times.empty()) {
    row.median = times[times.size() / 2];
    row.slow = times[times.size() * 95 / 100];
    row.slowest = times.back();
  }
  times.resize(static_cast<std::size_t>(row.cases), std::nan(""));
  return row;
}

/// The share of the falls that rest, over the time.
void plot_sums(const session& s, const std::vector<sum_row>& rows) {
  std::vector<ex::figures> lists;
  for (const guard g : all_guards) {
    lists.push_back({to_string(g)});
    for (const sum_row& r : rows) {
      if (r.by == g) lists.back().of.insert(lists.back().of.end(), r.times.begin(), r.times.end());
    }
  }
  const auto commands = ex::shares(s.out, "guards_rest.csv", lists, 1.0, 0.0);
  s.out.plot(
      "guards_rest",
      {"The share of the falls that rest, over the time since the device was let go",
       {{"Behind make_guard all come to rest,", "guards_rest.csv",
         [](const ex::recorded& r) { return ex::at_most(r["make_guard"].back(), 7.0); }},
        {"more of them by the dotted line of 1 s than behind a reachable bound alone;",
         "guards_rest.csv",
         [](const ex::recorded& r) {
           const auto by_then = [&r](const char* list) {
             const auto n = std::ranges::count_if(r[list], [](double t) { return t <= 1.0; });
             return static_cast<double>(n) / 2.0;
           };
           const double ours = by_then("make_guard"), given = by_then("given_force reachable");
           return ex::finding(ours > given,
                              ex::format("%.3g %% and ", ours) + ex::format("%.3g %%", given));
         }},
        ex::definition("a curve that ends below 1 leaves falls that do not rest in 7 s.")}},
      "set xlabel 'time [s]'\nset xrange [0:7]\n" + commands);
}

/// Behind make_guard, a renderer that computes its force each `every` ticks: for walls as they are drawn, also told its
/// period P, or for soft ones, which add up to 0.1 m/(T P) [N/m], m the mass told.
struct slow_row {
  static constexpr double share = 0.1;
  int every = 1;
  bool soft = false, told = false;
  int cases = 0, unsettled = 0;
  double least_energy = 0.0;  ///< [J]
};
ex::record record_of(const slow_row& r) {
  return {
      {"renderer_Hz", 1.0 / (r.every * T)},
      {"walls", r.soft ? ex::format("%.0f N/m of 0.1 kg", slow_row::share * 0.1 / (r.every * T * T))
                       : std::string(r.told ? "as drawn, told P" : "as drawn")},
      {"cases", r.cases},
      {"unsettled", r.unsettled},
      {"least_energy_J", r.least_energy}};
}
slow_row fall_slowly(slow_row row, std::uint64_t seed, int cases) {
  constexpr double seconds = 12.0;
  for (int i = 0; i < cases; ++i) {
    scene_of_walls s = drawn(seed * 1000003U + static_cast<std::uint64_t>(i));
    const double most = slow_row::share * s.mass * s.known / (row.every * T * T);
    if (row.soft) {
      for (wall& w : s.walls) w.stiffness = most / static_cast<double>(s.walls.size());
    }
    s.late = 0;
    s.every = row.every;
    const double period = row.told ? row.every * T : 0.0;
    const fall f = let_fall(ph::make_guard<d3>(s.told(), s.hand, period), s, seconds);
    row.least_energy = std::min(row.least_energy, f.least_energy);
    if (f.gone) continue;
    ++row.cases;
    if (f.settles > seconds - 1.0) ++row.unsettled;
  }
  return row;
}

/// Behind make_guard, a wall that is read in each tick and heaves towards a finger which gives way, of 0.1 to 0.6 times
/// what settles, or of three times as a control.
struct heave_row {
  const char* hand = "";
  double least_Hz = 0.0,
         most_Hz = 0.0;  ///< at which the hand kneads by 0.5 to 4 mm; 0: it holds still
  bool steep = false;
  int cases = 0, softened = 0;
  double away = 0.0;      ///< mean of 1 - s over all cases and ticks
  double step = 0.0;      ///< largest of the force in a tick [N]
  double as_given = 0.0;  ///< the same of a guard that does not soften [N]
  double least_energy = 0.0;
};
ex::record record_of(const heave_row& r) {
  return {{"hand", std::string(r.hand)},
          {"walls", std::string(r.steep ? "3 times" : "0.1 to 0.6 times")},
          {"cases", r.cases},
          {"softened", r.softened},
          {"mean_away", r.away, "%.4f"},
          {"step_N", r.step, "%.2f"},
          {"as_given_N", r.as_given, "%.2f"},
          {"least_energy_J", r.least_energy}};
}
heave_row heave_often(heave_row row, std::uint64_t seed, int cases) {
  using d1 = ph::space<double, 1>;
  constexpr double seconds = 6.0, turn = 2.0 * pi;
  row.cases = cases;
  for (int i = 0; i < cases; ++i) {
    ex::draws d(seed * 1000003U + static_cast<std::uint64_t>(i));
    const double m = d.scale(0.05, 0.5), known = d.between(0.6, 1.0);
    const double most = ph::settled_force{.mass = m * known}.most_stiffness(longest);
    const double K = (row.steep ? 3.0 : d.between(0.1, 0.6)) * most;
    const double size = d.scale(2e-4, 4e-3), rate = turn * d.scale(0.3, 3.0);
    const double phase = d.between(0.0, turn), second = size * d.between(0.0, 0.4);
    const double faster = rate * d.between(1.5, 2.5), spring = d.scale(100.0, 800.0);
    const double damps = d.scale(1.0, 8.0), presses = d.between(0.5, 4.0);
    const bool still = !(row.most_Hz > 0.0);
    const double kneads = still ? 0.0 : d.scale(5e-4, 4e-3);
    const double beat = still ? 0.0 : turn * d.scale(row.least_Hz, row.most_Hz);
    for (const bool softens : {true, false}) {
      auto port = ph::make_guard<d1>(
          {.mass = m * known, .damping = damping, .force_limit = 20.0, .longest_tick = longest},
          ph::known_hand{.force = 15.0});
      ph::settled_force rule = port.source().parameters();
      rule.softens = softens;
      static_cast<void>(port.set(rule));
      double x = 1e-3, v = 0.0, last = 0.0, shown = 1.0, energy = 0.0, away = 0.0, step = 0.0;
      for (int n = 0; n * T < seconds; ++n) {
        const double t = n * T, from = x;
        const double wall = size * std::sin(rate * t + phase) + second * std::sin(faster * t);
        const double f = port.tick(x, ph::seconds{T}, K * std::max(0.0, wall - x)).force;
        if (t > 0.5) step = std::max(step, std::abs(f - last));
        last = f;
        shown = std::min(shown, double(port.source().shown()));
        away += 1.0 - double(port.source().shown());
        const double goal = kneads * std::sin(beat * t) - presses / spring;
        constexpr int parts = 20;
        for (int k = 0; k < parts; ++k) {
          v += T / parts * (f - damping * v - spring * (x - goal) - damps * v) / m;
          x += T / parts * v;
          energy += T / parts * damping * v * v;
        }
        energy -= f * (x - from);
        row.least_energy = std::min(row.least_energy, energy);
      }
      double& largest = softens ? row.step : row.as_given;
      largest = std::max(largest, step);
      if (softens) row.away += away * T / seconds / cases;
      row.softened += shown < 1.0;
    }
  }
  return row;
}

struct drop_row {
  guard by{};
  double stiffness = 0.0;
  int late = 0;
  double settles = 0.0, least_energy = 0.0;
};
ex::record record_of(const drop_row& r) {
  return {{"guard", std::string(to_string(r.by))},
          {"K", r.stiffness, "%.0f"},
          {"late", r.late},
          {"settles_s", r.settles, "%.2f"},
          {"least_energy_J", r.least_energy}};
}
/// 1 N, from 30 mm, onto a floor that leans by 20 degrees against a wall.
drop_row drop(drop_row row) {
  scene_of_walls s{.damping = 0.03,
                   .late = row.late,
                   .load = vector(0.0, 0.0, -1.0),
                   .start = vector(0.0, 0.0, 0.03)};
  s.walls = {{vector::Zero(), tilted(20.0 * degree, 0.0), row.stiffness},
             {vector::Zero(), tilted(20.0 * degree, pi), row.stiffness}};
  const fall f =
      with(row.by, s.told(), s.hand, [&](const auto& port) { return let_fall(port, s, 15.0); });
  row.settles = f.settles;
  row.least_energy = f.least_energy;
  return row;
}

enum class estimator : std::uint8_t { difference, observer, edge };
struct steps_row {
  double quantum = 60e-6, friction = 0.0, stiffness = 0.0;
  estimator by{};
  bool bounded = false;  ///< by a ledger for encoders
  double settles = 0.0;  ///< [s]
  double depth = 0.0;    ///< at the end [m]
  double swing = 0.0;    ///< of the last second [m]
  double step = 0.0;     ///< of the last second [N a tick]
  double least_energy = 0.0;
};
ex::record record_of(const steps_row& r) {
  return {{"encoder_um", r.quantum * 1e6, "%.0f"},
          {"friction_N", r.friction, "%.1f"},
          {"K", r.stiffness, "%.0f"},
          {"estimator", std::string(r.by == estimator::difference ? "last_difference"
                                    : r.by == estimator::observer ? "mass_observer"
                                                                  : "edge_observer")},
          {"behind", std::string(!r.bounded                ? "nothing"
                                 : r.by == estimator::edge ? "dual_ledger"
                                                           : "quantised_energy")},
          {"settles_s", r.settles, "%.1f"},
          {"depth_mm", r.depth * 1e3, "%.2f"},
          {"swing_mm", r.swing * 1e3, "%.3f"},
          {"step_N", r.step, "%.3f"},
          {"least_energy_J", r.least_energy}};
}
template <class Observer, class Bound, class Motion>
steps_row press_on_steps(steps_row row, const Observer& observer, const Bound& bound,
                         const Motion& motion) {
  ph::passive_port port{d3{},  ph::settled_force{.mass = mass},          observer,
                        bound, ph::loop_limits{.longest_tick = longest}, motion};
  renderer wanted_at(kind::sphere, row.stiffness);
  sim::device<d3, pressing_hand> device({.mass = mass,
                                         .damping = true_damping,
                                         .friction = row.friction,
                                         .quantum = row.quantum,
                                         .period = T,
                                         .start = vector(0.004, 0.003, radius + 0.01)},
                                        {});
  calm rest;
  vector last = vector::Zero(), from = vector::Zero();
  auto sample = device.exchange(vector::Zero());
  for (int n = 1; n < 8000; ++n) {
    const double t = n * T;
    const vector f = port.tick(sample, wanted_at(sample.position)).force;
    sample = device.exchange(f);
    rest.see(t, device.velocity().norm(), 0.0);
    if (t < 7.0) {
      from = device.position();
    } else {
      row.swing = std::max(row.swing, (device.position() - from).norm());
      row.step = std::max(row.step, (f - last).norm());
    }
    last = f;
  }
  row.depth = radius - device.position().norm();
  row.settles = rest.since(held_from);
  row.least_energy = device.meter().minimum();
  return row;
}
steps_row judge(const steps_row& row) {
  const ph::no_observer uncounted;
  const ph::no_bound unbounded;
  const ph::bound_chain reachable{ph::reachable_bound{.mass = mass, .hand_force = 8.0},
                                  ph::actuator_limit{.most = 9.0}};
  const ph::mass_observer observer{.mass = mass, .quantum = row.quantum};
  const ph::edge_observer edge{.quantum = row.quantum};
  if (row.by == estimator::difference) {
    return press_on_steps(row, uncounted, unbounded, ph::last_difference{});
  }
  if (row.by == estimator::observer) {
    const ph::quantised_energy sure{.damping = {0.05}, .quantum = row.quantum};
    return row.bounded ? press_on_steps(row, sure, reachable, observer)
                       : press_on_steps(row, uncounted, unbounded, observer);
  }
  const ph::dual_ledger dual{.damping = {.coefficient = 0.05, .coulomb = 0.15, .presliding = 1e-5},
                             .quantum = row.quantum};
  return row.bounded ? press_on_steps(row, dual, reachable, edge)
                     : press_on_steps(row, uncounted, unbounded, edge);
}

}  // namespace

std::vector<std::string> run_guards(const session& s) {
  std::vector<std::string> found;
  const std::string settles = to_string(guard::settled);
  const auto named = [](const guard_row& r) {
    return std::string(to_string(r.renders)) + ", " + ex::format("%.0f N/m: ", r.stiffness);
  };

  s.out.section(
      "Guards: renderers",
      "A hand comes down, presses 2 N and holds still, or slides to and fro at up to 0.1 m/s. "
      "Settled: at most 1 mm/s rms and steps of 0.02 N a tick. In reach: no stiffer than "
      "settled_force::most_stiffness.");
  std::vector<guard_row> jobs;
  for (const kind k : all_kinds) {
    for (const double K : {500.0, 2000.0, 8000.0}) {
      for (const guard g : all_guards) jobs.push_back({.renders = k, .stiffness = K, .by = g});
    }
  }
  const double seconds = s.chosen.quick ? 4.0 : 20.0;
  const auto rows = s.rows("guards.csv", "guards", jobs,
                           [seconds](const guard_row& r) { return judge(r, seconds); });
  ex::show_rows(s.out, "guards", rows);
  int rings = 0, soft = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const guard_row& r = rows[i];
    expect(found, r.least_energy >= -1e-12, named(r) + to_string(r.by) + " loses energy");
    expect(found, r.in_air <= 0.005, named(r) + to_string(r.by) + " pushes in the air");
    if (r.by == guard::given && r.settles > 1.0) ++rings;
    if (r.by == guard::strict && r.depth > 1.5 * rows[i + 1].depth) ++soft;
    if (r.by != guard::settled) continue;
    const guard_row& given = rows[i - 2];
    if (r.in_reach) {
      expect(found, r.settles <= 1.0, named(r) + settles + " does not rest");
      expect(found, r.kept <= given.kept + calm_step, named(r) + settles + " withholds force");
    }
    if (r.renders == kind::floor || r.renders == kind::sphere) {
      expect(found, r.drag <= 0.05, named(r) + settles + " drags");
    }
    if (r.renders == kind::facets) {
      expect(found, r.step <= given.step, named(r) + settles + " makes the edges louder");
    }
  }
  expect(found, rings > 5, "the control does not ring: a given force under a reachable bound");
  expect(found, soft > 5, "the control is not soft: the strict guard");

  s.out.section("Guards: a law",
                "The floor as a surface, under a spring and under one that settled_force shapes, "
                "behind a reachable bound. In reach: no stiffer than most_stiffness; above it the "
                "law is softened.");
  std::vector<guard_row> under;
  for (const double K : {500.0, 2000.0, 8000.0, 40000.0, 160000.0}) {
    for (const guard g : {guard::law, guard::shaped}) under.push_back({.stiffness = K, .by = g});
  }
  const auto laws = s.rows("guards_laws.csv", "laws", under,
                           [seconds](const guard_row& r) { return judge_law(r, seconds); });
  ex::show_rows(s.out, "guards_laws", laws);
  rings = 0;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const guard_row& r = laws[i];
    expect(found, r.least_energy >= -1e-12, named(r) + to_string(r.by) + " loses energy");
    if (r.by == guard::law) {
      if (r.settles > 1.0) ++rings;
      continue;
    }
    const guard_row& bare = laws[i - 1];
    expect(found, r.settles <= 1.0, named(r) + "the shaped law does not rest");
    expect(found, r.drag <= 0.05, named(r) + "the shaped law drags");
    if (r.in_reach) {
      expect(found, r.step <= calm_step, named(r) + "the shaped law steps as it slides");
      expect(found, r.kept <= bare.kept + calm_step, named(r) + "the shaped law withholds force");
    }
  }
  expect(found, rings > 0, "the control rests: a bare spring under a reachable bound");
  const double kept = detents_kept(guard::settled);
  s.out.section("Guards: detents", "Crossed at 5 mm/s behind make_guard they keep " +
                                       ex::format("%.0f", 100.0 * kept) +
                                       " of 100 of their force.");
  expect(found, kept > 0.95, "detents lose their force");

  s.out.section(
      "Guards: stroked",
      "What make_guard adds to the given force of 2 N, stroked to and fro at up to 0.1 m/s by a "
      "device of any mass, and to a force of 1 N that is the same everywhere.");
  std::vector<stroke_row> strokes;
  for (const stroked what : {stroked::floor, stroked::ball, stroked::bowl, stroked::wind}) {
    for (const double m : {0.1, 0.3, 1.0, 2.0}) strokes.push_back({.what = what, .mass = m});
  }
  const auto felt = s.rows("guards_strokes.csv", "strokes", strokes, stroke);
  ex::show_rows(s.out, "guards_strokes", felt);
  for (const stroke_row& r : felt) {
    if (r.what == stroked::bowl) continue;  // which has a slope
    expect(found, r.largest <= 0.025, ex::format("stroked by %.1f kg it drags", r.mass));
  }

  s.out.section("Guards: random sums of walls",
                "Falls into one to five walls of 0.3 to 6 kN/m, as stiff as is in reach, 0 to 3 "
                "ticks late, of 0.05 to "
                "1 kg, of which 50 to 100 % are told, with a load off axis. Those that slide away "
                "are not counted.");
  std::vector<sum_row> sums;
  for (const guard g : all_guards) {
    for (const int grip : {0, 1, 2}) sums.push_back({.by = g, .grip = grip});
  }
  const int cases = s.chosen.quick ? 90 : 1500;
  const auto seed = static_cast<std::uint64_t>(s.chosen.seed);
  const auto fallen = s.rows("guards_sums.csv", "random sums", sums,
                             [&](const sum_row& r) { return fall_often(r, seed, cases); });
  ex::show_rows(s.out, "guards_sums", fallen);
  int unsettled = 0;
  for (const sum_row& r : fallen) {
    expect(found, r.least_energy >= -1e-12, std::string(to_string(r.by)) + " loses energy");
    if (r.by == guard::given) unsettled += r.unsettled;
    if (r.by == guard::settled) {
      expect(found, r.unsettled == 0, std::to_string(r.unsettled) + " random sums do not rest");
    }
  }
  expect(found, unsettled > cases / 50, "the control rests: a given force in random sums");
  plot_sums(s, fallen);

  s.out.section("Guards: a renderer slower than the tick",
                "The same falls behind make_guard, of a renderer that computes its force each "
                "P in place of each tick of T, with walls as they are drawn, where the guard is "
                "told P or not, and with walls that add up to 0.1 m/(T P).");
  std::vector<slow_row> slow;
  for (const bool gentle : {true, false}) {
    for (const int every : {1, 2, 4, 10, 16, 33}) slow.push_back({.every = every, .soft = gentle});
  }
  for (const int every : {2, 4, 10, 16, 33}) slow.push_back({.every = every, .told = true});
  const auto held = s.rows("guards_slow.csv", "slow renderers", slow,
                           [&](const slow_row& r) { return fall_slowly(r, seed, cases / 3); });
  ex::show_rows(s.out, "guards_slow", held);
  for (const slow_row& r : held) {
    expect(found, r.least_energy >= -1e-12, "a slow renderer loses energy");
    if (r.every <= 4) expect(found, r.unsettled == 0, "a renderer of 250 Hz does not rest");
  }
  const auto swings_on = [&held](bool told, int slowest = 33) {
    int n = 0;
    for (const slow_row& r : held) {
      n += !r.soft && r.told == told && r.every > 1 && r.every <= slowest ? r.unsettled : 0;
    }
    return n;
  };
  expect(found, swings_on(false) > 0, "the control rests: slow renderers of which nobody tells");
  // From 60 Hz on half of them at most, where enough swing on untold to compare, which a quick run has not.
  const bool half = swings_on(false, 16) < 20 || 2 * swings_on(true, 16) < swings_on(false, 16);
  expect(found, half && 4 * swings_on(true) < 3 * swings_on(false),
         "slow renderers swing on, though told of");

  s.out.section("Guards: walls that heave",
                "A wall that heaves by 0.2 to 4 mm at 0.3 to 3 Hz, read in each tick, is none that "
                "is too stiff: how often make_guard takes it for one, and by how much its force "
                "is away then, on the mean. A hand of 100 to 800 N/m presses with 0.5 to 4 N. The "
                "last row is the control.");
  const std::vector<heave_row> heaving{
      {.hand = "still"},
      {.hand = "kneads", .least_Hz = 0.5, .most_Hz = 4.0},
      {.hand = "kneads quickly", .least_Hz = 3.0, .most_Hz = 8.0},
      {.hand = "still", .steep = true},
  };
  const auto heaved =
      s.rows("guards_heave.csv", "walls that heave", heaving,
             [&](const heave_row& r) { return heave_often(r, seed, s.chosen.quick ? 100 : 300); });
  ex::show_rows(s.out, "guards_heave", heaved);
  for (const heave_row& r : heaved) {
    expect(found, r.least_energy >= -1e-12, "a wall that heaves loses energy");
    const std::string name = std::string("walls that heave, hand ") + r.hand + ": ";
    if (r.steep) {
      expect(found, r.softened > r.cases / 2, name + "the control, of steep ones, is not softened");
    } else {
      expect(found, r.away < 0.07, name + ex::format("%.2f of the force is away", r.away));
    }
  }

  s.out.section("Guards: dropped",
                "0.1 kg with a load of 1 N, from 30 mm into a groove of 20 degrees.");
  std::vector<drop_row> drops;
  for (const guard g : all_guards) {
    for (const double K : {500.0, 2000.0, 8000.0}) {
      for (const int late : {0, 3}) drops.push_back({.by = g, .stiffness = K, .late = late});
    }
  }
  const auto dropped = s.rows("guards_drops.csv", "drops", drops, drop);
  ex::show_rows(s.out, "guards_drops", dropped);
  const ph::settled_force known{.mass = told.mass};
  for (const drop_row& r : dropped) {
    expect(found, r.least_energy >= -1e-12,
           std::string(to_string(r.by)) + " loses energy, dropped");
    if (r.by == guard::settled && r.stiffness <= known.most_stiffness(longest, r.late) / 2.0) {
      expect(found, r.settles <= 1.0, ex::format("dropped on %.0f N/m: no rest", r.stiffness));
    }
  }

  s.out.section(
      "Guards: encoders",
      "The sphere behind settled_force on encoders with steps, by itself and behind a ledger for "
      "them. A position that "
      "changes by a step moves the force by K times the step, whatever is done about speeds.");
  std::vector<steps_row> stepped;
  for (const double q : {10e-6, 60e-6}) {
    for (const double friction : {0.0, 0.3}) {
      for (const double K : {500.0, 1500.0, 3000.0}) {
        for (const auto e : {estimator::difference, estimator::observer, estimator::edge}) {
          steps_row row{.quantum = q, .friction = friction, .stiffness = K, .by = e};
          stepped.push_back(row);
          row.bounded = e == estimator::observer || (e == estimator::edge && friction > 0.0);
          if (row.bounded) stepped.push_back(row);
        }
      }
    }
  }
  const auto steps = s.rows("guards_encoders.csv", "encoders", stepped,
                            [](const steps_row& r) { return judge(r); });
  ex::show_rows(s.out, "guards_encoders", steps);
  int restless = 0;
  for (const steps_row& r : steps) {
    if (r.bounded) expect(found, r.least_energy >= -1e-12, "loses energy on an encoder");
    if (r.by == estimator::difference && r.step > 0.1) ++restless;
    if (r.by == estimator::observer && !r.bounded && r.stiffness < 1000.0) {
      expect(found, r.settles <= 2.0, "mass_observer: does not rest on an encoder");
    }
  }
  expect(found, restless > 0, "the control is quiet: last_difference on an encoder");
  return found;
}

}  // namespace contacts
