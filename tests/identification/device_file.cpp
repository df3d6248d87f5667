// SPDX-License-Identifier: BSD-3-Clause
// A device as a file: what is written is read back to the bit, and what is wrong is refused with its line.
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/identification/device_file.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace ph = passive_haptics;
using namespace passive_haptics::identification;

namespace {

const ph::encoder_device grip{.mass = 0.1 / 3,
                              .damping = 0.05,
                              .friction = 0.13,
                              .presliding = 15e-6,
                              .quantum = 55e-6,
                              .force_limit = 3.3,
                              .longest_tick = 1.1e-3,
                              .latency = 1,
                              .continuous_force = 0.88,
                              .winding_time = 10.0};
const ph::exact_device knob{.mass = 5e-5,
                            .damping = 1e-3,
                            .force_limit = 0.2,
                            .longest_tick = 5e-4,
                            .rotary = true,
                            .top_speed = 300.0};

loaded_device read_text(const std::string& text) {
  std::istringstream in(text);
  return read_device(in, "it.json");
}
/// Every number of both is the same, to the bit.
bool same(const device_description& a, const device_description& b) {
  std::vector<double> of_a, of_b;
  const auto into = [](std::vector<double>& all) {
    return [&all](const char*, double x) { all.push_back(x); };
  };
  const auto flags = [](std::vector<double>& all) {
    return [&all](const char*, bool yes) { all.push_back(yes ? 1.0 : 0.0); };
  };
  detail::for_each_entry(a, into(of_a), flags(of_a));
  detail::for_each_entry(b, into(of_b), flags(of_b));
  return a.name == b.name && a.device.index() == b.device.index() && of_a.size() == of_b.size() &&
         std::memcmp(of_a.data(), of_b.data(), of_a.size() * sizeof(double)) == 0 &&
         a.gains == b.gains;
}
std::string with(const std::string& from, const std::string& to) {
  std::string text = device_text({"grip", grip, 5.0});
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}
/// Of a text that is refused: the message.
std::string refused(const std::string& text) {
  const auto loaded = read_text(text);
  CHECK(loaded.of.name.empty());
  return loaded.fault;
}

}  // namespace

TEST_CASE("a device is written as what a person would write", "[device_file]") {
  CHECK(device_text({"a \"7\" \\", knob, 0.5}) == R"({
  "passive_haptics_device": 1,
  "name": "a \"7\" \\",
  "kind": "exact",
  "mass": 5e-05,
  "damping": 0.001,
  "force_limit": 0.2,
  "longest_tick": 5e-04,
  "latency": 0,
  "rotary": true,
  "top_speed": 300,
  "hand_force": 0.5
}
)");
}

TEST_CASE("a device that is written is read back to the bit", "[device_file]") {
  for (const auto& d : {device_description{"grip 7", grip, 5.0}, device_description{"", knob, 0.0},
                        device_description{"µ \"quoted\" \\ /", knob, 0.1}}) {
    const auto loaded = read_text(device_text(d));
    CHECK(loaded.fault.empty());
    CHECK(same(loaded.of, d));
  }
  std::mt19937_64 random(27);
  const auto number = [&random] {
    return std::exp(std::uniform_real_distribution<double>(-20.0, 5.0)(random));
  };
  for (int n = 0; n < 2000; ++n) {
    device_description d{"n", {}, n % 3 == 0 ? 0.0 : number()};
    if (n % 2 == 0) {
      ph::encoder_device e{.mass = number(), .damping = number(), .quantum = number()};
      e.force_limit = number();
      e.longest_tick = number();
      e.latency = n % 9;
      if (n % 4 == 0) e.friction = number(), e.presliding = number();
      if (n % 8 == 0) e.continuous_force = 0.5 * e.force_limit, e.winding_time = number();
      e.rotary = n % 6 == 0;
      d.device = e;
    } else {
      d.device = ph::exact_device{.mass = number(),
                                  .damping = number(),
                                  .force_limit = number(),
                                  .longest_tick = number(),
                                  .latency = n % 5,
                                  .rotary = n % 7 == 0,
                                  .top_speed = n % 3 == 0 ? number() : 0.0};
    }
    for (int i = 0; i < n % 7; ++i) d.gains.push_back(number());
    if (n % 7 > 2) d.gain_tolerance = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    const auto loaded = read_text(device_text(d));
    INFO(device_text(d) << loaded.fault);
    REQUIRE(loaded.fault.empty());
    if (!same(loaded.of, d)) {  // NaN has more than one pattern
      auto of = std::get<ph::encoder_device>(loaded.of.device);
      REQUIRE(std::isnan(of.presliding));
      REQUIRE(of.friction == 0.0);
    }
  }
}

TEST_CASE("keys stand in any order, spaced in any way, and what has a default may be left out",
          "[device_file]") {
  const auto loaded = read_text(
      "\t{\"kind\":\"encoder\",\"quantum\":1e-5 ,\r\n\"force_limit\" : 9.0,\"mass\":0.1\n,"
      "\"passive_haptics_device\":1.0}\n\n");
  CHECK(loaded.fault.empty());
  const auto d = std::get<ph::encoder_device>(loaded.of.device);
  CHECK(d.quantum == 1e-5);
  CHECK(d.longest_tick == 1e-3);
  CHECK(d.continuous_force == std::numeric_limits<double>::infinity());
}

TEST_CASE("what is wrong is refused with its line, what stands there, and what to do",
          "[device_file]") {
  CHECK(refused("") == "it.json:1: the file ends, and '{' is wanted to begin with");
  CHECK(refused("{}") ==
        "it.json:1: \"passive_haptics_device\": 1 is wanted: it says which keys there are");
  CHECK(refused(with("device\": 1", "device\": 2")) ==
        "it.json:2: \"passive_haptics_device\": 1 is wanted: it says which keys there are");
  CHECK(refused(with("\"kind\": \"encoder\"", "\"kind\": \"other\"")) ==
        "it.json:4: \"kind\": \"exact\" is wanted, or \"encoder\" where steps are felt");
  CHECK(refused(with("\"mass\"", "\"mas\"")) ==
        "it.json:5: \"mas\": no key of a device of kind \"encoder\": correct it, or leave it out");
  CHECK(
      refused(with("\"encoder\"", "\"exact\"")) ==
      "it.json:7: \"friction\": no key of a device of kind \"exact\": correct it, or leave it out");
  CHECK(refused(with("\"damping\": 0.05", "\"mass\": 0.05")) ==
        "it.json:6: \"mass\": it stands there twice");
  CHECK(refused(with("0.05", "5 %")).find("it.json:6: ") == 0);
  CHECK(
      refused(with("0.05", "nan")) ==
      "it.json:6: \"damping\": nan: a finite number is wanted; what is not known, or has no limit, "
      "is left out");
  CHECK(refused(with("0.05", "1e999")).find("it.json:6: \"damping\": 1e999: a finite") == 0);
  CHECK(refused(with("0.05", "\"0.05\"")).find("it.json:6: \"damping\": \"0.05\": a finite") == 0);
  CHECK(refused(with("0.05", "[0.05]")) ==
        "it.json:6: \"damping\": 0.05: a finite number is wanted; what is not known, or has no "
        "limit, "
        "is left out");
  CHECK(refused(with("0.05", "-0.05")) ==
        "it.json:6: \"damping\" is -0.05: wanted is finite and ≥ 0 N·s/m; identify finds it");
  CHECK(refused(with("\"latency\": 1", "\"latency\": 0.5")) ==
        "it.json:12: \"latency\": a whole number is wanted");
  CHECK(refused(with("\"latency\": 1", "\"latency\": -1")) ==
        "it.json:12: \"latency\" is -1: wanted is ≥ 0 ticks; identify finds it");
  CHECK(refused(with("\"rotary\": false", "\"rotary\": 0")) ==
        "it.json:15: \"rotary\": 0: true or false is wanted");
  CHECK(refused(with("\"name\": \"grip\"", "\"name\": 7")) ==
        "it.json:3: \"name\": 7: a text in quotation marks is wanted");
  CHECK(refused(with("\"hand_force\": 5", "\"hand_force\": -5")) ==
        "it.json:16: \"hand_force\" is -5: wanted is finite and ≥ 0 N; identify finds it");
  CHECK(
      refused(with("  \"presliding\": 1.5e-05,\n", "")) ==
      "it.json:16: \"presliding\" is missing: wanted is finite and ≥ 0 m, stated: over how far the "
      "friction is elastic; identify finds it");
  CHECK(refused(with("grip\"", "grip")).find("it.json:3: a text has no end") == 0);
  CHECK(refused(with("grip", "gr\\u0069p")).find("it.json:3: of what begins with \\ only") == 0);
  CHECK(refused(with("0.05,", "0.05")) ==
        "it.json:7: '}' is wanted after the last value, or ',' before another key");
  CHECK(refused(with("5\n}", "5,\n}")) == "it.json:17: '\"' is wanted before a key");
  CHECK(refused(with("}", "} x")) == "it.json:17: nothing may follow the last '}'");
  CHECK(refused(with("}", "")).find("it.json:18: the file ends, and '}' is wanted") == 0);
}

