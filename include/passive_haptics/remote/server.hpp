// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The server of a session, at the environment: it receives the position of the device and answers with a surface. It
// has no socket and no clock: the caller carries the datagrams and passes the time.
//
//     const auto heard = server.receive(bytes, from, now);
//     if (heard.reply) socket.send(*heard.reply, from);         // welcome, lost, busy
//     if (heard.asked) client = from;                           // whom to answer
//     if (const auto* question = server.take())
//       socket.send(server.answer(content_of(plane), *question), client);

#include <passive_haptics/base/no_unique_address.hpp>
#include <passive_haptics/remote/content.hpp>
#include <passive_haptics/remote/seal.hpp>
#include <passive_haptics/remote/session.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace remote {

struct server_settings {
  double silence = 1.0;  ///< time without a question after which another client may come [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(silence > 0.0)) return {"silence", silence, "> 0 s"};
    return {};
  }
};

/// The position of the device, and the stamp and session that an answer has to carry.
struct question {
  remote::probe probe{};
  nanoseconds stamp{0};       ///< of the client's clock; an answer echoes it
  std::uint64_t session = 0;  ///< the random number of the session
};

/// A server has one client at a time; take one server object for each socket. While one client asks, others
/// are told that the server is busy.
///
/// It stores nothing of a hello. The session number that its welcome offers is a cookie, a keyed hash of client key,
/// address and time; a session begins with the first question that returns the cookie from that address, within 4
/// to 8 s. So hellos with forged addresses begin no session and take no memory. Each session ends all other offers,
/// so no number begins a session twice.
template <datagram_seal Seal = no_seal>
class server_with {
 public:
  using datagram = std::array<std::byte, datagram_size + Seal::size>;
  using source = std::uint64_t (*)();

