// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The packets that cross the channel of a two-port, and the largest promise among those that have arrived.

#include <passive_haptics/base/kernels.hpp>

#include <cstdint>

namespace passive_haptics {
inline namespace v0 {

/// One packet, in either direction. It is trivially copyable if the payload is.
template <class Scalar, class Payload>
struct port_packet {
  Scalar energy{};         ///< E_in [J], the sum of all promises to the receiver; it never falls
  std::uint64_t number{};  ///< 1, 2, 3 … in the order of sending
  Payload payload{};       ///< towards the environment a position [m], towards the hand a force [N]
};

/// The largest promise that has arrived (R of § 2(d)). A packet that is lost, late or doubled needs no
/// treatment, because the next packet carries the whole sum.
template <class Scalar>
struct received_energy {
  Scalar newest{};  ///< E_in_rx [J]

  /// Takes the sum [J] that a packet promises; returns what it adds [J], ≥ 0, and 0 if the sum is not finite.
  constexpr Scalar gain(Scalar promised) noexcept {
    if (!kernels::is_finite(promised) || !(promised > newest)) return Scalar(0);
    const Scalar gained = promised - newest;
    newest = promised;
    return gained;
  }
};

}  // namespace v0
}  // namespace passive_haptics
