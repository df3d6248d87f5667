// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A local model of any composition behind one interface. So a test of a hundred compositions is compiled once,
// and each composition costs only the compilation of its tick.
#include "support/scenes.hpp"

#include <array>
#include <memory>
#include <vector>

/// The constraint that pushes back in the tests of many models: its surface is at zero, the object behind it.
template <class Constraint>
constexpr Constraint good_constraint() {
  using space = typename Constraint::space_type;
  using scalar = typename space::scalar;
  if constexpr (space::dof == 1) {
    return wall<space>(scalar(500));
  } else if constexpr (requires(Constraint c) { c.c; }) {
    return {.a = {-1, -1, 0}, .b = {1, -1, 0}, .c = {0, 1, 0}, .stiffness = 500};
  } else if constexpr (requires(Constraint c) { c.a; }) {
    return {.a = {1, 0}, .b = {-1, 0}, .stiffness = 500};
  } else {
    typename space::vector n = space::zero();
    n(space::dof - 1) = 1;
    return {space::zero(), n, 500};
  }
}

/// A position `depth` inside the good constraint.
template <class Space>
typename Space::vector inside(typename Space::scalar depth) {
  typename Space::vector x = Space::zero();
  Space::component(x, Space::dof - 1) = Space::dof == 1 ? depth : -depth;
  return x;
}

/// A vector whose components are all equal.
template <class Space>
typename Space::vector all(typename Space::scalar value) {
  typename Space::vector v = Space::zero();
  for (int i = 0; i < Space::dof; ++i) Space::component(v, i) = value;
  return v;
}

/// Constraints that a model must refuse.
template <class Constraint>
std::vector<Constraint> bad_constraints() {
  using space = typename Constraint::space_type;
  using scalar = typename space::scalar;
  using limits = std::numeric_limits<scalar>;
  std::vector<Constraint> bad;
  const auto one_more = [&bad]() -> Constraint& {
    return bad.emplace_back(good_constraint<Constraint>());
  };
  for (const scalar K : {scalar(0), scalar(-500), limits::quiet_NaN(), limits::infinity()}) {
    one_more().stiffness = K;
  }
  for (const scalar x : {limits::quiet_NaN(), limits::infinity()}) {
    if constexpr (requires(Constraint c) { c.a; }) {
      one_more().a = all<space>(x);
    } else {
      one_more().point = all<space>(x);
      one_more().normal = all<space>(x);
    }
  }
  if constexpr (requires(Constraint c) { c.a; }) {
    Constraint& flat = one_more();
    flat.a = flat.b;
  } else {
    one_more().normal = space::zero();
  }
  return bad;
}

class any_model {
 public:
  /// A result in double, which holds every float exactly.
  struct reading {
    std::array<double, 3> force{};
    double depth, energy;
    ph::event what;

    [[nodiscard]] bool pushes() const { return force != std::array<double, 3>{}; }
    [[nodiscard]] bool is_finite() const {
      using ph::kernels::is_finite;
      return is_finite(force[0]) && is_finite(force[1]) && is_finite(force[2]) &&
             is_finite(depth) && is_finite(energy);
    }
  };

  template <class Model>
  explicit any_model(const Model& model) : model_(std::make_unique<of<Model>>(model)) {}
  any_model(const any_model& other) : model_(other.model_->copy()) {}
  any_model(any_model&&) noexcept = default;
  any_model& operator=(any_model&&) noexcept = default;
  any_model& operator=(const any_model& other) { return *this = any_model(other); }
  ~any_model() = default;

  /// A tick of dt [s] that ends `depth` [m] inside the good constraint, or with every coordinate `x`.
  reading press(double depth, double dt = 1e-3) { return model_->press(depth, dt); }
  reading go_to(double x, double dt = 1e-3) { return model_->go_to(x, dt); }
  /// Gives the good constraint, with a stiffness [N/m], or one of the bad constraints.
  bool update(double stiffness = 500) { return model_->update(stiffness); }
  bool update_badly(std::size_t which) { return model_->update_badly(which); }
  [[nodiscard]] std::size_t bad_ones() const { return model_->bad_ones(); }
  [[nodiscard]] double energy() const { return model_->energy(); }
  [[nodiscard]] double largest() const { return model_->largest(); }  ///< number of its scalar
  [[nodiscard]] ph::parameter_fault check() const { return model_->check(); }

 private:
  struct interface {
    virtual ~interface() = default;
    [[nodiscard]] virtual std::unique_ptr<interface> copy() const = 0;
    virtual reading press(double depth, double dt) = 0;
    virtual reading go_to(double x, double dt) = 0;
    virtual bool update(double stiffness) = 0;
    virtual bool update_badly(std::size_t which) = 0;
    [[nodiscard]] virtual std::size_t bad_ones() const = 0;
    [[nodiscard]] virtual double energy() const = 0;
    [[nodiscard]] virtual double largest() const = 0;
    [[nodiscard]] virtual ph::parameter_fault check() const = 0;
  };

  template <class Model>
  struct of final : interface {
    using space = typename Model::space_type;
    using scalar = typename space::scalar;
    using vector = typename space::vector;
    using constraint = typename Model::constraint_type;

    Model model;
    explicit of(const Model& m) : model(m) {}

    [[nodiscard]] std::unique_ptr<interface> copy() const override {
      return std::make_unique<of>(*this);
    }
    // The only call of the tick, which is large and therefore not inlined.
    [[gnu::noinline]] reading tick(const vector& x, scalar dt) {
      return read(model.tick(x, ph::seconds{dt}));
    }

    reading press(double depth, double dt) override {
      return tick(inside<space>(static_cast<scalar>(depth)), static_cast<scalar>(dt));
    }
    reading go_to(double x, double dt) override {
      return tick(all<space>(static_cast<scalar>(x)), static_cast<scalar>(dt));
    }
    bool update(double stiffness) override {
      auto target = good_constraint<constraint>();
      target.stiffness = static_cast<scalar>(stiffness);
      return offer(target);
    }
    bool update_badly(std::size_t which) override {
      return offer(bad_constraints<constraint>()[which]);
    }
    [[nodiscard]] std::size_t bad_ones() const override {
      return bad_constraints<constraint>().size();
    }
    [[nodiscard]] double energy() const override { return static_cast<double>(model.energy()); }
    [[nodiscard]] double largest() const override {
      return static_cast<double>(ph::kernels::largest<scalar>());
    }
    [[nodiscard]] ph::parameter_fault check() const override { return model.check(); }

   private:
    bool offer([[maybe_unused]] const constraint& target) {
      if constexpr (requires { model.update(target); }) return model.update(target);
      return false;
    }
    static reading read(const auto& out) {
      reading r{.depth = static_cast<double>(out.depth),
                .energy = static_cast<double>(out.energy),
                .what = out.what};
      for (int i = 0; i < space::dof; ++i) {
        r.force[static_cast<std::size_t>(i)] = static_cast<double>(space::component(out.force, i));
      }
      return r;
    }
  };

  std::unique_ptr<interface> model_;
};
