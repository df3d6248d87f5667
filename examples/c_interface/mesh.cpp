// SPDX-License-Identifier: BSD-3-Clause
// Meshes, the ports that touch them, and the probe that does without a port.
#include "rigid.hpp"
#include <passive_haptics/mesh.hpp>
#include <passive_haptics/mesh/mesh_tool.hpp>

#include <cstddef>
#include <exception>
#include <optional>

using surface = passive_haptics::mesh::surface;

/// What a caller holds of a mesh; what touches it holds the same triangles.
struct ph_mesh {
  std::shared_ptr<surface> triangles;
};

namespace c_interface {
namespace {

namespace mesh = ph::mesh;

/// The meshes that a finger touches, which last as long as it touches them.
class touched {
 public:
  std::int32_t touch(auto& finger, const ph_mesh& m) noexcept {
    const auto free = std::find(held_.begin(), held_.end(), nullptr);
    if (free == held_.end() || !also(finger, *m.triangles)) return PH_NO_PLACE;
    *free = m.triangles;
    return PH_OK;
  }
  std::int32_t let_go(auto& finger, const ph_mesh& m) noexcept {
    const auto one = std::find(held_.begin(), held_.end(), m.triangles);
    if (one == held_.end()) return PH_OK;
    finger.let_go(**one);
    one->reset();
    return PH_OK;
  }

 private:
  static bool also(auto& finger, const surface& s) noexcept {
    if constexpr (requires { finger.also_touch(s); }) {
      return finger.also_touch(s);
    } else {
      return finger.touch(s);
    }
  }
  static_assert(PH_MESHES == mesh::proxy::most_meshes);
  std::array<std::shared_ptr<surface>, PH_MESHES> held_;
};

[[nodiscard]] ph::mesh_contact mesh_shape_of(const ph_parameters& p) noexcept {
  ph::mesh_contact shape{.viscosity = p.viscosity};
  shape.stiffness = stated(p.stiffness, shape.stiffness);
  shape.proxy.radius = stated(p.radius, shape.proxy.radius);
  shape.proxy.friction = p.static_friction;
  return shape;
}
struct without_slots {
  static constexpr int plane_slots = 0, curved_slots = 0;
  template <class Port>
  static void adjust(Port& port, const ph_parameters& p) noexcept {
    (void)port.set(limits<Port::latency>(p));
  }
};
template <auto Device, auto Hand>
struct mesh_touch : without_slots {
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    return ph::make_mesh_touch<scene, Loop>(Device(p), Hand(p), mesh_shape_of(p));
  }
};
struct mesh_tool : without_slots {
  template <class Loop>
  static auto make(const ph_parameters& p) noexcept {
    std::array<std::array<double, 3>, PH_TOOL_POINTS> points{};
    for (std::uint32_t i = 0; i < p.point_count; ++i)
      std::copy_n(p.points[i], 3, points[i].begin());
    return ph::make_mesh_tool<ph::rigid_body<double>, Loop>(rigid_device_of(p), rigid_hand_of(p),
                                                            points, mesh_shape_of(p),
                                                            static_cast<int>(p.point_count));
  }
};

template <class Composition, class Port>
class mesh_port final : public composed<Composition, Port> {
 public:
  using composed<Composition, Port>::composed;
  ~mesh_port() override { this->port_.source().let_go(); }
  std::int32_t touch(const ph_mesh& m) noexcept override {
    return held_.touch(this->port_.source(), m);
  }
  std::int32_t let_go(const ph_mesh& m) noexcept override {
    return held_.let_go(this->port_.source(), m);
  }

 private:
  touched held_;
};

constexpr std::size_t shortest_data = offsetof(ph_mesh_data, crease);
static_assert(sizeof(ph_mesh_data) == 56 && shortest_data == 48);

/// How its edges are rounded; a struct of an older header says nothing of it.
[[nodiscard]] std::optional<mesh::smooth> rounding_of(const ph_mesh_data& data) noexcept {
  if (data.size < sizeof(ph_mesh_data) || data.crease == 0.0) return {};
  return mesh::smooth{.crease = data.crease};
}

struct vertices {
  const double* first;
  std::size_t count;
  [[nodiscard]] std::size_t size() const noexcept { return count; }
  [[nodiscard]] const double* operator[](std::size_t i) const noexcept { return first + 3 * i; }
};
std::int32_t refuse_null(const text& reason, const char* function, const char* what) noexcept {
  reason.say("%s: %s is NULL", function, what);
  return PH_NULL_ARGUMENT;
}
/// What `make` answers; a sentence that it throws goes to `reason`.
std::int32_t guarded(const text& reason, auto make) noexcept {
  try {
    return make();
  } catch (const std::invalid_argument& fault) {
    reason.say("%s", fault.what());
    return PH_REFUSED_MESH;
  } catch (const std::exception&) {
    reason.say("%s", "mesh: there is no memory for it; give a coarser one");
    return PH_OUT_OF_MEMORY;
  }
}
[[nodiscard]] mesh::made_of stuff_of(const double* materials, std::uint32_t count,
                                     const std::uint8_t* material_of, std::size_t triangles) {
  mesh::made_of stuff;
  if (count == 0) return stuff;
  // One more than there may be is refused by the library, in its words.
  for (std::uint32_t i = 0; i < std::min(count, 257U); ++i) {
    const double* one = materials + 3 * std::size_t{i};
    stuff.materials.push_back({one[0], one[1], one[2]});
  }
  stuff.of.assign(triangles, 0);
  if (material_of != nullptr) stuff.of.assign(material_of, material_of + triangles);
  return stuff;
}

}  // namespace

