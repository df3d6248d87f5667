// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A fingerprint of 64 bits of a body or of a block of a file. It guards against mistakes, not against malice.
//
// Words of 8 bytes go to four lanes in turn, and are xored and multiplied there as in FNV-1a (G. Fowler,
// L. C. Noll, K.-P. Vo). The lanes do not wait for each other, so a table of 36 MB takes some milliseconds.

#include <passive_haptics/environment/tetrahedral_stiffness.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

class fingerprint {
 public:
  fingerprint& add(std::span<const std::byte> bytes) noexcept {
    for (std::size_t at = 0; at < bytes.size(); at += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + at, bytes.size() - at < 8 ? bytes.size() - at : 8);
      std::uint64_t& lane = lanes_[(at / 8) % 4];
      lane = (lane ^ word) * prime;
      lane ^= lane >> 29;
    }
    return number(bytes.size());
  }
  /// Adds numbers that have no padding between them.
  template <class Number>
  fingerprint& add(std::span<const Number> numbers) noexcept {
    return add(std::as_bytes(numbers));
  }
  fingerprint& number(std::uint64_t n) noexcept {
    for (std::uint64_t& lane : lanes_) {
      lane = (lane ^ n) * prime;
      lane ^= lane >> 29;
    }
    return *this;
  }
  [[nodiscard]] std::uint64_t value() const noexcept {
    std::uint64_t all = 14695981039346656037ULL;
    for (const std::uint64_t lane : lanes_) {
      all = (all ^ lane) * prime;
      all ^= all >> 32;
    }
    return all;
  }

 private:
  static constexpr std::uint64_t prime = 1099511628211ULL;
  std::array<std::uint64_t, 4> lanes_{1, 2, 3, 4};
};

/// The fingerprint of an elastic body: mesh, material and fixed nodes. Another order of nodes gives another one.
[[nodiscard]] inline std::uint64_t fingerprint_of(const tetrahedral_mesh& mesh, const material& m,
                                                  std::span<const int> fixed_nodes) {
  fingerprint all;
  for (const auto& x : mesh.nodes) all.add(std::span<const double>(x.data(), 3));
  all.number(mesh.nodes.size());
  for (const auto& t : mesh.tetrahedra) all.add(std::span<const int>(t));
  all.number(mesh.tetrahedra.size());
  const std::array<double, 2> constants{m.young, m.poisson};
  return all.add(std::span<const double>(constants)).add(fixed_nodes).value();
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
