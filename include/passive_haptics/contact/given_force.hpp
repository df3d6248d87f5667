// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Force in, force out: a source for a force that a renderer, a simulator or an SDK computes.
//
//     ph::passive_port device{scene{}, ph::given_force{}, ph::reduced_energy{.damping = 0.03},
//                             ph::strict_bound{}, ph::loop_limits{.longest_tick = 0.0011}};
//     motors.command(device.tick(position, ph::seconds{dt}, wanted).force);     // a new force in every tick
//     motors.command(device.tick(position, ph::seconds{dt}).force);             // the last force again, now older

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/port/concepts.hpp>
#include <passive_haptics/port/freshness.hpp>

namespace passive_haptics {
inline namespace v0 {

/// The desired effort is the last one that was passed. A stale effort fades, because a renderer that has crashed
/// would otherwise push for ever; one that is not finite is refused, and the last good one stays. It works at any
/// port: forces [N] in a space, torques [N·m] in joint coordinates.
struct given_force {
  double stale_after = 0.1;  ///< age up to which an effort is not reduced [s]
  double fade = 0.05;        ///< time in which it then fades to zero [s]

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

  /// A new effort for the coming ticks. Returns false if it is not finite; then the last good one stays.
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
  /// Ends the effort, which fades as a stale one does.
  constexpr void release() noexcept { news_.release(); }

  /// The last good effort, of any age.
  [[nodiscard]] constexpr effort newest() const noexcept { return newest_; }

  struct request {
    effort wanted;
    bool nothing = false;  ///< an effort is always desired
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
