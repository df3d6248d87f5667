// SPDX-License-Identifier: BSD-3-Clause
// The program that tries several contacts at once: all its promises hold in a first look, its controls lose, and it
// understands its arguments.
#include "../bench/contacts/program.hpp"
#include "programs.hpp"
#include "support/catch.hpp"

using namespace programs;

namespace {

outcome run_quietly(const std::vector<std::string>& arguments) {
  const std::atomic<bool> never = false;
  return quietly([&] { return contacts::run(arguments, never); });
}

}  // namespace

TEST_CASE("contacts keep every promise in a first look, and what stands beside them does not",
          "[contacts]") {
  const scratch_folder out;
  const outcome found = run_quietly({"--quick", "--out", out / ""});
  INFO(found.complaint);
  CHECK(found.code == 0);  // the controls among them: one that loses nothing is a failure
  const std::string json = content(out / "contacts.json");
  for (const char* key :
       {"quiet",       "quiet_late",  "quiet_tool",   "settling",        "touch",   "news",
        "greedy_news", "heart",       "stroke",       "loops",           "drift",   "stick_slip",
        "stopping",    "cone",        "static",       "passive",         "rigid",   "tool",
        "guards",      "guards_sums", "guards_drops", "guards_encoders", "failures"}) {
    CAPTURE(key);
    CHECK(json.find('"' + std::string(key) + '"') != std::string::npos);
  }
}

TEST_CASE("contacts names the sections that there are", "[contacts]") {
  CHECK(run_quietly({"--only", "nothing"}).code == 2);
  CHECK(run_quietly({"--only", ""}).code == 2);
  CHECK(run_quietly({"--help"}).code == 0);
}
