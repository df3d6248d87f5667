// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy bounding algorithm (EBA): the force changes by no more than the damper pays for.
// The energy that the force could give out later is reserved as that of a spring, f²/(2 c2) [J]. The bound
// keeps no ledger and uses the last force and the last displacement only.
//
//   energy_bounding        f − f_held bounded, |f|² bounded   the published window: a wall has at most b/T
//                                                             [N/m], and the force falls no faster, either
//   tight_energy_bounding  the two bounds as one              twice as stiff, and the force falls at once;
//                                                             with c2 = 2b/T it is memoryless_bound
//
// Both are here for comparison with the literature: memoryless_bound is simpler and strict_bound gives
// stiffer walls. Neither allows latency.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

namespace detail {
/// The largest share of `force` [N] whose energy f²/(2 c2) the last tick has paid for, c2 in [N/m]:
///     f²/(2 c2) ≤ h²/(2 c2) + Δxᵀ(b/dt)Δx − h·Δx
/// where h² counts up to `promised` [N²] only, for which energy_bounding passes the square of its last command.
template <class Space>
[[nodiscard]] constexpr share<typename Space::scalar> put_aside(const typename Space::vector& force,
                                                                typename Space::scalar c2,
                                                                typename Space::scalar promised,
                                                                const auto& state) noexcept {
  using scalar = typename Space::scalar;
  const scalar before = kernels::smaller(Space::dot(state.held, state.held), promised);
  const scalar credit = before / (scalar(2) * c2) + state.gain();
  const scalar cost = Space::dot(force, force) / (scalar(2) * c2);
  if (cost <= credit) return {scalar(1)};
  return {kernels::strict_scale(credit, cost)};
}
}  // namespace detail

/// The force nearest to the desired one with, h being the force held over the last tick,
///     (h − f)·Δx ≤ min(c1 ‖Δx‖², Δxᵀ(b/dt)Δx)       and       ‖f + c2 Δx‖² ≤ ‖h‖² + c2² ‖Δx‖²
/// They are a half-space and a ball in any number of dimensions (§ 2(b), with the proof). In one
/// dimension, with F = −f the reaction, they are the published window (Kim, Ryu, 2004 and 2010; law
/// from memory) multiplied through by Δx:
///     F = F_held + β Δx,    γ_min ≤ β ≤ min(c1, γ_max),    γ = c2 − r ∓ √(c2² + r²),  r = F_held/Δx
/// At Δx = 0 the published law freezes the force; here the limit of the window holds, |f| ≤ |h|, with
/// the same proof. The published algorithm bounds each axis by itself; the vector form is ours.
///
/// E ≥ ‖f‖²/(2 c2), which for c2 ≤ b/T is twice the worst outflow of f in the next tick. So zero force is always
/// safe, too, and a tick of up to 2 longest_tick, or a held force of up to √2 times the command, breaks nothing.
/// A force held beyond the command is given no credit, so a motor that is a little too strong cannot wind the
/// force up. Otherwise it makes the assumptions of memoryless_bound; the direction of the held force is free. Its
/// cost: a wall has a stiffness of b/T [N/m] at most, half that of the others, and the bound does NOT only reduce.
/// While the device moves out, the force falls by at most c1 per metre, so it persists for some way after
/// the contact is lost. The bound starts no force of its own, and a force that is no longer desired ends at once
/// if the device stops or turns back, after a lost sample and after a late tick.
struct energy_bounding {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.needs_ledger = true};

  double slope = kernels::largest<double>();    ///< c1 [N/m], > 0; above b/dt, b/dt counts
  double storage = kernels::largest<double>();  ///< c2 [N/m], > 0; above c1 or b/T, those count

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(slope)) return {"slope", slope, "finite and > 0 N/m"};
    if (!detail::positive(storage)) return {"storage", storage, "finite and > 0 N/m"};
    return {};
  }
  template <port Space>
  class on;
};

template <port Space>
class energy_bounding::on {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::effort;
  static_assert(detail::has_geometry<Space>,
                "passive_haptics: energy_bounding measures lengths in a space: joints need "
                "strict_bound");

  constexpr explicit on(const energy_bounding& p) noexcept { set(p); }
  constexpr void set(const energy_bounding& p) noexcept {
    slope_ = detail::number<scalar>(p.slope);
    storage_ = detail::number<scalar>(p.storage);
  }
  [[nodiscard]] constexpr energy_bounding parameters() const noexcept {
    return {.slope = static_cast<double>(slope_), .storage = static_cast<double>(storage_)};
  }
  constexpr void reset() noexcept { last_squared_ = kernels::largest<scalar>(); }

