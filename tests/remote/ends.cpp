// SPDX-License-Identifier: BSD-3-Clause
// A client and a server, datagram by datagram.
#include "remote/messages.hpp"
#include "support/catch.hpp"

#include <deque>
#include <random>
#include <set>

using namespace remote_test;
using remote::verdict;

namespace {

std::uint64_t other_each_time() {
  static std::uint64_t last = 100;
  return ++last;
}

constexpr remote::sender away{{5, 6, 7}, home.port};  // another client's place

/// A client and a server with nothing in between.
struct pair_of_ends {
  remote::client client{{.silence = 1.0, .most_age = 0.2}, 77};
  remote::server server{{.silence = 1.0}, other_each_time};

  /// The server hears it; its reply, if there is one, comes back.
  remote::server::heard carry(const remote::datagram& bytes, remote::nanoseconds now) {
    const auto heard = server.receive(bytes, home, now);
    if (heard.reply) (void)client.receive(*heard.reply, now);
    return heard;
  }
  void greet(remote::nanoseconds now) {
    carry(client.ask({}, now), now);
    REQUIRE(client.where() == remote::client::state::talking);
  }
  /// What the server says to a question asked now.
  remote::datagram answer(remote::nanoseconds now, double stiffness = 500.0) {
    carry(client.ask({}, now), now);
    const auto* asked = server.take();
    REQUIRE(asked != nullptr);
    return server.answer(remote::content_of(plane(stiffness)), *asked);
  }
  static ph::half_space<d3> plane(double stiffness) {
    auto p = floor_at_1mm;
    p.stiffness = stiffness;
    return p;
  }
  [[nodiscard]] double kept() const {
    return client.latest() == nullptr ? 0.0 : client.latest()->content.numbers[6];
  }
};

/// The same bytes with a part of the message changed, as whoever can read the traffic would.
template <class Change>
remote::datagram changed(const remote::datagram& bytes, Change change) {
  auto m = remote::decode(bytes).value;
  change(m);
  return remote::encode(m);
}

}  // namespace

TEST_CASE("a hello, a welcome, a question, an answer", "[remote]") {
  pair_of_ends ends;
  CHECK(ends.client.where() == remote::client::state::greeting);
  CHECK(ends.client.latest() == nullptr);
  ends.greet(ms(5));
  CHECK_FALSE(ends.server.has_client(ms(5)));  // not before it asks
  const remote::probe where{.position = {0.1, 0.2, 0.3}, .force = {1, 2, 3}, .energy = 0.5};
  const auto heard = ends.carry(ends.client.ask(where, ms(10)), ms(12));
  CHECK(heard.asked);
  CHECK_FALSE(heard.reply);
  CHECK(ends.server.has_client(ms(12)));
  const auto* asked = ends.server.take();
  REQUIRE(asked != nullptr);
  CHECK(remote::content_of(asked->probe) == remote::content_of(where));
  CHECK(asked->stamp == ms(10));
  CHECK(ends.server.take() == nullptr);  // once
  const auto first = ends.server.answer(remote::content_of(ball), *asked);
  CHECK(ends.client.receive(first, ms(30)) == verdict::accepted);
  const auto* news = ends.client.take();
  REQUIRE(news != nullptr);
  CHECK(news->content == remote::content_of(ball));
  CHECK(news->age(ms(30)) == Approx(0.020));  // by the client's clock alone
  CHECK(news->sequence == 1);
  CHECK(ends.client.take() == nullptr);  // once
  CHECK(ends.client.latest() != nullptr);
  const auto back = remote::quadric_of<d3>(news->content);
  CHECK(remote::content_of(back) == remote::content_of(ball));
}

