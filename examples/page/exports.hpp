// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The C interface of a module, for the page and for the native run that it is compared with. Included by
// one source a module, which defines page::stages().

#include "stage.hpp"
#include <passive_haptics/design/stiffness_budget.hpp>
#include <passive_haptics/identification/device_facts.hpp>

#include <cstdint>
#include <cstring>
#include <limits>

#ifdef __wasm__
#define PAGE_EXPORT(name) extern "C" __attribute__((export_name(#name)))
#else
#define PAGE_EXPORT(name) extern "C"
#endif

#if defined(__wasm__) && defined(_LIBCPP_VERSION) && _LIBCPP_VERSION >= 15000
// libc++ would print before it ends; a page has nobody to print to, and printf takes 35 kB.
namespace std {
inline namespace _LIBCPP_ABI_NAMESPACE {
[[noreturn]] void __libcpp_verbose_abort(const char*, ...) noexcept {
  __builtin_trap();
}
}  // namespace _LIBCPP_ABI_NAMESPACE
}  // namespace std
#endif

namespace page {

/// The stages of this module.
[[nodiscard]] std::span<stage* const> stages() noexcept;

inline stage& on(int scene) noexcept {
  const auto all = stages();
  return *all[scene >= 0 && scene < static_cast<int>(all.size()) ? static_cast<std::size_t>(scene)
                                                                 : 0];
}

inline double numbers[8192];  ///< what a call hands out

}  // namespace page

PAGE_EXPORT(ph_stages) int ph_stages() {
  return static_cast<int>(page::stages().size());
}
PAGE_EXPORT(ph_controllers) int ph_controllers(int s) {
  return page::on(s).controllers();
}
PAGE_EXPORT(ph_name) const char* ph_name(int s, int i) {
  return page::on(s).name(i);
}
PAGE_EXPORT(ph_says) const char* ph_says(int s, int i) {
  return page::on(s).says(i);
}
PAGE_EXPORT(ph_text) const char* ph_text(int s, int i) {
  return page::on(s).text(i);
}
PAGE_EXPORT(ph_promise) int ph_promise(int s, int i) {
  return page::on(s).promise(i);
}

PAGE_EXPORT(ph_parameters) int ph_parameters() {
  return static_cast<int>(page::parameters.size());
}
PAGE_EXPORT(ph_parameter) const char* ph_parameter(int i) {
  return page::parameters[static_cast<std::size_t>(i)].name;
}
PAGE_EXPORT(ph_get) double ph_get(int s, int i) {
  return page::on(s).set.*page::parameters[static_cast<std::size_t>(i)].value;
}
/// Not a number and infinity are left alone: whoever asks is told by what ph_get says.
PAGE_EXPORT(ph_set) void ph_set(int s, int i, double value) {
  if (value - value == 0) {
    page::on(s).set.*page::parameters[static_cast<std::size_t>(i)].value = value;
    page::on(s).still = 0;
  }
}

PAGE_EXPORT(ph_home) const double* ph_home(int s) {
  const page::place home = page::on(s).home();
  page::numbers[0] = home.x;
  page::numbers[1] = home.y;
  return page::numbers;
}
PAGE_EXPORT(ph_choose) void ph_choose(int s, int side, int controller) {
  page::on(s).choose(side, controller);
}
PAGE_EXPORT(ph_restart) void ph_restart(int s) {
  page::on(s).restart();
}
PAGE_EXPORT(ph_aim) void ph_aim(int s, double x, double y) {
  page::on(s).hand.send({x, y});
}
PAGE_EXPORT(ph_by_itself) void ph_by_itself(int s, int yes) {
  page::on(s).by_itself = yes != 0;
}
PAGE_EXPORT(ph_run) void ph_run(int s, int ticks) {
  page::on(s).run(ticks);
}

