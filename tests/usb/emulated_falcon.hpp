// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A far side on an emulated USB bus: umockdev answers libusb's system calls, so that the real
// libusb, and our code above it, run as with a device. No USB timing, no kernel driver.
#include "support/scripted_falcon.hpp"

#include <cerrno>
#include <cstring>
#include <glib.h>
#include <linux/usbdevice_fs.h>
#include <list>
#include <mutex>
#include <stdexcept>
#include <sys/ioctl.h>
#include <umockdev.h>

class emulated_falcon {
 public:
  emulated_falcon() : bed_(umockdev_testbed_new()), handler_(umockdev_ioctl_base_new()) {
    g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(&emulated_falcon::answer), this);
    GError* error = nullptr;
    umockdev_testbed_attach_ioctl(bed_, node, handler_, &error);  // before the device is there
    if (error == nullptr) umockdev_testbed_add_from_string(bed_, description, &error);
    if (error != nullptr) throw std::runtime_error(error->message);
  }
  emulated_falcon(const emulated_falcon&) = delete;
  emulated_falcon& operator=(const emulated_falcon&) = delete;
  ~emulated_falcon() {
    GError* ignored = nullptr;
    umockdev_testbed_detach_ioctl(bed_, node, &ignored);
    g_object_unref(handler_);
    g_object_unref(bed_);
    for (auto* all : {&flying_, &done_}) {
      for (urb& u : *all) u.release();
    }
  }

  /// Calls f with the far side, while nobody else looks at it.
  template <class F>
  auto with(F f) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return f(far_);
  }

 private:
  static constexpr const char* node = "/dev/bus/usb/001/002";
  // 18 bytes of device, 32 of configuration descriptor: vendor-specific class, two bulk pipes
  static constexpr const char* description =
      "P: /devices/pci0000:00/usb1/1-1\nN: bus/usb/001/002\n"
      "E: SUBSYSTEM=usb\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=002\n"
      "E: DEVNAME=/dev/bus/usb/001/002\nE: DEVTYPE=usb_device\n"
      "E: ID_VENDOR_ID=0403\nE: ID_MODEL_ID=cb48\n"
      "A: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=2\\n\nA: speed=12\\n\n"
      "A: idVendor=0403\\n\nA: idProduct=cb48\\n\n"
      "H: descriptors=1201000200000008030448cb000601020301"
      "09022000010100a02d0904000002ffffff020705810240000007050202400000\n";

  struct urb {
    UMockdevIoctlData* self = nullptr;
    UMockdevIoctlData* data = nullptr;

    [[nodiscard]] usbdevfs_urb& head() const {
      return *reinterpret_cast<usbdevfs_urb*>(self->data);
    }
    [[nodiscard]] std::span<falcon::byte> bytes() const {
      return {data->data, static_cast<std::size_t>(head().buffer_length)};
    }
    void release() {
      if (data != nullptr) umockdev_ioctl_data_unref(data);
      umockdev_ioctl_data_unref(self);
    }
  };

  static gboolean answer(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client,
                         emulated_falcon* self) {
    const std::lock_guard<std::mutex> lock(self->mutex_);
    return self->handle(client);
  }

  static gboolean reply(UMockdevIoctlClient* client, long value, int error = 0) {
    umockdev_ioctl_client_complete(client, value, error);
    return TRUE;
  }

  gboolean handle(UMockdevIoctlClient* client) {
    let_time_pass();
    auto* argument = umockdev_ioctl_client_get_arg(client);
    const auto request = umockdev_ioctl_client_get_request(client);
    switch (request) {
      case USBDEVFS_REAPURB:
      case USBDEVFS_REAPURBNDELAY:
        return reap(client, argument);
      case USBDEVFS_DISCARDURB:
        return discard(client, argument);
      default:
        break;
    }
    if (!far_.plugged) return reply(client, -1, ENODEV);
    switch (request) {
      case USBDEVFS_GET_CAPABILITIES: {
        auto* data = umockdev_ioctl_data_resolve(argument, 0, sizeof(guint32), nullptr);
        const guint32 can = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                            USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
        std::memcpy(data->data, &can, sizeof can);
        umockdev_ioctl_data_unref(data);
        return reply(client, 0);
      }
      case USBDEVFS_CLAIMINTERFACE:
      case USBDEVFS_RELEASEINTERFACE:
      case USBDEVFS_CLEAR_HALT:
      case USBDEVFS_SETCONFIGURATION:
        return reply(client, 0);
      case USBDEVFS_SUBMITURB:
        return submit(client, argument);
      default:
        return reply(client, -1, ENODATA);
    }
  }

  void let_time_pass() {
    const auto now = std::chrono::steady_clock::now();
    far_.elapse(now - last_);
    last_ = now;
  }

  gboolean submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
    urb u{umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr)};
    if (u.head().buffer_length > 0) {
      u.data = umockdev_ioctl_data_resolve(u.self, G_STRUCT_OFFSET(usbdevfs_urb, buffer),
                                           static_cast<gsize>(u.head().buffer_length), nullptr);
    }
    if (u.head().type == USBDEVFS_URB_TYPE_CONTROL) {
      control(u);
    } else if (u.head().endpoint == falcon::ftdi::bulk_out) {
      far_.receive(u.bytes());
      finish(u, 0, u.head().buffer_length);
    } else {
      flying_.push_back(u);
    }
    return reply(client, 0);
  }

  void control(const urb& u) {
    const auto bytes = u.bytes();
    const auto value = static_cast<std::uint16_t>(bytes[2] | bytes[3] << 8);
    constexpr falcon::byte vendor_out = 0x40, standard_in = 0x80, get_descriptor = 6;
    constexpr int string_type = 3;
    if (bytes[0] == vendor_out) {
      far_.control(static_cast<falcon::request>(bytes[1]), value);
      finish(u, 0, 0);
    } else if (bytes[0] == standard_in && bytes[1] == get_descriptor && value >> 8 == string_type) {
      const std::string text = string_descriptor(value & 255);
      const std::size_t n = std::min(text.size(), bytes.size() - 8);
      std::copy_n(text.begin(), n, bytes.begin() + 8);
      finish(u, 0, static_cast<int>(n));
    } else {
      finish(u, -EPIPE, 0);
    }
  }

  static std::string string_descriptor(int index) {
    if (index == 0) return {4, 3, 9, 4};
    std::string text{0, 3};
    for (const char c : std::string(index == 1   ? "NOVINT"
                                    : index == 2 ? "FALCON HAPTIC"
                                                 : "EMU001")) {
      text += {c, '\0'};
    }
    text[0] = static_cast<char>(text.size());
    return text;
  }

  void finish(const urb& u, int status, int length) {
    u.head().status = status;
    u.head().actual_length = length;
    done_.push_back(u);
  }

  gboolean reap(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
    while (!flying_.empty()) {
      const urb u = flying_.front();
      const std::size_t n = far_.plugged ? far_.transmit(u.bytes()) : 0;
      if (far_.plugged && n == 0) break;
      flying_.pop_front();
      finish(u, far_.plugged ? 0 : -ESHUTDOWN, static_cast<int>(n));
    }
    if (done_.empty()) return reply(client, -1, far_.plugged ? EAGAIN : ENODEV);
    urb u = done_.front();
    done_.pop_front();
    auto* pointer = umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr);
    umockdev_ioctl_data_set_ptr(pointer, 0, u.self);
    (void)reply(client, 0);
    umockdev_ioctl_data_unref(pointer);
    u.release();
    return TRUE;
  }

  gboolean discard(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
    gulong address = 0;
    std::memcpy(&address, argument->data, sizeof address);
    for (auto at = flying_.begin(); at != flying_.end(); ++at) {
      if (at->self->client_addr != address) continue;
      finish(*at, -ENOENT, 0);
      flying_.erase(at);
      return reply(client, 0);
    }
    return reply(client, -1, EINVAL);
  }

  UMockdevTestbed* bed_;
  UMockdevIoctlBase* handler_;
  std::mutex mutex_;
  scripted_falcon far_;
  std::list<urb> flying_, done_;  ///< waiting for data; finished
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};
