// SPDX-License-Identifier: BSD-3-Clause
// OpenHaptics' adapter, with a driver of our own behind an interface of our own: two simulated
// devices, a scheduler that the tests run, and a frame without which nothing is read or sent.
#include "support/catch.hpp"
#include <passive_haptics/adapters/open_haptics.hpp>
#include <passive_haptics/base/exchange.hpp>
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/device/stylus.hpp>
#include <passive_haptics/simulation/device.hpp>

#include <cmath>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace ph = passive_haptics;
namespace sim = ph::simulation;
namespace ad = ph::adapters;

namespace {

using scene = ph::space<double, 3>;
using vec = Eigen::Vector3d;
constexpr double T = 1e-3, mass = 0.045, damping = 0.05;

struct touch_device {
  using hand_type = sim::impedance_hand<scene>;
  sim::device<scene, hand_type> device = made();
  bool open = false, in_frame = false;
  vec command = vec::Zero();
  double handedness = 1.0;
  double turned = 0.0;  ///< about z [rad]

  static sim::device<scene, hand_type> made() {
    sim::device_parameters<scene> p;
    p.mass = mass;
    p.damping = damping;
    p.start = vec(0.0, 0.01, 0.0);
    p.latency = 1;
    return sim::device<scene, hand_type>{
        p, {.stiffness = 200.0, .damping = 0.5, .target = vec(0.0, -0.005, 0.0)}};
  }
};
struct scheduled {
  HDSchedulerCallback call;
  void* user;
};

/// The driver, new for each test.
struct driver {
  std::map<HHD, touch_device> devices;
  std::map<std::string, HHD> names{{"", 1}, {"right", 2}};
  std::map<HDSchedulerHandle, scheduled> callbacks;
  HHD current = HD_INVALID_HANDLE;
  std::deque<HDerror> errors;  ///< raised and not yet asked for
  HDerror fails_at_frame_end = HD_SUCCESS;
  std::vector<HDenum> enabled;
  HDint rate = 1000;
  bool scheduler_full = false, output = true;
  int used_out_of_frame = 0;

  /// Time passes: each callback once, then each device for a tick.
  void run(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      for (auto it = callbacks.begin(); it != callbacks.end();) {
        it = it->second.call(it->second.user) == HD_CALLBACK_DONE ? callbacks.erase(it)
                                                                  : std::next(it);
      }
      for (auto& [handle, d] : devices) {
        if (d.open) static_cast<void>(d.device.exchange(output ? d.command : vec(vec::Zero())));
      }
    }
  }
  touch_device& now() { return devices[current]; }
};
driver* hd = nullptr;

/// Makes a driver, and takes it away again.
struct with_driver {
  driver own{};
  with_driver() { hd = &own; }
  with_driver(const with_driver&) = delete;
  with_driver& operator=(const with_driver&) = delete;
  ~with_driver() { hd = nullptr; }
};

}  // namespace

