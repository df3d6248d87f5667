// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Encoder steps that are known better where they are crossed, for a dual_ledger of a device of known mass.
//
//     ph::crossed_ledger{.damping = {.coefficient = 1.1, .coulomb = 0.17, .presliding = 5e-6},
//                        .quantum = {.quantum = 57e-6, .mass = 1.33, .hand_force = 5.3}}
//
// It pays for wheels, knobs and heavy devices (docs/design/encoders.md).

#include <passive_haptics/device/dry_friction.hpp>
#include <passive_haptics/energy_observer/dual_ledger.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <array>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// A step q as of encoder_step, and what limits the acceleration. In the tick in which an edge is crossed the device is
/// between that edge and d beyond it. With y₀ = q − |Δx̂| before the edge and top = q + the way shown since, for each
/// sample since, τ₀ the length of the tick of the crossing and τ the time since [s],
///     d ≤ (τ y₀ + τ₀ top)/(τ₀ + τ) + ½ α τ₀ τ,     α = (F − f)/m,  F = hand_force + 2 (b/dt)(|Δx̂| + q)
/// f the force held, along the crossing; in more than one dimension F + |f|. A change of force s [N] there, along the
/// crossing, is charged (d − ½ q) s in place of ½ q s, and the difference is given back as samples come.
/// Proof: docs/design/mathematics.md § 6, Steps that are crossed.
///
/// A motion under a force that leaves no such d refutes mass, hand or acceleration. All that was ever given back is
/// then taken back, and nothing is given back until reset(): the ledger says no more than one that counts on no mass.
///
/// Passive if, beside what the ledger states, all but the motors pushes with at most F, friction included, as
/// reachable_bound has it, on a mass of at least m in every direction, or if |acceleration| is at most as stated.
struct crossed_step {
  static constexpr guarantee passivity = guarantee::conditional;

  double quantum{};     ///< q [m], an upper bound of one step
  double mass{};        ///< m [kg] that moves rigidly with the encoder, least over directions
  double hand_force{};  ///< largest force of all but motors and damper [N]
  double acceleration = std::numeric_limits<double>::infinity();  ///< its largest, if known [m/s²]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = detail::step_fault(quantum)) return fault;
    if (!detail::positive(mass)) return {"mass", mass, "finite and > 0 kg"};
    if (!detail::not_negative(hand_force)) return {"hand_force", hand_force, "finite and ≥ 0 N"};
    if (!(acceleration > 0.0)) return {"acceleration", acceleration, "> 0 m/s²"};
    return {};
  }
  template <class P>
  class on;
};

template <class P>
class crossed_step::on : public encoder_step::on<P> {
  using step = encoder_step::on<P>;
  static constexpr auto dof = static_cast<std::size_t>(P::dof);

 public:
  using typename step::scalar;
  using motion = typename P::motion;
  using effort = typename P::effort;
  static_assert(P::dof == 1 || detail::has_geometry<P>,
                "passive_haptics: crossed_step has one mass for all directions of a space: several "
                "joints need an encoder_step");

  constexpr explicit on(const crossed_step& p) noexcept
      : step(p.quantum),
        mass_(detail::number<scalar>(p.mass)),
        hand_force_(detail::number<scalar>(p.hand_force)),
        acceleration_(detail::number<scalar>(p.acceleration)) {}
  [[nodiscard]] constexpr crossed_step parameters() const noexcept {
    return {.quantum = step::parameters().width,
            .mass = static_cast<double>(mass_),
            .hand_force = static_cast<double>(hand_force_),
            .acceleration = static_cast<double>(acceleration_)};
  }
  /// Changes of u − f, charged with ½ q each newton at the sample of a crossing, that lead beyond the edge [N].
  struct owed {
    std::array<scalar, dof> beyond{};
    [[nodiscard]] constexpr owed charged(const on& steps, const effort& change) const noexcept {
      owed all = *this;
      for (std::size_t i = 0; i < dof; ++i) {
        const scalar s = steps.axes_[i].charged * P::component(change, static_cast<int>(i));
        all.beyond[i] += kernels::larger(s, scalar(0));
      }
      return all;
    }
  };

