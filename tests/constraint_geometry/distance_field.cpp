// SPDX-License-Identifier: BSD-3-Clause
// Distances sampled and by a function.
#include "support/catch.hpp"
#include "support/curved.hpp"
#include "support/obedience.hpp"

#include <random>

using Catch::Matchers::WithinAbs;
using Eigen::Vector3d;

namespace {

/// A wavy floor, by a function of the height.
struct waves {
  double amplitude = 1e-3, wavelength = 0.02;
  ph::distance_and_gradient<d2> operator()(const d2::vector& x) const noexcept {
    const double k = 2.0 * std::acos(-1.0) / wavelength;
    return {x.y() - amplitude * std::sin(k * x.x()),
            d2::vector(-amplitude * k * std::cos(k * x.x()), 1.0)};
  }
  bool prepare() const noexcept { return amplitude >= 0.0 && wavelength > 0.0; }
};
/// As honest as its gradient.
struct half_a_gradient : waves {
  ph::distance_and_gradient<d2> operator()(const d2::vector& x) const noexcept {
    auto seen = waves::operator()(x);
    seen.gradient.x() *= 0.5;
    return seen;
  }
};
struct may_throw {
  ph::distance_and_gradient<d2> operator()(const d2::vector& x) const { return waves{}(x); }
};
static_assert(ph::surface_for<ph::distance_field<d2, waves>, d2>);
static_assert(!ph::surface_for<ph::distance_field<d2, may_throw>, d2>);

}  // namespace

TEST_CASE("a distance field of one's own obeys the laws if its gradient is one",
          "[geometry][curved][law]") {
  obey<role::surface, d2>(ph::distance_field<d2, waves>{.stiffness = 500, .radius = 0.02});
  const ph::distance_field<d2, half_a_gradient> liar{.stiffness = 500, .radius = 0.02};
  CHECK(std::string(broken_by<role::surface, d2>(liar)) == "pushes_along_its_gradient");
}

TEST_CASE("a distance field ends at its ball and its thickness, and refuses what its field refuses",
          "[geometry][curved]") {
  ph::distance_field<d2, waves> f{.stiffness = 500, .radius = 0.02, .thickness = 0.005};
  REQUIRE(f.prepare());
  CHECK(f.at({0.0199, 0}).covered());
  CHECK_FALSE(f.at({0.0201, 0}).covered());
  CHECK(f.at({0.005, -0.0039}).covered());  // on a crest, 1 mm high
  CHECK_FALSE(f.at({0.005, -0.0041}).covered());
  const auto usable = [](auto field) { return field.prepare(); };
  auto bad = f;
  bad.field.wavelength = 0.0;
  CHECK_FALSE(usable(bad));
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    bad = f;
    bad.stiffness = wrong;
    CHECK_FALSE(usable(bad));
    bad = f;
    bad.radius = wrong;
    CHECK_FALSE(usable(bad));
    bad = f;
    bad.thickness = wrong;
    CHECK_FALSE(usable(bad));
    bad = f;
    bad.centre = {wrong, 0.0};
    CHECK(usable(bad) == std::isfinite(wrong));
  }
  bad = f;
  bad.field.amplitude = HUGE_VAL;
  bad.centre = {0.005, 0.0};
  CHECK_FALSE(usable(bad));
}

TEMPLATE_TEST_CASE("a brick returns every quadratic distance as it is", "[geometry][curved]", d3,
                   f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  const auto phi = [](const typename S::vector& x) {
    return scalar(x(2) + scalar(3) * x(0) * x(0) - scalar(2) * x(1) * x(1) + x(0) * x(2));
  };
  auto brick = ph::distance_brick<S>::sampled(phi, curved::of<S>({-0.02, -0.01, -0.015}),
                                              scalar(0.01), scalar(500));
  const double rounding = 200 * static_cast<double>(std::numeric_limits<scalar>::epsilon());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> in(-0.01, 0.01);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d off(in(random), in(random), in(random));
    const Vector3d x = off + Vector3d(-0.005, 0.005, 0.0);
    const auto seen = brick.at(curved::of<S>(x));
    CHECK(static_cast<double>(std::abs(seen.depth + phi(curved::of<S>(x)))) < 0.03 * rounding);
    const Vector3d gradient(6 * x.x() + x.z(), -4 * x.y(), 1 + x.x());
    CHECK((seen.push().template cast<double>() - gradient).norm() < 10 * rounding);
  }
}

