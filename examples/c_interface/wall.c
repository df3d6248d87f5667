// SPDX-License-Identifier: BSD-3-Clause
// README's first program in C: a device of 0.1 kg falls onto a wall of 10 kN/m and is left alone for five
// seconds, once on a spring, once on a touch. Then what a wrong parameter and a lost sample say.

#include <passive_haptics/adapters/c/passive_haptics.h>

#include <math.h>
#include <stdio.h>

static const double mass = 0.1, damping = 0.03,
                    load = -1.0;  // kg, N·s/m, N: the device falls along −z

struct device {
  double z, v;    // m, m/s
  double energy;  // that has flowed in at its port, J
};

// One millisecond under the force of the motors, in a hundred small steps.
static void hold(struct device* d, double force) {
  for (int i = 0; i < 100; ++i) {
    const double before = d->v;
    d->v += 1e-5 * (force + load - damping * before) / mass;
    const double middle = (before + d->v) / 2;
    d->z += 1e-5 * middle;
    d->energy += 1e-5 * middle * (damping * middle - force);
  }
}

static void drop(const char* wall, ph_port* port) {
  struct device now = {0.02, 0.0, 0.0};
  double least = 0.0;
  for (int ms = 1; ms < 5000; ++ms) {
    double force = now.z < 0.0 ? -1e4 * now.z : 0.0;
    if (port != NULL) {
      const double position[3] = {0.0, 0.0, now.z};
      ph_result out = {.size = sizeof out};
      ph_tick(port, position, 1e-3, &out);
      force = out.force[2];
    }
    hold(&now, force);
    if (now.energy < least) least = now.energy;
  }
  printf("%-8s after 5 s at %6.2f mm, %5.2f m/s; the wall has created %4.2f J\n", wall, 1e3 * now.z,
         now.v, 0 - least);
}

int main(void) {
  char why[PH_TEXT_ROOM];
  ph_port* port = NULL;
  ph_parameters device = {
      .size = sizeof device, .damping = damping, .force_limit = 9, .longest_tick = 1e-3};
  ph_create("touch", &device, &port, why, sizeof why);
  printf("%s\n", why);

  device.mass = mass;
  device.hand_force = 5;
  if (ph_create("touch", &device, &port, why, sizeof why) != PH_OK) return puts(why), 1;
  const double point[3] = {0.0, 0.0, 0.0}, normal[3] = {0.0, 0.0, 1.0};
  ph_publish_plane(port, point, normal, 1e4);

  drop("spring:", NULL);
  drop("touch:", port);

  const double lost[3] = {0.0, 0.0, (double)NAN};
  ph_result out = {.size = sizeof out};
  ph_tick(port, lost, 1e-3, &out);
  printf("NaN:     %s, %g N\n", ph_event_text(out.event), out.force[2]);
  ph_destroy(port);
  return 0;
}
