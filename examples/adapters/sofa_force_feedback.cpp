// SPDX-License-Identifier: BSD-3-Clause
// SOFA: the answer of an LCPForceFeedback, through a port, in the thread of the haptic driver. Compiled by
// hand only: docs/adapters.md says against what.

#include <passive_haptics/base/stopwatch.hpp>
#include <passive_haptics/passive_haptics.hpp>

#include <sofa/component/haptics/LCPForceFeedback.h>

namespace ph = passive_haptics;
using scene = ph::space<double, 3>;

class passive_feedback
    : public sofa::component::haptics::LCPForceFeedback<sofa::defaulttype::Rigid3Types> {
 public:
  using feedback = sofa::component::haptics::LCPForceFeedback<sofa::defaulttype::Rigid3Types>;
  SOFA_CLASS(passive_feedback, feedback);

 protected:
  /// Both computeForce and computeWrench end here. One point is one device.
  void doComputeForce(const VecCoord& state, VecDeriv& forces) override {
    feedback::doComputeForce(state, forces);
    if (state.empty()) return;
    const auto x = state[0].getCenter(), asked = forces[0].getLinear();
    const auto out =
        port_.tick(metres * scene::vector(x[0], x[1], x[2]), ph::seconds{watch_.lap(1e-3)},
                   newtons * scene::vector(asked[0], asked[1], asked[2]));
    for (int i = 0; i < 3; ++i) forces[0].getLinear()[i] = out.force[i] / newtons;
    forces[0].getAngular().clear();  // no ledger counts a torque here
  }

 private:
  static constexpr double metres = 0.01;  ///< of a unit of the scene, over the driver's scale
  static constexpr double newtons = 1.0;  ///< of a unit of force: the driver's forceScale
  // State less mass and damping than your device has, and a hand stronger than any that will hold it.
  ph::force_guard<scene> port_ = ph::make_guard<scene>(
      {.mass = 0.045, .damping = 0.05, .force_limit = 3.3, .longest_tick = 0.002}, {.force = 5.0});
  ph::stopwatch watch_;
};
