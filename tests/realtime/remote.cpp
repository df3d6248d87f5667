// SPDX-License-Identifier: BSD-3-Clause
// A floor is felt over real sockets while somebody sends up to 100 000 datagrams a second to both ends, under
// 100 000 addresses (all of 127.0.0.0/8 is this machine, on Linux). Its own program, because it counts every
// call of operator new.
#include "remote/messages.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include <passive_haptics/passive_haptics.hpp>

#include <algorithm>
#include <atomic>
#include <netinet/in.h>
#include <random>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

using namespace remote_test;
using clock_type = std::chrono::steady_clock;
using scene = ph::space<double, 3>;

namespace {

constexpr double true_stiffness = 800.0, true_mark = 0.25;  // whatever has others is forged
constexpr double rate = 1e5;  // [1/s], as far as the machine sends so many

remote::nanoseconds now() {
  return clock_type::now().time_since_epoch();
}
double since(clock_type::time_point then) {
  return std::chrono::duration<double>(clock_type::now() - then).count();
}

/// Sends under any address of this machine, as one who forges his own.
class liar {
 public:
  liar() : file_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in any{};
    any.sin_family = AF_INET;
    open_ = file_ >= 0 && ::bind(file_, reinterpret_cast<sockaddr*>(&any), sizeof any) == 0;
  }
  ~liar() { ::close(file_); }
  liar(const liar&) = delete;
  liar& operator=(const liar&) = delete;

  bool send(remote::received_bytes bytes, std::uint16_t port, std::uint32_t number) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    iovec part{const_cast<std::byte*>(bytes.data()), bytes.size()};
    alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(sizeof(in_pktinfo))> room{};
    msghdr whole{};
    whole.msg_name = &to;
    whole.msg_namelen = sizeof to;
    whole.msg_iov = &part;
    whole.msg_iovlen = 1;
    whole.msg_control = room.data();
    whole.msg_controllen = room.size();
    cmsghdr* const head = CMSG_FIRSTHDR(&whole);
    head->cmsg_level = IPPROTO_IP;
    head->cmsg_type = IP_PKTINFO;
    head->cmsg_len = CMSG_LEN(sizeof(in_pktinfo));
    in_pktinfo from{};
    from.ipi_spec_dst.s_addr = htonl(0x7F010000U + number % 100'000);
    std::copy_n(reinterpret_cast<const std::byte*>(&from), sizeof from,
                reinterpret_cast<std::byte*>(CMSG_DATA(head)));
    return open_ && ::sendmsg(file_, &whole, MSG_DONTWAIT) >= 0;
  }

 private:
  int file_;
  bool open_ = false;
};

/// Calls send() about so often until it is over; returns how often it sent [1/s].
template <class Send>
double flood(const std::atomic<bool>& over, Send send) {
  const auto begin = clock_type::now();
  double sent = 0.0;
  while (!over) {
    const double due = since(begin) * rate - sent;
    if (due < 1.0) std::this_thread::sleep_for(std::chrono::microseconds(100));
    for (int n = 0; n < std::min(due, 200.0); ++n) sent += send() ? 1.0 : 0.0;
  }
  return sent / since(begin);
}

/// The environment's thread: a floor at rest, told every question.
template <class Seal>
struct environment {
  explicit environment(const Seal& with, double silence = 1.0)
      : server({.silence = silence}, remote::draw_number, with) {
    REQUIRE(line.open(remote::endpoint::of("127.0.0.1", 0)));
  }

  void serve(const std::atomic<bool>& over) {
    const long before = allocations();
    const ph::half_space<scene> floor{{0, 0, 0}, {0, 0, 1}, true_stiffness};
    while (!over) {
      (void)line.wait(std::chrono::milliseconds(5));
      (void)line.for_each_received([&](auto bytes, const auto& from) {
        const auto heard = server.receive(bytes, from, now());
        if (heard.reply) (void)line.send(*heard.reply, from);
        const auto* asked = server.take();
        if (asked == nullptr) return;
        forged += asked->probe.position[0] != true_mark;
        const auto bytes_of_answer = server.answer(remote::content_of(floor), *asked);
        read.publish(bytes_of_answer);
        (void)line.send(bytes_of_answer, from);
      });
    }
    allocated = allocations() - before;
  }

  remote::udp_socket line;
  remote::server_with<Seal> server;
  ph::exchange<typename remote::server_with<Seal>::datagram> read;  // what an attacker reads
  int forged = 0;
  long allocated = 0;
};

struct outcome {
  double sent = 0.0;           ///< by the attacker [1/s]
  std::uint64_t received = 0;  ///< datagrams that both ends took from the system
  int told = 0, forged = 0;    ///< surfaces; surfaces and questions that nobody of the two sent
  double force = 0.0;          ///< the greatest that was felt [N]
  double felt = 0.0;           ///< part of the ticks on the floor with more than 1 N
  long allocated = 0;
};

/// A hand comes down to −5 mm within a second. `forge` makes what the attacker sends, from what he has read.
template <class Seal, class Forge>
outcome touched(double seconds, const Seal& seal, Forge forge) {
  std::atomic<bool> over = false;
  environment<Seal> world(seal);
  remote::udp_socket line;
  REQUIRE(line.open(remote::endpoint::of("127.0.0.1", 0)));
  const auto there = world.line.here();
  const std::uint16_t ports[] = {there.port(), line.here().port()};
  ph::exchange<ph::half_space<scene>> to_loop;
  ph::exchange<remote::probe> from_loop;
  ph::exchange<typename remote::client_with<Seal>::datagram> read;
  remote::client_with<Seal> client({}, remote::draw_number(), seal);
  outcome found;

  std::thread serving([&] { world.serve(over); });
  std::thread network([&] {
    const long before = allocations();
    remote::probe probe{.position = {true_mark, 0, 1}};
    for (auto due = now(); !over; (void)line.wait(std::chrono::milliseconds(1))) {
      if (const auto* newest = from_loop.take()) probe = *newest;
      if (now() >= due) {
        due = now() + std::chrono::milliseconds(10);
        const auto question = client.ask(probe, now());
        read.publish(question);
        (void)line.send(question, there);
      }
      (void)line.for_each_received([&](auto b, const auto&) { (void)client.receive(b, now()); });
      const auto* news = client.take();
      if (news == nullptr) continue;
      ++found.told;
      found.forged += news->content.numbers[6] != true_stiffness;
      to_loop.publish(remote::half_space_of<scene>(news->content));
    }
    found.allocated = allocations() - before;
  });
  std::thread attacker([&] {
    const liar line_of_attack;
    std::mt19937_64 random(1);
    typename remote::client_with<Seal>::datagram up{}, down{}, forged{};
    bool to_server = false;
    found.sent = flood(over, [&, n = 0]() mutable {
      if (n++ % 4 ==
          0) {  // each is sent under four addresses: to make one takes longer than to send it
        if (const auto* newest = read.take()) up = *newest;
        if (const auto* newest = world.read.take()) down = *newest;
        to_server = random() % 2 == 0;
        forged = forge(to_server, to_server ? up : down, random);
      }
      return line_of_attack.send(forged, ports[to_server ? 0 : 1],
                                 static_cast<std::uint32_t>(random()));
    });
  });

  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.5, .force_limit = 9.0, .longest_tick = 0.002}, {.force = 5.0});
  CHECK_FALSE(touch.set(ph::freshness{.stale_after = 0.3}));
  const auto begin = clock_type::now();
  int pressed = 0, felt = 0;
  for (auto last = begin; since(begin) < seconds + 1.0;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (const auto* newest = to_loop.take()) touch.update(*newest);
    const auto before = std::exchange(last, clock_type::now());
    const scene::vector x(true_mark, 0, std::max(5e-3 - 1e-2 * since(begin), -5e-3));
    const auto out = touch.tick(x, last - before);
    from_loop.publish({.position = x, .force = out.force});
    found.force = std::max(found.force, out.force(2));
    if (x(2) > -4e-3) continue;
    ++pressed;
    felt += out.force(2) > 1.0;
  }
  over = true;
  for (auto* thread : {&serving, &network, &attacker}) thread->join();
  found.felt = double(felt) / std::max(pressed, 1);
  found.forged += world.forged;
  found.allocated += world.allocated;
  found.received = client.counted().refused() + client.counted().of(remote::verdict::accepted) +
                   world.server.counted().refused() +
                   world.server.counted().of(remote::verdict::accepted);
  return found;
}

std::string text(const outcome& o) {
  return std::to_string(o.sent) + " datagrams/s sent, " + std::to_string(o.received) +
         " received, told " + std::to_string(o.told) + ", forged " + std::to_string(o.forged) +
         ", at most " + std::to_string(o.force) + " N, more than 1 N in " + std::to_string(o.felt) +
         " of the ticks, allocations " + std::to_string(o.allocated);
}

/// Of who cannot read: any kind, and any numbers where he has to guess.
template <class Datagram>
Datagram blindly(bool to_server, const Datagram&, std::mt19937_64& random) {
  const auto kinds = to_server ? std::array{1, 1, 3} : std::array{2, 4, 5};
  return remote::encode(
      {.kind = static_cast<remote::kind>(kinds[random() % 3]),
       .key = random() | 1,
       .session = random(),
       .sequence = static_cast<std::uint32_t>(random()),
       .stamp = now(),
       .content = to_server
                      ? remote::content_of(remote::probe{.position = {0.5, 0, 0}})
                      : remote::content_of(ph::half_space<scene>{{0, 0, 0.1}, {0, 0, 1}, 7777.0})});
}

constexpr remote::siphash_key shared{0x0706050403020100, 0x0F0E0D0C0B0A0908};

/// Of who reads all, and seals with any key: what was sent, again, or more of it.
template <class Seal>
auto reading(Seal any_key) {
  return [any_key](bool to_server, auto bytes, std::mt19937_64& random) mutable {
    if (random() % 4 == 0) return bytes;  // again
    auto m = remote::decode(remote::received_bytes(bytes).first(152)).value;
    ++m.sequence;
    if (to_server) m.content = remote::content_of(remote::probe{.position = {0.5, 0, 0}});
    if (m.content.form == remote::form::plane) m.content.numbers[6] = 7777.0;
    return remote::detail::encode_sealed(m, any_key);
  };
}

void holds(double seconds, bool tells) {
  const auto check = [tells](const char* who, const outcome& found) {
    if (tells) WARN(who << ": " << text(found));
    INFO(who << ": " << text(found));
    CHECK(found.forged == 0);
    CHECK(found.allocated == 0);
    CHECK(found.told > 20);
    CHECK(found.force > 1.0);
    CHECK(found.force < 9.0 + 1e-9);
    CHECK(found.felt > 0.5);
    CHECK(found.received > 1000);  // or nothing was tried
  };
  check("blind", touched(seconds, remote::no_seal{}, blindly<remote::datagram>));
  check("reading, sealed", touched(seconds, remote::siphash_seal(shared),
                                   reading(remote::siphash_seal({shared.low, 5}))));
}

/// How long a client waits for its first answer, at worst of `clients` that come one after the other [s].
double longest_wait(int clients, double& sent) {
  std::atomic<bool> over = false;
  environment<remote::no_seal> world({}, 0.05);
  const auto there = world.line.here();
  std::thread serving([&] { world.serve(over); });
  std::thread attacker([&] {
    const liar line_of_attack;
    std::mt19937_64 random(2);
    sent = flood(over, [&] {
      const auto hello = remote::encode({.kind = remote::kind::hello, .key = random() | 1});
      return line_of_attack.send(hello, there.port(), static_cast<std::uint32_t>(random()));
    });
  });
  double worst = 0.0;
  for (int n = 0; n < clients; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // the last one has fallen silent
    remote::udp_socket line;
    REQUIRE(line.open(remote::endpoint::of("127.0.0.1", 0)));
    remote::client client;
    const auto begin = clock_type::now();
    while (client.latest() == nullptr && since(begin) < 5.0) {
      (void)line.send(client.ask({.position = {true_mark, 0, 0}}, now()), there);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      (void)line.for_each_received([&](auto b, const auto&) { (void)client.receive(b, now()); });
    }
    worst = std::max(worst, since(begin));
  }
  over = true;
  serving.join();
  attacker.join();
  return worst;
}

}  // namespace

TEST_CASE("the floor is felt through a flood of forged datagrams", "[remote]") {
  holds(1.0, false);
}

TEST_CASE("the floor is felt through a flood of forged datagrams, for 5 s", "[.][long]") {
  holds(5.0, true);
}

TEST_CASE("without a seal who reads the traffic is believed", "[remote]") {  // the control
  const auto found = touched(1.0, remote::no_seal{}, reading(remote::no_seal{}));
  INFO(text(found));
  CHECK(found.forged > 0);
}

TEST_CASE("a new client has its session within a second in a flood of hellos", "[remote]") {
  double sent = 0.0;
  const double worst = longest_wait(5, sent);
  INFO("sent " << sent << " hellos/s, waited " << worst << " s");
  CHECK(worst < 1.0);
  CHECK(sent > 1000.0);
}

TEST_CASE("a new client has its session within a second in a flood of hellos, 50 of them",
          "[.][long]") {
  double sent = 0.0;
  const double worst = longest_wait(50, sent);
  WARN("sent " << sent << " hellos/s, waited " << worst << " s at worst");
  CHECK(worst < 1.0);
}
