// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/point_tangent.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/spring_friction.hpp"

#include <array>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// The law's derivatives with respect to λ, Λ₁, Λ₂ stand behind those of g and Δs.
constexpr int first_multiplier = 3;

using Frame = std::array<Vector3d, 3>;

Vector3d in_frame(const Frame& frame, const Vector3d& v) {
  return sum_of(sum_of(scaled(v[0], frame[0]), scaled(v[1], frame[1])), scaled(v[2], frame[2]));
}

/// Whether the place on the master does not move, as in a held frame.
bool has_no_slope(const Kinematics& k) {
  for (Index node = 0; node < k.shape_slope.rows(); ++node)
    if (k.shape_slope(node, 0) != 0 || k.shape_slope(node, 1) != 0)
      return false;
  return true;
}

void collect_dofs(const Kinematics& k, const domain::DofMap& map, std::vector<int>& dofs) {
  dofs.clear();
  for (const auto node : k.stencil.nodes)
    for (int i = 0; i < k.stencil.components; ++i)
      dofs.push_back(map.dof(node, i));
}

/// N and H: what a force at the point, and a change of its place on the master, put on q.
void collect_interpolation(const Kinematics& k, const Vector3d& force, int n_xi, MatrixXd& interpolation) {
  const int d = k.stencil.components;
  interpolation.setZero(d + n_xi, k.unknowns());
  for (Index node = 0; node < k.stencil.weights.size(); ++node)
    for (int i = 0; i < d; ++i) {
      interpolation(i, node * d + i) = k.stencil.weight(node, i);
      for (int a = 0; a < n_xi; ++a)
        interpolation(d + a, node * d + i) = k.shape_slope(node, a) * force[i];
    }
  for (std::size_t node = 0; node < k.stencil.turning.size(); ++node)
    for (int i = 0; i < d; ++i)
      for (int of = 0; of < d; ++of)
        interpolation(i, static_cast<Index>(node) * d + of) += k.stencil.turning[node](i, of);
}

} // namespace

MatrixXd FactoredResponse::force_by_displacement() const {
  MatrixXd rows(interpolation.rows(), d_du.cols());
  for (Index q = 0; q < d_du.cols(); ++q)
    for (Index i = 0; i < rows.rows(); ++i)
      rows(i, q) = d_du(i < components ? i : multipliers() + i, q);
  return rows;
}

PointEquations FactoredResponse::multiplier_equations() const {
  PointEquations of{equations, {}};
  const Index m = multipliers();
  of.by_multiplier.resize(m, m);
  for (Index a = 0; a < m; ++a)
    for (Index b = 0; b < m; ++b)
      of.by_multiplier(a, b) = by_multiplier(components + a, b);
  return of;
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

  const Frame in_space{scaled(-weight, k.normal), scaled(-weight, column_of(k.tangents, 0)),
                       scaled(-weight, column_of(k.tangents, 1))};
  const auto force = in_frame(in_space, response.traction);
  std::array<Vector3d, 6> force_by_variable; // g, Δs₁, Δs₂, λ, Λ₁, Λ₂
  for (std::size_t i = 0; i < force_by_variable.size(); ++i)
    force_by_variable[i] = in_frame(in_space, column_of(response.d_traction, static_cast<Index>(i)));
  const auto kept = response.kept_traction();
  const auto traction = scaled(-weight, kept);

  collect_dofs(k, dofs, into.dofs);
  into.components = d;
  into.n_xi = has_no_slope(k) ? 0 : k.parametric_dimension;
  into.force.resize(d);
  for (int i = 0; i < d; ++i)
    into.force[i] = force[i];
  collect_interpolation(k, response.kept_friction == 1 ? force : in_frame(in_space, kept), into.n_xi,
                        into.interpolation);
  into.d_du.resize(d + m + into.n_xi, k.unknowns());
  for (Index q = 0; q < k.unknowns(); ++q) {
    const Vector3d measures(k.d_gap[q], k.d_slip(0, q), k.d_slip(1, q));
    Index row = 0;
    for (int a = 0; a < d; ++a)
      into.d_du(row++, q) = force_by_variable[0][a] * measures[0] + force_by_variable[1][a] * measures[1] +
                            force_by_variable[2][a] * measures[2] + traction[0] * k.d_normal(a, q) +
                            traction[1] * k.d_tangent[0](a, q) + traction[2] * k.d_tangent[1](a, q);
    for (const int a : variables)
      into.d_du(row++, q) =
          weight * (response.d_equations(a, 0) * measures[0] + response.d_equations(a, 1) * measures[1] +
                    response.d_equations(a, 2) * measures[2]);
    for (int a = 0; a < into.n_xi; ++a)
      into.d_du(row++, q) = k.d_projection(a, q);
  }
  into.by_multiplier.resize(d + m, m);
  into.equations.resize(m);
  for (Index row = 0; row < m; ++row) {
    const int a = variables[static_cast<std::size_t>(row)];
    into.equations[row] = weight * response.equations[a];
    for (int i = 0; i < d; ++i)
      into.by_multiplier(i, row) = force_by_variable[static_cast<std::size_t>(first_multiplier + a)][i];
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
