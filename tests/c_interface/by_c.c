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
                   {"ph_publish_plane", &found->publish_plane},
                   {"ph_publish_nothing", &found->publish_nothing},
                   {"ph_tick", &found->tick},
                   {"ph_tick_wanted", &found->tick_wanted},
                   {"ph_held", &found->held},
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

int32_t run_by_c(const struct c_interface* with, const char* composition,
                 const ph_parameters* parameters, int guard, int ticks, ph_result* results) {
  ph_port* port = NULL;
  const int32_t status = with->create(composition, parameters, &port, NULL, 0);
  if (status != PH_OK) return status;
  for (int n = 0; n < ticks; ++n) {
    const struct moment now = moment_at(n);
    if (!guard && now.news == a_plane) {
      with->publish_plane(port, now.point, now.normal, now.stiffness);
    }
    if (!guard && now.news == nothing_here) with->publish_nothing(port);
    if (now.reports_held) with->held(port, now.held);
    results[n].size = sizeof results[n];
    if (guard && n % 5 != 4) {
      with->tick_wanted(port, now.position, now.dt, now.wanted, &results[n]);
    } else {
      with->tick(port, now.position, now.dt, &results[n]);
    }
  }
  with->destroy(port);
  return status;
}
