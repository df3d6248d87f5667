// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The real Falcon over libusb-1.0, by asynchronous transfers that the calling thread drives. Link usb-1.0.
// Where libusb's header is not installed (Debian: libusb-1.0-0-dev) this header declares nothing.
//
// Two IN transfers are always in flight, so that no reply waits for the host. A write returns at once, and the
// next call reports its fault. libusb itself may allocate when a transfer is submitted;
// this transport does not.

#include <passive_haptics/falcon/transport.hpp>

#if __has_include(<libusb-1.0/libusb.h>)
#include <libusb-1.0/libusb.h>
#include <string_view>
#include <utility>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// Names a Falcon: the n-th on the bus, counted from 0, or the one with that serial number.
struct which {
  int index = 0;
  std::string_view serial = {};
};

/// A Falcon on the bus.
struct listed_device {
  int bus = 0, address = 0;
  std::array<char, 32> serial{};  ///< empty if it has none, or may not be opened
  result openable{};              ///< ok, or why it cannot be opened
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

/// Calls `visit` for every Falcon on the bus until it returns true.
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

/// Lists the Falcons on the bus in `found`; returns their number, which may exceed the size of `found`.
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

class libusb_transport {
 public:
  libusb_transport() noexcept = default;
  libusb_transport(const libusb_transport&) = delete;
  libusb_transport& operator=(const libusb_transport&) = delete;
  ~libusb_transport() { close(); }

  result open(const which& wanted = {}) noexcept {
    close();
    if (const int failed = libusb_init(&context_); failed != 0) {
      context_ = nullptr;
      return detail::code_of(failed, code::no_device);
    }
    result done = find(wanted);
    if (done) done = detail::code_of(libusb_claim_interface(handle_, 0), code::no_device);
    if (done) done = start();
    if (!done) close();
    return done;
  }

  /// Waits up to 100 ms until the last write has gone out, then releases the device.
  void close() noexcept {
    closing_ = true;
    if (handle_ != nullptr) {
      const nanoseconds flushed = now() + std::chrono::milliseconds(100);
      while (out_.busy && !lost_ && now() < flushed) pump(flushed);
      for (slot* s : slots()) {
        if (s->busy) libusb_cancel_transfer(s->transfer);
      }
      const nanoseconds cancelled = now() + std::chrono::seconds(1);
      while (busy() && now() < cancelled) pump(cancelled);
      libusb_release_interface(handle_, 0);
      libusb_close(handle_);
    }
    for (slot* s : slots()) {
      if (!s->busy) libusb_free_transfer(s->transfer);  // libusb still owns a busy transfer
      s->transfer = nullptr;
      s->busy = false;
    }
    if (context_ != nullptr) libusb_exit(context_);
    handle_ = nullptr;
    context_ = nullptr;
    fault_ = {};
    lost_ = closing_ = false;
    first_ = count_ = 0;
  }

  [[nodiscard]] bool is_open() const noexcept { return handle_ != nullptr; }
  [[nodiscard]] ftdi::line_status lines() const noexcept { return lines_; }
  [[nodiscard]] nanoseconds now() const noexcept {
    return std::chrono::steady_clock::now().time_since_epoch();
  }

  result control(request r, std::uint16_t value) noexcept {
    if (const result bad = trouble(); !bad) return bad;
    constexpr byte vendor_out = 0x40;
    constexpr unsigned most = 1000;  // ms
    const int done = libusb_control_transfer(handle_, vendor_out, static_cast<byte>(r), value, 0,
                                             nullptr, 0, most);
    if (r == request::reset && value != ftdi::purge_transmit) {
      pump(now());
      count_ = 0;
    }
    return detail::code_of(done, code::unplugged);
  }

  result write(std::span<const byte> bytes, nanoseconds deadline) noexcept {
    while (!bytes.empty()) {
      while (out_.busy && !lost_ && now() < deadline) pump(deadline);
      if (const result bad = trouble(); !bad) return bad;
      if (out_.busy) return {code::timeout};
      const auto part = bytes.first((std::min)(bytes.size(), out_.buffer.size()));
      std::copy(part.begin(), part.end(), out_.buffer.begin());
      out_.transfer->length = static_cast<int>(part.size());
      if (const result done = submit(out_); !done) return done;
      bytes = bytes.subspan(part.size());
    }
    return {};
  }

  transfer read(std::span<byte> into, nanoseconds deadline) noexcept {
    for (bool looked = false; count_ == 0; looked = true) {
      if (const result bad = trouble(); !bad) return {bad, 0, now()};
      if (looked && now() >= deadline) return {{code::timeout}, 0, now()};
      for (slot& s : in_) {
        if (s.busy) continue;
        if (const result done = submit(s); !done) return {done, 0, now()};
      }
      pump(deadline);
    }
    const std::size_t n = (std::min)(into.size(), count_);
    for (std::size_t i = 0; i < n; ++i) into[i] = received_[(first_ + i) % received_.size()];
    first_ = (first_ + n) % received_.size();
    count_ -= n;
    return {{}, n, stamp_};
  }

 private:
  struct slot {
    libusb_transfer* transfer = nullptr;
    std::array<byte, 8 * ftdi::usb_packet> buffer{};
    bool busy = false;
    libusb_transport* owner = nullptr;
  };

  [[nodiscard]] result find(const which& wanted) noexcept {
    result last{code::no_device};
    int index = 0;
    detail::each_falcon(
        context_, [&](libusb_device* device, const libusb_device_descriptor& about) {
          if (wanted.serial.empty() && index++ != wanted.index) return false;
          const result opened = detail::code_of(libusb_open(device, &handle_), code::no_device);
          if (!opened) {
            handle_ = nullptr;
            last = opened;
            return false;
          }
          std::array<char, 32> text{};
          if (wanted.serial.empty() || detail::serial_of(handle_, about, text) == wanted.serial)
            return true;
          libusb_close(handle_);
          handle_ = nullptr;
          return false;
        });
    return handle_ != nullptr ? result{} : last;
  }

  [[nodiscard]] result start() noexcept {
    for (slot* s : slots()) {
      s->owner = this;
      s->transfer = libusb_alloc_transfer(0);
      if (s->transfer == nullptr) return {code::transfer_failed, LIBUSB_ERROR_NO_MEM};
      const bool out = s == &out_;
      libusb_fill_bulk_transfer(s->transfer, handle_, out ? ftdi::bulk_out : ftdi::bulk_in,
                                s->buffer.data(), static_cast<int>(s->buffer.size()),
                                out ? &sent : &arrived, s, 0);
    }
    return {};
  }

  [[nodiscard]] result submit(slot& s) noexcept {
    const int failed = libusb_submit_transfer(s.transfer);
    s.busy = failed == 0;
    lost_ = lost_ || failed == LIBUSB_ERROR_NO_DEVICE;
    return detail::code_of(failed, code::unplugged);
  }

  /// ok, or the fault that ends the present call. A fault that a transfer has reported is returned once.
  [[nodiscard]] result trouble() noexcept {
    if (handle_ == nullptr) return {code::not_open};
    if (lost_) return {code::unplugged};
    return std::exchange(fault_, result{});
  }

  /// Lets libusb handle events until something happens, or until the time `until`.
  void pump(nanoseconds until) noexcept {
    const auto left = std::chrono::duration_cast<std::chrono::microseconds>(until - now());
    const auto wait = (std::max)(left, std::chrono::microseconds(0));
    timeval limit{};
    limit.tv_sec = static_cast<decltype(limit.tv_sec)>(wait.count() / 1'000'000);
    limit.tv_usec = static_cast<decltype(limit.tv_usec)>(wait.count() % 1'000'000);
    if (libusb_handle_events_timeout_completed(context_, &limit, nullptr) ==
        LIBUSB_ERROR_NO_DEVICE) {
      lost_ = true;
    }
  }

  void finish(const libusb_transfer& t) noexcept {
    switch (t.status) {
      case LIBUSB_TRANSFER_COMPLETED:
      case LIBUSB_TRANSFER_CANCELLED:
        return;
      case LIBUSB_TRANSFER_NO_DEVICE:
        lost_ = true;
        return;
      default:
        fault_ = {code::transfer_failed, t.status};
    }
  }

  void take(std::span<byte> bytes) noexcept {
    const std::size_t n = ftdi::strip_status(bytes, lines_);
    for (std::size_t i = 0; i < n && count_ < received_.size(); ++i) {
      received_[(first_ + count_++) % received_.size()] = bytes[i];
    }
    if (n > 0) stamp_ = now();
  }

  static void LIBUSB_CALL arrived(libusb_transfer* t) noexcept {
    slot& s = *static_cast<slot*>(t->user_data);
    libusb_transport& self = *s.owner;
    s.busy = false;
    self.finish(*t);
    self.take(std::span(s.buffer).first(static_cast<std::size_t>((std::max)(t->actual_length, 0))));
    if (t->status == LIBUSB_TRANSFER_COMPLETED && !self.closing_) (void)self.submit(s);
  }

  static void LIBUSB_CALL sent(libusb_transfer* t) noexcept {
    slot& s = *static_cast<slot*>(t->user_data);
    s.busy = false;
    s.owner->finish(*t);
  }

  [[nodiscard]] std::array<slot*, 3> slots() noexcept { return {&in_[0], &in_[1], &out_}; }
  [[nodiscard]] bool busy() const noexcept { return in_[0].busy || in_[1].busy || out_.busy; }

  libusb_context* context_ = nullptr;
  libusb_device_handle* handle_ = nullptr;
  std::array<slot, 2> in_{};
  slot out_{};
  std::array<byte, 4096> received_{};
  std::size_t first_ = 0, count_ = 0;  ///< begin and number of the bytes in received_
  nanoseconds stamp_{};                ///< when the newest byte came
  ftdi::line_status lines_{};
  result fault_{};        ///< fault of a transfer that is not reported yet
  bool lost_ = false;     ///< the device is gone
  bool closing_ = false;  ///< no transfer is submitted again
};

static_assert(transport<libusb_transport>);

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics

#endif
