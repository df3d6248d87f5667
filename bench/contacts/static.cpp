// SPDX-License-Identifier: BSD-3-Clause
// Lemma P: planes at rest need no ledger as long as the coupling is no stiffer than 2b/T, rough or not, whoever
// moves the device; and they do need one when it is stiffer.
#include "quiet.hpp"
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>

namespace contacts {

namespace {

struct static_row {
  const planes* scene = nullptr;
  bool rough = false;
  double times = 1.0;  ///< the coupling, of 2b/T
  int runs = 200;
  double least_energy = 0.0;   ///< [J]
  double largest_force = 0.0;  ///< [N]
  ex::at_rest still{};         ///< in a hand that holds still afterwards
};
ex::record record_of(const static_row& r) {
  return ex::with({{"scene", std::string(r.scene == nullptr ? "" : r.scene->name)},
                   {"rough", r.rough},
                   {"coupling_of_2b_per_T", r.times, "%.2f"},
                   {"runs", r.runs},
                   {"least_energy_J", r.least_energy},
                   {"largest_force_N", r.largest_force, "%.2f"}},
                  r.still);
}

/// A relaxed hand that presses from up to 2 mm above the planes, with a load, off their axis, drawn by the seed.
held_point::parameters resting_hand(const planes& scene, std::uint64_t seed) {
  draws d(seed);
  vector into = 0.3 * d.direction();
  for (const vector& n : scene.normals) into -= n / static_cast<double>(scene.normals.size());
  into.normalize();
  held_point::parameters p{.damping = damping, .hand = still_hands[1]};
  p.mass = d.scale(0.1, 0.5);
  p.load = into * d.between(0.3, 1.0);
  p.goal = into * d.between(1e-3, 10e-3);
  p.start = vector(0.0, 0.0, d.between(1e-4, 2e-3));
  return p;
}

/// A velocity source that presses, trembles along the force, wanders, and leaves by the worst way of all.
template <class Port>
double least_energy(Port port, std::uint64_t seed, double& largest) {
  ph::laws::samples random(seed);
  vector x(0.0, 0.0, 1e-3), f = vector::Zero();
  double energy = 0.0, least = 0.0;
  static_cast<void>(port.tick(x, ph::seconds{T}));
  for (int i = 0; i < 2000; ++i) {
    const double what = random.number<double>();
    vector step = random.vector<d3>() * 3e-4;
    if (f.norm() < 0.03 || what < -0.95) {
      step = -x * 0.3 - vector(0.0, 0.0, 5e-4);
    } else if (what > 0.9) {
      step = f * (T / (2.0 * damping));
    } else if (what > -0.7) {
      step = f * ((i % 2 == 0 ? 2e-4 : -2e-4) / f.norm());
    }
    if (step.norm() > 3e-3) step *= 3e-3 / step.norm();
    if ((x + step).norm() > 0.02) step = x * -0.1;
    energy += damping * step.squaredNorm() / T - f.dot(step);  // even motion, held force: exact
    least = std::min(least, energy);
    x += step;
    f = port.tick(x, ph::seconds{T}).force;
    largest = std::max(largest, f.norm());
  }
  return least;
}

template <int Count, class Friction>
static_row judge(static_row row, const Friction& friction, int seed) {
  const double eps = ph::proxy_spring{}.softness;
  const double K = row.times * 2.0 * damping / T * (1.0 - eps);
  ph::passive_port port{d3{},
                        ph::contact_set{ph::proxy_spring{.mass = 0.1, .damping_ratio = 0.0},
                                        ph::pursuit{}, friction, ph::slots<plane, Count>{}},
                        ph::no_observer{}, ph::no_bound{},
                        ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
  for (std::size_t i = 0; i < row.scene->normals.size(); ++i) {
    port.source().update(static_cast<int>(i),
                         plane{vector(0.0, 0.0, 0.0), row.scene->normals[i], K});
  }
  static_cast<void>(
      port.tick(vector(0.0, 0.0, 1.0), ph::seconds{T}));  // they are all met from outside
  const int asked = row.runs;
  const auto goes_on = [&](int run) {  // a control that has lost nothing yet tries more
    return run < asked || (row.times > 1.0 && row.least_energy >= -1e-6 && run < 50 * asked);
  };
  for (int run = 0; goes_on(run); ++run) {
    row.runs = run + 1;
    const auto drawn = (static_cast<std::uint64_t>(seed) << 32U) + static_cast<std::uint64_t>(run);
    row.least_energy = std::min(row.least_energy, least_energy(port, drawn, row.largest_force));
    if (run % 10 != 0 || run >= asked)
      continue;  // of the attacks; the hand that holds still has another every time
    add_held(row.still, port, static_cast<int>(row.scene->normals.size()),
             resting_hand(*row.scene, drawn), no_news);
  }
  return row;
}
template <int Count>
static_row judge(const static_row& row, int seed) {
  return row.rough ? judge<Count>(row, ph::stick_slip{}, seed)
                   : judge<Count>(row, ph::frictionless{}, seed);
}

}  // namespace

std::vector<std::string> run_static(const session& s) {
  s.out.section(
      "Static",
      "Planes at rest, no ledger, no bound, no damping: the least true energy at the port "
      "under velocity sources, with a coupling K/(1 - eps) of 2b/T and of 1.3 times that. The "
      "sources never hold still, so in 20 more runs, drawn with --seed " +
          std::to_string(s.chosen.seed) +
          ", a relaxed hand (100 N/m, 1 N·s/m) presses 0.1 to 0.5 kg off their axis; what damps "
          "there is the hand." +
          ex::quiet_columns);
  std::vector<static_row> jobs;
  for (const auto& scene : all_planes()) {
    for (const bool rough : {false, true}) {
      if (rough && scene.normals.size() > 1) continue;  // on one plane n and t share no direction
      for (const double times : {1.0, 1.3}) {
        jobs.push_back({.scene = &scene, .rough = rough, .times = times});
      }
    }
  }
  const auto rows = s.rows("static.csv", "static", jobs, [&s](const static_row& r) {
    return r.scene->normals.size() == 1   ? judge<1>(r, s.chosen.seed)
           : r.scene->normals.size() == 3 ? judge<3>(r, s.chosen.seed)
                                          : judge<8>(r, s.chosen.seed);
  });
  ex::show_rows(s.out, "static", rows);
  std::vector<std::string> found;
  for (const auto& r : rows) {
    const std::string name = std::string(r.scene->name) + (r.rough ? ", rough" : "");
    if (r.times > 1.0) {
      expect(found, r.least_energy < -1e-6, name + ": the control loses nothing");
    } else {
      expect(found, r.least_energy >= -1e-12, name + ": a static scene loses energy");
      expect(found, r.largest_force > 0.01, name + ": never pushes");
    }
  }
  return found;
}

}  // namespace contacts
