// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/rotations.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rubato::model {
namespace {

using Eigen::Vector3d;

/// Instants that are looked at of a run that finds its steps itself, and the most of any other.
constexpr double instants_unknown = 1000;
constexpr double most_instants = 100'000;

/// The begin and the end among them.
std::vector<double> instants_of(const study::TimeStepping& time) {
  auto instants = time.instants;
  instants.insert(instants.end(), time.stops.begin(), time.stops.end());
  const double span = time.end - time.begin;
  const double spacing = time.step > 0 ? std::max(time.step, span / most_instants) : span / instants_unknown;
  if (time.instants.empty())
    for (double i = 0; i * spacing < span; ++i)
      instants.push_back(time.begin + i * spacing);
  std::erase_if(instants, [&](double t) { return !(t > time.begin && t < time.end); });
  instants.insert(instants.end(), {time.begin, time.end});
  return instants;
}

/// Whether one of the nodes is of a cell that deforms.
bool are_of_bodies(const Parts& parts, std::span<const mesh::NodeIndex> nodes) {
  std::vector<char> asked(parts.mesh.points.size(), 0);
  for (const auto node : nodes)
    asked[static_cast<std::size_t>(node)] = 1;
  return std::ranges::any_of(parts.mesh.blocks, [&](const mesh::CellBlock& block) {
    return cell::topology(block.type).dimension == parts.dofs.components &&
           std::ranges::any_of(block.nodes,
                               [&](auto node) { return asked[static_cast<std::size_t>(node)] != 0; });
  });
}

} // namespace

std::shared_ptr<const constraint::Rotation> shared_rotation(const Parts& parts, const study::Rotation& given,
                                                            const std::string& path) {
  const auto vector_of = [](const std::array<double, 3>& numbers) { return Vector3d(numbers.data()); };
  constraint::Rotation rotation{vector_of(given.about), vector_of(given.axis).stableNormalized(),
                                *shared_field(parts, given.angle, path + ".angle")};
  for (const double t : {parts.study.time.begin, parts.study.time.end})
    constraint::angle_at(rotation, t); // throws now rather than in a step
  return std::make_shared<const constraint::Rotation>(std::move(rotation));
}

AngleAt largest_angle(const constraint::Rotation& rotation, const study::TimeStepping& time) {
  AngleAt largest{0, time.begin};
  for (const double t : instants_of(time))
    if (const double angle = constraint::angle_at(rotation, t); std::abs(angle) > std::abs(largest.angle))
      largest = {angle, t};
  return largest;
}

void check_angle(const Parts& parts, std::span<const mesh::NodeIndex> nodes,
                 const constraint::Rotation& rotation, const std::string& path) {
  if (study::takes_large_rotations(parts.study))
    return;
  const auto [angle, t] = largest_angle(rotation, parts.study.time);
  if (std::abs(angle) <= largest_small_angle || !are_of_bodies(parts, nodes))
    return;
  throw InputError({fault_at(
      path + ".angle", fmt::format("found an angle of {:.4g} at t = {:.6g}, expected at most {} radians, or "
                                   "materials with strain: green_lagrange or logarithmic: with small strain "
                                   "a body that rotates stretches by 1 − cos of the angle",
                                   angle, t, largest_small_angle))});
}

} // namespace rubato::model