TEST_CASE("only what is newer is taken, also where the count wraps round", "[remote]") {
  for (const std::uint32_t base : {1U, 0xFFFFFFF0U}) {
    pair_of_ends ends;
    ends.greet(ms(0));
    const auto any = ends.answer(ms(1));
    const auto numbered = [&](std::uint32_t n) {
      return changed(any, [&](auto& m) { m.sequence = base + n; });
    };
    CHECK(ends.client.receive(numbered(5), ms(2)) == verdict::accepted);
    CHECK(ends.client.receive(numbered(5), ms(2)) == verdict::repeated);
    CHECK(ends.client.receive(numbered(4), ms(2)) == verdict::overtaken);
    for (std::uint32_t n = 6; n < 40; ++n) {
      CHECK(ends.client.receive(numbered(n), ms(2)) == verdict::accepted);
      CHECK(ends.client.receive(numbered(n - 1), ms(2)) == verdict::overtaken);
    }
    CHECK(ends.client.counted().of(verdict::accepted) == 1 + 35);
    CHECK(ends.client.counted().refused() == 1 + 35);

    const auto question = ends.client.ask({}, ms(3));
    const auto as = [&](std::uint32_t n) {
      return changed(question, [&](auto& m) { m.sequence = base + 100 + n; });
    };
    CHECK(ends.server.receive(as(2), home, ms(3)).asked);
    CHECK(ends.server.receive(as(2), home, ms(3)).what == verdict::repeated);
    CHECK(ends.server.receive(as(1), home, ms(3)).what == verdict::overtaken);
    CHECK(ends.server.receive(as(30), home, ms(3)).asked);
    CHECK(ends.server.receive(as(29), home, ms(3)).what == verdict::overtaken);
  }
}

TEST_CASE("without the key and the session nothing is accepted, and the last good answer stays",
          "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(0));
  REQUIRE(ends.client.receive(ends.answer(ms(1), 500.0), ms(2)) == verdict::accepted);
  const auto next = ends.answer(ms(10), 600.0);
  const auto refused = [&](auto change, verdict why) {
    CHECK(ends.client.receive(changed(next, change), ms(12)) == why);
    CHECK(ends.kept() == 500.0);
    CHECK(ends.client.where() == remote::client::state::talking);
  };
  for (int bit = 0; bit < 64; ++bit) {
    refused([bit](auto& m) { m.key ^= std::uint64_t(1) << bit; }, verdict::stranger);
    refused([bit](auto& m) { m.session ^= std::uint64_t(1) << bit; }, verdict::stranger);
    refused([bit](auto& m) { m.kind = remote::kind::lost, m.session ^= std::uint64_t(1) << bit; },
            verdict::stranger);
  }
  refused([](auto& m) { m.key = 0; }, verdict::stranger);
  refused([](auto& m) { m.session = 0; }, verdict::stranger);
  refused([](auto& m) { m.kind = remote::kind::question; }, verdict::misdirected);
  refused([](auto& m) { m.kind = remote::kind::hello; }, verdict::misdirected);
  refused([](auto& m) { m.kind = remote::kind::welcome; }, verdict::repeated);
  refused([](auto& m) { m.kind = remote::kind::busy; }, verdict::repeated);
  CHECK(ends.client.counted().refused() == 3 * 64 + 6);
  CHECK(ends.client.receive(next, ms(12)) == verdict::accepted);  // the control
  CHECK(ends.kept() == 600.0);

  // The server's end.
  const auto question = ends.client.ask({}, ms(20));
  for (int bit = 0; bit < 64; ++bit) {
    for (const bool key : {true, false}) {
      const auto heard = ends.server.receive(
          changed(question, [=](auto& m) { (key ? m.key : m.session) ^= std::uint64_t(1) << bit; }),
          home, ms(20));
      CHECK(heard.what == verdict::stranger);
      CHECK_FALSE(heard.asked);
      REQUIRE(heard.reply);  // lost, for a client of a server that was restarted
      CHECK(ends.client.receive(*heard.reply, ms(20)) == verdict::stranger);
    }
  }
  CHECK(ends.server.take() == nullptr);
  CHECK(ends.server.receive(question, home, ms(20)).asked);
}

