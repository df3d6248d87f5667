// SPDX-License-Identifier: BSD-3-Clause
#include "arithmetic.hpp"

#include "quad.hpp"

#include <algorithm>
#include <tuple>

namespace experiments {
namespace {

using ph::ledger_sum;

// Powers of two and small whole numbers, so that every scalar has the same ones.
constexpr ph::isotropic_damping damping{0.03125};
constexpr ph::reachable_bound reachable{.mass = 0.125, .hand_force = 5.0};
constexpr ph::loop_limits loop{.longest_tick = double(tick_length)};

template <ledger_sum Sum>
constexpr ph::basic_reduced_energy<ph::isotropic_damping, Sum> ledger{.damping = damping};
template <ledger_sum Sum>
constexpr ph::basic_capped_energy<ph::isotropic_damping, Sum> capped{.damping = damping,
                                                                     .cap = 0.5};

template <class Constraint>
auto over(const auto& normals, const auto& law, const auto& observer, const auto& bound) {
  return ph::local_model{typename Constraint::space_type{},
                         ph::followed<Constraint>{},
                         normals,
                         law,
                         observer,
                         bound,
                         loop};
}
template <class S, int Dof>
using plane = ph::half_space<ph::space<S, Dof>>;

struct wall_strict {
  static constexpr const char* name = "1-DOF wall, strict";
  template <class S, ledger_sum Sum>
  static auto make() {
    return over<plane<S, 1>>(ph::turn_at_once{}, ph::spring{}, ledger<Sum>, ph::strict_bound{});
  }
};

struct wall_settling {
  static constexpr const char* name = "1-DOF wall, damped spring, reachable, capped";
  template <class S, ledger_sum Sum>
  static auto make() {
    return over<plane<S, 1>>(ph::turn_at_once{},
                             ph::damped_spring{.mass = 0.125, .stiffness_fraction = 0.125},
                             capped<Sum>, reachable);
  }
};

struct plane_strict {
  static constexpr const char* name = "3-DOF plane, normals turned, strict, capped";
  template <class S, ledger_sum Sum>
  static auto make() {
    return over<plane<S, 3>>(ph::turn_limited{.rate = 1}, ph::spring{}, capped<Sum>,
                             ph::strict_bound{});
  }
};

struct triangle_thesis {
  static constexpr const char* name = "3-DOF triangle, full thesis, reachable, capped";
  template <class S, ledger_sum Sum>
  static auto make() {
    return over<ph::triangle<ph::space<S, 3>>>(ph::turn_limited{.rate = 1},
                                               ph::shaped{ph::spring{}, ph::thesis_rule{}},
                                               capped<Sum>, reachable);
  }
};

/// What is compared, of any scalar, as 113 bits.
struct observed {
  quad at[3], force[3], normal[3], energy, depth;
};
template <class Model, class Result, class Vector>
observed observe(const Model& model, const Result& out, const Vector& x) {
  using space = typename Model::port_type;
  const auto local = model.local().at(x);
  const typename space::vector normal = local.outward();
  observed seen{};
  for (int i = 0; i < space::dof; ++i) {
    seen.at[i] = quad(space::component(x, i));
    seen.force[i] = quad(space::component(out.force, i));
    seen.normal[i] = quad(space::component(normal, i));
  }
  seen.energy = quad(out.energy);
  seen.depth = quad(local.depth);
  return seen;
}

double length(const quad (&a)[3], const quad (&b)[3]) {
  quad sum = 0;
  for (int i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return static_cast<double>(sqrt(sum));
}
double distance(const quad& a, const quad& b) {
  return static_cast<double>(abs(a - b));
}

/// The largest of everything so far.
struct extremes {
  double force = 0, energy = 0, depth = 0, normal = 0;
  void take(double f, double e, double d, double n) {
    force = std::max(force, f);
    energy = std::max(energy, e);
    depth = std::max(depth, d);
    normal = std::max(normal, n);
  }
};

/// One scalar beside the reference.
template <class Model>
class contender {
 public:
  contender(std::string scalar, double epsilon, const Model& model)
      : scalar_(std::move(scalar)), epsilon_(epsilon), model_(model) {}

  [[nodiscard]] candidate timed(const std::string& composition) const {
    return candidate_of(composition + ", " + scalar_, model_);
  }
  observed tick(long n) {
    using space = typename Model::port_type;
    if (n % ticks_per_update == 0) {
      model_.update(constraint_from<typename Model::constraint_type>(surface_at(n)));
    }
    const typename space::vector x = position_in<space>(stroke_at(n));
    return observe(model_, model_.tick(x, ph::seconds{typename space::scalar(tick_length)}), x);
  }
  void compare(const observed& mine, const observed& reference) {
    off_.take(length(mine.force, reference.force), distance(mine.energy, reference.energy),
              distance(mine.depth, reference.depth), length(mine.normal, reference.normal));
    same_motion_ = same_motion_ && std::equal(mine.at, mine.at + 3, reference.at);
  }
  [[nodiscard]] arithmetic_row row(const std::string& composition, long ticks,
                                   const extremes& largest) const {
    return {composition,
            scalar_,
            epsilon_,
            ticks,
            {off_.force / largest.force, off_.energy / largest.energy, off_.depth / largest.depth,
             off_.normal},
            same_motion_};
  }

 private:
  std::string scalar_;
  double epsilon_;
  Model model_;
  extremes off_;
  bool same_motion_ = true;
};

/// Every scalar but the reference, beside each other.
template <class Composition>
auto contenders() {
  const auto one = []<class S>(const char* name, S, const auto& model) {
    return contender(name, static_cast<double>(std::numeric_limits<S>::epsilon()), model);
  };
  constexpr auto plain = ledger_sum::plain;
  return std::tuple{one("float", 0.0F, Composition::template make<float, plain>()),
                    one("float, compensated ledger", 0.0F,
                        Composition::template make<float, ledger_sum::compensated>()),
                    one("double", 0.0, Composition::template make<double, plain>()),
                    one("long double", 0.0L, Composition::template make<long double, plain>())};
}

template <class Composition>
std::vector<arithmetic_row> compare_scalars(long ticks) {
  auto all = contenders<Composition>();
  contender reference("113 bits", 0x1p-112, Composition::template make<quad, ledger_sum::plain>());
  const quad zero[3] = {0, 0, 0};
  extremes largest;
  std::vector<arithmetic_row> rows;
  long next = 1000;
  for (long n = 0; n < ticks; ++n) {
    const observed truth = reference.tick(n);
    largest.take(length(truth.force, zero), distance(truth.energy, 0), distance(truth.depth, 0), 1);
    std::apply([&](auto&... c) { (c.compare(c.tick(n), truth), ...); }, all);
    if (n + 1 == next) {
      std::apply(
          [&](auto&... c) { (rows.push_back(c.row(Composition::name, next, largest)), ...); }, all);
      next *= 10;
    }
  }
  return rows;
}

template <class Composition>
arithmetic_composition entry() {
  arithmetic_composition made{Composition::name, compare_scalars<Composition>, {}};
  const auto add = [&made](const auto& c) { made.timed.push_back(c.timed(made.name)); };
  std::apply([&](const auto&... c) { (add(c), ...); }, contenders<Composition>());
  return made;
}

}  // namespace

const std::vector<arithmetic_composition>& arithmetic_compositions() {
  static const std::vector<arithmetic_composition> all{entry<wall_strict>(), entry<wall_settling>(),
                                                       entry<plane_strict>(),
                                                       entry<triangle_thesis>()};
  return all;
}

}  // namespace experiments
