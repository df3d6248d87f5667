// SPDX-License-Identifier: BSD-3-Clause
// What is known of devices says where it is from, and is of the size that devices have.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/identification/device_facts.hpp>

#include <string>
#include <vector>

namespace design = ph::design;
namespace devices = ph::design::devices;
using design::evidence;

namespace {

// nobody publishes these, so nothing in the list may say it does
constexpr bool nothing_is_invented() {
  for (const auto& device : devices::all) {
    if (device.damping || device.presliding) return false;
  }
  return true;
}
static_assert(nothing_is_invented());
static_assert(!devices::falcon.mass && !devices::falcon.friction);
static_assert(devices::falcon.peak_force.value == 8.0 && devices::falcon.peak_force.verified());
static_assert(devices::touch.friction && !devices::touch.friction.verified());
static_assert(devices::omega.quantum[2].from == evidence::unverified);
static_assert(!design::fact{} && !design::fact{}.verified());

std::vector<design::fact> facts_of(const design::device_facts& d) {
  return {d.mass,       d.damping,    d.friction,        d.presliding,       d.quantum[0],
          d.quantum[1], d.quantum[2], d.peak_force,      d.continuous_force, d.stiffness,
          d.rate,       d.latency,    d.workspace_radius};
}

}  // namespace

TEST_CASE("every fact of a device says where it is from, and what is not known is nothing",
          "[design][devices]") {
  int known = 0, verified = 0;
  for (const auto& device : devices::all) {
    CAPTURE(device.name);
    CHECK(std::string(device.name).size() > 3);
    for (const auto& fact : facts_of(device)) {
      CHECK((fact.from == evidence::none) == std::string(fact.source).empty());
      CHECK(fact.value >= 0.0);
      if (!fact) CHECK(fact.value == 0.0);
      known += fact ? 1 : 0;
      verified += fact.verified() ? 1 : 0;
    }
    const auto within = [](const design::fact& f, double low, double high) {
      return !f || (f.value >= low && f.value <= high);
    };
    CHECK(within(device.mass, 0.01, 2.0));
    CHECK(within(device.friction, 0.0, 2.0));
    CHECK(within(device.quantum[0], 1e-7, 1e-3));
    CHECK(within(device.peak_force, 1.0, 100.0));
    CHECK(within(device.stiffness, 100.0, 1e5));
    if (device.continuous_force) CHECK(device.continuous_force.value < device.peak_force.value);
  }
  CHECK(known > 60);
  CHECK(verified > 30);
  CHECK(verified < known);
}

TEST_CASE("evidence has a name", "[design][devices]") {
  for (const auto from : {evidence::none, evidence::measured, evidence::datasheet, evidence::paper,
                          evidence::software, evidence::unverified}) {
    CHECK(std::string(to_string(from)) != "unknown evidence");
  }
  CHECK(std::string(to_string(static_cast<evidence>(99))) == "unknown evidence");
}
