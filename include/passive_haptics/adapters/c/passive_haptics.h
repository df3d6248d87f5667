// SPDX-License-Identifier: BSD-3-Clause
#ifndef PASSIVE_HAPTICS_ADAPTERS_C_PASSIVE_HAPTICS_H
#define PASSIVE_HAPTICS_ADAPTERS_C_PASSIVE_HAPTICS_H
// The C interface: for C99, C#, Unity, Unreal and whatever else calls a shared library. A port with three or
// six degrees of freedom, or a knob, in double, composed by name. Link passive_haptics_c, or load it.
//
//     ph_parameters device = {.size = sizeof device, .mass = 0.1, .damping = 0.03, .hand_force = 5,
//                             .force_limit = 9, .longest_tick = 1e-3};
//     char why[PH_TEXT_ROOM];
//     ph_port* port = NULL;
//     if (ph_create("touch", &device, &port, why, sizeof why) != PH_OK) return complain(why);
//     ph_publish_plane(port, point, normal, 1e4);             // slow thread, 20-100 Hz
//     ph_result out = {.size = sizeof out};
//     ph_tick(port, position, dt, &out);                      // haptic thread, 1 kHz
//     command(out.force);
//
// ONE PORT PER DEVICE. Two ports on one device are two ledgers that spend the same damping, so the hand would gain
// energy.
//
// SI units. The force acts on the device; a normal points out of the object; energy is positive from the
// hand into the device. Vectors are three doubles: x, y, z.
//
// No function throws. Memory is taken and given back by ph_create, ph_destroy, ph_mesh_create, ph_mesh_update,
// ph_mesh_set_materials, ph_mesh_doubt, ph_mesh_destroy, ph_probe_create and ph_probe_destroy only, and given back by
// ph_mesh_let_go and ph_probe_let_go where they were the last to hold a mesh. Wherever a result is written, the port has
// ticked, and the force in it is what must be commanded: zero, with an event, if anything was wrong. Where no result can
// be written (NULL, a wrong size) the port has not ticked.
//
// A pointer that is not NULL must point to an object of its type, which lives as long as the call. A ph_port* is
// valid from the ph_create that wrote it until its first ph_destroy, and so are a ph_mesh* and a ph_probe*. Any later
// use, a second ph_destroy included, is undefined behaviour and not detected: set your pointer to NULL then, because
// every function accepts NULL.
//
// Threads: call ph_publish* and ph_release of a port in one thread, and ph_tick*, ph_held*, ph_set, ph_reset,
// ph_enable_forces, ph_explain, ph_mesh_touch and ph_mesh_let_go in one thread, the same or another. Two threads in one
// of these groups at the same time, or ph_destroy while a thread is in any function, are a data race and undefined; a
// debug build of the library stops if two threads tick. ph_guarantee_of is for any thread, and different ports share
// nothing but the meshes that they touch. Call ph_mesh_update, _move, _set_materials and _doubt of a mesh in one
// thread, whichever threads touch it, and all functions of a probe in one thread.
//
// Before 1.0 a minor version may change this interface, as it may the library's.

#include <stddef.h>
#include <stdint.h>

// Define PASSIVE_HAPTICS_C_STATIC where you link the static library.
#if defined(_WIN32) && defined(PASSIVE_HAPTICS_C_BUILD)
#define PH_API __declspec(dllexport)
#elif defined(_WIN32) && !defined(PASSIVE_HAPTICS_C_STATIC)
#define PH_API __declspec(dllimport)
#elif defined(__GNUC__)
#define PH_API __attribute__((visibility("default")))
#else
#define PH_API
#endif

