// SPDX-License-Identifier: BSD-3-Clause
// Bad input on the target: force zero or the last good surface, an event, no fault of the core, and
// contact comes back. Prints which floating-point exceptions each of them raised.
#include "../replay/subjects.hpp"
#include "check.hpp"

#include <limits>

namespace {

namespace ph = passive_haptics;

using limits = std::numeric_limits<real>;
using ph::event;

/// The exceptions that the FPU has seen since the last call.
class exceptions {
 public:
  enum : std::uint32_t { invalid = 1, by_zero = 2, overflow = 4, underflow = 8, inexact = 16 };
  static std::uint32_t taken() {
#ifdef __ARM_FP
    std::uint32_t status = 0;
    asm volatile("vmrs %0, fpscr" : "=r"(status)::"memory");
    asm volatile("vmsr fpscr, %0" ::"r"(status & ~0x9FU) : "memory");
    return status & 0x9F;
#else
    return 0;
#endif
  }
  static void print(const char* scene, const char* what, std::uint32_t raised) {
#ifndef __ARM_FP
    return;  // no FPU, no exceptions
#endif
    text_line line;
    line.words(scene, what, "raised");
    if (raised & invalid) line.words("invalid");
    if (raised & by_zero) line.words("division-by-zero");
    if (raised & overflow) line.words("overflow");
    if (raised & underflow) line.words("underflow");
    if (raised & inexact) line.words("inexact");
    if (raised == 0) line.words("nothing");
    line.print();
  }
};

constexpr real T = real(0.0002F);

template <class Subject>
class trial {
  static constexpr int dof = Subject::dof;
  using space = typename Subject::space;
  using vector = typename space::vector;
  static constexpr bool moves = requires(decltype(Subject::model) m) { m.update({}); };
  static constexpr bool triangle = std::is_same_v<Subject, replay::composed_triangle_thesis>;

 public:
  explicit trial(checks& check) : check_(check) {
    in_contact();
    bad_samples();
    if constexpr (moves) {
      bad_surfaces();
      silence();
    }
    extremes();
  }

 private:
  /// `depth` inside the surface, away from the edges.
  static vector inside(real depth) {
    vector x = space::zero();
    space::component(x, dof - 1) = -depth;
    return x;
  }
  static replay::surface good() {
    const auto b = [](float v) { return std::bit_cast<replay::bits>(v); };
    replay::surface s{};
    s.stiffness = b(3000);
    if (triangle) return {{b(-1), b(-1), 0}, {b(1), b(-1), 0}, {0, b(1), 0}, b(3000)};
    s.b[dof - 1] = b(1);
    return s;
  }
  auto tick(const vector& x, real dt) { return Subject::call(subject_.model, x, dt); }
  void update(const replay::surface& s) {
    if constexpr (moves) subject_.update(s);
  }

  void in_contact() {
    update(good());
    (void)tick(inside(real(-0.001F)), T);
    (void)exceptions::taken();
    for (int n = 0; n < 20; ++n) (void)tick(inside(real(1e-5F) * real(n)), T);
    const auto out = tick(inside(real(0.0002F)), T);
    const std::uint32_t raised = exceptions::taken();
    check_(space::norm(out.force) > 0, Subject::scene, "a good tick in contact has a force");
    check_(out.what == event::nominal, Subject::scene, "a good tick is nominal");
    check_((raised & (exceptions::invalid | exceptions::by_zero | exceptions::overflow)) == 0,
           Subject::scene, "good ticks raise neither invalid, division by zero nor overflow");
    exceptions::print(Subject::scene, "good ticks", raised);
  }

  void bad_sample(const char* what, const vector& x, real dt) {
    const real before = subject_.model.energy();
    (void)exceptions::taken();
    const auto out = tick(x, dt);
    exceptions::print(Subject::scene, what, exceptions::taken());
    check_(out.what == event::rejected_sample, what, "is reported");
    check_(out.force == space::zero(), what, "gets force zero");
    check_(out.energy <= before, what, "brings no credit");
    const auto after = tick(inside(real(0.0002F)), T);
    check_(after.what != event::rejected_sample, what, "is over with the next good sample");
    check_(space::is_finite(after.force) && ph::kernels::is_finite(after.energy), what,
           "leaves numbers behind");
  }

  void bad_samples() {
    for (int axis = 0; axis < dof; ++axis) {
      vector x = inside(real(0.0002F));
      space::component(x, axis) = limits::quiet_NaN();
      bad_sample("position NaN", x, T);
      space::component(x, axis) = limits::infinity();
      bad_sample("position infinite", x, T);
      space::component(x, axis) = limits::max();
      bad_sample("position at the end of numbers", x, T);
    }
    const vector here = inside(real(0.0002F));
    bad_sample("dt zero", here, 0);
    bad_sample("dt negative", here, -T);
    bad_sample("dt NaN", here, limits::quiet_NaN());
    bad_sample("dt infinite", here, limits::infinity());
  }

  void bad_surfaces() {
    const auto nan = std::bit_cast<replay::bits>(limits::quiet_NaN());
    for (int kind = 0; kind < 4; ++kind) {
      replay::surface s = good();
      if (kind == 0) s.stiffness = nan;
      if (kind == 1) s.stiffness = 0;
      if (kind == 2) s.a[0] = nan;
      if (kind == 3) {
        for (int i = 0; i < 3; ++i) s.a[i] = s.b[i] = s.c[i] = 0;
      }
      update(good());
      (void)tick(inside(real(0.0002F)), T);
      check_(!subject_.update(s), Subject::scene, "an unusable surface is refused");
      const auto out = tick(inside(real(0.00021F)), T);
      check_(out.what == event::rejected_target, Subject::scene, "an unusable surface is reported");
      check_(space::is_finite(out.force), Subject::scene, "the last good surface stays");
    }
  }

  void silence() {
    update(good());
    event worst = event::nominal;
    real force = 1;
    for (int n = 0; n < 200; ++n) {  // 40 ms; stale after 20, faded after 30
      const auto out = tick(inside(real(0.0002F)), T);
      worst = ph::worse(worst, out.what);
      force = space::norm(out.force);
    }
    check_(worst == event::stale_target, Subject::scene, "a silent environment is reported");
    check_(force == 0, Subject::scene, "the contact with it fades out");
    update(good());
    (void)tick(inside(real(-0.001F)), T);
    (void)tick(inside(real(0.0001F)), T);
    const auto out = tick(inside(real(0.0002F)), T);
    check_(space::norm(out.force) > 0, Subject::scene, "contact comes back with the next word");
  }

  void extremes() {
    replay::surface s = good();
    s.stiffness = std::bit_cast<replay::bits>(std::numeric_limits<float>::max());
    update(s);
    for (const real depth : {real(0.5F), real(0.45F), real(1e-40F), real(0), real(-0.1F)}) {
      const auto out = tick(inside(depth), T);
      check_(space::is_finite(out.force) && ph::kernels::is_finite(out.energy), Subject::scene,
             "extreme numbers give numbers");
    }
  }

  checks& check_;
  Subject subject_;
};

}  // namespace

int program() {
  checks check;
  trial<replay::composed_wall_strict>{check};
  trial<replay::composed_wall_reachable>{check};
  trial<replay::composed_plane_strict>{check};
  trial<replay::composed_plane_reachable>{check};
  trial<replay::composed_triangle_thesis>{check};
  return check.result();
}
