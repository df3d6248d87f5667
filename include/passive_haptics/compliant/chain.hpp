// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A chain of masses, and the prediction of the first one's travel from the encoder on it.
//
//   motor f ─▶ m₁, b ──(k₁, d₁)── m₂ ──(k₂, d₂)── … m_N ◀── hand h            the same along every axis
//              └─▶ encoder
//
// The chain is linear, and 2N positions of the encoder determine its 2N state variables, so the travel [m] of a coming tick is
//     s = Σ vᵢ Δx(n−i) + Σ uᵢ f(n−i) + ∫ K h + ∫ L r        i < 2N − 1
// K and L [m/(N·s)] are the effects of the hand's force h and of a dry friction r that those positions do not determine. A
// hand of at most F adds at most F ∫|K|, and some hand attains that (ours; Theorem C, docs/design/mathematics.md § 14).

#include <passive_haptics/base/parameter.hpp>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <numbers>

namespace passive_haptics {
inline namespace v0 {

template <int N>
struct chain {
  static_assert(N >= 1 && N <= 4, "passive_haptics: a chain has one to four masses");

  std::array<double, N> masses{};       ///< m₁ with the encoder, … m_N at the hand [kg]
  std::array<double, N - 1> springs{};  ///< k of the spring between neighbours [N/m]
  std::array<double, N - 1> losses{};   ///< d of the damper between neighbours [N·s/m]
  double damping{};                     ///< b of m₁ against the ground [N·s/m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (const double m : masses) {
      if (!detail::positive(m)) return {"masses", m, "each finite and > 0 kg"};
    }
    for (const double k : springs) {
      if (!detail::positive(k)) return {"springs", k, "each finite and > 0 N/m"};
    }
    for (const double d : losses) {
      if (!detail::not_negative(d)) return {"losses", d, "each finite and ≥ 0 N·s/m"};
    }
    if (!detail::not_negative(damping)) return {"damping", damping, "finite and ≥ 0 N·s/m"};
    return {};
  }
};

/// Two masses from identified numbers: `share` of `mass` [kg] moves with the encoder, and the free device has a mode of
/// `mode` [Hz] with the damping ratio ζ = `loss`:  k = μ ω²,  d = 2 ζ ω μ,  μ = share (1 − share) mass,  ω = 2π mode.
[[nodiscard]] constexpr chain<2> two_masses(double mass, double share, double mode, double loss,
                                            double damping) noexcept {
  const double omega = 2.0 * std::numbers::pi * mode, reduced = share * (1.0 - share) * mass;
  return {{share * mass, (1.0 - share) * mass},
          {reduced * omega * omega},
          {2.0 * loss * omega * reduced},
          damping};
}

/// The frequency of the free resonance of two masses, or an upper bound of all those of a longer chain [Hz], by
/// Gershgorin's circles:  (2πf)² ≤ max over e of k_e (1/m_e + 1/m_{e+1}) + √(k_e k_{e−1})/m_e + √(k_e k_{e+1})/m_{e+1}
template <int N>
[[nodiscard]] constexpr double fastest_mode(const chain<N>& c) noexcept {
  double most = 0.0;
  for (std::size_t e = 0; e + 1 < std::size_t{N}; ++e) {
    const double k = c.springs[e];
    double square = k / c.masses[e] + k / c.masses[e + 1];
    if (e > 0) square += kernels::square_root(k * c.springs[e - 1]) / c.masses[e];
    if (e + 2 < std::size_t{N}) {
      square += kernels::square_root(k * c.springs[e + 1]) / c.masses[e + 1];
    }
    most = kernels::larger(most, square);
  }
  return kernels::square_root(most) / (2.0 * std::numbers::pi);
}

namespace detail {

/// The coefficients of s for one part of one coming tick: s = Σ travels·Δx + Σ forces·f, newest first, after the coming
/// ones. `hand` and `rubbing` are ∫|K| and ∫|L| [m/N], `noise` is ½ Σ|wᵢ|, the effect of positions off by ½.
template <int N, int Ahead>
struct travel_law {
  std::array<double, 2 * N - 1> travels{};
  std::array<double, 2 * N - 1 + Ahead> forces{};  ///< [m/N]; forces[0] is that of the tick itself
  double hand{}, rubbing{}, noise{};
};

/// The laws of a chain in ticks of T [s].
template <int N>
class chain_response {
  static constexpr int order = 2 * N, pieces = 48;
  using matrix = Eigen::Matrix<double, order, order>;
  using column = Eigen::Matrix<double, order, 1>;
  using row = Eigen::Matrix<double, 1, order>;

