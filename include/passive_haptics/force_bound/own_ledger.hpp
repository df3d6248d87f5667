// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy [J] that a force bound counts for itself, beside the observer's ledger:
//
//     E ← min(E + what the last tick brought, most)     a tick on time
//     E ← min(the same, E before it, 0)                 a late one: its force may not have been held to its end
//     E ← min(E, 0)                                     a lost one: nobody knows what it brought
//
// So a tick that is not to be trusted leaves no credit, and takes no debt away. Nothing is rounded down
// here: no bound with such a ledger promises passivity by it.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

template <class Scalar>
class own_ledger {
 public:
  /// Begins anew with a loan [J].
  constexpr void reset(Scalar loan) noexcept {
    energy_ = loan;
    started_ = false;
  }
  /// Books a tick, term by term in the order given [J], and keeps at most `most`. False if it was lost; before
  /// the first tick nothing was held, so then the loan stays.
  template <class... Terms>
  constexpr bool book(const auto& state, Scalar most, Terms... brought) noexcept {
    const Scalar written_off = kernels::smaller(energy_, Scalar(0));
    const bool began = started_;
    started_ = true;
    if (!state.motion_known) {
      if (began) energy_ = written_off;
      return false;
    }
    ((energy_ += brought), ...);
    energy_ = kernels::smaller(energy_, state.fate() == tick_fate::on_time ? most : written_off);
    return true;
  }
  constexpr void keep_no_credit() noexcept { energy_ = kernels::smaller(energy_, Scalar(0)); }

  [[nodiscard]] constexpr Scalar energy() const noexcept { return energy_; }  ///< E [J]

 private:
  Scalar energy_{};
  bool started_ = false;  ///< has there been a tick?
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