  [[nodiscard]] constexpr vector limit(const vector& desired, const auto& state) noexcept {
    vector force = Space::zero();
    if (state.fate() == tick_fate::on_time) {
      const scalar B = detail::least_damping<Space>(state.damping) / state.longest_tick;
      const scalar c2 = kernels::smaller(storage_, kernels::smaller(slope_, B));
      const vector closest = nearest(desired, c2, state);
      const auto left = detail::put_aside<Space>(closest, c2, last_squared_, state);
      force = left.factor == scalar(1) ? closest : vector(closest * left.factor);
    }
    last_squared_ = Space::dot(force, force);
    return force;
  }

 private:
  /// Projects `desired` on the ball; if that is outside the half-space, on the disc in which the two meet.
  [[nodiscard]] constexpr vector nearest(const vector& desired, scalar c2,
                                         const auto& state) const noexcept {
    const vector held = state.held;
    const vector travel = state.travel;
    const scalar square = Space::dot(travel, travel);
    const vector centre = travel * -c2;
    const scalar radius_squared = Space::dot(held, held) + c2 * c2 * square;
    const vector free = in_ball(desired, centre, radius_squared);

    const scalar paid =
        kernels::smaller(slope_ * square, state.damping.dissipated(travel, state.dt));
    const auto beyond = [&](const vector& f) {
      return Space::dot(vector(held - f), travel) - paid;
    };
    if (!(beyond(free) > scalar(0)) || !(square > scalar(0))) return free;

    const vector middle = centre + travel * (beyond(centre) / square);
    const vector on_plane = desired + travel * (beyond(desired) / square);
    const vector aside = middle - centre;
    return in_ball(on_plane, middle, radius_squared - Space::dot(aside, aside));
  }

  [[nodiscard]] static constexpr vector in_ball(const vector& f, const vector& centre,
                                                scalar radius_squared) noexcept {
    const vector out = f - centre;
    const scalar square = Space::dot(out, out);
    if (square <= radius_squared) return f;
    if (!(radius_squared > scalar(0))) return centre;
    return centre + out * kernels::square_root(radius_squared / square);
  }

  scalar slope_{}, storage_{};
  scalar last_squared_ = kernels::largest<scalar>();  ///< |f|² of the last command [N²]
};

/// ‖f‖² ≤ ‖h‖² + 2 c2 (Δxᵀ(b/dt)Δx − h·Δx), the direction kept: the sum of the two inequalities of
/// energy_bounding, so that the surplus of one counts for the other (§ 2(b), ours). With c2 = 2b/T and
/// isotropic damping it is memoryless_bound; a smaller c2 gives a softer wall, of c2 [N/m]. E ≥ ‖f‖²/(2 c2).
///
/// It makes the assumptions of memoryless_bound; the direction of the held force is free.
struct tight_energy_bounding {
  static constexpr guarantee passivity = guarantee::strict;
  static constexpr bound_traits traits{.needs_ledger = true};

  double storage = kernels::largest<double>();  ///< c2 [N/m], > 0; above 2b/T, 2b/T counts

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (detail::positive(storage)) return {};
    return {"storage", storage, "finite and > 0 N/m"};
  }

  template <port Space>
  class on {
   public:
    using scalar = typename Space::scalar;
    static_assert(detail::has_geometry<Space>,
                  "passive_haptics: tight_energy_bounding measures lengths in a space: joints need "
                  "strict_bound");

    constexpr explicit on(const tight_energy_bounding& p) noexcept
        : storage_(detail::number<scalar>(p.storage)) {}
    [[nodiscard]] constexpr tight_energy_bounding parameters() const noexcept {
      return {static_cast<double>(storage_)};
    }
    [[nodiscard]] constexpr share<scalar> limit(const typename Space::effort& desired,
                                                const auto& state) const noexcept {
      if (state.fate() != tick_fate::on_time) return {scalar(0)};
      const scalar B = detail::least_damping<Space>(state.damping) / state.longest_tick;
      return detail::put_aside<Space>(desired, kernels::smaller(storage_, scalar(2) * B),
                                      kernels::largest<scalar>(), state);
    }

   private:
    scalar storage_;
  };
};

static_assert(force_bound_for<energy_bounding, space<float, 1>>);
static_assert(force_bound_for<tight_energy_bounding, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
