// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What one thread writes and several read, whole, and nobody waits: of more copies than all readers can hold, one is
// the newest, and what nobody holds is filled again.
//
//     news<shape> all;
//     fill(all.blank());  all.publish();                    // the one writer
//     const int mine = all.take();  use(all[mine]);  all.give_back(mine);      // each reader
//
// A reader pins what it believes to be the newest and looks once more: if it still is, the writer has seen the pin or
// will, because both go through one order (sequentially consistent atomics); if it is not, nothing was read.

#include <passive_haptics/base/language.hpp>

#include <array>
#include <atomic>
#include <cstddef>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

template <class T>
class news {
 public:
  /// So many readers at once; each holds two copies and is on its way to a third.
  static constexpr int most_readers = 64;

  // ---------------------------------------------------------------------------------------- the writer
  /// One that nobody reads, to be filled; the same until it is published. Those that were filled before come first.
  [[nodiscard]] T& blank() noexcept {
    const int newest = newest_.load();
    for (int i = 0; spare_ < 0; i = (i + 1) % copies) {  // there is one: see most_readers
      if (i != newest && pins_[at(i)].load() == 0) spare_ = i;
    }
    return all_[at(spare_)];
  }
  void publish() noexcept {
    newest_.store(spare_);
    spare_ = -1;
  }

  // ---------------------------------------------------------------------------------------- each reader
  /// The number of the newest, −1 before any; another one than the one that is held is news.
  [[nodiscard]] int newest() const noexcept { return newest_.load(); }
  /// Holds the newest; −1 if there is none, or if the writer was faster several times.
  [[nodiscard]] int take() noexcept {
    for (int attempt = 0; attempt < 4; ++attempt) {
      const int i = newest_.load();
      if (i < 0) return -1;
      hold(i);
      if (newest_.load() == i) return i;
      give_back(i);
    }
    return -1;
  }
  /// Once more what is held already.
  void hold(int i) noexcept { pins_[at(i)].fetch_add(1); }
  void give_back(int i) noexcept { pins_[at(i)].fetch_sub(1); }
  [[nodiscard]] const T& operator[](int i) const noexcept { return all_[at(i)]; }

 private:
  static constexpr int copies = 3 * most_readers + 2;
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

  std::array<T, static_cast<std::size_t>(copies)> all_{};
  std::array<std::atomic<int>, static_cast<std::size_t>(copies)> pins_{};
  std::atomic<int> newest_{-1};
  int spare_ = -1;  ///< the writer's own
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
