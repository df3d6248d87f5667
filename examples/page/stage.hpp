// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A stage: one hand, one world, two devices, each with a controller of its own.
//
//   hand ─▶ device 0 ─▶ controller 0 ─┐    the world tells each of them by a channel of its own,
//     └───▶ device 1 ─▶ controller 1 ─┴──▶ late and with losses; what they did stands in rows to be drawn
//
// Time is virtual: a tick is a millisecond, however long the page takes for it.

#include "any_touch.hpp"
#include <passive_haptics/simulation/channel.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/quiet.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>

namespace page {

namespace sim = ph::simulation;

/// A place in the picture [m]: across and up.
struct place {
  double x = 0, y = 0;
};

/// What the page plots and saves, one row a tick.
struct row {
  double time, x, y, hand_x, hand_y, force_x, force_y, port, ledger, behind, event, touching;
};
inline constexpr int rows_kept = 8192;

/// What the page puts into words.
struct verdict {
  double made = 0;      ///< energy that the controller has made, −min E [J]
  double buzz = 0;      ///< frequency at which the force swings, 0 if it does not [Hz]
  double swing = 0;     ///< by so much, in the window [N]
  double behind = 0;    ///< how far the device is behind the true surface, force accounted for [m]
  double settled = 0;   ///< 1: in touch, and at rest
  double touching = 0;  ///< 1: some force in the window
  double force = 0;     ///< now [N]
  double event = 0;     ///< the worst of the window
  double worst = 0;     ///< the largest step of the force since the start [N]

  // What the library's judge of quiet says of the last 100 ms (simulation/quiet.hpp).
  double still = 0;  ///< time since the last news: hand, surface or a slider moved [s]
  double quiet = 0;  ///< 1: within the bars
  double since = 0;  ///< from the news until it was quiet [s]; NaN: it is not
  double rms = 0, speed = 0, step = 0;              ///< [N] above 10 Hz, [m/s], [N] a tick
  double rms_bar = 0, speed_bar = 0, step_bar = 0;  ///< the bars, those of encoder steps too
  double asked = 0, shown = 0;  ///< stiffness where it is touched [N/m]; 0: it is not
};

/// A plane in the picture: a point and a unit normal.
struct drawn_plane {
  place point, normal;
};

/// One of the two: its last seconds, and what is to be said of them.
class record {
 public:
  void clear() noexcept {
    count_ = 0;
    worst_ = last_x_ = last_y_ = 0;
  }
  void add(const row& r) noexcept {
    rows_[static_cast<std::size_t>(count_++ % rows_kept)] = r;
    const double dx = r.force_x - last_x_;
    const double dy = r.force_y - last_y_;
    const double step = std::sqrt(dx * dx + dy * dy);
    if (count_ > 1 && step > worst_) worst_ = step;
    last_x_ = r.force_x;
    last_y_ = r.force_y;
  }
  [[nodiscard]] const row* rows() const noexcept { return rows_.data(); }
  [[nodiscard]] std::int64_t count() const noexcept { return count_; }

  [[nodiscard]] verdict judge(double least_energy) const noexcept {
    verdict v{.made = 0 - least_energy, .worst = worst_};
    const int n = static_cast<int>(count_ < window ? count_ : window);
    if (n < window) return v;
    double mean = 0, low = 1e9, high = -1e9, lowest = 1e9, highest = -1e9;
    auto worst = ph::event::nominal;
    for (int i = 0; i < n; ++i) {
      const row& r = ago(i);
      const double f = size(r);
      mean += f / n;
      low = f < low ? f : low;
      high = f > high ? f : high;
      lowest = r.y < lowest ? r.y : lowest;
      highest = r.y > highest ? r.y : highest;
      v.touching = r.touching > v.touching ? r.touching : v.touching;
      worst = ph::worse(worst, static_cast<ph::event>(static_cast<int>(r.event)));
    }
    v.event = static_cast<int>(worst);
    const row& now = ago(0);
    v.force = size(now);
    v.behind = now.behind;
    v.swing = high - low;
    // Crossings of the mean, with a hysteresis of a tenth of the swing.
    int up = 0;
    bool above = size(ago(n - 1)) > mean;
    for (int i = n - 2; i >= 0; --i) {
      const double f = size(ago(i)) - mean;
      if (!above && f > 0.1 * v.swing) {
        above = true;
        ++up;
      } else if (above && f < -0.1 * v.swing) {
        above = false;
      }
    }
    const double frequency = up / (n * tick_length);
    if (v.swing > 0.5 && frequency >= 6) v.buzz = frequency;
    v.settled = v.touching > 0 && v.swing < 0.1 && highest - lowest < 3e-5 ? 1 : 0;
    return v;
  }

