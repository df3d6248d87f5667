// SPDX-License-Identifier: BSD-3-Clause
// DHD's adapter, with an SDK of our own behind an interface of our own: a simulated omega that
// saturates, repeats samples when it is asked too often, and knows its inertia.
#include "support/catch.hpp"
#include <passive_haptics/adapters/force_dimension.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/six_dof.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace ad = ph::adapters;
using Catch::Matchers::WithinRel;

namespace {

using scene = ph::space<double, 3>;
using vec = Eigen::Vector3d;
constexpr double T = 2.5e-4, mass = 0.22, damping = 0.3, most = 12.0;

/// The SDK, new for each test.
struct sdk {
  using hand_type = sim::impedance_hand<scene>;
  sim::device<scene, hand_type> device = made();
  bool open = false, expert = false, gone = false, knows_inertia = true, wrist = false;
  bool mirrored = false, forces = false, refuses = false;
  double turned = 0.0;  ///< about z [rad]
  int repeats = 0;      ///< samples that the time guard is going to repeat
  int asked = 0;
  vec applied = vec::Zero(), torque = vec::Zero();
  double gripper = 0.0, now = 0.0;

  static sim::device<scene, hand_type> made() {
    sim::device_parameters<scene> p;
    p.mass = mass;
    p.damping = damping;
    p.start = vec(0.0, 0.0, 0.01);
    p.period = T;
    return sim::device<scene, hand_type>{
        p, {.stiffness = 300.0, .damping = 1.0, .target = vec(0.0, 0.0, -0.01)}};
  }
};
std::optional<sdk> dhd;

}  // namespace

extern "C" {
int dhdErrorGetLast() {
  return 5;
}
int dhdOpen() {
  if (dhd->gone || dhd->open) return -1;
  dhd->open = true;
  return 0;
}
int dhdOpenID(char id) {
  return id == 0 ? dhdOpen() : -1;
}
int dhdClose(char) {
  dhd->open = false;
  return 0;
}
int dhdEnableForce(uchar on, char) {
  dhd->forces = on == DHD_ON;
  return 0;
}
int dhdGetStatus(int status[DHD_MAX_STATUS], char) {
  status[DHD_STATUS_FORCE] = dhd->forces ? 1 : 0;
  return dhd->gone ? -1 : 0;
}
const char* dhdGetSystemName(char) {
  return "a simulated omega";
}
bool dhdHasActiveWrist(char) {
  return dhd->wrist;
}
int dhdGetPosition(double* x, double* y, double* z, char) {
  ++dhd->asked;
  if (dhd->gone) return -1;
  const vec at = dhd->device.position();
  *x = at(0), *y = at(1), *z = at(2);
  if (dhd->repeats == 0) return 0;
  --dhd->repeats;
  *z -= 1.0;  // as old as can be
  return DHD_TIMEGUARD;
}
int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double rows[3][3], char id) {
  const Eigen::Matrix3d r =
      Eigen::AngleAxisd(dhd->turned, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rows[i][j] = r(i, j);
  }
  if (dhd->mirrored) rows[1][1] = -1.0;
  return dhdGetPosition(x, y, z, id);
}
double dhdGetComFreq(char) {
  return 4.0;
}
int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty,
                                        double tz, double g, char) {
  if (dhd->gone || dhd->refuses || !dhd->open) return -1;
  const vec wanted(fx, fy, fz);
  dhd->torque = vec(tx, ty, tz);
  dhd->gripper = g;
  const bool saturates = wanted.norm() > most;
  dhd->applied = saturates ? vec(wanted * (most / wanted.norm())) : wanted;
  static_cast<void>(dhd->device.exchange(dhd->forces ? dhd->applied : vec(vec::Zero())));
  dhd->now += T;
  return saturates ? DHD_MOTOR_SATURATED : 0;
}
int dhdGetForceAndTorqueAndGripperForce(double* fx, double* fy, double* fz, double* tx, double* ty,
                                        double* tz, double* g, char) {
  *fx = dhd->applied(0), *fy = dhd->applied(1), *fz = dhd->applied(2);
  *tx = dhd->torque(0), *ty = dhd->torque(1), *tz = dhd->torque(2);
  *g = dhd->gripper;
  return 0;
}
int dhdEnableExpertMode() {
  dhd->expert = true;
  return 0;
}
int dhdDisableExpertMode() {
  dhd->expert = false;
  return 0;
}
int dhdGetJointAngles(double*, char) {
  return dhd->expert ? 0 : -1;
}
int dhdJointAnglesToInertiaMatrix(double*, double inertia[6][6], char) {
  if (!dhd->expert || !dhd->knows_inertia) return -1;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) inertia[i][j] = 0.0;
  }
  inertia[0][0] = 0.3, inertia[1][1] = mass, inertia[2][2] = 0.25;
  return 0;
}
double dhdGetMaxForce(char) {
  return most;
}
double dhdGetTime() {
  return dhd->now;
}
}

