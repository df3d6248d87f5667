// SPDX-License-Identifier: BSD-3-Clause
// Every float energy there is, from 0 to the largest number: 2³¹ of them for each damping and tick.
// The force allowed must keep T f² ≤ 4 b E1 in exact arithmetic, for a force asked near the bound
// and for one far above it; the same bound without its margin must be caught.
//
//     ctest --test-dir build/test -C Exhaustive -L exhaustive --verbose
//     exhaustive [EVERY]      only every so many-th energy
//
// Exit code 1: one does not, or the control was not caught.
#include "support/exact.hpp"
#include "support/scenes.hpp"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

namespace {

constexpr std::uint32_t infinity_bits = 0x7f800000U;

struct tally {
  long long tried = 0, overdrafts = 0, loose = 0, naive_overdrafts = 0, reach_overdrafts = 0;
  float first{};  ///< energy of an overdraft [J]
};

/// One energy: asked near the bound, asked far above it, and reachable over three reaches.
void judge(float E, float b, float T, tally& t) {
  const ph::part_at<ph::isotropic_damping, f1> damping(static_cast<double>(b));
  const double wide = std::sqrt(4.0 * double(b) / double(T) * double(E));
  const auto steps = static_cast<int>((std::bit_cast<std::uint32_t>(E) * 2654435761U) >> 26U) - 56;
  const auto near = static_cast<float>(std::fmin(wide * (1.0 + steps * 0x1p-24), 3e38));
  for (const float asked : {near, 1e4F}) {
    ++t.tried;
    const float force = asked * damping.affordable(asked, E, T);
    if (!exact::covered(force, E, b, T)) {
      ++t.overdrafts;
      t.first = E;
    }
    // No tighter than rounding asks for, where neither the ledger nor a share of it is subnormal.
    const bool ordinary = E > 1e-25F && E < 1e30F;
    if (ordinary && double(force) < std::fmin(wide, double(asked)) * (1.0 - 0x1p-17)) ++t.loose;
  }
  const float naive = damping.worst_outflow(near, T) <= E ? near : 0.0F;
  t.naive_overdrafts += exact::covered(naive, E, b, T) ? 0 : 1;

  const float B = b / T;
  const double exact_B = double(b) / double(T);
  const float meet = std::sqrt(E / B);
  for (const float reach : {meet * (1.0F - float(steps) * 0x1p-24F), 1e-4F}) {
    ++t.tried;
    const float most = std::numeric_limits<float>::max();  // no force asked for is larger
    const float F = std::fmin(ph::kernels::reachable_force_bound(E, B, reach), most);
    if (!exact::reach_covered<double>(F, E, exact_B, reach)) {
      ++t.reach_overdrafts;
      t.first = E;
    }
  }
}

tally all_energies(float b, float T, std::uint32_t every) {
  constexpr std::uint32_t block = 1U << 20U;
  const unsigned workers = std::max(1U, std::thread::hardware_concurrency());
  std::atomic<std::uint32_t> next = 0;
  std::vector<tally> parts(workers);
  std::vector<std::thread> threads;
  for (tally& part : parts) {
    threads.emplace_back([&next, &part, b, T, every] {
      tally mine;
      for (std::uint32_t at = next++; at < infinity_bits / block; at = next++) {
        const std::uint32_t end = (at + 1U) * block;
        const std::uint32_t begin = at * block + (every - at * block % every) % every;
        for (std::uint32_t bits = begin; bits < end; bits += every) {
          judge(std::bit_cast<float>(bits), b, T, mine);
        }
      }
      part = mine;
    });
  }
  for (auto& thread : threads) thread.join();
  tally sum;
  for (const tally& part : parts) {
    sum.tried += part.tried;
    sum.overdrafts += part.overdrafts;
    sum.loose += part.loose;
    sum.naive_overdrafts += part.naive_overdrafts;
    sum.reach_overdrafts += part.reach_overdrafts;
    if (part.overdrafts + part.reach_overdrafts > 0) sum.first = part.first;
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && (std::string_view(argv[1]) == "--help" || std::string_view(argv[1]) == "-h")) {
    std::puts(
        "usage: exhaustive [EVERY]: every EVERY-th float energy, 1 (all) unless told otherwise");
    return 0;
  }
  const long asked = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 1;
  if (asked < 1 || asked > 1000000) {
    std::fprintf(stderr, "exhaustive: EVERY %s: give a whole number from 1 to 1000000\n", argv[1]);
    return 2;
  }
  struct setting {
    float b, T;
  };
  bool sound = true;
  std::printf("%10s %10s %12s %14s %10s %10s %8s %8s %8s\n", "b N·s/m", "T s", "B N/m", "forces",
              "strict", "reachable", "loose", "control", "s");
  for (const auto& [b, T] : {setting{0.03F, 1e-3F}, setting{1.0F, 0.5F}, setting{1e-4F, 0.1F},
                             setting{7.3F, 1e-5F}, setting{1e3F, 1.7e-4F}}) {
    const auto start = std::chrono::steady_clock::now();
    const tally t = all_energies(b, T, static_cast<std::uint32_t>(asked));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const bool caught = t.naive_overdrafts > t.tried / 10000;
    sound = sound && t.overdrafts == 0 && t.reach_overdrafts == 0 && t.loose == 0 && caught;
    std::printf("%10g %10g %12g %14lld %10lld %10lld %8lld %7.1f%% %8.1f\n", double(b), double(T),
                double(b) / double(T), t.tried, t.overdrafts, t.reach_overdrafts, t.loose,
                100.0 * 4.0 * double(t.naive_overdrafts) / double(t.tried), took.count());
    if (t.overdrafts + t.reach_overdrafts > 0)
      std::printf("  such as E1 = %.9g J\n", double(t.first));
  }
  std::printf(
      "columns 5 and 6: forces that overdraw; 7: forces cut by more than 2^-17; 8: overdrafts "
      "of the same bound without its margin\n");
  return sound ? 0 : 1;
}
