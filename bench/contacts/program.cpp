// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

namespace contacts {

const std::vector<section>& sections() {
  static const std::vector<section> all{
      {"settling", run_settling}, {"touch", run_touch},       {"news", run_news},
      {"curved", run_curved},     {"friction", run_friction}, {"static", run_static},
      {"passive", run_passive},   {"rigid", run_rigid},       {"tool", run_tool}};
  return all;
}

namespace {

std::string names() {
  std::string all;
  for (const auto& s : sections()) all += (all.empty() ? "" : ", ") + std::string(s.name);
  return all;
}

std::vector<std::string> some_sections(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, ',');) {
    const auto is = [&name](const section& s) { return name == s.name; };
    if (std::none_of(sections().begin(), sections().end(), is)) {
      ex::complain("--only " + name + ": there are " + names());
    }
    list.push_back(name);
  }
  if (list.empty()) ex::complain("--only: name some of " + names());
  return list;
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen;
  ex::read_options(
      "contacts",
      {ex::a_switch("--quick", "fewer cases and seconds", chosen.quick),
       ex::a_text("--out DIR", "where the results go (default: contacts)", chosen.out),
       {"--only LIST", "of the sections, with commas between (default: all)",
        [&](const std::string& text) { chosen.only = some_sections(text); }},
       ex::a_number("--threads", "(default: as many as the machine has)", chosen.threads)},
      arguments);
  return chosen;
}

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("contacts", [&] {
    const settings chosen = parse(arguments);
    ex::report report(chosen.out, {.json = "contacts.json", .markdown = "contacts.md"});
    const session s{{report, ex::threads_of(chosen.threads), stop}, chosen};
    ex::failures found;
    for (const auto& part : sections()) {
      const auto& only = chosen.only;
      if (!only.empty() && std::find(only.begin(), only.end(), part.name) == only.end()) continue;
      for (auto& sentence : part.run(s)) found.push_back(std::move(sentence));
    }
    return ex::conclude(report, "contacts", "passive_haptics: every contact",
                        "Corners, rough planes, curved surfaces and rigid tools: do several "
                        "contacts at once settle, step, creep or lose energy?",
                        found);
  });
}

}  // namespace contacts
