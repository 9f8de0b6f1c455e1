// SPDX-License-Identifier: LGPL-3.0-or-later
/// Masters that are faces without cells behind them: rigid surfaces drawn as a mesh.
#include "rubato/deck/read.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/model/build_model.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <array>
#include <string>
#include <vector>

namespace rubato::step::rigid_surface_test {
namespace {

using mesh::NodeIndex;
using test::Walk;

/// How the faces of a table are numbered.
enum class Sense { up, down, mixed };

bool is_turned(Sense sense, int face) {
  return sense == Sense::down || (sense == Sense::mixed && face % 2 == 1);
}

/// The mesh of a deck, and under it, from −0.5 to 1.5 at y = −0.01, a table of loose segments or quadrangles.
mesh::Mesh with_table(const study::Study& study, Sense sense) {
  constexpr int parts = 9;
  const auto bodies = model::load_mesh(study.mesh);
  mesh::MeshBuilder builder(bodies.dimension);
  builder.append(bodies);
  std::vector<NodeIndex> nodes;
  const int rows = bodies.dimension == 3 ? 2 : 1;
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; j < rows; ++j)
      nodes.push_back(builder.add_node({-0.5 + 2.0 * i / parts, -0.01, rows == 1 ? 0 : -0.5 + 2.0 * j}));
  std::vector<mesh::MeshBuilder::CellHandle> faces;
  for (int i = 0; i < parts; ++i) {
    const auto at = static_cast<std::size_t>(i * rows);
    if (rows == 1) {
      std::array ends{nodes[at], nodes[at + 1]};
      if (is_turned(sense, i))
        std::swap(ends[0], ends[1]);
      faces.push_back(builder.add_cell(CellType::seg2, ends));
    } else {
      std::array corners{nodes[at], nodes[at + 1], nodes[at + 3], nodes[at + 2]};
      if (is_turned(sense, i))
        std::swap(corners[1], corners[3]);
      faces.push_back(builder.add_cell(CellType::quad4, corners));
    }
  }
  builder.add_to_cell_group("table", faces);
  return std::move(builder).build();
}

const std::string plane_deck = R"(
mesh: {generate: [{name: block, rectangle: {from: [0, 0], to: [1, 0.5]}, divisions: [6, 3], sides: {bottom: under, top: roof}}]}
physics: plane_strain
materials: {rubber: {young: 1e7, poisson: 0.3, density: 1000}}
functions: {push: {times: [0, 1], values: [0, 1]}}
supports: [{on: roof, fix: [x, y]}]
contact: {rest: {slave: under, integration: nodes, friction: 0.3}}
time: {scheme: static, step: 0.5, end: 1}
)";

const std::string solid_deck = R"(
mesh: {generate: [{name: block, box: {from: [0, 0, 0], to: [1, 0.5, 1]}, divisions: [3, 2, 3], sides: {bottom: under, top: roof}}]}
physics: solid
materials: {rubber: {young: 1e7, poisson: 0.3, density: 1000}}
functions: {push: {times: [0, 1], values: [0, 1]}}
supports: [{on: roof, fix: [x, y, z]}]
contact: {rest: {slave: under, integration: nodes, friction: 0.3}}
time: {scheme: static, step: 0.5, end: 1}
)";

study::Study study_of(const std::string& deck, const std::vector<deck::Setting>& changes) {
  return deck::parse_deck(deck, "deck.yaml", changes).runs.front();
}

study::Study on_table(const std::string& deck, const std::string& time) {
  const std::string moved = "x: {value: 0.02, function: push}, y: {value: 0.03, function: push}";
  const std::string supports = deck == solid_deck
                                   ? "[{on: roof, fix: [x, y, z]}, {on: table, fix: z, " + moved + "}]"
                                   : "[{on: roof, fix: [x, y]}, {on: table, " + moved + "}]";
  return study_of(deck, {{"contact.rest.master", "table"}, {"supports", supports}, {"time", time}});
}

