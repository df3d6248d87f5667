// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Passive set-position modulation (PSPM) limits the energy that an update puts into the contact spring.
// It limits nothing else.
//
//   set_position_modulation   ½ K d_new² ≤ ½ K d_old² + E      bounds the energy of jumps of the surface,
//                                                              but not the leak of the hold
//
// For walls stiffer than 2b/T put strict_bound behind it.

#include <passive_haptics/port/concepts.hpp>

#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {

/// How the leak of the zero-order hold, K Δx²/2 [J] per tick (lemma L2), is accounted for.
enum class hold_leak : std::uint8_t {
  paid,     ///< it is subtracted from the damping: passive for K ≤ 2b/T
  ignored,  ///< it is not accounted for, as published, as if the spring were in continuous time
};

/// An update deepens the contact spring only as far as a tank of energy E [J] covers. Between updates the spring is
/// not changed. At an update, with d* the depth [m] in the environment's surface:
///     E ← min(E + D_min + ½ K d_old² − ½ K d_new², cap),     d_new the deepest ≤ d* with E ≥ 0
///     D_min = (b − K T/2) (max x − min x)²/(t_k − t_{k−1})      with b alone if the leak is ignored
/// x [m] is the travel along the normal since the last update. The gap d* − d_new stays until the next update,
/// or until the device leaves: then the surface follows it out, which costs nothing. If the motors held a smaller
/// force than the spring's, the tank books the difference, too.
///
/// Source: Lee and Huang 2010, form from memory. With the leak paid E1 ≥ ½ K d² + E ≥ 0 throughout
/// (docs/design/mathematics.md § 2(e), with the proofs).
///
/// With the leak paid it assumes: every K of the environment is ≤ 2b/T; b is a lower bound; every tick is ≤
/// longest_tick; positions are exact; there is no latency; the force of the contact law is at most K d; the held
/// force is known and no larger than commanded. With a larger K, or the leak ignored, it guarantees nothing: on a
/// static wall it is the same as no bound at all.
template <hold_leak Leak = hold_leak::paid>
struct basic_set_position_modulation {
  static constexpr bool needs_local_model = true;
  static constexpr bool needs_ledger = true;

  double loan{};                                         ///< E at the start [J]
  double cap = std::numeric_limits<double>::infinity();  ///< largest E [J]
  double ask_again = 0.02;  ///< a gap that stays this long [s] counts as an update

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(loan)) return {"loan", loan, "finite and ≥ 0 J"};
    if (!(cap >= 0.0)) return {"cap", cap, "≥ 0 J"};
    if (!(ask_again > 0.0)) return {"ask_again", ask_again, "> 0 s"};
    return {};
  }
  template <class Space>
  class on;
};

using set_position_modulation = basic_set_position_modulation<>;
using published_set_position_modulation = basic_set_position_modulation<hold_leak::ignored>;

template <hold_leak Leak>
template <class Space>
class basic_set_position_modulation<Leak>::on {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;

  constexpr explicit on(const basic_set_position_modulation& p) noexcept {
    set(p);
    reset();
  }
  constexpr void set(const basic_set_position_modulation& p) noexcept {
    loan_ = detail::number<scalar>(p.loan);
    cap_ = detail::number<scalar>(p.cap);
    ask_again_ = detail::number<scalar>(p.ask_again);
  }
  [[nodiscard]] constexpr basic_set_position_modulation parameters() const noexcept {
    return {.loan = static_cast<double>(loan_),
            .cap = static_cast<double>(cap_),
            .ask_again = static_cast<double>(ask_again_)};
  }
  constexpr void reset() noexcept {
    energy_ = loan_;
    spring_ = {};
    spring_.normal = Space::zero();
    since_ = {};
  }
  [[nodiscard]] constexpr scalar energy() const noexcept { return energy_; }  ///< E [J]

  [[nodiscard]] constexpr share<scalar> shape(const vector& /*desired*/,
                                              const contact_state<Space>& contact,
                                              const auto& port) noexcept {
    const scalar there = book(port);
    const bool update =
        contact.target_changed || (spring_.gap > scalar(0) && since_.time >= ask_again_);
    if (update) collect();
    const scalar asked = contact.target_depth;
    const scalar gap = update ? scalar(0) : spring_.gap;
    scalar depth = kernels::smaller(asked, kernels::larger(asked - gap, scalar(0)));
    const scalar budget = kernels::larger(energy_ + there, scalar(0));
    if (stored(contact.stiffness, depth) > budget) {
      depth = kernels::smaller(depth, kernels::square_root(scalar(2) * budget / contact.stiffness));
    }
    energy_ = kernels::smaller(energy_ + there - stored(contact.stiffness, depth), cap_);
    spring_ = {contact.stiffness, depth, contact.normal, asked - depth};
    return {depth < asked ? depth / asked : scalar(1)};
  }

 private:
  /// The present spring: K [N/m], d [m] (< 0 outside), unit normal, and gap.
  struct contact_spring {
    scalar stiffness{};
    scalar depth{};
    typename Space::coordinates normal{};
    scalar gap{};  ///< d* − d [m], ≥ 0
  };
  /// The motion since the last update.
  struct interval {
    scalar inward{}, least{}, most{};             ///< travel along the normal, and its range [m]
    scalar time{};                                ///< [s]
    scalar damping = kernels::largest<scalar>();  ///< least b − K T/2 so far, or b [N·s/m]
  };

  [[nodiscard]] static constexpr scalar stored(scalar stiffness, scalar depth) noexcept {
    return depth > scalar(0) ? stiffness * depth * depth / scalar(2) : scalar(0);
  }

  /// Books the last tick with the spring of that tick, and returns the energy [J] that the spring stores at its end.
  /// After a lost or a late tick it returns 0 and leaves no credit.
  constexpr scalar book(const auto& port) noexcept {
    if (!(spring_.stiffness > scalar(0))) return scalar(0);  // there was no target yet, so no force
    if (port.fate() != tick_fate::on_time) {
      energy_ = kernels::smaller(energy_, scalar(0));
      since_ = {};
      return scalar(0);
    }
    const scalar T = port.longest_tick;
    const vector normal = spring_.normal;
    const vector asked = normal * (spring_.stiffness * kernels::larger(spring_.depth, scalar(0)));
    energy_ += Space::dot(vector(asked - vector(port.held)), port.travel);

    const scalar inward = -Space::dot(port.travel, normal);
    const scalar leak = Leak == hold_leak::paid ? spring_.stiffness * T / scalar(2) : scalar(0);
    since_.inward += inward;
    since_.least = kernels::smaller(since_.least, since_.inward);
    since_.most = kernels::larger(since_.most, since_.inward);
    since_.time += port.dt;
    since_.damping = kernels::smaller(since_.damping, port.damping.per_tick(normal, T) * T - leak);
    return stored(spring_.stiffness, spring_.depth + inward);
  }

  /// E ← E + D_min. (lemma L1)
  constexpr void collect() noexcept {
    const scalar range = since_.most - since_.least;
    if (since_.time > scalar(0) && since_.damping > scalar(0)) {
      energy_ += since_.damping * range * range / since_.time;
    }
    since_ = {};
  }

  scalar loan_{}, cap_{}, ask_again_{};
  scalar energy_{};          ///< E [J]
  contact_spring spring_{};  ///< stiffness 0 before the first target
  interval since_{};
};

static_assert(shaper_for<set_position_modulation, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
