// SPDX-License-Identifier: BSD-3-Clause
// Rounding only lowers a force and raises what is feared: what a bound in floats lets through of a force, the same
// bound in doubles lets through, too. Both are told the same, because every number here is a float.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/device/rigid_body.hpp>
#include <passive_haptics/device/rigid_damping.hpp>
#include <passive_haptics/force_bound/reachable_bound.hpp>
#include <passive_haptics/force_bound/rigid_reachable_bound.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/laws.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace {

/// The float nearest to `x`.
constexpr double rounded(double x) {
  return static_cast<double>(static_cast<float>(x));
}

/// A number that is a float, of 10^`least` to 10^`most`.
double some(ph::laws::samples& random, double least, double most) {
  const double middle = (least + most) / 2.0, half = (most - least) / 2.0;
  return rounded(std::pow(10.0, middle + half * random.number<double>()));
}

/// What of a tick has no direction.
struct moment {
  double energy, dt, T, longest, shortest, error;
};

/// The share of h[3] that `Bound` lets through on `Port`, where h[0] was held in the last tick, and `Late` forces after
/// it are on their way.
template <class Port, int Late, bool Exact, class Bound, class Damping, std::size_t N>
double passes(const Bound& told, const Damping& damping, const moment& now,
              const std::array<std::array<double, N>, 4>& h, const std::array<double, N>& moved) {
  using S = typename Port::scalar;
  using damper = ph::part_at<Damping, Port>;
  using state = ph::port_state<Port, damper, Late, Exact>;
  const damper b(damping);
  const ph::part_at<Bound, Port> bound(told);
  const auto as = [](auto zero, const std::array<double, N>& x) {
    for (std::size_t i = 0; i < N; ++i) Port::component(zero, static_cast<int>(i)) = S(x[i]);
    return zero;
  };
  const typename Port::effort none = Port::zero();
  const auto effort = [&](std::size_t j) { return typename Port::effort(as(none, h[j])); };
  typename state::commands commanded;
  for (std::size_t j = 0; j <= Late; ++j) {
    commanded[j] = typename Port::stored_effort(effort(Late - j));
  }
  const typename Port::stored_effort held(effort(0));
  ph::recent_ticks<S, Exact> recent{};
  recent.longest = S(now.longest);
  if constexpr (!Exact) recent.shortest = S(now.shortest);
  const state s{.damping = b,
                .commanded = commanded,
                .energy = S(now.energy),
                .dt = S(now.dt),
                .longest_tick = S(now.T),
                .recent = recent,
                .held = held,
                .travel = as(typename Port::motion(Port::zero()), moved),
                .travel_error = Exact ? S(0) : S(now.error),
                .motion_known = true,
                .late = false};
  return static_cast<double>(bound.limit(effort(3), s).factor);
}

/// Tries ticks in which the force is about to be cut: where credit and reach nearly cancel, rounding is most of them.
template <class Wide, class Narrow, int Late, bool Exact, class Bound, class Damping>
void never_more(const Bound& told, const Damping& damping) {
  ph::laws::samples random(1);
  constexpr std::size_t N = Wide::dof;
  int cut = 0;
  for (int n = 0; n < 2000; ++n) {
    const double T = some(random, -3.2, -2.8);
    moment now{.energy = some(random, -9.0, -2.0),
               .dt = rounded(T * (0.75 + 0.25 * random.number<double>())),
               .T = T,
               .longest = T,
               .shortest = 0.0,
               .error = some(random, -8.0, -5.0)};
    now.shortest = now.dt;
    std::array<std::array<double, N>, 4> h{};
    std::array<double, N> way{}, moved{};
    for (std::size_t i = 0; i < N; ++i) {
      for (auto& f : h) f[i] = rounded((i < 3 ? 4.0 : 0.08) * random.number<double>());
      way[i] = random.number<double>() * (i < 3 ? 3e-3 : 1e-2);
    }
    const auto move = [&](double share) {
      for (std::size_t i = 0; i < N; ++i) moved[i] = rounded(share * way[i]);
    };
    move(random.number<double>());
    // Where do doubles begin to let through less than `most`?
    const double most = 1.0 - 0.999 * std::abs(random.number<double>());
    const auto begins = [&](double least, double high, const auto& set) {
      const auto enough = [&](double x) {
        set(x);
        return passes<Wide, Late, Exact>(told, damping, now, h, moved) >= most;
      };
      const bool rises = enough(high);
      for (int k = 0; k < 30; ++k) {
        const double x = (least + high) / 2.0;
        (enough(x) == rises ? high : least) = x;
      }
      set(high);
    };
    if (n % 3 == 1) begins(-9.0, -1.0, [&](double x) { now.energy = rounded(std::pow(10.0, x)); });
    if (n % 3 == 2) begins(-1.0, 1.0, move);
    const double wide = passes<Wide, Late, Exact>(told, damping, now, h, moved),
                 narrow = passes<Narrow, Late, Exact>(told, damping, now, h, moved);
    CAPTURE(n, wide);
    REQUIRE(narrow <= wide);
    cut += wide < 0.999 && wide > 0.0;
  }
  CHECK(cut > 50);
}

