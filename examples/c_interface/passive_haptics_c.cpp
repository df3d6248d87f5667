// SPDX-License-Identifier: BSD-3-Clause
// The functions of the C interface: what is promised is said in its header, what a name is composed of in
// ports.hpp and the families beside it.
#include "ports.hpp"

#include <string_view>

namespace c_interface {
namespace {

// ------------------------------------------------------------------------------- named compositions

struct named_composition {
  std::string_view name;
  made (*make)(const ph_parameters&, facts) noexcept;
  facts of{};
  int latest = PH_MOST_LATENCY;
  bool knows_hand = true;
  [[nodiscard]] constexpr bool is(std::string_view other) const noexcept { return name == other; }
};
constexpr int strict_latest = PH_MOST_STRICT_LATENCY;
constexpr facts on_encoders{.encoder = true};
constexpr facts anybody{.any_hand = true};
constexpr facts anybody_on_encoders{.encoder = true, .any_hand = true};
constexpr std::array compositions{
    named_composition{"touch", make_touch},
    named_composition{"encoder_touch", make_touch, on_encoders},
    named_composition{"strict_touch", make_touch, anybody, strict_latest, false},
    named_composition{"strict_encoder_touch", make_touch, anybody_on_encoders, strict_latest,
                      false},
    named_composition{"contacts", make_contacts},
    named_composition{"encoder_contacts", make_contacts, on_encoders},
    named_composition{"strict_contacts", make_contacts, anybody, strict_latest, false},
    named_composition{"strict_encoder_contacts", make_contacts, anybody_on_encoders, strict_latest,
                      false},
    named_composition{"guard", make_guard},
    named_composition{"encoder_guard", make_guard, on_encoders},
    named_composition{"strict_guard", make_guard, anybody, strict_latest, false},
    named_composition{"strict_encoder_guard", make_guard, anybody_on_encoders, strict_latest,
                      false},
    named_composition{"stylus", make_stylus},
    named_composition{"tool", make_tool, {}, PH_MOST_TOOL_LATENCY},
    named_composition{"mesh_touch", make_mesh_touch},
    named_composition{"encoder_mesh_touch", make_mesh_touch, on_encoders},
    named_composition{"strict_mesh_touch", make_mesh_touch, anybody, strict_latest, false},
    named_composition{"strict_encoder_mesh_touch", make_mesh_touch, anybody_on_encoders,
                      strict_latest, false},
    named_composition{"mesh_tool", make_mesh_tool, {}, PH_MOST_TOOL_LATENCY},
    named_composition{"quantised_touch", make_quantised_touch, on_encoders, strict_latest},
    named_composition{"detents", make_detents},
    named_composition{"encoder_detents", make_detents, on_encoders},
    named_composition{"strict_detents", make_detents, anybody, strict_latest, false},
    named_composition{"strict_encoder_detents", make_detents, anybody_on_encoders, strict_latest,
                      false},
};

/// What is to be finite and above zero, or not below it, by its name in ph_parameters.
struct ranged {
  const char* name;
  double ph_parameters::*value;
  bool may_be_zero;
  const char* remedy;
};
constexpr ranged of_surfaces[]{
    {"turn_rate", &ph_parameters::turn_rate, true, "finite and ≥ 0 rad/s, 0 for the default"},
    {"static_friction", &ph_parameters::static_friction, true, "finite and ≥ 0"},
    {"kinetic_friction", &ph_parameters::kinetic_friction, true, "finite and ≥ 0"}};
constexpr ranged of_a_tool[]{
    {"damping", &ph_parameters::damping, false, "finite and > 0 N·s/m"},
    {"least_inertia", &ph_parameters::least_inertia, false, "finite and > 0 kg·m²"},
    {"inertia_spread", &ph_parameters::inertia_spread, true, "finite and ≥ 0 kg·m²"},
    {"inertia_offset", &ph_parameters::inertia_offset, true, "finite and ≥ 0 m"},
    {"angular_damping", &ph_parameters::angular_damping, false, "finite and > 0 N·m·s/rad"},
    {"damping_most", &ph_parameters::damping_most, false, "finite and > 0 N·s/m: an upper bound"},
    {"angular_damping_most", &ph_parameters::angular_damping_most, false,
     "finite and > 0 N·m·s/rad: an upper bound"},
    {"hand_torque", &ph_parameters::hand_torque, true, "finite and ≥ 0 N·m"},
    {"torque_limit", &ph_parameters::torque_limit, false, "finite and > 0 N·m"},
    {"lever", &ph_parameters::lever, true, "finite and > 0 m, 0 for 0.03"}};
constexpr ranged of_detents[]{
    {"pitch", &ph_parameters::pitch, true, "finite and > 0 m, where there are detents"},
    {"detent_stiffness", &ph_parameters::detent_stiffness, true, "finite and ≥ 0 N/m"},
    {"stop_stiffness", &ph_parameters::stop_stiffness, true, "finite and ≥ 0 N/m"}};

[[nodiscard]] ph::parameter_fault fault_in(const ph_parameters& p, const auto& ranges) noexcept {
  for (const ranged& r : ranges) {
    const double x = p.*r.value;
    if (!(r.may_be_zero ? ph::detail::not_negative(x) : ph::detail::positive(x))) {
      return {r.name, x, r.remedy};
    }
  }
  return {};
}

/// The same of detents and their stops.
[[nodiscard]] ph::parameter_fault fault_in_detents(const ph_parameters& p) noexcept {
  if (const auto wrong = fault_in(p, of_detents)) return wrong;
  if (p.detent_stiffness > 0.0 && p.pitch == 0.0) return {"pitch", p.pitch, of_detents[0].remedy};
  const bool none = p.first_stop == p.last_stop;
  if (!none && !(p.first_stop < p.last_stop)) {
    return {"last_stop", p.last_stop, "> first_stop, in m; the same where there is none"};
  }
  const bool ends = ph::kernels::is_finite(p.first_stop) || ph::kernels::is_finite(p.last_stop);
  if (!none && ends && p.stop_stiffness == 0.0) {
    return {"stop_stiffness", 0.0, "finite and > 0 N/m where there is a stop"};
  }
  return {};
}
/// True of a composition whose walls, or detents, the dry friction of the device has to pay for.
[[nodiscard]] bool rests_on_friction(const named_composition& chosen) noexcept {
  const auto make = chosen.make;
  return chosen.of.encoder && (make == make_touch || make == make_contacts ||
                               make == make_mesh_touch || make == make_detents);
}

/// The first parameter that is out of range by the names of ph_parameters. What this passes the
/// composition asks once more, by its own.
[[nodiscard]] ph::parameter_fault fault_in(const ph_parameters& p,
                                           const named_composition& chosen) noexcept {
  if (p.latency > static_cast<unsigned>(chosen.latest)) {
    return {"latency", static_cast<double>(p.latency),
            chosen.latest == PH_MOST_LATENCY ? "0 to 8 ticks"
            : chosen.latest == PH_MOST_TOOL_LATENCY
                ? "0 or 1 tick: a tool's bound is not proved later"
                : "0 to 2 ticks of what is strict or quantised"};
  }
  if (!chosen.of.encoder && p.quantum != 0.0) {
    return {"quantum", p.quantum,
            "0 here, where positions are taken as exact: what knows steps has encoder_ in its "
            "name, or is quantised_touch"};
  }
  ph::encoder_device device = encoder_device_of(p);
  if (chosen.is("quantised_touch")) {
    device.friction = 0.0;
    device.continuous_force = ph::loop_limits::never;
  }
  const auto fault = chosen.of.encoder ? device.check() : exact_device_of(p).check();
  if (fault) return fault;
  if (chosen.knows_hand && !ph::detail::positive(p.hand_force)) {
    return {"hand_force", p.hand_force, "finite and > 0 N: hand, load and dry friction together"};
  }
  if (!(p.stale_after >= 0.0)) return {"stale_after", p.stale_after, "≥ 0 s, 0 for the default"};
  if (!ph::detail::not_negative(p.renderer_period)) {
    return {"renderer_period", p.renderer_period, "finite and ≥ 0 s, 0 for a force in each tick"};
  }
  if (const auto wrong = fault_in(p, of_surfaces)) return wrong;
  if (p.kinetic_friction > p.static_friction) {
    return {"kinetic_friction", p.kinetic_friction, "no more than static_friction"};
  }
  if (chosen.make == make_tool || chosen.make == make_mesh_tool) {
    if (const auto wrong = fault_in(p, of_a_tool)) return wrong;
  }
  if (chosen.make == make_mesh_tool && (p.point_count < 1 || p.point_count > PH_TOOL_POINTS)) {
    return {"point_count", static_cast<double>(p.point_count), "1 to 8 points"};
  }
  if (chosen.make == make_detents) {
    if (const auto wrong = fault_in_detents(p)) return wrong;
  }
  if (rests_on_friction(chosen)) {
    const auto budget = ph::design::stiffness_budget(device);
    if (!(budget.stiffness > 0.0)) return {"friction", p.friction, budget.because()};
  }
  return ph::detail::fault_in(limits<0>(p));
}

/// What a port has been told for good, and is told otherwise.
[[nodiscard]] ph::parameter_fault change_in(const ph_parameters& was, const ph_parameters& is,
                                            const named_composition& chosen) noexcept {
  constexpr const char* fixed = "what ph_create was told: create another port";
  if (is.latency != was.latency) return {"latency", static_cast<double>(is.latency), fixed};
  if (is.rotary != was.rotary) return {"rotary", static_cast<double>(is.rotary), fixed};
  constexpr struct {
    const char* name;
    double ph_parameters::*value;
  } all[]{{"mass", &ph_parameters::mass},         {"damping", &ph_parameters::damping},
          {"friction", &ph_parameters::friction}, {"presliding", &ph_parameters::presliding},
          {"quantum", &ph_parameters::quantum},   {"longest_tick", &ph_parameters::longest_tick}};
  for (const auto& one : all) {
    if (!(is.*one.value == was.*one.value)) return {one.name, is.*one.value, fixed};
  }
  for (int i = 0; i < 3; ++i) {
    if (!(is.tip[i] == was.tip[i])) return {"tip", is.tip[i], fixed};
  }
  if (chosen.make != make_mesh_tool) return {};
  if (is.point_count != was.point_count) {
    return {"point_count", static_cast<double>(is.point_count), fixed};
  }
  for (std::uint32_t k = 0; k < is.point_count; ++k) {
    for (int i = 0; i < 3; ++i) {
      if (!(is.points[k][i] == was.points[k][i])) return {"points", is.points[k][i], fixed};
    }
  }
  return {};
}

// ------------------------------------------------------------------------------------------ surfaces

[[nodiscard]] plane plane_of(const ph_surface& s) noexcept {
  return {read(s.a), read(s.b), s.stiffness};
}
/// What is not a kind has no stiffness, and is refused.
[[nodiscard]] curved curved_of(const ph_surface& s) noexcept {
  const double K = s.stiffness;
  const vector a = read(s.a), b = read(s.b), c = read(s.c);
  curved made{.stiffness = K};
  switch (s.kind) {
    case PH_SPHERE:
      made.shape = ph::sphere<scene>{a, s.radius, K};
      break;
    case PH_CAVITY:
      made.shape = ph::sphere<scene>{a, s.radius, K, ph::felt_from::inside};
      break;
    case PH_QUADRIC:
      made.shape = ph::quadric<scene>{a,
                                      b,
                                      c,
                                      s.curvature[0],
                                      s.curvature[1],
                                      K,
                                      s.thickness,
                                      stated(s.reach, ph::quadric<scene>{}.reach)};
      break;
    case PH_CAPSULE:
      made.shape = ph::shell<ph::segment_core<scene>>{{a, b}, s.radius, K};
      break;
    case PH_BOX:
      made.shape = ph::shell<ph::box_core<scene>>{{a, read(s.half), b, c}, s.radius, K};
      break;
    case PH_PLATE:
      made.shape = ph::shell<ph::triangle_core<scene>>{{a, b, c}, s.radius, K};
      break;
    default:
      break;
  }
  return made;
}

/// Into a slot, and off.
template <class Surface>
std::int32_t tell(ph_port& port, told<Surface>* slot, const Surface& surface,
                  const double* at) noexcept {
  if (slot == nullptr) return PH_NO_SUCH_SLOT;
  const bool is_point = scene::is_finite(read(at));
  if (Surface tried = surface; !tried.prepare() || !is_point) return PH_REFUSED_SURFACE;
  *slot = {surface, read(at), slot->news + 1, true};
  port.send();
  return PH_OK;
}
void leave(auto* slot) noexcept {
  ++slot->news;
  slot->here = false;
}

// ------------------------------------------------------------------------------------ structs by size

constexpr std::size_t shortest_surface = sizeof(ph_surface);
constexpr std::size_t shortest_parameters = offsetof(ph_parameters, friction);
constexpr std::size_t shortest_result = offsetof(ph_result, limited);
static_assert(sizeof(ph_parameters) == 512 && shortest_parameters == 48);
static_assert(sizeof(ph_surface) == 176);
static_assert(sizeof(ph_explanation) == 48 || sizeof(void*) != 8);
static_assert(sizeof(ph_result) == 80 && shortest_result == 48);

/// What the caller's struct says; zero, "not stated", where it ends.
[[nodiscard]] ph_parameters whole(const ph_parameters& given) noexcept {
  ph_parameters own{};
  std::memcpy(&own, &given, given.size);
  return own;
}
[[nodiscard]] bool writable(const ph_result* result) noexcept {
  return result != nullptr && known_size<ph_result>(result->size, shortest_result);
}
/// Has `fill` write to the caller's struct as far as it goes.
void write(ph_result& result, const auto& fill) noexcept {
  if (result.size == sizeof(ph_result)) [[likely]] {
    fill(result);
    return;
  }
  ph_result own{};
  own.size = result.size;
  fill(own);
  std::memcpy(&result, &own, own.size);
}

/// One tick of a composition that takes what `by` says; of any other it is a sample that was lost. A copy of `now`
/// would read in one piece what was just written in parts, which is dear.
std::int32_t tick(ph_port* port, const moment& now, takes by, ph_result* result) noexcept {
  if (result == nullptr) return PH_NULL_ARGUMENT;
  if (!writable(result)) return PH_WRONG_SIZE;
  if (port == nullptr) {
    write(*result, [](ph_result& out) {
      const std::uint32_t size = out.size;
      out = {};
      out.size = size;
      out.event = PH_REJECTED_PARAMETERS;
    });
    return PH_NULL_ARGUMENT;
  }
  std::int32_t status = PH_OK;
  if (now.position == nullptr || (by == takes::forces && now.wanted == nullptr) ||
      (by == takes::poses && now.orientation == nullptr)) {
    status = PH_NULL_ARGUMENT;
  } else if (by != port->takes && (by != takes::planes || port->takes == takes::poses)) {
    status = PH_NOT_OF_THIS_COMPOSITION;
  }
  const moment lost{.dt = now.dt};
  const moment& taken = status == PH_OK ? now : lost;
  write(*result, [&](ph_result& out) { port->tick(taken, out); });
  return status;
}

// The numbers are the library's.
constexpr bool same(ph_event ours, ph::event theirs) noexcept {
  return static_cast<int>(ours) == static_cast<int>(theirs);
}
static_assert(same(PH_NOMINAL, ph::event::nominal) && same(PH_DEBT, ph::event::debt) &&
              same(PH_LATE_TICK, ph::event::late_tick) &&
              same(PH_REPEATED_SAMPLE, ph::event::repeated_sample) &&
              same(PH_NO_TARGET, ph::event::no_target) &&
              same(PH_REJECTED_TARGET, ph::event::rejected_target) &&
              same(PH_STALE_TARGET, ph::event::stale_target) &&
              same(PH_OUTSIDE_WORKSPACE, ph::event::outside_workspace) &&
              same(PH_REJECTED_SAMPLE, ph::event::rejected_sample) &&
              same(PH_REJECTED_PARAMETERS, ph::event::rejected_parameters) &&
              same(PH_OUTSIDE_FORCE, ph::event::outside_force) &&
              same(PH_UNTOLD_LATENCY, ph::event::untold_latency) &&
              same(PH_WRONG_SIGN, ph::event::wrong_sign) &&
              same(PH_STARTED_INSIDE, ph::event::started_inside) &&
              same(PH_FORCES_OFF, ph::event::forces_off) &&
              same(PH_WALL_LOST, ph::event::wall_lost) && same(PH_WALL_BACK, ph::event::wall_back));
static_assert(PH_NONE == static_cast<int>(ph::guarantee::none) &&
              PH_CONDITIONAL == static_cast<int>(ph::guarantee::conditional) &&
              PH_STRICT == static_cast<int>(ph::guarantee::strict));

}  // namespace
}  // namespace c_interface

