// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a finger would be that no triangle lets through: a ball of radius r that is drawn to the device and
// stays r away from every triangle of a mesh, at rest, moved or deformed. It has no idea of inside and outside;
// which side was touched is where the ball is.
//
//     ph::mesh::proxy finger({.radius = 5e-4});
//     finger.touch(organ);                          // a mesh::surface
//     finger.step(device, dt);                      // in every tick; then
//     finger.place();                               // where the ball is; device − place() is how far it is held off
//
// Two statements are all that it rests on:
//   rest    a half-space that a triangle T is at least r away from is free of T, so in the intersection of one
//           for each triangle nearby the ball goes any way, straight, and touches none: the shortest way to the
//           device (free_region.hpp). For a T that lies behind a half-space already none is needed.
//   motion  between two shapes nodes go straight. The ball goes with what it rests on, and while what is near
//           moves by less than d − r/2 beside it, d its distance, it stays r/2 away or more. What would move more
//           waits for the next tick.
// So the distance of the ball's centre from every triangle stays > 0 whatever comes, and nothing is passed
// through; no test of an edge, a side or a crossing is made that rounding could decide.
//
// Source: god-object (Zilles, Salisbury 1995) and proxy (Ruspini, Kolarov, Khatib 1997), from memory; the
// half-spaces by distance, and the motion of the mesh, are derived here: docs/design/meshes.md.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/mesh/free_region.hpp>
#include <passive_haptics/mesh/surface.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

struct proxy_parameters {
  double radius = 5e-4;  ///< r, of the ball [m]
  double news_speed =
      0.05;  ///< what is touched follows its news at this speed [m/s], or faster as it must
  double longest_way =
      0.05;  ///< news are followed within the time since the last ones, or this [s]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(radius >= 1e-6 && radius <= 1.0)) return {"radius", radius, "in [1e-6, 1] m"};
    if (!(news_speed > 0.0)) return {"news_speed", news_speed, "> 0 m/s"};
    if (!(longest_way > 0.0 && longest_way <= 1.0)) {
      return {"longest_way", longest_way, "in (0, 1] s"};
    }
    return {};
  }
};

class proxy {
 public:
  static constexpr int most_planes = 16;

  constexpr proxy() noexcept = default;
  constexpr explicit proxy(const proxy_parameters& p) noexcept : rule_(p) {}
  [[nodiscard]] constexpr const proxy_parameters& parameters() const noexcept { return rule_; }
  constexpr void set(const proxy_parameters& p) noexcept { rule_ = p; }

  /// From now on that surface, which must outlive this proxy, and has no other one.
  void touch(surface& s) noexcept {
    let_go();
    surface_ = &s;
    s.arrive();
    done_ = 1.0;
    nearest_ = -1;
  }
  /// No surface any more.
  void let_go() noexcept {
    surface_ = nullptr;
    reset();
  }
  /// It forgets where it was, and with that the side.
  void reset() noexcept {
    placed_ = false;
    count_ = 0;
    pressed_ = {};
  }
  [[nodiscard]] bool touching() const noexcept { return surface_ != nullptr; }
  /// It has been clear of the surface since the reset; before, it has no side and holds nothing off.
  [[nodiscard]] bool placed() const noexcept { return placed_; }

  /// The device is at x [m], dt [s] after the last step. A device that is not finite changes nothing.
  void step(const triple& x, double dt) noexcept {
    if (surface_ == nullptr || !is_finite(x) || !(dt > 0.0)) return;
    hear(dt);
    const triple own = seen(x);
    if (!placed_) {
      begin(own, dt);
      return;
    }
    const double moved = length(own - device_);
    double carried = 0.0;
    device_ = own;
    if (follows()) carried = follow(dt);
    approach(own, 1.25 * (moved + carried) + 0.125 * rule_.radius,
             3.0 * (moved + carried) + 0.5 * rule_.radius);
  }

