// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"

using Catch::Matchers::WithinAbs;

namespace {

using clock_of_news = ph::freshness::on<d1>;

}  // namespace

TEST_CASE("news counts in full until it is stale, then fades to nothing", "[freshness]") {
  clock_of_news news({.stale_after = 0.1, .fade = 0.05});
  CHECK_FALSE(news.heard());
  CHECK(news.weight() == 0.0);
  CHECK_FALSE(news.stale());
  news.hear();
  CHECK(news.heard());
  for (int n = 0; n <= 200; ++n) {
    const double age = 1e-3 * n;
    const double weight = std::max(0.0, std::min(1.0, 1.0 - (age - 0.1) / 0.05));
    CHECK_THAT(news.weight(), WithinAbs(weight, 1e-9));
    if (std::abs(age - 0.1) > 1e-6) CHECK(news.stale() == (age > 0.1));
    news.grow_older(1e-3);
  }
  news.hear();
  CHECK(news.weight() == 1.0);
  CHECK_FALSE(news.stale());
}

TEST_CASE("by default news counts for ever", "[freshness]") {
  clock_of_news news({});
  news.hear();
  for (const double years : {1.0, 1e3, 1e300}) {
    news.grow_older(3e7 * years);
    CHECK(news.weight() == 1.0);
    CHECK_FALSE(news.stale());
  }
}

TEST_CASE("what is released fades at once, from where it is, and is never called stale",
          "[freshness]") {
  clock_of_news news({.stale_after = 0.1, .fade = 0.05});
  news.release();
  CHECK_FALSE(news.heard());  // there was nothing to release
  news.hear();
  news.grow_older(0.125);
  CHECK_THAT(news.weight(), WithinAbs(0.5, 1e-12));
  CHECK(news.stale());
  news.release();
  CHECK_THAT(news.weight(), WithinAbs(0.5, 1e-12));
  CHECK_FALSE(news.stale());
  news.grow_older(0.005);
  CHECK_THAT(news.weight(), WithinAbs(0.4, 1e-12));
  news.release();  // again: nothing new
  CHECK_THAT(news.weight(), WithinAbs(0.4, 1e-12));
  news.grow_older(1.0);
  CHECK(news.weight() == 0.0);
  CHECK(news.heard());
  news.hear();
  CHECK(news.weight() == 1.0);
  news.reset();
  CHECK_FALSE(news.heard());
  CHECK(news.weight() == 0.0);
}

TEST_CASE("a rule for stale news is refused with its name", "[freshness]") {
  const auto refused = [](const ph::freshness& rule) {
    const auto fault = rule.check();
    return std::string(fault ? fault.parameter : "");
  };
  const double nan = std::nan("");
  CHECK(refused({}).empty());
  CHECK(refused({.stale_after = 0.0, .fade = 1e-3}).empty());
  CHECK(refused({.stale_after = -1e-3}) == "stale_after");
  CHECK(refused({.stale_after = nan}) == "stale_after");
  for (const double bad : {0.0, -1.0, nan, HUGE_VAL}) CHECK(refused({.fade = bad}) == "fade");
}

TEST_CASE("news may be stale at once, and its rule may change meanwhile", "[freshness]") {
  clock_of_news news({.stale_after = 0.0, .fade = 0.1});
  news.hear();
  CHECK(news.weight() == 1.0);
  news.grow_older(0.05);
  CHECK_THAT(news.weight(), WithinAbs(0.5, 1e-12));
  news.set({.stale_after = 1.0, .fade = 0.1});
  CHECK(news.weight() == 1.0);
  CHECK(news.parameters().stale_after == 1.0);
}

TEST_CASE("news counts in full up to the very age at which it is stale", "[freshness]") {
  clock_of_news news({.stale_after = 0.125, .fade = 0.25});
  news.hear();
  news.grow_older(0.125);
  CHECK(news.current());
  CHECK_FALSE(news.stale());
  CHECK(news.weight() == 1.0);
  news.grow_older(0.125);
  CHECK(news.weight() == 0.5);
  news.grow_older(0.125);
  CHECK(news.weight() == 0.0);
  news.reset();
  CHECK_FALSE(news.heard());
  news.release();
  CHECK_FALSE(news.heard());
  news.hear();
  CHECK(news.weight() == 1.0);
}
