// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <charconv>

namespace controllers {

namespace {

std::string names_of_sections() {
  std::string names;
  for (const auto& section : sections())
    names += (names.empty() ? "" : ", ") + std::string(section.name);
  return names;
}

constexpr const char* usage =
    "\nusage: controllers [--quick] [--out DIR] [--only SECTION,...] [--seeds N] [--runs N]\n"
    "                   [--threads N] [--shard I/N | --merge FILE...]\n"
    "  --quick        small: fewer seeds, runs and grid points\n"
    "  --out DIR      where the results go (default: controllers)\n"
    "  --only LIST    of the sections, with commas between (default: all)\n"
    "  --seeds N      random schedules per scene (default: 10, quick 3)\n"
    "  --runs N       per adversary and dimension (default: 1000, quick 30)\n"
    "  --threads N    (default: as many as the machine has)\n"
    "  --shard I/N    only the I-th of N parts of the Z-width sweep\n"
    "  --merge FILES  joins parts that --shard wrote, and draws them";

[[noreturn]] void complain(const std::string& what) {
  throw std::invalid_argument(what + usage);
}

int number(const std::string& name, const std::string& text, int least) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end || value < least) {
    complain(name + " " + text + ": give a whole number of at least " + std::to_string(least));
  }
  return value;
}

shard part(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos) complain("--shard " + text + ": give I/N, such as 2/8");
  const shard s{number("--shard", text.substr(0, slash), 1),
                number("--shard", text.substr(slash + 1), 1)};
  if (s.part > s.of) complain("--shard " + text + ": there are only " + std::to_string(s.of));
  return s;
}

std::vector<std::string> some_sections(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, ',');) {
    const auto is = [&name](const section& s) { return name == s.name; };
    if (std::none_of(sections().begin(), sections().end(), is)) {
      complain("--only " + name + ": there are " + names_of_sections());
    }
    list.push_back(name);
  }
  if (list.empty()) complain("--only: name some of " + names_of_sections());
  return list;
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  bool sharded = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    const auto value = [&]() -> const std::string& {
      const bool missing = i + 1 == arguments.size() || arguments[i + 1].rfind("--", 0) == 0;
      if (missing) complain(name + ": its value is missing");
      return arguments[++i];
    };
    if (name == "--quick") {
      chosen.quick = true;
    } else if (name == "--out") {
      chosen.out = value();
    } else if (name == "--only") {
      chosen.only = some_sections(value());
    } else if (name == "--seeds") {
      chosen.seeds = number(name, value(), 1);
    } else if (name == "--runs") {
      chosen.runs = number(name, value(), 1);
    } else if (name == "--threads") {
      chosen.threads = number(name, value(), 1);
    } else if (name == "--shard") {
      chosen.part = part(value());
      sharded = true;
    } else if (name == "--merge") {
      chosen.merge.push_back(value());
      while (i + 1 < arguments.size() && arguments[i + 1].rfind("--", 0) != 0) {
        chosen.merge.push_back(arguments[++i]);
      }
    } else {
      complain(name + ": no such option");
    }
  }
  if (sharded && !chosen.merge.empty()) complain("--merge joins what --shard wrote: give one");
  if (sharded && chosen.only.empty()) chosen.only = {"z_width"};
  if (sharded && chosen.only != std::vector<std::string>{"z_width"}) {
    complain("--shard splits z_width alone: leave --only out");
  }
  if (chosen.seeds == 0) chosen.seeds = chosen.quick ? 3 : 10;
  if (chosen.runs == 0) chosen.runs = chosen.quick ? 30 : 1000;
  if (chosen.threads == 0) {
    chosen.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  return chosen;
}

}  // namespace controllers
