// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The laws of the parts of a contact (the menu is in laws.hpp).

#include <passive_haptics/base/samples.hpp>
#include <passive_haptics/constraint_geometry/surface_probe.hpp>
#include <passive_haptics/port/composing.hpp>
#include <passive_haptics/port/concepts.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace detail {
/// 1 + |centre|/radius, the factor of rounding errors of coordinates in a neighbourhood away from the origin.
template <class Space>
[[nodiscard]] constexpr typename Space::scalar off_centre(const neighbourhood<Space>& of) noexcept {
  return typename Space::scalar(1) + Space::norm(of.centre) / of.radius;
}

/// Satisfied by a surface whose depth is a distance, so that its force is along its normal: it has no push().
template <class Surface, class Space>
concept measures_distance = requires(const Surface s, const typename Space::vector x) {
  s.at(x);
}
&&!says_push<decltype(std::declval<const Surface&>().at(Space::zero()))>;

}  // namespace detail

namespace laws {

/// Steps from any unit normal to any other keep |n| = 1, turn by at most `rate`·dt [rad] each, and reach it.
template <class Space, class Normals>
[[nodiscard]] constexpr bool turns_at_most(const Normals& parameters, typename Space::scalar rate,
                                           int pairs = 20) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  part_at<Normals, Space> normals(parameters);
  samples random(4);
  const scalar dt = scalar(0.001);
  const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < enough(pairs); ++i) {
    const vector target = random.direction<Space>();
    vector now = i == 0 ? vector(-target) : i == 1 ? target : vector(random.direction<Space>());
    const int steps = static_cast<int>(scalar(4) / (rate * dt)) + 2;
    for (int k = 0; k < steps; ++k) {
      const vector next = normals.step(now, target, dt);
      if (!(Space::norm(vector(next)) <= scalar(1) + slack)) return false;
      if (!(Space::norm(vector(next)) >= scalar(1) - slack)) return false;
      const vector chord = next - now;  // |chord| ≤ angle
      if (Space::dof > 1 && !(Space::norm(chord) <= rate * dt + slack)) return false;
      now = next;
    }
    if (!(now == target)) return false;
  }
  return true;
}

/// A step between unit normals gives a unit normal, and a step from the target stays there.
template <class Space, class Normals>
[[nodiscard]] constexpr bool stays_a_normal(const Normals& parameters, int pairs = 100) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  part_at<Normals, Space> normals(parameters);
  samples random(7);
  const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < enough(pairs); ++i) {
    const vector to = random.direction<Space>();
    const vector from = i == 0 ? vector(-to) : random.direction<Space>();
    const vector next = normals.step(from, to, scalar(0.001));
    if (!(kernels::magnitude(scalar(Space::dot(next, next) - scalar(1))) <= slack)) return false;
    if (!(normals.step(to, to, scalar(0.001)) == to)) return false;
  }
  return true;
}

/// f* ≥ 0. It is zero outside, does not fall with depth and does not rise with outward speed; depth() is the inverse
/// of every force that is not zero.
template <class Space, class Law>
[[nodiscard]] constexpr bool presses_outwards(const Law& parameters, int ticks = 200) noexcept {
  using scalar = typename Space::scalar;
  part_at<Law, Space> law(parameters);
  samples random(5);
  for (int i = 0; i < enough(ticks); ++i) {
    law.adopt(scalar(5000) * (scalar(1.1) + random.number<scalar>()), scalar(0.001));
    const scalar d = random.number<scalar>() * scalar(0.01);
    const scalar v = random.number<scalar>();
    const scalar f = law.force(d, v);
    if (!(f >= scalar(0)) || (d <= scalar(0) && f > scalar(0))) return false;
    if (law.force(d + scalar(0.001), v) < f) return false;
    if (law.force(d, v + scalar(0.1)) > f) return false;
    const scalar miss = law.depth(f, v) - d;
    if (f > scalar(0) && kernels::magnitude(miss) > scalar(1e-4) * d) return false;
  }
  return true;
}

