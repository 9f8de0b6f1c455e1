// SPDX-License-Identifier: LGPL-3.0-or-later
// How contact forces move surfaces, and the bulk behind them.
#include "rubato/step/advance.hpp"
#include "rubato/step/interface/surface_motion.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/dense.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <random>

namespace rubato::step::surface_motion_test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// SDNL140's beams in their first step.
class SurfacesOfBeams : public testing::Test {
protected:
  SurfacesOfBeams() { surface_.start_from(trial_.motion, equilibrium_); }

  const std::vector<int>& dofs() const { return system_.compliance->dof_of_interface_dof(); }
  Index count() const { return static_cast<Index>(dofs().size()); }
  VectorXd forces(unsigned seed, double size = 1e6) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-size, size);
    return VectorXd::NullaryExpr(count(), [&] { return number(random); });
  }
  VectorXd on_surface(const VectorXd& all) const { return all(dofs()); }
  /// A⁻¹ of minus a residual on free dofs and minus forces on the surface, one a dof; by a dense factor.
  VectorXd moved_by(const VectorXd& residual, const VectorXd& force) const {
    VectorXd all = VectorXd::Zero(model_.dofs.dof_count);
    all(dofs()) = walk_.scheme.contact_weight() * force;
    return model_.reduction.scatter(
        test::dense_solution(system_.matrix, -residual - model_.reduction.gather(all)));
  }
  static void expect_near(const VectorXd& a, const VectorXd& b, double tolerance = 1e-9) {
    EXPECT_GT(b.norm(), 0);
    EXPECT_LE((a - b).norm(), tolerance * b.norm());
  }

  test::Walk walk_{test::two_beams};
  const test::ModelParts& model_ = walk_.model;
  EffectiveSystem system_ = make_effective_system(model_, walk_.scheme, walk_.length());
  Equilibrium equilibrium_{model_, walk_.scheme, system_, walk_.state(), walk_.target()};
  State trial_ = predict(model_, walk_.scheme, system_, walk_.state(), walk_.target());
  const time::Motion base_ = trial_.motion;
  SurfaceMotion surface_{model_, walk_.scheme, system_};
};

TEST_F(SurfacesOfBeams, GoWithoutForcesWhereTheFreeBulkGoes) {
  expect_near(surface_.free, on_surface(moved_by(equilibrium_.residual(), VectorXd::Zero(count()))));
  EXPECT_EQ(surface_.moved, VectorXd::Zero(count())) << "so far";
  surface_.move(trial_);
  EXPECT_EQ(surface_.moved, surface_.free);
}

TEST_F(SurfacesOfBeams, AreMovedByForces) {
  surface_.applied = forces(1);
  surface_.move(trial_);
  expect_near(surface_.moved, on_surface(moved_by(equilibrium_.residual(), surface_.applied)));
  expect_near(on_surface(trial_.motion.u), on_surface(base_.u) + surface_.moved);
  VectorXd elsewhere = trial_.motion.u - base_.u;
  elsewhere(dofs()).setZero();
  EXPECT_EQ(elsewhere.norm(), 0) << "the bulk stays until it is asked for";
}

TEST_F(SurfacesOfBeams, TakeTheBulkAlong) {
  surface_.applied = forces(2);
  surface_.move(trial_);
  const VectorXd surfaces = on_surface(trial_.motion.u);
  surface_.move_bulk(trial_);
  expect_near(trial_.motion.u - base_.u, moved_by(equilibrium_.residual(), surface_.applied));
  expect_near(on_surface(trial_.motion.u), surfaces);
  expect_near(trial_.motion.v - base_.v, system_.coefficients.velocity * (trial_.motion.u - base_.u));
  expect_near(trial_.motion.a - base_.a, system_.coefficients.acceleration * (trial_.motion.u - base_.u));
}

TEST_F(SurfacesOfBeams, AreInEquilibriumThen) {
  const double before = equilibrium_.residual().norm();
  surface_.applied = forces(3);
  surface_.move_bulk(trial_);
  ContactForce contact(model_.dofs.dof_count);
  contact.all(dofs()) = surface_.applied;
  equilibrium_.evaluate(trial_.motion, contact);
  EXPECT_LE(equilibrium_.residual().norm(), 1e-9 * before);
}

/// From a base with forces, given the residual with them, everything moves as from one without.
TEST_F(SurfacesOfBeams, MoveByWhatTheBaseDoesNotCarry) {
  const VectorXd carried = forces(4);
  const VectorXd applied = forces(5);
  surface_.applied = applied;
  surface_.move(trial_);
  const VectorXd wanted = surface_.moved;

  VectorXd all = VectorXd::Zero(model_.dofs.dof_count);
  all(dofs()) = walk_.scheme.contact_weight() * carried;
  SurfaceMotion other(model_, walk_.scheme, system_);
  other.start_from(base_, equilibrium_.residual() + model_.reduction.gather(all), carried);
  EXPECT_EQ(other.applied, carried);
  EXPECT_EQ(other.beyond_carried(carried), VectorXd::Zero(count()));
  EXPECT_EQ(other.beyond_carried(applied), applied - carried);
  other.move(trial_);
  EXPECT_EQ(other.moved, other.free) << "nothing beside what it carries";
  other.applied = applied;
  other.move(trial_);
  expect_near(other.moved, wanted);
  other.move_bulk(trial_);
  expect_near(trial_.motion.u - base_.u, moved_by(equilibrium_.residual(), applied));

  other.start_from(base_, equilibrium_);
  EXPECT_EQ(other.beyond_carried(applied), applied) << "this base carries nothing";
}

TEST_F(SurfacesOfBeams, GoToWhereAMotionHasThem) {
  auto target = base_;
  target.u += VectorXd::LinSpaced(target.u.size(), 1e-3, 2e-3);
  surface_.go_to(target, trial_);
  EXPECT_LE((on_surface(trial_.motion.u) - on_surface(target.u)).norm(), 1e-15);
  expect_near(surface_.moved, on_surface(target.u - base_.u), 1e-12);
}

TEST_F(SurfacesOfBeams, TakeAPartOfAMoveWithTheForcesOfTheWhole) {
  surface_.applied = forces(6);
  surface_.move(trial_);
  const VectorXd before = surface_.moved;
  const VectorXd applied = forces(7);
  surface_.applied = applied;
  surface_.move(trial_);
  const VectorXd after = surface_.moved;
  surface_.shorten(before, 1, trial_);
  EXPECT_TRUE(surface_.consistent);
  EXPECT_EQ(surface_.moved, after);
  surface_.shorten(before, 0.25, trial_);
  EXPECT_FALSE(surface_.consistent);
  expect_near(surface_.moved, 0.75 * before + 0.25 * after, 1e-12);
  expect_near(on_surface(trial_.motion.u), on_surface(base_.u) + surface_.moved, 1e-12);
  EXPECT_EQ(surface_.applied, applied);
  surface_.start_from(base_, equilibrium_);
  EXPECT_TRUE(surface_.consistent);
}

} // namespace
} // namespace rubato::step::surface_motion_test
