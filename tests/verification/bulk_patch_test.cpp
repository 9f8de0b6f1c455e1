// SPDX-License-Identifier: LGPL-3.0-or-later
// Patches of cells of every kind and material: where the border is moved by an affine map, nodes inside are
// on it too, and stresses are uniform.
#include "rubato/deck/read.hpp"
#include "rubato/mesh/convert.hpp"
#include "rubato/mesh/made_groups.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "verification/bulk_run.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification::bulk_patch_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Material {
  std::string_view name, keys;
  std::vector<std::string_view> strains;
};

struct Patch {
  std::string_view physics, cells, formulation;

  bool is_solid() const { return physics == "solid"; }
  /// Of the grid, before nodes are added.
  std::string_view linear_cells() const {
    for (const std::string_view shape : {"tetra", "hexa", "penta", "tria", "quad"})
      if (cells.starts_with(shape))
        return shape == "tetra"   ? "tetra4"
               : shape == "hexa"  ? "hexa8"
               : shape == "penta" ? "penta6"
               : shape == "tria"  ? "tria3"
                                  : "quad4";
    return cells;
  }
  study::MeshConversion conversion() const {
    if (cells == linear_cells())
      return study::MeshConversion::none;
    return cells == "hexa27" || cells == "quad9" || cells == "tria7" ? study::MeshConversion::full_quadratic
                                                                     : study::MeshConversion::quadratic;
  }
};

std::ostream& operator<<(std::ostream& stream, const Patch& patch) {
  return stream << patch.physics << ' ' << patch.cells << ' ' << patch.formulation;
}

std::string name_of(const testing::TestParamInfo<Patch>& info) {
  return fmt::format("{}_{}_{}", info.param.physics, info.param.cells, info.param.formulation);
}

constexpr std::string_view elastic = "young: 1, poisson: 0.3";
constexpr std::string_view linear =
    "law: plastic, young: 1, poisson: 0.3, hardening: {linear: {yield_stress: 1e-3, modulus: 0.1}}";
constexpr std::string_view voce = "law: plastic, young: 1, poisson: 0.3, hardening: {voce: {yield_stress: "
                                  "1e-3, saturation: 1e-3, exponent: "
                                  "50, modulus: 0.05}}";
constexpr std::string_view kinematic =
    "law: plastic, young: 1, poisson: 0.3, hardening: {linear: {yield_stress: 1e-3, modulus: 0.02}}, "
    "kinematic: {modulus: 0.1, recall: 5}";
constexpr std::string_view prony =
    "law: prony, young: 1, poisson: 0.3, terms: [{shear: 2, time: 0.1}, {shear: 1, time: 1}]";

/// Axisymmetric ones are the same along the radius and the hoop: else stresses could not be uniform.
std::string_view orthotropic(std::string_view physics) {
  if (physics == "solid")
    return "law: orthotropic, young_x: 1, young_y: 0.5, young_z: 0.3, poisson_xy: 0.3, poisson_yz: 0.2, "
           "poisson_xz: 0.1, shear_xy: 0.2, shear_yz: 0.15, shear_xz: 0.1, angle_z: 20";
  if (physics == "plane_strain")
    return "law: orthotropic, young_x: 1, young_y: 0.5, young_z: 0.3, poisson_xy: 0.3, poisson_yz: 0.2, "
           "poisson_xz: 0.1, shear_xy: 0.2, angle_z: 20";
  if (physics == "plane_stress")
    return "law: orthotropic, young_x: 1, young_y: 0.5, poisson_xy: 0.3, shear_xy: 0.2, angle_z: 20";
  return "law: orthotropic, young_x: 1, young_y: 0.5, young_z: 1, poisson_xy: 0.3, poisson_yz: 0.15, "
         "poisson_xz: 0.2, shear_xy: 0.2";
}

