// SPDX-License-Identifier: BSD-3-Clause
// A known mass weighed by the motors: the gain is within what is stated, of axes and of motors behind a linkage, and
// what spoils a weighing is refused with a sentence.
#include "../bench/identify/hung.hpp"
#include "support/catch.hpp"
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/identification.hpp>
#include <passive_haptics/simulation/friction.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace identification = ph::identification;
using identification::gains_found;
using identification::weigh_in;
using identification::weigh_in_parameters;
using identification::weighed_pose;
using d1 = ph::space<double, 1>;
using d2 = ph::space<double, 2>;
using d3 = ph::space<double, 3>;
using namespace std::chrono_literals;
constexpr double g0 = 9.80665;

namespace {

/// A user who holds the device at its pose until it pulls, and hangs the mass, or takes it off, within 1.5 s: that is
/// prepare(pose, stage).
auto user(auto prepare) {
  return [prepare, asked = 0, waited = 0](const char* /*sentence*/) mutable {
    if (waited == 0) prepare(static_cast<std::size_t>(asked / 3), asked % 3);
    if (++waited < (asked % 3 == 0 ? 2 : 1500)) return false;
    waited = 0;
    ++asked;
    return true;
  };
}
constexpr auto go_on = [] { return false; };

/// A device drawn at random, and a mass of 0.1 to 0.2 kg that is known to half a percent.
template <class Space>
struct drawn {
  static constexpr auto dof = static_cast<std::size_t>(Space::dof);
  sim::device_parameters<Space> truth{};
  sim::stribeck_friction rubs{};
  std::array<double, dof> gains{};
  double mass = 0.0, weight = 0.0, moves = 0.0, cogging = 0.0, wavelength = 0.0;

  explicit drawn(std::uint64_t seed) {
    sim::random_source random(seed);
    const auto evenly_by_logarithm = [&](double least, double most) {
      return least * std::pow(most / least, random.uniform());
    };
    truth.mass = evenly_by_logarithm(0.03, 1.0);
    truth.damping = evenly_by_logarithm(0.01, 5.0);
    truth.quantum = evenly_by_logarithm(1e-6, 100e-6);
    truth.latency = static_cast<int>(random.uniform(0.0, 4.0));
    truth.substeps = 1;
    for (std::size_t i = 0; i < dof; ++i) {
      gains[i] = random.uniform(0.8, 1.2);
      sim::component(truth.gain, static_cast<int>(i)) = gains[i];
      sim::component(truth.load, static_cast<int>(i)) = random.uniform(0.0, 0.5);
    }
    const double c = random.uniform(0.001, 0.5);
    rubs = {c,
            c * random.uniform(1.0, 1.5),
            random.uniform(2e-3, 10e-3),
            random.uniform(4e-6, 50e-6),
            0.0,
            0.0,
            0.0};
    mass = random.uniform(0.1, 0.2);
    weight = mass * g0 * random.uniform(0.995, 1.005);
    moves = truth.mass * random.uniform(0.7, 1.3);
    cogging = random.uniform(0.0, 0.03);
    wavelength = evenly_by_logarithm(0.3e-3, 5e-3);
  }
  /// Weighed along one axis after the other, told `said` times the mass.
  [[nodiscard]] gains_found<Space::dof> weighed(double said = 1.0) const {
    identify::hung_device<Space, sim::stribeck_friction> device(truth, rubs);
    std::vector<weighed_pose<Space::dof>> poses(dof);
    for (std::size_t k = 0; k < dof; ++k) poses[k].pulls[k] = k % 2 == 0 ? -1.0 : 1.0;
    const auto prepare = [&](std::size_t pose, int stage) {
      identify::pull<Space> pulls{.cogging = cogging, .wavelength = wavelength};
      if (stage == 1) pulls.weight[pose] = weight * poses[pose].pulls[pose];
      device.hang(stage == 1 ? mass : 0.0, pulls);
    };
    const weigh_in_parameters p{.mass = said * mass, .force = 4.0, .moves = moves};
    return identification::weigh<Space>(device, weigh_in<Space::dof>(p, poses), user(prepare),
                                        go_on);
  }
  [[nodiscard]] bool within(const gains_found<Space::dof>& found) const {
    bool all = found.problem == nullptr;
    for (std::size_t i = 0; i < dof; ++i) {
      all = all && found.least[i] <= gains[i] && gains[i] <= found.most[i];
    }
    return all;
  }
};

struct tally {
  int drawn = 0, stated = 0, within = 0, wide = 0;
  std::vector<double> errors{}, tolerances{};

