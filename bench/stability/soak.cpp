// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>

#include <functional>

namespace stability {

namespace {

using controllers::d1;
using controllers::f1;
namespace sim = ph::simulation;
constexpr const char* control = "float, to nearest (control)";
constexpr double b = 0x1p-5, T = 0x1p-10;  // [N·s/m], [s]

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

  double next(int tick, double force) noexcept {
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
struct careless_energy {
  static constexpr auto passivity = ph::guarantee::strict;
  static constexpr bool counts = true, exact = true;
  ph::part_at<ph::isotropic_damping, f1> b;
  float energy = 0.0F;

  bool update(float dx, float held, float dt) noexcept {
    energy += b.dissipated(dx, dt) - held * dx;
    return true;
  }
  void forfeit(float /*held*/, float /*T*/) noexcept {}
  [[nodiscard]] float value() const noexcept { return energy; }
  [[nodiscard]] const auto& damping() const noexcept { return b; }
};

template <class Space, class Observer>
std::vector<soak_row> run(const char* name, motion kind, int ticks, const Observer& observer) {
  using scalar = typename Space::scalar;
  ph::local_model model{Space{},
                        ph::fixed{ph::half_space<Space>{scalar(0), scalar(-1), scalar(1000)}},
                        ph::turn_at_once{},
                        ph::spring{},
                        observer,
                        ph::strict_bound{},
                        ph::loop_limits{.longest_tick = T, .top_speed = 100.0, .watchdog = T}};
  sim::prescribed_motion<Space> device({.damping = b, .period = T});
  hand h(kind);
  soak_row row{.ledger = name,
               .motion = to_string(kind),
               .unit = static_cast<double>(std::numeric_limits<scalar>::epsilon()) / 2.0};
  std::vector<soak_row> rows;
  int report = 1000;
  sim::run(device, model, ticks, sim::idle, [&](const auto& now) {
    row.bank = static_cast<double>(now.out.energy);
    row.drift = row.bank - device.meter().value();
    row.least_energy = device.meter().minimum();
    row.overstated = std::fmax(row.overstated, row.drift);
    row.ticks = now.tick + 1;
    if (row.ticks == report || row.ticks == ticks) rows.push_back(row);
    if (row.ticks == report) report = report > ticks / 10 ? ticks : report * 10;
    device.move_to(h.next(row.ticks, static_cast<double>(now.force)));
  });
  return rows;
}

void plot(const session& s, const std::vector<soak_row>& rows) {
  std::map<std::string, std::string> lines;
  for (const auto& r : rows) {
    if (r.ledger == "double, compensated") continue;
    lines[std::string(r.motion) + ", " + r.ledger] +=
        std::to_string(r.ticks) + ex::format(",%.6g\n", std::fmax(std::abs(r.drift), 1e-20));
  }
  const auto drift = [&rows](const char* ledger, int ticks = std::numeric_limits<int>::max()) {
    double most = 0.0;  // by then
    for (const auto& r : rows) {
      if (r.ledger == ledger && r.ticks <= ticks) most = std::max(most, std::abs(r.drift));
    }
    return most;
  };
  s.out.plot(
      "soak",
      {"How far the ledger drifts from the true energy",
       {{"Rounding adds up with the ticks,",
         [&drift] { return drift("float") > drift("float", 1000); }},
        {"in float far sooner than in double.",
         [&drift] { return ex::at_least(drift("float") / drift("double"), 1e3); }},
        {"All drift is downwards, to the safe side, but that of the control,",
         [&rows] {
           return std::none_of(rows.begin(), rows.end(), [](const soak_row& r) {
             return r.ledger != control && r.drift > r.unit * std::abs(r.bank);
           });
         }},
        ex::definition("whose ledger rounds to the nearest; the sign is in the table above.")}},
      "set logscale xy\nset format '10^{%L}'\nset xlabel 'ticks'\nset ylabel '|drift| [J]'\n" +
          ex::curves(lines));
}

}  // namespace

std::vector<soak_row> soak(int ticks, int threads) {
  using compensated = ph::basic_reduced_energy<ph::isotropic_damping, ph::ledger_sum::compensated>;
  const ph::reduced_energy plain{.damping = b};
  const compensated careful{.damping = b};
  const careless_energy careless{.b = ph::part_at<ph::isotropic_damping, f1>(b)};
  std::vector<std::function<std::vector<soak_row>()>> jobs;
  for (const auto kind : {motion::pressing, motion::waving, motion::leeching}) {
    jobs.push_back([=] { return run<f1>(control, kind, ticks, careless); });
    jobs.push_back([=] { return run<f1>("float", kind, ticks, plain); });
    jobs.push_back([=] { return run<f1>("float, compensated", kind, ticks, careful); });
    jobs.push_back([=] { return run<d1>("double", kind, ticks, plain); });
    jobs.push_back([=] { return run<d1>("double, compensated", kind, ticks, careful); });
  }
  std::vector<soak_row> rows;
  const std::atomic<bool> never = false;
  ex::work_through(
      static_cast<int>(jobs.size()), threads, never,
      [&](int i) { return jobs[static_cast<std::size_t>(i)](); },
      [&](int, const std::vector<soak_row>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
      });
  return rows;
}

static ex::record record_of(const soak_row& r) {
  return {{"motion", r.motion}, {"ledger", r.ledger},           {"ticks", r.ticks},
          {"drift J", r.drift}, {"overstated J", r.overstated}, {"least energy J", r.least_energy},
          {"bank J", r.bank}};
}

std::vector<std::string> run_soak(const session& s) {
  const int ticks = s.chosen.soak > 0 ? s.chosen.soak : s.chosen.quick ? 1000000 : 10000000;
  const auto rows = soak(ticks, s.threads);
  s.out.section(
      "Soak",
      "strict_bound on a 1 kN/m wall, b 1/32 N·s/m, T 1/1024 s, in virtual time. drift: "
      "the ledger at the end less the true energy; overstated: the most by which it ever "
      "promised what was not there. pressing: 3 Hz against the wall; waving: free half of "
      "the time; leeching: a bank filled once, then outward steps whose energy is below "
      "half of its last digit in float. A ledger that overstates fails the program; the "
      "control, which only rounds to nearest, must. The hand never holds still, so nothing "
      "comes to rest.");
  ex::write_csv(s.out, "soak.csv", rows, "%.3g");
  std::vector<std::string> found;
  double caught = 0.0;
  for (const auto& r : rows) {
    if (r.ledger == control) {
      caught = std::fmax(caught, r.overstated);
    } else if (r.overstated > r.unit * r.bank || r.least_energy < 0.0) {
      found.push_back(std::string("soak, ") + r.motion + ", " + r.ledger + ", " +
                      std::to_string(r.ticks) + " ticks: overstated by " +
                      ex::format("%.3g", r.overstated) + " J, least energy " +
                      ex::format("%.3g", r.least_energy) + " J");
    }
  }
  if (!(caught > 1e-6)) found.push_back("soak: the control was not caught overstating");
  s.out.show(ex::table_of(
      rows, [ticks](const soak_row& r) { return r.ticks == ticks ? record_of(r) : ex::record{}; }));
  s.out.member("soak", ex::json_of(rows));
  plot(s, rows);
  return found;
}

}  // namespace stability
