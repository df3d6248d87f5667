// SPDX-License-Identifier: BSD-3-Clause
#include "z_table.hpp"

#include <charconv>
#include <map>

namespace controllers {

namespace {

double number(const std::string& text) {
  double x = std::nan("");
  std::from_chars(text.data(), text.data() + text.size(), x);
  return x;
}

/// A line of z_width.csv. Only the name is quoted, and holds no quotes.
z_row row_of(const std::string& line, const std::string& where) {
  const auto name_end = line.find('"', 1);
  std::vector<std::string> cells;
  if (!line.empty() && line[0] == '"' && name_end != std::string::npos) {
    std::istringstream rest(line.substr(name_end + 1));
    for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
  }
  if (cells.size() != 8) {
    throw std::runtime_error(where +
                             ": not a row of a Z-width sweep; was the run stopped while "
                             "it wrote? Run this part again");
  }
  return {line.substr(1, name_end - 1),
          number(cells[1]),
          number(cells[2]),
          number(cells[3]),
          number(cells[4]),
          number(cells[5])};
}

std::string key_of(const std::string& controller, double damping, double stiffness) {
  return controller + ", B = " + csv_number(damping) + ", K = " + csv_number(stiffness);
}

/// All rows of the parts, by what they are about; throws if two parts have the same.
std::map<std::string, z_row> read_parts(const std::vector<std::string>& files) {
  std::map<std::string, z_row> rows;
  std::map<std::string, std::string> home;
  for (const auto& file : files) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    std::string line;
    if (!std::getline(in, line) || line != z_heading) {
      throw std::runtime_error(file + ": not a part of a Z-width sweep of this version");
    }
    for (int n = 2; std::getline(in, line); ++n) {
      const z_row r = row_of(line, file + ':' + std::to_string(n));
      const std::string key = key_of(r.controller, r.damping, r.stiffness);
      if (!rows.emplace(key, r).second) {
        throw std::runtime_error(file + ':' + std::to_string(n) + ": " + key + " is in " +
                                 home[key] + " already; give each part once");
      }
      home[key] = file;
    }
  }
  return rows;
}

/// Squares coloured by passivity, crosses where it is not stable, the two lines.
std::string plot_of(const std::string& controller) {
  const std::string rows = "'z_width.csv' using (stringcolumn(1) eq '" + controller + "' && ";
  const auto squares = [&](int level, const std::string& colour, const std::string& title) {
    return rows + "column(7) == " + std::to_string(level) +
           " ? column(2) : NaN):3 with points pt 5 ps 0.9 lc rgb '" + colour + "' title '" + title +
           "'";
  };
  return "set logscale xy\nset xlabel 'B of the wall [N s/m]'\nset ylabel 'K of the wall [N/m]'\n"
         "set xrange [0.0008:125]\nset yrange [8:125000]\nset samples 2000\nb = 0.03\nT = 0.001\n"
         "plot " +
         squares(2, "#4caf50", "passive") + ", \\\n " +
         squares(1, "#ffd54f", "passive for a hand of 5 N") + ", \\\n " +
         squares(0, "#ef9a9a", "loses energy") + ", \\\n " + rows +
         "column(8) == 0 ? column(2) : NaN):3 with points pt 2 ps 0.5 lc rgb 'black' "
         "title 'unstable', \\\n (x < b ? 2*(b - x)/T : NaN) with lines lw 2 lc rgb '#1a237e' "
         "title 'Colgate: b = KT/2 + |B|', \\\n 2*(b + x)/T with lines lw 2 dt 2 lc rgb '#1a237e' "
         "title 'Gil, Hulin: K = 2(b + B)/T'";
}

}  // namespace

std::string z_plot_name(std::string controller) {
  for (char& c : controller) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return "z_" + controller;
}

std::vector<z_cell> z_cells(const std::vector<controller>& judged, const z_grid& grid) {
  std::vector<z_cell> cells;
  for (const auto& c : judged) {
    if (!c.wall_damping) continue;
    for (int i = 0; i < grid.dampings; ++i) {
      for (int k = 0; k < grid.stiffnesses; ++k) {
        cells.push_back({&c, grid.damping(i), grid.stiffness(k)});
      }
    }
  }
  return cells;
}

