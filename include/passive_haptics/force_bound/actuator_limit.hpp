// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Limits that need no ledger.
//
//   actuator_limit    |f| ≤ limit of the motors         every device with motors needs one
//   motor_limits      |fᵢ| ≤ limit of motor i           for joints, or motors along the axes
//   thermal_limit     |f| ≤ peak, RMS ≤ continuous      thermal_limit.hpp
//   no_bound          f = f*                            for comparison, and for worlds passive by another proof

#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {

/// f = f*, the desired force. A sampled spring of K > 2b/T then creates K Δx²/2 − b Δx²/T [J] in each tick (L2).
struct no_bound {
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.exact_travel = false, .latency = any_latency};

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return {}; }

  template <port P>
  struct on {
    constexpr explicit on(const no_bound& /*p*/) noexcept {}
    [[nodiscard]] constexpr share<typename P::scalar> limit(const typename P::effort& /*desired*/,
                                                            const auto& /*state*/) const noexcept {
      return {typename P::scalar(1)};
    }
  };
};

/// |f| ≤ `most` [N], the largest force that the motors can hold; the direction is kept. Without this limit, or a
/// device that reports the held force, the ledger books a force that the motors never held (A28). A sample that
/// reports more than 2 `most` is rejected, because the motors cannot have held that.
struct actuator_limit {
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.exact_travel = false, .latency = any_latency};

  double most{};  ///< largest force [N]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (detail::not_negative(most)) return {};
    return {"most", most, "finite and ≥ 0 N; of a device: .force_limit > 0"};
  }

  template <port Space>
  class on {
   public:
    using scalar = typename Space::scalar;
    static_assert(detail::has_geometry<Space>,
                  "passive_haptics: actuator_limit bounds the length of a force: joints need "
                  "motor_limits");

    constexpr explicit on(const actuator_limit& p) noexcept
        : most_(detail::number<scalar>(p.most)) {}
    [[nodiscard]] constexpr actuator_limit parameters() const noexcept {
      return {static_cast<double>(most_)};
    }
    [[nodiscard]] constexpr share<scalar> limit(const typename Space::effort& desired,
                                                const auto& /*state*/) const noexcept {
      const scalar force = Space::norm(desired);
      return {force > most_ ? most_ / force : scalar(1)};
    }
    [[nodiscard]] constexpr typename Space::effort most_held() const noexcept {
      return detail::longest_held<Space>(most_);
    }
    [[nodiscard]] constexpr bool can_hold(const typename Space::effort& held) const noexcept {
      return detail::can_be_held(Space::norm(held), most_);
    }
    constexpr void explain(explanation& e, const auto& /*damping*/, scalar /*T*/,
                           int /*late*/) const noexcept {
      e.saturate(static_cast<double>(most_));
    }

   private:
    scalar most_;
  };
};

/// |fᵢ| ≤ mostᵢ for every axis or joint. One share min(1, mostᵢ/|fᵢ|) scales all of f, so the direction is kept.
template <int Dof>
struct motor_limits {
  static constexpr guarantee passivity = guarantee::none;
  static constexpr bound_traits traits{.exact_travel = false, .latency = any_latency};

  std::array<double, static_cast<std::size_t>(Dof)> most{};  ///< largest force [N]; joints: [N·m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (const double f : most) {
      if (!detail::not_negative(f)) return {"most", f, "every axis finite and ≥ 0 N"};
    }
    return {};
  }

  template <port P>
  class on {
   public:
    using scalar = typename P::scalar;
    static_assert(P::dof == Dof,
                  "passive_haptics: motor_limits needs one number for each axis of the port");

    constexpr explicit on(const motor_limits& p) noexcept
        : most_(detail::numbers<scalar>(p.most)) {}
    [[nodiscard]] constexpr motor_limits parameters() const noexcept {
      return {detail::numbers<double>(most_)};
    }
    [[nodiscard]] constexpr share<scalar> limit(const typename P::effort& desired,
                                                const auto& /*state*/) const noexcept {
      scalar least(1);
      for (int i = 0; i < Dof; ++i) {
        const scalar f = kernels::magnitude(P::component(desired, i));
        const scalar allowed = most_[static_cast<std::size_t>(i)];
        if (f * least > allowed) least = allowed / f;
      }
      return {least};
    }
    [[nodiscard]] constexpr bool can_hold(const typename P::effort& held) const noexcept {
      bool all = true;
      for (int i = 0; i < Dof; ++i) {
        all &= detail::can_be_held(kernels::magnitude(P::component(held, i)),
                                   most_[static_cast<std::size_t>(i)]);
      }
      return all;
    }

   private:
    std::array<scalar, static_cast<std::size_t>(Dof)> most_;
  };
};

static_assert(force_bound_for<no_bound, space<float, 1>>);
static_assert(force_bound_for<actuator_limit, space<float, 1>>);
static_assert(force_bound_for<motor_limits<1>, space<float, 1>>);

}  // namespace v0
}  // namespace passive_haptics
