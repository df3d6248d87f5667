// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One mesh as one finger sees it, on its way from what it was to its news (surface.hpp): its shape goes straight from
// the last one to the newest, and its pose likewise. The time for a way that moves what is touched by ℓ [m] is
//
//     max(t, (1 − a) ℓ/v)     t [s] until the next news are due, a what is foreseen of their way (base/foresight.hpp),
//                             v = news_speed; at most longest_way, unless they go on steadily
//
// While news come steadily the goal is where the mesh will be when the next are due; when those do not come, it is what
// was told. How much of the way is done in a tick the ball says (proxy.hpp), which the mesh may not crush.
// Source: ours; docs/design/meshes.md.

#include <passive_haptics/mesh/surface.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {
namespace detail {

/// When news come.
struct timing {
  static constexpr double rarest = 0.15;  ///< [s]
  double age = 1.0;                       ///< of the last ones [s]
  double period = 1.0, before = 1.0;  ///< between those and the ones before, and before that [s]
  double mean = 1.0;                  ///< of the last few periods [s]
  double longest = 0.0;  ///< of them if not long ago, `rarest` at most; 0 after a pause [s]
  /// News that come at once, because those before were late, are no faster motion: they count as if they had taken half
  /// of the longest period.
  void hear() noexcept {
    const double since = std::exchange(age, 0.0), usual = (std::min)(since, rarest);
    longest = since < 1.0 ? (std::max)(usual, longest + 0.2 * (usual - longest)) : 0.0;
    before = std::exchange(period, (std::max)(since, 0.5 * longest));
    const bool other = mean > 2.0 * period || period > 2.0 * mean;
    mean = other ? period : mean + 0.25 * (period - mean);
  }
  /// Until the next are due [s]; who is late has half a period at least, the longest one of the last few.
  [[nodiscard]] double left() const noexcept {
    return (std::max)(period - age, 0.5 * (std::max)(period, longest));
  }
  /// True if the next are due before long, but not in the next two ticks, so that their place is worth foreseeing.
  /// News that come unevenly are late when they are later than those before were.
  [[nodiscard]] bool are_due(double dt) const noexcept {
    return period > 2.5 * dt && period < rarest && age < 1.5 * longest;
  }
};

/// A point of a mesh, as close to another as `distance` [m].
struct found {
  double distance = box::infinity;  ///< [m]
  int triangle = -1;
  triple weights;
  triple point;
  int mesh = 0;
};
/// The point of triangle i, with these corners, that is closest to p.
[[nodiscard]] inline found closest_on(const corners& t, int i, const triple& p) noexcept {
  found f;
  f.triangle = i;
  f.weights = closest_weights(t, p);
  f.point = point_at(t, f.weights);
  f.distance = length(f.point - p);
  return f;
}

/// A mesh at one share of the way from one shape to another, at a pose in the frame that is looked from.
struct view {
  const world* of;
  const shape *from, *to;
  double done;
  bool still;
  bool apart = false;  ///< in a frame of its own
  pose where{};

  [[nodiscard]] triple node(int i) const noexcept {
    const triple& b = to->nodes[slot(i)];
    return still ? b : between(from->nodes[slot(i)], b, done);
  }
  [[nodiscard]] corners triangle(int i) const noexcept {
    const auto& t = of->triangles[slot(i)];
    corners c{node(t[0]), node(t[1]), node(t[2])};
    if (apart) {
      for (triple& p : c) p = where.out(p) + where.position;
    }
    return c;
  }
  [[nodiscard]] triple in(const triple& p) const noexcept {
    return apart ? where.in(p - where.position) : p;
  }
  // In its own frame.
  [[nodiscard]] corners normals(int i) const noexcept {  // linear in between, as the nodes are
    corners n;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t its = slot(of->smooth.normal[slot(i)][k]);
      n[k] = still ? to->normals[its] : between(from->normals[its], to->normals[its], done);
    }
    return n;
  }
  [[nodiscard]] detail::bulge bulge() const noexcept {
    const detail::bulge &a = from->bulge, &b = to->bulge;
    const auto mean = [&](double u, double v) { return u + (v - u) * done; };
    if (still) return b;
    return {mean(a.out, b.out), mean(a.in, b.in), mean(a.least_cosine, b.least_cosine)};
  }
  /// Box i at the present share of the way. It holds the moved nodes, because each node and each bound go the same
  /// share of their ways, and no node is beyond its bound at either end.
  [[nodiscard]] box around(int i) const noexcept {
    const box& b = to->boxes[slot(i)];
    if (still) return b;
    const box& a = from->boxes[slot(i)];
    return {between(a.low, b.low, done), between(a.high, b.high, done)};
  }
  [[nodiscard]] double squared_distance(int i, const triple& p) const noexcept {
    return around(i).squared_distance(p);
  }
  /// The closest point, if it is within `reach` [m]; `first` is a triangle that may be near, or −1.
  [[nodiscard]] found closest(const triple& p, double reach, int first) const noexcept {
    found best;
    best.distance = reach;
    const auto better = [&](int t) {
      const found f = closest_on(triangle(t), t, p);
      if (f.distance < best.distance) best = f;
    };
    if (first >= 0) better(first);
    const triple own = in(p);
    of->tree.walk([&](int b) { return squared_distance(b, own); },
                  [&](double d2) { return d2 < best.distance * best.distance; }, better);
    return best;
  }

