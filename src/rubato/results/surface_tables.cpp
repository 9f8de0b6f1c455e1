// SPDX-License-Identifier: LGPL-3.0-or-later
// Tables of faces and of contact.
#include "rubato/cell/quadrature.hpp"
#include "rubato/contact/dropped_nodes.hpp"
#include "rubato/contact/pairing.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/element/section.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/surface_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rubato::results {
namespace {

using Eigen::Vector3d;

constexpr std::size_t statistics_indent = 2;

void put_vectors(TableText& text, const Vector3d& a, const Vector3d& b) {
  const std::array values{a.x(), a.y(), a.z(), b.x(), b.y(), b.z()};
  text.indented(statistics_indent, values);
}

/// One face with the order of its nodes.
struct FaceNodes {
  CellType type;
  std::vector<mesh::NodeIndex> nodes;
};

/// Faces between two cells keep the order of the file, in which the normal points out of the cell that the
/// surface names.
std::vector<FaceNodes> faces_of(const mesh::Mesh& mesh, const mesh::Group& group) {
  std::vector<FaceNodes> faces;
  const auto oriented = mesh::oriented_faces(mesh, group.items);
  for (const auto& face : oriented.faces)
    faces.push_back({face.type, {face.nodes().begin(), face.nodes().end()}});
  for (const auto cell : oriented.inside) {
    const auto nodes = mesh.nodes_of(cell);
    faces.push_back({mesh.type_of(cell), {nodes.begin(), nodes.end()}});
  }
  return faces;
}

Eigen::Matrix3d as_matrix(const Eigen::Matrix<double, 6, 1>& s) {
  Eigen::Matrix3d matrix;
  matrix << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return matrix;
}

/// Stresses at the nodes, averaged over all cells, interpolated on the face: as CalculiX integrates them.
void add_face(const model::Model& model, const FaceNodes& face, std::span<const double> stresses,
              SurfaceStatistics& sums) {
  constexpr int points = 3;
  const auto count = static_cast<int>(face.nodes.size());
  contact::FaceCoordinates places(3, count);
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress(6, count);
  for (int i = 0; i < count; ++i) {
    const auto node = static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)]);
    places.col(i) = model.mesh.points[node];
    stress.col(i) = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(stresses.data() + 6 * node);
  }
  for (const auto& point : cell::gauss_rule(face.type, points)) {
    const Eigen::Vector2d xi = point.xi.head<2>();
    const auto shape = contact::face_values(face.type, xi);
    const auto geometry = contact::face_geometry(face.type, places, xi);
    Eigen::Matrix<double, 6, 1> here = Eigen::Matrix<double, 6, 1>::Zero();
    for (int i = 0; i < count; ++i)
      here += shape.at(static_cast<std::size_t>(i)) * stress.col(i);
    const Vector3d normal_area = point.weight * element::measure(model.bulk.section, geometry.position.x()) *
                                 geometry.tangents.col(0).cross(geometry.tangents.col(1));
    sums.add(geometry.position, normal_area, as_matrix(here) * normal_area);
  }
}

bool stands_on_node(const contact::SlavePoint& point) {
  return point.node_position >= 0;
}

/// Ties are listed by their name alone.
bool is_listed(const study::PrintedTable& table, const contact::Zone& zone) {
  return table.on.empty() ? !zone.settings.tie : zone.settings.name == table.on;
}

struct ListedPoint {
  std::size_t zone;
  std::size_t point;
};

/// Closed points of the zones of the table, of each zone ascending by the number of their node.
std::vector<ListedPoint> points_of(const TableSource& source) {
  std::vector<ListedPoint> points;
  for (std::size_t z = 0; z < source.model.zones.size(); ++z) {
    const auto& zone = source.model.zones[z];
    if (!is_listed(source.table, zone))
      continue;
    for (std::size_t i = 0; i < zone.points.size(); ++i)
      if (contact::reported_status(source.now.zones[z], i) != contact::Status::open)
        points.push_back({z, i});
  }
  std::ranges::stable_sort(points, {}, [&](const ListedPoint& listed) {
    const auto& point = source.model.zones[listed.zone].points[listed.point];
    return std::pair(listed.zone, stands_on_node(point)
                                      ? source.numbers.nodes[static_cast<std::size_t>(point.nodes.front())]
                                      : 0);
  });
  return points;
}

/// The line has the number of a point's node. A point on a face has the number of the face's cell and side 1
/// instead, as a face has a cell of its own.
void put_point(const TableSource& source, const ListedPoint& listed, std::span<const double> values,
               TableText& text) {
  const auto& zone = source.model.zones[listed.zone];
  const auto& point = zone.points[listed.point];
  if (stands_on_node(point))
    return text.line(source.numbers.nodes[static_cast<std::size_t>(point.nodes.front())], values);
  constexpr int width = 11;
  const auto face = static_cast<std::size_t>(point.stands_on.front().face);
  text.line(source.numbers.cells[static_cast<std::size_t>(zone.slave.faces[face].cell)], 1, width, values);
}

