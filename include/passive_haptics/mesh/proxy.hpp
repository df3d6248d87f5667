// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The place of a finger that passes through no triangle: a ball of radius r [m] is drawn to the device and stays r
// away from every triangle of a mesh, whether the mesh rests, moves or deforms. There is no inside and no outside:
// the side that is touched is the side on which the ball is.
//
//     ph::mesh::proxy finger({.radius = 5e-4});
//     finger.touch(organ);                          // a mesh::surface, which any number of others may touch
//     finger.also_touch(needle);                    // several, each with its own news: it is held by all of them
//     finger.step(device, dt);                      // in every tick; then
//     finger.place();                               // where the ball is; device − place() is how far it is held off
//
// Two statements prove it:
//   rest    A half-space that is at least r away from a triangle T is free of T. So in the intersection of one such
//           half-space for each triangle nearby the ball may go any straight way and touches none of them; it goes
//           the shortest way to the device (free_region.hpp). A T that lies behind one of them already needs none.
//   motion  Between two shapes each node goes straight, and the ball goes along with what it rests on. While a
//           triangle at the distance d moves by less than d − r/2 relative to the ball, it stays r/2 away or more. A
//           triangle that would move farther waits for the next tick.
// With friction the ball is drawn to a place beside the device (stick()), by the same two. On a smooth mesh the ball
// has half-spaces of the rounded surface besides (smooth.hpp); they only hold it farther off, and while the device
// rests none of them rises over the ball, so that it rests in a hollow that it is too large for, too.
// So the distance of the ball's centre from every triangle stays > 0 whatever news come, and the ball passes through
// nothing. No test of an edge, a side or a crossing is made whose result rounding could turn.
//
// Source: god-object (Zilles, Salisbury 1995) and proxy (Ruspini, Kolarov, Khatib 1997), from memory; the
// half-spaces by distance, and the motion of the mesh, are derived here: docs/design/meshes.md.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/mesh/free_region.hpp>
#include <passive_haptics/mesh/moving_mesh.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

struct proxy_parameters {
  double radius = 5e-4;  ///< r, of the ball [m]
  double news_speed =
      0.05;  ///< what is touched follows its news at this speed [m/s], or faster as it must
  /// News are followed within the time since the last ones, or this [s] unless they go on steadily.
  double longest_way = 0.05;
  double friction = 0.0;  ///< μ of triangles whose mesh states none

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!(radius >= 1e-6 && radius <= 1.0)) return {"radius", radius, "in [1e-6, 1] m"};
    if (!(news_speed > 0.0)) return {"news_speed", news_speed, "> 0 m/s"};
    if (!(longest_way > 0.0 && longest_way <= 1.0)) {
      return {"longest_way", longest_way, "in (0, 1] s"};
    }
    if (!passive_haptics::detail::not_negative(friction))
      return {"friction", friction, "finite and ≥ 0"};
    return {};
  }
};

class proxy {
 public:
  static constexpr int most_planes = 20, most_meshes = 8;

  proxy() noexcept = default;
  explicit proxy(const proxy_parameters& p) noexcept : rule_(p) {}
  [[nodiscard]] constexpr const proxy_parameters& parameters() const noexcept { return rule_; }
  /// Parameters that check() refuses change nothing. Where a ball of another radius rests counts as other meshes.
  constexpr void set(const proxy_parameters& p) noexcept {
    if (p.check()) return;
    if (!(p.radius == rule_.radius)) others_ = ticks_to_arrive + 1;
    rule_ = p;
  }

