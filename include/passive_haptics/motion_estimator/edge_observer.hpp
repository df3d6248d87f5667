// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A motion estimator for encoders with steps and dry friction (the menu is in last_difference.hpp).

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Estimates x [m] and v [m/s] of each axis from encoders that show only the step [x̂, x̂ + q] it is in. In the tick
/// of an edge the position is known: it is v dt/2 beyond the edge on average. The speed follows from the travel
/// Δx̂ [m] and the time t [s] since the last edge (ours; measured in docs/design/encoders.md):
///     next edge         x = edge + v dt/2    v ← v + g (Δx̂/t − v),   g = max(t/dt, |v| t/q)/4, at most 1
///     same edge back    x = edge + v dt/2    v ← −4/5 min(|v|, 4q/t), v at the last edge: the device turned
///     between edges     x ← x + v dt         up to 2/3 q past the edge, with |v| ≤ q/t
///     none for 100 ms   x → the middle of the step, with a time constant of 200 ms: the device is at rest
///
/// A device that chatters at one edge soon causes no change of force, one at rest costs no energy, and one that
/// moves is given nearly the true force at each edge, which costs the dual ledger least (§ 6). A damper reads |v|
/// less q/(8 dt), and 0 below that, because otherwise its force would change with every edge.
///
/// The contact settles if dry friction c holds the device within a step, K q ≤ 2c. Without friction it hunts
/// between two steps: use mass_observer there. With q = 0 the estimate is that of last_difference.
///
/// A friction that is elastic over p takes no energy from a swing of q + 2p, which may therefore last for ever;
/// but if its spring c/p is stiffer than the wall, friction alone holds the device. So, for 2p > q:
///     two turns within q + 2p     x → the middle of the last two turning points, time constant 50 ms
///     a step beyond them, or no edge for 100 ms     as above
/// The force is then constant under a tremor, which gains no energy from it and drains none from the ledger.
struct edge_observer {
  double quantum{};     ///< q, one step of the position shown [m]
  double presliding{};  ///< p of a friction that is stiffer than the wall, c > K p, else 0 [m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(quantum)) return {"quantum", quantum, "finite and ≥ 0 m"};
    if (!detail::not_negative(presliding)) return {"presliding", presliding, "finite and ≥ 0 m"};
    return {};
  }

  template <port P>
  class on;
};

template <port P>
class edge_observer::on {
 public:
  using scalar = typename P::scalar;
  using vector = typename P::pose;

  struct seen {
    vector position;  ///< [m]
    vector velocity;  ///< [m/s]
    scalar slowest;   ///< taken off every speed, down to zero [m/s]
    [[nodiscard]] constexpr scalar along(const vector& n) const noexcept {
      const scalar v = P::dot(velocity, n);
      const scalar beyond = kernels::larger(kernels::magnitude(v) - slowest, scalar(0));
      return v < scalar(0) ? -beyond : beyond;
    }
  };

  constexpr explicit on(const edge_observer& p) noexcept { set(p); }
  constexpr void set(const edge_observer& p) noexcept {
    quantum_ = detail::number<scalar>(p.quantum);
    presliding_ = detail::number<scalar>(p.presliding);
  }
  [[nodiscard]] constexpr edge_observer parameters() const noexcept {
    return {.quantum = static_cast<double>(quantum_),
            .presliding = static_cast<double>(presliding_)};
  }
  constexpr void reset() noexcept {
    for (auto* zero : {&position_, &velocity_, &at_edge_, &travel_, &since_, &direction_, &low_,
                       &high_, &turns_}) {
      *zero = P::zero();
    }
  }

  [[nodiscard]] constexpr seen estimate(const vector& shown, const vector& travel,
                                        const vector& /*held*/, scalar dt, bool known) noexcept {
    for (int i = 0; i < P::dof; ++i) {
      const scalar step = P::component(shown, i);
      if (known) {
        follow(i, step, P::component(travel, i), dt);
      } else {
        start(i, step);
      }
    }
    return {position_, velocity_, quantum_ / (scalar(8) * dt)};
  }
  [[nodiscard]] constexpr vector position() const noexcept { return position_; }  ///< x [m]

 private:
  using coordinates = typename P::coordinates;
  /// A device that crosses no edge for this time [s] is taken to be at rest.
  static constexpr scalar still = scalar(0.1);

  /// Starts again, at rest in the middle of the step.
  constexpr void start(int i, scalar step) noexcept {
    for (coordinates* zero : {&velocity_, &at_edge_, &travel_, &since_, &direction_, &turns_}) {
      P::component(*zero, i) = scalar(0);
    }
    P::component(low_, i) = P::component(high_, i) = step;
    P::component(position_, i) = step + quantum_ / scalar(2);
  }

  constexpr void follow(int i, scalar step, scalar shown, scalar dt) noexcept {
    scalar& x = P::component(position_, i);
    scalar& v = P::component(velocity_, i);
    scalar& travel = P::component(travel_, i);
    scalar& t = P::component(since_, i);
    scalar& d = P::component(direction_, i);
    travel += shown;
    t += dt;
    const bool crossed = !(kernels::magnitude(travel) < quantum_ / scalar(2));
    if (is_held_by_friction(i, step, crossed)) {
      const scalar middle = (P::component(low_, i) + P::component(high_, i) + quantum_) / scalar(2);
      if (crossed) {
        cross(i, dt);
      } else {
        x += (middle - x) * kernels::smaller(dt / scalar(0.05), scalar(1));
      }
    } else if (crossed) {
      cross(i, dt);
      x = edge(step, d) + d * kernels::smaller(d * v * dt, quantum_) / scalar(2);
      x = within(x, step);
    } else if (t > still) {
      x = within(x, step);
      x += (step + quantum_ / scalar(2) - x) * kernels::smaller(dt / scalar(0.2), scalar(1));
    } else {
      if (t * kernels::magnitude(v) > quantum_) v = v < scalar(0) ? -quantum_ / t : quantum_ / t;
      const scalar ahead = d * (edge(step, d) - x) + quantum_ * scalar(2) / scalar(3);
      x += d * kernels::larger(kernels::smaller(d * v * dt, ahead), scalar(0));
      x = within(x, step);
    }
    if (!kernels::is_finite(x + v)) start(i, step);
  }

  [[nodiscard]] constexpr scalar within(scalar x, scalar step) const noexcept {
    return kernels::clamped(x, step, step + quantum_);
  }

  /// True while the device swings within q + 2p, after two turns. low_ and high_ are the steps of the last turns [m].
  [[nodiscard]] constexpr bool is_held_by_friction(int i, scalar step, bool crossed) noexcept {
    if (!(scalar(2) * presliding_ > quantum_)) return false;
    scalar& low = P::component(low_, i);
    scalar& high = P::component(high_, i);
    scalar& turns = P::component(turns_, i);
    const scalar enough = scalar(2);
    const scalar a_little_more = scalar(1.01);  // than one step, because sums of steps are rounded
    const scalar most = scalar(2) * presliding_ + quantum_ * a_little_more;
    if (!crossed) {
      if (turns < enough) return false;
      if (!(P::component(since_, i) > still)) return true;
      turns = scalar(0);
      P::component(position_, i) = step + quantum_ / scalar(2);
      return false;
    }
    const scalar travel = P::component(travel_, i);
    const scalar d = P::component(direction_, i);
    if (travel * d < scalar(0)) {
      (d < scalar(0) ? low : high) = step - travel;
      turns = high - low <= most ? kernels::smaller(turns + scalar(1), enough) : scalar(0);
    }
    const scalar beyond = kernels::larger(kernels::larger(low - step, step - high), scalar(0));
    if (high - low + beyond > most || beyond > quantum_ * a_little_more) turns = scalar(0);
    return turns >= enough;
  }

  /// Updates v [m/s] in the tick in which the axis crosses an edge.
  constexpr void cross(int i, scalar dt) noexcept {
    scalar& v = P::component(velocity_, i);
    scalar& before = P::component(at_edge_, i);
    scalar& travel = P::component(travel_, i);
    scalar& t = P::component(since_, i);
    scalar& d = P::component(direction_, i);
    const scalar way = kernels::magnitude(travel);
    const scalar now = travel < scalar(0) ? scalar(-1) : scalar(1);
    const scalar many =
        scalar(4);  // steps or ticks since the last edge: an error of one is then small
    if (d != now && way <= quantum_ * scalar(1.5)) {
      v = now * scalar(0.8) * kernels::smaller(kernels::magnitude(before), many * quantum_ / t);
    } else if (d != now || v == scalar(0) || way >= many * quantum_ || t >= many * dt ||
               kernels::magnitude(v) * t >= many * quantum_) {
      v = travel / t;
    } else {
      v += kernels::larger(t / dt, kernels::magnitude(v) * t / quantum_) / many * (travel / t - v);
    }
    before = v;
    travel = t = scalar(0);
    d = now;
  }
  /// The edge [m] by which an axis that moves in that direction has entered the step.
  [[nodiscard]] constexpr scalar edge(scalar step, scalar direction) const noexcept {
    return direction < scalar(0) ? step + quantum_ : step;
  }

  scalar quantum_{}, presliding_{};
  coordinates position_{}, velocity_{};         ///< x [m], v [m/s]
  coordinates at_edge_{}, travel_{}, since_{};  ///< v at the last edge, Δx̂ [m] and t [s] since it
  coordinates direction_{};                     ///< d, ±1; 0 before the first edge
  coordinates low_{}, high_{};                  ///< steps of the last turns [m]
  coordinates turns_{};                         ///< turns within q + 2p so far, at most 2
};

static_assert(motion_estimator_for<edge_observer, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
