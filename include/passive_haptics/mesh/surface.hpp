// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Triangles that fingers touch while another thread moves them.
//
//     ph::mesh::surface organ(triangles, nodes);     // any thread, once
//     if (!organ.update(nodes)) log(organ.fault());  // slow thread, whenever the nodes have moved
//     organ.update(pose);                            // slow thread, where the whole of it has moved
//     ph::mesh::surface knee(triangles, nodes, {.materials = {bone, skin}, .of = of_triangle});
//     knee.update(ph::mesh::made_of{.materials = {bone, callus}, .of = of_triangle});
//     ph::mesh::surface ball(triangles, nodes, ph::mesh::smooth{.crease = 0.7});  // smooth.hpp
//
// The slow thread copies the nodes and fits the boxes of the tree. Each finger takes the newest shape as soon as it
// has arrived at the one that it took before, and no thread waits for another (news.hpp). No side is the outside: a
// surface may be open, inside out, or cross itself, have three triangles at an edge, or triangles without an area.
// An input that is no mesh is refused with a sentence, and the last good one stays.

#include <passive_haptics/base/foresight.hpp>
#include <passive_haptics/mesh/box_tree.hpp>
#include <passive_haptics/mesh/material.hpp>
#include <passive_haptics/mesh/news.hpp>
#include <passive_haptics/mesh/pose.hpp>
#include <passive_haptics/mesh/smooth.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace mesh {

/// The numbers of three nodes.
using triangle = std::array<int, 3>;

/// What the triangles are made of. Without it a mesh is of one material, that who touches it states.
struct made_of {
  std::vector<material> materials;  ///< at most 256
  std::vector<std::uint8_t> of;     ///< the number of each triangle's

  /// What is wrong with it for a mesh of so many triangles and what to do, or an empty text.
  [[nodiscard]] std::string check(std::size_t triangles) const {
    if (materials.empty() && of.empty()) return {};
    if (materials.empty() || materials.size() > 256) {
      return "mesh: " + std::to_string(materials.size()) + " materials; give 1 to 256";
    }
    if (of.size() != triangles) {
      return "mesh: materials for " + std::to_string(of.size()) + " of " +
             std::to_string(triangles) + " triangles; give a number for each";
    }
    for (std::size_t i = 0; i < materials.size(); ++i) {
      if (const auto fault = materials[i].check()) {
        return "mesh: of material " + std::to_string(i) + " the " + fault.parameter + " is " +
               std::to_string(fault.value) + "; give one that is " + fault.remedy;
      }
    }
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (of[i] >= materials.size()) {
        return "mesh: triangle " + std::to_string(i) + " is of material " + std::to_string(of[i]) +
               " of " + std::to_string(materials.size()) + "; count materials from 0";
      }
    }
    return {};
  }
};

/// The nodes at one time, and the boxes around them.
struct shape {
  std::vector<triple> nodes;
  std::vector<box> boxes;
  std::vector<triple> normals;  ///< of a smooth mesh (smooth.hpp)
  detail::bulge bulge;
  double steady = 0.0;  ///< share() of the news (base/foresight.hpp)
};

/// A pose, and its age when it was told, in units of the time since the one before.
struct told_pose {
  pose where{};
  double late = 0.0;
};

namespace detail {
/// The nodes of any container whose elements have [0], [1] and [2], or x, y and z.
template <class Nodes>
[[nodiscard]] triple node_of(const Nodes& nodes, std::size_t i) {
  using node = std::remove_cvref_t<decltype(nodes[i])>;
  if constexpr (std::convertible_to<node, triple>) {
    return nodes[i];
  } else if constexpr (requires(const node& p) { static_cast<double>(p[2]); }) {
    return {static_cast<double>(nodes[i][0]), static_cast<double>(nodes[i][1]),
            static_cast<double>(nodes[i][2])};
  } else {
    constexpr bool has_names = requires(const node& p) {
      static_cast<double>(p.x + p.y + p.z);
    };
    static_assert(has_names,
                  "passive_haptics: each node of a mesh has three numbers: give a std::vector of "
                  "std::array<double, 3>, Eigen::Vector3d or of what has x, y and z");
    if constexpr (has_names) {
      return {static_cast<double>(nodes[i].x), static_cast<double>(nodes[i].y),
              static_cast<double>(nodes[i].z)};
    } else {
      return {};
    }
  }
}

/// The data that a surface shares with the fingers that touch it.
struct world {
  world(std::vector<std::array<int, 3>> t, box_tree around)
      : triangles(std::move(t)), tree(std::move(around)) {}

