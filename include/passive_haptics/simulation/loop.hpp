// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The loop of a simulation, written once, for tests, challenges and benchmarks.
//
//   world(now) ──▶ model ──▶ hand(now) ──▶ device ──▶ meter ──▶ watch(now) ──▶ world(now) …
//   moves the      computes  chooses its   holds the            reads the
//   surface or     a force   motion, with  force for            next sample
//   loses the      from the  the force     one period           and the energy
//   sample         sample    known
//
//     const auto seen = sim::run(device, model, 3000, [&](auto& now) {
//       if (now.tick % 40 == 0) model.update(surface_at(now.time));
//       if (random.chance(0.05)) now.sample = {};  // lost
//     });
//     CHECK(seen.least_energy >= -1e-12);
//
// Each of the three steps may be left out, and is sim::idle if a later one is given. A step that returns false
// ends the run.

#include <passive_haptics/device/device_sample.hpp>
#include <passive_haptics/simulation/components.hpp>
#include <passive_haptics/simulation/meter.hpp>

#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// A device that knows its true position, the time and the true energy at its port.
template <class D>
concept simulated_device = requires(D d, const D c, const typename D::space_type::vector f) {
  { d.exchange(f) } -> std::same_as<device_sample<typename D::space_type>>;
  { c.position() } -> std::convertible_to<typename physical<typename D::space_type>::vector>;
  { c.time() } -> std::convertible_to<double>;
  { c.meter() } -> std::convertible_to<const port_energy_meter&>;
};

/// One tick of a run. Each step finds those fields set that are known when it is called.
template <class Space, class Answer>
struct turn {
  int tick = 0;
  double time = 0.0;                          ///< at its start [s]
  typename physical<Space>::vector position;  ///< at its start, true [m]
  device_sample<Space> sample;  ///< the sample that the model is given; for watch, the next one
  Answer out{};                 ///< the whole answer of the model
  typename Space::vector force = Space::zero();  ///< commanded [N]
};

template <class Space>
struct run_result {
  double least_energy =
      0.0;  ///< least port energy, with what dry friction took and stores [J]; ≤ 0, or NaN
  double largest_force = 0.0;   ///< commanded [N]; if it is 0 the model has shown nothing
  int ticks = 0;                ///< number of ticks that ended
  device_sample<Space> last{};  ///< the last sample, which the model has not been given
};

struct idle_step {
  constexpr void operator()(const auto& /*now*/) const noexcept {}
};
inline constexpr idle_step idle{};

namespace detail {

/// A model has tick(sample), or is a function.
struct ask_model {
  template <class Model, class Sample>
  requires requires(Model& m, const Sample& s) { m.tick(s); }
  constexpr auto operator()(Model& model, const Sample& sample) const
      noexcept(noexcept(model.tick(sample))) {
    return model.tick(sample);
  }
  template <class Model, class Sample>
  constexpr auto operator()(Model& model, const Sample& sample) const
      noexcept(noexcept(model(sample))) {
    return model(sample);
  }
};

/// The force of an answer, which is a force or a result with one.
template <class Answer>
[[nodiscard]] constexpr auto force_of(const Answer& out) noexcept {
  if constexpr (requires { out.force; }) {
    return out.force;
  } else {
    return out;
  }
}

template <class Space, class Model>
using turn_of =
    turn<Space,
         decltype(ask_model{}(std::declval<Model&>(), std::declval<device_sample<Space>>()))>;

template <class Space, class Model, class... Steps>
inline constexpr bool never_throws =
    noexcept(ask_model{}(std::declval<Model&>(), std::declval<device_sample<Space>>())) &&
    (std::is_nothrow_invocable_v<Steps&, turn_of<Space, Model>&> && ...);

template <class Step, class Turn>
[[nodiscard]] constexpr bool goes_on(Step& step, Turn& now) noexcept(noexcept(step(now))) {
  if constexpr (std::is_void_v<decltype(step(now))>) {
    step(now);
    return true;
  } else {
    return step(now);
  }
}

}  // namespace detail

/// Runs `ticks` ticks, after reading the device once. A command that is not finite ends the run before it is
/// held, and the least energy is NaN. Throws only what a step throws.
template <simulated_device Device, class Model, class World = idle_step, class Hand = idle_step,
          class Watch = idle_step>
run_result<typename Device::space_type> run(
    Device& device, Model&& model, int ticks, World&& world = {}, Hand&& hand = {},
    Watch&& watch =
        {}) noexcept(detail::never_throws<typename Device::space_type, Model, World, Hand, Watch>) {
  using Space = typename Device::space_type;
  run_result<Space> result{.last = device.exchange(Space::zero())};
  while (result.ticks < ticks) {
    detail::turn_of<Space, Model> now{.tick = result.ticks,
                                      .time = device.time(),
                                      .position = device.position(),
                                      .sample = result.last};
    if (!detail::goes_on(world, now)) break;
    now.out = detail::ask_model{}(model, now.sample);
    now.force = detail::force_of(now.out);
    if (!Space::is_finite(now.force)) {
      result.least_energy = std::numeric_limits<double>::quiet_NaN();
      break;
    }
    if (!detail::goes_on(hand, now)) break;
    now.sample = result.last = device.exchange(now.force);

    ++result.ticks;
    const port_energy_meter& meter = device.meter();
    const double least = meter.rubbed() ? meter.with_friction() : meter.minimum();
    if (!(least >= result.least_energy)) result.least_energy = least;  // also if least is NaN
    result.largest_force =
        kernels::larger(result.largest_force, physical<Space>::norm(to_physical<Space>(now.force)));
    if (!detail::goes_on(watch, now)) break;
  }
  return result;
}

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
