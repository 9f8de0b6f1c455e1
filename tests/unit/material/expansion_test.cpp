// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/expansion.hpp"
#include "rubato/study/study.hpp"
#include "rubato/study/temperature.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rubato::material::expansion_test {
namespace {

using study::Physics;

study::Material wood() {
  study::Material material;
  material.law = study::LawKind::orthotropic;
  auto& o = material.orthotropy;
  o.young_x = 11600, o.young_y = 900, o.young_z = 500;
  o.poisson_xy = 0.37, o.poisson_yz = 0.43, o.poisson_xz = 0.47;
  o.shear_xy = 750, o.shear_yz = 39, o.shear_xz = 720;
  o.angle_z = 25;
  material.expansion = study::ThermalExpansion{{3e-6, 4e-5, 7e-5}, 20};
  return material;
}

study::Material metal() {
  study::Material material;
  material.young = 2e5;
  material.poisson = 0.3;
  material.expansion = study::ThermalExpansion{{1e-5, 1e-5, 1e-5}, 0};
  return material;
}

Voigt some_strain(Physics physics) {
  Voigt strain(strain_size(physics));
  for (Eigen::Index i = 0; i < strain.size(); ++i)
    strain[i] = 1e-3 * (1 + 0.3 * static_cast<double>(i * i));
  return strain;
}

/// The strain of the physics among all six with engineering shears, as far as it is known.
Voigt all_six(const FullStrain& tensor) {
  Voigt strain = tensor;
  strain.tail(3) *= 2;
  return strain;
}

class Expanding : public testing::TestWithParam<study::Material> {
protected:
  Law law_ = make_law(GetParam());
  study::ThermalExpansion expansion_ = *GetParam().expansion;
  FullExpansion strain_ = expansion_strain(law_, expansion_);
  static constexpr double degrees_ = 60;
};

/// Whatever the physics, stresses and strains together fulfil the law in space.
TEST_P(Expanding, FulfilsTheLawInSpace) {
  for (const auto physics :
       {Physics::solid, Physics::axisymmetric, Physics::plane_stress, Physics::plane_strain}) {
    const auto strain = some_strain(physics);
    const auto full = heated_stress(law_, physics, strain, expansion_, degrees_);
    const auto tensor = heated_strain(law_, physics, strain, expansion_, degrees_);
    const Voigt expected = stress(law_, Physics::solid, all_six(tensor) - degrees_ * strain_);
    EXPECT_LE((full - expected).lpNorm<Eigen::Infinity>(), 1e-12 * expected.lpNorm<Eigen::Infinity>());
    if (physics == Physics::plane_stress) {
      EXPECT_EQ(full[2], 0);
    }
    if (physics == Physics::plane_strain) {
      EXPECT_EQ(tensor[2], 0);
    }
  }
}

/// The stresses of the physics are D (ε − e ϑ), the energy ½ (ε − e ϑ)·D (ε − e ϑ) and what is held along z.
TEST_P(Expanding, HasTheEnergyOfTheLawInSpace) {
  for (const auto physics :
       {Physics::solid, Physics::axisymmetric, Physics::plane_stress, Physics::plane_strain}) {
    const auto strain = some_strain(physics);
    const auto free = free_strain(law_, physics, expansion_);
    const Voigt sigma = stress(law_, physics, strain);
    const double energy_of_terms = 0.5 * strain.dot(sigma) - degrees_ * free.dot(sigma) +
                                   0.5 * degrees_ * degrees_ * held_energy(law_, physics, expansion_);
    const auto tensor = heated_strain(law_, physics, strain, expansion_, degrees_);
    const Voigt elastic = all_six(tensor) - degrees_ * strain_;
    EXPECT_NEAR(energy_of_terms, energy(law_, Physics::solid, elastic), 1e-12 * energy_of_terms);
  }
}

TEST_P(Expanding, IsWithoutStressWhereItIsFree) {
  for (const auto physics : {Physics::solid, Physics::axisymmetric, Physics::plane_stress}) {
    const Voigt strain = degrees_ * free_strain(law_, physics, expansion_);
    const double scale = modulus_along_z(law_) * degrees_ * strain_.lpNorm<Eigen::Infinity>();
    EXPECT_LE(heated_stress(law_, physics, strain, expansion_, degrees_).lpNorm<Eigen::Infinity>(),
              1e-13 * scale);
  }
}

INSTANTIATE_TEST_SUITE_P(Expansion, Expanding, testing::Values(metal(), wood()),
                         [](const auto& info) { return info.index == 0 ? "Metal" : "Wood"; });

TEST(Expansion, IsThatOfAMetalHeldAlongZ) {
  const auto law = make_law(metal());
  const auto free = free_strain(law, Physics::plane_strain, *metal().expansion);
  EXPECT_NEAR(free[0], 1.3e-5, 1e-18);
  EXPECT_NEAR(free[1], 1.3e-5, 1e-18);
  EXPECT_EQ(free[2], 0);
}

} // namespace
} // namespace rubato::material::expansion_test
