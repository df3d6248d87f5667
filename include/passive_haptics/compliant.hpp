// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <passive_haptics/compliant/modelled_reach.hpp>
#include <passive_haptics/compliant/observed_reach.hpp>
#include <passive_haptics/compliant/late_force.hpp>
