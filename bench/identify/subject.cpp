// SPDX-License-Identifier: BSD-3-Clause
#include "subject.hpp"

#include <passive_haptics/simulation/schedule.hpp>

namespace identify {

namespace {

/// Any of the frictions that a ledger covers, with the numbers of a subject.
struct drawn_friction {
  using state = std::array<double, 3>;
  subject s{};

  [[nodiscard]] auto ask(auto question) const noexcept {
    const double c = s.friction, p = s.presliding;
    switch (s.like) {
      case rubbing::three_springs:
        return question(
            sim::maxwell_slip<3>{{c / 3.0, c / 3.0, c / 3.0}, {p / 2.0, p, 1.5 * p}, 0.0});
      case rubbing::dupont:
        return question(sim::dupont_friction{c, 0.6 * p, p, 0.0});
      case rubbing::stribeck:
      case rubbing::rippled: {
        const double middle = c / (1.0 - s.ripple);
        return question(sim::stribeck_friction{middle, s.static_share * middle, s.stribeck_speed, p,
                                               s.ripple, s.wavelength, 0.0});
      }
      case rubbing::rigid:
      case rubbing::one_spring:
        break;
    }
    return question(sim::maxwell_slip<3>{{c, 0.0, 0.0}, {p, p, p}, 0.0});
  }
  [[nodiscard]] state begin() const noexcept {
    return ask([](const auto& m) {
      state z{};
      sim::detail::memory_of(m, z) = m.begin();
      return z;
    });
  }
  sim::friction_work slide(state& z, double from, double way, double time) const noexcept {
    return ask(
        [&](const auto& m) { return m.slide(sim::detail::memory_of(m, z), from, way, time); });
  }
  [[nodiscard]] double stiffness() const noexcept {
    return ask([](const auto& m) { return m.stiffness(); });
  }
  [[nodiscard]] sim::friction_claim claim() const noexcept {
    return ask([](const auto& m) { return m.claim(); });
  }
  [[nodiscard]] ph::parameter_fault check() const noexcept {
    return ask([](const auto& m) { return m.check(); });
  }
};
static_assert(sim::friction_model<drawn_friction> && sim::device_friction<drawn_friction>);

verdict measured(const subject& s, auto& device,
                 const identification::identification_parameters& p) {
  identification::axis_identification of(p);
  double force = 0.0;
  while (!of.done()) {
    const auto sample = device.exchange(force);
    force = of.tick(sample.position, ph::seconds{sample.dt});
  }
  return {s, of.result(), of.time()};
}

}  // namespace

const char* to_string(rubbing like) {
  switch (like) {
    case rubbing::rigid:
      return "rigid";
    case rubbing::one_spring:
      return "one spring";
    case rubbing::three_springs:
      return "three springs";
    case rubbing::dupont:
      return "Dupont";
    case rubbing::stribeck:
      return "Stribeck";
    case rubbing::rippled:
      return "rippled";
  }
  return "unknown friction";
}

subject draw(std::uint64_t seed) {
  sim::random_source random(seed);
  const auto evenly_by_logarithm = [&](double least, double most) {
    return least * std::pow(most / least, random.uniform());
  };
  subject s{.seed = seed};
  s.mass = evenly_by_logarithm(0.03, 1.0);
  s.damping = evenly_by_logarithm(0.01, 5.0);
  s.friction = random.uniform(0.0, 0.5);
  s.presliding = random.uniform(0.0, 50e-6);
  s.quantum = evenly_by_logarithm(1e-6, 100e-6);
  s.load = random.uniform(0.0, 1.0);
  s.latency = static_cast<int>(random.uniform(0.0, 4.0));
  s.static_share = random.uniform(1.0, 1.5);
  s.stribeck_speed = random.uniform(2e-3, 10e-3);
  s.wavelength = evenly_by_logarithm(0.2e-3, 5e-3);
  s.start = random.uniform(-0.01, 0.01);
  s.like = static_cast<rubbing>(1 + static_cast<int>(random.uniform(0.0, 5.0)));
  const double ripple = random.uniform(0.0, 0.3);
  if (s.like == rubbing::rippled) s.ripple = ripple;
  if (random.chance(0.05)) s.friction = 0.0;
  if (random.chance(0.05) || s.friction == 0.0) {
    s.like = rubbing::rigid;
    s.presliding = s.ripple = 0.0;
  }
  return s;
}

verdict identified(const subject& s, const identification::identification_parameters& p) {
  sim::device_parameters<line> truth{.mass = s.mass,
                                     .damping = s.damping,
                                     .quantum = s.quantum,
                                     .load = s.load,
                                     .start = s.start,
                                     .latency = s.latency};
  if (s.like == rubbing::rigid) {
    truth.friction = s.friction;
    sim::device<line> device(truth);
    return measured(s, device, p);
  }
  sim::device<line, sim::no_hand<line>, drawn_friction> device(truth, {}, {s});
  return measured(s, device, p);
}

}  // namespace identify
