// SPDX-License-Identifier: LGPL-3.0-or-later
/// Surfaces for tests: grids of faces of any type, mapped to space.
#pragma once

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/operators.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace rubato::test {

using Eigen::Vector2d;
using Eigen::Vector3d;
namespace mortar = contact::mortar;

inline constexpr std::array plane_types{CellType::seg2, CellType::seg3};
inline constexpr std::array solid_types{CellType::tria3, CellType::tria6, CellType::tria7,
                                        CellType::quad4, CellType::quad8, CellType::quad9};

inline std::string name_of(CellType type) {
  return std::string(cell::topology(type).name);
}

/// From (s, t) in [0, 1]² to space.
using Map = std::function<Vector3d(double s, double t)>;

struct GridOptions {
  CellType type = CellType::quad4;
  int along = 1, across = 1; ///< faces
  /// Normals are −e_z (2D: −e_y) of the map (s, t, 0), else the opposite.
  bool downwards = false;
};

/// The corners of the parts of a unit square that have the shape of the type: where its reference coordinates
/// (0 to 1) lead.
struct Tile {
  Vector2d origin, first, second;
};

inline std::vector<Tile> tiles_of(CellType type) {
  if (cell::topology(type).corner_count == 3)
    return {{{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {-1, 0}, {0, -1}}};
  return {{{0, 0}, {1, 0}, {0, 1}}};
}

/// Faces of a grid over the unit square, its nodes added to the mesh.
inline std::vector<contact::Face> add_grid(mesh::Mesh& mesh, const GridOptions& options, const Map& map) {
  const auto& cell = cell::reference_cell(options.type);
  const bool line = cell.dimension == 1, triangle = cell::topology(options.type).corner_count == 3;
  std::map<std::pair<long, long>, mesh::NodeIndex> numbers;
  const auto number_of = [&](double s, double t) {
    const auto [place, is_new] =
        numbers.try_emplace({std::lround(s * 1e6), std::lround(t * 1e6)}, mesh.node_count());
    if (is_new)
      mesh.points.push_back(map(s, t));
    return place->second;
  };
  std::vector<contact::Face> faces;
  for (int j = 0; j < (line ? 1 : options.across); ++j)
    for (int i = 0; i < options.along; ++i)
      for (const auto& tile : tiles_of(options.type)) {
        contact::Face face{.type = options.type, .node_count = cell.node_count, .nodes = {}, .positions = {}};
        for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
          Vector2d r = triangle ? Vector2d(cell.nodes[k].head<2>())
                                : Vector2d(0.5 * (cell.nodes[k].head<2>() + Vector2d::Ones()));
          if (line)
            r = {options.downwards ? r[0] : 1 - r[0], 0};
          else if (options.downwards)
            r = {r[1], r[0]};
          const Vector2d at = tile.origin + r[0] * tile.first + r[1] * tile.second;
          face.nodes[k] = number_of((i + at[0]) / options.along, line ? 0. : (j + at[1]) / options.across);
        }
        faces.push_back(face);
      }
  return faces;
}

/// A slave that looks down on a master, in one mesh.
struct TwoSurfaces {
  mesh::Mesh mesh;
  contact::Surface slave, master;

  static std::vector<Vector3d> at(const contact::Surface& surface, const std::vector<Vector3d>& points) {
    std::vector<Vector3d> x;
    for (const auto node : surface.nodes)
      x.push_back(points[static_cast<std::size_t>(node)]);
    return x;
  }
  std::vector<Vector3d> slave_x() const { return at(slave, mesh.points); }
  std::vector<Vector3d> master_x() const { return at(master, mesh.points); }
  mortar::SlaveReference reference(const mortar::Measure& measure = {}) const {
    return mortar::make_slave_reference(slave, slave_x(), measure);
  }
  /// With the mesh as it is, undeformed and deformed.
  mortar::Operators operators(const mortar::Options& options = {},
                              const mortar::Measure& measure = {}) const {
    return mortar::integrate(slave, reference(measure), master, slave_x(), master_x(), options);
  }
  /// With the nodes at other places.
  mortar::Operators operators_at(const std::vector<Vector3d>& points,
                                 const mortar::Options& options = {}) const {
    return mortar::integrate(slave, reference(), master, at(slave, points), at(master, points), options);
  }
};

inline auto reading(const std::vector<Vector3d>& points) {
  return [&points](mesh::NodeIndex node) { return points[static_cast<std::size_t>(node)]; };
}

inline TwoSurfaces two_surfaces(GridOptions slave, const Map& slave_map, GridOptions master,
                                const Map& master_map) {
  TwoSurfaces two;
  slave.downwards = true;
  master.downwards = false;
  const auto slave_faces = add_grid(two.mesh, slave, slave_map);
  const auto master_faces = add_grid(two.mesh, master, master_map);
  two.slave = contact::make_surface(two.mesh, slave_faces);
  two.master = contact::make_surface(two.mesh, master_faces);
  return two;
}

/// Σ_j B_ji p_j over the nodes of the mesh, for a pressure of 1: ∫N of the slave, −∫N of the master.
inline std::vector<double> forces_of_unit_pressure(const TwoSurfaces& two,
                                                   const mortar::Operators& operators) {
  std::vector<double> forces(two.mesh.points.size(), 0);
  for (const auto& node : operators.nodes)
    for (std::size_t i = 0; i < node.stencil.nodes.size(); ++i)
      forces[static_cast<std::size_t>(node.stencil.nodes[i])] +=
          node.weight * node.stencil.weights[static_cast<Eigen::Index>(i)];
  return forces;
}

/// ∫N over the faces of a surface, by node of the mesh.
inline std::vector<double> integrals_of_shapes(const mesh::Mesh& mesh, const contact::Surface& surface,
                                               const mortar::Measure& measure = {}) {
  std::vector<double> integrals(mesh.points.size(), 0);
  for (const auto& face : surface.faces) {
    contact::FaceCoordinates x(3, face.node_count);
    for (int i = 0; i < face.node_count; ++i)
      x.col(i) = mesh.points[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)])];
    for (const auto& [place, weight] : cell::rule_of_degree(face.type, 9)) {
      const Vector2d xi = place.head<2>();
      const auto values = contact::face_values(face.type, xi);
      for (std::size_t i = 0; i < face.node_span().size(); ++i)
        integrals[static_cast<std::size_t>(face.nodes[i])] +=
            weight * mortar::undeformed_measure(face.type, x, xi, measure) * values[i];
    }
  }
  return integrals;
}

} // namespace rubato::test
