// SPDX-License-Identifier: BSD-3-Clause
// A force bound of your own: write it, prove its laws at compile time, put it into a chain.
//
// This one drops every force too small to feel, say because it would only make a gearbox rattle.
// Its answer is a share of the force desired, so it can only ever reduce: it may stand behind a
// strict bound without spoiling it.

#include <passive_haptics/laws.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

/// f = 0 where |f*| < `least`, f* elsewhere. Written for one port, so it computes by itself.
struct dead_zone {
  static constexpr ph::guarantee passivity = ph::guarantee::none;  // alone it promises nothing
  static constexpr ph::bound_traits traits{};                      // and asks for nothing

  double least{};  ///< [N]

  [[nodiscard]] constexpr ph::share<double> limit(double desired,
                                                  const auto& /*port*/) const noexcept {
    return {scene::norm(desired) < least ? 0.0 : 1.0};
  }
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept {
    if (least >= 0.0 && ph::kernels::is_finite(least)) return {};
    return {"least", least, "finite and ≥ 0 N"};
  }
};

constexpr dead_zone quiet{.least = 0.5};
constexpr ph::bound_chain chain{ph::strict_bound{}, quiet};

// It has the shape of a bound, and breaks no law of bounds; nor does the chain.
static_assert(ph::force_bound_for<dead_zone, scene>);
static_assert(ph::laws::all<dead_zone, scene>(quiet));
static_assert(ph::laws::all<decltype(chain), scene>(chain));
// Alone it is not strict; the chain is, and says so.
static_assert(!ph::laws::loses_to_no_motion<scene>(quiet));
static_assert(ph::laws::loses_to_no_motion<scene>(chain));
static_assert(ph::promise_of<decltype(chain), scene>() == ph::guarantee::strict);

int main() {
  const ph::half_space<scene> surface{.point = 0.0, .normal = 1.0, .stiffness = 1000.0};
  // By hand: a part of your own among the others.
  ph::local_model wall{scene{},
                       ph::fixed{surface},
                       ph::turn_at_once{},
                       ph::spring{},
                       ph::reduced_energy{.damping = 0.5},
                       chain,
                       ph::loop_limits{.longest_tick = 1e-3}};
  for (const double millimetres : {2.0, 1.0, -0.2, -0.4, -0.6, -0.8}) {
    const auto out = wall.tick(millimetres * 1e-3, ph::seconds{1e-3});
    std::printf("x %4.1f mm  force %5.3f N\n", millimetres, out.force);
  }
}
