// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/surface.hpp"

#include "rubato/contact/kinks.hpp"

#include <algorithm>
#include <limits>

namespace rubato::contact {
namespace {

void collect_nodes(Surface& surface) {
  for (const auto& face : surface.faces)
    surface.nodes.insert(surface.nodes.end(), face.node_span().begin(), face.node_span().end());
  std::ranges::sort(surface.nodes);
  surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
}

void collect_neighbours(Surface& surface) {
  surface.faces_of_node.resize(surface.nodes.size());
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    auto& face = surface.faces[f];
    for (std::size_t i = 0; i < face.node_span().size(); ++i) {
      face.positions[i] = surface.position_of(face.nodes[i]);
      surface.faces_of_node[static_cast<std::size_t>(face.positions[i])].push_back(static_cast<int>(f));
    }
  }
}

void measure_edges(Surface& surface, const mesh::Mesh& mesh) {
  surface.shortest_edge = std::numeric_limits<double>::infinity();
  for (const auto& face : surface.faces)
    for (const auto& [from, to] : cell::topology(face.type).edges) {
      const auto& a = mesh.points[static_cast<std::size_t>(face.nodes[from])];
      const auto& b = mesh.points[static_cast<std::size_t>(face.nodes[to])];
      const double length = (b - a).norm();
      surface.shortest_edge = std::min(surface.shortest_edge, length);
      surface.longest_edge = std::max(surface.longest_edge, length);
    }
}

} // namespace

int Surface::position_of(mesh::NodeIndex node) const {
  const auto found = std::ranges::lower_bound(nodes, node);
  return found != nodes.end() && *found == node ? static_cast<int>(found - nodes.begin()) : -1;
}

Surface make_surface(const mesh::Mesh& mesh, std::vector<Face> faces) {
  Surface surface;
  surface.faces = std::move(faces);
  collect_nodes(surface);
  collect_neighbours(surface);
  measure_edges(surface, mesh);
  measure_kinks(undeformed_places(mesh, surface), surface);
  return surface;
}

std::vector<Eigen::Vector3d> undeformed_places(const mesh::Mesh& mesh, const Surface& surface) {
  std::vector<Eigen::Vector3d> places;
  for (const auto node : surface.nodes)
    places.push_back(mesh.points[static_cast<std::size_t>(node)]);
  return places;
}

int parametric_dimension(CellType type) {
  return cell::topology(type).dimension;
}

} // namespace rubato::contact
