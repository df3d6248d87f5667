// SPDX-License-Identifier: BSD-3-Clause
// modelled_reach: its travel against the formula of one mass and against a simulated chain, hands on devices at the corners
// of what was stated, and controls that are told something else.
#include "support/catch.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>

#include <random>

using Catch::Matchers::WithinRel;
namespace ph = passive_haptics;
namespace sim = ph::simulation;
using d1 = ph::space<double, 1>;
using d3 = ph::space<double, 3>;
using f1 = ph::space<float, 1>;

namespace {

constexpr double T = 1e-3;

/// A hand that switches between two forces along the last axis, and pumps where it is told to.
template <class Space>
struct switching_hand {
  using vector = typename Space::vector;
  double bias = -2.0, amplitude = 3.0, frequency = 5.0;
  bool pumps = false;

  [[nodiscard]] vector force(double t, const vector& /*x*/, const vector& v) const noexcept {
    vector f = Space::zero();
    auto& along = Space::component(f, Space::dof - 1);
    along = bias + (std::sin(6.283 * frequency * t) > 0.0 ? amplitude : -amplitude);
    if (pumps) along = Space::component(v, Space::dof - 1) > 0.0 ? 5.0 : -5.0;
    return f;
  }
  [[nodiscard]] static double mass() noexcept { return 0.0; }
  [[nodiscard]] static ph::parameter_fault check() noexcept { return {}; }
};

template <int N, class Space>
ph::chain<N> chain_of(const sim::compliant_parameters<Space>& p) {
  ph::chain<N> c;
  c.damping = p.damping;
  for (int i = 0; i < N; ++i) {
    const auto at = static_cast<std::size_t>(i);
    c.masses[at] = p.mass_of(i);
    if (i + 1 == N) break;
    c.springs[at] = p.spring_of(i);
    c.losses[at] = p.loss_of(i);
  }
  return c;
}

/// The least energy [J] of some hands on one device; `change` alters what the bound is told.
template <class Port, int N, int Late = 0>
double least(unsigned seed, const auto& change) {
  using physics = ph::space<double, Port::dof>;
  std::mt19937 from(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto log = [&](double a, double b) { return a * std::pow(b / a, unit(from)); };
  sim::compliant_parameters<Port> p;
  p.mass = log(0.03, 0.3);
  p.share = 0.05 + 0.85 * unit(from);
  p.mode = log(15.0, 400.0);
  p.loss = log(0.005, 0.1);
  p.damping = log(0.05, 1.0);
  p.masses = N;
  p.inner_mode = log(30.0, 400.0);
  p.substeps = 40;
  p.latency = Late;
  sim::component(p.start, Port::dof - 1) = 0.002;
  const double K = log(500.0, 20000.0);
  ph::modelled_reach<N, Late> told{.device = chain_of<N>(p), .hand_force = 5.0, .tick = T};
  const auto corner = [&](double x, double off) { return from() % 2 == 0 ? x * off : x / off; };
  for (auto& m : told.device.masses) m = corner(m, 1.03);
  for (auto& k : told.device.springs) k = corner(k, 1.03);
  for (auto& d : told.device.losses) d = corner(d, 1.3);
  told.device.damping = corner(told.device.damping, 1.3);
  change(told, p);
  double worst = 0.0;
  for (int h = 0; h < 8; ++h) {
    switching_hand<physics> hand;
    hand.bias = -4.0 * unit(from);
    hand.amplitude = 5.0 + hand.bias;
    hand.frequency = log(2.0, 250.0);
    hand.pumps = h == 7;
    sim::compliant_device<Port, switching_hand<physics>> arm(p, hand);
    ph::local_model touch{
        Port{},
        ph::followed<ph::half_space<Port>>{},
        ph::turn_at_once{},
        ph::spring{},
        ph::reduced_energy{.damping = p.damping},
        told,
        ph::late_loop_limits<Late>{.longest_tick = T, .top_speed = 100.0, .workspace = 100.0}};
    typename Port::vector n = Port::zero();
    Port::component(n, Port::dof - 1) = 1;
    REQUIRE(touch.update({Port::zero(), n, static_cast<typename Port::scalar>(K)}));
    REQUIRE_FALSE(touch.check());
    typename Port::vector f = Port::zero();
    for (int i = 0; i < 1000; ++i) f = touch.tick(arm.exchange(f)).force;
    worst = std::min(worst, arm.minimum());
  }
  return worst;
}
template <class Port, int N, int Late = 0>
int lost(int devices, const auto& change, double tolerance = 1e-9) {
  int count = 0;
  for (int i = 0; i < devices; ++i) {
    count += least<Port, N, Late>(static_cast<unsigned>(i) + 1u, change) < -tolerance ? 1 : 0;
  }
  return count;
}
constexpr auto as_it_is = [](auto&, const auto&) {};

}  // namespace

TEST_CASE("a chain of one mass is reachable_bound's", "[compliant][modelled_reach]") {
  const ph::detail::chain_response<1> one({{0.1}, {}, {}, 0.0}, T);
  const auto law = one.law<2>(1, 4, 4);
  CHECK_THAT(law.travels[0], WithinRel(1.0, 1e-9));
  CHECK_THAT(law.forces[0], WithinRel(T * T / 0.2, 1e-9));
  CHECK_THAT(law.forces[1], WithinRel(T * T / 0.2, 1e-9));
  CHECK_THAT(law.hand, WithinRel(1.001 * T * T / 0.1, 1e-6));
  CHECK_THAT(law.noise, WithinRel(1.0, 1e-9));
}

TEST_CASE("the travel that a chain foretells is the one that it makes, but for the hand's part",
          "[compliant][modelled_reach]") {
  sim::compliant_parameters<d1> p;
  p.share = 0.3;
  p.mode = 90.0;
  p.substeps = 400;
  const ph::detail::chain_response<2> chain(chain_of<2>(p), T);
  const auto next = chain.law<1>(1, 4, 4);
  for (const double push : {0.0, 5.0}) {
    switching_hand<d1> hand;
    hand.bias = 0.0;
    hand.amplitude = push;
    hand.frequency = 37.0;
    sim::compliant_device<d1, switching_hand<d1>> arm(p, hand);
    std::mt19937 from(3);
    std::uniform_real_distribution<double> unit(-3.0, 3.0);
    std::vector<double> x{0.0}, f;
    double worst = 0.0;
    for (int n = 0; n < 300; ++n) {
      f.push_back(unit(from));
      x.push_back(arm.exchange(f.back()).position);
      if (n < 6) continue;
      const auto of = [&](int i) {
        return x[x.size() - 1 - std::size_t(i)] - x[x.size() - 2 - std::size_t(i)];
      };
      double s = next.forces[0] * f.back();
      for (int i = 0; i < 3; ++i) {
        s += next.travels[std::size_t(i)] * of(i + 1) +
             next.forces[std::size_t(i) + 1] * f[f.size() - 2 - std::size_t(i)];
      }
      worst = std::max(worst, std::abs(of(0) - s));
    }
    CHECK(worst <= push * next.hand + 2e-8);  // the leapfrog's own error
    if (push > 0.0) CHECK(worst > 0.3 * push * next.hand);
  }
}

TEST_CASE("modelled_reach loses nothing at the corners of what was stated",
          "[compliant][modelled_reach]") {
  CHECK(lost<d1, 2>(40, as_it_is) == 0);
  CHECK(lost<d1, 3>(15, as_it_is) == 0);
  CHECK(lost<d1, 4>(10, as_it_is) == 0);
  CHECK(lost<d1, 2, 1>(20, as_it_is) == 0);
  CHECK(lost<d1, 2, 2>(15, as_it_is) == 0);
  CHECK(lost<d3, 2>(12, as_it_is) == 0);
  CHECK(lost<f1, 2>(20, as_it_is, 1e-6) == 0);
}

TEST_CASE("controls: modelled_reach that is told another device, or a weaker hand, loses",
          "[compliant][modelled_reach]") {
  CHECK(lost<d1, 2>(40, [](auto& told, const auto&) { told.hand_force /= 2.0; }) > 0);
  CHECK(lost<d1, 2>(40, [](auto& told, const auto&) { told.device.masses[0] *= 1.5; }) > 0);
  CHECK(lost<d1, 2>(40, [](auto& told, const auto&) { told.device.springs[0] *= 1.5; }) > 0);
}

TEST_CASE("ticks of another length are bounded strictly", "[compliant][modelled_reach]") {
  const ph::modelled_reach<2> told{
      .device = ph::two_masses(0.1, 0.5, 100.0, 0.03, 0.1), .hand_force = 5.0, .tick = T};
  const auto port_of = [](const auto& bound) {
    return ph::passive_port{d1{}, ph::given_force{},
                            ph::reduced_energy{.damping = 0.1, .loan = 1e-6}, bound,
                            ph::loop_limits{.longest_tick = 2e-3}};
  };
  auto modelled = port_of(told), even = port_of(told);
  auto strict = port_of(ph::strict_bound{});
  double last = 0.0, of_strict = 0.0, of_even = 0.0;
  for (int n = 0; n < 12; ++n) {
    const double dt = n % 3 == 2 ? 1.1e-3 : 1e-3;
    last = modelled.tick(0.0, ph::seconds{dt}, 5.0).force;
    of_strict = strict.tick(0.0, ph::seconds{dt}, 5.0).force;
    of_even = even.tick(0.0, ph::seconds{1e-3}, 5.0).force;
  }
  CHECK_THAT(last, WithinRel(of_strict, 1e-9));
  CHECK(of_even > of_strict);
}

TEST_CASE("modelled_reach names what is wrong with its numbers", "[compliant][modelled_reach]") {
  ph::modelled_reach<2> p{.device = ph::two_masses(0.1, 0.5, 100.0, 0.03, 0.1), .hand_force = 5.0};
  CHECK_FALSE(p.check());
  p.tolerance = 0.5;
  CHECK(std::string(p.check().parameter) == "tolerance");
  p.tolerance = 0.03;
  p.device = ph::two_masses(0.1, 0.5, 4000.0, 0.03, 0.1);
  CHECK(std::string(p.check().parameter) == "springs");
  p.device = ph::two_masses(0.1, 1.5, 100.0, 0.03, 0.1);
  CHECK(std::string(p.check().parameter) == "masses");
}