/// Asks after up to 0.1 s without samples what a force may have done in them.
template <class Wide, class Narrow, class Bound, class Damping>
void no_less_unseen(const Bound& told, const Damping& damping) {
  ph::laws::samples random(2);
  int finite = 0;
  for (int n = 0; n < 5000; ++n) {
    const double square = some(random, -14.0, -5.0), T0 = some(random, -3.2, -2.8),
                 error = some(random, -8.0, -5.0), dt = some(random, -3.0, -1.0);
    std::array<double, Wide::dof> held{}, f{};
    for (std::size_t i = 0; i < Wide::dof; ++i) {
      held[i] = rounded((i < 3 ? 4.0 : 0.08) * random.number<double>());
      f[i] = rounded((i < 3 ? 4.0 : 0.08) * random.number<double>());
    }
    const auto unseen = [&]<class Port>(const Port& /*of*/) {
      using S = typename Port::scalar;
      typename Port::stored_effort before(Port::zero()), effort(Port::zero());
      for (std::size_t i = 0; i < Wide::dof; ++i) {
        Port::component(before, static_cast<int>(i)) = S(held[i]);
        Port::component(effort, static_cast<int>(i)) = S(f[i]);
      }
      const auto most = ph::part_at<Bound, Port>(told).unseen(
          ph::detail::seen_tick<Port>{S(square), S(T0), S(error), before},
          ph::part_at<Damping, Port>(damping), typename Port::effort(effort), S(dt));
      return std::array{static_cast<double>(most.done), static_cast<double>(most.beside)};
    };
    const auto wide = unseen(Wide{}), narrow = unseen(Narrow{});
    CAPTURE(n, wide[0], narrow[0], wide[1], narrow[1]);
    REQUIRE((narrow[0] >= wide[0] || narrow[0] >= 1e38));
    REQUIRE((narrow[1] >= wide[1] || narrow[1] >= 1e38));
    finite += wide[0] < 1e38;
  }
  CHECK(finite > 1000);
}

}  // namespace

TEST_CASE("floats let through no more of a force than doubles", "[law][bound]") {
  const ph::isotropic_damping damper{rounded(0.05)};
  const ph::strict_bound strict;
  never_more<d3, f3, 0, true>(strict, damper);
  never_more<d3, f3, 2, true>(strict, damper);
  const ph::reachable_bound known{rounded(0.1), 5.0};
  never_more<d1, f1, 0, true>(known, damper);
  never_more<d3, f3, 0, true>(known, damper);
  never_more<d3, f3, 1, true>(known, damper);
  never_more<d3, f3, 2, true>(known, damper);
  never_more<d3, f3, 0, false>(known, damper);
  never_more<d3, f3, 1, false>(known, damper);
  never_more<d3, f3, 2, false>(known, damper);
}

TEST_CASE("floats let through no more than doubles where friction is credited", "[law][bound]") {
  const ph::damping_and_friction rubbing{rounded(0.05), rounded(0.25), rounded(1e-5)};
  never_more<d3, f3, 0, false>(ph::strict_bound{}, rubbing);
  never_more<d3, f3, 2, false>(ph::strict_bound{}, rubbing);
  never_more<d3, f3, 0, false>(ph::reachable_bound{rounded(0.1), 5.0}, rubbing);
  never_more<d3, f3, 1, false>(ph::reachable_bound{rounded(0.1), 5.0}, rubbing);
}

TEST_CASE("floats let through no more than doubles of what is bounded in joules", "[law][bound]") {
  const ph::reachable_work_bound<3> axes{{0.125, 0.25, 0.0625}, 8.0};
  never_more<d3, f3, 0, true>(axes, ph::isotropic_damping{rounded(0.05)});
  never_more<d3, f3, 1, true>(axes, ph::isotropic_damping{rounded(0.05)});
  never_more<d3, f3, 2, true>(axes, ph::isotropic_damping{rounded(0.05)});
  const ph::rigid_reachable_bound handle{
      {rounded(0.15), rounded(1e-4), rounded(2e-4), rounded(0.02)},
      5.0,
      rounded(0.1),
      rounded(0.06),
      rounded(2e-4)};
  using wide = ph::rigid_body<double>;
  using narrow = ph::rigid_body<float>;
  never_more<wide, narrow, 0, true>(handle, ph::rigid_damping{rounded(0.05), rounded(1e-4)});
  never_more<wide, narrow, 1, true>(handle, ph::rigid_damping{rounded(0.05), rounded(1e-4)});
}

TEST_CASE("what a force may have done unseen is no less in floats than in doubles",
          "[law][bound]") {
  no_less_unseen<ph::rigid_body<double>, ph::rigid_body<float>>(
      ph::rigid_reachable_bound{{rounded(0.15), rounded(1e-4), rounded(2e-4), rounded(0.02)},
                                5.0,
                                rounded(0.1),
                                rounded(0.06),
                                rounded(2e-4)},
      ph::rigid_damping{rounded(0.05), rounded(1e-4)});
  no_less_unseen<d3, f3>(ph::reachable_bound{rounded(0.1), 5.0},
                         ph::isotropic_damping{rounded(0.05)});
}
