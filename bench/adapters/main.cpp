// SPDX-License-Identifier: BSD-3-Clause
// What a port costs in a loop that exists: nanoseconds per tick of a force guard, of what make_touch composes,
// and of a whole passive_device, beside a finger proxy on a sphere that is as cheap as one can be. All in one
// run and in turns, the least of many blocks each, so their ratios hold on a busy machine, too. Fails where a
// tick allocates, or the guard or the touch takes more than 100 ns.

#include "../common/failures.hpp"
#include "../common/options.hpp"
#include "../common/text.hpp"
#include "support/allocations.hpp"
#include <passive_haptics/adapters/chai3d.hpp>
#include <passive_haptics/compositions.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace ph = passive_haptics;
namespace ad = ph::adapters;
using experiments::format;
using scene = ph::space<double, 3>;
using vec = Eigen::Vector3d;

namespace {

constexpr double T = 1e-3, radius = 0.05;
constexpr std::size_t ticks = 1000;  // of a block

/// A device that is where it is told to be and takes every force.
class still : public chai3d::cGenericHapticDevice {
 public:
  bool open() override { return m_deviceReady = true; }
  bool close() override { return true; }
  bool getPosition(chai3d::cVector3d& x) override {
    x = place;
    return true;
  }
  bool setForceAndTorqueAndGripperForce(const chai3d::cVector3d& f, const chai3d::cVector3d&,
                                        double) override {
    force = f;
    return true;
  }
  chai3d::cVector3d place{}, force{};
};

/// A finger in gentle contact all the time, about the equator.
std::vector<vec> motion() {
  std::vector<vec> all;
  for (std::size_t i = 0; i < ticks; ++i) {
    const double t = 1e-3 * double(i), turned = 0.3 + 0.05 * std::sin(3.0 * t);
    const double r = radius - 1e-3 + 2e-4 * std::sin(20.0 * t);
    all.emplace_back(r * std::cos(turned), r * std::sin(turned), 2e-3 * std::cos(5.0 * t));
  }
  return all;
}

struct sides {
  enum { proxy, guard, touch, bare, decorated, count };
  static constexpr std::array<const char*, count> names{"finger proxy on a sphere", "make_guard",
                                                        "make_touch", "device, set and get",
                                                        "the same through passive_device"};
};

class stopwatch {
 public:
  /// [ns per tick]; `tick` is told where the finger is.
  template <class Tick>
  void block(std::size_t side, const Tick& tick) {
    const long before = allocations();
    const auto begin = std::chrono::steady_clock::now();
    for (const vec& x : places_) {
      const double f = tick(x);
      asm volatile("" : : "g"(&f) : "memory");
    }
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    least_[side] = std::min(least_[side], took.count() / double(ticks));
    allocated_[side] += allocations() - before;
  }
  [[nodiscard]] double least(std::size_t side) const { return least_[side]; }
  [[nodiscard]] long allocated(std::size_t side) const { return allocated_[side]; }

 private:
  std::vector<vec> places_ = motion();
  std::array<double, sides::count> least_ = [] {
    std::array<double, sides::count> all{};
    all.fill(1e9);
    return all;
  }();
  std::array<long, sides::count> allocated_{};
};

int run(const std::vector<std::string>& arguments) {
  int blocks = 5000;
  experiments::read_options(
      "adapter_cost",
      {experiments::a_number(
          "--blocks", "of 1000 ticks, of each side (default: " + std::to_string(blocks) + ")",
          blocks)},
      arguments);

  chai3d::cWorld world{.radius = radius, .stiffness = 1000.0};
  chai3d::cAlgorithmFingerProxy proxy;
  proxy.initialize(&world, {0.06, 0.0, 0.0});
  constexpr ph::exact_device facts{
      .mass = 0.1, .damping = 0.1, .force_limit = 8.0, .longest_tick = 1.1 * T};
  constexpr ph::known_hand hand{.force = 5.0};
  auto guard = ph::make_guard<scene>(facts, hand);
  auto touch = ph::make_touch<scene>(facts, hand);
  touch.update({.point = {radius, 0.0, 0.0}, .normal = {1.0, 0.0, 0.0}, .stiffness = 1000.0});
  const auto bare = std::make_shared<still>();
  const auto decorated = ad::make_passive_device(bare, ph::make_guard<scene>(facts, hand));
  if (!decorated->open()) throw std::runtime_error("the device in between does not open");
  const vec wanted(0.5, 0.0, 0.0);
  const auto send = [&bare](chai3d::cGenericHapticDevice& device, const vec& x) {
    bare->place = ad::chai3d_types::vector(x);
    chai3d::cVector3d read;
    (void)device.getPosition(read);
    (void)device.setForce({0.5, 0.0, 0.0});
    return bare->force.x() + read.x();
  };

  stopwatch watch;
  for (int n = 0; n < blocks; ++n) {
    watch.block(sides::proxy, [&](const vec& x) {
      return proxy.computeForces(ad::chai3d_types::vector(x), {}).x();
    });
    watch.block(sides::guard,
                [&](const vec& x) { return guard.tick(x, ph::seconds{T}, wanted).force[0]; });
    watch.block(sides::touch, [&](const vec& x) { return touch.tick(x, ph::seconds{T}).force[0]; });
    watch.block(sides::bare, [&](const vec& x) { return send(*bare, x); });
    watch.block(sides::decorated, [&](const vec& x) { return send(*decorated, x); });
  }

  experiments::table table({"per tick", "ns, least", "over the proxy", "allocations"});
  long allocated = 0;
  for (std::size_t i = 0; i < sides::count; ++i) {
    table.add({sides::names[i], format("%.1f", watch.least(i)),
               format("%.2f", watch.least(i) / watch.least(sides::proxy)),
               std::to_string(watch.allocated(i))});
    allocated += watch.allocated(i);
  }
  table.print(std::cout);
  std::cout << "passive_device adds "
            << format("%.1f", watch.least(sides::decorated) - watch.least(sides::bare))
            << " ns, a reading of the clock among them\n";
  experiments::failures found;
  experiments::expect(found, allocated == 0, std::to_string(allocated) + " allocations");
  const auto within = [&](std::size_t side, double most) {
    experiments::expect(found, watch.least(side) <= most,
                        sides::names[side] + format(": %.1f ns a tick, ", watch.least(side)) +
                            format("more than %.0f", most));
  };
  within(sides::guard, 100.0);
  within(sides::touch, 100.0);
  return experiments::ended("adapter_cost", found);
}

}  // namespace

int main(int argc, char** argv) {
  return experiments::guarded("adapter_cost", [&] { return run({argv + 1, argv + argc}); });
}
