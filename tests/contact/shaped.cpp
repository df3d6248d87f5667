// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/published/published.hpp>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

namespace laws = ph::laws;

/// test(shaped force, desired force, contact, port) in random states; how often it holds.
template <class S, class Shaper>
int holds_in_random_contacts(const Shaper& parameters, auto test, int ticks = 2000) {
  using scalar = typename S::scalar;
  ph::part_at<Shaper, S> shaper(parameters);
  laws::random_port<S> port(3);
  laws::samples& random = port.random();
  int held = 0;
  for (int i = 0; i < ticks; ++i) {
    const auto state = port.next();
    const scalar deep = random.number<scalar>() * scalar(0.01);
    const ph::contact_state<S> contact{
        .normal = random.direction<S>(),
        .stiffness = scalar(500),
        .depth = random.number<scalar>() * scalar(0.01),
        .target_depth = deep,
        .local_force = ph::kernels::magnitude(random.number<scalar>()) * scalar(5),
        .target_changed = i % 30 == 0};
    const typename S::vector desired =
        contact.normal * ph::kernels::larger(scalar(500) * deep, scalar(0));
    held +=
        test(ph::detail::applied<S>(shaper, desired, contact, state).force, desired, contact, state)
            ? 1
            : 0;
  }
  return held;
}

/// s·f* with 0 ≤ s ≤ 1.
constexpr auto only_less = [](const auto& force, const auto& desired, const auto&, const auto&) {
  return force.dot(desired) >= 0 && force.squaredNorm() <= desired.squaredNorm() &&
         (force * desired.norm() - desired * force.norm()).norm() <= 1e-9;
};

struct half {
  static constexpr bool needs_local_model = false;
  static constexpr bool needs_ledger = false;
  template <class S>
  struct on {
    constexpr explicit on(const half& /*p*/) noexcept {}
    [[nodiscard]] constexpr ph::share<typename S::scalar> shape(
        const auto& /*desired*/, const auto& /*contact*/, const auto& /*port*/) const noexcept {
      return {typename S::scalar(0.5)};
    }
  };
};
static_assert(ph::shaper_for<half, d1> && !ph::shaper_for<ph::spring, d1>);
/// One newton more.
struct push : half {
  template <class S>
  struct on {
    constexpr explicit on(const push& /*p*/) noexcept {}
    [[nodiscard]] constexpr typename S::vector shape(const typename S::vector& desired,
                                                     const auto& contact,
                                                     const auto& /*port*/) const noexcept {
      return desired + contact.normal;
    }
  };
};
/// Half as much in every tick.
struct tiring : half {
  template <class S>
  class on {
   public:
    constexpr explicit on(const tiring& /*p*/) noexcept {}
    constexpr void reset() noexcept { left_ = 1; }
    [[nodiscard]] constexpr ph::share<typename S::scalar> shape(const auto& /*desired*/,
                                                                const auto& /*contact*/,
                                                                const auto& /*port*/) noexcept {
      return {left_ /= 2};
    }

   private:
    typename S::scalar left_ = 1;
  };
};

template <class Law>
double first_force(const Law& law) {
  ph::local_model model{d1{},
                        ph::followed{wall<d1>(1000)},
                        ph::turn_at_once{},
                        law,
                        ph::reduced_energy{.damping = 0.03, .loan = 10.0},
                        ph::strict_bound{},
                        thesis_loop};
  return model.tick(0.002, 1ms).force;  // the spring asks for 2 N
}

}  // namespace

TEST_CASE("shapers that only reduce do reduce, and keep the direction", "[shaper]") {
  CHECK(holds_in_random_contacts<d3>(ph::thesis_rule{}, only_less) == 2000);
  CHECK(holds_in_random_contacts<d3>(ph::set_position_modulation{}, only_less) == 2000);
  CHECK(holds_in_random_contacts<d3>(ph::published_set_position_modulation{}, only_less) == 2000);
  CHECK(holds_in_random_contacts<d3>(ph::nonlinear_coupling{.initial = 50, .rate = 1e4},
                                     only_less) == 2000);
  CHECK(holds_in_random_contacts<d3>(ph::stiffness_increment{.initial = 50, .step = 10},
                                     only_less) == 2000);
  CHECK(holds_in_random_contacts<d3>(ph::force_augmentation{.low = 50, .step = 0.1}, only_less) ==
        2000);
  // the controls: what may hold more says so by its type, and does
  CHECK(holds_in_random_contacts<d3>(ph::force_rate_limit{.rate = 100.0}, only_less) < 2000);
  CHECK(holds_in_random_contacts<d3>(ph::reference_energy{{.max_damping = 10.0}}, only_less) <
        2000);
}

