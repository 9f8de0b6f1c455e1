// SPDX-License-Identifier: LGPL-3.0-or-later
/// Every bulk cell with every physics it serves, and single cells of awkward shape.
#pragma once

#include "rubato/cell/reference_cell.hpp"
#include "rubato/study/study.hpp"

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

namespace rubato::test {

struct BulkCase {
  CellType type;
  study::Physics physics;
};

inline std::string name_of(study::Physics physics) {
  switch (physics) {
  case study::Physics::solid:
    return "Solid";
  case study::Physics::plane_stress:
    return "PlaneStress";
  case study::Physics::plane_strain:
    return "PlaneStrain";
  default:
    return "Axisymmetric";
  }
}

inline std::string name_of(const BulkCase& bulk_case) {
  return std::string(cell::topology(bulk_case.type).name) + name_of(bulk_case.physics);
}

inline void PrintTo(const BulkCase& bulk_case, std::ostream* out) {
  *out << name_of(bulk_case);
}

inline std::vector<BulkCase> every_bulk_case() {
  using study::Physics;
  std::vector<BulkCase> cases;
  for (const auto& cell : cell::all_topologies()) {
    if (!cell::has_reference_cell(cell.type))
      continue;
    if (cell.dimension == 3)
      cases.push_back({cell.type, Physics::solid});
    if (cell.dimension == 2)
      for (const auto physics : {Physics::plane_stress, Physics::plane_strain, Physics::axisymmetric})
        cases.push_back({cell.type, physics});
  }
  return cases;
}

/// The reference cell scaled, bent a little (curved edges, no parallel sides) and moved to x > 0.
inline std::vector<Eigen::Vector3d> bent_cell(CellType type) {
  const bool flat = cell::topology(type).dimension == 2;
  std::vector<Eigen::Vector3d> points;
  for (const auto& xi : cell::reference_cell(type).nodes) {
    const double x = xi[0], y = xi[1], z = xi[2];
    points.emplace_back(2.0 + 0.5 * x + 0.10 * y - 0.05 * x * y + 0.03 * y * y + 0.04 * z,
                        0.1 - 0.1 * x + 0.4 * y + 0.04 * x * x - 0.03 * y * z,
                        flat ? 0. : 0.05 * x + 0.02 * y + 0.3 * z + 0.03 * x * y * z + 0.02 * z * z);
  }
  return points;
}

} // namespace rubato::test
