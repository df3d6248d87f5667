// SPDX-License-Identifier: BSD-3-Clause
// A mesh out of an OBJ file, in millimetres: which number the first node has, in which unit the nodes are, and what
// check() says of a file that is no mesh. The name of a file of yours is the first argument.
#include <passive_haptics/mesh.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

struct mesh_file {
  std::vector<ph::mesh::triple> nodes;
  std::vector<ph::mesh::triangle> triangles;
};

mesh_file read_obj(std::istream& file, double unit) {
  mesh_file m;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind, corner;
    words >> kind;
    double x = 0.0, y = 0.0, z = 0.0;
    if (kind == "v" && words >> x >> y >> z) m.nodes.push_back({unit * x, unit * y, unit * z});
    std::vector<int> face;  // "7/2/5" is node 7; OBJ counts nodes from 1, a mesh from 0
    while (kind == "f" && words >> corner) face.push_back(std::atoi(corner.c_str()) - 1);
    for (std::size_t i = 2; i < face.size(); ++i) {
      m.triangles.push_back({face[0], face[i - 1], face[i]});
    }
  }
  return m;
}

// A roof of 100 mm, 20 mm high.
constexpr const char* roof =
    "v -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nv -50 0 20\nv 50 0 20\n"
    "f 1/1 2/2 6/3 5/4\nf 3 4 5 6\nf 1 5 4\nf 2 3 6\nf 1 4 3 2\n";

int main(int argc, char** argv) {
  std::istringstream built_in(roof);
  std::ifstream named(argc > 1 ? argv[1] : "");
  std::istream& file = argc > 1 ? static_cast<std::istream&>(named) : built_in;
  const mesh_file m = read_obj(file, 1e-3);  // millimetres
  if (const auto fault = ph::mesh::surface::check(m.triangles, m.nodes); !fault.empty()) {
    std::puts(fault.c_str());
    return 1;
  }
  if (const auto slip = ph::mesh::surface::doubt(m.nodes); !slip.empty()) std::puts(slip.c_str());
  ph::mesh::surface organ(m.triangles, m.nodes);

  auto touch = ph::make_mesh_touch<scene>(
      ph::exact_device{.mass = 0.1, .damping = 1.0, .force_limit = 9.0, .longest_tick = 1e-3},
      {.force = 5.0}, {.stiffness = 1000.0});
  if (!touch.source().touch(organ)) return 1;  // 64 fingers touch it already
  std::printf("%zu nodes, %zu triangles\n", m.nodes.size(), m.triangles.size());
  for (int tick = 0; tick <= 500; ++tick) {  // the finger comes down on the ridge by 0.1 m/s
    const double z = 0.06 - 1e-4 * tick;
    const auto out = touch.tick({0.0, 0.0, z}, ph::seconds{1e-3});
    if (tick % 100 == 0) std::printf("%5.1f mm high: %5.2f N\n", 1e3 * z, out.force(2));
  }
}