TEST_CASE("a surface that no local model takes is refused, and the last good one stays",
          "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(0));
  REQUIRE(ends.client.receive(ends.answer(ms(1), 500.0), ms(2)) == verdict::accepted);
  const auto sent = [&](auto shape) {
    ends.carry(ends.client.ask({}, ms(5)), ms(5));
    return ends.client.receive(ends.server.answer(remote::content_of(shape), *ends.server.take()),
                               ms(6));
  };
  const auto with = [](auto shape, auto change) {
    change(shape);
    return shape;
  };
  for (const double K : {0.0, -1.0, -500.0}) {
    CHECK(sent(with(floor_at_1mm, [K](auto& p) { p.stiffness = K; })) == verdict::unusable);
    CHECK(sent(with(ball, [K](auto& q) { q.stiffness = K; })) == verdict::unusable);
    CHECK(sent(with(ball, [K](auto& q) { q.thickness = K; })) == verdict::unusable);
    CHECK(sent(with(ball, [K](auto& q) { q.reach = K; })) == verdict::unusable);
  }
  for (const double x : {std::nan(""), HUGE_VAL}) {
    CHECK(sent(with(floor_at_1mm, [x](auto& p) { p.point = {x, 0, 0}; })) == verdict::not_finite);
    CHECK(sent(with(floor_at_1mm, [x](auto& p) { p.stiffness = x; })) == verdict::not_finite);
    CHECK(sent(with(ball, [x](auto& q) { q.curvature = x; })) == verdict::not_finite);
  }
  CHECK(sent(with(floor_at_1mm, [](auto& p) { p.normal = {0, 0, 0}; })) == verdict::unusable);
  CHECK(sent(with(ball, [](auto& q) { q.tangent = q.normal; })) == verdict::unusable);
  CHECK(sent(with(ball, [](auto& q) { q.curvature = 201.0; })) == verdict::unusable);  // it folds
  CHECK(ends.kept() == 500.0);
  CHECK(sent(ball) == verdict::accepted);
  CHECK(sent(floor_at_1mm) == verdict::accepted);
}

TEST_CASE("an answer says how old it is by the client's clock, and cannot lie about it",
          "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(1000));
  const auto first = ends.answer(ms(1010), 1.0);
  const auto second = ends.answer(ms(1020), 2.0);
  const auto third = ends.answer(ms(1030), 3.0);
  const auto stamped = [](const remote::datagram& bytes, remote::nanoseconds t) {
    return changed(bytes, [t](auto& m) { m.stamp = t; });
  };
  CHECK(ends.client.receive(stamped(first, ms(1031)), ms(1100)) == verdict::untrue_stamp);
  CHECK(ends.client.receive(stamped(first, ms(999)), ms(1100)) == verdict::untrue_stamp);
  CHECK(ends.client.receive(stamped(first, remote::nanoseconds::max()), ms(1100)) ==
        verdict::untrue_stamp);
  CHECK(ends.client.receive(stamped(first, remote::nanoseconds::min()), ms(1100)) ==
        verdict::untrue_stamp);
  CHECK(ends.client.receive(second, ms(1100)) == verdict::accepted);
  CHECK(ends.client.receive(stamped(third, ms(1019)), ms(1100)) == verdict::untrue_stamp);
  CHECK(ends.client.receive(third, ms(1231)) == verdict::too_old);  // 201 ms
  CHECK(ends.kept() == 2.0);
  CHECK(ends.client.receive(third, ms(1230)) == verdict::accepted);  // 200 ms
  CHECK(ends.client.latest()->age(ms(1230)) == Approx(0.2));
}

TEST_CASE("a server that is restarted is greeted anew, and its count begins anew", "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(0));
  for (int n = 1; n < 50; ++n) {
    REQUIRE(ends.client.receive(ends.answer(ms(n), n), ms(n)) == verdict::accepted);
  }
  const auto before = ends.answer(ms(50), 999.0);  // it will be on its way for long
  ends.server = remote::server({}, other_each_time);
  CHECK(ends.carry(ends.client.ask({}, ms(60)), ms(60)).what == verdict::stranger);
  CHECK(ends.client.where() == remote::client::state::greeting);
  CHECK(ends.kept() == 49.0);  // the last good one
  CHECK(ends.client.receive(before, ms(61)) == verdict::stranger);
  ends.greet(ms(70));
  CHECK(ends.client.sessions() == 2);
  CHECK(ends.client.receive(before, ms(71)) == verdict::stranger);
  CHECK(ends.client.receive(ends.answer(ms(80), 80.0), ms(81)) == verdict::accepted);
  CHECK(ends.client.latest()->sequence == 1);
  CHECK(ends.client.latest()->session == 2);
  CHECK(ends.kept() == 80.0);
  // An old session that comes back, by whatever forger, is still older than what is answered.
  CHECK(ends.client.receive(changed(before,
                                    [&](auto& m) {
                                      m.session = remote::decode(ends.answer(ms(82))).value.session;
                                    }),
                            ms(83)) == verdict::untrue_stamp);
}