TEST_CASE("a brick of samples as they are would smooth a ball by h^2/(4 r)", "[geometry][curved]") {
  auto sharp = curved::brick<d3>();
  REQUIRE(sharp.prepare());
  auto blunt = sharp;
  for (std::size_t i = 0; i < blunt.coefficients.size(); ++i) {
    const d3::vector x =
        d3::vector(blunt.origin) +
        blunt.spacing * d3::vector(double(i / 16), double(i / 4 % 4), double(i % 4));
    blunt.coefficients[i] = x.norm() - curved::radius;
  }
  const d3::vector pole(0, 0, curved::radius);
  CHECK_THAT(blunt.at(pole).depth, WithinAbs(-0.125e-3, 2e-6));
  CHECK_THAT(sharp.at(pole).depth, WithinAbs(0.0, 2e-6));
}

TEMPLATE_TEST_CASE("a brick covers its middle cube, and answers with numbers outside", "[geometry]",
                   d3, f3) {
  using S = TestType;
  using scalar = typename S::scalar;
  auto brick = curved::brick<S>({0, 0, 0.05});  // from −5 to 5 mm about the pole
  REQUIRE(brick.prepare());
  const auto at = [&](double x, double y, double z) {
    return brick.at(curved::of<S>({x, y, 0.05 + z}));
  };
  CHECK(at(0.0049, -0.0049, 0.0049).covered());
  CHECK_FALSE(at(0.0051, 0, 0).covered());
  CHECK_FALSE(at(0, -0.0051, 0).covered());
  CHECK_FALSE(at(0, 0, 0.0051).covered());
  CHECK_THAT(static_cast<double>(S::norm(at(0.3, 0.2, -5).outward())), WithinAbs(1.0, 1e-6));
  CHECK_FALSE(at(std::nan(""), 0, 0).covered());
  brick.thickness = scalar(0.002);
  CHECK(at(0, 0, -0.0019).covered());
  CHECK_FALSE(at(0, 0, -0.0021).covered());

  const auto usable = [](ph::distance_brick<S> b) { return b.prepare(); };
  const auto good = curved::brick<S>();
  CHECK(usable(good));
  for (const scalar bad : {std::numeric_limits<scalar>::quiet_NaN(),
                           std::numeric_limits<scalar>::infinity(), scalar(0), scalar(-1)}) {
    auto b = good;
    b.coefficients[37] = bad;
    CHECK(usable(b) == std::isfinite(bad));
    b = good;
    b.origin = {bad, scalar(0), scalar(0)};
    CHECK(usable(b) == std::isfinite(bad));
    b = good;
    b.spacing = bad;
    CHECK_FALSE(usable(b));
    b = good;
    b.stiffness = bad;
    CHECK_FALSE(usable(b));
    b = good;
    b.thickness = bad;
    CHECK_FALSE(usable(b));
  }
  auto nothing = good;  // a field without a gradient still has a unit normal
  nothing.coefficients.fill(scalar(0));
  CHECK(S::norm(nothing.at(curved::of<S>({0, 0, 0.05})).outward()) == 1);
}

namespace {

/// What is not a distance: the height over a floor, over a slope or over a ball, times any number.
struct steep {
  double slope = 1.0, tilt = 0.0, bend = 0.0;
  template <class Vector>
  [[nodiscard]] double height(const Vector& x) const noexcept {
    return slope * (x(2) + tilt * x(0) + bend * x.dot(x));
  }
  ph::distance_and_gradient<d3> operator()(const d3::vector& x) const noexcept {
    return {height(x), slope * (d3::vector(tilt, 0.0, 1.0) + 2.0 * bend * x)};
  }
};
struct rest {
  double depth = 0.0;  ///< where it comes to rest under 2 N [m]
  double swing = 0.0;  ///< in the last second [m]
};
template <class Surface>
rest dropped_on(const Surface& surface) {
  constexpr double m = 0.1, b = 0.03, T = 1e-3;
  ph::passive_port port{
      d3{}, ph::contact_set{ph::proxy_spring{.mass = m}, ph::pursuit{}, ph::slots<Surface, 1>{}},
      ph::reduced_energy{.damping = b}, ph::reachable_bound{.mass = m, .hand_force = 5},
      ph::loop_limits{.longest_tick = T}};
  REQUIRE(port.source().update(0, surface));
  d3::vector x(0, 0, 0.005), v = d3::zero(), f = d3::zero();
  double lowest = 1.0, highest = -1.0;
  for (int n = 0; n < 4000; ++n) {
    v += (f + d3::vector(0, 0, -2) - b * v) * (T / m);
    x += v * T;
    f = port.tick(x, ph::seconds{T}).force;
    if (n >= 3000) {
      lowest = std::min(lowest, x(2));
      highest = std::max(highest, x(2));
    }
  }
  return {-x(2), highest - lowest};
}

}  // namespace

