// SPDX-License-Identifier: BSD-3-Clause
// forgiving: what it lends, when and how much in all; and that no single fault takes a wall away.
#include "../bench/faults/faults.hpp"
#include "force_bound/upkeep.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/energy_observer/forgiving.hpp>
#include <passive_haptics/energy_observer/quantised_energy.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double A = 0.02, T = 1e-3;
constexpr ph::forgiving mild{ph::reduced_energy{.damping = 0.1}, A};

void rest(auto& ledger, double seconds) {
  bool booked = true;
  for (int n = 0; n < std::lround(seconds / T); ++n) booked &= ledger.update(0.0, 0.0, T);
  REQUIRE(booked);
}

}  // namespace

TEST_CASE("a forgiving ledger is its ledger where nothing happens", "[forgiving][law]") {
  CHECK(broken_laws<d1, f3>(ph::forgiving{thesis_ledger(), 0.0}).empty());
  const ph::quantised_energy steps{.damping = {0.03}, .quantum = 1e-5};
  CHECK(broken_laws<d1>(ph::forgiving{steps, 0.0}) == broken_laws<d1>(steps));
  CHECK_FALSE(broken_laws<d1>(mild).empty());  // it does overstate, by what it lends
  auto forgiving = at<d1>(mild);
  auto strict = at<d1>(mild.ledger);
  ph::laws::samples random(3);
  bool same = true;
  for (int n = 0; n < 20000; ++n) {  // moving in and out, never in debt
    const double dx = 1e-4 * random.number<double>(), f = dx < 0.0 ? -dx * 1e3 : dx * 1e3;
    same &= forgiving.update(dx, -f, T) == strict.update(dx, -f, T);
    if (strict.value() < 0.0) break;
    same &= forgiving.value() == strict.value();
  }
  CHECK(same);
  static_assert(decltype(mild)::passivity == ph::guarantee::conditional);
  CHECK(std::string(ph::forgiving{ph::reduced_energy{.damping = 0.1}, -1.0}.check().parameter) ==
        "amends");
  CHECK(std::string(ph::forgiving{ph::reduced_energy{.damping = -0.1}, 1.0}.check().parameter) !=
        "amends");
}

TEST_CASE("after a fault a debt is written off and A is lent within half a second", "[forgiving]") {
  auto ledger = at<d1>(mild);
  REQUIRE(ledger.update(4e-3, 9.0, T));  // a jump against 9 N
  const double debt = ledger.value();
  CHECK(debt < -0.03);
  rest(ledger, 0.095);
  CHECK(ledger.value() == debt);
  rest(ledger, 0.01);
  CHECK(ledger.value() >= 0.0);
  rest(ledger, 0.25);
  CHECK_THAT(ledger.value(), WithinRel(0.5 * A, 0.05));
  rest(ledger, 0.3);
  CHECK_THAT(ledger.value(), WithinRel(A, 1e-9));
  rest(ledger, 20.0);
  CHECK(ledger.value() <= A);  // once

  auto rich = at<d1>(mild);
  REQUIRE(rich.update(-2.0 * A / 9.0, 9.0, T));
  const double owned = rich.value();
  rich.disturbed();
  rest(rich, 1.0);
  CHECK(rich.value() == owned);  // who has credit gets none

  // Who had it at the fault and has spent it since is lent after the pause.
  for (const double loan : {A, 1.5 * A}) {
    auto spent = at<d1>(ph::forgiving{ph::reduced_energy{.damping = 0.1, .loan = loan}, A});
    spent.disturbed();
    REQUIRE(spent.update((loan - 0.25 * A) / 9.0, 9.0, T));
    rest(spent, 1.0);
    CHECK_THAT(spent.value(), WithinRel(A, 1e-9));
  }
}