made make_mesh_touch(const ph_parameters& p, facts of) noexcept {
  return make_by_facts<mesh_touch, mesh_port>(p, of);
}
made make_mesh_tool(const ph_parameters& p, facts /*of*/) noexcept {
  return make<mesh_tool, PH_MOST_TOOL_LATENCY, mesh_port>(p);
}

}  // namespace c_interface

/// A ball, and what it touches.
struct ph_probe {
  explicit ph_probe(const passive_haptics::mesh::proxy_parameters& p) noexcept : ball(p) {}
  ph_probe(const ph_probe&) = delete;
  ph_probe& operator=(const ph_probe&) = delete;
  ~ph_probe() { ball.let_go(); }

  passive_haptics::mesh::proxy ball;
  c_interface::touched held;
};

using namespace c_interface;  // NOLINT(google-build-using-namespace): the functions of the header

extern "C" {

std::int32_t ph_mesh_create(const ph_mesh_data* data, ph_mesh** made, char* why,
                            std::size_t room) noexcept {
  const text reason(why, room);
  if (made != nullptr) *made = nullptr;
  if (data == nullptr || made == nullptr) {
    return refuse_null(reason, "ph_mesh_create", data == nullptr ? "data" : "mesh");
  }
  if (!known_size<ph_mesh_data>(data->size, shortest_data)) {
    return refuse_size<ph_mesh_data>(reason, "ph_mesh_data", data->size);
  }
  const bool numbered = data->triangle_count == 0 || data->triangles != nullptr;
  if ((data->vertex_count > 0 && data->vertices == nullptr) || !numbered) {
    return refuse_null(reason, "ph_mesh_create", numbered ? "vertices" : "triangles");
  }
  if (data->material_count > 0 && data->materials == nullptr) {
    return refuse_null(reason, "ph_mesh_create", "materials");
  }
  return guarded(reason, [&]() -> std::int32_t {
    if (const auto fault = surface::check_count(data->triangle_count); !fault.empty()) {
      reason.say("%s", fault.c_str());
      return PH_REFUSED_MESH;
    }
    std::vector<mesh::triangle> triangles(data->triangle_count);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      std::copy_n(data->triangles + 3 * i, 3, triangles[i].begin());
    }
    const vertices all{data->vertices, data->vertex_count};
    auto stuff =
        stuff_of(data->materials, data->material_count, data->material_of, triangles.size());
    *made = new ph_mesh{
        std::make_shared<surface>(std::move(triangles), all, std::move(stuff), rounding_of(*data))};
    return PH_OK;
  });
}

void ph_mesh_destroy(ph_mesh* mesh) noexcept {
  delete mesh;
}

std::int32_t ph_mesh_update(ph_mesh* mesh, const double* places, std::uint32_t vertex_count,
                            char* why, std::size_t room) noexcept {
  const text reason(why, room);
  if (mesh == nullptr || places == nullptr) {
    return refuse_null(reason, "ph_mesh_update", mesh == nullptr ? "mesh" : "vertices");
  }
  return guarded(reason, [&]() -> std::int32_t {
    if (mesh->triangles->update(vertices{places, vertex_count})) return PH_OK;
    reason.say("%s", mesh->triangles->fault().c_str());
    return PH_REFUSED_MESH;
  });
}

std::int32_t ph_mesh_set_materials(ph_mesh* mesh, const double* materials,
                                   std::uint32_t material_count, const std::uint8_t* material_of,
                                   char* why, std::size_t room) noexcept {
  const text reason(why, room);
  if (mesh == nullptr || (material_count > 0 && materials == nullptr)) {
    return refuse_null(reason, "ph_mesh_set_materials", mesh == nullptr ? "mesh" : "materials");
  }
  surface& s = *mesh->triangles;
  return guarded(reason, [&]() -> std::int32_t {
    if (s.update(stuff_of(materials, material_count, material_of, s.triangles().size())))
      return PH_OK;
    reason.say("%s", s.fault().c_str());
    return PH_REFUSED_MESH;
  });
}

std::int32_t ph_mesh_move(ph_mesh* mesh, const double position[3],
                          const double orientation[4]) noexcept {
  if (mesh == nullptr || position == nullptr || orientation == nullptr) return PH_NULL_ARGUMENT;
  const double *p = position, *q = orientation;
  return guarded(text(nullptr, 0), [&]() -> std::int32_t {
    const passive_haptics::mesh::pose there{{p[0], p[1], p[2]}, q[0], {q[1], q[2], q[3]}};
    return mesh->triangles->update(there) ? PH_OK : PH_REFUSED_MESH;
  });
}

std::int32_t ph_mesh_doubt(const ph_mesh* mesh, char* doubt, std::size_t room) noexcept {
  const text reason(doubt, room);
  if (mesh == nullptr) return refuse_null(reason, "ph_mesh_doubt", "mesh");
  return guarded(reason, [&]() -> std::int32_t {
    reason.say("%s", mesh->triangles->doubt().c_str());
    return PH_OK;
  });
}

std::int32_t ph_mesh_touch(ph_port* port, const ph_mesh* mesh) noexcept {
  return port == nullptr || mesh == nullptr ? std::int32_t{PH_NULL_ARGUMENT} : port->touch(*mesh);
}
std::int32_t ph_mesh_let_go(ph_port* port, const ph_mesh* mesh) noexcept {
  return port == nullptr || mesh == nullptr ? std::int32_t{PH_NULL_ARGUMENT} : port->let_go(*mesh);
}

std::int32_t ph_probe_create(const ph_probe_parameters* parameters, ph_probe** probe, char* why,
                             std::size_t room) noexcept {
  const text reason(why, room);
  if (probe != nullptr) *probe = nullptr;
  if (parameters == nullptr || probe == nullptr) {
    return refuse_null(reason, "ph_probe_create", parameters == nullptr ? "parameters" : "probe");
  }
  if (!known_size<ph_probe_parameters>(parameters->size, sizeof(ph_probe_parameters))) {
    return refuse_size<ph_probe_parameters>(reason, "ph_probe_parameters", parameters->size);
  }
  passive_haptics::mesh::proxy_parameters own{.friction = parameters->friction};
  own.radius = stated(parameters->radius, own.radius);
  own.news_speed = stated(parameters->news_speed, own.news_speed);
  own.longest_way = stated(parameters->longest_way, own.longest_way);
  if (const auto fault = own.check()) return refuse(reason, fault);
  *probe = new (std::nothrow) ph_probe(own);
  if (*probe != nullptr) return PH_OK;
  reason.say("%s", "ph_probe_create: no memory for a probe");
  return PH_OUT_OF_MEMORY;
}

void ph_probe_destroy(ph_probe* probe) noexcept {
  delete probe;
}
std::int32_t ph_probe_touch(ph_probe* probe, const ph_mesh* mesh) noexcept {
  if (probe == nullptr || mesh == nullptr) return PH_NULL_ARGUMENT;
  return probe->held.touch(probe->ball, *mesh);
}
std::int32_t ph_probe_let_go(ph_probe* probe, const ph_mesh* mesh) noexcept {
  if (probe == nullptr || mesh == nullptr) return PH_NULL_ARGUMENT;
  return probe->held.let_go(probe->ball, *mesh);
}
std::int32_t ph_probe_reset(ph_probe* probe) noexcept {
  if (probe == nullptr) return PH_NULL_ARGUMENT;
  probe->ball.reset();
  return PH_OK;
}

std::int32_t ph_probe_step(ph_probe* probe, const double position[3], double dt,
                           ph_probe_result* result) noexcept {
  if (result == nullptr || probe == nullptr) return PH_NULL_ARGUMENT;
  if (!known_size<ph_probe_result>(result->size, sizeof(ph_probe_result))) return PH_WRONG_SIZE;
  std::int32_t status = PH_NULL_ARGUMENT;
  auto& ball = probe->ball;
  if (position != nullptr) {
    const passive_haptics::mesh::triple x{position[0], position[1], position[2]};
    const bool is_one = is_finite(x) && dt > 0.0 && std::isfinite(dt);
    if (is_one) ball.step(x, dt);
    status = is_one ? PH_OK : PH_REFUSED_PARAMETER;
  }
  const auto write = [](double* to, const passive_haptics::mesh::triple& t) {
    for (int i = 0; i < 3; ++i) to[i] = t[i];
  };
  const auto& pressed = ball.pressed();
  const double depth = length(pressed.way);
  const auto is = ball.felt({.stiffness = 0.0, .friction = ball.parameters().friction});
  *result = {.size = sizeof(ph_probe_result),
             .placed = ball.placed(),
             .mesh = ball.nearest_mesh(),
             .triangle = ball.nearest(),
             .place = {},
             .normal = {},
             .depth = depth,
             .material = {is.stiffness, is.friction, is.viscosity}};
  write(result->place, ball.place());
  if (depth > 0.0) write(result->normal, ball.push() * (1.0 / depth));
  return status;
}

}  // extern "C"
