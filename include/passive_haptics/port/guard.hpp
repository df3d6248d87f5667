// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The guard of a port: accepts or rejects a sample, and stores the commanded efforts, so that every motion
// is paired with the effort that was held during it.

#include <passive_haptics/port/concepts.hpp>

#include <array>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// The state of every guard. `Latency` is that of late_loop_limits [ticks].
template <port P, int Latency>
class last_tick {
 public:
  using pose = typename P::pose;
  using effort = typename P::effort;
  using commands = std::array<typename P::stored_effort, static_cast<std::size_t>(Latency) + 1>;

  constexpr last_tick() noexcept { commanded_.fill(P::zero()); }

  /// The position of the last good sample; the origin before the first.
  [[nodiscard]] constexpr pose last() const noexcept { return position_; }
  /// Takes the position of a good sample.
  constexpr void move_to(const pose& position) noexcept { position_ = position; }

  /// The commands that are not over yet, newest first; the last one is held now if the device obeys.
  [[nodiscard]] constexpr const commands& commanded() const noexcept { return commanded_; }
  constexpr void command(const effort& f) noexcept {
    for (std::size_t j = commanded_.size() - 1; j > 0; --j) commanded_[j] = commanded_[j - 1];
    commanded_[0] = f;
  }

 private:
  commands commanded_{};
  typename P::stored_pose position_{};  ///< of the last good sample; the origin before the first
};

/// One per device.
template <port P, int Latency>
class guard : public last_tick<P, Latency> {
 public:
  using scalar = typename P::scalar;
  using pose = typename P::pose;
  using motion = typename P::motion;
  static constexpr bool trusting = false;

  constexpr void reset() noexcept { *this = {}; }

  /// True if there has been a good sample.
  [[nodiscard]] constexpr bool has_seen() const noexcept { return seen_; }

  template <class Limits>
  [[nodiscard, gnu::always_inline]] constexpr bool believes(const pose& position,
                                                            const motion& travel, scalar dt,
                                                            const Limits& limits) const noexcept {
    return is_possible(position, travel, dt, limits.top_speed) &&
           within(position, limits.workspace);
  }
  /// True for a finite sample that is within top_speed · (time since the last good one) of it.
  [[nodiscard, gnu::always_inline]] constexpr bool is_possible(const pose& position,
                                                               const motion& travel, scalar dt,
                                                               scalar top_speed) const noexcept {
    const scalar largest = kernels::largest<scalar>();  // below infinity, and NaN
    if (!(dt > scalar(0))) return false;
    if (!seen_) return dt <= largest && P::is_finite(position);  // there is no travel yet
    const scalar farthest = top_speed * (blind_ + dt);
    const scalar square = P::squared(travel);
    return square + dt <= largest && square <= farthest * farthest;
  }
  /// True if |x| ≤ workspace [m], which finds positions in a wrong unit. It is no rule for joints; poses have place().
  [[nodiscard, gnu::always_inline]] static constexpr bool within(const pose& position,
                                                                 scalar workspace) noexcept {
    if constexpr (requires { P::place(position); }) {
      return P::body_space::squared(P::place(position)) <= workspace * workspace;
    } else if constexpr (detail::has_geometry<P>) {
      return P::squared(position) <= workspace * workspace;
    } else {
      return true;
    }
  }
  /// True if the sample before this one was good, so that the motion between them is known.
  [[nodiscard]] constexpr bool knows_motion() const noexcept {
    return seen_ && !(blind_ > scalar(0));
  }
  /// Notes a good sample, which may be the first or the first after bad ones.
  constexpr void see_again() noexcept {
    seen_ = true;
    blind_ = scalar(0);
  }
  /// Notes a bad sample, `passed` [s] after the one before.
  constexpr void lose_sight(scalar passed) noexcept { blind_ += passed; }
  /// The time of the bad samples since the last good one [s].
  [[nodiscard]] constexpr scalar blind() const noexcept { return blind_; }

 private:
  scalar blind_{};     ///< time of the bad samples since the last good one [s]
  bool seen_ = false;  ///< there has been a good sample
};

/// A guard that accepts every sample, one per device, for trusted_loop_limits.
template <port P, int Latency>
class trusting_guard : public last_tick<P, Latency> {
 public:
  static constexpr bool trusting = true;

  constexpr void reset() noexcept { *this = {}; }
  [[nodiscard]] constexpr bool has_seen() const noexcept { return seen_; }
  [[nodiscard]] constexpr bool knows_motion() const noexcept { return seen_; }
  constexpr void see_again() noexcept { seen_ = true; }
  /// Notes a sample that was not finite; the motion to the next one is unknown.
  constexpr void lose_sight(typename P::scalar /*passed*/) noexcept { seen_ = false; }

 private:
  bool seen_ = false;
};

