// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include "between.hpp"
#include "chain.hpp"
#include "large_deflection.hpp"
#include "organ_mesh.hpp"
#include "precision.hpp"
#include "remote.hpp"
#include "sparse_ldlt.hpp"
#include <passive_haptics/base/decimal.hpp>
#include <passive_haptics/environment/compliance_table.hpp>
#include <passive_haptics/environment/contact_surface.hpp>
#include <passive_haptics/environment/deformable_body.hpp>
#ifdef PASSIVE_HAPTICS_CHOLMOD
#include "by_cholmod.hpp"
#endif

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <numeric>
#include <random>

namespace organ {

namespace {

constexpr env::material flesh{.young = 5e3, .poisson = 0.4};

/// CPU time of the process [s].
double cpu() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}
double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
/// The least CPU time of some calls, each of `per` [s].
template <class Act>
double least(int times, int per, const Act& act) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < times; ++i) {
    const double begin = cpu();
    for (int k = 0; k < per; ++k) act(k);
    best = std::min(best, (cpu() - begin) / per);
  }
  return best;
}

/// A cube of n³ nodes 2.5 mm apart, shaken inside, held below; and the middle of its top.
held_mesh make_cube(int n) {
  constexpr double h = 2.5e-3;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shake(-0.15, 0.15);
  held_mesh made{.mesh = grid_mesh(n,
                                   [&](const vector& q) {
                                     vector x = 0.5 * (n - 1) * (q + vector::Ones());
                                     if (q.cwiseAbs().maxCoeff() < 1.0) {
                                       for (double& c : x) c += shake(random);
                                     }
                                     return vector(h * x);
                                   }),
                 .held = std::vector<int>(env::slot(n * n)),
                 .top = h * vector(0.5 * (n - 1), 0.5 * (n - 1), n - 1)};
  std::iota(made.held.begin(), made.held.end(), 0);
  return made;
}

// -------------------------------------------------------------------------------------- solvers
struct solver_row {
  std::size_t nodes = 0;
  std::string solver{};
  double factor = 0.0;    ///< CPU time [s]
  double memory = 0.0;    ///< of the factor [MB]; 0: unknown
  double solve = 0.0;     ///< one full solution [ms]
  double contact = 0.0;   ///< C at one point [ms]
  double residual = 0.0;  ///< |K u − f|/|f|
  double apart = 0.0;     ///< of C, from that of the first solver, relative
};
ex::record record_of(const solver_row& r) {
  return {{"nodes", r.nodes},       {"solver", r.solver},       {"factor_s", r.factor},
          {"factor_MB", r.memory},  {"solve_ms", r.solve},      {"contact_ms", r.contact},
          {"residual", r.residual}, {"apart_relative", r.apart}};
}

template <class Solver>
double megabytes(const Solver& solver) {
  if constexpr (requires { solver.tree(); }) return 1e-6 * solver.tree().factor_bytes;
  if constexpr (requires { solver.bytes(); }) return 1e-6 * solver.bytes();
  return std::nan("");
}

template <class Solver>
solver_row judge(const std::string& name, const held_mesh& body,
                 std::optional<Eigen::Matrix3d>& first, const env::on_progress& tell) {
  solver_row row{.nodes = body.mesh.nodes.size(), .solver = name};
  const auto number = env::free_numbers(body.mesh, body.held);
  const auto graph = env::graph_of(body.mesh, number);
  const auto K = env::stiffness_matrix(body.mesh, flesh, number, graph);
  Solver solver;
  double begin = cpu();
  static_cast<void>(solver.analyse(graph));
  if (solver.factorise(K, tell).stopped) throw ex::interrupted("stopped: there is no report");
  row.factor = cpu() - begin;
  row.memory = megabytes(solver);
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(K.rows(), -1.0, 1.0);
  Eigen::VectorXd u;
  row.solve = 1e3 * least(3, 1, [&](int) {
                u = f;
                solver.solve(u);
              });
  row.residual = (K * u - f).norm() / f.norm();
  std::array<int, 3> nodes{};
  const auto corner = env::patch_around(env::boundary(body.mesh), body.mesh.nodes, body.top, 3);
  for (std::size_t k = 0; k < 3; ++k) nodes[k] = number[env::slot(corner[k])];
  const std::array<double, 3> weights{0.2, 0.3, 0.5};
  env::point_load<Solver> point;
  point.prepare(solver, K.rows());
  Eigen::Matrix3d C;
  row.contact = 1e3 * least(3, 1, [&](int) { C = point.press(solver, nodes, weights); });
  if (!first) first = C;
  row.apart = (C - *first).norm() / first->norm();
  return row;
}

