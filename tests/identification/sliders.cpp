// SPDX-License-Identifier: BSD-3-Clause
// dual_ledger with several sliders: it never says more than what has flowed in, and what a tremor loses within the mean
// presliding it credits, which one slider does not.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/identification/sliders.hpp>
#include <passive_haptics/laws.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <array>
#include <cmath>
#include <string>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int N = 3;
using sliders = ph::damping_and_sliders<N>;
using ledger = ph::basic_dual_ledger<sliders>;

struct truth {
  double b = 0.05;
  std::array<double, N> c{0.05, 0.06, 0.04};
  std::array<double, N> p{4e-6, 15e-6, 60e-6};
  double q = 5e-6;

  [[nodiscard]] sliders told(double more_c = 1.0, double more_p = 1.0) const {
    sliders s{.coefficient = b};
    for (std::size_t k = 0; k < N; ++k) s.sliders[k] = {c[k] * more_c, p[k] * more_p};
    return s;
  }
  [[nodiscard]] double reserve() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < N; ++k) sum += 2.5 * c[k] * p[k];
    return sum;
  }
};

/// A device on a line whose energy is known, and what a ledger says of it.
template <class Space>
class watched_line {
 public:
  using scalar = typename Space::scalar;
  watched_line(const truth& t, const ledger& told) : truth_(t), friction_{t.c, t.p}, ledger_(told) {
    told_reserve_ = -static_cast<double>(ledger_.value());
  }
  void tick(double way, double force) {
    const double dt = 1e-3;
    const auto held = static_cast<scalar>(force);
    const double before = shown();
    E_ += truth_.b * way * way / dt - static_cast<double>(held) * way +
          friction_.slide(state_, x_, way, dt).work;
    x_ += way;
    REQUIRE(ledger_.update(static_cast<scalar>(shown() - before), held, static_cast<scalar>(dt)));
  }
  /// What has flowed in, springs included, beyond what the ledger says [J].
  [[nodiscard]] double spare() const {
    return E_ - static_cast<double>(ledger_.value()) - told_reserve_;
  }
  [[nodiscard]] double value() const { return static_cast<double>(ledger_.value()); }
  [[nodiscard]] double energy() const { return E_; }

 private:
  [[nodiscard]] double shown() const {
    return truth_.q > 0.0 ? truth_.q * std::floor((x_ + 0.31 * truth_.q) / truth_.q) : x_;
  }
  truth truth_;
  sim::maxwell_slip<N> friction_;
  typename sim::maxwell_slip<N>::state state_{};
  ph::part_at<ledger, Space> ledger_;
  double x_ = 0.0, E_ = 0.0, told_reserve_ = 0.0;
};

/// The least spare of so many random runs: pushes to and fro, forces that follow, hunt or jump [J].
template <class Space>
double worst_of(const truth& t, const sliders& told, int runs) {
  double least = 1.0;
  for (int run = 0; run < runs; ++run) {
    sim::random_source random(static_cast<std::uint64_t>(run) + 1);
    watched_line<Space> line(t, {.damping = told, .quantum = t.q});
    const double size = std::pow(10.0, random.uniform(-6.5, -4.0));
    double force = 0.0, way = size;
    for (int n = 0; n < 80; ++n) {
      if (random.chance(0.4)) way = -way;
      const double moved = random.chance(0.5) ? way : way * random.uniform(0.0, 1.0);
      if (random.chance(0.5)) force = random.uniform(-0.3, 0.3);
      if (random.chance(0.2)) force = moved > 0.0 ? 0.2 : -0.2;
      line.tick(moved, force);
      least = std::min(least, line.spare());
    }
  }
  return least;
}

}  // namespace

TEST_CASE("dual_ledger with several sliders obeys the laws of ledgers", "[ledger][sliders]") {
  const ledger told{.damping = truth{}.told(), .quantum = 5e-6};
  const auto verdict = ph::laws::all<ledger, d1>(told);
  CHECK(std::string(verdict ? "" : verdict.broken) == "");
  const auto in_space = ph::laws::all<ledger, f3>(told);
  CHECK(std::string(in_space ? "" : in_space.broken).empty());
}

TEMPLATE_TEST_CASE("dual_ledger with several sliders never says more than has flowed in",
                   "[ledger][sliders]", d1, f1) {
  const truth t;
  const double rounded = sizeof(typename TestType::scalar) == 4 ? 1e-9 : 1e-15;
  CHECK(worst_of<TestType>(t, t.told(), 3000) >= -rounded);
  truth fine = t;
  fine.q = 0.0;
  CHECK(worst_of<TestType>(fine, fine.told(), 1000) >= -rounded);
  // The controls: more friction, or stiffer sliders, than there are.
  CHECK(worst_of<TestType>(t, t.told(1.3, 1.0), 3000) < -1e-7);
  truth soft = t;
  for (double& p : soft.p) p *= 4.0;
  CHECK(worst_of<TestType>(soft, t.told(), 3000) < -1e-7);
}

TEST_CASE("a tremor within the mean presliding is paid for by the stiff sliders of a list",
          "[ledger][sliders]") {
  const truth t{.q = 1e-6};
  double give = 0.0, c = 0.0;
  for (std::size_t k = 0; k < N; ++k) {
    give += t.c[k] * t.p[k];
    c += t.c[k];
  }
  sliders one{.coefficient = t.b};
  one.sliders = {{{c, give / c}, {0.0, give / c}, {0.0, give / c}}};
  const auto earned = [&t](const sliders& told, double& lost) {
    watched_line<d1> line(t, {.damping = told, .quantum = t.q});
    double before = 0.0;
    for (int n = 0; n < 20000; ++n) {
      const double at = 15e-6 * std::sin(2.0 * 3.141592653589793 * 8.7 * n * 1e-3);
      line.tick(at - before, 0.1);
      before = at;
    }
    lost = line.energy();
    return line.value();
  };
  double lost = 0.0;
  const double by_list = earned(t.told(), lost), by_one = earned(one, lost);
  CAPTURE(lost, by_list, by_one);
  CHECK(by_list > 0.3 * lost);
  CHECK(by_list <= lost);
  CHECK(by_one < 0.1 * lost);
}

TEST_CASE("damping_and_sliders names what it refuses", "[damping][sliders]") {
  const auto refused = [](const sliders& s) {
    const auto fault = s.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(truth{}.told()).empty());
  CHECK(refused({.coefficient = 0.0}) == "damping");
  CHECK(refused({.coefficient = 0.1}) == "presliding");  // not stated
  CHECK(refused({.coefficient = 0.1, .sliders = {{{-0.1, 1e-6}, {0.1, 2e-6}, {0.1, 3e-6}}}}) ==
        "friction");
}
