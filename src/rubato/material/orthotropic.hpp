// SPDX-License-Identifier: LGPL-3.0-or-later
/// Orthotropic linear elasticity with axes x', y', z' of its own. Functions as law.hpp describes them.
///
/// In these axes, ν_xy the contraction along y' under a stress along x' (ν_xy = −ε_yy/ε_xx; Code_Aster's
/// NU_LT, ν_yx = ν_xy E_y/E_x),
///   ε_xx =   σ_xx/E_x      − ν_xy σ_yy/E_x − ν_xz σ_zz/E_x      γ_xy = σ_xy/G_xy
///   ε_yy = − ν_xy σ_xx/E_x + σ_yy/E_y      − ν_yz σ_zz/E_y      γ_yz = σ_yz/G_yz
///   ε_zz = − ν_xz σ_xx/E_x − ν_yz σ_yy/E_y + σ_zz/E_z           γ_xz = σ_xz/G_xz
/// The axes are the model's, turned by angle_z about z, then by angle_y about the new y, then by angle_x
/// about the new x, each positive by the right-hand rule: e' = R_z R_y R_x e, Code_Aster's nautical angles α,
/// β, γ (ANGL_REP; its matrix is Rᵀ). In plane and axisymmetric physics z' is z, the hoop when axisymmetric.
#pragma once

#include "rubato/material/linear_elastic.hpp"
#include "rubato/study/study.hpp"

namespace rubato::material {

/// Strains and stresses here are all six, in the axes of the model.
struct Orthotropic {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  study::Orthotropy numbers;
  double density = 0;   ///< [mass/volume]
  Eigen::Matrix3d axes; ///< x', y', z' in its columns
  Matrix6 compliance;   ///< ε = S σ [1/stress]
  Matrix6 stiffness;    ///< σ = S⁻¹ ε [stress]
};

/// The numbers are valid (study/validate.hpp). Those that may be left out as they have no effect in the
/// physics are taken as if the material were alike along z' and x', without ν.
Orthotropic make_orthotropic(const study::Orthotropy& numbers, double density);

/// The same with axes that are turned before the angles turn them: e' = `first` R e.
Orthotropic make_orthotropic(const study::Orthotropy& numbers, double density, const Eigen::Matrix3d& first);

/// R, the columns of which are x', y', z' in the axes of the model.
Eigen::Matrix3d axes_of(const study::Orthotropy& numbers);

constexpr int state_size(const Orthotropic&) {
  return 0;
}
inline std::optional<Lame> isotropic(const Orthotropic&, study::Physics) {
  return std::nullopt;
}
double energy(const Orthotropic& law, study::Physics physics, const Voigt& strain);
Voigt stress(const Orthotropic& law, study::Physics physics, const Voigt& strain);

/// Plane stress: the inverse of the compliance's rows xx yy xy; else the rows of the physics of the
/// stiffness.
Tangent tangent(const Orthotropic& law, study::Physics physics);

/// In plane strain σ_zz keeps ε_zz = 0: σ_zz = −(S_zx σ_xx + S_zy σ_yy + S_zs σ_xy)/S_zz.
FullStress full_stress(const Orthotropic& law, study::Physics physics, const Voigt& stress);

/// In plane stress ε_zz is that of the stresses; ν_xz and ν_yz count as 0 when they are left out.
FullStrain full_strain(const Orthotropic& law, study::Physics physics, const Voigt& strain);

inline Eigen::Matrix3d own_axes(const Orthotropic& law) {
  return law.axes;
}
inline double modulus_along_z(const Orthotropic& law) {
  return 1 / law.compliance(2, 2);
}

std::string described(const Orthotropic& law);

} // namespace rubato::material
