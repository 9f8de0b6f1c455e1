// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/plane_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace rubato::plane_map_test {
namespace {

using namespace contact;
using namespace contact::mortar;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::array faces{CellType::tria3, CellType::tria6, CellType::tria7,
                           CellType::quad4, CellType::quad8, CellType::quad9};

/// A face whose nodes are moved by up to a tenth of its size.
FaceCoordinates bent(CellType type) {
  const auto& cell = cell::reference_cell(type);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  FaceCoordinates nodes(3, cell.node_count);
  for (int i = 0; i < cell.node_count; ++i)
    nodes.col(i) =
        cell.nodes[static_cast<std::size_t>(i)] + Vector3d(shift(random), shift(random), shift(random));
  return nodes;
}

class PlaneMapOf : public testing::TestWithParam<CellType> {
protected:
  CellType type = GetParam();
  FaceCoordinates nodes = bent(type);
  PlaneMap map = PlaneMap(type, nodes);

  /// Σ N_k p_k by the shape functions of the cell.
  Vector3d position(const Vector2d& xi) const { return face_position(type, nodes, xi); }
};

/// Twenty places inside.
std::vector<Vector2d> places_inside() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(0.02, 0.45);
  std::vector<Vector2d> places;
  while (places.size() < PlanePlaces::capacity)
    places.emplace_back(value(random), value(random));
  return places;
}

TEST_P(PlaneMapOf, FindsThePlacesOfManyPoints) {
  const auto expected = places_inside();
  PlanePlaces places(expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    places.start(i, position(expected[i]).head<2>(), {0.3, 0.3});
  map.find(places);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto at = map.place_at(expected[i]);
    EXPECT_EQ(places.found[i], 1) << i;
    EXPECT_LE((places.xi_at(i) - expected[i]).norm(), 1e-13) << i;
    EXPECT_NEAR(places.height[i], position(expected[i])[2], 1e-13) << i;
    EXPECT_NEAR(places.determinant[i], at.determinant, 1e-12) << i;
  }
}

/// Each is as it would be alone, to the bit: one point's rounds do not depend on its company.
TEST_P(PlaneMapOf, FindsEachAsIfItWereAlone) {
  const auto inside = places_inside();
  PlanePlaces together(inside.size());
  for (std::size_t i = 0; i < inside.size(); ++i)
    together.start(i, position(inside[i]).head<2>(), i % 3 == 0 ? inside[i] : Vector2d(0.3, 0.3));
  const auto started = together;
  map.find(together);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    PlanePlaces alone(1);
    alone.start(0, started.point_at(i), started.xi_at(i));
    map.find(alone);
    EXPECT_EQ(alone.xi_at(0), together.xi_at(i)) << i;
    EXPECT_EQ(alone.height[0], together.height[i]) << i;
    EXPECT_EQ(alone.determinant[0], together.determinant[i]) << i;
  }
}

TEST_P(PlaneMapOf, SaysWhichPointsAreFarFromTheFace) {
  PlanePlaces places(3);
  places.start(0, position({0.2, 0.3}).head<2>(), {0.3, 0.3});
  places.start(1, {50, -70}, {0.3, 0.3});
  places.start(2, position({0.3, 0.2}).head<2>(), {0.3, 0.3});
  map.find(places);
  EXPECT_EQ(places.found[0], 1);
  EXPECT_EQ(places.found[1], 0);
  EXPECT_EQ(places.found[2], 1);
}

TEST_P(PlaneMapOf, HasThePolynomialOfTheShapeFunctions) {
  for (const auto& xi : places_inside()) {
    const auto shape = face_geometry(type, nodes, xi);
    const auto polynomial = FacePolynomial(type, nodes).at(xi);
    EXPECT_LE((polynomial.position - shape.position).norm(), 1e-14);
    EXPECT_LE((polynomial.by_first - shape.tangents.col(0)).norm(), 1e-14);
    EXPECT_LE((polynomial.by_second - shape.tangents.col(1)).norm(), 1e-14);
    std::array<double, 9> values{};
    map.set_values(xi, values);
    const auto expected = face_values(type, xi);
    for (std::size_t k = 0; k < static_cast<std::size_t>(nodes.cols()); ++k)
      EXPECT_NEAR(values[k], expected[k], 1e-15) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Faces, PlaneMapOf, testing::ValuesIn(faces),
                         [](const auto& chosen) { return std::string(cell::topology(chosen.param).name); });

} // namespace
} // namespace rubato::plane_map_test
