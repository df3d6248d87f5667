// SPDX-License-Identifier: BSD-3-Clause
// Where axes are damped unequally, bounds take the effort nearest to the desired one: never more than E1 covers, nearest
// by the conditions of Karush, Kuhn and Tucker and by a search, whatever the ratio of the dampings; in float, too.
#include "force_bound/upkeep.hpp"
#include "support/catch.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sim = ph::simulation;

namespace {

namespace k = ph::kernels;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double T = 1e-3;

template <class P>
using axes = ph::diagonal_damping<P::dof>;
template <class P>
using rubbing_axes = ph::diagonal_damping_and_friction<P::dof>;

/// A number whose logarithm is even over 10^±span.
double any_size(sim::random_source& random, double span) {
  return std::pow(10.0, random.uniform(-span, span));
}
template <class P>
axes<P> any_damping(sim::random_source& random, double span) {
  axes<P> d;
  for (auto& b : d.coefficients) b = 0.03 * any_size(random, span);
  return d;
}
template <class P>
typename P::effort any_effort(sim::random_source& random, double span) {
  typename P::effort f = P::zero();
  for (int i = 0; i < P::dof; ++i) {
    const double size = any_size(random, span);
    P::component(f, i) = static_cast<typename P::scalar>(random.chance(0.5) ? -size : size);
  }
  return f;
}

/// By how much the effort left misses f more than the nearest one does, over |f|. That one is found by bisection of λ in
/// wider numbers, from the conditions of Karush, Kuhn and Tucker: the miss is λ times the slope of the outflow.
template <class P>
long double beyond_nearest(const auto& damping, const typename P::effort& f,
                           const typename P::effort& left, double E) {
  const auto beyond = damping.beyond(f);
  const auto b = [&](int i) { return static_cast<long double>(damping.along_axis(i)); };
  const auto y = [&](int i) { return static_cast<long double>(P::component(beyond, i)); };
  const auto outflow = [&](long double lambda) {
    long double sum = 0;
    for (int i = 0; i < P::dof; ++i) {
      const long double part = y(i) * b(i) / (b(i) + lambda);
      sum += part * part / b(i);
    }
    return sum * static_cast<long double>(T) / 4;
  };
  long double low = 0, high = 1;
  while (outflow(high) > static_cast<long double>(E)) high *= 2;
  for (int i = 0; i < 300; ++i) {
    const long double middle = (low + high) / 2;
    (outflow(middle) > static_cast<long double>(E) ? low : high) = middle;
  }
  long double nearest = 0, found = 0, asked = 0;
  for (int i = 0; i < P::dof; ++i) {
    const long double off = y(i) * high / (b(i) + high);
    const long double now = static_cast<long double>(P::component(f, i)) -
                            static_cast<long double>(P::component(left, i));
    nearest += off * off;
    found += now * now;
    asked += y(i) * y(i);
  }
  return (std::sqrt(found) - std::sqrt(nearest)) / std::sqrt(asked);
}

template <class P>
constexpr double exactness = sizeof(typename P::scalar) == 4 ? 2e-4 : 3e-6;

}  // namespace

TEMPLATE_TEST_CASE("strict_bound takes the nearest effort that is covered, whatever the dampings",
                   "[bound][nearest]", d2, d3, f3) {
  using scalar = typename TestType::scalar;
  sim::random_source random(7);
  const auto bound = at<TestType>(ph::strict_bound{});
  double longer = 0.0;
  for (const double span : {0.0, 0.5, 2.0, sizeof(scalar) == 4 ? 3.0 : 6.0}) {
    for (int n = 0; n < 2000; ++n) {
      const auto damping = any_damping<TestType>(random, span);
      const auto device = at<TestType>(damping);
      const auto f = any_effort<TestType>(random, span);
      const double W = static_cast<double>(device.worst_outflow(f, scalar(T)));
      const double E = W * std::pow(10.0, random.uniform(-6.0, 0.5));
      const situation<TestType, axes<TestType>> now{.damping = device,
                                                    .energy = static_cast<scalar>(E)};
      const auto left = allowed(bound, f, now);
      CAPTURE(span, n);
      REQUIRE(device.worst_outflow(left, scalar(T)) <= static_cast<scalar>(E));
      for (int i = 0; i < TestType::dof; ++i) {
        const auto share = TestType::component(left, i) / TestType::component(f, i);
        REQUIRE(share >= scalar(0));
        REQUIRE(share <= scalar(1));
      }
      if (static_cast<scalar>(E) >= device.worst_outflow(f, scalar(T)) * scalar(1.001)) {
        REQUIRE(left == f);
        continue;
      }
      if (W < E * 1.001) continue;
      REQUIRE(static_cast<double>(beyond_nearest<TestType>(device, f, left, E)) <
              (span > 2.0 ? 0.05 : exactness<TestType>));
      const scalar one = device.affordable(f, static_cast<scalar>(E), scalar(T));
      REQUIRE(TestType::norm(left) >= one * TestType::norm(f) * scalar(1 - 1e-5));
      longer += static_cast<double>(TestType::norm(left) / (one * TestType::norm(f)));
    }
  }
  CHECK(longer / 8000 > 1.2);
}

