// SPDX-License-Identifier: LGPL-3.0-or-later
/// A small sound deck that tests spoil.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace rubato::test {

/// Two rectangles on one another, held at the left; the upper one is pressed down at its tip. Four steps.
inline const std::string two_blocks = R"(title: two blocks
mesh:
  generate:
    - name: upper
      rectangle: {from: [0, 0], to: [1, 0.2]}
      divisions: [4, 2]
      sides: {left: held, bottom: upper_face, top: roof}
      points: {right_top: tip}
    - name: lower
      rectangle: {from: [0, -0.2], to: [1, 0]}
      divisions: [4, 2]
      sides: {left: held, top: lower_face}
physics: plane_stress
thickness: 1
materials:
  steel: {young: 200e9, poisson: 0.3, density: 7800, cells: all}
supports:
  - {on: held, fix: [x, y]}
loads:
  - nodal_force: {on: tip, y: -1e7}
contact:
  interface: {master: upper_face, slave: lower_face, integration: nodes, friction: 0.2, exclude_nodes: [held]}
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}
probes:
  end: {node: tip}
)";

/// `text` with the only occurrence of `old` replaced.
inline std::string with(std::string text, std::string_view old, std::string_view replacement) {
  const auto at = text.find(old);
  if (at == std::string::npos || text.find(old, at + 1) != std::string::npos)
    throw std::invalid_argument("not exactly once in the deck: " + std::string(old));
  return text.replace(at, old.size(), replacement);
}

/// The upper block is pressed and pulled on the lower one in `preload`; then time goes on, in `after`, to
/// `end`.
inline std::string preloaded_blocks(std::string_view end) {
  return with(two_blocks, "nodal_force: {on: tip, y: -1e7}", "surface_force: {on: roof, x: 2e5, y: -1e6}") +
         "runs:\n"
         "  preload: {time: {scheme: static, alpha: ~, step: 0.5, end: 1}}\n"
         "  after: {time: {end: " +
         std::string(end) + ", start: {from: preload}}}\n";
}

} // namespace rubato::test
