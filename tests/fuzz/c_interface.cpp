// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's door to the C interface, whose source is compiled in: any name, any parameters of any size, any calls
// on a port that is alive. Every force is a number and within what the motors hold.
#include "examples/c_interface/passive_haptics_c.cpp"
#include "fuzz/numbers.hpp"

#include <cmath>
#include <cstdlib>

namespace {

const char* one_port(fuzz::numbers& in) {
  constexpr const char* names[]{"touch",       "quantised_touch", "encoder_touch", "strict_touch",
                                "force_guard", "strict_guard",    "encoder_guard", "none",
                                nullptr};
  const char* name = names[in.one() % std::size(names)];
  ph_parameters p{};
  p.size = in.one() < 240 ? sizeof p : in.any<std::uint32_t>();
  p.latency = in.one() < 240 ? in.one() % 3 : in.any<std::uint32_t>();
  p.mass = in.about(0.1);
  p.damping = in.about(0.05);
  p.hand_force = in.about(5.0);
  p.force_limit = in.about(9.0);
  p.longest_tick = in.about(1e-3);
  p.friction = in.about(0.13);
  p.presliding = in.about(15e-6);
  p.quantum = in.one() < 128 ? 0.0 : in.about(20e-6);
  for (double* more : {&p.continuous_force, &p.winding_time, &p.turn_rate, &p.stale_after,
                       &p.top_speed, &p.workspace, &p.watchdog}) {
    *more = in.one() < 160 ? 0.0 : in.about(1.0);
  }
  std::array<char, PH_TEXT_ROOM> why{};
  const std::size_t room = in.one() % 2 == 0 ? why.size() : in.one() % why.size();
  ph_port* port = nullptr;
  const int made = ph_create(name, in.one() < 250 ? &p : nullptr, &port, why.data(), room);
  if ((made == PH_OK) != (port != nullptr)) return "a port, or a reason, not both";
  if (room > 0 && std::memchr(why.data(), 0, room) == nullptr) return "a text without its end";
  if (made != PH_OK && room > 40 && why[0] == 0) return "refused without a word";
  double stiffness = 0.0;
  (void)ph_stiffness_budget(&p, &stiffness, nullptr);
  (void)ph_guarantee_of(port);
  double x[3]{}, wanted[3]{}, other[3]{};
  const auto put = [&in](double* to, double size) {
    for (int i = 0; i < 3; ++i) to[i] = in.around<double>(size);
  };
  for (int n = 0; n < 300 && !in.empty(); ++n) {
    const unsigned op = in.one();
    if (op % 16 == 0) {
      put(wanted, 2e-3);
      put(other, 1.0);
      (void)ph_publish_plane(port, wanted, op == 16 ? nullptr : other, in.about(1000.0));
    }
    if (op == 1) (void)ph_publish_nothing(port);
    if (op % 16 == 2) {
      put(other, 9.0);
      (void)ph_held(port, other);
    }
    put(x, 5e-3);
    const double dt = op < 200 ? 1e-3 : in.around<double>(2e-3);
    ph_result out{};
    out.size = op == 3 ? in.any<std::uint32_t>() : sizeof out;
    int said = 0;
    if (op % 2 == 0) {
      said = ph_tick(port, op == 4 ? nullptr : x, dt, &out);
    } else {
      put(wanted, 20.0);
      said = ph_tick_wanted(port, x, dt, op == 5 ? nullptr : wanted, &out);
    }
    if (said == PH_NULL_ARGUMENT && port != nullptr && op != 4 && op != 5)
      return "no pointer is NULL";
    const double size = std::hypot(out.force[0], out.force[1], out.force[2]);
    if (!std::isfinite(size)) return "a force that is no number";
    if (size > 0.0 && port == nullptr) return "a force of no port";
    if (port != nullptr && size > p.force_limit * (1.0 + 1e-12) + 1e-150)
      return "a force above the motors' limit";
    if (ph_event_text(out.event) == nullptr) return "an event without a text";
  }
  ph_destroy(port);
  return nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::numbers in({data, size});
  if (const char* broken = one_port(in)) {
    std::fprintf(stderr, "%s\n", broken);
    std::abort();
  }
  return 0;
}
