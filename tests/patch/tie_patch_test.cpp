// SPDX-License-Identifier: LGPL-3.0-or-later
/// The patch test of ties: through surfaces whose meshes do not match a linear field of displacements goes
/// exactly, with its tractions.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "patch/cell_pairs.hpp"
#include "patch/contact_blocks.hpp"
#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <array>
#include <tuple>

namespace rubato::tie_patch_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::ContactBlocks;

/// Of a displacement u = H x.
Matrix3d gradient(int dimension) {
  Matrix3d h;
  h << 3e-3, -2e-3, 5e-3, 7e-3, 1e-3, -4e-3, 2e-3, 6e-3, -3e-3;
  for (int i = dimension; i < 3; ++i) {
    h.row(i).setZero();
    h.col(i).setZero();
  }
  return h;
}

constexpr double young = 2e6;
constexpr double poisson = 0.3;

/// In plane strain and in space.
Matrix3d stress_of(const Matrix3d& h) {
  const Matrix3d strain = 0.5 * (h + h.transpose());
  const double shear = young / (2 * (1 + poisson));
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  return 2 * shear * strain + lame * strain.trace() * Matrix3d::Identity();
}

/// Two blocks, their outer sides and ends displaced by a linear field.
class TiedBlocks {
public:
  TiedBlocks(CellType above, CellType below, int upper, int lower, const std::string& solver)
      : walk_(model_of(above, below, upper, lower, solver)), dimension_(walk_.model.dofs.components) {}

  bool solve() { return walk_.to_end(); }

  /// In parts of the largest displacement.
  double error_of_displacement() const {
    double error = 0;
    double largest = 0;
    const Matrix3d h = gradient(dimension_);
    for (const auto node : walk_.model.dofs.nodes) {
      const Vector3d exact = h * walk_.model.mesh.points[static_cast<std::size_t>(node)];
      largest = std::max(largest, exact.norm());
      for (int c = 0; c < dimension_; ++c)
        error = std::max(error, std::abs(walk_.displacement(node, c) - exact[c]));
    }
    return error / largest;
  }

  /// Of the slave's nodes that nothing else holds, in parts of the traction.
  double error_of_traction() const {
    const Vector3d exact = -stress_of(gradient(dimension_)).col(1);
    const auto& multipliers = walk_.state().zones.front().multipliers;
    double error = 0;
    for (std::size_t i = 0; i < walk_.slave_count(); ++i) {
      if (on_outside(walk_.slave_point(i), dimension_))
        continue;
      ++seen_;
      for (int c = 0; c < dimension_; ++c)
        error =
            std::max(error, std::abs(multipliers[static_cast<Eigen::Index>(i) * dimension_ + c] - exact[c]));
    }
    return error / exact.norm();
  }
  int tractions_seen() const { return seen_; }

private:
  static bool on_outside(const Vector3d& x, int dimension) {
    const auto is = [](double a, double b) { return std::abs(a - b) < 1e-9; };
    return is(x[0], 0) || is(x[0], 1) || is(x[1], 0) || is(x[1], 2) ||
           (dimension == 3 && (is(x[2], 0) || is(x[2], 1)));
  }

  static test::BuiltModel model_of(CellType above, CellType below, int upper, int lower,
                                   const std::string& solver) {
    const ContactBlocks blocks{above, upper, lower, 0, ", tie: true", 0, {}, below};
    const std::vector<deck::Setting> changes{{"materials.rubber.poisson", "0.3"}, {"solver", solver}};
    auto study = deck::parse_deck(test::deck_of(blocks), "deck.yaml", changes).runs.front();
    auto mesh = model::load_mesh(study.mesh);
    study.supports.clear();
    const Matrix3d h = gradient(mesh.dimension);
    for (std::size_t node = 0; node < mesh.points.size(); ++node) {
      if (!on_outside(mesh.points[node], mesh.dimension))
        continue;
      auto& support = study.supports.emplace_back();
      support.on = fmt::format("N{}", node + 1);
      const Vector3d u = h * mesh.points[node];
      for (int c = 0; c < mesh.dimension; ++c)
        support.components[static_cast<std::size_t>(c)] = study::Amplitude{u[c], ""};
    }
    return test::BuiltModel(study, std::move(mesh));
  }

  test::Walk walk_;
  int dimension_;
  mutable int seen_ = 0;
};

class Tied : public testing::TestWithParam<test::CellPair> {
protected:
  static void expect_exact(int upper, int lower, const std::string& solver = "auto") {
    const auto& [above, below] = GetParam();
    TiedBlocks blocks(above, below, upper, lower, solver);
    ASSERT_TRUE(blocks.solve());
    EXPECT_LT(blocks.error_of_displacement(), 1e-12) << upper << " on " << lower;
    EXPECT_LT(blocks.error_of_traction(), 1e-10) << upper << " on " << lower;
    EXPECT_GT(blocks.tractions_seen(), 0);
  }
};

TEST_P(Tied, BlocksHandOnALinearFieldThoughTheirMeshesDoNotMatch) {
  expect_exact(3, 4);
  expect_exact(3, 2);
}

TEST_P(Tied, BlocksHandOnALinearFieldByTheWholeSystemToo) {
  expect_exact(3, 2, "full");
}

/// Sides of symmetry hold one component of the slave's nodes on them.
TEST_P(Tied, BlocksHandOnAPressureBetweenSidesOfSymmetry) {
  const auto& [above, below] = GetParam();
  test::Walk walk(test::deck_of({above, 3, 2, 0, ", tie: true", 0, {}, below}));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 1U);
  for (std::size_t i = 0; i < walk.slave_count(); ++i) {
    EXPECT_NEAR(walk.state().zones.front().outcomes[i].pressure, 1e5, 1e-4);
    EXPECT_NEAR(walk.displacement(walk.model.zones.front().slave.nodes[i], 1), -0.05, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Plane, Tied,
                         testing::Combine(testing::ValuesIn(test::plane_cells),
                                          testing::ValuesIn(test::plane_cells)),
                         &test::name_of_pair);
INSTANTIATE_TEST_SUITE_P(Solid, Tied,
                         testing::Combine(testing::ValuesIn(test::solid_cells),
                                          testing::ValuesIn(test::solid_cells)),
                         &test::name_of_pair);

} // namespace
} // namespace rubato::tie_patch_test
