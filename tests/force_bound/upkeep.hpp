// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The duties of every part of a composition: its laws, parameters that change while it works, and reset().
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>

#include <string>
#include <vector>

/// The laws that a policy breaks at these ports, with the number of the port; empty if none.
template <class... Ports, class Policy>
std::string broken_laws(const Policy& policy) {
  std::string all;
  int number = 0;
  const auto one = [&](const ph::laws::verdict& found) {
    ++number;
    if (!found) all += std::to_string(number) + ": " + found.broken + " ";
  };
  (one(ph::laws::all<Policy, Ports>(policy)), ...);
  return all;
}

/// The name of the first parameter refused, empty if all are taken.
template <class Parameters>
std::string refused(const Parameters& p) {
  const auto fault = p.check();
  return fault ? fault.parameter : "";
}

/// A hand about the surface of a wall that jumps now and then; the forces and the energies.
template <class Model>
std::vector<double> run_of(Model& model, int ticks, std::uint64_t seed) {
  ph::laws::samples random(seed);
  std::vector<double> seen;
  double x = 0.0;
  for (int n = 0; n < ticks; ++n) {
    if (n % 60 == 0) (void)model.update({random.number<double>() * 1e-3, -1.0, 1e4});
    x = 0.9 * x + random.number<double>() * 3e-4;
    const auto out = model.tick(x, ph::seconds{0.5e-3 * (1.5 + random.number<double>() / 2.0)});
    seen.insert(seen.end(), {out.force, out.energy});
  }
  return seen;
}

/// set() keeps the ledger and all that the part remembers, a fault changes nothing, and reset() leads
/// back to the start. `same` is what `fresh` was made with.
template <class Model, class Parameters>
void check_upkeep(const Model& fresh, const Parameters& same, const Parameters& other,
                  const Parameters& bad) {
  REQUIRE_FALSE(fresh.check());
  Model used = fresh;
  const std::vector<double> first = run_of(used, 300, 1);
  Model untouched = used;
  const std::vector<double> next = run_of(untouched, 300, 2);

  Model kept = used;
  CHECK_FALSE(kept.set(same));
  CHECK((run_of(kept, 300, 2) == next));
  Model refusing = used;
  const auto fault = refusing.set(bad);
  REQUIRE(fault);
  CHECK(std::string(fault.parameter) == refused(bad));
  CHECK((run_of(refusing, 300, 2) == next));
  Model changed = used;
  CHECK_FALSE(changed.set(other));
  CHECK(changed.energy() == used.energy());
  CHECK((run_of(changed, 300, 2) != next));  // the control: they say something

  Model restarted = used;
  restarted.reset();
  CHECK((run_of(restarted, 300, 1) == first));
  CHECK((run_of(used, 300, 1) != first));  // the control
}
