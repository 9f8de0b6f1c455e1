// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/view_mesh.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/core/disjoint_sets.hpp"
#include "rubato/mesh/skin.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace rubato::report {
namespace {

using mesh::NodeIndex;
using Local = std::uint8_t;

constexpr std::array<Local, 3> tria3{0, 1, 2};
constexpr std::array<Local, 12> tria6{0, 3, 5, 3, 1, 4, 5, 4, 2, 3, 4, 5};
constexpr std::array<Local, 18> tria7{0, 3, 6, 3, 1, 6, 1, 4, 6, 4, 2, 6, 2, 5, 6, 5, 0, 6};
constexpr std::array<Local, 6> quad4{0, 1, 2, 0, 2, 3};
constexpr std::array<Local, 18> quad8{0, 4, 7, 4, 1, 5, 5, 2, 6, 6, 3, 7, 4, 5, 6, 4, 6, 7};
constexpr std::array<Local, 24> quad9{0, 4, 8, 4, 1, 8, 1, 5, 8, 5, 2, 8, 2, 6, 8, 6, 3, 8, 3, 7, 8, 7, 0, 8};

/// The triangles of a face, by its local nodes (topology.hpp).
std::span<const Local> triangles_of(CellType type) {
  switch (type) {
  case CellType::tria3:
    return tria3;
  case CellType::tria6:
    return tria6;
  case CellType::tria7:
    return tria7;
  case CellType::quad4:
    return quad4;
  case CellType::quad8:
    return quad8;
  case CellType::quad9:
    return quad9;
  default:
    return {};
  }
}

/// Ascending, each once.
template <class T> void make_unique(std::vector<T>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

using Edges = std::vector<std::pair<NodeIndex, NodeIndex>>;

/// Triangles and edges by nodes of the mesh.
struct Faces {
  std::vector<NodeIndex> corners;
  Edges edges;
  std::size_t count = 0;

  void add_edge(NodeIndex a, NodeIndex b) { edges.emplace_back(std::min(a, b), std::max(a, b)); }

  void add(CellType type, std::span<const NodeIndex> nodes) {
    ++count;
    for (const auto local : triangles_of(type))
      corners.push_back(nodes[local]);
    const auto& shape = cell::topology(type);
    for (std::size_t i = 0; i < shape.edges.size(); ++i) {
      const auto a = nodes[shape.edges[i][0]];
      const auto b = nodes[shape.edges[i][1]];
      if (shape.order == 1) {
        add_edge(a, b);
        continue;
      }
      const auto middle = nodes[static_cast<std::size_t>(cell::mid_node(shape, i))];
      add_edge(a, middle);
      add_edge(middle, b);
    }
  }
};

Faces faces_of(const mesh::Mesh& mesh) {
  Faces faces;
  if (mesh.dimension == 2)
    mesh::for_each_cell(mesh, [&](auto, const auto& shape, auto nodes) {
      if (shape.dimension == 2)
        faces.add(shape.type, nodes);
    });
  else
    for (const auto& face : mesh::skin(mesh))
      faces.add(face.type, face.nodes());
  make_unique(faces.edges);
  return faces;
}

/// Of each node of the mesh the lowest node of its body.
std::vector<std::size_t> bodies_of(const mesh::Mesh& mesh) {
  DisjointSets sets(mesh.points.size());
  mesh::for_each_cell(mesh, [&](auto, const auto& shape, auto nodes) {
    for (const auto node : nodes)
      if (shape.dimension == mesh.dimension)
        sets.join(static_cast<std::size_t>(nodes[0]), static_cast<std::size_t>(node));
  });
  std::vector<std::size_t> roots(mesh.points.size());
  for (std::size_t node = 0; node < roots.size(); ++node)
    roots[node] = sets.root(node);
  return roots;
}

void number_bodies(const mesh::Mesh& mesh, ViewMesh& view) {
  const auto roots = bodies_of(mesh);
  std::vector<std::size_t> found;
  found.reserve(view.nodes.size());
  for (const auto node : view.nodes)
    found.push_back(roots[static_cast<std::size_t>(node)]);
  auto distinct = found;
  make_unique(distinct);
  view.body_count = static_cast<int>(distinct.size());
  constexpr std::ptrdiff_t most = std::numeric_limits<std::uint16_t>::max();
  for (const auto root : found)
    view.bodies.push_back(static_cast<std::uint16_t>(
        std::min(most, std::ranges::lower_bound(distinct, root) - distinct.begin())));
}

} // namespace

ViewMesh view_mesh(const mesh::Mesh& mesh) {
  const auto faces = faces_of(mesh);
  ViewMesh view;
  view.dimension = mesh.dimension;
  view.face_count = faces.count;
  std::vector<std::uint32_t> place(mesh.points.size(), 0);
  for (const auto node : faces.corners)
    place[static_cast<std::size_t>(node)] = 1;
  for (std::size_t node = 0; node < place.size(); ++node)
    if (place[node] != 0) {
      place[node] = static_cast<std::uint32_t>(view.nodes.size());
      view.nodes.push_back(static_cast<NodeIndex>(node));
    }
  view.corners.reserve(faces.corners.size());
  for (const auto node : faces.corners)
    view.corners.push_back(place[static_cast<std::size_t>(node)]);
  for (const auto& [a, b] : faces.edges)
    view.ends.insert(view.ends.end(),
                     {place[static_cast<std::size_t>(a)], place[static_cast<std::size_t>(b)]});
  number_bodies(mesh, view);
  return view;
}

} // namespace rubato::report
