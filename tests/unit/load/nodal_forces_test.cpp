// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/load/nodal_forces.hpp"

#include <gtest/gtest.h>

#include "distorted_body.hpp"
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace rubato::load::nodal_forces_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;
using study::Physics;

class EveryLoadedBody : public DistortedBody {
protected:
  VectorXd force_ = VectorXd::Zero(dofs_.dof_count);

  /// The boundary sides all of whose nodes have that coordinate.
  std::vector<Face> faces_on(int axis, double coordinate) const {
    std::vector<Face> faces;
    for (const auto& side : sides_)
      if (std::ranges::all_of(side.nodes, [&](auto node) {
            return std::abs(mesh_.points[static_cast<std::size_t>(node)][axis] - coordinate) < 1e-12;
          }))
        faces.push_back({side.type, side.nodes});
    return faces;
  }
  std::vector<Face> all_faces() const {
    std::vector<Face> faces;
    for (const auto& side : sides_)
      faces.push_back({side.type, side.nodes});
    return faces;
  }
  Vector3d total() const {
    Vector3d sum = Vector3d::Zero();
    for (const auto node : dofs_.nodes)
      sum.head(d_) += force_.segment(dofs_.dof(node, 0), d_);
    return sum;
  }
  /// Work of the forces in the displacement x ↦ h x.
  double work_in(const Eigen::Matrix3d& h) const {
    double work = 0;
    for (const auto node : dofs_.nodes) {
      const Vector3d moved = h * mesh_.points[static_cast<std::size_t>(node)];
      for (int a = 0; a < d_; ++a)
        work += force_[dofs_.dof(node, a)] * moved[a];
    }
    return work;
  }
  /// Of the side x = 2, of the side y = 1, and the body's volume.
  double right_area() const { return d_ == 3 ? 1 : physics_ == Physics::axisymmetric ? 4 * pi : thickness; }
  double top_area() const { return d_ == 3 ? 1 : physics_ == Physics::axisymmetric ? 3 * pi : thickness; }
  double volume() const { return top_area(); }
};

TEST_P(EveryLoadedBody, CarriesTheTotalOfASurfaceForce) {
  add_surface_force(mesh_, dofs_, section_, faces_on(1, 1), {3, -5, 2}, force_);
  const Vector3d expected = top_area() * Vector3d(3, -5, d_ == 3 ? 2 : 0);
  EXPECT_LT((total() - expected).norm(), 1e-13 * expected.norm());
}

TEST_P(EveryLoadedBody, IsPushedInwardByPressure) {
  add_pressure(mesh_, dofs_, section_, faces_on(0, 2), 4., force_);
  EXPECT_LT((total() - Vector3d(-4 * right_area(), 0, 0)).norm(), 1e-12);
  force_.setZero();
  add_pressure(mesh_, dofs_, section_, faces_on(1, 0), 4., force_);
  EXPECT_LT((total() - Vector3d(0, 4 * top_area(), 0)).norm(), 1e-12);
}

TEST_P(EveryLoadedBody, LosesPressureTimesVolumeWhenItSwellsUnderPressure) {
  add_pressure(mesh_, dofs_, section_, all_faces(), 4., force_);
  // In the plane only the two strains in it change the volume; a ring widens by its hoop strain too.
  const double growth = d_ == 3 || physics_ == Physics::axisymmetric ? 3 : 2;
  EXPECT_NEAR(work_in(Eigen::Matrix3d::Identity()), -4 * growth * volume(), 1e-12 * volume());
}

TEST_P(EveryLoadedBody, WeighsItsMassTimesGravity) {
  add_gravity(mesh_, dofs_, bulk_, {0.5, -9.81, 2}, force_);
  const Vector3d expected = law.density * volume() * Vector3d(0.5, -9.81, d_ == 3 ? 2 : 0);
  EXPECT_LT((total() - expected).norm(), 1e-12 * expected.norm());
}

