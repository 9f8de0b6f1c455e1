// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"
#include <numeric>

namespace rubato::kept_test {
namespace {

using namespace contact::mortar;
using test::Vector3d;

/// A row of slave faces of length 1, and pieces of a master below.
test::TwoSurfaces row_of_faces(CellType type, int faces, const std::vector<std::array<double, 2>>& pieces) {
  test::TwoSurfaces two;
  const auto slave = test::add_grid(two.mesh, {.type = type, .along = faces, .downwards = true},
                                    [&](double s, double) { return Vector3d(faces * s, 0, 0); });
  std::vector<contact::Face> master;
  for (const auto& [from, to] : pieces) {
    const auto piece =
        test::add_grid(two.mesh, {.type = CellType::seg2}, [from = from, to = to](double s, double) {
          return Vector3d(from + s * (to - from), 0, 0);
        });
    master.insert(master.end(), piece.begin(), piece.end());
  }
  two.slave = contact::make_surface(two.mesh, slave);
  two.master = contact::make_surface(two.mesh, master);
  return two;
}

/// The slave node at that place.
const Node& at(const test::TwoSurfaces& two, const Operators& operators, double x) {
  for (std::size_t j = 0; j < two.slave.nodes.size(); ++j)
    if (std::abs(two.mesh.points[static_cast<std::size_t>(two.slave.nodes[j])][0] - x) < 1e-9)
      return operators.nodes[j];
  throw std::invalid_argument("no node there");
}

/// Nothing is lost: forces of a uniform pressure are those of the covered part.
void expect_consistent(const test::TwoSurfaces& two, const Operators& operators, double area) {
  EXPECT_NEAR(operators.covered_area, area, 1e-15);
  EXPECT_EQ(operators.lost_area, 0);
  const auto forces = test::forces_of_unit_pressure(two, operators);
  const auto master = test::integrals_of_shapes(two.mesh, two.master);
  for (const auto node : two.master.nodes)
    EXPECT_NEAR(-forces[static_cast<std::size_t>(node)], master[static_cast<std::size_t>(node)], 1e-14);
  EXPECT_NEAR(std::accumulate(forces.begin(), forces.end(), 0.), 0, 1e-14);
}

TEST(DroppedNodes, GiveTheirFunctionToTheKeptNodesOfTheSubFacet) {
  const auto two = row_of_faces(CellType::seg2, 2, {{0, 1.05}});
  const auto operators = two.operators();
  const auto& dropped = at(two, operators, 2);
  EXPECT_EQ(dropped.cover, Cover::dropped);
  EXPECT_TRUE(dropped.stencil.nodes.empty());
  EXPECT_EQ(dropped.weight, 0);
  ASSERT_EQ(dropped.receivers.size(), 1U);
  EXPECT_EQ(&operators.nodes[static_cast<std::size_t>(dropped.receivers[0])], &at(two, operators, 1));
  EXPECT_NEAR(at(two, operators, 1).weight, 0.55, 1e-15);
  expect_consistent(two, operators, 1.05);
}

TEST(DroppedNodes, WithoutKeptOnesInTheSubFacetGiveToThoseOfTheFace) {
  const auto two = row_of_faces(CellType::seg3, 2, {{0.1, 0.102}, {1, 2}});
  const auto operators = two.operators();
  EXPECT_EQ(at(two, operators, 0).cover, Cover::dropped);
  EXPECT_EQ(at(two, operators, 0.5).cover, Cover::dropped);
  EXPECT_EQ(at(two, operators, 0.5).receivers, at(two, operators, 0).receivers);
  ASSERT_EQ(at(two, operators, 0).receivers.size(), 1U);
  EXPECT_NEAR(at(two, operators, 1).weight, 0.25 + 0.002, 1e-15);
  expect_consistent(two, operators, 1.002);
}

TEST(DroppedNodes, WithoutKeptOnesInTheFaceGiveToThoseOfTheFacesAround) {
  const auto two = row_of_faces(CellType::seg3, 3, {{0.1, 0.102}, {2, 3}});
  const auto operators = two.operators();
  EXPECT_EQ(at(two, operators, 0).cover, Cover::dropped);
  EXPECT_EQ(at(two, operators, 1).cover, Cover::none);
  EXPECT_EQ(at(two, operators, 1.5).cover, Cover::none);
  EXPECT_NEAR(at(two, operators, 2).weight, 0.25 + 0.002, 1e-15);
  expect_consistent(two, operators, 1.002);
}

TEST(DroppedNodes, AreKeptWhereNobodyAroundCouldTakeTheirFunction) {
  const auto two = row_of_faces(CellType::seg3, 4, {{0.1, 0.102}, {3, 4}});
  const auto operators = two.operators();
  EXPECT_TRUE(at(two, operators, 0).kept());
  EXPECT_TRUE(at(two, operators, 0.5).kept());
  EXPECT_EQ(at(two, operators, 1).cover, Cover::none);
  expect_consistent(two, operators, 1.002);
}

TEST(KeptNodes, HaveAtLeastFivePercentOfTheirFullWeight) {
  // A piece of length a at the end of a face covers a²/2 of 1/2 there.
  EXPECT_TRUE(at(row_of_faces(CellType::seg2, 1, {{0, 0.225}}),
                 row_of_faces(CellType::seg2, 1, {{0, 0.225}}).operators(), 1)
                  .kept());
  EXPECT_FALSE(at(row_of_faces(CellType::seg2, 1, {{0, 0.222}}),
                  row_of_faces(CellType::seg2, 1, {{0, 0.222}}).operators(), 1)
                   .kept());
}

TEST(KeptNodes, CanBeToldTo) {
  const auto two = row_of_faces(CellType::seg2, 2, {{0, 1.05}});
  std::vector<Keep> keep(two.slave.nodes.size(), Keep::by_cover);
  keep.front() = Keep::never;
  keep.back() = Keep::always;
  const auto operators = two.operators({.keep = keep});
  EXPECT_EQ(operators.nodes.front().cover, Cover::dropped);
  EXPECT_TRUE(operators.nodes.back().kept());
  EXPECT_EQ(operators.kept_count, 2);
  expect_consistent(two, operators, 1.05);
}

TEST(KeptNodes, ThatAreForbiddenEverywhereLoseTheirArea) {
  const auto two = row_of_faces(CellType::seg2, 2, {{0, 2}});
  const std::vector<Keep> keep(two.slave.nodes.size(), Keep::never);
  const auto operators = two.operators({.keep = keep});
  EXPECT_EQ(operators.kept_count, 0);
  EXPECT_NEAR(operators.lost_area, 2, 1e-15);
}

TEST(NodesThatNeverMeet, HaveNoWeightAndNoHeirs) {
  const auto two = row_of_faces(CellType::seg2, 3, {{0, 0.9}});
  const auto operators = two.operators();
  const auto& far = at(two, operators, 3);
  EXPECT_EQ(far.cover, Cover::none);
  EXPECT_EQ(far.weight, 0);
  EXPECT_TRUE(far.receivers.empty());
  EXPECT_EQ(gap_vector(far, test::reading(two.mesh.points)), Vector3d::Zero());
}

} // namespace
} // namespace rubato::kept_test
