// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/snapshot.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"

namespace rubato::plot::snapshot_test {
namespace {

/// Two nodes.
Snapshot two_nodes() {
  Snapshot snapshot{.t = 1};
  snapshot.mesh.points.resize(2);
  snapshot.arrays = {{"displacement", {"x", "y"}, {3, 4, -6, 8}},
                     {"stress", {"xx", "yy", "zz", "xy"}, {1, 2, 3, 4, 5, 6, 7, 8}},
                     {"von_mises", {"1"}, {10, 20}}};
  return snapshot;
}

TEST(NodeValuesOfASnapshot, AreScalarsComponentsAndLengths) {
  const auto snapshot = two_nodes();
  EXPECT_EQ(node_values(snapshot, "von_mises").values, (std::vector<double>{10, 20}));
  EXPECT_EQ(node_values(snapshot, "displacement.y").values, (std::vector<double>{4, 8}));
  EXPECT_EQ(node_values(snapshot, "displacement").values, (std::vector<double>{5, 10}));
  EXPECT_EQ(node_values(snapshot, "stress.zz").values, (std::vector<double>{3, 7}));
  EXPECT_EQ(node_values(snapshot, "stress.zz").dimension, "force/length²");
}

TEST(NodeValuesOfASnapshot, AreRefusedWithTheNearestName) {
  const auto snapshot = two_nodes();
  const auto fault = [&](const std::string& name) {
    return test::fault_of([&] { node_values(snapshot, name); });
  };
  EXPECT_EQ(fault("stress"), "--field: no field is called 'stress'; did you mean 'stress.xx'?")
      << "has no length";
  EXPECT_EQ(fault("displacement.z"),
            "--field: no field is called 'displacement.z'; did you mean 'displacement.x'?");
  EXPECT_EQ(fault("q"),
            "--field: no field is called 'q'; expected one of displacement, displacement.x, displacement.y, "
            "stress.xx, stress.yy, stress.zz, stress.xy, von_mises");
}

TEST(DisplacementsOfASnapshot, HaveThreeComponents) {
  EXPECT_EQ(displacements(two_nodes())[1], Eigen::Vector3d(-6, 8, 0));
  EXPECT_EQ(test::fault_of([] { displacements(Snapshot{}); }), "the stored fields have no displacement");
}

TEST(Snapshots, OfRunsWithoutFieldsAreRefused) {
  const test::ScratchFolder folder;
  EXPECT_EQ(test::fault_of([&] { read_snapshot(folder.path(), {}, 2); }),
            folder.path().string() +
                ": holds no fields to draw, expected a run with 'fields: {formats: [vtu]}' in its deck");
}

} // namespace
} // namespace rubato::plot::snapshot_test
