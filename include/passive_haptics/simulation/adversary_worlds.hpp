// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Surfaces, clocks and sensors that behave badly; the menu is in adversary.hpp.

#include <passive_haptics/simulation/schedule.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// A surface that jumps to a random offset(time) along its normal [m] every 20-50 ms.
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

/// A stiffness(time) [N/m] that switches between two values every 20-50 ms.
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

/// A flat surface at one moment, in double for any Space.
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

/// The changes that an erratic surface makes at an update, and their pace.
struct surface_habits {
  bool jumps = false;  ///< it moves along its normal to within ±jump of where it started
  bool flips = false;  ///< any normal, often the opposite, at a depth within ±jump of the device
  bool switches = false;  ///< its stiffness goes from one end to the other, or anywhere between
  bool hurries = false;   ///< it updates every 1 to 10 ms
};

/// A surface that does these things at updates every 20-50 ms; if it flips every 2-20 ms, and if it
/// hurries every 1-10 ms.
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
        schedule_(schedule_of(habits, seed)),
        random_(~seed) {}

  /// Moves on to `time` [s], with the device at x [m]; returns true if anything has changed.
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
  [[nodiscard]] static update_schedule schedule_of(const surface_habits& habits,
                                                   std::uint64_t seed) noexcept {
    if (habits.hurries) return update_schedule(seed, 0.001, 0.010);
    return habits.flips ? update_schedule(seed, 0.002, 0.020) : update_schedule(seed);
  }
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

/// Periods [s]: each is longest_tick, or with `jitter` uniform in [½, 1] of it; with `overruns` one in fifty
/// is 2 to 20 times as long.
struct erratic_clock {
  double longest_tick = 1e-3;  ///< [s]
  bool jitter = false;
  bool overruns = false;

  [[nodiscard]] double next(random_source& random) const noexcept {
    if (overruns && random.chance(0.02)) return longest_tick * random.uniform(2.0, 20.0);
    return jitter ? longest_tick * random.uniform(0.5, 1.0) : longest_tick;
  }
};

/// With `dropouts` about every 25th sample is lost, and up to four that follow it.
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

/// How the error of a noisy sensor behaves. A ledger may assume only that the error is bounded.
enum class noise_habit : std::uint8_t {
  uniform,        ///< drawn anew for each sample and axis
  hiding,         ///< the position shown is constant as long as the width allows it
  alternating,    ///< +width/2 and −width/2 in turn
  with_force,     ///< ±width/2 with the sign of the last change of the force
  against_force,  ///< ±width/2 with the opposite sign
};

/// A sensor whose positions are off by at most `width`/2 [m] on each axis.
template <class Space>
class noisy_sensor {
 public:
  using vector = typename physical<Space>::vector;
  using coordinates = typename physical<Space>::coordinates;

  noisy_sensor(double width, noise_habit habit, std::uint64_t seed) noexcept
      : half_(width / 2.0), habit_(habit), random_(seed) {}

  /// The error of the sample at x [m], with the force that was commanded last [N].
  [[nodiscard]] vector error(const vector& x, const vector& force) noexcept {
    vector e = physical<Space>::zero();
    if (!(half_ > 0.0)) return e;
    odd_ = !odd_;
    for (int i = 0; i < Space::dof; ++i) {
      double& last = component(error_, i);
      const double change = component(force, i) - component(force_, i);
      const double side = change > 0.0 ? 1.0 : change < 0.0 ? -1.0 : 0.0;
      switch (habit_) {
        case noise_habit::uniform:
          last = random_.uniform(-half_, half_);
          break;
        case noise_habit::hiding:
          last = clamped(started_ ? last + component(x_, i) - component(x, i) : 0.0);
          break;
        case noise_habit::alternating:
          last = odd_ ? half_ : -half_;
          break;
        case noise_habit::with_force:
          if (side != 0.0) last = side * half_;
          break;
        case noise_habit::against_force:
          if (side != 0.0) last = -side * half_;
          break;
      }
      component(e, i) = last;
      component(x_, i) = component(x, i);
      component(force_, i) = component(force, i);
    }
    started_ = true;
    return e;
  }
  /// The way [m] that the next position may lie below or above this one on axis i while the sensor shows the same.
  [[nodiscard]] double room_below(int i) const noexcept { return half_ - component(error_, i); }
  [[nodiscard]] double room_above(int i) const noexcept { return half_ + component(error_, i); }

 private:
  [[nodiscard]] double clamped(double e) const noexcept {
    return kernels::smaller(kernels::larger(e, -half_), half_);
  }

  double half_;
  noise_habit habit_;
  random_source random_;
  coordinates x_{}, force_{}, error_{};
  bool odd_ = false, started_ = false;
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
