// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/discretisation.hpp"
#include "rubato/contact/explicit_penalty.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/contact/obstacles.hpp"
#include <cmath>
#include <numbers>

namespace rubato::contact::explicit_penalty_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::two_faces;
using test::TwoFaces;

constexpr double k_n = 2e5;

ExplicitPenalty springs_of(const TwoFaces& faces) {
  return {faces.zone, faces.dofs, std::vector<double>(faces.zone.points.size(), k_n)};
}

Eigen::Vector3d sum_of(const VectorXd& force, int components) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < force.size(); ++i)
    sum[i % components] += force[i];
  return sum;
}

struct Variant {
  std::string name;
  test::TwoFacesOptions options;
};

class ExplicitPenaltyOn : public testing::TestWithParam<Variant> {
protected:
  TwoFaces faces_ = two_faces(GetParam().options);
};

TEST_P(ExplicitPenaltyOn, PushesBothSidesAlike) {
  auto springs = springs_of(faces_);
  VectorXd force = VectorXd::Zero(faces_.dofs.dof_count);
  springs.advance(faces_.configuration(faces_.u), faces_.u - faces_.u_start, 1, force);
  ASSERT_GT(force.norm(), 0);
  Eigen::Vector3d sum = sum_of(force, faces_.dofs.components);
  if (faces_.zone.obstacle)
    sum += springs.push();
  EXPECT_LT(sum.norm(), 1e-13 * force.lpNorm<1>());
}

/// Normal forces are the derivatives of the stored energy wherever the projection is not clamped.
TEST_P(ExplicitPenaltyOn, MeasuresGapsAsTheImplicitMethodsDo) {
  auto springs = springs_of(faces_);
  const auto configuration = faces_.configuration(faces_.u);
  VectorXd force = VectorXd::Zero(faces_.dofs.dof_count);
  springs.advance(configuration, faces_.u - faces_.u_start, 1, force);
  const auto state = springs.state();
  const auto points = evaluate(faces_.zone, state.multipliers, configuration);
  VectorXd expected = VectorXd::Zero(force.size());
  double stored = 0;
  int touching = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& k = points[i].kinematics;
    const bool touches = k && k->gap < 0;
    EXPECT_EQ(state.status[i] != Status::open, touches) << i;
    if (!touches)
      continue;
    ++touching;
    const double pressure = -k_n * k->gap;
    Eigen::Vector2d friction = -k_n * k->slip;
    const double limit = faces_.zone.settings.friction * pressure;
    if (friction.norm() > limit)
      friction *= limit / friction.norm();
    stored += faces_.zone.points[i].weight * (pressure * pressure + friction.squaredNorm()) / (2 * k_n);
    const Eigen::Vector3d traction = pressure * k->normal + k->tangents * friction;
    for (Eigen::Index n = 0; n < k->stencil.weights.size(); ++n)
      for (int a = 0; a < k->stencil.components; ++a)
        expected[k->stencil.nodes[static_cast<std::size_t>(n)] * k->stencil.components + a] -=
            faces_.zone.points[i].weight * k->stencil.weights[n] * traction[a];
  }
  ASSERT_GT(touching, 0);
  EXPECT_LT((force - expected).norm(), 1e-12 * expected.norm());
  EXPECT_NEAR(springs.stored(), stored, 1e-12 * stored);
}

