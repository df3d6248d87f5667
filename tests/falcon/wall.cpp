// SPDX-License-Identifier: BSD-3-Clause
// The wall experiment through the mock Falcon: counts, words, saturation, packets one tick late.
#include "falcon/wall.hpp"

#include "../bench/common/spring_wall.hpp"

namespace {

/// Holds the grip's weight until it lets go.
struct letting_go {
  double weight = 0.0;   ///< [N]
  double release = 0.2;  ///< [s]
  [[nodiscard]] d3::vector force(double t, const d3::vector& /*x*/,
                                 const d3::vector& /*v*/) const noexcept {
    return {0.0, 0.0, t < release ? weight : 0.0};
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};

struct outcome {
  double least = 0.0;    ///< true port energy since forces were allowed [J]
  double deepest = 0.0;  ///< [m]
  double swing = 0.0;    ///< peak to peak of the last second [m]
  double force = 0.0;    ///< largest commanded [N]
  bool valid = true;     ///< every sample
};

/// Runs a model against a surface at height z that `surface(n, force)` moves [m].
template <class Hand, class Surface>
outcome run(auto model, falcon_device<Hand>& device, double z, const d3::vector& normal, double K,
            int ticks, const Surface& surface) {
  outcome seen;
  double low = 1.0, high = -1.0, offset = 0.0;
  const double start = body_of(device).meter().value();
  model.update({d3::vector(0.0, 0.0, z), normal, K});
  d3::vector force = d3::zero();
  for (int n = 0; n < ticks; ++n) {
    const double next = surface(n, force.norm());
    if (next != offset) {
      offset = next;
      model.update({d3::vector(d3::vector(0.0, 0.0, z) + normal * offset), normal, K});
    }
    const auto sample = device.exchange(force);
    seen.valid = seen.valid && sample.valid;
    force = model.tick(sample).force;
    const auto& body = body_of(device);
    seen.least = std::min(seen.least, body.meter().value() - start);
    const double height = normal.dot(body.position() - d3::vector(0.0, 0.0, z)) - offset;
    seen.deepest = std::max(seen.deepest, -height);
    seen.force = std::max(seen.force, force.norm());
    if (n >= ticks - 1000) {
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  seen.swing = high - low;
  return seen;
}

/// The drop of the core's experiments: 61 mm onto 10 kN/m, left alone for 6 s.
outcome drop(auto model, double mass, double b, double friction, bool yields) {
  mock_parameters mock{.runs = true, .homed = true};
  mock.body.mass = mass;
  mock.body.damping = b;
  mock.body.friction = friction;
  mock.body.start = {0.0, 0.0, 0.160};
  mock.body.load = {0.0, 0.0, -9.81 * mass};
  falcon_device<letting_go> device{3500.0, eager(), mock, letting_go{9.81 * mass}};
  REQUIRE(make_ready(device));
  const experiments::spring_wall springs({2e4, 2e4});
  sim::update_schedule schedule(3);
  sim::one_update_late<double> late(0.0);
  double now = 0.0;
  return run(model, device, 0.099, d3::vector(0, 0, 1), 1e4, 6000, [&](int n, double force) {
    if (yields && schedule.due(n * 1e-3)) now = late(-springs.surface(force));
    return now;
  });
}

/// A hand of 5 N against a surface that jumps by up to 1 mm; worst of several hands.
outcome tapped(auto model, double mass, double b, int seeds) {
  outcome worst;
  for (int seed = 1; seed <= seeds; ++seed) {
    mock_parameters mock{.runs = true, .homed = true};
    mock.body.mass = mass;
    mock.body.damping = b;
    mock.body.start = {0.003, -0.004, 0.122};
    random_source random(static_cast<std::uint64_t>(seed));
    const d3::vector normal = (d3::vector(0, 0, 1) + 0.7 * random.direction<d3>()).normalized();
    const double K = random.uniform(1e3, 2e4);
    const restless_hand hand{.tap = {{0, 0, 0.12}, normal, 5.0},
                             .seed = static_cast<std::uint64_t>(seed),
                             .part = seed % 3 == 0 ? 1.0 : 0.6};
    falcon_device<restless_hand> device{3500.0, eager(), mock, hand};
    REQUIRE(make_ready(device));
    double offset = 0.0;
    const outcome seen = run(model, device, 0.12, normal, K, 2000, [&](int n, double /*force*/) {
      if (seed % 2 == 0 && n % 40 == 0) offset = random.uniform(-1e-3, 1e-3);
      return offset;
    });
    worst.least = std::min(worst.least, seen.least);
    worst.deepest = std::max(worst.deepest, seen.deepest);
    worst.force = std::max(worst.force, seen.force);
    worst.valid = worst.valid && seen.valid;
  }
  return worst;
}

void print(const char* scene, const char* name, const outcome& o) {
  std::printf("%-22s %-38s %10.2e %8.2f %8.3f %8.2f\n", scene, name, o.least, o.deepest * 1e3,
              o.swing * 1e3, o.force);
}
void print_heading() {
  std::printf("%-22s %-38s %10s %8s %8s %8s\n", "scene", "controller", "least E/J", "deep/mm",
              "swing/mm", "most/N");
}

}  // namespace

TEST_CASE("the wall experiment through the mock Falcon loses nothing", "[falcon][wall]") {
  print_heading();
  for (const double b : {0.03, 0.3}) {
    for (const double friction : {0.0, 0.2}) {
      for (const bool yields : {false, true}) {
        if (yields && friction > 0.0) continue;
        const double m = 0.1;
        const double other = 9.81 * m + friction;
        char scene[64];
        std::snprintf(scene, sizeof scene, "%s b=%.2f fc=%.1f", yields ? "S1" : "S0", b, friction);
        const auto judge = [&](const char* name, const auto& model) {
          const outcome seen = drop(model, m, b, friction, yields);
          print(scene, name, seen);
          CHECK(seen.valid);
          return seen;
        };
        const ph::spring spring;
        const ph::strict_bound strict;
        const ph::reachable_bound reachable{.mass = m, .hand_force = other};
        CHECK(judge("none", composed(spring, plain(b), ph::no_bound{}, told)).least < -1e-3);
        CHECK(judge("strict", composed(spring, sure(b), strict, told)).least >= -1e-12);
        CHECK(judge("reachable", composed(spring, sure(b), reachable, told)).least >= -1e-12);
        CHECK(judge("reachable, not told", composed(spring, sure(b), reachable, untold)).least <
              -1e-4);
        const auto best = judge("recommended", recommended(b, m, reachable, told));
        CHECK(best.least >= -1e-12);
        CHECK(best.deepest < 0.012);
        CHECK(best.swing < 5e-4);
      }
    }
  }
}

TEST_CASE("hands on the mock Falcon get nothing out of a loop told its latency, something without",
          "[falcon][wall][law]") {
  print_heading();
  double strict_untold = 0.0, recommended_untold = 0.0;
  for (const double b : {0.03, 0.3}) {
    const double m = 0.1;
    char scene[64];
    std::snprintf(scene, sizeof scene, "hands b=%.2f", b);
    const auto judge = [&](const char* name, const auto& model, int seeds = 20) {
      const outcome seen = tapped(model, m, b, seeds);
      print(scene, name, seen);
      CHECK(seen.valid);
      return seen.least;
    };
    const ph::spring spring;
    const ph::strict_bound strict;
    const ph::reachable_bound reachable{.mass = m, .hand_force = 5.0};
    CHECK(judge("none", composed(spring, plain(b), ph::no_bound{}, told), 6) < -0.1);
    CHECK(judge("strict", composed(spring, sure(b), strict, told)) >= -1e-12);
    CHECK(judge("reachable", composed(spring, sure(b), reachable, told)) >= -1e-12);
    CHECK(judge("recommended", recommended(b, m, reachable, told), 30) >= -1e-12);

    CHECK(judge("strict, not told, plain", composed(spring, plain(b), strict, untold)) < -1e-4);
    CHECK(judge("reachable, not told", composed(spring, sure(b), reachable, untold)) < -1e-4);
    strict_untold = std::min(strict_untold,
                             judge("strict, not told", composed(spring, sure(b), strict, untold)));
    recommended_untold =
        std::min(recommended_untold,
                 judge("recommended, not told", recommended(b, m, reachable, untold), 30));
  }
  CHECK(strict_untold < -1e-5);
  CHECK(recommended_untold < -1e-5);
}
