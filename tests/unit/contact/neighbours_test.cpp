// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/neighbours.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "unit/contact/flattened_ring.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace rubato::contact::neighbours_test {
namespace {

/// The upper beam's face, the master, bends and slides along the lower one, which lifts and turns.
Eigen::VectorXd sliding(const test::ModelParts& model, double t) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.dofs.dof_count);
  for (const auto node : model.dofs.nodes) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    const bool upper = model.zones.front().master.position_of(node) >= 0;
    u[model.dofs.dof(node, 0)] = 0.3 * (upper ? t : 0) + 0.2 * t * t * x[1];
    u[model.dofs.dof(node, 1)] = 0.4 * std::sin(3 * t) + (upper ? -0.05 : 0.1) * t * x[0] * x[0];
  }
  return u;
}

TEST(NeighbourList, FindsThePairsOfAFullSearchWhileBodiesSlide) {
  for (const auto* cells : {"quad4", "quad9"}) {
    const auto model =
        test::model_of(test::two_beams, {{"mesh.generate.0.cells", cells}, {"mesh.generate.1.cells", cells}});
    const auto& zone = model.zones.front();
    NeighbourList list(zone);
    constexpr int steps = 400;
    int unpaired = 0;
    for (int i = 0; i <= steps; ++i) {
      const auto u = sliding(model, static_cast<double>(i) / steps);
      const Configuration configuration{&model.mesh, &model.dofs, &u, &u};
      list.update(configuration);
      const auto expected = find_pairs(zone, configuration);
      for (std::size_t p = 0; p < expected.size(); ++p) {
        ASSERT_EQ(list.pairs()[p].master_face, expected[p].master_face) << "step " << i << ", point " << p;
        EXPECT_EQ(list.pairs()[p].projection.clamped, expected[p].projection.clamped);
        unpaired += expected[p].paired() ? 0 : 1;
      }
    }
    EXPECT_GT(unpaired, 0) << "the motion is to leave some points alone";
    EXPECT_GT(list.searches(), 2);
    EXPECT_LT(list.searches(), steps / 5);
  }
}

TEST(NeighbourList, SearchesNoMoreWhenTheBodiesMoveTogether) {
  const auto model = test::model_of(test::two_beams);
  NeighbourList list(model.zones.front());
  for (const double shift : {0.0, 1.0, 50.0}) {
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(model.dofs.dof_count, shift);
    list.update({&model.mesh, &model.dofs, &u, &u});
  }
  EXPECT_EQ(list.searches(), 1);
}

/// The master shifted along the slave, whose nodes lie on its nodes.
class NodesOnNodes : public testing::Test {
protected:
  void shift(double in_edges) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(model_.dofs.dof_count);
    for (const auto node : zone_.master.nodes)
      u[model_.dofs.dof(node, 0)] = in_edges * zone_.edge();
    const Configuration configuration{&model_.mesh, &model_.dofs, &u, &u};
    list_.update(configuration);
    searched_ = find_pairs(zone_, configuration);
  }
  /// Points that are on another face than a search would put them on.
  std::ptrdiff_t held() const {
    std::ptrdiff_t count = 0;
    for (std::size_t p = 0; p < searched_.size(); ++p)
      count += list_.pairs()[p].master_face != searched_[p].master_face ? 1 : 0;
    return count;
  }

  const test::BuiltModel model_ = test::model_of(test::two_beams);
  const Zone& zone_ = model_.zones.front();
  NeighbourList list_{zone_};
  std::vector<Pair> searched_;
};

TEST_F(NodesOnNodes, StayOnAFaceTheyComeBackToAndAreLetGoOnceBeyondItsBorder) {
  for (const double hop : {0.02, -0.02, 0.02, -0.02, 1e-5, -1e-5})
    shift(hop);
  const double beyond = held() > 0 ? -1e-5 : 1e-5;
  shift(beyond);
  EXPECT_GT(held(), 5);
  EXPECT_TRUE(list_.release_beyond_borders());
  shift(beyond);
  EXPECT_EQ(held(), 0);
  for (const double hop : {-1, 1, -1, 1})
    shift(hop * beyond);
  EXPECT_FALSE(list_.release_beyond_borders()) << "they hop indeed";
  list_.forget_visits();
  shift(beyond);
  EXPECT_EQ(held(), 0);
}

TEST_F(NodesOnNodes, StandOnTheBorderATraceBeyondIt) {
  for (const double hop : {0.02, -0.02, 0.02, -0.02, 1e-7, -1e-7, 1e-7})
    shift(hop);
  EXPECT_FALSE(list_.release_beyond_borders());
}

/// Dofs of every node of a plane mesh.
domain::DofMap dofs_of(const mesh::Mesh& mesh) {
  domain::DofMap dofs;
  dofs.components = 2;
  for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) {
    dofs.first_dof.push_back(2 * node);
    dofs.nodes.push_back(node);
  }
  dofs.dof_count = 2 * mesh.node_count();
  return dofs;
}

Zone zone_with_itself(const test::Line& line) {
  study::ContactZone settings;
  settings.self = settings.master = settings.slave = "skin";
  return make_zone(line.mesh, settings, line.surface, line.surface, {}, {2, 1.0, {}});
}

Eigen::VectorXd displacement_to(const std::vector<Eigen::Vector3d>& x, const mesh::Mesh& mesh) {
  Eigen::VectorXd u(2 * mesh.node_count());
  for (std::size_t node = 0; node < x.size(); ++node)
    u.segment<2>(2 * static_cast<Eigen::Index>(node)) = (x[node] - mesh.points[node]).head<2>();
  return u;
}

/// A ring that is partly pressed flat at an angle.
struct Pressed {
  int count;
  double angle, part;
};

/// Faces of these rings are as far apart as others, or as oblique as faces that just look at each other: the
/// last bits of the start tell the sides apart.
class ARingPressedFlat : public testing::TestWithParam<Pressed> {};

TEST_P(ARingPressedFlat, HasTheSidesOfTheStartOfTheStepInEveryIteration) {
  const auto line = test::ring(GetParam().count);
  const auto dofs = dofs_of(line.mesh);
  const auto zone = zone_with_itself(line);
  const Eigen::VectorXd start =
      GetParam().part * displacement_to(test::flattened(line, GetParam().angle), line.mesh);
  SelfPairs sides(zone.master, zone.undeformed_master, zone.master.longest_edge);
  std::vector<Eigen::Vector3d> places;
  const Configuration before{&line.mesh, &dofs, &start, &start};
  for (const auto node : zone.master.nodes)
    places.push_back(before.position(node));
  sides.update(places);
  NeighbourList list(zone);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.002, 0.002);
  int paired = 0;
  for (int iteration = 0; iteration < 20; ++iteration) {
    Eigen::VectorXd u = start;
    for (auto& component : u)
      component += any(random);
    list.forget_visits();
    list.update({&line.mesh, &dofs, &u, &start});
    for (std::size_t p = 0; p < zone.points.size(); ++p) {
      const auto& pair = list.pairs()[p];
      if (!pair.paired())
        continue;
      ++paired;
      EXPECT_TRUE(std::ranges::any_of(
          zone.points[p].stands_on,
          [&](const PointOnFace& place) { return sides.may_pair(place.face, pair.master_face); }))
          << "iteration " << iteration << ", point " << p;
    }
  }
  EXPECT_GT(paired, 20);
}

INSTANTIATE_TEST_SUITE_P(Rings, ARingPressedFlat,
                         testing::Values(Pressed{6, std::numbers::pi / 2, 0.6},
                                         Pressed{8, std::numbers::pi / 4, 0.7}, Pressed{48, 0, 1}),
                         [](const auto& ring) { return "Of" + std::to_string(ring.param.count) + "Faces"; });

} // namespace
} // namespace rubato::contact::neighbours_test
