// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The content of a datagram in the types of this library: planes, quadrics, and where a probe is.
//
//   content_of(x)          x as it crosses the network
//   half_space_of<Space>   the plane, or the tangent plane of a quadric
//   quadric_of<Space>      the quadric; of anything else, one that every local model refuses
//   probe_of               the probe of a question, or of an answer that is a force
//
// Each end computes in its own scalar; in a datagram a number is a double.

#include <passive_haptics/base/parameter.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/constraint_geometry/quadric.hpp>
#include <passive_haptics/device/eigen_space.hpp>
#include <passive_haptics/remote/wire.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace remote {

/// A position, what acts there, and the energy that is promised to the receiver.
struct probe {
  stored_vector<double, 3> position{};  ///< [m]
  stored_vector<double, 3> force{};     ///< [N]
  double energy = 0.0;                  ///< E_in of a two-port [J]; 0 where there is none
};

namespace detail {

template <class Vector>
constexpr void put(content& c, std::size_t at, const Vector& v) noexcept {
  for (std::size_t i = 0; i < 3; ++i) c.numbers[at + i] = static_cast<double>(v[i]);
}
template <class Scalar>
[[nodiscard]] constexpr stored_vector<Scalar, 3> triple_at(const content& c,
                                                           std::size_t at) noexcept {
  using passive_haptics::detail::number;
  return {number<Scalar>(c.numbers[at]), number<Scalar>(c.numbers[at + 1]),
          number<Scalar>(c.numbers[at + 2])};
}

}  // namespace detail

template <class Scalar>
[[nodiscard]] constexpr content content_of(const half_space<space<Scalar, 3>>& plane) noexcept {
  content c{.form = form::plane};
  detail::put(c, 0, plane.point);
  detail::put(c, 3, plane.normal);
  c.numbers[6] = static_cast<double>(plane.stiffness);
  return c;
}
template <class Scalar>
[[nodiscard]] constexpr content content_of(const quadric<space<Scalar, 3>>& shape) noexcept {
  content c{.form = form::quadric};
  detail::put(c, 0, shape.point);
  detail::put(c, 3, shape.normal);
  c.numbers[6] = static_cast<double>(shape.stiffness);
  detail::put(c, 7, shape.tangent);
  c.numbers[10] = static_cast<double>(shape.curvature);
  c.numbers[11] = static_cast<double>(shape.cross_curvature);
  c.numbers[12] = static_cast<double>(shape.thickness);
  c.numbers[13] = static_cast<double>(shape.reach);
  return c;
}
[[nodiscard]] constexpr content content_of(const probe& p) noexcept {
  content c{.form = form::probe};
  detail::put(c, 0, p.position);
  detail::put(c, 3, p.force);
  c.numbers[6] = p.energy;
  return c;
}

/// Content that is neither a plane nor a quadric gives stiffness zero, which every local model refuses.
template <class Space>
requires(Space::dof == 3)
    [[nodiscard]] constexpr half_space<Space> half_space_of(const content& c) noexcept {
  using scalar = typename Space::scalar;
  if (c.form != form::plane && c.form != form::quadric) return {};
  return {.point = detail::triple_at<scalar>(c, 0),
          .normal = detail::triple_at<scalar>(c, 3),
          .stiffness = passive_haptics::detail::number<scalar>(c.numbers[6])};
}
template <class Space>
requires(Space::dof == 3)
    [[nodiscard]] constexpr quadric<Space> quadric_of(const content& c) noexcept {
  using scalar = typename Space::scalar;
  using passive_haptics::detail::number;
  if (c.form != form::quadric) return {};
  return {.point = detail::triple_at<scalar>(c, 0),
          .normal = detail::triple_at<scalar>(c, 3),
          .tangent = detail::triple_at<scalar>(c, 7),
          .curvature = number<scalar>(c.numbers[10]),
          .cross_curvature = number<scalar>(c.numbers[11]),
          .stiffness = number<scalar>(c.numbers[6]),
          .thickness = number<scalar>(c.numbers[12]),
          .reach = number<scalar>(c.numbers[13])};
}
[[nodiscard]] constexpr probe probe_of(const content& c) noexcept {
  if (c.form != form::probe) return {};
  return {.position = detail::triple_at<double>(c, 0),
          .force = detail::triple_at<double>(c, 3),
          .energy = c.numbers[6]};
}

/// True for a surface that a local model in double accepts, for a probe, and for empty content.
[[nodiscard]] inline bool usable(const content& c) noexcept {
  using scene = space<double, 3>;
  if (c.form == form::plane) return half_space_of<scene>(c).prepare();
  if (c.form == form::quadric) return quadric_of<scene>(c).prepare();
  return true;
}

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics
