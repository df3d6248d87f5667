// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The file of a compliance table, written block by block and given its name when it is whole.
// A computation that was killed can go on from its last block.
//
//   byte  0   magic "PHTABLE" 1A           32   fingerprint of the body        64  numbers of the M nodes
//         8   byte order 01020304          40   fingerprint of the node list       in the mesh, int32
//        12   version                      48   0                                  to a multiple of 64
//        16   bytes of a scalar 4 | 8      56   checksum of bytes 0-55
//        20   M nodes                                                  then the blocks, each:
//        24   nodes of a block             columns of its nodes, 3M scalars each, x y z of node after node
//        28   0                            checksum, to a multiple of 64
//
// All numbers are in the byte order of the machine that wrote them, mostly little-endian. A machine of the other
// order refuses the file by the word at byte 8: its table must be computed there.

#include <passive_haptics/environment/fingerprint.hpp>
#include <passive_haptics/environment/refuse.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// A table that cannot be used or written. what() is complete, like that of mesh_error.
class table_error : public std::runtime_error {
 public:
  table_error(std::string_view where, std::string_view problem, std::string_view remedy)
      : std::runtime_error(sentence(where, ": ", problem, "; ", remedy)) {}
};

/// The first 64 bytes.
struct table_header {
  std::array<char, 8> magic{'P', 'H', 'T', 'A', 'B', 'L', 'E', '\x1A'};
  std::uint32_t byte_order = 0x01020304;
  std::uint32_t version = 1;
  std::uint32_t scalar_bytes = 4;
  std::uint32_t nodes = 0;
  std::uint32_t block_nodes = 32;
  std::uint32_t reserved = 0;
  std::uint64_t body = 0;
  std::uint64_t patch = 0;
  std::uint64_t reserved_too = 0;
  std::uint64_t checksum = 0;

  [[nodiscard]] std::uint64_t right_checksum() const noexcept {
    return fingerprint().add(std::as_bytes(std::span(this, 1)).first(56)).value();
  }
  [[nodiscard]] std::size_t blocks() const noexcept {
    return (std::size_t{nodes} + block_nodes - 1) / block_nodes;
  }
  [[nodiscard]] std::size_t nodes_of(std::size_t block) const noexcept {
    return (std::min)(std::size_t{block_nodes}, nodes - block * block_nodes);
  }
  /// The size of the scalars of a block [B].
  [[nodiscard]] std::size_t payload(std::size_t block) const noexcept {
    return 9 * nodes_of(block) * nodes * scalar_bytes;
  }
  [[nodiscard]] static constexpr std::size_t padded(std::size_t bytes) noexcept {
    return (bytes + 63) / 64 * 64;
  }
  [[nodiscard]] std::size_t list_bytes() const noexcept { return padded(4 * std::size_t{nodes}); }
  /// The byte at which a block begins; begin_of(blocks()) is the size of the file.
  [[nodiscard]] std::size_t begin_of(std::size_t block) const noexcept {
    const std::size_t front = sizeof(table_header) + list_bytes();
    const std::size_t full = padded(9 * std::size_t{block_nodes} * nodes * scalar_bytes + 8);
    if (block < blocks() || nodes == 0) return front + block * full;
    return front + (block - 1) * full + padded(payload(block - 1) + 8);
  }
};
static_assert(sizeof(table_header) == 64, "the header is written as it stands in memory");

/// The header of a table of the nodes `nodes` of the body with fingerprint `body`.
[[nodiscard]] inline table_header header_for(std::uint64_t body, std::span<const int> nodes,
                                             std::uint32_t scalar_bytes) {
  table_header header;
  header.scalar_bytes = scalar_bytes;
  header.nodes = static_cast<std::uint32_t>(nodes.size());
  header.body = body;
  header.patch = fingerprint().add(nodes).value();
  header.checksum = header.right_checksum();
  return header;
}

/// The bytes before the blocks: the header and the list of nodes.
[[nodiscard]] inline std::vector<std::byte> front_of(const table_header& header,
                                                     std::span<const int> nodes) {
  std::vector<std::byte> front(header.begin_of(0), std::byte{0});
  std::memcpy(front.data(), &header, sizeof(header));
  if (!nodes.empty()) std::memcpy(front.data() + sizeof(header), nodes.data(), nodes.size_bytes());
  return front;
}

/// True if the file has the block and its checksum is right.
[[nodiscard]] inline bool block_is_right(const table_header& header,
                                         std::span<const std::byte> file, std::size_t block) {
  const std::size_t begin = header.begin_of(block), payload = header.payload(block);
  if (file.size() < header.begin_of(block + 1)) return false;
  std::uint64_t said = 0;
  std::memcpy(&said, file.data() + begin + payload, sizeof(said));
  return said == fingerprint().add(file.subspan(begin, payload)).value();
}

inline constexpr std::string_view compute_again = "delete the file and compute the table again";

/// The list of nodes of a file that has a header and a whole list.
[[nodiscard]] inline std::vector<int> table_nodes(std::span<const std::byte> file) {
  table_header header;
  std::memcpy(&header, file.data(), sizeof(header));
  std::vector<int> nodes(header.nodes);
  std::memcpy(nodes.data(), file.data() + sizeof(header), 4 * nodes.size());
  return nodes;
}

/// The first fault of a table, or none if it can be used for scalars of `scalar_bytes`, the body of fingerprint
/// `body` and a mesh of `mesh_nodes` nodes.
[[nodiscard]] inline std::optional<table_error> find_table_fault(std::span<const std::byte> file,
                                                                 std::string_view name,
                                                                 std::uint64_t body,
                                                                 std::uint32_t scalar_bytes,
                                                                 std::size_t mesh_nodes) {
  const auto fault = [&](const std::string& problem, std::string_view remedy = compute_again) {
    return table_error(name, problem, remedy);
  };
  if (file.empty()) return fault("cannot be opened, or is empty", "compute the table first");
  table_header header;
  const table_header wanted;
  if (file.size() < sizeof(header)) return fault(sentence("has only ", file.size(), " bytes"));
  std::memcpy(&header, file.data(), sizeof(header));
  if (header.magic != wanted.magic) {
    return fault("is no compliance table", "give the file that compute_table has written");
  }
  if (header.byte_order == 0x04030201) {
    return fault("was written with the other byte order", "compute the table on this machine");
  }
  if (header.byte_order != wanted.byte_order || header.checksum != header.right_checksum()) {
    return fault("has a damaged header");
  }
  if (header.version != wanted.version) {
    return fault(sentence("has version ", header.version, "; read is ", wanted.version));
  }
  if (header.scalar_bytes != scalar_bytes) {
    return fault(sentence("has scalars of ", header.scalar_bytes, " bytes where ", scalar_bytes,
                          " are asked for"),
                 "choose compliance_table<float> or <double> accordingly");
  }
  if (header.body != body) {
    return fault("was made of another mesh, material or other fixed nodes");
  }
  if (header.nodes == 0 || header.block_nodes == 0) return fault("has no nodes");
  // If the file has room for 9 M² scalars, no product below overflows.
  if (header.nodes > file.size() / (std::size_t{9} * scalar_bytes) / header.nodes) {
    return fault(sentence("has ", file.size(), " bytes, too few for ", header.nodes, " nodes"));
  }
  if (file.size() != header.begin_of(header.blocks())) {
    return fault(sentence("has ", file.size(), " bytes of ", header.begin_of(header.blocks())));
  }
  const std::vector<int> nodes = table_nodes(file);
  if (header.patch != fingerprint().add(std::span<const int>(nodes)).value()) {
    return fault("has a damaged list of nodes");
  }
  for (const int node : nodes) {
    if (node >= 0 && static_cast<std::size_t>(node) < mesh_nodes) continue;
    return fault(sentence("names node ", node, " of ", mesh_nodes),
                 "give the number of nodes of the mesh that it was made of");
  }
  for (std::size_t block = 0; block < header.blocks(); ++block) {
    if (!block_is_right(header, file, block)) {
      return fault(sentence("block ", block, " of ", header.blocks(), " is damaged"));
    }
  }
  return std::nullopt;
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