// --------------------------------------------------------------------------------------- search
struct search_row {
  std::size_t triangles = 0;
  double linear = 0.0, tree = 0.0, tracked = 0.0, followed = 0.0, refit = 0.0;  ///< [µs]
};
ex::record record_of(const search_row& r) {
  return {{"triangles", r.triangles}, {"linear_us", r.linear},     {"tree_us", r.tree},
          {"tracked_us", r.tracked},  {"followed_us", r.followed}, {"refit_all_us", r.refit}};
}

/// A device that wanders over the top, 1 mm deep.
std::vector<vector> way_of(const held_mesh& body) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(-1e-4, 1e-4);
  std::vector<vector> way{body.top - vector(0.0, 0.0, 1e-3)};
  for (int i = 0; i < 999; ++i) way.push_back(way.back() + vector(step(random), step(random), 0.0));
  return way;
}

search_row search(const held_mesh& body) {
  const auto surface = env::boundary(body.mesh);
  env::surface_search tree(surface, body.mesh.nodes);
  const auto way = way_of(body);
  env::contact_tracker tracked(2e-4), followed(2e-4);
  search_row row{.triangles = surface.size()};
  double sum = 0.0;  // of what is found, so that it is looked for
  const auto time = [&](int times, const auto& find) {
    return 1e6 * least(3, times, [&](int i) { sum += find(way[env::slot(i)])->depth; });
  };
  const auto& nodes = body.mesh.nodes;
  row.linear = time(20, [&](const vector& x) { return env::closest_point(surface, nodes, x); });
  row.tree = time(1000, [&](const vector& x) { return tree.closest_point(nodes, x); });
  row.tracked = time(1000, [&](const vector& x) { return tracked.find(tree, nodes, x); });
  row.followed =
      time(1000, [&](const vector& x) { return followed.follow(tree, nodes, x, [](int) {}); });
  row.refit = 1e6 * least(3, 5, [&](int) { tree.refit(nodes); });
  if (!std::isfinite(sum)) throw std::runtime_error("the search has found no number");
  return row;
}

// -------------------------------------------------------------------------------------- updates
struct update_row {
  std::size_t nodes = 0;
  std::string by{};
  double update = 0.0;     ///< contact and quadric, mean CPU time [ms]
  double worst = 0.0;      ///< [ms]
  double stiffness = 0.0;  ///< of the last contact [N/m]
  double apart = 0.0;      ///< from that of the first row of the body, relative
};
ex::record record_of(const update_row& r) {
  return {{"nodes", r.nodes},
          {"by", r.by},
          {"update_ms", r.update},
          {"worst_ms", r.worst},
          {"stiffness_N_per_m", r.stiffness},
          {"apart_relative", r.apart}};
}

template <class Body>
update_row touch(const std::string& by, const held_mesh& scene, Body& body, double& first) {
  const auto way = way_of(scene);
  update_row row{.nodes = scene.mesh.nodes.size(), .by = by};
  auto contact = body.update(way[0], vector::Zero());
  constexpr int updates = 100, warm = 3;
  double sum = 0.0;
  for (int i = 0; i < updates; ++i) {
    const double begin = cpu();
    const double force = contact.stiffness * std::max(0.0, contact.depth);
    contact = body.update(way[env::slot(i)], force * contact.normal);
    sum += env::quadric_at(body).curvature;
    if (i < warm) continue;
    row.update += 1e3 * (cpu() - begin) / (updates - warm);
    row.worst = std::max(row.worst, 1e3 * (cpu() - begin));
  }
  if (!contact.fresh || !std::isfinite(sum)) throw std::runtime_error("the body was not touched");
  row.stiffness = contact.stiffness;
  if (first == 0.0) first = row.stiffness;
  row.apart = std::abs(row.stiffness - first) / first;
  return row;
}

/// A body by its order of elimination, and the table of a patch out of it.
struct table_row {
  std::size_t nodes = 0, patch = 0;
  std::string order{};
  double factor = 0.0;             ///< assembled and factorised, CPU time [s]
  double memory = 0.0;             ///< of the factor [MB]
  double computed = std::nan("");  ///< wall time [s]; none: it was not
  double size = std::nan("");      ///< of the file [MB]
  double load = std::nan("");      ///< wall time, every block checked [ms]
};
ex::record record_of(const table_row& r) {
  return {{"nodes", r.nodes},   {"patch_nodes", r.patch}, {"order", r.order},
          {"body_s", r.factor}, {"factor_MB", r.memory},  {"table_s", r.computed},
          {"file_MB", r.size},  {"load_ms", r.load}};
}

