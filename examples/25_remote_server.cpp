// SPDX-License-Identifier: BSD-3-Clause
// An environment on a machine of its own: a floor that heaves, told to whoever asks. Ctrl-C ends it.
//     25_remote_server [ADDRESS:PORT] [--once]    127.0.0.1:47600; 0.0.0.0:47600 serves other machines; with
//                                                 --once it ends when its client has fallen silent

#include <passive_haptics/remote.hpp>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>

namespace ph = passive_haptics;
namespace remote = ph::remote;
using scene = ph::space<double, 3>;

std::atomic<bool> stop = false;

remote::nanoseconds now() {
  return std::chrono::steady_clock::now().time_since_epoch();
}

int main(int argc, char** argv) {
  const auto here = remote::endpoint::of(argc > 1 ? argv[1] : "127.0.0.1:47600");
  remote::udp_socket line;
  if (const auto done = line.open(here); !done) {
    return std::fprintf(stderr, "%s\n", describe(done, here).c_str()), 1;
  }
  std::puts(line.here().text().c_str());  // for whoever starts a client
  std::fflush(stdout);
  std::signal(SIGINT, [](int) { stop = true; });

  remote::server server;
  remote::endpoint client;
  auto solved = now();
  while (!stop) {
    (void)line.wait(std::chrono::milliseconds(5));
    (void)line.for_each_received([&](auto bytes, const auto& from) {
      const auto heard = server.receive(bytes, from, now());
      if (heard.reply) (void)line.send(*heard.reply, from);
      if (heard.asked) client = from;
    });
    if (argc > 2 && server.sessions() > 0 && !server.has_client(now())) break;
    if (now() < solved) continue;
    const auto* question = server.take();
    if (question == nullptr) continue;
    solved = now() + std::chrono::milliseconds(15);  // a solver takes its time
    const double height = 2e-3 * std::sin(7.0 * std::chrono::duration<double>(now()).count());
    const ph::half_space<scene> floor{{0, 0, height}, {0, 0, 1}, 800};
    const auto sent = line.send(server.answer(remote::content_of(floor), *question), client);
    if (!sent) std::fprintf(stderr, "%s\n", describe(sent, client).c_str());
  }
}
