// SPDX-License-Identifier: LGPL-3.0-or-later
/// Thermal expansion of linear laws: σ = D (ε − e ϑ), ϑ = T − reference.
///
/// e is the strain per degree that stresses nothing. In plane strain, where ε_zz = 0 holds the expansion
/// along z, e has what this does in the plane, e_i = α_i − S_iz/S_zz α_z (isotropic: (1 + ν) α), and
/// σ_zz = −(S_zp σ_p + α_z ϑ)/S_zz. In plane stress ε_zz = S_zp σ_p + α_z ϑ.
#pragma once

#include "rubato/material/law.hpp"
#include "rubato/study/temperature.hpp"

namespace rubato::material {

/// Six strains per degree in the axes of the model, xx yy zz and engineering shears xy yz xz [1/temperature].
using FullExpansion = Eigen::Matrix<double, 6, 1>;

/// α along the axes of the law.
FullExpansion expansion_strain(const Law& law, const study::ThermalExpansion& expansion);

/// e, of strain_size(physics) [1/temperature].
Voigt free_strain(const Law& law, study::Physics physics, const study::ThermalExpansion& expansion);

/// Twice the energy per volume and degree² where nothing can expand: e·D e, in plane strain + α_z²/S_zz.
double held_energy(const Law& law, study::Physics physics, const study::ThermalExpansion& expansion);

/// All six stresses at a strain of the physics and ϑ degrees above the reference.
FullStress heated_stress(const Law& law, study::Physics physics, const Voigt& strain,
                         const study::ThermalExpansion& expansion, double degrees);

/// All six strains as a tensor, expansion included.
FullStrain heated_strain(const Law& law, study::Physics physics, const Voigt& strain,
                         const study::ThermalExpansion& expansion, double degrees);

} // namespace rubato::material
