// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the frame does not model frame_for
//
// A device of your own under the contacts of a set: its frame says what pulls it to the proxy.

#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/contact_set.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

template <class Space>
struct mine : ph::detail::point_frame<Space> {
#ifndef POSITIVE_CONTROL
  static void coupling() = delete;
#endif
};

ph::detail::contact_engine<scene, mine, ph::proxy_spring, ph::frictionless,
                           ph::slots<ph::half_space<scene>, 1>>
    contacts{{}};
