// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// OpenHaptics: a passive port in the driver's own servo thread. Needs its HD/hd.h in the include path.
//
//   scheduler, 1 kHz ─▶ hdBeginFrame ─▶ x [mm → m], dt ─▶ FEED ─▶ PORT ─▶ force ─▶ hdEndFrame
//
//     using plane = ph::half_space<scene>;
//     ph::exchange<plane> inbox;                                        // your thread publishes
//     ph::adapters::open_haptics touch{ph::make_touch<scene>({.mass = 0.045, .damping = 0.05, .force_limit = 3.3, .longest_tick = 0.002}, {.force = 5.0}),
//                                      [&](auto& wall, const auto&) {
//                                        if (const auto* p = inbox.take()) wall.update(*p);
//                                      }};
//     if (const auto fault = touch.open("Default Device")) return complain(fault);
//     if (const auto fault = touch.start()) return complain(fault);
//     hdStartScheduler();                                               // yours: once, for all devices
//
// For a force that is given already, by HLAPI or your own renderer, take make_guard, and a feed that returns that
// force:  [&](auto& port, const auto& x) { return renderer.force(x); }.
//
// Each device has its own object, whose frame makes it the current one. The length of a tick is the inverse of the
// driver's rate, because hdGetSchedulerTimeStamp() is the time WITHIN a tick. A force goes
// out at the end of its frame: measure the latency of your device (identification/measure_latency.hpp) before you state
// it.

#include <passive_haptics/adapters/poses.hpp>
#include <passive_haptics/port/passive_port.hpp>

#include <HD/hd.h>
#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace adapters {

/// `Port` is a passive_port or a local_model in space<S, 3>, or of a stylus; the torques of a gimbal are not
/// pushed. `Feed` is called in the servo thread before each tick, with the port and the position [m] or pose:
/// it updates the port and returns nothing, or returns the wanted force [N]. It must not throw, block or
/// allocate.
template <class Port, class Feed>
requires hand_port<typename Port::port_type> &&(Port::port_type::dof == 3) class open_haptics {
 public:
  using port_type = typename Port::port_type;
  using scalar = typename port_type::scalar;
  using result_type = typename Port::result_type;

  open_haptics(const Port& port, Feed feed) : port_(port), feed_(std::move(feed)) {}
  open_haptics(const open_haptics&) = delete;
  open_haptics& operator=(const open_haptics&) = delete;
  ~open_haptics() { close(); }

  /// Opens the device of that name, null for the default one, and lets it push. A name that somebody has
  /// opened already is refused by the driver, so no two ports of this kind share a device.
  [[nodiscard]] parameter_fault open(HDstring name = HD_DEFAULT_DEVICE) {
    close();
    if (const auto fault = port_.check()) return fault;
    device_ = hdInitDevice(name);
    if (const HDErrorInfo error = hdGetError(); HD_DEVICE_ERROR(error)) {
      device_ = HD_INVALID_HANDLE;
      return {"device", static_cast<double>(error.errorCode),
              "a device that is connected, configured and not yet open: hdGetErrorString() of the "
              "value says which"};
    }
    hdMakeCurrentDevice(device_);
    hdEnable(HD_FORCE_OUTPUT);
    hdEnable(HD_MAX_FORCE_CLAMPING);
    return {};
  }
  /// Schedules the servo callback. The scheduler itself is the program's: hdStartScheduler().
  [[nodiscard]] parameter_fault start() {
    if (device_ == HD_INVALID_HANDLE) return {"device", 0.0, "one that is open: call open() first"};
    stop();
    stopped_by_ = HD_SUCCESS;
    port_.reset();
    callback_ = hdScheduleAsynchronous(&open_haptics::on_tick, this, HD_DEFAULT_SCHEDULER_PRIORITY);
    scheduled_ = true;
    const HDErrorInfo error = hdGetError();
    if (!HD_DEVICE_ERROR(error)) return {};
    scheduled_ = false;
    return {"scheduler", static_cast<double>(error.errorCode),
            "one that takes another callback: hdGetErrorString() of the value says why not"};
  }
  void stop() {
    if (scheduled_) hdUnschedule(callback_);
    scheduled_ = false;
  }
  void close() {
    stop();
    if (device_ != HD_INVALID_HANDLE) hdDisableDevice(device_);
    device_ = HD_INVALID_HANDLE;
  }

  /// The driver's code of the error that ended the callback, HD_SUCCESS while it runs. Any thread may call it.
  [[nodiscard]] HDerror stopped_by() const noexcept { return stopped_by_; }
  /// The number of ticks in which the driver reported an error, such as too large a force, and no force was held. Any
  /// thread may call it.
  [[nodiscard]] unsigned long errors() const noexcept { return errors_; }

  /// The result of the last tick. Call it in the servo thread, or after stop().
  [[nodiscard]] const result_type& last() const noexcept { return last_; }
  /// The port, to set its parameters before start() or after stop(); in between use it in the feed only.
  [[nodiscard]] Port& port() noexcept { return port_; }

  /// The facts of an open device in the driver. Its damping is one for a controller, not that of the device, so it is
  /// left out.
  [[nodiscard]] design::device_facts facts() const {
    const auto ask = [](HDenum what, double unit) {
      HDdouble value = 0.0;
      hdGetDoublev(what, &value);
      return said_by("HDAPI", HD_DEVICE_ERROR(hdGetError()) ? 0.0 : value * unit);
    };
    if (device_ == HD_INVALID_HANDLE) return {};
    hdMakeCurrentDevice(device_);
    HDint rate = 0;
    hdGetIntegerv(HD_UPDATE_RATE, &rate);
    return {.name = hdGetString(HD_DEVICE_MODEL_TYPE),
            .peak_force = ask(HD_NOMINAL_MAX_FORCE, 1.0),
            .continuous_force = ask(HD_NOMINAL_MAX_CONTINUOUS_FORCE, 1.0),
            .stiffness = ask(HD_NOMINAL_MAX_STIFFNESS, 1e3),  // N/mm
            .rate = said_by("HDAPI", double(rate))};
  }

 private:
  static HDCallbackCode HDCALLBACK on_tick(void* self) {
    return static_cast<open_haptics*>(self)->tick();
  }

  HDCallbackCode tick() noexcept {
    hdBeginFrame(device_);
    hdMakeCurrentDevice(device_);
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Eigen::Matrix3d columns = Eigen::Matrix3d::Identity();
    read(place, columns);
    HDint rate = 0;
    hdGetIntegerv(HD_INSTANTANEOUS_UPDATE_RATE, &rate);
    const bool output = hdIsEnabled(HD_FORCE_OUTPUT) != 0;
    const HDErrorInfo failed = hdGetError();
    // A program may switch the forces off, and nothing that moves then is credited.
    if (output != std::exchange(output_, output)) port_.enable_forces(output);
    const auto dt = static_cast<scalar>(rate > 0 ? 1.0 / rate : 1e-3);
    const auto pose = pose_of<port_type>(place, columns);
    if (HD_DEVICE_ERROR(failed) || !pose) {
      last_ = port_.tick(device_sample<port_type>{.dt = dt, .valid = false});
    } else {
      last_ = ask(*pose, seconds{dt});
    }
    const Eigen::Vector3d force = last_.force.template cast<double>();
    hdSetDoublev(HD_CURRENT_FORCE, force.data());
    hdEndFrame(device_);
    const HDErrorInfo refused = hdGetError();
    if (HD_DEVICE_ERROR(failed)) return after_error(failed.errorCode);
    if (!HD_DEVICE_ERROR(refused)) return HD_CALLBACK_CONTINUE;
    // The command was not held, so the force during the next motion is unknown.
    last_ = port_.tick(device_sample<port_type>{.dt = dt, .valid = false});
    return after_error(refused.errorCode);
  }

  /// [mm] → [m]. The driver's matrix is stored by columns, the place in the last one.
  static void read(Eigen::Vector3d& place, Eigen::Matrix3d& columns) noexcept {
    constexpr double metres = 1e-3;
    if constexpr (turning_port<port_type>) {
      Eigen::Matrix4d all = Eigen::Matrix4d::Identity();
      hdGetDoublev(HD_CURRENT_TRANSFORM, all.data());
      columns = all.topLeftCorner<3, 3>();
      place = metres * all.topRightCorner<3, 1>();
    } else {
      hdGetDoublev(HD_CURRENT_POSITION, place.data());
      place *= metres;
    }
  }

  result_type ask(const typename port_type::pose& pose, seconds<scalar> dt) noexcept {
    if constexpr (std::is_void_v<decltype(feed_(port_, pose))>) {
      feed_(port_, pose);
      return port_.tick(pose, dt);
    } else {
      return port_.tick(pose, dt, feed_(port_, pose));
    }
  }

  /// A device that is gone ends the callback.
  HDCallbackCode after_error(HDerror code) noexcept {
    ++errors_;
    const bool gone = code == HD_BAD_HANDLE || code == HD_DEVICE_FAULT || code == HD_COMM_ERROR ||
                      code == HD_COMM_CONFIG_ERROR;
    if (!gone) return HD_CALLBACK_CONTINUE;
    stopped_by_ = code;
    return HD_CALLBACK_DONE;
  }

  Port port_;
  Feed feed_;
  HHD device_ = HD_INVALID_HANDLE;
  HDSchedulerHandle callback_{};
  bool scheduled_ = false;
  bool output_ = true;  ///< HD_FORCE_OUTPUT in the last tick
  result_type last_ = nothing_yet<result_type, port_type>();
  std::atomic<HDerror> stopped_by_{HD_SUCCESS};
  std::atomic<unsigned long> errors_{0};
};

}  // namespace adapters
}  // namespace v0
}  // namespace passive_haptics
