// SPDX-License-Identifier: BSD-3-Clause
// Ledgers for a force that changes between two samples: what they book against the true energy, the motion that meets it,
// and controls that are told another fraction or time constant.
#include "support/catch.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <random>

using Catch::Matchers::WithinRel;
namespace ph = passive_haptics;
using d1 = ph::space<double, 1>;
using d3 = ph::space<double, 3>;

namespace {

constexpr double T = 1e-3, b = 0.1;
constexpr ph::reduced_energy exact{.damping = b, .loan = 1e-6};

/// What v(t) = A + B φ(t) takes, by brute force, under the force f + (y − f) φ(t); φ is 1 for τT and then 0, or e^{−t/θ}.
struct true_port {
  double fraction = 0.0, theta = 0.0, y = 0.0, energy = 1e-6, least = 1e-6;

  double pass(double f, double A, double B, double dt = T) {
    const auto book = [&](double h, double decayed, double square) {
      const double off = y - f;  // ∫φ = decayed, ∫φ² = square
      energy += b * (A * A * h + 2.0 * A * B * decayed + B * B * square) -
                (f * A * h + (f * B + off * A) * decayed + off * B * square);
      least = std::min(least, energy);
      return A * h + B * decayed;
    };
    if (theta > 0.0) {
      const double e = std::exp(-dt / theta);
      const double moved = book(dt, theta * (1.0 - e), theta / 2.0 * (1.0 - e * e));
      y = f + (y - f) * e;
      return moved;
    }
    const double t = fraction * dt;
    const double moved = book(t, t, t) + book(dt - t, 0.0, 0.0);
    y = f;
    return moved;
  }
};

struct outcome {
  double least = 1e9, slack = 1e9;  ///< true energy; that less the ledger [J]
};
/// Random forces, as large as strict_bound lets them be, and motions round those that take most.
template <class Port>
outcome attacked(const auto& ledger, double fraction, double theta, int runs,
                 bool jitters = false) {
  using scalar = typename Port::scalar;
  outcome worst;
  for (int i = 0; i < runs; ++i) {
    std::mt19937 from(static_cast<unsigned>(i) + 1u);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> bell;
    ph::passive_port port{Port{}, ph::given_force{}, ledger, ph::strict_bound{},
                          ph::loop_limits{.longest_tick = T, .top_speed = 1e9, .workspace = 1e9}};
    REQUIRE_FALSE(port.check());
    true_port real{fraction, theta};
    double x = 0.0, dt = T;
    (void)port.tick(scalar(x), ph::seconds<scalar>{scalar(T)});
    const double bold = unit(from);
    for (int n = 0; n < 60; ++n) {
      const double wanted =
          (unit(from) < 0.5 ? -1.0 : 1.0) * (unit(from) < bold ? 1e3 : unit(from));
      const auto out = port.tick(scalar(x), ph::seconds<scalar>{scalar(dt)}, scalar(wanted));
      worst.slack = std::min(worst.slack, real.energy - out.energy);
      const double f = out.force, most = unit(from) < 0.6 ? 1.0 : 1.5 * bell(from);
      const double also = unit(from) < 0.6 ? 1.0 : 1.5 * bell(from);
      dt = jitters ? T * (0.5 + 0.5 * unit(from)) : T;
      x += real.pass(f, most * f / (2.0 * b), also * (real.y - f) / (2.0 * b), dt);
    }
    worst.least = std::min(worst.least, real.least);
  }
  return worst;
}

}  // namespace

TEST_CASE("a force that comes a fraction late, or within a band, draws nothing",
          "[compliant][late_force]") {
  for (const double t : {0.0, 0.15, 0.5, 0.95, 1.0}) {
    CAPTURE(t);
    for (const double wide : {0.0, 0.1, 1.0}) {
      const ph::split_tick told{exact, std::max(0.0, t - wide), std::min(1.0, t + wide), T};
      const auto out = attacked<d1>(told, t, 0.0, 300);
      CHECK(out.least >= -1e-15);
      CHECK(out.slack >= -1e-15);
      if (wide == 0.0) CHECK(out.least < 9e-7);  // the attack takes what there is
      CHECK(attacked<d1>(told, t, 0.0, 100, true).least >= -1e-15);
    }
  }
}

TEST_CASE("a force behind a low-pass draws nothing", "[compliant][late_force]") {
  for (const double lag : {1e-3, 0.1, 0.5, 1.6, 5.0}) {
    CAPTURE(lag);
    const ph::lagging_force told{exact, lag * T};
    const auto out = attacked<d1>(told, 0.0, lag * T, 300);
    CHECK(out.least >= -1e-15);
    CHECK(out.slack >= -1e-15);
    CHECK(attacked<d1>(told, 0.0, lag * T, 200, true).least >= -1e-15);
  }
}

