// SPDX-License-Identifier: BSD-3-Clause
// One, three or six degrees of freedom, chosen when the program runs: a std::variant of ports. A tick has no virtual
// call, only the branch of std::visit; who visits the variant with the whole loop has not even that.

#include <passive_haptics/six_dof.hpp>

#include <cstdio>
#include <variant>

namespace ph = passive_haptics;
using line = ph::space<double, 1>;
using point = ph::space<double, 3>;
using body = ph::rigid_body<double>;
using any_port = std::variant<ph::force_guard<line>, ph::force_guard<point>,
                              ph::strict_guard<body, ph::rigid_actuator_limit, ph::rigid_damping>>;

any_port make_port(int freedom) {
  const ph::exact_device device{
      .mass = 0.1, .damping = 0.3, .force_limit = 9.0, .longest_tick = 1e-3};
  const ph::known_hand hand{.force = 5.0};
  if (freedom == 1) return ph::make_guard<line>(device, hand);
  if (freedom == 3) return ph::make_guard<point>(device, hand);
  return ph::make_strict_guard<body, ph::rigid_damping>(
      {.linear = 0.3, .angular = 1e-3}, ph::rigid_actuator_limit{.force = 9.0, .torque = 0.5},
      1e-3);
}

/// As SDKs have it: position [m], quaternion w x y z, and the wrench [N, N·m] that is wanted, then allowed.
struct raw {
  double position[3]{}, turned[4]{1, 0, 0, 0}, wrench[6]{};
};

ph::event tick(any_port& any, raw& r, ph::seconds<double> dt) {
  const auto one_tick = [&](auto& port) {
    using space = typename std::remove_cvref_t<decltype(port)>::port_type;
    if constexpr (space::dof == 1) {
      const auto out = port.tick(r.position[0], dt, r.wrench[0]);
      r.wrench[0] = out.force;
      return out.what;
    } else {
      Eigen::Map<typename space::effort> wrench(r.wrench);
      const auto& [p, q, f] = r;
      typename space::pose x{};
      if constexpr (space::dof == 3) x = {p[0], p[1], p[2]};
      if constexpr (space::dof == 6) x = {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
      const auto out = port.tick(x, dt, wrench);
      wrench = out.force;
      return out.what;
    }
  };
  return std::visit(one_tick, any);
}

int main() {
  for (const int freedom : {1, 3, 6}) {
    any_port port = make_port(freedom);
    raw r;
    for (int ms = 0; ms < 400; ++ms) {  // a hand presses 2 mm deep into 1000 N/m, and stays
      r.position[0] = -1e-5 * (ms < 200 ? ms : 200);
      r.wrench[0] = -1000.0 * r.position[0];
      if (tick(port, r, ph::seconds{1e-3}) != ph::event::nominal) return 1;
    }
    std::printf("%d: %.2f of 2.00 N\n", freedom, r.wrench[0]);
  }
}
