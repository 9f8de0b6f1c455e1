// SPDX-License-Identifier: LGPL-3.0-or-later
// Forces of a whole step, of all cells and springs together: their tangents, and what they are of linear
// parts.
#include "rubato/domain/domain.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/bulk_laws.hpp"
#include "support/model_of.hpp"
#include "unit/step/any_state.hpp"
#include <string>
#include <vector>

namespace rubato::step::forces_of_step_test {
namespace {

using domain::ForcesOf;
using domain::TangentOf;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Strains of a few hundredths.
constexpr double small_motion = 0.004;

/// A nonlinear body on springs, beside a linear one that it shares nodes with.
const std::vector<deck::Setting> beside_linear{
    {"time", "{scheme: energy_momentum, step: 0.5, end: 2}"},
    {"mesh.groups", "{hard: {box: {from: [0.33, 0], to: [1, 1]}, of: block, take: cells}, soft: {difference: "
                    "[block, hard]}}"},
    {"materials",
     "{rubber: {young: 3, poisson: 0.3, density: 2, cells: soft}, steel: {young: 9, poisson: 0.2, "
     "density: 4, cells: hard}}"},
    {"springs", "[{on: pulled, y: 0.2}]"}};

class ForcesOfAStep : public testing::TestWithParam<test::NamedLaw> {
protected:
  test::AnyStates any_{test::BuiltModel(test::study_with(test::pulled_block, GetParam(), beside_linear)),
                       small_motion};
  const domain::Domain& domain_ = any_.model.domain;
  VectorXd u0_ = any_.anything(), u1_ = any_.anything();
  domain::QuadratureStates start_ = states_at(u0_);

  domain::QuadratureStates states_at(const VectorXd& u) const {
    const VectorXd undeformed = VectorXd::Zero(u.size());
    domain::QuadratureStates states;
    EXPECT_FALSE(
        domain_.evaluate({undeformed, u, 0, 0}, domain_.initial_states(), states, {.records = true}));
    return states;
  }

  VectorXd forces_at(const VectorXd& u) const {
    VectorXd forces;
    domain::QuadratureStates now;
    EXPECT_FALSE(
        domain_.evaluate({u0_, u, 0, 0.5, nullptr, ForcesOf::step}, start_, now, {.forces = &forces}));
    return forces;
  }

  MatrixXd tangent_at(const VectorXd& u, TangentOf of) const {
    domain::SparseMatrix tangent = domain_.initial_tangent();
    domain::QuadratureStates now;
    EXPECT_FALSE(domain_.evaluate({u0_, u, 0, 0.5, nullptr, ForcesOf::step}, start_, now,
                                  {.tangent = &tangent, .tangent_of = of}));
    return tangent;
  }
};

TEST_P(ForcesOfAStep, HaveHalfTheirExactTangentAsDerivative) {
  const MatrixXd tangent = tangent_at(u1_, TangentOf::exact);
  constexpr double delta = 1e-5;
  for (Index dof = 0; dof < u1_.size(); ++dof) {
    const VectorXd side = delta * VectorXd::Unit(u1_.size(), dof);
    const VectorXd near = forces_at(u1_ + side) - forces_at(u1_ - side);
    const VectorXd far = forces_at(u1_ + 2 * side) - forces_at(u1_ - 2 * side);
    EXPECT_LE(((8 * near - far) / (12 * delta) - 0.5 * tangent.col(dof)).norm(), 1e-8 * tangent.norm());
  }
}

TEST_P(ForcesOfAStep, HaveASymmetricTangentThatIsTheStiffnessOfAStepThatDoesNotMove) {
  const MatrixXd near = tangent_at(u1_, TangentOf::symmetric), exact = tangent_at(u1_, TangentOf::exact);
  EXPECT_LE((near - near.transpose()).norm(), 1e-14 * near.norm());
  EXPECT_GT((exact - exact.transpose()).norm(), 1e-6 * exact.norm());
  domain::SparseMatrix stiffness = domain_.initial_tangent();
  domain::QuadratureStates now;
  ASSERT_FALSE(domain_.evaluate({u0_, u0_, 0, 0.5}, start_, now, {.tangent = &stiffness}));
  for (const auto of : {TangentOf::symmetric, TangentOf::exact})
    EXPECT_LE((tangent_at(u0_, of) - MatrixXd(stiffness)).norm(), 1e-9 * near.norm());
}

TEST_P(ForcesOfAStep, DoTheWorkThatIsStored) {
  domain::QuadratureStates unchanged, now;
  VectorXd before, forces;
  ASSERT_FALSE(domain_.evaluate({u0_, u0_, 0, 0}, start_, unchanged, {.forces = &before}));
  ASSERT_FALSE(domain_.evaluate({u0_, u1_, 0, 0.5, nullptr, ForcesOf::step}, start_, now,
                                {.forces = &forces, .records = true}));
  const double stored = domain_.energy(u0_, before, 0, start_), after = domain_.energy(u1_, forces, 0.5, now);
  EXPECT_NEAR((u1_ - u0_).dot(forces), after - stored, 1e-12 * (after + stored));
}

std::vector<test::NamedLaw> elastic_laws() {
  std::vector<test::NamedLaw> laws;
  for (const auto& law : test::every_law)
    if (test::is_elastic(law))
      laws.push_back(law);
  return laws;
}

INSTANTIATE_TEST_SUITE_P(EachLaw, ForcesOfAStep, testing::ValuesIn(elastic_laws()),
                         [](const auto& chosen) { return chosen.param.name; });

TEST(ForcesOfAStepOfLinearBodies, AreThoseInTheMiddle) {
  test::AnyStates any({"", {{"time.scheme", "energy_momentum"}}});
  const auto& domain = any.model.domain;
  ASSERT_TRUE(domain.is_linear());
  const VectorXd u0 = any.anything(), u1 = any.anything();
  VectorXd forces;
  domain::SparseMatrix tangent;
  domain::QuadratureStates now;
  domain.evaluate({u0, u1, 0, 1, nullptr, ForcesOf::step}, domain.initial_states(), now,
                  {.forces = &forces, .tangent = &tangent});
  const VectorXd expected = domain.initial_tangent() * (0.5 * (u0 + u1));
  EXPECT_LE((forces - expected).norm(), 1e-14 * expected.norm());
  EXPECT_EQ((tangent - domain.initial_tangent()).norm(), 0);
}

} // namespace
} // namespace rubato::step::forces_of_step_test
