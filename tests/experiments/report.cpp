// SPDX-License-Identifier: BSD-3-Clause
// What the programs of bench/ show: tables that fit a terminal, help, and pages without gnuplot.
#include "../bench/common/report.hpp"

#include "../bench/common/options.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

#include <cstdlib>

namespace ex = experiments;

namespace {

struct printed {
  std::string all;
  std::size_t lines = 0, widest = 0;  ///< [columns]
};
printed print(const ex::table& t) {
  std::ostringstream out;
  t.print(out);
  printed p{out.str()};
  std::istringstream in(p.all);
  for (std::string line; std::getline(in, line); ++p.lines) {
    p.widest = std::max(p.widest, ex::columns_of(line));
  }
  return p;
}

bool mentions(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("a table that fits is printed as it is, characters counted and not bytes", "[report]") {
  ex::table t({"what", "µ"});
  t.add({"ä", "1"});
  t.add({"long one", "22"});
  CHECK(print(t).all == "what      µ\nä         1\nlong one  22\n\n");
}

TEST_CASE("a table wider than the terminal breaks headings, then cells, then itself", "[report]") {
  const std::string wide = "two words";  // nine columns, five and below when broken
  ex::table headings(std::vector<std::string>(12, wide));
  headings.add(std::vector<std::string>(12, "1"));
  const printed broken = print(headings);
  CHECK(broken.lines == 4);  // two of the heading, the row, an empty one
  CHECK(broken.widest <= ex::terminal_columns);

  std::string sentence;
  for (int i = 0; i < 40; ++i) sentence += "word" + std::to_string(i) + " ";
  ex::table cells({"name", "text"});
  cells.add({"x", sentence});
  const printed wrapped = print(cells);
  CHECK(wrapped.widest <= ex::terminal_columns);
  CHECK(wrapped.lines > 3);
  CHECK(mentions(wrapped.all, "word39"));

  std::vector<std::string> heading{"name"}, row{"the first column"};
  for (int i = 0; i < 40; ++i) {
    heading.push_back("c" + std::to_string(i));
    row.emplace_back("1.2345");
  }
  ex::table blocks(heading);
  blocks.add(row);
  const printed split = print(blocks);
  CHECK(split.widest <= ex::terminal_columns);
  CHECK(mentions(split.all, "c39"));
  std::size_t repeated = 0;
  for (auto at = split.all.find(row[0]); at != std::string::npos;
       at = split.all.find(row[0], at + 1)) {
    ++repeated;
  }
  CHECK(repeated == split.lines / 3);  // in front of every block
  CHECK(repeated > 1);
}

TEST_CASE("--help and -h say what a program can be told, within a terminal", "[report]") {
  bool quick = false;
  const std::vector<ex::option> all{
      ex::a_switch("--quick",
                   "a help text that goes on and on and on and on and on and on and on "
                   "and on and on, longer than a line",
                   quick)};
  for (const char* asked : {"--help", "-h"}) {
    try {
      ex::read_options("program", all, {asked});
      FAIL("no help");
    } catch (const ex::asked_for_help& help) {
      std::istringstream in(help.what());
      for (std::string line; std::getline(in, line);) {
        CHECK(ex::columns_of(line) <= ex::terminal_columns);
      }
      CHECK(mentions(help.what(), "usage: program"));
      CHECK(mentions(help.what(), "--quick"));
    }
  }
  CHECK_THROWS_AS(ex::read_options("program", all, {"-q"}), std::invalid_argument);
  CHECK_FALSE(quick);
}

TEST_CASE("without gnuplot a report has everything but the plots, and says so", "[report]") {
  const scratch_folder folder;
  const std::string path = std::getenv("PATH");
  for (const bool there : {false, true}) {
    ex::report out(folder.path());
    out.plot("line", "A line", "plot x");
    out.member("answer", "42");
    if (!there) setenv("PATH", "/nowhere", 1);
    const bool drawn = out.finish("title");
    setenv("PATH", path.c_str(), 1);
    if (there && !drawn) WARN("gnuplot is not installed: the control is left out");
    std::ifstream page(folder / "index.html");
    const std::string text{std::istreambuf_iterator<char>(page), {}};
    CHECK(mentions(text, "Some plots are missing") == !drawn);
    CHECK(mentions(text, "<h1>title</h1>"));
    CHECK(std::filesystem::exists(folder / "results.json"));
    if (!there) CHECK_FALSE(drawn);
  }
}
