// SPDX-License-Identifier: BSD-3-Clause
// What a scene does not need, it does not pay for: not in bytes, not in calls.
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <type_traits>

namespace {

/// A model of a 1-DOF float wall; only what is named.
template <class Supply, class Normals, class Observer, class Bound, class Limits = ph::loop_limits>
using model = ph::local_model<f1, Supply, Normals, ph::spring, Observer, Bound, Limits>;
using still = ph::fixed<ph::half_space<f1>>;
using moving = ph::followed<ph::half_space<f1>>;
using ledger = ph::reduced_energy;
using bare = model<still, ph::turn_at_once, ph::no_observer, ph::no_bound>;
template <class Part>
using at_wall = ph::part_at<Part, f1>;

// A part that keeps nothing is nothing.
static_assert(std::is_empty_v<at_wall<ph::turn_at_once>>);
static_assert(std::is_empty_v<at_wall<ph::no_observer>>);
static_assert(std::is_empty_v<at_wall<ph::no_bound>>);
static_assert(std::is_empty_v<at_wall<ph::strict_bound>>);
static_assert(std::is_empty_v<at_wall<ph::thesis_rule>>);
static_assert(std::is_empty_v<at_wall<ph::last_difference>>);

// The bare model: p, n, K of the wall; K of the spring; four limits of the loop; held force,
// position, time blind; two flags.
static_assert(sizeof(bare) == 11 * sizeof(float) + 4);
// Each part adds its own parameters and state, and nothing else.
static_assert(sizeof(at_wall<ledger>) == 3 * sizeof(float));  // b, loan, E1
static_assert(sizeof(model<still, ph::turn_at_once, ledger, ph::no_bound>) ==
              sizeof(bare) + sizeof(at_wall<ledger>));
static_assert(sizeof(model<still, ph::turn_at_once, ledger, ph::strict_bound>) ==
              sizeof(bare) + sizeof(at_wall<ledger>));
static_assert(sizeof(model<still, ph::turn_at_once, ledger, ph::bound_chain<ph::strict_bound>>) ==
              sizeof(bare) + sizeof(at_wall<ledger>));
static_assert(sizeof(model<still, ph::turn_limited, ph::no_observer, ph::no_bound>) ==
              sizeof(bare) + sizeof(float));
static_assert(sizeof(model<still, ph::turn_at_once, ph::no_observer, ph::actuator_limit>) ==
              sizeof(bare) + sizeof(float));
static_assert(sizeof(model<moving, ph::turn_at_once, ph::no_observer, ph::no_bound>) ==
              sizeof(bare) - sizeof(still) + sizeof(moving) + 4);  // beside it, or in contact?
// A force on its way costs one more held force, no latency none.
static_assert(
    sizeof(model<still, ph::turn_at_once, ledger, ph::strict_bound, ph::late_loop_limits<2>>) ==
    sizeof(bare) + sizeof(at_wall<ledger>) + 2 * sizeof(float));
// A loop that trusts its samples has no limit but its longest tick, and is never blind.
static_assert(
    sizeof(model<still, ph::turn_at_once, ledger, ph::strict_bound, ph::trusted_loop_limits<>>) ==
    sizeof(bare) + sizeof(at_wall<ledger>) - 4 * sizeof(float));
// Credit that is capped costs its cap, the time that voids it, and that time so far; uncapped, nothing.
static_assert(sizeof(at_wall<ph::capped_energy>) == sizeof(at_wall<ledger>) + 3 * sizeof(float));
// A loop that nobody watches does not pay for watching, and shapers that keep nothing not for shaping.
static_assert(sizeof(ph::sensor_watch<f1, true>) == 1);
static_assert(std::is_empty_v<ph::sensor_watch<f1, false>>);
static_assert(sizeof(at_wall<ph::shaped<ph::spring, ph::thesis_rule>>) ==
              sizeof(at_wall<ph::spring>));
// A force that is given: stale_after, fade, age, what was said of it, the force.
static_assert(sizeof(at_wall<ph::given_force>) == 5 * sizeof(float));

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
struct counting_spring : ph::spring {
  template <class Space>
  struct on : ph::spring::on<Space> {
    using ph::spring::on<Space>::on;
    void adopt(double K, double T) noexcept {
      ++asked.adopted;
      ph::spring::on<Space>::adopt(K, T);
    }
  };
};
struct counting_normals : ph::turn_limited {
  template <class Space>
  struct on : ph::turn_limited::on<Space> {
    using ph::turn_limited::on<Space>::on;
    [[nodiscard]] d3::vector step(const d3::vector& from, const d3::vector& to,
                                  double dt) const noexcept {
      ++asked.turned;
      return ph::turn_limited::on<Space>::step(from, to, dt);
    }
  };
};

int limits = 0;
struct counting_bound : ph::strict_bound {
  template <ph::port P>
  struct on : ph::strict_bound::on<P> {
    using ph::strict_bound::on<P>::on;
    [[nodiscard]] ph::share<double> limit(const double& desired, const auto& state) const noexcept {
      ++limits;
      return ph::strict_bound::on<P>::limit(desired, state);
    }
  };
};
int shapes = 0;
struct counting_shaper : ph::thesis_rule {
  template <class Space>
  struct on : ph::thesis_rule::on<Space> {
    using ph::thesis_rule::on<Space>::on;
    [[nodiscard]] ph::share<double> shape(const double& desired, const auto& contact,
                                          const auto& state) const noexcept {
      ++shapes;
      return ph::thesis_rule::on<Space>::shape(desired, contact, state);
    }
  };
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

TEST_CASE("an unchanged target is worked out as it comes, not in every tick",
          "[local_model][cost]") {
  ph::local_model touch{d3{},
                        ph::followed<counting_triangle>{},
                        counting_normals{{.rate = 4}},
                        ph::shaped{counting_spring{}, ph::thesis_rule{}},
                        ph::reduced_energy{.damping = 1},
                        ph::strict_bound{},
                        thesis_loop};
  asked = {};
  REQUIRE(touch.update(facet(0)));
  for (int n = 0; n < 1000; ++n) static_cast<void>(touch.tick({0, 0, 1e-3 - 2e-6 * n}, 1ms));
  CHECK(asked.prepared == 1);
  CHECK(asked.adopted == 2);  // by the contact, and for what update() answers
  // the control: each new target is worked out, and the normal turns until it is there
  asked.turned = 0;
  REQUIRE(touch.update(facet(0.02)));
  for (int n = 0; n < 1000; ++n) static_cast<void>(touch.tick({0, 0, -1e-3}, 1ms));
  CHECK(asked.prepared == 2);
  CHECK(asked.adopted == 4);
  CHECK(asked.turned > 10);
  CHECK(asked.turned < 1000);
  CHECK(asked.moved >= asked.turned - 1);
}

TEST_CASE("a local model at its target neither turns nor moves", "[local_model][cost]") {
  ph::local_model touch{d3{},
                        ph::followed<counting_triangle>{facet(0.01)},
                        counting_normals{{.rate = 4}},
                        counting_spring{},
                        ph::no_observer{},
                        ph::no_bound{},
                        thesis_loop};
  for (int n = 0; n < 10; ++n) static_cast<void>(touch.tick({0, 0, 1e-3}, 1ms));
  asked = {};
  double force = 0;
  for (int n = 0; n < 1000; ++n) force = touch.tick({0, 0, -1e-6 * n}, 1ms).force.norm();
  CHECK(force > 0.4);
  CHECK(asked.prepared + asked.adopted + asked.turned + asked.moved == 0);
}

TEST_CASE("a bound that keeps nothing is not asked about a force of zero", "[local_model][cost]") {
  limits = 0;
  ph::local_model touch{d1{},         ph::fixed{ph::half_space<d1>{0, 1, 1000}}, ph::turn_at_once{},
                        ph::spring{}, ph::reduced_energy{.damping = 1},          counting_bound{},
                        thesis_loop};
  for (int n = 0; n < 10; ++n) static_cast<void>(touch.tick(1e-3, 1ms));
  CHECK(limits == 0);
  static_cast<void>(touch.tick(-1e-4, 1ms));
  CHECK(limits == 1);
}

TEST_CASE("a shaper that keeps nothing is not asked about a force of zero", "[local_model][cost]") {
  shapes = limits = 0;
  ph::local_model touch{d1{},
                        ph::followed{ph::half_space<d1>{0, 1, 1000}},
                        ph::turn_at_once{},
                        ph::shaped{ph::spring{}, counting_shaper{}},
                        ph::reduced_energy{.damping = 1},
                        counting_bound{},
                        thesis_loop};
  for (int n = 0; n < 10; ++n) static_cast<void>(touch.tick(1e-3, 1ms));
  CHECK(shapes + limits == 0);
  static_cast<void>(touch.tick(-1e-4, 1ms));
  CHECK(shapes == 1);
  CHECK(limits == 1);
}
