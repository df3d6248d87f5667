// SPDX-License-Identifier: BSD-3-Clause
// A force that changes between two samples: a fraction of a tick late, or behind a low-pass. What is lost, told what?
#include "program.hpp"
#include <passive_haptics/compliant/compositions.hpp>
#include <passive_haptics/contact/given_force.hpp>

#include <random>

namespace devices {

namespace {

using line = ph::space<double, 1>;
constexpr double T = 1e-3, b = 0.1, accepted_loss = 1e-12;

struct late_row {
  std::string composition{};
  double fraction = 0.0, lag = 0.0;  ///< of a tick; θ in ticks
  bool promised = false;
  int runs = 0, lost = 0;
  double least_energy = 0.0;  ///< of the port, with 1 µJ lent to begin with on exact positions [J]
};
ex::record record_of(const late_row& r) {
  return {{"composition", r.composition},
          {"fraction", r.fraction, "%.2f"},
          {"lag_ticks", r.lag, "%.2f"},
          {"promised", r.promised},
          {"runs", r.runs},
          {"lost", r.lost},
          {"least_energy_J", r.least_energy}};
}

/// What a tick is to be: the force wanted, as a share of the most there is, and the motion as a multiple of the one that
/// takes most out of the first and the second part of the force.
struct move {
  double wanted = 0.0, first = 0.0, second = 0.0;
};

/// The true energy [J] of a motion of constant speeds, v₁ for τT and v₂ after it, under f₋ and f; or of v₁ + v₂ e^{−t/θ}
/// under f + (y − f) e^{−t/θ}. The motion that takes most is v = φ/(2b).
struct true_port {
  double fraction = 0.0, theta = 0.0, before = 0.0, energy = 0.0, least = 0.0;

  double pass(double f, const move& m) {
    double moved = 0.0;
    if (theta > 0.0) {
      const double e = std::exp(-T / theta), off = before - f;
      const double A = m.first * f / (2.0 * b), B = m.second * off / (2.0 * b);
      const double one = theta * (1.0 - e), two = theta / 2.0 * (1.0 - e * e);
      energy += b * (A * A * T + 2.0 * A * B * one + B * B * two) -
                (f * A * T + (f * B + off * A) * one + off * B * two);
      moved = A * T + B * one;
      before = f + off * e;
    } else {
      const double t1 = fraction * T, t2 = (1.0 - fraction) * T;
      const double d1 = t1 * m.first * before / (2.0 * b), d2 = t2 * m.second * f / (2.0 * b);
      energy += (t1 > 0.0 ? b * d1 * d1 / t1 : 0.0) - before * d1;
      least = std::min(least, energy);
      energy += (t2 > 0.0 ? b * d2 * d2 / t2 : 0.0) - f * d2;
      moved = d1 + d2;
      before = f;
    }
    least = std::min(least, energy);
    return moved;
  }
};

double played(const auto& ledger, true_port real, const std::vector<move>& moves) {
  ph::passive_port port{line{}, ph::given_force{}, ledger, ph::strict_bound{},
                        ph::loop_limits{.longest_tick = T, .top_speed = 1e9, .workspace = 1e9}};
  if (const auto fault = port.check()) ex::complain(std::string("late: ") + fault.parameter);
  double x = 0.0;
  (void)port.tick(x, ph::seconds{T});
  for (const auto& m : moves) {
    const double f = port.tick(x, ph::seconds{T}, m.wanted).force;
    x += std::clamp(real.pass(f, m), -1.0, 1.0);
  }
  return real.least;
}

/// The worst of sequences that are climbed.
late_row searched(const std::string& name, bool promised, const auto& ledger, double fraction,
                  double theta, int climbs, int steps) {
  late_row row{name, fraction, theta / T, promised, 0, 0, 1e-6};
  for (int c = 0; c < climbs; ++c) {
    std::mt19937 from(static_cast<unsigned>(c) + 11u);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> bell;
    const auto drawn = [&] {
      move m;
      m.wanted = (unit(from) < 0.5 ? -1.0 : 1.0) * std::pow(10.0, 2.0 * unit(from) - 1.0);
      m.first = unit(from) < 0.4 ? 1.0 : 2.0 * bell(from);
      m.second = unit(from) < 0.4 ? 1.0 : 2.0 * bell(from);
      return m;
    };
    std::vector<move> best(8 + from() % 20);
    for (auto& m : best) m = drawn();
    // the ledger begins empty, so the first ticks pay in
    for (std::size_t i = 0; i < 2; ++i) best[i] = {0.0, 0.0, 0.0};
    const auto with_start = [&](std::vector<move> moves) {
      std::vector<move> all{{-1e-2, -3.0, -3.0}};
      all.insert(all.end(), moves.begin(), moves.end());
      return all;
    };
    auto paid = ledger;
    paid.ledger.loan = 1e-6;
    double least = played(paid, {fraction, theta, 0.0, 1e-6, 1e-6}, with_start(best));
    for (int s = 0; s < steps; ++s) {
      auto next = best;
      auto& m = next[from() % next.size()];
      const double kind = unit(from);
      if (kind < 0.4) {
        m = drawn();
      } else if (kind < 0.6) {
        m.wanted = -m.wanted;
      } else {
        (kind < 0.8 ? m.first : m.second) += 0.1 * bell(from);
      }
      const double found = played(paid, {fraction, theta, 0.0, 1e-6, 1e-6}, with_start(next));
      ++row.runs;
      if (found <= least) least = found, best = next;
    }
    row.least_energy = std::min(row.least_energy, least);
    row.lost += least < -accepted_loss ? 1 : 0;
  }
  return row;
}

/// A device on encoders, with elastic friction, in a loop that is τ late: a slider of c over p, and a hand.
struct stepped_device {
  double mass = 0.1, friction = 0.1, presliding = 15e-6, quantum = 20e-6, fraction = 0.0;
  double x = 0.002, v = 0.0, bent = 0.0, before = 0.0, energy = 0.0, least = 0.0;

  double shown() const { return std::floor(x / quantum) * quantum + quantum / 2.0; }
  void pass(double f, const auto& hand, double t) {
    constexpr int steps = 40;
    const double h = T / steps;
    for (int i = 0; i < steps; ++i) {
      const double held = i < fraction * steps ? before : f;
      const double rubs = friction * bent / presliding;
      const double a = (held - b * v - rubs + hand(t + i * h, x, v)) / mass;
      const double next = v + a * h, dx = (v + next) / 2.0 * h;
      const double turned = std::clamp(bent + dx, -presliding, presliding);
      const double slid = dx - (turned - bent);
      energy += b * h * (v * v + v * next + next * next) / 3.0 - held * dx +
                friction * std::abs(slid) +
                friction / presliding * (turned * turned - bent * bent) / 2.0;
      bent = turned;
      x += dx;
      v = next;
      least = std::min(least, energy);
    }
    before = f;
  }
};

template <int Late>
late_row on_encoders(const std::string& name, bool promised, const auto& ledger, const auto& bound,
                     double fraction, int hands, double spare) {
  late_row row{name, fraction, 0.0, promised, hands, 0, 0.0};
  for (int i = 0; i < hands; ++i) {
    std::mt19937 from(static_cast<unsigned>(i) * 31u + 5u);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    ph::passive_port port{line{}, ph::given_force{}, ledger, bound,
                          ph::late_loop_limits<Late>{.longest_tick = T, .top_speed = 5.0}};
    if (const auto fault = port.check()) ex::complain(std::string("late: ") + fault.parameter);
    stepped_device d;
    d.fraction = fraction;
    const double bias = -4.0 * unit(from), swing = 5.0 + bias,
                 rate = std::pow(10.0, 0.3 + 2.2 * unit(from));
    const double K = std::pow(10.0, 3.0 + 1.3 * unit(from)), push = 4.0 * unit(from);
    const bool collude = unit(from) < 0.5, shakes = unit(from) < 0.5;
    const auto hand = [&](double t, double /*x*/, double v) {
      if (shakes) return v > 0.0 ? 5.0 : -5.0;
      return bias + (std::sin(6.2832 * rate * t) > 0.0 ? swing : -swing);
    };
    for (int n = 0; n < 3000; ++n) {
      double wanted = d.shown() < 0.0 ? -K * d.shown() : 0.0;
      if (collude) wanted = std::clamp(push * std::copysign(1.0, d.v), -9.0, 9.0);
      const double f = port.tick(d.shown(), ph::seconds{T}, std::clamp(wanted, -9.0, 9.0)).force;
      d.pass(f, hand, n * T);
      if (std::abs(d.x) > 0.5) break;
    }
    row.least_energy = std::min(row.least_energy, d.least);
    row.lost += d.least < -spare - 1e-9 ? 1 : 0;
  }
  return row;
}

}  // namespace

ex::failures run_late(const session& s) {
  s.out.section(
      "A force that changes between two samples",
      "Exact positions: any motion and any force that collude, climbed, with 1 µJ lent "
      "to begin with. Encoders of 20 µm with elastic friction, "
      "15 µm, 0.1 kg: hands of 5 N and forces of 9 N; covered there are the ½ c p that "
      "friction may store. Controls "
      "are told another fraction or time constant than there is. Quiet is not judged "
      "here, because force and motion are drawn anew in every tick, and no contact rests.");
  struct job {
    int kind;
    double number;
  };
  std::vector<job> jobs;
  for (const double t : {0.0, 0.15, 0.3, 0.5, 0.8, 0.95})
    jobs.push_back({0, t}), jobs.push_back({2, t});
  for (const double lag : {0.1, 0.3, 1.0, 1.6, 2.0}) jobs.push_back({1, lag * T});
  const int climbs = s.chosen.quick ? 3 : 12, steps = s.chosen.quick ? 500 : 3000,
            hands = s.chosen.quick ? 20 : 120;
  const auto rows = s.rows("late.csv", "late forces", jobs, [&](const job& j) {
    std::vector<late_row> all;
    const ph::reduced_energy exact{.damping = b};
    if (j.kind == 0) {
      const double t = j.number;
      const auto split = [&](const char* name, bool promised, double from, double to) {
        all.push_back(
            searched(name, promised, ph::split_tick{exact, from, to, T}, t, 0.0, climbs, steps));
      };
      split("split_tick, known", true, t, t);
      split("split_tick, within 0.1", true, std::max(0.0, t - 0.1), std::min(1.0, t + 0.1));
      split("split_tick, unknown", true, 0.0, 1.0);
      if (t > 0.0) split("control: told 0", false, 0.0, 0.0);
      if (t < 0.8) split("control: told 0.2 too much", false, t + 0.2, t + 0.2);
    } else if (j.kind == 1) {
      const auto lag = [&](const char* name, bool promised, double told) {
        all.push_back(
            searched(name, promised, ph::lagging_force{exact, told}, 0.0, j.number, climbs, steps));
      };
      lag("lagging_force, known", true, j.number);
      lag("control: told half", false, j.number / 2.0);
      lag("control: told none", false, 0.0);
    } else {
      const double t = j.number, c = 0.1, p = 15e-6, q = 20e-6, alpha = 150.0, spare = c * p / 2.0;
      const ph::dual_ledger own{.damping = {.coefficient = b, .coulomb = c, .presliding = p},
                                .quantum = q};
      const ph::between_samples<> told{own, t, t, alpha, T, 5.0};
      const ph::between_samples<> wide{
          own, std::max(0.0, t - 0.1), std::min(1.0, t + 0.1), alpha, T, 5.0};
      const ph::reachable_bound reach{.mass = 0.1, .hand_force = 5.0 + c};
      all.push_back(on_encoders<1>("between_samples, strict_bound", true, told, ph::strict_bound{},
                                   t, hands, spare));
      all.push_back(
          on_encoders<1>("between_samples, reachable_bound", true, told, reach, t, hands, spare));
      all.push_back(on_encoders<1>("between_samples, within 0.1, reachable_bound", true, wide,
                                   reach, t, hands, spare));
      if (t > 0.0) {
        all.push_back(on_encoders<0>("control: dual_ledger, strict_bound, told 0", false, own,
                                     ph::strict_bound{}, t, hands, spare));
        all.push_back(on_encoders<0>("control: dual_ledger, reachable_bound, told 0", false, own,
                                     reach, t, hands, spare));
      }
    }
    return all;
  });
  ex::show_rows(s.out, "late", rows);
  ex::failures found;
  std::vector<std::string> lost;
  for (const auto& r : rows) {
    if (!r.promised && r.lost > 0) lost.push_back(r.composition);
    if (r.promised && r.lost > 0) {
      found.push_back(r.composition + " loses " + std::to_string(-r.least_energy) +
                      " J at a fraction of " + std::to_string(r.fraction) + ", a lag of " +
                      std::to_string(r.lag) + " ticks");
    }
  }
  for (const auto& r : rows) {
    if (!r.promised && std::find(lost.begin(), lost.end(), r.composition) == lost.end()) {
      found.push_back(r.composition + " loses nothing, and is no control");
      lost.push_back(r.composition);
    }
  }
  return found;
}

}  // namespace devices
