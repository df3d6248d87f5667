// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Triangles that a finger touches while another thread moves them.
//
//     ph::mesh::surface organ(triangles, nodes);     // any thread, once
//     if (!organ.update(nodes)) log(organ.fault());  // slow thread, whenever the nodes have moved
//     organ.update(pose);                            // slow thread, where the whole of it has moved
//
// The slow thread copies the nodes and fits the tree's boxes; the haptic thread takes what is ready, and neither
// waits: of four copies the haptic thread holds two, the one that it comes from and the one that it goes to, one
// lies ready, and one is free to be filled. Sides do not matter: a surface may be open, inside out, cross itself,
// have three triangles at an edge, or some without an area. What is no mesh is refused with a sentence, and the
// last good one stays.

#include <passive_haptics/base/exchange.hpp>
#include <passive_haptics/mesh/box_tree.hpp>
#include <passive_haptics/mesh/pose.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

/// The numbers of three nodes.
using triangle = std::array<int, 3>;

/// The nodes at one time, and the boxes around them.
struct shape {
  std::vector<triple> nodes;
  std::vector<box> boxes;
};

namespace detail {
/// The nodes of any container whose elements have [0], [1] and [2].
template <class Nodes>
[[nodiscard]] triple node_of(const Nodes& nodes, std::size_t i) {
  if constexpr (requires { triple(nodes[i]); }) {
    return nodes[i];
  } else {
    return {static_cast<double>(nodes[i][0]), static_cast<double>(nodes[i][1]),
            static_cast<double>(nodes[i][2])};
  }
}
}  // namespace detail

class surface {
 public:
  static constexpr std::size_t most_triangles = 50'000'000;

