// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/slave_normal.hpp"

#include "rubato/contact/averaged_normal.hpp"
#include "rubato/contact/face_normal.hpp"
#include "rubato/contact/projection.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <cstddef>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

const Face& slave_face(const Zone& zone, const PointOnFace& on) {
  return zone.slave.faces[static_cast<std::size_t>(on.face)];
}

Index local_node(const SlavePoint& point, mesh::NodeIndex node) {
  Index i = 0;
  while (point.nodes[static_cast<std::size_t>(i)] != node)
    ++i;
  return i;
}

/// Adds the variation of the unit normal of one face.
void add_variation(const FaceNormal& normal, const SlavePoint& point, int components,
                   Eigen::Matrix<double, 3, Eigen::Dynamic>& into) {
  for (int i = 0; i < normal.face().node_count; ++i) {
    const auto node = local_node(point, normal.face().nodes[static_cast<std::size_t>(i)]);
    const auto turned = normal.by_node(i);
    for (int c = 0; c < components; ++c)
      for (int k = 0; k < 3; ++k)
        into(k, components * node + c) += turned(k, c);
  }
}

/// The vector whose unit is the normal.
Vector3d sum_of_normals(const Zone& zone, const SlavePoint& point, const Configuration& configuration) {
  Vector3d sum(0, 0, 0);
  for (const auto& on : point.stands_on)
    if (zone.settings.smoothing)
      add_scaled(
          1,
          averaged_normal(zone.slave, on.face, face_values(slave_face(zone, on).type, on.xi), configuration),
          sum);
    else
      add_scaled(1, FaceNormal(slave_face(zone, on), on.xi, configuration).direction(), sum);
  return sum;
}

} // namespace

Vector3d slave_normal(const Zone& zone, const SlavePoint& point, const Configuration& configuration) {
  return unit_of(sum_of_normals(zone, point, configuration));
}

void vary_slave_normal(const Zone& zone, const SlavePoint& point, const Configuration& configuration,
                       Eigen::Matrix<double, 3, Eigen::Dynamic>& into) {
  const int components = configuration.dofs->components;
  const auto columns = static_cast<Index>(point.nodes.size()) * components;
  into.leftCols(columns).setZero();
  for (const auto& on : point.stands_on)
    if (zone.settings.smoothing)
      vary_averaged_normal(zone.slave, on.face, face_values(slave_face(zone, on).type, on.xi), 1,
                           configuration, point.nodes, into.leftCols(columns));
    else
      add_variation(FaceNormal(slave_face(zone, on), on.xi, configuration), point, components, into);
  const UnitVector slave(sum_of_normals(zone, point, configuration));
  for (Index column = 0; column < columns; ++column)
    set_column(column, slave.variation(column_of(into, column)), into);
}

} // namespace rubato::contact
