// SPDX-License-Identifier: LGPL-3.0-or-later
// Points linearised in factors against what the law answers and against differences.
#include "rubato/contact/point_tangent.hpp"

#include <gtest/gtest.h>

#include "contact_system.hpp"
#include <string>
#include <utility>
#include <vector>

namespace rubato::contact::point_tangent_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Faces {
  std::string name;
  test::TwoFacesOptions options;
};

std::vector<Faces> every_kind() {
  std::vector<Faces> all;
  for (const auto type : {CellType::seg2, CellType::seg3, CellType::tria6, CellType::quad4, CellType::quad9})
    for (const int gauss : {0, 3}) {
      test::TwoFacesOptions options;
      options.slave = options.master = type;
      options.gauss = gauss;
      options.shift = 0.2;
      options.normal = gauss == 0 ? study::ContactNormal::master : study::ContactNormal::average;
      options.seed = static_cast<unsigned>(all.size()) + 5;
      all.push_back(
          {std::string(cell::topology(type).name) + (gauss == 0 ? "Nodes" : "BetweenNodes"), options});
    }
  return all;
}

class FactorsOf : public testing::TestWithParam<Faces> {
protected:
  Index multipliers() const { return setup.zone.multiplier_count(); }
  VectorXd some_multipliers() const { return VectorXd::LinSpaced(multipliers(), 0.4, 1.1); }
  std::vector<PointEvaluation> points_at(const VectorXd& u) const {
    return evaluate(setup.zone, some_multipliers(), setup.configuration(u));
  }

  /// The point's equations times its weight, those that it has.
  VectorXd equations_of(std::size_t p, const PointEvaluation& at, Status status) const {
    const auto all = respond(at.variables, status, law.of_point(p)).equations;
    VectorXd found(setup.zone.multipliers_per_node());
    for (Index row = 0; row < found.size(); ++row)
      found[row] = all[setup.zone.multiplier_variables()[static_cast<std::size_t>(row)]];
    return setup.zone.points[p].weight * found;
  }
  /// What the point puts on all dofs, internal side.
  VectorXd force_on_dofs(std::size_t p, const PointEvaluation& at, Status status) const {
    VectorXd force = VectorXd::Zero(setup.dofs.dof_count);
    at.kinematics->stencil.scatter(force_of(law, p, at, status), setup.dofs, force);
    return force;
  }
  /// Values of a point's dofs among all.
  static VectorXd at_dofs(const FactoredResponse& r, const VectorXd& all) {
    VectorXd found(static_cast<Index>(r.dofs.size()));
    for (std::size_t q = 0; q < r.dofs.size(); ++q)
      found[static_cast<Index>(q)] = all[r.dofs[q]];
    return found;
  }

  test::TwoFaces setup = test::two_faces(GetParam().options);
  std::vector<PointEvaluation> points = points_at(setup.u);
  ZoneCoefficients coefficients{std::vector<double>(points.size(), 3.0),
                                std::vector<double>(points.size(), 2.0)};
  ZoneLaw law{&setup.zone, &coefficients, setup.zone.settings.friction};
};

void expect_equal(const MatrixXd& found, const MatrixXd& expected) {
  EXPECT_LE((found - expected).lpNorm<Eigen::Infinity>(), 1e-12 * expected.lpNorm<Eigen::Infinity>() + 1e-14);
}

TEST_P(FactorsOf, HaveTheForceAndTheEquationsOfTheLaw) {
  for (const auto status : {Status::stick, Status::slip})
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (!points[p].kinematics)
        continue;
      FactoredResponse r;
      factor_response(law, p, points[p], status, setup.dofs, r);
      ASSERT_EQ(r.components, setup.dofs.components);
      ASSERT_EQ(r.n_xi, setup.dofs.components - 1);
      expect_equal(r.force, force_of(law, p, points[p], status).head(r.components));
      expect_equal(r.equations, equations_of(p, points[p], status));
      expect_equal(r.interpolation.topRows(r.components).transpose() * r.force,
                   at_dofs(r, force_on_dofs(p, points[p], status)));
    }
}

