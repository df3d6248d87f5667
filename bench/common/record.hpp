// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The fields of a result, defined once: a line of a CSV file, an object of a JSON file and a row of a table for
// people are made of the same fields.

#include "text.hpp"

#include <concepts>
#include <cstdint>

namespace experiments {

/// A value and its name, unit included; `pattern` prints a number for people. In CSV a std::string is quoted,
/// because names have commas; a plain word is not.
struct field {
  std::string name, shown, json;
  double number = 0.0;
  enum class kind : std::uint8_t { number, word, name } is = kind::word;

  field(std::string n, double x, const char* pattern = "%.3g")
      : name(std::move(n)), shown(format(pattern, x)), json(json_number(x)), number(x) {
    is = kind::number;
  }
  template <std::integral Count>
  field(std::string n, Count x) : name(std::move(n)), shown(std::to_string(x)), json(shown) {}
  field(std::string n, bool yes)
      : name(std::move(n)), shown(yes ? "yes" : "no"), json(yes ? "true" : "false") {}
  field(std::string n, const char* word)
      : name(std::move(n)), shown(word), json(json_string(shown)) {}
  field(std::string n, const std::string& text) : field(std::move(n), text.c_str()) {
    is = kind::name;
  }

  /// The same field under another name, for a table that needs a short one.
  [[nodiscard]] field renamed(std::string other) const {
    field same = *this;
    same.name = std::move(other);
    return same;
  }
  /// A number by `pattern`; empty if there is none.
  [[nodiscard]] std::string csv(const char* pattern) const {
    if (is == kind::number) return std::isfinite(number) ? format(pattern, number) : "";
    return is == kind::name ? '"' + shown + '"' : shown;
  }
  /// "rms speed m/s" is rms_speed_m_per_s.
  [[nodiscard]] std::string key() const {
    return escaped(name, {{'/', "_per_"}, {' ', "_"}, {',', ""}, {'|', ""}});
  }
};
using record = std::vector<field>;

/// Enough digits to read a number back.
inline constexpr const char* exactly = "%.17g";

inline std::string csv_heading(const record& r) {
  std::string text;
  for (const auto& f : r) text += (text.empty() ? "" : ",") + f.name;
  return text;
}
inline std::string csv_line(const record& r, const char* pattern = exactly) {
  std::string text;
  for (const auto& f : r) {
    if (!text.empty()) text += ',';
    text += f.csv(pattern);
  }
  return text;
}
inline std::string json_of(const record& r) {
  std::vector<std::pair<std::string, std::string>> members;
  for (const auto& f : r) members.emplace_back(f.key(), f.json);
  return json_object(members);
}
inline std::string json_of(const std::vector<std::string>& sentences) {
  std::vector<std::string> items;
  for (const auto& sentence : sentences) items.push_back(json_string(sentence));
  return json_array(items);
}

/// The default of `as`: the row is a record.
inline constexpr auto as_it_is = [](const auto& row) {
  if constexpr (std::same_as<std::remove_cvref_t<decltype(row)>, record>) {
    return row;
  } else {
    return record_of(row);
  }
};

/// The rows as records, by `as`.
template <class Row, class As = decltype(as_it_is)>
std::string json_of(const std::vector<Row>& rows, As as = {}) {
  std::vector<std::string> items;
  for (const auto& row : rows) items.push_back(json_of(as(row)));
  return json_array(items);
}
/// The same as a table for people; a row for which `as` gives nothing is left out.
template <class Row, class As = decltype(as_it_is)>
table table_of(const std::vector<Row>& rows, As as = {}) {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> lines;
  for (const auto& row : rows) {
    const record fields = as(row);
    if (fields.empty()) continue;
    heading.clear();
    lines.emplace_back();
    for (const auto& f : fields) {
      heading.push_back(f.name);
      lines.back().push_back(f.shown);
    }
  }
  table all(heading);
  for (auto& cells : lines) all.add(std::move(cells));
  return all;
}

}  // namespace experiments
