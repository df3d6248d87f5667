// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Adversaries: motions and environments that try to draw energy out of a controller
// (docs/design/mathematics.md § 5). Motions drive prescribed_motion, which no force can stop.
//
//   nyquist_motion        in by δ, out by δ: −(K − 2B) δ² per two ticks from an unbounded wall (A5)
//   random_walk           any direction at any speed up to a limit, near the surface
//   greedy_motion         presses, then leaves by the Δx that the proof calls worst (L3)
//   jumping_surface       the surface moves by up to ±2 mm every 20-50 ms
//   switching_stiffness   K low, K high, K low, ... every 20-50 ms
//
//     motion.move_to(adversary.next({x, normal, depth, force, dt, b}, random));
//     sample = motion.exchange(force);

#include <passive_haptics/simulation/schedule.hpp>

#include <concepts>

namespace passive_haptics::inline v0::simulation {

/// All an adversary knows when it moves. It sees the force before it has to.
template <class Space>
struct adversary_view {
  using vector = typename physical<Space>::vector;
  vector position;        ///< [m]
  vector normal;          ///< unit, outward
  double depth;           ///< in the true surface [m], > 0 inside
  vector force;           ///< that will be held while it moves [N]
  double dt = 1e-3;       ///< length of the move [s]
  double damping = 0.03;  ///< b of the device [N·s/m]
};

/// next(view, random): where to go within view.dt [m].
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
  double speed = 0.5;   ///< [m/s]
  double range = 2e-3;  ///< farther than this from the surface it turns back [m]

  [[nodiscard]] vector next(const adversary_view<Space>& view,
                            random_source& random) const noexcept {
    vector way = random.direction<Space>();
    const double outward = physical<Space>::dot(way, view.normal);
    if (view.depth * outward < 0.0 && std::abs(view.depth) > range) way = -way;
    return view.position + way * (random.uniform() * speed * view.dt);
  }
};

/// Gain of a move: f·Δx − b ‖Δx‖²/dt, largest at Δx = f dt/(2b), shortened to what `speed` allows;
/// the gain grows on the whole way there, so staying never beats it. It loads the wall in `press`
/// of the ticks, and whenever nothing pushes back.
template <class Space>
struct greedy_motion {
  using vector = typename physical<Space>::vector;
  double speed = 0.5;  ///< [m/s]
  double press = 0.5;  ///< share of the ticks spent pressing

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

/// Where the surface has jumped to, along its normal [m].
class jumping_surface {
 public:
  constexpr explicit jumping_surface(double amplitude = 2e-3, std::uint64_t seed = 1) noexcept
      : amplitude_(amplitude), schedule_(seed), random_(~seed) {}
  [[nodiscard]] constexpr double offset(double time) noexcept {
    if (schedule_.due(time)) offset_ = random_.uniform(-amplitude_, amplitude_);
    return offset_;
  }

 private:
  double amplitude_;
  double offset_ = 0.0;
  update_schedule schedule_;
  random_source random_;
};

/// The stiffness of the moment [N/m].
class switching_stiffness {
 public:
  constexpr switching_stiffness(double low, double high, std::uint64_t seed = 1) noexcept
      : now_(high), other_(low), schedule_(seed) {}
  [[nodiscard]] constexpr double stiffness(double time) noexcept {
    if (schedule_.due(time)) std::swap(now_, other_);
    return now_;
  }

 private:
  double now_, other_;
  update_schedule schedule_;
};

static_assert(adversary_for<nyquist_motion<space<float, 1>>, space<float, 1>>);
static_assert(adversary_for<random_walk<space<float, 1>>, space<float, 1>>);
static_assert(adversary_for<greedy_motion<space<float, 1>>, space<float, 1>>);

}  // namespace passive_haptics::inline v0::simulation
