// SPDX-License-Identifier: BSD-3-Clause
// Recordings: every format gives the same rows, and what cannot be is refused by its row and a remedy.
#include "support/catch.hpp"
#include <passive_haptics/identification/recording_file.hpp>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace identification = passive_haptics::identification;
using identification::loaded_recording;
using identification::recording_columns;

namespace {

constexpr int rows = 300;
double place(int i) {
  return 1e-3 * std::sin(0.01 * i) + 0.25e-3 * i;
}
double push(int i) {
  return i % 40 < 20 ? 1.5 : -1.25;
}

std::string csv(const std::string& heading = "time_s,position_m,force_N",
                const std::string& separator = ",") {
  std::string text = heading + '\n';
  char line[100];
  for (int i = 0; i < rows; ++i) {
    std::snprintf(line, sizeof line, "%.17g%s%.17g%s%.17g\n", 1e-3 * i, separator.c_str(), place(i),
                  separator.c_str(), push(i));
    text += line;
  }
  return text;
}
template <class Number>
std::string bytes(Number x) {
  std::string raw(sizeof x, '\0');
  std::memcpy(raw.data(), &x, sizeof x);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  return raw;
}
std::string doubles(auto of) {
  std::string all;
  for (int i = 0; i < rows; ++i) all += bytes<double>(of(i));
  return all;
}
double second(int i) {
  return 1e-3 * i;
}
std::string mat_element(std::uint32_t type, const std::string& data) {
  std::string padded = data;
  padded.resize((data.size() + 7) / 8 * 8, '\0');
  return bytes(type) + bytes(static_cast<std::uint32_t>(data.size())) + padded;
}
std::string mat_variable(const std::string& name, const std::string& data) {
  const std::string flags = bytes<std::uint32_t>(6) + bytes<std::uint32_t>(0);
  const std::string sizes = bytes<std::uint32_t>(rows) + bytes<std::uint32_t>(1);
  return mat_element(14, mat_element(6, flags) + mat_element(5, sizes) + mat_element(1, name) +
                             mat_element(9, data));
}
std::string mat_heading() {
  std::string text = "MATLAB 5.0 MAT-file";
  text.resize(124, ' ');
  return text + bytes<std::uint16_t>(0x0100) + "IM";
}
std::string npy(const std::string& descr, const std::string& shape, const std::string& data) {
  std::string heading =
      "{'descr': " + descr + ", 'fortran_order': False, 'shape': (" + shape + "), }";
  heading.resize((heading.size() + 10 + 63) / 64 * 64 - 10, ' ');
  return std::string("\x93NUMPY\x01\x00", 8) + bytes(static_cast<std::uint16_t>(heading.size())) +
         heading + data;
}
/// An archive as numpy.savez writes it; `method` 8 is a compressed one.
std::string npz(const std::vector<std::pair<std::string, std::string>>& arrays,
                std::uint16_t method = 0) {
  std::string all, directory;
  for (const auto& [name, data] : arrays) {
    const std::string file = name + ".npy";
    const auto size = bytes(static_cast<std::uint32_t>(data.size()));
    const std::string common = bytes<std::uint16_t>(20) + bytes<std::uint16_t>(0) + bytes(method) +
                               bytes<std::uint32_t>(0) + bytes<std::uint32_t>(0) + size + size +
                               bytes(static_cast<std::uint16_t>(file.size())) +
                               bytes<std::uint16_t>(0);
    directory += "PK\x01\x02" + bytes<std::uint16_t>(20) + common + std::string(6, '\0') +
                 bytes<std::uint32_t>(0) + bytes(static_cast<std::uint32_t>(all.size())) + file;
    all += "PK\x03\x04" + common + file + data;
  }
  const auto count = bytes(static_cast<std::uint16_t>(arrays.size()));
  return all + directory + std::string("PK\x05\x06\0\0\0\0", 8) + count + count +
         bytes(static_cast<std::uint32_t>(directory.size())) +
         bytes(static_cast<std::uint32_t>(all.size())) + std::string(2, '\0');
}

loaded_recording read(const std::string& file, const recording_columns& which = {}) {
  return identification::read_recording(file, "log", which);
}
void is_the_recording(const loaded_recording& r) {
  INFO(r.fault);
  REQUIRE(r.fault.empty());
  REQUIRE(r.rows.size() == rows);
  bool same = true;
  for (int i = 0; i < rows; ++i) {
    const auto n = static_cast<std::size_t>(i);
    same = same && std::abs(r.rows.time[n] - 1e-3 * i) < 1e-12 &&
           std::abs(r.rows.position[n] - place(i)) < 1e-12 &&
           std::abs(r.rows.force[n] - push(i)) < 1e-12;
  }
  CHECK(same);
}
void is_refused(const loaded_recording& r, const std::string& words) {
  INFO(r.fault);
  CHECK(r.rows.size() == 0);
  CHECK(r.fault.rfind("log: ", 0) == 0);
  CHECK(r.fault.find(words) != std::string::npos);
}
/// The same text with line `line` (1: the heading) replaced.
std::string with_line(const std::string& text, int line, const std::string& other) {
  std::size_t at = 0;
  for (int i = 1; i < line; ++i) at = text.find('\n', at) + 1;
  return text.substr(0, at) + other + text.substr(text.find('\n', at));
}

}  // namespace

TEST_CASE("a recording is the same from CSV, MAT 5 and NumPy", "[recording]") {
  is_the_recording(read(csv()));
  is_the_recording(read(csv("time;position;force", ";")));
  is_the_recording(read("# a comment\n" + csv("\"time [s]\"\t\"position [m]\"\tforce(N)", "\t")));
  is_the_recording(read(csv("a b c", " "), {.time = "1", .position = "2", .force = "c"}));
  is_the_recording(read(csv("time_ms,q_mm,u_kN"), {.position = "q",
                                                   .force = "u",
                                                   .time_scale = 1e3,
                                                   .position_scale = 1e3,
                                                   .force_scale = 1e-3}));
  is_the_recording(read(mat_heading() + mat_variable("time", doubles(second)) +
                            mat_variable("q", doubles(place)) +
                            mat_variable("force", doubles(push)),
                        {.position = "q"}));
  std::string table;
  for (int i = 0; i < rows; ++i) table += bytes(place(i)) + bytes(push(i));
  const recording_columns by_number{.time = "", .position = "1", .force = "2", .tick = 1e-3};
  is_the_recording(read(npy("'<f8'", "300, 2", table), by_number));
  const recording_columns named{.time = "", .position = "x", .force = "f", .tick = 1e-3};
  is_the_recording(read(npy("[('x', '<f8'), ('f', '<f8')]", "300,", table), named));
  is_the_recording(read(npz({{"time", npy("'<f8'", "300,", doubles(second))},
                             {"position", npy("'<f8'", "300,", doubles(place))},
                             {"force", npy("'<f8'", "300,", doubles(push))}})));
}

TEST_CASE("what cannot be a recording is refused by its row, with the remedy", "[recording]") {
  is_refused(read(""), "there is no column \"position\"");
  is_refused(read(csv(), {.force = "tau"}),
             "no column \"tau\" for the force; there are time_s, position_m, force_N");
  is_refused(read("time,position,force\n0,0,0\n"), "row 1: the recording ends here");
  is_refused(read(with_line(csv(), 12, "0.01,nan,1")), "row 11: the position is no finite number");
  is_refused(read(with_line(csv(), 12, "0.01,,1")), "row 11: the position is no finite number");
  is_refused(read(with_line(csv(), 12, "0.01,1e999,1")),
             "row 11: the position is no finite number");
  is_refused(read(with_line(csv(), 12, "0.01,1")),
             "line 12, row 11: 2 cells stand here and 3 in the heading");
  is_refused(read(with_line(csv(), 12, "0.001,1,1")), "row 11: time runs back or stands still");
  is_refused(read(csv("force,position,time")), "time runs back or stands still");
  is_refused(read(csv("x,position,force"), {.time = ""}), "no column of the time: state the tick");
  is_refused(read(csv(), {.force_scale = 0.0}), "a scale of 0");
  is_refused(read(mat_heading() + mat_element(15, "x")),
             "compressed: save it again by save('file.mat', '-v6')");
  is_refused(read("\x89HDF\r\n"), "MATLAB 7.3");
  is_refused(read(mat_heading() + mat_variable("time", doubles(second)).substr(0, 400)),
             "cut off in byte 128");
  is_refused(read(npz({{"time", "x"}}, 8)), "not by savez_compressed");
  is_refused(read(npy("'>f8'", "300,", doubles(second))), "convert it by .astype('<f8')");
  is_refused(read(std::string("\0\1\2", 3)), "export it as CSV");
}

TEST_CASE("units off by a thousand, swapped columns and gaps are doubted", "[recording]") {
  const auto doubt = [](const recording_columns& which, const std::string& text = csv()) {
    const auto r = read(text, which);
    REQUIRE(r.fault.empty());
    return identification::doubt_of(r.rows, identification::statistics_of(r.rows));
  };
  const auto says = [](const std::string& text, const std::string& words) {
    INFO(text);
    return text.find(words) != std::string::npos;
  };
  CHECK(doubt({}).empty());
  CHECK(says(doubt({.time_scale = 1e3}), "is the time in ms"));
  CHECK(says(doubt({.time_scale = 1e-3}), "is the time in ms or µs"));
  CHECK(says(doubt({.position_scale = 1e3}), "is the position in mm"));
  CHECK(says(doubt({.force_scale = 1e5}), "is the force in mN"));
  CHECK(says(doubt({}, csv("time,force,position")), "swapped"));
  std::string gaps = "time,position,force\n";
  for (int i = 0; i < rows; ++i) {
    gaps += std::to_string(1e-3 * i + (i / 10) * 0.1) + "," + std::to_string(place(i)) + "," +
            std::to_string(push(i)) + "\n";
  }
  CHECK(says(doubt({}, gaps), "row 11 and 29 rows in all come after a gap"));
}

TEST_CASE("statistics see the tick, the jitter, repeated rows and steps", "[recording]") {
  identification::recording r;
  double t = 0.0;
  for (int i = 0; i < 4000; ++i) {
    r.time.push_back(t);
    t += 1e-3 * (1.0 + (i % 2 == 0 ? 0.1 : -0.1));
    const int shown = i % 7 == 0 && i > 0 ? i - 1 : i;  // every seventh row repeats the one before
    r.position.push_back(20e-6 * std::floor(0.05 * std::sin(3e-3 * shown) / 20e-6));
    r.force.push_back(std::sin(0.1 * i));
  }
  const auto s = identification::statistics_of(r);
  CHECK(std::abs(s.tick - 1e-3) < 0.11e-3);
  CHECK(s.jitter > 0.1);
  CHECK(s.longest > 1.09e-3);
  CHECK(s.gaps == 0);
  CHECK(std::abs(s.quantum - 20e-6) < 1e-9);
  CHECK(std::abs(s.repeated - 1.0 / 7.0) < 0.03);
}
