// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What must hold for ANY parameters that check() accepts, any world and any samples, bit by bit: every force is
// finite and within what the motors hold, and a port that check() refuses gives none. Returns null, or what broke.
#include "fuzz/numbers.hpp"
#include <passive_haptics/compositions.hpp>
#include <passive_haptics/contact/at_tip.hpp>
#include <passive_haptics/passive_haptics.hpp>
#include <passive_haptics/published/published.hpp>
#include <passive_haptics/six_dof.hpp>

#include <bit>
#include <cmath>

namespace fuzz {

namespace ph = passive_haptics;

template <class P>
constexpr bool turns_too = requires(typename P::pose x) {
  x.orientation;
};

/// A sample some way from the last, or of any bits.
template <class P>
struct sampler {
  typename P::stored_pose place{};

  ph::device_sample<P> next(numbers& in, unsigned how, double reach, double force) noexcept {
    using S = typename P::scalar;
    ph::device_sample<P> s;
    s.dt = how < 128 ? S(1e-3) : in.around<S>(2e-3);
    s.valid = how != 77;
    if constexpr (turns_too<P>) {
      auto& at = place.position.values;
      for (auto& x : at) x += in.around<S>(reach);
      auto& q = place.orientation;
      if (how % 4 == 0) {
        q.x += in.around<S>(0.02);
        q.y += in.around<S>(0.02);
        q.w = in.around<S>(1.0);
        const S norm = std::sqrt(ph::rotation::squared_norm(q));
        if (how % 16 != 0) q = {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
      }
      s.position = place;
      if (how % 8 == 3) put(s.held, in, force);
      if (!at_all(at) || !std::isfinite(ph::rotation::squared_norm(q))) place = {};
    } else {
      typename P::pose x = place;
      for (int i = 0; i < P::dof; ++i) P::component(x, i) += in.around<S>(reach);
      s.position = x;
      if (how % 8 == 3) put(s.held, in, force);
      place = P::is_finite(x) && P::squared(x) < S(100) ? x : P::zero();
    }
    return s;
  }

 private:
  static bool at_all(const auto& values) noexcept {
    bool all = true;
    for (const auto v : values) all &= std::isfinite(v) && std::abs(v) < 10;
    return all;
  }
  static void put(typename P::stored_effort& held, numbers& in, double force) noexcept {
    typename P::effort f = held;
    for (int i = 0; i < P::dof; ++i) {
      P::component(f, i) = in.around<typename P::scalar>(force);
    }
    held = f;
  }
};

template <class P>
struct limits_of {
  double force = std::numeric_limits<double>::infinity();   ///< [N]
  double torque = std::numeric_limits<double>::infinity();  ///< [N·m]

  [[nodiscard]] const char* broken_by(const typename P::effort& f) const noexcept {
    if (!P::is_finite(f)) return "a force that is no number";
    using number = std::numeric_limits<typename P::scalar>;
    constexpr double up = 1.0 + 16.0 * static_cast<double>(number::epsilon());
    const double few =
        4.0 *
        std::sqrt(static_cast<double>((number::min)()));  // [N], whose square is no number any more
    if constexpr (requires { P::angular(f); }) {
      if (size<0>(f) > force * up + few) return "a force above the motors' limit";
      if (size<3>(f) > torque * up + few) return "a torque above the motors' limit";
    } else {
      if (size<0>(f) > force * up + few) return "a force above the motors' limit";
    }
    return nullptr;
  }

