// SPDX-License-Identifier: BSD-3-Clause
#include "shapes.hpp"

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
    ph::local_model model{Space{},
                          ph::following<ph::triangle<Space>>{},
                          ph::rotate_limited<Space>{.rate = scalar(4)},
                          ph::spring<Space>{},
                          ph::reduced_energy<Space>{.damping = scalar(0.03)},
                          ph::strict_bound<Space>{}};
    ++row.tried;
    const bool taken = model.retarget(t);
    const auto out = model.tick(point, scalar(1e-3));
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
    const wide_vector shown = widened<Space>(t.outward());
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
  const auto rate = scalar(4), dt = scalar(1e-3);
  const wide most = wide(rate) * wide(dt);
  const ph::rotate_limited<Space> turner{.rate = rate};
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
  using scalar = typename Space::scalar;
  const ph::local_model model{Space{},
                              ph::following<ph::triangle<Space>>{},
                              ph::rotate_limited<Space>{.rate = scalar(4)},
                              ph::spring<Space>{},
                              ph::reduced_energy<Space>{.damping = scalar(0.03)},
                              bound};
  attack_row row{scalar_name, name + ex::format(", aspect %g", aspect)};
  const lay_sliver<Space> lay{0.04, aspect};
  for (const auto by : {sim::adversary::flipping_normal, sim::adversary::kitchen_sink}) {
    const auto v = sim::challenge(model, by, {}, runs, 1, lay);
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
    rows.push_back(attack_of<f3>("float", "strict_bound", ph::strict_bound<f3>{}, aspect, runs));
    rows.push_back(attack_of<d3>("double", "strict_bound", ph::strict_bound<d3>{}, aspect, runs));
  }
  rows.push_back(attack_of<d3>("double", "no_bound", ph::no_bound<d3>{}, 1.0, runs));
  return rows;
}

std::vector<std::string> run_shapes(const session& s) {
  const int each = s.chosen.quick ? 100 : 2000;
  std::vector<std::string> found, json;
  const auto number = [](double x) { return ex::format("%.3g", x); };

  s.out.section("Slivers",
                "Triangles of any direction, longest edge over height. Refused: the "
                "height is lost in rounding (event rejected target, the last good one "
                "stays). Error: of an accepted triangle's normal, against 64 bits.");
  ex::table thin({"scalar", "longest edge m", "aspect", "accepted", "of", "largest error rad",
                  "silent", "not finite"});
  for (const auto& r : slivers(each)) {
    thin.add({r.scalar, number(r.size), number(r.aspect), std::to_string(r.accepted),
              std::to_string(r.tried), number(r.largest_error), std::to_string(r.silent),
              std::to_string(r.not_finite)});
    json.push_back(ex::json_object({{"scalar", ex::json_string(r.scalar)},
                                    {"size_m", ex::json_number(r.size)},
                                    {"aspect", ex::json_number(r.aspect)},
                                    {"accepted", std::to_string(r.accepted)},
                                    {"tried", std::to_string(r.tried)},
                                    {"largest_error_rad", ex::json_number(r.largest_error)}}));
    if (r.silent + r.not_finite > 0) {
      found.push_back("slivers, " + std::string(r.scalar) + ", aspect " + number(r.aspect) + ": " +
                      std::to_string(r.silent) + " silent, " + std::to_string(r.not_finite) +
                      " not finite");
    }
  }
  s.out.show(thin);
  s.out.member("slivers", ex::json_array(json));

  s.out.section("Normals",
                "rotate_limited at 4 rad/s, 1 ms, from one direction to another. speed: "
                "the largest turn of a step over rate·dt.");
  ex::table turned({"scalar", "apart rad", "arrived", "of", "speed", "largest | |n| - 1 |"});
  for (const auto& r : turns(each / 20 + 5)) {
    const bool single = std::string(r.scalar) == "float";
    const double eps = single ? 1.2e-7 : 2.3e-16;
    turned.add({r.scalar, ex::format("%.10g", r.apart), std::to_string(r.arrived),
                std::to_string(r.tried), ex::format("%.6f", r.fastest), number(r.longest_error)});
    // Normals round by ε or so, which is 3e-5 of a step of 4 mrad in float.
    if (r.arrived < r.tried || !(r.fastest <= 1.0 + 4.0 * eps / 4e-3) ||
        !(r.longest_error <= 2.0 * eps)) {
      found.push_back("normals, " + std::string(r.scalar) + ", apart " + number(r.apart) +
                      ": arrived " + std::to_string(r.arrived) + " of " + std::to_string(r.tried) +
                      ", speed " + ex::format("%.6f", r.fastest));
    }
  }
  s.out.show(turned);

  s.out.section("Attacks on slivers",
                "Flipping normals and the kitchen sink against triangle + rotate_limited + spring. "
                "no_bound is the control: it must be seen losing.");
  ex::table attacked({"scalar", "bound", "least true energy J", "largest force N"});
  for (const auto& r : attacks_on_slivers(s.chosen.quick ? 30 : 1000)) {
    attacked.add({r.scalar, r.what, number(r.least_energy), number(r.largest_force)});
    const bool is_control = r.what.rfind("no_bound", 0) == 0;
    const bool held = r.least_energy >= -1e-12;
    if (held == is_control || !(r.largest_force > 0.0)) {
      found.push_back("attacks on slivers, " + std::string(r.scalar) + ", " + r.what +
                      ": least energy " + number(r.least_energy) + " J, largest force " +
                      number(r.largest_force) + " N");
    }
  }
  s.out.show(attacked);
  return found;
}

}  // namespace stability
