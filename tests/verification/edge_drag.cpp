// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/edge_drag.hpp"

#include "rubato/model/build_model.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include "verification/mortar_runs.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::verification {
namespace {

constexpr double block_length = 6, block_height = 2; ///< of the block
constexpr double drag_begins = 1;                    ///< instant at which the drag begins
constexpr double rail_face = 0.5;
constexpr int steps_of_face = 8;

bool is_solid(CellType cells) {
  return cell::topology(cells).dimension == 3;
}

/// Of the drag, in faces of the rail. Over each of them the drag repeats itself.
int drag_faces(CellType cells) {
  return is_solid(cells) && cell::topology(cells).order == 2 ? 4 : 12;
}

double drag_step(CellType cells) {
  return drag_begins / (steps_of_face * drag_faces(cells));
}

std::string bodies_of(CellType cells) {
  return is_solid(cells) ? fmt::format(R"(
    - {{name: rail, box: {{from: [-1, -2, 0], to: [14, 0, 1]}}, divisions: [30, 3, 2], cells: {0}, sides: {{bottom: ground, top: above}}}}
    - {{name: block, box: {{from: [0, 0, 0.2], to: [6, 2, 0.8]}}, divisions: [6, 2, 1], cells: {0}, sides: {{bottom: sole, top: held}}}})",
                                       word_of(cells))
                         : fmt::format(R"(
    - {{name: rail, rectangle: {{from: [-1, -3], to: [14, 0]}}, divisions: [30, 6], cells: {0}, sides: {{bottom: ground, top: above}}}}
    - {{name: block, rectangle: {{from: [0, 0], to: [6, 2]}}, divisions: [6, 2], cells: {0}, sides: {{bottom: sole, top: held}}}})",
                                       word_of(cells));
}

std::string deck_of(const EdgeDrag& how) {
  return fmt::format(R"(mesh:
  generate:{}
physics: {}
materials: {{steel: {{young: 2e5, poisson: 0.3}}}}
functions: {{press: {{ramp: [0, {}]}}, go: {{ramp: [{}, {}]}}}}
supports:
  - {{on: ground, fix: [x, y{}]}}
  - {{on: held, y: {{value: -0.02, function: press}}, x: {{value: {}, function: go}}{}}}
contact: {{rub: {{slave: {}, master: {}, friction: {}}}}}
time: {{scheme: static, step: {}, end: {}}}
)",
                     bodies_of(how.cells), is_solid(how.cells) ? "solid" : "plane_strain", drag_begins,
                     drag_begins, 2 * drag_begins, is_solid(how.cells) ? ", z" : "",
                     rail_face * drag_faces(how.cells), is_solid(how.cells) ? ", z: 0" : "",
                     how.rail_is_slave ? "above" : "sole", how.rail_is_slave ? "sole" : "above", how.friction,
                     drag_step(how.cells), 2 * drag_begins);
}

/// How far the sole of the profile is above that of the block.
double rise_at(const EdgeDrag& how, double x) {
  const double from_start = how.degrees > 0 ? x : block_length - x;
  const double slope = std::tan(std::abs(how.degrees) * std::numbers::pi / 180);
  const double flat = how.profile == Profile::ski ? 4 : 3;
  return std::max(0., from_start - flat) * slope +
         (how.profile == Profile::wedge ? std::max(0., flat - from_start) * slope / 2 : 0);
}

/// The block in its shape, its lowest place at the rail.
mesh::Mesh shaped(const EdgeDrag& how, mesh::Mesh mesh) {
  const auto nodes = mesh::nodes_named(mesh, "block");
  const double angle = how.degrees * std::numbers::pi / 180;
  double lowest = INFINITY;
  for (const auto node : nodes) {
    auto& x = mesh.points[static_cast<std::size_t>(node)];
    if (how.profile == Profile::tilted)
      x = {x[0] * std::cos(angle) - x[1] * std::sin(angle), x[0] * std::sin(angle) + x[1] * std::cos(angle),
           x[2]};
    else
      x[1] += rise_at(how, x[0]) * (1 - x[1] / block_height);
    lowest = std::min(lowest, x[1]);
  }
  for (const auto node : nodes)
    mesh.points[static_cast<std::size_t>(node)][1] -= lowest;
  return mesh;
}

} // namespace

EdgeDragged drag_edge(const EdgeDrag& how) {
  const auto study = test::study_of(deck_of(how));
  test::Walk walk(study, shaped(how, model::load_mesh(study.mesh)));
  EdgeDragged result;
  double along = 0, normal = 0, before = 0, strain = 0;
  std::size_t attempts = 0;
  while (!walk.finished()) {
    if (!walk.advance()) {
      result.failure = step::to_string(walk.reports.back().outcome);
      return result;
    }
    const auto& energy = walk.simulation.energy();
    if (walk.state().t < drag_begins + 0.5 * drag_step(how.cells)) {
      before = energy.impact;
      attempts = walk.reports.size();
      continue;
    }
    const auto force = walk.resultants().force;
    along += (how.rail_is_slave ? 1 : -1) * force[0];
    normal += std::abs(force[1]);
    strain = std::max(strain, energy.strain);
    result.impact = energy.impact - before;
  }
  for (auto i = attempts; i < walk.reports.size(); ++i)
    result.iterations += walk.reports[i].iterations;
  result.iterations /= steps_of_face * drag_faces(how.cells);
  result.drag = along / normal;
  result.impact /= strain;
  return result;
}

} // namespace rubato::verification
