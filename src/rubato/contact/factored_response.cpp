// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/factored_response.hpp"

#include <Eigen/LU>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The law's derivatives with respect to λ, Λ₁, Λ₂ stand behind those of g and Δs.
constexpr int first_multiplier = 3;

/// As many unknowns as a point can have: nine slave nodes, between two faces of nine.
constexpr int most_unknowns = 81;
using DisplacementColumns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_unknowns>;

void collect_dofs(const Kinematics& k, const fem::DofMap& map, std::vector<int>& dofs) {
  dofs.clear();
  for (const auto node : k.nodes)
    for (int i = 0; i < k.components; ++i)
      dofs.push_back(map.dof(node, i));
}

/// N and H: what a force at the point, and a change of its place on the master, put on q.
void collect_spread(const Kinematics& k, const Eigen::Vector3d& force, int slopes, MatrixXd& spread) {
  const int d = k.components;
  spread.setZero(d + slopes, k.unknowns());
  for (Index node = 0; node < k.shape.size(); ++node)
    for (int i = 0; i < d; ++i) {
      spread(i, node * d + i) = k.shape[node];
      for (int a = 0; a < slopes; ++a)
        spread(d + a, node * d + i) = k.shape_slope(node, a) * force[i];
    }
}

} // namespace

void factor_response(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation, Status status,
                     const fem::DofMap& dofs, FactoredResponse& into) {
  const auto& k = *evaluation.kinematics;
  const auto variables = law.zone->multiplier_variables();
  const double weight = law.zone->points[point].weight;
  const auto response = respond(evaluation.variables, status, law.of_point(point));
  const int d = k.components;
  const auto m = static_cast<Index>(variables.size());

  Eigen::Matrix3d frame;
  frame << k.normal, k.tangents.col(0), k.tangents.col(1);
  const Eigen::Vector3d force = -weight * frame * response.traction;
  DisplacementColumns d_variables(3, k.unknowns());
  d_variables << k.d_gap, k.d_slip;
  const Eigen::Matrix3d traction_by_variables = frame * response.d_traction.leftCols<3>();
  DisplacementColumns d_force = traction_by_variables.lazyProduct(d_variables);
  d_force += response.traction[0] * k.d_normal + response.traction[1] * k.d_tangent[0] +
             response.traction[2] * k.d_tangent[1];
  d_force *= -weight;
  const Eigen::Matrix3d force_by_multiplier = -weight * frame * response.d_traction.rightCols<3>();

  collect_dofs(k, dofs, into.dofs);
  into.components = d;
  into.slopes = k.d_projection.isZero(0) ? 0 : k.parametric_dimension;
  into.force = force.head(d);
  collect_spread(k, force, into.slopes, into.spread);
  into.by_q.resize(d + m + into.slopes, k.unknowns());
  into.by_q.topRows(d) = d_force.topRows(d);
  into.by_q.bottomRows(into.slopes) = k.d_projection.topRows(into.slopes);
  into.by_multiplier.resize(d + m, m);
  into.equations.resize(m);
  for (Index row = 0; row < m; ++row) {
    const int a = variables[static_cast<std::size_t>(row)];
    into.equations[row] = weight * response.equations[a];
    into.by_q.row(d + row) = weight * response.d_equations.row(a).head<3>().lazyProduct(d_variables);
    into.by_multiplier.col(row).head(d) = force_by_multiplier.col(a).head(d);
    for (Index column = 0; column < m; ++column)
      into.by_multiplier(d + row, column) =
          weight * response.d_equations(a, first_multiplier + variables[static_cast<std::size_t>(column)]);
  }
}

PointVector release(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation) {
  const auto variables = law.zone->multiplier_variables();
  const auto response = respond(evaluation.variables, Status::open, law.of_point(point));
  const auto m = static_cast<Index>(variables.size());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> by_multiplier(m, m);
  PointVector equations(m);
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