/// Tests a sample against the motion before it, with a bound that limits accelerations. far_off(T₀, t, v) [m] is the
/// largest distance from x + V t at a time t [s] after a motion of T₀ [s], v [m/s] the sum of the mean speeds of both.
/// Each rejected sample doubles the accepted distance, and an outlier restores it; a larger distance that was right is
/// kept, and shrinks by 0.2 % per tick. (ours, § 13)
template <port P>
class motion_check {
 public:
  using scalar = typename P::scalar;
  using motion = typename P::motion;

  /// True for a motion so small, in a tick so long, that no test is needed.
  [[nodiscard]] constexpr bool is_calm(scalar square, scalar dt) const noexcept {
    return square <= easy_ && dt >= least_;
  }
  /// True for a motion that differs so little from the last one that no test is needed.
  [[nodiscard]] constexpr bool is_easy(const motion& travel) const noexcept {
    return P::squared(P::difference(travel, motion(travel_))) <= easy_;
  }
  /// True if the travel is within the accepted distance, `t` [s] after the last good sample.
  [[nodiscard]] constexpr bool is_possible(const motion& travel, scalar t,
                                           const auto& far_off) const noexcept {
    return !(off(travel, t, far_off) > width_);
  }
  [[nodiscard]] constexpr bool judge(const motion& travel, scalar t, const auto& far_off) noexcept {
    const scalar beside = off(travel, t, far_off);
    const bool believed = !(beside > width_);
    if (!believed) width_ = kernels::smaller(width_ * scalar(2), scalar(1024));
    if (believed && beside * scalar(4) > kept_) kept_ = width_;
    if (believed) width_ = kept_;
    return believed;
  }
  constexpr void see(const motion& travel, scalar dt) noexcept {
    travel_ = travel;
    dt_ = dt;
  }
  constexpr void ease(const auto& far_off, scalar T, scalar top_speed) noexcept {
    width_ = kept_ = kernels::larger(scalar(1), kept_ * scalar(0.998));
    const scalar change = far_off(T, T, scalar(0)) * width_;
    easy_ = change * change;
    least_ = change / top_speed;
  }
  /// Requires the full test of the next sample.
  constexpr void think() noexcept { easy_ = scalar(-1); }
  /// |Δx|² [m²] and the time [s] of the last motion.
  [[nodiscard]] constexpr std::array<scalar, 2> last() const noexcept {
    if (!(dt_ > scalar(0))) return {kernels::largest<scalar>(), scalar(1)};
    return {P::squared(motion(travel_)), dt_};
  }

 private:
  /// The distance from x + V t over the possible one, where time stamps may be wrong by a quarter.
  [[nodiscard]] constexpr scalar off(const motion& travel, scalar t,
                                     const auto& far_off) const noexcept {
    if (!(dt_ > scalar(0))) return scalar(0);
    const motion on = P::scaled(motion(travel_), t / dt_);
    const scalar step = P::norm(on);
    return P::norm(P::difference(travel, on)) /
           (far_off(dt_, t, (step + P::norm(travel)) / t) + step / scalar(4));
  }

  typename P::stored_effort travel_ = P::zero();  ///< the last accepted motion
  scalar dt_{};                                   ///< its time [s]; 0: there was none
  scalar easy_ = scalar(-1), least_{};            ///< [m²], [s]
  scalar width_{1},
      kept_{1};  ///< accepted distance over the possible one; the same before rejections
};

/// Detects a sensor that is slower than the loop: it repeats a position and then jumps by more than top_speed · dt/25
/// [m], which a mass at rest cannot do in one tick. It does nothing if the loop is not `watched`.
template <port P, bool Watched>
class sensor_watch {
 public:
  [[nodiscard]] static constexpr bool repeats(const typename P::motion& /*travel*/,
                                              typename P::scalar /*dt*/,
                                              typename P::scalar /*top_speed*/) noexcept {
    return false;
  }
  constexpr void reset() noexcept {}
};
template <port P>
class sensor_watch<P, true> {
 public:
  using scalar = typename P::scalar;

  /// True for every such jump after a repeated position, from the fourth on.
  [[nodiscard]] constexpr bool repeats(const typename P::motion& travel, scalar dt,
                                       scalar top_speed) noexcept {
    const scalar square = P::squared(travel);
    const scalar fast = top_speed * dt / scalar(25);
    const bool jumped = stood_still_ && square > fast * fast;
    stood_still_ = !(square > scalar(0));
    if (!jumped) return false;
    if (jumps_ < suspicious) ++jumps_;
    return jumps_ == suspicious;
  }
  constexpr void reset() noexcept { *this = {}; }

 private:
  static constexpr std::uint8_t suspicious = 4;
  bool stood_still_ : 1 = false;  ///< the last sample showed no motion at all
  std::uint8_t jumps_ : 3 = 0;    ///< jumps after a repeated position, at most `suspicious`
};

}  // namespace v0
}  // namespace passive_haptics
