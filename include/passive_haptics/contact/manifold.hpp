// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Assigns the surfaces of a collision search, whose number and order change every time, to the slots of a set of
// contacts. A slot follows its own surface with a limited rate, so each surface has to return to its slot.
//
//     ph::contact_manifold<ph::half_space<scene>, 8> seen;        // beside the port, in the haptic thread
//     seen.show(port.source(), surfaces, position);               // at every update, with all surfaces
//     seen.show(port.source(), surfaces, position, ids);          // if the search has ids for them
//     seen.show(tool.source(), surfaces, points, pose);           // a rigid_tool: a point for each surface
//
// Surfaces are compared at the device's position x:
//
//     c = |d_told(x) − d_slot(x)| + ℓ |n_told(x) − n_slot(x)|  [m]        the same if c ≤ the gate          (M1)
//
// First, equal ids are matched, for any c; then pairs in the order of rising c (a stable matching, independent of the
// order of the surfaces). A surface without a match takes a free slot, or else the slot with the smallest force; a
// slot without a surface is released. A slot that is still receding may be matched. Of more surfaces than slots
// the deepest are kept, and of two in one place the stiffer. Source (ours) and cost: docs/design/contacts.md.

#include <passive_haptics/contact/contact_engine.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace passive_haptics {
inline namespace v0 {

/// The tolerances by which a surface is recognised again.
struct same_surface {
  double within = 0.01;  ///< the gate, largest c of (M1) of the same surface [m]
  double lever = 0.02;   ///< ℓ, depth that a turn of the normal by 1 rad counts as [m]
  double stay = 1e-3;    ///< how much deeper a surface must be to replace one in a slot [m]
  double twin = 1e-6;    ///< largest c of two surfaces that count as one [m]

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    if (!detail::positive(within)) return {"within", within, "finite and > 0 m"};
    if (!detail::positive(lever)) return {"lever", lever, "finite and > 0 m"};
    if (!detail::not_negative(stay)) return {"stay", stay, "finite and ≥ 0 m"};
    if (!detail::not_negative(twin)) return {"twin", twin, "finite and ≥ 0 m"};
    return {};
  }
};

/// The result of one update. The first five numbers add up to the number of surfaces.
struct manifold_news {
  int matched = 0;   ///< surfaces that returned to their slot
  int added = 0;     ///< surfaces with a new slot
  int refused = 0;   ///< unusable surfaces; the next tick has event::rejected_target, too
  int merged = 0;    ///< surfaces equal to one in a slot, with no slot left for a second
  int left_out = 0;  ///< surfaces shallower than all in slots, with no slot left
  int released = 0;  ///< slots whose surface has gone

  /// How many surfaces have a slot.
  [[nodiscard]] constexpr int taken() const noexcept { return matched + added; }
};

namespace detail {

/// The number of slots of a source for that kind of surface.
template <class Surface, class Spring, class Friction, class... Groups>
[[nodiscard]] constexpr int room_for(
    const contact_parameters<Spring, Friction, Groups...>* /*p*/) noexcept {
  return (0 + ... + (std::same_as<Surface, typename Groups::surface_type> ? Groups::count : 0));
}

}  // namespace detail

/// Assigns surfaces to the first `Count` slots of their kind of a contact_set or a rigid_tool, and leaves the others.
template <class Surface, int Count, class Space = typename Surface::space_type>
requires(Count >= 1 && surface_for<Surface, Space>) class contact_manifold {
 public:
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  using id_type = std::uint64_t;                ///< a face, a feature, a pair of bodies
  static constexpr id_type no_id = ~id_type{};  ///< the id of a surface without one

  constexpr contact_manifold() noexcept : contact_manifold(same_surface{}) {}
  constexpr explicit contact_manifold(const same_surface& rule) noexcept
      : rule_(rule),
        within_(detail::number<scalar>(rule.within)),
        lever_(detail::number<scalar>(rule.lever)),
        stay_(detail::number<scalar>(rule.stay)),
        twin_(detail::number<scalar>(rule.twin)) {
    ids_.fill(no_id);
  }
  [[nodiscard]] constexpr same_surface parameters() const noexcept { return rule_; }
  [[nodiscard]] constexpr parameter_fault check() const noexcept { return rule_.check(); }

  /// Takes all present surfaces, in any order, for a contact_set whose device is at x [m], with as many ids as
  /// surfaces, or none. An unusable one is refused; if its id is known, its slot keeps the last good surface.
  template <class Source>
  constexpr manifold_news show(Source& source, std::span<const Surface> surfaces, const vector& x,
                               std::span<const id_type> ids = {}) noexcept {
    return match(source, surfaces, at_device{x}, ids);
  }
  /// The same for a rigid_tool: each surface is for a point of the tool, in the frame of the handle [m], and
  /// `pose` is the handle's. Surfaces without a point are refused. The distance of two points is added to c in (M1).
  template <class Source, class Pose>
  manifold_news show(Source& source, std::span<const Surface> surfaces,
                     std::span<const typename Source::point> points, const Pose& pose,
                     std::span<const id_type> ids = {}) noexcept {
    return match(source, surfaces, on_tool<Source, Pose>{points, pose}, ids);
  }

 private:
  static constexpr auto cells = static_cast<std::size_t>(Count);
  static constexpr std::size_t nobody = ~std::size_t{};

  /// For a contact_set, every surface is touched at the device's position.
  struct at_device {
    static constexpr bool apart = false;
    const vector& x;
    [[nodiscard]] constexpr bool is_finite() const noexcept { return Space::is_finite(x); }
    [[nodiscard]] constexpr bool has(std::size_t /*k*/) const noexcept { return true; }
    [[nodiscard]] constexpr vector told(std::size_t /*k*/) const noexcept { return x; }
    [[nodiscard]] constexpr vector of(const auto& /*slot*/) const noexcept { return x; }
    static constexpr void refuse(auto& source) noexcept { (void)source.update(-1, Surface{}); }
    constexpr bool put(auto& source, int i, std::size_t /*k*/, const Surface& s) const noexcept {
      return source.update(i, s);
    }
  };
  /// For a rigid_tool, each surface is touched at a point of the tool.
  template <class Tool, class Pose>
  struct on_tool {
    static constexpr bool apart = true;
    std::span<const typename Tool::point> points;
    const Pose& pose;
    [[nodiscard]] bool is_finite() const noexcept {
      return Space::is_finite(Tool::place(pose, {}));
    }
    [[nodiscard]] bool has(std::size_t k) const noexcept { return k < points.size(); }
    [[nodiscard]] vector told(std::size_t k) const noexcept { return Tool::place(pose, points[k]); }
    [[nodiscard]] vector of(const auto& slot) const noexcept {
      return Tool::place(pose, slot.point);
    }
    static void refuse(auto& source) noexcept {
      (void)source.update(-1, typename Tool::point{}, Surface{});
    }
    bool put(auto& source, int i, std::size_t k, const Surface& s) const noexcept {
      return source.update(i, points[k], s);
    }
  };

  /// A surface at the device's position.
  struct view {
    vector normal = Space::zero();
    vector place = Space::zero();  ///< [m]
    scalar depth{};                ///< [m]
    scalar stiffness{};            ///< [N/m]
    bool covers = false;

    constexpr view() noexcept = default;
    constexpr view(const Surface& surface, const vector& x) noexcept
        : place(x), stiffness(surface.stiffness) {
      const auto shown = surface.at(x);
      normal = shown.outward();
      depth = shown.depth;
      covers = shown.covered();
    }
    [[nodiscard]] constexpr bool is_finite() const noexcept {
      return kernels::is_finite(depth) && Space::is_finite(normal);
    }
  };
  /// A surface that may get a slot.
  struct candidate {
    view seen;
    std::size_t number{};  ///< its number in the update
    scalar rank{};         ///< its depth less its distance c from the slots [m]
    bool twin = false;     ///< in the place of another candidate that is no softer
    bool placed = false;
  };
  struct frame_state {
    std::array<view, cells> slot;          ///< the surface in each slot
    std::array<bool, cells> filled{};      ///< the slot has a surface
    std::array<candidate, cells> told;     ///< the candidates
    std::array<std::size_t, cells> by;     ///< the candidate that each slot belongs to
    std::array<scalar, cells> bar;         ///< largest c with which a candidate takes the slot [m]
    std::array<std::size_t, cells> order;  ///< the open slots, the shallowest first
    std::size_t open = 0;                  ///< number of open slots
    std::array<bool, cells> kept{};        ///< its surface came, and was unusable
    std::size_t count = 0;                 ///< number of candidates
    std::size_t worst = 0;                 ///< the candidate that is dropped first
  };

  /// c of (M1) [m], or more than `most` if it is above that. Two surfaces in one place are told apart by stiffness.
  template <bool Apart>
  [[nodiscard]] constexpr scalar cost(const view& a, const view& b, scalar most) const noexcept {
    scalar c = kernels::magnitude(a.depth - b.depth);
    if constexpr (Apart) c += Space::norm(vector(a.place - b.place));
    if (c < most) {
      c += lever_ * Space::norm(vector(a.normal - b.normal));
      c += twin_ * kernels::magnitude(a.stiffness - b.stiffness) / (a.stiffness + b.stiffness);
    }
    return c;
  }

  template <class Source, class Where>
  constexpr manifold_news match(Source& source, std::span<const Surface> surfaces,
                                const Where& where, std::span<const id_type> ids) noexcept {
    static_assert(
        detail::room_for<Surface>(static_cast<typename Source::parameters_type*>(nullptr)) >= Count,
        "passive_haptics: contact_manifold has more places than the source has slots for a surface "
        "of this kind");
    manifold_news news;
    if (!where.is_finite()) {
      where.refuse(source);  // no such slot: the next tick has rejected_target
      news.refused = static_cast<int>(surfaces.size());
      return news;
    }
    const auto id_of = [&](std::size_t k) { return k < ids.size() ? ids[k] : no_id; };
    const auto slot_at = [&](std::size_t i) -> const auto& {
      return source.template slot<Surface>(static_cast<int>(i));
    };
    frame_state now;
    for (std::size_t i = 0; i < cells; ++i) {
      const auto& slot = slot_at(i);
      now.by[i] = nobody;
      if (slot.taken()) {
        now.slot[i] = view(slot.target(), where.of(slot));
        now.filled[i] = now.slot[i].is_finite();
      } else {
        told_[i] = false;
        ids_[i] = no_id;
      }
    }

    // Selects the candidates, in O(surfaces · slots).
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      Surface usable = surfaces[k];
      candidate next;
      next.number = k;
      bool good = where.has(k) && usable.prepare();
      if (good) {
        const vector x = where.told(k);
        next.seen = view(usable, x);
        good = Space::is_finite(x) && next.seen.is_finite();
      }
      if (good) {
        choose<Where::apart>(now, next, surfaces.size() > cells, id_of(k), news);
      } else {
        ++news.refused;
        for (std::size_t i = 0; i < cells; ++i)
          now.kept[i] = now.kept[i] || (ids_[i] != no_id && ids_[i] == id_of(k));
        where.refuse(source);
      }
    }

    const auto same_id = [&](std::size_t i, std::size_t k) {
      return ids_[i] != no_id && ids_[i] == id_of(now.told[k].number);
    };
    if (!ids.empty()) claim_all<Where::apart>(now, kernels::largest<scalar>(), same_id);
    claim_all<Where::apart>(now, within_, [](std::size_t, std::size_t) { return true; });

    for (std::size_t i = 0; i < cells; ++i) {
      if (now.by[i] != nobody) {
        news.matched += put(source, where, surfaces, now, i, id_of, news);
      } else if (told_[i] && !now.kept[i]) {
        source.template release<Surface>(static_cast<int>(i));
        told_[i] = false;
        ++news.released;
      }
    }
    for (std::size_t k = 0; k < now.count; ++k) {
      if (now.told[k].placed) continue;
      std::size_t i = nobody;  // the slot with the smallest force
      for (std::size_t j = 0; j < cells; ++j) {
        if (now.by[j] != nobody || now.kept[j]) continue;
        if (i == nobody || slot_at(j).pressed() < slot_at(i).pressed()) i = j;
      }
      if (i == nobody) {
        ++news.left_out;
        continue;
      }
      now.by[i] = k;
      news.added += put(source, where, surfaces, now, i, id_of, news);
    }
    return news;
  }

  /// Adds a candidate, if there is room; else it replaces one that came twice, or the shallowest one.
  template <bool Apart>
  constexpr void choose(frame_state& now, candidate& next, bool crowded, id_type id,
                        manifold_news& news) const noexcept {
    if (!crowded) {
      now.told[now.count++] = next;
      return;
    }
    next.rank = next.seen.depth;
    const bool full = now.count == cells;
    if (full && before(next, now.told[now.worst])) {  // whatever its distance from the slots is
      ++news.left_out;
      return;
    }
    scalar away = stay_;
    for (std::size_t i = 0; i < cells; ++i) {
      if (!now.filled[i]) continue;
      away = kernels::smaller(away, cost<Apart>(now.slot[i], next.seen, away));
      if (id != no_id && ids_[i] == id) away = scalar(0);
    }
    next.rank -= away;
    for (std::size_t k = 0; k < now.count; ++k) {  // of two in one place the softer is hardly felt
      if (cost<Apart>(now.told[k].seen, next.seen, twin_) > twin_) continue;
      (now.told[k].seen.stiffness < next.seen.stiffness ? now.told[k] : next).twin = true;
      if (before(now.told[k], now.told[now.worst])) now.worst = k;
    }
    if (full) {
      ++(next.twin || now.told[now.worst].twin ? news.merged : news.left_out);
      if (!before(now.told[now.worst], next)) return;
    }
    now.told[full ? now.worst : now.count++] = next;
    now.worst = 0;
    for (std::size_t k = 1; k < now.count; ++k)
      if (before(now.told[k], now.told[now.worst])) now.worst = k;
  }
  /// True if a is dropped before b: twins first, then surfaces that do not cover the device, then shallower ones.
  [[nodiscard]] static constexpr bool before(const candidate& a, const candidate& b) noexcept {
    if (a.twin != b.twin) return a.twin;
    if (a.seen.covers != b.seen.covers) return b.seen.covers;
    return a.rank < b.rank;
  }
  /// Opens slots without an owner to candidates with c below `gate` [m], in the order of their depths.
  constexpr void open(frame_state& now, scalar gate) const noexcept {
    now.open = 0;
    for (std::size_t i = cells; i-- > 0;) {  // of two at one depth the first comes first
      if (!now.filled[i] || now.kept[i] || now.by[i] != nobody) continue;
      now.bar[i] = gate;
      const std::size_t at = first_no_shallower(now, now.slot[i].depth);
      for (std::size_t last = now.open++; last > at; --last) now.order[last] = now.order[last - 1];
      now.order[at] = i;
    }
  }
  /// The first of the open slots, in their order, that is no shallower than `depth` [m].
  [[nodiscard]] static constexpr std::size_t first_no_shallower(const frame_state& now,
                                                                scalar depth) noexcept {
    std::size_t low = 0, high = now.open;
    while (low < high) {
      const std::size_t half = (low + high) / 2;
      if (now.slot[now.order[half]].depth < depth) {
        low = half + 1;
      } else {
        high = half;
      }
    }
    return low;
  }
  /// A candidate without a slot takes the nearest open slot whose owner has a larger c; that owner then looks for its
  /// next nearest (stable matching). |Δd| ≤ c, so the slots are tried from its own depth up, and from there down.
  template <bool Apart>
  constexpr void claim_all(frame_state& now, scalar gate, const auto& may) const noexcept {
    open(now, gate);
    for (std::size_t first = 0; first < now.count; ++first) {
      std::size_t k = now.told[first].placed ? nobody : first;
      while (k != nobody) {
        const view& seen = now.told[k].seen;
        std::size_t mine = nobody;
        scalar least = gate;
        const auto in_reach = [&](std::size_t i) {
          if (!(kernels::magnitude(now.slot[i].depth - seen.depth) < least)) return false;
          const scalar most = kernels::smaller(now.bar[i], least);
          if (!(most > scalar(0)) || !may(i, k)) return true;
          const scalar c = cost<Apart>(now.slot[i], seen, most);
          if (!(c < most)) return true;
          mine = i;
          least = c;
          return true;
        };
        const std::size_t own = first_no_shallower(now, seen.depth);
        for (std::size_t n = own; n < now.open && in_reach(now.order[n]);) ++n;
        for (std::size_t n = own; n > 0 && in_reach(now.order[n - 1]);) --n;
        if (mine == nobody) break;
        now.bar[mine] = least;
        now.told[k].placed = true;
        k = std::exchange(now.by[mine], k);
        if (k != nobody) now.told[k].placed = false;
      }
    }
  }
  /// Updates slot i with its surface; returns 1 if that is accepted.
  constexpr int put(auto& source, const auto& where, std::span<const Surface> surfaces,
                    const frame_state& now, std::size_t i, const auto& id_of,
                    manifold_news& news) noexcept {
    const std::size_t k = now.told[now.by[i]].number;
    if (!where.put(source, static_cast<int>(i), k, surfaces[k])) {
      ++news.refused;
      return 0;
    }
    told_[i] = true;
    ids_[i] = id_of(k);
    return 1;
  }

  same_surface rule_;
  scalar within_, lever_, stay_, twin_;  ///< [m]
  std::array<id_type, cells> ids_{};     ///< id of the last surface of each slot
  std::array<bool, cells> told_{};       ///< its surface was in the last update
};

}  // namespace v0
}  // namespace passive_haptics
