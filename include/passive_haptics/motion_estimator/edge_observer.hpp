// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A motion estimator for encoders with steps and dry friction (the menu is in last_difference.hpp).

#include <passive_haptics/port/concepts.hpp>

#include <array>

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
    for (axis& a : axes_) a.turns = rests() ? a.turns : 0;
  }
  [[nodiscard]] constexpr edge_observer parameters() const noexcept {
    return {.quantum = static_cast<double>(quantum_),
            .presliding = static_cast<double>(presliding_)};
  }
  constexpr void reset() noexcept {
    axes_ = {};
    position_ = velocity_ = P::zero();
  }

  [[nodiscard]] constexpr seen estimate(const vector& shown, const vector& travel,
                                        const vector& /*held*/, scalar dt, bool known) noexcept {
    scalar sum(0);
    if (known) {
      for (int i = 0; i < P::dof; ++i) {
        follow(i, P::component(shown, i), P::component(travel, i), dt);
        sum += P::component(position_, i) + P::component(velocity_, i);
      }
    }
    if (!known || !kernels::is_finite(sum)) [[unlikely]] {
      for (int i = 0; i < P::dof; ++i) start(i, P::component(shown, i));
    }
    return {position_, velocity_, quantum_ / (scalar(8) * dt)};
  }
  [[nodiscard]] constexpr vector position() const noexcept { return position_; }  ///< x [m]

 private:
  using coordinates = typename P::coordinates;
  /// A device that crosses no edge for this time [s] is taken to be at rest.
  static constexpr scalar still = scalar(0.1);

  struct axis {
    scalar travel{};  ///< Δx̂ since the last edge [m]
    scalar d{};       ///< the direction through it, ±1, which v has, too; 0 before the first edge
    scalar t{};       ///< the time since it [s]
    scalar speed{};   ///< |v| at it [m/s]
    scalar low{}, high{};  ///< steps of the last turns [m]
    int turns{};           ///< turns within q + 2p so far, at most 2
  };

  /// Starts again, at rest in the middle of the step.
  constexpr void start(int i, scalar step) noexcept {
    axis& a = axes_[static_cast<std::size_t>(i)];
    a = {};
    a.low = a.high = step;
    P::component(position_, i) = middle(step);
    P::component(velocity_, i) = scalar(0);
  }

  constexpr void follow(int i, scalar step, scalar shown, scalar dt) noexcept {
    axis& a = axes_[static_cast<std::size_t>(i)];
    scalar& x = P::component(position_, i);
    scalar& v = P::component(velocity_, i);
    a.travel += shown;
    a.t += dt;
    if (!(kernels::magnitude(a.travel) < quantum_ / scalar(2))) {
      const scalar now = a.travel < scalar(0) ? scalar(-1) : scalar(1);
      const bool held = rests() && swings(a, now, step);
      v = now * speed_at_edge(a, now, kernels::magnitude(v), dt);
      a = {scalar(0), now, scalar(0), kernels::magnitude(v), a.low, a.high, a.turns};
      const scalar ahead = kernels::smaller(a.speed * dt, quantum_);
      if (!held) x = step + (quantum_ - now * (quantum_ - ahead)) / scalar(2);
    } else if (a.t > still) {
      if (a.turns == 2) x = middle(step);
      a.turns = 0;
      x = kernels::clamped(x, step, step + quantum_);
      x += (middle(step) - x) * kernels::smaller(dt / scalar(0.2), scalar(1));
    } else if (a.turns == 2) {
      x += (middle((a.low + a.high) / scalar(2)) - x) *
           kernels::smaller(dt / scalar(0.05), scalar(1));
    } else {
      if (a.t * kernels::magnitude(v) > quantum_) v = a.d * (quantum_ / a.t);
      const scalar farthest = step + quantum_ * (scalar(0.5) + a.d * scalar(1.0 / 6));
      const scalar way = kernels::smaller(kernels::magnitude(v) * dt, a.d * (farthest - x));
      x += a.d * kernels::larger(way, scalar(0));
      x = kernels::clamped(x, step, step + quantum_);
    }
  }

  [[nodiscard]] constexpr bool rests() const noexcept { return scalar(2) * presliding_ > quantum_; }
  [[nodiscard]] constexpr scalar middle(scalar step) const noexcept {
    return step + quantum_ / scalar(2);
  }

  /// True while the device swings within q + 2p, after two turns, in a tick in which it crosses an edge.
  [[nodiscard]] constexpr bool swings(axis& a, scalar now, scalar step) const noexcept {
    const scalar a_little_more = scalar(1.01);  // than one step, because sums of steps are rounded
    const scalar most = scalar(2) * presliding_ + quantum_ * a_little_more;
    if (now * a.d < scalar(0)) {
      (now > scalar(0) ? a.low : a.high) = step - a.travel;
      a.turns = !(a.high - a.low <= most) ? 0 : a.turns < 2 ? a.turns + 1 : 2;
    }
    const scalar beyond = kernels::larger(kernels::larger(a.low - step, step - a.high), scalar(0));
    if (a.high - a.low + beyond > most || beyond > quantum_ * a_little_more) a.turns = 0;
    return a.turns == 2;
  }

  /// |v| [m/s] in the tick in which the axis crosses an edge in the direction `now`, with `speed` as it was.
  [[nodiscard]] constexpr scalar speed_at_edge(const axis& a, scalar now, scalar speed,
                                               scalar dt) const noexcept {
    const scalar way = kernels::magnitude(a.travel);
    const scalar many(4);  // steps or ticks since the last edge: an error of one is then small
    if (a.d != now && way <= quantum_ * scalar(1.5)) {
      return scalar(0.8) * kernels::smaller(a.speed, many * quantum_ / a.t);
    }
    const scalar mean = way / a.t;
    if (a.d != now || speed == scalar(0) || way >= many * quantum_) return mean;
    const scalar g = kernels::larger(a.t / dt, speed * a.t / quantum_) / many;
    return g < scalar(1) ? speed + g * (mean - speed) : mean;
  }

  scalar quantum_{}, presliding_{};
  coordinates position_{}, velocity_{};  ///< x [m], v [m/s]
  std::array<axis, static_cast<std::size_t>(P::dof)> axes_{};
};

static_assert(motion_estimator_for<edge_observer, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
