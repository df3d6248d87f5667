// SPDX-License-Identifier: BSD-3-Clause
#ifndef PASSIVE_HAPTICS_ADAPTERS_C_PASSIVE_HAPTICS_H
#define PASSIVE_HAPTICS_ADAPTERS_C_PASSIVE_HAPTICS_H
// The C interface: for C99, C#, Unity, Unreal and whatever else calls a shared library. A port with three or
// six degrees of freedom, in double, composed by name. Link passive_haptics_c, or load it.
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
// ONE PORT PER DEVICE. Two ports on one device are two ledgers that spend the same damping, and the hand
// would be fed.
//
// SI units. The force acts on the device; a normal points out of the object; energy is positive from the
// hand into the device. Vectors are three doubles: x, y, z.
//
// No function throws, and none but ph_create and ph_destroy allocates. Wherever a result is written, the
// port has ticked, and the force in it is what must be commanded: zero, with an event, if anything was
// wrong. Where no result can be written (NULL, a wrong size) the port has not ticked.
//
// A pointer that is not NULL is taken at its word: it leads to what the type says, and lives as long as the
// call. A ph_port* is valid from the ph_create that wrote it until its first ph_destroy. Whatever is done with
// it after that, a second ph_destroy included, is undefined behaviour and not noticed: set your pointer to NULL
// there, because every function answers that.
//
// Threads: of one port, ph_publish* and ph_release belong to one thread; ph_tick*, ph_held*, ph_set, ph_reset,
// ph_enable_forces and ph_explain to one, the same or another. Two threads in functions of one of these groups at once, or ph_destroy
// while one is in any, are a data race, undefined as well; a debug build of the library stops at two that tick.
// ph_guarantee_of is for any thread, and different ports share nothing.
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
/// The most ticks that ph_parameters::latency may say; of what is strict, and of quantised_touch; of a tool.
#define PH_MOST_LATENCY 8
#define PH_MOST_STRICT_LATENCY 2
#define PH_MOST_TOOL_LATENCY 1
/// The slots of contacts and of a stylus: so many for planes, and so many for what is curved.
#define PH_PLANES 4
#define PH_CURVED 4
/// Those of a tool.
#define PH_TOOL_PLANES 16
#define PH_TOOL_CURVED 4

/// One passive port with its ledger, and an inbox for what is published.
typedef struct ph_port ph_port;

/// What a function answers.
enum ph_status {
  PH_OK = 0,
  PH_NULL_ARGUMENT = 1,            ///< a pointer that must not be NULL is
  PH_WRONG_SIZE = 2,               ///< `size` is no size of this struct that the library knows
  PH_UNKNOWN_COMPOSITION = 3,      ///< the name is none of those of ph_create
  PH_REFUSED_PARAMETER = 4,        ///< the text names it, its value and the remedy
  PH_OUT_OF_MEMORY = 5,            ///< for the port
  PH_NOT_OF_THIS_COMPOSITION = 6,  ///< a surface for a guard, a wanted force for a touch
  PH_REFUSED_SURFACE = 7,  ///< a number that is none, a normal of length 0, a stiffness ≤ 0
  PH_NO_SUCH_SLOT = 8      ///< the composition has no slot of this number for this kind
};

/// What a surface is, and which of its numbers say so.
enum ph_surface_kind {
  PH_PLANE = 0,    ///< a: a point, b: the outward normal
  PH_SPHERE = 1,   ///< a: the centre, radius
  PH_CAVITY = 2,   ///< the same, felt from inside
  PH_QUADRIC = 3,  ///< a: a point, b: the normal there, c: a tangent, curvature, thickness, reach
  PH_CAPSULE = 4,  ///< a and b: the ends of its axis, radius
  PH_BOX = 5,      ///< a: the centre, b and c: its first and second axis, half, radius
  PH_PLATE = 6     ///< a, b and c: the corners of a triangle, radius
};

