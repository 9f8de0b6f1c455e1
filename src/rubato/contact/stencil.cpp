// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/stencil.hpp"

namespace rubato::contact {

using Eigen::Vector3d;
using Eigen::VectorXd;

void NumberedStencil::take(const Stencil& stencil, const domain::DofMap& dofs,
                           const std::vector<int>& number) {
  nodes.clear();
  for (std::size_t i = 0; i < stencil.nodes.size(); ++i) {
    Node node{.weight = stencil.weights[static_cast<Eigen::Index>(i)]};
    bool numbered = false;
    for (int c = 0; c < stencil.components; ++c) {
      const int at = number[static_cast<std::size_t>(dofs.dof(stencil.nodes[i], c))];
      node.at[static_cast<std::size_t>(c)] = at;
      numbered = numbered || at >= 0;
    }
    if (node.weight != 0 && numbered)
      nodes.push_back(node);
  }
}

Vector3d NumberedStencil::gather(const VectorXd& values) const {
  Vector3d total = Vector3d::Zero();
  for (const auto& node : nodes)
    for (std::size_t c = 0; c < 3; ++c)
      if (const int at = node.at[c]; at >= 0)
        total[static_cast<Eigen::Index>(c)] += node.weight * values[at];
  return total;
}

void NumberedStencil::scatter(const Vector3d& force, VectorXd& values) const {
  for (const auto& node : nodes)
    for (std::size_t c = 0; c < 3; ++c)
      if (const int at = node.at[c]; at >= 0)
        values[at] += node.weight * force[static_cast<Eigen::Index>(c)];
}

} // namespace rubato::contact