extern "C" {
HHD hdInitDevice(HDstring name) {
  const auto found = hd->names.find(name == nullptr ? "" : name);
  if (found == hd->names.end()) {
    hd->errors.push_back(HD_BAD_HANDLE);
    return HD_INVALID_HANDLE;
  }
  if (hd->devices[found->second].open) {
    hd->errors.push_back(HD_DEVICE_ALREADY_INITIATED);
    return HD_INVALID_HANDLE;
  }
  hd->devices[found->second].open = true;
  return hd->current = found->second;
}
void hdMakeCurrentDevice(HHD device) {
  hd->current = device;
}
void hdDisableDevice(HHD device) {
  hd->devices[device].open = false;
  hd->devices[device].command.setZero();
}
void hdBeginFrame(HHD device) {
  hd->devices[device].in_frame = true;
}
void hdEndFrame(HHD device) {
  hd->devices[device].in_frame = false;
  if (hd->fails_at_frame_end == HD_SUCCESS) return;
  hd->errors.push_back(hd->fails_at_frame_end);
  hd->devices[device].command.setZero();
}
HDErrorInfo hdGetError() {
  if (hd->errors.empty()) return {HD_SUCCESS, 0, hd->current};
  const HDerror error = hd->errors.front();
  hd->errors.pop_front();
  return {error, 0, hd->current};
}
void hdEnable(HDenum what) {
  hd->enabled.push_back(what);
}
HDboolean hdIsEnabled(HDenum what) {
  return what == HD_FORCE_OUTPUT && hd->output ? 1 : 0;
}
HDstring hdGetString(HDenum) {
  return "a simulated Touch";
}
void hdGetIntegerv(HDenum, HDint* values) {
  *values = hd->rate;
}
void hdGetDoublev(HDenum what, HDdouble* values) {
  touch_device& d = hd->now();
  const vec mm = 1e3 * d.device.position();
  if (what == HD_CURRENT_POSITION || what == HD_CURRENT_TRANSFORM) {
    hd->used_out_of_frame += d.in_frame ? 0 : 1;
  }
  if (what == HD_CURRENT_POSITION) {
    for (int i = 0; i < 3; ++i) values[i] = mm(i);
  } else if (what == HD_CURRENT_TRANSFORM) {
    for (int i = 0; i < 16; ++i) values[i] = 0.0;
    values[0] = values[5] = std::cos(d.turned);
    values[1] = std::sin(d.turned);  // of the first column
    values[4] = -values[1];
    values[10] = d.handedness;
    for (int i = 0; i < 3; ++i) values[12 + i] = mm(i);
    values[15] = 1.0;
  } else if (what == HD_NOMINAL_MAX_FORCE) {
    *values = 3.3;
  } else if (what == HD_NOMINAL_MAX_CONTINUOUS_FORCE) {
    *values = 0.88;
  } else if (what == HD_NOMINAL_MAX_STIFFNESS) {
    *values = 0.5;  // N/mm
  }
}
void hdSetDoublev(HDenum what, const HDdouble* values) {
  hd->used_out_of_frame += hd->now().in_frame ? 0 : 1;
  if (what == HD_CURRENT_FORCE) hd->now().command = Eigen::Map<const vec>(values);
}
HDSchedulerHandle hdScheduleAsynchronous(HDSchedulerCallback call, void* user, HDushort) {
  if (hd->scheduler_full) {
    hd->errors.push_back(HD_SCHEDULER_FULL);
    return 0;
  }
  const HDSchedulerHandle handle = hd->callbacks.empty() ? 1 : hd->callbacks.rbegin()->first + 1;
  hd->callbacks[handle] = {call, user};
  return handle;
}
void hdUnschedule(HDSchedulerHandle callback) {
  hd->callbacks.erase(callback);
}
}

namespace {

using limits = ph::late_loop_limits<1>;
auto wall_port(double longest_tick = 1.01 * T) {
  return ph::local_model{scene{},
                         ph::followed<ph::half_space<scene>>{},
                         ph::turn_limited{.rate = 4.0},
                         ph::damped_spring{.mass = mass, .force_limit = 3.3},
                         ph::reduced_energy{.damping = damping},
                         ph::bound_chain{ph::reachable_bound{.mass = mass, .hand_force = 5.0},
                                         ph::actuator_limit{.most = 3.3}},
                         limits{.longest_tick = longest_tick}};
}
template <class P = scene>
auto guard_port() {
  return ph::passive_port{P{}, ph::given_force{}, ph::reduced_energy{.damping = damping},
                          ph::strict_bound{}, limits{.longest_tick = 1.01 * T}};
}
const auto stiff_floor = [](auto&, const vec& x) -> vec {
  return x.y() < 0.0 ? vec(0.0, -3000.0 * x.y(), 0.0) : vec(vec::Zero());
};

}  // namespace

TEST_CASE("a wall that is published stands in the servo thread, in millimetres and newtons",
          "[adapters][open_haptics]") {
  with_driver driver;
  ph::exchange<ph::half_space<scene>> inbox;
  ad::open_haptics touch{wall_port(), [&inbox](auto& wall, const vec&) {
                           if (const auto* p = inbox.take()) wall.update(*p);
                         }};
  REQUIRE_FALSE(touch.open());
  REQUIRE_FALSE(touch.start());
  inbox.publish({.point = {0.0, 0.0, 0.0}, .normal = {0.0, 1.0, 0.0}, .stiffness = 500.0});
  hd->run(4000);
  const auto& d = hd->devices[1];
  const double depth = -d.device.position().y();
  CHECK(depth > 1e-3);                                              // a hand of 200 N/m presses
  CHECK(std::abs(d.command.y() - 200.0 * (0.005 - depth)) < 0.02);  // and is held
  CHECK(d.device.meter().minimum() >= -1e-12);
  CHECK(touch.last().what == ph::event::nominal);
  CHECK(touch.stopped_by() == HD_SUCCESS);
  CHECK(hd->used_out_of_frame == 0);

  const auto facts = touch.facts();
  CHECK(facts.peak_force.value == 3.3);
  CHECK(facts.continuous_force.value == 0.88);
  CHECK(facts.stiffness.value == 500.0);  // N/mm → N/m
  CHECK(facts.rate.value == 1000.0);
  CHECK(std::string(facts.name) == "a simulated Touch");
  CHECK_FALSE(facts.damping);
  touch.close();
  CHECK(hd->callbacks.empty());
  CHECK_FALSE(hd->devices[1].open);
  CHECK_FALSE(touch.facts().peak_force);
}

