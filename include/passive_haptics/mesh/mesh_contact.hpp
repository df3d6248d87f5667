// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh under the finger, as a source: what stands in a port where a local model would.
//
//     using scene = ph::space<double, 3>;
//     ph::mesh::surface organ(triangles, nodes);
//     auto touch = ph::make_mesh_touch<scene>(device, hand, {.stiffness = 1500});  // mesh.hpp
//     touch.source().touch(organ);
//     organ.update(nodes);                                   // from another thread, whenever they have moved
//     motors.command(touch.tick(x, ph::seconds{dt}).force);  // 1 kHz
//
// The force is K (p − x), p the place of the ball (mesh/proxy.hpp) and x the device, with the damper of
// proxy_spring along whatever presses:
//     y ≥ 0 shortest with n_i·y ≥ d_i + min(−τ n_i·v, 2 λ_i),   f* = K y
// n_i are the normals of the half-spaces near the ball, d_i [m] is how far x is beyond each, and λ_i [m] is the share
// that n_i has in the shortest y without the damper. Of the speed v of the device along p − x only what swings counts
// (contact/swing.hpp), because a damper against the hand's own motion is an error of the force. On a mesh at rest
// −K (p − x) is the gradient of ½K|p − x|², is no steeper than K, and the ball moves only so that this energy falls.
// The source promises nothing about the energy at the port; the bound behind it does. A mesh that pushes a hand does so
// by what the ledger pays for (port_state::paid_way), and one that jumps by 0.2 m/s, and 50 N/s for what is left. One of
// which no news come stays where it is. A device that begins nearer than r to a mesh is told so by event::started_inside.
//
// Along the surface, of a triangle with μ and c (mesh/material.hpp), t how far the ball is held back and v_t the speed
// beside the surface there:
//     f_t = K t − B v_t, cut to μ times what presses;  and − min(c, m/2T) v_t
// Where triangles of another material are met, or their material changes, what is felt follows by 50 N/s, so that a
// border is no blow.

#include <passive_haptics/contact/local_contact.hpp>
#include <passive_haptics/contact/proxy.hpp>
#include <passive_haptics/contact/swing.hpp>
#include <passive_haptics/mesh/proxy.hpp>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

struct mesh_contact {
  proxy_spring spring{};  ///< mass, and what a sampled mass can take; its softness is not used
  double stiffness =
      1000.0;  ///< K where a mesh states none [N/m], before what the sampling leaves of it
  double viscosity = 0.0;          ///< c where a mesh states none [N·s/m]
  mesh::proxy_parameters proxy{};  ///< the radius of the finger, how news are followed, μ

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (const auto fault = spring.check()) return fault;
    if (const auto fault = mesh::material{stiffness, 0.0, viscosity}.check()) return fault;
    return proxy.check();
  }
  template <port P>
  class on;
};

template <port P>
class mesh_contact::on {
 public:
  using scalar = typename P::scalar;
  using vector = typename P::effort;
  using result_type = tick_result<P>;
  static constexpr bool asks_for_numbers = true;
  static constexpr bool touches_meshes = true;
  static_assert(detail::has_geometry<P> && P::dof == 3,
                "passive_haptics: a mesh is touched in a space of three dimensions");

  constexpr explicit on(const mesh_contact& p) noexcept
      : spring_(p.spring),
        elsewhere_{p.stiffness, 0.0, p.viscosity},
        felt_(elsewhere_),
        ball_(p.proxy) {}
  [[nodiscard]] constexpr mesh_contact parameters() const noexcept {
    return {.spring = spring_.parameters(),
            .stiffness = elsewhere_.stiffness,
            .viscosity = elsewhere_.viscosity,
            .proxy = ball_.parameters()};
  }
  constexpr void set(const mesh_contact& p) noexcept {
    spring_ = proxy_spring::at<double>(p.spring);
    elsewhere_ = {p.stiffness, 0.0, p.viscosity};
    ball_.set(p.proxy);
  }
  constexpr void adopt(scalar T, int late) noexcept {
    spring_.adopt(static_cast<double>(T), late);
    most_viscosity_ = 0.5 * spring_.parameters().mass / static_cast<double>(T);
    sampled_ = spring_.sampled(felt_.stiffness);
  }
  [[nodiscard]] constexpr bool settles() const noexcept {
    return spring_.settles(elsewhere_.stiffness);
  }
  /// Forgets which side was touched, but keeps the mesh.
  constexpr void reset() noexcept {
    ball_.reset();
    inside_ = false;
  }

