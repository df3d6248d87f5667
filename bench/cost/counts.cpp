// SPDX-License-Identifier: BSD-3-Clause
#include "counts.hpp"

#include "workload.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace cost {

namespace {

/// What stands between `before` and the next of `ends` in text; empty if there is no such thing.
std::string after(const std::string& text, const std::string& before, const char* ends) {
  const auto at = text.find(before);
  if (at == std::string::npos) return "";
  const auto start = at + before.size();
  return text.substr(start, text.find_first_of(ends, start) - start);
}

/// The path of a caller "…along<(cost::path)3, …", or "".
std::string path_in(const std::string& caller) {
  const std::string number = after(caller, "along<(cost::path)", ",");
  if (number.size() != 1 || number[0] < '0' || number[0] > '5') return "";
  return to_string(static_cast<path>(number[0] - '0'));
}

void add(std::vector<counted>& rows, const std::string& caller, const std::string& callee,
         long calls, long instructions) {
  const std::string way = path_in(caller);
  const std::string scene = after(callee, "probe<cost::", "<");
  if (way.empty() || scene.empty()) return;
  const std::string arguments = after(callee, "probe<cost::" + scene + "<", ">");
  const std::string scalar = arguments.substr(0, arguments.find(','));  // a part has a Dof, too
  const std::string state = after(callee, "probe<cost::" + scene + "<" + arguments + ">, ", "<,(");
  const counted row{scene, scalar, state.rfind("by_hand", 0) == 0 ? "by hand" : "composed",
                    way,   calls,  instructions};
  for (auto& known : rows) {
    if (known.name() != row.name()) continue;
    known.ticks += calls;
    known.instructions += instructions;
    return;
  }
  rows.push_back(row);
}

std::string first_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace

const counted* counts::find(const std::string& name) const {
  for (const auto& row : rows) {
    if (row.name() == name) return &row;
  }
  return nullptr;
}

double counts::per_tick(const std::string& scene, const std::string& scalar) const {
  counted all;
  for (const auto& row : rows) {
    if (row.scene != scene || row.scalar != scalar || row.side != "composed") continue;
    all.ticks += row.ticks;
    all.instructions += row.instructions;
  }
  return all.per_tick();
}

double counts::ratio(const std::string& scene, const std::string& scalar) const {
  double composed = 0, by_hand = 0;
  for (const auto& row : rows) {
    if (row.scene != scene || row.scalar != scalar) continue;
    (row.side == "composed" ? composed : by_hand) += static_cast<double>(row.instructions);
  }
  return composed / by_hand;
}

std::vector<counted> read_callgrind(std::istream& in) {
  std::vector<counted> rows;
  std::string caller, callee;
  long calls = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("fn=", 0) == 0) {
      caller = line.substr(3);
    } else if (line.rfind("cfn=", 0) == 0) {
      callee = line.substr(4);
    } else if (line.rfind("calls=", 0) == 0) {
      calls = std::atol(line.c_str() + 6);
    } else if (calls > 0) {  // the line after calls=: position, inclusive instructions
      add(rows, caller, callee, calls, std::atol(line.c_str() + line.rfind(' ')));
      calls = 0;
    }
  }
  return rows;
}

bool valgrind_works() {
  return std::system(
             "valgrind --tool=callgrind --callgrind-out-file=/dev/null true > /dev/null 2>&1") == 0;
}

namespace {

/// Runs `program` under callgrind with more options; returns where it wrote its counts, and its words beside them in .txt.
std::string under_callgrind(const std::filesystem::path& program,
                            const std::filesystem::path& scratch, const std::string& options) {
  const std::string out = (scratch / (program.filename().string() + ".callgrind")).string();
  const std::string command = "LD_BIND_NOW=1 valgrind --tool=callgrind " + options +
                              " --callgrind-out-file='" + out + "' '" + program.string() + "' > '" +
                              out + ".txt' 2> '" + out + ".log'";
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error("valgrind failed on " + program.string() + ": see " + out + ".log");
  }
  return out;
}

}  // namespace

counts count(const std::filesystem::path& program, const std::filesystem::path& scratch) {
  const std::string out =
      under_callgrind(program, scratch, "--compress-strings=no --compress-pos=no");
  std::ifstream in(out);
  counts result{first_line(out + ".txt"), read_callgrind(in)};
  if (result.compiler.empty() || result.rows.empty()) {
    throw std::runtime_error(out + ": no ticks in it, of a program that said \"" + result.compiler +
                             "\"");
  }
  return result;
}

std::vector<mesh_ticks> read_mesh_dumps(std::istream& in) {
  std::vector<mesh_ticks> rows;
  bool tick = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("desc: Trigger: ", 0) == 0) {
      std::istringstream name(after(line, "Client Request: ", "\n"));
      mesh_ticks row;
      tick = static_cast<bool>(name >> row.triangles >> row.speed >> row.news);
      const bool same = tick && !rows.empty() && rows.back().triangles == row.triangles &&
                        rows.back().speed == row.speed && rows.back().news == row.news;
      if (tick && !same) rows.push_back(row);
    } else if (tick && line.rfind("totals: ", 0) == 0) {
      const long instructions = std::atol(line.c_str() + 8);
      ++rows.back().ticks;
      rows.back().instructions += instructions;
      rows.back().largest = std::max(rows.back().largest, instructions);
    }
  }
  return rows;
}

std::vector<mesh_ticks> count_meshes(const std::filesystem::path& program,
                                     const std::filesystem::path& scratch) {
  std::ifstream in(under_callgrind(program, scratch, "--instr-atstart=no --combine-dumps=yes"));
  return read_mesh_dumps(in);
}

baseline read_baseline(std::istream& in) {
  baseline committed;
  std::string line;
  std::getline(in, line);  // the heading
  while (std::getline(in, line)) {
    const auto cells = experiments::cells_of(line);
    char* end = nullptr;
    const double value = cells.size() == 6 ? std::strtod(cells[5].c_str(), &end) : 0.0;
    if (!(value > 0) || *end != '\0') {
      throw std::runtime_error("baseline: \"" + line +
                               "\" is not compiler,scene,scalar,side,path,"
                               "instructions: write it anew with --rewrite");
    }
    committed[cells[0]][counted{cells[1], cells[2], cells[3], cells[4]}.name()] = value;
  }
  return committed;
}

void write_baseline(std::ostream& out, const std::vector<counts>& all) {
  out << "compiler,scene,scalar,side,path,instructions per tick\n";
  for (const auto& build : all) {
    for (const auto& row : build.rows) {
      out << build.compiler << ',' << row.scene << ',' << row.scalar << ',' << row.side << ','
          << row.path << ',' << experiments::format("%.2f", row.per_tick()) << '\n';
    }
  }
}

growth compare(const baseline& committed, const counts& now, double tolerance) {
  growth found;
  const auto build = committed.find(now.compiler);
  if (build == committed.end()) return found;
  found.known = true;
  for (const auto& [name, before] : build->second) {
    const counted* row = now.find(name);
    if (row == nullptr) {
      found.sentences.push_back(now.compiler + ": " + name + " was not counted");
      continue;
    }
    const double grown = row->per_tick() / before - 1;
    if (!(grown > tolerance)) continue;
    found.sentences.push_back(now.compiler + ": " + name + " grew by " +
                              experiments::format("%.1f %%", 100 * grown) + ", from " +
                              experiments::format("%.2f", before) + " to " +
                              experiments::format("%.2f instructions per tick", row->per_tick()));
  }
  return found;
}

}  // namespace cost
