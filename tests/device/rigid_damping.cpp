// SPDX-License-Identifier: BSD-3-Clause
#include "../bench/contacts/rigid_attacks.hpp"
#include "support/catch.hpp"
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/laws.hpp>
#include <passive_haptics/port/reported_work.hpp>
#include <passive_haptics/published/energy_tank.hpp>

#include <array>
#include <cmath>
#include <string>

using Catch::Matchers::WithinAbs;
namespace ph = passive_haptics;
namespace sim = ph::simulation;

namespace {
using vec3 = ph::rigid_body<double>::triple;
using body = ph::rigid_body<double>;
using ledger = ph::basic_reduced_energy<ph::rigid_damping>;
constexpr ph::rigid_damping b{.linear = 0.03, .angular = 1e-4};
constexpr double T = 1e-3;
const ph::part_at<ph::rigid_damping, body> damping(b);
}  // namespace

TEMPLATE_TEST_CASE("a rigid body's damping, ledger and bounds obey the laws", "[rigid_damping]",
                   ph::rigid_body<double>, ph::rigid_body<float>,
                   ph::reported_work<ph::rigid_body<double>>) {
  CHECK(ph::laws::all<ph::rigid_damping, TestType>(b));
  CHECK(ph::laws::all<ledger, TestType>({.damping = b}));
  CHECK(ph::laws::all<ph::basic_capped_energy<ph::rigid_damping>, TestType>(
      {.damping = b, .loan = 0.1, .cap = 0.5}));
  CHECK(ph::laws::all<ph::strict_bound, TestType>());
  CHECK(ph::laws::spends_at_most_the_ledger<TestType>(ph::strict_bound{}));
  CHECK(ph::laws::all<ph::energy_tank, TestType>({.reserve = 1e-3}));
  if constexpr (!ph::detail::reports_work<TestType>()) {
    CHECK(ph::laws::all<ph::memoryless_bound, TestType>());
  }
}

TEST_CASE("a rigid body's damping is refused with the name of what is none", "[rigid_damping]") {
  const auto refused = [](const ph::rigid_damping& p) {
    const auto fault = p.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(b).empty());
  CHECK(refused({.linear = 0.0, .angular = 1e-4}) == "linear");
  CHECK(refused({.linear = 0.03, .angular = -1.0}) == "angular");
  CHECK(refused({.linear = std::nan(""), .angular = 0.0}) == "linear");
  CHECK(damping.parameters().linear == b.linear);
  CHECK(damping.parameters().angular == b.angular);
}

TEST_CASE("a rigid body's outflow and what it may hold are what their formulas say",
          "[rigid_damping]") {
  const ph::part_at<ph::rigid_damping, body> plain(
      ph::rigid_damping{.linear = 0.5, .angular = 1.0});
  const body::effort w = body::join({3, 4, 0}, {0, 0, 2});
  CHECK(plain.worst_outflow(w, 0.5) == 6.75);  // ½·25/(4·½) + ½·4/4
  CHECK(plain.per_tick(w, 0.5) == 29.0 / 27.0);
  CHECK(plain.affordable(w, 100.0, 0.5) == 1.0);
  CHECK_THAT(plain.affordable(w, 6.75 / 4, 0.5), WithinAbs(0.5, 1e-12));
  CHECK(plain.affordable(w, -1.0, 0.5) == 0.0);
  const body::effort torque = body::join({0, 0, 0}, {0, 32, 0});  // 4b_ω/T is a quarter of it
  CHECK_THAT(plain.affordable(torque, 1e6, 0.5), WithinAbs(0.25, 1e-12));
  CHECK(plain.affordable(torque, 1e6, 0.5) < 0.25);

  // Lemma C holds up to a turn of 1 rad and a torque of 4b_ω/dt = 8 N·m, both included.
  const auto unsure = [&plain](const vec3& turn, const vec3& held) {
    return plain.unsure(body::join({9, 9, 9}, turn), body::join({7, 7, 7}, held), 0.5);
  };
  const auto just_above = [](double bound, double exact) {
    return bound > exact && bound < exact * (1.0 + 1e-14);
  };
  CHECK(just_above(unsure({1, 0, 0}, {0, 8, 0}), 0.5 * 64 / 36));
  CHECK(just_above(unsure({0.5, 0, 0}, {3, 4, 0}), 0.5 * 4 / 36));
  CHECK(unsure({0, 1, 0}, {0, 8, 0}) == 0.0);
  CHECK(just_above(unsure({2, 0, 0}, {1, 3, 0}), 4 / 0.5 - 2 + 0.5 * 10 / 4));
  CHECK(just_above(unsure({0.5, 0, 0}, {-1, 0, 9}), 0.25 / 0.5 + 0.5 + 0.5 * 82 / 4));
}

TEST_CASE("a rigid body's damper pushes against each axis, and takes what it dissipates",
          "[rigid_damping]") {
  ph::laws::samples draw(1);
  for (int n = 0; n < 20; ++n) {
    const body::motion m = 1e-3 * draw.vector<body>();
    const body::effort w = damping.force(m, T);
    for (int i = 0; i < 6; ++i) {
      const double coefficient = i < 3 ? b.linear : b.angular;
      CHECK_THAT(body::component(w, i), WithinAbs(coefficient / T * body::component(m, i), 1e-14));
    }
    CHECK_THAT(body::work(w, m).joules, WithinAbs(damping.dissipated(m, T), 1e-15));
  }
}

