// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The result of an identification as a text file for people and programs:
//
//     passive_haptics identification 2
//     device = Falcon
//     axes = 1
//     force_limit = 3 N
//     axis = 1
//     mass_at_least = 0.0953 kg
//     ...
//     end
//
// save() writes a file beside it and renames that, so there is never half a file. load() refuses another version,
// another unit, a line that is missing, repeated or out of place, a number that is not finite, and a file without
// its end; the text of the fault has the line, its content and the expected content.

#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/identification/axis_found.hpp>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

namespace detail {

inline constexpr const char* file_heading = "passive_haptics identification 2";

/// A number of an axis in the file.
struct file_entry {
  const char* key;
  const char* unit;
  bool signed_number = false;  ///< false: a number < 0 is refused
};
inline constexpr file_entry file_entries[] = {{"mass_at_least", "kg"},
                                              {"damping_at_least", "N·s/m"},
                                              {"damping_at_most", "N·s/m"},
                                              {"damping_backward_at_least", "N·s/m"},
                                              {"damping_forward_at_least", "N·s/m"},
                                              {"friction_at_least", "N"},
                                              {"breakaway_backward_at_least", "N"},
                                              {"breakaway_backward_at_most", "N"},
                                              {"breakaway_forward_at_least", "N"},
                                              {"breakaway_forward_at_most", "N"},
                                              {"presliding_at_most", "m"},
                                              {"quantum_at_most", "m"},
                                              {"noise_at_most", "m"},
                                              {"latency_at_most", "ticks"},
                                              {"longest_tick", "s"},
                                              {"likely_mass", "kg"},
                                              {"likely_damping", "N·s/m", true},
                                              {"likely_friction", "N", true},
                                              {"likely_presliding", "m"},
                                              {"load", "N", true},
                                              {"explained", "of 1"},
                                              {"uneven", "of 1"},
                                              {"creep", "of 1"},
                                              {"rotor_at_least", "kg"}};
inline constexpr std::size_t file_numbers = sizeof file_entries / sizeof file_entries[0];
using numbers = std::array<double, file_numbers>;

[[nodiscard]] inline numbers numbers_of(const axis_found& a) noexcept {
  return {a.mass,
          a.damping,
          a.damping_max,
          a.damping_ways[0],
          a.damping_ways[1],
          a.friction,
          a.breakaway_least[0],
          a.breakaway_most[0],
          a.breakaway_least[1],
          a.breakaway_most[1],
          a.presliding,
          a.quantum,
          a.noise,
          static_cast<double>(a.latency),
          a.longest_tick,
          a.likely_mass,
          a.likely_damping,
          a.likely_friction,
          a.likely_presliding,
          a.load,
          a.explained,
          a.uneven,
          a.creep,
          a.rotor};
}
[[nodiscard]] inline axis_found axis_of(const numbers& n) noexcept {
  axis_found a{.mass = n[0],
               .damping = n[1],
               .damping_max = n[2],
               .friction = n[5],
               .presliding = n[10],
               .quantum = n[11],
               .noise = n[12],
               .latency = static_cast<int>(n[13]),
               .longest_tick = n[14]};
  a.damping_ways[0] = n[3];
  a.damping_ways[1] = n[4];
  a.breakaway_least[0] = n[6];
  a.breakaway_most[0] = n[7];
  a.breakaway_least[1] = n[8];
  a.breakaway_most[1] = n[9];
  a.likely_mass = n[15];
  a.likely_damping = n[16];
  a.likely_friction = n[17];
  a.likely_presliding = n[18];
  a.load = n[19];
  a.explained = n[20];
  a.uneven = n[21];
  a.creep = n[22];
  a.rotor = n[23];
  return a;
}

}  // namespace detail

/// The text of the file; empty for a device that has a problem.
template <int Dof>
[[nodiscard]] std::string file_text(const device_found<Dof>& found, const std::string& device) {
  if (found.problem() != nullptr) return {};
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(17) << detail::file_heading << "\ndevice = " << device
       << "\naxes = " << Dof << "\nforce_limit = " << found.force_limit << " N\n";
  for (int i = 0; i < Dof; ++i) {
    text << "axis = " << i + 1 << '\n';
    const detail::numbers of = detail::numbers_of(found.axes[static_cast<std::size_t>(i)]);
    for (std::size_t k = 0; k < detail::file_numbers; ++k) {
      text << detail::file_entries[k].key << " = " << of[k] << ' ' << detail::file_entries[k].unit
           << '\n';
    }
  }
  text << "end\n";
  return text.str();
}

/// Writes the whole file, or nothing. Returns an empty text, or a sentence that says why nothing was written.
template <int Dof>
[[nodiscard]] std::string save(const std::string& path, const device_found<Dof>& found,
                               const std::string& device) {
  if (found.problem() != nullptr) {
    return path + ": not written, because nothing was found: " + found.problem();
  }
  if (device.find('\n') != std::string::npos) {
    return path + ": not written, because the name of the device has a line break";
  }
  const std::string beside = path + ".part";
  std::ofstream out(beside);
  out << file_text(found, device);
  out.close();
  if (out.fail() || std::rename(beside.c_str(), path.c_str()) != 0) {
    std::remove(beside.c_str());
    return path + ": cannot be written: is there such a folder, and room on the disk?";
  }
  return {};
}

