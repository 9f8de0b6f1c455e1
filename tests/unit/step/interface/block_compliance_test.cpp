// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/split_factor.hpp"
#include "rubato/step/interface/block_compliance.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "unit/linalg/elastic_block.hpp"
#include <limits>
#include <numeric>
#include <vector>

namespace rubato::step::block_compliance_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A strip on springs whose unknowns are all its surface, eliminated within it.
linalg::SplitFactor factored_strip() {
  auto matrix = test::elastic_block(30, 3, 1);
  const double springs = 0.01 * matrix.diagonal().maxCoeff();
  for (int i = 0; i < matrix.rows(); ++i)
    matrix.coeffRef(i, i) += springs;
  std::vector<int> surface(static_cast<std::size_t>(matrix.rows()));
  std::iota(surface.begin(), surface.end(), 0);
  return std::move(*linalg::SplitFactor::of(matrix, surface, std::numeric_limits<std::size_t>::max(),
                                            [](std::size_t) {}, {.last = 0}));
}

TEST(BlockCompliance, IsTheSameWhereWhatWasKnownIsForgottenForItsMemory) {
  const auto factor = factored_strip();
  const auto* surface = factor.surface_within(0);
  ASSERT_NE(surface, nullptr);
  BlockCompliance keeping(*surface);
  BlockCompliance forgetting(*surface, 1);
  for (const int first : {0, 40, 3}) {
    std::vector<int> positions;
    for (int i = first; i < surface->size(); i += 7)
      positions.push_back(i);
    MatrixXd kept, formed;
    keeping.between(positions, kept);
    forgetting.between(positions, formed);
    EXPECT_EQ(kept, formed);
    EXPECT_EQ(forgetting.own(positions[1]), kept(1, 1));
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(surface->size());
    unit[positions[1]] = 1;
    const Eigen::VectorXd moved = surface->moved_by(unit);
    for (std::size_t i = 0; i < positions.size(); ++i)
      EXPECT_NEAR(kept(static_cast<Index>(i), 1), moved[positions[i]], 1e-12 * kept(1, 1));
  }
}

} // namespace
} // namespace rubato::step::block_compliance_test
