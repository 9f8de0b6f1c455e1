// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/group_sources.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/study/groups.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace rubato::mesh {
namespace {

void mark(std::vector<NodeRole>& roles, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
  if (shape.dimension == 0)
    return;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool corner = i < static_cast<std::size_t>(shape.corner_count);
    auto& role = roles[static_cast<std::size_t>(nodes[i])];
    role = std::max(role, corner ? NodeRole::corner : NodeRole::middle);
  }
}

} // namespace

void refuse(const std::string& path, std::string text) {
  throw InputError(std::vector{fault_at(path, path + ": " + std::move(text))});
}

std::string place_label(const Mesh& mesh, NodeIndex node) {
  const auto& at = mesh.points[static_cast<std::size_t>(node)];
  const auto place = mesh.dimension == 3 ? fmt::format("{:.6g}, {:.6g}, {:.6g}", at[0], at[1], at[2])
                                         : fmt::format("{:.6g}, {:.6g}", at[0], at[1]);
  return fmt::format("{} ({})", node_name(mesh, node), place);
}

bool GroupSources::is_of_everything(const study::MadeGroup& group) {
  return group.of.empty() || group.of.front() == study::everywhere;
}

bool GroupSources::is_of_cells(const study::MadeGroup& group) const {
  return !is_of_everything(group) && cells_named(group.of.front()) != nullptr;
}

std::vector<NodeIndex> GroupSources::nodes(const study::MadeGroup& group) const {
  if (is_of_everything(group)) {
    std::vector<NodeIndex> all(mesh_.points.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  const auto& name = group.of.front();
  if (auto nodes = nodes_named(name); !nodes.empty())
    return nodes;
  return nodes_of(cells(group));
}

std::vector<CellIndex> GroupSources::cells(const study::MadeGroup& group) const {
  if (is_of_everything(group)) {
    std::vector<CellIndex> bulk;
    for_each_cell(mesh_, [&](CellIndex cell, const cell::CellTopology& shape, std::span<const NodeIndex>) {
      if (shape.dimension == mesh_.dimension)
        bulk.push_back(cell);
    });
    return bulk;
  }
  const auto& name = group.of.front();
  const auto path = study::path_of_source(group, 0);
  const auto* found = cells_named(name);
  if (found == nullptr && !nodes_named(name).empty())
    refuse(path, fmt::format("found '{}', which holds nodes, expected a group of cells", name));
  if (found == nullptr)
    refuse_unknown(path, name);
  if (found->empty())
    refuse(path, fmt::format("group '{}' is empty, expected cells in it", name));
  return *found;
}

std::vector<GroupItems> GroupSources::alike(const study::MadeGroup& group) const {
  const auto is_of_cells = [&](const std::string& name) { return cells_named(name) != nullptr; };
  const bool are_cells = std::ranges::all_of(group.of, is_of_cells);
  for (std::size_t i = 0; i < group.of.size(); ++i)
    if (!is_of_cells(group.of[i]) && nodes_named(group.of[i]).empty())
      refuse_unknown(study::path_of_source(group, i), group.of[i]);
  std::vector<GroupItems> lists;
  for (std::size_t i = 0; i < group.of.size(); ++i) {
    const auto& name = group.of[i];
    auto items = are_cells ? *cells_named(name) : nodes_named(name);
    if (!are_cells && items.empty())
      refuse(study::path_of_source(group, i),
             fmt::format("found '{}', which holds cells, beside nodes, expected groups of one kind; "
                         "'nodes_of' makes nodes of cells",
                         name));
    lists.push_back({are_cells, std::move(items)});
  }
  return lists;
}

std::vector<NodeIndex> GroupSources::nodes_of(const std::vector<CellIndex>& cells) const {
  std::vector<NodeIndex> nodes;
  for (const auto cell : cells) {
    const auto of_cell = faces_.nodes_of(cell);
    nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
  }
  sort_without_repeats(nodes);
  return nodes;
}

std::vector<NodeRole> GroupSources::roles_in(const std::vector<CellIndex>& cells) const {
  std::vector<NodeRole> roles(mesh_.points.size(), NodeRole::none);
  for (const auto cell : cells)
    mark(roles, cell::topology(faces_.type_of(cell)), faces_.nodes_of(cell));
  return roles;
}

std::vector<NodeRole> GroupSources::roles() const {
  std::vector<NodeRole> roles(mesh_.points.size(), NodeRole::none);
  for_each_cell(mesh_, [&](CellIndex, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    mark(roles, shape, nodes);
  });
  return roles;
}

const std::vector<std::int32_t>* GroupSources::cells_named(const std::string& name) const {
  if (const auto made = made_.find(name); made != made_.end())
    return made->second.are_cells ? &made->second.items : nullptr;
  const auto* group = mesh_.cell_group(name);
  return group == nullptr ? nullptr : &group->items;
}

std::vector<NodeIndex> GroupSources::nodes_named(const std::string& name) const {
  if (const auto made = made_.find(name); made != made_.end())
    return made->second.are_cells ? std::vector<NodeIndex>{} : made->second.items;
  if (const auto* group = mesh_.node_group(name))
    return group->items;
  return mesh_.cell_group(name) != nullptr ? std::vector<NodeIndex>{} : find_nodes(mesh_, name).nodes;
}

void GroupSources::refuse_unknown(const std::string& path, const std::string& name) const {
  if (mesh_.node_group(name) != nullptr)
    refuse(path, fmt::format("group '{}' is empty, expected nodes in it", name));
  auto known = group_names(mesh_);
  for (const auto& entry : made_)
    known.push_back(entry.first);
  refuse(path, fmt::format("found {}, expected a group or a node of the mesh{}", shown(name),
                           suggestion(name, known)));
}

} // namespace rubato::mesh
