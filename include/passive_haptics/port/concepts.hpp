// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The contract of each role, on one page. What a concept cannot say is a law in laws.hpp.
//
//   the port                                                       port/
//     port                  pose, motion, effort, work             space.hpp, joint_space.hpp, ...
//     damping               what the device pays with              damping.hpp
//     inertia               what cannot turn round within a tick   inertia.hpp
//     energy observer       counts the energy at the port          energy_observer/
//     force bound           how much force that energy allows      force_bound/
//     motion estimator      where the device is and how fast       last_difference.hpp, ...
//   what is asked of it
//     source                an effort for every tick               local_contact, contacts, ...
//   a contact                                                      contact/
//     surface               a piece of the world: plane, quadric   constraint_geometry/
//     constraint geometry   one that the local model follows       constraint_geometry/
//     supply                who owns the constraint, who moves it  constraint_geometry/
//     normal interpolation  how fast the contact normal may turn   normal_interpolation/
//     contact law           depth and speed to desired force       contact/
//     shaper                what looks at the contact and the port shaper/
//   around it
//     haptic device         position out, force in                 simulation/, falcon_hid.hpp
//
// A part is a struct of parameters with a template `on<Port>` that computes (parameter.hpp), or, where
// it is written for one port, a struct that computes by itself. Every part is a plain value and never
// throws. check() names the first parameter out of its range; a part that keeps something from tick to
// tick has reset(), which puts it back. Only energy observers and force bounds state `passivity`.

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

// Besides its concept a part may have what stands here, and is asked for it by `if constexpr`:
//
//   hook                    who may have it      who reads it          what it means if there is none
//   parameters(), check()   any part             the port's check()    nothing of it can be out of range
//   set(parameters)         any part             the port's set()      it is made anew: no state is lost
//   takers<X>, take(x)      what has parts       the port's set()      no part of it takes parameters X
//   reset()                 any part             the port's reset()    it keeps nothing from tick to tick
//   turns                   port, observer       passive_port          false: every turn is a straight one
//   reports_work            port                 passive_port          false: the work is effort times motion
//   geometry                port                 who measures lengths  joints: no length, no direction
//   angular(motion)         port                 rigid_… parts         it does not turn
//   place(pose)             port                 guard                 the pose is where it is
//   moved(pose, motion)     port                 the laws              pose + motion
//   unsure(Δx, f, dt)       damping              ledgers, port_state   paths are straight
//   friction_…, most_…      damping that rubs    dual_ledger           no friction is credited
//   update(Δx, effort and   observer             passive_port          it fits no port that reports work
//     work, dt)
//   travel_error()          observer, not exact  passive_port          the motion shown is exact
//   overdrawn()             observer             passive_port, event   any value below zero is a debt
//   disturbed()             observer             passive_port, at a    faults are nothing to it
//                                                refusal or a late tick
//   remembers(), tells(e,   observer             passive_port, event   there is no wall_lost and no wall_back
//     cut)
//   can_hold(f)             bound                tick(device_sample)   any force that is a number may have been held
//   explain(e, b, T, k)     bound                the port's explain()  it softens nothing
//   explain(e, x, T, k)     source               passive_port          the port has no explain()
//   softener                law                  local_contact         it is no softer than the surface
//   unseen(seen, damping,   bound, beside one     passive_port, of what   any motion may have been
//     f, t), most_held()      that says this      nobody saw
//   watching()              bound                passive_port          what it rests on is not held against the
//                                                                      motion (force_bound/watched.hpp)
//   passivity               bound, on its port   passive_port          its `on<Port>` says it
//   apply(f, states…)       sequence of parts    applied()             limit() or shape() answers
//   only_reduces<States…>   sequence of parts    passive_port          what limit() or shape() returns says it
//   stateless<States…>      sequence of parts    passive_port          it is, if that is const
//   adopt(K, T, k)          law                  local_contact         it is called as adopt(K, T): latency is
//                                                                      nothing to it
//   adopt(T), adopt(T, k)   source               passive_port, when T  nothing that it keeps depends on T, on the
//                                                or a parameter is new k ticks of latency or on a parameter
//   update(effort)          source               tick(…, wanted)       there is no such tick
//   needs_ledger            source, law          passive_port          false: spends nothing of the ledger
//   depth                   result of a source   contacts, scope       there is no contact to be deep in
//   travel, dt              estimate of motion   contact_set           a speed is asked of it axis by axis
//   needs_local_model       law; every shaper    local_contact         false: the supply may be fixed
//   shapers()               law                  local_contact         nothing shapes its force
//   kind                    surface              contact_set           faceted
//   push()                  probe of a surface   contact_set, the laws its force acts along outward()
//   around()                surface              the laws              they look about the origin
//   prepare()               field                distance_field        there is nothing to prepare
//   set(freshness)          supply               the port's set()      it does not age

/// A value that can be logged, sent and snapshotted: trivially copyable where the scalar is.
template <class V, class Port>
concept plain_value = std::is_trivially_copyable_v<V> ||
    (!std::is_trivially_copyable_v<typename Port::scalar> &&
     std::is_nothrow_copy_constructible_v<V>);

/// What a device is: effort times motion is energy. between() is the motion from one pose to another,
/// work() what an effort did over it, squared() the square of its length or of its fastest joint.
/// `stored_` types are the same at rest; a motion at rest is a stored_effort. Geometry is apart: a port in
/// a space names it `geometry`. One whose poses are no vectors says by place() where they are.
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
/// May a held torque have done other work than τ·θ? So it is where a port turns and nobody reports the work.
template <class P>
[[nodiscard]] constexpr bool turns() noexcept {
  if constexpr (requires { P::turns; }) return P::turns;
  return false;
}
/// Does a driver report what its motors did (reported_work.hpp)?
template <class P>
[[nodiscard]] constexpr bool reports_work() noexcept {
  if constexpr (requires { P::reports_work; }) return P::reports_work;
  return false;
}
/// What was held over a tick: the effort, and at a port that reports it, the work.
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

/// dissipated(Δx, dt) [J] is never more than the device took; worst_outflow(f, T) [J] is the most that
/// f can hand out in T, the conjugate of it; affordable(f, E, T) is the share of f that E covers.
/// `rubs` says whether dry friction is credited; then dissipated() and worst_outflow() take it for rigid,
/// and what it owes beside them is in friction_certificates.hpp. Where a port
/// turns, unsure(Δx, f, dt) [J] is what a tick may have brought less than dissipated() − f·Δx.
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

/// update() books one tick: the motion, the effort held while it happened, its length [s]; false, and
/// nothing is booked, when the energy would be no finite number. forfeit() writes off a tick whose
/// motion is unknown and never raises the ledger; one that takes a third number [J] writes off no more than that,
/// and update() with a fourth takes no more than that for hidden by a turn. value() is E1 [J]. `counts` is false for the one
/// that counts nothing; `exact` is false for one that takes positions as known to a step only. One that
/// also books the work that a device reports takes it with the effort; one that books what is unsure of a
/// turn says `turns`.
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

/// What a force bound needs. What is not stated is taken as the worst:
///     static constexpr bound_traits traits{.needs_ledger = true, .latency = any_latency};
struct bound_traits {
  bool needs_ledger = false;   ///< it spends what an observer must have counted
  bool exact_travel = true;    ///< it takes Δx as exact: not for encoders with steps
  int latency = 0;             ///< most ticks of delay for which it holds
  bool turns = false;          ///< it holds at a port that turns
  bool reported_work = false;  ///< it reads nothing but the ledger: the work may be reported
};
inline constexpr int any_latency = kernels::largest<int>();