TEST_P(ExplicitPenaltyOn, BoundsItsOwnFrequency) {
  auto springs = springs_of(faces_);
  VectorXd force = VectorXd::Zero(faces_.dofs.dof_count);
  const auto configuration = faces_.configuration(faces_.u);
  springs.advance(configuration, force, 1, force);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> mass(0.5, 2);
  VectorXd inverse_mass(faces_.dofs.dof_count);
  for (Eigen::Index i = 0; i < inverse_mass.size(); i += faces_.dofs.components)
    inverse_mass.segment(i, faces_.dofs.components).setConstant(1 / mass(random));
  MatrixXd stiffness = MatrixXd::Zero(inverse_mass.size(), inverse_mass.size());
  const auto points = evaluate(faces_.zone, VectorXd::Zero(faces_.zone.multiplier_count()), configuration);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const auto& k = points[i].kinematics)
      for (int a = 0; a < k->stencil.components; ++a) {
        VectorXd b = VectorXd::Zero(inverse_mass.size());
        for (Eigen::Index n = 0; n < k->stencil.weights.size(); ++n)
          b[k->stencil.nodes[static_cast<std::size_t>(n)] * k->stencil.components + a] +=
              k->stencil.weights[n];
        stiffness += faces_.zone.points[i].weight * k_n * b * b.transpose();
      }
  const MatrixXd root = inverse_mass.cwiseSqrt().asDiagonal();
  const double dense = test::symmetric_eigenvalues(root * stiffness * root).maxCoeff();
  const double bound = largest_eigenvalue(std::span(&springs, 1), inverse_mass);
  EXPECT_GE(bound, dense * (1 - 1e-12));
  EXPECT_LT(bound, 2 * dense);
}

INSTANTIATE_TEST_SUITE_P(
    Faces, ExplicitPenaltyOn,
    testing::Values(Variant{"Segments", {.slave = CellType::seg2, .master = CellType::seg2}},
                    Variant{"QuadraticSegments", {.slave = CellType::seg3, .master = CellType::seg3}},
                    Variant{"Quadrangles", {}}, Variant{"BesideTheEdge", {.shift = 0.3}},
                    Variant{"GaussPoints", {.gauss = 3}},
                    Variant{"SlaveNormal", {.normal = study::ContactNormal::slave}},
                    Variant{"AverageNormal", {.normal = study::ContactNormal::average}},
                    Variant{"CodeAstersClampedNormal",
                            {.clamped_normal = study::ClampedNormal::code_aster, .shift = 0.3}},
                    Variant{"Nonagons", {.slave = CellType::quad9, .master = CellType::quad9}}),
    [](const auto& variant) { return variant.param.name; });

std::vector<Variant> before_obstacles() {
  std::vector<Variant> variants;
  for (const auto& [name, options] : test::every_obstacle())
    variants.push_back({name, options});
  return variants;
}

INSTANTIATE_TEST_SUITE_P(Before, ExplicitPenaltyOn, testing::ValuesIn(before_obstacles()),
                         [](const auto& variant) { return variant.param.name; });

/// A flat slave segment that is moved about above a flat master twice as wide.
class ASlider : public testing::Test {
protected:
  ASlider() {
    faces_ = two_faces({.slave = CellType::seg2, .master = CellType::seg2, .friction = 0.25});
    const auto& zone = faces_.zone;
    for (const auto& [surface, half, height] :
         {std::tuple{&zone.master, 2.0, 0.0}, std::tuple{&zone.slave, 0.5, 0.0}})
      for (const auto node : surface->nodes) {
        auto& x = faces_.mesh.points[static_cast<std::size_t>(node)];
        x = {std::copysign(half, x[0]), height, 0};
      }
    zone_ = make_zone(faces_.mesh, zone.settings, make_surface(faces_.mesh, zone.master.faces),
                      make_surface(faces_.mesh, zone.slave.faces), {}, {2, 1.0, {}});
    springs_.emplace(zone_, faces_.dofs, std::vector<double>(zone_.points.size(), k_n));
    u_ = VectorXd::Zero(faces_.dofs.dof_count);
  }

  /// Moves the slave there in that many steps; the work its holder does meanwhile, by the trapezoidal rule.
  double move(double x, double y, int steps) {
    double work = 0;
    const Eigen::Vector2d whole = Eigen::Vector2d(x, y) - place_;
    for (int i = 0; i < steps; ++i) {
      place_ += whole / steps;
      VectorXd velocity = VectorXd::Zero(u_.size());
      for (const auto node : zone_.slave.nodes)
        velocity.segment<2>(2 * node) = whole;
      u_ += velocity / steps;
      const Eigen::Vector2d before = force();
      force_.setZero(u_.size());
      springs_->advance({&faces_.mesh, &faces_.dofs, &u_, &u_}, velocity, 1.0 / steps, force_);
      work += 0.5 * (before + force()).dot(whole) / steps;
    }
    return work;
  }
  /// That holds the slave.
  Eigen::Vector2d force() const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const auto node : zone_.slave.nodes)
      if (force_.size() > 0)
        sum += force_.segment<2>(2 * node);
    return sum;
  }

  TwoFaces faces_;
  Zone zone_;
  std::optional<ExplicitPenalty> springs_;
  VectorXd u_;
  VectorXd force_;
  Eigen::Vector2d place_ = Eigen::Vector2d::Zero();
};

