// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/mortar_drag.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/walk.hpp"
#include "verification/mortar_runs.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::verification {
namespace {

constexpr double degree = std::numbers::pi / 180;

bool is_solid(CellType cells) {
  return cell::topology(cells).dimension == 3;
}

/// In space the plate is 2.6 wide and long, or longer by 5/7 of that when refined: the block stays far from
/// its ends.
std::string bodies_of(const Drag& how) {
  const int n = how.finer;
  const int longer = n > 1 ? 12 : 7;
  return is_solid(how.cells)
             ? fmt::format(R"(
    - {{name: plate, box: {{from: [-1.3, -0.5, -1.3], to: [{4}, 0, 1.3]}}, divisions: [{1}, {3}, {2}], cells: {0}, sides: {{bottom: ground, top: below}}}}
    - {{name: block, box: {{from: [-0.5, 0, -0.5], to: [0.5, 1, 0.5]}}, divisions: [{5}, {5}, {5}], cells: {0}, sides: {{bottom: above, top: roof}}}})",
                           word_of(how.cells), longer * n, 7 * n, 2 * n, -1.3 + 2.6 * longer / 7, 3 * n)
             : fmt::format(R"(
    - {{name: plate, rectangle: {{from: [-0.8, -0.5], to: [2.2, 0]}}, divisions: [{1}, {2}], cells: {0}, sides: {{bottom: ground, top: below}}}}
    - {{name: block, rectangle: {{from: [-0.5, 0], to: [0.5, 1]}}, divisions: [{3}, {3}], cells: {0}, sides: {{bottom: above, top: roof}}}})",
                           word_of(how.cells), 17 * n, 3 * n, 5 * n);
}

double face_of(const Drag& how) {
  return 1.0 / (how.finer * (is_solid(how.cells) ? 3 : 5));
}

/// Where the roof stands at the instants 0, 1, 2 …: it is pressed until 1 and moves then.
std::string places(const Drag& how, int axis) {
  std::vector<double> at{0, 0};
  for (const auto& move : how.moves)
    at.push_back(at.back() + face_of(how) * move[axis]);
  return fmt::format("{:.17g}", fmt::join(at, ", "));
}

std::string instants(const Drag& how) {
  std::vector<int> at;
  for (std::size_t i = 0; i < how.moves.size() + 2; ++i)
    at.push_back(static_cast<int>(i));
  return fmt::format("{}", fmt::join(at, ", "));
}

std::string deck_of(const Drag& how) {
  const bool solid = is_solid(how.cells);
  return fmt::format(
      R"(mesh:
  generate:{}
physics: {}
materials: {{steel: {{young: 2e5, poisson: 0.3}}}}
supports:
  - {{on: ground, fix: [x, y{}]}}
  - {{on: roof, x: {{value: 1, function: along}}, y: {{value: {}, function: press}}{}}}
functions:
  press: {{times: [0, 1], values: [0, 1]}}
  along: {{times: [{}], values: [{}]}}
  aside: {{times: [{}], values: [{}]}}
contact: {{rub: {{master: {}, slave: {}, friction: {}, integration: {}}}}}
time: {{scheme: static, step: 1, end: {}}}
)",
      bodies_of(how), solid ? "solid" : "plane_strain", solid ? ", z" : "", -how.strain,
      solid ? ", z: {value: 1, function: aside}" : "", instants(how), places(how, 0), instants(how),
      places(how, 1), how.block_is_slave ? "below" : "above", how.block_is_slave ? "above" : "below",
      how.friction, how.integration, how.moves.size() + 1);
}

/// On the block.
Eigen::Vector3d force_of(const test::Walk& walk, bool block_is_slave) {
  const auto force = walk.resultants().force;
  return (block_is_slave ? 1 : -1) * Eigen::Vector3d(force[0], force[1], force[2]);
}

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))) / degree;
}

DragStep step_of(const test::Walk& walk, const Drag& how, std::size_t number) {
  DragStep step;
  const auto force = force_of(walk, how.block_is_slave);
  const Eigen::Vector2d tangential(force.x(), force.z());
  step.normal = force.y();
  step.ratio = tangential.norm() / force.y();
  if (number > 0)
    step.direction = angle_between(-tangential, how.moves[number - 1]);
  step.sticking =
      static_cast<int>(std::ranges::count(walk.state().zones.front().status, contact::Status::stick));
  return step;
}

} // namespace

std::vector<Eigen::Vector2d> straight(double length, int n, double degrees) {
  return std::vector<Eigen::Vector2d>(
      static_cast<std::size_t>(n),
      length * Eigen::Vector2d(std::cos(degrees * degree), std::sin(degrees * degree)));
}

std::vector<Eigen::Vector2d> turned_and_reversed() {
  auto moves = straight(0.5, 2);
  for (const double degrees : {143.0, 143.0 + 180})
    for (const auto& move : straight(0.5, 2, degrees))
      moves.push_back(move);
  return moves;
}

Dragged drag(const Drag& how) {
  Dragged result;
  test::Walk walk(deck_of(how));
  while (!walk.finished()) {
    const auto before = walk.reports.size();
    const bool done = walk.advance();
    DragStep step;
    if (done)
      step = step_of(walk, how, result.steps.size());
    step.attempts = static_cast<int>(walk.reports.size() - before);
    for (auto i = before; i < walk.reports.size(); ++i)
      step.iterations += walk.reports[i].iterations;
    result.steps.push_back(step);
    if (!done) {
      result.failure = step::to_string(walk.reports.back().outcome);
      break;
    }
  }
  return result;
}

} // namespace rubato::verification
