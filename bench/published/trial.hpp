// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a contender is tried on the model of a paper: how stiff it is to a slow press, whether it comes to rest under a
// hand, and what a hand can draw out of it.

#include "../common/record.hpp"
#include "../common/report.hpp"
#include "contenders.hpp"
#include <passive_haptics/simulation/quiet.hpp>

namespace papers {

namespace ex = experiments;

/// A hand that lets the device go at the wall: a grip of `stiffness` [N/m] and `damping` [N·s/m] that presses with
/// `push` [N], no more than facts::hand. The device starts `away` [m] before the wall with `speed` [m/s].
struct press {
  double push = 1.0, stiffness = 30.0, damping = 0.5;
  double away = 5e-3, speed = 0.0;
  double seconds = 6.0;  ///< of the run
  double in_time = 5.0;  ///< by which it has to be quiet [s]
};

struct pressed {
  double quiet = std::nan("");  ///< from then on [s]; none: not in time
  sim::quiet_bar missed{};
  double least_energy = 0.0;  ///< at the port, with what dry friction took [J]
  int bounces = 0;            ///< times that the device left the wall
  double swing = 0.0;         ///< peak to peak in the last second [m]
};

/// `shown` [N/m] sets the bars: on encoders they are no finer than K q (simulation/quiet.hpp). A file gets
/// "time s,depth m,force N,port energy J" in each tick.
[[nodiscard]] pressed under_a_hand(const contender& c, const facts& f, double K, const press& by,
                                   double shown, ex::csv_file* csv = nullptr);

/// The stiffness [N/m] that a slow press finds from an empty ledger: force over depth, at 1 mm/s, where the force is 0.9
/// of facts::hand, or at 20 mm. The hand is a velocity source.
[[nodiscard]] double shown_stiffness(const contender& c, const facts& f, double K);

/// The least energy [J] of `runs` runs each of the adversaries that the promise covers, and for a bare spring of those
/// that a known hand is promised for; the wall stays where it is.
[[nodiscard]] double under_attack(const contender& c, const facts& f, double K, int runs);

/// All of them for one contender.
struct outcome {
  std::string source{}, model{}, contender{};
  promise to{};
  double asked = 0.0, shown = 0.0;  ///< [N/m]
  pressed pressed_by{};
  double attacked = 0.0;  ///< [J]

  [[nodiscard]] bool is_quiet() const { return std::isfinite(pressed_by.quiet); }
  /// The least of both [J].
  [[nodiscard]] double least_energy() const { return std::min(pressed_by.least_energy, attacked); }
};
[[nodiscard]] ex::record record_of(const outcome& o);
/// The same for people, in 80 columns.
[[nodiscard]] ex::record short_record_of(const outcome& o);

[[nodiscard]] outcome judged(const contender& c, const facts& f, double K, const press& by,
                             int runs);

/// A promise is kept to this much [J]: rounding of sums of millijoules.
inline constexpr double accepted_loss = 1e-12;

}  // namespace papers
