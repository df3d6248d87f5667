// SPDX-License-Identifier: BSD-3-Clause
// Is what dual_ledger keeps of friction as much as the best of all choices u(1), u(2), … would have kept?
// On a line all of them can be tried; no ledger may claim more, and the three it keeps should lose little.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/laws.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

using Catch::Matchers::WithinAbs;

namespace {

constexpr double c = 0.25;            ///< [N]
constexpr double q = 0x1p-14;         ///< 61 µm, so that sums of them are exact
constexpr double b = 1e-12;           ///< [N·s/m], so that the damper's credit is none
constexpr double rounded = 1e-9 * q;  ///< at most [J], in all

/// The largest value of all sequences of u between −c and c in eighths of c.
class every_choice {
 public:
  explicit every_choice(double presliding) : p_(presliding) {
    A_.fill(-1.0);  // J: out of reach
    A_[none] = 0.0;
  }
  void update(double shown, double held) {
    const auto before = A_;
    for (std::size_t to = 0; to < A_.size(); ++to) {
      double best = -1.0;
      for (std::size_t from = 0; from < A_.size(); ++from) {
        const double doubt = q / 2 * std::abs(u(from) - last_ + held - u(to));
        best = std::max(best, before[from] - doubt - p_ * std::abs(u(to) - u(from)));
      }
      A_[to] = best + (u(to) - held) * shown;
    }
    last_ = held;
  }
  /// A tick nobody saw: u is the friction against `held`, and then none.
  void forfeit(double held) {
    double best = -1.0;
    for (std::size_t from = 0; from < A_.size(); ++from) {
      const double doubt = q / 2 * std::abs(u(from) - last_);
      best = std::max(best, A_[from] - doubt - p_ * std::abs(held - u(from)));
    }
    *this = every_choice(p_);
    A_[none] = best - p_ * std::abs(held);
  }
  [[nodiscard]] double value() const {
    double best = -1.0;
    for (std::size_t i = 0; i < A_.size(); ++i) {
      const double stored = u(i) * u(i) * p_ / (2 * c);
      best = std::max(best, A_[i] - q / 2 * std::abs(u(i) - last_) - stored);
    }
    return best;
  }

 private:
  static constexpr std::size_t none = 8;
  static double u(std::size_t i) { return c * (static_cast<double>(i) / none - 1.0); }
  std::array<double, 2 * none + 1> A_{};
  double p_, last_ = 0.0;
};

/// A ledger and the best of all choices, along the diagonal of a space, where all its axes step at once.
template <class Space>
class on_a_line {
 public:
  explicit on_a_line(double presliding, double loan = 0x1p-6)
      : on_a_line(presliding, presliding, q, loan) {}
  /// Whose ledger is told other numbers than are true.
  on_a_line(double presliding, double stated_presliding, double stated_step, double loan = 0x1p-6)
      : best_(presliding),
        ledger_(ph::dual_ledger{.damping = {b, c, stated_presliding},
                                .quantum = stated_step / std::sqrt(Space::dof),
                                .loan = loan}) {}
  /// So many steps against so many eighths of c.
  void update(int steps, int eighths) {
    const double shown = steps * q, held = eighths * c / 8;
    best_.update(shown, held);
    REQUIRE(ledger_.update(vector(shown), vector(held), scalar(1)));
    compare();
  }
  void forfeit(int eighths) {
    const double held = eighths * c / 8;
    best_.forfeit(held);
    ledger_.forfeit(vector(held), scalar(1));
    compare();
  }
  [[nodiscard]] double best() const { return best_.value(); }                ///< [J]
  [[nodiscard]] double most_lost() const { return most_lost_; }              ///< [J]
  [[nodiscard]] double most_overstated() const { return most_overstated_; }  ///< [J]
  [[nodiscard]] bool keeps_the_best() const {
    return most_lost_ <= rounded && most_overstated_ <= rounded;
  }

