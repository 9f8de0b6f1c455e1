// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that move far beside their strain: the ledger takes works of internal forces on deformations alone.
#include "rubato/deck/read.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/step/common/rigid_parts.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/start.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace rubato::step::rigid_parts_test {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

const std::string plane = R"(
mesh: {generate: [{name: block, rectangle: {from: [3, 5], to: [4, 6]}, divisions: [3, 2], sides: {left: wall}}]}
physics: plane_strain
materials: {rubber: {young: 3, poisson: 0.3, density: 2}}
time: {scheme: newmark, step: 0.5, end: 2}
)";

const std::string solid = R"(
mesh: {generate: [{name: block, box: {from: [3, 5, 7], to: [4, 6, 8]}, divisions: [2, 2, 1], sides: {left: wall}}]}
physics: solid
materials: {rubber: {young: 3, poisson: 0.3, density: 2}}
time: {scheme: newmark, step: 0.5, end: 2}
)";

/// A deck, and the shifts and turns about the axes that its stiffness does not resist.
struct Deck {
  const char* name;
  const std::string* text;
  std::vector<deck::Setting> changes;
  Vector3d shifts;
  Vector3d turns;
};

deck::Setting cells(const char* kind) {
  return {"mesh.generate.0.cells", kind};
}

const std::vector<Deck> decks{
    {"Plane", &plane, {}, {1, 1, 0}, {0, 0, 1}},
    {"Tria3", &plane, {cells("tria3")}, {1, 1, 0}, {0, 0, 1}},
    {"Tria6", &plane, {cells("tria6")}, {1, 1, 0}, {0, 0, 1}},
    {"Quad8", &plane, {cells("quad8")}, {1, 1, 0}, {0, 0, 1}},
    {"PlaneStress", &plane, {{"physics", "plane_stress"}}, {1, 1, 0}, {0, 0, 1}},
    {"Axisymmetric", &plane, {{"physics", "axisymmetric"}}, {0, 1, 0}, {0, 0, 0}},
    {"PlaneOnSprings", &plane, {{"springs", "[{on: wall, x: 0.3}]"}}, {0, 1, 0}, {0, 0, 0}},
    {"PlaneOnSpringsBothWays", &plane, {{"springs", "[{on: wall, x: 0.3, y: 1}]"}}, {0, 0, 0}, {0, 0, 0}},
    {"Solid", &solid, {}, {1, 1, 1}, {1, 1, 1}},
    {"Hexa20", &solid, {cells("hexa20")}, {1, 1, 1}, {1, 1, 1}},
    {"Tetra4", &solid, {cells("tetra4")}, {1, 1, 1}, {1, 1, 1}},
    {"SolidOnSprings", &solid, {{"springs", "[{on: wall, x: 0.3}]"}}, {0, 1, 1}, {1, 0, 0}},
};

class FarOff : public testing::TestWithParam<Deck> {
protected:
  test::BuiltModel model_ =
      test::BuiltModel(deck::parse_deck(*GetParam().text, "deck.yaml", GetParam().changes).runs.front());
  std::mt19937 random_{5};

  VectorXd anything(Index size) {
    std::normal_distribution<double> normal;
    return VectorXd::NullaryExpr(size, [&] { return normal(random_); });
  }
  VectorXd anything() { return anything(model_.dofs.dof_count); }

  VectorXd rigid_motion() {
    const Vector3d shift = GetParam().shifts.cwiseProduct(Vector3d(anything(3)));
    const Vector3d turn = GetParam().turns.cwiseProduct(Vector3d(anything(3)));
    const int components = model_.dofs.components;
    VectorXd u = VectorXd::Zero(model_.dofs.dof_count);
    for (const auto node : model_.dofs.nodes) {
      const Vector3d moved = shift + turn.cross(model_.mesh.points[static_cast<std::size_t>(node)]);
      u.segment(model_.dofs.dof(node, 0), components) = moved.head(components);
    }
    return u;
  }

  /// A state with any deformation, far off its place.
  State far_off(const time::Scheme& scheme, double far) {
    State state = initial_state(model_, scheme, 0, true);
    state.motion.u = anything() + far * rigid_motion();
    state.bulk = bulk_forces(model_, state);
    state.contact_force = anything();
    state.friction_force = anything();
    state.external_force = anything();
    state.residual_force = state.bulk.internal + state.contact_force - state.external_force;
    return state;
  }
};

TEST_P(FarOff, RigidMotionsAreTakenWhole) {
  const RigidParts parts(model_);
  const VectorXd moved = rigid_motion();
  const VectorXd force = anything();
  EXPECT_NEAR(parts.work(parts.resultants(moved), parts.resultants(force)), moved.dot(force),
              1e-12 * (1 + moved.norm()) * force.norm());
}

TEST_P(FarOff, WhatIsLeftHasNoRigidPart) {
  const RigidParts parts(model_);
  const VectorXd moved = anything();
  const VectorXd rigid = rigid_motion();
  EXPECT_NEAR(parts.work(parts.resultants(moved), parts.resultants(rigid)), moved.dot(rigid),
              1e-12 * (1 + moved.norm()) * rigid.norm());
}

TEST_P(FarOff, StrainIsThatOfTheDeformation) {
  const auto scheme = time::make_scheme(model_.study.time);
  auto state = initial_state(model_, scheme, 0, true);
  const VectorXd deformation = anything();
  const double strain = 0.5 * deformation.dot(model_.domain.initial_tangent() * deformation);
  state.motion.u = deformation + 1e4 * rigid_motion();
  state.bulk = bulk_forces(model_, state);
  const EnergyAccount account(model_, scheme, state);
  EXPECT_NEAR(account.ledger().strain, strain, 1e-10 * strain);
}

/// With whatever forces: the static scheme's identity has no inertia that covers what the strain loses.
TEST_P(FarOff, LedgerCloses) {
  auto settings = model_.study.time;
  settings.scheme = study::SchemeKind::static_steps;
  const auto scheme = time::make_scheme(settings);
  constexpr double far = 1e6;
  auto before = far_off(time::make_scheme(model_.study.time), far);
  EnergyAccount account(model_, scheme, before);
  for (int step = 0; step < 4; ++step) {
    auto now = far_off(time::make_scheme(model_.study.time), far);
    now.t = before.t + 1;
    account.enter(before, now);
    before = now;
    EXPECT_LE(std::abs(account.ledger().balance()), 1e-12 * account.ledger().largest());
  }
}

INSTANTIATE_TEST_SUITE_P(Of, FarOff, testing::ValuesIn(decks),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

/// Its displacements are deformations, so that nothing need be taken out of them.
TEST(RigidParts, LeaveOutBodiesThatSupportsAtRestHold) {
  for (const auto& [supports, held] : {std::pair{"[{on: wall, fix: [x, y]}]", true},
                                       {"[{on: wall, fix: [x]}]", false},
                                       {"[{on: wall, x: 0, y: 0.1}]", false}}) {
    const std::vector<deck::Setting> changes{{"supports", supports}};
    const auto study = deck::parse_deck(plane, "deck.yaml", changes).runs.front();
    const test::BuiltModel model(study);
    const RigidParts rigid(model);
    VectorXd shift = VectorXd::Zero(model.dofs.dof_count);
    for (const auto node : model.dofs.nodes)
      shift[model.dofs.dof(node, 1)] = 1;
    const auto resultants = rigid.resultants(shift);
    EXPECT_EQ(rigid.work(resultants, resultants) == 0, held) << supports;
  }
}

} // namespace
} // namespace rubato::step::rigid_parts_test
