// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/contact/at_tip.hpp>

#include <string>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr ph::seconds T{1e-3};
using plane = ph::half_space<d3>;
using pose = ph::rigid_pose<double>;
using vector = d3::vector;
constexpr double length = 0.11;  // of the stylus [m]

/// A tip that hangs below its gimbal, over a floor.
auto pen(const std::array<double, 3>& tip = {0.0, 0.0, -length}) {
  ph::passive_port port{ph::stylus<double>{},
                        ph::at_tip{ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{},
                                                   ph::slots<plane, 1>{}},
                                   tip},
                        ph::no_observer{}, ph::no_bound{}, thesis_loop};
  port.source().contact().update(0, plane{vector(0, 0, 0), vector(0, 0, 1), 1000.0});
  return port;
}
ph::quaternion<double> lean(double angle) {
  return {std::cos(angle / 2), 0.0, std::sin(angle / 2), 0.0};
}

}  // namespace

TEST_CASE("the tip of a stylus is where its pose says", "[at_tip]") {
  auto port = pen();
  (void)port.tick(pose{{0, 0, length + 1e-3}, {}}, T);
  for (int i = 0; i < 3; ++i) (void)port.tick(pose{{0, 0, length - 1e-3}, {}}, T);
  CHECK_THAT(port.tick(pose{{0, 0, length - 1e-3}, {}}, T).force.z(), WithinRel(1.0, 1e-9));
  const auto said = port.explain();
  CHECK(said.shown == 1000.0);
  CHECK_THAT(said.depth, WithinRel(1e-3, 1e-9));
  CHECK_THAT(said.force, WithinRel(1.0, 1e-9));
  const double angle = std::acos(1.0 - 2e-3 / length);  // leaning lifts the tip by 2 mm
  for (int i = 0; i < 3; ++i) (void)port.tick(pose{{0, 0, length - 1e-3}, lean(angle)}, T);
  CHECK(port.tick(pose{{0, 0, length - 1e-3}, lean(angle)}, T).force.z() == 0.0);
}

TEST_CASE("a tip that is nowhere is refused by name, and any other is taken", "[at_tip]") {
  const ph::contact_set set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<plane, 1>{}};
  CHECK_FALSE(ph::at_tip{set, {0.0, -0.1, 1e3}}.check());
  for (int i = 0; i < 3; ++i) {
    for (const double bad : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
      std::array<double, 3> tip{};
      tip[static_cast<std::size_t>(i)] = bad;
      CHECK(std::string(ph::at_tip{set, tip}.check().parameter) == "tip");
    }
  }
}

TEST_CASE("a tip that is turned in is damped by its own speed", "[at_tip]") {
  auto still = pen(), turned = pen();
  const pose above{{0, 0, length}, lean(0.3)}, in{{0, 0, length - 3e-3}, lean(0.1)};
  (void)still.tick(above, T);
  (void)turned.tick(above, T);
  for (int i = 0; i < 3; ++i) (void)still.tick(in, T);
  const double at_rest = still.tick(in, T).force.z();
  const double moving = turned.tick(in, T).force.z();
  CHECK(at_rest > 1.0);
  CHECK_THAT(moving, WithinRel(ph::inward_limit * at_rest, 1e-9));  // fast inwards
}

TEST_CASE("a stylus whose quaternion is no rotation, or whose tip is no place, pushes nothing",
          "[at_tip]") {
  auto port = pen();
  (void)port.tick(pose{{0, 0, length + 1e-3}, {}}, T);
  for (int i = 0; i < 3; ++i) (void)port.tick(pose{{0, 0, length - 1e-3}, {}}, T);
  const auto out = port.tick(pose{{0, 0, length - 1e-3}, {1.1, 0, 0, 0}}, T);
  CHECK(out.what == ph::event::rejected_sample);
  CHECK(out.force == vector::Zero());
  auto wrong = pen({0.0, std::nan(""), 0.0});
  CHECK(std::string(wrong.check().parameter) == "tip");
  CHECK(wrong.tick(pose{}, T).what == ph::event::rejected_parameters);
  CHECK(wrong.tick(pose{}, T).force == vector::Zero());
  CHECK_FALSE(pen().check());
}

TEST_CASE("the contact at a tip is one, whoever looks at it", "[at_tip]") {
  auto port = pen();
  const auto& seen = port.source();
  CHECK(&seen.contact() == &port.source().contact());
  CHECK(seen.contact().slot(0).taken());
}
