// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/bulk_decks.hpp"

#include <fmt/format.h>

namespace rubato::verification {

std::string cook_deck(int n, std::string_view physics, std::string_view material, double force, double step) {
  return fmt::format(R"(
mesh: {{generate: [{{name: membrane, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [{0}, {0}],
  sides: {{left: held, right: pulled}}}}]}}
physics: {1}
materials: {{it: {{{2}}}}}
functions: {{grows: {{ramp: {{begin: 0, end: 1}}}}}}
supports: [{{on: held, fix: [x, y]}}]
loads: [{{surface_force: {{on: pulled, y: {3}, function: grows}}}}]
probes: {{corner: {{point: [48, 60]}}, middle: {{point: [48, 52]}}}}
time: {{scheme: static, step: {4}, end: 1}}
)",
                     n, physics, material, force / 16, step);
}

Eigen::Vector3d cook_shape(const Eigen::Vector3d& x) {
  return {48 * x[0], (1 - x[0]) * 44 * x[1] + x[0] * (44 + 16 * x[1]), 0};
}

std::string tube_deck(const Tube& tube, std::string_view material, std::string_view inner_support,
                      std::string_view rest) {
  return fmt::format(R"(
mesh: {{generate: [{{name: tube, rectangle: {{from: [{0}, 0], to: [{1}, {2}]}}, divisions: [{3}, 1],
  sides: {{left: inner, bottom: low, top: high}}}}]}}
physics: axisymmetric
materials: {{it: {{{4}}}}}
supports: [{{on: low, fix: y}}, {{on: high, fix: y}}{5}{6}]
probes: {{inner: {{point: [{0}, 0]}}, outer: {{point: [{1}, 0]}}, hold: {{on: inner, field: reaction}}}}
{7}
)",
                     tube.inner, tube.outer, tube.height(), tube.cells, material,
                     inner_support.empty() ? "" : ", ", inner_support, rest);
}

double lame_widening(const Tube& tube, double young, double poisson) {
  const double a = tube.inner * tube.inner, b = tube.outer * tube.outer;
  return tube.inner * (1 + poisson) / young * ((1 - 2 * poisson) * a + b) / (b - a);
}

std::string beam_deck(std::string_view divisions, std::string_view cells, std::string_view material) {
  return fmt::format(R"(
mesh: {{generate: [{{name: beam, box: {{from: [0, 0, 0], to: [20, 2, 2]}}, divisions: {}, cells: {},
  sides: {{left: held, right: pulled}}}}]}}
physics: solid
materials: {{it: {{{}}}}}
supports: [{{on: held, fix: [x, y, z]}}]
loads: [{{surface_force: {{on: pulled, z: 0.25}}}}]
probes: {{end: {{on: pulled, take: mean}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                     divisions, cells, material);
}

} // namespace rubato::verification
