// SPDX-License-Identifier: BSD-3-Clause
// A set of contacts is computed a second time, from docs/design/contacts.md § 2, by what is slow and plain: every
// slot in every tick, and nothing that is only there to save time. Whatever surfaces come, move, turn, change
// their stiffness and go under whatever motion, both should press alike.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/contact/contact_set.hpp>

#include <algorithm>
#include <functional>
#include <vector>

namespace {

using vec = Eigen::Vector3d;
using plane = ph::half_space<d3>;
using bowl = ph::quadric<d3>;
constexpr double T = 1e-3;

/// A solid between two planes, with an edge.
struct roof {
  using space_type = d3;
  using scalar = double;
  static constexpr ph::surface_kind kind = ph::surface_kind::faceted;
  ph::stored_vector<double, 3> point{0, 0, 0}, left{0, 0, 1}, right{0, 0, 1};
  double stiffness = 0.0, size = 1.0;

  [[nodiscard]] bool prepare() noexcept {
    return ph::detail::make_unit<d3>(left) && ph::detail::make_unit<d3>(right) && stiffness > 0.0;
  }
  struct probe {
    double depth;
    vec normal;
    bool covers;
    [[nodiscard]] vec outward() const noexcept { return normal; }
    [[nodiscard]] bool covered() const noexcept { return covers; }
  };
  [[nodiscard]] probe at(const vec& x) const noexcept {
    const vec from = vec(point) - x, l = left, r = right;
    const bool is_left = from.dot(l) < from.dot(r);
    return {is_left ? from.dot(l) : from.dot(r), is_left ? l : r, from.norm() < size};
  }
};

/// What a surface shows at a point.
struct shown {
  double depth = 0.0;
  vec normal = vec::UnitZ(), push = vec::UnitZ();
  bool covers = false;
};

/// One surface that the set feels, and what it remembers.
struct slow_slot {
  enum { none, expected, there, leaving, stale } state = none;
  std::function<shown(const vec&)> surface;
  ph::surface_kind kind{};
  double stiffness = 0.0;  ///< as told [N/m]
  ph::sampled_spring<double> spring{};
  double lag = 0.0, speed = 0.0, hurry = 1.0, pressed = 0.0, age = 0.0;
  ph::stick_slip::bristle<d3> bristle{};
  vec normal = vec::Zero(), before = vec::Zero(), place = vec::Zero();  ///< `before`: the target's
  bool owed = false;  ///< it has pressed since the news that are being made up for
};

class slow_set {
 public:
  slow_set(int slots, const ph::proxy_spring& spring, const ph::pursuit& pace,
           const ph::stick_slip& friction)
      : friction_(friction),
        slots_(static_cast<std::size_t>(slots)),
        rule_(spring),
        pace_(pace),
        spring_(spring) {
    rule_.adopt(T);
  }

  void update(int i, const auto& next) {
    auto told = next;
    REQUIRE(told.prepare());
    slow_slot& s = slots_[static_cast<std::size_t>(i)];
    begin_news();
    s.owed = s.owed && s.state != slow_slot::none;
    const auto show = [told](const vec& x) {
      const auto here = told.at(x);
      shown what{here.depth, here.outward(), here.outward(), here.covered()};
      if constexpr (requires { here.push(); }) what.push = here.push();
      return what;
    };
    const auto spring = rule_.sampled(told.stiffness);
    const shown now = show(last_);
    const double was = s.state == slow_slot::none ? 0.0 : s.surface(last_).depth;
    if (s.pressed > 0.0) {  // the force stays: d K is the same
      s.lag = now.depth - (was - s.lag) * (s.spring.stiffness * spring.compliance);
      s.speed = std::max(pace_.speed, std::abs(s.lag) / pace_.catch_up);
      const double within = std::clamp(s.age, pace_.catch_up / 8, pace_.catch_up);
      s.hurry = std::max(1.0, (now.normal - s.normal).norm() / (within * pace_.turn_rate));
      s.before = now.normal;
      s.state = slow_slot::there;
    } else {
      const bool known = s.state == slow_slot::there || s.state == slow_slot::expected;
      s.lag = known ? std::max(0.0, now.depth - was + s.lag) : HUGE_VAL;
      s.state = slow_slot::expected;
    }
    s.surface = show;
    s.kind = ph::kind_of<std::decay_t<decltype(next)>>();
    s.stiffness = told.stiffness;
    s.spring = spring;
    s.age = 0.0;
  }
  void release(int i) {
    slow_slot& s = slots_[static_cast<std::size_t>(i)];
    begin_news();
    s.owed = false;
    s.state = s.pressed > 0.0 ? slow_slot::leaving : slow_slot::none;
  }
  void set(const ph::pursuit& pace) {
    pace_ = pace;
    adopt();
  }
  void set(const ph::proxy_spring& spring) {
    rule_ = ph::proxy_spring::at<double>(spring);
    rule_.adopt(T);
    spring_ = spring;
    adopt();
  }
  void refuse() {
    begin_news();
    refused_ = true;
  }

