// SPDX-License-Identifier: LGPL-3.0-or-later
/// One point: strains of the three kinds from H = ∂u/∂X, the first Piola stress P and A = ∂P/∂F from what the
/// law gives. Strains are formed from H, never from F − 1 or FᵀF − 1, which lose the digits of small strains.
///
/// Tensors of the plane have F_zz = 1 + H_zz: H_zz is 0 (plane strain, plane stress) or u_r/R (axisymmetric).
/// Tensors of second order as vectors: component iJ at i + 3 J.
#pragma once

#include "rubato/element/nonlinear.hpp"
#include "rubato/element/nonlinear/logarithm.hpp"
#include "rubato/element/nonlinear/voigt_tensor.hpp"

#include <Eigen/Core>

namespace rubato::element {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Moduli = Eigen::Matrix<double, 9, 9>; ///< ∂P_iJ/∂F_kL at (i + 3 J, k + 3 L)

inline Vector9 as_vector(const Eigen::Matrix3d& tensor) {
  return Eigen::Map<const Vector9>(tensor.data());
}

/// J − 1 of F = 1 + H, from the invariants of H.
double volume_change(const Eigen::Matrix3d& h);

/// FᵀF − 1 = H + Hᵀ + HᵀH.
inline Eigen::Matrix3d green_lagrange_doubled(const Eigen::Matrix3d& h) {
  Eigen::Matrix3d doubled;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i <= j; ++i)
      doubled(i, j) = doubled(j, i) =
          h(i, j) + h(j, i) + (h(0, i) * h(0, j) + h(1, i) * h(1, j) + h(2, i) * h(2, j));
  return doubled;
}

/// F S, F = 1 + H.
inline Eigen::Matrix3d piola_of(const Eigen::Matrix3d& h, const Eigen::Matrix3d& s) {
  Eigen::Matrix3d piola;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      piola(i, j) = s(i, j) + (h(i, 0) * s(0, j) + h(i, 1) * s(1, j) + h(i, 2) * s(2, j));
  return piola;
}

/// What a point needs to know of its H; `logarithm` has a meaning for logarithmic strain only.
struct Deformation {
  Eigen::Matrix3d h;
  Logarithm logarithm;
};

/// The strain of deformation.h, engineering shears; sets `logarithm`.
material::Strain6 strain_of(StrainKind kind, Deformation& deformation);

/// P: σ, F S, or F S of S = 2 T:∂E/∂C.
Eigen::Matrix3d first_piola(StrainKind kind, const Deformation& deformation, const material::Stress6& stress);

/// F = 1 + H.
inline Eigen::Matrix3d gradient_of(const Eigen::Matrix3d& h) {
  Eigen::Matrix3d f = h;
  for (int i = 0; i < 3; ++i)
    f(i, i) += 1;
  return f;
}

/// B(F)ᵀ C B(F') with B = ∂E/∂F of Green–Lagrange's strain: dE_MN = sym F_kM dF_kN, engineering shears.
void set_moduli_between(const Eigen::Matrix3d& f, const material::Tangent6& c, const Eigen::Matrix3d& other,
                        Moduli& moduli);

/// moduli += δ_ik S_JL.
void add_stress_part(const Eigen::Matrix3d& s, Moduli& moduli);

/// A of a symmetric tangent; Green–Lagrange: A_iJkL = F_iM C_MJLN F_kN + δ_ik S_JL.
void first_moduli(StrainKind kind, const Deformation& deformation, const material::Response& response,
                  Moduli& moduli);

/// σ = P Fᵀ/J; small strain: P.
material::Stress6 cauchy_stress(StrainKind kind, const Eigen::Matrix3d& h, const Eigen::Matrix3d& piola);

} // namespace rubato::element
