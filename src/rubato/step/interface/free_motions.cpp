// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/free_motions.hpp"

#include "rubato/model/rigid_motions.hpp"

#include <Eigen/QR>

#include <cstddef>

namespace rubato::step {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd free_motions(const model::Model& model, const Compliance& compliance) {
  model::RigidMotions rigid(model);
  rigid.add_firm_supports();
  const auto loose = rigid.loose_alone();
  const auto& dofs = compliance.dof_of_interface_dof();
  MatrixXd motions = MatrixXd::Zero(static_cast<Index>(dofs.size()), static_cast<Index>(loose.size()));
  Index found = 0;
  for (const auto& motion : loose) {
    auto column = motions.col(found);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      const auto node = model.node_of(dofs[i]);
      if (rigid.bodies().of(node) != motion.body)
        continue;
      const auto moved = rigid.at(motion, model.mesh.points[static_cast<std::size_t>(node)]);
      column[static_cast<Index>(i)] = moved[dofs[i] - model.dofs.dof(node, 0)];
    }
    if (const double largest = column.lpNorm<Eigen::Infinity>(); largest > 0) {
      column /= largest;
      ++found;
    }
  }
  return motions.leftCols(found);
}

std::optional<VectorXd> shares_of_motions(const MatrixXd& motions, const VectorXd& correction,
                                          const MatrixXd& shifted) {
  const Eigen::ColPivHouseholderQR<MatrixXd> fit(motions);
  const MatrixXd changes = fit.solve(shifted.colwise() - correction);
  const Eigen::ColPivHouseholderQR<MatrixXd> shares(changes);
  if (fit.rank() < motions.cols() || shares.rank() < motions.cols())
    return std::nullopt;
  VectorXd found = -shares.solve(fit.solve(correction));
  return found.allFinite() ? std::optional(std::move(found)) : std::nullopt;
}

} // namespace rubato::step
