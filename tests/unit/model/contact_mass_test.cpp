// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/zone.hpp"
#include "rubato/core/error.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/model/studies.hpp"
#include <string>

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

struct Named {
  std::string name, physics, shape, cells;
};

class RedistributedMass : public testing::TestWithParam<Named> {
protected:
  Model model(const std::string& contact_mass, int layers = 10) const {
    return test::located_model(
        deck(GetParam().physics, GetParam().shape, GetParam().cells, layers, contact_mass));
  }
  /// 1, x, y, z at the nodes, in the first direction of motion.
  static MatrixXd monomials(const Model& model) {
    MatrixXd values = MatrixXd::Zero(model.dofs.dof_count, 4);
    for (const auto node : model.dofs.nodes)
      values.row(model.dofs.dof(node, 0)) << 1, model.mesh.points[static_cast<std::size_t>(node)].transpose();
    return values;
  }
};

TEST_P(RedistributedMass, IsNoneOnTheSlaveSurface) {
  const auto m = model("redistributed");
  ASSERT_EQ(m.massless_nodes.size(), m.zones[0].slave.nodes.size());
  for (const auto node : m.massless_nodes)
    for (int i = 0; i < m.dofs.components; ++i)
      EXPECT_EQ(m.mass.col(m.dofs.dof(node, i)).norm(), 0);
}

TEST_P(RedistributedMass, KeepsMassCentreAndInertia) {
  const auto before = model("consistent");
  const auto after = model("redistributed");
  const MatrixXd p = monomials(before);
  const MatrixXd moments = p.transpose() * before.mass * p;
  EXPECT_LT((p.transpose() * after.mass * p - moments).norm(), 1e-12 * moments.norm());
  const VectorXd body_before = before.mass * p.col(0);
  const VectorXd body_after = after.mass * p.col(0);
  double slave = 0; // the upper body keeps its own
  double master = 0;
  for (const auto node : before.dofs.nodes) {
    const auto dof = before.dofs.dof(node, 0);
    const bool upper = before.mesh.points[static_cast<std::size_t>(node)][1] > 2 ||
                       std::ranges::binary_search(after.massless_nodes, node);
    (upper ? slave : master) += body_after[dof] - body_before[dof];
  }
  EXPECT_NEAR(slave, 0, 1e-12 * moments(0, 0));
  EXPECT_NEAR(master, 0, 1e-12 * moments(0, 0));
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

TEST_P(RedistributedMass, IsKeptByThinBodies) {
  for (const int layers : {1, 2, 3}) {
    const auto before = model("consistent", layers);
    const auto after = model("redistributed", layers);
    const VectorXd one = monomials(before).col(0);
    const double mass = one.dot(before.mass * one);
    EXPECT_NEAR(one.dot(after.mass * one), mass, 1e-12 * mass) << layers;
  }
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

TEST(RedistributedMass, NeedsAnInside) {
  auto text = deck("plane_strain", "rectangle", "quad4", 1, "redistributed");
  const std::string sides = "{bottom: high_bottom}";
  text.replace(text.find(sides), sides.size(), "{bottom: high_bottom, top: high_bottom}");
  try {
    test::located_model(text);
    FAIL() << "nothing is left that could carry it";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no nodes but on its contact surface"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace rubato::model::contact_mass_test