  /// A server whose check() names a fault accepts nothing. `draw` is called twice, for the 128 bits of a secret, which
  /// must be unpredictable and new for each server. Throws only what `draw` throws.
  explicit server_with(const server_settings& settings = {}, source draw = draw_number,
                       const Seal& seal = Seal{})
      : settings_(settings), seal_(seal), secret_{draw(), draw()}, sound_(!check()) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (secret_.low == 0 || secret_.high == 0 || secret_.low == secret_.high) {
      return {"draw", 0.0, "numbers at random: not 0, and others each time"};
    }
    return settings_.check();
  }

  struct heard {
    verdict what = verdict::accepted;
    bool asked = false;               ///< it was a question; send answers to its sender only
    std::optional<datagram> reply{};  ///< to be sent to the sender at once
  };

  /// Judges bytes received from `from`, which may be anything.
  heard receive(received_bytes bytes, const sender& from, nanoseconds now) noexcept {
    const heard found = judged(bytes, from, now);
    tally_.book(found.what);
    return found;
  }

  /// The newest question if one came since the last take(), else null.
  [[nodiscard]] const question* take() noexcept {
    if (!fresh_) return nullptr;
    fresh_ = false;
    return &question_;
  }

  /// The datagram for the client: a surface, with the stamp of the question for which it was computed. Call it for every
  /// new surface, any number of times for a question.
  [[nodiscard]] datagram answer(const content& what, const question& of) noexcept {
    return sealed({.kind = kind::answer,
                   .key = client_.key,
                   .session = client_.session,
                   .sequence = ++number_,
                   .stamp = of.stamp,
                   .content = what});
  }

  /// True if a client has asked within `silence`.
  [[nodiscard]] bool has_client(nanoseconds now) const noexcept {
    return client_.session != 0 && !(now - asked_ > detail::span_of(settings_.silence));
  }
  [[nodiscard]] std::uint32_t sessions() const noexcept { return sessions_; }
  [[nodiscard]] const tally& counted() const noexcept { return tally_; }

 private:
  struct partner {
    std::uint64_t key = 0, session = 0;  // 0: nobody
    sender place{};
  };

  /// A reply to m, of which it echoes key and stamp.
  [[nodiscard]] datagram said(kind what, const message& m, std::uint64_t session) noexcept {
    return sealed({.kind = what, .key = m.key, .session = session, .stamp = m.stamp});
  }
  [[nodiscard]] datagram sealed(const message& m) noexcept {
    return detail::encode_sealed(m, seal_);
  }

  heard judged(received_bytes bytes, const sender& from, nanoseconds now) noexcept {
    const auto found = detail::decode_sealed(bytes, seal_);
    if (!found) return {found.what};
    const message& m = found.value;
    if (m.kind != kind::hello && m.kind != kind::question) return {verdict::misdirected};
    if (!sound_) return {verdict::stranger};
    if (m.key == 0) return {verdict::malformed};
    return m.kind == kind::hello ? greeted(m, from, now) : asked(m, from, now);
  }

  /// True if the key is of another client than the one that asks.
  [[nodiscard]] bool is_rival(std::uint64_t key, nanoseconds now) const noexcept {
    return key != client_.key && has_client(now);
  }

  heard greeted(const message& m, const sender& from, nanoseconds now) noexcept {
    if (is_rival(m.key, now)) return {verdict::turned_away, false, said(kind::busy, m, 0)};
    return {verdict::accepted, false, said(kind::welcome, m, cookie(m.key, from, slot(now)))};
  }

  [[nodiscard]] static constexpr std::int64_t slot(nanoseconds now) noexcept {
    return now / std::chrono::seconds(4);
  }
  /// The session number that is offered to this key at this address in time slot `when` of 4 s.
  [[nodiscard]] std::uint64_t cookie(std::uint64_t key, const sender& to,
                                     std::int64_t when) const noexcept {
    std::array<std::byte, 38> bytes{};
    detail::put(bytes, 0, key);
    detail::put(bytes, 8, static_cast<std::uint64_t>(when));
    for (std::size_t i = 0; i < 16; ++i) bytes[16 + i] = std::byte{to.address[i]};
    detail::put(bytes, 32, to.port);
    detail::put(bytes, 34, sessions_);
    const std::uint64_t hash = siphash(secret_, bytes);
    return hash == 0 ? 1 : hash;  // 0 is no session
  }
  [[nodiscard]] bool was_offered(const message& m, const sender& from,
                                 nanoseconds now) const noexcept {
    return m.session == cookie(m.key, from, slot(now)) ||
           m.session == cookie(m.key, from, slot(now) - 1);
  }

  heard asked(const message& m, const sender& from, nanoseconds now) noexcept {
    if (client_.session == 0 || m.session != client_.session || m.key != client_.key) {
      if (!was_offered(m, from, now)) {
        return {verdict::stranger, false, said(kind::lost, m, m.session)};
      }
      if (is_rival(m.key, now)) return {verdict::turned_away, false, said(kind::busy, m, 0)};
      if (m.content.form != form::probe) return {verdict::malformed};
      client_ = {m.key, m.session, from};
      order_ = {};
      number_ = 0;
      ++sessions_;
    }
    // There is no reply, so that a datagram copied from the client and sent from elsewhere provokes no `lost`.
    if (from != client_.place) return {verdict::stranger};
    if (m.content.form != form::probe) return {verdict::malformed};
    if (const auto order = order_.judge(m.sequence); order != verdict::accepted) return {order};
    order_.passed(m.sequence);
    asked_ = now;
    question_ = {probe_of(m.content), m.stamp, m.session};
    fresh_ = true;
    return {verdict::accepted, true};
  }

  server_settings settings_;
  PASSIVE_HAPTICS_NO_UNIQUE_ADDRESS Seal seal_;
  siphash_key secret_;
  bool sound_;
  partner client_;  // the client that asks
  detail::in_order order_;
  std::uint32_t number_ = 0;    // number of the last answer
  std::uint32_t sessions_ = 0;  // number of sessions begun so far
  nanoseconds asked_{0};        // time of the client's last question, by the server's clock
  question question_;
  bool fresh_ = false;
  tally tally_;
};

/// A server without a seal.
using server = server_with<>;

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics
