// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/nodal_pressure.hpp"

#include <gtest/gtest.h>

#include "unit/contact/two_faces.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::contact::nodal_pressure_test {
namespace {

using test::two_faces;

struct Points {
  std::string name;
  CellType face;
  int gauss;
  study::ContactMethod method = study::ContactMethod::augmented_lagrangian;
};

class NodalPressure : public testing::TestWithParam<Points> {
protected:
  Zone zone_ = [] {
    auto faces = two_faces(
        {.slave = GetParam().face,
         .master = cell::topology(GetParam().face).dimension == 1 ? CellType::seg2 : CellType::quad4,
         .gauss = GetParam().gauss});
    auto settings = faces.zone.settings;
    settings.method = GetParam().method;
    return make_zone(faces.mesh, settings, faces.zone.master, faces.zone.slave, {},
                     {faces.mesh.dimension, 1.0, {}});
  }();

  /// Pressures of the points from those of the nodes, p(i), by the face's shape functions.
  template <class Pressure> ZoneState state_of(const Pressure& pressure) const {
    auto state = initial_state(zone_);
    state.outcomes.assign(zone_.points.size(), {});
    for (std::size_t i = 0; i < zone_.points.size(); ++i) {
      const auto& point = zone_.points[i];
      for (std::size_t j = 0; j < point.multipliers.size(); ++j)
        state.outcomes[i].pressure += point.multiplier_shape[j] * pressure(point.multipliers[j]);
    }
    for (int i = 0; i < static_cast<int>(zone_.slave.nodes.size()); ++i)
      if (zone_.multipliers_per_node() > 0)
        state.multipliers[static_cast<Eigen::Index>(i) * zone_.multipliers_per_node()] = pressure(i);
    return state;
  }
};

TEST_P(NodalPressure, IsUniformWhereThePointsHaveAllTheSame) {
  const auto found = nodal_pressure(zone_, state_of([](int) { return 3.5; }));
  ASSERT_EQ(found.size(), zone_.slave.nodes.size());
  for (const double pressure : found)
    EXPECT_NEAR(pressure, 3.5, 1e-13);
}

/// A multiplier is the node's own; means of points lie between the least and the largest of them.
TEST_P(NodalPressure, IsTheNodesOwnOrBetweenThoseOfItsPoints) {
  const auto own = [](int i) { return 1.0 + i; };
  const auto state = state_of(own);
  const auto found = nodal_pressure(zone_, state);
  double least = INFINITY, largest = -INFINITY;
  for (const auto& outcome : state.outcomes) {
    least = std::min(least, outcome.pressure);
    largest = std::max(largest, outcome.pressure);
  }
  for (std::size_t i = 0; i < found.size(); ++i)
    if (GetParam().method == study::ContactMethod::augmented_lagrangian) {
      EXPECT_EQ(found[i], own(static_cast<int>(i)));
    } else {
      EXPECT_GE(found[i], least - 1e-13);
      EXPECT_LE(found[i], largest + 1e-13);
    }
}

constexpr auto penalty = study::ContactMethod::penalty;

INSTANTIATE_TEST_SUITE_P(
    On, NodalPressure,
    testing::Values(Points{"Segments", CellType::seg2, 0},
                    Points{"SegmentsByPenalty", CellType::seg3, 0, penalty},
                    Points{"SegmentsByPenaltyAtGaussPoints", CellType::seg3, 2, penalty},
                    Points{"Quadrangles", CellType::quad4, 0},
                    Points{"QuadranglesAtGaussPoints", CellType::quad8, 3},
                    Points{"QuadranglesByPenaltyAtGaussPoints", CellType::quad4, 2, penalty},
                    Points{"SerendipityByPenalty", CellType::quad8, 0, penalty},
                    Points{"QuadraticTriangles", CellType::tria6, 0},
                    Points{"QuadraticTrianglesByPenalty", CellType::tria6, 0, penalty},
                    Points{"NodalForces", CellType::quad4, 0, study::ContactMethod::nodal_penalty}),
    [](const auto& points) { return points.param.name; });

} // namespace
} // namespace rubato::contact::nodal_pressure_test
