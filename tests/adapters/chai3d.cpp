// SPDX-License-Identifier: BSD-3-Clause
// CHAI3D's adapter, in front of a simulated device, with an interface of our own in CHAI3D's
// place: a proxy on a sphere that is stiffer than the device's damping pays for, that deforms, in
// a workspace that is scaled.
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include <passive_haptics/adapters/chai3d.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/contact/shaped.hpp>
#include <passive_haptics/shaper/force_rate_limit.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/six_dof.hpp>

#include <limits>
#include <numbers>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace ad = ph::adapters;
namespace c3d = chai3d;

namespace {

using scene = ph::space<double, 3>;
using vec = Eigen::Vector3d;
static_assert(ad::hand_port<scene> && !ad::hand_port<ph::space<double, 1>>);
static_assert(ad::turning_port<ph::rigid_body<double>> && !ad::turning_port<scene>);
constexpr double T = 1e-3, mass = 0.1, damping = 0.1;

/// Time that the tests make.
struct made_clock {
  static inline std::chrono::nanoseconds time{0};
  static std::chrono::nanoseconds now() noexcept { return time; }
  static void pass(double seconds) noexcept {
    time += std::chrono::nanoseconds(std::llround(1e9 * seconds));
  }
};

/// What CHAI3D would call a driver: each force is held for a millisecond. The hand presses with a newton.
class simulated : public c3d::cGenericHapticDevice {
 public:
  using hand_type = sim::impedance_hand<scene>;

  simulated()
      : device_({.mass = mass, .damping = damping, .start = vec(0.0, 0.0, 0.055)},
                hand_type{.stiffness = 300.0, .damping = 0.5, .target = vec(0.0, 0.0, 0.047)}) {}
  bool open() override {
    m_specifications.m_maxLinearForce = 8.0;
    m_specifications.m_maxLinearStiffness = 3000.0;
    m_specifications.m_workspaceRadius = 0.1;
    m_deviceAvailable = true;
    return m_deviceReady = opens;
  }
  bool close() override {
    m_deviceReady = false;
    return true;
  }
  bool getPosition(c3d::cVector3d& x) override {
    x = ad::chai3d_types::vector(vec(unit * device_.position()));
    return reads;
  }
  bool getRotation(c3d::cMatrix3d& r) override {
    r.identity();
    if (mirrored) r(2, 2) = -1.0;
    return true;
  }
  bool getUserSwitches(unsigned int& all) override {
    all = 5;
    return true;
  }
  bool setForceAndTorqueAndGripperForce(const c3d::cVector3d& f, const c3d::cVector3d& t,
                                        double g) override {
    force = ad::chai3d_types::vector(f);
    torque = ad::chai3d_types::vector(t);
    gripper = g;
    ++forces;
    if (!takes) force.setZero();
    static_cast<void>(device_.exchange(motors ? force : vec::Zero()));
    made_clock::pass(T);
    return takes;
  }

  bool enableForces(bool on) override {
    if (switches) motors = on;
    return switches;
  }

  [[nodiscard]] double least_energy() const { return device_.meter().minimum(); }
  [[nodiscard]] vec place() const { return device_.position(); }
  [[nodiscard]] double speed() const { return device_.velocity().norm(); }
  hand_type& hand() { return device_.hand(); }

  bool opens = true, reads = true, takes = true, mirrored = false;
  bool motors = true, switches = true;
  double unit = 1.0;  ///< positions per metre
  vec force = vec::Zero(), torque = vec::Zero();
  double gripper = 0.0;
  int forces = 0;

 private:
  sim::device<scene, hand_type> device_;
};

auto strict_port() {
  return ph::make_strict_guard<scene>({damping}, ph::actuator_limit{1e3}, 1.01 * T);
}
auto reachable_port() {
  return ph::passive_port{scene{}, ph::given_force{}, ph::reduced_energy{.damping = damping},
                          ph::bound_chain{ph::reachable_bound{.mass = mass, .hand_force = 5.0},
                                          ph::actuator_limit{.most = 8.0}},
                          ph::loop_limits{.longest_tick = 1.01 * T}};
}
template <class Port>
auto decorate(std::shared_ptr<simulated> device, const Port& port) {
  return std::make_shared<ad::passive_device<Port, made_clock>>(std::move(device), port);
}

/// As a tool with a scaled workspace: position, proxy, force.
void touch(c3d::cGenericHapticDevice& device, c3d::cAlgorithmFingerProxy& proxy, double scale) {
  c3d::cVector3d x;
  device.getPosition(x);
  const auto global = ad::chai3d_types::vector(vec(scale * ad::chai3d_types::vector(x)));
  device.setForceAndTorqueAndGripperForce(proxy.computeForces(global, {}), {}, 0.0);
}

struct outcome {
  double least_energy, rms_speed, depth;  ///< [J], [m/s] of the last second, [m]
};
/// Six seconds on a sphere of that stiffness [N/m of the scene].
outcome press(bool guarded, double stiffness, double scale = 1.0) {
  auto real = std::make_shared<simulated>();
  c3d::cGenericHapticDevicePtr device = real;
  if (guarded) device = decorate(real, reachable_port());
  REQUIRE(device->open());
  c3d::cWorld world{.radius = 0.05 * scale, .stiffness = stiffness};
  c3d::cAlgorithmFingerProxy proxy;
  proxy.initialize(&world, ad::chai3d_types::vector(vec(scale * real->place())));
  double squares = 0.0;
  for (int k = 0; k < 6000; ++k) {
    touch(*device, proxy, scale);
    if (k >= 5000) squares += real->speed() * real->speed();
  }
  return {real->least_energy(), std::sqrt(squares / 1000.0), 0.05 - real->place().norm()};
}

}  // namespace

TEST_CASE("a proxy on a stiff sphere feeds the hand, and through passive_device it does not",
          "[adapters][chai3d]") {
  CHECK(press(false, 2000.0).least_energy < -0.01);
  CHECK(press(false, 8000.0).least_energy < -0.05);
  for (const double K : {500.0, 2000.0, 8000.0}) {
    const outcome calm = press(true, K);
    INFO(K);
    CHECK(calm.least_energy >= -1e-12);
    if (K > 1000.0) CHECK(calm.rms_speed < 0.05 * press(false, K).rms_speed);
    CHECK(calm.depth < 0.003);  // there is a sphere: the hand alone would be 3 mm deep
  }
}

TEST_CASE("a hand that sinks in while CHAI3D has the forces off is credited with nothing",
          "[adapters][chai3d]") {
  const auto run = [](auto port, bool switches, bool at_once) {
    auto real = std::make_shared<simulated>();
    real->switches = switches;
    auto device = decorate(real, port);
    REQUIRE(device->open());
    double largest = 0.0;
    const auto press = [&](double z, int ticks) {
      real->hand().target = vec(0.0, 0.0, z);
      for (int k = 0; k < ticks; ++k) {
        const vec x = real->place();
        device->setForce(
            ad::chai3d_types::vector(vec(0.0, 0.0, 1500.0 * std::max(0.05 - x(2), 0.0))));
        largest = std::max(largest, real->force.norm());
      }
    };
    press(0.047, 500);
    REQUIRE(largest > 0.4);
    for (int n = 0; n < 10; ++n) {
      CHECK(device->enableForces(false) == switches);
      if (at_once) CHECK(device->enableForces(true) == switches);
      press(0.03, 200);
      if (switches && !at_once) {
        CHECK(device->last().what == ph::event::forces_off);
        CHECK(real->force.norm() == 0.0);
      }
      CHECK(device->enableForces(true) == switches);
      press(0.055, 200);
      CHECK(device->last().what != ph::event::forces_off);
    }
    return real->least_energy();
  };
  for (const bool at_once : {false, true}) {
    CAPTURE(at_once);
    CHECK(run(strict_port(), true, at_once) >= -1e-12);
    CHECK(run(reachable_port(), true, at_once) >= -1e-12);
    CHECK(run(reachable_port(), false, at_once) >= -1e-12);  // one that cannot switch them
  }
}

TEST_CASE("passive_device counts the device's own metres, whatever the workspace's scale",
          "[adapters][chai3d]") {
  CHECK(press(false, 800.0, 5.0).least_energy < -0.01);
  CHECK(press(true, 800.0, 5.0).least_energy >= -1e-12);

  // The control: a port that is told the scene's positions believes in five times the damping's work.
  auto real = std::make_shared<simulated>();
  c3d::cWorld world{.radius = 0.25, .stiffness = 800.0};
  c3d::cAlgorithmFingerProxy proxy;
  auto port = reachable_port();
  vec x = 5.0 * real->place();
  proxy.initialize(&world, ad::chai3d_types::vector(x));
  for (int k = 0; k < 6000; ++k) {
    x = 5.0 * real->place();
    const auto wanted = proxy.computeForces(ad::chai3d_types::vector(x), {});
    const auto out = port.tick(x, ph::seconds{T}, ad::chai3d_types::vector(wanted));
    real->setForce(ad::chai3d_types::vector(vec(out.force)));
  }
  CHECK(real->least_energy() < -1e-3);
}

