// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/held_surface.hpp"

#include "rubato/model/model.hpp"

#include <cmath>

namespace rubato::step {
namespace {

using contact::Status;

/// As a matrix: all, or that of the normal.
Eigen::Matrix3d held_directions(const contact::Kinematics& kinematics, bool everywhere) {
  if (everywhere)
    return Eigen::Matrix3d::Identity();
  return kinematics.normal * kinematics.normal.transpose();
}

void add_springs(const model::Model& model, const contact::Stencil& stencil,
                 const Eigen::Matrix3d& directions, const Eigen::VectorXd& diagonal,
                 std::vector<NodeSpring>& springs) {
  const double most = stencil.weights.lpNorm<Eigen::Infinity>();
  for (std::size_t n = 0; most > 0 && n < stencil.nodes.size(); ++n) {
    const double share = stencil.weights[static_cast<Eigen::Index>(n)] / most;
    const int first = model.dofs.dof(stencil.nodes[n], 0);
    const double stiffness = share * share * diagonal.segment(first, stencil.components).mean();
    for (int i = 0; i < stencil.components; ++i)
      for (int j = 0; j < stencil.components; ++j)
        if (directions(i, j) != 0)
          springs.push_back({first + i, first + j, stiffness * directions(i, j)});
  }
}

} // namespace

std::vector<NodeSpring> springs_of_contact(const model::Model& model, const ContactIterate& contact,
                                           const Eigen::VectorXd& diagonal, Held held) {
  std::vector<NodeSpring> springs;
  for (std::size_t z = 0; z < contact.points.size(); ++z)
    for (std::size_t i = 0; i < contact.points[z].size(); ++i) {
      const auto status = contact.status[z][i];
      const auto& kinematics = contact.points[z][i].kinematics;
      if (status != Status::open && kinematics)
        add_springs(model, kinematics->stencil,
                    held_directions(*kinematics, status == Status::stick || held == Held::everywhere),
                    diagonal, springs);
    }
  return springs;
}

} // namespace rubato::step
