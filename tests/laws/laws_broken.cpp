// SPDX-License-Identifier: BSD-3-Clause
// Liars, one for each law, and laws::all names the law that they break. Each is honest but for one line.
#include "support/obedience.hpp"

#include <string_view>

namespace {

// ------------------------------------------------------------------------------ of a port
struct counts_too_little : ph::isotropic_damping {
  using ph::isotropic_damping::isotropic_damping;
  template <class P>
  struct on : ph::isotropic_damping::on<P> {
    using ph::isotropic_damping::on<P>::on;
    [[nodiscard]] constexpr double worst_outflow(double f, double T) const noexcept {
      return 0.9 * ph::isotropic_damping::on<P>::worst_outflow(f, T);
    }
  };
};
struct affords_too_much : ph::isotropic_damping {
  using ph::isotropic_damping::isotropic_damping;
  template <class P>
  struct on : ph::isotropic_damping::on<P> {
    using ph::isotropic_damping::on<P>::on;
    [[nodiscard]] constexpr double affordable(double f, double E, double T) const noexcept {
      const double left = ph::isotropic_damping::on<P>::affordable(f, E, T);
      return ph::kernels::smaller(1.0, 1.01 * left);
    }
  };
};
struct square_of_a_norm : ph::isotropic_inertia {
  template <class P>
  struct on : ph::isotropic_inertia::on<P> {
    using ph::isotropic_inertia::on<P>::on;
    [[nodiscard]] constexpr double norm(double f) const noexcept { return f * f; }
  };
};

/// Any observer that is the ledger of the thesis but for one function.
struct ledger : ph::reduced_energy {
  template <ph::port P>
  using honest = ph::reduced_energy::on<P>;
};
struct generous : ledger {
  template <ph::port P>
  struct on : honest<P> {
    using honest<P>::on;
    constexpr bool update(double dx, double held, double dt) noexcept {
      return honest<P>::update(2 * dx, held, dt);
    }
  };
};
struct forgiving : ledger {
  template <ph::port P>
  struct on : honest<P> {
    using honest<P>::on;
    constexpr void forfeit(double /*held*/, double /*T*/) noexcept {
      static_cast<void>(honest<P>::update(0.001, 0.0, 0.001));
    }
  };
};
struct gullible : ledger {
  template <ph::port P>
  struct on : honest<P> {
    using honest<P>::on;
    constexpr bool update(double dx, double held, double dt) noexcept {
      static_cast<void>(honest<P>::update(dx, held, dt));
      return true;
    }
  };
};
struct nostalgic : ledger {
  template <ph::port P>
  struct on : honest<P> {
    using honest<P>::on;
    constexpr void reset() noexcept {}
  };
};

struct no_number : ph::no_bound {
  template <ph::port P>
  struct on : ph::no_bound::on<P> {
    using ph::no_bound::on<P>::on;
    [[nodiscard]] constexpr ph::share<double> limit(double f, const auto& state) const noexcept {
      return {f > 5.0 ? state.energy * std::numeric_limits<double>::infinity() : 1.0};
    }
  };
};
struct pushy : ph::no_bound {
  template <ph::port P>
  struct on : ph::no_bound::on<P> {
    using ph::no_bound::on<P>::on;
    [[nodiscard]] constexpr ph::share<double> limit(double /*f*/,
                                                    const auto& /*state*/) const noexcept {
      return {1.01};
    }
  };
};
struct inverter : ph::no_bound {
  template <ph::port P>
  struct on : ph::no_bound::on<P> {
    using ph::no_bound::on<P>::on;
    [[nodiscard]] constexpr ph::share<double> limit(double /*f*/,
                                                    const auto& /*state*/) const noexcept {
      return {-0.5};
    }
  };
};
/// Says strict, and spends a thousandth more than it has.
struct overspending : ph::strict_bound {
  template <ph::port P>
  struct on : ph::strict_bound::on<P> {
    using ph::strict_bound::on<P>::on;
    [[nodiscard]] constexpr ph::share<double> limit(double f, const auto& s) const noexcept {
      return {s.damping.affordable(f, 1.001 * s.energy, s.longest_tick)};
    }
  };
};
/// Holds on time, and says that it does late as well.
struct late_in_words_only : ph::strict_bound {
  template <ph::port P>
  struct on : ph::strict_bound::on<P> {
    using ph::strict_bound::on<P>::on;
    [[nodiscard]] constexpr ph::share<double> limit(double f, const auto& s) const noexcept {
      return {s.damping.affordable(f, s.energy, s.longest_tick)};  // what is on its way forgotten
    }
  };
};
struct tiring : ph::no_bound {
  template <ph::port P>
  struct on : ph::no_bound::on<P> {
    using ph::no_bound::on<P>::on;
    double left = 1.0;
    [[nodiscard]] constexpr ph::share<double> limit(double /*f*/, const auto& /*state*/) noexcept {
      left *= 0.99;
      return {left};
    }
  };
};

constexpr std::string_view law_of_damping(const auto& policy) {
  return broken_by<role::damping, d1>(policy);
}
constexpr std::string_view law_of_ledger(const auto& policy) {
  return broken_by<role::observer, d1>(policy);
}
constexpr std::string_view law_of_bound(const auto& policy) {
  return broken_by<role::bound, d1>(policy);
}

static_assert(law_of_damping(counts_too_little{0.03}) == "covers_the_worst_motion");
static_assert(law_of_damping(affords_too_much{0.03}) == "affords_what_is_there");
static_assert(std::string_view(broken_by<role::inertia, d1>(square_of_a_norm{{0.1}})) ==
              "is_a_norm");
static_assert(law_of_ledger(generous{{{.damping = 0.03}}}) == "never_overstates");
static_assert(law_of_ledger(forgiving{{{.damping = 0.03}}}) == "forfeit_never_credits");
static_assert(law_of_ledger(nostalgic{{{.damping = 0.03}}}) == "reset_forgets");
static_assert(law_of_bound(pushy{}) == "scales_down");
static_assert(law_of_bound(inverter{}) == "scales_down");
static_assert(law_of_bound(tiring{}) == "reset_starts_anew");

// ----------------------------------------------------------------------------- of a contact
struct stretching {
  template <class Space>
  struct on {
    using vector = typename Space::vector;
    constexpr explicit on(const stretching& /*p*/) noexcept {}
    [[nodiscard]] vector step(const vector& from, const vector& to,
                              typename Space::scalar /*dt*/) const noexcept {
      return from == to ? to : vector((from + to) / 2);
    }
  };
};
struct restless {
  template <class Space>
  struct on {
    using vector = typename Space::vector;
    constexpr explicit on(const restless& /*p*/) noexcept {}
    [[nodiscard]] constexpr vector step(const vector& from, const vector& to,
                                        typename Space::scalar /*dt*/) const noexcept {
      return from == to ? vector(-to) : to;
    }
  };
};
struct lazy {
  template <class Space>
  struct on {
    using vector = typename Space::vector;
    constexpr explicit on(const lazy& /*p*/) noexcept {}
    [[nodiscard]] vector step(const vector& from, const vector& /*to*/,
                              typename Space::scalar /*dt*/) const noexcept {
      return from;
    }
  };
};
struct sticky : ph::spring {
  template <class Space>
  struct on : ph::spring::on<Space> {
    using ph::spring::on<Space>::on;
    [[nodiscard]] constexpr double force(double d, double v) const noexcept {
      return ph::spring::on<Space>::force(d + 1e-3, v);
    }
  };
};
struct tilted : ph::half_space<d1> {
  [[nodiscard]] constexpr auto at(const double& x) const noexcept {
    return ph::half_space<d1>::at(1.01 * x);
  }
  [[nodiscard]] constexpr tilted toward(const tilted& target, double x, double n,
                                        double d) const noexcept {
    return {ph::half_space<d1>::toward(target, x, n, d)};
  }
};

static_assert(std::string_view(broken_by<role::normals, d1>(restless{})) == "stays_a_normal");
static_assert(std::string_view(broken_by<role::contact_law, d1>(sticky{})) == "presses_outwards");
static_assert(std::string_view(broken_by<role::constraint, d1>(tilted{{0.5, -3.0, 100.0}})) ==
              "measures_depth");

/// Surfaces that are a quadric but for one line.
using quadric = ph::quadric<d3>;
/// Answers with a probe in which `change` has changed something.
template <class Change>
struct altered : quadric {
  [[nodiscard]] probe at(const vector& x) const noexcept {
    probe seen = quadric::at(x);
    Change{}(seen, x);
    return seen;
  }
};
struct honestly {
  void operator()(quadric::probe& /*seen*/, const d3::vector& /*x*/) const noexcept {}
};
struct longer_normal {
  void operator()(quadric::probe& seen, const d3::vector& /*x*/) const noexcept {
    seen.normal *= 1.0 + 1e-12;
  }
};
struct along_the_normal {
  void operator()(quadric::probe& seen, const d3::vector& /*x*/) const noexcept {
    seen.pushing = seen.normal;
  }
};
struct stepped {  // every 5 mm it is 5 mm deeper
  void operator()(quadric::probe& seen, const d3::vector& x) const noexcept {
    seen.depth += 5e-3 * std::floor(x.x() / 5e-3);
  }
};
struct covers_nothing {
  void operator()(quadric::probe& seen, const d3::vector& /*x*/) const noexcept {
    seen.within = false;
  }
};
struct takes_any_stiffness : quadric {
  bool prepare() noexcept {
    stiffness = 1.0;
    return quadric::prepare();
  }
};
template <class Surface>
std::string law_of_surface() {
  Surface bulge{};
  bulge.normal = {0, 0, 1};
  bulge.curvature = bulge.cross_curvature = 20;
  bulge.stiffness = 500;
  bulge.thickness = 0.01;
  return broken_by<role::surface, d3>(bulge);
}

/// Supplies that are `followed` but for one function.
using followed = ph::followed<ph::half_space<d1>>;
struct takes_anything : followed {
  constexpr bool update(constraint_type next) noexcept {
    static_cast<void>(followed::update(next));
    return true;
  }
};
struct lets_the_bad_in : followed {
  constexpr bool update(constraint_type next) noexcept {
    if (followed::update(next)) return true;
    next.stiffness = 1.0;
    static_cast<void>(followed::update(next));
    return false;
  }
};
struct never_lets_go : followed {
  constexpr void release() noexcept {}
};
static_assert(ph::supply_for<never_lets_go, d1> && !ph::supply_for<ph::half_space<d1>, d1>);
struct gone_for_good : followed {
  bool over = false;
  constexpr void release() noexcept {
    over = true;
    followed::release();
  }
  constexpr bool update(constraint_type next) noexcept { return !over && followed::update(next); }
};
static_assert(!laws::keeps_the_newest<d1>(takes_anything{}, wall<d1>(100)));
static_assert(!laws::keeps_the_newest<d1>(lets_the_bad_in{}, wall<d1>(100)));
static_assert(!laws::keeps_the_newest<d1>(gone_for_good{}, wall<d1>(100)));

}  // namespace

