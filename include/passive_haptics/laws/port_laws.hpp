// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The laws of the parts of a port (the menu is in laws.hpp).

#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace laws {

/// worst_outflow(f, T) is at least f·Δx − dissipated(Δx, T) for every Δx.
template <class P, class Damping>
[[nodiscard]] constexpr bool covers_the_worst_motion(const Damping& parameters,
                                                     int ticks = 400) noexcept {
  using scalar = typename P::scalar;
  const part_at<Damping, P> damping(parameters);
  samples random(11);
  const scalar T = scalar(0.001);
  for (int i = 0; i < enough(ticks); ++i) {
    const typename P::effort f = random.vector<P>() * scalar(5);
    const scalar exponent = random.number<scalar>();
    const typename P::motion dx =
        random.vector<P>() * (exponent * exponent * scalar(0.1) * kernels::magnitude(exponent));
    const scalar handed_out = P::work(f, dx).joules - damping.dissipated(dx, T);
    const scalar worst = damping.worst_outflow(f, T);
    const scalar size = kernels::magnitude(P::work(f, dx).passed) + worst;
    const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon() * size;
    if (handed_out > worst + slack) return false;
  }
  return true;
}

/// The force that affordable(f, E, T) leaves has a worst outflow of at most max(E, 0) [J].
template <class P, class Damping>
[[nodiscard]] constexpr bool affords_what_is_there(const Damping& parameters,
                                                   int ticks = 400) noexcept {
  using scalar = typename P::scalar;
  const part_at<Damping, P> damping(parameters);
  samples random(12);
  const scalar T = scalar(0.001);
  for (int i = 0; i < enough(ticks); ++i) {
    const scalar exponent = random.number<scalar>();
    const scalar E = exponent * exponent * exponent * scalar(0.01);
    const typename P::effort f = random.vector<P>() * scalar(5);
    const scalar left = damping.affordable(f, E, T);
    if (!(left >= scalar(0) && left <= scalar(1))) return false;
    const scalar worst = damping.worst_outflow(typename P::effort(f * left), T);
    if (worst > kernels::larger(E, scalar(0))) return false;
  }
  return true;
}

/// ‖s f‖ = s ‖f‖ and ‖f + g‖ ≤ ‖f‖ + ‖g‖.
template <class P, class Inertia>
[[nodiscard]] constexpr bool is_a_norm(const Inertia& parameters, int ticks = 200) noexcept {
  using scalar = typename P::scalar;
  const part_at<Inertia, P> inertia(parameters);
  samples random(13);
  const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < enough(ticks); ++i) {
    const typename P::effort f = random.vector<P>();
    const typename P::effort g = random.vector<P>();
    const scalar s = kernels::magnitude(random.number<scalar>());
    const scalar size = inertia.norm(f) + inertia.norm(g);
    const scalar scaled = inertia.norm(typename P::effort(f * s)) - s * inertia.norm(f);
    if (kernels::magnitude(scaled) > slack * size) return false;
    if (inertia.norm(typename P::effort(f + g)) > size * (scalar(1) + slack)) return false;
  }
  return true;
}

/// In a run of random motions and forces no tick leaves E1 above its value before plus b|Δx|²/dt − f·Δx [J], be that
/// a gain or a loss: a cap, a reset or a dead band may only lower E1.
template <class P, class Observer>
[[nodiscard]] constexpr bool never_overstates(const Observer& parameters,
                                              int ticks = 200) noexcept {
  using scalar = typename P::scalar;
  part_at<Observer, P> observer(parameters);
  samples random(1);
  const scalar tolerance = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < enough(ticks); ++i) {
    const scalar dt = scalar(0.001) * (scalar(1.5) + random.number<scalar>());
    const typename P::motion step = random.vector<P>() * scalar(0.001);
    const bool touching = random.number<scalar>() > scalar(0);
    const typename P::effort held =
        touching ? typename P::effort(random.vector<P>()) : typename P::effort(P::zero());
    const scalar before = observer.value();
    const scalar took = observer.damping().dissipated(step, dt);
    const scalar gave = P::work(held, step).joules;
    static_cast<void>(observer.update(step, held, dt));
    const scalar size = kernels::magnitude(before) + took + kernels::magnitude(gave);
    if (observer.value() > before + took - gave + tolerance * size) return false;
  }
  return true;
}