  /// Where the ball is, in the world [m].
  [[nodiscard]] triple place() const noexcept { return shown_.out(at_) + shown_.position; }
  /// The half-spaces that it may not leave, as directions of the world, and by how much a device at the place
  /// of the last step is beyond [m]; those that press are pressed().of.
  [[nodiscard]] int planes() const noexcept { return count_; }
  [[nodiscard]] triple normal(int i) const noexcept { return shown_.out(planes_[slot(i)].normal); }
  [[nodiscard]] double depth(int i) const noexcept {
    return planes_[slot(i)].level - dot(planes_[slot(i)].normal, device_);
  }
  [[nodiscard]] const support& pressed() const noexcept { return pressed_; }
  /// The triangle that was closest, −1 before any.
  [[nodiscard]] int nearest() const noexcept { return nearest_; }
  /// The way from the last shape to the newest that is shown, in [0, 1].
  [[nodiscard]] double shown() const noexcept { return done_; }
  /// The corners of a triangle as it is shown now, in the mesh's own frame [m].
  [[nodiscard]] corners triangle(int i) const noexcept { return now().triangle(i); }
  /// The pose that is shown now.
  [[nodiscard]] const pose& where() const noexcept { return shown_; }
  /// The distance of the ball's centre from the closest triangle [m]; for tests, it looks anew.
  [[nodiscard]] double clearance() const noexcept {
    return surface_ == nullptr ? box::infinity : closest(now(), at_, box::infinity).distance;
  }

 private:
  static constexpr int most_near = 48, most_rounds = 3;
  static constexpr std::size_t slot(int i) noexcept { return static_cast<std::size_t>(i); }

  /// The mesh on its way from one shape to another.
  struct view {
    const surface* of;
    const shape *from, *to;
    double done;
    bool still;

    [[nodiscard]] triple node(int i) const noexcept {
      const triple& b = to->nodes[slot(i)];
      return still ? b : between(from->nodes[slot(i)], b, done);
    }
    [[nodiscard]] corners triangle(int i) const noexcept {
      const auto& t = of->triangles()[slot(i)];
      return {node(t[0]), node(t[1]), node(t[2])};
    }
    /// Contains what is in between, because a number between is at least what is between the least.
    [[nodiscard]] box around(int i) const noexcept {
      const box& b = to->boxes[slot(i)];
      if (still) return b;
      const box& a = from->boxes[slot(i)];
      return {between(a.low, b.low, done), between(a.high, b.high, done)};
    }
  };
  [[nodiscard]] view seen_at(double done) const noexcept {
    return {surface_, &surface_->from(), &surface_->to(), done, !surface_->moves()};
  }
  [[nodiscard]] view now() const noexcept { return seen_at(done_); }
  [[nodiscard]] triple seen(const triple& x) const noexcept {
    return shown_.in(x - shown_.position);
  }

  struct found {
    double distance = box::infinity;  ///< [m]
    int triangle = -1;
    triple weights;
    triple point;
  };
  [[nodiscard]] static found on(const view& v, int i, const triple& p) noexcept {
    const corners t = v.triangle(i);
    found f;
    f.triangle = i;
    f.weights = closest_weights(t, p);
    f.point = point_at(t, f.weights);
    f.distance = length(f.point - p);
    return f;
  }
  /// The closest point of the mesh, if it is within `reach` [m].
  [[nodiscard]] found closest(const view& v, const triple& p, double reach) const noexcept {
    found best;
    best.distance = reach;
    if (nearest_ >= 0) {
      const found likely = on(v, nearest_, p);
      if (likely.distance < reach) best = likely;
    }
    surface_->tree().walk([&](int b) { return v.around(b).squared_distance(p); },
                          [&](double d2) { return d2 < best.distance * best.distance; },
                          [&](int t) {
                            const found f = on(v, t, p);
                            if (f.distance < best.distance) best = f;
                          });
    return best;
  }