  /// Touches this mesh from now on, and no other; it must outlive the port. Call it from the haptic thread. One that takes
  /// the place of what is pressed, within r of it, is felt on without a step. It returns false, and nothing is touched, if
  /// 64 fingers touch the mesh already: a port that ends before its mesh must let_go(), or its place stays taken.
  bool touch(const mesh::surface& s) noexcept { return ball_.touch(s); }
  /// Touches this mesh as well (mesh/proxy.hpp). It returns false if 64 fingers touch it, or if eight are touched.
  bool also_touch(const mesh::surface& s) noexcept { return ball_.also_touch(s); }
  /// Touches nothing any more.
  void let_go() noexcept { ball_.let_go(); }
  /// Touches this mesh no more, and the others as before.
  void let_go(const mesh::surface& s) noexcept { ball_.let_go(s); }
  [[nodiscard]] const mesh::proxy& ball() const noexcept { return ball_; }

  /// Explains the stiffness that is shown where the device is now.
  void explain(explanation& e, const auto& /*x*/, scalar /*T*/, int /*late*/) const noexcept {
    if (!ball_.touching()) {
      e.stiffness = softened_by::no_surface;
      return;
    }
    const double asked = ball_.felt(elsewhere_).stiffness;
    e.asked = e.shown = asked;
    e.soften(spring_.sampled(asked).stiffness, spring_.softener(asked));
    if (behind_ > 0.0 || (presses_ && felt_.stiffness < asked)) e.now = softened_by::news;
    if (inside_) e.now = softened_by::started_inside;
    if (ball_.placed() && ball_.pressed().count > 0) e.depth = mesh::length(ball_.pressed().way);
  }

  struct request {
    vector wanted;
    bool nothing;
    scalar depth;  ///< |p − x| [m]
  };
  /// What surfaces that go outwards do work against, of all contacts that share a ledger.
  struct load {
    double force = 0.0;  ///< Σ |f| [N]
    double spent = 0.0;  ///< what the hand took in the last tick [J]
  };
  void add_to(load& all, const auto& motion, double dt) const noexcept {
    all.force += mesh::length(pressed_by_);
    all.spent += mesh::dot(pressed_by_, to_triple(detail::velocity_of<P>(motion))) * dt;
  }
  template <bool Shortcut>
  [[nodiscard]] request ask(const auto& motion, const auto& port, event& what) noexcept {
    load own;
    add_to(own, motion, static_cast<double>(port.dt));
    return ask(motion, port, what, own);
  }
  /// The same for one of several contacts, with the load of all.
  [[nodiscard]] request ask(const auto& motion, const auto& port, event& what,
                            const load& all) noexcept {
    const scalar most = port.paid_way(static_cast<scalar>(all.force), scalar(1e-4), scalar(0.05),
                                      static_cast<scalar>(all.spent));
    return asked(motion, static_cast<double>(port.dt), static_cast<double>(most), what);
  }
  [[nodiscard]] constexpr result_type answered(const request& r,
                                               const port_result<P>& port) const noexcept {
    return {port.force, r.depth, port.energy, port.what, port.limited};
  }
  constexpr result_type refused(const port_result<P>& port, scalar /*dt*/) noexcept {
    if (port.what == event::forces_off) meet_anew();
    return {port.force, scalar(0), port.energy, port.what, false};
  }
  /// What the ball is in when the forces are on again is met as what has come there meanwhile: from no force on.
  constexpr void meet_anew() noexcept {
    anew_ = true;
    feel_nothing();
  }

