// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Normal interpolation at a limited rate (the menu is in turn_at_once.hpp).

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Turns n_LM towards n_VE in their common plane by at most φ = rate·dt (2.28-2.32, A19, A20):
///     |n_VE − n_LM| ≤ chord(φ):   n ← n_VE
///     otherwise:                  n ← n cos φ + t sin φ,   t ∝ (n_VE − n_LM) − ((n_VE − n_LM)·n) n
/// This is Rodrigues' rotation about µ = n_LM × n_VE, without the cross product, so it holds in two
/// dimensions as well; for small angles a chord keeps digits that acos loses. Opposite normals have no
/// common plane, so n then turns towards a fixed direction. The angle is 2 atan(φ/2) ≈ φ − φ³/12 ≤ φ [rad].
struct turn_limited {
  double rate{};  ///< fastest turn of the normal [rad/s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (detail::positive(rate)) return {};
    return {"rate", rate, "finite and > 0 rad/s"};
  }

  template <class Space>
  class on {
   public:
    using scalar = typename Space::scalar;
    using vector = typename Space::vector;

    constexpr explicit on(const turn_limited& p) noexcept : rate_(detail::number<scalar>(p.rate)) {}
    [[nodiscard]] constexpr turn_limited parameters() const noexcept {
      return {static_cast<double>(rate_)};
    }

    [[nodiscard, gnu::always_inline]] constexpr vector step(const vector& from, const vector& to,
                                                            scalar dt) const noexcept {
      return step_by(from, to, rate_ * dt);
    }
    [[nodiscard]] constexpr scalar rate() const noexcept { return rate_; }  ///< [rad/s]
    /// The same with φ = `angle` [rad].
    [[nodiscard, gnu::always_inline]] constexpr vector step_by(
        const vector& from, const vector& to, [[maybe_unused]] scalar angle) const noexcept {
      if constexpr (Space::dof == 1) {
        return to;  // ±1: there is nothing in between
      } else {
        const auto turn = kernels::half_angle_turn(angle);
        const vector chord = to - from;
        const scalar chord_squared = Space::dot(chord, chord);
        if (chord_squared <= turn.chord_squared) return to;
        const vector across = chord - from * Space::dot(chord, from);
        const scalar length = Space::norm(across);
        const bool opposite =
            length < scalar(1) / scalar(1024);  // within 1 mrad of π the plane is rounding only
        const vector tangent = opposite ? Space::orthogonal(from) : vector(across / length);
        const vector turned = from * turn.cosine + tangent * turn.sine;
        return turned / Space::norm(turned);
      }
    }

   private:
    scalar rate_;
  };
};

static_assert(normal_interpolation_for<turn_limited, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
