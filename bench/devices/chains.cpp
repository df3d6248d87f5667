// SPDX-License-Identifier: BSD-3-Clause
// Devices drawn at random, of two to four masses, and the worst hand of many on each: what does each bound lose?
#include "transmissions.hpp"

namespace devices {

namespace {

constexpr double accepted_loss = 1e-9;  // [J]: the simulator's own error
constexpr double motors = 9.0, T = 1e-3, speed = 1.0;

enum class told : std::uint8_t {
  strict,
  observed,
  modelled,
  all_mass,
  tenth_slew,
  wrong_rotor,
  weaker_hand,
  heavier_model
};
struct kind_of_bound {
  told what;
  const char* name;
  bool promised, equal_ticks;
};
constexpr std::array<kind_of_bound, 8> bounds{
    {{told::strict, "strict_bound", true, false},
     {told::observed, "observed_reach", true, false},
     {told::modelled, "modelled_reach, 3 % off", true, true},
     {told::all_mass, "control: reachable_bound, all mass", false, false},
     {told::tenth_slew, "control: observed_reach, slew / 10", false, false},
     {told::wrong_rotor, "control: observed_reach, mass x 3", false, false},
     {told::weaker_hand, "control: modelled_reach, hand / 1.5", false, true},
     {told::heavier_model, "control: modelled_reach, rotor x 1.5", false, true}}};

/// A device, a loop and a hand's strength, as drawn.
template <class Space>
struct drawn {
  sim::compliant_parameters<Space> device{};
  double K = 1000.0, jitter = 0.0, hand = 5.0;
  unsigned seed = 0;
};

template <class Space, int Late>
drawn<Space> draw(unsigned seed, bool jitters) {
  std::mt19937 from(seed * 2654435761u + 17u);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto log = [&](double least, double most) {
    return least * std::pow(most / least, unit(from));
  };
  drawn<Space> d;
  d.seed = seed;
  d.device.mass = log(0.03, 0.3);
  d.device.share = 0.05 + 0.85 * unit(from);
  d.device.mode = log(15.0, 400.0);
  d.device.loss = log(0.005, 0.1);
  d.device.masses = 2 + static_cast<int>(seed % 3);
  d.device.inner_mode = log(30.0, 400.0);
  d.device.damping = log(0.05, 1.0);
  d.device.friction = unit(from) < 0.5 ? 0.0 : 0.3 * unit(from);
  d.device.force_limit = motors;
  d.device.substeps = 40;
  d.device.latency = Late;
  d.device.period = T;
  sim::component(d.device.start, Space::dof - 1) = 0.002;
  d.K = log(500.0, 20000.0);
  d.jitter = jitters ? 0.2 * unit(from) : 0.0;
  return d;
}

template <class Space, int Late, int N>
auto model(const drawn<Space>& d, double off) {
  auto chain = chain_of<N>(d.device);
  // the device lies at a corner of what was stated
  std::mt19937 from(d.seed + 5u);
  const auto side = [&from](double x) { return from() % 2 == 0 ? x : 1.0 / x; };
  for (auto& m : chain.masses) m *= side(1.0 + off);
  for (auto& k : chain.springs) k *= side(1.0 + off);
  for (auto& l : chain.losses) l *= side(1.0 + 10.0 * off);
  chain.damping *= side(1.0 + 10.0 * off);
  return ph::modelled_reach<N, Late>{.device = chain,
                                     .hand_force = d.hand,
                                     .friction = d.device.friction * std::sqrt(Space::dof),
                                     .tick = T};
}

template <class Space, int Late>
loop_of<Space> loop(told what, const drawn<Space>& d) {
  const auto& p = d.device;
  const double rotor = p.mass_of(0), most_tick = T * (1.0 + d.jitter);
  const double c = p.friction * std::sqrt(Space::dof);
  const auto behind = [&](const auto& bound) {
    return wall_behind<Space, Late>(bound, ph::spring{}, p.damping, d.K, motors, most_tick);
  };
  const auto pull = lemma_a(p, d.hand, motors, speed);
  ph::observed_reach seen{.mass = rotor / 1.03,
                          .mass_above = rotor * 1.03,
                          .slew = pull.slew,
                          .friction = c,
                          .damping_above = p.damping * 1.3,
                          .pull = pull.most};
  const auto modelled = [&](auto masses, double weaker, double heavier) {
    auto stated = model<Space, Late, decltype(masses)::value>(d, heavier > 1.0 ? 0.0 : 0.03);
    stated.hand_force /= weaker;
    stated.device.masses[0] *= heavier;
    return behind(stated);
  };
  const auto of_each = [&](double weaker, double heavier) {
    if (p.masses == 3) return modelled(std::integral_constant<int, 3>{}, weaker, heavier);
    if (p.masses == 4) return modelled(std::integral_constant<int, 4>{}, weaker, heavier);
    return modelled(std::integral_constant<int, 2>{}, weaker, heavier);
  };
  switch (what) {
    case told::strict:
      break;
    case told::observed:
      return behind(seen);
    case told::modelled:
      return of_each(1.0, 1.0);
    case told::all_mass:
      return behind(ph::reachable_bound{.mass = 0.95 * p.mass, .hand_force = d.hand + c});
    case told::tenth_slew:
      seen.slew /= 10.0;
      seen.pull = ph::detail::no_limit;
      return behind(seen);
    case told::wrong_rotor:
      seen.mass = 3.0 * rotor;
      seen.mass_above = 0.0;
      seen.pull = ph::detail::no_limit;
      return behind(seen);
    case told::weaker_hand:
      return of_each(1.5, 1.0);
    case told::heavier_model:
      return of_each(1.0, 1.5);
  }
  return behind(ph::strict_bound{});
}

struct outcome {
  double least = 0.0;
  bool within = true;  ///< did the transmission keep to Lemma A's numbers?
};
template <class Space, int Late>
outcome play(told what, const drawn<Space>& d, const drawn_hand<Space>& by, int ticks) {
  sim::compliant_device<Space, drawn_hand<Space>> arm(d.device, by);
  const auto touch = loop<Space, Late>(what, d);
  std::mt19937 from(d.seed + 99u);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  auto sample = arm.exchange(Space::zero());
  for (int n = 0; n < ticks; ++n) {
    const auto f = touch(sample);
    (void)arm.set_period(T * (1.0 + d.jitter * unit(from)));
    sample = arm.exchange(f);
    if (Space::norm(typename Space::vector(sample.position)) > 1.0) break;
  }
  const auto pull = lemma_a(d.device, d.hand, motors, speed);
  return {std::min(0.0, arm.minimum()),
          arm.most_pull() <= pull.most && arm.most_slew() <= pull.slew};
}

/// The same device in a hand of 400 N/m and 4 N·s/m that presses it 8 mm past the wall and holds still for 6 s. Seen at
/// the rotor, where the encoder is.
template <class Space, int Late>
void hold_still(ex::at_rest& row, told what, const drawn<Space>& d) {
  constexpr int normal = Space::dof - 1, ticks = static_cast<int>(ex::quiet_watched / T);
  drawn_hand<Space> by{.does = drawn_hand<Space>::kind::kneads,
                       .most = d.hand,
                       .frequency = 0.01,
                       .bias = -8e-3,
                       .stiffness = 400.0,
                       .damping = 4.0};
  sim::compliant_device<Space, drawn_hand<Space>> arm(d.device, by);
  const auto touch = loop<Space, Late>(what, d);
  sim::quiet_judge<Space> judge;
  ex::held_stiffness held;
  typename Space::motion up = Space::zero();
  Space::component(up, normal) = 1.0;
  const std::array<typename Space::motion, 1> rows{up};
  std::mt19937 from(d.seed + 99u);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  auto sample = arm.exchange(Space::zero());
  for (int n = 0; n < ticks; ++n) {
    const auto f = touch(sample);
    const auto at = arm.position();
    const double depth = -Space::component(at, normal), dt = T * (1.0 + d.jitter * unit(from));
    if (n >= ticks - 1000) held.add(Space::component(f, normal), depth);
    judge.add_at(f, at, dt, std::span(rows).first(depth > 0.0 ? 1 : 0));
    (void)arm.set_period(dt);
    sample = arm.exchange(f);
    if (Space::norm(typename Space::vector(sample.position)) > 1.0) break;
  }
  row.add(judge, {d.K, held.shown()});
}

struct chain_row {
  std::string bound{};
  bool promised = false;
  int dimensions = 1, latency = 0, masses = 2;
  bool jitters = false;
  int devices = 0, left_out = 0, lost = 0;  ///< devices; hands that left what was stated
  double least_energy = 0.0;                ///< [J]
  ex::at_rest still{};                      ///< in a hand that holds still
};
ex::record record_of(const chain_row& r) {
  return ex::with({{"bound", r.bound},
                   {"promised", r.promised},
                   {"dimensions", r.dimensions},
                   {"latency", r.latency},
                   {"masses", r.masses},
                   {"jitter", r.jitters},
                   {"devices", r.devices},
                   {"hands_left_out", r.left_out},
                   {"lost", r.lost},
                   {"least_energy_J", r.least_energy}},
                  r.still);
}

/// All bounds on one device: some hands, and then changes of the worst.
template <class Space, int Late>
std::vector<chain_row> attacked(unsigned seed, bool jitters, bool quick) {
  const auto d = draw<Space, Late>(seed, jitters);
  std::vector<chain_row> rows;
  for (const auto& b : bounds) {
    if (jitters && b.equal_ticks) continue;
    chain_row row{b.name, b.promised, Space::dof, Late, d.device.masses, jitters, 1, 0, 0, 0.0, {}};
    const bool conditional = b.what == told::observed;
    std::mt19937 from(seed + 1000u);
    const int tries = quick ? 6 : 12, climbs = quick ? 4 : 12;
    drawn_hand<Space> worst;
    double least = 1.0;
    for (int i = 0; i < tries + climbs; ++i) {
      auto by = draw_hand<Space>(from, d.hand);
      if (i >= tries) {  // a step away from the worst
        auto near_it = worst;
        near_it.frequency *= std::exp(0.3 * (by.phase - 0.5));
        near_it.phase = from() % 2 == 0 ? by.phase : worst.phase;
        if (near_it.does == by.does) near_it.bias = by.bias, near_it.amplitude = by.amplitude;
        by = near_it;
      }
      const auto found = play<Space, Late>(b.what, d, by, 1200);
      if (conditional && !found.within) {
        ++row.left_out;
        continue;
      }
      if (found.least < least) least = found.least, worst = by;
    }
    row.least_energy = std::min(least, 0.0);
    row.lost = least < -accepted_loss ? 1 : 0;
    hold_still<Space, Late>(row.still, b.what, d);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

ex::failures run_chains(const session& s) {
  s.out.section(
      "Chains of two to four masses",
      "Drawn: 0.03-0.3 kg, 5-90 % of it with the encoder, modes of 15-400 Hz, losses of "
      "0.5-10 %, 0.05-1 N·s/m, dry "
      "friction up to 0.3 N, walls of 0.5-20 kN/m, latency 0 to 2, ticks equal or 20 % "
      "off; a hand of 5 N of six kinds, "
      "the worst of many. observed_reach is told the rotor's mass within 3 % and what "
      "Lemma A makes of 1 m/s; hands that "
      "left that are not counted for it. modelled_reach is told each number 3 % off, "
      "losses and damping 30 %. None of these hands holds still, so one more does, 400 N/m "
      "and 4 N·s/m, on each device; the law is a spring without a damper, and what is "
      "judged is the rotor." +
          std::string(ex::quiet_columns));
  struct job {
    int dimensions, latency;
    bool jitters;
    unsigned seed;
  };
  std::vector<job> jobs;
  const int each = s.chosen.quick ? 6 : 36;
  for (int i = 0; i < each; ++i) {
    for (const int latency : {0, 1, 2}) {
      for (const bool jitters : {false, true}) {
        jobs.push_back({1, latency, jitters, static_cast<unsigned>(jobs.size())});
      }
    }
    if (i % 3 == 0) jobs.push_back({3, 0, i % 2 == 0, static_cast<unsigned>(jobs.size())});
  }
  const auto all = s.rows("chains.csv", "chains", jobs, [&](const job& j) {
    const bool quick = s.chosen.quick;
    if (j.dimensions == 3) return attacked<d3, 0>(j.seed, j.jitters, quick);
    if (j.latency == 1) return attacked<d1, 1>(j.seed, j.jitters, quick);
    if (j.latency == 2) return attacked<d1, 2>(j.seed, j.jitters, quick);
    return attacked<d1, 0>(j.seed, j.jitters, quick);
  });
  std::vector<chain_row> sums;
  for (const auto& b : bounds) {
    for (const bool jitters : {false, true}) {
      chain_row sum{b.name, b.promised, 0, 0, 0, jitters, 0, 0, 0, 0.0, {}};
      for (const auto& r : all) {
        if (r.bound != b.name || r.jitters != jitters) continue;
        ++sum.devices;
        sum.left_out += r.left_out;
        sum.lost += r.lost;
        sum.least_energy = std::min(sum.least_energy, r.least_energy);
        sum.still.add(r.still);
      }
      if (sum.devices > 0) sums.push_back(sum);
    }
  }
  const auto shown = [](const chain_row& r) {
    return ex::with({{"bound", r.bound},
                     {"promised", r.promised},
                     {"jitter", r.jitters},
                     {"devices", r.devices},
                     {"hands left out", r.left_out},
                     {"lost", r.lost},
                     {"least energy J", r.least_energy}},
                    r.still);
  };
  s.out.show(ex::table_of(sums, shown));
  s.out.member("chains", ex::json_of(sums, shown));
  ex::failures found;
  for (const auto& r : sums) {
    if (r.promised && r.lost > 0) {
      found.push_back(r.bound + " loses on " + std::to_string(r.lost) + " devices, " +
                      std::to_string(-r.least_energy) + " J at worst");
    }
    if (!r.promised && r.lost == 0 && !s.chosen.quick) {
      found.push_back(r.bound + " loses nothing, and is no control");
    }
  }
  return found;
}

}  // namespace devices
