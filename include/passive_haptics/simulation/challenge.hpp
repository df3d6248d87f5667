// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One call that exposes any composed model to any adversary and says how much energy the hand drew:
//
//     for (const auto& v : sim::challenge_all(model)) {
//       std::printf("%-16s %s\n", to_string(v.by), passes(v) ? "passive" : "loses");
//     }
//     double E = sim::replay(model, v.by, {}, v.worst_seed, [](const auto& now) { ... });
//
// Five more adversaries move less than an encoder step, the noise or a presliding displacement. They are for encoders
// with steps or noise, and for dry friction that is elastic before it slips.
//     sim::challenge_encoders(model, {.friction = 0.2, .presliding = 15e-6, .quantum = 60e-6});
//
// The model may be any passive port. For a port with several contacts or none, give a function that lays a surface on it:
//     sim::challenge_all(corner, {}, 1000, 1, [](auto& port, const auto& surface) { ... });
//
// The judge is the exact port energy of the simulation, dry friction included, and never the model's
// own observer. Seeds make every run repeatable. A model that loses nothing has lost nothing in these runs only:
// they are a test, and the proof belongs to its bound. Two of the twelve adversaries are hands of limited force. No
// force can stop the other ten, and a `conditional` bound gives no guarantee against those.

#include <passive_haptics/simulation/attack.hpp>

#include <array>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// The result of `runs` runs. Each run counts by its least port energy [J], which is NaN if the
/// circumstances are impossible or a commanded force was not finite.
struct verdict {
  adversary by{};
  int runs = 0;
  double least_energy = 0.0;     ///< least of all runs [J]
  double mean_energy = 0.0;      ///< mean over the runs [J]
  double largest_force = 0.0;    ///< commanded [N]; if it is 0 the model has shown nothing
  std::uint64_t worst_seed = 0;  ///< seed of the least energy, for replay()
};

/// True if no run lost more than `accepted_loss` [J]. The default is rounding in double; in float a ledger
/// of 1 mJ already rounds by 1e-10 J a tick, so state a larger one.
[[nodiscard]] constexpr bool passes(const verdict& v, double accepted_loss = 1e-12) noexcept {
  return v.runs > 0 && v.least_energy >= -accepted_loss;
}

namespace detail {

template <class Space>
verdict judge(const subject<Space>& model, adversary by, const circumstances& world, int runs,
              std::uint64_t first_seed) noexcept {
  verdict result{.by = by, .runs = runs, .worst_seed = first_seed};
  for (int run = 0; run < runs; ++run) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(run);
    const run_outcome now = attack(model, by, world, seed);
    result.mean_energy += now.least_energy / runs;
    result.largest_force = std::fmax(result.largest_force, now.largest_force);
    if (!(now.least_energy >= result.least_energy) &&
        result.least_energy == result.least_energy) {  // the first NaN stays
      result.least_energy = now.least_energy;
      result.worst_seed = seed;
    }
  }
  return result;
}

}  // namespace detail

/// `runs` runs of one adversary, with seeds first_seed, first_seed + 1, ...; each works on a fresh copy of the
/// model. `lay` says how a surface is laid on the model (subject.hpp).
template <class Model, lay_for<Model> Lay = usual_lay<Model>>
[[nodiscard]] verdict challenge(const Model& model, adversary by, const circumstances& world = {},
                                int runs = 1000, std::uint64_t first_seed = 1,
                                const Lay& lay = {}) noexcept {
  under_test<Model, Lay> tested{model, model, lay};
  return detail::judge(subject<space_of<Model>>(tested), by, world, runs, first_seed);
}

namespace detail {

template <std::size_t N>
[[nodiscard]] std::array<verdict, N> challenge_each(const std::array<adversary, N>& list,
                                                    const auto& model, const circumstances& world,
                                                    int runs, std::uint64_t first_seed,
                                                    const auto& lay) noexcept {
  std::array<verdict, N> verdicts{};
  for (std::size_t i = 0; i < N; ++i) {
    verdicts[i] = challenge(model, list[i], world, runs, first_seed, lay);
  }
  return verdicts;
}

}  // namespace detail

/// The twelve adversaries of all_adversaries in turn, `runs` runs each.
template <class Model, lay_for<Model> Lay = usual_lay<Model>>
[[nodiscard]] auto challenge_all(const Model& model, const circumstances& world = {},
                                 int runs = 1000, std::uint64_t first_seed = 1,
                                 const Lay& lay = {}) noexcept {
  return detail::challenge_each(all_adversaries, model, world, runs, first_seed, lay);
}

/// The five of encoder_adversaries, which move less than an encoder step, noise or a presliding displacement.
template <class Model, lay_for<Model> Lay = usual_lay<Model>>
[[nodiscard]] auto challenge_encoders(const Model& model, const circumstances& world,
                                      int runs = 1000, std::uint64_t first_seed = 1,
                                      const Lay& lay = {}) noexcept {
  return detail::challenge_each(encoder_adversaries, model, world, runs, first_seed, lay);
}

/// Repeats one run and returns its least port energy [J], equal to the last bit on the same machine and
/// build. `watch(moment)` is called every tick.
template <class Model, class Watch, lay_for<Model> Lay = usual_lay<Model>>
double replay(const Model& model, adversary by, const circumstances& world, std::uint64_t seed,
              Watch watch, const Lay& lay = {}) noexcept {
  using Space = space_of<Model>;
  under_test<Model, Lay> tested{model, model, lay};
  const detail::spectator<Space> spectator{
      &watch, [](void* who, const moment<Space>& now) { (*static_cast<Watch*>(who))(now); }};
  return detail::attack(subject<Space>(tested), by, world, seed, spectator).least_energy;
}
template <class Model>
[[nodiscard]] double replay(const Model& model, adversary by, const circumstances& world,
                            std::uint64_t seed) noexcept {
  return replay(model, by, world, seed, [](const auto& /*now*/) {});
}

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
