// SPDX-License-Identifier: BSD-3-Clause
// Surfaces in the plane: one that heaves and tilts, a corner of two, one that rubs; a hand that schemes in a corner,
// and a wall that is felt through a cable.
// By hand: a menu of all controllers, to be compared.
#include "exports.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/simulation/compliant_device.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <utility>

namespace {

namespace ph = passive_haptics;
namespace sim = ph::simulation;
using scene = ph::space<double, 2>;
using plane = ph::half_space<scene>;
using touch_one = page::any_touch<scene, 1>;
using touch_two = page::any_touch<scene, 2>;

#define FOLLOWED \
  ph::followed<ph::half_space<scene>> {}

// ------------------------------------------------------------------------ it heaves, and tilts

#define HEAVING(name, says, ...) \
  PAGE_CONTROLLER(touch_one, name, says, ph::local_model{scene{}, FOLLOWED, __VA_ARGS__, LIMITS})

struct heaving {
  using touch = touch_one;
  static constexpr page::place home{0, 0.014};
  static constexpr page::way_point round[]{
      {0.5, {0, 0.012}}, {2.2, {-0.008, -0.014}}, {4.2, {0.008, -0.014}}, {5, {0, 0.012}}};

  static constexpr page::settings begins_with() {
    return {.stiffness = 5000, .damping = 0.3, .heave = 0.003, .tilt = 0.12};
  }
  static constexpr std::array menu{
      HEAVING("none", "A bare spring to the newest plane: each piece of news is a jump.",
              ph::turn_at_once{}, ph::spring{}, ph::no_observer{}, ph::no_bound{}),
      PAGE_CONTROLLER(
          touch_one, "make_touch",
          "What the library recommends: news moves the force smoothly, the normal turns "
          "at 2 rad/s.",
          ph::make_touch<scene>(DEVICE, HAND)),
      HEAVING("damped spring + reachable",
              "Damped, bounded by what can be given back, the normal turned at 2 rad/s.",
              ph::turn_limited{.rate = 2.0}, ph::damped_spring{.mass = mass}, LEDGER,
              HELD(REACHABLE)),
      HEAVING("damped spring + reachable, force rate",
              "The same, and no news moves the force by more than 100 N/s: smooth, and behind.",
              ph::turn_limited{.rate = 2.0},
              (ph::shaped{ph::damped_spring{.mass = mass}, ph::force_rate_limit{.rate = 100}}),
              LEDGER, HELD(REACHABLE)),
      HEAVING("thesis", "The rule of the thesis: stiff, and no promise.",
              ph::turn_limited{.rate = 2.0}, (ph::shaped{ph::spring{}, ph::thesis_rule{}}), LEDGER,
              ph::no_bound{}),
      HEAVING("strict", "Spends only what the hand has paid, whatever happens.",
              ph::turn_limited{.rate = 2.0}, ph::spring{}, LEDGER, ph::strict_bound{}),
      HEAVING("PO/PC", "Time-domain passivity: a damper when the account is overdrawn.",
              ph::turn_limited{.rate = 2.0}, ph::spring{}, ph::no_observer{},
              ph::series_passivity_controller{.max_damping = 0.5 * mass / tick}),
      PAGE_CONTROLLER(
          touch_one, "contact set, reachable",
          "News is made up for at a limited speed, so nothing jumps.",
          ph::passive_port{scene{},
                           ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{},
                                           ph::slots<ph::half_space<scene>, 1>{}},
                           LEDGER, HELD(REACHABLE), LIMITS}),
  };

  [[nodiscard]] touch::news surfaces(double time, const page::settings& set) const noexcept {
    const double slope = set.tilt * page::wave(0.8 * time);
    const double length = std::sqrt(1 + slope * slope);
    return {{{.point = {0, set.heave * page::wave(1.1 * time)},
              .normal = {slope / length, 1 / length},
              .stiffness = set.stiffness}}};
  }
};

// ------------------------------------------------------------------------ a corner of two walls

#define CORNER(name, says, source, ...) \
  PAGE_CONTROLLER(touch_two, name, says, ph::passive_port{scene{}, source, __VA_ARGS__, LIMITS})
#define WALL(law)                     \
  ph::local_contact {                 \
    FOLLOWED, ph::turn_at_once{}, law \
  }
#define SET_OF_TWO                                                \
  (ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{}, \
                   ph::slots<ph::half_space<scene>, 2>{}})
