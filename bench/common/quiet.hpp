// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The columns on quiet, for every table that has joules: how many runs come to rest, how calm they are there, and how
// stiff the contact is that they rest on, beside the stiffness asked for.
//
//     experiments::at_rest still;
//     still.add(judge, {.asked = K, .shown = shown_by(force_at, x)});   // for each run
//     return ex::with({{"scene", …}, {"least_energy_J", …}}, still);    // the columns at the end of the row
//
// A device has to be quiet (simulation/quiet.hpp) by 5 s after the last news: from then on hand and world hold still.

#include "record.hpp"
#include <passive_haptics/simulation/quiet.hpp>

#include <array>
#include <span>

namespace experiments {

namespace sim = passive_haptics::simulation;

/// The time by which a device has to be quiet [s]. A run goes on for longer, because a hop is quiet in the air.
inline constexpr double quiet_in = 5.0;
/// The length of a run after the last news [s].
inline constexpr double quiet_watched = 6.0;
/// By how much a resting contact is pressed for its stiffness [m].
inline constexpr double probe_by = 1e-6;

/// The time since which it is quiet [s]; NaN if it is not quiet in time.
[[nodiscard]] inline double quiet_in_time(const auto& judge) {
  return judge.settling() <= quiet_in ? judge.since() : std::nan("");
}
/// "0.40 s", or the bar that was missed last.
[[nodiscard]] inline std::string quiet_since(double since, sim::quiet_bar missed) {
  return std::isfinite(since) ? format("%.2f s", since)
                              : "no: " + std::string(sim::to_string(missed));
}
/// What is displayed at most of a wall of stiffness K [N/m]: κ m/T², the stiffest that is sampled.
[[nodiscard]] inline double sampled_at_most(double K, double mass) {
  return std::min(K, 0.1 * mass / 1e-6);
}
/// The bars for such a wall on a device with encoders of step `quantum` [m], and their floor K q [N].
[[nodiscard]] inline sim::quiet_bars quiet_on(double K, double quantum, double mass) {
  return sim::quiet_bars{}.on_encoders(quantum, sampled_at_most(K, mass), mass);
}
[[nodiscard]] inline double floor_on(double K, double quantum, double mass) {
  return sampled_at_most(K, mass) * quantum;
}

/// The unit normals of those of the first `count` slots that press.
template <class Vector>
[[nodiscard]] std::span<const Vector> pressing(const auto& source, int count,
                                               std::vector<Vector>& room) {
  room.clear();
  for (int i = 0; i < count; ++i) {
    const auto& slot = source.slot(i);
    if (slot.pressed() > 0.0) room.push_back(slot.normal());
  }
  return room;
}
/// The stiffness of a contact at rest [N/m].
struct rest_stiffness {
  double asked = std::nan("");  ///< of its surface
  double shown = std::nan("");  ///< by its force
};
/// What a contact shows along its force [N/m], pressed by 1 µm. force_at(x) is a tick of a copy of its port there [N].
template <class Vector>
[[nodiscard]] double shown_by(auto force_at, const Vector& x) {
  const auto rested = [&](const Vector& where) {
    Vector f = force_at(where);
    for (int i = 1; i < 9; ++i) f = force_at(where);
    return f;
  };
  const Vector f = rested(x);
  const Vector push = f.normalized();
  return push.dot(rested(Vector(x - probe_by * push)) - f) / probe_by;
}

/// Force over depth while it is held, which on encoders says more than a push by less than a step.
class held_stiffness {
 public:
  /// Adds a tick: the outward force [N] and the true depth [m].
  void add(double force, double depth) noexcept {
    if (!(depth > 0.0)) return;
    force_ += force;
    depth_ += depth;
  }
  [[nodiscard]] double shown() const noexcept {
    return depth_ > 0.0 ? force_ / depth_ : std::nan("");
  }

 private:
  double force_ = 0.0, depth_ = 0.0;
};

/// What the runs of a row come to where hand and world hold still.
class at_rest {
 public:
  /// Adds a run that ended as the judge says.
  void add(const auto& judge, const rest_stiffness& contact = {}) {
    add(judge.settling(), judge.missed(), judge.figures(), contact);
  }
  /// The same in figures: the time from the last news until it was quiet [s], NaN if it was not.
  void add(double settling, sim::quiet_bar missed, const sim::quiet_figures& last,
           const rest_stiffness& contact) {
    ++runs_;
    step_ = std::max(step_, last.step);
    speed_ = std::max(speed_, last.speed);
    if (settling <= quiet_in) {
      ++quiet_;
      slowest_ = std::fmax(slowest_, settling);
      if (std::isfinite(contact.shown)) contacts_.push_back(contact);
    } else {
      missed_ = missed;
    }
  }
  void add(const at_rest& other) {
    runs_ += other.runs_;
    quiet_ += other.quiet_;
    step_ = std::max(step_, other.step_);
    speed_ = std::max(speed_, other.speed_);
    slowest_ = std::fmax(slowest_, other.slowest_);
    floor_ = std::max(floor_, other.floor_);
    if (other.quiet_ < other.runs_) missed_ = other.missed_;
    contacts_.insert(contacts_.end(), other.contacts_.begin(), other.contacts_.end());
  }
  /// The bars were those of encoders, of which the force steps by K q [N].
  void on_floor(double Kq) { floor_ = std::max(floor_, Kq); }

  [[nodiscard]] int runs() const { return runs_; }
  [[nodiscard]] int quiet() const { return quiet_; }
  [[nodiscard]] bool all_quiet() const { return runs_ > 0 && quiet_ == runs_; }
  /// "6 of 6", or "4 of 6: q3 step" by the bar that the last of the others has missed.
  [[nodiscard]] std::string share() const {
    if (runs_ == 0) return "-";
    const std::string all = std::to_string(quiet_) + " of " + std::to_string(runs_);
    return quiet_ == runs_ ? all : all + ": " + sim::to_string(missed_);
  }
  /// The columns. Settled: the slowest of the quiet; step and speed: the largest of all, at the end; stiffness: of the
  /// quiet run with the median share of what was asked for.
  [[nodiscard]] record columns() const {
    const bool any = runs_ > 0;
    const rest_stiffness middle = median();
    record all{{"quiet", share()},
               {"settled_s", slowest_, "%.2f"},
               {"rest_step_N", any ? step_ : std::nan(""), "%.4f"},
               {"rest_mm_per_s", any ? speed_ * 1e3 : std::nan(""), "%.3f"},
               {"asked_N_per_m", middle.asked, "%.0f"},
               {"shown_N_per_m", middle.shown, "%.0f"}};
    return all;
  }
  /// K q [N], the largest of the runs.
  [[nodiscard]] double floor() const { return floor_; }

 private:
  [[nodiscard]] rest_stiffness median() const {
    if (contacts_.empty()) return {};
    auto all = contacts_;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end(), [](const auto& a, const auto& b) {
      return a.shown * b.asked < b.shown * a.asked;
    });
    return *middle;
  }

  int runs_ = 0, quiet_ = 0;
  double slowest_ = std::nan("");    // of the quiet [s]
  double step_ = 0.0, speed_ = 0.0;  // of the last windows [N], [m/s]
  double floor_ = 0.0;               // K q [N]
  sim::quiet_bar missed_{};
  std::vector<rest_stiffness> contacts_;
};

/// A row with the columns on quiet at its end.
[[nodiscard]] inline record with(record row, const at_rest& still) {
  for (auto& column : still.columns()) row.push_back(std::move(column));
  return row;
}
/// The same on encoders: the floor K q of the force's step, which the bars stand on, before them.
[[nodiscard]] inline record with_floor(record row, const at_rest& still) {
  row.emplace_back("floor_Kq_N", still.floor(), "%.4f");
  return with(std::move(row), still);
}

/// Of every caption of such a table: what its columns mean.
inline constexpr const char* quiet_columns =
    " Quiet: of the runs, those that are so by 5 s after the last news, when hand and world hold "
    "still (docs/design/settling.md), or the bar that was missed; settled: the slowest of them; "
    "rest: the largest step of the force in a tick, and speed along what presses, of the last 0.1 "
    "s of "
    "all runs; asked, shown: the stiffness of the contact, of the run with the median share.";
/// Of the captions of tables on encoders: whose bars are judged.
inline constexpr const char* quiet_on_steps =
    " On encoders of step q the bars are K q/2, q/2 (K/m)^0.5 and K q of the stiffness displayed, "
    "where those are higher; floor: K q.";
/// Of the captions of tables whose shown stiffness is that of a held_stiffness.
inline constexpr const char* held_last_second =
    " Shown: the mean force over the mean true depth of the last second.";

}  // namespace experiments
