// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is behind a ph_port*: any composition of the library with its inbox, behind one face. Each family of
// compositions is a file beside this one.
//
//   name ─▶ device as stated, checked ─▶ a composition for each latency ─▶ its own check() ─▶ ph_port

#include <passive_haptics/adapters/c/passive_haptics.h>
#include <passive_haptics/passive_haptics.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <variant>

namespace c_interface {

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;
using vector = scene::vector;
using plane = ph::half_space<scene>;

[[nodiscard]] inline vector read(const double* numbers) noexcept {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Whatever curves, so that a slot takes any of it; bit for bit what it holds.
struct curved {
  using space_type = scene;
  using scalar = double;
  using vector = scene::vector;
  static constexpr ph::surface_kind kind = ph::surface_kind::smooth;

  std::variant<ph::sphere<scene>, ph::quadric<scene>, ph::shell<ph::segment_core<scene>>,
               ph::shell<ph::box_core<scene>>, ph::shell<ph::triangle_core<scene>>>
      shape{};
  double stiffness{};  ///< that of the shape

  [[nodiscard]] bool prepare() noexcept {
    return std::visit([](auto& s) { return s.prepare(); }, shape);
  }
  struct probe {
    double depth;
    vector normal, pushing;
    bool within;
    [[nodiscard]] const vector& outward() const noexcept { return normal; }
    [[nodiscard]] const vector& push() const noexcept { return pushing; }
    [[nodiscard]] bool covered() const noexcept { return within; }
  };
  [[nodiscard]] probe at(const vector& x) const noexcept {
    return std::visit(
        [&x](const auto& s) -> probe {
          const auto here = s.at(x);
          if constexpr (requires { here.push(); }) {
            return {here.depth, here.outward(), here.push(), here.covered()};
          } else {
            return {here.depth, here.outward(), here.outward(), here.covered()};
          }
        },
        shape);
  }
};

/// What the world has told of a slot.
template <class Surface>
struct told {
  Surface surface{};
  ph::stored_vector<double, 3> at{};  ///< the point of a tool [m]
  std::uint32_t news = 0;             ///< how often it has been told
  bool here = false;
};

/// What a tick is given; null is what could not be read, and a force that is not wanted anew.
struct moment {
  const double* position = nullptr;
  const double* orientation = nullptr;
  double dt = 0.0;
  const double* wanted = nullptr;
};

/// What a composition takes in a tick; positions are all of it for detents.
enum class takes { planes, forces, poses, meshes, positions };

}  // namespace c_interface

/// What a caller holds. The tick is the only virtual call in a loop.
struct ph_port {
  ph_port(const ph_parameters& p, c_interface::takes what, bool torque) noexcept
      : takes(what), has_torque(torque), stated(p) {}
  virtual ~ph_port() = default;
  [[nodiscard]] virtual passive_haptics::parameter_fault check() const noexcept = 0;
  [[nodiscard]] virtual passive_haptics::guarantee promise() const noexcept = 0;
  [[nodiscard]] virtual passive_haptics::explanation explain() const noexcept = 0;
  /// Fills all of `out` but its size, in place: copies of a struct just written are dear.
  virtual void tick(const c_interface::moment& now, ph_result& out) noexcept = 0;
  /// Of its parameters those that may change; a fault changes nothing.
  virtual passive_haptics::parameter_fault set(const ph_parameters& p) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual void enable_forces(bool on) noexcept = 0;

  /// For the thread that publishes: its own copy of a slot, null if there is none; and off with all of them.
  virtual c_interface::told<c_interface::plane>* plane_slot(std::uint32_t i) noexcept = 0;
  virtual c_interface::told<c_interface::curved>* curved_slot(std::uint32_t i) noexcept = 0;
  virtual void send() noexcept = 0;
  /// False for a composition without slots.
  [[nodiscard]] bool has_slots() noexcept { return plane_slot(0) != nullptr; }

  /// For the thread that ticks.
  virtual std::int32_t touch(const ph_mesh& /*mesh*/) noexcept {
    return PH_NOT_OF_THIS_COMPOSITION;
  }
  virtual std::int32_t let_go(const ph_mesh& /*mesh*/) noexcept {
    return PH_NOT_OF_THIS_COMPOSITION;
  }

  const c_interface::takes takes;
  const bool has_torque;
  /// As the device says, for the coming tick only; the torque of a tool last.
  std::optional<std::array<double, 6>> held;
  ph_parameters stated;
  const void* composition = nullptr;  ///< whose row of the table it was made by
};

namespace c_interface {

/// Any composition of the library behind the one face, and what it is told.
template <class Composition, class Port>
class composed : public ph_port {
  using space = typename Port::port_type;
  using effort = typename space::stored_effort;
  static constexpr std::size_t plane_slots = Composition::plane_slots,
                               curved_slots = Composition::curved_slots;
  static constexpr bool follows = plane_slots > 0;
  static constexpr bool told_forces = requires(Port port, vector f) { port.source().update(f); };
  static constexpr bool turns = requires(typename space::stored_pose x) { x.orientation; };
  static constexpr bool on_a_line = space::dof == 1;
  static constexpr bool twists = requires(typename space::effort f) { space::angular(f); };

 public:
  // What no tick calls is compiled for size.
  [[gnu::cold]] explicit composed(const ph_parameters& p) noexcept
      : ph_port(p,
                turns         ? c_interface::takes::poses
                : follows     ? c_interface::takes::planes
                : on_a_line   ? c_interface::takes::positions
                : told_forces ? c_interface::takes::forces
                              : c_interface::takes::meshes,
                twists),
        port_(made(p)) {}

  [[nodiscard, gnu::cold]] ph::parameter_fault check() const noexcept override {
    return port_.check();
  }
  [[nodiscard]] ph::guarantee promise() const noexcept override { return Port::passivity; }
  [[nodiscard, gnu::cold]] ph::explanation explain() const noexcept override {
    return port_.explain();
  }
  [[gnu::cold]] ph::parameter_fault set(const ph_parameters& p) noexcept override {
    const Port fresh = made(p);
    if (const auto fault = fresh.check()) return fault;
    const auto bounds = fresh.bound().parameters();
    take_bounds(port_, bounds.first, bounds.rest.first);
    const auto take = [&](const auto& part) { (void)port_.set(part); };
    if constexpr (requires { fresh.law(); }) {
      take(fresh.law().parameters());
    } else if constexpr (follows) {
      const auto contact = contact_of(fresh).parameters();
      take(contact.spring);
      take(contact.friction);
    } else {
      take(fresh.source().parameters());
    }
    Composition::adjust(port_, p);
    stated = p;
    return {};
  }
  [[gnu::cold]] void reset() noexcept override {
    port_.reset();
    commanded_ = {};
    held.reset();
    if (const world* newest = inbox_.take()) {  // it was there before
      const auto skip = [](const auto& all, auto& heard) {
        for (std::size_t i = 0; i < heard.size(); ++i) heard[i] = all[i].news;
      };
      skip(newest->flat, heard_flat_);
      skip(newest->bent, heard_bent_);
    }
  }
  [[gnu::cold]] void enable_forces(bool on) noexcept override { port_.enable_forces(on); }
  told<plane>* plane_slot(std::uint32_t i) noexcept override { return slot(told_.flat, i); }
  told<curved>* curved_slot(std::uint32_t i) noexcept override { return slot(told_.bent, i); }
  void send() noexcept override { inbox_.publish(told_); }

