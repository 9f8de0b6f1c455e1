// SPDX-License-Identifier: LGPL-3.0-or-later
// Rigid obstacles: what the physics leaves of a plane, a cylinder or a sphere.
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::study {
namespace {

void check_point(Rules& rules, const Obstacle& obstacle, const std::string& path) {
  for (std::size_t axis = 0; axis < obstacle.point.size(); ++axis) {
    const auto at = fmt::format("{}.point.{}", path, axis);
    rules.number(at, obstacle.point[axis]);
    if (obstacle.point[axis] != 0)
      rules.axis(at, axis);
  }
}

void check_direction(Rules& rules, const Obstacle& obstacle, const std::string& path) {
  for (std::size_t axis = 0; axis < obstacle.direction.size(); ++axis)
    rules.number(fmt::format("{}.{}", path, axis), obstacle.direction[axis]);
  if (std::ranges::all_of(obstacle.direction, [](double x) { return x == 0; }))
    rules.broken({path}, "found a vector of length 0, expected one that points somewhere");
}

void check_plane(Rules& rules, const Obstacle& obstacle, const std::string& path) {
  check_point(rules, obstacle, path);
  check_direction(rules, obstacle, path + ".normal");
  if (dimension_of(rules.study.physics) == 2 && obstacle.direction[2] != 0)
    rules.axis(path + ".normal.2", 2);
  if (rules.study.physics == Physics::axisymmetric && obstacle.direction[0] != 0)
    rules.broken({path + ".normal", "physics"},
                 "found a normal that leaves the axis of revolution, expected [0, 1] or [0, -1]: the plane "
                 "would be a cone");
}

void check_cylinder(Rules& rules, const Obstacle& obstacle, const std::string& path) {
  if (rules.study.physics != Physics::axisymmetric)
    check_point(rules, obstacle, path);
  if (rules.study.physics == Physics::solid)
    check_direction(rules, obstacle, path + ".axis");
}

void check_sphere(Rules& rules, const Obstacle& obstacle, const std::string& path) {
  const auto physics = rules.study.physics;
  check_point(rules, obstacle, path);
  if (physics == Physics::plane_stress || physics == Physics::plane_strain)
    rules.broken({path, "physics"},
                 fmt::format("{} has no sphere, expected cylinder, which is a circle there",
                             word_of(physics_words, physics)));
  if (physics == Physics::axisymmetric && obstacle.point[0] != 0)
    rules.broken({path + ".point", "physics"},
                 fmt::format("found a centre {} from the axis of revolution, expected one on it: the sphere "
                             "would be a ring",
                             obstacle.point[0]));
}

void check_move(Rules& rules, const Obstacle& obstacle, const std::string& path) {
  for (std::size_t axis = 0; axis < obstacle.move.size(); ++axis) {
    if (!obstacle.move[axis])
      continue;
    const auto at = fmt::format("{}.{}", path, axis_words.at(axis));
    rules.axis(at, axis);
    rules.number(at, obstacle.move[axis]->value);
    rules.function(at + ".function", obstacle.move[axis]->function);
  }
  if (rules.study.physics == Physics::axisymmetric && obstacle.move[0])
    rules.broken({path, "physics"}, "found a motion along x, expected one along y: obstacles of axisymmetric "
                                    "move on the axis of revolution only");
}

} // namespace

void check_obstacle(Rules& rules, const ContactZone& zone) {
  const auto& obstacle = *zone.obstacle;
  const auto path = fmt::format("contact.{}.obstacle", zone.name);
  const auto shape = fmt::format("{}.{}", path, word_of(obstacle_words, obstacle.kind));
  switch (obstacle.kind) {
  case ObstacleKind::plane:
    check_plane(rules, obstacle, shape);
    break;
  case ObstacleKind::cylinder:
    check_cylinder(rules, obstacle, shape);
    break;
  case ObstacleKind::sphere:
    check_sphere(rules, obstacle, shape);
    break;
  }
  if (obstacle.kind != ObstacleKind::plane)
    rules.number(shape + ".radius", obstacle.radius, bounds::radius);
  check_move(rules, obstacle, path + ".move");
  if (obstacle.rotate)
    check_rotate(rules, *obstacle.rotate, path + ".rotate");
  if (obstacle.rotate && zone.freeze)
    rules.broken(
        {path + ".rotate", fmt::format("contact.{}.freeze", zone.name)},
        "found freeze: true beside 'rotate', expected one of them: normals that are held do not turn");
}

} // namespace rubato::study
