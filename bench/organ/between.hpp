// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is felt between news: surfaces that move by themselves or give way, told 10 to 1000 times a second and late, to
// a plane and a spring, and to what make_touch makes of the same news.

#include "../common/quiet.hpp"
#include "../common/rows.hpp"

#include <string>
#include <vector>

namespace organ {

namespace ex = experiments;

struct between_settings {
  std::string mesh{};  ///< another organ, Gmsh MSH; empty: none
  double unit = 1e-3;  ///< of its coordinates [m]
  bool quick = false;
};

/// A scene, a rate, a latency and what is made of the news.
struct between_row {
  std::string scene{};
  double rate = 0.0;     ///< of the news [Hz]
  double late = 0.0;     ///< how old they are when they come [ms]
  std::string by{};      ///< what is made of them
  double loan = 0.0;     ///< what it may give out and never get back [J]
  double error = 0.0;    ///< rms, from the scene solved 10 000 times a second [N]
  double of_bare = 0.0;  ///< the same over that of bare
  double step = 0.0;     ///< largest in a tick [N]
  double own = 0.0;      ///< the same of the truth [N]
  int lost = 0;          ///< ticks without force where the truth has more than 0.02 N
  int ticks = 0;         ///< of so many
  double least = 0.0;    ///< port energy, with the device's own damping [J]
  double tick = 0.0;     ///< of the model [ns]
  double work = 0.0;     ///< of the environment, for a second of touching [ms]
  bool front = false;    ///< nothing has as little error, step and work in this scene, told at once
  ex::at_rest still{};   ///< when hand and world hold still after the run
};
[[nodiscard]] ex::record record_of(const between_row& r);

/// Each figure the worst of all hands; and those of each hand by itself, whose scene is "organ, hand 1".
struct between_rows {
  std::vector<between_row> worst, by_hand;
};
[[nodiscard]] between_rows run_between(ex::report& out, const between_settings& chosen);

}  // namespace organ
