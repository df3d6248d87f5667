// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A set of one contact with the interface of a local_model, so that both are judged and timed alike.

#include <passive_haptics/passive_haptics.hpp>

namespace experiments {

template <class Space, class Friction, class Observer, class Bound, class Limits>
class set_of_one : public passive_haptics::passive_port<
                       Space,
                       passive_haptics::contact_set<
                           Friction, passive_haptics::slots<passive_haptics::half_space<Space>, 1>>,
                       Observer, Bound, Limits> {
  using set =
      passive_haptics::contact_set<Friction,
                                   passive_haptics::slots<passive_haptics::half_space<Space>, 1>>;
  using base = passive_haptics::passive_port<Space, set, Observer, Bound, Limits>;

 public:
  using constraint_type = passive_haptics::half_space<Space>;

  set_of_one(Space /*scene*/, const passive_haptics::proxy_spring& spring,
             const passive_haptics::pursuit& pace, const Friction& friction,
             const Observer& observer, const Bound& bound, const Limits& limits) noexcept
      : base(Space{}, set(spring, pace, friction, {}), observer, bound, limits) {}

  bool update(const constraint_type& next) noexcept { return this->source().update(0, next); }
  [[nodiscard]] const constraint_type& local() const noexcept { return target(); }
  [[nodiscard]] const constraint_type& target() const noexcept {
    return this->source().slot(0).target();
  }
};

}  // namespace experiments
