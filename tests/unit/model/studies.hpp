// SPDX-License-Identifier: LGPL-3.0-or-later
/// Studies and models from decks, shortly.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include "support/model_of.hpp"
#include "support/two_blocks.hpp"
#include <string>
#include <string_view>

namespace rubato::test {

/// Throws InputError with the places of the deck.
inline model::Model located_model(std::string_view deck) {
  const auto read = deck::parse_deck(deck, "deck.yaml");
  try {
    return model::build_model(read.runs.front());
  } catch (const InputError& error) {
    throw read.places.front().located(error);
  }
}

/// Sum over all nodes of the force in x, y, z.
inline Eigen::Vector3d resultant(const model::Model& model, const Eigen::VectorXd& force) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto node : model.dofs.nodes)
    for (int i = 0; i < model.dofs.components; ++i)
      sum[i] += force[model.dofs.dof(node, i)];
  return sum;
}

/// A box of 2 × 1 × 0.5 with named sides, clamped at its left end; its own time, without loads.
inline const std::string box_deck = R"(mesh:
  generate:
    - name: box
      box: {from: [0, 0, 0], to: [2, 1, 0.5]}
      divisions: [2, 2, 1]
      cells: hexa8
      sides: {left: held, right: end, top: roof}
      edges: {right_top: ridge}
physics: solid
materials:
  steel: {young: 200e9, poisson: 0.3, density: 7800, cells: all}
supports:
  - {on: held, fix: [x, y, z]}
time: {scheme: hht, alpha: 0, step: 1e-4, end: 4e-4}
)";

} // namespace rubato::test
