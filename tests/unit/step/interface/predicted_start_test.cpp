// SPDX-License-Identifier: LGPL-3.0-or-later
// The contact of a step as it is predicted: near the one that the step ends with.
#include "rubato/deck/read.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/interface/predicted_start.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::predicted_start_test {
namespace {

using contact::Status;
using deck::Setting;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;
using test::Walk;

/// The next step of a walk, predicted.
class Predicted {
public:
  explicit Predicted(const Walk& walk, GoesOn goes_on = {})
      : model(walk.model), scheme(walk.scheme), committed(walk.state()),
        system(make_effective_system(model, scheme, walk.length())),
        side(model, scheme, system, committed, {}), frozen(model.zones.size()),
        equilibrium(model, scheme, system, committed, walk.target()), progress(std::move(goes_on)),
        surface(model, scheme, system), reach(reach_of(model, system)),
        scratch(*system.compliance, scheme.contact_weight(), model.dofs.components,
                system.has_free_bodies ? NormalSolution::active_set : NormalSolution::near),
        trial(predict(model, scheme, system, committed, walk.target())) {
    surface.start_from(trial.motion, equilibrium);
    side.start_iterations();
    predict_contact({model, system, side, frozen, equilibrium, progress}, surface, reach, scratch, now,
                    trial);
  }

  const std::vector<Status>& status() const { return trial.zones[0].status; }
  const VectorXd& multipliers() const { return trial.zones[0].multipliers; }
  /// Of the contact forces on all nodes of the slave (internal side).
  Vector2d force_on_slave() const {
    Vector2d sum = Vector2d::Zero();
    for (const auto node : model.zones[0].slave.nodes)
      for (int i = 0; i < 2; ++i)
        if (const int at =
                system.compliance->interface_dof_of_dof()[static_cast<std::size_t>(model.dofs.dof(node, i))];
            at >= 0)
          sum[i] += surface.applied[at];
    return sum;
  }

