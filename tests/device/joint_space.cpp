// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/laws.hpp>

#include <numeric>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using arm = ph::joint_space<double, 7>;
using polar = ph::joint_space<double, 2>;
template <class P>
concept has_geometry = requires {
  typename P::geometry;
};

constexpr ph::diagonal_damping<7> seven{{0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07}};
constexpr ph::motor_limits<7> motors{{9, 9, 9, 9, 9, 9, 9}};  // N·m

/// An arm that turns by q(0) [rad] and slides out to q(1) [m], with a damper b at its tip. Its motors
/// hold joint torques from sample to sample, and between two samples its joints move evenly.
struct polar_arm {
  static constexpr double b = 0.03, T = 1e-3;

  polar::vector q{0.0, 0.05};
  double energy = 0.0;  ///< taken from the hand, less what the motors gave [J]

  [[nodiscard]] d2::vector tip() const { return q(1) * d2::vector(std::cos(q(0)), std::sin(q(0))); }
  /// Jᵀ f.
  [[nodiscard]] polar::vector torques(const d2::vector& f) const {
    const d2::vector out(std::cos(q(0)), std::sin(q(0))), across(-out(1), out(0));
    return {q(1) * across.dot(f), out.dot(f)};
  }
  void move(const polar::vector& by, const polar::vector& held) {
    const double from = q(1), to = from + by(1);
    const double turning = by(0) * by(0) * (from * from + from * to + to * to) / 3;
    energy += b * (turning + by(1) * by(1)) / T - held.dot(by);
    q += by;
  }
};

/// Turns to and fro by 1 mm a tick under an outward force, then goes out with it until it is spent:
/// what the hand has put in, at the least, beyond the loan [J].
double worst_of_polar_arm(auto torques_at, double loan) {
  polar_arm device;
  double least = 0.0;
  for (int n = 0; n < 200; ++n) {
    const polar::vector held = torques_at(device);
    device.move({n % 2 == 0 ? 0.02 : -0.02, 0.0}, held);
    least = std::min(least, device.energy);
  }
  for (int n = 0; n < 3000; ++n) {
    const polar::vector held = torques_at(device);
    const double slow = std::min(1e-3, held(1) * polar_arm::T / (2 * polar_arm::b));
    device.move({0.0, slow}, held);
    least = std::min(least, device.energy);
  }
  return least + loan;
}

}  // namespace

static_assert(ph::port<arm> && ph::port<polar> && ph::port<ph::joint_space<float, 1>>);
static_assert(std::is_trivially_copyable_v<arm::stored_pose>);
static_assert(has_geometry<d3> && !has_geometry<arm>);

TEST_CASE("joints have work and a fastest joint, and no length", "[joints]") {
  arm::vector torque = arm::zero(), turned = arm::zero();
  for (int i = 0; i < 7; ++i) {
    torque(i) = i - 3;
    turned(i) = 0.1 * i;
  }
  const auto work = arm::work(torque, turned);
  CHECK_THAT(work.joules, WithinAbs(torque.dot(turned), 1e-15));
  CHECK_THAT(work.passed, WithinAbs(torque.cwiseAbs().dot(turned.cwiseAbs()), 1e-15));
  CHECK_THAT(arm::squared(turned), WithinRel(0.36, 1e-12));
  CHECK(arm::between(torque, turned) == turned - torque);
  for (int i = 0; i < 7; ++i) {  // NaN hides behind no other joint
    arm::vector bad = turned;
    bad(i) = std::nan("");
    CHECK(std::isnan(arm::squared(bad)));
    CHECK_FALSE(arm::is_finite(bad));
  }
}

TEST_CASE("a port of seven joints with a given torque is strict", "[joints][passivity]") {
  using ledger = ph::basic_reduced_energy<ph::diagonal_damping<7>>;
  ph::passive_port guard{arm{}, ph::given_force{}, ledger{.damping = seven, .loan = 0.01},
                         ph::strict_bound{}, thesis_loop};
  static_assert(decltype(guard)::passivity == ph::guarantee::strict);
  static_assert(std::is_trivially_copyable_v<decltype(guard)>);
  REQUIRE_FALSE(guard.check());

  const arm::vector small = arm::vector::Constant(0.01), large = arm::vector::Constant(50.0);
  const auto free = guard.tick(arm::zero(), 1ms, small);
  CHECK(free.force == small);
  CHECK(free.what == ph::event::nominal);
  const auto bounded = guard.tick(arm::zero(), 1ms, large);
  CHECK(bounded.limited);
  double outflow = 0.0;
  for (int i = 0; i < 7; ++i)
    outflow += std::pow(bounded.force(i), 2) * 1e-3 / (4 * 0.01 * (i + 1));
  CHECK_THAT(outflow, WithinRel(0.01, 1e-9));
  // The nearest effort: |fᵢ| = |wantedᵢ| bᵢ/(bᵢ + λ), one λ for all joints.
  for (int i = 1; i < 7; ++i) {
    const double b = 0.01 * (i + 1), ratio = 50.0 / bounded.force(i) - 1.0;
    CHECK_THAT(ratio * b, WithinRel((50.0 / bounded.force(0) - 1.0) * 0.01, 1e-9));
  }

  CHECK(ph::laws::loses_to_no_motion<arm>(ph::strict_bound{}));
  CHECK_FALSE(ph::laws::loses_to_no_motion<arm>(ph::no_bound{}));  // the control
}

TEST_CASE("a port of joints believes no joint that jumps", "[joints]") {
  auto guard = ph::make_strict_guard<arm, ph::diagonal_damping<7>>(seven, motors, 1e-3);
  const arm::vector torque = arm::vector::Constant(0.1);
  arm::vector q = arm::zero();
  CHECK(guard.tick(q, 1ms, torque).what == ph::event::nominal);
  q(5) = 0.004;  // 4 rad/s
  CHECK(guard.tick(q, 1ms, torque).what == ph::event::nominal);
  q(5) = 0.010;  // 6 rad/s, and the limit is 5
  CHECK(guard.tick(q, 1ms, torque).what == ph::event::rejected_sample);
  CHECK(guard.tick(q, 1ms, torque).what == ph::event::nominal);  // it was there all the time
}

TEST_CASE("a joint that is no number is refused, whichever it is, and the port comes back",
          "[joints]") {
  const arm::vector torque = arm::vector::Constant(0.1);
  for (int i = 0; i < 7; ++i) {
    auto guard = ph::make_strict_guard<arm, ph::diagonal_damping<7>>(seven, motors, 1e-3);
    arm::vector bad = arm::zero();
    bad(i) = std::nan("");
    CHECK(guard.tick(bad, 1ms, torque).what == ph::event::rejected_sample);
    CHECK(guard.tick(arm::zero(), 1ms, torque).what == ph::event::nominal);
    for (int n = 0; n < 3; ++n) {
      const auto out = guard.tick(bad, 1ms, torque);
      CHECK(out.what == ph::event::rejected_sample);
      CHECK(out.force == arm::zero());
    }
    CHECK(guard.tick(arm::zero(), 1ms, torque).what == ph::event::nominal);
  }
}

TEST_CASE(
    "motors that hold joint torques deceive a ledger of the tip's force, and not one of theirs",
    "[joints][passivity]") {
  // τ·Δq is the motors' work exactly (lemma J); f·Δx takes the arc for a straight line, and
  // f·Δx = −f r δ²/2 of a turn by δ under a force that points outwards is credit for nothing
  const double loan = 0.3, wanted = 9.0, T = polar_arm::T, b = polar_arm::b;
  ph::passive_port tip{d2{}, ph::given_force{}, ph::reduced_energy{.damping = b, .loan = loan},
                       ph::strict_bound{}, thesis_loop};
  const auto by_the_tip = [&](const polar_arm& device) {
    const d2::vector out = device.tip() / device.q(1);
    return device.torques(tip.tick(device.tip(), ph::seconds{T}, out * wanted).force);
  };
  using ledger = ph::basic_reduced_energy<ph::diagonal_damping<2>>;
  const ph::diagonal_damping<2> of_joints{{b * 0.05 * 0.05, b}};  // nowhere above the damper's
  ph::passive_port joints{polar{}, ph::given_force{}, ledger{.damping = of_joints, .loan = loan},
                          ph::strict_bound{}, thesis_loop};
  double farthest = 0.0;
  const auto by_the_joints = [&](const polar_arm& device) -> polar::vector {
    const auto out = joints.tick(device.q, ph::seconds{T}, {0.0, wanted});
    farthest = std::max(farthest, std::abs(out.energy - loan - device.energy));
    return out.force;
  };
  CHECK(worst_of_polar_arm(by_the_tip, loan) < -0.01);
  const double left = worst_of_polar_arm(by_the_joints, loan);
  CHECK(left >= 0.0);
  CHECK(left < 0.01);       // the control: the loan was spent
  CHECK(farthest < 1e-12);  // the ledger is the truth
}