 private:
  /// Forgets what was felt in the last tick.
  constexpr void feel_nothing() noexcept {
    presses_ = false;
    behind_ = felt_depth_ = 0.0;
    pressed_by_ = turned_ = {};
    swing_.stop();
  }
  /// Out of line, once for both kinds of tick that ask for it, so that a program compiles sooner; dt is in seconds.
  [[gnu::noinline, nodiscard]] request asked(const auto& motion, double dt, double most,
                                             event& what) noexcept {
    const request free{P::zero(), true, scalar(0)};
    if (!ball_.touching()) {
      what = detail::worse_yet(what, event::no_target);
      return free;
    }
    const vector x = motion.position;
    ball_.step(to_triple(x), dt, felt_.friction);
    const mesh::support& pressed = ball_.pressed();
    inside_ = !ball_.placed();
    if (inside_) what = detail::worse_yet(what, event::started_inside);
    if (inside_ || pressed.count == 0) {
      feel_nothing();
      return free;
    }
    const double depth = mesh::length(pressed.way);
    const double part = share_felt(depth, most, dt);
    const mesh::triple v = to_triple(detail::velocity_of<P>(motion));
    const mesh::material is = made_of(depth, mesh::length(v), dt);
    const double shown = depth * part;
    const auto felt =
        spring_.saturates(sampled_, shown) ? spring_.saturated(sampled_, shown) : sampled_;
    const int count = ball_.planes();
    std::array<double, mesh::proxy::most_planes> wish;  // NOLINT(*-member-init): read below count
    std::array<mesh::triple, mesh::proxy::most_planes> n;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      n[i] = ball_.normal(static_cast<int>(i));
      wish[i] = ball_.depth(static_cast<int>(i));
      if (wish[i] > 0.0) wish[i] *= part;
    }
    const mesh::triple swings = swinging(v, depth, dt);
    std::array<double, mesh::proxy::most_planes> share{};
    for (std::size_t j = 0; j < static_cast<std::size_t>(pressed.count); ++j) {
      share[static_cast<std::size_t>(pressed.of[j])] = pressed.share[j];
    }
    // A ball that was stopped on its way may lie beyond half-spaces that do not press, which are not to turn the force.
    const mesh::triple push = ball_.push() * part;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (!(share[i] > 0.0)) wish[i] = (std::min)(wish[i], mesh::dot(n[i], push));
      const double lead = -felt.settling * mesh::dot(n[i], swings);
      wish[i] += (std::min)(lead, (inward_limit - 1) * share[i] * part);
    }
    mesh::support damped;
    const bool can = mesh::shortest_way([&](int i) { return n[static_cast<std::size_t>(i)]; },
                                        [&](int i) { return wish[static_cast<std::size_t>(i)]; },
                                        count, 1e-12, damped);
    mesh::triple f{};
    const auto& by = can ? damped : pressed;
    for (std::size_t j = 0; j < static_cast<std::size_t>(by.count); ++j) {
      const auto i = static_cast<std::size_t>(by.of[j]);
      f = f + n[i] * (by.share[j] * felt.stiffness);
    }
    f = turning(f, dt);
    pressed_by_ = f;
    if (is.friction > 0.0 || is.viscosity > 0.0) {
      f = f + along(is, felt, f, v, dt);
    }
    vector wanted = P::zero();
    for (int i = 0; i < 3; ++i) P::component(wanted, i) = static_cast<scalar>(f[i]);
    if (!P::is_finite(wanted)) return free;
    return {wanted, false, static_cast<scalar>(depth)};
  }
  [[nodiscard]] static constexpr mesh::triple to_triple(const vector& v) noexcept {
    return {static_cast<double>(P::component(v, 0)), static_cast<double>(P::component(v, 1)),
            static_cast<double>(P::component(v, 2))};
  }
  /// The share of the depth [m] that is felt: the surface that is felt goes outwards with the mesh by `most` [m] in a tick,
  /// by jump_speed where what moves it is no steady motion, and what it stays behind it makes up for by border_rate, or
  /// when the mesh comes back. Where other meshes are touched what was felt goes on, and is made up for likewise.
  [[nodiscard]] double share_felt(double depth, double most, double dt) noexcept {
    stiffens_by_ = most;
    if (!(depth > 0.0)) return 1.0;
    const mesh::support& pressed = ball_.pressed();
    const mesh::triple n = ball_.push() * (1.0 / depth);
    double out = mesh::dot(n, ball_.went(pressed.of[0]));
    bool steady = true;
    for (std::size_t j = 0; j < static_cast<std::size_t>(pressed.count); ++j) {
      out = (std::max)(out, mesh::dot(n, ball_.went(pressed.of[j])));
      steady = steady && ball_.goes_steadily(pressed.of[j]);
    }
    if (!steady) most = (std::min)(most, jump_speed * dt);
    const double left = most - (std::max)(out, 0.0), rate = border_rate * dt / felt_.stiffness;
    if (std::exchange(anew_, false) || ball_.touches_others()) {
      behind_ = (std::max)(depth - felt_depth_, -depth);
    }
    if (behind_ < 0.0) {
      behind_ = (std::max)((std::min)(behind_ + rate, 0.0), -depth);
    } else {
      behind_ += (std::min)(out, 0.0) - (std::min)(left, rate);
      behind_ = kernels::clamped(behind_, 0.0, depth);
    }
    felt_depth_ = depth - behind_;
    stiffens_by_ = behind_ > 0.0 ? 0.0 : (std::max)(left, 0.0);
    return felt_depth_ / depth;
  }
  /// The force f turned by what is left of where other meshes have turned it to; that is made up for by border_rate.
  [[nodiscard]] mesh::triple turning(const mesh::triple& f, double dt) noexcept {
    const bool other = ball_.touches_others() && mesh::squared(pressed_by_) > 0.0;
    const double size = other || mesh::squared(turned_) > 0.0 ? mesh::length(f) : 0.0;
    if (!(size > 0.0)) {
      turned_ = {};
      return f;
    }
    const mesh::triple n = f * (1.0 / size);
    if (other) turned_ = pressed_by_ * (1.0 / mesh::length(pressed_by_)) - n;
    const double left = mesh::length(turned_), most = border_rate * dt / size;
    turned_ = left > most ? turned_ * (1.0 - most / left) : mesh::triple{};
    const mesh::triple felt = n + turned_;
    const double along = mesh::length(felt);
    return along > 0.1 ? felt * (size / along) : f;
  }
  /// v without what is no swing along the way on which the ball is held off (contact/swing.hpp).
  [[nodiscard]] mesh::triple swinging(const mesh::triple& v, double depth, double dt) noexcept {
    if (!(depth > 0.0)) return v;
    const mesh::triple n = ball_.push() * (1.0 / depth);
    const double natural = kernels::square_root(sampled_.stiffness / spring_.parameters().mass);
    const double out = mesh::dot(n, v);
    return v + n * (swing_.damped(out, natural, dt) - out);
  }
  /// What presses is made of, or on its way to it, and sampled_ as stiff as that; the device goes by `speed` [m/s].
  [[nodiscard]] mesh::material made_of(double depth, double speed, double dt) noexcept {
    const mesh::material goal =
        ball_.felt({elsewhere_.stiffness, ball_.parameters().friction, elsewhere_.viscosity});
    const double before = felt_.stiffness;
    if (std::exchange(presses_, true)) {
      const double step = border_rate * dt;  // [N]
      const auto towards = [](double from, double to, double most) {
        return kernels::clamped(to, from - most, from + most);
      };
      const double stiffer = (std::min)(step, before * stiffens_by_) / depth;
      felt_.stiffness = kernels::clamped(goal.stiffness, before - step / depth, before + stiffer);
      felt_.friction = towards(felt_.friction, goal.friction, step / (felt_.stiffness * depth));
      felt_.viscosity =
          towards(felt_.viscosity, goal.viscosity, speed > 0.0 ? step / speed : goal.viscosity);
    } else {
      felt_ = goal;
    }
    if (felt_.stiffness != before) sampled_ = spring_.sampled(felt_.stiffness);
    return felt_;
  }
  /// f_t [N] beside a force f that presses, at a speed v of the device [m/s].
  [[nodiscard]] mesh::triple along(const mesh::material& is, const sampled_spring<double>& felt,
                                   const mesh::triple& f, const mesh::triple& v,
                                   double dt) const noexcept {
    const double presses = mesh::length(f);
    if (!(presses > 0.0)) return {};
    const mesh::triple n = f * (1.0 / presses);
    mesh::triple beside = v;
    const mesh::support& pressed = ball_.pressed();
    for (std::size_t j = 0, most = 0; j < static_cast<std::size_t>(pressed.count); ++j) {
      if (pressed.share[j] < pressed.share[most]) continue;
      most = j;
      beside = v - ball_.went(pressed.of[j]) * (1.0 / dt);
    }
    beside = beside - n * mesh::dot(n, beside);
    mesh::triple t = (ball_.held_back() - beside * felt.settling) * felt.stiffness;
    const double size = mesh::length(t), most = is.friction * presses;
    if (size > most) t = t * (most / size);
    return t - beside * (std::min)(is.viscosity, most_viscosity_);
  }

  static constexpr double border_rate = 50.0;  ///< [N/s]
  static constexpr double jump_speed = 0.2;    ///< [m/s]

  proxy_spring::at<double> spring_;
  mesh::material elsewhere_;     ///< where a mesh does not say; its friction is the ball's
  mesh::material felt_;          ///< of the last tick; sampled_ is of its K
  double most_viscosity_ = 0.0;  ///< m/2T [N·s/m]
  sampled_spring<double> sampled_{};
  bool presses_ = false;      ///< it did in the last tick
  bool anew_ = false;         ///< the forces were off
  double stiffens_by_ = 0.0;  ///< way [m] by which it may rise yet in this tick, or stiffen as much
  bool inside_ = false;       ///< the device was not clear of the meshes by then
  double behind_ = 0.0;       ///< how far the surface that is felt lies below the mesh [m]
  double felt_depth_ = 0.0;   ///< the depth less that, in the last tick [m]
  mesh::triple pressed_by_{};  ///< the force of the last tick, without what rubs [N]
  mesh::triple turned_{};      ///< by how much its direction is not yet that of the meshes
  swing<double> swing_;
  mesh::proxy ball_;
};

}  // namespace v0
}  // namespace passive_haptics
