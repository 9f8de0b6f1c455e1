// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/quadrature.hpp"
#include "rubato/element/element.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/dense.hpp"
#include <numbers>
#include <stdexcept>

namespace rubato::element::element_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using study::Physics;
using test::BulkCase;

const material::LinearElastic law{210., 0.3, 7.8};

class EveryElement : public testing::TestWithParam<BulkCase> {
protected:
  CellType type_ = GetParam().type;
  Section section_{GetParam().physics, 0.7};
  int d_ = component_count(GetParam().physics);
  int nodes_ = cell::topology(type_).node_count;
  std::vector<Eigen::Vector3d> points_ = test::bent_cell(type_);
  Eigen::Index rule_size_ = static_cast<Eigen::Index>(cell::stiffness_rule(type_).size());

  MatrixXd stiffness_matrix() const {
    MatrixXd k(nodes_ * d_, nodes_ * d_);
    stiffness(type_, points_, law, section_, k);
    return k;
  }
  MatrixXd mass_matrix() const {
    MatrixXd m(nodes_, nodes_);
    mass(type_, points_, law.density, section_, m);
    return m;
  }
  MatrixXd strains_of(const VectorXd& u) const {
    MatrixXd strain(material::strain_size(section_.physics), rule_size_);
    strains(type_, points_, section_.physics, {u.data(), static_cast<std::size_t>(u.size())}, strain);
    return strain;
  }
  /// The nodal values of the displacement a + H x.
  VectorXd linear_field(const Eigen::Vector3d& a, const Eigen::Matrix3d& h) const {
    VectorXd u(nodes_ * d_);
    for (int i = 0; i < nodes_; ++i)
      u.segment(i * d_, d_) = (a + h * points_[static_cast<std::size_t>(i)]).head(d_);
    return u;
  }
};

TEST_P(EveryElement, HasTheStiffnessOfTheStrainEnergyAtItsPoints) {
  VectorXd volume(rule_size_);
  point_volumes(type_, points_, section_, volume);
  const MatrixXd k = stiffness_matrix();
  std::srand(3);
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd u = VectorXd::Random(nodes_ * d_);
    const MatrixXd strain = strains_of(u);
    double energy = 0;
    for (Eigen::Index q = 0; q < rule_size_; ++q)
      energy += volume[q] * material::energy(law, section_.physics, strain.col(q));
    EXPECT_NEAR(0.5 * u.dot(k * u), energy, 1e-12 * energy);
  }
}

TEST_P(EveryElement, HasTheSameStiffnessFromTheTangentOfItsLaw) {
  const MatrixXd expected = stiffness_matrix();
  MatrixXd k(nodes_ * d_, nodes_ * d_);
  stiffness(type_, points_, material::tangent(law, section_.physics), section_, k);
  EXPECT_LT((k - expected).norm(), 1e-14 * expected.norm());
}

/// A symmetric tangent without any symmetry of the material: u·K u is twice the integral of ½ ε·D ε.
TEST_P(EveryElement, HasTheStiffnessOfAnySymmetricTangent) {
  std::srand(5);
  const int size = material::strain_size(section_.physics);
  const MatrixXd root = MatrixXd::Random(size, size);
  const material::Tangent tangent = root * root.transpose();
  MatrixXd k(nodes_ * d_, nodes_ * d_);
  stiffness(type_, points_, tangent, section_, k);
  VectorXd volume(rule_size_);
  point_volumes(type_, points_, section_, volume);
  const VectorXd u = VectorXd::Random(nodes_ * d_);
  const MatrixXd strain = strains_of(u);
  double twice = 0;
  for (Eigen::Index q = 0; q < rule_size_; ++q)
    twice += volume[q] * strain.col(q).dot(tangent * strain.col(q));
  EXPECT_NEAR(u.dot(k * u), twice, 1e-12 * twice);
  EXPECT_LT((k - k.transpose()).norm(), 1e-14 * k.norm());
}

TEST_P(EveryElement, HasTheStiffnessOfTheEnergyOfTangentsThatDifferAtItsPoints) {
  const auto size = material::strain_size(section_.physics);
  std::srand(11);
  std::vector<material::Tangent> tangents;
  for (Eigen::Index q = 0; q < rule_size_; ++q) {
    const MatrixXd any = MatrixXd::Random(size, size);
    tangents.emplace_back(any * any.transpose());
  }
  MatrixXd k(nodes_ * d_, nodes_ * d_);
  varying_stiffness(type_, points_, tangents, section_, k);
  EXPECT_EQ(k, k.transpose());
  VectorXd volume(rule_size_);
  point_volumes(type_, points_, section_, volume);
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd u = VectorXd::Random(nodes_ * d_);
    const MatrixXd strain = strains_of(u);
    double energy = 0;
    for (Eigen::Index q = 0; q < rule_size_; ++q)
      energy += 0.5 * volume[q] * strain.col(q).dot(tangents[static_cast<std::size_t>(q)] * strain.col(q));
    EXPECT_NEAR(0.5 * u.dot(k * u), energy, 1e-12 * energy);
  }
}

TEST_P(EveryElement, HasTheSameMatricesFromTangentsAndDensitiesThatAreAlike) {
  const MatrixXd expected = stiffness_matrix();
  const std::vector<material::Tangent> tangents(static_cast<std::size_t>(rule_size_),
                                                material::tangent(law, section_.physics));
  MatrixXd k(nodes_ * d_, nodes_ * d_);
  varying_stiffness(type_, points_, tangents, section_, k);
  EXPECT_LT((k - expected).norm(), 1e-14 * expected.norm());
  const std::vector<double> densities(cell::mass_rule(type_).size(), law.density);
  MatrixXd m(nodes_, nodes_);
  varying_mass(type_, points_, densities, section_, m);
  EXPECT_EQ(m, mass_matrix());
  VectorXd lumped(nodes_);
  VectorXd alike(nodes_);
  lumped_mass(type_, points_, law.density, section_, lumped);
  varying_lumped_mass(type_, points_, densities, section_, alike);
  EXPECT_EQ(alike, lumped);
}

TEST_P(EveryElement, HasASymmetricStiffnessWithOnlyRigidMotionsFree) {
  const MatrixXd k = stiffness_matrix();
  EXPECT_LT((k - k.transpose()).norm(), 1e-15 * k.norm());
  const VectorXd eigenvalues = test::symmetric_eigenvalues(k);
  const int rigid = section_.physics == Physics::axisymmetric ? 1 : d_ == 3 ? 6 : 3;
  const int free = static_cast<int>((eigenvalues.array().abs() < 1e-12 * eigenvalues.maxCoeff()).count());
  // One point sees four strains of six motions: beside the rigid one, one more stays free in a single cell.
  const int unseen = type_ == CellType::tria3 && section_.physics == Physics::axisymmetric ? 1 : 0;
  EXPECT_EQ(free, rigid + unseen);
  EXPECT_GT(eigenvalues.minCoeff(), -1e-12 * eigenvalues.maxCoeff());
}

TEST_P(EveryElement, FindsTheConstantStrainOfALinearField) {
  Eigen::Matrix3d h;
  h << 0.3, -0.2, 0.5, 0.7, 0.1, -0.4, 0.2, 0.6, -0.3;
  const bool ring = section_.physics == Physics::axisymmetric;
  if (ring)
    h.row(0) << 0.3, 0, 0;
  const Eigen::Vector3d a(ring ? 0. : 1., 2., 3.);
  const MatrixXd strain = strains_of(linear_field(a, h));
  VectorXd expected(strain.rows());
  if (d_ == 3)
    expected << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0);
  else if (ring)
    expected << h(0, 0), h(1, 1), h(0, 0), h(0, 1) + h(1, 0);
  else
    expected << h(0, 0), h(1, 1), h(0, 1) + h(1, 0);
  for (Eigen::Index q = 0; q < strain.cols(); ++q)
    EXPECT_LT((strain.col(q) - expected).norm(), 1e-13);
}

