// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy at the port of a loop or a simulator that is not ours, in the same sense as here:
//
//     E = ∫ b v² dt − Σ f·Δx   [J]     f the force held during Δx; ∫ b v² dt ≥ Σ b|Δx|²/dt (mathematics.md L1)
//
//     sim::port_meter<scene> meter{0.1};                   // b, of the device itself [N·s/m]
//     meter.add(sample);                                   // in every tick, with what was held since the last
//     assert(meter.least() >= 0);                          // the promise of a passive port
//
// E is the energy that the hand has paid in, and −E the energy that it was given. The sum −Σ f·Δx without the work of
// the damper is no test: it falls some millijoules below zero at a port that is passive.

#include <passive_haptics/base/ledger.hpp>
#include <passive_haptics/device/device_sample.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

template <class Port>
class port_meter {
 public:
  /// The damping of the device [N·s/m], or less: then E is a lower bound.
  explicit port_meter(double damping) noexcept : damping_(damping) {}

  /// Adds a sample: the position [m], the force held on the way there [N] and the time dt [s]. One that is not
  /// valid, or whose dt is not positive, is left out, and the motion to the next good one is not booked.
  void add(const device_sample<Port>& sample) noexcept {
    const double dt = static_cast<double>(sample.dt);
    const bool good = sample.valid && dt > 0.0 && Port::is_finite(sample.position) &&
                      Port::is_finite(sample.held);
    if (good && seen_) {
      const auto moved = Port::between(last_, sample.position);
      energy_ += damping_ * static_cast<double>(Port::squared(moved)) / dt;
      energy_ += -static_cast<double>(Port::work(sample.held, moved).joules);
      if (value() < least_) least_ = value();
    }
    seen_ = good;
    if (good) last_ = sample.position;
  }
  [[nodiscard]] double value() const noexcept { return energy_; }  ///< E [J]
  [[nodiscard]] double least() const noexcept { return least_; }   ///< least E so far [J], ≤ 0

 private:
  double damping_;
  compensated_sum<double> energy_;
  double least_ = 0.0;
  typename Port::stored_pose last_{};
  bool seen_ = false;
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
