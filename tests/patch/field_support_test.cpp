// SPDX-License-Identifier: LGPL-3.0-or-later
// The patch test with displacements of the boundary that are expressions of place and time.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/patch_mesh.hpp"
#include "support/walk.hpp"
#include <set>
#include <string>

namespace rubato::field_support_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using study::Physics;

class EveryCellWhoseBoundaryIsMoved : public testing::TestWithParam<test::BulkCase> {
protected:
  Physics physics_ = GetParam().physics;
  int d_ = element::component_count(physics_);
  bool ring_ = physics_ == Physics::axisymmetric;
  mesh::Mesh mesh_ =
      test::patch_mesh(GetParam().type, 3, test::moved_by(test::shaken(d_, 3, 0.2), Vector3d(1, 0, 0)));

  const Vector3d shift_ = ring_ ? Vector3d(0, 2e-3, 0) : Vector3d(1e-3, 2e-3, -3e-3);
  /// Any, but for a ring only radial and axial stretch.
  Matrix3d gradient() const {
    Matrix3d h;
    h << 3e-3, -2e-3, 5e-3, 7e-3, 1e-3, -4e-3, 2e-3, 6e-3, -3e-3;
    return ring_ ? Matrix3d(Vector3d(3e-3, 1e-3, 0).asDiagonal()) : h;
  }

  /// "t*(0.001+(0.003)*x+(-0.002)*y)"
  std::string component(int i) const {
    std::string text = fmt::format("t*({}", shift_[i]);
    for (int j = 0; j < d_; ++j)
      text += fmt::format("+({})*{}", gradient()(i, j), "xyz"[static_cast<std::size_t>(j)]);
    return text + ")";
  }

  study::Study study() const {
    study::Study study;
    study.name = "run";
    study.physics = physics_;
    study.mesh.file = "given";
    auto& rubber = study.materials.emplace_back();
    rubber.name = "rubber";
    rubber.young = 210;
    rubber.poisson = 0.3;
    study.time.scheme = study::SchemeKind::static_steps;
    study.time.contact_mass = study::ContactMass::consistent;
    study.time.step = study.time.end = 1;
    std::set<mesh::NodeIndex> outside;
    for (const auto& side : test::boundary_sides(mesh_))
      outside.insert(side.nodes.begin(), side.nodes.end());
    for (const auto node : outside) {
      auto& support = study.supports.emplace_back();
      support.on = fmt::format("N{}", node + 1);
      for (int i = 0; i < d_; ++i)
        support.components[static_cast<std::size_t>(i)] = study::Formula{component(i)};
    }
    return study;
  }
};

TEST_P(EveryCellWhoseBoundaryIsMoved, FollowsALinearField) {
  test::Walk walk(study(), mesh_);
  ASSERT_TRUE(walk.to_end());
  double error = 0;
  for (const auto node : walk.model.dofs.nodes) {
    const Vector3d exact = shift_ + gradient() * mesh_.points[static_cast<std::size_t>(node)];
    for (int i = 0; i < d_; ++i)
      error = std::max(error, std::abs(walk.displacement(node, i) - exact[i]));
  }
  EXPECT_LE(error, 1e-12 * gradient().norm());
}

INSTANTIATE_TEST_SUITE_P(Cells, EveryCellWhoseBoundaryIsMoved, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& instance) { return test::name_of(instance.param); });

} // namespace
} // namespace rubato::field_support_test
