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
      int held = -1, read = 0, last = -1;
      while (!stop) {
        const int next = all->take();
        if (next < 0) continue;
        if (held >= 0) {  // two at once, as on the way from one shape to the next
          torn += whole((*all)[held]) ? 0 : 1;
          all->give_back(held);
        }
        held = next;
        torn += whole((*all)[held]) ? 0 : 1;
        back += (*all)[held][0] < last ? 1 : 0;
        last = (*all)[held][0];
        if (++read == 100) ++reading;
      }
      if (held >= 0) all->give_back(held);
    });
  }
  int told = 0;
  while (reading < 3 || told < 20000) {
    all->blank().fill(told++);
    all->publish();
  }
  stop = true;
  for (std::thread& reader : readers) reader.join();
  CHECK(torn == 0);
  CHECK(back == 0);
}
