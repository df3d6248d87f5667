// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reachable bound of a device with a known transmission: a chain of masses, with an unknown hand on the last one.
//
//   modelled_reach<N>      N masses, a loop on time        the stiffest where the mode is above 100 Hz
//   modelled_reach<N, k>   and up to k ticks late
//
//     ph::modelled_reach<2>{.device = ph::two_masses(0.1, 0.3, 160.0, 0.03, 0.1), .hand_force = 5.0, .tick = 1e-3}

#include <passive_haptics/compliant/chain.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The last 2N positions of the encoder and the held forces determine the chain's state, apart from the effect of the hand F
/// [N] and of dry friction c [N] meanwhile. So the next travel [m] is at most
///     δ = Σ vᵢ Δx + Σ uᵢ f + F ∫|K| + c ∫|L|                                      (chain.hpp; Theorem C, § 14)
/// and N = 1 without a damper is reachable_bound. It is evaluated after each quarter of a tick, because within a tick the
/// rotor may be farther out than at its end.
///
/// Each number of the chain may be off by its tolerance. The reach is that of the stated numbers plus 5/4 of the sum of what
/// each number adds by itself. This is not proved; tests and bench/devices attack devices at the corners of the box.
///
/// Passive (E1 ≥ 0) under ALL of these:
///   - the device is such a chain, the same along every axis, within the tolerances; a mode that is not stated is not
///     covered;
///   - the hand pushes on the last mass only, with at most `hand_force`; dry friction, at most `friction`, acts on the first
///     mass only;
///   - every tick has the length `tick`. In one of another length, and in the 2N − 2 after it, the bound is the strict one;
///   - the assumptions of strict_bound, as in reachable_bound.
/// Each of these numbers, untrue, has cost energy in a trial, but for the losses, from a tenth to ten times those stated
/// (docs/guarantees.md).
template <int N, int Late = 0>
struct modelled_reach {
  static constexpr guarantee passivity = guarantee::conditional;
  static constexpr bound_traits traits{
      .needs_ledger = true, .exact_travel = false, .latency = Late};

  chain<N> device{};
  double hand_force{};      ///< F, largest force on the last mass [N]
  double friction{};        ///< c, largest dry friction of the first mass [N]
  double tick = 1e-3;       ///< T, the length of every tick [s]
  double tolerance = 0.03;  ///< of masses and springs: each within a factor of (1 + tolerance)
  double loss_tolerance =
      0.30;  ///< of losses and damping: each within a factor of (1 + loss_tolerance)

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = device.check()) return fault;
    if (const auto fault = detail::fault_of_hand(hand_force)) return fault;
    if (!detail::not_negative(friction)) return {"friction", friction, "finite and ≥ 0 N"};
    if (!detail::positive(tick)) return {"tick", tick, "finite and > 0 s"};
    if (!(tolerance >= 0.0 && tolerance <= 0.3)) {
      return {"tolerance", tolerance, "from 0 to 0.3: more is no model"};
    }
    if (!(loss_tolerance >= 0.0 && loss_tolerance <= 1.0)) {
      return {"loss_tolerance", loss_tolerance, "from 0 to 1"};
    }
    for (std::size_t i = 0; i + 1 < N; ++i) {
      const double k = device.springs[i],
                   m = kernels::smaller(device.masses[i], device.masses[i + 1]);
      if (k * tick * tick > 40.0 * m) {
        return {"springs", k, "so that it rings slower than the loop ticks: stiffer is rigid"};
      }
    }
    return {};
  }
  template <port Space>
  class on;
};

template <int N, int Late>
template <port Space>
class modelled_reach<N, Late>::on {
 public:
  using scalar = typename Space::scalar;
  using effort = typename Space::effort;
  static_assert(detail::has_geometry<Space>,
                "passive_haptics: modelled_reach knows one chain for all directions of a space: "
                "joints need reachable_work_bound, and transmissions that are stiff");

  explicit on(const modelled_reach& p) noexcept { set(p); }
  void set(const modelled_reach& p) noexcept {
    stated_ = p;
    ticks_ = 0;
    if (!p.check()) learn();
  }
  [[nodiscard]] constexpr modelled_reach parameters() const noexcept { return stated_; }
  constexpr void reset() noexcept { ticks_ = 0; }

  template <class State>
  [[nodiscard]] constexpr share<scalar> limit(const effort& desired, const State& state) noexcept {
    remember(state);
    return {detail::covered(desired, state, *this)};
  }

