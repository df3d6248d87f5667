// SPDX-License-Identifier: BSD-3-Clause
// The program that compares with papers: a limit that is wrong must not pass for one of theirs, a promise that is broken
// must be seen, and what it writes must be there.
#include "../bench/published/program.hpp"
#include "programs.hpp"
#include "support/catch.hpp"

using namespace programs;

namespace {

outcome run_quietly(const std::vector<std::string>& arguments) {
  const std::atomic<bool> never = false;
  return quietly([&] { return papers::run(arguments, never); });
}

}  // namespace

TEST_CASE("a limit of a paper is where the bare spring begins to lose, and a wrong one is not",
          "[published]") {
  std::string last;
  int tried = 0;
  for (auto l : papers::limits()) {
    if (l.source == last || l.source.starts_with("Gil")) continue;  // one of each
    last = l.source;
    CAPTURE(l.source);
    l.measured = papers::largest_passive(l.on);
    CHECK(l.agrees() != l.is_control);
    if (l.is_control) continue;
    for (const double wrong : {0.5, 0.95, 1.05, 2.0}) {
      auto other = l;
      other.says *= wrong;
      CHECK(!other.agrees());
    }
    ++tried;
  }
  CHECK(tried == 3);
}

TEST_CASE("a slow press finds a spring as stiff as it is, and what is strict no stiffer than 2b/T",
          "[published]") {
  const papers::facts exact{};
  CHECK_THAT(papers::shown_stiffness(papers::bare(), exact, 2e3),
             Catch::Matchers::WithinRel(2e3, 0.001));
  for (const auto& c : papers::contenders()) {
    if (c.to != papers::promise::any_hand) continue;
    CAPTURE(c.name);
    const double shown = papers::shown_stiffness(c, exact, 10e3);
    CHECK(shown > 0.9 * 200.0);
    CHECK(shown < 1.01 * 200.0);
  }
}

TEST_CASE("a bare spring that promises is found out, and is not taken for the best",
          "[published]") {
  const papers::facts exact{};
  const papers::contender liar{"liar", papers::promise::any_hand, papers::bare().make};
  const auto found = papers::judged(liar, exact, 10e3, {.seconds = 1.0}, 2);
  CHECK(found.attacked < -1e-6);
  const auto honest = papers::judged(papers::contenders()[1], exact, 10e3, {}, 2);
  CHECK(honest.least_energy() >= -papers::accepted_loss);
  CHECK(honest.is_quiet());
  const auto spring = papers::judged(papers::bare(), exact, 10e3, {}, 2);
  CHECK(!spring.is_quiet());
  CHECK(papers::best_of({spring, found, honest}).contender == "make_touch");
}

TEST_CASE("the page of published figures has its table, its captions hold, and a typo is refused",
          "[published]") {
  const scratch_folder out;
  const outcome found = run_quietly({"--quick", "--only", "limits,thesis", "--out", out / ""});
  CAPTURE(found.complaint);
  CHECK(found.code == 0);
  const std::string json = content(out / "published.json"), page = content(out / "published.md");
  for (const char* key : {"limits", "thesis", "figures", "captions", "failures"}) {
    CAPTURE(key);
    CHECK(json.find('"' + std::string(key) + '"') != std::string::npos);
  }
  CHECK(page.find("## In one table") != std::string::npos);
  CHECK(page.find("McWilliam") != std::string::npos);
  CHECK(content(out / "limits.csv").find("Colgate") != std::string::npos);
  CHECK(run_quietly({"--only", "limit"}).code == 2);
}
