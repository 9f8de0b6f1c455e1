// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact equations of two faces as one dense system, to be held against differences.
#pragma once

#include "rubato/contact/discretisation.hpp"

#include "two_faces.hpp"
#include <vector>

namespace rubato::test {

inline Eigen::VectorXd moved(const Eigen::VectorXd& u, Eigen::Index dof, double by) {
  Eigen::VectorXd v = u;
  v[dof] += by;
  return v;
}

struct System {
  Eigen::VectorXd residual; ///< forces, then equations
  Eigen::MatrixXd tangent;
};

/// The contact system with every paired point in the same status.
inline System system_at(const TwoFaces& setup, const Eigen::VectorXd& u, const Eigen::VectorXd& multipliers,
                        contact::Status wanted) {
  const auto configuration = setup.configuration(u);
  const auto points = contact::evaluate(setup.zone, multipliers, configuration);
  std::vector<contact::Status> status;
  for (const auto& point : points)
    status.push_back(point.kinematics ? wanted : contact::Status::open);
  const contact::ZoneCoefficients coefficients{std::vector<double>(points.size(), 3.0),
                                               std::vector<double>(points.size(), 2.0)};
  const contact::ZoneLaw law{&setup.zone, &coefficients, setup.zone.settings.friction};
  contact::ContactSystem system(setup.dofs.dof_count, multipliers.size());
  contact::add_contributions(law, points, status, setup.dofs, 0, system);
  System dense;
  const auto dofs = setup.dofs.dof_count;
  dense.residual.resize(dofs + multipliers.size());
  dense.residual << system.force, system.equations;
  dense.tangent = Eigen::MatrixXd::Zero(dense.residual.size(), dense.residual.size());
  for (const auto& t : system.force_by_dof)
    dense.tangent(t.row(), t.col()) += t.value();
  for (const auto& t : system.force_by_multiplier)
    dense.tangent(t.row(), dofs + t.col()) += t.value();
  for (const auto& t : system.equation_by_dof)
    dense.tangent(dofs + t.row(), t.col()) += t.value();
  for (const auto& t : system.equation_by_multiplier)
    dense.tangent(dofs + t.row(), dofs + t.col()) += t.value();
  return dense;
}

} // namespace rubato::test
