// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/frozen_frame.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <cstddef>
#include <utility>

namespace rubato::contact {

using Eigen::Vector3d;

namespace {

/// Adds to the derivatives of gap and slip what the rotation of a tie's gap vector does.
void add_turning_variations(Kinematics& k) {
  for (std::size_t node = 0; node < k.stencil.turning.size(); ++node)
    for (int i = 0; i < k.stencil.components; ++i) {
      const auto column = static_cast<Eigen::Index>(node) * k.stencil.components + i;
      const auto turned = column_of(k.stencil.turning[node], i);
      k.d_gap[column] += dot(k.normal, turned);
      for (int a = 0; a < k.parametric_dimension; ++a)
        k.d_slip(a, column) += dot(column_of(k.tangents, a), turned);
    }
}

} // namespace

Kinematics with_frozen_frame(Kinematics k) {
  const auto unknowns = k.unknowns();
  k.d_projection.setZero(2, unknowns);
  k.d_normal.setZero(3, unknowns);
  for (auto& variation : k.d_tangent)
    variation.setZero(3, unknowns);
  k.d_given_normal.resize(3, 0);
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
  add_turning_variations(k);
  return k;
}

namespace {

const Eigen::VectorXd& gap_weights_of(const Kinematics& k) {
  return k.gap_weights.size() > 0 ? k.gap_weights : k.stencil.weights;
}

/// Half of each, one after the other.
void join_halves(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::VectorXd& into) {
  for (Eigen::Index i = 0; i < a.size(); ++i)
    into[i] = 0.5 * a[i];
  for (Eigen::Index i = 0; i < b.size(); ++i)
    into[a.size() + i] = 0.5 * b[i];
}

} // namespace

Kinematics frozen_between(const Kinematics& a, const Kinematics& b) {
  Kinematics k = a;
  k.stencil.nodes.insert(k.stencil.nodes.end(), b.stencil.nodes.begin(), b.stencil.nodes.end());
  k.stencil.weights.resize(a.stencil.weights.size() + b.stencil.weights.size());
  join_halves(a.stencil.weights, b.stencil.weights, k.stencil.weights);
  if (a.gap_weights.size() + b.gap_weights.size() > 0) {
    k.gap_weights.resize(k.stencil.weights.size());
    join_halves(gap_weights_of(a), gap_weights_of(b), k.gap_weights);
  }
  k.shape_slope.resize(k.stencil.weights.size(), 2);
  k.normal = unit_of(sum_of(a.normal, b.normal));
  const auto first =
      unit_of(part_across(k.normal, sum_of(column_of(a.tangents, 0), column_of(b.tangents, 0))));
  const auto second = cross(k.normal, first);
  for (int i = 0; i < 3; ++i) {
    k.tangents(i, 0) = first[i];
    k.tangents(i, 1) = second[i];
  }
  k.gap = 0.5 * (a.gap + b.gap);
  for (int i = 0; i < 2; ++i) {
    k.slip[i] = 0.5 * (a.slip[i] + b.slip[i]);
    k.slip_origin[i] = 0.5 * (a.slip_origin[i] + b.slip_origin[i]);
  }
  k.gap_origin = 0.5 * (a.gap_origin + b.gap_origin);
  return with_frozen_frame(std::move(k));
}

void measure_in_frozen_frame(Kinematics& k, const Configuration& configuration) {
  const Vector3d apart = k.gap_vector([&](auto node) { return configuration.position(node); });
  const auto moved = difference_of(k.stencil.sum([&](auto node) { return configuration.increment(node); }),
                                   k.obstacle_displacement);
  k.gap = dot(k.normal, apart) - k.gap_origin;
  for (int a = 0; a < k.parametric_dimension; ++a)
    k.slip[a] = dot(column_of(k.tangents, a), moved) - k.slip_origin[a];
}

} // namespace rubato::contact
