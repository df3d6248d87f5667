// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

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
    cells = ex::cells_of(line.substr(name_end + 1));
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
  return controller + ex::format(", B = %.17g", damping) + ex::format(", K = %.17g", stiffness);
}

/// All rows of the parts, by what they are about; throws if two parts have the same.
std::map<std::string, z_row> read_parts(const std::vector<std::string>& files) {
  std::map<std::string, z_row> rows;
  std::map<std::string, std::string> home;
  for (const auto& file : files) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    std::string line;
    if (!std::getline(in, line) || line != ex::csv_heading(record_of(z_row{}))) {
      throw std::runtime_error(file + ": not a part of a Z-width sweep of this version");
    }
    for (int n = 2; std::getline(in, line); ++n) {
      const std::string where = file + ':' + std::to_string(n);
      const z_row r = row_of(line, where);
      const std::string key = key_of(r.controller, r.damping, r.stiffness);
      if (!rows.emplace(key, r).second) {
        throw std::runtime_error(where + ": " + key + " is in " + home[key] +
                                 " already; give each part once");
      }
      home[key] = file;
    }
  }
  return rows;
}

/// Squares coloured by passivity, crosses where it is not stable, the two lines.
std::string plot_of(const std::string& points) {
  const auto squares = [](int level, const std::string& colour, const std::string& title) {
    return "$cells using (column(3) == " + std::to_string(level) +
           " ? column(1) : NaN):2 with points pt 5 ps 0.6 lc rgb '" + colour + "' title '" + title +
           "', \\\n ";
  };
  return "$cells << EOD\nB,K,passive for,stable\n" + points +
         "EOD\nset logscale xy\nset xlabel 'B of the wall [N s/m]'\n"
         "set ylabel 'K of the wall [N/m]'\n"
         "set xrange [0.0008:125]\nset yrange [8:125000]\nset samples 2000\nb = 0.03\nT = 0.001\n"
         "plot " +
         squares(2, "#2e9a5b", "passive") + squares(1, "#b8860b", "passive for a hand of 5 N") +
         squares(0, "#d4552a", "loses energy") +
         "$cells using (column(4) == 0 ? column(1) : NaN):2 with points pt 2 ps 0.6 lc rgb 'black' "
         "title 'unstable', \\\n (x < b ? 2*(b - x)/T : NaN) with lines lt 1 lw 2.5 "
         "title 'Colgate: b = KT/2 + |B|', \\\n 2*(b + x)/T with lines lt 1 lw 2.5 dt 2 "
         "title 'Gil, Hulin: K = 2(b + B)/T'";
}

}  // namespace

std::string z_plot_name(std::string controller) {
  for (char& c : controller) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return "z_" + controller;
}

ex::record record_of(const z_row& r) {
  return {{"controller", r.controller},    {"damping N s/m", r.damping},
          {"stiffness N/m", r.stiffness},  {"motion J", r.motion_energy},
          {"hand J", r.hand_energy},       {"growth", r.growth},
          {"passive for", passive_for(r)}, {"stable", stable(r) ? 1 : 0}};
}

namespace {

/// What the cells of one controller come to.
struct z_counts {
  std::string controller;
  ph::guarantee tag{};
  int cells = 0, passive = 0, for_hands = 0, stable = 0, both = 0;
  double stiffest_passive = std::nan(""), stiffest_stable = std::nan("");
  std::string points{};  ///< for the plot: B, K, passive for, stable

  void add(const z_row& r) {
    const bool holds = passive_for(r) >= 1, calms = controllers::stable(r);
    ++cells;
    points += ex::format("%.9g,", r.damping) + ex::format("%.9g,", r.stiffness) +
              std::to_string(passive_for(r)) + (calms ? ",1\n" : ",0\n");
    passive += passive_for(r) == 2 ? 1 : 0;
    for_hands += holds ? 1 : 0;
    stable += calms ? 1 : 0;
    both += holds && calms ? 1 : 0;
    if (holds) stiffest_passive = std::fmax(stiffest_passive, r.stiffness);
    if (calms) stiffest_stable = std::fmax(stiffest_stable, r.stiffness);
  }
};

ex::record record_of(const z_counts& n) {
  return {{"controller", n.controller},
          {"tag", to_string(n.tag)},
          {"cells", n.cells},
          {"passive", n.passive},
          {"for a hand of 5 N", n.for_hands},
          {"stable", n.stable},
          {"both", n.both},
          {"stiffest passive N/m", n.stiffest_passive},
          {"stiffest stable N/m", n.stiffest_stable}};
}

}  // namespace

void show_z_width(const session& s, const std::vector<z_row>& rows) {
  std::vector<z_counts> sums;
  for (const auto& c : s.judged) {
    z_counts sum{c.name, c.tag};
    for (const auto& r : rows) {
      if (r.controller == c.name) sum.add(r);
    }
    if (sum.cells > 0) sums.push_back(sum);
  }
  s.out.section(
      "Z-width",
      "Walls of 10 N/m to 100 kN/m and 1 mN·s/m to 100 N·s/m, of " +
          std::to_string(rows.size() / sums.size()) +
          " per controller how many are passive against velocity sources (nyquist, random walk, "
          "greedy), passive against a hand of 5 N that taps, and stable: released at the surface "
          "under 1 N, the swing of the fourth second is no larger than the first. A wall that "
          "swings for ever is stable in this sense; so is one that sinks.");
  ex::show_rows(s.out, "z_width", sums);
  const auto of = [&rows](const z_counts& sum, auto is_so) {
    return std::count_if(rows.begin(), rows.end(), [&](const z_row& r) {
      return r.controller == sum.controller && is_so(r);
    });
  };
  for (const auto& sum : sums) {
    s.out.plot(
        z_plot_name(sum.controller),
        {"Z-width: " + sum.controller + " (" + to_string(sum.tag) + ")",
         {ex::definition("Each square is a wall, stiffer upwards and more viscous to the "
                         "right."),
          {std::to_string(sum.passive) + " of " + std::to_string(sum.cells) +
               " are passive whatever the hand does,",
           [&] { return sum.passive == of(sum, [](auto& r) { return passive_for(r) == 2; }); }},
          {std::to_string(sum.stable) + " are stable;",
           [&] { return sum.stable == of(sum, [](auto& r) { return stable(r); }); }},
          ex::definition("those with a cross are not."),
          {"Left of and below the solid line a wall needs no controller at all.",
           [&rows] {
             return std::none_of(rows.begin(), rows.end(), [](const z_row& r) {
               const bool left = r.stiffness < 0.99 * 2.0 * (0.03 - r.damping) / 1e-3;
               return r.controller == "none" && left && passive_for(r) != 2;
             });
           }}}},
        plot_of(sum.points));
  }
}

void merge_z_width(const session& s, const std::vector<std::string>& files) {
  const auto rows = read_parts(files);
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
      ex::write_csv(s.out, "z_width.csv", ordered);
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
