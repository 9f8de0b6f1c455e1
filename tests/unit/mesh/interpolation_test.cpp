// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/interpolation.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"
#include <random>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;

std::vector<CellType> types_with_shape_functions() {
  auto types = test::all_types();
  types.insert(types.end(), {CellType::seg2, CellType::seg3});
  return types;
}

Vector3d random_point(std::mt19937& random, int dimension) {
  std::uniform_real_distribution<double> uniform(0, 0.3);
  Vector3d xi = Vector3d::Zero();
  for (int a = 0; a < dimension; ++a)
    xi[a] = uniform(random);
  return xi;
}

TEST(ShapeFunctions, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (const auto type : types_with_shape_functions())
    for (int i = 0; i < topology(type).node_count; ++i) {
      const auto values = shape_values(type, reference_node(type, i));
      for (int j = 0; j < topology(type).node_count; ++j)
        EXPECT_NEAR(values[static_cast<std::size_t>(j)], i == j ? 1 : 0, 1e-14) << topology(type).name;
    }
}

TEST(ShapeFunctions, ReproducePolynomialsOfTheirOrder) {
  std::mt19937 random(7);
  for (const auto type : types_with_shape_functions()) {
    const auto& shape = topology(type);
    const auto polynomial = [&](const Vector3d& x) {
      const double linear = 0.3 + x[0] - 2 * x[1] + 0.5 * x[2];
      return shape.order == 1 ? linear : linear + x[0] * x[0] - x[0] * x[1] + 3 * x[1] * x[2] + x[2] * x[2];
    };
    for (int sample = 0; sample < 5; ++sample) {
      const auto xi = random_point(random, shape.dimension);
      const auto values = shape_values(type, xi);
      double sum = 0;
      for (int i = 0; i < shape.node_count; ++i)
        sum += values[static_cast<std::size_t>(i)] * polynomial(reference_node(type, i));
      EXPECT_NEAR(sum, polynomial(xi), 1e-13) << shape.name;
    }
  }
}

TEST(ShapeFunctions, PutTheCentreOfAnEightNodeFaceWhereTheSerendipityRuleDoes) {
  const auto values = shape_values(CellType::quad8, Vector3d::Zero());
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_DOUBLE_EQ(values[i], i < 4 ? -0.25 : 0.5);
}

TEST(ShapeFunctions, AreRefusedForPyramids) {
  EXPECT_THROW(shape_values(CellType::pyra5, Vector3d::Zero()), std::invalid_argument);
}

} // namespace
} // namespace rubato::mesh