TEST_CASE("a field of any slope is as stiff as it says, and comes to rest", "[geometry][curved]") {
  const double slope = GENERATE(0.1, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0);
  const double K = GENERATE(1000.0, 8000.0);
  CAPTURE(slope, K);
  const steep floor{.slope = slope};
  const rest field = dropped_on(ph::distance_field<d3, steep>{.field = floor, .stiffness = K});
  CHECK_THAT(field.depth, WithinAbs(2.0 / K, 1e-6));
  CHECK(field.swing < 1e-6);
  auto sampled = ph::distance_brick<d3>::sampled(
      [&](const d3::vector& x) { return floor.height(x); }, {-0.0075, -0.0075, -0.0075}, 0.005, K);
  const rest brick = dropped_on(sampled);
  CHECK_THAT(brick.depth, WithinAbs(2.0 / K, 1e-6));
  CHECK(brick.swing < 1e-6);
  for (int n = 0; n < 3; ++n) {  // once prepared, it stays as it is
    REQUIRE(sampled.prepare());
    CHECK_THAT(sampled.at({0, 0, -1e-3}).depth, WithinAbs(1e-3, 1e-15));
  }
}

TEST_CASE("a field that is steeper elsewhere obeys the laws, and rests",
          "[geometry][curved][law]") {
  for (const steep& field : {steep{.slope = 3.0, .tilt = 0.5}, steep{.slope = 0.2, .bend = 10.0},
                             steep{.slope = 7.0, .tilt = -0.3, .bend = 20.0},
                             steep{.slope = 2.0, .tilt = 0.2, .bend = -15.0}}) {
    CAPTURE(field.slope, field.tilt, field.bend);
    obey<role::surface, d3>(
        ph::distance_field<d3, steep>{.field = field, .stiffness = 500, .radius = 0.01});
    const auto brick =
        ph::distance_brick<d3>::sampled([&](const d3::vector& x) { return field.height(x); },
                                        {-0.0075, -0.0075, -0.0075}, 0.005, 8000.0);
    obey<role::surface, d3>(brick);
    if (field.tilt == 0.0) CHECK(dropped_on(brick).swing < 1e-6);
  }
}

TEST_CASE("a brick ends at its thickness, which is still covered", "[geometry]") {
  const double h = 1.0 / 128;  // so that depths are exact
  auto floor = ph::distance_brick<d3>::sampled([](const d3::vector& x) { return x(2); },
                                               d3::vector(-1.5 * h, -1.5 * h, -1.5 * h), h, 500.0);
  floor.thickness = h / 2;
  REQUIRE(floor.prepare());
  CHECK(floor.at({0, 0, -h / 2}).covered());
  CHECK_FALSE(floor.at({0, 0, -h * 0.501}).covered());
}

TEST_CASE("what counts of a field's slope is that at its surface, wherever this is in the brick",
          "[geometry][curved]") {
  // A distance at its surface, 4 mm above the middle, where its slope is 0.8.
  const auto phi = [](const d3::vector& x) {
    const double z = x(2) - 4e-3;
    return z + 25.0 * z * z;
  };
  auto brick = ph::distance_brick<d3>::sampled(phi, {-0.0075, -0.0075, -0.0075}, 0.005, 500.0);
  REQUIRE(brick.prepare());
  CHECK_THAT(brick.at({0, 0, 3e-3}).depth, WithinAbs(-phi({0, 0, 3e-3}), 1e-12));
}

