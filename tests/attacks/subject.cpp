// SPDX-License-Identifier: BSD-3-Clause
// Which models a challenge takes, and how surfaces are laid on them.
#include "attacks/challenged.hpp"

using namespace simulated;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("a challenge takes fixed walls, triangles, segments and constraints laid by the caller",
          "[adversaries]") {
  SECTION("fixed: the surface stays where the model has it") {
    const auto wall = [](const auto& bound) {
      return ph::local_model{d2{},
                             ph::fixed{ph::half_space<d2>{{0.1, -0.2}, {0.6, 0.8}, 1e4}},
                             ph::turn_at_once{},
                             ph::spring{},
                             thesis_ledger(),
                             bound,
                             thesis_loop};
    };
    survives_all(wall(ph::strict_bound{}), {}, 10);
    for (const sim::verdict& v : sim::challenge_all(wall(ph::no_bound{}), {}, 10)) {
      CAPTURE(to_string(v.by), v.least_energy);
      if (v.by == by::jumping_surface) continue;  // it needs a surface that can jump
      CHECK(v.least_energy < -1e-4);
    }
  }
  SECTION("triangle") {
    const auto wall = [](const auto& bound) {
      return ph::local_model{d3{},
                             ph::followed<ph::triangle<d3>>{},
                             ph::turn_at_once{},
                             ph::spring{},
                             thesis_ledger(),
                             bound,
                             thesis_loop};
    };
    survives_all(wall(ph::strict_bound{}), {}, 10);
    CHECK(sim::challenge(wall(ph::no_bound{}), by::greedy, {}, 10).least_energy < -1e-3);
  }
  SECTION("segment, and one that the caller lays") {
    const auto wall = [](const auto& bound) {
      return ph::local_model{d2{},
                             ph::followed<ph::segment<d2>>{},
                             ph::turn_at_once{},
                             ph::spring{},
                             thesis_ledger(),
                             bound,
                             thesis_loop};
    };
    survives_all(wall(ph::strict_bound{}), {}, 10);
    const auto loose = wall(ph::no_bound{});
    CHECK(sim::challenge(loose, by::random_walk, {}, 10).least_energy < -1e-3);
    int laid = 0;
    const auto soft = [&laid](const d2::vector& point, const d2::vector& normal, double /*K*/) {
      ++laid;
      return sim::lay_constraint<ph::segment<d2>>{}(point, normal, 1.0);
    };
    CHECK(sim::challenge(loose, by::random_walk, {}, 10).largest_force > 1.0);
    CHECK(sim::challenge(loose, by::random_walk, {}, 10, 1, soft).largest_force < 0.1);
    CHECK(laid >= 10);
  }
}

TEST_CASE("a constraint is laid through its point, facing its normal", "[adversaries]") {
  sim::random_source random{4};
  for (int n = 0; n < 100; ++n) {
    const d3::vector p = random.direction<d3>(), m = random.direction<d3>();
    auto triangle = sim::lay_constraint<ph::triangle<d3>>{}(p, m, 100.0);
    REQUIRE(triangle.prepare());
    CHECK((d3::vector(triangle.normal) - m).norm() < 1e-12);
    CHECK_THAT(triangle.at(p - m * 0.01).depth, WithinAbs(0.01, 1e-14));
    CHECK(triangle.at(p).covered());
    const d3::vector a = triangle.a, b = triangle.b, c = triangle.c;
    CHECK((a + b + c - 3 * p).norm() < 1e-14);
    CHECK_THAT((a - b).norm(), WithinRel(0.04, 1e-12));
    CHECK_THAT((c - b).norm(), WithinRel(0.04, 1e-12));
    const d2::vector q = random.direction<d2>(), k = random.direction<d2>();
    auto segment = sim::lay_constraint<ph::segment<d2>>{}(q, k, 100.0);
    REQUIRE(segment.prepare());
    CHECK((d2::vector(segment.normal) - k).norm() < 1e-12);
    CHECK(segment.at(q).covered());
  }
}

namespace {

auto contact() {
  return ph::local_contact{ph::followed<ph::half_space<d1>>{}, ph::turn_limited{.rate = 4},
                           ph::spring{}};
}
template <class Source>
auto port_of(const Source& source) {
  return ph::passive_port{d1{}, source, thesis_ledger(), ph::strict_bound{}, thesis_loop};
}
template <class Model>
constexpr bool known_how = sim::lay_for<sim::usual_lay<Model>, Model>;

}  // namespace

TEST_CASE("a port with one contact is challenged as the local model is that it makes",
          "[adversaries]") {
  const auto port = port_of(contact());
  static_assert(known_how<std::remove_const_t<decltype(port)>>);
  const auto of_port = sim::challenge_all(port, {}, 5);
  const auto of_model = sim::challenge_all(strict<d1>, {}, 5);
  for (std::size_t i = 0; i < of_port.size(); ++i) {
    CAPTURE(to_string(of_port[i].by));
    CHECK(of_port[i].largest_force == of_model[i].largest_force);
    CHECK(of_port[i].largest_force > 1e-3);
    CHECK(of_port[i].mean_energy == of_model[i].mean_energy);
  }
}

TEST_CASE("who has several contacts, or none, must say how a surface is laid on them",
          "[adversaries]") {
  const auto two = port_of(ph::contacts{contact(), contact()});
  const auto none = port_of(ph::given_force{});
  using two_type = std::remove_const_t<decltype(two)>;
  static_assert(!known_how<two_type>);
  constexpr auto misspelt = [](int) { return true; };
  static_assert(!sim::lay_for<decltype(misspelt), std::remove_const_t<decltype(strict<d1>)>>);
  static_assert(!known_how<std::remove_const_t<decltype(none)>>);
  int laid = 0;
  const auto on_the_second = [&laid](two_type& port, const sim::surface_state<d1>& s) {
    ++laid;
    return port.source().contact<1>().update({s.point, s.normal, s.stiffness});
  };
  static_assert(sim::lay_for<decltype(on_the_second), two_type>);
  const auto v = sim::challenge(two, by::greedy, {}, 10, 1, on_the_second);
  const auto one = sim::challenge(strict<d1>, by::greedy, {}, 10);
  CHECK(laid >= 10);
  CHECK(v.largest_force == one.largest_force);
  CHECK(v.mean_energy == one.mean_energy);
}