TEST_CASE("gains that are none are refused with their line, and what to write", "[device_file]") {
  const auto with_gains = [](const std::string& more) {
    return with("\"hand_force\": 5", "\"hand_force\": 5,\n  " + more);
  };
  const auto good = read_text(with_gains("\"gains\": [ 0.93,\n 1.02 ], \"gain_tolerance\": 0.01"));
  CHECK(good.fault.empty());
  CHECK(good.of.gains == std::vector{0.93, 1.02});
  CHECK(good.of.gain_tolerance == 0.01);
  for (const char* list : {"0.93", "\"0.93\"", "[]", "[0.93,]", "[,0.93]", "[0.93 1]", "[nan]",
                           "[1e999]", "[[0.93]]", "[true]"}) {
    CAPTURE(list);
    CHECK(refused(with_gains("\"gains\": " + std::string(list))).find("it.json:17: ") == 0);
  }
  CHECK(refused(with_gains("\"gains\": [0.93")).find("']' is wanted") != std::string::npos);
  CHECK(refused(with_gains("\"gains\": [0.93, -1]")) ==
        "it.json:17: \"gains\" is -1: wanted is finite and > 0; identify finds it");
  CHECK(refused(with_gains("\"gains\": [1, 1, 1, 1, 1, 1, 1]")).find("up to 6") !=
        std::string::npos);
  CHECK(refused(with_gains("\"gains\": [1],\n  \"gain_tolerance\": 1")).find("it.json:18: ") == 0);
  CHECK(refused(with_gains("\"gain_tolerance\": 0.01")).find("without \"gains\"") !=
        std::string::npos);
  CHECK(save_device("none.json", {"grip", grip, 5.0, {0.0}, 0.0}).find("because gains is 0") !=
        std::string::npos);
}

TEST_CASE("what is composed behind gains states less, by the ports that it is proved for",
          "[device_file]") {
  using d1 = ph::space<double, 1>;
  using d2 = ph::space<double, 2>;
  const auto one = behind_gains<d1>({"grip", grip, 5.0, {1.0}, 0.02});
  REQUIRE(one.fault.empty());
  const auto& d = std::get<ph::encoder_device>(one.of.device);
  CHECK(d.mass == grip.mass / 1.02);
  CHECK(d.damping == grip.damping / 1.02);
  CHECK(d.friction == grip.friction / 1.02);
  CHECK(d.presliding == grip.presliding);
  CHECK(d.force_limit == grip.force_limit);
  CHECK(one.of.hand_force == 5.0 / 0.98);
  CHECK_FALSE(ph::make_touch<d1, ph::half_space<d1>, ph::late_loop_limits<1>>(
                  d, ph::known_hand{.force = one.of.hand_force})
                  .check());
  const auto two = behind_gains<d2>({"knob", knob, 0.15, {0.9, 1.0}, 0.02});
  REQUIRE(two.fault.empty());
  CHECK_THAT(std::get<ph::exact_device>(two.of.device).damping,
             Catch::Matchers::WithinRel(0.9 * knob.damping / (1.02 * 1.02), 1e-12));
  CHECK(two.of.hand_force == 0.0);
  CHECK(behind_gains<d2>({"grip", grip, 5.0, {0.9, 1.0}, 0.02}).fault.find("on steps") !=
        std::string::npos);
  CHECK(behind_gains<d2>({"grip", grip, 5.0, {0.9, 1.0}, 0.0}).fault.empty());  // the controls
  CHECK(behind_gains<d2>({"grip", grip, 5.0}).fault.empty());
  CHECK_FALSE(behind_gains<d2>({"knob", knob, 0.15, {0.9}, 0.02}).fault.empty());
  CHECK_FALSE(behind_gains<d2>({"knob", knob, 0.15, {0.9}, 0.0}).fault.empty());
}

