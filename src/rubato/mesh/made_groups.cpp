// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/made_groups.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/face_cells.hpp"
#include "rubato/mesh/group_sources.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/rounding.hpp"
#include "rubato/mesh/shape_groups.hpp"
#include "rubato/study/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace rubato::mesh {
namespace {

using study::GroupKind;

using Items = std::vector<std::int32_t>;

Items united(const Items& a, const Items& b) {
  Items all;
  std::ranges::set_union(a, b, std::back_inserter(all));
  return all;
}

Items shared(const Items& a, const Items& b) {
  Items both;
  std::ranges::set_intersection(a, b, std::back_inserter(both));
  return both;
}

Items without(const Items& a, const Items& b) {
  Items rest;
  std::ranges::set_difference(a, b, std::back_inserter(rest));
  return rest;
}

GroupItems combined(const study::MadeGroup& group, const GroupSources& sources) {
  const auto lists = sources.alike(group);
  auto items = lists.front().items;
  for (std::size_t i = 1; i < lists.size(); ++i)
    items = group.kind == GroupKind::union_of       ? united(items, lists[i].items)
            : group.kind == GroupKind::intersection ? shared(items, lists[i].items)
                                                    : without(items, lists[i].items);
  if (items.empty())
    refuse(study::path_of(group), group.kind == GroupKind::intersection
                                      ? "found nothing that these groups share"
                                      : fmt::format("nothing is left of '{}'", group.of.front()));
  return {lists.front().are_cells, std::move(items)};
}

/// The corners of the cells of a group, or those of their nodes that are none. Nodes of a group of nodes have
/// the roles that all cells of the mesh give them.
GroupItems by_role(const study::MadeGroup& group, const GroupSources& sources) {
  const bool corners = group.kind == GroupKind::corners_of;
  const bool of_cells = sources.is_of_cells(group);
  const auto roles = of_cells ? sources.roles_in(sources.cells(group)) : sources.roles();
  const auto nodes = of_cells ? sources.nodes_of(sources.cells(group)) : sources.nodes(group);
  GroupItems found{false, {}};
  for (const auto node : nodes)
    if (roles[static_cast<std::size_t>(node)] == (corners ? NodeRole::corner : NodeRole::middle))
      found.items.push_back(node);
  if (found.items.empty())
    refuse(study::path_of_source(group, 0),
           fmt::format("found '{}', which has no {}", group.of.front(),
                       corners ? "corners of cells" : "nodes between corners: its cells are linear"));
  return found;
}

GroupItems in_line(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                   double rounding) {
  const Eigen::Vector3d direction =
      Eigen::Vector3d(group.direction[0], group.direction[1], group.direction[2]).normalized();
  const auto nodes = sources.nodes(group);
  auto places = transformed<std::pair<double, NodeIndex>>(nodes, [&](NodeIndex node) {
    return std::pair(direction.dot(mesh.points[static_cast<std::size_t>(node)]), node);
  });
  std::ranges::sort(places);
  GroupItems line{false, nodes};
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0 && places[i].first - places[i - 1].first <= rounding)
      refuse(study::path_of(group) + ".along",
             fmt::format("found {} and {}, which are equally far along this direction, expected one that "
                         "tells them apart",
                         place_label(mesh, places[i - 1].second), place_label(mesh, places[i].second)));
    line.ordered.push_back(places[i].second);
  }
  return line;
}

class GroupMaker {
public:
  GroupMaker(const Mesh& mesh, std::span<const study::MadeGroup> groups)
      : mesh_(mesh), groups_(groups), faces_(mesh), rounding_(shape_rounding * diagonal(mesh)),
        sources_(mesh, faces_) {}

  void run() {
    for (const auto i : study::order_of(groups_).order)
      try_to_make(groups_[i]);
    if (!faults_.empty())
      throw InputError(faults_);
  }

  const FaceCells& faces() const { return faces_; }
  const GroupItems& made(const std::string& name) const { return sources_.made(name); }
  bool is_made(const std::string& name) const { return sources_.is_made(name); }

private:
  void try_to_make(const study::MadeGroup& group) {
    const bool waits_for_faulty =
        std::ranges::any_of(group.of, [&](const std::string& name) { return faulty_.contains(name); });
    try {
      if (!waits_for_faulty) {
        refuse_known_name(group);
        sources_.add(group.name, make(group));
        return;
      }
    } catch (const InputError& error) {
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
    }
    faulty_.insert(group.name);
  }

  void refuse_known_name(const study::MadeGroup& group) const {
    const auto path = study::path_of(group);
    if (mesh_.node_group(group.name) != nullptr || mesh_.cell_group(group.name) != nullptr)
      refuse(path, fmt::format("the mesh has a group '{}' already, expected another name", group.name));
    if (!find_nodes(mesh_, group.name).nodes.empty())
      refuse(path, fmt::format("a node of the mesh is called '{}', expected another name", group.name));
  }

  GroupItems make(const study::MadeGroup& group) {
    switch (group.kind) {
    case GroupKind::union_of:
    case GroupKind::intersection:
    case GroupKind::difference:
      return combined(group, sources_);
    case GroupKind::nodes_of:
      return {false, sources_.nodes_of(sources_.cells(group))};
    case GroupKind::corners_of:
    case GroupKind::middles_of:
      return by_role(group, sources_);
    case GroupKind::along:
      return in_line(group, sources_, mesh_, rounding_);
    case GroupKind::normal:
      return facing(group, sources_, mesh_, faces_);
    case GroupKind::skin:
      return outside_of(group, sources_, mesh_, faces_);
    default:
      return inside_of(group, sources_, mesh_, faces_, rounding_);
    }
  }

  const Mesh& mesh_;
  std::span<const study::MadeGroup> groups_;
  FaceCells faces_;
  double rounding_; ///< [length]
  GroupSources sources_;
  std::set<std::string> faulty_;
  std::vector<Fault> faults_;
};

/// The mesh, with faces that become cells after its own.
MeshBuilder builder_of(const Mesh& mesh, std::span<const SurfaceFace> faces) {
  auto builder = MeshBuilder::on_nodes_of(mesh);
  for (const auto& block : mesh.blocks)
    for (CellIndex i = 0; i < block.cell_count(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      builder.add_cell(block.type, block.cell(i), block.numbers[at],
                       block.names.empty() ? std::string() : block.names[at]);
    }
  for (const auto& face : faces)
    builder.add_cell(face.type, face.nodes());
  for (const auto& group : mesh.cell_groups)
    builder.add_to_cell_group(group.name, group.items);
  return builder;
}

} // namespace

Mesh with_groups(Mesh mesh, std::span<const study::MadeGroup> groups) {
  if (groups.empty())
    return mesh;
  GroupMaker maker(mesh, groups);
  maker.run();
  auto builder = builder_of(mesh, maker.faces().added());
  for (const auto& group : groups) {
    const auto& made = maker.made(group.name);
    if (made.are_cells)
      builder.add_to_cell_group(group.name, made.items);
    else
      builder.add_to_node_group(group.name, made.items);
  }
  auto result = std::move(builder).build();
  for (auto& group : result.node_groups)
    if (maker.is_made(group.name))
      group.ordered = maker.made(group.name).ordered;
  return result;
}

} // namespace rubato::mesh
