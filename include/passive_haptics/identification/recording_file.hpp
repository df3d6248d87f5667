// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads a recording from a file: CSV, MATLAB's MAT 5 or NumPy's .npy and .npz, neither of them compressed.
//
//     load_recording("log.csv", {.position = "q1", .force = "tau1"})
//     load_recording("log.mat", {.time = "t", .position = "data:2", .force = "data:3"})
//     load_recording("log.npz", {.time = "", .tick = 1e-3, .position = "x", .force = "f", .force_scale = 35.0})
//
// A column is found by its name, or by its number from 1 on. A heading may end in a unit, as time_ms, "x [mm]" or
// torque(N.m); its scale then multiplies the one that is stated. For a file without a column of time, state the tick
// [s]. A value that cannot be read is refused by a sentence with the row, the value and the remedy.
//
// Formats: MAT-File Format, The MathWorks, level 5; NEP 1, "A Simple File Format for NumPy Arrays"; APPNOTE 6.3 of
// PKWARE for the archive that an .npz is.

#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/identification/recording.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// The names of the columns of a file, and the SI units in one unit of each.
struct recording_columns {
  std::string time = "time", position = "position", force = "force";
  double time_scale = 1.0, position_scale = 1.0, force_scale = 1.0;
  double tick = 0.0;    ///< the time from row to row [s], if `time` is empty
  bool rotary = false;  ///< radians and newton metres
};

/// The rows, or a sentence in `fault`.
struct loaded_recording {
  recording rows;
  std::string fault;
};

namespace detail {

constexpr std::size_t most_rows = 20'000'000;

/// The columns of a file, by name and in their order.
struct named_columns {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  std::string fault;

  void add(std::string name, std::vector<double> column) {
    names.push_back(std::move(name));
    columns.push_back(std::move(column));
  }
  named_columns& refuse(std::string why) {
    fault = std::move(why);
    return *this;
  }
};

/// A unit at the end of a heading, and its size in SI; `cut` is how much of the heading it takes.
struct heading_unit {
  double scale = 1.0;
  std::size_t cut = 0;
};
[[nodiscard]] inline heading_unit unit_of(std::string_view heading) {
  struct known {
    std::string_view text;
    double scale;
  };
  static constexpr known units[] = {
      {"s", 1.0},     {"sec", 1.0},  {"ms", 1e-3},   {"us", 1e-6},
      {"ns", 1e-9},   {"m", 1.0},    {"mm", 1e-3},   {"um", 1e-6},
      {"µm", 1e-6},   {"rad", 1.0},  {"mrad", 1e-3}, {"deg", 3.14159265358979323846 / 180.0},
      {"N", 1.0},     {"mN", 1e-3},  {"kN", 1e3},    {"Nm", 1.0},
      {"N.m", 1.0},   {"N·m", 1.0},  {"N m", 1.0},   {"mNm", 1e-3},
      {"mN.m", 1e-3}, {"mN·m", 1e-3}};
  for (const known& u : units) {
    for (const auto& [before, after] : {std::pair{"_", ""}, {"[", "]"}, {"(", ")"}, {"/", ""}}) {
      const std::string end = std::string(before) + std::string(u.text) + after;
      if (heading.size() > end.size() && heading.ends_with(end)) return {u.scale, end.size()};
    }
  }
  return {};
}
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::string_view(" \t\r\"'").find(text.front()) != std::string_view::npos)
    text.remove_prefix(1);
  while (!text.empty() && std::string_view(" \t\r\"'").find(text.back()) != std::string_view::npos)
    text.remove_suffix(1);
  return text;
}

/// The index of the column called `name`, with or without its unit, or of that number; -1 if there is none.
[[nodiscard]] inline int column_called(const named_columns& of, const std::string& name,
                                       double& scale) {
  for (std::size_t i = 0; i < of.names.size(); ++i) {
    const std::string_view heading = of.names[i];
    const heading_unit unit = unit_of(heading);
    if (heading == name || trimmed(heading.substr(0, heading.size() - unit.cut)) == name) {
      scale *= unit.scale;
      return static_cast<int>(i);
    }
  }
  const auto number = to_decimal(name);
  if (number && *number >= 1.0 && *number <= static_cast<double>(of.names.size()) &&
      *number == std::floor(*number)) {
    scale *= unit_of(of.names[static_cast<std::size_t>(*number) - 1]).scale;
    return static_cast<int>(*number) - 1;
  }
  return -1;
}

