// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/med_gauss.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/mesh/io/med_numbering.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

#include <cmath>

namespace rubato::results {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Corners of MEDCoupling's reference cells, in MED's order (GaussInfo: TETRA4B, PYRA5B, PENTA6B); none where
/// they are ours.
std::vector<Vector3d> corners_in_med(CellType linear) {
  switch (linear) {
  case CellType::tetra4:
    return {{0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  case CellType::pyra5:
    return {{1, 0, 0}, {0, -1, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  case CellType::penta6:
    return {{-1, 1, 0}, {-1, 0, 0}, {-1, 0, 1}, {1, 1, 0}, {1, 0, 0}, {1, 0, 1}};
  default:
    return {};
  }
}

/// x ↦ A x + b from our reference cell to MED's.
struct Map {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();
  Vector3d operator()(const Vector3d& x) const { return linear * x + shift; }
};

/// Ours are images of MED's, so that the fit is exact.
Map map_to_med(CellType type) {
  const auto linear = cell::linear_type(type);
  const auto targets = corners_in_med(linear);
  if (targets.empty())
    return {};
  const auto count = static_cast<Index>(targets.size());
  const auto order = mesh::med::node_order(linear);
  MatrixXd ours(count, 4);
  MatrixXd theirs(count, 3);
  for (Index i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    ours.row(i) << cell::reference_cell(linear).nodes[n].transpose(), 1;
    theirs.row(i) = targets[order[n]].transpose();
  }
  const MatrixXd fit = (linalg::pseudo_inverse(ours) * theirs).transpose();
  return {fit.leftCols<3>(), fit.col(3)};
}

} // namespace

MedGauss med_gauss(CellType type) {
  const auto& reference = cell::reference_cell(type);
  const auto map = map_to_med(type);
  const double scale = std::abs(map.linear.determinant());
  const auto order = mesh::med::node_order(type);
  MedGauss gauss{fmt::format("gauss_{}", cell::topology(type).name), reference.dimension, {}, {}, {}};
  const auto d = static_cast<std::size_t>(gauss.dimension);
  gauss.nodes.resize(reference.nodes.size() * d);
  for (std::size_t i = 0; i < reference.nodes.size(); ++i) {
    const Vector3d x = map(reference.nodes[i]);
    for (std::size_t axis = 0; axis < d; ++axis)
      gauss.nodes[(order.empty() ? i : order[i]) * d + axis] = x[static_cast<Index>(axis)];
  }
  for (const auto& point : cell::stiffness_rule(type)) {
    const Vector3d x = map(point.xi);
    gauss.points.insert(gauss.points.end(), x.data(), x.data() + d);
    gauss.weights.push_back(scale * point.weight);
  }
  return gauss;
}

} // namespace rubato::results
