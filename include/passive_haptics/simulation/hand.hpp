// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Hands that push on the simulated device.
// A hand is a force [N], computed `substeps` times per period and held in between, and a mass [kg] on the device.
//
//   no_hand           0                                             the device alone
//   constant_hand     F, at most `limit`                            a steady press
//   impedance_hand    k (x_h − x) + b_h (v_h − v), at most `limit`  a person following a target
//   tapping_hand      ∓ limit·n outside / inside the surface        the worst force-limited hand (A5)
//   stroke            x_h(t): a straight line, evenly or with minimum jerk
//
// A hand that is a velocity source, stronger than any actuator, is prescribed_motion.hpp.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/simulation/components.hpp>

#include <concepts>
#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// force(time [s], position [m], velocity [m/s]) is the force on the device [N]; mass() [kg] moves with it.
template <class H, class Space>
concept hand_for = requires(const H h, const typename physical<Space>::vector v, double t) {
  { h.force(t, v, v) } -> std::same_as<typename physical<Space>::vector>;
  { h.mass() } -> std::same_as<double>;
  { h.check() } -> std::same_as<parameter_fault>;
  requires noexcept(h.force(t, v, v));
  requires noexcept(h.mass());
};

namespace detail {
/// The first number that is not finite and ≥ 0; a limit may be infinite.
[[nodiscard]] constexpr parameter_fault hand_fault(double stiffness, double damping, double mass,
                                                   double limit) noexcept {
  if (!(stiffness >= 0.0 && kernels::is_finite(stiffness))) {
    return {"hand stiffness", stiffness, "finite and ≥ 0 N/m"};
  }
  if (!(damping >= 0.0 && kernels::is_finite(damping))) {
    return {"hand damping", damping, "finite and ≥ 0 N·s/m"};
  }
  if (!(mass >= 0.0 && kernels::is_finite(mass))) return {"hand mass", mass, "finite and ≥ 0 kg"};
  if (!(limit >= 0.0)) return {"hand limit", limit, "≥ 0 N"};
  return {};
}
}  // namespace detail

template <class Space>
struct no_hand {
  using vector = typename physical<Space>::vector;
  [[nodiscard]] constexpr vector force(double /*t*/, const vector& /*x*/,
                                       const vector& /*v*/) const noexcept {
    return physical<Space>::zero();
  }
  [[nodiscard]] constexpr double mass() const noexcept { return 0.0; }
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }
};

template <class Space>
struct constant_hand {
  using vector = typename physical<Space>::vector;

  typename physical<Space>::coordinates push{};            ///< [N]
  double limit = std::numeric_limits<double>::infinity();  ///< most ‖F‖ [N]
  double own_mass = 0.0;                                   ///< [kg]

  [[nodiscard]] constexpr vector force(double /*t*/, const vector& /*x*/,
                                       const vector& /*v*/) const noexcept {
    return clamp_norm<Space>(push, limit);
  }
  [[nodiscard]] constexpr double mass() const noexcept { return own_mass; }
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return detail::hand_fault(0.0, 0.0, own_mass, limit);
  }
};

/// F = k (x_h(t) − x) + b_h (v_h − v), ‖F‖ ≤ limit, with x_h(t) = target + v_h (t − target_time).
/// The caller may move the target at any time. `own_mass` is held rigidly, so the device moves with the
/// apparent mass m_a = m + own_mass. The force is computed every h = T/substeps, so without other damping the hand
/// is stable for k h/2 < b_h < 2 m_a/h: for 200 N/m, 0.1 kg and 50 µs from 0.005 to 4000 N·s/m.
template <class Space>
struct impedance_hand {
  using vector = typename physical<Space>::vector;
  using coordinates = typename physical<Space>::coordinates;

