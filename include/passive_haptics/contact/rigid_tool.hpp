// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rigid tool that touches the world at several of its points: a peg, a scalpel, a box. A source for a
// rigid_body port, so one ledger and one bound for force and torque together.
//
//     ph::passive_port peg{ph::rigid_body<double>{},
//                          ph::rigid_tool{ph::tool_spring{.mass = 0.15, .least_inertia = 1e-4}, ph::pursuit{},
//                                         ph::slots<ph::half_space<scene>, 16>{}},
//                          ph::basic_reduced_energy<ph::rigid_damping>{.damping = {0.03, 1e-4}},
//                          ph::rigid_reachable_bound{…}, ph::loop_limits{.longest_tick = 0.0011}};
//     peg.source().update(0, point, floor);     // a point of the handle's frame and what it may touch
//
// Slot i is a point of the tool and a surface: a corner of a box that meets three walls takes three slots. The
// proxy is the pose that the handle would have if it could not enter (contact/proxy.hpp), so the tool is no
// stiffer with 16 contacts than with one.

#include <passive_haptics/contact/contact_engine.hpp>
#include <passive_haptics/device/rigid_body.hpp>

namespace passive_haptics {
inline namespace v0 {

/// How a tool presses: the coupling between the handle and its proxy,
///     C⁻¹ = diag(k_v I, k_ω I),   k_v = min(K, κ m/T²),   k_ω = min(K ℓ², κ I_least/T²)
/// which settles however many contacts there are. A point r off the handle is felt with
/// 1/(nᵀC n), n its row (n, r × n): softer than K, because the handle gives way to a turn.
struct tool_spring {
  double mass{};           ///< m, apparent mass of the handle [kg], a lower bound
  double least_inertia{};  ///< smallest moment of inertia about the handle [kg·m²], a lower bound
  double lever = 0.03;     ///< ℓ, a length of the tool [m]
  double stiffness_fraction = 0.1;  ///< κ, of m/T² and of I/T²
  double softness = 0.1;            ///< ε: more than for a point, because sweeps converge faster

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = detail::sampled_fault(*this)) return fault;
    if (!detail::positive(least_inertia)) {
      return {"least_inertia", least_inertia, "finite and > 0 kg·m²"};
    }
    if (!detail::positive(lever)) return {"lever", lever, "finite and > 0 m"};
    return {};
  }
  template <class Scalar>
  class at;
};

template <class Scalar>
class tool_spring::at {
 public:
  constexpr explicit at(const tool_spring& p) noexcept
      : rule_(p),
        inertia_(detail::number<Scalar>(p.least_inertia)),
        lever_(detail::number<Scalar>(p.lever)),
        softness_(detail::number<Scalar>(p.softness)) {}
  [[nodiscard]] constexpr tool_spring parameters() const noexcept {
    tool_spring p;
    rule_.state(p);
    p.least_inertia = static_cast<double>(inertia_);
    p.lever = static_cast<double>(lever_);
    p.softness = static_cast<double>(softness_);
    return p;
  }
  /// From now on for ticks of T at most [s].
  constexpr void adopt(Scalar T) noexcept { sampled_every_ = T; }
  /// K = min(K, (1 − ε) κ m/T²) and B = K τ of a point at the handle.
  [[nodiscard]] constexpr sampled_spring<Scalar> sampled(Scalar K) const noexcept {
    const Scalar k = rule_.stiffness(K, softness_, sampled_every_);
    return sampled_spring<Scalar>::of(k, k * settling_time(k, k * lever_ * lever_));
  }
  /// k_ω [N·m/rad] beside k_v = K [N/m].
  [[nodiscard]] constexpr Scalar turning(Scalar K) const noexcept {
    return kernels::sampled_stiffness(K * lever_ * lever_, rule_.fraction(), inertia_,
                                      sampled_every_);
  }
  /// The same at any depth: what the motors cannot give is cut by the bound.
  [[nodiscard]] static constexpr bool saturates(const sampled_spring<Scalar>& /*s*/,
                                                Scalar /*d*/) noexcept {
    return false;
  }
  [[nodiscard]] static constexpr sampled_spring<Scalar> saturated(const sampled_spring<Scalar>& s,
                                                                  Scalar /*d*/) noexcept {
    return s;
  }
  [[nodiscard]] constexpr Scalar softness() const noexcept { return softness_; }  ///< ε

 private:
  /// τ = min(2√(m/k_v), 2√(I/k_ω), 5T) [s]: B/K of damped_spring, for travel and for turns.
  [[nodiscard]] constexpr Scalar settling_time(Scalar k, Scalar turn) const noexcept {
    const Scalar slowest = kernels::smaller(rule_.mass() / k, inertia_ / turn);
    return kernels::smaller(Scalar(2) * kernels::square_root(slowest), Scalar(5) * sampled_every_);
  }
  detail::sampled_mass<Scalar> rule_;
  Scalar inertia_, lever_, softness_;
  Scalar sampled_every_{};  ///< T [s]
};

namespace detail {

/// A device that is a rigid body: a contact at r off the handle pushes with the wrench (n, r × n).
template <class Body>
struct body_frame {
  using space = typename Body::body_space;
  using scalar = typename Body::scalar;
  using vector = typename space::vector;
  using row = typename Body::effort;
  using point = stored_vector<scalar, 3>;  ///< in the frame of the handle [m]
  using stored = typename Body::stored_pose;

