// SPDX-License-Identifier: LGPL-3.0-or-later
// What supports prescribe, and springs to the ground.
#include <gtest/gtest.h>

#include "unit/model/meshes.hpp"
#include <cmath>

namespace rubato::model::supports_test {
namespace {

using study::Amplitude;
using study::Support;
using Texts = std::vector<std::string>;

constexpr std::nullopt_t none = std::nullopt;

/// Two squares in a row: nodes 0 to 2 below, 3 to 5 above; and a node, 6, that no cell has.
class Supported : public testing::Test {
protected:
  static test::Numbered part() {
    auto builder = test::row_of_squares(2);
    builder.add_node(Eigen::Vector3d(5, 5, 0));
    builder.add_to_node_group("loose", std::array{6});
    builder.add_to_node_group("mixed", std::array{1, 6});
    auto study = test::plane_study({test::elastic("any")});
    study.functions["ramp"] = {{0, 2}, {0, 1}};
    study.functions["same"] = {{0, 2}, {0, 1}};
    return {study, std::move(builder).build()};
  }
  constraint::Reduction reduction_of(const std::vector<Support>& supports) {
    auto numbered = part();
    numbered.study.supports = supports;
    return make_reduction(numbered.study, numbered.mesh, numbered.dofs, {}, faults_, notes_);
  }
  Texts told() const { return test::told(faults_); }