 private:
  static constexpr int window = 300;  ///< [ticks]

  [[nodiscard]] const row& ago(int i) const noexcept {
    return rows_[static_cast<std::size_t>((count_ - 1 - i) % rows_kept)];
  }
  [[nodiscard]] static double size(const row& r) noexcept {
    return std::sqrt(r.force_x * r.force_x + r.force_y * r.force_y);
  }

  std::array<row, rows_kept> rows_{};
  std::int64_t count_ = 0;
  double worst_ = 0, last_x_ = 0, last_y_ = 0;
};

/// A hand goes to where it is sent, no faster than a person; by itself, it follows way points.
struct way_point {
  double until;  ///< [s], from the start of the round
  place at;
};

class guided_hand {
 public:
  void begin(place home) noexcept { at_ = goal_ = home; }
  void send(place goal) noexcept { goal_ = goal; }
  void step() noexcept {
    const double dx = goal_.x - at_.x;
    const double dy = goal_.y - at_.y;
    const double way = std::sqrt(dx * dx + dy * dy);
    constexpr double most = 0.4 * tick_length;
    const double share = way > most ? most / way : 1.0;
    velocity_ = {share * dx / tick_length, share * dy / tick_length};
    at_ = {at_.x + share * dx, at_.y + share * dy};
  }
  [[nodiscard]] place at() const noexcept { return at_; }
  [[nodiscard]] place velocity() const noexcept { return velocity_; }
  [[nodiscard]] bool moves() const noexcept {
    return velocity_.x * velocity_.x + velocity_.y * velocity_.y > 1e-12;
  }

 private:
  place at_, goal_, velocity_;
};

/// What the C interface sees of a stage.
class stage {
 public:
  stage() = default;
  stage(const stage&) = delete;
  stage& operator=(const stage&) = delete;

  [[nodiscard]] virtual int controllers() const noexcept = 0;
  [[nodiscard]] virtual const char* name(int i) const noexcept = 0;
  [[nodiscard]] virtual const char* says(int i) const noexcept = 0;
  [[nodiscard]] virtual const char* text(int i) const noexcept = 0;
  [[nodiscard]] virtual int promise(int i) const noexcept = 0;
  /// From the next restart() on.
  virtual void choose(int side, int controller) noexcept = 0;
  virtual void restart() noexcept = 0;
  virtual void tick() noexcept = 0;
  [[nodiscard]] virtual double least_energy(int side) const noexcept = 0;
  /// What the judge of quiet says of a side.
  virtual void judge(int side, verdict& said) const noexcept = 0;
  virtual int draw(int side, bool local, std::span<drawn_plane> planes) const noexcept = 0;
  /// Triangles of a body as they are seen, if there is one: three corners for each; how many corners.
  virtual int outline(int /*side*/, std::span<place> /*corners*/) const noexcept { return 0; }
  [[nodiscard]] virtual place home() const noexcept = 0;
  /// Where the hand goes by itself.
  [[nodiscard]] virtual std::span<const way_point> round() const noexcept = 0;

  settings set{};
  record seen[2];
  guided_hand hand;
  bool by_itself = false;

  void run(int ticks) noexcept {
    for (int i = 0; i < ticks; ++i) {
      if (by_itself) hand.send(on_round());
      hand.step();
      still = hand.moves() || set.heave != 0 || set.tilt != 0 ? 0 : still + 1;
      tick();
      time += tick_length;
    }
  }
  double time = 0;
  int still = 0;  ///< ticks since the last news

 private:
  [[nodiscard]] place on_round() const noexcept {
    const auto way = round();
    double t = time - way.back().until *
                          static_cast<double>(static_cast<long long>(time / way.back().until));
    for (const way_point& w : way) {
      if (t < w.until) return w.at;
    }
    return way.back().at;
  }
};

/// The device in a hand that a scene is felt with: as Scene::device says, or a stiff one.
template <class Scene>
struct device_in {
  using Space = typename Scene::touch::Space;
  using type = sim::device<Space, sim::impedance_hand<Space>>;
};
template <class Scene>
requires requires {
  typename Scene::device;
}
struct device_in<Scene> {
  using type = typename Scene::device;
};

/// Scene is the world: what its surfaces are now, and what it publishes of them, which is the same unless it has a
/// publish() of its own.
template <class Scene>
class stage_of final : public stage {
 public:
  using touch = typename Scene::touch;
  using Space = typename touch::Space;
  using vector = typename Space::vector;
  using news = typename touch::news;
  using device = typename device_in<Scene>::type;

