// SPDX-License-Identifier: LGPL-3.0-or-later
/// Groups that are made of others: what each takes, where a study names it, and in which order they are made.
#pragma once

#include "rubato/study/mesh_source.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::study {

/// Where the deck has the names of the groups that a group is made of.
enum class GroupSources {
  list,  ///< a list below the kind, at least two
  name,  ///< one name below the kind
  of,    ///< one name below 'of', beside the kind
  any_of ///< the same, everything when it is not given
};

/// What a kind of group takes.
struct GroupKindEntry {
  GroupKind kind;
  std::string_view name; ///< in a deck
  std::string_view meaning;
  GroupSources sources;
  bool within = false; ///< a largest distance
  bool take = false;   ///< nodes, faces or cells
  bool angle = false;
};

inline constexpr std::array<GroupKindEntry, 13> group_kinds{{
    {GroupKind::union_of, "union", "what is in one of these groups, or in several", GroupSources::list},
    {GroupKind::intersection, "intersection", "what is in all of these groups", GroupSources::list},
    {GroupKind::difference, "difference", "what is in the first of these groups and in none of the others",
     GroupSources::list},
    {GroupKind::box, "box", "what is in a box, in 2D in a rectangle", GroupSources::any_of, false, true},
    {GroupKind::sphere, "sphere", "what is in a sphere, in 2D in a circle; with 'within' on its surface",
     GroupSources::any_of, true, true},
    {GroupKind::cylinder, "cylinder", "what is in a cylinder without ends; with 'within' on its surface",
     GroupSources::any_of, true, true},
    {GroupKind::plane, "plane", "what is on a plane, in 2D on a straight line", GroupSources::any_of, true,
     true},
    {GroupKind::normal, "normal", "faces of the bodies whose outward normal has this direction",
     GroupSources::any_of, false, false, true},
    {GroupKind::skin, "skin", "faces of a group of cells, or of all, that bound the bodies",
     GroupSources::name},
    {GroupKind::nodes_of, "nodes_of", "the nodes of a group of cells", GroupSources::name},
    {GroupKind::corners_of, "corners_of", "nodes of a group at corners of its cells", GroupSources::name},
    {GroupKind::middles_of, "middles_of",
     "nodes of a group that are no corners: in the middle of edges, faces and cells", GroupSources::name},
    {GroupKind::along, "along", "nodes of a group ordered along this direction", GroupSources::of},
}};

constexpr const GroupKindEntry& entry_of(GroupKind kind) {
  return group_kinds[static_cast<std::size_t>(kind)];
}

/// "mesh.groups.top".
std::string path_of(const MadeGroup& group);
/// The path of the i-th name in `group.of`: "mesh.groups.top.union.1", "mesh.groups.top.of".
std::string path_of_source(const MadeGroup& group, std::size_t i);

/// In which order groups are made, so that each comes after those it is made of.
struct GroupOrder {
  std::vector<std::size_t> order; ///< places in the list; without those that wait for one another
  std::vector<std::string> cycle; ///< names that wait for one another, the first again at the end; or empty
};
GroupOrder order_of(std::span<const MadeGroup> groups);

} // namespace rubato::study