  void tick(const moment& now, ph_result& result) noexcept override {
    if constexpr (follows) {
      if (const world* newest = inbox_.take()) {
        hear<plane>(newest->flat, heard_flat_);
        if constexpr (curved_slots > 0) hear<curved>(newest->bent, heard_bent_);
      }
    } else if constexpr (told_forces) {
      if (now.wanted != nullptr) port_.source().update(read(now.wanted));
    }
    const ph::device_sample<space> sample = sample_of(now);
    if (held) [[unlikely]]
      held.reset();
    const auto out = port_.tick(sample);
    std::copy_backward(commanded_.begin(), commanded_.end() - 1, commanded_.end());
    commanded_.front() = out.force;
    for (int i = 0; i < 3; ++i) {
      result.force[i] = along(out.force, i);
      result.torque[i] = twists ? along(out.force, i + 3) : 0.0;
    }
    result.event = static_cast<std::int32_t>(out.what);
    result.energy = out.energy;
    result.limited = out.limited;
    result.depth = 0.0;
    result.capped = 0;
    if constexpr (requires { out.depth; }) result.depth = out.depth;
    if constexpr (requires { port_.law().is_capped(); }) result.capped = port_.law().is_capped();
  }

 private:
  /// Component i of a force, or a wrench; on a line 0 but for the first.
  [[nodiscard]] static double along(const auto& force, int i) noexcept {
    if constexpr (on_a_line) {
      return i == 0 ? force : 0.0;
    } else {
      return twists || i < 3 ? force(i) : 0.0;
    }
  }
  /// In one piece: to read what was just written in parts is dear.
  [[nodiscard, gnu::always_inline]] ph::device_sample<space> sample_of(
      const moment& now) const noexcept {
    const bool was_read = now.position != nullptr && (!turns || now.orientation != nullptr);
    const auto x = [&](int i) { return was_read ? now.position[i] : 0.0; };
    const auto q = [&](int i) { return was_read ? now.orientation[i] : 0.0; };
    if constexpr (turns) {
      return {.position = {{x(0), x(1), x(2)}, {q(0), q(1), q(2), q(3)}},
              .held = held ? said() : commanded_.back(),
              .dt = now.dt,
              .valid = was_read};
    } else if constexpr (on_a_line) {
      return {.position = x(0),
              .held = held ? said() : commanded_.back(),
              .dt = now.dt,
              .valid = was_read};
    } else {
      return {.position = {x(0), x(1), x(2)},
              .held = held ? said() : commanded_.back(),
              .dt = now.dt,
              .valid = was_read};
    }
  }
  /// What the device says that it has held.
  [[nodiscard]] effort said() const noexcept {
    if constexpr (twists) {
      return space::join(read(held->data()), read(held->data() + 3));
    } else if constexpr (on_a_line) {
      return held->front();
    } else {
      return read(held->data());
    }
  }
  struct world {
    std::array<told<plane>, plane_slots> flat{};
    std::array<told<curved>, curved_slots> bent{};
  };

  [[nodiscard, gnu::cold, gnu::noinline]] static Port made(const ph_parameters& p) noexcept {
    Port port = Composition::template make<ph::late_loop_limits<Port::latency>>(p);
    Composition::adjust(port, p);
    return port;
  }
  template <class S, class O, class First, class Second, class... Rest>
  static void take_bounds(
      ph::passive_port<space, S, O, ph::bound_chain<First, Second>, Rest...>& port,
      const First& first, const Second& second) noexcept {
    (void)port.set(ph::bound_chain{first, second});
  }
  /// What has slots: the source, or what a stylus feels at its tip.
  [[nodiscard]] static auto& contact_of(auto& port) noexcept {
    if constexpr (requires { port.source().contact(); }) {
      return port.source().contact();
    } else {
      return port.source();
    }
  }
  [[nodiscard]] static auto slot(auto& all, std::uint32_t i) noexcept {
    return i < all.size() ? all.data() + i : nullptr;
  }
  template <class Surface>
  void hear(const auto& all, auto& heard) noexcept {
    for (int i = 0; i < static_cast<int>(all.size()); ++i) {
      const auto& now = all[static_cast<std::size_t>(i)];
      auto& last = heard[static_cast<std::size_t>(i)];
      if (now.news == last) continue;
      last = now.news;
      if constexpr (requires { port_.release(); }) {
        if (now.here) {
          port_.update(now.surface);
        } else {
          port_.release();
        }
      } else {
        auto& contact = contact_of(port_);
        if (!now.here) {
          contact.template release<Surface>(i);
        } else if constexpr (twists) {
          contact.update(i, now.at, now.surface);
        } else {
          contact.update(i, now.surface);
        }
      }
    }
  }