using namespace c_interface;  // NOLINT(google-build-using-namespace): the functions of the header

extern "C" {

std::uint32_t ph_version() noexcept {
  return 10000 * ph::version_major + 100 * ph::version_minor + ph::version_patch;
}

std::int32_t ph_create(const char* composition, const ph_parameters* parameters, ph_port** port,
                       char* why, std::size_t room) noexcept {
  const text reason(why, room);
  if (port != nullptr) *port = nullptr;
  if (composition == nullptr || parameters == nullptr || port == nullptr) {
    reason.say("ph_create: %s is NULL", composition == nullptr  ? "composition"
                                        : parameters == nullptr ? "parameters"
                                                                : "port");
    return PH_NULL_ARGUMENT;
  }
  if (!known_size<ph_parameters>(parameters->size, shortest_parameters)) {
    return refuse_size<ph_parameters>(reason, "ph_parameters", parameters->size);
  }
  const auto* const chosen =
      std::find_if(compositions.begin(), compositions.end(),
                   [composition](const auto& c) { return c.is(composition); });
  if (chosen == compositions.end()) {
    std::array<char, 440> names{};
    std::size_t end = 0;
    for (const auto& known : compositions) {
      end += static_cast<std::size_t>(std::snprintf(names.data() + end, names.size() - end, "%s%s",
                                                    end > 0 ? ", " : "", known.name.data()));
    }
    reason.say("composition = \"%.36s\" is refused: one of %s", composition, names.data());
    return PH_UNKNOWN_COMPOSITION;
  }
  const ph_parameters own = whole(*parameters);
  if (const auto fault = fault_in(own, *chosen)) return refuse(reason, fault);
  made one = chosen->make(own, chosen->of);
  if (!one) {
    reason.say("%s", "ph_create: no memory for a port");
    return PH_OUT_OF_MEMORY;
  }
  if (const auto fault = one->check()) return refuse(reason, fault);
  one->composition = chosen;
  *port = one.release();
  return PH_OK;
}

void ph_destroy(ph_port* port) noexcept {
  delete port;
}

std::int32_t ph_guarantee_of(const ph_port* port) noexcept {
  return port != nullptr ? static_cast<std::int32_t>(port->promise()) : std::int32_t{PH_NONE};
}

std::int32_t ph_publish(ph_port* port, std::uint32_t slot, const ph_surface* surface) noexcept {
  if (port == nullptr || surface == nullptr) return PH_NULL_ARGUMENT;
  if (!known_size<ph_surface>(surface->size, shortest_surface)) return PH_WRONG_SIZE;
  if (!port->has_slots()) return PH_NOT_OF_THIS_COMPOSITION;
  if (surface->kind == PH_PLANE) {
    return tell(*port, port->plane_slot(slot), plane_of(*surface), surface->at);
  }
  if (surface->kind > PH_PLATE) return PH_REFUSED_SURFACE;
  return tell(*port, port->curved_slot(slot), curved_of(*surface), surface->at);
}

std::int32_t ph_publish_plane(ph_port* port, const double point[3], const double normal[3],
                              double stiffness) noexcept {
  if (port == nullptr || point == nullptr || normal == nullptr) return PH_NULL_ARGUMENT;
  if (!port->has_slots()) return PH_NOT_OF_THIS_COMPOSITION;
  constexpr double here[3]{};
  return tell(*port, port->plane_slot(0), plane{read(point), read(normal), stiffness}, here);
}

std::int32_t ph_release(ph_port* port, std::uint32_t slot, std::uint32_t kind) noexcept {
  if (port == nullptr) return PH_NULL_ARGUMENT;
  if (!port->has_slots()) return PH_NOT_OF_THIS_COMPOSITION;
  if (kind > PH_PLATE) return PH_REFUSED_SURFACE;
  const auto release = [port](auto* one) {
    if (one == nullptr) return std::int32_t{PH_NO_SUCH_SLOT};
    leave(one);
    port->send();
    return std::int32_t{PH_OK};
  };
  return kind == PH_PLANE ? release(port->plane_slot(slot)) : release(port->curved_slot(slot));
}

std::int32_t ph_publish_nothing(ph_port* port) noexcept {
  if (port == nullptr) return PH_NULL_ARGUMENT;
  if (!port->has_slots()) return PH_NOT_OF_THIS_COMPOSITION;
  for (std::uint32_t i = 0; auto* one = port->plane_slot(i); ++i) leave(one);
  for (std::uint32_t i = 0; auto* one = port->curved_slot(i); ++i) leave(one);
  port->send();
  return PH_OK;
}

std::int32_t ph_tick(ph_port* port, const double position[3], double dt,
                     ph_result* result) noexcept {
  return tick(port, {.position = position, .dt = dt}, takes::planes, result);
}

std::int32_t ph_tick_wanted(ph_port* port, const double position[3], double dt,
                            const double wanted[3], ph_result* result) noexcept {
  return tick(port, {.position = position, .dt = dt, .wanted = wanted}, takes::forces, result);
}

std::int32_t ph_tick_pose(ph_port* port, const double position[3], const double orientation[4],
                          double dt, ph_result* result) noexcept {
  return tick(port, {.position = position, .orientation = orientation, .dt = dt}, takes::poses,
              result);
}

std::int32_t ph_held(ph_port* port, const double force[3]) noexcept {
  if (port == nullptr || force == nullptr) return PH_NULL_ARGUMENT;
  if (port->has_torque) return PH_NOT_OF_THIS_COMPOSITION;
  port->held = {force[0], force[1], force[2]};
  return PH_OK;
}

std::int32_t ph_held_wrench(ph_port* port, const double force[3], const double torque[3]) noexcept {
  if (port == nullptr || force == nullptr || torque == nullptr) return PH_NULL_ARGUMENT;
  if (!port->has_torque) return PH_NOT_OF_THIS_COMPOSITION;
  port->held = {force[0], force[1], force[2], torque[0], torque[1], torque[2]};
  return PH_OK;
}

std::int32_t ph_set(ph_port* port, const ph_parameters* parameters, char* why,
                    std::size_t room) noexcept {
  const text reason(why, room);
  if (port == nullptr || parameters == nullptr) {
    reason.say("ph_set: %s is NULL", port == nullptr ? "port" : "parameters");
    return PH_NULL_ARGUMENT;
  }
  if (!known_size<ph_parameters>(parameters->size, shortest_parameters)) {
    return refuse_size<ph_parameters>(reason, "ph_parameters", parameters->size);
  }
  const ph_parameters own = whole(*parameters);
  const auto& chosen = *static_cast<const named_composition*>(port->composition);
  if (const auto fault = fault_in(own, chosen)) return refuse(reason, fault);
  if (const auto fault = change_in(port->stated, own, chosen)) return refuse(reason, fault);
  if (const auto fault = port->set(own)) return refuse(reason, fault);
  return PH_OK;
}

std::int32_t ph_reset(ph_port* port) noexcept {
  if (port == nullptr) return PH_NULL_ARGUMENT;
  port->reset();
  return PH_OK;
}

std::int32_t ph_enable_forces(ph_port* port, std::int32_t on) noexcept {
  if (port == nullptr) return PH_NULL_ARGUMENT;
  port->enable_forces(on != 0);
  return PH_OK;
}

std::int32_t ph_explain(const ph_port* port, ph_explanation* explanation) noexcept {
  if (port == nullptr || explanation == nullptr) return PH_NULL_ARGUMENT;
  if (explanation->size != sizeof(ph_explanation)) return PH_WRONG_SIZE;
  const ph::explanation e = port->explain();
  *explanation = {.size = sizeof(ph_explanation),
                  .now = e.now != ph::softened_by::nothing,
                  .asked = e.asked,
                  .shown = e.shown,
                  .depth = e.depth,
                  .force = e.force,
                  .because = e.because()};
  return PH_OK;
}

std::int32_t ph_stiffness_budget(const ph_parameters* parameters, double* stiffness,
                                 const char** because) noexcept {
  if (parameters == nullptr || stiffness == nullptr) return PH_NULL_ARGUMENT;
  *stiffness = 0.0;
  if (because != nullptr) *because = "";
  if (!known_size<ph_parameters>(parameters->size, shortest_parameters)) return PH_WRONG_SIZE;
  const auto device = encoder_device_of(whole(*parameters));
  const auto budget = ph::design::stiffness_budget(device);
  *stiffness = budget.stiffness;
  if (because != nullptr) *because = budget.because();
  return device.check() ? PH_REFUSED_PARAMETER : PH_OK;
}

const char* ph_event_text(std::int32_t event) noexcept {
  const bool is_one = event >= 0 && event <= static_cast<std::int32_t>(PH_WALL_BACK);
  return is_one ? ph::to_string(static_cast<ph::event>(event)) : "unknown event";
}

const char* ph_status_text(std::int32_t status) noexcept {
  switch (status) {
    case PH_OK:
      return "ok";
    case PH_NULL_ARGUMENT:
      return "a pointer that must not be NULL is";
    case PH_WRONG_SIZE:
      return "size is no size of this struct that the library knows";
    case PH_UNKNOWN_COMPOSITION:
      return "no composition has this name";
    case PH_REFUSED_PARAMETER:
      return "a parameter is out of its range";
    case PH_OUT_OF_MEMORY:
      return "out of memory";
    case PH_NOT_OF_THIS_COMPOSITION:
      return "surfaces are for touch, contacts, stylus and tool, meshes for mesh_touch and "
             "mesh_tool, wanted forces for a guard, poses for stylus, tool and mesh_tool";
    case PH_REFUSED_SURFACE:
      return "the surface has a number that is none, no normal, no stiffness > 0, or no such kind";
    case PH_NO_SUCH_SLOT:
      return "there is no slot of this number for this kind";
    case PH_REFUSED_MESH:
      return "the mesh, or where it goes, has a number that is none, or is no mesh";
    case PH_NO_PLACE:
      return "the mesh is touched already, or eight others are, or 64 touch it";
    default:
      return "unknown status";
  }
}

}  // extern "C"
