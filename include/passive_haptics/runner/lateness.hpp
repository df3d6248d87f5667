// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The distribution of the tick lengths of a loop, the longest_tick [s] to state, and the stiffest wall that this leaves.
//
//     const auto offer = ph::offer_longest_tick(touch.timing().lengths, 1e-4, device);
//     std::puts(ph::describe(offer, text));   // longest_tick 1.114 ms: 6 of 60000 ticks were longer; …
//     ph::loop_limits{.longest_tick = offer.longest_tick}
//
// The stiffness of a wall falls as 2 b/T [N/m] or faster with longest_tick T, so a T that no tick exceeds may leave it
// soft, and a T that some ticks exceed allows a stiffer wall. Each of these is an event::late_tick, and the ledger
// books the work of the force in it, which may be a debt. You choose the share of ticks that may be late.
//
// The histogram counts in buckets of 1/64 of the length and answers with the upper end of a bucket: never less
// than what was measured, and at most 1.6 % more. It takes 16 kB and no heap.

#include <passive_haptics/design/stiffness_budget.hpp>
#include <passive_haptics/runner/text.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace passive_haptics {
inline namespace v0 {

/// Counts lengths of time from 1 ns to 68 s; a longer one falls into the last bucket.
class duration_histogram {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// Counts a length; one below zero counts as zero.
  constexpr void book(nanoseconds length) noexcept {
    const auto n = static_cast<std::uint64_t>((std::max)(length, nanoseconds(0)).count());
    ++buckets_[bucket_of(n)];
    ++count_;
    longest_ = (std::max)(longest_, nanoseconds(static_cast<std::int64_t>(n)));
  }

  [[nodiscard]] constexpr std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] constexpr nanoseconds longest() const noexcept { return longest_; }  ///< exact

  /// A length that at least `percent` of all lengths do not exceed, to a bucket; 0 before the first.
  [[nodiscard]] nanoseconds percentile(double percent) const noexcept {
    const double rank = std::ceil(percent / 100.0 * static_cast<double>(count_));
    if (!(rank > 1.0)) return of_rank(1).length;
    return of_rank(static_cast<std::uint64_t>((std::min)(rank, static_cast<double>(count_))))
        .length;
  }

  struct bound {
    nanoseconds length{};
    std::uint64_t longer = 0;  ///< how many lengths exceeded it
  };
  /// The least bound, to a bucket, that at most this share of the lengths, in [0, 1], exceeds.
  [[nodiscard]] constexpr bound all_but(double share) const noexcept {
    const double spared = kernels::smaller(kernels::larger(share, 0.0), 1.0);
    const auto longer = static_cast<std::uint64_t>(spared * static_cast<double>(count_));
    return of_rank((std::max)(count_ - (std::min)(longer, count_), std::uint64_t(1)));
  }

 private:
  static constexpr unsigned fine = 6;   ///< bits kept after the leading one
  static constexpr unsigned wide = 36;  ///< bits of the longest length counted
  static constexpr std::size_t per_octave = std::size_t(1) << fine;
  static constexpr std::size_t size = (wide - fine + 1) * per_octave;

  /// Below 2·64 ns a bucket is a nanosecond wide; above, it holds the lengths with the same 7 leading bits.
  [[nodiscard]] static constexpr std::size_t bucket_of(std::uint64_t n) noexcept {
    const auto bits = static_cast<unsigned>(std::bit_width(n));
    if (bits > wide) return size - 1;
    const unsigned dropped = bits > fine + 1 ? bits - fine - 1 : 0;
    return dropped * per_octave + static_cast<std::size_t>(n >> dropped);
  }
  [[nodiscard]] static constexpr nanoseconds upper_end(std::size_t bucket) noexcept {
    const std::size_t dropped = bucket < 2 * per_octave ? 0 : bucket / per_octave - 1;
    const std::uint64_t lead = bucket - dropped * per_octave;
    return nanoseconds(static_cast<std::int64_t>(((lead + 1) << dropped) - 1));
  }

  /// The upper end of the bucket of the k-th shortest length, k from 1.
  [[nodiscard]] constexpr bound of_rank(std::uint64_t k) const noexcept {
    std::uint64_t kept = 0;
    for (std::size_t i = 0; i + 1 < size; ++i) {
      kept += buckets_[i];
      if (kept >= k) return {(std::min)(upper_end(i), longest_), count_ - kept};
    }
    return {longest_, 0};
  }

  std::array<std::uint64_t, size> buckets_{};
  std::uint64_t count_ = 0;
  nanoseconds longest_{};
};

