// SPDX-License-Identifier: BSD-3-Clause
// The library behind the C interface: compositions with a name, each a port with an inbox. What is
// promised is said in the header; here is how a name becomes a type.
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
#include <string_view>
#include <utility>

namespace ph = passive_haptics;

namespace {

using scene = ph::space<double, 3>;
using vector = scene::vector;
using plane = ph::half_space<scene>;

/// What crosses from the thread that publishes.
struct news {
  plane surface{};
  bool here = false;
};

}  // namespace

/// What a caller holds. The tick is the only virtual call in a loop.
struct ph_port {
  virtual ~ph_port() = default;
  [[nodiscard]] virtual ph::parameter_fault check() const noexcept = 0;
  [[nodiscard]] virtual ph::guarantee promise() const noexcept = 0;
  /// Does a plane, or else a force, tell it what to do?
  [[nodiscard]] virtual bool takes_planes() const noexcept = 0;
  [[nodiscard]] virtual std::optional<ph::explanation> explain() const noexcept = 0;
  /// Null is a position that could not be read, and a force that is not wanted anew. Fills all of `out`
  /// but its size, in place: copies of a struct just written are dear.
  virtual void tick(const double* position, double dt, const double* wanted,
                    ph_result& out) noexcept = 0;

  ph::exchange<news> inbox;
  std::optional<scene::stored_effort> held;  ///< as the device says, for the coming tick only
};

namespace {

[[nodiscard]] vector read(const double* numbers) noexcept {
  return {numbers[0], numbers[1], numbers[2]};
}

void answer(ph_result& out, const vector& force, double energy, ph::event what, bool limited,
            double depth = 0.0, bool capped = false) noexcept {
  out.event = static_cast<std::int32_t>(what);
  for (int i = 0; i < 3; ++i) out.force[i] = force(i);
  out.depth = depth;
  out.energy = energy;
  out.limited = limited;
  out.capped = capped;
}

/// Any composition of the library behind the one face.
template <class Port>
class composed final : public ph_port {
  static constexpr bool follows = requires(Port p) { p.release(); };

 public:
  explicit composed(const Port& port) noexcept : port_(port) {}

  [[nodiscard]] ph::parameter_fault check() const noexcept override { return port_.check(); }
  [[nodiscard]] ph::guarantee promise() const noexcept override { return Port::passivity; }
  [[nodiscard]] bool takes_planes() const noexcept override { return follows; }
  [[nodiscard]] std::optional<ph::explanation> explain() const noexcept override {
    if constexpr (requires { port_.explain(); }) return port_.explain();
    return std::nullopt;
  }
  void tick(const double* position, double dt, const double* wanted,
            ph_result& result) noexcept override {
    if constexpr (follows) {
      if (const news* newest = inbox.take()) {
        if (newest->here) {
          port_.update(newest->surface);
        } else {
          port_.release();
        }
      }
    } else if (wanted != nullptr) {
      port_.source().update(read(wanted));
    }
    const bool was_read = position != nullptr;
    const auto at = [&](int i) { return was_read ? position[i] : 0.0; };
    const ph::device_sample<scene> sample{.position = {at(0), at(1), at(2)},
                                          .held = held ? *held : commanded_.back(),
                                          .dt = dt,
                                          .valid = was_read};
    if (held) [[unlikely]] {
      held.reset();
    }
    const auto out = port_.tick(sample);
    std::copy_backward(commanded_.begin(), commanded_.end() - 1, commanded_.end());
    commanded_.front() = out.force;
    if constexpr (follows) {
      bool capped = false;
      if constexpr (requires { port_.law().is_capped(); }) capped = port_.law().is_capped();
      answer(result, out.force, out.energy, out.what, out.limited, out.depth, capped);
    } else {
      answer(result, out.force, out.energy, out.what, out.limited);
    }
  }

 private:
  Port port_;
  /// Newest first. The last is what a device that does as it is told has held: one way into the port
  /// is half the code of two.
  std::array<scene::stored_effort, std::size_t{Port::latency} + 1> commanded_{};
};

// ------------------------------------------------------------------------------- named compositions

[[nodiscard]] double stated(double x, double or_else) noexcept {
  return x == 0.0 ? or_else : x;
}
constexpr double never = ph::loop_limits::never;

[[nodiscard]] ph::encoder_device device_of(const ph_parameters& p) noexcept {
  ph::encoder_device d{.mass = p.mass,
                       .damping = p.damping,
                       .friction = p.friction,
                       .quantum = p.quantum,
                       .force_limit = p.force_limit,
                       .longest_tick = p.longest_tick,
                       .latency = static_cast<int>(p.latency),
                       .continuous_force = stated(p.continuous_force, never),
                       .winding_time = p.winding_time};
  if (p.presliding != 0.0) d.presliding = p.presliding;
  return d;
}

[[nodiscard]] ph::exact_device exact_device_of(const ph_parameters& p) noexcept {
  return {.mass = p.mass,
          .damping = p.damping,
          .force_limit = p.force_limit,
          .longest_tick = p.longest_tick,
          .latency = static_cast<int>(p.latency)};
}
[[nodiscard]] ph::known_hand hand_of(const ph_parameters& p) noexcept {
  return {.force = p.hand_force};
}

template <int Latency>
[[nodiscard]] ph::late_loop_limits<Latency> limits(const ph_parameters& p) noexcept {
  const ph::late_loop_limits<Latency> defaults{.longest_tick = p.longest_tick};
  return {.longest_tick = p.longest_tick,
          .top_speed = stated(p.top_speed, defaults.top_speed),
          .workspace = stated(p.workspace, defaults.workspace),
          .watchdog = stated(p.watchdog, defaults.watchdog)};
}
[[nodiscard]] ph::followed<plane> surface(const ph_parameters& p) noexcept {
  const ph::freshness defaults;
  return ph::followed<plane>{{.stale_after = stated(p.stale_after, defaults.stale_after)}};
}
[[nodiscard]] ph::turn_limited turning(const ph_parameters& p) noexcept {
  return {.rate = stated(p.turn_rate, 2.0)};
}
[[nodiscard]] ph::given_force given(const ph_parameters& p) noexcept {
  const ph::given_force defaults;
  return {.stale_after = stated(p.stale_after, defaults.stale_after)};
}
[[nodiscard]] ph::settled_force settled(const ph_parameters& p) noexcept {
  return {.mass = p.mass, .force_limit = p.force_limit, .stale_after = given(p).stale_after};
}
[[nodiscard]] ph::eased<ph::damped_spring> settling(const ph_parameters& p) noexcept {
  return ph::eased{ph::damped_spring{.mass = p.mass, .force_limit = p.force_limit}};
}
[[nodiscard]] ph::reachable_bound reachable(const ph_parameters& p) noexcept {
  return {.mass = p.mass, .hand_force = p.hand_force};
}
[[nodiscard]] ph::actuator_limit motors(const ph_parameters& p) noexcept {
  return {.most = p.force_limit};
}
template <class Ledger>
[[nodiscard]] ph::forgiving<Ledger> forgiven(const ph_parameters& p,
                                             const Ledger& ledger) noexcept {
  return {ledger, ph::amends_for(p.force_limit)};
}
[[nodiscard]] ph::dual_ledger frictional(const ph_parameters& p) noexcept {
  return {.damping = {.coefficient = p.damping, .coulomb = p.friction, .presliding = p.presliding},
          .quantum = p.quantum};
}

/// What a composition from the facts of a device leaves to be said: the loop's limits and how data age.
template <class Port>
Port with_limits(Port port, const ph_parameters& p) noexcept {
  // A part that is refused stays as it is, and ph_create has asked these before.
  (void)port.set(limits<Port::latency>(p));
  return port;
}
struct touch {
  template <int Latency>
  static auto make(const ph_parameters& p) noexcept {
    using loop = ph::late_loop_limits<Latency>;
    auto port = ph::make_touch<scene, plane, loop>(exact_device_of(p), hand_of(p),
                                                   stated(p.turn_rate, 2.0));
    (void)port.set(ph::freshness{.stale_after = stated(p.stale_after, never)});
    return with_limits(port, p);
  }
};
struct quantised_touch {
  template <int Latency>
  static auto make(const ph_parameters& p) noexcept {
    // By hand: positions in steps, and no friction to pay for them.
    return ph::local_model{
        scene{},
        surface(p),
        turning(p),
        settling(p),
        forgiven(p, ph::quantised_energy{.damping = {p.damping}, .quantum = p.quantum}),
        ph::bound_chain{reachable(p), motors(p)},
        limits<Latency>(p),
        ph::mass_observer{.mass = p.mass, .quantum = p.quantum}};
  }
};
struct encoder_touch {
  template <int Latency>
  static auto make(const ph_parameters& p) noexcept {
    using loop = ph::late_loop_limits<Latency>;
    auto port =
        ph::make_touch<scene, plane, loop>(device_of(p), hand_of(p), stated(p.turn_rate, 2.0));
    (void)port.set(ph::freshness{.stale_after = stated(p.stale_after, never)});
    return with_limits(port, p);
  }
};
struct strict_touch {
  template <int Latency>
  static auto make(const ph_parameters& p) noexcept {
    return ph::local_model{scene{},
                           surface(p),
                           turning(p),
                           ph::spring{},
                           ph::reduced_energy{.damping = p.damping},
                           ph::bound_chain{ph::strict_bound{}, motors(p)},
                           limits<Latency>(p)};
  }
};
struct force_guard {
  template <int Latency>
  static auto make(const ph_parameters& p) noexcept {
    auto port =
        ph::make_guard<scene, ph::late_loop_limits<Latency>>(exact_device_of(p), hand_of(p));
    (void)port.set(settled(p));
    return with_limits(port, p);
  }
};
struct strict_guard {
  template <int Latency>
  static auto make(const ph_parameters& p) noexcept {
    return ph::passive_port{scene{}, given(p), ph::reduced_energy{.damping = p.damping},
                            ph::bound_chain{ph::strict_bound{}, motors(p)}, limits<Latency>(p)};
  }
};
struct encoder_guard {
  template <int Latency>
  static auto make(const ph_parameters& p) noexcept {
    return ph::passive_port{scene{}, given(p), frictional(p),
                            ph::bound_chain{ph::strict_bound{}, motors(p)}, limits<Latency>(p)};
  }
};

using made = std::unique_ptr<ph_port>;

template <class Composition, int Latency>
[[nodiscard]] made make_late(const ph_parameters& p) noexcept {
  using port = decltype(Composition::template make<Latency>(p));
  return made(new (std::nothrow) composed<port>(Composition::template make<Latency>(p)));
}
template <class Composition, int Latency = 0>
[[nodiscard]] made make(const ph_parameters& p) noexcept {
  if constexpr (Latency < PH_MOST_LATENCY) {
    if (p.latency != Latency) return make<Composition, Latency + 1>(p);
  }
  return make_late<Composition, Latency>(p);
}

struct named_composition {
  std::string_view name;
  made (*make)(const ph_parameters&) noexcept;
  bool knows_hand;   ///< takes mass and hand_force
  bool knows_steps;  ///< takes quantum, and what pays for it
};
constexpr std::array compositions{
    named_composition{"touch", make<touch>, true, false},
    named_composition{"quantised_touch", make<quantised_touch>, true, true},
    named_composition{"encoder_touch", make<encoder_touch>, true, true},
    named_composition{"strict_touch", make<strict_touch>, false, false},
    named_composition{"force_guard", make<force_guard>, true, false},
    named_composition{"strict_guard", make<strict_guard>, false, false},
    named_composition{"encoder_guard", make<encoder_guard>, false, true},
};

/// The first parameter that is out of range by the names of ph_parameters. What this passes the
/// composition asks once more, by its own.
[[nodiscard]] ph::parameter_fault fault_in(const ph_parameters& p,
                                           const named_composition& chosen) noexcept {
  if (p.latency > PH_MOST_LATENCY) {
    return {"latency", static_cast<double>(p.latency), "0, 1 or 2 ticks"};
  }
  ph::encoder_device device = device_of(p);
  if (!chosen.knows_hand) device.mass = 1.0;
  if (!chosen.knows_steps) {
    if (p.quantum != 0.0) {
      return {"quantum", p.quantum,
              "0 here, where positions are taken as exact: quantised_touch, encoder_touch and "
              "encoder_guard know steps"};
    }
    device.friction = 0.0;
  }
  if (chosen.name != "encoder_touch") device.continuous_force = never;
  if (const auto fault = device.check()) return fault;
  if (chosen.knows_hand && !ph::detail::positive(p.hand_force)) {
    return {"hand_force", p.hand_force, "finite and > 0 N: hand, load and dry friction together"};
  }
  if (!(p.stale_after >= 0.0)) return {"stale_after", p.stale_after, "≥ 0 s, 0 for the default"};
  if (chosen.name == "encoder_touch") {
    const auto budget = ph::design::stiffness_budget(device);
    if (!(budget.stiffness > 0.0)) return {"friction", p.friction, budget.because()};
  }
  if (!(p.turn_rate >= 0.0)) return {"turn_rate", p.turn_rate, "≥ 0 rad/s, 0 for the default"};
  return ph::detail::fault_in(limits<0>(p));
}

// ------------------------------------------------------------------------------------ structs by size

/// A struct of an older header is shorter, a multiple of 8 bytes long, and as good; one of a newer header
/// may say what this library does not know.
template <class Struct>
[[nodiscard]] constexpr bool known_size(std::uint32_t size, std::size_t shortest) noexcept {
  return size >= shortest && size <= sizeof(Struct) && size % 8 == 0;
}
constexpr std::size_t shortest_parameters = offsetof(ph_parameters, friction);
constexpr std::size_t shortest_result = offsetof(ph_result, limited);
static_assert(sizeof(ph_parameters) == 128 && shortest_parameters == 48);
static_assert(sizeof(ph_explanation) == 48 || sizeof(void*) != 8);
static_assert(sizeof(ph_result) == 56 && shortest_result == 48);

/// What the caller's struct says; zero, "not stated", where it ends.
[[nodiscard]] ph_parameters read(const ph_parameters& given) noexcept {
  ph_parameters own{};
  std::memcpy(&own, &given, given.size);
  return own;
}
[[nodiscard]] bool writable(const ph_result* result) noexcept {
  return result != nullptr && known_size<ph_result>(result->size, shortest_result);
}
/// Has `fill` write to the caller's struct as far as it goes.
void write(ph_result& result, const auto& fill) noexcept {
  if (result.size == sizeof(ph_result)) [[likely]] {
    fill(result);
    return;
  }
  ph_result own{};
  own.size = result.size;
  fill(own);
  std::memcpy(&result, &own, own.size);
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

std::int32_t tick(ph_port* port, const double* position, double dt, bool with_force,
                  const double* wanted, ph_result* result) noexcept {
  if (result == nullptr) return PH_NULL_ARGUMENT;
  if (!writable(result)) return PH_WRONG_SIZE;
  if (port == nullptr) {
    write(*result, [](ph_result& out) {
      answer(out, scene::zero(), 0.0, ph::event::rejected_parameters, false);
    });
    return PH_NULL_ARGUMENT;
  }
  std::int32_t status = PH_OK;
  if (position == nullptr || (with_force && wanted == nullptr)) {
    status = PH_NULL_ARGUMENT;
  } else if (with_force && port->takes_planes()) {
    status = PH_NOT_OF_THIS_COMPOSITION;
  }
  const bool good = status == PH_OK;
  write(*result, [&](ph_result& out) {
    port->tick(good ? position : nullptr, dt, good ? wanted : nullptr, out);
  });
  return status;
}

// The numbers are the library's.
constexpr bool same(ph_event ours, ph::event theirs) noexcept {
  return static_cast<int>(ours) == static_cast<int>(theirs);
}
static_assert(same(PH_NOMINAL, ph::event::nominal) && same(PH_DEBT, ph::event::debt) &&
              same(PH_LATE_TICK, ph::event::late_tick) &&
              same(PH_REPEATED_SAMPLE, ph::event::repeated_sample) &&
              same(PH_NO_TARGET, ph::event::no_target) &&
              same(PH_REJECTED_TARGET, ph::event::rejected_target) &&
              same(PH_STALE_TARGET, ph::event::stale_target) &&
              same(PH_OUTSIDE_WORKSPACE, ph::event::outside_workspace) &&
              same(PH_REJECTED_SAMPLE, ph::event::rejected_sample) &&
              same(PH_REJECTED_PARAMETERS, ph::event::rejected_parameters) &&
              same(PH_OUTSIDE_FORCE, ph::event::outside_force) &&
              same(PH_UNTOLD_LATENCY, ph::event::untold_latency) &&
              same(PH_WRONG_SIGN, ph::event::wrong_sign) &&
              same(PH_STARTED_INSIDE, ph::event::started_inside) &&
              same(PH_FORCES_OFF, ph::event::forces_off));
static_assert(PH_NONE == static_cast<int>(ph::guarantee::none) &&
              PH_CONDITIONAL == static_cast<int>(ph::guarantee::conditional) &&
              PH_STRICT == static_cast<int>(ph::guarantee::strict));

}  // namespace

extern "C" {

std::uint32_t ph_version() noexcept {
  return 10000 * ph::version_major + 100 * ph::version_minor + ph::version_patch;
}

std::int32_t ph_create(const char* composition, const ph_parameters* parameters, ph_port** port,
                       char* why, std::size_t room) noexcept {
  const text reason(why, room);
  if (port != nullptr) *port = nullptr;
  if (composition == nullptr || parameters == nullptr || port == nullptr) {
    reason.say("ph_create: %s is NULL", composition == nullptr  ? "composition"
                                        : parameters == nullptr ? "parameters"
                                                                : "port");
    return PH_NULL_ARGUMENT;
  }
  if (!known_size<ph_parameters>(parameters->size, shortest_parameters)) {
    reason.say("size = %u is refused: sizeof(ph_parameters), which is %u bytes in this library",
               unsigned{parameters->size}, unsigned{sizeof(ph_parameters)});
    return PH_WRONG_SIZE;
  }
  const auto* const chosen =
      std::find_if(compositions.begin(), compositions.end(),
                   [composition](const auto& c) { return c.name == composition; });
  if (chosen == compositions.end()) {
    reason.say(
        "composition = \"%.60s\" is refused: one of touch, quantised_touch, encoder_touch, "
        "strict_touch, force_guard, strict_guard, encoder_guard",
        composition);
    return PH_UNKNOWN_COMPOSITION;
  }
  const ph_parameters own = read(*parameters);
  const auto refuse = [&reason](const ph::parameter_fault& fault) {
    reason.say("%s = %g is refused: %s", fault.parameter, fault.value, fault.remedy);
    return PH_REFUSED_PARAMETER;
  };
  if (const auto fault = fault_in(own, *chosen)) return refuse(fault);
  made whole = chosen->make(own);
  if (!whole) {
    reason.say("%s", "ph_create: no memory for a port");
    return PH_OUT_OF_MEMORY;
  }
  if (const auto fault = whole->check()) return refuse(fault);
  *port = whole.release();
  return PH_OK;
}

void ph_destroy(ph_port* port) noexcept {
  delete port;
}

std::int32_t ph_guarantee_of(const ph_port* port) noexcept {
  return port != nullptr ? static_cast<std::int32_t>(port->promise()) : std::int32_t{PH_NONE};
}

std::int32_t ph_publish_plane(ph_port* port, const double point[3], const double normal[3],
                              double stiffness) noexcept {
  if (port == nullptr || point == nullptr || normal == nullptr) return PH_NULL_ARGUMENT;
  if (!port->takes_planes()) return PH_NOT_OF_THIS_COMPOSITION;
  const plane surface{read(point), read(normal), stiffness};
  if (plane tried = surface; !tried.prepare()) return PH_REFUSED_PLANE;
  port->inbox.publish({surface, true});
  return PH_OK;
}

std::int32_t ph_publish_nothing(ph_port* port) noexcept {
  if (port == nullptr) return PH_NULL_ARGUMENT;
  if (!port->takes_planes()) return PH_NOT_OF_THIS_COMPOSITION;
  port->inbox.publish({});
  return PH_OK;
}

std::int32_t ph_tick(ph_port* port, const double position[3], double dt,
                     ph_result* result) noexcept {
  return tick(port, position, dt, false, nullptr, result);
}

std::int32_t ph_tick_wanted(ph_port* port, const double position[3], double dt,
                            const double wanted[3], ph_result* result) noexcept {
  return tick(port, position, dt, true, wanted, result);
}

std::int32_t ph_held(ph_port* port, const double force[3]) noexcept {
  if (port == nullptr || force == nullptr) return PH_NULL_ARGUMENT;
  port->held = read(force);
  return PH_OK;
}

std::int32_t ph_explain(const ph_port* port, ph_explanation* explanation) noexcept {
  if (port == nullptr || explanation == nullptr) return PH_NULL_ARGUMENT;
  if (explanation->size != sizeof(ph_explanation)) return PH_WRONG_SIZE;
  const auto said = port->explain();
  const ph::explanation e = said.value_or(ph::explanation{});
  *explanation = {.size = sizeof(ph_explanation),
                  .now = e.now != ph::softened_by::nothing,
                  .asked = e.asked,
                  .shown = e.shown,
                  .depth = e.depth,
                  .force = e.force,
                  .because = said ? e.because() : ""};
  return said ? PH_OK : PH_NOT_OF_THIS_COMPOSITION;
}

std::int32_t ph_stiffness_budget(const ph_parameters* parameters, double* stiffness,
                                 const char** because) noexcept {
  if (parameters == nullptr || stiffness == nullptr) return PH_NULL_ARGUMENT;
  *stiffness = 0.0;
  if (because != nullptr) *because = "";
  if (!known_size<ph_parameters>(parameters->size, shortest_parameters)) return PH_WRONG_SIZE;
  const auto device = device_of(read(*parameters));
  const auto budget = ph::design::stiffness_budget(device);
  *stiffness = budget.stiffness;
  if (because != nullptr) *because = budget.because();
  return device.check() ? PH_REFUSED_PARAMETER : PH_OK;
}

const char* ph_event_text(std::int32_t event) noexcept {
  const bool is_one = event >= 0 && event <= static_cast<std::int32_t>(PH_FORCES_OFF);
  return is_one ? ph::to_string(static_cast<ph::event>(event)) : "unknown event";
}

const char* ph_status_text(std::int32_t status) noexcept {
  switch (status) {
    case PH_OK:
      return "ok";
    case PH_NULL_ARGUMENT:
      return "a pointer that must not be NULL is";
    case PH_WRONG_SIZE:
      return "size is no size of this struct that the library knows";
    case PH_UNKNOWN_COMPOSITION:
      return "no composition has this name";
    case PH_REFUSED_PARAMETER:
      return "a parameter is out of its range";
    case PH_OUT_OF_MEMORY:
      return "out of memory";
    case PH_NOT_OF_THIS_COMPOSITION:
      return "a touch takes planes, a guard takes forces";
    case PH_REFUSED_PLANE:
      return "the plane has a number that is none, no normal, or no stiffness > 0";
    default:
      return "unknown status";
  }
}

}  // extern "C"
