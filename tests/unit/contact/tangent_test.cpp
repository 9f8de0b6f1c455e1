// SPDX-License-Identifier: LGPL-3.0-or-later
/// Each derivative of the contact kinematics and of the whole contact system against central differences.
#include "rubato/contact/frozen_frame.hpp"

#include <gtest/gtest.h>

#include "contact_system.hpp"
#include <tuple>

namespace rubato::tangent_test {
namespace {

using contact::Status;
using Eigen::VectorXd;
using test::moved;
using test::system_at;

constexpr double h = 1e-6;

struct Variant {
  std::string name;
  test::TwoFacesOptions options;
};

std::vector<Variant> variants() {
  std::vector<Variant> list;
  const std::vector<std::pair<CellType, CellType>> pairs{
      {CellType::seg2, CellType::seg2},   {CellType::seg3, CellType::seg3},
      {CellType::seg2, CellType::seg3},   {CellType::tria3, CellType::tria3},
      {CellType::tria6, CellType::tria6}, {CellType::tria7, CellType::quad9},
      {CellType::quad4, CellType::quad4}, {CellType::quad8, CellType::quad8},
      {CellType::quad9, CellType::tria6}, {CellType::quad9, CellType::quad9}};
  for (const auto& [slave, master] : pairs)
    for (const double shift : {0.0, 0.9})
      for (const auto normal :
           {study::ContactNormal::master, study::ContactNormal::slave, study::ContactNormal::average})
        for (const auto clamped : {study::ClampedNormal::projection, study::ClampedNormal::code_aster}) {
          test::TwoFacesOptions options;
          options.slave = slave;
          options.master = master;
          options.shift = shift;
          options.normal = normal;
          options.clamped_normal = clamped;
          options.seed = static_cast<unsigned>(list.size()) + 3;
          list.push_back({std::string(cell::topology(slave).name) + "On" +
                              std::string(cell::topology(master).name) + (shift > 0 ? "Shifted" : "") +
                              (normal == study::ContactNormal::master  ? "MasterNormal"
                               : normal == study::ContactNormal::slave ? "SlaveNormal"
                                                                       : "AverageNormal") +
                              (clamped == study::ClampedNormal::projection ? "" : "Accumulated"),
                          options});
        }
  return list;
}

class ContactTangent : public testing::TestWithParam<Variant> {
protected:
  test::TwoFaces setup = test::two_faces(GetParam().options);
};

/// Whether the point stays in the same piece of the clamp when its unknowns are varied a little.
bool far_from_a_kink(const contact::Pair& pair, CellType type) {
  auto nudged = pair.projection;
  for (int i = 0; i < 8; ++i) {
    nudged.xi = pair.projection.xi + 1e-4 * Eigen::Vector2d(std::cos(i), std::sin(i));
    contact::clamp_to_face(type, nudged);
    if ((nudged.clamp_derivative - pair.projection.clamp_derivative).norm() > 1e-9)
      return false;
  }
  return true;
}

TEST_P(ContactTangent, MeasuresWithoutDerivativesAreTheSame) {
  const auto configuration = setup.configuration(setup.u);
  const auto pairs = contact::find_pairs(setup.zone, configuration);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (!pairs[p].paired())
      continue;
    const auto whole =
        contact::evaluate_kinematics(setup.zone, setup.zone.points[p], pairs[p], configuration);
    contact::Kinematics measured;
    contact::measure_kinematics(setup.zone, setup.zone.points[p], pairs[p], configuration, measured);
    EXPECT_EQ(measured.stencil.nodes, whole.stencil.nodes);
    EXPECT_EQ(measured.stencil.weights, whole.stencil.weights);
    EXPECT_EQ(measured.gap, whole.gap);
    EXPECT_EQ(measured.slip, whole.slip);
    EXPECT_EQ(measured.normal, whole.normal);
    EXPECT_EQ(measured.tangents, whole.tangents);
  }
}

TEST_P(ContactTangent, KinematicsVaryAsTheySay) {
  const auto configuration = setup.configuration(setup.u);
  const auto pairs = contact::find_pairs(setup.zone, configuration);
  int compared = 0;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (!pairs[p].paired() || !far_from_a_kink(pairs[p], GetParam().options.master))
      continue;
    const auto& point = setup.zone.points[p];
    const auto at = contact::evaluate_kinematics(setup.zone, point, pairs[p], configuration);
    for (std::size_t node = 0; node < at.stencil.nodes.size(); ++node)
      for (int i = 0; i < at.stencil.components; ++i) {
        const auto dof = setup.dofs.dof(at.stencil.nodes[node], i);
        const VectorXd forward = moved(setup.u, dof, h);
        const VectorXd backward = moved(setup.u, dof, -h);
        const auto plus_configuration = setup.configuration(forward);
        const auto minus_configuration = setup.configuration(backward);
        const auto plus = contact::evaluate_kinematics(
            setup.zone, point, contact::find_pairs(setup.zone, plus_configuration)[p], plus_configuration);
        const auto minus = contact::evaluate_kinematics(
            setup.zone, point, contact::find_pairs(setup.zone, minus_configuration)[p], minus_configuration);
        const auto column = static_cast<Eigen::Index>(node) * at.stencil.components + i;
        EXPECT_NEAR((plus.gap - minus.gap) / (2 * h), at.d_gap[column], 2e-7);
        EXPECT_LT(((plus.normal - minus.normal) / (2 * h) - at.d_normal.col(column)).norm(), 2e-7);
        EXPECT_LT(((plus.slip - minus.slip) / (2 * h) - at.d_slip.col(column)).norm(), 2e-7);
        for (int a = 0; a < 2; ++a)
          EXPECT_LT(((plus.tangents.col(a) - minus.tangents.col(a)) / (2 * h) -
                     at.d_tangent[static_cast<std::size_t>(a)].col(column))
                        .norm(),
                    2e-7);
        ++compared;
      }
  }
  EXPECT_GT(compared, 0);
}