/// A longest_tick for a loop that was measured, and the stiffest wall that it leaves a device.
struct tick_offer {
  double share = 0.0;          ///< share of the ticks that was allowed to be longer
  double longest_tick = 0.0;   ///< [s]; 0 if nothing was measured
  std::uint64_t longer = 0;    ///< number of ticks that were longer
  std::uint64_t measured = 0;  ///< number of ticks in all
  design::budget wall{};       ///< the stiffest wall with this longest_tick

  /// The number of ticks that a share takes: if n ticks keep a bound, at most a share of 3/n of all ticks
  /// exceeds it with 95 % confidence, provided that ticks are late independently of each other.
  [[nodiscard]] constexpr std::uint64_t needed() const noexcept {
    return share > 3e-18 ? static_cast<std::uint64_t>(3.0 / share) : ~std::uint64_t(0);
  }
  [[nodiscard]] constexpr bool enough() const noexcept { return measured >= needed(); }
};

/// Offers the longest_tick that at most `share`, 0 to 1, of the ticks exceed, and the wall of `device` with it. For a
/// device of which only the viscous damping is known, state friction and quantum 0: then the wall is 2 b/T.
[[nodiscard]] constexpr tick_offer offer_longest_tick(
    const duration_histogram& lengths, double share, design::stated_device device,
    const design::intended_use& use = {}) noexcept {
  const auto bound = lengths.all_but(share);
  device.longest_tick = std::chrono::duration<double>(bound.length).count();
  return {.share = share,
          .longest_tick = device.longest_tick,
          .longer = bound.longer,
          .measured = lengths.count(),
          .wall = design::stiffness_budget(device, use)};
}

/// Writes the offer as a sentence into `text`, cut off where it is too long.
inline const char* describe(const tick_offer& offer, std::span<char> text) noexcept {
  const auto whole = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  detail::cut_text said(text);
  if (offer.measured == 0) return said.add("no tick was measured: run the loop first").c_str();
  said.print("longest_tick %.3f ms: %llu of %llu ticks were longer", 1e3 * offer.longest_tick,
             whole(offer.longer), whole(offer.measured));
  said.print("; a wall of %.0f N/m remains (%s)", offer.wall.stiffness,
             design::to_string(offer.wall.binding));
  if (offer.enough()) return said.c_str();
  if (!(offer.share > 0.0)) return said.add("; a longer one may still come").c_str();
  return said.print("; a share of %g needs %llu ticks", offer.share, whole(offer.needed())).c_str();
}

/// The ticks of a loop.
struct loop_counts {
  std::uint64_t ticks = 0;
  std::uint64_t late = 0;              ///< ticks with dt > 1.5 periods
  std::uint64_t lost = 0;              ///< periods in which there was no tick
  std::uint64_t refused = 0;           ///< forces with NaN or infinity: zero was commanded
  std::chrono::nanoseconds longest{};  ///< the longest dt
};

/// The distributions of the length and the lateness of the ticks of a loop.
struct loop_timing {
  duration_histogram lengths;   ///< dt, from wake to wake
  duration_histogram lateness;  ///< from due to wake
};

/// Writes both as a table of percentiles [ms] into `text`, cut off where it is too long.
inline const char* describe(const loop_timing& timing, std::span<char> text) noexcept {
  detail::cut_text said(text);
  const auto ms = [](std::chrono::nanoseconds t) { return 1e-6 * static_cast<double>(t.count()); };
  said.print("%llu ticks   50 %%     99 %%     99.9 %%   worst",
             static_cast<unsigned long long>(timing.lengths.count()));
  const auto row = [&](const char* name, const duration_histogram& h) {
    said.print("\n%s [ms] %8.3f %8.3f %8.3f %8.3f", name, ms(h.percentile(50.0)),
               ms(h.percentile(99.0)), ms(h.percentile(99.9)), ms(h.longest()));
  };
  row("late", timing.lateness);
  row("long", timing.lengths);
  return said.c_str();
}

}  // namespace v0
}  // namespace passive_haptics
