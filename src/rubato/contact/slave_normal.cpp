// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/slave_normal.hpp"

#include "rubato/contact/pairing.hpp"
#include "rubato/contact/projection.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <array>
#include <cstddef>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// v / |v|, and its variation as v varies.
struct Unit {
  double inverse_length;
  Vector3d direction;

  explicit Unit(const Vector3d& v) : inverse_length(1 / length_of(v)), direction(scaled(inverse_length, v)) {}
  Vector3d variation(const Vector3d& dv) const { return scaled(inverse_length, part_across(direction, dv)); }
};

/// A slave face at a reference point.
struct PlaceOnFace {
  const Face& face;
  FaceShape shape;
  FaceGeometry at;

  PlaceOnFace(const Zone& zone, const PointOnFace& on, const Configuration& configuration)
      : face(zone.slave.faces[static_cast<std::size_t>(on.face)]), shape(face_shape(face.type, on.xi)),
        at(face_geometry(face.type, deformed(face, configuration), shape)) {}

  Vector3d tangent(int a) const { return column_of(at.tangents, a); }
  Vector3d area_vector() const { return cross(tangent(0), tangent(1)); }
};

Index local_node(const SlavePoint& point, mesh::NodeIndex node) {
  Index i = 0;
  while (point.nodes[static_cast<std::size_t>(i)] != node)
    ++i;
  return i;
}

/// Adds the variation of the unit normal of one face.
void add_variation(const PlaceOnFace& place, const Unit& unit, const SlavePoint& point, int components,
                   Eigen::Matrix<double, 3, Eigen::Dynamic>& into) {
  const int dimension = components - 1;
  for (int c = 0; c < components; ++c) {
    const Vector3d along(c == 0, c == 1, c == 2);
    const std::array<Vector3d, 2> by_tangent{unit.variation(cross(along, place.tangent(1))),
                                             unit.variation(cross(place.tangent(0), along))};
    for (int i = 0; i < place.face.node_count; ++i) {
      const auto node = local_node(point, place.face.nodes[static_cast<std::size_t>(i)]);
      for (int a = 0; a < dimension; ++a)
        for (int k = 0; k < 3; ++k)
          into(k, components * node + c) +=
              place.shape.gradients[static_cast<std::size_t>(i * dimension + a)] *
              by_tangent[static_cast<std::size_t>(a)][k];
    }
  }
}

} // namespace

Vector3d slave_normal(const Zone& zone, const SlavePoint& point, const Configuration& configuration) {
  Vector3d sum(0, 0, 0);
  for (const auto& on : point.stands_on)
    add_scaled(1, unit_of(PlaceOnFace(zone, on, configuration).area_vector()), sum);
  return unit_of(sum);
}

void vary_slave_normal(const Zone& zone, const SlavePoint& point, const Configuration& configuration,
                       Eigen::Matrix<double, 3, Eigen::Dynamic>& into) {
  const int components = configuration.dofs->components;
  Vector3d sum(0, 0, 0);
  into.setZero(3, static_cast<Index>(point.nodes.size()) * components);
  for (const auto& on : point.stands_on) {
    const PlaceOnFace place(zone, on, configuration);
    const Unit unit(place.area_vector());
    add_scaled(1, unit.direction, sum);
    add_variation(place, unit, point, components, into);
  }
  const Unit slave(sum);
  for (Index column = 0; column < into.cols(); ++column) {
    const Vector3d turned = slave.variation(column_of(into, column));
    for (int k = 0; k < 3; ++k)
      into(k, column) = turned[k];
  }
}

} // namespace rubato::contact
