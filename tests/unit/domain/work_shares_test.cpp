// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/work_shares.hpp"
#include "rubato/mesh/generate.hpp"
#include "rubato/study/mesh_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::domain::work_shares_test {
namespace {

/// A box of n³ cubes.
mesh::Mesh box(int n) {
  study::Body body;
  body.name = "box";
  body.from = {0, 0, 0};
  body.to = {1, 1, 1};
  body.divisions = {n, n, n};
  body.cells = CellType::hexa8;
  return mesh::generate(std::vector{body}, 1);
}

/// Its cubes, in an order without any.
std::vector<mesh::CellIndex> cubes(const mesh::Mesh& mesh) {
  std::vector<mesh::CellIndex> cells;
  for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
    if (mesh.type_of(cell) == CellType::hexa8)
      cells.push_back(cell);
  std::mt19937 random(3);
  std::ranges::shuffle(cells, random);
  return cells;
}

TEST(WorkShares, HaveEveryCellOnceInAscendingOrder) {
  const auto mesh = box(13);
  const auto cells = cubes(mesh);
  const WorkShares shares(mesh, cells, Threads(3));
  ASSERT_EQ(shares.count(), 3);
  std::set<std::uint32_t> all;
  for (int share = 0; share < 3; ++share) {
    EXPECT_TRUE(std::ranges::is_sorted(shares.of(share)));
    EXPECT_NEAR(static_cast<double>(shares.of(share).size()), 2197. / 3, 3);
    all.insert(shares.of(share).begin(), shares.of(share).end());
  }
  EXPECT_EQ(all.size(), cells.size());
}

TEST(WorkShares, KnowWhereTheyMeet) {
  const auto mesh = box(13);
  const auto cells = cubes(mesh);
  const WorkShares shares(mesh, cells, Threads(2));
  std::vector<std::set<int>> shares_of_node(mesh.points.size());
  for (int share = 0; share < 2; ++share)
    for (const auto place : shares.of(share))
      for (const auto node : mesh.nodes_of(cells[place]))
        shares_of_node[static_cast<std::size_t>(node)].insert(share);
  for (std::size_t node = 0; node < mesh.points.size(); ++node)
    EXPECT_EQ(shares.is_shared(static_cast<mesh::NodeIndex>(node)), shares_of_node[node].size() > 1);
  EXPECT_TRUE(std::ranges::is_sorted(shares.border()));
  // Two layers on both sides of a cut through the middle, which a layer of 13 cells makes uneven.
  EXPECT_GE(shares.border().size(), 2U * 13 * 13);
  EXPECT_LE(shares.border().size(), 4U * 13 * 13);
  for (std::size_t place = 0; place < cells.size(); ++place) {
    const bool meets =
        std::ranges::any_of(mesh.nodes_of(cells[place]), [&](auto node) { return shares.is_shared(node); });
    const auto in_border = shares.place_in_border(place);
    EXPECT_EQ(in_border >= 0, meets);
    if (in_border >= 0) {
      EXPECT_EQ(shares.border()[static_cast<std::size_t>(in_border)], place);
    }
  }
}

TEST(WorkShares, AreOneWhereFewCellsDoNotPay) {
  const auto mesh = box(8);
  const auto cells = cubes(mesh);
  const WorkShares shares(mesh, cells, Threads(4));
  EXPECT_EQ(shares.count(), 1);
  EXPECT_EQ(shares.of(0).size(), cells.size());
  EXPECT_TRUE(shares.border().empty());
  EXPECT_EQ(shares.place_in_border(3), -1);
}

TEST(WorkShares, ThrowWhatTheFirstCellThrows) {
  const auto mesh = box(13);
  const auto cells = cubes(mesh);
  const WorkShares shares(mesh, cells, Threads(4));
  ASSERT_EQ(shares.count(), 4);
  for (int again = 0; again < 20; ++again) {
    try {
      shares.each([](int, std::size_t cell) {
        if (cell % 100 == 77)
          throw std::runtime_error(std::to_string(cell));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "77");
    }
  }
}

TEST(WorkShares, OfNoCellsDoNothing) {
  WorkShares().each([](int, std::size_t) { FAIL(); });
  WorkShares(box(2), {}, Threads(2)).each([](int, std::size_t) { FAIL(); });
}

} // namespace
} // namespace rubato::domain::work_shares_test
