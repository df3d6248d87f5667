// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"
#include <passive_haptics/simulation/challenge.hpp>

#include <cmath>

namespace stability {

namespace {

namespace sim = ph::simulation;
using controllers::d3;
using controllers::f3;
using wide = long double;
using wide_vector = Eigen::Matrix<wide, 3, 1>;

wide angle_between(const wide_vector& a, const wide_vector& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

template <class Space>
wide_vector widened(const typename Space::vector& v) {
  return v.template cast<wide>();
}

/// The triangle with its longest edge through `point`, `normal` up to rounding, as thin as asked.
template <class Space>
struct lay_sliver {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  double size = 0.04;
  double aspect = 1.0;

  ph::triangle<Space> operator()(const vector& point, const vector& normal,
                                 scalar K) const noexcept {
    const vector u = Space::orthogonal(normal);
    const vector w = Space::cross(normal, u);
    const auto half = static_cast<scalar>(size / 2.0);
    const auto height = static_cast<scalar>(size / aspect);
    return {.a = vector(point - u * half),
            .b = vector(point + u * half),
            .c = vector(point + w * height),
            .stiffness = K};
  }
};

constexpr double turn_rate = 4.0;  // [rad/s]

template <class Space, class Bound>
auto on_triangle(const Bound& bound) {
  return ph::local_model{
      Space{},
      ph::followed<ph::triangle<Space>>{},
      ph::turn_limited{.rate = turn_rate},
      ph::spring{},
      ph::reduced_energy{.damping = 0.03},
      bound,
      ph::loop_limits{.longest_tick = 1e-3, .top_speed = 100.0, .watchdog = 1e-3}};
}

template <class Space>
sliver_row sliver_row_of(const char* scalar_name, double size, double aspect, int each) {
  using scalar = typename Space::scalar;
  sliver_row row{.scalar = scalar_name, .size = size, .aspect = aspect};
  sim::random_source random(7);
  const lay_sliver<Space> lay{size, aspect};
  for (int i = 0; i < each; ++i) {
    const auto normal = sim::to_port<Space>(random.direction<Space>());
    const auto point = sim::to_port<Space>(
        typename sim::physical<Space>::vector(random.direction<Space>() * size));
    auto t = lay(point, normal, scalar(1000));
    auto model = on_triangle<Space>(ph::strict_bound{});
    ++row.tried;
    const bool taken = model.update(t);
    const auto out = model.tick(point, ph::seconds{1e-3});
    if (!Space::is_finite(out.force) || !ph::kernels::is_finite(out.depth)) ++row.not_finite;
    if (!taken) {
      if (out.what != ph::event::rejected_target && out.what != ph::event::no_target) ++row.silent;
      continue;
    }
    ++row.accepted;
    static_cast<void>(t.prepare());
    const typename Space::vector a = t.a, b = t.b, c = t.c;
    const wide_vector along = widened<Space>(b) - widened<Space>(a);
    const wide_vector aside = widened<Space>(c) - widened<Space>(a);
    const wide_vector exact = ph::space<wide, 3>::cross(along, aside);
    const wide_vector shown = widened<Space>(t.at(point).outward());
    if (!shown.allFinite()) ++row.not_finite;
    const wide error = angle_between(exact.normalized(), shown.normalized());
    row.largest_error = std::fmax(row.largest_error, static_cast<double>(error));
  }
  return row;
}

template <class Space>
normal_row normal_row_of(const char* scalar_name, double apart, int each) {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  normal_row row{.scalar = scalar_name, .apart = apart};
  sim::random_source random(11);
  const auto dt = scalar(1e-3);
  const wide most = wide(turn_rate) * wide(dt);
  const ph::part_at<ph::turn_limited, Space> turner(ph::turn_limited{.rate = turn_rate});
  for (int i = 0; i < each; ++i) {
    const auto first = random.direction<Space>();
    const auto aside = sim::physical<Space>::orthogonal(first);
    const auto last = first * std::cos(apart) + aside * std::sin(apart);
    vector n = sim::to_port<Space>(first).normalized();
    const vector goal = sim::to_port<Space>(last).normalized();
    ++row.tried;
    for (int step = 0; step < 2000 && !(n == goal); ++step) {
      const vector next = turner.step(n, goal, dt);
      const wide turned =
          angle_between(widened<Space>(n).normalized(), widened<Space>(next).normalized());
      row.fastest = std::fmax(row.fastest, static_cast<double>(turned / most));
      row.longest_error = std::fmax(row.longest_error,
                                    static_cast<double>(std::abs(widened<Space>(next).norm() - 1)));
      n = next;
    }
    row.arrived += n == goal ? 1 : 0;
  }
  return row;
}

template <class Space, class Bound>
attack_row attack_of(const char* scalar_name, const char* name, const Bound& bound, double aspect,
                     int runs) {
  attack_row row{scalar_name, name + ex::format(", aspect %g", aspect)};
  const lay_sliver<Space> lay{0.04, aspect};
  for (const auto by : {sim::adversary::flipping_normal, sim::adversary::kitchen_sink}) {
    const auto v = sim::challenge(on_triangle<Space>(bound), by, {}, runs, 1, lay);
    row.least_energy = std::fmin(row.least_energy, v.least_energy);
    row.largest_force = std::fmax(row.largest_force, v.largest_force);
  }
  return row;
}

}  // namespace

std::vector<sliver_row> slivers(int each) {
  std::vector<sliver_row> rows;
  for (const double size : {1e-6, 0.04}) {
    for (const double aspect : {1.0, 1e2, 1e4, 1e5, 1e6, 1e8, 1e10, 1e14}) {
      rows.push_back(sliver_row_of<f3>("float", size, aspect, each));
      rows.push_back(sliver_row_of<d3>("double", size, aspect, each));
    }
  }
  return rows;
}

std::vector<normal_row> turns(int each) {
  const double pi = 3.14159265358979323846;
  std::vector<normal_row> rows;
  for (const double apart : {1e-8, 1e-4, 1.0, pi - 1e-2, pi - 1e-3, pi - 1e-4, pi - 1e-8, pi}) {
    rows.push_back(normal_row_of<f3>("float", apart, each));
    rows.push_back(normal_row_of<d3>("double", apart, each));
  }
  return rows;
}

std::vector<attack_row> attacks_on_slivers(int runs) {
  std::vector<attack_row> rows;
  for (const double aspect : {1.0, 1e2, 1e4}) {
    rows.push_back(attack_of<f3>("float", "strict_bound", ph::strict_bound{}, aspect, runs));
    rows.push_back(attack_of<d3>("double", "strict_bound", ph::strict_bound{}, aspect, runs));
  }
  rows.push_back(attack_of<d3>("double", "no_bound", ph::no_bound{}, 1.0, runs));
  return rows;
}

static ex::record record_of(const sliver_row& r) {
  return {{"scalar", r.scalar}, {"longest edge m", r.size},
          {"aspect", r.aspect}, {"accepted", r.accepted},
          {"of", r.tried},      {"largest error rad", r.largest_error},
          {"silent", r.silent}, {"not finite", r.not_finite}};
}
static ex::record record_of(const normal_row& r) {
  return {{"scalar", r.scalar},         {"apart rad", r.apart, "%.10g"},
          {"arrived", r.arrived},       {"of", r.tried},
          {"speed", r.fastest, "%.6f"}, {"largest | |n| - 1 |", r.longest_error}};
}
static ex::record record_of(const attack_row& r) {
  return {{"scalar", r.scalar},
          {"bound", r.what},
          {"least true energy J", r.least_energy},
          {"largest force N", r.largest_force}};
}

/// "slivers, scalar float, aspect 100, ...": all of a row that failed.
template <class Row>
static std::string described(std::string text, const Row& row) {
  for (const auto& f : record_of(row)) text += ", " + f.name + ' ' + f.shown;
  return text;
}

std::vector<std::string> run_shapes(const session& s) {
  const int each = s.chosen.quick ? 100 : 2000;
  std::vector<std::string> found;
  s.out.section("Slivers",
                "Triangles of any direction, longest edge over height. Refused: the "
                "height is lost in rounding (event rejected target, the last good one "
                "stays). Error: of an accepted triangle's normal, against 64 bits.");
  const auto thin = slivers(each);
  for (const auto& r : thin) {
    if (r.silent + r.not_finite > 0) found.push_back(described("slivers", r));
  }
  ex::show_rows(s.out, "slivers", thin);

  s.out.section("Normals",
                "turn_limited at 4 rad/s, 1 ms, from one direction to another. speed: "
                "the largest turn of a step over rate·dt.");
  const auto turned = turns(each / 20 + 5);
  for (const auto& r : turned) {
    const double eps = std::string(r.scalar) == "float" ? 1.2e-7 : 2.3e-16;
    // Normals round by ε or so, which is 3e-5 of a step of 4 mrad in float.
    if (r.arrived < r.tried || !(r.fastest <= 1.0 + 4.0 * eps / 4e-3) ||
        !(r.longest_error <= 2.0 * eps)) {
      found.push_back(described("normals", r));
    }
  }
  s.out.show(ex::table_of(turned));

  s.out.section("Attacks on slivers",
                "Flipping normals and the kitchen sink against triangle + turn_limited + spring. "
                "no_bound is the control: it must be seen losing. These hands never hold still, so "
                "nothing comes to rest.");
  const auto attacked = attacks_on_slivers(s.chosen.quick ? 30 : 1000);
  for (const auto& r : attacked) {
    const bool is_control = r.what.rfind("no_bound", 0) == 0;
    const bool held = r.least_energy >= -1e-12;
    if (held == is_control || !(r.largest_force > 0.0)) {
      found.push_back(described("attacks on slivers", r));
    }
  }
  s.out.show(ex::table_of(attacked));
  return found;
}

}  // namespace stability