namespace {

/// Opens a device of a new SDK.
template <class P>
void open(ad::force_dimension<P>& omega, bool wrist = false) {
  dhd.emplace();
  dhd->wrist = wrist;
  REQUIRE_FALSE(omega.open());
}

/// A touch for an open device, on a floor of 8 kN/m.
auto on_the_floor(const ad::force_dimension<scene>& omega, double force_limit = most) {
  auto touch = ph::make_touch<scene>({.mass = omega.least_mass(),
                                      .damping = damping,
                                      .force_limit = force_limit,
                                      .longest_tick = 1.01 * T},
                                     {.force = 5.0});
  touch.update({.point = {0.0, 0.0, 0.0}, .normal = {0.0, 0.0, 1.0}, .stiffness = 8000.0});
  return touch;
}

/// 6000 ticks of it: the least energy at the port [J].
double press(bool guarded, double force_limit = most) {
  ad::force_dimension<scene> omega;
  open(omega);
  auto touch = on_the_floor(omega, force_limit);
  auto sample = omega.exchange(scene::zero());
  for (int k = 0; k < 6000; ++k) {
    const vec x = sample.position;
    const vec spring(0.0, 0.0, x.z() < 0.0 ? -8000.0 * x.z() : 0.0);
    sample = omega.exchange(guarded ? vec(touch.tick(sample).force) : spring);
    REQUIRE(sample.valid);
  }
  if (guarded) CHECK(dhd->device.velocity().norm() < 1e-3);
  return dhd->device.meter().minimum();
}

}  // namespace

TEST_CASE("a wall on DHD loses nothing, a plain spring does", "[adapters][force_dimension]") {
  static_assert(ph::haptic_device_for<ad::force_dimension<scene>, scene>);
  CHECK(press(true) >= -1e-12);
  CHECK(press(false) < -1e-3);
}

TEST_CASE("what saturated motors held is what the ledger is told", "[adapters][force_dimension]") {
  ad::force_dimension<scene> omega;
  open(omega);
  auto sample = omega.exchange(vec(0.0, 0.0, 5.0));
  CHECK(dhd->forces);
  CHECK(vec(sample.held) == vec(0.0, 0.0, 5.0));
  CHECK(omega.saturated() == 0);
  sample = omega.exchange(vec(0.0, 0.0, 20.0));
  CHECK(vec(sample.held).isApprox(vec(0.0, 0.0, 12.0)));
  CHECK(omega.saturated() == 1);
  CHECK_THAT(sample.dt, WithinRel(T, 1e-9));
  CHECK(sample.valid);
}

TEST_CASE("a port that is told of the force button credits no hand that sinks in",
          "[adapters][force_dimension]") {
  const auto least_energy = [](bool told) {
    ad::force_dimension<scene> omega;
    open(omega);
    auto touch = on_the_floor(omega);
    auto sample = omega.exchange(scene::zero());
    for (int k = 0; k < 6000; ++k) {
      dhd->forces = k > 400;
      if (told) touch.enable_forces(omega.forces_on());
      sample = omega.exchange(touch.tick(sample).force);
    }
    return dhd->device.meter().minimum();
  };
  CHECK(least_energy(true) >= -1e-12);
  CHECK(least_energy(false) < -1e-3);
  ad::force_dimension<scene> omega;
  open(omega);
  CHECK(omega.forces_on());
  dhd->gone = true;
  CHECK_FALSE(omega.forces_on());
}

TEST_CASE("a sample that the time guard repeats is asked for again",
          "[adapters][force_dimension]") {
  ad::force_dimension<scene> omega;
  open(omega);
  dhd->repeats = 7;
  dhd->asked = 0;
  auto sample = omega.exchange(scene::zero());
  CHECK(sample.valid);
  CHECK(dhd->asked == 8);
  CHECK_THAT(vec(sample.position).z(), WithinRel(0.01, 0.01));
  dhd->repeats = std::numeric_limits<int>::max();  // for ever
  sample = omega.exchange(scene::zero());
  CHECK_FALSE(sample.valid);
}

