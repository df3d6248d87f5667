// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A file as memory: mapped where the system can (POSIX), else read.

#include <passive_haptics/base/language.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <span>
#include <utility>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#define PASSIVE_HAPTICS_MAPS_FILES 1
#endif

namespace passive_haptics {
inline namespace v0 {
namespace environment {

/// The bytes of a file, read only and aligned to 8 bytes at least; empty if the file cannot be opened. To replace
/// a file in use, rename another over it: a file that is truncated while it is mapped ends the program.
class mapped_file {
 public:
  mapped_file() = default;
  explicit mapped_file(const std::filesystem::path& path) {
#ifdef PASSIVE_HAPTICS_MAPS_FILES
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    struct stat is {};
    if (::fstat(file, &is) == 0 && S_ISREG(is.st_mode) && is.st_size > 0) {
      const auto size = static_cast<std::size_t>(is.st_size);
      void* const at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
      if (at != MAP_FAILED) {
        mapping_ = at;
        bytes_ = {static_cast<const std::byte*>(at), size};
      }
    }
    ::close(file);
#else
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return;
    const auto size = static_cast<std::size_t>(file.tellg());
    words_.resize((size + 7) / 8);
    file.seekg(0);
    if (!file.read(reinterpret_cast<char*>(words_.data()), static_cast<std::streamsize>(size)))
      return;
    bytes_ = std::as_bytes(std::span(words_)).first(size);
#endif
  }
  mapped_file(mapped_file&& other) noexcept {
    *this = std::move(other);
  }
  mapped_file& operator=(mapped_file&& other) noexcept {
    std::swap(mapping_, other.mapping_);
    std::swap(words_, other.words_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~mapped_file() {
#ifdef PASSIVE_HAPTICS_MAPS_FILES
    if (mapping_ != nullptr) ::munmap(mapping_, bytes_.size());
#endif
  }

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept {
    return bytes_;
  }

 private:
  void* mapping_ = nullptr;
  std::vector<std::uint64_t> words_;  ///< the file's content where nothing is mapped
  std::span<const std::byte> bytes_;
};

}  // namespace environment
}  // namespace v0
}  // namespace passive_haptics

#ifdef PASSIVE_HAPTICS_MAPS_FILES
#undef PASSIVE_HAPTICS_MAPS_FILES
#endif
