// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A knob or a slider with detents and end stops that come to rest, damped as a settled_force, from the stated numbers
// of its device. It needs no Eigen and is fit for firmware.
//
//     constexpr ph::exact_device motor{.mass = 5e-5, .damping = 1e-3, .force_limit = 0.2,   // kg·m², N·m·s/rad, N·m
//                                      .longest_tick = 1e-3, .rotary = true};
//     auto knob = ph::make_detents<ph::space<float, 1>>(motor, {.force = 0.15}, {.pitch = 0.26, .stiffness = 0.1});

#include <passive_haptics/compositions.hpp>
#include <passive_haptics/contact/settled_force.hpp>

namespace passive_haptics {
inline namespace v0 {

/// Between the stops, with u [m] = x less the nearest multiple of the pitch p and K [N/m] the displayed stiffness
/// (joints: rad, N·m/rad),
///     f = −K u (1 − 2|u|/p)
/// which is a sine to within 6 % of its maximum K p/8, without a call of sin. Beyond a stop a spring is added. The
/// force is the gradient of a potential, so a closed path takes and gives no energy (ours).
struct detents {
  double pitch{};      ///< p, the distance of neighbours [m], [rad]
  double stiffness{};  ///< K at the bottom of each [N/m], [N·m/rad]; 0: no detents
  double first = -std::numeric_limits<double>::infinity();  ///< the lower end stop [m]
  double last = std::numeric_limits<double>::infinity();    ///< the upper end stop [m]
  double stop_stiffness{};                                  ///< stiffness of both stops [N/m]
  double most =
      std::numeric_limits<double>::infinity();  ///< the largest stiffness that is displayed [N/m]
  settled_force rest{};                         ///< their damping; its mass has to be stated

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::not_negative(stiffness)) return {"stiffness", stiffness, "finite and ≥ 0 N/m"};
    if (stiffness > 0.0 && !detail::positive(pitch)) return {"pitch", pitch, "finite and > 0 m"};
    if (!(first < last)) return {"last", last, "> first, in m"};
    const bool ends = kernels::is_finite(first) || kernels::is_finite(last);
    if (!(ends ? detail::positive(stop_stiffness) : stop_stiffness == 0.0)) {
      return {"stop_stiffness", stop_stiffness, "finite and > 0 N/m where there is a stop, else 0"};
    }
    return most > 0.0 ? rest.check()
                      : parameter_fault{"most", most, "> 0 N/m; .friction pays for it"};
  }
  template <port P>
  class on;
};

template <port P>
class detents::on : private part_at<settled_force, P> {
  using damped = part_at<settled_force, P>;
  static_assert(P::dof == 1, "passive_haptics: detents have one degree of freedom");

 public:
  using damped::asks_for_numbers, damped::answered, damped::refused, damped::reset;
  using typename damped::request, typename damped::result_type, typename damped::scalar;

  constexpr explicit on(const detents& p) noexcept : damped(p.rest) { set(p); }
  constexpr void set(const detents& p) noexcept {
    damped::set(p.rest);
    pitch_ = detail::number<scalar>(p.pitch);
    stiffness_ = detail::number<scalar>(p.stiffness);
    first_ = detail::number<scalar>(p.first);
    last_ = detail::number<scalar>(p.last);
    stop_ = detail::number<scalar>(p.stop_stiffness);
    most_ = detail::number<scalar>(p.most);
  }
  [[nodiscard]] constexpr detents parameters() const noexcept {
    return {.pitch = static_cast<double>(pitch_),
            .stiffness = static_cast<double>(stiffness_),
            .first = static_cast<double>(first_),
            .last = static_cast<double>(last_),
            .stop_stiffness = static_cast<double>(stop_),
            .most = static_cast<double>(most_),
            .rest = damped::parameters()};
  }
  constexpr void adopt(scalar T, int late) noexcept {
    damped::adopt(T, late);
    settles_ =
        static_cast<scalar>(damped::parameters().most_stiffness(static_cast<double>(T), 0, late));
  }
  /// Explains the detent, or the stop, at x. `depth` is that of a spring of that stiffness with the same force.
  constexpr void explain(explanation& e, scalar x, scalar /*T*/, int /*late*/) const noexcept {
    const scalar asked = within(x) == x ? stiffness_ : stop_;
    e.asked = e.shown = static_cast<double>(asked);
    e.soften(static_cast<double>(most_), softened_by::encoder_steps);
    e.soften(static_cast<double>(settles_), softened_by::mass_and_tick);
    if (e.shown > 0.0) e.depth = static_cast<double>(kernels::magnitude(at(x))) / e.shown;
  }
  template <bool Shortcut>
  [[nodiscard, gnu::always_inline]] constexpr request ask(const auto& motion, const auto& port,
                                                          event& what) noexcept {
    damped::update(at(motion.position));
    return damped::template ask<Shortcut>(motion, port, what);
  }