 private:
  using scalar = typename Space::scalar;
  static typename Space::vector vector(double length) {
    typename Space::vector all = Space::zero();
    const auto along = static_cast<scalar>(length / std::sqrt(Space::dof));
    for (int i = 0; i < Space::dof; ++i) Space::component(all, i) = along;
    return all;
  }
  void compare() {
    const double ahead = static_cast<double>(ledger_.value() - given_) - best_.value();
    most_lost_ = std::max(most_lost_, -ahead);
    most_overstated_ = std::max(most_overstated_, ahead);
  }

  every_choice best_;
  ph::part_at<ph::dual_ledger, Space> ledger_;
  scalar given_ = ledger_.value();
  double most_lost_ = 0.0, most_overstated_ = 0.0;
};

/// A whole number, each as likely, up to `most` in size.
int any(ph::laws::samples& random, int most) {
  return static_cast<int>(std::lround(random.number<double>() * (most + 0.49)));
}

}  // namespace

TEMPLATE_TEST_CASE("three choices of the friction keep what all do while no force changes",
                   "[dual]", d1, d2, d3) {
  for (const double p : {0.0, q / 8, q / 4, q / 2, q}) {
    for (const int length : {1, 2, 3, 5, 20}) {  // of a swing
      on_a_line<TestType> device(p);
      for (int n = 0; n < 100; ++n) device.update(n % (2 * length) < length ? 1 : -1, 0);
      CAPTURE(p, length);
      CHECK(device.keeps_the_best());
    }
    ph::laws::samples random(1);
    on_a_line<TestType> device(p);
    for (int n = 0; n < 300; ++n) device.update(any(random, 2), 0);
    CAPTURE(p);
    CHECK(device.keeps_the_best());
    CHECK(device.best() > 20 * c * q);  // the control: there was something to keep
  }
  ph::laws::samples random(1);
  on_a_line<TestType> soft(2 * q);  // of friction that is softer than a step they lose a little
  for (int n = 0; n < 300; ++n) soft.update(any(random, 2), 0);
  CHECK(soft.most_overstated() <= rounded);
  CHECK(soft.most_lost() <= 0.25 * c * q + rounded);
}

TEST_CASE("three choices of the friction keep what all do while a device rests", "[dual]") {
  ph::laws::samples random(1);
  for (const double p : {0.0, q / 8, q / 2, q, 2 * q}) {
    CAPTURE(p);
    on_a_line<d2> within(p), beyond(p);  // reach of the friction, in which the force hunts
    for (int n = 0; n < 300; ++n) {
      within.update(0, any(random, 8));
      beyond.update(0, any(random, 16));
    }
    CHECK(within.keeps_the_best());
    CHECK(beyond.most_overstated() <= rounded);
    if (!(p > 0.0) || p >= q) CHECK(beyond.most_lost() <= rounded);
  }
}

TEST_CASE("three choices of the friction keep what all do on a swing into a wall", "[dual]") {
  for (const double p : {0.0, q / 8, q / 4, q / 2}) {
    on_a_line<d2> device(p);
    for (int n = 0, depth = 0; n < 300; ++n) {
      const int way = n % 20 < 10 ? 1 : -1;
      device.update(way, depth);  // the force that it has met
      depth += way;
    }
    CAPTURE(p);
    CHECK(device.keeps_the_best());
    CHECK(device.best() > 200 * c * q);
  }
}

TEST_CASE("three choices of the friction keep what all do over ticks that are lost", "[dual]") {
  ph::laws::samples random(1);
  for (const double p : {0.0, q / 8, q / 4, q / 2}) {
    CAPTURE(p);
    on_a_line<d2> moves(p), rests(p);
    for (int n = 1; n <= 400; ++n) {
      if (n % 20 == 0) {
        const int held = any(random, 8);
        moves.forfeit(held);
        rests.forfeit(held);
      }
      moves.update(any(random, 2), 0);
      rests.update(0, any(random, 8));
    }
    CHECK(moves.keeps_the_best());
    CHECK(rests.keeps_the_best());
  }
}

