// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/simulation/device.hpp>

namespace sim = ph::simulation;
using Catch::Matchers::WithinRel;

namespace {

struct landing {
  double swing;   ///< [m] in the fifth second
  double energy;  ///< [J], the least at the port
};

// 0.1 kg under 1 N fall from 20 mm onto a wall of 10 kN/m, in a loop so many ticks late.
/// A damped_spring that nobody tells of the latency.
struct as_if_on_time : ph::damped_spring {
  template <class Space>
  struct on : ph::part_at<ph::damped_spring, Space> {
    using base = ph::part_at<ph::damped_spring, Space>;
    using scalar = typename Space::scalar;
    constexpr explicit on(const as_if_on_time& p) noexcept : base(p) {}
    constexpr void adopt(scalar K, scalar T) noexcept { base::adopt(K, T); }
  };
};

template <int Latency>
landing fall(const auto& law) {
  sim::device_parameters<d1> parameters{};
  parameters.mass = 0.1;
  parameters.damping = 0.03;
  parameters.load = -1.0;
  parameters.start = 0.02;
  parameters.latency = Latency;
  sim::device<d1> device(parameters);
  ph::local_model wall{d1{},
                       ph::fixed{ph::half_space<d1>{0.0, 1.0, 1e4}},
                       ph::turn_at_once{},
                       law,
                       ph::reduced_energy{.damping = 0.03},
                       ph::bound_chain{ph::reachable_bound{.mass = 0.1, .hand_force = 5.0},
                                       ph::actuator_limit{.most = 9.0}},
                       ph::late_loop_limits<Latency>{.longest_tick = 1e-3}};
  double least = 1.0;
  double most = -1.0;
  auto s = device.exchange(0.0);
  for (int tick = 0; tick < 5000; ++tick) {
    s = device.exchange(wall.tick(s.position, ph::seconds{s.dt}).force);
    if (tick < 4000) continue;
    least = std::min(least, device.position());
    most = std::max(most, device.position());
  }
  return {.swing = most - least, .energy = device.meter().minimum()};
}

}  // namespace

TEST_CASE("damped_spring keeps the static stiffness up to the cap of the sampled mass (§ 9)",
          "[contact]") {
  ph::damped_spring::on<d1> law({.mass = 0.1});
  law.adopt(5000.0, 1e-3);
  CHECK(law.stiffness() == 5000.0);
  law.adopt(1e9, 1e-3);
  CHECK_THAT(law.stiffness(), WithinRel(1e4, 1e-12));  // κ m/T² = 0.1·0.1/1e-6
  CHECK_THAT(law.damping(), WithinRel(50.0, 1e-12));   // β m/T = 0.5·0.1/1e-3 < 2√(Km)
  law.adopt(100.0, 1e-3);
  CHECK_THAT(law.damping(), WithinRel(2 * std::sqrt(100 * 0.1), 1e-12));
}

TEST_CASE("damped_spring damps only outward motion, so it never adds force", "[contact]") {
  ph::damped_spring::on<d1> law({.mass = 0.1});
  law.adopt(5000.0, 1e-3);
  const double still = law.force(1e-3, 0.0);
  CHECK(law.force(1e-3, -1.0) == still);
  CHECK(law.force(1e-3, 0.02) < still);
  CHECK(law.force(1e-3, 10.0) == 0.0);
  CHECK_THAT(law.depth(law.force(1e-3, 0.02), 0.02), WithinRel(1e-3, 1e-12));
}

TEST_CASE("damped_spring deeper than the motors can answer for is a secant to their limit",
          "[contact]") {
  ph::damped_spring::on<d1> law({.mass = 0.1, .force_limit = 9.0});
  law.adopt(1e4, 1e-3);
  const double edge = 9.0 / 1e4;
  CHECK_THAT(law.force(0.999 * edge, 0.0), WithinRel(9.0 * 0.999, 1e-12));
  for (const double depth : {1.001 * edge, 0.01, 0.1}) {
    CHECK(law.force(depth, 0.0) == 9.0);
    CHECK(law.force(depth, -3.0) == 9.0);
    const double damping = std::min(law.damping(), 2 * std::sqrt(9.0 * 0.1 / depth));
    CHECK_THAT(law.force(depth, 0.05), WithinRel(9.0 - damping * 0.05, 1e-12));
    CHECK(law.force(depth, 1e3) == 0.0);
  }
  CHECK(law.force(0.1, 0.05) > law.force(0.01, 0.05));  // it lets go more gently
}

TEST_CASE("a damped_spring settles and loses nothing, however late the loop is", "[contact]") {
  const ph::damped_spring law{.mass = 0.1, .force_limit = 9.0};
  for (const landing& l : {fall<0>(law), fall<1>(law), fall<2>(law), fall<3>(law), fall<8>(law)}) {
    CHECK(l.swing < 1e-6);
    CHECK(l.energy >= 0.0);
  }
  const landing deaf = fall<1>(as_if_on_time{law});  // the control: passive, and it bounces
  CHECK(deaf.swing > 1e-3);
  CHECK(deaf.energy >= 0.0);
}

TEST_CASE("parameters of damped_spring are refused with their name", "[contact]") {
  const auto refused = [](const ph::damped_spring& law) {
    const auto fault = law.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({.mass = 0.1}).empty());
  CHECK(refused({.mass = 0.1, .stiffness_fraction = 0.3, .damping_fraction = 1.0}).empty());
  CHECK(refused({.mass = 0.1, .stiffness_fraction = 1.0, .damping_fraction = 1.0}) ==
        "stiffness_fraction");  // rings for ever
  CHECK(refused({.mass = 0.1, .damping_ratio = 0.0, .damping_fraction = 0.0}).empty());
  CHECK(refused({.mass = 0.0}) == "mass");
  CHECK(refused({.mass = -1.0}) == "mass");
  CHECK(refused({.mass = std::nan("")}) == "mass");
  CHECK(refused({.mass = 0.1, .stiffness_fraction = 0.0}) == "stiffness_fraction");
  CHECK(refused({.mass = 0.1, .stiffness_fraction = 1.5}) == "stiffness_fraction");
  CHECK(refused({.mass = 0.1, .damping_ratio = -1.0}) == "damping_ratio");
  CHECK(refused({.mass = 0.1, .damping_fraction = 2.0}) == "damping_fraction");
  CHECK(refused({.mass = 0.1, .force_limit = 0.0}) == "force_limit");
  CHECK(refused({.mass = 0.1, .force_limit = std::nan("")}) == "force_limit");
}

TEST_CASE("no force has no depth, however fast the device leaves", "[contact]") {
  ph::damped_spring::on<d1> law({.mass = 0.1});
  law.adopt(5000.0, 1e-3);
  CHECK(law.depth(0.0, 1.0) == 0.0);
  CHECK(law.depth(-1.0, 1.0) == 0.0);
  CHECK(law.depth(1e-9, 1.0) > 1e-3);
  CHECK(law.force(0.0, -1.0) == 0.0);
}
