// SPDX-License-Identifier: LGPL-3.0-or-later
// Points that slip to and fro under Newton's method, and when they are made to stick.
#include "rubato/contact/spring_friction.hpp"

#include <gtest/gtest.h>

namespace rubato::contact::spring_friction_test {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using study::ContactMethod;

/// One point in the plane of a zone of springs: P = 10 per penetration, saturated friction beyond slips of
/// 1/4, μ = 0.3, and a body that resists a slip by 2.
struct OnePoint {
  Zone zone;
  ZoneCoefficients coefficients{{10}, {4}, {2}};
  domain::DofMap dofs{3, {0}, 3, {0}};

  explicit OnePoint(ContactMethod method = ContactMethod::penalty, double weight = 1) {
    zone.settings.method = method;
    zone.settings.friction = 0.3;
    zone.settings.friction_method = study::usual_friction_method(method);
    zone.points.resize(1);
    zone.points[0].weight = weight;
  }

  ZoneLaw law() const { return {&zone, &coefficients, zone.settings.friction}; }

  /// Axes along the slip as space has them: a slip of 1 is one of `along` along x.
  static PointEvaluation at(double gap, Vector2d slip, double along = 1) {
    PointEvaluation point;
    auto& k = point.kinematics.emplace();
    k.normal = Eigen::Vector3d::UnitZ();
    k.tangents << along, 0, 0, along, 0, 0;
    k.stencil.nodes = {0};
    k.stencil.weights = VectorXd::Ones(1);
    k.d_slip.resize(2, 3);
    k.d_slip << along, 0, 0, 0, along, 0;
    point.variables.gap = gap;
    point.variables.slip = slip;
    return point;
  }

