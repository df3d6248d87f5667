// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What must hold for ANY bytes in a file: read, or refused with a message, and what was read can be used.
// Returns null, or what broke.
#include "fuzz/reader.hpp"
#include <passive_haptics/environment/compliance_table.hpp>
#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/falcon/recording_file.hpp>
#include <passive_haptics/identification/device_file.hpp>
#include <passive_haptics/identification/identification_file.hpp>
#include <passive_haptics/identification/recording_file.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace fuzz {

namespace ph = passive_haptics;
namespace env = passive_haptics::environment;

inline std::string text_of(input bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Every bit of a header and a list of nodes, with checksums that are right, over blocks that are or not.
inline const char* table(input bytes) {
  reader in(bytes);
  const bool mends = (in.one() & 1) != 0;
  const auto scalar_bytes = (in.one() & 1) != 0 ? 4U : 8U;
  constexpr std::size_t mesh_nodes = 40;
  std::vector<std::uint64_t> aligned(bytes.size() / 8 + 1);
  const auto rest = bytes.subspan(std::min<std::size_t>(bytes.size(), 2));
  if (!rest.empty()) std::memcpy(aligned.data(), rest.data(), rest.size());
  const auto file = std::as_writable_bytes(std::span(aligned)).first(rest.size());
  if (mends && file.size() >= sizeof(env::table_header)) {
    env::table_header header;
    const env::table_header wanted;
    std::memcpy(&header, file.data(), sizeof(header));
    header.magic = wanted.magic;
    header.byte_order = wanted.byte_order;
    header.version = wanted.version;
    header.scalar_bytes = scalar_bytes;
    header.body = 7;
    if (header.nodes != 0 && header.nodes <= file.size() / 36 / header.nodes) {
      std::vector<int> nodes(header.nodes);
      std::memcpy(nodes.data(), file.data() + sizeof(header),
                  std::min(4 * nodes.size(), file.size() - sizeof(header)));
      header.patch = env::fingerprint().add(std::span<const int>(nodes)).value();
    }
    header.checksum = header.right_checksum();
    std::memcpy(file.data(), &header, sizeof(header));
    if (header.nodes != 0 && header.nodes < 100 && header.block_nodes != 0) {
      for (std::size_t i = 0; i < header.blocks(); ++i) {
        const std::size_t begin = header.begin_of(i), payload = header.payload(i);
        if (begin > file.size() || payload + 8 > file.size() - begin) break;
        const auto sum = env::fingerprint().add(file.subspan(begin, payload)).value();
        std::memcpy(file.data() + begin + payload, &sum, sizeof(sum));
      }
    }
  }
  if (const auto fault = env::find_table_fault(file, "a table", 7, scalar_bytes, mesh_nodes)) {
    return std::string_view(fault->what()).size() > 10 ? nullptr : "refused without a word";
  }
  for (const int node : env::table_nodes(file)) {
    if (node < 0 || static_cast<std::size_t>(node) >= mesh_nodes) return "a node that is not there";
  }
  return nullptr;
}

inline const char* msh(input bytes) {
  std::istringstream in(text_of(bytes));
  const auto loaded = env::load_msh(in, "a mesh");
  if (loaded.fault) return loaded.mesh.tetrahedra.empty() ? nullptr : "a fault, and a mesh";
  const auto count = static_cast<int>(loaded.mesh.nodes.size());
  for (const auto& all : loaded.mesh.tetrahedra) {
    for (const int node : all) {
      if (node < 0 || node >= count) return "a corner that is not there";
    }
  }
  for (const auto& node : loaded.mesh.nodes) {
    if (!node.allFinite()) return "a node nowhere";
  }
  return nullptr;
}

inline const char* identification(input bytes) {
  std::istringstream in(text_of(bytes));
  const auto loaded = ph::identification::read<1>(in, "a file");
  if (!loaded.fault.empty()) return nullptr;
  if (!(loaded.found.axes[0].mass > 0.0) || !(loaded.found.axes[0].longest_tick > 0.0)) {
    return "found, and of no use";
  }
  const std::string text = ph::identification::file_text(loaded.found, loaded.device);
  if (text.empty()) return nullptr;  // a problem that the file states
  std::istringstream again(text);
  return ph::identification::read<1>(again, "again").fault.empty() ? nullptr : "is not read again";
}

inline const char* device(input bytes) {
  std::istringstream in(text_of(bytes));
  const auto loaded = ph::identification::read_device(in, "a file");
  if (!loaded.fault.empty()) {
    return loaded.fault.rfind("a file:", 0) == 0 ? nullptr : "refused, and not said where";
  }
  if (std::visit([](const auto& d) { return bool(d.check()); }, loaded.of.device)) {
    return "read, and of no use";
  }
  const std::string text = ph::identification::device_text(loaded.of);
  std::istringstream again(text);
  const auto same = ph::identification::read_device(again, "again");
  if (!same.fault.empty()) return "is not read again";
  return ph::identification::device_text(same.of) == text ? nullptr : "is read as another";
}

inline const char* recording(input bytes) {
  ph::falcon::wire_row row;
  std::istringstream lines(text_of(bytes));
  for (std::string line; std::getline(lines, line);) {
    if (!ph::falcon::detail::parse_row(line, row)) continue;
    if (row.count > row.bytes.size()) return "more bytes than there is room for";
    if (row.stamp.count() < 0) return "time before the beginning";
  }
  return nullptr;
}

/// A log of time, position and force in any of its formats; the columns by their numbers.
inline const char* logged(input bytes) {
  const auto loaded = ph::identification::read_recording(
      text_of(bytes), "a file", {.time = "", .position = "1", .force = "2", .tick = 1e-3});
  if (!loaded.fault.empty()) {
    return loaded.fault.rfind("a file: ", 0) == 0 && loaded.rows.size() == 0
               ? nullptr
               : "refused, and not said where";
  }
  const auto& r = loaded.rows;
  if (r.size() < 200 || r.position.size() != r.size() || r.force.size() != r.size())
    return "read, and of no use";
  const auto s = ph::identification::statistics_of(r);
  return std::isfinite(s.tick) && std::isfinite(s.span) ? nullptr : "statistics of nothing";
}

inline const char* files(input bytes) {
  reader in(bytes);
  const unsigned which = in.one();
  const auto rest = bytes.subspan(std::min<std::size_t>(bytes.size(), 1));
  if (which >= 252) return device(rest);
  if (which >= 248) return logged(rest);
  switch (which % 4) {
    case 0:
      return table(rest);
    case 1:
      return msh(rest);
    case 2:
      return identification(rest);
    default:
      return recording(rest);
  }
}

}  // namespace fuzz
