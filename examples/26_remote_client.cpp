// SPDX-License-Identifier: BSD-3-Clause
// The device's machine: a thread asks an environment that is elsewhere, the haptic loop keeps the local model
// and never waits. Start 25_remote_server first.
//     26_remote_client [ADDRESS:PORT]    127.0.0.1:47600; - reads it from the standard input

#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/remote.hpp>

#include <iostream>
#include <thread>
namespace ph = passive_haptics;
namespace remote = ph::remote;
using scene = ph::space<double, 3>;
ph::exchange<ph::half_space<scene>> to_loop;
ph::exchange<remote::probe> from_loop;
std::atomic<bool> over = false;

remote::nanoseconds now() {
  return std::chrono::steady_clock::now().time_since_epoch();
}

/// Asks about a hundred times a second; what the system refuses is said once, and tried again.
void ask(remote::udp_socket& line, const remote::endpoint& there) {
  remote::client client;
  bool said = false;
  auto due = now();
  for (remote::probe probe; !over; (void)line.wait(std::chrono::milliseconds(5))) {
    if (const auto* newest = from_loop.take()) probe = *newest;
    if (now() >= due) {  // whatever else arrives, and however often that wakes this thread
      due = now() + std::chrono::milliseconds(10);
      const auto sent = line.send(client.ask(probe, now()), there);
      if (!sent && !std::exchange(said, true)) std::cout << describe(sent, there) << std::endl;
    }
    (void)line.for_each_received([&](auto b, const auto&) { (void)client.receive(b, now()); });
    const auto* news = client.take();
    if (news != nullptr) to_loop.publish(remote::half_space_of<scene>(news->content));
  }
}

int main(int argc, char** argv) {
  std::string place = argc > 1 ? argv[1] : "127.0.0.1:47600";
  if (place == "-") std::cin >> place;
  const auto there = remote::endpoint::of(place), here = there.from_here();
  remote::udp_socket line;
  if (const auto done = line.open(here); !done) return std::cout << describe(done, here) << '\n', 1;

  auto touch = ph::make_touch<scene>(
      {.mass = 0.1, .damping = 0.5, .force_limit = 9.0, .longest_tick = 0.002}, {.force = 5.0});
  (void)touch.set(ph::freshness{.stale_after = 0.3});
  std::thread network([&] { ask(line, there); });
  auto last = now();
  double most = 0;
  for (int n = 0; n < 1000; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // until the next tick is due
    if (const auto* newest = to_loop.take()) touch.update(*newest);
    const auto before = std::exchange(last, now());
    const scene::vector x(0, 0, 5e-3 - 1e-5 * n);  // a hand that comes down to −5 mm
    const auto out = touch.tick(x, last - before);
    from_loop.publish({.position = x, .force = out.force});
    most = std::max(most, out.force(2));
  }
  over = true, network.join();
  std::cout << (most > 1 ? "the floor was felt\n" : "no floor was felt: is a server there?\n");
}
