// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/scripted_falcon.hpp"
#include <passive_haptics/falcon/device.hpp>
#include <passive_haptics/falcon/recording_file.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

using falcon::code;
using falcon::state;

namespace {

using cable = falcon::in_memory_transport<scripted_falcon>;
using recorded = falcon::device<falcon::recording_transport<cable>>;
using replayed = falcon::device<falcon::replay_transport>;

constexpr double k = falcon::cautious_gain<double>;
constexpr std::size_t rows = 8000;

falcon::boot_options no_boot() {
  falcon::boot_options options;
  options.policy = falcon::firmware_policy::assume_running;
  return options;
}

/// A session with a wall at z = 0.136 m, a moving grip and faults; what came of it, in bits.
template <class Device, class Disturb>
std::vector<double> session(Device& device, Disturb disturb) {
  ph::local_model wall{d3{},
                       ph::rigid{ph::half_space<d3>{{0, 0, 0.136}, {0, 0, 1}, 500.0}},
                       ph::snap<d3>{},
                       ph::spring<d3>{},
                       ph::reduced_energy<d3>{.damping = 1.0, .energy = 0.01},
                       ph::strict_bound<d3, 1>{}};
  std::vector<double> all;
  d3::vector force = d3::zero();
  for (int n = 0; n < 1000; ++n) {
    disturb(n);
    const auto sample = device.exchange(force);
    const auto out = wall.tick(sample);
    force = out.force;
    for (const double x : {sample.position[0], sample.position[2], sample.held[2], sample.dt,
                           sample.valid ? 1.0 : 0.0, out.force(2), out.energy,
                           static_cast<double>(device.where())}) {
      all.push_back(x);
    }
  }
  return all;
}

void disturb(scripted_falcon& far, int n) {
  far.encoder = {static_cast<std::int16_t>(-n % 97), 5, static_cast<std::int16_t>(-n % 11)};
  far.homed = n < 100 || n == 700 ? 3 : 7;
  far.on_reply = nullptr;
  if (n == 500 || n == 501) far.on_reply = [](scripted_falcon&, auto& bytes) { bytes.clear(); };
  if (n == 600) far.on_reply = [](scripted_falcon&, auto& bytes) { bytes.erase(bytes.begin()); };
  if (n == 800) far.on_reply = [](scripted_falcon& self, auto&) { self.emit("<AAA>?"); };
}

struct taken {
  std::vector<double> result;
  std::vector<falcon::wire_row> rows;
};

taken record() {
  recorded device{k, {}, rows};
  device.line().line().far().now = scripted_falcon::mode::running;
  REQUIRE(device.open());
  REQUIRE(device.boot({}).how);
  device.line().record(true);
  taken t;
  t.result = session(device, [&](int n) { disturb(device.line().line().far(), n); });
  REQUIRE(device.line().complete());
  t.rows.assign(device.line().rows().begin(), device.line().rows().end());
  return t;
}

std::string temporary(const char* name) {
  return (std::filesystem::temp_directory_path() / name).string();
}

}  // namespace

TEST_CASE("a replay gives every sample, force and state again, to the bit", "[falcon][recording]") {
  const taken original = record();
  CHECK(original.rows.size() > 2500);
  replayed device{k, {}, std::span(original.rows)};
  REQUIRE(device.open());
  REQUIRE(device.boot({}, no_boot()).how);
  const auto again = session(device, [](int) {});
  REQUIRE(again.size() == original.result.size());
  CHECK(std::memcmp(again.data(), original.result.data(), again.size() * sizeof(double)) == 0);
  CHECK(device.line().divergences() == 0);
  CHECK(device.line().finished());
  CHECK_FALSE(device.exchange(d3::zero()).valid);  // the end of the log
  CHECK(device.latest().what == code::unplugged);
}

