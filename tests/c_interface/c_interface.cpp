// SPDX-License-Identifier: BSD-3-Clause
// The C interface against the library it is made of, bit for bit, through a client in C that loads it; and
// what it says to wrong calls.
#include "direct.hpp"
#include "support/allocations.hpp"
#include <passive_haptics/knob/detents.hpp>

#include <atomic>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace {

using plane = ph::half_space<d3>;
using loop = ph::loop_limits;

constexpr ph::stick_slip rough{.static_coefficient = 0.5, .kinetic_coefficient = 0.3};

/// The motion of the C client, run by a port of the library itself.
template <class Port, class Change = decltype(nothing_else)>
std::vector<ph_result> run_direct(Port port, Change change = nothing_else) {
  std::vector<ph_result> results;
  for (int n = 0; n < ticks; ++n) {
    keep_to_script(port, n, change);
    const moment now = moment_at(n);
    if constexpr (requires { port.release(); }) {
      if (now.news == a_plane) port.update(plane{in(now.point), in(now.normal), now.stiffness});
      if (now.news == nothing_here) port.release();
    } else {
      if (n % 5 != 4) port.source().update(in(now.wanted));
    }
    results.push_back(tick(port, now));
  }
  return results;
}
plane plane_of(const ph_surface& s) {
  return {in(s.a), in(s.b), s.stiffness};
}
/// The same for what has slots, with surfaces of their own types in them.
template <class Port, class CurvedAt, class Change = decltype(nothing_else)>
std::vector<ph_result> run_slots(Port port, CurvedAt curved_of, Change change = nothing_else) {
  using curved = decltype(curved_of(0));
  auto& contact = [&port]() -> auto& {
    if constexpr (requires { port.source().contact(); }) {
      return port.source().contact();
    } else {
      return port.source();
    }
  }
  ();
  std::vector<ph_result> results;
  for (int n = 0; n < ticks; ++n) {
    keep_to_script(port, n, change);
    const moment now = moment_at(n);
    constexpr bool is_tool = Port::port_type::dof == 6;
    for (int i = 0; i < (is_tool ? 2 : 1); ++i) {
      const ph_surface told = plane_at(&now, is_tool ? 0.02 * i - 0.01 : 0.0);
      if (now.news == nothing_here) contact.template release<plane>(i);
      if (now.news != a_plane) continue;
      if constexpr (is_tool) {
        contact.update(i, in(told.at), plane_of(told));
      } else {
        contact.update(i, plane_of(told));
      }
    }
    if (curved_news(n) == a_plane) {
      if constexpr (is_tool) {
        contact.update(1, d3::zero(), curved_of(n));
      } else {
        contact.update(1, curved_of(n));
      }
    }
    if (curved_news(n) == nothing_here) contact.template release<curved>(1);
    results.push_back(tick(port, now));
  }
  return results;
}

std::vector<ph_result> run_in_c(const char* composition, const ph_parameters& parameters) {
  const bool guard = std::string(composition).find("guard") != std::string::npos;
  return run_in_c(composition, parameters, {guard ? by_forces : by_planes, 0, nullptr});
}

template <class Port>
void agree(const char* composition, const Port& port, const ph_parameters& parameters,
           double ph_parameters::*other) {
  REQUIRE_FALSE(port.check());
  const bool guard = std::string(composition).find("guard") != std::string::npos;
  agree(composition, run_direct(port), parameters, {guard ? by_forces : by_planes, 0, nullptr},
        other);
}

// Every kind of curved surface as it is without C.
ph::sphere<d3> sphere_at(int n) {
  const auto s = curved_at(n, PH_SPHERE);
  return {in(s.a), s.radius, s.stiffness};
}
ph::sphere<d3> cavity_at(int n) {
  const auto s = curved_at(n, PH_CAVITY);
  return {in(s.a), s.radius, s.stiffness, ph::felt_from::inside};
}
ph::quadric<d3> quadric_at(int n) {
  const auto s = curved_at(n, PH_QUADRIC);
  ph::quadric<d3> q{in(s.a),        in(s.b),     in(s.c),    s.curvature[0],
                    s.curvature[1], s.stiffness, s.thickness};
  if (s.reach != 0.0) q.reach = s.reach;
  return q;
}
ph::shell<ph::segment_core<d3>> capsule_at(int n) {
  const auto s = curved_at(n, PH_CAPSULE);
  return {{in(s.a), in(s.b)}, s.radius, s.stiffness};
}
ph::shell<ph::box_core<d3>> box_at(int n) {
  const auto s = curved_at(n, PH_BOX);
  return {{in(s.a), in(s.half), in(s.b), in(s.c)}, s.radius, s.stiffness};
}
ph::shell<ph::triangle_core<d3>> plate_at(int n) {
  const auto s = curved_at(n, PH_PLATE);
  return {{in(s.a), in(s.b), in(s.c)}, s.radius, s.stiffness};
}

ph_parameters roughly(ph_parameters p) {
  p.static_friction = rough.static_coefficient;
  p.kinetic_friction = rough.kinetic_coefficient;
  return p;
}
template <class Limits = loop, class Device, class Hand, class CurvedAt>
void agree_in_slots(const char* composition, const Device& device, const Hand& of,
                    CurvedAt curved_of, std::uint32_t kind, const ph_parameters& parameters,
                    double ph_parameters::*other) {
  const auto port = ph::make_contacts<d3, Limits>(device, of, rough, ph::slots<plane, PH_PLANES>{},
                                                  ph::slots<decltype(curved_of(0)), PH_CURVED>{});
  REQUIRE_FALSE(port.check());
  agree(composition, run_slots(port, curved_of), roughly(parameters), {by_slots, kind, nullptr},
        other);
}

}  // namespace

TEST_CASE("a touch by name is make_touch, bit for bit, from a client in C", "[c_interface]") {
  agree("touch", ph::make_touch<d3>(exact, hand), grip(), &ph_parameters::damping);
  agree("encoder_touch", ph::make_touch<d3>(stated, hand), on_encoders(), &ph_parameters::friction);
  agree("strict_touch", ph::make_touch<d3>(exact, ph::any_hand), grip(), &ph_parameters::damping);
  agree("strict_encoder_touch", ph::make_touch<d3>(stated, ph::any_hand), on_encoders(),
        &ph_parameters::quantum);
}

TEST_CASE("in a loop that is late a composition by name is the late one", "[c_interface]") {
  auto device = after(1, stated);
  auto parameters = on_encoders(1);
  parameters.force_limit = device.force_limit = 0.5;  // a bound that has something to do
  parameters.continuous_force = device.continuous_force = 0.3;
  agree("encoder_touch", ph::make_touch<d3, plane, late<1>>(device, hand), parameters,
        &ph_parameters::presliding);
  agree("strict_touch", ph::make_touch<d3, plane, late<2>>(after(2, exact), ph::any_hand), grip(2),
        &ph_parameters::damping);
  agree("touch", ph::make_touch<d3, plane, late<8>>(after(8, exact), hand), grip(8),
        &ph_parameters::damping);
  agree("guard", ph::make_guard<d3, late<2>>(after(2, exact), hand), grip(2),
        &ph_parameters::hand_force);
  agree("encoder_guard", ph::make_guard<d3, late<5>>(after(5, stated), hand), on_encoders(5),
        &ph_parameters::quantum);
}

TEST_CASE("a guard by name is make_guard, bit for bit", "[c_interface]") {
  agree("guard", ph::make_guard<d3>(exact, hand), grip(), &ph_parameters::mass);
  ph_parameters slow = grip();
  slow.renderer_period = 0.02;
  agree("guard", ph::make_guard<d3>(exact, hand, 0.02), slow, &ph_parameters::mass);
  agree("encoder_guard", ph::make_guard<d3>(stated, hand), on_encoders(), &ph_parameters::quantum);
  agree("strict_guard", ph::make_guard<d3>(exact, ph::any_hand), grip(),
        &ph_parameters::longest_tick);
  agree("strict_encoder_guard", ph::make_guard<d3>(stated, ph::any_hand), on_encoders(),
        &ph_parameters::friction);
}

namespace {
/// In how many ticks detents by name, and a port of the library, do not answer alike, bit for bit.
template <class Port>
int ticks_that_differ(const loaded& c, const char* composition, const ph_parameters& p, Port port) {
  REQUIRE_FALSE(port.check());
  const opened by_name(c, composition, p);
  int differ = 0;
  double most = 0.0;
  for (int n = 0; n < ticks; ++n) {
    const moment now = moment_at(n);
    const double scale = p.rotary != 0 ? 100.0 : 1.0, x = scale * now.position[2];
    const double place[3] = {x, 7.0, std::numeric_limits<double>::quiet_NaN()};  // one is read
    const double held[3] = {now.held[2], 7.0, 7.0};
    if (n == off_tick || n == on_tick) {
      port.enable_forces(n == on_tick);
      REQUIRE(c.enable_forces(by_name.port, n == on_tick) == PH_OK);
    }
    if (now.reports_held) REQUIRE(c.held(by_name.port, held) == PH_OK);
    const auto out = now.reports_held ? port.tick(ph::device_sample<d1>{x, held[0], now.dt, true})
                                      : port.tick(x, ph::seconds{now.dt});
    ph_result r{};
    r.size = sizeof r;
    REQUIRE(c.tick(by_name.port, place, now.dt, &r) == PH_OK);
    const double ours[2] = {out.force, out.energy}, theirs[2] = {r.force[0], r.energy};
    differ += std::memcmp(ours, theirs, sizeof ours) != 0 ||
              r.event != static_cast<int>(out.what) || (r.limited != 0) != out.limited;
    REQUIRE((r.force[1] == 0.0 && r.force[2] == 0.0));
    most = std::max(most, std::fabs(out.force));
  }
  CHECK(most > 0.03 * p.force_limit);
  return differ;
}
}  // namespace