TEST_CASE("three choices of the friction keep what all do where a rigid friction holds the force",
          "[dual]") {
  ph::laws::samples random(1);
  on_a_line<d2> swings(0.0), jumps(0.0);
  for (int n = 0, held = 0; n < 400; ++n) {
    swings.update(n % 20 < 10 ? 1 : -1, any(random, 8));  // a force within reach in every tick
    if (n % 20 == 0) held = any(random, 16);
    jumps.update(n % 60 < 30 ? 1 : -1, held);
  }
  CHECK(swings.keeps_the_best());
  CHECK(jumps.keeps_the_best());
}

TEMPLATE_TEST_CASE("three choices of the friction never keep more than all do, whatever happens",
                   "[dual]", d1, f1) {
  const auto overstated = [](on_a_line<TestType> device, std::uint64_t seed) {
    ph::laws::samples random(seed);
    for (int n = 0, held = 0; n < 400; ++n) {
      if (any(random, 4) == 0) held = any(random, 20);
      if (any(random, 20) == 0) device.forfeit(any(random, 8));
      device.update(any(random, 2), held);
    }
    return device.most_overstated();
  };
  using device = on_a_line<TestType>;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const double p : {0.0, q / 8, q / 2, q, 2 * q}) {
      CAPTURE(seed, p);
      CHECK(overstated(device(p), seed) <= 0.0);  // rounding, too, only takes
    }
    // the control: told half of what is true
    CHECK(overstated(device(q, q / 2, q), seed) > c * q);
    CHECK(overstated(device(q, q, q / 2), seed) > c * q);
  }
}

TEST_CASE("friction that turns with the motion earns c a metre, less the cost of its turns",
          "[dual]") {
  // Round a square of 6 steps a side: four directions, and two of them are remembered.
  for (const double p : {0.0, q / 4, q}) {
    auto ledger = at<d2>(ph::dual_ledger{.damping = {b, c, p}, .quantum = q, .loan = 0x1p-6});
    const double given = ledger.value();
    for (int side = 0; side < 12; ++side) {
      const double way = side % 4 < 2 ? q : -q;
      for (int n = 0; n < 6; ++n) {
        (void)ledger.update(side % 2 == 0 ? d2::vector(way, 0) : d2::vector(0, way), d2::zero(),
                            1.0);
      }
      const double turns = side * c * (q + p * std::sqrt(2.0));
      const double ends = c * q + 1.5 * c * p;
      CAPTURE(p, side);
      CHECK_THAT(ledger.value() - given, WithinAbs(6 * (side + 1) * c * q - turns - ends, rounded));
    }
  }
}

TEMPLATE_TEST_CASE("to count on friction never keeps less than to count on none", "[dual]", d1, d2,
                   d3) {
  ph::laws::samples random(1);
  int more = 0;
  for (const double p : {0.0, q / 4, q, 4 * q}) {
    auto ledger = at<TestType>(ph::dual_ledger{.damping = {b, c, p}, .quantum = q, .loan = 0x1p-6});
    auto without = at<TestType>(ph::quantised_energy{.damping = b, .quantum = q, .loan = 0x1p-6});
    const double held_back = without.value() - ledger.value();
    typename TestType::vector held = TestType::zero();
    for (int n = 0; n < 1000; ++n) {
      if (any(random, 2) == 0) held = random.vector<TestType>() * (n < 500 ? 2 * c : 20 * c);
      const typename TestType::vector dx = random.vector<TestType>() * (n % 100 < 50 ? 2 * q : 0.0);
      REQUIRE(ledger.update(dx, held, 1.0));
      REQUIRE(without.update(dx, held, 1.0));
      REQUIRE(ledger.value() + held_back >= without.value() - rounded);
      if (ledger.value() + held_back > without.value() + c * q) ++more;
    }
  }
  CHECK(more > 1000);
}

