// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Devices whose transmission gives, hands on them, and what a bound is told of them.

#include "program.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace devices {

namespace sim = ph::simulation;
using d1 = ph::space<double, 1>;
using d3 = ph::space<double, 3>;

/// A hand that does one of six things, along `along` and, in three dimensions, as much across it now and then; never
/// with more than `most`.
template <class Space>
struct drawn_hand {
  using vector = typename Space::vector;
  enum class kind : std::uint8_t { square, sine, telegraph, pumps, kneads, turns_at };

  kind does = kind::square;
  double most = 5.0, frequency = 2.0, bias = 0.0,
         amplitude = 0.0;                   ///< [N], [Hz], [N] or [m], the same
  double stiffness = 300.0, damping = 3.0;  ///< of one that kneads
  double phase = 0.0, across = 0.0;         ///< [turns], share of it
  unsigned seed = 0;

  [[nodiscard]] vector force(double t, const vector& x, const vector& v) const noexcept {
    constexpr int normal = Space::dof - 1;
    vector f = Space::zero();
    for (int i = 0; i < Space::dof; ++i) {
      const double share = i == normal ? 1.0 : across;
      const double at = Space::component(x, i), speed = Space::component(v, i);
      Space::component(f, i) = share * along_one(t + 0.37 * (normal - i) / frequency, at, speed, i);
    }
    return sim::clamp_norm<Space>(f, most);
  }
  [[nodiscard]] static double mass() noexcept { return 0.0; }
  [[nodiscard]] static ph::parameter_fault check() noexcept { return {}; }

 private:
  [[nodiscard]] double along_one(double t, double x, double v, int axis) const noexcept {
    const double turn = 2.0 * std::numbers::pi * (frequency * t + phase);
    switch (does) {
      case kind::square:
        return bias + (std::sin(turn) > 0.0 ? amplitude : -amplitude);
      case kind::sine:
        return bias + amplitude * std::sin(turn);
      case kind::telegraph: {
        std::mt19937 draw(seed + static_cast<unsigned>(frequency * t + phase) * 7919u +
                          static_cast<unsigned>(axis));
        return most * (2.0 * std::uniform_real_distribution<double>()(draw) - 1.0);
      }
      case kind::pumps:
        return v > 0.0 ? most : -most;
      case kind::kneads:
        return stiffness * (bias + amplitude * std::sin(turn) - x) +
               damping * (amplitude * 2.0 * std::numbers::pi * frequency * std::cos(turn) - v);
      case kind::turns_at:
        return x > bias ? -most : most;
    }
    return 0.0;
  }
};

/// One of these hands, of at most `most` newtons.
template <class Space>
[[nodiscard]] drawn_hand<Space> draw_hand(std::mt19937& from, double most) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  drawn_hand<Space> h;
  h.does = static_cast<typename drawn_hand<Space>::kind>(from() % 6);
  h.most = most;
  h.frequency = std::pow(10.0, 2.4 * unit(from));
  h.bias = -most * unit(from);
  h.amplitude = most - std::abs(h.bias) * unit(from);
  h.phase = unit(from);
  h.across = Space::dof > 1 ? unit(from) : 0.0;
  h.seed = static_cast<unsigned>(from());
  using kind = typename drawn_hand<Space>::kind;
  if (h.does == kind::kneads || h.does == kind::turns_at) {  // these are places, not forces
    h.bias = -5e-3 * unit(from) + 1e-3;
    h.amplitude = 8e-3 * unit(from);
    h.stiffness = std::pow(10.0, 2.0 + 1.5 * unit(from));
    h.damping = 10.0 * unit(from);
  }
  return h;
}

/// The most that the transmission pulls on the rotor, and how fast that changes, while the two ends of its first spring
/// part with no more than `speed` [m/s] (Lemma A, docs/design/mathematics.md § 14).
struct pull_limits {
  double most, slew;  ///< G [N], R [N/s]
};
template <class Space>
[[nodiscard]] pull_limits lemma_a(const sim::compliant_parameters<Space>& p, double hand,
                                  double motors, double speed) {
  const double reduced = p.share * (1.0 - p.share) * p.mass;
  const double n = p.share * hand + (1.0 - p.share) * (motors + p.friction + p.damping * speed);
  const double G = n + (std::sqrt(p.spring_of(0) * reduced) + p.loss_of(0)) * speed;
  return {G, p.spring_of(0) * speed + p.loss_of(0) * (n + G) / reduced};
}

/// The chain as it is, for modelled_reach.
template <int N, class Space>
[[nodiscard]] ph::chain<N> chain_of(const sim::compliant_parameters<Space>& p) {
  ph::chain<N> c;
  c.damping = p.damping;
  for (int i = 0; i < N; ++i) {
    const auto at = static_cast<std::size_t>(i);
    c.masses[at] = p.mass_of(i);
    if (i + 1 == N) break;
    c.springs[at] = p.spring_of(i);
    c.losses[at] = p.loss_of(i);
  }
  return c;
}

/// F = K d − B v on the way out, as stiff as it is asked to be: B = 0.6 √(K m), at most 0.3 m/T. What settles by itself,
/// damped_spring, would hide how far a bound goes.
struct bold_spring {
  double mass = 0.1, K = 0.0, B = 0.0;

  void adopt(double stiffness, double T) noexcept {
    K = stiffness;
    B = std::min(0.6 * std::sqrt(K * mass), 0.3 * mass / T);
  }
  [[nodiscard]] double force(double depth, double outward) const noexcept {
    return std::max(0.0, K * std::max(depth, 0.0) - B * std::max(outward, 0.0));
  }
  [[nodiscard]] double depth(double force, double outward) const noexcept {
    return force > 0.0 ? (force + B * std::max(outward, 0.0)) / K : 0.0;
  }
};

/// A loop that answers samples.
template <class Space>
using loop_of = std::function<typename Space::vector(const ph::device_sample<Space>&)>;

/// A wall of K below zero along the last axis, behind a bound, k ticks late.
template <class Space, int Late>
[[nodiscard]] loop_of<Space> wall_behind(const auto& bound, const auto& law, double damping,
                                         double K, double motors, double longest_tick) {
  auto port =
      ph::local_model{Space{},
                      ph::followed<ph::half_space<Space>>{},
                      ph::turn_at_once{},
                      law,
                      ph::reduced_energy{.damping = damping},
                      ph::bound_chain{bound, ph::actuator_limit{.most = motors}},
                      ph::late_loop_limits<Late>{
                          .longest_tick = longest_tick, .top_speed = 100.0, .workspace = 100.0}};
  typename Space::vector n = Space::zero();
  Space::component(n, Space::dof - 1) = 1.0;
  const bool taken = port.update({Space::zero(), n, K});
  if (port.check() || !taken)
    ex::complain(std::string("a wall was refused: ") + port.check().parameter);
  return [port](const ph::device_sample<Space>& s) mutable { return port.tick(s).force; };
}

}  // namespace devices
