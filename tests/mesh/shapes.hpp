// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The meshes that bench/contacts tries as well, for tests.
#include "../../bench/common/meshes.hpp"
#include "support/catch.hpp"
