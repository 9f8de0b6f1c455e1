// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: forces on a surface as CalculiX sums them up.
#pragma once

#include "rubato/results/table_lines.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace rubato::results {

/// Sums over parts of a surface; the normal of a part times its area.
class SurfaceStatistics {
public:
  void add(const Eigen::Vector3d& place, const Eigen::Vector3d& normal_area, const Eigen::Vector3d& force) {
    const double area = normal_area.norm();
    area_ += area;
    normal_ += normal_area;
    first_moment_ += area * place;
    force_ += force;
    moment_ += place.cross(force);
  }

  /// The lines below the heading. `torque`: with the moments along and across the normal.
  void put(TableText& text, bool torque) const;

private:
  double area_ = 0;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d first_moment_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();
};

} // namespace rubato::results
