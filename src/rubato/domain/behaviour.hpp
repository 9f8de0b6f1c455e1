// SPDX-License-Identifier: LGPL-3.0-or-later
/// How the cells of a law are evaluated.
#pragma once

#include "rubato/element/nonlinear.hpp"
#include "rubato/material/expansion.hpp"
#include "rubato/material/point_law.hpp"

#include <optional>

namespace rubato::domain {

/// How cells are evaluated whose forces are not ∫ Bᵀ D B u of all their points.
struct Behaviour {
  material::PointLaw law;
  element::StrainKind strain = element::StrainKind::small;
  element::Formulation formulation = element::Formulation::full; ///< full of cells that it is not offered for
  bool constant = false;                                 ///< whether one stiffness holds for every motion
  std::optional<material::FullExpansion> expansion = {}; ///< by temperature, in the axes of the model
};

struct Bulk;

/// The kind of a cell of `type` with this behaviour.
element::CellKind kind_of(const Bulk& bulk, const Behaviour& behaviour, CellType type);

} // namespace rubato::domain
