// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Includes Catch2 in either version: v3 has several headers, v2 (Debian 12) has one. Tests use only what both
// have: matchers, TEMPLATE_TEST_CASE and GENERATE.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
namespace Catch::Matchers {
using ::Catch::WithinAbs;
using ::Catch::WithinRel;
using ::Catch::WithinULP;
}  // namespace Catch::Matchers
#endif
