// SPDX-License-Identifier: BSD-3-Clause
// Dry friction of contacts: it stays inside its cone, sticks and slips, holds a finger that trembles where
// it is, and lets it come to rest. What a normal that wobbles does to it is shown as well.
#include "quiet.hpp"

namespace contacts {

namespace {

constexpr double mass = 0.1, pi = 180.0 * degree;
constexpr ph::stick_slip rough{};

/// A hand that is a force in time, and a spring to a target that moves.
struct pushing_hand {
  vector steady = vector::Zero();  ///< [N]
  vector tremor = vector::Zero();  ///< amplitude [N]
  double frequency = 9.0;          ///< of the tremor [Hz]
  vector pulled = vector::Zero();  ///< velocity of a target [m/s]
  double stiffness = 0.0;          ///< of a spring to it, along its way [N/m]

  [[nodiscard]] vector force(double t, const vector& x, const vector& /*v*/) const noexcept {
    vector f = steady + tremor * std::sin(2.0 * pi * frequency * t);
    if (stiffness > 0.0) {
      const vector way = pulled.normalized();
      f += way * (stiffness * (pulled.norm() * t - way.dot(x)));
    }
    return f;
  }
  [[nodiscard]] double mass() const noexcept { return 0.0; }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return {}; }
};
using rubbed_device = sim::device<d3, pushing_hand>;

/// The mean over whole periods of a tremor, second by second, of where the device is.
struct drift_row {
  std::string scene;
  double seconds = 60.0;
  double drift = 0.0;         ///< of the mean along the surface, from the second second on [m]
  double least_energy = 0.0;  ///< [J]
  ex::at_rest still{};        ///< when tremor and wobble have stopped
};
ex::record record_of(const drift_row& r) {
  return ex::with({{"scene", r.scene},
                   {"seconds", r.seconds, "%.0f"},
                   {"drift_um", r.drift * 1e6, "%.3f"},
                   {"least_energy_J", r.least_energy}},
                  r.still);
}

/// Holds on for so long, and then still for 6 s; `along` is the direction whose drift counts. The plane leans by up to
/// `wobble` [rad], and stays as it leans when the hand holds still.
template <int Count>
drift_row hold(const std::string& name, const planes& scene, const pushing_hand& hand,
               const std::vector<vector>& along, double seconds, double wobble = 0.0) {
  drift_row row{.scene = name, .seconds = seconds};
  auto port = port_of<Count>(scene, mass, 1e3, beside<ph::stick_slip>{.push = 8.0});
  rubbed_device device(
      {.mass = mass, .damping = damping, .period = T, .start = vector(0.0, 0.0, 1e-4)}, hand);
  const int window = 1000;  // nine periods of the tremor
  vector mean = vector::Zero(), first = vector::Zero();
  const int held = static_cast<int>(seconds / T);
  sim::quiet_judge<d3> judge;
  std::vector<vector> room;
  row.least_energy =
      sim::run(
          device, port, held + static_cast<int>(watched / T),
          [&](const auto& now) {
            if (now.tick == held) device.hand().tremor = vector::Zero();
            if (wobble == 0.0 || now.tick >= held) return;
            const double a = 2.0 * pi * 10.0 * now.time;
            const vector n(wobble * std::cos(a), wobble * std::sin(a), 1.0);
            port.source().update(0, plane{vector(0.0, 0.0, 0.0), n, 1e3});
          },
          sim::idle,
          [&](const auto& now) {
            if (now.tick >= held) {
              judge.add(now.force, device.velocity(), T, ex::pressing(port.source(), Count, room));
              return;
            }
            mean += device.position() / window;
            if ((now.tick + 1) % window != 0) return;
            if (now.tick + 1 == 2 * window) first = mean;
            if (now.tick + 1 > 2 * window) {
              for (const auto& way : along) {
                row.drift = std::max(row.drift, std::abs(way.dot(mean - first)));
              }
            }
            mean = vector::Zero();
          })
          .least_energy;
  row.still.add(judge, stiffness_at_rest(port, Count, device.position()));
  return row;
}

/// Pulled by a spring along a plane: how often does it slip?
struct stick_slip_row {
  double normal_force = 2.0, speed = 0.010, spring = 300.0;
  double slips_per_second = 0.0;
  double least_force = 0.0, largest_force = 0.0;  ///< of friction while it goes on [N]
};
ex::record record_of(const stick_slip_row& r) {
  return {{"normal_force_N", r.normal_force},
          {"speed_m_per_s", r.speed},
          {"spring", r.spring, "%.0f"},
          {"slips_per_second", r.slips_per_second, "%.2f"},
          {"least_friction_N", r.least_force, "%.2f"},
          {"largest_friction_N", r.largest_force, "%.2f"}};
}
stick_slip_row pull() {
  stick_slip_row row;
  auto port = port_of<1>(all_planes()[0], mass, 1e3, beside<ph::stick_slip>{});
  rubbed_device device({.mass = mass, .damping = damping, .period = T},
                       {.steady = vector(0.0, 0.0, -row.normal_force),
                        .pulled = vector(row.speed, 0.0, 0.0),
                        .stiffness = row.spring});
  bool sticks = true;
  int slips = 0;
  row.least_force = 1e9;
  sim::run(device, port, 20000, sim::idle, sim::idle, [&](const auto& now) {
    if (now.tick < 2000) return;
    const double v = device.velocity().x();
    if (sticks && v > 5.0 * row.speed) {
      sticks = false;
      ++slips;
    }
    if (!sticks && v < 0.5 * row.speed) sticks = true;
    row.least_force = std::min(row.least_force, -now.force.x());
    row.largest_force = std::max(row.largest_force, -now.force.x());
  });
  row.slips_per_second = slips / 18.0;
  return row;
}

/// Asked for anything, how large is the friction of one plane over its cone, in ticks whose force is the contact's own
/// and in those in which it is still on its way there after news?
struct cone_row {
  int ticks = 0, eased = 0,
      outside = 0;  ///< ticks, those on the way, and those of them outside the cone
  double own = 0.0, on_the_way = 0.0;  ///< largest friction over μ_s times the normal force
};
ex::record record_of(const cone_row& r) {
  return {{"ticks", r.ticks},
          {"eased", r.eased},
          {"eased_outside", r.outside},
          {"ratio", r.own, "%.15f"},
          {"ratio_eased", r.on_the_way, "%.3f"}};
}
cone_row cone(int seed, int ticks) {
  cone_row row{.ticks = ticks};
  auto port = port_of<1>(all_planes()[0], mass, 1e3, beside<ph::stick_slip>{});
  ph::laws::samples random(static_cast<std::uint64_t>(seed));
  vector x(0.0, 0.0, 0.0);
  for (int i = 0; i < ticks; ++i) {
    x += random.vector<d3>() * 2e-4;
    x.z() = std::clamp(x.z(), -4e-3, 1e-3);
    if (i % 200 == 0) {
      vector n = vector::UnitZ() + 0.3 * random.direction<d3>();
      port.source().update(0, plane{vector(0.0, 0.0, 0.0), n, 1e3});
    }
    const auto out = port.tick(x, ph::seconds{T});
    const vector f = out.force;
    const auto& slot = port.source().slot(0);
    if (!(slot.pressed() > 0.0) || f.norm() == 0.0) continue;
    const vector n = slot.normal();
    const double normal = f.dot(n), across = (f - n * normal).norm();
    const double ratio = across / normal / rough.static_coefficient;
    const bool eased = !out.limited && std::abs(normal - slot.pressed()) > 1e-9;
    row.eased += eased;
    row.outside += eased && ratio > 1.0 + 1e-13;
    double& most = eased ? row.on_the_way : row.own;
    most = std::max(most, ratio);
  }
  return row;
}

/// Thrown on a rough plane: does it stop?
struct stop_row {
  int cases = 0, unsettled = 0;
  double slowest = 0.0, least_energy = 0.0;
  ex::at_rest still{};
};
ex::record record_of(const stop_row& r) {
  return ex::with({{"cases", r.cases},
                   {"unsettled", r.unsettled},
                   {"slowest_s", r.slowest, "%.2f"},
                   {"least_energy_J", r.least_energy}},
                  r.still);
}
/// Masses and stiffnesses over decades, each drawn by the seed within its share of them.
stop_row stop(int seed) {
  stop_row row;
  draws d(static_cast<std::uint64_t>(seed));
  for (const double decade : {0.05, 0.1, 0.15, 0.5}) {
    for (const double stiffness : {1e2, 1e3, 1e4, 1e6, 1e9}) {
      const double m = decade * d.scale(1.0, 1.4), K = stiffness / d.scale(1.0, 3.0);
      auto port = port_of<1>(all_planes()[0], m, K, beside<ph::stick_slip>{});
      sim::device<d3> device({.mass = m,
                              .damping = damping,
                              .load = vector(0.0, 0.0, -gravity * m),
                              .period = T,
                              .start = vector(0.0, 0.0, 0.02),
                              .start_velocity = vector(0.32, 0.0, 0.0)});
      sim::quiet_judge<d3> judge;
      std::vector<vector> room;
      const settled s = settle(device, port, 6.0, [&](const auto& now) {
        judge.add(now.force, device.velocity(), T, ex::pressing(port.source(), 1, room));
      });
      row.still.add(judge, stiffness_at_rest(port, 1, device.position()));
      ++row.cases;
      if (s.swing < 1e-4) {
        row.slowest = std::max(row.slowest, s.seconds);
      } else {
        ++row.unsettled;
      }
      row.least_energy = std::min(row.least_energy, s.least_energy);
    }
  }
  return row;
}

}  // namespace

