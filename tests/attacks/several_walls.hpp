// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several walls on one device, in one port or in a port each.
#include "attacks/challenged.hpp"

#include <algorithm>
#include <array>

namespace simulated {

/// The places of the walls, relative to the surface that an adversary moves.
enum class arrangement : int {
  facing,  ///< two of them, 1 mm apart
  twice,   ///< the same one
  corner,  ///< at right angles, as many as there are axes, up to three
};

/// The `i`-th wall of it.
template <class Space>
ph::half_space<Space> wall_of(arrangement how, int i, const sim::surface_state<Space>& s) {
  const double K = s.stiffness;
  if (i == 0 || how == arrangement::twice) return {s.point, s.normal, K};
  if (how == arrangement::facing) {
    const typename Space::vector across = s.point + s.normal * 1e-3;
    return {across, -s.normal, K};
  }
  if constexpr (Space::dof == 3) {
    const d3::vector aside = d3::orthogonal(s.normal);
    return {s.point, i == 1 ? aside : d3::vector(d3::cross(s.normal, aside)), K};
  } else if constexpr (Space::dof == 2) {
    return {s.point, d2::vector(-s.normal(1), s.normal(0)), K};
  } else {
    return {s.point, s.normal, K};
  }
}

template <class Space>
using contact_of_wall =
    ph::local_contact<Space, ph::followed<ph::half_space<Space>>, ph::turn_limited, ph::spring>;

/// All of them in one port.
template <class Space, class Bound, class... Walls>
auto port_of(const Bound& bound, const Walls&... walls) {
  return ph::passive_port{Space{}, ph::contacts{walls...}, thesis_ledger<Space>(), bound,
                          thesis_loop};
}
template <class Space, int walls, class Bound = ph::strict_bound>
auto one_port(const Bound& bound = {}) {
  const contact_of_wall<Space> one{{}, {.rate = 4}, {}};
  if constexpr (walls == 2) {
    return port_of<Space>(bound, one, one);
  } else {
    return port_of<Space>(bound, one, one, one);
  }
}

/// A local model for each wall, their forces added: the composition that one_port replaces.
template <class Space, int walls>
struct model_each {
  using space_type = Space;
  using model = std::remove_const_t<decltype(strict<Space>)>;
  std::array<model, walls> models{};

  explicit model_each(double damping) {
    models.fill({Space{},
                 {},
                 {.rate = 4},
                 ph::spring{},
                 ph::reduced_energy{.damping = damping},
                 ph::strict_bound{},
                 thesis_loop});
  }
  typename Space::vector tick(const ph::device_sample<Space>& sample) {
    typename Space::vector sum = Space::zero();
    for (model& one : models) {  // each is told its own part of what was held
      sum += (sample.valid ? one.tick(sample.position, ph::seconds{sample.dt}) : one.tick(sample))
                 .force;
    }
    return sum;
  }
};

/// How the surface of an adversary is laid on either.
template <class Space, int walls>
struct lay_walls {
  arrangement how;

  bool operator()(model_each<Space, walls>& each, const sim::surface_state<Space>& s) const {
    for (int i = 0; i < walls; ++i) {
      each.models[static_cast<std::size_t>(i)].update(wall_of<Space>(how, i, s));
    }
    return true;
  }
  bool operator()(auto& port, const sim::surface_state<Space>& s) const {
    auto& contacts = port.source();
    contacts.template contact<0>().update(wall_of<Space>(how, 0, s));
    contacts.template contact<1>().update(wall_of<Space>(how, 1, s));
    if constexpr (walls == 3) contacts.template contact<2>().update(wall_of<Space>(how, 2, s));
    return true;
  }
};

template <class Space, int walls>
auto attacked(const auto& model, arrangement how, int runs) {
  return sim::challenge_all(model, {}, runs, 1, lay_walls<Space, walls>{how});
}

/// How many adversaries draw energy out of it, and how much the worst of them does [J].
struct losses {
  int adversaries = 0;
  double worst = 0.0;
};
template <class Space, int walls>
losses lost(const model_each<Space, walls>& each, arrangement how, int runs) {
  losses all;
  for (const sim::verdict& v : attacked<Space, walls>(each, how, runs)) {
    all.adversaries += passes(v) ? 0 : 1;
    all.worst = std::min(all.worst, v.least_energy);
  }
  return all;
}

inline constexpr std::array two_walls{arrangement::facing, arrangement::twice, arrangement::corner};

}  // namespace simulated
