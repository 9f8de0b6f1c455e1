// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: the stiffness of an isotropic law, blocks i ≤ j only and two nodes i at once
/// (formulas: element.cpp). That of HEXA8 in space is made of its modes (hexa8_stiffness.cpp).
#pragma once

#include "rubato/element/element.hpp"

namespace rubato::element {

/// Sets `k`.
void isotropic_stiffness(CellType type, std::span<const Eigen::Vector3d> points, const material::Lame& lame,
                         const Section& section, Eigen::Ref<Eigen::MatrixXd> k);

} // namespace rubato::element