  stage_of() noexcept { set = Scene::begins_with(); }

  int controllers() const noexcept override { return static_cast<int>(Scene::menu.size()); }
  const char* name(int i) const noexcept override { return line(i).name; }
  const char* says(int i) const noexcept override { return line(i).says; }
  const char* text(int i) const noexcept override { return line(i).text; }
  int promise(int i) const noexcept override { return static_cast<int>(line(i).promise); }

  void choose(int side, int controller) noexcept override { sides_[side].chosen = controller; }

  void restart() noexcept override {
    time = 0;
    still = 0;
    hand.begin(Scene::home);
    for (int i = 0; i < 2; ++i) {
      one& s = sides_[i];
      if constexpr (requires { s.world.restart(set); }) s.world.restart(set);
      s.controller.let_go();
      s.controller = line(s.chosen).make(told(set));
      const sim::impedance_hand<Space> holding{.stiffness = set.hand_stiffness,
                                               .damping = 2,
                                               .limit = set.hand_force,
                                               .target = into(Scene::home)};
      if constexpr (requires { typename Scene::device; }) {
        s.body = device(set, into(Scene::home), holding);
      } else {
        s.body = device({.mass = set.mass,
                         .damping = set.damping,
                         .friction = set.friction,
                         .force_limit = set.motors,
                         .quantum = set.quantum,
                         .lower = sim::every_axis<Space>(-0.1),
                         .upper = sim::every_axis<Space>(0.1),
                         .period = tick_length,
                         .start = into(Scene::home),
                         .latency = static_cast<int>(set.late)},
                        holding);
      }
      s.network = channel({.delay = set.latency, .loss = set.loss}, 7);
      s.next_news = 0;
      s.least = 0;
      s.judge = sim::quiet_judge<Space>();
      s.asked = s.shown = s.next_press = 0;
      s.now = s.body.exchange(Space::zero());
      seen[i].clear();
    }
  }

  void tick() noexcept override {
    for (int i = 0; i < 2; ++i) tick_of(sides_[i], seen[i]);
  }

  double least_energy(int side) const noexcept override { return sides_[side].least; }
  void judge(int side, verdict& v) const noexcept override {
    const one& s = sides_[side];
    const sim::quiet_figures last = s.judge.figures();
    const sim::quiet_bars bars = s.judge.bars();
    v.still = still * tick_length;
    v.quiet = s.judge.quiet() ? 1 : 0;
    v.since = s.judge.settling();
    v.rms = last.force, v.speed = last.speed, v.step = last.step;
    v.rms_bar = bars.force, v.speed_bar = bars.speed, v.step_bar = bars.step;
    v.asked = v.touching > 0 ? s.asked : 0;
    v.shown = v.touching > 0 ? s.shown : 0;
  }

  int draw(int side, bool local, std::span<drawn_plane> planes) const noexcept override {
    const one& s = sides_[side];
    const news all = local ? s.controller.local() : s.world.surfaces(time, set);
    int n = 0;
    for (const auto& plane : all) {
      planes[static_cast<std::size_t>(n++)] = {out_of(vector(plane.point)),
                                               out_of(vector(plane.normal))};
    }
    return n;
  }
  int outline(int side, std::span<place> corners) const noexcept override {
    if constexpr (requires { sides_[0].world.outline(corners); }) {
      return sides_[side].world.outline(corners);
    }
    return 0;
  }
  place home() const noexcept override { return Scene::home; }
  std::span<const way_point> round() const noexcept override { return Scene::round; }

 private:
  using channel = sim::channel<news, 128>;
  using coordinates = typename Space::coordinates;

  /// One side of the page.
  struct one {
    int chosen = 0;
    Scene world{};
    touch controller = Scene::menu[0].make(told(settings{}));
    device body{};
    channel network{};
    double next_news = 0;
    double least = 0;  ///< of what the hand has paid, its friction counted [J]
    sim::quiet_judge<Space> judge{sim::quiet_bars{}};
    double asked = 0, shown = 0;  ///< stiffness at the last press [N/m]
    double next_press = 0;        ///< [s]
    ph::device_sample<Space> now{};
  };

  [[nodiscard]] static const auto& line(int i) noexcept {
    const bool known = i >= 0 && i < static_cast<int>(Scene::menu.size());
    return Scene::menu[static_cast<std::size_t>(known ? i : 0)];
  }
  [[nodiscard]] static coordinates into(place p) noexcept {
    if constexpr (Space::dof == 1) return p.y;
    if constexpr (Space::dof == 2) return {p.x, p.y};
    if constexpr (Space::dof == 3) return {p.x, 0, p.y};
  }
  [[nodiscard]] static place out_of(const vector& v) noexcept {
    if constexpr (Space::dof == 1) return {0, v};
    if constexpr (Space::dof == 2) return {v(0), v(1)};
    if constexpr (Space::dof == 3) return {v(0), v(2)};
  }