/// What happened in a tick, in order of rising severity; a tick reports the worst.
enum ph_event {
  PH_NOMINAL = 0,            ///< all is well
  PH_DEBT = 1,               ///< the ledger is negative: the hand has been fed more than it paid
  PH_LATE_TICK = 2,          ///< dt is longer than longest_tick: the bound assumed less
  PH_REPEATED_SAMPLE = 3,    ///< the sensor is slower than the loop (not watched for here)
  PH_NO_TARGET = 4,          ///< nothing was published, or wanted, yet: force zero
  PH_REJECTED_TARGET = 5,    ///< the wanted force is unusable: the last good one stays
  PH_STALE_TARGET = 6,       ///< nothing good was published for too long: the force fades
  PH_OUTSIDE_WORKSPACE = 7,  ///< millimetres for metres? Force zero
  PH_REJECTED_SAMPLE = 8,  ///< lost, NaN, dt ≤ 0, an impossible jump: force zero, credit forfeited
  PH_REJECTED_PARAMETERS = 9,  ///< there is no port: force zero
  PH_OUTSIDE_FORCE = 10,   ///< it moves as the mass and hand stated cannot move it: a strict bound
  PH_UNTOLD_LATENCY = 11,  ///< it holds a force later, or sooner, than was stated: force zero
  PH_WRONG_SIGN = 12,      ///< it does the opposite of what it is told: force zero for good
  PH_STARTED_INSIDE = 13,  ///< it should push, and nothing has been paid in yet: force zero
  PH_FORCES_OFF = 14,      ///< the forces are off: force zero, and the ledger waits
  PH_WALL_LOST = 15,  ///< a fault has emptied the ledger: less force than asked for, for a while
  PH_WALL_BACK = 16   ///< amends are made: the first tick in which it is no longer lost
};

/// How far a composition is passive, as in the library.
enum ph_guarantee {
  PH_NONE = 0,
  PH_CONDITIONAL = 1,  ///< for the device and the hand as stated
  PH_STRICT = 2        ///< for every motion, every environment, every schedule of updates
};

/// The device and the hand on it, as a promise may state them: mass, damping and friction from below, the
/// rest from above. Zero says "not stated": it takes the default where there is one, and is refused where
/// the composition cannot do without.
typedef struct ph_parameters {
  uint32_t size;        ///< sizeof(ph_parameters); a struct that ends behind longest_tick will do
  uint32_t latency;     ///< whole ticks from a command to the first instant it is held: PH_MOST_…
  double mass;          ///< smallest apparent mass, over all directions and poses [kg]
  double damping;       ///< b: what identify states, a lower bound [N·s/m]
  double hand_force;    ///< the most that hand, load and dry friction push with [N]
  double force_limit;   ///< what the motors hold [N]
  double longest_tick;  ///< the worst tick of YOUR loop [s]

  double friction;    ///< dry, the least level where it varies [N]
  double presliding;  ///< over which that friction is elastic, > 0 where there is friction [m]
  double quantum;     ///< step of the positions, noise included [m]
  double continuous_force;  ///< what the motors hold for ever [N]; 0: force_limit
  double winding_time;      ///< time constant with which they warm, if that is less [s]
  double turn_rate;         ///< how fast the normal makes up for news at most [rad/s]; 0: 2
  double stale_after;  ///< age up to which news counts in full [s]; 0: planes for ever, forces 0.1
  double top_speed;    ///< faster than this is a sensor fault [m/s]; 0: 5
  double workspace;    ///< farther from the origin is no position of the device [m]; 0: 2
  double watchdog;     ///< the driver drops a force so long after its command [s]; 0: never

  double static_friction;   ///< of the surfaces of contacts, stylus and tool; 0: none
  double kinetic_friction;  ///< no more than that; 0: the same
  double tip[3];            ///< of a stylus: from the gimbal to its tip, in its frame [m]

  // Of a tool, which turns.
  double least_inertia;    ///< smallest moment about the centre of mass, from below [kg·m²]
  double inertia_spread;   ///< between the largest moment and the smallest, from above [kg·m²]
  double inertia_offset;   ///< from the handle to the centre of mass, from above [m]
  double angular_damping;  ///< from below [N·m·s/rad]
  double damping_most;     ///< from above [N·s/m]
  double angular_damping_most;  ///< from above [N·m·s/rad]
  double hand_torque;           ///< the most that the hand turns with [N·m]
  double torque_limit;          ///< what the motors hold [N·m]
  double lever;                 ///< a length of the tool [m]; 0: 0.03
} ph_parameters;