TEST_CASE("laws::all names the law that a port's part breaks", "[law]") {
  CHECK(law_of_damping(counts_too_little{0.03}) == "covers_the_worst_motion");
  CHECK(law_of_damping(affords_too_much{0.03}) == "affords_what_is_there");
  CHECK(law_of_ledger(generous{{{.damping = 0.03}}}) == "never_overstates");
  CHECK(law_of_ledger(forgiving{{{.damping = 0.03}}}) == "forfeit_never_credits");
  CHECK(law_of_ledger(gullible{{{.damping = 0.03}}}) == "books_numbers_only");
  CHECK(law_of_ledger(nostalgic{{{.damping = 0.03}}}) == "reset_forgets");
  CHECK(law_of_bound(no_number{}) == "answers_with_a_number");
  CHECK(law_of_bound(pushy{}) == "scales_down");
  CHECK(law_of_bound(overspending{}) == "loses_to_no_motion");
  CHECK(law_of_bound(late_in_words_only{}) == "loses_to_no_motion");
  CHECK(law_of_bound(tiring{}) == "reset_starts_anew");
  CHECK_FALSE(laws::spends_at_most_the_ledger<d1>(overspending{}));
}

TEST_CASE("laws::all names the law that a contact's part breaks", "[law]") {
  CHECK(std::string(broken_by<role::normals, d3>(stretching{})) == "stays_a_normal");
  CHECK(std::string(broken_by<role::normals, d3>(restless{})) == "stays_a_normal");
  CHECK(std::string(broken_by<role::contact_law, d1>(sticky{})) == "presses_outwards");
  CHECK(std::string(broken_by<role::constraint, d1>(tilted{{0.5, -3.0, 100.0}})) ==
        "measures_depth");
  CHECK_FALSE(laws::keeps_the_newest<d1>(never_lets_go{}, wall<d1>(100)));
  CHECK(laws::keeps_the_newest<d1>(followed{}, wall<d1>(100)));  // the control
}

TEST_CASE("laws::all names the law that a surface breaks", "[law]") {
  CHECK(law_of_surface<altered<honestly>>() == "none");  // the control
  CHECK(law_of_surface<takes_any_stiffness>() == "refuses_no_stiffness");
  CHECK(law_of_surface<altered<longer_normal>>() == "has_a_unit_normal");
  CHECK(law_of_surface<altered<along_the_normal>>() == "pushes_along_its_gradient");
  CHECK(law_of_surface<altered<covers_nothing>>() == "pushes_along_its_gradient");
  CHECK(law_of_surface<altered<stepped>>() == "changes_depth_steadily");
}

TEST_CASE("the law of rotation rejects one too fast and one that never arrives", "[law]") {
  CHECK_FALSE(laws::turns_at_most<d3>(ph::turn_limited{60.0}, 50.0));
  CHECK_FALSE(laws::turns_at_most<d3>(lazy{}, 50.0));
  CHECK(laws::turns_at_most<d3>(ph::turn_limited{60.0}, 60.0));
}