  /// δ(J) [m] along `direction`, a vector of length `length`; `last` is the force held in tick J [N].
  template <int J, class State>
  [[nodiscard]] constexpr scalar reach(const effort& direction, scalar length, scalar last,
                                       const State& state) const noexcept {
    if (ticks_ < seen) return kernels::largest<scalar>();
    const auto along = [&](const auto& v) { return scalar(Space::dot(v, direction) / length); };
    std::array<scalar, seen> moved{};
    std::array<scalar, seen + ahead> force{};
    const auto first = static_cast<std::size_t>(J);
    force[0] = last;
    for (int i = 1; i < J; ++i)
      force[static_cast<std::size_t>(J - i)] = along(effort(state.coming(i)));
    for (std::size_t i = 0; i < seen; ++i) {
      moved[i] = along(effort(travels_[i]));
      force[first + i] = along(effort(held_[i]));
    }
    scalar error(0);
    if constexpr (!State::exact) error = state.travel_error;

    const auto travel = [&](const law& of) {
      scalar s = of.unsure + of.noise * error, passed(0);
      for (std::size_t i = 0; i < seen; ++i) {
        s += of.travels[i] * moved[i];
        passed += kernels::magnitude(of.travels[i] * moved[i]);
      }
      for (std::size_t i = 0; i < seen + first; ++i) {
        s += of.forces[i] * force[i];
        passed += kernels::magnitude(of.forces[i] * force[i]);
      }
      return s + scalar(2 * seen) * kernels::rounding<scalar>() * passed;
    };
    scalar farthest(0);
    for (const auto& part : laws_[first - 1]) {
      const scalar stated = travel(part[0]);
      scalar more(0);
      for (std::size_t i = 1; i < models; i += 2) {
        const scalar off = kernels::larger(travel(part[i]), travel(part[i + 1])) - stated;
        more += kernels::larger(off, scalar(0));
      }
      farthest = kernels::larger(farthest, stated + more * scalar(1.25));
    }
    return farthest;
  }

 private:
  static constexpr int seen = 2 * N - 1;  ///< past ticks whose travels and forces are used
  static constexpr int ahead = Late + 1,
                       parts =
                           4;  ///< coming ticks, and parts of each, for which a reach is computed
  static constexpr int numbers = 3 * N - 1;  ///< how many numbers a chain has
  static constexpr int models =
      1 + 2 * numbers;  ///< as stated, and each number larger, and smaller

  struct law {
    std::array<scalar, seen> travels{};
    std::array<scalar, seen + ahead> forces{};
    scalar unsure{}, noise{};
  };
  using laws_of_a_tick = std::array<std::array<law, models>, parts>;

  /// The stated chain with one number multiplied by its factor.
  [[nodiscard]] static chain<N> but_for(chain<N> c, int number, double larger,
                                        double more_lossy) noexcept {
    auto i = static_cast<std::size_t>(number);
    if (i < N) {
      c.masses[i] *= larger;
      return c;
    }
    i -= N;
    if (i < N - 1) {
      c.springs[i] *= larger;
      return c;
    }
    i -= N - 1;
    (i < N - 1 ? c.losses[i] : c.damping) *= more_lossy;
    return c;
  }
  void learn() noexcept {
    for (int model = 0; model < models; ++model) {
      const double t = 1.0 + stated_.tolerance, l = 1.0 + stated_.loss_tolerance;
      const bool more = model % 2 == 1;
      const chain<N> c = model == 0 ? stated_.device
                                    : but_for(stated_.device, (model - 1) / 2, more ? t : 1.0 / t,
                                              more ? l : 1.0 / l);
      const detail::chain_response<N> response(c, stated_.tick);
      for (int j = 1; j <= ahead; ++j) {
        for (int part = 1; part <= parts; ++part) {
          const auto found = response.template law<ahead>(j, part, parts);
          law& kept = laws_[static_cast<std::size_t>(j - 1)][static_cast<std::size_t>(part - 1)]
                           [static_cast<std::size_t>(model)];
          for (std::size_t i = 0; i < seen; ++i)
            kept.travels[i] = static_cast<scalar>(found.travels[i]);
          for (std::size_t i = 0; i < seen + ahead; ++i) {
            kept.forces[i] = static_cast<scalar>(found.forces[i]);
          }
          kept.unsure = static_cast<scalar>(stated_.hand_force * found.hand +
                                            stated_.friction * found.rubbing);
          kept.noise = static_cast<scalar>(found.noise);
        }
      }
    }
  }

  template <class State>
  constexpr void remember(const State& state) noexcept {
    const auto T = static_cast<scalar>(stated_.tick);
    const bool even = kernels::magnitude(state.dt - T) <= scalar(1e-6) * T;
    if (!state.motion_known || !even) {
      ticks_ = 0;
      return;
    }
    if (ticks_ < seen) ++ticks_;
    for (std::size_t i = seen - 1; i > 0; --i) {
      travels_[i] = travels_[i - 1];
      held_[i] = held_[i - 1];
    }
    travels_[0] = state.travel;
    held_[0] = state.held;
  }

  modelled_reach stated_;
  std::array<laws_of_a_tick, ahead> laws_{};
  std::array<typename Space::stored_effort, seen> travels_{}, held_{};  ///< newest first
  int ticks_ = 0;  ///< known ticks in a row, up to `seen`
};

static_assert(force_bound_for<modelled_reach<2>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