  /// Touches this surface from now on, and no other; it must outlive the proxy. What is pressed keeps its side if the
  /// surface that takes its place lies within r of it: a finer mesh, or one of another topology. A surface has 64
  /// places, and a proxy that ends must call let_go(), or its place stays taken. It returns false, and nothing is
  /// touched, if no place is left, or if check() refuses the parameters.
  bool touch(const surface& s) noexcept {
    if (!touches(s)) {
      if (meshes_ == most_meshes) let_go();
      if (!also_touch(s)) {
        let_go();
        return false;
      }
    }
    for (int m = meshes_; m-- > 0;) {
      if (!parts_[slot(m)].news.reads(s)) leave(m);
    }
    return true;
  }
  /// Touches this surface as well, where it is now. Each has its own pose and news, and where they meet all of them
  /// hold the ball; what it presses keeps its side. It returns false if most_meshes are touched, if the surface has no
  /// place left or is touched already, or if check() refuses the parameters.
  bool also_touch(const surface& s) noexcept {
    if (touches(s) || meshes_ == most_meshes || rule_.check()) return false;
    part fresh;
    if (!fresh.news.join(s)) return false;
    if (const auto* there = fresh.news.take_pose()) {
      fresh.told_before = fresh.told = fresh.goal = fresh.shown = there->where;
    }
    reframe([&] { parts_[slot(meshes_++)] = fresh; });
    placed_ &= !(at_ == device_ && now(fresh).closest(at_, rule_.radius, -1).triangle >= 0);
    return true;
  }
  /// Touches no surface any more.
  void let_go() noexcept {
    for (part& p : parts()) {
      p.news.leave();
      p = {};
    }
    meshes_ = 0;
    reset();
  }
  /// Touches this surface no more, and the others as before.
  void let_go(const surface& s) noexcept {
    for (int m = meshes_; m-- > 0;) {
      if (parts_[slot(m)].news.reads(s)) leave(m);
    }
    if (meshes_ == 0) reset();
  }
  /// Forgets where the ball was, and with that which side was touched.
  void reset() noexcept {
    placed_ = false;
    beside_ = count_ = 0;
    pressed_ = {};
    beside_device_ = {};
  }
  [[nodiscard]] bool touching() const noexcept { return meshes_ > 0; }
  [[nodiscard]] bool touches(const surface& s) const noexcept {
    return std::any_of(parts().begin(), parts().end(),
                       [&s](const part& p) { return p.news.reads(s); });
  }
  /// True if a mesh came or went before the last step, or shortly before and the ball was on its way to where it rests.
  [[nodiscard]] bool touches_others() const noexcept { return others_ > 0; }
  [[nodiscard]] int meshes() const noexcept { return meshes_; }
  /// True if the device has been clear of the surfaces once since the reset. Until then the ball has no side and
  /// holds nothing off.
  [[nodiscard]] bool placed() const noexcept { return placed_; }

  /// The device is at x [m], dt [s] after the last step. A device that is not finite, or farther than 1000 km, changes
  /// nothing. `friction` ≥ 0 is a μ in place of those of the triangles: of who follows their changes at a limited rate.
  [[gnu::noinline]] void step(const triple& x, double dt, double friction = -1.0) noexcept {
    if (meshes_ == 0 || !is_finite(x) || !(squared(x) < 1e12) || !(dt > 0.0)) return;
    others_ = (std::max)(others_ - 1, 0);
    for (part& p : parts()) hear(p, dt);
    const triple own = seen(x);
    if (!placed_) {
      begin(own, dt);
      return;
    }
    const double moved = length(own - device_);
    double carried = 0.0;
    const std::array<held_by, 3> before = holding(0);
    const triple was = at_;
    device_ = own;
    // A convex surface rises over a tangent by less than the square; the rest is for what the ball has sunk before.
    rise_ = (0.02 + 0.5 * moved / rule_.radius) * moved;
    went_along_ = {};
    if (follows()) carried = follow(dt);
    went_along_ = at_ - was;
    beside_device_ = stick(friction);
    const triple from = at_;
    approach(own + beside_device_, 1.25 * (moved + carried) + 0.125 * rule_.radius,
             3.0 * (moved + carried) + 0.5 * rule_.radius);
    if (!(length(at_ - from) > 2.0 * (moved + carried) + 1e-3 * rule_.radius)) {
      others_ = (std::min)(others_, 1);
    }
    stay_on(before);
  }

  /// Where the ball is, in the world [m].
  [[nodiscard]] triple place() const noexcept { return frame().out(at_) + frame().position; }
  /// The half-spaces that the ball may not leave: their normals in the world, and how far [m] the device was beyond
  /// each in the last step. Those that press have their numbers in pressed().of.
  [[nodiscard]] int planes() const noexcept { return count_; }
  [[nodiscard]] triple normal(int i) const noexcept { return frame().out(planes_[slot(i)].normal); }
  [[nodiscard]] double depth(int i) const noexcept {
    return planes_[slot(i)].level - dot(planes_[slot(i)].normal, device_ + beside_device_);
  }
  [[nodiscard]] const support& pressed() const noexcept { return pressed_; }
  /// What holds the ball off, from where it is drawn to, in the world [m].
  [[nodiscard]] triple push() const noexcept { return frame().out(pressed_.way); }
  /// How far friction holds the ball back beside the device, along the surface, as a direction of the world [m].
  [[nodiscard]] triple held_back() const noexcept { return frame().out(beside_device_); }
  /// What presses is made of, by how much each triangle does; `elsewhere` where a mesh does not say.
  [[nodiscard]] material felt(const material& elsewhere) const noexcept {
    double all = 0.0;
    material sum{.stiffness = 0.0};
    for (std::size_t i = 0; i < slot(pressed_.count); ++i) {
      const half_space_of& h = planes_[slot(pressed_.of[i])];
      const material* said = parts_[slot(h.mesh)].news.made(h.triangle);
      const material& one = said != nullptr ? *said : elsewhere;
      const double share = pressed_.share[i];
      all += share;
      sum.stiffness += share * one.stiffness;
      sum.friction += share * one.friction;
      sum.viscosity += share * one.viscosity;
    }
    if (!(all > 0.0)) return elsewhere;
    return {sum.stiffness / all, sum.friction / all, sum.viscosity / all};
  }
  /// The origin of a half-space: the mesh, in the order of touching, the triangle, and the point on it.
  [[nodiscard]] const half_space_of& plane(int i) const noexcept { return planes_[slot(i)]; }
  /// The way [m] that the touched point of half-space i went in the last step, in the world.
  [[nodiscard]] triple went(int i) const noexcept {
    const half_space_of& h = planes_[slot(i)];
    const part& p = parts_[slot(h.mesh)];
    return p.moved() ? p.went(h.triangle, h.weights) : triple{};
  }
  /// True if what half-space i is of goes steadily, so that its way is foreseen (base/foresight.hpp).
  [[nodiscard]] bool goes_steadily(int i) const noexcept {
    return parts_[slot(planes_[slot(i)].mesh)].goes_steadily();
  }
  /// The triangle that was closest in the last step, −1 before the first, and its mesh.
  [[nodiscard]] int nearest() const noexcept {
    return meshes_ > 0 ? parts_[slot(beside_)].nearest : -1;
  }
  [[nodiscard]] int nearest_mesh() const noexcept { return beside_; }
  /// The way from the last shape to the newest that is shown, in [0, 1].
  [[nodiscard]] double shown(int mesh = 0) const noexcept { return parts_[slot(mesh)].done; }
  /// The corners of a triangle as it is shown now, in its mesh's own frame [m].
  [[nodiscard]] corners triangle(int i, int mesh = 0) const noexcept {
    view v = now(parts_[slot(mesh)]);
    v.apart = false;
    return v.triangle(i);
  }
  /// The pose that is shown now.
  [[nodiscard]] const pose& where(int mesh = 0) const noexcept { return parts_[slot(mesh)].shown; }
  /// The distance of the ball's centre from the closest triangle [m]; for tests, it looks anew.
  [[nodiscard]] double clearance() const noexcept {
    double least = box::infinity;
    for (const part& p : parts()) least = now(p).closest(at_, least, p.nearest).distance;
    return least;
  }

 private:
  static constexpr int ticks_to_arrive = 8;  ///< for where the ball rests when meshes came or went
  static constexpr int most_facets = 15, most_near = 48, most_rounds = 3;
  static constexpr std::size_t slot(int i) noexcept { return static_cast<std::size_t>(i); }

  using part = detail::moving_mesh;
  using view = detail::view;
  using found = detail::found;

  [[nodiscard]] std::span<part> parts() noexcept { return std::span(parts_).first(slot(meshes_)); }
  [[nodiscard]] std::span<const part> parts() const noexcept {
    return std::span(parts_).first(slot(meshes_));
  }
  /// A single mesh is looked at in its own frame, where its pose acts as a motion of the device; several meshes are
  /// looked at in the frame of the world.
  [[nodiscard]] bool alone() const noexcept { return meshes_ == 1; }
  [[nodiscard]] const pose& frame() const noexcept {
    static constexpr pose world_frame{};
    return alone() ? parts_[0].shown : world_frame;
  }
  [[nodiscard]] triple seen(const triple& x) const noexcept {
    return frame().in(x - frame().position);
  }
  /// Mesh m is touched no more.
  void leave(int m) noexcept {
    parts_[slot(m)].news.leave();
    reframe([&] {
      for (int k = m; k + 1 < meshes_; ++k) parts_[slot(k)] = parts_[slot(k + 1)];
      parts_[slot(--meshes_)] = {};
    });
    beside_ = 0;
  }
  /// Lets meshes come or go by `change`, while the ball keeps its place in the world.
  void reframe(auto change) noexcept {
    const triple ball = place(), device = frame().out(device_) + frame().position;
    change();
    others_ = ticks_to_arrive + 1;
    at_ = seen(ball);
    device_ = seen(device);
    count_ = 0;
    pressed_ = {};
    beside_device_ = {};
  }

  [[nodiscard]] view now(const part& p) const noexcept { return p.now(!alone()); }