  world told_{};  // the thread's that publishes
  ph::exchange<world> inbox_;
  std::array<std::uint32_t, plane_slots> heard_flat_{};
  std::array<std::uint32_t, curved_slots> heard_bent_{};
  /// Newest first. The last is what a device that does as it is told has held: one way into the port
  /// is half the code of two.
  std::array<effort, std::size_t{Port::latency} + 1> commanded_{};

 protected:
  Port port_;
};

// ------------------------------------------------------------------------------ parameters and facts

[[nodiscard]] inline double stated(double x, double or_else) noexcept {
  return x == 0.0 ? or_else : x;
}

[[nodiscard]] inline ph::exact_device exact_device_of(const ph_parameters& p) noexcept {
  return {.mass = p.mass,
          .damping = p.damping,
          .force_limit = p.force_limit,
          .longest_tick = p.longest_tick,
          .latency = static_cast<int>(p.latency),
          .top_speed = p.top_speed};
}
[[nodiscard]] inline ph::encoder_device encoder_device_of(const ph_parameters& p) noexcept {
  ph::encoder_device d{.mass = p.mass,
                       .damping = p.damping,
                       .friction = p.friction,
                       .quantum = p.quantum,
                       .force_limit = p.force_limit,
                       .longest_tick = p.longest_tick,
                       .latency = static_cast<int>(p.latency),
                       .continuous_force = stated(p.continuous_force, ph::loop_limits::never),
                       .winding_time = p.winding_time,
                       .top_speed = p.top_speed};
  if (p.presliding != 0.0) d.presliding = p.presliding;
  return d;
}
[[nodiscard]] inline ph::known_hand hand_of(const ph_parameters& p) noexcept {
  return {.force = p.hand_force};
}
[[nodiscard]] inline ph::any_hand_t nobody(const ph_parameters& /*p*/) noexcept {
  return {};
}
[[nodiscard]] inline ph::stick_slip friction_of(const ph_parameters& p) noexcept {
  return {.static_coefficient = p.static_friction,
          .kinetic_coefficient = stated(p.kinetic_friction, p.static_friction)};
}
/// The loop of a composition, with the top speed that the facts of its device give it.
template <int Latency>
[[nodiscard]] ph::late_loop_limits<Latency> limits(const ph_parameters& p) noexcept {
  const ph::late_loop_limits<Latency> defaults{.longest_tick = p.longest_tick};
  return {.longest_tick = p.longest_tick,
          .top_speed =
              stated(p.top_speed, std::max(defaults.top_speed, 8.0 * p.quantum / p.longest_tick)),
          .workspace = stated(p.workspace, defaults.workspace),
          .watchdog = stated(p.watchdog, defaults.watchdog)};
}
/// What the facts of a device leave to be said of a set or of a tool. What is refused stays, and has been asked before.
template <class Port>
void adjust_slots(Port& port, ph::pursuit pace, const ph_parameters& p) noexcept {
  pace.turn_rate = stated(p.turn_rate, pace.turn_rate);
  pace.stale_after = stated(p.stale_after, pace.stale_after);
  (void)port.set(pace);
  (void)port.set(limits<Port::latency>(p));
}

// ------------------------------------------------------------------------------------- compositions

using made = std::unique_ptr<ph_port>;

template <class Composition, int Most = PH_MOST_LATENCY,
          template <class, class> class Face = composed, int Latency = 0>
[[nodiscard]] made make(const ph_parameters& p) noexcept {
  if constexpr (Latency < Most) {
    if (p.latency != Latency) return make<Composition, Most, Face, Latency + 1>(p);
  }
  using port = decltype(Composition::template make<ph::late_loop_limits<Latency>>(p));
  return made(new (std::nothrow) Face<Composition, port>(p));
}

/// Which device and which hand a name means.
struct facts {
  bool encoder = false;
  bool any_hand = false;
};
/// A family after its facts.
template <template <auto Device, auto Hand> class Family,
          template <class, class> class Face = composed>
[[nodiscard]] made make_by_facts(const ph_parameters& p, facts of) noexcept {
  constexpr int strict = PH_MOST_STRICT_LATENCY, usual = PH_MOST_LATENCY;
  if (of.encoder) {
    return of.any_hand ? make<Family<encoder_device_of, nobody>, strict, Face>(p)
                       : make<Family<encoder_device_of, hand_of>, usual, Face>(p);
  }
  return of.any_hand ? make<Family<exact_device_of, nobody>, strict, Face>(p)
                     : make<Family<exact_device_of, hand_of>, usual, Face>(p);
}

[[nodiscard]] made make_touch(const ph_parameters& p, facts of) noexcept;
[[nodiscard]] made make_quantised_touch(const ph_parameters& p, facts of) noexcept;
[[nodiscard]] made make_contacts(const ph_parameters& p, facts of) noexcept;
[[nodiscard]] made make_guard(const ph_parameters& p, facts of) noexcept;
[[nodiscard]] made make_stylus(const ph_parameters& p, facts of) noexcept;
[[nodiscard]] made make_tool(const ph_parameters& p, facts of) noexcept;
[[nodiscard]] made make_detents(const ph_parameters& p, facts of) noexcept;
[[nodiscard]] made make_mesh_touch(const ph_parameters& p, facts of) noexcept;
[[nodiscard]] made make_mesh_tool(const ph_parameters& p, facts of) noexcept;

// ------------------------------------------------------------------------- structs by size, and texts

/// A struct of an older header is shorter, a multiple of 8 bytes long, and as good; one of a newer header
/// may say what this library does not know.
template <class Struct>
[[nodiscard]] constexpr bool known_size(std::uint32_t size, std::size_t shortest) noexcept {
  return size >= shortest && size <= sizeof(Struct) && size % 8 == 0;
}

/// One text for one caller, cut where a character ends.
class text {
 public:
  text(char* room, std::size_t size) noexcept : room_(room), size_(room != nullptr ? size : 0) {
    if (size_ > 0) room_[0] = '\0';
  }
  template <class... Values>
  void say(const char* format, const Values&... values) const noexcept {
    std::array<char, PH_TEXT_ROOM> whole{};
    (void)std::snprintf(whole.data(), whole.size(), format, values...);
    if (size_ == 0) return;
    std::size_t end = std::min(std::strlen(whole.data()), size_ - 1);
    while (end > 0 && (static_cast<unsigned char>(whole[end]) & 0xC0U) == 0x80U) --end;
    std::memcpy(room_, whole.data(), end);
    room_[end] = '\0';
  }

 private:
  char* room_;
  std::size_t size_;
};

/// What is said of a struct of another size.
template <class Struct>
std::int32_t refuse_size(const text& reason, const char* name, std::uint32_t size) noexcept {
  reason.say("size = %u is refused: sizeof(%s), which is %u bytes in this library", unsigned{size},
             name, unsigned{sizeof(Struct)});
  return PH_WRONG_SIZE;
}
/// What is said of a parameter that is out of its range.
inline std::int32_t refuse(const text& reason, const ph::parameter_fault& fault) noexcept {
  reason.say("%s = %g is refused: %s", fault.parameter, fault.value, fault.remedy);
  return PH_REFUSED_PARAMETER;
}

}  // namespace c_interface
