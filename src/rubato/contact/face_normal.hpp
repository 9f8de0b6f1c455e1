// SPDX-License-Identifier: LGPL-3.0-or-later
/// The unit normal of one deformed face at a reference place, and how displacements of its nodes turn it.
#pragma once

#include "rubato/contact/projection.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/surface.hpp"
#include "rubato/contact/zone.hpp"

#include <Eigen/Core>

namespace rubato::contact {

/// v / |v|, and its variation as v varies.
struct UnitVector {
  double inverse_length;
  Eigen::Vector3d direction;

  explicit UnitVector(const Eigen::Vector3d& v)
      : inverse_length(1 / length_of(v)), direction(scaled(inverse_length, v)) {}
  Eigen::Vector3d variation(const Eigen::Vector3d& dv) const {
    return scaled(inverse_length, part_across(direction, dv));
  }
};

class FaceNormal {
public:
  FaceNormal(const Face& face, const Eigen::Vector2d& xi, const Configuration& configuration);

  const Face& face() const { return *face_; }
  const Eigen::Vector3d& direction() const { return unit_.direction; }
  /// ∂n/∂u of a node of the face, one column a component; 0 in those that the space does not have.
  Eigen::Matrix3d by_node(int node) const;

private:
  const Face* face_;
  FaceShape shape_;
  FaceGeometry at_;
  UnitVector unit_;
  int dimension_;
};

} // namespace rubato::contact
