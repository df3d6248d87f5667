// SPDX-License-Identifier: BSD-3-Clause
#include "by_c.h"

#include <dlfcn.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

// POSIX lets a pointer to data be one to a function; C does not, so it is copied.
static const char* find(void* library, const char* name, void* function) {
  void* const found = dlsym(library, name);
  memcpy(function, &found, sizeof found);
  return found == NULL ? name : NULL;
}

const char* load(struct c_interface* found, const char* file) {
  found->library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (found->library == NULL) return dlerror();
  struct {
    const char* name;
    void* function;
  } const all[] = {{"ph_version", &found->version},
                   {"ph_create", &found->create},
                   {"ph_destroy", &found->destroy},
                   {"ph_guarantee_of", &found->guarantee_of},
                   {"ph_publish", &found->publish},
                   {"ph_release", &found->release},
                   {"ph_publish_plane", &found->publish_plane},
                   {"ph_publish_nothing", &found->publish_nothing},
                   {"ph_tick", &found->tick},
                   {"ph_tick_wanted", &found->tick_wanted},
                   {"ph_tick_pose", &found->tick_pose},
                   {"ph_held", &found->held},
                   {"ph_held_wrench", &found->held_wrench},
                   {"ph_set", &found->set},
                   {"ph_reset", &found->reset},
                   {"ph_enable_forces", &found->enable_forces},
                   {"ph_explain", &found->explain},
                   {"ph_stiffness_budget", &found->stiffness_budget},
                   {"ph_mesh_create", &found->mesh_create},
                   {"ph_mesh_destroy", &found->mesh_destroy},
                   {"ph_mesh_update", &found->mesh_update},
                   {"ph_mesh_set_materials", &found->mesh_set_materials},
                   {"ph_mesh_move", &found->mesh_move},
                   {"ph_mesh_doubt", &found->mesh_doubt},
                   {"ph_mesh_touch", &found->mesh_touch},
                   {"ph_mesh_let_go", &found->mesh_let_go},
                   {"ph_probe_create", &found->probe_create},
                   {"ph_probe_destroy", &found->probe_destroy},
                   {"ph_probe_touch", &found->probe_touch},
                   {"ph_probe_let_go", &found->probe_let_go},
                   {"ph_probe_reset", &found->probe_reset},
                   {"ph_probe_step", &found->probe_step},
                   {"ph_event_text", &found->event_text},
                   {"ph_status_text", &found->status_text}};
  for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
    const char* const missing = find(found->library, all[i].name, all[i].function);
    if (missing != NULL) return missing;
  }
  return NULL;
}

void unload(struct c_interface* found) {
  if (found->library != NULL) dlclose(found->library);
  found->library = NULL;
}

// −peak to peak and back in `period` ticks.
static int triangle(int n, int period, int peak) {
  const int at = n % period;
  const int half = period / 2;
  const int up = at < half ? at : period - at;
  return 2 * peak * up / half - peak;
}

struct moment moment_at(int n) {
  const unsigned noise = ((unsigned)n * 1103515245u + 12345u) >> 16;
  const double step = 20e-6;
  struct moment now = {.dt = 0.9e-3 + 1e-6 * (noise % 200u)};
  now.position[0] = step * triangle(n, 700, 300);
  now.position[1] = step * triangle(n, 900, 200);
  now.position[2] = step * (triangle(n, 400, 150) + (int)(noise % 2u));
  if (n % 1300 == 1299) now.position[1] = (double)NAN;
  const double turn = 1e-3 * triangle(n, 1100, 120);  // the tangent of half the angle, about y
  now.orientation[0] = 1.0 / sqrt(1.0 + turn * turn);
  now.orientation[2] = turn * now.orientation[0];
  for (int i = 0; i < 3; ++i) now.wanted[i] = 0.01 * triangle(n + 100 * i, 300 + 10 * i, 250);
  if (n % 1700 == 1699) now.wanted[0] = (double)NAN;
  now.reports_held = n % 97 == 96;
  now.held[2] = 0.1;

  if (n % 33 == 5) now.news = n % 2000 > 1800 ? nothing_here : a_plane;
  now.point[2] = 1e-5 * triangle(n, 1500, 100);
  now.normal[0] = 0.001 * triangle(n, 1100, 300);
  now.normal[2] = 2.0;  // of any length
  now.stiffness = 1000.0 + triangle(n, 1900, 800);
  return now;
}

enum news curved_news(int n) {
  if (n % 47 != 11) return no_news;
  return n % 1700 > 1500 ? nothing_here : a_plane;
}