  double stiffness = 200.0;                                ///< k [N/m]
  double damping = 2.0;                                    ///< b_h [N·s/m]
  double limit = std::numeric_limits<double>::infinity();  ///< most ‖F‖ [N]
  double own_mass = 0.0;                                   ///< [kg]
  coordinates target{};                                    ///< x_h [m] at target_time
  coordinates target_velocity{};                           ///< v_h [m/s]
  double target_time = 0.0;                                ///< [s]

  constexpr void aim(const vector& position, const vector& velocity, double time) noexcept {
    target = position;
    target_velocity = velocity;
    target_time = time;
  }

  [[nodiscard]] constexpr vector force(double t, const vector& x, const vector& v) const noexcept {
    const vector v_h = target_velocity;
    const vector x_h = vector(target) + v_h * (t - target_time);
    return clamp_norm<Space>(vector(stiffness * (x_h - x) + damping * (v_h - v)), limit);
  }
  [[nodiscard]] constexpr double mass() const noexcept { return own_mass; }
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return detail::hand_fault(stiffness, damping, own_mass, limit);
  }
};

/// Pushes with `limit` towards the surface through `surface` with unit outward `normal`, and as hard
/// away from it as soon as the device is inside: targeted tapping (docs/design/audit.md A5).
template <class Space>
struct tapping_hand {
  using vector = typename physical<Space>::vector;
  using coordinates = typename physical<Space>::coordinates;

  coordinates surface{};  ///< a point of the surface [m]
  coordinates normal{};   ///< unit, outward
  double limit = 5.0;     ///< ‖F‖ [N]
  double own_mass = 0.0;  ///< [kg]

  [[nodiscard]] constexpr vector force(double /*t*/, const vector& x,
                                       const vector& /*v*/) const noexcept {
    const vector n = normal;
    const double depth = physical<Space>::dot(vector(vector(surface) - x), n);
    return n * (depth > 0.0 ? limit : -limit);
  }
  [[nodiscard]] constexpr double mass() const noexcept { return own_mass; }
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = detail::hand_fault(0.0, 0.0, own_mass, limit)) return fault;
    const double length = physical<Space>::norm(vector(normal));
    if (!(length > 0.999 && length < 1.001)) return {"hand normal", length, "of length 1"};
    if (!kernels::is_finite(limit)) return {"hand limit", limit, "finite"};
    return {};
  }
};

enum class stroke_profile : std::uint8_t {
  even,          ///< constant velocity
  minimum_jerk,  ///< s³ (10 − 15 s + 6 s²), the reaching movement of Flash and Hogan (1985)
};

/// A target that moves from one point to another, and rests before and after.
template <class Space>
struct stroke {
  using vector = typename physical<Space>::vector;
  using coordinates = typename physical<Space>::coordinates;

  coordinates from{};     ///< [m]
  coordinates to{};       ///< [m]
  double start = 0.0;     ///< [s]
  double duration = 1.0;  ///< [s], > 0
  stroke_profile profile = stroke_profile::minimum_jerk;

  [[nodiscard]] constexpr vector position(double t) const noexcept {
    const double s = share(t);
    const bool even = profile == stroke_profile::even;
    const double way = even ? s : s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    return vector(from) + (vector(to) - vector(from)) * way;
  }
  [[nodiscard]] constexpr vector velocity(double t) const noexcept {
    const double s = share(t);
    const bool even = profile == stroke_profile::even;
    const bool moving = t >= start && t < start + duration;
    const double speed = even ? double(moving) : 30.0 * s * s * (1.0 - s) * (1.0 - s);
    return (vector(to) - vector(from)) * (speed / duration);
  }

 private:
  [[nodiscard]] constexpr double share(double t) const noexcept {
    return kernels::smaller(kernels::larger((t - start) / duration, 0.0), 1.0);
  }
};

static_assert(hand_for<no_hand<space<float, 1>>, space<float, 1>>);
static_assert(hand_for<constant_hand<space<float, 1>>, space<float, 1>>);
static_assert(hand_for<impedance_hand<space<float, 1>>, space<float, 1>>);
static_assert(hand_for<tapping_hand<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
