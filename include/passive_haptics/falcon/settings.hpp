// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The settings of a Falcon, the readings of its exchanges, and the test of its replies.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/falcon/force.hpp>
#include <passive_haptics/falcon/packet_link.hpp>

#include <optional>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// closed ─open()─▶ open ─boot()─▶ booting ─▶ unhomed ◀──▶ homed       any of the last two ─▶ fault
/// Forces are zero in every state but `homed`.
enum class state : byte {
  closed,   ///< nothing is connected
  open,     ///< the cable is ours; boot() comes next
  booting,  ///< loading the program
  unhomed,  ///< packets flow; the legs are not homed, or for less than `settle` replies
  homed,    ///< there are positions and forces
  fault,    ///< packets flow if they can, forces are zero until recover(): see reading::what
};

[[nodiscard]] constexpr const char* to_string(state s) noexcept {
  constexpr std::array names{"closed", "open", "booting", "unhomed", "homed", "fault"};
  const auto i = static_cast<std::size_t>(s);
  return i < names.size() ? names[i] : "unknown state";
}

template <real S>
struct settings {
  S force_limit = S(8);    ///< largest ‖F‖ [N]; CHAI3D's figure for this device
  S ramp = S(0.5);         ///< time from no force to all of it, after homing and misses [s]
  S tick = S(1e-3);        ///< nominal time between replies [s]; the ramp climbs no faster
  int largest_step = 300;  ///< counts per tick; more (about 10 m/s) is a fault of an encoder
  int settle = 50;         ///< good replies between homing, or a jump, and the first force
  int most_misses = 20;    ///< misses in a row that are a fault
  /// The longest wait for an answer, while the last words are held. State a loop_limits::longest_tick of at
  /// least this, or a lost answer may cost energy.
  nanoseconds reply = std::chrono::milliseconds(5);
  point<S> origin{};  ///< subtracted from positions [m], in the frame of falcon/kinematics.hpp

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    const auto refused = [](const char* parameter, auto value, const char* remedy) {
      return parameter_fault{parameter, static_cast<double>(value), remedy};
    };
    const auto positive = [](S x) { return x > S(0) && kernels::is_finite(x); };
    if (!positive(force_limit)) return refused("force_limit", force_limit, "finite and > 0 N");
    if (!positive(ramp)) return refused("ramp", ramp, "finite and > 0 s");
    if (!positive(tick)) return refused("tick", tick, "finite and > 0 s");
    if (largest_step < 1) return refused("largest_step", largest_step, "≥ 1 count");
    if (settle < 1) return refused("settle", settle, "≥ 1 reply");
    if (most_misses < 1) return refused("most_misses", most_misses, "≥ 1");
    if (reply <= nanoseconds(0)) return refused("reply", reply.count(), "> 0 ns");
    for (const S x : origin.value) {
      if (!kernels::is_finite(x)) return refused("origin", x, "finite");
    }
    return {};
  }
};

/// All results of an exchange. It is trivially copyable, for logs and other threads.
template <real S>
struct reading {
  code what = code::not_open;  ///< ok, or the reason why there is no position or force
  state where = state::closed;
  to_device sent{};
  from_device received{};  ///< the last reply
  point<S> position{};     ///< position of the last usable reply, origin subtracted [m]
  force<S> commanded{};    ///< [N]
  force<S> held{};         ///< force held until this reply [N]
  S strength{};            ///< factor of the ramp, 0 … 1
  nanoseconds asked{};     ///< when the question was sent; dt is the time between two of these
  nanoseconds stamp{};     ///< when the reply had arrived
  link_counts counts{};
  ftdi::line_status lines{};
};

/// Judges whether a reply is valid. Packets have no checksum, and homing moves the origin of the counts in one step,
/// perhaps some replies after the homed bits. So after a jump, or a leg that is not homed, the first
/// valid reply is the `settle`-th good one in a row.
template <real S>
class reply_guard {
 public:
  /// ok, encoder_jump, not_homed or settling, for the reply that came at `stamp`.
  [[nodiscard]] constexpr code judge(const from_device& reply, nanoseconds stamp,
                                     const settings<S>& setup) noexcept {
    const bool jumped = heard_ && farther(reply.encoder, most(stamp - *heard_, setup));
    heard_ = stamp;
    encoder_ = reply.encoder;
    if (jumped || !reply.is_homed()) {
      settled_ = 0;
      return jumped ? code::encoder_jump : code::not_homed;
    }
    if (settled_ < setup.settle) ++settled_;
    return settled_ < setup.settle ? code::settling : code::ok;
  }

 private:
  /// The largest motion of a leg in that time [counts]; for less than a tick that of a tick.
  [[nodiscard]] static constexpr S most(nanoseconds passed, const settings<S>& setup) noexcept {
    const S ticks = std::chrono::duration<S>(passed).count() / setup.tick;
    return kernels::larger(S(1), ticks) * S(setup.largest_step);
  }
  [[nodiscard]] constexpr bool farther(const leg_words& encoder, S allowed) const noexcept {
    for (std::size_t i = 0; i < encoder.size(); ++i) {
      if (kernels::magnitude(S(encoder[i]) - S(encoder_[i])) > allowed) return true;
    }
    return false;
  }

  leg_words encoder_{};               ///< counts of the last reply
  std::optional<nanoseconds> heard_;  ///< when the last reply came
  int settled_ = 0;                   ///< good replies in a row
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
