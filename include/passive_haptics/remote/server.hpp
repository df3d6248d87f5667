// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The environment's end of a session: it hears where the device is and tells what the device touches. It knows
// no socket; bytes go in and out, and the clock is yours.
//
//     const auto heard = server.receive(bytes, now);
//     if (heard.reply) socket.send(*heard.reply, from);         // welcome, lost, busy
//     if (heard.asked) client = from;                           // whom to answer
//     if (const auto* question = server.take())
//       socket.send(server.answer(content_of(plane), *question), client);

#include <passive_haptics/remote/content.hpp>
#include <passive_haptics/remote/session.hpp>

#include <algorithm>

namespace passive_haptics {
inline namespace v0 {
namespace remote {

struct server_settings {
  double silence = 1.0;  ///< after so long without a question another client may come [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(silence > 0.0)) return {"silence", silence, "> 0 s"};
    return {};
  }
};

/// Where the device was, and what an answer needs to name this question.
struct question {
  remote::probe probe{};
  nanoseconds stamp{0};       ///< of the client's clock; an answer echoes it
  std::uint64_t session = 0;  ///< the random number of the session
};

/// A server has one client at a time; take one server object for each socket. A hello does not replace the
/// client: a session begins with the first question that carries its number, so whoever says hello under a
/// false address gets no further. While one client asks, others are told that the server is busy.
class server {
 public:
  using source = std::uint64_t (*)();

  /// A server whose check() names a fault accepts nothing. `draw` gives the numbers of sessions, which must
  /// differ from those of any server that ran before, and from 0.
  explicit server(const server_settings& settings = {}, source draw = draw_number) noexcept
      : settings_(settings), draw_(draw), sound_(!settings.check()) {}

  [[nodiscard]] constexpr parameter_fault check() const noexcept { return settings_.check(); }

  struct heard {
    verdict what = verdict::accepted;
    bool asked = false;               ///< it was a question: send answers to its sender
    std::optional<datagram> reply{};  ///< to be sent to the sender at once
  };

  /// Takes any bytes that have come, and says what became of them. Throws only what `draw` throws.
  heard receive(received_bytes bytes, nanoseconds now) {
    const heard found = judged(bytes, now);
    tally_.book(found.what);
    return found;
  }

  /// The newest question if one came since the last take(), else null.
  [[nodiscard]] const question* take() noexcept {
    if (!fresh_) return nullptr;
    fresh_ = false;
    return &question_;
  }

  /// What to send to the client: what there is to be touched, and for which question that was computed.
  /// Call it as often as there is news, any number of times for a question.
  [[nodiscard]] datagram answer(const content& what, const question& of) noexcept {
    return encode({.kind = kind::answer,
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
  };

  /// A reply to m, of which it echoes key and stamp.
  [[nodiscard]] static datagram said(kind what, const message& m, std::uint64_t session) noexcept {
    return encode({.kind = what, .key = m.key, .session = session, .stamp = m.stamp});
  }

  heard judged(received_bytes bytes, nanoseconds now) {
    const auto found = decode(bytes);
    if (!found) return {found.what};
    const message& m = found.value;
    if (m.kind != kind::hello && m.kind != kind::question) return {verdict::misdirected};
    if (!sound_) return {verdict::stranger};
    if (m.key == 0) return {verdict::malformed};
    return m.kind == kind::hello ? greeted(m, now) : asked(m, now);
  }

  /// True if the key is of another client than the one that asks.
  [[nodiscard]] bool is_rival(std::uint64_t key, nanoseconds now) const noexcept {
    return key != client_.key && has_client(now);
  }

  heard greeted(const message& m, nanoseconds now) {
    if (is_rival(m.key, now)) return {verdict::turned_away, false, said(kind::busy, m, 0)};
    const partner& guest = invited(m.key);
    return {verdict::accepted, false, said(kind::welcome, m, guest.session)};
  }

  /// A guest with the session that it was offered before, or with a new one in place of the oldest offer.
  const partner& invited(std::uint64_t key) {
    for (const partner& p : guests_) {
      if (p.key == key) return p;
    }
    partner& newest = guests_[invitations_++ % guests_.size()];
    newest = {key, draw_()};
    return newest;
  }

  heard asked(const message& m, nanoseconds now) noexcept {
    const auto is = [&m](const partner& p) {
      return p.session != 0 && m.session == p.session && m.key == p.key;
    };
    if (const auto guest = std::find_if(guests_.begin(), guests_.end(), is);
        guest != guests_.end()) {
      if (is_rival(m.key, now)) return {verdict::turned_away, false, said(kind::busy, m, 0)};
      if (m.content.form != form::probe) return {verdict::malformed};
      client_ = *guest;
      *guest = {};
      order_ = {};
      number_ = 0;
      ++sessions_;
    }
    if (!is(client_)) return {verdict::stranger, false, said(kind::lost, m, m.session)};
    if (m.content.form != form::probe) return {verdict::malformed};
    if (const auto order = order_.judge(m.sequence); order != verdict::accepted) return {order};
    order_.passed(m.sequence);
    asked_ = now;
    question_ = {probe_of(m.content), m.stamp, m.session};
    fresh_ = true;
    return {verdict::accepted, true};
  }

  server_settings settings_;
  source draw_;
  bool sound_;
  partner client_;                   // the client that asks
  std::array<partner, 8> guests_{};  // those who were welcomed and have not asked yet
  std::uint32_t invitations_ = 0;    // number of sessions offered so far
  detail::in_order order_;
  std::uint32_t number_ = 0;    // number of the last answer
  std::uint32_t sessions_ = 0;  // number of sessions begun so far
  nanoseconds asked_{0};        // time of the client's last question, by the server's clock
  question question_;
  bool fresh_ = false;
  tally tally_;
};

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics
