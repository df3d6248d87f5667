// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// No ledger.
//
//   no_observer   E1 is always 0   for no_bound, or for a bound that needs no ledger

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// A ledger that books nothing and guarantees nothing, for comparison and for worlds that are passive by another proof.
struct no_observer {
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bool counts = false;
  static constexpr bool exact = true;
  static constexpr bool turns = true;

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <port P>
  class on {
   public:
    using scalar = typename P::scalar;
    using motion = typename P::motion;
    using effort = typename P::effort;

    /// A damping without a number, because none is stated here.
    struct unknown_damping {
      static constexpr bool rubs = false;
      [[nodiscard]] constexpr scalar worst_outflow(const auto& /*f*/, scalar /*T*/) const noexcept {
        return scalar(0);
      }
    };

    constexpr explicit on(const no_observer& /*p*/) noexcept {}
    constexpr bool update(const motion& /*dx*/, const auto& /*held*/, scalar /*dt*/) noexcept {
      return true;
    }
    constexpr void forfeit(const effort& /*held*/, scalar /*T*/) noexcept {}
    [[nodiscard]] constexpr scalar value() const noexcept { return scalar(0); }
    [[nodiscard]] constexpr const unknown_damping& damping() const noexcept { return damping_; }

   private:
    PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS unknown_damping damping_{};
  };
};

static_assert(energy_observer_for<no_observer, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
