// SPDX-License-Identifier: BSD-3-Clause
#include "large_deflection.hpp"

#include <passive_haptics/environment/tetrahedral_fem.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace organ {

namespace env = passive_haptics::environment;
namespace ex = experiments;
using vector = Eigen::Vector3d;
using matrix = Eigen::Matrix3d;

namespace {

constexpr env::material flesh{.young = 5e3, .poisson = 0.4};

/// A box of nodes 5 mm apart, held at x = 0 or z = 0.
struct box {
  env::tetrahedral_mesh mesh;
  std::vector<int> held, loaded;
};
box make_box(const std::array<int, 3>& n, int held_axis, const auto& is_loaded) {
  constexpr double h = 5e-3;
  box made;
  const auto number = [&](const std::array<int, 3>& at) {
    return (at[2] * n[1] + at[1]) * n[0] + at[0];
  };
  std::array<int, 3> at{};
  for (at[2] = 0; at[2] < n[2]; ++at[2]) {
    for (at[1] = 0; at[1] < n[1]; ++at[1]) {
      for (at[0] = 0; at[0] < n[0]; ++at[0]) {
        if (at[env::slot(held_axis)] == 0) made.held.push_back(number(at));
        if (is_loaded(at)) made.loaded.push_back(number(at));
        made.mesh.nodes.push_back(h * vector(at[0], at[1], at[2]));
      }
    }
  }
  for (int k = 0; k + 1 < n[2]; ++k) {
    for (int j = 0; j + 1 < n[1]; ++j) {
      for (int i = 0; i + 1 < n[0]; ++i) {
        std::array<int, 3> axis{0, 1, 2};
        do {
          std::array<int, 3> corner{i, j, k};
          std::array<int, 4> t{number(corner)};
          for (std::size_t s = 0; s < 3; ++s) {
            ++corner[env::slot(axis[s])];
            t[s + 1] = number(corner);
          }
          if (env::signed_volume(made.mesh, t) < 0.0) std::swap(t[2], t[3]);
          made.mesh.tetrahedra.push_back(t);
        } while (std::next_permutation(axis.begin(), axis.end()));
      }
    }
  }
  return made;
}

/// The rotation next to F, from the last one (M. Müller, J. Bender, N. Chentanez, M. Macklin, 2016).
void rotate_towards(const matrix& F, Eigen::Quaterniond& q, int most) {
  for (int i = 0; i < most; ++i) {
    const matrix R = q.matrix();
    const vector turn =
        R.col(0).cross(F.col(0)) + R.col(1).cross(F.col(1)) + R.col(2).cross(F.col(2));
    const double along = R.col(0).dot(F.col(0)) + R.col(1).dot(F.col(1)) + R.col(2).dot(F.col(2));
    const double angle = turn.norm() / (std::abs(along) + 1e-9);
    if (angle < 1e-12) return;
    q = Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn.normalized())) * q;
    q.normalize();
  }
}

/// A body that is held, its forces and, where a law has them, its stiffness at any displacement.
class body {
 public:
  explicit body(const box& of)
      : mesh_(of.mesh),
        number_(env::free_numbers(mesh_, of.held)),
        graph_(env::graph_of(mesh_, number_)),
        rest_stiffness_(env::stiffness_matrix(mesh_, flesh, number_, graph_)) {
    for (const auto& t : mesh_.tetrahedra) {
      gradients_.push_back(env::shape_gradients(mesh_, t));
      volumes_.push_back(env::signed_volume(mesh_, t));
    }
    static_cast<void>(at_rest_.analyse(graph_));
    static_cast<void>(tangent_.analyse(graph_));
    if (!(at_rest_.factorise(rest_stiffness_).smallest_pivot > 0.0))
      throw std::runtime_error("the block is not held");
  }

  [[nodiscard]] Eigen::Index unknowns() const { return rest_stiffness_.rows(); }
  /// The same force [N] on each of these nodes, `total` in sum.
  [[nodiscard]] Eigen::VectorXd load(const std::vector<int>& nodes, const vector& total) const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(unknowns());
    for (const int node : nodes) {
      f.segment<3>(3 * number_[env::slot(node)]) += total / static_cast<double>(nodes.size());
    }
    return f;
  }
  [[nodiscard]] Eigen::VectorXd linear(Eigen::VectorXd f) {
    at_rest_.solve(f);
    return f;
  }

  /// Forces of elements that are linear in a frame that turns with them.
  [[nodiscard]] Eigen::VectorXd rotated_forces(const Eigen::VectorXd& u,
                                               std::vector<Eigen::Quaterniond>& turned,
                                               int most) const {
    turned.resize(volumes_.size(), Eigen::Quaterniond::Identity());
    return forces(u, [&](std::size_t e, const matrix& F) -> matrix {
      rotate_towards(F, turned[e], most);
      const matrix R = turned[e].matrix();
      const matrix strain = R.transpose() * F - matrix::Identity();
      return R * (flesh.shear() * (strain + strain.transpose()) +
                  flesh.lame() * strain.trace() * matrix::Identity());
    });
  }

  /// u under f by rotated elements, corrected once with the factor of the rest: what fits into an update.
  [[nodiscard]] Eigen::VectorXd rotated_once(const Eigen::VectorXd& f, Eigen::VectorXd u) {
    std::vector<Eigen::Quaterniond> turned;
    return u + linear(f - rotated_forces(u, turned, 30));
  }
  /// The same with a factor of the turned elements for each correction, until nothing is left; how many it
  /// took, 0: none helped.
  int rotated(const Eigen::VectorXd& f, Eigen::VectorXd& u) {
    std::vector<Eigen::Quaterniond> turned;
    for (int step = 0; step < 100; ++step) {
      const Eigen::VectorXd left = f - rotated_forces(u, turned, 30);
      if (left.norm() < 1e-7 * f.norm()) return step;
      const auto K = assembled([&](std::size_t e, std::size_t a, std::size_t b) -> matrix {
        const matrix R = turned[e].matrix();
        const vector &ga = gradients_[e][a], &gb = gradients_[e][b];
        return R *
               (flesh.lame() * ga * gb.transpose() + flesh.shear() * gb * ga.transpose() +
                flesh.shear() * ga.dot(gb) * matrix::Identity()) *
               R.transpose();
      });
      if (!(tangent_.factorise(K).smallest_pivot > 0.0)) return 0;
      Eigen::VectorXd du = left;
      tangent_.solve(du);
      for (double share = 1.0;; share /= 2.0) {
        auto tried = turned;
        if ((f - rotated_forces(u + share * du, tried, 30)).norm() < left.norm() || share < 0.1) {
          u += share * du;
          break;
        }
      }
      if (!u.allFinite()) return 0;
    }
    return 0;
  }

  /// The same of a neo-Hookean body, P = μ(F − F⁻ᵀ) + λ ln det F F⁻ᵀ, by Newton from u.
  void neo_hookean(const Eigen::VectorXd& f, Eigen::VectorXd& u) {
    double before = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 60; ++step) {
      const Eigen::VectorXd left = f - forces(u, stress);
      if (left.norm() < 1e-9 * f.norm()) return;
      if (!(tangent_.factorise(stiffness(u)).smallest_pivot > 0.0)) break;
      Eigen::VectorXd du = left;
      tangent_.solve(du);
      double share = 1.0;
      for (; share > 1e-4; share /= 2.0) {  // no element turns over, and the forces come closer
        const Eigen::VectorXd r = f - forces(u + share * du, stress);
        if (r.allFinite() && (r.norm() < left.norm() || r.norm() < 1e-9 * f.norm())) break;
      }
      u += share * du;
      before = left.norm();
    }
    throw std::runtime_error(env::sentence("no neo-Hookean equilibrium; left over ", before, " N"));
  }
  /// How the solution gives way along f at a neo-Hookean equilibrium.
  [[nodiscard]] double tangent_compliance(const Eigen::VectorXd& f, const Eigen::VectorXd& u) {
    if (!(tangent_.factorise(stiffness(u)).smallest_pivot > 0.0))
      throw std::runtime_error("the body has lost its stiffness");
    Eigen::VectorXd x = f;
    tangent_.solve(x);
    return f.dot(x);
  }

 private:
  template <class Stress>
  [[nodiscard]] Eigen::VectorXd forces(const Eigen::VectorXd& u, const Stress& stress_of) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns());
    for (std::size_t e = 0; e < volumes_.size(); ++e) {
      const matrix P = stress_of(e, deformation(e, u));
      for (std::size_t a = 0; a < 4; ++a) {
        const int number = number_[env::slot(mesh_.tetrahedra[e][a])];
        if (number >= 0) sum.segment<3>(3 * number) += volumes_[e] * P * gradients_[e][a];
      }
    }
    return sum;
  }
  [[nodiscard]] matrix deformation(std::size_t e, const Eigen::VectorXd& u) const {
    matrix F = matrix::Identity();
    for (std::size_t a = 0; a < 4; ++a) {
      const int number = number_[env::slot(mesh_.tetrahedra[e][a])];
      if (number >= 0) F += u.segment<3>(3 * number) * gradients_[e][a].transpose();
    }
    return F;
  }
  static matrix stress(std::size_t /*e*/, const matrix& F) {
    const double volume = F.determinant();
    const matrix inverse = F.inverse().transpose();
    return flesh.shear() * (F - inverse) +
           flesh.lame() * (volume > 0.0 ? std::log(volume) : std::nan("")) * inverse;
  }
  /// K out of 3 × 3 blocks of elements and two of their nodes, per volume.
  template <class Block>
  [[nodiscard]] Eigen::SparseMatrix<double> assembled(const Block& block_of) const {
    Eigen::SparseMatrix<double> K = rest_stiffness_;
    std::fill_n(K.valuePtr(), K.nonZeros(), 0.0);
    for (std::size_t e = 0; e < volumes_.size(); ++e) {
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < 4; ++b) {
          const int row = number_[env::slot(mesh_.tetrahedra[e][a])];
          const int column = number_[env::slot(mesh_.tetrahedra[e][b])];
          if (row < 0 || column < 0) continue;
          const matrix block = volumes_[e] * block_of(e, a, b);
          for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) K.coeffRef(3 * row + i, 3 * column + j) += block(i, j);
          }
        }
      }
    }
    return K;
  }
  [[nodiscard]] Eigen::SparseMatrix<double> stiffness(const Eigen::VectorXd& u) const {
    return assembled([&](std::size_t e, std::size_t a, std::size_t b) -> matrix {
      const matrix F = deformation(e, u), inverse = F.inverse().transpose();
      const vector ga = inverse * gradients_[e][a], gb = inverse * gradients_[e][b];
      return flesh.shear() * gradients_[e][a].dot(gradients_[e][b]) * matrix::Identity() +
             (flesh.shear() - flesh.lame() * std::log(F.determinant())) * gb * ga.transpose() +
             flesh.lame() * ga * gb.transpose();
    });
  }

  const env::tetrahedral_mesh& mesh_;
  std::vector<int> number_;
  env::node_graph graph_;
  Eigen::SparseMatrix<double> rest_stiffness_;
  std::vector<std::array<vector, 4>> gradients_;
  std::vector<double> volumes_;
  env::multifrontal at_rest_, tangent_;
};

/// The force is chosen so that the neo-Hookean body goes as far as wanted, within a hundredth.
void judge(const std::string& scene, const box& of, const vector& direction, double length,
           const std::vector<double>& percents, const env::on_progress& tell,
           std::vector<large_deflection_row>& rows) {
  body solid(of);
  const Eigen::VectorXd unit = solid.load(of.loaded, direction);
  const double give = unit.dot(solid.linear(unit));  // of the loaded point, per newton
  Eigen::VectorXd u = Eigen::VectorXd::Zero(solid.unknowns());
  double force = 0.0;
  for (const double percent : percents) {
    if (tell && !tell(0.0)) throw env::stopped_by_caller("stopped: there is no report");
    const double wanted = percent / 100.0 * length;
    for (int i = 0; i < 40 && std::abs(unit.dot(u) - wanted) > 0.01 * wanted; ++i) {
      const double tangent = solid.tangent_compliance(unit, u);
      const double most = 0.04 * length;  // what one step may add, so that Newton finds its way
      force += std::clamp(wanted - unit.dot(u), -most, most) / tangent;
      solid.neo_hookean(force * unit, u);
    }
    const double exact = unit.dot(u), stiffness = 1.0 / solid.tangent_compliance(unit, u);
    const auto apart = [&](const Eigen::VectorXd& other) {
      return std::abs(unit.dot(other) - exact) / exact;
    };
    large_deflection_row row{.scene = scene, .percent = 100.0 * exact / length};
    const Eigen::VectorXd linear = solid.linear(force * unit);
    row.linear = apart(linear);
    row.linear_body = (linear - u).norm() / u.norm();
    row.linear_stiffness = std::abs(1.0 / give - stiffness) / stiffness;
    row.one_step = apart(solid.rotated_once(force * unit, linear));
    Eigen::VectorXd rotated = u;  // the best start there is
    row.steps = solid.rotated(force * unit, rotated);
    row.rotated = row.steps > 0 ? apart(rotated) : std::nan("");
    row.rotated_body = row.steps > 0 ? (rotated - u).norm() / u.norm() : std::nan("");
    Eigen::VectorXd farther = rotated;
    const bool both = row.steps > 0 && solid.rotated(1.02 * force * unit, farther) > 0;
    const double rotated_stiffness = 0.02 * force / unit.dot(farther - rotated);
    row.rotated_stiffness =
        both ? std::abs(rotated_stiffness - stiffness) / stiffness : std::nan("");
    rows.push_back(row);
  }
}

