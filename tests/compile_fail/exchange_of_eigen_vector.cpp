// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: exchange carries trivially copyable values only
//
// Eigen's vectors have a copy constructor of their own: they stay in their thread.

#include <passive_haptics/eigen_space.hpp>
#include <passive_haptics/exchange.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 3>;

#ifdef POSITIVE_CONTROL
ph::exchange<scene::coordinates> positions;
#else
ph::exchange<scene::vector> positions;
#endif