TEST_CASE("a margin of dt|θ × τ|²/(36 b_ω) covers every arc of lemma C, and one of 1/38 does not",
          "[rigid_damping]") {
  double most = 0.0;  // of what is missing, in parts of dt|θ × τ|²/b_ω
  for (double phi = 0.2; phi <= 1.0; phi += 0.1) {
    const vec3 torque(0, 0, phi * 4 * b.angular / T);
    for (double along = -3.0; along <= 3.0; along += 0.03) {
      for (double across = 0.02; across <= 3.0; across += 0.02) {
        const auto path = rigid::extremal(torque, b.angular, T, along, across, {1, 0, 0});
        const vec3 turn = ph::rotation::log(path.end({}, T));
        if (turn.norm() > 1.0) continue;
        const body::motion motion = body::join(vec3(0, 0, 0), turn);
        const body::effort held = body::join(vec3(0, 0, 0), torque);
        const double brought =
            b.angular * path.start.squaredNorm() * T - torque.dot(path.integral(T));
        const double shown = damping.dissipated(motion, T) - body::work(held, motion).joules;
        CHECK(shown - damping.unsure(motion, held, T) <= brought + 1e-15);
        const double across_it = ph::space<double, 3>::cross(turn, torque).squaredNorm();
        most = std::max(most, (shown - brought) * b.angular / (T * across_it));
      }
    }
  }
  CHECK(most < 1.0 / 36);
  CHECK(most > 1.0 / 38);
}

TEST_CASE("paths of many pieces hide no more from their ends than lemma C allows",
          "[rigid_damping]") {
  ph::laws::samples random(5);
  double most = 0.0;
  for (int run = 0; run < 400; ++run) {
    // Six straight pieces, changed a little as long as that hides more.
    std::array<vec3, 6> pieces{};
    const vec3 torque(0, 0, 4 * b.angular / T);
    const auto hidden = [&](const std::array<vec3, 6>& path) {
      ph::quaternion<double> q;
      vec3 integral(0, 0, 0);
      double taken = 0.0;
      for (const vec3& piece : path) {
        q = ph::rotation::product(ph::rotation::exp<double>(piece), q);
        integral += piece;
        taken += b.angular * piece.squaredNorm() / (T / 6);
      }
      const vec3 turn = ph::rotation::log(ph::rotation::normalised(q));
      if (turn.norm() > 1.0 || turn.norm() < 1e-3) return 0.0;
      const double shown = b.angular * turn.squaredNorm() / T - torque.dot(turn);
      const double across = ph::space<double, 3>::cross(turn, torque).squaredNorm();
      const double needed = (shown - taken + torque.dot(integral)) * b.angular / T;
      return across > 1e-6 * torque.squaredNorm() ? needed / across : 0.0;
    };
    const double size = 0.3 * ph::kernels::magnitude(random.number<double>());
    for (vec3& piece : pieces) piece = random.vector<ph::space<double, 3>>() * size;
    double best = hidden(pieces);
    for (int i = 0; i < 300; ++i) {
      auto other = pieces;
      other[random.bits() % 6] += random.vector<ph::space<double, 3>>() * (size * 0.3);
      const double now = hidden(other);
      if (now > best) {
        best = now;
        pieces = other;
      }
    }
    most = std::max(most, best);
  }
  CAPTURE(1 / most);
  CHECK(most < 1.0 / 36);
  CHECK(most > 1.0 / 60);  // the search finds something
}

TEST_CASE("a turn of which lemma C does not speak counts as the worst", "[rigid_damping]") {
  const vec3 none(0, 0, 0);
  const double most = 4 * b.angular / T;
  const auto booked = [&](const vec3& turn, const vec3& torque, double dt) {
    const body::motion m = body::join(vec3(1e-3, 0, 0), turn);
    const body::effort held = body::join(vec3(2, 0, 0), torque);
    ph::part_at<ledger, body> one({.damping = b, .loan = 1.0});
    return one.update(m, held, dt) ? one.value() - 1.0 : std::nan("");
  };
  const double travelled = b.linear * 1e-6 / T - 2e-3;
  const auto worst = [&](double torque, double dt) {
    return -dt * torque * torque / (4 * b.angular);
  };
  const double slack = 1e-13;
  // Straight along the torque within its reach: nothing is hidden.
  CHECK_THAT(booked({0, 0, 0.9}, {0, 0, -0.1}, T),
             WithinAbs(travelled + b.angular * 0.81 / T + 0.09, slack));
  // More than a radian, more torque, or a tick so late that it was.
  CHECK_THAT(booked({0, 0, 1.01}, {0, 0, -0.1}, T), WithinAbs(travelled + worst(0.1, T), slack));
  CHECK_THAT(booked({0, 0, 0.9}, {0, 0, -1.01 * most}, T),
             WithinAbs(travelled + worst(1.01 * most, T), slack));
  const double late = travelled + b.linear * 1e-6 * (1 / (1.5 * T) - 1 / T);
  CHECK_THAT(booked({0, 0, 0.9}, {0, 0, -0.9 * most}, 1.5 * T),
             WithinAbs(late + worst(0.9 * most, 1.5 * T), slack));
  CHECK(std::isnan(booked({0, std::nan(""), 0}, none, T)));
}

TEST_CASE("what a ledger saves for the path is never more than a torque's worst",
          "[rigid_damping]") {
  // Then strict_bound, which has paid for the worst, leaves no debt by it.
  ph::laws::samples random(6);
  for (int i = 0; i < 20000; ++i) {
    const vec3 turn = random.vector<ph::space<double, 3>>() * 0.57;
    const vec3 torque = random.vector<ph::space<double, 3>>() * (0.57 * 4 * b.angular / T);
    const body::motion m = body::join(vec3(0, 0, 0), turn);
    const body::effort held = body::join(vec3(0, 0, 0), torque);
    const double gain =
        damping.dissipated(m, T) - body::work(held, m).joules - damping.unsure(m, held, T);
    CHECK(gain >= -damping.worst_outflow(held, T) * (1 + 1e-12) - 1e-15);
  }
}
