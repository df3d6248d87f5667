// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tick of contact_set and rigid_tool. They differ in their frame, which has the place of a contact on the device
// and the effort of its force on the device.
//
//   surfaces ─▶ PURSUIT ─▶ own depths, ─▶ PROXY ─▶ Σ λ n ─▶ STICK_SLIP ─▶ wanted effort ─▶ (the port's bound)
//   (slots)     per slot   own normals    (S1, S2)          per slot

#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/contact/proxy_solver.hpp>
#include <passive_haptics/contact/pursuit.hpp>
#include <passive_haptics/contact/slot_room.hpp>
#include <passive_haptics/contact/stick_slip.hpp>

#include <array>
#include <type_traits>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// The spring of the contacts of a device, the rates at which they follow updates, and their friction.
template <class Spring, class Friction, class... Slots>
struct contact_parameters {
  static constexpr int capacity = (Slots::count + ... + 0);

  Spring spring{};
  pursuit pace{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS Friction friction{};

  constexpr contact_parameters() noexcept = default;
  constexpr contact_parameters(const Spring& s, const pursuit& p,
                               const std::type_identity_t<Friction>& f,
                               const Slots&... /*room*/) noexcept
      : spring(s), pace(p), friction(f) {}
  constexpr contact_parameters(const Spring& s, const pursuit& p, const Slots&... /*room*/) noexcept
      : spring(s), pace(p) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = spring.check()) return fault;
    if (const auto fault = pace.check()) return fault;
    if (const auto fault = friction.check()) return fault;
    return {};
  }
};

namespace detail {

/// Surfaces in slots and their proxy, for a device with that frame (frame_for in port/concepts.hpp).
template <class Port, template <class> class Frame, class Spring, class Friction, class... Slots>
class contact_engine {
 protected:
  using frame = Frame<Port>;
  static_assert(frame_for<frame, Port>,
                "passive_haptics: the frame does not model frame_for: see port/concepts.hpp");
  using space_type = typename frame::space;
  using point_type = typename frame::point;

 private:
  using row = typename frame::row;
  using vector = typename space_type::vector;
  static constexpr bool rubs = !std::same_as<Friction, frictionless> && space_type::dof > 1;
  template <class Surface>
  struct slot_of : pursued<Surface, space_type> {
    PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS point_type point{};
  };
  using all_slots = slot_room<slot_of, Slots...>;
  /// With more than four slots, those out of reach are not evaluated in every tick.
  static constexpr bool naps = all_slots::capacity > 4 && frame::naps;

 public:
  using scalar = typename Port::scalar;
  using result_type = tick_result<Port>;
  using parameters_type = contact_parameters<Spring, Friction, Slots...>;
  using first_kind = typename all_slots::first_kind;
  static constexpr bool asks_for_numbers = true;

  constexpr explicit contact_engine(const parameters_type& p) noexcept
      : spring_(p.spring), pace_(p.pace), friction_(p.friction) {}
  [[nodiscard]] constexpr parameters_type parameters() const noexcept {
    parameters_type p;
    p.spring = spring_.parameters();
    p.pace = pace_.parameters();
    if constexpr (rubs) p.friction = friction_.parameters();
    return p;
  }
  template <class Parameters>
  static constexpr int takers = int(std::same_as<Parameters, Spring>) +
                                int(std::same_as<Parameters, pursuit>) +
                                int(rubs&& std::same_as<Parameters, Friction>);
  template <class Parameters>
  constexpr void take(const Parameters& p) noexcept {
    if constexpr (std::same_as<Parameters, Spring>) spring_ = decltype(spring_)(p);
    if constexpr (std::same_as<Parameters, pursuit>) pace_ = decltype(pace_)(p);
    if constexpr (std::same_as<Parameters, Friction>) friction_ = decltype(friction_)(p);
  }
  /// Recomputes the springs of all surfaces for a new T [s], latency or parameter.
  constexpr void adopt(scalar T, int late) noexcept {
    news();
    spring_.adopt(T, late);
    slots_.for_each([&](auto& slot, std::size_t) { slot.adopt(spring_); });
  }
  /// True if a surface of K [N/m] comes to rest at its displayed stiffness (settles() in sampled_spring.hpp).
  [[nodiscard]] constexpr bool settles(scalar K) const noexcept { return spring_.settles(K); }
  constexpr void reset() noexcept {
    slots_.for_each([](auto& slot, std::size_t) { slot.reset(); });
    if constexpr (naps) nap_.awake = {};
    let_go();
    asked_ = moved_ = Port::zero();
    steepest_ = {};
    refused_ = told_ = heard_ = chased_ = placed_ = false;
  }

