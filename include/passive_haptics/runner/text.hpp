// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes text into memory of the caller, and cuts it off at the end of that.

#include <passive_haptics/base/language.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace detail {

/// The text always ends with a zero, unless the room is empty.
class cut_text {
 public:
  explicit cut_text(std::span<char> room) noexcept : room_(room) {
    if (!room_.empty()) room_[0] = '\0';
  }
  [[nodiscard]] bool empty() const noexcept { return length_ == 0; }
  [[nodiscard]] const char* c_str() const noexcept { return room_.empty() ? "" : room_.data(); }

  cut_text& add(std::string_view part) noexcept {
    if (room_.empty()) return *this;
    const std::size_t n = (std::min)(part.size(), room_.size() - 1 - length_);
    std::copy_n(part.begin(), n, room_.begin() + static_cast<std::ptrdiff_t>(length_));
    length_ += n;
    room_[length_] = '\0';
    return *this;
  }
  /// Adds what printf would write, up to 255 characters.
  template <class... Values>
  cut_text& print(const char* format, const Values&... values) noexcept {
    std::array<char, 256> line{};
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
#pragma GCC diagnostic ignored "-Wformat-security"
#endif
    const int n = std::snprintf(line.data(), line.size(), format, values...);
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
    return n > 0 ? add(line.data()) : *this;
  }

 private:
  std::span<char> room_;
  std::size_t length_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