  // -------------------------------------------------------------------------------------------- news
  /// What the slow thread has to say; the way to it is begun when the last one is done.
  void hear(double dt) noexcept {
    pose_age_ += dt;
    shape_age_ += dt;
    if (const pose* news = surface_->take_pose()) {
      goal_ = *news;
      came_from_ = placed_ ? shown_ : goal_;
      pose_way_ = way_of(pose_age_, moved_by(*news), dt);
      pose_done_ = 0.0;
      pose_age_ = 0.0;
    }
    if (pose_done_ < 1.0) {
      pose_done_ = (std::min)(1.0, pose_done_ + dt / pose_way_);
      shown_ = pose_done_ < 1.0 ? between(came_from_, goal_, pose_done_) : goal_;
    }
    if (surface_->moves() && done_ >= 1.0) {
      surface_->arrive();
    } else if (surface_->moves() && done_ <= 0.0 && stuck_ < 0) {  // it has gone back
      surface_->turn_back();
      done_ = 1.0;
    }
    if (!surface_->moves()) {
      stuck_ = 0;
      if (surface_->go()) {
        done_ = 0.0;
        shape_way_ = way_of(shape_age_, touched_way(), dt);
        shape_age_ = 0.0;
      }
    }
  }
  [[nodiscard]] double way_of(double age, double distance, double dt) const noexcept {
    const double asked = (std::max)(age, distance / rule_.news_speed);
    return (std::max)((std::min)(asked, rule_.longest_way), dt);
  }
  /// How far the news move what is touched [m].
  [[nodiscard]] double moved_by(const pose& news) const noexcept {
    if (pressed_.count == 0) return 0.0;
    return length(news.out(at_) + news.position - place());
  }
  [[nodiscard]] double touched_way() const noexcept {
    double most = 0.0;
    for (std::size_t i = 0; i < slot(pressed_.count); ++i) {
      const half_space_of& h = planes_[slot(pressed_.of[i])];
      most = (std::max)(most, length(gone(h.triangle, h.weights, 1.0)));
    }
    return most;
  }
  /// How far a point of a triangle goes in that share of the way [m].
  [[nodiscard]] triple gone(int t, const triple& weights, double share) const noexcept {
    const auto& nodes = surface_->triangles()[slot(t)];
    const auto &a = surface_->from().nodes, &b = surface_->to().nodes;
    const auto one = [&](int i) { return b[slot(i)] - a[slot(i)]; };
    return (one(nodes[0]) * weights.x + one(nodes[1]) * weights.y + one(nodes[2]) * weights.z) *
           share;
  }

