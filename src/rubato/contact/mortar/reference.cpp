// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/parts.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector3d;

/// Degree that integrates H times a curved face's measure to the last digits that matter.
constexpr int full_weight_degree = 8;
/// Distance from the axis of revolution, in face sizes, that is rounding.
constexpr double on_axis = 1e-12;

double diameter(const FaceCoordinates& x) {
  double squared = 0;
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const Vector3d apart = difference_of(column_of(x, i), column_of(x, j));
      squared = std::max(squared, dot(apart, apart));
    }
  return std::sqrt(squared);
}

std::vector<double> nodal_kinks(const Surface& slave) {
  std::vector<double> kinks(slave.nodes.size(), 0);
  for (const auto& face : slave.faces)
    for (std::size_t i = 0; i < face.node_span().size(); ++i) {
      auto& kink = kinks[static_cast<std::size_t>(face.positions[i])];
      kink = std::max(kink, face.kinks[i]);
    }
  return kinks;
}

/// ∫H_i of an undeformed sub-facet.
Eigen::Vector4d full_areas(const Face& face, const SubFacet& facet, const FaceCoordinates& undeformed,
                           const Measure& measure) {
  Eigen::Vector4d areas(0, 0, 0, 0);
  for (const auto& [xi, weight] : facet_rule(facet, full_weight_degree)) {
    const Eigen::Vector2d at(xi[0], xi[1]);
    const double area = weight * undeformed_measure(face.type, undeformed, at, measure);
    const auto values = facet_values(facet, at);
    for (int i = 0; i < 4; ++i)
      areas[i] += area * values[i];
  }
  return areas;
}

} // namespace

SlaveReference make_slave_reference(const Surface& slave, std::vector<Vector3d> undeformed,
                                    const Measure& measure) {
  require_finite(slave, undeformed, "undeformed slave");
  SlaveReference reference;
  reference.undeformed = std::move(undeformed);
  reference.measure = measure;
  reference.full_weight.assign(slave.nodes.size(), 0);
  reference.tangent_neighbour = tangent_neighbours(slave);
  reference.kinks = nodal_kinks(slave);
  for (const auto& face : slave.faces) {
    const auto coordinates = values_of(face, reference.undeformed);
    reference.dimension = parametric_dimension(face.type) + 1;
    reference.longest_face = std::max(reference.longest_face, diameter(coordinates));
    reference.first_facet.push_back(reference.facet_area.size());
    for (const auto& facet : subfacets(face.type)) {
      const auto areas = full_areas(face, facet, coordinates, measure);
      reference.facet_area.push_back(total_of(areas));
      for (int i = 0; i < facet.node_count; ++i) {
        const auto node = facet.nodes[static_cast<std::size_t>(i)];
        reference.full_weight[static_cast<std::size_t>(face.positions[node])] += areas[i];
      }
    }
  }
  reference.first_facet.push_back(reference.facet_area.size());
  for (const auto& X : reference.undeformed)
    reference.on_axis.push_back(measure.ring && std::abs(X[0]) <= on_axis * reference.longest_face ? 1 : 0);
  return reference;
}

void require_finite(const Surface& surface, std::span<const Vector3d> x, const char* which) {
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    for (std::size_t i = 0; i < surface.faces[f].node_span().size(); ++i)
      if (!is_finite(x[static_cast<std::size_t>(surface.faces[f].positions[i])]))
        throw InputError(fmt::format("The position of node {} of face {} of the {} surface is not finite; "
                                     "contact needs finite coordinates.",
                                     i, f, which));
}

SlaveFace slave_face(const Face& face, const SlaveReference& reference, std::span<const Vector3d> x,
                     std::span<const Vector3d> normals) {
  return {face.type, values_of(face, x), values_of(face, reference.undeformed), values_of(face, normals)};
}

void set_normals(const Surface& slave, const SlaveReference& reference, std::span<const Vector3d> x,
                 const Options& options, std::vector<Vector3d>& normals) {
  nodal_normals(slave, x, options.held, normals);
  for (std::size_t j = 0; j < normals.size(); ++j)
    if (reference.on_axis[j] != 0)
      remove_held(radial, normals[j]);
}

Frame node_frame(const SlaveReference& reference, std::span<const Vector3d> x,
                 std::span<const Vector3d> normals, std::size_t node) {
  const auto neighbour = static_cast<std::size_t>(reference.tangent_neighbour[node]);
  return frame_of(normals[node], difference_of(x[neighbour], x[node]), reference.dimension);
}

double reach_of(const Options& options, const SlaveReference& reference) {
  return options.reach > 0 ? options.reach : reference.longest_face;
}

} // namespace rubato::contact::mortar
