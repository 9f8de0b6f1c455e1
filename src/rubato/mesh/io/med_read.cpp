// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/med_file.hpp"
#include "rubato/mesh/io/med_library.hpp"
#include "rubato/mesh/io/med_numbering.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <med.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace rubato::mesh {
namespace {

struct Header {
  std::string name;
  int space_dimension = 0;
  med_mesh_type type = MED_UNDEF_MESH_TYPE;
  med_axis_type axes = MED_UNDEF_AXIS_TYPE;
  int steps = 0;
};

Header header_of(const med::File& file, int index) {
  const auto axes = med::library().mesh_axis_count(file.id(), index);
  if (axes < 1 || axes > 3)
    file.refuse(fmt::format("is damaged: its mesh number {} cannot be read", index));
  auto name = med::text_buffer(1, med::name_size);
  auto description = med::text_buffer(1, MED_COMMENT_SIZE);
  auto time_unit = med::text_buffer(1, MED_LNAME_SIZE);
  auto axis_names = med::text_buffer(static_cast<std::size_t>(axes), med::short_name_size);
  auto axis_units = axis_names;
  med_int space = 0;
  med_int own = 0;
  med_int steps = 0;
  med_sorting_type sorting = MED_SORT_UNDEF;
  Header header;
  file.check(med::library().mesh_info(file.id(), index, name.data(), &space, &own, &header.type,
                                      description.data(), time_unit.data(), &sorting, &steps, &header.axes,
                                      axis_names.data(), axis_units.data()),
             "mesh description");
  header.name = med::text_at(name, 0, med::name_size);
  header.space_dimension = space;
  header.steps = steps;
  return header;
}

std::vector<Header> headers_of(const med::File& file) {
  const auto count = med::library().mesh_count(file.id());
  file.check(count, "list of meshes");
  std::vector<Header> headers;
  for (int index = 1; index <= count; ++index)
    headers.push_back(header_of(file, index));
  return headers;
}

Header chosen_header(const med::File& file, const std::string& wanted) {
  const auto headers = headers_of(file);
  if (headers.empty())
    file.refuse("holds no mesh");
  if (wanted.empty() && headers.size() == 1)
    return headers.front();

  std::vector<std::string> names(headers.size());
  std::ranges::transform(headers, names.begin(), &Header::name);
  if (wanted.empty())
    file.refuse(fmt::format("holds {} meshes, name one of them: {}", names.size(), fmt::join(names, ", ")));
  const auto found = std::ranges::find(headers, wanted, &Header::name);
  if (found != headers.end())
    return *found;
  const auto nearest = nearest_word(wanted, names);
  file.refuse(fmt::format("holds no mesh '{}'{}; it holds: {}", wanted,
                          nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest),
                          fmt::join(names, ", ")));
}

void check_kind(const med::File& file, const Header& header) {
  if (header.type != MED_UNSTRUCTURED_MESH)
    file.refuse(
        fmt::format("holds '{}' as a structured grid, an unstructured mesh was expected", header.name));
  if (header.axes != MED_CARTESIAN)
    file.refuse(fmt::format("holds '{}' in cylindrical or spherical axes, Cartesian ones were expected",
                            header.name));
  if (header.space_dimension < 2 || header.space_dimension > 3)
    file.refuse(
        fmt::format("holds '{}' in {}D space, 2D or 3D was expected", header.name, header.space_dimension));
}

/// The entities of one kind (the nodes, or the cells of one geometry) of one mesh at one computation step.
class Entities {
public:
  Entities(const med::File& file, const Header& header) : file_(file), name_(header.name) {
    if (header.steps <= 0)
      file_.refuse(fmt::format("holds '{}' without nodes and cells", name_));
    med_float time = 0.0;
    file_.check(
        med::library().mesh_computation_step_info(file_.id(), name_.c_str(), 1, &step_, &iteration_, &time),
        "mesh step");
  }

  std::size_t count(med_entity_type entity, med_geometry_type geometry, med_data_type data,
                    med_connectivity_mode mode, std::string_view what) const {
    med_bool changed = MED_FALSE;
    med_bool moved = MED_FALSE;
    const auto found = med::library().mesh_entity_count(file_.id(), name_.c_str(), step_, iteration_, entity,
                                                        geometry, data, mode, &changed, &moved);
    return file_.plausible(found, what);
  }

  std::vector<double> coordinates(std::size_t nodes, int dimension) const {
    std::vector<double> values(nodes * static_cast<std::size_t>(dimension));
    file_.check(med::library().mesh_node_coordinate_read(file_.id(), name_.c_str(), step_, iteration_,
                                                         MED_FULL_INTERLACE, values.data()),
                "node coordinates");
    return values;
  }

  /// The cell types of the mesh. Each known one is asked for, because files that other writers make (meshio)
  /// don't say which types there are.
  std::vector<CellType> types() const {
    std::vector<CellType> found;
    for (const auto& cell : cell::all_topologies())
      if (count(MED_CELL, med::geometry_of(cell.type), MED_CONNECTIVITY, MED_NODAL, "cells") > 0)
        found.push_back(cell.type);
    refuse_unknown_types(found.size());
    return found;
  }

  std::vector<med_int> connectivity(med_geometry_type geometry, std::size_t size) const {
    std::vector<med_int> nodes(size);
    file_.check(med::library().mesh_element_connectivity_read(file_.id(), name_.c_str(), step_, iteration_,
                                                              MED_CELL, geometry, MED_NODAL,
                                                              MED_FULL_INTERLACE, nodes.data()),
                "connectivity");
    return nodes;
  }

  /// The numbers the file gives the entities; empty when it gives none.
  std::vector<std::int64_t> numbers(med_entity_type entity, med_geometry_type geometry,
                                    std::size_t size) const {
    if (!has(entity, geometry, MED_NUMBER, size))
      return {};
    std::vector<med_int> values(size);
    file_.check(med::library().mesh_entity_number_read(file_.id(), name_.c_str(), step_, iteration_, entity,
                                                       geometry, values.data()),
                "entity numbers");
    return {values.begin(), values.end()};
  }

  /// The family of every entity; all 0 when the file has none.
  std::vector<med_int> families(med_entity_type entity, med_geometry_type geometry, std::size_t size) const {
    std::vector<med_int> values(size, 0);
    if (has(entity, geometry, MED_FAMILY_NUMBER, size))
      file_.check(med::library().mesh_entity_family_number_read(file_.id(), name_.c_str(), step_, iteration_,
                                                                entity, geometry, values.data()),
                  "families");
    return values;
  }

  /// The names the file gives the entities, one each; empty when it gives none.
  std::vector<std::string> names(med_entity_type entity, med_geometry_type geometry, std::size_t size) const {
    if (!has(entity, geometry, MED_NAME, size))
      return {};
    auto texts = med::text_buffer(size, med::short_name_size);
    file_.check(med::library().mesh_entity_name_read(file_.id(), name_.c_str(), step_, iteration_, entity,
                                                     geometry, texts.data()),
                "entity names");
    std::vector<std::string> names(size);
    for (std::size_t i = 0; i < size; ++i)
      names[i] = med::text_at(texts, i, med::short_name_size);
    return names;
  }

private:
  static std::string name_of(med_geometry_type geometry, const std::string& in_file) {
    const char* name = med::library().get_geometry_type_name(geometry);
    return name != nullptr ? name : in_file;
  }