TEST_CASE("controls: another fraction, or time constant, than there is",
          "[compliant][late_force]") {
  CHECK(attacked<d1>(exact, 0.15, 0.0, 300).least < -1e-6);
  CHECK(attacked<d1>(ph::split_tick{exact, 0.5, 0.5, T}, 0.2, 0.0, 300).slack < -1e-9);
  CHECK(attacked<d1>(exact, 0.0, 1.6e-3, 300).least < -1e-6);
  CHECK(attacked<d1>(ph::lagging_force{exact, 0.2e-3}, 0.0, 1.6e-3, 300).slack < -1e-9);
}

TEST_CASE("what split_tick books is met by the motion of the proof", "[compliant][late_force]") {
  // constant speeds, each its part's worst: E − E1 is zero
  ph::passive_port port{d1{}, ph::given_force{}, ph::split_tick{exact, 0.3, 0.3, T},
                        ph::strict_bound{}, ph::loop_limits{.longest_tick = T, .top_speed = 1e9}};
  true_port real{0.3};
  (void)port.tick(0.0, ph::seconds{T});
  const double f = port.tick(0.0, ph::seconds{T}, 1e-2).force;
  const double x = real.pass(f, f / (2.0 * b), -f / (2.0 * b));
  const auto out = port.tick(x, ph::seconds{T}, 0.0);
  const double reserved = 0.3 * T * f * f / (4.0 * b);
  CHECK(std::abs(real.energy - (out.energy + reserved)) < 1e-20 + 1e-12 * real.energy);
}

TEST_CASE("a lost sample is written off by these ledgers, too", "[compliant][late_force]") {
  const auto lose = [](auto port) {
    (void)port.tick(0.0, ph::seconds{T});
    (void)port.tick(0.0, ph::seconds{T}, 1e-2);
    const double before = port.energy();
    (void)port.tick(std::nan(""), ph::seconds{T}, 1e-2);
    CHECK(port.energy() <= before);
    const auto out = port.tick(0.0, ph::seconds{T}, 1e-2);
    CHECK(std::isfinite(out.force));
    CHECK(out.energy <= before);
  };
  const ph::loop_limits limits{.longest_tick = T};
  lose(ph::passive_port{d1{}, ph::given_force{}, ph::split_tick{exact, 0.3, 0.3, T},
                        ph::strict_bound{}, limits});
  lose(ph::passive_port{d1{}, ph::given_force{}, ph::lagging_force{exact, T}, ph::strict_bound{},
                        limits});
  lose(
      ph::passive_port{d1{}, ph::given_force{},
                       ph::between_samples<>{.ledger = {.damping = {b, 0.1, 1e-5}, .quantum = 1e-5},
                                             .fraction = 0.3,
                                             .fraction_above = 0.3,
                                             .acceleration = 100.0},
                       ph::strict_bound{}, ph::late_loop_limits<1>{.longest_tick = T}});
}

TEST_CASE("in three dimensions a component is what it is in one", "[compliant][late_force]") {
  const auto ticks = [](auto port, const auto& at, const auto& f) {
    (void)port.tick(at(0.0), ph::seconds{T});
    for (int n = 0; n < 20; ++n) (void)port.tick(at(1e-5 * n * n), ph::seconds{T}, f);
    return port.energy();
  };
  const ph::split_tick told{exact, 0.2, 0.6, T};
  const double one = ticks(
      ph::passive_port{d1{}, ph::given_force{}, told, ph::strict_bound{},
                       ph::loop_limits{.longest_tick = T}},
      [](double x) { return x; }, -0.01);
  const double three = ticks(
      ph::passive_port{d3{}, ph::given_force{}, told, ph::strict_bound{},
                       ph::loop_limits{.longest_tick = T}},
      [](double x) { return d3::vector(0.0, x, 0.0); }, d3::vector(0.0, -0.01, 0.0));
  CHECK_THAT(three, WithinRel(one, 1e-9));
}

TEST_CASE("late forces name what is wrong with their numbers", "[compliant][late_force]") {
  CHECK(std::string(ph::split_tick{exact, -0.1, 0.5, T}.check().parameter) == "fraction");
  CHECK(std::string(ph::split_tick{exact, 0.5, 0.4, T}.check().parameter) == "fraction_above");
  CHECK(std::string(ph::split_tick{exact, 0.5, 0.5, 0.0}.check().parameter) == "longest_tick");
  CHECK(std::string(ph::lagging_force{exact, -1.0}.check().parameter) == "time_constant");
  CHECK(std::string(ph::lagging_force{exact, 1.0}.check().parameter) == "time_constant");
  const ph::between_samples<> p{.ledger = {.damping = {b, 0.1, 1e-5}, .quantum = 1e-5},
                                .acceleration = -1.0};
  CHECK(std::string(p.check().parameter) == "acceleration");
}