 public:
  chain_response(const chain<N>& c, double T) {
    // the state: position and velocity of each mass, then a force on the first mass and one on the last
    using wider = Eigen::Matrix<double, order + 2, order + 2>;
    wider A = wider::Zero();
    const auto m = [&c](int i) { return c.masses[static_cast<std::size_t>(i)]; };
    for (int i = 0; i < N; ++i) A(2 * i, 2 * i + 1) = 1.0;
    A(1, 1) -= c.damping / m(0);
    for (int i = 0; i + 1 < N; ++i) {
      const double k = c.springs[static_cast<std::size_t>(i)],
                   d = c.losses[static_cast<std::size_t>(i)];
      for (const int end : {i, i + 1}) {
        const int other = 2 * i + 1 - end;
        A(2 * end + 1, 2 * other) += k / m(end);
        A(2 * end + 1, 2 * end) -= k / m(end);
        A(2 * end + 1, 2 * other + 1) += d / m(end);
        A(2 * end + 1, 2 * end + 1) -= d / m(end);
      }
    }
    A(1, order) = 1.0 / m(0);
    A(order - 1, order + 1) = 1.0 / m(N - 1);
    A *= T / pieces;
    wider piece = wider::Identity(), term = wider::Identity();
    for (int i = 1; i < 24; ++i) {
      term = wider(term * A / i);
      piece += term;
    }
    wider whole = wider::Identity();
    for (int i = 0; i <= pieces; ++i) {
      after_[static_cast<std::size_t>(i)] = whole.template topLeftCorner<order, order>();
      pushed_[static_cast<std::size_t>(i)] = whole.template block<order, 1>(0, order);
      whole = wider(whole * piece);
    }
    motor_ = piece.template block<order, 1>(0, order);
    hand_ = piece.template block<order, 1>(0, order + 1);
    const matrix& tick = after_[pieces];
    power_[0] = matrix::Identity();
    for (std::size_t i = 1; i < power_.size(); ++i) power_[i] = power_[i - 1] * tick;
  }

  /// The law of the first `part` of `parts` of the j-th coming tick.
  template <int Ahead>
  [[nodiscard]] travel_law<N, Ahead> law(int j, int part, int parts) const {
    travel_law<N, Ahead> found;
    const int end = pieces * part / parts,
              last = order - 2 + j;  // the tick itself; the oldest position has number 0
    const auto at = [](const auto& some, int i) -> const auto& {
      return some[static_cast<std::size_t>(i)];
    };
    const row rise = at(after_, end).row(0) - matrix::Identity().row(0);
    matrix seen;
    for (int i = 0; i < order; ++i) seen.row(i) = at(power_, i).row(0);
    const row target = rise * at(power_, last);
    const row w = seen.transpose().fullPivLu().solve(target.transpose()).transpose();
    // the part of s that the positions do not show, of an impulse that ends tick t in the state `g`
    const auto left = [&](int t, const column& g) {
      double s = rise * at(power_, last - 1 - t) * g;
      for (int i = t + 1; i < order; ++i) s -= w(i) * (at(power_, i - t - 1).row(0) * g)(0);
      return s;
    };
    double sum = 0.0;
    for (int i = 0; i + 1 < order; ++i) {  // x(n−i) is the newest position less the travels since
      sum += w(i);
      found.travels[static_cast<std::size_t>(order - 2 - i)] = -sum;
      found.noise += std::abs(w(i)) / 2.0;
    }
    found.noise += std::abs(w(order - 1)) / 2.0;
    for (int t = 0; t < last; ++t) {
      found.forces[static_cast<std::size_t>(last - t)] = left(t, pushed_[pieces]);
      for (int i = 0; i < pieces; ++i) {
        const matrix& later = at(after_, pieces - 1 - i);
        found.hand += std::abs(left(t, column(later * hand_)));
        found.rubbing += std::abs(left(t, column(later * motor_)));
      }
    }
    for (int i = 0; i < end; ++i) {
      found.hand += std::abs((at(after_, end - 1 - i) * hand_)(0));
      found.rubbing += std::abs((at(after_, end - 1 - i) * motor_)(0));
    }
    found.forces[0] = at(pushed_, end)(0);
    found.hand *= 1.001;  // the kernels may change their sign within a piece
    found.rubbing *= 1.001;
    return found;
  }

 private:
  std::array<matrix, pieces + 1> after_;   ///< transition of the state over so many pieces
  std::array<column, pieces + 1> pushed_;  ///< state after 1 N on the first mass for so long
  std::array<matrix, 2 * order + 4> power_;
  column motor_, hand_;  ///< state after 1 N on the first and the last mass for one piece
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