TEST_P(EveryElement, HasTheMassOfItsVolume) {
  const auto rule = cell::rule_of_degree(type_, 9);
  const auto& cell = cell::reference_cell(type_);
  std::vector<double> n(static_cast<std::size_t>(nodes_)),
      dn(static_cast<std::size_t>(nodes_ * cell.dimension));
  double expected = 0;
  for (const auto& [xi, weight] : rule) {
    cell.values(xi, n);
    cell.gradients(xi, dn);
    Eigen::Matrix3d j = Eigen::Matrix3d::Identity();
    j.topLeftCorner(d_, d_).setZero();
    double radius = 0;
    for (int i = 0; i < nodes_; ++i) {
      const auto& x = points_[static_cast<std::size_t>(i)];
      radius += n[static_cast<std::size_t>(i)] * x[0];
      for (int a = 0; a < d_; ++a)
        j.col(a).head(d_) += x.head(d_) * dn[static_cast<std::size_t>(i * d_ + a)];
    }
    const double depth = section_.physics == Physics::solid          ? 1.
                         : section_.physics == Physics::axisymmetric ? 2 * std::numbers::pi * radius
                                                                     : 0.7;
    expected += law.density * weight * j.determinant() * depth;
  }
  EXPECT_NEAR(mass_matrix().sum(), expected, 1e-3 * expected);
  VectorXd lumped(nodes_);
  lumped_mass(type_, points_, law.density, section_, lumped);
  EXPECT_NEAR(lumped.sum(), mass_matrix().sum(), 1e-13 * expected);
  EXPECT_GT(lumped.minCoeff(), 0.);
}

TEST_P(EveryElement, HasAPositiveDefiniteMass) {
  const MatrixXd m = mass_matrix();
  EXPECT_LT((m - m.transpose()).norm(), 1e-15 * m.norm());
  EXPECT_GT(test::symmetric_eigenvalues(m).minCoeff(), 0.);
}

TEST_P(EveryElement, KnowsWhenItIsInverted) {
  EXPECT_GT(worst_jacobian(type_, points_), 0.);
  for (auto& point : points_)
    point[1] = -point[1];
  EXPECT_LT(worst_jacobian(type_, points_), 0.);
}

TEST_P(EveryElement, SurvivesBeingFlat) {
  for (auto& point : points_)
    point[1] = 0;
  EXPECT_LE(worst_jacobian(type_, points_), 1e-15);
  EXPECT_NO_THROW(stiffness_matrix());
}

INSTANTIATE_TEST_SUITE_P(Elements, EveryElement, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& instance) { return test::name_of(instance.param); });

TEST(Elements, RefuseAPhysicsOfAnotherDimension) {
  MatrixXd k(24, 24);
  EXPECT_THROW(
      stiffness(CellType::hexa8, test::bent_cell(CellType::hexa8), law, {Physics::plane_stress, 1}, k),
      std::invalid_argument);
  EXPECT_THROW(worst_jacobian(CellType::seg2, {}), std::invalid_argument);
}

TEST(QuadrangleFourNode, HasTheTextbookStiffnessOfASquare) {
  // Unit square, plane stress: k_11 = (E/(1−ν²)) (1/2 − ν/6), the sum of stretching and shearing.
  const double e = 12, nu = 0.25;
  const std::vector<Eigen::Vector3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  MatrixXd k(8, 8);
  stiffness(CellType::quad4, square, material::LinearElastic{e, nu, 0}, {Physics::plane_stress, 2.}, k);
  EXPECT_NEAR(k(0, 0), 2 * e / (1 - nu * nu) * (0.5 - nu / 6), 1e-13);
  EXPECT_NEAR(k(0, 1), 2 * e / (1 - nu * nu) * (1 + nu) / 8, 1e-13);
}

} // namespace
} // namespace rubato::element::element_test