TEST_CASE("in floats, too, three choices of the friction never keep more than all do", "[dual]") {
  ph::laws::samples random(1);
  for (const double p : {0.0, q / 8, q / 2, q, 2 * q}) {
    CAPTURE(p);
    for (const int length : {1, 2, 3, 5}) {
      on_a_line<f1> swings(p, 0.0);  // about zero, where a float sees the least
      for (int n = 0; n < 400; ++n) swings.update(n % (2 * length) < length ? 1 : -1, 0);
      CHECK(swings.most_overstated() <= 0.0);
    }
    on_a_line<f1> hunts(p, 0.0);
    for (int n = 0; n < 400; ++n) hunts.update(0, any(random, 8));
    CHECK(hunts.most_overstated() <= 0.0);
  }
}

TEST_CASE("on a line, whatever came before, a slip earns c a metre but for the cost of one turn",
          "[dual]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double p : {0.0, q / 2, 2 * q}) {
      ph::laws::samples random(seed);
      auto ledger = at<d1>(ph::dual_ledger{.damping = {b, c, p}, .quantum = q, .loan = 0x1p-6});
      for (int leg = 0; leg < 10; ++leg) {
        for (int n = 0; n < 20; ++n) {  // the force hunts, and the device is pushed about
          const double dx = random.number<double>() * (n < 10 ? q : 0.0);
          REQUIRE(ledger.update(dx, random.number<double>() * (3 * c), 1.0));
        }
        REQUIRE(ledger.update(0.0, 0.0, 1.0));
        const double before = ledger.value();
        const double dx = leg % 2 == 0 ? q : -q;
        for (int n = 0; n < 20; ++n) REQUIRE(ledger.update(dx, 0.0, 1.0));
        CAPTURE(seed, p, leg);
        CHECK(ledger.value() >= before + 20 * c * q - (c * q + 2 * c * p) - rounded);
      }
    }
  }
}

TEST_CASE("a direction that is worth much is not given up for a new one", "[dual]") {
  const double p = 2 * q;
  const d2::vector along(q, 0), across(0, q);
  for (const bool first : {true, false}) {
    auto ledger = at<d2>(ph::dual_ledger{.damping = {b, c, p}, .quantum = q, .loan = 0x1p-6});
    const double given = ledger.value();
    const auto slip = [&](int steps, const d2::vector& dx) {
      for (int n = 0; n < steps; ++n) (void)ledger.update(dx, d2::zero(), 1.0);
    };
    slip(first ? 0 : 1, across);
    slip(10, along);
    slip(first ? 1 : 0, across);
    for (int n = 0; n < 10; ++n) {  // which brings down the one that follows the force
      (void)ledger.update(d2::zero(), d2::vector(n % 2 == 0 ? -2 * c : 0, 0), 1.0);
    }
    const double hunted = 10 * q * c;  // ½ q for each newton of a change, whatever is counted on
    const double kept = 10 * c * q - c * q - 1.5 * c * p - hunted;
    CHECK_THAT(ledger.value() - given, WithinAbs(kept, rounded));
    (void)ledger.update(-2 * across, d2::zero(), 1.0);
    CHECK_THAT(ledger.value() - given, WithinAbs(kept, rounded));
  }
}

TEST_CASE("a new direction is not missed for long, whatever the others are worth", "[dual]") {
  for (const double p : {0.0, q / 4, q, 2 * q}) {
    for (int steps = 0; steps <= 8; ++steps) {
      auto ledger = at<d3>(ph::dual_ledger{.damping = {b, c, p}, .quantum = q, .loan = 0x1p-6});
      const auto slip = [&](int many, const d3::vector& dx) {
        const double before = ledger.value();
        for (int n = 0; n < many; ++n) (void)ledger.update(dx, d3::zero(), 1.0);
        return ledger.value() - before;
      };
      (void)slip(10, d3::vector(q, 0, 0));
      (void)slip(steps, d3::vector(0, q, 0));
      CAPTURE(p, steps);
      const double turn = c * q + 2 * c * p;  // and as much till it would have paid
      CHECK(slip(100, d3::vector(0, 0, q)) >= 100 * c * q - 2 * turn - c * q);
    }
  }
}

