// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fault injection: a device whose samples are wrong at chosen ticks. The true device behind it moves on, so its
// meter shows the true cost of a fault.

#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/simulation/components.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

enum class sample_fault : std::uint8_t {
  nan_position,
  infinite_position,
  nan_held,  ///< the driver reports a force that is no number
  zero_dt,
  negative_dt,
  nan_dt,
  jump,       ///< the first axis is off by scripted_fault::jump
  no_answer,  ///< valid is false
};

struct scripted_fault {
  std::int64_t tick = -1;  ///< counted from 0; −1: never
  sample_fault kind = sample_fault::no_answer;
  double jump = 0.1;  ///< [m]
};

/// Models haptic_device_for<Space>.
///     scripted_device broken{simulated, std::array{scripted_fault{100, sample_fault::zero_dt}}};
template <class Device, std::size_t Faults>
class scripted_device {
 public:
  using space_type = typename Device::space_type;
  using vector = typename Device::vector;

  scripted_device(const Device& device, const std::array<scripted_fault, Faults>& script) noexcept
      : device_(device), script_(script) {}

  auto exchange(const vector& force) noexcept {
    auto sample = device_.exchange(force);
    for (const scripted_fault& fault : script_) {
      if (fault.tick == tick_) spoil(sample, fault);
    }
    ++tick_;
    return sample;
  }

  /// The true position [m], which no fault changes.
  [[nodiscard]] const auto& position() const noexcept { return device_.position(); }
  [[nodiscard]] double time() const noexcept { return device_.time(); }
  [[nodiscard]] const auto& meter() const noexcept { return device_.meter(); }
  [[nodiscard]] Device& device() noexcept { return device_; }
  [[nodiscard]] const Device& device() const noexcept { return device_; }
  [[nodiscard]] std::int64_t tick() const noexcept { return tick_; }  ///< of the next exchange

 private:
  template <class Sample>
  static void spoil(Sample& sample, const scripted_fault& fault) noexcept {
    using scalar = decltype(sample.dt);
    constexpr scalar nan = std::numeric_limits<scalar>::quiet_NaN();
    switch (fault.kind) {
      case sample_fault::nan_position:
        passive_haptics::simulation::component(sample.position, 0) = nan;
        break;
      case sample_fault::infinite_position:
        passive_haptics::simulation::component(sample.position, 0) =
            std::numeric_limits<scalar>::infinity();
        break;
      case sample_fault::nan_held:
        passive_haptics::simulation::component(sample.held, 0) = nan;
        break;
      case sample_fault::zero_dt:
        sample.dt = scalar(0);
        break;
      case sample_fault::negative_dt:
        sample.dt = -sample.dt;
        break;
      case sample_fault::nan_dt:
        sample.dt = nan;
        break;
      case sample_fault::jump:
        passive_haptics::simulation::component(sample.position, 0) +=
            static_cast<scalar>(fault.jump);
        break;
      case sample_fault::no_answer:
        sample = {};
        break;
    }
  }

  Device device_;
  std::array<scripted_fault, Faults> script_;
  std::int64_t tick_ = 0;
};
