// SPDX-License-Identifier: BSD-3-Clause
// The C interface against the library it is made of, bit for bit, through a client in C that loads it; and
// what it says to wrong calls.
#include "by_c.h"
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <atomic>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace {

using plane = ph::half_space<d3>;
constexpr int ticks = 6000;

/// The library, loaded for one test.
class loaded : public c_interface {
 public:
  loaded() : c_interface{} {
    const char* const missing = load(this, PASSIVE_HAPTICS_C_LIBRARY);
    INFO((missing != nullptr ? missing : ""));
    REQUIRE(missing == nullptr);
  }
  loaded(const loaded&) = delete;
  loaded& operator=(const loaded&) = delete;
  ~loaded() { unload(this); }

  /// What ph_create says.
  [[nodiscard]] std::string refusal(const char* composition, const ph_parameters& parameters,
                                    int expected = PH_REFUSED_PARAMETER) const {
    std::string text(PH_TEXT_ROOM, 'x');
    ph_port* port = nullptr;
    const int status = create(composition, &parameters, &port, text.data(), text.size());
    CHECK(status == expected);
    CHECK((port == nullptr) == (status != PH_OK));
    destroy(port);
    return text.c_str();
  }
};

/// A port, ended with its test.
class opened {
 public:
  opened(const c_interface& with, const char* composition, const ph_parameters& parameters)
      : with_(with) {
    REQUIRE(with.create(composition, &parameters, &port, nullptr, 0) == PH_OK);
  }
  opened(const opened&) = delete;
  opened& operator=(const opened&) = delete;
  ~opened() { with_.destroy(port); }

  ph_port* port = nullptr;

 private:
  const c_interface& with_;
};

/// A device like a Touch, its encoder's steps not stated.
ph_parameters grip(std::uint32_t latency = 0) {
  ph_parameters p{};
  p.size = sizeof p;
  p.latency = latency;
  p.mass = 0.045;
  p.damping = 0.05;
  p.hand_force = 5.0;
  p.force_limit = 3.3;
  p.longest_tick = 1.1e-3;
  return p;
}
ph_parameters on_encoders(std::uint32_t latency = 0) {
  ph_parameters p = grip(latency);
  p.friction = 0.13;
  p.presliding = 15e-6;
  p.quantum = 20e-6;
  p.continuous_force = 0.88;
  p.winding_time = 0.5;
  return p;
}
constexpr ph::encoder_device stated{.mass = 0.045,
                                    .damping = 0.05,
                                    .friction = 0.13,
                                    .presliding = 15e-6,
                                    .quantum = 20e-6,
                                    .force_limit = 3.3,
                                    .longest_tick = 1.1e-3,
                                    .continuous_force = 0.88,
                                    .winding_time = 0.5};
constexpr double T = stated.longest_tick;
constexpr ph::exact_device exact{
    .mass = 0.045, .damping = 0.05, .force_limit = 3.3, .longest_tick = T};
constexpr ph::known_hand hand{.force = 5.0};
constexpr ph::actuator_limit motors{.most = stated.force_limit};

d3::vector in(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// The motion of the C client, run by a port of the library itself.
template <class Port>
std::vector<ph_result> run_direct(Port port) {
  constexpr bool follows = requires {
    port.release();
  };
  constexpr auto late = std::size_t{Port::latency};
  std::vector<d3::stored_effort> commanded(late + 1);  // oldest first
  std::vector<ph_result> results;
  for (int n = 0; n < ticks; ++n) {
    const moment now = moment_at(n);
    if constexpr (follows) {
      if (now.news == a_plane) port.update(plane{in(now.point), in(now.normal), now.stiffness});
      if (now.news == nothing_here) port.release();
    } else {
      if (n % 5 != 4) port.source().update(in(now.wanted));
    }
    // The device that says nothing is the one that does as it is told.
    const auto out =
        now.reports_held
            ? port.tick(ph::device_sample<d3>{in(now.position), in(now.held), now.dt, true})
            : port.tick(in(now.position), ph::seconds{now.dt});
    ph_result r{};
    r.size = sizeof r;
    r.event = static_cast<int>(out.what);
    for (int i = 0; i < 3; ++i) r.force[i] = out.force(i);
    r.energy = out.energy;
    r.limited = out.limited;
    if constexpr (follows) r.depth = out.depth;
    if constexpr (requires { port.law().is_capped(); }) r.capped = port.law().is_capped();
    results.push_back(r);
  }
  return results;
}

std::vector<ph_result> run_in_c(const char* composition, const ph_parameters& parameters) {
  const loaded c;
  std::vector<ph_result> results(ticks);
  const bool guard = std::string(composition).find("guard") != std::string::npos;
  REQUIRE(run_by_c(&c, composition, &parameters, guard, ticks, results.data()) == PH_OK);
  return results;
}

bool same_bits(const std::vector<ph_result>& a, const std::vector<ph_result>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

/// In contact and out of it, with a bound that has something to do, and a fault now and then.
bool tries_enough(const std::vector<ph_result>& all) {
  int pressed = 0;
  int limited = 0;
  int refused = 0;
  for (const auto& r : all) {
    pressed += r.force[2] != 0.0;
    limited += r.limited != 0;
    refused += r.event == PH_REJECTED_SAMPLE;
  }
  return pressed > 500 && pressed < ticks && limited > 20 && refused > 2;
}

/// The same from C and from C++; and not with a device that is 1 % off.
template <class Port>
void agree(const char* composition, const Port& port, ph_parameters parameters,
           double ph_parameters::*other) {
  INFO(composition << " " << parameters.latency << " ticks late");
  REQUIRE_FALSE(port.check());
  const auto direct = run_direct(port);
  const auto in_c = run_in_c(composition, parameters);
  CHECK(tries_enough(direct));
  CHECK(same_bits(direct, in_c));
  parameters.*other *= 1.01;
  CHECK_FALSE(same_bits(direct, run_in_c(composition, parameters)));
}

}  // namespace

TEST_CASE("a touch by name is make_touch, bit for bit, from a client in C", "[c_interface]") {
  agree("touch", ph::make_touch<d3>(exact, hand), grip(), &ph_parameters::damping);
  agree("encoder_touch", ph::make_touch<d3>(stated, hand), on_encoders(), &ph_parameters::friction);
}

TEST_CASE("in a loop that is late a touch by name is the late one", "[c_interface]") {
  auto late = stated;
  late.latency = 1;
  auto parameters = on_encoders(1);
  parameters.force_limit = late.force_limit = 0.5;  // a bound that has something to do
  parameters.continuous_force = late.continuous_force = 0.3;
  agree("encoder_touch", ph::make_touch<d3, plane, ph::late_loop_limits<1>>(late, hand), parameters,
        &ph_parameters::presliding);
  agree("strict_touch",
        ph::local_model{d3{}, ph::followed<plane>{}, ph::turn_limited{.rate = 2.0}, ph::spring{},
                        ph::reduced_energy{.damping = 0.05},
                        ph::bound_chain{ph::strict_bound{}, motors},
                        ph::late_loop_limits<2>{.longest_tick = T}},
        grip(2), &ph_parameters::damping);
}

TEST_CASE("a guard by name is the library's, bit for bit", "[c_interface]") {
  agree("force_guard", ph::make_guard<d3>(exact, hand), grip(), &ph_parameters::mass);
  auto late = exact;
  late.latency = 2;
  agree("force_guard", ph::make_guard<d3, ph::late_loop_limits<2>>(late, hand), grip(2),
        &ph_parameters::hand_force);
  agree("strict_guard",
        ph::passive_port{d3{}, ph::given_force{}, ph::reduced_energy{.damping = 0.05},
                         ph::bound_chain{ph::strict_bound{}, motors},
                         ph::loop_limits{.longest_tick = T}},
        grip(), &ph_parameters::longest_tick);
  agree(
      "encoder_guard",
      ph::passive_port{
          d3{}, ph::given_force{},
          ph::dual_ledger{.damping = {.coefficient = 0.05, .coulomb = 0.13, .presliding = 15e-6},
                          .quantum = 20e-6},
          ph::bound_chain{ph::strict_bound{}, motors}, ph::late_loop_limits<1>{.longest_tick = T}},
      on_encoders(1), &ph_parameters::quantum);
}

TEST_CASE("every composition has its promise, and presses", "[c_interface]") {
  const loaded c;
  const auto promise = [&c](const char* composition, const ph_parameters& p) {
    return c.guarantee_of(opened(c, composition, p).port);
  };
  CHECK(promise("touch", grip()) == PH_CONDITIONAL);
  CHECK(promise("quantised_touch", on_encoders()) == PH_CONDITIONAL);
  CHECK(promise("encoder_touch", on_encoders()) == PH_CONDITIONAL);
  CHECK(promise("strict_touch", grip()) == PH_STRICT);
  CHECK(promise("force_guard", grip()) == PH_CONDITIONAL);
  CHECK(promise("strict_guard", grip()) == PH_STRICT);
  CHECK(promise("encoder_guard", on_encoders()) == PH_STRICT);
  CHECK(c.guarantee_of(nullptr) == PH_NONE);
  for (std::uint32_t latency = 0; latency <= PH_MOST_LATENCY; ++latency) {
    CHECK(tries_enough(run_in_c("quantised_touch", on_encoders(latency))));
  }
}

TEST_CASE("the C interface names a parameter that is out of its range, its value and the remedy",
          "[c_interface]") {
  const loaded c;
  const auto says = [&c](const char* composition, ph_parameters p, double ph_parameters::*which,
                         double value) {
    p.*which = value;
    return c.refusal(composition, p);
  };
  using Catch::Matchers::StartsWith;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(c.refusal("touch", grip(), PH_OK).empty());  // the control
  CHECK(says("touch", grip(), &ph_parameters::mass, -0.1) ==
        "mass = -0.1 is refused: finite and > 0 kg");
  CHECK_THAT(says("touch", grip(), &ph_parameters::mass, 0.0), StartsWith("mass = 0 is"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::mass, nan), StartsWith("mass = nan is"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::damping, 0.0), StartsWith("damping = 0 is"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::hand_force, 0.0), StartsWith("hand_force = 0"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::force_limit, 0.0),
             StartsWith("force_limit = 0"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::longest_tick, 0.0),
             StartsWith("longest_tick = 0"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::turn_rate, -1.0), StartsWith("turn_rate = -1"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::stale_after, nan),
             StartsWith("stale_after = nan"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::top_speed, -5.0), StartsWith("top_speed = -5"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::workspace, -2.0), StartsWith("workspace = -2"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::watchdog, 1e-4),
             StartsWith("watchdog = 0.0001"));
  CHECK_THAT(says("touch", grip(), &ph_parameters::quantum, 20e-6), StartsWith("quantum = 2e-05"));
  CHECK_THAT(says("encoder_touch", on_encoders(), &ph_parameters::friction, 0.0),
             StartsWith("friction = 0 is refused: No dry friction is stated"));
  CHECK_THAT(says("encoder_guard", on_encoders(), &ph_parameters::presliding, 0.0),
             StartsWith("presliding = nan"));
  CHECK_THAT(says("encoder_touch", on_encoders(), &ph_parameters::winding_time, 0.0),
             StartsWith("winding_time = 0"));
  CHECK_THAT(c.refusal("touch", grip(3)), StartsWith("latency = 3 is refused: 0, 1 or 2 ticks"));
  CHECK_THAT(c.refusal("tuch", grip(), PH_UNKNOWN_COMPOSITION),
             StartsWith("composition = \"tuch\" is refused: one of touch, "));
  CHECK_THAT(c.refusal(std::string(1000, 'a').c_str(), grip(), PH_UNKNOWN_COMPOSITION),
             StartsWith("composition = \"aaaa"));

  // What a composition does not take it does not look at.
  auto p = grip();
  p.mass = p.hand_force = nan;
  CHECK(c.refusal("strict_touch", p, PH_OK).empty());
}

TEST_CASE("a text is cut to the room there is for it, between characters", "[c_interface]") {
  const loaded c;
  auto p = grip();
  p.watchdog = 1e-4;
  const std::string whole = c.refusal("touch", p);
  const auto sign = whole.find("≥");
  REQUIRE(sign != std::string::npos);
  ph_port* port = nullptr;
  for (std::size_t room = 0; room <= whole.size() + 2; ++room) {
    std::string text(whole.size() + 3, '#');
    CHECK(c.create("touch", &p, &port, text.data(), room) == PH_REFUSED_PARAMETER);
    CHECK(text.substr(room).find_first_not_of('#') == std::string::npos);
    if (room == 0) continue;
    const std::string said = text.c_str();
    const auto fits = std::min(room - 1, whole.size());
    CHECK(said == whole.substr(0, fits > sign && fits < sign + 3 ? sign : fits));
  }
  CHECK(c.create("touch", &p, &port, nullptr, 100) == PH_REFUSED_PARAMETER);
}

TEST_CASE("a struct of another size is refused, one of an older header serves", "[c_interface]") {
  const loaded c;
  for (const std::uint32_t size : {0u, 40u, 50u, 127u, 136u, 4096u}) {
    auto p = grip();
    p.size = size;
    CHECK(c.refusal("touch", p, PH_WRONG_SIZE) ==
          "size = " + std::to_string(size) +
              " is refused: sizeof(ph_parameters), which is 128 bytes in this library");
    double K = 1.0;
    CHECK(c.stiffness_budget(&p, &K, nullptr) == PH_WRONG_SIZE);
    CHECK(K == 0.0);
  }
  auto older = on_encoders();
  older.size = offsetof(ph_parameters, friction);  // what stands behind is not looked at
  CHECK(c.refusal("touch", older, PH_OK).empty());
  CHECK_FALSE(c.refusal("touch", on_encoders()).empty());  // the control: it refuses a quantum

  const opened touch(c, "touch", grip());
  const double here[3] = {0, 0, 0};
  ph_result r{};
  for (const std::uint32_t size : {0u, 40u, 52u, 64u}) {
    r = {};
    r.size = size;
    CHECK(c.tick(touch.port, here, 1e-3, &r) == PH_WRONG_SIZE);
    CHECK(r.size == size);
    CHECK(r.event == 0);  // untouched
  }
  r.size = offsetof(ph_result, limited);
  r.limited = r.capped = -7;
  CHECK(c.tick(touch.port, here, 1e-3, &r) == PH_OK);
  CHECK(r.event == PH_NO_TARGET);
  CHECK(r.size == offsetof(ph_result, limited));
  CHECK((r.limited == -7 && r.capped == -7));
}

TEST_CASE("NULL is answered, and costs no more than a lost sample", "[c_interface]") {
  const loaded c;
  const auto p = grip();
  std::string why(PH_TEXT_ROOM, 'x');
  ph_port* port = nullptr;
  CHECK(c.create(nullptr, &p, &port, why.data(), why.size()) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_create: composition is NULL");
  CHECK(c.create("touch", nullptr, &port, why.data(), why.size()) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_create: parameters is NULL");
  CHECK(c.create("touch", &p, nullptr, why.data(), why.size()) == PH_NULL_ARGUMENT);
  CHECK(std::string(why.c_str()) == "ph_create: port is NULL");
  c.destroy(nullptr);

  const double v[3] = {0, 0, 1};
  ph_result r{};
  r.size = sizeof r;
  r.force[0] = 99.0;
  CHECK(c.tick(nullptr, v, 1e-3, &r) == PH_NULL_ARGUMENT);
  CHECK(r.event == PH_REJECTED_PARAMETERS);
  CHECK(r.force[0] == 0.0);
  CHECK(c.publish_plane(nullptr, v, v, 1.0) == PH_NULL_ARGUMENT);
  CHECK(c.publish_nothing(nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.held(nullptr, v) == PH_NULL_ARGUMENT);
  CHECK(c.stiffness_budget(nullptr, r.force, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.stiffness_budget(&p, nullptr, nullptr) == PH_NULL_ARGUMENT);

  const opened touch(c, "touch", p);
  const opened guard(c, "force_guard", p);
  CHECK(c.publish_plane(touch.port, nullptr, v, 1.0) == PH_NULL_ARGUMENT);
  CHECK(c.publish_plane(touch.port, v, nullptr, 1.0) == PH_NULL_ARGUMENT);
  CHECK(c.held(touch.port, nullptr) == PH_NULL_ARGUMENT);
  CHECK(c.tick(touch.port, v, 1e-3, nullptr) == PH_NULL_ARGUMENT);
  for (const auto& wrong :
       {c.tick(touch.port, nullptr, 1e-3, &r), c.tick_wanted(guard.port, v, 1e-3, nullptr, &r),
        c.tick_wanted(guard.port, nullptr, 1e-3, v, &r)}) {
    CHECK(wrong == PH_NULL_ARGUMENT);
    CHECK(r.event == PH_REJECTED_SAMPLE);
    CHECK((r.force[0] == 0.0 && r.force[1] == 0.0 && r.force[2] == 0.0));
  }
  // A plane for a guard, a force for a touch.
  CHECK(c.publish_plane(guard.port, v, v, 1.0) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.publish_nothing(guard.port) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(c.tick_wanted(touch.port, v, 1e-3, v, &r) == PH_NOT_OF_THIS_COMPOSITION);
  CHECK(r.event == PH_REJECTED_SAMPLE);
}

TEST_CASE("a number that is none gives force zero, an event and no credit, from C too",
          "[c_interface]") {
  const loaded c;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double none[3] = {0, nan, 0};
  const double up[3] = {0, 0, 1};
  const double zero[3] = {0, 0, 0};
  ph_result r{};
  r.size = sizeof r;
  const opened touch(c, "touch", grip());
  const auto press = [&] {
    for (int n = 0; n <= 50; ++n) {
      const double x[3] = {0, 0, -2e-5 * n};
      REQUIRE(c.tick(touch.port, x, 1e-3, &r) == PH_OK);
    }
    CHECK(r.event == PH_NOMINAL);
    CHECK(r.force[2] > 0.5);
  };
  CHECK(c.publish_plane(touch.port, none, up, 1000.0) == PH_REFUSED_PLANE);
  CHECK(c.publish_plane(touch.port, zero, none, 1000.0) == PH_REFUSED_PLANE);
  CHECK(c.publish_plane(touch.port, zero, zero, 1000.0) == PH_REFUSED_PLANE);
  CHECK(c.publish_plane(touch.port, zero, up, nan) == PH_REFUSED_PLANE);
  CHECK(c.publish_plane(touch.port, zero, up, 0.0) == PH_REFUSED_PLANE);
  CHECK(c.publish_plane(touch.port, zero, up, 1000.0) == PH_OK);
  struct bad {
    const double* position;
    double dt;
  };
  const double far_away[3] = {0, 0, 1.0};
  for (const bad& sample :
       {bad{none, 1e-3}, bad{zero, nan}, bad{zero, 0.0}, bad{zero, -1e-3}, bad{far_away, 1e-3}}) {
    press();
    const double before = r.energy;
    CHECK(c.tick(touch.port, sample.position, sample.dt, &r) == PH_OK);
    CHECK(r.event == PH_REJECTED_SAMPLE);
    CHECK((r.force[0] == 0.0 && r.force[1] == 0.0 && r.force[2] == 0.0));
    CHECK(r.energy <= std::max(before, ph::amends_for(3.3)));  // what is forgiven, and no credit
  }
  press();
  CHECK(c.held(touch.port, none) == PH_OK);
  CHECK(c.tick(touch.port, zero, 1e-3, &r) == PH_OK);
  CHECK(r.event == PH_REJECTED_SAMPLE);
  CHECK(c.tick(touch.port, zero, 1e-3, &r) == PH_OK);  // said for one tick only
  CHECK(r.event == PH_NOMINAL);
  const double millimetres[3] = {0, 0, 20.0};
  const opened elsewhere(c, "touch", grip());
  CHECK(c.tick(elsewhere.port, zero, 1e-3, &r) == PH_OK);
  CHECK(c.tick(elsewhere.port, millimetres, 10.0, &r) == PH_OK);
  CHECK(r.event == PH_OUTSIDE_WORKSPACE);
}

TEST_CASE("two ports share nothing", "[c_interface]") {
  const loaded c;
  const opened one(c, "touch", grip());
  const opened two(c, "touch", grip());
  const double up[3] = {0, 0, 1};
  const double zero[3] = {0, 0, 0};
  REQUIRE(c.publish_plane(one.port, zero, up, 1000.0) == PH_OK);
  ph_result a{};
  ph_result b{};
  a.size = b.size = sizeof a;
  for (int n = 0; n < 50; ++n) {
    const double x[3] = {0, 0, -2e-5 * n};
    REQUIRE(c.tick(one.port, x, 1e-3, &a) == PH_OK);
    REQUIRE(c.tick(two.port, x, 1e-3, &b) == PH_OK);
  }
  CHECK(a.event == PH_NOMINAL);
  CHECK(a.force[2] > 0.5);
  CHECK(b.event == PH_NO_TARGET);
  CHECK(b.force[2] == 0.0);
}

TEST_CASE("one thread publishes while another ticks", "[c_interface]") {
  const loaded c;
  const opened touch(c, "touch", grip());
  std::atomic<bool> over{false};
  std::thread environment([&] {
    const double point[3] = {0, 0, 0};
    const double normal[3] = {0, 0, 1};
    for (int n = 0; !over; ++n) {
      c.publish_plane(touch.port, point, normal, n % 2 == 1 ? 1000.0 : 2000.0);
    }
  });
  ph_result r{};
  r.size = sizeof r;
  bool good = true;
  int contacts = 0;
  constexpr int most = 20'000'000;  // the other thread may take its time to begin
  for (int n = 0; contacts < 10000 && n < most; ++n) {
    const int at = n % 400 < 200 ? 100 - n % 200 : n % 200 - 100;
    const double x[3] = {0, 0, 1e-5 * at};
    c.tick(touch.port, x, 1e-3, &r);
    good = good && r.force[0] == 0.0 && r.force[1] == 0.0 && r.force[2] >= 0.0 &&
           r.force[2] <= 3.3 && r.event <= PH_NO_TARGET;
    contacts += r.force[2] > 0.0;
  }
  over = true;
  environment.join();
  CHECK(good);
  CHECK(contacts == 10000);
}

TEST_CASE("none but ph_create and ph_destroy allocates", "[c_interface]") {
  const loaded c;
  const auto in_create = allocations();
  const opened touch(c, "encoder_touch", on_encoders());
  const opened guard(c, "force_guard", grip());
  CHECK(allocations() == in_create + 2);  // the control: what the library asks for is counted
  ph_result r{};
  r.size = sizeof r;
  const auto before = allocations();
  for (int n = 0; n < ticks; ++n) {
    const moment now = moment_at(n);
    if (now.news == a_plane) c.publish_plane(touch.port, now.point, now.normal, now.stiffness);
    if (now.news == nothing_here) c.publish_nothing(touch.port);
    if (now.reports_held) c.held(touch.port, now.held);
    c.tick(touch.port, now.position, now.dt, &r);
    c.tick_wanted(guard.port, now.position, now.dt, now.wanted, &r);
    (void)c.event_text(r.event);
  }
  CHECK(allocations() == before);
}

TEST_CASE("version, texts and budget are the library's", "[c_interface]") {
  const loaded c;
  CHECK(c.version() == 10000 * ph::version_major + 100 * ph::version_minor + ph::version_patch);
  for (int e = PH_NOMINAL; e <= PH_FORCES_OFF; ++e) {
    CHECK(std::string(c.event_text(e)) == ph::to_string(static_cast<ph::event>(e)));
  }
  for (const int none : {-1, PH_FORCES_OFF + 1, 1 << 20}) {
    CHECK(std::string(c.event_text(none)) == "unknown event");
    CHECK(std::string(c.status_text(none)) == "unknown status");
  }
  for (int s = PH_OK; s <= PH_REFUSED_PLANE; ++s) {
    CHECK(std::string(c.status_text(s)) != "unknown status");
  }
  double K = 0.0;
  const char* because = nullptr;
  const auto p = on_encoders();
  CHECK(c.stiffness_budget(&p, &K, &because) == PH_OK);
  const auto budget = ph::design::stiffness_budget(stated);
  CHECK(K == budget.stiffness);
  CHECK(std::string(because) == budget.because());
  auto bad = p;
  bad.mass = 0.0;
  CHECK(c.stiffness_budget(&bad, &K, &because) == PH_REFUSED_PARAMETER);
  CHECK(K == 0.0);
}

TEST_CASE("a port explains itself in C as it does in C++", "[c_interface]") {
  const loaded c;
  ph_parameters slow = grip();
  slow.longest_tick = 2e-2;
  const opened touch(c, "touch", slow), guard(c, "force_guard", grip());
  const opened strict(c, "strict_guard", grip());
  const double point[3] = {0, 0, 0}, up[3] = {0, 0, 1}, inside[3] = {0, 0, -1e-3};
  ph_explanation e{};
  CHECK(c.explain(touch.port, &e) == PH_WRONG_SIZE);
  e.size = sizeof e;
  CHECK(c.explain(nullptr, &e) == PH_NULL_ARGUMENT);
  CHECK(c.explain(touch.port, nullptr) == PH_NULL_ARGUMENT);
  REQUIRE(c.publish_plane(touch.port, point, up, 1e4) == PH_OK);
  ph_result r{};
  r.size = sizeof r;
  auto direct = exact;
  direct.longest_tick = 2e-2;
  auto same = ph::make_touch<d3>(direct, hand);
  REQUIRE(same.update({d3::zero(), d3::vector(0, 0, 1), 1e4}));
  for (int n = 0; n < 20; ++n) {
    REQUIRE(c.tick(touch.port, inside, 1e-2, &r) == PH_OK);
    (void)same.tick({0, 0, -1e-3}, 10ms);
  }
  const auto said = same.explain();
  CHECK(c.explain(touch.port, &e) == PH_OK);
  CHECK(e.asked == 1e4);
  CHECK(e.shown == said.shown);
  CHECK(e.shown < 50.0);
  CHECK(e.depth == said.depth);
  CHECK(e.force == said.force);
  CHECK(std::string(e.because) == said.because());
  CHECK(c.explain(guard.port, &e) == PH_OK);
  CHECK(e.shown > 1000.0);
  CHECK(c.explain(strict.port, &e) == PH_NOT_OF_THIS_COMPOSITION);
}