  struct result {
    vec force = vec::Zero();
    double depth = 0.0;
    ph::event what = ph::event::nominal;
  };
  result tick(const vec& x, double dt) {
    if (!placed_) last_ = x;
    placed_ = true;
    const vec way = x - last_;
    result all;
    if (std::none_of(slots_.begin(), slots_.end(),
                     [](auto& s) { return s.state != slow_slot::none; }))
      worsen(all.what, ph::event::no_target);
    if (refused_) worsen(all.what, ph::event::rejected_target);
    refused_ = false;

    ph::proxy_problem<vec, double, 16> rows;
    std::vector<slow_slot*> felt;
    std::vector<vec> normals;
    const double together = 1.0 - spring_.softness;
    const bool rests =
        std::none_of(slots_.begin(), slots_.end(), [](auto& s) { return s.pressed > 0.0; });
    bool chases = false;
    for (auto& s : slots_) {
      if (s.state == slow_slot::none) continue;
      s.age += dt;
      if (s.state == slow_slot::there && s.age > pace_.stale_after) s.state = slow_slot::stale;
      if (s.state == slow_slot::stale) worsen(all.what, ph::event::stale_target);
      shown own = s.surface(x);
      const auto beside = [&] {  // the depth at which it would not press beside the others
        double sum = 0.0;
        for (const auto& other : slots_) {
          if (other.pressed > 0.0)
            sum += other.pressed * together * own.push.dot(other.normal) *
                   std::min(s.spring.compliance, other.spring.compliance);
        }
        return sum;
      };
      if (!follow(s, own, x, way, dt, rests, beside, chases)) continue;
      if (slots_.size() == 1 && !(own.depth > 0.0))
        continue;  // alone it presses only where it is entered
      auto spring = s.spring;
      if (spring.stiffness * own.depth > spring_.force_limit)
        spring = rule_.saturated(spring, own.depth);
      rows.add(own.push, spring.compliance, spring, own.depth, own.push.dot(way) / dt, s.pressed);
      felt.push_back(&s);
      normals.push_back(own.normal);
      all.depth = std::max(all.depth, own.depth);
    }
    ph::solve(rows, [&](std::size_t i, std::size_t j) {
      return together * rows.row[i].dot(rows.row[j]) *
             std::min(rows.compliance[i], rows.compliance[j]);
    });
    const double share = 1.0 / static_cast<double>(slots_.size());  // of a contact's stiffness
    for (auto& s : slots_) {
      const auto r =
          static_cast<std::size_t>(std::find(felt.begin(), felt.end(), &s) - felt.begin());
      s.pressed = r < felt.size() ? rows.pressed[r] : 0.0;
      if (!(s.pressed > 0.0)) {
        s.bristle.let_go();
        continue;
      }
      const double k = s.spring.stiffness * share;
      all.force += rows.row[r] * s.pressed;
      all.force += s.bristle.rub(friction_, s.pressed, normals[r], way, way / dt, k,
                                 k * s.spring.settling, dt);
    }
    all.force = eased(all.force, way, dt, chases);
    speed_ = way / dt;
    asked_ = all.force;
    last_ = x;
    return all;
  }
  /// What is said of the contact that presses most, or of the first.
  [[nodiscard]] ph::explanation explain() const {
    ph::explanation e;
    const slow_slot* most = nullptr;
    for (const auto& s : slots_) {
      const bool taken = s.state != slow_slot::none;
      if (taken && (most == nullptr || s.pressed > most->pressed)) most = &s;
    }
    if (most == nullptr) {
      e.stiffness = ph::softened_by::no_surface;
      return e;
    }
    const shown here = most->surface(last_);
    const bool touched = here.covers && here.depth > 0.0;
    e.asked = most->stiffness;
    e.shown = most->spring.stiffness;
    e.depth = touched ? here.depth : 0.0;
    if (e.shown < e.asked) e.stiffness = rule_.softener(e.asked);
    if (touched && (owes_ || std::abs(most->lag) > 0.0)) e.now = ph::softened_by::news;
    if (touched && most->state == slow_slot::stale) e.now = ph::softened_by::silence;
    return e;
  }
  [[nodiscard]] const slow_slot& slot(std::size_t i) const { return slots_[i]; }
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] const vec& last() const { return last_; }
  [[nodiscard]] bool owes() const { return owes_; }

