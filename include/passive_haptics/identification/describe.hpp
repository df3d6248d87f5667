// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The result of an identification as text: a table, the composition to paste, and its stiffness budget.

#include <passive_haptics/identification/axis_found.hpp>

#include <cmath>
#include <cstdio>
#include <string>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

namespace detail {

/// The text of a printf of numbers.
template <class... Numbers>
[[nodiscard]] std::string text(const char* pattern, const Numbers&... numbers) {
  char line[1200];
  std::snprintf(line, sizeof line, pattern, numbers...);
  return line;
}
/// A bound > 0 in three digits: an upper bound is rounded up, a lower bound down; 0 for others.
[[nodiscard]] inline double rounded(double x, bool up) noexcept {
  if (!(x > 0.0)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 2.0);
  return (up ? std::ceil(x / unit - 1e-9) : std::floor(x / unit + 1e-9)) * unit;
}

/// The composition of a device with steps q [m] but without dry friction to pay for them, so the wall stays soft.
[[nodiscard]] inline std::string on_steps_alone(double m, double b, double F, double q, double T,
                                                int latency, double hand) {
  return text(
      "// By hand: no dry friction pays for the steps, so the wall is soft at first.\n"
      "ph::local_model wall{scene{},\n"
      "                     ph::followed<ph::half_space<scene>>{},\n"
      "                     ph::turn_limited{.rate = 2},\n"
      "                     ph::eased{ph::damped_spring{.mass = %.3g, .force_limit = %.3g}},\n"
      "                     ph::quantised_energy{.damping = %.3g, .quantum = %.3g},\n"
      "                     ph::bound_chain{\n"
      "                         ph::reachable_bound{.mass = %.3g, .hand_force = %.3g},\n"
      "                         ph::actuator_limit{.most = %.3g}},\n"
      "                     ph::late_loop_limits<%d>{.longest_tick = %.3g},\n"
      "                     ph::mass_observer{.mass = %.3g, .quantum = %.3g}};\n",
      m, F, b, q, m, hand, F, latency, T, m, q);
}

}  // namespace detail

/// What is wrong with an axis, a line each.
[[nodiscard]] inline std::string wrongs_of(const axis_found& a) {
  using detail::text;
  std::string all;
  for (std::size_t i = 0; i < disturbances; ++i) {
    const suspicion& s = a.wrong.all[i];
    const auto what = static_cast<disturbance>(i);
    if (!s.found) continue;
    all += std::string("  found: ") + to_string(what);
    switch (what) {
      case disturbance::hand:
        all += text(" of %.0f N/m", s.size);
        break;
      case disturbance::mode:
        all += text(" at %.0f Hz; %.0f %% of the mass moves with the encoder", s.size,
                    100.0 * s.where);
        break;
      case disturbance::backlash:
        all += text(" of %.0f µm", 1e6 * s.size);
        break;
      case disturbance::fraction:
        all += text(": the force is %.2f ticks late", s.size);
        break;
      case disturbance::filter:
        all += text(" of %.2f ms", 1e3 * s.size);
        break;
      case disturbance::cogging:
        all += text(" of %.3f N every %.2f mm", s.size, 1e3 * s.where);
        break;
      case disturbance::drift:
        all += text(" by %.0f %% of the force of a sweep", 100.0 * s.size);
        break;
    }
    all += text(" (%.0f deviations from none)\n", s.sure);
  }
  return all;
}

/// A table with one line for each number of an axis.
[[nodiscard]] inline std::string table_of(const axis_found& a) {
  using detail::text;
  if (a.problem != nullptr) return std::string("  ") + a.problem + '\n' + wrongs_of(a);
  std::string all;
  all += text("  mass                 at least %8.3f kg      likely %.3f\n", a.mass, a.likely_mass);
  if (a.rotor > 0.0) all += text("    with the encoder   at least %8.3f kg\n", a.rotor);
  all += a.damping > 0.0
             ? text("  damping              at least %8.3f N·s/m   likely %.3f, at most %.3f\n",
                    a.damping, a.likely_damping, a.damping_max)
             : text("  damping              not found               at most %.3f N·s/m\n",
                    a.damping_max);
  if (a.friction > 0.0) {
    all += text("  dry friction         at least %8.3f N       likely %.3f in motion\n", a.friction,
                a.likely_friction);
    all +=
        text("    breaks away at     %.3f to %.3f N forward, %.3f to %.3f N backward\n",
             a.breakaway_least[1], a.breakaway_most[1], a.breakaway_least[0], a.breakaway_most[0]);
    all += text("  presliding           at most  %8.1f µm      likely %.1f\n", 1e6 * a.presliding,
                1e6 * a.likely_presliding);
  } else {
    all += "  dry friction         not found\n";
  }
  if (a.remark != nullptr) all += std::string("    ") + a.remark + '\n';
  all += a.quantum > 0.0 ? text("  step of the position at most  %8.2f µm\n", 1e6 * a.quantum)
                         : std::string("  step of the position none seen\n");
  all += text("  noise beside it      at most  %8.2f µm\n", 1e6 * a.noise);
  all += text("  latency              %d ticks\n", a.latency);
  all += text("  longest tick seen    %.3f ms\n", 1e3 * a.longest_tick);
  all += text("  constant load        %.2f N; the motion is explained to %.2f %%\n", a.load,
              100.0 * a.explained);
  return all + wrongs_of(a);
}

