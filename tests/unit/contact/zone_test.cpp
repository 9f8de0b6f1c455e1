// SPDX-License-Identifier: LGPL-3.0-or-later
// The points of a zone: which there are, what each weighs and which multipliers they have.
#include "rubato/contact/enforcement.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <numbers>
#include <string>
#include <vector>

namespace rubato::contact::zone_test {
namespace {

using deck::Setting;

/// A flat block on another one: the slave side is 2 long, in space 0.5 deep.
std::string blocks(bool solid) {
  const auto body = [&](const char* name, int y, const char* sides) {
    const std::string z0 = solid ? ", 0" : "", z1 = solid ? ", 0.5" : "";
    return "    - {name: " + std::string(name) + ", " + (solid ? "box" : "rectangle") + ": {from: [1, " +
           std::to_string(y) + z0 + "], to: [3, " + std::to_string(y + 1) + z1 + "]}, divisions: [3, 2" +
           (solid ? ", 2" : "") + "], cells: CELLS, sides: {" + sides + "}}\n";
  };
  return "mesh:\n  generate:\n" + body("lower", 0, "bottom: ground, top: below, left: side") +
         body("upper", 1, "top: roof, bottom: above, left: side") +
         "physics: " + (solid ? "solid" : "plane_strain") +
         "\nmaterials: {rubber: {young: 1e6, poisson: 0.3}}\n"
         "supports: [{on: ground, fix: [x, y" +
         (solid ? ", z" : "") + "]}, {on: roof, fix: [x, y" + (solid ? ", z" : "") +
         "]}]\n"
         "contact: {rest: {master: below, slave: above, integration: nodes, friction: 0.2}}\n"
         "time: {scheme: static, step: 1, end: 1}\n";
}

bool is_solid(const std::string& cells) {
  return cells.starts_with("hexa") || cells.starts_with("tetra") || cells.starts_with("penta");
}

test::BuiltModel model_of(const std::string& cells, std::vector<Setting> changes = {}) {
  auto deck = blocks(is_solid(cells));
  for (auto at = deck.find("CELLS"); at != std::string::npos; at = deck.find("CELLS"))
    deck.replace(at, 5, cells);
  return test::model_of(deck, changes);
}

double area(const Zone& zone) {
  double sum = 0;
  for (const auto& point : zone.points)
    sum += point.area;
  return sum;
}

class ZoneOn : public testing::TestWithParam<const char*> {
protected:
  bool solid_ = is_solid(GetParam());
};

TEST_P(ZoneOn, HasTheAreaOfItsSlaveSurface) {
  for (const char* integration : {"", "{gauss: 3}"}) {
    std::vector<Setting> changes;
    if (*integration != '\0')
      changes.push_back({"contact.rest.integration", integration});
    const auto model = model_of(GetParam(), changes);
    EXPECT_NEAR(area(model.zones.front()), solid_ ? 1.0 : 2.0, 1e-13) << integration;
  }
}

TEST_P(ZoneOn, HasTheForceOfAUniformPressureInItsWeightsByMultipliers) {
  const auto model = model_of(GetParam());
  const auto& zone = model.zones.front();
  std::vector<double> share(zone.slave.nodes.size(), 0.0);
  for (const auto& point : zone.points)
    for (std::size_t j = 0; j < point.multipliers.size(); ++j)
      share[static_cast<std::size_t>(point.multipliers[j])] += point.weight * point.multiplier_shape[j];
  double sum = 0;
  for (const double part : share)
    sum += part;
  EXPECT_NEAR(sum, area(zone), 1e-13);
  // Moments about the middle vanish too: the surface is flat and the pressure uniform.
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < share.size(); ++i)
    moment += share[i] * (model.mesh.points[static_cast<std::size_t>(zone.slave.nodes[i])] -
                          Eigen::Vector3d(2, 1, solid_ ? 0.25 : 0));
  EXPECT_LT(moment.norm(), 1e-13);
}

TEST_P(ZoneOn, HasOnePointOfWeightOneANodeByNodalMethods) {
  const auto model = model_of(GetParam(), {{"contact.rest.method", "nodal_lagrange"}});
  const auto& zone = model.zones.front();
  ASSERT_EQ(zone.points.size(), zone.slave.nodes.size());
  for (const auto& point : zone.points)
    EXPECT_EQ(point.weight, 1);
  EXPECT_NEAR(area(zone), solid_ ? 1.0 : 2.0, 1e-13);
  EXPECT_TRUE(zone.points_own_multipliers);
}

TEST_P(ZoneOn, UsesAtMostAThousandTimesTheUsualAugmentationOfFriction) {
  const auto tangential = [&](const char* integration, const char* method, const char* friction) {
    const auto model = model_of(GetParam(), {{"contact.rest.integration", integration},
                                             {"contact.rest.friction", "0.5"},
                                             {"contact.rest.friction_method", friction},
                                             {"contact.rest.method", method},
                                             {"contact.rest.coefficients.tangential", "1e12"}});
    const Eigen::VectorXd diagonal = Eigen::VectorXd::Ones(model.dofs.dof_count);
    const auto& zone = model.zones.front();
    return automatic_coefficients(zone, model.dofs, diagonal).tangential.front() * zone.edge();
  };
  const double most = 1e3 / 0.002;
  EXPECT_NEAR(tangential("mortar", "augmented_lagrangian", "augmented_lagrangian"), most, 1e-9 * most);
  EXPECT_NEAR(tangential("nodes", "penalty", "augmented_lagrangian"), most, 1e-9 * most);
  EXPECT_GT(tangential("nodes", "penalty", "penalty"), 1e3 * most);
}

INSTANTIATE_TEST_SUITE_P(Cells, ZoneOn,
                         testing::Values("tria3", "tria6", "quad4", "quad8", "quad9", "tetra4", "tetra10",
                                         "penta6", "penta15", "hexa8", "hexa20", "hexa27"),
                         [](const auto& cells) { return std::string(cells.param); });

/// 2πr from r = 1 to r = 3.
TEST(AxisymmetricZone, HasTheAreaOfItsRing) {
  for (const char* cells : {"tria3", "tria6", "quad4", "quad8"})
    for (const char* method : {"augmented_lagrangian", "penalty"}) {
      const auto model = model_of(cells, {{"physics", "axisymmetric"},
                                          {"contact.rest.method", method},
                                          {"supports", "[{on: ground, fix: y}, {on: roof, fix: y}]"}});
      EXPECT_NEAR(area(model.zones.front()), std::numbers::pi * 8, 1e-12) << cells;
    }
}

TEST(PlaneZone, HasTheThicknessInItsWeights) {
  const auto model = model_of("quad4", {{"thickness", "0.25"}});
  EXPECT_NEAR(area(model.zones.front()), 0.5, 1e-14);
}

TEST(ExcludedNodes, KeepTheirPointsOutOfContact) {
  for (const char* cells : {"quad4", "quad8", "hexa8", "tetra10"}) {
    const auto model = model_of(cells, {{"contact.rest.exclude_nodes", "[side]"}});
    const auto whole = model_of(cells);
    int excluded = 0;
    for (const auto& point : model.zones.front().points)
      excluded += point.excluded ? 1 : 0;
    EXPECT_GT(excluded, 0) << cells;
    EXPECT_LT(excluded, static_cast<int>(model.zones.front().points.size())) << cells;
    EXPECT_EQ(area(model.zones.front()), area(whole.zones.front())) << cells;
  }
}

struct Unknowns {
  std::string method;
  std::string friction_method;
  std::string friction;
  std::vector<int> in_plane; ///< of λ, Λ₁, Λ₂
  std::vector<int> in_space;
};

class MultipliersOf : public testing::TestWithParam<Unknowns> {};

TEST_P(MultipliersOf, AreThoseThatItsMethodsSolveFor) {
  const auto& wanted = GetParam();
  for (const bool solid : {false, true}) {
    const auto model =
        model_of(solid ? "hexa8" : "quad4", {{"contact.rest.method", wanted.method},
                                             {"contact.rest.friction_method", wanted.friction_method},
                                             {"contact.rest.friction", wanted.friction}});
    const auto& zone = model.zones.front();
    const auto variables = zone.multiplier_variables();
    EXPECT_EQ(std::vector<int>(variables.begin(), variables.end()),
              solid ? wanted.in_space : wanted.in_plane);
    EXPECT_EQ(zone.multiplier_count(),
              static_cast<int>(zone.slave.nodes.size()) * zone.multipliers_per_node());
    EXPECT_EQ(zone.owns_multipliers(), zone.multipliers_per_node() > 0);
    EXPECT_FALSE(zone.shares_multipliers());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, MultipliersOf,
    testing::Values(Unknowns{"augmented_lagrangian", "augmented_lagrangian", "0.2", {0, 1}, {0, 1, 2}},
                    Unknowns{"augmented_lagrangian", "augmented_lagrangian", "0", {0}, {0}},
                    Unknowns{"augmented_lagrangian", "penalty", "0.2", {0}, {0}},
                    Unknowns{"penalty", "augmented_lagrangian", "0.2", {1}, {1, 2}},
                    Unknowns{"penalty", "penalty", "0.2", {}, {}},
                    Unknowns{"nodal_lagrange", "nodal_penalty", "0.2", {0}, {0}},
                    Unknowns{"nodal_penalty", "nodal_penalty", "0.2", {}, {}}));

TEST(SharedMultipliers, AreThoseOfFacesWhosePointsStandBetweenNodes) {
  EXPECT_TRUE(model_of("hexa20").zones.front().shares_multipliers());
  EXPECT_TRUE(model_of("tetra10").zones.front().shares_multipliers());
  EXPECT_TRUE(
      model_of("quad4", {{"contact.rest.integration", "{gauss: 2}"}}).zones.front().shares_multipliers());
  EXPECT_FALSE(model_of("hexa27").zones.front().shares_multipliers());
  EXPECT_FALSE(model_of("quad8").zones.front().shares_multipliers()) << "its sides are SEG3";
}

TEST(AZone, MeetsItselfWhereItsSettingsNameOneSurface) {
  const auto model = model_of("quad4");
  const auto& two = model.zones.front();
  EXPECT_FALSE(two.meets_itself());
  EXPECT_TRUE(two.undeformed_master.empty());
  auto settings = two.settings;
  settings.self = settings.slave;
  const auto one = make_zone(model.mesh, settings, two.slave, two.slave, {}, {2, 1.0, {}});
  EXPECT_TRUE(one.meets_itself());
  EXPECT_EQ(one.undeformed_master.size(), one.slave.nodes.size());
}

TEST(ThePlaceAtTheStartOfAStep, IsTheSameToTheLastBitWhereverTheNodeHasGone) {
  const auto model = model_of("hexa8");
  Eigen::VectorXd start(model.dofs.dof_count), u(model.dofs.dof_count);
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    start[i] = 0.01 / static_cast<double>(i + 3);
    u[i] = start[i] + 7.0 / static_cast<double>(i + 11);
  }
  const Configuration before{&model.mesh, &model.dofs, &start, &start};
  const Configuration later{&model.mesh, &model.dofs, &u, &start};
  for (const auto node : model.dofs.nodes) {
    const Eigen::Vector3d place =
        model.mesh.points[static_cast<std::size_t>(node)] + start.segment<3>(model.dofs.dof(node, 0));
    EXPECT_EQ(later.start_position(node), place);
    EXPECT_EQ(before.position(node), place);
    EXPECT_NE(later.position(node), place);
  }
}

} // namespace
} // namespace rubato::contact::zone_test