PAGE_EXPORT(ph_rows_kept) int ph_rows_kept() {
  return page::rows_kept;
}
PAGE_EXPORT(ph_row_width) int ph_row_width() {
  return sizeof(page::row) / sizeof(double);
}
PAGE_EXPORT(ph_rows) const page::row* ph_rows(int s, int side) {
  return page::on(s).seen[side].rows();
}
PAGE_EXPORT(ph_count) double ph_count(int s, int side) {
  return static_cast<double>(page::on(s).seen[side].count());
}
PAGE_EXPORT(ph_verdict) const double* ph_verdict(int s, int side) {
  page::verdict v = page::on(s).seen[side].judge(page::on(s).least_energy(side));
  page::on(s).judge(side, v);
  std::memcpy(page::numbers, &v, sizeof v);
  return page::numbers;
}
/// How many planes, and after that x y nx ny of each.
PAGE_EXPORT(ph_planes) const double* ph_planes(int s, int side, int local) {
  std::array<page::drawn_plane, 8> planes;
  const int n = page::on(s).draw(side, local != 0, planes);
  page::numbers[0] = n;
  std::memcpy(page::numbers + 1, planes.data(), static_cast<std::size_t>(n) * sizeof planes[0]);
  return page::numbers;
}
/// How many corners of triangles, and after that x y of each.
PAGE_EXPORT(ph_outline) const double* ph_outline(int s, int side) {
  std::array<page::place, 4000> corners;
  const int n = page::on(s).outline(side, corners);
  page::numbers[0] = n;
  std::memcpy(page::numbers + 1, corners.data(), static_cast<std::size_t>(n) * sizeof corners[0]);
  return page::numbers;
}

namespace page {
[[nodiscard]] inline ph::design::budget budget_of(const settings& s) noexcept {
  return ph::design::stiffness_budget({.mass = s.mass,
                                       .damping = s.damping,
                                       .friction = s.friction,
                                       .presliding = 0,
                                       .quantum = s.quantum,
                                       .force_limit = s.motors,
                                       .longest_tick = tick_length,
                                       .latency = static_cast<int>(s.late)},
                                      {.hand_force = s.hand_force});
}
}  // namespace page

/// The stiffness that is paid for, which limit binds, and each of them [N/m].
PAGE_EXPORT(ph_budget) const double* ph_budget(int s) {
  const auto b = page::budget_of(page::on(s).set);
  page::numbers[0] = b.stiffness;
  page::numbers[1] = static_cast<double>(b.binding);
  for (std::size_t i = 0; i < b.limits.size(); ++i) page::numbers[2 + i] = b.limits[i];
  return page::numbers;
}
PAGE_EXPORT(ph_because) const char* ph_because(int s) {
  return page::budget_of(page::on(s).set).because();
}

/// The catalogue: how many devices there are, the name of each, and its mass, friction, step and peak force in SI
/// units, not a number where nobody has published it, or where the device turns.
PAGE_EXPORT(ph_devices) int ph_devices() {
  return static_cast<int>(passive_haptics::design::devices::all.size());
}
PAGE_EXPORT(ph_device) const char* ph_device(int i) {
  return passive_haptics::design::devices::all[static_cast<std::size_t>(i)].name;
}
PAGE_EXPORT(ph_facts) const double* ph_facts(int i) {
  const auto& d = passive_haptics::design::devices::all[static_cast<std::size_t>(i)];
  const std::array known{d.mass, d.friction, d.quantum[0], d.peak_force};
  for (std::size_t k = 0; k < known.size(); ++k) {
    page::numbers[k] =
        known[k] && !d.rotary ? known[k].value : std::numeric_limits<double>::quiet_NaN();
  }
  return page::numbers;
}

namespace page {
/// FNV-1a over positions, forces and ledger of a controller on its own round, from the start.
[[nodiscard]] inline std::uint64_t fingerprint(stage& s, int controller, int ticks) noexcept {
  s.by_itself = true;
  s.choose(0, controller);
  s.choose(1, controller);
  s.restart();
  std::uint64_t hash = 14695981039346656037ull;
  for (int n = 0; n < ticks; ++n) {
    s.run(1);
    const row& r = s.seen[0].rows()[n % rows_kept];
    for (const double value : {r.x, r.y, r.force_x, r.force_y, r.port, r.ledger}) {
      std::uint64_t bits = 0;
      const double unsigned_zero = value + 0.0;  // −0 is 0: three controllers differ in it
      std::memcpy(&bits, &unsigned_zero, sizeof bits);
      hash = (hash ^ bits) * 1099511628211ull;
    }
  }
  return hash;
}
}  // namespace page

/// Its two halves, as a page has no integers of 64 bits in a double.
PAGE_EXPORT(ph_fingerprint) const double* ph_fingerprint(int s, int controller, int ticks) {
  const std::uint64_t hash = page::fingerprint(page::on(s), controller, ticks);
  page::numbers[0] = static_cast<double>(hash >> 32);
  page::numbers[1] = static_cast<double>(hash & 0xffffffffu);
  page::numbers[2] = page::on(s).least_energy(0);
  return page::numbers;
}