namespace {

struct felt {
  double lost = 0.0;          ///< share of the ticks without a force
  double largest_step = 0.0;  ///< of the force [N]
  double least_energy = 0.0;  ///< [J]
};
/// A sphere that breathes by `amplitude` [m] twice a second and is published 30 times a second.
felt breathe(double amplitude, auto&& force_at) {
  auto real = std::make_shared<simulated>();
  REQUIRE(real->open());
  c3d::cWorld world{.radius = 0.05, .stiffness = 1000.0};
  felt f;
  vec last = vec::Zero();
  for (int k = 0; k < 6000; ++k) {
    const bool updated = k % 33 == 0;
    if (updated) {
      world.radius = 0.05 + amplitude * std::sin(4.0 * std::numbers::pi * k * T);
    }
    const vec force = force_at(world, real->place(), updated);
    real->setForce(ad::chai3d_types::vector(force));
    if (k > 500) {
      f.lost += force.norm() < 0.05 ? 1.0 / 5499.0 : 0.0;
      f.largest_step = std::max(f.largest_step, (force - last).norm());
    }
    last = force;
  }
  f.least_energy = real->least_energy();
  return f;
}

}  // namespace

TEST_CASE("a sphere that deforms is lost by an old proxy, and kept by a probe with each update",
          "[adapters][chai3d]") {
  c3d::cAlgorithmFingerProxy old;
  bool began = false;
  const felt lost = breathe(1e-3, [&](c3d::cWorld& world, const vec& x, bool) -> vec {
    if (!std::exchange(began, true)) old.initialize(&world, ad::chai3d_types::vector(x));
    return ad::chai3d_types::vector(old.computeForces(ad::chai3d_types::vector(x), {}));
  });
  CHECK(lost.lost > 0.5);

  // At 3 mm an update drops the surface by more than the hand is deep, and the hand hovers.
  const auto kept_by = [](auto wall, double amplitude) {
    std::optional<ad::proxy_probe<>> probe;
    return breathe(amplitude, [&](c3d::cWorld& world, const vec& x, bool updated) -> vec {
      if (!probe) probe.emplace(&world, 1e-3, 0.02);
      if (updated) {
        if (const auto plane = probe->at(x, 1000.0)) {
          wall.update(*plane);
        } else {
          wall.release();
        }
      }
      return wall.tick(x, ph::seconds{T}).force;
    });
  };
  for (const double amplitude : {1e-3, 3e-3}) {
    const felt by_hand = kept_by(
        ph::local_model{
            scene{}, ph::followed<ph::half_space<scene>>{}, ph::turn_limited{.rate = 4.0},
            ph::shaped{ph::damped_spring{.mass = mass}, ph::force_rate_limit{.rate = 50.0}},
            ph::reduced_energy{.damping = damping},
            ph::bound_chain{ph::reachable_bound{.mass = mass, .hand_force = 5.0},
                            ph::actuator_limit{.most = 8.0}},
            ph::loop_limits{.longest_tick = T}},
        amplitude);
    const felt touch = kept_by(
        ph::make_touch<scene>(
            {.mass = mass, .damping = damping, .force_limit = 8.0, .longest_tick = 1.01 * T},
            {.force = 5.0}),
        amplitude);
    INFO(amplitude << ": by hand " << by_hand.largest_step << " N; touch " << touch.lost << ", "
                   << touch.largest_step << " N");
    CHECK(by_hand.lost == 0.0);
    CHECK(touch.lost <= (amplitude < 2e-3 ? 0.0 : 0.03));
    CHECK(by_hand.largest_step <= 0.2);
    CHECK(touch.largest_step < 0.7 * by_hand.largest_step);
    CHECK(by_hand.least_energy >= -1e-12);
    CHECK(touch.least_energy >= -1e-12);
  }
}