#define PORT_OF_ITS_OWN                                                                     \
  ph::local_model {                                                                         \
    scene{}, FOLLOWED, ph::turn_at_once{}, ph::spring{}, LEDGER, ph::strict_bound{}, LIMITS \
  }

// In the corner of the scheming hand, too.
constexpr auto bare_springs = CORNER("none", "Two bare springs, added.",
                                     (ph::contacts{WALL(ph::spring{}), WALL(ph::spring{})}),
                                     ph::no_observer{}, ph::no_bound{});
constexpr auto a_port_each =
    PAGE_CONTROLLER(touch_two, "a port each (wrong)",
                    "Both types say strict, and both spend the one damping. Who shakes on "
                    "purpose is paid for it: example 16.",
                    std::pair{PORT_OF_ITS_OWN, PORT_OF_ITS_OWN});
constexpr auto one_port =
    CORNER("one port, strict", "The sum of two springs in one port: one account.",
           (ph::contacts{WALL(ph::spring{}), WALL(ph::spring{})}), LEDGER, ph::strict_bound{});
constexpr auto strict_set = CORNER("contact set, strict", "One spring, bounded strictly.",
                                   SET_OF_TWO, LEDGER, ph::strict_bound{});

struct corner {
  using touch = touch_two;
  static constexpr page::place home{0.014, 0.014};
  static constexpr page::way_point round[]{
      {0.5, {0.012, 0.012}}, {2.6, {-0.012, -0.012}}, {3.8, {-0.016, -0.004}}, {5, {0.012, 0.012}}};

  static constexpr page::settings begins_with() { return {.stiffness = 10000, .damping = 0.3}; }
  static constexpr std::array menu{
      bare_springs,
      PAGE_CONTROLLER(
          touch_two, "make_contacts",
          "What the library recommends: one spring, however many walls; settles.",
          ph::make_contacts<scene>(DEVICE, HAND, ph::slots<ph::half_space<scene>, 2>{})),
      CORNER("contact set, reachable", "One spring, however many walls; settles.", SET_OF_TWO,
             LEDGER, REACHABLE),
      a_port_each,
      one_port,
      CORNER("one port, reachable", "The sum of two damped springs, for a known mass and hand.",
             (ph::contacts{WALL(ph::damped_spring{.mass = mass}),
                           WALL(ph::damped_spring{.mass = mass})}),
             LEDGER, REACHABLE),
      strict_set,
      CORNER("contact set, no bound", "One spring, and nobody counts.", SET_OF_TWO,
             ph::no_observer{}, ph::no_bound{}),
  };

  [[nodiscard]] touch::news surfaces(double time, const page::settings& set) const noexcept {
    const double up = set.heave * page::wave(1.1 * time);
    return {{{.point = {0, up}, .normal = {0, 1}, .stiffness = set.stiffness},
             {.point = {0, 0}, .normal = {1, 0}, .stiffness = set.stiffness}}};
  }
};

// ------------------------------------------------------------------------ a hand that schemes

/// No motor stops this hand. Left alone it shakes in free air, for which every account of the device books what its
/// damping takes, and then in and out of the corner until it has drawn all that; else it goes where the reader's is.
class schemer {
 public:
  using vector = scene::vector;
  bool alone = true;

  schemer() noexcept = default;
  schemer(const page::settings& set, const scene::coordinates& home,
          const sim::impedance_hand<scene>& /*holding*/) noexcept
      : motion_({.damping = set.damping,
                 .force_limit = set.motors,
                 .quantum = set.quantum,
                 .period = page::tick_length,
                 .start = home,
                 .latency = static_cast<int>(set.late)}),
        goal_(home) {}

  ph::device_sample<scene> exchange(const vector& force) noexcept {
    const vector here = motion_.position();
    if (alone) {
      const double t = time();
      const double share = t / 1.2 - static_cast<double>(static_cast<int>(t / 1.2));
      const double to =
          share < 2.0 / 3 ? 0.008 + 0.004 * page::wave(20 * t) : -0.002 * page::wave(70 * t);
      goal_ = vector(to, to);
    }
    const vector next = here + sim::clamp_norm<scene>(vector(goal_ - here), 8e-4);
    motion_.move_to(next);
    velocity_ = (next - here) / page::tick_length;
    return motion_.exchange(force);
  }
  schemer& hand() noexcept { return *this; }
  void aim(const vector& to, const vector& /*velocity*/, double /*time*/) noexcept { goal_ = to; }
  [[nodiscard]] vector position() const noexcept { return motion_.position(); }
  [[nodiscard]] vector velocity() const noexcept { return velocity_; }
  [[nodiscard]] double time() const noexcept { return motion_.time(); }
  [[nodiscard]] const auto& meter() const noexcept { return motion_.meter(); }