/// forfeit() never raises the ledger, subtracts the worst outflow from a ledger that has as much, and never deepens
/// a debt, except by the energy that elastic friction may store.
template <class P, class Observer>
[[nodiscard]] constexpr bool forfeit_never_credits(const Observer& parameters,
                                                   int ticks = 200) noexcept {
  using scalar = typename P::scalar;
  part_at<Observer, P> observer(parameters);
  samples random(2);
  const scalar T = scalar(0.001);
  for (int i = 0; i < enough(ticks); ++i) {
    static_cast<void>(observer.update(random.vector<P>() * scalar(0.001), P::zero(), T));
    const typename P::effort held = random.vector<P>();
    const scalar before = observer.value();
    const scalar worst = observer.damping().worst_outflow(held, T);
    scalar debt = kernels::smaller(before, scalar(0));
    if constexpr (requires { observer.damping().most_stored(); }) {
      debt -= scalar(5) * observer.damping().most_stored() *
              (scalar(1) + scalar(64) * std::numeric_limits<scalar>::epsilon());
    }
    observer.forfeit(held, T);
    const scalar after = observer.value();
    if (after > before || after < debt) return false;
    if (after > scalar(0) && after > before - worst + scalar(1e-6) * before) return false;
  }
  return true;
}

/// A tick whose energy overflows is not booked, and update() returns false. Constant expressions do not
/// allow an overflow, so it is not tried there.
template <class P, class Observer>
[[nodiscard]] constexpr bool books_numbers_only(const Observer& parameters) noexcept {
  using scalar = typename P::scalar;
  if (std::is_constant_evaluated()) return true;
  part_at<Observer, P> observer(parameters);
  samples random(14);
  const scalar before = observer.value();
  const typename P::motion beyond = random.vector<P>() * (kernels::largest<scalar>() / scalar(2));
  return !observer.update(beyond, P::zero(), scalar(0.001)) && observer.value() == before;
}

/// reset() restores the initial value.
template <class P, class Observer>
[[nodiscard]] constexpr bool reset_forgets(const Observer& parameters) noexcept {
  using scalar = typename P::scalar;
  part_at<Observer, P> observer(parameters);
  samples random(15);
  const scalar first = observer.value();
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(
        observer.update(random.vector<P>() * scalar(0.001), random.vector<P>(), scalar(0.001)));
  }
  observer.reset();
  return observer.value() == first;
}

/// A damping for any port: 0.03 N·s/m, or N·m·s/rad, in every direction.
template <class P>
[[nodiscard]] constexpr auto a_damping() noexcept {
  if constexpr (detail::turns<P>()) {
    return typename P::damping_of_turns{0.03, 0.03};
  } else {
    diagonal_damping<P::dof> b;
    b.coefficients.fill(0.03);
    return b;
  }
}

/// Random states of a port, such as a bound may be given.
template <class P>
class random_port {
 public:
  using scalar = typename P::scalar;
  using damping_type = part_at<decltype(a_damping<P>()), P>;
  using state_type = port_state<P, damping_type>;

  constexpr explicit random_port(std::uint64_t seed) noexcept
      : random_(seed), damping_(a_damping<P>()) {}

  /// A state of finite numbers, with a ledger between −0.1 and 0.1 J.
  [[nodiscard]] constexpr state_type next() noexcept {
    const scalar exponent = random_.number<scalar>();
    commanded_[0] = typename P::effort(random_.vector<P>() * scalar(5));
    return {.damping = damping_,
            .commanded = commanded_,
            .energy = exponent * exponent * exponent * scalar(0.1),
            .dt = scalar(0.001),
            .longest_tick = scalar(0.001),
            .held = commanded_[0],
            .travel = random_.vector<P>() * scalar(0.002),
            .travel_error = scalar(0),
            .motion_known = true,
            .late = false};
  }
  [[nodiscard]] constexpr samples& random() noexcept { return random_; }