  /// Removes the surface of a slot: its contact recedes until λ = 0, and ends.
  template <class Surface = first_kind>
  constexpr void release(int i) noexcept {
    if (!heard_) news();
    slots_.template visit<Surface>(i, [&](auto& slot, std::size_t number) {
      heard_ = !(slot.pressed() > scalar(0));
      slot.release();
      if constexpr (naps) nap_.awake.set(number);
    });
  }
  /// Slot i of that kind, 0 ≤ i < Count, with its newest surface, its lag ℓ and its λ.
  template <class Surface = first_kind>
  [[nodiscard]] constexpr const auto& slot(int i) const noexcept {
    return slots_.template slot<Surface>(i);
  }

  /// True if it is out of reach, and not evaluated until all slots are again.
  template <class Surface = first_kind>
  [[nodiscard]] constexpr bool sleeps(int i) const noexcept {
    if constexpr (naps) {
      return !nap_.awake.has(all_slots::template first<Surface>() + static_cast<std::size_t>(i));
    }
    return false;
  }

  /// Explains the contact with the largest λ, at its place on the device, or the first one.
  constexpr void explain(explanation& e, const auto& /*device*/, scalar /*T*/,
                         int /*late*/) const noexcept {
    scalar most(-1);
    e.stiffness = softened_by::no_surface;
    slots_.for_each([&](const auto& slot, std::size_t) {
      if (!slot.taken() || !(slot.pressed() > most)) return;
      most = slot.pressed();
      e.stiffness = softened_by::nothing;
      explain_surface(e, slot.target(), frame::place(last_, slot.point), displayed(slot),
                      spring_.softener(slot.target().stiffness),
                      told_ || !(slot.lag() == scalar(0)), slot.stale());
    });
  }

  struct request {
    typename Port::effort wanted;  ///< desired effort [N], [N·m]
    bool nothing;
    scalar depth;  ///< of the deepest contact [m]
  };
  template <bool Shortcut>
  [[nodiscard]] constexpr request ask(const auto& motion, const auto& port, event& what) noexcept {
    if (std::exchange(refused_, false)) what = detail::worse_yet(what, event::rejected_target);
    if (!std::exchange(placed_, true)) [[unlikely]]
      last_ = frame::now(motion, port, last_).place();
    const auto now = frame::now(motion, port, last_);
    const auto coupling = frame::coupling(spring_);
    gathered all;
    gather(now, coupling, port, all, what);
    if (all.empty) what = detail::worse_yet(what, event::no_target);
    const auto& rows = all.rows;
    solve(all.rows, [&coupling, &rows](std::size_t i, std::size_t j) {
      return coupling.inner(rows.row[i], rows.row[j],
                            kernels::smaller(rows.compliance[i], rows.compliance[j]));
    });

    row pressed = Port::zero(), rubbed = Port::zero();
    rests_ = true;
    std::size_t r = 0;
    if constexpr (naps) nap_.reach = scalar(0);
    each_awake([&](auto& slot, std::size_t i) {
      const bool felt = r < all.rows.count && all.slot[r] == i;
      const scalar lambda = felt ? all.rows.pressed[r] : scalar(0);
      slot.press(lambda);
      if constexpr (rubs) {
        if (felt) {
          const auto here = now.at(slot.point);
          const auto& of = slot.spring();
          const scalar k =
              of.stiffness * per_contact / coupling.most_yield(slot.point, of.compliance);
          rubbed = rubbed + now.row_of(here, bristles_[i].rub(friction_, lambda, all.normal[r],
                                                              now.travel(slot.point, here),
                                                              now.velocity(here), k,
                                                              k * spring_.sliding(of), port.dt));
        } else {
          bristles_[i].let_go();
        }
      }
      if (felt) {
        pressed = pressed + all.rows.row[r] * lambda;
        if constexpr (naps) nap_.reach += lambda * all.rows.compliance[r];
        rests_ = rests_ && !(lambda > scalar(0));
        ++r;
      }
    });
    row wanted = pressed + rubbed;
    if (!Port::is_finite(wanted)) [[unlikely]] {
      what = unusable(what);
      let_go();
      wanted = Port::zero();
      all.deepest = scalar(0);
      all.chases = true;  // what comes back then is news, too
    }
    const row way = now.moved();
    if (told_ || chased_ || all.chases) [[unlikely]] {
      if (!(knows_way_ && port.motion_known)) moved_ = way;  // none was seen: no change of speed
      wanted = eased(wanted, way, all.chases, port.dt);
    }
    moved_ = way;
    knows_way_ = port.motion_known;
    last_ = now.place();
    asked_ = wanted;
    return {wanted, rests_ && !told_, all.deepest};
  }
  /// The own surfaces follow their targets and not the bounded force, so nothing is moved here.
  [[nodiscard]] constexpr result_type answered(const request& r,
                                               const port_result<Port>& port) const noexcept {
    const event what = port.limited ? cut_short(port) : port.what;
    return {port.force, r.depth, port.energy, what, port.limited};
  }
  constexpr result_type refused(const port_result<Port>& port, scalar dt) noexcept {
    slots_.for_each([&](auto& slot, std::size_t) { slot.grow_older(dt, pace_); });
    if (port.what == event::forces_off) {
      let_go();
      slots_.for_each([](auto& slot, std::size_t) { slot.vanish(); });
      if constexpr (naps) nap_.awake = {};
      asked_ = Port::zero();
    }
    return {port.force, scalar(0), port.energy, port.what, false};
  }

