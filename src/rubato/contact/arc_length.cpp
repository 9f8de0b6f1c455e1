// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/arc_length.hpp"

#include "rubato/cell/quadrature.hpp"
#include "rubato/cell/reference_cell.hpp"

#include <cstddef>
#include <map>
#include <stdexcept>

namespace rubato::contact {
namespace {

/// Exact for straight faces; of a quarter of a circle by one parabola the error is below 1e-9 of its length.
constexpr int degree = 15;

/// ∫|X,ξ| dξ from the face's first node, ξ = −1, to ξ.
double length_until(const Face& face, const FaceCoordinates& nodes, double xi) {
  const double half = 0.5 * (xi + 1);
  double length = 0;
  for (const auto& point : cell::rule_of_degree(face.type, degree)) {
    const Eigen::Vector2d at(half * (point.xi[0] + 1) - 1, 0);
    length += point.weight * half * face_geometry(face.type, nodes, at).tangents.col(0).norm();
  }
  return length;
}

/// The lines that faces make where the end of one is the start of the next.
class Lines {
public:
  explicit Lines(const std::vector<Face>& faces) : faces_(faces), taken_(faces.size(), false) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      from_.emplace(faces[f].nodes[0], f);
      to_.emplace(faces[f].nodes[1], f);
    }
  }

  /// Faces one behind the other.
  std::vector<std::size_t> order() {
    std::vector<std::size_t> order;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (!taken_[f])
        follow(first_of_line(f), order);
    return order;
  }

private:
  std::size_t first_of_line(std::size_t face) const {
    auto first = face;
    for (auto before = to_.find(faces_[first].nodes[0]); before != to_.end();
         before = to_.find(faces_[first].nodes[0])) {
      first = before->second;
      if (first == face)
        break; // the line is closed
    }
    return first;
  }

  void follow(std::size_t face, std::vector<std::size_t>& order) {
    while (!taken_[face]) {
      taken_[face] = true;
      order.push_back(face);
      if (const auto next = from_.find(faces_[face].nodes[1]); next != from_.end())
        face = next->second;
    }
  }

  const std::vector<Face>& faces_;
  std::vector<bool> taken_;
  std::map<mesh::NodeIndex, std::size_t> from_, to_; ///< the face that begins or ends at a node
};

} // namespace

std::vector<double> arc_lengths(const mesh::Mesh& mesh, const Zone& zone) {
  if (zone.space_dimension != 2)
    throw std::invalid_argument("arc lengths along a surface in space");
  const auto& faces = zone.slave.faces;
  const auto places = undeformed_places(mesh, zone.slave);
  std::vector<double> start(faces.size(), 0.0);
  std::map<mesh::NodeIndex, double> at_node; // where a line meets its own start, the start
  double sum = 0;
  for (const auto f : Lines(faces).order()) {
    const auto& face = faces[f];
    const auto nodes = values_of(face, places);
    start[f] = sum;
    for (const std::size_t i : {0, 2, 1})
      if (i < static_cast<std::size_t>(face.node_count))
        at_node.emplace(face.nodes[i],
                        sum + length_until(face, nodes, cell::reference_cell(face.type).nodes[i][0]));
    sum += length_until(face, nodes, 1);
  }
  std::vector<double> lengths;
  lengths.reserve(zone.points.size());
  for (const auto& point : zone.points) {
    if (point.node_position >= 0) {
      lengths.push_back(at_node.at(point.nodes.front()));
      continue;
    }
    const auto& on = point.stands_on.front();
    const auto& face = faces[static_cast<std::size_t>(on.face)];
    lengths.push_back(start[static_cast<std::size_t>(on.face)] +
                      length_until(face, values_of(face, places), on.xi[0]));
  }
  return lengths;
}

} // namespace rubato::contact