TEST_CASE("nowhere in a brick is more than twice its stiffness felt, whichever corner is steep",
          "[geometry][curved]") {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const d3::vector u = d3::vector((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                                    (corner & 4) != 0 ? 1 : -1)
                             .normalized();
    const auto phi = [&u](const d3::vector& x) {
      const double s = u.dot(x);
      return s + 115.0 * s * s;  // its slope is 1 in the middle and 3 there
    };
    auto brick = ph::distance_brick<d3>::sampled(phi, {-0.0075, -0.0075, -0.0075}, 0.005, 500.0);
    REQUIRE(brick.prepare());
    const d3::vector there = u * (5e-3 * std::sqrt(3.0));
    CAPTURE(corner);
    CHECK_THAT(d3::norm(brick.at(there).push()), WithinAbs(std::sqrt(2.0), 1e-2));
  }
}

TEST_CASE("a brick whose slope is no number is refused, and a flat one is as it was",
          "[geometry]") {
  const auto with = [](double height, double spacing) {
    ph::distance_brick<d3> brick;
    brick.spacing = spacing;
    brick.stiffness = 500;
    brick.thickness = 1.0;
    for (std::size_t i = 0; i < brick.coefficients.size(); ++i) {
      brick.coefficients[i] = height * static_cast<double>(i % 4);
    }
    return brick.prepare();
  };
  CHECK(with(1e-3, 1e-3));
  CHECK_FALSE(with(1e300, 1e-10));  // 1e310
  CHECK_FALSE(with(1e200, 1.0));    // whose square overflows
  CHECK(with(0.0, 1e-3));
}

TEST_CASE("a brick is looked for around the middle of its cube", "[geometry]") {
  ph::distance_brick<d3> brick;
  brick.origin = {1.0, 2.0, 3.0};
  brick.spacing = 0.5;
  const auto ball = brick.around();
  CHECK(d3::vector(ball.centre) == d3::vector(1.75, 2.75, 3.75));
  CHECK(ball.radius > std::sqrt(3.0) * 0.5);  // the cube's corners are within
  CHECK(ball.radius < 2.0 * 0.5);
}

namespace {

/// A plane of any slope and distance at the origin, y up.
template <class S>
struct sloping {
  typename S::coordinates gradient{};
  typename S::scalar distance{};
  ph::distance_and_gradient<S> operator()(const typename S::vector& x) const noexcept {
    return {distance + S::dot(gradient, x), gradient};
  }
};
/// What a field of this slope says where it is `distance`.
auto seen(const d2::vector& gradient, double distance,
          double thickness = ph::kernels::largest<double>()) {
  return ph::distance_field<d2, sloping<d2>>{
      .field = {gradient, distance}, .stiffness = 500, .thickness = thickness}
      .at(d2::zero());
}

}  // namespace

TEST_CASE("a field is a distance where the square of its slope is 1 but for 64 epsilon",
          "[geometry][curved]") {
  const double eps = std::numeric_limits<double>::epsilon();
  for (const d2::vector& gradient :
       {d2::vector(0, 1 + 20 * eps), d2::vector(std::ldexp(1.0, -23), 1)}) {
    CHECK(seen(gradient, -0.5).depth == 0.5);
    CHECK(seen(gradient, -0.5).push() == gradient);
  }
  CHECK(seen({0, 1 + 40 * eps}, -0.5).depth < 0.5);
  CHECK(seen({0, 1}, -0.25, 0.25).covered());
  CHECK_FALSE(seen({0, 1}, -0.2501, 0.25).covered());
}

TEST_CASE("a field of any slope is felt as deep as its thickness, and no deeper than a metre",
          "[geometry][curved]") {
  CHECK(seen({0, 2}, -0.5, 0.25).depth == 0.25);
  CHECK(seen({0, 2}, -0.5, 0.25).covered());
  CHECK_FALSE(seen({0, 2}, -1.0, 0.25).covered());
  CHECK(seen({0, 2}, -2.0).covered());
  CHECK_FALSE(seen({0, 2}, -3.0).covered());
  for (const double slope :
       {0.0, 1e-150, std::ldexp(1.0, -485)}) {  // a square of 2^-970 is too low
    CHECK(seen({0, slope}, -0.5).depth == 0.5);
    CHECK_FALSE(seen({0, slope}, -0.5).covered());
  }
  CHECK(seen({0, std::ldexp(1.0, -484)}, -std::ldexp(1.0, -485)).depth == 0.5);
}

