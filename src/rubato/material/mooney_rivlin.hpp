// SPDX-License-Identifier: LGPL-3.0-or-later
/// W = c10 (Ī₁ − 3) + c01 (Ī₂ − 3) + V(J) (Mooney 1940, Rivlin 1948); c01 = 0: neo-Hookean. μ = 2 (c10 +
/// c01). Functions as point_law.hpp describes them; the strain is Green–Lagrange's. Code_Aster: ELAS_HYPER
/// (C10, C01, K, with Volumetric::quadratic); Abaqus: *HYPERELASTIC, MOONEY-RIVLIN and NEO HOOKE.
#pragma once

#include "rubato/material/point_response.hpp"
#include "rubato/material/volumetric.hpp"

namespace rubato::material {

struct MooneyRivlin {
  static constexpr bool has_memory = false;
  static constexpr bool is_hyperelastic = true;
  double c10 = 0;  ///< [stress]
  double c01 = 0;  ///< [stress]; c10 + c01 > 0
  double bulk = 0; ///< K > 0 [stress]
  Volumetric volumetric = Volumetric::logarithmic;
};

bool respond(const MooneyRivlin& law, const Strain6& strain, std::span<const double> old,
             std::span<double> now, const StepInfo& step, Want want, Response& out);

} // namespace rubato::material
