// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rigid tool with contacts at several of its points: a peg, a scalpel, a box. It is a source for a rigid_body port,
// so there is one ledger and one bound for force and torque together.
//
//     ph::passive_port peg{ph::rigid_body<double>{},
//                          ph::rigid_tool{ph::tool_spring{.mass = 0.15, .least_inertia = 1e-4}, ph::pursuit{},
//                                         ph::slots<ph::half_space<scene>, 16>{}},
//                          ph::basic_reduced_energy<ph::rigid_damping>{.damping = {0.03, 1e-4}},
//                          ph::rigid_reachable_bound{…}, ph::loop_limits{.longest_tick = 0.0011}};
//     peg.source().update(0, point, floor);     // a point in the handle's frame and its surface
//
// Slot i has a point of the tool and a surface, so a corner of a box at three walls takes three slots. The proxy is
// the pose of the handle without penetration (contact/proxy.hpp), so 16 contacts are no stiffer than one.

#include <passive_haptics/contact/contact_engine.hpp>
#include <passive_haptics/device/rigid_body.hpp>

namespace passive_haptics {
inline namespace v0 {

/// How a tool presses: the coupling between the handle and its proxy,
///     C⁻¹ = diag(k_v I, k_ω I),   k_v = min(K, κ m/T²),   k_ω = min(K ℓ², κ I_least/T²)
/// which settles however many contacts there are: m and I_least are of the handle point, both at once
/// (rigid_inertia::at_handle), and many contacts together have κ/(1 − ε) of them. A point r off the handle is felt with
/// 1/(nᵀC n), n its row (n, r × n): softer than K, because the handle gives way to a turn.
struct tool_spring {
  double mass{};           ///< m, apparent mass of the handle [kg], a lower bound
  double least_inertia{};  ///< smallest moment of inertia about the handle [kg·m²], a lower bound
  double lever = 0.03;     ///< ℓ, a length of the tool [m]
  double stiffness_fraction = 0.1;  ///< κ, of m/T² and of I/T²
  double softness = 0.1;  ///< ε: more than for a point, since points of a tool are often alike

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = detail::sampled_fault(*this)) return fault;
    if (!v0::settles(stiffness_fraction / (1.0 - softness), detail::ticks_to_settle(*this))) {
      return {"softness", softness, "smaller: many contacts are as stiff as κ/(1 − ε), and ring"};
    }
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
        per_lever_(Scalar(1) / (lever_ * lever_)),
        softness_(detail::number<Scalar>(p.softness)) {}
  [[nodiscard]] constexpr tool_spring parameters() const noexcept {
    tool_spring p;
    rule_.state(p);
    p.least_inertia = static_cast<double>(inertia_);
    p.lever = static_cast<double>(lever_);
    p.softness = static_cast<double>(softness_);
    return p;
  }
  /// Sets the longest tick T [s] and the latency of `late` ticks.
  constexpr void adopt(Scalar T, int late = 0) noexcept {
    sampled_every_ = T;
    late_ = late;
    least_yield_ = T * T / (rule_.fraction(late) * inertia_);
  }
  /// K = min(K, (1 − ε) κ m/T²) [N/m] and B = K τ [N·s/m] of a point at the handle, τ = min(2√(m/k_v), 2√(I/k_ω), 5T),
  /// for translation and rotation. In a loop k ticks late it is 2.25(k + 1) T instead of 5T.
  [[nodiscard]] constexpr sampled_spring<Scalar> sampled(Scalar K) const noexcept {
    const Scalar k = rule_.stiffness(K, softness_, sampled_every_, late_);
    const Scalar slow = kernels::square_root(slowest(k, Scalar(1) / yield(Scalar(1) / k)));
    const Scalar most = detail::late_limits<Scalar>(late_).ticks * sampled_every_;
    return sampled_spring<Scalar>::of(k, k * kernels::smaller(Scalar(2) * slow, most));
  }
  /// γ = 1/k_ω = max(c/ℓ², T²/(κ I)) [rad/(N·m)] for c = 1/k_v [m/N].
  [[nodiscard]] constexpr Scalar yield(Scalar compliance) const noexcept {
    return kernels::larger(compliance * per_lever_, least_yield_);
  }
  /// Does a surface of K [N/m] come to rest under this spring? (settles() in sampled_spring.hpp)
  [[nodiscard]] constexpr bool settles(Scalar K) const noexcept {
    const auto s = sampled(K);
    const Scalar turns = s.stiffness * yield(s.compliance) * inertia_;
    const Scalar least = kernels::smaller(rule_.mass(), turns) * (Scalar(1) - softness_);
    return detail::comes_to_rest(s, least, sampled_every_, late_);
  }
  /// τ of a bristle [s], which has no other contact to agree with, so what sways on a soft floor is damped critically:
  /// min(2√s, ½ s/T), s = min(m/k_v, I/k_ω); late, β of late_limits for ½.
  [[nodiscard]] constexpr Scalar sliding(const sampled_spring<Scalar>& of) const noexcept {
    const Scalar s = slowest(of.stiffness, Scalar(1) / yield(of.compliance));
    const Scalar most = kernels::smaller(Scalar(0.5), detail::late_limits<Scalar>(late_).damping);
    return kernels::smaller(Scalar(2) * kernels::square_root(s), most * s / sampled_every_);
  }
  /// Why a point off the handle is shown softer: K ℓ² gives way to a turn, or κ I_least/T² does.
  [[nodiscard]] constexpr softened_by softener(Scalar K) const noexcept {
    const auto s = sampled(K);
    const bool gives = yield(s.compliance) > s.compliance * per_lever_ || s.stiffness < K;
    return gives ? softened_by::mass_and_tick : softened_by::coupling;
  }
  [[nodiscard]] constexpr Scalar softness() const noexcept { return softness_; }  ///< ε
  [[nodiscard]] constexpr Scalar lever() const noexcept { return lever_; }        ///< ℓ [m]

 private:
  /// min(m/k_v, I/k_ω) [s²].
  [[nodiscard]] constexpr Scalar slowest(Scalar k, Scalar turn) const noexcept {
    return kernels::smaller(rule_.mass() / k, inertia_ / turn);
  }
  detail::sampled_mass<Scalar> rule_;
  Scalar inertia_, lever_, per_lever_, softness_;  // per_lever_ = 1/ℓ²
  int late_ = 0;                                   ///< [ticks]
  Scalar sampled_every_{}, least_yield_{};         ///< T [s], T²/(κ I) [rad/(N·m)]
};

namespace detail {

/// The frame of a rigid body: a contact at r from the handle has the wrench (n, r × n) per newton.
template <class Body>
struct body_frame {
  using space = typename Body::body_space;
  using scalar = typename Body::scalar;
  using vector = typename space::vector;
  using row = typename Body::effort;
  using point = stored_vector<scalar, 3>;  ///< in the frame of the handle [m]
  using stored = typename Body::stored_pose;
  static constexpr bool naps = false;  ///< because a turn moves points far from the handle quickly
  /// The points share a load, and what the ledger pays for: each for itself would spend all of it.
  static constexpr bool shares_load = true;

