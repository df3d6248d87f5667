// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parameters of a composition as a JSON file: an exact_device or an encoder_device, and the force of the hand.
//
//     {
//       "passive_haptics_device": 1,
//       "name": "grip 7",
//       "kind": "encoder",
//       "mass": 0.045,
//       ...
//     }
//
//   save_device("grip.json", {.name = "grip 7", .device = stated, .hand_force = 5.0})
//   const auto loaded = load_device("grip.json");          // loaded.fault is empty, or says what to mend
//   std::visit([](const auto& device) { return ph::make_touch<scene>(device, hand); }, loaded.of.device)
//
// A device that was weighed has its gains in it, "gains": [0.93, 1.02] and "gain_tolerance": 0.008. Commands go through
// gains_of<scene>(loaded.of, device) then, and what is composed rests on behind_gains(loaded.of).
//
// The file is one object of numbers, texts, booleans and that list, with the names and units of described_device.hpp, in
// any order. A key that is left out has its default value. A key that is unknown or repeated, another version or a value
// out of range is refused with its line. Numbers have the fewest digits from which the same double is read back.

#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/identification/axis_found.hpp>
#include <passive_haptics/identification/device_facts.hpp>
#include <passive_haptics/identification/known_gains.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <istream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// A device of one of the two kinds, and the hand on it.
struct device_description {
  std::string name;
  std::variant<exact_device, encoder_device> device{};
  double hand_force = 0.0;  ///< known_hand::force [N]; 0: it is not stated
  std::vector<double>
      gains{};  ///< newtons delivered for each one commanded, by axis; empty: it was not weighed
  double gain_tolerance = 0.0;  ///< the share by which a gain may differ from that, in [0, 1)
};

/// `of` is valid if `fault` is empty; otherwise `fault` is a sentence with the line, its content and the remedy.
struct loaded_device {
  std::string fault;
  device_description of;
};

namespace detail {

inline constexpr const char* device_version_key = "passive_haptics_device";
inline constexpr double device_version = 1.0;

/// Shows every number of a description, by its key, to `number`(key, value), and `flag`(key, yes).
template <class Description, class Number, class Flag>
void for_each_entry(Description& d, Number number, Flag flag) {
  std::visit(
      [&](auto& of) {
        number("mass", of.mass);
        number("damping", of.damping);
        if constexpr (requires { of.quantum; }) {
          number("friction", of.friction);
          number("presliding", of.presliding);
          number("quantum", of.quantum);
        }
        number("force_limit", of.force_limit);
        number("longest_tick", of.longest_tick);
        number("latency", of.latency);
        if constexpr (requires { of.quantum; }) {
          number("continuous_force", of.continuous_force);
          number("winding_time", of.winding_time);
        }
        flag("rotary", of.rotary);
        number("top_speed", of.top_speed);
      },
      d.device);
  number("hand_force", d.hand_force);
  number("gain_tolerance", d.gain_tolerance);
}
[[nodiscard]] inline parameter_fault fault_of_gains(const device_description& d) noexcept {
  for (const double g : d.gains) {
    if (!passive_haptics::detail::positive(g)) return {"gains", g, "finite and > 0"};
  }
  if (d.gains.size() > 6) {
    return {"gains", static_cast<double>(d.gains.size()), "one for each axis, up to 6"};
  }
  if (!(d.gain_tolerance >= 0.0 && d.gain_tolerance < 1.0)) {
    return {"gain_tolerance", d.gain_tolerance, "in [0, 1)"};
  }
  if (d.gain_tolerance > 0.0 && d.gains.empty()) {
    return {"gain_tolerance", d.gain_tolerance,
            "0 without \"gains\": state them, 1 where none is known"};
  }
  return {};
}

[[nodiscard]] inline std::string shortest(double x) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr};
}
/// A text between quotation marks. Control characters have no place in a name.
[[nodiscard]] inline std::string in_quotes(std::string_view text) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') all += '\\';
    all += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return all + '"';
}

/// One key of a file and its value.
struct device_entry {
  std::string key, value;
  int line = 0;
  bool is_text = false, is_list = false;
};

/// Reads the object and keeps the first fault.
class device_reader {
 public:
  device_reader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    object();
  }
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
  [[nodiscard]] bool good() const noexcept { return fault_.empty(); }
  void refuse(int line, const std::string& why) {
    if (good()) fault_ = name_ + ':' + std::to_string(line) + ": " + why;
  }
  /// The line of the key, or the line at which its absence is reported.
  [[nodiscard]] int line_of(std::string_view key) const noexcept {
    for (const auto& e : entries_) {
      if (e.key == key) return e.line;
    }
    return line_;
  }
  /// The value of a key, which is marked as known; null if the key is missing.
  [[nodiscard]] const device_entry* take(std::string_view key) {
    for (auto& e : entries_) {
      if (e.key != key) continue;
      known_.push_back(e.key);
      return &e;
    }
    return nullptr;
  }
  void text(std::string_view key, std::string& value) {
    const auto* e = take(key);
    if (e == nullptr) return;
    if (!e->is_text) refuse(e->line, shown(*e) + ": a text in quotation marks is wanted");
    value = e->value;
  }
  void number(std::string_view key, double& value) {
    const auto* e = take(key);
    if (e == nullptr) return;
    const auto read = e->is_text || e->is_list ? std::nullopt : to_decimal(e->value);
    if (!read || !kernels::is_finite(*read)) {
      return refuse(e->line, shown(*e) +
                                 ": a finite number is wanted; what is not known, or has no "
                                 "limit, is left out");
    }
    value = *read;
  }
  void number(std::string_view key, int& value) {
    double read = value;
    number(key, read);
    if (!(read >= -1e6 && read <= 1e6) || read != static_cast<int>(read)) {
      return refuse(line_of(key), in_quotes(key) + ": a whole number is wanted");
    }
    value = static_cast<int>(read);
  }
  void numbers(std::string_view key, std::vector<double>& values) {
    const auto* e = take(key);
    if (e == nullptr) return;
    for (std::string_view left = e->value; e->is_list && !left.empty();) {
      const auto end = (std::min)(left.find(','), left.size());
      auto one = left.substr(0, end);
      while (!one.empty() && one.front() == ' ') one.remove_prefix(1);
      while (!one.empty() && one.back() == ' ') one.remove_suffix(1);
      const auto read = to_decimal(one);
      if (!read || !kernels::is_finite(*read) || end + 1 == left.size()) {
        values.clear();
        break;
      }
      values.push_back(*read);
      left.remove_prefix((std::min)(end + 1, left.size()));
    }
    if (values.empty()) {
      refuse(e->line, shown(*e) + ": finite numbers are wanted, as in [0.93, 1.02]");
    }
  }
  void flag(std::string_view key, bool& value) {
    const auto* e = take(key);
    if (e == nullptr) return;
    value = e->value == "true";
    if (e->is_text || (!value && e->value != "false")) {
      refuse(e->line, shown(*e) + ": true or false is wanted");
    }
  }
  void nothing_unknown(const std::string& kind) {
    for (const auto& e : entries_) {
      bool known = false;
      for (const auto& k : known_) known = known || k == e.key;
      if (!known) {
        refuse(e.line, in_quotes(e.key) + ": no key of a device of kind " + in_quotes(kind) +
                           ": correct it, or leave it out");
      }
    }
  }

 private:
  [[nodiscard]] static std::string shown(const device_entry& e) {
    return in_quotes(e.key) + ": " + (e.is_text ? in_quotes(e.value) : e.value);
  }
  void blanks() {
    while (!text_.empty() && std::string_view(" \t\r\n").find(text_.front()) != text_.npos) next();
  }
  char next() {
    const char c = text_.front();
    text_.remove_prefix(1);
    if (c == '\n') ++line_;
    return c;
  }
  [[nodiscard]] bool comes(char c) {
    blanks();
    return !text_.empty() && text_.front() == c;
  }
  void expect(char c, const char* where) {
    if (!good()) return;
    if (comes(c)) {
      next();
    } else {
      refuse(line_, std::string(text_.empty() ? "the file ends, and " : "") + '\'' + c +
                        "' is wanted " + where);
    }
  }
  [[nodiscard]] std::string string(const char* where) {
    std::string all;
    expect('"', where);
    while (good()) {
      if (text_.empty() || text_.front() == '\n') {
        refuse(line_, "a text has no end: '\"' is wanted");
        break;
      }
      char c = next();
      if (c == '"') break;
      if (c == '\\') {
        c = text_.empty() ? ' ' : next();
        if (c != '"' && c != '\\' && c != '/') {
          refuse(line_,
                 "of what begins with \\ only \\\", \\\\ and \\/ are read: write the "
                 "character itself");
        }
      }
      all += c;
    }
    return all;
  }
  void object() {
    expect('{', "to begin with");
    bool more = good() && !comes('}');
    while (more && good()) {
      device_entry e;
      e.key = string("before a key");
      e.line = line_;
      expect(':', "after a key");
      e.is_text = comes('"');
      e.is_list = comes('[');
      if (e.is_text) {
        e.value = string("");
      } else if (e.is_list) {
        next();
        while (!text_.empty() && text_.front() != ']' && text_.front() != '}') {
          const char c = next();
          e.value += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
        }
        expect(']', "after the last number of a list");
      } else {
        while (!text_.empty() &&
               std::string_view(",}{[] \t\r\n\":").find(text_.front()) == text_.npos)
          e.value += next();
      }
      for (const auto& other : entries_) {
        if (other.key == e.key) refuse(e.line, in_quotes(e.key) + ": it stands there twice");
      }
      if (!e.is_text && !e.is_list && e.value.empty()) {
        refuse(e.line, in_quotes(e.key) + ": a number, a text, true or false is wanted");
      }
      entries_.push_back(std::move(e));
      more = comes(',');
      if (more) next();
    }
    expect('}', "after the last value, or ',' before another key");
    const int end = line_;
    blanks();
    if (good() && !text_.empty()) refuse(line_, "nothing may follow the last '}'");
    line_ = end;
  }

  std::string_view text_;
  std::string name_, fault_;
  int line_ = 1;
  std::vector<device_entry> entries_;
  std::vector<std::string> known_;
};

}  // namespace detail

