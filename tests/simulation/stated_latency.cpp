// SPDX-License-Identifier: BSD-3-Clause
// The latency of a loop is stated, and wrong either way it is not safe: too much of it pairs a motion
// with the wrong force just as too little does, and the ledger does not notice.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/simulation/adversary.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace sim = ph::simulation;

namespace {

/// A device whose commands are held `late` ticks after they are given, by any fraction of a tick, in
/// the hand of a velocity source that gives way to what is held, as it pays best, on a wall at 0.
class late_writer {
 public:
  using space_type = d1;

  explicit late_writer(double late)
      : whole_(static_cast<std::size_t>(late)),
        fraction_(late - static_cast<double>(whole_)),
        device_({.start = -1e-3}) {}

  ph::device_sample<d1> exchange(double force) noexcept {
    std::rotate(commands_.begin(), commands_.end() - 1, commands_.end());
    commands_[0] = force;
    hold(commands_[whole_ + 1], fraction_);
    hold(commands_[whole_], 1.0 - fraction_);
    return {device_.position(), commands_[whole_], tick, true};
  }
  [[nodiscard]] double position() const noexcept { return device_.position(); }
  [[nodiscard]] double time() const noexcept { return device_.time(); }
  [[nodiscard]] const auto& meter() const noexcept { return device_.meter(); }

 private:
  static constexpr double tick = 1e-3;

  void hold(double force, double share) noexcept {
    if (!device_.set_period(share * tick)) return;
    const double x = device_.position();
    const bool gives_way = force != 0.0 && random_.chance(0.7);
    const double way =
        gives_way ? force * share * tick / (2 * 0.03) : (x < 1e-3 ? 3e-4 : -3e-4) * share;
    device_.move_to(x + std::clamp(way, -1e-3, 1e-3));
    static_cast<void>(device_.exchange(force));
  }

  std::size_t whole_;
  double fraction_;
  std::array<double, 6> commands_{};
  sim::prescribed_motion<d1> device_;
  sim::random_source random_{1};
};

struct outcome {
  double least = 0.0;   ///< of the true port energy [J]
  double ledger = 0.0;  ///< of the model's own [J]
};

/// 20 000 ticks of a loop that says it is `k` ticks late and is `true_latency`.
/// With `old_samples` it is shown where the device was a tick ago.
template <int k>
outcome told(double true_latency, bool old_samples = false) {
  ph::local_model model{d1{},
                        ph::fixed{wall<d1>(1e4)},
                        ph::turn_at_once{},
                        ph::spring{},
                        thesis_ledger(),
                        ph::strict_bound{},
                        ph::late_loop_limits<k>{.longest_tick = 1e-3, .watchdog = 1e-3}};
  late_writer device(true_latency);
  outcome found;
  double one_tick_ago = device.position();
  // Without the held force: a device that does not know when it writes cannot report it.
  const auto blind = [&](const auto& sample) {
    const double newest = std::exchange(one_tick_ago, sample.position);
    return model.tick(old_samples ? newest : sample.position, ph::seconds{sample.dt});
  };
  const auto note = [&](const auto& now) { found.ledger = std::min(found.ledger, now.out.energy); };
  found.least = sim::run(device, blind, 20000, sim::idle, note).least_energy;
  return found;
}

}  // namespace

TEST_CASE("strict_bound told the latency that is true loses nothing", "[passivity]") {
  for (const outcome& found : {told<0>(0.0), told<1>(1.0), told<2>(2.0), told<3>(3.0)}) {
    CHECK(found.least >= -1e-12);
  }
}

TEST_CASE("a sample that is a tick old is a tick of latency", "[passivity]") {
  CHECK(told<1>(0.0, true).least >= -1e-12);
  CHECK(told<2>(1.0, true).least >= -1e-12);
  CHECK(told<0>(0.0, true).least < -1e-3);  // the control: told of the command alone
  CHECK(told<1>(1.0, true).least < -1e-3);
}

TEST_CASE("told too much latency, too little, or a part of a tick, it loses unnoticed",
          "[passivity]") {
  struct line {
    double true_latency;  ///< [ticks]
    std::array<double, 4>
        told_so_many;  ///< least energy, told 0, 1, 2 and 3 ticks [J]; 0: not judged
  };
  constexpr std::array table{line{0.0, {0.0, -8.90, -8.86, -8.17}},    //
                             line{0.1, {0.0, -0.46, -8.38, -9.12}},    //
                             line{0.3, {0.0, -0.15, -8.56, -9.37}},    //
                             line{0.5, {0.0, -5.9e-5, -8.36, -9.84}},  //
                             line{0.9, {-0.11, 0.0, -6.60, -8.37}},    //
                             line{1.0, {-0.17, 0.0, -0.26, -12.2}},    //
                             line{1.5, {-0.59, 0.0, 0.0, -0.73}},      //
                             line{2.0, {-0.40, -0.12, 0.0, -0.13}},    //
                             line{3.0, {-0.52, -0.17, -0.062, 0.0}}};
  for (const line& said : table) {
    const std::array found{told<0>(said.true_latency), told<1>(said.true_latency),
                           told<2>(said.true_latency), told<3>(said.true_latency)};
    for (std::size_t k = 0; k < found.size(); ++k) {
      CAPTURE(said.true_latency, k, found[k].least);
      CHECK(found[k].ledger >= -1e-15);  // whatever happens
      if (said.told_so_many[k] == 0.0) continue;
      CHECK(found[k].least < said.told_so_many[k] / 2.0);
      CHECK(found[k].least > said.told_so_many[k] * 2.0);
    }
  }
}
