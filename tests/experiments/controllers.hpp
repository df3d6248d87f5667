// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the tests of bench/controllers share: controllers by name, and liars.
#include "../bench/controllers/compose.hpp"
#include "../bench/controllers/program.hpp"

namespace controllers {

inline const controller& named(const std::string& name) {
  for (const auto& c : catalogue()) {
    if (c.name == name) return c;
  }
  throw std::invalid_argument("no controller " + name);
}

/// Lets everything through, and says that it is safe.
template <ph::guarantee Claim>
struct liar : ph::no_bound {
  static constexpr ph::guarantee passivity = Claim;
  template <class Port>
  struct on : ph::no_bound::on<Port> {
    constexpr explicit on(const liar& p) noexcept : ph::no_bound::on<Port>(p) {}
  };
};
template <ph::guarantee Claim>
controller lying(const std::string& name) {
  return entry<3>({name, "a lie"}, [](const premises& p) {
    return parts{wall(p), ledger(p), liar<Claim>{}};
  });
}

inline bool mentions(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

}  // namespace controllers
