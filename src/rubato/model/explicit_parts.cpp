// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/explicit_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rubato::model {
namespace {

/// What keeps cells from being dealt out; null: nothing does.
const char* obstacle_to_parts(const Model& model) {
  if (model.heat)
    return "temperatures";
  if (!model.followers.empty())
    return "pressures that follow their faces";
  if (!model.springs.empty() || !model.connectors.empty() || !model.gauges.empty())
    return "springs or dashpots";
  if (!model.references.empty() || !model.reduction.dependents().empty())
    return "relations";
  if (!model.study.preload.empty())
    return "preloads";
  if (model.study.base_motion)
    return "base motion";
  if (model.study.modal_damping)
    return "modal damping";
  return nullptr;
}

} // namespace

std::vector<mesh::NodeIndex> contact_nodes(const Model& model) {
  std::vector<mesh::NodeIndex> nodes;
  for (const auto& zone : model.zones)
    for (const auto* surface : {&zone.master, &zone.slave})
      nodes.insert(nodes.end(), surface->nodes.begin(), surface->nodes.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::shared_ptr<const domain::RankParts> explicit_parts(Model& model) {
  if (model.ranks.is_alone())
    return nullptr;
  if (const auto* what = obstacle_to_parts(model)) {
    model.notes.push_back(fmt::format("with {} each of the {} ranks computes all cells of this explicit run, "
                                      "which takes as long as one process does",
                                      what, model.ranks.count()));
    return nullptr;
  }
  const auto rank_of_cell = domain::partition(model.mesh, model.bulk, model.ranks);
  return std::make_shared<const domain::RankParts>(model.mesh, model.bulk, model.dofs, rank_of_cell,
                                                   contact_nodes(model), model.ranks);
}

OwnCells own_cells(const Model& model) {
  OwnCells own;
  const auto take = [&](std::size_t place) {
    own.all.push_back(model.bulk.cells[place]);
    if (model.bulk.is_constant(place))
      own.constant.push_back(model.bulk.cells[place]);
    else
      own.nonlinear.push_back(place);
  };
  if (model.parts)
    std::ranges::for_each(model.parts->places(), take);
  else
    for (std::size_t place = 0; place < model.bulk.cells.size(); ++place)
      take(place);
  return own;
}

Eigen::VectorXd counted_once(const Model& model, Eigen::VectorXd values) {
  return model.parts ? values.cwiseProduct(model.parts->owned()) : std::move(values);
}

} // namespace rubato::model
