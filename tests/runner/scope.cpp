// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/runner/scope.hpp>
#include <passive_haptics/six_dof.hpp>

#include <clocale>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// The lines of a file, and the fields of a line.
std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> all;
  for (std::string line; std::getline(file, line);) all.push_back(line);
  return all;
}
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream rest(line + ",");
  for (std::string field; std::getline(rest, field, ',');) all.push_back(field);
  return all;
}
template <class Port, std::size_t N>
std::vector<std::string> saved(const ph::scope<Port, N>& seen) {
  const scratch_folder folder;
  REQUIRE(ph::save(seen, (folder / "scope.csv").c_str()));
  return lines_of(folder / "scope.csv");
}

/// A result with the tick's number in it.
ph::tick_result<d1> result(double n, ph::event what = ph::event::nominal) {
  return {.force = n, .depth = 0.0, .energy = 0.0, .what = what, .limited = false};
}
template <std::size_t N>
void record(ph::scope<d1, N>& seen, int from, int to) {
  for (int n = from; n < to; ++n) seen.record(0.0, 1ms, result(n));
}
template <std::size_t N>
std::vector<double> kept(const ph::scope<d1, N>& seen) {
  std::vector<double> all;
  for (std::size_t i = 0; i < seen.size(); ++i) all.push_back(seen[i].given);
  return all;
}

}  // namespace

TEST_CASE("a scope keeps the last ticks, the oldest first", "[runner][scope]") {
  ph::scope<d1, 4> seen;
  CHECK(seen.size() == 0);
  record(seen, 0, 3);
  CHECK(kept(seen) == std::vector{0.0, 1.0, 2.0});
  record(seen, 3, 10);
  CHECK(kept(seen) == std::vector{6.0, 7.0, 8.0, 9.0});
  CHECK(seen[0].tick == 6);
  CHECK(seen[0].time == Approx(7e-3));
  CHECK_FALSE(seen.frozen());
  seen.clear();
  CHECK(seen.size() == 0);
  record(seen, 20, 21);
  CHECK(seen[0].time == 1e-3);
}

TEST_CASE("a trigger keeps half of the ticks before an event and half from it on",
          "[runner][scope]") {
  ph::scope<d1, 8> seen{ph::event::late_tick};
  record(seen, 0, 20);
  seen.record(0.0, 1ms, result(20, ph::event::debt));  // less severe
  CHECK_FALSE(seen.triggered());
  seen.record(0.0, 1ms, result(21, ph::event::late_tick));
  CHECK(seen.triggered());
  CHECK(seen.triggered_at() == 21);
  record(seen, 22, 24);
  CHECK_FALSE(seen.frozen());
  seen.record(0.0, 1ms, result(24, ph::event::rejected_sample));  // the first one counts
  CHECK(seen.frozen());
  record(seen, 25, 99);
  CHECK(kept(seen) == std::vector{17.0, 18.0, 19.0, 20.0, 21.0, 22.0, 23.0, 24.0});
  CHECK(seen.triggered_at() == 21);
  seen.clear();
  CHECK_FALSE(seen.frozen());
  record(seen, 0, 50);
  CHECK_FALSE(seen.triggered());                            // armed again, and nothing happened
  seen.record(0.0, 1ms, result(50, ph::event::no_target));  // more severe does it, too
  CHECK(seen.triggered_at() == 50);
}

