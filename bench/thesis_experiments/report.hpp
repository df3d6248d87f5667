// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the experiments leave behind: CSV files, one JSON file, SVG plots by gnuplot, one HTML page.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unistd.h>
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

/// A file that is written whole or complained about.
class output_file {
 public:
  explicit output_file(const std::filesystem::path& path) : path_(path), stream_(path) {
    if (!stream_) throw std::runtime_error(path.string() + ": cannot be written");
  }
  std::ofstream& stream() { return stream_; }
  void close() {
    stream_.close();
    if (!stream_) throw std::runtime_error(path_.string() + ": writing failed, is the disk full?");
  }

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// One line per tick, comma separated, units in the heading.
class csv_file {
 public:
  csv_file(const std::filesystem::path& path, const std::string& heading) : file_(path) {
    file_.stream().precision(7);
    file_.stream() << heading << '\n';
  }
  template <class... Numbers>
  void row(double first, Numbers... rest) {
    file_.stream() << first;
    ((file_.stream() << ',' << rest), ...);
    file_.stream() << '\n';
  }
  void close() { file_.close(); }

 private:
  output_file file_;
};

/// A table for people: padded on the terminal, marked up for the page.
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
        text += r == 0 ? "<th>" + cell + "</th>" : "<td>" + cell + "</td>";
      }
      text += "</tr>\n";
    }
    return text + "</table>\n";
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// printf for one number; "-" for none.
inline std::string format(const char* pattern, double x) {
  if (!std::isfinite(x)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, pattern, x);
  return text;
}

/// Everything one run of the program writes, under one folder.
class report {
 public:
  explicit report(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  void section(const std::string& title, const std::string& text) {
    page_ += "<h2>" + title + "</h2>\n<p>" + text + "</p>\n";
  }
  void show(const table& t) {
    t.print(std::cout);
    page_ += t.html();
  }
  void member(const std::string& name, const std::string& json) {
    members_.emplace_back(name, json);
  }

  /// A plot: the gnuplot commands after `set output`. They read the CSV files of this folder.
  void plot(const std::string& name, const std::string& caption, const std::string& commands) {
    output_file script(path(name + ".gp"));
    script.stream()
        << "set terminal svg size 860,420 dynamic font 'sans,12' background 'white'\n"
        << "set output '" << name << ".svg'\n"
        << "set datafile separator ','\nset key autotitle columnhead\nset key below\nset grid\n"
        << commands << '\n';
    script.close();
    scripts_.push_back(name);
    page_ += "<figure><img src=\"" + name + ".svg\" alt=\"" + caption + "\"><figcaption>" +
             caption + "</figcaption></figure>\n";
  }

  /// Writes results.json and index.html and runs gnuplot. False: no plots, because it is missing.
  bool finish(const std::string& title) {
    output_file json(path("results.json"));
    json.stream() << "{";
    for (std::size_t i = 0; i < members_.size(); ++i) {
      json.stream() << (i == 0 ? "\n  " : ",\n  ") << json_string(members_[i].first) << ": "
                    << members_[i].second;
    }
    json.stream() << "\n}\n";
    json.close();

    bool drawn = true;
    for (const auto& name : scripts_) {
      const std::string command =
          "cd '" + folder_.string() + "' && gnuplot '" + name + ".gp' 2> " + name + ".log";
      drawn = std::system(command.c_str()) == 0 && drawn;
    }
    output_file html(path("index.html"));
    html.stream() << "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>" << title
                  << "</title>\n<style>body{font:16px/1.5 sans-serif;max-width:60rem;margin:2rem "
                     "auto;padding:0 1rem}table{border-collapse:collapse}td,th{border:1px solid "
                     "#bbb;padding:.2rem .6rem;text-align:left}img{max-width:100%}figcaption{"
                     "font-size:.9rem;color:#444}</style>\n<h1>"
                  << title << "</h1>\n";
    if (!drawn)
      html.stream() << "<p><b>Some plots are missing: gnuplot did not draw them.</b></p>\n";
    html.stream() << page_ << "</html>\n";
    html.close();
    return drawn;
  }

 private:
  std::filesystem::path folder_;
  std::string page_;
  std::vector<std::string> scripts_;
  std::vector<std::pair<std::string, std::string>> members_;
};

/// "wall: 12 of 60" on the terminal, rewritten in place.
class progress {
 public:
  progress(std::string what, int total) : what_(std::move(what)), total_(total) { show(); }
  void step() {
    ++done_;
    show();
  }

 private:
  void show() const {
    const bool terminal = isatty(STDERR_FILENO) == 1;
    if (!terminal && done_ != 0 && done_ != total_) return;
    std::fprintf(stderr, "%s%s: %d of %d%s", terminal ? "\r" : "", what_.c_str(), done_, total_,
                 !terminal || done_ == total_ ? "\n" : "");
    std::fflush(stderr);
  }
  std::string what_;
  int total_;
  int done_ = 0;
};

}  // namespace experiments
