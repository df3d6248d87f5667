// SPDX-License-Identifier: BSD-3-Clause
// README and docs say nothing that programs and tests do not: code blocks stand in the examples, figures
// are printed by the programs, every test that is named exists, and so does every file that is linked.
// The quick start is tried by quick_start.cmake.
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/base/event.hpp>
#include <passive_haptics/base/version.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

const std::filesystem::path root = PASSIVE_HAPTICS_ROOT;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  REQUIRE(stream.good());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

struct block {
  std::string source;
  std::string text;
};

/// The fenced blocks of a page that stand under `<!-- MARK: source -->`.
std::vector<block> blocks(const std::string& mark, const std::filesystem::path& page) {
  std::istringstream lines(text_of(page));
  std::vector<block> found;
  const std::string opening = "<!-- " + mark + ": ";
  std::string line;
  while (std::getline(lines, line)) {
    if (line.rfind(opening, 0) != 0) continue;
    block b{line.substr(opening.size(), line.size() - opening.size() - 4), ""};
    std::getline(lines, line);
    REQUIRE(line.rfind("```", 0) == 0);
    while (std::getline(lines, line) && line != "```") b.text += line + "\n";
    found.push_back(b);
  }
  return found;
}

/// How many characters of UTF-8: its bytes that carry none on.
std::ptrdiff_t characters(const std::string& line) {
  return std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

/// The same words; numbers within 2 %, because compilers round differently.
bool agree(const std::string& a, const std::string& b) {
  const auto left = words(a), right = words(b);
  if (left.size() != right.size()) return false;
  for (std::size_t i = 0; i < left.size(); ++i) {
    char *end_left = nullptr, *end_right = nullptr;
    const double x = std::strtod(left[i].c_str(), &end_left);
    const double y = std::strtod(right[i].c_str(), &end_right);
    const bool numbers = *end_left == '\0' && *end_right == '\0';
    if (numbers ? std::abs(x - y) > 0.02 * std::abs(y) + 1e-9 : left[i] != right[i]) return false;
  }
  return true;
}

/// One of the repository's pages, and not of a build inside it.
bool documented(const std::filesystem::path& page) {
  const auto inside = page.lexically_relative(root);
  return inside.parent_path().empty() || *inside.begin() == "docs" || *inside.begin() == "examples";
}

}  // namespace

TEST_CASE("the code of every page stands in the file that it names", "[documentation]") {
  std::size_t compared = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".md" || !documented(entry.path())) continue;
    const auto code = blocks("from", entry.path());
    const auto name = entry.path().lexically_relative(root);
    if (name == "README.md" || name == "docs/adapters.md") CHECK_FALSE(code.empty());
    for (const auto& b : code) {
      INFO(name << ", from " << b.source << "\n" << b.text);
      CHECK(text_of(root / b.source).find(b.text) != std::string::npos);
    }
    compared += code.size();
  }
  CHECK(compared > 12);
}

namespace {
/// The words of a page, outside of its blocks of code and its comments.
std::size_t prose(const std::string& page) {
  std::istringstream lines(page);
  std::size_t count = 0;
  bool fenced = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0)
      fenced = !fenced;
    else if (!fenced && line.rfind("<!--", 0) != 0)
      count += words(line).size();
  }
  return count;
}
/// Of a page, how many blocks are a program from its first line of code to its last.
std::size_t whole_programs(const std::filesystem::path& page) {
  std::size_t count = 0;
  for (const auto& b : blocks("from", page)) {
    const std::string file = text_of(root / b.source);
    const auto at = file.find(b.text);
    if (at == std::string::npos || at + b.text.size() != file.size()) continue;
    std::istringstream before(file.substr(0, at));
    bool comments = true;
    for (std::string line; std::getline(before, line);)
      comments = comments && (line.empty() || line.rfind("//", 0) == 0);
    if (comments && b.text.find("ain(") != std::string::npos) ++count;
  }
  return count;
}
}  // namespace

TEST_CASE("a task is a whole program and a few words, and README is 1500", "[documentation]") {
  std::size_t tasks = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root / "docs" / "tasks")) {
    INFO(entry.path());
    const std::string page = text_of(entry.path());
    CHECK(whole_programs(entry.path()) == 1);
    CHECK(prose(page) <= 270);  // with some 25 lines of code: one screen
    CHECK(std::count(page.begin(), page.end(), '\n') <= 65);
    CHECK(page.find("numbers") != std::string::npos);
    CHECK(page.find("**Next**") != std::string::npos);
    ++tasks;
  }
  CHECK(tasks >= 7);
  CHECK(words(text_of(root / "README.md")).size() <= 1500);  // code and tables included
  CHECK(whole_programs(root / "docs" / "loop.md") == 0);     // the controls: pieces only, and long
  CHECK(prose(text_of(root / "docs" / "loop.md")) > 270);
}

