// SPDX-License-Identifier: BSD-3-Clause
// The program that touches walls on encoders: it must find a liar, write what it says it writes, and
// understand its arguments.
#include "../bench/encoders/program.hpp"
#include "programs.hpp"
#include "support/catch.hpp"

namespace ph = passive_haptics;
namespace design = passive_haptics::design;
using namespace programs;

namespace {

outcome run_quietly(const std::vector<std::string>& arguments,
                    const std::vector<encoders::composition>& judged) {
  const std::atomic<bool> never = false;
  return quietly([&] { return encoders::run(arguments, judged, never); });
}
/// Pushes with 1 N the way the device goes.
struct pusher {
  double last = 0.0;
  ph::half_space<encoders::line> surface{};
  bool update(const ph::half_space<encoders::line>& /*next*/) { return true; }
  ph::tick_result<encoders::line> tick(const ph::device_sample<encoders::line>& sample) {
    const double way = sample.position - last;
    last = sample.position;
    return {way > 0.0 ? 1.0 : -1.0, 0.0, 0.0};
  }
  const ph::half_space<encoders::line>& local() const { return surface; }
  double energy() const { return 0.0; }
  ph::parameter_fault check() const { return {}; }
};

}  // namespace

TEST_CASE("gentle touches tell a wall that stays from one that the hand sinks through",
          "[encoders]") {
  const scratch_folder out;
  const outcome found = run_quietly({"--quick", "--only", "gentle_touch", "--out", out / ""},
                                    encoders::compositions());
  CHECK(found.code == 0);
  const std::string json = content(out / "encoders.json");
  for (const char* key : {"gentle_touch", "device", "stiffness", "presliding_um", "composition",
                          "budget", "share_080", "median_ratio", "first_three_ratio",
                          "least_energy_J", "floor_Kq_N", "quiet", "rest_step_N"}) {
    CAPTURE(key);
    CHECK(json.find('"' + std::string(key) + '"') != std::string::npos);
  }
  const std::string table = content(out / "gentle_touch.csv");
  const auto share_of = [&table](const std::string& composition) {  // on a Touch at 10 kN/m
    const std::string start = "\"Touch\",10000,0,\"" + composition + "\",";
    const auto at = table.find(start);
    double budget = 0.0, share = -1.0;
    char comma = 0;
    if (at != std::string::npos) {
      std::istringstream(table.substr(at + start.size())) >> budget >> comma >> share;
    }
    return share;
  };
  const double counted = share_of("quantised energy"), unbounded = share_of("unbounded");
  CHECK(unbounded >= 0.75);  // the wall is there to be felt
  CHECK(counted >= 0.0);
  CHECK(counted < 0.25);  // and a starved ledger lets the hand through
  CHECK(share_of("dual ledger") == 1.0);
}

TEST_CASE("a composition that promises what it does not keep on encoders fails the run",
          "[encoders]") {
  const scratch_folder out;
  const encoders::composition liar{
      .name = "liar",
      .make = [](const design::stated_device&, double) { return encoders::wall(pusher{}); }};
  const outcome found = run_quietly({"--quick", "--only", "endurance", "--out", out / ""}, {liar});
  CHECK(found.code == 1);
  CHECK(found.complaint.find("liar, Touch, kneading, presliding 0 µm: lost") != std::string::npos);
  auto honest = liar;
  honest.promises = false;
  CHECK(run_quietly({"--quick", "--only", "endurance", "--out", out / ""}, {honest}).code == 0);
}

TEST_CASE("the encoder program says what it does not understand", "[encoders]") {
  CHECK(run_quietly({"--only", "nothing"}, {}).code == 2);
  CHECK(run_quietly({"--only", ""}, {}).code == 2);
  CHECK(run_quietly({"--nonsense"}, {}).code == 2);
  CHECK(run_quietly({"--help"}, {}).code == 0);
}