  const test::ModelParts& model;
  time::Scheme scheme;
  State committed;
  EffectiveSystem system;
  ContactEvaluator side;
  Frozen frozen;
  Equilibrium equilibrium;
  Progress progress;
  SurfaceMotion surface;
  Reach reach;
  PredictorScratch scratch;
  ContactIterate now;
  State trial;
};

void expect_near(const VectorXd& a, const VectorXd& b, double tolerance) {
  EXPECT_LE((a - b).lpNorm<Eigen::Infinity>(), tolerance * b.lpNorm<Eigen::Infinity>());
}

/// Of the points that face something and so are followed.
TEST(ThePredictedStep, TouchesWhereTheStepDoesAndNearlyAsHard) {
  for (const char* friction : {"0", "0.2"}) {
    Walk walk(test::two_beams, {{"contact.interface.friction", friction}});
    for (int step = 0; step < 8; ++step) {
      const Predicted predicted(walk);
      ASSERT_TRUE(walk.advance());
      ASSERT_EQ(walk.reports.size(), static_cast<std::size_t>(step + 1)) << "the step was cut";
      const auto& zone = walk.state().zones[0];
      double largest = 0;
      double misfit = 0;
      for (const auto& point : predicted.scratch.points) {
        const double force = zone.outcomes[point.index].normal.norm();
        largest = std::max(largest, force);
        misfit = std::max(misfit, std::abs(point.force[0] - force));
        EXPECT_EQ(predicted.status()[point.index] == Status::open, zone.status[point.index] == Status::open)
            << "point " << point.index << ", step " << step << ", friction " << friction;
      }
      EXPECT_GT(largest, 0);
      EXPECT_LE(misfit, 0.07 * largest) << "step " << step << ", friction " << friction;
      EXPECT_LE(predicted.scratch.predictor.misfit(predicted.scratch.points, predicted.surface.moved), 0.01)
          << "step " << step << ", friction " << friction;
    }
  }
}

TEST(ThePredictedStep, HasItsSurfacesWhereItsForcesPushThem) {
  Walk walk(test::two_beams);
  const Predicted predicted(walk);
  VectorXd moved = predicted.surface.free;
  const auto& compliance = predicted.system.compliance;
  compliance->add(-predicted.scheme.contact_weight(), predicted.surface.applied, moved);
  EXPECT_TRUE(predicted.surface.consistent);
  expect_near(predicted.surface.moved, moved, 1e-12);
  for (Index i = 0; i < moved.size(); ++i) {
    const int dof = compliance->dof_of_interface_dof()[static_cast<std::size_t>(i)];
    EXPECT_EQ(predicted.trial.motion.u[dof], predicted.surface.base.u[dof] + predicted.surface.moved[i]);
  }
}

/// Points press, none pulls; none sinks in by more than a part of what the free beams would.
TEST(ThePredictedStep, ClosesGapsByPressingOnly) {
  Walk walk(test::two_beams);
  const Predicted predicted(walk);
  const double free = predicted.surface.free.lpNorm<Eigen::Infinity>();
  int pressing = 0;
  for (const auto& point : predicted.scratch.points) {
    EXPECT_GE(point.force[0], 0);
    EXPECT_LE(point.force.tail<2>().norm(), (1 + 1e-9) * 0.2 * point.force[0]);
    EXPECT_GE(measures_of(point, predicted.surface.moved)[0], -1e-2 * free);
    pressing += point.force[0] > 0 ? 1 : 0;
    EXPECT_EQ(point.force[0] > 0, predicted.status()[point.index] != Status::open);
  }
  EXPECT_GT(pressing, 0);
}

TEST(ThePredictedStep, IsTheFreeOneWhereNothingTouches) {
  Walk walk(test::two_beams,
            {{"mesh.generate.1.rectangle.from", "[0, -0.3]"}, {"mesh.generate.1.rectangle.to", "[1, -0.2]"}});
  const Predicted predicted(walk);
  EXPECT_GT(predicted.surface.free.norm(), 0);
  EXPECT_EQ(predicted.surface.applied.norm(), 0);
  EXPECT_EQ(predicted.surface.moved, predicted.surface.free);
  EXPECT_GE(predicted.scratch.points.size(), 19U);
  for (const auto& point : predicted.scratch.points)
    EXPECT_EQ(predicted.status()[point.index], Status::open);
  EXPECT_EQ(predicted.multipliers().norm(), 0);
}

/// A block that lies on a plane: contact carries the whole of its load, 1000 down, from the first step on.
class ABlockThatOnlyContactHolds : public testing::TestWithParam<const char*> {
protected:
  Walk walk_{test::block_on_plane, {{"contact.foot.friction", GetParam()}}};
};

TEST_P(ABlockThatOnlyContactHolds, ComesToRestOnWhatItLiesOn) {
  for (int step = 0; step < 2; ++step) {
    const Predicted predicted(walk_);
    ASSERT_TRUE(predicted.system.has_free_bodies);
    // Internal side: minus what acts on the block.
    EXPECT_NEAR(predicted.force_on_slave().y(), -1000, 1) << "step " << step;
    EXPECT_LE(predicted.surface.moved.lpNorm<Eigen::Infinity>(), 1e-5 * predicted.reach.most())
        << "the base is where it rests";
    ASSERT_TRUE(walk_.advance());
    EXPECT_EQ(predicted.status(), walk_.state().zones[0].status);
    expect_near(predicted.multipliers(), walk_.state().zones[0].multipliers, 1e-2);
  }
}

INSTANTIATE_TEST_SUITE_P(WithFriction, ABlockThatOnlyContactHolds, testing::Values("0", "0.3"),
                         [](const auto& chosen) {
                           return std::string(chosen.param) == "0" ? "Smooth" : "Rough";
                         });

/// First by less than frames at its start tell of, half an edge, then by more.
TEST(ABlockAbove, FallsOntoThePlaneInOnePrediction) {
  for (const double height : {0.001, 0.5}) {
    const auto corner = [](double x, double y) {
      return "[" + std::to_string(x) + ", " + std::to_string(y) + "]";
    };
    Walk walk(test::block_on_plane, {{"mesh.generate.0.rectangle.from", corner(0, height)},
                                     {"mesh.generate.0.rectangle.to", corner(1, 1 + height)},
                                     {"contact.foot.friction", "0"}});
    const Predicted predicted(walk);
    EXPECT_NEAR(predicted.force_on_slave().y(), -1000, 1) << height;
    const auto foot = walk.node_at(0, height);
    EXPECT_NEAR(predicted.trial.motion.u[walk.model.dofs.dof(foot, 1)], -height, 1e-5);
    EXPECT_LE(predicted.surface.moved.lpNorm<Eigen::Infinity>(), 1e-5 * predicted.reach.most())
        << "no spring but contact holds it any more";
  }
}

TEST(APrediction, EndsAtTheNextBeatWhenItIsAskedTo) {
  const Walk walk(test::two_beams);
  int reports = 0;
  const Predicted whole(walk, [&](const ProgressState&) { return ++reports > 0; });
  ASSERT_GT(reports, 1);
  reports = 0;
  const Predicted stopped(walk, [&](const ProgressState&) { return ++reports < 1; });
  EXPECT_TRUE(stopped.progress.stopped());
  EXPECT_EQ(reports, 1);
  EXPECT_EQ(stopped.trial.zones, walk.state().zones) << "nothing of it is taken";
}

TEST(ReachOfSurfaces, IsHalfTheFinestEdgeWhereBodiesAreFree) {
  const auto reach = [](const std::string& deck, const std::vector<Setting>& changes = {}) {
    const Walk walk(deck, changes);
    return reach_of(walk.model, make_effective_system(walk.model, walk.scheme, walk.length())).most();
  };
  EXPECT_EQ(reach(test::two_beams), INFINITY);
  EXPECT_NEAR(reach(test::block_on_plane), 0.5 * 5 / 13, 1e-12) << "of the plane's edges";
  EXPECT_NEAR(reach(test::three_blocks, {{"mesh.generate.2.divisions", "[5, 2]"}}), 0.5 / 5, 1e-12)
      << "the upper zone has the top block for its master";
}

} // namespace
} // namespace rubato::step::predicted_start_test