 protected:
  /// The point of slot i of its kind, if that slot exists.
  template <class Surface>
  [[nodiscard]] constexpr point_type point_of(int i) noexcept {
    point_type point{};
    slots_.template visit<Surface>(i, [&point](auto& slot, std::size_t) { point = slot.point; });
    return point;
  }
  /// Sets the newest surface of slot i of its kind, at that point of the device.
  template <class Surface>
  constexpr news_taken<scalar> put(int i, const point_type& point, const Surface& next) noexcept {
    news_taken<scalar> taken;
    if (!heard_) news();
    slots_.template visit<Surface>(i, [&](auto& slot, std::size_t number) {
      heard_ = !(slot.pressed() > scalar(0));  // its spring counts, too, when there is more to hear
      taken.taken =
          frame::is_point(point) && slot.update(next, frame::place(last_, slot.point),
                                                frame::place(last_, point), spring_, pace_);
      if constexpr (naps) {
        nap_.awake.set(number);
        if (taken && placed_ &&
            slot.stays_away(nap_.began_at, scalar(-2) * (pace_.out_of_reach() + nap_.reach),
                            nap_.lasted, pace_)) {
          nap_.awake.clear(number);
        }
      }
      if (!taken) return;
      slot.point = point;
      taken.stiffness = displayed(slot);
    });
    refused_ = refused_ || !taken;
    return taken;
  }

 private:
  static constexpr auto cells = static_cast<std::size_t>(all_slots::capacity);
  /// The share of a contact's K and B that its bristle has, so that all bristles together have those of one contact.
  static constexpr scalar per_contact = scalar(1) / scalar(all_slots::capacity);
  struct nothing_kept {};
  struct no_friction {
    constexpr explicit no_friction(const Friction& /*f*/) noexcept {}
  };
  /// The stiffness that a slot displays at rest, where the device was last [N/m].
  [[nodiscard]] constexpr scalar displayed(const auto& slot) const noexcept {
    const struct {
      typename frame::stored position;
      typename Port::effort travel;
      scalar dt;
    } rest{last_, Port::zero(), scalar(1)};
    const auto now = frame::now(rest, rest, last_);
    const auto here = now.at(slot.point);
    const row r = now.row_of(here, slot.target().at(here.position).outward());
    return scalar(1) / frame::coupling(spring_).own(r, slot.spring().compliance);
  }
  template <class T>
  using if_it_rubs = std::conditional_t<rubs, std::array<T, cells>, nothing_kept>;