namespace {

/// A finger proxy of CHAI3D's that is a mesh::proxy: it has a memory, and no mesh passes it by.
struct mesh_proxy : c3d::cAlgorithmFingerProxy {
  c3d::cVector3d computeForces(const c3d::cVector3d& tool, const c3d::cVector3d&) override {
    ball.step({tool.x(), tool.y(), tool.z()}, watch.lap(1e-3));
    const ph::mesh::triple at = ball.place(), force = ball.push() * 1000.0;  // N/m
    setProxyGlobalPosition({at.x, at.y, at.z});
    return {force.x, force.y, force.z};
  }
  ph::mesh::proxy ball{{.radius = 1e-3}};
  ph::basic_stopwatch<made_clock> watch;  // outside of a test ph::stopwatch
};

}  // namespace

TEST_CASE("a sphere that deforms is kept by a proxy of CHAI3D's that is a mesh::proxy",
          "[adapters][chai3d]") {
  const meshes::body rest = meshes::sphere(3, 0.05);
  for (const double amplitude : {1e-3, 3e-3}) {
    ph::mesh::surface organ(rest.triangles, rest.nodes);
    mesh_proxy proxy;
    REQUIRE(proxy.ball.touch(organ));
    c3d::cAlgorithmFingerProxy& theirs = proxy;  // as a haptic point holds it
    auto port = ph::make_guard<scene>(
        {.mass = mass, .damping = damping, .force_limit = 8.0, .longest_tick = 1.01 * T},
        {.force = 5.0});
    const felt kept =
        breathe(amplitude, [&](const c3d::cWorld& world, const vec& x, bool updated) -> vec {
          if (updated) {
            auto nodes = rest.nodes;
            for (auto& p : nodes) p = p * (world.radius / 0.05);
            REQUIRE(organ.update(nodes));
          }
          const auto wanted = theirs.computeForces(ad::chai3d_types::vector(x), {});
          return port.tick(x, ph::seconds{T}, ad::chai3d_types::vector(wanted)).force;
        });
    INFO(amplitude << ": " << kept.lost << ", " << kept.largest_step << " N");
    CHECK(kept.lost == 0.0);
    CHECK(kept.largest_step <= 0.2);
    CHECK(kept.least_energy >= -1e-12);
    CHECK(ad::chai3d_types::vector(proxy.getProxyGlobalPosition()).norm() > 0.046);
    proxy.ball.let_go();
  }
}

TEST_CASE("a probe follows a finger to the other side", "[adapters][chai3d]") {
  c3d::cWorld world{.radius = 0.05, .stiffness = 800.0};
  ad::proxy_probe<> probe(&world, 0.0, 0.02);
  for (double turned = 0.0; turned < std::numbers::pi; turned += 0.1) {
    const vec out(std::sin(turned), 0.0, std::cos(turned));
    const auto plane = probe.at(vec(0.049 * out), 800.0);
    INFO(turned);
    REQUIRE(plane);
    CHECK((vec(plane->normal) - out).norm() < 1e-9);
  }
  // The control: from above there is no way to the lower side.
  CHECK_FALSE(ad::proxy_probe<>(&world, 0.0, 0.02).at(vec(0.0, 0.0, -0.049), 800.0));
}

TEST_CASE("a probe tells a finger that hovers of the surface below it, as far as it reaches",
          "[adapters][chai3d]") {
  c3d::cWorld world{.radius = 0.05, .stiffness = 800.0};
  ad::proxy_probe<> probe(&world, 1e-3, 0.02);  // a finger of 1 mm
  const auto below = probe.at(vec(0.0, 0.0, 0.06), 800.0);
  REQUIRE(below);
  CHECK((vec(below->point) - vec(0.0, 0.0, 0.051)).norm() < 1e-9);
  CHECK((vec(below->normal) - vec::UnitZ()).norm() < 1e-9);
  CHECK_FALSE(probe.at(vec(0.0, 0.0, 0.072), 800.0));
  REQUIRE(probe.at(vec(0.0, 0.0, 0.070), 800.0));
}

