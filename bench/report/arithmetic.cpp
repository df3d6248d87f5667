// SPDX-License-Identifier: BSD-3-Clause
#include "arithmetic.hpp"

#include "quad.hpp"

#include <map>

namespace experiments {
namespace {

template <class S>
using compensated = ph::compensated_sum<S>;

// All parameters are floats, so that every scalar has the same ones.
template <class Space>
constexpr ph::loop_limits<Space> loop() {
  return {.longest_tick = typename Space::scalar(tick_length)};
}
template <class Space, class Ledger>
auto ledger(float cap) {
  using scalar = typename Space::scalar;
  ph::reduced_energy<Space, ph::isotropic_damping<Space>, Ledger> observer{
      .damping = {scalar(0.03125F)}};
  if (cap > 0.0F) observer.cap = scalar(cap);
  return observer;
}
template <class Space>
ph::reachable_bound<Space> reachable() {
  using scalar = typename Space::scalar;
  return {.mass = scalar(0.125F), .hand_force = scalar(5.0F)};
}

struct wall_strict {
  static constexpr const char* name = "1-DOF wall, strict";
  template <class S, class Ledger>
  static auto make() {
    using space = ph::space<S, 1>;
    return ph::local_model{space{},
                           ph::following<ph::half_space<space>>{},
                           ph::snap<space>{},
                           ph::spring<space>{},
                           ledger<space, Ledger>(0.0F),
                           ph::strict_bound<space>{},
                           loop<space>()};
  }
};

struct wall_settling {
  static constexpr const char* name = "1-DOF wall, damped spring, reachable, capped";
  template <class S, class Ledger>
  static auto make() {
    using space = ph::space<S, 1>;
    return ph::local_model{
        space{},
        ph::following<ph::half_space<space>>{},
        ph::snap<space>{},
        ph::damped_spring<space>{.mass = S(0.125F), .stiffness_fraction = S(0.125F)},
        ledger<space, Ledger>(0.5F),
        reachable<space>(),
        loop<space>()};
  }
};

struct plane_strict {
  static constexpr const char* name = "3-DOF plane, normals turned, strict, capped";
  template <class S, class Ledger>
  static auto make() {
    using space = ph::space<S, 3>;
    return ph::local_model{space{},
                           ph::following<ph::half_space<space>>{},
                           ph::rotate_limited<space>{.rate = S(1)},
                           ph::spring<space>{},
                           ledger<space, Ledger>(0.5F),
                           ph::strict_bound<space>{},
                           loop<space>()};
  }
};

struct triangle_thesis {
  static constexpr const char* name = "3-DOF triangle, full thesis, reachable, capped";
  template <class S, class Ledger>
  static auto make() {
    using space = ph::space<S, 3>;
    return ph::local_model{space{},
                           ph::following<ph::triangle<space>>{},
                           ph::rotate_limited<space>{.rate = S(1)},
                           ph::spring<space>{},
                           ledger<space, Ledger>(0.5F),
                           ph::bound_chain{ph::thesis_bound<space>{}, reachable<space>()},
                           loop<space>()};
  }
};

/// What is compared, of any scalar, as 113 bits.
struct observed {
  quad force[3], normal[3], energy, depth;
};
template <class Model, class Result>
observed observe(const Model& model, const Result& out, const std::array<float, 3>& at) {
  using space = typename Model::space_type;
  observed seen{};
  const typename space::vector normal = model.local().outward();
  for (int i = 0; i < space::dof; ++i) {
    seen.force[i] = quad(space::component(out.force, i));
    seen.normal[i] = quad(space::component(normal, i));
  }
  seen.energy = quad(out.energy);
  seen.depth = quad(model.local().depth(position_in<space>(at)));
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
    using space = typename Model::space_type;
    if (n % ticks_per_update == 0) {
      model_.retarget(constraint_from<typename Model::constraint_type>(surface_at(n)));
    }
    const auto at = stroke_at(n);
    const auto out = model_.tick(position_in<space>(at), typename space::scalar(tick_length));
    return observe(model_, out, at);
  }
  void compare(const observed& mine, const observed& reference) {
    off_.take(length(mine.force, reference.force), distance(mine.energy, reference.energy),
              distance(mine.depth, reference.depth), length(mine.normal, reference.normal));
  }
  [[nodiscard]] arithmetic_row row(const std::string& composition, long ticks,
                                   const extremes& largest) const {
    return {composition,
            scalar_,
            epsilon_,
            ticks,
            {off_.force / largest.force, off_.energy / largest.energy, off_.depth / largest.depth,
             off_.normal}};
  }

 private:
  std::string scalar_;
  double epsilon_;
  Model model_;
  extremes off_;
};

/// Every scalar but the reference, beside each other.
template <class Composition>
auto contenders() {
  const auto one = []<class S, class Ledger>(const char* name, S, Ledger) {
    return contender(name, static_cast<double>(std::numeric_limits<S>::epsilon()),
                     Composition::template make<S, Ledger>());
  };
  return std::tuple{one("float", 0.0F, 0.0F),
                    one("float, compensated ledger", 0.0F, compensated<float>{}),
                    one("double", 0.0, 0.0), one("long double", 0.0L, 0.0L)};
}

template <class Composition>
std::vector<arithmetic_row> compare_scalars(long ticks) {
  auto all = contenders<Composition>();
  contender reference("113 bits", 0x1p-112, Composition::template make<quad, quad>());
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

using comparison = std::vector<arithmetic_row> (*)(long);
struct entry {
  std::string name;
  comparison run;
};
const std::vector<entry>& entries() {
  static const std::vector<entry> all{{wall_strict::name, compare_scalars<wall_strict>},
                                      {wall_settling::name, compare_scalars<wall_settling>},
                                      {plane_strict::name, compare_scalars<plane_strict>},
                                      {triangle_thesis::name, compare_scalars<triangle_thesis>}};
  return all;
}

}  // namespace

const std::vector<std::string>& arithmetic_compositions() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& e : entries()) all.push_back(e.name);
    return all;
  }();
  return names;
}

std::vector<arithmetic_row> compare(const std::string& composition, long ticks) {
  for (const auto& e : entries()) {
    if (e.name == composition) return e.run(ticks);
  }
  throw std::invalid_argument("no composition " + composition);
}

const std::vector<candidate>& arithmetic_candidates() {
  static const std::vector<candidate> all = [] {
    std::vector<candidate> made;
    const auto add = [&]<class Composition>(Composition) {
      std::apply([&](const auto&... c) { (made.push_back(c.timed(Composition::name)), ...); },
                 contenders<Composition>());
    };
    add(wall_strict{});
    add(wall_settling{});
    add(plane_strict{});
    add(triangle_thesis{});
    return made;
  }();
  return all;
}

}  // namespace experiments
