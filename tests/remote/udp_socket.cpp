// SPDX-License-Identifier: BSD-3-Clause
// Over real sockets of this machine. Every port is the system's choice, and every wait has an end.
#include "remote/messages.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#if defined(__unix__) || defined(__APPLE__)

using namespace remote_test;
using clock_type = std::chrono::steady_clock;

namespace {

remote::nanoseconds now() {
  return clock_type::now().time_since_epoch();
}

/// A socket at any port of that address, or none where there is no such address: a container may have no
/// IPv6.
remote::udp_socket socket_at(const char* address) {
  remote::udp_socket line;
  const auto here = remote::endpoint::of(address, 0);
  const auto done = line.open(here);
  if (!done) {
    WARN(describe(done, here));
    CHECK((done.error == EADDRNOTAVAIL || done.error == EAFNOSUPPORT));
    CHECK(std::string(address) != "127.0.0.1");
  }
  return line;
}

/// What comes within 5 s, of those that `wanted` likes.
template <class Wanted>
bool comes(remote::udp_socket& line, Wanted wanted) {
  bool found = false;
  for (const auto end = clock_type::now() + std::chrono::seconds(5);
       !found && clock_type::now() < end;) {
    REQUIRE(line.wait(std::chrono::milliseconds(50)));
    REQUIRE(line.for_each_received([&](remote::received_bytes bytes, const remote::endpoint& from) {
      found = found || wanted(bytes, from);
    }));
  }
  return found;
}

}  // namespace

TEST_CASE("a surface crosses real sockets, also after the server was restarted", "[remote]") {
  for (const char* address : {"127.0.0.1", "::1"}) {
    auto device = socket_at(address), world = socket_at(address);
    if (!device.is_open() || !world.is_open()) continue;
    const auto there = world.here();
    REQUIRE(there.port() != 0);
    remote::client client;
    auto server = std::make_unique<remote::server>();
    const auto touched = [&](double stiffness) {
      const auto before = client.latest() == nullptr ? 0 : client.latest()->session;
      for (const auto end = clock_type::now() + std::chrono::seconds(10);
           clock_type::now() < end;) {
        REQUIRE(device.send(client.ask({.position = {0, 0, 1e-3}}, now()), there));
        REQUIRE(world.wait(std::chrono::milliseconds(20)));
        REQUIRE(world.for_each_received([&](auto bytes, const auto& from) {
          const auto heard = server->receive(bytes, from, now());
          if (heard.reply) REQUIRE(world.send(*heard.reply, from));
          const auto* asked = server->take();
          if (asked == nullptr) return;
          CHECK(asked->probe.position[2] == 1e-3);
          auto plane = floor_at_1mm;
          plane.stiffness = stiffness;
          REQUIRE(world.send(server->answer(remote::content_of(plane), *asked), from));
        }));
        REQUIRE(device.wait(std::chrono::milliseconds(20)));
        REQUIRE(device.for_each_received(
            [&](auto bytes, const auto&) { (void)client.receive(bytes, now()); }));
        const auto* news = client.take();
        if (news != nullptr && news->session != before) return news->content.numbers[6];
      }
      return 0.0;
    };
    CHECK(touched(500.0) == 500.0);
    server = std::make_unique<remote::server>();
    CHECK(touched(600.0) == 600.0);
    CHECK(client.sessions() == 2);
    CHECK(client.latest()->age(now()) < 10.0);
  }
}

TEST_CASE("a datagram of any length arrives as what it is", "[remote]") {
  auto from = socket_at("127.0.0.1"), to = socket_at("127.0.0.1");
  std::array<std::byte, 1000> bytes{};
  const auto whole = remote::encode(message_of(remote::form::plane));
  std::copy(whole.begin(), whole.end(), bytes.begin());
  for (const std::size_t n : std::array<std::size_t, 9>{0, 1, 151, 152, 153, 216, 217, 218, 1000}) {
    INFO(n << " bytes");
    REQUIRE(from.send(remote::received_bytes(bytes).first(n), to.here()));
    CHECK(comes(to, [&](auto got, const auto& sender) {
      CHECK(sender.text() == from.here().text());
      CHECK((remote::decode(got).what == remote::verdict::accepted) == (n == 152));
      return got.size() == std::min<std::size_t>(n, 217);
    }));
  }
  REQUIRE(to.for_each_received([](auto, const auto&) { FAIL("more than was sent"); }));
}

TEST_CASE("a flood does not keep the thread", "[remote]") {
  auto from = socket_at("127.0.0.1"), to = socket_at("127.0.0.1");
  for (int n = 0; n < 2000; ++n) REQUIRE(from.send({}, to.here()));
  REQUIRE(to.wait(std::chrono::seconds(5)));
  int most = 0;
  REQUIRE(to.for_each_received([&](auto, const auto&) { ++most; }));
  CHECK(most <= 256);
  CHECK(most > 0);
}

