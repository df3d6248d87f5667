// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The compliance of a patch of the surface [m/N], computed once and kept in a file (Green's functions).
//
//     const auto id = env::fingerprint_of(mesh, m, fixed);
//     const auto patch = env::patch_around(env::boundary(mesh), mesh.nodes, where, 1000);
//     const env::tetrahedral_fem fem(mesh, m, fixed, {.touched = patch});      // once: minutes for 1e5 nodes
//     env::compute_table("organ.table", fem, id, patch);                       // seconds
//     env::basic_deformable_body<env::compliance_table<>> body(                // each start: milliseconds
//         mesh, env::read_table("organ.table", id, mesh.nodes.size()));
//
// A patch of M nodes takes 9 M² scalars, 36 MB for 1000 nodes in float. patch_compliance.hpp has the formulas.

#include <passive_haptics/environment/mapped_file.hpp>
#include <passive_haptics/environment/patch_compliance.hpp>
#include <passive_haptics/environment/table_file.hpp>
#include <passive_haptics/environment/tetrahedral_fem.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <future>
#include <ios>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// The columns of a file in which find_table_fault() finds nothing.
template <std::floating_point Scalar>
class columns_of_file {
 public:
  explicit columns_of_file(mapped_file file) : file_(std::move(file)) {
    std::memcpy(&header_, file_.bytes().data(), sizeof(header_));
  }
  [[nodiscard]] const Scalar* column(std::size_t index) const {
    const std::size_t block = index / header_.block_nodes, in = index % header_.block_nodes;
    return reinterpret_cast<const Scalar*>(file_.bytes().data() + header_.begin_of(block)) +
           9 * in * header_.nodes;
  }

 private:
  mapped_file file_;
  table_header header_;
};

/// An elastic_solid of a table of float, with a relative error of 1e-5, or of double.
template <std::floating_point Scalar = float>
using compliance_table = patch_compliance<columns_of_file<Scalar>>;

/// The answer of load_table(): exactly one of its two members has a value.
template <std::floating_point Scalar>
struct loaded_table {
  std::optional<compliance_table<Scalar>> table;
  std::optional<table_error> fault;  ///< the first fault, with file and remedy
};

/// Maps the table of a body with this fingerprint and this many nodes, and checks every block.
template <std::floating_point Scalar = float>
[[nodiscard]] loaded_table<Scalar> load_table(const std::filesystem::path& path, std::uint64_t body,
                                              std::size_t mesh_nodes) {
  mapped_file file(path);
  auto fault = find_table_fault(file.bytes(), path.string(), body, sizeof(Scalar), mesh_nodes);
  if (fault) return {std::nullopt, std::move(fault)};
  std::vector<int> nodes = table_nodes(file.bytes());
  return {compliance_table<Scalar>(columns_of_file<Scalar>(std::move(file)), std::move(nodes),
                                   mesh_nodes),
          std::nullopt};
}
/// The same, but throws the fault as a table_error.
template <std::floating_point Scalar = float>
[[nodiscard]] compliance_table<Scalar> read_table(const std::filesystem::path& path,
                                                  std::uint64_t body, std::size_t mesh_nodes) {
  auto loaded = load_table<Scalar>(path, body, mesh_nodes);
  if (loaded.fault) refuse(*loaded.fault);
  return std::move(*loaded.table);
}

struct table_options {
  int threads = 0;        ///< 0: as many as the machine has
  on_progress tell = {};  ///< called after each round of blocks; false throws stopped_by_caller
};

/// Computes the table of a patch and leaves it under `path`. The table is written to `path`.part, block by
/// block, and renamed when it is whole; a computation that was stopped or killed goes on from its .part. Only one
/// process at a time may write to a path. Throws std::invalid_argument, table_error or stopped_by_caller.
template <std::floating_point Scalar = float, column_solver Solver>
void compute_table(const std::filesystem::path& path, const basic_tetrahedral_fem<Solver>& solid,
                   std::uint64_t body, std::span<const int> patch,
                   const table_options& options = {}) {
  check_patch("compute_table", patch, solid.numbers().size());
  const table_header header = header_for(body, patch, sizeof(Scalar));
  const std::vector<std::byte> front = front_of(header, patch);
  const std::filesystem::path part = path.string() + ".part";
  const auto failed = [&] {
    refuse(table_error(part.string(), "cannot be written",
                       "is there a folder, and room on the disk?"));
  };

  std::size_t done = 0;
  {
    const mapped_file old(part);
    if (old.bytes().size() >= front.size() &&
        std::equal(front.begin(), front.end(), old.bytes().begin())) {
      while (done < header.blocks() && block_is_right(header, old.bytes(), done)) ++done;
    }
  }
  std::error_code refused;
  if (done > 0) std::filesystem::resize_file(part, header.begin_of(done), refused);
  if (refused) failed();
  std::ofstream file(part, done > 0 ? std::ios::binary | std::ios::app : std::ios::binary);
  const auto write = [&](std::span<const std::byte> bytes) {
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) failed();
  };
  if (done == 0) write(front);

  const auto compute = [&](std::size_t block) {
    const auto nodes = patch.subspan(block * header.block_nodes, header.nodes_of(block));
    const std::vector<Scalar> scalars = patch_columns<Scalar>(solid, patch, nodes);
    std::vector<std::byte> bytes(header.begin_of(block + 1) - header.begin_of(block), std::byte{0});
    const auto payload = std::as_bytes(std::span(scalars));
    std::copy(payload.begin(), payload.end(), bytes.begin());
    const std::uint64_t checksum = fingerprint().add(payload).value();
    std::memcpy(bytes.data() + payload.size(), &checksum, sizeof(checksum));
    return bytes;
  };

  const std::size_t hardware = (std::max)(1U, std::thread::hardware_concurrency());
  const std::size_t threads = options.threads > 0 ? slot(options.threads) : hardware;
  while (done < header.blocks()) {
    if (options.tell &&
        !options.tell(static_cast<double>(done) / static_cast<double>(header.blocks()))) {
      refuse(
          stopped_by_caller(sentence("compute_table: stopped; ", part.string(), " has ", done,
                                     " of ", header.blocks(), " blocks, from which it goes on")));
    }
    std::vector<std::future<std::vector<std::byte>>> others;  // get() throws what compute() threw
    const std::size_t round = (std::min)(threads, header.blocks() - done);
    for (std::size_t i = 1; i < round; ++i) {
      others.push_back(std::async(std::launch::async, compute, done + i));
    }
    write(compute(done));
    for (auto& other : others) write(other.get());
    done += round;
  }
  file.close();
  if (!file) failed();
  std::filesystem::rename(part, path, refused);
  if (refused) failed();
}

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics
