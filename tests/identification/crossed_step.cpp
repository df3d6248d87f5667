// SPDX-License-Identifier: BSD-3-Clause
// dual_ledger with steps that are known better where they are crossed: it never says more than what has flowed in, the
// sequence that meets it, and what a lost sample, set() and reset() leave of it.
#include "support/catch.hpp"
#include "support/scenes.hpp"
#include <passive_haptics/identification/crossed_step.hpp>
#include <passive_haptics/laws.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace sim = ph::simulation;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double T = 1e-3;

/// A device, what is told of it, and the tick that the motion is written in.
struct truth {
  double b = 0.05, c = 0.15, p = 5e-6, q = 50e-6, m = 0.5, hand = 1.0;
  double quiet = std::numeric_limits<double>::infinity();
  [[nodiscard]] ph::crossed_ledger told() const {
    return {.damping = {.coefficient = b, .coulomb = c, .presliding = p},
            .quantum = {
                .quantum = q * (1.0 + 1e-7), .mass = m, .hand_force = hand, .acceleration = quiet}};
  }
};

// ------------------------------------------------------------------------------------ a search for energy
template <class P>
struct move {
  using vec = typename ph::space<double, P::dof>::vector;
  vec force = ph::space<double, P::dof>::zero();
  std::array<vec, 2> pushed{force,
                            force};  ///< of what else pushes, in both halves of the tick, |.| ≤ 1
  vec noise = force;                 ///< where in the box, if it is noise
  double dt = T;
};

template <class P>
struct sequence {
  using real = ph::space<double, P::dof>;
  using vec = typename real::vector;
  truth is{};
  bool noisy = false;
  vec start = real::zero(), speed = real::zero(), spring = real::zero();
  std::vector<move<P>> moves;

  /// The least of what has flowed in and what the springs hold, less what the ledger says and began with [J]; or only
  /// from when it was refuted on, and 1 J if it never was.
  [[nodiscard]] double spare(const ph::crossed_ledger& told, bool refuted = false) const {
    ph::part_at<ph::crossed_ledger, P> ledger(told);
    const double reserve = -static_cast<double>(ledger.value());
    vec x = start, v = speed, z = spring;
    double E = 0.0, least = 1.0;
    const auto shown = [&](const move<P>& k) {
      vec at = x;
      for (int i = 0; i < P::dof; ++i) {
        double& a = real::component(at, i);
        a = noisy ? a - 0.5 * is.q * real::component(k.noise, i) : is.q * std::floor(a / is.q);
      }
      return at;
    };
    vec before = shown(moves.front());
    for (const move<P>& k : moves) {
      const vec from = x;
      const double others = is.hand + 2.0 * is.b / k.dt * is.q;  // less than the ledger allows for
      for (const vec& push : k.pushed) {
        const double h = k.dt / 2.0;
        vec a = (k.force + others * push) / is.m;
        if (const double size = real::norm(a); size > is.quiet) a = a * (is.quiet / size);
        const vec way = v * h + a * (0.5 * h * h);
        v = v + a * h;
        x = x + way;
        E += is.b * real::dot(way, way) / h;
        const vec wound = z + way;
        const double far = real::norm(wound);
        const vec held = far > is.p ? vec(wound * (is.p / far)) : wound;
        E += is.c * real::norm(vec(wound - held));
        z = held;
      }
      const vec now = shown(k), seen = now - before;
      typename P::effort force = P::zero();
      typename P::motion motion = P::zero();
      for (int i = 0; i < P::dof; ++i) {
        P::component(force, i) = static_cast<typename P::scalar>(real::component(k.force, i));
        P::component(motion, i) = static_cast<typename P::scalar>(real::component(seen, i));
      }
      before = now;
      E -= real::dot(k.force, vec(x - from));
      REQUIRE(ledger.update(motion, force, static_cast<typename P::scalar>(k.dt)));
      const double springs = is.p > 0.0 ? 0.5 * is.c / is.p * real::dot(z, z) : 0.0;
      if (refuted && !ledger.steps().refuted()) continue;
      least = std::min(least, E + springs - static_cast<double>(ledger.value()) - reserve);
    }
    return least;
  }
};

