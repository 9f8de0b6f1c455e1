// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/face_normal.hpp"

#include "rubato/contact/pairing.hpp"

#include <cstddef>

namespace rubato::contact {

using Eigen::Vector3d;

FaceNormal::FaceNormal(const Face& face, const Eigen::Vector2d& xi, const Configuration& configuration)
    : face_(&face), shape_(face_shape(face.type, xi)),
      at_(face_geometry(face.type, deformed(face, configuration), shape_)),
      unit_(cross(column_of(at_.tangents, 0), column_of(at_.tangents, 1))),
      dimension_(configuration.dofs->components - 1) {}

Eigen::Matrix3d FaceNormal::by_node(int node) const {
  const Vector3d t1 = column_of(at_.tangents, 0), t2 = column_of(at_.tangents, 1);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int c = 0; c <= dimension_; ++c) {
    const Vector3d along(c == 0, c == 1, c == 2);
    for (int a = 0; a < dimension_; ++a) {
      const Vector3d turned = unit_.variation(a == 0 ? cross(along, t2) : cross(t1, along));
      const double slope = shape_.gradient(node, a, dimension_);
      for (int k = 0; k < 3; ++k)
        sum(k, c) += slope * turned[k];
    }
  }
  return sum;
}

} // namespace rubato::contact