  /// `known`: how many types of this project the mesh has. Types that the file doesn't number cannot be
  /// named.
  void refuse_unknown_types(std::size_t known) const {
    const auto kinds = count(MED_CELL, MED_GEO_ALL, MED_CONNECTIVITY, MED_NODAL, "cell types");
    auto type_name = med::text_buffer(1, med::name_size);
    for (std::size_t i = 0; i < kinds; ++i) {
      med_geometry_type geometry = MED_UNDEF_GEOTYPE;
      const auto result =
          med::library().mesh_entity_info(file_.id(), name_.c_str(), step_, iteration_, MED_CELL,
                                          static_cast<int>(i) + 1, type_name.data(), &geometry);
      if (result >= 0 && !med::type_of_geometry(geometry))
        file_.refuse(fmt::format("holds cells of type {}, which this program does not know",
                                 name_of(geometry, med::text_at(type_name, 0, med::name_size))));
    }
    if (kinds > known)
      file_.refuse(fmt::format("holds cells of {} types, {} of which this program does not know", kinds,
                               kinds - known));
  }

  bool has(med_entity_type entity, med_geometry_type geometry, med_data_type data,
           std::size_t expected) const {
    med_bool changed = MED_FALSE;
    med_bool moved = MED_FALSE;
    const auto found = med::library().mesh_entity_count(file_.id(), name_.c_str(), step_, iteration_, entity,
                                                        geometry, data, MED_NO_CMODE, &changed, &moved);
    if (found > 0 && static_cast<std::size_t>(found) != expected)
      file_.refuse(fmt::format("is damaged: it has {} entities but numbers {} of them", expected, found));
    return found > 0;
  }

  const med::File& file_;
  const std::string& name_;
  med_int step_ = MED_NO_DT;
  med_int iteration_ = MED_NO_IT;
};

/// The numbers, or as many from `first` on when there are none.
std::vector<std::int64_t> numbers_or_count(std::vector<std::int64_t> numbers, std::size_t size,
                                           std::int64_t first) {
  if (numbers.empty()) {
    numbers.resize(size);
    std::iota(numbers.begin(), numbers.end(), first);
  }
  return numbers;
}

void read_nodes(const med::File& file, const Entities& entities, Mesh& mesh) {
  const auto count = entities.count(MED_NODE, MED_NONE, MED_COORDINATE, MED_NO_CMODE, "nodes");
  if (count == 0)
    file.refuse("holds a mesh without nodes");
  const auto values = entities.coordinates(count, mesh.dimension);
  const auto dimension = static_cast<std::size_t>(mesh.dimension);
  mesh.points.assign(count, Eigen::Vector3d::Zero());
  for (std::size_t node = 0; node < count; ++node)
    for (std::size_t axis = 0; axis < dimension; ++axis)
      mesh.points[node][static_cast<Eigen::Index>(axis)] = values[node * dimension + axis];
  mesh.node_numbers = numbers_or_count(entities.numbers(MED_NODE, MED_NONE, count), count, 1);
  mesh.node_names = entities.names(MED_NODE, MED_NONE, count);
}

std::vector<NodeIndex> nodes_in_our_order(const med::File& file, const std::vector<med_int>& from,
                                          const cell::CellTopology& cell, NodeIndex node_count) {
  const auto bad = std::ranges::find_if(from, [&](med_int node) { return node < 1 || node > node_count; });
  if (bad != from.end())
    file.refuse(fmt::format("is damaged: a cell of type {} has node {}, but the nodes go from 1 to {}",
                            cell.name, *bad, node_count));
  const auto order = med::node_order(cell.type);
  const auto width = static_cast<std::size_t>(cell.node_count);
  std::vector<NodeIndex> nodes(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto local = i % width;
    nodes[i] = from[i - local + (order.empty() ? local : order[local])] - 1;
  }
  return nodes;
}

/// A block and the family of each of its cells.
struct BlockWithFamilies {
  CellBlock block;
  std::vector<med_int> families;
};

BlockWithFamilies read_block(const med::File& file, const Entities& entities, CellType type,
                             NodeIndex node_count) {
  const auto geometry = med::geometry_of(type);
  const auto& cell = cell::topology(type);
  const auto cells = entities.count(MED_CELL, geometry, MED_CONNECTIVITY, MED_NODAL, "cells");
  const auto size =
      file.plausible(static_cast<std::int64_t>(cells) * cell.node_count, "nodes in the cells of one type");
  BlockWithFamilies read;
  read.block.type = type;
  read.block.nodes = nodes_in_our_order(file, entities.connectivity(geometry, size), cell, node_count);
  read.block.numbers = entities.numbers(MED_CELL, geometry, cells);
  read.block.names = entities.names(MED_CELL, geometry, cells);
  read.families = entities.families(MED_CELL, geometry, cells);
  return read;
}

/// Reads every block; returns the family of every cell, block after block.
std::vector<med_int> read_cells(const med::File& file, const Entities& entities, Mesh& mesh) {
  std::vector<BlockWithFamilies> read;
  for (const auto type : entities.types())
    read.push_back(read_block(file, entities, type, mesh.node_count()));
  if (read.empty())
    file.refuse("holds a mesh without cells given by their nodes");

  std::vector<med_int> families;
  for (auto& one : read) {
    one.block.numbers = numbers_or_count(std::move(one.block.numbers), one.families.size(),
                                         static_cast<std::int64_t>(families.size()) + 1);
    families.insert(families.end(), one.families.begin(), one.families.end());
    mesh.blocks.push_back(std::move(one.block));
  }
  return families;
}

using FamilyGroups = std::map<med_int, std::set<std::string>>;

FamilyGroups read_families(const med::File& file, const std::string& mesh_name) {
  FamilyGroups families;
  const auto count = med::library().family_count(file.id(), mesh_name.c_str());
  file.check(count, "families");
  for (int index = 1; index <= count; ++index) {
    const auto groups =
        file.plausible(med::library().family_group_count(file.id(), mesh_name.c_str(), index), "groups");
    auto names = med::text_buffer(groups, med::group_name_size);
    auto family_name = med::text_buffer(1, med::name_size);
    med_int number = 0;
    file.check(med::library().family_info(file.id(), mesh_name.c_str(), index, family_name.data(), &number,
                                          names.data()),
               "families");
    for (std::size_t group = 0; group < groups; ++group)
      families[number].insert(med::text_at(names, group, med::group_name_size));
  }
  return families;
}

/// The groups of the entities whose families are given. Families of nodes have positive numbers, those of
/// cells negative ones: `sign` says which of the groups without members belong here.
std::vector<Group> groups_of(const std::vector<med_int>& family_of_item, const FamilyGroups& families,
                             int sign) {
  std::map<std::string, std::vector<std::int32_t>> members;
  for (const auto& [number, names] : families)
    if (number * sign > 0)
      for (const auto& name : names)
        members[name];
  for (std::size_t item = 0; item < family_of_item.size(); ++item) {
    const auto family = families.find(family_of_item[item]);
    if (family == families.end())
      continue;
    for (const auto& name : family->second)
      members[name].push_back(static_cast<std::int32_t>(item));
  }
  std::vector<Group> groups;
  groups.reserve(members.size());
  for (auto& [name, items] : members)
    groups.push_back({name, std::move(items)});
  return groups;
}

Mesh read_unguarded(const std::filesystem::path& path, const std::string& mesh_name) {
  const med::File file(path, med::File::Access::read);
  const auto header = chosen_header(file, mesh_name);
  check_kind(file, header);

  Mesh mesh;
  mesh.dimension = header.space_dimension;
  const Entities entities(file, header);
  read_nodes(file, entities, mesh);
  const auto cell_families = read_cells(file, entities, mesh);
  const auto node_families = entities.families(MED_NODE, MED_NONE, mesh.points.size());
  const auto families = read_families(file, header.name);
  mesh.node_groups = groups_of(node_families, families, +1);
  mesh.cell_groups = groups_of(cell_families, families, -1);
  name_the_rest(mesh);
  return mesh;
}

} // namespace

Mesh read_med(const std::filesystem::path& path, const std::string& mesh_name) {
  const auto read = [&] { return read_unguarded(path, mesh_name); };
  med::rehearse(path, read);
  return read();
}

} // namespace rubato::mesh
