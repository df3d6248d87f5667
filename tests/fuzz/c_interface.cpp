// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's door to the C interface, whose sources are compiled in: any name, any parameters of any size, any calls
// on a port that is alive, and on a mesh and a probe. Every force is a number and within what the motors hold.
#include "examples/c_interface/contacts.cpp"
#include "examples/c_interface/detents.cpp"
#include "examples/c_interface/guard.cpp"
#include "examples/c_interface/mesh.cpp"
#include "examples/c_interface/passive_haptics_c.cpp"
#include "examples/c_interface/tool.cpp"
#include "examples/c_interface/touch.cpp"
#include "fuzz/numbers.hpp"

#include <cmath>
#include <cstdlib>

namespace {

void put(fuzz::numbers& in, double* to, int count, double size) {
  for (int i = 0; i < count; ++i) to[i] = in.around<double>(size);
}

/// Parameters that every composition takes, for those that do not know steps without them.
ph_parameters good_parameters(fuzz::numbers& in) {
  const auto near = [&in](double usual) { return usual * (0.5 + in.one() / 256.0); };
  ph_parameters p{};
  p.size = sizeof p;
  p.latency = in.one() < 128 ? 0 : in.one() % 10;
  p.mass = near(0.1);
  p.damping = near(0.05);
  p.hand_force = near(5.0);
  p.force_limit = near(9.0);
  p.longest_tick = near(1.5e-3);
  p.friction = near(0.13);
  p.presliding = near(15e-6);
  p.quantum = in.one() < 128 ? 0.0 : near(20e-6);
  p.static_friction = near(0.4);
  p.stiffness = near(1000.0);
  p.radius = near(5e-4);
  p.tip[2] = near(0.01);
  p.least_inertia = near(1e-4);
  p.inertia_spread = near(2e-4);
  p.angular_damping = near(1e-4);
  p.damping_most = near(0.2);
  p.angular_damping_most = near(4e-4);
  p.hand_torque = near(0.1);
  p.torque_limit = near(0.5);
  p.pitch = near(0.01);
  p.detent_stiffness = near(1e3);
  p.point_count = 1 + in.one() % PH_TOOL_POINTS;
  for (std::uint32_t k = 0; k < p.point_count; ++k) {
    for (double& one : p.points[k]) one = 4e-5 * (in.one() - 127.5);
  }
  return p;
}
ph_parameters any_parameters(fuzz::numbers& in) {
  if (in.one() < 160) return good_parameters(in);
  ph_parameters p{};
  p.size = in.one() < 240 ? sizeof p : in.any<std::uint32_t>();
  p.latency = in.one() < 128 ? 0 : in.one() < 240 ? in.one() % 9 : in.any<std::uint32_t>();
  p.mass = in.about(0.1);
  p.damping = in.about(0.05);
  p.hand_force = in.about(5.0);
  p.force_limit = in.about(9.0);
  p.longest_tick = in.about(1e-3);
  p.friction = in.about(0.13);
  p.presliding = in.about(15e-6);
  p.quantum = in.one() < 128 ? 0.0 : in.about(20e-6);
  for (double* more : {&p.continuous_force, &p.winding_time, &p.turn_rate, &p.stale_after,
                       &p.top_speed, &p.workspace, &p.watchdog, &p.static_friction,
                       &p.kinetic_friction, &p.stiffness, &p.viscosity, &p.radius}) {
    *more = in.one() < 160 ? 0.0 : in.about(1.0);
  }
  if (in.one() < 128) return p;
  put(in, p.tip, 3, 0.01);
  p.least_inertia = in.about(1e-4);
  p.inertia_spread = in.about(2e-4);
  p.inertia_offset = in.one() < 128 ? 0.0 : in.about(0.005);
  p.angular_damping = in.about(1e-4);
  p.damping_most = in.about(0.1);
  p.angular_damping_most = in.about(2e-4);
  p.hand_torque = in.about(0.1);
  p.torque_limit = in.about(0.5);
  p.lever = in.one() < 128 ? 0.0 : in.about(0.03);
  if (in.one() < 128) return p;
  p.pitch = in.about(0.01);
  p.detent_stiffness = in.about(1e3);
  p.first_stop = in.one() < 128 ? 0.0 : in.about(0.01);
  p.last_stop = in.one() < 128 ? 0.0 : in.about(0.02);
  p.stop_stiffness = in.one() < 64 ? 0.0 : in.about(1e3);
  p.rotary = in.one() % 2;
  p.point_count = in.one() < 250 ? in.one() % 10 : in.any<std::uint32_t>();
  for (auto& point : p.points) put(in, point, 3, 0.02);
  return p;
}

ph_surface any_surface(fuzz::numbers& in) {
  ph_surface s{};
  s.size = in.one() < 250 ? sizeof s : in.any<std::uint32_t>();
  s.kind = in.one() < 250 ? in.one() % 8 : in.any<std::uint32_t>();
  if (in.one() < 160) {  // one of its kind, near by
    s.stiffness = 8.0 * (1 + in.one());
    s.radius = 1e-3 * (1 + in.one() % 16);
    s.a[2] = -s.radius;
    s.b[0] = 1e-3 * in.one();
    s.b[2] = 1.0;
    s.c[1] = 0.1;
    s.half[0] = s.half[1] = s.half[2] = 2e-3;
    s.curvature[0] = 100.0 - in.one();
    s.thickness = 5e-3;
    s.at[0] = 1e-4 * in.one();
    return s;
  }
  s.stiffness = in.about(1000.0);
  put(in, s.a, 3, 5e-3);
  put(in, s.b, 3, 1.0);
  put(in, s.c, 3, 1.0);
  s.radius = in.about(5e-3);
  put(in, s.half, 3, 5e-3);
  put(in, s.curvature, 2, 50.0);
  s.thickness = in.about(5e-3);
  s.reach = in.one() < 128 ? 0.0 : in.about(5e-3);
  put(in, s.at, 3, 0.02);
  return s;
}

/// A tetrahedron where the device is, of any numbers, and what touches it beside the port.
struct a_mesh {
  a_mesh(fuzz::numbers& in, std::uint8_t luck) noexcept {
    constexpr double corners[]{-9e-3, -5e-3, 0, 9e-3, -5e-3, 0, 0, 9e-3, 0, 0, 0, -5e-3};
    std::copy(std::begin(corners), std::end(corners), vertices);
    std::int32_t triangles[]{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    double materials[]{800.0, 0.2, 0.1, 2000.0, 0.0, 0.0};
    std::uint8_t of[]{0, 1, 1, 0};
    ph_mesh_data data{sizeof data, 4,        4,
                      luck % 3U,   vertices, triangles,
                      materials,   of,       luck % 5U == 0U ? 0.7 : 0.0};
    if (luck > 200) {
      for (double* numbers : {vertices, materials}) put(in, numbers, 6, 5e-3);
      triangles[in.one() % 12] = in.any<std::int32_t>();
      of[in.one() % 4] = static_cast<std::uint8_t>(in.one());
      if (luck > 240) data.size = in.any<std::uint32_t>();
    }
    said = ph_mesh_create(&data, &mesh, why.data(), why.size());
    ph_probe_parameters p{};
    p.size = sizeof p;
    if (luck > 220) p.radius = in.about(5e-4);
    (void)ph_probe_create(&p, &probe, nullptr, 0);
    (void)ph_probe_touch(probe, mesh);
  }
  a_mesh(const a_mesh&) = delete;
  a_mesh& operator=(const a_mesh&) = delete;
  ~a_mesh() {
    ph_mesh_destroy(mesh);
    ph_probe_destroy(probe);
  }
  /// News, and who touches it.
  void tell(fuzz::numbers& in, ph_port* port, unsigned op) noexcept {
    double x[3]{}, q[4]{};
    switch (op / 16) {
      case 0:
      case 1:
        (void)ph_mesh_touch(port, mesh);
        break;
      case 2:
        if (in.one() < 128) (void)ph_mesh_let_go(port, mesh);
        if (in.one() < 32) (void)ph_probe_let_go(probe, mesh);
        if (in.one() < 32) (void)ph_probe_reset(probe);
        break;
      case 3: {
        double materials[6]{800.0, 0.2, 0.1, in.about(2000.0), in.about(0.2), in.about(0.1)};
        std::uint8_t of[]{0, 1, 0, static_cast<std::uint8_t>(in.one() % 3)};
        (void)ph_mesh_set_materials(mesh, materials, in.one() % 3, of, nullptr, 0);
        (void)ph_mesh_doubt(mesh, nullptr, 0);
        break;
      }
      case 4:
      case 5:
        put(in, x, 3, 5e-3);
        put(in, q, 4, 1.0);
        (void)ph_mesh_move(mesh, x, q);
        break;
      default:
        put(in, vertices + 3 * (op / 16 % 4), 3, 8e-3);
        (void)ph_mesh_update(mesh, vertices, op < 240 ? 4 : in.one() % 5, nullptr, 0);
        break;
    }
  }

  double vertices[12]{};
  ph_mesh* mesh = nullptr;
  ph_probe* probe = nullptr;
  std::array<char, PH_TEXT_ROOM> why{};
  std::int32_t said = 0;
};

/// What is told between two ticks.
void tell(fuzz::numbers& in, ph_port* port, unsigned op) {
  double point[3]{}, other[3]{};
  switch (op % 16) {
    case 0:
      put(in, point, 3, 2e-3);
      put(in, other, 3, 1.0);
      (void)ph_publish_plane(port, point, op == 16 ? nullptr : other, in.about(1000.0));
      break;
    case 1:
      if (op == 1) (void)ph_publish_nothing(port);
      if (op == 17) (void)ph_reset(port);
      if (op % 64 == 49) (void)ph_enable_forces(port, static_cast<std::int32_t>(in.one() % 4));
      if (op % 64 == 33) (void)ph_release(port, in.one() % 5, in.one() % 8);
      break;
    case 2:
      put(in, point, 3, 9.0);
      put(in, other, 3, 0.5);
      (void)ph_held(port, point);
      (void)ph_held_wrench(port, point, other);
      break;
    case 6: {
      const ph_surface s = any_surface(in);
      (void)ph_publish(port, in.one() < 240 ? in.one() % 5 : in.any<std::uint32_t>(), &s);
      break;
    }
    case 10: {
      ph_explanation e{};
      e.size = sizeof e;
      (void)ph_explain(port, &e);
      break;
    }
    default:
      break;
  }
}

const char* one_port(fuzz::numbers& in) {
  // What turns comes first.
  constexpr const char* names[]{"stylus",
                                "tool",
                                "mesh_tool",
                                "touch",
                                "encoder_touch",
                                "strict_touch",
                                "contacts",
                                "guard",
                                "encoder_guard",
                                "strict_guard",
                                "strict_encoder_touch",
                                "encoder_contacts",
                                "strict_contacts",
                                "strict_encoder_contacts",
                                "strict_encoder_guard",
                                "quantised_touch",
                                "mesh_touch",
                                "strict_encoder_mesh_touch",
                                "detents",
                                "encoder_detents",
                                "strict_detents",
                                "none",
                                nullptr};
  const std::size_t which = in.one() % std::size(names);
  const char* name = names[which];
  const bool poses = which < 3;
  ph_parameters p = any_parameters(in);
  std::array<char, PH_TEXT_ROOM> why{};
  const std::size_t room = in.one() % 2 == 0 ? why.size() : in.one() % why.size();
  ph_port* port = nullptr;
  const int made = ph_create(name, in.one() < 250 ? &p : nullptr, &port, why.data(), room);
  if ((made == PH_OK) != (port != nullptr)) return "a port, or a reason, not both";
  if (room > 0 && std::memchr(why.data(), 0, room) == nullptr) return "a text without its end";
  if (made != PH_OK && room > 40 && why[0] == 0) return "refused without a word";
  double stiffness = 0.0;
  (void)ph_stiffness_budget(&p, &stiffness, nullptr);
  (void)ph_guarantee_of(port);
  const std::uint8_t luck = in.empty() ? 0 : static_cast<std::uint8_t>(in.one());
  a_mesh mesh(in, luck);
  if ((mesh.said == PH_OK) != (mesh.mesh != nullptr)) return "a mesh, or a reason, not both";
  if ((mesh.said == PH_OK) != (mesh.why[0] == 0)) return "a mesh refused without a word";
  (void)ph_mesh_touch(port, mesh.mesh);
  double x[3]{}, q[4]{}, wanted[3]{};
  for (int n = 0; n < 300 && !in.empty(); ++n) {
    const unsigned op = in.one();
    tell(in, port, op);
    if (op % 16 == 14) mesh.tell(in, port, op);
    if (op % 32 == 12) {  // other parameters, and now and then those that stay
      ph_parameters later = in.one() < 64 ? any_parameters(in) : p;
      later.force_limit = in.about(9.0);
      later.hand_force = in.about(5.0);
      if (ph_set(port, &later, why.data(), why.size()) == PH_OK) {
        p = later;
      } else if (why[0] == 0) {
        return "refused without a word";
      }
    }
    if (op >= 224 || !std::isfinite(x[0] + x[1] + x[2])) {
      put(in, x, 3, 5e-3);
    } else {
      std::for_each(x, x + 3, [&in](double& one) { one += in.around<double>(3e-4); });
    }
    const double dt = op < 200 ? 1e-3 : in.around<double>(2e-3);
    ph_probe_result ball{};
    ball.size = sizeof ball;
    (void)ph_probe_step(mesh.probe, x, dt, &ball);
    if (!std::isfinite(ball.place[0] + ball.place[1] + ball.place[2] + ball.depth))
      return "a ball at no place";
    ph_result out{};
    out.size = op == 3 ? in.any<std::uint32_t>() : sizeof out;
    int said = 0;
    if (poses ? op % 16 != 7 : op % 16 == 7) {
      put(in, q, 4, 1.0);
      const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
      if (op < 240) std::for_each(q, q + 4, [length](double& one) { one /= length; });
      said = ph_tick_pose(port, op == 4 ? nullptr : x, op == 5 ? nullptr : q, dt, &out);
    } else if (op % 2 == 0) {
      said = ph_tick(port, op == 4 ? nullptr : x, dt, &out);
    } else {
      put(in, wanted, 3, 20.0);
      said = ph_tick_wanted(port, x, dt, op == 5 ? nullptr : wanted, &out);
    }
    if (said == PH_NULL_ARGUMENT && port != nullptr && op != 4 && op != 5)
      return "no pointer is NULL";
    const double size = std::hypot(out.force[0], out.force[1], out.force[2]);
    if (!std::isfinite(size)) return "a force that is no number";
    if (size > 0.0 && port == nullptr) return "a force of no port";
    if (port != nullptr && size > p.force_limit * (1.0 + 1e-12) + 1e-150)
      return "a force above the motors' limit";
    const double turns = std::hypot(out.torque[0], out.torque[1], out.torque[2]);
    if (!(turns <= p.torque_limit * (1.0 + 1e-12) + 1e-150) && turns != 0.0)
      return "a torque above the motors' limit";
    if (ph_event_text(out.event) == nullptr) return "an event without a text";
  }
  ph_destroy(port);
  return nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::numbers in({data, size});
  if (const char* broken = one_port(in)) {
    std::fprintf(stderr, "%s\n", broken);
    std::abort();
  }
  return 0;
}
