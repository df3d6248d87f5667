// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reachable bound of a motor that moves its handle through a cable, a belt or a coupler. The force of the transmission
// on the rotor is unknown, and may exceed the hand's; but the last three positions show it, and its rate is limited.
//
//   observed_reach   needs the rotor's mass and the rate limit of the force on it       any number of modes behind it

#include <passive_haptics/force_bound/reachable_bound.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {

/// m ẍ = f + g, with f the motors' force and g all others [N]. With V₀, V₁ the mean velocities [m/s] of the last two ticks, of
/// lengths T₀, T₁ [s], and f̂ the mean of the force held in them, the mean of g over them is
///     ĝ = m a − f̂,     a = 2 (V₀ − V₁)/(T₀ + T₁)
/// and while |dg/dt| ≤ R [N/s], the travel along f in the next tick is for equal ticks at most
///     δ(1) = V₀T + T²/m ((f + h)/2 − f̂ + m a + R T + 2 c)       (ours; any ticks: docs/design/mathematics.md § 14)
/// with h the force held in the last tick and c the dry friction. This is the formula of reachable_bound with the measured
/// force instead of the largest one. (3j − 1) f T²/4m is added to δ(j): else an empty ledger, which lets out E1/δ(j), would
/// be a spring of f/δ(j) that is too stiff for j ticks. If |g| ≤ G is stated as well, the smaller of both reaches counts.
///
/// Passive (E1 ≥ 0) under ALL of these:
///   - the mass that moves rigidly with the encoder, m, is the same in every direction and between `mass` and `mass_above`;
///   - all forces on it but the motor's and dry friction change by at most `slew` per second: slew_of() has it for a spring
///     k_c and its damper d_c whose ends part with v, whatever is behind them (Lemma A, § 14);
///   - dry friction is at most `friction`, and may change its sign at any time; the damper is at most `damping_above`;
///   - the assumptions of strict_bound, as in reachable_bound.
/// Of these, no hand of ours has drawn energy from a mass above `mass_above`, a friction or a damper above what is stated, or
/// a pull above G where R holds; from a lighter rotor it has, and rarely from a faster force (docs/guarantees.md, and ctest
/// "controls: observed_reach that is told a slower pull, or a heavier rotor, loses"). The proof needs all.
/// They imply |ĝ − ĝ_last| ≤ R (T₀ + T₁ + T₂)/3 + 2c and |ĝ| ≤ G + c. A motion that violates one of these for every m that
/// is stated refutes a number: then the bound is the strict one for 0.1 s, twice as long each time, with
/// event::outside_force. The guarantee does not rest on this test.
struct observed_reach {
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{
      .needs_ledger = true, .exact_travel = false, .latency = any_latency};

  double mass{};                   ///< lower bound of m, which moves rigidly with the encoder [kg]
  double mass_above{};             ///< upper bound of m [kg]; 0: unknown
  double slew{};                   ///< R, largest rate of g without dry friction [N/s]
  double friction{};               ///< c, largest dry friction [N]
  double damping_above{};          ///< upper bound of the damping b of m [N·s/m]
  double pull = detail::no_limit;  ///< G, largest g without dry friction [N]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(mass)) return {"mass", mass, "finite and > 0 kg"};
    if (mass_above != 0.0 && !(mass_above >= mass)) {
      return {"mass_above", mass_above, "≥ mass, or 0 where it is not known"};
    }
    if (!detail::not_negative(slew)) return {"slew", slew, "finite and ≥ 0 N/s"};
    if (!detail::not_negative(friction)) return {"friction", friction, "finite and ≥ 0 N"};
    if (!detail::not_negative(damping_above)) {
      return {"damping_above", damping_above, "finite and ≥ 0 N·s/m"};
    }
    if (!(pull >= 0.0)) return {"pull", pull, "≥ 0 N"};
    return {};
  }
  template <port Space>
  class on;
};

template <port Space>
class observed_reach::on {
 public:
  using scalar = typename Space::scalar;
  using effort = typename Space::effort;
  static_assert(detail::has_geometry<Space>,
                "passive_haptics: observed_reach knows one mass for all directions of a space: "
                "joints need reachable_work_bound, and transmissions that are stiff");

  constexpr explicit on(const observed_reach& p) noexcept { set(p); }
  constexpr void set(const observed_reach& p) noexcept {
    stated_ = p;
    m_ = detail::number<scalar>(p.mass);
    above_ = detail::number<scalar>(p.mass_above);
    R_ = detail::number<scalar>(p.slew);
    c_ = detail::number<scalar>(p.friction);
    b_ = detail::number<scalar>(p.damping_above);
    G_ = detail::number<scalar>(p.pull);
  }
  [[nodiscard]] constexpr observed_reach parameters() const noexcept { return stated_; }
  constexpr void reset() noexcept { *this = on(stated_); }

  template <class State>
  [[nodiscard]] constexpr share<scalar> limit(const effort& desired, const State& state) noexcept {
    look(state);
    const share allowed{detail::covered(desired, state, *this)};
    travel_ = state.travel;
    held_ = state.held;
    dt_ = state.dt;
    return allowed;
  }