namespace detail {
/// Can motors that hold `most` have held a force of that size? Twice as much, for what is not known of them; no NaN.
template <class Scalar>
[[nodiscard]] constexpr bool can_be_held(Scalar size, Scalar most) noexcept {
  return size * Scalar(0.5) <= most;
}
/// The longest force of which that is so, along some axis.
template <class Space>
[[nodiscard]] constexpr typename Space::effort longest_held(typename Space::scalar most) noexcept {
  typename Space::effort f = Space::zero();
  Space::component(f, 0) = typename Space::scalar(2) * most;
  return f;
}
/// A damping that any port has, for asking whether a bound fits.
template <class P>
using some_damping = typename diagonal_damping<P::dof>::template on<P>;
/// The last tick that was seen, and what the motors hold.
template <class P>
struct seen_tick {
  typename P::scalar square;        ///< |Δx|² over it (P::squared)
  typename P::scalar dt;            ///< T₀ [s]
  typename P::scalar travel_error;  ///< Δx is no farther from the true one than this
  typename P::stored_effort held;   ///< no effort held then or since is longer
};
/// What a force can have done while nobody looked, at most.
template <class Scalar>
struct unseen_work {
  Scalar done;    ///< [J]
  Scalar beside;  ///< by how much f·Ω may have been more than f·θ, where the port turns [J]
};
/// A part that knows how far a device gets.
template <class Part, class P>
concept knows_reach = requires(const Part p, const seen_tick<P> seen, const some_damping<P> d,
                               const typename P::effort f, typename P::scalar t) {
  p.unseen(seen, d, f, t);
};
}  // namespace detail

/// One that promises nothing rests on nothing.
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

/// What a bound promises at a port. A chain knows it there, any other bound at once.
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
/// An effort where axes are damped unequally, for then it turns; elsewhere one share for all.
template <class State, class P>
using what_is_left = std::conditional_t<differs_by_axis<typename State::damping_type, P>,
                                        typename P::effort, share<typename P::scalar>>;
}  // namespace detail

/// limit() takes the desired effort and a port_state, and answers with the share that is left, or with an effort.
template <class B, class P, class State = port_state<P, detail::some_damping<P>>>
concept force_bound_for = plain_value<part_at<B, P>, P> &&
    requires(part_at<B, P> b, const typename P::effort f, const State s) {
  { promise_of<B, P>() } -> std::same_as<guarantee>;
  { B::traits } -> std::convertible_to<bound_traits>;
  requires std::same_as<decltype(b.limit(f, s)), share<typename P::scalar>> ||
      std::same_as<decltype(b.limit(f, s)), typename P::effort>;
  requires noexcept(b.limit(f, s));
};

/// estimate() takes the pose shown, the motion, the effort held meanwhile, its length [s], and whether
/// the motion is known at all; it returns `position` and, in a space, along(n), the speed along a unit
/// vector [m/s].
template <class M, class P>
concept motion_estimator_for = plain_value<part_at<M, P>, P> &&
    requires(part_at<M, P> m, const typename P::pose x, const typename P::motion dx,
             const typename P::effort f, typename P::scalar s) {
  { m.estimate(x, dx, f, s, true).position } -> std::convertible_to<typename P::pose>;
  requires noexcept(m.estimate(x, dx, f, s, true));
};

/// What a tick has come to, before its source makes its own result of it.
template <class P>
struct port_result {
  typename P::effort force;     ///< on the device [N]; joints: [N·m]
  typename P::scalar energy;    ///< E1 [J]
  event what = event::nominal;  ///< the worst that happened
  bool limited = false;         ///< the bound changed the desired effort
};

namespace detail {
/// What is to be said of a contact that was cut short: a start inside, if nothing was paid in, and nothing is left.
template <class P>
[[nodiscard]] constexpr event cut_short(const port_result<P>& port) noexcept {
  const bool nothing = !(port.energy > typename P::scalar(0)) && port.force == P::zero();
  return nothing ? worse_yet(port.what, event::started_inside) : port.what;
}
/// Does the result of a source say how deep the contact is?
template <class R>
concept says_depth = requires(const R r) {
  r.depth;
};
/// Is there a tick that takes an effort of one's own?
template <class S, class P>
concept takes_efforts = requires(S s, const typename P::effort f) {
  s.update(f);
};
/// Does a probe say along what a force acts, where that is not outward()?
template <class Probe>
concept says_push = requires(const Probe p) {
  p.push();
};
/// The least that a motion estimator says, for asking whether a source fits.
template <class P>
struct some_estimate {
  typename P::stored_pose position;
  [[nodiscard]] typename P::scalar along(const typename P::motion& n) const noexcept;
};
/// What an estimate says of the velocity [m/s], axis by axis where it has more to say than travel and time.
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
/// What stands where a part should, so that the compiler can say which part is missing.
struct left_out {};
}  // namespace detail

