// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/free_motions.hpp"

#include "rubato/model/model.hpp"
#include "rubato/model/rigid_motions.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace rubato::step {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Eigen::Vector3d;

/// How a motion takes the places of one body.
struct BodyMotion {
  int body = -1;
  std::function<Vector3d(const Vector3d& place)> at;
};

/// Middle of the surfaces of a body.
Vector3d middle_of(const model::Model& model, const model::Bodies& bodies, int body,
                   std::span<const int> dofs) {
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (const int dof : dofs)
    if (const auto node = model.node_of(dof); bodies.of(node) == body) {
      sum += model.mesh.points[static_cast<std::size_t>(node)];
      ++count;
    }
  return sum / std::max(1.0, count);
}

/// In axisymmetry the section of a ring turns against its hoop stiffness alone, which is little beside
/// contact: that counts as a motion, too.
std::vector<BodyMotion> motions_of(const model::Model& model, const model::RigidMotions& rigid,
                                   std::span<const int> dofs) {
  std::vector<BodyMotion> motions;
  for (const auto& motion : rigid.loose_alone()) {
    motions.push_back(
        {motion.body, [&rigid, motion](const Vector3d& place) { return rigid.at(motion, place); }});
    if (model.study.physics == study::Physics::axisymmetric)
      motions.push_back({motion.body, [middle = middle_of(model, rigid.bodies(), motion.body, dofs)](
                                          const Vector3d& place) {
                           return Vector3d(middle.y() - place.y(), place.x() - middle.x(), 0);
                         }});
  }
  return motions;
}

} // namespace

MatrixXd free_motions(const model::Model& model, const Compliance& compliance) {
  model::RigidMotions rigid(model);
  rigid.add_firm_supports();
  const auto& dofs = compliance.dof_of_interface_dof();
  const auto loose = motions_of(model, rigid, dofs);
  MatrixXd motions = MatrixXd::Zero(static_cast<Index>(dofs.size()), static_cast<Index>(loose.size()));
  Index found = 0;
  for (const auto& motion : loose) {
    auto column = motions.col(found);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      const auto node = model.node_of(dofs[i]);
      if (rigid.bodies().of(node) == motion.body)
        column[static_cast<Index>(i)] =
            motion.at(model.mesh.points[static_cast<std::size_t>(node)])[dofs[i] - model.dofs.dof(node, 0)];
    }
    if (const double largest = column.lpNorm<Eigen::Infinity>(); largest > 0) {
      column /= largest;
      ++found;
    }
  }
  return motions.leftCols(found);
}

FreeMotions::FreeMotions(MatrixXd motions) : motions_(std::move(motions)) {
  if (count() == 0)
    return;
  fit_.emplace(motions_);
  if (fit_->rank() < count())
    motions_.resize(motions_.rows(), 0);
}

std::optional<VectorXd> FreeMotions::shares(const VectorXd& correction, const MatrixXd& shifted) const {
  MatrixXd changes = shifted;
  for (Index k = 0; k < changes.cols(); ++k)
    changes.col(k) -= correction;
  const linalg::PivotedQr shares(fit_->solve(std::move(changes)));
  if (shares.rank() < count())
    return std::nullopt;
  VectorXd found = shares.solve(fit_->solve(correction)).col(0);
  found *= -1;
  return found.allFinite() ? std::optional(std::move(found)) : std::nullopt;
}

} // namespace rubato::step
