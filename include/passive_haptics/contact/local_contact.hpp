// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The local model of the thesis, without its energy: one contact, a source of desired force for a port.
//
//   motion ─▶ probe ─▶ normal ─▶ law ─▶ shapers ─▶ wanted force ─▶ (the port's bound) ─▶ follow
//             depth in  n_LM →   f* = K d…                                              own piece
//             both      n_VE                                                            at depth f/K

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/contact/own_surface.hpp>
#include <passive_haptics/contact/shaped.hpp>

#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// The result of a tick of a port with contacts. It is trivially copyable.
template <class Space>
struct tick_result {
  typename Space::vector force;   ///< force on the device [N]
  typename Space::scalar depth;   ///< penetration in the local model [m], 0 outside
  typename Space::scalar energy;  ///< E1 [J]
  event what = event::nominal;    ///< the worst event of the tick
  bool limited = false;           ///< shaper or bound changed the desired force
};

/// The result of update(). It converts to true if the surface was accepted; otherwise the last good one stays.
template <class Scalar>
struct news_taken {
  bool taken = false;
  Scalar stiffness{};  ///< the stiffness displayed at rest [N/m]; explain() says why

  constexpr operator bool() const noexcept { return taken; }  // NOLINT(google-explicit-constructor)
};

namespace detail {
template <class Law, class Space>
inline constexpr bool is_shaped = requires(part_at<Law, Space> law) {
  law.shapers();
};

/// True if the law limits the rate at which updates are followed.
template <class Law>
inline constexpr bool eases_news = requires(const Law law) {
  law.pace();
};

template <class Law>
[[nodiscard]] constexpr bool wants_local_model() noexcept {
  if constexpr (speaks_of_local_model<Law>) return Law::needs_local_model;
  return false;
}

/// Explains a surface for a device at x: its stiffness, the depth, the displayed stiffness `shown` [N/m] and its reason
/// and, while it is touched, whether it follows an update (`lags`) or fades.
template <class Surface, class Scalar>
constexpr void explain_surface(explanation& e, const Surface& surface, const auto& x, Scalar shown,
                               softened_by why, bool lags, bool fades) noexcept {
  const auto here = surface.at(x);
  const bool touched = here.depth > Scalar(0) && here.covered();
  e.asked = e.shown = static_cast<double>(surface.stiffness);
  e.soften(static_cast<double>(shown), why);
  e.depth = touched ? static_cast<double>(here.depth) : 0.0;
  e.now = softened_by::nothing;
  if (touched && lags) e.now = softened_by::news;
  if (touched && fades) e.now = softened_by::silence;
}

/// True unless a supply has a constraint_type that is no constraint.
template <class Supply, class Space>
[[nodiscard]] constexpr bool supplies_no_other_than_constraints() noexcept {
  if constexpr (requires { typename Supply::constraint_type; }) {
    return constraint_for<typename Supply::constraint_type, Space>;
  }
  return true;
}
/// The space of a supply's constraint, or of a surface that is given instead of a supply.
template <class Supply>
struct space_of {
  using type = typename Supply::constraint_type::space_type;
};
template <class Surface>
requires requires {
  typename Surface::space_type;
}
struct space_of<Surface> {
  using type = typename Surface::space_type;
};
}  // namespace detail

/// A contact with the surface of a supply, with a normal interpolation and a contact law:
///     ph::local_contact{ph::followed<ph::half_space<scene>>{}, ph::turn_limited{.rate = 2.0},
///                       ph::damped_spring{.mass = 0.1}}
/// Models source_for<Space>. It has no ledger and guarantees nothing; the port's bound does.
template <class Space, class Supply, class Normals, class Law>
class local_contact {
  static_assert(
      !surface_for<Supply, Space>,
      "passive_haptics: a surface by itself brings no news and no promise to stay: wrap it "
      "in followed, or in fixed if it never moves");
  static_assert(
      detail::supplies_no_other_than_constraints<Supply, Space>(),
      "passive_haptics: the constraint does not model constraint_for: see port/concepts.hpp");
  static_assert(supply_for<Supply, Space>,
                "passive_haptics: the supply does not model supply_for: see port/concepts.hpp");
  static_assert(
      !std::same_as<Law, detail::left_out>,
      "passive_haptics: the contact law is left out: after the normal interpolation comes "
      "spring{} or another one");
  static_assert(normal_interpolation_for<Normals, Space>,
                "passive_haptics: the normal interpolation does not model "
                "normal_interpolation_for: see port/concepts.hpp");
  static_assert(
      std::same_as<Law, detail::left_out> || contact_law_for<Law, Space>,
      "passive_haptics: the contact law does not model contact_law_for: see port/concepts.hpp");
  static_assert(Supply::moves || !detail::wants_local_model<Law>(),
                "passive_haptics: this shaper compares with a local model that can move: "
                "use followed instead of fixed");

 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using constraint_type = typename Supply::constraint_type;
  using law_type = part_at<Law, Space>;
  using normals_type = part_at<Normals, Space>;
  using result_type = tick_result<Space>;
  static constexpr bool asks_for_numbers = true;
  static constexpr bool needs_ledger = detail::spends_ledger<Law>();  ///< a shaper of it does

  constexpr local_contact() noexcept : local_contact(Supply{}, Normals{}, Law{}) {}
  constexpr local_contact(const Supply& supply, const Normals& normals, const Law& law) noexcept
      : supply_(supply), normals_(normals), law_(law) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = detail::fault_in(normals_)) return fault;
    if (const auto fault = detail::fault_in(law_)) return fault;
    return detail::fault_in(supply_);
  }
  template <class Parameters>
  static constexpr int takers = detail::takers<Parameters, Normals, Space> +
                                detail::takers<Parameters, Law, Space> +
                                static_cast<int>(detail::takes_in_place<Supply, Parameters>);
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    if constexpr (detail::takers < Parameters, Normals, Space >> 0) {
      detail::take<Normals, Space>(normals_, p);
    } else if constexpr (detail::takers<Parameters, Law, Space> > 0) {
      detail::take<Law, Space>(law_, p);
    } else {
      supply_.set(p);
    }
  }
  constexpr void reset() noexcept {
    detail::restart(supply_);
    detail::restart(law_);
    own_.reset();
    if constexpr (eases) law_.let_go();
  }

  /// Recomputes the displayed stiffness for a new T [s], latency or parameter.
  constexpr void adopt(scalar longest_tick, int late) noexcept {
    own_.adopt(longest_tick);
    if (supply_.target().stiffness > scalar(0))
      detail::tell(law_, supply_.target().stiffness, longest_tick, late);
  }

  /// Explains the surface for a device at x, in ticks of T [s] with commands held `late` ticks later.
  constexpr void explain(explanation& e, const vector& x, scalar T, int late) const noexcept {
    if constexpr (Supply::moves) {
      if (!(supply_.weight() > scalar(0))) {
        e.stiffness = softened_by::no_surface;
        return;
      }
    }
    const scalar K = supply_.target().stiffness;
    bool fades = false;
    if constexpr (Supply::moves) fades = supply_.weight() < scalar(1);
    const law_type law = law_for(K, T, late);
    detail::explain_surface(e, supply_.target(), x, scalar(1) / law.depth(scalar(1), scalar(0)),
                            softener(law), own_.lags(), fades);
    if constexpr (detail::is_shaped<Law, Space>) detail::explain(law.shapers(), e, x, T, late);
  }

  /// The displayed stiffness of a surface of K [N/m], in the same loop.
  [[nodiscard]] constexpr scalar shown_stiffness(scalar K, scalar T, int late) const noexcept {
    const law_type law = law_for(K, T, late);
    explanation e;
    e.asked = e.shown = static_cast<double>(scalar(1) / law.depth(scalar(1), scalar(0)));
    if constexpr (detail::is_shaped<Law, Space>) detail::explain(law.shapers(), e, K, T, late);
    return static_cast<scalar>(e.shown);
  }

  /// Takes the environment's newest constraint. Returns false if it is unusable; then the last good one stays.
  template <class Owner = Supply>
  requires(Owner::moves) constexpr bool update(const constraint_type& next) noexcept {
    if constexpr (eases) own_.expect(supply_.target(), supply_.changed());
    return supply_.update(next);
  }
  /// The same, with the surface's velocity and age. What is not finite, or older than the last update, is refused.
  template <class Owner = Supply>
  requires(Owner::moves&& detail::eases_news<part_at<Law, Space>>) constexpr bool update(
      const constraint_type& next, const surface_motion<Space>& how) noexcept {
    if (!own_.accepts(how, supply_.published(), supply_.changed())) {
      supply_.refuse();
      return false;
    }
    if (!update(next)) return false;
    own_.state(how);
    return true;
  }
  /// Removes the surface: the contact fades as with stale data, and ends.
  template <class Owner = Supply>
  requires(Owner::moves) constexpr void release() noexcept { supply_.release(); }

  [[nodiscard]] constexpr const constraint_type& local() const noexcept { return supply_.local(); }
  [[nodiscard]] constexpr const constraint_type& target() const noexcept {
    return supply_.target();
  }
  [[nodiscard]] constexpr const law_type& law() const noexcept { return law_; }

  /// The desired force, and the state of the contact that answered() needs.
  struct request {
    vector wanted;         ///< desired force after the shapers [N]
    bool nothing;          ///< true without contact; then only `weight` is defined below
    vector desired;        ///< force of the law, before the shapers [N]
    bool in_local;         ///< the device touches the local model, which then moves from its place
    bool following;        ///< the own surface has not reached the target yet
    scalar weight;         ///< factor of the force, in [0, 1]
    scalar felt;           ///< depth in the law [m]
    scalar outward_speed;  ///< [m/s]
    vector here;           ///< [m]
    vector normal;
  };

  /// The desired force of a tick. `what` becomes worse if the supply's data are missing, bad or stale. With a
  /// `Shortcut`, for a bound that only reduces, a tick without contact returns at once.
  template <bool Shortcut>
  [[nodiscard, gnu::always_inline]] constexpr request ask(const auto& motion, const auto& port,
                                                          event& what) noexcept {
    using state = std::remove_cvref_t<decltype(port)>;
    const vector here = motion.position;
    const auto told = supply_.target().at(here);
    if constexpr (eases) pursue(told, here, port);
    const auto newest = own_.newest(told, here);
    const scalar depth = own_.depth(newest.depth);
    const scalar weight = presence(depth, port.dt, what);
    const bool behind = weight > scalar(0) && depth > scalar(0);
    const bool in_target = behind && newest.covered();
    bool from_the_side = false;  // x was behind the surface but outside its edges in the last tick
    if constexpr (Supply::moves) from_the_side = std::exchange(beside_, behind && !in_target);
    [[maybe_unused]] const law_type before = law_;  // with the stiffness up to now
    if constexpr (!eases) {
      if (fresh())
        detail::tell(law_, supply_.target().stiffness, port.longest_tick, state::latency);
    }
    if constexpr (requires { law_.follow(in_target, port); }) law_.follow(in_target, port);
    if constexpr (Shortcut && shapers_keep_zero<state>()) {
      if (!in_target) {
        if constexpr (eases) law_.let_go();
        const vector zero = Space::zero();
        return {zero, true, zero, false, false, weight, scalar(0), scalar(0), zero, zero};
      }
    }

    const auto own = in_own(here, depth, in_target && !from_the_side);
    const vector goal = newest.outward();
    const vector normal = turned(goal, own.touched, here, depth, port);
    const scalar speed = damped_speed(motion.along(normal), in_target, port.dt);
    scalar felt = in_target ? depth : scalar(0);
    scalar asked = in_target ? weight * law_.force(felt, speed) : scalar(0);
    const scalar both = scalar(2) * asked + felt;  // twice: a unit normal may be an ulp too long
    if (!kernels::is_finite(both)) [[unlikely]] {
      asked = felt = scalar(0);
      what = detail::unusable(what);
    }
    const vector desired = Space::scaled(normal, asked);
    vector wanted = desired;
    if constexpr (detail::is_shaped<Law, Space>) {
      contact_state<Space> contact{normal,       supply_.target().stiffness,      own.depth,
                                   newest.depth, local_force(before, own, speed), fresh()};
      if constexpr (Law::needs_velocity) contact.velocity = detail::velocity_of<Space>(motion);
      wanted = detail::applied<Space>(law_.shapers(), desired, contact, port).force;
      if constexpr (!shapers_reduce<state>()) {
        if (!Space::is_finite(wanted)) [[unlikely]] {
          wanted = Space::zero();
          what = detail::unusable(what);
        }
      }
    }
    return {wanted,
            false,
            desired,
            own.touched,
            in_target && (own_.lags() || own_.is_curved() || !(normal == goal)),
            weight,
            felt,
            speed,
            here,
            normal};
  }

  /// Moves the local model to the depth of the bounded force.
  [[gnu::always_inline]] constexpr result_type answered(const request& r,
                                                        const port_result<Space>& port) noexcept {
    if (r.nothing) {
      if constexpr (Supply::moves) {
        supply_.sync();
        supply_.seen(r.weight);
      }
      return {port.force, scalar(0), port.energy, port.what, false};
    }
    const bool limited = detail::is_shaped<Law, Space> ? !(port.force == r.desired) : port.limited;
    scalar felt = r.felt;
    event what = port.what;
    if constexpr (Supply::moves) {
      if (limited) {
        felt = law_.depth(Space::dot(port.force, r.normal), r.outward_speed);
        if (!kernels::is_finite(felt)) felt = scalar(0);  // more than K d over a K next to nothing
        what = detail::cut_short(port);
      }
      if (limited || r.following) {
        supply_.approach(r.in_local, r.here, r.normal, felt);
      } else {
        supply_.sync();
      }
      supply_.seen(r.weight);
    }
    return {port.force, felt, port.energy, what, limited};
  }

  /// A tick of length dt [s] whose sample was rejected.
  constexpr result_type refused(const port_result<Space>& port, scalar dt) noexcept {
    if constexpr (Supply::moves) {
      supply_.grow_older(dt);
      if (port.what == event::forces_off) supply_.vanish();
    }
    own_.grow_older(dt);
    return {port.force, scalar(0), port.energy, port.what, false};
  }

 private:
  static constexpr bool eases = Supply::moves && detail::eases_news<law_type>;
  struct none {};  ///< in place of a member that is left out, so that it takes no bytes
  /// The law for a surface of K [N/m].
  [[nodiscard]] constexpr law_type law_for(scalar K, scalar T, int late) const noexcept {
    law_type law = law_;
    detail::tell(law, K, T, late);
    return law;
  }
  [[nodiscard]] static constexpr softened_by softener(const law_type& law) noexcept {
    if constexpr (requires { law.lowers(); }) {
      const softened_by why = law.lowers();
      if (why != softened_by::nothing) return why;
    }
    if constexpr (requires { law_type::softener; }) return law_type::softener;
    return softened_by::nothing;
  }
  template <class State>
  [[nodiscard]] static constexpr bool shapers_reduce() noexcept {
    if constexpr (detail::is_shaped<Law, Space>) {
      return detail::reduces<typename Law::sequence_type, Space, contact_state<Space>, State>();
    }
    return true;
  }
  /// True if the shapers only reduce and have no state, so that they need not be called for zero force.
  template <class State>
  [[nodiscard]] static constexpr bool shapers_keep_zero() noexcept {
    if constexpr (detail::is_shaped<Law, Space>) {
      using shapers = typename Law::sequence_type;
      return shapers_reduce<State>() &&
             detail::keeps_nothing<shapers, Space, contact_state<Space>, State>();
    }
    return true;
  }

  /// The factor of the force, in [0, 1]: below 1 while stale data fade, 0 before the first target.
  [[nodiscard]] constexpr scalar presence([[maybe_unused]] scalar depth, scalar dt,
                                          event& what) noexcept {
    if constexpr (Supply::moves) {
      if (supply_.refused()) what = detail::worse_yet(what, event::rejected_target);
      if (!supply_.published()) [[unlikely]] {
        what = detail::worse_yet(what, event::no_target);
        return scalar(0);
      }
      if (!supply_.changed()) supply_.grow_older(dt);
      if (supply_.current()) [[likely]]
        return scalar(1);
      if (supply_.stale()) what = detail::worse_yet(what, event::stale_target);
      if constexpr (eases) return faded(supply_.weight(), depth, dt);
      return supply_.weight();
    } else {
      return scalar(1);
    }
  }
  [[nodiscard]] constexpr bool fresh() const noexcept {
    if constexpr (Supply::moves) return supply_.changed();
    return false;
  }
  /// The part of the outward speed that the law damps: an eased law's swinging(), else all of it.
  [[nodiscard, gnu::always_inline]] constexpr scalar damped_speed(
      scalar outwards, [[maybe_unused]] bool touched, [[maybe_unused]] scalar dt) noexcept {
    if constexpr (eases) {
      if (touched) return law_.swinging(outwards, dt);
      law_.let_go();
    }
    return outwards;
  }
  /// Moves the own surface on by a tick, and takes an update.
  [[gnu::always_inline]] constexpr void pursue(const auto& told, const vector& x,
                                               const auto& port) noexcept {
    own_.grow_older(port.dt);
    if (fresh() || own_.lags()) [[unlikely]]
      follow(told, x, port);
  }
  [[gnu::noinline]] constexpr void follow(const auto& told, const vector& x,
                                          const auto& port) noexcept {
    own_.follow(port);
    if (!fresh()) return;
    const law_type before = law_;
    adopt(port.longest_tick, std::remove_cvref_t<decltype(port)>::latency);
    own_.hear(supply_.target(), told, x, supply_.last_weight(), before, law_);
  }
  /// The factor of an eased contact that fades, whose force falls at a limited rate.
  [[nodiscard, gnu::noinline]] constexpr scalar faded(scalar weight, scalar depth,
                                                      scalar dt) const noexcept {
    const scalar whole = law_.force(depth, scalar(0));
    if (!(whole > scalar(0))) return weight;
    return kernels::larger(weight, supply_.last_weight() - law_.pace().most() * dt / whole);
  }

  /// The depth of x in the local model, and whether it is touched there.
  struct local_touch {
    scalar depth;  ///< [m]
    bool touched;
  };
  /// A contact from the side, or one that has just appeared, is treated as an update (A18).
  [[nodiscard, gnu::always_inline]] constexpr local_touch in_own(const vector& x, scalar depth,
                                                                 bool touched) const noexcept {
    if constexpr (Supply::moves) {
      if (!supply_.together()) {
        const auto own = supply_.local().at(x);
        depth = own.depth;
        touched = depth > scalar(0) && own.covered();
      }
      return {depth, touched && supply_.last_weight() > scalar(0)};
    } else {
      return {depth, false};
    }
  }
  [[nodiscard, gnu::always_inline]] constexpr vector turned(const vector& goal, bool touched,
                                                            const vector& x,
                                                            [[maybe_unused]] scalar depth,
                                                            const auto& port) const noexcept {
    if constexpr (Supply::moves) {
      if (touched && !supply_.together()) {
        vector own = supply_.local().at(x).outward(), towards = goal;
        if constexpr (eases) {
          own_.take_on(own, towards, port.travel, port.dt);
          if constexpr (requires { normals_.rate(); }) {
            return normals_.step_by(own, towards, gentle_turn(depth, port.dt));
          }
        }
        return normals_.step(own, towards, port.dt);
      }
    }
    return goal;
  }
  /// The largest turn of the normal in dt [rad]: its rate or, under a small force, what turns it by R_usual dt/2 [N].
  [[nodiscard]] constexpr scalar gentle_turn(scalar depth, scalar dt) const noexcept {
    const scalar pressed = law_.force(depth, scalar(0));
    const scalar not_felt = scalar(0.5) * law_.pace().usual() * dt;
    const scalar at_its_rate = normals_.rate() * dt;
    if (!(not_felt > at_its_rate * pressed)) return at_its_rate;
    return not_felt < pressed * scalar(0.5) ? not_felt / pressed
                                            : kernels::larger(at_its_rate, scalar(0.5));
  }
  /// The force of the local model, by the law of the last tick [N].
  [[nodiscard]] constexpr scalar local_force([[maybe_unused]] const law_type& before,
                                             [[maybe_unused]] const local_touch& own,
                                             [[maybe_unused]] scalar speed) const noexcept {
    if constexpr (Law::needs_local_model) {
      if (own.touched) return supply_.last_weight() * before.force(own.depth, speed);
    }
    return scalar(0);
  }

  Supply supply_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS normals_type normals_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS law_type law_;
  /// x was behind the surface, but outside its edges; this is needed for a supply that moves only.
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS std::conditional_t<Supply::moves, bool, none> beside_{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS
  std::conditional_t<eases, own_surface<Space, constraint_type>, surface_as_told<Space>> own_;
};

/// The space is that of the constraint.
template <class Supply, class Normals, class Law>
local_contact(Supply, Normals, Law)
    -> local_contact<typename detail::space_of<Supply>::type, Supply, Normals, Law>;
/// The deduction guide for a local_contact without a law, so that the compiler names what is missing.
template <class Supply, class Normals>
local_contact(Supply, Normals)
    -> local_contact<typename detail::space_of<Supply>::type, Supply, Normals, detail::left_out>;

}  // namespace v0
}  // namespace passive_haptics
