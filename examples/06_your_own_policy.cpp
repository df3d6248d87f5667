// SPDX-License-Identifier: BSD-3-Clause
// A force bound of your own: write it, prove its laws at compile time, put it into a chain.
//
// This one drops every force too small to feel, say because it would only make a gearbox rattle.
// It only ever reduces, so it may stand behind a strict bound without spoiling it.

#include <passive_haptics/laws.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <cstdio>

namespace ph = passive_haptics;
using scene = ph::space<double, 1>;

/// f = 0 where |f*| < `least`, f* elsewhere.
template <class Space>
struct dead_zone {
  using scalar = typename Space::scalar;
  using vector = typename Space::vector;
  static constexpr ph::guarantee passivity = ph::guarantee::none;  // alone it promises nothing
  static constexpr ph::bound_traits traits{.only_reduces = true};

  scalar least{};  ///< [N]

  [[nodiscard]] constexpr vector limit(const vector& desired,
                                       const auto& /*state*/) const noexcept {
    return Space::norm(desired) < least ? Space::zero() : desired;
  }
  [[nodiscard]] constexpr ph::parameter_fault<scalar> check() const noexcept {
    if (least >= scalar(0) && ph::kernels::is_finite(least)) return {};
    return {"least", least, "finite and ≥ 0 N"};
  }
};

constexpr dead_zone<scene> quiet{.least = 0.5};
constexpr ph::bound_chain chain{ph::strict_bound<scene>{}, quiet};

// It has the shape of a bound, and obeys what `only_reduces` says.
static_assert(ph::force_bound_for<dead_zone<scene>, scene>);
static_assert(ph::laws::adds_nothing_to_zero<scene>(quiet));
static_assert(ph::laws::scales_down<scene>(quiet));
// Alone it is not strict; the chain is, and says so.
static_assert(!ph::laws::spends_at_most_the_ledger<scene>(quiet));
static_assert(ph::laws::spends_at_most_the_ledger<scene>(chain));
static_assert(decltype(chain)::passivity == ph::guarantee::strict);

int main() {
  const ph::half_space<scene> surface{.point = 0.0, .normal = 1.0, .stiffness = 1000.0};
  ph::reduced_energy<scene> ledger{.damping = 0.5};
  ph::local_model wall{scene{}, ph::rigid{surface}, ph::snap<scene>{}, ph::spring<scene>{}, ledger,
                       chain};
  for (const double millimetres : {2.0, 1.0, -0.2, -0.4, -0.6, -0.8}) {
    const auto out = wall.tick(millimetres * 1e-3, 1e-3);
    std::printf("x %4.1f mm  force %5.3f N\n", millimetres, out.force);
  }
}
