// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy E [J] that a force bound books for itself, beside the observer's ledger:
//
//     E ← min(E + ΔE, most)     after a tick on time, with ΔE [J] the energy gained in it
//     E ← min(E + ΔE, E, 0)     after a late tick, whose force may not have been held to its end
//     E ← min(E, 0)             after a lost tick, whose ΔE is unknown
//
// So after a late or a lost tick there is no credit, and a debt stays. The sums are not rounded down, because no
// guarantee rests on such a ledger.

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

template <class Scalar>
class own_ledger {
 public:
  /// Starts again with a loan [J].
  constexpr void reset(Scalar loan) noexcept {
    energy_ = loan;
    started_ = false;
  }
  /// Adds the terms of a tick [J] in the order given and keeps at most `most` [J]. Returns false for a lost
  /// tick. Before the first tick nothing was held, so a first tick that is lost leaves the loan.
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
  bool started_ = false;  ///< a tick has been booked since reset()
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