  [[nodiscard]] static bool is_point(const point& p) noexcept { return space::is_finite(p); }
  [[nodiscard]] static vector place(const stored& was, const point& p) noexcept {
    return vector(was.position) + rotation::rotate<scalar>(was.orientation, p);
  }

  struct tick {
    struct spot {
      vector position;  ///< in the world [m]
      vector arm;       ///< from the handle to it [m]
    };
    stored pose, last;
    row way;                ///< of the handle in the last tick [m], [rad]
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
    [[nodiscard]] row moved() const noexcept { return way; }
    [[nodiscard]] stored place() const noexcept { return pose; }
  };
  [[nodiscard]] static tick now(const auto& motion, const auto& port, const stored& last) noexcept {
    stored pose = motion.position;
    pose.orientation = rotation::normalised(pose.orientation);
    return {pose, last, port.travel, vector(Body::linear(port.travel) / port.dt),
            vector(Body::angular(port.travel) / port.dt)};
  }

  /// A_ij and A_ii of (S1) for wrenches [m/N]: the forces share min(c_i, c_j), the torques min(γ_i, γ_j).
  template <class Spring>
  struct proxy {
    const Spring& spring;
    scalar together;  ///< 1 − ε
    [[nodiscard]] scalar inner(const row& a, const row& b, scalar least) const noexcept {
      return together * (space::dot(Body::linear(a), Body::linear(b)) * least +
                         space::dot(Body::angular(a), Body::angular(b)) * spring.yield(least));
    }
    [[nodiscard]] scalar own(const row& r, scalar compliance) const noexcept {
      return compliance + space::dot(Body::angular(r), Body::angular(r)) * spring.yield(compliance);
    }
    /// K nᵀC n at most, whatever the direction.
    [[nodiscard]] scalar most_yield(const point& p, scalar compliance) const noexcept {
      return scalar(1) + space::dot(p, p) * spring.yield(compliance) / compliance;
    }
  };
  template <class Spring>
  [[nodiscard]] static proxy<Spring> coupling(const Spring& spring) noexcept {
    return {spring, scalar(1) - spring.softness()};
  }
  [[nodiscard]] static row way_of(const row& moved, scalar /*dt*/) noexcept { return moved; }
  /// The motion to which a handle gives way by a wrench of one newton, C w, at a compliance [m/N].
  [[nodiscard]] static row yields(const auto& spring, const row& wrench,
                                  scalar compliance) noexcept {
    return Body::join(Body::linear(wrench) * compliance,
                      Body::angular(wrench) * spring.yield(compliance));
  }
  [[nodiscard]] static scalar power(const row& wrench, const row& way) noexcept {
    return space::dot(Body::linear(wrench), Body::linear(way)) +
           space::dot(Body::angular(wrench), Body::angular(way));
  }
  [[nodiscard]] static vector pushes(const row& wrench) noexcept { return Body::linear(wrench); }
  /// The size of a wrench [N], a torque counted as torque/ℓ.
  [[nodiscard]] static scalar size(const auto& spring, const row& wrench) noexcept {
    const vector turning = Body::angular(wrench) * (scalar(1) / spring.lever());
    return kernels::square_root(space::dot(Body::linear(wrench), Body::linear(wrench)) +
                                space::dot(turning, turning));
  }
  /// The size of a motion [m], a turn counted as turn·ℓ.
  [[nodiscard]] static scalar stretch(const auto& spring, const row& way) noexcept {
    const vector turning = Body::angular(way) * spring.lever();
    return kernels::square_root(space::dot(Body::linear(way), Body::linear(way)) +
                                space::dot(turning, turning));
  }
};

}  // namespace detail

/// Points and their surfaces in slots, with a spring, the rates at which they follow updates, and friction.
template <class Friction, class... Slots>
struct rigid_tool : contact_parameters<tool_spring, Friction, Slots...> {
  using base = contact_parameters<tool_spring, Friction, Slots...>;

  constexpr rigid_tool() noexcept = default;
  constexpr rigid_tool(const base& p) noexcept : base(p) {}  // NOLINT: the same
  using base::base;

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

  /// The position in the world [m] of a point of the tool, given in the frame of the handle [m], at a pose.
  [[nodiscard]] static auto place(const typename Body::pose& handle, const point& at) noexcept {
    typename detail::body_frame<Body>::stored pose = handle;
    pose.orientation = rotation::normalised(pose.orientation);
    return detail::body_frame<Body>::place(pose, at);
  }
  /// Sets slot i, counted among those of its kind: a point of the tool, in the frame of the handle [m], and its newest
  /// surface. Returns the stiffness displayed along its normal, or false if there is no such slot or one of both is
  /// unusable; then the last good ones stay, and the next tick has event::rejected_target.
  template <class Surface>
  constexpr news_taken<typename engine::scalar> update(int i, const point& at,
                                                       const Surface& next) noexcept {
    return this->put(i, at, next);
  }
  /// The same with the slot's present point.
  template <class Surface>
  constexpr news_taken<typename engine::scalar> update(int i, const Surface& next) noexcept {
    return this->put(i, this->template point_of<Surface>(i), next);
  }
};

}  // namespace v0
}  // namespace passive_haptics