 private:
  static constexpr std::size_t slot(int i) noexcept { return static_cast<std::size_t>(i); }
};

/// What a mesh asks of the ball that touches it.
struct touching_ball {
  triple place;        ///< in the world [m]
  bool placed;         ///< it has a side
  bool alone;          ///< it touches no other mesh
  bool presses;        ///< this mesh
  double news_speed;   ///< v [m/s]
  double longest_way;  ///< [s]
};

/// A mesh, and how far its shape and its pose have come on their way to the newest ones.
struct moving_mesh {
  surface::reader news;
  double done = 1.0, done_before = 1.0;      ///< of the way between the shapes; in the last tick
  double shape_way = 1e-3, pose_way = 1e-3;  ///< [s]
  timing shape_news, pose_news;
  int newest = -1;                  ///< number of the newest shape
  pose told{}, told_before{};       ///< the newest pose, which `goal` may be ahead of
  triple told_way{}, way_before{};  ///< the speed at which they moved what is at the ball [m/s]
  foresight<double> sees;           ///< of poses
  double pose_done = 1.0;
  int stuck = 0;  ///< ticks for which the mesh waits; < 0: it goes back
  pose came_from{}, goal{}, shown{}, shown_before{};
  int nearest = -1;  ///< the triangle that was closest to the ball
  // of this tick:
  double wanted = 0.0;   ///< share of the way between the shapes
  pose aim{};            ///< where it is to be at the end
  double through = 1.0;  ///< of both, what is done
  double done_at_first = 1.0;
  pose shown_at_first{};

  [[nodiscard]] bool turns() const noexcept { return !(aim == shown_at_first); }
  [[nodiscard]] bool goes() const noexcept { return through < 1.0; }
  /// True if it moved in the last tick.
  [[nodiscard]] bool moved() const noexcept {
    return !(done == done_before && shown == shown_before);
  }
  /// True if it goes steadily, so that its way is foreseen.
  [[nodiscard]] bool goes_steadily() const noexcept {
    return done == done_before ? sees.share() > 0.0 : news.to().steady > 0.0;
  }
  /// At that share of the way between the shapes, at a pose, in the frame of the world if `apart`, else in its own.
  [[nodiscard]] view at_share(double share, const pose& where, bool apart) const noexcept {
    return {&news.mesh(), &news.from(),  &news.to(),
            share,        !news.moves(), apart && !(where == pose{}),
            where};
  }
  [[nodiscard]] view now(bool apart) const noexcept { return at_share(done, shown, apart); }
  /// When that much of what it is to do in this tick is done.
  [[nodiscard]] view later(double part, bool apart) const noexcept {
    return at_share(done_at_first + part * wanted, pose_at(part), apart);
  }
  [[nodiscard]] pose pose_at(double part) const noexcept {
    if (!turns()) return shown_at_first;
    return part < 1.0 ? between(shown_at_first, aim, part) : aim;
  }
  /// Where a point of a triangle is now, and where it was before the last tick, in the world [m].
  [[nodiscard]] triple went(int triangle, const triple& weights) const noexcept {
    return point_at(now(true).triangle(triangle), weights) -
           point_at(at_share(done_before, shown_before, true).triangle(triangle), weights);
  }

