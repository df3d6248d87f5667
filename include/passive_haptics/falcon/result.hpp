// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The result of a call to the Falcon. No call throws.
// Each returns a code. It has a text, and a remedy where the user can do something.

#include <passive_haptics/base/language.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <span>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

enum class code : std::uint8_t {
  ok,
  timeout,
  unplugged,
  not_open,
  no_device,  ///< no 0403:cb48 on the bus, or not the one asked for
  no_permission,
  busy,
  transfer_failed,  ///< `value` is libusb's error, or its status of the transfer
  image_unreadable,
  image_too_long,
  image_wrong_key,  ///< `value` is the first word, which is not 0x08AA
  image_truncated,  ///< a block, `value` bytes into the file, is longer than the rest of it
  image_trailing,   ///< the stream ends `value` bytes into the file, before the file ends
  image_missing,
  no_hello,
  no_loader,
  echo_missing,   ///< byte `value` of the image was not echoed
  echo_mismatch,  ///< byte `value` of the image was echoed as another
  no_program,
  cancelled,
  homing_timeout,
  not_homed,  ///< a leg has no absolute angle: there is no position and no force
  settling,
  encoder_jump,
  pose_refused,  ///< these angles fit no position, or one near a singular pose
  force_not_finite,
  too_many_misses,  ///< settings::most_misses replies in a row were missing
  bad_setting,      ///< a setting is out of its range: check() names it
  log_unreadable,   ///< line `value` of a recording is no row; 0: there is no such file
  log_unwritable,
  no_thread,        ///< `value` is the system's error
  clock_backwards,  ///< the time since the question before is ≤ 0
  log_full,
};

namespace detail {

struct code_text {
  code of;
  const char* what;
  const char* remedy = "";
};

inline constexpr const char* other_image = "give the path of a Falcon firmware image, unchanged";
inline constexpr const char* power_cycle =
    "power the device off and on; try another port or a powered hub";

inline constexpr code_text code_texts[] = {
    {code::ok, "ok"},
    {code::timeout, "nothing came before the deadline"},
    {code::unplugged, "the device is gone", "plug it in, close() and open() again"},
    {code::not_open, "the device is not open", "open(), and start() or boot(), first"},
    {code::no_device, "no such Falcon on the bus",
     "check cable and power; list_devices() says what is there"},
    {code::no_permission, "no permission to open the device",
     "install the udev rule of docs/falcon.md"},
    {code::busy, "another program holds the device", "end the other program"},
    {code::transfer_failed, "a USB transfer failed", "try another port or a powered hub"},
    {code::image_unreadable, "the firmware file cannot be read", other_image},
    {code::image_too_long, "the firmware file is longer than the chip's memory", other_image},
    {code::image_wrong_key, "the firmware file does not begin with 0x08AA", other_image},
    {code::image_truncated, "the firmware file ends inside a block", other_image},
    {code::image_trailing, "the firmware file goes on after its end mark", other_image},
    {code::image_missing, "the device runs no program and no firmware was given",
     "give a firmware image to boot()"},
    {code::no_hello, "the monitor does not answer", power_cycle},
    {code::no_loader, "the loader does not answer", power_cycle},
    {code::echo_missing, "the loader fell silent", power_cycle},
    {code::echo_mismatch, "the loader echoed another byte", power_cycle},
    {code::no_program, "the program does not answer", power_cycle},
    {code::cancelled, "cancelled"},
    {code::homing_timeout, "not homed in time",
     "check the wall power, pull the grip fully out, then push it fully in"},
    {code::not_homed, "not homed", "pull the grip fully out, then push it fully in"},
    {code::settling, "homed, waiting for the encoders to settle"},
    {code::encoder_jump, "an encoder jumped"},
    {code::pose_refused, "the encoders show no usable position"},
    {code::force_not_finite, "a force that is not finite was commanded",
     "find out where it comes from, then recover()"},
    {code::too_many_misses, "too many replies in a row were missed",
     "recover(), or close() and open() again"},
    {code::bad_setting, "a setting is out of its range", "see check()"},
    {code::log_unreadable, "the recording cannot be read"},
    {code::log_unwritable, "the recording cannot be written"},
    {code::no_thread, "the system gave no thread"},
    {code::clock_backwards, "the transport's clock stood still or stepped back",
     "give the transport a steady clock"},
    {code::log_full, "the recording is full", "give the recorder more rows"},
};

[[nodiscard]] constexpr code_text text_of(code c) noexcept {
  for (const code_text& row : code_texts) {
    if (row.of == c) return row;
  }
  return {c, "unknown code"};
}

}  // namespace detail

/// The text of a code, for logs.
[[nodiscard]] constexpr const char* to_string(code c) noexcept {
  return detail::text_of(c).what;
}

/// The remedy of a code; empty if there is none.
[[nodiscard]] constexpr const char* remedy(code c) noexcept {
  return detail::text_of(c).remedy;
}

/// A code and its value; it converts to true if the code is ok.
///     if (const auto done = falcon.open(); !done) puts(to_string(done.what));
struct [[nodiscard]] result {
  code what = code::ok;
  std::int64_t value = 0;  ///< see the code; for USB codes libusb's error

  constexpr explicit operator bool() const noexcept { return what == code::ok; }
};

/// Writes the whole sentence, text, value and remedy, into `text`, which may cut it off; returns `text`.
inline const char* describe(const result& r, std::span<char> text) noexcept {
  if (text.empty()) return "";
  std::array<char, 32> number{};
  if (r.value != 0) {
    std::snprintf(number.data(), number.size(), " (%lld)", static_cast<long long>(r.value));
  }
  const char* help = remedy(r.what);
  std::size_t length = 0;
  for (const char* part : {to_string(r.what), static_cast<const char*>(number.data()),
                           *help != '\0' ? ": " : "", help}) {
    for (; *part != '\0' && length + 1 < text.size(); ++part) text[length++] = *part;
  }
  text[length] = '\0';
  return text.data();
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
