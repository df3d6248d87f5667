// SPDX-License-Identifier: BSD-3-Clause
#include "soak.hpp"

#include "../common/work.hpp"
#include <passive_haptics/passive_haptics.hpp>

#include <cmath>

namespace stability {

namespace {

using controllers::d1;
using controllers::f1;
template <class Space>
using compensated = ph::reduced_energy<Space, ph::isotropic_damping<Space>,
                                       ph::compensated_sum<typename Space::scalar>>;
constexpr const char* control = "float, to nearest (control)";

/// Where the hand goes: positions that float and double both show exactly, so that all drift is the
/// ledger's own.
enum class motion : std::uint8_t {
  pressing,  ///< in and out of the wall, 3 Hz, 4 mm
  waving,    ///< the same, in free space half of the time: the bank grows
  leeching,  ///< fills the bank once, then draws by steps too small for a float ledger to see
};

const char* to_string(motion m) {
  switch (m) {
    case motion::pressing:
      return "pressing";
    case motion::waving:
      return "waving";
    case motion::leeching:
      return "leeching";
  }
  return "unknown motion";
}

double on_grid(double x) {
  return std::round(x * 0x1p24) * 0x1p-24;  // 60 nm
}

class hand {
 public:
  explicit hand(motion m) : kind_(m), turn_(period) {
    for (int i = 0; i < period; ++i) {
      const double angle = 2.0 * 3.14159265358979323846 * i / period;
      const double x = m == motion::pressing ? 4e-3 * std::sin(10.0 * angle)
                       : m == motion::waving ? -20e-3 + 24e-3 * std::sin(2.0 * angle)
                                             : -0.1 + 0.1 * std::cos(25.0 * angle);
      turn_[static_cast<std::size_t>(i)] = on_grid(x);
    }
  }

  double next(long long tick, double force) noexcept {
    if (kind_ != motion::leeching || tick < period) {
      return turn_[static_cast<std::size_t>(tick % period)];
    }
    if (tick < period + 100) return on_grid(5e-4 * static_cast<double>(tick - period));  // comes in
    const bool out = force < 0.0 && at_ > 0.045;
    at_ = out ? at_ - 0x1p-24 : 0.05;  // steps of 60 nm, and back in at once
    return on_grid(at_);
  }

