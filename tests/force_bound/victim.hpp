// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A type-erased composed model, so that the attacks on it are compiled once.
#include "support/scenes.hpp"
#include <passive_haptics/simulation/components.hpp>

namespace sim = ph::simulation;

namespace attacks {

/// A type-erased model with a half-space that moves.
template <class Space>
struct victim {
  using vector = typename Space::vector;
  using place = typename sim::physical<Space>::vector;

  virtual ~victim() = default;
  virtual void restart() = 0;  ///< as it was given
  virtual vector tick(const ph::device_sample<Space>& sample) = 0;
  virtual void lay(const place& point, const place& normal, double stiffness) = 0;
};
template <class Space, class Model>
class attacked final : public victim<Space> {
 public:
  using typename victim<Space>::place, typename victim<Space>::vector;

  explicit attacked(const Model& model) : original_(model), now_(model) {}
  void restart() override { now_ = original_; }
  vector tick(const ph::device_sample<Space>& sample) override { return now_.tick(sample).force; }
  void lay(const place& point, const place& normal, double stiffness) override {
    (void)now_.update({sim::to_port<Space>(point), sim::to_port<Space>(normal),
                       static_cast<typename Space::scalar>(stiffness)});
  }

 private:
  Model original_, now_;
};

}  // namespace attacks