#ifdef __cplusplus
#define PH_NOTHROW noexcept
extern "C" {
#else
#define PH_NOTHROW
#endif

/// Room for every text that ph_create writes [bytes].
#define PH_TEXT_ROOM 512
/// The largest ph_parameters::latency [ticks]; that of the strict compositions and quantised_touch; that of a tool.
#define PH_MOST_LATENCY 8
#define PH_MOST_STRICT_LATENCY 2
#define PH_MOST_TOOL_LATENCY 1
/// The slots of contacts and of a stylus: the number for planes, and the number for curved surfaces.
#define PH_PLANES 4
#define PH_CURVED 4
/// The same of a tool.
#define PH_TOOL_PLANES 16
#define PH_TOOL_CURVED 4
/// The most points of a mesh_tool.
#define PH_TOOL_POINTS 8

/// The most meshes that a port or a probe touches at a time, and the most ports and probes that touch one mesh, a
/// mesh_tool as often as it has points.
#define PH_MESHES 8
#define PH_MOST_FINGERS 64

/// One passive port with its ledger, and an inbox for published surfaces.
typedef struct ph_port ph_port;
/// Triangles that ports and probes touch while another thread moves them.
typedef struct ph_mesh ph_mesh;
/// A ball that is drawn to the device and that no triangle lets through: a renderer's proxy, without a port.
typedef struct ph_probe ph_probe;

/// The status that a function returns.
enum ph_status {
  PH_OK = 0,
  PH_NULL_ARGUMENT = 1,            ///< a pointer is NULL that must not be
  PH_WRONG_SIZE = 2,               ///< the library knows no version of this struct of this `size`
  PH_UNKNOWN_COMPOSITION = 3,      ///< the name is none of those of ph_create
  PH_REFUSED_PARAMETER = 4,        ///< the text has the parameter, its value and the remedy
  PH_OUT_OF_MEMORY = 5,            ///< there is no memory for the port
  PH_NOT_OF_THIS_COMPOSITION = 6,  ///< a surface for a guard, a wanted force for a touch
  PH_REFUSED_SURFACE = 7,          ///< a number not finite, a normal of length 0, a stiffness ≤ 0
  PH_NO_SUCH_SLOT = 8,             ///< the composition has no slot of this number for this kind
  PH_REFUSED_MESH = 9,             ///< the text has what is wrong with the mesh and the remedy
  PH_NO_PLACE = 10  ///< the mesh is touched already, or PH_MESHES others, or by PH_MOST_FINGERS
};

/// The kind of a surface, and the members of ph_surface that define it.
enum ph_surface_kind {
  PH_PLANE = 0,    ///< a: a point, b: the outward normal
  PH_SPHERE = 1,   ///< a: the centre, radius
  PH_CAVITY = 2,   ///< centre and radius of a ball that is touched from inside
  PH_QUADRIC = 3,  ///< a: a point, b: the normal there, c: a tangent, curvature, thickness, reach
  PH_CAPSULE = 4,  ///< a and b: the ends of its axis, radius
  PH_BOX = 5,      ///< a: the centre, b and c: its first and second axis, half, radius
  PH_PLATE = 6     ///< a, b and c: the corners of a triangle, radius
};

/// The event of a tick, in order of rising severity; a tick reports the worst.
enum ph_event {
  PH_NOMINAL = 0,    ///< all is well
  PH_DEBT = 1,       ///< the ledger is negative: the hand has gained more energy than it paid in
  PH_LATE_TICK = 2,  ///< dt is longer than longest_tick, which the bound assumes
  PH_REPEATED_SAMPLE = 3,    ///< the sensor is slower than the loop (not detected here)
  PH_NO_TARGET = 4,          ///< no surface or wanted force was given yet: force zero
  PH_REJECTED_TARGET = 5,    ///< the wanted force is unusable: the last valid one is kept
  PH_STALE_TARGET = 6,       ///< nothing valid was published for too long: the force fades
  PH_OUTSIDE_WORKSPACE = 7,  ///< the position is too far out, perhaps in mm: force zero
  PH_REJECTED_SAMPLE = 8,  ///< lost, NaN, dt ≤ 0, an impossible jump: force zero, credit forfeited
  PH_REJECTED_PARAMETERS = 9,  ///< there is no port: force zero
  PH_OUTSIDE_FORCE = 10,   ///< it moves faster than the stated mass and hand allow: a strict bound
  PH_UNTOLD_LATENCY = 11,  ///< it holds a force later or sooner than stated: force zero
  PH_WRONG_SIGN = 12,      ///< it moves against the command: force zero until ph_reset
  PH_STARTED_INSIDE = 13,  ///< a surface must push, and no energy is paid in yet: force zero
  PH_FORCES_OFF = 14,      ///< the forces are off: force zero, and the ledger pauses
  PH_WALL_LOST = 15,       ///< a fault has emptied the ledger: for a while less force than wanted
  PH_WALL_BACK = 16        ///< the energy is paid back: the first tick that is not PH_WALL_LOST
};

/// The guarantee of passivity of a composition, as in the library.
enum ph_guarantee {
  PH_NONE = 0,
  PH_CONDITIONAL = 1,  ///< for the device and the hand as stated
  PH_STRICT = 2        ///< for every motion, every environment, every schedule of updates
};

/// The device and the hand on it: lower bounds of mass, damping and friction, upper bounds of the rest. Zero means "not
/// stated": it stands for the default if there is one, and is refused if the composition needs the number.
typedef struct ph_parameters {
  uint32_t size;        ///< sizeof(ph_parameters); a struct may end after longest_tick
  uint32_t latency;     ///< whole ticks from a command to the first instant it is held: PH_MOST_…
  double mass;          ///< smallest apparent mass, over all directions and poses [kg]
  double damping;       ///< b, lower bound, by identify for example [N·s/m]
  double hand_force;    ///< largest force of hand, load and dry friction together [N]
  double force_limit;   ///< largest force of the motors [N]
  double longest_tick;  ///< the worst tick of YOUR loop [s]

  double friction;          ///< dry, the least level where it varies [N]
  double presliding;        ///< length over which friction is elastic [m], > 0 with friction
  double quantum;           ///< step of the positions, noise included [m]
  double continuous_force;  ///< force that the motors hold without time limit [N]; 0: force_limit
  double winding_time;      ///< time constant of their warming [s], if continuous_force is less
  double turn_rate;         ///< largest rate at which the normal turns to a new one [rad/s]; 0: 2
  double
      stale_after;  ///< age up to which an update is used in full [s]; 0: ∞ for planes, 0.1 for forces
  double top_speed;  ///< a speed above it is a sensor fault [m/s]; 0: 5
  double workspace;  ///< radius about the origin outside of which positions are refused [m]; 0: 2
  double watchdog;   ///< time after which the driver drops a command [s]; 0: never

  double static_friction;   ///< of the surfaces of contacts, stylus and tool; 0: none
  double kinetic_friction;  ///< ≤ static_friction; 0: the same
  double tip[3];            ///< of a stylus: from the gimbal to its tip, in its frame [m]

  // The following members are for a tool and a mesh_tool, which turn.
  double least_inertia;    ///< smallest moment about the centre of mass, from below [kg·m²]
  double inertia_spread;   ///< between the largest moment and the smallest, from above [kg·m²]
  double inertia_offset;   ///< from the handle to the centre of mass, from above [m]
  double angular_damping;  ///< from below [N·m·s/rad]
  double damping_most;     ///< from above [N·s/m]
  double angular_damping_most;  ///< from above [N·m·s/rad]
  double hand_torque;           ///< largest torque of the hand [N·m]
  double torque_limit;          ///< largest torque of the motors [N·m]
  double lever;                 ///< a length of the tool [m]; 0: 0.03

  // The following members, and static_friction, are for a mesh, and count where the mesh states no material.
  double stiffness;  ///< of the mesh [N/m]; 0: 1000
  double viscosity;  ///< along the surface [N·s/m]; 0: none
  double radius;     ///< of the ball that touches [m]; 0: 5e-4

  // The following members are for detents, of a knob or a slider.
  double pitch;             ///< distance of neighbouring detents [m]; a knob: [rad]
  double detent_stiffness;  ///< at the bottom of each [N/m]; 0: no detents
  double first_stop;        ///< the lower end stop [m]; −∞: none; both the same: none
  double last_stop;         ///< the upper end stop [m]; ∞: none
  double stop_stiffness;    ///< of both [N/m], > 0 where there is one
  uint32_t rotary;  ///< not 0: it turns, and all numbers are kg·m², N·m and rad, of a knob

  // The following members are for a mesh_tool.
  uint32_t point_count;              ///< 1 to PH_TOOL_POINTS
  double points[PH_TOOL_POINTS][3];  ///< what touches, in the frame of the handle [m]

  double renderer_period;  ///< of a guard, longest time between two new forces [s]; 0: a tick
} ph_parameters;

/// A surface of the environment. Members that its kind does not use are ignored.
typedef struct ph_surface {
  uint32_t size;            ///< sizeof(ph_surface)
  uint32_t kind;            ///< a ph_surface_kind
  double stiffness;         ///< > 0 [N/m]
  double a[3], b[3], c[3];  ///< points [m] or directions of any length: see ph_surface_kind
  double radius;            ///< > 0 [m]: of capsule, box and plate, that of their rounding
  double half[3];           ///< half the edges of the box that is rounded, along its axes [m]
  double curvature[2];      ///< of a quadric along c and across it, > 0 where it bulges [1/m]
  double thickness;         ///< deepest contact of a quadric, times either curvature < 1 [m]
  double reach;             ///< how far from a the quadric goes [m]; 0: without end
  double at[3];  ///< the point of a tool that may touch it, in the frame of the handle [m]
} ph_surface;

/// The result of a tick.
typedef struct ph_result {
  uint32_t size;    ///< sizeof(ph_result), set by the caller; it may end after energy
  int32_t event;    ///< a ph_event
  double force[3];  ///< force to command [N]
  double depth;     ///< penetration in the local model, 0 outside and in a guard [m]
  double energy;    ///< E1, the ledger [J]
  int32_t limited;  ///< not 0: the bound has changed the force that contact, or caller, asked for
  int32_t
      capped;  ///< not 0: the plane is shown softer, because the device cannot pay for its stiffness
  double torque[3];  ///< for a tool or a mesh_tool, about its handle [N·m]; else 0
} ph_result;

/// The stiffness that a surface is shown with, and the reason why it is not higher.
typedef struct ph_explanation {
  uint32_t size;  ///< sizeof(ph_explanation), set by the caller
  int32_t now;    ///< not 0: `force` is less than `shown` times `depth`; `because` has the reason
  double asked;   ///< stiffness of the plane [N/m]; infinite for a guard, which does not know it
  double shown;   ///< stiffness that is shown at rest, as long as the motors hold it [N/m]
  double depth;   ///< of the device in the plane, at the last tick [m]; 0 outside, and in a guard
  double force;   ///< commanded last [N]
  const char* because;  ///< the bound and the remedy, in English, in static memory
} ph_explanation;

/// A mesh. It may be open, inside out, or cross itself: no side is the outside. All arrays are copied.
typedef struct ph_mesh_data {
  uint32_t size;             ///< sizeof(ph_mesh_data)
  uint32_t vertex_count;     ///< ≤ 2³¹ − 1
  uint32_t triangle_count;   ///< 1 to 50 million
  uint32_t material_count;   ///< 0 to 256; 0: whoever touches the mesh states one
  const double* vertices;    ///< x, y, z of each [m]
  const int32_t* triangles;  ///< the three vertices of each, counted from 0
  const double* materials;   ///< stiffness [N/m], friction, viscosity [N·s/m] of each
  const uint8_t*
      material_of;  ///< the number of each triangle's material; NULL: all are of the first
  double crease;    ///< edges that turn by less than this are rounded [rad], to 1.2; 0: none is
} ph_mesh_data;

/// A probe. Zero in a member stands for its default.
typedef struct ph_probe_parameters {
  uint32_t size;       ///< sizeof(ph_probe_parameters)
  uint32_t reserved;   ///< 0
  double radius;       ///< of the ball [m]; 0: 5e-4
  double friction;     ///< of triangles whose mesh states none
  double news_speed;   ///< at which news are followed, if they need no more [m/s]; 0: 0.05
  double longest_way;  ///< news that are not steady are followed in this at most [s]; 0: 0.05
} ph_probe_parameters;

/// The result of a step of a probe. A renderer's force is its stiffness times depth, along normal.
typedef struct ph_probe_result {
  uint32_t size;  ///< sizeof(ph_probe_result), set by the caller
  int32_t
      placed;  ///< 0 until the device has been clear of the meshes once: until then nothing is touched
  int32_t mesh;      ///< the mesh that is closest, in the order of touching
  int32_t triangle;  ///< its triangle that is closest; −1: there is none
  double place[3];   ///< the centre of the ball [m]
  double
      normal[3];  ///< the direction in which the mesh holds the ball off; 0 where nothing presses
  double depth;   ///< how far it is held off [m]; 0 where nothing presses
  double material
      [3];  ///< stiffness, friction and viscosity of what presses; stiffness 0 where it is not stated
} ph_probe_result;

/// The version of the library that is loaded: 10000 major + 100 minor + patch.
PH_API uint32_t ph_version(void) PH_NOTHROW;

/// Composes a port by name. `*port` is NULL unless the answer is PH_OK. The reason, with the parameter,
/// its value and the remedy, goes to `why` as UTF-8 text of at most `room` bytes, its zero included; it is
/// empty if all is well, and NULL asks for none.
///
///   name                                  the library's                            takes, of the device
///   "touch", "contacts", "guard"            make_touch, make_contacts, make_guard    exact_device
///   "encoder_touch", "encoder_contacts", "encoder_guard"                             encoder_device
///   "strict_touch", "strict_contacts", "strict_guard", "strict_encoder_touch", "strict_encoder_contacts",
///   "strict_encoder_guard"                  those after any_hand                     as above
///   "stylus"                                make_contacts, at the tip of a stylus    exact_device, tip
///   "tool"                                  make_tool                                rigid_device
///   "mesh_touch", "strict_mesh_touch"       make_mesh_touch                          exact_device
///   "encoder_mesh_touch", "strict_encoder_mesh_touch"                                encoder_device
///   "mesh_tool"                             make_mesh_tool                           rigid_device, points
///   "quantised_touch"                       a touch on steps, friction not known     exact_device, quantum
///   "detents", "encoder_detents", "strict_detents", "strict_encoder_detents"
///                                           make_detents, in one degree of freedom   as "guard", and detents
///
/// exact_device is mass, damping, force_limit, longest_tick; encoder_device that, and friction, presliding, quantum,
/// continuous_force, winding_time; rigid_device mass, damping, force_limit, longest_tick, and the members for a tool.
/// The strict ones guarantee PH_STRICT, and are soft while the ledger is empty. All others take hand_force, and guarantee
/// PH_CONDITIONAL. A touch has one plane; contacts, stylus and tool have the surfaces in their slots; mesh_touch
/// and mesh_tool have meshes. A guard bounds a force of the caller, and damps the oscillations of a renderer. A
/// composition for exact positions refuses a `quantum`. Parameters that a composition does not take are ignored.
PH_API int32_t ph_create(const char* composition, const ph_parameters* parameters, ph_port** port,
                         char* why, size_t room) PH_NOTHROW;
/// Destroys a port. No other function may use it at the same time or later. NULL does nothing.
PH_API void ph_destroy(ph_port* port) PH_NOTHROW;
/// A ph_guarantee; PH_NONE for NULL.
PH_API int32_t ph_guarantee_of(const ph_port* port) PH_NOTHROW;

/// Publishes a surface in a slot. Slots of planes and of curved surfaces are each counted from 0; a touch has one, for a
/// plane. It is wait-free, from ONE thread, which may differ from that of the ticks. If a surface is refused, the last
/// valid one stays; a guard returns PH_NOT_OF_THIS_COMPOSITION.
PH_API int32_t ph_publish(ph_port* port, uint32_t slot, const ph_surface* surface) PH_NOTHROW;
/// The plane of slot 0: all x with (point − x)·normal ≥ 0 are inside. `normal` has any length but zero; `stiffness` in
/// N/m.
PH_API int32_t ph_publish_plane(ph_port* port, const double point[3], const double normal[3],
                                double stiffness) PH_NOTHROW;
/// Empties that slot of this kind, so that the contact recedes. Call it in the thread of ph_publish.
PH_API int32_t ph_release(ph_port* port, uint32_t slot, uint32_t kind) PH_NOTHROW;
/// Empties all slots; the force of a touch fades within 50 ms. Call it in the same thread.
PH_API int32_t ph_publish_nothing(ph_port* port) PH_NOTHROW;

/// One tick: the device is at `position` [m], `dt` [s] after the last tick, both measured. Call it in ONE thread. A
/// position that is NULL or not finite is a lost sample. A guard keeps its last wanted force, which grows older. Of
/// detents only position[0] is read, and force[0] is their force; the others are ignored, and 0.
PH_API int32_t ph_tick(ph_port* port, const double position[3], double dt,
                       ph_result* result) PH_NOTHROW;
/// The same for a guard, with the force that is wanted in this tick [N]. A force that is not finite is refused, and the
/// last valid one stays. For a touch, or with NULL, the sample is lost.
PH_API int32_t ph_tick_wanted(ph_port* port, const double position[3], double dt,
                              const double wanted[3], ph_result* result) PH_NOTHROW;
/// The same for a stylus, a tool and a mesh_tool, which turn: the pose of the gimbal, or of the handle, with
/// `orientation` the unit quaternion w, x, y, z that turns its frame into the world's. The two functions above are a
/// lost sample for these, and this one is a lost sample for all others.
PH_API int32_t ph_tick_pose(ph_port* port, const double position[3], const double orientation[4],
                            double dt, ph_result* result) PH_NOTHROW;
/// States before a tick the force that the device has held until then [N], if that was not the force commanded
/// `latency` ticks ago: motors that saturate, gravity compensation. It applies to that tick only. Call it in the
/// thread of the ticks. A force that is not finite makes the sample a lost one.
PH_API int32_t ph_held(ph_port* port, const double force[3]) PH_NOTHROW;
/// The same for a tool and a mesh_tool, which take only this one: force [N] and torque [N·m] about its handle.
PH_API int32_t ph_held_wrench(ph_port* port, const double force[3],
                              const double torque[3]) PH_NOTHROW;

/// Changes parameters of a port; its ledger and all other state stay. Those of the device must be equal to those of
/// ph_create: latency, rotary, mass, damping, friction, presliding, quantum, longest_tick, tip, points. A refusal
/// changes nothing, and its text has the first parameter that differs or is out of its range. Call it in the thread of
/// the ticks, but not in every tick.
PH_API int32_t ph_set(ph_port* port, const ph_parameters* parameters, char* why,
                      size_t room) PH_NOTHROW;
/// Resets all but the parameters, for a device that is at rest, also after an event that has ended the force. Published
/// surfaces are forgotten until they are published again. Call it in the thread of the ticks.
PH_API int32_t ph_reset(ph_port* port) PH_NOTHROW;
/// Reports that the driver has switched the forces off (0) or on (not 0). In between ticks return PH_FORCES_OFF and force
/// zero, and the ledger pauses. Call it in the thread of the ticks.
PH_API int32_t ph_enable_forces(ph_port* port, int32_t on) PH_NOTHROW;

/// The stiffness that the plane, or the contact with the largest force, is shown with, or for a guard the largest that a
/// renderer may have, and its reason; for a tool at the touched point. Call it in the thread of the ticks, but not in
/// every tick.
PH_API int32_t ph_explain(const ph_port* port, ph_explanation* explanation) PH_NOTHROW;

/// The largest stiffness [N/m] of a plane on this device whose ledger does not run dry in ordinary use, with its bound and
/// remedy: the cap of "encoder_touch". `because` may be NULL; its text is in static memory.
PH_API int32_t ph_stiffness_budget(const ph_parameters* parameters, double* stiffness,
                                   const char** because) PH_NOTHROW;

/// Makes a mesh. `*mesh` is NULL unless the answer is PH_OK; `why` is as in ph_create. Triangles without an area may be
/// among others, and a number of vertices that no triangle names.
PH_API int32_t ph_mesh_create(const ph_mesh_data* data, ph_mesh** mesh, char* why,
                              size_t room) PH_NOTHROW;
/// Gives the mesh back. What touches it keeps it until it lets go or is destroyed. NULL does nothing.
PH_API void ph_mesh_destroy(ph_mesh* mesh) PH_NOTHROW;
/// Moves all vertices to these places, x, y, z of each [m]. If it is refused, the last good shape stays. No port waits
/// for it, and it waits for none; after three good ones it takes no memory as long as all that touch it tick.
PH_API int32_t ph_mesh_update(ph_mesh* mesh, const double* vertices, uint32_t vertex_count,
                              char* why, size_t room) PH_NOTHROW;
/// Moves the whole mesh to this pose: `orientation` is the quaternion w, x, y, z, of any length but zero.
PH_API int32_t ph_mesh_move(ph_mesh* mesh, const double position[3],
                            const double orientation[4]) PH_NOTHROW;
/// Makes the triangles of these materials, as in ph_mesh_data, and lets what is felt follow by 50 N/s; with a
/// `material_count` of 0 whoever touches the mesh states one again. If it is refused, the last good ones stay.
PH_API int32_t ph_mesh_set_materials(ph_mesh* mesh, const double* materials,
                                     uint32_t material_count, const uint8_t* material_of, char* why,
                                     size_t room) PH_NOTHROW;
/// Says what is doubtful of the shape that was told last and almost surely a slip: millimetres for metres, a place far
/// from the origin, more triangles than can move 20 times a second, or some that have left those beside which they were
/// made, so that ticks take long. It is no refusal: "" if nothing is. It takes as long as ph_mesh_create.
PH_API int32_t ph_mesh_doubt(const ph_mesh* mesh, char* doubt, size_t room) PH_NOTHROW;
/// Lets a mesh_touch, or all points of a mesh_tool, touch this mesh as well. Call it, and the next one, in the thread
/// of its ticks.
PH_API int32_t ph_mesh_touch(ph_port* port, const ph_mesh* mesh) PH_NOTHROW;
/// Touches this mesh no more, and the others as before. A mesh that is not touched is let go, too.
PH_API int32_t ph_mesh_let_go(ph_port* port, const ph_mesh* mesh) PH_NOTHROW;

/// Makes a probe, for a renderer or an engine of your own; its force is not passive before a guard has bounded it.
/// `*probe` is NULL unless the answer is PH_OK; `why` is as in ph_create.
PH_API int32_t ph_probe_create(const ph_probe_parameters* parameters, ph_probe** probe, char* why,
                               size_t room) PH_NOTHROW;
/// Destroys a probe. NULL does nothing.
PH_API void ph_probe_destroy(ph_probe* probe) PH_NOTHROW;
/// The same as ph_mesh_touch and ph_mesh_let_go, and a new start that forgets which side was touched.
PH_API int32_t ph_probe_touch(ph_probe* probe, const ph_mesh* mesh) PH_NOTHROW;
PH_API int32_t ph_probe_let_go(ph_probe* probe, const ph_mesh* mesh) PH_NOTHROW;
PH_API int32_t ph_probe_reset(ph_probe* probe) PH_NOTHROW;
/// One step: the device is at `position` [m], `dt` [s] after the last step. A number that is not finite, or dt ≤ 0,
/// moves nothing, and the result says where the ball is.
PH_API int32_t ph_probe_step(ph_probe* probe, const double position[3], double dt,
                             ph_probe_result* result) PH_NOTHROW;

/// The text of an event and of a status, in English, in static memory; there is one for unknown numbers, too.
PH_API const char* ph_event_text(int32_t event) PH_NOTHROW;
PH_API const char* ph_status_text(int32_t status) PH_NOTHROW;

#ifdef __cplusplus
}
#endif

#endif
