// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include <passive_haptics/mesh/news.hpp>

#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace {

/// Every number is the first one.
using shape = std::array<int, 64>;
bool whole(const shape& all) {
  for (const int number : all) {
    if (number != all[0]) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("several readers of one writer see each shape whole, and none older than the last",
          "[mesh][threads]") {
  namespace mesh = passive_haptics::mesh;
  const auto all = std::make_unique<mesh::news<shape>>();
  std::atomic<int> torn{0}, back{0}, reading{0};
  std::atomic<bool> stop{false};
  std::vector<std::thread> readers;
  for (int reader = 0; reader < 3; ++reader) {
    readers.emplace_back([&] {
      std::array<int, 2> held{-1, -1}, last{-1, -1};  // of the newest, and of what was told
      for (int read = 0; !stop;) {
        const std::size_t which = read % 2 == 0 ? 0 : 1;
        const int next = which == 0 ? all->take() : all->take_told();
        if (next < 0) continue;
        for (const int one : held) torn += one < 0 || whole((*all)[one]) ? 0 : 1;
        if (held[which] >= 0) all->give_back(held[which]);
        held[which] = next;
        torn += whole((*all)[next]) ? 0 : 1;
        back += (*all)[next][0] < last[which] ? 1 : 0;
        last[which] = (*all)[next][0];
        if (++read == 200) ++reading;
      }
      for (const int one : held) {
        if (one >= 0) all->give_back(one);
      }
    });
  }
  int told = 0;
  while (reading < 3 || told < 20000) {
    all->blank().fill(told++);
    all->publish_told();
    if (told % 3 == 0) {
      all->publish_as_told();
    } else {
      all->blank().fill(told++);
      all->publish();
    }
  }
  stop = true;
  for (std::thread& reader : readers) reader.join();
  CHECK(torn == 0);
  CHECK(back == 0);
}