std::vector<Material> materials_of(const Patch& patch) {
  std::vector<Material> all{
      {"elastic", elastic, {"small", "green_lagrange", "logarithmic"}},
      {"orthotropic", orthotropic(patch.physics), {"small", "green_lagrange"}},
      {"linear", linear, {"small", "logarithmic"}},
      {"voce", voce, {"small", "logarithmic"}},
      {"kinematic", kinematic, {"small", "logarithmic"}},
      {"prony", prony, {"small", "logarithmic"}},
      {"hyperelastic", "law: hyperelastic, c10: 0.12, c01: 0.05, bulk: 20", {"green_lagrange"}},
      {"yeoh", "law: yeoh, c10: 0.2, c20: -0.01, c30: 0.002, bulk: 20", {"green_lagrange"}},
      {"ogden",
       "law: ogden, terms: [{shear: 0.3, exponent: 1.3}, {shear: 0.05, exponent: -2}], "
       "bulk: 20",
       {"green_lagrange"}}};
  if (patch.formulation != "enhanced")
    return all;
  for (auto& material : all)
    std::erase(material.strains, "logarithmic");
  std::erase_if(
      all, [](const Material& material) { return material.keys.find("bulk") != std::string_view::npos; });
  return all;
}

/// A grid whose inner nodes are off their places.
mesh::Mesh patch_mesh(const Patch& patch) {
  const double left = patch.physics == "axisymmetric" ? 1 : 0;
  const auto grid =
      patch.is_solid()
          ? std::string("box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2]")
          : fmt::format("rectangle: {{from: [{}, 0], to: [{}, 1]}}, divisions: [3, 3]", left, left + 1);
  const auto study = deck::parse_deck(fmt::format(R"(mesh:
  generate: [{{name: patch, {}, cells: {}}}]
  groups: {{skin: {{skin: all}}, hull: {{nodes_of: skin}}}}
physics: {}
materials: {{any: {{young: 1, poisson: 0}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                                                  grid, patch.linear_cells(), patch.physics),
                                      "patch.yaml")
                         .runs.front();
  auto source = study.mesh;
  source.groups.clear();
  auto mesh = model::load_mesh(source);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> offset(-0.1, 0.1);
  const int axes = patch.is_solid() ? 3 : 2;
  for (auto& x : mesh.points) {
    const Vector3d inside = x - Vector3d(left, 0, 0);
    if (inside.head(axes).minCoeff() > 1e-9 && inside.head(axes).maxCoeff() < 1 - 1e-9)
      for (int i = 0; i < axes; ++i)
        x[i] += offset(engine);
  }
  return mesh::with_groups(mesh::converted(mesh, patch.conversion()), study.mesh.groups);
}

/// Displacement gradient.
Matrix3d gradient(std::string_view physics) {
  Matrix3d h;
  if (physics == "solid")
    h << 0.3, 0.4, -0.2, 0.1, -0.2, 0.3, 0.2, -0.1, 0.25;
  else if (physics == "axisymmetric")
    h << 0.4, 0, 0, 0, -0.3, 0, 0, 0, 0;
  else
    h << 0.3, 0.4, 0, 0.1, -0.2, 0, 0, 0, 0;
  return h;
}

std::string patch_deck(const Patch& patch, const Material& material, std::string_view strain,
                       const Matrix3d& h) {
  std::string support;
  for (int i = 0; i < (patch.is_solid() ? 3 : 2); ++i)
    support += fmt::format(", {}: \"t*({:.17g}*x + {:.17g}*y + {:.17g}{})\"", "xyz"[i], h(i, 0), h(i, 1),
                           h(i, 2), patch.is_solid() ? "*z" : "");
  return fmt::format(R"(mesh: {{file: patch.med}}
physics: {}
materials: {{any: {{{}, strain: {}, formulation: {}}}}}
supports: [{{on: hull{}}}]
newton: {{residual: 1.0e-12}}
time: {{scheme: static, step: 0.5, end: 1}}
)",
                     patch.physics, material.keys, strain, patch.formulation, support);
}

/// The largest distance of a node from the map, in parts of the largest displacement.
double off_the_map(const test::Walk& walk, const Matrix3d& h) {
  double off = 0, largest = 0;
  for (const auto node : walk.model.dofs.nodes) {
    const Vector3d u = h * walk.model.mesh.points[static_cast<std::size_t>(node)];
    largest = std::max(largest, u.lpNorm<Eigen::Infinity>());
    for (int i = 0; i < walk.model.dofs.components; ++i)
      off = std::max(off, std::abs(walk.displacement(node, i) - u[i]));
  }
  return off / largest;
}

/// How much a component of stress varies at most, in parts of the largest stress.
double variation(const std::vector<double>& stresses) {
  const auto rows = static_cast<Eigen::Index>(stresses.size()) / 6;
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> s(stresses.data(), 6, rows);
  return (s.rowwise().maxCoeff() - s.rowwise().minCoeff()).maxCoeff() / s.cwiseAbs().maxCoeff();
}

class BulkPatch : public testing::TestWithParam<Patch> {};

TEST_P(BulkPatch, HasTheAffineMotionOfItsBorderAndUniformStress) {
  const auto& patch = GetParam();
  const auto mesh = patch_mesh(patch);
  for (const auto& material : materials_of(patch))
    for (const auto strain : material.strains) {
      SCOPED_TRACE(fmt::format("{}, {}", material.name, strain));
      const Matrix3d h = (strain == "small" ? 0.02 : 0.4) * gradient(patch.physics);
      BulkRun run(patch_deck(patch, material, strain, h), mesh);
      run.to_end();
      EXPECT_EQ(run.cuts(), 0);
      EXPECT_LT(off_the_map(run.walk(), h), 1e-10);
      EXPECT_LT(variation(run.cell_values("stress_elga")), 1e-10);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Cells, BulkPatch,
    testing::Values(Patch{"solid", "tetra4", "full"}, Patch{"solid", "tetra10", "full"},
                    Patch{"solid", "hexa8", "full"}, Patch{"solid", "hexa8", "mean_dilatation"},
                    Patch{"solid", "hexa8", "enhanced"}, Patch{"solid", "hexa20", "full"},
                    Patch{"solid", "hexa27", "full"}, Patch{"solid", "penta6", "full"},
                    Patch{"solid", "penta6", "mean_dilatation"}, Patch{"solid", "penta15", "full"},
                    Patch{"plane_strain", "tria3", "full"}, Patch{"plane_strain", "tria6", "full"},
                    Patch{"plane_strain", "tria7", "full"}, Patch{"plane_strain", "quad4", "full"},
                    Patch{"plane_strain", "quad4", "mean_dilatation"},
                    Patch{"plane_strain", "quad4", "enhanced"}, Patch{"plane_strain", "quad8", "full"},
                    Patch{"plane_strain", "quad9", "full"}, Patch{"plane_stress", "tria3", "full"},
                    Patch{"plane_stress", "tria6", "full"}, Patch{"plane_stress", "tria7", "full"},
                    Patch{"plane_stress", "quad4", "full"}, Patch{"plane_stress", "quad4", "enhanced"},
                    Patch{"plane_stress", "quad8", "full"}, Patch{"plane_stress", "quad9", "full"},
                    Patch{"axisymmetric", "tria3", "full"}, Patch{"axisymmetric", "tria6", "full"},
                    Patch{"axisymmetric", "tria7", "full"}, Patch{"axisymmetric", "quad4", "full"},
                    Patch{"axisymmetric", "quad4", "mean_dilatation"},
                    Patch{"axisymmetric", "quad4", "enhanced"}, Patch{"axisymmetric", "quad8", "full"},
                    Patch{"axisymmetric", "quad9", "full"}),
    name_of);

} // namespace
} // namespace rubato::verification::bulk_patch_test
