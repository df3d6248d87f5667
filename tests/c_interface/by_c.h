// SPDX-License-Identifier: BSD-3-Clause
#ifndef PASSIVE_HAPTICS_TESTS_C_INTERFACE_BY_C_H
#define PASSIVE_HAPTICS_TESTS_C_INTERFACE_BY_C_H
// A client in plain C that loads the library, and the motion it runs.

#include <passive_haptics/adapters/c/passive_haptics.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The functions of the interface, found by name in a library that was loaded.
struct c_interface {
  void* library;
  uint32_t (*version)(void);
  int32_t (*create)(const char*, const ph_parameters*, ph_port**, char*, size_t);
  void (*destroy)(ph_port*);
  int32_t (*guarantee_of)(const ph_port*);
  int32_t (*publish)(ph_port*, uint32_t, const ph_surface*);
  int32_t (*release)(ph_port*, uint32_t, uint32_t);
  int32_t (*publish_plane)(ph_port*, const double*, const double*, double);
  int32_t (*publish_nothing)(ph_port*);
  int32_t (*tick)(ph_port*, const double*, double, ph_result*);
  int32_t (*tick_wanted)(ph_port*, const double*, double, const double*, ph_result*);
  int32_t (*tick_pose)(ph_port*, const double*, const double*, double, ph_result*);
  int32_t (*held)(ph_port*, const double*);
  int32_t (*held_wrench)(ph_port*, const double*, const double*);
  int32_t (*set)(ph_port*, const ph_parameters*, char*, size_t);
  int32_t (*reset)(ph_port*);
  int32_t (*enable_forces)(ph_port*, int32_t);
  int32_t (*explain)(const ph_port*, ph_explanation*);
  int32_t (*stiffness_budget)(const ph_parameters*, double*, const char**);
  int32_t (*mesh_create)(const ph_mesh_data*, ph_mesh**, char*, size_t);
  void (*mesh_destroy)(ph_mesh*);
  int32_t (*mesh_update)(ph_mesh*, const double*, uint32_t, char*, size_t);
  int32_t (*mesh_doubt)(const ph_mesh*, char*, size_t);
  int32_t (*mesh_set_materials)(ph_mesh*, const double*, uint32_t, const uint8_t*, char*, size_t);
  int32_t (*mesh_move)(ph_mesh*, const double*, const double*);
  int32_t (*mesh_touch)(ph_port*, const ph_mesh*);
  int32_t (*mesh_let_go)(ph_port*, const ph_mesh*);
  int32_t (*probe_create)(const ph_probe_parameters*, ph_probe**, char*, size_t);
  void (*probe_destroy)(ph_probe*);
  int32_t (*probe_touch)(ph_probe*, const ph_mesh*);
  int32_t (*probe_let_go)(ph_probe*, const ph_mesh*);
  int32_t (*probe_reset)(ph_probe*);
  int32_t (*probe_step)(ph_probe*, const double*, double, ph_probe_result*);
  const char* (*event_text)(int32_t);
  const char* (*status_text)(int32_t);
};
/// NULL, or what could not be loaded.
const char* load(struct c_interface* found, const char* file);
void unload(struct c_interface* found);

enum news { no_news, a_plane, nothing_here };

/// One tick of the motion: presses into a surface that heaves, tilts and goes, on steps of 20 µm, in ticks
/// of 0.9 to 1.1 ms; loses a sample now and then. In whole numbers, so that everybody computes the same.
struct moment {
  double position[3], orientation[4], dt;
  double wanted[3];
  double held[3];
  int reports_held;  // now and then the device says what it held
  enum news news;
  double point[3], normal[3], stiffness;
};
struct moment moment_at(int n);

/// What is told of a curved surface in slot 1, now and then, and where it is in tick n.
enum news curved_news(int n);
ph_surface curved_at(int n, uint32_t kind);
/// The plane of that tick, at a point of a tool.
ph_surface plane_at(const struct moment* now, double x_on_tool);

/// A sheet of bumps that heaves, and a leaf that is turned above it: where they are in tick n. Their materials count in
/// a script of kind 1, and it is smooth in one of kind 2.
enum { sheet_vertices = 81, sheet_triangles = 128, leaf_vertices = 4, leaf_triangles = 2 };
struct meshes {
  double sheet[3 * sheet_vertices], leaf[3 * leaf_vertices];
  int32_t of_sheet[3 * sheet_triangles], of_leaf[3 * leaf_triangles];
  double materials[6];
  uint8_t material_of[sheet_triangles];
  double position[3], orientation[4];  // of the leaf
};
struct meshes meshes_at(int n);
ph_mesh_data sheet_of(const struct meshes* all, uint32_t kind);
ph_mesh_data leaf_of(const struct meshes* all);
/// What is told of them in tick n: other vertices, another pose, the leaf comes or goes, and the sheet changes its
/// material or has none again.
enum {
  other_vertices = 1,
  another_pose = 2,
  leaf_comes = 4,
  leaf_goes = 8,
  other_material = 16,
  no_material = 32
};
int mesh_news(int n);

/// How a composition is told the world: by planes, by forces, by slots, by slots at a pose, by meshes, and by meshes
/// at a pose.
enum way { by_planes, by_forces, by_slots, as_stylus, as_tool, by_meshes, as_mesh_tool };
/// When its parameters become others, its forces are off and on again, and when all starts anew.
enum { change_tick = 2405, off_tick = 3170, on_tick = 3215, reset_tick = 4100 };
struct script {
  enum way way;
  uint32_t kind;               // of what is in slot 1; of the meshes
  const ph_parameters* later;  // from change_tick on; NULL: no others, and no new start
};

/// Runs `ticks` of the motion and keeps every result: PH_OK, or what ph_create or ph_set answered.
int32_t run_by_c(const struct c_interface* with, const char* composition,
                 const ph_parameters* parameters, struct script script, int ticks,
                 ph_result* results);
/// The same motion for a probe.
int32_t probe_by_c(const struct c_interface* with, const ph_probe_parameters* parameters,
                   uint32_t kind, int ticks, ph_probe_result* results);

#ifdef __cplusplus
}
#endif

#endif