  // ------------------------------------------------------------------------------- the mesh's motion
  [[nodiscard]] bool follows() const noexcept { return surface_->moves(); }
  /// A tick of the way to the newest shape; how far the ball was carried [m]. What would crush the ball waits;
  /// if it waits for long and there are news, the way is gone back, because they may leave room.
  double follow(double dt) noexcept {
    double wanted = dt / shape_way_;
    if (stuck_ < 0) {
      wanted = -(std::min)(wanted, done_);
    } else {
      wanted = (std::min)(wanted, 1.0 - done_);
    }
    double carried = 0.0, left = 1.0;
    for (int round = 0; round < 2 && left > 1e-6; ++round) {
      const double share = wanted * left;
      const triple w = carry(share);
      const double part = safe_part(share, w);
      at_ = at_ + w * part;
      carried += length(w) * part;
      done_ += share * part;
      left *= 1.0 - part;
      if (part < 1.0) carried += make_room();
    }
    if (left <= 1e-6 && wanted > 0.0 && 1.0 - done_ < 1e-9) done_ = 1.0;
    if (stuck_ >= 0) {
      stuck_ = left > 0.99 ? stuck_ + 1 : 0;
      if (stuck_ > patience && surface_->has_news()) stuck_ = -1;
    }
    return carried;
  }
  /// The ball goes with what it rests on.
  [[nodiscard]] triple carry(double share) const noexcept {
    if (pressed_.count == 0) return {};
    std::array<triple, 3> way{};
    std::size_t most = 0;
    for (std::size_t i = 0; i < slot(pressed_.count); ++i) {
      const half_space_of& h = planes_[slot(pressed_.of[i])];
      way[i] = gone(h.triangle, h.weights, share);
      if (pressed_.share[i] > pressed_.share[most]) most = i;
    }
    if (pressed_.count == 1) return way[0];
    support more;
    const bool can = shortest_way([&](int i) { return planes_[slot(pressed_.of[slot(i)])].normal; },
                                  [&](int i) {
                                    return dot(planes_[slot(pressed_.of[slot(i)])].normal,
                                               way[slot(i)] - way[most]);
                                  },
                                  pressed_.count, 1e-12, more);
    const double longest = length(way[most]) + rule_.radius;
    return can && squared(more.way) < longest * longest ? way[most] + more.way : way[most];
  }
  /// The part of that share of the way, in [0, 1], in which no triangle comes nearer than r/2 to a ball that goes
  /// by w. With n the direction from the closest point c to the ball T stays behind a plane that comes nearer by
  /// max n·u_k, u_k the way of a corner beside the ball. And of a point of T, Σ w_k y_k: those within ρ of c go by
  /// |u_c| + ρ Σ |u_k − u_c|/h_k at most, h_k the heights of T, the others are √(d² + ρ²) away or more and go by max
  /// |u_k|, so ρ = max |u_k| + r. The smaller counts.
  [[nodiscard]] double safe_part(double share, const triple& w) const noexcept {
    const view before = now(), after = seen_at(done_ + share);
    const double least = 0.5 * rule_.radius, margin = least + length(w);
    double part = 1.0;
    surface_->tree().walk(
        [&](int b) {
          box swept = before.around(b);
          swept.grow(after.around(b));
          return swept.squared_distance(at_);
        },
        [&](double d2) { return d2 < margin * margin; },
        [&](int t) {
          const found f = on(before, t, at_);
          const corners a = before.triangle(t), b = after.triangle(t);
          const std::array<triple, 3> u{b[0] - a[0] - w, b[1] - a[1] - w, b[2] - a[2] - w};
          const double fastest =
              kernels::square_root((std::max)({squared(u[0]), squared(u[1]), squared(u[2])}));
          const double room = (std::max)(f.distance - least, 0.0);
          if (!(fastest > room)) return;
          const triple here = u[0] * f.weights.x + u[1] * f.weights.y + u[2] * f.weights.z;
          const double twice_area = length(cross(a[1] - a[0], a[2] - a[0]));
          double bend = 0.0;
          for (std::size_t k = 0; k < 3; ++k) {
            bend += length(u[k] - here) * length(a[(k + 2) % 3] - a[(k + 1) % 3]);
          }
          double speed = 0.0;  // towards the ball: T is behind the plane across the way to it
          for (const triple& v : u) speed = (std::max)(speed, dot(v, at_ - f.point));
          speed = f.distance > 0.0 ? speed / f.distance : fastest;
          if (twice_area > 0.0) {
            speed = (std::min)(speed, length(here) + (fastest + rule_.radius) * bend / twice_area);
          }
          if (speed > room) part = (std::min)(part, room / speed);
        });
    return part;
  }
  /// What has come nearer than r pushes the ball off; how far [m].
  double make_room() noexcept {
    const triple before = at_;
    round_to(at_, 0.5 * rule_.radius);
    return length(at_ - before);
  }

