// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The error of a measured position: each component is off by at most half a step, |x̂ᵢ − xᵢ| ≤ qᵢ/2. This describes
// encoder steps, apart from a constant shift, and any noise of at most ±q/2.
//
//   encoder_step         one q for every axis                    converts from a number
//   encoder_steps<Dof>   a q for each axis, or for each joint

#include <passive_haptics/base/parameter.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

[[nodiscard]] constexpr parameter_fault step_fault(double width) noexcept {
  if (not_negative(width)) return {};
  return {"quantum", width, "finite and ≥ 0 m"};
}

/// The bounds that a ledger derives from the steps. `Self::along_axis(i)` is the step qᵢ of axis i.
template <class Self, class P>
class known_to_a_step {
 public:
  using scalar = typename P::scalar;

  /// What a ledger may give back of `doubt`: nothing, because no position is known better than to a step.
  struct owed {
    [[nodiscard]] constexpr owed charged(const auto&, const auto&) const noexcept { return {}; }
  };
  /// ½ Σ qᵢ|fᵢ| [J], rounded up: the largest error of the work of f that one end of a motion can cause.
  [[nodiscard]] constexpr scalar doubt(const typename P::effort& f) const noexcept {
    const scalar up = (scalar(1) + kernels::rounding<scalar>()) / scalar(2);
    if constexpr (Self::alike) {
      scalar sum = kernels::magnitude(P::component(f, 0));
      for (int i = 1; i < P::dof; ++i) sum += kernels::magnitude(P::component(f, i));
      return up * self().along_axis(0) * sum;
    } else {
      scalar sum(0);
      for (int i = 0; i < P::dof; ++i) {
        sum += self().along_axis(i) * kernels::magnitude(P::component(f, i));
      }
      return up * sum;
    }
  }
  /// The measured motion Δx̂, shortened by qᵢ on each axis i: the least true motion [m].
  [[nodiscard]] constexpr typename P::motion surely(
      const typename P::motion& shown) const noexcept {
    typename P::motion least = shown;
    for (int i = 0; i < P::dof; ++i) {
      const scalar way = P::component(shown, i), q = self().along_axis(i);
      P::component(least, i) = way - kernels::clamped(way, scalar(-q), q);
    }
    return least;
  }
  /// √(Σ qᵢ²), the largest distance between the true Δx and the measured Δx̂ [m].
  [[nodiscard]] constexpr scalar travel_error() const noexcept {
    if constexpr (Self::alike) return self().along_axis(0) * kernels::square_root(scalar(P::dof));
    scalar sum(0);
    for (int i = 0; i < P::dof; ++i) sum += self().along_axis(i) * self().along_axis(i);
    return kernels::square_root(sum);
  }

 private:
  [[nodiscard]] constexpr const Self& self() const noexcept {
    return static_cast<const Self&>(*this);
  }
};

}  // namespace detail

/// One step q for every axis. It converts from a number, as in `.quantum = 55e-6`.
struct encoder_step {
  double width{};  ///< q [m], an upper bound of one step; joints: [rad]

  constexpr encoder_step() noexcept = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number with a name
  constexpr encoder_step(double q) noexcept : width(q) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return detail::step_fault(width);
  }

  template <class P>
  class on : public detail::known_to_a_step<on<P>, P> {
   public:
    using scalar = typename P::scalar;
    static constexpr bool alike = true;
    constexpr explicit on(const encoder_step& p) noexcept
        : width_(detail::number<scalar>(p.width)) {}
    [[nodiscard]] constexpr encoder_step parameters() const noexcept {
      return static_cast<double>(width_);
    }
    [[nodiscard]] constexpr scalar along_axis(int /*i*/) const noexcept { return width_; }

   private:
    scalar width_;
  };
};

/// A step qᵢ for each axis of a space, or for each joint.
template <int Dof>
struct encoder_steps {
  std::array<double, static_cast<std::size_t>(Dof)>
      widths{};  ///< qᵢ [m], upper bounds; joints: [rad]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (const double q : widths) {
      if (const auto fault = detail::step_fault(q)) return fault;
    }
    return {};
  }

  template <class P>
  class on : public detail::known_to_a_step<on<P>, P> {
   public:
    using scalar = typename P::scalar;
    static constexpr bool alike = false;
    static_assert(P::dof == Dof,
                  "passive_haptics: encoder_steps needs one number for each axis of the port");

    constexpr explicit on(const encoder_steps& p) noexcept
        : q_(detail::numbers<scalar>(p.widths)) {}
    [[nodiscard]] constexpr encoder_steps parameters() const noexcept {
      return {detail::numbers<double>(q_)};
    }
    [[nodiscard]] constexpr scalar along_axis(int i) const noexcept {
      return q_[static_cast<std::size_t>(i)];
    }

   private:
    std::array<scalar, static_cast<std::size_t>(Dof)> q_;
  };
};

}  // namespace v0
}  // namespace passive_haptics