TEST_CASE("a probe answers in the device's frame and metres", "[adapters][chai3d]") {
  c3d::cWorld world{.radius = 0.05, .stiffness = 800.0};
  ad::workspace_map map{.scale = 5.0, .origin = vec(0.0, 0.0, 0.02)};
  map.rotation = Eigen::AngleAxisd(0.3, vec::UnitX()).toRotationMatrix();
  REQUIRE_FALSE(map.check());
  const vec device(0.0, 0.001, 0.005), there = map.to_scene(device);
  ad::proxy_probe<> probe(&world, 0.0, 0.05, map, there);
  const auto plane = probe.at(device, 800.0);
  REQUIRE(plane);
  const vec surface = map.to_scene(vec(plane->point));
  CHECK(std::abs(surface.norm() - 0.05) < 1e-9);
  CHECK((map.rotation * vec(plane->normal) - there.normalized()).norm() < 1e-9);
  CHECK(plane->stiffness == 4000.0);  // newtons a metre of the device
  // The force is that of the scene: 800 N/m times the depth there.
  const double depth = (vec(plane->point) - device).dot(vec(plane->normal));
  CHECK(std::abs(plane->stiffness * depth - 800.0 * (0.05 - there.norm())) < 1e-9);

  CHECK_FALSE(probe.at(vec(0.0, 0.0, 0.02), 800.0));  // 120 mm up, free
  CHECK_FALSE(probe.at(vec::Constant(std::numeric_limits<double>::quiet_NaN()), 800.0));
  CHECK_FALSE(probe.at(device, std::numeric_limits<double>::quiet_NaN()));
  map.rotation.col(0) *= -1.0;
  CHECK(std::string(map.check().parameter) == "rotation");
  CHECK_FALSE(ad::proxy_probe<>(&world, 0.0, 0.05, map).at(device, 800.0));
  CHECK(std::string(ad::workspace_map{.scale = 0.0}.check().parameter) == "scale");
  CHECK(std::string(ad::proxy_probe<>(nullptr, 0.0, 0.05).check().parameter) == "world");
  CHECK(std::string(ad::proxy_probe<>(&world, 0.0, 0.0).check().parameter) == "reach");
  CHECK(std::string(ad::proxy_probe<>(&world, -1.0, 0.1).check().parameter) == "radius");
}

TEST_CASE("passive_device is the device that it decorates in all but the force",
          "[adapters][chai3d]") {
  auto real = std::make_shared<simulated>();
  auto device = decorate(real, strict_port());
  REQUIRE_FALSE(device->check());
  REQUIRE(device->open());
  CHECK(device->isDeviceReady());
  CHECK(device->getSpecifications().m_workspaceRadius == 0.1);
  const auto facts = ad::facts_of(device->getSpecifications());
  CHECK(facts.peak_force.value == 8.0);
  CHECK(facts.stiffness.value == 3000.0);
  CHECK_FALSE(facts.damping);
  unsigned int all = 0;
  CHECK(device->getUserSwitches(all));
  CHECK(all == 5);
  CHECK(device->close());
  CHECK_FALSE(device->isDeviceReady());
  real->opens = false;
  CHECK_FALSE(device->open());
}

TEST_CASE("passive_device measures its ticks, and opening it begins anew", "[adapters][chai3d]") {
  auto real = std::make_shared<simulated>();
  auto device = decorate(real, strict_port());
  REQUIRE(device->open());
  CHECK(device->setForce({}));
  CHECK(device->last().what == ph::event::nominal);  // the first tick has no time yet
  for (int k = 0; k < 100; ++k) device->setForce({0.0, 0.0, 0.1});
  CHECK(device->last().what == ph::event::nominal);
  CHECK(device->last().energy > 0.0);
  made_clock::pass(5.0 * T);
  device->setForce({});
  CHECK(device->last().what == ph::event::late_tick);

  CHECK(device->close());
  made_clock::pass(60.0);
  REQUIRE(device->open());
  device->setForce({});
  CHECK(device->last().what == ph::event::nominal);
  CHECK(device->last().energy == 0.0);
}