/// The text of the file.
[[nodiscard]] inline std::string device_text(const device_description& of) {
  const bool exact = std::holds_alternative<exact_device>(of.device);
  std::string text = std::string("{\n  \"") + detail::device_version_key + "\": 1";
  const auto line = [&text](const char* key, const std::string& value) {
    text += std::string(",\n  \"") + key + "\": " + value;
  };
  if (!of.name.empty()) line("name", detail::in_quotes(of.name));
  line("kind", exact ? "\"exact\"" : "\"encoder\"");
  detail::for_each_entry(
      of,
      [&](const std::string_view key, double x) {  // no number, or the default: left out
        const bool zero = key == "top_speed" || key == "winding_time" || key == "hand_force" ||
                          key == "gain_tolerance";
        if (kernels::is_finite(x) && !(zero && x == 0.0)) {
          line(std::string(key).c_str(), detail::shortest(x));
        }
      },
      [&](const char* key, bool yes) { line(key, yes ? "true" : "false"); });
  std::string gains;
  for (const double g : of.gains) gains += (gains.empty() ? "" : ", ") + detail::shortest(g);
  if (!gains.empty()) line("gains", '[' + gains + ']');
  return text + "\n}\n";
}

/// Reads such a text; messages begin with `name`.
[[nodiscard]] inline loaded_device read_device(std::istream& in, const std::string& name) {
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  detail::device_reader file(text, name);
  loaded_device loaded;
  double version = 0.0;
  file.number(detail::device_version_key, version);
  if (version != detail::device_version) {
    file.refuse(file.line_of(detail::device_version_key),
                std::string("\"") + detail::device_version_key +
                    "\": 1 is wanted: it says which keys there are");
  }
  std::string kind;
  file.text("name", loaded.of.name);
  file.text("kind", kind);
  if (kind == "encoder") {
    loaded.of.device = encoder_device{};
  } else if (kind != "exact") {
    file.refuse(file.line_of("kind"),
                "\"kind\": \"exact\" is wanted, or \"encoder\" where steps are felt");
  }
  detail::for_each_entry(
      loaded.of, [&](const char* key, auto& x) { file.number(key, x); },
      [&](const char* key, bool& yes) { file.flag(key, yes); });
  file.numbers("gains", loaded.of.gains);
  file.nothing_unknown(kind);
  auto wrong = std::visit([](const auto& d) { return d.check(); }, loaded.of.device);
  if (!wrong && !passive_haptics::detail::not_negative(loaded.of.hand_force)) {
    wrong = {"hand_force", loaded.of.hand_force, "finite and ≥ 0 N"};
  }
  if (!wrong) wrong = detail::fault_of_gains(loaded.of);
  if (wrong) {
    const bool there = file.take(wrong.parameter) != nullptr;
    file.refuse(file.line_of(wrong.parameter),
                detail::in_quotes(wrong.parameter) +
                    (there ? " is " + detail::shortest(wrong.value) : std::string(" is missing")) +
                    ": wanted is " + wrong.remedy + "; identify finds it");
  }
  loaded.fault = file.fault();
  if (!loaded.fault.empty()) loaded.of = {};
  return loaded;
}

/// The same from a file.
[[nodiscard]] inline loaded_device load_device(const std::string& path) {
  std::ifstream in(path);
  if (!in.good()) return {path + ": cannot be read: is there such a file?", {}};
  return read_device(in, path);
}

