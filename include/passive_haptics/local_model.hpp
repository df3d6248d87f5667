// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The passive local model: a passive port with one contact, composed in one line.

#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/port/passive_port.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Compose by value; class template argument deduction finds the type:
///     ph::local_model wall{scene{},
///                          ph::fixed{ph::half_space<scene>{0.0, -1.0, 1e4}},
///                          ph::turn_at_once{},
///                          ph::spring{},
///                          ph::reduced_energy{.damping = 0.03},
///                          ph::strict_bound{},
///                          ph::loop_limits{.longest_tick = 0.0011}};
///     device.command(wall.tick(position, ph::seconds{dt}).force);
/// As a member of a class, spell it: ph::local_model<scene, ph::fixed<ph::half_space<scene>>,
/// ph::turn_at_once, ph::spring, ph::reduced_energy, ph::strict_bound>. ONE PER DEVICE: two walls are two
/// contacts of one port (contact/contacts.hpp).
template <class Space, class Supply, class Normals, class Law, class Observer, class Bound,
          class Limits = loop_limits, class Motion = last_difference>
class local_model : public passive_port<Space, local_contact<Space, Supply, Normals, Law>, Observer,
                                        Bound, Limits, Motion> {
  using contact_type = local_contact<Space, Supply, Normals, Law>;
  using base = passive_port<Space, contact_type, Observer, Bound, Limits, Motion>;

 public:
  using space_type = Space;
  using constraint_type = typename Supply::constraint_type;
  using typename base::scalar;

  constexpr local_model() noexcept = default;
  constexpr local_model(Space /*scene*/, const Supply& supply, const Normals& normals,
                        const Law& law, const Observer& observer, const Bound& bound,
                        const Limits& limits, const Motion& estimator = {}) noexcept
      : base(Space{}, contact_type{supply, normals, law}, observer, bound, limits, estimator) {}

  /// Takes the environment's newest constraint; release() ends it. See local_contact.
  template <class Owner = Supply>
  requires(Owner::moves) constexpr news_taken<scalar> update(const constraint_type& next) noexcept {
    [[maybe_unused]] const auto alone = this->one_call();
    if (!this->source().update(next)) return {};
    return {true, shown_stiffness(this->target().stiffness)};
  }
  /// The same, with the velocity [m/s] and the age [s] of the surface: {.velocity = v, .age = 0.02}. The contact uses
  /// its present position, extrapolated by contact/lag.hpp. For laws that are `eased`.
  template <class Owner = Supply>
  requires(Owner::moves&& detail::eases_news<part_at<Law, Space>>) constexpr news_taken<
      scalar> update(const constraint_type& next, const surface_motion<Space>& how) noexcept {
    [[maybe_unused]] const auto alone = this->one_call();
    if (!this->source().update(next, how)) return {};
    return {true, shown_stiffness(this->target().stiffness)};
  }
  template <class Owner = Supply>
  requires(Owner::moves) constexpr void release() noexcept {
    [[maybe_unused]] const auto alone = this->one_call();
    this->source().release();
  }

  [[nodiscard]] constexpr const constraint_type& local() const noexcept {
    return this->source().local();
  }
  [[nodiscard]] constexpr const constraint_type& target() const noexcept {
    return this->source().target();
  }
  [[nodiscard]] constexpr const auto& law() const noexcept { return this->source().law(); }

  /// The largest step of the force [N] when a surface of K [N/m] is pressed, also at rest: K_s √(Σ qᵢ²), K_s [N/m] the
  /// stiffness displayed and qᵢ the encoder steps of the ledger, if all axes step at once (K_s q for one axis). No law
  /// of the depth steps by less (docs/design/settling.md). It is 0 if the ledger takes positions as exact.
  [[nodiscard]] constexpr scalar force_step(scalar K) const noexcept {
    if constexpr (Observer::exact) {
      return 0;
    } else {
      return this->observer().travel_error() * shown_stiffness(K);
    }
  }

 private:
  [[nodiscard]] constexpr scalar shown_stiffness(scalar K) const noexcept {
    return this->source().shown_stiffness(K, this->longest_tick(), base::latency);
  }
};

/// Deduction guides for a local_model that lacks its limits or its law, so that the compiler names what is missing.
template <class Space, class Supply, class Normals, class Law, class Observer, class Bound>
requires contact_law_for<Law, Space> local_model(Space, Supply, Normals, Law, Observer, Bound)
->local_model<Space, Supply, Normals, Law, Observer, Bound, detail::left_out>;
template <class Space, class Supply, class Normals, class Observer, class Bound, class Limits>
local_model(Space, Supply, Normals, Observer, Bound, Limits)
    -> local_model<Space, Supply, Normals, detail::left_out, Observer, Bound, Limits>;

}  // namespace v0
}  // namespace passive_haptics
