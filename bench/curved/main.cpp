// SPDX-License-Identifier: BSD-3-Clause
// What a surface costs: its bytes, a probe, a prepare(). The table of docs/design/curved.md.
#include "support/curved.hpp"
#include <passive_haptics/laws.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string_view>
#include <vector>

namespace {

using curved::Vector3d;

/// The least of 15 runs, in nanoseconds for one of `count` calls.
double nanoseconds(int count, const auto& call) {
  double least = 1e9;
  for (int run = 0; run < 15; ++run) {
    const auto start = std::chrono::steady_clock::now();
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += call(i);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    volatile double kept = sum;
    static_cast<void>(kept);
    least = std::min(least, taken.count() / count);
  }
  return least;
}

template <class S>
void row(const char* name, auto surface) {
  using vector = typename S::vector;
  if (!surface.prepare()) {
    std::printf("%s cannot be used\n", name);
    return;
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  const auto place = ph::laws::where_to_look<S>(surface);
  std::vector<vector> points;
  for (int i = 0; i < 1024; ++i) {
    points.push_back(vector(place.centre) +
                     place.radius * curved::of<S>({in(random), in(random), 0.2 * in(random)}));
  }
  const double probe = nanoseconds(200000, [&](int i) {
    const auto& x = points[static_cast<std::size_t>(i & 1023)];
    const auto seen = surface.at(x);
    const vector push = ph::detail::steepest_push<S>(seen);
    return static_cast<double>(seen.depth + push(2)) + (seen.covered() ? 1.0 : 0.0);
  });
  const auto before = surface;
  const double prepare = nanoseconds(20000, [&](int i) {
    auto next = before;
    next.stiffness += typename S::scalar(i & 7);
    return next.prepare() ? static_cast<double>(next.at(points[0]).depth) : 0.0;
  });
  std::printf("| %-28s | %5zu | %7.1f | %7.1f |\n", name, sizeof(surface), probe, prepare);
}

/// A patch that is full: a fan of M triangles around a node.
template <class S, std::size_t M>
ph::patch<S, M> fan() {
  ph::patch<S, M> p;
  for (std::size_t i = 0; i < M; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * static_cast<double>(i) / double(M);
    p.nodes[i + 1] = curved::of<S>({0.02 * std::cos(angle), 0.02 * std::sin(angle), -0.005});
    p.triangles[i] = {0, static_cast<std::uint8_t>(i + 1),
                      static_cast<std::uint8_t>(i + 1 == M ? 1 : i + 2)};
  }
  p.node_count = M + 1;
  p.triangle_count = M;
  p.stiffness = 500;
  return p;
}

template <class S>
void table() {
  const char* const names[] = {"half_space",
                               "triangle",
                               "sphere",
                               "sphere, from inside",
                               "quadric",
                               "shell<point_core>",
                               "shell<segment_core>",
                               "shell<box_core>",
                               "shell<triangle_core>",
                               "distance_brick",
                               "distance_field, ellipsoid",
                               "patch, 4 triangles"};
  std::printf("| %-28s | bytes | ns a probe | ns a prepare |\n|---|---|---|---|\n",
              sizeof(typename S::scalar) == 4 ? "float" : "double");
  std::size_t i = 0;
  curved::every_surface<S>([&](const auto& surface) { row<S>(names[i++], surface); });
  row<S>("patch, 16 triangles", fan<S, 16>());
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 1) {
    const std::string_view option = arguments[1];
    const bool asked = option == "--help" || option == "-h";
    std::fprintf(
        asked ? stdout : stderr,
        "usage: curved [--help]\n\nPrints the bytes of every surface, and the nanoseconds that\n"
        "a probe and prepare() take here.\nThe probe holds depth, push and covered.\n");
    return asked ? 0 : 2;
  }
  table<d3>();
  table<f3>();
}
