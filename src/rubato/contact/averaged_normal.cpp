// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/averaged_normal.hpp"

#include "rubato/cell/reference_nodes.hpp"
#include "rubato/contact/face_normal.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cstddef>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

const Face& face_at(const Surface& surface, int face) {
  return surface.faces[static_cast<std::size_t>(face)];
}

/// Calls `visit` with each face of the same smooth part around a node of a face.
template <class Visit> void visit_around(const Surface& surface, int face, int node, const Visit& visit) {
  const auto position = face_at(surface, face).positions[static_cast<std::size_t>(node)];
  const auto part = surface.smooth_part[static_cast<std::size_t>(face)];
  for (const int other : surface.faces_of_node[static_cast<std::size_t>(position)])
    if (surface.smooth_part[static_cast<std::size_t>(other)] == part)
      visit(face_at(surface, other));
}

FaceNormal normal_at(const Face& face, mesh::NodeIndex node, const Configuration& configuration) {
  const auto nodes = face.node_span();
  const auto local = static_cast<int>(std::ranges::find(nodes, node) - nodes.begin());
  const auto& xi = cell::reference_node(face.type, local);
  return {face, {xi[0], xi[1]}, configuration};
}

/// The sum of the unit normals of the faces around a node of a face.
Vector3d sum_at(const Surface& surface, int face, int node, const Configuration& configuration) {
  Vector3d sum(0, 0, 0);
  const auto of_mesh = face_at(surface, face).nodes[static_cast<std::size_t>(node)];
  visit_around(surface, face, node, [&](const Face& other) {
    add_scaled(1, normal_at(other, of_mesh, configuration).direction(), sum);
  });
  return sum;
}

} // namespace

Vector3d averaged_normal(const Surface& surface, int face, std::span<const double> weights,
                         const Configuration& configuration) {
  Vector3d sum(0, 0, 0);
  for (int node = 0; node < face_at(surface, face).node_count; ++node)
    if (const double weight = weights[static_cast<std::size_t>(node)]; weight != 0)
      add_scaled(weight, unit_of(sum_at(surface, face, node, configuration)), sum);
  return sum;
}

void vary_averaged_normal(const Surface& surface, int face, std::span<const double> weights, double factor,
                          const Configuration& configuration, std::span<const mesh::NodeIndex> nodes,
                          Eigen::Ref<Eigen::Matrix<double, 3, Eigen::Dynamic>> into) {
  const int components = configuration.dofs->components;
  const auto& own = face_at(surface, face);
  for (int node = 0; node < own.node_count; ++node) {
    const double weight = factor * weights[static_cast<std::size_t>(node)];
    if (weight == 0)
      continue;
    const UnitVector average(sum_at(surface, face, node, configuration));
    visit_around(surface, face, node, [&](const Face& other) {
      const auto normal = normal_at(other, own.nodes[static_cast<std::size_t>(node)], configuration);
      for (int i = 0; i < other.node_count; ++i) {
        const auto at = std::ranges::find(nodes, other.nodes[static_cast<std::size_t>(i)]) - nodes.begin();
        const auto turned = normal.by_node(i);
        for (int c = 0; c < components; ++c) {
          const Vector3d variation = average.variation(column_of(turned, c));
          for (int k = 0; k < 3; ++k)
            into(k, at * components + c) += weight * variation[k];
        }
      }
    });
  }
}

void append_ring(const Surface& surface, int face, std::size_t from, std::vector<mesh::NodeIndex>& nodes) {
  for (int node = 0; node < face_at(surface, face).node_count; ++node)
    visit_around(surface, face, node, [&](const Face& other) {
      for (const auto one : other.node_span())
        if (std::find(nodes.begin() + static_cast<std::ptrdiff_t>(from), nodes.end(), one) == nodes.end())
          nodes.push_back(one);
    });
}

} // namespace rubato::contact