TEST_CASE("the page of events has a row for each, with its number", "[documentation]") {
  const auto rows = [](const std::string& page) {
    std::istringstream lines(page.substr(page.find("<!-- events -->")));
    std::vector<std::string> all;
    const std::regex row(R"(\| `([a-z_]+)` \| ([0-9]+) \| [^|]+ \| [^|]+ \| .*\|)");
    std::smatch cells;
    for (std::string line; std::getline(lines, line) && (line.empty() || line[0] != '#');) {
      if (std::regex_match(line, cells, row)) all.push_back(cells[2].str() + " " + cells[1].str());
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  std::vector<std::string> known;
  for (int i = 0;; ++i) {
    std::string text = to_string(static_cast<passive_haptics::event>(i));
    if (text == "unknown event") break;
    std::replace(text.begin(), text.end(), ' ', '_');
    known.push_back(std::to_string(i) + " " + text);
  }
  std::sort(known.begin(), known.end());
  CHECK(known.size() == 17);
  std::string page = text_of(root / "docs" / "events.md");
  CHECK(rows(page) == known);
  page.erase(page.find("| `debt`"), 3);
  CHECK(rows(page) != known);  // the control
}

TEST_CASE("the tutorial's figures are what its programs print", "[documentation]") {
  const auto figures = blocks("printed by", root / "docs" / "tutorial.md");
  CHECK(figures.size() >= 4);
  const std::string registered = text_of(root / "examples" / "CMakeLists.txt");
  for (const auto& b : figures) {  // that the text is what is printed, the test of the program says
    INFO(b.source << "\n" << b.text);
    const auto source = root / b.source;
    CHECK(text_of(std::filesystem::path(source).replace_extension(".txt")).find(b.text) !=
          std::string::npos);
    CHECK(registered.find(source.stem().string()) != std::string::npos);
    CHECK(text_of(source).find(b.text) == std::string::npos);  // the control
  }
}

TEST_CASE("README's figures are what the programs print", "[documentation]") {
  const scratch_folder folder;
  const std::string command = std::string("\"") + PASSIVE_HAPTICS_EXPERIMENTS + "\" --out \"" +
                              (folder / "out") + "\" > \"" + (folder / "printed.txt") +
                              "\" 2> /dev/null";
  REQUIRE(std::system(command.c_str()) == 0);
  std::vector<std::string> printed;
  std::istringstream output(text_of(folder / "printed.txt"));
  for (std::string line; std::getline(output, line);) printed.push_back(line);
  const auto figures = blocks("printed by", root / "README.md");
  REQUIRE_FALSE(figures.empty());
  for (const auto& b : figures) {
    if (b.source != "thesis_experiments") {  // an example: a test compares it with its text
      INFO(b.source << "\n" << b.text);
      CHECK(text_of((root / b.source).replace_extension(".txt")).find(b.text) != std::string::npos);
      continue;
    }
    std::istringstream lines(b.text);
    for (std::string line; std::getline(lines, line);) {
      bool found = false;
      for (const auto& p : printed) found = found || agree(line, p);
      INFO(line);
      CHECK(found);
    }
  }
  for (const auto& line : printed) {                // a terminal shows the tables as tables
    if (line.rfind("results: ", 0) == 0) continue;  // a path, as long as it is
    INFO(line);
    CHECK(characters(line) <= 100);
  }
  CHECK(std::filesystem::exists(folder / "out/results.json"));
  CHECK(std::filesystem::exists(folder / "out/index.html"));
  CHECK_FALSE(agree("S0 none 64.979", "S0 none 60.0"));  // the controls
  CHECK_FALSE(agree("S0 none", "S0 thesis"));
  CHECK(agree("S0 none 64.979", "S0 none 65.0"));
}

TEST_CASE("thesis_experiments refuses a broken mesh with file, line and remedy, and writes nothing",
          "[documentation]") {
  const scratch_folder folder;
  const auto complaint = [&folder](const std::string& arguments) {
    const std::string command = std::string("\"") + PASSIVE_HAPTICS_EXPERIMENTS + "\" --out \"" +
                                (folder / "out") + "\" " + arguments + " > /dev/null 2> \"" +
                                (folder / "said.txt") + "\"";
    CHECK(std::system(command.c_str()) != 0);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
    return text_of(folder / "said.txt");
  };
  const auto mesh = [&folder](const std::string& content) {
    std::ofstream(folder / "mesh.msh") << content;
    return "--mesh \"" + (folder / "mesh.msh") + "\"";
  };
  const std::string nodes = "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$ENDNOD\n";
  CHECK(complaint(mesh(nodes + "$ELM\n1\n1 4 1 1 4 1 2 3 9\n$ENDELM\n")).find("mesh.msh:10") !=
        std::string::npos);  // a node that is not there
  CHECK(complaint(mesh(nodes + "$ELM\n2\n1 4 1 1 4 1 2 3 4\n")).find("mesh.msh:") !=
        std::string::npos);  // cut off
  CHECK(complaint(mesh("solid ascii\n")).find("mesh.msh:1") != std::string::npos);
  CHECK(complaint("--mesh \"" + (folder / "nowhere.msh") + "\"").find("nowhere.msh") !=
        std::string::npos);
  CHECK(complaint("--seeds 0").find("--seeds 0") != std::string::npos);
  CHECK(complaint("--sedes 5").find("--sedes") != std::string::npos);
  CHECK(complaint("--seeds").find("usage") != std::string::npos);
}

TEST_CASE("thesis_experiments explains itself when asked, and runs nothing", "[documentation]") {
  const scratch_folder folder;
  const std::string command = std::string("\"") + PASSIVE_HAPTICS_EXPERIMENTS + "\" --out \"" +
                              (folder / "out") + "\" --help > \"" + (folder / "said.txt") + "\"";
  CHECK(std::system(command.c_str()) == 0);
  const std::string said = text_of(folder / "said.txt");
  for (const char* option : {"--out", "--seeds", "--mesh", "--unit"}) {
    CHECK(said.find(option) != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("every test that the documents name exists", "[documentation]") {
  std::string tests;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "tests")) {
    if (entry.path().extension() == ".cpp") tests += text_of(entry.path());
  }
  int named = 0;
  for (const char* page : {"README.md", "docs/guarantees.md", "docs/design/audit.md"}) {
    std::istringstream lines(text_of(root / page));
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("|", 0) != 0) continue;  // titles are quoted in tables
      for (std::size_t at = line.find('"'); at != std::string::npos;) {
        const std::size_t end = line.find('"', at + 1);
        REQUIRE(end != std::string::npos);
        const std::string title = line.substr(at, end - at + 1);
        INFO(page << ": " << title);
        if (title.size() > 20) {  // shorter ones quote the thesis
          CHECK(tests.find(title) != std::string::npos);
          ++named;
        }
        at = line.find('"', end + 1);
      }
    }
  }
  CHECK(named > 35);
  CHECK(tests.find("\"no such "
                   "test title anywhere\"") == std::string::npos);  // the control
}

TEST_CASE("every file that a page links to exists", "[documentation]") {
  int linked = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const auto& page = entry.path();
    if (page.extension() != ".md" || !documented(page)) continue;
    const std::string text = text_of(page);
    for (auto at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
      const std::string link = text.substr(at + 2, text.find_first_of(")#", at) - at - 2);
      const bool elsewhere = link.find("://") != std::string::npos;
      if (link.empty() || elsewhere || link.find(' ') != std::string::npos)
        continue;  // or a lambda
      INFO(page << ": " << link);
      CHECK(std::filesystem::exists(page.parent_path() / link));
      ++linked;
    }
  }
  CHECK(linked > 60);
  CHECK_FALSE(std::filesystem::exists(root / "docs" / "nowhere.md"));  // the control
}

