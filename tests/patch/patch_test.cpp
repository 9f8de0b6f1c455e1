// SPDX-License-Identifier: LGPL-3.0-or-later
/// The patch test (B. M. Irons): cells of any shape must carry a constant stress exactly.
#include "rubato/core/error.hpp"
#include "rubato/domain/assembly.hpp"
#include "rubato/domain/recovery.hpp"

#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/dirichlet.hpp"
#include "support/patch_mesh.hpp"
#include <numbers>

namespace rubato::patch_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using study::Physics;

const material::LinearElastic law{210., 0.3, 7.8};
constexpr double thickness = 0.7;

class EveryCell : public testing::TestWithParam<test::BulkCase> {
protected:
  Physics physics_ = GetParam().physics;
  int d_ = element::component_count(physics_);
  bool ring_ = physics_ == Physics::axisymmetric;
  mesh::Mesh mesh_ =
      test::patch_mesh(GetParam().type, 3, test::moved_by(test::shaken(d_, 3, 0.2), Vector3d(1, 0, 0)));
  domain::Bulk bulk_ = test::whole_bulk(mesh_, {physics_, thickness}, law);
  domain::DofMap dofs_ = domain::number_dofs(mesh_, bulk_.cells, d_);
  domain::BlockPattern pattern_{mesh_, bulk_.cells, dofs_};

  VectorXd linear_field(const Vector3d& a, const Matrix3d& h) const {
    VectorXd u(dofs_.dof_count);
    for (const auto node : dofs_.nodes)
      u.segment(dofs_.dof(node, 0), d_) = (a + h * mesh_.points[static_cast<std::size_t>(node)]).head(d_);
    return u;
  }

  /// A gradient whose stress is in equilibrium: any, but for a ring only radial and axial stretch.
  Matrix3d gradient() const {
    Matrix3d h;
    h << 3e-3, -2e-3, 5e-3, 7e-3, 1e-3, -4e-3, 2e-3, 6e-3, -3e-3;
    return ring_ ? Matrix3d(Vector3d(3e-3, 1e-3, 0).asDiagonal()) : h;
  }

  material::Voigt strain_of(const Matrix3d& h) const {
    material::Voigt strain(material::strain_size(physics_));
    if (d_ == 3)
      strain << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0);
    else if (ring_)
      strain << h(0, 0), h(1, 1), h(0, 0), h(0, 1) + h(1, 0);
    else
      strain << h(0, 0), h(1, 1), h(0, 1) + h(1, 0);
    return strain;
  }

  double volume() const { return d_ == 3 ? 1. : ring_ ? std::numbers::pi * (2. * 2. - 1. * 1.) : thickness; }
};

TEST_P(EveryCell, CarriesAConstantStressThroughADistortedPatch) {
  ASSERT_TRUE(domain::cell_faults(mesh_, bulk_.cells, physics_).empty());
  const auto outer = test::boundary_nodes(mesh_);
  ASSERT_GT(std::ranges::count(outer, false), 0);
  std::vector<bool> given(static_cast<std::size_t>(dofs_.dof_count));
  for (const auto node : dofs_.nodes)
    for (int a = 0; a < d_; ++a)
      given[static_cast<std::size_t>(dofs_.dof(node, a))] = outer[static_cast<std::size_t>(node)];

  const Vector3d shift(ring_ ? 0. : 0.01, 0.02, 0.03);
  const VectorXd exact = linear_field(shift, gradient());
  VectorXd u = exact;
  test::solve_with_given(domain::assemble_stiffness(mesh_, bulk_, pattern_), VectorXd::Zero(u.size()), given,
                         u);
  EXPECT_LT((u - exact).lpNorm<Eigen::Infinity>(), 1e-12 * exact.lpNorm<Eigen::Infinity>());

  const auto expected =
      material::full_stress(law, physics_, material::stress(law, physics_, strain_of(gradient())));
  const auto nodal = domain::nodal_stress(mesh_, bulk_, dofs_, u);
  for (const auto node : dofs_.nodes) {
    EXPECT_LT((nodal.stress.col(node) - expected).norm(), 1e-12 * expected.norm());
    EXPECT_NEAR(nodal.von_mises[node], material::von_mises(expected), 1e-12 * expected.norm());
  }
}

/// In a ring the constant stress is in equilibrium only where radius and hoop are alike.
study::Orthotropy timber(bool ring, bool solid) {
  study::Orthotropy o;
  o.young_x = 116, o.young_y = 9, o.young_z = ring ? 116. : 5.;
  o.poisson_xy = 0.37, o.poisson_xz = 0.3, o.poisson_yz = ring ? 0.37 * 9 / 116 : 0.43;
  o.shear_xy = 7.5, o.shear_yz = 0.39, o.shear_xz = 7.2;
  if (!ring)
    o.angle_z = 25;
  if (solid)
    o.angle_y = -40, o.angle_x = 65;
  return o;
}

TEST_P(EveryCell, CarriesAConstantStressOfAnOrthotropicLaw) {
  const auto timber_law = material::make_orthotropic(timber(ring_, d_ == 3), 1);
  const auto bulk = test::whole_bulk(mesh_, {physics_, thickness}, timber_law);
  const auto outer = test::boundary_nodes(mesh_);
  std::vector<bool> given(static_cast<std::size_t>(dofs_.dof_count));
  for (const auto node : dofs_.nodes)
    for (int a = 0; a < d_; ++a)
      given[static_cast<std::size_t>(dofs_.dof(node, a))] = outer[static_cast<std::size_t>(node)];
  const VectorXd exact = linear_field(Vector3d(ring_ ? 0. : 0.01, 0.02, 0.03), gradient());
  VectorXd u = exact;
  const auto k = domain::assemble_stiffness(mesh_, bulk, pattern_);
  test::solve_with_given(k, VectorXd::Zero(u.size()), given, u);
  EXPECT_LT((u - exact).lpNorm<Eigen::Infinity>(), 1e-11 * exact.lpNorm<Eigen::Infinity>());

  const auto strain = strain_of(gradient());
  const auto expected =
      material::full_stress(timber_law, physics_, material::stress(timber_law, physics_, strain));
  const auto nodal = domain::nodal_stress(mesh_, bulk, dofs_, exact);
  for (const auto node : dofs_.nodes)
    EXPECT_LT((nodal.stress.col(node) - expected).norm(), 1e-12 * expected.norm());
  const double energy = material::energy(timber_law, physics_, strain);
  const VectorXd stretch = linear_field(Vector3d::Zero(), gradient());
  EXPECT_NEAR(0.5 * stretch.dot(k * stretch), volume() * energy, 1e-12 * volume() * energy);
}

TEST_P(EveryCell, HasTheIsotropicStiffnessFromIsotropicNumbersAtAnyAngle) {
  study::Orthotropy o;
  const double shear = law.young / (2 * (1 + law.poisson));
  o.young_x = o.young_y = law.young, o.young_z = law.young;
  o.poisson_xy = law.poisson, o.poisson_yz = law.poisson, o.poisson_xz = law.poisson;
  o.shear_xy = shear, o.shear_yz = shear, o.shear_xz = shear;
  o.angle_z = 33;
  const auto bulk = test::whole_bulk(mesh_, {physics_, thickness}, material::make_orthotropic(o, 1));
  const auto expected = domain::assemble_stiffness(mesh_, bulk_, pattern_);
  const domain::SparseMatrix difference = domain::assemble_stiffness(mesh_, bulk, pattern_) - expected;
  EXPECT_LT(difference.norm(), 1e-12 * expected.norm());
}

TEST_P(EveryCell, FeelsNoForceInARigidMotion) {
  Matrix3d turn;
  turn << 0, -0.3, 0.2, 0.3, 0, -0.5, -0.2, 0.5, 0;
  const auto k = domain::assemble_stiffness(mesh_, bulk_, pattern_);
  const VectorXd u = ring_ ? linear_field({0, 1, 0}, Matrix3d::Zero()) : linear_field({1, 2, 3}, turn);
  EXPECT_LT((k * u).lpNorm<Eigen::Infinity>(), 1e-13 * law.young * u.lpNorm<Eigen::Infinity>());
}

TEST_P(EveryCell, HoldsTheEnergyOfAConstantStrain) {
  const auto k = domain::assemble_stiffness(mesh_, bulk_, pattern_);
  const VectorXd u = linear_field(Vector3d::Zero(), gradient());
  const double expected = volume() * material::energy(law, physics_, strain_of(gradient()));
  EXPECT_NEAR(0.5 * u.dot(k * u), expected, 1e-12 * expected);
}

TEST_P(EveryCell, WeighsItsVolumeInEveryDirection) {
  const auto m = domain::assemble_mass(mesh_, bulk_, pattern_);
  const VectorXd lumped = domain::lumped_mass(mesh_, bulk_, dofs_);
  const double expected = law.density * volume();
  for (int a = 0; a < d_; ++a) {
    const VectorXd along = linear_field(Vector3d::Unit(a), Matrix3d::Zero());
    EXPECT_NEAR(along.dot(m * along), expected, 1e-12 * expected);
    EXPECT_NEAR(lumped.dot(along), expected, 1e-12 * expected);
  }
  EXPECT_GT(lumped.minCoeff(), 0.);
}

INSTANTIATE_TEST_SUITE_P(Patch, EveryCell, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& instance) { return test::name_of(instance.param); });

} // namespace
} // namespace rubato::patch_test
