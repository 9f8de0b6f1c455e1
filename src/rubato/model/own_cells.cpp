// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/own_cells.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/core/index.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace rubato::model {
namespace {

/// What keeps cells from being dealt out; null: nothing does.
const char* obstacle_to_parts(const Model& model) {
  if (model.heat)
    return "temperatures";
  if (!model.followers.empty())
    return "pressures that follow their faces";
  if (!model.references.empty() || !model.reduction.dependents().empty())
    return "relations or ties";
  if (!model.springs.empty() || !model.connectors.empty() || !model.gauges.empty())
    return "springs or dashpots";
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

std::shared_ptr<const domain::RankParts> implicit_parts(const Model& model) {
  if (model.ranks.is_alone())
    return nullptr;
  const auto rank_of_cell = domain::partition(model.mesh, model.bulk, model.ranks);
  return std::make_shared<const domain::RankParts>(model.mesh, model.bulk, model.dofs, rank_of_cell,
                                                   std::span<const mesh::NodeIndex>(), model.ranks);
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

namespace {

/// Of this rank, by their nodes.
class CellsAtNodes {
public:
  explicit CellsAtNodes(const Model& model) : mesh_(model.mesh), around_(model.mesh.points.size()) {
    for (const auto cell : model.parts->cells())
      for (const auto node : mesh_.nodes_of(cell))
        around_[at(node)].push_back(cell);
  }
  /// Whether a cell has all these nodes.
  bool has(std::span<const mesh::NodeIndex> nodes) const {
    return std::ranges::any_of(around_[at(nodes.front())], [&](mesh::CellIndex cell) {
      const auto of_cell = mesh_.nodes_of(cell);
      return std::ranges::all_of(
          nodes, [&](auto node) { return std::ranges::find(of_cell, node) != of_cell.end(); });
    });
  }

private:
  const mesh::Mesh& mesh_;
  std::vector<std::vector<mesh::CellIndex>> around_;
};

/// Whether this rank is the first of those that may count each of some things.
std::vector<bool> first_of(const std::vector<int>& may, const Ranks& ranks) {
  const auto of_all = ranks.each_of(std::span<const int>(may));
  std::vector<bool> is_own(may.size());
  for (std::size_t i = 0; i < may.size(); ++i) {
    std::size_t rank = 0;
    while (rank < at(ranks.index()) && of_all[rank * may.size() + i] == 0)
      ++rank;
    is_own[i] = rank == at(ranks.index()) && may[i] != 0;
  }
  return is_own;
}

} // namespace

std::vector<load::FollowerPressure> own_followers(const Model& model) {
  if (!model.parts || model.followers.empty())
    return {};
  const CellsAtNodes cells(model);
  auto own = model.followers;
  for (auto& follower : own) {
    std::vector<int> may;
    for (const auto& face : follower.faces) {
      std::vector<mesh::NodeIndex> nodes;
      for (const int dof : face.dofs)
        nodes.push_back(model.node_of(dof));
      may.push_back(cells.has(nodes) ? 1 : 0);
    }
    const auto is_own = first_of(may, model.ranks);
    std::vector<load::FollowerFace> faces;
    for (std::size_t i = 0; i < is_own.size(); ++i)
      if (is_own[i])
        faces.push_back(std::move(follower.faces[i]));
    follower.faces = std::move(faces);
  }
  return own;
}

bool Model::counts(int dof) const {
  return !parts || parts->owns(dof);
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
  if (model.parts) {
    const auto& owned = model.parts->owned();
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values[i] *= owned[i];
  }
  return values;
}

} // namespace rubato::model