TEST_CASE("the multiplier of the nearest effort comes from below to a millionth of its work",
          "[bound][nearest]") {
  sim::random_source random(17);
  const auto work = [](const auto& device, const d3::vector& f, double lambda) {
    return device.worst_outflow(device.yielding(f, lambda), T);
  };
  for (const double span : {0.5, 2.0, 3.0}) {
    for (int n = 0; n < 2000; ++n) {
      const auto device = at<d3>(any_damping<d3>(random, span));
      const auto f = any_effort<d3>(random, span);
      const double W = device.worst_outflow(f, T);
      const double E = W * std::pow(10.0, random.uniform(-span, 0.0));
      const double found = ph::detail::yield<d3>(device, f, E, T);
      CAPTURE(span, n);
      REQUIRE(found >= 0.0);
      REQUIRE(work(device, f, found) >= E * (1 - 1e-12));
      REQUIRE(work(device, f, found) <= E * (1 + 1.01e-6));
      for (const double more : {1.0 + 5e-7, 1.1, 10.0}) {
        REQUIRE(ph::detail::yield<d3>(device, f, W * more, T) == 0.0);
      }
      for (const double none : {0.0, -W}) {
        REQUIRE(ph::detail::yield<d3>(device, f, none, T) == 0.0);
      }
    }
  }
  const auto device = at<d3>(axes<d3>{{0.01, 0.03, 0.2}});  // what has no square has no multiplier
  CHECK(ph::detail::yield<d3>(device, d3::vector(1, 1e200, 1), 1e-3, T) == 0.0);
}

TEST_CASE("with dampings that are alike the nearest effort is the share for all",
          "[bound][nearest]") {
  sim::random_source random(3);
  const auto bound = at<d3>(ph::strict_bound{});
  for (int n = 0; n < 500; ++n) {
    const double b = any_size(random, 3.0);
    const auto alike = at<d3>(axes<d3>{{b, b, b}});
    const auto one = at<d3>(ph::isotropic_damping{b});
    const auto f = any_effort<d3>(random, 2.0);
    const double E = one.worst_outflow(f, T) * random.uniform(-0.1, 1.2);
    const auto left = allowed(bound, f, situation<d3, axes<d3>>{.damping = alike, .energy = E});
    const auto share = allowed(bound, f, situation<d3>{.damping = one, .energy = E});
    REQUIRE((left - share).norm() <= 1e-6 * share.norm());
  }
}

TEST_CASE("no effort of a search is nearer than strict_bound's, dry friction or not",
          "[bound][nearest]") {
  sim::random_source random(11);
  const auto bound = at<d2>(ph::strict_bound{});
  const auto search = [&](const auto& damping, const d2::vector& f, const d2::vector& left,
                          double E) {
    double nearest = (f - left).norm();
    for (int n = 0; n < 2000; ++n) {  // every direction, each out to where E1 ends
      const double angle = 2.0 * 3.141592653589793 * n / 2000;
      const d2::vector along(std::cos(angle), std::sin(angle));
      double low = 0.0, high = 2.0 * f.norm();
      for (int i = 0; i < 50; ++i) {
        const double middle = (low + high) / 2.0;
        (damping.worst_outflow(along * middle, T) <= E ? low : high) = middle;
      }
      const double inward = std::min(low, std::max(0.0, along.dot(f)));
      nearest = std::min(nearest, (f - along * inward).norm());
    }
    return nearest;
  };
  for (int n = 0; n < 60; ++n) {
    const auto f = any_effort<d2>(random, 0.7);
    const rubbing_axes<d2> rubs{any_damping<d2>(random, 1.0).coefficients,
                                {any_size(random, 1.0), any_size(random, 1.0)},
                                {0.0, 0.0}};
    const auto damped = at<d2>(axes<d2>{rubs.coefficients});
    const auto rubbed = at<d2>(rubs);
    const double E = damped.worst_outflow(f, T) * random.uniform(0.001, 1.0);
    const auto left = allowed(bound, f, situation<d2, axes<d2>>{.damping = damped, .energy = E});
    REQUIRE((f - left).norm() <= search(damped, f, left, E) * (1 + 1e-5) + 1e-12);
    const double least = rubbed.worst_outflow(f, T);
    const double paid = least * random.uniform(0.001, 1.0);
    const auto held =
        allowed(bound, f, situation<d2, rubbing_axes<d2>>{.damping = rubbed, .energy = paid});
    REQUIRE(rubbed.worst_outflow(held, T) <= paid);
    REQUIRE((f - held).norm() <= search(rubbed, f, held, paid) * (1 + 1e-5) + 1e-12);
    const auto owed =
        allowed(bound, f, situation<d2, rubbing_axes<d2>>{.damping = rubbed, .energy = -1e-9});
    REQUIRE(owed == d2::zero());
  }
}

