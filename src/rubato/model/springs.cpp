// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/build.hpp"

#include <fmt/format.h>

namespace rubato::model {

std::vector<Spring> make_springs(const study::Study& study, const mesh::Mesh& mesh,
                                 const domain::DofMap& dofs, std::vector<Fault>& faults) {
  std::vector<Spring> list;
  for (std::size_t s = 0; s < study.springs.size(); ++s) {
    const auto& springs = study.springs[s];
    const Mention on{springs.on, fmt::format("springs.{}.on", s)};
    for (const auto node : body_nodes_or_fault(mesh, dofs, on, "to pull at", faults))
      for (int i = 0; i < dofs.components; ++i)
        if (const double stiffness = springs.stiffness[static_cast<std::size_t>(i)]; stiffness > 0)
          list.push_back({dofs.dof(node, i), stiffness});
  }
  return list;
}

} // namespace rubato::model