  template <class Space>
  void add(std::uint64_t seed, double said = 1.0) {
    const ::drawn<Space> d(seed);
    const auto found = d.weighed(said);
    CAPTURE(seed, found.problem);
    ++this->drawn;
    stated += found.problem == nullptr ? 1 : 0;
    within += d.within(found) ? 1 : 0;
    wide += found.tolerance(true) > 0.025 ? 1 : 0;
    tolerances.push_back(found.tolerance(true));
    for (std::size_t i = 0; i < d.dof; ++i) {
      errors.push_back(std::abs(found.likely[i] / d.gains[i] - 1.0));
    }
  }
};

}  // namespace

TEST_CASE("a gain is within what a weighed mass states, on devices drawn at random",
          "[identification][weigh_in][long]") {
  tally all;
  for (std::uint64_t seed = 1; seed <= 190; ++seed) all.add<d1>(seed);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) all.add<d3>(1000 + seed);
  std::sort(all.errors.begin(), all.errors.end());
  std::sort(all.tolerances.begin(), all.tolerances.end());
  INFO("error " << all.errors[all.errors.size() / 2] << " in the median, at most "
                << all.errors.back() << "; tolerance left "
                << all.tolerances[all.tolerances.size() / 2] << ", at most "
                << all.tolerances.back());
  CHECK(all.drawn == 202);
  CHECK(all.stated >= 200);
  CHECK(all.within >= 200);
  CHECK(all.wide <= 2);
  // The control: a mass that is a tenth heavier or lighter than told.
  tally wrong;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    wrong.add<d1>(seed, 1.1);
    wrong.add<d1>(seed, 0.9);
  }
  CHECK(wrong.within == 0);
}

namespace {

/// A steady device, and what its user does at each stage.
const sim::device_parameters<d1> grip{.mass = 0.1,
                                      .damping = 0.3,
                                      .quantum = 10e-6,
                                      .load = 0.2,
                                      .gain = 0.9,
                                      .substeps = 2,
                                      .latency = 1};
const sim::slider_and_spring rubs{.level = {0.2}, .presliding = {15e-6}};
using rubbing = identify::hung_device<d1, sim::slider_and_spring>;

struct outcome {
  gains_found<1> found{};
  double largest = 0.0, last = 0.0,
         asking = 0.0;  ///< of the forces, and that after the end [N]

  [[nodiscard]] bool says(const std::string& words) const {
    return found.problem != nullptr && std::string(found.problem).find(words) != std::string::npos;
  }
};

/// at(stage) is what pulls at it; spoil(tick, position) may change what the scale is shown.
outcome weighed(const weigh_in_parameters& p, auto at, auto spoil, double pulls = -1.0,
                const sim::slider_and_spring& friction = rubs) {
  rubbing device(grip, friction);
  weigh_in<1> scale(p, {{.pulls = {pulls}}});
  auto ready =
      user([&](std::size_t, int stage) { device.hang(stage == 1 ? 0.15 : 0.0, at(stage)); });
  outcome out;
  double force = 0.0;
  for (int n = 0; !scale.done() && n < 200000; ++n) {
    double x = device.exchange(force).position;
    spoil(n, x);
    if (scale.asks() != nullptr && ready(scale.asks())) scale.confirm();
    force = scale.tick({x}, 1ms)[0];
    out.largest = std::max(out.largest, std::abs(force));
  }
  out.last = std::abs(force) + std::abs(scale.tick({0.0}, 1ms)[0]);
  out.found = scale.result();
  return out;
}
constexpr auto as_it_is = [](int, double&) {};
identify::pull<d1> the_mass(int stage) {
  return stage == 1 ? identify::pull<d1>{.weight = {-0.15 * g0}} : identify::pull<d1>{};
}
constexpr weigh_in_parameters hung{.mass = 0.15};

}  // namespace

TEST_CASE("a scale keeps to its largest force, waits without force for a pose, and ends with none",
          "[identification][weigh_in]") {
  const auto out = weighed(hung, the_mass, as_it_is);
  REQUIRE(out.found.problem == nullptr);
  CHECK(out.found.least[0] <= 0.9);
  CHECK(out.found.most[0] >= 0.9);
  CHECK(out.found.tolerance(true) < 0.015);
  CHECK(out.found.tolerance(false) > 0.1);
  CHECK(out.found.tolerance(false) < 0.115);
  CHECK(out.found.least_mass < 0.15);
  CHECK(out.largest <= 3.0);
  CHECK(out.largest > 1.0);
  weigh_in<1> scale(hung, {{.pulls = {1.0}}});
  for (int n = 0; n < 100; ++n) CHECK(scale.tick({1e-3 * n}, 1ms)[0] == 0.0);
  scale.confirm();
  CHECK(scale.asks() == nullptr);
  CHECK(scale.tick({0.1}, 1ms)[0] != 0.0);
  CHECK(out.last == 0.0);
}

