// SPDX-License-Identifier: BSD-3-Clause
#include "by_c.h"

#include <dlfcn.h>
#include <math.h>
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
  ph_port* port = NULL;
  int32_t status = with->create(composition, parameters, &port, NULL, 0);
  if (status != PH_OK) return status;
  for (int n = 0; n < ticks && status == PH_OK; ++n) {
    const struct moment now = moment_at(n);
    if (script.later != NULL && n == change_tick) status = with->set(port, script.later, NULL, 0);
    if (script.later != NULL && n == off_tick) status = with->enable_forces(port, 0);
    if (script.later != NULL && n == on_tick) status = with->enable_forces(port, 1);
    if (script.later != NULL && n == reset_tick) status = with->reset(port);
    tell(with, port, script, n, &now);
    if (now.reports_held && script.way == as_tool) with->held_wrench(port, now.held, torque);
    if (now.reports_held && script.way != as_tool) with->held(port, now.held);
    results[n].size = sizeof results[n];
    if (script.way == as_stylus || script.way == as_tool) {
      with->tick_pose(port, now.position, now.orientation, now.dt, &results[n]);
    } else if (script.way == by_forces && n % 5 != 4) {
      with->tick_wanted(port, now.position, now.dt, now.wanted, &results[n]);
    } else {
      with->tick(port, now.position, now.dt, &results[n]);
    }
  }
  with->destroy(port);
  return status;
}
