// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One axis of a device under a constant force and an elastic friction; axis.hpp is for rigid friction.
//
//     m ẍ + b ẋ = F − F_f(x, ẋ, memory),     lower ≤ x ≤ upper
//
// The time is cut into steps δ [s] of at most a sixteenth of a radian of the mass on the friction's spring. In
// each step F_f is the mean friction along the way Δ [m] of that step, taken at constant velocity:
//
//     Δ = Δ(F) − s W(Δ)/Δ          Δ(F): the exact way without friction; s = Δ(1 N); W: slide().work
//
// So the work of F_f is W(Δ), and the energy balance closes to rounding for any step (a discrete gradient). The
// motion itself is of second order in δ: an undamped oscillation within p comes out slow by at most 1/3000.

#include <passive_haptics/simulation/axis.hpp>
#include <passive_haptics/simulation/friction_model.hpp>

#include <cmath>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

namespace detail {

struct slid {
  friction_work took{};  ///< work of a step against the friction [J]
  double mean = 0.0;     ///< mean friction along its way [N]
};

/// One step: solves the equation above for Δ.
template <friction_model Model>
class friction_step {
 public:
  friction_step(const Model& model, const axis& along, const axis_state& from, double force,
                const flow& ahead) noexcept
      : model_(model),
        from_(from),
        ahead_(ahead),
        free_(ahead.displacement(from.velocity, force / along.mass)),
        ease_(ahead.displacement(0.0, 1.0 / along.mass)) {}

  /// Solves for Δ by regula falsi, in a bracket that begins at the friction of the first trial, and moves the memory.
  [[nodiscard]] slid solve(typename Model::state& memory) const noexcept {
    const double first = free_ - ease_ * mean(memory, free_ < 0.0 ? -tiny : tiny);
    const double accepted = 4.0 * epsilon * (std::abs(free_) + std::abs(first));
    double a = first;
    double at_a = residue(memory, a);
    double b = a;
    double at_b = at_a;
    for (double reach = 1.5 * std::abs(at_a); at_a * at_b > 0.0; reach *= 2.0) {
      a = b;
      at_a = at_b;
      b = first + (at_a > 0.0 ? -reach : reach);
      at_b = residue(memory, b);
    }
    for (int i = 0; i < 200 && std::abs(at_b) > accepted && std::abs(b - a) > epsilon * std::abs(b);
         ++i) {
      double next = b - at_b * (b - a) / (at_b - at_a);
      if (!((next - a) * (next - b) < 0.0)) next = a + (b - a) / 2.0;
      const double at_next = residue(memory, next);
      if (at_next * at_b <= 0.0) {
        a = b;
        at_a = at_b;
      } else {
        at_a /= 2.0;  // Illinois rule: the value at the end that stays is halved
      }
      b = next;
      at_b = at_next;
    }
    slid made{.mean = mean(memory, b)};
    made.took = model_.slide(memory, from_.position, b, ahead_.duration());
    return made;
  }

 private:
  [[nodiscard]] double mean(typename Model::state memory, double way) const noexcept {
    if (std::abs(way) < tiny) way = way < 0.0 ? -tiny : tiny;
    return model_.slide(memory, from_.position, way, ahead_.duration()).work / way;
  }
  [[nodiscard]] double residue(const typename Model::state& memory, double way) const noexcept {
    return way - free_ + ease_ * mean(memory, way);
  }

  static constexpr double tiny = 1e-18;  // [m]
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  const Model& model_;
  const axis_state& from_;
  const flow& ahead_;
  double free_, ease_;
};

/// One step with inelastic end stops; returns the time it took [s], less than ahead.duration() if it ended at a
/// stop.
template <friction_model Model>
double step_with_friction(const Model& model, typename Model::state& memory, const axis& along,
                          axis_state& s, double force, const flow& ahead,
                          axis_motion& done) noexcept {
  const auto try_for = [&](const flow& time, typename Model::state& m) {
    return friction_step<Model>(model, along, s, force, time).solve(m);
  };
  const auto way_of = [&](const flow& time, const slid& made) {
    return time.displacement(s.velocity, (force - made.mean) / along.mass);
  };
  const auto book = [&](const flow& time, const slid& made) {
    const double a = (force - made.mean) / along.mass;
    const double way = way_of(time, made);
    done.displacement += way;
    done.damping += along.damping * time.squared_speed(s.velocity, a);
    done.friction += made.took.dissipated;
    done.stored += made.took.work - made.took.dissipated;
    s = {s.position + way, time.velocity(s.velocity, a)};
  };
  const auto hit = [&](double stop) {
    done.stops += along.mass * s.velocity * s.velocity / 2.0;
    s = {stop, 0.0};
  };
  typename Model::state after = memory;
  const slid whole = try_for(ahead, after);
  const double there = s.position + way_of(ahead, whole);
  const double way = there < s.position ? -1.0 : 1.0;
  const double stop = way > 0.0 ? along.upper : along.lower;
  if ((there - stop) * way <= 0.0) {
    memory = after;
    book(ahead, whole);
    return ahead.duration();
  }
  if ((stop - s.position) * way <= 0.0) {
    hit(stop);
    return ahead.duration();
  }
  double early = 0.0;
  double late = ahead.duration();
  for (int i = 0; i < 60; ++i) {
    const double middle = early + (late - early) / 2.0;
    const flow until = along.over(middle);
    typename Model::state trial = memory;
    const double reached = s.position + way_of(until, try_for(until, trial));
    ((reached - stop) * way >= 0.0 ? late : early) = middle;
  }
  const flow until = along.over(late);
  book(until, try_for(until, memory));
  hit(stop);
  return late;
}

}  // namespace detail

/// Moves `state` and the friction's memory through whole.duration() under `force` [N].
template <friction_model Model>
axis_motion advance_with_friction(const Model& model, typename Model::state& memory,
                                  const axis& along, axis_state& state, double force,
                                  const flow& whole) noexcept {
  const double h = whole.duration();
  const double radians = h * std::sqrt(model.stiffness() / along.mass);
  const double pieces = std::fmin(std::fmax(std::ceil(radians * 16.0), 1.0), 4096.0);
  const flow step = pieces > 1.0 ? along.over(h / pieces) : whole;
  axis_motion done;
  for (int i = 0; i < static_cast<int>(pieces); ++i) {
    double left = step.duration();
    for (int part = 0; part < 5 && left > 0.0; ++part) {
      const flow ahead = part == 0 ? step : along.over(left);
      left -= detail::step_with_friction(model, memory, along, state, force, ahead, done);
    }
  }
  return done;
}

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
