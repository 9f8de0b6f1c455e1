// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/wave_patterns.hpp"

#include "rubato/cell/reference_nodes.hpp"

namespace rubato::cell {
namespace {

using Eigen::MatrixXd;

/// Products of one or more of the coordinates ±1.
MatrixXd waves_of_box(const CellTopology& shape) {
  const int subsets = 1 << shape.dimension;
  MatrixXd waves = MatrixXd::Ones(shape.node_count, subsets - 1);
  for (int subset = 1; subset < subsets; ++subset)
    for (int axis = 0; axis < shape.dimension; ++axis)
      if ((subset >> axis & 1) != 0)
        for (int node = 0; node < shape.node_count; ++node)
          waves(node, subset - 1) *= reference_node(shape.type, node)[axis];
  return waves;
}

MatrixXd waves_of_prism() {
  MatrixXd waves(6, 7);
  waves.col(0) << -1, -1, -1, 1, 1, 1;
  const Eigen::Matrix3d each = Eigen::Matrix3d::Identity();
  waves.middleCols(1, 3) << each, each;
  waves.middleCols(4, 3) << -each, each;
  return waves;
}

} // namespace

MatrixXd shortest_waves(CellType type) {
  const auto& shape = topology(type);
  switch (type) {
  case CellType::quad4:
  case CellType::hexa8:
    return waves_of_box(shape);
  case CellType::penta6:
    return waves_of_prism();
  case CellType::tria3:
  case CellType::tetra4:
    return MatrixXd::Identity(shape.node_count, shape.node_count);
  default:
    return MatrixXd(shape.node_count, 0);
  }
}

} // namespace rubato::cell