TEST_CASE("a server whose answers cannot be used is greeted anew after a silence", "[remote]") {
  enum class says { good, unusable, too_old };
  for (const auto what : {says::good, says::unusable, says::too_old}) {
    pair_of_ends ends;
    ends.greet(ms(0));
    bool talked = true;
    for (int n = 1; n <= 1000; ++n) {
      const auto bytes = ends.answer(ms(n), what == says::unusable ? -1.0 : 1.0);
      (void)ends.client.receive(bytes, ms(what == says::too_old ? n + 201 : n));
      talked = talked && ends.client.where() == remote::client::state::talking;
    }
    CHECK(talked);
    (void)ends.client.ask({}, ms(1001));
    CHECK((ends.client.where() == remote::client::state::talking) == (what == says::good));
    CHECK((ends.client.latest() != nullptr) == (what == says::good));
  }
}

TEST_CASE("an old reply neither opens a session nor ends one", "[remote]") {
  using state = remote::client::state;
  pair_of_ends ends;
  const auto hello = ends.client.ask({}, ms(0));
  const auto welcome = *ends.server.receive(hello, home, ms(0)).reply;
  const auto busy = changed(welcome, [](auto& m) { m.kind = remote::kind::busy, m.session = 0; });
  const auto stamped = [](const remote::datagram& bytes, remote::nanoseconds t) {
    return changed(bytes, [t](auto& m) { m.stamp = t; });
  };
  CHECK(ends.client.receive(stamped(welcome, ms(1)), ms(1)) == verdict::untrue_stamp);
  CHECK(ends.client.receive(stamped(busy, ms(-1)), ms(1)) == verdict::untrue_stamp);
  CHECK(ends.client.where() == state::greeting);
  CHECK(ends.client.receive(welcome, ms(1)) == verdict::accepted);
  CHECK(ends.client.receive(welcome, ms(1)) == verdict::repeated);
  CHECK(ends.client.receive(busy, ms(1)) == verdict::repeated);
  CHECK(ends.client.sessions() == 1);
  (void)ends.client.ask({}, ms(1002));  // after a silence
  CHECK(ends.client.where() == state::greeting);
  CHECK(ends.client.receive(welcome, ms(1003)) == verdict::untrue_stamp);
  CHECK(ends.client.receive(busy, ms(1003)) == verdict::untrue_stamp);
  CHECK(ends.client.where() == state::greeting);
  CHECK(ends.client.receive(stamped(busy, ms(1002)), ms(1003)) == verdict::accepted);  // controls
  CHECK(ends.client.where() == state::waiting);
  CHECK(ends.client.receive(stamped(welcome, ms(1002)), ms(1003)) == verdict::accepted);
  CHECK(ends.client.where() == state::talking);
}

