// SPDX-License-Identifier: BSD-3-Clause
// What a tick through the C interface costs beside the same composition called directly, in turns on the
// same motion; fails above 20 ns more.
#include "../common/failures.hpp"
#include "../common/median.hpp"
#include "../common/options.hpp"
#include "../common/report.hpp"
#include "../common/text.hpp"
#include <passive_haptics/adapters/c/passive_haptics.h>
#include <passive_haptics/passive_haptics.hpp>

#include <array>
#include <chrono>
#include <iostream>
#include <string>
#include <vector>

namespace {

namespace ph = passive_haptics;
using experiments::format;
using scene = ph::space<double, 3>;
using place = std::array<double, 3>;

constexpr double T = 1e-3;
constexpr double allowed = 20.0;  // [ns]
constexpr ph::exact_device device{
    .mass = 0.045, .damping = 0.05, .force_limit = 3.3, .longest_tick = T};
constexpr ph::known_hand hand{.force = 5.0};
constexpr ph::encoder_device stated{.mass = 0.045,
                                    .damping = 0.05,
                                    .friction = 0.13,
                                    .presliding = 15e-6,
                                    .quantum = 20e-6,
                                    .force_limit = 3.3};

/// Into the surface and out again, half of the time inside, on steps of 20 µm.
std::vector<place> motion() {
  std::vector<place> all;
  for (int n = 0; n < 1000; ++n) {
    const int at = n < 500 ? 125 - n / 2 : (n - 500) / 2 - 125;
    all.push_back({20e-6 * (n % 300), 0.0, 20e-6 * at});
  }
  return all;
}

/// [ns per tick] of 1000 ticks.
template <class Tick>
double time_of(const std::vector<place>& motion, Tick tick) {
  using clock = std::chrono::steady_clock;
  const auto start = clock::now();
  for (const place& x : motion) tick(x);
  return std::chrono::duration<double, std::nano>(clock::now() - start).count() /
         static_cast<double>(motion.size());
}

/// Kept from the optimiser.
template <class Value>
void use(const Value& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

struct cost {
  double direct, through_c, more;  ///< medians of the rounds [ns per tick]
  double ratio;                    ///< and of through C to direct
};

/// In turns, one after the other and the other way round.
template <class Direct, class ThroughC>
cost compare(int rounds, Direct direct, ThroughC through_c) {
  const auto along = motion();
  std::vector<double> ours;
  std::vector<double> theirs;
  std::vector<double> more;
  std::vector<double> ratios;
  for (int round = -10; round < rounds; ++round) {
    const bool first = round % 2 == 0;
    const double before = first ? time_of(along, direct) : 0.0;
    const double c = time_of(along, through_c);
    const double d = first ? before : time_of(along, direct);
    if (round < 0) continue;  // caches and branch predictors learn
    ours.push_back(d);
    theirs.push_back(c);
    more.push_back(c - d);
    ratios.push_back(c / d);
  }
  return {experiments::median(ours), experiments::median(theirs), experiments::median(more),
          experiments::median(ratios)};
}

ph_port* open(const char* composition, double friction) {
  ph_parameters p{};
  p.size = sizeof p;
  p.mass = stated.mass;
  p.damping = stated.damping;
  p.hand_force = hand.force;
  p.force_limit = stated.force_limit;
  p.longest_tick = T;
  if (friction > 0.0) {
    p.friction = friction;
    p.presliding = stated.presliding;
    p.quantum = stated.quantum;
  }
  ph_port* port = nullptr;
  std::string why(PH_TEXT_ROOM, '\0');
  if (ph_create(composition, &p, &port, why.data(), why.size()) != PH_OK) {
    throw std::runtime_error(why.c_str());
  }
  return port;
}

template <class Touch>
cost of_touch(int rounds, Touch touch, const char* composition, double friction) {
  const place point{};
  const place up{0.0, 0.0, 1.0};
  touch.update({scene::zero(), scene::vector(0.0, 0.0, 1.0), 800.0});
  ph_port* const port = open(composition, friction);
  (void)ph_publish_plane(port, point.data(), up.data(), 800.0);
  const cost found = compare(
      rounds,
      [&](const place& x) { use(touch.tick(scene::vector(x[0], x[1], x[2]), ph::seconds{T})); },
      [&](const place& x) {
        ph_result out;
        out.size = sizeof out;
        (void)ph_tick(port, x.data(), T, &out);
        use(out);
      });
  ph_destroy(port);
  return found;
}

cost of_guard(int rounds) {
  auto guard = ph::make_guard<scene>(device, hand);
  ph_port* const port = open("guard", 0.0);
  const auto wanted = [](const place& x) { return x[2] < 0.0 ? -800.0 * x[2] : 0.0; };
  const cost found = compare(
      rounds,
      [&](const place& x) {
        use(guard.tick(scene::vector(x[0], x[1], x[2]), ph::seconds{T},
                       scene::vector(0.0, 0.0, wanted(x))));
      },
      [&](const place& x) {
        const place f{0.0, 0.0, wanted(x)};
        ph_result out;
        out.size = sizeof out;
        (void)ph_tick_wanted(port, x.data(), T, f.data(), &out);
        use(out);
      });
  ph_destroy(port);
  return found;
}

int run(const std::vector<std::string>& arguments) {
  int rounds = 2000;
  experiments::read_options(
      "c_interface_cost",
      {experiments::a_number(
          "--rounds", "of 1000 ticks each way (default: " + std::to_string(rounds) + ")", rounds)},
      arguments);
  experiments::table table({"composition", "direct / ns", "through C / ns", "more / ns", "ratio"});
  experiments::failures found;
  const auto row = [&](const char* name, const cost& c) {
    table.add({name, format("%.1f", c.direct), format("%.1f", c.through_c), format("%.1f", c.more),
               format("%.2f", c.ratio)});
    experiments::expect(found, c.more <= allowed,
                        name + format(": %.1f ns more, ", c.more) + format("over %.0f", allowed));
  };
  row("touch", of_touch(rounds, ph::make_touch<scene>(device, hand), "touch", 0.0));
  row("encoder_touch",
      of_touch(rounds, ph::make_touch<scene>(stated, hand), "encoder_touch", stated.friction));
  row("guard", of_guard(rounds));
  table.print(std::cout);
  return experiments::ended("c_interface_cost", found);
}

}  // namespace

int main(int argc, char** argv) {
  return experiments::guarded("c_interface_cost", [&] { return run({argv + 1, argv + argc}); });
}