TEST_CASE("who has just A lacks nothing, whatever is cut, and who has less lacks it",
          "[forgiving]") {
  const auto says = [](double spent) {
    auto ledger = at<d1>(ph::forgiving{ph::reduced_energy{.damping = 0.1, .loan = A}, A});
    ledger.disturbed();  // who has A is lent nothing at once
    rest(ledger, 0.01);
    REQUIRE(ledger.update(spent / 8.0, 8.0, T));
    return ledger.tells(ph::event::nominal, true);
  };
  CHECK(says(0.0) == ph::event::nominal);
  CHECK(says(1e-6 * A) == ph::event::wall_lost);
}

TEST_CASE(
    "a loop whose every tick is late, or that is in debt again and again, is lent next to nothing",
    "[forgiving]") {
  auto late = at<d1>(mild);
  for (int n = 0; n < 60000; ++n) {
    (void)late.update(late.value() > 0.0 ? A / 9.0 : 0.0, 9.0, T);  // takes it all at once
    late.disturbed();
  }
  CHECK(late.value() <= 0.0);  // once, and never again
  auto loses = at<d1>(mild);
  loses.disturbed();
  double lent = 0.0, last = 0.0;
  for (int n = 0; n < 60000; ++n) {  // takes what there is, and a little more
    const double before = loses.value();
    (void)loses.update(before > 0.5 * A ? before / 9.0 + 1e-4 : 0.0, 9.0, T);
    lent += std::max(0.0, loses.value() - std::max(0.0, before));
    last = before;
  }
  CHECK(last <= A);
  CHECK(lent > 3.0 * A);
  CHECK(lent < 12.0 * A);
}

TEST_CASE("a fault just when the pause ends does not double it, for amends have not begun",
          "[forgiving]") {
  constexpr double tick = 0.05;  // two of them are the first pause to the bit
  const auto lent_after = [](int before, int after) {
    auto ledger = at<d1>(ph::forgiving{ph::reduced_energy{.damping = 0.1, .loan = 2.0 * A}, A});
    ledger.disturbed();  // there is credit, so nothing is lent at once
    for (int n = 0; n < before; ++n) (void)ledger.update(0.0, 0.0, tick);
    ledger.disturbed();
    REQUIRE(ledger.update(1.5 * A / 9.0, 9.0, tick));
    const double left = ledger.value();
    REQUIRE(left < A);
    for (int n = 1; n < after; ++n) (void)ledger.update(0.0, 0.0, tick);
    return ledger.value() - left;
  };
  CHECK(lent_after(2, 2) == 0.0);
  CHECK_THAT(lent_after(2, 3), WithinRel(A * tick / 0.5, 1e-9));
  CHECK(lent_after(3, 4) == 0.0);  // a tick later they have
  CHECK(lent_after(3, 5) > 0.0);
}

TEST_CASE("whenever the faults come, no more is lent than the promise says", "[forgiving]") {
  ph::laws::samples random(11);
  double worst = 0.0;
  const auto lent_by = [&worst](double seconds, const auto& is_fault) {
    auto ledger = at<d1>(mild);
    double lent = 0.0, quiet = 0.0, excess = -1e9;
    for (int n = 0; n < std::lround(seconds / T); ++n) {
      const double before = ledger.value();
      const bool fault = is_fault(quiet);
      quiet = fault ? 0.0 : quiet + T;
      if (fault) ledger.disturbed();
      (void)ledger.update(0.0, 0.0, T);
      lent += ledger.value() - before;
      if (ledger.value() > 0.99 * A) {  // spent at once: a fault of its own is not needed for that
        (void)ledger.update(ledger.value() * (1.0 - 1e-9) / 9.0 * (1.0 - 1e-3), 9.0, T);
      }
      const double t = (n + 1) * T;
      excess = std::max(excess, lent / A - (8.0 + t / 2.5));
      worst = std::max(worst, lent / A / (8.0 + t / 2.5));
    }
    return excess;
  };
  for (const double every : {0.01, 0.1, 0.3, 0.61, 0.7, 1.0, 1.7, 3.0, 10.0, 13.0}) {
    CAPTURE(every);
    CHECK(lent_by(120.0, [every](double quiet) { return quiet >= every; }) <= 0.0);
  }
  for (int patience = 1; patience <= 8;
       ++patience) {  // amends in a row, then quiet until all is forgotten
    int got = 0;
    double pause = 0.1;
    CAPTURE(patience);
    CHECK(lent_by(200.0, [&](double quiet) {
            if (got < patience ? quiet < pause + 0.5 : quiet < std::max(10.0, pause + 0.5) + 0.01) {
              return false;
            }
            pause = got < patience ? pause * 2.0 : 0.1;
            got = got < patience ? got + 1 : 0;
            return true;
          }) <= 0.0);
  }
  for (int i = 0; i < 20; ++i) {
    const double often = std::pow(10.0, -3.0 * std::abs(random.number<double>()));
    CHECK(lent_by(60.0, [&](double) { return std::abs(random.number<double>()) < 0.05 * often; }) <=
          0.0);
  }
  CHECK(worst > 0.4);  // it is not far from what can be had
}

