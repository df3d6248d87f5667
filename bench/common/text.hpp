// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers and tables as text: JSON, CSV cells, and one table for terminal, HTML and Markdown.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace experiments {

/// A number as JSON, null if it is not finite.
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

/// The cells between the commas of a line.
inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream rest(line);
  for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The text of a printf of one number, "-" for none.
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

/// The most columns of a terminal that programs use.
inline constexpr std::size_t terminal_columns = 80;

/// The columns that `text` takes on a terminal, in characters and not in bytes.
inline std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // the first byte of it in UTF-8
  }));
}

/// `text` in lines of at most `most` columns, broken at blanks; a longer word has a line of its own.
inline std::vector<std::string> broken(const std::string& text, std::size_t most) {
  if (columns_of(text) <= most) return {text};
  std::vector<std::string> lines{""};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t taken = columns_of(lines.back());
    if (taken > 0 && taken + 1 + columns_of(word) > most) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

/// The same as one text, with `indent` blanks before every line but the first.
inline std::string paragraph(const std::string& text, std::size_t indent = 0) {
  std::string all;
  for (const auto& line : broken(text, terminal_columns - indent)) {
    if (!all.empty()) all.append("\n").append(indent, ' ');
    all += line;
  }
  return all;
}

/// A table for people: padded on the terminal, marked up for the pages.
class table {
 public:
  explicit table(std::vector<std::string> heading) : rows_{std::move(heading)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  /// Prints the table with lines of at most `most` columns. Headings are broken at their blanks, then cells that
  /// have no room beside the first one. Columns that still have no room stand in a block below, after the first
  /// column once more.
  void print(std::ostream& out, std::size_t most = terminal_columns) const {
    std::vector<std::size_t> width = widths();
    for (const std::size_t heading : {14U, 10U, 7U, 0U}) {
      if (std::accumulate(width.begin(), width.end(), gap * (width.size() - 1)) <= most) break;
      width = narrow_widths(most, heading);
    }
    std::size_t next = 1;
    do {
      std::vector<std::size_t> block{0};
      std::size_t taken = width[0];
      while (next < width.size() && (block.size() == 1 || taken + gap + width[next] <= most)) {
        taken += gap + width[next];
        block.push_back(next++);
      }
      for (const auto& row : rows_) print_row(out, row, block, width);
      out << '\n';
    } while (next < width.size());
  }
  /// The table as HTML, with columns of numbers aligned to the right.
  [[nodiscard]] std::string html() const {
    std::vector<bool> numbers(rows_[0].size(), rows_.size() > 1);
    for (std::size_t r = 1; r < rows_.size(); ++r) {
      for (std::size_t i = 0; i < rows_[r].size(); ++i) {
        numbers[i] = numbers[i] && is_number(rows_[r][i]);
      }
    }
    std::string text = "<table>\n<thead>\n";
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const std::string tag = r == 0 ? "th" : "td";
      text += "<tr>";
      for (std::size_t i = 0; i < rows_[r].size(); ++i) {
        text += "<" + tag + (numbers[i] ? " class=\"n\">" : ">") + html_text(rows_[r][i]) + "</" +
                tag + ">";
      }
      text += r == 0 ? "</tr>\n</thead>\n<tbody>\n" : "</tr>\n";
    }
    return text + "</tbody>\n</table>\n";
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
  static constexpr std::size_t gap = 2;  ///< between columns

  /// True for one word that begins like a number, and for the dash that stands for none.
  static bool is_number(const std::string& cell) {
    if (cell.empty() || cell == "-") return true;
    const std::size_t sign = cell[0] == '-' || cell[0] == '+' ? 1 : 0;
    return sign < cell.size() && cell[sign] >= '0' && cell[sign] <= '9' &&
           cell.find(' ') == std::string::npos;
  }

  /// The width of each column.
  [[nodiscard]] std::vector<std::size_t> widths() const {
    std::vector<std::size_t> width(rows_[0].size());
    for (const auto& row : rows_) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        width[i] = std::max(width[i], columns_of(row[i]));
      }
    }
    return width;
  }
  /// The widths with headings of `heading` columns, and cells in the room beside the first one.
  [[nodiscard]] std::vector<std::size_t> narrow_widths(std::size_t most,
                                                       std::size_t heading) const {
    std::vector<std::size_t> width;
    const auto fit = [&width](const std::string& text, std::size_t room) {
      for (const auto& line : broken(text, room)) {
        width.back() = std::max(width.back(), columns_of(line));
      }
    };
    for (std::size_t i = 0; i < rows_[0].size(); ++i) {
      const std::size_t room = i == 0 ? most : most - std::min(most, width[0] + gap);
      width.push_back(0);
      fit(rows_[0][i], heading);
      for (std::size_t r = 1; r < rows_.size(); ++r) fit(rows_[r][i], room);
    }
    return width;
  }
  /// Prints the cells of `block`, each broken to the width of its column.
  static void print_row(std::ostream& out, const std::vector<std::string>& row,
                        const std::vector<std::size_t>& block,
                        const std::vector<std::size_t>& width) {
    std::vector<std::vector<std::string>> cells;
    std::size_t height = 1;
    for (const std::size_t i : block) {
      cells.push_back(broken(row[i], width[i]));
      height = std::max(height, cells.back().size());
    }
    for (std::size_t line = 0; line < height; ++line) {
      std::string text;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string cell = line < cells[i].size() ? cells[i][line] : "";
        text += cell + std::string(width[block[i]] - columns_of(cell) + gap, ' ');
      }
      out << text.substr(0, text.find_last_not_of(' ') + 1) << '\n';
    }
  }

  std::vector<std::vector<std::string>> rows_;
};

}  // namespace experiments