  // ------------------------------------------------------------------------------- the ball's motion
  /// Before it has a side: it waits until the device is clear of the surface.
  void begin(const triple& x, double dt) noexcept {
    if (follows()) done_ = (std::min)(1.0, done_ + dt / shape_way_);
    device_ = x;
    const found f = closest(now(), x, rule_.radius);
    if (f.triangle >= 0) return;
    at_ = x;
    placed_ = true;
    count_ = 0;
    pressed_ = {};
  }
  void approach(const triple& x, double first, double budget) noexcept {
    for (int round = 0; round < most_rounds; ++round) {
      const double wanted = round == 0 ? first : round == 1 ? 0.25 * rule_.radius : budget;
      const double gone_by = round_to(x, (std::min)(wanted, budget));
      budget -= gone_by;
      if (!(gone_by > 1e-3 * rule_.radius) || !(budget > 0.0)) return;
    }
  }
  /// The shortest way towards x in the half-spaces of what is within `reach` [m], and no farther; how far it went.
  double round_to(const triple& x, double reach) noexcept {
    collect(reach);
    const double r = rule_.radius, slack = 1e-9 * r;
    const auto normal = [&](int i) { return planes_[slot(i)].normal; };
    const auto missing = [&](int i) {
      return planes_[slot(i)].level - dot(planes_[slot(i)].normal, x);
    };
    if (!shortest_way(normal, missing, count_, slack, pressed_)) {
      for (int i = 0; i < count_; ++i) {  // no room for r: at least what there is
        half_space_of& h = planes_[slot(i)];
        h.level = (std::min)(h.level, dot(h.normal, at_));
      }
      if (!shortest_way(normal, missing, count_, slack, pressed_)) {
        stop_at(at_, x);
        return 0.0;
      }
    }
    const triple goal = x + pressed_.way, way = goal - at_;
    const double whole = length(way);
    if (!keeps_off(goal) || !kernels::is_finite(whole)) {
      stop_at(at_, x);
      return 0.0;
    }
    if (whole <= reach_) {
      at_ = goal;
      return whole;
    }
    stop_at(at_ + way * (reach_ / whole), x);
    return reach_;
  }
  /// The straight way to there is r/4 away from what the half-spaces stand for, and from what lies behind them.
  [[nodiscard]] bool keeps_off(const triple& goal) const noexcept {
    for (int i = 0; i < count_; ++i) {
      const half_space_of& h = planes_[slot(i)];
      const double least = base_[slot(i)] + 0.25 * rule_.radius + behind();
      if (dot(h.normal, at_) < least || dot(h.normal, goal) < least) {
        if (dot(h.normal, goal - at_) < 0.0) return false;
      }
    }
    return true;
  }
  /// It goes there and no farther now: one more half-space, across the way to x.
  void stop_at(const triple& there, const triple& x) noexcept {
    const triple off = there - x;
    const double d = length(off);
    at_ = there;
    if (!(d > 1e-12)) return;
    const int i = count_ < most_planes ? count_++ : most_planes - 1;
    const triple n = off * (1.0 / d);
    const int likely = nearest_ >= 0 ? nearest_ : 0;
    planes_[slot(i)] = {n, dot(n, there), likely, {1.0, 0.0, 0.0}};
    pressed_ = {off, {i, 0, 0}, {d, 0.0, 0.0}, 1};
  }
  /// What may stand before a half-space and is passed over while it is not near [m].
  [[nodiscard]] double behind() const noexcept { return 0.02 * rule_.radius; }

