// SPDX-License-Identifier: BSD-3-Clause
// The solver of large bodies: equal to the sparse one, stopped, refused, and honest about a singular matrix.
#include "../bench/organ/sparse_ldlt.hpp"
#include "environment/bodies.hpp"
#include <passive_haptics/environment/msh_reader.hpp>
#include <passive_haptics/environment/patch_compliance.hpp>

#include <numeric>

namespace {

struct scene {
  env::tetrahedral_mesh mesh;
  std::vector<int> fixed;
};

// Shaken blocks with holes, a ring, an organ, and two bodies that do not touch.
std::vector<scene> scenes() {
  std::mt19937 random(11);
  std::vector<scene> all;
  for (int run = 0; run < 3; ++run) {
    auto mesh =
        blocks(6, [&](int i, int j, int k) { return k == 0 || (i + j + k + run) % 5 != 0; });
    for (auto& x : mesh.nodes) {
      if (x.z() > 0.0) x += 0.1 * anywhere(random, 1.0);
    }
    std::vector<int> fixed;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      if (mesh.nodes[i].z() == 0.0) fixed.push_back(static_cast<int>(i));
    }
    all.push_back({mesh, fixed});
  }
  all.push_back({torus(1.0, 0.3, 24, 6), {0, 30, 60, 90}});
  const auto organ = env::scaled(env::read_msh(PASSIVE_HAPTICS_TEST_DATA "/organ.msh"), 1e-3);
  all.push_back({organ, {0, 10, 20, 30, 40, 50}});
  scene two{bar(30), {0, 1, 2, 3}};
  const int count = static_cast<int>(two.mesh.nodes.size());
  const auto other = bar(30);
  for (const auto& x : other.nodes) two.mesh.nodes.push_back(x + Vector3d(0, 5, 0));
  for (auto t : other.tetrahedra) {
    for (int& node : t) node += count;
    two.mesh.tetrahedra.push_back(t);
  }
  for (int k = 0; k < 4; ++k) two.fixed.push_back(count + k);
  all.push_back(two);
  return all;
}

}  // namespace

TEST_CASE("multifrontal solves what the sparse factorisation solves", "[environment][fem]") {
  std::mt19937 random(12);
  for (const auto& [mesh, fixed] : scenes()) {
    REQUIRE_NOTHROW(env::check(mesh));
    const auto number = env::free_numbers(mesh, fixed);
    const auto graph = env::graph_of(mesh, number);
    const auto K = env::stiffness_matrix(mesh, soft, fixed);
    env::multifrontal fronts;
    organ::sparse_ldlt columns;
    CHECK(fronts.analyse(graph) > 0);
    CHECK(fronts.factorise(K).smallest_pivot > 1e-6);
    CHECK(columns.factorise(K).smallest_pivot > 1e-6);
    REQUIRE(fronts.tree().fronts.size() > 1);
    for (int run = 0; run < 3; ++run) {
      Eigen::VectorXd b = Eigen::VectorXd::Zero(K.rows());
      for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = anywhere(random, 1.0).x();
      Eigen::VectorXd by_fronts = b, by_columns = b;
      fronts.solve(by_fronts);
      columns.solve(by_columns);
      CHECK((by_fronts - by_columns).norm() < 1e-10 * by_columns.norm());
      CHECK((K * by_fronts - b).norm() < 1e-10 * b.norm());
    }
  }
}

TEST_CASE("multifrontal presses a point as full solutions do", "[environment][fem]") {
  std::mt19937 random(13);
  for (const auto& [mesh, fixed] : scenes()) {
    env::tetrahedral_fem fronts(mesh, soft, fixed);
    env::basic_tetrahedral_fem<organ::sparse_ldlt> columns(mesh, soft, fixed);
    const auto surface = env::boundary(mesh);
    for (int run = 0; run < 6; ++run) {
      const auto& t = surface[random() % surface.size()].nodes;
      const Vector3d some = anything(random) + Vector3d::Constant(1.2), force = anything(random);
      const Vector3d weights = some / some.sum();
      const Eigen::Matrix3d C = columns.press(t, weights);
      CHECK((fronts.press(t, weights) - C).norm() <= 1e-10 * C.norm());
      CHECK((fronts.compliance(t, weights) - C).norm() <= 1e-10 * C.norm());
      for (int again = 0; again < 2;
           ++again) {  // a second force at the same point, in another order
        fronts.load((again + 1) * force);
        columns.load((again + 1) * force);
        std::vector<Vector3d> forces(mesh.nodes.size(), Vector3d::Zero());
        for (std::size_t k = 0; k < 3; ++k) {
          forces[std::size_t(t[k])] = (again + 1) * weights[Eigen::Index(k)] * force;
        }
        const auto all = fronts.displacements(forces);
        double largest = 1e-300;
        for (const auto& u : all) largest = std::max(largest, u.norm());
        for (int ask = 0; ask < 40; ++ask) {
          const int node = static_cast<int>(random() % mesh.nodes.size());
          const Vector3d u = all[std::size_t(node)];
          REQUIRE((fronts.displacement(node) - u).norm() <= 1e-10 * largest);
          REQUIRE((columns.displacement(node) - u).norm() <= 1e-10 * largest);
        }
      }
    }
  }
}

TEST_CASE("multifrontal gives columns of the inverse for the rows that are wanted",
          "[environment][fem]") {
  const auto [mesh, fixed] = scenes().front();
  const auto K = env::stiffness_matrix(mesh, soft, fixed);
  env::multifrontal solver;
  solver.analyse(env::graph_of(mesh, env::free_numbers(mesh, fixed)));
  const std::vector<int> loaded{3, 100, 17}, wanted{99, 3, 42, 150};
  CHECK(solver.columns(loaded, wanted).isZero());  // nothing is factorised yet
  REQUIRE(solver.factorise(K).smallest_pivot > 0.0);
  CHECK(solver.columns({}, wanted).size() == 0);
  CHECK(solver.columns(loaded, {}).size() == 0);
  const Eigen::MatrixXd C = solver.columns(loaded, wanted);
  for (std::size_t j = 0; j < 3 * loaded.size(); ++j) {
    Eigen::VectorXd b = Eigen::VectorXd::Unit(K.rows(), 3 * loaded[j / 3] + Eigen::Index(j % 3));
    solver.solve(b);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Vector3d u = C.block<3, 1>(3 * Eigen::Index(i), Eigen::Index(j));
      CHECK((u - b.segment<3>(3 * wanted[i])).norm() < 1e-12 * b.norm());
    }
  }
}

TEST_CASE("a factorisation tells how far it is, and can be stopped at any time",
          "[environment][fem]") {
  const auto [mesh, fixed] = scenes().front();
  int calls = 0;
  double last = 0.0;
  bool rises = true;
  const auto count = [&](double done) {
    ++calls;
    rises = rises && done >= last && done <= 1.0;
    last = done;
    return true;
  };
  env::tetrahedral_fem whole(mesh, soft, fixed, {.tell = count});
  CHECK(rises);
  CHECK(last > 0.5);
  REQUIRE(calls > 5);
  const int all = calls;
  for (int stop_at = 1; stop_at <= all; ++stop_at) {
    int asked = 0;
    const auto stop = [&](double) { return ++asked < stop_at; };
    const auto text = text_of<env::stopped_by_caller>([&, &mesh = mesh, &fixed = fixed] {
      env::tetrahedral_fem(mesh, soft, fixed, {.tell = stop});
    });
    CHECK(contains(text, "stopped while it factorised"));
    CHECK(asked == stop_at);  // not once more
  }
  // The solver itself is left without a factor, and does nothing.
  const auto K = env::stiffness_matrix(mesh, soft, fixed);
  env::multifrontal solver;
  solver.analyse(env::graph_of(mesh, env::free_numbers(mesh, fixed)));
  REQUIRE(solver.factorise(K).smallest_pivot > 0.0);
  CHECK(solver.factorise(K, [](double) { return false; }).stopped);
  CHECK_FALSE(solver.factorised());
  Eigen::VectorXd b = Eigen::VectorXd::Ones(K.rows());
  solver.solve(b);
  CHECK(b == Eigen::VectorXd::Ones(K.rows()));
  env::multifrontal::pressed at;
  env::multifrontal::answer to;
  solver.prepare(at);
  solver.prepare(to);
  const std::array<int, 1> nodes{5};
  const std::array<double, 1> weights{1.0};
  solver.press(at, nodes, weights);
  CHECK(at.compliance.isZero());
  solver.forget(to);
  CHECK(solver.displacement(to, at, Vector3d::UnitX(), 5).isZero());
  CHECK(solver.factorise(K).smallest_pivot > 0.0);  // and may try again
  CHECK(solver.factorised());
}