  // ----------------------------------------------------------------------------- the meshes' motion
  void hear(part& p, double dt) noexcept {
    const auto presses = [&](std::size_t i) {
      return &parts_[slot(planes_[slot(pressed_.of[i])].mesh)] == &p;
    };
    bool pressed = false;
    for (std::size_t i = 0; i < slot(pressed_.count); ++i) pressed = pressed || presses(i);
    const detail::touching_ball ball{place(), placed_,          alone(),
                                     pressed, rule_.news_speed, rule_.longest_way};
    p.hear(dt, ball, [&] {
      double most = 0.0;
      for (std::size_t i = 0; i < slot(pressed_.count); ++i) {
        if (!presses(i)) continue;
        const half_space_of& h = planes_[slot(pressed_.of[i])];
        const triple from =
            point_at(p.at_share(0.0, p.shown, !alone()).triangle(h.triangle), h.weights);
        const triple to =
            point_at(p.at_share(1.0, p.shown, !alone()).triangle(h.triangle), h.weights);
        most = (std::max)(most, length(to - from));
      }
      return most;
    });
  }
  [[nodiscard]] bool follows() const noexcept {
    for (const part& p : parts()) {
      if (p.goes()) return true;
    }
    return false;
  }
  /// Advances all meshes by one tick on their ways to the newest shapes and poses; returns how far they carried the
  /// ball [m]. First they go together, twice, so that the ball can make room; then each that could not go with the
  /// others tries by itself. A mesh that would crush the ball waits.
  [[gnu::noinline]] double follow(double dt) noexcept {
    double carried = 0.0;
    int going = 0;
    for (const part& p : parts()) going += p.goes() ? 1 : 0;
    for (int round = 0; round < 2 && follows(); ++round) carried += go(nullptr);
    if (going > 1) {
      for (int m = 0; m < meshes_; ++m) {
        if (parts_[slot(m)].goes()) carried += go(&parts_[slot(m)]);
      }
    }
    for (part& p : parts()) p.settle(dt);
    return carried;
  }
  /// True for this one mesh or, if it is null, for every mesh that is on its way.
  [[nodiscard]] static bool takes_part(const part& p, const part* one) noexcept {
    return one == nullptr ? p.goes() : &p == one;
  }
  /// Moves the meshes that take part as far as the ball lets them; returns how far it was carried or pushed [m].
  double go(const part* one) noexcept {
    const triple w = carry(one);
    double part_of = safe_part(one, w, 1.0);
    bool turning = false;
    for (const part& p : parts()) turning = turning || (takes_part(p, one) && p.turns());
    if (turning &&
        part_of < 1.0) {  // a turn is straight only from where it is looked at to where it ends
      part_of *= 0.5;
      if (safe_part(one, w * part_of, part_of) < 1.0) part_of = 0.0;
    }
    at_ = at_ + w * part_of;
    for (part& p : parts()) {
      if (!takes_part(p, one)) continue;
      p.go(part_of);
    }
    return length(w) * part_of + (part_of < 1.0 ? make_room() : 0.0);
  }
  /// The way [m] on which the ball goes along with what it rests on.
  [[nodiscard]] triple carry(const part* one) const noexcept {
    if (pressed_.count == 0) return {};
    std::array<triple, 3> way{};
    std::size_t most = 0;
    for (std::size_t i = 0; i < slot(pressed_.count); ++i) {
      const half_space_of& h = planes_[slot(pressed_.of[i])];
      const part& p = parts_[slot(h.mesh)];
      if (takes_part(p, one)) {
        way[i] = point_at(p.later(1.0, !alone()).triangle(h.triangle), h.weights) -
                 point_at(now(p).triangle(h.triangle), h.weights);
      }
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
  /// The part, in [0, 1], of `share` of the way still to go that the meshes that take part can go, while the
  /// ball goes by w [m], before a triangle T is nearer to it than r/2.
  ///
  /// Two bounds of how much nearer T comes are computed, and the smaller counts. c is the point of T closest to the
  /// ball, d its distance, u_k the way of corner k relative to the ball, u_c that of c.
  ///     max n·u_k                            T stays behind the plane across n, the direction from c to the ball
  ///     |u_c| + ρ Σ |u_k − u_c|/h_k          no point within ρ of c goes farther; h_k are the heights of T
  /// In the second, points farther than ρ from c are √(d² + ρ²) away or more and go by max |u_k| at most, so that they
  /// do not matter for ρ = max |u_k| + r.
  [[nodiscard]] double safe_part(const part* one, const triple& w, double share) const noexcept {
    const double least = 0.5 * rule_.radius, margin = least + length(w);
    double safe = 1.0;
    for (const part& p : parts()) {
      const bool goes = takes_part(p, one);
      if (!goes && w == triple{}) continue;
      const view before = now(p);
      const view after = goes ? p.later(p.through + (1.0 - p.through) * share, !alone()) : before;
      const triple own = before.in(at_);
      // A branch that turns: its points go by what its middle goes and by what half its size turns.
      const bool turns = goes && p.turns();
      const double angle = turns ? turn_between(before.where, after.where) : 0.0;
      before.of->tree.walk(
          [&](int b) {
            box swept = before.around(b);
            if (goes && !before.still) swept.grow(after.around(b));
            const double d2 = swept.squared_distance(own);
            if (!turns) return d2;
            const triple middle = between(swept.low, swept.high, 0.5);
            const double by = length(after.where.out(middle) + after.where.position -
                                     before.where.out(middle) - before.where.position) +
                              angle * length(swept.high - middle);
            const double d = (std::max)(kernels::square_root(d2) - by, 0.0);
            return d * d;
          },
          [&](double d2) { return d2 < margin * margin; },
          [&](int t) { limit(before.triangle(t), after.triangle(t), w, least, safe); });
    }
    return safe;
  }
  void limit(const corners& a, const corners& b, const triple& w, double least,
             double& safe) const noexcept {
    const found f = detail::closest_on(a, 0, at_);
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
    if (speed > room) safe = (std::min)(safe, room / speed);
  }
  /// How far two turns an angle θ apart may bring a point at the distance 1 apart: 2 sin θ/2 ≤ 4 sin θ/4, which is
  /// twice the distance of their quaternions.
  [[nodiscard]] static double turn_between(const pose& a, const pose& b) noexcept {
    const double side = a.w * b.w + dot(a.axis, b.axis) < 0.0 ? -1.0 : 1.0;
    const double w = a.w - side * b.w;
    return 2.0 * kernels::square_root(w * w + squared(a.axis - b.axis * side));
  }
  /// Pushes the ball off what has come nearer than r; returns how far it went [m].
  double make_room() noexcept {
    const triple before = at_;
    round_to(at_, 0.5 * rule_.radius);
    return length(at_ - before);
  }

  // ------------------------------------------------------------------------------- the ball's motion
  /// How far beside the device the ball is to stay: where it was, as it was carried, unless that is more than μ times
  /// its depth; then that much [m].
  [[nodiscard]] triple stick(double mu) const noexcept {
    if (mu < 0.0) mu = felt({.friction = rule_.friction}).friction;
    const double pressed = length(pressed_.way);
    if (!(mu > 0.0 && pressed > 0.0)) return {};
    const triple n = pressed_.way * (1.0 / pressed), off = at_ - device_;
    const double deep = dot(off, n);
    if (!(deep > 0.0)) return {};
    const triple along = off - n * deep;
    const double far_off = length(along), most = mu * deep;
    return far_off > most ? along * (most / far_off) : along;
  }
  struct held_by {
    int mesh = -1, triangle = 0;
  };
  /// The triangles of the half-spaces that press, of those from number `first` on.
  [[nodiscard]] std::array<held_by, 3> holding(int first) const noexcept {
    std::array<held_by, 3> all{};
    for (std::size_t i = 0; i < slot(pressed_.count); ++i) {
      const half_space_of& h = planes_[slot(pressed_.of[i])];
      if (pressed_.of[i] >= first) all[i] = {h.mesh, h.triangle};
    }
    return all;
  }
  /// At an edge rounding chooses the triangle that presses. Where the mesh has materials, one of those that pressed before
  /// stays the one, as long as it has the point that is touched.
  void stay_on(const std::array<held_by, 3>& before) noexcept {
    const double same = 1e-9 * rule_.radius;
    for (std::size_t i = 0; i < slot(pressed_.count); ++i) {
      half_space_of& h = planes_[slot(pressed_.of[i])];
      const part& p = parts_[slot(h.mesh)];
      if (p.news.made(h.triangle) == nullptr) continue;
      const triple touched = point_at(now(p).triangle(h.triangle), h.weights);
      for (const held_by& b : before) {
        if (b.mesh != h.mesh || b.triangle == h.triangle) continue;
        const found f = detail::closest_on(now(p).triangle(b.triangle), b.triangle, touched);
        if (!(f.distance <= same)) continue;
        h.triangle = b.triangle;
        h.weights = f.weights;
        break;
      }
    }
  }
  /// A step before the ball has a side: it waits until the device is clear of the surfaces.
  void begin(const triple& x, double dt) noexcept {
    device_ = x;
    bool clear = true;
    for (part& p : parts()) {
      if (p.news.moves()) p.done = (std::min)(1.0, p.done + dt / p.shape_way);
      clear = clear && now(p).closest(x, rule_.radius, p.nearest).triangle < 0;
    }
    if (!clear) return;
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
  /// Moves the ball towards x inside the half-spaces of all that is within `reach` [m], by `reach` at most; returns
  /// how far it went [m].
  [[gnu::noinline]] double round_to(const triple& x, double reach) noexcept {
    const std::array<held_by, 3> before = holding(facets_);
    collect(reach);
    facets_ = count_;
    for (int m = 0; m < meshes_; ++m) {
      if (!parts_[slot(m)].news.mesh().smooth.none()) round_off(m, x, before);
    }
    const double r = rule_.radius, slack = 1e-9 * r;
    const auto normal = [&](int i) { return planes_[slot(i)].normal; };
    const auto missing = [&](int i) {
      return planes_[slot(i)].level - dot(planes_[slot(i)].normal, x);
    };
    if (!shortest_way(normal, missing, count_, slack, pressed_)) {
      for (int i = 0; i < count_;
           ++i) {  // there is no room for r, so the ball keeps the room that it has
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
  /// True if the straight way to `goal` stays r/4 away from the triangles of all half-spaces and what is behind them.
  [[nodiscard]] bool keeps_off(const triple& goal) const noexcept {
    for (int i = 0; i < facets_; ++i) {
      const half_space_of& h = planes_[slot(i)];
      const double least = base_[slot(i)] + 0.25 * rule_.radius + behind();
      if (dot(h.normal, at_) < least || dot(h.normal, goal) < least) {
        if (dot(h.normal, goal - at_) < 0.0) return false;
      }
    }
    return true;
  }
  /// Puts the ball there and holds it with one more half-space across the way to x.
  void stop_at(const triple& there, const triple& x) noexcept {
    const triple off = there - x;
    const double d = length(off);
    at_ = there;
    if (!(d > 1e-12)) return;
    const int i = count_ < most_planes ? count_++ : most_planes - 1;
    const triple n = off * (1.0 / d);
    const int likely = (std::max)(parts_[slot(beside_)].nearest, 0);
    planes_[slot(i)] = {n, dot(n, there), likely, {1.0, 0.0, 0.0}, beside_};
    pressed_ = {off, {i, 0, 0}, {d, 0.0, 0.0}, 1};
  }
  /// How far [m] a triangle that is not near may stand out of a half-space and yet need none of its own.
  [[nodiscard]] double behind() const noexcept { return 0.02 * rule_.radius; }

  /// Collects the half-spaces of the triangles within r + reach, the closest first. Where there are too many, reach_
  /// becomes less than `reach`.
  void collect(double reach) noexcept {
    const double r = rule_.radius;
    reach_ = reach;
    count_ = 0;
    found first;
    first.distance = r + reach;
    for (int m = 0; m < meshes_; ++m) {
      part& p = parts_[slot(m)];
      found f = now(p).closest(at_, first.distance, p.nearest);
      if (f.triangle < 0) continue;
      f.mesh = m;
      first = f;
      p.nearest = f.triangle;
    }
    if (first.triangle < 0) return;
    beside_ = first.mesh;
    add(now(parts_[slot(beside_)]), first);

    std::array<found, most_near> beside;  // NOLINT(*-member-init): read below `have` only
    int have = 0;
    double farthest = r + reach;
    for (int m = 0; m < meshes_; ++m) gather(m, first, beside, have, farthest);
    reach_ = (std::min)(reach_, (std::max)(farthest - r, 0.0));
    for (int k = 0; k < have; ++k) {
      const found& f = beside[slot(k)];
      if (f.distance >= r + reach_) return;
      const double allowed = f.distance <= r + behind() ? tiny() : behind();
      const view v = now(parts_[slot(f.mesh)]);
      const corners t = v.triangle(f.triangle);
      bool hidden = false;
      for (int i = 0; i < count_ && !hidden; ++i) hidden = lies_behind(t, i, allowed);
      if (hidden) continue;
      if (count_ == most_facets) {  // the others are for feet, and the last one for stop_at
        reach_ = (std::max)(f.distance - r, 0.0);
        return;
      }
      add(v, f);
    }
  }
  /// Adds the triangles of one mesh that stand out of the first half-space to `beside`, the closest first.
  void gather(int mesh, const found& first, std::array<found, most_near>& beside, int& have,
              double& farthest) const noexcept {
    const view v = now(parts_[slot(mesh)]);
    const triple own = v.in(at_);
    const triple n = v.apart ? v.where.in(planes_[0].normal) : planes_[0].normal;
    const double base = base_[0] - (v.apart ? dot(planes_[0].normal, v.where.position) : 0.0);
    const double close2 = (rule_.radius + behind()) * (rule_.radius + behind());
    v.of->tree.walk(
        [&](int b) {
          const box around = v.around(b);
          const double d2 = around.squared_distance(own);
          const double before = around.farthest_along(n) - base;
          return before <= (d2 <= close2 ? tiny() : behind()) ? box::infinity : d2;
        },
        [&](double d2) { return d2 < farthest * farthest; },
        [&](int t) {
          if (t == first.triangle && mesh == first.mesh) return;
          const corners c = v.triangle(t);
          if (lies_behind(c, 0, tiny())) return;
          found f = detail::closest_on(c, t, at_);
          if (!(f.distance < farthest)) return;
          f.mesh = mesh;
          keep_closest(f, beside, have, farthest);
        });
  }
  /// Adds one to those that are closest, in order; once there are as many as can be, what is farther than the last is of
  /// no interest.
  template <std::size_t Most>
  static void keep_closest(const found& f, std::array<found, Most>& beside, int& have,
                           double& farthest) noexcept {
    constexpr int most = static_cast<int>(Most);
    int i = have;
    if (have < most) {
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
    if (have == most) farthest = beside[slot(have - 1)].distance;
  }
  [[nodiscard]] double tiny() const noexcept { return 1e-6 * rule_.radius; }
  [[nodiscard]] bool lies_behind(const corners& t, int i, double allowed) const noexcept {
    const triple& n = planes_[slot(i)].normal;
    const double most = base_[slot(i)] + allowed;
    return dot(n, t[0]) <= most && dot(n, t[1]) <= most && dot(n, t[2]) <= most;
  }
  /// Adds the half-space of a triangle: it is parallel to the triangle where the ball is above it, and otherwise lies
  /// across the way from its closest point to the ball.
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
      const double high = dot(n, at_) - base;
      // A ball that rests on a rounded surface is higher, and beside the triangle its plane would be in the way.
      const bool lifted = !v.of->smooth.none() && high > r * (1.0 + 1e-6);
      flat = high >= (lifted ? f.distance : (std::min)(r, f.distance)) * (1.0 - 1e-9);
    }
    if (!flat) {
      const triple off = at_ - f.point;
      n = f.distance > 0.0 ? off * (1.0 / f.distance) : triple{0.0, 0.0, 1.0};
      base = (std::max)({dot(n, t[0]), dot(n, t[1]), dot(n, t[2])});
    }
    base_[slot(count_)] = base;
    planes_[slot(count_)] = {n, base + r, f.triangle, f.weights, f.mesh};
    ++count_;
  }

  /// Adds the half-spaces of the rounded surface (smooth.hpp) at the feet of x over the triangles nearby that the ball
  /// is above of, the closest first. Those of the facets stay, so the ball only stops earlier. What pressed `before` comes
  /// first of all, so that a wall is felt as long as it has a foot, even when the ball is nearer to another one.
  ///
  /// Where the ball does not fit into a hollow, x has feet on several walls, which come and go as it moves by little. So
  /// no half-space rises over the ball by more than a share of the device's way in this tick and what the mesh went
  /// beside the ball. When all rest the ball is in all of them, so each tick shortens |p − x|, and it comes to rest.
  [[gnu::noinline]] void round_off(int mesh, const triple& x,
                                   const std::array<held_by, 3>& before) noexcept {
    const part& its = parts_[slot(mesh)];
    const bool moves = its.moved();
    view v = now(its);
    const bool apart = std::exchange(v.apart, false);
    const pose where = apart ? v.where : pose{};
    const triple ball = apart ? where.in(at_ - where.position) : at_;
    const triple device = apart ? where.in(x - where.position) : x;
    const detail::bulge bulge = v.bulge();
    const double r = rule_.radius;
    double farthest = reach_ + r + bulge.lift(1.0, r) + bulge.out;
    std::array<found, most_feet> beside;  // NOLINT(*-member-init): read below `have` only
    int have = 0;
    v.of->tree.walk([&](int b) { return v.squared_distance(b, ball); },
                    [&](double d2) { return d2 < farthest * farthest; },
                    [&](int t) {
                      const corners p = v.triangle(t);
                      const found f = detail::closest_on(p, t, ball);
                      if (!(f.distance < farthest) || !is_over(p, ball - f.point)) return;
                      keep_closest(f, beside, have, farthest);
                    });
    int front = 0;
    for (const held_by& h : before) {
      if (h.mesh != mesh) continue;
      int k = front;
      while (k < have && beside[slot(k)].triangle != h.triangle) ++k;
      if (k == have) {
        have = (std::min)(have + 1, most_feet);
        k = have - 1;
        beside[slot(k)] = detail::closest_on(v.triangle(h.triangle), h.triangle, ball);
      }
      for (; k > front; --k) std::swap(beside[slot(k)], beside[slot(k - 1)]);
      ++front;
    }
    std::array<triple, most_feet> known;  // normals in the mesh's own frame
    const int first = count_;
    for (int k = 0; k < have && count_ < most_planes - 1; ++k) {
      const found& f = beside[slot(k)];
      const corners p = v.triangle(f.triangle);
      bool skipped = false;  // it lies behind a half-space of these, or beyond a triangle
      for (int i = first; i < count_ && !skipped; ++i) {
        const triple& n = known[slot(i - first)];
        const double most =
            base_[slot(i)] - dot(planes_[slot(i)].normal, where.position) + behind();
        skipped = dot(n, p[0]) <= most && dot(n, p[1]) <= most && dot(n, p[2]) <= most;
      }
      for (int i = 0; i < k && !skipped; ++i) {
        const corners q = v.triangle(beside[slot(i)].triangle);
        const triple up = cross(q[1] - q[0], q[2] - q[0]);
        const double low = dot(up, f.point - q[0]), high = dot(up, ball - q[0]);
        skipped = high > 0.0 ? low < -1e-6 * high : low > -1e-6 * high;
      }
      if (skipped) continue;
      detail::foot foot;  // NOLINT(*-member-init): written where it is found
      if (!detail::find_foot(
              v.of->smooth, [&](int i) { return v.triangle(i); },
              [&](int i) { return v.normals(i); }, f.triangle,
              before_focus(p, v.normals(f.triangle), ball, device), foot)) {
        continue;
      }
      const triple off = ball - point_at(v.triangle(foot.triangle), foot.weights);
      const double side = dot(cross(p[1] - p[0], p[2] - p[0]), ball - f.point) > 0.0 ? 1.0 : -1.0;
      if (!(side * dot(foot.normal, off) > 0.0)) continue;  // it is the other side of a fold
      if (dot(foot.beyond, off) > 0.0) continue;            // the ball goes over a sharp edge
      const triple own = foot.normal * side;
      bool twice = false;
      for (int i = first; i < count_ && !twice; ++i) {
        twice = squared(known[slot(i - first)] - own) < 1e-12;
      }
      if (twice) continue;
      known[slot(count_ - first)] = own;
      const triple n = where.out(own);
      base_[slot(count_)] = foot.level * side + dot(n, where.position);
      triple beside_ball{};  // how far what has the foot went beside the ball
      if (moves) {
        const view last = its.at_share(its.done_before, its.shown_before, !alone());
        beside_ball = point_at(now(its).triangle(foot.triangle), foot.weights) -
                      point_at(last.triangle(foot.triangle), foot.weights);
      }
      const double most = dot(n, at_) + rise_ + length(beside_ball - went_along_);
      const double level = base_[slot(count_)] + bulge.lift(side, r) + r;
      planes_[slot(count_)] = {n, (std::min)(level, most), foot.triangle, foot.weights, mesh};
      ++count_;
    }
  }
  /// True if the way from the closest point of a triangle is less than 60° off its normal.
  [[nodiscard]] static bool is_over(const corners& t, const triple& way) noexcept {
    const triple n = cross(t[1] - t[0], t[2] - t[0]);
    const double above = dot(n, way);
    return above * above > 0.25 * squared(n) * squared(way);
  }
  /// The device or, if it lies deeper below the ball than half of the radius of curvature of a surface that is bent away
  /// from the ball, a point that does not: beyond the centre of curvature there is no foot.
  [[nodiscard]] static triple before_focus(const corners& p, const corners& n, const triple& ball,
                                           const triple& device) noexcept {
    const double above = dot(cross(p[1] - p[0], p[2] - p[0]), ball - p[0]);
    double bent = 0.0;  // squared
    for (std::size_t k = 0; k < 3; ++k) {
      const triple edge = p[(k + 1) % 3] - p[k], turn = n[(k + 1) % 3] - n[k];
      if (dot(turn, edge) * above > 0.0) bent = (std::max)(bent, squared(turn) / squared(edge));
    }
    const double deep = squared(device - ball) * bent;
    return deep > 0.25 ? between(ball, device, 0.5 / kernels::square_root(deep)) : device;
  }

  static constexpr int most_feet = 8;  ///< of a mesh

  proxy_parameters rule_{};
  std::array<part, std::size_t{most_meshes}> parts_{};
  int meshes_ = 0;
  int beside_ = 0;  ///< the mesh that is closest
  bool placed_ = false;
  int others_ = 0;          ///< ticks in which the ball may still be on its way
  triple at_{};             ///< the ball in frame() [m]
  triple device_{};         ///< the device there [m]
  triple beside_device_{};  ///< what friction holds the ball back by [m]
  int count_ = 0;
  int facets_ = 0;       ///< those of triangles; they are the first
  double reach_ = 0.0;   ///< how far the half-spaces count [m]
  double rise_ = 0.0;    ///< by how much those of a rounded surface may come over the ball [m]
  triple went_along_{};  ///< the ball's way with the meshes in this tick [m]
  std::array<half_space_of, most_planes> planes_{};
  std::array<double, most_planes> base_{};  ///< level of the farthest corner [m]
  support pressed_{};
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
