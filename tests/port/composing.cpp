// SPDX-License-Identifier: BSD-3-Clause
// What is made of the answer of a bound, and of several in a row.
#include "support/catch.hpp"
#include "support/scenes.hpp"

namespace {

/// Leaves a share, whatever it is asked.
struct leaving {
  [[maybe_unused]] static constexpr ph::guarantee passivity = ph::guarantee::none;
  [[maybe_unused]] static constexpr ph::bound_traits traits{};
  double factor = 1.0;
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept {
    if (factor == 0.0) return {"factor", factor, "not 0 in this test"};
    return {};
  }
  template <class Port>
  struct on {
    double factor;
    constexpr explicit on(const leaving& p) noexcept : factor(p.factor) {}
    [[nodiscard]] constexpr leaving parameters() const noexcept { return {factor}; }
    [[nodiscard]] constexpr ph::share<double> limit(const typename Port::effort& /*desired*/,
                                                    const auto& /*state*/) const noexcept {
      return {factor};
    }
  };
};
/// Answers with an effort of its own.
struct answering {
  [[maybe_unused]] static constexpr ph::guarantee passivity = ph::guarantee::none;
  [[maybe_unused]] static constexpr ph::bound_traits traits{};
  double answer = 1.0;
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  template <class Port>
  struct on {
    double answer;
    constexpr explicit on(const answering& p) noexcept : answer(p.answer) {}
    [[nodiscard]] constexpr double limit(double /*desired*/, const auto& /*state*/) noexcept {
      return answer;
    }
  };
};

template <class Bound>
auto bounded_by(const Bound& parameters, double desired) {
  auto bound = at<d1>(parameters);
  const situation<d1> now;
  return ph::detail::applied<d1>(bound, desired, now.port());
}

}  // namespace

TEST_CASE("a share is at most all, and less than nothing, or no number, is nothing",
          "[composing]") {
  const auto left = [](double factor, double desired = -4.0) {
    return bounded_by(leaving{factor}, desired);
  };
  for (const double all : {1.0, 1.5, HUGE_VAL}) {
    CHECK(left(all).force == -4.0);
    CHECK_FALSE(left(all).limited);
  }
  CHECK(left(0.25).force == -1.0);
  CHECK(left(0.25).limited);
  for (const double nothing : {0.0, -0.5, -HUGE_VAL, std::nan("")}) {
    CHECK(left(nothing).force == 0.0);
    CHECK(left(nothing).limited);
  }
  CHECK_FALSE(left(0.25, 0.0).limited);  // nothing desired is nothing lost
}

TEST_CASE("an effort for an answer is taken as it is", "[composing]") {
  CHECK(bounded_by(answering{3.0}, -4.0).force == 3.0);
  CHECK(bounded_by(answering{3.0}, -4.0).limited);
  CHECK_FALSE(bounded_by(answering{-4.0}, -4.0).limited);
}

TEST_CASE("bounds in a row are each shown what is left, and one that limits is enough",
          "[composing]") {
  using ph::bound_chain;
  CHECK(bounded_by(bound_chain{leaving{0.5}, leaving{0.5}}, -4.0).force == -1.0);
  CHECK(bounded_by(bound_chain{answering{2.0}, leaving{0.5}}, -4.0).force == 1.0);
  CHECK(bounded_by(bound_chain{leaving{0.5}, answering{2.0}}, -4.0).force == 2.0);
  CHECK(bounded_by(bound_chain{leaving{0.5}, leaving{1.0}}, -4.0).limited);
  CHECK(bounded_by(bound_chain{leaving{1.0}, leaving{0.5}}, -4.0).limited);
  CHECK_FALSE(bounded_by(bound_chain{leaving{1.0}, leaving{1.0}}, -4.0).limited);
  const auto constant = at<d1>(bound_chain{leaving{0.5}, leaving{0.5}});  // they keep nothing
  CHECK(ph::detail::applied<d1>(constant, -4.0, situation<d1>{}.port()).force == -1.0);
}

TEST_CASE("a source and a law are told of the loop what they ask for", "[composing]") {
  struct {
    double T = 0.0;
    constexpr void adopt(double longest_tick) noexcept { T = longest_tick; }
  } plain;
  struct {
    double T = 0.0;
    int late = 0;
    constexpr void adopt(double longest_tick, int ticks) noexcept {
      T = longest_tick;
      late = ticks;
    }
  } asking;
  ph::detail::tell(plain, 1e-3, 3);
  ph::detail::tell(asking, 1e-3, 3);
  CHECK(plain.T == 1e-3);
  CHECK(asking.T == 1e-3);
  CHECK(asking.late == 3);
  struct {
    double K = 0.0, T = 0.0;
    constexpr void adopt(double stiffness, double longest_tick) noexcept {
      K = stiffness;
      T = longest_tick;
    }
  } law;
  struct {
    double K = 0.0, T = 0.0;
    int late = 0;
    constexpr void adopt(double stiffness, double longest_tick, int ticks) noexcept {
      K = stiffness;
      T = longest_tick;
      late = ticks;
    }
    constexpr void adopt(double stiffness, double longest_tick) noexcept {
      adopt(stiffness, longest_tick, -1);
    }
  } late_law;
  ph::detail::tell(law, 500.0, 1e-3, 3);
  ph::detail::tell(late_law, 500.0, 1e-3, 3);
  CHECK(std::pair{law.K, law.T} == std::pair{500.0, 1e-3});
  CHECK(std::pair{late_law.K, late_law.T} == std::pair{500.0, 1e-3});
  CHECK(late_law.late == 3);
}

TEST_CASE("the first fault in a row is told", "[composing]") {
  using ph::bound_chain;
  CHECK_FALSE(bound_chain{leaving{0.5}, leaving{0.25}}.check());
  CHECK(bound_chain{leaving{0.0}, leaving{0.5}}.check());
  CHECK(bound_chain{leaving{0.5}, leaving{0.0}}.check());
  const ph::bound_chain twice{ph::actuator_limit{.most = -1.0}, ph::actuator_limit{.most = -2.0}};
  CHECK(twice.check().value == -1.0);
  const auto part = at<d1>(bound_chain{leaving{0.5}, leaving{0.25}});
  CHECK(part.parameters().first.factor == 0.5);
  CHECK(part.parameters().rest.first.factor == 0.25);
}

namespace {

/// Leaves a share, and a tenth of that from its third tick on; it is its own part at a port.
struct tiring {
  [[maybe_unused]] static constexpr ph::guarantee passivity = ph::guarantee::none;
  [[maybe_unused]] static constexpr ph::bound_traits traits{};
  double factor = 1.0;
  int ticks = 0;
  [[nodiscard]] constexpr ph::parameter_fault check() const noexcept { return {}; }
  constexpr void set(const tiring& p) noexcept { factor = p.factor; }
  constexpr void reset() noexcept { ticks = 0; }
  [[nodiscard]] constexpr ph::share<double> limit(const double& /*desired*/,
                                                  const auto& /*state*/) noexcept {
    return {++ticks > 2 ? factor / 10.0 : factor};
  }
};

}  // namespace

TEST_CASE("every bound in a row takes its parameters, keeps its state and is reset",
          "[composing]") {
  auto both = at<d1>(ph::bound_chain{tiring{0.5}, tiring{0.25}});
  const auto left = [&both] {
    return ph::detail::applied<d1>(both, 1.0, situation<d1>{}.port()).force;
  };
  CHECK(both.parameters().first.factor == 0.5);
  CHECK(both.parameters().rest.first.factor == 0.25);
  CHECK(left() == 0.125);
  CHECK(left() == 0.125);
  both.set(ph::bound_chain{tiring{1.0}, tiring{0.5}});
  CHECK_THAT(left(), Catch::Matchers::WithinRel(0.005));  // both are tired by now
  both.reset();
  CHECK(left() == 0.5);
}