/// Nᵀ δz + Hᵀ δξ and δe, point by point, in the storage of the point before.
TEST_P(FactorsOf, AreTheDerivativesByTheDisplacements) {
  constexpr double h = 1e-6;
  FactoredResponse r;
  int compared = 0;
  for (const auto status : {Status::stick, Status::slip})
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (!points[p].kinematics)
        continue;
      factor_response(law, p, points[p], status, setup.dofs, r);
      const MatrixXd by_displacement = r.interpolation.transpose() * r.force_by_displacement();
      for (std::size_t q = 0; q < r.dofs.size(); ++q) {
        const auto ahead = points_at(test::moved(setup.u, r.dofs[q], h))[p];
        const auto back = points_at(test::moved(setup.u, r.dofs[q], -h))[p];
        const VectorXd force = (force_on_dofs(p, ahead, status) - force_on_dofs(p, back, status)) / (2 * h);
        const VectorXd equations = (equations_of(p, ahead, status) - equations_of(p, back, status)) / (2 * h);
        const auto column = static_cast<Index>(q);
        EXPECT_LT((at_dofs(r, force) - by_displacement.col(column)).lpNorm<Eigen::Infinity>(), 2e-6);
        EXPECT_LT(
            (equations - r.d_du.col(column).segment(r.components, r.multipliers())).lpNorm<Eigen::Infinity>(),
            2e-6);
        ++compared;
      }
    }
  EXPECT_GT(compared, 10);
}

/// Those of the point itself, whoever shares them.
TEST_P(FactorsOf, AreTheDerivativesByTheMultipliers) {
  constexpr double h = 1e-6;
  for (const auto status : {Status::stick, Status::slip})
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (!points[p].kinematics)
        continue;
      FactoredResponse r;
      factor_response(law, p, points[p], status, setup.dofs, r);
      const auto variables = setup.zone.multiplier_variables();
      for (Index m = 0; m < r.multipliers(); ++m) {
        auto ahead = points[p], back = points[p];
        for (auto& [at, by] : {std::pair(&ahead, h), std::pair(&back, -h)}) {
          const int variable = variables[static_cast<std::size_t>(m)];
          (variable == 0 ? at->variables.pressure : at->variables.semi[variable - 1]) += by;
        }
        const Eigen::Vector3d force =
            (force_of(law, p, ahead, status) - force_of(law, p, back, status)) / (2 * h);
        const VectorXd equations = (equations_of(p, ahead, status) - equations_of(p, back, status)) / (2 * h);
        EXPECT_LT((force.head(r.components) - r.by_multiplier.col(m).head(r.components)).norm(), 1e-8);
        EXPECT_LT((equations - r.by_multiplier.col(m).tail(r.multipliers())).norm(), 1e-8);
      }
    }
}

/// −λ/c and Λ, times the weight.
TEST_P(FactorsOf, OfOpenPointsAreTheEquationsOfTheirMultipliersAlone) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto open = open_equations(law, p, points[p]);
    const double weight = setup.zone.points[p].weight;
    VectorXd values(setup.zone.multipliers_per_node());
    values << -points[p].variables.pressure / 3, points[p].variables.semi.head(values.size() - 1);
    VectorXd slopes = VectorXd::Ones(values.size());
    slopes[0] = -1.0 / 3;
    EXPECT_GT(values.norm(), 0);
    expect_equal(open.values, weight * values);
    expect_equal(open.by_multiplier, weight * MatrixXd(slopes.asDiagonal()));
  }
}

TEST_P(FactorsOf, PointsInHeldFramesHaveNoPlaceThatMoves) {
  const auto frozen = with_frozen_frames(points);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!points[p].kinematics)
      continue;
    FactoredResponse moving, held;
    factor_response(law, p, points[p], Status::stick, setup.dofs, moving);
    factor_response(law, p, frozen[p], Status::stick, setup.dofs, held);
    EXPECT_EQ(held.n_xi, 0);
    EXPECT_EQ(held.interpolation.rows(), held.components);
    EXPECT_EQ(held.force_by_displacement().rows(), held.components);
    expect_equal(held.force, moving.force);
    expect_equal(held.equations, moving.equations);
    expect_equal(held.interpolation, moving.interpolation.topRows(held.components));
  }
}

INSTANTIATE_TEST_SUITE_P(Faces, FactorsOf, testing::ValuesIn(every_kind()),
                         [](const auto& kind) { return kind.param.name; });

/// An obstacle is no face: there is nothing that a place on it could turn or be shared among.
TEST(FactorsBeforeAnObstacle, HaveNoPlaceThatMoves) {
  test::TwoFacesOptions options;
  options.obstacle = Obstacle{};
  options.height = -0.02;
  const auto setup = test::two_faces(options);
  const VectorXd multipliers = VectorXd::Constant(setup.zone.multiplier_count(), 0.7);
  const auto points = evaluate(setup.zone, multipliers, setup.configuration(setup.u));
  const ZoneCoefficients coefficients{std::vector<double>(points.size(), 3.0),
                                      std::vector<double>(points.size(), 2.0)};
  const ZoneLaw law{&setup.zone, &coefficients, setup.zone.settings.friction};
  FactoredResponse r;
  factor_response(law, 0, points[0], Status::slip, setup.dofs, r);
  EXPECT_EQ(r.n_xi, 0);
  EXPECT_EQ(r.dofs.size(), 3U) << "those of its own node";
}

} // namespace
} // namespace rubato::contact::point_tangent_test