  std::vector<Fault> faults_;
  Texts notes_;
};

TEST_F(Supported, NodesAreHeldInTheComponentsThatAreNamed) {
  const auto reduction = reduction_of({{"wall", {none, Amplitude{0.5, "ramp"}, none}}});
  ASSERT_EQ(reduction.prescribed().size(), 2U);
  EXPECT_EQ(reduction.prescribed()[0].dof, 1);
  EXPECT_EQ(reduction.prescribed()[1].dof, 7);
  EXPECT_EQ(reduction.unknown_count(), 10);
  EXPECT_EQ(reduction.imposed(1)[7], 0.25);
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Supported, NodesWithoutCellsNeedNoSupport) {
  EXPECT_EQ(reduction_of({{"mixed", {Amplitude{0, ""}, Amplitude{0, ""}, none}}}).prescribed().size(), 2U);
  EXPECT_TRUE(faults_.empty());
  reduction_of({{"loose", {Amplitude{0, ""}, none, none}}});
  EXPECT_EQ(told(),
            (Texts{"supports.0.on: found 'loose', none of whose nodes belongs to a cell that deforms, "
                   "expected a part of a body to hold"}));
}

TEST_F(Supported, DofsMayBeHeldTwiceInTheSameWay) {
  const Amplitude half{0.5, "ramp"};
  EXPECT_EQ(reduction_of({{"wall", {half, none, none}}, {"N1", {half, none, none}}}).prescribed().size(), 2U);
  reduction_of({{"wall", {half, none, none}}, {"N1", {Amplitude{0.5, "same"}, none, none}}});
  EXPECT_TRUE(faults_.empty()) << "another name of the same function";
}

TEST_F(Supported, DofsMayNotBeHeldInTwoWays) {
  const Texts wanted{"supports.1: node N1 (0, 0) has two different displacements prescribed in x"};
  for (const auto& other : {Amplitude{0.25, "ramp"}, Amplitude{0.5, ""}}) {
    faults_.clear();
    reduction_of({{"wall", {Amplitude{0.5, "ramp"}, none, none}}, {"wall", {other, none, none}}});
    EXPECT_EQ(told(), wanted);
  }
}

TEST_F(Supported, NodesMoveAsTheTableAlongAnAxisSays) {
  const study::Field along{Profile{1, {{0, 2}, {1e-3, 5e-3}, LinearTable::Outside::constant}}, "ramp"};
  const auto reduction = reduction_of({{"wall", {along, none, none}}});
  ASSERT_TRUE(faults_.empty());
  EXPECT_DOUBLE_EQ(reduction.imposed(2)[0], 1e-3);
  EXPECT_DOUBLE_EQ(reduction.imposed(2)[6], 3e-3); // y = 1
  EXPECT_DOUBLE_EQ(reduction.imposed(1)[6], 1.5e-3);
}

TEST_F(Supported, NodesMoveAsTheExpressionOfTheirPlaceSays) {
  const study::Field along{study::Formula{"1e-3*y"}, "ramp"};
  const auto still = reduction_of({{"wall", {along, none, none}}});
  ASSERT_EQ(still.prescribed().size(), 2U);
  EXPECT_FALSE(still.prescribed()[0].imposed.field || still.prescribed()[1].imposed.field)
      << "a number at each node";
  EXPECT_EQ(still.imposed(1)[0], 0);
  EXPECT_EQ(still.imposed(1)[6], 0.5e-3);
  const study::Field moving{study::Formula{"y*t^2"}, "ramp"};
  const auto moved = reduction_of({{"wall", {moving, none, none}}});
  EXPECT_EQ(moved.imposed(2)[6], 4);
  EXPECT_EQ(moved.imposed(1)[6], 0.5);
  EXPECT_TRUE(faults_.empty());
}

/// About (1, 0).
study::Rotation turn(const std::string& angle) {
  return {{1, 0, 0}, {0, 0, 3}, study::Field{study::Formula{angle}, "ramp"}};
}

TEST_F(Supported, NodesRotateExactlyAboutAPoint) {
  Support turned{"wall", {none, Amplitude{10, ""}, none}};
  turned.rotate = turn("0.05");
  const auto reduction = reduction_of({turned});
  ASSERT_TRUE(faults_.empty());
  EXPECT_EQ(reduction.prescribed().size(), 4U) << "x is held, too";
  const auto u = reduction.imposed(2);
  EXPECT_NEAR(u[0], 1 - std::cos(0.05), 1e-16); // at (0, 0)
  EXPECT_NEAR(u[1], 10 - std::sin(0.05), 1e-15);
  EXPECT_NEAR(u[6], 1 - std::cos(0.05) - std::sin(0.05), 1e-16);      // at (0, 1)
  EXPECT_NEAR(u[7], 10 - std::sin(0.05) + std::cos(0.05) - 1, 4e-15); // two units in its last digit
  EXPECT_NEAR(reduction.imposed(1)[0], 1 - std::cos(0.025), 1e-16);
}

/// Edges above the squares that bound none: a rigid surface.
TEST_F(Supported, RigidSurfacesRotateByAnyAngle) {
  auto builder = test::row_of_squares(2);
  const int left = builder.add_node(Eigen::Vector3d(0, 1.5, 0));
  const int right = builder.add_node(Eigen::Vector3d(1, 1.5, 0));
  builder.add_to_cell_group("tool", std::array{builder.add_cell(CellType::seg2, std::array{right, left})});
  auto study = test::plane_study({test::elastic("any")});
  study.time.end = 2;
  study.contact.emplace_back().master = "tool";
  Support turned{"tool", {none, none, none}};
  turned.rotate = study::Rotation{{1, 0, 0}, {0, 0, 1}, study::Field{study::Formula{"pi/4*t"}}};
  study.supports = {turned};
  const auto mesh = std::move(builder).build();
  auto numbered = rigid_faces(study, mesh);
  ASSERT_EQ(numbered.size(), 1U);
  const auto bulk = make_bulk(study, mesh, faults_);
  numbered.insert(numbered.end(), bulk.cells.begin(), bulk.cells.end());
  const auto dofs = domain::number_dofs(mesh, numbered, 2);
  const auto reduction = make_reduction(study, mesh, dofs, {}, faults_, notes_);
  EXPECT_EQ(told(), Texts{});
  const auto u = reduction.imposed(2);
  EXPECT_NEAR(u[dofs.dof(left, 0)], -0.5, 1e-15); // (0, 1.5) to (-0.5, -1)
  EXPECT_NEAR(u[dofs.dof(left, 1)], -2.5, 1e-15);
  EXPECT_NEAR(u[dofs.dof(right, 0)], -1.5, 1e-15); // (1, 1.5) to (-0.5, 0)
}

/// At its largest within the run, on an instant of its steps.
TEST_F(Supported, BodiesOfSmallStrainRotateByLittle) {
  const auto refused = [&](const study::Field& angle) {
    faults_.clear();
    Support turned{"wall", {none, none, none}};
    turned.rotate = study::Rotation{{1, 0, 0}, {0, 0, 1}, angle};
    auto numbered = part();
    numbered.study.time.step = 0.25;
    numbered.study.time.end = 2;
    numbered.study.supports = {turned};
    make_reduction(numbered.study, numbered.mesh, numbered.dofs, {}, faults_, notes_);
    return told();
  };
  const std::string sentence =
      ", expected at most 0.05 radians, or materials with strain: green_lagrange or logarithmic: with small "
      "strain a body that rotates stretches by 1 − cos of the angle";
  EXPECT_EQ(refused({study::Formula{"-0.025*t"}}), Texts{});
  EXPECT_EQ(refused({study::Formula{"-0.04*t"}}),
            (Texts{"supports.0.rotate.angle: found an angle of -0.08 at t = 2" + sentence}));
  EXPECT_EQ(refused({study::Formula{"if(t == 0.75, 0.06, 0)"}}),
            (Texts{"supports.0.rotate.angle: found an angle of 0.06 at t = 0.75" + sentence}));
  study::Field spin{study::Formula{"0.06"}, "ramp"};
  spin.given = study::Given::velocity;
  EXPECT_EQ(refused(spin), (Texts{"supports.0.rotate.angle: found an angle of 0.06 at t = 2" + sentence}));
}

TEST_F(Supported, BodiesOfLargeStrainRotateByAnyAngle) {
  auto numbered = part();
  numbered.study.materials[0].strain = study::StrainKind::green_lagrange;
  numbered.study.time.end = 2;
  Support turned{"wall", {none, none, none}};
  turned.rotate = turn("pi/2");
  numbered.study.supports = {turned};
  const auto reduction = make_reduction(numbered.study, numbered.mesh, numbered.dofs, {}, faults_, notes_);
  EXPECT_EQ(told(), Texts{});
  const auto u = reduction.imposed(2);
  EXPECT_NEAR(u[0], 1, 1e-15); // (0, 0) to (1, -1)
  EXPECT_NEAR(u[1], -1, 1e-15);
  EXPECT_NEAR(u[6], 0, 1e-15); // (0, 1) to (0, -1)
  EXPECT_NEAR(u[7], -2, 1e-15);
}

TEST_F(Supported, NodesOnTheLineOfARotationAreHeld) {
  Support turned{"floor", {none, none, none}};
  turned.rotate = turn("0.04");
  const auto reduction = reduction_of({turned, {"N2", {Amplitude{}, Amplitude{}, none}}});
  EXPECT_TRUE(faults_.empty()) << "N2 stands on the line";
  for (const auto& prescribed : reduction.prescribed())
    EXPECT_EQ(reduction.moves(prescribed), prescribed.dof != 2 && prescribed.dof != 3) << prescribed.dof;
}

TEST_F(Supported, RotationsContradictOtherSupports) {
  Support turned{"wall", {none, none, none}};
  turned.rotate = turn("0.04");
  auto other = turned;
  reduction_of({turned, other});
  EXPECT_TRUE(faults_.empty()) << "the same twice";
  other.rotate->about[1] = 1;
  reduction_of({turned, other});
  EXPECT_EQ(told(), (Texts{"supports.1: node N1 (0, 0) has two different displacements prescribed in x"}));
}

TEST_F(Supported, AnglesThatAreNoNumbersAreRefused) {
  Support turned{"wall", {none, none, none}};
  turned.rotate = turn("0.04");
  turned.rotate->angle = study::Field{study::Formula{"1/t"}};
  reduction_of({turned});
  EXPECT_EQ(told(),
            (Texts{"supports.0.rotate.angle: supports.0.rotate.angle: '1/t' is infinite at x = 0, y = "
                   "0, z = 0, t = 0, expected a finite number"}));
}

TEST_F(Supported, ExpressionsWithoutANumberAreRefusedAtTheirNode) {
  const auto divided = [](const char* text) { return study::Field{study::Formula{text}}; };
  EXPECT_EQ(reduction_of({{"wall", {none, divided("1/y"), none}}}).prescribed().size(), 0U);
  EXPECT_EQ(told(), (Texts{"supports.0.y: supports.0.y: '1/y' is infinite at x = 0, y = 0, z = 0, t = 0, "
                           "expected a finite number"}));
  faults_.clear();
  reduction_of({{"wall", {divided("x*t"), none, none}}, {"N1", {divided("x*t"), none, none}}});
  EXPECT_TRUE(faults_.empty()) << "the same twice";
  reduction_of({{"wall", {divided("x*t"), none, none}}, {"N1", {divided("y*t"), none, none}}});
  EXPECT_EQ(told(), (Texts{"supports.1: node N1 (0, 0) has two different displacements prescribed in x"}));
}

TEST_F(Supported, SpringsStandAtEachNodeAlongEachStiffAxis) {
  auto numbered = part();
  numbered.study.springs = {{"wall", {3, 0, 0}}, {"N2", {1, 2, 7}}, {"loose", {1, 1, 0}}};
  const auto springs = make_springs(numbered.study, numbered.mesh, numbered.dofs, faults_);
  ASSERT_EQ(springs.size(), 4U);
  const std::vector<std::pair<int, double>> wanted{{0, 3}, {6, 3}, {2, 1}, {3, 2}};
  for (std::size_t i = 0; i < springs.size(); ++i) {
    EXPECT_EQ(springs[i].dof, wanted[i].first);
    EXPECT_EQ(springs[i].stiffness, wanted[i].second);
  }
  EXPECT_EQ(told(), (Texts{"springs.2.on: found 'loose', none of whose nodes belongs to a cell that deforms, "
                           "expected a part of a body to pull at"}));
}

} // namespace
} // namespace rubato::model::supports_test