TEST_CASE("every example is named where a newcomer looks for it", "[documentation]") {
  const std::string list = text_of(root / "examples" / "README.md");
  for (const char* folder : {"examples", "examples/adapters"}) {
    for (const auto& entry : std::filesystem::directory_iterator(root / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const auto link = entry.path().lexically_relative(root / "examples").generic_string();
      INFO(link);
      CHECK(list.find("(" + link + ")") != std::string::npos);
    }
  }
}

namespace {
/// The first composition of `text` that is outside the family of compositions.hpp and has no "by hand" and a reason
/// within so many characters before it; empty if all have.
std::string unexplained(const std::string& text, std::size_t within) {
  static const std::regex composed("(local_model|passive_port)( [a-z_]+)?\\{");
  for (std::sregex_iterator at(text.begin(), text.end(), composed), end; at != end; ++at) {
    const auto place = static_cast<std::size_t>(at->position());
    const std::size_t from = place > within ? place - within : 0;
    const std::string before = text.substr(from, place - from);
    if (before.find("y hand: ") == std::string::npos) return at->str();
  }
  return "";
}
}  // namespace

TEST_CASE("there is one recommendation, and what is composed otherwise says why",
          "[documentation]") {
  CHECK(unexplained("auto t = ph::make_touch<scene>(device, hand);", 600).empty());
  CHECK(unexplained("// By hand: the bound alone.\nph::local_model wall{scene{}};", 600).empty());
  CHECK(unexplained("ph::local_model wall{scene{}};", 600) == "local_model wall{");  // the control
  CHECK(unexplained("// By hand: x.\n" + std::string(700, ' ') + "ph::passive_port{}", 600) ==
        "passive_port{");
  std::vector<std::filesystem::path> pages{root / "README.md"};
  for (const char* folder : {"docs", "examples"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const auto kind = entry.path().extension();
      if (kind == ".md" || kind == ".cpp" || kind == ".hpp") pages.push_back(entry.path());
    }
  }
  CHECK(pages.size() > 50);
  for (const auto& page : pages) {
    if (page.filename() == "errors.md") continue;  // what does not compile
    CAPTURE(page.string());
    const bool prose = page.extension() == ".md";  // a program says it once
    CHECK(unexplained(text_of(page), prose ? 600 : std::string::npos).empty());
  }
}

TEST_CASE("the version has one home", "[documentation]") {
  const std::string version = std::to_string(passive_haptics::version_major) + "." +
                              std::to_string(passive_haptics::version_minor) + "." +
                              std::to_string(passive_haptics::version_patch);
  CHECK(version == PASSIVE_HAPTICS_VERSION);
}