/// The number of which more certainty would buy most, and the stiffness of walls with its most likely value [N/m].
struct certainty {
  const char* number = "";
  double stiffness = 0.0;
};
template <int Dof>
[[nodiscard]] certainty worth_knowing(const device_found<Dof>& found,
                                      const design::intended_use& use = {}) noexcept {
  const design::stated_device stated = found.stated();
  certainty best{"", design::stiffness_budget(stated, use).stiffness};
  const auto ask = [&](const char* number, double design::stated_device::*which, double likely) {
    design::stated_device d = stated;
    d.*which = likely;
    const double stiffness = likely > 0.0 ? design::stiffness_budget(d, use).stiffness : 0.0;
    if (stiffness > best.stiffness) best = {number, stiffness};
  };
  axis_found least = found.axes[0];
  for (const axis_found& a : found.axes) {
    least.likely_mass = kernels::smaller(least.likely_mass, a.likely_mass);
    least.likely_damping = kernels::smaller(least.likely_damping, a.likely_damping);
    least.likely_friction = kernels::smaller(least.likely_friction, a.likely_friction);
  }
  ask("mass", &design::stated_device::mass, least.likely_mass);
  ask("damping", &design::stated_device::damping, least.likely_damping * (1.0 - found.drift));
  if (stated.friction > 0.0) {
    ask("friction", &design::stated_device::friction, least.likely_friction * (1.0 - found.drift));
  }
  return best;
}

/// The composition with these bounds, as code to be pasted, and its stiffness budget.
template <int Dof>
[[nodiscard]] std::string composition_of(const device_found<Dof>& found,
                                         const design::intended_use& use = {}) {
  using detail::rounded;
  using detail::text;
  if (found.problem() != nullptr) return std::string(found.problem()) + '\n';
  const design::stated_device d = found.stated();
  if (!(d.damping > 0.0)) {
    return "There is no viscous damping to rely on, so no ledger can be composed: identify again "
           "with "
           "a longer stroke, a longer sweep_time or more force.\n";
  }
  const double m = rounded(d.mass, false), b = rounded(d.damping, false);
  const double F = rounded(d.force_limit, false), q = rounded(d.quantum, true);
  const double T = rounded(d.longest_tick, true);
  std::string all = text("using scene = ph::space<double, %d>;\n", Dof);
  if (found.drift > 0.0) {
    all += text("// Bounds, less %.0f %% of damping and friction for warmth and wear.\n",
                100.0 * found.drift);
  }
  if (q > 0.0 && !(d.friction > 0.0))
    return all + detail::on_steps_alone(m, b, F, q, T, found.latency(), use.hand_force);
  if (q > 0.0) {
    all += text(
        "constexpr ph::encoder_device device{.mass = %.3g,\n"
        "                                    .damping = %.3g,\n"
        "                                    .friction = %.3g,\n"
        "                                    .presliding = %.3g,\n"
        "                                    .quantum = %.3g,\n"
        "                                    .force_limit = %.3g,\n"
        "                                    .longest_tick = %.3g,\n"
        "                                    .latency = %d};\n",
        m, b, rounded(d.friction, false), rounded(d.presliding, true), q, F, T, d.latency);
  } else {
    all += text(
        "constexpr ph::exact_device device{\n"
        "    .mass = %.3g, .damping = %.3g, .force_limit = %.3g, .longest_tick = %.3g, .latency = "
        "%d};\n",
        m, b, F, T, d.latency);
  }
  all += text(
      "auto wall = ph::make_touch<scene, ph::half_space<scene>, ph::late_loop_limits<%d>>(\n"
      "    device, {.force = %.3g});\n",
      d.latency, use.hand_force);
  all += "// ph::any_hand in place of {.force = ...}: for any hand, and softer.\n";
  if (!(q > 0.0)) return all;
  const design::budget paid = design::stiffness_budget(d, use);
  all += text("// Its ledger pays for walls of up to %.0f N/m: %s binds.\n", paid.stiffness,
              to_string(paid.binding));
  all += std::string("// ") + paid.because() + '\n';
  const certainty best = worth_knowing(found, use);
  if (best.stiffness > 1.01 * paid.stiffness) {
    all += text(
        "// Were its %s known exactly: up to %.0f N/m; a longer shake_time, sweep_time or stroke "
        "tells more.\n",
        best.number, best.stiffness);
  }
  return all;
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
