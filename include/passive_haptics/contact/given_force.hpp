// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force in, force out: a source for whoever has a force already, from a renderer, a simulator, an SDK.
//
//     ph::passive_port device{scene{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03},
//                             ph::strict_bound{}, ph::loop_limits{.longest_tick = 0.0011}};
//     motors.command(device.tick(position, ph::seconds{dt}, wanted).force);     // a new force in every tick
//     motors.command(device.tick(position, ph::seconds{dt}).force);             // none: the last one grows older

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/port/freshness.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Asks for the effort it was given last. One that grows stale fades, because a renderer that has
/// crashed would push for ever; one that is no number is refused and the last good one stays. Works at
/// any port: forces [N] in a space, torques [N·m] in joint coordinates.
struct given_force {
  double stale_after = 0.1;  ///< age up to which an effort counts in full [s]
  double fade = 0.05;        ///< how long it then takes to end [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    return freshness{stale_after, fade}.check();
  }
  template <port P>
  class on;
};

template <port P>
class given_force::on {
 public:
  using scalar = typename P::scalar;
  using effort = typename P::effort;
  using result_type = port_result<P>;
  static constexpr bool asks_for_numbers = true;

  constexpr explicit on(const given_force& p) noexcept : news_({p.stale_after, p.fade}) { reset(); }
  constexpr void set(const given_force& p) noexcept { news_.set({p.stale_after, p.fade}); }
  [[nodiscard]] constexpr given_force parameters() const noexcept {
    const freshness rule = news_.parameters();
    return {.stale_after = rule.stale_after, .fade = rule.fade};
  }
  constexpr void reset() noexcept {
    news_.reset();
    newest_ = P::zero();
    changed_ = refused_ = false;
  }

  /// A new effort for the coming ticks. False: it is no number, and the last good one stays.
  constexpr bool update(const effort& wanted) noexcept {
    if (!P::is_finite(wanted)) {
      refused_ = true;
      return false;
    }
    newest_ = wanted;
    changed_ = true;
    news_.hear();
    return true;
  }
  /// Nothing is wanted any more: the effort fades, as one that is stale does, and ends.
  constexpr void release() noexcept { news_.release(); }

  /// The last good one, however old.
  [[nodiscard]] constexpr effort newest() const noexcept { return newest_; }

  struct request {
    effort wanted;
    bool nothing = false;  ///< there is always something to ask
  };
  template <bool Shortcut>
  [[nodiscard, gnu::always_inline]] constexpr request ask(const auto& /*motion*/, const auto& port,
                                                          event& what) noexcept {
    if (refused_) what = detail::worse_yet(what, event::rejected_target);
    if (!news_.heard()) what = detail::worse_yet(what, event::no_target);
    if (!changed_) news_.grow_older(port.dt);
    changed_ = refused_ = false;
    const effort newest = newest_;
    if (news_.current()) [[likely]] {
      return {newest};
    }
    if (news_.stale()) what = detail::worse_yet(what, event::stale_target);
    return {effort(newest * news_.weight())};
  }
  [[nodiscard, gnu::always_inline]] constexpr result_type answered(
      const request& /*asked*/, const port_result<P>& port) const noexcept {
    return port;
  }
  constexpr result_type refused(const port_result<P>& port, scalar dt) noexcept {
    news_.grow_older(dt);
    return port;
  }

 private:
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS part_at<freshness, P> news_;
  bool changed_ = false, refused_ = false;
  typename P::stored_effort newest_{};
};

}  // namespace v0
}  // namespace passive_haptics