 private:
  static void worsen(ph::event& what, ph::event other) {
    what = ph::detail::worse_yet(what, other);
  }
  /// The direction `from`, turned towards `to` by `angle`.
  static vec turned(const vec& from, const vec& to, double angle) {
    return ph::turn_limited::on<d3>({.rate = 1.0}).step(from, to, angle);
  }
  static vec carried(const vec& a, const vec& from, const vec& to) {
    return ph::carry<d3>(a, from, to);
  }
  static bool ended(slow_slot& s) {
    if (s.state == slow_slot::leaving || s.state == slow_slot::stale) {
      s.state = slow_slot::none;
    } else {
      s.state = slow_slot::expected;
      s.lag = HUGE_VAL;
    }
    return false;
  }
  /// The own surface of a slot: `own` is the target's at x and becomes that which is felt. False if there is none.
  bool follow(slow_slot& s, shown& own, const vec& x, const vec& way, double dt, bool rests,
              const auto& beside, bool& chases) {
    const bool ends = s.state == slow_slot::leaving || s.state == slow_slot::stale || !own.covers;
    if (!(s.pressed > 0.0)) {
      if (ends) return ended(s);
      if (s.state == slow_slot::expected) {
        double most = beside();
        if (most > 0.0) most /= 3.0;  // also if it is damped on the way in
        s.lag = std::min(s.lag, std::max(0.0, own.depth - most));
        s.normal = s.before = own.normal;
        s.speed = pace_.speed;
        s.hurry = 1.0;
        s.state = slow_slot::there;
      } else if (rests && own.depth <= 0.0) {
        s.lag = 0.0;
        s.normal = s.before = own.normal;
      }
    }
    if (ends) {
      s.lag += (pace_.speed + std::max(0.0, -own.normal.dot(way) / dt)) * dt;
    } else {
      const double less = std::max(0.0, std::abs(s.lag) - s.speed * dt);
      s.lag = s.lag < 0.0 ? -less : less;
    }

    const vec goal = own.normal, turn = goal - s.before;
    const vec since = x - s.place;  // the way since the slot was looked at
    s.place = x;
    double round_edges = since.norm() / pace_.edge;
    vec normal = s.normal;
    if (s.kind == ph::surface_kind::smooth) {
      const bool crease = turn.norm() * pace_.edge > since.norm();
      if (turn.dot(since) < 0.0 && !crease) own.push += turn * (s.spring.settling / dt);
      normal = carried(normal, s.before, goal);
    } else if (s.kind == ph::surface_kind::faceted) {
      normal = carried(normal, s.before, turned(s.before, goal, round_edges));
      round_edges = std::max(0.0, round_edges - turn.norm());
    }
    s.before = goal;
    if (!(normal == goal)) {  // also by rounding, which the set takes for news
      chases = true;
      double angle = s.hurry * pace_.turn_rate * dt;
      if (s.kind == ph::surface_kind::flat)
        angle = std::max(angle, way.norm() / (10.0 * pace_.edge));
      normal = turned(normal, goal, angle);
      if (s.kind == ph::surface_kind::faceted) normal = turned(normal, goal, round_edges);
      own.push = carried(own.push, goal, normal);
    }
    s.normal = own.normal = normal;
    own.depth -= s.lag;
    chases = chases || std::abs(s.lag) > 0.0;
    return true;
  }
  void begin_news(bool any = false) {
    owes_ = true;
    for (auto& s : slots_) {
      s.owed = s.owed || s.pressed > 0.0;
      if ((any || s.pressed > 0.0) && s.spring.stiffness > stiffest_.stiffness)
        stiffest_ = s.spring;
    }
  }
  void adopt() {
    begin_news();
    for (auto& s : slots_) {
      if (s.state != slow_slot::none) s.spring = rule_.sampled(s.stiffness);
    }
  }
  /// While there are news to make up for, the force changes by R dt + 2K (|Δx| + τ|Δv|) at most, but
  /// along the force by −K (Δx + τ Δv).
  vec eased(const vec& wanted, const vec& way, double dt, bool chases) {
    if (!owes_ && !chased_ && !chases) return wanted;
    begin_news(!owes_ && !chased_);
    vec beside = way, change = way - speed_ * dt, middle = asked_;
    double most = pace_.force_rate * dt;
    const bool there = std::any_of(slots_.begin(), slots_.end(), [&](const slow_slot& s) {
      return s.owed && (s.state == slow_slot::there || s.state == slow_slot::expected) &&
             s.normal.dot(asked_) > 0.0;
    });
    if (there) {
      const vec n = asked_.normalized();
      const double along = n.dot(way) + stiffest_.settling / dt * n.dot(change);
      const double left = asked_.norm() - stiffest_.stiffness * along;
      middle = n * std::max(0.0, left);
      most += std::max(0.0, -left);
      beside -= n.dot(way) * n;
      change -= n.dot(change) * n;
    }
    most += 2.0 * stiffest_.stiffness * (beside.norm() + stiffest_.settling * change.norm() / dt);
    const vec step = wanted - middle;
    owes_ = step.norm() > most;
    chased_ = chases;
    if (!owes_ && !chases) {
      stiffest_ = {};
      for (auto& s : slots_) s.owed = false;
    }
    return owes_ ? vec(middle + step * (most / step.norm())) : wanted;
  }

