// SPDX-License-Identifier: BSD-3-Clause
// The native run that the page is compared with: a fingerprint for each scene and controller of a module,
// as JSON, with the compositions that the page offers.
#include <cstdio>
#include <cstdlib>

extern "C" {
int ph_stages();
int ph_controllers(int);
const char* ph_name(int, int);
const double* ph_fingerprint(int, int, int);
}

int main(int argc, char** argv) {
  const int ticks = argc > 1 ? std::atoi(argv[1]) : 200000;
  std::printf("[");
  for (int s = 0; s < ph_stages(); ++s) {
    const int each = ticks / ph_controllers(s);
    std::printf("%s{\"ticks\": %d, \"prints\": [", s > 0 ? ",\n " : "", each);
    for (int i = 0; i < ph_controllers(s); ++i) {
      const double* half = ph_fingerprint(s, i, each);
      std::printf("%s\"%08x%08x\"", i > 0 ? ", " : "", static_cast<unsigned>(half[0]),
                  static_cast<unsigned>(half[1]));
      if (argc > 2) std::fprintf(stderr, "%s: least energy %.3g J\n", ph_name(s, i), half[2]);
    }
    std::printf("]}");
  }
  std::printf("]\n");
}
