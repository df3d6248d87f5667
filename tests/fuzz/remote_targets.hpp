// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What must hold for ANY bytes from the network. Returns null, or what broke.
#include "fuzz/reader.hpp"
#include <passive_haptics/remote/client.hpp>
#include <passive_haptics/remote/server.hpp>

#include <algorithm>

namespace fuzz {

namespace remote = passive_haptics::remote;

/// What is decoded is encoded to the same bytes. A client and a server that talk to each other while noise,
/// and datagrams of theirs with some bytes replaced, the checksum right again, come in between, keep
/// only what can be used, and find each other again when it is over.
inline const char* remote_ends(input bytes) noexcept {
  const auto as_bytes = std::as_bytes(bytes);
  for (const std::size_t from : {std::size_t(0), bytes.size() % remote::datagram_size}) {
    const auto some = as_bytes.subspan(std::min(from, bytes.size()));
    const auto found = remote::decode(some.first(std::min(some.size(), remote::datagram_size)));
    if (!found) continue;
    const auto again = remote::encode(found.value);
    if (!std::equal(again.begin(), again.end(), some.begin())) return "decoded as something else";
  }

  reader script(bytes);
  remote::client device({}, script.any<std::uint64_t>() | 1);
  static std::uint64_t sessions = 0;
  sessions = 0;
  remote::server world({}, [] { return ++sessions; });
  const auto plane = remote::content{remote::form::plane, {0, 0, 0, 0, 0, 1, 1000}};
  remote::nanoseconds now{0};
  const auto replaced = [&script](remote::datagram d) {
    for (int n = script.one() % 4; n > 0; --n) {
      d[script.one() % d.size()] = static_cast<std::byte>(script.one());
    }
    remote::detail::put(d, remote::detail::crc_at, remote::detail::checksum(d));
    return d;
  };
  const auto talk = [&](bool disturbed) -> const char* {
    now += std::chrono::milliseconds(disturbed ? script.one() : 10);
    const auto passes = [&](remote::datagram d) { return disturbed ? replaced(d) : d; };
    const auto heard = world.receive(passes(device.ask({}, now)), {}, now);
    if (heard.reply) (void)device.receive(passes(*heard.reply), now);
    if (const auto* asked = world.take()) {
      (void)device.receive(passes(world.answer(plane, *asked)), now);
    }
    const auto* kept = device.latest();
    if (kept != nullptr && !remote::usable(kept->content)) return "keeps what cannot be used";
    if (kept != nullptr && kept->asked > now) return "keeps what was never asked";
    return nullptr;
  };
  for (int n = 0; n < 50 && !script.empty(); ++n) {
    if (const char* broken = talk(true)) return broken;
  }
  // A second of silence ends what a stranger may have begun; then it takes three calls.
  now += std::chrono::seconds(3);
  for (int n = 0; n < 3; ++n) {
    if (const char* broken = talk(false)) return broken;
  }
  const auto* kept = device.latest();
  if (kept == nullptr || kept->asked != now || !(kept->content == plane)) {
    return "the two do not find each other again";
  }
  return nullptr;
}

}  // namespace fuzz