  ph::stick_slip::on<d3> friction_;
  std::vector<slow_slot> slots_;
  ph::proxy_spring::at<double> rule_;
  ph::pursuit pace_;
  ph::proxy_spring spring_;
  ph::sampled_spring<double> stiffest_{};
  vec last_ = vec::Zero(), speed_ = vec::Zero(), asked_ = vec::Zero();
  bool owes_ = false, chased_ = false, refused_ = false, placed_ = false;
};

plane any_plane(ph::laws::samples& draw, const vec& x) {
  const vec n = draw.direction<d3>(), p = x + n * (1e-3 * draw.number<double>());
  return {p, n, 600.0 + 500.0 * draw.number<double>()};
}
roof any_roof(ph::laws::samples& draw, const vec& x) {
  roof r;
  const vec l = draw.direction<d3>(), n = l + 0.8 * draw.vector<d3>();
  r.left = l;
  r.right = n;
  r.point = vec(x + l * (1.5e-3 * draw.number<double>()) + 1e-3 * draw.vector<d3>());
  r.stiffness = 600.0 + 500.0 * draw.number<double>();
  r.size = 0.01;
  return r;
}
bowl any_bowl(ph::laws::samples& draw, const vec& x) {
  const vec n = draw.direction<d3>();
  bowl b;
  b.point = vec(x + n * (1e-3 * draw.number<double>()) + 2e-3 * draw.vector<d3>());
  b.normal = n;
  b.tangent = d3::orthogonal(n);
  b.curvature = 40.0 * draw.number<double>();
  b.cross_curvature = 40.0 * draw.number<double>();
  b.stiffness = 600.0 + 500.0 * draw.number<double>();
  b.thickness = 0.02;
  b.reach = 0.012;
  return b;
}

