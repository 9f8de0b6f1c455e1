// SPDX-License-Identifier: LGPL-3.0-or-later
/// From element matrices to the sparse matrices of the whole.
#pragma once

#include "rubato/domain/block_pattern.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <span>

namespace rubato::domain {

/// Stiffness of the whole where nothing has happened yet, times `factors[law]` for the cells of each law when
/// factors are given (Rayleigh damping). Cells must be sound (cell_faults). Throws InputError, with the cell,
/// when its matrix is not finite.
SparseMatrix assemble_stiffness(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                                std::span<const double> factors = {});

/// The part of the cells that keep their stiffness (Bulk::is_constant).
SparseMatrix assemble_constant_stiffness(const mesh::Mesh& mesh, const Bulk& bulk,
                                         const BlockPattern& pattern);

/// Consistent mass of the whole, times `factors[law]` likewise.
SparseMatrix assemble_mass(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                           std::span<const double> factors = {});

/// Lumped mass, one entry a dof (element.hpp's lumped_mass), times `factors[law]` likewise.
Eigen::VectorXd lumped_mass(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                            std::span<const double> factors = {});

} // namespace rubato::domain