template <class P>
typename sequence<P>::vec drawn(sim::random_source& random, bool to_the_end) {
  using real = ph::space<double, P::dof>;
  typename real::vector v = real::zero();
  for (int i = 0; i < P::dof; ++i) real::component(v, i) = random.uniform(-1.0, 1.0);
  const double size = real::norm(v);
  return size > 0.0 && (to_the_end || size > 1.0) ? typename real::vector(v / size) : v;
}
template <class P>
move<P> drawn_move(sim::random_source& random, double force) {
  move<P> k;
  const bool none = random.chance(0.2);
  k.force = drawn<P>(random, random.chance(0.3)) * (none ? 0.0 : force);
  for (auto& push : k.pushed) push = drawn<P>(random, random.chance(0.7));
  for (int i = 0; i < P::dof; ++i) {
    ph::space<double, P::dof>::component(k.noise, i) = random.chance(0.5) ? 1.0 : -1.0;
  }
  k.dt = random.chance(0.6) ? T : T * random.uniform(0.2, 1.2);
  return k;
}

struct climbed {
  double least = 1.0;
  int below = 0;    ///< climbs that end below zero
  int refuted = 0;  ///< climbs that end with a ledger that was refuted, if those are looked for
};
/// Climbs from random sequences to worse ones. `lie` turns what is true into what is told.
template <class P>
climbed search(int climbs, int steps, double rounded, auto lie, bool refuted = false) {
  climbed found;
  for (int run = 0; run < climbs; ++run) {
    sim::random_source random(static_cast<std::uint64_t>(run) + 1);
    sequence<P> best;
    best.noisy = random.chance(0.25);
    best.is.q = std::pow(10.0, random.uniform(-5.2, -4.0));
    best.is.c = std::pow(10.0, random.uniform(-1.5, -0.3));
    best.is.p = random.chance(0.4) ? 0.0 : best.is.q * std::pow(10.0, random.uniform(-1.0, 0.3));
    best.is.b = std::pow(10.0, random.uniform(-2.3, -1.0));
    best.is.m = std::pow(10.0, random.uniform(-1.3, 0.0));
    const double faster = refuted ? 1.3 : 0.0;
    const double a = best.is.q / (T * T) * std::pow(10.0, random.uniform(-2.0, -0.3) + faster);
    best.is.hand = a * best.is.m;
    if (random.chance(0.4)) best.is.quiet = a;
    const double force = random.chance(0.5) ? 4.0 * best.is.c : best.is.hand;
    best.start = drawn<P>(random, false) * best.is.q;
    best.moves.resize(static_cast<std::size_t>(random.uniform(6.0, 30.0)));
    for (auto& k : best.moves) k = drawn_move<P>(random, force);
    const ph::crossed_ledger told = lie(best.is).told();
    double worst = best.spare(told, refuted);
    for (int n = 0; n < steps; ++n) {
      sequence<P> next = best;
      const auto any = [&] {
        return static_cast<std::size_t>(random.uniform(0.0, 0.999) * double(next.moves.size()));
      };
      for (int j = 0; j < 2; ++j) {
        auto& k = next.moves[any()];
        const double which = random.uniform(0.0, 1.0);
        if (which < 0.2)
          k = drawn_move<P>(random, force);
        else if (which < 0.4)
          k = next.moves[any()];
        else if (which < 0.6)
          k.force = k.force + drawn<P>(random, false) * (0.3 * force);
        else if (which < 0.8)
          k.pushed[random.chance(0.5) ? 1 : 0] = drawn<P>(random, true);
        else if (which < 0.9)
          next.speed = next.speed + drawn<P>(random, false) * (0.1 * best.is.q / T);
        else
          next.spring = drawn<P>(random, true) * best.is.p;
      }
      if (const double v = next.spare(told, refuted); v < worst) {
        worst = v;
        best = next;
      }
    }
    found.least = std::min(found.least, worst);
    found.below += worst < -rounded ? 1 : 0;
    found.refuted += worst < 1.0 ? 1 : 0;
  }
  return found;
}
constexpr auto truly = [](truth t) { return t; };

}  // namespace

