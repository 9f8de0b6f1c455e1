// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/mortar_edges.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/projection.hpp"
#include "rubato/mesh/names.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>

namespace rubato::model {
namespace {

using Eigen::Vector3d;
using mesh::NodeIndex;

/// [degrees] Facets of a round body that is meshed with fewer faces have errors of that size anyway.
constexpr double noted = 15;

struct Edge {
  double angle = 0; ///< between the normals of its faces [degrees]
  NodeIndex node = 0;
};

/// Out of the body, at a node of the face; 0 where the face has none there.
Vector3d normal_at(const mesh::Mesh& mesh, const contact::Face& face, std::size_t local) {
  contact::FaceCoordinates nodes(3, face.node_count);
  for (int i = 0; i < face.node_count; ++i)
    nodes.col(i) = mesh.points[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)])];
  const Eigen::Vector2d xi = cell::reference_cell(face.type).nodes[local].head<2>();
  const auto tangents = contact::face_geometry(face.type, nodes, xi).tangents;
  const Vector3d first = tangents.col(0);
  const Vector3d second =
      contact::parametric_dimension(face.type) == 1 ? Vector3d::UnitZ().eval() : Vector3d(tangents.col(1));
  return first.cross(second).normalized();
}

bool shares_another_node(const contact::Face& one, const contact::Face& other, NodeIndex node) {
  return std::ranges::any_of(one.node_span(), [&](NodeIndex at) {
    return at != node && std::ranges::find(other.node_span(), at) != other.node_span().end();
  });
}

struct FaceAtNode {
  const contact::Face* face;
  Vector3d normal;
};

/// The sharpest edge of a surface, by the normals that faces have at the nodes that they share.
std::optional<Edge> sharpest_edge(const mesh::Mesh& mesh, const contact::Surface& surface) {
  std::map<NodeIndex, std::vector<FaceAtNode>> around;
  for (const auto& face : surface.faces)
    for (std::size_t i = 0; i < face.node_span().size(); ++i)
      around[face.nodes[i]].push_back({&face, normal_at(mesh, face, i)});
  std::optional<Edge> sharpest;
  for (const auto& [node, faces] : around)
    for (std::size_t a = 0; a < faces.size(); ++a)
      for (std::size_t b = a + 1; b < faces.size(); ++b) {
        const bool plane = contact::parametric_dimension(faces[a].face->type) == 1;
        if (!plane && !shares_another_node(*faces[a].face, *faces[b].face, node))
          continue;
        const double cosine = std::clamp(faces[a].normal.dot(faces[b].normal), -1., 1.);
        const double angle = std::acos(cosine) * 180 / std::numbers::pi;
        if (angle > noted && (!sharpest || angle > sharpest->angle))
          sharpest = Edge{angle, node};
      }
  return sharpest;
}

} // namespace

std::vector<std::string> edges_in_mortar_zones(std::span<const contact::Zone> zones, const mesh::Mesh& mesh) {
  std::vector<std::string> sentences;
  for (const auto& zone : zones) {
    if (!zone.mortar || zone.obstacle || zone.meets_itself() || zone.holds_geometry())
      continue;
    for (const auto* surface : {&zone.master, &zone.slave}) {
      const bool is_master = surface == &zone.master;
      const auto edge = sharpest_edge(mesh, *surface);
      if (!edge)
        continue;
      sentences.push_back(fmt::format(
          "contact zone {}: the {} '{}' has an edge of {:.0f}° at {}; where gaps open beside an edge, mortar "
          "contact feels an overlap of a part of a face: pressures and forces near it may be wrong by far "
          "more than elsewhere; expected surfaces without edges, one zone for each smooth part, or "
          "'integration: nodes'",
          zone.settings.name, is_master ? "master" : "slave",
          is_master ? zone.settings.master : zone.settings.slave, edge->angle,
          mesh::node_name(mesh, edge->node)));
      break;
    }
  }
  return sentences;
}

} // namespace rubato::model