TEST_CASE("a tick nobody saw costs the way of the friction to the force, and to none", "[dual]") {
  const double p = q;
  const auto lost = [&](int along, int across, const d2::vector& held) {
    auto ledger = at<d2>(ph::dual_ledger{.damping = {b, c, p}, .quantum = q, .loan = 0x1p-6});
    for (int n = 0; n < along; ++n) (void)ledger.update(d2::vector(q, 0), d2::zero(), 1.0);
    for (int n = 0; n < across; ++n) (void)ledger.update(d2::vector(0, q), d2::zero(), 1.0);
    const double before = ledger.value();
    ledger.forfeit(held, 1.0);
    return (before - ledger.value()) / (c * p);
  };
  const d2::vector x(c * (1 - 1e-12), 0), y(0, c * (1 - 1e-12));
  // What the springs held, ½ c p, comes back; what they are bent to costs p a newton.
  CHECK_THAT(lost(10, 0, d2::zero()), WithinAbs(1.0 - 0.5, 1e-6));
  CHECK_THAT(lost(10, 0, x), WithinAbs(0.0 + 1.0 - 0.5, 1e-6));
  CHECK_THAT(lost(10, 0, -x), WithinAbs(2.0 + 1.0 - 0.5, 1e-6));
  CHECK_THAT(lost(10, 0, y), WithinAbs(std::sqrt(2.0) + 1.0 - 0.5, 1e-6));
  CHECK_THAT(lost(10, 2, y), WithinAbs(std::sqrt(2.0) + 1.0 - 0.5, 1e-6));  // x is worth more still
  CHECK_THAT(lost(0, 0, y), WithinAbs(1.0 + 1.0, 1e-6));
}

TEST_CASE("after new parameters no choice counts on more friction than there is", "[dual]") {
  const auto stated = [](double friction) {
    return ph::dual_ledger{.damping = {b, friction, q / 4}, .quantum = q, .loan = 0x1p-6};
  };
  for (const double first : {q, -q}) {
    auto ledger = at<d1>(stated(c));
    const auto slip = [&](double dx) {
      const double before = ledger.value();
      for (int n = 0; n < 10; ++n) (void)ledger.update(dx, 0.0, 1.0);
      return ledger.value() - before;
    };
    (void)slip(first);
    (void)slip(-first);
    CHECK(slip(-first) > 9.9 * c * q);  // the control
    ledger.set(stated(c / 2));
    CHECK_THAT(slip(-first), WithinAbs(10 * c / 2 * q, rounded));
    (void)slip(first);
    CHECK_THAT(slip(first), WithinAbs(10 * c / 2 * q, rounded));
  }
}

TEST_CASE("a choice of 99 % of the friction is replaced by one of all of it, and of more is kept",
          "[dual]") {
  const auto stated = [](double friction) {
    return ph::dual_ledger{.damping = {b, friction, 0.0}, .quantum = q};
  };
  const auto earns = [&](double first) {  // N, where there are 100 N
    auto ledger = at<d1>(stated(first));
    const auto slip = [&] {
      const double before = ledger.value();
      for (int n = 0; n < 10; ++n) (void)ledger.update(q, 0.0, 1.0);
      return (ledger.value() - before) / (10 * q);
    };
    (void)slip();
    ledger.set(stated(100.0));
    (void)slip();
    return slip();
  };
  CHECK_THAT(earns(99.0), WithinAbs(100.0, 1e-6));
  CHECK_THAT(earns(99.5), WithinAbs(99.5, 1e-6));
}

namespace {

/// The same ledger in plain words: each choice of u by itself with the whole of its A (§ 6), and nothing rounded.
/// When one takes the place of another is what friction_certificates.hpp says.
template <class Space>
class plain_ledger {
  using vector = typename Space::vector;
  struct choice {
    vector u = Space::zero();  ///< [N]
    double A{};                ///< [J]
  };

