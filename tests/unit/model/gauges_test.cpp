// SPDX-License-Identifier: LGPL-3.0-or-later
// Springs on motions that nothing resists: what they hold and what they let go.
#include "rubato/model/build_model.hpp"
#include "rubato/model/gauges.hpp"
#include "rubato/model/model.hpp"

#include <gtest/gtest.h>

#include "support/rings.hpp"
#include "unit/model/studies.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::model::gauges_test {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// A smooth ring round a pin that is held at its core: the ring may turn.
Model ring_round_pin() {
  const auto study = test::study_of(R"(mesh:
  generate:
    - {name: pin, rectangle: {from: [0, 0.3], to: [6.283185307179586, 0.9]}, divisions: [40, 2],
       sides: {bottom: core, top: pin_skin}}
    - {name: ring, rectangle: {from: [0, 1], to: [6.283185307179586, 1.3]}, divisions: [48, 2],
       sides: {bottom: ring_skin}}
physics: plane_strain
materials: {steel: {young: 2e11, poisson: 0.3}}
supports: [{on: core, fix: [x, y]}]
contact: {rest: {master: pin_skin, slave: ring_skin, integration: nodes}}
time: {scheme: static, step: 1, end: 1}
)");
  return build_model(study, test::closed_rings(load_mesh(study.mesh)));
}

class RingGauge : public testing::Test {
protected:
  RingGauge() { EXPECT_EQ(model_.gauges.size(), 1U); }

  const Gauge& gauge() const { return model_.gauges.at(0); }
  Vector2d place(mesh::NodeIndex node) const {
    return model_.mesh.points[static_cast<std::size_t>(node)].head<2>();
  }
  /// A motion of the gauge's nodes, one after the other.
  template <class Move> VectorXd moves(const Move& move) const {
    VectorXd values(2 * static_cast<Index>(gauge().nodes.size()));
    for (std::size_t i = 0; i < gauge().nodes.size(); ++i)
      values.segment<2>(2 * static_cast<Index>(i)) = move(place(gauge().nodes[i]));
    return values;
  }
  /// g as a vector of all dofs.
  VectorXd spread() const {
    VectorXd g = VectorXd::Zero(model_.dofs.dof_count);
    for (std::size_t i = 0; i < gauge().nodes.size(); ++i)
      g.segment<2>(model_.dofs.dof(gauge().nodes[i], 0)) =
          gauge().values.segment<2>(2 * static_cast<Index>(i));
    return g;
  }

  Model model_ = ring_round_pin();
};

TEST_F(RingGauge, HasFewNodesOfTheRingFarFromEachOther) {
  const auto& nodes = gauge().nodes;
  EXPECT_EQ(nodes.size(), 8U);
  double nearest = 10;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_GE(place(nodes[i]).norm(), 0.99);
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, (place(nodes[i]) - place(nodes[j])).norm());
  }
  EXPECT_GT(nearest, 0.8) << "an eighth of the outer circle is 1.02 long";
}

TEST_F(RingGauge, MeasuresTheTurnAndNoShift) {
  const VectorXd turn = moves([](const Vector2d& x) { return Vector2d(-x.y(), x.x()); });
  EXPECT_NEAR(std::abs(gauge().values.dot(turn)), turn.norm(), 1e-12);
  EXPECT_NEAR(gauge().values.dot(moves([](const Vector2d&) { return Vector2d(1, 0); })), 0, 1e-12);
  EXPECT_NEAR(gauge().values.dot(moves([](const Vector2d&) { return Vector2d(0, 1); })), 0, 1e-12);
}

/// The springs of a matrix with 6 in all of its diagonal, g gᵀ as stiff as that where g is largest.
TEST_F(RingGauge, IsASpringAsStiffAsTheBody) {
  SparseMatrix matrix(model_.dofs.dof_count, model_.dofs.dof_count);
  matrix.setIdentity();
  matrix *= 6;
  const SparseMatrix before = matrix;
  add_gauges(model_, matrix);
  const VectorXd g = spread();
  const double k = 6 / g.cwiseAbs2().maxCoeff();
  const Eigen::MatrixXd added = Eigen::MatrixXd(matrix) - Eigen::MatrixXd(before);
  EXPECT_LE((added - k * g * g.transpose()).norm(), 1e-12 * added.norm());
}

TEST_F(RingGauge, IsInTheStiffnessOfTheModel) {
  VectorXd turn = VectorXd::Zero(model_.dofs.dof_count);
  for (const auto node : model_.dofs.nodes)
    if (place(node).norm() > 0.99)
      turn.segment<2>(model_.dofs.dof(node, 0)) = Vector2d(-place(node).y(), place(node).x());
  const VectorXd force = model_.domain.initial_tangent() * turn;
  const VectorXd g = spread();
  EXPECT_GT(force.norm(), 0);
  EXPECT_LE((force - force.dot(g) / g.squaredNorm() * g).norm(), 1e-9 * force.norm());
}

TEST_F(RingGauge, IsNotMadeASecondTime) {
  std::vector<std::string> notes;
  EXPECT_TRUE(make_gauges(model_, notes).empty());
  EXPECT_TRUE(notes.empty());
  model_.gauges.clear();
  EXPECT_EQ(make_gauges(model_, notes).size(), 1U);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(std::ranges::count(model_.notes, notes.front()), 1);
}

} // namespace
} // namespace rubato::model::gauges_test
