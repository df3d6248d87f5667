// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"
#include <passive_haptics/simulation/schedule.hpp>

#include <array>

namespace stability {

namespace {

namespace sim = ph::simulation;
using controllers::controller;

/// Mostly ordinary numbers, so that contact comes about; often the end of a range.
template <class Scalar>
class odd_numbers {
 public:
  explicit odd_numbers(std::uint64_t seed) : random_(seed) {}

  Scalar any() {
    using limits = std::numeric_limits<Scalar>;
    if (random_.chance(0.5)) return static_cast<Scalar>(random_.uniform(-2e-3, 2e-3));
    const std::array odd{Scalar(0),          limits::denorm_min(), limits::min(),
                         limits::epsilon(),  Scalar(1e-30),        Scalar(1e-9),
                         Scalar(1),          Scalar(1e3),          Scalar(1e9),
                         Scalar(1e18),       limits::max() / 2,    limits::max(),
                         limits::infinity(), limits::quiet_NaN()};
    const Scalar x = odd[random_.bits() % odd.size()];
    return random_.chance(0.5) ? x : -x;
  }
  Scalar finite() {
    Scalar x = any();
    while (!ph::kernels::is_finite(x)) x = any();
    return x;
  }
  Scalar positive() {
    const Scalar x = ph::kernels::magnitude(finite());
    return x > Scalar(0) ? x : Scalar(1);
  }
  Scalar tick() { return random_.chance(0.8) ? Scalar(1e-3) : any(); }
  bool chance(double p) { return random_.chance(p); }