 private:
  static constexpr int period = 3331;
  motion kind_;
  std::vector<double> turn_;
  double at_ = 0.05;
};

/// The ledger as it would be without care: rounded to nearest. The control.
template <class Space>
struct careless_energy : ph::reduced_energy<Space> {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  constexpr bool update(const vector& displacement, const vector& held, scalar dt) noexcept {
    this->energy += this->damping.dissipated(displacement, dt) - Space::dot(held, displacement);
    return true;
  }
};

template <class Scalar, class Observer>
std::vector<soak_row> run(const char* name, motion kind, long long ticks) {
  using line = ph::space<Scalar, 1>;
  Observer observer;
  observer.damping = Scalar(0.03125);
  ph::local_model model{line{},
                        ph::rigid{ph::half_space<line>{Scalar(0), Scalar(-1), Scalar(1000)}},
                        ph::snap<line>{},
                        ph::spring<line>{},
                        observer,
                        ph::strict_bound<line>{},
                        ph::loop_limits<line>{.longest_tick = Scalar(0x1p-10)}};
  constexpr double dt = 0x1p-10, b = 0.03125;
  hand h(kind);
  ph::compensated_sum<double> truth;
  soak_row row;
  row.ledger = name;
  row.motion = to_string(kind);
  row.unit = static_cast<double>(std::numeric_limits<Scalar>::epsilon()) / 2.0;
  std::vector<soak_row> rows;
  double last = 0.0, force = 0.0;
  long long report = 1000;
  for (long long n = 0; n < ticks; ++n) {
    const double x = n == 0 ? 0.0 : h.next(n, force);
    const auto out = model.tick(static_cast<Scalar>(x), static_cast<Scalar>(dt));
    const double travel = x - last;
    const double damped = b * travel * travel / dt, work = force * travel;
    truth += damped;
    truth += -work;
    last = x;
    force = static_cast<double>(out.force);
    const double energy = truth;
    row.least_energy = std::fmin(row.least_energy, energy);
    row.drift = static_cast<double>(out.energy) - energy;
    row.bank = static_cast<double>(out.energy);
    row.overstated = std::fmax(row.overstated, row.drift);
    if (n + 1 == report || n + 1 == ticks) {
      row.ticks = n + 1;
      rows.push_back(row);
      report *= 10;
    }
  }
  return rows;
}

void plot(const session& s, const std::vector<soak_row>& rows) {
  std::string commands =
      "set logscale xy\nset format y '%.0e'\nset xlabel 'ticks'\nset ylabel '|drift| [J]'\nplot ";
  int files = 0;
  for (const char* m : {"pressing", "waving", "leeching"}) {
    for (const char* ledger : {control, "float", "float, compensated", "double"}) {
      const std::string file = "soak_" + std::to_string(files) + ".csv";
      ex::csv_file curve(s.out.path(file), "ticks,drift J");
      for (const auto& r : rows) {
        if (r.motion != m || r.ledger != ledger) continue;
        curve.line(std::to_string(r.ticks) + ',' +
                   ex::format("%.6g", std::fmax(std::abs(r.drift), 1e-20)));
      }
      curve.close();
      commands += std::string(files++ == 0 ? "" : ", ") + "'" + file +
                  "' using 1:2 with linespoints title '" + m + ", " + ledger + "'";
    }
  }
  s.out.plot("soak",
             "Drift of the ledger from the true energy against ticks; only the control's is "
             "ever upwards",
             commands);
}

}  // namespace

std::vector<soak_row> soak(long long ticks, int threads) {
  struct job {
    const char* name;
    motion kind;
    std::vector<soak_row> (*run)(const char*, motion, long long);
  };
  std::vector<job> jobs;
  for (const auto kind : {motion::pressing, motion::waving, motion::leeching}) {
    jobs.push_back({control, kind, run<float, careless_energy<f1>>});
    jobs.push_back({"float", kind, run<float, ph::reduced_energy<f1>>});
    jobs.push_back({"float, compensated", kind, run<float, compensated<f1>>});
    jobs.push_back({"double", kind, run<double, ph::reduced_energy<d1>>});
    jobs.push_back({"double, compensated", kind, run<double, compensated<d1>>});
  }
  std::vector<soak_row> rows;
  const std::atomic<bool> never = false;
  ex::work_through(
      static_cast<int>(jobs.size()), threads, never,
      [&](int i) {
        const job& j = jobs[static_cast<std::size_t>(i)];
        return j.run(j.name, j.kind, ticks);
      },
      [&](int, const std::vector<soak_row>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
      });
  return rows;
}

std::vector<std::string> run_soak(const session& s) {
  const long long ticks = s.chosen.soak > 0 ? s.chosen.soak : s.chosen.quick ? 1000000 : 10000000;
  const auto rows = soak(ticks, s.chosen.threads);
  s.out.section(
      "Soak",
      "strict_bound on a 1 kN/m wall, b 1/32 N·s/m, T 1/1024 s, in virtual time. drift: "
      "the ledger at the end less the true energy; overstated: the most by which it ever "
      "promised what was not there. pressing: 3 Hz against the wall; waving: free half of "
      "the time; leeching: a bank filled once, then outward steps whose energy is below "
      "half of its last digit in float. A ledger that overstates fails the program; the "
      "control, which only rounds to nearest, must.");
  ex::table shown(
      {"motion", "ledger", "ticks", "drift J", "overstated J", "least true energy J", "bank J"});
  std::vector<std::string> json, found;
  ex::csv_file csv(s.out.path("soak.csv"),
                   "motion,ledger,ticks,drift J,overstated J,least energy J,bank J");
  double caught = 0.0;
  for (const auto& r : rows) {
    const auto number = [](double x) { return ex::format("%.3g", x); };
    csv.line(r.motion + ",\"" + r.ledger + "\"," + std::to_string(r.ticks) + ',' + number(r.drift) +
             ',' + number(r.overstated) + ',' + number(r.least_energy) + ',' + number(r.bank));
    json.push_back(ex::json_object({{"motion", ex::json_string(r.motion)},
                                    {"ledger", ex::json_string(r.ledger)},
                                    {"ticks", std::to_string(r.ticks)},
                                    {"drift_J", ex::json_number(r.drift)},
                                    {"overstated_J", ex::json_number(r.overstated)},
                                    {"least_energy_J", ex::json_number(r.least_energy)},
                                    {"bank_J", ex::json_number(r.bank)}}));
    if (r.ledger == control) {
      caught = std::fmax(caught, r.overstated);
    } else if (r.overstated > r.unit * r.bank || r.least_energy < 0.0) {
      found.push_back("soak, " + r.motion + ", " + r.ledger + ", " + std::to_string(r.ticks) +
                      " ticks: overstated by " + number(r.overstated) + " J, least energy " +
                      number(r.least_energy) + " J");
    }
    if (r.ticks == ticks) {
      shown.add({r.motion, r.ledger, std::to_string(r.ticks), number(r.drift), number(r.overstated),
                 number(r.least_energy), number(r.bank)});
    }
  }
  csv.close();
  if (!(caught > 1e-6)) found.push_back("soak: the control was not caught overstating");
  s.out.show(shown);
  s.out.member("soak", ex::json_array(json));
  plot(s, rows);
  return found;
}

}  // namespace stability