TEST_CASE("dual_ledger with crossed steps obeys the laws of ledgers", "[ledger][crossed]") {
  // What is given back is of earlier ticks, so no tick is a limit by itself: the searches below are in its place.
  const auto told = truth{}.told();
  CHECK(ph::laws::forfeit_never_credits<d1>(told));
  CHECK(ph::laws::books_numbers_only<d1>(told));
  CHECK(ph::laws::reset_forgets<d1>(told));
  const auto nothing_back = truth{.hand = 1e6}.told();
  const auto verdict = ph::laws::all<ph::crossed_ledger, d1>(nothing_back);
  CHECK(std::string(verdict ? "" : verdict.broken).empty());
  const auto in_space = ph::laws::all<ph::crossed_ledger, f3>(nothing_back);
  CHECK(std::string(in_space ? "" : in_space.broken).empty());
}

TEST_CASE("dual_ledger with crossed steps never says more than has flowed in",
          "[ledger][crossed]") {
  CHECK(search<d1>(120, 400, 0.0, truly).least >= 0.0);
  CHECK(search<d2>(40, 300, 0.0, truly).least >= 0.0);
  const auto in_float = search<f1>(60, 300, 0.0, truly);
  CAPTURE(in_float.least);
  CHECK(in_float.least >= -1e-10);
  // The controls: a finer step, or more friction, than there is.
  const auto finer = [](truth t) { return t.q *= 0.9, t; };
  const auto rougher = [](truth t) { return t.c *= 1.1, t; };
  CHECK(search<d1>(40, 400, 1e-9, finer).below > 10);
  CHECK(search<d1>(40, 400, 1e-9, rougher).below > 10);
  CHECK(search<d2>(20, 300, 1e-9, finer).below > 5);
  CHECK(search<f1>(20, 300, 1e-9, finer).below > 5);
}

TEST_CASE("a crossing that is refuted leaves a ledger that counts on no mass",
          "[ledger][crossed]") {
  // Mass, hand and acceleration are told far wrong, and what was given back on them comes to be taken back.
  const auto lighter = [](truth t) { return t.m *= 30.0, t.quiet /= 30.0, t; };
  const auto weaker = [](truth t) { return t.hand /= 30.0, t.quiet /= 30.0, t; };
  const auto quieter = [](truth t) { return t.quiet = t.hand / t.m / 30.0, t; };
  const auto apart = [](auto found, int climbs) {
    CAPTURE(found.least, climbs);
    CHECK(found.refuted > climbs / 2);
    CHECK(found.least >= 0.0);
  };
  apart(search<d1>(40, 250, 0.0, lighter, true), 40);
  apart(search<d1>(40, 250, 0.0, weaker, true), 40);
  apart(search<d1>(40, 250, 0.0, quieter, true), 40);
  apart(search<d2>(20, 200, 0.0, lighter, true), 20);
  // The control: a step that is told too fine loses afterwards, too.
  const auto finer = [&](truth t) { return t = lighter(t), t.q *= 0.9, t; };
  CHECK(search<d1>(40, 250, 1e-9, finer, true).below > 10);
}

namespace {
/// The worst that a device can do: it crosses, runs to the far end of the step as fast as it may turn round, and comes
/// back to the near end. What has flowed in less what the ledger says [J]; with `steps`, after it has then been thrown
/// forward by a step and back by so many.
double tight(const truth& is, const truth& told, int steps = 0) {
  constexpr double s = 0.3;  // the force that presses from the crossing on [N]
  ph::part_at<ph::crossed_ledger, d1> ledger(told.told());
  const auto most = [&is](double f) { return std::min((is.hand + f) / is.m, is.quiet); };
  const auto shown = [&is](double x) { return is.q * (std::floor(x / is.q) + 0.5); };
  double x = -1e-12, E = 0.0, worst = 1.0, before = shown(x), back = 0.0;
  double v = (is.q - 2e-12 + 1.5 * most(0.0) * T * T + 0.5 * most(s) * T * T) / (2.0 * T);
  for (int n = 0, left = 0; n < 14; ++n) {
    double a = n == 0 ? -most(0.0) : -most(s);
    if (n >= 2) {
      for (int ticks = 1; left == 0 && ticks <= 10; ++ticks) {
        back = 2.0 * (1e-10 - x - v * ticks * T) / (ticks * ticks * T * T);
        if (std::abs(back) <= most(s)) left = ticks;
      }
      a = back;
    }
    const double f = n == 0 ? 0.0 : -s, way = v * T + 0.5 * a * T * T;
    v += a * T;
    x += way;
    E -= f * way;
    REQUIRE(ledger.update(shown(x) - before, f, T));
    before = shown(x);
    if (n >= 2) worst = std::min(worst, E - ledger.value());
    if (n >= 2 && --left == 0) break;
  }
  for (const double way : {is.q, -steps * is.q}) {
    if (steps == 0) break;
    x += way;
    E += s * way;
    REQUIRE(ledger.update(shown(x) - before, -s, T));
    before = shown(x);
    worst = E - ledger.value();
  }
  CHECK(ledger.steps().refuted() == (steps > 1));
  return worst;
}
}  // namespace

