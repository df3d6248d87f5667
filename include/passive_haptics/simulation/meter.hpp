// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The exact energy at the device port, from the true motion: the measure of every energy observer.
//
//     E(t) = ∫ b v² dt − Σ f_held·Δx                [J]   > 0: the hand has paid in
//
// A controller is passive at the port if minimum() ≥ −loan, the loan being the energy it was lent. The other
// flows are summed too, so that the balance of the simulation can be checked:
//
//     residual = Δ(½ m v²) + damping + friction + stored + stops − actuator − hand − load = 0
//
// Dry friction is a part of the device, too. with_friction() is E plus the energy that friction has taken and
// that its springs hold, which is the energy at the port of a device with friction.

#include <passive_haptics/base/ledger.hpp>

#include <initializer_list>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// Energies [J] of one interval: three sinks, each ≥ 0, the work of three sources on the device, and the energy
/// that the springs of the friction have taken up, which is < 0 if they gave some back.
struct energy_flows {
  double damping = 0.0;   ///< ∫ b v² dt
  double friction = 0.0;  ///< lost in dry friction: ∫ f_c |v| dt where it is rigid
  double stops = 0.0;     ///< lost in inelastic impacts
  double actuator = 0.0;  ///< f_held·Δx
  double hand = 0.0;      ///< F_hand·Δx
  double load = 0.0;      ///< F_load·Δx
  double stored = 0.0;    ///< taken up by the springs of an elastic friction
};

/// Sums the flows. The sums are compensated, so that 10⁻¹² J still counts after 10⁷ ticks.
class port_energy_meter {
 public:
  port_energy_meter() noexcept = default;
  /// Starts with a device of kinetic energy ½ m v² [J].
  explicit port_energy_meter(double kinetic) noexcept : kinetic_at_start_(kinetic) {}

  void book(const energy_flows& flows) noexcept {
    port_ += flows.damping;
    port_ += -flows.actuator;
    if (!(value() >= minimum_)) minimum_ = value();  // NaN is a minimum and stays one
    damping_ += flows.damping;
    friction_ += flows.friction;
    stops_ += flows.stops;
    actuator_ += flows.actuator;
    hand_ += flows.hand;
    load_ += flows.load;
    stored_ += flows.stored;
  }

  [[nodiscard]] double value() const noexcept { return port_; }       ///< E [J]
  [[nodiscard]] double minimum() const noexcept { return minimum_; }  ///< least E so far [J], ≤ 0
  [[nodiscard]] double hand_work() const noexcept { return hand_; }   ///< ∫ F_hand dx [J]
  [[nodiscard]] double friction() const noexcept { return friction_; }  ///< lost in friction [J]
  /// E plus the energy that dry friction has taken and stores [J].
  [[nodiscard]] double with_friction() const noexcept {
    return value() + friction() + double(stored_);
  }
  /// True if dry friction has taken or stores any energy.
  [[nodiscard]] bool rubbed() const noexcept { return friction() > 0.0 || double(stored_) != 0.0; }
  [[nodiscard]] energy_flows total() const noexcept {
    return {damping_, friction_, stops_, actuator_, hand_, load_, stored_};
  }

  /// The energy [J] that is missing from the balance, given the present ½ m v² [J]; zero up to rounding.
  [[nodiscard]] double residual(double kinetic) const noexcept {
    compensated_sum<double> sum = kinetic;
    for (const double part :
         {-kinetic_at_start_, double(damping_), double(friction_), double(stored_), double(stops_),
          -double(actuator_), -double(hand_), -double(load_)}) {
      sum += part;
    }
    return sum;
  }

 private:
  compensated_sum<double> port_, damping_, friction_, stops_, actuator_, hand_, load_, stored_;
  double minimum_ = 0.0;
  double kinetic_at_start_ = 0.0;
};

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
