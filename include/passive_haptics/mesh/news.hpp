// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One thread writes a value and several read it, always whole, and no thread waits. There are more copies of the
// value than all readers can hold: one is the newest, one may be what was told where the newest is foreseen, and one
// that no reader holds is filled next.
//
//     news<shape> all;
//     fill(all.blank());  all.publish();                    // the one writer
//     const int mine = all.take();  use(all[mine]);  all.give_back(mine);      // each reader
//
// A reader pins the copy that it believes to be the newest and looks again. If that copy still is the newest, the
// writer sees the pin before it fills another copy, because all atomics share one order (they are sequentially
// consistent). If it is not, the reader has read nothing of it and gives it back.

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
  /// The most readers at one time; each holds up to two copies and may be pinning a third.
  static constexpr int most_readers = 64;

  // ---------------------------------------------------------------------------------------- the writer
  /// The copy to fill next, which no reader holds. It stays the same until it is published. The search begins at the
  /// first copy, so that as few as possible are ever filled.
  [[nodiscard]] T& blank() noexcept {
    const int newest = newest_.load(), told = told_.load();
    for (int i = 0; spare_ < 0; i = (i + 1) % copies) {  // most_readers leaves one free
      if (i != newest && i != told && pins_[at(i)].load() == 0) spare_ = i;
    }
    return all_[at(spare_)];
  }
  void publish() noexcept {
    newest_.store(spare_);
    spare_ = -1;
  }
  /// Publishes it as what was told, beside the newest, which may be what is foreseen.
  void publish_told() noexcept {
    told_.store(spare_);
    spare_ = -1;
  }
  /// What was told last is the newest, too.
  void publish_as_told() noexcept { newest_.store(told_.load()); }

  // ---------------------------------------------------------------------------------------- each reader
  /// The number of the newest copy, −1 before the first. It is news for a reader that holds another one.
  [[nodiscard]] int newest() const noexcept { return newest_.load(); }
  [[nodiscard]] int told() const noexcept { return told_.load(); }
  /// Pins the newest copy and returns its number; −1 if there is none, or if the writer overtook it four times.
  [[nodiscard]] int take() noexcept { return take(newest_); }
  /// The same for what was told.
  [[nodiscard]] int take_told() noexcept { return take(told_); }
  /// Pins a copy that is held already a second time.
  void hold(int i) noexcept { pins_[at(i)].fetch_add(1); }
  void give_back(int i) noexcept { pins_[at(i)].fetch_sub(1); }
  [[nodiscard]] const T& operator[](int i) const noexcept { return all_[at(i)]; }

 private:
  static constexpr int copies = 3 * most_readers + 3;
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] int take(const std::atomic<int>& which) noexcept {
    for (int attempt = 0; attempt < 4; ++attempt) {
      const int i = which.load();
      if (i < 0) return -1;
      hold(i);
      if (which.load() == i) return i;
      give_back(i);
    }
    return -1;
  }

  std::array<T, static_cast<std::size_t>(copies)> all_{};
  std::array<std::atomic<int>, static_cast<std::size_t>(copies)> pins_{};
  std::atomic<int> newest_{-1}, told_{-1};
  int spare_ = -1;  ///< the copy that blank() has chosen, for the writer only; −1: none
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