/// A piece of the world, as the environment has it now. What its kind does not take is not looked at.
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

/// What a tick answers.
typedef struct ph_result {
  uint32_t size;    ///< sizeof(ph_result), set by the caller; one that ends behind energy will do
  int32_t event;    ///< a ph_event
  double force[3];  ///< for the device [N]
  double depth;     ///< penetration in the local model, 0 outside and in a guard [m]
  double energy;    ///< E1, the ledger [J]
  int32_t limited;  ///< not 0: the bound has changed the force that contact, or caller, asked for
  int32_t capped;   ///< not 0: the plane is stiffer than the device can pay for, and is felt softer
  double torque[3];  ///< for a tool, about its handle [N·m]; else 0
} ph_result;

/// How stiff a surface is shown, and why no stiffer.
typedef struct ph_explanation {
  uint32_t size;  ///< sizeof(ph_explanation), set by the caller
  int32_t now;    ///< not 0: `force` is less than `shown` times `depth`, and `because` says why
  double asked;   ///< stiffness of the plane [N/m]; infinite for a guard, which does not know it
  double shown;   ///< what is felt of it at rest, as long as the motors hold it [N/m]
  double depth;   ///< of the device in the plane, at the last tick [m]; 0 outside, and in a guard
  double force;   ///< commanded last [N]
  const char* because;  ///< what binds and what would raise it, in English, for ever
} ph_explanation;

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
///   "quantised_touch"                       a touch on steps, friction not known     exact_device, quantum
///
/// exact_device is mass, damping, force_limit, longest_tick; encoder_device that, and friction, presliding, quantum,
/// continuous_force, winding_time; rigid_device mass, damping, force_limit, longest_tick, and what is said of a tool.
/// All but the strict ones take hand_force, and promise PH_CONDITIONAL; those promise PH_STRICT, and are soft while
/// the ledger is empty. A touch presses back from one plane, contacts, stylus and tool from what is in their slots. A
/// guard bounds a force that the caller has, and lets what a renderer leaves ringing settle. What takes positions as
/// exact refuses a `quantum`. What a composition does not take it does not look at.
PH_API int32_t ph_create(const char* composition, const ph_parameters* parameters, ph_port** port,
                         char* why, size_t room) PH_NOTHROW;
/// Ends a port, once; nobody may be in another function with it, then or later. NULL is no port, and nothing
/// happens.
PH_API void ph_destroy(ph_port* port) PH_NOTHROW;
/// A ph_guarantee; PH_NONE for NULL.
PH_API int32_t ph_guarantee_of(const ph_port* port) PH_NOTHROW;

/// The newest surface in a slot: of planes and of what is curved, each counted from 0; a touch has one, for a plane.
/// Wait-free, from ONE thread that may be another than that of the ticks. One that is refused is not sent, and the
/// last good one stays; for a guard it is PH_NOT_OF_THIS_COMPOSITION.
PH_API int32_t ph_publish(ph_port* port, uint32_t slot, const ph_surface* surface) PH_NOTHROW;
/// The plane of slot 0: all x with (point − x)·normal ≥ 0 are inside. `normal` has any length but zero; `stiffness` in
/// N/m.
PH_API int32_t ph_publish_plane(ph_port* port, const double point[3], const double normal[3],
                                double stiffness) PH_NOTHROW;