TEST_CASE("a fault that the port tells of is forgiven at once, and once in a row of them",
          "[forgiving]") {
  auto ledger = at<d1>(mild);
  (void)ledger.update(0.05, 9.0, T);  // a late tick: the debt is booked first, and then told of
  CHECK(ledger.value() < -0.1);
  ledger.disturbed();
  CHECK_THAT(ledger.value(), WithinRel(A, 1e-9));
  (void)ledger.update(0.9 * A / 9.0, 9.0, T);
  const double left = ledger.value();
  CHECK(left < 0.2 * A);
  rest(ledger, 20.0);
  CHECK(ledger.value() == left);  // these were its amends
  (void)ledger.update(0.05, 9.0, T);
  ledger.disturbed();
  CHECK_THAT(ledger.value(), WithinRel(A, 1e-9));  // 10 s later it is another row
  rest(ledger, 0.05);
  (void)ledger.update(0.05, 9.0, T);
  const double debt = ledger.value();
  ledger.disturbed();
  CHECK(ledger.value() == debt);
  rest(ledger, 0.19);
  CHECK(ledger.value() == debt);
  rest(ledger, 0.03);
  CHECK(ledger.value() >= 0.0);

  auto lost = at<d1>(mild);
  double lent = 0.0;
  for (int n = 0; n < 20; ++n) {  // samples that are refused, one after the other
    lost.forfeit(9.0, T);
    const double before = lost.value();
    lost.disturbed();
    lent += lost.value() - before;
  }
  CHECK_THAT(lent, WithinRel(A, 1e-9));
  rest(lost, 20.0);
  lost.forfeit(9.0, T);
  lost.disturbed();  // another row, which begins without a debt
  CHECK_THAT(lost.value(), WithinRel(A, 1e-9));

  // Samples that are lost in a row are one fault: no more than A, then nor later, as long as half of it is there.
  for (const double spent : {0.0, 0.4, 0.6}) {
    auto blind = at<d1>(mild);
    for (int n = 0; n < 300; ++n) {
      blind.forfeit(0.0, T);
      blind.disturbed();
    }
    CHECK(blind.value() == A);
    (void)blind.update(spent * A / 9.0, 9.0, T);
    const double kept = blind.value();
    rest(blind, 20.0);
    CHECK(blind.value() == kept);
  }

  auto jumped = at<d1>(mild);
  (void)jumped.update(4e-3, 9.0,
                      T);  // a row that a debt began: not at once, whatever is told later
  rest(jumped, 0.05);
  jumped.disturbed();
  CHECK(jumped.value() < 0.0);
}