 private:
  sim::prescribed_motion<scene> motion_{};
  vector goal_ = scene::zero(), velocity_ = scene::zero();
};

struct scheme : corner {
  using device = schemer;
  static constexpr page::place home{0.004, 0.004};
  static constexpr page::way_point round[]{{0.02, {0.002, 0.002}}, {0.04, {0, 0}}};
  static constexpr std::array menu{
      bare_springs,
      a_port_each,
      one_port,
      CORNER("one port, memoryless", "Strict from the last tick alone; saves nothing.",
             (ph::contacts{WALL(ph::spring{}), WALL(ph::spring{})}), LEDGER,
             ph::memoryless_bound{}),
      CORNER("one port, energy tank", "A tank that allows for the worst motion of the next tick.",
             (ph::contacts{WALL(ph::spring{}), WALL(ph::spring{})}), LEDGER,
             ph::energy_tank{.reserve = 1e-6}),
      strict_set,
  };
};

// ------------------------------------------------------------------------ through a cable

using rail = ph::space<double, 1>;
using touch_rail = page::any_touch<rail, 1>;
constexpr double rotor = 0.1;  ///< share of the mass that is the motor's

/// A motor, a cable, and the handle behind it, which the hand holds.
class cabled {
 public:
  using arm = sim::compliant_device<rail, sim::impedance_hand<rail>>;

  cabled() noexcept = default;
  cabled(const page::settings& set, double home, const sim::impedance_hand<rail>& holding) noexcept
      : arm_({.mass = set.mass,
              .share = rotor,
              .mode = set.mode,
              .damping = set.damping,
              .friction = set.friction,
              .force_limit = set.motors,
              .quantum = set.quantum,
              .start = home,
              .period = page::tick_length,
              .latency = static_cast<int>(set.late)},
             holding),
        before_(home) {}

  ph::device_sample<rail> exchange(double force) noexcept {
    before_ = arm_.position();
    return arm_.exchange(force);
  }
  auto& hand() noexcept { return arm_.hand(); }
  [[nodiscard]] double position() const noexcept { return arm_.position(); }
  [[nodiscard]] double velocity() const noexcept {
    return (arm_.position() - before_) / page::tick_length;
  }
  [[nodiscard]] double time() const noexcept { return arm_.time(); }
  struct paid {
    double energy;
    [[nodiscard]] double with_friction() const noexcept { return energy; }
  };
  [[nodiscard]] paid meter() const noexcept { return {arm_.energy()}; }

 private:
  arm arm_{};
  double before_ = 0;
};

#define THROUGH(name, says, ...)                                                  \
  PAGE_CONTROLLER(touch_rail, name, says,                                         \
                  ph::local_model{scene{}, ph::followed<ph::half_space<scene>>{}, \
                                  ph::turn_at_once{}, __VA_ARGS__, LIMITS})

namespace of_a_rail {
using scene = rail;  // as the reader's program calls it

struct cable {
  using touch = touch_rail;
  using device = cabled;
  static constexpr page::place home{0, 0.012};
  static constexpr page::way_point round[]{{0.5, {0, 0.010}},
                                           {2.2, {0, -0.016}},
                                           {2.6, {0, 0.010}},
                                           {4.4, {0, -0.016}},
                                           {5, {0, 0.010}}};

