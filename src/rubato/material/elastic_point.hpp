// SPDX-License-Identifier: LGPL-3.0-or-later
/// Linear elasticity, isotropic or not: σ = D ε. Functions as point_law.hpp describes them.
///
/// With Green–Lagrange's E it is the law of St Venant and Kirchhoff, with ½ ln C that of Hencky. Code_Aster:
/// ELAS, ELAS_ORTH; Abaqus: *ELASTIC.
#pragma once

#include "rubato/material/linear_elastic.hpp"
#include "rubato/material/orthotropic.hpp"
#include "rubato/material/point_response.hpp"

namespace rubato::material {

struct ElasticPoint {
  static constexpr bool has_memory = false;
  static constexpr bool is_hyperelastic = false;
  Tangent6 stiffness; ///< D, symmetric [stress]
};

ElasticPoint make_elastic_point(double young, double poisson);
ElasticPoint make_elastic_point(const Orthotropic& law);

bool respond(const ElasticPoint& law, const Strain6& strain, std::span<const double> old,
             std::span<double> now, const StepInfo& step, Want want, Response& out);

} // namespace rubato::material
