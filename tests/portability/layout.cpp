// SPDX-License-Identifier: BSD-3-Clause
// A part that holds nothing takes no room, under Microsoft's ABI either. No header of the standard
// library, so that it compiles for targets without one.
#include <passive_haptics/base/no_unique_address.hpp>

struct nothing {};

struct with_macro {
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS nothing n;
  float f;
};
static_assert(sizeof(with_macro) == sizeof(float));

// The control: without the attribute, or with the one that this ABI ignores, it would.
struct without {
#ifdef _MSC_VER
  [[no_unique_address]]
#endif
  nothing n;
  float f;
};
static_assert(sizeof(without) == 2 * sizeof(float));