ph_surface curved_at(int n, uint32_t kind) {
  ph_surface s = {.size = sizeof s, .kind = kind, .stiffness = 900.0};
  s.a[2] = 1e-5 * triangle(n, 1500, 60);
  switch (kind) {
    case PH_SPHERE:
      s.radius = 0.02;
      s.a[2] -= s.radius;
      break;
    case PH_CAVITY:
      s.radius = 4e-3;
      break;
    case PH_QUADRIC:
      s.b[1] = 0.2;
      s.b[2] = 2.0;
      s.c[0] = 1.0;
      s.curvature[0] = 40.0;
      s.curvature[1] = -15.0;
      s.thickness = 0.02;
      s.reach = n % 2 == 0 ? 5e-3 : 0.0;
      break;
    case PH_CAPSULE:
      s.radius = 6e-3;
      s.a[0] = -3e-3;
      s.b[0] = 3e-3;
      s.a[2] -= s.radius;
      s.b[2] = -s.radius;
      break;
    case PH_BOX:
      s.radius = 3e-3;
      s.a[2] -= 0.01;
      s.half[0] = 3e-3;
      s.half[1] = 2e-3;
      s.half[2] = 7e-3;
      s.b[0] = 1.0;
      s.b[1] = 0.3;
      s.c[1] = 2.0;
      break;
    default:
      s.radius = 2e-3;
      s.a[0] = s.b[1] = 4e-3;
      s.c[0] = s.c[1] = -4e-3;
      break;
  }
  return s;
}

ph_surface plane_at(const struct moment* now, double x_on_tool) {
  ph_surface s = {.size = sizeof s, .kind = PH_PLANE, .stiffness = now->stiffness};
  memcpy(s.a, now->point, sizeof s.a);
  memcpy(s.b, now->normal, sizeof s.b);
  s.at[0] = x_on_tool;
  return s;
}

struct meshes meshes_at(int n) {
  struct meshes all = {.materials = {900.0, 0.3, 0.0, 2500.0, 0.1, 0.5}};
  for (int i = 0; i < sheet_vertices; ++i) {
    double* const p = all.sheet + 3 * i;
    p[0] = 2e-3 * (i % 9 - 4);
    p[1] = 2e-3 * (i / 9 - 4);
    p[2] = 1e-4 * triangle(i, 5, 5) + 1e-5 * triangle(n + 40 * i, 1500, 60);
  }
  for (int i = 0; i < sheet_triangles; ++i) {
    const int first = i / 16 * 9 + i % 16 / 2;  // of a square, cut in two
    int32_t* const t = all.of_sheet + 3 * i;
    t[0] = first;
    t[1] = first + (i % 2 == 0 ? 1 : 10);
    t[2] = first + (i % 2 == 0 ? 10 : 9);
    all.material_of[i] = (uint8_t)(i / 7 % 2);
  }
  for (int i = 0; i < leaf_vertices; ++i) {
    all.leaf[3 * i] = i % 2 == 0 ? -4e-3 : 4e-3;
    all.leaf[3 * i + 1] = i / 2 == 0 ? -1e-3 : 1e-3;
  }
  const int32_t corners[] = {0, 1, 3, 0, 3, 2};
  memcpy(all.of_leaf, corners, sizeof corners);
  all.position[1] = 1e-5 * triangle(n, 800, 300);
  all.position[2] = 5e-4;
  all.orientation[0] = 2.0;  // of any length
  all.orientation[1] = 0.001 * triangle(n, 1000, 600);
  return all;
}

ph_mesh_data sheet_of(const struct meshes* all, uint32_t kind) {
  ph_mesh_data d = {.size = sizeof d,
                    .vertex_count = sheet_vertices,
                    .triangle_count = sheet_triangles,
                    .vertices = all->sheet,
                    .triangles = all->of_sheet};
  if (kind == 2) d.crease = 0.7;
  if (kind != 1) return d;
  d.material_count = 2;
  d.materials = all->materials;
  d.material_of = all->material_of;
  return d;
}

ph_mesh_data leaf_of(const struct meshes* all) {
  const ph_mesh_data d = {.size = sizeof d,
                          .vertex_count = leaf_vertices,
                          .triangle_count = leaf_triangles,
                          .material_count = 1,  // of all of it
                          .vertices = all->leaf,
                          .triangles = all->of_leaf,
                          .materials = all->materials};
  return d;
}

int mesh_news(int n) {
  return (n % 33 == 5 ? other_vertices : 0) | (n % 47 == 11 ? another_pose : 0) |
         (n % 1500 == 200 ? leaf_comes : 0) | (n % 1500 == 1200 ? leaf_goes : 0) |
         (n == 3000 ? other_material : 0) | (n == 5000 ? no_material : 0);
}

