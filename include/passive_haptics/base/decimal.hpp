// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decimal numbers of a text file, exact and in no locale: a point is a point wherever the program runs.
//
// std::from_chars is the tool for it, but before version 20 libc++ has it for integers only; there a
// stream in the "C" locale reads the same doubles, some ten times slower.

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

/// True for [+-]digits[.digits][e[+-]digits] where one side of the point may be empty: neither nan, inf
/// and hexadecimal numbers, nor anything around the number.
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

/// The standard library's from_chars takes floating-point numbers.
template <class Real>
concept read_by_charconv = requires(const char* text, Real& value) {
  { std::from_chars(text, text, value) } -> std::same_as<std::from_chars_result>;
};

/// The double nearest to a decimal number, by a stream: ±infinity beyond the largest.
[[nodiscard]] inline double decimal_by_stream(std::string_view decimal) {
  std::istringstream stream{std::string(decimal)};
  stream.imbue(std::locale::classic());
  double value = 0.0;
  stream >> value;
  // A decimal number fails by its size alone: a large one as the largest double or infinity; a tiny one,
  // which some libraries fail, too, as what it is rounded to.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double largest = kernels::largest<double>();
  if (!stream.fail() || (value < largest && value > -largest)) return value;
  return value > 0.0 ? infinity : -infinity;
}

/// The same by from_chars, which leaves what is beyond the largest double or below the smallest to the
/// stream: it does not tell one from the other.
template <read_by_charconv Real>
[[nodiscard]] Real decimal_by_charconv(std::string_view decimal) {
  const std::string_view text = decimal.substr(decimal.front() == '+' ? 1 : 0);
  Real value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} ? value : decimal_by_stream(decimal);
}

}  // namespace detail

/// The double nearest to the text, ±infinity if it is beyond the largest; none if it is no decimal
/// number.
template <class Real = double>
[[nodiscard]] std::optional<Real> to_decimal(std::string_view text) {
  if (!is_decimal(text)) return std::nullopt;
  if constexpr (detail::read_by_charconv<Real>) return detail::decimal_by_charconv<Real>(text);
  return detail::decimal_by_stream(text);
}

}  // namespace v0
}  // namespace passive_haptics
