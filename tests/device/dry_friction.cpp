// SPDX-License-Identifier: BSD-3-Clause
// Dampings with dry friction: what they say of a force, of a motion and of what the friction holds.
#include "support/catch.hpp"
#include "support/exact.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/device/joint_space.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double T = 1e-3;
using on_axes = ph::diagonal_damping_and_friction<2>;
constexpr on_axes arm{{0.01, 0.04}, {0.2, 0.1}, {10e-6, 30e-6}};

/// Axis i of it by itself.
auto axis(std::size_t i) {
  return at<d1>(ph::damping_and_friction{arm.coefficients[i], arm.coulomb[i], arm.presliding[i]});
}
template <class Damping>
std::string refused(const Damping& damping) {
  const auto fault = damping.check();
  return fault ? fault.parameter : "";
}
double wide(float x) {
  return static_cast<double>(x);
}

}  // namespace

TEST_CASE("damping_and_friction credits f_c|Δx| and gives f_c for nothing, but not in debt",
          "[damping]") {
  const auto both =
      at<d2>(ph::damping_and_friction{.coefficient = 0.03, .coulomb = 0.5, .presliding = 1e-5});
  const auto bare = at<d2>(ph::isotropic_damping{0.03});
  const d2::vector dx(3e-3, 4e-3), f(0.6, 0.8);
  CHECK_THAT(both.dissipated(dx, T) - bare.dissipated(dx, T), WithinRel(0.5 * 5e-3, 1e-12));
  CHECK_THAT(both.worst_outflow(f, T), WithinRel(0.25 / 120, 1e-12));
  CHECK(both.worst_outflow(d2::vector(0.3, 0.4), T) == 0.0);
  CHECK_THAT(both.affordable(f, 0.0, T), WithinRel(0.5, 1e-9));
  CHECK(both.affordable(d2::vector(0.3, 0.3), 0.0, T) == 1.0);
  CHECK(both.affordable(f, -1e-9, T) == 0.0);
  CHECK_THAT(both.affordable(10 * f, 0.01, T), WithinRel((0.5 + std::sqrt(1.2)) / 10, 1e-9));
  CHECK(both.friction(f) == 0.5);
  static_assert(decltype(both)::rubs);
}

TEST_CASE("a friction force is at most c, and nearest to what is asked", "[damping]") {
  const auto both = at<d2>(ph::damping_and_friction{0.03, 0.5, 1e-5});
  const d2::vector small(0.2, -0.3), large(6, -8);
  CHECK(both.friction_near(small) == small);
  CHECK((both.friction_near(large) - d2::vector(0.3, -0.4)).norm() < 1e-14);
  CHECK((both.friction_along(d2::vector(3e-9, 4e-9)) - d2::vector(0.3, 0.4)).norm() < 1e-14);
  CHECK(both.friction_along(d2::zero()) == d2::zero());
  CHECK(both.friction_along(d2::vector(1e-160, 0)) ==
        d2::zero());  // its square is no normal number
  CHECK(both.most_friction() == 0.5);

  const auto own = at<d2>(arm);
  CHECK(own.friction_near(d2::vector(0.05, -0.3)) == d2::vector(0.05, -0.1));
  CHECK(own.friction_near(d2::vector(-0.3, 0.05)) == d2::vector(-0.2, 0.05));
  CHECK(own.friction_along(d2::vector(1e-200, -3.0)) == d2::vector(0.2, -0.1));
  CHECK(own.friction_along(d2::vector(0.0, 3.0)) == d2::vector(0.0, 0.1));
  CHECK_THAT(own.most_friction(), WithinRel(std::sqrt(0.05), 1e-15));
}

TEST_CASE("what springs in the friction hold is ½ c p when it slips, and a change of u costs p|Δu|",
          "[damping]") {
  const auto both = at<d2>(ph::damping_and_friction{0.03, 0.5, 1e-5});
  CHECK_THAT(both.most_stored(), WithinRel(0.5 * 0.5 * 1e-5, 1e-14));
  CHECK_THAT(both.stored(d2::vector(0.3, -0.4)), WithinRel(both.most_stored(), 1e-14));
  CHECK_THAT(both.stored(d2::vector(0.15, 0.2)), WithinRel(both.most_stored() / 4, 1e-14));
  CHECK_THAT(both.hysteresis(d2::vector(-0.3, 0.4)), WithinRel(0.5 * 1e-5, 1e-14));
  const auto none = at<d1>(ph::damping_and_friction{0.03, 0.0, 1e-5});
  CHECK(none.stored(0.0) == 0.0);  // no friction, whatever p: no spring
  CHECK(at<d2>(on_axes{{1.0, 1.0}, {0.0, 0.1}, {1e-5, 0.0}}).stored(d2::vector(0.0, 0.1)) == 0.0);
}

