// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Novint Falcon as a mechanism: its frame, lengths and encoders, and its kinematics.
// All are pure constexpr functions in float or double, and need <cmath> only.
//
//        y up                        legs, seen from the front:  0 top, 1 right, 2 left
//        │   z out, to the user      origin: on the axis, in the plane of the thighs' hinges;
//        │ ╱                         z = 0.1346 m at count 0. NO offset is subtracted: subtract
//        o──── x right               `workspace.centre` yourself if you want one.
//
//   angles    θ = 35° + (5.13/140.8)°·n    of the thighs, from counts n [rad]; holds once homed
//   inverse   p → θ        closed form
//   forward   θ → p        Newton on the closure of the three loops, exact Jacobian, warm start
//   rates     A: θ̇ = A v   and so J = A⁻¹, v = J θ̇
//
// Leg i, turned by φ:   u = x cos φ + y sin φ − r,   v = −x sin φ + y cos φ − s,   U = u + c
//     U = a cos θ1 + L cos θ2     v = b cos θ3 − f
//     z = a sin θ1 + L sin θ2     L = d + e + b sin θ3
// A pose is singular, and refused, where sin θ3 = 0, sin(θ2 − θ1) = 0, or the legs' rows are dependent.
//
// Source: R. E. Stamper, "A three degree of freedom parallel manipulator with only translational degrees of
// freedom", PhD 97-4, University of Maryland 1997, eq. 4.12, with the offset s. The Falcon's open drivers agree on
// the lengths and angles; the maker has published no drawing, and the 35° is approximate.

#include <passive_haptics/falcon/vectors.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// Lengths of each leg [m].
template <real S>
struct link_lengths {
  S thigh = S(0.060);           ///< a
  S parallelogram = S(0.1025);  ///< b
  S grip = S(0.01443);          ///< c, hinge to the middle of the grip
  S hinges = S(0.0225);         ///< d + e, both ends of the parallelogram
  S side = S(-0.025);           ///< f
  S base = S(0.0400);           ///< r, axis to the thigh's hinge
  S offset = S(-0.02309);       ///< s, the same sideways
};
template <real S>
inline constexpr link_lengths<S> links{};

/// sin φ and cos φ of the legs, φ = 105°, −15°, −135°.
template <real S>
inline constexpr std::array<sine_cosine<S>, 3> leg_directions{
    {{S(0.965925826289068286749743L), S(-0.258819045102520762348899L)},
     {S(-0.258819045102520762348899L), S(0.965925826289068286749743L)},
     {S(-0.707106781186547524400844L), S(-0.707106781186547524400844L)}}};

/// Encoder readings, one per leg.
using counts = std::array<int, 3>;

template <real S>
inline constexpr S angle_at_zero = S(35) * pi<S> / S(180);  ///< θ at n = 0 [rad]
template <real S>
inline constexpr S angle_per_count = S(5.13L / 140.8L) * pi<S> / S(180);  ///< [rad]

template <real S>
[[nodiscard]] constexpr angles<S> to_angles(const counts& n) noexcept {
  angles<S> theta;
  for (std::size_t i = 0; i < 3; ++i) theta[i] = angle_at_zero<S> + angle_per_count<S> * S(n[i]);
  return theta;
}

namespace detail {

/// The nearest int, halves away from zero; `exact` must fit an int.
template <real S>
[[nodiscard]] constexpr int nearest(S exact) noexcept {
  return static_cast<int>(exact < S(0) ? exact - S(0.5) : exact + S(0.5));
}

}  // namespace detail

/// The counts nearest to the angles θ [rad], |θ| ≤ π.
template <real S>
[[nodiscard]] constexpr counts to_counts(const angles<S>& theta) noexcept {
  counts n{};
  for (std::size_t i = 0; i < 3; ++i) {
    n[i] = detail::nearest((theta[i] - angle_at_zero<S>) / angle_per_count<S>);
  }
  return n;
}

/// A ball in the best part of the workspace: in it θ stays within −17° and 67°, and cond(A) ≤ 3.1.
template <real S>
struct ball {
  point<S> centre{{S(0), S(0), S(0.125)}};  ///< [m]
  S radius = S(0.040);                      ///< [m]

  [[nodiscard]] constexpr bool contains(const point<S>& p) const noexcept {
    return dot(p - centre, p - centre) <= radius * radius;
  }
};
template <real S>
inline constexpr ball<S> workspace{};

