// SPDX-License-Identifier: BSD-3-Clause
// What has to hold under any compiler flags, in any rounding mode, on any machine; no test framework,
// so that it cross-compiles in seconds. numbers.sh builds and runs it.
//
//   strict      T f² ≤ 4 b E1 in exact arithmetic for a million float energies of every exponent
//   reach       F s − B s² ≤ E1 over the reach, the same
//   ledger      a float ledger never above the true energy, over 200 000 random ticks
//   attack      strict_bound, 1 and 3 dimensions, float and double, against three adversaries:
//               true port energy ≥ 0 but for the rounding of the meter itself
//   control     the same without the margins, and without a bound: must be caught
//
// Prints one line; exit code 1 if one fails.
#include "../support/exact.hpp"
#include "../support/scenes.hpp"
#include <passive_haptics/simulation/challenge.hpp>

#include <cfenv>
#include <cfloat>
#include <cstdio>

namespace {

namespace sim = ph::simulation;

struct findings {
  long strict = 0, reach = 0, ledger = 0, naive = 0;
  double attack = 0.0, unbounded = 0.0;
};

void try_bounds(findings& found) {
  ph::laws::samples random(1);
  for (int i = 0; i < 1000000; ++i) {
    const float E = exact::any_positive_float(random);
    const float b = std::ldexp(1.5F + random.number<float>() / 2.0F,
                               static_cast<int>(random.bits() % 20U) - 12);
    const float T =
        std::ldexp(1.5F + random.number<float>() / 2.0F, -static_cast<int>(random.bits() % 16U));
    const double most =
        std::sqrt(4.0 * static_cast<double>(b) / static_cast<double>(T) * static_cast<double>(E));
    const double steps = static_cast<double>(random.bits() % 64U) - 48.0;
    const auto near = static_cast<float>(std::fmin(most * (1.0 + steps * 0x1p-24), 1e16));
    const ph::part_at<ph::isotropic_damping, f1> damping(static_cast<double>(b));
    for (const float asked : {near, 1e4F}) {
      const float force = asked * damping.affordable(asked, E, T);
      found.strict += exact::covered(force, E, b, T) ? 0 : 1;
    }
    const bool fits = damping.worst_outflow(near, T) <= E;
    found.naive += !fits || exact::covered(near, E, b, T) ? 0 : 1;
    const float B = b / T;
    const float reach = std::sqrt(E / B) * (1.0F - static_cast<float>(steps) * 0x1p-24F);
    const float F = std::fmin(ph::kernels::reachable_force_bound(E, B, reach), 3e38F);
    const double exact_B = static_cast<double>(b) / static_cast<double>(T);
    found.reach += exact::reach_covered<double>(F, E, exact_B, reach) ? 0 : 1;
  }
}

/// Steps on a grid on which float differences are exact; truth in double, whose own rounding is
/// nine digits below what is looked for.
void try_ledger(findings& found) {
  auto ledger = at<f1>(thesis_ledger());
  sim::random_source random(2);
  ph::compensated_sum<double> truth;
  float held = 0.0F;
  double passed = 0.0;
  for (int n = 0; n < 200000; ++n) {
    const float dx = std::ldexp(std::round(static_cast<float>(random.uniform(-64.0, 64.0))), -20);
    (void)ledger.update(dx, held, 1e-3F);
    const double way = static_cast<double>(dx), force = static_cast<double>(held);
    const double damped = static_cast<double>(0.03F) * way * way / static_cast<double>(1e-3F);
    truth += damped;
    truth += -force * way;
    passed += damped + std::abs(force * way);
    const double ahead = static_cast<double>(ledger.value()) - static_cast<double>(truth);
    found.ledger += ahead <= 1e-15 * passed ? 0 : 1;
    held = std::fmin(ph::kernels::strict_force_bound(ledger.value(), 30.0F),
                     static_cast<float>(random.uniform(0.0, 9.0)));
  }
}

template <class Space, class Bound>
double least_energy(const Bound& bound) {
  const ph::local_model model{Space{},
                              ph::followed<ph::half_space<Space>>{},
                              ph::turn_limited{.rate = 4},
                              ph::spring{},
                              thesis_ledger(),
                              bound,
                              thesis_loop};
  double least = 0.0;
  for (const auto by :
       {sim::adversary::nyquist, sim::adversary::greedy, sim::adversary::kitchen_sink}) {
    const double now = sim::challenge(model, by, {}, 20).least_energy;
    least = now >= least ? least : now;  // NaN stays
  }
  return least;
}

bool sound(const char* mode) {
  findings found;
  try_bounds(found);
  try_ledger(found);
  for (const double e :
       {least_energy<f1>(ph::strict_bound{}), least_energy<d1>(ph::strict_bound{}),
        least_energy<f3>(ph::strict_bound{}), least_energy<d3>(ph::strict_bound{})}) {
    found.attack = e >= found.attack ? found.attack : e;
  }
  found.unbounded = least_energy<d1>(ph::no_bound{});
  const bool holds =
      found.strict == 0 && found.reach == 0 && found.ledger == 0 && found.attack >= -1e-12;
  // Upwards, and with the excess precision of an x87, the formula without margin is safe, too.
  const bool tells = mode[0] == 'n' && FLT_EVAL_METHOD == 0;
  const bool caught = found.unbounded < -1e-3 && (found.naive > 1000 || !tells);
  std::printf("%-12s strict %ld, reach %ld, ledger %ld, attack %.1e J; control %ld, %.1e J: %s\n",
              mode, found.strict, found.reach, found.ledger, found.attack, found.naive,
              found.unbounded, holds && caught ? "holds" : "FAILS");
  return holds && caught;
}

}  // namespace

int main(int argc, char** /*argv*/) {  // any argument: to nearest alone
  struct {
    int mode;
    const char* name;
  } const modes[] = {{FE_TONEAREST, "nearest"},
                     {FE_UPWARD, "upward"},
                     {FE_DOWNWARD, "downward"},
                     {FE_TOWARDZERO, "toward zero"}};
  bool all = true;
  for (const auto& m : modes) {
    if (argc > 1 && m.mode != FE_TONEAREST) continue;
    std::fesetround(m.mode);
    all = sound(m.name) && all;
  }
  std::fesetround(FE_TONEAREST);
  return all ? 0 : 1;
}
