// SPDX-License-Identifier: BSD-3-Clause
#include "../common/text.hpp"
#include "organ.hpp"
#include <passive_haptics/environment/msh_reader.hpp>

namespace experiments {

organ read_organ(const std::string& file, double unit) {
  auto loaded = env::load_msh(std::filesystem::path(file));
  if (loaded.fault) throw *loaded.fault;
  organ read{env::scaled(std::move(loaded.mesh), unit), file, unit, std::move(loaded.notes)};
  env::check(read.mesh, file + " with --unit " + format("%g", unit));
  return read;
}

std::string size_of(const organ& which) {
  const vector3 size = env::bounds(which.mesh).sizes() / millimetre;
  return format("%.3g", size.x()) + " x " + format("%.3g", size.y()) + " x " +
         format("%.3g", size.z()) + " mm";
}

std::string measured(const organ& which) {
  return "with --unit " + format("%g", which.unit) + " it measures " + size_of(which);
}

std::string other_unit(const organ& which) {
  for (const double unit : {1.0, 1e-2, 1e-3, 1e-6}) {
    const organ other{env::scaled(which.mesh, unit / which.unit), which.file, unit};
    const double longest = env::bounds(other.mesh).sizes().maxCoeff();
    if (unit != which.unit && longest > 0.03 && longest < 1.0) {
      return "give the unit of its coordinates in metres, as --unit " + format("%g", unit) +
             ", which makes it " + size_of(other);
    }
  }
  return "give the unit of its coordinates in metres with --unit";
}

}  // namespace experiments