TEST_CASE("dry friction on each axis is that of its axes", "[damping]") {
  const auto own = at<d2>(arm);
  const auto x = axis(0), y = axis(1);
  ph::laws::samples random(1);
  for (int n = 0; n < 200; ++n) {
    const d2::vector f = random.vector<d2>(), dx = random.vector<d2>() * 1e-3;
    CHECK_THAT(own.dissipated(dx, T),
               WithinRel(x.dissipated(dx(0), T) + y.dissipated(dx(1), T), 1e-14));
    CHECK_THAT(own.viscous(dx, T), WithinRel(x.viscous(dx(0), T) + y.viscous(dx(1), T), 1e-14));
    CHECK_THAT(own.worst_outflow(f, T),
               WithinAbs(x.worst_outflow(f(0), T) + y.worst_outflow(f(1), T), 1e-15));
    CHECK_THAT(own.hysteresis(f), WithinRel(x.hysteresis(f(0)) + y.hysteresis(f(1)), 1e-14));
    const d2::vector u = own.friction_near(f);
    CHECK_THAT(own.stored(u), WithinRel(x.stored(u(0)) + y.stored(u(1)), 1e-14));
    CHECK_THAT(u(0), WithinRel(x.friction_near(f(0)), 1e-14));
    CHECK_THAT(u(1), WithinRel(y.friction_near(f(1)), 1e-14));
  }
  CHECK_THAT(own.most_stored(), WithinRel(x.most_stored() + y.most_stored(), 1e-14));
  const auto joints = at<ph::joint_space<double, 2>>(arm);
  CHECK(joints.dissipated(d2::vector(1e-3, 2e-3), T) == own.dissipated(d2::vector(1e-3, 2e-3), T));
}

TEST_CASE("friction(f) is the least that a way of 1 m along f pays, whatever happens across it",
          "[damping]") {
  const auto own = at<d2>(arm);
  CHECK_THAT(own.friction(d2::vector(3, -4)), WithinRel(0.1 / 0.8, 1e-14));
  CHECK_THAT(own.friction(d2::vector(0.03, -0.04)), WithinRel(0.1 / 0.8, 1e-14));
  CHECK_THAT(own.friction(d2::vector(4, 3)), WithinRel(0.1 / 0.6, 1e-14));
  CHECK_THAT(own.friction(d2::vector(4, 1)), WithinRel(0.2 * std::sqrt(17.0) / 4, 1e-14));
  CHECK(own.friction(d2::vector(-2, 0)) == 0.2);
  CHECK(own.friction(d2::zero()) == 0.0);
  const auto slider = at<d2>(on_axes{{1.0, 1.0}, {0.2, 0.0}, {0.0, 0.0}});  // smooth across
  CHECK(slider.friction(d2::vector(2, 0)) == 0.2);
  CHECK(slider.friction(d2::vector(2, 1e-3)) == 0.0);
  ph::laws::samples random(1);
  for (int n = 0; n < 500; ++n) {
    const d2::vector f = random.direction<d2>(), dx = random.vector<d2>();
    const double paid = own.dissipated(dx, T) - own.viscous(dx, T);
    REQUIRE(own.friction(f) * f.dot(dx) <= paid * (1 + 1e-14) + 1e-15);
  }
}