  [[nodiscard]] static bool is_point(const point& p) noexcept { return space::is_finite(p); }
  [[nodiscard]] static vector place(const stored& was, const point& p) noexcept {
    return vector(was.position) + rotation::rotate<scalar>(was.orientation, p);
  }
  [[nodiscard]] static scalar along(const row& a, const row& way) noexcept {
    return Body::work(a, way).joules;
  }

  struct tick {
    struct spot {
      vector position;  ///< in the world [m]
      vector arm;       ///< from the handle to it [m]
    };
    stored pose, last;
    vector speed, turning;  ///< of the handle [m/s], [rad/s]

    [[nodiscard]] spot at(const point& p) const noexcept {
      const vector arm = rotation::rotate<scalar>(pose.orientation, p);
      return {vector(pose.position) + arm, arm};
    }
    [[nodiscard]] vector velocity(const spot& s) const noexcept {
      return speed + space::cross(turning, s.arm);
    }
    [[nodiscard]] scalar along(const spot& s, const vector& n) const noexcept {
      return space::dot(velocity(s), n);
    }
    [[nodiscard]] vector travel(const point& p, const spot& s) const noexcept {
      return s.position - body_frame::place(last, p);
    }
    [[nodiscard]] row row_of(const spot& s, const vector& n) const noexcept {
      return Body::join(n, space::cross(s.arm, n));
    }
    [[nodiscard]] stored place() const noexcept { return pose; }
  };
  [[nodiscard]] static tick now(const auto& motion, const auto& port, const stored& last) noexcept {
    stored pose = motion.position;
    pose.orientation = rotation::normalised(pose.orientation);
    return {pose, last, vector(Body::linear(port.travel) / port.dt),
            vector(Body::angular(port.travel) / port.dt)};
  }

  /// C = diag(1/k_v, 1/k_ω) (1 − ε).
  struct proxy {
    scalar stiffness, turning, together;  ///< k_v, k_ω, 1 − ε
    [[nodiscard]] scalar turns(const vector& a, const vector& b) const noexcept {
      return space::dot(a, b) * (stiffness / turning);
    }
    [[nodiscard]] scalar inner(const row& a, const row& b) const noexcept {
      return together * (space::dot(Body::linear(a), Body::linear(b)) +
                         turns(Body::angular(a), Body::angular(b)));
    }
    void bring(auto& problem) const noexcept {
      problem.couple(stiffness);
      for (std::size_t i = 0; i < problem.count; ++i) {
        const vector torque = Body::angular(problem.row[i]);
        problem.own[i] += turns(torque, torque);
      }
    }
    [[nodiscard]] row way(const row& wrench) const noexcept {
      if (!(stiffness > scalar(0))) return Body::zero();
      return Body::join(Body::linear(wrench) * (together / stiffness),
                        Body::angular(wrench) * (together / turning));
    }
    /// K nᵀC n at most, whatever the direction.
    [[nodiscard]] scalar most_yield(const point& p) const noexcept {
      return scalar(1) + turns(p, p);
    }
  };
  [[nodiscard]] static proxy coupling(const auto& spring, scalar stiffest) noexcept {
    return {stiffest, spring.turning(stiffest), scalar(1) - spring.softness()};
  }
};

}  // namespace detail

/// The points and their surfaces, how they press, how fast they follow, and whether they rub.
template <class Friction, class... Slots>
struct rigid_tool : contact_parameters<tool_spring, Friction, Slots...> {
  using base = contact_parameters<tool_spring, Friction, Slots...>;

  constexpr rigid_tool() noexcept = default;
  constexpr rigid_tool(const base& p) noexcept : base(p) {}  // NOLINT: the same
  constexpr rigid_tool(const tool_spring& s, const pursuit& p,
                       const std::type_identity_t<Friction>& f, const Slots&... room) noexcept
      : base(s, p, f, room...) {}
  constexpr rigid_tool(const tool_spring& s, const pursuit& p, const Slots&... room) noexcept
      : base(s, p, Friction{}, room...) {}

  template <port Body>
  class on;
};
template <class... Surfaces, int... Counts>
rigid_tool(const tool_spring&, const pursuit&, const slots<Surfaces, Counts>&...)
    -> rigid_tool<frictionless, slots<Surfaces, Counts>...>;
template <class Friction, class... Surfaces, int... Counts>
requires std::same_as<Friction, stick_slip> || std::same_as<Friction, frictionless> rigid_tool(
    const tool_spring&, const pursuit&, const Friction&, const slots<Surfaces, Counts>&...)
->rigid_tool<Friction, slots<Surfaces, Counts>...>;

template <class Friction, class... Slots>
template <port Body>
class rigid_tool<Friction, Slots...>::on
    : public detail::contact_engine<Body, detail::body_frame, tool_spring, Friction, Slots...> {
  using engine = detail::contact_engine<Body, detail::body_frame, tool_spring, Friction, Slots...>;

 public:
  using point = typename engine::point_type;

  constexpr on() noexcept : on(rigid_tool{}) {}
  constexpr explicit on(const rigid_tool& p) noexcept : engine(p) {}

  /// Slot i, counted among those of its kind: a point of the tool, in the frame of the handle [m], and the
  /// world's newest surface there. False: there is no such slot, or one of them is unusable; the last good
  /// ones stay, and the next tick says so too.
  template <class Surface>
  constexpr bool update(int i, const point& at, const Surface& next) noexcept {
    return this->put(i, at, next);
  }
  /// The same point.
  template <class Surface>
  constexpr bool update(int i, const Surface& next) noexcept {
    return this->put(i, this->template slot<Surface>(i).point, next);
  }
};

}  // namespace v0
}  // namespace passive_haptics
