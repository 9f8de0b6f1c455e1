// SPDX-License-Identifier: LGPL-3.0-or-later
// Rigid obstacles: a plane, a cylinder or a sphere, and how it moves.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::deck {
namespace {

void read_plane(MapReader& map, const Context& context, study::Obstacle& obstacle) {
  read_point(map.require("point"), context, obstacle.point);
  read_point(map.require("normal"), context, obstacle.direction);
}

void read_radius_and_side(MapReader& map, study::Obstacle& obstacle) {
  read(map.require("radius"), obstacle.radius);
  read(map.find("side"), obstacle.side, study::obstacle_side_words);
}

void read_cylinder(MapReader& map, const Context& context, study::Obstacle& obstacle) {
  if (context.physics == study::Physics::axisymmetric) {
    map.refuse("point", "the cylinder's axis is the axis of revolution in axisymmetric");
    map.refuse("axis", "the cylinder's axis is the axis of revolution in axisymmetric");
  } else {
    read_point(map.require("point"), context, obstacle.point);
    if (context.physics && study::dimension_of(*context.physics) == 2) {
      map.refuse("axis", fmt::format("the cylinder's axis is z in {}",
                                     study::word_of(study::physics_words, *context.physics)));
      obstacle.direction = {0, 0, 1};
    } else {
      read_point(context.physics ? map.require("axis") : map.find("axis"), context, obstacle.direction);
    }
  }
  read_radius_and_side(map, obstacle);
}

void read_sphere(MapReader& map, const Context& context, study::Obstacle& obstacle) {
  read_point(map.require("point"), context, obstacle.point);
  read_radius_and_side(map, obstacle);
}

struct Reader {
  study::ObstacleKind kind;
  void (*read)(MapReader&, const Context&, study::Obstacle&);
};
constexpr std::array<Reader, 3> readers{{{study::ObstacleKind::plane, read_plane},
                                         {study::ObstacleKind::cylinder, read_cylinder},
                                         {study::ObstacleKind::sphere, read_sphere}}};

void read_move(const Value& value, study::Obstacle& obstacle) {
  MapReader map(value);
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto given = map.find(study::axis_words[axis]))
      obstacle.move[axis] = read_amplitude(*given);
  map.finish();
}

} // namespace

study::Obstacle read_obstacle(const Value& value, const Context& context) {
  study::Obstacle obstacle;
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
    read_move(*move, obstacle);
  if (const auto rotate = map.find("rotate"))
    obstacle.rotate = read_rotation(*rotate, context);
  map.finish();
  if (kinds != 1)
    value.spoil();
  const auto& entries = value.tree().entries;
  const bool unknown_key_told = std::ranges::any_of(
      entries, [](const auto& entry) { return entry.key != "move" && entry.key != "rotate"; });
  if (kinds > 1 || (kinds == 0 && map.is_map() && !unknown_key_told))
    value.fault(fmt::format("found {} of plane, cylinder and sphere, expected one of them",
                            kinds == 0 ? "none" : "several"));
  return obstacle;
}

} // namespace rubato::deck
