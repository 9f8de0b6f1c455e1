// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/cell_rates.hpp"

#include "rubato/domain/cell_matrices.hpp"
#include "rubato/linalg/dense_decompositions.hpp"

#include <cmath>

namespace rubato::domain {

double CellVibration::bound() const {
  return stiffness.norm() / mass.minCoeff();
}

double CellVibration::largest() const {
  const auto components = stiffness.rows() / mass.size();
  Eigen::MatrixXd rates = stiffness;
  for (Eigen::Index j = 0; j < rates.cols(); ++j)
    for (Eigen::Index i = 0; i < rates.rows(); ++i)
      rates(i, j) /= std::sqrt(mass[i / components]) * std::sqrt(mass[j / components]);
  if (!(rates.norm() > 0))
    return 0;
  return linalg::symmetric_eigenvalues(rates)[rates.rows() - 1];
}

CellVibration vibration_of(const mesh::Mesh& mesh, const Bulk& bulk, std::size_t cell) {
  const auto index = bulk.cells[cell];
  const auto type = mesh.type_of(index);
  const auto nodes = mesh.nodes_of(index);
  const CellPoints points(mesh, nodes);
  const auto count = static_cast<Eigen::Index>(nodes.size());
  const auto size = count * element::component_count(bulk.section.physics);
  CellVibration result{Eigen::MatrixXd(size, size), Eigen::VectorXd(count)};
  cell_stiffness(bulk, cell, type, points, result.stiffness);
  cell_lumped_mass(bulk, cell, type, points, result.mass);
  return result;
}

} // namespace rubato::domain
