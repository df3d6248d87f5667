// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Nothing depends on the units in which a device is described, nor on which way it is turned. A composition is tried
// twice with one device, one hand and one world: in SI, and in units that are powers of two of these, by a half turn.
// Neither rounds anything, nor does a root of a stiffness, so all that it says has to be the same to the last bit. What
// multiplies where it should divide, compares a length with a number, or forgets a sign, is not.
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace in_units {

/// What a metre, a second and a newton count in other units, and whether all is turned by half a turn.
struct units {
  double m = 1.0, s = 1.0, N = 1.0;
  bool turned = false;
  double q = 0.0;  ///< a step of the encoders [m]

  [[nodiscard]] double kg() const { return N * s * s / m; }
  [[nodiscard]] double J() const { return N * m; }
  [[nodiscard]] double stiff() const { return N / m; }     // N/m
  [[nodiscard]] double damp() const { return N * s / m; }  // N·s/m
  [[nodiscard]] double speed() const { return m / s; }     // m/s
  /// The sign of a component: a half turn about the last axis, on a line to its other end.
  [[nodiscard]] double sign(int i, int dof) const {
    return turned && (dof == 1 || i < 2) ? -1.0 : 1.0;
  }
  template <class Space>
  [[nodiscard]] typename Space::vector vector(const std::array<double, 3>& v, double unit) const {
    typename Space::vector out = Space::zero();
    for (int i = 0; i < Space::dof; ++i) {
      Space::component(out, i) =
          static_cast<typename Space::scalar>(v[std::size_t(i)] * unit * sign(i, Space::dof));
    }
    return out;
  }
};
inline constexpr units si{};
inline constexpr units others_in_steps{.m = 4.0, .s = 0.25, .N = 0.25, .q = 55e-6};
inline constexpr units all_others{.m = 4.0, .s = 0.25, .N = 0.25, .turned = true};
inline constexpr units other_forces{.m = 1.0, .s = 1.0, .N = 4.0, .turned = true};
inline constexpr units other_lengths{.m = 4.0, .s = 1.0, .N = 0.25, .turned = true};

inline ph::loop_limits limits(const units& u) {
  return {.longest_tick = 1e-3 * u.s, .top_speed = 5.0 * u.speed(), .workspace = 2.0 * u.m};
}
template <int Late>
ph::late_loop_limits<Late> late(const units& u) {
  return {.longest_tick = 1e-3 * u.s,
          .top_speed = 5.0 * u.speed(),
          .workspace = 2.0 * u.m,
          .watchdog = 4e-3 * u.s};
}
inline ph::reachable_bound reach(const units& u) {
  return {.mass = 0.1 * u.kg(), .hand_force = 5.0 * u.N};
}
template <class Surface>
ph::followed<Surface> followed(const units& u) {
  return ph::followed<Surface>{{.stale_after = 0.1 * u.s, .fade = 0.05 * u.s}};
}
inline ph::damped_spring damped(const units& u) {
  return {.mass = 0.1 * u.kg(), .force_limit = 8.0 * u.N};
}
inline ph::pursuit pace(const units& u) {
  return {.speed = 0.05 * u.speed(),
          .catch_up = 0.04 * u.s,
          .turn_rate = 2.0 / u.s,
          .force_rate = 50.0 * u.N / u.s,
          .edge = 1e-3 * u.m,
          .stale_after = 0.1 * u.s};
}
inline ph::proxy_spring proxy(const units& u) {
  return {.mass = 0.1 * u.kg(), .force_limit = 8.0 * u.N};
}
inline ph::stick_slip rough(const units& u) {
  return {.weakening = 2e-4 * u.m, .healing = 0.02 * u.s};
}

/// A plane that heaves and tilts, of changing stiffness.
template <class Space>
ph::half_space<Space> plane(const units& u, int n) {
  const double t = 1e-3 * n, height = 5e-4 * std::sin(9.0 * t), tilt = 0.2 * std::sin(2.0 * t);
  ph::half_space<Space> out;
  std::array<double, 3> at{}, normal{};
  at[std::size_t(Space::dof - 1)] = height;
  if (Space::dof > 1) normal[0] = tilt;
  normal[std::size_t(Space::dof - 1)] = 1.0;
  out.point = u.vector<Space>(at, u.m);
  out.normal = u.vector<Space>(normal, 1.0);
  out.stiffness = static_cast<typename Space::scalar>((n % 200 < 100 ? 800.0 : 1500.0) * u.stiff());
  return out;
}
inline ph::triangle<d3> triangle(const units& u, int n) {
  const double z = 5e-4 * std::sin(9e-3 * n);
  return {.a = u.vector<d3>({-0.01, -0.01, z}, u.m),
          .b = u.vector<d3>({0.012, 0.0, z + 1e-3}, u.m),
          .c = u.vector<d3>({-0.01, 0.011, z}, u.m),
          .stiffness = 900.0 * u.stiff()};
}

/// What a port said, in SI, and what became of the device.
struct session {
  std::vector<double> said;
  double pressed = 0.0;  ///< the largest force [N]
  int cut = 0;           ///< ticks in which it was limited
};

/// A device of 0.1 kg in a hand that presses, rubs and lets go, in the port's loop; late and short ticks, lost
/// samples, outliers, and forces that are held otherwise than told.
template <class space, class Port, class News, class Tick>
session lived(Port& port, const units& u, const News& news, const Tick& tick, int ticks = 1200) {
  constexpr int dof = space::dof;
  session out;
  std::array<double, 3> x{}, v{}, f{};
  x[std::size_t(dof - 1)] = 2e-3;
  for (int n = 0; n < ticks; ++n) {
    if (n % 33 == 0) news(port, n);
    const double dt = n % 97 == 96 ? 1.6e-3 : n % 41 == 40 ? 0.5e-3 : 1e-3;
    for (int i = 0; i < dof; ++i) {
      const auto j = std::size_t(i);
      const double phase = 1.0 * i, slow = 1e-3 * n;
      const double aim =
          i + 1 == dof ? -5e-3 + 7e-3 * std::cos(7.0 * slow) : 8e-3 * std::sin(3.0 * slow + phase);
      const double hand = std::clamp(400.0 * (aim - x[j]) - 1.5 * v[j], -4.5, 4.5);
      v[j] += dt / 0.1 * (hand + f[j] - 0.05 * v[j]);
      x[j] += dt * v[j];
    }
    std::array<double, 3> shown = x, held = f;
    if (u.q > 0.0) {
      for (auto& at : shown) at = u.q * std::floor(at / u.q);
    }
    if (n % 401 == 400) shown[0] = std::nan("");
    if (n % 307 == 306) shown[0] += 0.03;
    if (n > 700 && n % 250 < 6) held[0] = -f[0];
    const auto result =
        tick(port, u, u.vector<space>(shown, u.m), u.vector<space>(held, u.N), dt * u.s, n);
    for (int i = 0; i < dof; ++i) {
      const auto j = std::size_t(i);
      f[j] = static_cast<double>(space::component(result.force, i)) * u.sign(i, dof) / u.N;
      out.said.push_back(f[j]);
      out.pressed = std::max(out.pressed, std::abs(f[j]));
    }
    out.said.push_back(static_cast<double>(result.energy) / u.J());
    out.said.push_back(static_cast<double>(result.what));
    out.said.push_back(result.limited ? 1.0 : 0.0);
    out.cut += result.limited ? 1 : 0;
    if constexpr (requires { result.depth; }) {
      out.said.push_back(static_cast<double>(result.depth) / u.m);
    }
    if constexpr (requires { port.explain(); }) {
      if (n % 20 != 0) continue;
      const auto e = port.explain();
      for (const double k : {e.asked, e.shown}) out.said.push_back(k / u.stiff());
      out.said.push_back(e.floor / u.N);
      out.said.push_back(e.depth / u.m);
      out.said.push_back(e.force / u.N);
      out.said.push_back(static_cast<double>(e.stiffness));
      out.said.push_back(static_cast<double>(e.now));
    }
  }
  return out;
}
template <class Space>
inline constexpr auto by_itself =
    [](auto& port, const units&, const auto& x, const auto& held, double dt, int /*n*/) {
      using sample = ph::device_sample<Space>;
      return port.tick(sample{.position = x, .held = held, .dt = dt, .valid = true});
    };
template <class Space>
inline constexpr auto given =
    [](auto& port, const units& u, const auto& x, const auto& held, double dt, int n) {
      using sample = ph::device_sample<Space>;
      std::array<double, 3> wanted{};
      for (int i = 0; i < Space::dof; ++i) {
        const double in = static_cast<double>(Space::component(x, i)) / u.m * u.sign(i, Space::dof);
        wanted[std::size_t(i)] = in < 0.0 ? -2500.0 * in : -50.0 * in;
      }
      const auto w = u.vector<Space>(wanted, u.N);
      const sample now{.position = x, .held = held, .dt = dt, .valid = true};
      return n % 100 < 90 ? port.tick(now, w) : port.tick(now);
    };

/// The first number that differs, or −1.
inline int differs(const session& a, const session& b) {
  if (a.said.size() != b.said.size()) return 0;
  for (std::size_t i = 0; i < a.said.size(); ++i) {
    if (!(a.said[i] == b.said[i]) && !(std::isnan(a.said[i]) && std::isnan(b.said[i]))) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

/// Tries what `make`(units) composes; `others` are units that it has to be indifferent to.
template <class Space>
void indifferent(const units& others, const auto& make, const auto& news, const auto& tick) {
  auto own = si;
  own.q = others.q;
  auto worn = make(own);
  REQUIRE_FALSE(worn.check());
  const session plain = lived<Space>(worn, own, news(own), tick);
  auto elsewhere = make(others);
  const session other = lived<Space>(elsewhere, others, news(others), tick);
  CHECK(differs(plain, other) == -1);
  CHECK(plain.pressed > 0.1);
  CHECK(plain.said.size() > 5000);
  auto told_wrong = others;  // the control
  told_wrong.N *= 2.0;
  elsewhere.reset();
  CHECK(differs(plain, lived<Space>(elsewhere, told_wrong, news(told_wrong), tick)) != -1);

  // What a port has lived is forgotten at a reset, wherever it is.
  for (const int ticks : {405, 1200}) {
    worn.reset();
    (void)lived<Space>(worn, own, news(own), tick, ticks);
    worn.reset();
    CHECK(differs(plain, lived<Space>(worn, own, news(own), tick)) == -1);
  }
}
template <class Space>
inline constexpr auto planes = [](const units& u) {
  return [u](auto& port, int n) { CHECK(port.update(plane<Space>(u, n))); };
};
inline constexpr auto triangles = [](const units& u) {
  return [u](auto& port, int n) { CHECK(port.update(triangle(u, n))); };
};
inline constexpr auto none = [](const units&) { return [](auto&, int) {}; };

}  // namespace in_units