  /// The half-spaces of the triangles within r + reach, the closest first. Where there are too many, reach_ is
  /// less than `reach`.
  void collect(double reach) noexcept {
    const view v = now();
    const double r = rule_.radius;
    reach_ = reach;
    count_ = 0;
    const found first = closest(v, at_, r + reach);
    if (first.triangle < 0) return;
    nearest_ = first.triangle;
    add(v, first);

    std::array<found, most_near> beside;
    int have = 0;
    double farthest = r + reach;
    surface_->tree().walk(
        [&](int b) {
          const box around = v.around(b);
          const double d2 = around.squared_distance(at_);
          const bool close = d2 <= (r + behind()) * (r + behind());
          const double before = around.farthest_along(planes_[0].normal) - base_[0];
          return before <= (close ? tiny() : behind()) ? box::infinity : d2;
        },
        [&](double d2) { return d2 < farthest * farthest; },
        [&](int t) {
          if (t == first.triangle) return;
          if (lies_behind(v.triangle(t), 0, tiny())) return;
          const found f = on(v, t, at_);
          if (!(f.distance < farthest)) return;
          int i = have;
          if (have < most_near) {
            ++have;
          } else {
            farthest = beside[slot(have - 1)].distance;
            if (!(f.distance < farthest)) return;
            --i;
          }
          for (; i > 0 && f.distance < beside[slot(i - 1)].distance; --i) {
            beside[slot(i)] = beside[slot(i - 1)];
          }
          beside[slot(i)] = f;
          if (have == most_near) farthest = beside[slot(have - 1)].distance;
        });
    reach_ = (std::min)(reach_, (std::max)(farthest - r, 0.0));
    for (int k = 0; k < have; ++k) {
      const found& f = beside[slot(k)];
      if (f.distance >= r + reach_) return;
      const double allowed = f.distance <= r + behind() ? tiny() : behind();
      const corners t = v.triangle(f.triangle);
      bool hidden = false;
      for (int i = 0; i < count_ && !hidden; ++i) hidden = lies_behind(t, i, allowed);
      if (hidden) continue;
      if (count_ == most_planes - 1) {  // the last one is for stop_at
        reach_ = (std::max)(f.distance - r, 0.0);
        return;
      }
      add(v, f);
    }
  }
  [[nodiscard]] double tiny() const noexcept { return 1e-6 * rule_.radius; }
  [[nodiscard]] bool lies_behind(const corners& t, int i, double allowed) const noexcept {
    const triple& n = planes_[slot(i)].normal;
    const double most = base_[slot(i)] + allowed;
    return dot(n, t[0]) <= most && dot(n, t[1]) <= most && dot(n, t[2]) <= most;
  }
  /// The half-space of a triangle: beside its own plane where the ball is above it, else across the way to its
  /// closest point.
  void add(const view& v, const found& f) noexcept {
    const corners t = v.triangle(f.triangle);
    const double r = rule_.radius;
    triple n = cross(t[1] - t[0], t[2] - t[0]);
    const double size = length(n);
    double base = 0.0;
    bool flat = false;
    if (size > 0.0) {
      n = n * (1.0 / size);
      double above = dot(n, at_ - t[0]);
      if (above < 0.0) {
        n = n * -1.0;
        above = -above;
      }
      base = (std::max)({dot(n, t[0]), dot(n, t[1]), dot(n, t[2])});
      flat = dot(n, at_) - base >= (std::min)(r, f.distance) * (1.0 - 1e-9);
    }
    if (!flat) {
      const triple off = at_ - f.point;
      n = f.distance > 0.0 ? off * (1.0 / f.distance) : triple{0.0, 0.0, 1.0};
      base = (std::max)({dot(n, t[0]), dot(n, t[1]), dot(n, t[2])});
    }
    base_[slot(count_)] = base;
    planes_[slot(count_)] = {n, base + r, f.triangle, f.weights};
    ++count_;
  }

  static constexpr int patience = 50;  ///< ticks for which news that would crush the ball wait

  surface* surface_ = nullptr;
  proxy_parameters rule_{};
  double done_ = 1.0;  ///< of the way between them
  double shape_way_ = 1e-3, shape_age_ = 1.0, pose_way_ = 1e-3, pose_age_ = 1.0;  // [s]
  double pose_done_ = 1.0;
  int stuck_ = 0;  ///< ticks for which the mesh waits; < 0: it goes back
  pose came_from_{}, goal_{}, shown_{};
  bool placed_ = false;
  triple at_{};      ///< the ball, as the mesh sees it [m]
  triple device_{};  ///< the device, as the mesh sees it [m]
  int nearest_ = -1;
  int count_ = 0;
  double reach_ = 0.0;  ///< how far the half-spaces count [m]
  std::array<half_space_of, most_planes> planes_{};
  std::array<double, most_planes> base_{};  ///< level of the farthest corner [m]
  support pressed_{};
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