/// ask<Shortcut>() is given the estimate of the motion, the port_state and the event so far, which it may
/// make worse, and returns a request: `wanted`, an effort, and `nothing`, whether there is nothing to bound;
/// with a Shortcut nothing is what a bound would leave of it. answered() gets the request back with what
/// became of it, refused() a tick that nobody could believe, of length dt [s]; both return the result of the
/// tick. `asks_for_numbers`: it never asks for NaN or an infinity, so the port need not look.
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

/// What a port has to know of its loop: `latency` in ticks, traits, what the guarantee is worth in it,
/// and what looks at its samples; at a port, T [s].
template <class L, class P>
concept limits_for = requires(const part_at<L, P> l) {
  { L::latency } -> std::convertible_to<int>;
  { L::traits.learns } -> std::convertible_to<bool>;
  { L::traits.watched } -> std::convertible_to<bool>;
  { L::passivity } -> std::convertible_to<guarantee>;
  typename L::template guard_type<P>;
  { l.longest_tick } -> std::convertible_to<typename P::scalar>;
};

/// How the normal of a surface changes along it: not at all, evenly with its curvature, or in jumps.
/// What is not stated is faceted: then no turn of the normal is taken for curvature.
enum class surface_kind : std::uint8_t { flat, smooth, faceted };

template <class G>
[[nodiscard]] constexpr surface_kind kind_of() noexcept {
  if constexpr (requires { G::kind; }) return G::kind;
  return surface_kind::faceted;
}

/// A value that crosses threads: a piece of the world as the environment publishes it. prepare()
/// normalises it and is false when it is unusable. at(x) probes it: `depth` [m], > 0 inside;
/// outward(), the unit normal there; covered(), the edge test. Where depth is not the distance to the
/// surface, its gradient is not the normal: then the probe has push(), −∇depth, along which a force
/// K·depth must act so that it gives nothing out on closed paths (docs/design/contacts.md).
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

/// A surface that the local model of the thesis can follow: toward(target, x, n, d) is the same piece
/// moved, and turned if it must be, so that x lies d [m] deep under the normal n, whatever unit vector n
/// is. Its depth falls by s when x moves by s along n.
template <class G, class Space>
concept constraint_for = surface_for<G, Space> &&
    requires(const G c, const typename Space::vector v, typename Space::scalar s) {
  { c.toward(c, v, v, s) } -> std::same_as<G>;
};

/// local() is the constraint that is felt, target() the environment's newest. One that `moves` also
/// takes news with update(), ends the contact with release(), and ages: weight() is how far the contact
/// counts, in [0, 1], and last_weight() how far it did. A tick asks what is new, moves the local model with
/// approach() or sync(), and says that it has seen(). (constraint_geometry/followed.hpp)
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

/// What a shaper may look at beside the port.
template <class Space>
struct contact_state {
  typename Space::vector normal;  ///< outward, of the local model, along which the force will act
  typename Space::scalar stiffness;     ///< K of the target [N/m]
  typename Space::scalar depth;         ///< in the local model, ≤ 0 outside [m]
  typename Space::scalar target_depth;  ///< in the environment's newest constraint [m]
  typename Space::scalar local_force;   ///< what the law gives at `depth`, along `normal` [N]
  bool target_changed;                  ///< a new constraint arrived since the last tick
};

/// shape() takes the desired force, the contact and the port, and answers as a force bound does.
/// `needs_local_model` says that it compares with a local model that can move, `needs_ledger` that it
/// spends what an observer must have counted.
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
/// What a frame asks of a spring.
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

/// exchange() commands an effort and returns the newest sample. Simulated, replayed or real.
template <class D, class P>
concept haptic_device_for = requires(D d, const typename P::effort f) {
  { d.exchange(f) } -> std::same_as<device_sample<P>>;
  requires noexcept(d.exchange(f));
};

}  // namespace v0
}  // namespace passive_haptics
