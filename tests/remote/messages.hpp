// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Messages and surfaces for the tests of remote/.
#include "support/scenes.hpp"
#include <passive_haptics/remote.hpp>

#include <vector>

namespace remote = ph::remote;

namespace remote_test {

inline const ph::half_space<d3> floor_at_1mm{{0, 0, 1e-3}, {0, 0, 1}, 2000.0};
inline const ph::quadric<d3> ball{.point = {0.01, 0.02, 0.03},
                                  .normal = {0.0, 0.6, 0.8},
                                  .tangent = {1.0, 0.0, 0.0},
                                  .curvature = 40.0,
                                  .cross_curvature = -25.0,
                                  .stiffness = 700.0,
                                  .thickness = 0.005,
                                  .reach = 0.02};

inline remote::content content_of_form(remote::form form) {
  switch (form) {
    case remote::form::plane:
      return remote::content_of(floor_at_1mm);
    case remote::form::quadric:
      return remote::content_of(ball);
    case remote::form::probe:
      return remote::content_of(
          remote::probe{.position = {0.1, -0.2, 0.3}, .force = {1, 2, -3}, .energy = 0.04});
    default:
      return {};
  }
}
inline remote::message message_of(remote::form form) {
  return {.kind = form == remote::form::probe ? remote::kind::question : remote::kind::answer,
          .key = 0xA1B2C3D4E5F60718,
          .session = 0x0102030405060708,
          .sequence = 0xFFFFFFFE,
          .stamp = remote::nanoseconds(1'000'000'007),
          .content = content_of_form(form)};
}

/// Where the client is, as far as a test has no sockets.
inline constexpr remote::sender home{{1, 2, 3}, 4};

constexpr remote::nanoseconds ms(std::int64_t n) {
  return std::chrono::milliseconds(n);
}

}  // namespace remote_test
