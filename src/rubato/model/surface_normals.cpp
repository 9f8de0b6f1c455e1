// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/surface_normals.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace rubato::model {
namespace {

using Eigen::Vector3d;

/// The face's corners and how far it is from each to its neighbours round the face. In 2D the second
/// neighbour is a unit away along z.
struct Corners {
  Corners(const mesh::Mesh& mesh, const contact::Face& face)
      : count(cell::topology(face.type).corner_count), mesh_(mesh), face_(face) {}

  Vector3d next(int corner) const {
    return count == 2 ? contact::difference_of(place(1), place(0))
                      : contact::difference_of(place((corner + 1) % count), place(corner));
  }
  Vector3d last(int corner) const {
    return count == 2 ? Vector3d(0, 0, 1)
                      : contact::difference_of(place((corner + count - 1) % count), place(corner));
  }

  int count;

private:
  Vector3d place(int corner) const {
    return mesh_.points[static_cast<std::size_t>(face_.nodes[static_cast<std::size_t>(corner)])];
  }

  const mesh::Mesh& mesh_;
  const contact::Face& face_;
};

/// What a corner has of its face: half a segment, a third of a triangle, half the triangle it has with its
/// neighbours in a quadrangle.
double area_of(const Corners& corners, const Vector3d& product) {
  const double length = contact::length_of(product);
  return corners.count == 3 ? length / 6 : length / (corners.count == 2 ? 2 : 4);
}

} // namespace

std::vector<FaceCorner> face_corners(const mesh::Mesh& mesh, const contact::Surface& surface) {
  std::vector<FaceCorner> list;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Corners corners(mesh, surface.faces[f]);
    for (int i = 0; i < corners.count; ++i) {
      const Vector3d next = corners.next(i);
      const Vector3d last = corners.last(i);
      const Vector3d product = contact::cross(next, last);
      list.push_back({static_cast<int>(f), surface.faces[f].positions[static_cast<std::size_t>(i)],
                      area_of(corners, product), contact::unit_of(product),
                      contact::length_of(product) / (contact::dot(next, next) * contact::dot(last, last))});
    }
  }
  return list;
}

std::vector<Vector3d> averaged_normals(const contact::Surface& surface, std::span<const FaceCorner> corners) {
  std::vector<Vector3d> averages(surface.nodes.size(), Vector3d(0, 0, 0));
  for (const auto& corner : corners)
    contact::add_scaled(corner.weight, corner.normal, averages[static_cast<std::size_t>(corner.position)]);
  for (auto& average : averages)
    average = contact::unit_of(average);
  return averages;
}

namespace {

std::vector<int> ends_of_lines(const contact::Surface& surface) {
  std::vector<int> ends;
  for (const auto& face : surface.faces)
    for (const int end : {face.positions[0], face.positions[1]})
      if (surface.faces_of_node[static_cast<std::size_t>(end)].size() == 1)
        ends.push_back(end);
  return ends;
}

/// Of edges that one face only has.
std::vector<int> ends_of_open_edges(const contact::Surface& surface) {
  std::map<std::pair<int, int>, int> faces_of_edge;
  for (const auto& face : surface.faces)
    for (const auto& [from, to] : cell::topology(face.type).edges)
      ++faces_of_edge[std::minmax(face.positions[from], face.positions[to])];
  std::vector<int> ends;
  for (const auto& [edge, faces] : faces_of_edge)
    if (faces == 1) {
      ends.push_back(edge.first);
      ends.push_back(edge.second);
    }
  return ends;
}

} // namespace

std::vector<char> rim_of(const contact::Surface& surface) {
  const bool lines = contact::parametric_dimension(surface.faces.front().type) == 1;
  std::vector<char> rim(surface.nodes.size(), 0);
  for (const int position : lines ? ends_of_lines(surface) : ends_of_open_edges(surface))
    rim[static_cast<std::size_t>(position)] = 1;
  return rim;
}

} // namespace rubato::model