void put_points(const TableSource& source, std::span<const ListedPoint> points, bool stresses,
                ContactLister& lister, TableText& text) {
  const bool on_nodes = std::ranges::all_of(points, [&](const ListedPoint& listed) {
    return stands_on_node(source.model.zones[listed.zone].points[listed.point]);
  });
  const auto* const place = on_nodes ? "slave node" : "slave element+face";
  text.plain_heading(
      stresses ? fmt::format("contact stress ({},press,tang1,tang2) for all contact elements and time", place)
               : fmt::format("relative contact displacement ({},normal,tang1,tang2) for all contact elements "
                             "and time",
                             place));
  for (const auto& listed : points) {
    const auto at = lister.at(source.now, listed.zone, listed.point);
    const std::array values{stresses ? at.pressure : at.opening, stresses ? at.shear[0] : at.slip[0],
                            stresses ? at.shear[1] : at.slip[1]};
    put_point(source, listed, values, text);
  }
}

/// Forces of the master on the slave: all, along the normals, along the surfaces.
void put_force(const TableSource& source, std::size_t z, std::string_view word, TableText& text) {
  const auto& zone = source.model.zones[z];
  const auto& state = source.now.zones[z];
  const auto& u = source.now.motion.u;
  const contact::Configuration now{&source.model.mesh, &source.model.dofs, &u, &u,
                                   source.now.t,       source.now.t};
  SurfaceStatistics sums;
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const auto& outcome = state.outcomes[i];
    if (contact::reported_status(state, i) == contact::Status::open)
      continue;
    const double size = outcome.normal.norm();
    const Vector3d outward =
        size > 0 ? Vector3d((outcome.pressure < 0 ? 1 : -1) * outcome.area / size * outcome.normal)
                 : Vector3d(Vector3d::Zero());
    const Vector3d force = word == "CFN"   ? outcome.normal
                           : word == "CFS" ? outcome.tangential
                                           : Vector3d(outcome.normal + outcome.tangential);
    sums.add(contact::position(zone.points[i], now), outward, force);
  }
  const auto master = zone.settings.obstacle ? std::string("obstacle") : zone.settings.master;
  text.words(fmt::format("\n\n statistics for slave set {}, master set {} and time {:>14}\n\n"
                         "   total surface force (fx,fy,fz) and moment about the origin (mx,my,mz)\n\n",
                         zone.settings.slave, master, text.time()));
  sums.put(text, false);
}

} // namespace

void SurfaceStatistics::put(TableText& text, bool torque) const {
  const Vector3d centre = area_ > 0 ? Vector3d(first_moment_ / area_) : Vector3d::Zero();
  const Vector3d normal = normal_.norm() > 0 ? Vector3d(normal_.normalized()) : Vector3d::Zero();
  const Vector3d moment = moment_ - centre.cross(force_);
  const double along = force_.dot(normal);
  const double twist = moment.dot(normal);
  put_vectors(text, force_, moment_);
  text.words("\n   center of gravity and mean normal\n\n");
  put_vectors(text, centre, normal);
  text.words("\n   moment about the center of gravity(mx,my,mz)\n\n");
  text.indented(statistics_indent, {moment.data(), 3});
  text.words(torque ? "\n   area, normal force (+ = tension), shear force (size), torque and bending moment "
                      "(size)\n\n"
                    : "\n   area,  normal force (+ = tension) and shear force (size)\n\n");
  const std::array values{area_, along, (force_ - along * normal).norm(), twist,
                          (moment - twist * normal).norm()};
  text.indented(statistics_indent, std::span(values).first(torque ? 5 : 3));
}

void add_face_tables(const TableSource& source, TableText& text) {
  const auto* group = source.model.mesh.cell_group(source.table.on);
  if (group == nullptr)
    return;
  const auto fields = stress_fields(source.model, source.now);
  SurfaceStatistics sums;
  for (const auto& face : faces_of(source.model.mesh, *group))
    add_face(source.model, face, fields.front().values, sums);
  text.words(fmt::format("\n\n statistics for surface set {} and time {:>14}\n\n"
                         "   total surface force (fx,fy,fz) and moment about the origin(mx,my,mz)\n\n",
                         label_of(source.table), text.time()));
  sums.put(text, true);
}

void add_contact_tables(const TableSource& source, ContactLister& lister, TableText& text) {
  const auto points = points_of(source);
  if (lists(source.table, "CDIS"))
    put_points(source, points, false, lister, text);
  if (lists(source.table, "CSTR"))
    put_points(source, points, true, lister, text);
  if (lists(source.table, "CNUM")) {
    text.plain_heading("total number of contact elements for time ");
    text.words(fmt::format("{:17}\n", points.size()));
  }
  for (const std::string_view word : {"CF", "CFN", "CFS"})
    for (std::size_t z = 0; lists(source.table, word) && z < source.model.zones.size(); ++z)
      if (is_listed(source.table, source.model.zones[z]))
        put_force(source, z, word, text);
}

} // namespace rubato::results
