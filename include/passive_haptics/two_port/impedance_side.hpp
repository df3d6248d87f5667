// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The impedance side of a two-port: force out to the device, measured displacement back.

#include <passive_haptics/contact/given_force.hpp>
#include <passive_haptics/port/passive_port.hpp>
#include <passive_haptics/two_port/packet.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The device's end of the channel: a passive port whose desired force is the newest one that has arrived. Its
/// `passivity` means that the sum of the energies of both ports is ≥ −(both loans), with any other side that keeps
/// E1 ≥ 0, under the assumptions of its bound.
///     ph::impedance_side master{scene{}, ph::two_port_energy{.damping = 2.0}, ph::strict_bound{},
///                               ph::loop_limits{.longest_tick = 0.0011}};
///     master.receive(packet);                                // as many as have come, in any order
///     device.command(master.tick(sample).force);
///     channel.send(master.packet());                         // {E_in, position}
/// If no packets arrive, the last force is held until the ledger is used up, or until the force is older than
/// `stale_after`, if the given_force states that.
template <class Space, class Observer, class Bound, class Limits = loop_limits>
class impedance_side : public passive_port<Space, given_force, Observer, Bound, Limits> {
  using side = passive_port<Space, given_force, Observer, Bound, Limits>;

 public:
  using space_type = Space;
  using scalar = typename Space::scalar;
  using packet_type = port_packet<scalar, typename Space::coordinates>;

  constexpr impedance_side(Space where, const Observer& observer, const Bound& bound,
                           const Limits& limits,
                           const given_force& rule = {.stale_after = infinity}) noexcept
      : side(where, rule, observer, bound, limits) {}

  /// Takes a packet {E_in [J], force [N]} from the other side. A force that is not finite is refused, and the
  /// next tick reports event::rejected_target.
  constexpr void receive(const packet_type& packet) noexcept {
    this->observer().receive(packet.energy);
    if (packet.number <= newest_) return;
    if (this->source().update(packet.payload)) newest_ = packet.number;
  }
  /// The packet {E_in [J], position [m]} for the other side, to send after each tick.
  [[nodiscard]] constexpr packet_type packet() noexcept {
    if (this->has_position()) ++number_;  // 0: no position yet
    return {this->observer().outgoing(), number_, this->position()};
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::uint64_t newest_ = 0;  ///< number of the newest force, 0 before the first
  std::uint64_t number_ = 0;  ///< number of the last packet made
};

}  // namespace v0
}  // namespace passive_haptics
