// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a slave sees of a master with kinks, steps and layers.
#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"
#include <algorithm>

namespace rubato::nearest_test {
namespace {

using namespace contact::mortar;
using test::Map;
using test::Vector3d;

/// A surface over [low, high] whose height depends on x. In 2D the second parameter is none, and up is y.
Map profile(int dimension, double low, double high, const std::function<double(double)>& height) {
  return [=](double s, double t) -> Vector3d {
    const double x = low + s * (high - low);
    return dimension == 1 ? Vector3d(x, height(x), 0) : Vector3d(x, 3 * t, height(x));
  };
}

double least_gap(const Operators& operators) {
  double least = INFINITY;
  for (const auto& node : operators.nodes)
    if (node.kept())
      least = std::min(least, node.gap);
  return least;
}

struct EveryMasterFace : testing::TestWithParam<CellType> {
  int dimension() const { return cell::topology(GetParam()).dimension; }
  /// A flat slave of faces of length 1 whose edges are not where the master's are.
  test::TwoSurfaces over(double high, int master_faces, const std::function<double(double)>& height) const {
    return test::two_surfaces({.type = GetParam(), .along = 7, .across = 3},
                              profile(dimension(), 0.37, 7.37, [](double) { return 0.; }),
                              {.type = GetParam(), .along = master_faces, .across = 3},
                              profile(dimension(), 0, high, height));
  }
};

TEST_P(EveryMasterFace, SeesNoOverlapBeforeAKink) {
  for (const double slope : {0.02, 0.3, 1.})
    for (const double at : {3., 4.}) {
      const auto two = over(8, 8, [&](double x) { return -slope * std::max(0., x - at); });
      EXPECT_GE(least_gap(two.operators()), -1e-14) << slope;
      EXPECT_LT(least_gap(two.operators()), 1e-14) << slope;
    }
}

TEST_P(EveryMasterFace, SeesNoOverlapAboveARoundedMaster) {
  const auto two = over(8, 16, [](double x) { return -0.05 * (x - 4) * (x - 4); });
  EXPECT_GE(least_gap(two.operators()), -1e-14);
}

TEST_P(EveryMasterFace, SeesAnOverlapNoDeeperThanTwice) {
  const auto two = over(8, 8, [](double x) { return 0.01 - 0.3 * std::max(0., x - 4.); });
  EXPECT_LE(least_gap(two.operators()), -0.01 + 1e-13);
  EXPECT_GE(least_gap(two.operators()), -0.02 - 1e-13);
}

/// Two masters side by side, the right one lower.
test::TwoSurfaces with_step(CellType type, double step) {
  const int dimension = cell::topology(type).dimension;
  test::TwoSurfaces two;
  const auto slave = test::add_grid(two.mesh, {.type = type, .along = 7, .across = 3, .downwards = true},
                                    profile(dimension, 0.37, 7.37, [](double) { return 0.; }));
  auto master = test::add_grid(two.mesh, {.type = type, .along = 4, .across = 3},
                               profile(dimension, 0, 4, [](double) { return 0.; }));
  const auto right = test::add_grid(two.mesh, {.type = type, .along = 4, .across = 3},
                                    profile(dimension, 4, 8, [&](double) { return -step; }));
  master.insert(master.end(), right.begin(), right.end());
  two.slave = contact::make_surface(two.mesh, slave);
  two.master = contact::make_surface(two.mesh, master);
  return two;
}

TEST_P(EveryMasterFace, SeesNoOverlapAboveAStep) {
  for (const double step : {0.01, 0.2, 0.6})
    EXPECT_GE(least_gap(with_step(GetParam(), step).operators()), -1e-14) << step;
}

TEST_P(EveryMasterFace, LeavesOutWhatIsBesideButFarBelow) {
  const auto two = with_step(GetParam(), 0.9);
  for (const auto& node : two.operators().nodes) {
    if (!node.kept())
      continue;
    double above = 0, below = 0;
    for (std::size_t i = static_cast<std::size_t>(node.slave_nodes); i < node.stencil.nodes.size(); ++i) {
      const auto& x = two.mesh.points[static_cast<std::size_t>(node.stencil.nodes[i])];
      (x[dimension()] < -0.5 ? below : above) += std::abs(node.stencil.weights[static_cast<Eigen::Index>(i)]);
    }
    const double touching = std::abs(node.gap);
    if (touching < 1e-12) {
      EXPECT_EQ(below, 0);
    }
  }
}

TEST_P(EveryMasterFace, LeavesOutLayersBehindTheNearest) {
  for (const double thickness : {0.05, 0.4, 0.9}) {
    const auto height = [&](double) { return -thickness; };
    test::TwoSurfaces two;
    const auto slave =
        test::add_grid(two.mesh, {.type = GetParam(), .along = 7, .across = 3, .downwards = true},
                       profile(dimension(), 0.37, 7.37, [](double) { return 0.; }));
    auto master = test::add_grid(two.mesh, {.type = GetParam(), .along = 5, .across = 4},
                                 profile(dimension(), 0, 8, [](double) { return 0.; }));
    const auto behind = test::add_grid(two.mesh, {.type = GetParam(), .along = 3, .across = 3},
                                       profile(dimension(), 0, 8, height));
    master.insert(master.end(), behind.begin(), behind.end());
    two.slave = contact::make_surface(two.mesh, slave);
    two.master = contact::make_surface(two.mesh, master);
    const auto operators = two.operators();
    EXPECT_NEAR(operators.covered_area, dimension() == 1 ? 7 : 21, 1e-10) << thickness;
    for (const auto& node : operators.nodes)
      EXPECT_NEAR(node.gap, 0, 1e-13) << thickness;
    EXPECT_GT(two.operators({.all_layers = true}).covered_area, dimension() == 1 ? 13.9 : 41.9);
  }
}

INSTANTIATE_TEST_SUITE_P(Faces, EveryMasterFace,
                         testing::Values(CellType::seg2, CellType::seg3, CellType::tria3, CellType::tria6,
                                         CellType::tria7, CellType::quad4, CellType::quad8, CellType::quad9),
                         [](const auto& test) { return test::name_of(test.param); });

} // namespace
} // namespace rubato::nearest_test
