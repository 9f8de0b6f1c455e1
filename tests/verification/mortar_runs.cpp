// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/mortar_runs.hpp"

#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

namespace rubato::verification {
namespace {

constexpr double inner = 19.95, shaft = 20, outer = 40, length = 20;
constexpr double young = 210e3, poisson = 0.3;

std::string deck_of(const ShrinkFit& fit) {
  const int k = fit.fineness;
  return fmt::format(
      R"(mesh:
  generate:
    - {{name: shaft, rectangle: {{from: [0, 0], to: [{0}, {3}]}}, divisions: [{4}, {5}], cells: {8}, sides: {{bottom: low, top: high, right: outside}}, points: {{left_bottom: held}}}}
    - {{name: ring, rectangle: {{from: [{1}, 0], to: [{2}, {3}]}}, divisions: [{6}, {7}], cells: {8}, sides: {{bottom: low, top: high, left: inside}}, points: {{right_bottom: held}}}}
physics: axisymmetric
materials: {{steel: {{young: {9}, poisson: {10}}}}}
supports: {11}
contact: {{fit: {{master: outside, slave: inside, integration: {12}}}}}
time: {{scheme: static, step: 1, end: 1}}
newton: {{residual: 1e-10}}
)",
      shaft, inner, outer, length, 5 * k, 10 * k, 5 * k, 13 * k, word_of(fit.cells), young, poisson,
      fit.ends_held ? "[{on: low, fix: y}, {on: high, fix: y}]" : "[{on: held, fix: y}]", fit.integration);
}

void take(double error, bool inside, PressureErrors& into) {
  into.largest = std::max(into.largest, std::abs(error));
  into.rms += error * error;
  if (inside)
    into.interior = std::max(into.interior, std::abs(error));
}

/// Of all slave nodes; `is_inside(x)`: of those that the interior is.
template <class IsInside>
void take_all(const test::Walk& walk, double exact, const IsInside& is_inside, PressureErrors& into) {
  for (std::size_t i = 0; i < walk.slave_count(); ++i)
    take(walk.pressure(i) / exact - 1, is_inside(walk.slave_point(i)), into);
  into.rms = std::sqrt(into.rms / static_cast<double>(walk.slave_count()));
  into.iterations = walk.reports.back().iterations;
  into.nodes = walk.model.mesh.node_count();
}

/// The middle 80 % of 0 to `whole`.
bool in_the_middle(double place, double whole) {
  return std::abs(place - whole / 2) <= 0.4 * whole;
}

constexpr double bore = 5;

/// Radius, angle and height are the axes of the boxes.
std::string deck_of(const SolidRing& fit) {
  const auto divisions = [](const std::array<int, 3>& n) {
    return fmt::format("[{}, {}, {}]", n[0], n[1], n[2]);
  };
  return fmt::format(
      R"(mesh:
  generate:
    - {{name: shaft, box: {{from: [{0}, 0, 0], to: [{1}, {4}, {5}]}}, divisions: {6}, cells: {8}, sides: {{right: outside, bottom: on_x, top: on_y, back: ends, front: ends}}}}
    - {{name: ring, box: {{from: [{2}, 0, 0], to: [{3}, {4}, {5}]}}, divisions: {7}, cells: {8}, sides: {{left: inside, bottom: on_x, top: on_y, back: ends, front: ends}}}}
physics: solid
materials: {{steel: {{young: {9}, poisson: {10}}}}}
supports: [{{on: ends, fix: z}}, {{on: on_x, fix: y}}, {{on: on_y, fix: x}}]
contact: {{fit: {{master: outside, slave: inside, integration: {11}}}}}
time: {{scheme: static, step: 1, end: 1}}
newton: {{residual: 1e-9}}
)",
      bore, shaft, inner, outer, std::numbers::pi / 2, length, divisions(fit.shaft), divisions(fit.ring),
      word_of(fit.cells), young, poisson, fit.integration);
}

void bend(mesh::Mesh& mesh) {
  for (auto& x : mesh.points)
    x = {x[0] * std::cos(x[1]), x[0] * std::sin(x[1]), x[2]};
}

} // namespace

std::string word_of(CellType cells) {
  std::string word(cell::topology(cells).name);
  std::ranges::transform(word, word.begin(), [](unsigned char letter) { return std::tolower(letter); });
  return word;
}

double lame_pressure(bool ends_held, double bore) {
  const double e = ends_held ? young / (1 - poisson * poisson) : young;
  const double nu = ends_held ? poisson / (1 - poisson) : poisson;
  const double widening =
      inner * ((outer * outer + inner * inner) / (outer * outer - inner * inner) + nu); // u E/p of the ring
  // Of the shaft, whose pressure is less by inner/shaft.
  const double narrowing = inner * ((shaft * shaft + bore * bore) / (shaft * shaft - bore * bore) - nu);
  return (shaft - inner) * e / (widening + narrowing);
}

