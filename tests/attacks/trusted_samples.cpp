// SPDX-License-Identifier: BSD-3-Clause
// What bad samples cost a loop that trusts them all, trusted_loop_limits, and that good ones cost it
// nothing.
#include "attacks/challenged.hpp"
#include "support/scripted_device.hpp"
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <array>

using namespace simulated;

namespace {

constexpr ph::trusted_loop_limits<> trusted{.longest_tick = 1e-3};
constexpr ph::loop_limits ordinary{.longest_tick = 1e-3};

/// What a greedy hand gets out of a wall while every 20th sample has this fault: the least true port
/// energy [J].
double least_energy(const auto& limits, sample_fault kind) {
  ph::local_model model{d1{},         ph::fixed{wall<d1>(1e4)}, ph::turn_at_once{},
                        ph::spring{}, thesis_ledger(),          ph::strict_bound{},
                        limits};
  std::array<scripted_fault, 100> script{};
  for (std::size_t i = 0; i < script.size(); ++i) {
    script[i] = {20 * static_cast<std::int64_t>(i) + 10, kind, -0.1};
  }
  scripted_device device(sim::prescribed_motion<d1>({.damping = 0.03, .start = -1e-3}), script);
  sim::greedy_motion<d1> greedy;
  sim::random_source random(1);
  const auto hand = [&](const auto& now) {
    const sim::adversary_view<d1> view{now.position, -1.0, now.position, now.force, 1e-3, 0.03};
    device.device().move_to(greedy.next(view, random));
  };
  return sim::run(device, model, 2000, sim::idle, hand).least_energy;
}

}  // namespace

TEST_CASE("no adversary draws a joule from a trusted loop but by samples that are bad",
          "[trusted_loop_limits]") {
  const auto model = model_of<d2>(ph::spring{}, ph::strict_bound{}, trusted);
  for (const sim::verdict& v : sim::challenge_all(model, {}, 40)) {
    CAPTURE(to_string(v.by), v.least_energy);
    const bool spoils = v.by == by::overruns || v.by == by::dropouts || v.by == by::kitchen_sink;
    CHECK(passes(v) == !spoils);
    CHECK(v.largest_force > 1e-3);
  }
}

TEST_CASE("a jump of the sensor buys credit in a trusted loop; an ordinary one refuses it",
          "[trusted_loop_limits]") {
  const auto jump = sample_fault::jump;
  CHECK(least_energy(ordinary, jump) == 0.0);
  CHECK(least_energy(trusted, jump) < -0.05);
}

TEST_CASE("what the force did while a trusted loop was blind is lost", "[trusted_loop_limits]") {
  for (const auto kind : {sample_fault::nan_position, sample_fault::nan_held, sample_fault::zero_dt,
                          sample_fault::no_answer}) {
    CAPTURE(static_cast<int>(kind));
    CHECK(least_energy(ordinary, kind) == 0.0);
    const double lost = least_energy(trusted, kind);
    CHECK(lost < -1e-5);
    CHECK(lost > -1e-3);
  }
}
