// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The laws of each role: properties of a policy that a concept cannot check. Each law is a predicate over a policy
// of YOURS, which is tried with repeatable random samples. Laws are constexpr, so in one dimension
//     static_assert(ph::laws::all<my_bound, scene>());
// compiles, and in any dimension CHECK(...) tries them at run time. all<Policy, Port>() tries the laws of the roles
// that the policy models, except those marked *, and names the first that it breaks. A surface is tried in the
// neighbourhood that its around() returns, else within a metre of the origin. The laws:
//
//   any          models_a_role: it models one of the concepts of the roles below
//   damping      covers_the_worst_motion, affords_what_is_there
//   inertia      is_a_norm
//   observer     never_overstates, forfeit_never_credits, books_numbers_only, reset_forgets
//   bound        answers_with_a_number, scales_down, loses_to_no_motion (of a strict one), reset_starts_anew;
//              * spends_at_most_the_ledger, which not all strict bounds obey
//   normal       stays_a_normal; * turns_at_most
//   contact law  presses_outwards
//   constraint   measures_depth, where depth is the distance: its probe has no push()
//   surface      refuses_no_stiffness, has_a_unit_normal, pushes_along_its_gradient, changes_depth_steadily
//   supply     * keeps_the_newest

#include <passive_haptics/laws/contact_laws.hpp>
#include <passive_haptics/laws/port_laws.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace laws {

/// Tries the laws of every role that `policy` models at `Port`. A policy that models none breaks models_a_role.
template <class Policy, class Port>
[[nodiscard]] constexpr verdict all(const Policy& policy = {}) noexcept {
  constexpr bool of_a_port = damping_for<Policy, Port> || inertia_for<Policy, Port> ||
                             energy_observer_for<Policy, Port> || force_bound_for<Policy, Port>;
  constexpr bool of_a_contact = [] {
    if constexpr (detail::has_geometry<Port>) {
      return normal_interpolation_for<Policy, Port> || contact_law_for<Policy, Port> ||
             surface_for<Policy, Port>;
    }
    return false;
  }();
  if constexpr (!of_a_port && !of_a_contact) return {"models_a_role"};
  if constexpr (damping_for<Policy, Port>) {
    if (!covers_the_worst_motion<Port>(policy)) return {"covers_the_worst_motion"};
    if (!affords_what_is_there<Port>(policy)) return {"affords_what_is_there"};
  }
  if constexpr (inertia_for<Policy, Port>) {
    if (!is_a_norm<Port>(policy)) return {"is_a_norm"};
  }
  if constexpr (energy_observer_for<Policy, Port>) {
    if constexpr (Policy::counts) {
      if (!never_overstates<Port>(policy)) return {"never_overstates"};
      if (!forfeit_never_credits<Port>(policy)) return {"forfeit_never_credits"};
      if (!books_numbers_only<Port>(policy)) return {"books_numbers_only"};
      if (!reset_forgets<Port>(policy)) return {"reset_forgets"};
    }
  }
  if constexpr (force_bound_for<Policy, Port>) {
    if (!answers_with_a_number<Port>(policy)) return {"answers_with_a_number"};
    using state = typename random_port<Port>::state_type;
    if constexpr (detail::reduces<Policy, Port, state>()) {
      if (!scales_down<Port>(policy)) return {"scales_down"};
    }
    if constexpr (promise_of<Policy, Port>() == guarantee::strict) {
      if (!loses_to_no_motion<Port>(policy)) return {"loses_to_no_motion"};
    }
    if (!reset_starts_anew<Port>(policy)) return {"reset_starts_anew"};
  }
  if constexpr (of_a_contact) {
    if constexpr (normal_interpolation_for<Policy, Port>) {
      if (!stays_a_normal<Port>(policy)) return {"stays_a_normal"};
    }
    if constexpr (contact_law_for<Policy, Port>) {
      if (!presses_outwards<Port>(policy)) return {"presses_outwards"};
    }
    if constexpr (constraint_for<Policy, Port> && detail::measures_distance<Policy, Port>) {
      if (!measures_depth<Port>(policy)) return {"measures_depth"};
    }
    if constexpr (surface_for<Policy, Port>) {
      if (!refuses_no_stiffness<Port>(policy)) return {"refuses_no_stiffness"};
      if (!has_a_unit_normal<Port>(policy)) return {"has_a_unit_normal"};
      if (!pushes_along_its_gradient<Port>(policy)) return {"pushes_along_its_gradient"};
      if (!changes_depth_steadily<Port>(policy)) return {"changes_depth_steadily"};
    }
  }
  return {};
}

}  // namespace laws
}  // namespace v0
}  // namespace passive_haptics
