// SPDX-License-Identifier: LGPL-3.0-or-later
/// W = c10 (Ī₁ − 3) + c20 (Ī₁ − 3)² + c30 (Ī₁ − 3)³ + V(J) (Yeoh 1993, Rubber Chem. Technol. 66). μ = 2 c10.
/// Functions as point_law.hpp describes them; the strain is Green–Lagrange's. Code_Aster: ELAS_HYPER with C20
/// (it has no C30), with Volumetric::quadratic; Abaqus: *HYPERELASTIC, YEOH.
#pragma once

#include "rubato/material/point_response.hpp"
#include "rubato/material/volumetric.hpp"

namespace rubato::material {

struct Yeoh {
  static constexpr bool has_memory = false;
  static constexpr bool is_hyperelastic = true;
  double c10 = 0;  ///< > 0 [stress]
  double c20 = 0;  ///< [stress], often negative
  double c30 = 0;  ///< ≥ 0 [stress]
  double bulk = 0; ///< K > 0 [stress]
  Volumetric volumetric = Volumetric::logarithmic;
};

bool respond(const Yeoh& law, const Strain6& strain, std::span<const double> old, std::span<double> now,
             const StepInfo& step, Want want, Response& out);

} // namespace rubato::material