TEST_CASE("what encoder steps put in doubt is no fault, and a long row gets its amends, too",
          "[forgiving]") {
  for (const double q : {1e-5, 1e-3}) {
    const auto doubts =
        at<d1>(ph::forgiving{ph::quantised_energy{.damping = {0.1}, .quantum = q}, A});
    auto held = doubts, debt = doubts;
    for (int n = 0; n < 1000; ++n) (void)held.update(0.0, 9.0, T);
    CHECK_THAT(held.value(), WithinRel(-9.0 * q, 1e-6));  // it may have moved by a step
    for (int n = 0; n < 1000; ++n) (void)held.update(0.0, 0.0, T);
    CHECK_THAT(held.value(), WithinRel(-9.0 * q, 1e-6));
    for (int n = 0; n < 10; ++n) (void)debt.update(n == 5 ? std::max(2.1 * q, 1e-4) : 0.0, 9.0, T);
    CHECK(debt.value() < -3.0 * 9.0 * q);  // it did move
    rest(debt, 1.0);
    CHECK_THAT(debt.value(), WithinRel(A, 1e-9));
  }

  auto row = at<d1>(mild);
  double pause = 0.2;
  row.disturbed();
  rest(row, T);
  for (; pause < 12.0; pause *= 2.0) {  // a fault in every amends
    row.disturbed();
    rest(row, pause + 0.01);
  }
  row.disturbed();
  (void)row.update(row.value() / 9.0, 9.0, T);
  REQUIRE(row.value() < 0.5 * A);
  rest(row, 12.0);
  CHECK(row.value() < 0.5 * A);
  rest(row, 2.0);
  CHECK_THAT(row.value(), WithinRel(A, 1e-9));  // after 12.8 s, though 10 s are a row's end
}

TEST_CASE("a refused sample and a late tick are faults, and reset() forgets them", "[forgiving]") {
  const auto lent_after = [](auto&& happens) {
    ph::passive_port port{d1{}, ph::given_force{}, mild, ph::strict_bound{}, thesis_loop};
    (void)port.tick(0.0, ph::seconds{T});
    happens(port);
    for (int n = 0; n < 1000; ++n) (void)port.tick(0.0, ph::seconds{T});
    return port.energy();
  };
  const auto refused = [](auto& port) { (void)port.tick(std::nan(""), ph::seconds{T}); };
  CHECK(lent_after([](auto&) {}) == 0.0);
  CHECK_THAT(lent_after(refused), WithinRel(A, 1e-9));
  CHECK_THAT(lent_after([](auto& port) { (void)port.tick(0.0, ph::seconds{0.1}); }),
             WithinRel(A, 1e-9));
  CHECK(lent_after([&](auto& port) {
          refused(port);
          port.reset();
        }) == 0.0);
}

TEST_CASE("a wall that a fault takes is said to be lost, and to be back", "[forgiving][faults]") {
  // A hand holds a finger 4 mm deep, and one sample is off so far that its debt takes the wall.
  struct told {
    int lost = 0, back = 0, after = 0;
    bool cut = true;
    ph::event last = ph::event::nominal;
  };
  const auto held = [](double jump, double amends, double depth, bool again) {
    auto touch = ph::make_touch<d1>(
        ph::exact_device{.mass = 0.1, .damping = 0.05, .force_limit = 9.0, .longest_tick = T},
        ph::trusted_hand{{.force = 5.0}});
    (void)touch.set(ph::forgiving{ph::reduced_energy{.damping = 0.05}, amends});
    (void)touch.update({0.0, 1.0, 800.0});
    told all;
    for (int n = 0; n < 16000; ++n) {
      const double in = 4e-3 - (4e-3 + depth) * std::min(n / 400.0, 1.0);
      const bool fault = n == 1000 || (again && n == 1300);
      const auto out = touch.tick(in - (fault ? jump : 0.0), ph::seconds{T});
      all.lost += out.what == ph::event::wall_lost;
      all.back += out.what == ph::event::wall_back;
      if (out.what == ph::event::wall_lost) {
        all.after = n;
        all.cut = all.cut && out.limited;
      }
      all.last = out.what;
    }
    return all;
  };
  const told once = held(4.5e-3, ph::amends_for(9.0), 4e-3, false);
  CHECK(once.lost > 50);
  CHECK(once.after < 1000 + 600 + 2);
  CHECK(once.back == 1);
  CHECK(once.cut);
  CHECK(once.last == ph::event::nominal);
  const told twice = held(4.5e-3, ph::amends_for(9.0), 4e-3, true);
  CHECK(twice.after > 1300);
  CHECK(twice.back >= 1);
  CHECK(twice.last == ph::event::nominal);
  // In the air nothing is lost; nor is it told where none is forgiven, or where nothing happens.
  CHECK(held(4.5e-3, ph::amends_for(9.0), -4e-3, false).lost == 0);
  CHECK(held(4.5e-3, ph::amends_for(9.0), -4e-3, false).back == 0);
  const told never = held(4.5e-3, 0.0, 4e-3, false);
  CHECK(never.lost + never.back == 0);
  CHECK(never.last == ph::event::debt);
  CHECK(held(0.0, ph::amends_for(9.0), 4e-3, false).lost == 0);
}