  [[nodiscard]] news told_by(one& s) const noexcept {
    if constexpr (requires { s.world.publish(time, set, vector(s.body.position()), s.now.held); }) {
      return s.world.publish(time, set, vector(s.body.position()), s.now.held);
    } else {
      return s.world.surfaces(time, set);
    }
  }
  void tick_of(one& s, record& record) noexcept {
    if (time >= s.next_news) {
      s.network.send(told_by(s), time);
      s.next_news += 1 / set.rate;
      if (s.next_news < time) s.next_news = time;
    }
    while (const news* arrived = s.network.take(time)) s.controller.hear(*arrived);
    const auto out = s.controller.tick(s.now);
    s.body.hand().aim(vector(into(hand.at())), vector(into(hand.velocity())), s.body.time());
    if constexpr (requires { s.body.alone = by_itself; }) s.body.alone = by_itself;
    s.now = s.body.exchange(out.force);
    const vector position = s.body.position();
    const place at = out_of(position), force = out_of(s.now.held);
    const news walls = s.world.surfaces(time, set);
    const double behind = behind_of(s, walls, position);
    const double energy = s.body.meter().with_friction();
    if (energy < s.least) s.least = energy;
    listen(s, walls, position, out.force);
    place held_at = hand.at();
    if constexpr (requires { s.body.alone; }) held_at = at;
    record.add({s.body.time(), at.x, at.y, held_at.x, held_at.y, force.x, force.y, energy,
                out.ledger, behind, static_cast<double>(out.what),
                Space::norm(s.now.held) > 0.02 ? 1.0 : 0.0});
  }

  /// How deep the device is in the true surface, less what a spring of its stiffness gives way for the
  /// force that is there; the most of all surfaces.
  [[nodiscard]] static double behind_of(const one& s, const news& walls, const vector& x) noexcept {
    double most = 0;
    for (const auto& plane : walls) {
      const vector normal = plane.normal;
      const double pressed = Space::dot(normal, s.now.held) / plane.stiffness;
      most = ph::kernels::larger(most, depth_of(plane, x) - (pressed > 0 ? pressed : 0.0));
    }
    return most;
  }
  [[nodiscard]] static double depth_of(const auto& plane, const vector& x) noexcept {
    return Space::dot(vector(vector(plane.point) - x), vector(plane.normal));
  }

  /// What the judge of quiet hears in a tick; and ten times a second how stiff the surface is shown.
  void listen(one& s, const news& walls, const vector& x, const vector& command) noexcept {
    std::array<vector, std::tuple_size_v<news>> pressing{};
    std::size_t n = 0;
    double deepest = 0, asked = 0;
    for (const auto& plane : walls) {
      const double depth = depth_of(plane, x);
      if (depth > 0) pressing[n++] = plane.normal;
      if (depth > deepest) deepest = depth, asked = plane.stiffness;
    }
    if (still == 1) s.judge.news();
    s.judge.add(command, vector(s.body.velocity()), tick_length, std::span(pressing).first(n));
    if (s.now.valid && deepest > 0 && s.judge.time() >= s.next_press) press(s, command, asked);
  }
  /// Presses a copy of the controller deeper along its force by 1 µm, or a step of the encoders. Those steps are a
  /// floor of quiet, and without friction in the device four of them are (docs/design/settling.md).
  void press(one& s, const vector& command, double asked) noexcept {
    const double size = Space::norm(command);
    if (!(size > 0.02)) return;
    s.next_press = s.judge.time() + 0.1;
    touch copy = s.controller;
    const double by = set.quantum > 0 ? set.quantum : 1e-6;
    const vector push = command * (1 / size);
    const auto at = [&](const vector& x) {
      ph::device_sample<Space> still_there = s.now;
      still_there.position = x;
      for (int i = 0; i < 9; ++i) still_there.held = copy.tick(still_there).force;
      return vector(still_there.held);
    };
    const vector here(s.now.position), before = at(here), after = at(vector(here - push * by));
    s.asked = asked;
    s.shown = ph::kernels::larger(0.0, Space::dot(vector(after - before), push) / by);
    s.judge.judge_by(
        sim::quiet_bars{}.on_encoders(set.quantum * (set.friction > 0 ? 1 : 4), s.shown, set.mass));
  }

  one sides_[2];
};

}  // namespace page
