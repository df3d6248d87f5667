// SPDX-License-Identifier: BSD-3-Clause
// A client and a server whose datagrams are sealed, and somebody who reads all of them.
#include "remote/messages.hpp"
#include "support/catch.hpp"

#include <random>
#include <type_traits>

using namespace remote_test;
using remote::verdict;

namespace {

constexpr remote::siphash_key shared{0x0706050403020100, 0x0F0E0D0C0B0A0908};
constexpr remote::sender away{{5, 6, 7}, home.port};

std::uint64_t other_each_time() {
  static std::uint64_t last = 500;
  return ++last;
}

/// The seal of whoever knows all but the key.
const remote::siphash_seal guessed({shared.low, shared.high ^ 1});

/// One that encrypts, as a library might, and counts what it is given: its state is its owner's.
struct stream {
  static constexpr std::size_t size = 4;
  std::uint32_t sent = 0;
  void seal(std::span<std::byte> bytes) noexcept {
    remote::detail::put(bytes, 152, ++sent);
    turn(bytes);
  }
  bool open(std::span<std::byte> bytes) noexcept {
    turn(bytes);
    return true;
  }
  static void turn(std::span<std::byte> bytes) noexcept {
    for (std::size_t i = 0; i < 152; ++i) bytes[i] ^= bytes[152 + i % 4] ^ std::byte{0x5A};
  }
};
static_assert(remote::datagram_seal<stream>);

template <class Seal>
struct pair_of_ends {
  explicit pair_of_ends(const Seal& with) : seal(with) {}

  Seal seal;
  remote::client_with<Seal> client{{.silence = 1.0, .most_age = 0.2}, 77, seal};
  remote::server_with<Seal> server{{.silence = 1.0}, other_each_time, seal};
  using datagram = typename remote::client_with<Seal>::datagram;
  std::vector<datagram> to_server, to_client;  // all that crossed the network

  void restart_client() {
    client = remote::client_with<Seal>({.most_age = 0.2}, other_each_time(), seal);
  }
  void restart_server() {
    server = remote::server_with<Seal>({.silence = 1.0}, other_each_time, seal);
  }
  auto tell(const datagram& bytes, remote::nanoseconds now) {
    to_client.push_back(bytes);
    return client.receive(bytes, now);
  }
  /// The client asks, and is answered where there is a session.
  void talk(remote::nanoseconds now, double stiffness) {
    to_server.push_back(client.ask({.position = {0, 0, stiffness}}, now));
    const auto heard = server.receive(to_server.back(), home, now);
    if (heard.reply) (void)tell(*heard.reply, now);
    const auto* asked = server.take();
    if (asked == nullptr) return;
    auto plane = floor_at_1mm;
    plane.stiffness = stiffness;
    (void)tell(server.answer(remote::content_of(plane), *asked), now);
  }
  [[nodiscard]] double kept() const {
    return client.latest() == nullptr ? 0.0 : client.latest()->content.numbers[6];
  }
};

/// The same bytes with a part of the message changed, under the seal that the changer has.
template <class Seal, class Datagram, class Change>
auto changed(Seal seal, const Datagram& bytes, Change change) {
  auto m = remote::decode(remote::received_bytes(bytes).first(152)).value;
  change(m);
  return remote::detail::encode_sealed(m, seal);
}

constexpr auto stiffer = [](auto& m) {
  ++m.sequence;
  m.content.numbers[6] = 7777.0;
};

}  // namespace

TEST_CASE("the tag of a sealed datagram is the SipHash of the 152 bytes before it", "[remote]") {
  const auto m = message_of(remote::form::quadric);
  const remote::siphash_seal seal(shared);
  const auto bytes = remote::detail::encode_sealed(m, seal);
  static_assert(bytes.size() == 160);
  const auto plain = remote::encode(m);
  CHECK(std::equal(plain.begin(), plain.end(), bytes.begin()));
  const auto tag = remote::siphash(shared, plain);
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(std::to_integer<std::uint64_t>(bytes[152 + i]) == (tag >> 8 * i & 255));
  }
  CHECK(seal.open(bytes));
  for (const auto& unset : {remote::siphash_key{}, {0, 5}, {5, 0}}) {
    const remote::siphash_seal none(unset);
    auto own = bytes;
    none.seal(own);
    CHECK_FALSE(none.open(own));
  }
  static_assert(std::is_same_v<remote::client::datagram, remote::datagram>);  // without: the same
  static_assert(std::is_same_v<remote::server::datagram, remote::datagram>);
  static_assert(sizeof(remote::client_with<stream>) > sizeof(remote::client));
  static_assert(std::is_empty_v<remote::no_seal>);
}

TEST_CASE("ends with a key of their own find each other", "[remote]") {
  const std::uint64_t low = shared.low, high = shared.high;
  const remote::siphash_seal seal({low, high});                 // of a file that both machines have
  remote::server_with server({}, remote::draw_number, seal);    // at one
  remote::client_with client({}, remote::draw_number(), seal);  // at the other
  const auto welcome = server.receive(client.ask({}, ms(0)), home, ms(0)).reply;
  REQUIRE(welcome);
  CHECK(client.receive(*welcome, ms(1)) == verdict::accepted);
  CHECK(server.receive(client.ask({}, ms(2)), home, ms(2)).asked);
}

TEST_CASE("what is sealed by another, altered or cut off is refused at both ends", "[remote]") {
  pair_of_ends ends{remote::siphash_seal(shared)};
  ends.talk(ms(0), 500.0);
  ends.talk(ms(1), 500.0);
  REQUIRE(ends.kept() == 500.0);
  const auto question = ends.to_server.back();
  const auto answer = ends.to_client.back();
  const auto refused = [&](remote::received_bytes bytes, verdict why) {
    CHECK(ends.client.receive(bytes, ms(2)) == why);
    const auto heard = ends.server.receive(bytes, home, ms(2));
    CHECK(heard.what == why);
    CHECK_FALSE(heard.reply);  // who has not got the key is not even answered
  };
  for (const auto& good : {answer, question}) {
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
      auto bytes = good;
      bytes[bit / 8] ^= std::byte{1} << bit % 8;
      refused(bytes, verdict::forged);
    }
    for (std::size_t n = 0; n < good.size(); ++n) {
      refused(remote::received_bytes(good).first(n), verdict::wrong_length);
    }
    std::array<std::byte, 161> longer{};
    std::copy(good.begin(), good.end(), longer.begin());
    refused(longer, verdict::wrong_length);
    refused(changed(guessed, good, stiffer), verdict::forged);
    refused(changed(remote::no_seal{}, good, stiffer), verdict::wrong_length);
    for (std::uint8_t kind = 1; kind <= 6; ++kind) {
      refused(changed(guessed, good, [kind](auto& m) { m.kind = remote::kind{kind}; }),
              verdict::forged);
    }
  }
  CHECK(ends.kept() == 500.0);
  CHECK(ends.server.take() == nullptr);
  CHECK(ends.server.has_client(ms(2)));
  // The controls: the same by who has the key, and by who reads the traffic where there is no seal.
  CHECK(ends.client.receive(changed(ends.seal, answer, stiffer), ms(2)) == verdict::accepted);
  CHECK(ends.kept() == 7777.0);
  CHECK(ends.server.receive(changed(ends.seal, question, stiffer), home, ms(2)).asked);
  pair_of_ends open{remote::no_seal{}};
  open.talk(ms(0), 500.0);
  open.talk(ms(1), 500.0);
  CHECK(open.client.receive(changed(open.seal, open.to_client.back(), stiffer), ms(2)) ==
        verdict::accepted);
  CHECK(open.kept() == 7777.0);
}

