// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A bad network in virtual time: it delays, loses, duplicates and reorders packets.
//
//   send(packet, now) ─▶ lost? ─▶ arrives at now + delay + U(0, jitter) ─▶ take(now)
//                         twice?

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

struct channel_parameters {
  double delay = 0.0;        ///< least delay of every packet [s]
  double jitter = 0.0;       ///< most additional delay, uniform, drawn for each copy [s]
  double loss = 0.0;         ///< probability that a copy never arrives
  double duplication = 0.0;  ///< probability that a packet is sent twice
  bool in_order = false;     ///< true: no packet overtakes one that was sent before it

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(delay >= 0.0) || !kernels::is_finite(delay)) return {"delay", delay, "finite and ≥ 0 s"};
    if (!(jitter >= 0.0) || !kernels::is_finite(jitter)) {
      return {"jitter", jitter, "finite and ≥ 0 s"};
    }
    if (!(loss >= 0.0 && loss <= 1.0)) return {"loss", loss, "in [0, 1]"};
    if (!(duplication >= 0.0 && duplication <= 1.0)) {
      return {"duplication", duplication, "in [0, 1]"};
    }
    return {};
  }
};

/// One direction of the network. Up to `Capacity` copies are on their way, and one that does not fit is lost, as
/// in a router. It needs no heap. A channel whose check() names a fault loses everything.
template <class Packet, std::size_t Capacity = 1024>
class channel {
 public:
  constexpr explicit channel(const channel_parameters& parameters = {},
                             std::uint64_t seed = 1) noexcept
      : parameters_(parameters), random_(seed), sound_(!parameters.check()) {}

  constexpr void send(const Packet& packet, double now) noexcept {
    const int copies = random_.chance(parameters_.duplication) ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      const bool lost = random_.chance(parameters_.loss);
      double arrival = now + parameters_.delay + parameters_.jitter * random_.uniform();
      if (lost || !sound_ || count_ == Capacity) {
        ++lost_;
        continue;
      }
      if (parameters_.in_order && arrival < latest_) arrival = latest_;
      latest_ = arrival;
      insert({arrival, packet});
    }
  }

  /// The next packet that has arrived by `now` [s], in the order of arrival, or null. It is valid until the
  /// next send().
  [[nodiscard]] constexpr const Packet* take(double now) noexcept {
    if (count_ == 0 || slot(0).arrival > now) return nullptr;
    const Packet& first = slot(0).packet;
    head_ = (head_ + 1) % Capacity;
    --count_;
    return &first;
  }

  [[nodiscard]] constexpr std::size_t in_flight() const noexcept { return count_; }
  [[nodiscard]] constexpr std::uint64_t lost() const noexcept { return lost_; }  ///< lost copies
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return parameters_.check(); }

 private:
  struct in_transit {
    double arrival = 0.0;
    Packet packet{};
  };

  [[nodiscard]] constexpr in_transit& slot(std::size_t i) noexcept {
    return ring_[(head_ + i) % Capacity];
  }
  /// Keeps the ring sorted by arrival; packets that arrive at the same instant keep their order.
  constexpr void insert(const in_transit& entry) noexcept {
    std::size_t i = count_++;
    for (; i > 0 && slot(i - 1).arrival > entry.arrival; --i) slot(i) = slot(i - 1);
    slot(i) = entry;
  }

  channel_parameters parameters_;
  random_source random_;
  bool sound_;
  std::array<in_transit, Capacity> ring_{};
  std::size_t head_ = 0, count_ = 0;
  std::uint64_t lost_ = 0;
  double latest_ = 0.0;  ///< arrival of the packet sent last [s]
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
