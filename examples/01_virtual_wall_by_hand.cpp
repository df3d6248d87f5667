// SPDX-License-Identifier: BSD-3-Clause
// 01_virtual_wall.cpp on plain scalars: the same equations, the same output, no library.
//
// It is short because it leaves out everything but the equations: no check of the samples, no
// vectors, no moving surface, no other bound. The one thing to get right is the order: the ledger
// pairs a displacement with the force held WHILE it happened, so it comes before the new force.

#include <algorithm>
#include <cmath>
#include <cstdio>

int main() {
  const double K = 2500.0;  // stiffness of the wall, N/m
  const double b = 0.5;     // damping of the device, N·s/m
  const double dt = 1e-3;   // s
  const double B = b / dt;  // N/m

  double energy = 0.0;  // E1, J
  double force = 0.0;   // on the device, N
  double last = 3e-3;   // the position one tick ago, m

  std::puts("   x [mm]   force [N]  energy [mJ]");
  for (const double millimetres :
       {3., 2., 1., 0., -1., -2., -3., -4., -4., -3., -2., -1., 0., 1.}) {
    const double x = millimetres * 1e-3;
    const double displacement = x - last;
    last = x;
    energy += B * displacement * displacement - force * displacement;

    const double desired = K * std::max(0.0, -x);
    const double allowed = std::sqrt(4.0 * B * std::max(energy, 0.0));
    force = std::min(desired, allowed);
    std::printf("%9.1f %11.3f %12.3f%s\n", millimetres, force, energy * 1e3,
                desired > allowed ? "  limited" : "");
  }
}
