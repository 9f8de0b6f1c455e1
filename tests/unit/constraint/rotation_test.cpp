// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/constraint/reduction.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/time_integral.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace rubato::constraint::rotation_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

const Vector3d about(1, -2, 0.5);
const Vector3d axis = Vector3d(1, 2, -3).normalized();
const Vector3d place(4, 0.3, -1);

FieldFunction formula(const std::string& text) {
  return {.expression = Expression(text), .function = {}};
}

/// By its velocity (1) or its acceleration (2), from t = 0 to 3.
Rotation given(const std::string& text, int integrals) {
  return {about, axis, integrated(formula(text), integrals, 0, 3)};
}

Vector3d turned(double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix() * (place - about) - (place - about);
}

TEST(Rotation, DisplacesPlacesExactlyByAnyAngle) {
  for (const double angle : {0., 1e-9, 0.3, -2., 3.14, 20.}) {
    const Rotation rotation{about, axis, {.number = angle, .expression = {}, .function = {}}};
    EXPECT_LE((displacement_at(rotation, place, 0.7) - turned(angle)).norm(), 1e-14) << angle;
  }
}

TEST(Rotation, KeepsTheDigitsOfSmallAngles) {
  const Rotation rotation{about, axis, {.number = 1e-9, .expression = {}, .function = {}}};
  const Vector3d d = place - about;
  const Vector3d series = 1e-9 * axis.cross(d) + 0.5e-18 * axis.cross(axis.cross(d));
  EXPECT_LE((displacement_at(rotation, place, 0) - series).norm(), 1e-15 * series.norm());
}

TEST(Rotation, FollowsTheFunctionOfTime) {
  Rotation rotation{about, axis, formula("2*t")};
  rotation.angle.function = Function{{0, 2}, {0, 1}};
  EXPECT_DOUBLE_EQ(angle_at(rotation, 1.5), 3 * 0.75);
  EXPECT_LE((displacement_at(rotation, place, 1.5) - turned(3 * 0.75)).norm(), 1e-14);
}

/// By differences of fourth order.
template <class F> Vector3d slope(const F& f, double t) {
  constexpr double h = 1e-3;
  const auto rise = [&](double step) -> Vector3d { return f(t + step) - f(t - step); };
  return (8 * rise(h) - rise(2 * h)) / (12 * h);
}

TEST(Rotation, HasTheRatesOfItsDisplacements) {
  for (const int integrals : {1, 2}) {
    const auto rotation = given("1+3*sin(2*t)", integrals);
    const auto u = [&](double t) { return displacement_at(rotation, place, t); };
    const auto v = [&](double t) { return rate_at(rotation, place, t, 1); };
    for (const double t : {0.4, 1.7}) {
      EXPECT_LE((v(t) - slope(u, t)).norm(), 1e-8 * v(t).norm());
      EXPECT_LE((rate_at(rotation, place, t, 2) - slope(v, t)).norm(),
                1e-8 * rate_at(rotation, place, t, 2).norm());
    }
  }
}

/// A steady rotation accelerates towards its line: by ω² times the distance.
TEST(Rotation, AcceleratesTowardsItsLine) {
  const auto rotation = given("5", 1);
  const Vector3d d = place - about;
  const Vector3d arm = d - d.dot(axis) * axis;
  EXPECT_LE((rate_at(rotation, place, 0, 1) - 5 * axis.cross(d)).norm(), 1e-13);
  EXPECT_LE((rate_at(rotation, place, 0, 2) + 25 * arm).norm(), 1e-12);
}

TEST(Rotation, SaysNothingOfRatesWhereItsAngleIsGiven) {
  const Rotation rotation{about, axis, formula("2*t")};
  EXPECT_EQ(rate_at(rotation, place, 1, 1), Vector3d::Zero());
  EXPECT_EQ(rate_at(rotation, place, 1, 2), Vector3d::Zero());
}

TEST(Rotation, LeavesItsLineAndDirectionsAlongIt) {
  const Rotation rotation{about, Vector3d::UnitY(), formula("t")};
  EXPECT_TRUE(leaves(rotation, about + 3 * Vector3d::UnitY(), 0));
  EXPECT_TRUE(leaves(rotation, place, 1));
  EXPECT_FALSE(leaves(rotation, place, 0));
  EXPECT_FALSE(leaves(rotation, about + Vector3d::UnitX(), 0)) << "at first it moves along z only";
}

/// Dofs 0 to 2 of the place, rotated by an angle of the velocity 2 and shifted by its velocity 3 along y; dof
/// 4 has half of dof 1.
Reduction some_reduction() {
  const auto rotation = std::make_shared<const Rotation>(given("2", 1));
  std::vector<PrescribedDof> prescribed;
  for (int i = 0; i < 3; ++i) {
    ImposedValue imposed{0, {}, {}, std::make_shared<const RotatedPlace>(RotatedPlace{rotation, place, i})};
    if (i == 1) {
      imposed.value = 3;
      imposed.function = Function(Integral{std::make_shared<const TimeIntegral>(
          std::optional<Function>(), std::optional<Expression>(), 1, 0., 3.)});
    }
    prescribed.push_back({i, imposed});
  }
  return {5, prescribed, {{4, {}, {{1, 0.5}}, {}}}, {}};
}

TEST(RotatedDofs, HaveTheirTranslationToo) {
  const auto reduction = some_reduction();
  const Vector3d expected = turned(1.4) + Vector3d(0, 2.1, 0);
  const VectorXd u = reduction.imposed(0.7);
  EXPECT_LE((u.head<3>() - expected).norm(), 1e-14);
  EXPECT_NEAR(u[4], expected[1] / 2, 1e-14);
  for (const auto& prescribed : reduction.prescribed())
    EXPECT_TRUE(reduction.moves(prescribed));
}

TEST(RotatedDofs, ImposeTheRatesOfBoth) {
  const auto reduction = some_reduction();
  const auto rotation = given("2", 1);
  VectorXd v = VectorXd::Constant(5, 9);
  reduction.impose_rates(1, 0.7, v);
  const Vector3d expected = rate_at(rotation, place, 0.7, 1) + Vector3d(0, 3, 0);
  EXPECT_LE((v.head<3>() - expected).norm(), 1e-13);
  EXPECT_EQ(v[3], 9);
  EXPECT_NEAR(v[4], expected[1] / 2, 1e-13);
  reduction.impose_rates(2, 0.7, v);
  EXPECT_LE((v.head<3>() - rate_at(rotation, place, 0.7, 2)).norm(), 1e-13);
}

TEST(RotatedDofs, AreTheSameWhereRotationPlaceAndAxisAre) {
  const auto dof = [](const std::string& text, const Vector3d& x, int i) {
    const auto rotation = std::make_shared<const Rotation>(Rotation{about, axis, formula(text)});
    return PrescribedDof{3, {0, {}, {}, std::make_shared<const RotatedPlace>(RotatedPlace{rotation, x, i})}};
  };
  EXPECT_EQ(dof("t", place, 1), dof("t", place, 1));
  EXPECT_NE(dof("t", place, 1), dof("2*t", place, 1));
  EXPECT_NE(dof("t", place, 1), dof("t", about, 1));
  EXPECT_NE(dof("t", place, 1), dof("t", place, 2));
  EXPECT_NE(dof("t", place, 1), (PrescribedDof{3, {0, {}}}));
}

TEST(Rotation, TellsAnAngleThatIsNoNumber) {
  const Rotation rotation{about, axis, formula("1/t")};
  EXPECT_THROW(displacement_at(rotation, place, 0), InputError);
}

} // namespace
} // namespace rubato::constraint::rotation_test
