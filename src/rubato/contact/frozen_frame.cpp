// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/frozen_frame.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <utility>

namespace rubato::contact {

using Eigen::Vector3d;

Kinematics with_frozen_frame(Kinematics k) {
  const auto unknowns = k.unknowns();
  k.d_projection.setZero(2, unknowns);
  k.d_normal.setZero(3, unknowns);
  for (auto& variation : k.d_tangent)
    variation.setZero(3, unknowns);
  k.d_slave_normal.resize(3, 0);
  k.shape_slope.setZero(k.stencil.weights.size(), 2);
  k.d_gap.resize(unknowns);
  k.d_slip.setZero(2, unknowns);
  for (Eigen::Index node = 0; node < k.stencil.weights.size(); ++node)
    for (int i = 0; i < k.stencil.components; ++i) {
      const auto column = node * k.stencil.components + i;
      k.d_gap[column] = k.gap_weight(node, i) * k.normal[i];
      for (int a = 0; a < k.parametric_dimension; ++a)
        k.d_slip(a, column) = k.stencil.weight(node, i) * k.tangents(i, a);
    }
  return k;
}

namespace {

const Eigen::VectorXd& gap_weights_of(const Kinematics& k) {
  return k.gap_weights.size() > 0 ? k.gap_weights : k.stencil.weights;
}

} // namespace

Kinematics frozen_between(const Kinematics& a, const Kinematics& b) {
  Kinematics k = a;
  k.stencil.nodes.insert(k.stencil.nodes.end(), b.stencil.nodes.begin(), b.stencil.nodes.end());
  k.stencil.weights.resize(a.stencil.weights.size() + b.stencil.weights.size());
  k.stencil.weights << 0.5 * a.stencil.weights, 0.5 * b.stencil.weights;
  if (a.gap_weights.size() + b.gap_weights.size() > 0) {
    k.gap_weights.resize(k.stencil.weights.size());
    k.gap_weights << 0.5 * gap_weights_of(a), 0.5 * gap_weights_of(b);
  }
  k.shape_slope.resize(k.stencil.weights.size(), 2);
  k.normal = (a.normal + b.normal).normalized();
  const Vector3d along = a.tangents.col(0) + b.tangents.col(0);
  k.tangents.col(0) = (along - along.dot(k.normal) * k.normal).normalized();
  k.tangents.col(1) = k.normal.cross(Vector3d(k.tangents.col(0)));
  k.gap = 0.5 * (a.gap + b.gap);
  k.slip = 0.5 * (a.slip + b.slip);
  k.gap_origin = 0.5 * (a.gap_origin + b.gap_origin);
  k.slip_origin = 0.5 * (a.slip_origin + b.slip_origin);
  return with_frozen_frame(std::move(k));
}

void measure_in_frozen_frame(Kinematics& k, const Configuration& configuration) {
  const Vector3d apart = k.gap_vector([&](auto node) { return configuration.position(node); });
  const Vector3d moved =
      k.stencil.sum([&](auto node) { return configuration.increment(node); }) - k.obstacle_displacement;
  k.gap = k.normal.dot(apart) - k.gap_origin;
  for (int a = 0; a < k.parametric_dimension; ++a)
    k.slip[a] = k.tangents.col(a).dot(moved) - k.slip_origin[a];
}

} // namespace rubato::contact
