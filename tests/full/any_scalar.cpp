// SPDX-License-Identifier: BSD-3-Clause
// Any scalar that models `real` composes: here one that is no literal and copies by a function of
// its own, as a multiprecision number does. It holds a double, so its bits must be a double's.
#include "support/catch.hpp"
#include "support/curved.hpp"
#include <passive_haptics/passive_haptics.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <random>
#include <vector>

namespace {

class boxed {
 public:
  boxed() : value_(0) {}
  template <class Number>
  requires std::is_arithmetic_v<Number> boxed(Number value)  // NOLINT(google-explicit-constructor)
      : value_(static_cast<double>(value)) {}
  boxed(const boxed& other) noexcept : value_(other.value_) {}
  boxed& operator=(const boxed& other) noexcept {
    value_ = other.value_;
    return *this;
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  explicit operator Number() const { return static_cast<Number>(value_); }

  boxed& operator+=(const boxed& b) { return value_ += b.value_, *this; }
  boxed& operator-=(const boxed& b) { return value_ -= b.value_, *this; }
  boxed& operator*=(const boxed& b) { return value_ *= b.value_, *this; }
  boxed& operator/=(const boxed& b) { return value_ /= b.value_, *this; }
  friend boxed operator+(boxed a, const boxed& b) { return a += b; }
  friend boxed operator-(boxed a, const boxed& b) { return a -= b; }
  friend boxed operator*(boxed a, const boxed& b) { return a *= b; }
  friend boxed operator/(boxed a, const boxed& b) { return a /= b; }
  friend boxed operator-(const boxed& a) { return -a.value_; }
  friend bool operator==(const boxed& a, const boxed& b) { return a.value_ == b.value_; }
  friend std::partial_ordering operator<=>(const boxed& a, const boxed& b) {
    return a.value_ <=> b.value_;
  }
  friend boxed sqrt(const boxed& a) { return std::sqrt(a.value_); }
  friend boxed atan2(const boxed& y, const boxed& x) { return std::atan2(y.value_, x.value_); }
  friend boxed abs(const boxed& a) { return std::fabs(a.value_); }

 private:
  double value_;
};

}  // namespace

template <>
struct std::numeric_limits<boxed> : std::numeric_limits<double> {
  using limits = std::numeric_limits<double>;
  static boxed min() { return limits::min(); }
  static boxed max() { return limits::max(); }
  static boxed lowest() { return limits::lowest(); }
  static boxed epsilon() { return limits::epsilon(); }
};
template <>
struct Eigen::NumTraits<boxed> : Eigen::NumTraits<double> {
  using Real = boxed;
  using NonInteger = boxed;
  using Nested = boxed;
  enum { RequireInitialization = 1 };
};

namespace {

namespace ph = passive_haptics;

template <class S>
using line = ph::space<S, 1>;
template <class S>
using room = ph::space<S, 3>;

static_assert(!std::is_trivially_copyable_v<boxed> && ph::real<boxed>);

struct wall {
  template <class S>
  static auto composed() {
    return ph::local_model{
        line<S>{},
        ph::followed<ph::half_space<line<S>>>{{.stale_after = 0.2}},
        ph::turn_at_once{},
        ph::damped_spring{.mass = 0.1},
        ph::reduced_energy{.damping = 0.03},
        ph::reachable_bound{.mass = 0.1, .hand_force = 5},
        ph::loop_limits{.longest_tick = 1e-3, .top_speed = 100, .watchdog = 1e-3}};
  }
};
struct plane {
  template <class S>
  static auto composed() {
    return ph::local_model{
        room<S>{},
        ph::followed<ph::half_space<room<S>>>{},
        ph::turn_limited{.rate = 1},
        ph::spring{},
        ph::quantised_energy{.damping = 0.03, .quantum = 1e-6},
        ph::strict_bound{},
        ph::late_loop_limits<1>{.longest_tick = 1e-3, .top_speed = 100, .watchdog = 1e-3}};
  }
};
struct triangle {
  template <class S>
  static auto composed() {
    using kept = ph::basic_reduced_energy<ph::isotropic_damping, ph::ledger_sum::compensated>;
    return ph::local_model{
        room<S>{},
        ph::followed<ph::triangle<room<S>>>{},
        ph::turn_limited{.rate = 1},
        ph::shaped{ph::spring{}, ph::thesis_rule{}},
        kept{.damping = 0.03},
        ph::bound_chain{ph::reachable_bound{.mass = 0.1}, ph::memoryless_bound{}},
        ph::watched_loop_limits<>{.longest_tick = 1e-3, .top_speed = 100, .watchdog = 1e-3}};
  }
};

/// A pressing, sliding device, a surface that heaves and tilts, late ticks and a NaN.
template <class Model>
std::vector<double> played(Model model) {
  using space = typename Model::space_type;
  using S = typename space::scalar;
  std::vector<double> seen;
  for (int n = 0; n < 2000; ++n) {
    const double t = 1e-3 * n, tilt = 0.1 * std::sin(2.0 * t), height = 5e-4 * std::sin(9.0 * t);
    const double z = n % 401 == 400 ? std::nan("") : 3e-3 * std::sin(6.0 * t);
    typename space::vector x = space::zero();
    space::component(x, space::dof - 1) = S(z);
    if (n % 33 == 0) {
      if constexpr (requires(typename Model::constraint_type c) { c.thickness; }) {
        const auto node = [&](double a, double b) {
          return typename space::vector(S(a), S(b), S(height - tilt * a));
        };
        CHECK(model.update({.a = node(-0.1, -0.1),
                            .b = node(0.1, 0.0),
                            .c = node(-0.1, 0.1),
                            .stiffness = S(800)}));
      } else {
        typename space::vector normal = space::zero(), point = space::zero();
        space::component(normal, 0) = S(space::dof == 1 ? 1.0 : tilt);
        if (space::dof > 1) space::component(normal, space::dof - 1) = S(1);
        space::component(point, space::dof - 1) = S(height);
        CHECK(model.update({point, normal, S(800)}));
      }
    }
    const auto out = model.tick(x, ph::seconds{S(n % 97 == 96 ? 1.5e-3 : 1e-3)});
    for (int i = 0; i < space::dof; ++i) {
      seen.push_back(static_cast<double>(space::component(out.force, i)));
    }
    seen.push_back(static_cast<double>(out.depth));
    seen.push_back(static_cast<double>(out.energy));
    seen.push_back(static_cast<double>(out.what));
  }
  return seen;
}

/// Torques in, torques out, bounded by what is reachable.
template <class S>
std::vector<double> guarded() {
  using joints = ph::joint_space<S, 2>;
  using ledger = ph::basic_reduced_energy<ph::diagonal_damping<2>>;
  ph::passive_port guard{
      joints{}, ph::given_force{}, ledger{.damping = {{0.03, 0.01}}},
      ph::reachable_work_bound<2>{.inertia = {{0.1, 0.05}}, .hand = 3},
      ph::late_loop_limits<2>{.longest_tick = 1e-3, .top_speed = 100, .watchdog = 1e-3}};
  std::vector<double> seen;
  for (int n = 0; n < 500; ++n) {
    const typename joints::vector q(S(1e-2 * std::sin(0.05 * n)), S(2e-2 * std::cos(0.03 * n)));
    const typename joints::vector wanted(S(std::sin(0.2 * n)), S(-0.5));
    const auto out = guard.tick(q, 1ms, wanted);
    for (int i = 0; i < 2; ++i) seen.push_back(static_cast<double>(out.force(i)));
    seen.push_back(static_cast<double>(out.energy));
  }
  return seen;
}

/// Every kind of surface, probed around its middle.
template <class S>
std::vector<double> probed() {
  std::vector<double> seen;
  curved::every_surface<room<S>>([&](auto surface) {
    CHECK(surface.prepare());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> in(-0.05, 0.05);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d x(in(random), in(random), in(random));
      const typename room<S>::vector at = curved::of<room<S>>(x);
      const auto probe = surface.at(at);
      const typename room<S>::vector push = ph::detail::steepest_push<room<S>>(probe);
      seen.push_back(static_cast<double>(probe.depth));
      for (int k = 0; k < 3; ++k) seen.push_back(static_cast<double>(push(k)));
      seen.push_back(probe.covered() ? 1.0 : 0.0);
    }
  });
  return seen;
}

}  // namespace

TEST_CASE("surfaces of any scalar that models real compute what those of a double do",
          "[scalar][curved]") {
  const auto plain = probed<double>();
  CHECK(plain.size() == 12 * 200 * 5);
  CHECK(probed<boxed>() == plain);
  CHECK(probed<float>() != plain);  // the control
}

TEMPLATE_TEST_CASE("any scalar that models real composes, and computes what a double does",
                   "[scalar]", wall, plane, triangle) {
  const auto plain = played(TestType::template composed<double>());
  CHECK(played(TestType::template composed<boxed>()) == plain);
  const auto strongest = *std::max_element(plain.begin(), plain.end());
  CHECK(strongest > 0.1);                                        // it pressed
  CHECK(played(TestType::template composed<float>()) != plain);  // the control
}

TEST_CASE("any scalar that models real guards joints, and computes what a double does",
          "[scalar]") {
  CHECK(guarded<boxed>() == guarded<double>());
  CHECK(guarded<float>() != guarded<double>());  // the control
}
