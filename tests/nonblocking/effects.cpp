// SPDX-License-Identifier: BSD-3-Clause
// Compiled, never run: clang++ 20 or newer with -Werror=function-effects looks through every template
// and refuses a nonblocking function that could allocate, lock, throw or call the system. With
// ALLOCATES, LOCKS or THROWS defined, a policy does, and the compiler must say so.
#include "models.hpp"

#include <mutex>
#include <vector>

template <class Space>
struct wrong_bound : ph::no_bound<Space> {
  using vector = typename Space::vector;
  [[nodiscard]] vector limit(const vector& desired, const auto& /*state*/) const noexcept {
#if defined(ALLOCATES)
    const std::vector<vector> copy(3, desired);
    return copy[0];
#elif defined(LOCKS)
    static std::mutex mutex;
    const std::lock_guard<std::mutex> lock(mutex);
    return desired;
#elif defined(THROWS)
    if (desired != desired) throw 1;
    return desired;
#else
    return desired;
#endif
  }
};

template <class Model>
auto tick(Model& model, const typename Model::vector& x, typename Model::scalar dt) noexcept
    [[clang::nonblocking]] {
  return model.tick(x, dt);
}
template <class Model>
auto tick_sample(Model& model, const ph::device_sample<typename Model::space_type>& sample) noexcept
    [[clang::nonblocking]] {
  return model.tick(sample);
}
template <class Model>
bool retarget(Model& model, const typename Model::constraint_type& next) noexcept
    [[clang::nonblocking]] {
  return model.retarget(next);
}
template <class Value>
const Value* hand_over(ph::exchange<Value>& mailbox, const Value& value) noexcept
    [[clang::nonblocking]] {
  mailbox.publish(value);
  return mailbox.take();
}

struct instantiate {
  template <class Model>
  void operator()(Model model) const {
    (void)tick(model, typename Model::vector{}, typename Model::scalar(0.001));
    (void)tick_sample(model, {});
    if constexpr (requires { model.retarget(model.target()); }) {
      (void)retarget(model, model.target());
      ph::exchange<typename Model::constraint_type> mailbox;
      (void)hand_over(mailbox, model.target());
    }
  }
};

void all() {
  each_model<float>(instantiate{});
  each_model<double>(instantiate{});
  using line = ph::space<float, 1>;
  instantiate{}(ph::local_model{line{}, ph::rigid{ph::half_space<line>{0, 1, 1000}},
                                ph::snap<line>{}, ph::spring<line>{}, ph::no_observer<line>{},
                                wrong_bound<line>{}});
}