/// After prepare() there is a unit normal at every point; depth falls by s when x moves by s along it, and changes by
/// at most |x − y| from x to y; and toward(..., x, n, d) gives a constraint with the normal n in which x lies d deep.
template <class Space, class Constraint>
[[nodiscard]] constexpr bool measures_depth(Constraint constraint, int ticks = 100) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  if (!constraint.prepare()) return false;
  samples random(6);
  const scalar slack = scalar(256) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < enough(ticks); ++i) {
    const vector x = random.vector<Space>();
    const auto here = constraint.at(x);
    const vector n = here.outward();
    const scalar unit = Space::dot(n, n) - scalar(1);
    if (!(unit * unit <= slack * slack)) return false;
    const scalar s = random.number<scalar>() * scalar(1e-3);
    const vector along = x + n * s;
    const scalar change = constraint.at(along).depth - (here.depth - s);
    if (!(change * change <= slack * slack)) return false;
    const vector y = x + random.vector<Space>();
    const vector way = y - x;
    const scalar difference = constraint.at(y).depth - here.depth;
    if (!(difference * difference <= Space::dot(way, way) * (scalar(1) + slack) + slack)) {
      return false;
    }
    const vector m = random.direction<Space>();
    const scalar d = s * s;
    const auto moved = constraint.toward(constraint, x, m, d);
    const auto there = moved.at(x);
    const scalar miss = there.depth - d;
    const vector turned = there.outward() - m;
    if (!(miss * miss + Space::dot(turned, turned) <= slack * slack)) return false;
  }
  return true;
}

/// The region in which the laws try a surface: its around(), else the ball of 1 m around the origin.
template <class Space, class Surface>
[[nodiscard]] constexpr neighbourhood<Space> where_to_look(const Surface& surface) noexcept {
  if constexpr (requires { surface.around(); }) return surface.around();
  return {Space::zero(), typename Space::scalar(1)};
}

/// prepare() accepts the surface, and refuses it with a stiffness that is zero, negative or not finite.
template <class Space, class Surface>
[[nodiscard]] constexpr bool refuses_no_stiffness(Surface surface) noexcept {
  using scalar = typename Space::scalar;
  using limits = std::numeric_limits<scalar>;
  auto good = surface;
  if (!good.prepare()) return false;
  for (const scalar bad :
       {scalar(0), scalar(-1), scalar(limits::quiet_NaN()), scalar(limits::infinity())}) {
    surface.stiffness = bad;
    if (surface.prepare()) return false;
  }
  return true;
}

/// After prepare() the surface has a unit normal everywhere, covered or not.
template <class Space, class Surface>
[[nodiscard]] constexpr bool has_a_unit_normal(Surface surface, int points = 200) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  if (!surface.prepare()) return false;
  const neighbourhood<Space> place = where_to_look<Space>(surface);
  samples random(8);
  const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < enough(points); ++i) {
    const vector x = vector(place.centre) + random.vector<Space>() * place.radius;
    const vector n = surface.at(x).outward();
    if (!(kernels::magnitude(scalar(Space::dot(n, n) - scalar(1))) <= slack)) return false;
  }
  return true;
}

