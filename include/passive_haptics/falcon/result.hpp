// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a call to the Falcon ended. Nothing here throws: every call returns one of these codes, and
// each has a text that says what happened and a remedy that says what to do.

#include <passive_haptics/base/language.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

enum class code : std::uint8_t {
  ok,
  timeout,           ///< nothing came before the deadline
  unplugged,         ///< the device is gone
  not_open,          ///< the call needs an open device
  no_device,         ///< no 0403:cb48 on the bus, or not that one
  no_permission,     ///< it is there, but this user may not open it
  busy,              ///< another program holds it
  transfer_failed,   ///< `value` is the number of the layer below
  image_unreadable,  ///< the file cannot be opened or read
  image_too_long,    ///< more bytes than the chip has memory
  image_wrong_key,   ///< `value` is the first word, which is not 0x08AA
  image_truncated,   ///< a block, `value` bytes into the file, is longer than the rest of it
  image_trailing,    ///< the stream ends `value` bytes into the file, which goes on
  image_missing,     ///< the device runs no program, and there is no image to load
  no_hello,          ///< the monitor did not answer
  no_loader,         ///< the loader did not lock on to the baud rate
  echo_missing,      ///< byte `value` of the image was not echoed
  echo_mismatch,     ///< byte `value` of the image was echoed as another
  no_program,        ///< the program does not answer
  cancelled,         ///< the progress callback said so
  homing_timeout,    ///< the grip was not pulled out and pushed in
  not_homed,         ///< legs do not know where they are: no position, no force
  settling,          ///< homed, but not for long enough yet
  encoder_jump,      ///< a count moved farther than an arm can
  pose_refused,      ///< these angles fit no position, or one near a singular pose
  force_not_finite,  ///< a NaN or an infinity was commanded
  too_many_misses,   ///< `value` replies in a row did not come
  bad_setting,       ///< a setting is out of its range: check() names it
  log_unreadable,    ///< line `value` of a recording is not one
  log_unwritable,    ///< the file of a recording cannot be written
  no_thread,         ///< the system gave none
  clock_backwards,   ///< no time has passed since the question before, or less than none
  log_full,          ///< the recorder's memory is full, the rest was not recorded
};

/// What happened, for logs.
[[nodiscard]] constexpr const char* to_string(code c) noexcept {
  switch (c) {
    case code::ok:
      return "ok";
    case code::timeout:
      return "nothing came before the deadline";
    case code::unplugged:
      return "the device is gone";
    case code::not_open:
      return "the device is not open";
    case code::no_device:
      return "no such Falcon on the bus";
    case code::no_permission:
      return "no permission to open the device";
    case code::busy:
      return "another program holds the device";
    case code::transfer_failed:
      return "a USB transfer failed";
    case code::image_unreadable:
      return "the firmware file cannot be read";
    case code::image_too_long:
      return "the firmware file is longer than the chip's memory";
    case code::image_wrong_key:
      return "the firmware file does not begin with 0x08AA";
    case code::image_truncated:
      return "the firmware file ends inside a block";
    case code::image_trailing:
      return "the firmware file goes on after its end mark";
    case code::image_missing:
      return "the device runs no program and no firmware was given";
    case code::no_hello:
      return "the monitor does not answer";
    case code::no_loader:
      return "the loader does not answer";
    case code::echo_missing:
      return "the loader fell silent";
    case code::echo_mismatch:
      return "the loader echoed another byte";
    case code::no_program:
      return "the program does not answer";
    case code::cancelled:
      return "cancelled";
    case code::homing_timeout:
      return "not homed in time";
    case code::not_homed:
      return "not homed";
    case code::settling:
      return "homed, waiting for the encoders to settle";
    case code::encoder_jump:
      return "an encoder jumped";
    case code::pose_refused:
      return "the encoders show no usable position";
    case code::force_not_finite:
      return "a force that is not finite was commanded";
    case code::too_many_misses:
      return "too many replies in a row were missed";
    case code::bad_setting:
      return "a setting is out of its range";
    case code::log_unreadable:
      return "the recording cannot be read";
    case code::log_unwritable:
      return "the recording cannot be written";
    case code::no_thread:
      return "the system gave no thread";
    case code::clock_backwards:
      return "the transport's clock stood still or stepped back";
    case code::log_full:
      return "the recording is full";
  }
  return "unknown code";
}

/// What to do about it; empty when there is nothing to say.
[[nodiscard]] constexpr const char* remedy(code c) noexcept {
  switch (c) {
    case code::unplugged:
      return "plug it in, close() and open() again";
    case code::not_open:
      return "open() and boot() first";
    case code::no_device:
      return "check cable and power; list_devices() says what is there";
    case code::no_permission:
      return "install the udev rule of docs/falcon.md";
    case code::busy:
      return "end the other program";
    case code::transfer_failed:
      return "try another port or a powered hub";
    case code::image_unreadable:
    case code::image_too_long:
    case code::image_wrong_key:
    case code::image_truncated:
    case code::image_trailing:
      return "give the path of a Falcon firmware image, unchanged";
    case code::image_missing:
      return "give a firmware image to boot()";
    case code::no_hello:
    case code::no_loader:
    case code::echo_missing:
    case code::echo_mismatch:
    case code::no_program:
      return "power the device off and on; try another port or a powered hub";
    case code::not_homed:
      return "pull the grip fully out, then push it fully in";
    case code::homing_timeout:
      return "check the wall power, pull the grip fully out, then push it fully in";
    case code::force_not_finite:
      return "find out where it comes from, then recover()";
    case code::too_many_misses:
      return "recover(), or close() and open() again";
    case code::bad_setting:
      return "see check()";
    case code::clock_backwards:
      return "give the transport a steady clock";
    case code::log_full:
      return "give the recorder more rows";
    case code::ok:
    case code::timeout:
    case code::settling:
    case code::encoder_jump:
    case code::pose_refused:
    case code::cancelled:
    case code::log_unreadable:
    case code::log_unwritable:
    case code::no_thread:
      return "";
  }
  return "";
}

/// Converts to true when all went well.
///     if (const auto done = falcon.open(); !done) puts(to_string(done.what));
struct [[nodiscard]] result {
  code what = code::ok;
  std::int64_t value = 0;  ///< see the code; for USB codes the number of the layer below

  constexpr explicit operator bool() const noexcept { return what == code::ok; }
};

/// The whole sentence, what, value and remedy, into `text`; cut off where it is too long.
inline const char* describe(const result& r, std::span<char> text) noexcept {
  if (text.empty()) return "";
  std::size_t length = 0;
  const auto append = [&](std::string_view part) {
    const std::size_t n = (std::min)(part.size(), text.size() - 1 - length);
    std::copy_n(part.begin(), n, text.begin() + static_cast<std::ptrdiff_t>(length));
    length += n;
  };
  append(to_string(r.what));
  if (r.value != 0) {
    std::array<char, 24> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), r.value).ptr;
    append(" (");
    append({digits.data(), static_cast<std::size_t>(end - digits.data())});
    append(")");
  }
  if (const std::string_view help = remedy(r.what); !help.empty()) {
    append(": ");
    append(help);
  }
  text[length] = '\0';
  return text.data();
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
