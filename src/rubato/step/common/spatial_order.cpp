// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/spatial_order.hpp"

#include "rubato/core/spatial_order.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/model.hpp"

namespace rubato::step {

std::vector<int> in_spatial_order(const model::Model& model, std::span<const int> unknowns,
                                  std::size_t together) {
  const auto& dofs = model.reduction.free_dofs();
  std::vector<Eigen::Vector3d> points;
  std::vector<std::size_t> first; ///< of each node in `unknowns`
  mesh::NodeIndex last = -1;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto node = model.node_of(dofs[static_cast<std::size_t>(unknowns[i])]);
    if (node == last)
      continue;
    last = node;
    first.push_back(i);
    points.push_back(model.mesh.points[static_cast<std::size_t>(node)]);
  }
  first.push_back(unknowns.size());
  std::vector<int> ordered;
  ordered.reserve(unknowns.size());
  for (const auto i : spatial_order(points, together))
    for (std::size_t k = first[i]; k < first[i + 1]; ++k)
      ordered.push_back(unknowns[k]);
  return ordered;
}

} // namespace rubato::step