 public:
  plain_ledger(double damping, double presliding, double step, double gift, double begins)
      : b_(damping), p_(presliding), q_(step), gift_(gift), none_{Space::zero(), begins} {
    start();
  }

  void update(const vector& shown, const vector& held, double dt) {
    const vector change = held - last_;
    last_ = held;
    const double gained = damped(shown, dt) - Space::dot(held, shown);
    for (choice* one : {&none_, &slipped_[0], &slipped_[1]}) one->A += gained - doubt(change);
    const vector before = following_.u;
    if (doubt(change) > 0.0) following_.u = rubbing_at(before + change);
    const vector way = following_.u - before;
    following_.A += gained - doubt(way - change) - p_ * Space::norm(way);
    if (Space::norm(shown) > 0.0) slip(shown);
    none_.A += gift_ * Space::norm(shown);
  }
  /// A tick nobody saw: the best choice goes to the friction against `held` and from there to none.
  void forfeit(const vector& held, double dt) {
    const choice* best = &none_;
    for (const choice* one : {&following_, &slipped_[0], &slipped_[1]}) {
      if (sure(*one) > sure(*best)) best = one;
    }
    const vector rubbing = rubbing_at(held);
    const double beyond = std::max(Space::norm(held) - c, 0.0);
    const double lost = p_ * (Space::norm(rubbing - best->u) + Space::norm(rubbing)) -
                        stored(best->u) + dt * beyond * beyond / (4 * b_);
    none_.A = std::max(std::min(value(), -5 * c * p_ / 2), value() - lost);
    last_ = Space::zero();
    start();
  }
  /// Of the two that slipped, the one that is worth more without a force.
  [[nodiscard]] double value() const {
    return std::max({sure(none_), sure(following_), sure(better_slipped())});
  }

  bool forgets = true;  ///< what was missed before a new choice was made

 private:
  [[nodiscard]] double doubt(const vector& d) const {
    double sum = 0.0;
    for (int i = 0; i < Space::dof; ++i) sum += std::abs(Space::component(d, i));
    return q_ / 2 * sum;
  }
  static vector rubbing_at(const vector& f) {
    const double length = Space::norm(f);
    return length > c ? vector(f * (c / length)) : f;
  }
  [[nodiscard]] double stored(const vector& u) const { return Space::dot(u, u) * p_ / (2 * c); }
  /// A less what the friction's springs may hold.
  [[nodiscard]] double worth(const choice& one) const { return one.A - stored(one.u); }
  [[nodiscard]] double sure(const choice& one) const { return worth(one) - doubt(one.u - last_); }
  [[nodiscard]] choice moved(const choice& from, const vector& to) const {
    return {to, from.A - doubt(to - from.u) - p_ * Space::norm(to - from.u)};
  }
  /// Any choice may begin anew, from none, for the most that this may cost.
  [[nodiscard]] choice at_least(const choice& one) const {
    const double begun = none_.A - most_doubt() - 3 * c * p_ / 2;
    return {one.u, std::max(one.A, begun + stored(one.u))};
  }
  [[nodiscard]] const choice& better_slipped() const {
    return slipped_[worth(slipped_[1]) > worth(slipped_[0]) ? 1 : 0];
  }
  [[nodiscard]] double most_doubt() const { return q_ / 2 * c * std::sqrt(Space::dof); }