TEST_CASE(
    "a device that was identified before it was weighed is stated in the newtons of its gains",
    "[device_file]") {
  using d1 = ph::space<double, 1>;
  const double tolerance = 0.01;
  for (const double gain : {0.8, 0.9, 1.1, 1.25}) {  // that the motor has
    for (const double off : {-0.99 * tolerance, 0.0, 0.99 * tolerance}) {
      const double likely = gain / (1.0 + off);  // that was weighed
      CAPTURE(gain, off);
      // Commands that are divided by `likely` move a device of so many times the numbers of `grip`.
      const double true_share = likely / gain;
      auto commanded = grip;  // as identify() finds it, in newtons commanded
      for (double* x : {&commanded.mass, &commanded.damping, &commanded.friction}) *x /= gain;
      for (const bool weighed_later : {true, false}) {
        const auto stated = behind_gains<d1>({"grip",
                                              weighed_later ? commanded : grip,
                                              weighed_later ? 5.0 / gain : 5.0,
                                              {likely},
                                              tolerance});
        REQUIRE(stated.fault.empty());
        const auto& d = std::get<ph::encoder_device>(stated.of.device);
        CHECK(d.mass <= true_share * grip.mass);
        CHECK(d.damping <= true_share * grip.damping);
        CHECK(d.friction <= true_share * grip.friction);
        CHECK(d.force_limit <= likely * grip.force_limit);
        CHECK(stated.of.hand_force >= true_share * 5.0);
      }
      // The control: the tolerance alone does not cover what was identified in other newtons.
      const auto alone = in_commands(commanded, tolerance);
      CHECK((alone.mass > true_share * grip.mass) == (gain < 1.0));
    }
  }
}

TEST_CASE("no cut of a file is taken for the whole", "[device_file]") {
  const std::string whole = device_text({"grip", grip, 5.0});
  for (std::size_t n = 0; n + 2 < whole.size(); ++n) {
    CHECK_FALSE(read_text(whole.substr(0, n)).fault.empty());
  }
  CHECK(read_text(whole.substr(0, whole.size() - 1)).fault.empty());  // the last line break alone
}

TEST_CASE("the file of a device is written whole or not at all", "[device_file]") {
  const scratch_folder folder;
  const device_description d{"grip", grip, 5.0};
  CHECK(save_device(folder / "grip.json", d).empty());
  const auto loaded = load_device(folder / "grip.json");
  CHECK(loaded.fault.empty());
  CHECK(same(loaded.of, d));
  auto broken = d;
  std::get<ph::encoder_device>(broken.device).mass = 0.0;
  CHECK(save_device(folder / "none.json", broken).find("because mass is 0") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "none.json"));
  CHECK(save_device(folder / "no/such/grip.json", d).find("cannot be written") !=
        std::string::npos);
  CHECK(load_device(folder / "none.json").fault.find("cannot be read") != std::string::npos);
}

TEST_CASE("a description that was read composes what it describes", "[device_file]") {
  const auto loaded = read_text(device_text({"knob", knob, 0.15}));
  REQUIRE(loaded.fault.empty());
  std::visit(
      [&](const auto& device) {
        const ph::known_hand hand{.force = loaded.of.hand_force};
        CHECK_FALSE(ph::make_touch<ph::space<double, 1>>(device, hand).check());
      },
      loaded.of.device);
}

TEST_CASE("what the catalogue knows is written, and what it does not is asked for by name",
          "[device_file]") {
  int complete = 0;
  for (const auto& facts : ph::design::devices::all) {
    const std::string text = device_text(described(facts));
    INFO(text);
    CHECK(text.find("nan") == std::string::npos);
    CHECK(text.find("inf") == std::string::npos);
    const auto loaded = read_text(text);
    complete += loaded.fault.empty();
    CHECK(loaded.fault.find("is missing") != std::string::npos);
  }
  CHECK(complete == 0);  // damping and presliding are published for none of them
  auto touch = described(ph::design::devices::touch);
  auto& d = std::get<ph::encoder_device>(touch.device);
  CHECK(d.mass == 0.045);
  CHECK(d.quantum == 55e-6);
  CHECK(d.continuous_force == 0.88);
  d.damping = 0.01;
  d.presliding = 15e-6;
  d.longest_tick = 1e-3;
  d.winding_time = 10.0;
  const auto loaded = read_text(device_text(touch));
  INFO(loaded.fault);
  CHECK(loaded.fault.empty());
  CHECK(same(loaded.of, touch));
}

TEST_CASE("what was identified is described by what was seen", "[device_file]") {
  device_found<1> found{.force_limit = 3.0};
  found.axes[0] = {.mass = 0.1, .damping = 0.05, .latency = 1, .longest_tick = 1e-3};
  const auto smooth = described(found, "grip", 5.0);
  CHECK(std::get<ph::exact_device>(smooth.device).latency == 1);
  CHECK(read_text(device_text(smooth)).fault.empty());
  found.axes[0].quantum = 3e-5;
  found.axes[0].friction = 0.1;
  found.axes[0].presliding = 1e-5;
  const auto stepped = described(found, "grip", 5.0);
  CHECK(std::get<ph::encoder_device>(stepped.device).presliding == 1e-5);
  const auto loaded = read_text(device_text(stepped));
  CHECK(loaded.fault.empty());
  CHECK(same(loaded.of, stepped));
}
