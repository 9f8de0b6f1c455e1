// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/rigid_unknowns.hpp"

#include "rubato/model/model.hpp"

#include <algorithm>

namespace rubato::step {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

Index motions_of(int components) {
  return components == 3 ? 6 : 3;
}

/// By the motion of that number, of a place counted from the middle.
Vector3d moved(Index motion, int components, const Vector3d& place) {
  if (motion < components)
    return Vector3d::Unit(motion);
  switch (components == 3 ? motion - components : Index{2}) { // axis × place
  case 0:
    return {0, -place[2], place[1]};
  case 1:
    return {place[2], 0, -place[0]};
  default:
    return {-place[1], place[0], 0};
  }
}

} // namespace

linalg::NodalUnknowns nodal_unknowns(const model::Model& model) {
  const int components = model.dofs.components;
  const auto& dofs = model.reduction.free_dofs();
  MatrixXd rigid(static_cast<Index>(dofs.size()), motions_of(components));
  const auto place_of = [&](int dof) -> const Vector3d& {
    return model.mesh.points[static_cast<std::size_t>(model.node_of(dof))];
  };
  Vector3d middle = Vector3d::Zero();
  for (const int dof : dofs)
    middle += place_of(dof) / static_cast<double>(dofs.size());
  double size = 0;
  for (const int dof : dofs)
    size = std::max(size, (place_of(dof) - middle).norm());
  for (std::size_t i = 0; i < dofs.size(); ++i)
    for (Index motion = 0; motion < rigid.cols(); ++motion)
      rigid(static_cast<Index>(i), motion) = moved(
          motion, components, (place_of(dofs[i]) - middle) / (size > 0 ? size : 1))[dofs[i] % components];
  return {components, dofs, rigid};
}

} // namespace rubato::step
