// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/point_numbers.hpp"
#include "rubato/domain/rank_states.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/thread_ranks.hpp"
#include <mutex>
#include <numeric>

namespace rubato::domain::rank_states_test {
namespace {

/// An elastic block between two that yield.
test::BuiltModel three_blocks() {
  return test::model_of(R"(mesh:
  generate:
    - {name: a, box: {from: [0, 0, 0], to: [3, 1, 1]}, divisions: [3, 2, 1], sides: {left: held}}
    - {name: b, box: {from: [0, 0, 2], to: [2, 1, 3]}, divisions: [2, 1, 1], sides: {left: held}}
    - {name: c, box: {from: [0, 0, 4], to: [2, 1, 5]}, divisions: [2, 2, 1], sides: {left: held}}
physics: solid
materials:
  soft: {young: 200e9, poisson: 0.3, density: 7800, law: plastic, hardening: {linear: {yield_stress: 2e8, modulus: 1e9}}, cells: [a, c]}
  hard: {young: 200e9, poisson: 0.3, density: 7800, cells: b}
supports: [{on: held, fix: [x, y, z]}]
time: {scheme: newmark, step: 1e-5, end: 1e-3}
)");
}

/// Every number another one.
QuadratureStates whole_of(const test::ModelParts& model) {
  auto states = initial_states(model.mesh, model.bulk);
  std::iota(states.values.begin(), states.values.end(), 1.0);
  constexpr std::size_t points_of_a_cell = 8, cells = 10;
  states.records.resize(cells * points_of_a_cell);
  std::vector<double> numbers(states.records.size() * numbers_of_a_point<element::PointRecord>());
  std::iota(numbers.begin(), numbers.end(), 0.5);
  put(numbers, states.records);
  states.mode_force = 3;
  return states;
}

class StatesOfRanks : public testing::TestWithParam<int> {};

TEST_P(StatesOfRanks, AreWholeAgain) {
  const auto model = three_blocks();
  const auto whole = whole_of(model);
  std::size_t all_records = 0;
  std::mutex turn;
  test::as_ranks(GetParam(), [&](const Ranks& ranks) {
    const RankParts parts(model.mesh, model.bulk, model.dofs, partition(model.mesh, model.bulk, ranks), {},
                          ranks);
    auto own = own_states(whole, model.mesh, model.bulk, parts);
    {
      const std::lock_guard lock(turn);
      all_records += own.records.size();
    }
    parts.clear_others(std::span(own.values),
                       [&](std::size_t place) { return state_size(model.mesh, model.bulk, place); });
    own.mode_force = ranks.index() + 4 - ranks.count();
    EXPECT_EQ(whole_states(own, model.mesh, model.bulk, parts), whole);
  });
  EXPECT_EQ(all_records, whole.records.size());
}

INSTANTIATE_TEST_SUITE_P(Ranks, StatesOfRanks, testing::Values(1, 2, 3, 16));

TEST(WholeStates, WithoutRecordsHaveNone) {
  const auto model = three_blocks();
  auto whole = whole_of(model);
  whole.records.clear();
  test::as_ranks(2, [&](const Ranks& ranks) {
    const RankParts parts(model.mesh, model.bulk, model.dofs, partition(model.mesh, model.bulk, ranks), {},
                          ranks);
    EXPECT_EQ(whole_states(own_states(whole, model.mesh, model.bulk, parts), model.mesh, model.bulk, parts)
                  .records.size(),
              0);
  });
}

TEST(NumbersOfPoints, ComeBack) {
  std::vector<LawPoint> points(3);
  std::vector<double> numbers(points.size() * numbers_of_a_point<LawPoint>());
  std::iota(numbers.begin(), numbers.end(), 1.0);
  put(numbers, points);
  EXPECT_EQ(points[2].stress[5], numbers.back());
  EXPECT_EQ(numbers_of(points), numbers);
}

} // namespace
} // namespace rubato::domain::rank_states_test
