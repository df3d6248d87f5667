// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The phase of an experiment, and the time spent in it.

#include <passive_haptics/base/language.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

template <class Phase>
class timed_phase {
 public:
  explicit timed_phase(Phase first) noexcept : now_(first) {}

  void enter(Phase next) noexcept {
    now_ = next;
    lasted_ = 0.0;
  }
  /// Adds a tick of that length [s].
  void lasts(double dt) noexcept { lasted_ += dt; }
  /// The time since the phase was entered [s].
  [[nodiscard]] double lasted() const noexcept { return lasted_; }
  [[nodiscard]] operator Phase() const noexcept { return now_; }

 private:
  Phase now_;
  double lasted_ = 0.0;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