enum class pose_fault : std::uint8_t {
  none,
  not_finite,      ///< an angle or a coordinate is NaN or infinite
  out_of_reach,    ///< the legs are too short, or bent the other way
  no_convergence,  ///< Newton's iteration found no position for these angles
  near_singular,   ///< the position is right, but small forces would need large torques
};

[[nodiscard]] constexpr const char* to_string(pose_fault fault) noexcept {
  constexpr std::array names{"none", "not finite", "out of reach", "no convergence",
                             "near a singular pose"};
  const auto i = static_cast<std::size_t>(fault);
  return i < names.size() ? names[i] : "unknown fault";
}

template <real S>
struct angles_result {
  angles<S> value{};
  pose_fault fault = pose_fault::not_finite;

  [[nodiscard]] explicit constexpr operator bool() const noexcept {
    return fault == pose_fault::none;
  }
};

template <real S>
struct pose_result {
  point<S> position{};  ///< [m]; with a fault, where Newton's iteration ended
  matrix<S> rates{};    ///< A at that position [1/m]
  S condition{};  ///< ‖A‖ ‖A⁻¹‖, Frobenius: 3 at best, between cond₂(A) and 3 cond₂(A)
  int steps = 0;  ///< number of Newton's steps
  pose_fault fault = pose_fault::not_finite;

  [[nodiscard]] explicit constexpr operator bool() const noexcept {
    return fault == pose_fault::none;
  }
};

/// Poses of a larger condition (Frobenius) are refused: at the rim of the workspace two solutions of the closure meet.
template <real S>
inline constexpr S largest_condition = S(12);

namespace detail {

/// sin and cos of θ1, leg by leg.
template <real S>
using thighs = std::array<sine_cosine<S>, 3>;

template <real S>
[[nodiscard]] constexpr thighs<S> thighs_at(const angles<S>& theta) noexcept {
  return {sine_cosine_of(theta[0]), sine_cosine_of(theta[1]), sine_cosine_of(theta[2])};
}

template <real S>
struct leg_coordinates {
  S U, v;  ///< [m]
};

template <real S>
[[nodiscard]] constexpr leg_coordinates<S> in_leg(const point<S>& p, std::size_t i) noexcept {
  const auto [s, c] = leg_directions<S>[i];
  return {p[0] * c + p[1] * s - links<S>.base + links<S>.grip,
          p[1] * c - p[0] * s - links<S>.offset};
}

/// The three legs at a position of the grip, with their thighs at given angles.
template <real S>
struct legs_state {
  matrix<S> gradient;  ///< of closed gaps: (cosθ2, cotθ3, sinθ2) of each leg, turned into the frame
  triple<S, struct gap_kind> gap;  ///< (d² − L²)/(2 L) ≈ d − L [m], d from thigh's end to grip
  triple<S, struct swing_kind> swing;  ///< a sin(θ2 − θ1) [m]:  gradient·ṗ = swing θ̇1
  bool reachable = true;               ///< |v + f| < b on every leg

  /// True if every leg is bent the way a Falcon's is.
  [[nodiscard]] constexpr bool bent_rightly() const noexcept {
    return reachable && swing[0] > S(0) && swing[1] > S(0) && swing[2] > S(0);
  }
  [[nodiscard]] constexpr matrix<S> rates() const noexcept {
    matrix<S> A = gradient;
    for (std::size_t i = 0; i < 3; ++i) {
      for (S& entry : A.row[i].value) entry = entry / swing[i];
    }
    return A;
  }
};

template <real S>
[[nodiscard]] constexpr legs_state<S> legs_at(const point<S>& p, const thighs<S>& thigh) noexcept {
  constexpr auto& l = links<S>;
  legs_state<S> legs;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [U, v] = in_leg(p, i);
    const S cos3 = (v + l.side) / l.parallelogram;
    const S square = (S(1) - cos3) * (S(1) + cos3);
    if (!(square > S(0))) {
      legs.reachable = false;
      continue;
    }
    const S sin3 = kernels::square_root(square);
    const S L = l.hinges + l.parallelogram * sin3;
    const S cos2 = (U - l.thigh * thigh[i].cosine) / L;
    const S sin2 = (p[2] - l.thigh * thigh[i].sine) / L;
    const S cot3 = cos3 / sin3;
    const auto [s, c] = leg_directions<S>[i];
    legs.gradient.row[i] = {{c * cos2 - s * cot3, s * cos2 + c * cot3, sin2}};
    legs.gap[i] = L * (cos2 * cos2 + sin2 * sin2 - S(1)) / S(2);
    legs.swing[i] = l.thigh * (sin2 * thigh[i].cosine - cos2 * thigh[i].sine);
  }
  return legs;
}

}  // namespace detail

