// SPDX-License-Identifier: BSD-3-Clause
// Is a ledger that counts steps of x, y, z right about encoders that step in three angles? The grip
// is moved by somebody no motor can stop, who looks for the ledger's errors; the motors hold whole
// words. True energy: E = Σ b‖Δp‖²/T − τ·Δθ.
#include "support/catch.hpp"
#include "support/falcon_loop.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <cstdio>

namespace {

using sim::random_source;
using vector = d3::vector;
using ledger_type = ph::part_at<ph::quantised_energy, d3>;

constexpr double period = 1e-3, damping = 0.03, gain = 3500.0;

falcon::point<double> point_of(const vector& p) {
  return {{p[0], p[1], p[2]}};
}

/// The true state, what the host has made of it, and the two accounts.
struct account {
  vector position{0, 0, 0.125};
  falcon::angles<double> theta = falcon::inverse(point_of(position)).value;
  falcon::angles<double> shown = falcon::to_angles<double>(falcon::to_counts(theta));
  falcon::pose_result<double> pose = falcon::forward(shown);
  falcon::torques<double> torque{};
  ledger_type ledger;
  double energy = 0.0;

  [[nodiscard]] double overstated() const { return ledger.value() - energy; }

  void hold(const vector& f) {
    const auto tau = falcon::torques_for(pose.rates, falcon::force<double>{{f[0], f[1], f[2]}});
    torque = falcon::decode(falcon::encode(tau, gain), gain);
  }
  void move(const vector& next) {
    const auto before = *this;
    position = next;
    theta = falcon::inverse(point_of(next)).value;
    energy += damping * (next - before.position).squaredNorm() / period -
              falcon::dot(torque, theta - before.theta);
    shown = falcon::to_angles<double>(falcon::to_counts(theta));
    pose = falcon::forward(shown, before.pose.position);
    const auto moved = pose.position - before.pose.position;
    const auto held = falcon::force_over(falcon::force_from(pose.rates, torque), torque,
                                         shown - before.shown, moved);
    ledger.update(vector(moved[0], moved[1], moved[2]), vector(held[0], held[1], held[2]), period);
  }
};

enum class pushing { at_random, steadily, with_the_error };

/// The largest overstatement [J] in a walk of 1500 ticks: of eight ways to go on, the one that
/// deceives the ledger most.
double deceived(double quantum, pushing how, double sweep, double wobble, std::uint64_t seed) {
  random_source random(seed);
  account books{.ledger = ledger_type({.damping = damping, .quantum = quantum})};
  const auto& ball = falcon::workspace<double>;
  vector drift = random.direction<d3>() * sweep;
  vector force = random.direction<d3>() * 5.0;
  double worst = -1.0;
  for (int n = 0; n < 1500; ++n) {
    account best = books;
    for (int way = 0; way < 8; ++way) {
      account tried = books;
      const vector aside = random.direction<d3>() * (wobble * random.uniform());
      vector next = books.position + drift + (way == 0 ? vector(d3::zero()) : aside);
      if (!ball.contains(point_of(next))) {
        next = books.position + 0.01 * (vector(0, 0, 0.125) - books.position);
      }
      tried.move(next);
      if (way == 0 || tried.overstated() > best.overstated()) best = tried;
    }
    books = best;
    worst = std::max(worst, books.overstated());
    if (!ball.contains(point_of(vector(books.position + 3.0 * drift)))) {
      drift = random.direction<d3>() * sweep;
    }
    if (how == pushing::at_random && random.chance(0.5)) force = random.direction<d3>() * 5.0;
    if (how == pushing::with_the_error) {
      falcon::torques<double> tau;
      for (std::size_t i = 0; i < 3; ++i) {
        const double side = books.shown[i] > books.theta[i] ? 0.2 : -0.2;
        tau[i] = n % 2 == 0 ? side : -side;
      }
      const auto f = falcon::force_from(books.pose.rates, tau);
      force = vector(f[0], f[1], f[2]);
    }
    books.hold(force);
  }
  return worst;
}

double most_deceived(double quantum) {
  double worst = -1.0;
  for (const pushing how : {pushing::at_random, pushing::steadily, pushing::with_the_error}) {
    for (const double sweep : {0.0, 3e-6, 3e-5, 3e-4}) {
      for (const double wobble : {1e-6, 1e-5, 5e-5, 3e-4}) {
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
          worst = std::max(worst, deceived(quantum, how, sweep, wobble, seed));
        }
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("a ledger told one count of every leg is not deceived by the Falcon's angles",
          "[falcon][quantised]") {
  const double told = most_deceived(falcon_quantum);
  const double nothing = most_deceived(0.0);
  const double third = most_deceived(falcon_quantum / 3.0);
  const double quarter = most_deceived(falcon_quantum / 4.0);
  std::printf("ledger above the truth: told q %.1e J, q/3 %.1e J, q/4 %.1e J, nothing %.1e J\n",
              told, third, quarter, nothing);
  CHECK(told <= 1e-12);
  CHECK(quarter > 1e-5);  // the controls
  CHECK(nothing > 1e-3);
}