TEST_CASE("what spoils a weighing is refused by name", "[identification][weigh_in]") {
  const auto light = weighed(
      {.mass = 0.005}, [](int) { return identify::pull<d1>{}; }, as_it_is);
  CHECK(light.says("too light for the friction"));
  CHECK(light.found.least_mass > 0.005);
  CHECK(light.found.least_mass < 0.1);
  CHECK(weighed(
            hung, [](int) { return the_mass(0); }, as_it_is)
            .says("was not hung"));
  CHECK(weighed(hung, the_mass, as_it_is, 1.0).says("does not pull where stated"));
  CHECK(weighed(
            hung, [](int s) { return the_mass(s > 0 ? 1 : 0); }, as_it_is)
            .says("take the mass off"));
  const auto drifts = [](int s) {
    auto pulls = the_mass(s);
    pulls.weight[0] += 0.1 * s;
    return pulls;
  };
  CHECK(weighed(hung, drifts, as_it_is).says("is not as it was"));
  CHECK(weighed({.mass = 0.04}, the_mass, as_it_is).says("three times as much"));
  auto stiff = rubs;
  stiff.level = {4.0};
  CHECK(weighed(hung, the_mass, as_it_is, -1.0, stiff).says("the largest force does not move it"));
  CHECK(weighed({.mass = 0.15, .force = 1.2}, the_mass, as_it_is).says("hang less"));
  for (const double grips : {30.0, 60.0, 150.0, 300.0, 800.0}) {
    CAPTURE(grips);
    const auto held = [grips](bool always) {
      return [grips, always](int s) {
        auto pulls = the_mass(s);
        if (always || s == 1) pulls.grip = grips;
        return pulls;
      };
    };
    CHECK(weighed(hung, held(true), as_it_is).found.problem != nullptr);
    const auto loaded = weighed(hung, held(false), as_it_is);
    CHECK((loaded.says("let go") || loaded.says("the largest force")));
    CHECK(loaded.last == 0.0);
  }
  const auto shakes = [](int s) {
    auto pulls = the_mass(s);
    pulls.push = 0.4;
    return pulls;
  };
  CHECK(weighed(hung, shakes, as_it_is).says("varies from cycle to cycle"));
}

TEST_CASE("samples that are no numbers give no force: few are borne, many end a weighing",
          "[identification][weigh_in]") {
  const auto few = weighed(hung, the_mass, [](int n, double& x) {
    if (n % 9973 == 0) x = std::numeric_limits<double>::quiet_NaN();
  });
  REQUIRE(few.found.problem == nullptr);
  CHECK(few.found.least[0] <= 0.9);
  CHECK(few.found.most[0] >= 0.9);
  const auto many = weighed(hung, the_mass, [](int n, double& x) {
    if (n % 3 == 0) x = std::numeric_limits<double>::infinity();
  });
  CHECK(many.says("too few good samples"));
  CHECK(many.last == 0.0);
  weigh_in<1> scale(hung, {{.pulls = {1.0}}});
  CHECK(std::string(scale.result().problem).find("not at its end") != std::string::npos);
  CHECK(scale.tick({0.0}, ph::seconds{-1e-3})[0] == 0.0);
  scale.stop();
  CHECK(scale.done());
  CHECK(std::string(scale.result().problem).find("stopped") != std::string::npos);
  CHECK_FALSE(hung.check());
  for (const weigh_in_parameters& wrong :
       std::initializer_list<weigh_in_parameters>{{},
                                                  {.mass = 0.1, .mass_tolerance = 0.5},
                                                  {.mass = 0.1, .force = 0.0},
                                                  {.mass = 0.1, .moves = 0.0},
                                                  {.mass = 0.1, .way = -1.0},
                                                  {.mass = 0.1, .precision = 0.0}}) {
    CHECK(wrong.check());
    weigh_in<1> refused(wrong, {{.pulls = {1.0}}});
    CHECK(refused.done());
    CHECK(refused.tick({0.0}, 1ms)[0] == 0.0);
    CHECK(refused.result().problem != nullptr);
  }
  CHECK(weigh_in<1>(hung, {}).done());
  CHECK(weigh_in<1>(hung, {{}}).done());
}