study::Study before_plane(const std::string& deck, const std::string& time) {
  const std::string plane = deck == solid_deck ? "{plane: {point: [0, -0.01, 0], normal: [0, 1, 0]}, "
                                               : "{plane: {point: [0, -0.01], normal: [0, 1]}, ";
  const std::string move = "move: {x: {value: 0.02, function: push}, y: {value: 0.03, function: push}}}";
  return study_of(deck, {{"contact.rest.obstacle", plane + move}, {"time", time}});
}

/// The block's nodes are the first of both meshes.
void expect_same_motion(const Walk& table, const Walk& plane) {
  const auto& here = table.state().motion.u;
  const auto& there = plane.state().motion.u;
  ASSERT_GE(here.size(), there.size());
  EXPECT_LE((here.head(there.size()) - there).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_GT(there.lpNorm<Eigen::Infinity>(), 0.01);
  EXPECT_LE((table.resultants().force - plane.resultants().force).norm(),
            1e-6 * plane.resultants().force.norm());
}

TEST(RigidSurface, IsThePlaneThatItDraws) {
  for (const auto& deck : {plane_deck, solid_deck})
    for (const std::string time :
         {"{scheme: static, step: 0.5, end: 1}", "{scheme: hht, alpha: -0.3, step: 0.1, end: 1}"}) {
      const auto study = before_plane(deck, time);
      Walk plane{study};
      ASSERT_TRUE(plane.to_end());
      for (const auto sense : {Sense::up, Sense::down, Sense::mixed}) {
        const auto drawn = on_table(deck, time);
        Walk table{drawn, with_table(drawn, sense)};
        ASSERT_TRUE(table.to_end());
        expect_same_motion(table, plane);
      }
    }
}

TEST(RigidSurface, IsMetByEveryDefaultScheme) {
  const auto drawn = on_table(plane_deck, "{step: 1e-2, end: 0.5}");
  Walk table{drawn, with_table(drawn, Sense::up)};
  ASSERT_TRUE(table.to_end());
  EXPECT_GT(table.resultants().force.y(), 0);
}

/// A turntable drags what stands on it, by more than a body of small strain may rotate.
TEST(RigidSurface, RotatesByAnyAngle) {
  const auto walked = [](const std::string& motion) {
    const auto study =
        study_of(solid_deck,
                 {{"contact.rest.master", "table"},
                  {"time", "{scheme: static, step: 0.25, end: 1}"},
                  {"supports", "[{on: roof, fix: [x, y, z]}, {on: table, y: {value: 0.03, function: push}, " +
                                   motion + "}]"}});
    Walk walk{study, with_table(study, Sense::up)};
    EXPECT_TRUE(walk.to_end());
    return walk.state().motion.u;
  };
  const auto rotated = walked("rotate: {about: [0.5, 7, 0.5], axis: [0, 1, 0], angle: 0.3*t}");
  const auto displaced = walked("x: '(cos(0.3*t)-1)*(x-0.5)+sin(0.3*t)*(z-0.5)', "
                                "z: '-sin(0.3*t)*(x-0.5)+(cos(0.3*t)-1)*(z-0.5)'");
  EXPECT_LE((rotated - displaced).lpNorm<Eigen::Infinity>(), 1e-12);
}

std::string refused(const std::vector<deck::Setting>& changes, Sense sense = Sense::up) {
  const auto study = study_of(plane_deck, changes);
  return test::fault_of([&] { test::BuiltModel(study, with_table(study, sense)); });
}

TEST(RigidSurface, HasEveryComponentHeld) {
  const auto fault = refused(
      {{"contact.rest.master", "table"}, {"supports", "[{on: roof, fix: [x, y]}, {on: table, fix: y}]"}});
  EXPECT_NE(fault.find("contact surface 'table': 9 of its faces bound no cell, and nothing holds node"),
            std::string::npos)
      << fault;
  EXPECT_NE(fault.find("along x"), std::string::npos) << fault;
}

TEST(RigidSurface, IsNoSlave) {
  const auto fault = refused({{"contact.rest", "{master: under, slave: table, integration: nodes}"}});
  EXPECT_NE(fault.find("contact surface 'table': 9 cells"), std::string::npos) << fault;
  EXPECT_NE(fault.find("bound no surface cell"), std::string::npos) << fault;
}

} // namespace
} // namespace rubato::step::rigid_surface_test