/// How often something happened in a comparison of both.
struct often {
  int pressed = 0, several = 0, owed = 0, stale = 0, saturated = 0;
};

/// A set of so many slots of each kind, shown whatever there may be for two seconds, and computed twice.
template <int Planes, int Roofs, int Bowls>
void compare(std::uint64_t seed, const ph::proxy_spring& spring, ph::pursuit pace, often& all,
             const ph::stick_slip& rough = {0.0, 0.0}) {
  constexpr int count = Planes + Roofs + Bowls;
  auto port = [&] {
    if constexpr (Roofs > 0) {
      return ph::passive_port{d3{},
                              ph::contact_set{spring, pace, rough, ph::slots<plane, Planes>{},
                                              ph::slots<roof, Roofs>{}, ph::slots<bowl, Bowls>{}},
                              ph::no_observer{}, ph::no_bound{}, thesis_loop};
    } else {  // without friction
      return ph::passive_port{d3{}, ph::contact_set{spring, pace, ph::slots<plane, Planes>{}},
                              ph::no_observer{}, ph::no_bound{}, thesis_loop};
    }
  }();
  slow_set slow(count, spring, pace, rough);
  ph::laws::samples draw(seed);
  const auto one_in = [&draw](unsigned many) { return draw.bits() % many == 0; };
  const auto told = [&](int i, int first, auto surface, auto any, const vec& x) {
    const auto& slot = port.source().template slot<decltype(surface)>(i - first);
    const auto next = slot.taken() && one_in(3) ? slot.target() : any(draw, x);
    REQUIRE(port.source().update(i - first, next));
    slow.update(i, next);
  };
  vec x = vec::Zero(), goal = vec::Zero();
  double hurry = 0.01;
  for (int n = 0; n < 2000; ++n) {
    if (one_in(50)) goal = 3e-3 * draw.vector<d3>();
    if (one_in(100)) hurry = one_in(3) ? 0.0 : 0.02 + 0.02 * draw.number<double>();
    if (n % 500 == 499) goal = 0.06 * draw.direction<d3>(), hurry = 0.01;  // out of reach of all
    const int i = static_cast<int>(draw.bits() % count);
    if (one_in(40)) {
      if (one_in(4)) {
        slow.release(i);
        if (i < Planes) port.source().template release<plane>(i);
        if constexpr (Roofs > 0) {
          if (i >= Planes + Roofs)
            port.source().template release<bowl>(i - Planes - Roofs);
          else if (i >= Planes)
            port.source().template release<roof>(i - Planes);
        }
      } else if (i < Planes) {
        told(i, 0, plane{}, any_plane, x);
      } else if constexpr (Roofs > 0) {
        if (i < Planes + Roofs)
          told(i, Planes, roof{}, any_roof, x);
        else
          told(i, Planes + Roofs, bowl{}, any_bowl, x);
      }
    }
    if (one_in(300)) {
      REQUIRE_FALSE(port.source().update(0, plane{}));
      slow.refuse();
    }
    if (one_in(400)) {
      pace.turn_rate = one_in(2) ? 2.0 : 6.0;
      REQUIRE_FALSE(port.set(pace));
      slow.set(pace);
    }
    const double dt = one_in(10) ? 0.6e-3 : T;
    x += hurry * dt / T * (goal - x);
    const auto wanted = slow.tick(x, dt);
    const auto got = port.tick(x, ph::seconds{dt});
    CAPTURE(seed, n, i, dt);
    REQUIRE((got.force - wanted.force).norm() <= 1e-8);
    REQUIRE(std::abs(got.depth - wanted.depth) <= 1e-11);
    REQUIRE(got.what == wanted.what);
    const auto why = slow.explain();
    ph::explanation said;
    port.source().explain(said, x, T, 0);
    REQUIRE(said.asked == why.asked);
    REQUIRE(said.shown == Approx(why.shown));
    REQUIRE(said.stiffness == why.stiffness);
    REQUIRE(said.depth == why.depth);
    REQUIRE(said.now == why.now);
    if (one_in(700)) {
      port.reset();
      slow = slow_set(count, spring, pace, rough);
    }
    int pressed = 0;
    for (std::size_t k = 0; k < slow.size(); ++k) pressed += slow.slot(k).pressed > 0.0 ? 1 : 0;
    all.pressed += pressed > 0 ? 1 : 0;
    all.several += pressed > 1 ? 1 : 0;
    all.owed += slow.owes() ? 1 : 0;
    all.stale += wanted.what == ph::event::stale_target ? 1 : 0;
    all.saturated += wanted.force.norm() > spring.force_limit ? 1 : 0;
  }
}

}  // namespace