  /// What is wrong with a mesh and what to do, or an empty text. Nodes [m] are std::array<double, 3>,
  /// Eigen::Vector3d, mesh::triple: whatever has three numbers.
  template <class Nodes>
  [[nodiscard]] static std::string check(std::span<const triangle> triangles, const Nodes& nodes) {
    if (triangles.empty()) {
      return "mesh: it has no triangles, so nothing can be touched; give one at least";
    }
    if (triangles.size() > most_triangles) {
      return "mesh: " + std::to_string(triangles.size()) + " triangles are more than " +
             std::to_string(most_triangles) + "; give a coarser one";
    }
    const std::size_t count = nodes.size();
    std::size_t with_area = 0;
    std::string fault = not_finite(nodes);
    if (!fault.empty()) return fault;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (const int node : triangles[i]) {
        if (node < 0 || static_cast<std::size_t>(node) >= count) {
          return "mesh: triangle " + std::to_string(i) + " names node " + std::to_string(node) +
                 " of " + std::to_string(count) + "; count nodes from 0";
        }
      }
      const triple a = detail::node_of(nodes, at(triangles[i][0]));
      const triple b = detail::node_of(nodes, at(triangles[i][1]));
      const triple c = detail::node_of(nodes, at(triangles[i][2]));
      with_area += squared(cross(b - a, c - a)) > 0.0 ? 1 : 0;
    }
    if (with_area == 0) {
      return "mesh: none of its " + std::to_string(triangles.size()) +
             " triangles has an area, so it may be passed through; are all nodes at one place?";
    }
    return {};
  }

  /// The mesh must pass check(): throws its sentence as std::invalid_argument. It is moved by no one: a port
  /// holds its address.
  template <class Nodes>
  surface(std::vector<triangle> triangles, const Nodes& nodes)
      : triangles_(believed(std::move(triangles), nodes)), tree_(centres(triangles_, nodes)) {
    fill(0, nodes);
    for (std::size_t i = 1; i < copies; ++i) free_[i].store(true);
  }
  surface(const surface&) = delete;
  surface& operator=(const surface&) = delete;

  // ------------------------------------------------------------------------------------ the slow thread
  /// The nodes are there now [m]. False: fault() says why, and what was last good stays. It does not allocate
  /// after three good ones.
  template <class Nodes>
  requires requires(const Nodes& n) { n.size(); }
  bool update(const Nodes& nodes) {
    if (nodes.size() != shapes_[0].nodes.size()) {
      fault_ = "mesh: news of " + std::to_string(nodes.size()) + " nodes for a mesh of " +
               std::to_string(shapes_[0].nodes.size()) +
               "; another topology is another mesh::surface";
      return false;
    }
    if (std::string fault = not_finite(nodes); !fault.empty()) {
      fault_ = std::move(fault);
      return false;
    }
    int copy = spare_;
    for (int i = 0; copy < 0; i = (i + 1) % int(copies)) {
      if (free_[at(i)].exchange(false)) copy = i;  // one is free: see above
    }
    fill(copy, nodes);
    spare_ = ready_.exchange(copy);  // what nobody has fetched is filled again
    fault_.clear();
    return true;
  }
  /// The whole of it is there now. False: a number is not finite, or the quaternion has no length.
  bool update(pose where) {
    if (!where.prepare()) {
      fault_ =
          "mesh: a pose with a number that is not finite, or a quaternion without a length; give "
          "metres and w, x, y, z";
      return false;
    }
    poses_.publish(where);
    fault_.clear();
    return true;
  }
  /// Why the last update was refused; empty if it was not.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

  // ---------------------------------------------------------------------------------- the haptic thread
  [[nodiscard]] const box_tree& tree() const noexcept { return tree_; }
  [[nodiscard]] std::span<const triangle> triangles() const noexcept { return triangles_; }
  /// Is there a newer shape than the last one taken?
  [[nodiscard]] bool has_news() const noexcept { return ready_.load() >= 0; }
  /// The shapes that are felt: on the way from one to the other, or both the same.
  [[nodiscard]] const shape& from() const noexcept { return shapes_[at(from_)]; }
  [[nodiscard]] const shape& to() const noexcept { return shapes_[at(to_)]; }
  [[nodiscard]] bool moves() const noexcept { return from_ != to_; }
  /// Goes to the newest shape, if one came; only from one that is arrived at.
  bool go() noexcept {
    if (moves() || !has_news()) return false;
    to_ = ready_.exchange(-1);
    return true;
  }
  /// The one that it went to is felt, or the one that it came from; the other is free.
  void arrive() noexcept { leave(std::exchange(from_, to_)); }
  void turn_back() noexcept { leave(std::exchange(to_, from_)); }
  /// The newest pose, if one came since the last call.
  [[nodiscard]] const pose* take_pose() noexcept { return poses_.take(); }

 private:
  static constexpr std::size_t copies = 4;
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

  void leave(int left) noexcept {
    if (left != from_) free_[at(left)].store(true);
  }
  template <class Nodes>
  [[nodiscard]] static std::string not_finite(const Nodes& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const triple p = detail::node_of(nodes, i);
      if (!is_finite(p) || !(squared(p) < 1e12)) {
        return "mesh: node " + std::to_string(i) +
               " is not finite, or farther than 1000 km; give metres";
      }
    }
    return {};
  }
  template <class Nodes>
  [[nodiscard]] static std::vector<triangle> believed(std::vector<triangle> triangles,
                                                      const Nodes& nodes) {
    if (const std::string fault = check(triangles, nodes); !fault.empty()) {
#if defined(__cpp_exceptions)
      throw std::invalid_argument(fault);
#else
      std::fprintf(stderr, "passive_haptics, mesh: %s\n", fault.c_str());
      std::abort();
#endif
    }
    return triangles;
  }
  template <class Nodes>
  [[nodiscard]] static std::vector<triple> centres(std::span<const triangle> triangles,
                                                   const Nodes& nodes) {
    std::vector<triple> all(triangles.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const int node : triangles[i]) all[i] = all[i] + detail::node_of(nodes, at(node));
      all[i] = all[i] * (1.0 / 3.0);
    }
    return all;
  }
  template <class Nodes>
  void fill(int number, const Nodes& nodes) {
    shape& s = shapes_[at(number)];
    s.nodes.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) s.nodes[i] = detail::node_of(nodes, i);
    s.boxes.resize(tree_.branches().size());
    tree_.fit(s.boxes, [&](int t, box& b) {
      for (const int node : triangles_[at(t)]) b.grow(s.nodes[at(node)]);
    });
  }

  std::vector<triangle> triangles_;
  box_tree tree_;
  std::array<shape, copies> shapes_;
  std::array<std::atomic<bool>, copies> free_{};
  std::atomic<int> ready_{-1};
  int spare_ = -1;         // the slow thread's own
  int from_ = 0, to_ = 0;  // the haptic thread's own
  exchange<pose> poses_;
  std::string fault_;
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
