// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// to_decimal reads a decimal number from text and rounds it to the nearest double. It ignores the locale, so
// the decimal point is a point wherever the program runs.
//
// It uses std::from_chars. Before version 20 libc++ has that for integers only; there a stream in the "C" locale
// reads the same doubles, some ten times slower.

#include <passive_haptics/base/kernels.hpp>

#include <charconv>
#include <concepts>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

namespace passive_haptics {
inline namespace v0 {

/// True for [+-]digits[.digits][e[+-]digits], where one side of the point may be empty. False for nan, inf,
/// hexadecimal numbers, and for a number with anything around it.
[[nodiscard]] constexpr bool is_decimal(std::string_view text) noexcept {
  const auto take = [&text](std::string_view some) {
    if (text.empty() || some.find(text.front()) == std::string_view::npos) return false;
    text.remove_prefix(1);
    return true;
  };
  const auto digits = [&take] {
    bool any = false;
    while (take("0123456789")) any = true;
    return any;
  };
  take("+-");
  const bool before = digits();
  const bool after = take(".") && digits();
  if (!before && !after) return false;
  if (take("eE")) {
    take("+-");
    if (!digits()) return false;
  }
  return text.empty();
}

namespace detail {

/// Satisfied if the standard library's from_chars reads a `Real`.
template <class Real>
concept read_by_charconv = requires(const char* text, Real& value) {
  { std::from_chars(text, text, value) } -> std::same_as<std::from_chars_result>;
};

/// Reads a decimal number with a stream. A number beyond the largest double becomes ±infinity.
[[nodiscard]] inline double decimal_by_stream(std::string_view decimal) {
  std::istringstream stream{std::string(decimal)};
  stream.imbue(std::locale::classic());
  double value = 0.0;
  stream >> value;
  // Reading a decimal number fails only because of its size. A number that is too large then leaves the largest
  // double or infinity in `value`; one that is too small, which fails in some libraries, leaves its rounded value.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double largest = kernels::largest<double>();
  if (!stream.fail() || (value < largest && value > -largest)) return value;
  return value > 0.0 ? infinity : -infinity;
}

/// Reads a decimal number with from_chars. A number out of range goes to the stream, because from_chars does not
/// say whether it was too large or too small.
template <read_by_charconv Real>
[[nodiscard]] Real decimal_by_charconv(std::string_view decimal) {
  const std::string_view text = decimal.substr(decimal.front() == '+' ? 1 : 0);
  Real value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} ? value : decimal_by_stream(decimal);
}

}  // namespace detail

/// The double nearest to the number in `text`, ±infinity if it is beyond the largest double; nullopt if `text`
/// is no decimal number.
template <class Real = double>
[[nodiscard]] std::optional<Real> to_decimal(std::string_view text) {
  if (!is_decimal(text)) return std::nullopt;
  if constexpr (detail::read_by_charconv<Real>) return detail::decimal_by_charconv<Real>(text);
  return detail::decimal_by_stream(text);
}

}  // namespace v0
}  // namespace passive_haptics
