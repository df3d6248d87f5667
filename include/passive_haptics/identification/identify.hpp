// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Identifies a device axis by axis, in a loop of its own, before a composition states its numbers.
//
//     std::printf("let go of the device: it will push with up to %g N\n", p.force);
//     const auto found = identification::identify<scene>(device, p, [&] { return stop.load(); });
//     if (found.problem()) std::puts(found.problem());
//     else std::cout << identification::composition_of(found);        // describe.hpp
//
// It takes at most a minute for each axis. Meanwhile a soft damped spring keeps each other axis where it began. The
// last command is always a force of zero, also if it is stopped or has a problem, so hold the device then. In a loop of
// your own call axis_identification::tick() instead.

#include <passive_haptics/identification/axis_identification.hpp>
#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

namespace detail {

/// A soft damped spring that keeps an axis where it was. It rings on an axis lighter than 30 g, or in a loop more
/// than 5 ticks late.
class soft_hold {
 public:
  double tick(double position, seconds<double> length, double most) noexcept {
    const double dt = length.count();
    if (!kernels::is_finite(position) || !passive_haptics::detail::positive(dt)) return 0.0;
    if (!begun_) home_ = last_ = position;
    begun_ = true;
    speed_ += ((position - last_) / dt - speed_) * dt / (dt + filter);
    last_ = position;
    return std::clamp(-stiffness * (position - home_) - damping * speed_, -most, most);
  }

 private:
  static constexpr double stiffness = 100.0;  // [N/m]
  static constexpr double damping = 1.5;      // [N·s/m]
  static constexpr double filter = 3e-3;      // [s]

  double home_ = 0.0, last_ = 0.0, speed_ = 0.0;
  bool begun_ = false;
};

/// Commands zero force when it is destroyed.
template <class P, class Device>
struct no_force_at_the_end {
  Device& device;
  explicit no_force_at_the_end(Device& d) noexcept : device(d) {}
  no_force_at_the_end(const no_force_at_the_end&) = delete;
  no_force_at_the_end& operator=(const no_force_at_the_end&) = delete;
  ~no_force_at_the_end() { static_cast<void>(device.exchange(typename P::effort(P::zero()))); }
};

}  // namespace detail

/// Identifies every axis of `device`, one after the other. It calls stop() once a tick and ends if that is true.
template <port P, haptic_device_for<P> Device, class Stop>
[[nodiscard]] device_found<P::dof> identify(Device& device, const identification_parameters& p,
                                            Stop&& stop) {
  device_found<P::dof> found{.force_limit = p.force, .drift = p.trust.drift};
  std::array<detail::soft_hold, static_cast<std::size_t>(P::dof)> hold{};
  for (int axis = 0; axis < P::dof; ++axis) {
    axis_identification of(p,
                           static_cast<double>(std::numeric_limits<typename P::scalar>::epsilon()));
    const detail::no_force_at_the_end<P, Device> end(device);
    typename P::effort force = P::zero();
    while (!of.done()) {
      const auto sample = device.exchange(force);
      const typename P::pose x = sample.position;
      const seconds<double> dt = seconds{sample.dt};
      if (stop()) of.stop();
      force = P::zero();
      for (int i = 0; i < P::dof && !of.done(); ++i) {
        const auto place = static_cast<double>(P::component(x, i));
        double f = 0.0;
        if (i == axis) {
          f = sample.valid ? of.tick(place, dt) : of.lost();
        } else if (sample.valid) {
          f = hold[static_cast<std::size_t>(i)].tick(place, dt, p.force);
        }
        P::component(force, i) = static_cast<typename P::scalar>(f);
      }
    }
    found.axes[static_cast<std::size_t>(axis)] = of.result();
    if (of.problem() != nullptr) {
      for (int i = axis + 1; i < P::dof; ++i) {
        found.axes[static_cast<std::size_t>(i)].problem = "not measured: an axis before it failed";
      }
      break;
    }
  }
  return found;
}
template <port P, haptic_device_for<P> Device>
[[nodiscard]] device_found<P::dof> identify(Device& device,
                                            const identification_parameters& p = {}) {
  return identify<P>(device, p, [] { return false; });
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