TEST_CASE("a set presses as its slow and plain definition does, whatever it is shown",
          "[contact_set]") {
  often all;
  const ph::proxy_spring spring{.mass = 0.1}, weak{.mass = 0.1, .force_limit = 0.8};
  const ph::pursuit usual{}, forgets{.speed = 0.02, .catch_up = 0.1, .stale_after = 0.15};
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    compare<1, 0, 0>(seed, spring, usual, all);
    compare<3, 0, 0>(seed, spring, usual, all);
    compare<2, 1, 1>(seed, spring, usual, all);
    compare<2, 1, 1>(seed, spring, usual, all, {});
    compare<2, 1, 1>(seed, weak, forgets, all, {});
    compare<3, 2, 2>(seed, spring, usual, all);  // more than four: what is far away sleeps
  }
  CHECK(all.pressed > 2000);
  CHECK(all.several > 500);
  CHECK(all.owed > 100);
  CHECK(all.stale > 100);
  CHECK(all.saturated > 20);
}

TEST_CASE("a felt surface is a number where its depth and the square of its push are",
          "[contact_set]") {
  const auto is_finite = [](double depth, double push) {
    return ph::felt_surface<d3>{.normal = {0, 0, 1}, .push = {0, push, 0}, .depth = depth}
        .is_finite();
  };
  CHECK(is_finite(-1e-3, 1.0));
  CHECK(is_finite(-1.5e308, 1.25e154));  // far outside, and it leans
  CHECK_FALSE(is_finite(-1e-3, 1.5e154));
  for (const double none : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    CHECK_FALSE(is_finite(none, 1.0));
    CHECK_FALSE(is_finite(-1e-3, none));
  }
}

TEST_CASE("what leaves a surface as it begins to recede by itself is let go at once",
          "[contact_set]") {
  // News is eased and motion never is, be it in the tick in which the surface goes stale, or is left over its edge.
  const vec inside(0, 0, -2e-3), above(0, 0, 1e-3), beside(0.02, 0, 1e-3);
  const auto left = [&](int ticks, const vec& to) {
    auto port =
        ph::passive_port{d3{},
                         ph::contact_set{ph::proxy_spring{.mass = 0.1},
                                         ph::pursuit{.stale_after = 0.0995}, ph::slots<roof, 2>{}},
                         ph::no_observer{}, ph::no_bound{}, thesis_loop};
    roof flat;
    flat.stiffness = 1000.0;
    flat.size = 0.01;
    REQUIRE(port.source().update(0, flat));
    (void)port.tick(above, 1ms);
    double before = 0.0;
    for (int n = 1; n < ticks; ++n) before = port.tick(inside, 1ms).force.z();
    CHECK(before > 1.9);  // N
    return port.tick(to, 1ms).force.norm();
  };
  for (const int late : {-1, 0, 1}) CHECK(left(99 + late, above) == 0.0);
  CHECK(left(50, beside) == 0.0);
}
