// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/generate.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/convert.hpp"
#include "rubato/mesh/grid_place.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::mesh {
namespace {

using Handles = std::vector<MeshBuilder::CellHandle>;
using Local = std::array<std::uint8_t, 8>;

/// The corners of a body's cells: a lattice whose nodes are numbered along x first, then y, then z.
struct Grid {
  std::array<double, 3> from;
  std::array<double, 3> to;
  std::array<NodeIndex, 3> divisions; ///< 0 along z in a rectangle

  NodeIndex node(const std::array<NodeIndex, 3>& at) const {
    return at[0] + (divisions[0] + 1) * (at[1] + (divisions[1] + 1) * at[2]);
  }
  std::array<NodeIndex, 3> lattice_place(NodeIndex node_index) const {
    const auto row = node_index / (divisions[0] + 1);
    return {node_index % (divisions[0] + 1), row % (divisions[1] + 1), row / (divisions[1] + 1)};
  }
  double coordinate(std::size_t axis, NodeIndex i) const {
    return divisions[axis] == 0 ? 0 : std::lerp(from[axis], to[axis], double(i) / divisions[axis]);
  }
  bool lies_on(const GridPlace& place, NodeIndex node_index) const {
    const auto at = lattice_place(node_index);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (place[axis] != 0 && at[axis] != (place[axis] < 0 ? 0 : divisions[axis]))
        return false;
    return true;
  }
};

Grid grid_of(const study::Body& body, int refine) {
  Grid grid{body.from, body.to, {}};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(body.dimension); ++axis)
    grid.divisions[axis] = body.divisions[axis] * refine;
  return grid;
}