TEST_CASE("a body that needs too much memory is refused before it takes it", "[environment][fem]") {
  const auto [mesh, fixed] = scenes().front();
  env::multifrontal solver;
  const auto graph = env::graph_of(mesh, env::free_numbers(mesh, fixed));
  const auto needed = static_cast<double>(solver.analyse(graph));
  // The prediction is what the fronts are, and a lower bound of it is the dense last one.
  CHECK(needed >= solver.tree().factor_bytes);
  const auto K = env::stiffness_matrix(mesh, soft, fixed);
  REQUIRE(solver.factorise(K).smallest_pivot > 0.0);
  int called = 0;
  const auto tell = [&](double) { return ++called > 0; };
  const auto text = text_of<env::memory_refused>([&, &mesh = mesh, &fixed = fixed] {
    env::tetrahedral_fem(mesh, soft, fixed, {.tell = tell, .memory_limit = 0.5 * needed});
  });
  CHECK(contains(text, "GB are allowed; give a coarser mesh"));
  CHECK(called == 0);
  CHECK_NOTHROW(env::tetrahedral_fem(mesh, soft, fixed, {.memory_limit = 3.0 * needed}));
}

TEST_CASE("nested dissection eliminates every node once, children first", "[environment][fem]") {
  for (const auto& [mesh, fixed] : scenes()) {
    const auto graph = env::graph_of(mesh, env::free_numbers(mesh, fixed));
    const auto tree = env::dissect(graph, 20);
    std::vector<int> hits(tree.position.size(), 0);
    for (const int p : tree.position) ++hits.at(std::size_t(p));
    CHECK(std::all_of(hits.begin(), hits.end(), [](int n) { return n == 1; }));
    int next = 0;
    for (std::size_t t = 0; t < tree.fronts.size(); ++t) {
      const auto& front = tree.fronts[t];
      REQUIRE(front.first == next);
      REQUIRE(front.pivots > 0);
      next += front.pivots;
      REQUIRE((front.bound.empty() ? front.parent == -1 : front.parent > int(t)));
    }
    CHECK(next == graph.size());
    // A neighbour that comes later is in the bound of the front.
    for (int i = 0; i < graph.size(); ++i) {
      const int at = tree.position[std::size_t(i)];
      const auto& front = tree.fronts[std::size_t(tree.front_of[std::size_t(at)])];
      for (const int n : graph.neighbours_of(i)) {
        const int other = tree.position[std::size_t(n)];
        if (other < front.first + front.pivots) continue;
        REQUIRE(std::binary_search(front.bound.begin(), front.bound.end(), other));
      }
    }
  }
}

TEST_CASE("nodes that contacts are on are eliminated together, last, and nothing else changes",
          "[environment][fem]") {
  std::mt19937 random(14);
  for (const auto& [mesh, fixed] : scenes()) {
    const auto surface = env::boundary(mesh);
    auto touched =
        env::patch_around(surface, mesh.nodes, mesh.nodes[random() % mesh.nodes.size()], 12);
    touched.push_back(touched.front());  // twice, and one that is held
    touched.push_back(fixed.front());
    env::tetrahedral_fem plain(mesh, soft, fixed);
    env::tetrahedral_fem close(mesh, soft, fixed, {.touched = touched});
    std::vector<int> numbers;
    for (const int node : touched) {
      if (close.moves(node)) numbers.push_back(close.numbers()[std::size_t(node)]);
    }
    REQUIRE(numbers.size() > 3);
    CHECK(close.solver().path_of(numbers).size() == 1);
    CHECK(plain.solver().path_of(numbers).size() > 1);  // the control
    for (int run = 0; run < 20; ++run) {
      const auto& t = surface[random() % surface.size()].nodes;
      const Vector3d some = anything(random) + Vector3d::Constant(1.2), force = anything(random);
      const Vector3d weights = some / some.sum();
      const Eigen::Matrix3d C = plain.press(t, weights);
      CHECK((close.press(t, weights) - C).norm() <= 1e-10 * C.norm());
      plain.load(force);
      close.load(force);
      double apart = 0.0, largest = 0.0;
      for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
        const Vector3d u = plain.displacement(node);
        apart = std::max(apart, (close.displacement(node) - u).norm());
        largest = std::max(largest, u.norm());
      }
      CHECK(apart <= 1e-10 * largest);
    }
  }
  const auto [mesh, fixed] = scenes().front();
  std::vector<int> all(mesh.nodes.size());
  std::iota(all.begin(), all.end(), 0);
  env::tetrahedral_fem dense(mesh, soft, fixed, {.touched = all});  // one front of them all
  CHECK(dense.solver().tree().fronts.size() == 1);
  for (const int wrong : {-1, static_cast<int>(mesh.nodes.size())}) {
    const std::vector<int> nodes{0, wrong};
    const auto text = text_of<std::invalid_argument>([&, &mesh = mesh, &fixed = fixed] {
      env::tetrahedral_fem(mesh, soft, fixed, {.touched = nodes});
    });
    CHECK(contains(text, "touched node " + std::to_string(wrong) + " is refused"));
  }
}