TEST_CASE("a second port on a device is refused, and so are no device and no metres",
          "[adapters][chai3d]") {
  auto real = std::make_shared<simulated>();
  auto once = decorate(real, strict_port());
  ad::passive_device<decltype(strict_port()), made_clock> twice(once, strict_port());
  CHECK(std::string(twice.check().parameter) == "device");
  CHECK_FALSE(twice.open());
  CHECK_FALSE(twice.setForce({0.0, 0.0, 1.0}));
  CHECK(real->forces == 0);
  CHECK(once->open());  // the control

  ad::passive_device<decltype(strict_port()), made_clock> none(nullptr, strict_port());
  CHECK(std::string(none.check().remedy).find("cHapticDeviceHandler") != std::string::npos);
  CHECK_FALSE(none.open());
  CHECK_FALSE(none.close());
  CHECK_FALSE(none.setForce({0.0, 0.0, 1.0}));
  c3d::cVector3d x;
  CHECK_FALSE(none.getPosition(x));

  auto bad = decorate(real, ph::make_strict_guard<scene>({-1.0}, ph::actuator_limit{1e3}, T));
  CHECK(std::string(bad->check().parameter) == "damping");
  CHECK_FALSE(bad->open());

  real->unit = 1e3;  // millimetres
  CHECK_FALSE(once->open());
  CHECK_FALSE(real->isDeviceReady());
  CHECK(std::string(once->check().remedy).find("millimetres") != std::string::npos);
  CHECK_FALSE(once->setForce({0.0, 0.0, 1.0}));
  real->unit = 1.0;
  CHECK(once->open());
}

TEST_CASE("what no ledger counts is refused: a torque where nothing turns, a gripper's force",
          "[adapters][chai3d]") {
  auto real = std::make_shared<simulated>();
  auto device = decorate(real, strict_port());
  REQUIRE(device->open());
  CHECK(device->setForceAndTorqueAndGripperForce({}, {}, 0.0));
  CHECK_FALSE(device->has_refused());
  CHECK(device->setForceAndTorqueAndGripperForce({}, {0.0, 0.1, 0.0}, 0.0));
  CHECK(device->has_refused());
  CHECK(real->torque.isZero());
  CHECK(device->setForceAndTorqueAndGripperForce({}, {}, 1.0));
  CHECK(device->has_refused());
  CHECK(real->gripper == 0.0);
}

TEST_CASE("bad samples, mirrored frames and numbers that are none push nothing",
          "[adapters][chai3d]") {
  auto real = std::make_shared<simulated>();
  auto device = decorate(real, reachable_port());
  REQUIRE(device->open());
  const auto moves = [&] {
    real->hand().target = vec(0.0, 0.0, real->place().z() + 0.01);
    for (int k = 0; k < 200; ++k) device->setForce({});
  };
  moves();
  CHECK(device->setForce({0.0, 0.0, 0.5}));
  CHECK(real->force.z() > 0.0);  // the control: the ledger has something
  real->reads = false;
  device->setForce({0.0, 0.0, 0.5});
  CHECK(real->force.isZero());
  CHECK(device->last().what == ph::event::rejected_sample);
  real->reads = true;
  moves();
  real->takes = false;  // a driver that lets go
  CHECK_FALSE(device->setForce({0.0, 0.0, 0.5}));
  CHECK(device->last().what == ph::event::rejected_sample);
  CHECK(vec(device->last().force).isZero());
  real->takes = true;
  CHECK(device->setForce({}));
  CHECK(device->last().what == ph::event::nominal);
  moves();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  device->setForce({nan, 0.0, 0.0});
  CHECK(device->last().what == ph::event::rejected_target);
  CHECK(real->force.allFinite());

  using wrench = ph::passive_port<ph::rigid_body<double>, ph::given_force,
                                  ph::basic_reduced_energy<ph::rigid_damping>, ph::strict_bound>;
  const wrench port{
      ph::rigid_body<double>{}, ph::given_force{},
      ph::basic_reduced_energy<ph::rigid_damping>{.damping = {.linear = 0.1, .angular = 1e-4}},
      ph::strict_bound{}, ph::loop_limits{.longest_tick = 1.01 * T}};
  REQUIRE_FALSE(port.check());
  auto turning = decorate(real, port);
  REQUIRE(turning->open());
  for (int k = 0; k < 300; ++k) turning->setForceAndTorqueAndGripperForce({0.0, 0.0, 0.2}, {}, 0.0);
  CHECK(turning->last().what == ph::event::nominal);
  CHECK(turning->setForceAndTorqueAndGripperForce({}, {0.0, 0.0, 1e-6}, 0.0));
  CHECK_FALSE(turning->has_refused());
  CHECK(real->torque.z() == 1e-6);
  real->mirrored = true;
  turning->setForceAndTorqueAndGripperForce({0.0, 0.0, 0.2}, {}, 0.0);
  CHECK(turning->last().what == ph::event::rejected_sample);
  CHECK(real->force.isZero());
}