/// The content of a file. `fault` is empty, or a sentence with the line, what stands there and the remedy; then
/// nothing else counts.
template <int Dof>
struct loaded_identification {
  std::string fault;
  std::string device;
  device_found<Dof> found{};
};

namespace detail {

/// Reads line after line and keeps the first fault.
class identification_reader {
 public:
  identification_reader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
  [[nodiscard]] bool good() const noexcept { return fault_.empty(); }

  void exactly(const std::string& wanted) {
    if (next("\"" + wanted + "\"") && line_ != wanted) refuse("\"" + wanted + "\" is wanted");
  }
  [[nodiscard]] std::string word(const std::string& key) {
    const std::string start = key + " = ";
    if (!next("\"" + start + "...\"")) return {};
    if (line_.rfind(start, 0) != 0) {
      refuse("\"" + start + "...\" is wanted: is a line missing, or twice?");
      return {};
    }
    return line_.substr(start.size());
  }
  [[nodiscard]] double number(const file_entry& entry) {
    const std::string text = word(entry.key);
    if (!good()) return 0.0;
    const auto blank = text.find(' ');
    const std::string digits = text.substr(0, blank);
    const std::string unit = blank == std::string::npos ? "" : text.substr(blank + 1);
    if (unit != entry.unit) {
      refuse("the unit is " + std::string(entry.unit) + ": give it in that");
      return 0.0;
    }
    const auto value = to_decimal(digits);
    if (!value || !kernels::is_finite(*value) || (!entry.signed_number && !(*value >= 0.0))) {
      refuse(std::string(entry.signed_number ? "a finite number" : "a finite number ≥ 0") +
             " is wanted: identify the device again");
      return 0.0;
    }
    return *value;
  }
  [[nodiscard]] int whole(const std::string& key, int least, int most) {
    const std::string text = word(key);
    if (!good()) return least;
    const auto value = to_decimal(text);
    if (!value || *value != std::floor(*value) || !(*value >= least && *value <= most)) {
      refuse("a whole number from " + std::to_string(least) + " to " + std::to_string(most) +
             " is wanted");
      return least;
    }
    return static_cast<int>(*value);
  }
  void nothing_more() {
    std::string more;
    if (good() && std::getline(in_, more)) {
      ++number_;
      line_ = more;
      refuse("nothing may follow \"end\"");
    }
  }
  void refuse(const std::string& wanted) {
    if (good()) fault_ = name_ + ':' + std::to_string(number_) + ": \"" + line_ + "\": " + wanted;
  }

 private:
  bool next(const std::string& wanted) {
    if (!good()) return false;
    ++number_;
    if (!std::getline(in_, line_)) {
      fault_ = name_ + ':' + std::to_string(number_) + ": the file ends here, and " + wanted +
               " is wanted: it is cut off; identify the device again";
      return false;
    }
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    return true;
  }

  std::istream& in_;
  std::string name_, line_, fault_;
  int number_ = 0;
};

}  // namespace detail

/// Reads what file_text() wrote; messages begin with `name`.
template <int Dof>
[[nodiscard]] loaded_identification<Dof> read(std::istream& in, const std::string& name) {
  loaded_identification<Dof> loaded;
  detail::identification_reader line(in, name);
  line.exactly(detail::file_heading);
  loaded.device = line.word("device");
  if (line.good() && line.whole("axes", 1, 9) != Dof && line.good()) {
    line.refuse("a device of axes = " + std::to_string(Dof) + " is wanted");
  }
  loaded.found.force_limit = line.number({"force_limit", "N"});
  for (int i = 0; i < Dof; ++i) {
    static_cast<void>(line.whole("axis", i + 1, i + 1));
    detail::numbers of{};
    for (std::size_t k = 0; k < detail::file_numbers; ++k) {
      of[k] = line.number(detail::file_entries[k]);
      const std::string key = detail::file_entries[k].key;
      if (key == "mass_at_least" && !(of[k] > 0.0)) line.refuse("a mass > 0 kg is wanted");
      if (key == "longest_tick" && !(of[k] > 0.0)) line.refuse("a tick > 0 s is wanted");
      if (key == "latency_at_most" && !(of[k] == std::floor(of[k]) && of[k] <= 100.0)) {
        line.refuse("a whole number of ticks up to 100 is wanted");
      }
    }
    loaded.found.axes[static_cast<std::size_t>(i)] = detail::axis_of(of);
  }
  line.exactly("end");
  line.nothing_more();
  loaded.fault = line.fault();
  if (!loaded.fault.empty()) loaded.found = {};
  return loaded;
}

/// The same from a file.
template <int Dof>
[[nodiscard]] loaded_identification<Dof> load(const std::string& path) {
  std::ifstream in(path);
  if (!in.good()) {
    loaded_identification<Dof> none;
    none.fault = path + ": cannot be read: is there such a file?";
    return none;
  }
  return read<Dof>(in, path);
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