/// What every section works with.
struct session {
  ex::report& out;
  const settings& chosen;
  const env::on_progress& tell;
};

using ex::expect, ex::failures;

failures run_solvers(const session& s) {
  ex::report& out = s.out;
  const settings& chosen = s.chosen;
  const env::on_progress& tell = s.tell;  // no structured binding: lambdas capture it
  std::vector<int> sizes{10};
  if (!chosen.quick) sizes.push_back(22);
  if (chosen.large) sizes.push_back(46);
  std::vector<solver_row> solvers;
  std::vector<search_row> searches;
  std::vector<table_row> tables;
  std::vector<update_row> updates;
  for (const int n : sizes) {
    const held_mesh body = make_cube(n);
    std::optional<Eigen::Matrix3d> first;
    solvers.push_back(judge<env::multifrontal>("multifrontal", body, first, tell));
    if (n < 46) solvers.push_back(judge<sparse_ldlt>("sparse_ldlt", body, first, tell));
#ifdef PASSIVE_HAPTICS_CHOLMOD
    solvers.push_back(judge<by_cholmod>("CHOLMOD", body, first, tell));
#endif
    searches.push_back(search(body));

    const auto id = env::fingerprint_of(body.mesh, flesh, body.held);
    const auto patch =
        env::patch_around(env::boundary(body.mesh), body.mesh.nodes, body.top, n < 46 ? 300 : 1000);
    const auto path = out.path(ex::format("cube_%.0f.table", double(n)));
    const auto factorise = [&](std::string order, std::span<const int> touched) {
      const double begin = cpu();
      env::tetrahedral_fem fem(body.mesh, flesh, body.held, {.tell = tell, .touched = touched});
      tables.push_back({.nodes = body.mesh.nodes.size(),
                        .patch = patch.size(),
                        .order = std::move(order),
                        .factor = cpu() - begin,
                        .memory = megabytes(fem.solver())});
      return fem;
    };
    const auto compute = [&](const env::tetrahedral_fem& fem) {
      table_row& table = tables.back();
      std::filesystem::remove(path);
      double from = seconds();
      env::compute_table(path, fem, id, patch, {.threads = chosen.threads, .tell = tell});
      table.computed = seconds() - from;
      table.size = 1e-6 * static_cast<double>(std::filesystem::file_size(path));
      from = seconds();
      auto loaded = env::read_table(path, id, body.mesh.nodes.size());
      table.load = 1e3 * (seconds() - from);
      return loaded;
    };
    double stiffness = 0.0;
    const env::body_options around{.moved = env::moved_nodes::around};
    {
      env::tetrahedral_fem fem = factorise("dissected", {});
      if (n < 46) static_cast<void>(compute(fem));
      env::basic_deformable_body<env::tetrahedral_fem> touched(body.mesh, std::move(fem), around);
      updates.push_back(touch("elimination path", body, touched, stiffness));
    }
    env::tetrahedral_fem fem = factorise("the patch last", patch);
    env::basic_deformable_body<env::compliance_table<>> by_table(body.mesh, compute(fem));
    updates.push_back(touch("table of the patch", body, by_table, stiffness));
    env::basic_deformable_body<env::tetrahedral_fem> touched(body.mesh, std::move(fem), around);
    updates.push_back(touch("elimination path, the patch last", body, touched, stiffness));
    if (n < 46) {
      env::deformable_body whole(body.mesh, flesh, body.held);
      updates.push_back(touch("elimination path, all nodes moved", body, whole, stiffness));
    }
  }
  out.section("Solvers", "Cubes of tetrahedra, E 5 kPa, nu 0.4, held below; CPU time of one core.");
  ex::publish(out, "solvers", solvers);
  out.section("Search",
              "The closest triangle: all looked at, the tree, the tree from the last one, "
              "and downhill from the last one; and what it costs that all nodes have moved.");
  ex::publish(out, "searches", searches);
  out.section("Tables",
              "The compliance of a patch in float, computed on all cores, with the patch "
              "eliminated wherever it comes, and last.");
  ex::publish(out, "tables", tables);
  out.section("Updates", "Contact and quadric of a device that wanders 1 mm below the top.");
  ex::publish(out, "updates", updates);

  failures found;  // times by what else was measured in this run, as machines differ
  for (const auto& r : solvers) {
    expect(found, r.apart < 1e-10, r.solver + ": the contact is another");
    if (r.nodes < 10000 || r.solver == "multifrontal") continue;
    const auto ours = std::find_if(solvers.begin(), solvers.end(), [&r](const solver_row& other) {
      return other.nodes == r.nodes && other.solver == "multifrontal";
    });
    if (ours == solvers.end()) continue;
    expect(found, r.solver != "sparse_ldlt" || ours->factor < 0.2 * r.factor,
           "the multifrontal factor takes more than a fifth of Eigen's time");
    expect(found, ours->contact < 0.1 * r.contact,
           "the elimination path takes more than a tenth of a contact by " + r.solver);
  }
  for (const auto& r : searches) {
    expect(found, r.triangles < 1000 || r.tracked < 0.1 * r.linear,
           "the tree takes more than a tenth of the linear search");
  }
  for (const auto& r : updates) {
    expect(found, r.apart < 1e-5, r.by + ": the stiffness is another");
    expect(found, r.by != "table of the patch" || r.update <= 1.0,
           "an update by the table takes more than 1 ms");
    expect(found, r.by != "elimination path, the patch last" || r.nodes > 20000 || r.update <= 5.0,
           "an update without a table takes more than 5 ms");
  }
  return found;
}

