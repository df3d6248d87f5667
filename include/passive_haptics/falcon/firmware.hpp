// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The program that the Falcon needs after every power-up: a boot stream for the ROM of its TI C28x.
// The images are the maker's; none is shipped here, the user names a file. It is checked before a
// byte of it is sent:
//
//   word 0      0x08AA, the key          words 1-8   reserved        words 9, 10   entry, high first
//   then blocks {length, address high, address low, length × data}, and a length 0 at the very end
//
// Words are 16 bits, the low byte first.

#include <passive_haptics/falcon/packet.hpp>
#include <passive_haptics/falcon/result.hpp>

#include <cstdio>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// What a boot stream says of itself.
struct image_summary {
  result how{};             ///< ok, or what is wrong and where
  std::uint32_t entry = 0;  ///< address the program starts at
  std::uint32_t blocks = 0;
  std::uint32_t words = 0;  ///< of data in all blocks
};

/// Walks through the whole stream; what lies in the blocks is not looked at.
[[nodiscard]] constexpr image_summary check_image(std::span<const byte> image) noexcept {
  constexpr unsigned key = 0x08AA;
  constexpr std::size_t header = 2 * 11;  // key, reserved, entry
  if (image.empty()) return {{code::image_missing}};
  const auto word = [&image](std::size_t at) {
    return static_cast<std::uint32_t>(image[at] | image[at + 1] << 8);
  };
  const auto at_byte = [](code c, std::size_t at) {
    return result{c, static_cast<std::int64_t>(at)};
  };
  if (image.size() >= 2 && word(0) != key) return {{code::image_wrong_key, word(0)}};
  if (image.size() < header + 2) return {at_byte(code::image_truncated, 0)};
  image_summary seen{{}, word(18) << 16 | word(20)};
  std::size_t at = header;
  while (at + 2 <= image.size()) {
    const std::uint32_t length = word(at);
    if (length == 0) {
      if (at + 2 != image.size()) seen.how = at_byte(code::image_trailing, at + 2);
      return seen;
    }
    const std::size_t next = at + 2 + 4 + 2 * static_cast<std::size_t>(length);
    if (next + 2 > image.size()) break;
    ++seen.blocks;
    seen.words += length;
    at = next;
  }
  seen.how = at_byte(code::image_truncated, at);
  return seen;
}

/// An image read from a file. 40 kB as a member or a static, better not on a small stack.
class firmware {
 public:
  static constexpr std::size_t capacity = 40 * 1024;  ///< the chip has 36 kB of memory

  /// Reads and checks the file.
  result load(const char* path) noexcept {
    size_ = 0;
    std::FILE* file = path != nullptr ? std::fopen(path, "rb") : nullptr;
    if (file == nullptr) return {code::image_unreadable};
    const std::size_t read = std::fread(bytes_.data(), 1, bytes_.size(), file);
    const bool failed = std::ferror(file) != 0;
    const bool more = read == bytes_.size() && std::fgetc(file) != EOF;
    std::fclose(file);
    if (failed) return {code::image_unreadable};
    if (more) return {code::image_too_long, static_cast<std::int64_t>(capacity)};
    const result sound = check_image(std::span(bytes_).first(read)).how;
    if (sound) size_ = read;
    return sound;
  }

  /// Empty until a load() went well.
  [[nodiscard]] std::span<const byte> bytes() const noexcept {
    return std::span(bytes_).first(size_);
  }

 private:
  std::array<byte, capacity> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
