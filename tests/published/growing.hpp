// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Shapers that begin soft and grow stiff, and two to compare them with: growth that nobody pays for,
// and growth that the ledger pays for with no bound behind it.
#include "force_bound/attacks.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/published/stiffness_augmentation.hpp>

inline constexpr ph::nonlinear_coupling coupling{.initial = 50, .rate = 2e5};
inline constexpr ph::stiffness_increment increments{.initial = 50, .step = 500};
inline constexpr ph::force_augmentation offsets{.low = 50, .step = 0.5};

/// Grows by `step` a tick [N/m], as far as the ledger has to spare what that costs, or in any case.
template <bool Paid>
struct plain_growth {
  static constexpr bool needs_local_model = false;
  static constexpr bool needs_ledger = Paid;
  double initial = 50.0, step = 200.0, most = 1e4;

  template <class Space>
  class on {
   public:
    constexpr explicit on(const plain_growth& p) noexcept : p_(p) {}
    constexpr void reset() noexcept { stiffness_ = 0.0; }
    [[nodiscard]] constexpr typename Space::vector shape(const typename Space::vector& desired,
                                                         const ph::contact_state<Space>& contact,
                                                         const auto& port) noexcept {
      const double d = contact.target_depth;
      if (!(d > 0.0)) {
        stiffness_ = 0.0;
        return desired;
      }
      if constexpr (Paid) {
        stiffness_ = std::max(stiffness_, p_.initial);
        const double f = stiffness_ * d;
        const double spare =
            port.credit() - std::max(f * d / 2, port.damping.worst_outflow(f, 1e-3));
        const double growth = std::min({p_.step, p_.most - stiffness_, 2.0 * spare / (d * d)});
        stiffness_ += std::max(growth, 0.0);
      } else {
        stiffness_ = std::clamp(stiffness_ + p_.step, p_.initial, p_.most);
      }
      return contact.normal * stiffness_ * d;
    }

   private:
    plain_growth p_;
    double stiffness_ = 0.0;
  };
};
using unpaid_growth = plain_growth<false>;
using guard_alone = plain_growth<true>;

/// In random contacts the shaper leaves a share, and with the bound behind it no more than the ledger
/// covers.
template <class Space, class Shaper, class Bound = ph::strict_bound>
constexpr bool obeys(const Shaper& parameters, int ticks, const Bound& behind = {}) {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  auto shaper = at<Space>(parameters);
  auto bound = at<Space>(behind);
  ph::laws::random_port<Space> port(3);
  ph::laws::samples random(5);
  for (int i = 0; i < ticks; ++i) {
    const auto now = port.next();
    const scalar d = random.number<scalar>() * scalar(0.01);
    const scalar K = scalar(5000) * (scalar(1.1) + random.number<scalar>());
    const ph::contact_state<Space> contact{
        random.direction<Space>(), K, d, d, scalar(0), i % 7 == 0};
    const vector desired = contact.normal * (d > scalar(0) ? K * d : scalar(0));
    const auto left = shaper.shape(desired, contact, now);
    static_assert(std::same_as<decltype(left), const ph::share<scalar>>);
    if (!(left.factor >= scalar(0) && left.factor <= scalar(1))) return false;
    const vector force =
        ph::detail::applied<Space>(bound, vector(desired * left.factor), now).force;
    const scalar outflow = now.damping.worst_outflow(force, now.longest_tick);
    if (outflow > ph::kernels::larger(now.credit(), scalar(0))) return false;
  }
  return true;
}

/// The least port energy [J] of a wall with this shaper and that bound behind it.
template <class Space, class Shaper, class Bound = ph::strict_bound>
double least_of_growing(const Shaper& shaper, const attacks::conditions& when, int seeds,
                        const Bound& bound = {}) {
  const ph::loop_limits limits{
      .longest_tick = when.longest_tick, .top_speed = 100.0, .watchdog = when.longest_tick};
  const auto model =
      following_half_space<Space>(ph::shaped{ph::spring{}, shaper}, thesis_ledger(), bound, limits);
  return attacks::worst_of<Space>(model, when, seeds).least;
}
