// SPDX-License-Identifier: BSD-3-Clause
#include "contenders.hpp"

#include "../common/options.hpp"
#include <passive_haptics/published/published.hpp>

namespace papers {

namespace {

using plane = ph::half_space<line>;

/// A port that is given the force of a spring, as a renderer of its own would compute it.
template <class Port>
struct rendered {
  Port port;
  plane surface{.point = 0.0, .normal = -1.0, .stiffness = 1.0};

  bool update(const plane& next) noexcept {
    surface = next;
    return true;
  }
  ph::tick_result<line> tick(const ph::device_sample<line>& s) noexcept {
    const double depth = (surface.point - s.position) * surface.normal;
    const auto out = port.tick(s, depth > 0.0 ? surface.stiffness * depth * surface.normal : 0.0);
    return {out.force, std::max(depth, 0.0), out.energy};
  }
  [[nodiscard]] const plane& local() const noexcept { return surface; }
  [[nodiscard]] double energy() const noexcept { return port.energy(); }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return port.check(); }
};

/// Several surfaces, of which there is one.
template <class Port>
struct one_of_several {
  Port port;
  plane surface{.point = 0.0, .normal = -1.0, .stiffness = 1.0};

  bool update(const plane& next) noexcept {
    surface = next;
    return port.source().update(0, next);
  }
  ph::tick_result<line> tick(const ph::device_sample<line>& s) noexcept {
    const auto out = port.tick(s);
    return {out.force, std::max((surface.point - s.position) * surface.normal, 0.0), out.energy};
  }
  [[nodiscard]] const plane& local() const noexcept { return surface; }
  [[nodiscard]] double energy() const noexcept { return port.energy(); }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return port.check(); }
};

/// use(limits) of the loop, as late as it is.
wall as_late(const facts& f, auto use) {
  if (f.latency == 0) return use(ph::late_loop_limits<0>{});
  return f.latency == 1 ? use(ph::late_loop_limits<1>{}) : use(ph::late_loop_limits<2>{});
}
/// use(device) of the facts: exact where no step is felt.
wall as_stated(const facts& f, auto use) {
  if (!(f.quantum > 0.0)) {
    return use(ph::exact_device{.mass = f.mass,
                                .damping = f.damping,
                                .force_limit = f.force_limit,
                                .longest_tick = f.period,
                                .latency = f.latency,
                                .top_speed = 20.0});
  }
  return use(ph::encoder_device{.mass = f.mass,
                                .damping = f.damping,
                                .friction = f.friction,
                                .presliding = 0.0,
                                .quantum = f.quantum,
                                .force_limit = f.force_limit,
                                .longest_tick = f.period,
                                .latency = f.latency,
                                .top_speed = 20.0});
}
/// Dry friction helps a hand that pushes the device on as it slows down.
ph::known_hand hand_of(const facts& f) {
  return {.force = f.hand + f.friction};
}

wall touch_of(const facts& f, const auto& hand) {
  return as_late(f, [&](auto limits) {
    return as_stated(f, [&](const auto& device) -> wall {
      return ph::make_touch<line, plane, decltype(limits)>(device, hand);
    });
  });
}
wall guard_of(const facts& f, const auto& hand) {
  return as_late(f, [&](auto limits) {
    return as_stated(f, [&](const auto& device) -> wall {
      return rendered{ph::make_guard<line, decltype(limits)>(device, hand)};
    });
  });
}
wall contacts_of(const facts& f) {
  return as_late(f, [&](auto limits) {
    return as_stated(f, [&](const auto& device) -> wall {
      return one_of_several{
          ph::make_contacts<line, decltype(limits)>(device, hand_of(f), ph::slots<plane, 1>{})};
    });
  });
}
/// The spring of the papers behind a bound; no speed and no place is refused.
wall spring_behind(const facts& f, const auto& bound) {
  return as_late(f, [&](auto limits) -> wall {
    limits.longest_tick = f.period;
    limits.top_speed = limits.workspace = 1e12;
    return ph::local_model{line{},
                           ph::followed<plane>{},
                           ph::turn_at_once{},
                           ph::virtual_coupling{.damping = f.wall_damping},
                           ph::no_observer{},
                           bound,
                           limits};
  });
}

}  // namespace

const std::vector<contender>& contenders() {
  static const std::vector<contender> all{
      {"bare spring", promise::nothing,
       [](const facts& f) { return spring_behind(f, ph::no_bound{}); }},
      {"make_touch", promise::known_hand, [](const facts& f) { return touch_of(f, hand_of(f)); }},
      {"make_contacts", promise::known_hand, contacts_of},
      {"make_guard", promise::known_hand, [](const facts& f) { return guard_of(f, hand_of(f)); }},
      {"make_touch, strict", promise::any_hand,
       [](const facts& f) { return touch_of(f, ph::any_hand); }},
      {"make_guard, strict", promise::any_hand,
       [](const facts& f) { return guard_of(f, ph::any_hand); }}};
  return all;
}

const contender& passivity_controlled() {
  static const contender theirs{
      "their PO/PC", promise::nothing, [](const facts& f) {
        return spring_behind(
            f, ph::series_passivity_controller{.max_damping = 0.5 * f.mass / f.period});
      }};
  return theirs;
}

wall wall_of(const contender& c, const facts& f, double K) {
  wall made = c.make(f);
  const auto fault = made.check();
  const bool taken = made.update({0.0, -1.0, K});
  if (fault || !taken) {
    experiments::complain(std::string(c.name) +
                          " refuses the model: " + (fault ? fault.parameter : "the wall"));
  }
  return made;
}

}  // namespace papers
