// SPDX-License-Identifier: LGPL-3.0-or-later
/// Zones measured iterate after iterate, in storage and with knowledge of the iterate before.
#include "rubato/contact/discretisation.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "two_faces.hpp"
#include <algorithm>
#include <cmath>
#include <random>

namespace rubato::contact::evaluation_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// The upper beam, the master, slides along the lower one and off its end; both bend.
VectorXd sliding(const test::ModelParts& model, double t) {
  VectorXd u = VectorXd::Zero(model.dofs.dof_count);
  for (const auto node : model.dofs.nodes) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    const bool upper = model.zones.front().master.position_of(node) >= 0;
    u[model.dofs.dof(node, 0)] = upper ? 0.3 * t : 0.0;
    u[model.dofs.dof(node, 1)] = (upper ? -0.05 : 0.1) * t * x[0] * x[0];
  }
  return u;
}

const test::ModelParts& beams() {
  static const auto model = test::model_of(
      test::two_beams, {{"mesh.generate.0.cells", "quad9"}, {"mesh.generate.1.cells", "quad9"}});
  return model;
}

TEST(EvaluationInUsedStorage, GivesWhatAFreshOneGives) {
  const auto& model = beams();
  const auto& zone = model.zones.front();
  const VectorXd multipliers = VectorXd::LinSpaced(zone.multiplier_count(), 0, 1);
  const VectorXd start = sliding(model, 0);
  NeighbourList neighbours(zone);
  std::vector<PointEvaluation> points;
  int lost = 0;
  for (int i = 0; i <= 100; ++i) {
    const VectorXd u = sliding(model, 0.01 * i);
    const Configuration configuration{&model.mesh, &model.dofs, &u, &start};
    evaluate(neighbours, multipliers, configuration, points);
    const auto fresh = evaluate(zone, multipliers, configuration);
    ASSERT_EQ(points.size(), fresh.size());
    for (std::size_t p = 0; p < fresh.size(); ++p) {
      EXPECT_EQ(points[p].pair.master_face, fresh[p].pair.master_face);
      EXPECT_EQ(points[p].variables.gap, fresh[p].variables.gap);
      EXPECT_EQ(points[p].variables.slip, fresh[p].variables.slip);
      EXPECT_EQ(points[p].variables.pressure, fresh[p].variables.pressure);
      ASSERT_EQ(points[p].kinematics.has_value(), fresh[p].kinematics.has_value());
      if (!fresh[p].kinematics) {
        ++lost;
        continue;
      }
      EXPECT_EQ(points[p].kinematics->stencil.nodes, fresh[p].kinematics->stencil.nodes);
      EXPECT_EQ(points[p].kinematics->d_gap, fresh[p].kinematics->d_gap);
      EXPECT_EQ(points[p].kinematics->d_slip, fresh[p].kinematics->d_slip);
    }
  }
  EXPECT_GT(lost, 0) << "some points are to lose the master";
}

TEST(EvaluationInUsedStorage, TakesSomePointsAlong) {
  const auto& model = beams();
  const auto& zone = model.zones.front();
  const VectorXd multipliers = VectorXd::Zero(zone.multiplier_count());
  const VectorXd start = sliding(model, 0);
  const VectorXd u = sliding(model, 0.3);
  const Configuration before{&model.mesh, &model.dofs, &start, &start};
  const Configuration after{&model.mesh, &model.dofs, &u, &start};
  NeighbourList neighbours(zone);
  std::vector<PointEvaluation> points;
  measure(neighbours, multipliers, before, points);
  const std::vector<std::size_t> chosen{1, 4, 5, 9};
  measure(neighbours, multipliers, after, chosen, points);
  const auto at_first = evaluate(zone, multipliers, before);
  const auto now = evaluate(zone, multipliers, after);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const bool moved = std::ranges::count(chosen, p) > 0;
    const auto& expected = moved ? now[p] : at_first[p];
    EXPECT_EQ(points[p].pair.master_face, expected.pair.master_face);
    EXPECT_EQ(points[p].variables.gap, expected.variables.gap);
    EXPECT_EQ(neighbours.pairs()[p].master_face, expected.pair.master_face);
    if (moved) {
      EXPECT_NE(points[p].variables.gap, at_first[p].variables.gap);
    }
  }
}

TEST(EvaluationInUsedStorage, StaysInIt) {
  const auto& model = beams();
  const auto& zone = model.zones.front();
  const VectorXd multipliers = VectorXd::Zero(zone.multiplier_count());
  NeighbourList neighbours(zone);
  std::vector<PointEvaluation> points;
  const auto places = [&] {
    std::vector<const void*> all;
    for (const auto& point : points)
      if (const auto& k = point.kinematics)
        for (const void* place :
             {static_cast<const void*>(k->stencil.nodes.data()),
              static_cast<const void*>(k->stencil.weights.data()),
              static_cast<const void*>(k->d_normal.data()), static_cast<const void*>(k->d_gap.data())})
          all.push_back(place);
    return all;
  };
  const auto evaluate_at = [&](double t) {
    const VectorXd u = sliding(model, t);
    evaluate(neighbours, multipliers, {&model.mesh, &model.dofs, &u, &u}, points);
  };
  evaluate_at(0.0);
  const auto before = places();
  evaluate_at(0.01);
  EXPECT_EQ(places(), before);
  EXPECT_FALSE(before.empty());
}