TEST_CASE("a scope is triggered by hand, early, or never", "[runner][scope]") {
  ph::scope<d1, 8> seen;
  record(seen, 0, 2);
  seen.record(0.0, 1ms, result(2, ph::event::rejected_parameters));
  CHECK_FALSE(seen.triggered());  // it was not told to look at events
  seen.trigger();
  record(seen, 3, 5);
  seen.trigger();  // it is already
  record(seen, 5, 99);
  CHECK(seen.frozen());
  CHECK(kept(seen) == std::vector{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  ph::scope<d1, 3> odd{ph::event::debt};
  record(odd, 0, 5);
  odd.record(0.0, 1ms, result(5, ph::event::debt));
  record(odd, 6, 9);
  CHECK(kept(odd) == std::vector{4.0, 5.0, 6.0});
}

TEST_CASE("a scope says what a tick knew, in columns with units", "[runner][scope]") {
  ph::scope<d3, 4> seen;
  ph::local_model wall{d3{},
                       ph::fixed{ph::half_space<d3>{{0, 0, 0}, {0, 0, 1}, 1000.0}},
                       ph::turn_at_once{},
                       ph::spring{},
                       thesis_ledger(),
                       ph::strict_bound{},
                       thesis_loop};
  std::vector<ph::tick_result<d3>> out;
  for (const double z : {1e-3, -1e-3, -1.0 / 300.0}) {
    out.push_back(wall.tick({0.1, -0.2, z}, 1ms));
    seen.record({0.1, -0.2, z}, 1ms, out.back());
  }
  seen.record({.position = d3::vector(1, 2, 3), .held = {}, .dt = 2e-3, .valid = false}, out[2],
              d3::vector(7, 8, 9));
  const auto lines = saved(seen);
  REQUIRE(lines.size() == 5);
  CHECK(lines[0] ==
        "tick,time_s,dt_s,position_x_m,position_y_m,position_z_m,wanted_x_N,wanted_y_N,wanted_z_N,"
        "given_x_N,given_y_N,given_z_N,depth_m,energy_J,limited,valid,event,event_text,"
        "asked_N_per_m,shown_N_per_m,softened_by,held_back_by");
  const auto first = fields_of(lines[3]), last = fields_of(lines[4]);
  REQUIRE(first.size() == 22);
  CHECK(first[18].empty());  // nobody asked why
  CHECK(first[21].empty());
  CHECK(first[0] == "2");
  CHECK(first[2] == "0.001");
  CHECK(first[3] == "0.1");
  CHECK(std::stod(first[5]) == -1.0 / 300.0);  // it comes back as it was
  CHECK(first[6].empty());                     // nobody told what was wanted
  CHECK(std::stod(first[11]) == out[2].force(2));
  CHECK(std::stod(first[12]) == out[2].depth);
  CHECK(std::stod(first[13]) == out[2].energy);
  CHECK(first[14] == "1");
  CHECK(first[15] == "1");
  CHECK(out[2].limited);
  CHECK(last[1] == "0.005");
  CHECK(last[6] == "7");
  CHECK(last[8] == "9");
  CHECK(last[15] == "0");
  CHECK(last[16] == "0");
  CHECK(last[17] == "nominal");
}

TEST_CASE("a scope works at every port, with what a port of any source returns",
          "[runner][scope]") {
  SECTION("force in, force out, in one float: no depth") {
    auto port = ph::make_strict_guard<f1>({0.03}, ph::actuator_limit{9.0}, 1e-3);
    ph::scope<f1, 4> seen;
    (void)port.tick(0.0F, 1ms, 1.0F);
    seen.record(0.1F, 1ms, port.tick(0.1F, 1ms, 1.1F), 1.1F);
    const auto lines = saved(seen);
    CHECK(lines[0] ==
          "tick,time_s,dt_s,position_m,wanted_N,given_N,depth_m,energy_J,limited,valid,event,"
          "event_text,asked_N_per_m,shown_N_per_m,softened_by,held_back_by");
    const auto row = fields_of(lines[1]);
    CHECK(row[3] == "0.1");  // the shortest that brings the float back
    CHECK(std::stof(row[4]) == 1.1F);
    CHECK(row[6].empty());
    CHECK(row[10] == "8");
    CHECK(row[11] == "rejected sample");  // 100 m/s
  }
  SECTION("joints") {
    using joints = ph::joint_space<double, 2>;
    ph::scope<joints, 2> seen;
    seen.record({1.5, 2.5}, 1ms, ph::port_result<joints>{.force = {3, 4}, .energy = 0});
    const auto lines = saved(seen);
    CHECK(lines[0].find("position_1_rad,position_2_rad,wanted_1_Nm") != std::string::npos);
    CHECK(fields_of(lines[1])[4] == "2.5");
    const scratch_folder folder;
    REQUIRE(ph::save(seen, (folder / "s.csv").c_str(), {.position = "m", .effort = "N"}));
    CHECK(lines_of(folder / "s.csv")[0].find("position_1_m,position_2_m,wanted_1_N") !=
          std::string::npos);
  }
  SECTION("a handle that turns") {
    using handle = ph::rigid_body<double>;
    ph::scope<handle, 2> seen;
    const handle::pose x{.position = d3::vector(1, 2, 3), .orientation = {0.6, 0.8, 0, 0}};
    handle::vector wrench;
    wrench << 1, 2, 3, 4, 5, 6;
    seen.record(x, 1ms, ph::port_result<handle>{.force = wrench, .energy = 0});
    const auto lines = saved(seen);
    const auto names = fields_of(lines[0]), row = fields_of(lines[1]);
    REQUIRE(names.size() == row.size());
    CHECK(names[6] == "orientation_w");
    CHECK(row[6] == "0.6");
    CHECK(names[16] == "given_x_N");
    CHECK(names[21] == "given_torque_z_Nm");
    CHECK(row[21] == "6");
  }
  SECTION("a stylus") {
    using pen = ph::stylus<float>;
    ph::scope<pen, 2> seen;
    seen.record(pen::pose{}, 1ms, ph::port_result<pen>{.force = {1, 2, 3}, .energy = 0});
    const auto lines = saved(seen);
    CHECK(fields_of(lines[0]).size() == fields_of(lines[1]).size());
    CHECK(lines[0].find("given_z_N,depth_m") != std::string::npos);
  }
}

TEST_CASE("a scope keeps what a port says of itself, in the row that is recorded next",
          "[runner][scope]") {
  ph::scope<d1, 8> seen;
  auto touch = ph::make_touch<d1>({.mass = 0.1, .damping = 0.1, .force_limit = 9}, {.force = 5});
  REQUIRE(touch.update({.point = 0, .normal = 1, .stiffness = 50e3}));
  const auto tick = [&](double x, bool asks) {
    const auto out = touch.tick(x, 1ms);
    if (asks) seen.explain(touch.explain());
    seen.record(x, 1ms, out);
  };
  tick(-1e-3, false);
  tick(-1e-3, true);
  tick(-1e-3, false);
  const auto lines = saved(seen);
  const auto before = fields_of(lines[1]), said = fields_of(lines[2]), after = fields_of(lines[3]);
  REQUIRE(said.size() == fields_of(lines[0]).size());
  const std::size_t n = said.size();
  CHECK(before[n - 4].empty());
  CHECK(after[n - 1].empty());
  CHECK(std::stod(said[n - 4]) == 50e3);
  CHECK(std::stod(said[n - 3]) == touch.explain().shown);
  CHECK(said[n - 2] == "mass and tick");
  CHECK(said[n - 1] == "started inside");
  CHECK(seen[1].now == ph::softened_by::started_inside);
  seen.explain(touch.explain());
  seen.clear();
  tick(-1e-3, false);
  CHECK_FALSE(seen[0].is_explained);
}

TEST_CASE("what is asked of a frozen scope changes no row", "[runner][scope]") {
  ph::scope<d1, 2> seen{ph::event::late_tick};
  seen.record(0.0, 1ms, result(1.0, ph::event::late_tick));
  REQUIRE(seen.frozen());
  seen.explain({.asked = 1.0});
  seen.record(0.0, 1ms, result(2.0));
  CHECK(seen.size() == 1);
  CHECK_FALSE(seen[0].is_explained);
}

TEST_CASE("a scope writes numbers that are none, and a point whatever the language",
          "[runner][scope]") {
  ph::scope<d1, 2> seen;
  seen.record(std::nan(""), ph::seconds{-1.0}, result(0.5));
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // if it is installed
  const auto row = fields_of(saved(seen)[1]);
  std::setlocale(LC_NUMERIC, before.c_str());
  CHECK(row[3] == "nan");
  CHECK(row[5] == "0.5");
  CHECK(row[1] == "0");  // a tick that took less than no time adds none
  CHECK_FALSE(ph::save(seen, "/no/such/folder/scope.csv"));
}