TEST_CASE("a driver that decides otherwise diverges from the log, and is told where",
          "[falcon][recording]") {
  const taken original = record();
  replayed device{2 * k, {}, std::span(original.rows)};
  REQUIRE(device.open());
  REQUIRE(device.boot({}, no_boot()).how);
  (void)session(device, [](int) {});
  CHECK(device.line().divergences() > 100);
  REQUIRE(device.line().first_divergence() > 400);  // no force before homing: the same till then
  CHECK(device.line().first_divergence() < 700);
}

TEST_CASE("a log goes through a file unchanged", "[falcon][recording]") {
  const taken original = record();
  const std::string path = temporary("passive_haptics_log.csv");
  REQUIRE(falcon::save(path.c_str(), original.rows));
  const auto log = falcon::load(path.c_str());
  REQUIRE(log.how);
  REQUIRE(log.rows.size() == original.rows.size());
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    const auto &a = log.rows[i], &b = original.rows[i];
    if (a.stamp != b.stamp || a.what != b.what || a.how.what != b.how.what ||
        a.how.value != b.how.value || !(a.lines == b.lines) || a.count != b.count ||
        a.bytes != b.bytes) {
      FAIL("row " << i);
    }
  }
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  CHECK(line == "stamp_ns,call,code,value,modem,line,bytes,leg0,leg1,leg2,flags");
  std::getline(file, line);  // the drain before the first question
  CHECK(line == "1000000,read,1,0,1,96,,,,,");
  std::getline(file, line);
  CHECK(line == "1000000,write,0,0,1,96,3C4141414141414141414141414A413E,0,0,0,9");
  std::filesystem::remove(path);
}

TEST_CASE("a log that is no log is refused, with its line", "[falcon][recording]") {
  const std::string path = temporary("passive_haptics_bad.csv");
  const std::string heading = "stamp_ns,call,code,value,modem,line,bytes,leg0,leg1,leg2,flags\n";
  const auto loaded = [&path](const std::string& text) {
    std::ofstream(path) << text;
    const auto log = falcon::load(path.c_str());
    return std::pair(log.how.what, log.how.value);
  };
  const std::string good = "5,read,0,0,1,96,3C41,,,,\n";
  CHECK(loaded(heading + good) == std::pair(code::ok, std::int64_t(0)));
  CHECK(loaded("time,x\n") == std::pair(code::log_unreadable, std::int64_t(1)));
  for (const char* bad :
       {"", "5\n", "x,read,0,0,1,96,3C41,,,,\n", "5,reed,0,0,1,96,3C41,,,,\n",
        "5,read,99,0,1,96,3C41,,,,\n", "5,read,0,0,1,256,3C41,,,,\n", "5,read,0,0,1,96,3C4,,,,\n",
        "5,read,0,0,1,96,3G41,,,,\n", "-5,read,0,0,1,96,3C41,,,,\n", "5,read,0,0,1,96,3C41\n"}) {
    const auto [what, line] = loaded(heading + good + bad);
    INFO(bad);
    CHECK(what == (bad[0] == '\0' ? code::ok : code::log_unreadable));
    if (bad[0] != '\0') CHECK(line == 3);
  }
  CHECK(falcon::load("no/such/file").how.what == code::log_unreadable);
  CHECK(falcon::save("no/such/file", {}).what == code::log_unwritable);
  std::filesystem::remove(path);
}

TEST_CASE("a full recorder says so, and no firmware gets into a log", "[falcon][recording]") {
  const auto image = synthetic_image();
  recorded device{k, {}, std::size_t(300)};
  REQUIRE(device.open());
  device.line().record(true);
  REQUIRE(device.boot(image).how);
  std::size_t longest = 0;
  for (const auto& row : device.line().rows()) {
    if (row.what == falcon::wire_row::call::write && row.count > 0) {
      longest = std::max<std::size_t>(longest, row.count);
      CHECK(row.bytes[0] == '<');
    }
  }
  CHECK(longest == falcon::packet_size);
  CHECK(device.line().complete());
  for (int n = 0; n < 300; ++n) (void)device.exchange(d3::zero());
  CHECK(device.line().complete().what == code::log_full);
  CHECK(device.line().rows().size() == 300);
}
