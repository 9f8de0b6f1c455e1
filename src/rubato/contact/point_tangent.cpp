// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/point_tangent.hpp"

#include "rubato/contact/spring_friction.hpp"

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The law's derivatives with respect to λ, Λ₁, Λ₂ stand behind those of g and Δs.
constexpr int first_multiplier = 3;

void collect_dofs(const Kinematics& k, const domain::DofMap& map, std::vector<int>& dofs) {
  dofs.clear();
  for (const auto node : k.stencil.nodes)
    for (int i = 0; i < k.stencil.components; ++i)
      dofs.push_back(map.dof(node, i));
}

/// N and H: what a force at the point, and a change of its place on the master, put on q.
void collect_interpolation(const Kinematics& k, const Eigen::Vector3d& force, int n_xi,
                           MatrixXd& interpolation) {
  const int d = k.stencil.components;
  interpolation.setZero(d + n_xi, k.unknowns());
  for (Index node = 0; node < k.stencil.weights.size(); ++node)
    for (int i = 0; i < d; ++i) {
      interpolation(i, node * d + i) = k.stencil.weight(node, i);
      for (int a = 0; a < n_xi; ++a)
        interpolation(d + a, node * d + i) = k.shape_slope(node, a) * force[i];
    }
}

} // namespace

MatrixXd FactoredResponse::force_by_displacement() const {
  MatrixXd rows(interpolation.rows(), d_du.cols());
  rows << d_du.topRows(components), d_du.bottomRows(n_xi);
  return rows;
}

void factor_response(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation, Status status,
                     const domain::DofMap& dofs, FactoredResponse& into) {
  const auto& k = *evaluation.kinematics;
  const auto variables = law.zone->multiplier_variables();
  const double weight = weight_of(law.zone->points[point], evaluation);
  auto response = respond(evaluation.variables, status, law.of_point(point));
  follow_limit(response);
  const int d = k.stencil.components;
  const auto m = static_cast<Index>(variables.size());

  Eigen::Matrix3d frame;
  frame << k.normal, k.tangents.col(0), k.tangents.col(1);
  const Eigen::Matrix3d in_space = -weight * frame;
  const Eigen::Vector3d force = in_space * response.traction;
  const Eigen::Matrix3d force_by_measures = in_space * response.d_traction.leftCols<3>();
  const Eigen::Matrix3d force_by_multiplier = in_space * response.d_traction.rightCols<3>();
  const Eigen::Matrix3d equations_by_measures = weight * response.d_equations.leftCols<3>();
  const Eigen::Vector3d traction = -weight * response.kept_traction();

  collect_dofs(k, dofs, into.dofs);
  into.components = d;
  into.n_xi = k.shape_slope.isZero(0) ? 0 : k.parametric_dimension;
  into.force = force.head(d);
  collect_interpolation(k, response.kept_friction == 1 ? force : Eigen::Vector3d(frame * traction), into.n_xi,
                        into.interpolation);
  into.d_du.resize(d + m + into.n_xi, k.unknowns());
  for (Index q = 0; q < k.unknowns(); ++q) {
    const Eigen::Vector3d measures(k.d_gap[q], k.d_slip(0, q), k.d_slip(1, q));
    const Eigen::Vector3d d_force = force_by_measures * measures + traction[0] * k.d_normal.col(q) +
                                    traction[1] * k.d_tangent[0].col(q) + traction[2] * k.d_tangent[1].col(q);
    const Eigen::Vector3d d_equations = equations_by_measures * measures;
    double* entry = into.d_du.col(q).data();
    for (int a = 0; a < d; ++a)
      *entry++ = d_force[a];
    for (const int a : variables)
      *entry++ = d_equations[a];
    for (int a = 0; a < into.n_xi; ++a)
      *entry++ = k.d_projection(a, q);
  }
  into.by_multiplier.resize(d + m, m);
  into.equations.resize(m);
  for (Index row = 0; row < m; ++row) {
    const int a = variables[static_cast<std::size_t>(row)];
    into.equations[row] = weight * response.equations[a];
    into.by_multiplier.col(row).head(d) = force_by_multiplier.col(a).head(d);
    for (Index column = 0; column < m; ++column)
      into.by_multiplier(d + row, column) =
          weight * response.d_equations(a, first_multiplier + variables[static_cast<std::size_t>(column)]);
  }
}

PointEquations open_equations(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation) {
  const auto variables = law.zone->multiplier_variables();
  const double weight = weight_of(law.zone->points[point], evaluation);
  const auto response = respond(evaluation.variables, Status::open, law.of_point(point));
  const auto count = static_cast<Index>(variables.size());
  PointEquations equations;
  equations.values.resize(count);
  equations.by_multiplier.resize(count, count);
  for (Index row = 0; row < count; ++row) {
    const int a = variables[static_cast<std::size_t>(row)];
    equations.values[row] = weight * response.equations[a];
    for (Index column = 0; column < count; ++column)
      equations.by_multiplier(row, column) =
          weight * response.d_equations(a, first_multiplier + variables[static_cast<std::size_t>(column)]);
  }
  return equations;
}

} // namespace rubato::contact