TEST_CASE(
    "the charge of a crossing is met by the worst motion, so mass, force and acceleration matter",
    "[ledger][crossed]") {
  for (const double part : {0.5, 0.6}) {
    const truth base{.b = 1e-9, .c = 0.0, .p = 0.0, .q = 60e-6, .m = 0.25};
    truth quiet = base, pushed = base;
    quiet.hand = 100.0;
    quiet.quiet = part * base.q / (T * T);
    pushed.hand = quiet.quiet * base.m;
    CAPTURE(part);
    CHECK_THAT(tight(quiet, quiet), WithinAbs(0.0, 1e-10));  // of 5 µJ
    CHECK_THAT(tight(pushed, pushed), WithinAbs(0.0, 1e-7));
    CHECK(tight(quiet, quiet) >= 0.0);
    CHECK(tight(pushed, pushed) >= 0.0);
    truth told = quiet;
    told.quiet *= 0.9;
    CHECK(tight(quiet, told) < -3e-7);
    told = pushed;
    told.hand *= 0.9;
    CHECK(tight(pushed, told) < -3e-7);
    told = pushed;
    told.m *= 1.1;
    CHECK(tight(pushed, told) < -3e-7);
    CHECK(tight(pushed, told, 1) < -3e-7);  // nothing to be seen yet
    CHECK(tight(pushed, told, 4) >= 0.0);   // refuted, and what was given on it is taken back
  }
}

TEMPLATE_TEST_CASE("what is owed of a crossing comes back sample by sample, until it is lost",
                   "[ledger][crossed]", d1, f1) {
  using scalar = typename TestType::scalar;
  const auto q = scalar(64e-6), dt = scalar(1e-3);
  const truth still{.c = 0.0, .p = 0.0, .q = 64e-6, .m = 1e6};  // it hardly accelerates
  ph::part_at<ph::crossed_ledger, TestType> ledger(still.told());
  const auto value = [&ledger] { return static_cast<double>(ledger.value()); };
  REQUIRE(ledger.update(q, scalar(0), dt));
  const double start = value();
  for (int J = 1; J <= 12; ++J) {  // at rest beyond the edge it is q/(J + 1) deep at most
    REQUIRE(ledger.update(scalar(0), scalar(-1), dt));
    CAPTURE(J);
    CHECK_THAT(value() - start, WithinAbs(-64e-6 / (J + 1), 2e-9));
  }
  const double known = value();
  SECTION("it is known best where it turns back") {
    REQUIRE(ledger.update(-q, scalar(-1), dt));
    CHECK_THAT(value() - start,
               WithinAbs(-64e-6, 2e-9));  // q f of the way, and nothing for the step
  }
  SECTION("a charge of a later tick is half a step") {
    REQUIRE(ledger.update(scalar(0), scalar(-2), dt));
    CHECK_THAT(value() - known,
               WithinAbs(-64e-6, 0.5e-6));  // ½ q f now, and ½ q f that may still come
  }
  SECTION("a motion that mass and hand do not admit takes all back") {
    REQUIRE(ledger.update(-q * scalar(3), scalar(-1), dt));
    CHECK_THAT(value() - start, WithinAbs(-4 * 64e-6, 1e-6));  // 3 q f of the way, q f for the step
  }
  SECTION("a lost sample") {
    ledger.forfeit(scalar(-1), dt);
    const double left = value();
    for (int i = 0; i < 5; ++i) REQUIRE(ledger.update(scalar(0), scalar(0), dt));
    CHECK(value() <= left);
  }
  SECTION("new parameters") {
    ledger.set(still.told());
    const double left = value();
    for (int i = 0; i < 5; ++i) REQUIRE(ledger.update(scalar(0), scalar(-1), dt));
    CHECK(value() <= left);
  }
  SECTION("a new start") {
    ledger.reset();
    CHECK(value() == 0.0);
    for (int i = 0; i < 5; ++i) REQUIRE(ledger.update(scalar(0), scalar(-1), dt));
    CHECK_THAT(value(), WithinAbs(-64e-6, 1e-9));
  }
}

