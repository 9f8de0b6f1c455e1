// SPDX-License-Identifier: LGPL-3.0-or-later
// Axes of nodes that lines of supports, loads and equations refer to.
#include "rubato/core/naming.hpp"
#include "rubato/inp/points.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubato::inp {
namespace {

std::optional<std::array<double, 6>> transform_numbers(Reading& reading, const Block& block) {
  const auto fields = mesh::inp::fields_at(block, 0);
  std::array<double, 6> numbers{};
  if (fields.size() > numbers.size() || fields.empty()) {
    reading.faults.add(block.at, fmt::format("found {} coordinates of {}, expected those of two points",
                                             fields.size(), block.at.text));
    return std::nullopt;
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto number = mesh::inp::require_number(fields[i], "a coordinate", reading.faults, 0);
    if (!number)
      return std::nullopt;
    numbers.at(i) = *number;
  }
  return numbers;
}

/// x' along the first point, y' in the plane of both; or the line through both points.
std::optional<LocalAxes> axes_between(LocalAxes::Kind kind, const std::array<double, 6>& n) {
  const Eigen::Vector3d a(n[0], n[1], n[2]), b(n[3], n[4], n[5]);
  LocalAxes axes;
  axes.kind = kind;
  if (kind != LocalAxes::Kind::rectangular) {
    axes.origin = a;
    if ((b - a).norm() == 0)
      return std::nullopt;
    axes.turn.col(2) = (b - a).normalized();
    return axes;
  }
  const Eigen::Vector3d normal = a.cross(b);
  if (!(normal.norm() > 1e-12 * a.norm() * b.norm()))
    return std::nullopt;
  axes.turn.col(0) = a.normalized();
  axes.turn.col(2) = normal.normalized();
  axes.turn.col(1) = axes.turn.col(2).cross(axes.turn.col(0));
  return axes;
}

} // namespace

void read_transform(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto set = mesh::inp::require_value(block, "NSET", "a set of nodes", reading.faults);
  const auto* const type = block.find("TYPE");
  const auto word = type == nullptr ? std::string("R") : mesh::inp::compact(type->value.text);
  if (word != "R" && word != "C" && word != "S")
    return reading.faults.add(type->value,
                              fmt::format("found TYPE={}, expected R, C or S", type->value.text));
  const auto numbers = transform_numbers(reading, block);
  const auto found =
      set.empty() ? std::nullopt : mesh::inp::find_nodes(reading.content, placed.scope, set, reading.faults);
  if (!numbers || !found)
    return;
  const auto axes = axes_between(word == "R"   ? LocalAxes::Kind::rectangular
                                 : word == "C" ? LocalAxes::Kind::cylindrical
                                               : LocalAxes::Kind::spherical,
                                 *numbers);
  if (!axes)
    return reading.faults.add(block.at,
                              "found two points that give no axes, expected two that differ, and of "
                              "TYPE=R in different directions");
  if (reading.dimension() == 2 && std::abs(std::abs(axes->turn(2, 2)) - 1) > 1e-12)
    return reading.faults.add(block.at, "found axes whose third one is not z, which a plane model needs");
  const auto number = reading.transforms.size();
  reading.transforms.push_back(*axes);
  for (const auto node : found->items)
    reading.axes_of_node[node] = number;
}

} // namespace rubato::inp
