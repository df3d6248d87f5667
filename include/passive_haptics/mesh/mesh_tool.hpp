// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rigid tool that touches meshes at several of its points, as a source for a rigid_body port: one ledger and one
// bound for force and torque together.
//
//     auto tool = ph::make_mesh_tool({.inertia = …}, {.force = 5, .torque = 0.1}, std::array{left, tip, right},
//                                    {.stiffness = 1500});               // points in the frame of the handle [m]
//     tool.source().touch(organ);
//     motors.command(tool.tick({p, {w, x, y, z}}, ph::seconds{dt}).force);
//
// Each point is a mesh_contact with a ball and a memory of its own, so none passes through a triangle. The wrench is
//     f = Σ f_k,   τ = Σ r_k × f_k,   r_k from the handle to point k
// With the springs K_k of all of them −(f, τ) of meshes at rest is the gradient of Σ ½K_k|p_k − x_k|². Its stiffness in
// the inertia diag(m, I) is at most Σ K_k (1/m + r_k²/I), so point k of N has K_k and B_k of a device of the mass
//     m_k = 1/(N (1/m + r_k²/I))
// and all together are no steeper than κ/T² (contact/proxy.hpp), however many press. So a point is felt softer the more
// points a tool has: it knows no frame in which they are one, as those of rigid_tool are. Source: ours.

#include <passive_haptics/mesh/mesh_contact.hpp>
#include <passive_haptics/six_dof.hpp>

#include <algorithm>
#include <span>

namespace passive_haptics {
inline namespace v0 {

template <int Points>
struct mesh_tool {
  using offset = std::array<double, 3>;

  std::array<offset, std::size_t{Points}> points{};  ///< in the frame of the handle [m]
  mesh_contact shape{};    ///< of each point; the mass of its spring is m of the handle [kg]
  double least_inertia{};  ///< I, a lower bound of the moments of inertia about the handle [kg·m²]
  int used = Points;  ///< N: the first N points touch; it stays as it was when the port was made

  /// The contact of point k, with its share m_k of the handle.
  [[nodiscard]] constexpr mesh_contact contact(int k) const noexcept {
    mesh_contact one = shape;
    double r2 = 0.0;
    for (const double r : points[static_cast<std::size_t>(k)]) r2 += r * r;
    one.spring.mass = 1.0 / (used * (1.0 / shape.spring.mass + r2 / least_inertia));
    return one;
  }
  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    for (const auto& point : points) {
      for (const double r : point) {
        if (!kernels::is_finite(r)) return {"points", r, "finite"};
      }
    }
    if (!detail::positive(least_inertia)) {
      return {"least_inertia", least_inertia, "finite and > 0 kg·m²"};
    }
    if (used < 1 || used > Points) {
      return {"used", static_cast<double>(used), "from 1 to the number of points"};
    }
    return shape.check();
  }
  template <port Body>
  class on;
};

template <int Points>
template <port Body>
class mesh_tool<Points>::on {
 public:
  using scalar = typename Body::scalar;
  using effort = typename Body::effort;
  using space = typename Body::body_space;
  using vector = typename space::vector;
  using finger = mesh_contact::on<space>;
  using result_type = tick_result<Body>;
  static constexpr bool asks_for_numbers = false;  // a sum may overflow
  static constexpr bool touches_meshes = true;

  constexpr explicit on(const mesh_tool& p) noexcept
      : on(p, std::make_index_sequence<std::size_t{Points}>{}) {}
  [[nodiscard]] constexpr const mesh_tool& parameters() const noexcept { return stated_; }
  constexpr void set(const mesh_tool& p) noexcept {
    const int as_made = stated_.used;
    stated_ = p;
    stated_.used = as_made;
    each([&](finger& one, int k) { one.set(stated_.contact(k)); });
  }
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return stated_.check(); }
  constexpr void adopt(scalar T, int late) noexcept {
    each([&](finger& one, int) { one.adopt(T, late); });
  }
  [[nodiscard]] constexpr bool settles() const noexcept {
    bool all = true;
    for (const finger& one : in_use(fingers_)) all = all && one.settles();
    return all;
  }
  /// Forgets which side each point has touched, but keeps the meshes.
  constexpr void reset() noexcept {
    each([](finger& one, int) { one.reset(); });
  }

  /// Lets all points touch this mesh as well, or none: as mesh_contact. Each takes one of its 64 places.
  bool touch(const mesh::surface& s) noexcept {
    for (finger& one : in_use(fingers_)) {
      if (one.also_touch(s)) continue;
      if (&one != fingers_.data()) let_go(s);  // else it is touched already, or nowhere
      return false;
    }
    return true;
  }
  void let_go(const mesh::surface& s) noexcept {
    each([&](finger& one, int) { one.let_go(s); });
  }
  void let_go() noexcept {
    each([](finger& one, int) { one.let_go(); });
  }
  [[nodiscard]] const mesh::proxy& ball(int k) const noexcept {
    return fingers_[static_cast<std::size_t>(k)].ball();
  }
  /// The position in the world [m] of point k for a pose of the handle.
  [[nodiscard]] vector place(const typename Body::pose& handle, int k) const noexcept {
    return vector(handle.position) + arm(rotation::normalised(handle.orientation), k);
  }

