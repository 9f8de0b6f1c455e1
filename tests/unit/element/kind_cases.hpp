// SPDX-License-Identifier: LGPL-3.0-or-later
/// Every kind of nonlinear cell that is offered, and one such cell with a displacement.
#pragma once

#include "rubato/element/nonlinear.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <vector>

namespace rubato::element {

inline std::string name_of(const CellKind& kind) {
  constexpr const char* strains[] = {"Small", "GreenLagrange", "Logarithmic"};
  constexpr const char* formulations[] = {"Full", "MeanDilatation", "Enhanced", "Reduced", "LowerOrder"};
  return test::name_of(test::BulkCase{kind.type, kind.section.physics}) +
         strains[static_cast<int>(kind.strain)] + formulations[static_cast<int>(kind.formulation)] +
         (kind.hourglass.limit > 0 ? "Yielding" : "");
}

inline void PrintTo(const CellKind& kind, std::ostream* out) {
  *out << name_of(kind);
}

inline std::vector<CellKind> every_kind() {
  std::vector<CellKind> kinds;
  for (const auto& bulk : test::every_bulk_case())
    for (const auto strain : {StrainKind::small, StrainKind::green_lagrange, StrainKind::logarithmic})
      for (const auto formulation : {Formulation::full, Formulation::mean_dilatation, Formulation::enhanced,
                                     Formulation::reduced, Formulation::lower_order}) {
        CellKind kind{bulk.type, {bulk.physics, 0.7}, strain, formulation};
        if (!is_offered(kind))
          continue;
        if (formulation == Formulation::reduced)
          kind.hourglass.modulus = 80;
        kinds.push_back(kind);
        if (formulation == Formulation::reduced) {
          kind.hourglass.limit = 0.01;
          kinds.push_back(kind);
        }
      }
  return kinds;
}

/// One cell that is evaluated again and again from the same start of the step.
struct OneCell {
  OneCell(const CellKind& of_kind, const PointLaws& of_laws)
      : kind(of_kind), laws(of_laws), points(test::bent_cell(kind.type)),
        d(component_count(kind.section.physics)), dofs(static_cast<Eigen::Index>(points.size()) * d),
        old(static_cast<std::size_t>(state_size_of_cell(kind, laws.state_size()))), now(old), force(dofs),
        tangent(dofs, dofs), records(static_cast<std::size_t>(point_count(kind))) {}

  CellResult evaluate(const Eigen::VectorXd& u) {
    const auto size = static_cast<std::size_t>(dofs);
    return element::evaluate(kind, laws, {points, {u.data(), size}, old, step, modes, free_strain},
                             {now, {force.data(), size}, {tangent.data(), size * size}, records});
  }

  /// a + H x at the nodes.
  Eigen::VectorXd linear_field(const Eigen::Vector3d& a, const Eigen::Matrix3d& h) const {
    Eigen::VectorXd u(dofs);
    for (std::size_t i = 0; i < points.size(); ++i)
      u.segment(static_cast<Eigen::Index>(i) * d, d) = (a + h * points[i]).head(d);
    return u;
  }

  CellKind kind;
  PointLaws laws;
  std::vector<Eigen::Vector3d> points;
  int d;
  Eigen::Index dofs;
  std::vector<double> old, now;
  Eigen::VectorXd force;
  Eigen::MatrixXd tangent;
  std::vector<PointRecord> records;
  material::StepInfo step{1};
  ModeIteration modes{0, 0, 25}; ///< to rounding: derivatives are compared with differences
  std::vector<material::Strain6> free_strain;
};

inline Eigen::VectorXd some_displacement(const OneCell& cell) {
  constexpr double size = 0.02; // cells are about 1 long
  std::srand(7);
  return size * Eigen::VectorXd::Random(cell.dofs);
}

/// Differences of fourth order of the forces by dof j.
inline Eigen::VectorXd force_difference(OneCell& cell, const Eigen::VectorXd& u, Eigen::Index j) {
  constexpr double h = 5e-5;
  const auto force_at = [&](double step) {
    Eigen::VectorXd moved = u;
    moved[j] += step;
    EXPECT_TRUE(cell.evaluate(moved));
    return Eigen::VectorXd(cell.force);
  };
  const Eigen::VectorXd near = force_at(h) - force_at(-h), far = force_at(2 * h) - force_at(-2 * h);
  return (8 * near - far) / (12 * h);
}

/// Tangent and differences of the forces, by the largest of the tangent.
inline double error_of_tangent(OneCell& cell) {
  const Eigen::VectorXd u = some_displacement(cell);
  EXPECT_TRUE(cell.evaluate(u));
  const Eigen::MatrixXd k = cell.tangent;
  EXPECT_EQ(k, Eigen::MatrixXd(k.transpose())) << "not symmetric";
  double error = 0;
  for (Eigen::Index j = 0; j < cell.dofs; ++j)
    error = std::max(error, (force_difference(cell, u, j) - k.col(j)).cwiseAbs().maxCoeff());
  return error / k.cwiseAbs().maxCoeff();
}

} // namespace rubato::element