 private:
  template <int First>
  static double size(const typename P::effort& f) noexcept {
    double sum = 0.0;
    for (int i = First; i < (P::dof < First + 3 ? P::dof : First + 3); ++i) {
      sum = std::hypot(sum, static_cast<double>(P::component(f, i)));
    }
    return sum;
  }
};

template <class Space>
ph::half_space<Space> plane_of(numbers& in) noexcept {
  using S = typename Space::scalar;
  ph::half_space<Space> plane;
  typename Space::vector p = Space::zero(), n = Space::zero();
  for (int i = 0; i < Space::dof; ++i) {
    Space::component(p, i) = in.around<S>(2e-3);
    Space::component(n, i) = in.around<S>(1.0);
  }
  if ((in.one() & 1) != 0)
    n = Space::norm(n) > S(0) ? typename Space::vector(n / Space::norm(n)) : n;
  plane.point = p;
  plane.normal = n;
  plane.stiffness = static_cast<S>(in.about(1000.0));
  return plane;
}

/// Ticks `port` until the input is over. `tell(op)` gives it news, and new parameters.
template <class P, class Port>
const char* run(Port& port, numbers& in, limits_of<P>& most, double force, auto&& tell) noexcept {
  using S = typename P::scalar;
  sampler<P> device;
  bool off = false;
  for (int n = 0; n < 300 && !in.empty(); ++n) {
    const unsigned op = in.one();
    if (op >= 224) {
      tell(op);
    } else if (op == 223) {
      port.reset();
    } else if (op == 221 || op == 222) {
      off = op == 221;
      port.enable_forces(!off);
    }
    const bool sound = !port.check() && !off;
    const auto sample = device.next(in, op, op % 3 == 0 ? 1e-2 : 2e-4, force);
    typename P::effort got = P::zero();
    if constexpr (requires(typename P::effort w) { port.tick(sample, w); }) {
      typename P::effort wanted = P::zero();
      for (int i = 0; i < P::dof; ++i) P::component(wanted, i) = in.around<S>(2.0 * force);
      got = port.tick(sample, wanted).force;
    } else {
      got = port.tick(sample).force;
    }
    if (const char* broken = most.broken_by(got)) return broken;
    if (!sound && !(got == P::zero()))
      return "a force of a port that check() refuses, or that is off";
  }
  return nullptr;
}

/// A device and the hand that holds it.
struct held_device {
  double mass, damping, hand_force, force_limit;  ///< [kg], [N·s/m], [N], [N]
};
inline held_device device_of(numbers& in) noexcept {
  const double mass = in.about(0.1), b = in.about(0.05), hand = in.about(5.0);
  return {.mass = mass, .damping = b, .hand_force = hand, .force_limit = in.about(9.0)};
}
/// A number that check() would not compare: no limit is promised of it.
template <class P>
limits_of<P> force_limit(double most) noexcept {
  using S = typename P::scalar;
  const double kept = static_cast<double>(ph::detail::number<S>(most));
  return kept >= 0.0 ? limits_of<P>{.force = kept} : limits_of<P>{};
}

template <class Space, int Latency>
const char* a_touch(numbers& in) noexcept {
  const auto d = device_of(in);
  const double T = in.about(1e-3), rate = in.about(2.0), top = in.about(5.0);
  using limits = ph::late_loop_limits<Latency>;
  ph::touch<Space, ph::half_space<Space>, limits> port{
      Space{},
      ph::followed<ph::half_space<Space>>{},
      ph::turn_limited{.rate = rate},
      ph::eased{ph::damped_spring{.mass = d.mass, .force_limit = d.force_limit}},
      ph::forgiving{ph::reduced_energy{.damping = d.damping}, ph::amends_for(d.force_limit)},
      ph::bound_chain{ph::watched{ph::reachable_bound{.mass = d.mass, .hand_force = d.hand_force}},
                      ph::actuator_limit{.most = d.force_limit}},
      limits{
          .longest_tick = T, .top_speed = top, .watchdog = in.one() < 200 ? limits::never : 2 * T}};
  auto most = force_limit<Space>(d.force_limit);
  return run<Space>(port, in, most, 9.0, [&](unsigned op) {
    if (op < 246) (void)port.update(plane_of<Space>(in));
    if (op == 246) (void)port.set(ph::turn_limited{.rate = in.about(2.0)});
    if (op == 247)
      (void)port.set(ph::reachable_bound{.mass = in.about(0.1), .hand_force = in.about(5)});
    if (op == 248) {
      const double F = in.about(9.0);
      if (!port.set(ph::actuator_limit{.most = F})) most = force_limit<Space>(F);
    }
    if (op == 249) {
      (void)port.set(ph::damped_spring{.mass = in.about(0.1), .force_limit = in.about(9.0)});
    }
    if (op == 250) (void)port.set(ph::reduced_energy{.damping = in.about(0.05)});
    if (op == 251)
      (void)port.set(limits{.longest_tick = in.about(1e-3), .top_speed = in.about(5.0)});
  });
}

template <class Space>
const char* an_encoder_touch(numbers& in) noexcept {
  ph::encoder_device d{.mass = in.about(0.1),
                       .damping = in.about(0.05),
                       .friction = in.about(0.13),
                       .presliding = in.about(15e-6),
                       .quantum = in.about(20e-6)};
  d.force_limit = in.about(9.0);
  d.continuous_force = in.about(9.0);
  d.winding_time = in.about(10.0);
  if (in.one() < 128) d.longest_tick = in.about(1e-3);
  const double hand = in.about(5.0), rate = in.about(2.0);
  auto port = ph::make_touch<Space>(d, ph::known_hand{.force = hand}, rate);
  auto most = force_limit<Space>(d.force_limit);
  return run<Space>(port, in, most, 9.0, [&](unsigned op) {
    if (op < 250) (void)port.update(plane_of<Space>(in));
    if (op == 250) {
      (void)port.set(ph::dual_ledger{.damping = {.coefficient = in.about(0.05),
                                                 .coulomb = in.about(0.13),
                                                 .presliding = in.about(15e-6)},
                                     .quantum = in.about(20e-6),
                                     .loan = in.about(1e-3),
                                     .cap = in.about(1.0),
                                     .window = in.about(0.032)});
    }
    if (op == 251)
      (void)port.set(ph::edge_observer{.quantum = in.about(20e-6), .presliding = in.about(1e-5)});
  });
}

template <class Space>
const char* a_force_guard(numbers& in) noexcept {
  const auto d = device_of(in);
  auto port = ph::make_guard<Space>({.mass = d.mass,
                                     .damping = d.damping,
                                     .force_limit = d.force_limit,
                                     .longest_tick = in.about(1e-3)},
                                    ph::known_hand{.force = d.hand_force});
  auto most = force_limit<Space>(d.force_limit);
  return run<Space>(port, in, most, 9.0, [&](unsigned op) {
    if (op < 240) {
      (void)port.set(ph::settled_force{.mass = in.about(0.1),
                                       .damping_fraction = in.about(0.25),
                                       .lead = in.about(5.0),
                                       .slide_fraction = in.about(0.002),
                                       .turn_time = in.about(0.02),
                                       .force_limit = in.about(9.0),
                                       .stale_after = in.about(0.1),
                                       .fade = in.about(0.05)});
    }
  });
}
template <class Space>
const char* a_strict_guard(numbers& in) noexcept {
  const double b = in.about(0.05), T = in.about(1e-3);
  auto port = ph::make_strict_guard<Space>(b, ph::actuator_limit{.most = 1e30}, T);
  limits_of<Space> most;
  return run<Space>(port, in, most, 9.0, [&](unsigned) {
    (void)port.set(ph::loop_limits{.longest_tick = in.about(1e-3), .watchdog = in.about(0.1)});
  });
}
/// Each bound and each way to count, by number, under a force of any size.
template <class Space>
const char* any_bound(numbers& in) noexcept {
  const double T = in.about(1e-3), F = in.about(9.0), b = in.about(0.05);
  auto most = force_limit<Space>(F);
  const auto guarded = [&](const auto& ledger, const auto& bound) {
    ph::passive_port port{
        Space{}, ph::given_force{.stale_after = in.about(0.1), .fade = in.about(0.05)}, ledger,
        ph::bound_chain{bound, ph::actuator_limit{.most = F}}, ph::loop_limits{.longest_tick = T}};
    return run<Space>(port, in, most, 9.0, [](unsigned) {});
  };
  const ph::capped_energy counted{
      .damping = b, .loan = in.about(1e-3), .cap = in.about(1.0), .reset_after = in.about(1.0)};
  switch (in.one() % 7) {
    case 0:
      return guarded(counted, ph::memoryless_bound{});
    case 1:
      return guarded(counted,
                     ph::energy_bounding{.slope = in.about(100), .storage = in.about(100)});
    case 2:
      return guarded(counted, ph::tight_energy_bounding{.storage = in.about(100)});
    case 3:
      if constexpr (Space::dof == 1)
        return guarded(counted, ph::sector_bound{.slope = in.about(100)});
      return guarded(counted, ph::per_axis_bound{.cap = in.about(1.0)});
    case 4:
      return guarded(counted, ph::energy_tank{.reserve = in.about(1e-3)});
    case 5:
      return guarded(counted, ph::series_passivity_controller{.max_damping = in.about(10.0),
                                                              .threshold = in.about(1e-3),
                                                              .least_speed = in.about(1e-3),
                                                              .least_travel = in.about(1e-5)});
    default:
      return guarded(
          ph::quantised_energy{.damping = {b}, .quantum = in.about(1e-5), .window = in.about(0.03)},
          ph::strict_bound{});
  }
}
template <class S>
const char* joints(numbers& in) noexcept {
  using arm = ph::joint_space<S, 3>;
  const ph::diagonal_damping<3> b{{in.about(0.01), in.about(0.01), in.about(0.02)}};
  const double most_torque = in.about(0.3);
  ph::passive_port port{
      arm{}, ph::given_force{}, ph::basic_reduced_energy<ph::diagonal_damping<3>>{.damping = b},
      ph::bound_chain{
          ph::reachable_work_bound<3>{.inertia = {{in.about(1e-3), in.about(1e-3), in.about(2e-3)}},
                                      .hand = in.about(3.0)},
          ph::motor_limits<3>{{most_torque, most_torque, most_torque}}},
      ph::loop_limits{.longest_tick = in.about(1e-3)}};
  limits_of<arm> most;
  if (most_torque >= 0.0)
    most.force = std::sqrt(3.0) * static_cast<double>(ph::detail::number<S>(most_torque));
  return run<arm>(port, in, most, 0.3, [](unsigned) {});
}
template <class S>
const char* a_set(numbers& in) noexcept {
  using scene = ph::space<S, 3>;
  const auto d = device_of(in);
  ph::contact_set<ph::stick_slip, ph::slots<ph::half_space<scene>, 3>> set{
      ph::proxy_spring{.mass = d.mass}, ph::pursuit{},
      ph::stick_slip{.static_coefficient = in.about(0.6),
                     .kinetic_coefficient = in.about(0.4),
                     .weakening = in.about(2e-4),
                     .healing = in.about(0.02)},
      ph::slots<ph::half_space<scene>, 3>{}};
  ph::passive_port port{
      scene{}, set,
      ph::forgiving{ph::reduced_energy{.damping = d.damping}, ph::amends_for(d.force_limit)},
      ph::bound_chain{ph::reachable_bound{.mass = d.mass, .hand_force = d.hand_force},
                      ph::actuator_limit{.most = d.force_limit}},
      ph::late_loop_limits<1>{.longest_tick = in.about(1e-3)}};
  auto most = force_limit<scene>(d.force_limit);
  return run<scene>(port, in, most, 9.0, [&](unsigned) {
    const int slot = in.one() % 5 - 1;
    (void)port.source().update(slot, plane_of<scene>(in));
  });
}
template <class S>
const char* a_tool(numbers& in) noexcept {
  using body = ph::rigid_body<S>;
  using plane = ph::half_space<ph::space<S, 3>>;
  const double mass = in.about(0.15), I = in.about(1e-4), b = in.about(0.03),
               b_turn = in.about(1e-4);
  const double F = in.about(9.0), torque = in.about(0.5);
  ph::passive_port port{
      body{},
      ph::rigid_tool{
          ph::tool_spring{.mass = mass, .least_inertia = I, .lever = in.about(0.03)}, ph::pursuit{},
          ph::stick_slip{.static_coefficient = in.about(0.6), .kinetic_coefficient = in.about(0.4)},
          ph::slots<plane, 4>{}},
      ph::forgiving{ph::basic_reduced_energy<ph::rigid_damping>{{.linear = b, .angular = b_turn}},
                    in.about(0.02)},
      ph::bound_chain{
          ph::rigid_reachable_bound{
              {.mass = mass, .least = I, .spread = in.about(2e-4), .offset = in.about(0.01)},
              in.about(5.0),
              in.about(0.1),
              in.about(0.06),
              in.about(2e-4)},
          ph::rigid_actuator_limit{.force = F, .torque = torque}},
      ph::late_loop_limits<1>{.longest_tick = in.about(1e-3), .top_speed = in.about(5.0)}};
  auto most = force_limit<body>(F);
  if (torque >= 0.0) most.torque = static_cast<double>(ph::detail::number<S>(torque));
  return run<body>(port, in, most, 9.0, [&](unsigned) {
    const int slot = in.one() % 6 - 1;
    const S x = in.around<S>(0.04), y = in.around<S>(0.04), z = in.around<S>(0.04);
    (void)port.source().update(slot, typename body::triple(x, y, z), plane_of<ph::space<S, 3>>(in));
  });
}
template <class S>
const char* a_stylus(numbers& in) noexcept {
  using pen = ph::stylus<S>;
  using scene = ph::space<S, 3>;
  const auto d = device_of(in);
  ph::passive_port port{
      pen{},
      ph::at_tip{ph::contact_set{ph::proxy_spring{.mass = d.mass}, ph::pursuit{},
                                 ph::slots<ph::half_space<scene>, 2>{}},
                 {in.about(0.1), in.about(0.01), 0.0}},
      ph::reduced_energy{.damping = d.damping},
      ph::bound_chain{ph::reachable_bound{.mass = d.mass, .hand_force = d.hand_force},
                      ph::actuator_limit{.most = d.force_limit}},
      ph::loop_limits{.longest_tick = in.about(1e-3)}};
  auto most = force_limit<pen>(d.force_limit);
  return run<pen>(port, in, most, 9.0, [&](unsigned) {
    const int slot = in.one() % 4 - 1;
    (void)port.source().contact().update(slot, plane_of<scene>(in));
  });
}
/// Each shaper and law, by number, before a motor limit.
template <class Space>
const char* a_shaper(numbers& in) noexcept {
  const auto d = device_of(in);
  const double T = in.about(1e-3);
  auto most = force_limit<Space>(d.force_limit);
  const auto shaped = [&](const auto& law) {
    ph::local_model port{
        Space{},
        ph::followed<ph::half_space<Space>>{},
        ph::turn_limited{.rate = in.about(2.0)},
        law,
        ph::reduced_energy{.damping = d.damping, .loan = in.about(1e-2)},
        ph::bound_chain{ph::strict_bound{}, ph::actuator_limit{.most = d.force_limit}},
        ph::loop_limits{.longest_tick = T}};
    return run<Space>(port, in, most, 9.0,
                      [&](unsigned) { (void)port.update(plane_of<Space>(in)); });
  };
  switch (in.one() % 9) {
    case 0:
      return shaped(ph::shaped{ph::spring{}, ph::force_rate_limit{.rate = in.about(100.0)}});
    case 1:
      return shaped(ph::shaped{ph::spring{}, ph::thesis_rule{}});
    case 2:
      return shaped(ph::shaped{
          ph::spring{},
          ph::set_position_modulation{
              .loan = in.about(1e-3), .cap = in.about(1.0), .ask_again = in.about(0.02)}});
    case 3:
      return shaped(ph::shaped{ph::spring{}, ph::nonlinear_coupling{.initial = in.about(50.0),
                                                                    .rate = in.about(1e4),
                                                                    .most = in.about(1e4)}});
    case 4:
      return shaped(ph::shaped{
          ph::spring{},
          ph::stiffness_increment{
              .initial = in.about(50.0), .step = in.about(50.0), .reset_after = in.about(1.0)}});
    case 5:
      return shaped(ph::shaped{
          ph::spring{}, ph::force_augmentation{.low = in.about(50.0), .step = in.about(1.0)}});
    case 6:
      return shaped(ph::capped{ph::damped_spring{.mass = d.mass,
                                                 .stiffness_fraction = in.about(0.1),
                                                 .damping_ratio = in.about(1.0),
                                                 .damping_fraction = in.about(0.5),
                                                 .force_limit = in.about(9.0)},
                               in.about(1e3)});
    case 7:
      return shaped(ph::shaped{ph::spring{}, ph::settled_force{.mass = d.mass,
                                                               .damping_fraction = in.about(0.25),
                                                               .force_limit = in.about(9.0),
                                                               .most = in.about(1e4)}});
    default:
      return shaped(ph::virtual_coupling{.stiffness = in.about(1000.0), .damping = in.about(1.0)});
  }
}

template <class S>
const char* with(unsigned which, numbers& in) noexcept {
  using d1 = ph::space<S, 1>;
  using d3 = ph::space<S, 3>;
  switch (which % 14) {
    case 0:
      return a_touch<d3, 0>(in);
    case 1:
      return a_touch<d3, 1>(in);
    case 2:
      return a_touch<d1, 2>(in);
    case 3:
    case 4:
      return an_encoder_touch<d3>(in);
    case 5:
      return a_force_guard<d3>(in);
    case 6:
      return a_strict_guard<d3>(in);
    case 7:
      return (in.one() & 1) != 0 ? any_bound<d3>(in) : any_bound<d1>(in);
    case 8:
      return joints<S>(in);
    case 9:
      return a_set<S>(in);
    case 10:
      return a_stylus<S>(in);
    case 11:
    case 12:
      return a_tool<S>(in);
    default:
      return a_shaper<d3>(in);
  }
}
inline const char* ports(input bytes) noexcept {
  numbers in(bytes);
  const unsigned which = in.one();
  return which < 128 ? with<double>(which, in) : with<float>(which, in);
}

}  // namespace fuzz