TEST_CASE("crossed_step names what it refuses", "[crossed]") {
  const auto refused = [](const truth& t) {
    const auto fault = t.told().check();
    return std::string(fault ? fault.parameter : "");
  };
  CHECK(refused({}).empty());
  CHECK(refused({.q = -1e-6}) == "quantum");
  CHECK(refused({.m = 0.0}) == "mass");
  CHECK(refused({.hand = -1.0}) == "hand_force");
  CHECK(refused({.quiet = 0.0}) == "acceleration");
  static_assert(ph::crossed_ledger::passivity == ph::guarantee::conditional);
  static_assert(ph::dual_ledger::passivity == ph::guarantee::strict);
}

namespace {
/// A force that colludes with what else pushes, through a port in a loop so many ticks late.
template <int Late>
double least_at_port(const truth& is, const truth& told, int runs) {
  using limits = std::conditional_t<Late == 0, ph::loop_limits, ph::late_loop_limits<Late>>;
  double least = 1.0;
  for (int run = 0; run < runs; ++run) {
    sim::random_source random(static_cast<std::uint64_t>(run) + 1);
    ph::passive_port port{d1{}, ph::given_force{}, told.told(),
                          ph::reachable_bound{.mass = told.m, .hand_force = told.hand},
                          limits{.longest_tick = 1.2 * T, .watchdog = 1.2 * T}};
    double x = random.uniform(0.0, is.q), v = 0.0, z = random.uniform(-1.0, 1.0) * is.p, E = 0.0;
    std::array<double, Late + 1> coming{};
    double push = 1.0, want = 0.0, dt = T;
    const double jumps = random.uniform(0.02, 0.5), size = random.uniform(0.2, 3.0);
    for (int n = 0; n < 200; ++n) {
      const double step = is.q * std::floor(x / is.q);
      if (random.chance(jumps)) want = random.uniform(-1.0, 1.0) * size;
      if (random.chance(0.3)) want = v > 0.0 ? size : -size;
      const bool lost = random.chance(0.01);
      const auto out = port.tick(lost ? std::nan("") : step, ph::seconds{dt}, want);
      for (std::size_t i = Late; i > 0; --i) coming[i] = coming[i - 1];
      coming[0] = out.force;
      dt = random.chance(0.7) ? T : T * random.uniform(0.2, 1.2);
      if (random.chance(0.01)) dt = T * random.uniform(1.2, 4.0);  // the watchdog drops the force
      const double others = is.hand + 2.0 * is.b / dt * is.q;
      double left = dt;
      while (left > 0.0) {
        const bool dropped = dt - left >= 1.2 * T;
        const double f = dropped ? 0.0 : coming[Late], h = dropped ? left : std::min(left, 0.6 * T);
        left = left - h > 1e-9 ? left - h : 0.0;
        if (random.chance(0.2)) push = random.uniform(-1.0, 1.0) > 0.0 ? 1.0 : -1.0;
        if (random.chance(0.2)) push = v > 0.0 ? -1.0 : 1.0;
        const double a = (f + others * push) / is.m;
        const double way = v * h + 0.5 * a * h * h, wound = z + way;
        v += a * h;
        x += way;
        z = std::clamp(wound, -is.p, is.p);
        E += is.b * way * way / h + is.c * std::abs(wound - z) - f * way;
      }
      const double springs = is.p > 0.0 ? 0.5 * is.c / is.p * z * z : 0.0;
      least = std::min(least, E + springs + 0.5 * is.c * is.p);
    }
  }
  return least;
}
}  // namespace

TEST_CASE("a port with crossed steps gives out no energy to a hand and a force that collude",
          "[ledger][crossed]") {
  for (const double p : {0.0, 5e-6, 40e-6}) {
    for (const double hand : {0.5, 5.0}) {
      const truth is{.p = p, .hand = hand};
      truth told = is;
      CAPTURE(p, hand);
      CHECK(least_at_port<0>(is, told, 400) >= 0.0);
      CHECK(least_at_port<1>(is, told, 400) >= 0.0);
      told.c *= 2.0;  // the control
      CHECK(least_at_port<0>(is, told, 400) < -1e-6);
    }
  }
}
