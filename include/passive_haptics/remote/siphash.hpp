// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// SipHash-2-4: a hash of 64 bits under a key of 128 bits, which without the key cannot be distinguished from random
// bits. J.-P. Aumasson and D. J. Bernstein, "SipHash: a fast short-input PRF", INDOCRYPT 2012,
// LNCS 7668, 489-508. It needs 64-bit integers only: no sockets, no heap, no floating point.

#include <passive_haptics/remote/wire.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace remote {

/// The 16 bytes of a key as two words, the first eight bytes in `low`, each little-endian.
struct siphash_key {
  std::uint64_t low = 0, high = 0;
};

/// SipHash-2-4 of any number of bytes, in a time that depends on their number alone. Little-endian, its eight
/// bytes are those of the published vectors.
[[nodiscard]] constexpr std::uint64_t siphash(const siphash_key& key,
                                              received_bytes bytes) noexcept {
  // "somepseudorandomlygeneratedbytes" in ASCII, as in section 2.1.
  std::uint64_t v0 = key.low ^ 0x736F6D6570736575, v1 = key.high ^ 0x646F72616E646F6D;
  std::uint64_t v2 = key.low ^ 0x6C7967656E657261, v3 = key.high ^ 0x7465646279746573;
  const auto rounds = [&](int n) {
    for (; n > 0; --n) {
      v0 += v1, v2 += v3;
      v1 = std::rotl(v1, 13) ^ v0, v3 = std::rotl(v3, 16) ^ v2;
      v0 = std::rotl(v0, 32);
      v2 += v1, v0 += v3;
      v1 = std::rotl(v1, 17) ^ v2, v3 = std::rotl(v3, 21) ^ v0;
      v2 = std::rotl(v2, 32);
    }
  };
  const auto absorb = [&](std::uint64_t word) {
    v3 ^= word;
    rounds(2);
    v0 ^= word;
  };
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) absorb(detail::word_at<std::uint64_t>(bytes, at));
  std::uint64_t last = static_cast<std::uint64_t>(bytes.size()) << 56;
  for (unsigned shift = 0; at < bytes.size(); ++at, shift += 8) {
    last |= std::to_integer<std::uint64_t>(bytes[at]) << shift;
  }
  absorb(last);
  v2 ^= 0xFF;
  rounds(4);
  return v0 ^ v1 ^ v2 ^ v3;
}

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics
