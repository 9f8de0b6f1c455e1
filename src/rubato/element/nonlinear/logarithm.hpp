// SPDX-License-Identifier: LGPL-3.0-or-later
/// E = ½ ln C and its derivatives: C. Miehe, N. Apel, M. Lambrecht, Anisotropic additive plasticity in the
/// logarithmic strain space, CMAME 191 (2002) 5383–5425. With C = Σ λ_a n_a⊗n_a, components in this basis,
/// e(λ) = ½ ln λ, e[.,.] and e[.,.,.] its divided differences:
///
///   E = Σ e(λ_a) n_a⊗n_a       dE_ab = e[λ_a,λ_b] dC_ab       S_ab = 2 e[λ_a,λ_b] T_ab
///   dS = 𝐂:½dC,  𝐂 = 4 (L:D:L + Γ),  L = ∂E/∂C,  D = ∂T/∂E
///   H:Γ:H' = Σ_abc T_ab e[λ_a,λ_c,λ_b] (H_ac H'_cb + H'_ac H_cb)
///
/// Equal eigenvalues are no case of their own: divided differences of close numbers are sums of series.
#pragma once

#include "rubato/material/point_response.hpp"

#include <Eigen/Core>

namespace rubato::element {

struct Logarithm {
  Eigen::Vector3d excess;  ///< μ_a = λ_a − 1, of H + Hᵀ + HᵀH
  Eigen::Matrix3d axes;    ///< n_a in column a
  Eigen::Vector3d strains; ///< e(λ_a)
};

/// Of μ = C − 1, symmetric, eigenvalues > −1 (else strains are no numbers).
Logarithm logarithm_of(const Eigen::Matrix3d& c_less_one);

/// E as a Voigt vector with engineering shears.
material::Strain6 strain_of(const Logarithm& logarithm);

/// S from T.
Eigen::Matrix3d second_piola(const Logarithm& logarithm, const material::Stress6& t);

/// 𝐂 = ∂S/∂E_GL in Voigt's order (engineering shears) from T and a symmetric D.
material::Tangent6 green_lagrange_tangent(const Logarithm& logarithm, const material::Response& response);

/// Divided differences of e = ½ ln at 1 + a, 1 + b (, 1 + c).
double first_difference(double a, double b);
double second_difference(double a, double b, double c);

} // namespace rubato::element
