// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/held_surface.hpp"

#include "rubato/model/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::step {
namespace {

using contact::Status;

using Directions = std::array<std::array<double, 3>, 3>;

/// As a matrix: all, or that of the normal.
Directions held_directions(const contact::Kinematics& kinematics, bool everywhere) {
  Directions directions{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      directions[i][j] = everywhere ? (i == j ? 1.0 : 0.0)
                                    : kinematics.normal[static_cast<Eigen::Index>(i)] *
                                          kinematics.normal[static_cast<Eigen::Index>(j)];
  return directions;
}

void add_springs(const model::Model& model, const contact::Stencil& stencil, const Directions& directions,
                 const Eigen::VectorXd& diagonal, std::vector<NodeSpring>& springs) {
  double most = 0;
  for (const double weight : stencil.weights)
    most = std::max(most, std::abs(weight));
  for (std::size_t n = 0; most > 0 && n < stencil.nodes.size(); ++n) {
    const double share = stencil.weights[static_cast<Eigen::Index>(n)] / most;
    const int first = model.dofs.dof(stencil.nodes[n], 0);
    double sum = 0;
    for (int i = 0; i < stencil.components; ++i)
      sum += diagonal[first + i];
    const double stiffness = share * share * (sum / stencil.components);
    for (int i = 0; i < stencil.components; ++i)
      for (int j = 0; j < stencil.components; ++j)
        if (const double part = directions[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
            part != 0)
          springs.push_back({first + i, first + j, stiffness * part});
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
