// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/factored_response.hpp"

#include <Eigen/LU>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The law's derivatives with respect to λ, Λ₁, Λ₂ stand behind those of g and Δs.
constexpr int first_multiplier = 3;

std::vector<int> dofs_of(const Kinematics& k, const fem::DofMap& map) {
  std::vector<int> dofs;
  dofs.reserve(static_cast<std::size_t>(k.unknowns()));
  for (const auto node : k.nodes)
    for (int i = 0; i < k.components; ++i)
      dofs.push_back(map.dof(node, i));
  return dofs;
}

/// N and H: what a force at the point, and a change of its place on the master, put on q.
MatrixXd spread_of(const Kinematics& k, const Eigen::Vector3d& force, int slopes) {
  const int d = k.components;
  MatrixXd spread = MatrixXd::Zero(d + slopes, k.unknowns());
  for (Index node = 0; node < k.shape.size(); ++node)
    for (int i = 0; i < d; ++i) {
      spread(i, node * d + i) = k.shape[node];
      for (int a = 0; a < slopes; ++a)
        spread(d + a, node * d + i) = k.shape_slope(node, a) * force[i];
    }
  return spread;
}

} // namespace

FactoredResponse factor_response(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation,
                                 Status status, const fem::DofMap& dofs) {
  const auto& k = *evaluation.kinematics;
  const auto variables = law.zone->multiplier_variables();
  const double weight = law.zone->points[point].weight;
  const auto response = respond(evaluation.variables, status, law.of_point(point));
  const int d = k.components;
  const auto m = static_cast<Index>(variables.size());

  Eigen::Matrix3d frame;
  frame << k.normal, k.tangents.col(0), k.tangents.col(1);
  const Eigen::Vector3d force = -weight * frame * response.traction;
  Eigen::Matrix<double, 3, Eigen::Dynamic> d_variables(3, k.unknowns());
  d_variables << k.d_gap, k.d_slip;
  const Eigen::Matrix<double, 3, Eigen::Dynamic> d_force =
      -weight *
      (frame * (response.d_traction.leftCols<3>() * d_variables) + response.traction[0] * k.d_normal +
       response.traction[1] * k.d_tangent[0] + response.traction[2] * k.d_tangent[1]);
  const Eigen::Matrix3d force_by_multiplier = -weight * frame * response.d_traction.rightCols<3>();

  FactoredResponse factored;
  factored.dofs = dofs_of(k, dofs);
  factored.components = d;
  factored.slopes = k.d_projection.isZero(0) ? 0 : k.parametric_dimension;
  factored.force = force.head(d);
  factored.spread = spread_of(k, force, factored.slopes);
  factored.by_q.resize(d + m + factored.slopes, k.unknowns());
  factored.by_q.topRows(d) = d_force.topRows(d);
  factored.by_q.bottomRows(factored.slopes) = k.d_projection.topRows(factored.slopes);
  factored.by_multiplier.resize(d + m, m);
  factored.equations.resize(m);
  for (Index row = 0; row < m; ++row) {
    const int a = variables[static_cast<std::size_t>(row)];
    factored.equations[row] = weight * response.equations[a];
    factored.by_q.row(d + row) = weight * response.d_equations.row(a).head<3>() * d_variables;
    factored.by_multiplier.col(row).head(d) = force_by_multiplier.col(a).head(d);
    for (Index column = 0; column < m; ++column)
      factored.by_multiplier(d + row, column) =
          weight * response.d_equations(a, first_multiplier + variables[static_cast<std::size_t>(column)]);
  }
  return factored;
}

VectorXd release(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation) {
  const auto variables = law.zone->multiplier_variables();
  const auto response = respond(evaluation.variables, Status::open, law.of_point(point));
  const auto m = static_cast<Index>(variables.size());
  MatrixXd by_multiplier(m, m);
  VectorXd equations(m);
  for (Index row = 0; row < m; ++row) {
    const int a = variables[static_cast<std::size_t>(row)];
    equations[row] = response.equations[a];
    for (Index column = 0; column < m; ++column)
      by_multiplier(row, column) =
          response.d_equations(a, first_multiplier + variables[static_cast<std::size_t>(column)]);
  }
  return -by_multiplier.partialPivLu().solve(equations);
}

} // namespace rubato::contact