  /// δ(J) [m] along `direction`, a vector of length `length`; `last` is the force held in tick J [N].
  template <int J, class State>
  [[nodiscard]] constexpr scalar reach(const effort& direction, scalar length, scalar last,
                                       const State& state) const noexcept {
    if (ticks_ < 1 || strict_for_ > scalar(0)) return kernels::largest<scalar>();
    const auto along = [&](const auto& v) { return scalar(Space::dot(v, direction) / length); };
    // h[0] was held in the last tick, h[i] will be in the i-th coming one, h[J] = last.
    std::array<scalar, State::latency + 2> h{};
    h[0] = along(effort(state.held));
    for (int i = 1; i < J; ++i) h[static_cast<std::size_t>(i)] = along(effort(state.coming(i)));
    h[static_cast<std::size_t>(J)] = last;
    scalar nearest = kernels::largest<scalar>();
    if (G_ < kernels::largest<scalar>()) nearest = by_size(J, h, along(state.travel), state);
    if (ticks_ >= 2) {
      const scalar T = state.longest_tick,
                   slewed = by_slew(J, h, along(state.travel), along(effort(travel_)),
                                    along(effort(held_)), state);
      nearest =
          kernels::smaller(nearest, slewed + scalar(3 * J - 1) * last * T * T / (scalar(4) * m_));
    }
    return nearest;
  }

  // The interface of a bound that tests the motion, which port/concepts.hpp lists; limit() tests every tick.
  [[nodiscard]] constexpr on& watching() noexcept { return *this; }
  [[nodiscard]] static constexpr bool looks() noexcept { return false; }
  template <bool Exact>
  constexpr void look(const auto&...) noexcept {}
  constexpr void look_on(bool /*asked*/) noexcept {}
  [[nodiscard]] constexpr event seen() const noexcept {
    return strict_for_ > scalar(0) ? event::outside_force : event::nominal;
  }
  [[nodiscard]] static constexpr bool lets_go() noexcept { return false; }
  [[nodiscard]] static constexpr bool forgives() noexcept { return false; }

 private:
  static constexpr scalar first_pause = scalar(0.1);  // [s]

  /// Counts the known ticks in a row, and tests their motion against the stated numbers.
  template <class State>
  constexpr void look(const State& state) noexcept {
    if (strict_for_ > scalar(0)) strict_for_ -= state.dt;
    if (!state.motion_known) {
      ticks_ = 0;
      return;
    }
    if (ticks_ < 3) ++ticks_;
    if (ticks_ < 2) return;
    const scalar T0 = state.dt, T1 = dt_, both = T0 + T1;
    const effort a = (effort(state.travel) / T0 - effort(travel_) / T1) * (scalar(2) / both);
    const effort held = (effort(state.held) * T0 + effort(held_) * T1) / both;
    const scalar size = Space::norm(a), loudest = Space::norm(held);
    const scalar noise = scalar(2) * error_of(state) * (scalar(1) / T0 + scalar(1) / T1) / both;
    const scalar rubbing =
        scalar(2) * b_ * (Space::norm(state.travel) + Space::norm(effort(travel_))) / both;
    const scalar unsure =
        rubbing + scalar(16) * kernels::rounding<scalar>() * (m_ * size + loudest);
    bool possible = explained(a, held, noise, G_ + c_ + unsure);
    if (ticks_ == 3) {
      possible =
          possible &&
          explained(effort(a - effort(a_)), effort(held - effort(mean_held_)), noise + noise_,
                    R_ * (both + before_) / scalar(3) + scalar(2) * c_ + unsure + unsure_);
    }
    a_ = a;
    mean_held_ = held;
    noise_ = noise;
    unsure_ = unsure;
    before_ = T1;
    if (possible) return;
    if (!(strict_for_ > scalar(0))) pause_ *= scalar(2);
    strict_for_ = pause_;
  }

  /// True if |m a − f| ≤ `most` + m `noise` [N] for some mass m within what is stated: a is `noise` [m/s²] off at most.
  [[nodiscard]] constexpr bool explained(const effort& a, const effort& f, scalar noise,
                                         scalar most) const noexcept {
    const scalar square = Space::dot(a, a), along = Space::dot(a, f);
    const scalar beyond = square - noise * noise;
    scalar m = above_ > scalar(0) ? kernels::larger(above_, m_) : kernels::largest<scalar>();
    if (beyond > scalar(0)) {  // the least of |m a − f| − m `noise`
      const scalar across = kernels::square_root(
          kernels::larger(scalar(0), Space::dot(f, f) * square - along * along));
      m = kernels::clamped((along + across * noise / kernels::square_root(beyond)) / square, m_, m);
    } else if (!(noise > scalar(0))) {
      m = m_;
    } else if (!(above_ > scalar(0))) {
      return true;  // a mass that is large enough explains whatever has been seen
    }
    return Space::norm(effort(a * m - f)) <= most + m * noise;
  }
  template <class State>
  [[nodiscard]] static constexpr scalar error_of(const State& state) noexcept {
    if constexpr (State::exact) {
      return scalar(0);
    } else {
      return state.travel_error;
    }
  }
  /// The largest f/m over the interval of m, so f/mass for f > 0, and f/mass_above (0 if unknown) for f < 0.
  [[nodiscard]] constexpr scalar by_mass(scalar force) const noexcept {
    if (force > scalar(0)) return force / m_;
    return above_ > scalar(0) ? force / above_ : scalar(0);
  }

