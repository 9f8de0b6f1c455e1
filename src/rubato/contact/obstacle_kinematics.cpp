// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/obstacle_kinematics.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <array>
#include <cstddef>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

void take_nodes(const SlavePoint& point, int components, Kinematics& k) {
  const auto count = static_cast<Index>(point.nodes.size());
  k.stencil.components = components;
  k.parametric_dimension = components - 1;
  k.stencil.nodes.assign(point.nodes.begin(), point.nodes.end());
  k.stencil.weights.resize(count);
  for (Index i = 0; i < count; ++i)
    k.stencil.weights[i] = point.shape[static_cast<std::size_t>(i)];
  k.shape_slope.setZero(count, 2);
  k.d_projection.setZero(2, k.unknowns());
}

/// dτ₁ = α τ₂ + β n, dτ₂ = −α τ₁ + γ n, dn = −β τ₁ − γ τ₂ for each displacement.
/// `drag`: how the obstacle's way changes with the point's place.
void vary(const PlaceOnObstacle& place, const Vector3d& moved, const Eigen::Matrix3d& drag, Kinematics& k) {
  const Vector3d n = k.normal;
  const std::array<Vector3d, 2> t{column_of(k.tangents, 0), column_of(k.tangents, 1)};
  const auto unknowns = k.unknowns();
  k.d_normal.resize(3, unknowns);
  for (auto& variation : k.d_tangent)
    variation.resize(3, unknowns);
  k.d_gap.resize(unknowns);
  k.d_slip.setZero(2, unknowns);
  for (Index node = 0; node < k.stencil.weights.size(); ++node)
    for (int c = 0; c < k.stencil.components; ++c) {
      const auto column = node * k.stencil.components + c;
      const auto turn = scaled(k.stencil.weights[node], column_of(place.curvature, c));
      const double alpha = dot(place.spin, turn);
      const std::array<Vector3d, 2> d_tangent{
          difference_of(scaled(alpha, t[1]), scaled(dot(t[0], turn), n)),
          difference_of(scaled(-alpha, t[0]), scaled(dot(t[1], turn), n))};
      for (int i = 0; i < 3; ++i) {
        k.d_normal(i, column) = turn[i];
        k.d_tangent[0](i, column) = d_tangent[0][i];
        k.d_tangent[1](i, column) = d_tangent[1][i];
      }
      k.d_gap[column] = k.stencil.weights[node] * n[c];
      for (int a = 0; a < k.parametric_dimension; ++a)
        k.d_slip(a, column) =
            k.stencil.weights[node] *
                (k.tangents(c, a) - dot(t[static_cast<std::size_t>(a)], column_of(drag, c))) +
            dot(moved, d_tangent[static_cast<std::size_t>(a)]);
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
  const auto second = cross(place.normal, place.tangent);
  for (int i = 0; i < 3; ++i) {
    k.tangents(i, 0) = place.tangent[i];
    k.tangents(i, 1) = second[i];
  }
  k.gap = place.gap;
  k.closest_point = difference_of(x, scaled(place.gap, place.normal));
  const Vector3d start = k.stencil.sum([&](auto node) { return configuration.start_position(node); });
  k.obstacle_displacement = obstacle.way(start, x, configuration.start_t, configuration.t);
  const auto moved = difference_of(k.stencil.sum([&](auto node) { return configuration.increment(node); }),
                                   k.obstacle_displacement);
  k.slip.setZero();
  for (int a = 0; a < k.parametric_dimension; ++a)
    k.slip[a] = dot(column_of(k.tangents, a), moved);
  vary(place, moved, obstacle.way_by_end(configuration.start_t, configuration.t), k);
}

} // namespace rubato::contact
