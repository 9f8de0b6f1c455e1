// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/med_file.hpp"
#include "rubato/mesh/io/med_library.hpp"
#include "rubato/mesh/io/med_numbering.hpp"

#include <fmt/format.h>
#include <med.h>

#include <algorithm>
#include <limits>
#include <map>

namespace rubato::mesh {
namespace {

constexpr med_float no_time = 0.0;

/// The set of groups (by their place in the list) that share the same members, and its family's number.
using FamilyOfSet = std::map<std::vector<std::size_t>, med_int>;

struct Families {
  std::vector<med_int> of_item; ///< 0 for an item in no group
  FamilyOfSet numbers;
};

/// Cuts groups into families: items that are in exactly the same groups. Numbers are `sign`, 2·`sign`, …
/// (MED: positive for nodes, negative for cells). A group without members gets a family without members.
Families families_of(const std::vector<Group>& groups, std::size_t item_count, int sign) {
  std::vector<std::vector<std::size_t>> sets(item_count);
  for (std::size_t group = 0; group < groups.size(); ++group)
    for (const auto item : groups[group].items)
      sets[static_cast<std::size_t>(item)].push_back(group);

  Families families;
  const auto number_of = [&](const std::vector<std::size_t>& set) {
    const auto next = sign * static_cast<med_int>(families.numbers.size() + 1);
    return families.numbers.try_emplace(set, next).first->second;
  };
  families.of_item.assign(item_count, 0);
  for (std::size_t item = 0; item < item_count; ++item)
    if (!sets[item].empty())
      families.of_item[item] = number_of(sets[item]);
  for (std::size_t group = 0; group < groups.size(); ++group)
    if (groups[group].items.empty())
      number_of({group});
  return families;
}

void write_families(const med::File& file, const std::string& mesh, const std::vector<Group>& groups,
                    const FamilyOfSet& families) {
  for (const auto& [set, number] : families) {
    std::vector<std::string> names;
    for (const auto group : set)
      names.push_back(groups[group].name);
    const auto family = fmt::format("FAM_{}_{}", number, names.front()).substr(0, med::name_size);
    file.check(med::library().family_create(file.id(), mesh.c_str(), family.c_str(), number,
                                            static_cast<med_int>(names.size()),
                                            med::joined_texts(names, med::group_name_size).c_str()),
               "a family");
  }
}

void write_header(const med::File& file, const std::string& name, const Mesh& mesh) {
  const bool flat = mesh.dimension == 2;
  const auto axes =
      med::joined_texts(flat ? std::vector<std::string>{"X", "Y"} : std::vector<std::string>{"X", "Y", "Z"},
                        med::short_name_size);
  int own_dimension = 0;
  for (const auto& block : mesh.blocks)
    own_dimension = std::max(own_dimension, cell::topology(block.type).dimension);
  const std::string no_units(axes.size(), ' ');
  file.check(med::library().mesh_create(file.id(), name.c_str(), mesh.dimension, own_dimension,
                                        MED_UNSTRUCTURED_MESH, "", "", MED_SORT_DTIT, MED_CARTESIAN,
                                        axes.c_str(), no_units.c_str()),
             "the mesh");
  file.check(med::library().family_create(file.id(), name.c_str(), "FAMILLE_ZERO", 0, 0, MED_NO_GROUP),
             "a family");
}

void write_numbers(const med::File& file, const std::string& name, med_entity_type entity,
                   med_geometry_type geometry, const std::vector<std::int64_t>& numbers) {
  if (numbers.empty())
    return;
  const auto fits = [](std::int64_t number) {
    return number >= std::numeric_limits<med_int>::min() && number <= std::numeric_limits<med_int>::max();
  };
  const auto misfit = std::ranges::find_if_not(numbers, fits);
  if (misfit != numbers.end())
    file.refuse(fmt::format("cannot hold the number {}, it is beyond MED's integers", *misfit));
  const std::vector<med_int> values(numbers.begin(), numbers.end());
  file.check(med::library().mesh_entity_number_write(file.id(), name.c_str(), MED_NO_DT, MED_NO_IT, entity,
                                                     geometry, static_cast<med_int>(values.size()),
                                                     values.data()),
             "the numbers");
}

void write_names(const med::File& file, const std::string& mesh, med_entity_type entity,
                 med_geometry_type geometry, const std::vector<std::string>& names) {
  if (names.empty())
    return;
  file.check(med::library().mesh_entity_name_write(file.id(), mesh.c_str(), MED_NO_DT, MED_NO_IT, entity,
                                                   geometry, static_cast<med_int>(names.size()),
                                                   med::joined_texts(names, med::short_name_size).c_str()),
             "the names");
}

void write_family_numbers(const med::File& file, const std::string& name, med_entity_type entity,
                          med_geometry_type geometry, std::span<const med_int> families) {
  file.check(med::library().mesh_entity_family_number_write(
                 file.id(), name.c_str(), MED_NO_DT, MED_NO_IT, entity, geometry,
                 static_cast<med_int>(families.size()), families.data()),
             "the families");
}

void write_nodes(const med::File& file, const std::string& name, const Mesh& mesh,
                 std::span<const med_int> families) {
  std::vector<med_float> coordinates;
  coordinates.reserve(mesh.points.size() * static_cast<std::size_t>(mesh.dimension));
  for (const auto& point : mesh.points)
    coordinates.insert(coordinates.end(), point.data(), point.data() + mesh.dimension);
  file.check(med::library().mesh_node_coordinate_write(file.id(), name.c_str(), MED_NO_DT, MED_NO_IT, no_time,
                                                       MED_FULL_INTERLACE, mesh.node_count(),
                                                       coordinates.data()),
             "the nodes");
  write_numbers(file, name, MED_NODE, MED_NONE, mesh.node_numbers);
  write_names(file, name, MED_NODE, MED_NONE, mesh.node_names);
  write_family_numbers(file, name, MED_NODE, MED_NONE, families);
}

std::vector<med_int> nodes_in_med_order(const CellBlock& block) {
  const auto order = med::node_order(block.type);
  const auto width = static_cast<std::size_t>(cell::topology(block.type).node_count);
  std::vector<med_int> nodes(block.nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto local = i % width;
    nodes[i - local + (order.empty() ? local : order[local])] = block.nodes[i] + 1;
  }
  return nodes;
}

void write_block(const med::File& file, const std::string& name, const CellBlock& block,
                 std::span<const med_int> families) {
  const auto geometry = med::geometry_of(block.type);
  file.check(med::library().mesh_element_connectivity_write(
                 file.id(), name.c_str(), MED_NO_DT, MED_NO_IT, no_time, MED_CELL, geometry, MED_NODAL,
                 MED_FULL_INTERLACE, block.cell_count(), nodes_in_med_order(block).data()),
             "the cells");
  write_numbers(file, name, MED_CELL, geometry, block.numbers);
  write_names(file, name, MED_CELL, geometry, block.names);
  write_family_numbers(file, name, MED_CELL, geometry, families);
}

void check_item_names(const std::vector<std::string>& names, std::string_view what) {
  for (const auto& name : names)
    if (name.size() > med::short_name_size)
      throw InputError(fmt::format("the name '{}' of a {} does not fit into a MED file: at most {} letters",
                                   name, what, med::short_name_size));
}

void check_names(const Mesh& mesh, const std::string& name) {
  if (name.empty() || name.size() > med::name_size)
    throw InputError(
        fmt::format("mesh name '{}' does not fit into a MED file: 1 to {} letters", name, med::name_size));
  for (const auto& group : group_names(mesh))
    if (group.size() > med::group_name_size)
      throw InputError(fmt::format("group name '{}' does not fit into a MED file: at most {} letters", group,
                                   med::group_name_size));
  check_item_names(mesh.node_names, "node");
  for (const auto& block : mesh.blocks)
    check_item_names(block.names, "cell");
}

/// What the file needs at most: its numbers, and what MED and HDF5 tell about each part.
std::uintmax_t room_for(const Mesh& mesh) {
  constexpr std::uintmax_t of_file = 32768;
  constexpr std::uintmax_t of_group = 8192;
  constexpr std::uintmax_t number = 8;
  constexpr std::uintmax_t of_node = 5; // coordinates, own number, family
  constexpr std::uintmax_t of_name = med::short_name_size / number;
  std::uintmax_t numbers = of_node * mesh.points.size() + of_name * mesh.node_names.size();
  for (const auto& block : mesh.blocks)
    numbers +=
        block.nodes.size() + 2 * static_cast<std::size_t>(block.cell_count()) + of_name * block.names.size();
  return of_file + of_group * (mesh.node_groups.size() + mesh.cell_groups.size()) + number * numbers;
}

void write_content(const med::File& file, const Mesh& mesh, const std::string& name) {
  const auto of_nodes = families_of(mesh.node_groups, mesh.points.size(), +1);
  const auto of_cells = families_of(mesh.cell_groups, static_cast<std::size_t>(mesh.cell_count()), -1);
  write_header(file, name, mesh);
  write_families(file, name, mesh.node_groups, of_nodes.numbers);
  write_families(file, name, mesh.cell_groups, of_cells.numbers);
  write_nodes(file, name, mesh, of_nodes.of_item);
  std::size_t first = 0;
  for (const auto& block : mesh.blocks) {
    const auto count = static_cast<std::size_t>(block.cell_count());
    if (count > 0)
      write_block(file, name, block, std::span(of_cells.of_item).subspan(first, count));
    first += count;
  }
}

} // namespace

void write_med(const std::filesystem::path& path, const Mesh& mesh, const std::string& name) {
  check_names(mesh, name);
  write_whole(path, [&](const std::filesystem::path& beside) {
    require_room(beside, room_for(mesh)); // MED does not survive a full disk
    med::File file(beside, med::File::Access::create, path);
    write_content(file, mesh, name);
    file.close();
  });
}

} // namespace rubato::mesh
