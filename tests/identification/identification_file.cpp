// SPDX-License-Identifier: BSD-3-Clause
// The file: what is written is read back to the bit, and what is wrong is refused with its line.
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/identification/identification_file.hpp>

#include <filesystem>
#include <functional>

using namespace passive_haptics::identification;

namespace {

device_found<2> two_axes() {
  device_found<2> found{.force_limit = 3.0};
  double x = 0.1;
  for (axis_found& a : found.axes) {
    a = {.mass = x,
         .damping = x / 3.0,
         .damping_max = x * 1.1,
         .friction = x / 7.0,
         .presliding = 1e-5 * x,
         .quantum = 1e-5 / 3.0,
         .noise = 1e-7,
         .latency = 2,
         .longest_tick = 1.1e-3};
    a.damping_ways[0] = x / 3.0;
    a.damping_ways[1] = x / 2.9;
    a.breakaway_least[1] = x / 6.0;
    a.breakaway_most[0] = x / 5.0;
    a.likely_mass = 1.05 * x;
    a.load = -0.3;
    x += 1.0 / 9.0;
  }
  return found;
}
std::string good() {
  return file_text(two_axes(), "grip 7");
}
loaded_identification<2> read_text(const std::string& text) {
  std::istringstream in(text);
  return read<2>(in, "it.txt");
}
std::string with(const std::string& from, const std::string& to) {
  std::string text = good();
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}
/// The text with the line that begins so changed.
std::string line_changed(const std::string& key,
                         const std::function<std::string(const std::string&)>& change) {
  const std::string text = good();
  const auto at = text.find(key);
  REQUIRE(at != std::string::npos);
  const auto end = text.find('\n', at);
  return text.substr(0, at) + change(text.substr(at, end - at)) + text.substr(end);
}

}  // namespace

TEST_CASE("a file gives back what was found, to the bit", "[identification]") {
  const auto loaded = read_text(good());
  CHECK(loaded.fault.empty());
  CHECK(loaded.device == "grip 7");
  CHECK(file_text(loaded.found, loaded.device) == good());
  CHECK(loaded.found.axes[1].breakaway_least[1] == two_axes().axes[1].breakaway_least[1]);
  CHECK(loaded.found.axes[0].load == -0.3);
  CHECK(loaded.found.force_limit == 3.0);
}

TEST_CASE("a file is refused with the line, what stands there and what is wanted",
          "[identification]") {
  const auto refused = [](const std::string& text, const std::string& first,
                          const std::string& second) {
    const auto loaded = read_text(text);
    INFO(loaded.fault);
    CHECK(loaded.fault.find(first) != std::string::npos);
    CHECK(loaded.fault.find(second) != std::string::npos);
    CHECK(loaded.found.axes[0].mass == 0.0);  // nothing of it counts
  };
  refused(with("identification 2", "identification 1"), "it.txt:1:", "identification 2");
  refused(with("axes = 2", "axes = 3"), "it.txt:3: \"axes = 3\"", "axes = 2");
  refused(line_changed("mass_at_least", [](auto&) { return "mass_at_least = nan kg"; }),
          "it.txt:6: \"mass_at_least = nan kg\"", "finite number");
  refused(line_changed("mass_at_least", [](auto&) { return "mass_at_least = 0 kg"; }),
          "it.txt:6:", "mass > 0");
  refused(line_changed("mass_at_least", [](auto&) { return "mass_at_least = 1e999 kg"; }),
          "it.txt:6:", "finite number");
  refused(line_changed("mass_at_least", [](auto&) { return "mass_at_least = 100 g"; }),
          "it.txt:6:", "unit is kg");
  refused(line_changed("friction_at_least", [](auto&) { return "friction_at_least = -0.1 N"; }),
          "friction_at_least = -0.1 N", "≥ 0");
  refused(line_changed("latency_at_most", [](auto&) { return "latency_at_most = 1.5 ticks"; }),
          "latency_at_most = 1.5 ticks", "whole number");
  refused(line_changed("presliding_at_most", [](auto& line) { return line + "\n" + line; }),
          "\"presliding_at_most", "\"quantum_at_most = ...\" is wanted");
  refused(with("damping_at_most", "damping_at_worst"), "it.txt:8: \"damping_at_worst",
          "\"damping_at_most = ...\"");
  refused(with("axis = 2", "axis = 1"), "\"axis = 1\"", "from 2 to 2");
  refused(good() + "more\n", "\"more\"", "nothing may follow");
  refused("", "it.txt:1:", "cut off");
}

TEST_CASE("a file that is cut off anywhere is refused", "[identification]") {
  const std::string text = good();
  for (std::size_t length = 0; length + 2 < text.size(); length += 7) {
    CAPTURE(length);
    CHECK_FALSE(read_text(text.substr(0, length)).fault.empty());
  }
  CHECK(read_text(text.substr(0, text.size() - 1)).fault.empty());  // but for the last line break
}

TEST_CASE("a file is written whole or not at all", "[identification]") {
  const scratch_folder folder;
  const std::string path = folder / "grip.txt";
  CHECK(save(path, two_axes(), "grip 7").empty());
  CHECK(load<2>(path).fault.empty());
  auto failed = two_axes();
  failed.axes[1].problem = "a hand holds it";
  CHECK(save(path, failed, "grip 7").find("a hand holds it") != std::string::npos);
  CHECK(load<2>(path).fault.empty());  // the old one stays
  CHECK(save(folder / "nowhere/x.txt", two_axes(), "grip").find("x.txt") != std::string::npos);
  CHECK(save(path, two_axes(), "two\nlines").find("line break") != std::string::npos);
  CHECK(load<2>(folder / "missing.txt").fault.find("missing.txt") != std::string::npos);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) ==
        1);  // nothing beside it
}
