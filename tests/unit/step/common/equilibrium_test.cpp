// SPDX-License-Identifier: LGPL-3.0-or-later
// The residual of a step against the scheme's equation written with matrices.
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/step/common/equilibrium.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "unit/step/any_state.hpp"

namespace rubato::step::equilibrium_test {
namespace {

using Eigen::VectorXd;
using test::AnyStates;

class Residual : public testing::TestWithParam<test::NamedScheme> {
protected:
  static constexpr double length = 0.3;

  /// A motion that the scheme's formulas allow at the end of the step.
  time::Motion any_motion() {
    auto motion = time::predict(any_.scheme, length, before_.motion);
    time::correct(system_.coefficients, any_.anything(), motion);
    return motion;
  }
  State state_of(const time::Motion& motion, const ContactForce& contact) const {
    State now;
    now.t = before_.t + length;
    now.motion = motion;
    now.contact_force = contact.all;
    now.external_force = model::external_force(any_.model, now.t);
    return now;
  }

  AnyStates any_{GetParam()};
  EffectiveSystem system_ = make_effective_system(any_.model, any_.scheme, length);
  State before_ = any_.any_state();
  Equilibrium equilibrium_{any_.model, any_.scheme, system_, before_, before_.t + length};
};

TEST_P(Residual, IsTheEquationOfTheScheme) {
  for (int i = 0; i < 3; ++i) {
    const auto motion = any_motion();
    ContactForce contact(any_.model.dofs.dof_count);
    contact.all = any_.anything();
    equilibrium_.evaluate(motion, contact);
    const VectorXd whole = any_.left_side(before_, state_of(motion, contact));
    const VectorXd expected = any_.model.reduction.gather(whole);
    EXPECT_LT((equilibrium_.residual() - expected).lpNorm<Eigen::Infinity>(),
              1e-12 * whole.lpNorm<Eigen::Infinity>());
  }
}

/// A correction d changes it by A d: one step of Newton's method balances a bulk that is linear.
TEST_P(Residual, ChangesByTheEffectiveMatrix) {
  auto motion = any_motion();
  const ContactForce none(any_.model.dofs.dof_count);
  equilibrium_.evaluate(motion, none);
  const VectorXd before = equilibrium_.residual();
  const VectorXd d = any_.model.reduction.gather(any_.anything());
  time::correct(system_.coefficients, any_.model.reduction.scatter(d), motion);
  equilibrium_.evaluate(motion, none);
  const VectorXd change = system_.matrix.selfadjointView<Eigen::Lower>() * d;
  EXPECT_LT((equilibrium_.residual() - before - change).norm(), 1e-11 * change.norm());
}

TEST_P(Residual, IsMeasuredAtTheNodeWhereItIsLargest) {
  const auto motion = any_motion();
  const ContactForce none(any_.model.dofs.dof_count);
  equilibrium_.evaluate(motion, none);
  StepReport report;
  equilibrium_.measure(motion, none, report);
  Eigen::Index worst = 0;
  equilibrium_.residual().cwiseAbs().maxCoeff(&worst);
  const int dof = any_.model.reduction.free_dofs()[static_cast<std::size_t>(worst)];
  EXPECT_EQ(report.worst_node, any_.model.node_of(dof));
  EXPECT_GT(report.residual, 0);
  const auto named = equilibrium_.worst();
  ASSERT_FALSE(named.empty());
  EXPECT_EQ(named.front().node, report.worst_node);
  EXPECT_NEAR(named.front().residual, report.residual, 1e-14 * report.residual);
}

INSTANTIATE_TEST_SUITE_P(Of, Residual, testing::ValuesIn(test::every_implicit_scheme),
                         [](const auto& chosen) { return chosen.param.name; });

/// Of a bar that is pulled by a force F without being moved: F is out of balance, and the largest force.
TEST(RelativeResidual, IsOneWhereAllOfALoadIsUnbalanced) {
  const auto model = test::model_of(R"(
mesh:
  generate:
    - {name: bar, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1], sides: {left: held}, points: {right_top: end}}
physics: plane_stress
materials: {rubber: {young: 1e6, poisson: 0}}
supports: [{on: held, fix: [x, y]}]
loads: [{nodal_force: {on: end, x: 7}}]
time: {scheme: static, step: 1, end: 1}
)");
  const auto scheme = time::make_scheme(model.study.time);
  const auto system = make_effective_system(model, scheme, 1);
  const auto start = initial_state(model, scheme, 0, true);
  Equilibrium equilibrium(model, scheme, system, start, 1);
  const ContactForce none(model.dofs.dof_count);
  equilibrium.evaluate(start.motion, none);
  StepReport report;
  equilibrium.measure(start.motion, none, report);
  EXPECT_EQ(report.residual, 1);
  EXPECT_EQ(report.worst_node, mesh::nodes_named(model.mesh, "end").front());
}

} // namespace
} // namespace rubato::step::equilibrium_test
