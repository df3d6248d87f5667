// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a simulated device in a hand makes of a controller: joules created, when it came to rest, stiffness shown.
// A program ends with 1 if one of them is not as it was promised.

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/friction_elastic.hpp>
#include <passive_haptics/simulation/quiet.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

namespace ph = passive_haptics;
namespace sim = ph::simulation;

/// The device, the hand on it, a spring of `stiffness` N/m that pushes with `limit` N at most, and the judges.
/// Friction is elastic over `presliding` m; with sim::coulomb_friction as `Friction` it is what `device` says.
template <class Space, class Friction = sim::slider_and_spring>
class session {
 public:
  using vector = typename Space::vector;
  session(const sim::device_parameters<Space>& device, double limit, double friction = 0.0,
          double presliding = 1e-6, double stiffness = 300.0)
      : device_(device, {.stiffness = stiffness, .damping = stiffness / 300.0, .limit = limit},
                elastic(friction, presliding)) {}

  /// The hand goes to `target`, unless it is there, and holds still; `force_of`(sample) is the controller, ticked once
  /// a millisecond.
  template <class Force>
  void hold(const vector& target, double seconds, Force force_of, bool moves = true) {
    device_.hand().target = target;
    if (moves) judge_.news();
    for (int n = 0; n < 1000 * seconds; ++n) {
      const vector force = force_of(sample_);
      const double size = Space::norm(force);
      const vector along = size > 0.0 ? vector(force * (1.0 / size)) : Space::zero();
      judge_.add(force, device_.velocity(), 1e-3, std::span(&along, 1));
      sample_ = device_.exchange(force);
      least_ = std::min(least_, device_.meter().with_friction());
    }
  }
  /// On encoders of step q a force of K d steps by K q: what is at rest may step by that.
  void floor_of(double stiffness, double quantum, double mass) {
    judge_ = sim::quiet_judge<Space>(sim::quiet_bars{}.on_encoders(quantum, stiffness, mass));
  }
  [[nodiscard]] const auto& device() const { return device_; }

  /// Prints the verdict on a surface `depth` m deep, that presses with `force` N and was said to be `said` N/m.
  [[nodiscard]] int verdict(double force, double depth, double said, double loan = 0.0) const {
    const double created = -least_, shown = force / depth;
    const bool sound =
        created <= loan + 1e-9 && judge_.settling() < 1.5 && std::abs(shown / said - 1.0) < 0.05;
    std::printf("created %.2f mJ, at rest after %.1f s, pressed with %.2g N it shows %.4g N/m\n",
                1e3 * created + 0.0, judge_.settling(), force, shown);
    if (!sound) std::printf("promised: 0 mJ, at rest within 1.5 s, %.4g N/m\n", said);
    return sound ? 0 : 1;
  }
  [[nodiscard]] int verdict(const ph::explanation& e, double loan = 0.0) const {
    return verdict(e.force, e.depth, e.shown, loan);
  }

 private:
  [[nodiscard]] static Friction elastic(double friction, double presliding) {
    if constexpr (requires(Friction f) { f.presliding; }) {
      return {.level = {friction}, .presliding = {presliding}};
    } else {
      return {};
    }
  }

  sim::device<Space, sim::impedance_hand<Space>, Friction> device_;
  ph::device_sample<Space> sample_ = device_.exchange(Space::zero());
  sim::quiet_judge<Space> judge_{};
  double least_ = 0.0;  ///< energy at the port, with what friction took [J]
};
