// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Slots for surfaces of one or several kinds, a fixed number of each, for contact_set and rigid_tool.

#include <passive_haptics/contact/row.hpp>

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <tuple>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// `Count` slots for surfaces of one kind.
template <class Surface, int Count>
requires(Count >= 1) struct slots {
  using surface_type = Surface;
  static constexpr int count = Count;
};

namespace detail {

/// A bit for each of so many slots, all set at first.
template <int Count>
class slot_bits {
 public:
  constexpr slot_bits() noexcept { words_.fill(~0U); }
  [[nodiscard]] constexpr bool has(std::size_t i) const noexcept {
    return (words_[i / 32] >> i % 32 & 1U) != 0;
  }
  [[nodiscard]] constexpr bool all() const noexcept {
    for (const std::uint32_t word : words_) {
      if (word != ~0U) return false;
    }
    return true;
  }
  constexpr void set(std::size_t i) noexcept { words_[i / 32] |= 1U << i % 32; }
  constexpr void clear(std::size_t i) noexcept { words_[i / 32] &= ~(1U << i % 32); }
  /// The first number whose bit is set, from i on, or `end`; i < end ≤ `Count`.
  [[nodiscard]] constexpr std::size_t next(std::size_t i, std::size_t end) const noexcept {
    for (; i < end; i = (i / 32 + 1) * 32) {
      const std::uint32_t bits = words_[i / 32] >> i % 32;
      if (bits != 0) return i + static_cast<std::size_t>(std::countr_zero(bits));
    }
    return end;
  }

 private:
  std::array<std::uint32_t, (static_cast<std::size_t>(Count) + 31) / 32> words_{};
};

/// One `Slot<Surface>` for each slot of the groups.
template <template <class Surface> class Slot, class... Groups>
class slot_room {
  template <class Surface>
  static constexpr int kinds = (0 + ... +
                                int(std::same_as<Surface, typename Groups::surface_type>));
  template <class Group>
  using room =
      std::array<Slot<typename Group::surface_type>, static_cast<std::size_t>(Group::count)>;

 public:
  static constexpr int capacity = (0 + ... + Groups::count);
  using first_kind = std::tuple_element_t<0, std::tuple<typename Groups::surface_type...>>;

  /// Calls act(slot, number) for all slots, kind by kind.
  constexpr void for_each(auto act) noexcept { each(*this, act); }
  constexpr void for_each(auto act) const noexcept { each(*this, act); }
  /// The same for those of them whose bit is set. One loop for both costs a set up to 7 % more.
  constexpr void for_each_of(const slot_bits<capacity>& chosen, auto act) noexcept {
    std::size_t first = 0;
    const auto one = [&](auto& group) {
      const std::size_t end = first + group.size();
      for (std::size_t i = first; (i = chosen.next(i, end)) < end; ++i) act(group[i - first], i);
      first = end;
    };
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (one(detail::get<I>(groups_)), ...);
    }
    (std::index_sequence_for<Groups...>{});
  }
  /// Calls act(slot, number) for the i-th slot of that kind, if there is one.
  template <class Surface>
  constexpr void visit(int i, auto act) noexcept {
    static_assert(
        kinds<Surface> == 1,
        "passive_haptics: contact_set has no slots<Surface, Count> for a surface of this kind, or "
        "two of them");
    if constexpr (kinds<Surface> == 1) {
      auto& all = group<Surface>(*this);
      const auto at = static_cast<std::size_t>(i);
      if (i >= 0 && at < all.size()) act(all[at], first<Surface>() + at);
    }
  }
  /// The i-th slot of that kind, 0 ≤ i < Count.
  template <class Surface>
  [[nodiscard]] constexpr const Slot<Surface>& slot(int i) const noexcept {
    return group<Surface>(*this)[static_cast<std::size_t>(i)];
  }

  /// The number of the first slot of that kind.
  template <class Surface, std::size_t I = 0>
  [[nodiscard]] static constexpr std::size_t first() noexcept {
    using here = std::tuple_element_t<I, std::tuple<Groups...>>;
    if constexpr (std::same_as<typename here::surface_type, Surface>) {
      return 0;
    } else {
      return here::count + first<Surface, I + 1>();
    }
  }

 private:
  static constexpr void each(auto& self, auto& act) noexcept {
    std::size_t number = 0;
    const auto one = [&](auto& group) {
      for (auto& slot : group) act(slot, number++);
    };
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (one(detail::get<I>(self.groups_)), ...);
    }
    (std::index_sequence_for<Groups...>{});
  }
  template <class Surface, class Self, std::size_t I = 0>
  [[nodiscard]] static constexpr auto& group(Self& self) noexcept {
    using here = std::tuple_element_t<I, std::tuple<Groups...>>;
    if constexpr (std::same_as<typename here::surface_type, Surface>) {
      return detail::get<I>(self.groups_);
    } else {
      return group<Surface, Self, I + 1>(self);
    }
  }

  row<room<Groups>...> groups_{};
};

}  // namespace detail
}  // namespace v0
}  // namespace passive_haptics
