// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One type for every local model over a half-space, so that scenes and sweeps compile once.

#include <passive_haptics/passive_haptics.hpp>

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace controllers {

namespace ph = passive_haptics;

/// Any local_model<Space, following<half_space<Space>>, …>, as a value: copying it copies the state.
template <class Space>
class model {
 public:
  using space_type = Space;
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using constraint_type = ph::half_space<Space>;

  template <class Local>
  requires(!std::same_as<Local, model>) model(const Local& local)
  noexcept  // NOLINT: the same thing
      : calls_(&table<Local>) {
    static_assert(std::is_trivially_copyable_v<Local> && sizeof(Local) <= capacity &&
                  alignof(Local) <= alignof(std::max_align_t));
    std::memcpy(bytes_, &local, sizeof(Local));
  }

  bool retarget(const constraint_type& next) noexcept { return calls_->retarget(bytes_, next); }
  [[nodiscard]] ph::tick_result<Space> tick(const ph::device_sample<Space>& sample) noexcept {
    return calls_->tick(bytes_, sample);
  }
  [[nodiscard]] ph::tick_result<Space> tick(const vector& position, scalar dt) noexcept {
    return calls_->tick_at(bytes_, position, dt);
  }
  [[nodiscard]] const constraint_type& local() const noexcept { return calls_->local(bytes_); }
  [[nodiscard]] scalar energy() const noexcept { return calls_->energy(bytes_); }
  [[nodiscard]] ph::parameter_fault<scalar> check() const noexcept { return calls_->check(bytes_); }

 private:
  static constexpr std::size_t capacity = 1024;

  struct calls {
    bool (*retarget)(void*, const constraint_type&);
    ph::tick_result<Space> (*tick)(void*, const ph::device_sample<Space>&);
    ph::tick_result<Space> (*tick_at)(void*, const vector&, scalar);
    const constraint_type& (*local)(const void*);
    scalar (*energy)(const void*);
    ph::parameter_fault<scalar> (*check)(const void*);
  };
  template <class Local>
  static Local& as(void* bytes) noexcept {
    return *static_cast<Local*>(bytes);
  }
  template <class Local>
  static const Local& as(const void* bytes) noexcept {
    return *static_cast<const Local*>(bytes);
  }
  template <class Local>
  static constexpr calls table{
      [](void* m, const constraint_type& next) { return as<Local>(m).retarget(next); },
      [](void* m, const ph::device_sample<Space>& sample) { return as<Local>(m).tick(sample); },
      [](void* m, const vector& x, scalar dt) { return as<Local>(m).tick(x, dt); },
      [](const void* m) -> const constraint_type& { return as<Local>(m).local(); },
      [](const void* m) { return as<Local>(m).energy(); },
      [](const void* m) { return as<Local>(m).check(); }};

  const calls* calls_;
  alignas(std::max_align_t) std::byte bytes_[capacity];
};

}  // namespace controllers