TEST_CASE("the least mass is that of the lightest direction, a free wrist makes it lighter",
          "[adapters][force_dimension]") {
  ad::force_dimension<scene> omega;
  open(omega);
  CHECK_THAT(omega.least_mass(), WithinRel(mass, 1e-9));
  CHECK_FALSE(dhd->expert);
  const auto facts = omega.facts();
  CHECK_THAT(facts.mass.value, WithinRel(mass, 1e-9));
  CHECK(facts.peak_force.value == most);
  CHECK(facts.rate.value == 4000.0);
  CHECK(std::string(facts.name) == "a simulated omega");
  CHECK_FALSE(facts.damping);
  dhd->knows_inertia = false;
  CHECK(omega.least_mass() == 0.0);
  CHECK_FALSE(omega.facts().mass);

  // A rod of 0.3 kg and 0.1 m held at its end: pushed across, it turns about its centre and weighs a quarter.
  Eigen::Matrix<double, 6, 6> rod = Eigen::Matrix<double, 6, 6>::Zero();
  const double m = 0.3, l = 0.1;
  rod.diagonal() << m, m, m, 1e-6, m * l * l / 3.0, m * l * l / 3.0;
  rod(1, 5) = rod(5, 1) = m * l / 2.0;
  rod(2, 4) = rod(4, 2) = -m * l / 2.0;
  CHECK_THAT(ad::least_apparent_mass(rod), WithinRel(m / 4.0, 1e-9));
  rod(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(ad::least_apparent_mass(rod) == 0.0);
}

TEST_CASE("a device that is not there, open elsewhere, or gone, pushes nothing and says so",
          "[adapters][force_dimension]") {
  dhd.emplace();
  dhd->gone = true;
  ad::force_dimension<scene> omega;
  const auto fault = omega.open();
  REQUIRE(fault);
  CHECK(std::string(fault.parameter) == "device");
  CHECK(fault.value == 5.0);
  CHECK_FALSE(omega.is_open());
  CHECK_FALSE(omega.exchange(vec(0.0, 0.0, 1.0)).valid);
  CHECK(omega.least_mass() == 0.0);

  open(omega);
  ad::force_dimension<scene> second;
  CHECK(second.open());
  dhd->gone = true;
  auto sample = omega.exchange(vec(0.0, 0.0, 1.0));
  CHECK_FALSE(sample.valid);
  CHECK(omega.failed() == 1);
  dhd->gone = false;
  dhd->refuses = true;  // the force alone, so nobody knows what is held
  CHECK_FALSE(omega.exchange(vec(0.0, 0.0, 1.0)).valid);
  CHECK(omega.failed() == 2);
  dhd->refuses = false;
  sample = omega.exchange(vec(0.0, std::numeric_limits<double>::quiet_NaN(), 1.0));
  CHECK(sample.valid);
  CHECK(dhd->applied.isZero());
  static_cast<void>(omega.exchange(vec(0.0, 0.0, 1.0)));
  CHECK(dhd->applied.z() == 1.0);
  omega.close();
  CHECK(dhd->applied.isZero());
  CHECK_FALSE(dhd->open);

  dhd->now += 60.0;  // another time, with nothing counted yet
  REQUIRE_FALSE(omega.open());
  CHECK(omega.failed() == 0);
  CHECK_THAT(omega.exchange(scene::zero()).dt, WithinRel(T, 1e-6));
}

TEST_CASE("a wrench goes to a wrist that has motors, and a mirrored frame is no sample",
          "[adapters][force_dimension]") {
  dhd.emplace();
  ad::force_dimension<ph::rigid_body<double>> sigma;
  CHECK(std::string(sigma.open().parameter) == "wrist");
  CHECK_FALSE(dhd->open);
  open(sigma, true);
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << 1.0, 2.0, 3.0, 0.1, 0.2, 0.3;
  auto sample = sigma.exchange(wrench);
  REQUIRE(sample.valid);
  CHECK(dhd->applied == vec(1.0, 2.0, 3.0));
  CHECK(dhd->torque == vec(0.1, 0.2, 0.3));
  CHECK(dhd->gripper == 0.0);
  CHECK_THAT(sample.position.orientation.w, WithinRel(1.0, 1e-9));
  dhd->turned = 0.3;
  sample = sigma.exchange(wrench);
  REQUIRE(sample.valid);
  CHECK_THAT(sample.position.orientation.z, WithinRel(std::sin(0.15), 1e-9));
  dhd->mirrored = true;
  CHECK_FALSE(sigma.exchange(wrench).valid);

  ad::force_dimension<ph::stylus<float>> omega_6;
  sigma.close();
  open(omega_6);
  CHECK(omega_6.exchange(Eigen::Vector3f(0.0F, 0.0F, 1.0F)).valid);
  CHECK(dhd->torque.isZero());
}