constexpr double depth = 1e-3;
constexpr double weight = k_n * depth; // on a length of 1
constexpr double mu = 0.25;

TEST_F(ASlider, RubsAlikeHoweverShortTheSteps) {
  move(0, -depth, 10);
  EXPECT_NEAR(force()[1], -weight, 1e-9 * weight);
  const double sticks = 0.5 * mu * depth;
  move(sticks, -depth, 5000);
  EXPECT_NEAR(force()[0], k_n * sticks, 1e-9 * weight);
  EXPECT_EQ(springs_->state().status, (std::vector{Status::stick, Status::stick}));
  EXPECT_NEAR(springs_->dissipated(), 0, 1e-9 * weight * depth);
  move(3 * mu * depth, -depth, 5000);
  EXPECT_NEAR(force()[0], mu * weight, 1e-9 * weight);
  EXPECT_EQ(springs_->state().status, (std::vector{Status::slip, Status::slip}));
  // All the way but the elastic slip at its end.
  EXPECT_NEAR(springs_->dissipated(), mu * weight * 2 * mu * depth, 1e-3 * mu * weight * mu * depth);
  move(2.5 * mu * depth, -depth, 3);
  EXPECT_NEAR(force()[0], mu * weight - k_n * 0.5 * mu * depth, 1e-9 * weight);
}

TEST_F(ASlider, KeepsAnAccountOfEveryWork) {
  double work = 0;
  for (const auto& [x, y] :
       {std::pair{0.0, -depth}, {0.4, -depth}, {0.1, -2 * depth}, {0.1, depth}, {0.0, -depth}})
    work += move(x, y, 20'000);
  EXPECT_NEAR(springs_->stored() + springs_->dissipated(), work, 1e-3 * work);
  EXPECT_GT(springs_->dissipated(), 0.9 * work);
}

TEST_F(ASlider, IsForgivenThePenetrationItIsFoundWith) {
  move(5, 0, 10); // off the master
  move(5, -depth, 10);
  EXPECT_EQ(springs_->state().status, (std::vector{Status::open, Status::open}));
  move(0, -depth, 10);
  EXPECT_NEAR(force().norm(), 0, 1e-9 * weight);
  move(0, -1.5 * depth, 10);
  EXPECT_NEAR(force()[1], -0.5 * weight, 1e-9 * weight);
  move(0, -0.25 * depth, 10); // comes out by itself, and is not forgiven that part again
  move(0, -depth, 10);
  EXPECT_NEAR(force()[1], -0.75 * weight, 1e-9 * weight);
}

TEST_F(ASlider, SaturatesAtTheSlipTheDeckSays) {
  zone_.settings.tangential_coefficient = 1 / (4 * mu * depth);
  move(0, -depth, 10);
  move(2 * mu * depth, -depth, 100);
  EXPECT_NEAR(force()[0], 0.5 * mu * weight, 1e-9 * weight);
}

TEST(PenaltyStiffness, MakesAPointVibrateWithAThirdOfTheBulksFrequency) {
  auto faces = two_faces({.slave = CellType::seg2, .master = CellType::seg2});
  const VectorXd inverse_mass = VectorXd::Constant(faces.dofs.dof_count, 4);
  const auto automatic = penalty_stiffness(faces.zone, faces.dofs, inverse_mass, 100);
  for (std::size_t i = 0; i < automatic.size(); ++i)
    EXPECT_DOUBLE_EQ(automatic[i] * faces.zone.points[i].weight * (4 + 4), 10);
  faces.zone.settings.normal_coefficient = 7;
  EXPECT_EQ(penalty_stiffness(faces.zone, faces.dofs, inverse_mass, 100), (std::vector<double>{7, 7}));
}

} // namespace
} // namespace rubato::contact::explicit_penalty_test
