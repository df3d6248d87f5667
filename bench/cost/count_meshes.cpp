// SPDX-License-Identifier: BSD-3-Clause
// Ticks of a finger on meshes of 72 to 10⁶ triangles, which callgrind counts one by one: each is a dump of its own,
// whose name says the triangles, the speed [m/s] and the news a second.

#include <passive_haptics/mesh/proxy.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>

namespace {

namespace mesh = passive_haptics::mesh;
using mesh::triple;

constexpr double half = 0.05, curvature = 20.0;  // [m], [1/m]
double height(double x, double y) {
  return -0.5 * curvature * (x * x + y * y);
}

/// A dome of 100 mm in n × n squares, two triangles each, `up` times as high as height() says.
std::vector<triple> nodes(int n, double up) {
  std::vector<triple> all;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = half * (2.0 * i / n - 1.0), y = half * (2.0 * j / n - 1.0);
      all.push_back({x, y, up * height(x, y)});
    }
  }
  return all;
}
std::vector<mesh::triangle> triangles(int n) {
  std::vector<mesh::triangle> all;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      all.insert(all.end(), {{a, a + 1, b + 1}, {a, b + 1, b}});
    }
  }
  return all;
}

/// A finger of r = 0.5 mm goes round a circle of 30 mm, pressed 2 mm in; each tick from the 40th on is counted.
void stroke(int n, double speed, int news) {
  constexpr int approach = 40, ticks = 340;
  mesh::surface dome(triangles(n), nodes(n, 1.0));
  mesh::proxy finger({.radius = 5e-4});
  finger.touch(dome);
  const std::string name =
      std::to_string(2 * n * n) + " " + std::to_string(speed) + " " + std::to_string(news);
  for (int k = 0; k < ticks; ++k) {
    if (news > 0 && k % (1000 / news) == 0) {
      dome.update(nodes(n, 1.0 + 0.05 * std::sin(6.0 * 1e-3 * k)));
    }
    const double angle = speed * 1e-3 * k / 0.03, x = 0.03 * std::cos(angle),
                 y = 0.03 * std::sin(angle);
    const triple device{x, y, height(x, y) + 2e-3 - 4e-3 * std::min(1.0, 1.5 * k / approach)};
    if (k == approach) CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    finger.step(device, 1e-3);
    if (k >= approach) CALLGRIND_DUMP_STATS_AT(name.c_str());
    if (k >= approach && !(length(finger.push()) > 1e-3)) {
      std::fprintf(stderr, "%s: not pressed in tick %d\n", name.c_str(), k);
      std::exit(1);
    }
  }
  CALLGRIND_STOP_INSTRUMENTATION;
}

}  // namespace

int main() {
  for (const int n : {6, 25, 101, 404, 708}) {
    for (const double speed : {0.1, 1.0}) stroke(n, speed, 0);
    if (n == 25 || n == 101) stroke(n, 0.1, 30);
  }
}
#else
int main() {}  // no header of valgrind, nothing to count
#endif