[[nodiscard]] inline named_columns read_csv(std::string_view text) {
  named_columns all;
  std::size_t line_number = 0, row = 0;
  char separator = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++line_number;
    if (line_number == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    if (trimmed(line).empty() || line.front() == '#' || line.front() == '%') continue;
    if (separator == 0) {
      for (const char one : {';', '\t', ',', ' '}) {
        if (separator == 0 && line.find(one) != std::string_view::npos) separator = one;
      }
      if (separator == 0) separator = ',';
    }
    std::vector<std::string_view> cells;
    for (std::string_view rest = trimmed(line);;) {
      const std::size_t at = rest.find(separator);
      const std::string_view cell = trimmed(rest.substr(0, at));
      if (separator != ' ' || !cell.empty()) cells.push_back(cell);
      if (at == std::string_view::npos) break;
      rest.remove_prefix(at + 1);
    }
    if (all.names.empty()) {
      const bool headed = !to_decimal(cells.front()).has_value();
      for (std::size_t i = 0; i < cells.size(); ++i) {
        all.add(headed ? std::string(cells[i]) : std::to_string(i + 1), {});
      }
      if (headed) continue;
    }
    const std::string where =
        "line " + std::to_string(line_number) + ", row " + std::to_string(++row) + ": ";
    if (cells.size() != all.names.size()) {
      return all.refuse(where + std::to_string(cells.size()) + " cells stand here and " +
                        std::to_string(all.names.size()) +
                        " in the heading: repair that line, or cut the file before it");
    }
    if (row > most_rows) {
      return all.refuse(where + "a recording may have 20 million rows: replay it in parts");
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = to_decimal(cells[i]);
      // A column that is not used may hold words; in a column that is used fault_of() reports them.
      all.columns[i].push_back(value ? *value : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return all;
}

/// Reads little-endian numbers of a file, never beyond its end.
class byte_reader {
 public:
  explicit byte_reader(std::string_view bytes) noexcept : bytes_(bytes) {}

  [[nodiscard]] bool good() const noexcept { return good_; }
  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size() - at_; }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }
  void go_to(std::size_t at) noexcept {
    good_ = good_ && at <= bytes_.size();
    if (good_) at_ = at;
  }
  [[nodiscard]] std::string_view take(std::size_t count) noexcept {
    if (!good_ || count > left()) {
      good_ = false;
      return {};
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  template <class Number>
  [[nodiscard]] Number number() noexcept {
    return as<Number>(take(sizeof(Number)));
  }
  template <class Number>
  [[nodiscard]] static Number as(std::string_view bytes) noexcept {
    if (bytes.size() < sizeof(Number)) return {};
    std::array<char, sizeof(Number)> raw{};
    std::memcpy(raw.data(), bytes.data(), sizeof(Number));
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

/// Reads consecutive numbers of one kind, signed (i), unsigned (u) or floating (f), of `size` bytes each.
[[nodiscard]] inline bool numbers_of(std::string_view bytes, char kind, std::size_t size,
                                     std::vector<double>& out) {
  const auto all = [&]<class Number>(Number) {
    if (bytes.size() / sizeof(Number) > most_rows * 8) return false;
    out.reserve(bytes.size() / sizeof(Number));
    for (std::size_t i = 0; i + sizeof(Number) <= bytes.size(); i += sizeof(Number)) {
      out.push_back(static_cast<double>(byte_reader::as<Number>(bytes.substr(i, sizeof(Number)))));
    }
    return true;
  };
  if (kind == 'f') return size == 8 ? all(double{}) : size == 4 && all(float{});
  if (kind == 'i') {
    return size == 1   ? all(std::int8_t{})
           : size == 2 ? all(std::int16_t{})
           : size == 4 ? all(std::int32_t{})
                       : size == 8 && all(std::int64_t{});
  }
  if (kind == 'u' || kind == 'b') {
    return size == 1   ? all(std::uint8_t{})
           : size == 2 ? all(std::uint16_t{})
           : size == 4 ? all(std::uint32_t{})
                       : size == 8 && all(std::uint64_t{});
  }
  return false;
}

/// Adds a matrix stored by columns. A single column or row is called `name`, several are called name:1, name:2, ….
inline void add_matrix(named_columns& all, const std::string& name,
                       const std::vector<double>& values, std::size_t rows, std::size_t count,
                       bool by_columns) {
  if (rows == 1) std::swap(rows, count);
  if (rows < 2 || count < 1 || values.size() / rows < count) return;
  if (count > 4096) return;
  for (std::size_t c = 0; c < count; ++c) {
    std::vector<double> column(rows);
    for (std::size_t i = 0; i < rows; ++i)
      column[i] = values[by_columns ? c * rows + i : i * count + c];
    all.add(count == 1 ? name : name + ":" + std::to_string(c + 1), std::move(column));
  }
}

[[nodiscard]] inline named_columns read_mat(std::string_view bytes) {
  named_columns all;
  if (bytes.starts_with("\x89HDF") || bytes.starts_with("MATLAB 7.3")) {
    return all.refuse(
        "it is of MATLAB 7.3, which is HDF5: save it again by save('file.mat', '-v6')");
  }
  byte_reader in(bytes);
  in.go_to(124);
  const auto version = in.number<std::uint16_t>();
  const std::string_view order = in.take(2);
  if (!in.good() || order != "IM" || version != 0x0100) {
    return all.refuse(
        order == "MI"
            ? "it comes from a big-endian machine: save it again by save('file.mat', '-v6')"
            : "it is no MAT file of level 5: save it by save('file.mat', '-v6')");
  }
  // An element has type, size and data, padded to 8 bytes; a small one has all three within 8 bytes.
  struct element {
    std::uint32_t type = 0;
    std::string_view data;
  };
  const auto next = [](byte_reader& from) {
    element e;
    const auto word = from.number<std::uint32_t>();
    if (word >> 16U != 0) {
      e.type = word & 0xFFFFU;
      const std::string_view four = from.take(4);
      e.data = four.substr(0, (std::min)(four.size(), static_cast<std::size_t>(word >> 16U)));
      return e;
    }
    e.type = word;
    const auto size = from.number<std::uint32_t>();
    e.data = from.take(size);
    if (e.type != 15 && size % 8 != 0)
      static_cast<void>(from.take((std::min)(from.left(), std::size_t{8 - size % 8})));
    return e;
  };
  while (in.good() && in.left() >= 8) {
    const std::size_t begun = in.at();
    const element whole = next(in);
    if (!in.good())
      return all.refuse("it is cut off in byte " + std::to_string(begun) + ": copy it anew");
    if (whole.type == 15) {
      return all.refuse("its variables are compressed: save it again by save('file.mat', '-v6')");
    }
    if (whole.type != 14) continue;  // not a matrix
    byte_reader part(whole.data);
    const element flags = next(part), sizes = next(part), name = next(part), content = next(part);
    if (!part.good() || flags.data.size() < 8 || sizes.data.size() < 8) continue;
    const auto array_class = static_cast<std::uint8_t>(flags.data[0]);
    if (array_class < 6 || array_class > 15)
      continue;  // cells, structures, characters, sparse ones
    static constexpr std::array<std::pair<char, std::size_t>, 14> kinds{{{0, 0},
                                                                         {'i', 1},
                                                                         {'u', 1},
                                                                         {'i', 2},
                                                                         {'u', 2},
                                                                         {'i', 4},
                                                                         {'u', 4},
                                                                         {'f', 4},
                                                                         {0, 0},
                                                                         {'f', 8},
                                                                         {0, 0},
                                                                         {0, 0},
                                                                         {'i', 8},
                                                                         {'u', 8}}};
    std::vector<double> values;
    if (content.type >= kinds.size()) continue;
    const auto [kind, size] = kinds[content.type];
    if (!numbers_of(content.data, kind, size, values)) continue;
    const auto rows = byte_reader::as<std::uint32_t>(sizes.data);
    const auto count = byte_reader::as<std::uint32_t>(sizes.data.substr(4));
    add_matrix(all, std::string(name.data), values, rows, count, true);
  }
  return all;
}

/// The text after `key` in the heading of an .npy, up to one of `ends`.
[[nodiscard]] inline std::string_view npy_entry(std::string_view heading, std::string_view key,
                                                char open, char close) {
  const std::size_t at = heading.find(key);
  if (at == std::string_view::npos) return {};
  const std::size_t first = heading.find(open, at + key.size());
  if (first == std::string_view::npos) return {};
  const std::size_t last = heading.find(close, first + 1);
  return last == std::string_view::npos ? std::string_view{}
                                        : heading.substr(first + 1, last - first - 1);
}

inline void read_npy(named_columns& all, std::string_view bytes, const std::string& name) {
  byte_reader in(bytes);
  const std::string_view magic = in.take(6);
  const auto major = in.number<std::uint8_t>();
  static_cast<void>(in.number<std::uint8_t>());
  const std::size_t size = major == 1 ? in.number<std::uint16_t>() : in.number<std::uint32_t>();
  const std::string_view heading = in.take(size);
  if (!in.good() || magic != "\x93NUMPY") {
    all.fault = name + " is no array of NumPy, or is cut off: write it anew by numpy.save";
    return;
  }
  const std::string_view data = in.take(in.left());
  std::vector<std::size_t> shape;
  for (std::string_view rest = npy_entry(heading, "'shape'", '(', ')'); !rest.empty();) {
    const std::size_t at = rest.find(',');
    const auto number = to_decimal(trimmed(rest.substr(0, at)));
    if (number && *number >= 0.0 && *number < 1e12)
      shape.push_back(static_cast<std::size_t>(*number));
    if (at == std::string_view::npos) break;
    rest.remove_prefix(at + 1);
  }
  const bool by_columns = heading.find("'fortran_order': True") != std::string_view::npos;
  const std::size_t after = heading.find("'descr'");
  const std::string_view kind =
      after == std::string_view::npos ? std::string_view{} : heading.substr(after + 7);
  const bool named = kind.find('[') != std::string_view::npos && kind.find('[') < kind.find('\'');
  if (shape.empty() || shape.size() > 2) return;
  struct one_kind {
    std::string name;
    char kind = 0;
    std::size_t size = 0;
  };
  const auto parsed = [&](std::string_view text) -> one_kind {
    if (text.size() < 3 || text[0] == '>') return {};
    const auto count = to_decimal(text.substr(2));
    return {{},
            text[1],
            count && *count >= 1.0 && *count <= 8.0 ? static_cast<std::size_t>(*count) : 0};
  };
  std::vector<one_kind> fields;
  std::size_t row_size = 0;
  if (named) {
    const std::size_t first = kind.find('[');
    std::string_view rest = kind.substr(first, kind.find(']') - first);
    while (true) {
      const std::string_view pair = npy_entry(rest, "", '(', ')');
      if (pair.empty()) break;
      const std::string_view field = npy_entry(pair, "", '\'', '\'');
      const std::size_t comma = pair.find(',');
      one_kind k =
          parsed(comma == std::string_view::npos ? std::string_view{}
                                                 : npy_entry(pair.substr(comma), "", '\'', '\''));
      k.name = std::string(field);
      row_size += k.size;
      fields.push_back(k);
      rest.remove_prefix(rest.find(')') + 1);
    }
  } else {
    fields.push_back(parsed(npy_entry(kind, "", '\'', '\'')));
    row_size = fields[0].size;
  }
  bool known = row_size > 0;
  for (const one_kind& f : fields) {
    known =
        known && f.size > 0 && (f.kind == 'f' || f.kind == 'i' || f.kind == 'u' || f.kind == 'b');
  }
  if (!known) {
    all.fault =
        name + " holds other numbers than little-endian float or int: convert it by .astype('<f8')";
    return;
  }
  if (!named) {
    std::vector<double> values;
    if (!numbers_of(data, fields[0].kind, fields[0].size, values)) return;
    const std::size_t count = shape.size() == 2 ? shape[1] : 1;
    add_matrix(all, name, values, shape[0], count, by_columns);
    return;
  }
  std::size_t offset = 0;
  const std::size_t rows = (std::min)(shape[0], data.size() / row_size);
  for (const one_kind& f : fields) {
    std::vector<double> values;
    for (std::size_t i = 0; i < rows; ++i) {
      static_cast<void>(
          numbers_of(data.substr(i * row_size + offset, f.size), f.kind, f.size, values));
      if (i == 0) values.reserve(rows);
    }
    offset += f.size;
    all.add(f.name, std::move(values));
  }
}

[[nodiscard]] inline named_columns read_npz(std::string_view bytes) {
  named_columns all;
  const std::size_t end = bytes.rfind(std::string_view("PK\x05\x06", 4));
  byte_reader in(bytes);
  in.go_to(end == std::string_view::npos ? bytes.size() + 1 : end + 10);
  const auto entries = in.number<std::uint16_t>();
  static_cast<void>(in.number<std::uint32_t>());
  in.go_to(in.number<std::uint32_t>());  // the directory, at the end of the archive
  for (int i = 0; i < entries && in.good(); ++i) {
    const std::size_t entry = in.at();
    in.go_to(entry + 10);
    const auto method = in.number<std::uint16_t>();
    in.go_to(entry + 20);
    const auto size = in.number<std::uint32_t>();
    in.go_to(entry + 28);
    const auto name_size = in.number<std::uint16_t>();
    const auto extra = in.number<std::uint16_t>();
    const auto comment = in.number<std::uint16_t>();
    in.go_to(entry + 42);
    const auto offset = in.number<std::uint32_t>();
    std::string name(in.take(name_size));
    in.go_to(in.at() + extra + comment);
    if (!in.good()) break;
    if (method != 0) {
      return all.refuse(
          "its arrays are compressed: write it by numpy.savez, not by savez_compressed");
    }
    if (name.ends_with(".npy")) name.resize(name.size() - 4);
    byte_reader local(bytes);
    local.go_to(std::size_t{offset} + 26);
    const auto own_name = local.number<std::uint16_t>();
    const auto own_extra = local.number<std::uint16_t>();
    local.go_to(local.at() + own_name + own_extra);
    const std::string_view data = local.take(size);
    if (!local.good()) break;
    read_npy(all, data, name);
    if (!all.fault.empty()) return all;
  }
  if (all.names.empty())
    all.fault = "it is no archive of arrays, or is cut off: write it anew by numpy.savez";
  return all;
}

/// The columns of a file, whose format is known by its first bytes and not by its name.
[[nodiscard]] inline named_columns read_columns(std::string_view bytes) {
  if (bytes.starts_with("PK")) return read_npz(bytes);
  if (bytes.starts_with("MATLAB") || bytes.starts_with("\x89HDF")) return read_mat(bytes);
  if (bytes.starts_with("\x93NUMPY")) {
    named_columns all;
    read_npy(all, bytes, "array");
    // The columns of an array without names are called by their numbers.
    for (std::size_t i = 0; i < all.names.size(); ++i) {
      if (all.names[i].starts_with("array:")) all.names[i] = std::to_string(i + 1);
    }
    return all;
  }
  if (bytes.find('\0') != std::string_view::npos) {
    named_columns none;
    return none.refuse(
        "it is no text, no MAT file of level 5 and no .npy or .npz: export it as CSV");
  }
  return read_csv(bytes);
}

}  // namespace detail

/// The recording in the bytes of a file; messages begin with `name`.
[[nodiscard]] inline loaded_recording read_recording(std::string_view bytes,
                                                     const std::string& name,
                                                     const recording_columns& which) {
  loaded_recording loaded;
  loaded.rows.rotary = which.rotary;
  const auto refuse = [&](const std::string& why) {
    loaded.rows = {};
    loaded.fault = name + ": " + why;
    return loaded;
  };
  for (const double scale : {which.time_scale, which.position_scale, which.force_scale}) {
    if (!kernels::is_finite(scale) || scale == 0.0) {
      return refuse("a scale of " + detail::printed("%g", scale) +
                    " is stated, finite and not 0 is wanted");
    }
  }
  detail::named_columns all = detail::read_columns(bytes);
  if (!all.fault.empty()) return refuse(all.fault);
  std::string there;
  for (std::size_t i = 0; i < all.names.size() && i < 20; ++i)
    there += (i > 0 ? ", " : "") + all.names[i];
  const auto take = [&](const std::string& called, const char* of, double scale,
                        std::vector<double>& where) {
    const int at = detail::column_called(all, called, scale);
    if (at < 0) {
      loaded.fault = name + ": there is no column \"" + called + "\" for the " + of +
                     "; there are " + (there.empty() ? "none" : there);
      return false;
    }
    where = all.columns[static_cast<std::size_t>(at)];
    for (double& one : where) one *= scale;
    return true;
  };
  if (!take(which.position, "position", which.position_scale, loaded.rows.position) ||
      !take(which.force, "force", which.force_scale, loaded.rows.force)) {
    return loaded;
  }
  if (!which.time.empty()) {
    if (!take(which.time, "time", which.time_scale, loaded.rows.time)) return loaded;
  } else if (which.tick > 0.0 && kernels::is_finite(which.tick)) {
    loaded.rows.time.resize(loaded.rows.position.size());
    for (std::size_t i = 0; i < loaded.rows.time.size(); ++i) {
      loaded.rows.time[i] = which.tick * static_cast<double>(i);
    }
  } else {
    return refuse("it has no column of the time: state the tick, finite and > 0 s");
  }
  if (const auto fault = fault_of(loaded.rows); !fault.empty()) return refuse(fault);
  return loaded;
}

/// The same from a file.
[[nodiscard]] inline loaded_recording load_recording(const std::string& path,
                                                     const recording_columns& which = {}) {
  std::ifstream in(path, std::ios::binary);
  if (!in.good()) return {{}, path + ": cannot be read: is there such a file?"};
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return read_recording(bytes, path, which);
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
