// SPDX-License-Identifier: BSD-3-Clause
// The part of the Falcon's driver that a microcontroller can use, kinematics and protocol: counts
// in, motor words out, in float. No Eigen, no exceptions, no RTTI, no heap, no double.
#include <passive_haptics/falcon/force.hpp>
#include <passive_haptics/falcon/packet.hpp>

namespace falcon = passive_haptics::falcon;

namespace {
falcon::packet_parser<falcon::from_device> parser;
falcon::point<float> last = falcon::workspace<float>.centre;
}  // namespace

/// Takes a byte of the Falcon; with the last of a packet, writes the packet that answers it with
/// `force` [N] to `out` and returns true.
extern "C" bool falcon_tick(unsigned char b, const float force[3], unsigned char out[16]) {
  const auto reply = parser.push(b);
  if (!reply) return false;
  falcon::to_device answer;
  const auto& n = reply->encoder;
  const auto pose = falcon::forward(falcon::to_angles<float>({n[0], n[1], n[2]}), last);
  if (pose && reply->is_homed()) {
    last = pose.position;
    const falcon::force<float> f{{force[0], force[1], force[2]}};
    answer.motor = falcon::encode(falcon::torques_for(pose.rates, falcon::limited(f, 8.0F)),
                                  falcon::cautious_gain<float>);
  }
  const auto bytes = falcon::encode(answer);
  for (std::size_t i = 0; i < bytes.size(); ++i) out[i] = bytes[i];
  return true;
}
