// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A set of numbers below N whose clear() takes constant time, except once in 2³² calls.

#include <passive_haptics/environment/node_graph.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// Until the first clear() all numbers are marked.
class marks {
 public:
  explicit marks(std::size_t count = 0) : when_(count, 0) {}

  void clear() noexcept {
    if (++now_ != 0) return;
    std::fill(when_.begin(), when_.end(), 0U);
    now_ = 1;
  }
  [[nodiscard]] bool has(int i) const { return when_[slot(i)] == now_; }
  /// Marks i; returns false if it was marked already.
  bool add(int i) {
    if (has(i)) return false;
    when_[slot(i)] = now_;
    return true;
  }

 private:
  std::vector<std::uint32_t> when_;  ///< number of the clear() after which each was marked last
  std::uint32_t now_ = 0;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