std::string z_line(const z_row& r) {
  return csv_text(r.controller) + ',' + csv_number(r.damping) + ',' + csv_number(r.stiffness) +
         ',' + csv_number(r.motion_energy) + ',' + csv_number(r.hand_energy) + ',' +
         csv_number(r.growth) + ',' + std::to_string(passive_for(r)) + ',' +
         (stable(r) ? '1' : '0');
}

void show_z_width(const session& s, const std::vector<z_row>& rows) {
  struct counts {
    int cells = 0, passive = 0, for_hands = 0, stable = 0, both = 0;
    double stiffest_passive = std::nan(""), stiffest_stable = std::nan("");
  };
  std::map<std::string, counts> sums;
  for (const auto& r : rows) {
    counts& c = sums[r.controller];
    ++c.cells;
    c.passive += passive_for(r) == 2 ? 1 : 0;
    c.for_hands += passive_for(r) >= 1 ? 1 : 0;
    c.stable += stable(r) ? 1 : 0;
    c.both += stable(r) && passive_for(r) >= 1 ? 1 : 0;
    if (passive_for(r) >= 1) c.stiffest_passive = std::fmax(c.stiffest_passive, r.stiffness);
    if (stable(r)) c.stiffest_stable = std::fmax(c.stiffest_stable, r.stiffness);
  }
  s.out.section(
      "Z-width",
      "Walls of 10 N/m to 100 kN/m and 1 mN·s/m to 100 N·s/m, of " +
          std::to_string(rows.size() / sums.size()) +
          " per controller how many are passive against velocity sources (nyquist, random walk, "
          "greedy), passive against a hand of 5 N that taps, and stable: released at the surface "
          "under 1 N, the swing of the fourth second is no larger than the first. A wall that "
          "swings for ever is stable in this sense; so is one that sinks.");
  ex::table shown({"controller", "tag", "passive", "for a hand of 5 N", "stable", "both",
                   "stiffest passive N/m", "stiffest stable N/m"});
  std::vector<std::string> json;
  for (const auto& c : s.judged) {
    const auto found = sums.find(c.name);
    if (found == sums.end()) continue;
    const counts& n = found->second;
    shown.add({c.name, to_string(c.tag), std::to_string(n.passive), std::to_string(n.for_hands),
               std::to_string(n.stable), std::to_string(n.both),
               ex::format("%.3g", n.stiffest_passive), ex::format("%.3g", n.stiffest_stable)});
    json.push_back(ex::json_object({{"controller", ex::json_string(c.name)},
                                    {"cells", std::to_string(n.cells)},
                                    {"passive", std::to_string(n.passive)},
                                    {"passive_for_5_N", std::to_string(n.for_hands)},
                                    {"stable", std::to_string(n.stable)},
                                    {"both", std::to_string(n.both)}}));
  }
  s.out.show(shown);
  s.out.member("z_width", ex::json_array(json));
  for (const auto& c : s.judged) {
    if (!sums.contains(c.name)) continue;
    s.out.plot(z_plot_name(c.name), "Z-width: " + c.name + " (" + to_string(c.tag) + ")",
               plot_of(c.name));
  }
}

void merge_z_width(const session& s, const std::vector<std::string>& files) {
  auto rows = read_parts(files);
  std::string problem;
  for (const bool quick : {false, true}) {
    std::vector<z_row> ordered;
    std::string missing;
    int absent = 0;
    for (const auto& cell : z_cells(s.judged, grid_of(quick))) {
      const std::string key = key_of(cell.c->name, cell.damping, cell.stiffness);
      const auto found = rows.find(key);
      if (found != rows.end()) {
        ordered.push_back(found->second);
      } else if (absent++ == 0) {
        missing = key;
      }
    }
    if (absent == 0 && ordered.size() == rows.size()) {
      ex::csv_file csv(s.out.path("z_width.csv"), z_heading);
      for (const auto& r : ordered) csv.line(z_line(r));
      csv.close();
      return show_z_width(s, ordered);
    }
    if (!ordered.empty() && (problem.empty() || ordered.size() == rows.size())) {
      problem = std::to_string(absent) + " rows are missing, the first is " + missing +
                "; give all parts of one --shard sweep";
    }
  }
  throw std::runtime_error(problem.empty() ? "no row of these parts belongs to this sweep"
                                           : problem);
}

}  // namespace controllers
