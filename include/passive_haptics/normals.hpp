// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Normal interpolation: how fast the contact direction may turn from the local model's to the
// environment's.
//
//   snap             at once                     flat walls, one degree of freedom, comparison
//   rotate_limited   at most `rate` rad/s        everything that deforms or has edges
//
// Not offered: a blend over one update period. It needs to know when the next update comes.

#include <passive_haptics/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// n ← n_VE.
template <class Space>
struct snap {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;  // the ledger meets any direction

  [[nodiscard]] constexpr vector step(const vector& /*from*/, const vector& to,
                                      scalar /*dt*/) const noexcept {
    return to;
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept { return {}; }
};

/// Turns n_LM towards n_VE in their common plane by at most φ = rate·dt (2.28-2.32, A19, A20):
///     |n_VE − n_LM| ≤ chord(φ):   n ← n_VE
///     otherwise:                  n ← n cos φ + t sin φ,   t ∝ (n_VE − n_LM) − ((n_VE − n_LM)·n) n
/// This is Rodrigues' rotation about µ = n_LM × n_VE, without the cross product, so it holds in two
/// dimensions as well; chords keep their digits where acos loses them. Antiparallel normals have no
/// common plane: they turn about a fixed direction. The turn is φ − φ³/12, never above φ.
template <class Space>
struct rotate_limited {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr guarantee passivity = guarantee::strict;

  scalar rate{};  ///< [rad/s]

  [[nodiscard]] constexpr vector step(const vector& from, const vector& to,
                                      scalar dt) const noexcept {
    if constexpr (Space::dof == 1) {
      return to;  // ±1: there is nothing in between
    } else {
      const auto turn = kernels::half_angle_turn(rate * dt);
      const vector chord = to - from;
      const scalar chord_squared = Space::dot(chord, chord);
      if (chord_squared <= turn.chord_squared) return to;
      const vector across = chord - from * Space::dot(chord, from);
      const scalar length = Space::norm(across);
      const bool opposite = length < scalar(1) / scalar(1024);  // within 1 mrad: no plane to trust
      const vector tangent = opposite ? Space::orthogonal(from) : vector(across / length);
      const vector turned = from * turn.cosine + tangent * turn.sine;
      return turned / Space::norm(turned);
    }
  }
  [[nodiscard]] constexpr parameter_fault<scalar> check() const noexcept {
    if (rate > scalar(0) && kernels::is_finite(rate)) return {};
    return {"rate", rate, "finite and > 0 rad/s"};
  }
};

static_assert(normal_interpolation_for<rotate_limited<space<float, 1>>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
