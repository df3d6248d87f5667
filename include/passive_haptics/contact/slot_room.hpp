// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Slots for surfaces of one or several kinds, a fixed number of each, for contact_set and rigid_tool.

#include <passive_haptics/contact/row.hpp>

#include <array>
#include <concepts>
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
  /// Calls act(slot) for the i-th slot of that kind, if there is one.
  template <class Surface>
  constexpr void visit(int i, auto act) noexcept {
    static_assert(
        kinds<Surface> == 1,
        "passive_haptics: contact_set has no slots<Surface, Count> for a surface of this kind, or "
        "two of them");
    if constexpr (kinds<Surface> == 1) {
      auto& all = group<Surface>(*this);
      if (i >= 0 && static_cast<std::size_t>(i) < all.size()) act(all[static_cast<std::size_t>(i)]);
    }
  }
  /// The i-th slot of that kind, 0 ≤ i < Count.
  template <class Surface>
  [[nodiscard]] constexpr const Slot<Surface>& slot(int i) const noexcept {
    return group<Surface>(*this)[static_cast<std::size_t>(i)];
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
