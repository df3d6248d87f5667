// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: exchange carries trivially copyable values only
//
// Eigen's vectors have a copy constructor of their own: they stay in their thread.

#include <passive_haptics/base/exchange.hpp>
#include <passive_haptics/device/eigen_space.hpp>

namespace ph = passive_haptics;

using room = ph::space<float, 3>;

#ifdef POSITIVE_CONTROL
ph::exchange<room::coordinates> positions;
#else
ph::exchange<room::vector> positions;
#endif
