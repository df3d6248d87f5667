// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The laws of what belongs to a contact (the menu is in laws.hpp).

#include <passive_haptics/concepts.hpp>
#include <passive_haptics/laws/samples.hpp>
#include <passive_haptics/port/composing.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace laws {

/// From any unit normal to any other: unit length, at most `rate`·dt a step, there in the end.
template <class Space, class Normals>
[[nodiscard]] constexpr bool turns_at_most(const Normals& parameters, typename Space::scalar rate,
                                           int pairs = 20) noexcept {
  using scalar = typename Space::scalar;
  part_at<Normals, Space> normals(parameters);
  samples random(4);
  const scalar dt = scalar(0.001);
  const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < enough(pairs); ++i) {
    const typename Space::vector target = random.direction<Space>();
    typename Space::vector now = i == 0   ? typename Space::vector(-target)
                                 : i == 1 ? target
                                          : typename Space::vector(random.direction<Space>());
    const int steps = static_cast<int>(scalar(4) / (rate * dt)) + 2;
    for (int k = 0; k < steps; ++k) {
      const typename Space::vector next = normals.step(now, target, dt);
      if (!(Space::norm(typename Space::vector(next)) <= scalar(1) + slack)) return false;
      if (!(Space::norm(typename Space::vector(next)) >= scalar(1) - slack)) return false;
      const typename Space::vector chord = next - now;  // |chord| ≤ angle
      if (Space::dof > 1 && !(Space::norm(chord) <= rate * dt + slack)) return false;
      now = next;
    }
    if (!(now == target)) return false;
  }
  return true;
}

/// A step between unit normals is a unit normal, and from the target it stays there.
template <class Space, class Normals>
[[nodiscard]] constexpr bool stays_a_normal(const Normals& parameters, int pairs = 100) noexcept {
  using scalar = typename Space::scalar;
  part_at<Normals, Space> normals(parameters);
  samples random(7);
  const scalar slack = scalar(64) * std::numeric_limits<scalar>::epsilon();
  for (int i = 0; i < enough(pairs); ++i) {
    const typename Space::vector to = random.direction<Space>();
    const typename Space::vector from =
        i == 0 ? typename Space::vector(-to) : random.direction<Space>();
    const typename Space::vector next = normals.step(from, to, scalar(0.001));
    if (!(kernels::magnitude(scalar(Space::dot(next, next) - scalar(1))) <= slack)) return false;
    if (!(normals.step(to, to, scalar(0.001)) == to)) return false;
  }
  return true;
}

/// f* ≥ 0, zero outside, never falling with depth or rising with outward speed; depth() gives back
/// the depth of any force that is not zero.
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

/// After prepare(): a unit normal at every point, a depth that falls by s when x moves by s along it
/// and by no more than |x − y| whichever way, and toward(..., x, n, d) gives a constraint with normal
/// n in which x lies d deep.
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

/// What is published is the target; what is unusable is refused and changes nothing; what is released
/// fades to nothing and comes back with the next update.
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
