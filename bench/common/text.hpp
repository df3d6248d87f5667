// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers and tables as text: JSON, CSV cells, and one table for terminal, HTML and Markdown.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace experiments {

/// A number as JSON knows it: null when there is none.
inline std::string json_number(double x) {
  if (!std::isfinite(x)) return "null";
  std::ostringstream text;
  text.precision(9);
  text << x;
  return text.str();
}

inline std::string json_string(const std::string& s) {
  std::string quoted = "\"";
  for (const char c : s) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) quoted += c;
  }
  return quoted + "\"";
}

/// {"a": 1, "b": "x"}: values are JSON already.
inline std::string json_object(const std::vector<std::pair<std::string, std::string>>& members) {
  std::string text = "{";
  for (const auto& [name, value] : members) {
    if (text.size() > 1) text += ", ";
    text += json_string(name) + ": " + value;
  }
  return text + "}";
}

inline std::string json_array(const std::vector<std::string>& items) {
  std::string text = "[";
  for (const auto& item : items) text += (text.size() > 1 ? ",\n    " : "\n    ") + item;
  return text + "\n  ]";
}

/// printf for one number; "-" for none.
inline std::string format(const char* pattern, double x) {
  if (!std::isfinite(x)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, pattern, x);
  return text;
}

/// `text` with each character that `special` names replaced.
inline std::string escaped(const std::string& text,
                           const std::vector<std::pair<char, std::string>>& special) {
  std::string result;
  for (const char c : text) {
    const auto found = std::find_if(special.begin(), special.end(),
                                    [c](const auto& entry) { return entry.first == c; });
    result += found == special.end() ? std::string(1, c) : found->second;
  }
  return result;
}
inline std::string html_text(const std::string& text) {
  return escaped(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}});
}
inline std::string markdown_cell(const std::string& text) {
  return escaped(text, {{'|', "\\|"}});
}

/// A table for people: padded on the terminal, marked up for the pages.
class table {
 public:
  explicit table(std::vector<std::string> heading) : rows_{std::move(heading)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  void print(std::ostream& out) const {
    std::vector<std::size_t> width;
    for (const auto& row : rows_) {
      width.resize(std::max(width.size(), row.size()));
      for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    for (const auto& row : rows_) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        out << row[i] << std::string(width[i] - row[i].size() + 2, ' ');
      }
      out << '\n';
    }
    out << '\n';
  }
  [[nodiscard]] std::string html() const {
    std::string text = "<table>\n";
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      text += "<tr>";
      for (const auto& cell : rows_[r]) {
        text += r == 0 ? "<th>" + html_text(cell) + "</th>" : "<td>" + html_text(cell) + "</td>";
      }
      text += "</tr>\n";
    }
    return text + "</table>\n";
  }
  [[nodiscard]] std::string markdown() const {
    std::string text;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      for (const auto& cell : rows_[r]) text += "| " + markdown_cell(cell) + " ";
      text += "|\n";
      if (r > 0) continue;
      for (std::size_t i = 0; i < rows_[0].size(); ++i) text += "|---";
      text += "|\n";
    }
    return text + "\n";
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace experiments