TEST_CASE("what a diagonal friction lets out of a credit costs no more than it", "[damping]") {
  const auto own = at<d2>(arm);
  const d2::vector f(3, 4);
  const double s0 = 0.1 / 4, E = 0.01, W = own.worst_outflow(f, T);
  CHECK_THAT(own.affordable(f, E, T), WithinRel(s0 + (1 - s0) * std::sqrt(E / W), 1e-13));
  CHECK_THAT(own.affordable(f, 0.0, T), WithinRel(s0, 1e-13));
  CHECK(own.affordable(f, 2 * W, T) > 1 - 1e-13);
  CHECK(own.affordable(f, 2 * W, T) <= 1.0);
  CHECK(own.affordable(f, -1e-9, T) == 0.0);
  CHECK(own.affordable(d2::vector(-0.2, 0.1), 0.0, T) == 1.0);  // friction holds it
  CHECK(own.affordable(d2::vector(-0.2, 0.1), -1e-9, T) == 0.0);
  CHECK(own.affordable(d2::zero(), 0.0, T) == 1.0);
  const auto smooth = at<d2>(on_axes{{1.0, 1.0}, {0.2, 0.0}, {0.0, 0.0}});
  CHECK(smooth.affordable(d2::vector(0.1, 0.0), 0.0, T) == 1.0);
  CHECK(smooth.affordable(d2::vector(0.1, 1e-3), 0.0, T) == 0.0);

  // An empty ledger lets out no more than the friction of each axis, in exact arithmetic: products of
  // floats are exact in double.
  const auto exactly = at<f2>(arm);
  const double c0 = wide(0.2F), c1 = wide(0.1F);
  ph::laws::samples random(1);
  for (int n = 0; n < 2000; ++n) {
    const f2::vector asked = random.vector<f2>() * 5.0F;
    const double share = wide(exactly.affordable(asked, 0.0F, 1e-3F));
    REQUIRE(share * std::abs(wide(asked(0))) <= c0);
    REQUIRE(share * std::abs(wide(asked(1))) <= c1);
    const float credit = 1e-3F * (1.0F + random.number<float>());
    const double some = wide(exactly.affordable(asked, credit, 1e-3F));
    const auto outflow = [&](double force, double c, double b) {
      const double beyond = std::max(some * std::abs(force) - c, 0.0);
      return wide(1e-3F) * beyond * beyond / (4 * b);
    };
    REQUIRE(outflow(wide(asked(0)), c0, wide(0.01F)) + outflow(wide(asked(1)), c1, wide(0.04F)) <=
            wide(credit));
  }
}

TEST_CASE("damping_and_friction covers what it lets out of any credit, however small",
          "[damping]") {
  const float b = 0.03F, tick = 1e-3F;
  const auto damping = at<f1>(ph::damping_and_friction{wide(b), 0.0, 0.0});
  ph::laws::samples random(1);
  int some = 0;
  for (int n = 0; n < 5000; ++n) {
    const float E = exact::any_positive_float(random), asked = exact::any_positive_float(random);
    const float share = damping.affordable(asked, E, tick);
    const float force = asked * share;
    REQUIRE(share <= 1.0F);
    if (asked < 1e18F) REQUIRE(exact::covered(force, E, b, tick));
    if (share > 0.0F && share < 1.0F) ++some;
  }
  CHECK(some > 1000);
  CHECK(damping.affordable(1.0F, 1e-40F, tick) == 0.0F);  // no normal number: not to be trusted
  CHECK(damping.affordable(0.0F, 0.0F, tick) == 1.0F);
}

