// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/given_normal.hpp"

#include "rubato/contact/averaged_normal.hpp"
#include "rubato/contact/face_normal.hpp"
#include "rubato/contact/projection.hpp"
#include "rubato/contact/slave_normal.hpp"
#include "rubato/contact/small_vectors.hpp"

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using study::ContactNormal;

const Face& master_face(const Zone& zone, int face) {
  return zone.master.faces[static_cast<std::size_t>(face)];
}

Vector3d master_average(const Zone& zone, int face, const Eigen::Vector2d& xi,
                        const Configuration& configuration) {
  return averaged_normal(zone.master, face, face_values(master_face(zone, face).type, xi), configuration);
}

void add_master_average(const Zone& zone, int face, const Eigen::Vector2d& xi,
                        const Configuration& configuration, GivenNormal& given) {
  const auto& of_zone = master_face(zone, face);
  const bool with_slave = zone.settings.normal == ContactNormal::average;
  const UnitVector average(master_average(zone, face, xi, configuration));
  given.sum = with_slave ? average.direction : scaled(1 / average.inverse_length, average.direction);
  const auto shape = face_shape(of_zone.type, xi);
  const int dimension = parametric_dimension(of_zone.type);
  for (int a = 0; a < dimension; ++a) {
    std::array<double, 9> slopes{};
    for (std::size_t i = 0; i < of_zone.node_span().size(); ++i)
      slopes[i] = shape.gradient(static_cast<Index>(i), a, dimension);
    const auto by_place = averaged_normal(zone.master, face, slopes, configuration);
    given.by_place[static_cast<std::size_t>(a)] = with_slave ? average.variation(by_place) : by_place;
  }
}

void vary_master_average(const Zone& zone, int face, const Eigen::Vector2d& xi,
                         const Configuration& configuration, std::span<const mesh::NodeIndex> nodes,
                         Eigen::Ref<Eigen::Matrix<double, 3, Eigen::Dynamic>> into) {
  vary_averaged_normal(zone.master, face, face_values(master_face(zone, face).type, xi), -1, configuration,
                       nodes, into);
  if (zone.settings.normal != ContactNormal::average)
    return;
  const UnitVector average(master_average(zone, face, xi, configuration));
  for (Index column = 0; column < into.cols(); ++column)
    set_column(column, average.variation(column_of(into, column)), into);
}

} // namespace

bool gives_normal(const study::ContactZone& settings) {
  return settings.normal != ContactNormal::master || settings.smoothing;
}

bool averages_master(const study::ContactZone& settings) {
  return settings.normal != ContactNormal::slave && settings.smoothing;
}

GivenNormal given_normal(const Zone& zone, const SlavePoint& point, int face, const Eigen::Vector2d& xi,
                         const Configuration& configuration) {
  GivenNormal given;
  given.adds_face = zone.settings.normal == ContactNormal::average && !zone.settings.smoothing;
  if (averages_master(zone.settings))
    add_master_average(zone, face, xi, configuration, given);
  if (zone.settings.normal != ContactNormal::master)
    add_scaled(-1, slave_normal(zone, point, configuration), given.sum);
  return given;
}

void vary_given_normal(const Zone& zone, const SlavePoint& point, int face, const Eigen::Vector2d& xi,
                       const Configuration& configuration, std::span<const mesh::NodeIndex> nodes,
                       Eigen::Matrix<double, 3, Eigen::Dynamic>& into) {
  const int components = configuration.dofs->components;
  const auto of_slave = point.nodes.size();
  into.setZero(3, static_cast<Index>(nodes.size()) * components);
  if (zone.settings.normal != ContactNormal::master)
    vary_slave_normal(zone, point, configuration, into);
  if (averages_master(zone.settings))
    vary_master_average(zone, face, xi, configuration, nodes.subspan(of_slave),
                        into.rightCols(static_cast<Index>(nodes.size() - of_slave) * components));
}

} // namespace rubato::contact
