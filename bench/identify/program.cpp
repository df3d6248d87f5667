// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include "hung.hpp"
#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/device/eigen_space.hpp>
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
            << 1e3 * chosen.how.stroke << " mm to either side of where it is, a minute\n";
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

/// Numbers between commas, of as many lists between slashes.
std::vector<std::vector<double>> a_pose(const std::string& text) {
  std::vector<std::vector<double>> lists{{}};
  std::string one;
  for (const char c : text + ',') {
    if (c != ',' && c != '/') {
      one += c;
      continue;
    }
    const auto value = ph::to_decimal(one);
    if (!value || !ph::kernels::is_finite(*value)) {
      ex::complain("--pose " + text + ": give numbers, as in 0,-1 or 0,-1/0.1,0.2/0,0.15");
    }
    lists.back().push_back(*value);
    one.clear();
    if (c == '/') lists.emplace_back();
  }
  const std::size_t axes = lists.front().size();
  bool fits = axes <= 3 && (lists.size() == 1 || lists.size() == 1 + axes);
  for (const auto& list : lists) fits = fits && list.size() == axes;
  if (!fits) {
    ex::complain("--pose " + text +
                 ": give where the mass pulls, for 1 to 3 axes, and no row of Jᵀ or one for each");
  }
  return lists;
}
template <int Dof>
std::vector<identification::weighed_pose<Dof>> poses_of(const settings& chosen) {
  std::vector<identification::weighed_pose<Dof>> all;
  for (const auto& lists : chosen.poses) {
    identification::weighed_pose<Dof> pose;
    std::copy(lists[0].begin(), lists[0].end(), pose.pulls.begin());
    for (std::size_t i = 1; i < lists.size(); ++i) {
      std::copy(lists[i].begin(), lists[i].end(), pose.rows[i - 1].begin());
    }
    all.push_back(pose);
  }
  return all;
}

/// The description in that file, to which gains are to be added; none without a file.
identification::device_description description_in(const std::string& json) {
  if (json.empty()) return {};
  auto kept = identification::load_device(json);
  if (!kept.fault.empty()) throw std::runtime_error(kept.fault);
  return std::move(kept.of);
}

/// The simulated device does by itself what it is asked for, within 1.5 s. Its motors have one gain, so a linkage before
/// them changes nothing.
template <class Space>
int weigh_simulated(const settings& chosen, const std::atomic<bool>& stop) {
  constexpr int dof = Space::dof;
  const auto& preset = *preset_of(chosen.device);
  std::cout << preset.name << ", simulated: up to " << chosen.how.force << " N; it has a gain of "
            << chosen.gain << '\n';
  const identification::weigh_in_parameters p{
      .mass = chosen.hung, .force = chosen.how.force, .moves = preset.mass};
  if (const auto fault = p.check()) {
    ex::complain(std::string("weighing: ") + fault.parameter + " must be " + fault.remedy);
  }
  const auto poses = poses_of<dof>(chosen);
  const auto known = description_in(chosen.json);  // before anybody hangs a mass
  auto truth = preset.parameters<Space>();
  truth.gain = sim::every_axis<Space>(chosen.gain);
  const auto work = [&](auto device) {
    std::size_t asked = 0;
    int waited = 0;
    const auto ready = [&](const char* sentence) {
      if (waited == 0) {
        std::cout << sentence << '\n';
        const double mass = asked % 3 == 1 ? chosen.hung : 0.0;
        auto weight = poses[asked / 3].pulls;
        for (double& w : weight) w *= 9.80665 * mass;
        device.hang(mass, {.weight = weight});
      }
      if (++waited < (asked == 0 ? 2 : 1500)) return false;
      waited = 0;
      ++asked;
      return true;
    };
    const auto found = identification::weigh<Space>(device, identification::weigh_in<dof>(p, poses),
                                                    ready, [&] { return stop.load(); });
    if (stop) throw ex::interrupted("stopped: the force is zero");
    std::cout << identification::table_of(found);
    if (found.problem != nullptr) return 1;
    if (chosen.json.empty()) return 0;
    const auto fault = identification::save_device(chosen.json, weighed(known, found));
    if (!fault.empty()) throw std::runtime_error(fault);
    return 0;
  };
  if (preset.friction > 0.0 && chosen.presliding > 0.0) {
    truth.friction = 0.0;
    return work(
        hung_device<Space, sim::slider_and_spring>(truth, preset.friction_of(chosen.presliding)));
  }
  return work(hung_device<Space>(truth));
}
int weigh_simulated(settings chosen, const std::atomic<bool>& stop) {
  if (chosen.poses.empty()) chosen.poses = {{{-1.0}}};
  const std::size_t axes = chosen.poses.front().front().size();
  if (axes == 1) return weigh_simulated<line>(chosen, stop);
  if (axes == 2) return weigh_simulated<ph::space<double, 2>>(chosen, stop);
  return weigh_simulated<ph::space<double, 3>>(chosen, stop);
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
       {"--pose PULL[/ROWS]",
        "where the mass pulls by axis, and the rows of Jᵀ of a linkage; again for each pose",
        [&](const std::string& text) {
          chosen.poses.push_back(a_pose(text));
          if (chosen.poses.back().front().size() != chosen.poses.front().front().size()) {
            ex::complain("--pose " + text + ": give as many axes as in the poses before");
          }
        }},
       ex::a_text("--write FILE", "keep what was found", chosen.file),
       ex::a_text("--json FILE",
                  "write the description that a composition takes; with --weigh-in, add the gains "
                  "to it",
                  chosen.json),
       ex::a_text("--read FILE", "show what was kept, and measure nothing", chosen.read),
       ex::a_number("--study", "devices drawn at random: how often do the bounds hold?",
                    chosen.study),
       ex::a_number("--disturbed", "devices with something wrong: is it found?", chosen.disturbed),
       ex::a_seed("of the first of them", chosen.seed),
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
