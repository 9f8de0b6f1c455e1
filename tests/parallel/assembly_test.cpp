// SPDX-License-Identifier: LGPL-3.0-or-later
// Matrices and forces of bodies do not depend on the number of threads, to the last bit.
#include "rubato/domain/assembly.hpp"
#include "rubato/domain/recovery.hpp"
#include "rubato/linalg/block_matrix.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <random>
#include <tuple>

namespace rubato::domain::assembly_test {
namespace {

constexpr std::array more_threads{2, 3, 5};

/// Two materials, and nodes that are moved a little, so that all cells differ.
model::Model shaken_box(const std::string& cells, int n, const std::string& law = "") {
  auto model = model::build_model(test::study_of(fmt::format(R"(
mesh: {{generate: [{{name: a, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [{0}, {0}, {0}], cells: {1}}},
                  {{name: b, box: {{from: [3, 0, 0], to: [4, 1, 1]}}, divisions: [{0}, {0}, {0}], cells: {1}}}]}}
physics: solid
materials:
  steel: {{young: 200e9, poisson: 0.3, density: 7800, cells: a{2}}}
  brass: {{young: 100e9, poisson: 0.35, density: 8500, cells: b{2}}}
time: {{scheme: newmark, step: 1e-5, end: 1e-5}}
)",
                                                             n, cells, law)));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> move(-0.05 / n, 0.05 / n);
  for (auto& point : model.mesh.points)
    for (int a = 0; a < 3; ++a)
      point[a] += move(random);
  return model;
}

void expect_same(const SparseMatrix& a, const SparseMatrix& b) {
  ASSERT_EQ(a.nonZeros(), b.nonZeros());
  EXPECT_TRUE(std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1, b.outerIndexPtr()));
  EXPECT_TRUE(std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()));
  EXPECT_TRUE(std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr()));
}

class AssemblyByThreads : public testing::TestWithParam<std::string> {};

TEST_P(AssemblyByThreads, GivesTheMatricesOfOne) {
  const auto model = shaken_box(GetParam(), 12);
  const auto& [mesh, bulk, dofs] = std::tie(model.mesh, model.bulk, model.dofs);
  const BlockPattern one(mesh, bulk.cells, dofs);
  ASSERT_EQ(one.shares().count(), 1);
  for (const int threads : more_threads) {
    const BlockPattern several(mesh, bulk.cells, dofs, Threads(threads));
    ASSERT_EQ(several.shares().count(), threads);
    ASSERT_EQ(several.shares().border().empty(), threads == 2); // one body each
    expect_same(assemble_stiffness(mesh, bulk, one), assemble_stiffness(mesh, bulk, several));
    expect_same(assemble_mass(mesh, bulk, one), assemble_mass(mesh, bulk, several));
    expect_same(one.zero_matrix(), several.zero_matrix());
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, AssemblyByThreads, testing::Values("hexa8", "hexa20", "tetra4", "penta6"));

TEST(StressesByThreads, AreThoseOfOne) {
  const auto model = shaken_box("hexa8", 12);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> any(-1e-3, 1e-3);
  Eigen::VectorXd u(model.dofs.dof_count);
  for (auto& value : u)
    value = any(random);
  const auto by = [&](int threads) {
    return nodal_stress(model.mesh, model.bulk, model.dofs, u, {}, nullptr, Threads(threads));
  };
  const auto one = by(1);
  EXPECT_GT(one.von_mises.maxCoeff(), 1e8);
  for (const int threads : more_threads) {
    EXPECT_EQ(by(threads).stress, one.stress);
    EXPECT_EQ(by(threads).von_mises, one.von_mises);
  }
}

TEST(ProductByThreads, DiffersFromThatOfOneByRounding) {
  const auto model = shaken_box("hexa8", 24);
  const auto stiffness =
      assemble_stiffness(model.mesh, model.bulk, BlockPattern(model.mesh, model.bulk.cells, model.dofs));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  Eigen::VectorXd x(stiffness.rows());
  for (auto& value : x)
    value = any(random);
  Eigen::VectorXd by_one(x.size()), by_several(x.size()), again(x.size());
  linalg::SymmetricBlockMatrix(stiffness, 3).multiply(x, by_one);
  for (const int threads : more_threads) {
    const linalg::SymmetricBlockMatrix several(stiffness, 3, Threads(threads));
    several.multiply(x, by_several);
    several.multiply(x, again);
    EXPECT_EQ(by_several, again) << threads;
    EXPECT_LE((by_several - by_one).lpNorm<Eigen::Infinity>(), 1e-14 * by_one.lpNorm<Eigen::Infinity>())
        << threads;
  }
}

} // namespace
} // namespace rubato::domain::assembly_test
