// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/falcon/in_memory_transport.hpp>

#include <array>
#include <vector>

namespace falcon = passive_haptics::falcon;

static_assert(falcon::transport<falcon::in_memory_transport<scripted_falcon>>);
static_assert(!falcon::transport<scripted_falcon>);  // the box itself, without a line to it

TEST_CASE("status bytes are taken out of every 64-byte packet, not of every transfer",
          "[falcon][ftdi]") {
  for (std::size_t length = 0; length <= 400; ++length) {
    std::vector<falcon::byte> transfer(length), wanted;
    for (std::size_t i = 0; i < length; ++i) {
      transfer[i] = static_cast<falcon::byte>(i % 64 < 2 ? 0xF0 + i % 64 : i % 199);
      if (i % 64 >= 2) wanted.push_back(transfer[i]);
    }
    falcon::ftdi::line_status lines{};
    const std::size_t kept = falcon::ftdi::strip_status(transfer, lines);
    transfer.resize(kept);
    if (transfer != wanted) FAIL(length);
    if (length % 64 != 1) CHECK(lines.modem == (length >= 2 ? 0xF0 : 0));
  }
}

TEST_CASE("what the simulated chip packs, the transport unpacks", "[falcon][ftdi]") {
  falcon::ftdi::sender chip;
  std::vector<falcon::byte> sent, got;
  for (int i = 0; i < 1000; ++i) {
    sent.push_back(static_cast<falcon::byte>(i * 7));
    chip.push(sent.back());
  }
  std::array<falcon::byte, 192> transfer{};
  for (int i = 0; i < 100; ++i) {
    chip.elapse(std::chrono::milliseconds(16));
    falcon::ftdi::line_status lines{};
    const std::size_t n = chip.transmit(transfer);
    const std::size_t kept = falcon::ftdi::strip_status(std::span(transfer).first(n), lines);
    got.insert(got.end(), transfer.begin(), transfer.begin() + static_cast<std::ptrdiff_t>(kept));
  }
  CHECK(got == sent);
}
