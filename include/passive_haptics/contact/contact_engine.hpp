// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What contact_set and rigid_tool do in a tick. They differ in the frame: what a contact's force does to the
// device, and where on the device the contact is.
//
//   surfaces ─▶ PURSUIT ─▶ own depths, ─▶ PROXY ─▶ Σ λ n ─▶ STICK_SLIP ─▶ wanted effort ─▶ (the port's bound)
//   (slots)     per slot   own normals    (S1, S2)          per slot

#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/contact/proxy.hpp>
#include <passive_haptics/contact/pursuit.hpp>
#include <passive_haptics/contact/slot_room.hpp>
#include <passive_haptics/contact/stick_slip.hpp>

#include <array>
#include <type_traits>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// How the contacts of a device press, how fast they follow, and whether they rub.
template <class Spring, class Friction, class... Slots>
struct contact_parameters {
  static constexpr int capacity = (Slots::count + ... + 0);

  Spring spring{};
  pursuit pace{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS Friction friction{};
  int sweeps = 16;  ///< of Gauss-Seidel at most, where more than three surfaces are there

  constexpr contact_parameters() noexcept = default;
  constexpr contact_parameters(const Spring& s, const pursuit& p, const Friction& f,
                               const Slots&... /*room*/) noexcept
      : spring(s), pace(p), friction(f) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = spring.check()) return fault;
    if (const auto fault = pace.check()) return fault;
    if (const auto fault = friction.check()) return fault;
    if (sweeps < 1) return {"sweeps", static_cast<double>(sweeps), "≥ 1"};
    return {};
  }
};

namespace detail {

/// Surfaces in slots and the proxy that they leave, on a device of that frame (frame_for in port/concepts.hpp).
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

 public:
  using scalar = typename Port::scalar;
  using result_type = tick_result<Port>;
  using parameters_type = contact_parameters<Spring, Friction, Slots...>;
  using first_kind = typename all_slots::first_kind;
  static constexpr bool asks_for_numbers = true;

