// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Kinematics of the Falcon: pure functions, constexpr, float or double, nothing linked but <cmath>.
//
//   inverse   p → θ        closed form
//   forward   θ → p        Newton on the closure of the three loops, exact Jacobian, warm start
//   rates     A: θ̇ = A v   and so J = A⁻¹, v = J θ̇
//
// Leg i, turned by φ:   u = x cos φ + y sin φ − r,   v = −x sin φ + y cos φ − s,   U = u + c
//     U = a cos θ1 + L cos θ2     v = b cos θ3 − f
//     z = a sin θ1 + L sin θ2     L = d + e + b sin θ3
// Singular, and refused, where sin θ3 = 0, sin(θ2 − θ1) = 0, or the legs' rows are dependent.
//
// After R. E. Stamper, "A three degree of freedom parallel manipulator with only translational
// degrees of freedom", PhD 97-4, University of Maryland 1997, eq. 4.12, with the offset s.

#include <passive_haptics/falcon/geometry.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

enum class pose_fault : std::uint8_t {
  none,
  not_finite,      ///< an angle or a coordinate is NaN or infinite
  out_of_reach,    ///< the legs are too short, or bent the other way
  no_convergence,  ///< these angles fit no position that Newton could find
  near_singular,   ///< the position holds, but small forces would need large torques
};

[[nodiscard]] constexpr const char* to_string(pose_fault fault) noexcept {
  switch (fault) {
    case pose_fault::none:
      return "none";
    case pose_fault::not_finite:
      return "not finite";
    case pose_fault::out_of_reach:
      return "out of reach";
    case pose_fault::no_convergence:
      return "no convergence";
    case pose_fault::near_singular:
      return "near a singular pose";
  }
  return "unknown fault";
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
  point<S> position{};  ///< [m]; where Newton gave up, if there is a fault
  matrix<S> rates{};    ///< A there [1/m]
  S condition{};  ///< ‖A‖ ‖A⁻¹‖, Frobenius: 3 at best, between cond₂(A) and 3 cond₂(A)
  int steps = 0;  ///< that Newton took
  pose_fault fault = pose_fault::not_finite;

  [[nodiscard]] explicit constexpr operator bool() const noexcept {
    return fault == pose_fault::none;
  }
};

/// Poses of a larger condition (Frobenius) are refused: at the rim branches meet.
template <real S>
inline constexpr S largest_condition = S(12);

namespace detail {

/// One leg at position p, its thigh at θ1.
template <real S>
struct leg_state {
  std::array<S, 3> gradient;  ///< of the gap: (cosθ2, cotθ3, sinθ2) turned into the frame
  S gap;                      ///< (thigh's end to grip) − L [m], 0 when the loop is closed
  S swing;                    ///< a sin(θ2 − θ1) [m]:  gradient·ṗ = swing θ̇1
  bool reachable;             ///< |v + f| < b
};

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

template <real S>
[[nodiscard]] constexpr leg_state<S> leg_at(const point<S>& p, const sine_cosine<S>& thigh,
                                            std::size_t i) noexcept {
  constexpr auto& l = links<S>;
  const auto [U, v] = in_leg(p, i);
  const S cos3 = (v + l.side) / l.parallelogram;
  const S square = (S(1) - cos3) * (S(1) + cos3);
  if (!(square > S(0))) return {{}, S(0), S(0), false};
  const S sin3 = kernels::square_root(square);
  const S L = l.hinges + l.parallelogram * sin3;
  const S cos2 = (U - l.thigh * thigh.cosine) / L;
  const S sin2 = (p[2] - l.thigh * thigh.sine) / L;
  const S cot3 = cos3 / sin3;
  const auto [s, c] = leg_directions<S>[i];
  return {{c * cos2 - s * cot3, s * cos2 + c * cot3, sin2},
          L * (cos2 * cos2 + sin2 * sin2 - S(1)) / S(2),
          l.thigh * (sin2 * thigh.cosine - cos2 * thigh.sine),
          true};
}

template <real S>
[[nodiscard]] constexpr std::array<sine_cosine<S>, 3> thighs(const angles<S>& theta) noexcept {
  return {sine_cosine_of(theta[0]), sine_cosine_of(theta[1]), sine_cosine_of(theta[2])};
}

/// The three legs together.
template <real S>
struct legs_state {
  matrix<S> gradient;
  triple<S, struct gap_kind> gap, swing;
  bool reachable = true;

  /// Is every leg bent the way a Falcon's is?
  [[nodiscard]] constexpr bool bent_rightly() const noexcept {
    return reachable && swing[0] > S(0) && swing[1] > S(0) && swing[2] > S(0);
  }
  [[nodiscard]] constexpr matrix<S> rates() const noexcept {
    matrix<S> A = gradient;
    for (std::size_t i = 0; i < 3; ++i) {
      for (S& entry : A.row[i]) entry = entry / swing[i];
    }
    return A;
  }
};

template <real S>
[[nodiscard]] constexpr legs_state<S> legs_at(const point<S>& p,
                                              const std::array<sine_cosine<S>, 3>& thigh) noexcept {
  legs_state<S> legs;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto leg = leg_at(p, thigh[i], i);
    legs.gradient.row[i] = leg.gradient;
    legs.gap[i] = leg.gap;
    legs.swing[i] = leg.swing;
    legs.reachable = legs.reachable && leg.reachable;
  }
  return legs;
}

}  // namespace detail

/// θ1 = atan2(z, U) − acos(K/(2a√(U² + z²))),   K = U² + z² + a² − L²      for each leg
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

/// A [1/m] with θ̇ = A v, for a position and the angles that belong to it. Not finite at a singular
/// pose: use what forward() returns, which is checked.
///     A_i = (cosφ cosθ2 sinθ3 − sinφ cosθ3, sinφ cosθ2 sinθ3 + cosφ cosθ3, sinθ2 sinθ3)
///           / (a sinθ3 sin(θ2 − θ1))
template <real S>
[[nodiscard]] constexpr matrix<S> rates(const point<S>& p, const angles<S>& theta) noexcept {
  return detail::legs_at(p, detail::thighs(theta)).rates();
}

/// J = A⁻¹ [m]: v = J θ̇.
template <real S>
[[nodiscard]] constexpr matrix<S> jacobian(const matrix<S>& A) noexcept {
  return inverse(A);
}

/// The position at angles θ. Newton's steps p −= G⁻¹ gap, at most 20 mm each, from `start`, best
/// the last position: 2 or 3 steps then, 6 to 8 from the middle of the workspace. An iterate out of
/// reach goes half-way to that middle, a start out of reach to it.
template <real S>
[[nodiscard]] constexpr pose_result<S> forward(
    const angles<S>& theta, const point<S>& start = workspace<S>.centre) noexcept {
  constexpr S longest_step = S(0.020);
  constexpr S last_step =  // Newton squares the error: what is left is below rounding
      S(0.01) * kernels::square_root(std::numeric_limits<S>::epsilon());
  constexpr int most_steps = 24;

  pose_result<S> pose{.position = is_finite(start) ? start : workspace<S>.centre};
  if (!is_finite(theta)) return pose;
  const auto thigh = detail::thighs(theta);
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
