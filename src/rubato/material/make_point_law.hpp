// SPDX-License-Identifier: LGPL-3.0-or-later
/// The law of a point that a material of the study asks for.
#pragma once

#include "rubato/material/point_law.hpp"
#include "rubato/study/study.hpp"

namespace rubato::material {

/// Young's modulus [stress] and Poisson's ratio of an isotropic law at small strains that come at once:
/// prony with all its terms, hyperelastic laws where nothing has deformed yet.
struct SmallStrainModuli {
  double young = 0;
  double poisson = 0;
};
SmallStrainModuli small_strain_moduli(const study::Material& material);

/// For a material that keeps the study's rules. In plane stress one whose stresses have zz = 0.
PointLaw make_point_law(const study::Material& material, study::Physics physics);

} // namespace rubato::material
