// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program, apart from main(), so that a test can run it; and what its sections share.

#include "../common/quiet.hpp"
#include "../common/rows.hpp"
#include "../common/sections.hpp"
#include "compositions.hpp"

#include <array>

namespace encoders {

namespace ex = experiments;

struct settings : ex::section_settings {
  int seed = 1;  ///< of what is drawn at random
};

struct session : ex::workshop {
  const settings& chosen;
  const std::vector<composition>& judged;
};

/// The hand holds still on a wall at the end of a run: is it quiet there, by the floor of the steps?
class rest_of_hold {
 public:
  static constexpr double T = 1e-3;  ///< [s]
  static constexpr int ticks = static_cast<int>(ex::quiet_watched / T);

  /// On that machine, on a wall of K [N/m], with so much of the hand's own mass on it [kg].
  rest_of_hold(const machine& m, double K, double own_mass)
      : K_(K),
        floor_(m.preset.quantum * m.displayed(K)),
        judge_(sim::quiet_bars{}.on_encoders(m.preset.quantum, m.displayed(K),
                                             m.preset.mass + own_mass)) {}

  /// A tick: the force commanded [N], the true depth [m], the velocity [m/s]. Always true.
  bool see(double force, double depth, double velocity) {
    constexpr std::array<double, 1> normal{-1.0};
    judge_.add(force, velocity, T, std::span(normal).first(depth > 0.0 ? 1 : 0));
    if (++seen_ > ticks - 1000) held_.add(-force, depth);
    return true;
  }
  void tell(ex::at_rest& row) const {
    row.add(judge_, {K_, held_.shown()});
    row.on_floor(floor_);
  }

 private:
  double K_, floor_;  // [N/m], K q [N]
  sim::quiet_judge<line> judge_;
  ex::held_stiffness held_;
  int seen_ = 0;
};
/// The hands that knead or tremble, relaxed to stiff.
inline constexpr std::array hands{
    sim::impedance_hand<line>{.stiffness = 60.0, .damping = 2.0, .own_mass = 0.05},
    sim::impedance_hand<line>{.stiffness = 300.0, .damping = 5.0, .own_mass = 0.15},
    sim::impedance_hand<line>{.stiffness = 1000.0, .damping = 15.0, .own_mass = 0.3}};
inline constexpr std::array offsets{0.03, 0.53};  ///< of the surface, in steps

enum class doing : std::uint8_t { kneading, tremor };
struct felt {
  double least = 1.0;         ///< share of K in the worst second
  double deepest = 0.0;       ///< [m]
  double least_energy = 0.0;  ///< [J]
  int outside = 0;            ///< events that say that the motion refutes what was stated
  ex::at_rest still{};
};
/// One run on a wall of K [N/m]: an approach of 3 mm at 10 mm/s, so many seconds, then 6 s of holding still. `offset` is
/// that of the surface, in steps.
[[nodiscard]] felt press(const machine& m, wall model, doing how, double K, int seconds,
                         const sim::impedance_hand<line>& fingers, double offset);

[[nodiscard]] const std::vector<ex::section<session>>& sections();
[[nodiscard]] std::vector<std::string> run_gentle_touch(const session& s);
[[nodiscard]] std::vector<std::string> run_endurance(const session& s);
[[nodiscard]] std::vector<std::string> run_tremor(const session& s);
[[nodiscard]] std::vector<std::string> run_crossed(const session& s);
[[nodiscard]] std::vector<std::string> run_nearest(const session& s);
[[nodiscard]] std::vector<std::string> run_held(const session& s);
[[nodiscard]] std::vector<std::string> run_guarantee(const session& s);

/// What the command line asks for. Throws std::invalid_argument with the value and the remedy.
[[nodiscard]] settings parse(const std::vector<std::string>& arguments);

/// 0: all is well. 1: a promise was broken, or something could not be written. 2: an argument is
/// wrong. 130: stopped; what is on disk has been said.
[[nodiscard]] int run(const std::vector<std::string>& arguments,
                      const std::vector<composition>& judged, const std::atomic<bool>& stop);

}  // namespace encoders
