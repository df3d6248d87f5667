// SPDX-License-Identifier: BSD-3-Clause
// reference_energy: the passivity controller that keeps what a release will take.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/published/reference_energy.hpp>

using attacks::model_of, attacks::tapped;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

static_assert(ph::shaped<ph::spring, ph::reference_energy_with_damping>::needs_ledger);

template <class Shaper, class Observer = ph::reduced_energy>
auto shaped_by(const Shaper& shaper, const Observer& observer = thesis_ledger()) {
  return following_half_space<d1>(ph::shaped{ph::spring{}, shaper}, observer, ph::no_bound{});
}

constexpr ph::reference_energy reference{.controller = {.max_damping = 50.0}};

}  // namespace

TEST_CASE("reference_energy keeps the energy of the spring, in contact only", "[time domain]") {
  const auto force = [](double loan, double desired) {
    auto shaper = at<d1>(ph::reference_energy{.controller = {.max_damping = 10.0, .loan = loan}});
    const ph::contact_state<d1> contact{.normal = -1,
                                        .stiffness = 1000,
                                        .depth = 1e-3,
                                        .target_depth = 1e-3,
                                        .local_force = 1,
                                        .target_changed = false};
    return allowed(shaper, desired, contact, situation<d1>{.travel = 1e-4});
  };
  // K d²/2 = 0.5 mJ is wanted, nothing is there: α is at its cap
  CHECK_THAT(force(0.0, -1.0), WithinAbs(-1.0 - 1.0, 1e-12));
  CHECK(force(0.0, 0.0) == 0.0);
  CHECK(force(0.51e-3, -1.0) == -1.0);
}

TEST_CASE("reference_energy keeps the part that is set, and none where the surface is beyond reach",
          "[time domain]") {
  ph::reference_energy p{.controller = {.max_damping = 1e3}};
  const auto force = [&](double depth) {
    auto shaper = at<d1>(reference);
    shaper.set(p);
    const ph::contact_state<d1> contact{.normal = -1,
                                        .stiffness = 1000,
                                        .depth = 1e-3,
                                        .target_depth = depth,
                                        .local_force = 1,
                                        .target_changed = false};
    return allowed(shaper, -1.0, contact, situation<d1>{.travel = 1e-3});
  };
  for (const double part : {0.0, 0.5, 1.0}) {  // part·K d²/2 over 1 mm, with nothing in the ledger
    p.part = part;
    CHECK_THAT(force(1e-3), WithinRel(-1.0 - part * 0.5, 1e-12));
    CHECK(force(-1e-3) == -1.0);
  }
}

TEST_CASE("reference_energy reproduces its rows of S0 (docs/design/mathematics.md § 5)",
          "[time domain]") {
  const auto smooth =
      attacks::drop(shaped_by(ph::reference_energy_with_damping{{.max_damping = 50.0}}));
  CHECK_THAT(smooth.swing, WithinRel(63.3e-3, 0.01));
  CHECK_THAT(smooth.energy, WithinRel(-5.7e-3, 0.02));
  // of the environment alone, without an observer: it loses a quarter of what PO/PC does
  const auto alone = attacks::drop(shaped_by(reference, ph::no_observer{}));
  CHECK_THAT(alone.swing, WithinRel(42.6e-3, 0.01));
  CHECK_THAT(alone.energy, WithinRel(-4.13e-3, 0.02));
}

TEST_CASE("reference_energy is not passive either, with strict_bound behind it it is",
          "[time domain]") {
  CHECK(tapped(shaped_by(ph::reference_energy_with_damping{{.max_damping = 50.0}})) < -1e-3);
  CHECK(tapped(shaped_by(reference)) < -1e-3);
  CHECK(tapped(model_of<d1>(ph::strict_bound{}, thesis_loop,
                            ph::shaped{ph::spring{}, reference})) >= -1e-12);
}

TEST_CASE("reference_energy takes new parameters, refuses bad ones and starts anew",
          "[time domain]") {
  const ph::reference_energy weaker{.controller = {.max_damping = 10.0}},
      bad{.controller = {.max_damping = 50.0}, .part = 1.1};
  check_upkeep(shaped_by(reference), reference, weaker, bad);
}
