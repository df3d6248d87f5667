// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a bench leaves behind: CSV files, one JSON file, SVG plots by gnuplot, one HTML page and, if
// it has a name, the same page in Markdown.

#include "progress.hpp"
#include "text.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <system_error>

namespace experiments {

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

/// Comma separated, units in the heading.
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
  /// A line, or several, without the last line break; on disk when the call returns.
  void line(const std::string& text) { file_.stream() << text << '\n' << std::flush; }
  void close() { file_.close(); }

 private:
  output_file file_;
};

/// gnuplot commands: a line through the points of each name, each point a line "x,y". They stand in
/// the script itself, because gnuplot takes a comma within a quoted name for the end of a cell.
inline std::string curves(const std::map<std::string, std::string>& points) {
  std::string data, plots;
  for (const auto& [name, lines] : points) {
    const std::string block = "$curve" + std::to_string(data.size());
    data += block + " << EOD\nx,y\n" + lines + "EOD\n";
    plots += (plots.empty() ? "plot " : ", \\\n ") + block + " using 1:2 with linespoints title '" +
             name + "'";
  }
  return data + plots;
}

struct report_files {
  std::string json = "results.json";
  std::string markdown;  ///< empty: none
};

/// Everything one run of the program writes, under one folder.
class report {
 public:
  explicit report(std::filesystem::path folder, report_files names = {})
      : folder_(std::move(folder)), names_(std::move(names)) {
    std::error_code refused;
    std::filesystem::create_directories(folder_, refused);
    if (refused) {
      throw std::runtime_error(folder_.string() + ": cannot be made a folder (" +
                               refused.message() + "); give another with --out");
    }
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  void section(const std::string& title, const std::string& text) {
    std::cout << title << "\n\n" << paragraph(text) << "\n\n";
    page_ += "<h2>" + title + "</h2>\n<p>" + html_text(text) + "</p>\n";
    text_ += "## " + title + "\n\n" + text + "\n\n";
  }
  void show(const table& t) {
    t.print(std::cout);
    page_ += t.html();
    text_ += t.markdown();
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
    text_ += "![" + caption + "](" + name + ".svg)\n\n";
  }

  /// Writes the JSON file and the pages and runs gnuplot. False: it did not draw every plot.
  bool finish(const std::string& title) {
    output_file json(path(names_.json));
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
    if (!names_.markdown.empty()) {
      output_file page(path(names_.markdown));
      page.stream() << "# " << title << "\n\n" << text_;
      page.close();
    }
    return drawn;
  }

 private:
  std::filesystem::path folder_;
  report_files names_;
  std::string page_, text_;  // HTML, Markdown
  std::vector<std::string> scripts_;
  std::vector<std::pair<std::string, std::string>> members_;
};

}  // namespace experiments
