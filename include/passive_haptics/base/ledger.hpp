// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Arithmetic of an energy ledger: no entry and no sum is ever rounded up (docs/design/stability.md).
//
//   sure_gain         dissipated − f_held·Δx [J] of one tick, less its largest rounding error
//   book              E += gain, rounded down
//   written_off       E − worst outflow, for a tick whose motion is unknown
//   compensated_sum   a sum that does not lose small entries

#include <passive_haptics/base/kernels.hpp>

#include <cstdint>
#include <type_traits>

namespace passive_haptics {
inline namespace v0 {

/// A sum that adds the rounding error of each addition to the next term (Kahan's summation, with Knuth's exact
/// error of a sum), so that in float entries of 1e-9 J still add up beside 1 J.
template <real Scalar>
class compensated_sum {
 public:
  constexpr compensated_sum() noexcept = default;
  constexpr compensated_sum(Scalar start) noexcept : sum_(start) {}  // NOLINT: a number

  constexpr compensated_sum& operator+=(Scalar term) noexcept {
    const Scalar carried = term + lost_;
    const Scalar next = sum_ + carried;
    const Scalar gained = next - sum_;
    lost_ = (sum_ - (next - gained)) + (carried - gained);
    sum_ = next;
    return *this;
  }
  constexpr operator Scalar() const noexcept { return sum_; }  // NOLINT: a number

 private:
  Scalar sum_{}, lost_{};
};

/// The number that a ledger is kept in: the port's scalar, or a compensated_sum of it.
enum class ledger_sum : std::uint8_t { plain, compensated };

namespace detail {

template <class Scalar, ledger_sum Sum>
using ledger_number = std::conditional_t<Sum == ledger_sum::plain, Scalar, compensated_sum<Scalar>>;

/// `dissipated` − held·Δx [J], the energy gained in a tick, which never exceeds that of exact arithmetic.
template <class Port>
[[nodiscard, gnu::always_inline]] constexpr typename Port::scalar sure_gain(
    typename Port::scalar dissipated, const typename Port::effort& held,
    const typename Port::motion& motion) noexcept {
  const auto work = Port::work(held, motion);
  return kernels::sure_gain(dissipated, work.joules, work.passed);
}

/// E += gain, rounded down.
template <class Ledger, class Scalar>
[[gnu::always_inline]] constexpr void book(Ledger& energy, Scalar gain) noexcept {
  if constexpr (std::is_same_v<Ledger, Scalar>) {
    energy = kernels::sum_rounded_down(energy, gain);
  } else {
    energy += gain;  // the compensated sum keeps the rounding error itself
  }
}

/// `energy` − `worst` [J], rounded down: the least that a ledger has left after the `worst` outflow of a force. The
/// result does not fall below `floor`, the value of an empty ledger, unless `energy` was below it before.
template <class Scalar>
[[nodiscard]] constexpr Scalar written_off(Scalar energy, Scalar worst,
                                           Scalar floor = Scalar(0)) noexcept {
  const Scalar margin = Scalar(1) + kernels::rounding<Scalar>();
  const Scalar left = kernels::sum_rounded_down(energy, Scalar(-worst * margin));
  return kernels::larger(kernels::smaller(energy, floor), left);  // a worst of NaN leaves no credit
}

}  // namespace detail

}  // namespace v0
}  // namespace passive_haptics
