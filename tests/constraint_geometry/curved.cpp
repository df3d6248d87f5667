// SPDX-License-Identifier: BSD-3-Clause
// What all curved surfaces owe: the laws, and the figures of docs/design/curved.md. What a kind owes by
// itself is in its own file.
#include "support/curved.hpp"

#include "support/catch.hpp"
#include "support/obedience.hpp"

using curved::Vector3d;

namespace {

/// What a stroke feels of a surface that is published anew every so many ticks, and snapped to.
curved::feel published_every(int ticks, const auto& next, const auto& feel) {
  auto now = next(curved::stroke(0));
  return curved::stroked([&](int i, const Vector3d& x) {
    if (i % ticks == 0) now = next(x);
    return feel(now, x);
  });
}
/// The surface next to x, ready to be probed.
auto prepared(auto surface) {
  REQUIRE(surface.prepare());
  return surface;
}

}  // namespace

TEMPLATE_TEST_CASE("every surface obeys the laws of surfaces", "[geometry][curved][law]", d3, f3) {
  int kinds = 0;
  curved::every_surface<TestType>([&](const auto& surface) {
    INFO("surface " << ++kinds);
    obey<role::surface, TestType>(surface);
  });
  CHECK(kinds >= 12);  // none has gone
}

TEMPLATE_TEST_CASE("a curved surface at 1 kHz is as smooth as the ball it stands for",
                   "[geometry][curved]", d3, f3) {
  using S = TestType;
  const double rounding = sizeof(typename S::scalar) == 4 ? 2e-5 : 0.0;  // float: 1e-8 m, 500 N/m
  const auto at_30_hz = [](const auto& next, bool along_normal = false) {
    return published_every(
        33, [&](const Vector3d& x) { return prepared(next(x)); },
        [&](const auto& surface, const Vector3d& x) {
          return curved::force<S>(surface, x, along_normal);
        });
  };
  const auto tangent_plane = [](const Vector3d& x) {
    return ph::half_space<S>{curved::of<S>(x.normalized() * curved::radius), curved::of<S>(x), 500};
  };
  const auto quadric = curved::osculating<S>;
  const auto brick = [](const Vector3d& x) { return curved::brick<S>(x); };
  const auto ball = [](const Vector3d& /*x*/) {
    return ph::sphere<S>{.radius = typename S::scalar(curved::radius), .stiffness = 500};
  };

  CHECK(at_30_hz(ball).largest_step < 0.0023 + rounding);
  CHECK(at_30_hz(ball).mean_error <= 1e-16 + rounding);
  CHECK(at_30_hz(quadric).largest_step < 0.0023 + rounding);
  CHECK(at_30_hz(quadric).mean_error < 0.00004 + rounding);
  CHECK(at_30_hz(brick).largest_step < 0.0038 + rounding);
  CHECK(at_30_hz(brick).mean_error < 0.0013 + rounding);
  // the controls: what a plane does, and the quadric without its second term
  CHECK(at_30_hz(tangent_plane).largest_step > 0.04);
  CHECK(at_30_hz(tangent_plane).mean_error > 0.01);
  CHECK(at_30_hz(quadric, true).mean_error > 5 * at_30_hz(quadric).mean_error);
}

TEMPLATE_TEST_CASE(
    "closed paths on a curved surface give nothing out, along the unit normal they do",
    "[geometry][curved][passivity]", d3, f3) {
  using S = TestType;
  const auto loop = [](const auto& surface, bool along_normal) {
    return curved::largest_loop(
        [&](const Vector3d& x) { return curved::force<S>(surface, x, along_normal); });
  };
  const auto quadric = prepared(curved::osculating<S>({0, 0, 1}));
  CHECK(loop(quadric, false) < 0.01e-6);
  CHECK(loop(quadric, true) > 50e-6);  // the control
  const auto brick = prepared(curved::brick<S>({0, 0, 0.048}, 0.012));
  CHECK(loop(brick, false) < 0.01e-6);
  CHECK(loop(brick, true) > 1e-6);  // the control
}
