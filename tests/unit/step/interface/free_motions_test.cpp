// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/model.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/step/interface/free_motions.hpp"
#include "rubato/time/step_control.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "support/model_of.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::step::free_motions_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const MatrixXd two_motions = (MatrixXd(4, 2) << 1, 0, 1, 0, 0.5, 1, 0, -1).finished();

/// Corrections of iterates whose whole residual is linear, J x + r, by a matrix that lacks part of J.
VectorXd corrected(const VectorXd& x, const MatrixXd& missing) {
  const VectorXd wanted = (VectorXd(4) << 0.3, -0.1, 0.2, 0.4).finished();
  return wanted - x - missing * x;
}

VectorXd next_iterate(const MatrixXd& missing) {
  constexpr double shift = 1e-3;
  const VectorXd x = VectorXd::Zero(4);
  const VectorXd plain = corrected(x, missing);
  MatrixXd shifted(4, 2);
  for (Index k = 0; k < 2; ++k)
    shifted.col(k) = corrected(x + shift * two_motions.col(k), missing);
  const auto shares = FreeMotions(two_motions).shares(plain, shifted);
  if (!shares)
    return VectorXd::Constant(4, -1);
  VectorXd next = x + plain;
  for (Index k = 0; k < 2; ++k)
    next += (*shares)[k] * (shift * two_motions.col(k) + shifted.col(k) - plain);
  return next;
}

TEST(SharesOfMotions, ChangeNothingWhereTheLinearisationLacksNothing) {
  const MatrixXd nothing = MatrixXd::Zero(4, 4);
  EXPECT_LE((next_iterate(nothing) - corrected(VectorXd::Zero(4), nothing)).norm(), 1e-12);
}

TEST(SharesOfMotions, FindTheIterateWhereMotionsAreResistedBeyondTheLinearisation) {
  const MatrixXd of_motions = test::pseudo_inverse(two_motions.transpose());
  for (const double stiffness : {7.0, -0.9, -3.0}) {
    const MatrixXd missing = stiffness * two_motions * of_motions.transpose();
    const VectorXd next = next_iterate(missing);
    EXPECT_LE(corrected(next, missing).norm(), 1e-9) << stiffness;
  }
}

TEST(SharesOfMotions, AreNotFoundWhereAMotionChangesNothing) {
  const VectorXd plain = VectorXd::Ones(4);
  MatrixXd shifted(4, 2);
  shifted.col(0) = plain - two_motions.col(0);
  shifted.col(1) = plain;
  EXPECT_FALSE(FreeMotions(two_motions).shares(plain, shifted));
}

TEST(FreeMotions, AreThoseThatSupportsAndFirmSpringsLeave) {
  const auto model = test::model_of(R"(
mesh:
  generate:
    - {name: floor, rectangle: {from: [-2, -1], to: [5, 0]}, divisions: [7, 1], sides: {top: above, bottom: base}}
    - {name: block, rectangle: {from: [0, 0], to: [3, 2]}, divisions: [3, 2], sides: {bottom: under, left: edge}}
physics: plane_stress
materials: {steel: {young: 1000, poisson: 0.3}}
supports: [{on: base, fix: [x, y]}]
springs: [{on: edge, x: 1e3}]
contact: {rest: {master: above, slave: under}}
time: {scheme: static, step: 1, end: 1}
)");
  const auto system = make_effective_system(model, time::make_scheme(model.study.time), 1);
  const auto motions = free_motions(model, *system.compliance);
  ASSERT_EQ(motions.cols(), 1) << "springs along x hold it against turning, too";
  const auto& dofs = system.compliance->dof_of_interface_dof();
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto node = model.node_of(dofs[i]);
    const bool upward = dofs[i] == model.dofs.dof(node, 1);
    const auto& slaves = model.zones.front().slave.nodes;
    const bool of_block = std::ranges::find(slaves, node) != slaves.end();
    EXPECT_NEAR(std::abs(motions(static_cast<Index>(i), 0)), upward && of_block ? 1 : 0, 1e-12);
  }
}

/// A ring of rubber over a plate: it is free along the axis, and its section turns.
TEST(FreeMotions, OfARingAreItsWayAlongTheAxisAndTheTurnOfItsSection) {
  const auto model = test::model_of(R"(
mesh:
  generate:
    - {name: plate, rectangle: {from: [5, -1], to: [15, 0]}, divisions: [5, 1], sides: {top: above, bottom: base}}
    - {name: ring, rectangle: {from: [9, 0], to: [11, 2]}, divisions: [2, 2], sides: {bottom: under, top: crown}}
physics: axisymmetric
materials: {rubber: {young: 8, poisson: 0.45}}
supports: [{on: base, fix: [x, y]}]
contact: {rest: {master: above, slave: under}}
time: {scheme: static, step: 1, end: 1}
)");
  const auto system = make_effective_system(model, time::make_scheme(model.study.time), 1);
  const auto motions = free_motions(model, *system.compliance);
  ASSERT_EQ(motions.cols(), 2);
  EXPECT_EQ(FreeMotions(motions).count(), 2);
  const auto& dofs = system.compliance->dof_of_interface_dof();
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto& place = model.mesh.points[static_cast<std::size_t>(model.node_of(dofs[i]))];
    const auto& slaves = model.zones.front().slave.nodes;
    const bool of_ring = std::ranges::find(slaves, model.node_of(dofs[i])) != slaves.end();
    const bool upward = dofs[i] == model.dofs.dof(model.node_of(dofs[i]), 1);
    EXPECT_NEAR(std::abs(motions(static_cast<Index>(i), 0)), upward && of_ring ? 1 : 0, 1e-12);
    EXPECT_NEAR(motions(static_cast<Index>(i), 1), upward && of_ring ? place.x() - 10 : 0, 1e-12);
  }
}

TEST(FreeMotions, AreNoneWhereTheyDependOnOneAnother) {
  EXPECT_EQ(FreeMotions(two_motions).count(), 2);
  EXPECT_EQ(FreeMotions(MatrixXd::Ones(4, 2)).count(), 0);
  EXPECT_EQ(FreeMotions(MatrixXd()).count(), 0);
}

} // namespace
} // namespace rubato::step::free_motions_test