TEST_CASE("detents by name are make_detents, bit for bit", "[c_interface]") {
  const loaded c;
  const ph::detents shape{
      .pitch = 1e-3, .stiffness = 900.0, .first = -2e-3, .last = 3e-3, .stop_stiffness = 700.0};
  const auto with_shape = [](ph_parameters p, const ph::detents& d) {
    p.pitch = d.pitch;
    p.detent_stiffness = d.stiffness;
    p.first_stop = d.first;
    p.last_stop = d.last;
    p.stop_stiffness = d.stop_stiffness;
    return p;
  };
  const auto each = [&](const char* name, const auto& port, ph_parameters p) {
    INFO(name);
    p = with_shape(p, shape);
    CHECK(ticks_that_differ(c, name, p, port) == 0);
    p.pitch *= 0.9;  // the control
    CHECK(ticks_that_differ(c, name, p, port) > 100);
  };
  each("detents", ph::make_detents<d1>(exact, hand, shape), grip());
  each("encoder_detents", ph::make_detents<d1>(stated, hand, shape), on_encoders());
  each("strict_detents", ph::make_detents<d1>(exact, ph::any_hand, shape), grip());
  each("strict_encoder_detents", ph::make_detents<d1>(stated, ph::any_hand, shape), on_encoders());
  each("detents", ph::make_detents<d1, late<8>>(after(8, exact), hand, shape), grip(8));

  const ph::exact_device motor{
      .mass = 5e-5, .damping = 1e-3, .force_limit = 0.2, .longest_tick = T, .rotary = true};
  auto knob = grip();
  knob.mass = motor.mass;
  knob.damping = motor.damping;
  knob.hand_force = 0.15;
  knob.force_limit = motor.force_limit;
  knob.rotary = 1;
  const ph::detents ring{.pitch = 0.1, .stiffness = 1.0};  // no stops
  const auto port = ph::make_detents<d1>(motor, {.force = 0.15}, ring);
  CHECK(ticks_that_differ(
            c, "detents",
            with_shape(knob, {.pitch = 0.1, .stiffness = 1.0, .first = 0.0, .last = 0.0}),
            port) == 0);

  using Catch::Matchers::StartsWith;
  const auto says = [&](auto change) {
    auto p = with_shape(grip(), shape);
    change(p);
    return c.refusal("detents", p);
  };
  CHECK_THAT(says([](auto& p) { p.pitch = 0.0; }), StartsWith("pitch = 0 is refused"));
  CHECK_THAT(says([](auto& p) { p.detent_stiffness = -1.0; }), StartsWith("detent_stiffness = -1"));
  CHECK_THAT(says([](auto& p) { p.last_stop = -1.0; }), StartsWith("last_stop = -1 is refused"));
  CHECK_THAT(says([](auto& p) { p.stop_stiffness = 0.0; }), StartsWith("stop_stiffness = 0"));
  CHECK(c.refusal("detents", with_shape(grip(), shape), PH_OK).empty());

  const opened one(c, "detents", with_shape(grip(), shape));
  const double at[3] = {2.8e-3, 0.0, 0.0}, wanted[3] = {1.0, 0.0, 0.0}, up[3] = {0.0, 0.0, 1.0};
  ph_result r{};
  r.size = sizeof r;
  CHECK(c.tick_wanted(one.port, at, 1e-3, wanted, &r) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(r.force[0] == 0.0);
  CHECK(c.publish_plane(one.port, at, up, 1.0) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.guarantee_of(one.port) == PH_CONDITIONAL);
  auto other = with_shape(grip(), shape);
  other.detent_stiffness = 300.0;
  CHECK(c.set(one.port, &other, nullptr, 0) == PH_OK);
  CHECK(c.tick(one.port, at, 1e-3, &r) == PH_OK);
  ph_explanation e{};
  e.size = sizeof e;
  REQUIRE(c.explain(one.port, &e) == PH_OK);
  CHECK(e.asked == 300.0);
  other.rotary = 1;
  CHECK(c.set(one.port, &other, nullptr, 0) == PH_REFUSED_PARAMETER);
}

TEST_CASE("contacts by name are make_contacts with each kind of surface, bit for bit",
          "[c_interface]") {
  agree_in_slots("contacts", exact, hand, sphere_at, PH_SPHERE, grip(), &ph_parameters::mass);
  agree_in_slots("contacts", exact, hand, cavity_at, PH_CAVITY, grip(), &ph_parameters::damping);
  agree_in_slots("contacts", exact, hand, quadric_at, PH_QUADRIC, grip(),
                 &ph_parameters::static_friction);
  agree_in_slots("contacts", exact, hand, capsule_at, PH_CAPSULE, grip(),
                 &ph_parameters::kinetic_friction);
  agree_in_slots("contacts", exact, hand, box_at, PH_BOX, grip(), &ph_parameters::longest_tick);
  agree_in_slots("contacts", exact, hand, plate_at, PH_PLATE, grip(), &ph_parameters::mass);
  agree_in_slots("encoder_contacts", stated, hand, sphere_at, PH_SPHERE, on_encoders(),
                 &ph_parameters::friction);
  agree_in_slots("strict_contacts", exact, ph::any_hand, box_at, PH_BOX, grip(),
                 &ph_parameters::damping);
  agree_in_slots("strict_encoder_contacts", stated, ph::any_hand, quadric_at, PH_QUADRIC,
                 on_encoders(), &ph_parameters::quantum);
  agree_in_slots<late<4>>("contacts", after(4, exact), hand, sphere_at, PH_SPHERE, grip(4),
                          &ph_parameters::damping);
}

TEST_CASE("a stylus and a tool by name are the library's, bit for bit", "[c_interface]") {
  auto p = roughly(grip());
  p.tip[0] = 2e-3;
  p.tip[2] = -1e-3;
  const ph::passive_port stylus{
      ph::stylus<double>{},
      ph::at_tip{
          ph::contact_set{ph::proxy_spring{.mass = exact.mass, .force_limit = exact.force_limit},
                          ph::pursuit{}, rough, ph::slots<plane, PH_PLANES>{},
                          ph::slots<ph::sphere<d3>, PH_CURVED>{}},
          {p.tip[0], p.tip[1], p.tip[2]}},
      ph::forgiving{ph::reduced_energy{.damping = exact.damping}, ph::amends_for(3.3)},
      ph::bound_chain{ph::reachable_bound{.mass = exact.mass, .hand_force = hand.force}, motors},
      loop{.longest_tick = T}};
  REQUIRE_FALSE(stylus.check());
  agree("stylus", run_slots(stylus, sphere_at), p, {as_stylus, PH_SPHERE, nullptr},
        &ph_parameters::mass);

  auto t = roughly(peg());
  const auto tool = [](auto limits) {
    return ph::make_tool<ph::rigid_body<double>, decltype(limits)>(
        handle, {.force = 5.0, .torque = 0.1}, rough, ph::slots<plane, PH_TOOL_PLANES>{},
        ph::slots<ph::shell<ph::box_core<d3>>, PH_TOOL_CURVED>{});
  };
  REQUIRE_FALSE(tool(loop{}).check());
  const script as_it_is{as_tool, PH_BOX, nullptr};
  const auto direct = run_slots(tool(loop{}), box_at);
  CHECK(std::any_of(direct.begin(), direct.end(), [](auto& r) { return r.torque[1] != 0.0; }));
  for (double ph_parameters::*one :
       {&ph_parameters::least_inertia, &ph_parameters::inertia_spread,
        &ph_parameters::inertia_offset, &ph_parameters::angular_damping,
        &ph_parameters::damping_most, &ph_parameters::angular_damping_most,
        &ph_parameters::hand_torque, &ph_parameters::torque_limit, &ph_parameters::lever}) {
    INFO("the control: another one");
    agree("tool", direct, t, as_it_is, one);
  }
  t.latency = 1;
  agree("tool", run_slots(tool(late<1>{}), box_at), t, as_it_is, &ph_parameters::mass);
}

TEST_CASE("parameters that change in C change as set() does, and a reset is a reset",
          "[c_interface]") {
  const ph::actuator_limit weaker{.most = 1.5};
  const ph::reachable_bound reach{.mass = exact.mass, .hand_force = 4.0};
  auto later = grip();
  later.force_limit = weaker.most;
  later.hand_force = reach.hand_force;
  const auto change = [&](auto& port) {
    CHECK_FALSE(port.set(weaker));
    CHECK_FALSE(port.set(reach));
  };
  auto slower = later;
  slower.top_speed = 0.01;
  auto turned = later;
  turned.turn_rate = 3.0;
  turned.stale_after = 0.05;
  agree(
      "touch",
      run_direct(ph::make_touch<d3>(exact, hand),
                 [&](auto& port) {
                   change(port);
                   CHECK_FALSE(port.set(ph::damped_spring{.mass = exact.mass, .force_limit = 1.5}));
                   CHECK_FALSE(port.set(ph::turn_limited{.rate = 3.0}));
                   CHECK_FALSE(port.set(ph::freshness{.stale_after = 0.05}));
                 }),
      grip(), {by_planes, 0, &turned}, &ph_parameters::damping);
  agree(
      "guard",
      run_direct(ph::make_guard<d3>(exact, hand),
                 [&](auto& port) {
                   change(port);
                   CHECK_FALSE(port.set(ph::settled_force{.mass = exact.mass, .force_limit = 1.5}));
                   auto shorter = loop{.longest_tick = T};
                   shorter.top_speed = 0.01;
                   CHECK_FALSE(port.set(shorter));
                 }),
      grip(), {by_forces, 0, &slower}, &ph_parameters::mass);
  later = roughly(later);
  later.kinetic_friction = 0.1;
  const auto corner = ph::make_contacts<d3>(exact, hand, rough, ph::slots<plane, PH_PLANES>{},
                                            ph::slots<ph::sphere<d3>, PH_CURVED>{});
  agree("contacts",
        run_slots(corner, sphere_at,
                  [&](auto& port) {
                    change(port);
                    CHECK_FALSE(port.set(ph::proxy_spring{.mass = exact.mass, .force_limit = 1.5}));
                    CHECK_FALSE(port.set(
                        ph::stick_slip{.static_coefficient = 0.5, .kinetic_coefficient = 0.1}));
                  }),
        roughly(grip()), {by_slots, PH_SPHERE, &later}, &ph_parameters::mass);
  // On encoders a limit of the motors changes at once, too.
  auto warm = on_encoders();
  warm.force_limit = 0.6;
  warm.continuous_force = 0.4;
  agree("encoder_touch",
        run_direct(ph::make_touch<d3>(stated, hand),
                   [&](auto& port) {
                     CHECK_FALSE(port.set(
                         ph::thermal_limit{.peak = 0.6, .continuous = 0.4, .time_constant = 0.5}));
                     CHECK_FALSE(
                         port.set(ph::damped_spring{.mass = stated.mass, .force_limit = 0.6}));
                   }),
        on_encoders(), {by_planes, 0, &warm}, &ph_parameters::friction);
}

TEST_CASE("what ph_create was told of the device ph_set refuses, by its name", "[c_interface]") {
  const loaded c;
  const opened touch(c, "touch", grip());
  const auto says = [&](const ph_parameters& p, int expected = PH_REFUSED_PARAMETER) {
    std::string text(PH_TEXT_ROOM, 'x');
    CHECK(c.set(touch.port, &p, text.data(), text.size()) == expected);
    return std::string(text.c_str());
  };
  using Catch::Matchers::StartsWith;
  CHECK(says(grip(), PH_OK).empty());  // the control
  auto p = grip();
  p.mass = 0.05;
  CHECK(says(p) == "mass = 0.05 is refused: what ph_create was told: create another port");
  CHECK_THAT(says(grip(1)), StartsWith("latency = 1 is refused: what ph_create"));
  for (double ph_parameters::*one : {&ph_parameters::damping, &ph_parameters::longest_tick}) {
    p = grip();
    p.*one *= 2.0;
    CHECK_FALSE(says(p).empty());
  }
  p = grip();
  p.hand_force = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(says(p), StartsWith("hand_force = nan is refused"));
  p = grip();
  p.static_friction = 0.2;
  p.kinetic_friction = 0.3;
  CHECK_THAT(says(p), StartsWith("kinetic_friction = 0.3 is refused: no more than"));
  p = grip();
  p.size = 100;
  CHECK_THAT(says(p, PH_WRONG_SIZE), StartsWith("size = 100 is refused"));
  std::string why(PH_TEXT_ROOM, 'x');
  CHECK(c.set(nullptr, &p, why.data(), why.size()) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_set: port is NULL");
  CHECK(c.set(touch.port, nullptr, nullptr, 0) == PH_NULL_ARGUMENT);
  CHECK(c.reset(nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.enable_forces(nullptr, 1) == PH_NULL_ARGUMENT);

  const double there[3] = {0, 0, 0};
  ph_result off{};
  off.size = sizeof off;
  CHECK(c.enable_forces(touch.port, 0) == PH_OK);
  CHECK(c.tick(touch.port, there, 1e-3, &off) == PH_OK);
  CHECK(off.event == PH_FORCES_OFF);
  CHECK(c.enable_forces(touch.port, 1) == PH_OK);

  // What was published before a new start is forgotten with it, taken or not.
  const double zero[3] = {0, 0, 0}, up[3] = {0, 0, 1}, inside[3] = {0, 0, -1e-3};
  ph_result r{};
  r.size = sizeof r;
  REQUIRE(c.publish_plane(touch.port, zero, up, 1000.0) == PH_OK);
  REQUIRE(c.reset(touch.port) == PH_OK);
  CHECK(c.tick(touch.port, inside, 1e-3, &r) == PH_OK);
  CHECK(r.event == PH_NO_TARGET);
  REQUIRE(c.publish_plane(touch.port, zero, up, 1000.0) == PH_OK);
  CHECK(c.tick(touch.port, inside, 1e-3, &r) == PH_OK);
  CHECK(r.event == PH_NOMINAL);
}

TEST_CASE("a surface that is none, or is for another slot or composition, is refused",
          "[c_interface]") {
  const loaded c;
  const opened touch(c, "touch", grip()), guard(c, "guard", grip());
  const opened contacts(c, "contacts", grip()), tool(c, "tool", peg());
  const moment now = moment_at(5);
  auto s = plane_at(&now, 0.0);
  CHECK(c.publish(contacts.port, 0, &s) == PH_OK);  // the controls
  CHECK(c.publish(contacts.port, PH_PLANES - 1, &s) == PH_OK);
  CHECK(c.publish(tool.port, PH_TOOL_PLANES - 1, &s) == PH_OK);
  CHECK(c.publish(touch.port, 0, &s) == PH_OK);
  CHECK(c.release(contacts.port, 3, PH_PLATE) == PH_OK);
  for (std::uint32_t kind = PH_SPHERE; kind <= PH_PLATE; ++kind) {
    const auto one = curved_at(0, kind);
    CHECK(c.publish(contacts.port, PH_CURVED - 1, &one) == PH_OK);
    CHECK(c.publish(contacts.port, PH_CURVED, &one) == PH_NO_SUCH_SLOT);
    CHECK(c.publish(tool.port, PH_TOOL_CURVED, &one) == PH_NO_SUCH_SLOT);
    CHECK(c.publish(touch.port, 0, &one) == PH_NO_SUCH_SLOT);
    CHECK(c.publish(guard.port, 0, &one) == PH_NOT_OF_THIS_COMPOSITION);
    for (double ph_surface::*number : {&ph_surface::stiffness, &ph_surface::radius}) {
      if (kind == PH_QUADRIC && number == &ph_surface::radius) continue;
      for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity()}) {
        auto bad = one;
        bad.*number = wrong;
        CHECK(c.publish(contacts.port, 0, &bad) == PH_REFUSED_SURFACE);
      }
    }
    auto bad = one;
    bad.a[1] = std::numeric_limits<double>::quiet_NaN();
    CHECK(c.publish(contacts.port, 0, &bad) == PH_REFUSED_SURFACE);
  }
  CHECK(c.publish(contacts.port, PH_PLANES, &s) == PH_NO_SUCH_SLOT);
  CHECK(c.publish(contacts.port, 0xffffffffU, &s) == PH_NO_SUCH_SLOT);
  CHECK(c.publish(touch.port, 1, &s) == PH_NO_SUCH_SLOT);
  CHECK(c.publish(guard.port, 0, &s) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.release(contacts.port, PH_PLANES, PH_PLANE) == PH_NO_SUCH_SLOT);
  CHECK(c.release(contacts.port, 0, PH_PLATE + 1) == PH_REFUSED_SURFACE);
  CHECK(c.release(guard.port, 0, PH_PLANE) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.release(nullptr, 0, PH_PLANE) == PH_NULL_ARGUMENT);
  CHECK(c.publish(nullptr, 0, &s) == PH_NULL_ARGUMENT);
  CHECK(c.publish(contacts.port, 0, nullptr) == PH_NULL_ARGUMENT);
  s.kind = PH_PLATE + 1;
  CHECK(c.publish(contacts.port, 0, &s) == PH_REFUSED_SURFACE);
  s.kind = PH_PLANE;
  s.at[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK(c.publish(tool.port, 0, &s) == PH_REFUSED_SURFACE);
  for (const std::uint32_t size : {0U, 168U, 184U, 4096U}) {
    s.size = size;
    CHECK(c.publish(contacts.port, 0, &s) == PH_WRONG_SIZE);
  }
}

TEST_CASE("what turns is ticked with a pose, and nothing else is", "[c_interface]") {
  const loaded c;
  const opened touch(c, "touch", grip()), stylus(c, "stylus", grip()), tool(c, "tool", peg());
  const double x[3] = {0, 0, 0}, q[4] = {1, 0, 0, 0}, none[4] = {0, 0, 0, 0};
  ph_result r{};
  r.size = sizeof r;
  for (ph_port* one : {stylus.port, tool.port}) {
    ph_explanation e{};
    e.size = sizeof e;
    CHECK(c.tick_pose(one, x, q, 1e-3, &r) == PH_OK);
    CHECK(r.event == PH_NO_TARGET);
    CHECK(c.explain(one, &e) == PH_OK);
    CHECK(e.shown == 0.0);
    CHECK(std::string(e.because).find("no surface") != std::string::npos);
    CHECK(c.tick_pose(one, x, none, 1e-3, &r) == PH_OK);
    CHECK(r.event == PH_REJECTED_SAMPLE);
    CHECK(c.tick_pose(one, x, nullptr, 1e-3, &r) == PH_NULL_ARGUMENT);
    CHECK(r.event == PH_REJECTED_SAMPLE);
    CHECK(c.tick_pose(one, nullptr, q, 1e-3, &r) == PH_NULL_ARGUMENT);
    CHECK(c.tick(one, x, 1e-3, &r) == PH_NOT_OF_THIS_COMPOSITION);
    CHECK(r.event == PH_REJECTED_SAMPLE);
    CHECK(c.tick_wanted(one, x, 1e-3, x, &r) == PH_NOT_OF_THIS_COMPOSITION);
    CHECK(c.explain(one, &e) == PH_OK);
    CHECK(std::string(e.because).find("last sample") != std::string::npos);
  }
  CHECK(c.tick_pose(touch.port, x, q, 1e-3, &r) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(r.event == PH_REJECTED_SAMPLE);
  CHECK(c.tick_pose(nullptr, x, q, 1e-3, &r) == PH_NULL_ARGUMENT);
  CHECK(c.tick_pose(tool.port, x, q, 1e-3, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.held(tool.port, x) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.held_wrench(touch.port, x, x) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.held_wrench(tool.port, x, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.held_wrench(tool.port, x, x) == PH_OK);
  CHECK(c.held(stylus.port, x) == PH_OK);
  using Catch::Matchers::StartsWith;
  auto p = peg();
  p.torque_limit = 0.0;
  CHECK_THAT(c.refusal("tool", p), StartsWith("torque_limit = 0 is refused"));
  p = peg();
  p.latency = 2;
  CHECK_THAT(c.refusal("tool", p), StartsWith("latency = 2 is refused: 0 or 1 tick"));
  p = grip();
  p.tip[1] = std::numeric_limits<double>::infinity();
  CHECK_THAT(c.refusal("stylus", p), StartsWith("tip = inf is refused"));
}

TEST_CASE("every composition has its promise, and presses", "[c_interface]") {
  const loaded c;
  const auto promise = [&c](const char* composition, const ph_parameters& p) {
    return c.guarantee_of(opened(c, composition, p).port);
  };
  CHECK(promise("touch", grip()) == PH_CONDITIONAL);
  CHECK(promise("quantised_touch", on_encoders()) == PH_CONDITIONAL);
  CHECK(promise("encoder_touch", on_encoders()) == PH_CONDITIONAL);
  CHECK(promise("strict_touch", grip()) == PH_STRICT);
  CHECK(promise("guard", grip()) == PH_CONDITIONAL);
  CHECK(promise("encoder_guard", on_encoders()) == PH_CONDITIONAL);
  CHECK(promise("strict_guard", grip()) == PH_STRICT);
  CHECK(promise("strict_encoder_guard", on_encoders()) == PH_STRICT);
  CHECK(promise("strict_encoder_touch", on_encoders()) == PH_STRICT);
  CHECK(promise("strict_contacts", grip()) == PH_STRICT);
  CHECK(promise("contacts", grip()) == PH_CONDITIONAL);
  CHECK(promise("stylus", grip()) == PH_CONDITIONAL);
  CHECK(promise("tool", peg()) == PH_CONDITIONAL);
  CHECK(promise("encoder_detents", on_encoders()) == PH_CONDITIONAL);
  CHECK(promise("strict_detents", grip()) == PH_STRICT);
  CHECK(c.guarantee_of(nullptr) == PH_NONE);
  for (std::uint32_t latency = 0; latency <= PH_MOST_STRICT_LATENCY; ++latency) {
    CHECK(tries_enough(run_in_c("quantised_touch", on_encoders(latency))));
  }
}

TEST_CASE("the C interface names a parameter that is out of its range, its value and the remedy",
          "[c_interface]") {
  const loaded c;
  const auto says = [&c](const char* composition, ph_parameters p, double ph_parameters::*which,
                         double value) {
    p.*which = value;
    return c.refusal(composition, p);
  };
  using Catch::Matchers::StartsWith;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(c.refusal("touch", grip(), PH_OK).empty());  // the control
  CHECK(says("touch", grip(), &ph_parameters::mass, -0.1) ==
        "mass = -0.1 is refused: finite and > 0 kg");
  CHECK_THAT(says("touch", grip(), &ph_parameters::mass, 0.0), StartsWith("mass = 0 is"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::mass, nan), StartsWith("mass = nan is"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::damping, 0.0), StartsWith("damping = 0 is"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::hand_force, 0.0), StartsWith("hand_force = 0"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::force_limit, 0.0),
             StartsWith("force_limit = 0"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::longest_tick, 0.0),
             StartsWith("longest_tick = 0"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::turn_rate, -1.0), StartsWith("turn_rate = -1"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::stale_after, nan),
             StartsWith("stale_after = nan"));
  CHECK_THAT(says("guard", grip(), &ph_parameters::renderer_period, -1.0),
             StartsWith("renderer_period = -1 is refused"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::top_speed, -5.0), StartsWith("top_speed = -5"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::workspace, -2.0), StartsWith("workspace = -2"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::watchdog, 1e-4),
             StartsWith("watchdog = 0.0001"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::quantum, 20e-6), StartsWith("quantum = 2e-05"));
  CHECK_THAT(says("encoder_touch", on_encoders(), &ph_parameters::friction, 0.0),
             StartsWith("friction = 0 is refused: No dry friction is stated"));
  CHECK_THAT(says("encoder_guard", on_encoders(), &ph_parameters::presliding, 0.0),
             StartsWith("presliding = nan"));
  CHECK_THAT(says("encoder_touch", on_encoders(), &ph_parameters::winding_time, 0.0),
             StartsWith("winding_time = 0"));
  CHECK_THAT(c.refusal("touch", grip(9)), StartsWith("latency = 9 is refused: 0 to 8 ticks"));
  CHECK_THAT(c.refusal("strict_touch", grip(3)), StartsWith("latency = 3 is refused: 0 to 2"));
  CHECK_THAT(c.refusal("tuch", grip(), PH_UNKNOWN_COMPOSITION),
             StartsWith("composition = \"tuch\" is refused: one of touch, "));
  CHECK_THAT(c.refusal(std::string(1000, 'a').c_str(), grip(), PH_UNKNOWN_COMPOSITION),
             StartsWith("composition = \"aaaa"));

  // What a composition does not take it does not look at.
  auto p = grip();
  p.hand_force = p.torque_limit = nan;
  CHECK(c.refusal("strict_touch", p, PH_OK).empty());
}

TEST_CASE("a text is cut to the room there is for it, between characters", "[c_interface]") {
  const loaded c;
  auto p = grip();
  p.watchdog = 1e-4;
  const std::string whole = c.refusal("touch", p);
  const auto sign = whole.find("≥");
  REQUIRE(sign != std::string::npos);
  ph_port* port = nullptr;
  for (std::size_t room = 0; room <= whole.size() + 2; ++room) {
    std::string text(whole.size() + 3, '#');
    CHECK(c.create("touch", &p, &port, text.data(), room) == PH_REFUSED_PARAMETER);
    CHECK(text.substr(room).find_first_not_of('#') == std::string::npos);
    if (room == 0) continue;
    const std::string said = text.c_str();
    const auto fits = std::min(room - 1, whole.size());
    CHECK(said == whole.substr(0, fits > sign && fits < sign + 3 ? sign : fits));
  }
  CHECK(c.create("touch", &p, &port, nullptr, 100) == PH_REFUSED_PARAMETER);
}

TEST_CASE("a struct of another size is refused, one of an older header serves", "[c_interface]") {
  const loaded c;
  constexpr std::uint32_t own = sizeof(ph_parameters);
  for (const std::uint32_t size : {0u, 40u, 50u, own - 1, own + 8, 4096u}) {
    auto p = grip();
    p.size = size;
    CHECK(c.refusal("touch", p, PH_WRONG_SIZE) ==
          "size = " + std::to_string(size) + " is refused: sizeof(ph_parameters), which is " +
              std::to_string(own) + " bytes in this library");
    double K = 1.0;
    CHECK(c.stiffness_budget(&p, &K, nullptr) == PH_WRONG_SIZE);
    CHECK(K == 0.0);
  }
  auto older = on_encoders();
  older.size = offsetof(ph_parameters, friction);  // what stands behind is not looked at
  CHECK(c.refusal("touch", older, PH_OK).empty());
  CHECK_FALSE(c.refusal("touch", on_encoders()).empty());  // the control: it refuses a quantum

  const opened touch(c, "touch", grip());
  const double here[3] = {0, 0, 0};
  ph_result r{};
  for (const std::uint32_t size : {0u, 40u, 52u, 88u}) {
    r = {};
    r.size = size;
    CHECK(c.tick(touch.port, here, 1e-3, &r) == PH_WRONG_SIZE);
    CHECK(r.size == size);
    CHECK(r.event == 0);  // untouched
  }
  r.size = offsetof(ph_result, limited);
  r.limited = r.capped = -7;
  CHECK(c.tick(touch.port, here, 1e-3, &r) == PH_OK);
  CHECK(r.event == PH_NO_TARGET);
  CHECK(r.size == offsetof(ph_result, limited));
  CHECK((r.limited == -7 && r.capped == -7));
  r.size = offsetof(ph_result, torque);
  r.torque[0] = -7.0;
  CHECK(c.tick(touch.port, here, 1e-3, &r) == PH_OK);
  CHECK((r.limited == 0 && r.capped == 0 && r.torque[0] == -7.0));
}

TEST_CASE("NULL is answered, and costs no more than a lost sample", "[c_interface]") {
  const loaded c;
  const auto p = grip();
  std::string why(PH_TEXT_ROOM, 'x');
  ph_port* port = nullptr;
  CHECK(c.create(nullptr, &p, &port, why.data(), why.size()) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_create: composition is NULL");
  CHECK(c.create("touch", nullptr, &port, why.data(), why.size()) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_create: parameters is NULL");
  CHECK(c.create("touch", &p, nullptr, why.data(), why.size()) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_create: port is NULL");
  c.destroy(nullptr);

  const double v[3] = {0, 0, 1};
  ph_result r{};
  r.size = sizeof r;
  r.force[0] = 99.0;
  CHECK(c.tick(nullptr, v, 1e-3, &r) == PH_NULL_ARGUMENT);
  CHECK(r.event == PH_REJECTED_PARAMETERS);
  CHECK(r.force[0] == 0.0);
  CHECK(c.publish_plane(nullptr, v, v, 1.0) == PH_NULL_ARGUMENT);
  CHECK(c.publish_nothing(nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.held(nullptr, v) == PH_NULL_ARGUMENT);
  CHECK(c.stiffness_budget(nullptr, r.force, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.stiffness_budget(&p, nullptr, nullptr) == PH_NULL_ARGUMENT);

  const opened touch(c, "touch", p);
  const opened guard(c, "guard", p);
  CHECK(c.publish_plane(touch.port, nullptr, v, 1.0) == PH_NULL_ARGUMENT);
  CHECK(c.publish_plane(touch.port, v, nullptr, 1.0) == PH_NULL_ARGUMENT);
  CHECK(c.held(touch.port, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.tick(touch.port, v, 1e-3, nullptr) == PH_NULL_ARGUMENT);
  for (const auto& wrong :
       {c.tick(touch.port, nullptr, 1e-3, &r), c.tick_wanted(guard.port, v, 1e-3, nullptr, &r),
        c.tick_wanted(guard.port, nullptr, 1e-3, v, &r)}) {
    CHECK(wrong == PH_NULL_ARGUMENT);
    CHECK(r.event == PH_REJECTED_SAMPLE);
    CHECK((r.force[0] == 0.0 && r.force[1] == 0.0 && r.force[2] == 0.0));
  }
  // A plane for a guard, a force for a touch.
  CHECK(c.publish_plane(guard.port, v, v, 1.0) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.publish_nothing(guard.port) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.tick_wanted(touch.port, v, 1e-3, v, &r) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(r.event == PH_REJECTED_SAMPLE);
}

TEST_CASE("a number that is none gives force zero, an event and no credit, from C too",
          "[c_interface]") {
  const loaded c;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double none[3] = {0, nan, 0};
  const double up[3] = {0, 0, 1};
  const double zero[3] = {0, 0, 0};
  ph_result r{};
  r.size = sizeof r;
  const opened touch(c, "touch", grip());
  const auto press = [&] {
    for (int n = 0; n <= 50; ++n) {
      const double x[3] = {0, 0, -2e-5 * n};
      REQUIRE(c.tick(touch.port, x, 1e-3, &r) == PH_OK);
    }
    CHECK(r.event == PH_NOMINAL);
    CHECK(r.force[2] > 0.5);
  };
  CHECK(c.publish_plane(touch.port, none, up, 1000.0) == PH_REFUSED_SURFACE);
  CHECK(c.publish_plane(touch.port, zero, none, 1000.0) == PH_REFUSED_SURFACE);
  CHECK(c.publish_plane(touch.port, zero, zero, 1000.0) == PH_REFUSED_SURFACE);
  CHECK(c.publish_plane(touch.port, zero, up, nan) == PH_REFUSED_SURFACE);
  CHECK(c.publish_plane(touch.port, zero, up, 0.0) == PH_REFUSED_SURFACE);
  CHECK(c.publish_plane(touch.port, zero, up, 1000.0) == PH_OK);
  struct bad {
    const double* position;
    double dt;
  };
  const double far_away[3] = {0, 0, 1.0};
  for (const bad& sample :
       {bad{none, 1e-3}, bad{zero, nan}, bad{zero, 0.0}, bad{zero, -1e-3}, bad{far_away, 1e-3}}) {
    press();
    const double before = r.energy;
    CHECK(c.tick(touch.port, sample.position, sample.dt, &r) == PH_OK);
    CHECK(r.event == PH_REJECTED_SAMPLE);
    CHECK((r.force[0] == 0.0 && r.force[1] == 0.0 && r.force[2] == 0.0));
    CHECK(r.energy <= std::max(before, ph::amends_for(3.3)));  // what is forgiven, and no credit
  }
  press();
  CHECK(c.held(touch.port, none) == PH_OK);
  CHECK(c.tick(touch.port, zero, 1e-3, &r) == PH_OK);
  CHECK(r.event == PH_REJECTED_SAMPLE);
  CHECK(c.tick(touch.port, zero, 1e-3, &r) == PH_OK);  // said for one tick only
  CHECK(r.event == PH_NOMINAL);
  const double millimetres[3] = {0, 0, 20.0};
  const opened elsewhere(c, "touch", grip());
  CHECK(c.tick(elsewhere.port, zero, 1e-3, &r) == PH_OK);
  CHECK(c.tick(elsewhere.port, millimetres, 10.0, &r) == PH_OK);
  CHECK(r.event == PH_OUTSIDE_WORKSPACE);
}

TEST_CASE("two ports share nothing", "[c_interface]") {
  const loaded c;
  const opened one(c, "touch", grip());
  const opened two(c, "touch", grip());
  const double up[3] = {0, 0, 1};
  const double zero[3] = {0, 0, 0};
  REQUIRE(c.publish_plane(one.port, zero, up, 1000.0) == PH_OK);
  ph_result a{};
  ph_result b{};
  a.size = b.size = sizeof a;
  for (int n = 0; n < 50; ++n) {
    const double x[3] = {0, 0, -2e-5 * n};
    REQUIRE(c.tick(one.port, x, 1e-3, &a) == PH_OK);
    REQUIRE(c.tick(two.port, x, 1e-3, &b) == PH_OK);
  }
  CHECK(a.event == PH_NOMINAL);
  CHECK(a.force[2] > 0.5);
  CHECK(b.event == PH_NO_TARGET);
  CHECK(b.force[2] == 0.0);
}

TEST_CASE("one thread publishes while another ticks", "[c_interface]") {
  const loaded c;
  const opened touch(c, "touch", grip());
  std::atomic<bool> over{false};
  std::thread environment([&] {
    const double point[3] = {0, 0, 0};
    const double normal[3] = {0, 0, 1};
    for (int n = 0; !over; ++n) {
      c.publish_plane(touch.port, point, normal, n % 2 == 1 ? 1000.0 : 2000.0);
    }
  });
  ph_result r{};
  r.size = sizeof r;
  bool good = true;
  int contacts = 0;
  constexpr int most = 20'000'000;  // the other thread may take its time to begin
  for (int n = 0; contacts < 10000 && n < most; ++n) {
    const int at = n % 400 < 200 ? 100 - n % 200 : n % 200 - 100;
    const double x[3] = {0, 0, 1e-5 * at};
    c.tick(touch.port, x, 1e-3, &r);
    good = good && r.force[0] == 0.0 && r.force[1] == 0.0 && r.force[2] >= 0.0 &&
           r.force[2] <= 3.3 && r.event <= PH_NO_TARGET;
    contacts += r.force[2] > 0.0;
  }
  over = true;
  environment.join();
  CHECK(good);
  CHECK(contacts == 10000);
}

TEST_CASE("none but ph_create and ph_destroy allocates", "[c_interface]") {
  const loaded c;
  const auto in_create = allocations();
  const opened touch(c, "encoder_touch", on_encoders());
  const opened guard(c, "guard", grip());
  CHECK(allocations() == in_create + 2);  // the control: what the library asks for is counted
  ph_result r{};
  r.size = sizeof r;
  const auto before = allocations();
  for (int n = 0; n < ticks; ++n) {
    const moment now = moment_at(n);
    if (now.news == a_plane) c.publish_plane(touch.port, now.point, now.normal, now.stiffness);
    if (now.news == nothing_here) c.publish_nothing(touch.port);
    if (now.reports_held) c.held(touch.port, now.held);
    c.tick(touch.port, now.position, now.dt, &r);
    c.tick_wanted(guard.port, now.position, now.dt, now.wanted, &r);
    (void)c.event_text(r.event);
  }
  CHECK(allocations() == before);
}

TEST_CASE("version, texts and budget are the library's", "[c_interface]") {
  const loaded c;
  CHECK(c.version() == 10000 * ph::version_major + 100 * ph::version_minor + ph::version_patch);
  for (int e = PH_NOMINAL; e <= PH_WALL_BACK; ++e) {
    CHECK(std::string(c.event_text(e)) == ph::to_string(static_cast<ph::event>(e)));
  }
  for (const int none : {-1, PH_WALL_BACK + 1, 1 << 20}) {
    CHECK(std::string(c.event_text(none)) == "unknown event");
    CHECK(std::string(c.status_text(none)) == "unknown status");
  }
  for (int s = PH_OK; s <= PH_NO_PLACE; ++s) {
    CHECK(std::string(c.status_text(s)) != "unknown status");
  }
  double K = 0.0;
  const char* because = nullptr;
  const auto p = on_encoders();
  CHECK(c.stiffness_budget(&p, &K, &because) == PH_OK);
  const auto budget = ph::design::stiffness_budget(stated);
  CHECK(K == budget.stiffness);
  CHECK(std::string(because) == budget.because());
  auto bad = p;
  bad.mass = 0.0;
  CHECK(c.stiffness_budget(&bad, &K, &because) == PH_REFUSED_PARAMETER);
  CHECK(K == 0.0);
}

TEST_CASE("a port explains itself in C as it does in C++", "[c_interface]") {
  const loaded c;
  ph_parameters slow = grip();
  slow.longest_tick = 2e-2;
  const opened touch(c, "touch", slow), guard(c, "guard", grip());
  const opened stylus(c, "stylus", grip());
  const double point[3] = {0, 0, 0}, up[3] = {0, 0, 1}, inside[3] = {0, 0, -1e-3};
  ph_explanation e{};
  CHECK(c.explain(touch.port, &e) == PH_WRONG_SIZE);
  e.size = sizeof e;
  CHECK(c.explain(nullptr, &e) == PH_NULL_ARGUMENT);
  CHECK(c.explain(touch.port, nullptr) == PH_NULL_ARGUMENT);
  REQUIRE(c.publish_plane(touch.port, point, up, 1e4) == PH_OK);
  ph_result r{};
  r.size = sizeof r;
  auto direct = exact;
  direct.longest_tick = 2e-2;
  auto same = ph::make_touch<d3>(direct, hand);
  REQUIRE(same.update({d3::zero(), d3::vector(0, 0, 1), 1e4}));
  for (int n = 0; n < 20; ++n) {
    REQUIRE(c.tick(touch.port, inside, 1e-2, &r) == PH_OK);
    (void)same.tick({0, 0, -1e-3}, 10ms);
  }
  const auto said = same.explain();
  CHECK(c.explain(touch.port, &e) == PH_OK);
  CHECK(e.asked == 1e4);
  CHECK(e.shown == said.shown);
  CHECK(e.shown < 50.0);
  CHECK(e.depth == said.depth);
  CHECK(e.force == said.force);
  CHECK(std::string(e.because) == said.because());
  CHECK(c.explain(guard.port, &e) == PH_OK);
  CHECK(e.shown > 1000.0);
  const double pen[3] = {0, 0, 0.1}, turn[4] = {1, 0, 0, 0};
  REQUIRE(c.publish_plane(stylus.port, point, up, 500.0) == PH_OK);
  REQUIRE(c.tick_pose(stylus.port, pen, turn, 1e-3, &r) == PH_OK);
  CHECK(c.explain(stylus.port, &e) == PH_OK);
  CHECK(e.asked == 500.0);
}
