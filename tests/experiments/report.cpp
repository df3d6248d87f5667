// SPDX-License-Identifier: BSD-3-Clause
// What the programs of bench/ show: tables that fit a terminal, help, and pages without gnuplot.
#include "../bench/common/rows.hpp"
#include "programs.hpp"
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"

#include <cmath>
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

const ex::clause rising{"It rises.", [] { return true; }};

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
  ex::table headings(std::vector<std::string>(11, wide));
  headings.add(std::vector<std::string>(11, "1"));
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
    out.plot("line", {"A line", {rising}}, "plot x");
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

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

/// What a browser would fetch from elsewhere: sources, styles and imports with an address.
std::size_t external_requests(const std::string& page) {
  std::size_t n = 0;
  for (const char* from : {"src=\"http", "src=\"//", "url(http", "url(//", "@import", "<link"}) {
    n += count(page, from);
  }
  return n;
}

/// Relative luminance, as WCAG has it, of #rgb or #rrggbb.
double luminance(const std::string& colour) {
  const std::string wide =
      colour.size() == 4
          ? std::string{'#', colour[1], colour[1], colour[2], colour[2], colour[3], colour[3]}
          : colour;
  double sum = 0.0;
  const double weight[] = {0.2126, 0.7152, 0.0722};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(wide.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    sum += weight[i] * (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}
double contrast(const std::string& a, const std::string& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}
/// A colour of the stylesheet, in its light or its dark scheme.
std::string variable(const std::string& name, bool dark) {
  const std::string style = ex::page_style;
  const auto scheme = style.find(dark ? "prefers-color-scheme:dark" : ":root{");
  const auto at = style.find("--" + name + ":", scheme);
  REQUIRE(at != std::string::npos);
  const auto from = at + name.size() + 3;
  return style.substr(from, style.find_first_of(";}", from) - from);
}

}  // namespace

TEST_CASE("a page has a table of contents, a caption for each plot, and asks nobody", "[report]") {
  const scratch_folder folder;
  ex::report out(folder.path());
  ex::table numbers({"what", "N"});
  numbers.add({"a <b>", "1.5"});
  out.section("First & last", "Text.");
  out.show(numbers);
  out.plot("line", {"A \"line\"", {rising}}, "plot x");
  out.section("First & last", "The same name once more.");
  out.plot("wave", {"A wave", {ex::definition("It does not.")}}, "plot sin(x)");
  static_cast<void>(out.finish("title", "What it is about."));
  const std::string page = text_of(folder / "index.html");

  CHECK(mentions(page, "<nav aria-label=\"Contents\">"));
  for (const char* id : {"first-last", "first-last-2", "figure-line", "figure-wave"}) {
    INFO(id);
    CHECK(count(page, "id=\"" + std::string(id) + "\"") == 1);
    CHECK(count(page, "href=\"#" + std::string(id) + "\"") == 1);
  }
  CHECK(count(page, "<figure ") == 2);
  CHECK(count(page, "<figcaption>") == 2);
  CHECK(mentions(page, "<b>A \"line\"</b> It rises."));
  CHECK(mentions(page, "alt=\"A &quot;line&quot;\""));
  CHECK(mentions(page, "<td>a &lt;b&gt;</td><td class=\"n\">1.5</td>"));
  CHECK(mentions(page, "<meta name=\"description\" content=\"What it is about.\">"));
  CHECK(mentions(page, "width=device-width"));
  CHECK(external_requests(page) == 0);
  CHECK(external_requests(page + "<img src=\"https://example.org/a.svg\">") == 1);  // the control
}

TEST_CASE("a caption that its own curve denies fails the program", "[report]") {
  const scratch_folder folder;
  ex::report out(folder.path());
  ex::csv_file csv(out.path("line.csv"), "s,force N,what");
  for (const double s : {0.0, 1.0, 2.0}) csv.row(s, 3.0 * s, "word");
  csv.close();
  const auto rises = [](const ex::recorded& r) {
    return r["force N"].back() > r["force N"].front();
  };
  const auto falls = [rises](const ex::recorded& r) { return !rises(r); };
  const auto by = [](double least) {
    return [=](const ex::recorded& r) { return ex::at_least(ex::swing(r["force N"]), least); };
  };
  // Words that claim nothing and are not called a definition are no clause, and do not compile.
  static_assert(!std::is_constructible_v<ex::clause, std::string>);
  static_assert(!std::is_constructible_v<ex::clause, std::string, std::string>);
  static_assert(!std::is_constructible_v<ex::clause, std::string, std::string, std::nullptr_t>);
  static_assert(std::is_constructible_v<ex::clause, std::string, std::string, decltype(rises)>);
  const auto said = [&out](ex::clauses all, const char* commands = "plot x", ex::truth is = {}) {
    const std::size_t before = out.untrue().size();
    out.plot("line", {"A line", std::move(all), std::move(is)}, commands);
    return std::vector(out.untrue().begin() + static_cast<std::ptrdiff_t>(before),
                       out.untrue().end());
  };
  using wrong = std::vector<std::string>;
  const ex::clause so{"It rises", "line.csv", rises};
  constexpr int so_at = __LINE__ - 1;
  CHECK(said({so, {"by 6 N.", "line.csv", by(6.0)}}).empty());
  CHECK(said({so, {"by 7 N.", "line.csv", by(7.0)}}) ==
        wrong{"the caption of line is not so: \"by 7 N.\" (6, at least 7)"});
  CHECK(said({so, {"It falls.", "line.csv", falls}}) ==
        wrong{"the caption of line is not so: \"It falls.\""});
  CHECK(said({so, {"Nothing falls.", [] { return false; }}}) ==
        wrong{"the caption of line is not so: \"Nothing falls.\""});
  CHECK(said({ex::definition("It is there.")}) == wrong{"the caption of line claims nothing"});
  out.section("A table", {{"It falls.", "line.csv", falls}, so});
  CHECK(out.untrue().back() == "the text of A table is not so: \"It falls.\"");
  CHECK(ex::conclude(out, "program", "title", "", {}) == 1);
  const std::string json = text_of(folder / "results.json"), page = text_of(folder / "index.html");
  for (const std::string& what : std::vector<std::string>{
           "by 6 N.", "so (6, at least 6)", "NOT SO (6, at least 7)", "definition",
           "tests/experiments/report.cpp:" + std::to_string(so_at), "line.csv"}) {
    INFO(what);
    CHECK(mentions(json, what));
    CHECK(mentions(page, what));
  }
  CHECK(mentions(page, "It rises by 6 N."));

  const ex::recorded read(folder / "line.csv");
  CHECK(read.within("force N", 0.5, 1.5) == std::vector<double>{3.0});
  CHECK(ex::largest_step(read["force N"]) == 3.0);
  CHECK(std::isnan(read["what"].front()));
  CHECK_THROWS(read["depth mm"]);
  CHECK_THROWS(ex::recorded(folder / "wave.csv"));
}

TEST_CASE("a force whose axis hides 0, or whose truth is not drawn, fails the program",
          "[report]") {
  const scratch_folder folder;
  ex::report out(folder.path());
  ex::csv_file csv(out.path("line.csv"), "s,force N,the wall,half");
  for (const double s : {0.0, 1.0, 2.0}) csv.row(s, 3.0 * s, 4.0 * s, s > 1.0 ? std::nan("") : s);
  csv.close();
  const ex::truth wall{"line.csv", "the wall", "the wall's own force"};
  const auto drawn = [&out](const std::string& set, ex::truth is = {}, ex::clauses more = {}) {
    const std::size_t before = out.untrue().size();
    more.push_back(rising);
    out.plot("line", {"A line", std::move(more), std::move(is)}, set + "plot 'line.csv' using 1:2");
    return std::vector(out.untrue().begin() + static_cast<std::ptrdiff_t>(before),
                       out.untrue().end());
  };
  using wrong = std::vector<std::string>;
  const wrong hides{"line: the axis of the force does not begin at 0"},
      lies{"line: a force is drawn without the truth"}, blank{"line: its truth cannot be drawn"};
  const std::string force = "set ylabel 'force [N]'\n", from_0 = "set yrange [0:*]\n";
  CHECK(drawn(force + from_0, wall).empty());
  CHECK(mentions(text_of(folder / "line.gp"), "plot 'line.csv' using 1:(column(\"the wall\"))"));
  CHECK(drawn(force, wall) == hides);
  CHECK(drawn(force + "set yrange [-3:-1]\n", wall) == hides);
  CHECK(drawn(force + "set yrange [-3:1]\n", wall).empty());
  CHECK(drawn("set y2label 'torque [N·m]'\n" + from_0, wall) == hides);  // the other axis does

  CHECK(drawn(force + from_0) == lies);
  CHECK(drawn("set ylabel 'N'\nset xlabel 's'\n" + from_0) == lies);
  CHECK(drawn("set ylabel 'depth [mm]'\nset y2label 'force'\nset y2range [0:3]\n") == lies);
  CHECK(drawn(force + from_0, {}, {ex::definition("There is no wall.")}) == lies);
  CHECK(drawn(force + from_0, {}, {ex::no_truth("there is no wall.")}).empty());
  CHECK(drawn(force + from_0, {"line.csv", "half", "it ends"}) == blank);
  CHECK_THROWS(drawn(force + from_0, {"line.csv", "a wall", "of another name"}));
  for (const char* other :
       {"set ylabel 'rms force error [N]'\nset yrange [0:*]\n", "set ylabel 'energy [J]'\n",
        "set ylabel 'stiffness [N/m]'\n", "set logscale xy\nset ylabel 'N'\n"}) {
    INFO(other);
    CHECK(drawn(other).empty());
  }
  if (!out.finish("title")) WARN("gnuplot is not installed, or did not draw: left out");
  const std::string page = text_of(folder / "index.html");
  CHECK(mentions(page, "Grey is the truth: the wall's own force."));
  CHECK(mentions(page, "No truth is drawn: there is no wall."));
  CHECK(mentions(page, "Both axes are logarithmic."));
  CHECK(ex::conclude(out, "program", "title", "", {}) == 1);
}

TEST_CASE("a plot has no ground of its own and is readable in both schemes", "[report]") {
  const scratch_folder folder;
  ex::report out(folder.path());
  out.plot("line", {"Line & dot", {rising}}, "plot x lt 1, 2*x lt -1");
  if (!out.finish("title")) {
    WARN("gnuplot is not installed, or did not draw: left out");
    return;
  }
  const std::string svg = text_of(folder / "line.svg");
  CHECK(mentions(svg, "<title>Line &amp; dot</title>"));
  CHECK(mentions(svg, "prefers-color-scheme:dark"));
  CHECK(mentions(svg, "<rect x=\"0\" y=\"0\" width=\"760\" height=\"430\" fill=\"none\"/>"));
  CHECK(mentions(svg, "stroke='black'"));  // lt -1, which the style turns into ink
}

TEST_CASE("text and curves stand out from the page, light and dark", "[report]") {
  for (const bool dark : {false, true}) {
    for (const char* ground : {"paper", "raised"}) {
      const std::string paper = variable(ground, dark);
      INFO((dark ? "dark " : "light ") << ground << " " << paper);
      CHECK(contrast(variable("ink", dark), paper) >= 7.0);
      CHECK(contrast(variable("soft", dark), paper) >= 4.5);
      CHECK(contrast(variable("link", dark), paper) >= 4.5);
      const std::string preamble = ex::plot_preamble;
      int colours = 0;
      for (auto at = preamble.find('#'); at != std::string::npos; at = preamble.find('#', at + 1)) {
        INFO(preamble.substr(at, 7));
        CHECK(contrast(preamble.substr(at, 7), paper) >= 3.0);
        ++colours;
      }
      CHECK(colours == 8);
    }
  }
  CHECK(contrast("#fff", "#777777") < 4.5);  // the control
}

TEST_CASE("a program says last what has failed, a line each, and leaves it in its file",
          "[report]") {
  const scratch_folder folder;
  ex::failures found;
  ex::expect(found, true, "holds");
  ex::expect(found, false, "one, of two");
  ex::expect(found, false, "the other");
  const auto end = [&folder](const ex::failures& what) {
    ex::report out(folder / "", {.json = "all.json", .markdown = "all.md"});
    return programs::quietly([&] { return ex::conclude(out, "judge", "Title", "", what); });
  };
  const auto failed = end(found);
  CHECK(failed.code == 1);
  CHECK(failed.complaint == "judge: FAILED, 2 in all:\n  one, of two\n  the other\n");
  CHECK(mentions(programs::content(folder / "all.json"), "\"one, of two\""));
  const auto well = end({});
  CHECK(well.code == 0);
  CHECK(well.complaint.empty());
  CHECK(mentions(programs::content(folder / "all.json"), "\"failures\": ["));
  CHECK_FALSE(mentions(programs::content(folder / "all.json"), "of two"));
}
