// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The workload of the counted and timed ticks: a hand presses a surface and lets go, three times in 4 s, while
// the environment publishes a tilting triangle 30 times a second. The wall and the half-space have the same
// motion. One tick in 499 is late, and one in 997 has a sample that is no number.
//
//   air         no contact
//   contact     the whole force, the local model where the environment wants it
//   following   the whole force, the local model still on its way there        (triangle only)
//   limited     the bound cuts the force
//   late, bad   a tick longer than the longest, a sample that is no number

#include "scenes.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace cost {

enum class path : std::uint8_t { air, contact, following, limited, late, bad };
inline constexpr std::array all_paths{path::air,     path::contact, path::following,
                                      path::limited, path::late,    path::bad};

[[nodiscard]] constexpr const char* to_string(path p) noexcept {
  constexpr std::array names{"air", "contact", "following", "limited", "late", "bad"};
  return names[static_cast<std::size_t>(p)];
}

/// One tick to come.
struct step {
  std::array<double, 3> position{};
  double dt = 1e-3;
  bool news = false;  ///< the environment has published `target`
  surface target;
  path taken{};  ///< as the hand-written side goes
};

/// The device and the loop of the workload.
inline constexpr settings ordinary{.damping = 0.3, .loan = 0, .stiffness = 2000};

[[nodiscard]] inline step script(int n) {
  const double t = 1e-3 * n;
  const double phase = 2 * std::numbers::pi * 0.75 * t;
  step s;
  s.position = {2e-3 * std::sin(0.9 * phase), 2e-3 * std::cos(1.3 * phase),
                1e-3 - 3e-3 * std::sin(phase)};
  if (n % 499 == 498) s.dt = 1.2e-3;
  if (n % 997 == 996) s.position[2] = std::nan("");
  s.news = n % 33 == 0;
  const double tilt = 2e-3 * std::sin(2.1 * phase);
  const double height = 4e-4 * std::sin(1.7 * phase);
  s.target = {{-0.02, -0.02, height - tilt},
              {0.02, -0.02, height + tilt},
              {0, 0.03, height - tilt},
              ordinary.stiffness};
  return s;
}

/// The path that a tick took.
template <class State, class Scalar>
[[nodiscard]] path path_of(const State& after, const outcome<Scalar>& o) {
  if (o.what == ph::event::rejected_sample) return path::bad;
  if (o.what == ph::event::late_tick) return path::late;
  if (!(o.depth > Scalar(0))) return path::air;
  if (o.limited) return path::limited;
  if constexpr (requires { after.news; }) {
    if (!after.news.together) return path::following;
  }
  return path::contact;
}

template <class Scene>
[[nodiscard]] std::vector<step> workload(int ticks = 4000) {
  using S = typename Scene::scalar;
  auto state = Scene::by_hand(ordinary);
  std::vector<step> steps;
  for (int n = 0; n < ticks; ++n) {
    step s = script(n);
    if (Scene::space::dof == 1) s.position = {s.position[2], 0, 0};
    if (s.news) update_any(state, s.target);
    const auto o = outcome_of<S>(advance(state, position_for<Scene, decltype(state)>(s.position),
                                         time_for<Scene, decltype(state)>(s.dt)));
    s.taken = path_of(state, o);
    steps.push_back(s);
  }
  return steps;
}

}  // namespace cost