/// Writes the whole file, or nothing. Returns an empty text, or a sentence that says why nothing was written.
[[nodiscard]] inline std::string save_device(const std::string& path,
                                             const device_description& of) {
  auto wrong = std::visit([](const auto& d) { return d.check(); }, of.device);
  if (!wrong) wrong = detail::fault_of_gains(of);
  if (wrong) {
    return path + ": not written, because " + wrong.parameter + " is " +
           detail::shortest(wrong.value) + ": wanted is " + wrong.remedy;
  }
  const std::string beside = path + ".part";
  std::ofstream out(beside);
  out << device_text(of);
  out.close();
  if (out.fail() || std::rename(beside.c_str(), path.c_str()) != 0) {
    std::remove(beside.c_str());
    return path + ": cannot be written: is there such a folder, and room on the disk?";
  }
  return {};
}

/// What a composition of P states of a device whose commands go through gains_of(). The numbers of a description may be
/// in newtons delivered, as on a data sheet, or in those commanded, as identify() finds them where it knows no gains, and
/// then a gain of g makes them 1/g times as large. So they count g times where g < 1, and a hand's force where g > 1.
/// On one axis a tolerance ε is left to in_commands(), with every ledger and bound. On several, exact positions have
/// b/(1 + ε)², and no hand is stated: compose for any_hand. On several with steps nothing covers it: `fault` says so.
template <port P>
[[nodiscard]] loaded_device behind_gains(device_description of) {
  const double tolerance = of.gain_tolerance;
  if (const auto wrong = detail::fault_of_gains(of)) {
    return {std::string(wrong.parameter) + ": wanted is " + wrong.remedy, {}};
  }
  if (of.gains.empty()) return {{}, std::move(of)};
  if (of.gains.size() != static_cast<std::size_t>(P::dof)) {
    return {"gains: wanted is one for each axis of the port", {}};
  }
  const auto [least, most] = std::minmax_element(of.gains.begin(), of.gains.end());
  const double delivered = (std::min)(*least, 1.0);
  std::visit(
      [&](auto& d) {
        d = in_commands(d, 1.0 / delivered - 1.0);
        d.force_limit *= delivered;
        if constexpr (requires { d.continuous_force; }) d.continuous_force *= delivered;
      },
      of.device);
  of.hand_force *= (std::max)(*most, 1.0);
  if (!(tolerance > 0.0)) return {{}, std::move(of)};
  if constexpr (P::dof == 1) {
    std::visit([&](auto& d) { d = in_commands(d, tolerance); }, of.device);
    of.hand_force /= 1.0 - tolerance;
  } else if (auto* exact = std::get_if<exact_device>(&of.device)) {
    exact->damping /= (1.0 + tolerance) * (1.0 + tolerance);
    of.hand_force = 0.0;
  } else {
    return {
        "gain_tolerance: on steps no ledger of several axes covers gains that differ: weigh until "
        "it is small, and state 0",
        {}};
  }
  return {{}, std::move(of)};
}
/// `device` behind the gains of its description, all 1 if it was not weighed.
template <port P, haptic_device_for<P> Device>
[[nodiscard]] known_gains<P, Device> gains_of(const device_description& of, Device& device) {
  typename known_gains<P, Device>::numbers gains{};
  // With gains of another number of axes no sample is valid.
  gains.fill(of.gains.empty() ? 1.0 : 0.0);
  if (of.gains.size() == gains.size()) std::copy(of.gains.begin(), of.gains.end(), gains.begin());
  return {device, gains, P::dof == 1 ? 0.0 : of.gain_tolerance};
}

/// The description of an identified device: an encoder_device if steps were seen. Set `rotary` for a joint.
template <int Dof>
[[nodiscard]] device_description described(const device_found<Dof>& found, const std::string& name,
                                           double hand_force = 0.0) {
  const encoder_device d = found.stated();
  if (d.quantum > 0.0) return {name, d, hand_force};
  return {name,
          exact_device{.mass = d.mass,
                       .damping = d.damping,
                       .force_limit = d.force_limit,
                       .longest_tick = d.longest_tick,
                       .latency = d.latency},
          hand_force};
}
/// The description of a device of the catalogue, to be completed: numbers that are not published are left out of its
/// text, and read_device() asks for them by name. For a wall, state half of the mass and friction of a data sheet.
[[nodiscard]] inline device_description described(const design::device_facts& facts) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto value = [](const design::fact& f) { return f ? f.value : unknown; };
  encoder_device d{.mass = value(facts.mass),
                   .damping = value(facts.damping),
                   .friction = value(facts.friction),
                   .presliding = value(facts.presliding),
                   .quantum = value(facts.quantum[0]),
                   .force_limit = value(facts.peak_force),
                   .longest_tick = unknown,
                   .rotary = facts.rotary};
  for (const auto& q : facts.quantum) {
    if (q) d.quantum = kernels::larger(d.quantum, q.value);
  }
  if (facts.latency) d.latency = static_cast<int>(facts.latency.value);
  if (facts.continuous_force) d.continuous_force = facts.continuous_force.value;
  return {facts.name, d, 0.0};
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