TEST_CASE("after a silence both ends begin anew, whoever it was that fell silent", "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(0));
  REQUIRE(ends.client.receive(ends.answer(ms(1), 1.0), ms(1)) == verdict::accepted);
  (void)ends.client.ask({}, ms(1001));
  CHECK(ends.client.where() == remote::client::state::talking);
  (void)ends.client.ask({}, ms(1002));
  CHECK(ends.client.where() == remote::client::state::greeting);
  SECTION("an answer of the same session that comes after all") {
    ends.carry(ends.client.ask({}, ms(1003)), ms(1003));  // welcomed to another
    CHECK(ends.client.sessions() == 2);
    CHECK(ends.client.receive(ends.answer(ms(1004), 2.0), ms(1005)) == verdict::accepted);
  }
  SECTION("a deaf client: a forged number far ahead lasts no longer than a silence") {
    ends.greet(ms(1003));
    const auto next = ends.answer(ms(1004));
    CHECK(ends.client.receive(changed(next, [](auto& m) { m.sequence += 1U << 30; }), ms(1005)) ==
          verdict::accepted);
    CHECK(ends.client.receive(ends.answer(ms(1006)), ms(1007)) == verdict::overtaken);
    ends.greet(ms(2100));
    CHECK(ends.client.receive(ends.answer(ms(2101)), ms(2102)) == verdict::accepted);
  }
}

