// SPDX-License-Identifier: LGPL-3.0-or-later
/// Material laws: energy, stress and tangent from a strain; nothing about meshes.
///
/// Strains and stresses are Voigt vectors as voigt.hpp orders them. Units are the user's own: moduli, stress
/// and energy per volume share one. A new law is a file with a type that has a `density` and the functions
/// below, and its row in `Law` and in make_law.
#pragma once

#include "rubato/material/linear_elastic.hpp"
#include "rubato/material/orthotropic.hpp"
#include "rubato/material/voigt.hpp"

#include <optional>
#include <string>
#include <variant>

namespace rubato::study {
struct Material;
} // namespace rubato::study

namespace rubato::material {

using Law = std::variant<LinearElastic, Orthotropic>;

/// The law of a material that keeps the study's rules (study/validate.hpp); of a nonlinear one
/// (point_law.hpp) what it is at small strains that come at once.
Law make_law(const study::Material& material);

/// [mass/volume]; 0 when no inertia is asked for.
double density(const Law& law);

/// How many numbers the law remembers of a point's past.
int state_size(const Law& law);

/// Lamé's constants of the physics where the tangent is isotropic and constant; nothing where it is not.
std::optional<Lame> isotropic(const Law& law, study::Physics physics);

/// ½ ε·σ per volume. `strain` has strain_size(physics) components, here and below.
double energy(const Law& law, study::Physics physics, const Voigt& strain);

Voigt stress(const Law& law, study::Physics physics, const Voigt& strain);

/// ∂σ/∂ε, symmetric positive definite.
Tangent tangent(const Law& law, study::Physics physics);

/// All six stresses from those of the physics: σ_zz follows from ε_zz = 0 in plane strain, what else the
/// physics leaves out is 0.
FullStress full_stress(const Law& law, study::Physics physics, const Voigt& stress);

/// All six strains as a tensor, ε_xy = γ_xy/2. In plane stress ε_zz follows from σ_zz = 0.
FullStrain full_strain(const Law& law, study::Physics physics, const Voigt& strain);

/// x', y', z' of the law in its columns, in the axes of the model.
Eigen::Matrix3d own_axes(const Law& law);

/// 1/S_zz: stress along z by the strain there where nothing else is stressed [stress].
double modulus_along_z(const Law& law);

/// The law's numbers, for messages: "young 2e+11, poisson 0.3, density 7800".
std::string described(const Law& law);

} // namespace rubato::material