/// Nothing is in that slot for this kind any more: the contact recedes. From the thread of ph_publish.
PH_API int32_t ph_release(ph_port* port, uint32_t slot, uint32_t kind) PH_NOTHROW;
/// Nothing is anywhere any more; that of a touch fades within 50 ms. From the same thread.
PH_API int32_t ph_publish_nothing(ph_port* port) PH_NOTHROW;

/// One tick: the device is at `position` [m], `dt` [s] after the last tick, measured. From ONE thread. A
/// position that is NULL or no number is a sample that was lost. A guard's last wanted force grows older.
PH_API int32_t ph_tick(ph_port* port, const double position[3], double dt,
                       ph_result* result) PH_NOTHROW;
/// The same for a guard, with the force that is wanted in this tick [N]. One that is no number is refused,
/// and the last good one stays; for a touch, or NULL, the sample is lost.
PH_API int32_t ph_tick_wanted(ph_port* port, const double position[3], double dt,
                              const double wanted[3], ph_result* result) PH_NOTHROW;
/// The same for a stylus and a tool, which turn: the pose of the gimbal, or of the handle, with `orientation` the unit
/// quaternion w, x, y, z that turns its frame into the world's. The other two of these functions are a sample that was
/// lost to them, as this one is to all others.
PH_API int32_t ph_tick_pose(ph_port* port, const double position[3], const double orientation[4],
                            double dt, ph_result* result) PH_NOTHROW;
/// Says before a tick what the device really held over the time that the tick ends [N], where that is not
/// the force commanded `latency` ticks ago: motors that saturate, gravity compensation. For that tick only,
/// from its thread. A force that is no number loses the sample.
PH_API int32_t ph_held(ph_port* port, const double force[3]) PH_NOTHROW;
/// The same for a tool, which takes only this one: force [N] and torque [N·m] about its handle.
PH_API int32_t ph_held_wrench(ph_port* port, const double force[3],
                              const double torque[3]) PH_NOTHROW;

/// Other parameters for a port that lives; its ledger and all else stay. Those that say what the device is must be
/// what ph_create was told: latency, mass, damping, friction, presliding, quantum, longest_tick, tip. A refusal names
/// the first that is not, or is out of its range, as that of ph_create does, and changes nothing. In the thread of the
/// ticks; not in every tick.
PH_API int32_t ph_set(ph_port* port, const ph_parameters* parameters, char* why,
                      size_t room) PH_NOTHROW;
/// Puts all but the parameters back to the start, for a device that has stopped: also what has ended the force for
/// good. What had been published is forgotten, until it is published again. In the thread of the ticks.
PH_API int32_t ph_reset(ph_port* port) PH_NOTHROW;
/// The driver has taken the forces away, or given them back (not 0): in between ticks answer PH_FORCES_OFF and force
/// zero, and the ledger waits. In the thread of the ticks.
PH_API int32_t ph_enable_forces(ph_port* port, int32_t on) PH_NOTHROW;

/// How stiff the plane, or the contact that presses most, is shown, or how stiff a renderer may be that the guard
/// settles, and why no stiffer; of a tool where it is touched. Not in every tick, from their thread.
PH_API int32_t ph_explain(const ph_port* port, ph_explanation* explanation) PH_NOTHROW;

/// How stiff a plane may be on this device before its ledger runs dry in ordinary use [N/m], what binds it,
/// and what would raise it: the cap of "encoder_touch". `because` may be NULL; its text is for ever.
PH_API int32_t ph_stiffness_budget(const ph_parameters* parameters, double* stiffness,
                                   const char** because) PH_NOTHROW;

/// The text of an event and of a status, in English, for ever; a sentence of its own for a number that is
/// none of them.
PH_API const char* ph_event_text(int32_t event) PH_NOTHROW;
PH_API const char* ph_status_text(int32_t status) PH_NOTHROW;

#ifdef __cplusplus
}
#endif

#endif
