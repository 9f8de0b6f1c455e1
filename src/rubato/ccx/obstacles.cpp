// SPDX-License-Identifier: LGPL-3.0-or-later
// Plane obstacles as faces of rigid blocks.
#include "rubato/ccx/draft.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <array>

namespace rubato::ccx {
namespace {

using Eigen::Vector3d;

/// Depth of a block in parts of its half width.
constexpr double depth = 0.1;
/// Inner radius of a block near an axis of revolution, likewise: CalculiX misses contact with a face that
/// ends on the axis.
constexpr double next_to_axis = 1e-4;

/// Where the bodies are.
struct Surroundings {
  Vector3d centre = Vector3d::Zero();
  double size = 0;  ///< diagonal of their box [length]
  double reach = 0; ///< largest x
};

Surroundings surroundings_of(const mesh::Mesh& mesh) {
  Vector3d low = mesh.points.front(), high = low;
  for (const auto& point : mesh.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return {0.5 * (low + high), (high - low).norm(), high.x()};
}

/// The corners of the block, those of its face that bodies touch last in space, first in the plane.
std::vector<Vector3d> corners_of(const Run& run, const study::Obstacle& obstacle) {
  const auto around = surroundings_of(run.model.mesh);
  const Vector3d point(obstacle.point[0], obstacle.point[1], obstacle.point[2]);
  const Vector3d normal =
      Vector3d(obstacle.direction[0], obstacle.direction[1], obstacle.direction[2]).normalized();
  Vector3d centre = around.centre - (around.centre - point).dot(normal) * normal;
  double half = around.size;
  if (run.study().physics == study::Physics::axisymmetric) {
    half += around.reach;
    centre.x() = (1 + next_to_axis) * half;
  }
  const Vector3d down = -depth * half * normal;
  if (run.is_plane()) {
    const Vector3d along = half * Vector3d(-normal.y(), normal.x(), 0);
    return {centre - along, centre + along, centre + along + down, centre - along + down};
  }
  const Vector3d one = half * normal.unitOrthogonal();
  const Vector3d other = normal.cross(one);
  const std::array face{Vector3d(-one - other), Vector3d(one - other), Vector3d(one + other),
                        Vector3d(other - one)};
  std::vector<Vector3d> corners;
  for (const auto& corner : face)
    corners.push_back(centre + corner + down);
  for (const auto& corner : face)
    corners.push_back(centre + corner);
  return corners;
}

std::string_view element_of(study::Physics physics) {
  switch (physics) {
  case study::Physics::solid:
    return "C3D8";
  case study::Physics::plane_stress:
    return "CPS4";
  case study::Physics::plane_strain:
    return "CPE4";
  case study::Physics::axisymmetric:
    break;
  }
  return "CAX4";
}

} // namespace

void write_obstacle(Run& run, const study::Obstacle& obstacle, const std::string& zone,
                    const std::string& label) {
  const auto& study = run.study();
  const auto corners = corners_of(run, obstacle);
  std::vector<std::int64_t> line{run.next_element++};
  for (std::size_t i = 0; i < corners.size(); ++i)
    line.push_back(made_node(run.draft, fmt::format("obstacle {} {}", zone, i), corners[i]));
  run.body += fmt::format("*ELEMENT, TYPE={}, ELSET={}\n{}", element_of(study.physics), label, rows_of(line));
  const bool has_thickness =
      study.physics == study::Physics::plane_stress || study.physics == study::Physics::plane_strain;
  run.body += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL={}\n{}", label, run.materials.front(),
                          has_thickness ? shown_number(study.thickness) + "\n" : "");
  run.body +=
      fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n{}, S{}\n", label, line.front(), run.is_plane() ? 1 : 2);
  for (int i = 0; i < run.model.dofs.components; ++i) {
    const auto& move = obstacle.move[static_cast<std::size_t>(i)];
    const auto function = !move || move->function.empty() ? std::optional<Function>()
                                                          : std::optional(study.functions.at(move->function));
    const auto course = course_of(run, move ? move->value : 0, function, "obstacle");
    for (std::size_t n = 1; n < line.size(); ++n)
      run.moved.push_back({{line[n], i + 1}, course});
  }
}

} // namespace rubato::ccx
