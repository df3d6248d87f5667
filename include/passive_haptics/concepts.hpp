// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The contract of each role, on one page. What a concept cannot say is a law in laws.hpp.
//
//   energy observer       counts the energy at the port            observers.hpp
//   force bound           how much force that energy allows        bounds.hpp
//   normal interpolation  how fast the contact normal may turn     normals.hpp
//   constraint            a piece of the world: plane, triangle    geometry.hpp
//   supply                who owns the constraint, who moves it    supply.hpp
//   motion estimator      where the device is and how fast         motion.hpp
//   contact law           depth and speed to desired force         contact.hpp
//   haptic device         position out, force in                   simulation/, falcon_hid.hpp
//
// Every policy is trivially copyable, never throws, and states `passivity`, what it promises.

#include <passive_haptics/damping.hpp>
#include <passive_haptics/event.hpp>
#include <passive_haptics/ledger.hpp>
#include <passive_haptics/space.hpp>

#include <type_traits>

namespace passive_haptics {
inline namespace v0 {

/// All that a force bound may look at. Lengths [m], forces [N], energies [J], times [s].
template <class Space, class Damping = isotropic_damping<Space>>
struct tick_state {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  const Damping& damping;  ///< of the device, as the observer knows it
  scalar energy;           ///< E1(n), this tick's displacement included
  scalar in_flight;        ///< worst outflow of forces commanded but not yet held (latency)
  scalar dt;               ///< length of the last tick
  scalar longest_tick;     ///< bound on the length of the next
  vector held;             ///< force over the last tick
  vector displacement;     ///< Δx over the last tick
  scalar displacement_error = scalar(0);  ///< the true Δx is no farther from it than this [m]
  bool motion_known = false;  ///< false: the last sample was lost, Δx is unknown and given as zero
  vector normal;              ///< outward, of the local model, along which the force will act
  scalar stiffness;           ///< K of the target [N/m]
  scalar depth;               ///< in the local model, ≤ 0 outside
  scalar target_depth;        ///< in the environment's newest constraint, ≤ 0 outside
  scalar local_force;         ///< what the contact law gives at `depth`, along `normal`
  bool target_changed = false;  ///< a new constraint arrived since the last tick

  /// The credit a new force may spend: E1 less what is already on its way.
  [[nodiscard]] constexpr scalar credit() const noexcept { return energy - in_flight; }
  /// What the last tick brought, Δxᵀ(b/dt)Δx − f_held·Δx [J], rounded down.
  [[nodiscard]] constexpr scalar gain() const noexcept {
    return detail::sure_gain<Space>(damping.dissipated(displacement, dt), held, displacement);
  }
  /// Is the device moving out of the object?
  [[nodiscard]] constexpr bool leaving() const noexcept {
    return Space::dot(displacement, normal) > scalar(0);
  }
};

/// A value: trivially copyable where the scalar is, so that it can be logged, sent and snapshotted;
/// otherwise (a multiprecision scalar) one that copies without throwing.
template <class V, class Space>
concept plain_value = std::is_trivially_copyable_v<V> ||
    (!std::is_trivially_copyable_v<typename Space::scalar> &&
     std::is_nothrow_copy_constructible_v<V>);

/// What a policy of any role must be.
template <class P, class Space>
concept policy = plain_value<P, Space> && requires {
  { P::passivity } -> std::convertible_to<guarantee>;
};

/// update() books one tick: displacement Δx [m], the force held while it happened [N], its length
/// [s]; false, and nothing is booked, when the energy would be no finite number. forfeit() writes
/// off a tick whose motion is unknown and never raises the ledger. value() is E1 [J]. `counts` is
/// false for the one that counts nothing.
template <class O, class Space>
concept energy_observer_for = policy<O, Space> &&
    requires(O o, const O c, const typename Space::vector v, typename Space::scalar s) {
  { o.update(v, v, s) } -> std::same_as<bool>;
  { o.forfeit(v, s) } -> std::same_as<void>;
  { c.value() } -> std::same_as<typename Space::scalar>;
  { c.damping.worst_outflow(v, s) } -> std::same_as<typename Space::scalar>;
  { c.check() } -> std::same_as<parameter_fault<typename Space::scalar>>;
  { O::counts } -> std::convertible_to<bool>;
  requires noexcept(o.update(v, v, s));
  requires noexcept(o.forfeit(v, s));
  requires noexcept(c.value());
};

/// What a force bound is like. State what differs:
///     static constexpr bound_traits traits{.only_reduces = true, .needs_ledger = true};
struct bound_traits {
  bool only_reduces = false;       ///< the result is the desired force times a factor in [0, 1]
  bool needs_ledger = false;       ///< it spends what an observer must have counted
  bool needs_local_model = false;  ///< it compares with a local model that can move
  int latency = 0;                 ///< ticks from a command to the first instant it is held

  /// Of one bound after the other.
  [[nodiscard]] friend constexpr bound_traits operator+(bound_traits a, bound_traits b) noexcept {
    return {a.only_reduces && b.only_reduces, a.needs_ledger || b.needs_ledger,
            a.needs_local_model || b.needs_local_model,
            a.latency < b.latency ? b.latency : a.latency};
  }
};

/// limit() takes the desired force and returns the one to apply; `traits` says how it goes about
/// it.
template <class B, class Space>
concept force_bound_for = policy<B, Space> &&
    requires(B b, const B c, const typename Space::vector v, tick_state<Space> s) {
  { b.limit(v, s) } -> std::same_as<typename Space::vector>;
  { c.check() } -> std::same_as<parameter_fault<typename Space::scalar>>;
  { B::traits } -> std::convertible_to<bound_traits>;
  requires noexcept(b.limit(v, s));
};

/// step() returns the unit normal to use after dt [s] on the way from one unit normal to another.
template <class N, class Space>
concept normal_interpolation_for = policy<N, Space> &&
    requires(N n, const N c, const typename Space::vector v, typename Space::scalar s) {
  { n.step(v, v, s) } -> std::same_as<typename Space::vector>;
  { c.check() } -> std::same_as<parameter_fault<typename Space::scalar>>;
  requires noexcept(n.step(v, v, s));
};

/// estimate() takes the position shown [m], Δx [m], the force held meanwhile [N], its length [s],
/// and whether Δx is known at all; it returns `position` [m] and along(n), the speed along a unit
/// vector [m/s].
template <class M, class Space>
concept motion_estimator_for = policy<M, Space> &&
    requires(M m, const M c, const typename Space::vector v, typename Space::scalar s) {
  { m.estimate(v, v, v, s, true).position } -> std::convertible_to<typename Space::vector>;
  { m.estimate(v, v, v, s, true).along(v) } -> std::same_as<typename Space::scalar>;
  { c.check() } -> std::same_as<parameter_fault<typename Space::scalar>>;
  requires noexcept(m.estimate(v, v, v, s, true));
};

/// adopt() takes a new stiffness [N/m] and the longest tick [s]; force() gives the desired force
/// [N] ≥ 0 from a depth [m] and the outward speed [m/s]; depth() is its inverse.
template <class L, class Space>
concept contact_law_for = policy<L, Space> && requires(L l, const L c, typename Space::scalar s) {
  { l.adopt(s, s) } -> std::same_as<void>;
  { c.force(s, s) } -> std::same_as<typename Space::scalar>;
  { c.depth(s, s) } -> std::same_as<typename Space::scalar>;
  { c.check() } -> std::same_as<parameter_fault<typename Space::scalar>>;
  requires noexcept(l.adopt(s, s));
  requires noexcept(c.force(s, s));
  requires noexcept(c.depth(s, s));
};

/// A value that crosses threads: a piece of the world as the environment publishes it. prepare()
/// normalises it and is false when it is unusable; depth() is (p − x)·n; covers() is the edge test;
/// toward(target, x, n, d) is the same piece moved so that x lies d [m] deep under the normal n.
template <class G, class Space>
concept constraint_for = plain_value<G, Space> && std::default_initializable<G> &&
    requires(G g, const G c, const typename Space::vector v, typename Space::scalar s) {
  { c.stiffness } -> std::convertible_to<typename Space::scalar>;
  { g.prepare() } -> std::same_as<bool>;
  { c.outward() } -> std::same_as<typename Space::vector>;
  { c.depth(v) } -> std::same_as<typename Space::scalar>;
  { c.covers(v) } -> std::same_as<bool>;
  { c.toward(c, v, v, s) } -> std::same_as<G>;
  requires noexcept(g.prepare());
  requires noexcept(c.depth(v));
  requires noexcept(c.covers(v));
};

/// What a device reports after holding a force: where it is, how long the tick was, and the force
/// it really held (saturated, rounded, gravity compensation taken out).
template <class Space>
struct device_sample {
  typename Space::coordinates position{};  ///< [m]
  typename Space::coordinates held{};      ///< [N]
  typename Space::scalar dt{};             ///< [s]
  bool valid = false;                      ///< false: nothing was read, the rest says nothing
};

/// exchange() commands a force [N] and returns the newest sample. Simulated, replayed or real.
template <class D, class Space>
concept haptic_device_for = requires(D d, const typename Space::vector v) {
  { d.exchange(v) } -> std::same_as<device_sample<Space>>;
  requires noexcept(d.exchange(v));
};

}  // namespace v0
}  // namespace passive_haptics
