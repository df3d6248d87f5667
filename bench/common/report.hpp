// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The report of a bench: CSV files, one JSON file, SVG plots by gnuplot, one HTML page and, if it has a name, the
// same page in Markdown.

#include "page.hpp"
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

/// A file that is written whole; if that fails, it throws.
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

/// A file of comma-separated values with units in the heading.
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
  /// Writes a line, or several without the last line break. They are on disk when the call returns.
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
  // The key stands beside the picture, because below it many names would leave no height.
  return "set key outside right center vertical maxcols 1 width -5 Left reverse\n" + data + plots;
}

struct report_files {
  std::string json = "results.json";
  std::string markdown;  ///< empty: none
};

/// All files that one run of the program writes, in one folder.
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
  /// The path of the results, for people.
  [[nodiscard]] std::string results() const {
    const std::string& first = names_.markdown.empty() ? "index.html" : names_.markdown;
    return path(first).string() + ", " + path(names_.json).string();
  }

  /// A text without a claim: what the columns of a table are, and where they come from.
  void section(const std::string& title, const std::string& text) {
    std::cout << title << "\n\n" << paragraph(text) << "\n\n";
    page_.section(title, text);
    text_ += "## " + title + "\n\n" + text + "\n\n";
  }
  /// One that claims something, which is looked up as in plot(): the files are written by then.
  void section(const std::string& title, const clauses& said) {
    look_up("the text of " + title, said);
    section(title, text_of(said));
  }
  void show(const table& t) {
    t.print(std::cout);
    page_.show(t);
    text_ += t.markdown();
  }
  void member(const std::string& name, const std::string& json) {
    members_.emplace_back(name, json);
  }

  /// Adds a plot by the gnuplot commands after `set output`, which read the CSV files of this folder. What its
  /// caption claims is looked up in them now, so they are written by then; what is not so is in untrue(). So is an axis
  /// of a force that neither shows 0 nor is logarithmic, and the course of a force without its truth, which is drawn
  /// here, in grey beneath the others; which axes are logarithmic, and what is grey, the caption says by itself.
  void plot(const std::string& name, caption said, std::string commands) {
    const auto has = [&commands](const char* what) {
      return commands.find(what) != std::string::npos;
    };
    const std::string which = "the caption of " + name;
    const bool both = has("set logscale xy"), below = both || has("set logscale x");
    if (below) {
      said.see.push_back(
          definition(both ? "Both axes are logarithmic." : "The axis below is logarithmic."));
    }
    bool course = false;  // of a force, over a time or a place: what compares runs is logarithmic
    for (const std::string axis : {"y", "y2"}) {
      const std::string label = set_in(commands, axis + "label '", "'");
      if (!names_force(label)) continue;
      // An error is measured from the truth already.
      course = course || (!below && label.find("error") == std::string::npos);
      if (!both && !shows_0(set_in(commands, axis + "range [", "]"))) {
        untrue_.push_back(name + ": the axis of the force does not begin at 0");
      }
    }
    if (!said.ought.file.empty()) {
      draw_truth(name, said, commands);
    } else if (course && std::ranges::none_of(said.see, [](const clause& s) {
                 return !s.is_claim() && s.words().starts_with(without_truth);
               })) {
      untrue_.push_back(name + ": a force is drawn without the truth");
    }
    output_file script(path(name + ".gp"));
    script.stream() << plot_preamble << "set output '" << name << ".svg'\n" << commands << '\n';
    script.close();
    plots_.emplace_back(name, said.title);
    if (std::none_of(said.see.begin(), said.see.end(), [](auto& s) { return s.is_claim(); })) {
      untrue_.push_back(which + " claims nothing");
    }
    look_up(which, said.see);
    page_.figure(name, said);
    text_ += "![" + said.title + "](" + name + ".svg)\n\n**" + said.title + ".** " +
             text_of(said.see) + "\n\n";
  }

  /// What captions and texts say and is not so, a sentence each.
  [[nodiscard]] const std::vector<std::string>& untrue() const { return untrue_; }

  /// Writes the JSON file and the pages and runs gnuplot; `lead` is the text under the title. Returns false if
  /// gnuplot did not draw every plot.
  bool finish(const std::string& title, const std::string& lead = {}) {
    list_clauses();
    output_file json(path(names_.json));
    json.stream() << "{";
    for (std::size_t i = 0; i < members_.size(); ++i) {
      json.stream() << (i == 0 ? "\n  " : ",\n  ") << json_string(members_[i].first) << ": "
                    << members_[i].second;
    }
    json.stream() << "\n}\n";
    json.close();

    bool drawn = true;
    for (const auto& [name, what] : plots_) drawn = draw(name, what) && drawn;
    std::vector<std::string> files{names_.json};
    if (!names_.markdown.empty()) files.push_back(names_.markdown);
    output_file html(path("index.html"));
    html.stream() << page_.html(title, lead, drawn, files);
    html.close();
    if (!names_.markdown.empty()) {
      output_file page(path(names_.markdown));
      page.stream() << "# " << title << "\n\n" << (lead.empty() ? "" : lead + "\n\n") << text_;
      page.close();
    }
    return drawn;
  }

 private:
  /// What a plot sets: the text from `what` to `end`; empty if it does not.
  static std::string set_in(const std::string& commands, const std::string& what, const char* end) {
    const auto at = commands.find("set " + what);
    if (at == std::string::npos) return "";
    const auto from = at + 4 + what.size();
    return commands.substr(from, commands.find(end, from) - from);
  }
  /// True of the label of a force or a torque.
  static bool names_force(const std::string& label) {
    for (const char* unit : {"N", "N·m", "force", "torque"}) {
      if (label == unit || label.ends_with(std::string(" [") + unit + "]") ||
          label.ends_with(std::string(" ") + unit)) {
        return true;
      }
    }
    return false;
  }
  /// True if 0 is the lower end of a range, or within it.
  static bool shows_0(const std::string& range) {
    const auto middle = range.find(':');
    if (middle == std::string::npos) return false;
    const std::string from = range.substr(0, middle);
    return from == "0" || (std::strtod(from.c_str(), nullptr) < 0.0 &&
                           std::strtod(range.c_str() + middle + 1, nullptr) > 0.0);
  }
  /// Draws the truth beneath all other curves; it must be numbers, or nothing is seen of it.
  void draw_truth(const std::string& name, caption& said, std::string& commands) {
    const auto at = commands.find("plot '");
    const auto is = recorded(path(said.ought.file))[said.ought.column];
    if (at == std::string::npos || is.empty() ||
        !std::all_of(is.begin(), is.end(), [](double x) { return std::isfinite(x); })) {
      untrue_.push_back(name + ": its truth cannot be drawn");
      return;
    }
    commands.insert(at + 5, "'" + said.ought.file + "' using 1:(column(\"" + said.ought.column +
                                "\")) with lines lt 8 lw 4 title 'truth', ");
    said.see.push_back(definition("Grey is the truth: " + said.ought.what + "."));
  }
  struct looked_up {
    std::string which, found;
    clause said;
  };
  void look_up(const std::string& which, const clauses& all) {
    for (const auto& said : all) {
      if (!said.is_claim()) {
        said_.push_back({which, "definition", said});
        continue;
      }
      const finding found = said.look_up(folder_);
      const std::string by = found.by.empty() ? "" : " (" + found.by + ")";
      if (!found.so) untrue_.push_back(which + " is not so: \"" + said.words() + "\"" + by);
      said_.push_back({which, (found.so ? "so" : "NOT SO") + by, said});
    }
  }
  /// The last table: what captions and texts say, clause by clause, and what each predicate has found.
  void list_clauses() {
    if (said_.empty()) return;
    table all({"which", "says", "found", "file", "source"});
    std::vector<std::string> items;
    for (const auto& [which, found, said] : said_) {
      const std::string at = said.is_claim() ? said.at() : "";
      all.add({which, said.words(), found, said.file(), at});
      items.push_back(json_object({{"which", json_string(which)},
                                   {"words", json_string(said.words())},
                                   {"found", json_string(found)},
                                   {"file", json_string(said.file())},
                                   {"source", json_string(at)}}));
    }
    const std::string title = "What the captions say",
                      text =
                          "Clause by clause: what its predicate found in the file that is drawn, "
                          "and where caption and predicate stand. What no curve could deny is a "
                          "definition.";
    page_.section(title, text);
    page_.show(all);
    text_ += "## " + title + "\n\n" + text + "\n\n" + all.markdown();
    member("captions", json_array(items));
  }
  /// Runs gnuplot, and gives its plot a name and both colour schemes.
  [[nodiscard]] bool draw(const std::string& name, const std::string& what) const {
    const std::string command =
        "cd '" + folder_.string() + "' && gnuplot '" + name + ".gp' 2> '" + name + ".log'";
    if (std::system(command.c_str()) != 0) return false;
    std::ifstream drawn(path(name + ".svg"));
    std::string svg{std::istreambuf_iterator<char>(drawn), {}};
    drawn.close();
    const std::string unnamed = "<title>Gnuplot</title>";
    const auto at = svg.find(unnamed);
    if (at == std::string::npos) return false;
    svg.replace(at, unnamed.size(), "<title>" + html_text(what) + "</title>\n" + plot_style);
    output_file styled(path(name + ".svg"));
    styled.stream() << svg;
    styled.close();
    return true;
  }

  std::filesystem::path folder_;
  report_files names_;
  page page_;
  std::string text_;                                        // the same in Markdown
  std::vector<std::pair<std::string, std::string>> plots_;  // name and title
  std::vector<looked_up> said_;                             // by captions and texts
  std::vector<std::string> untrue_;                         // of it
  std::vector<std::pair<std::string, std::string>> members_;
};

}  // namespace experiments
