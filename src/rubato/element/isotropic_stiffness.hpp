// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: the stiffness of an isotropic law for the cells that most meshes are made of, with
/// sizes known at compile time, blocks i ≤ j only and two nodes i at once (formulas: element.cpp). That of
/// HEXA8 in space is made of its modes (hexa8_stiffness.cpp).
#pragma once

#include "rubato/element/element.hpp"

namespace rubato::element {

/// Sets `k` and returns true, or returns false for a type without such a kernel.
bool isotropic_stiffness(CellType type, std::span<const Eigen::Vector3d> points, const material::Lame& lame,
                         const Section& section, Eigen::Ref<Eigen::MatrixXd> k);

} // namespace rubato::element
