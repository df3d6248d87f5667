// SPDX-License-Identifier: BSD-3-Clause
#include "falcon/session.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/falcon/recording_file.hpp>

#include <fstream>
#include <string>

TEST_CASE("a log goes through a file unchanged", "[falcon][recording]") {
  const taken original = record();
  const scratch_folder folder;
  const std::string path = folder / "log.csv";
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
}

TEST_CASE("a log that is no log is refused, with its line", "[falcon][recording]") {
  const scratch_folder folder;
  const std::string path = folder / "bad.csv";
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
}
