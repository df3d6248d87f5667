// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Base64 (RFC 4648), as VTU files have it.

#include <passive_haptics/base/language.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

inline constexpr std::string_view base64_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

[[nodiscard]] inline std::string to_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const char c = at + k < bytes.size() ? bytes[at + k] : '\0';
      word = word << 8U | std::uint32_t{static_cast<unsigned char>(c)};
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_there = k == 0 || at + k - 1 < bytes.size();
      text += is_there ? base64_digits[word >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

/// The first `most` bytes, fewer where the text ends or is no base64. Blanks are passed over; behind a
/// padding the text may go on, as after a header that was encoded by itself.
[[nodiscard]] inline std::string from_base64(std::string_view text, std::size_t most) {
  std::string bytes;
  std::uint32_t word = 0;
  int digits = 0, padding = 0;
  for (const char c : text) {
    if (bytes.size() >= most) break;
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    const std::size_t digit = c == '=' ? 0 : base64_digits.find(c);
    if (digit == std::string_view::npos) break;
    padding += c == '=' ? 1 : 0;
    word = word << 6U | static_cast<std::uint32_t>(digit);
    if (++digits < 4) continue;
    for (int k = 0; k < 3 - padding; ++k) bytes += static_cast<char>(word >> (16 - 8 * k) & 255U);
    word = 0;
    digits = padding = 0;
  }
  if (bytes.size() > most) bytes.resize(most);
  return bytes;
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