  /// Takes the motion shown over a tick in which `held` was held, before its changes are charged.
  constexpr void see(const motion& shown, const effort& held, scalar dt,
                     const auto& damping) noexcept {
    if (refuted_) {
      given_ = scalar(0);
      return;
    }
    const scalar moved = length(shown) + this->travel_error();
    const scalar other = hand_force_ + scalar(2) * (detail::most_damping<P>(damping) / dt) * moved;
    const scalar q = this->along_axis(0);
    const bool pressed = !(P::squared(held) == scalar(0));
    if (given_now_ > scalar(0)) {
      given_ = (given_ + given_now_) * (scalar(1) + std::numeric_limits<scalar>::epsilon());
      given_now_ = scalar(0);
    }
    for (std::size_t i = 0; i < dof; ++i) {
      axis& a = axes_[i];
      a.pressed = a.pressed || pressed;
      const scalar way = P::component(shown, static_cast<int>(i));
      const auto against = [&](scalar direction) {  // the largest acceleration that turns it back
        const scalar f = P::dof == 1 ? -direction * P::component(held, 0) : length(held);
        return kernels::smaller(kernels::larger((other + f) / mass_, scalar(0)), acceleration_);
      };
      a.charged = a.crossed ? a.direction : scalar(0);
      a.sharper = scalar(0);
      if (a.samples < most_samples && !refuted_) sharpen(a, way, against(a.direction), dt);
      a.crossed = way != scalar(0);
      if (a.crossed) {
        const scalar direction = way < scalar(0) ? scalar(-1) : scalar(1);
        a.direction = direction;
        a.before = q - direction * way + kernels::rounding<scalar>() * (q + direction * way);
        a.top = a.depth = q;
        a.length = dt;
        a.since = scalar(0);
        a.bent = against(direction);
        a.samples = 0;
        a.pressed = pressed;
      }
    }
    if (refuted_) forget();
  }
  /// What is given back of the charges of a certificate [J]; where the promise turns out to be broken, less than zero,
  /// by all that was given back to any of them.
  [[nodiscard]] constexpr scalar given_back(owed& of) noexcept {
    if (refuted_) return -given_;
    scalar sum(0);
    for (std::size_t i = 0; i < dof; ++i) {
      sum += of.beyond[i] * axes_[i].sharper;
      if (axes_[i].crossed) of.beyond[i] = scalar(0);
    }
    given_now_ = kernels::larger(given_now_, sum);
    return sum - kernels::rounding<scalar>() * kernels::magnitude(sum);
  }
  /// True once a motion under a force was none that mass, hand force and acceleration admit; until reset() or set().
  [[nodiscard]] constexpr bool refuted() const noexcept { return refuted_; }
  /// Gives nothing back from now on of what was charged so far.
  constexpr void forget() noexcept { axes_ = {}; }

 private:
  /// Samples after a crossing that are looked at: later ones know less, and their times add up rounding.
  static constexpr int most_samples = 32;
  struct axis {
    scalar direction{};  ///< of the last crossing, ±1
    scalar before{};     ///< y₀, the nearest to the edge that the device was before it [m]
    scalar top{};        ///< the farthest beyond the edge that it is now [m]
    scalar length{};     ///< τ₀ [s]
    scalar since{};      ///< τ [s]
    scalar bent{};       ///< α, the largest in the ticks so far [m/s²]
    scalar depth{};      ///< d [m]
    scalar sharper{};    ///< by how much this tick has lowered d [m]
    scalar
        charged{};  ///< the direction, if the changes of this tick are at the sample of the crossing
    int samples = most_samples;  ///< since then
    bool crossed = false;        ///< in this tick
    bool pressed = false;        ///< a force was held since the sample before
  };

  [[nodiscard]] static constexpr scalar length(const effort& v) noexcept {
    if constexpr (P::dof == 1)
      return kernels::magnitude(P::component(v, 0));
    else
      return P::norm(v);
  }
  constexpr void sharpen(axis& a, scalar way, scalar against, scalar dt) noexcept {
    ++a.samples;
    const scalar q = this->along_axis(0), inexact = kernels::rounding<scalar>();
    a.top += a.direction * way;
    if (way != scalar(0)) a.top += inexact * (q + kernels::magnitude(way));
    a.since += dt;
    a.bent = kernels::larger(a.bent, against);
    const scalar bend = a.bent * a.length * a.since / scalar(2);
    const scalar chord = (a.since * a.before + a.length * a.top) / (a.length + a.since);
    const scalar next =
        chord + bend +
        scalar(4) * inexact * (kernels::magnitude(a.before) + kernels::magnitude(a.top) + bend);
    if (next < scalar(0)) {  // The promise is broken. Without a force nothing was given on it.
      refuted_ = a.pressed;
      a.samples = most_samples;
    } else if (next < a.depth) {
      a.sharper = a.depth - next;
      a.depth = next;
    }
  }

  scalar mass_, hand_force_, acceleration_;
  /// What was given back until the last tick, to the certificate that got most of it, and in this one [J].
  scalar given_{}, given_now_{};
  bool refuted_ = false;
  std::array<axis, dof> axes_{};
};

using crossed_ledger = basic_dual_ledger<damping_and_friction, crossed_step>;

static_assert(energy_observer_for<crossed_ledger, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
