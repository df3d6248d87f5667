// SPDX-License-Identifier: BSD-3-Clause
// EXPECT: passive_haptics: the supply does not model supply_for
//
// What moves can also end: the environment says so with release().

#include <passive_haptics/constraint_geometry/fixed.hpp>
#include <passive_haptics/constraint_geometry/followed.hpp>
#include <passive_haptics/constraint_geometry/half_space.hpp>
#include <passive_haptics/contact/spring.hpp>
#include <passive_haptics/energy_observer/reduced_energy.hpp>
#include <passive_haptics/force_bound/strict_bound.hpp>
#include <passive_haptics/local_model.hpp>
#include <passive_haptics/normal_interpolation/turn_at_once.hpp>

namespace ph = passive_haptics;
using scene = ph::space<float, 1>;

using wall = ph::half_space<scene>;

class mine {
 public:
  using constraint_type = wall;
  static constexpr bool moves = true;
  constexpr const wall& local() const noexcept { return followed_.local(); }
  constexpr const wall& target() const noexcept { return followed_.target(); }
  constexpr bool published() const noexcept { return followed_.published(); }
  constexpr bool changed() const noexcept { return followed_.changed(); }
  constexpr bool refused() const noexcept { return followed_.refused(); }
  constexpr bool current() const noexcept { return followed_.current(); }
  constexpr bool stale() const noexcept { return followed_.stale(); }
  constexpr bool together() const noexcept { return followed_.together(); }
  constexpr float weight() const noexcept { return followed_.weight(); }
  constexpr float last_weight() const noexcept { return followed_.last_weight(); }
  constexpr bool update(const wall& next) noexcept { return followed_.update(next); }
#ifdef POSITIVE_CONTROL
  constexpr void release() noexcept {
    followed_.release();
  }
#endif
  constexpr void grow_older(float dt) noexcept {
    followed_.grow_older(dt);
  }
  constexpr void sync() noexcept {
    followed_.sync();
  }
  constexpr void seen(float weight) noexcept {
    followed_.seen(weight);
  }
  constexpr void approach(bool own, float x, float n, float d) noexcept {
    followed_.approach(own, x, n, d);
  }

 private:
  ph::followed<wall> followed_;
};

ph::local_model model{scene{},
                      mine{},
                      ph::turn_at_once{},
                      ph::spring{},
                      ph::reduced_energy{},
                      ph::strict_bound{},
                      ph::loop_limits{}};