 private:
  [[nodiscard]] constexpr scalar within(scalar x) const noexcept {
    return kernels::smaller(kernels::larger(x, first_), last_);
  }
  [[nodiscard]] constexpr scalar shown(scalar K) const noexcept {
    return kernels::smaller(K, kernels::smaller(most_, settles_));
  }
  /// The force f at x [N].
  [[nodiscard]] constexpr scalar at(scalar x) const noexcept {
    const scalar inside = within(x);
    const scalar stop = shown(stop_) * (inside - x);
    if (!(stiffness_ > scalar(0))) return stop;
    const scalar n = inside / pitch_;
    if (!(kernels::magnitude(n) < scalar(4e6)))
      return stop;  // beyond that a float cannot resolve a pitch
    const scalar half = n < scalar(0) ? scalar(-0.5) : scalar(0.5);
    const scalar u = inside - pitch_ * static_cast<scalar>(static_cast<std::int32_t>(n + half));
    return stop - shown(stiffness_) * u * (scalar(1) - scalar(2) * kernels::magnitude(u) / pitch_);
  }

  scalar pitch_{}, stiffness_{}, first_{}, last_{}, stop_{}, most_{};
  scalar settles_ = kernels::largest<scalar>();  ///< the largest stiffness that comes to rest [N/m]
};

static_assert(source_for<detents, space<float, 1>>);

namespace detail {
/// These detents on that device, with a stiffness of at most `budget` [N/m].
[[nodiscard]] constexpr detents fitted(detents shape, const auto& device, double budget) noexcept {
  shape.rest.mass = device.mass;
  shape.rest.force_limit = device.force_limit;
  shape.rest.softens = false;  // because the stiffness is known
  shape.most = kernels::smaller(shape.most, budget);
  const double steepest = kernels::larger(shape.stiffness, shape.stop_stiffness);
  const double shown = kernels::smaller(shape.most, steepest);
  shape.rest.damping_fraction = braking(device, shown, shown);
  return shape;
}
}  // namespace detail

/// A port with detents: port.tick(sample). Their stiffness is limited to one that comes to rest and, on encoders, to
/// the one that dry friction pays for; port.explain() says which. The guarantee is that of make_guard.
template <class Space, class Limits = loop_limits, detail::described Device = exact_device,
          detail::stated_hand Hand = known_hand>
[[nodiscard]] constexpr auto make_detents(const Device& device, const Hand& hand,
                                          const detents& shape) noexcept {
  const double budget = detail::budget_of(device, hand, Limits::latency);
  return detail::port_of<Space, Limits>(detail::fitted(shape, device, budget), device, hand,
                                        detail::bounds_of(device, hand));
}

/// The type that make_detents returns, for members of a class.
template <class Space, class Limits = loop_limits, class Device = exact_device,
          class Hand = known_hand>
using knob = decltype(make_detents<Space, Limits>(Device{}, Hand{}, detents{}));

}  // namespace v0
}  // namespace passive_haptics
