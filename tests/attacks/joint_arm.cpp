// SPDX-License-Identifier: BSD-3-Clause
// Lemma J: what the motors' work is, where they hold torques in joints (docs/design/six_dof.md).
#include "support/joint_arm.hpp"

#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/port/reported_work.hpp>

#include <Eigen/LU>

namespace {

using vec3 = d3::vector;
constexpr double T = 1e-3, b = 0.03, loan = 0.3;

/// What the tip's damping is, in any direction and pose that is visited: b_q/σ_max(J)², by 0.0475 m².
constexpr joint_arm_parameters tight{.damping = b * 0.0475};

/// 2000 ticks to and fro by 1 mm across a force of 9 N that points outwards; then the tip goes with the force
/// along the yaw until it is spent. What is left of the loan at the least [J].
template <class Port>
[[nodiscard]] double left_by_shaking(Port port) {
  joint_arm arm(tight);
  double least = loan, work = 0.0;
  vec3 force = vec3::Zero(), torque = vec3::Zero();
  for (int n = 0; n < 2200; ++n) {
    const vec3 out(std::cos(arm.joints()(0)), std::sin(arm.joints()(0)), 0);
    const vec3 round(-out(1), out(0), 0);
    const Eigen::Matrix3d j = arm.jacobian();
    vec3 by;
    if (n < 2000) {
      by = j.inverse() * (round * (n % 2 != 0 ? 1e-3 : -1e-3));
    } else {
      const double along = force.dot(round) * T / (2 * b);
      by = {std::clamp(along, -0.03, 0.03) / (j.col(0).norm()), 0, 0};
    }
    work = arm.move(by, torque);
    least = std::min(least, loan + arm.energy());
    const vec3 wanted = n < 1999 ? vec3(out * 9.0) : vec3(round * 9.0);
    if constexpr (ph::detail::reports_work<typename Port::port_type>()) {
      force =
          port.tick({.position = arm.tip(), .held = force, .dt = T, .valid = true, .work = work},
                    wanted)
              .force;
    } else {
      force = port.tick(arm.tip(), ph::seconds{T}, wanted).force;
    }
    torque = arm.torques(force);
  }
  return least;
}

template <class P>
[[nodiscard]] auto bounded(const auto& bound) {
  return ph::passive_port{P{}, ph::given_force{}, ph::reduced_energy{.damping = b, .loan = loan},
                          bound, thesis_loop};
}

}  // namespace

TEST_CASE("a sample without reported work is as large as ever", "[lemma_j]") {
  STATIC_REQUIRE(sizeof(ph::device_sample<f1>) == 4 * sizeof(float));
  STATIC_REQUIRE(sizeof(ph::device_sample<d3>) == 8 * sizeof(double));
  STATIC_REQUIRE(sizeof(ph::device_sample<ph::reported_work<f1>>) == 5 * sizeof(float));
}

TEST_CASE("an arm's tip and its Jacobian agree", "[lemma_j]") {
  const vec3 q(0.3, 0.9, -0.4);
  const Eigen::Matrix3d j = joint_arm({}, q).jacobian();
  for (int i = 0; i < 3; ++i) {
    vec3 step = vec3::Zero();
    step(i) = 1e-6;
    const vec3 slope = (joint_arm({}, q + step).tip() - joint_arm({}, q - step).tip()) / 2e-6;
    CHECK((slope - j.col(i)).norm() < 1e-9);
  }
}

TEST_CASE("joint motors get their work booked where it is reported, and give joules away where not",
          "[lemma_j]") {
  const ph::strict_bound strict;
  const double reported = left_by_shaking(bounded<ph::reported_work<d3>>(strict));
  const double by_the_tip = left_by_shaking(bounded<d3>(strict));
  CAPTURE(reported, by_the_tip);
  CHECK(reported >= 0.0);
  CHECK(reported < loan / 2);  // it was drained, too
  CHECK(by_the_tip < -1e-3);
}

TEST_CASE("work that is no number, or untrue by a lost sample, is not booked", "[lemma_j]") {
  using device = ph::reported_work<d1>;
  ph::passive_port port{device{}, ph::given_force{}, ph::capped_energy{.damping = b, .loan = 1e-3},
                        ph::strict_bound{}, thesis_loop};
  const auto at = [](double x, double work, bool valid = true) {
    return ph::device_sample<device>{
        .position = x, .held = 0.0, .dt = T, .valid = valid, .work = work};
  };
  CHECK(port.tick(at(0.0, 5.0), 0.0).energy == 1e-3);  // the first: nobody knows since when
  const double before = port.energy();
  CHECK(port.tick(at(0.0, std::nan("")), 0.0).what == ph::event::rejected_sample);
  CHECK(port.tick(at(0.0, -5.0), 0.0).energy == before);  // since a sample that was lost
  CHECK(port.tick(at(0.0, -0.5), 0.0).energy > before + 0.49);
  CHECK(port.tick(at(0.0, 0.25), 0.0).energy < before + 0.26);
  CHECK(port.tick(at(0.0, 0.0, false), 0.0).what == ph::event::rejected_sample);
}

TEST_CASE("a late tick of a device that reports its work is booked behind a watchdog, too",
          "[lemma_j]") {
  using device = ph::reported_work<d1>;
  auto loop = thesis_loop;
  loop.watchdog = 1e-3;
  ph::passive_port port{device{}, ph::given_force{}, ph::reduced_energy{.damping = b, .loan = 1.0},
                        ph::strict_bound{}, loop};
  const ph::device_sample<device> on_time{.dt = T, .valid = true};
  CHECK(port.tick(on_time, 1.0).what == ph::event::nominal);
  auto late = on_time;
  late.held = 1.0;
  late.dt = 1.5 * T;
  late.work = 0.25;
  const auto result = port.tick(late, 1.0);
  CHECK(result.what == ph::event::late_tick);
  CHECK(result.energy <= 0.75);
}
