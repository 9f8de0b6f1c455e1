// SPDX-License-Identifier: LGPL-3.0-or-later
/// The domain's answers against each other, differences and integrals over cells.
#include "rubato/cell/quadrature.hpp"
#include "rubato/domain/assembly.hpp"
#include "rubato/domain/block_pattern.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/domain/linear_domain.hpp"
#include "rubato/domain/nonlinear_domain.hpp"
#include "rubato/element/element.hpp"

#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/patch_mesh.hpp"
#include <cmath>

namespace rubato::domain::domain_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const material::LinearElastic law{70., 0.3, 2.};

/// Two cells a direction, thrown about, off the axis; a spring on its first dof.
class AnyDomain : public testing::TestWithParam<test::BulkCase> {
protected:
  static constexpr double spring = 5;

  int dimension_ = element::component_count(GetParam().physics);
  mesh::Mesh mesh_ = test::patch_mesh(
      GetParam().type, 2, test::moved_by(test::shaken(dimension_, 2, 0.1), Eigen::Vector3d(1, 0, 0)));
  Bulk bulk_ = test::whole_bulk(mesh_, {GetParam().physics, 0.5}, law);
  DofMap dofs_ = number_dofs(mesh_, bulk_.cells, dimension_);
  Domain domain_ = make_domain();
  QuadratureStates states_ = domain_.initial_states();

  Domain make_domain() const {
    auto stiffness = assemble_stiffness(mesh_, bulk_, BlockPattern(mesh_, bulk_.cells, dofs_));
    stiffness.coeffRef(0, 0) += spring;
    return {LinearDomain(std::move(stiffness), dofs_.components), initial_states(mesh_, bulk_)};
  }

  VectorXd displacement(double phase) const {
    VectorXd u(dofs_.dof_count);
    for (Index i = 0; i < u.size(); ++i)
      u[i] = 0.01 * std::sin(2.0 * static_cast<double>(i) + phase);
    return u;
  }

  VectorXd forces(const VectorXd& u) const {
    VectorXd answer;
    QuadratureStates now;
    domain_.evaluate({u, u}, states_, now, {.forces = &answer});
    return answer;
  }

  double energy(const VectorXd& u) const { return domain_.energy(u, forces(u), 0, states_); }

  /// Σ w ψ(ε) over the points of all cells.
  double integral_of_energy(const VectorXd& u) const {
    double sum = 0.5 * spring * u[0] * u[0];
    for (const auto cell : bulk_.cells) {
      const auto nodes = mesh_.nodes_of(cell);
      const auto count = static_cast<Index>(cell::stiffness_rule(mesh_.type_of(cell)).size());
      std::vector<double> local;
      for (const auto node : nodes)
        for (int i = 0; i < dofs_.components; ++i)
          local.push_back(u[dofs_.dof(node, i)]);
      MatrixXd strain(material::strain_size(GetParam().physics), count);
      VectorXd volume(count);
      element::strains(mesh_.type_of(cell), CellPoints(mesh_, nodes), GetParam().physics, local, strain);
      element::point_volumes(mesh_.type_of(cell), CellPoints(mesh_, nodes), bulk_.section, volume);
      for (Index q = 0; q < count; ++q)
        sum += volume[q] * material::energy(law, GetParam().physics, strain.col(q));
    }
    return sum;
  }
};

TEST_P(AnyDomain, HasTheTangentThatDifferencesOfItsForcesGive) {
  const VectorXd u = displacement(1);
  SparseMatrix tangent;
  QuadratureStates now;
  domain_.evaluate({u, u}, states_, now, {.tangent = &tangent});
  constexpr double delta = 1e-4;
  const MatrixXd dense = tangent;
  for (Index dof = 0; dof < u.size(); ++dof) {
    const VectorXd side = delta * VectorXd::Unit(u.size(), dof);
    const VectorXd slope = (forces(u + side) - forces(u - side)) / (2 * delta);
    EXPECT_LE((slope - dense.col(dof)).norm(), 1e-9 * dense.norm()) << dof;
  }
}

TEST_P(AnyDomain, HasTheForcesThatDifferencesOfItsEnergyGive) {
  const VectorXd u = displacement(1);
  const VectorXd f = forces(u);
  constexpr double delta = 1e-4;
  for (Index dof = 0; dof < u.size(); ++dof) {
    const VectorXd side = delta * VectorXd::Unit(u.size(), dof);
    EXPECT_NEAR((energy(u + side) - energy(u - side)) / (2 * delta), f[dof], 1e-9 * f.norm()) << dof;
  }
}

TEST_P(AnyDomain, StoresTheIntegralOfTheLawsEnergy) {
  const VectorXd u = displacement(2);
  EXPECT_GT(energy(u), 0);
  EXPECT_NEAR(energy(u), integral_of_energy(u), 1e-13 * energy(u));
}

/// What a step carries along need not be computed again.
TEST_P(AnyDomain, RepeatsKnownForcesOnlyWhereNothingMoves) {
  const VectorXd u0 = displacement(1);
  const VectorXd u1 = displacement(2);
  const VectorXd known = VectorXd::Constant(u0.size(), 7);
  VectorXd answer;
  QuadratureStates now;
  domain_.evaluate({u0, u1, 0, 1, &known}, states_, now, {.forces = &answer});
  EXPECT_EQ(answer, forces(u1));
  domain_.evaluate({u0, u0, 0, 1, &known}, states_, now, {.forces = &answer});
  EXPECT_EQ(answer, known);
}

TEST_P(AnyDomain, IsLinearAndRemembersNothingWhenElastic) {
  EXPECT_TRUE(domain_.is_linear());
  EXPECT_TRUE(domain_.initial_states().values.empty());
  const VectorXd u = displacement(3);
  EXPECT_LE((forces(u) - domain_.initial_tangent() * u).norm(), 1e-14 * domain_.initial_tangent().norm());
  SparseMatrix tangent;
  QuadratureStates now{{1, 2}};
  domain_.evaluate({u, u}, states_, now, {.tangent = &tangent});
  EXPECT_EQ(MatrixXd(tangent), MatrixXd(domain_.initial_tangent()));
  EXPECT_EQ(now, states_);
}

INSTANTIATE_TEST_SUITE_P(Cells, AnyDomain, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& tested) { return test::name_of(tested.param); });

} // namespace
} // namespace rubato::domain::domain_test