TEST_CASE("what no number covers leaves no force, and no NaN", "[bound][nearest]") {
  const auto bound = at<f3>(ph::strict_bound{});
  for (const float size : {1e-38F, 1e-20F, 1.0F, 1e18F, 3e38F}) {
    for (const float E : {-1.0F, 0.0F, 1e-38F, 1e-6F, 1e30F}) {
      for (const double b : {1e-9, 1.0, 1e9}) {
        const axes<f3> d{{b, 1.0, 1.0 / b}};
        const situation<f3, axes<f3>> now{.damping = at<f3>(d), .energy = E};
        const auto left = allowed(bound, f3::vector(size, -size, size / 3), now);
        CAPTURE(size, E, b);
        REQUIRE(f3::is_finite(left));
        REQUIRE(now.damping.worst_outflow(left, 1e-3F) <= k::larger(E, 0.0F));
      }
    }
  }
}

TEMPLATE_TEST_CASE(
    "reachable bounds leave an effort no farther than one share for all, and covered",
    "[bound][nearest]", d2, d3) {
  using P = TestType;
  sim::random_source random(5);
  const double m = 0.1, hand = 1.0;
  const ph::reachable_bound in_newtons{.mass = m, .hand_force = hand};
  ph::reachable_work_bound<P::dof> in_joules{.hand = hand / std::sqrt(m)};
  int nearer = 0, cut = 0;
  for (int n = 0; n < 3000; ++n) {
    const auto damping = any_damping<P>(random, 1.5);
    for (auto& mass : in_joules.inertia.masses) mass = m * any_size(random, 1.0);
    const auto device = at<P>(damping);
    const auto f = any_effort<P>(random, 0.5), held = any_effort<P>(random, 0.5);
    const typename P::vector travel = random.direction<P>() * 1e-3 * random.uniform(0.0, 1.0);
    const situation<P, axes<P>> now{
        .damping = device,
        .energy = device.worst_outflow(f, T) * std::pow(10.0, random.uniform(-4.0, 0.0)),
        .held = held,
        .travel = travel};
    const auto judge = [&](const auto& bound, double share_for_all, double mass_along) {
      const auto left = allowed(bound, f, now);
      const double one = (1.0 - share_for_all) * f.norm();
      REQUIRE((f - left).norm() <= one * (1 + 1e-6) + 1e-12);
      nearer += (f - left).norm() < 0.99 * one ? 1 : 0;
      cut += one > 1e-9 ? 1 : 0;
      // No motion that is within reach costs more than E1.
      for (int i = 0; i < 40; ++i) {
        const double pushed = (held.norm() + left.norm() + 2 * hand * std::sqrt(mass_along / m)) *
                              T * T / (2 * mass_along);
        const typename P::vector s = travel + random.direction<P>() * pushed;
        REQUIRE(left.dot(s) - device.dissipated(s, T) <= now.energy * (1 + 1e-9));
      }
    };
    const double damper = 2.0 * ph::detail::most_damping<P>(device) / T * travel.norm();
    const double reach =
        k::outward_reach(travel.dot(f) / f.norm(), held.norm(), f.norm(), hand + damper, m, T, T);
    const double most = k::reachable_force_bound(now.energy, device.per_tick(f, T), reach);
    judge(at<P>(in_newtons), std::min(1.0, most / f.norm()), m);
    double heaviest = 0.0;
    for (const double mass : in_joules.inertia.masses) heaviest = std::max(heaviest, mass);
    const auto inertia = at<P>(in_joules.inertia);
    const double other = in_joules.hand + 2.0 * inertia.norm(device.force(travel, T));
    const double work = f.dot(travel) + inertia.norm(f) *
                                            (inertia.norm(held) + inertia.norm(f) + 2 * other) * T *
                                            T / 2;
    judge(at<P>(in_joules), k::reachable_share(now.energy, device.worst_outflow(f, T), work),
          heaviest);
  }
  CAPTURE(nearer, cut);
  CHECK(cut > 1000);
  CHECK(nearer > cut / 4);
}