  /// The rows of all slots in a tick.
  struct gathered {  // NOLINT(*-member-init): what is not counted is not read
    proxy_problem<row, scalar, all_slots::capacity> rows;
    std::array<std::size_t, cells> slot;  ///< slot of each row
    PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS if_it_rubs<vector> normal;
    scalar deepest{};
    bool empty = true;
    bool chases = false;  ///< an own surface has not reached its target yet
  };
  constexpr void gather(const auto& now, const auto& coupling, const auto& port, gathered& all,
                        event& what) noexcept {
    const scalar dt = port.dt;
    const bool rests = rests_;
    [[maybe_unused]] scalar together(0);
    if constexpr (frame::shares_load) {
      slots_.for_each([&](const auto& slot, std::size_t) { together += slot.pressed(); });
    }
    [[maybe_unused]] const scalar slept = time_to_look(now, dt);
    if constexpr (naps) {
      all.empty = nap_.awake.all();
      if (slept > scalar(0)) wake(slept - dt);
    }
    each_awake([&](auto& slot, std::size_t i) {
      if (!slot.taken()) return;
      all.empty = false;
      slot.grow_older(dt, pace_);
      if (slot.stale()) what = detail::worse_yet(what, event::stale_target);
      const auto here = now.at(slot.point);
      const auto along = [&](const vector& n) { return now.along(here, n); };
      const auto unfelt = [&](const vector& n) {
        return pressed_by_others(now, coupling, now.row_of(here, n), slot.spring().compliance);
      };
      const auto way = [&] { return space_type::norm(now.travel(slot.point, here)); };
      felt_surface<space_type> own;
      const scalar pays = frame::shares_load ? together : slot.pressed();
      if (!slot.follow(here.position, along, port, pays, rests, unfelt, way, pace_, own)) return;
      if (!own.is_finite()) [[unlikely]] {
        what = unusable(what);
        return;
      }
      if constexpr (naps) {
        const scalar reach = pace_.out_of_reach() + nap_.reach;
        if (slept > scalar(0) && own.depth < scalar(-2) * reach && !own.chases &&
            !(slot.pressed() > scalar(0))) {
          return nap_.awake.clear(i);
        }
      }
      all.chases = all.chases || own.chases;
      const auto press = [&](const auto& spring) {
        const row r = now.row_of(here, own.push);
        all.rows.add(r, coupling.own(r, spring.compliance), spring, own.depth, along(own.push),
                     slot.pressed());
      };
      if constexpr (cells == 1) {
        if (!(own.depth > scalar(0))) return;  // it can only press with d > 0
      }
      all.deepest = kernels::larger(all.deepest, own.depth);
      all.slot[all.rows.count] = i;
      if constexpr (rubs) all.normal[all.rows.count] = own.normal;
      if constexpr (requires { spring_.saturates(slot.spring(), own.depth); }) {
        if (spring_.saturates(slot.spring(), own.depth)) [[unlikely]] {
          return press(spring_.saturated(slot.spring(), own.depth));
        }
      }
      press(slot.spring());
    });
  }
  /// Calls act(slot, number) for all slots but those that sleep.
  constexpr void each_awake(auto act) noexcept {
    if constexpr (naps) {
      slots_.for_each_of(nap_.awake, act);
    } else {
      slots_.for_each(act);
    }
  }
  /// Wakes those that have slept for a time [s].
  constexpr void wake(scalar slept) noexcept {
    slots_.for_each([&](auto& slot, std::size_t i) {
      if (!nap_.awake.has(i)) slot.grow_older(slept, pace_);
    });
    nap_.awake = {};
  }
  /// The time that sleeping slots have slept [s] if all slots are to be evaluated now, else 0. A surface that was
  /// 2 (D + R) away, R = Σ λ_i c_i the proxy's offset, cannot press while the device has moved by less than D − R.
  constexpr scalar time_to_look(const auto& now, scalar dt) noexcept {
    if constexpr (naps) {
      nap_.lasted += dt;
      const scalar off = scalar(2) * frame::apart(now, nap_.began_at) + nap_.reach;
      if (off <= pace_.out_of_reach() && nap_.lasted <= scalar(0.05)) return scalar(0);
      nap_.began_at = now.place();
      return std::exchange(nap_.lasted, scalar(0));
    } else {
      return scalar(0);
    }
  }
  /// Σ A_ij λ_j [m] over the contacts that pressed last, the largest depth at which one of the row `mine` has none.
  constexpr scalar pressed_by_others(const auto& now, const auto& coupling, const row& mine,
                                     scalar compliance) noexcept {
    scalar depth(0);
    slots_.for_each([&](auto& other, std::size_t) {
      if (!(other.pressed() > scalar(0))) return;
      const row r = now.row_of(now.at(other.point), other.normal());
      depth += other.pressed() *
               coupling.inner(mine, r, kernels::smaller(compliance, other.spring().compliance));
    });
    return depth;
  }
  /// Begins an update: the force is no steeper than the stiffest contact that presses, or is there if `any`, from now on.
  [[gnu::noinline]] constexpr void news(bool any = false) noexcept {
    told_ = heard_ = true;
    slots_.for_each([&](auto& slot, std::size_t) {
      const bool counts = any || slot.pressed() > scalar(0);
      slot.owe();
      if (counts && slot.spring().stiffness > steepest_.stiffness) steepest_ = slot.spring();
    });
  }
  /// True if a surface that has made what is asked is still there, if farther off.
  [[nodiscard]] constexpr bool still_there() noexcept {
    bool is = false;
    slots_.for_each([&](const auto& slot, std::size_t) {
      is = is || (slot.owes() && space_type::dot(slot.normal(), frame::pushes(asked_)) > scalar(0));
    });
    return is;
  }
  /// While updates are followed, the desired effort w changes by at most R dt plus the effect of the device's motion. What
  /// surfaces answer to a motion x along their push is known, −k u with u = w·x/|w| and k = |w|²/(w·C w), and holds against
  /// it; of what is across it, x − C w k u/|w|, only its size is. By size alone a device that gives way would explain the
  /// news that made it do so.
  [[gnu::noinline]] constexpr row eased(const row& wanted, const row& way, bool chases,
                                        scalar dt) noexcept {
    news(!told_ && !chased_);  // what recedes by itself may have pressed until now
    heard_ = false;
    const scalar lead = steepest_.settling / dt;
    row beside = frame::way_of(way, dt), change = frame::way_of(way - row(moved_), dt),
        middle = asked_;
    scalar explained(0);
    const scalar pushed = frame::size(spring_, middle);
    if (pushed > scalar(0) && still_there()) {
      const row push = middle * (scalar(1) / pushed);
      const row yields = frame::yields(spring_, push, steepest_.compliance);
      const scalar k = scalar(1) / frame::power(push, yields);
      const scalar u = frame::power(push, beside), du = frame::power(push, change);
      beside = beside - row(yields * (k * u));
      change = change - row(yields * (k * du));
      const scalar left = pushed - k * (u + lead * du);
      middle = push * kernels::larger(left, scalar(0));
      explained = kernels::larger(-left, scalar(0));  // what is braked has no more to give
    }
    explained += scalar(2) * steepest_.stiffness *
                 (frame::stretch(spring_, beside) + lead * frame::stretch(spring_, change));
    const row step = wanted - middle;
    const scalar size = frame::size(spring_, step), most = pace_.news(dt) + explained;
    told_ = size > most;
    chased_ = chases;  // its last step is in the next tick
    if (!told_ && !chases) {
      steepest_ = {};
      slots_.for_each([](auto& slot, std::size_t) { slot.owe_nothing(); });
    }
    return told_ ? row(middle + row(step * (most / size))) : wanted;
  }
  /// Returns no force, and drops the state of all contacts.
  constexpr void let_go() noexcept {
    slots_.for_each([](auto& slot, std::size_t) { slot.press(scalar(0)); });
    if constexpr (rubs) {
      for (auto& bristle : bristles_) bristle.reset();
    }
  }

  struct nap {
    typename frame::stored began_at{};       ///< device when all slots were evaluated
    scalar lasted = scalar(1);               ///< time since then [s]
    scalar reach{};                          ///< Σ λ c in the last tick [m]
    slot_bits<all_slots::capacity> awake{};  ///< slots that are evaluated in each tick
  };

  all_slots slots_{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS std::conditional_t<naps, nap, nothing_kept> nap_{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS if_it_rubs<stick_slip::bristle<space_type>> bristles_{};
  typename Spring::template at<scalar> spring_;
  pursuit::on<space_type> pace_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS
  std::conditional_t<rubs, stick_slip::on<space_type>, no_friction> friction_;
  typename frame::stored last_{};         ///< last pose of the device
  typename Port::stored_effort asked_{};  ///< desired effort of the last tick [N], [N·m]
  typename Port::stored_effort moved_{};  ///< moved() of the last tick
  sampled_spring<scalar> steepest_{};     ///< stiffest contact that pressed since the update
  bool rests_ = true;                     ///< no contact pressed in the last tick
  bool told_ = false;                     ///< an update is still being followed
  bool heard_ = false;                    ///< an update has begun since the last tick
  bool chased_ = false;                   ///< `chases` of the last tick
  bool refused_ = false;                  ///< a surface was refused since the last tick
  bool knows_way_ = true;                 ///< the motion of the last tick is known
  bool placed_ = false;                   ///< last_ is known; it is not at the first sample
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
