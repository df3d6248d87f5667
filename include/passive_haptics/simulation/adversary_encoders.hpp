// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motions too small for encoders to show or for dry friction to resist; the menu is in adversary.hpp.
// They drive prescribed_motion, which no force can stop.

#include <passive_haptics/simulation/adversary_motions.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace simulation {

/// Moves on each axis along the force if the force has grown and against it if the force has fallen, so the
/// force does more work on the way out than it takes on the way back. The encoders do not show the motion, and
/// elastic friction does not take energy from it. From time to time it presses, or moves away, for some ticks,
/// so that there is a force. A step is no longer than `reach`, and no longer than the room if there is room.
template <class Space>
struct in_step_motion {
  using vector = typename physical<Space>::vector;
  double reach = std::numeric_limits<double>::infinity();  ///< [m]
  double nudge = 10e-6;  ///< length of a step where there is neither room nor a reach [m]
  double speed = 0.05;   ///< largest speed of a press [m/s]
  typename physical<Space>::coordinates last{};  ///< force of the last tick [N]
  int pressing = 0, until_press = 0;             ///< ticks left of a press, and until the next
  double pace = 0.0;                             ///< speed of this press, inwards [m/s]

  [[nodiscard]] vector next(const adversary_view<Space>& view, random_source& random) noexcept {
    const vector change = view.force - vector(last);
    last = view.force;
    if (until_press-- <= 0) {
      until_press = static_cast<int>(random.uniform(20.0, 400.0));
      pressing = static_cast<int>(random.uniform(1.0, 30.0));
      pace = random.uniform(-0.3, 1.0) * random.uniform() * speed;
      if (view.depth < 0.0) pace = std::abs(pace);
    }
    if (pressing > 0) {
      --pressing;
      return view.position - view.normal * (pace * view.dt);
    }
    vector there = view.position;
    for (int i = 0; i < Space::dof; ++i) {
      const double by = component(change, i);
      const double side = by > 0.0 ? 1.0 : by < 0.0 ? -1.0 : random.uniform(-1.0, 1.0);
      const double free = component(side > 0.0 ? view.room_above : view.room_below, i);
      const bool unseen = component(view.room_above, i) + component(view.room_below, i) > 0.0;
      const double most = kernels::smaller(unseen ? free : nudge_or_reach(), reach);
      component(there, i) += side * most;
    }
    return there;
  }

 private:
  [[nodiscard]] double nudge_or_reach() const noexcept {
    return reach < std::numeric_limits<double>::infinity() ? reach : nudge;
  }
};

/// Presses for 20 of 300 ticks. In each other tick it takes that one of twelve steps, or none, whose price() [J] is
/// least: to either end of its room, by up to 3 presliding displacements, or anywhere at speeds from 1 µm/s to
/// 1 m/s. price() computes with the memory of the friction, so the motion uses that memory, too.
template <class Space>
struct worst_step_motion {
  using vector = typename physical<Space>::vector;
  double range = 4e-3;  ///< largest distance from the surface [m]
  int tick = 0;
  double pace = 1e-3;  ///< speed of the presses [m/s]

  [[nodiscard]] vector next(const adversary_view<Space>& view, random_source& random) noexcept {
    if (tick++ % 300 == 0) pace = std::exp(random.uniform(std::log(1e-3), std::log(0.3)));
    if (tick % 300 < 20 && view.depth < range) {
      return view.position - view.normal * (pace * view.dt);
    }
    vector best = view.position;
    double least = view.price(best);
    for (int i = 0; i < 12; ++i) {
      const vector tried = candidate(i, view, random);
      const double depth =
          view.depth - physical<Space>::dot(vector(tried - view.position), view.normal);
      const double price = view.price(tried) + 2e-7 * random.uniform(-1.0, 1.0);
      if (std::abs(depth) < range && price < least) {
        least = price;
        best = tried;
      }
    }
    return best;
  }

 private:
  [[nodiscard]] static vector candidate(int i, const adversary_view<Space>& view,
                                        random_source& random) noexcept {
    const double p = view.presliding > 0.0 ? view.presliding : 10e-6;
    const vector way = random.direction<Space>();
    if (i < 4) return view.position + way * (3.0 * p * random.uniform());
    if (i < 8) return view.position + way * (view.dt * std::exp(random.uniform(-13.8, 0.0)));
    vector there = view.position;
    for (int j = 0; j < Space::dof; ++j) {
      const bool up = random.chance(0.5);
      component(there, j) += up ? component(view.room_above, j) : -component(view.room_below, j);
    }
    return there;
  }
};

/// Goes to and fro before the surface, 2 a forward and a back, with a ≤ p. For each metre gained a friction without
/// a memory of reversals takes as little as c/3 [J/m], where a ledger credits c. Then it spends the credit as
/// greedy_motion does.
template <class Space>
struct dither_motion {
  using vector = typename physical<Space>::vector;
  double range = 1e-3;  ///< largest distance from the surface [m]
  bool dithering = true, back = false, outwards = true;
  int ticks_left = 0;
  double amplitude = 1e-6;  ///< a [m]

  [[nodiscard]] vector next(const adversary_view<Space>& view, random_source& random) noexcept {
    if (ticks_left-- <= 0) {
      dithering = !dithering;
      ticks_left =
          static_cast<int>(dithering ? random.uniform(100.0, 400.0) : random.uniform(2.0, 12.0));
      const double p = view.presliding > 0.0 ? view.presliding : 10e-6;
      amplitude = p * random.uniform(0.02, 1.0);
    }
    if (!dithering) return greedy_motion<Space>{}.next(view, random);
    back = !back;
    if (!back && view.depth < -range) outwards = false;
    if (!back && view.depth > 0.0) outwards = true;
    const double way = (back ? -1.0 : 2.0) * amplitude;
    return view.position + view.normal * (outwards ? way : -way);
  }
};

static_assert(adversary_for<in_step_motion<space<float, 1>>, space<float, 1>>);
static_assert(adversary_for<worst_step_motion<space<float, 1>>, space<float, 1>>);
static_assert(adversary_for<dither_motion<space<float, 1>>, space<float, 1>>);

}  // namespace simulation
}  // namespace v0
}  // namespace passive_haptics