TEST_P(EveryLoadedBody, TakesTheMomentOfASurfaceForce) {
  add_surface_force(mesh_, dofs_, section_, faces_on(1, 1), {0, 1, 0}, force_);
  Eigen::Matrix3d lift = Eigen::Matrix3d::Zero();
  lift(1, 0) = 1;
  // ∫ x dA over 1 ≤ x ≤ 2; on a ring dA = 2πx dx.
  const double expected = physics_ == Physics::axisymmetric ? 2 * pi * 7 / 3 : 1.5 * top_area();
  EXPECT_NEAR(work_in(lift), expected, 1e-13 * expected);
}

INSTANTIATE_TEST_SUITE_P(Loads, EveryLoadedBody, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& instance) { return test::name_of(instance.param); });

class OneBox : public testing::Test {
protected:
  mesh::Mesh mesh_ = test::patch_mesh(CellType::hexa20, 1, [](const Vector3d& x) { return Vector3d(3 * x); });
  domain::Bulk bulk_ = test::whole_bulk(mesh_, {}, law);
  domain::DofMap dofs_ = domain::number_dofs(mesh_, bulk_.cells, 3);
  VectorXd force_ = VectorXd::Zero(dofs_.dof_count);
};

TEST_F(OneBox, TakesALineForceOnAQuadraticEdgeBySimpsonsWeights) {
  const auto cell = mesh_.nodes_of(0);
  const std::vector<mesh::NodeIndex> edge{cell[0], cell[1], cell[8]};
  const std::vector<Face> edges{{CellType::seg3, edge}};
  add_line_force(mesh_, dofs_, edges, {0, 2, 0}, force_);
  EXPECT_NEAR(force_[dofs_.dof(edge[0], 1)], 1, 1e-14);
  EXPECT_NEAR(force_[dofs_.dof(edge[1], 1)], 1, 1e-14);
  EXPECT_NEAR(force_[dofs_.dof(edge[2], 1)], 4, 1e-14);
  EXPECT_NEAR(force_.sum(), 6, 1e-13);
}

TEST_F(OneBox, TakesANodalForceOnEachNode) {
  const std::vector<mesh::NodeIndex> nodes{2, 5};
  add_nodal_force(mesh_, dofs_, nodes, {1, 2, 3}, force_);
  add_nodal_force(mesh_, dofs_, nodes, {1, 2, 3}, force_);
  for (const auto node : nodes)
    EXPECT_EQ(Vector3d(force_.segment<3>(dofs_.dof(node, 0))), Vector3d(2, 4, 6));
  EXPECT_DOUBLE_EQ(force_.sum(), 24);
}

TEST_F(OneBox, RefusesALoadOnANodeWithoutCellsByItsName) {
  mesh_.points.emplace_back(9, 9, 9);
  mesh_.node_numbers.push_back(90);
  dofs_ = domain::number_dofs(mesh_, bulk_.cells, 3);
  const std::vector<mesh::NodeIndex> nodes{mesh_.node_count() - 1};
  try {
    add_nodal_force(mesh_, dofs_, nodes, {1, 0, 0}, force_);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("N90"), std::string::npos) << error.what();
  }
}

TEST_F(OneBox, RefusesSidesOfAnotherDimension) {
  const auto cell = mesh_.nodes_of(0);
  const std::vector<Face> edges{{CellType::seg3, cell.first(3)}};
  const std::vector<Face> faces{{CellType::quad8, cell.first(8)}};
  EXPECT_THROW(add_pressure(mesh_, dofs_, {}, edges, 1, force_), std::invalid_argument);
  EXPECT_THROW(add_surface_force(mesh_, dofs_, {}, edges, {1, 0, 0}, force_), std::invalid_argument);
  EXPECT_THROW(add_line_force(mesh_, dofs_, faces, {1, 0, 0}, force_), std::invalid_argument);
}

} // namespace
} // namespace rubato::load::nodal_forces_test
