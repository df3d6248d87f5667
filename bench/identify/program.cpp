// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include "hung.hpp"
#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/identification/device_file.hpp>
#include <passive_haptics/simulation/presets.hpp>

namespace identify {

namespace {

ex::option a_quantity(const std::string& name, const std::string& unit, const std::string& help,
                      double scale, double& where) {
  return {name + " " + unit, help, [&where, name, unit, scale](const std::string& text) {
            const auto value = ph::to_decimal(text);
            if (!value || !(*value >= 0.0) || !ph::kernels::is_finite(*value)) {
              ex::complain(name + " " + text + ": give a number of " + unit + ", ≥ 0");
            }
            where = *value * scale;
          }};
}

const sim::device_preset* preset_of(const std::string& name) {
  for (const auto& preset : sim::all_presets) {
    if (name == preset.name) return &preset;
  }
  return nullptr;
}

int show(const identification::device_found<1>& found, const std::string& name,
         const std::string& json) {
  std::cout << identification::table_of(found.axes[0]) << '\n'
            << identification::composition_of(found);
  if (found.problem() != nullptr) return 1;
  if (json.empty()) return 0;
  const double hand = ph::design::intended_use{}.hand_force;  // as in the composition shown
  const auto fault =
      identification::save_device(json, identification::described(found, name, hand));
  if (!fault.empty()) throw std::runtime_error(fault);
  return 0;
}

int show_file(const std::string& file, const std::string& json) {
  const auto loaded = identification::load<1>(file);
  if (!loaded.fault.empty()) {
    std::cerr << "identify: " << loaded.fault << '\n';
    return 1;
  }
  std::cout << loaded.device << '\n';
  return show(loaded.found, loaded.device, json);
}

int identify_simulated(const settings& chosen, const std::atomic<bool>& stop) {
  const auto& preset = *preset_of(chosen.device);
  std::cout << preset.name << ", simulated: up to " << chosen.how.force << " N, "
            << 1e3 * chosen.how.stroke << " mm to either side of where it is, one to two minutes\n";
  const auto work = [&](auto device) {
    const auto found =
        identification::identify<line>(device, chosen.how, [&] { return stop.load(); });
    if (stop) throw ex::interrupted("stopped: the force is zero, nothing was written");
    const int code = show(found, preset.name, chosen.json);
    if (code == 0 && !chosen.file.empty()) {
      const auto fault = identification::save(chosen.file, found, preset.name);
      if (!fault.empty()) throw std::runtime_error(fault);
    }
    return code;
  };
  if (preset.friction > 0.0 && chosen.presliding > 0.0) {
    return work(sim::device<line, sim::no_hand<line>, sim::slider_and_spring>(
        preset.without_friction<line>(), {}, preset.friction_of(chosen.presliding)));
  }
  return work(sim::device<line>(preset.parameters<line>()));
}

/// The simulated device does by itself what it is asked for, within 1.5 s.
int weigh_simulated(const settings& chosen, const std::atomic<bool>& stop) {
  const auto& preset = *preset_of(chosen.device);
  std::cout << preset.name << ", simulated: up to " << chosen.how.force << " N; it has a gain of "
            << chosen.gain << '\n';
  const identification::weigh_in_parameters p{
      .mass = chosen.hung, .force = chosen.how.force, .moves = preset.mass};
  if (const auto fault = p.check()) {
    ex::complain(std::string("weighing: ") + fault.parameter + " must be " + fault.remedy);
  }
  auto truth = preset.parameters<line>();
  truth.gain = chosen.gain;
  const auto work = [&](auto device) {
    int asked = 0, waited = 0;
    const auto ready = [&](const char* sentence) {
      if (waited == 0) {
        std::cout << sentence << '\n';
        const double mass = asked == 1 ? chosen.hung : 0.0;
        device.hang(mass, {.weight = {-9.80665 * mass}});
      }
      if (++waited < (asked == 0 ? 2 : 1500)) return false;
      waited = 0;
      ++asked;
      return true;
    };
    const auto found =
        identification::weigh<line>(device, identification::weigh_in<1>(p, {{.pulls = {-1.0}}}),
                                    ready, [&] { return stop.load(); });
    if (stop) throw ex::interrupted("stopped: the force is zero");
    std::cout << identification::table_of(found);
    return found.problem == nullptr ? 0 : 1;
  };
  if (preset.friction > 0.0 && chosen.presliding > 0.0) {
    truth.friction = 0.0;
    return work(
        hung_device<line, sim::slider_and_spring>(truth, preset.friction_of(chosen.presliding)));
  }
  return work(hung_device<line>(truth));
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  ex::read_options(
      "identify",
      {{"--device NAME", "of the simulated ones (default: Touch)",
        [&](const std::string& name) {
          std::string all;
          for (const auto& preset : sim::all_presets) {
            all += (all.empty() ? "" : "; ") + std::string(preset.name);
          }
          if (preset_of(name) == nullptr) ex::complain("--device " + name + ": there are " + all);
          chosen.device = name;
        }},
       a_quantity("--presliding", "UM", "of its friction (default: 15)", 1e-6, chosen.presliding),
       a_quantity("--force", "N", "the most that is commanded (default: 3)", 1.0, chosen.how.force),
       a_quantity("--stroke", "MM", "to either side (default: 8)", 1e-3, chosen.how.stroke),
       a_quantity("--workspace", "MM", "beyond this the force is zero (default: 40)", 1e-3,
                  chosen.how.workspace),
       a_quantity("--weigh-in", "KG", "weigh this mass: which force is delivered?", 1.0,
                  chosen.hung),
       a_quantity("--gain", "SHARE", "that simulated motors deliver (default: 1)", 1.0,
                  chosen.gain),
       ex::a_text("--write FILE", "keep what was found", chosen.file),
       ex::a_text("--json FILE", "write the description that a composition takes", chosen.json),
       ex::a_text("--read FILE", "show what was kept, and measure nothing", chosen.read),
       ex::a_number("--study", "devices drawn at random: how often do the bounds hold?",
                    chosen.study),
       ex::a_number("--disturbed", "devices with something wrong: is it found?", chosen.disturbed),
       ex::a_number("--seed", "of the first of them (default: 1)", chosen.seed),
       ex::a_text("--out DIR", "where the study goes (default: identify)", chosen.out),
       ex::a_number("--threads", "(default: as many as the machine has)", chosen.threads)},
      arguments, [&] {
        if (const auto fault = chosen.how.check()) {
          ex::complain(std::string(fault.parameter) + " = " + ex::format("%g", fault.value) +
                       ", must be " + fault.remedy);
        }
      });
  return chosen;
}

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("identify", [&] {
    const settings chosen = parse(arguments);
    if (chosen.disturbed > 0) return run_disturbed(chosen, stop);
    if (chosen.study > 0) return run_study(chosen, stop);
    if (!chosen.read.empty()) return show_file(chosen.read, chosen.json);
    if (chosen.hung > 0.0) return weigh_simulated(chosen, stop);
    return identify_simulated(chosen, stop);
  });
}

}  // namespace identify