TEST_P(ContactTangent, IsTheDerivativeOfForcesAndEquations) {
  const auto pairs = contact::find_pairs(setup.zone, setup.configuration(setup.u));
  for (const auto& pair : pairs)
    if (pair.paired() && !far_from_a_kink(pair, GetParam().options.master))
      GTEST_SKIP() << "a point of this variant stands on a kink of the closest-point map";
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(0.5, 1.5);
  const VectorXd multipliers =
      VectorXd::NullaryExpr(setup.zone.multiplier_count(), [&] { return number(random); });
  const auto dofs = setup.dofs.dof_count;
  for (const auto status : {Status::open, Status::stick, Status::slip}) {
    const auto at = system_at(setup, setup.u, multipliers, status);
    for (Eigen::Index i = 0; i < at.residual.size(); ++i) {
      const bool is_dof = i < dofs;
      const auto shifted = [&](double by) {
        return is_dof ? system_at(setup, moved(setup.u, i, by), multipliers, status)
                      : system_at(setup, setup.u, moved(multipliers, i - dofs, by), status);
      };
      const VectorXd difference = (shifted(h).residual - shifted(-h).residual) / (2 * h);
      EXPECT_LT((difference - at.tangent.col(i)).lpNorm<Eigen::Infinity>(), 2e-6) << "unknown " << i;
    }
  }
}

TEST_P(ContactTangent, ForcesOnTheTwoSidesBalance) {
  const VectorXd multipliers = VectorXd::Constant(setup.zone.multiplier_count(), 0.7);
  const auto at = system_at(setup, setup.u, multipliers, Status::slip);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (mesh::NodeIndex node = 0; node < setup.mesh.node_count(); ++node)
    for (int i = 0; i < setup.dofs.components; ++i)
      sum[i] += at.residual[setup.dofs.dof(node, i)];
  EXPECT_LT(sum.norm(), 1e-13);
}

/// The gap is linear in a held frame, and its derivative what force and moment balance need.
TEST_P(ContactTangent, ToAFrameBetweenTwoOthersIsTheirMean) {
  const auto configuration = setup.configuration(setup.u);
  auto other = GetParam().options;
  other.seed += 1000; // the same cells, another shape: the frame of another face
  const auto turned = test::two_faces(other);
  const auto frames =
      contact::evaluate(setup.zone, VectorXd::Zero(setup.zone.multiplier_count()), configuration);
  const auto others = contact::evaluate(turned.zone, VectorXd::Zero(turned.zone.multiplier_count()),
                                        turned.configuration(turned.u));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].kinematics || !others[i].kinematics)
      continue;
    const auto& a = *frames[i].kinematics;
    const auto& b = *others[i].kinematics;
    auto between = contact::frozen_between(a, b);
    EXPECT_NEAR(between.normal.norm(), 1, 1e-14);
    EXPECT_NEAR(between.normal.dot(a.normal), between.normal.dot(b.normal), 1e-14);
    EXPECT_NEAR(between.tangents.col(0).dot(between.normal), 0, 1e-14);
    EXPECT_NEAR(between.stencil.weights.sum(), 0, 1e-14);
    contact::measure_in_frozen_frame(between, configuration);
    const double gap = between.gap;
    const VectorXd step = VectorXd::Random(setup.u.size());
    const VectorXd moved = setup.u + step;
    double change = 0;
    for (std::size_t node = 0; node < between.stencil.nodes.size(); ++node)
      for (int c = 0; c < between.stencil.components; ++c)
        change += between.d_gap[static_cast<Eigen::Index>(node) * between.stencil.components + c] *
                  step[setup.dofs.dof(between.stencil.nodes[node], c)];
    contact::measure_in_frozen_frame(between, setup.configuration(moved));
    EXPECT_NEAR(between.gap, gap + change, 1e-13);
  }
}

INSTANTIATE_TEST_SUITE_P(Faces, ContactTangent, testing::ValuesIn(variants()),
                         [](const auto& variant) { return variant.param.name; });

} // namespace
} // namespace rubato::tangent_test
