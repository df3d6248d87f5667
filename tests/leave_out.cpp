// SPDX-License-Identifier: BSD-3-Clause
// What a scene does not need, it does not pay for: not in bytes, not in calls.
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <type_traits>

namespace {

/// A model of a 1-DOF float wall; only what is named.
template <class Supply, class Normals, class Observer, class Bound, class Motion>
using model = ph::local_model<f1, Supply, Normals, ph::spring<f1>, Observer, Bound, Motion>;
using still = ph::rigid<ph::half_space<f1>>;
using moving = ph::following<ph::half_space<f1>>;
using plain = ph::last_difference<f1>;
using ledger = ph::reduced_energy<f1>;
using bare = model<still, ph::snap<f1>, ph::no_observer<f1>, ph::no_bound<f1>, plain>;

// A part that keeps nothing is nothing.
static_assert(std::is_empty_v<ph::snap<f1>>);
static_assert(std::is_empty_v<ph::no_observer<f1>>);
static_assert(std::is_empty_v<ph::no_bound<f1>>);
static_assert(std::is_empty_v<ph::strict_bound<f1>>);
static_assert(std::is_empty_v<ph::thesis_bound<f1>>);
static_assert(std::is_empty_v<ph::last_difference<f1>>);

// The bare model: p, n, K of the wall; K of the spring; longest tick, top speed; held force,
// position, time blind; three flags.
static_assert(sizeof(bare) == 9 * sizeof(float) + 4);
// Each part adds its own parameters and state, and nothing else.
static_assert(sizeof(model<still, ph::snap<f1>, ledger, ph::no_bound<f1>, plain>) ==
              sizeof(bare) + sizeof(ledger));
static_assert(sizeof(model<still, ph::snap<f1>, ledger, ph::strict_bound<f1>, plain>) ==
              sizeof(bare) + sizeof(ledger));
static_assert(
    sizeof(model<still, ph::snap<f1>, ledger, ph::bound_chain<ph::strict_bound<f1>>, plain>) ==
    sizeof(bare) + sizeof(ledger));
static_assert(
    sizeof(model<still, ph::rotate_limited<f1>, ph::no_observer<f1>, ph::no_bound<f1>, plain>) ==
    sizeof(bare) + sizeof(float));
static_assert(
    sizeof(model<still, ph::snap<f1>, ph::no_observer<f1>, ph::actuator_limit<f1>, plain>) ==
    sizeof(bare) + sizeof(float));
static_assert(sizeof(model<moving, ph::snap<f1>, ph::no_observer<f1>, ph::no_bound<f1>, plain>) ==
              sizeof(bare) - sizeof(still) + sizeof(moving));
// A force on its way costs one more held force, no latency none.
static_assert(sizeof(model<still, ph::snap<f1>, ledger, ph::strict_bound<f1, 2>, plain>) ==
              sizeof(bare) + sizeof(ledger) + 2 * sizeof(float));

/// How often a model asked for what follows from a target.
struct calls {
  int prepared = 0, adopted = 0, turned = 0, moved = 0;
};
calls asked;

struct counting_triangle : ph::triangle<d3> {
  using space_type = d3;
  bool prepare() noexcept {
    ++asked.prepared;
    return ph::triangle<d3>::prepare();
  }
  [[nodiscard]] counting_triangle toward(const counting_triangle& target, const d3::vector& x,
                                         const d3::vector& n, double d) const noexcept {
    ++asked.moved;
    counting_triangle result = *this;
    static_cast<ph::triangle<d3>&>(result) = ph::triangle<d3>::toward(target, x, n, d);
    return result;
  }
};
struct counting_spring : ph::spring<d3> {
  void adopt(double K, double T) noexcept {
    ++asked.adopted;
    ph::spring<d3>::adopt(K, T);
  }
};
struct counting_normals : ph::rotate_limited<d3> {
  [[nodiscard]] d3::vector step(const d3::vector& from, const d3::vector& to,
                                double dt) const noexcept {
    ++asked.turned;
    return ph::rotate_limited<d3>::step(from, to, dt);
  }
};

int limits = 0;
struct counting_bound : ph::strict_bound<d1> {
  [[nodiscard]] double limit(const double& desired, const auto& state) const noexcept {
    ++limits;
    return ph::strict_bound<d1>::limit(desired, state);
  }
};

counting_triangle facet(double tilt) {
  counting_triangle t;
  t.a = {-0.1, -0.1, -tilt};
  t.b = {0.1, -0.1, tilt};
  t.c = {0, 0.2, 0};
  t.stiffness = 500;
  return t;
}

}  // namespace

TEST_CASE("an unchanged target is worked out once, not in every tick", "[local_model][cost]") {
  ph::local_model touch{d3{},
                        ph::following<counting_triangle>{},
                        counting_normals{{.rate = 4}},
                        counting_spring{},
                        ph::reduced_energy<d3>{.damping = 1},
                        ph::thesis_bound<d3>{}};
  asked = {};
  REQUIRE(touch.retarget(facet(0)));
  for (int n = 0; n < 1000; ++n) static_cast<void>(touch.tick({0, 0, 1e-3 - 2e-6 * n}, 1e-3));
  CHECK(asked.prepared == 1);
  CHECK(asked.adopted == 1);
  // the control: each new target is worked out, and the normal turns until it is there
  asked.turned = 0;
  REQUIRE(touch.retarget(facet(0.02)));
  for (int n = 0; n < 1000; ++n) static_cast<void>(touch.tick({0, 0, -1e-3}, 1e-3));
  CHECK(asked.prepared == 2);
  CHECK(asked.adopted == 2);
  CHECK(asked.turned > 10);
  CHECK(asked.turned < 1000);
  CHECK(asked.moved >= asked.turned - 1);
}

TEST_CASE("a local model at its target neither turns nor moves", "[local_model][cost]") {
  ph::local_model touch{d3{},
                        ph::following<counting_triangle>{facet(0.01)},
                        counting_normals{{.rate = 4}},
                        counting_spring{},
                        ph::no_observer<d3>{},
                        ph::no_bound<d3>{}};
  for (int n = 0; n < 10; ++n) static_cast<void>(touch.tick({0, 0, 1e-3}, 1e-3));
  asked = {};
  double force = 0;
  for (int n = 0; n < 1000; ++n) force = touch.tick({0, 0, -1e-6 * n}, 1e-3).force.norm();
  CHECK(force > 0.4);
  CHECK(asked.prepared + asked.adopted + asked.turned + asked.moved == 0);
}

TEST_CASE("a bound that keeps nothing is not asked about a force of zero", "[local_model][cost]") {
  limits = 0;
  ph::local_model touch{d1{},
                        ph::rigid{ph::half_space<d1>{0, 1, 1000}},
                        ph::snap<d1>{},
                        ph::spring<d1>{},
                        ph::reduced_energy<d1>{.damping = 1},
                        counting_bound{}};
  for (int n = 0; n < 10; ++n) static_cast<void>(touch.tick(1e-3, 1e-3));
  CHECK(limits == 0);
  static_cast<void>(touch.tick(-1e-4, 1e-3));
  CHECK(limits == 1);
}
