// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a caption says of its curves, and a text of its table, as predicates over the file that they are made of.

#include "text.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
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

/// What a predicate has found: whether it holds, and by which number, if it is one that says so.
struct finding {
  bool so = false;
  std::string by{};
  finding(std::same_as<bool> auto holds) : so(holds) {}
  finding(bool holds, std::string number) : so(holds), by(std::move(number)) {}
};
/// That a number is so much at least and so much at most; a limit may be infinite.
inline finding between(double is, double at_least, double at_most) {
  const std::string limits = std::isinf(at_most) ? format(", at least %.4g", at_least)
                             : std::isinf(at_least)
                                 ? format(", at most %.4g", at_most)
                                 : format(", %.4g", at_least) + format(" to %.4g", at_most);
  return {is >= at_least && is <= at_most, format("%.4g", is) + limits};
}
inline finding at_least(double is, double limit) {
  return between(is, limit, std::numeric_limits<double>::infinity());
}
inline finding at_most(double is, double limit) {
  return between(is, -std::numeric_limits<double>::infinity(), limit);
}

/// A sentence of a text, or a part of one that can be false by itself: a claim with its predicate, or what nothing
/// drawn could deny. Words without a predicate are none until they are called a definition().
class clause {
 public:
  /// A line of the sources: of the call, where it is a default argument. Without std::source_location, which clang 14
  /// does not have.
  struct place {
    const char* file;
    int line;
    static constexpr place current(const char* file = __builtin_FILE(),
                                   int line = __builtin_LINE()) {
      return {file, line};
    }
  };
  /// A claim about a file of the report's folder, which is written by then.
  template <std::invocable<const recorded&> Holds>
  clause(std::string words, std::string file, Holds holds, place at = place::current())
      : words_(std::move(words)), file_(std::move(file)), holds_(std::move(holds)), at_(at) {}
  /// A claim about what its predicate has kept itself.
  template <std::invocable Holds>
  clause(std::string words, Holds holds, place at = place::current())
      : clause(
            std::move(words), "", [=](const recorded&) -> finding { return holds(); }, at) {}
  friend clause definition(std::string words, place at);

  [[nodiscard]] const std::string& words() const { return words_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] bool is_claim() const { return holds_ != nullptr; }
  [[nodiscard]] finding look_up(const std::filesystem::path& folder) const {
    return holds_(file_.empty() ? recorded{} : recorded(folder / file_));
  }
  /// Where it stands with its predicate, or what it is a part of begins: "bench/organ/chain.cpp:280".
  [[nodiscard]] std::string at() const {
    const std::filesystem::path file(at_.file), room = file.parent_path();
    return (room.parent_path().filename() / room.filename() / file.filename()).generic_string() +
           ":" + std::to_string(at_.line);
  }

 private:
  clause(std::string words, place at) : words_(std::move(words)), at_(at) {}

  std::string words_, file_;
  std::function<finding(const recorded&)> holds_;
  place at_;
};
/// What is drawn and how, why it is so, or what others say: words that no curve could deny.
inline clause definition(std::string words, clause::place at = clause::place::current()) {
  return {std::move(words), at};
}
using clauses = std::vector<clause>;

/// The words of all, a blank between two.
inline std::string text_of(const clauses& said) {
  std::string text;
  for (const auto& s : said) text += (text.empty() ? "" : " ") + s.words();
  return text;
}

/// What a force that is drawn ought to be: a column of a file of the report's folder, over the first one.
struct truth {
  std::string file, column;
  std::string what;  ///< ends "Grey is the truth: …", without a full stop
};
/// Why a plot of a force has none: a definition that stands in the place of a truth.
inline constexpr const char* without_truth = "No truth is drawn: ";
inline clause no_truth(const std::string& why, clause::place at = clause::place::current()) {
  return definition(without_truth + why, at);
}

/// The text of a plot.
struct caption {
  std::string title;  ///< a few words that name what is drawn, without a full stop
  clauses see;        ///< where to look, and what it means; one claim at least
  truth ought{};      ///< the course of a force has one, or says no_truth(…)
};

/// The claim of a line that it joins what none of these points beats in both numbers: those of its two columns.
inline auto joins_unbeaten(const std::string& x, const std::string& y,
                           std::vector<std::pair<double, double>> points) {
  return [=](const recorded& line) {
    const auto &xs = line[x], &ys = line[y];
    return !xs.empty() && std::none_of(points.begin(), points.end(), [&](const auto& p) {
      for (std::size_t i = 0; i < xs.size(); ++i) {  // the file has seven digits
        if (p.first < 0.999999 * xs[i] && p.second < 0.999999 * ys[i]) return true;
      }
      return false;
    });
  };
}

}  // namespace experiments
