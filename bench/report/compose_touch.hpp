// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a list of compositions is made: every contact law with the reachable bound, every bound with
// the plain spring, over one shape and one way to turn normals.

#include "touch.hpp"

#include <chrono>

namespace experiments {

template <class Constraint>
Constraint constraint_of(const answer& a) {
  using space = typename Constraint::space_type;
  if constexpr (space::dof == 1) {
    return {a.point.z(), 1.0, a.stiffness};
  } else if constexpr (requires(Constraint t) { t.thickness; }) {
    return {.a = a.nodes[0], .b = a.nodes[1], .c = a.nodes[2], .stiffness = a.stiffness};
  } else {
    return {a.point, a.normal, a.stiffness};
  }
}

template <class Space>
typename Space::vector port_of(const vector3& x) {
  if constexpr (Space::dof == 1) {
    return x.z();
  } else {
    return x;
  }
}
inline vector3 seen(double f) {
  return {0.0, 0.0, f};
}
inline vector3 seen(const vector3& f) {
  return f;
}

/// The scene in virtual time: a tick each `tick` [s], an answer of the environment each `period` [s].
template <class Model>
felt run_touch(Model model, const touch_scene& scene, double period, double tick) {
  using space = typename Model::space_type;
  const auto environment = scene.fresh();
  const auto ticks = static_cast<long>(scene.duration / tick + 0.5);
  const auto each = static_cast<long>(1e-3 / tick + 0.5);
  felt run;
  std::vector<double> spent;
  vector3 held = vector3::Zero();
  double due = 0.0;
  for (long n = 0; n < ticks; ++n) {
    const double t = tick * static_cast<double>(n);
    const vector3 x = scene.hand(t);
    if (t >= due - tick / 2.0) {
      const auto begin = std::chrono::steady_clock::now();
      const answer now = environment(x, held);
      const std::chrono::duration<double, std::nano> took =
          std::chrono::steady_clock::now() - begin;
      spent.push_back(took.count());
      model.retarget(constraint_of<typename Model::constraint_type>(now));
      due += period;
    }
    const auto out = model.tick(port_of<space>(x), tick);
    held = seen(out.force);
    if (n % each == 0) {
      run.force.push_back(held);
      run.depth.push_back(out.depth);
    }
  }
  std::nth_element(spent.begin(), spent.begin() + static_cast<long>(spent.size() / 2), spent.end());
  run.update_ns = spent[spent.size() / 2];
  return run;
}

/// One shape and one way to turn normals, all contact laws and bounds.
template <class Space, class Constraint, class Normals>
std::vector<composition> compositions_over(const std::string& shape, const std::string& turning,
                                           const Normals& normals) {
  std::vector<composition> all;
  const auto add = [&](const std::string& law, const std::string& limit, const auto& contact,
                       const auto& observer, const auto& bound) {
    const ph::local_model model{Space{},  ph::following<Constraint>{{.stale_after = 10.0}},
                                normals,  contact,
                                observer, bound};
    composition c{shape, turning, law, limit, decltype(model)::passivity, Space::dof, {}, {}};
    c.cost = candidate_of(name_of(c), model);
    c.touch = [model](const touch_scene& scene, double rate) {
      return run_touch(model, scene, 1.0 / rate, 1e-3);
    };
    all.push_back(std::move(c));
  };
  const ph::spring<Space> spring{};
  const ph::reduced_energy<Space> ledger{.damping = 0.03};
  const ph::reachable_bound<Space> reachable{.mass = 0.1, .hand_force = 5.0};
  add("spring", "none", spring, ph::no_observer<Space>{}, ph::no_bound<Space>{});
  add("spring", "strict", spring, ledger, ph::strict_bound<Space>{});
  add("spring", "memoryless", spring, ledger, ph::memoryless_bound<Space>{});
  add("spring", "EBA, tight", spring, ledger, ph::tight_energy_bounding<Space>{});
  add("spring", "thesis", spring, ledger, ph::thesis_bound<Space>{});
  add("spring", "reachable", spring, ledger, reachable);
  add("spring", "thesis, reachable", spring, ledger,
      ph::bound_chain{ph::thesis_bound<Space>{}, reachable});
  add("spring", "force rate, reachable", spring, ledger,
      ph::bound_chain{ph::force_rate_limit<Space>{.rate = 20.0}, reachable});
  add("spring", "tank, worst case", spring, ledger, ph::energy_tank<Space>{});
  add("spring", "PSPM", spring, ledger, ph::set_position_modulation<Space>{});
  add("spring", "PO/PC", spring, ph::no_observer<Space>{},
      ph::series_passivity_controller<Space>{.max_damping = 50.0});
  add("damped spring", "reachable", ph::damped_spring<Space>{.mass = 0.1}, ledger, reachable);
  add("virtual coupling", "reachable",
      ph::virtual_coupling<Space>{.stiffness = 5e3, .damping = 0.5}, ledger, reachable);
  return all;
}

}  // namespace experiments
