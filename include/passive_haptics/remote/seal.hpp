// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A seal authenticates every datagram of a session, in both directions.
//
//     const remote::siphash_seal seal(remote::siphash_key{…, …});          // the same 128 bits at both ends
//     remote::client_with client({}, remote::draw_number(), seal);
//     remote::server_with server({}, remote::draw_number, seal);
//
// A seal of your own, for example one that encrypts, has the number of bytes that it adds, and two functions on all
// bytes: the first 152 are the datagram, the others belong to the seal.
//
//     struct my_seal {
//       static constexpr std::size_t size = 16;          // up to 64
//       void seal(std::span<std::byte> bytes) noexcept;  // makes what is sent of a datagram
//       bool open(std::span<std::byte> bytes) noexcept;  // inverse; false refuses the bytes
//     };
//
// An attacker who                without a seal                   with a seal
//   cannot read the traffic      has to guess 64 bits             has to guess these and the tag
//   reads it                     can do anything                  can repeat it, which is refused
//   reads it and stops it        can do anything                  can delay it and end the session
//
// A seal need not refuse repeated datagrams, because key, session, sequence and stamp, which it covers, do that.

#include <passive_haptics/remote/siphash.hpp>

#include <algorithm>
#include <concepts>

namespace passive_haptics {
inline namespace v0 {
namespace remote {

/// The contract of a seal of client_with and server_with.
template <class Seal>
concept datagram_seal = Seal::size <= longest_seal&& requires(Seal s, std::span<std::byte> bytes) {
  s.seal(bytes);
  { s.open(bytes) } -> std::same_as<bool>;
};

/// No seal: it adds no byte and takes no time. `client` and `server` have it.
struct no_seal {
  static constexpr std::size_t size = 0;
  static constexpr void seal(std::span<std::byte>) noexcept {}
  static constexpr bool open(std::span<std::byte>) noexcept { return true; }
};

/// SipHash-2-4 of the 152 bytes under a key that both ends have beforehand: a tag of 64 bits, little-endian.
/// A datagram that is forged without the key is accepted once in 2⁶⁴ times. Nothing is encrypted, and the owner of the
/// key can act as either end. A key of which a half is 0, for example one never set, is refused: open() is false.
class siphash_seal {
 public:
  static constexpr std::size_t size = 8;

  constexpr explicit siphash_seal(const siphash_key& shared) noexcept : key_(shared) {}

  /// Writes the tag into the last 8 of 160 bytes.
  constexpr void seal(std::span<std::byte> bytes) const noexcept {
    detail::put(bytes, datagram_size, siphash(key_, bytes.first(datagram_size)));
  }
  /// True if the last 8 of 160 bytes are the tag of the others.
  [[nodiscard]] constexpr bool open(received_bytes bytes) const noexcept {
    const auto tag = detail::word_at<std::uint64_t>(bytes, datagram_size);
    return key_.low != 0 && key_.high != 0 && tag == siphash(key_, bytes.first(datagram_size));
  }

 private:
  siphash_key key_;
};

namespace detail {

template <datagram_seal Seal>
[[nodiscard]] constexpr auto encode_sealed(const message& m, Seal& seal) noexcept {
  std::array<std::byte, datagram_size + Seal::size> bytes{};
  const datagram plain = encode(m);
  std::copy(plain.begin(), plain.end(), bytes.begin());
  seal.seal(bytes);
  return bytes;
}

template <datagram_seal Seal>
[[nodiscard]] constexpr decoded decode_sealed(received_bytes bytes, Seal& seal) noexcept {
  std::array<std::byte, datagram_size + Seal::size> opened{};
  if (bytes.size() != opened.size()) return {verdict::wrong_length};
  std::copy(bytes.begin(), bytes.end(), opened.begin());
  if (!seal.open(opened)) return {verdict::forged};
  return decode(received_bytes(opened).first(datagram_size));
}
// Without a seal nothing is copied.
[[nodiscard]] constexpr datagram encode_sealed(const message& m, no_seal&) noexcept {
  return encode(m);
}
[[nodiscard]] constexpr decoded decode_sealed(received_bytes bytes, no_seal&) noexcept {
  return decode(bytes);
}

}  // namespace detail

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics
