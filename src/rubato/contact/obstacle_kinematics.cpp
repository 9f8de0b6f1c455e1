// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/obstacle_kinematics.hpp"

#include <Eigen/Geometry>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

void take_nodes(const SlavePoint& point, int components, Kinematics& k) {
  const auto count = static_cast<Index>(point.nodes.size());
  k.stencil.components = components;
  k.parametric_dimension = components - 1;
  k.stencil.nodes.assign(point.nodes.begin(), point.nodes.end());
  k.stencil.weights = Eigen::Map<const Eigen::VectorXd>(point.shape.data(), count);
  k.shape_slope.setZero(count, 2);
  k.d_projection.setZero(2, k.unknowns());
}

/// dτ₁ = α τ₂ + β n, dτ₂ = −α τ₁ + γ n, dn = −β τ₁ − γ τ₂ for each displacement.
/// `drag`: how the obstacle's way changes with the point's place.
void vary(const PlaceOnObstacle& place, const Vector3d& moved, const Eigen::Matrix3d& drag, Kinematics& k) {
  const Vector3d n = k.normal, t1 = k.tangents.col(0), t2 = k.tangents.col(1);
  const auto unknowns = k.unknowns();
  k.d_normal.resize(3, unknowns);
  for (auto& variation : k.d_tangent)
    variation.resize(3, unknowns);
  k.d_gap.resize(unknowns);
  k.d_slip.setZero(2, unknowns);
  for (Index node = 0; node < k.stencil.weights.size(); ++node)
    for (int c = 0; c < k.stencil.components; ++c) {
      const auto column = node * k.stencil.components + c;
      const Vector3d turn = k.stencil.weights[node] * place.curvature.col(c);
      const double alpha = place.spin.dot(turn);
      k.d_normal.col(column) = turn;
      k.d_tangent[0].col(column) = alpha * t2 - t1.dot(turn) * n;
      k.d_tangent[1].col(column) = -alpha * t1 - t2.dot(turn) * n;
      k.d_gap[column] = k.stencil.weights[node] * n[c];
      for (int a = 0; a < k.parametric_dimension; ++a)
        k.d_slip(a, column) =
            k.stencil.weights[node] * (k.tangents(c, a) - k.tangents.col(a).dot(drag.col(c))) +
            moved.dot(k.d_tangent[static_cast<std::size_t>(a)].col(column));
    }
}

} // namespace

PlaceOnObstacle place_before(const Obstacle& obstacle, const SlavePoint& point, const Vector3d& x,
                             const Configuration& configuration) {
  return place_on(obstacle, obstacle.pose(configuration.t), x, point.place);
}

void evaluate_before(const Obstacle& obstacle, const SlavePoint& point, const Configuration& configuration,
                     Kinematics& k) {
  take_nodes(point, configuration.dofs->components, k);
  const Vector3d x = position(point, configuration);
  const auto place = place_before(obstacle, point, x, configuration);
  k.normal = place.normal;
  k.tangents << place.tangent, place.normal.cross(place.tangent);
  k.gap = place.gap;
  k.closest_point = x - place.gap * place.normal;
  const Vector3d start = k.stencil.sum([&](auto node) { return configuration.start_position(node); });
  k.obstacle_displacement = obstacle.way(start, x, configuration.start_t, configuration.t);
  const Vector3d moved =
      k.stencil.sum([&](auto node) { return configuration.increment(node); }) - k.obstacle_displacement;
  k.slip.setZero();
  for (int a = 0; a < k.parametric_dimension; ++a)
    k.slip[a] = k.tangents.col(a).dot(moved);
  vary(place, moved, obstacle.way_by_end(configuration.start_t, configuration.t), k);
}

} // namespace rubato::contact