double cpu() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

box block_of(int n) {
  const int middle = n / 2;
  return make_box({n, n, n}, 2, [&](const std::array<int, 3>& at) {
    return at[2] == n - 1 && std::abs(at[0] - middle) < 2 && std::abs(at[1] - middle) < 2;
  });
}

}  // namespace

ex::record record_of(const large_deflection_row& r) {
  return {{"scene", r.scene},
          {"deflection_percent", r.percent},
          {"linear_relative", r.linear},
          {"linear_body_relative", r.linear_body},
          {"linear_stiffness_relative", r.linear_stiffness},
          {"one_step_relative", r.one_step},
          {"rotated_relative", r.rotated},
          {"rotated_body_relative", r.rotated_body},
          {"rotated_stiffness_relative", r.rotated_stiffness},
          {"steps", r.steps}};
}
ex::record record_of(const rotation_cost_row& r) {
  return {{"nodes", r.nodes}, {"solve_ms", r.solve}, {"rotated_forces_ms", r.forces}};
}

std::vector<large_deflection_row> large_deflections(const std::vector<double>& percents,
                                                    const env::on_progress& tell) {
  std::vector<large_deflection_row> rows;
  judge("block, pressed", block_of(9), -vector::UnitZ(), 0.040, percents, tell, rows);
  const box beam =
      make_box({21, 4, 4}, 0, [](const std::array<int, 3>& at) { return at[0] == 20; });
  judge("beam, bent", beam, -vector::UnitZ(), 0.100, percents, tell, rows);
  return rows;
}

std::vector<rotation_cost_row> rotation_costs(const std::vector<int>& sides) {
  std::vector<rotation_cost_row> rows;
  for (const int n : sides) {
    const box block = block_of(n);
    body solid(block);
    const Eigen::VectorXd f = solid.load(block.loaded, vector(0.0, 0.0, -0.2));
    const Eigen::VectorXd u = solid.linear(f);
    rotation_cost_row row{.nodes = block.mesh.nodes.size()};
    row.solve = row.forces = std::numeric_limits<double>::infinity();
    std::vector<Eigen::Quaterniond> turned;
    double sum = solid.rotated_forces(u, turned, 30).sum();
    for (int i = 0; i < 5; ++i) {
      double begin = cpu();
      sum += solid.rotated_forces(u, turned, 3).sum();
      row.forces = std::min(row.forces, 1e3 * (cpu() - begin));
      begin = cpu();
      sum += solid.linear(f).sum();
      row.solve = std::min(row.solve, 1e3 * (cpu() - begin));
    }
    if (!std::isfinite(sum)) throw std::runtime_error("the block has left the numbers");
    rows.push_back(row);
  }
  return rows;
}

}  // namespace organ