TEST_CASE("what was sealed before is refused when it comes again, from wherever", "[remote]") {
  pair_of_ends ends{remote::siphash_seal(shared)};
  for (int n = 0; n < 20; ++n) ends.talk(ms(n), 500.0 + n);
  const auto repeat = [&](remote::nanoseconds now) {
    const double kept = ends.kept();
    const auto where = ends.client.where();
    const auto sessions = ends.client.sessions(), served = ends.server.sessions();
    // What the server replies goes to whoever repeats, who hands it on to the client.
    for (const auto& from : {home, away}) {
      for (const auto& bytes : std::vector(ends.to_server)) {
        const auto heard = ends.server.receive(bytes, from, now);
        CHECK_FALSE(heard.asked);
        if (heard.reply) CHECK(ends.client.receive(*heard.reply, now) != verdict::accepted);
        CHECK(ends.client.receive(bytes, now) == verdict::misdirected);
      }
    }
    for (const auto& bytes : std::vector(ends.to_client)) {
      CHECK(ends.client.receive(bytes, now) != verdict::accepted);
      CHECK(ends.server.receive(bytes, home, now).what == verdict::misdirected);
    }
    CHECK(ends.kept() == kept);
    CHECK(ends.client.where() == where);
    CHECK(ends.client.sessions() == sessions);
    CHECK(ends.server.sessions() == served);
    CHECK(ends.server.take() == nullptr);
  };
  SECTION("in the session") {
    repeat(ms(20));
  }
  SECTION("when the client has fallen silent") {
    repeat(ms(1500));
  }
  SECTION("after a restart of the server") {
    ends.restart_server();
    ends.talk(ms(30), 0.0);  // lost
    repeat(ms(31));
    ends.talk(ms(32), 0.0);  // hello
    repeat(ms(33));
    ends.talk(ms(34), 600.0);
    repeat(ms(35));
  }
  SECTION("after a restart of the client") {
    ends.restart_client();
    repeat(ms(30));
    ends.talk(ms(1030), 0.0);
    repeat(ms(1031));
    ends.talk(ms(1032), 600.0);
    repeat(ms(1033));
    CHECK(ends.server.sessions() == 2);
  }
  ends.talk(ms(2500), 0.0);  // and they go on
  ends.talk(ms(2501), 1.0);
  ends.talk(ms(2502), 700.0);
  CHECK(ends.kept() == 700.0);
}

TEST_CASE("forged, repeated and reordered datagrams over restarts of both ends", "[remote]") {
  // Each tick, something of what crossed the network comes once more, or changed by who has no key. Stiffness n
  // and position n are of tick n, so an end that takes them twice, or backwards, is seen.
  int told = 0, tried = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    pair_of_ends ends{remote::siphash_seal(shared)};
    double newest_told = 0.0;
    const auto seen = [&] {
      if (const auto* news = ends.client.take()) {
        CHECK(news->content.numbers[6] > newest_told);
        CHECK(news->content.numbers[6] <= 1000.0);
        newest_told = news->content.numbers[6];
        ++told;
      }
    };
    for (int n = 1; n <= 1000; ++n) {
      const auto now = ms(5 * n);
      if (random() % 200 == 0) ends.restart_server();
      if (random() % 200 == 0) ends.restart_client();
      ends.talk(now, n);
      seen();
      for (int k = 0; k < 5; ++k, ++tried) {
        const bool up = random() % 2 == 0;
        const auto& all = up ? ends.to_server : ends.to_client;
        if (all.empty()) continue;
        auto bytes = all[random() % all.size()];
        if (random() % 2 == 0) bytes = changed(guessed, bytes, stiffer);
        if (!up) {
          (void)ends.client.receive(bytes, now);
          seen();
        } else {
          const auto heard = ends.server.receive(bytes, random() % 2 == 0 ? home : away, now);
          CHECK_FALSE(heard.asked);
          if (heard.reply) (void)ends.client.receive(*heard.reply, now);
        }
      }
      CHECK(ends.server.take() == nullptr);  // talk() takes its own, and there is no other
    }
  }
  CHECK(told > 10'000);
  CHECK(tried > 100'000);
}

TEST_CASE("a seal of one's own may encrypt, and have a state", "[remote]") {
  pair_of_ends ends{stream{}};
  for (int n = 0; n < 5; ++n) ends.talk(ms(n), 500.0 + n);
  CHECK(ends.kept() == 504.0);
  CHECK(remote::decode(remote::received_bytes(ends.to_client.back()).first(152)).what ==
        verdict::foreign);
  CHECK(ends.to_client.back().size() == 156);
}
