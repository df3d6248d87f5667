// SPDX-License-Identifier: BSD-3-Clause
// The replay program, on a recording that the simulator makes, on descriptions, and on what it refuses.
#include "../bench/replay/program.hpp"
#include "programs.hpp"
#include "support/catch.hpp"

using namespace programs;

namespace {

outcome run_quietly(const std::vector<std::string>& arguments) {
  const std::atomic<bool> stop = false;
  return quietly([&] { return replaying::run(arguments, stop); });
}
std::string description(double by) {
  return "{\"passive_haptics_device\": 1, \"name\": \"drive\", \"kind\": \"encoder\", \"mass\": "
         "90, \"damping\": " +
         std::to_string(200.0 * by) + ", \"friction\": " + std::to_string(20.0 * by) +
         ", \"presliding\": 20e-6, \"quantum\": 50e-9, \"force_limit\": 160}";
}

}  // namespace

TEST_CASE("the replay program writes its page, and refutes a description that says too much",
          "[replay]") {
  const scratch_folder out;
  REQUIRE(run_quietly({"--out", out / "page"}).code == 0);
  const std::string page = content(out / "page/replay.md");
  CHECK(page.find("| mass | 95 |") != std::string::npos);
  CHECK(content(out / "page/replay.json").find("\"trials\"") != std::string::npos);
  std::ofstream(out / "true.json") << description(1.0);
  std::ofstream(out / "false.json") << description(1.1);
  CHECK(run_quietly({"--told", out / "true.json", "--out", out / "page"}).code == 0);
  const auto refuted = run_quietly({"--told", out / "false.json", "--out", out / "page"});
  CHECK(refuted.code == 1);
  CHECK(refuted.complaint.find("false.json is refuted in row") != std::string::npos);
}

TEST_CASE("the replay program says what it cannot read, and skips what is not there", "[replay]") {
  const scratch_folder out;
  CHECK(run_quietly({"--read", out / "nothing.csv"}).code == 0);
  std::ofstream(out / "short.csv") << "time,position,force\n0,0,0\n";
  const auto refused = run_quietly({"--read", out / "short.csv"});
  CHECK(refused.code == 1);
  CHECK(refused.complaint.find("row 1: the recording ends here") != std::string::npos);
  CHECK(run_quietly({"--tick", "-1"}).code == 2);
  CHECK(run_quietly({"--drift", "1"}).complaint.find("drift = 1, must be in [0, 1)") !=
        std::string::npos);
  CHECK(run_quietly({"--help"}).code == 0);
}