  /// δ(j) [m] from |g| ≤ G: the acceleration is at most (h + G + c + 2B|Δx|)/m.
  template <class State>
  [[nodiscard]] constexpr scalar by_size(int j, const auto& h, scalar moved,
                                         const State& state) const noexcept {
    const scalar T = state.longest_tick, T0 = state.dt, e = error_of(state);
    const scalar most = G_ + c_ + scalar(2) * b_ / T * (Space::norm(state.travel) + e);
    const auto speeds_up = [&](int i) {
      return kernels::larger(by_mass(h[static_cast<std::size_t>(i)] + most), scalar(0));
    };
    scalar speed = moved / T0 + e / state.shortest_tick() +
                   speeds_up(0) * kernels::larger(T0, state.recent.longest) / scalar(2);
    for (int i = 1; i < j; ++i) speed += speeds_up(i) * T;
    return speed * T + speeds_up(j) * T * T / scalar(2) +
           scalar(8) * kernels::rounding<scalar>() *
               (kernels::magnitude(moved) + speeds_up(j) * T * T);
  }

  /// δ(j) [m] from |dg/dt| ≤ R: g differs from ĝ by at most R times the delay between them, and 2c (Theorem B, § 14).
  template <class State>
  [[nodiscard]] constexpr scalar by_slew(int j, const auto& h, scalar moved, scalar before,
                                         scalar held_before, const State& state) const noexcept {
    const scalar T = state.longest_tick, T0 = state.dt, T1 = dt_, e = error_of(state), half(0.5);
    const scalar V0 = moved / T0, V1 = before / T1, both = T0 + T1;
    const scalar a = scalar(2) * (V0 - V1) / both;
    const scalar held = (h[0] * T0 + held_before * T1) / both;
    const auto speeds_up = [&](int i) {
      return a + by_mass(h[static_cast<std::size_t>(i)] - held);
    };
    // w_j rises in the last tick, is 1 in those between and falls in tick j: its area, and its delay after w_0. Both
    // grow with T0 and T1, and are taken for recent ticks, so that the bound does not tremble as the ticks do.
    const scalar S = scalar(j - 1) * T, t0 = kernels::larger(T0, state.recent.longest),
                 t1 = kernels::larger(T1, t0);
    const scalar area = (t0 + T) * half + S, since = (scalar(2) * t0 + t1) / scalar(3);
    const scalar moment = -t0 * t0 / scalar(6) + S * S * half + S * T * half + T * T / scalar(6);
    const scalar later = moment / area + since;
    // the damper pulls back less where the rotor slows down
    scalar least = kernels::smaller(h[0], held_before);
    for (int i = 1; i < j; ++i) least = kernels::smaller(least, h[static_cast<std::size_t>(i)]);
    least = kernels::smaller(least, scalar(0));
    const scalar slows = kernels::larger(
        scalar(0), -(m_ * a - held + least) + R_ * (scalar(j) * T + since) + scalar(2) * c_);
    const scalar unsure = R_ * later + scalar(2) * c_ + b_ * later * slows / m_;

    scalar speed = V0 + speeds_up(0) * T0 * half;
    for (int i = 1; i < j; ++i) speed += kernels::larger(speeds_up(i), scalar(0)) * T;
    const scalar last = speeds_up(j) * half;
    scalar travel = speed * T + last * T * T;
    if (last < scalar(0) && speed < scalar(-2) * last * T) {  // it would stop within the tick
      travel = speed > scalar(0) ? speed * speed / (scalar(-4) * last) : scalar(0);
    }
    const scalar s0 = state.shortest_tick(), s1 = kernels::smaller(T1, s0),
                 k = scalar(2) * area / (s0 + s1);
    const scalar passed = (kernels::magnitude(V0) + kernels::magnitude(V1)) * (scalar(1) + k) * T;
    return travel + T * (area * unsure / m_ + e * ((scalar(1) + k) / s0 + k / s1)) +
           scalar(16) * kernels::rounding<scalar>() *
               (passed + T * area *
                             (unsure + kernels::magnitude(held) + h[static_cast<std::size_t>(j)]) /
                             m_);
  }

  observed_reach stated_;
  scalar m_{}, above_{}, R_{}, c_{}, b_{}, G_{};
  typename Space::stored_effort travel_{}, held_{};  ///< those of the tick before the last one
  typename Space::stored_effort a_{}, mean_held_{};  ///< of the two ticks before the last one
  scalar dt_{}, before_{}, noise_{}, unsure_{};
  scalar strict_for_{}, pause_ = first_pause / scalar(2);
  int ticks_ = 0;  ///< known ticks in a row, up to 3
};

static_assert(force_bound_for<observed_reach, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
