// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/facets.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/mesh/skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::plot {
namespace {

using Eigen::Vector3d;

/// Together; more are not seen in a picture and make large files.
constexpr double most_patches = 20'000;
constexpr int most_divisions = 8;
/// Of a curved side.
constexpr int side_parts = 4;

struct Face {
  CellType type = CellType::point1;
  std::vector<mesh::NodeIndex> nodes;
};

std::vector<Face> faces_of(const mesh::Mesh& mesh) {
  std::vector<Face> faces;
  if (mesh.dimension == 3) {
    for (const auto& face : mesh::skin(mesh))
      faces.push_back({face.type, {face.nodes().begin(), face.nodes().end()}});
    return faces;
  }
  mesh::for_each_cell(
      mesh, [&](mesh::CellIndex, const cell::CellTopology& shape, std::span<const mesh::NodeIndex> nodes) {
        if (shape.dimension == 2)
          faces.push_back({shape.type, {nodes.begin(), nodes.end()}});
      });
  return faces;
}

/// A face as a function of reference coordinates.
class Surface {
public:
  Surface(const Face& face, std::span<const Vector3d> points, std::span<const double> values)
      : face_(face), points_(points), values_(values), cell_(cell::reference_cell(face.type)) {}

  Vector3d point(const Vector3d& xi) {
    weigh(xi);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < face_.nodes.size(); ++i)
      sum += weights_[i] * points_[static_cast<std::size_t>(face_.nodes[i])];
    return sum;
  }

  double value(const Vector3d& xi) {
    weigh(xi);
    double sum = 0;
    for (std::size_t i = 0; i < face_.nodes.size(); ++i)
      sum += weights_[i] * values_[static_cast<std::size_t>(face_.nodes[i])];
    return sum;
  }

private:
  void weigh(const Vector3d& xi) {
    cell_.values(xi, std::span(weights_).first(static_cast<std::size_t>(cell_.node_count)));
  }

  const Face& face_;
  std::span<const Vector3d> points_;
  std::span<const double> values_;
  const cell::ReferenceCell& cell_;
  std::array<double, 9> weights_{};
};

/// Corners of the reference cell, around it.
std::vector<Vector3d> reference_corners(const Face& face) {
  if (cell::topology(face.type).corner_count == 3)
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
}

Patch patch_of(Surface& surface, std::span<const Vector3d> reference) {
  Patch patch;
  Vector3d centre = Vector3d::Zero();
  for (const auto& xi : reference) {
    patch.corners.push_back(surface.point(xi));
    centre += xi / static_cast<double>(reference.size());
  }
  patch.value = surface.value(centre);
  return patch;
}

void add_triangles(Surface& surface, int divisions, std::vector<Patch>& patches) {
  const auto at = [&](int i, int j) -> Vector3d { return Vector3d(i, j, 0) / divisions; };
  for (int i = 0; i < divisions; ++i)
    for (int j = 0; i + j < divisions; ++j) {
      patches.push_back(patch_of(surface, std::array{at(i, j), at(i + 1, j), at(i, j + 1)}));
      if (i + j + 1 < divisions)
        patches.push_back(patch_of(surface, std::array{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}));
    }
}

void add_quadrangles(Surface& surface, int divisions, std::vector<Patch>& patches) {
  const auto at = [&](int i, int j) -> Vector3d {
    return Vector3d(i, j, 0) * 2 / divisions - Vector3d(1, 1, 0);
  };
  for (int i = 0; i < divisions; ++i)
    for (int j = 0; j < divisions; ++j)
      patches.push_back(
          patch_of(surface, std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}));
}

std::vector<Vector3d> outline_of(const Face& face, Surface& surface) {
  const auto corners = reference_corners(face);
  const int parts = cell::topology(face.type).order == 1 ? 1 : side_parts;
  std::vector<Vector3d> outline;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (int part = 0; part < parts; ++part)
      outline.push_back(surface.point(corners[i] + (corners[(i + 1) % corners.size()] - corners[i]) * part /
                                                       static_cast<double>(parts)));
  return outline;
}

} // namespace

std::vector<Facet> facets(const mesh::Mesh& mesh, std::span<const Vector3d> points,
                          std::span<const double> values) {
  const auto faces = faces_of(mesh);
  const double share = most_patches / static_cast<double>(std::max<std::size_t>(faces.size(), 1));
  const int divisions = std::clamp(static_cast<int>(std::sqrt(share)), 1, most_divisions);
  std::vector<Facet> found;
  for (const auto& face : faces) {
    Surface surface(face, points, values);
    auto& facet = found.emplace_back();
    facet.outline = outline_of(face, surface);
    if (cell::topology(face.type).corner_count == 3)
      add_triangles(surface, divisions, facet.patches);
    else
      add_quadrangles(surface, divisions, facet.patches);
  }
  return found;
}

std::vector<std::vector<Vector3d>> border_lines(const mesh::Mesh& mesh, std::span<const Vector3d> points) {
  std::vector<std::vector<Vector3d>> lines;
  const std::vector<double> no_values(points.size(), 0.0);
  for (const auto& side : mesh::skin(mesh)) {
    const Face face{side.type, {side.nodes().begin(), side.nodes().end()}};
    Surface surface(face, points, no_values);
    const int parts = cell::topology(face.type).order == 1 ? 1 : side_parts;
    auto& line = lines.emplace_back();
    for (int part = 0; part <= parts; ++part)
      line.push_back(surface.point(Vector3d(-1 + 2.0 * part / parts, 0, 0)));
  }
  return lines;
}

} // namespace rubato::plot