failures judge_precision(const session& s) {
  const auto& [out, chosen, tell] = s;
  precision_settings asked{.sides = {10, 16, 22, 32},
                           .rates = {10, 20, 50, 100, 200, 500, 1000},
                           .threads = chosen.threads};
  if (chosen.large) asked.sides.push_back(46);
  if (chosen.quick) asked = {.sides = {6, 8}, .rates = {20, 500}, .seconds = 1.2};
  failures found;
  for (const auto& r : run_precision(out, asked, tell).rows) {
    // The faster the environment, the closer the model comes to it.
    expect(found, r.rate < 500.0 || r.own < 0.1 * r.force,
           ex::format("%.0f nodes, ", double(r.nodes)) + r.surface +
               ": solved 500 times a second it is not what it is at 10 kHz");
  }
  return found;
}

failures judge_between(const session& s) {
  const auto& [out, chosen, tell] = s;
  failures found;
  const auto [rows, by_hand] =
      run_between(out, {.mesh = chosen.mesh, .unit = chosen.unit, .quick = chosen.quick});
  for (const auto& r : rows) {
    const bool ours = r.by != "bare" && r.by != "TDPA",
               ahead = r.by == "... ahead and lent" && r.scene == "organ",
               mesh = r.by == "make_mesh_touch" && r.late == 0.0 && r.rate >= 30.0,
               knows = r.by == "... moving quadric" || ahead || mesh;
    const std::string where =
        r.scene + ex::format(", %g Hz, ", r.rate) + ex::format("%g ms, ", r.late) + r.by;
    expect(found, !ours || r.least >= -r.loan - 1e-12, where + ": energy was lost");
    expect(found, !knows || r.rate > 60.0 || r.of_bare <= 0.5,
           where + ": more than half of bare's error");
    expect(found, !knows || r.rate < 100.0 || r.of_bare <= 1.2 || r.error <= 0.01,
           where + ": more than 1.2 of bare's error, and than 0.01 N");
    expect(found, !ahead || r.step <= r.own, where + ": it steps by more than the organ does");
    const auto bare = std::find_if(rows.begin(), rows.end(), [&r](const between_row& b) {
      return b.by == "bare" && b.scene == r.scene && b.rate == r.rate && b.late == r.late;
    });
    expect(found,
           !knows || r.rate > 60.0 || (bare != rows.end() && r.step - r.own <= 0.1 * bare->step),
           where + ": its steps beyond the truth's own are over a tenth of bare's");
    expect(found, !knows || r.lost == 0, where + ": contact was lost");
    // The control: the same way, but behind.
    const bool behind = r.by == "... as far behind" && r.scene == "organ" && r.rate <= 60.0;
    expect(found, !behind || r.of_bare > 0.65, where + ": it does not matter where it is asked");
    // Another organ may have two rests under the same finger, as the liver has (docs/design/error.md).
    const bool other = ours && r.scene == "mesh";
    expect(found, !other || (bare != rows.end() && r.step <= bare->step),
           where + ": it steps by more than bare");
    // Asked three times too far ahead it loses 6 % of the liver's ticks.
    expect(found, !other || r.by == "... 3 times too far" || r.lost <= 0.025 * r.ticks,
           where + ": contact was lost for long");
  }
  for (const auto& r : by_hand) {
    expect(found,
           r.scene != "mesh, hand 1" || r.by != "... ahead and lent" || r.rate > 60.0 ||
               r.of_bare <= 1.1,
           r.scene + ex::format(", %g Hz, ", r.rate) + ex::format("%g ms, ", r.late) + r.by +
               ": it errs by more than bare");
  }
  return found;
}

