// SPDX-License-Identifier: LGPL-3.0-or-later
/// Obstacles of every kind that some points of the slave face of two_faces.hpp penetrate, on their way.
#pragma once

#include "rubato/contact/obstacle.hpp"

#include "two_faces.hpp"
#include <string>
#include <vector>

namespace rubato::test {

struct NamedObstacle {
  std::string name;
  TwoFacesOptions options;
};

inline contact::Obstacle on_its_way(study::Obstacle obstacle, study::Physics physics) {
  obstacle.move = {study::Amplitude{0.03, "ramp"}, study::Amplitude{-0.02, "ramp"}, {}};
  if (physics == study::Physics::solid)
    obstacle.move[2] = study::Amplitude{0.01, {}};
  return contact::make_obstacle(obstacle, physics, {{"ramp", {{0, 1}, {0.2, 1}, {}}}});
}

/// The same while it rotates about a line near by.
inline contact::Obstacle turning(const study::Obstacle& obstacle, study::Physics physics) {
  auto made = on_its_way(obstacle, physics);
  const bool solid = physics == study::Physics::solid;
  const Eigen::Vector3d axis(solid ? 1 : 0, solid ? -2 : 0, 2);
  made.rotation = constraint::Rotation{
      {0.3, -0.2, 0}, axis.normalized(), {.number = 0.3, .function = Function({0, 1}, {0.2, 1})}};
  return made;
}

inline std::vector<NamedObstacle> every_obstacle() {
  using study::ObstacleKind;
  using study::ObstacleSide;
  using study::Physics;
  const auto with = [](CellType slave, const study::Obstacle& obstacle, Physics physics) {
    return TwoFacesOptions{.slave = slave, .obstacle = on_its_way(obstacle, physics)};
  };
  const auto turned = [](CellType slave, const study::Obstacle& obstacle, Physics physics) {
    return TwoFacesOptions{.slave = slave, .obstacle = turning(obstacle, physics)};
  };
  const auto in_plane = [&](CellType slave, const study::Obstacle& obstacle) {
    return with(slave, obstacle, Physics::plane_strain);
  };
  const auto in_space = [&](CellType slave, const study::Obstacle& obstacle) {
    return with(slave, obstacle, Physics::solid);
  };
  const study::Obstacle line{.point = {0.1, 0, 0}, .direction = {-0.1, 2, 0}};
  const study::Obstacle circle{
      .kind = ObstacleKind::cylinder, .point = {0.2, -0.5, 0}, .direction = {0, 0, 1}, .radius = 1.1};
  const study::Obstacle plane{.point = {0.1, 0, 0}, .direction = {0.1, -0.2, 3}};
  const study::Obstacle cylinder{
      .kind = ObstacleKind::cylinder, .point = {0.2, 3, -0.5}, .direction = {0.02, 2, 0.1}, .radius = 1.1};
  const study::Obstacle ball{.kind = ObstacleKind::sphere, .point = {0.2, 0.1, -0.5}, .radius = 1.5};
  auto bore = circle;
  bore.point = {0.2, 0.5, 0};
  bore.side = ObstacleSide::inside;
  auto tube = cylinder;
  tube.point = {0.2, 0, 0.5};
  tube.side = ObstacleSide::inside;
  auto bowl = ball;
  bowl.point = {0.1, -0.2, 1};
  bowl.radius = 1.7;
  bowl.side = ObstacleSide::inside;
  return {{"Line", in_plane(CellType::seg2, line)},
          {"Circle", in_plane(CellType::seg3, circle)},
          {"Bore", in_plane(CellType::seg2, bore)},
          {"Plane", in_space(CellType::quad4, plane)},
          {"Cylinder", in_space(CellType::tria6, cylinder)},
          {"Tube", in_space(CellType::quad8, tube)},
          {"Ball", in_space(CellType::quad9, ball)},
          {"Bowl", in_space(CellType::quad4, bowl)},
          {"TurningLine", turned(CellType::seg2, line, Physics::plane_strain)},
          {"TurningCircle", turned(CellType::seg3, circle, Physics::plane_strain)},
          {"TurningPlane", turned(CellType::quad4, plane, Physics::solid)},
          {"TurningCylinder", turned(CellType::tria6, cylinder, Physics::solid)},
          {"TurningBall", turned(CellType::quad9, ball, Physics::solid)}};
}

} // namespace rubato::test
