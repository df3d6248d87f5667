// SPDX-License-Identifier: BSD-3-Clause
// ros2_control: a chainable controller between whatever computes a force and the device's effort interfaces.
// Compiled by hand only: docs/adapters.md says against what.

#include <passive_haptics/passive_haptics.hpp>

#include <controller_interface/chainable_controller_interface.hpp>
#include <limits>

namespace ph = passive_haptics;
namespace ci = controller_interface;
using scene = ph::space<double, 3>;

class passive_effort_controller : public ci::ChainableControllerInterface {
 public:
  ci::CallbackReturn on_init() override { return ci::CallbackReturn::SUCCESS; }
  ci::InterfaceConfiguration command_interface_configuration() const override {
    return {ci::interface_configuration_type::INDIVIDUAL,
            {"device_x/effort", "device_y/effort", "device_z/effort"}};
  }
  ci::InterfaceConfiguration state_interface_configuration() const override {
    return {ci::interface_configuration_type::INDIVIDUAL,
            {"device_x/position", "device_y/position", "device_z/position"}};
  }

  // Nobody has seen what the device did while the controller was not active, and nothing pushes while it is not.
  ci::CallbackReturn on_activate(const rclcpp_lifecycle::State&) override {
    port_.reset();
    return ci::CallbackReturn::SUCCESS;
  }
  ci::CallbackReturn on_deactivate(const rclcpp_lifecycle::State&) override {
    for (auto& effort : command_interfaces_) (void)effort.set_value(0.0);
    return ci::CallbackReturn::SUCCESS;
  }

  ci::return_type update_and_write_commands(const rclcpp::Time&,
                                            const rclcpp::Duration& period) override {
    scene::vector x, wanted;
    for (int i = 0; i < 3; ++i) {
      x[i] = state_interfaces_[i].get_optional().value_or(none);
      wanted[i] = reference_interfaces_[i];  // none until somebody writes one
    }
    const auto out =
        port_.tick(x, ph::seconds{period.seconds()}, wanted);  // none is an event, and no force
    bool sent = true;
    for (int i = 0; i < 3; ++i) sent = command_interfaces_[i].set_value(out.force[i]) && sent;
    return sent ? ci::return_type::OK : ci::return_type::ERROR;
  }

 protected:
  ci::return_type update_reference_from_subscribers(const rclcpp::Time&,
                                                    const rclcpp::Duration&) override {
    return ci::return_type::OK;
  }
  // The form that every release of ROS 2 calls; newer ones call it deprecated.
  std::vector<hardware_interface::CommandInterface> on_export_reference_interfaces() override {
    reference_interfaces_.assign(3, none);
    std::vector<hardware_interface::CommandInterface> all;
    const char* names[] = {"x/effort", "y/effort", "z/effort"};
    for (int i = 0; i < 3; ++i) {
      all.emplace_back(get_node()->get_name(), names[i], &reference_interfaces_[i]);
    }
    return all;
  }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  // State less mass and damping than your device has, and a hand stronger than any that will hold it.
  ph::force_guard<scene> port_ = ph::make_guard<scene>(
      {.mass = 0.1, .damping = 0.1, .force_limit = 8.0, .longest_tick = 0.002}, {.force = 5.0});
};