failures judge_chain(const session& s) {
  const auto& [out, chosen, tell] = s;
  chain_settings asked{.side = chosen.chain.side,
                       .seconds = double(chosen.chain.seconds),
                       .rate = double(chosen.chain.rate),
                       .by_table = !chosen.chain.solve,
                       .planes = chosen.chain.planes,
                       .threads = chosen.threads};
  if (chosen.quick) asked.side = 8, asked.seconds = 2.0;
  const chain_row row = run_chain(out, asked, tell);
  failures found;
  expect(found, row.least_energy >= -1e-9, "the chain has lost energy at the true port");
  expect(found, row.missing < 1e-9, "the simulated device's books do not close");
  expect(found, row.contact == 100.0, "the chain has lost contact");
  expect(found, row.largest_force > 0.05, "the chain has pushed with no force");
  return found;
}

failures judge_remote(const session& s) {
  failures found;
  add_remote(s.out, found);
  return found;
}

/// Why small strains stay (docs/design/large_deflections.md), and that rotated elements are right where they are.
failures judge_deflections(const session& s) {
  const auto& [out, chosen, tell] = s;
  const auto rows =
      large_deflections(chosen.quick ? std::vector{5.0} : std::vector{5.0, 10.0, 20.0}, tell);
  out.section(
      "Large deflections",
      "Small strains, and elements that turn, against a neo-Hookean body. Nothing moves here, so "
      "nothing could be quiet or not: each row is an equilibrium.");
  ex::publish(out, "deflections", rows);
  ex::publish(out, "rotation_costs",
              rotation_costs(chosen.quick ? std::vector{10} : std::vector{10, 22}));
  failures found;
  for (const auto& r : rows) {
    const bool pressed = r.scene == "block, pressed";
    expect(found, !pressed || !(r.rotated < 0.5 * r.linear),
           "rotated elements halve the error of a pressed block: take them");
    expect(found, pressed || (r.steps > 0 && r.rotated_body < 0.1 * r.linear_body),
           "rotated elements do not follow a beam");
  }
  return found;
}

const std::vector<ex::section<session>>& sections() {
  static const std::vector<ex::section<session>> all{
      {"solvers", run_solvers}, {"precision", judge_precision}, {"between", judge_between},
      {"chain", judge_chain},   {"remote", judge_remote},       {"deflections", judge_deflections}};
  return all;
}

}  // namespace

settings parse(const std::vector<std::string>& arguments) {
  settings chosen{{"organ"}};
  auto& chain = chosen.chain;
  ex::read_options(
      "organ",
      ex::section_options(
          sections(), chosen, "a first look",
          {ex::a_switch("--large", "97 336 nodes, too (5 GB; 20 minutes)", chosen.large),
           ex::a_text("--mesh FILE", "another organ for `between`, Gmsh MSH", chosen.mesh),
           {"--unit METRES", "its unit of length (default: 0.001)",
            [&chosen](const std::string& text) {
              const auto unit = passive_haptics::to_decimal(text);
              if (!unit || !(*unit >= 1e-9 && *unit <= 1e3)) {
                ex::complain("--unit " + text + ": give a length from 1e-9 to 1000 m");
              }
              chosen.unit = *unit;
            }},
           ex::a_number("--seconds", "of the chain (default: 60)", chain.seconds),
           ex::a_number("--side", "of the chain's organ, nodes (default: 32)", chain.side, 4),
           ex::a_number("--rate", "of its environment, Hz (default: 100)", chain.rate),
           ex::a_switch("--solve", "in the chain: by the elimination path, not by a table",
                        chain.solve),
           ex::a_switch("--planes", "in the chain: planes are published, not quadrics",
                        chain.planes)}),
      arguments);
  return chosen;
}

int run(const std::vector<std::string>& arguments, const std::atomic<bool>& stop) {
  return ex::guarded("organ", [&] {
    const settings chosen = parse(arguments);
    ex::report out(chosen.out, {.json = "organ.json", .markdown = "organ.md"});
    const env::on_progress tell = [&stop](double) { return !stop; };
    failures all;
    try {
      all = ex::run_sections(sections(), chosen.only, session{out, chosen, tell});
    } catch (const env::stopped_by_caller& e) {
      throw ex::interrupted(e.what());
    }
    return ex::conclude(
        out, "organ", "passive_haptics: large finite elements",
        "An organ that is computed slowly, touched a thousand times a second: solvers, "
        "error against run time, the whole chain in real threads, another machine.",
        all);
  });
}

}  // namespace organ