TEST(HeldFrames, MeasureTheSameInUsedStorage) {
  const auto& model = beams();
  const auto& zone = model.zones.front();
  const VectorXd multipliers = VectorXd::Zero(zone.multiplier_count());
  const VectorXd start = sliding(model, 0);
  const VectorXd u = sliding(model, 0.1);
  const auto held =
      with_frozen_frames(evaluate(zone, multipliers, {&model.mesh, &model.dofs, &start, &start}));
  const Configuration configuration{&model.mesh, &model.dofs, &u, &start};
  auto points = evaluate(zone, multipliers, configuration);
  evaluate_in_frozen_frames(held, zone, multipliers, configuration, points);
  const auto fresh = evaluate_in_frozen_frames(held, zone, multipliers, configuration);
  for (std::size_t p = 0; p < fresh.size(); ++p) {
    EXPECT_EQ(points[p].variables.gap, fresh[p].variables.gap);
    EXPECT_EQ(points[p].variables.slip, fresh[p].variables.slip);
    if (fresh[p].kinematics) {
      EXPECT_EQ(points[p].kinematics->d_gap, fresh[p].kinematics->d_gap);
    }
  }
}

/// Undeformed, nodes stand opposite nodes: the faces around one are equally good, and the first is to win.
TEST(PairAround, DoesNotDependOnTheGuess) {
  const auto& model = beams();
  const auto& zone = model.zones.front();
  for (const double t : {0.0, 0.05, 0.4, 1.0}) {
    const VectorXd u = sliding(model, t);
    const Configuration configuration{&model.mesh, &model.dofs, &u, &u};
    std::vector<Eigen::Vector3d> master;
    for (const auto node : zone.master.nodes)
      master.push_back(configuration.position(node));
    for (const auto& point : zone.points) {
      const auto x = position(point, configuration);
      for (std::size_t node = 0; node < zone.master.nodes.size(); ++node) {
        if ((master[node] - x).norm() > zone.master.longest_edge)
          continue;
        const auto expected = pair_around(zone, node, x, master);
        for (const int guess : zone.master.faces_of_node[node]) {
          const auto pair = pair_around(zone, node, x, master, guess);
          ASSERT_EQ(pair.master_face, expected.master_face);
          EXPECT_EQ(pair.projection.clamped, expected.projection.clamped);
        }
      }
    }
  }
}

/// Both faces see such a point beside their common node, at the same distance but for rounding.
TEST(PairAround, TakesTheFirstFaceAboveAKink) {
  const auto straight = test::model_of(test::two_beams);
  const auto& zone = straight.zones.front();
  std::vector<Eigen::Vector3d> flat;
  for (const auto node : zone.master.nodes)
    flat.push_back(straight.mesh.points[static_cast<std::size_t>(node)]);
  const std::size_t kink = flat.size() / 2;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d shift(number(random), number(random), 0);
    const Eigen::Matrix3d turn(Eigen::AngleAxisd(number(random), Eigen::Vector3d::UnitZ()));
    const auto placed = [&](const Eigen::Vector3d& from_kink) {
      return Eigen::Vector3d(shift + turn * from_kink);
    };
    std::vector<Eigen::Vector3d> master;
    for (const auto& at : flat) {
      const double along = at.x() - flat[kink].x();
      master.push_back(placed({along, -0.3 * std::abs(along), 0}));
    }
    const Eigen::Vector3d above =
        placed(0.2 * zone.master.longest_edge * Eigen::Vector3d(0.2 * number(random), 1, 0));
    const auto pair = pair_around(zone, kink, above, master);
    EXPECT_EQ(pair.master_face, std::ranges::min(zone.master.faces_of_node[kink]));
    EXPECT_FALSE(pair.projection.inside());
  }
}

class ProjectionWantedInside : public testing::TestWithParam<CellType> {};

TEST_P(ProjectionWantedInside, IsFoundWhereThereIsOneAndNowhereElse) {
  int inside = 0;
  int outside = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    test::TwoFacesOptions options;
    options.master = options.slave = GetParam();
    options.seed = seed;
    const auto setup = test::two_faces(options);
    const auto nodes = deformed(setup.zone.master.faces.front(), setup.configuration(setup.u));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(-2, 2);
    std::uniform_real_distribution<double> above(-0.3, 0.3);
    for (int i = 0; i < 400; ++i) {
      const bool plane = cell::topology(GetParam()).dimension == 1;
      const double x = along(random), y = along(random), z = above(random);
      const Vector3d point = plane ? Vector3d(x, z, 0) : Vector3d(x, y, z);
      const auto any = project(GetParam(), nodes, point);
      const auto wanted = project(GetParam(), nodes, point, Wanted::inside);
      EXPECT_EQ(wanted.inside(), any.inside());
      if (any.inside()) {
        EXPECT_EQ(wanted.xi, any.xi);
      }
      ++(any.inside() ? inside : outside);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

INSTANTIATE_TEST_SUITE_P(Faces, ProjectionWantedInside,
                         testing::Values(CellType::seg2, CellType::seg3, CellType::tria3, CellType::tria6,
                                         CellType::tria7, CellType::quad4, CellType::quad8, CellType::quad9),
                         [](const auto& face) { return std::string(cell::topology(face.param).name); });

} // namespace
} // namespace rubato::contact::evaluation_test
