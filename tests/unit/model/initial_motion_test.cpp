// SPDX-License-Identifier: LGPL-3.0-or-later
// How the nodes of a mesh are and move at the first instant.
#include <gtest/gtest.h>

#include "unit/model/meshes.hpp"

namespace rubato::model::initial_motion_test {
namespace {

using Eigen::VectorXd;
using Texts = std::vector<std::string>;
using Components = std::array<std::optional<double>, 3>;

constexpr std::nullopt_t none = std::nullopt;

/// Two squares in a row, from t = 0 to 2.
class Begun : public testing::Test {
protected:
  InitialMotion motion_of(std::vector<study::InitialMotion> initial,
                          std::vector<constraint::PrescribedDof> supports = {}) {
    auto study = test::plane_study({test::elastic("any")});
    study.time.end = 2;
    study.initial = std::move(initial);
    const test::Numbered part{study, test::row_of_squares(2).build()};
    const constraint::Reduction reduction(part.dofs.dof_count, std::move(supports));
    return make_initial_motion(part.study, part.mesh, part.dofs, reduction, faults_);
  }
  Texts told() const { return test::told(faults_); }

  std::vector<Fault> faults_;
};

TEST_F(Begun, NodesHaveWhatIsGivenAndElseRest) {
  const auto motion = motion_of({{"wall", Components{0.1, none, none}, Components{none, -3, none}},
                                 {"N2", Components{none, 0.2, none}, {}}});
  VectorXd displacement = VectorXd::Zero(12);
  displacement[0] = displacement[6] = 0.1; // x of the wall, nodes 0 and 3
  displacement[3] = 0.2;                   // y of node 1
  VectorXd velocity = VectorXd::Zero(12);
  velocity[1] = velocity[7] = -3;
  EXPECT_EQ(motion.displacement, displacement);
  EXPECT_EQ(motion.velocity, velocity);
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Begun, AllMeansEveryNode) {
  const auto motion = motion_of({{"all", {}, Components{none, 5, none}}});
  EXPECT_EQ(motion.velocity.sum(), 6 * 5);
  EXPECT_EQ(motion.displacement, VectorXd::Zero(12));
}

TEST_F(Begun, EntriesThatSayTheSameOfANodeAreFine) {
  motion_of({{"all", {}, Components{none, 5, none}}, {"wall", {}, Components{1, 5, none}}});
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Begun, EntriesThatDisagreeAreToldOnceEach) {
  motion_of({{"all", Components{1, none, none}, {}},
             {"wall", Components{2, none, none}, {}},
             {"N3", Components{3, none, none}, {}}});
  EXPECT_EQ(
      told(),
      (Texts{"initial.1: node N1 (0, 0) begins with the displacement 2 in x, but another entry has 1",
             "initial.2: node N3 (2, 0) begins with the displacement 3 in x, but another entry has 1"}));
}

/// x of node 0 is held at 0.5 and moves at 0.5 × 4: numbers that differ by rounding are the same.
TEST_F(Begun, SupportsHaveTheirOwnMotion) {
  const constraint::PrescribedDof moving{0, 0.5, Function{{0, 2}, {1, 9}}};
  motion_of({{"N1", Components{0.5 * (1 + 1e-10), none, none}, Components{2 * (1 + 1e-7), none, none}}},
            {moving});
  EXPECT_TRUE(faults_.empty());
  motion_of({{"N1", Components{0.5 * (1 + 1e-8), none, none}, {}}}, {moving});
  motion_of({{"N1", {}, Components{2 * (1 + 1e-5), none, none}}}, {moving});
  ASSERT_EQ(faults_.size(), 2U);
  EXPECT_EQ(faults_[0].text,
            "node N1 (0, 0) begins with the displacement 0.5 in x, but its support puts it at 0.5");
  EXPECT_EQ(faults_[1].text,
            "node N1 (0, 0) begins with the velocity 2.00002 in x, but its support moves at 2");
  faults_.clear();
  motion_of({{"N1", Components{none, 7, none}, Components{none, 7, none}}}, {moving}); // y is free
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Begun, PlacesMustBeOfTheMesh) {
  motion_of({{"wal", {}, Components{1, none, none}}});
  ASSERT_EQ(faults_.size(), 1U);
  EXPECT_EQ(faults_[0].path, "initial.0.on");
}

} // namespace
} // namespace rubato::model::initial_motion_test
