// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A line of words and numbers, without a printf.

#include "../target/platform.hpp"

#include <bit>
#include <cstdint>
#include <type_traits>

/// Grows to the right, is printed, starts again.
class text_line {
 public:
  template <class... Words>
  text_line& words(const Words*... all) {
    (word(all), ...);
    return *this;
  }
  text_line& number(std::uint32_t value) {
    char digits[11];
    char* end = digits + 10;
    *end = '\0';
    do {
      *--end = static_cast<char>('0' + value % 10);
      value /= 10;
    } while (value != 0);
    return word(end);
  }
  /// The bits of a float or a double, in hexadecimal. Every NaN is "nan": its bits mean nothing.
  template <class Real>
  text_line& bits(Real value) {
    using integer = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    if (value != value) return word("nan");
    const auto all = std::bit_cast<integer>(value);
    char digits[17];
    int n = 0;
    for (int shift = 8 * static_cast<int>(sizeof(Real)) - 4; shift >= 0; shift -= 4) {
      digits[n++] = "0123456789abcdef"[(all >> shift) & 15];
    }
    digits[n] = '\0';
    return word(digits);
  }
  void print() {
    text_[length_++] = '\n';
    text_[length_] = '\0';
    platform::print(text_);
    length_ = 0;
  }

 private:
  text_line& word(const char* text) {
    if (length_ != 0) text_[length_++] = ' ';
    while (*text != '\0' && length_ < static_cast<int>(sizeof text_) - 3)
      text_[length_++] = *text++;
    return *this;
  }
  char text_[200] = {};
  int length_ = 0;
};
