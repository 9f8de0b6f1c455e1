// SPDX-License-Identifier: LGPL-3.0-or-later
/// Matrices of one cell of the bulk, whether its law is the same everywhere or depends on the place.
///
/// Sizes and units are those of element/element.hpp. `cell` is a place in `bulk.cells`, `type` and `points`
/// are those of that cell. All throw InputError where the law has no valid numbers (material::LawField::at).
#pragma once

#include "rubato/domain/bulk.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::domain {

void cell_stiffness(const Bulk& bulk, std::size_t cell, CellType type,
                    std::span<const Eigen::Vector3d> points, Eigen::Ref<Eigen::MatrixXd> k);

void cell_mass(const Bulk& bulk, std::size_t cell, CellType type, std::span<const Eigen::Vector3d> points,
               Eigen::Ref<Eigen::MatrixXd> m);

void cell_lumped_mass(const Bulk& bulk, std::size_t cell, CellType type,
                      std::span<const Eigen::Vector3d> points, Eigen::Ref<Eigen::VectorXd> m);

/// The law at each point of cell::stiffness_rule of a cell whose law depends on the place.
std::vector<material::Law> laws_at_points(const material::LawField& field, CellType type,
                                          std::span<const Eigen::Vector3d> points);

/// The laws at the points of cell::stiffness_rule of any cell. The bulk must outlive this.
class PointLaws {
public:
  PointLaws(const Bulk& bulk, std::size_t cell, CellType type, std::span<const Eigen::Vector3d> points);
  const material::Law& operator[](Eigen::Index point) const {
    return varying_.empty() ? *same_ : varying_[static_cast<std::size_t>(point)];
  }

private:
  const material::Law* same_;
  std::vector<material::Law> varying_;
};

/// The law of the cell; where it depends on the place, that at the first point of cell::stiffness_rule.
material::Law typical_law(const mesh::Mesh& mesh, const Bulk& bulk, std::size_t cell);

} // namespace rubato::domain
