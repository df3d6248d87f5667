// SPDX-License-Identifier: BSD-3-Clause
// Compiled, never run: clang++ 20 or newer with -Werror=function-effects looks through every template
// and refuses a nonblocking function that could allocate, lock, throw or call the system. With
// ALLOCATES, LOCKS or THROWS defined, a policy does, and the compiler must say so.
#include "models.hpp"

#include <mutex>
#include <vector>

struct wrong_bound : ph::no_bound {
  template <ph::port P>
  struct on : ph::no_bound::on<P> {
    using ph::no_bound::on<P>::on;
    using effort = typename P::effort;
    [[nodiscard]] effort limit(const effort& desired, const auto& /*state*/) const noexcept {
#if defined(ALLOCATES)
      const std::vector<effort> copy(3, desired);
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
};

template <class Port>
auto tick(Port& port, const typename Port::pose& x, typename Port::scalar dt) noexcept
    [[clang::nonblocking]] {
  return port.tick(x, ph::seconds{dt});
}
template <class Port>
auto tick_sample(Port& port, const ph::device_sample<typename Port::port_type>& sample) noexcept
    [[clang::nonblocking]] {
  return port.tick(sample);
}
template <class Port>
auto tick_given(Port& port, const typename Port::pose& x, typename Port::scalar dt,
                const typename Port::effort& wanted) noexcept [[clang::nonblocking]] {
  return port.tick(x, ph::seconds{dt}, wanted);
}
template <class Port, class Parameters>
auto change(Port& port, const Parameters& parameters) noexcept [[clang::nonblocking]] {
  return port.set(parameters);
}
template <class Port>
void start_anew(Port& port) noexcept [[clang::nonblocking]] {
  port.reset();
}
template <class Contact>
bool update(Contact& contact, const typename Contact::constraint_type& next) noexcept
    [[clang::nonblocking]] {
  contact.release();
  return contact.update(next);
}
template <class Value>
const Value* hand_over(ph::exchange<Value>& mailbox, const Value& value) noexcept
    [[clang::nonblocking]] {
  mailbox.publish(value);
  return mailbox.take();
}

struct instantiate {
  template <class Port>
  void operator()(Port port) const {
    const typename Port::pose x = Port::port_type::zero();
    const typename Port::scalar T(0.001);
    (void)tick(port, x, T);
    (void)tick_sample(port, {});
    if constexpr (Port::latency == 0) (void)change(port, loop);
    start_anew(port);
    if constexpr (requires { port.tick(x, ph::seconds{T}, x); }) (void)tick_given(port, x, T, x);
    if constexpr (requires { port.update(port.target()); }) {
      (void)update(port, port.target());
      ph::exchange<typename Port::constraint_type> mailbox;
      (void)hand_over(mailbox, port.target());
    }
    if constexpr (requires { port.source().template contact<0>(); }) {
      auto& contact = port.source().template contact<0>();
      (void)update(contact, contact.target());
    }
  }
};

void all() {
#if !defined(ALLOCATES) && !defined(LOCKS) && !defined(THROWS)
  each_model<float>(instantiate{});
  each_model<double>(instantiate{});
#endif
  using line = ph::space<float, 1>;
  instantiate{}(ph::local_model{line{}, ph::fixed{ph::half_space<line>{0, 1, 1000}},
                                ph::turn_at_once{}, ph::spring{}, ph::no_observer{}, wrong_bound{},
                                loop});
}