PressureErrors shrink(const ShrinkFit& fit) {
  PressureErrors errors;
  test::Walk walk(deck_of(fit), {{"time.on_failure", "{levels: 0}"}});
  errors.converged = walk.to_end();
  if (errors.converged)
    take_all(
        walk, lame_pressure(fit.ends_held), [](const auto& x) { return in_the_middle(x.y(), length); },
        errors);
  return errors;
}

PressureErrors shrink_in_space(const SolidRing& fit) {
  PressureErrors errors;
  const std::vector<deck::Setting> no_cuts{{"time.on_failure", "{levels: 0}"}};
  const auto study = deck::parse_deck(deck_of(fit), "deck.yaml", no_cuts).runs.front();
  auto mesh = model::load_mesh(study.mesh);
  bend(mesh);
  test::Walk walk(study, std::move(mesh));
  errors.converged = walk.to_end();
  if (errors.converged)
    take_all(
        walk, lame_pressure(true, bore),
        [](const auto& x) {
          return in_the_middle(x.z(), length) &&
                 in_the_middle(std::atan2(x.y(), x.x()), std::numbers::pi / 2);
        },
        errors);
  return errors;
}

double press_discs(CellType cells, CellType below) {
  test::Walk walk(fmt::format(R"(mesh:
  generate:
    - {{name: lower, rectangle: {{from: [0, 0], to: [2, 1]}}, divisions: [3, 2], cells: {}, sides: {{bottom: ground, top: below}}}}
    - {{name: upper, rectangle: {{from: [0, 1], to: [2, 2]}}, divisions: [4, 2], cells: {}, sides: {{top: roof, bottom: above}}}}
physics: axisymmetric
materials: {{rubber: {{young: 2e6, poisson: 0.3}}}}
supports: [{{on: ground, fix: y}}]
loads: [{{pressure: {{on: roof, value: 1e5}}}}]
contact: {{discs: {{master: below, slave: above, integration: mortar}}}}
time: {{scheme: static, step: 1, end: 1}}
newton: {{residual: 1e-13}}
)",
                              word_of(below), word_of(cells)),
                  {{"time.on_failure", "{levels: 0}"}});
  if (!walk.to_end())
    return -1;
  double error = 0;
  for (std::size_t i = 0; i < walk.slave_count(); ++i)
    error = std::max(error, std::abs(walk.pressure(i) / 1e5 - 1));
  return error;
}

/// The faces of a group that lie below x = 0.5.
void halve(mesh::Mesh& mesh, std::string_view name) {
  const auto group = std::ranges::find(mesh.cell_groups, name, &mesh::Group::name);
  std::erase_if(group->items, [&](mesh::CellIndex face) {
    const auto nodes = mesh.nodes_of(face);
    return std::ranges::any_of(
        nodes, [&](auto node) { return mesh.points[static_cast<std::size_t>(node)].x() > 0.5 + 1e-9; });
  });
}

HalfLoaded load_half_block(CellType cells) {
  const auto deck = fmt::format(R"(mesh:
  generate:
    - {{name: lower, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [3, 3, 3], cells: {0}, sides: {{bottom: ground, top: below}}}}
    - {{name: upper, box: {{from: [0, 1, 0], to: [1, 2, 1]}}, divisions: [4, 4, 4], cells: {0}, sides: {{top: roof, bottom: above}}}}
physics: solid
materials: {{rubber: {{young: 2e6, poisson: 0.3}}}}
supports: [{{on: ground, fix: [x, y, z]}}]
loads: [{{pressure: {{on: roof, value: 1e4}}}}]
contact: {{blocks: {{master: below, slave: above, friction: 0.3, integration: mortar}}}}
time: {{scheme: static, step: 1, end: 1}}
newton: {{residual: 1e-12}}
)",
                                word_of(cells));
  const std::vector<deck::Setting> no_cuts{{"time.on_failure", "{levels: 0}"}};
  const auto study = deck::parse_deck(deck, "deck.yaml", no_cuts).runs.front();
  auto mesh = model::load_mesh(study.mesh);
  halve(mesh, "roof");
  test::Walk walk(study, std::move(mesh));
  HalfLoaded result;
  if (!walk.to_end()) {
    result.failure = step::to_string(walk.reports.back().outcome);
    return result;
  }
  result.reaction = std::abs(walk.resultants().force[1] / (0.5 * 1e4) - 1);
  result.open =
      static_cast<int>(std::ranges::count(walk.state().zones.front().status, contact::Status::open));
  result.iterations = walk.reports.back().iterations;
  return result;
}

} // namespace rubato::verification
