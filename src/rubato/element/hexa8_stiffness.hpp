// SPDX-License-Identifier: LGPL-3.0-or-later
/// The stiffness of HEXA8 with an isotropic law in space, 2×2×2 points, of two cells at once: one number of
/// each of them is one SSE2 register.
#pragma once

#include "rubato/material/law.hpp"

#include <Eigen/Core>

#include <array>
#include <span>

namespace rubato::element {

struct Hexa8Stiffness {
  std::span<const Eigen::Vector3d> points;
  material::Lame lame;
  Eigen::MatrixXd& k; ///< becomes 24 × 24
};

/// Sets `k` of both to ∫ Bᵀ D B as element.hpp has it, symmetric to the last digit. What a cell gets does not
/// depend on the other one, which may be the same.
void set_hexa8_stiffness(const std::array<Hexa8Stiffness, 2>& cells);

} // namespace rubato::element
