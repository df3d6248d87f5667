// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scenes by hand for C++, which can have them for both scalars at once.

#include <math.h>     // NOLINT(modernize-deprecated-headers): the text is C's as well
#include <stdbool.h>  // NOLINT(modernize-deprecated-headers)
#include <stdint.h>   // NOLINT(modernize-deprecated-headers)
#include <string.h>   // NOLINT(modernize-deprecated-headers)

namespace by_hand {
namespace in_float {
#include "in_float.h"
}
namespace in_double {
#include "in_double.h"
}
}  // namespace by_hand