  void slip(const vector& shown) {
    const double length = Space::norm(shown);
    std::array<double, 2> earns{};
    for (std::size_t i = 0; i < 2; ++i) earns[i] = Space::dot(slipped_[i].u, shown);
    const std::size_t i = earns[1] > earns[0] ? 1 : 0;
    if (earns[i] > 0.99 * c * length) {
      const choice there = moved(following_, slipped_[i].u);
      if (there.A > slipped_[i].A) slipped_[i] = there;
      if (forgets) missed_ = 0.0;
    } else {
      const choice fresh = at_least(moved(following_, vector(shown * (c / length))));
      std::size_t j = used_;
      if (used_ == 2) j = worth(slipped_[1]) + earns[1] < worth(slipped_[0]) + earns[0] ? 1 : 0;
      missed_ += c * length - earns[j];
      if (used_ < 2 || worth(fresh) + missed_ > worth(slipped_[j])) {
        used_ = std::max(used_, j + 1);
        slipped_[j] = fresh;
        if (forgets) missed_ = 0.0;
      }
    }
    for (choice* one : {&following_, &slipped_[0], &slipped_[1]}) {
      *one = at_least(*one);
      one->A += Space::dot(one->u, shown);
    }
    const choice& best = better_slipped();
    if (moved(best, following_.u).A >= following_.A) following_ = best;
    none_.A =
        std::max(none_.A, std::max(worth(best), worth(following_)) - most_doubt() - p_ * c / 2);
  }
  /// What the damper took for certain, tick by tick or over a window, whichever is more.
  double damped(const vector& shown, double dt) {
    if (elapsed_ >= 0.032) {
      travel_ = Space::zero();
      elapsed_ = by_ticks_ = booked_ = 0.0;
    }
    elapsed_ += dt;
    if (!(Space::norm(shown) > 0.0)) return 0.0;
    travel_ = travel_ + shown;
    by_ticks_ += least_square(shown) * b_ / dt;
    const double before = booked_;
    booked_ = std::max(booked_, std::max(by_ticks_, least_square(travel_) * b_ / elapsed_));
    return booked_ - before;
  }
  [[nodiscard]] double least_square(const vector& way) const {
    double sum = 0.0;
    for (int i = 0; i < Space::dof; ++i) {
      const double sure = std::max(std::abs(Space::component(way, i)) - q_, 0.0);
      sum += sure * sure;
    }
    return sum;
  }
  void start() {
    following_ = slipped_[0] = slipped_[1] = {Space::zero(), none_.A};
    used_ = 0;
    missed_ = 0.0;
    travel_ = Space::zero();
    elapsed_ = by_ticks_ = booked_ = 0.0;
  }

  double b_, p_, q_, gift_;
  choice none_, following_{};
  std::array<choice, 2> slipped_{};
  std::size_t used_ = 0;
  double missed_ = 0.0;
  vector last_ = Space::zero(), travel_ = Space::zero();
  double elapsed_ = 0.0, by_ticks_ = 0.0, booked_ = 0.0;
};

/// A friction with a further source of energy, as sliders are, which pays a share of c for each metre.
struct with_a_gift : ph::damping_and_friction {
  template <class Space>
  class on : public ph::damping_and_friction::on<Space> {
   public:
    using scalar = typename Space::scalar;
    constexpr explicit on(const with_a_gift& of) noexcept
        : ph::damping_and_friction::on<Space>(of) {}
    [[nodiscard]] constexpr with_a_gift parameters() const noexcept {
      return {ph::damping_and_friction::on<Space>::parameters()};
    }
    struct credits {
      [[nodiscard]] constexpr scalar slip(scalar /*slipped*/, const typename Space::motion& shown,
                                          const auto& /*damping*/,
                                          const auto& /*steps*/) const noexcept {
        return gift * Space::norm(shown);
      }
    };
  };
  static constexpr double gift = c / 3;
};

/// The most by which a ledger differs from one in plain words that is told so many times its presliding [J]. A force
/// hunts within the friction, jumps beyond it or rests; a device rests, slips one way, turns, or is shaken, never
/// twice by the same way, so that no two choices are worth the same.
template <class Space, class Damping>
double most_apart(std::uint64_t seed, double times = 1.0) {
  using vector = typename Space::vector;
  const double p = std::array<double, 4>{0.0, q / 8, q / 2, 2 * q}[seed % 4];
  const double damping = seed % 3 == 0 ? 0.05 : b, step = seed % 5 == 0 ? 0.0 : q;
  ph::laws::samples random(seed);
  ph::basic_dual_ledger<Damping> told{.quantum = step, .loan = 0x1p-6};
  told.damping.coefficient = damping;
  told.damping.coulomb = c;
  told.damping.presliding = p;
  auto ledger = at<Space>(told);
  const double gift = std::same_as<Damping, with_a_gift> ? with_a_gift::gift : 0.0;
  plain_ledger<Space> plain(damping, times * p, step, gift, ledger.value());
  vector held = Space::zero(), way = Space::zero();
  double most = 0.0;
  for (int n = 0; n < 400; ++n) {
    if (any(random, 3) == 0) held = random.vector<Space>() * (n / 100 % 2 == 0 ? c : 4 * c);
    if (any(random, 8) == 0) way = random.vector<Space>() * (3 * q);
    if (any(random, 8) == 0) way = way * -1.0;
    if (any(random, 12) == 0) way = Space::zero();
    const vector shaken = random.vector<Space>() * q;
    const vector dx =
        n / 50 % 2 == 0 ? vector(way * (1.0 + 0.1 * random.number<double>())) : shaken;
    const double dt = 1e-3 * (1.5 + random.number<double>());
    if (any(random, 40) == 0) {
      ledger.forfeit(held, dt);
      plain.forfeit(held, dt);
    }
    REQUIRE(ledger.update(dx, held, dt));
    plain.update(dx, held, dt);
    most = std::max(most, std::abs(ledger.value() - plain.value()));
  }
  return most;
}

}  // namespace