 private:
  sim::random_source random_;
};

template <class Space>
bool all_finite(const ph::tick_result<Space>& out) {
  return Space::is_finite(out.force) && ph::kernels::is_finite(out.depth) &&
         ph::kernels::is_finite(out.energy);
}

template <class Space>
std::string text_of(const ph::device_sample<Space>& sample) {
  std::string x = "x", held = ", held";
  for (int i = 0; i < Space::dof; ++i) {
    x += ex::format(" %.9g", static_cast<double>(sim::component(sample.position, i)));
    held += ex::format(" %.9g", static_cast<double>(sim::component(sample.held, i)));
  }
  return x + held + ex::format(", dt %g", static_cast<double>(sample.dt));
}

template <class Space>
void try_in(const controller& c, long ticks, std::uint64_t seed, numbers_row& row) {
  using scalar = typename Space::scalar;

  odd_numbers<scalar> odd(seed);
  controllers::premises known;
  if (odd.chance(0.5)) known.damping = static_cast<double>(odd.positive());
  if (odd.chance(0.3)) known.mass = static_cast<double>(odd.positive());
  if (odd.chance(0.3)) known.longest_tick = static_cast<double>(odd.positive());
  if (odd.chance(0.3)) known.quantum = static_cast<double>(odd.positive());
  auto model = c.in<Space>()(known);
  const bool sound = !model.check();
  ph::tick_result<Space> last{Space::zero(), scalar(0), scalar(0)};
  for (long n = 0; n < ticks; ++n) {
    if (n % 10 == 0) {
      typename Space::vector point = Space::zero(), normal = Space::zero();
      for (int i = 0; i < Space::dof; ++i) {
        sim::component(point, i) = odd.chance(0.9) ? scalar(0) : odd.any();
        sim::component(normal, i) = odd.any();
      }
      static_cast<void>(model.update({point, normal, odd.chance(0.5) ? scalar(1000) : odd.any()}));
    }
    ph::device_sample<Space> sample{.dt = odd.tick(), .valid = odd.chance(0.95)};
    for (int i = 0; i < Space::dof; ++i) {
      sim::component(sample.position, i) = odd.chance(0.8) ? scalar(odd.finite()) : odd.any();
    }
    sample.held = odd.chance(0.9) ? typename Space::coordinates(last.force)
                                  : typename Space::coordinates(sample.position);
    const auto out = model.tick(sample);
    ++row.ticks;
    const bool bad = !sample.valid || !(sample.dt > scalar(0)) ||
                     !ph::kernels::is_finite(sample.dt) || !Space::is_finite(sample.position) ||
                     !Space::is_finite(sample.held);
    row.refused += out.what >= ph::event::rejected_sample ? 1 : 0;
    row.limited += out.limited ? 1 : 0;
    row.pushed += out.force == Space::zero() ? 0 : 1;
    const bool wrong = !all_finite<Space>(out);
    const bool unsaid =
        (bad || !sound) && (out.what < ph::event::rejected_sample || !(out.force == Space::zero()));
    row.not_finite += wrong ? 1 : 0;
    row.silent += unsaid ? 1 : 0;
    if ((wrong || unsaid) && row.first.empty()) {
      row.first = text_of<Space>(sample) + " -> " + to_string(out.what) +
                  ex::format(", E1 was %.9g J", static_cast<double>(last.energy));
    }
    last = all_finite<Space>(out) ? out : last;
  }
}

template <class Space>
void try_in(const controller& c, const char* scalar, long ticks, std::vector<numbers_row>& rows) {
  if (!c.in<Space>()) return;
  numbers_row row{.controller = c.name, .scalar = scalar, .dof = Space::dof};
  const long run = 500;
  for (long done = 0; done < ticks; done += run) {
    try_in<Space>(c, run, static_cast<std::uint64_t>(done / run) + 1, row);
  }
  rows.push_back(row);
}

ex::record counts_of(const numbers_row& r) {
  return {{"ticks", r.ticks},   {"refused", r.refused},       {"limited", r.limited},
          {"pushed", r.pushed}, {"not finite", r.not_finite}, {"silent", r.silent}};
}

}  // namespace

static ex::record record_of(const numbers_row& r) {
  ex::record all{{"controller", r.controller}, {"scalar", r.scalar}, {"dof", r.dof}};
  for (auto& count : counts_of(r)) all.push_back(std::move(count));
  return all;
}

std::vector<numbers_row> try_numbers(const std::vector<controller>& all, long ticks) {
  std::vector<numbers_row> rows;
  for (const auto& c : all) {
    try_in<controllers::f1>(c, "float", ticks, rows);
    try_in<controllers::d1>(c, "double", ticks, rows);
    try_in<controllers::f3>(c, "float", ticks, rows);
    try_in<controllers::d3>(c, "double", ticks, rows);
  }
  return rows;
}

std::vector<std::string> run_numbers(const session& s) {
  const auto rows = try_numbers(s.judged, s.chosen.quick ? 10000 : 200000);
  ex::write_csv(s.out, "numbers.csv", rows);
  numbers_row sum;
  std::vector<std::string> found;
  for (const auto& r : rows) {
    for (const auto count :
         {&numbers_row::ticks, &numbers_row::refused, &numbers_row::limited, &numbers_row::pushed,
          &numbers_row::not_finite, &numbers_row::silent}) {
      sum.*count += r.*count;
    }
    if (r.not_finite + r.silent == 0) continue;
    found.push_back(r.controller + ", " + r.scalar + ", " + std::to_string(r.dof) +
                    " DOF: " + std::to_string(r.not_finite) + " times no number, " +
                    std::to_string(r.silent) + " times silent; first " + r.first);
  }
  s.out.section(
      "Numbers at the ends of their range",
      "Positions, forces held, tick lengths, surfaces and parameters drawn from 0, "
      "subnormal, 1e-30 to 1e18, the largest, infinite and NaN, mixed with ordinary ones, "
      "every controller. Nothing but numbers may come out; a bad sample must give an "
      "event and force zero.");
  s.out.show(ex::table_of(std::vector{sum}, counts_of));
  s.out.member("numbers", ex::json_of(counts_of(sum)));
  return found;
}

}  // namespace stability
