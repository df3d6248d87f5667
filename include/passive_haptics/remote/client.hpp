// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The client of a session, at the device: it sends the position and keeps the last valid answer, a surface. It has
// no socket and no clock: the caller carries the datagrams and passes the time.
//
//     environment thread                                          haptic thread, 1 kHz
//       socket.send(client.ask(probe, now), server)               if (const auto* plane = inbox.take())
//       client.receive(bytes, now)                                  touch.update(*plane);
//       if (const auto* news = client.take())
//         inbox.publish(half_space_of<scene>(news->content));
//
// Nothing that is received is credited to a ledger: the ledger of the local model books the force that was
// held over the motion that was measured. The network determines the wanted force only.
//
// The time should be of a clock that is never set, as std::chrono::steady_clock. If it goes back by more than
// `silence`, the client begins anew, because the answers to its former questions would seem to be of the future.

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/remote/content.hpp>
#include <passive_haptics/remote/seal.hpp>
#include <passive_haptics/remote/session.hpp>

#include <algorithm>

namespace passive_haptics {
inline namespace v0 {
namespace remote {

struct client_settings {
  double silence = 1.0;   ///< time without an answer after which the client says hello again [s]
  double most_age = 0.5;  ///< largest age of a question whose answer is accepted [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(silence > 0.0)) return {"silence", silence, "> 0 s; longer than a round trip"};
    if (!(most_age > 0.0)) return {"most_age", most_age, "> 0 s; longer than a round trip"};
    return {};
  }
};

/// An answer and its greatest age: it was made after the question that it echoes, and both times are of the
/// client's clock, so the two clocks need not agree.
struct news {
  remote::content content{};
  nanoseconds asked{0};        ///< when its question was asked, by the client's clock
  std::uint32_t sequence = 0;  ///< the server's number of the answer
  std::uint32_t session = 0;   ///< 1, 2, 3 …, the client's number of the session

  /// The answer is no older than this [s].
  [[nodiscard]] constexpr double age(nanoseconds now) const noexcept {
    return std::chrono::duration<double>(now - asked).count();
  }
};

/// The client accepts an answer that has its key, is of its session, is newer than the last one, echoes a
/// stamp that was sent and is no older than the last that was answered, is young enough and can be used.
/// Everything else is only counted by its verdict, and does not keep the session up: if no answer is usable, the
/// client says hello again after `silence`.
///
/// The stale rule is that of the local model (port/freshness.hpp) and begins anew with every update, so a
/// surface fades at the latest when its question is `most_age` + `stale_after` old.
template <datagram_seal Seal = no_seal>
class client_with {
 public:
  using datagram = std::array<std::byte, datagram_size + Seal::size>;

  enum class state : std::uint8_t {
    greeting,  ///< no session, or none that answers: the client says hello
    talking,   ///< in a session
    waiting,   ///< greeting, while the server says that it has another client
  };

  /// A client whose check() names a fault sends hello and accepts nothing. `key` is 64 bits that nobody can
  /// guess and that no client had before; 0 is none.
  explicit client_with(const client_settings& settings = {}, std::uint64_t key = draw_number(),
                       const Seal& seal = Seal{}) noexcept
      : settings_(settings), seal_(seal), key_(key), sound_(!check()) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (key_ == 0) return {"key", 0.0, "not 0: what draw_number() gives"};
    return settings_.check();
  }

  /// The datagram to send now: a question, or a hello as long as there is no session. Call it at the rate of the
  /// answers that you want, 50 to 200 Hz.
  [[nodiscard]] datagram ask(const probe& where, nanoseconds now) noexcept {
    if (state_ == state::talking && now - heard_ > detail::span_of(settings_.silence)) {
      greet_anew();
    }
    if (asked_ != never && asked_ - now > detail::span_of(settings_.silence)) {
      greet_anew();  // because the clock was set back
      asked_ = never;
    }
    if (asked_ == never) oldest_ = now;
    asked_ = (std::max)(asked_, now);
    message m{.kind = kind::hello, .key = key_, .stamp = now};
    if (state_ == state::talking) {
      m.kind = kind::question;
      m.session = session_;
      m.sequence = ++number_;
      m.content = content_of(where);
    } else {
      greeted_ = (std::min)(greeted_, now);
    }
    return detail::encode_sealed(m, seal_);
  }

  /// Judges received bytes, which may be anything, and returns the verdict.
  verdict receive(received_bytes bytes, nanoseconds now) noexcept {
    return tally_.book(judged(bytes, now));
  }

  /// The newest answer if one came since the last take(), else null.
  [[nodiscard]] const news* take() noexcept {
    if (!fresh_) return nullptr;
    fresh_ = false;
    return &news_;
  }
  /// The last good answer, or null before the first. It stays, whatever happens to the session.
  [[nodiscard]] const news* latest() const noexcept {
    return news_.session != 0 ? &news_ : nullptr;
  }

  [[nodiscard]] state where() const noexcept { return state_; }
  /// The number of sessions so far: 2 after one restart of the server.
  [[nodiscard]] std::uint32_t sessions() const noexcept { return sessions_; }
  [[nodiscard]] const tally& counted() const noexcept { return tally_; }

 private:
  verdict judged(received_bytes bytes, nanoseconds now) noexcept {
    const auto found = detail::decode_sealed(bytes, seal_);
    if (!found) return found.what;
    const message& m = found.value;
    if (m.kind == kind::hello || m.kind == kind::question) return verdict::misdirected;
    if (m.key != key_ || !sound_ || asked_ == never) return verdict::stranger;
    if (m.kind == kind::welcome) return welcomed(m, now);
    if (m.kind == kind::busy) {
      if (const auto fits = judged_reply(m); fits != verdict::accepted) return fits;
      state_ = state::waiting;
      return verdict::accepted;
    }
    if (session_ == 0 || m.session != session_) return verdict::stranger;
    if (m.kind == kind::lost) {
      greet_anew();
      session_ = 0;
      return verdict::accepted;
    }
    return answered(m, now);
  }

  void greet_anew() noexcept {
    state_ = state::greeting;
    greeted_ = (nanoseconds::max)();
  }

  /// A welcome or a busy is accepted only as the reply to a hello that this client has sent and that is unanswered.
  [[nodiscard]] verdict judged_reply(const message& m) const noexcept {
    if (state_ == state::talking) return verdict::repeated;
    const bool is_true = m.stamp >= greeted_ && m.stamp <= asked_;
    return is_true ? verdict::accepted : verdict::untrue_stamp;
  }

  /// A welcome to the same session continues its sequence numbers, so its earlier datagrams stay old.
  verdict welcomed(const message& m, nanoseconds now) noexcept {
    if (m.session == 0) return verdict::malformed;
    if (const auto fits = judged_reply(m); fits != verdict::accepted) return fits;
    if (m.session != session_) {
      session_ = m.session;
      order_ = {};
      number_ = 0;
      ++sessions_;
    }
    heard_ = now;
    state_ = state::talking;
    return verdict::accepted;
  }

  verdict answered(const message& m, nanoseconds now) noexcept {
    if (const auto order = order_.judge(m.sequence); order != verdict::accepted) return order;
    if (m.stamp > asked_ || m.stamp < oldest_) return verdict::untrue_stamp;
    if (now - m.stamp > detail::span_of(settings_.most_age)) return verdict::too_old;
    if (!usable(m.content)) return verdict::unusable;
    heard_ = now;
    state_ = state::talking;
    order_.passed(m.sequence);
    oldest_ = m.stamp;
    news_ = news{m.content, m.stamp, m.sequence, sessions_};
    fresh_ = true;
    return verdict::accepted;
  }

  static constexpr nanoseconds never = (nanoseconds::min)();

  client_settings settings_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS Seal seal_;
  std::uint64_t key_, session_ = 0;  // 0: none
  bool sound_;
  state state_ = state::greeting;
  std::uint32_t number_ = 0;    // number of the last question
  std::uint32_t sessions_ = 0;  // number of sessions so far
  detail::in_order order_;
  nanoseconds heard_{0};       // when the welcome came, or the last answer that was accepted
  nanoseconds asked_ = never;  // the newest stamp that was sent
  nanoseconds greeted_ = (nanoseconds::max)();  // the stamp of the first hello since it talked last
  nanoseconds oldest_{0};                       // the oldest stamp that an answer may still echo
  news news_{};
  bool fresh_ = false;
  tally tally_;
};

/// A client without a seal.
using client = client_with<>;

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics
