// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A scope: it keeps the last N ticks of a loop, to be read afterwards.
//
//     static ph::scope<scene, 4096> seen{ph::event::late_tick};   // freezes N/2 ticks after that event
//     …  const auto out = wall.tick(sample);  seen.record(sample, out);        // in the loop
//     …  seen.explain(wall.explain());         // before record(), to record why the force is smaller than asked for
//     …  if (seen.frozen()) ph::save(seen, "scope.csv");                       // elsewhere, afterwards
//     gnuplot -e "file='scope.csv'" examples/scope.gp
//
// record() copies a row and needs no heap, lock, clock or file. Another thread may read the rows once
// frozen() is true; the loop's own thread, or any thread after the loop, may read them at any time. A scope
// holds N rows of some 100 bytes each, so make it static. It works at any port, with any source.

#include <passive_haptics/base/explanation.hpp>
#include <passive_haptics/base/seconds.hpp>
#include <passive_haptics/port/concepts.hpp>

#include <array>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// One tick.
template <class Port>
struct scope_row {
  std::uint64_t tick = 0;  ///< number of the row in the recording, from 0
  double time = 0.0;       ///< sum of dt up to here [s]
  typename Port::scalar dt{};
  typename Port::stored_pose position{};
  typename Port::stored_effort wanted{};  ///< effort before the bound, if record() was given it
  typename Port::stored_effort given{};   ///< effort after the bound
  typename Port::scalar depth{};          ///< depth, if the result has one [m]
  typename Port::scalar energy{};         ///< E1 [J]
  double asked{}, shown{};                ///< stiffness, if the port explained itself [N/m]
  event what = event::nominal;
  softened_by stiffness = softened_by::nothing;  ///< reason why `shown` < `asked`
  softened_by now = softened_by::nothing;        ///< reason why `given` < `shown`·`depth`
  bool limited = false;
  bool valid = false;  ///< the sample was valid
  bool has_wanted = false;
  bool has_depth = false;
  bool is_explained = false;
};

/// Keeps the last N rows. With a trigger it freezes N/2 rows after the first event that is at least as
/// severe, so it shows N/2 rows before the event and N/2 from it on.
template <port Port, std::size_t N>
class scope {
  static_assert(N >= 2, "passive_haptics: a scope keeps two ticks or more");

 public:
  using row = scope_row<Port>;
  using pose = typename Port::pose;
  using effort = typename Port::effort;
  using scalar = typename Port::scalar;

  scope() noexcept = default;
  explicit scope(event least) noexcept : least_(least), armed_(true) {}

  /// Adds a row. Call it in the loop after the tick, with the result `out` of that tick.
  template <class Result>
  void record(const device_sample<Port>& sample, const Result& out) noexcept {
    keep(sample.position, sample.dt, sample.valid, nullptr, out);
  }
  template <class Result>
  void record(const device_sample<Port>& sample, const Result& out, const effort& wanted) noexcept {
    keep(sample.position, sample.dt, sample.valid, &wanted, out);
  }
  template <class Result>
  void record(const pose& position, seconds<scalar> dt, const Result& out) noexcept {
    keep(position, dt.count(), true, nullptr, out);
  }
  template <class Result>
  void record(const pose& position, seconds<scalar> dt, const Result& out,
              const effort& wanted) noexcept {
    keep(position, dt.count(), true, &wanted, out);
  }
  /// Deleted: a bare number as dt could as well be a position.
  template <std::convertible_to<scalar> Number, class Result>
  void record(const pose& /*position*/, const Number& /*dt*/, const Result& /*out*/,
              const effort& /*wanted*/ = {}) noexcept {
    detail::refuse_bare_time<Number>();
  }

  /// Adds the explanation of the port to the row that is recorded next. Call it in the loop, but where time is short not
  /// in every tick, because the port's explain() takes as long as some ticks.
  void explain(const explanation& e) noexcept {
    said_ = e;
    is_said_ = true;
  }
  /// Triggers without an event, on a large force for example. Call it in the loop, before record().
  void trigger() noexcept {
    if (!triggered_) pull(written_);
  }
  /// Clears the rows and the trigger. Call it in the loop, or while no loop runs.
  void clear() noexcept {
    written_ = 0;
    time_ = 0.0;
    triggered_ = is_said_ = false;
    frozen_ = false;
  }

  /// True once nothing is recorded any more. Any thread may call it.
  [[nodiscard]] bool frozen() const noexcept { return frozen_; }
  /// The number of rows, at most N.
  [[nodiscard]] std::size_t size() const noexcept {
    return written_ < N ? static_cast<std::size_t>(written_) : N;
  }
  /// Row i, 0 being the oldest.
  [[nodiscard]] const row& operator[](std::size_t i) const noexcept {
    return rows_[static_cast<std::size_t>((written_ - size() + i) % N)];
  }
  /// True if it was triggered; and the tick of the recording in which it was.
  [[nodiscard]] bool triggered() const noexcept { return triggered_; }
  [[nodiscard]] std::uint64_t triggered_at() const noexcept { return at_; }

 private:
  template <class Result>
  void keep(const pose& position, scalar dt, bool valid, const effort* wanted,
            const Result& out) noexcept {
    if (frozen_) return;
    if (kernels::is_finite(dt) && dt > scalar(0)) time_ += static_cast<double>(dt);
    row& r = rows_[static_cast<std::size_t>(written_ % N)];
    r.tick = written_;
    r.time = time_;
    r.dt = dt;
    r.position = position;
    r.given = out.force;
    r.has_wanted = wanted != nullptr;
    if (wanted != nullptr) r.wanted = *wanted;
    if constexpr (detail::says_depth<decltype(out)>) {
      r.depth = out.depth;
      r.has_depth = true;
    }
    r.is_explained = std::exchange(is_said_, false);
    r.asked = said_.asked;
    r.shown = said_.shown;
    r.stiffness = said_.stiffness;
    r.now = said_.now;
    r.energy = out.energy;
    r.what = out.what;
    r.limited = out.limited;
    r.valid = valid;
    if (armed_ && !triggered_ && worse(out.what, least_) == out.what) pull(written_);
    ++written_;
    if (triggered_ && written_ - at_ >= N - N / 2) frozen_ = true;
  }
  void pull(std::uint64_t tick) noexcept {
    triggered_ = true;
    at_ = tick;
  }

  std::array<row, N> rows_{};
  std::uint64_t written_ = 0, at_ = 0;
  double time_ = 0.0;
  event least_ = event::nominal;
  explanation said_{};
  bool armed_ = false, triggered_ = false, is_said_ = false;
  std::atomic<bool> frozen_{false};
};

/// The units of a port, for the names of the columns.
struct scope_units {
  const char* position;
  const char* effort;
};

namespace detail {

template <class Pose>
inline constexpr bool is_turned = requires(const Pose& x) {
  x.orientation;
};

/// Metres and newtons in a space, radians and newton metres in joints. Name others for joints that slide.
template <class Port>
[[nodiscard]] constexpr scope_units usual_units() noexcept {
  if constexpr (detail::has_geometry<Port> || is_turned<typename Port::stored_pose>) {
    return {"m", "N"};
  } else {
    return {"rad", "Nm"};
  }
}

/// A line of fields. Numbers are written without a locale, with all digits that reading them back needs.
class csv_line {
 public:
  void text(const char* s) { (text_ += comma()) += s; }
  template <class Number>
  void number(Number x) {
    text_ += comma();
    if constexpr (std::is_same_v<Number, float> || std::is_integral_v<Number>) {
      put(x);
    } else {
      put(static_cast<double>(x));
    }
  }
  [[nodiscard]] const char* end() {
    text_ += '\n';
    return text_.c_str();
  }
  void clear() {
    text_.clear();
    first_ = true;
  }

 private:
  const char* comma() {
    const char* separator = first_ ? "" : ",";
    first_ = false;
    return separator;
  }
  template <class Number>
  void put(Number x) {
    std::array<char, 40> digits{};
    const auto to = std::to_chars(digits.data(), digits.data() + digits.size(), x);
    text_.append(digits.data(), to.ptr);
  }

  std::string text_;
  bool first_ = true;
};

/// _x, _y, _z in a space, _1, _2, … in joints, and nothing where there is only one axis.
template <class Port>
[[nodiscard]] inline std::string axis_name(int i, int count) {
  if (count == 1) return "";
  if constexpr (detail::has_geometry<Port> || is_turned<typename Port::stored_pose>) {
    return std::string("_") + "xyz"[i % 3];
  } else {
    return "_" + std::to_string(i + 1);
  }
}

template <class Port>
void name_columns(csv_line& line, const scope_units& units) {
  const auto name = [&line](const std::string& s) { line.text(s.c_str()); };
  const auto axes = [&](const std::string& what, int count, const std::string& unit) {
    for (int i = 0; i < count; ++i) name(what + axis_name<Port>(i, count) + "_" + unit);
  };
  const auto efforts = [&](const std::string& what) {
    if constexpr (is_turned<typename Port::stored_pose> && Port::dof == 6) {
      axes(what, 3, units.effort);
      axes(what + "_torque", 3, "Nm");
    } else {
      axes(what, Port::dof, units.effort);
    }
  };
  name("tick");
  name("time_s");
  name("dt_s");
  if constexpr (is_turned<typename Port::stored_pose>) {
    axes("position", 3, units.position);
    for (const char* part : {"w", "x", "y", "z"}) name(std::string("orientation_") + part);
  } else {
    axes("position", Port::dof, units.position);
  }
  efforts("wanted");
  efforts("given");
  name(std::string("depth_") + units.position);
  name("energy_J");
  name("limited");
  name("valid");
  name("event");
  name("event_text");
  const std::string stiffness = std::string("_") + units.effort + "_per_" + units.position;
  name("asked" + stiffness);
  name("shown" + stiffness);
  name("softened_by");
  name("held_back_by");
}

template <class Port>
void write_row(csv_line& line, const scope_row<Port>& r) {
  line.number(r.tick);
  line.number(r.time);
  line.number(r.dt);
  if constexpr (is_turned<typename Port::stored_pose>) {
    using place = typename Port::body_space;
    for (int i = 0; i < 3; ++i) line.number(place::component(r.position.position, i));
    const auto& q = r.position.orientation;
    for (const auto part : {q.w, q.x, q.y, q.z}) line.number(part);
  } else {
    for (int i = 0; i < Port::dof; ++i) line.number(Port::component(r.position, i));
  }
  for (int i = 0; i < Port::dof; ++i) {
    r.has_wanted ? line.number(Port::component(r.wanted, i)) : line.text("");
  }
  for (int i = 0; i < Port::dof; ++i) line.number(Port::component(r.given, i));
  r.has_depth ? line.number(r.depth) : line.text("");
  line.number(r.energy);
  line.number(r.limited ? 1 : 0);
  line.number(r.valid ? 1 : 0);
  line.number(static_cast<int>(r.what));
  line.text(to_string(r.what));
  r.is_explained ? line.number(r.asked) : line.text("");
  r.is_explained ? line.number(r.shown) : line.text("");
  line.text(r.is_explained ? to_string(r.stiffness) : "");
  line.text(r.is_explained ? to_string(r.now) : "");
}

}  // namespace detail

/// Writes a heading with units and a line for each row, the oldest first, with empty fields for what was not
/// recorded. Returns false if the file cannot be written. Do not call it in the loop.
template <class Port, std::size_t N>
bool save(const scope<Port, N>& seen, const char* path,
          const scope_units& units = detail::usual_units<Port>()) {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return false;
  detail::csv_line line;
  detail::name_columns<Port>(line, units);
  bool good = std::fputs(line.end(), file) >= 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    line.clear();
    detail::write_row<Port>(line, seen[i]);
    good = std::fputs(line.end(), file) >= 0 && good;
  }
  return std::fclose(file) == 0 && good;
}

}  // namespace v0
}  // namespace passive_haptics
