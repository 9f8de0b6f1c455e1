// SPDX-License-Identifier: LGPL-3.0-or-later
// Fields at the nodes, and what contact amounts to.
#include "rubato/contact/zone.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/results/nodal_fields.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::results::nodal_fields_test {
namespace {

using contact::Status;
using Eigen::Vector3d;

TEST(ResultantsOfContact, SumWhatPressesAndRubs) {
  contact::ZoneState state;
  state.status = {Status::stick, Status::slip, Status::open, Status::slip};
  state.outcomes = {{.gap = 0, .pressure = 2, .normal = {0, 3, 0}, .tangential = {1, 0, 0}},
                    {.gap = -0.1, .pressure = 7, .normal = {0, 5, 0}, .tangential = {-4, 0, 0}},
                    {.gap = 0.5, .pressure = 99, .normal = {0, 9, 0}, .tangential = {9, 0, 0}},
                    {.gap = std::numeric_limits<double>::infinity(),
                     .pressure = 1,
                     .normal = {6, 0, 8},
                     .tangential = {0, 1, 0}}};
  const auto sum = contact_resultants(state);
  EXPECT_EQ(sum.in_contact, 3);
  EXPECT_EQ(sum.sticking, 1);
  EXPECT_EQ(sum.force, Vector3d(3, 9, 8));
  EXPECT_DOUBLE_EQ(sum.normal, 3 + 5 + 10);
  EXPECT_DOUBLE_EQ(sum.friction, Vector3d(-3, 1, 0).norm()) << "of the sum, not the sum of lengths";
  EXPECT_EQ(sum.largest_pressure, 7);
  EXPECT_EQ(sum.smallest_gap, -0.1);
}

TEST(ResultantsOfContact, AreNoneOfAZoneThatIsOpen) {
  contact::ZoneState state;
  state.status = {Status::open};
  state.outcomes = {{.gap = 0.25}};
  const auto sum = contact_resultants(state);
  EXPECT_EQ(sum.in_contact, 0);
  EXPECT_EQ(sum.force, Vector3d::Zero());
  EXPECT_EQ(sum.smallest_gap, 0.25);
}

/// SDNL140's beams in contact.
class FieldsOfBeams : public testing::Test {
protected:
  FieldsOfBeams() {
    for (int step = 0; step < 4; ++step)
      EXPECT_TRUE(walk_.advance());
    fields_ = nodal_fields(walk_.model, walk_.state());
  }
  const OwnedField& field(const std::string& name) const {
    return *std::ranges::find(fields_, name, &OwnedField::name);
  }

  test::Walk walk_{test::two_beams};
  std::vector<OwnedField> fields_;
};

TEST_F(FieldsOfBeams, HaveAValueForEachComponentOfEachNode) {
  std::vector<std::string> names;
  for (const auto& each : fields_) {
    names.push_back(each.name);
    EXPECT_EQ(each.values.size(), static_cast<std::size_t>(each.components) * walk_.model.mesh.points.size());
    if (each.components > 1) {
      EXPECT_EQ(each.component_names.size(), static_cast<std::size_t>(each.components)) << each.name;
    }
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"displacement", "velocity", "acceleration", "stress", "von_mises",
                                      "contact_pressure", "contact_gap", "contact_slip", "contact_status",
                                      "contact_cumulated_slip", "contact_friction_work"}));
}

TEST_F(FieldsOfBeams, HaveTheMotionOfTheState) {
  const auto& state = walk_.state();
  for (const auto node : walk_.model.dofs.nodes)
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(2 * node + i);
      const auto dof = walk_.model.dofs.dof(node, i);
      EXPECT_EQ(field("displacement").values[at], state.motion.u[dof]);
      EXPECT_EQ(field("velocity").values[at], state.motion.v[dof]);
      EXPECT_EQ(field("acceleration").values[at], state.motion.a[dof]);
    }
}

TEST_F(FieldsOfBeams, HaveWhatContactPointsDoAtTheirNodes) {
  const auto& zone = walk_.model.zones[0];
  const auto& state = walk_.state().zones[0];
  int touching = 0;
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const auto position = static_cast<std::size_t>(zone.points[i].node_position);
    const auto node = static_cast<std::size_t>(zone.slave.nodes[position]);
    const auto& outcome = state.outcomes[i];
    const bool open = state.status[i] == Status::open;
    EXPECT_EQ(field("contact_status").values[node], static_cast<double>(state.status[i]));
    EXPECT_EQ(field("contact_gap").values[node], std::isfinite(outcome.gap) ? outcome.gap : 0);
    EXPECT_EQ(field("contact_slip").values[node], open ? 0 : outcome.slip[0]);
    EXPECT_EQ(field("contact_pressure").values[node], open ? 0 : walk_.pressure(position));
    touching += open ? 0 : 1;
  }
  EXPECT_GT(touching, 0);
  EXPECT_LT(touching, static_cast<int>(zone.points.size()));
}

TEST_F(FieldsOfBeams, HaveNoContactOffTheSlaveSide) {
  const auto& slaves = walk_.model.zones[0].slave.nodes;
  for (std::size_t node = 0; node < walk_.model.mesh.points.size(); ++node)
    if (std::ranges::find(slaves, static_cast<mesh::NodeIndex>(node)) == slaves.end()) {
      for (const char* name : {"contact_pressure", "contact_gap", "contact_slip", "contact_status"})
        EXPECT_EQ(field(name).values[node], 0) << name;
    }
}

TEST(FieldsWithoutContact, AreFive) {
  test::Walk walk(test::two_beams, {{"contact", "~"}});
  EXPECT_EQ(nodal_fields(walk.model, walk.state()).size(), 5U);
}

} // namespace
} // namespace rubato::results::nodal_fields_test
