// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated device with a mass hung on its handle, or none: it pulls, and moves along.

#include <passive_haptics/simulation/device.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace identify {

namespace sim = passive_haptics::simulation;

/// What pulls at the handle: a weight, cogging, a hand that holds.
template <class Space>
struct pull {
  using vector = typename sim::physical<Space>::vector;

  std::array<double, static_cast<std::size_t>(Space::dof)> weight{};  ///< [N]
  double cogging = 0.0, wavelength = 1e-3;                            ///< [N], [m]
  double grip = 0.0;  ///< holds every axis at 0 [N/m]
  double push = 0.0;  ///< comes and goes, twice in five seconds [N]

  [[nodiscard]] vector force(double t, const vector& x, const vector& v) const noexcept {
    vector all = sim::physical<Space>::zero();
    for (int i = 0; i < Space::dof; ++i) {
      const double at = sim::component(x, i);
      double& f = sim::component(all, i);
      f = weight[static_cast<std::size_t>(i)] - grip * at + push * std::sin(2.5 * t);
      if (cogging > 0.0) f += cogging * std::sin(2.0 * std::numbers::pi * at / wavelength);
      if (grip > 0.0) f -= 2.0 * sim::component(v, i);
    }
    return all;
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] passive_haptics::parameter_fault check() const noexcept { return {}; }
};

/// Models haptic_device_for<Space>.
template <class Space, class Friction = sim::coulomb_friction>
class hung_device {
 public:
  using simulated = sim::device<Space, pull<Space>, Friction>;

  explicit hung_device(const sim::device_parameters<Space>& truth, const Friction& friction = {})
      : truth_(truth), friction_(friction), now_(truth, {}, friction) {}

  passive_haptics::device_sample<Space> exchange(const typename Space::vector& force) noexcept {
    return now_.exchange(force);
  }
  /// From now on `mass` [kg] moves along, and that pulls.
  void hang(double mass, const pull<Space>& pulls) {
    auto p = truth_;
    p.mass += mass;
    for (int i = 0; i < Space::dof; ++i) {
      sim::component(p.start, i) = sim::component(now_.position(), i);
      sim::component(p.start_velocity, i) = sim::component(now_.velocity(), i);
    }
    now_ = simulated(p, pulls, friction_);
  }
  [[nodiscard]] const simulated& device() const noexcept { return now_; }

 private:
  sim::device_parameters<Space> truth_;
  Friction friction_;
  simulated now_;
};

}  // namespace identify