/// θ1 = atan2(z, U) − acos(K/(2a√(U² + z²))) [rad],   K = U² + z² + a² − L²,   for each leg at position p [m]
template <real S>
[[nodiscard]] constexpr angles_result<S> inverse(const point<S>& p) noexcept {
  constexpr auto& l = links<S>;
  if (!is_finite(p)) return {};
  angles_result<S> result{{}, pose_fault::none};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [U, v] = detail::in_leg(p, i);
    const S cos3 = (v + l.side) / l.parallelogram;
    if (!(cos3 * cos3 < S(1))) return {{}, pose_fault::out_of_reach};
    const S L = l.hinges + l.parallelogram * kernels::square_root((S(1) - cos3) * (S(1) + cos3));
    const S square = U * U + p[2] * p[2];
    const S cosine =
        (square + l.thigh * l.thigh - L * L) / (S(2) * l.thigh * kernels::square_root(square));
    if (!(cosine * cosine <= S(1))) return {{}, pose_fault::out_of_reach};
    const S sine = kernels::square_root((S(1) - cosine) * (S(1) + cosine));
    result.value[i] = angle_of(p[2] * cosine - U * sine, U * cosine + p[2] * sine);
  }
  return result;
}

/// A [1/m] with θ̇ = A v, for a position [m] and its angles [rad]. It is not finite at a singular pose; the A
/// that forward() returns is checked.
///     A_i = (cosφ cosθ2 sinθ3 − sinφ cosθ3, sinφ cosθ2 sinθ3 + cosφ cosθ3, sinθ2 sinθ3)
///           / (a sinθ3 sin(θ2 − θ1))
template <real S>
[[nodiscard]] constexpr matrix<S> rates(const point<S>& p, const angles<S>& theta) noexcept {
  return detail::legs_at(p, detail::thighs_at(theta)).rates();
}

/// J = A⁻¹ [m]: v = J θ̇.
template <real S>
[[nodiscard]] constexpr matrix<S> jacobian(const matrix<S>& A) noexcept {
  return inverse(A);
}

/// The position at angles θ [rad], by Newton's steps p −= G⁻¹ gap of at most 20 mm each. From the last
/// position as `start` [m] that takes 2 or 3 steps, from the middle of the workspace 6 to 8. An iterate out
/// of reach goes half-way to that middle, and a start out of reach goes there.
template <real S>
[[nodiscard]] constexpr pose_result<S> forward(
    const angles<S>& theta, const point<S>& start = workspace<S>.centre) noexcept {
  constexpr S longest_step = S(0.020);
  constexpr S last_step =  // Newton squares the error, so after this step it is below rounding
      S(0.01) * kernels::square_root(std::numeric_limits<S>::epsilon());
  constexpr int most_steps = 24;

  pose_result<S> pose{.position = is_finite(start) ? start : workspace<S>.centre};
  if (!is_finite(theta)) return pose;
  const auto thigh = detail::thighs_at(theta);
  const auto& middle = workspace<S>.centre;
  point<S>& p = pose.position;
  const auto refuse = [&pose](pose_fault why) {
    pose.fault = why;
    return pose;
  };
  auto legs = detail::legs_at(p, thigh);
  for (bool settled = false; !settled; legs = detail::legs_at(p, thigh)) {
    if (++pose.steps > most_steps) return refuse(pose_fault::no_convergence);
    if (!legs.reachable) {
      p = pose.steps == 1 ? middle : p + S(0.5) * (middle - p);
      continue;
    }
    const auto step = multiply<point<S>>(inverse(legs.gradient), legs.gap);
    const S length = norm(step);
    if (!kernels::is_finite(length)) return refuse(pose_fault::near_singular);
    p = p - (length > longest_step ? longest_step / length : S(1)) * step;
    settled = length <= last_step;
  }
  if (!legs.bent_rightly()) return refuse(pose_fault::out_of_reach);
  pose.rates = legs.rates();
  pose.condition = frobenius_norm(pose.rates) * frobenius_norm(inverse(pose.rates));
  if (!(pose.condition <= largest_condition<S>)) return refuse(pose_fault::near_singular);
  pose.fault = pose_fault::none;
  return pose;
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
