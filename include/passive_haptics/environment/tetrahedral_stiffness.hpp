// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stiffness matrix of an elastic body made of linear tetrahedra.
//
//   K_ab = V (λ g_a g_bᵀ + μ g_b g_aᵀ + μ (g_a·g_b) I)      3×3 block of nodes a, b of one element
//   λ = Eν/((1 + ν)(1 − 2ν)),  μ = E/(2(1 + ν))             Lamé's constants [Pa]
//
// g_a [1/m] is the gradient of the shape function of node a, V [m³] the volume. Strains are small and
// constant in each element; as ν → 0.5 the elements lock. Source: Zienkiewicz and Taylor, The Finite
// Element Method, vol. 1.

#include <passive_haptics/environment/mesh.hpp>
#include <passive_haptics/environment/node_graph.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// A homogeneous isotropic material.
struct material {
  double young;    ///< E [Pa], > 0
  double poisson;  ///< ν, −1 < ν < 0.5

  [[nodiscard]] double lame() const noexcept {
    return young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  }
  [[nodiscard]] double shear() const noexcept { return young / (2.0 * (1.0 + poisson)); }
};

/// Throws std::invalid_argument for a material that stores no energy when it is strained.
inline void check(const material& m) {
  if (!(m.young > 0.0) || !std::isfinite(m.young)) {
    refuse_argument("material: Young's modulus ", m.young,
                    " Pa is refused; give a finite one above zero");
  }
  if (!(m.poisson > -1.0 && m.poisson < 0.5)) {
    refuse_argument("material: Poisson's ratio ", m.poisson,
                    " is refused; it lies between -1 and 0.5, both excluded");
  }
}

/// Gradients of the four shape functions [1/m]: g_a is the inward area vector of the face opposite a, over 3V.
[[nodiscard]] inline std::array<Eigen::Vector3d, 4> shape_gradients(
    const tetrahedral_mesh& mesh, const std::array<int, 4>& tetrahedron) {
  const auto node = [&](std::size_t k) { return triple_of(mesh.nodes[slot(tetrahedron[k])]); };
  const auto origin = node(0);
  const auto a = node(1) - origin, b = node(2) - origin, c = node(3) - origin;
  const double per_volume6 = 1.0 / (6.0 * signed_volume(mesh, tetrahedron));
  const auto one = cross(b, c) * per_volume6, two = cross(c, a) * per_volume6,
             three = cross(a, b) * per_volume6;
  return {vector_of((one + two + three) * -1.0), vector_of(one), vector_of(two), vector_of(three)};
}

/// The numbers of the nodes in the reduced system: 3·result[node] is the first of the three rows of a free
/// node, and −1 stands for a fixed one. Throws std::invalid_argument for a fixed node that does not exist.
[[nodiscard]] inline std::vector<int> free_numbers(const tetrahedral_mesh& mesh,
                                                   std::span<const int> fixed_nodes) {
  std::vector<int> number(mesh.nodes.size(), 0);
  for (const int node : fixed_nodes) {
    if (node < 0 || node >= static_cast<int>(number.size())) {
      refuse_argument("fixed node ", node, " is refused; the mesh has nodes 0 to ",
                      number.size() - 1);
    }
    number[static_cast<std::size_t>(node)] = -1;
  }
  int next = 0;
  for (int& n : number) {
    if (n == 0) n = next++;
  }
  return number;
}

/// K [N/m] of the free nodes of this graph and these numbers, symmetric, with three rows per node; the rows and
/// columns of fixed nodes are struck out (thesis A.5).
[[nodiscard]] inline Eigen::SparseMatrix<double> stiffness_matrix(const tetrahedral_mesh& mesh,
                                                                  const material& m,
                                                                  const std::vector<int>& number,
                                                                  const node_graph& graph) {
  check(m);
  // A node has three columns, each with three rows for every neighbour and for the node itself, sorted.
  const int size = graph.size();
  Eigen::SparseMatrix<double> result(3 * size, 3 * size);
  result.resizeNonZeros(9 * (static_cast<Eigen::Index>(graph.neighbours.size()) + size));
  int next = 0;
  for (int node = 0; node < size; ++node) {
    const auto beside = graph.neighbours_of(node);
    for (int c = 0; c < 3; ++c) {
      result.outerIndexPtr()[3 * node + c] = next;
      const auto add = [&](int row_node) {
        for (int i = 0; i < 3; ++i) result.innerIndexPtr()[next++] = 3 * row_node + i;
      };
      const auto above = std::lower_bound(beside.begin(), beside.end(), node);
      std::for_each(beside.begin(), above, add);
      add(node);
      std::for_each(above, beside.end(), add);
    }
  }
  result.outerIndexPtr()[3 * size] = next;
  std::fill_n(result.valuePtr(), next, 0.0);
  // The block of nodes whose gradients are a and b, times `volume`.
  const auto add_block = [&](int row, int column, double volume, const Eigen::Vector3d& a,
                             const Eigen::Vector3d& b) {
    const double across = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const auto beside = graph.neighbours_of(column);
    auto place = std::lower_bound(beside.begin(), beside.end(), row) - beside.begin();
    if (row > column) ++place;  // the node itself is among them
    for (int j = 0; j < 3; ++j) {
      double* const values = result.valuePtr() + result.outerIndexPtr()[3 * column + j] + 3 * place;
      for (int i = 0; i < 3; ++i) {
        values[i] += volume * (m.lame() * a[i] * b[j] + m.shear() * b[i] * a[j] +
                               (i == j ? m.shear() * across : 0.0));
      }
    }
  };
  for (const auto& tetrahedron : mesh.tetrahedra) {
    const auto g = shape_gradients(mesh, tetrahedron);
    const double volume = signed_volume(mesh, tetrahedron);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        const int row = number[slot(tetrahedron[a])], column = number[slot(tetrahedron[b])];
        if (row < 0 || column < 0) continue;
        add_block(row, column, volume, g[a], g[b]);
      }
    }
  }
  return result;
}

/// The same for a mesh with fixed nodes; without fixed nodes it is the whole, singular matrix. The mesh must
/// pass check().
[[nodiscard]] inline Eigen::SparseMatrix<double> stiffness_matrix(
    const tetrahedral_mesh& mesh, const material& m, std::span<const int> fixed_nodes = {}) {
  const std::vector<int> number = free_numbers(mesh, fixed_nodes);
  return stiffness_matrix(mesh, m, number, graph_of(mesh, number));
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