namespace {

/// An arm of two joints: motors of gains γ make the force J⁻ᵀ Γ Jᵀ f of a force f that is commanded.
struct arm {
  identify::hung_device<d2, sim::slider_and_spring> inner;
  std::array<double, 2> gains{};
  std::array<std::array<double, 2>, 2> rows{{{1.0, 0.0}, {0.0, 1.0}}};  // Jᵀ

  ph::device_sample<d2> exchange(const d2::vector& f) noexcept {
    const double t0 = gains[0] * (rows[0][0] * f[0] + rows[0][1] * f[1]);
    const double t1 = gains[1] * (rows[1][0] * f[0] + rows[1][1] * f[1]);
    const double det = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    auto sample = inner.exchange(
        {(rows[1][1] * t0 - rows[0][1] * t1) / det, (rows[0][0] * t1 - rows[1][0] * t0) / det});
    sample.held = f;
    return sample;
  }
};
/// Jᵀ of two links of 0.2 m, the second at the angle b to the first, which is at a to the horizontal.
std::array<std::array<double, 2>, 2> turned(double a, double b) {
  const double l = 0.2;
  return {{{-l * std::sin(a) - l * std::sin(a + b), l * std::cos(a) + l * std::cos(a + b)},
           {-l * std::sin(a + b), l * std::cos(a + b)}}};
}

gains_found<2> weighed_at_three_poses(double first, double second, bool told) {
  arm device{.inner = identify::hung_device<d2, sim::slider_and_spring>(
                 {.mass = 0.2, .damping = 0.3, .quantum = 20e-6, .substeps = 2},
                 {.level = {0.15}, .presliding = {15e-6}}),
             .gains = {first, second}};
  const std::array angles{std::array{0.3, 1.2}, std::array{0.9, 1.0}, std::array{-0.2, 1.6}};
  std::vector<weighed_pose<2>> poses;
  for (const auto& a : angles) {
    poses.push_back({.pulls = {0.0, -1.0}});
    if (told) poses.back().rows = turned(a[0], a[1]);
  }
  const auto prepare = [&](std::size_t pose, int stage) {
    device.rows = turned(angles[pose][0], angles[pose][1]);
    identify::pull<d2> pulls;
    if (stage == 1) pulls.weight = {0.0, -0.2 * g0};
    device.inner.hang(stage == 1 ? 0.2 : 0.0, pulls);
  };
  return identification::weigh<d2>(
      device, weigh_in<2>({.mass = 0.2, .force = 4.0, .moves = 0.2}, poses), user(prepare), go_on);
}

}  // namespace

TEST_CASE("motors behind a linkage are weighed at three poses, told its Jacobian",
          "[identification][weigh_in]") {
  sim::random_source random(7);
  for (int i = 0; i < 12; ++i) {
    const double first = random.uniform(0.85, 1.15), second = random.uniform(0.85, 1.15);
    const auto found = weighed_at_three_poses(first, second, true);
    CAPTURE(i, first, second, found.problem, found.likely, found.least_mass);
    REQUIRE(found.problem == nullptr);
    CHECK(found.least[0] <= first);
    CHECK(found.most[0] >= first);
    CHECK(found.least[1] <= second);
    CHECK(found.most[1] >= second);
    CHECK(found.tolerance(true) < 0.05);
  }
  const auto untold = weighed_at_three_poses(0.85, 1.15, false);  // the control
  CHECK(untold.problem != nullptr);
}

TEST_CASE("a joint is weighed by a mass on its arm", "[identification][weigh_in]") {
  const double arm_length = 0.15, mass = 0.1;  // [m], [kg]
  identify::hung_device<d1, sim::slider_and_spring> joint(
      {.mass = 2e-3, .damping = 2e-3, .quantum = 4e-4, .load = 0.01, .gain = 1.1, .substeps = 2},
      {.level = {0.02}, .presliding = {1e-4}});
  const auto prepare = [&](std::size_t, int stage) {
    const double hangs = stage == 1 ? mass : 0.0;
    joint.hang(hangs * arm_length * arm_length, {.weight = {hangs * g0 * arm_length}});
  };
  const auto found = identification::weigh<d1>(
      joint,
      weigh_in<1>({.mass = mass, .force = 0.5, .moves = 2e-3, .way = 0.05},
                  {{.pulls = {arm_length}}}),
      user(prepare), go_on);
  INFO(identification::table_of(found));
  REQUIRE(found.problem == nullptr);
  CHECK(found.least[0] <= 1.1);
  CHECK(found.most[0] >= 1.1);
  CHECK(found.tolerance(true) < 0.02);
  CHECK(identification::table_of(found).find("1.1") != std::string::npos);
}
