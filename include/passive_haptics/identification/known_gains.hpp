// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device whose motors deliver g newtons for each newton commanded, g known for each axis to within a tolerance ε:
//
//     known_gains<scene, my_device> grip{device, found.likely, found.tolerance(true)};
//     ph::reduced_energy ledger{.damping = grip.damping(b)};                      // b/(1 + ε)²
//     sample = grip.exchange(out.force); out = wall.tick(sample);
//
// Commands are divided by g. What a sample reports as held is, on each axis, that of all forces within the tolerance
// which has given out the most: (1 + ε) f where the axis has gone along with f, (1 − ε) f where it has gone against it.
//
// So a ledger never books more than is true: b Δx²/T − g f·Δx ≥ b Δx²/T − Σ (fᵢ Δxᵢ + ε |fᵢ Δxᵢ|). And a true tick gives
// out at most T (1 + ε)² f²/(4 b), which is what strict_bound keeps for a damping of b/(1 + ε)². Ours; for exact
// positions and strict_bound: on encoders the way within a step may have another sign than the step, and what a mass
// can reach is not scaled here.
//
// On one axis nothing has to be covered tick by tick: m ẍ = g f − b ẋ − F + h, divided by g, is a device of m/g, b/g and
// F/g under the force that is commanded and a hand of h/g, and its energy is the true one divided by g. So every ledger
// and bound, on encoders, too, keeps its promise if it is told in_commands(device, ε), and a hand of h/(1 − ε). On
// several axes each is divided by a g of its own, and the sum of their energies is not that of one device.

#include <passive_haptics/port/concepts.hpp>

#include <array>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// What to state of a device of one axis whose motor delivers, for each newton commanded, 1 ± `tolerance` N.
template <class Described>
[[nodiscard]] constexpr Described in_commands(Described device, double tolerance) noexcept {
  device.mass /= 1.0 + tolerance;
  device.damping /= 1.0 + tolerance;
  if constexpr (requires { device.friction; }) device.friction /= 1.0 + tolerance;
  return device;
}

template <port P, haptic_device_for<P> Device>
class known_gains {
 public:
  using scalar = typename P::scalar;
  using effort = typename P::effort;
  using numbers = std::array<double, static_cast<std::size_t>(P::dof)>;

  /// Takes finite gains > 0 and a tolerance from 0 to 1: with others its samples are not valid.
  known_gains(Device& device, const numbers& gains, double tolerance) noexcept
      : device_(device), gains_(gains), tolerance_(tolerance) {
    for (const double g : gains_) sound_ = sound_ && passive_haptics::detail::positive(g);
    sound_ = sound_ && tolerance_ >= 0.0 && tolerance_ < 1.0;
  }
  device_sample<P> exchange(const effort& force) noexcept {
    effort command = P::zero();
    for (int i = 0; i < P::dof && sound_; ++i) {
      P::component(command, i) =
          P::component(force, i) / static_cast<scalar>(gains_[static_cast<std::size_t>(i)]);
    }
    auto sample = device_.exchange(command);
    sample.valid = sample.valid && sound_;
    if (!sample.valid) return sample;
    const typename P::pose here = sample.position;
    if (!known_) last_ = here;
    const typename P::pose before = last_;
    const typename P::motion moved = P::between(before, here);
    effort held = sample.held;
    for (int i = 0; i < P::dof; ++i) {
      scalar& f = P::component(held, i);
      f *= static_cast<scalar>(gains_[static_cast<std::size_t>(i)]);
      f *= static_cast<scalar>(f * P::component(moved, i) > scalar(0) ? 1.0 + tolerance_
                                                                      : 1.0 - tolerance_);
    }
    sample.held = held;
    last_ = here;
    known_ = true;
    return sample;
  }
  /// The damping to state [N·s/m], of a true one of b.
  [[nodiscard]] double damping(double b) const noexcept {
    return b / ((1.0 + tolerance_) * (1.0 + tolerance_));
  }

 private:
  Device& device_;
  numbers gains_;
  double tolerance_;
  typename P::stored_pose last_{};
  bool known_ = false, sound_ = true;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
