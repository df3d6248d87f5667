// SPDX-License-Identifier: BSD-3-Clause
// Built with -fsanitize=realtime and run: whatever the compiler could not see, the run would. With an
// argument the loop allocates, and the sanitizer must stop it.
#include "models.hpp"

#include <cstdio>
#include <cstdlib>
#include <limits>

template <class Port>
void run_loop(Port& model, bool allocate) noexcept [[clang::nonblocking]] {
  using space = typename Port::port_type;
  using scalar = typename Port::scalar;
  for (int n = 0; n < 300; ++n) {
    typename space::pose x = space::zero();
    space::component(x, space::dof - 1) =
        n % 97 == 96 ? std::numeric_limits<scalar>::quiet_NaN() : scalar(1e-5) * scalar(50 - n);
    if (n % 33 == 0) {
      if constexpr (requires { model.update(model.target()); }) {
        static_cast<void>(model.update(model.target()));
      }
      if constexpr (requires { model.source().update(x); }) {
        static_cast<void>(model.source().update(x * scalar(100)));
      }
    }
    static_cast<void>(model.tick(x, ph::seconds{n % 50 == 49 ? scalar(2e-3) : scalar(1e-3)}));
    if constexpr (Port::latency == 0) {
      if (n == 200) static_cast<void>(model.set(ph::loop_limits{.longest_tick = 0.002}));
    }
    if (allocate) {
      void* volatile block = std::malloc(16);
      std::free(block);
    }
  }
}

int main(int count, char** /*arguments*/) {
  int models = 0;
  int unsound = 0;
  const auto run = [&](auto model) {
    if (model.check()) ++unsound;
    run_loop(model, count > 1);
    ++models;
  };
  each_model<float>(run);
  each_model<double>(run);
  if (unsound > 0) std::printf("%d models were given bad parameters and did nothing\n", unsound);
  std::printf("%d models ran without a blocking call\n", models);
  return unsound > 0 ? 1 : 0;
}
