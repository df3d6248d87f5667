// SPDX-License-Identifier: BSD-3-Clause
// The headers that every core test includes, to be compiled once.
#include "catch.hpp"
#include <passive_haptics/laws.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <random>
#include <vector>