TEMPLATE_TEST_CASE("dual_ledger is what its formulas are, written out choice by choice", "[dual]",
                   d1, d2, d3) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    CHECK(most_apart<TestType, ph::damping_and_friction>(seed) <= rounded);
    CHECK(most_apart<TestType, with_a_gift>(seed) <= rounded);
    if (seed % 4 != 0)
      CHECK(most_apart<TestType, with_a_gift>(seed, 1.01) > 100 * rounded);  // the control
  }
}

TEST_CASE("without friction dual_ledger is quantised_energy", "[dual]") {
  ph::laws::samples random(1);
  auto ledger = at<d2>(ph::dual_ledger{.damping = {0.05, 0.0, 0.0}, .quantum = q});
  auto without = at<d2>(ph::quantised_energy{.damping = 0.05, .quantum = q});
  for (int n = 0; n < 200; ++n) {
    const d2::vector dx = random.vector<d2>() * (2 * q), held = random.vector<d2>();
    REQUIRE(ledger.update(dx, held, 1e-3));
    REQUIRE(without.update(dx, held, 1e-3));
    REQUIRE(ledger.value() == without.value());
  }
  CHECK(ledger.value() != 0.0);
}

TEST_CASE("a ledger that never forgot what it missed would turn with every step, and keep less",
          "[dual]") {
  // A hand that wanders: each new choice costs a turn, so that it has to be missed anew before the next.
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ph::laws::samples random(seed);
    plain_ledger<d3> forgets(b, q, q, 0.0, 0.0), remembers = forgets;
    remembers.forgets = false;
    auto ledger = at<d3>(ph::dual_ledger{.damping = {b, c, q}, .quantum = q});
    const double given = ledger.value();
    d3::vector way = d3::zero();
    for (int n = 0; n < 1500; ++n) {
      way = way * 0.9 + random.vector<d3>() * (q / 2);
      REQUIRE(ledger.update(way, d3::zero(), 1.0));
      forgets.update(way, d3::zero(), 1.0);
      remembers.update(way, d3::zero(), 1.0);
    }
    CAPTURE(seed, ledger.value() - given, forgets.value(), remembers.value());
    CHECK(ledger.value() - given >= forgets.value() - rounded);
    CHECK(ledger.value() - given > remembers.value() + 20 * c * q);
  }
}