TEST_CASE("new parameters reach a forgiving ledger and what it keeps", "[forgiving]") {
  auto touch = ph::make_touch<d1>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 9.0, .longest_tick = T}, {.force = 5.0});
  CHECK_FALSE(touch.set(ph::reduced_energy{.damping = 0.2}));
  CHECK(touch.observer().parameters().ledger.damping.coefficient == 0.2);
  CHECK(touch.observer().parameters().amends == 2.5e-3 * 9.0);
  CHECK_FALSE(touch.set(ph::forgiving{ph::reduced_energy{.damping = 0.3}, 0.5}));
  CHECK(touch.observer().parameters().amends == 0.5);
  CHECK(touch.observer().parameters().ledger.damping.coefficient == 0.3);
  CHECK(touch.set(ph::forgiving{ph::reduced_energy{.damping = 0.3}, std::nan("")}));
}

TEST_CASE("no single fault takes a wall away for longer than a second",
          "[forgiving][faults][long]") {
  // All of them, on seven compositions and at more moments: the preset `faults`.
  const auto pressed_by = [](const auto& hand) {
    return faults::subject{
        "touch", {.mass = 0.1, .damping = 0.1}, 9.0, ph::amends_for(9.0), [hand](double amends) {
          auto port = ph::make_touch<d3>(
              ph::exact_device{.mass = 0.1, .damping = 0.05, .force_limit = 9.0, .longest_tick = T},
              hand);
          (void)port.set(ph::forgiving{ph::reduced_energy{.damping = 0.05}, amends});
          (void)port.update({{0, 0, 0}, {0, 0, 1}, 2000.0});
          return [port](const faults::sample& s) mutable {
            const auto out = port.tick(s);
            return faults::answer{out.force, out.what};
          };
        }};
  };
  const faults::subject touch = pressed_by(ph::known_hand{.force = 5.0});
  const auto what = faults::single_faults();
  int tries = 0;
  for (std::size_t i = 2; i < what.size(); i += 5) {
    const faults::harm found = faults::tried(touch, what[i], {220});
    INFO(what[i].name);
    CHECK(found.finite);
    CHECK(found.lost == 0);
    CHECK(found.largest <= 9.0 * (1.0 + 1e-12));
    CHECK(found.created <= found.itself + touch.amends);
    ++tries;
  }
  CHECK(tries >= 11);
  const faults::fault outlier{
      "", 1, [](faults::sample& s) {
        s.position = faults::vector(faults::vector(s.position) - faults::vector(0, 0, 4e-3));
      }};
  // The control: an outlier that is believed.
  const faults::subject trusts = pressed_by(ph::trusted_hand{{.force = 5.0}});
  auto never = trusts;
  never.amends = 0.0;
  CHECK(faults::tried(trusts, outlier, {450}).lost == 0);
  CHECK(faults::tried(never, outlier, {450}).lost > 0);
}