/// How a grid cell (corners of QUAD4 or HEXA8) is cut into cells of a linear type.
std::span<const Local> parts_of_grid_cell(CellType linear) {
  static constexpr std::array<Local, 1> whole{{{0, 1, 2, 3, 4, 5, 6, 7}}};
  static constexpr std::array<Local, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
  static constexpr std::array<Local, 2> prisms{{{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}};
  static constexpr std::array<Local, 6> tetrahedra{
      {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};
  switch (linear) {
  case CellType::tria3:
    return triangles;
  case CellType::penta6:
    return prisms;
  case CellType::tetra4:
    return tetrahedra;
  default:
    return whole;
  }
}

void add_nodes(MeshBuilder& builder, const Grid& grid) {
  for (NodeIndex k = 0; k <= grid.divisions[2]; ++k)
    for (NodeIndex j = 0; j <= grid.divisions[1]; ++j)
      for (NodeIndex i = 0; i <= grid.divisions[0]; ++i)
        builder.add_node({grid.coordinate(0, i), grid.coordinate(1, j), grid.coordinate(2, k)});
}

std::array<NodeIndex, 8> grid_cell(const Grid& grid, NodeIndex i, NodeIndex j, NodeIndex k) {
  std::array<NodeIndex, 8> corners{};
  constexpr std::array<std::array<NodeIndex, 2>, 4> base{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t c = 0; c < 8; ++c)
    corners[c] = grid.node({i + base[c % 4][0], j + base[c % 4][1], k + (c < 4 ? 0 : 1)});
  return corners;
}

Mesh bulk_mesh(const study::Body& body, const Grid& grid) {
  MeshBuilder builder(body.dimension);
  add_nodes(builder, grid);
  const auto linear = cell::linear_type(body.cells);
  const auto node_count = static_cast<std::size_t>(cell::topology(linear).node_count);
  std::array<NodeIndex, 8> nodes{};
  Handles cells;
  const NodeIndex layers = body.dimension == 3 ? grid.divisions[2] : 1;
  for (NodeIndex k = 0; k < layers; ++k)
    for (NodeIndex j = 0; j < grid.divisions[1]; ++j)
      for (NodeIndex i = 0; i < grid.divisions[0]; ++i) {
        const auto corners = grid_cell(grid, i, j, k);
        for (const auto& part : parts_of_grid_cell(linear)) {
          for (std::size_t n = 0; n < node_count; ++n)
            nodes[n] = corners[part[n]];
          cells.push_back(builder.add_cell(linear, std::span(nodes).first(node_count)));
        }
      }
  builder.add_to_cell_group(body.name, cells);
  return std::move(builder).build();
}

void add_sides(MeshBuilder& builder, const study::Body& body, const Grid& grid, const Mesh& bulk) {
  const auto faces = skin(bulk);
  for (const auto& [key, group] : body.sides) {
    const auto place = *grid_place(key, body.dimension, 1);
    Handles cells;
    for (const auto& face : faces)
      if (std::ranges::all_of(face.nodes(), [&](NodeIndex node) { return grid.lies_on(place, node); }))
        cells.push_back(builder.add_cell(face.type, face.nodes()));
    builder.add_to_cell_group(group, cells);
  }
}

/// The lattice nodes of a place along which at most one axis is free, in ascending order along that axis.
std::vector<NodeIndex> nodes_of_place(const Grid& grid, const GridPlace& place) {
  std::array<NodeIndex, 3> at{};
  std::size_t free_axis = 0;
  NodeIndex last = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at[axis] = place[axis] > 0 ? grid.divisions[axis] : 0;
    if (place[axis] == 0) {
      free_axis = axis;
      last = grid.divisions[axis];
    }
  }
  std::vector<NodeIndex> nodes{grid.node(at)};
  for (NodeIndex i = 1; i <= last; ++i) {
    at[free_axis] = i;
    nodes.push_back(grid.node(at));
  }
  return nodes;
}

void add_edges(MeshBuilder& builder, const study::Body& body, const Grid& grid) {
  for (const auto& [key, group] : body.edges) {
    const auto nodes = nodes_of_place(grid, *grid_place(key, body.dimension, 2));
    Handles cells;
    for (std::size_t i = 1; i < nodes.size(); ++i)
      cells.push_back(builder.add_cell(CellType::seg2, std::span(nodes).subspan(i - 1, 2)));
    builder.add_to_cell_group(group, cells);
  }
}

void add_points(MeshBuilder& builder, const study::Body& body, const Grid& grid) {
  for (const auto& [key, group] : body.points)
    builder.add_to_node_group(group, nodes_of_place(grid, *grid_place(key, body.dimension, body.dimension)));
}

Mesh in_type(Mesh linear, CellType type) {
  const auto& shape = cell::topology(type);
  if (shape.order == 1)
    return linear;
  return type == cell::quadratic_type(cell::linear_type(type)) ? to_quadratic(linear)
                                                               : to_full_quadratic(linear);
}

Mesh body_mesh(const study::Body& body, int refine) {
  const auto grid = grid_of(body, refine);
  const auto bulk = bulk_mesh(body, grid);
  MeshBuilder builder(body.dimension);
  builder.append(bulk);
  if (!body.sides.empty())
    add_sides(builder, body, grid, bulk);
  add_edges(builder, body, grid);
  add_points(builder, body, grid);
  return in_type(std::move(builder).build(), body.cells);
}

// ---- what can be wrong
// -------------------------------------------------------------------------------------

std::vector<std::string> cell_names(int dimension) {
  if (dimension == 2)
    return {"TRIA3", "TRIA6", "TRIA7", "QUAD4", "QUAD8", "QUAD9"};
  return {"TETRA4", "TETRA10", "PENTA6", "PENTA15", "HEXA8", "HEXA20", "HEXA27"};
}

class BodyCheck {
public:
  BodyCheck(const study::Body& body, std::size_t index, std::vector<Fault>& faults)
      : body_(body), index_(index), faults_(faults) {}

  void run() {
    if (body_.dimension != 2 && body_.dimension != 3) {
      fault(fmt::format("has dimension {}: 2 (rectangle) or 3 (box) is expected", body_.dimension));
      return;
    }
    check_size();
    check_cells();
    check_places("side", body_.sides, 1);
    if (body_.dimension == 3)
      check_places("edge", body_.edges, 2);
    else if (!body_.edges.empty())
      fault("names edges, which a rectangle has not: name its sides or points",
            "edges." + body_.edges.begin()->first);
    check_places("point", body_.points, body_.dimension);
  }

private:
  /// `part` of the body, "sides.left".
  void fault(const std::string& text, const std::string& part = "") {
    const auto path = fmt::format("mesh.generate.{}", index_);
    faults_.push_back(
        fault_at(part.empty() ? path : path + "." + part, fmt::format("body '{}' {}", body_.name, text)));
  }

  void check_size() {
    constexpr std::array<char, 3> axes{'x', 'y', 'z'};
    for (std::size_t a = 0; a < static_cast<std::size_t>(body_.dimension); ++a) {
      // Written so that NaN fails too.
      if (!(body_.to[a] > body_.from[a]) || !std::isfinite(body_.to[a] - body_.from[a]))
        fault(fmt::format("goes from {} to {} along {}: the end must lie above the beginning", body_.from[a],
                          body_.to[a], axes[a]));
      if (body_.divisions[a] < 1)
        fault(fmt::format("has {} divisions along {}: at least 1 is expected", body_.divisions[a], axes[a]));
    }
  }

  void check_cells() {
    const auto allowed = cell_names(body_.dimension);
    const std::string name(cell::topology(body_.cells).name);
    if (std::ranges::find(allowed, name) == allowed.end())
      fault(fmt::format("is to be made of {}: a {} takes {}", name,
                        body_.dimension == 2 ? "rectangle" : "box", fmt::join(allowed, ", ")));
  }

  void check_places(const char* what, const std::map<std::string, std::string>& places, int sides) {
    for (const auto& [key, group] : places) {
      if (grid_place(key, body_.dimension, sides))
        continue;
      const auto names = grid_place_names(body_.dimension, sides);
      const auto nearest = nearest_word(key, names);
      fault(fmt::format("has no {} '{}': {}", what, key,
                        nearest.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                                        : fmt::format("did you mean '{}'?", nearest)),
            fmt::format("{}s.{}", what, key));
    }
  }

  const study::Body& body_;
  std::size_t index_;
  std::vector<Fault>& faults_;
};

/// An upper bound: the densest cells have nodes at half a division, and triangles one more inside each.
double most_nodes(std::span<const study::Body> bodies, int refine) {
  double sum = 0;
  for (const auto& body : bodies) {
    double nodes = 1;
    for (std::size_t a = 0; a < static_cast<std::size_t>(body.dimension); ++a)
      nodes *= 2. * body.divisions[a] * refine + 2;
    sum += nodes;
  }
  return sum;
}

void refuse_bad_input(std::span<const study::Body> bodies, int refine) {
  if (bodies.empty())
    throw InputError("there is no body to mesh: at least one is expected");
  if (refine < 1)
    throw InputError(fmt::format("refine is {}: a whole number from 1 on is expected", refine));
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& body = bodies[i];
    BodyCheck(body, i, faults).run();
    if (body.dimension != bodies.front().dimension)
      faults.push_back(
          fault_at(fmt::format("mesh.generate.{}", i),
                   fmt::format("body '{}' has dimension {} but '{}' has {}: all bodies of a mesh "
                               "have the same",
                               body.name, body.dimension, bodies.front().name, bodies.front().dimension)));
  }
  if (!faults.empty())
    throw InputError(std::move(faults));
  constexpr double limit = std::numeric_limits<NodeIndex>::max();
  if (const auto nodes = most_nodes(bodies, refine); nodes > limit)
    throw InputError(
        fmt::format("the mesh would have up to {:.1e} nodes: {:.1e} are possible", nodes, limit));
}

} // namespace

Mesh generate(std::span<const study::Body> bodies, int refine) {
  refuse_bad_input(bodies, refine);
  MeshBuilder builder(bodies.front().dimension);
  for (const auto& body : bodies)
    builder.append(body_mesh(body, refine));
  return std::move(builder).build();
}

} // namespace rubato::mesh
