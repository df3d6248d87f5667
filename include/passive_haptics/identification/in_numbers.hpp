// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What limits a stiffness or a force, with its numbers, and by how much what raises it would have to change:
//
//     std::puts(ph::identification::in_numbers(touch.explain()).c_str());    // not in a tick: it allocates
//     2500 of 10000 N/m. A mass that is sampled … raises it. For 10000 N/m: 4 times the mass, or 0.5 times the
//     longest tick, unless another limit binds then.

#include <passive_haptics/base/explanation.hpp>
#include <passive_haptics/identification/describe.hpp>

#include <cmath>
#include <string>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// because(), after the force, or else the stiffness, that is shown, and of how much; then the change that would show the
/// stiffness asked for, or twice the present one of a force whose stiffness is unknown. On encoders it is a sufficient one:
/// with step, presliding and tick times 1/n all terms of the inequality of design/stiffness_budget.hpp are equal at n K.
[[nodiscard]] inline std::string in_numbers(const explanation& e) {
  using detail::text;
  const bool asks = std::isfinite(e.asked);
  if (e.now != softened_by::nothing) {
    if (!asks || !(e.depth > 0.0)) return text("%.3g N. ", e.force) + e.because();
    const double wanted = e.shown * e.depth;
    std::string all = text("%.3g of %.3g N. ", e.force, wanted) + e.because();
    if (e.now == softened_by::motors) all += text(" Motors of %.3g N would hold it.", wanted);
    return all;
  }
  if (!(e.shown > 0.0)) return e.because();  // there is no stiffness to raise
  const double goal = asks ? e.asked : 2.0 * e.shown, n = goal / e.shown;
  std::string all =
      asks ? text("%.0f of %.0f N/m. ", e.shown, e.asked) : text("At most %.0f N/m. ", e.shown);
  all += e.because();
  const std::string least = text(" For %.0f N/m: ", goal);
  switch (e.stiffness) {
    case softened_by::mass_and_tick:
      all +=
          least + text("%.3g times the mass, or %.3g times the longest tick", n, std::sqrt(1 / n));
      break;
    case softened_by::damping_and_tick:
      all += least + text("%.3g times the damping, or %.3g times the longest tick", n, 1 / n);
      break;
    case softened_by::encoder_steps:
      all +=
          least + text("%.3g times the encoder step, the presliding and the longest tick", 1 / n);
      break;
    case softened_by::coupling:
      return all + text(" It has %.0f N/m; %.0f N/m would show 95 %% of the surface.",
                        e.shown * e.asked / (e.asked - e.shown), 19.0 * e.asked);
    default:
      return all;
  }
  return all + ", unless another limit binds then.";
}

/// The same of a budget: the limit that binds, and the next one, up to which less of it raises the stiffness.
[[nodiscard]] inline std::string in_numbers(const design::budget& b) {
  using design::stiffness_limit;
  stiffness_limit next = stiffness_limit::not_stated;
  for (int i = 0; i < static_cast<int>(b.limits.size()); ++i) {
    const auto which = static_cast<stiffness_limit>(i);
    const bool lower = next == stiffness_limit::not_stated || b.limit(which) < b.limit(next);
    if (which != b.binding && lower) next = which;
  }
  if (b.binding == stiffness_limit::not_stated) return b.because();
  return detail::text("%.0f N/m by %s. ", b.stiffness, to_string(b.binding)) + b.because() +
         detail::text(" Without it: %.0f N/m by %s.", b.limit(next), to_string(next));
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