TEST_CASE("a client whose clock is set begins anew, and old answers are none of the future",
          "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(60'000));
  const auto before = ends.answer(ms(60'010), 500.0);
  const auto late = ends.answer(ms(60'020), 600.0);
  CHECK(ends.client.receive(before, ms(60'030)) == verdict::accepted);
  // Back by less than a silence: the session goes on, and so do its stamps when the clock has caught up.
  (void)ends.client.ask({}, ms(59'500));
  CHECK(ends.client.where() == remote::client::state::talking);
  // Back by more: the server's clock goes on.
  const auto hello = ends.client.ask({}, ms(20'000));
  CHECK(ends.client.where() == remote::client::state::greeting);
  CHECK(ends.client.receive(late, ms(20'001)) == verdict::untrue_stamp);
  const auto heard = ends.server.receive(hello, home, ms(60'040));
  REQUIRE(heard.reply);
  CHECK(ends.client.receive(*heard.reply, ms(20'002)) == verdict::accepted);
  CHECK(ends.client.sessions() == 2);
  CHECK(ends.server.receive(ends.client.ask({}, ms(20'010)), home, ms(60'050)).asked);
  const auto* asked = ends.server.take();
  REQUIRE(asked != nullptr);
  const auto news = ends.server.answer(remote::content_of(pair_of_ends::plane(700.0)), *asked);
  CHECK(ends.client.receive(news, ms(20'020)) == verdict::accepted);
  CHECK(ends.kept() == 700.0);
  CHECK(ends.client.latest()->age(ms(20'020)) == Approx(0.010));
}

TEST_CASE("one client at a time: another waits until the first is silent", "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(0));
  (void)ends.answer(ms(1));
  const auto late = ends.client.ask({}, ms(900));
  remote::client other({}, 78);
  const auto tries = [&](remote::nanoseconds now) {
    const auto heard = ends.server.receive(other.ask({}, now), away, now);
    if (heard.reply) (void)other.receive(*heard.reply, now);
    return heard.what;
  };
  CHECK(tries(ms(10)) == verdict::turned_away);
  CHECK(other.where() == remote::client::state::waiting);
  CHECK(tries(ms(1001)) == verdict::turned_away);
  CHECK(tries(ms(1002)) == verdict::accepted);
  CHECK(other.where() == remote::client::state::talking);
  SECTION("and has it then") {
    CHECK(tries(ms(1003)) == verdict::accepted);
    CHECK(ends.server.sessions() == 2);
    CHECK(ends.carry(ends.client.ask({}, ms(1004)), ms(1004)).what == verdict::turned_away);
  }
  SECTION("unless a question of the first was on its way") {
    CHECK(ends.server.receive(late, home, ms(1003)).asked);
    CHECK(tries(ms(1004)) == verdict::turned_away);
    CHECK(ends.server.sessions() == 1);
  }
  SECTION("unless the first is back before it asks") {
    ends.greet(ms(1003));
    (void)ends.answer(ms(1004));
    CHECK(tries(ms(1005)) == verdict::stranger);  // its offer is over, and it says hello
    CHECK(tries(ms(1006)) == verdict::turned_away);
    CHECK(other.where() == remote::client::state::waiting);
  }
}

TEST_CASE("a hello alone takes nobody's place, however many there are", "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(0));
  (void)ends.answer(ms(1));
  for (std::uint64_t key = 1000; key < 2000; ++key) {  // while the client is silent, too
    const auto hello = remote::encode({.kind = remote::kind::hello, .key = key});
    const auto heard = ends.server.receive(hello, home, ms(key < 1500 ? 2 : 1500));
    CHECK(heard.what == (key < 1500 ? verdict::turned_away : verdict::accepted));
    REQUIRE(heard.reply);
    CHECK(heard.reply->size() == hello.size());  // no amplifier
    CHECK(ends.client.receive(*heard.reply, ms(2)) == verdict::stranger);
  }
  CHECK(ends.carry(ends.client.ask({}, ms(900)), ms(900)).asked);
  CHECK(ends.server.sessions() == 1);
}

TEST_CASE("hellos from addresses that are not their own keep nobody out", "[remote]") {
  // 100 000 strangers a second, and a client that asks every 10 ms and hears of it one round trip later.
  for (const double rtt : {2e-4, 5e-3, 0.1}) {
    INFO("a round trip of " << rtt << " s");
    remote::server server({}, other_each_time);
    remote::client client({}, 12345);
    std::mt19937_64 random(9);
    struct on_its_way {
      double at;
      remote::datagram bytes;
    };
    std::deque<on_its_way> up, down;
    double first = 0.0;
    for (int n = 0; n < 20'000 && first == 0.0; ++n) {
      const double t = 5e-5 * n;
      const remote::nanoseconds now(50'000 * n);
      if (n % 200 == 0) up.push_back({t + rtt / 2, client.ask({}, now)});
      for (int k = 0; k < 5; ++k) {
        remote::sender nobody{.port = static_cast<std::uint16_t>(random())};
        for (auto& byte : nobody.address) byte = static_cast<std::uint8_t>(random());
        const auto hello = remote::encode({.kind = remote::kind::hello, .key = random() | 1});
        (void)server.receive(hello, nobody, now);
      }
      for (; !up.empty() && up.front().at <= t; up.pop_front()) {
        const auto heard = server.receive(up.front().bytes, home, now);
        if (heard.reply) down.push_back({t + rtt / 2, *heard.reply});
        const auto* asked = server.take();
        if (asked == nullptr) continue;
        down.push_back({t + rtt / 2, server.answer(remote::content_of(floor_at_1mm), *asked)});
      }
      for (; !down.empty() && down.front().at <= t; down.pop_front()) {
        (void)client.receive(down.front().bytes, now);
        if (client.take() != nullptr) first = t;
      }
    }
    CHECK(first > 0.0);
    CHECK(first < 2 * rtt + 0.011);
  }
}

TEST_CASE("a session begins where it was offered, in time, and once", "[remote]") {
  remote::server server({}, other_each_time);
  const auto hello = [](std::uint64_t key) {
    return remote::encode({.kind = remote::kind::hello, .key = key, .stamp = ms(5)});
  };
  const auto offer = [&](std::uint64_t key, const remote::sender& to, remote::nanoseconds now) {
    const auto reply = server.receive(hello(key), to, now).reply;
    REQUIRE(reply);
    const auto read = remote::decode(*reply);
    CHECK(read.value.kind == remote::kind::welcome);
    CHECK(read.value.stamp == ms(5));
    CHECK(read.value.session != 0);
    return read.value.session;
  };
  const auto ask = [&](std::uint64_t key, std::uint64_t session, const remote::sender& from,
                       remote::nanoseconds now) {
    return server.receive(remote::encode({.kind = remote::kind::question,
                                          .key = key,
                                          .session = session,
                                          .sequence = 1,
                                          .content = remote::content_of(remote::probe{})}),
                          from, now);
  };
  auto other_port = home;
  ++other_port.port;
  const auto offered = offer(77, home, ms(4000));
  CHECK(offered == offer(77, home, ms(7999)));  // it keeps nothing, so it says the same
  CHECK(std::set<std::uint64_t>{offered, offer(78, home, ms(4000)), offer(77, away, ms(4000)),
                                offer(77, other_port, ms(4000)), offer(77, home, ms(8000)),
                                offer(77, home, ms(3999))}
            .size() == 6);
  SECTION("not elsewhere, and not by another") {
    for (const auto& [key, session, from] : {std::tuple{std::uint64_t(77), offered, away},
                                             {77, offered, other_port},
                                             {78, offered, home},
                                             {77, offered + 1, home},
                                             {77, 0, home},
                                             {77, 1, home}}) {
      const auto heard = ask(key, session, from, ms(4001));
      CHECK(heard.what == verdict::stranger);
      CHECK_FALSE(heard.asked);
    }
    for (int bit = 0; bit < 64; ++bit) {
      CHECK_FALSE(ask(77, offered ^ std::uint64_t(1) << bit, home, ms(4001)).asked);
    }
    CHECK(server.sessions() == 0);
    CHECK_FALSE(server.has_client(ms(4001)));
    CHECK(ask(77, offered, home, ms(4001)).asked);  // the control
  }
  SECTION("in the slot of the offer and in the next") {
    CHECK(ask(77, offered, home, ms(11'999)).asked);
  }
  SECTION("not after it") {
    CHECK(ask(77, offered, home, ms(12'000)).what == verdict::stranger);
  }
  SECTION("not before it") {
    CHECK(ask(77, offered, home, ms(3999)).what == verdict::stranger);
  }
  SECTION("once: what was sent in it begins nothing when another was there") {
    const auto rival = offer(78, away, ms(4000));
    CHECK(ask(77, offered, home, ms(4001)).asked);
    CHECK(ask(78, rival, away, ms(5500)).what == verdict::stranger);  // of before that session
    CHECK(ask(78, offer(78, away, ms(5501)), away, ms(5502)).asked);
    CHECK(ask(77, offered, home, ms(5503)).what == verdict::stranger);
    CHECK(ask(77, offered, home, ms(6600)).what == verdict::stranger);
    CHECK(server.sessions() == 2);
  }
  SECTION("not with a server that was restarted") {
    server = remote::server({}, other_each_time);
    CHECK(ask(77, offered, home, ms(4001)).what == verdict::stranger);
    CHECK(ask(77, offer(77, home, ms(4001)), home, ms(4002)).asked);
  }
}

TEST_CASE("a question that is sent from elsewhere neither moves a session nor ends it",
          "[remote]") {
  pair_of_ends ends;
  ends.greet(ms(0));
  (void)ends.answer(ms(1));
  const auto question = ends.client.ask({}, ms(2));
  const auto heard = ends.server.receive(question, away, ms(2));  // by who has read it
  CHECK(heard.what == verdict::stranger);
  CHECK_FALSE(heard.asked);  // answers do not go there
  CHECK_FALSE(heard.reply);  // a `lost` that could be handed on to the client
  CHECK(ends.server.take() == nullptr);
  CHECK(ends.server.receive(question, home, ms(3)).asked);
  CHECK(ends.server.sessions() == 1);
}

TEST_CASE("two clients that come at once do not keep each other out", "[remote]") {
  // Both ask every 10 ms, 50 ms away, and neither hears that it has to stop saying hello before then.
  remote::server server({}, other_each_time);
  remote::client a({}, 1), b({}, 2);
  std::vector<std::pair<remote::nanoseconds, remote::datagram>> back;
  int asked = 0;
  for (int n = 0; n < 100; ++n) {
    const auto now = ms(10 * n);
    while (!back.empty() && back.front().first <= now) {
      (void)a.receive(back.front().second, now);
      (void)b.receive(back.front().second, now);
      back.erase(back.begin());
    }
    for (remote::client* c : {&a, &b}) {
      const auto heard = server.receive(c->ask({}, now), c == &a ? home : away, now);
      if (heard.reply) back.emplace_back(now + ms(50), *heard.reply);
      asked += heard.asked;
    }
  }
  CHECK(server.sessions() == 1);
  CHECK(asked > 80);
}

TEST_CASE("settings out of their range are named, and accept nothing", "[remote]") {
  CHECK_FALSE(remote::client_settings{}.check());
  CHECK_FALSE(remote::server_settings{}.check());
  for (const double x : {0.0, -1.0, std::nan("")}) {
    const remote::client_settings silence{.silence = x}, age{.most_age = x};
    CHECK(std::string(silence.check().parameter) == "silence");
    CHECK(std::string(age.check().parameter) == "most_age");
    CHECK(std::string(remote::server_settings{.silence = x}.check().parameter) == "silence");
    remote::server good({}, other_each_time), bad({.silence = x}, other_each_time);
    remote::client device(silence, 5);
    const auto hello = device.ask({}, ms(0));
    CHECK(bad.receive(hello, home, ms(0)).what == verdict::stranger);
    CHECK(device.receive(*good.receive(hello, home, ms(0)).reply, ms(0)) == verdict::stranger);
  }
  remote::client nobody({}, 0);
  CHECK(std::string(nobody.check().parameter) == "key");
  const auto half_of_one = [] {  // 0 for one half of the secret
    static std::uint64_t last = 0;
    return last++ % 2;
  };
  static std::uint64_t next = 1;
  for (const auto draw : {+[] { return std::uint64_t(0); }, +[] { return std::uint64_t(5); },
                          +half_of_one, +[] { return next++ % 2; }}) {
    remote::server guessed({}, draw);
    CHECK(std::string(guessed.check().parameter) == "draw");
    CHECK(guessed.receive(remote::client({}, 5).ask({}, ms(0)), home, ms(0)).what ==
          verdict::stranger);
  }
  remote::server good({}, other_each_time);
  CHECK_FALSE(good.check());
  CHECK(good.receive(nobody.ask({}, ms(0)), home, ms(0)).what == verdict::malformed);
  for (const double x : {1e300, HUGE_VAL}) {  // for ever
    pair_of_ends ends;
    ends.client = remote::client({.silence = x, .most_age = x}, 77);
    ends.greet(ms(0));
    CHECK(ends.client.receive(ends.answer(ms(1)), ms(9'000'000'000)) == verdict::accepted);
  }
}

TEST_CASE("numbers are drawn, never zero, never twice", "[remote]") {
  std::set<std::uint64_t> drawn;
  for (int n = 0; n < 1000; ++n) drawn.insert(remote::draw_number());
  CHECK(drawn.size() == 1000);
  CHECK(drawn.count(0) == 0);
  std::uint64_t ones = 0, zeros = 0;
  for (const auto n : drawn) ones |= n, zeros |= ~n;
  CHECK(~ones == 0);  // every bit is drawn
  CHECK(~zeros == 0);
}

TEST_CASE("a surface crosses the network in double and arrives in any scalar", "[remote]") {
  using scene = ph::space<float, 3>;
  const ph::quadric<scene> small{.point = {0.5F, -0.25F, 2},
                                 .normal = {0, 0, 1},
                                 .tangent = {1, 0, 0},
                                 .curvature = 3,
                                 .cross_curvature = -1,
                                 .stiffness = 500,
                                 .thickness = 0.0625F};
  const auto c = remote::content_of(small);  // its reach is the largest float
  CHECK(remote::usable(c));
  auto back = remote::quadric_of<scene>(c);
  CHECK(back.prepare());
  CHECK(remote::content_of(back) == c);
  CHECK(remote::half_space_of<scene>(c).prepare());  // its tangent plane
  auto far_reaching = ball;
  far_reaching.reach = std::numeric_limits<double>::max();
  auto shorter = remote::quadric_of<scene>(remote::content_of(far_reaching));
  CHECK(std::isfinite(shorter.reach));
  CHECK(shorter.prepare());
  for (const auto form : {remote::form::nothing, remote::form::plane, remote::form::probe}) {
    CHECK_FALSE(remote::quadric_of<d3>(content_of_form(form)).prepare());
    CHECK(remote::half_space_of<d3>(content_of_form(form)).prepare() ==
          (form == remote::form::plane));
    CHECK(remote::usable(content_of_form(form)));
  }
  CHECK(remote::content_of(remote::probe_of(content_of_form(remote::form::plane))) ==
        remote::content_of(remote::probe{}));
}
