// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace fuzz {

using input = std::span<const std::uint8_t>;

/// Takes an input apart, zeros when it is used up.
class reader {
 public:
  explicit reader(input bytes) noexcept : bytes_(bytes) {}

  std::uint8_t one() noexcept {
    if (bytes_.empty()) return 0;
    const std::uint8_t b = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return b;
  }
  template <class T>
  T any() noexcept {
    T value{};
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      const std::uint8_t b = one();
      std::memcpy(reinterpret_cast<unsigned char*>(&value) + i, &b, 1);
    }
    return value;
  }
  [[nodiscard]] bool empty() const noexcept { return bytes_.empty(); }

 private:
  input bytes_;
};

}  // namespace fuzz