/// The meshes of a run, and what touches them: a port or a probe.
struct touching {
  const struct c_interface* with;
  ph_mesh *sheet, *leaf;
  ph_port* port;
  ph_probe* probe;
};
static int32_t touch(const struct touching* t, const ph_mesh* mesh) {
  return t->port != NULL ? t->with->mesh_touch(t->port, mesh)
                         : t->with->probe_touch(t->probe, mesh);
}
static int32_t begin(struct touching* t, uint32_t kind) {
  const struct meshes all = meshes_at(0);
  const ph_mesh_data sheet = sheet_of(&all, kind), leaf = leaf_of(&all);
  int32_t status = t->with->mesh_create(&sheet, &t->sheet, NULL, 0);
  if (status == PH_OK) status = t->with->mesh_create(&leaf, &t->leaf, NULL, 0);
  return status == PH_OK ? touch(t, t->sheet) : status;
}
static int32_t move(const struct touching* t, int n) {
  const int news = mesh_news(n);
  const struct meshes all = meshes_at(n);
  int32_t status = PH_OK;
  if (news & other_vertices)
    status |= t->with->mesh_update(t->sheet, all.sheet, sheet_vertices, NULL, 0);
  if (news & other_material)
    status |= t->with->mesh_set_materials(t->sheet, all.materials + 3, 1, NULL, NULL, 0);
  if (news & no_material) status |= t->with->mesh_set_materials(t->sheet, NULL, 0, NULL, NULL, 0);
  if (news & another_pose) status |= t->with->mesh_move(t->leaf, all.position, all.orientation);
  if (news & leaf_comes) status |= touch(t, t->leaf);
  if (!(news & leaf_goes)) return status;
  return status | (t->port != NULL ? t->with->mesh_let_go(t->port, t->leaf)
                                   : t->with->probe_let_go(t->probe, t->leaf));
}
/// The meshes first: what touches them keeps them.
static void end(struct touching* t) {
  t->with->mesh_destroy(t->sheet);
  t->with->mesh_destroy(t->leaf);
  t->with->probe_destroy(t->probe);
  t->with->destroy(t->port);
}

int32_t probe_by_c(const struct c_interface* with, const ph_probe_parameters* parameters,
                   uint32_t kind, int ticks, ph_probe_result* results) {
  struct touching t = {.with = with};
  int32_t status = with->probe_create(parameters, &t.probe, NULL, 0);
  if (status == PH_OK) status = begin(&t, kind);
  for (int n = 0; n < ticks && status == PH_OK; ++n) {
    const struct moment now = moment_at(n);
    if (n == reset_tick) status |= with->probe_reset(t.probe);
    status |= move(&t, n);
    results[n].size = sizeof results[n];
    const int32_t stepped = with->probe_step(t.probe, now.position, now.dt, &results[n]);
    if (stepped != PH_OK && now.position[1] == now.position[1]) status = stepped;
  }
  end(&t);
  return status;
}

static void tell(const struct c_interface* with, ph_port* port, struct script script, int n,
                 const struct moment* now) {
  if (script.way == by_forces) return;
  if (script.way == by_planes) {
    if (now->news == a_plane) with->publish_plane(port, now->point, now->normal, now->stiffness);
    if (now->news == nothing_here) with->publish_nothing(port);
    return;
  }
  const int points = script.way == as_tool ? 2 : 1;
  for (int i = 0; i < points; ++i) {
    const ph_surface plane = plane_at(now, 0.02 * i - 0.01 * (points - 1));
    if (now->news == a_plane) with->publish(port, (uint32_t)i, &plane);
    if (now->news == nothing_here) with->release(port, (uint32_t)i, PH_PLANE);
  }
  const ph_surface curved = curved_at(n, script.kind);
  if (curved_news(n) == a_plane) with->publish(port, 1, &curved);
  if (curved_news(n) == nothing_here) with->release(port, 1, script.kind);
}

int32_t run_by_c(const struct c_interface* with, const char* composition,
                 const ph_parameters* parameters, struct script script, int ticks,
                 ph_result* results) {
  static const double torque[3] = {0.0, 1e-3, 0.0};
  const bool meshes = script.way == by_meshes || script.way == as_mesh_tool;
  const bool twists = script.way == as_tool || script.way == as_mesh_tool;
  struct touching t = {.with = with};
  int32_t status = with->create(composition, parameters, &t.port, NULL, 0);
  ph_port* const port = t.port;
  if (status == PH_OK && meshes) status = begin(&t, script.kind);
  for (int n = 0; n < ticks && status == PH_OK; ++n) {
    const struct moment now = moment_at(n);
    if (script.later != NULL && n == change_tick) status = with->set(port, script.later, NULL, 0);
    if (script.later != NULL && n == off_tick) status = with->enable_forces(port, 0);
    if (script.later != NULL && n == on_tick) status = with->enable_forces(port, 1);
    if (script.later != NULL && n == reset_tick) status = with->reset(port);
    if (meshes) {
      status |= move(&t, n);
    } else {
      tell(with, port, script, n, &now);
    }
    if (now.reports_held && twists) with->held_wrench(port, now.held, torque);
    if (now.reports_held && !twists) with->held(port, now.held);
    results[n].size = sizeof results[n];
    if (script.way == as_stylus || twists) {
      with->tick_pose(port, now.position, now.orientation, now.dt, &results[n]);
    } else if (script.way == by_forces && n % 5 != 4) {
      with->tick_wanted(port, now.position, now.dt, now.wanted, &results[n]);
    } else {
      with->tick(port, now.position, now.dt, &results[n]);
    }
  }
  end(&t);
  return status;
}
