// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/rank_parts.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/thread_ranks.hpp"
#include <algorithm>
#include <mutex>
#include <numeric>

namespace rubato::domain::rank_parts_test {
namespace {

using Eigen::VectorXd;

test::BuiltModel box(int x, int y, int z) {
  return test::model_of(
      fmt::format(R"(mesh: {{generate: [{{name: box, box: {{from: [0, 0, 0], to: [{}, {}, {}]}},
  divisions: [{}, {}, {}], sides: {{left: held}}}}]}}
physics: solid
materials: {{steel: {{young: 200e9, poisson: 0.3, density: 7800}}}}
supports: [{{on: held, fix: [x, y, z]}}]
time: {{scheme: newmark, step: 1e-5, end: 1e-3}}
)",
                  x, y, z, x, y, z));
}

/// What a cell adds at its nodes: another number at each.
void add_cell(const test::ModelParts& model, std::size_t place, VectorXd& sum) {
  const auto nodes = model.mesh.nodes_of(model.bulk.cells[place]);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int i = 0; i < model.dofs.components; ++i)
      sum[model.dofs.dof(nodes[n], i)] +=
          1.0 / static_cast<double>(3 + place * 24 + n * 3 + static_cast<std::size_t>(i));
}

VectorXd by_one(const test::ModelParts& model) {
  VectorXd sum = VectorXd::Zero(model.dofs.dof_count);
  for (std::size_t place = 0; place < model.bulk.cells.size(); ++place)
    add_cell(model, place, sum);
  return sum;
}

class Parts : public testing::TestWithParam<int> {};

TEST_P(Parts, HaveEveryCellOnce) {
  const auto model = box(5, 4, 3);
  std::vector<int> counted(model.bulk.cells.size(), 0);
  std::mutex turn;
  test::as_ranks(GetParam(), [&](const Ranks& ranks) {
    const auto rank_of_cell = partition(model.mesh, model.bulk, ranks);
    const RankParts parts(model.mesh, model.bulk, model.dofs, rank_of_cell, {}, ranks);
    const std::lock_guard lock(turn);
    for (const auto place : parts.places())
      ++counted[place];
    EXPECT_EQ(parts.cells().size(), parts.places().size());
  });
  EXPECT_TRUE(std::ranges::all_of(counted, [](int times) { return times == 1; }));
}

TEST_P(Parts, AddUpToWhatOneProcessHas) {
  const auto model = box(5, 4, 3);
  const auto whole = by_one(model);
  const std::vector<mesh::NodeIndex> everywhere{0, 1, 2, 50};
  test::as_ranks(GetParam(), [&](const Ranks& ranks) {
    const RankParts parts(model.mesh, model.bulk, model.dofs, partition(model.mesh, model.bulk, ranks),
                          everywhere, ranks);
    VectorXd sum = VectorXd::Zero(model.dofs.dof_count);
    for (const auto place : parts.places())
      add_cell(model, place, sum);
    EXPECT_EQ(parts.add_up(sum, ranks.index() == 1), ranks.count() > 1 ? 1 : 0);
    for (const auto node : everywhere)
      EXPECT_TRUE(parts.knows(model.dofs.dof(node, 0)));
    for (int dof = 0; dof < sum.size(); ++dof)
      if (parts.knows(dof))
        EXPECT_NEAR(sum[dof], whole[dof], 1e-15 * whole[dof]);
    // The same bits on all ranks that know a number.
    VectorXd same = sum;
    parts.make_whole(same);
    for (int dof = 0; dof < sum.size(); ++dof)
      if (parts.knows(dof))
        EXPECT_EQ(sum[dof], same[dof]);
    EXPECT_LE((same - whole).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(ranks.sum(parts.owned().sum()), model.dofs.dof_count);
  });
}

TEST_P(Parts, MakeNumbersOfCellsWhole) {
  const auto model = box(3, 2, 2);
  const auto size_of = [](std::size_t place) { return place % 3; };
  std::size_t size = 0;
  for (std::size_t place = 0; place < model.bulk.cells.size(); ++place)
    size += size_of(place);
  test::as_ranks(GetParam(), [&](const Ranks& ranks) {
    const RankParts parts(model.mesh, model.bulk, model.dofs, partition(model.mesh, model.bulk, ranks), {},
                          ranks);
    std::vector<double> expected(size), values(size, -1);
    std::iota(expected.begin(), expected.end(), 1.0);
    std::size_t first = 0;
    for (std::size_t place = 0; place < model.bulk.cells.size(); ++place) {
      if (std::ranges::binary_search(parts.places(), place))
        std::copy_n(expected.begin() + static_cast<std::ptrdiff_t>(first), size_of(place),
                    values.begin() + static_cast<std::ptrdiff_t>(first));
      first += size_of(place);
    }
    parts.make_whole(std::span(values), size_of);
    EXPECT_EQ(values, expected);
  });
}

/// A rank may have no cells.
TEST_P(Parts, OfOneCell) {
  const auto model = box(1, 1, 1);
  test::as_ranks(GetParam(), [&](const Ranks& ranks) {
    const RankParts parts(model.mesh, model.bulk, model.dofs, partition(model.mesh, model.bulk, ranks), {},
                          ranks);
    VectorXd sum = VectorXd::Zero(model.dofs.dof_count);
    for (const auto place : parts.places())
      add_cell(model, place, sum);
    parts.add_up(sum);
    parts.make_whole(sum);
    EXPECT_EQ(sum, by_one(model));
  });
}

INSTANTIATE_TEST_SUITE_P(Ranks, Parts, testing::Values(1, 2, 3, 7));

} // namespace
} // namespace rubato::domain::rank_parts_test