TEST_CASE("what the system refuses is said with address, reason and remedy", "[remote]") {
  const auto holds = [](const std::string& text, std::initializer_list<const char*> parts) {
    INFO(text);
    for (const char* part : parts) CHECK(text.find(part) != std::string::npos);
  };
  auto first = socket_at("127.0.0.1");
  const auto taken = first.here();
  remote::udp_socket second;
  const auto used = second.open(taken);
  CHECK_FALSE(used);
  CHECK_FALSE(second.is_open());
  holds(describe(used, taken), {"open at 127.0.0.1:", "in use", "take another"});

  const auto elsewhere = remote::endpoint::of("192.0.2.1", 0);  // of nobody, by RFC 5737
  holds(describe(second.open(elsewhere), elsewhere), {"192.0.2.1:0", "no address of this machine"});

  const auto everybody = remote::endpoint::of("255.255.255.255", 9);
  auto out = socket_at("0.0.0.0");
  const auto refused = out.send({}, everybody);
  CHECK_FALSE(refused);  // not allowed, or no network at all
  holds(describe(refused, everybody), {"send to 255.255.255.255:9", ": "});
  CHECK(*remedy(refused) != '\0');

  const auto six = remote::endpoint::of("::1", 9);
  holds(describe(first.send({}, six), six), {"send to [::1]:9", "of the same kind"});

  for (const char* text : {"localhost", "", "1.2.3", "1.2.3.4.5", "::1::", "1.2.3.4 "}) {
    const auto none = remote::endpoint::of(text, 9);
    CHECK_FALSE(none);
    holds(describe(first.send({}, none), none), {"no address", "in numbers"});
    holds(describe(second.open(none), none), {"no address", "in numbers"});
  }
  for (const auto& [failed, sentence] :
       {std::pair{remote::udp_result{remote::udp_result::call::send, ENETUNREACH},
                  "send to 127.0.0.1:"},
        {{remote::udp_result::call::receive, ENETDOWN}, "cable"},
        {{remote::udp_result::call::wait, EBADF}, "open() it first"},
        {{remote::udp_result::call::open, ENOTSUP}, "no POSIX sockets"},
        {{remote::udp_result::call::open, ENOSPC}, "(28)"}}) {
    CHECK_FALSE(failed);
    holds(describe(failed, taken), {sentence});
  }
  CHECK(describe({}, taken) == "ok");
}

TEST_CASE("an endpoint is read from what it is written as, and from nothing else", "[remote]") {
  for (const char* text : {"127.0.0.1:0", "192.168.1.20:47600", "0.0.0.0:65535", "[::1]:1",
                           "[::]:47600", "[fd00::20]:80"}) {
    INFO(text);
    const auto read = remote::endpoint::of(text);
    CHECK(read);
    CHECK(read.text() == text);
    CHECK(read.from_here().port() == 0);
    CHECK(read.from_here().text()[0] == (text[0] == '[' ? '[' : '0'));
  }
  for (const char* text :
       {"", ":", "127.0.0.1", "127.0.0.1:", ":47600", "127.0.0.1:65536", "127.0.0.1:-1",
        "127.0.0.1: 80", "127.0.0.1:80 ", "127.0.0.1:8x", "::1:80", "[::1]", "[::1]80", "[]:80",
        "[127.0.0.1]80", "localhost:80", "256.0.0.1:80", "[::g]:80"}) {
    INFO(text);
    CHECK_FALSE(remote::endpoint::of(text));
    CHECK_FALSE(remote::endpoint::of(text).from_here());
    CHECK(remote::endpoint::of(text).text() == "no address");
  }
  CHECK_FALSE(remote::endpoint::of(std::string(200, '1') + ":80"));
}

TEST_CASE("a socket that was never opened, or was moved away, says so", "[remote]") {
  remote::udp_socket line;
  const auto there = remote::endpoint::of("127.0.0.1", 9);
  CHECK(line.send({}, there).error == EBADF);
  CHECK(line.wait(std::chrono::milliseconds(1)).error == EBADF);
  CHECK(line.for_each_received([](auto, const auto&) {}).error == EBADF);
  CHECK_FALSE(line.here());
  auto open = socket_at("127.0.0.1");
  const auto port = open.here().port();
  remote::udp_socket moved = std::move(open);
  CHECK_FALSE(open.is_open());  // NOLINT(bugprone-use-after-move): that is what is asked
  CHECK(moved.here().port() == port);
  REQUIRE(moved.open(remote::endpoint::of("127.0.0.1", port)));  // closed first
  line = std::move(moved);
  CHECK(line.here().port() == port);
  line.close();
  CHECK_FALSE(line.is_open());
}

#endif
