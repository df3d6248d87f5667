// SPDX-License-Identifier: BSD-3-Clause
// What every core test includes, compiled once.
#include "catch.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <random>
#include <vector>
