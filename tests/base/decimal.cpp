// SPDX-License-Identifier: BSD-3-Clause
// Decimal numbers: what is one, and both ways to read it, whatever the standard library has.
#include "support/catch.hpp"
#include <passive_haptics/base/decimal.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <string>
#include <string_view>

namespace ph = passive_haptics;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// As printf prints x with so many digits, in one of its notations.
std::string printed(double x, const char* notation, int digits) {
  std::array<char, 1500> text{};
  std::snprintf(text.data(), text.size(), notation, digits, x);
  return text.data();
}

/// Both ways give `expected`, bit for bit.
template <class Real = double>
void check_both(const std::string& text, Real expected) {
  const auto same = [&](Real value) {
    return std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(expected);
  };
  INFO(text);
  REQUIRE(ph::is_decimal(text));
  REQUIRE(same(ph::detail::decimal_by_stream(text)));
  if constexpr (ph::detail::read_by_charconv<Real>)
    REQUIRE(same(ph::detail::decimal_by_charconv<Real>(text)));
  REQUIRE(same(*ph::to_decimal(text)));
}

}  // namespace

TEST_CASE("to_decimal reads decimal numbers and nothing else", "[decimal]") {
  for (const char* text : {"0", "-0", "+1", "1.5", "5.", ".5", "-.5e3", "1e5", "1E+5", "1e-05",
                           "007", "1.50000000000000000000000000000000000000000000000001"}) {
    INFO(text);
    CHECK(ph::is_decimal(text));
  }
  for (const char* text :
       {"",    "+",    "-",     ".",   "+.",  "e5",   ".e5",   "1e",   "1e+", "1e5.", "1e5e5",
        "1,5", "1.5x", " 1",    "1 ",  "1f",  "0x10", "0x1p3", "nan",  "NaN", "inf",  "-inf",
        "--1", "+-1",  "1.2.3", "1d5", "1_0", "1'0",  "١",     "1e 5", "1\n"}) {
    INFO(text);
    CHECK_FALSE(ph::is_decimal(text));
    CHECK_FALSE(ph::to_decimal(text));
  }
  CHECK_FALSE(ph::is_decimal(std::string_view("1\0", 2)));
}

TEST_CASE("both ways to read a decimal number agree to the last bit", "[decimal]") {
  constexpr unsigned seed = 20260202;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  int tiny = 0;
  for (int run = 0; run < 100000; ++run) {
    auto bits = random();
    if (run % 10 == 0) bits &= 0x800FFFFFFFFFFFFFU;  // denormal
    const auto x = std::bit_cast<double>(bits);
    if (!std::isfinite(x)) continue;
    tiny += std::fpclassify(x) == FP_SUBNORMAL ? 1 : 0;
    check_both(printed(x, "%.*g", 17), x);
    if (run % 50 == 0) check_both(printed(x, "%.*f", 1100), x);  // all its digits
  }
  CHECK(tiny > 9000);
}

TEST_CASE("a number too large to read is infinite, one too small is zero", "[decimal]") {
  const double largest = std::numeric_limits<double>::max();
  const double least = std::numeric_limits<double>::denorm_min();
  check_both("1e400", infinity);
  check_both("-1e400", -infinity);
  check_both("+1e99999999999999999999", infinity);
  check_both("1" + std::string(400, '0'), infinity);
  check_both("1.7976931348623157e308", largest);
  check_both("1.7976931348623158e308", largest);
  check_both("1.7976931348623159e308", infinity);
  check_both("-1.7976931348623159e308", -infinity);
  check_both("4.9e-324", least);
  check_both("-2.5e-324", -least);
  check_both("2.4e-324", 0.0);
  check_both("-2.4e-324", -0.0);
  check_both("1e-400", 0.0);
  check_both("-1e-400", -0.0);
  check_both("0e99999999999", 0.0);
  check_both("0." + std::string(400, '0') + "1e401", 1.0);
}

TEST_CASE("to_decimal keeps its point in a locale that writes a comma", "[decimal]") {
  const std::locale before = std::locale::global(std::locale(std::locale(), new comma));
  std::istringstream control("1,5");
  double x = 0.0;
  control >> x;
  const auto point = ph::to_decimal("1234.5");
  const double stream = ph::detail::decimal_by_stream("1234.5");
  const auto no_comma = ph::to_decimal("1,5");
  std::locale::global(before);
  CHECK(x == 1.5);  // the control: streams do follow it
  CHECK(point == 1234.5);
  CHECK(stream == 1234.5);
  CHECK_FALSE(no_comma);
}

namespace {

/// A number that no from_chars reads.
struct own_number {
  double value = 0.0;
  own_number(double v) : value(v) {}  // NOLINT(google-explicit-constructor)
};
static_assert(!ph::detail::read_by_charconv<own_number>);

}  // namespace

TEST_CASE("a number of one's own is read by a stream, and from text that is none not at all",
          "[decimal]") {
  CHECK(ph::to_decimal<own_number>("-1.25e2")->value == -125.0);
  CHECK_FALSE(ph::to_decimal<own_number>("1.25x"));
  CHECK_FALSE(ph::to_decimal("1.25x"));
}
