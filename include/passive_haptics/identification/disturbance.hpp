// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What may be wrong with a device while it is identified, by name, and the remedy.
// disturbance_search.hpp finds it; docs/design/identification.md has the formulas.

#include <passive_haptics/base/language.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

enum class disturbance : std::uint8_t { hand, mode, backlash, fraction, filter, cogging, drift };
inline constexpr std::size_t disturbances = 7;

[[nodiscard]] constexpr const char* to_string(disturbance what) noexcept {
  switch (what) {
    case disturbance::hand:
      return "a hand";
    case disturbance::mode:
      return "a mode";
    case disturbance::backlash:
      return "backlash";
    case disturbance::fraction:
      return "a fraction of a tick";
    case disturbance::filter:
      return "a filter";
    case disturbance::cogging:
      return "cogging";
    case disturbance::drift:
      return "drift";
  }
  return "unknown disturbance";
}

/// The sentence that refuses a device for it, or null where the bounds allow for it.
[[nodiscard]] constexpr const char* refusal_of(disturbance what) noexcept {
  switch (what) {
    case disturbance::hand:
      return "something holds it or follows it: let go of the device, and keep off its stops";
    case disturbance::backlash:
      return "it has backlash between motor and handle: tighten the transmission, or preload it";
    case disturbance::fraction:
      return "the force changes in mid-tick: hold it from sample to sample";
    case disturbance::filter:
      return "the force is filtered on its way to the motor: turn the filter off";
    case disturbance::drift:
      return "it changed while it was measured: let it warm up, fasten it, and identify again";
    case disturbance::mode:
    case disturbance::cogging:
      break;
  }
  return nullptr;
}

/// The sentence that refuses a device of which no motion tells a hand from a transmission that gives: a hand on a
/// handle behind a spring is both. It says what to try first.
inline constexpr const char* held_or_gives =
    "the force explains too little of the motion: something holds the handle, or the transmission "
    "gives: let go of the "
    "device; if nobody held it, stiffen the transmission";

/// One disturbance: whether it was found, how large it is, and how sure that is.
struct suspicion {
  bool found = false;
  double size = 0.0;  ///< hand: N/m; mode: Hz; backlash: m; fraction: ticks; filter: s; cogging: N;
                      ///< drift: share of the force of the swing
  double where =
      0.0;  ///< mode: share of the mass that moves with the encoder; cogging: wavelength [m]
  double sure = 0.0;  ///< standard deviations from nothing
};

/// Every disturbance of an axis, by name.
struct disturbances_found {
  std::array<suspicion, disturbances> all{};
  double mass = 0.0;  ///< all that moves [kg]; 0: the axis moved too little
  /// What the rotor may at most yield beyond that, found or hidden by the steps: 1/m_r ≤ (1 + this)/m.
  double yields = 0.0;
  /// What friction may at most fall below its mean along the way, as far as the motion shows it [N].
  double ripple = 0.0;
  /// Share of the motion, squared, that neither the device with what was found nor the steps explain, 0 to 1.
  double unexplained = 0.0;
  static constexpr double too_much = 0.01;  ///< a tenth of the motion

  /// The sentence that refuses the device, of the first that does, or null.
  [[nodiscard]] const char* refusal() const noexcept {
    for (std::size_t i = 0; i < disturbances; ++i) {
      const char* why = refusal_of(static_cast<disturbance>(i));
      if (all[i].found && why != nullptr) return why;
    }
    return nullptr;
  }
  [[nodiscard]] suspicion& of(disturbance what) noexcept {
    return all[static_cast<std::size_t>(what)];
  }
  [[nodiscard]] const suspicion& of(disturbance what) const noexcept {
    return all[static_cast<std::size_t>(what)];
  }
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
