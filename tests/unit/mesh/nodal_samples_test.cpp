// SPDX-License-Identifier: LGPL-3.0-or-later
// Places in cells, and fields between the nodes at which they are known.
#include "rubato/mesh/interpolation.hpp"
#include "rubato/mesh/nodal_samples.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/faults.hpp"
#include "support/patch_mesh.hpp"
#include <cmath>
#include <limits>
#include <random>

namespace rubato::mesh::nodal_samples_test {
namespace {

using Eigen::Vector3d;

std::span<const double, 3> numbers_of(const Vector3d& x) {
  return std::span<const double, 3>(x.data(), 3);
}

double linear(const Vector3d& x) {
  return 3 + x.dot(Vector3d(2, -5, 7));
}

NodalSamples samples_of(const Mesh& mesh) {
  NodalSamples samples{"the field", mesh.points, {0}, {{}}};
  for (const auto& x : mesh.points)
    samples.values[0].push_back(linear(x));
  return samples;
}

std::shared_ptr<const SampledField> field_on(const Mesh& mesh, const NodalSamples& samples) {
  return sampled_field(std::make_shared<const PlaceFinder>(mesh), samples);
}

class FieldsOnEveryCell : public testing::TestWithParam<test::BulkCase> {
protected:
  int d_ = element::component_count(GetParam().physics);
  Mesh mesh_ =
      test::patch_mesh(GetParam().type, 3, test::moved_by(test::shaken(d_, 3, 0.2), Vector3d(1, 0, 0)));
};

TEST_P(FieldsOnEveryCell, AreLinearWhereTheirNodesAre) {
  const auto field = field_on(mesh_, samples_of(mesh_));
  for (const auto& x : mesh_.points)
    EXPECT_EQ(field->at(numbers_of(x), 0), linear(x));
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> share(0.05, 1);
  double error = 0;
  for_each_cell(mesh_, [&](CellIndex, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    if (shape.dimension != mesh_.dimension)
      return;
    Vector3d xi = Vector3d::Zero(); // in the reference cell: a mean of its corners
    double sum = 0;
    const auto& reference = cell::reference_cell(shape.type);
    for (int i = 0; i < shape.corner_count; ++i) {
      const double weight = share(engine);
      xi += weight * reference.nodes[static_cast<std::size_t>(i)];
      sum += weight;
    }
    const auto x = position(shape.type, nodes, mesh_.points, xi / sum);
    error = std::max(error, std::abs(field->at(numbers_of(x), 0) - linear(x)));
  });
  EXPECT_LT(error, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Cells, FieldsOnEveryCell, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& instance) { return test::name_of(instance.param); });

class FieldsOnSquares : public testing::Test {
protected:
  Mesh mesh_ = test::patch_mesh(CellType::quad4, 2, test::shaken(2, 2, 0));
  NodalSamples samples_ = samples_of(mesh_);

  std::string fault_at(const Vector3d& x) const {
    return test::fault_of([&] { field_on(mesh_, samples_)->at(numbers_of(x), 0); });
  }
};

TEST_F(FieldsOnSquares, AreLinearBetweenInstantsAndConstantOutside) {
  samples_.instants = {1, 3};
  samples_.values.push_back(std::vector<double>(mesh_.points.size(), 0));
  const auto field = field_on(mesh_, samples_);
  EXPECT_TRUE(field->varies_in_time());
  const auto& x = mesh_.points[3];
  EXPECT_EQ(field->at(numbers_of(x), 0), linear(x));
  EXPECT_NEAR(field->at(numbers_of(x), 1.5), 0.75 * linear(x), 1e-15 * std::abs(linear(x)));
  EXPECT_EQ(field->at(numbers_of(x), 3), 0);
  EXPECT_EQ(field->at(numbers_of(x), 9), 0);
}

TEST_F(FieldsOnSquares, MayComeInAnotherOrderOfTheNodes) {
  std::ranges::reverse(samples_.places);
  std::ranges::reverse(samples_.values[0]);
  EXPECT_EQ(field_on(mesh_, samples_)->at(numbers_of(mesh_.points[1]), 0), linear(mesh_.points[1]));
}

TEST_F(FieldsOnSquares, AreRefusedWhereANodeHasNoneWithTheDistanceToTheNearest) {
  samples_.values[0][0] = std::numeric_limits<double>::infinity();
  const auto& x = mesh_.points[0];
  double least = 1e9;
  for (std::size_t i = 1; i < mesh_.points.size(); ++i)
    least = std::min(least, (mesh_.points[i] - x).norm());
  EXPECT_EQ(fault_at(x),
            fmt::format("the field has no value at node N1 ({}), the nearest node that has one is "
                        "{:.4g} away",
                        shown_place(numbers_of(x)), least));
  samples_.places = {Vector3d(50, 0, 0)};
  samples_.values = {{1}};
  EXPECT_NE(fault_at(x).find("the nearest node that has one is"), std::string::npos);
}

TEST_F(FieldsOnSquares, AreRefusedOutsideOfTheMesh) {
  EXPECT_EQ(fault_at({9, 9, 0}),
            "the field is asked for at x = 9, y = 9, z = 0, where no cell of the mesh is");
}

TEST_F(FieldsOnSquares, AreRefusedWhereNodesAtOnePlaceDiffer) {
  samples_.places.push_back(mesh_.points[0]);
  samples_.values[0].push_back(99);
  std::swap(samples_.places[0], samples_.places[1]);
  EXPECT_NE(fault_at(mesh_.points[0]).find("several values at"), std::string::npos);
}

} // namespace
} // namespace rubato::mesh::nodal_samples_test
