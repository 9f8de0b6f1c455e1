// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_nodes.hpp"
#include "rubato/mesh/interpolation.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"
#include <numeric>
#include <random>
#include <stdexcept>

namespace rubato::mesh::interpolation_test {
namespace {

using Eigen::Vector3d;

std::vector<CellType> types_with_shape_functions() {
  auto types = test::all_types();
  types.insert(types.end(), {CellType::seg2, CellType::seg3});
  return types;
}

struct OneCell {
  std::vector<Vector3d> points;
  std::vector<NodeIndex> nodes;
};

/// With its nodes where the reference cell has them.
OneCell reference_shape(CellType type) {
  OneCell one;
  for (int i = 0; i < cell::topology(type).node_count; ++i) {
    one.points.push_back(cell::reference_node(type, i));
    one.nodes.push_back(static_cast<NodeIndex>(i));
  }
  return one;
}

Vector3d random_point(std::mt19937& random, int dimension) {
  std::uniform_real_distribution<double> uniform(0, 0.3);
  Vector3d xi = Vector3d::Zero();
  for (int a = 0; a < dimension; ++a)
    xi[a] = uniform(random);
  return xi;
}

TEST(Position, IsThatOfTheNodeAtEachNode) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  for (const auto type : types_with_shape_functions()) {
    auto bent = reference_shape(type);
    for (auto& point : bent.points)
      point += Vector3d(shift(random), shift(random), shift(random));
    for (std::size_t i = 0; i < bent.points.size(); ++i)
      EXPECT_LT((position(type, bent.nodes, bent.points, cell::reference_node(type, static_cast<int>(i))) -
                 bent.points[i])
                    .norm(),
                1e-14)
          << cell::topology(type).name;
  }
}

TEST(Position, IsLinearWhereTheNodesAreAndQuadraticWhereTheCellIs) {
  std::mt19937 random(7);
  const auto map = [](const Vector3d& x, int order) {
    const Vector3d linear(0.3 + x[0] - 2 * x[1], x[1] + 0.5 * x[2], x[2] - 0.1 * x[0]);
    const Vector3d bent(x[0] * x[0] - x[0] * x[1], 3 * x[1] * x[2], x[2] * x[2]);
    return order == 1 ? linear : Vector3d(linear + bent);
  };
  for (const auto type : types_with_shape_functions()) {
    const auto& shape = cell::topology(type);
    auto mapped = reference_shape(type);
    for (auto& point : mapped.points)
      point = map(point, shape.order);
    for (int sample = 0; sample < 5; ++sample) {
      const auto xi = random_point(random, shape.dimension);
      EXPECT_LT((position(type, mapped.nodes, mapped.points, xi) - map(xi, shape.order)).norm(), 1e-13)
          << shape.name;
    }
  }
}

TEST(Position, PutsTheCentreOfAnEightNodeFaceWhereTheSerendipityRuleDoes) {
  auto face = reference_shape(CellType::quad8);
  for (std::size_t i = 0; i < face.points.size(); ++i)
    face.points[i] = Vector3d(i < 4 ? 1 : 0, i < 4 ? 0 : 1, 0);
  const auto centre = position(CellType::quad8, face.nodes, face.points, Vector3d::Zero());
  EXPECT_DOUBLE_EQ(centre[0], 4 * -0.25);
  EXPECT_DOUBLE_EQ(centre[1], 4 * 0.5);
}

TEST(Position, IsRefusedInEighteenNodePrisms) {
  const auto prism = reference_shape(CellType::penta18);
  EXPECT_THROW(position(CellType::penta18, prism.nodes, prism.points, Vector3d::Zero()),
               std::invalid_argument);
}

} // namespace
} // namespace rubato::mesh::interpolation_test
