// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The motion estimator that goes with crossed_step: its position changes at edges, where the ledger knows the device.

#include <passive_haptics/motion_estimator/edge_observer.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {

/// Estimates x [m] of each axis from encoders that show only the step [x̂, x̂ + q] it is in; v [m/s] is that of
/// edge_observer, and so is x while the edges come every other tick or faster.
///     an edge after one in the same direction     x = x̂ + q/2, the middle of the step
///     the first edge back                         x as before, brought within the step: it is then at that edge
///     none for 100 ms after that                  x → the middle, with a time constant of 200 ms
/// The play of one edge lets a device that chatters there, or bounces by its presliding, feel a force that stays. A
/// position that moved between edges would change the force where the ledger knows a step only (ours; measured in
/// docs/design/encoders.md). For 2p ≤ q, because it does not rest within the presliding p, as edge_observer does.
struct middle_observer {
  double quantum{};            ///< q, one step of the position shown [m]
  double presliding{};         ///< as that of an edge_observer, if the position is its own [m]
  bool between_edges = false;  ///< true: the position is that of edge_observer at any speed

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return edge_observer{quantum, presliding}.check();
  }
  template <port P>
  class on;
};

template <port P>
class middle_observer::on {
  using moving = edge_observer::on<P>;

 public:
  using scalar = typename P::scalar;
  using vector = typename P::pose;
  using seen = typename moving::seen;

  constexpr explicit on(const middle_observer& p) noexcept
      : moving_({p.quantum, p.presliding}), between_edges_(p.between_edges) {
    reset();
  }
  constexpr void set(const middle_observer& p) noexcept {
    moving_.set({p.quantum, p.presliding});
    between_edges_ = p.between_edges;
  }
  [[nodiscard]] constexpr middle_observer parameters() const noexcept {
    const auto [q, p] = moving_.parameters();
    return {q, p, between_edges_};
  }
  constexpr void reset() noexcept {
    moving_.reset();
    axes_ = {};
    position_ = P::zero();
  }

  [[nodiscard]] constexpr seen estimate(const vector& shown, const vector& travel,
                                        const vector& held, scalar dt, bool known) noexcept {
    seen s = moving_.estimate(shown, travel, held, dt, known);
    if (between_edges_) {
      position_ = s.position;
      return s;
    }
    const auto q = detail::number<scalar>(moving_.parameters().quantum);
    for (int i = 0; i < P::dof; ++i) {
      axis& a = axes_[static_cast<std::size_t>(i)];
      if (!known) a = {};
      scalar& x = P::component(s.position, i);
      const scalar step = P::component(shown, i), middle = step + q / scalar(2);
      const scalar way = known ? scalar(P::component(travel, i)) : scalar(0);
      const bool crossed = !(kernels::magnitude(way) < q / scalar(2));
      a.since += dt;
      const bool lately = a.since < scalar(2.5) * dt;
      if (crossed) {
        const int direction = way < scalar(0) ? -1 : 1;
        a.goes_on = direction == a.direction;
        a.direction = direction;
        a.is_fast = lately;
        a.since = scalar(0);
      } else if (!lately) {
        a.is_fast = false;
      }
      if (!a.is_fast && a.goes_on) {
        x = middle;
      } else if (!a.is_fast) {
        x = kernels::clamped(scalar(P::component(position_, i)), step, step + q);
        if (a.since > still) x += (middle - x) * kernels::smaller(dt / scalar(0.2), scalar(1));
      }
    }
    position_ = s.position;
    return s;
  }
  [[nodiscard]] constexpr vector position() const noexcept { return position_; }  ///< x [m]

 private:
  static constexpr scalar still = scalar(0.1);  ///< [s]
  struct axis {
    int direction = 0;     ///< of the last edge, ±1
    scalar since = still;  ///< time since then [s]
    bool goes_on = true;   ///< that edge was not the first one back
    bool is_fast = false;  ///< edges come every other tick or faster
  };
  moving moving_;
  bool between_edges_ = false;
  std::array<axis, static_cast<std::size_t>(P::dof)> axes_{};
  typename P::coordinates position_{};  ///< x [m]
};

static_assert(motion_estimator_for<middle_observer, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