  /// Explains the point that presses most, or the first.
  void explain(explanation& e, const auto& /*x*/, scalar T, int late) const noexcept {
    fingers_[0].explain(e, vector(space::zero()), T, late);
    for (const finger& one : in_use(fingers_)) {
      explanation own;
      own.force = e.force;
      one.explain(own, vector(space::zero()), T, late);
      if (own.depth > 0.0 && own.shown * own.depth > e.shown * e.depth) e = own;
    }
  }

  struct request {
    effort wanted;
    bool nothing;
    scalar depth;  ///< of the point that is deepest [m]
  };
  template <bool Shortcut>
  [[nodiscard]] request ask(const auto& motion, const auto& port, event& what) noexcept {
    const auto turn = rotation::normalised(motion.position.orientation);
    const vector at = motion.position.position, way = Body::linear(port.travel),
                 turning = Body::angular(port.travel);
    request all{Body::zero(), true, scalar(0)};
    std::array<vector, std::size_t{Points}> arms;  // NOLINT(*-member-init): read where `each` goes
    const auto motion_of = [&](int k) {
      const vector& r = arms[static_cast<std::size_t>(k)];
      return moved{at + r, way + space::cross(turning, r), port.dt};
    };
    // The points share what the ledger pays for: each for itself would spend all of it.
    typename finger::load load;
    each([&](const finger& one, int k) {
      arms[static_cast<std::size_t>(k)] = arm(turn, k);
      one.add_to(load, motion_of(k), static_cast<double>(port.dt));
    });
    each([&](finger& one, int k) {
      const vector& r = arms[static_cast<std::size_t>(k)];
      const auto asked = one.ask(motion_of(k), port, what, load);
      if (asked.nothing) return;
      all.wanted = all.wanted + Body::join(asked.wanted, space::cross(r, asked.wanted));
      all.nothing = false;
      all.depth = kernels::larger(all.depth, asked.depth);
    });
    return all;
  }
  [[nodiscard]] constexpr result_type answered(const request& r,
                                               const port_result<Body>& port) const noexcept {
    return {port.force, r.depth, port.energy, port.what, port.limited};
  }
  constexpr result_type refused(const port_result<Body>& port, scalar /*dt*/) noexcept {
    if (port.what == event::forces_off) each([](finger& one, int) { one.meet_anew(); });
    return {port.force, scalar(0), port.energy, port.what, false};
  }

 private:
  /// The motion of a point in a tick.
  struct moved {
    vector position, travel;  ///< [m]
    scalar dt;                ///< [s]
  };
  template <std::size_t... K>
  constexpr on(const mesh_tool& p, std::index_sequence<K...> /*all*/) noexcept
      : stated_(p), fingers_{finger(p.contact(static_cast<int>(K)))...} {}
  [[nodiscard]] constexpr auto in_use(auto& all) const noexcept {
    return std::span(all).first(static_cast<std::size_t>(std::clamp(stated_.used, 1, Points)));
  }
  constexpr void each(auto what) noexcept {
    int k = 0;
    for (finger& one : in_use(fingers_)) what(one, k++);
  }
  [[nodiscard]] vector arm(const auto& turn, int k) const noexcept {
    const auto& r = stated_.points[static_cast<std::size_t>(k)];
    return rotation::rotate<scalar>(turn, vector(scalar(r[0]), scalar(r[1]), scalar(r[2])));
  }

  mesh_tool stated_;
  std::array<finger, std::size_t{Points}> fingers_;
};

/// A port for a tool that touches meshes at these points of it, or the first `used`: port.source().touch(surface). The
/// guarantee is that of make_tool.
template <class Body = rigid_body<double>, class Limits = loop_limits, std::size_t Points>
[[nodiscard]] constexpr auto make_mesh_tool(const rigid_device& d, const rigid_hand& hand,
                                            const std::array<std::array<double, 3>, Points>& points,
                                            mesh_contact shape = {},
                                            int used = static_cast<int>(Points)) noexcept {
  using plane = half_space<typename Body::body_space>;
  const auto other = make_tool<Body, Limits>(d, hand, slots<plane, 1>{});
  const auto bounds = other.bound().parameters();
  const double left = d.inertia.at_handle();
  shape.spring.mass = left * d.inertia.mass;
  shape.spring.force_limit = d.force_limit;
  return passive_port{
      Body{}, mesh_tool<static_cast<int>(Points)>{points, shape, left * d.inertia.least, used},
      other.observer().parameters(), bound_chain{bounds.first, bounds.rest.first},
      Limits{.longest_tick = d.longest_tick}};
}

}  // namespace v0
}  // namespace passive_haptics
