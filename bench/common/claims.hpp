// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a caption says of its curves, and a text of its table, as predicates over the file that they are made of.

#include "text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace experiments {

/// A CSV file as it was written: columns of numbers by their headings, NaN where a cell is no number.
class recorded {
 public:
  recorded() = default;
  explicit recorded(const std::filesystem::path& path) : name_(path.filename().string()) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path.string() + ": cannot be read");
    std::string line;
    std::getline(file, line);
    for (const auto& heading : cells_of(line)) columns_.push_back({heading, {}});
    while (std::getline(file, line)) {
      const auto cells = cells_of(line);
      if (cells.empty()) continue;
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        columns_[i].numbers.push_back(i < cells.size() ? number(cells[i]) : std::nan(""));
      }
    }
  }

  /// All numbers of a column; throws if there is no column of that name.
  [[nodiscard]] const std::vector<double>& operator[](const std::string& heading) const {
    for (const auto& c : columns_) {
      if (c.heading == heading) return c.numbers;
    }
    throw std::runtime_error(name_ + " has no column \"" + heading + "\"");
  }
  /// Those of the rows whose first column is from `from` to `to`.
  [[nodiscard]] std::vector<double> within(const std::string& heading, double from,
                                           double to) const {
    const auto &when = columns_.at(0).numbers, &all = (*this)[heading];
    std::vector<double> some;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (when[i] >= from && when[i] <= to) some.push_back(all[i]);
    }
    return some;
  }

 private:
  struct column {
    std::string heading;
    std::vector<double> numbers;
  };
  static double number(const std::string& cell) {
    char* end = nullptr;
    const double x = std::strtod(cell.c_str(), &end);
    return end == cell.c_str() || *end != '\0' ? std::nan("") : x;
  }

  std::string name_;
  std::vector<column> columns_;
};

/// The least, the most, their difference and the largest step from one to the next.
inline double least(const std::vector<double>& x) {
  return *std::min_element(x.begin(), x.end());
}
inline double most(const std::vector<double>& x) {
  return *std::max_element(x.begin(), x.end());
}
inline double swing(const std::vector<double>& x) {
  return most(x) - least(x);
}
inline double largest_step(const std::vector<double>& x) {
  double step = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) step = std::max(step, std::abs(x[i] - x[i - 1]));
  return step;
}
/// The root of the mean square of a − b.
inline double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b.at(i)) * (a[i] - b.at(i));
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Words of a text, and what must be true of the file for them to be so. Without a file the predicate looks at
/// what it has kept itself.
struct claim {
  std::string words;
  std::string file;
  std::function<bool(const recorded&)> holds;
};

/// The text of a plot.
struct caption {
  std::string title;          ///< a few words, without a full stop
  std::string see;            ///< whole sentences: where to look, and what it means
  std::vector<claim> claims;  ///< one at least; their words stand in the title or the sentences
};

/// What is wrong with the claims of a text, a sentence each: words that are not in it, words that are not so. `which`
/// says what text it is.
inline std::vector<std::string> untrue(const std::string& which, const std::string& text,
                                       const std::vector<claim>& claims,
                                       const std::filesystem::path& folder) {
  std::vector<std::string> found;
  for (const auto& c : claims) {
    if (text.find(c.words) == std::string::npos) {
      found.push_back(which + " does not say \"" + c.words + "\"");
    } else if (!c.holds(c.file.empty() ? recorded{} : recorded(folder / c.file))) {
      found.push_back(which + " is not so: \"" + c.words + "\"");
    }
  }
  return found;
}
/// The same of a caption, which claims something at least.
inline std::vector<std::string> untrue(const std::string& plot, const caption& said,
                                       const std::filesystem::path& folder) {
  auto found = untrue("the caption of " + plot, said.title + "\n" + said.see, said.claims, folder);
  if (said.claims.empty()) found.push_back("the caption of " + plot + " claims nothing");
  return found;
}

}  // namespace experiments
