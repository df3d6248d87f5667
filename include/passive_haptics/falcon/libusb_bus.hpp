// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Falcons on the USB bus, by libusb-1.0: which there are, and what its error numbers mean here.

#include <passive_haptics/falcon/ftdi.hpp>
#include <passive_haptics/falcon/result.hpp>

#if __has_include(<libusb-1.0/libusb.h>)
#include <libusb-1.0/libusb.h>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// Which Falcon: the n-th on the bus, or the one with that serial number.
struct which {
  int index = 0;
  std::string_view serial = {};
};

/// A Falcon on the bus.
struct listed_device {
  int bus = 0, address = 0;
  std::array<char, 32> serial{};  ///< empty if it has none, or may not be opened
  result openable{};
};

namespace detail {

[[nodiscard]] inline result code_of(int libusb, code without_device) noexcept {
  if (libusb >= 0) return {};
  switch (libusb) {
    case LIBUSB_ERROR_ACCESS:
      return {code::no_permission, libusb};
    case LIBUSB_ERROR_BUSY:
      return {code::busy, libusb};
    case LIBUSB_ERROR_NO_DEVICE:
      return {without_device, libusb};
    case LIBUSB_ERROR_TIMEOUT:
      return {code::timeout, libusb};
    default:
      return {code::transfer_failed, libusb};
  }
}

inline std::string_view serial_of(libusb_device_handle* handle,
                                  const libusb_device_descriptor& about,
                                  std::span<char, 32> text) noexcept {
  std::array<unsigned char, 32> bytes{};
  int n = 0;
  if (about.iSerialNumber != 0) {
    n = libusb_get_string_descriptor_ascii(handle, about.iSerialNumber, bytes.data(),
                                           static_cast<int>(bytes.size() - 1));
  }
  std::fill(text.begin(), text.end(), '\0');
  for (int i = 0; i < n; ++i) {
    text[static_cast<std::size_t>(i)] = static_cast<char>(bytes[static_cast<std::size_t>(i)]);
  }
  return {text.data(), static_cast<std::size_t>((std::max)(n, 0))};
}

/// Calls `visit` with every Falcon, until it returns true.
template <class Visit>
void each_falcon(libusb_context* context, Visit visit) noexcept {
  libusb_device** devices = nullptr;
  const auto n = libusb_get_device_list(context, &devices);
  for (ssize_t i = 0; i < n; ++i) {
    libusb_device_descriptor about{};
    if (libusb_get_device_descriptor(devices[i], &about) != 0) continue;
    if (about.idVendor != ftdi::vendor || about.idProduct != ftdi::product) continue;
    if (visit(devices[i], about)) break;
  }
  if (n >= 0) libusb_free_device_list(devices, 1);
}

}  // namespace detail

/// Fills in `found`; returns how many there are, which may be more.
[[nodiscard]] inline std::size_t list_devices(std::span<listed_device> found) noexcept {
  libusb_context* context = nullptr;
  if (libusb_init(&context) != 0) return 0;
  std::size_t n = 0;
  detail::each_falcon(context, [&](libusb_device* device, const libusb_device_descriptor& about) {
    if (n++ >= found.size()) return false;
    listed_device& entry = found[n - 1];
    entry = {libusb_get_bus_number(device), libusb_get_device_address(device)};
    libusb_device_handle* handle = nullptr;
    entry.openable = detail::code_of(libusb_open(device, &handle), code::no_device);
    if (handle == nullptr) return false;
    (void)detail::serial_of(handle, about, entry.serial);
    libusb_close(handle);
    return false;
  });
  libusb_exit(context);
  return n;
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics

#endif
