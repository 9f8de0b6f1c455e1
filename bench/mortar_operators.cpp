// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the operators of mortar contact cost at an iterate: normals, search, segments, integrals and
/// stencils, of two sheets that are bent alike and moved along each other by a third of a face. Arguments: 0
/// SEG2, 20 faces (SDNL140 F); 1 SEG3; 2 QUAD4, 160 × 8 (SDNL140 C refined by 8); 3 QUAD8 and 4 TRIA6, 40
/// × 4. Counter: seconds of processor time for one slave node.
#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/operators.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace rubato::bench::mortar_operators {
namespace {
using namespace contact;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Case {
  std::string name;
  CellType type;
  int along, across;
};
const std::array cases{Case{"SEG2, 20", CellType::seg2, 20, 1}, Case{"SEG3, 20", CellType::seg3, 20, 1},
                       Case{"QUAD4, 160 x 8", CellType::quad4, 160, 8},
                       Case{"QUAD8, 40 x 4", CellType::quad8, 40, 4},
                       Case{"TRIA6, 40 x 4", CellType::tria6, 40, 4}};

/// A sheet of squares, or of squares cut in two, that looks up or down.
Surface sheet(const Case& of, bool downwards, mesh::Mesh& mesh) {
  const auto& cell = cell::reference_cell(of.type);
  const bool triangle = cell::topology(of.type).corner_count == 3;
  std::map<std::array<long, 2>, mesh::NodeIndex> numbers;
  std::vector<Face> faces;
  for (int i = 0; i < of.along * of.across * (triangle ? 2 : 1); ++i) {
    const int tile = triangle ? i / 2 : i;
    Face face{.type = of.type, .node_count = cell.node_count, .nodes = {}, .positions = {}};
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      Vector2d r = cell.nodes[k].head<2>();
      if (!triangle)
        r = 0.5 * (r + Vector2d::Ones());
      else if (i % 2 == 1)
        r = Vector2d::Ones() - r;
      if (cell.dimension == 1)
        r = {downwards ? r[0] : 1 - r[0], 0};
      else if (downwards)
        r = {r[1], r[0]};
      const double x = (tile % of.along + r[0]) / of.along, z = 0.1 * (tile / of.along + r[1]) / of.across;
      const auto [place, is_new] =
          numbers.try_emplace({std::lround(1e7 * x), std::lround(1e7 * z)}, mesh.node_count());
      if (is_new)
        mesh.points.push_back(cell.dimension == 1 ? Vector3d(x, 0, 0) : Vector3d(x, z, 0));
      face.nodes[k] = place->second;
    }
    faces.push_back(face);
  }
  return make_surface(mesh, std::move(faces));
}

std::vector<Vector3d> bent(const Surface& surface, const mesh::Mesh& mesh, double height, double shift) {
  const int up = parametric_dimension(surface.faces.front().type);
  std::vector<Vector3d> x;
  for (const auto node : surface.nodes) {
    auto at = mesh.points[static_cast<std::size_t>(node)];
    at[up] += height * at[0] * at[0];
    at[0] += shift;
    x.push_back(at);
  }
  return x;
}

void IntegrateMortar(benchmark::State& state) {
  const auto& of = cases[static_cast<std::size_t>(state.range(0))];
  mesh::Mesh mesh;
  const auto slave = sheet(of, true, mesh), master = sheet(of, false, mesh);
  const auto reference = mortar::make_slave_reference(slave, bent(slave, mesh, 0, 0));
  mortar::Workspace workspace;
  mortar::Operators operators;
  int iterate = 0;
  for (auto _ : state) {
    const double height = 0.1 + 1e-4 * (++iterate % 7);
    mortar::integrate(slave, reference, master, bent(slave, mesh, height, 0.3 / of.along),
                      bent(master, mesh, height, 0), {}, workspace, operators);
    benchmark::DoNotOptimize(operators.covered_area);
  }
  state.SetLabel(of.name + ", " + std::to_string(slave.nodes.size()) + " nodes");
  state.counters["node"] =
      benchmark::Counter(static_cast<double>(slave.nodes.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(IntegrateMortar)->DenseRange(0, 4)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace rubato::bench::mortar_operators