TEST_CASE("a renderer's own force loses joules, and through the port in the servo thread none",
          "[adapters][open_haptics]") {
  for (const bool guarded : {false, true}) {
    with_driver driver;
    ad::open_haptics touch{guard_port(), stiff_floor};
    REQUIRE_FALSE(touch.open());
    if (guarded) REQUIRE_FALSE(touch.start());
    for (int k = 0; k < 4000; ++k) {
      hd->run(1);
      auto& d = hd->devices[1];
      if (!guarded) d.command = stiff_floor(d, d.device.position());
    }
    const double least = hd->devices[1].device.meter().minimum();
    INFO(guarded);
    if (guarded) CHECK(least >= -1e-12);
    if (!guarded) CHECK(least < -1e-3);
  }
}

TEST_CASE("a hand that sinks in while HD_FORCE_OUTPUT is off is credited with nothing",
          "[adapters][open_haptics]") {
  with_driver driver;
  ad::open_haptics touch{guard_port(), stiff_floor};
  REQUIRE_FALSE(touch.open());
  REQUIRE_FALSE(touch.start());
  auto& d = hd->devices[1];
  const auto press = [&d](double y, int ticks) {
    d.device.hand().target = vec(0.0, y, 0.0);
    hd->run(ticks);
  };
  press(-0.005, 500);
  for (int n = 0; n < 10; ++n) {
    hd->output = false;
    press(-0.03, 200);
    CHECK(touch.last().what == ph::event::forces_off);
    CHECK(d.command.norm() == 0.0);
    hd->output = true;
    press(0.01, 200);
    CHECK(touch.last().what == ph::event::nominal);
  }
  CHECK(d.device.meter().minimum() >= -1e-12);
}

TEST_CASE("a program that stops while the driver's loop goes on pushes no longer",
          "[adapters][open_haptics]") {
  with_driver driver;
  ph::exchange<scene::stored_effort> wanted;
  ad::open_haptics touch{guard_port(), [&wanted](auto& port, const vec&) {
                           if (const auto* f = wanted.take()) port.source().update(*f);
                         }};
  REQUIRE_FALSE(touch.open());
  REQUIRE_FALSE(touch.start());
  for (int k = 0; k < 300; ++k) {
    wanted.publish(vec(0.0, 0.1, 0.0));
    hd->run(1);
  }
  CHECK(hd->devices[1].command.y() > 0.05);  // the control: somebody is there
  hd->run(90);
  CHECK(hd->devices[1].command.y() > 0.05);
  hd->run(70);
  CHECK(hd->devices[1].command.isZero());
  CHECK(touch.last().what == ph::event::stale_target);
}

TEST_CASE("two devices have a port each, and one device only one", "[adapters][open_haptics]") {
  with_driver driver;
  ad::open_haptics left{guard_port(), stiff_floor}, right{guard_port(), stiff_floor};
  ad::open_haptics second{guard_port(), stiff_floor};
  REQUIRE_FALSE(left.open());
  REQUIRE_FALSE(right.open("right"));
  const auto refused = second.open("right");
  REQUIRE(refused);
  CHECK(refused.value == double(HD_DEVICE_ALREADY_INITIATED));
  CHECK(second.open("nobody").value == double(HD_BAD_HANDLE));
  CHECK(second.start());  // not open
  REQUIRE_FALSE(left.start());
  REQUIRE_FALSE(right.start());
  hd->devices[2].device.hand().target = vec(0.0, 0.01, 0.0);  // stays outside
  hd->run(1000);
  CHECK(hd->devices[1].command.y() > 0.1);
  CHECK(hd->devices[2].command.isZero());
  CHECK(hd->used_out_of_frame == 0);
  left.stop();
  CHECK(hd->callbacks.size() == 1);
}

TEST_CASE("an error of the driver pushes nothing, and one that is final ends the callback",
          "[adapters][open_haptics]") {
  with_driver driver;
  ad::open_haptics touch{guard_port(), stiff_floor};
  REQUIRE_FALSE(touch.open());
  REQUIRE_FALSE(touch.start());
  hd->run(500);
  REQUIRE(hd->devices[1].command.y() > 0.05);
  hd->fails_at_frame_end = HD_EXCEEDED_MAX_FORCE;
  hd->run(3);
  CHECK(touch.errors() == 3);
  CHECK(touch.last().what == ph::event::rejected_sample);
  CHECK(hd->devices[1].command.isZero());
  hd->fails_at_frame_end = HD_SUCCESS;
  hd->run(500);
  CHECK(hd->devices[1].command.y() > 0.05);  // it goes on
  CHECK(touch.errors() == 3);
  hd->errors.push_back(HD_COMM_ERROR);
  hd->run(1);
  CHECK(touch.stopped_by() == HD_COMM_ERROR);
  CHECK(hd->callbacks.empty());
  CHECK(hd->devices[1].command.isZero());
  CHECK(hd->devices[1].device.meter().minimum() >= -1e-12);
  for (const HDerror gone :
       {HDerror{HD_BAD_HANDLE}, HDerror{HD_DEVICE_FAULT}, HDerror{HD_COMM_CONFIG_ERROR}}) {
    REQUIRE_FALSE(touch.start());  // and begins again
    CHECK(touch.stopped_by() == HD_SUCCESS);
    hd->errors.push_back(gone);
    hd->run(1);
    INFO(gone);
    CHECK(touch.stopped_by() == gone);
  }
  REQUIRE_FALSE(touch.start());
  CHECK(touch.stopped_by() == HD_SUCCESS);

  hd->scheduler_full = true;
  CHECK(touch.start().value == double(HD_SCHEDULER_FULL));
  ad::open_haptics bad{wall_port(-1.0), [](auto&, const vec&) {}};
  CHECK(std::string(bad.open("right").parameter) == "longest_tick");
  CHECK_FALSE(hd->devices[2].open);
}

TEST_CASE("the driver's rate is the tick, and a rate that is none is a millisecond",
          "[adapters][open_haptics]") {
  with_driver driver;
  ad::open_haptics touch{guard_port(), stiff_floor};
  REQUIRE_FALSE(touch.open());
  CHECK(hd->enabled == std::vector<HDenum>{HD_FORCE_OUTPUT, HD_MAX_FORCE_CLAMPING});
  REQUIRE_FALSE(touch.start());
  hd->run(200);
  CHECK(touch.last().what == ph::event::nominal);
  CHECK(touch.last().energy > 0.0);
  REQUIRE_FALSE(touch.start());  // again, with an empty ledger
  hd->run(1);
  CHECK(touch.last().energy == 0.0);
  hd->rate = 500;
  hd->run(1);
  CHECK(touch.last().what == ph::event::late_tick);
  hd->rate = 0;
  hd->run(1);
  CHECK(touch.last().what == ph::event::nominal);
}

TEST_CASE("a stylus has its orientation from the driver, a mirrored one pushes nothing",
          "[adapters][open_haptics]") {
  with_driver driver;
  double tip = 0.0, turned = 0.0;
  ad::open_haptics touch{guard_port<ph::stylus<double>>(), [&](auto&, const auto& pose) -> vec {
                           tip = vec(pose.position).y();
                           turned = 2.0 * std::asin(pose.orientation.z);
                           return stiff_floor(pose, pose.position);
                         }};
  REQUIRE_FALSE(touch.open());
  REQUIRE_FALSE(touch.start());
  hd->run(500);
  CHECK(touch.last().what == ph::event::nominal);
  CHECK(tip < 0.0);
  CHECK(tip > -0.01);  // metres
  CHECK(hd->devices[1].command.y() > 0.05);
  hd->devices[1].turned = 0.3;
  hd->run(1);
  CHECK(std::abs(turned - 0.3) < 1e-9);
  hd->devices[1].handedness = -1.0;
  hd->run(1);
  CHECK(touch.last().what == ph::event::rejected_sample);
  CHECK(hd->devices[1].command.isZero());
}