TEMPLATE_TEST_CASE(
    "the search between one share for all and the nearest finds the best of 16 steps",
    "[bound][nearest]", d2, d3) {
  using P = TestType;
  sim::random_source random(13);
  int inside = 0;
  for (int n = 0; n < 500; ++n) {
    const auto device = at<P>(any_damping<P>(random, 1.5));
    const auto f = any_effort<P>(random, 1.0);
    const double E = device.worst_outflow(f, T) * random.uniform(0.001, 1.2);
    int looks = 0;
    const auto covered = [&](const typename P::vector& g) {
      ++looks;
      return device.affordable(g, E, T);
    };
    const double most = ph::detail::yield<P>(device, f, E, T) * random.uniform(0.0, 3.0);
    const typename P::vector found = ph::detail::nearest_of<P>(
        device, f, [&] { return most; }, covered);
    double best = HUGE_VAL;
    int where = 0;
    for (int i = 0; i <= (most > 0.0 ? 16 : 0); ++i) {  // what is missed has one minimum over λ
      const typename P::vector g = device.yielding(f, i * most / 16);
      const double miss = (f - g * device.affordable(g, E, T)).norm();
      if (miss < best) best = miss, where = i;
    }
    inside += where > 0 && where < 16 ? 1 : 0;
    REQUIRE(looks <= (best > 0.0 && most > 0.0 ? 2 + 1 + 2 * 3 : 1));
    REQUIRE_THAT((f - found).norm(), WithinAbs(best, 1e-9 * f.norm()));
  }
  CHECK(inside > 100);
  int looks = 0;
  const auto all = [&](const typename P::vector&) {
    ++looks;
    return 1.0;
  };
  const typename P::vector f = any_effort<P>(random, 1.0);
  CHECK(ph::detail::nearest_of<P>(
            at<P>(any_damping<P>(random, 1.5)), f, [] { return 1.0; }, all) == f);
  CHECK(looks == 1);  // nothing is missed, so nothing is searched for
}

namespace {

/// A damping that counts how often it is asked for a b.
template <class P>
struct counted {
  std::array<double, P::dof> b{};
  int* asked = nullptr;
  [[nodiscard]] double along_axis(int i) const {
    ++*asked;
    return b[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] typename P::effort beyond(const typename P::effort& f) const { return f; }
};

/// How often Newton's method evaluates the work of an effort, beside what its start needs.
template <class P>
int evaluations(const std::array<double, P::dof>& b, const typename P::effort& f, double E) {
  int asked = 0;
  (void)ph::detail::yield<P>(counted<P>{b, &asked}, f, E, T);
  return (asked - P::dof * (2 + 2 * P::dof)) / P::dof;
}

}  // namespace

TEST_CASE("the multiplier of a force along one axis is known at once, and any in eight steps",
          "[bound][nearest]") {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double share : {0.9, 1e-2, 1e-8}) {
      d3::vector f = d3::zero();
      f(axis) = 2.0;
      std::array<double, 3> b{0.5, 0.5, 0.5};
      b[static_cast<std::size_t>(axis)] = 0.01;
      const double E = at<d3>(axes<d3>{b}).worst_outflow(f, T) * share;
      CAPTURE(axis, share);
      CHECK(evaluations<d3>(b, f, E) == 1);  // it begins at √(n²) − b, which is it
    }
  }
  sim::random_source random(19);
  int most = 0;
  for (int n = 0; n < 3000; ++n) {
    const auto damping = any_damping<d3>(random, 6.0);
    const auto f = any_effort<d3>(random, 1.0);
    const double E = at<d3>(damping).worst_outflow(f, T) * random.uniform(1e-4, 1.0);
    most = std::max(most, evaluations<d3>(damping.coefficients, f, E));
  }
  CHECK(most <= 8);
  // Where b differs by 10⁸ more would be needed, for which a tick has no time.
  CHECK(evaluations<d3>({530.0, 520.0, 7.1e-7}, {0.75, 6.1, 0.53}, 1.8e-5) == 8);
  CHECK(evaluations<d3>({16.0, 4e-7, 130.0}, {3.6, 0.46, 3.8}, 2.3e-4) == 8);
}

TEST_CASE("a search for the nearest effort never looks beyond its ends, whatever it finds there",
          "[bound][nearest]") {
  const double most = 16.0;
  const auto device = at<d2>(axes<d2>{{1.0, 3.0}});
  const d2::vector f(5.0, 7.0);
  std::vector<double> looked;
  const auto found = ph::detail::nearest_of<d2>(
      device, f, [&] { return most; },
      [&](const d2::vector& g) {
        looked.push_back(f(0) / g(0) - 1.0);  // λ, as g₀ = f₀ b₀/(b₀ + λ)
        return looked.size() < 3 ? std::nan("") : 1.0;
      });
  REQUIRE(looked.size() > 3);
  for (const double lambda : looked) {
    CHECK(lambda > -1e-12);
    CHECK(lambda < most * (1.0 + 1e-12));
  }
  CHECK_THAT(looked[2],
             WithinAbs(8.0, 1e-12));  // from an end on which nothing is known: half the way
  CHECK(found(0) < f(0));
}
