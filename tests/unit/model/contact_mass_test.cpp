// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/model/studies.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace rubato::model::contact_mass_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A body on another one, of 3 × layers cells.
std::string deck(const std::string& physics, const std::string& shape, const std::string& cells, int layers,
                 const std::string& contact_mass) {
  const bool solid = physics == "solid";
  const auto corner = [&](int x, int y, int z) {
    return solid ? fmt::format("[{}, {}, {}]", x, y, z) : fmt::format("[{}, {}]", x, y);
  };
  const auto body = [&](const char* name, int low, const char* sides) {
    return fmt::format(
        "    - {{name: {}, {}: {{from: {}, to: {}}}, divisions: [3, {}{}], cells: {}, sides: {}}}\n", name,
        shape, corner(0, low, 0), corner(3, low + 2, 1), layers, solid ? ", 2" : "", cells, sides);
  };
  return fmt::format("mesh:\n  generate:\n{}{}physics: {}\n"
                     "materials: {{m: {{young: 1e6, poisson: 0.3, density: 3, cells: all}}}}\n"
                     "contact: {{between: {{master: low_top, slave: high_bottom, integration: nodes}}}}\n"
                     "time: {{scheme: newmark, contact_mass: {}, step: 1e-3, end: 1e-2}}\n",
                     body("low", 0, "{bottom: ground, top: low_top}"),
                     body("high", 2, "{bottom: high_bottom}"), physics, contact_mass);
}

bool has_note(const Model& model, std::string_view part) {
  return std::ranges::any_of(model.notes,
                             [&](const auto& note) { return note.find(part) != std::string::npos; });
}

struct Named {
  std::string name, physics, shape, cells;
};

class RedistributedMass : public testing::TestWithParam<Named> {
protected:
  Model model(const std::string& contact_mass, int layers = 10) const {
    return test::located_model(
        deck(GetParam().physics, GetParam().shape, GetParam().cells, layers, contact_mass));
  }
  /// A column for each translation and rotation, of all nodes [dofs × 3 or 6].
  static MatrixXd rigid_motions(const Model& model) {
    const int directions = model.dofs.components, turns = directions == 3 ? 3 : 1;
    MatrixXd motions = MatrixXd::Zero(model.dofs.dof_count, directions + turns);
    for (const auto node : model.dofs.nodes) {
      const auto& place = model.mesh.points[static_cast<std::size_t>(node)];
      for (int i = 0; i < directions; ++i)
        motions(model.dofs.dof(node, i), i) = 1;
      for (int turn = 0; turn < turns; ++turn) {
        const Eigen::Vector3d axis = Eigen::Vector3d::Unit(turns == 1 ? 2 : turn);
        for (int i = 0; i < directions; ++i)
          motions(model.dofs.dof(node, i), directions + turn) = axis.cross(place)[i];
      }
    }
    return motions;
  }
};

TEST_P(RedistributedMass, IsNoneOnTheSlaveSurface) {
  const auto m = model("redistributed");
  ASSERT_EQ(m.massless_nodes.size(), m.zones[0].slave.nodes.size());
  for (const auto node : m.massless_nodes)
    for (int i = 0; i < m.dofs.components; ++i)
      EXPECT_EQ(m.mass.col(m.dofs.dof(node, i)).norm(), 0);
}

/// Momentum, angular momentum and energy of rigid motions, of both bodies.
TEST_P(RedistributedMass, KeepsMassCentreAndInertia) {
  for (const int layers : {1, 2, 3, 10}) {
    const auto before = model("consistent", layers);
    const auto after = model("redistributed", layers);
    ASSERT_FALSE(after.massless_nodes.empty());
    EXPECT_TRUE(after.notes.empty());
    const MatrixXd motions = rigid_motions(before);
    const MatrixXd moments = motions.transpose() * before.mass * motions;
    EXPECT_LT((motions.transpose() * after.mass * motions - moments).norm(), 1e-12 * moments.norm())
        << layers;
    const MatrixXd change = after.mass * motions - before.mass * motions;
    for (const auto node : before.dofs.nodes) { // the lower body keeps its own
      const bool lower = before.mesh.points[static_cast<std::size_t>(node)][1] < 2;
      EXPECT_LE(lower ? change.row(before.dofs.dof(node, 0)).norm() : 0, 1e-14 * moments.norm()) << layers;
    }
  }
}

TEST_P(RedistributedMass, IsThatOfTheProducts) {
  const auto m = model("redistributed", 2);
  VectorXd motion(m.dofs.dof_count);
  for (int i = 0; i < motion.size(); ++i)
    motion[i] = std::sin(i);
  EXPECT_LT((m.products.mass(motion) - m.mass * motion).norm(), 1e-13 * (m.mass * motion).norm());
}

TEST_P(RedistributedMass, IsPositiveInsideTheBodies) {
  const auto m = model("redistributed");
  std::vector<int> inside;
  for (const auto node : m.dofs.nodes)
    if (!std::ranges::binary_search(m.massless_nodes, node))
      inside.push_back(m.dofs.dof(node, 0));
  const MatrixXd mass = MatrixXd(m.mass)(inside, inside);
  EXPECT_TRUE(test::is_positive_definite(mass));
}

INSTANTIATE_TEST_SUITE_P(Of, RedistributedMass,
                         testing::Values(Named{"Quad4", "plane_strain", "rectangle", "quad4"},
                                         Named{"Quad9", "plane_stress", "rectangle", "quad9"},
                                         Named{"Tria3", "plane_strain", "rectangle", "tria3"},
                                         Named{"Rings", "axisymmetric", "rectangle", "quad4"},
                                         Named{"Hexa8", "solid", "box", "hexa8"},
                                         Named{"Hexa27", "solid", "box", "hexa27"},
                                         Named{"Tetra4", "solid", "box", "tetra4"}),
                         [](const auto& chosen) { return chosen.param.name; });

TEST(RedistributedMass, IsConsistentWithoutAnInside) {
  auto text = deck("plane_strain", "rectangle", "quad4", 1, "redistributed");
  const std::string sides = "{bottom: high_bottom}";
  text.replace(text.find(sides), sides.size(), "{bottom: high_bottom, top: high_bottom}");
  const auto model = test::located_model(text);
  EXPECT_TRUE(model.massless_nodes.empty());
  EXPECT_TRUE(has_note(model, "the surface keeps it"));
}

} // namespace
} // namespace rubato::model::contact_mass_test
