// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"

#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"
#include <limits>
#include <numbers>
#include <random>

namespace rubato::operators_test {
namespace {

using namespace contact::mortar;
using test::Map;
using test::Vector3d;

/// In 2D the second parameter is none, and up is y.
Map flat(int dimension, double low, double high, double height) {
  return [=](double s, double t) -> Vector3d {
    const double x = low + s * (high - low), y = low + t * (high - low);
    return dimension == 1 ? Vector3d(x, height, 0) : Vector3d(x, y, height);
  };
}

/// Faces that are no parallelograms: their reference coordinates are not linear in x.
Map skewed(int dimension, double low, double high, double height, double amount) {
  return [=, plain = flat(dimension, low, high, height)](double s, double t) {
    Vector3d x = plain(s + amount * s * (1 - s), t);
    if (dimension == 2)
      x[1] += amount * s * t * (1 - t);
    return x;
  };
}

/// Every pairing of faces: 36 of solids, 4 of plane bodies.
std::vector<std::array<CellType, 2>> every_pairing() {
  std::vector<std::array<CellType, 2>> pairings;
  for (const auto slave : test::solid_types)
    for (const auto master : test::solid_types)
      pairings.push_back({slave, master});
  for (const auto slave : test::plane_types)
    for (const auto master : test::plane_types)
      pairings.push_back({slave, master});
  return pairings;
}

class EveryPairing : public testing::TestWithParam<std::array<CellType, 2>> {
protected:
  CellType slave() const { return GetParam()[0]; }
  CellType master() const { return GetParam()[1]; }
  int dimension() const { return cell::topology(slave()).dimension; }
  test::TwoSurfaces surfaces(const Map& slave_map, const Map& master_map) const {
    return test::two_surfaces({.type = slave(), .along = 4, .across = 3}, slave_map,
                              {.type = master(), .along = 3, .across = 4}, master_map);
  }
};

TEST_P(EveryPairing, SeesNoGapInALinearFieldOfFacesThatLieOnEachOther) {
  const auto two = surfaces(skewed(dimension(), 0, 1, 0, 0.2), skewed(dimension(), 0, 1, 0, -0.15));
  const auto operators = two.operators();
  EXPECT_NEAR(operators.covered_area, 1, dimension() == 1 ? 1e-14 : 2e-2);
  auto moved = two.mesh.points;
  for (auto& x : moved)
    x += Vector3d(3 + 0.3 * x[0] - 0.2 * x[1], 0.1 * x[0] + 0.7 * x[1],
                  dimension() == 1 ? 0. : 0.4 * x[0] - x[1]);
  for (const auto& node : operators.nodes) {
    ASSERT_TRUE(node.kept());
    EXPECT_LE(gap_vector(node, test::reading(two.mesh.points)).norm(), 1e-14);
    EXPECT_LE(gap_vector(node, test::reading(moved)).norm(), 5e-14);
    EXPECT_NEAR(node.gap, 0, 1e-14);
  }
}

TEST_P(EveryPairing, SeesAConstantGap) {
  const auto two = surfaces(flat(dimension(), 0, 1, 0.03), flat(dimension(), -0.3, 1.2, 0));
  const auto operators = two.operators();
  for (const auto& node : operators.nodes) {
    ASSERT_TRUE(node.kept());
    EXPECT_NEAR(node.gap, 0.03, 1e-15);
    EXPECT_NEAR(node.normal[dimension()], 1, 1e-15);
    EXPECT_NEAR(node.weight, node.full_weight, 1e-14);
    EXPECT_LE((gap_vector(node, test::reading(two.mesh.points)) - 0.03 * Vector3d::Unit(dimension())).norm(),
              1e-14);
  }
}

TEST_P(EveryPairing, HandsOnAUniformPressureWhereTheSlaveIsCovered) {
  const auto two = surfaces(flat(dimension(), 0, 1, 0.03), flat(dimension(), -0.3, 1.2, 0));
  const auto forces = test::forces_of_unit_pressure(two, two.operators());
  const auto expected = test::integrals_of_shapes(two.mesh, two.slave);
  double sum = 0;
  for (const auto node : two.slave.nodes)
    EXPECT_NEAR(forces[static_cast<std::size_t>(node)], expected[static_cast<std::size_t>(node)], 1e-13);
  for (const double force : forces)
    sum += force;
  EXPECT_NEAR(sum, 0, 1e-13);
}

TEST_P(EveryPairing, HandsOnAUniformPressureWhereTheSlaveIsPartlyCovered) {
  const auto two = surfaces(flat(dimension(), -0.3, 1.2, 0.03), flat(dimension(), 0, 1, 0));
  const auto operators = two.operators();
  EXPECT_NEAR(operators.covered_area, 1, 1e-13);
  const auto forces = test::forces_of_unit_pressure(two, operators);
  const auto expected = test::integrals_of_shapes(two.mesh, two.master);
  double sum = 0;
  for (const auto node : two.master.nodes)
    EXPECT_NEAR(-forces[static_cast<std::size_t>(node)], expected[static_cast<std::size_t>(node)], 2e-13);
  for (const double force : forces)
    sum += force;
  EXPECT_NEAR(sum, 0, 1e-13);
}

/// A slave that bulges towards the master touches it in one place, where its mean gap is below every gap.
/// Gaps are measured along normals, which are off the master's by at most 0.04.
TEST_P(EveryPairing, MovesLiftedGapsAsTheirWeightsSay) {
  const auto up = dimension();
  for (const double height : {0.02, -0.0002}) {
    const auto two = surfaces(
        [&, plain = flat(dimension(), -0.53, 0.47, 0)](double s, double t) {
          Vector3d x = plain(s, t);
          x[up] = height + 0.04 * x[0] * x[0] + (up == 2 ? 0.03 * x[1] * x[1] : 0.);
          return x;
        },
        flat(dimension(), -1.1, 1.3, 0));
    const auto operators = two.operators();
    constexpr double step = 1e-7;
    auto places = two.mesh.points;
    for (const auto node : two.slave.nodes)
      places[static_cast<std::size_t>(node)][up] += step;
    const auto moved = two.operators_at(places);
    int lifted = 0;
    for (std::size_t j = 0; j < operators.nodes.size(); ++j) {
      const auto& node = operators.nodes[j];
      if (node.gap_weights.size() == 0)
        continue;
      ++lifted;
      double expected = 0;
      for (int i = 0; i < node.slave_nodes; ++i)
        expected += node.gap_weights[i] * node.normal[up];
      EXPECT_NEAR((moved.nodes[j].gap - node.gap) / step, expected, 4e-3);
      if (height > 0) { // nothing overlaps: all gaps change alike
        EXPECT_NEAR(node.gap_weights.sum(), 0, 1e-12);
      }
    }
    EXPECT_GT(lifted, 0);
  }
}

TEST_P(EveryPairing, GivesNoForceInSumOnCurvedSurfaces) {
  const auto bent = [&](double low, double high, double height) -> Map {
    return [=, this, plain = flat(dimension(), low, high, 0)](double s, double t) {
      Vector3d x = plain(s, t);
      x[dimension()] += height + 0.1 * x[0] * x[0] - (dimension() == 2 ? 0.05 * x[1] * x[1] : 0.);
      return x;
    };
  };
  const auto two = surfaces(bent(0, 1, 0.01), bent(-0.2, 0.8, 0));
  const auto operators = two.operators();
  EXPECT_GT(operators.kept_count, 0);
  for (const auto& node : operators.nodes)
    if (node.kept()) {
      EXPECT_NEAR(node.stencil.weights.sum(), 0, 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(Mortar, EveryPairing, testing::ValuesIn(every_pairing()), [](const auto& instance) {
  return test::name_of(instance.param[0]) + "On" + test::name_of(instance.param[1]);
});

TEST(MortarOperators, OfMatchingMeshesTieEachNodeToItsOpposite) {
  for (const auto type : {CellType::seg2, CellType::tria3, CellType::quad4}) {
    const int dimension = cell::topology(type).dimension;
    const test::GridOptions grid{.type = type, .along = 3, .across = 3};
    const auto two = test::two_surfaces(grid, flat(dimension, 0, 1, 0), grid, flat(dimension, 0, 1, 0));
    const auto operators = two.operators();
    for (std::size_t j = 0; j < two.slave.nodes.size(); ++j) {
      const auto& node = operators.nodes[j];
      const auto& stencil = node.stencil;
      for (std::size_t i = 0; i < stencil.nodes.size(); ++i) {
        const auto& x = two.mesh.points[static_cast<std::size_t>(stencil.nodes[i])];
        const auto& own = two.mesh.points[static_cast<std::size_t>(two.slave.nodes[j])];
        const double expected = (x - own).norm() > 1e-9                          ? 0
                                : i < static_cast<std::size_t>(node.slave_nodes) ? 1
                                                                                 : -1;
        EXPECT_NEAR(stencil.weights[static_cast<Eigen::Index>(i)], expected, 3e-14) << test::name_of(type);
      }
    }
  }
}

TEST(MortarOperators, OfMatchingQuadraticMeshesAreTheSameOnBothSides) {
  for (const auto type :
       {CellType::seg3, CellType::tria6, CellType::tria7, CellType::quad8, CellType::quad9}) {
    const int dimension = cell::topology(type).dimension;
    const test::GridOptions grid{.type = type, .along = 2, .across = 2};
    const auto two =
        test::two_surfaces(grid, skewed(dimension, 0, 1, 0, 0.2), grid, skewed(dimension, 0, 1, 0, 0.2));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::map<std::array<long, 2>, Vector3d> field; // the same at the same place
    std::vector<Vector3d> values;
    for (const auto& x : two.mesh.points)
      values.push_back(field
                           .try_emplace({std::lround(1e6 * x[0]), std::lround(1e6 * x[1])},
                                        Vector3d(unit(random), unit(random), unit(random)))
                           .first->second);
    const auto operators = two.operators();
    for (const auto& node : operators.nodes)
      EXPECT_LE(gap_vector(node, test::reading(values)).norm(), 1e-12) << test::name_of(type);
  }
}

TEST(MortarOperators, OfABodyOfRevolutionWeighRingsAndTheAxis) {
  for (const auto type : test::plane_types) {
    const auto two = test::two_surfaces({.type = type, .along = 4}, flat(1, 0, 2, 0),
                                        {.type = type, .along = 3}, flat(1, 0, 2, 0));
    const auto operators = two.operators({}, {.thickness = 1, .ring = true});
    EXPECT_NEAR(operators.covered_area, std::numbers::pi * 4, 1e-13);
    for (std::size_t j = 0; j < operators.nodes.size(); ++j) {
      const auto& node = operators.nodes[j];
      EXPECT_GT(node.weight, 0);
      EXPECT_EQ(node.normal, Vector3d(0, 1, 0));
      EXPECT_NEAR(node.weight, node.full_weight, 1e-13);
    }
    const auto forces = test::forces_of_unit_pressure(two, operators);
    const auto slave = test::integrals_of_shapes(two.mesh, two.slave, {.thickness = 1, .ring = true});
    const auto master = test::integrals_of_shapes(two.mesh, two.master, {.thickness = 1, .ring = true});
    for (std::size_t i = 0; i < forces.size(); ++i)
      EXPECT_NEAR(forces[i], slave[i] - master[i], 1e-13) << test::name_of(type);
  }
}

TEST(MortarOperators, OfAPlateAreMultipliedWithItsThickness) {
  const auto two = test::two_surfaces({.type = CellType::seg3, .along = 2}, flat(1, 0, 1, 0),
                                      {.type = CellType::seg2, .along = 3}, flat(1, 0, 1, 0));
  EXPECT_NEAR(two.operators({}, {.thickness = 0.2}).covered_area, 0.2, 1e-15);
}

TEST(MortarOperators, MeasureTheUndeformedSlave) {
  const auto two = test::two_surfaces({.type = CellType::quad8, .along = 2, .across = 2}, flat(2, 0, 1, 0),
                                      {.type = CellType::tria6, .along = 3, .across = 3}, flat(2, 0, 1, 0));
  auto stretched = two.mesh.points;
  for (auto& x : stretched)
    x[0] *= 3;
  EXPECT_NEAR(two.operators_at(stretched).covered_area, 1, 1e-13);
}

TEST(MortarOperators, LeaveOutPairsThatMayNotMeet) {
  const auto two = test::two_surfaces({.type = CellType::quad4, .along = 2, .across = 2}, flat(2, 0, 1, 0),
                                      {.type = CellType::quad4, .along = 2, .across = 2}, flat(2, 0, 1, 0));
  EXPECT_NEAR(two.operators({.may_pair = [](int slave, int) { return slave != 0; }}).covered_area, 0.75,
              1e-14);
}

TEST(MortarOperators, AreTheSameInUsedStorage) {
  const auto map = flat(2, 0, 1, 0);
  const auto two =
      test::two_surfaces({.type = CellType::quad9, .along = 3, .across = 2}, map,
                         {.type = CellType::tria3, .along = 2, .across = 3}, flat(2, 0.2, 0.9, 0));
  auto elsewhere = two.mesh.points;
  for (const auto node : two.slave.nodes)
    elsewhere[static_cast<std::size_t>(node)] += Vector3d(0.1, 0.2, 0);
  Workspace workspace;
  Operators used;
  for (const auto& points : {elsewhere, two.mesh.points})
    integrate(two.slave, two.reference(), two.master, test::TwoSurfaces::at(two.slave, points),
              test::TwoSurfaces::at(two.master, points), {}, workspace, used);
  const auto fresh = two.operators();
  for (std::size_t j = 0; j < fresh.nodes.size(); ++j) {
    EXPECT_EQ(fresh.nodes[j].stencil.nodes, used.nodes[j].stencil.nodes);
    EXPECT_EQ(fresh.nodes[j].stencil.weights, used.nodes[j].stencil.weights);
    EXPECT_EQ(fresh.nodes[j].weight, used.nodes[j].weight);
    EXPECT_EQ(fresh.nodes[j].receivers, used.nodes[j].receivers);
  }
}

TEST(MortarOperators, AreRefusedWhereAPositionIsNotFinite) {
  auto two = test::two_surfaces({.type = CellType::quad4, .along = 2}, flat(2, 0, 1, 0),
                                {.type = CellType::quad4}, flat(2, 0, 1, 0));
  const auto reference = two.reference();
  auto x = two.slave_x();
  x[static_cast<std::size_t>(two.slave.faces[1].positions[2])][2] = std::numeric_limits<double>::quiet_NaN();
  try {
    integrate(two.slave, reference, two.master, x, two.master_x());
    FAIL() << "a position that is not a number was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("face 1 of the slave surface"), std::string::npos)
        << error.what();
  }
}

TEST(MortarOperators, StandFacesWithoutAreaAndCrushedOnes) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> any(0, 1000);
  for (const auto& [slave, master] : every_pairing()) {
    const int dimension = cell::topology(slave).dimension;
    const auto two = test::two_surfaces({.type = slave, .along = 2, .across = 2}, flat(dimension, 0, 1, 0),
                                        {.type = master, .along = 2, .across = 2}, flat(dimension, 0, 1, 0));
    for (int trial = 0; trial < 6; ++trial) {
      auto points = two.mesh.points;
      for (auto& x : points) {
        if (trial % 3 == 0) // crushed at random
          x += 0.7 * Vector3d(unit(random), unit(random), dimension == 1 ? 0. : unit(random));
        if (trial % 3 == 1) // no area
          x[0] = 0.25;
      }
      if (trial % 3 == 2) // nodes on top of each other
        for (int k = 0; k < 3; ++k)
          points[static_cast<std::size_t>(any(random)) % points.size()] =
              points[static_cast<std::size_t>(any(random)) % points.size()];
      const auto operators = two.operators_at(points);
      for (const auto& node : operators.nodes) {
        EXPECT_TRUE(std::isfinite(node.weight) && node.weight >= 0);
        EXPECT_TRUE(node.stencil.weights.allFinite());
        EXPECT_TRUE(node.normal.allFinite() && node.tangents.allFinite());
      }
    }
  }
}

} // namespace
} // namespace rubato::operators_test
