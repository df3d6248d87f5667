// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Surfaces, clocks and sensors at their worst; the menu is in adversary.hpp.

#include <passive_haptics/simulation/schedule.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// Where the surface has jumped to, along its normal [m].
class jumping_surface {
 public:
  constexpr explicit jumping_surface(double amplitude = 2e-3, std::uint64_t seed = 1) noexcept
      : amplitude_(amplitude), schedule_(seed), random_(~seed) {}
  [[nodiscard]] constexpr double offset(double time) noexcept {
    if (schedule_.due(time)) offset_ = random_.uniform(-amplitude_, amplitude_);
    return offset_;
  }

 private:
  double amplitude_;
  double offset_ = 0.0;
  update_schedule schedule_;
  random_source random_;
};

/// The stiffness of the moment [N/m].
class switching_stiffness {
 public:
  constexpr switching_stiffness(double low, double high, std::uint64_t seed = 1) noexcept
      : now_(high), other_(low), schedule_(seed) {}
  [[nodiscard]] constexpr double stiffness(double time) noexcept {
    if (schedule_.due(time)) std::swap(now_, other_);
    return now_;
  }

 private:
  double now_, other_;
  update_schedule schedule_;
};

/// A flat piece of surface at one moment, whatever the Space computes in.
template <class Space>
struct surface_state {
  using vector = typename physical<Space>::vector;
  vector point = physical<Space>::zero();   ///< on the surface [m]
  vector normal = physical<Space>::zero();  ///< unit, outward
  double stiffness = 0.0;                   ///< K [N/m]

  /// (p − x)·n [m], > 0 inside.
  [[nodiscard]] double depth(const vector& x) const noexcept {
    return physical<Space>::dot(vector(point - x), normal);
  }
};

/// What an erratic surface may do at an update.
struct surface_habits {
  bool jumps = false;  ///< it moves along its normal to within ±jump of where it started
  bool flips = false;  ///< any normal, often the opposite, at a depth within ±jump of the device
  bool switches = false;  ///< its stiffness goes from the one end to the other, or anywhere between
};

/// A surface that does one or several of these every 20-50 ms; with flips every 2-20 ms.
template <class Space>
class erratic_surface {
 public:
  using vector = typename physical<Space>::vector;

  erratic_surface(const surface_state<Space>& first, surface_habits habits, double jump,
                  double softest, double stiffest, std::uint64_t seed) noexcept
      : now_(first),
        first_(first.point),
        habits_(habits),
        jump_(jump),
        softest_(softest),
        stiffest_(stiffest),
        schedule_(seed, habits.flips ? 0.002 : 0.020, habits.flips ? 0.020 : 0.050),
        random_(~seed) {}

  /// Moves on to this time [s], with the device at x [m]; true if anything has changed.
  bool update(double time, const vector& x) noexcept {
    if (!schedule_.due(time) || !(habits_.jumps || habits_.flips || habits_.switches)) return false;
    const double offset = random_.uniform(-jump_, jump_);
    if (habits_.flips) {
      const bool back = random_.chance(0.3);
      now_.normal = back ? vector(-now_.normal) : random_.template direction<Space>();
      now_.point = x + now_.normal * offset;
    } else if (habits_.jumps) {
      now_.point = first_ + now_.normal * offset;
    }
    if (habits_.switches) now_.stiffness = another_stiffness();
    return true;
  }
  [[nodiscard]] const surface_state<Space>& now() const noexcept { return now_; }

 private:
  [[nodiscard]] double another_stiffness() noexcept {
    if (random_.chance(0.3)) return random_.uniform(softest_, stiffest_);
    return now_.stiffness > (softest_ + stiffest_) / 2.0 ? softest_ : stiffest_;
  }

  surface_state<Space> now_;
  vector first_;
  surface_habits habits_;
  double jump_, softest_, stiffest_;
  update_schedule schedule_;
  random_source random_;
};

/// Periods [s]: all the same, or uniform in [½, 1] of it, and with `overruns` one in fifty 2 to 20
/// times as long.
struct erratic_clock {
  double longest_tick = 1e-3;  ///< [s]
  bool jitter = false;
  bool overruns = false;

  [[nodiscard]] double next(random_source& random) const noexcept {
    if (overruns && random.chance(0.02)) return longest_tick * random.uniform(2.0, 20.0);
    return jitter ? longest_tick * random.uniform(0.5, 1.0) : longest_tick;
  }
};

/// Every 25th sample or so is lost, and with it up to four that follow.
struct erratic_sensor {
  bool dropouts = false;
  int still_lost = 0;

  [[nodiscard]] bool loses_one(random_source& random) noexcept {
    if (!dropouts) return false;
    if (still_lost > 0) return still_lost-- > 0;
    if (!random.chance(0.04)) return false;
    still_lost = static_cast<int>(random.uniform(0.0, 5.0));
    return true;
  }
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