TEST_CASE("thesis_rule spends more than the ledger holds, strict_bound behind it does not",
          "[shaper]") {
  const auto covered = [](const auto& force, const auto&, const auto&, const auto& port) {
    const auto outflow = port.damping.worst_outflow(force, port.longest_tick);
    return outflow <= std::max(port.credit(), 0.0);
  };
  CHECK(holds_in_random_contacts<d3>(ph::thesis_rule{}, covered) < 2000);
  const auto bounded = [&covered](const auto& force, const auto& desired, const auto& contact,
                                  const auto& port) {
    ph::strict_bound::on<d3> bound({});
    return covered(ph::laws::meant<d3>(bound, force, port), desired, contact, port);
  };
  CHECK(holds_in_random_contacts<d3>(ph::thesis_rule{}, bounded) == 2000);
  CHECK(holds_in_random_contacts<d3>(ph::force_rate_limit{.rate = 100.0}, bounded) == 2000);
}

TEST_CASE("shapers follow each other in the order given", "[shaper]") {
  CHECK_THAT(first_force(ph::spring{}), WithinRel(-2.0, 1e-12));
  CHECK(first_force(ph::shaped{ph::spring{}}) == first_force(ph::spring{}));
  CHECK_THAT(first_force(ph::shaped{ph::spring{}, half{}}), WithinRel(-1.0, 1e-12));
  CHECK_THAT(first_force(ph::shaped{ph::spring{}, half{}, push{}}), WithinRel(-2.0, 1e-12));
  CHECK_THAT(first_force(ph::shaped{ph::spring{}, push{}, half{}}), WithinRel(-1.5, 1e-12));
}

TEST_CASE("a shaped law asks for a local model and a ledger where a shaper of it does",
          "[shaper]") {
  using plain = ph::shaped<ph::spring, half>;
  using rate = ph::shaped<ph::spring, half, ph::force_rate_limit>;
  using soft = ph::shaped<ph::spring, ph::nonlinear_coupling>;
  static_assert(!plain::needs_local_model && !plain::needs_ledger);
  static_assert(rate::needs_local_model && !rate::needs_ledger);
  static_assert(!soft::needs_local_model && soft::needs_ledger);
  SUCCEED();
}

TEST_CASE("the local model stands where the shaped force says", "[shaper]") {
  auto model = following_half_space<d1>(ph::shaped{ph::spring{}, half{}},
                                        ph::reduced_energy{.damping = 0.03, .loan = 10.0},
                                        ph::strict_bound{});
  model.update(wall<d1>(1000));
  const auto out = model.tick(0.002, 1ms);
  CHECK(out.limited);
  CHECK_THAT(out.depth, WithinRel(0.001, 1e-12));
  CHECK_THAT(model.local().at(0.002).depth, WithinRel(0.001, 1e-12));
  CHECK_FALSE(model.tick(-0.001, 1ms).limited);
}

TEST_CASE("a shaper that pushes is bounded as any other wish is", "[shaper][passivity]") {
  auto model = following_half_space<d1>(ph::shaped{ph::spring{}, push{}}, thesis_ledger(),
                                        ph::strict_bound{});
  model.update(wall<d1>(1e4));
  static_assert(decltype(model)::passivity == ph::guarantee::strict);
  laws::samples random(9);
  double x = 0.0, energy = 0.0, held = 0.0, least = 0.0;
  bool pushed = false;
  for (int n = 0; n < 5000; ++n) {
    const auto out = model.tick(x, 1ms);
    pushed = pushed || (x < 0.0 && out.force < 0.0);  // outside: only the shaper asks
    held = out.force;
    const double worst = held / 60.0;
    const double dx = random.number<double>() > 0.0 ? worst : random.number<double>() * 1e-3;
    const double back = x > 2e-3 ? -1e-3 : x < -2e-3 ? 1e-3 : dx;
    energy += 30.0 * back * back - held * back;
    x += back;
    least = std::min(least, energy);
  }
  CHECK(pushed);
  CHECK(least >= -1e-12);
}

TEST_CASE("a shaped law names the first fault of law and shapers, and resets them", "[shaper]") {
  const auto refused = [](const auto& law) {
    const auto fault = law.check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused(ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = 1.0}}).empty());
  CHECK(refused(ph::shaped{ph::spring{}, ph::force_rate_limit{}}) == "rate");
  CHECK(refused(ph::shaped{ph::damped_spring{}, ph::force_rate_limit{}}) == "mass");
  CHECK(refused(ph::shaped{ph::spring{}, half{}, ph::nonlinear_coupling{}}) == "initial");

  auto model = following_half_space<d1>(ph::shaped{ph::spring{}, tiring{}},
                                        ph::reduced_energy{.damping = 0.03, .loan = 10.0},
                                        ph::strict_bound{});
  for (int run = 0; run < 2; ++run) {
    model.update(wall<d1>(1000));
    CHECK_THAT(model.tick(0.002, 1ms).force, WithinRel(-1.0, 1e-12));
    CHECK_THAT(model.tick(0.002, 1ms).force, WithinRel(-0.5, 1e-12));
    model.reset();
  }
}
