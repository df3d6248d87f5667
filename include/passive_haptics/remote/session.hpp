// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts that both ends of a session share: random numbers, the order of datagrams, the counts of verdicts.
//
// The client draws 64 bits at random, the server hashes 64, and questions and answers carry both numbers, so
// stray datagrams are refused, and those of a sender who cannot see the numbers. But a reader of the traffic can
// forge datagrams unless they are sealed (seal.hpp), and a router can stop the session. On a network that is not
// yours seal them, or put both machines into an encrypted tunnel (WireGuard, IPsec).

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/remote/wire.hpp>

#include <optional>
#include <random>

namespace passive_haptics {
inline namespace v0 {
namespace remote {

/// 64 bits from the system's own source of randomness, not 0. Throws what std::random_device throws on a
/// system that has none.
[[nodiscard]] inline std::uint64_t draw_number() {
  std::random_device source;
  std::uint64_t drawn = 0;
  while (drawn == 0) {
    drawn = std::uint64_t(source()) << 32 ^ std::uint64_t(source());
  }
  return drawn;
}

/// Counts the datagrams by their verdict.
class tally {
 public:
  [[nodiscard]] constexpr std::uint64_t of(verdict v) const noexcept {
    return count_[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] constexpr std::uint64_t refused() const noexcept {
    std::uint64_t all = 0;
    for (std::size_t i = 1; i < verdicts; ++i) all += count_[i];
    return all;
  }
  constexpr verdict book(verdict v) noexcept {
    ++count_[static_cast<std::size_t>(v)];
    return v;
  }

 private:
  std::array<std::uint64_t, verdicts> count_{};
};

namespace detail {

/// Accepts each sequence number once, and only rising ones.
class in_order {
 public:
  [[nodiscard]] constexpr verdict judge(std::uint32_t number) const noexcept {
    if (!any_ || later(number, newest_)) return verdict::accepted;
    return number == newest_ ? verdict::repeated : verdict::overtaken;
  }
  constexpr void passed(std::uint32_t number) noexcept {
    any_ = true;
    newest_ = number;
  }

 private:
  bool any_ = false;
  std::uint32_t newest_ = 0;
};

[[nodiscard]] constexpr nanoseconds span_of(double seconds) noexcept {
  constexpr double most = 9.0e9;  // [s]; a longer time does not fit into 63 bits of ns
  const double kept = seconds < most ? seconds : most;
  return nanoseconds(static_cast<std::int64_t>(kept * 1e9));
}

}  // namespace detail

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics
