// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One type for every local model over a half-space, so that scenes and sweeps compile once.

#include <passive_haptics/passive_haptics.hpp>

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace controllers {

namespace ph = passive_haptics;

/// Any local_model<Space, followed<half_space<Space>>, …>, as a value: copying it copies the state.
template <class Space>
class model {
 public:
  using space_type = Space;
  using constraint_type = ph::half_space<Space>;
  using result_type = ph::tick_result<Space>;
  using sample_type = ph::device_sample<Space>;

  template <class Local>
  requires(!std::same_as<Local, model>) model(const Local& local)
  noexcept  // NOLINT: the same thing
      : calls_(&table<Local>) {
    static_assert(std::is_trivially_copyable_v<Local> && sizeof(Local) <= sizeof(bytes_) &&
                  alignof(Local) <= alignof(std::max_align_t));
    std::memcpy(bytes_, &local, sizeof(Local));
  }

  bool update(const constraint_type& next) noexcept { return calls_->update(bytes_, next); }
  [[nodiscard]] result_type tick(const sample_type& s) noexcept { return calls_->tick(bytes_, s); }
  [[nodiscard]] const constraint_type& local() const noexcept { return calls_->local(bytes_); }
  [[nodiscard]] typename Space::scalar energy() const noexcept { return calls_->energy(bytes_); }
  [[nodiscard]] ph::parameter_fault check() const noexcept { return calls_->check(bytes_); }

 private:
  struct calls {
    bool (*update)(void*, const constraint_type&);
    result_type (*tick)(void*, const sample_type&);
    const constraint_type& (*local)(const void*);
    typename Space::scalar (*energy)(const void*);
    ph::parameter_fault (*check)(const void*);
  };
  template <class Local>
  static constexpr calls table{
      [](void* m, const constraint_type& c) -> bool { return static_cast<Local*>(m)->update(c); },
      [](void* m, const sample_type& s) -> result_type { return static_cast<Local*>(m)->tick(s); },
      [](const void* m) -> const constraint_type& { return static_cast<const Local*>(m)->local(); },
      [](const void* m) { return static_cast<const Local*>(m)->energy(); },
      [](const void* m) { return static_cast<const Local*>(m)->check(); }};

  const calls* calls_;
  alignas(std::max_align_t) std::byte bytes_[2048];
};

}  // namespace controllers
