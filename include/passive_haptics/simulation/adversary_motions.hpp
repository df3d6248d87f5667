// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motions that try to draw energy out of a controller; the menu is in adversary.hpp.
// They drive prescribed_motion, which no force can stop.

#include <passive_haptics/simulation/schedule.hpp>

#include <concepts>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// All that an adversary knows when it chooses its move, the force that will be held during that move included.
template <class Space>
struct adversary_view {
  using vector = typename physical<Space>::vector;
  vector position;        ///< [m]
  vector normal;          ///< unit, outward
  double depth;           ///< depth in the true surface [m], > 0 inside
  vector force;           ///< the force that will be held while it moves [N]
  double dt = 1e-3;       ///< length of the move [s]
  double damping = 0.03;  ///< b of the device [N·s/m]

  /// The ways [m], ≥ 0, along each axis, down and up, that the sensors do not show: they end where the encoder's step
  /// or the band of the noise ends.
  typename physical<Space>::coordinates room_below{}, room_above{};
  double presliding = 0.0;  ///< p of the device's friction [m]

  /// The energy [J] that a move to `next` [m] would book at the port, < 0 if it draws some. Where there is a
  /// device, it computes that exactly, with the memory of its friction.
  [[nodiscard]] double price(const vector& next) const noexcept {
    if (ask != nullptr) return ask(device, next);
    const vector step = next - position;
    return damping * physical<Space>::dot(step, step) / dt - physical<Space>::dot(force, step);
  }
  const void* device = nullptr;
  double (*ask)(const void* device, const vector& next) = nullptr;
};

/// next(view, random) is the position [m] to go to within view.dt [s].
template <class M, class Space>
concept adversary_for = requires(M m, const adversary_view<Space> view, random_source random) {
  { m.next(view, random) } -> std::same_as<typename physical<Space>::vector>;
  requires noexcept(m.next(view, random));
};

template <class Space>
struct nyquist_motion {
  using vector = typename physical<Space>::vector;
  double amplitude = 1e-3;  ///< δ [m]
  bool inside = false;

  [[nodiscard]] vector next(const adversary_view<Space>& view, random_source& /*random*/) noexcept {
    inside = !inside;
    return view.position + view.normal * (inside ? -amplitude : amplitude);
  }
};

template <class Space>
struct random_walk {
  using vector = typename physical<Space>::vector;
  double speed = 0.5;   ///< largest speed [m/s]
  double range = 2e-3;  ///< distance from the surface at which it turns back [m]

  [[nodiscard]] vector next(const adversary_view<Space>& view,
                            random_source& random) const noexcept {
    vector way = random.direction<Space>();
    const double outward = physical<Space>::dot(way, view.normal);
    if (view.depth * outward < 0.0 && std::abs(view.depth) > range) way = -way;
    return view.position + way * (random.uniform() * speed * view.dt);
  }
};

/// Takes the move of the largest gain f·Δx − b ‖Δx‖²/dt [J], which is at Δx = f dt/(2b), shortened to
/// `speed`·dt. The gain grows on the whole way to that Δx, so a shortened move gains, too. It
/// presses in the share `press` of the ticks, and whenever the force is zero.
template <class Space>
struct greedy_motion {
  using vector = typename physical<Space>::vector;
  double speed = 0.5;  ///< largest speed [m/s]
  double press = 0.5;  ///< share of the ticks spent pressing, 0 to 1

  [[nodiscard]] vector next(const adversary_view<Space>& view,
                            random_source& random) const noexcept {
    const double farthest = speed * view.dt;
    const bool nothing_to_gain = !(physical<Space>::dot(view.force, view.force) > 0.0);
    if (random.chance(press) || nothing_to_gain) {
      return view.position - view.normal * farthest;
    }
    const vector best = view.force * (view.dt / (2.0 * view.damping));
    return view.position + clamp_norm<Space>(best, farthest);
  }
};

/// Rocks by a thousandth of a quantum across an edge of the encoder steps, outside the surface: a ledger
/// of floored positions books b q²/dt [J] for that on every axis and tick, though the device hardly moves.
/// Then it spends that false credit as greedy_motion does, and comes back.
template <class Space>
struct rocking_motion {
  using vector = typename physical<Space>::vector;
  double quantum = 60e-6;  ///< q of the encoders [m], > 0
  double speed = 0.5;      ///< [m/s]
  bool rocking = false;
  bool above = false;
  int ticks_left = 0;

  [[nodiscard]] vector next(const adversary_view<Space>& view, random_source& random) noexcept {
    if (ticks_left-- <= 0) {
      rocking = !rocking;
      ticks_left =
          static_cast<int>(rocking ? random.uniform(20.0, 120.0) : random.uniform(2.0, 12.0));
    }
    const greedy_motion<Space> greedy{.speed = speed};
    if (!rocking) return greedy.next(view, random);
    if (view.depth > -2.0 * quantum) {
      const double way = view.depth + 4.0 * quantum;
      return view.position + view.normal * kernels::smaller(way, speed * view.dt);
    }
    above = !above;
    vector there = view.position;
    for (int i = 0; i < Space::dof; ++i) {
      const double edge = std::round(component(there, i) / quantum) * quantum;
      component(there, i) = edge + (above ? 1e-3 : -1e-3) * quantum;
    }
    return there;
  }
};

/// Acts for 1 to 40 ticks as one of the other motions, with a random amplitude or speed, then as another. One of its
/// kinds presses, and leaves by up to four times the worst Δx of lemma L3, for bounds that are tight at that only.
template <class Space>
struct restless_motion {
  using vector = typename physical<Space>::vector;
  double quantum = 60e-6;  ///< q of the encoders, or any small length [m], > 0
  double farthest = 2e-3;  ///< longest step by the worst Δx [m]
  int kind = 0;
  int ticks_left = 0;
  double share = 1.0;  ///< factor of the motion's amplitude, speed or multiple, 0 to 1
  nyquist_motion<Space> tapping{};
  rocking_motion<Space> rocking{};

  [[nodiscard]] vector next(const adversary_view<Space>& view, random_source& random) noexcept {
    if (ticks_left-- <= 0) {
      kind = static_cast<int>(random.uniform(0.0, 5.0));
      ticks_left = static_cast<int>(random.uniform(1.0, 40.0));
      share = random.uniform();
    }
    switch (kind) {
      case 0:
        tapping.amplitude = share * 1e-3;
        return tapping.next(view, random);
      case 1:
        return random_walk<Space>{.speed = share}.next(view, random);
      case 2:
        return greedy_motion<Space>{.speed = share, .press = 0.4}.next(view, random);
      case 3:
        rocking.quantum = quantum;
        return rocking.next(view, random);
      default:
        break;
    }
    if (random.chance(0.5)) return view.position - view.normal * (share * farthest);
    const vector worst = view.force * (view.dt / (2.0 * view.damping));
    return view.position + clamp_norm<Space>(vector(worst * (4.0 * share)), farthest);
  }
};

static_assert(adversary_for<nyquist_motion<space<float, 1>>, space<float, 1>>);
static_assert(adversary_for<random_walk<space<float, 1>>, space<float, 1>>);
static_assert(adversary_for<greedy_motion<space<float, 1>>, space<float, 1>>);
static_assert(adversary_for<rocking_motion<space<float, 1>>, space<float, 1>>);
static_assert(adversary_for<restless_motion<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
