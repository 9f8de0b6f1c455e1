// SPDX-License-Identifier: LGPL-3.0-or-later
/// How thin a cell is, which bounds the time that a wave takes to cross it.
#pragma once

#include "rubato/core/cell_type.hpp"

#include <Eigen/Core>

#include <span>

namespace rubato::cell {

/// Of a solid its volume over its largest face, of a surface its area over its longest side, both as the
/// corners span them [length]: the least height of a box, also of one that is sheared; half of it for
/// triangles, a third for tetrahedra. Negative of cells that are turned inside out, 0 of others than solids
/// and surfaces. `points`: of the cell's nodes, corners first.
double least_height(CellType type, std::span<const Eigen::Vector3d> points);

} // namespace rubato::cell