  static constexpr page::settings begins_with() {
    return {.stiffness = 10000, .damping = 0.1, .mode = 60};
  }
  static constexpr std::array menu{
      THROUGH("none", "A bare spring.", ph::spring{}, ph::no_observer{}, ph::no_bound{}),
      PAGE_CONTROLLER(touch_rail, "make_touch", "It takes motor and handle for one mass.",
                      ph::make_touch<scene>(DEVICE, HAND)),
      PAGE_CONTROLLER(touch_rail, "make_touch, a cable",
                      "It was told of the cable: the motor's own mass, and how fast the cable's "
                      "pull can change.",
                      ph::make_touch<scene>(
                          DEVICE,
                          ph::observed_transmission{
                              .rotor = 0.1 * mass,
                              .rotor_above = 0.103 * mass,
                              .slew = ph::slew_of(ph::two_masses(mass, 0.1, mode, 0.03, damping),
                                                  hand_force, motors, 1.0)},
                          HAND)),
      THROUGH("damped spring + reachable", "The same mistake by hand.",
              ph::damped_spring{.mass = mass}, LEDGER, HELD(REACHABLE)),
      THROUGH("strict", "Spends only what the hand has paid, whatever there is between.",
              ph::spring{}, LEDGER, ph::strict_bound{}),
      THROUGH("memoryless", "Strict from the last tick alone; saves nothing.", ph::spring{}, LEDGER,
              ph::memoryless_bound{}),
  };

  [[nodiscard]] touch::news surfaces(double time, const page::settings& set) const noexcept {
    return {
        {{.point = set.heave * page::wave(1.1 * time), .normal = 1, .stiffness = set.stiffness}}};
  }
};
}  // namespace of_a_rail

// ------------------------------------------------------------------------ it rubs

#define RUBBING(name, says, friction, ...)                                                      \
  PAGE_CONTROLLER(                                                                              \
      touch_one, name, says,                                                                    \
      ph::passive_port{scene{},                                                                 \
                       ph::contact_set{ph::proxy_spring{.mass = mass}, ph::pursuit{}, friction, \
                                       ph::slots<ph::half_space<scene>, 1>{}},                  \
                       __VA_ARGS__, LIMITS})
#define ROUGH \
  (ph::stick_slip{.static_coefficient = roughness, .kinetic_coefficient = 0.66 * roughness})

struct rubbing {
  using touch = touch_one;
  static constexpr page::place home{-0.02, 0.010};
  static constexpr page::way_point round[]{{0.5, {-0.02, 0.010}},  {1.2, {-0.02, -0.014}},
                                           {2.4, {0.03, -0.014}},  {3.2, {0.03, -0.014}},
                                           {4.4, {-0.03, -0.014}}, {5, {-0.02, 0.010}}};

  static constexpr page::settings begins_with() { return {.stiffness = 2000, .damping = 0.2}; }
  static constexpr std::array menu{
      PAGE_CONTROLLER(
          touch_one, "make_contacts", "Nothing rubs: the device slides under the hand.",
          ph::make_contacts<scene>(DEVICE, HAND, ph::slots<ph::half_space<scene>, 1>{})),
      PAGE_CONTROLLER(
          touch_one, "make_contacts, rough", "A bristle bends while the surface holds, and slips.",
          ph::make_contacts<scene>(DEVICE, HAND, ROUGH, ph::slots<ph::half_space<scene>, 1>{})),
      RUBBING("smooth, reachable", "Nothing rubs: the device slides under the hand.",
              ph::frictionless{}, LEDGER, REACHABLE),
      RUBBING("rough, reachable", "A bristle bends while the surface holds, and slips.", ROUGH,
              LEDGER, REACHABLE),
      RUBBING("rough, none", "Friction and pressure, and nobody counts.", ROUGH, ph::no_observer{},
              ph::no_bound{}),
      RUBBING("rough, strict", "Pressure and friction out of what the hand has paid.", ROUGH,
              LEDGER, ph::strict_bound{}),
      RUBBING("rough, energy tank", "The same out of a tank.", ROUGH, LEDGER,
              ph::energy_tank{.reserve = 1e-6}),
      RUBBING("rough, memoryless", "Strict from the last tick alone.", ROUGH, LEDGER,
              ph::memoryless_bound{}),
      RUBBING("smooth, strict", "Nothing rubs; strict.", ph::frictionless{}, LEDGER,
              ph::strict_bound{}),
  };

  [[nodiscard]] touch::news surfaces(double time, const page::settings& set) const noexcept {
    return {{{.point = {0, set.heave * page::wave(1.1 * time)},
              .normal = {0, 1},
              .stiffness = set.stiffness}}};
  }
};

page::stage_of<heaving> heaves;
page::stage_of<corner> corners;
page::stage_of<rubbing> rubs;
page::stage_of<scheme> schemes;
page::stage_of<of_a_rail::cable> pulls;

}  // namespace

std::span<page::stage* const> page::stages() noexcept {
  static constexpr std::array<page::stage*, 5> all{&heaves, &corners, &rubs, &schemes, &pulls};
  return all;
}
