// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sessions at a wall, of devices and hands that are drawn: as they were stated, or not in one fact.

#include <passive_haptics/compositions.hpp>
#include <passive_haptics/identification/device_facts.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/presets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

namespace watching {

namespace ph = passive_haptics;
namespace sim = ph::simulation;

using line = ph::space<double, 1>;
using dice = std::mt19937_64;

[[nodiscard]] inline double between(dice& g, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(g);
}
[[nodiscard]] inline double spread(dice& g, double a, double b) {  // evenly in its logarithm
  return a * std::pow(b / a, between(g, 0.0, 1.0));
}

/// Hands that push with `most` [N] at most. The wall is at 0, its outside is above.
struct hand {
  enum kind { press, knead, taps, tremor, jerks, pumps, slams, kinds };
  int what = press;
  double most = 5.0, rate = 2.0, share = 0.5, stiffness = 400.0, damping = 3.0, own = 0.0;
  std::uint64_t seed = 1;

  [[nodiscard]] double force(double t, double x, double v) const noexcept {
    const double turn = 2.0 * 3.14159265358979 * rate * t, in = std::min(t / 0.2, 1.0);
    const auto aim = [&](double to) { return stiffness * (to - x) - damping * v; };
    double f = 0.0;
    switch (what) {
      case press:
        f = aim(0.004 - in * (0.004 + 0.02 * share));
        break;
      case knead:
        f = aim(-0.012 * share * (1.0 - std::cos(turn)) + 0.001);
        break;
      case taps:
        f = aim(0.01 * std::cos(turn));
        break;
      case tremor:
        f = -share * most + (1.0 - share) * most * std::sin(turn * 5.0);
        break;
      case jerks: {  // another force every now and then
        const auto step = static_cast<std::uint64_t>(t * rate * 10.0);
        std::uint64_t z = (step + seed) * 0x9e3779b97f4a7c15ULL;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        f = most * (static_cast<double>((z ^ (z >> 27)) >> 11) * 0x1p-52 - 1.0);
        break;
      }
      case pumps:
        f = v > 0.0 ? most : -most;
        break;
      default:  // slams
        f = x > 0.0 ? -most : std::sin(turn) > 0.0 ? most : -most;
    }
    if (x > 0.03) f = -most;
    return std::clamp(f, -most, most);
  }
  [[nodiscard]] double mass() const noexcept { return own; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

/// What is true of a device and of the hand on it.
struct truth {
  std::string name;
  double mass = 0.1, damping = 0.1, friction = 0.0, presliding = 15e-6, quantum = 0.0,
         force_limit = 9.0;
  double hand_force = 5.0, jitter = 0.0, K = 1000.0, stated_mass = 1.0;
  int latency = 0;
  hand on_it{};
  std::uint64_t seed = 1;
};

/// What is not as stated.
enum class lie { none, sign, latency, two_ports, lighter, stronger_hand, compliant };
struct untruth {
  lie kind = lie::none;
  double amount = 0.0;    ///< ticks, or a factor, or [Hz]
  double share = 0.5;     ///< of a compliant device
  bool reported = false;  ///< the device reports the force that it held
};

struct result {
  long ticks = 0, refuted = 0;  ///< ticks, and those of them with outside_force
  long refused = 0;             ///< ticks whose sample was not believed
  double found = -1.0;          ///< first event after the first contact [s]
  double lost = 0.0;            ///< [J]
  double after = 0.0;           ///< of them after it was latched [J]
  double force = 0.0;           ///< at the end [N]
  ph::event latched = ph::event::nominal;
};

/// A compliant device or a stiff one.
template <class Device>
[[nodiscard]] double least(const Device& d) {
  if constexpr (requires { d.meter(); }) {
    return d.meter().minimum();
  } else {
    return d.minimum();
  }
}

template <class Port, class Device>
[[nodiscard]] result played(Port port, Device device, const truth& who, const untruth& how,
                            double seconds) {
  dice g(who.seed * 7919 + 17);
  Port second = port;
  result r;
  double force = 0.0, contact = -1.0, t = 0.0;
  ph::device_sample<line> s = device.exchange(0.0);
  const double T = port.longest_tick();
  int doubted = 0;
  for (; t < seconds; ++r.ticks) {
    const double before = least(device);
    const auto out = how.reported ? port.tick(s) : port.tick(s.position, ph::seconds{s.dt});
    force = out.force;
    r.refused += out.what == ph::event::rejected_sample;
    if (contact < 0.0 && s.position < 0.0) contact = t;
    if (out.what >= ph::event::outside_force) {
      ++r.refuted;
      ++doubted;
      if (r.found < 0.0) r.found = t - contact;
      if (out.what > ph::event::outside_force || doubted > 600) r.latched = out.what;
    } else {
      doubted = 0;
    }
    double held = how.kind == lie::sign ? -force : force;
    if (how.kind == lie::two_ports) held += second.tick(s.position, ph::seconds{s.dt}).force;
    if (who.jitter > 0.0) {
      (void)device.set_period(T / (1.0 + who.jitter) * (1.0 + who.jitter * between(g, -1.0, 1.0)));
    }
    s = device.exchange(held);
    t += s.dt;
    const double now = least(device);
    if (r.latched != ph::event::nominal) r.after += std::max(0.0, before - now);
    if (std::abs(device.position()) > 0.5) break;
  }
  r.lost = std::max(0.0, -least(device));
  r.force = force;
  return r;
}

/// A wall pressed by a known_hand, or by a trusted_hand: then nobody watches.
template <class Hand, int Latency>
[[nodiscard]] auto wall_of(const auto& device, const truth& w) {
  Hand hand{};
  hand.force = w.hand_force + w.friction;
  auto port =
      ph::make_touch<line, ph::half_space<line>, ph::late_loop_limits<Latency>>(device, hand);
  (void)port.update({0.0, 1.0, w.K});
  return port;
}
template <int Latency, class Hand>
[[nodiscard]] auto touch_of(const truth& w, double T) {
  const ph::exact_device d{.mass = w.mass * w.stated_mass,
                           .damping = w.damping / 2.0,
                           .force_limit = w.force_limit,
                           .longest_tick = T,
                           .latency = Latency};
  return wall_of<Hand, Latency>(d, w);
}
template <int Latency, class Hand>
[[nodiscard]] auto encoder_touch_of(const truth& w, double T) {
  ph::encoder_device d{.mass = w.mass * w.stated_mass,
                       .damping = w.damping / 2.0,
                       .friction = w.friction / 2.0,
                       .presliding = w.presliding,
                       .quantum = w.quantum};
  d.force_limit = d.continuous_force = w.force_limit;
  d.winding_time = 10.0;
  d.longest_tick = T;
  d.latency = Latency;
  return wall_of<Hand, Latency>(d, w);
}

/// Gives one the facts of another.
constexpr void be_like(const auto& one, auto& other) noexcept {
  other.mass = one.mass;
  other.damping = one.damping;
  other.friction = one.friction;
  other.quantum = one.quantum;
  other.force_limit = one.force_limit;
}

/// One session; the port is an encoder's where there are steps and friction.
template <int Latency, class Hand>
[[nodiscard]] result session_at(truth w, const untruth& how, double seconds) {
  const double nominal = 1e-3, T = nominal * (1.0 + w.jitter);
  truth told = w;
  sim::device_parameters<line> p;
  p.substeps = 10;
  p.latency = w.latency;
  if (how.kind == lie::latency) p.latency = Latency + static_cast<int>(how.amount);
  if (how.kind == lie::lighter) w.mass *= how.amount;
  if (how.kind == lie::stronger_hand) {
    w.on_it.most *= how.amount;
    w.on_it.stiffness *= how.amount;
  }
  be_like(w, p);
  p.start = 0.004;
  p.period = nominal;
  const auto with = [&](const auto& port) {
    if (how.kind == lie::compliant) {
      sim::compliant_parameters<line> c;
      be_like(w, c);
      c.friction = 0.0;
      c.share = how.share;
      c.mode = how.amount;
      c.start = p.start;
      c.latency = w.latency;
      return played(port, sim::compliant_device<line, hand>(c, w.on_it), w, how, seconds);
    }
    if (told.friction > 0.0 && w.presliding > 0.0 && w.quantum > 0.0) {
      p.friction = 0.0;
      return played(port,
                    sim::device<line, hand, sim::slider_and_spring>(
                        p, w.on_it, {.level = {w.friction}, .presliding = {w.presliding}}),
                    w, how, seconds);
    }
    return played(port, sim::device<line, hand>(p, w.on_it), w, how, seconds);
  };
  if (told.quantum > 0.0 && told.friction > 0.0)
    return with(encoder_touch_of<Latency, Hand>(told, T));
  return with(touch_of<Latency, Hand>(told, T));
}
template <class Hand = ph::known_hand>
[[nodiscard]] result session(const truth& w, const untruth& how, double seconds) {
  if (w.latency == 0) return session_at<0, Hand>(w, how, seconds);
  if (w.latency == 1) return session_at<1, Hand>(w, how, seconds);
  return session_at<2, Hand>(w, how, seconds);
}

inline void draw_hand(truth& w, dice& g) {
  w.on_it.what = static_cast<int>(between(g, 0.0, hand::kinds));
  w.on_it.most = w.hand_force;
  w.on_it.rate = spread(g, 0.5, 8.0);
  w.on_it.share = between(g, 0.1, 0.9);
  w.on_it.stiffness = spread(g, 100.0, 1000.0);
  w.on_it.damping = between(g, 0.5, 5.0);
  w.on_it.seed = g();
  if (between(g, 0.0, 1.0) < 0.3) w.on_it.own = spread(g, 0.01, 0.3);
}
/// Any device of a size that is sold.
[[nodiscard]] inline truth drawn(std::uint64_t seed) {
  dice g(seed);
  truth w;
  w.name = "drawn";
  w.seed = seed;
  w.mass = spread(g, 0.03, 0.5);
  w.damping = spread(g, 0.04, 1.0);
  w.force_limit = spread(g, 3.0, 20.0);
  w.hand_force = between(g, 2.0, 8.0);
  w.K = spread(g, 300.0, 1e4);
  w.stated_mass = between(g, 0.6, 1.0);
  if (between(g, 0.0, 1.0) < 0.5) w.jitter = between(g, 0.05, 0.2);
  if (between(g, 0.0, 1.0) < 0.4) {
    w.quantum = spread(g, 0.5e-6, 60e-6);
    w.friction = spread(g, 0.02, 0.6);
    w.presliding = spread(g, 2e-6, 50e-6);
  }
  w.latency = static_cast<int>(between(g, 0.0, 3.0));
  draw_hand(w, g);
  return w;
}
/// The devices that have names: the simulated ones, and those of the catalogue, whose missing facts are drawn.
[[nodiscard]] inline truth named(std::size_t which, std::uint64_t seed) {
  truth w = drawn(seed);
  dice g(seed + 1);
  if (which < sim::all_presets.size()) {
    const auto& d = sim::all_presets[which];
    w.name = d.name;
    be_like(d, w);
  } else {
    const auto& d = ph::design::devices::all[which - sim::all_presets.size()];
    w.name = d.name;
    if (d.mass) w.mass = d.mass.value;
    if (d.friction) w.friction = d.friction.value;
    if (d.quantum[0]) w.quantum = d.rotary ? d.quantum[0].value * 0.03 : d.quantum[0].value;
    if (d.peak_force) w.force_limit = d.peak_force.value;
    if (d.latency) w.latency = static_cast<int>(d.latency.value);
  }
  if (w.quantum > 0.0 &&
      !(w.friction > 0.0)) {  // nobody who is honest states exact positions of it
    w.friction = spread(g, 0.02, 0.6);
    w.presliding = spread(g, 2e-6, 50e-6);
  }
  return w;
}
inline constexpr std::size_t names = sim::all_presets.size() + ph::design::devices::all.size();

}  // namespace watching
