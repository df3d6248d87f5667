// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The concept of each role, on one page. Properties that a concept cannot check are laws in laws.hpp.
//
//   the port                                                       port/
//     port                  pose, motion, effort, work             space.hpp, joint_space.hpp, ...
//     damping               the energy that the device dissipates  damping.hpp
//     inertia               limits the motion within a tick        inertia.hpp
//     energy observer       the ledger of the port's energy E1     energy_observer/
//     force bound           how much force that energy allows      force_bound/
//     motion estimator      position and velocity of the device    last_difference.hpp, ...
//   the desired effort
//     source                a desired effort for every tick        local_contact, contacts, ...
//   a contact                                                      contact/
//     surface               a piece of a surface: plane, quadric   constraint_geometry/
//     constraint geometry   a surface that a local model follows   constraint_geometry/
//     supply                owns the constraint and moves it       constraint_geometry/
//     normal interpolation  how fast the contact normal may turn   normal_interpolation/
//     contact law           depth and speed to desired force       contact/
//     shaper                changes the force by the contact       shaper/
//   around it
//     haptic device         position out, force in                 simulation/, falcon_hid.hpp
//
// A part is a struct of parameters with a template `on<Port>` that computes (parameter.hpp), or, where
// it is written for one port, a struct that computes by itself. Every part is a plain value and never
// throws. check() names the first parameter out of its range; a part with state has reset(), which restores
// the initial state. Only energy observers and force bounds state `passivity`.