  constexpr explicit contact_engine(const parameters_type& p) noexcept
      : spring_(p.spring), pace_(p.pace), friction_(p.friction), sweeps_(p.sweeps) {}
  [[nodiscard]] constexpr parameters_type parameters() const noexcept {
    parameters_type p;
    p.spring = spring_.parameters();
    p.pace = pace_.parameters();
    if constexpr (rubs) p.friction = friction_.parameters();
    p.sweeps = sweeps_;
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
  /// T [s] or a parameter is another: the same surfaces are as stiff as they let them be.
  constexpr void adopt(scalar T) noexcept {
    spring_.adopt(T);
    slots_.for_each([&](auto& slot, std::size_t) { slot.adopt(spring_); });
  }
  constexpr void reset() noexcept {
    slots_.for_each([](auto& slot, std::size_t) { slot.reset(); });
    static_cast<void>(let_go());
    refused_ = false;
  }

  /// Nothing is there any more: the contact recedes until it presses no longer, and ends.
  template <class Surface = first_kind>
  constexpr void release(int i) noexcept {
    slots_.template visit<Surface>(i, [](auto& slot) { slot.release(); });
  }
  /// Slot i of that kind, 0 ≤ i < Count: its newest surface, its lag ℓ and its λ.
  template <class Surface = first_kind>
  [[nodiscard]] constexpr const auto& slot(int i) const noexcept {
    return slots_.template slot<Surface>(i);
  }

  struct request {
    typename Port::effort wanted;  ///< [N], [N·m]
    bool nothing;
    scalar depth;  ///< of the deepest contact [m]
  };
  template <bool Shortcut>
  [[nodiscard]] constexpr request ask(const auto& motion, const auto& port, event& what) noexcept {
    if (std::exchange(refused_, false)) what = worse(what, event::rejected_target);
    const auto now = frame::now(motion, port, last_);
    gathered all;
    gather(now, port.dt, all, what);
    if (all.empty) what = worse(what, event::no_target);
    const auto coupling = frame::coupling(spring_, all.stiffest);
    coupling.bring(all.rows);
    solve(
        all.rows, [&coupling](const row& a, const row& b) { return coupling.inner(a, b); },
        sweeps_);

    row pressed = Port::zero(), rubbed = Port::zero();
    rests_ = true;
    std::size_t r = 0;
    slots_.for_each([&](auto& slot, std::size_t i) {
      const bool felt = r < all.rows.count && all.slot[r] == i;
      const scalar lambda = felt ? all.rows.pressed[r] : scalar(0);
      slot.press(lambda);
      if constexpr (rubs) {
        if (felt) {
          const auto here = now.at(slot.point);
          const auto& of = slot.spring();
          const scalar k = of.stiffness * per_contact / coupling.most_yield(slot.point);
          rubbed = rubbed + now.row_of(here, bristles_[i].rub(friction_, lambda, all.normal[r],
                                                              now.travel(slot.point, here),
                                                              now.velocity(here), k,
                                                              k * of.settling, port.dt));
        } else {
          bristles_[i].let_go();
        }
      }
      if (felt) {
        pressed = pressed + all.rows.row[r] * lambda;
        rests_ = rests_ && !(lambda > scalar(0));
        ++r;
      }
    });
    last_ = now.place();
    coupled_ = coupling.way(pressed);
    const row wanted = pressed + rubbed;
    if (!Port::is_finite(wanted)) [[unlikely]] {
      what = unusable(what);
      return let_go();
    }
    return {wanted, rests_, all.deepest};
  }
  /// The own surfaces follow the world's, not the force: there is nothing to put back.
  [[nodiscard]] constexpr result_type answered(const request& r,
                                               const port_result<Port>& port) const noexcept {
    return {port.force, r.depth, port.energy, port.what, port.limited};
  }
  constexpr result_type refused(const port_result<Port>& port, scalar dt) noexcept {
    slots_.for_each([&](auto& slot, std::size_t) { slot.grow_older(dt, pace_); });
    return {port.force, scalar(0), port.energy, port.what, false};
  }

 protected:
  /// The world's newest surface in slot i of its kind, at that point of the device.
  template <class Surface>
  constexpr bool put(int i, const point_type& point, const Surface& next) noexcept {
    bool taken = false;
    slots_.template visit<Surface>(i, [&](auto& slot) {
      taken = frame::is_point(point) && slot.update(next, frame::place(last_, slot.point),
                                                    frame::place(last_, point), spring_, pace_);
      if (taken) slot.point = point;
    });
    refused_ = refused_ || !taken;
    return taken;
  }

 private:
  static constexpr auto cells = static_cast<std::size_t>(all_slots::capacity);
  /// Of a contact's K and B, what its bristle has: all of them together have no more than one contact.
  static constexpr scalar per_contact = scalar(1) / scalar(all_slots::capacity);
  struct nothing_kept {};
  struct no_friction {
    constexpr explicit no_friction(const Friction& /*f*/) noexcept {}
  };
  template <class T>
  using if_it_rubs = std::conditional_t<rubs, std::array<T, cells>, nothing_kept>;

  /// What all slots have to say in a tick.
  struct gathered {
    proxy_problem<row, scalar, all_slots::capacity> rows;
    std::array<std::size_t, cells> slot{};  ///< of each row
    PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS if_it_rubs<vector> normal;
    scalar stiffest{}, deepest{};
    bool empty = true;
  };
  constexpr void gather(const auto& now, scalar dt, gathered& all, event& what) noexcept {
    const row others = coupled_;
    const bool rests = rests_;
    slots_.for_each([&](auto& slot, std::size_t i) {
      if (!slot.taken()) return;
      all.empty = false;
      slot.grow_older(dt, pace_);
      if (slot.stale()) what = worse(what, event::stale_target);
      const auto here = now.at(slot.point);
      const auto along = [&](const vector& n) { return now.along(here, n); };
      const auto unfelt = [&](const vector& n) {
        return frame::along(now.row_of(here, n), others);
      };
      felt_surface<space_type> own;
      if (!slot.follow(here.position, along, dt, rests, unfelt, pace_, own)) return;
      if (!own.is_finite()) [[unlikely]] {
        what = unusable(what);
        return;
      }
      const auto press = [&](const auto& spring) {
        all.stiffest = kernels::larger(all.stiffest, spring.stiffness);
        all.rows.add(now.row_of(here, own.push), damped_depth(spring, own.depth, along(own.push)),
                     spring.compliance, slot.pressed());
      };
      all.deepest = kernels::larger(all.deepest, own.depth);
      all.slot[all.rows.count] = i;
      if constexpr (rubs) all.normal[all.rows.count] = own.normal;
      if (spring_.saturates(slot.spring(), own.depth)) [[unlikely]] {
        press(spring_.saturated(slot.spring(), own.depth));
      } else {
        press(slot.spring());
      }
    });
  }
  /// No force, and nothing that was felt is remembered.
  constexpr request let_go() noexcept {
    slots_.for_each([](auto& slot, std::size_t) { slot.press(scalar(0)); });
    if constexpr (rubs) {
      for (auto& bristle : bristles_) bristle.reset();
    }
    coupled_ = row(Port::zero());
    rests_ = true;
    return {Port::zero(), true, scalar(0)};
  }

  all_slots slots_{};
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS if_it_rubs<stick_slip::bristle<space_type>> bristles_{};
  typename Spring::template at<scalar> spring_;
  pursuit::on<space_type> pace_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS
  std::conditional_t<rubs, stick_slip::on<space_type>, no_friction> friction_;
  int sweeps_;
  typename frame::stored last_{};  ///< where the device was last
  typename Port::stored_effort
      coupled_{};         ///< how far the proxy is from the device: Σ λ n over K_c
  bool rests_ = true;     ///< no contact pressed in the last tick
  bool refused_ = false;  ///< news, since the last tick
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
