// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Break-away force and presliding displacement, from a force g [N] that grows slowly until the device slips.
//
// Up to break-away the device gives way elastically, x = C g [m], and p = C times the break-away force. The slip is
// detected late, when the device has gone some steps: under a force R t beyond friction a mass m goes R t³/(6 m) [m],
// and against a damper alone R t²/(2 b). The growth of g in the sum of both times is subtracted, so the break-away
// force is a lower bound; with a Stribeck curve the device goes faster, so it is lower still.

#include <passive_haptics/base/kernels.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// The numbers that determine how late a slip is detected.
struct slip_detection {
  double rate = 0.0;     ///< R [N/s]
  double mass = 0.0;     ///< m [kg]
  double damping = 0.0;  ///< b [N·s/m]
  double step = 0.0;     ///< q [m]
};

class friction_ramp {
 public:
  enum class state : std::uint8_t { holding, broken, backwards };

  /// Begins with a new device, whose friction is about `level` [N].
  void begin_all(double level) noexcept {
    *this = {};
    width_ = level / 24.0;
  }
  /// Begins a ramp towards `way`, +1 or −1, from rest at `position` [m].
  void begin(int way, double position) noexcept {
    way_ = way;
    reference_ = position;
    bins_.fill({});
  }
  /// Adds a position x [m] under the force g [N] along the way. The device counts as slipped at `distant` [m].
  state book(double g, double x, double distant) noexcept {
    const double gone = way_ * (x - reference_);
    bin& b = bins_[(std::min)(static_cast<std::size_t>(g / width_), bins_.size() - 1)];
    b.gone += gone;
    b.force += g;
    ++b.count;
    return gone > distant ? state::broken : gone < -distant ? state::backwards : state::holding;
  }
  /// Ends a ramp whose slip was detected at g [N] and `distant` [m]. If `counts`, its displacement is used for C: only
  /// after an earlier slip, because a device parked by a controller rests near the edges of the steps.
  void conclude(double g, double distant, bool counts, const slip_detection& by) noexcept {
    double low = kernels::larger(g - gained(by, distant + by.step), 0.0);
    const double softness =
        kernels::smaller(between(0.15 * low, 0.5 * low), between(0.5 * low, 0.8 * low));
    double wobble = 0.0;  // swing of the mass on friction's spring [m]
    for (const bin& b : bins_) {
      if (b.count == 0 || b.mean_force() > 0.4 * low) continue;
      wobble = kernels::larger(wobble, b.mean_gone() - softness * b.mean_force());
    }
    const double close = 1.2 * by.step + 10e-6 + 1.5 * wobble;
    for (const bin& b : bins_) {
      if (b.count == 0 || b.mean_force() < 0.4 * low) continue;
      if (b.mean_gone() - softness * b.mean_force() > close) {
        low = kernels::larger(0.0, b.mean_force() - gained(by, close + by.step));
        break;
      }
    }
    auto& of = ways_[way_ > 0 ? 1 : 0];
    of.least = kernels::smaller(of.least, low);
    of.most = kernels::larger(of.most, g);
    of.largest_low = kernels::larger(of.largest_low, low);
    if (!counts || !(low > 0.0)) return;
    early_.book(between(0.15 * low, 0.5 * low), 0.325 * low);
    late_.book(between(0.5 * low, 0.8 * low), 0.65 * low);
  }

  [[nodiscard]] int way() const noexcept { return way_; }
  [[nodiscard]] int count() const noexcept { return late_.count; }
  /// The least and the largest break-away force, going forward (1) or backward (0) [N].
  [[nodiscard]] double least(int forward) const noexcept { return side(forward).least; }
  [[nodiscard]] double most(int forward) const noexcept { return side(forward).most; }
  [[nodiscard]] double least() const noexcept { return kernels::smaller(least(0), least(1)); }
  [[nodiscard]] double most() const noexcept { return kernels::larger(most(0), most(1)); }
  /// The share of its mean by which the break-away force varies from place to place, 0 to 1.
  [[nodiscard]] double unevenness() const noexcept {
    double worst = 0.0;
    for (const auto& one : ways_) {
      if (!(one.largest_low > 0.0)) return 1.0;
      worst = kernels::larger(worst, (one.largest_low - one.least) / (one.largest_low + one.least));
    }
    return worst;
  }
  /// C [m/N]: its mean, and a bound three deviations above that for positions known to `step` [m]. Where friction
  /// rises along the way the device moves before it breaks away, and the C of large forces is too large. So the smaller
  /// of the C of small and of large forces is taken, although steps disturb the former more.
  [[nodiscard]] double compliance() const noexcept {
    return kernels::larger(kernels::smaller(early_.mean(), late_.mean()), 0.0);
  }
  [[nodiscard]] double compliance_at_most(double step) const noexcept {
    return kernels::smaller(early_.at_most(step), late_.at_most(step));
  }

 private:
  struct bin {
    double gone = 0.0, force = 0.0;
    int count = 0;
    [[nodiscard]] double mean_gone() const noexcept { return gone / count; }
    [[nodiscard]] double mean_force() const noexcept { return force / count; }
  };
  /// Displacement over force [m/N], summed over several ramps.
  struct give {
    double sum = 0.0, squares = 0.0, forces = 0.0;
    int count = 0;

    void book(double compliance, double force) noexcept {
      ++count;
      sum += compliance;
      squares += compliance * compliance;
      forces += force;
    }
    [[nodiscard]] double mean() const noexcept { return count > 0 ? sum / count : 0.0; }
    [[nodiscard]] double at_most(double step) const noexcept {
      if (count < 4) return std::numeric_limits<double>::infinity();
      const double n = count;
      const double spread = kernels::larger(squares / n - mean() * mean(), 0.0) / (n - 1.0);
      const double rounded = 0.41 * step / (forces / n) / std::sqrt(n);  // √(1/6) q: two positions
      return kernels::larger(mean(), 0.0) + 3.0 * kernels::larger(std::sqrt(spread), rounded);
    }
  };
  struct one_way {
    double least = std::numeric_limits<double>::infinity(), most = 0.0, largest_low = 0.0;
  };
  [[nodiscard]] const one_way& side(int forward) const noexcept {
    return ways_[forward > 0 ? 1 : 0];
  }

  /// The growth of the ramp [N] while a slip goes `distant` [m].
  [[nodiscard]] static double gained(const slip_detection& by, double distant) noexcept {
    return by.rate * (std::cbrt(6.0 * by.mass * distant / by.rate) +
                      std::sqrt(2.0 * kernels::larger(by.damping, 0.0) * distant / by.rate));
  }
  /// Displacement over force [m/N] for the forces from g1 to g2 [N].
  [[nodiscard]] double between(double g1, double g2) const noexcept {
    double gone = 0.0, force = 0.0;
    for (const bin& b : bins_) {
      if (b.count == 0 || b.mean_force() < g1 || b.mean_force() > g2) continue;
      gone += b.gone;
      force += b.force;
    }
    return force > 0.0 ? gone / force : 0.0;
  }

  std::array<bin, 112> bins_{};
  std::array<one_way, 2> ways_{};
  double width_ = 1.0, reference_ = 0.0;
  give early_, late_;
  int way_ = 1;
};

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
