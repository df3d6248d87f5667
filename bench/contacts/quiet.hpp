// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The common part of the sections on quiet: the hands, a point mass in a hand, and the results of many scenes.
//
// A device has to be quiet (simulation/quiet.hpp) from `in_time` after the last news, on.

#include "../common/draws.hpp"
#include "../common/quiet.hpp"
#include "program.hpp"
#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/device/rigid_body.hpp>

#include <array>
#include <numeric>
#include <span>

namespace contacts {

inline constexpr double in_time = ex::quiet_in;       // t_s [s]
inline constexpr double watched = ex::quiet_watched;  // length of a run after the news [s]
inline constexpr double watched_longest = 30.0;       // the same where it is not quiet in time [s]

/// A hand that holds still: a spring to its position, and a damper. With both zero only the load is left.
struct still_hand {
  const char* name;
  double stiffness;  ///< [N/m]
  double damping;    ///< [N·s/m]
};
inline constexpr std::array<still_hand, 3> still_hands{
    {{"off", 0.0, 0.0}, {"relaxed", 100.0, 1.0}, {"stiff", 400.0, 6.0}}};

/// The random numbers of a scene of walls.
class draws : public ex::draws {
 public:
  using ex::draws::draws;
  /// The stiffness of a wall [N/m].
  [[nodiscard]] double stiffness() noexcept { return scale(300.0, 80e3); }
  /// The mass that is stated, as a share of the true one.
  [[nodiscard]] double told() noexcept { return chance(0.5) ? 1.0 : between(0.3, 1.0); }
};

/// m ẍ + (b + b_h) ẋ + k (x − goal) = f + load, f held for a tick: exact, by the power series of its solution.
/// The energy at the port is what the device's own damper took less what f brought in.
class held_point {
 public:
  struct parameters {
    double mass = 0.1;  ///< [kg]
    double damping = contacts::damping;
    still_hand hand = still_hands[0];
    vector load = vector::Zero(), goal = vector::Zero(), start = vector::Zero();
  };
  explicit held_point(const parameters& p) noexcept : p_(p), x_(p.start) { last_for(T); }
  /// Sets the length of the coming ticks [s].
  void last_for(double dt) noexcept {
    const double rate = (p_.damping + p_.hand.damping) / p_.mass;
    const double spring = p_.hand.stiffness / p_.mass;
    slope_ = reach_ = swing_ = 0.0;
    double term = 1.0, before = 0.0;  // s(t) = Σ aₙ tⁿ, s(0) = 0, s'(0) = 1; as aₙ dtⁿ⁻¹
    for (int n = 1; n < 40; ++n) {
      slope_ += n * term;
      reach_ += term * dt;
      swing_ += term * dt * dt / (n + 1);
      const double next = -(rate * dt * n * term + spring * dt * dt * before) / ((n + 1) * n);
      before = term;
      term = next;
    }
  }
  /// A tick under the force f [N].
  void step(const vector& f) noexcept {
    const double k = p_.hand.stiffness, damped = p_.damping + p_.hand.damping;
    const vector push = f + p_.load, from = x_ - p_.goal;
    const vector a = (push - k * from) / p_.mass;
    const vector travel = v_ * reach_ + a * swing_, speed = v_ * slope_ + a * reach_;
    const double spent = push.dot(travel) - k * travel.dot(from + travel / 2.0) -
                         p_.mass * (speed - v_).dot(speed + v_) / 2.0;  // in both dampers
    meter_.book(
        {.damping = damped > 0.0 ? spent * p_.damping / damped : 0.0, .actuator = f.dot(travel)});
    x_ += travel;
    v_ = speed;
  }
  [[nodiscard]] const vector& position() const noexcept { return x_; }
  [[nodiscard]] const vector& velocity() const noexcept { return v_; }
  [[nodiscard]] const sim::port_energy_meter& meter() const noexcept { return meter_; }
  /// The largest force of the hand [N].
  [[nodiscard]] static double most(const parameters& p) noexcept {
    return p.load.norm() + p.hand.stiffness * (p.start - p.goal).norm();
  }

 private:
  parameters p_;
  vector x_, v_ = vector::Zero();
  double slope_ = 0.0, reach_ = 0.0, swing_ = 0.0;
  sim::port_energy_meter meter_;
};

/// The result of one scene.
struct quiet_run {
  bool gone = false;            ///< the device has slid away
  double seconds = watched;     ///< of the run
  double touched = -1.0;        ///< time at which a contact pressed last [s]
  double settling = 0.0;        ///< time from the news until it is quiet [s]; NaN: it is not
  sim::quiet_bar missed{};      ///< by the last window that was not quiet
  sim::quiet_figures last{};    ///< of the last window
  double free = 0.0;            ///< the speed at the end along whatever direction [m/s]
  double least_energy = 0.0;    ///< [J]
  double loss_allowed = 1e-12;  ///< what the integration may have lost [J]
  double asked = std::nan(""), shown = std::nan("");  ///< stiffness of the resting contact [N/m]
  double can_be = std::nan("");  ///< of `asked`, what the sampling leaves [N/m]

  /// True if a contact pressed in the last second: a device that hops counts, one that hovers does not.
  [[nodiscard]] bool counts() const noexcept { return !gone && touched >= seconds - 1.0; }
  /// Ends the run at that speed [m/s].
  void end(const auto& judge, double speed) noexcept {
    settling = judge.settling();
    missed = judge.missed();
    last = judge.figures();
    free = speed;
  }
};
/// The number of ticks of a run, which grows if the device has not been quiet in time at the last of them.
[[nodiscard]] inline int ticks_of(int until, int tick, const auto& judge) noexcept {
  const bool more = tick + 1 == until && !(judge.settling() <= in_time);
  return more ? static_cast<int>(watched_longest / T) : until;
}

/// The stiffness asked for: the mean K of the contacts that press, weighted by their forces.
class asked_stiffness {
 public:
  void add(double lambda, double K, double most) noexcept {
    total_ += lambda;
    asked_ += lambda * K;
    can_be_ += lambda * std::min(K, most);
  }
  void tell(quiet_run& r) const noexcept {
    r.asked = asked_ / total_;
    r.can_be = can_be_ / total_;
  }

 private:
  double total_ = 0.0, asked_ = 0.0, can_be_ = 0.0;
};

/// Holds a device in a still hand until it is quiet after the last news; world(tick, x) publishes to the port before each
/// tick, and returns true if that is news. `Late` ticks pass before a command is held. A tick is shorter than T by up to
/// that share of it.
template <int Late = 0>
[[nodiscard]] quiet_run held_still(auto& port, int slots, const held_point::parameters& p,
                                   const auto& world, vector* end = nullptr, double jitter = 0.0) {
  held_point device(p);
  draws length(1);
  sim::quiet_judge<d3> judge;
  quiet_run run;
  std::array<vector, std::size_t{Late} + 1> due{};  // commands on their way, the newest last
  due.fill(vector::Zero());
  std::vector<vector> room;
  double dt = T;  // of the last tick [s]
  int until = static_cast<int>(watched / T);
  for (int tick = 0; tick < until; ++tick) {
    if (world(tick, device.position())) {
      judge.news();
      until = tick + static_cast<int>(watched / T);
    }
    due.back() = port.tick(device.position(), ph::seconds{dt}).force;
    const auto normals = ex::pressing(port.source(), slots, room);
    judge.add(due.back(), device.velocity(), dt, normals);
    if (jitter > 0.0) device.last_for(dt = T * (1.0 - jitter * length.between(0.0, 1.0)));
    device.step(due.front());
    std::rotate(due.begin(), due.begin() + 1, due.end());
    if (!normals.empty()) run.touched = tick * T;
    until = ticks_of(until, tick, judge);
    run.seconds = (tick + 1) * T;
    if (!(device.position().norm() < 0.5)) {
      run.gone = true;
      break;
    }
  }
  run.end(judge, device.velocity().norm());
  run.least_energy = device.meter().minimum();
  if (end != nullptr) *end = device.position();
  return run;
}
inline constexpr auto no_news = [](int /*tick*/, const vector& /*x*/) { return false; };

/// The stiffness asked for and shown by what presses at rest [N/m], of a copy of its port, at x.
[[nodiscard]] ex::rest_stiffness stiffness_at_rest(auto port, int slots, const vector& x) {
  asked_stiffness asked;
  for (int i = 0; i < slots; ++i) {
    const auto& slot = port.source().slot(i);
    asked.add(slot.pressed(), slot.target().stiffness, 0.0);
  }
  quiet_run told;
  asked.tell(told);
  const auto force = [&](const vector& at) -> vector {
    return port.tick(at, ph::seconds{T}).force;
  };
  return {told.asked, ex::shown_by(force, x)};
}

/// Adds to a row's columns how a copy of the port comes to rest in that hand. What slides away, or does not press in the
/// last second, is left out.
template <int Late = 0>
void add_held(ex::at_rest& row, auto port, int slots, const held_point::parameters& p,
              const auto& world) {
  vector end;
  const quiet_run run = held_still<Late>(port, slots, p, world, &end);
  if (!run.counts()) return;
  row.add(run.settling, run.missed, run.last,
          run.settling <= in_time ? stiffness_at_rest(port, slots, end) : ex::rest_stiffness{});
}

/// The points of a tool that press, at that orientation, as rows (n, r × n).
template <class Body>
[[nodiscard]] std::span<const typename Body::vector> pressing_rows(
    const auto& source, int count, const auto& orientation,
    std::vector<typename Body::vector>& room) {
  room.clear();
  for (int i = 0; i < count; ++i) {
    const auto& slot = source.slot(i);
    if (!(slot.pressed() > 0.0)) continue;
    const vector arm = ph::rotation::rotate<double>(orientation, slot.point);
    room.push_back(Body::join(slot.normal(), d3::cross(arm, slot.normal())));
  }
  return room;
}

/// The result of many scenes of one kind.
struct quiet_row {
  std::string scene, hand;
  int cases = 0;
  double in_time = contacts::in_time;  ///< t_s [s]
  int judged = 0, unsettled = 0;
  int slides = 0;                   ///< quiet later than t_s, at last
  std::array<int, 5> missed{};      ///< of the unsettled, by bar
  double slowest = 0.0;             ///< of those that are quiet in time [s]
  double median = 0.0;              ///< [s]
  double step = 0.0;                ///< the largest of the last window [N] a tick
  double fastest = 0.0;             ///< at the end, free directions included [m/s]
  double least_energy = 0.0;        ///< [J]
  int lost = 0;                     ///< runs with less than nothing
  int first_unsettled = -1;         ///< its number
  double asked = 0.0, shown = 0.0;  ///< medians [N/m]
  double least_share = std::nan(""), share = std::nan("");  ///< shown of what the sampling leaves
  std::vector<sim::quiet_figures> last{};                   ///< window of each that is judged