 private:
  samples random_;
  damping_type damping_;
  typename state_type::commands commanded_{};
};

/// The force that a bound returns. A share is taken unclamped here, while a tick clamps it to [0, 1].
template <class P>
[[nodiscard]] constexpr typename P::effort meant(auto& bound, const typename P::effort& desired,
                                                 const auto& state) noexcept {
  if constexpr (requires { bound.limit(desired, state).factor; }) {
    return desired * bound.limit(desired, state).factor;
  }
  return detail::applied<P>(bound, desired, state).force;
}

/// Visits `ticks` random states; true if test(desired, allowed, state) holds in all of them.
template <class P, class Bound>
[[nodiscard]] constexpr bool holds_in_random_states(const Bound& parameters, auto test,
                                                    int ticks) noexcept {
  using scalar = typename P::scalar;
  part_at<Bound, P> bound(parameters);
  random_port<P> port(3);
  for (int i = 0; i < enough(ticks); ++i) {
    const auto state = port.next();
    const scalar asked = port.random().template number<scalar>();
    const typename P::effort desired =
        port.random().template vector<P>() * (asked * asked * scalar(20));
    const typename P::effort allowed = meant<P>(bound, desired, state);
    if (!P::is_finite(allowed) || !test(desired, allowed, state)) return false;
  }
  return true;
}

/// The bound returns a finite force, for positive and negative ledgers.
template <class P, class Bound>
[[nodiscard]] constexpr bool answers_with_a_number(const Bound& bound, int ticks = 200) noexcept {
  return holds_in_random_states<P>(
      bound, [](const auto&, const auto&, const auto&) { return true; }, ticks);
}

/// Every component of the result has the sign of that of f* and is no larger. For bounds that only reduce.
template <class P, class Bound>
[[nodiscard]] constexpr bool scales_down(const Bound& bound, int ticks = 200) noexcept {
  static_assert(detail::reduces<Bound, P, typename random_port<P>::state_type>(),
                "passive_haptics: a law for bounds that only reduce");
  using scalar = typename P::scalar;
  return holds_in_random_states<P>(
      bound,
      [](const auto& desired, const auto& allowed, const auto&) {
        for (int i = 0; i < P::dof; ++i) {
          const scalar asked = P::component(desired, i);
          const scalar left = P::component(allowed, i);
          if (left * asked < scalar(0) || kernels::magnitude(left) > kernels::magnitude(asked)) {
            return false;
          }
        }
        return true;
      },
      ticks);
}

/// ¼ fᵀB⁻¹f ≤ max(E1, 0), which is all that the proof of strict_bound uses. (§ 2(a))
template <class P, class Bound>
[[nodiscard]] constexpr bool spends_at_most_the_ledger(const Bound& bound,
                                                       int ticks = 1000) noexcept {
  using scalar = typename P::scalar;
  return holds_in_random_states<P>(
      bound,
      [](const auto&, const auto& allowed, const auto& state) {
        const scalar outflow = state.damping.worst_outflow(allowed, state.longest_tick);
        return outflow <= kernels::larger(state.credit(), scalar(0));
      },
      ticks);
}

/// After reset() the bound returns the same forces as a new one.
template <class P, class Bound>
[[nodiscard]] constexpr bool reset_starts_anew(const Bound& parameters, int ticks = 50) noexcept {
  part_at<Bound, P> used(parameters);
  part_at<Bound, P> fresh(parameters);
  random_port<P> port(4);
  for (int i = 0; i < enough(ticks); ++i) {
    const auto state = port.next();
    static_cast<void>(
        detail::applied<P>(used, typename P::effort(port.random().template vector<P>()), state));
  }
  detail::restart(used);
  for (int i = 0; i < enough(ticks); ++i) {
    const auto state = port.next();
    const typename P::effort desired = port.random().template vector<P>();
    const auto one = detail::applied<P>(used, desired, state);
    const auto other = detail::applied<P>(fresh, desired, state);
    if (!(one.force == other.force)) return false;
  }
  return true;
}

/// The pose x + Δx.
template <class P>
[[nodiscard]] constexpr typename P::pose after(const typename P::pose& x,
                                               const typename P::motion& dx) noexcept {
  if constexpr (requires { P::moved(x, dx); }) {
    return P::moved(x, dx);
  } else {
    return x + dx;
  }
}

/// The least port energy [J] in one run of random desired forces and random motions, half of them the worst of L3,
/// with a port that is `Latency` ticks late. It is computed here from the held forces.
template <int Latency, class P, class Bound>
[[nodiscard]] constexpr typename P::scalar least_energy(const Bound& bound, std::uint64_t seed,
                                                        int ticks) noexcept {
  using scalar = typename P::scalar;
  using effort = typename P::effort;
  using motion = typename P::motion;
  constexpr auto b = a_damping<P>();
  const part_at<decltype(a_damping<P>()), P> damping(b);
  using ledger = basic_reduced_energy<std::remove_const_t<decltype(b)>>;
  passive_port device{P{}, given_force{}, ledger{.damping = b}, bound,
                      late_loop_limits<Latency>{.longest_tick = 0.001, .top_speed = 1e3}};
  samples random(seed);
  std::array<effort, static_cast<std::size_t>(Latency) + 1> commanded{};
  commanded.fill(P::zero());
  effort acting = P::zero();
  scalar done(0);  // work of `acting` over the last tick [J]
  typename P::pose x = typename P::stored_pose{};
  scalar energy(0), least(0), passed(0);
  const scalar T = scalar(0.001);
  for (int i = 0; i < enough(ticks); ++i) {
    const scalar size = random.number<scalar>();
    const effort wanted = random.vector<P>() * (size * scalar(10));
    effort next = P::zero();
    if constexpr (detail::reports_work<P>()) {
      next =
          device.tick({.position = x, .held = acting, .dt = T, .valid = true, .work = done}, wanted)
              .force;
    } else {
      next = device.tick(x, seconds{T}, wanted).force;
    }
    for (std::size_t j = commanded.size() - 1; j > 0; --j) commanded[j] = commanded[j - 1];
    commanded[0] = next;
    acting = commanded.back();  // until the next tick
    motion dx = random.vector<P>() * scalar(2e-4);
    if (random.number<scalar>() > scalar(0)) {  // half of the ticks have the worst motion of L3
      for (int k = 0; k < P::dof; ++k) {
        P::component(dx, k) = P::component(acting, k) * T / (scalar(2) * damping.along_axis(k));
      }
    }
    const typename P::pose moved = after<P>(x, dx);
    dx = P::between(x, moved);  // the motion after rounding
    x = moved;
    const auto work = P::work(acting, dx);
    done = work.joules;
    energy += damping.dissipated(dx, T) - done;
    passed += damping.dissipated(dx, T) + work.passed;
    const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon() * passed;
    least = kernels::smaller(least, energy + slack);
  }
  return least;
}

/// No motion draws energy out of a port with this bound, on time or, if the bound allows it, two ticks late. For
/// bounds whose guarantee is `strict`.
template <class P, class Bound>
[[nodiscard]] constexpr bool loses_to_no_motion(const Bound& bound, int runs = 5,
                                                int ticks = 200) noexcept {
  using scalar = typename P::scalar;
  for (int run = 0; run < enough(runs); ++run) {
    const auto seed = static_cast<std::uint64_t>(run) + 20;
    if (least_energy<0, P>(bound, seed, ticks) < scalar(0)) return false;
    if constexpr (Bound::traits.latency >= 2) {
      if (least_energy<2, P>(bound, seed, ticks) < scalar(0)) return false;
    }
  }
  return true;
}

}  // namespace laws
}  // namespace v0
}  // namespace passive_haptics