/// After prepare() push(), or outward() if there is none, equals −∇depth by central differences. Points at which it
/// turns too fast for a difference, as at an edge, are left out; they may be a quarter of the covered points, and
/// at least one point must be covered.
template <class Space, class Surface>
[[nodiscard]] constexpr bool pushes_along_its_gradient(Surface surface, int points = 400) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  if (!surface.prepare()) return false;
  const neighbourhood<Space> place = where_to_look<Space>(surface);
  samples random(9);
  scalar step(1);  // with step³ ≤ ε a central difference errs least
  while (step * step * step > std::numeric_limits<scalar>::epsilon()) step = step / scalar(2);
  const scalar slack = scalar(512) * step * step * detail::off_centre(place);
  int tried = 0, told = 0;
  for (int i = 0; i < enough(points); ++i) {
    const vector x = vector(place.centre) + random.vector<Space>() * place.radius;
    const auto here = surface.at(x);
    if (!here.covered()) continue;
    const vector push = detail::steepest_push<Space>(here);
    bool smooth = true, right = true;
    for (int axis = 0; axis < Space::dof; ++axis) {
      vector up = x, down = x;
      Space::component(up, axis) += step * place.radius;
      Space::component(down, axis) -= step * place.radius;
      const auto above = surface.at(up), below = surface.at(down);
      const vector turn = detail::steepest_push<Space>(above) - detail::steepest_push<Space>(below);
      smooth =
          smooth && above.covered() && below.covered() && Space::norm(turn) <= scalar(32) * step;
      const scalar way = Space::component(up, axis) - Space::component(down, axis);
      const scalar miss = (above.depth - below.depth) / way + Space::component(push, axis);
      right = right && kernels::magnitude(miss) <= slack;
    }
    ++tried;
    told += smooth ? 1 : 0;
    if (smooth && !right) return false;
  }
  return tried > 0 && 4 * told >= 3 * tried;
}

/// After prepare() depth does not jump: between two covered points it changes by no more than their distance times the
/// largest |push()| between them, which is 1 if depth is the distance. On each axis the points are up to 1/16 of the
/// neighbourhood's radius apart, so a jump that is small compared with that is not found.
template <class Space, class Surface>
[[nodiscard]] constexpr bool changes_depth_steadily(Surface surface, int pairs = 400) noexcept {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  if (!surface.prepare()) return false;
  const neighbourhood<Space> place = where_to_look<Space>(surface);
  samples random(10);
  constexpr int pieces = 8;
  const scalar rounding = scalar(256) * std::numeric_limits<scalar>::epsilon() * place.radius *
                          detail::off_centre(place);
  for (int i = 0; i < enough(pairs); ++i) {
    const vector x = vector(place.centre) + random.vector<Space>() * place.radius;
    const vector way = random.vector<Space>() * (place.radius / scalar(16));
    const vector y = x + way;  // named, because a probe may hold a reference to it
    const auto here = surface.at(x), there = surface.at(y);
    scalar steepest(1);
    bool covered = here.covered() && there.covered();
    for (int piece = 0; covered && piece <= pieces; ++piece) {
      const vector z = x + way * (scalar(piece) / scalar(pieces));
      const auto between = surface.at(z);
      covered = between.covered();
      if constexpr (detail::says_push<decltype(between)>) {
        steepest = kernels::larger(steepest, Space::norm(vector(between.push())));
      }
    }
    if (!covered) continue;
    const scalar change = kernels::magnitude(scalar(there.depth - here.depth));
    if (!(change <= steepest * Space::norm(way) + rounding)) return false;
  }
  return true;
}

/// A published constraint becomes the target. An unusable one is refused and changes nothing. After release() the
/// weight of the contact falls to 0, and it is 1 again with the next update.
template <class Space, class Supply>
[[nodiscard]] constexpr bool keeps_the_newest(Supply supply,
                                              typename Supply::constraint_type good) noexcept {
  using scalar = typename Space::scalar;
  if (!supply.update(good)) return false;
  if (!(supply.weight() == scalar(1)) || !(supply.target().stiffness == good.stiffness))
    return false;
  auto bad = good;
  bad.stiffness = -good.stiffness;
  if (supply.update(bad) || !(supply.target().stiffness == good.stiffness)) return false;
  supply.release();
  scalar last = supply.weight();
  for (int i = 0; i < 100000 && supply.weight() > scalar(0); ++i) {
    supply.grow_older(scalar(0.001));
    if (supply.weight() > last) return false;
    last = supply.weight();
  }
  return last == scalar(0) && supply.update(good) && supply.weight() == scalar(1);
}

}  // namespace laws
}  // namespace v0
}  // namespace passive_haptics
