// SPDX-License-Identifier: LGPL-3.0-or-later
// Rigid obstacles: a plane, a cylinder or a sphere, and how it moves.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::deck {
namespace {

bool is(const Context& context, study::Physics physics) {
  return context.physics == physics;
}

/// A vector that has a direction.
bool read_direction(const Found& value, const Context& context, std::array<double, 3>& direction) {
  if (!read_point(value, context, direction))
    return false;
  const bool has_length = std::ranges::any_of(direction, [](double x) { return x != 0; });
  if (!has_length)
    value->fault("found a vector of length 0, expected one that points somewhere");
  return has_length;
}

void read_plane(MapReader& map, const Context& context, study::Obstacle& obstacle) {
  read_point(map.require("point"), context, obstacle.point);
  const auto normal = map.require("normal");
  if (read_direction(normal, context, obstacle.direction) && is(context, study::Physics::axisymmetric) &&
      obstacle.direction[0] != 0)
    normal->fault("found a normal that leaves the axis of revolution, expected [0, 1] or [0, -1]: the "
                  "plane would be a cone");
}

void read_radius_and_side(MapReader& map, study::Obstacle& obstacle) {
  read(map.require("radius"), obstacle.radius, above(0));
  read(map.find("side"), obstacle.side, study::obstacle_side_words);
}

void read_cylinder(MapReader& map, const Context& context, study::Obstacle& obstacle) {
  if (is(context, study::Physics::axisymmetric)) {
    map.refuse("point", "the cylinder's axis is the axis of revolution in axisymmetric");
    map.refuse("axis", "the cylinder's axis is the axis of revolution in axisymmetric");
  } else {
    read_point(map.require("point"), context, obstacle.point);
    if (context.physics && study::dimension_of(*context.physics) == 2) {
      map.refuse("axis", fmt::format("the cylinder's axis is z in {}",
                                     study::word_of(study::physics_words, *context.physics)));
      obstacle.direction = {0, 0, 1};
    } else {
      read_direction(context.physics ? map.require("axis") : map.find("axis"), context, obstacle.direction);
    }
  }
  read_radius_and_side(map, obstacle);
}

void read_sphere(MapReader& map, const Context& context, study::Obstacle& obstacle) {
  if (is(context, study::Physics::plane_stress) || is(context, study::Physics::plane_strain))
    map.value().fault(fmt::format("{} has no sphere, expected cylinder, which is a circle there",
                                  study::word_of(study::physics_words, *context.physics)));
  const auto point = map.require("point");
  if (read_point(point, context, obstacle.point) && is(context, study::Physics::axisymmetric) &&
      obstacle.point[0] != 0)
    point->fault(fmt::format("found a centre {} from the axis of revolution, expected one on it: the sphere "
                             "would be a ring",
                             obstacle.point[0]));
  read_radius_and_side(map, obstacle);
}

struct Reader {
  study::ObstacleKind kind;
  void (*read)(MapReader&, const Context&, study::Obstacle&);
};
constexpr std::array<Reader, 3> readers{{{study::ObstacleKind::plane, read_plane},
                                         {study::ObstacleKind::cylinder, read_cylinder},
                                         {study::ObstacleKind::sphere, read_sphere}}};

void read_move(const Value& value, const Context& context, const std::map<std::string, Function>& functions,
               study::Obstacle& obstacle) {
  MapReader map(value);
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto given = find_axis(map, axis, context))
      obstacle.move[axis] = read_amplitude(*given, functions);
  map.finish();
  if (is(context, study::Physics::axisymmetric) && obstacle.move[0])
    value.fault("found a motion along x, expected one along y: obstacles of axisymmetric move on the axis "
                "of revolution only");
}

} // namespace

study::Obstacle read_obstacle(const Value& value, const Context& context,
                              const std::map<std::string, Function>& functions) {
  study::Obstacle obstacle;
  obstacle.at = value.at();
  MapReader map(value);
  std::size_t kinds = 0;
  for (const auto& reader : readers)
    if (const auto shape = map.find(study::word_of(study::obstacle_words, reader.kind))) {
      obstacle.kind = reader.kind;
      MapReader of_shape(*shape);
      reader.read(of_shape, context, obstacle);
      of_shape.finish();
      ++kinds;
    }
  if (const auto move = map.find("move"))
    read_move(*move, context, functions, obstacle);
  map.finish();
  const auto& entries = value.tree().entries;
  const bool unknown_key_told =
      std::ranges::any_of(entries, [](const auto& entry) { return entry.key != "move"; });
  if (kinds > 1 || (kinds == 0 && map.is_map() && !unknown_key_told))
    value.fault(fmt::format("found {} of plane, cylinder and sphere, expected one of them",
                            kinds == 0 ? "none" : "several"));
  return obstacle;
}

} // namespace rubato::deck
