// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/exchange.hpp>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <thread>

namespace {

/// A payload in which any tear shows: every word is a function of the first.
struct telltale {
  std::array<std::uint64_t, 16> words{};

  static telltale of(std::uint64_t n) {
    telltale t;
    for (std::size_t i = 0; i < t.words.size(); ++i) t.words[i] = n * (2 * i + 1);
    return t;
  }
  [[nodiscard]] bool whole() const {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] != words[0] * (2 * i + 1)) return false;
    }
    return true;
  }
};

}  // namespace

TEST_CASE("exchange hands over the newest value once", "[exchange]") {
  ph::exchange<int> box;
  CHECK(box.take() == nullptr);
  box.publish(1);
  box.publish(2);
  box.publish(3);
  const int* newest = box.take();
  REQUIRE(newest != nullptr);
  CHECK(*newest == 3);
  CHECK(box.take() == nullptr);
  box.publish(4);
  CHECK(*newest == 3);  // ours until the next take
  newest = box.take();
  REQUIRE(newest != nullptr);
  CHECK(*newest == 4);
}

TEST_CASE("exchange never reuses the slot the reader holds, in any order of calls", "[exchange]") {
  for (unsigned plan = 0; plan < (1U << 14U); ++plan) {  // every order of 14 calls
    ph::exchange<unsigned> box;
    unsigned written = 0, held = 0;
    const unsigned* mine = nullptr;
    for (unsigned i = 0; i < 14; ++i) {
      if ((plan >> i & 1U) != 0) {
        box.publish(++written);
      } else if (const unsigned* taken = box.take()) {
        mine = taken;
        held = *taken;
        if (held != written) FAIL("plan " << plan << ": not the newest");
      }
      if (mine != nullptr && *mine != held) FAIL("plan " << plan << ": overwritten");
    }
  }
  SUCCEED();
}

TEST_CASE("exchange carries every constraint and sample of the library", "[exchange]") {
  ph::exchange<ph::triangle<f3>> triangles;
  triangles.publish({.a = {0, 0, 0}, .b = {1, 0, 0}, .c = {0, 1, 0}, .stiffness = 5});
  CHECK(triangles.take()->stiffness == 5);
  ph::exchange<ph::device_sample<d3>> samples;
  samples.publish({.position = {1, 2, 3}});
  CHECK(d3::vector(samples.take()->position)(2) == 3);
}

TEST_CASE("two threads through exchange never see half a value", "[exchange][threads]") {
  // PASSIVE_HAPTICS_READS sets the number of reads; the default is the 10 million asked for, of which the
  // quick preset makes one. The reader looks at the value it holds again and again while the writer goes on
  // writing. On a machine so busy that they take turns on one core it still waits for one new value in
  // 10 000 looks.
  const char* asked = std::getenv("PASSIVE_HAPTICS_READS");
  const std::uint64_t reads = asked != nullptr ? std::strtoull(asked, nullptr, 10) : 10'000'000;
  ph::exchange<telltale> box;
  std::atomic<bool> done{false};
  std::thread writer([&box, &done] {
    for (std::uint64_t n = 1; !done.load(std::memory_order_relaxed); ++n) {
      box.publish(telltale::of(n));
      if (n % 1024 == 0) std::this_thread::yield();  // where both have one core, and that is busy
    }
  });
  std::uint64_t torn = 0, backwards = 0, last = 0, taken = 0;
  const telltale* mine = nullptr;
  for (std::uint64_t i = 0; i < reads || taken < reads / 100;) {
    if (i >= reads) std::this_thread::yield();  // it has looked enough, and waits for news
    if (const telltale* newer = box.take()) {
      mine = newer;
      backwards += mine->words[0] > last ? 0U : 1U;
      last = mine->words[0];
      ++taken;
    }
    if (mine == nullptr) continue;
    torn += mine->whole() ? 0U : 1U;
    ++i;
  }
  done = true;
  writer.join();
  CHECK(torn == 0);
  CHECK(backwards == 0);
  CHECK(taken >= reads / 100);
}

TEST_CASE("the telltale of the thread test does tell a torn value", "[exchange]") {
  auto torn = telltale::of(7);
  CHECK(torn.whole());
  torn.words[9] = telltale::of(8).words[9];
  CHECK_FALSE(torn.whole());
}