#include <passive_haptics/base/event.hpp>
#include <passive_haptics/base/explanation.hpp>
#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/device/damping.hpp>
#include <passive_haptics/device/device_sample.hpp>
#include <passive_haptics/device/space.hpp>
#include <passive_haptics/port/port_state.hpp>

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace passive_haptics {
inline namespace v0 {

// Optional members of a part, which `if constexpr` looks for:
//
//   member                  of which part        read by               default without it
//   parameters(), check()   any part             the port's check()    it has no parameters
//   set(parameters)         any part             the port's set()      it is constructed again: it has no state
//   takers<X>, take(x)      part with parts      the port's set()      none of its parts takes parameters X
//   reset()                 any part             the port's reset()    it has no state
//   turns                   port, observer       passive_port          false: the work of a turn is exact
//   reports_work            port                 passive_port          false: the work is effort times motion
//   geometry                port                 parts with lengths    joints: a motion has no length
//   angular(motion)         port                 rigid_… parts         it does not turn
//   place(pose)             port                 guard                 the pose is the position
//   moved(pose, motion)     port                 the laws              pose + motion
//   unsure(Δx, f, dt)       damping              ledgers, port_state   the work of a turn is exact
//   friction_…, most_…      damping that rubs    dual_ledger           no friction is credited
//   update(Δx, effort and   observer             passive_port          it does not compile at a reported_work
//     work, dt)
//   travel_error()          observer, not exact  passive_port          0: the measured motion is exact
//   overdrawn()             observer             passive_port, event   a value below zero is a debt
//   disturbed()             observer             passive_port, at a    it does not respond to faults
//                                                refusal or a late tick
//   remembers(), tells(e,   observer             passive_port, event   there is no wall_lost and no wall_back
//     cut)
//   can_hold(f)             bound                tick(device_sample)   every finite force may have been held
//   explain(e, b, T, k)     bound                the port's explain()  it does not limit the stiffness
//   explain(e, x, T, k)     source               passive_port          the port has no explain()
//   softener                law                  local_contact         its stiffness is the surface's
//   unseen(seen, damping,   bound, beside one    passive_port, after   every motion is possible
//     f, t), most_held()    with most_held()     lost samples
//   watching()              bound                passive_port          its assumptions are not tested against the
//                                                                      motion (force_bound/watched.hpp)
//   passivity               bound, or on<Port>   passive_port          the other one has it
//   apply(f, states…)       sequence of parts    applied()             limit() or shape() is called
//   only_reduces<States…>   sequence of parts    passive_port          true if limit() or shape() returns a share
//   stateless<States…>      sequence of parts    passive_port          true if limit() or shape() is const
//   adopt(K, T, k)          law                  local_contact         it is called as adopt(K, T), and does
//                                                                      not depend on the latency
//   adopt(T), adopt(T, k)   source, shaper       passive_port, when T  its state does not depend on T, on the
//                                                or a parameter is new latency k or on a parameter
//   update(effort)          source               tick(…, wanted)       that tick does not compile
//   needs_ledger            source, law          passive_port          false: it needs no ledger
//   depth                   result of a source   contacts, scope       it has no depth
//   travel, dt              estimate of motion   contact_set           along() is called for each axis
//   needs_local_model       law; every shaper    local_contact         false: the supply may be fixed
//   needs_velocity          shaper               local_contact         false: its contact has velocity 0
//   shapers()               law                  local_contact         it has no shapers
//   kind                    surface              contact_set           faceted
//   push()                  probe of a surface   contact_set, the laws its force is along outward()
//   around()                surface              the laws              they try it within 1 m of the origin
//   prepare()               field                distance_field        it needs no preparation
//   set(freshness)          supply               the port's set()      it does not age

/// A value that can be logged, sent and copied: trivially copyable if the scalar is.
template <class V, class Port>
concept plain_value = std::is_trivially_copyable_v<V> ||
    (!std::is_trivially_copyable_v<typename Port::scalar> &&
     std::is_nothrow_copy_constructible_v<V>);

/// The coordinates of a device, in which effort times motion is energy [J]. between() is the motion from one pose to
/// another, work() the work of an effort over it, squared() the square of its length or of its fastest joint.
/// `stored_` types are for storing the same values; a motion is stored as a stored_effort. A port in a space names
/// that space `geometry`. If poses are no vectors, place() returns their position.
template <class P>
concept port = requires(typename P::pose x, typename P::motion m, typename P::effort f, int i) {
  requires real<typename P::scalar>;
  { P::dof } -> std::convertible_to<int>;
  { P::zero() } -> std::convertible_to<typename P::effort>;
  { P::between(x, x) } -> std::same_as<typename P::motion>;
  { P::work(f, m) } -> std::same_as<work_done<typename P::scalar>>;
  { P::squared(m) } -> std::same_as<typename P::scalar>;
  { P::is_finite(x) } -> std::same_as<bool>;
  { P::is_finite(f) } -> std::same_as<bool>;
  requires plain_value<typename P::stored_pose, P>;
  requires plain_value<typename P::stored_effort, P>;
  requires std::convertible_to<typename P::stored_pose, typename P::pose>;
  requires std::convertible_to<typename P::stored_effort, typename P::effort>;
};

namespace detail {
/// True if the work of a held torque may differ from τ·θ: the port turns, and the work is not reported.
template <class P>
[[nodiscard]] constexpr bool turns() noexcept {
  if constexpr (requires { P::turns; }) return P::turns;
  return false;
}
/// True if the driver reports the work of its motors (reported_work.hpp).
template <class P>
[[nodiscard]] constexpr bool reports_work() noexcept {
  if constexpr (requires { P::reports_work; }) return P::reports_work;
  return false;
}
/// The effort held over a tick, with the reported work.
template <class P>
struct reported_effort {
  typename P::stored_effort force{};
  typename P::scalar work{};  ///< [J]
};
template <class P>
using held_at =
    std::conditional_t<reports_work<P>(), reported_effort<P>, typename P::stored_effort>;
template <class P>
[[nodiscard, gnu::always_inline]] constexpr const typename P::stored_effort& force_of(
    const held_at<P>& held) noexcept {
  if constexpr (reports_work<P>()) {
    return held.force;
  } else {
    return held;
  }
}
}  // namespace detail

/// dissipated(Δx, dt) [J] is a lower bound of the energy that the device takes; worst_outflow(f, T) [J] is the most
/// energy that f can give out in T, its convex conjugate; affordable(f, E, T) is the share of f that E covers. `rubs`
/// is true if dry friction is credited; dissipated() and worst_outflow() then assume that it is rigid, and
/// friction_certificates.hpp accounts for its elasticity. At a port that turns, the gain of a tick is at least
/// dissipated() − f·Δx − unsure(Δx, f, dt) [J].
template <class D, class P>
concept damping_for = requires(const part_at<D, P> d, const typename P::motion m,
                               const typename P::effort f, typename P::scalar s) {
  { d.dissipated(m, s) } -> std::same_as<typename P::scalar>;
  { d.worst_outflow(f, s) } -> std::same_as<typename P::scalar>;
  { d.affordable(f, s, s) } -> std::same_as<typename P::scalar>;
  { part_at<D, P>::rubs } -> std::convertible_to<bool>;
  requires noexcept(d.dissipated(m, s));
  requires noexcept(d.worst_outflow(f, s));
};

/// norm(f) = √(fᵀM⁻¹f) [√J/s], M a lower bound of the device's inertia in every direction.
template <class M, class P>
concept inertia_for = requires(const part_at<M, P> m, const typename P::effort f) {
  { m.norm(f) } -> std::same_as<typename P::scalar>;
  requires noexcept(m.norm(f));
};

/// update() books one tick: the motion, the effort held during it, its length [s]. If the energy would not be finite,
/// it books nothing and returns false. forfeit() writes off a tick whose motion is unknown and never raises the
/// ledger; its optional third number [J] limits the loss, and an optional fourth number [J] of update() the error of
/// the work of a turn. value() is E1 [J]. `counts` is false for no_observer; `exact` is false if positions are known
/// to a step only. An observer for reported work takes it with the effort; one for the error of a turn has `turns`.
template <class O, class P>
concept energy_observer_for = plain_value<part_at<O, P>, P> &&
    requires(part_at<O, P> o, const part_at<O, P> c, const typename P::motion m,
             const typename P::effort f, typename P::scalar s) {
  { O::passivity } -> std::convertible_to<guarantee>;
  { O::counts } -> std::convertible_to<bool>;
  { O::exact } -> std::convertible_to<bool>;
  { o.update(m, f, s) } -> std::same_as<bool>;
  { o.forfeit(f, s) } -> std::same_as<void>;
  { c.value() } -> std::same_as<typename P::scalar>;
  { c.damping().worst_outflow(f, s) } -> std::same_as<typename P::scalar>;
  requires noexcept(o.update(m, f, s));
  requires noexcept(o.forfeit(f, s));
  requires noexcept(c.value());
};

/// The requirements of a force bound. A member that is not stated has the most cautious value:
///     static constexpr bound_traits traits{.needs_ledger = true, .latency = any_latency};
struct bound_traits {
  bool needs_ledger = false;   ///< it spends energy that an observer has to count
  bool exact_travel = true;    ///< it assumes exact Δx, so it is not for encoders with steps
  int latency = 0;             ///< the largest latency for which it is proved [ticks]
  bool turns = false;          ///< it is proved for a port that turns
  bool reported_work = false;  ///< it reads the ledger only, so the work may be reported
};
inline constexpr int any_latency = kernels::largest<int>();

namespace detail {
/// True if size ≤ 2 `most`, with a factor of 2 for the uncertainty of the motors' limit; false for NaN.
template <class Scalar>
[[nodiscard]] constexpr bool can_be_held(Scalar size, Scalar most) noexcept {
  return size * Scalar(0.5) <= most;
}
/// The longest force for which that is true, along the first axis.
template <class Space>
[[nodiscard]] constexpr typename Space::effort longest_held(typename Space::scalar most) noexcept {
  typename Space::effort f = Space::zero();
  Space::component(f, 0) = typename Space::scalar(2) * most;
  return f;
}
/// A damping for any port, for concepts.
template <class P>
using some_damping = typename diagonal_damping<P::dof>::template on<P>;
/// The last tick with a known motion, and the effort held.
template <class P>
struct seen_tick {
  typename P::scalar square;        ///< |Δx|² over it (P::squared)
  typename P::scalar dt;            ///< T₀ [s]
  typename P::scalar travel_error;  ///< largest distance of the true Δx from the measured one
  typename P::stored_effort held;   ///< at least as long as any effort held then or since
};
/// The most work that a force can have done between samples.
template <class Scalar>
struct unseen_work {
  Scalar done;    ///< the work [J]
  Scalar beside;  ///< the most by which f·Ω exceeds f·θ, at a port that turns [J]
};
/// Satisfied by a bound that limits the motion between samples.
template <class Part, class P>
concept knows_reach = requires(const Part p, const seen_tick<P> seen, const some_damping<P> d,
                               const typename P::effort f, typename P::scalar t) {
  p.unseen(seen, d, f, t);
};
}  // namespace detail

/// The requirements of a bound; one without a guarantee has none.
template <class Bound>
[[nodiscard]] constexpr bound_traits assumptions_of() noexcept {
  bound_traits all = Bound::traits;
  if constexpr (requires { Bound::passivity; }) {
    if (Bound::passivity == guarantee::none) {
      all.exact_travel = false;
      all.turns = all.reported_work = true;
      all.latency = any_latency;
    }
  }
  return all;
}

/// Satisfied by a bound that states its guarantee, either itself or, as a chain does, at a port.
template <class Bound, class P>
concept promises = requires {
  part_at<Bound, P>::passivity;
}
|| requires {
  Bound::passivity;
};
template <class Bound, class P>
requires promises<Bound, P>
[[nodiscard]] constexpr guarantee promise_of() noexcept {
  if constexpr (requires { part_at<Bound, P>::passivity; }) {
    return part_at<Bound, P>::passivity;
  } else {
    return Bound::passivity;
  }
}

namespace detail {
/// The answer of a bound: an effort if axes are damped unequally, because it turns then, else a share.
template <class State, class P>
using what_is_left = std::conditional_t<differs_by_axis<typename State::damping_type, P>,
                                        typename P::effort, share<typename P::scalar>>;
}  // namespace detail

/// limit() takes the desired effort and a port_state, and returns a share of that effort, or another effort.
template <class B, class P, class State = port_state<P, detail::some_damping<P>>>
concept force_bound_for = plain_value<part_at<B, P>, P> &&
    requires(part_at<B, P> b, const typename P::effort f, const State s) {
  { promise_of<B, P>() } -> std::same_as<guarantee>;
  { B::traits } -> std::convertible_to<bound_traits>;
  requires std::same_as<decltype(b.limit(f, s)), share<typename P::scalar>> ||
      std::same_as<decltype(b.limit(f, s)), typename P::effort>;
  requires noexcept(b.limit(f, s));
};

/// estimate() takes the measured pose, the motion, the effort held during it, its length [s], and whether the motion
/// is known; it returns `position` and, in a space, along(n), the speed along a unit vector [m/s].
template <class M, class P>
concept motion_estimator_for = plain_value<part_at<M, P>, P> &&
    requires(part_at<M, P> m, const typename P::pose x, const typename P::motion dx,
             const typename P::effort f, typename P::scalar s) {
  { m.estimate(x, dx, f, s, true).position } -> std::convertible_to<typename P::pose>;
  requires noexcept(m.estimate(x, dx, f, s, true));
};

/// The result of a tick, from which the source makes its own result.
template <class P>
struct port_result {
  typename P::effort force;     ///< effort on the device [N]; joints: [N·m]
  typename P::scalar energy;    ///< E1 [J]
  event what = event::nominal;  ///< the worst event of the tick
  bool limited = false;         ///< the bound changed the desired effort
};

namespace detail {
/// The event of a contact whose force was reduced: started_inside, if the ledger is empty and the force zero.
template <class P>
[[nodiscard]] constexpr event cut_short(const port_result<P>& port) noexcept {
  if (port.energy > typename P::scalar(0) || port.what != event::nominal) return port.what;
  return port.force == P::zero() ? event::started_inside : event::nominal;
}
/// Satisfied by the result of a source with the depth of a contact.
template <class R>
concept says_depth = requires(const R r) {
  r.depth;
};
/// Satisfied by a source that takes a desired effort from the caller.
template <class S, class P>
concept takes_efforts = requires(S s, const typename P::effort f) {
  s.update(f);
};
/// Satisfied by a probe with push(), the direction of its force, which differs from outward().
template <class Probe>
concept says_push = requires(const Probe p) {
  p.push();
};
/// The least that a motion estimator returns, for concepts.
template <class P>
struct some_estimate {
  typename P::stored_pose position;
  [[nodiscard]] typename P::scalar along(const typename P::motion& n) const noexcept;
};
/// The velocity of an estimate [m/s]: travel over dt, or axis by axis if the estimate has no travel.
template <class P>
[[nodiscard, gnu::always_inline]] constexpr typename P::vector velocity_of(
    const auto& motion) noexcept {
  using scalar = typename P::scalar;
  if constexpr (requires { motion.travel / motion.dt; }) {
    return motion.travel * (scalar(1) / motion.dt);
  } else {
    typename P::vector v = P::zero();
    for (int i = 0; i < P::dof; ++i) {
      typename P::vector axis = P::zero();
      P::component(axis, i) = scalar(1);
      P::component(v, i) = motion.along(axis);
    }
    return v;
  }
}
/// A placeholder for a missing part, by which the compiler names it.
struct left_out {};
}  // namespace detail

/// ask<Shortcut>() takes the estimate of the motion, the port_state and the event so far, which it may make worse,
/// and returns a request: `wanted`, the desired effort, and `nothing`, true if there is nothing to bound. With a
/// Shortcut it may return early for a zero effort. answered() takes the request and the bounded effort, refused() a
/// tick of length dt [s] whose sample was rejected; both return the result of the tick. `asks_for_numbers` is true if
/// `wanted` is always finite, so that the port need not check it.
template <class S, class P, class State = port_state<P, detail::some_damping<P>>>
concept source_for = plain_value<part_at<S, P>, P> && requires {
  typename part_at<S, P>::request;
  typename part_at<S, P>::result_type;
} && requires(part_at<S, P> s, const typename part_at<S, P>::request asked,
              const detail::some_estimate<P> motion, const State state, event what,
              const port_result<P> r, typename P::scalar dt) {
  { part_at<S, P>::asks_for_numbers } -> std::convertible_to<bool>;
  { asked.wanted } -> std::convertible_to<typename P::effort>;
  { asked.nothing } -> std::convertible_to<bool>;
  { s.template ask<true>(motion, state, what) } -> std::same_as<typename part_at<S, P>::request>;
  { s.answered(asked, r) } -> std::same_as<typename part_at<S, P>::result_type>;
  { s.refused(r, dt) } -> std::same_as<typename part_at<S, P>::result_type>;
  requires noexcept(s.template ask<true>(motion, state, what));
  requires noexcept(s.template ask<false>(motion, state, what));
  requires noexcept(s.answered(asked, r));
  requires noexcept(s.refused(r, dt));
};

/// The limits of a loop: `latency` [ticks], traits, the guarantee in it, the type of guard and, at a port, T [s].
template <class L, class P>
concept limits_for = requires(const part_at<L, P> l) {
  { L::latency } -> std::convertible_to<int>;
  { L::traits.learns } -> std::convertible_to<bool>;
  { L::traits.watched } -> std::convertible_to<bool>;
  { L::passivity } -> std::convertible_to<guarantee>;
  typename L::template guard_type<P>;
  { l.longest_tick } -> std::convertible_to<typename P::scalar>;
};

/// How the normal of a surface changes along it: not at all, smoothly with its curvature, or in jumps. The default is
/// faceted, for which no turn of the normal counts as curvature.
enum class surface_kind : std::uint8_t { flat, smooth, faceted };

template <class G>
[[nodiscard]] constexpr surface_kind kind_of() noexcept {
  if constexpr (requires { G::kind; }) return G::kind;
  return surface_kind::faceted;
}

/// A piece of a surface that the environment publishes, as a value that can be passed between threads. prepare()
/// normalises it and returns false if it is unusable. at(x) returns a probe: `depth` [m], > 0 inside; outward(), the
/// unit normal; covered(), the edge test. If depth is not the distance to the surface, its gradient is not the normal:
/// then the probe has push() = −∇depth, and the force K·depth·push() is conservative (docs/design/contacts.md).
template <class G, class Space>
concept surface_for = plain_value<G, Space> && std::default_initializable<G> &&
    requires(G g, const G c, const typename Space::vector v, typename Space::scalar s) {
  { c.stiffness } -> std::convertible_to<typename Space::scalar>;
  { g.prepare() } -> std::same_as<bool>;
  { c.at(v).depth } -> std::convertible_to<typename Space::scalar>;
  { c.at(v).outward() } -> std::convertible_to<typename Space::vector>;
  { c.at(v).covered() } -> std::same_as<bool>;
  requires noexcept(g.prepare());
  requires noexcept(c.at(v));
};

/// A surface that the local model of the thesis can follow: toward(target, x, n, d) is the same piece, moved and turned
/// so that x lies d [m] deep under the normal n, any unit vector. Its depth falls by s when x moves by s along n.
template <class G, class Space>
concept constraint_for = surface_for<G, Space> &&
    requires(const G c, const typename Space::vector v, typename Space::scalar s) {
  { c.toward(c, v, v, s) } -> std::same_as<G>;
};

/// local() is the constraint of the local model, target() the environment's newest. A supply that `moves` also takes
/// updates with update(), ends the contact with release(), and ages: weight() is the factor of the force, in [0, 1],
/// and last_weight() that of the last tick. A tick reads changed(), moves the local model with approach() or sync(),
/// and ends with seen(). (constraint_geometry/followed.hpp)
template <class S, class Space>
concept supply_for = requires(part_at<S, Space> s, const part_at<S, Space> c,
                              const typename Space::vector v, typename Space::scalar d) {
  typename S::constraint_type;
  { S::moves } -> std::convertible_to<bool>;
  { c.local() } -> std::same_as<const typename S::constraint_type&>;
  { c.target() } -> std::same_as<const typename S::constraint_type&>;
  requires !S::moves || requires {
    { s.update(c.target()) } -> std::same_as<bool>;
    { s.release() } -> std::same_as<void>;
    { c.published() } -> std::same_as<bool>;
    { c.changed() } -> std::same_as<bool>;
    { c.refused() } -> std::same_as<bool>;
    { c.current() } -> std::same_as<bool>;
    { c.stale() } -> std::same_as<bool>;
    { c.together() } -> std::same_as<bool>;
    { c.weight() } -> std::same_as<typename Space::scalar>;
    { c.last_weight() } -> std::same_as<typename Space::scalar>;
    { s.grow_older(d) } -> std::same_as<void>;
    { s.seen(d) } -> std::same_as<void>;
    { s.approach(true, v, v, d) } -> std::same_as<void>;
    { s.sync() } -> std::same_as<void>;
  };
};

/// step() returns the unit normal to use after dt [s] on the way from one unit normal to another.
template <class N, class Space>
concept normal_interpolation_for = plain_value<part_at<N, Space>, Space> &&
    requires(part_at<N, Space> n, const typename Space::vector v, typename Space::scalar s) {
  { n.step(v, v, s) } -> std::same_as<typename Space::vector>;
  requires noexcept(n.step(v, v, s));
};

/// adopt() takes a new stiffness [N/m] and the longest tick [s]; force() gives the desired force
/// [N] ≥ 0 from a depth [m] and the outward speed [m/s]; depth() is its inverse.
template <class L, class Space>
concept contact_law_for = plain_value<part_at<L, Space>, Space> &&
    requires(part_at<L, Space> l, const part_at<L, Space> c, typename Space::scalar s) {
  { l.adopt(s, s) } -> std::same_as<void>;
  { c.force(s, s) } -> std::same_as<typename Space::scalar>;
  { c.depth(s, s) } -> std::same_as<typename Space::scalar>;
  requires noexcept(l.adopt(s, s));
  requires noexcept(c.force(s, s));
  requires noexcept(c.depth(s, s));
};

/// The state of a contact, which a shaper may read beside that of the port.
template <class Space>
struct contact_state {
  typename Space::vector normal;  ///< outward normal of the local model, the direction of the force
  typename Space::scalar stiffness;     ///< K of the target [N/m]
  typename Space::scalar depth;         ///< depth in the local model, ≤ 0 outside [m]
  typename Space::scalar target_depth;  ///< depth in the environment's newest constraint [m]
  typename Space::scalar local_force;   ///< force of the law at `depth`, along `normal` [N]
  bool target_changed = false;          ///< a new constraint arrived since the last tick
  typename Space::vector velocity = Space::zero();  ///< of the device, if a shaper needs it [m/s]
};

/// shape() takes the desired force, the contact and the port, and returns a share or a force, as a bound does.
/// `needs_local_model`: it needs a local model that can move. `needs_ledger`: it spends energy, so one has to count it.
template <class H, class Space, class State = port_state<Space, detail::some_damping<Space>>>
concept shaper_for = plain_value<part_at<H, Space>, Space> &&
    requires(part_at<H, Space> h, const typename Space::vector f, const contact_state<Space> c,
             const State s) {
  { H::needs_local_model } -> std::convertible_to<bool>;
  { H::needs_ledger } -> std::convertible_to<bool>;
  requires std::same_as<decltype(h.shape(f, c, s)), share<typename Space::scalar>> ||
      std::same_as<decltype(h.shape(f, c, s)), typename Space::vector>;
  requires noexcept(h.shape(f, c, s));
};

namespace detail {
/// The functions of a spring that a frame uses, for concepts.
template <class Scalar>
struct some_spring {
  [[nodiscard]] Scalar yield(Scalar compliance) const noexcept;
  [[nodiscard]] Scalar softness() const noexcept;
  [[nodiscard]] Scalar lever() const noexcept;
};
}  // namespace detail

/// Where contacts are on a device, and what their forces do to it: what contact_set and rigid_tool differ in.
///     space, row, point, stored   where surfaces are; a force or a wrench; where on the device a contact is;
///                                 where the device was
///     naps                        surfaces out of reach may be left out of ticks; then apart(now, was) [m]
///     is_point(p), place(was, p)  is p usable; where it was [m]
///     now(motion, state, was)     a tick: at(p), a spot with its `position` [m]; velocity(spot) [m/s], and
///                                 along(spot, n) of it; travel(p, spot) [m]; row_of(spot, n); place(); and
///                                 moved(), of the whole device, as a row is laid out
///     coupling(spring)            A of the proxy (contact/proxy.hpp) [m/N]: inner(row, row, min(c_i, c_j)),
///                                 own(row, c); most_yield(p, c), K nᵀC n at most
///     size(spring, row)           of a force [N]
///     stretch(spring, row)        of a motion [m]
template <class F, class P, class State = port_state<P, detail::some_damping<P>>>
concept frame_for = plain_value<typename F::stored, P> &&
    std::default_initializable<typename F::point> &&
    requires(const typename F::point p, const typename F::stored was, const typename F::row row,
             const detail::some_estimate<P> motion, const State state,
             const detail::some_spring<typename P::scalar> spring, typename P::scalar s,
             const typename F::space::vector n) {
  { F::naps } -> std::convertible_to<bool>;
  { F::is_point(p) } -> std::same_as<bool>;
  { F::place(was, p) } -> std::convertible_to<typename F::space::vector>;
  { F::size(spring, row) } -> std::same_as<typename P::scalar>;
  { F::stretch(spring, row) } -> std::same_as<typename P::scalar>;
  { F::now(motion, state, was).at(p).position } -> std::convertible_to<typename F::space::vector>;
  requires requires(const decltype(F::now(motion, state, was)) now,
                    const decltype(F::now(motion, state, was).at(p)) spot) {
    { now.velocity(spot) } -> std::convertible_to<typename F::space::vector>;
    { now.along(spot, n) } -> std::same_as<typename P::scalar>;
    { now.travel(p, spot) } -> std::convertible_to<typename F::space::vector>;
    { now.row_of(spot, n) } -> std::convertible_to<typename F::row>;
    { now.moved() } -> std::convertible_to<typename F::row>;
    { now.place() } -> std::convertible_to<typename F::stored>;
  };
  requires requires(const decltype(F::coupling(spring)) C) {
    { C.inner(row, row, s) } -> std::same_as<typename P::scalar>;
    { C.own(row, s) } -> std::same_as<typename P::scalar>;
    { C.most_yield(p, s) } -> std::same_as<typename P::scalar>;
  };
};

/// exchange() commands an effort and returns the newest sample of a simulated, replayed or real device.
template <class D, class P>
concept haptic_device_for = requires(D d, const typename P::effort f) {
  { d.exchange(f) } -> std::same_as<device_sample<P>>;
  requires noexcept(d.exchange(f));
};

}  // namespace v0
}  // namespace passive_haptics
