// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The motion that search.hpp tunes by eleven numbers: press, hold, retreat, rest.
// Once in that cycle the surface may jump and change its stiffness.

#include <passive_haptics/simulation/adversary_motions.hpp>
#include <passive_haptics/simulation/circumstances.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// The numbers of the cycle. A hand of limited force presses with hand_force/press_ticks and pulls back with
/// hand_force·min(retreat, 1).
struct cycle_parameters {
  static constexpr int count = 11;
  using unit_cube = std::array<double, count>;

  double depth = 1e-3;   ///< depth that it presses to, 20 µm to 2 mm [m]
  int press_ticks = 1;   ///< ticks in which it presses, 1 to 39
  int hold_ticks = 0;    ///< ticks in which it stays there, 0 to 40
  double retreat = 1.0;  ///< Δx of the way back as a multiple of f dt/(2b), 10⁻³ to 4
  double rest = 0.0;     ///< height of its turn above the surface, as a share of depth, −0.9 to 1
  int rest_ticks = 0;    ///< ticks in which it stays there, 0 to 40
  double lateral = 0.0;  ///< sideways step as a share of depth, 0 or 0.3 to 1; for 2 or 3 axes
  double jump = 0.0;     ///< jump of the surface and back, once a cycle [m]
  double phase = 0.0;    ///< time of the jump as a share of the cycle, 0 to 1
  double stiffness = 1e4;   ///< K before the jump [N/m]
  double after_jump = 1e4;  ///< K after the jump [N/m]

  /// The numbers at the point u of the unit cube, 0 standing for the least of each and 1 for the largest.
  [[nodiscard]] static cycle_parameters at(const unit_cube& u,
                                           const circumstances& world) noexcept {
    const auto logarithmic = [](double low, double high, double t) {
      return low * std::exp(t * std::log(high / low));
    };
    const auto ticks = [](double t) { return static_cast<int>(std::exp(t * std::log(41.0))); };
    const double range = world.stiffest - world.softest;
    return {.depth = logarithmic(20e-6, 2e-3, u[0]),
            .press_ticks = ticks(u[1] * 0.99),
            .hold_ticks = ticks(u[2]) - 1,
            .retreat = logarithmic(1e-3, 4.0, u[3]),
            .rest = -0.9 + 1.9 * u[4],
            .rest_ticks = ticks(u[5]) - 1,
            .lateral = u[6] < 0.3 ? 0.0 : u[6],
            .jump = world.jump * (2.0 * u[7] - 1.0),
            .phase = u[8],
            .stiffness = world.softest + range * u[9],
            .after_jump = world.softest + range * u[10]};
  }
};

enum class cycle_stage : std::uint8_t { press, hold, retreat, rest };

/// The place of an adversary in its cycle, for a tuned_motion and the hand of worst_push().
struct cycle {
  cycle_parameters p{};
  cycle_stage stage = cycle_stage::press;
  int in_stage = 0;  ///< ticks
  int in_cycle = 0;  ///< ticks

  /// Goes on to the next stage if the present one is over at the depth `depth` [m].
  void advance(double depth) noexcept {
    constexpr int too_long = 400;  // ticks after which a stage ends anyway
    const double height = p.rest * p.depth;
    bool over = in_stage >= too_long;
    switch (stage) {
      case cycle_stage::press:
        over = over || depth >= p.depth * (1.0 - 1e-9);
        break;
      case cycle_stage::hold:
        over = in_stage >= p.hold_ticks;
        break;
      case cycle_stage::retreat:
        over = over || -depth >= height - 1e-9 * p.depth;
        break;
      case cycle_stage::rest:
        over = in_stage >= p.rest_ticks;
        break;
    }
    if (!over) return;
    const bool again = stage == cycle_stage::rest;
    stage = again ? cycle_stage::press : static_cast<cycle_stage>(static_cast<int>(stage) + 1);
    in_stage = 0;
    if (again) in_cycle = 0;
    if ((stage == cycle_stage::hold && p.hold_ticks == 0) ||
        (stage == cycle_stage::rest && p.rest_ticks == 0)) {
      advance(depth);
    }
  }
  void count() noexcept {
    ++in_stage;
    ++in_cycle;
  }
  /// True if the surface has jumped and not gone back yet.
  [[nodiscard]] bool jumped() const noexcept {
    const int length = p.press_ticks + p.hold_ticks + p.rest_ticks + 1;
    return in_cycle > static_cast<int>(p.phase * length);
  }
};

/// The velocity source. Where the force is zero it retreats as quickly as it came.
template <class Space>
struct tuned_motion {
  using vector = typename physical<Space>::vector;
  cycle where{};

  [[nodiscard]] vector next(const adversary_view<Space>& view, random_source& random) noexcept {
    const cycle_parameters& p = where.p;
    where.advance(view.depth);
    where.count();
    const double pace = p.depth * (1.0 + kernels::larger(p.rest, 0.0)) / p.press_ticks;
    vector step = physical<Space>::zero();
    if (where.stage == cycle_stage::press) {
      const double left = kernels::larger(p.depth - view.depth, 0.0);
      step = view.normal * -kernels::smaller(pace, left);
    } else if (where.stage == cycle_stage::retreat) {
      const double push = physical<Space>::norm(view.force);
      const double worst = push * view.dt / (2.0 * view.damping);
      const double left = kernels::larger(p.rest * p.depth + view.depth, 0.0);
      step = view.normal * kernels::smaller(worst > 0.0 ? p.retreat * worst : pace, left);
    }
    if (Space::dof > 1 && p.lateral > 0.0) {
      vector aside = random.direction<Space>();
      aside -= view.normal * physical<Space>::dot(aside, view.normal);
      step += aside * (p.lateral * p.depth);
    }
    return view.position + step;
  }
};

static_assert(adversary_for<tuned_motion<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