  [[nodiscard]] std::string bars() const {
    std::string all;
    for (std::size_t i = 0; i < missed.size(); ++i) {
      if (missed[i] == 0) continue;
      all += (all.empty() ? "" : ", ") + std::to_string(missed[i]) + " by " +
             sim::to_string(static_cast<sim::quiet_bar>(i));
    }
    return all.empty() ? "-" : all;
  }
};
inline ex::record record_of(const quiet_row& r) {
  return {{"scene", r.scene},
          {"hand", r.hand},
          {"cases", r.judged},
          {"left_out", r.cases - r.judged},
          {"unsettled", r.unsettled},
          {"slides", r.slides},
          {"missed", r.bars()},
          {"median_s", r.median, "%.2f"},
          {"slowest_s", r.slowest, "%.2f"},
          {"step_N", r.step, "%.4f"},
          {"free_mm_per_s", r.fastest * 1e3, "%.1f"},
          {"least_energy_J", r.least_energy},
          {"asked_N_per_m", r.asked, "%.0f"},
          {"shown_N_per_m", r.shown, "%.0f"},
          {"shown_of_possible", r.share, "%.2f"},
          {"least_of_possible", r.least_share, "%.2f"}};
}

[[nodiscard]] inline double median_of(std::vector<double> all) {
  if (all.empty()) return std::nan("");
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

/// Runs one(i) for the scenes of the row and adds their results to it.
inline quiet_row judged(quiet_row row, auto one) {
  std::vector<double> times, asked, shown, share;
  for (int i = 0; i < row.cases; ++i) {
    const quiet_run r = one(i);
    row.least_energy = std::min(row.least_energy, r.least_energy);
    row.lost += r.least_energy >= -r.loss_allowed ? 0 : 1;
    if (!r.counts()) continue;
    ++row.judged;
    row.last.push_back(r.last);
    row.step = std::max(row.step, r.last.step);
    row.fastest = std::max(row.fastest, r.free);
    if (r.settling > row.in_time) {
      ++row.slides;
    } else if (!(r.settling <= row.in_time)) {
      if (row.unsettled++ == 0) row.first_unsettled = i;
      ++row.missed[static_cast<std::size_t>(r.missed)];
      continue;
    }
    times.push_back(r.settling);
    asked.push_back(r.asked);
    shown.push_back(r.shown);
    share.push_back(r.shown / r.can_be);
  }
  row.median = median_of(times);
  row.slowest = times.empty() ? 0.0 : *std::max_element(times.begin(), times.end());
  row.asked = median_of(asked);
  row.shown = median_of(shown);
  row.share = median_of(share);
  if (!share.empty()) row.least_share = *std::min_element(share.begin(), share.end());
  return row;
}

/// A sentence for each bar that a row misses.
inline void expect_quiet(std::vector<std::string>& found, const quiet_row& r) {
  const std::string name = r.scene + ", hand " + r.hand + ": ";
  expect(found, r.unsettled == 0,
         name + std::to_string(r.unsettled) + " of " + std::to_string(r.judged) +
             " are not quiet after " + ex::format("%g", r.in_time) + " s (" + r.bars() +
             "; the first is number " + std::to_string(r.first_unsettled) + ")");
  const bool held = r.hand == still_hands[1].name || r.hand == still_hands[2].name;
  expect(found, held ? r.slides == 0 : 20 * r.slides <= std::max(r.judged, 20),
         name + std::to_string(r.slides) + " slide for longer than 5 s");
  expect(found, r.lost == 0, name + std::to_string(r.lost) + " lose energy");
  expect(found, 2 * r.judged > r.cases, name + "most of the scenes are left out");
}

}  // namespace contacts