  /// Takes the news of the slow thread. touched_way() is by how much the way from one shape to the other moves what is
  /// touched [m].
  void hear(double dt, const touching_ball& ball, const auto& touched_way) noexcept {
    shown_before = shown;
    news.take_materials();
    hear_pose(dt, ball);
    hear_shape(dt, ball, touched_way);
    done_before = done;
    wanted = 0.0;
    if (news.moves()) {
      wanted = dt / shape_way;
      wanted = stuck < 0 ? -(std::min)(wanted, done) : (std::min)(wanted, 1.0 - done);
    }
    through = news.moves() || !(aim == shown) ? 0.0 : 1.0;
    done_at_first = done;
    shown_at_first = shown;
  }
  /// It has gone `part` of what it was to do in this tick.
  void go(double part) noexcept {
    through = part < 1.0 ? through + (1.0 - through) * part : 1.0;
    if (1.0 - through <= 1e-6) through = 1.0;
    done = done_at_first + through * wanted;
    shown = pose_at(through);
  }
  /// Ends a tick. A shape that has waited for `patience` ticks goes back if there are newer news, because those may
  /// leave room.
  void settle(double dt) noexcept {
    if (goes() && turns()) {  // the rest of the way begins here
      came_from = shown;
      pose_way = (std::max)((1.0 - pose_done) * pose_way, dt);
      pose_done = 0.0;
    }
    if (!news.moves()) return;
    if (!goes() && wanted > 0.0 && 1.0 - done < 1e-9) done = 1.0;
    if (stuck >= 0) {
      stuck = through < 0.01 ? stuck + 1 : 0;
      if (stuck > patience && news.has_news()) stuck = -1;
    }
  }

 private:
  static constexpr int patience = 50;

  /// The pose of a single mesh is shown at once; among several it is a motion, which may have to wait.
  void hear_pose(double dt, const touching_ball& ball) noexcept {
    pose_news.age += dt;
    if (const auto* told_now = news.take_pose()) {
      pose_news.hear();
      const timing& when = pose_news;
      const triple own = shown.in(ball.place - shown.position);
      const auto moves = [&own](const pose& from, const pose& to) {  // what is at the ball [m]
        return to.out(own) + to.position - from.out(own) - from.position;
      };
      const triple way = moves(told, told_now->where) * (1.0 / when.period);
      sees.hear(squared(way), dot(way, told_way), dot(way, way_before));
      way_before = std::exchange(told_way, way);
      const double steady = sees.share(), times = (1.0 + told_now->late) * when.mean;
      const bool foreseen = ball.placed && steady > 0.0 && when.are_due(dt);
      goal = foreseen ? onwards(told_now->where, told, sees.last() * times / when.period,
                                told_before, sees.before() * times / when.before)
                      : told_now->where;
      told_before = std::exchange(told, told_now->where);
      came_from = ball.placed ? shown : goal;
      const double distance = ball.presses ? length(moves(shown, goal)) : 0.0;
      pose_way = way_of(foreseen ? when.mean : when.left(), distance, steady, dt, ball);
      pose_done = 0.0;
    } else if (pose_done >= 1.0 && !(goal == told) && !pose_news.are_due(dt)) {
      came_from = shown;
      goal = told;
      pose_done = 0.0;
    }
    aim = shown;
    if (pose_done < 1.0) {
      pose_done = (std::min)(1.0, pose_done + dt / pose_way);
      aim = pose_done < 1.0 ? between(came_from, goal, pose_done) : goal;
    }
    if (ball.alone || !ball.placed) shown = aim;
  }
  /// The way to a new shape begins when the last way is done.
  void hear_shape(double dt, const touching_ball& ball, const auto& touched_way) noexcept {
    shape_news.age += dt;
    if (std::exchange(newest, news.newest()) != newest) shape_news.hear();
    if (news.moves() && done >= 1.0) {
      news.arrive();
    } else if (news.moves() && done <= 0.0 && stuck < 0) {  // it has gone back
      news.turn_back();
      done = 1.0;
    }
    if (news.moves()) return;
    stuck = 0;
    if (!news.go(shape_news.are_due(dt))) return;
    done = 0.0;
    shape_way = way_of(shape_news.left(), touched_way(), news.to().steady, dt, ball);
  }
  /// The time [s] for a way that moves what is touched by `distance` [m]: what is `left` until the next news, more for
  /// what is not steady, and all that may be taken for what swings to and fro from one to the next.
  [[nodiscard]] static double way_of(double left, double distance, double steady, double dt,
                                     const touching_ball& ball) noexcept {
    if (steady < 0.0) return (std::max)(ball.longest_way, dt);
    const double asked = (std::max)(left, distance * (1.0 - steady) / ball.news_speed);
    const double most = steady > 0.0 ? (std::max)(left, ball.longest_way) : ball.longest_way;
    return (std::max)((std::min)(asked, most), dt);
  }
};

}  // namespace detail
}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