std::vector<std::string> run_friction(const session& s) {
  std::vector<std::string> found;
  const double seconds = s.chosen.quick ? 10.0 : 60.0;
  const vector x = vector::UnitX(), y = vector::UnitY();

  s.out.section(
      "Friction: drift",
      "A hand presses with 2 N and pulls along the surface with 0.5 N and a tremor of 0.3 N "
      "at 9 Hz; how far the mean of a second wanders. On a normal that wobbles, at 10 Hz "
      "by an angle, it creeps: that is reported. Then tremor and wobble stop, and the pull stays." +
          std::string(ex::quiet_columns));
  const pushing_hand on_plane{.steady = vector(0.5, 0.0, -2.0), .tremor = vector(0.2, 0.15, 0.15)};
  const planes groove_90{"groove of 90 deg",
                         {tilted(45.0 * degree, 0.0), tilted(45.0 * degree, 180.0 * degree)}};
  const pushing_hand in_groove{.steady = vector(0.0, 0.3, -2.0), .tremor = vector(0.4, 0.0, 0.2)};
  std::vector<drift_row> drifts{
      hold<1>("plane at rest", all_planes()[0], on_plane, {x, y}, seconds),
      hold<2>("groove of 90 deg", groove_90, in_groove, {y}, seconds)};
  for (const double angle : {1.0, 3.0}) {
    drifts.push_back(hold<1>("plane that wobbles by " + ex::format("%.0f deg", angle),
                             all_planes()[0], on_plane, {x, y}, seconds, angle * degree));
  }
  ex::show_rows(s.out, "drift", drifts);
  for (const auto& r : {drifts[0], drifts[1]}) {
    expect(found, r.drift <= 2e-6, r.scene + ": the finger drifts");
    expect(found, r.least_energy >= -1e-12, r.scene + ": loses energy");
  }

  s.out.section("Friction: stick and slip", "Pulled along a plane by a spring.");
  const std::vector<stick_slip_row> pulled{pull()};
  ex::show_rows(s.out, "stick_slip", pulled);
  expect(found, pulled[0].slips_per_second > 1.0, "it does not slip again and again");

  s.out.section(
      "Friction: stopping",
      "Thrown along a rough plane at 0.32 m/s, 0.05 to 0.7 kg on 33 to 1e9 N/m, drawn with "
      "--seed " +
          std::to_string(s.chosen.seed) + "; the throw is the last news." + ex::quiet_columns);
  const std::vector<stop_row> stopped{stop(s.chosen.seed)};
  ex::show_rows(s.out, "stopping", stopped);
  expect(found, stopped[0].unsettled == 0, "some do not stop on a rough plane");
  expect(found, stopped[0].least_energy >= -1e-12, "stopping on a rough plane loses energy");

  s.out.section(
      "Friction: the cone",
      "Largest friction over the static coefficient times the normal force, in random motion on a "
      "plane that turns, drawn with --seed. While news are made up for the force is between one "
      "of the cone before and one of the cone now, and may be outside both: that is reported.");
  const std::vector<cone_row> cones{cone(s.chosen.seed, s.chosen.quick ? 20'000 : 1'000'000)};
  ex::show_rows(s.out, "cone", cones);
  expect(found, cones[0].own <= 1.0 + 1e-13, "friction outside its cone");
  expect(found, cones[0].eased > 0, "no news are made up for on a plane that turns");
  return found;
}

}  // namespace contacts
