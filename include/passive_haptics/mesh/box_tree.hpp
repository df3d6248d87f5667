// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A tree over numbered things that have a place. It finds those that are near without looking at all of them. The
// tree is a median split of the places at which it was made, and it does not change. The boxes are kept apart from
// it, so that one tree serves a body in several shapes. Once the boxes are fitted its answers are right however the
// things have moved, and it stays fast as long as neighbours stay neighbours.

#include <passive_haptics/mesh/triple.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

class box_tree {
 public:
  static constexpr int leaf_size = 4;
  /// The most branches that wait in a walk, which goes on with one child and puts off the other. The tree is
  /// balanced, so its depth bounds them.
  static constexpr std::size_t most_waiting = 64;

  /// A node of the tree; its left child comes right after it.
  struct branch {
    int right = -1;          ///< −1: a leaf
    int begin = 0, end = 0;  ///< its things in order()
    int parent = -1;
  };

  /// Makes the tree of things at these places [m]. A thing whose place is not finite gets any leaf.
  explicit box_tree(std::vector<triple> places) : order_(places.size()), leaf_of_(places.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    for (triple& p : places) {
      if (!is_finite(p)) p = {};
    }
    if (!places.empty()) split(places, 0, static_cast<int>(places.size()), -1);
    dirty_.assign(branches_.size(), 0);
    dirty_list_.reserve(branches_.size());
  }

  [[nodiscard]] std::span<const branch> branches() const noexcept { return branches_; }
  [[nodiscard]] const branch& operator[](int i) const noexcept { return branches_[at(i)]; }
  /// The things of a leaf.
  [[nodiscard]] std::span<const int> things(const branch& leaf) const noexcept {
    return std::span(order_).subspan(at(leaf.begin), at(leaf.end - leaf.begin));
  }

  /// Fits a box to each branch; grow(thing, box) makes a box large enough for a thing. Parents stand before
  /// children.
  template <class Grow>
  void fit(std::span<box> boxes, const Grow& grow) const {
    for (std::size_t b = branches_.size(); b-- > 0;) fit_one(b, boxes, grow);
  }
  /// The same if no other things than `moved` have moved.
  template <class Grow>
  void fit(std::span<box> boxes, std::span<const int> moved, const Grow& grow) {
    dirty_list_.clear();
    for (const int i : moved) {
      for (int b = leaf_of_[at(i)]; b >= 0 && !dirty_[at(b)]; b = branches_[at(b)].parent) {
        dirty_[at(b)] = 1;
        dirty_list_.push_back(b);
      }
    }
    std::sort(dirty_list_.begin(), dirty_list_.end());
    for (std::size_t k = dirty_list_.size(); k-- > 0;) {
      fit_one(at(dirty_list_[k]), boxes, grow);
      dirty_[at(dirty_list_[k])] = 0;
    }
  }

  /// Walks to the leaves, nearer ones first. bound(branch) returns the squared distance of a branch [m²], wants(d²)
  /// says whether a branch at that distance is still of interest, and visit(thing) is called for each thing found.
  template <class Bound, class Wants, class Visit>
  void walk(const Bound& bound, const Wants& wants, const Visit& visit) const {
    if (branches_.empty()) return;
    struct waiting {
      int branch;
      double distance2;
    };
    waiting stack[most_waiting];  // NOLINT(*-member-init): read below `height` only
    std::size_t height = 0;
    stack[height++] = {0, bound(0)};
    while (height > 0) {
      const waiting top = stack[--height];
      if (!wants(top.distance2)) continue;
      const branch& b = branches_[at(top.branch)];
      if (b.right < 0) {
        for (int k = b.begin; k < b.end; ++k) visit(order_[at(k)]);
        continue;
      }
      waiting left{top.branch + 1, bound(top.branch + 1)};
      waiting right{b.right, bound(b.right)};
      if (left.distance2 > right.distance2) std::swap(left, right);
      if (wants(right.distance2)) stack[height++] = right;
      if (wants(left.distance2)) stack[height++] = left;
    }
  }

 private:
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

  int split(const std::vector<triple>& places, int begin, int end, int parent) {
    const int me = static_cast<int>(branches_.size());
    branches_.push_back({.begin = begin, .end = end, .parent = parent});
    if (end - begin <= leaf_size) {
      for (int k = begin; k < end; ++k) leaf_of_[at(order_[at(k)])] = me;
      return me;
    }
    box extent;
    for (int k = begin; k < end; ++k) extent.grow(places[at(order_[at(k)])]);
    const triple sizes = extent.high - extent.low;
    const int axis = sizes.x >= sizes.y && sizes.x >= sizes.z ? 0 : sizes.y >= sizes.z ? 1 : 2;
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int a, int b) { return places[at(a)][axis] < places[at(b)][axis]; });
    split(places, begin, middle, me);
    const int right = split(places, middle, end, me);
    branches_[at(me)].right = right;
    return me;
  }

  template <class Grow>
  void fit_one(std::size_t number, std::span<box> boxes, const Grow& grow) const {
    const branch& b = branches_[number];
    box fitted;
    if (b.right >= 0) {
      fitted = boxes[number + 1];
      fitted.grow(boxes[at(b.right)]);
    } else {
      for (const int thing : things(b)) grow(thing, fitted);
    }
    boxes[number] = fitted;
  }

  std::vector<int> order_;    ///< the things, those of a branch side by side
  std::vector<int> leaf_of_;  ///< the leaf of each thing
  std::vector<branch> branches_;
  std::vector<char> dirty_;
  std::vector<int> dirty_list_;
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
