// SPDX-License-Identifier: BSD-3-Clause
// Built with -fsanitize=realtime and run: whatever the compiler could not see, the run would. With an
// argument the loop allocates, and the sanitizer must stop it.
#include "models.hpp"

#include <cstdio>
#include <cstdlib>
#include <limits>

template <class Model>
void loop(Model& model, bool allocate) noexcept [[clang::nonblocking]] {
  using space = typename Model::space_type;
  using scalar = typename Model::scalar;
  for (int n = 0; n < 300; ++n) {
    typename space::vector x = space::zero();
    space::component(x, space::dof - 1) =
        n % 97 == 96 ? std::numeric_limits<scalar>::quiet_NaN() : scalar(1e-5) * scalar(50 - n);
    if (n % 33 == 0) {
      if constexpr (requires { model.retarget(model.target()); }) {
        static_cast<void>(model.retarget(model.target()));
      }
    }
    static_cast<void>(model.tick(x, n % 50 == 49 ? scalar(2e-3) : scalar(1e-3)));
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
    loop(model, count > 1);
    ++models;
  };
  each_model<float>(run);
  each_model<double>(run);
  if (unsound > 0) std::printf("%d models were given bad parameters and did nothing\n", unsound);
  std::printf("%d models ran without a blocking call\n", models);
  return unsound > 0 ? 1 : 0;
}