  std::vector<std::array<int, 3>> triangles;
  box_tree tree;
  neighbours smooth;  ///< none of a mesh that is not
  news<made_of> stuffs;
  news<shape> shapes;
  news<told_pose> poses;

  /// The numbers of the shapes that one finger holds, `from` which and `to` which it goes (the same one while it
  /// rests), of its materials, and of its pose; −1 is none.
  struct seat {
    std::atomic<bool> taken{false};
    int from = 0, to = 0, stuff = 0, pose = -1;
  };
  std::array<seat, std::size_t{news<shape>::most_readers}> seats;
  std::atomic<int> readers{0};
};
}  // namespace detail

class surface {
 public:
  static constexpr std::size_t most_triangles = 50'000'000;

  /// What is wrong with a mesh and what to do, or an empty text. Nodes [m] are std::array<double, 3>,
  /// Eigen::Vector3d, mesh::triple: whatever has three numbers.
  template <class Nodes>
  [[nodiscard]] static std::string check(std::span<const triangle> triangles, const Nodes& nodes) {
    const std::size_t count = nodes.size();
    std::string fault = check_count(triangles.size());
    if (fault.empty()) fault = not_finite(nodes);
    if (!fault.empty()) return fault;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (const int node : triangles[i]) {
        if (node < 0 || static_cast<std::size_t>(node) >= count) {
          return "mesh: triangle " + std::to_string(i) + " names node " + std::to_string(node) +
                 " of " + std::to_string(count) + "; count nodes from 0";
        }
      }
    }
    return no_area(triangles, nodes);
  }

  /// What is possible for a mesh and almost surely a slip, as millimetres for metres, or an empty text.
  template <class Nodes>
  [[nodiscard]] static std::string doubt(const Nodes& nodes) {
    double widest = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const triple off = detail::node_of(nodes, i) - detail::node_of(nodes, 0);
      for (const double way : {off.x, off.y, off.z}) widest = (std::max)(widest, std::fabs(way));
    }
    if (widest > 10.0) {
      return "mesh: it is " + in_words(widest) +
             " m wide, so a finger may meet nothing of it; give metres, not millimetres";
    }
    if (widest < 1e-3) {
      return "mesh: it is " + in_words(widest) +
             " m wide, so a finger feels nothing of its shape; give metres";
    }
    const double off = nodes.size() > 0 ? length(detail::node_of(nodes, 0)) : 0.0;
    if (!(off > 100.0)) return {};
    return "mesh: it lies " + in_words(off) +
           " m from the origin, where no device goes; give metres in the device's frame";
  }
  /// The same for a number of triangles whose nodes move: an update takes 3 ms for 100 000, 60 ms for a million.
  [[nodiscard]] static std::string doubt_count(std::size_t triangles) {
    if (triangles <= 1'000'000) return {};
    return "mesh: its " + std::to_string(triangles) + " triangles take about " +
           in_words(std::round(6e-6 * static_cast<double>(triangles)) / 100.0) +
           " s an update, too long for 20 news a second; give a coarser one, or move it by poses";
  }

  /// The same for a number of triangles.
  [[nodiscard]] static std::string check_count(std::size_t triangles) {
    if (triangles == 0) {
      return "mesh: it has no triangles, so nothing can be touched; give one at least";
    }
    if (triangles > most_triangles) {
      return "mesh: " + std::to_string(triangles) + " triangles are more than " +
             std::to_string(most_triangles) + "; give a coarser one";
    }
    return {};
  }

  /// The mesh must pass check(), and so must what it is made of; a sentence is thrown as std::invalid_argument. It is
  /// felt as facets, or smooth between creases (smooth.hpp). A surface cannot be copied or moved, because fingers hold
  /// its address.
  template <class Nodes>
  surface(std::vector<triangle> triangles, const Nodes& nodes, made_of stuff = {})
      : world_(made(std::move(triangles), nodes, stuff)), count_(nodes.size()) {
    publish(nodes, std::move(stuff));
  }
  template <class Nodes>
  surface(std::vector<triangle> triangles, const Nodes& nodes, made_of stuff,
          std::optional<smooth> rounded)
      : world_(made(std::move(triangles), nodes, stuff)), count_(nodes.size()) {
    if (rounded) smoothen(*rounded, nodes);
    publish(nodes, std::move(stuff));
  }
  template <class Nodes, std::same_as<smooth> Smooth>
  surface(std::vector<triangle> triangles, const Nodes& nodes, const Smooth& rounded)
      : surface(std::move(triangles), nodes, made_of{}, rounded) {}
  /// Does not compile: triangles of another type.
  template <class Triangles, class Nodes, class... Rest>
  requires(!std::convertible_to<const Triangles&, std::vector<triangle>>)
      surface(const Triangles& /*triangles*/, const Nodes& nodes, const Rest&... rest)
      : surface(std::vector<triangle>(), nodes, rest...) {
    static_assert(!std::same_as<Triangles, Triangles>,
                  "passive_haptics: the triangles of a mesh are a std::vector of "
                  "mesh::triangle, each three node numbers as int");
  }
  surface(const surface&) = delete;
  surface& operator=(const surface&) = delete;

  // ------------------------------------------------------------------------------------ the slow thread
  using clock = std::chrono::steady_clock;
  /// Moves the nodes to these places [m]. If it returns false, fault() says why, and the last good shape stays. After
  /// a few good updates it does not allocate, as long as every finger keeps up.
  template <class Nodes>
  requires requires(const Nodes& n) { n.size(); }
  bool update(const Nodes& nodes) {
    if (nodes.size() != count_) {
      fault_ = "mesh: news of " + std::to_string(nodes.size()) + " nodes for a mesh of " +
               std::to_string(count_) + "; make another mesh::surface of them and touch() it";
      return false;
    }
    std::string fault = not_finite(nodes);
    if (fault.empty()) fault = no_area(world_->triangles, nodes);
    if (!fault.empty()) {
      fault_ = std::move(fault);
      return false;
    }
    tell(nodes);
    fault_.clear();
    return true;
  }
  /// Moves the whole mesh to this pose. It returns false if a number is not finite, if the place is farther than 1000 km,
  /// or if the quaternion has no length.
  bool update(pose where) {
    const pose told = where;
    if (!where.prepare() || !(squared(where.position) < 1e12)) {
      const auto& [place, w, axis] = told;
      fault_ = "mesh: the pose at " + in_words({place.x, place.y, place.z}) + " m, turned by " +
               in_words({w, axis.x, axis.y, axis.z}) +
               ", has a number that is not finite, is farther than 1000 km, or has a quaternion "
               "without a length; give metres and w, x, y, z";
      return false;
    }
    world_->poses.blank() = {where, late_};
    world_->poses.publish();
    fault_.clear();
    return true;
  }
  /// Makes the triangles of other materials or, if there are none, of what who touches them states. A finger takes them
  /// in its next tick. It returns false if they do not fit.
  bool update(const made_of& stuff) {
    fault_ = stuff.check(world_->triangles.size());
    if (!fault_.empty()) return false;
    world_->stuffs.blank() = stuff;
    world_->stuffs.publish();
    return true;
  }
  /// The same for nodes or a pose of the time `at`, so that what goes on steadily is felt where it is by now. It also
  /// returns false if later news were told before, or if `at` is in the future.
  bool update(const auto& there, clock::time_point at) {
    if (!in_order(at)) return false;
    const double since = ms(last_, at);
    late_ = since > 0.0 ? (std::min)(ms(at, clock::now()) / since, 2.0) : 0.0;
    const bool good = update(there);
    late_ = 0.0;
    if (good) last_ = at;
    return good;
  }
  /// What is doubtful of the nodes that were told last, as above, or of where they have gone: triangles that have left
  /// those beside which they were made are found slowly. It takes as long as making the mesh.
  [[nodiscard]] std::string doubt() const {
    const detail::world& w = *world_;
    const shape& now = w.shapes[w.shapes.told()];
    if (std::string of_nodes = doubt(now.nodes); !of_nodes.empty()) return of_nodes;
    if (!way_.empty()) {  // nodes have moved
      if (std::string slow = doubt_count(w.triangles.size()); !slow.empty()) return slow;
    }
    const box_tree anew(centres(w.triangles, now.nodes));
    std::vector<box> boxes;
    fit_boxes(boxes, anew, w.triangles, now.nodes);
    const auto looked_at = [](const std::vector<box>& all) {  // in proportion to their area
      double area = 0.0;
      for (const box& b : all) area += b.half_area();
      return area;
    };
    const double times = looked_at(now.boxes) / looked_at(boxes);
    if (!(times > 4.0)) return {};
    return "mesh: its triangles have left those beside which they were made, so a tick looks at " +
           in_words(std::round(times)) +
           " times as many as it need; make another mesh of these nodes and touch that one";
  }
  /// Why the last update was refused; empty if it was not.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
  [[nodiscard]] std::span<const triangle> triangles() const noexcept { return world_->triangles; }

  // --------------------------------------------------------------------------------- the haptic threads
  /// One finger's hold on a surface, which must outlive it: one of most_readers places, and with it the shape that the
  /// finger comes from and the one that it goes to. A copy is the same finger. A finger that ends must call leave(), or
  /// its place stays taken.
  class reader {
   public:
    /// Takes a place; returns false if there were most_readers already.
    bool join(const surface& s) noexcept {
      detail::world* w = s.world_.get();
      for (std::size_t i = 0; i < w->seats.size(); ++i) {
        if (w->seats[i].taken.exchange(true)) continue;
        auto& mine = w->seats[i];
        const auto first = [](auto take) {
          int one = -1;
          while (one < 0) one = take();  // there is one since the surface was made
          return one;
        };
        mine.from = first([&] { return w->shapes.take_told(); });
        mine.stuff = first([&] { return w->stuffs.take(); });
        w->shapes.hold(mine.from);
        mine.to = mine.from;
        mine.pose = -1;
        w->readers.fetch_add(1);
        world_ = w;
        seat_ = &mine;
        return true;
      }
      return false;
    }
    void leave() noexcept {
      if (world_ == nullptr) return;
      world_->shapes.give_back(seat_->from);
      world_->shapes.give_back(seat_->to);
      world_->stuffs.give_back(seat_->stuff);
      if (seat_->pose >= 0) world_->poses.give_back(seat_->pose);
      world_->readers.fetch_sub(1);
      seat_->taken.store(false);
      world_ = nullptr;
    }
    [[nodiscard]] bool reads(const surface& s) const noexcept { return world_ == s.world_.get(); }
    [[nodiscard]] const detail::world& mesh() const noexcept { return *world_; }
    [[nodiscard]] bool has_news() const noexcept { return world_->shapes.told() != seat_->to; }
    [[nodiscard]] const shape& from() const noexcept { return world_->shapes[seat_->from]; }
    [[nodiscard]] const shape& to() const noexcept { return world_->shapes[seat_->to]; }
    [[nodiscard]] bool moves() const noexcept { return seat_->from != seat_->to; }
    /// The number of the newest shape; it changes with each.
    [[nodiscard]] int newest() const noexcept { return world_->shapes.newest(); }
    /// Sets out for the newest shape or, if not `ahead`, for what was told last. It returns false if it is there, or if
    /// the last way is not done.
    bool go(bool ahead) noexcept {
      news<shape>& all = world_->shapes;
      if (moves() || (ahead ? all.newest() : all.told()) == seat_->to) return false;
      const int next = ahead ? all.take() : all.take_told();
      if (next < 0) return false;
      all.give_back(std::exchange(seat_->to, next));
      return true;
    }
    /// The way ends: from now on both shapes are the one it went to, or after turn_back() the one it came from.
    void arrive() noexcept {
      world_->shapes.hold(seat_->to);
      world_->shapes.give_back(std::exchange(seat_->from, seat_->to));
    }
    void turn_back() noexcept {
      world_->shapes.hold(seat_->from);
      world_->shapes.give_back(std::exchange(seat_->to, seat_->from));
    }
    /// What a triangle is made of; null where the mesh does not say.
    [[nodiscard]] const material* made(int i) const noexcept {
      const made_of& stuff = world_->stuffs[seat_->stuff];
      if (stuff.of.empty()) return nullptr;
      return &stuff.materials[stuff.of[static_cast<std::size_t>(i)]];
    }
    /// Takes the newest materials.
    void take_materials() noexcept {
      if (world_->stuffs.newest() == seat_->stuff) return;
      const int newest = world_->stuffs.take();
      if (newest >= 0) world_->stuffs.give_back(std::exchange(seat_->stuff, newest));
    }
    /// The newest pose, or null if none came since the last call.
    [[nodiscard]] const told_pose* take_pose() noexcept {
      if (world_->poses.newest() == seat_->pose) return nullptr;
      const int newest = world_->poses.take();
      if (newest < 0) return nullptr;
      if (seat_->pose >= 0) world_->poses.give_back(seat_->pose);
      seat_->pose = newest;
      return &world_->poses[newest];
    }

   private:
    detail::world* world_ = nullptr;
    detail::world::seat* seat_ = nullptr;
  };

 private:
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

  /// From one time to another [ms], where no difference of clocks could hold it either.
  [[nodiscard]] static double ms(clock::time_point from, clock::time_point to) {
    const std::chrono::duration<double, std::milli> a = from.time_since_epoch(),
                                                    b = to.time_since_epoch();
    return (b - a).count();
  }
  [[nodiscard]] bool in_order(clock::time_point at) {
    if (const auto now = clock::now(); at > now) {
      fault_ = "mesh: news from the future, by " + std::to_string(ms(now, at)) +
               " ms; give the time of surface::clock at which they were made";
      return false;
    }
    if (at < last_) {
      fault_ = "mesh: news from the past, older by " + std::to_string(ms(at, last_)) +
               " ms than the last ones; publish in the order of making";
      return false;
    }
    return true;
  }
  [[nodiscard]] static std::string in_words(double x) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", x == x ? x : std::fabs(x));  // no sign of a NaN
    return text.data();
  }
  /// "(1, nan, 2)".
  [[nodiscard]] static std::string in_words(std::initializer_list<double> numbers) {
    std::string all;
    for (const double x : numbers) all += (all.empty() ? "(" : ", ") + in_words(x);
    return all + ")";
  }
  template <class Nodes>
  [[nodiscard]] static std::string not_finite(const Nodes& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const triple p = detail::node_of(nodes, i);
      if (!is_finite(p) || !(squared(p) < 1e12)) {
        return "mesh: node " + std::to_string(i) + " at " + in_words({p.x, p.y, p.z}) +
               " m is not finite, or farther than 1000 km; give metres";
      }
    }
    return {};
  }
  /// What is said of nodes among which no triangle has an area; one that has is mostly the first.
  template <class Nodes>
  [[nodiscard]] static std::string no_area(std::span<const triangle> triangles,
                                           const Nodes& nodes) {
    for (const triangle& t : triangles) {
      const triple a = detail::node_of(nodes, at(t[0])), b = detail::node_of(nodes, at(t[1])),
                   c = detail::node_of(nodes, at(t[2]));
      if (squared(cross(b - a, c - a)) > 0.0) return {};
    }
    return "mesh: none of its " + std::to_string(triangles.size()) +
           " triangles has an area, so it may be passed through; are all nodes at one place?";
  }
  template <class Nodes>
  void smoothen(const smooth& rounded, const Nodes& nodes) {
    if (const auto fault = rounded.check()) {
      believe("mesh: " + std::string(fault.parameter) + " is " + std::to_string(fault.value) +
              "; give one that is " + fault.remedy);
    }
    std::vector<triple> places(nodes.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = detail::node_of(nodes, i);
    world_->smooth = detail::neighbours_of(world_->triangles, places, rounded.crease);
    rounds_off_ = [](const detail::world& w, shape& s, problems& its) {
      detail::fit_normals(w.smooth, w.triangles, s.nodes, s.normals, its);
      s.bulge = {};
      for (std::size_t t = 0; t < w.triangles.size(); ++t) {
        const auto three = [&](const auto& all, const auto& of) {
          return corners{all[at(of[0])], all[at(of[1])], all[at(of[2])]};
        };
        s.bulge.include(three(s.nodes, w.triangles[t]), three(s.normals, w.smooth.normal[t]));
      }
    };
  }
  template <class Nodes>
  void publish(const Nodes& nodes, made_of stuff) {
    tell(nodes);
    world_->stuffs.blank() = std::move(stuff);
    world_->stuffs.publish();
  }
  static void believe(const std::string& fault) {
    if (fault.empty()) return;
#if defined(__cpp_exceptions)
    throw std::invalid_argument(fault);
#else
    std::fprintf(stderr, "passive_haptics, mesh: %s\n", fault.c_str());
    std::abort();
#endif
  }
  template <class Nodes>
  [[nodiscard]] static std::vector<triple> centres(std::span<const triangle> triangles,
                                                   const Nodes& nodes) {
    std::vector<triple> all(triangles.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const int node : triangles[i]) all[i] = all[i] + detail::node_of(nodes, at(node));
      all[i] = all[i] * (1.0 / 3.0);
    }
    return all;
  }
  template <class Nodes>
  [[nodiscard]] static std::unique_ptr<detail::world> made(std::vector<triangle> triangles,
                                                           const Nodes& nodes,
                                                           const made_of& stuff) {
    believe(check(triangles, nodes));
    believe(stuff.check(triangles.size()));
    box_tree tree(centres(triangles, nodes));
    return std::make_unique<detail::world>(std::move(triangles), std::move(tree));
  }
  /// Publishes these nodes as what was told and, as the newest, where they are foreseen when the next news are due, which
  /// is after 1 + late times their next way.
  template <class Nodes>
  void tell(const Nodes& nodes) {
    auto& shapes = world_->shapes;
    shape& there = shapes.blank();
    there.nodes.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) there.nodes[i] = detail::node_of(nodes, i);
    fit(there);
    if (shapes.told() >= 0) {
      const std::vector<triple>& before = shapes[shapes.told()].nodes;
      way_.resize(nodes.size());
      way_before_.resize(nodes.size());
      double own = 0.0, next = 0.0, second = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const triple way = there.nodes[i] - before[i];
        own += squared(way);
        next += dot(way, way_[i]);
        second += dot(way, way_before_[i]);
        way_before_[i] = std::exchange(way_[i], way);
      }
      sees_.hear(own, next, second);
    }
    there.steady = sees_.share();
    shapes.publish_told();
    if (!(there.steady > 0.0)) {
      shapes.publish_as_told();
      return;
    }
    shape& next = shapes.blank();
    next.steady = there.steady;
    next.nodes.resize(nodes.size());
    const double last = sees_.last() * (1.0 + late_), older = sees_.before() * (1.0 + late_);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      next.nodes[i] = there.nodes[i] + way_[i] * last + way_before_[i] * older;
    }
    fit(next);
    shapes.publish();
  }
  static void fit_boxes(std::vector<box>& boxes, const box_tree& tree,
                        std::span<const triangle> triangles, const std::vector<triple>& nodes) {
    boxes.resize(tree.branches().size());
    tree.fit(boxes, [&](int t, box& b) {
      for (const int node : triangles[at(t)]) b.grow(nodes[at(node)]);
    });
  }
  /// Fits the boxes, and the normals of a smooth mesh, to the nodes.
  void fit(shape& s) {
    const detail::world& w = *world_;
    fit_boxes(s.boxes, w.tree, w.triangles, s.nodes);
    if (rounds_off_ != nullptr) rounds_off_(w, s, problems_);
  }

  using problems = std::vector<detail::normal_problem>;
  std::unique_ptr<detail::world> world_;
  std::size_t count_;                                    ///< number of nodes
  clock::time_point last_ = (clock::time_point::min)();  ///< a clock may begin after an age
  double late_ = 0.0;  ///< age of the news over the time since the last ones
  std::string fault_;
  std::vector<triple> way_, way_before_;  ///< of each node by the last news, and those before [m]
  foresight<double> sees_;
  problems problems_;  ///< while normals are fitted
  /// Of a smooth mesh. A program that makes none links nothing of it.
  void (*rounds_off_)(const detail::world&, shape&, problems&) = nullptr;
};

}  // namespace mesh
}  // namespace v0
}  // namespace passive_haptics
