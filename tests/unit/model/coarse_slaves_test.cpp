// SPDX-License-Identifier: LGPL-3.0-or-later
// The model warns of slaves by nodes whose nodes are farther apart than the master's.
#include "rubato/model/coarse_slaves.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <string>
#include <vector>

namespace rubato::model::coarse_slaves_test {
namespace {

struct Pair {
  int slave, master; ///< cells along the joint
  const char* slave_cells;
  const char* master_cells;
  const char* integration;
  const char* under; ///< how the lower face of the master is held
  bool told;
};

std::string deck_of(const Pair& pair) {
  return fmt::format(R"(mesh:
  generate:
    - {{name: rail, rectangle: {{from: [0, 0], to: [1, 0.2]}}, divisions: [{}, 1], cells: {}, sides: {{bottom: ground, top: above}}}}
    - {{name: block, rectangle: {{from: [0, 0.2], to: [1, 0.4]}}, divisions: [{}, 1], cells: {}, sides: {{top: roof, bottom: below}}}}
physics: plane_strain
materials: {{steel: {{young: 2e11, poisson: 0.3, density: 7800}}}}
supports: [{{on: ground, fix: [x, y]}}, {{on: roof, x: 0, y: -0.001}}{}]
contact: {{joint: {{slave: below, master: above, integration: {}}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                     pair.master, pair.master_cells, pair.slave, pair.slave_cells, pair.under,
                     pair.integration);
}

TEST(CoarseSlaves, AreToldWhereNothingKeepsNodesOfTheMasterOut) {
  const Pair pairs[] = {
      {4, 4, "quad4", "quad4", "nodes", "", false},
      {4, 8, "quad4", "quad4", "nodes", "", true},
      {4, 5, "quad4", "quad4", "nodes", "", true},
      {8, 4, "quad4", "quad4", "nodes", "", false},
      {4, 8, "quad4", "quad4", "mortar", "", false},
      {4, 8, "quad4", "quad4", "{gauss: 3}", "", false},
      {4, 4, "quad4", "quad8", "nodes", "", true},
      {4, 8, "quad8", "quad4", "nodes", "", false},
      {4, 8, "tria3", "tria3", "nodes", "", true},
      {4, 8, "quad4", "quad4", "nodes", ", {on: above, fix: [x, y]}", false},
  };
  for (const auto& pair : pairs) {
    const auto deck = deck_of(pair);
    SCOPED_TRACE(deck);
    const auto notes = notes_on_coarse_slaves(test::model_of(deck.c_str(), {}));
    ASSERT_EQ(notes.size(), pair.told ? 1U : 0U);
    if (!pair.told)
      continue;
    EXPECT_NE(notes.front().find("expected 'slave: above, master: below', or 'integration: mortar'"),
              std::string::npos)
        << notes.front();
  }
}

} // namespace
} // namespace rubato::model::coarse_slaves_test
