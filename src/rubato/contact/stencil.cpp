// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/stencil.hpp"

namespace rubato::contact {

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

} // namespace rubato::contact
