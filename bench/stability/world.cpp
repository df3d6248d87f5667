// SPDX-License-Identifier: BSD-3-Clause
#include "world.hpp"

#include "../common/text.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <array>
#include <cmath>

namespace stability {

namespace {

namespace sim = passive_haptics::simulation;

double to_float(double x) {
  return static_cast<double>(static_cast<float>(x));
}

world with(const std::string& axis, const std::string& value, double world::*what, double x) {
  world w;
  w.axis = axis;
  w.value = value;
  w.*what = to_float(x);
  return w;
}

double limited(double x, double least, double most) {
  return to_float(std::fmin(std::fmax(x, least), most));
}

std::string described(const world& w) {
  return experiments::format("K %.3g", w.stiffness) + experiments::format(" b %.3g", w.damping) +
         experiments::format(" T %.3g", w.tick) + experiments::format(" m %.3g", w.mass) +
         experiments::format(" size %.3g ", w.size) + to_string(w.clock);
}

}  // namespace

const char* to_string(clockwork c) noexcept {
  constexpr std::array names{"steady",       "jitter",    "missed",
                             "missed, held", "switching", "lost samples"};
  return names[static_cast<std::size_t>(c)];
}

std::vector<world> cells(bool quick) {
  std::vector<world> list{world{}};
  const auto vary = [&list](const char* name, double world::*what, const std::vector<double>& at) {
    for (const double x : at) list.push_back(with(name, experiments::format("%g", x), what, x));
  };
  for (int e = -3; e <= 12; e += quick ? 3 : 1) {
    vary("K N/m", &world::stiffness, {std::pow(10.0, e)});
  }
  vary("b N·s/m", &world::damping, {0.0, 1e-3, 1.0, 30.0, 1e3});
  vary("T s", &world::tick, {1e-5, 1e-4, 1e-2, 1e-1});
  vary("mass kg", &world::mass, {1e-4, 1e-3, 1e-2, 1.0, 10.0, 1e2});
  vary("offset m", &world::offset, {1e-2, 1.0, 1e3, 1e6});
  vary("size m", &world::size, {1e-6, 1e-4, 1e-2});
  for (const auto clock : {clockwork::jitter, clockwork::missed, clockwork::missed_and_held,
                           clockwork::switching, clockwork::lost_samples}) {
    for (const double T : {1e-5, 1e-3, 1e-1}) {
      world w = with("clock", to_string(clock) + experiments::format(", %g s", T), &world::tick, T);
      w.clock = clock;
      list.push_back(w);
    }
  }
  return list;
}

world anywhere(std::uint64_t seed) {
  sim::random_source random(seed);
  const auto decades = [&random](double least, double most) {
    return to_float(std::pow(10.0, random.uniform(std::log10(least), std::log10(most))));
  };
  world w;
  w.axis = "anywhere";
  w.stiffness = decades(1e-3, 1e12);
  w.damping = decades(1e-3, 1e3);
  w.tick = decades(1e-5, 1e-1);
  w.mass = decades(1e-4, 1e2);
  w.size = decades(1e-6, 1e-2);
  w.clock = static_cast<clockwork>(random.bits() % 6U);
  w.value = described(w);
  return w;
}

world nearby(const world& w, std::uint64_t seed) {
  sim::random_source random(seed);
  const auto moved = [&random](double x) { return x * std::pow(3.0, random.uniform(-1.0, 1.0)); };
  world next = w;
  next.axis = "refined";
  next.stiffness = limited(moved(w.stiffness), 1e-3, 1e12);
  next.damping = limited(moved(w.damping), 1e-3, 1e3);
  next.tick = limited(moved(w.tick), 1e-5, 1e-1);
  next.mass = limited(moved(w.mass), 1e-4, 1e2);
  next.size = limited(moved(w.size), 1e-6, 1e-2);
  next.value = described(next);
  return next;
}

}  // namespace stability
