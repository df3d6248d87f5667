// SPDX-License-Identifier: BSD-3-Clause
#include "catalogue.hpp"

namespace controllers {

const std::vector<controller>& catalogue() {
  static const std::vector<controller> all = [] {
    std::vector<controller> list;
    for (auto* room : {bounding_controllers, time_domain_controllers, coupling_controllers,
                       encoder_controllers, contact_controllers}) {
      for (auto& c : room()) list.push_back(std::move(c));
    }
    return list;
  }();
  return all;
}

}  // namespace controllers