TEST_CASE("rounding charges for friction, it never credits it", "[damping]") {
  const float c = 0.3F, p = 1.7e-5F, p0 = 1e-5F, p1 = 3e-5F;
  const auto line = at<f1>(ph::damping_and_friction{0.03, wide(c), wide(p)});
  const auto plane = at<f2>(ph::damping_and_friction{0.03, wide(c), wide(p)});
  const auto axes = at<f2>(on_axes{{0.03, 0.03}, {0.2, 0.1}, {wide(p0), wide(p1)}});
  const double almost = 40 * wide(std::numeric_limits<float>::epsilon());
  const auto rounded_up = [&](float what, double exactly) {
    return wide(what) >= exactly && wide(what) <= exactly * (1 + almost);
  };
  ph::laws::samples random(1);
  for (int n = 0; n < 2000; ++n) {
    const f2::vector d = random.vector<f2>();
    const double x = wide(d(0)), y = wide(d(1));
    REQUIRE(rounded_up(line.hysteresis(d(0)), wide(p) * std::abs(x)));
    REQUIRE(rounded_up(line.stored(d(0)), x * x * wide(p) / (2 * wide(c))));
    REQUIRE(rounded_up(plane.hysteresis(d), wide(p) * std::sqrt(x * x + y * y)));
    REQUIRE(rounded_up(plane.stored(d), (x * x + y * y) * wide(p) / (2 * wide(c))));
    REQUIRE(rounded_up(axes.hysteresis(d), wide(p0) * std::abs(x) + wide(p1) * std::abs(y)));
    REQUIRE(rounded_up(axes.stored(d),
                       x * x * wide(p0) / (2 * wide(0.2F)) + y * y * wide(p1) / (2 * wide(0.1F))));
    // and never counts on more than c
    const f2::vector along = plane.friction_along(f2::vector(d * 1e-3F)),
                     near = plane.friction_near(d);
    const auto square = [](const f2::vector& u) {
      return wide(u(0)) * wide(u(0)) + wide(u(1)) * wide(u(1));
    };
    REQUIRE(square(along) <= wide(c) * wide(c));
    REQUIRE(square(near) <= wide(c) * wide(c));
    REQUIRE(plane.friction_near(near) == near);
    REQUIRE(plane.friction_near(along) == along);
    const float hardly = c * (1.0F + 2e-6F * random.number<float>());  // more than c, or less
    REQUIRE(std::abs(line.friction_near(hardly)) <= c);
  }
}

TEST_CASE("dry friction is refused with its name, and gives its parameters back", "[damping]") {
  CHECK(refused(ph::damping_and_friction{0.03, 0.0, 0.0}).empty());
  CHECK(refused(ph::damping_and_friction{0.03, 0.1}) == "presliding");  // it has no default
  CHECK(refused(arm).empty());
  CHECK(refused(on_axes{{0.01, 0.04}, {0.2, 0.1}}) == "presliding");
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    CHECK(refused(ph::damping_and_friction{bad, 0.1, 0.0}) == "damping");
    CHECK(refused(ph::damping_and_friction{0.03, bad, 0.0}) == "friction");
    CHECK(refused(ph::damping_and_friction{0.03, 0.1, bad}) == "presliding");
    CHECK(refused(on_axes{{0.01, bad}, {0.2, 0.1}, {0.0, 0.0}}) == "damping");
    CHECK(refused(on_axes{{0.01, 0.04}, {bad, 0.1}, {0.0, 0.0}}) == "friction");
    CHECK(refused(on_axes{{0.01, 0.04}, {0.2, 0.1}, {0.0, bad}}) == "presliding");
  }
  CHECK(refused(ph::damping_and_friction{0.0, 0.1, 0.0}) == "damping");
  CHECK(refused(on_axes{{0.01, 0.0}, {0.2, 0.1}, {0.0, 0.0}}) == "damping");
  const auto both = at<f1>(ph::damping_and_friction{0.25, 0.5, 0.125}).parameters();
  CHECK(both.coefficient == 0.25);
  CHECK(both.coulomb == 0.5);
  CHECK(both.presliding == 0.125);
  const auto own = at<d2>(arm).parameters();
  CHECK(own.coefficients == arm.coefficients);
  CHECK(own.coulomb == arm.coulomb);
  CHECK(own.presliding == arm.presliding);
}

TEST_CASE("what yields is the part of a force that no friction holds, axis by axis", "[damping]") {
  const auto own = at<d2>(arm);
  const d2::vector left = own.yielding(d2::vector(3, -4), 0.03);
  CHECK_THAT(left(0), WithinRel(0.2 + 2.8 * 0.01 / 0.04, 1e-14));
  CHECK_THAT(left(1), WithinRel(-0.1 - 3.9 * 0.04 / 0.07, 1e-14));
  CHECK(own.yielding(d2::vector(-0.2, 0.05), 0.03) == d2::vector(-0.2, 0.05));
  const auto both = at<d2>(ph::damping_and_friction{0.03, 0.5, 1e-5});
  const double least = std::ldexp(1.0, -485);  // m, whose square is the least normal number over ε
  CHECK(both.friction_along(d2::vector(least, 0)) == d2::zero());
  CHECK_THAT(both.friction_along(d2::vector(2 * least, 0)).x(), WithinRel(0.5, 1e-14));
}
