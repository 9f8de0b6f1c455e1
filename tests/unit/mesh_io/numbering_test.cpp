// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/med_numbering.hpp"

#include <gtest/gtest.h>

#include "one_cell.hpp"
#include <array>

namespace rubato::mesh::numbering_test {
namespace {

/// The points of a cell in its reference shape, in MED's order.
test::Points in_med_order(CellType type) {
  const auto ours = test::filled(type, test::reference_corners(type));
  const auto order = med::node_order(type);
  auto theirs = ours;
  for (std::size_t i = 0; i < order.size(); ++i)
    theirs[order[i]] = ours[i];
  return theirs;
}

TEST(MedNumbering, IsMirroredForSolidsAndOursForTheRest) {
  for (const auto& cell : cell::all_topologies()) {
    SCOPED_TRACE(cell.name);
    EXPECT_EQ(med::node_order(cell.type).empty(), cell.dimension < 3);
    if (cell.dimension == 3) {
      EXPECT_DOUBLE_EQ(test::measure(cell.type, in_med_order(cell.type)),
                       -test::measure(cell.type, test::reference_corners(cell.type)));
    }
  }
}

// MED's edges are listed as ours are, by MED's own corners.
TEST(MedNumbering, HasEdgeNodesInTheMiddleOfMedsEdges) {
  for (const auto& cell : cell::all_topologies()) {
    if (cell.order == 1)
      continue;
    SCOPED_TRACE(cell.name);
    const auto points = in_med_order(cell.type);
    for (std::size_t edge = 0; edge < cell.edges.size(); ++edge)
      EXPECT_EQ(points[static_cast<std::size_t>(cell.corner_count) + edge],
                test::mean_of(points, cell.edges[edge], 2))
          << edge;
  }
}

TEST(MedNumbering, HasFaceNodesInTheMiddleOfMedsFaces) {
  const std::vector<std::array<int, 4>> faces_of_hexa{{0, 1, 2, 3}, {0, 4, 5, 1}, {1, 5, 6, 2},
                                                      {2, 6, 7, 3}, {3, 7, 4, 0}, {4, 7, 6, 5}};
  const auto hexa = in_med_order(CellType::hexa27);
  for (std::size_t face = 0; face < faces_of_hexa.size(); ++face)
    EXPECT_EQ(hexa[20 + face], test::mean_of(hexa, faces_of_hexa[face], 4)) << face;
  EXPECT_EQ(hexa[26], Eigen::Vector3d::Zero().eval());

  const std::vector<std::array<int, 4>> faces_of_penta{{0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  const auto penta = in_med_order(CellType::penta18);
  for (std::size_t face = 0; face < faces_of_penta.size(); ++face)
    EXPECT_EQ(penta[15 + face], test::mean_of(penta, faces_of_penta[face], 4)) << face;
}

TEST(MedNumbering, NamesEveryCellTypeBothWays) {
  for (const auto& cell : cell::all_topologies())
    EXPECT_EQ(med::type_of_geometry(med::geometry_of(cell.type)), cell.type);
  EXPECT_EQ(med::geometry_of(CellType::hexa20), 320);
  EXPECT_FALSE(med::type_of_geometry(400));
}

} // namespace
} // namespace rubato::mesh::numbering_test