  /// What becomes of a point that is to slip now, the node having moved by `move` along x since.
  Status after(Status was, const PointEvaluation& before, const PointEvaluation& now, double move = 0,
               Status is = Status::slip) const {
    const VectorXd u0 = VectorXd::Zero(3);
    VectorXd u1 = u0;
    u1[0] = move;
    Status status = is;
    stick_in_passing(law(), {{&before, 1}, {&was, 1}, u0}, {{&now, 1}, {&is, 1}, u1}, dofs, {&status, 1});
    return status;
  }
};

TEST(StickingInPassing, IsForFrictionBySpringsOnly) {
  for (const auto& [method, passes] : {std::pair{ContactMethod::penalty, true},
                                       {ContactMethod::nodal_penalty, true},
                                       {ContactMethod::nodal_lagrange, true},
                                       {ContactMethod::augmented_lagrangian, false}}) {
    OnePoint one(method);
    EXPECT_EQ(sticks_in_passing(one.zone), passes);
    one.zone.settings.friction = 0;
    EXPECT_FALSE(sticks_in_passing(one.zone));
  }
  const OnePoint exact(ContactMethod::augmented_lagrangian);
  EXPECT_EQ(exact.after(Status::slip, exact.at(-0.1, {0.3, 0}), exact.at(-0.1, {-0.3, 0})), Status::slip);
}

TEST(StickingInPassing, IsForPointsThatTurnFromOneSlipToTheOther) {
  const OnePoint one;
  EXPECT_EQ(one.after(Status::slip, one.at(-0.1, {0.3, 0}), one.at(-0.1, {-0.9, 0.1})), Status::stick);
  EXPECT_EQ(one.after(Status::slip, one.at(-0.1, {0.3, 0}), one.at(-0.1, {0.9, 0.1})), Status::slip);
  EXPECT_EQ(one.after(Status::slip, one.at(-0.1, {0.3, 0}), one.at(-0.1, {0.001, 0})), Status::slip)
      << "however small the slip is now";
}

TEST(StickingInPassing, ComparesSlipsInSpace) {
  const OnePoint one;
  EXPECT_EQ(one.after(Status::slip, one.at(-0.1, {0.3, 0}), one.at(-0.1, {0.3, 0}, -1)), Status::stick);
  EXPECT_EQ(one.after(Status::slip, one.at(-0.1, {0.3, 0}), one.at(-0.1, {-0.3, 0}, -1)), Status::slip);
}

/// Without pressure: now it is μ P = 0.3 against a resistance of 2 to the slip.
TEST(StickingInPassing, IsForPointsThatComeUnderPressureAndCanBePulledBack) {
  const OnePoint one;
  const auto free = one.at(0.5, {0, 0});
  EXPECT_EQ(one.after(Status::slip, free, one.at(-0.1, {0.14, 0})), Status::stick);
  EXPECT_EQ(one.after(Status::slip, free, one.at(-0.1, {0.16, 0})), Status::slip);
  EXPECT_EQ(one.after(Status::slip, free, one.at(-0.2, {0.16, 0})), Status::stick);
  EXPECT_EQ(one.after(Status::stick, free, one.at(-0.1, {0.16, 0})), Status::slip);
}

TEST(StickingInPassing, IsForPointsThatStuckWhoseSlipHalves) {
  const OnePoint one;
  const auto before = one.at(-0.1, {2, 0});
  constexpr double far = 9; // the tangent says that it will slip
  EXPECT_EQ(one.after(Status::stick, before, one.at(-0.1, {0, 1}), far), Status::stick);
  EXPECT_EQ(one.after(Status::stick, before, one.at(-0.1, {0, 1.01}), far), Status::slip);
}

/// Slips of up to 1/4 stick, and friction pulls the point back over 0.15 more than the tangent knows of.
TEST(StickingInPassing, IsForPointsThatStuckAndDoSoByTheTangent) {
  const OnePoint one;
  const auto before = one.at(-0.1, {0.2, 0});
  EXPECT_EQ(one.after(Status::stick, before, one.at(-0.1, {0.3, 0}), 0.04), Status::stick); // to 0.24
  EXPECT_EQ(one.after(Status::stick, before, one.at(-0.1, {0.3, 0}), 0.06), Status::slip);  // to 0.26
  EXPECT_EQ(one.after(Status::stick, before, one.at(-0.1, {0.4, 0}), 0.04), Status::slip);  // 0.16 beyond
  EXPECT_EQ(one.after(Status::stick, before, one.at(-0.1, {0.38, 0}), 0.04), Status::stick);
}

TEST(StickingInPassing, LeavesOtherPointsAlone) {
  const OnePoint one;
  const auto before = one.at(-0.1, {0.3, 0});
  const auto turned = one.at(-0.1, {-0.3, 0});
  EXPECT_EQ(one.after(Status::open, one.at(0.5, {0, 0}), one.at(-0.1, {0.1, 0})), Status::slip);
  EXPECT_EQ(one.after(Status::slip, before, turned, 0, Status::open), Status::open);
  EXPECT_EQ(one.after(Status::slip, before, turned, 0, Status::stick), Status::stick);
}

double stiffness_of(const OnePoint& one, const PointEvaluation& point, Status status) {
  return friction_stiffness(one.law(), {&point, 1}, {&status, 1}).at(0);
}

/// μ k_t = 1.2 times the pressing force.
TEST(FrictionStiffness, GrowsWithThePressingForce) {
  const auto point = OnePoint::at(-0.1, {0.1, 0});
  const auto law = [](double weight, ContactMethod method = ContactMethod::penalty) {
    return OnePoint(method, weight);
  };
  EXPECT_DOUBLE_EQ(stiffness_of(law(1), point, Status::stick), 1.2);
  EXPECT_DOUBLE_EQ(stiffness_of(law(0.5), point, Status::stick), 0.6);
  EXPECT_DOUBLE_EQ(stiffness_of(law(-0.5), point, Status::stick), 0.6)
      << "of a corner whose weight is negative";
  EXPECT_DOUBLE_EQ(stiffness_of(law(1), point, Status::slip), 1.2);
  EXPECT_EQ(stiffness_of(law(1), point, Status::open), 0);
  EXPECT_EQ(stiffness_of(law(1), OnePoint::at(0.1, {0.1, 0}), Status::stick), 0);
  EXPECT_EQ(stiffness_of(law(1, ContactMethod::nodal_penalty), point, Status::stick), 0)
      << "the pressure does not make it stiff";
}

/// Beyond its limit the spring's own friction would grow faster: the tangent that follows the limit is the
/// one of a point that slips there the same way.
TEST(FollowingTheLimit, MakesFrictionGrowWithThePressureAsTheLimitDoes) {
  PointLaw law;
  law.method = ContactMethod::penalty;
  law.friction_method = study::FrictionMethod::penalty;
  law.friction = 0.3;
  law.normal = 10;
  law.tangential = 4;
  const PointState far{-0.1, {0.6, 0.8}, 0, {0, 0}}; // four times the saturation slip
  auto passing = respond(far, Status::stick, law);
  const auto free = passing;
  follow_limit(passing);
  constexpr double h = 1e-6;
  auto deeper = far;
  deeper.gap -= h;
  const Vector2d growth = (respond(deeper, Status::slip, law).traction.tail<2>() -
                           respond(far, Status::slip, law).traction.tail<2>()) /
                          -h;
  EXPECT_LT((Vector2d(passing.d_traction.block<2, 1>(1, 0)) - growth).norm(), 1e-6);
  EXPECT_EQ((passing.d_traction.block<3, 2>(0, 1)), (free.d_traction.block<3, 2>(0, 1)));
  EXPECT_EQ(passing.traction, free.traction);
}

} // namespace
} // namespace rubato::contact::spring_friction_test