TEST_CASE("the ball of a field reaches to its end, and no farther than a metre",
          "[geometry][curved]") {
  ph::distance_field<d2, waves> f{.stiffness = 500};
  CHECK(f.around().radius == 1.0);
  f.radius = 0.03125;
  CHECK(f.around().radius == 0.03125);
  CHECK(f.at({0.03125, 0}).covered());
  f.field.amplitude = -1e-3;  // a number everywhere, and no good to the field itself
  CHECK_FALSE(f.prepare());
}

TEST_CASE("how a field bends is seen in floats far from the origin, too", "[geometry][curved]") {
  struct bent {
    ph::distance_and_gradient<f2> operator()(const f2::vector& x) const noexcept {
      const float y = x.y() - 8.0F;
      return {y + 5.0F * y * y, f2::vector(0.0F, 1.0F + 10.0F * y)};
    }
  };
  const float y = -0.01F;
  const auto here = ph::distance_field<f2, bent>{.stiffness = 500}.at({0.0F, 8.0F + y});
  const double slope = 0.9, depth = 0.0095 / slope;  // and its gradient bends by 10/m
  CHECK_THAT(static_cast<double>(here.push().y()), WithinAbs((slope + 10 * depth) / slope, 5e-3));
}

TEST_CASE(
    "a brick is refused for any coefficient that is no number, and left alone if it has no slope",
    "[geometry]") {
  for (const std::size_t node : {0U, 21U, 63U}) {
    auto brick = curved::brick<d3>();
    brick.coefficients[node] = std::nan("");
    CHECK_FALSE(brick.prepare());
  }
  for (const double level : {0.0, 1e-3, -0.3, 1e6}) {  // rounding gives some of them a slope
    auto flat = curved::brick<d3>();
    flat.coefficients.fill(level);
    REQUIRE(flat.prepare());
    for (const double c : flat.coefficients) CHECK(c == level);
  }
  ph::distance_brick<f3> single;
  single.spacing = single.stiffness = 1;
  single.coefficients.fill(0.1F);
  REQUIRE(single.prepare());
  for (const float c : single.coefficients) CHECK(c == 0.1F);
}

TEST_CASE("a brick is a distance if its slope is 1 but for a sixteenth", "[geometry]") {
  const auto with = [](double slope) {
    ph::distance_brick<d3> brick;
    brick.spacing = 1.0 / 128;
    brick.stiffness = 500;
    for (std::size_t i = 0; i < brick.coefficients.size(); ++i) {
      brick.coefficients[i] = slope * brick.spacing * (static_cast<double>(i % 4) - 1.5);
    }
    REQUIRE(brick.prepare());
    return brick.coefficients[3] / (1.5 / 128);
  };
  CHECK(with(1.0625) == 1.0625);
  CHECK(with(0.9375) == 0.9375);
  CHECK_THAT(with(1.0626), WithinAbs(1.0, 1e-15));
  CHECK_THAT(with(0.9374), WithinAbs(1.0, 1e-15));
}

TEST_CASE("the surface of a brick is found from its middle, along any axis, and within its cube",
          "[geometry][curved]") {
  const double h = 1.0 / 128;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double zero : {2.0, 4.5}) {  // where φ is 0, in spacings: in the cube, beyond it
      const auto phi = [&](const d3::vector& x) {  // without a slope at the first node less h/2
        const double z = x(axis) / h + 0.5;
        return 3.0 * h * (z * z - (zero + 0.5) * (zero + 0.5));
      };
      auto brick = ph::distance_brick<d3>::sampled(phi, d3::zero(), h, 500.0);
      REQUIRE(brick.prepare());
      d3::vector there(1.5 * h, 1.5 * h, 1.5 * h);
      there(axis) = std::min(zero, 2.5) * h;
      CHECK_THAT(d3::norm(brick.at(there).push()), WithinAbs(1.0, 1e-9));
    }
  }
}
