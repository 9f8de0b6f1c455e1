// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a material is solved with where its study does not say.
#pragma once

#include "rubato/core/cell_type.hpp"
#include "rubato/study/study.hpp"

namespace rubato::study {

/// Whether the law is one of hyperelasticity.
bool is_hyperelastic(LawKind law);

/// Green–Lagrange of hyperelastic laws, else small.
StrainKind strain_of(const Material& material);

/// Whether stress is a constant matrix times the small strain.
bool has_constant_stiffness(const Material& material);

/// Whether bulk cells of that type have `mean_dilatation`: all but TRIA3 and TETRA4, whose volume has one
/// change in `full`, and pyramids, which fail the inf-sup condition with one; none in plane stress.
bool averages_dilatation(CellType type, Physics physics);

/// Returns whether `reduced` cells of the type have one point and forces against hourglasses, instead of a
/// rule of lower order.
bool has_one_point(CellType type);

/// What the study says; without a word mean_dilatation of plastic and hyperelastic laws, else full.
Formulation wanted_formulation(const Material& material);

/// The same where there is such a cell, else full.
Formulation formulation_of(const Material& material, Physics physics, CellType type);

/// Whether the material expands by temperatures that the study has.
bool is_heated(const Study& study, const Material& material);

/// Whether one stiffness of the cells of the material holds for every step: a constant one, no reduced cells,
/// whose hourglasses have an energy of their own, and no heat in cells that are not integrated in full; of
/// the study: whether that is so of all its materials.
bool is_linear(const Study& study, const Material& material);
bool is_linear(const Study& study);

/// Whether points or cells of the material remember their past; whether some material's do.
bool remembers(const Material& material);
bool remembers(const Study& study);

/// Whether some material flows plastically.
bool yields(const Study& study);

/// Whether some material takes large turns.
bool takes_large_rotations(const Study& study);

} // namespace rubato::study
